"""A simulation that is killed again and again ends in the file of one that was not.

    python tests/pipelines/kill_simulation.py STUDY DATABASE [--kills 20] [--seeds 40] [--duration S] [--seed 1]

The command runs once in peace; then it is killed (SIGKILL) at random instants after its start, and run until it is
done.  With --longer the file killed holds shorter runs at first, which are made again.
Files are compared byte by byte.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]


def command(given, output, share=1.0):
    """Words of the simulation into a file, of a share of its duration"""
    words = ["simulate", given.study, "--database", given.database, "--output", output, "--seeds", given.seeds]
    words += ["--duration", share * given.duration]
    return [sys.executable, "-m", "hakobune.pipelines.cli", *map(str, words)]


def killed(given, output, wait):
    """Whether the run was killed after `wait` s, or had ended before"""
    run = subprocess.Popen(command(given, output), cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        run.wait(wait)
        return False
    except subprocess.TimeoutExpired:
        run.kill()
        run.wait()
        return True


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path)
    parser.add_argument("database", type=Path)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seeds", type=int, default=40)
    parser.add_argument("--duration", type=float, default=600.0)
    parser.add_argument("--longer", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    given.study, given.database = given.study.resolve(), given.database.resolve()
    rng = np.random.default_rng(given.seed)
    with tempfile.TemporaryDirectory() as folder:
        whole, torn, short = (Path(folder) / f"{name}.h5" for name in ("whole", "torn", "short"))
        started = time.perf_counter()
        subprocess.run(command(given, whole), cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        length, count = time.perf_counter() - started, 0
        if given.longer:
            subprocess.run(command(given, short, 0.5), cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
            shutil.copy(short, torn)
        while count < given.kills:
            if killed(given, torn, rng.uniform(0.05, 0.5) * length):
                count += 1
            else:
                torn.unlink()  # it was done: begin again
                if given.longer:
                    shutil.copy(short, torn)
        subprocess.run(command(given, torn), cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        same = whole.read_bytes() == torn.read_bytes()
    print(f"{count} kills of a run of {length:.1f} s: the files are {'the same' if same else 'NOT THE SAME'}")
    sys.exit(not same)
