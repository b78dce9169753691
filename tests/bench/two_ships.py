"""Two ships side by side beside Capytaine: equal panels, frequencies and water, seconds of processor of whole jobs.

    python tests/bench/two_ships.py FOLDER --peer PYTHON [--panels 3000] [--frequencies 40] [--depth 30]

Both write added mass, damping and forces of one heading; neither has lids.  PYTHON has capytaine installed, whose
frequencies take equally long: with --peer-frequencies it solves so many, and its time is that of all in proportion.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
from pathlib import Path

SCENE = """
want = ["radiation", "diffraction"]
panels = {panels}
lid = false
method = "panel"

[water]
depth = {depth}

[[bodies]]
name = "one"
shape = "ship"
length = 120.0
beam = 20.0
draft = 8.0
block = 0.75
place = [0.0, 13.0, 0.0]

[[bodies]]
name = "other"
shape = "ship"
length = 120.0
beam = 20.0
draft = 8.0
block = 0.75
place = [5.0, -13.0, 0.0]

[waves]
omegas = {{ from = 0.3, to = 1.2, count = {frequencies} }}
headings_deg = [90]
"""
PEER = """
import sys
import numpy as np
import capytaine as cpt

points, panels, body = (np.load(sys.argv[1])[k] for k in ("points", "panels", "body"))
depth, out = float(sys.argv[2]), sys.argv[3]
omegas = np.linspace(0.3, 1.2, int(sys.argv[4]))
bodies = []
for i, name in enumerate(("one", "other")):
    mesh = cpt.Mesh(vertices=points, faces=panels[body == i], name=name)
    one = cpt.FloatingBody(mesh=mesh, name=name, dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)))
    bodies.append(one)
both = bodies[0] + bodies[1]
solver = cpt.BEMSolver()
water = {"water_depth": depth, "rho": 1025.0, "g": 9.80665}
problems = [cpt.DiffractionProblem(body=both, wave_direction=np.pi / 2, omega=w, **water) for w in omegas]
problems += [cpt.RadiationProblem(body=both, radiating_dof=d, omega=w, **water) for w in omegas for d in both.dofs]
results = solver.solve_all(problems, keep_details=False)
data = cpt.assemble_dataset(results)
np.savez(out, added_mass=data["added_mass"].values)
"""


def processor(command, threads, **more):
    """Seconds of processor that a command took, with so many threads"""
    limits = {name: str(threads) for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, env={**os.environ, **limits}, stdout=subprocess.DEVNULL, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    options = argparse.ArgumentParser()
    options.add_argument("folder", type=Path)
    options.add_argument("--peer")
    options.add_argument("--panels", type=int, default=3000)
    options.add_argument("--frequencies", type=int, default=40)
    options.add_argument("--depth", type=float, default=30.0)
    options.add_argument("--peer-frequencies", type=int)
    given = options.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    scene, database = given.folder / "ships.toml", given.folder / "ships.h5"
    scene.write_text(SCENE.format(**vars(given)))
    database.unlink(missing_ok=True)
    solve = [sys.executable, "-m", "hakobune", "solve", str(scene), "--output", str(database)]
    print(f"load {os.getloadavg()[0]:.1f}; hakobune {processor(solve, 1):.1f} s", flush=True)
    if given.peer:
        import numpy as np

        from hakobune.bem.database import open_database

        db = open_database(database)
        np.savez(given.folder / "mesh.npz", points=db.mesh.points, panels=db.mesh.corners, body=db.mesh.body)
        (given.folder / "peer.py").write_text(PEER)
        some = given.peer_frequencies or given.frequencies
        job = [given.peer, "peer.py", "mesh.npz", str(given.depth), "peer.npz", str(some)]
        taken = processor(job, 1, cwd=given.folder)
        print(f"load {os.getloadavg()[0]:.1f}; peer {taken:.1f} s of {some} frequencies", flush=True)
        ours, others = db["added_mass"], np.load(given.folder / "peer.npz")["added_mass"]
        print(f"surge of the first, first frequency: {ours[0, 0, 0]:.6g} and {others[0, 0, 0]:.6g} kg")


if __name__ == "__main__":
    main()
