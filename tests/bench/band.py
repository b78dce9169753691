"""Few solves for a band against 400 direct ones: series box in three depths, 0.1 to 2 rad/s to half a per cent.

Also what the transform of the retardation functions returns, by the same 400.  Prints; about a minute.
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np

from bem.database import open_database
from bem.retardation import from_database
from bem.setup import prepare
from pipelines.hull import setup_of
from pipelines.run import solve
from pipelines.scene import make_scene

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
                "tolerance": 0.005,
                "want": ["radiation", "diffraction", "added_mass_infinity"],
            }
        )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "box.h5"
            solve(scene, path)
            db = open_database(path)
            body = prepare(setup_of(db.header, scene))
            rows = [
                body.run(w, db.wave_direction, set(NAMES), None, tuple(db["influenced_dof"])).result() for w in omega
            ]
            exact = {name: np.array([row[name] for row in rows]) for name in NAMES}
            errors = [f"{name} {off(name, db.at(omega, name)[0], exact[name]):.2e}" for name in NAMES]
            memory = from_database(db, np.arange(0, 300.01, 0.1))
            back = off("added_mass", memory.added_mass(omega), exact["added_mass"])
            back_damping = off("radiation_damping", memory.damping(omega), exact["radiation_damping"])
        print(f"depth {depth:g} m: {len(db.omega)} solves;", ", ".join(errors))
        print(f"    transform of the retardation functions: A {back:.2e}, B {back_damping:.2e}")


if __name__ == "__main__":
    main()
