"""The rules of `bem.contour.accuracy` fitted again: each part of the contour method coarsened alone on random bodies.

    python tests/bench/fit_contour_accuracy.py [--quick] [--bodies 60] [--seed 2]

A part with a rule 10^(−a − b n), n its number of functions, modes, digits or polynomials, leaves an error against a
body of `DIGITS` digits.  Printed are b of the rule and of the errors (the median over bodies of the slope, where it is
above `FLOOR`), by how many digits a would have to change for the rule to hold in 95 % of the bodies, above 0 where it
is too bold, and in how many it holds.  The rules were fitted to boxes in waves of 0.2 to 20 lengths; held out are other
boxes of another seed, cylinders, and boxes in waves of a twentieth of their length.
"""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from bench.random_bodies import asked, between

from hakobune.bem.contour.accuracy import KAPPA, PLAN, accuracy, height
from hakobune.bem.contour.body import ContourBody
from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.rectangle import Rectangle

GRAVITY, BEAM = 9.80665, 50.0
DIGITS, FLOOR = 6.5, 1e-7
PARTS = {"terms": (1, 2, 3), "modes": (10.5, 18.0, 27.0), "kappa": (1.0, 2.0, 3.0), "plan": (3.0, 4.0), "extra": (1, 2)}
KINDS = {
    "boxes as fitted": ("box", (0.2, 20)),
    "cylinders, held out": ("cylinder", (0.2, 20)),
    "boxes in short waves, held out": ("box", (0.05, 0.2)),
}


def drawn(rng, kind, waves):
    """(plan, draft, depth, omega) of a random body"""

    while True:
        length = BEAM * (between(rng, 1, 20) if kind == "box" else 1.0)
        draft = BEAM / between(rng, 0.2, 100)
        depth = draft + between(rng, 0.02 * draft, 20 * min(draft, BEAM / 2))
        k = 2 * np.pi / (length * between(rng, *waves))
        if 0.02 <= k * depth <= 50:
            plan = Rectangle.to_digits(length, BEAM, 3) if kind == "box" else Circle(BEAM / 2)
            return plan, draft, depth, float(np.sqrt(GRAVITY * k * np.tanh(k * depth)))


def solved(plan, draft, depth, omega, fine):
    """A + iB/ω and the exciting force, each relative to its size"""
    r = ContourBody(plan.to(fine), draft, depth, fine).first_order(omega, [0.4])
    return r.radiation, (r.froude_krylov + r.diffraction)[0]


def apart(one, other):
    """Largest relative difference of two results"""
    size = np.sqrt(np.abs(np.diag(other[0])))
    size = np.where(size > 1e-6 * size.max(), size, np.inf)
    arms = np.where(np.arange(6) < 3, 1.0, size[3:].max() / size[:3][np.isfinite(size[:3])].max())
    force = np.abs(one[1] - other[1]) / (arms * np.abs(other[1] / arms).max())
    return max(np.max(np.abs(one[0] - other[0]) / np.outer(size, size)), np.max(force[np.isfinite(size)]))


def rule(part, n, draft, gap, scale):
    """log₁₀ of what the rule says a part with n leaves, and its slope in n"""
    r, g, high = gap / min(draft, scale), gap / scale, height(gap, scale)
    step = 0.8 + 1.7 / (1 + r / 4)
    return {
        "terms": (-8 * (1 + r) ** -0.7 - (n - 1) * step, -step),
        "modes": (-1.5 - 1.2 * n / 15, -1.2 / 15),
        "kappa": (-0.8 - KAPPA * n + 1.45 * np.log10(g) + 1.5 * np.log10(high), -KAPPA),
        "plan": (-1.2 - PLAN * n + 3.3 * np.log10(high), -PLAN),
        "extra": (-2.4 - n / 1.5, -1 / 1.5),
    }[part]


def measured(rng, kind, waves, every=1):
    """{part: (log₁₀ error, log₁₀ rule, slope of the rule) for each n, or for every second of them} of one body"""
    plan, draft, depth, omega = drawn(rng, kind, waves)
    gap = depth - draft
    fine = accuracy(DIGITS, draft, gap, plan.scale)
    whole = solved(plan, draft, depth, omega, fine)
    out = {}
    for part, numbers in PARTS.items():
        if kind == "cylinder" and part in ("kappa", "plan", "extra"):
            continue  # a circle has none of them
        rows = []
        for n in numbers[::every]:
            if n < getattr(fine, part):
                error = apart(solved(plan, draft, depth, omega, fine._replace(**{part: n})), whole)
                rows.append((n, np.log10(max(error, 1e-12)), *rule(part, n, draft, gap, plan.scale)))
        out[part] = np.array(rows).reshape(-1, 4)
    return out


def report(title, bodies):
    print(f"\n{title}: {len(bodies)} bodies")
    print("| part | slope in the code | fitted | digits a lacks in 95 % | rule holds in |\n|---|---|---|---|---|")
    for part in PARTS:
        tables = [body[part] for body in bodies if len(body.get(part, ()))]
        if not tables:
            continue
        rows = np.concatenate(tables)
        seen = [t[t[:, 1] > np.log10(FLOOR)] for t in tables]
        slopes = [np.polyfit(t[:, 0], t[:, 1], 1)[0] for t in seen if len(t) > 1]
        excess = rows[:, 1] - np.maximum(rows[:, 2], np.log10(FLOOR))
        fitted = f"{np.median(slopes):.3g}" if slopes else "below the floor"
        print(
            f"| {part} | {np.median(rows[:, 3]):.3g} | {fitted} | {np.quantile(excess, 0.95):+.2f} "
            f"| {np.sum(excess <= 0)} of {len(excess)} |",
            flush=True,
        )


def main(words=None):
    given = asked(words, __doc__, "a body of each kind, some seconds", 60, 2)
    count, every = (1, 2) if given.quick else (given.bodies, 1)
    for i, (title, (kind, waves)) in enumerate(KINDS.items()):
        report(title, [measured(np.random.default_rng([given.seed, i, j]), kind, waves, every) for j in range(count)])


if __name__ == "__main__":
    main()
