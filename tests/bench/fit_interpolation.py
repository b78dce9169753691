"""Constants of the interpolation between frequencies fitted again: `pipelines.solve.adaptive.WIDTH` and the family of
`bem.database.interpolant`.

    python tests/bench/fit_interpolation.py [--quick]

Each body is solved as a band of 0.1 to 2 rad/s to half a per cent, as a user would have it, and directly at places in
between by the contour method.  The width that a body needs is its largest error over its largest standard deviation;
that of the code is right where nearly all bands end below the tolerance.  For every member left out of the family,
or alone in it, and for other nuggets, the largest error of the same nodes is printed as a multiple of that of the code:
above one the constant earns its place.  The family was fitted to the boxes of the series calculations in 12, 20 and
100 m; the other bodies, random ones among them, are held out.
"""

import argparse
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.database import interpolant, open_database
from hakobune.bem.database.between_frequencies import between
from hakobune.bem.methods.panel_problem import prepare
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.adaptive import WIDTH
from hakobune.pipelines.solve.problem import problem_of
from hakobune.pipelines.solve.run import solve

TOLERANCE, BAND = 0.005, (0.1, 2.0)
NAMES = ("added_mass", "radiation_damping", "excitation_force")
SERIES = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}
FITTED = [(SERIES, 12.0), (SERIES, 20.0), (SERIES, 100.0)]
HELD_OUT = [
    ({"shape": "buoy", "radius": 20.0, "draft": 10.0}, 40.0),
    ({"shape": "box", "length": 60.0, "beam": 60.0, "draft": 6.0}, 10.0),
    ({"shape": "box", "length": 80.0, "beam": 20.0, "draft": 8.0}, 30.0),
    ({"shape": "buoy", "radius": 10.0, "draft": 15.0}, 60.0),
]


def random_bodies(count, seed=19):
    """Boxes and buoys in turn, with their depth"""
    rng, out = np.random.default_rng(seed), []
    for i in range(count):
        if i % 2:
            size = rng.uniform(6, 30)
            draft = size * rng.uniform(0.3, 1.5)
            body = {"shape": "buoy", "radius": round(size, 1), "draft": round(draft, 1)}
        else:
            length = rng.uniform(40, 160)
            beam = length * rng.uniform(0.25, 1)
            draft = beam * rng.uniform(0.1, 0.4)
            body = {"shape": "box", "length": round(length, 1), "beam": round(beam, 1), "draft": round(draft, 1)}
        out.append((body, round(draft * rng.uniform(1.15, 6), 1)))
    return out


def variants():
    """{name: (family, nugget)} beside the constants of the code"""
    family, nugget = interpolant.FAMILY, interpolant.NUGGET
    out = {f"nugget {10 * nugget:g}": (family, 10 * nugget), f"nugget {nugget / 10:g}": (family, nugget / 10)}
    for reach in sorted({m.reach for m in family}):
        out[f"without reach {reach:g}"] = (tuple(m for m in family if m.reach != reach), nugget)
    wider = tuple(m._replace(reach=1.4 * m.reach, nodes=1.4 * m.nodes) for m in family if m.reach == 3.5)
    out["with reach 4.9"] = (family + wider, nugget)
    out["without echoes"] = (tuple(m for m in family if len(m.delays) == 1), nugget)
    out["only with echoes"] = (tuple(m for m in family if len(m.delays) > 1), nugget)
    for lead in sorted({m.lead for m in family}):
        out[f"only lead {lead:g}"] = (tuple(m for m in family if m.lead == lead), nugget)
    return out


def scene_of(body, depth):
    raw = {
        "water": {"depth": depth},
        "bodies": [body],
        "waves": {"band": {"from": BAND[0], "to": BAND[1]}, "headings_deg": [0, 45, 90]},
        "method": "contour",
        "tolerance": TOLERANCE,
        "want": ["radiation", "diffraction"],
    }
    return make_scene(raw)


def off(name, found, exact):
    """Largest error relative to the largest of its kind"""
    if name == "excitation_force":
        size = np.abs(exact).max(axis=(0, 1))
        return np.max(np.abs(found - exact) / np.where(size > 1e-6 * size.max(), size, np.inf))
    scale = np.sqrt(np.einsum("nii->ni", exact).max(axis=0))
    scale = np.where(scale > 1e-3 * scale.max(), scale, np.inf)
    return np.max(np.abs(found - exact) / np.outer(scale, scale))


def measured(body, depth, places, names):
    """(solves, error, deviation, {variant: error}) of one body"""
    scene = scene_of(body, depth)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "body.h5"
        solve(scene, path)
        db = open_database(path)
        omega = np.linspace(*BAND, places)
        prepared = prepare(replace(problem_of(db.header, scene), tolerance=TOLERANCE / 100))
        dofs = tuple(db["influenced_dof"])
        rows = [prepared.run(w, db.wave_direction, set(NAMES), None, dofs).result() for w in omega]
        exact = {name: np.array([row[name] for row in rows]) for name in NAMES}

        def error():
            now = between(open_database(path))
            return max(off(name, now.value(omega, name), exact[name]) for name in NAMES), now

        mine, now = error()
        deviation = float(now.largest_error(omega, NAMES).max())
        others = {}
        for name in names:
            kept = interpolant.FAMILY, interpolant.NUGGET
            interpolant.FAMILY, interpolant.NUGGET = variants()[name]
            interpolant.ROUNDING = 2 * interpolant.NUGGET
            try:
                others[name] = error()[0]
            finally:
                interpolant.FAMILY, interpolant.NUGGET = kept
                interpolant.ROUNDING = 2 * interpolant.NUGGET
    return len(db.omega), mine, deviation, others


def report(title, bodies, places, names):
    """Prints a table; returns widths (b,), errors (b,) and the errors of the variants over the code's (b, v)"""
    print(f"\n{title}\n| body | solves | error, % | deviation, % | width needed | tolerance kept |")
    print("|---|---|---|---|---|---|")
    widths, errors, ratios = [], [], []
    for body, depth in bodies:
        solves, error, deviation, others = measured(body, depth, places, names)
        widths.append(error / deviation)
        errors.append(error)
        ratios.append([others[name] / error for name in names])
        sizes = " × ".join(f"{v:g}" for v in body.values() if not isinstance(v, str))
        print(
            f"| {body['shape']} {sizes} m in {depth:g} m | {solves} | {100 * error:.2f} | {100 * deviation:.2f} "
            f"| {widths[-1]:.2f} | {'yes' if error <= TOLERANCE else 'no'} |",
            flush=True,
        )
    return np.array(widths), np.array(errors), np.array(ratios)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="one body of each kind, some seconds")
    quick = parser.parse_args(words).quick
    names, places = (list(variants())[:2], 20) if quick else (list(variants()), 300)
    some = slice(1, 2) if quick else slice(None)
    fitted, first, ours = report("as fitted", FITTED[some], places, names)
    held, second, others = report("held out", (HELD_OUT + random_bodies(10))[some], places, names)
    print(f"\nWIDTH in the code {WIDTH:g}; needed by the fitted {fitted.max():.2f}, by those held out {held.max():.2f}")
    errors = np.concatenate([first, second])
    print(f"tolerance kept by {np.sum(errors <= TOLERANCE)} of {len(errors)}, largest error {100 * errors.max():.2f} %")
    print("\n| family | error over the code's, fitted | held out |\n|---|---|---|")
    for name, one, other in zip(names, ours.T, others.T, strict=True):
        print(f"| {name} | {np.exp(np.mean(np.log(one))):.2f} | {np.exp(np.mean(np.log(other))):.2f} |")


if __name__ == "__main__":
    main()
