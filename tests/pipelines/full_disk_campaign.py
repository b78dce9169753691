"""Fill the disk and kill the run, again and again; with space again the same command must give the same file.

    python tests/pipelines/full_disk_campaign.py --kills 200        (as root, on Linux: it mounts a small tmpfs)

A disk of random size, from too small for any file to just large enough, more frequencies or fewer, which make a wider
file beside the old one, and SIGKILL at a random instant, for some runs after their end.  A run that ends by itself on
a full disk must say so in one line with status 1.  After every ROUND kills the disk grows, the command finishes, and
every dataset is compared bit by bit with those of an undisturbed run.
"""

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from kill_campaign import _assert_readable, _finish, _start, compared

# by the contour method, where no frequency depends on which others are asked for
WORDS = shlex.split(
    "box --length 100 --beam 50 --draft 10 --depth 20 --method contour --gyration 15.55,29.44,32.28 "
    "--heading 0,30 --only radiation,limits,diffraction,kochin,motions,drift --omega 0.2:1.0:60"
)
OMEGAS = [repr(float(omega)) for omega in np.linspace(0.2, 1.0, 60)]  # of WORDS
ROUND = 10  # kills before the disk grows
LARGE = 65_536  # KiB


def mounted(folder):
    folder.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={LARGE}k", "tmpfs", str(folder)], check=True)


def resize(folder, kib):
    """Give the disk another size; not below what is on it"""
    used = sum(os.stat(path).st_blocks // 2 for path in folder.iterdir()) + 64
    subprocess.run(["mount", "-o", f"remount,size={max(kib, used)}k", str(folder)], check=True)


def killed(path, count, delay):
    """(status, what was said) of a run of `count` frequencies that is killed after `delay` s, if not ended before"""
    run = _start([*WORDS[:-1], ",".join(OMEGAS[:count])], path)
    time.sleep(delay)
    run.kill()
    said = run.communicate()[1]
    return run.returncode, said


def campaign(folder, kills, seed=0):
    """(runs, how many ended full, lines on what went wrong)"""
    random, whole, disk = np.random.default_rng(seed), folder / "whole.h5", folder / "disk"
    _finish(WORDS, whole)
    seconds, need = _finish(WORDS, whole), whole.stat().st_size // 1024
    mounted(disk)
    path, full, wrong = disk / "box.h5", 0, []
    try:
        for number in range(1, kills + 1):
            resize(disk, int(random.uniform(0, 2.2 * need)))
            status, said = killed(path, int(random.integers(1, 61)), random.uniform(0.3, 1.5 * seconds))
            full += status == 2
            if status not in (-9, 0, 2) or (status == 2 and len(said.strip().splitlines()) > 1):
                wrong.append(f"run {number}: status {status}: {said[-300:]!r}")
            _assert_readable(path)
            if number % ROUND == 0 or number == kills:
                resize(disk, LARGE)
                _finish(WORDS, path)
                count, different = compared(whole, path)
                left = [part.name for part in disk.iterdir() if part != path]
                if different or left:
                    wrong.append(f"after run {number}: {different} of {count} datasets differ, left behind: {left}")
                path.unlink()
    finally:
        subprocess.run(["umount", "-l", str(disk)], check=True)
    return kills, full, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        kills, full, wrong = campaign(Path(folder), given.kills, given.seed)
    print(
        f"{kills} runs, {full} of them ended by a full disk before they were killed, {len(wrong)} wrong",
        *wrong,
        sep="\n",
    )
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
