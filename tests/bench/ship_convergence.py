"""Added mass of a ship over its panels, in proportion: python tests/bench/ship_convergence.py

Counts doubled twice; order of each coefficient from the three meshes, in the length of a panel.
"""

import argparse
import contextlib
import io
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2])]
from hakobune.bem import DOFS
from hakobune.bem.database import open_database
from hakobune.meshing.files import write_mesh
from hakobune.meshing.ship import ship
from hakobune.pipelines import cli

SIZES = (280.0, 40.0, 14.0, 0.62)
FIRST = (14, 3, 4)


def added_mass(counts, folder, omega):
    mesh, database = Path(folder) / "ship.msh", Path(folder) / f"{counts[0]}.h5"
    write_mesh(ship(*SIZES, counts=counts), mesh)
    words = f"solve --mesh {mesh} --depth inf --omega {omega} --only added_mass --output {database}"
    with contextlib.redirect_stdout(io.StringIO()):
        assert cli.main(words.split()) == 0
    return np.diag(np.asarray(open_database(database)["added_mass"])[0])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--omega", type=float, default=0.4)
    given = parser.parse_args()
    levels = [tuple(2**i * n for n in FIRST) for i in range(3)]
    with tempfile.TemporaryDirectory() as folder:
        A = np.array([added_mass(counts, folder, given.omega) for counts in levels])
    order = np.log2(np.abs((A[1] - A[0]) / (A[2] - A[1])))
    for name, row, p in zip(DOFS, A.T, order, strict=True):
        print(f"{name:6} " + "  ".join(f"{value:.5e}" for value in row) + f"   order {p:.2f}")
