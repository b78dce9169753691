"""Hostile and unlucky inputs through the real commands: what each answers, how long it takes and what it leaves.

    python tests/fuzz/commands.py --cases 800 --seed 1 --output answers.csv

A case is wrong that ends in a traceback or a signal, takes longer than it may, fails without a message or with more
than a few lines, leaves a file half-written, or changes an input.  Prints these, and a table by status.
"""

from __future__ import annotations

import argparse
import collections
import csv
import hashlib
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from inputs import good_inputs, spoiled

SECONDS = 10.0
MOST_LINES = 6  # of a message that refuses
START = "import sys; from pipelines.start import main; sys.exit(main())"
COLUMNS = ("case", "status", "seconds", "megabytes", "wrong", "message")


def answered(words, folder, seconds=SECONDS):
    """(status, seconds, MB at the peak, what was said) of a command in a folder; status None if it had to be stopped"""
    begin = time.perf_counter()
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            [sys.executable, "-c", START, *words], cwd=folder, stdout=said, stderr=said, stdin=subprocess.DEVNULL
        )
        status = None
        while status is None and time.perf_counter() - begin < seconds + 5:
            done, how, used = os.wait4(process.pid, os.WNOHANG)
            status = os.waitstatus_to_exitcode(how) if done else None
            time.sleep(0.005)
        if status is None:
            process.send_signal(signal.SIGKILL)
            _, _, used = os.wait4(process.pid, 0)
        process.returncode = 0
        said.seek(0)
        text = said.read().decode(errors="replace")
    return status, time.perf_counter() - begin, used.ru_maxrss / 1e3, text


def wrong_with(status, seconds, text, before, after):
    """What is wrong with an answer, "" if nothing is"""
    if status is None or seconds > SECONDS:
        return f"took {seconds:.0f} s"
    if status < 0 or status not in (0, 1, 2):
        return f"status {status}"
    if "Traceback" in text:
        return "traceback"
    if status == 2 and not 1 <= len(text.strip().splitlines()) <= MOST_LINES:
        return f"a message of {len(text.strip().splitlines())} lines"
    if any("partial" in name or ".tmp" in name for name in after):
        return "left a part of a file"
    lost = [name for name, mark in before.items() if after.get(name) != mark and name != "box.h5"]
    return f"changed {', '.join(lost)}" if lost and status else ""


def marks(folder):
    """{name: hash} of the regular files of a folder"""
    files = [path for path in folder.iterdir() if path.is_file() and not path.is_symlink()]
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def campaign(cases, seed, write):
    """Every case in a fresh folder; write : called with a row of COLUMNS"""
    with tempfile.TemporaryDirectory() as root:
        good, place = Path(root, "good"), Path(root, "here")
        good.mkdir()
        good_inputs(good)
        for what, words, spoil in spoiled(seed, cases):
            shutil.copytree(good, place)
            spoil(place)
            before = marks(place)
            status, seconds, megabytes, text = answered(words, place)
            wrong = wrong_with(status, seconds, text, before, marks(place))
            last = " | ".join(line.strip() for line in text.strip().splitlines()[-MOST_LINES:])
            write((what, status, round(seconds, 2), round(megabytes), wrong, last[-400:]))
            shutil.rmtree(place)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=800)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, default=Path("answers.csv"))
    given = parser.parse_args()
    counts = collections.Counter()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with given.output.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(COLUMNS)

        def write(row):
            rows.writerow(row)
            file.flush()
            counts[row[1], bool(row[4])] += 1
            if row[4]:
                print(*row, sep=" ; ", flush=True)

        campaign(given.cases, given.seed, write)
    for (status, wrong), count in sorted(counts.items(), key=str):
        print(f"status {status}{', wrong' if wrong else ''}: {count}")
    return int(any(wrong for _, wrong in counts))


if __name__ == "__main__":
    sys.exit(main())
