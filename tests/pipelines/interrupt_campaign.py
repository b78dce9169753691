"""Ctrl-C at any moment of a command, from its first: one line, status 130, and no file half-written.

    python tests/pipelines/interrupt_campaign.py --times 100

Prints a line for each outcome that is not this.  Status 1 if there was one.
"""

import argparse
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

START = "import sys; from hakobune.pipelines.start import main; sys.exit(main())"
BOX = "box --length 20 --beam 10 --draft 2 --depth 8 --omega 0.5:1.5:4 --heading 0 --output"
FIRST = 0.15  # s, before which Python itself may not have begun


def interrupted_after(seconds, folder):
    """(status, what was said on stderr) of a command that gets SIGINT after so long"""
    command = [sys.executable, "-c", START, *BOX.split(), str(Path(folder) / "box.h5")]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    time.sleep(seconds)
    process.send_signal(signal.SIGINT)
    return process.wait(timeout=120), process.stderr.read()


def campaign(times, longest, seed=1):
    """Lines on what went otherwise, and how often a command was at work"""
    moments, wrong, hit = random.Random(seed), [], 0
    for _ in range(times):
        seconds = moments.uniform(FIRST, longest)
        with tempfile.TemporaryDirectory() as folder:
            status, said = interrupted_after(seconds, folder)
            left = [path.name for path in Path(folder).iterdir() if path.name != "box.h5"]
        hit += status == 130
        if status not in (0, 130) or len(said.splitlines()) > 1 or left:
            wrong.append(f"after {seconds:.3f} s: status {status}, files {left}, said {said[-300:]!r}")
    return wrong, hit


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--times", type=int, default=100)
    parser.add_argument("--longest", type=float, default=1.5, help="s")
    given = parser.parse_args()
    wrong, hit = campaign(given.times, given.longest)
    print(*wrong, f"{given.times} times, {hit} of them interrupted, {len(wrong)} wrong", sep="\n")
    sys.exit(1 if wrong else 0)
