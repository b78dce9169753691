"""Few solves for a band against 400 direct ones a thousand times as accurate: series box, 0.1 to 2 rad/s, 0.5 %.

Also what the transform of the retardation functions returns, by the same 400; the added mass at infinite frequency
that the stored band alone would give beside the one that is solved; and what a passive linear system makes of it.
Prints; about a minute.
"""

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np
from retardation import from_database, retardation

from hakobune.bem.database import open_database
from hakobune.bem.database.between_frequencies import between
from hakobune.bem.methods.panel_problem import prepare
from hakobune.bem.time_domain.memory import memory_of_database
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.problem import problem_of
from hakobune.pipelines.solve.run import solve

TOLERANCE, TIMES = 0.005, np.arange(0, 300.01, 0.1)
NAMES = ("added_mass", "radiation_damping", "excitation_force")


def off(name, found, exact):
    """Largest error relative to the largest of its kind"""
    if name == "excitation_force":
        return np.max(np.abs(found - exact) / np.abs(exact).max(axis=(0, 1)))
    scale = np.sqrt(np.einsum("nii->ni", exact).max(axis=0))
    return np.max(np.abs(found - exact) / np.outer(scale, scale))


def main():
    omega = np.linspace(0.1, 2.0, 400)
    for depth in (12.0, 20.0, 100.0):
        scene = make_scene(
            {
                "water": {"depth": depth},
                "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}],
                "waves": {"band": {"from": 0.1, "to": 2.0}, "headings_deg": [0, 45, 90]},
                "tolerance": TOLERANCE,
                "want": ["radiation", "diffraction", "added_mass_infinity"],
            }
        )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "box.h5"
            solve(scene, path)
            db = open_database(path)
            exact = direct(db, scene, omega)
            errors = [f"{name} {off(name, db.at(omega, name)[0], exact[name]):.2e}" for name in NAMES]
            deviation = between(db).largest_error(omega, NAMES).max()
            print(f"depth {depth:g} m: {len(db.omega)} solves;", ", ".join(errors), f"; deviation {deviation:.2e}")
            memory = from_database(db, TIMES)
            print(
                "    transform of the retardation functions:", of_both(memory.added_mass, memory.damping, omega, exact)
            )
            in_time(db, omega, exact)


def direct(db, scene, omega):
    """{name: (q, …)} solved at each omega"""
    body = prepare(replace(problem_of(db.header, scene), tolerance=TOLERANCE / 1000))
    rows = [body.run(w, db.wave_direction, set(NAMES), None, tuple(db["influenced_dof"])).result() for w in omega]
    return {name: np.array([row[name] for row in rows]) for name in NAMES}


def in_time(db, omega, exact):
    """Prints what follows from the retardation functions: added mass at infinite frequency, states"""
    dense = np.linspace(db.omega[0], db.omega[-1], 1200)
    A, B = (db.at(dense, name)[0] for name in NAMES[:2])
    fitted = retardation(dense, A, B, TIMES).added_mass_infinity
    limit = db["added_mass_infinity"]
    scale = np.sqrt(np.outer(limit.diagonal(), limit.diagonal()))
    apart = np.max(np.abs(fitted - limit) / scale)
    print(f"    added mass at infinite frequency from the band alone against the solved one: {apart:.2e}")
    for tolerance in (0.01, 0.003):
        passive = memory_of_database(db, tolerance)
        told = of_both(passive.added_mass, passive.damping, omega, exact)
        print(
            f"    {passive.states} states to {tolerance:g}: {told}, {passive.deviation.max():.1e} from the band itself"
        )


def of_both(added_mass, damping, omega, exact):
    """What functions of ω are off by, as text"""
    errors = (off(name, f(omega), exact[name]) for name, f in zip(NAMES, (added_mass, damping), strict=False))
    return "A {:.2e}, B {:.2e}".format(*errors)


if __name__ == "__main__":
    main()
