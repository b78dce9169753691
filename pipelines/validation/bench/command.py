"""`hakobune bench`: error against time of the solvers, beside other programs where they are installed."""

from __future__ import annotations

import os
import sys
from functools import partial
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from hakobune.mooring.criteria.failing import fails

from ...common.bounds import told
from ...printing.verdict import tell
from ...scene.flags import _flag

SECONDS = 15.0  # s, approximate time of a job


def _plain(text):
    return Parameter(help=text, negative="")


def bench(
    *,
    output: Annotated[Path, _flag("folder, made if it is not there")] = Path("bench"),
    peer: Annotated[list[Path] | None, _plain("a Python with capytaine or pyhams; may be given again")] = None,
    threads: Annotated[str | None, _flag("a,b; the first with every case [1,2; with --quick 1]")] = None,
    only: Annotated[str | None, _flag("cases a,b: cylinder-15, -30, -100, box-12, -20, -100 [all]")] = None,
    quick: Annotated[bool, _plain("few settings on two bodies, with what is compiled already")] = False,
):
    """Measure error against time of one frequency, cold and warm, with peak memory; each job in its own process.

    Cylinder of radius and draft 10 m (exact reference), box 100 x 50 x 10 m (contour method at 1e-7), in three depths
    each.  Writes bench.csv and bench.png.  `make bench` installs the other programs and runs it.
    """
    from ...common.outputs import check_folder
    from ...results.output import check_result
    from ...results.tables import printed
    from .plan import PROGRAMS, plan
    from .run import FILES
    from .run import bench as run

    peers = _peers(peer or [])
    numbers = _threads(threads or ("1" if quick else "1,2"))
    jobs = plan(["hakobune", *(name for name in PROGRAMS if name in peers)], numbers, quick)
    jobs = _of_cases(jobs, only)
    if output.exists() and not output.is_dir():
        raise ValueError(f"--output {output} is a file; allowed: a folder")
    check_folder(output)
    output.mkdir(parents=True, exist_ok=True)
    check_result(output / FILES[0], "bench")
    told(f"{len(jobs)} jobs take", SECONDS * len(jobs))
    if not peers:
        print("no --peer: other programs are left out")
    try:
        made, rows = run(jobs, peers, output, partial(print, file=sys.stderr, flush=True), own_caches=quick)
    except KeyboardInterrupt:
        print(f"interrupted; what was measured is in {output}, the same command begins anew", file=sys.stderr)
        return 130
    printed(made)
    print(*(output / name for name in FILES), sep="\n")
    failed = sum(1 for row in rows if row.note)
    said = f"{failed} of {len(rows)} jobs have no answer: {output / FILES[0]} has why"
    return tell([fails(said)] if failed else [])


def _peers(pythons):
    """{program: (interpreter, version)}; the first interpreter with a program is used"""
    from .measure import peers_of

    found = {}
    for python in pythons:
        for name, version in peers_of(python).items():
            found.setdefault(name, (python, version))
    return found


def _threads(text):
    most = max(os.cpu_count() or 1, 2)
    try:
        numbers = [int(word) for word in text.split(",")]
    except ValueError:
        numbers = [0]
    if not 1 <= min(numbers) <= max(numbers) <= most or len(set(numbers)) < len(numbers):
        shown = text if len(text) <= 40 else f"{text[:40]}…"
        raise ValueError(f"--threads is {shown!r}; allowed: different whole numbers from 1 to {most}, such as 1,2")
    return numbers


def _of_cases(jobs, only):
    from .cases import CASES

    if only is None:
        return jobs
    names = [word.strip() for word in only.split(",")]
    unknown = [name for name in names if name not in CASES]
    if unknown:
        raise ValueError(f"--only has {unknown[0]!r}; allowed: {', '.join(CASES)}")
    chosen = [job for job in jobs if job.case in names]
    if not chosen:
        there = ", ".join(dict.fromkeys(job.case for job in jobs))
        raise ValueError(f"--only {only} leaves nothing to do; allowed with --quick: {there}")
    return chosen
