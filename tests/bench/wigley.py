"""Wigley hulls III and IV of Journée (1992): added mass, order over the mesh, and motions at rest beside his tests.

    python tests/bench/wigley.py

    y/(B/2) = (1 − ζ²)(1 − ξ²)(1 + 0.2 ξ²),  ξ = 2x/L,  ζ = z/d;   L = 3 m, d = 0.1875 m, B = 0.3 m (III), 0.6 m (IV)

J.M.J. Journée, Experiments and calculations on 4 Wigley hull forms in head waves, report 0909, Delft University of
Technology (1992): volumes; forced heave, Table 2-III, measured on a model towed at Fn 0.3; heave and pitch of the free
hull in head waves at Fn 0, Tables 10-III and 10-IV.  A calculation without speed is not in it: A₃₃/ρ∇ of another panel
code, Capytaine 3.0.0, on the same 2048 panels, stands beside.
"""

import contextlib
import io
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2])]
from hakobune.bem import DOFS
from hakobune.bem.database import open_database
from hakobune.meshing.files import write_mesh
from hakobune.meshing.panels import structured
from hakobune.pipelines import cli

LENGTH, DRAFT, GRAVITY, DENSITY = 3.0, 0.1875, 9.81, 1000.0
BEAM = {"III": 0.3, "IV": 0.6}
VOLUME = {"III": 0.0780, "IV": 0.1560}
FORCED = ((2.22, 0.707), (2.78, 0.537), (3.34, 0.465), (3.88, 0.425), (4.45, 0.421))  # ω√(L/g), A₃₃/ρ∇, hull III
OTHER = {2.22: 0.8474, 3.34: 0.4410, 4.45: 0.3912}  # Capytaine 3.0.0, 2048 panels; with 512: 0.8531, 0.4443, 0.3920
FREE = {"III": ((1.0, 0.29, 0.57), (1.5, 0.57, 0.57), (2.0, 0.74, 0.50)),  # λ/L, heave, pitch/(2π ζ/L)
        "IV": ((1.0, 0.30, 0.57), (1.5, 0.65, 0.69), (2.0, 0.79, 0.54))}  # fmt: skip
FIRST, LEVELS = (16, 4), 3


def wigley(beam, counts):
    """`PanelMesh` of half a hull; counts : panels along and down"""
    u, v = (np.arange(n + 1) / n for n in counts)
    xi, zeta = -np.cos(np.pi * u), np.sin(0.5 * np.pi * v)
    half = 0.5 * beam * np.outer((1 - xi**2) * (1 + 0.2 * xi**2), 1 - zeta**2)
    half[[0, -1]] = half[:, -1] = 0.0
    x, z = 0.5 * LENGTH * xi[:, None], -DRAFT * zeta
    points = np.stack(np.broadcast_arrays(x, half, z), axis=-1)
    return replace(structured(points), symmetry="y", name=f"Wigley hull, beam {beam:g} m")


def solved(beam, counts, folder, words):
    """`Database` of a hull from a mesh of so many panels"""
    mesh, path = Path(folder) / "wigley.msh", Path(folder) / f"{beam:g}_{counts[0]}.h5"
    write_mesh(wigley(beam, counts), mesh)
    volume = wigley(beam, counts).volume
    fixed = f"--depth inf --density {DENSITY} --gravity {GRAVITY} --gyration {0.35 * beam:.4g},0.75,0.75"
    with contextlib.redirect_stdout(io.StringIO()):
        assert cli.main(f"solve --mesh {mesh} {fixed} {words} --output {path}".split()) == 0
    return open_database(path), volume


def forced(folder):
    omega = np.array([w for w, _ in FORCED]) * np.sqrt(GRAVITY / LENGTH)
    words = f"--omega {','.join(f'{w:.6f}' for w in omega)} --only added_mass"
    made = [solved(BEAM["III"], tuple(2**i * n for n in FIRST), folder, words) for i in range(LEVELS)]
    A = np.array([np.diagonal(np.asarray(db["added_mass"]), axis1=1, axis2=2) for db, _ in made])
    order = np.log2(np.abs((A[1] - A[0]) / (A[2] - A[1])))
    print(f"volume {made[-1][1]:.5f} m³, printed {VOLUME['III']:g}")
    exact = VOLUME["III"] * DENSITY
    for i, (w, printed) in enumerate(FORCED):
        values = A[:, i, 2] / exact
        beside = f"; Capytaine {OTHER[w]:.4f} ({100 * (values[2] / OTHER[w] - 1):+.1f} %)" if w in OTHER else ""
        print(f"ω√(L/g) {w:4.2f}: A33/ρ∇ {values[0]:.4f} {values[1]:.4f} {values[2]:.4f}, order {order[i, 2]:.2f}; "
              f"measured {printed:.3f} ({100 * (values[2] / printed - 1):+.1f} %){beside}")  # fmt: skip
    for j, name in enumerate(DOFS):
        print(f"{name:6} order {' '.join(f'{p:.2f}' for p in order[:, j])}")


def free(folder):
    for hull, rows in FREE.items():
        omega = [np.sqrt(2 * np.pi * GRAVITY / (ratio * LENGTH)) for ratio, _, _ in rows]
        words = f"--omega {','.join(f'{w:.6f}' for w in omega)} --heading 180"
        db, volume = solved(BEAM[hull], tuple(2 * n for n in FIRST), folder, words)
        stored = np.asarray(db["omega"])
        X = np.abs(np.asarray(db["rao"])[[np.argmin(np.abs(stored - w)) for w in omega], 0])
        for (ratio, heave, pitch), motion in zip(rows, X, strict=True):
            turn = motion[4] * LENGTH / (2 * np.pi)
            print(f"hull {hull}, λ/L {ratio:g}: heave {motion[2]:.3f}, measured {heave:.2f}; pitch {turn:.3f}, "
                  f"measured {pitch:.2f}; volume {volume:.4f}, printed {VOLUME[hull]:.4f}")  # fmt: skip


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        forced(place)
        free(place)
