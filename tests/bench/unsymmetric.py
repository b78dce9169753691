"""A hull without mirror planes beside Capytaine: seconds of processor of whole jobs, one thread each, in pairs.

    python tests/bench/unsymmetric.py FOLDER --peer PYTHON [--frequencies 8] [--repeats 3]

A skewed box of 784 panels in 20 m of water, four headings, added mass, damping, forces, motions and drift by us, the
first three by the peer, on the same panels with the same lid.  PYTHON has capytaine installed.
"""

from __future__ import annotations

import argparse
import os
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from two_ships import processor

from hakobune.bem.database import open_database
from hakobune.meshing.files import write_mesh
from hakobune.meshing.panels import PanelMesh

PEER = """
import sys
import numpy as np
import capytaine as cpt

given, out, omegas = np.load(sys.argv[1]), sys.argv[2], np.linspace(0.2, 1.2, int(sys.argv[3]))
mesh, lid = (cpt.Mesh(vertices=given[a], faces=given[b]) for a, b in (("points", "panels"), ("lid", "lid_panels")))
dofs = cpt.rigid_body_dofs(rotation_center=(0, 0, 0))
body = cpt.FloatingBody(mesh, dofs=dofs, lid_mesh=lid, center_of_mass=(0, 0, 0))
water = {"water_depth": 20.0, "rho": 1025.0, "g": 9.80665}
solver, results = cpt.BEMSolver(), []
for w in omegas:
    problems = [cpt.RadiationProblem(body=body, radiating_dof=d, omega=w, **water) for d in body.dofs]
    headings = np.radians([0, 45, 90, 135])
    problems += [cpt.DiffractionProblem(body=body, wave_direction=b, omega=w, **water) for b in headings]
    results += [solver.solve(problem, keep_details=False) for problem in problems]
np.savez(out, added_mass=cpt.assemble_dataset(results)["added_mass"].values)
"""


def skewed_box(along=24, across=16, down=5):
    """`PanelMesh` of a box 100 × 50 × 10 m whose sides are neither straight nor parallel, finer towards the edges"""
    x, y, z = (-np.cos(np.pi * np.arange(n + 1) / n) for n in (along, across, down))
    x, y, z = 50 * x, 25 * y, -5 * (1 + z)
    bottom = [[(a, c, -10), (a, d, -10), (b, d, -10), (b, c, -10)] for a, b in pairwise(x) for c, d in pairwise(y)]
    ring = [(a, y[0]) for a in x[:-1]] + [(x[-1], b) for b in y[:-1]]
    ring += [(a, y[-1]) for a in x[:0:-1]] + [(x[0], b) for b in y[:0:-1]]
    sides = [
        [(*p, a), (*p, b), (*q, b), (*q, a)]
        for p, q in zip(ring, ring[1:] + ring[:1], strict=True)
        for a, b in pairwise(z)
    ]
    points, corners = np.unique(np.round(np.reshape(bottom + sides, (-1, 3)), 9), axis=0, return_inverse=True)
    skew = points * np.column_stack([1 + 1e-3 * points[:, 1], 1 + 2e-3 * points[:, 0], np.ones(len(points))])
    return PanelMesh(skew, corners.reshape(-1, 4))


def main():
    options = argparse.ArgumentParser()
    options.add_argument("folder", type=Path)
    options.add_argument("--peer", required=True)
    options.add_argument("--frequencies", type=int, default=8)
    options.add_argument("--repeats", type=int, default=3)
    given = options.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    mesh, database = given.folder / "skew.gdf", given.folder / "skew.h5"
    write_mesh(skewed_box(), mesh)
    (given.folder / "peer.py").write_text(PEER)
    solve = [sys.executable, "-m", "hakobune", "solve", "--mesh", str(mesh), "--depth", "20", "--fresh"]
    solve += ["--omega", f"0.2:1.2:{given.frequencies}", "--heading", "0,45,90,135", "--gyration", "15,28,30"]
    solve += ["--output", str(database)]
    for _ in range(given.repeats):
        own = processor(solve, 1)
        db = open_database(database)
        of_lid = {"lid": db.lid.points, "lid_panels": db.lid.corners}
        np.savez(given.folder / "mesh.npz", points=db.mesh.points, panels=db.mesh.corners, **of_lid)
        job = [given.peer, "peer.py", "mesh.npz", "peer.npz", str(given.frequencies)]
        theirs = processor(job, 1, cwd=given.folder)
        load = f"load {os.getloadavg()[0]:.1f}"
        print(f"{load}; hakobune {own:.1f} s, peer {theirs:.1f} s: {own / theirs:.2f} times", flush=True)
    ours, others = db["added_mass"], np.load(given.folder / "peer.npz")["added_mass"]
    print(f"surge, first frequency: {ours[0, 0, 0]:.6g} and {others[0, 0, 0]:.6g} kg")


if __name__ == "__main__":
    main()
