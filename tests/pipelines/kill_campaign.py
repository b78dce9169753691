"""Kill a run again and again, let the same command go on, and compare with a run that nobody disturbed.

    python tests/pipelines/kill_campaign.py --kills 25

The signal is SIGKILL and falls at random instants: while modules load, while the mesh is made, while a frequency
is solved or stored.  Every dataset of the two files is then compared bit by bit; only wall times may differ.
"""

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

COMPILING = shlex.split(
    "box --length 100 --beam 50 --draft 10 --depth 20 --panels 60 --gyration 15.55,29.44,32.28 "
    "--heading 0,30 --only radiation,limits,diffraction,motions,drift,pressure --omega 0.5"
)
WORDS = [*COMPILING[:-1], "0.2:1.0:60"]
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
TIMES = {"wall_time", "row_checksum"}  # the only numbers that differ from run to run, and what follows from them


@dataclass(frozen=True)
class Campaign:
    """What became of it: where the kills fell, and the datasets that differ from those of an undisturbed run."""

    before_the_file: int
    while_solving: int
    compared: int
    different: tuple[str, ...]

    def __str__(self):
        kills = self.before_the_file + self.while_solving
        return (
            f"{kills} kills in a row: {self.before_the_file} before there was a file, {self.while_solving} with "
            f"work to go; {self.compared} datasets compared bit by bit, {len(self.different)} different "
            f"{' '.join(self.different)}".rstrip()
        )


def campaign(folder, kills, seed=0):
    """Run the command until it was killed `kills` times in a row, then to its end; returns the Campaign.

    The signal comes, at the latest, when half a `kills`-th of the work beyond loading and meshing is done, so that
    none of the runs comes to its end, even if the machine is busier while the work is timed.
    """
    folder, random = Path(folder), np.random.default_rng(seed)
    _finish(COMPILING, folder / "compiled.h5")
    whole, path = folder / "whole.h5", folder / "killed.h5"
    seconds, loading = _finish(WORDS, whole), _finish(WORDS, whole)
    longest = loading + (seconds - loading) / (2 * kills)
    early = late = 0
    for delay in random.uniform(0, longest, kills):
        _kill(path, delay)
        _assert_readable(path)
        early, late = early + (not path.exists()), late + path.exists()
    _finish(WORDS, path)
    _assert_clean(path)
    return Campaign(early, late, *compared(whole, path))


def compared(one, other):
    """Number of datasets in two HDF5 files, and the names of those that are not the same bit by bit."""
    with h5py.File(one) as a, h5py.File(other) as b:
        names = [set(_datasets(file)) - TIMES for file in (a, b)]
        different = names[0] ^ names[1]
        different |= {name for name in names[0] & names[1] if a[name][()].tobytes() != b[name][()].tobytes()}
    return len(names[0] | names[1]), tuple(sorted(different))


def _datasets(file):
    names = []
    file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
    return [name for name in names if file[name].dtype != object]


def _start(words, path):
    command = [sys.executable, "-m", "hakobune.pipelines.cli", *words, "--output", str(path)]
    return subprocess.Popen(
        command, env={**os.environ, **ONE_THREAD}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )


def _finish(words, path):
    """Run to the end; returns the seconds it took."""
    start = time.perf_counter()
    run = _start(words, path)
    said = run.communicate()[1]
    if run.returncode:
        raise RuntimeError(f"status {run.returncode}: {said}")
    return time.perf_counter() - start


def _kill(path, delay):
    """Start the command and kill it after `delay` s.  Raises RuntimeError if it had ended before."""
    run = _start(WORDS, path)
    time.sleep(delay)
    run.kill()
    said = run.communicate()[1]
    if run.returncode != -9:
        raise RuntimeError(f"ended before its kill with status {run.returncode}: {said}")


def _assert_readable(path):
    from hakobune.bem.database import open_database

    if path.exists():
        open_database(path)


def _assert_clean(path):
    left = [part.name for part in path.parent.glob("*.partial*")]
    if left:
        raise RuntimeError(f"left behind: {', '.join(left)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=25)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        outcome = campaign(folder, arguments.kills, arguments.seed)
    print(outcome)
    return 1 if outcome.different else 0


if __name__ == "__main__":
    sys.exit(main())
