"""The flags of `hakobune series`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter


def series(
    which: Literal["single-point"],
    /,
    *,
    output: Annotated[Path, Parameter(help="folder, made if it is not there")] = Path("series"),
    cases: Annotated[Path | None, Parameter(help="CSV of cases in place of the report's, with its columns")] = None,
    only: Annotated[str | None, Parameter(help="cases a,b,c of the table")] = None,
    seeds: Annotated[int, Parameter(help="records of waves, whose significant tensions are averaged")] = 1,
    fresh: Annotated[bool, Parameter(help="replace the databases that are there", negative="")] = False,
):
    """A design series of the SR179 report (1982) made again: table beside its prints, charts, its statements.

    single-point: floaters A and B on six to eighteen chains, contact and intermediate buoy, Tables 3.6.5.3 to 3.6.5.5.
    A second call solves nothing; every case is kept as a study for `hakobune single-point`.
    """
    from .single_point import make_series

    return make_series(output, cases, only, seeds, fresh)
