"""Hostile and unlucky inputs through the real commands: what each answers, how long it takes and what it leaves.

    python tests/fuzz/commands.py --cases 800 --seed 1 --oversized --output answers.csv

A case is wrong that ends in a traceback or a signal, works for more than SECONDS without having said so, waits for
WAIT, takes more than MEMORY, fails without a message or with more than a few lines, leaves a file half-written, or
changes an input.  One that has said that it will take long is stopped.  Every command is run with good inputs before,
which compiles its kernels.  Prints what is wrong, and a table by status.
"""

from __future__ import annotations

import argparse
import collections
import csv
import hashlib
import itertools
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from inputs import COMMANDS, good_inputs, spoiled
from oversized import oversized

SECONDS, STOP, WAIT = 10.0, 12.0, 90.0  # of the processor, that a case may take without a word; on the clock
MEMORY, MOST = 4e3, 12e9  # MB, that a case may take; bytes of address space, beyond which it gets no more
TOLD = re.compile(r"about ((?:[\d.e+]+ (?:s|min|h|days|years) ?)+)|([^,|\n]+) left")
TIMES = re.compile(r"([\d.e+]+) (s|min|h|days|years)\b")  # as `pipelines.common.progress.duration` writes them
UNITS = {"s": 1, "min": 60, "h": 3600, "days": 86400, "years": 3e7}
READ = 10**6  # bytes of what is said; times are looked for in them
LARGE = 10**9  # bytes, of a file that is not looked at afterwards
MOST_LINES, MOST_LETTERS = 6, 6000  # of a message that refuses
START = "import sys; from hakobune.pipelines.start import main; sys.exit(main())"
COLUMNS = ("case", "status", "seconds", "processor_seconds", "megabytes", "wrong", "message")


class Answer(NamedTuple):
    """status : None if it had to be stopped; waited, worked : s on the clock and of the processor; MB at the peak"""

    status: int | None
    waited: float
    worked: float
    megabytes: float
    text: str

    @property
    def told(self):
        """s, that the command has said it will take; 0 if nothing was said"""
        times = [TIMES.findall(" ".join(found)) for found in TOLD.findall(self.text)]
        return max((sum(float(n) * UNITS[unit] for n, unit in parts) for parts in times), default=0.0)


def answered(words, folder):
    """`Answer` of a command in a folder, which is stopped after STOP s of the processor, or WAIT on the clock"""
    begin, worked, peak, status = time.perf_counter(), 0.0, 0.0, None
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            [sys.executable, "-c", START, *words], cwd=folder, stdout=said, stderr=said, stdin=subprocess.DEVNULL
        )
        resource.prlimit(process.pid, resource.RLIMIT_AS, (int(MOST), int(MOST)))
        while status is None and worked < STOP and time.perf_counter() - begin < WAIT:
            worked, peak = used(process.pid, worked, peak)
            done, how, usage = os.wait4(process.pid, os.WNOHANG)
            status = os.waitstatus_to_exitcode(how) if done else None
            time.sleep(0.005)
        if status is None:
            process.send_signal(signal.SIGKILL)
            _, _, usage = os.wait4(process.pid, 0)
        process.returncode = 0
        said.seek(0)
        text = said.read(READ).decode(errors="replace")
    return Answer(status, time.perf_counter() - begin, usage.ru_utime + usage.ru_stime, peak, text)


def used(process, worked, peak):
    """s of the processor and MB that a process has used; those known before where it has ended

    The peak that wait4 gives is that of the fork, which begins with all that its parent has.
    """
    try:
        times = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11:13]
        lines = Path(f"/proc/{process}/status").read_text().splitlines()
    except (OSError, ProcessLookupError):
        return worked, peak
    high = [int(line.split()[1]) / 1e3 for line in lines if line.startswith("VmHWM")]
    return sum(map(int, times)) / os.sysconf("SC_CLK_TCK"), max([peak, *high])


def wrong_with(answer, before, after):
    """What is wrong with an answer, "" if nothing is"""
    status, lines = answer.status, len(answer.text.strip().splitlines())
    if answer.worked > max(SECONDS, 3 * answer.told):
        return f"worked for {answer.worked:.0f} s" + (f", {answer.told:g} s were told" if answer.told else "")
    if answer.megabytes > MEMORY:
        return f"took {answer.megabytes / 1e3:.1f} GB"
    if status is None:
        return "" if answer.worked > SECONDS else f"waited for {answer.waited:.0f} s"
    if status < 0 or status not in (0, 1, 2):
        return f"status {status}"
    if "Traceback" in answer.text:
        return "traceback"
    if status == 2 and not 1 <= lines <= MOST_LINES:
        return f"a message of {lines} lines"
    if status == 2 and len(answer.text) > MOST_LETTERS:
        return f"a message of {len(answer.text)} letters"
    if any("partial" in name or ".tmp" in name for name in after):
        return "left a part of a file"
    lost = [name for name, mark in before.items() if after.get(name) != mark and name != "box.h5"]
    return f"changed {', '.join(lost)}" if lost and status else ""


def marks(folder):
    """{name: hash} of the regular files of a folder"""
    files = [path for path in folder.iterdir() if path.is_file() and not path.is_symlink()]
    files = [path for path in files if path.stat().st_size < LARGE]
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def campaign(cases, write):
    """Every case in a fresh folder; cases : (what, words, spoil); write : called with a row of COLUMNS"""
    with tempfile.TemporaryDirectory() as root:
        good, place = Path(root, "good"), Path(root, "here")
        good.mkdir()
        good_inputs(good)
        for line in COMMANDS:
            shutil.copytree(good, place)
            done = subprocess.run([sys.executable, "-c", START, *line.split()], cwd=place, capture_output=True)
            if done.returncode:
                print(f"not good, status {done.returncode}: {line}: {done.stderr.decode()[-200:]}", flush=True)
            shutil.rmtree(place)
        for what, words, spoil in cases:
            shutil.copytree(good, place)
            spoil(place)
            before = marks(place)
            answer = answered(words, place)
            wrong = wrong_with(answer, before, marks(place))
            last = " | ".join(line.strip() for line in answer.text.strip().splitlines()[-MOST_LINES:])
            numbers = round(answer.waited, 2), round(answer.worked, 2), round(answer.megabytes)
            write((what, "stopped" if answer.status is None else answer.status, *numbers, wrong, last[-400:]))
            shutil.rmtree(place)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=800)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--oversized", action="store_true", help="these first")
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
            counts[row[1], bool(row[5])] += 1
            if row[5]:
                print(*row, sep=" ; ", flush=True)

        cases = itertools.chain(oversized() if given.oversized else (), spoiled(given.seed, given.cases))
        campaign(cases, write)
    for (status, wrong), count in sorted(counts.items(), key=str):
        print(f"status {status}{', wrong' if wrong else ''}: {count}")
    return int(any(wrong for _, wrong in counts))


if __name__ == "__main__":
    sys.exit(main())
