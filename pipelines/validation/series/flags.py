"""`hakobune series`: a design series of the SR179 report (1982) made again, each a study of this program.

A module of SERIES has `make(folder, …)`, which gives its Result, and may have `pictures(result)`, those that the report
has, as {name: arguments of `picture.draw`}.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

SERIES = {"single-point": ("only", "seeds"), "multi-point": ("only", "seeds", "hours"), "appendix-1": ("only", "seeds"),
          "appendix-2": ("only",), "dolphin": ("quay",), "lines": ()}  # fmt: skip
LEAST = {"seeds": (1, 100), "hours": (0.1, 24.0)}


def series(
    which: Annotated[
        Literal["single-point", "multi-point", "appendix-1", "appendix-2", "dolphin", "lines"],
        Parameter(help="series of the report"),
    ],
    /,
    *,
    output: Annotated[Path, Parameter(help="folder, made if it is not there")] = Path("series"),
    only: Annotated[str | None, Parameter(help="cases a,b,c, or beginnings of their names: A, B-sinker, …")] = None,
    seeds: Annotated[int | None, Parameter(help="number of wave records for the statistics [1]")] = None,
    hours: Annotated[float | None, Parameter(help="multi-point: duration of each run, h [3]")] = None,
    quay: Annotated[
        float | None, Parameter(help="dolphin: distance from the hull to a quay behind, m", allow_leading_hyphen=True)
    ] = None,
    fresh: Annotated[bool, Parameter(help="replace the databases that are there", negative="")] = False,
):
    """Repeat a design series of the SR179 report (1982): compare its numbers with ours, draw its charts, check its
    statements.

    single-point: floaters A and B on six to eighteen chains, contact and intermediate buoy, Tables 3.6.5.3 to 3.6.5.5.
    multi-point: A and B on chain, with a buoy or a sinker, over sea, depth, period and number of lines (section 3.5.5):
    simplified method beside simulation, long-period motion by quick rule, spectrum and simulation. appendix-1: the
    tests of models M3A and M3B on four lines, chain and sinker, and Table 3.5.3.2. appendix-2: the tests of model M3B
    at a single point, intermediate and contact buoy. dolphin: floaters A and B between dolphins with fenders, section
    3.7.5, by the design spectrum method, and Table 3.7.5.2 in time; with --quay 25 charts in front of a quay, compared
    with open water. lines: static lines, charts 1.7.1 to 1.7.6: friction, scope, slope, hills, sinker and buoys,
    elasticity. A second call solves only what is new; every case is stored as a study for `hakobune single-point`, or
    `simulate`.
    """
    from ...common.outputs import check_folder
    from ...results.output import check_result, write_result
    from ...results.tables import printed
    from ..picture import draw

    given = {"only": only, "seeds": seeds, "hours": hours, "quay": quay}
    given = {name: value for name, value in given.items() if value is not None}
    _check(which, given)
    module = import_module(f"{__package__}.{which.replace('-', '_')}")
    check_folder(output)
    table = output / f"{which}.csv"
    if output.is_dir():
        check_result(table, f"series {which}")
    result = module.make(output, **given, fresh=fresh)
    output.mkdir(parents=True, exist_ok=True)
    write_result(result, table)
    made = getattr(module, "pictures", lambda _: {})(result)
    paths = [table, *(draw(output / name, *words) for name, words in made.items())]
    status = printed(result)
    print(*(f"written: {path}" for path in paths), sep="\n")
    return status


def _check(which, given):
    """Raise ValueError for a flag of another series, or out of its bounds"""
    for name, value in given.items():
        if name not in SERIES[which]:
            users = ", ".join(one for one, names in SERIES.items() if name in names)
            raise ValueError(f"--{name} is given with {which}; allowed: with {users}")
        low, high = LEAST.get(name, (None, None))
        if low is not None and not low <= value <= high:
            raise ValueError(f"--{name} is {value:g}; allowed: {low:g} to {high:g}")
