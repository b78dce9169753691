"""`SHARE` of `bem.panels.irregular_frequencies` fitted again: up to which part of the lowest K no lid is needed.

    python tests/bench/fit_lid_share.py [--quick]

Errors of 250 panels with and without lid against the contour method (of coefficients, and of forces, as in
`bem.checks`), at K from a third of the lowest irregular one to that itself.  The fitted share is the largest up to
which neither error without lid is more than `MORE` times the error with it, on the series box; held out are a cylinder,
a slender box, a square one of large draft and a turned one.
"""

import argparse
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.checks import largest_error
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.panels.irregular_frequencies import SHARE, lowest_irregular
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

GRAVITY, PANELS, MORE = 9.80665, 250, 1.25
SHARES = np.round(np.arange(0.3, 1.0, 0.05), 2)
WANT = {"added_mass", "radiation_damping", "excitation_force"}
HEADINGS = np.radians([0.0, 37.0, 90.0])
FITTED = [("box", (100.0, 50.0, 10.0), depth) for depth in (12.0, 20.0, 100.0)]
HELD_OUT = [
    ("buoy", (20.0, 10.0), 30.0),
    ("box", (200.0, 40.0, 10.0), 30.0),
    ("box", (60.0, 60.0, 30.0), 60.0),
    ("box", (50.0, 100.0, 10.0), 15.0),
]


def errors(shape, sizes, depth, shares):
    """(2, 2, s) largest relative error of coefficients and forces, with and without lid, at shares of the lowest K"""
    mesh = (box if shape == "box" else buoy)(*sizes, panels=PANELS)
    length, beam = sizes[:2] if shape == "box" else (2 * sizes[0],) * 2
    exact = prepare(ShapeProblem(method="contour", shape=shape, sizes=sizes, depth=depth, tolerance=1e-5))
    body = prepare(PanelProblem(mesh, lid(mesh), depth=depth))
    covered, bare = _always(body, "lid_from", 0.0), _always(body, "lid_from", np.inf)
    out = []
    for share in shares:
        omega = float(np.sqrt(GRAVITY * share * lowest_irregular(length, beam, sizes[-1])))
        true = exact.run(omega, HEADINGS, WANT, None, DOFS)
        row = []
        for prepared in (covered, bare):
            run = prepared.run(omega, HEADINGS, WANT, None, DOFS)
            moving, held = run.radiation - true.radiation, run.excitation - true.excitation
            row.append([largest_error(run, moving, 0 * held), largest_error(run, 0 * moving, held)])
        out.append(row)
    return np.array(out).T


def _always(body, name, value):
    """The same body with a lid from K = `value` on"""
    geometry = type(body.geometry)
    g = type("Geometry", (geometry,), {name: value})(body.problem.mesh, body.problem.lid, body.problem.depth)
    return type(body)(body.problem, g)


def enough(with_lid, without, shares):
    """Largest share up to which no error without lid is `MORE` times that with it"""
    fails = np.flatnonzero(np.any(without > MORE * with_lid, axis=0))
    return shares[-1] if not len(fails) else shares[fails[0] - 1] if fails[0] else 0.0


def report(title, scenes, shares):
    found = []
    print(f"\n{title}\n| body | depth | " + " | ".join(f"{s:g}" for s in shares) + " | no lid needed up to |")
    print("|---" * (len(shares) + 3) + "|")
    for shape, sizes, depth in scenes:
        with_lid, without = errors(shape, sizes, depth, shares).transpose(1, 0, 2)
        found.append(enough(with_lid, without, shares))
        pairs = zip(100 * with_lid.T, 100 * without.T, strict=True)
        cells = (f"{a[0]:.2f}/{b[0]:.2f}, {a[1]:.2f}/{b[1]:.2f}" for a, b in pairs)
        print(f"| {shape} {sizes} | {depth:g} | " + " | ".join(cells) + f" | {found[-1]:g} |", flush=True)
    return min(found)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="one body of each kind, some seconds")
    quick = parser.parse_args(words).quick
    shares = SHARES[::3] if quick else SHARES
    fitted = report(
        "as fitted: % of coefficients, and of forces, with / without lid", FITTED[:1] if quick else FITTED, shares
    )
    held = report(
        "held out: % of coefficients, and of forces, with / without lid", HELD_OUT[:1] if quick else HELD_OUT, shares
    )
    print(f"\nSHARE in the code {SHARE:g}, fitted {fitted:g}, least of the bodies held out {held:g}")


if __name__ == "__main__":
    main()
