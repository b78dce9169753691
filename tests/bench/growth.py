"""How time and memory of whole commands grow: against panels, frequencies, headings, threads and processes.

    python tests/bench/growth.py [--output growth.png] [--repeats 1] [--quick] [--table FILE]

Box 100 × 50 × 10 m in 20 m of water, from the start of the process to its end, on one thread but where threads are what
is varied.  Against panels, frequencies and headings the time is that of the processor; against threads and processes it
is that of the wall, which means little on a busy machine.  Memory is the peak of the largest process.  Slopes are those
of the logarithms between the last two points: 1 is linear.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

ROOT = Path(__file__).parents[2]
BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --gyration 15,28,30 --fresh --output job.h5"
HAKOBUNE = [sys.executable, "-c", "import sys; from hakobune.pipelines.start import main; sys.exit(main())"]
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")


class Curve(NamedTuple):
    """What is varied, a name, the words of a job with {n} in place of it, its values, and whether threads are meant"""

    along: str
    name: str
    words: str
    values: tuple
    threads: bool = False


BY_PANELS = "--method panel --panels"
CURVES = (
    Curve("panels", "4 frequencies", f"{BY_PANELS} {{n}} --omega 0.4:1.0:4 --heading 0", (100, 200, 400, 800, 1600)),
    Curve("panels", "40, in a band", f"{BY_PANELS} {{n}} --omega 0.4:1.0:40 --heading 0", (400, 800, 1600)),
    Curve("frequencies", "contour", "--omega 0.2:1.2:{n} --heading 0", (2, 10, 40, 160, 640)),
    Curve("frequencies", "300 panels", f"{BY_PANELS} 300 --omega 0.2:1.0:{{n}} --heading 0", (2, 10, 40, 160)),
    Curve("frequencies", "800 panels", f"{BY_PANELS} 800 --omega 0.2:1.0:{{n}} --heading 0", (2, 5, 10, 40, 160)),
    Curve("headings", "contour, 10", "--omega 0.2:1.2:10 --heading 0:350:{n}", (2, 6, 18, 36, 72)),
    Curve("headings", "300 panels, 10", f"{BY_PANELS} 300 --omega 0.2:1.0:10 --heading 0:350:{{n}}", (2, 6, 18, 36)),
    Curve("threads", "800 panels, 4", f"{BY_PANELS} 800 --omega 0.4:1.0:4 --heading 0", (1, 2, 4, 8), True),
    Curve(
        "processes", "800 panels, 6", f"{BY_PANELS} 800 --omega 0.4:1.0:6 --heading 0 --executor processes:{{n}}",
        (1, 2, 4, 8),
    ),
)  # fmt: skip
BY_WALL = ("threads", "processes")


def measured(words, folder, threads):
    """Seconds by the wall, of the processor, and the peak of memory in MB, of a command.  Raises RuntimeError."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONPYCACHEPREFIX": f"{folder}/bytecode"}
    environment |= dict.fromkeys(THREADS, str(threads))
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    start = time.perf_counter()
    with open(Path(folder) / "said", "w+") as said:
        process = subprocess.Popen([*HAKOBUNE, *words.split()], cwd=folder, env=environment, stdout=said, stderr=said)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            said.seek(0)
            raise RuntimeError(f"{words}: {said.read()[-300:]}")
    return time.perf_counter() - start, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def curve(one, folder, repeats, some):
    """(n, 3) of `measured`, the least of the repeats, at the first `some` values"""
    cores, rows = len(os.sched_getaffinity(0)), []
    values = [n for n in one.values[:some] if one.along not in BY_WALL or n <= cores]
    for n in values:
        threads = n if one.threads else 1
        words = f"{BOX} {one.words.replace('{n}', str(n))}"
        rows.append(np.min([measured(words, folder, threads) for _ in range(repeats)], axis=0))
        wall, processor, memory = rows[-1]
        print(f"{one.along:12} {one.name:16} {n:6} {wall:9.2f} {processor:9.2f} s {memory:7.0f} MB", flush=True)
    return np.array(values), np.array(rows)


def slope(x, y):
    """Of the logarithms, between the last two points"""
    return np.log(y[-1] / y[-2]) / np.log(x[-1] / x[-2])


def draw(found, path):
    """A column for each thing varied: time above, memory below; found : [(Curve, values, rows)]"""
    from matplotlib.figure import Figure
    from matplotlib.ticker import NullFormatter, ScalarFormatter

    kinds = list(dict.fromkeys(one.along for one, *_ in found))
    figure = Figure(figsize=(2.7 * len(kinds) + 0.4, 5.4), layout="constrained")
    grid = figure.subplots(2, len(kinds), squeeze=False, sharex="col", sharey="row")
    for one, x, rows in found:
        above, below = grid[:, kinds.index(one.along)]
        seconds = rows[:, 0 if one.along in BY_WALL else 1]
        steep = f", slope {slope(x, seconds):.2f}" if len(x) > 1 else ""
        above.loglog(x, seconds, "o-", markersize=3, label=f"{one.name}{steep}")
        below.loglog(x, rows[:, 2], "o-", markersize=3)
    for kind, (above, below) in zip(kinds, grid.T, strict=True):
        below.set_xticks(sorted({n for one, x, _ in found if one.along == kind for n in x}))
        below.xaxis.set_major_formatter(ScalarFormatter())
        below.xaxis.set_minor_formatter(NullFormatter())
        above.set_title("s by the wall" if kind in BY_WALL else "s of the processor", fontsize=9)
        below.set_title("MB at the peak", fontsize=9)
        below.set_xlabel(kind)
        above.legend(fontsize=7, frameon=False, loc="upper left")
        for axis in (above, below):
            axis.grid(True, color="0.92", linewidth=0.6)
            axis.spines[["top", "right"]].set_visible(False)
    for axis, ticks in zip(grid[:, 0], ((1, 2, 5, 10, 20, 50), (200, 300, 500, 700)), strict=True):
        axis.set_yticks(ticks)
        axis.yaxis.set_major_formatter(ScalarFormatter())
        axis.yaxis.set_minor_formatter(NullFormatter())
    grid[0, 0].set_ylim(0.8, 50)
    figure.savefig(path, dpi=80, pil_kwargs={"optimize": True})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", default="growth.png")
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="the first two values of each")
    parser.add_argument("--table", help="draw what was printed before, a file, and measure nothing")
    parser.add_argument("--only", default="", help="curves along this")
    given = parser.parse_args()
    if given.table:
        return draw(again(Path(given.table).read_text()), given.output)
    with tempfile.TemporaryDirectory() as folder:
        measured(f"{BOX} --omega 0.5 --heading 0", folder, 1)
        measured(f"{BOX} --omega 0.5 --heading 0 --method panel --panels 100", folder, 1)
        chosen = [one for one in CURVES if given.only in one.along]
        found = [(one, *curve(one, folder, given.repeats, 2 if given.quick else None)) for one in chosen]
    return draw(found, given.output)


def again(table):
    """What was printed by `curve`, as `draw` takes it"""
    rows = [(line[:12].strip(), line[13:30].strip(), *line[30:].split()) for line in table.splitlines()]
    out = []
    for one in CURVES:
        own = np.array([[float(r[i]) for i in (2, 3, 4, 6)] for r in rows if r[:2] == (one.along, one.name)])
        if len(own):
            out.append((one, own[:, 0], own[:, 1:]))
    return out


if __name__ == "__main__":
    main()
