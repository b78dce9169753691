"""Errors of a ship by panels over how they are shared out, beside a mesh of 3 500: python tests/bench/ship_panels.py

Largest errors at three wavelengths (two lengths of the ship, two thirds and a quarter), in per cent of their own size:
of the diagonal of added mass and of damping (at least of a fiftieth of ω added mass), and of the forces over headings.
"""

import contextlib
import io
import os
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2])]
from hakobune.bem.database import open_database
from hakobune.meshing.files import write_mesh
from hakobune.meshing.ship import ship
from hakobune.pipelines import cli

# length, beam, draft, block coefficient, depth of water
SHIPS = {"tanker": (230.0, 40.0, 14.0, 0.82, 28.0), "carrier": (145.0, 23.0, 8.4, 0.79, 11.0)}
FINE = 60, 9, 20
COUNTS = (40, 5, 6), (32, 5, 8), (28, 4, 10), (24, 5, 11), (24, 4, 13), (20, 4, 8), (20, 3, 6), (14, 3, 6), (12, 3, 4)


def solved(sizes, depth, counts):
    """Diagonals of added mass and of damping over ω, and forces, (frequencies, headings, 6)"""
    write_mesh(ship(*sizes, counts=counts), "ship.msh")
    k = 2 * np.pi / sizes[0] * np.array([0.5, 1.5, 4])
    omega = np.sqrt(9.80665 * k * np.tanh(k * depth))
    words = f"solve --mesh ship.msh --depth {depth} --omega {','.join(f'{w:.5f}' for w in omega)} --heading 30,90 "
    words += "--only added_mass,radiation_damping,excitation_force --output s.h5 --fresh"
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        cli.main(words.split())
    db = open_database("s.h5")
    A, B = (np.einsum("fii->fi", np.asarray(db[name])) for name in ("added_mass", "radiation_damping"))
    return A, B / omega[:, None], np.asarray(db["excitation_force"])


def errors(found, true):
    (A, B, X), (A0, B0, X0) = found, true
    each = np.abs((A - A0) / A0), np.abs(B - B0) / np.maximum(np.abs(B0), 0.02 * np.abs(A0))
    return *each, np.abs(X - X0).max(axis=1) / np.abs(X0).max(axis=1)


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())
    for name, (*sizes, depth) in SHIPS.items():
        true = solved(sizes, depth, FINE)
        print(f"{name}: surge, sway, heave, roll, pitch, yaw, %", flush=True)
        for n, across, down in COUNTS:
            rows = errors(solved(sizes, depth, (n, across, down)), true)
            words = "  ".join(
                f"{what} " + " ".join(f"{100 * value:5.2f}" for value in row.max(axis=0))
                for what, row in zip("ABX", rows, strict=True)
            )
            print(f"{n:3} {across} {down:2}, {2 * n * (across + down):4} panels: {words}", flush=True)
