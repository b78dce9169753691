"""The flags of `hakobune series`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter


def series(
    which: Annotated[
        Literal["single-point", "multi-point", "appendix-1", "appendix-2", "dolphin", "lines"],
        Parameter(help="series of the report"),
    ],
    /,
    *,
    output: Annotated[Path, Parameter(help="folder, made if it is not there")] = Path("series"),
    cases: Annotated[Path | None, Parameter(help="CSV of cases in place of the report's, with its columns")] = None,
    only: Annotated[str | None, Parameter(help="cases a,b,c of the table; multi-point: A, B-sinker, …")] = None,
    seeds: Annotated[int, Parameter(help="records of waves, over which statistics are taken")] = 1,
    hours: Annotated[float | None, Parameter(help="multi-point: of each run in time [3]")] = None,
    quay: Annotated[
        float | None, Parameter(help="dolphin: m from the hull to a quay behind", allow_leading_hyphen=True)
    ] = None,
    fresh: Annotated[bool, Parameter(help="replace the databases that are there", negative="")] = False,
):
    """A design series of the SR179 report (1982) made again: table beside its prints, charts, its statements.

    single-point: floaters A and B on six to eighteen chains, contact and intermediate buoy, Tables 3.6.5.3 to 3.6.5.5.
    multi-point: A and B on chain, with a buoy or a sinker, over sea, depth, period and number of lines (section 3.5.5):
    simplified method beside simulation, long-period motion by quick rule, spectrum and simulation.
    appendix-1: the tests of models M3A and M3B on four lines, chain and sinker, and Table 3.5.3.2.
    appendix-2: the tests of model M3B at a single point, intermediate and contact buoy.
    dolphin: floaters A and B between dolphins with fenders, section 3.7.5, by the design spectrum method, and
    Table 3.7.5.2 in time; with --quay 25 the charts before a quay, beside those of open water.
    lines: static lines, charts 1.7.1 to 1.7.6: friction, scope, slope, hills, sinker and buoys, elasticity.
    A second call makes what is not there; every case is kept as a study for `hakobune single-point`, or `simulate`.
    """
    taken = {"single-point": {"cases", "only", "seeds"}, "multi-point": {"only", "seeds", "hours"},
             "appendix-1": {"only", "seeds"}, "appendix-2": {"only"}, "dolphin": {"quay"}, "lines": set()}  # fmt: skip
    given = {"cases": cases, "only": only, "seeds": None if seeds == 1 else seeds, "hours": hours, "quay": quay}
    for name, value in given.items():
        if value is not None and name not in taken[which]:
            users = ", ".join(one for one, names in taken.items() if name in names)
            raise ValueError(f"--{name} is given with {which}; allowed: with {users}")
    if which == "multi-point":
        from .multi_point import make_series

        return make_series(output, only, seeds, 3.0 if hours is None else hours, fresh)
    if which == "appendix-1":
        from .appendix_1 import make_appendix

        return make_appendix(output, only, seeds, fresh)
    if which == "appendix-2":
        from .appendix_2 import make_appendix

        return make_appendix(output, only, fresh)
    if which == "dolphin":
        from .dolphin import make_series

        return make_series(output, fresh, quay)
    if which == "lines":
        from .line_charts import make_series

        return make_series(output)
    from .single_point import make_series

    return make_series(output, cases, only, seeds, fresh)
