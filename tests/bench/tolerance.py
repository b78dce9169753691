"""Whether a tolerance is met and the estimated error is right, on random bodies in random waves.

    python tests/bench/tolerance.py [--scenes 200] [--seed 1] [--method contour|panel]

Scenes: three boxes to a buoy; L/B 1 … 20, B/d 0.2 … 100, water under the keel from 2 % of the draft to a hundred times
the smaller of draft and half beam, λ/L 0.2 … 20 with 0.02 ≤ kh ≤ 50, any heading, tolerance 1e-5 … 1e-2; all but the
heading uniform in the logarithm.  Panels must suffice: L/B 1 … 8, B/d 0.5 … 20, gap from 10 % of the draft to twenty
times the smaller of draft and half beam, λ/L 0.5 … 20, tolerances 0.02, 0.01 and 0.005.

The true error is that against the contour method, which tests/identities holds to the exact cylinder, at a thousandth
of the tolerance, at least 1e-7; below `FLOOR` that cannot tell errors apart.  An estimate is right that is within a
factor of three of it.  The worst error is measured as in `bem.checks`; coefficients are those of A, B and excitation
that are above a thousandth of √|ZᵢᵢZⱼⱼ| and of the size of the force, of damping those above a thousandth of
`bem.checks.damping_scale`, by which it is measured too; of motions and mean drift those above a thousandth of the
largest of their unit, and of moments above that of the force on half the body's length.  The body's mass is the
displaced one, its radii of gyration are 0.2 to 0.4 of beam and length.
"""

import argparse
import sys
import time
from dataclasses import fields
from pathlib import Path
from typing import NamedTuple

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.checks import damping_scale, excitation_scale, largest_error, radiation_scale
from hakobune.bem.methods.panel_problem import prepare
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.problem import Problem
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.plan import planned

BEAM, GRAVITY = 50.0, 9.80665
FLOOR = 1e-8
NEGLIGIBLE = 1e-3
WANT = ("added_mass", "radiation_damping", "excitation_force", "rao", "drift_force", "drift_force_fixed")
FREE = WANT[3:]


class Ranges(NamedTuple):
    """Of L/B, B/d, gap (least over draft, most over the smaller of draft and half beam), λ/L and tolerance"""

    slender: tuple
    flat: tuple
    gap: tuple
    wave: tuple
    tolerances: tuple


RANGES = {
    "contour": Ranges((1, 20), (0.2, 100), (0.02, 100), (0.2, 20), (1e-5, 1e-2)),
    "panel": Ranges((1, 8), (0.5, 20), (0.1, 20), (0.5, 20), (0.005, 0.01, 0.02)),
}


class Scene(NamedTuple):
    """sizes : m, as of `bem.methods.shape_problem.ShapeProblem`; omega : rad/s; heading : degrees"""

    method: str
    shape: str
    sizes: tuple
    depth: float
    omega: float
    heading: float
    tolerance: float
    gyration: float = 0.3

    def __str__(self):
        sizes = " × ".join(f"{s:.4g}" for s in self.sizes)
        return (
            f"{self.shape} {sizes} m in {self.depth:.4g} m, ω {self.omega:.3g}, {self.heading:.0f}°, "
            f"tolerance {self.tolerance:.1e}, gyration {self.gyration:.2g}"
        )


class Outcome(NamedTuple):
    """error, estimate : worst, relative; ratios : (c,) estimate over error of the coefficients

    damping : (c,) errors of damping that counts, relative to its own size
    further : {name: (c,) estimate over error} of damping that counts, motions and mean drift
    sharper, seconds : of the second of two frequencies, whether one answer was not enough, and with all estimates
    """

    scene: Scene
    error: float
    estimate: float
    ratios: np.ndarray
    damping: np.ndarray
    further: dict
    sharper: bool
    seconds: float

    @property
    def ratio(self):
        """Estimate over error, both at least `FLOOR`"""
        return max(self.estimate, FLOOR) / max(self.error, FLOOR)


def drawn(rng, method, ranges=None):
    """A random `Scene`"""
    ranges = ranges or RANGES[method]
    while True:
        shape = "buoy" if rng.random() < 0.25 else "box"
        length = BEAM * (_between(rng, *ranges.slender) if shape == "box" else 1.0)
        draft = BEAM / _between(rng, *ranges.flat)
        gap = _between(rng, ranges.gap[0] * draft, ranges.gap[1] * min(draft, BEAM / 2))
        k = 2 * np.pi / (length * _between(rng, *ranges.wave))
        heading, depth = rng.uniform(0, 360), draft + gap
        tolerances = ranges.tolerances
        tolerance = _between(rng, *tolerances) if len(tolerances) == 2 else tolerances[rng.integers(len(tolerances))]
        if 0.02 <= k * depth <= 50 and gap > ranges.gap[0] * draft:
            omega = float(np.sqrt(GRAVITY * k * np.tanh(k * depth)))
            sizes = (length, BEAM, draft) if shape == "box" else (BEAM / 2, draft)
            return Scene(method, shape, sizes, depth, omega, heading, tolerance, rng.uniform(0.2, 0.4))


def _between(rng, low, high):
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def prepared(scene):
    """What solves a scene, and its headings, rad"""
    names = ("length", "beam", "draft") if scene.shape == "box" else ("radius", "draft")
    across, along = (BEAM * scene.gyration, max(scene.sizes[:-1]) * scene.gyration)
    along = along if scene.shape == "box" else across
    body = {"gyration": [across, along, along], **dict(zip(names, scene.sizes, strict=True))}
    raw = {
        "water": {"depth": scene.depth},
        "bodies": [{"shape": scene.shape, **body}],
        "waves": {"omegas": [scene.omega], "headings_deg": [scene.heading]},
        "method": scene.method,
        "tolerance": scene.tolerance,
        "want": list(WANT),
    }
    made = make_scene(raw)
    return prepare(planned(made).problem), made.headings()


def reference(scene, headings, problem):
    """The contour method at a thousandth of the tolerance"""
    tolerance = max(1e-7, scene.tolerance / 1000)
    body = {f.name: getattr(problem, f.name) for f in fields(Problem)} | {"depth": scene.depth, "tolerance": tolerance}
    problem = ShapeProblem(method="contour", shape=scene.shape, sizes=scene.sizes, **body)
    return prepare(problem).run(scene.omega, headings, WANT, None, DOFS)


def outcome(scene):
    """`Outcome` of one scene"""
    body, headings = prepared(scene)
    run = body.run(scene.omega, headings, WANT, None, DOFS).within_tolerance()
    start, first = time.process_time(), body.run(scene.omega * 1.001, headings, WANT, None, DOFS)
    again = first.within_tolerance()
    again.result(), again.estimated_errors()
    seconds = time.process_time() - start
    exact = reference(scene, headings, body.problem)
    errors = run.radiation - exact.radiation, run.excitation - exact.excitation
    worst = largest_error(run, *errors), run.estimated_error()
    return Outcome(scene, *worst, _ratios(run, errors), *_damping(run, errors, exact), again is not first, seconds)


def _damping(run, errors, exact):
    """`Outcome.damping` and `Outcome.further`; damping that symmetry makes zero is right by itself and not counted"""
    T = run.problem.transform
    size = damping_scale(T @ exact.radiation @ T.T, run.prepared.displacing)
    true, guess, value = (np.abs((T @ Z @ T.T).imag) for Z in (errors[0], run.errors[0], exact.radiation))
    seen = np.isfinite(size) & (value > NEGLIGIBLE * size)
    own = true[seen] / size[seen]
    further = {"radiation_damping": _ratio(true[seen], guess[seen], size[seen])}
    found, known, told = run.result(), exact.result(), run.estimated_errors()
    for name in FREE:
        value = np.abs(known[name])
        size = _sizes(value, run.prepared.radius)
        seen = value > NEGLIGIBLE * size
        further[name] = _ratio(np.abs(found[name] - known[name])[seen], told[name][seen], size[seen])
    return own, further


def _sizes(value, radius):
    """Largest motion or rotation of `value` (m, 6), largest force and moment of (m, 3), no moment below its force's"""
    forces = value.shape[1] - (3 if value.shape[1] == 6 else 1)
    force, moment = value[:, :forces].max(), value[:, forces:].max()
    moment = moment if forces == 3 else max(moment, force * radius / 2)
    return np.where(np.arange(value.shape[1]) < forces, force, moment) * np.ones_like(value)


def _ratio(error, estimate, size):
    return np.maximum(estimate, FLOOR * size) / np.maximum(error, FLOOR * size)


def _ratios(run, errors):
    """Estimate over error of every coefficient that counts, both at least `FLOOR` of its size"""
    sizes = radiation_scale(run), excitation_scale(run)
    parts = [np.real, np.imag], [np.abs]
    out = []
    for kinds, value, size, true, guess in zip(
        parts, (run.radiation, run.excitation), sizes, errors, run.errors, strict=True
    ):
        for part in kinds:
            counts = np.abs(part(value)) > NEGLIGIBLE * size
            size_here = np.broadcast_to(size, value.shape)[counts] * FLOOR
            found, told = (np.maximum(np.abs(part(e))[counts], size_here) for e in (true, guess))
            out.append(told / found)
    return np.concatenate(out)


def right(ratios):
    """Whether estimates are within a factor of three"""
    return (np.asarray(ratios) <= 3) & (np.asarray(ratios) >= 1 / 3)


def report(outcomes, worst=5):
    """Print shares, time and the worst cases"""
    over = np.array([o.error / o.scene.tolerance for o in outcomes])
    ratios, all_ratios = np.array([o.ratio for o in outcomes]), np.concatenate([o.ratios for o in outcomes])
    print(f"scenes                                     {len(outcomes)}")
    print(f"tolerance met                              {np.mean(over <= 1):.1%}")
    print(f"estimate of the worst error right          {np.mean(right(ratios)):.1%}")
    print(f"estimates of {len(all_ratios)} coefficients right       {np.mean(right(all_ratios)):.1%}")
    own = np.concatenate([o.damping / o.scene.tolerance for o in outcomes])
    print(f"{len(own)} damping coefficients of their own size within the tolerance  {np.mean(own <= 1):.1%}")
    for name in outcomes[0].further:
        all_of = np.concatenate([o.further[name] for o in outcomes])
        print(f"estimates of {len(all_of)} of {name} right".ljust(60) + f"{np.mean(right(all_of)):.1%}")
    print("                       5 %     25 %     50 %     75 %     95 %")
    for name, values in (("error / tolerance", over), ("estimate / error", ratios)):
        print(f"{name:18s}" + "".join(f"{q:9.2g}" for q in np.quantile(values, [0.05, 0.25, 0.5, 0.75, 0.95])))
    times = 1e3 * np.array([o.seconds for o in outcomes])
    sharper = np.mean([o.sharper for o in outcomes])
    print(f"processor time of a frequency {np.median(times):.1f} ms in the median, {times.mean():.1f} ms in the mean")
    print(f"frequencies whose first answer did not keep the tolerance  {sharper:.1%}")
    far = np.abs(np.log(ratios))
    for title, order in (("largest error", np.argsort(-over)), ("estimate farthest off", np.argsort(-far))):
        print(title)
        for i in order[:worst]:
            print(f"  {outcomes[i].scene}: error {outcomes[i].error:.1e}, estimate {outcomes[i].estimate:.1e}")


def campaign(scenes, seed, method, ranges=None):
    """[`Outcome`] of so many scenes"""
    return [outcome(drawn(np.random.default_rng([seed, i]), method, ranges)) for i in range(scenes)]


def main():
    parser = argparse.ArgumentParser(description="Is the tolerance met, and the estimated error right?")
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--method", choices=sorted(RANGES), default="contour")
    asked = parser.parse_args()
    report(campaign(asked.scenes, asked.seed, asked.method))


if __name__ == "__main__":
    main()
