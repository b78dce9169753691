"""The flags of `hakobune series`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter


def series(
    which: Literal["single-point", "appendix-2", "dolphin"],
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
    appendix-2: the tests of model M3B at a single point, intermediate and contact buoy.
    dolphin: floaters A and B between dolphins with fenders, section 3.7.5, by the design spectrum method.
    A second call solves nothing; every case is kept as a study for `hakobune single-point`.
    """
    if which == "appendix-2":
        from .appendix_2 import make_appendix

        if cases is not None or seeds != 1:
            raise ValueError("--cases and --seeds are of single-point; allowed here: --only, --output, --fresh")
        return make_appendix(output, only, fresh)
    if which == "dolphin":
        from .dolphin import make_series

        for name, value in (("cases", cases), ("only", only), ("seeds", None if seeds == 1 else seeds)):
            if value is not None:
                raise ValueError(f"--{name} is given with dolphin; allowed: with single-point")
        return make_series(output, fresh)
    from .single_point import make_series

    return make_series(output, cases, only, seeds, fresh)
