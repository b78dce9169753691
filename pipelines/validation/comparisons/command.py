"""`hakobune compare`: the computed comparisons of the SR179 report (1982), in its units, as one result and pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ...scene.flags import _flag


def compare(
    which: Annotated[
        Literal["depth-series", "length-series", "sections", "motions", "models"],
        Parameter(help="comparison of the report"),
    ],
    /,
    *,
    output: Annotated[Path, _flag("folder, made if it is not there")] = Path("comparisons"),
    xi: Annotated[str | None, _flag("ξ_B = ω²B/2g: a,b,c or start:stop:count [the report's, and between]")] = None,
    fresh: Annotated[bool, Parameter(help="replace the databases that are there", negative="")] = False,
):
    """Repeat a comparison of the SR179 report (1982), in its units, as NAME.csv and pictures.

    depth-series: six depths, Figures 2.1.5.3-46; length-series: five L/B, 2.1.5.47-90; sections: three against two
    dimensions, 2.1.5.91-99; motions: 2.4.3.1-24; models: tank models M3A and M3B by five methods, 2.4.4.2-11.
    A second call solves nothing; sets in one folder share their databases.
    """
    from .sets import SETS, make

    return make(which, SETS[which], output, xi=xi, fresh=fresh)
