"""`hakobune bench`: error against time of the solvers, beside other programs where they are installed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .flags import _flag


def bench(
    *,
    output: Annotated[Path, _flag("folder, made if it is not there")] = Path("bench"),
    peer: Annotated[list[Path] | None, _flag("a Python that has capytaine or pyhams; may be given again")] = None,
    threads: Annotated[str, _flag("numbers of threads a,b; the first with every case")] = "1,2",
    only: Annotated[str | None, _flag("cases a,b: cylinder-15, -30, -100, box-12, -20, -100 [all]")] = None,
    quick: Annotated[bool, Parameter(help="few settings on two bodies", negative="")] = False,
):
    """Error against time of one frequency, cold and warm, with peak memory; every job in a process of its own.

    Cylinder of radius and draft 10 m (exact reference), box 100 x 50 x 10 m (contour method at 1e-7), in three depths
    each.  Writes bench.csv, bench.md and bench.png.  `make bench` installs the other programs and runs it.
    """
    from rich.console import Console

    from .bench.plan import PROGRAMS, plan
    from .bench.run import FILES
    from .bench.run import bench as run

    peers = _peers(peer or [])
    numbers = _threads(threads)
    jobs = plan(["hakobune", *(name for name in PROGRAMS if name in peers)], numbers, quick)
    jobs = _of_cases(jobs, only)
    console = Console()
    if not peers:
        console.print("no --peer: other programs are left out", highlight=False)
    output.mkdir(parents=True, exist_ok=True)
    rows = []
    try:
        rows = run(jobs, peers, output, console)
    except KeyboardInterrupt:
        console.print(f"interrupted; what was measured is in {output / FILES[0]}; the next run begins anew")
        return 130
    failed = sum(1 for row in rows if row.note)
    console.print("\n".join(str(output / name) for name in FILES), highlight=False, markup=False)
    if failed:
        console.print(f"{failed} of {len(rows)} failed; see the end of {output / FILES[1]}", highlight=False)
    return 1 if failed else 0


def _peers(pythons):
    """{program: (interpreter, version)}; the first interpreter that has a program is taken"""
    from .bench.measure import peers_of

    found = {}
    for python in pythons:
        for name, version in peers_of(python).items():
            found.setdefault(name, (python, version))
    return found


def _threads(text):
    try:
        numbers = [int(word) for word in text.split(",")]
    except ValueError:
        numbers = [0]
    if min(numbers) < 1 or len(set(numbers)) < len(numbers):
        raise ValueError(f"--threads is {text!r}; allowed: different whole numbers from 1, as 1,2")
    return numbers


def _of_cases(jobs, only):
    from .bench.cases import CASES

    if only is None:
        return jobs
    names = [word.strip() for word in only.split(",")]
    unknown = [name for name in names if name not in CASES]
    if unknown:
        raise ValueError(f"--only has {unknown[0]!r}; allowed: {', '.join(CASES)}")
    chosen = [job for job in jobs if job.case in names]
    if not chosen:
        raise ValueError(
            f"--only leaves nothing of this bench; it has {', '.join(dict.fromkeys(j.case for j in jobs))}"
        )
    return chosen
