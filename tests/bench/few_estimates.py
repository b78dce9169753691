"""How often errors between the frequencies that are solved by two resolutions are bounds of what these would show.

    python tests/bench/few_estimates.py [--bodies 40] [--seed 1] [--quick]

Random boxes and buoys by the contour method, up to 80 frequencies each.  Of every frequency whose error is interpolated
(`bem.methods.few_estimates`) the same is solved with an error of its own; of each coefficient and force the bound is
set beside that, and so are the estimates of motions and drift that follow.
"""

import sys
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from bench.random_bodies import asked, between

from hakobune.bem import DOFS
from hakobune.bem.database.schema import ESTIMATES
from hakobune.bem.methods.few_estimates import MARGIN
from hakobune.bem.methods.panel_problem import prepare
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.plan import planned

HEADINGS = np.radians([0.0, 35.0])
NEGLIGIBLE = 1e-3  # of the tolerance, relative to the largest of a quantity over the band


class Outcome(NamedTuple):
    """What one body showed: bound over own error of each coefficient and force that is not `NEGLIGIBLE` (n,), of all
    others (m,), and estimate over own estimate of motions and drift (k,)
    """

    body: dict
    interpolated: int
    frequencies: int
    bounds: np.ndarray
    small: np.ndarray
    further: np.ndarray


def scene(rng, count):
    """A random box or buoy, afloat with a gyration, 5 to 100 times its draft long waves and down to half its length"""
    length, draft = 100.0, 100.0 / between(rng, 4, 40)
    body = {"shape": "box", "length": length, "beam": length / between(rng, 1, 6), "draft": draft}
    if rng.random() < 0.3:
        body = {"shape": "buoy", "radius": length / 2, "draft": draft}
    body["gyration"] = [0.3 * length / 2, 0.5 * length / 2, 0.5 * length / 2]
    raw = {"water": {"depth": draft * (1 + between(rng, 0.1, 10))}, "bodies": [body], "method": "contour"}
    low, high = between(rng, 0.15, 0.4), between(rng, 0.8, 1.6)
    raw["waves"] = {"omegas": {"from": low, "to": high, "count": count}, "headings_deg": [0, 35]}
    return raw | {"tolerance": float(rng.choice([1e-2, 3e-3, 1e-3]))}


def outcome(raw):
    """`Outcome` of a scene"""
    problem = planned(make_scene(raw)).problem
    few, own = prepare(problem), prepare(replace(problem, omegas=()))
    question = HEADINGS, frozenset(ESTIMATES), np.linspace(0, 2 * np.pi, 72, endpoint=False), DOFS
    runs = [few.run(omega, *question) for omega in problem.omegas]
    at = [i for i, run in enumerate(runs) if run.interpolated]
    pairs = [(runs[i].estimated_errors(), own.run(problem.omegas[i], *question)) for i in at]
    values = {name: np.array([run.result()[name] for _, run in pairs]) for name in ESTIMATES} if pairs else {}
    bounds, small, further = [], [], []
    for name in ESTIMATES if pairs else ():
        found, true = (np.array(part) for part in _columns(pairs, name))
        matters = true > NEGLIGIBLE * problem.tolerance * np.abs(values[name]).max()
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = found / true
        seen = true > 0
        if name in ESTIMATES[:3]:
            bounds.append(ratio[matters & seen])
            small.append(ratio[~matters & seen])
        else:
            further.append(ratio[matters & seen])
    joined = [np.concatenate(part) if part else np.zeros(0) for part in (bounds, small, further)]
    return Outcome(raw["bodies"][0], len(at), len(runs), *joined)


def _columns(pairs, name):
    """Interpolated errors of a quantity and own ones, each a list over the frequencies"""
    return [errors[name] for errors, _ in pairs], [run.estimated_errors()[name] for _, run in pairs]


def campaign(bodies, seed, count):
    """[`Outcome`] of random scenes of `count` frequencies"""
    rng = np.random.default_rng(seed)
    return [outcome(scene(rng, count)) for _ in range(bodies)]


def main(words=None):
    given = asked(words, __doc__, "five bodies", 40, 1)
    found = campaign(5 if given.quick else given.bodies, given.seed, 80)
    share = sum(o.interpolated for o in found) / sum(o.frequencies for o in found)
    print(f"{len(found)} bodies, {share:.0%} of the frequencies interpolated, margin {MARGIN}")
    for name in ("bounds", "small", "further"):
        ratio = np.concatenate([getattr(o, name) for o in found])
        if len(ratio):
            whole, half = (np.mean(ratio >= share) for share in (1, 0.5))
            quantiles = "  ".join(f"{q:g} %: {np.percentile(ratio, q):.2f}" for q in (1, 5, 50, 95))
            print(f"{name:8} {len(ratio):7}  at least the error {whole:.1%}, half of it {half:.1%}  {quantiles}")


if __name__ == "__main__":
    main()
