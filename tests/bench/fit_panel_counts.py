"""Panels for a tolerance fitted again: `pipelines.solve.panel_counts.panels_for` and `bem.checks.ERROR_ORDER`.

    python tests/bench/fit_panel_counts.py [--quick] [--bodies 30] [--seed 3]

Each random body is solved with 100 to 800 panels, and by the contour method at a tolerance of 1e-5; the error is the
worst one of `bem.checks` at three frequencies, the panels needed for 1 % follow from straight lines between the
logarithms.  Printed are the order at which the error falls (median over bodies), what is needed at 1 % beside what the
rule gives, and how many of the bodies have enough.  The rule was fitted to boxes of one to seven breadths that are 0.5
to 20 drafts wide; held out are other boxes of these, cylinders, and longer boxes.
"""

import sys
from pathlib import Path
from types import SimpleNamespace

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from bench.random_bodies import asked, between

from hakobune.bem import DOFS
from hakobune.bem.checks import ERROR_ORDER, largest_error
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.solve.panel_counts import panels_for

GRAVITY, BEAM, TOLERANCE = 9.80665, 50.0, 0.01
PANELS = np.array([100, 200, 400, 800])
WAVES = (1.0, 2.0, 6.0)  # λ over the longest side
WANT = {"added_mass", "radiation_damping", "excitation_force"}
KINDS = {
    "boxes as fitted": ("box", (1, 7), (0.5, 20)),
    "cylinders, held out": ("buoy", (1, 1), (0.5, 20)),
    "boxes of seven to fifteen breadths, held out": ("box", (7, 15), (0.5, 20)),
}


def drawn(rng, shape, slender, flat):
    """(body, sizes, depth) of a random body"""

    length, draft = BEAM * between(rng, *slender), BEAM / between(rng, *flat)
    depth = draft + between(rng, 0.2 * draft, 10 * min(draft, BEAM / 2))
    if shape == "box":
        return SimpleNamespace(shape="box", length=length, beam=BEAM, draft=draft), (length, BEAM, draft), depth
    return SimpleNamespace(shape="buoy", radius=BEAM / 2, draft=draft), (BEAM / 2, draft), depth


def errors(shape, sizes, depth, counts):
    """(panels (n,), worst relative error (n,)) over the waves, with about `counts` (n,) panels"""
    longest = 2 * sizes[0] if shape == "buoy" else sizes[0]
    k = 2 * np.pi / (longest * np.array(WAVES))
    omegas = np.sqrt(GRAVITY * k * np.tanh(k * depth))
    exact = prepare(ShapeProblem(method="contour", shape=shape, sizes=sizes, depth=depth, tolerance=1e-5))
    true = [exact.run(w, [0.6], WANT, None, DOFS) for w in omegas]
    found = []
    for count in counts:
        mesh = (box if shape == "box" else buoy)(*sizes, panels=int(count))
        body, worst = prepare(PanelProblem(mesh, lid(mesh), depth=depth)), 0.0
        for t, w in zip(true, omegas, strict=True):
            run = body.run(w, [0.6], WANT, None, DOFS)
            worst = max(worst, largest_error(run, run.radiation - t.radiation, run.excitation - t.excitation))
        found.append((mesh.total, worst))
    return np.array(found).T


def needed(panels, error):
    """Panels for TOLERANCE, by straight lines in the logarithms, carried on beyond the last at ERROR_ORDER"""
    x, y = np.log(panels), np.log(error / TOLERANCE)
    if y[-1] > 0:
        return float(np.exp(x[-1] + y[-1] / ERROR_ORDER))
    last = np.flatnonzero(y > 0)[-1] if np.any(y > 0) else -1
    if last < 0:
        return float(np.exp(x[0] + y[0] / ERROR_ORDER))
    share = y[last] / (y[last] - y[last + 1])
    return float(np.exp(x[last] + share * (x[last + 1] - x[last])))


def report(title, bodies, counts):
    rows, orders = [], []
    for body, sizes, depth in bodies:
        panels, error = errors(body.shape, sizes, depth, counts)
        orders.append(-np.polyfit(np.log(panels), np.log(error), 1)[0])
        rows.append((needed(panels, error), panels_for(body, TOLERANCE)))
    need, have = np.array(rows).T
    times = need / have
    print(
        f"| {title} | {len(rows)} | {np.median(orders):.2f} | {np.median(need):.0f} | {np.quantile(need, 0.9):.0f} "
        f"| {np.median(have):.0f} | {np.quantile(times, 0.9):.2f} | {np.sum(times <= 1)} |",
        flush=True,
    )


def main(words=None):
    given = asked(words, __doc__, "a body of each kind up to 400 panels, some seconds", 30, 3)
    count, panels = (1, PANELS[:3]) if given.quick else (given.bodies, PANELS)
    print(f"ERROR_ORDER in the code {ERROR_ORDER:g}")
    print("| bodies | n | order | needed, median | 90 % | the rule gives | 90 % need times as many | enough in |")
    print("|---|---|---|---|---|---|---|---|")
    for i, (title, ranges) in enumerate(KINDS.items()):
        report(title, [drawn(np.random.default_rng([given.seed, i, j]), *ranges) for j in range(count)], panels)


if __name__ == "__main__":
    main()
