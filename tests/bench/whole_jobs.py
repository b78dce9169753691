"""Seconds of whole commands, from the start of the process to its end: by the wall and of the processor.

    python tests/bench/whole_jobs.py [--repeats 3] [--only contour] [--cold] [--peer /path/of/python/with/capytaine]

Box 100 × 50 × 10 m in 20 m of water, one heading; each row is the least of its repeats.  Modules are read as bytecode,
as an installation has them, whatever PYTHONDONTWRITEBYTECODE says.  With --cold, kernels are compiled into an empty
cache once before, which is the row's own time.  With --peer Capytaine solves 992 uniform panels of the same box in the
same run, from the start of its process to its end, with a lid and both planes of symmetry.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
SCENES = ROOT / "pipelines" / "scenes"
BOX = ["box", "--length", "100", "--beam", "50", "--draft", "10", "--depth", "20", "--gyration", "15,28,30"]
READ = "from hakobune.bem.database import open_database; open_database('stored.h5')['added_mass']"
PEER = """
import capytaine as cpt, numpy as np
cpt.set_logging("ERROR")
whole = cpt.mesh_parallelepiped((100, 50, 20), resolution=(32, 16, 10), reflection_symmetry=True)
mesh, dofs = whole.immersed_part(), cpt.rigid_body_dofs(rotation_center=(0, 0, 0))
body = cpt.FloatingBody(mesh, dofs=dofs, lid_mesh=mesh.generate_lid(), center_of_mass=(0, 0, 0))
solver = cpt.BEMSolver()
for omega in np.linspace(0.2, 1.2, {count}):
    water = dict(body=body, omega=omega, water_depth=20.0)
    problems = [cpt.RadiationProblem(radiating_dof=dof, **water) for dof in body.dofs]
    for problem in [*problems, cpt.DiffractionProblem(wave_direction=0.0, **water)]:
        solver.solve(problem, keep_details=False)
"""


def solving(count, *more):
    """Words of a job of `count` frequencies"""
    return [
        *BOX,
        "--omega",
        f"0.2:1.2:{count}" if count > 1 else "0.6",
        "--heading",
        "0",
        "--fresh",
        "--output",
        "job.h5",
        *more,
    ]


def jobs(stored):
    """{name: words} of the rows; stored : a database with all headings that the studies need"""
    studies = {
        "check": ["check", stored],
        "plot": ["plot", stored, "--output", "plot.png"],
        "response": ["response", SCENES / "response_box_20m.toml", "--database", stored],
        "moor": ["moor", SCENES / "moor_chain_12.toml", "--database", stored],
        "lines": ["lines", SCENES / "lines_barge.toml"],
        "line": ["line", "--weight", "1000", "--length", "300", "--depth", "50", "--span", "280"],
    }
    rows = {f"contour, {count} frequencies": solving(count) for count in (1, 40, 200)}
    rows |= {f"panels at 1 %, {count}": solving(count, "--method", "panel") for count in (1, 40)}
    rows |= {f"944 panels, {count}": solving(count, "--panels", "944") for count in (4, 40)}
    return rows | studies | {"--help": ["--help"]}


def seconds(words, folder, environment):
    """(wall, processor) of a command.  Raises RuntimeError if it fails."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([str(w) for w in words], cwd=folder, env=environment, capture_output=True, text=True)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode > bool({"moor", "response"} & {*words}):  # where 1 is their verdict
        raise RuntimeError(f"{words}: {done.stderr.strip()[-300:]}")
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def tell(name, times):
    """Print a row"""
    wall, processor = times
    print(f"{name:28} {wall:8.2f} {processor:10.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--only", default="", help="rows with this in their name")
    parser.add_argument("--cold", action="store_true")
    parser.add_argument("--peer", help="a python with capytaine")
    given = parser.parse_args()
    hakobune = [sys.executable, "-c", "import sys; from hakobune.pipelines.start import main; sys.exit(main())"]
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONPYCACHEPREFIX": f"{folder}/bytecode"}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        stored = Path(folder) / "stored.h5"
        make = [*BOX, "--omega", "0.2:1.2:40", "--heading", "0:330:12", "--output", stored]
        seconds([*hakobune, *make], folder, environment)
        print(f"{'job':28} {'wall':>8} {'processor':>10}  s")
        for name, words in jobs(stored).items():
            if given.only not in name:
                continue
            if given.cold:
                cold = {**environment, "HAKOBUNE_CACHE": tempfile.mkdtemp(dir=folder)}
                tell(f"{name}, cold", seconds([*hakobune, *words], folder, cold))
            runs = [seconds([*hakobune, *words], folder, environment) for _ in range(given.repeats)]
            tell(name, map(min, zip(*runs, strict=True)))
        if given.only in "database to array":
            runs = [seconds([sys.executable, "-c", READ], folder, environment) for _ in range(given.repeats)]
            tell("database to array", map(min, zip(*runs, strict=True)))
        for count in (4, 40) if given.peer else ():
            words = [given.peer, "-c", PEER.replace("{count}", str(count))]
            tell(f"Capytaine, {count}", seconds(words, folder, dict(os.environ)))


if __name__ == "__main__":
    main()
