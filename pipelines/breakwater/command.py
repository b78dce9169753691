"""`hakobune breakwater`: transmission of a floating breakwater, tensions of its lines, sizes of its anchors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def breakwater(
    study: Annotated[Path, Parameter(help="study of a breakwater (TOML)")],
    /,
    *,
    output: Annotated[Path | None, Parameter(help="results: .h5, or .csv of their tables")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
    database: Annotated[Path | None, Parameter(help="database of a unit of finite length along x, for [map]")] = None,
    map_plot: Annotated[Path | None, Parameter(help="picture of the waves around the unit: .png, .svg or .pdf")] = None,
):
    """Compute a floating breakwater in two dimensions: transmission, sea behind it, tensions, pretension, anchors.

    With a database of one unit of finite length it computes the waves around a row of them.

    Status 1 if a line goes slack, no pretension is allowed, an anchor is too small, or no design meets the target.
    """
    from rich.console import Console

    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, write_result
    from ..results.tables import printed
    from .result import breakwater as found

    check_result(output, "breakwater", [study])
    for picture in (plot, map_plot):
        check_picture(picture, PLOTS)
    if map_plot is not None and database is None:
        raise ValueError(
            "--map-plot is given without --database; give --database of a unit of finite length, and [map] in the study"
        )
    with Console(stderr=True).status("it is computed"):
        result = found(study, database)
    read, asked, made, measured = result.detail
    if output is not None:
        write_result(result, output)
    if plot is not None:
        from .picture import draw

        draw(plot, read, asked, made, measured)
    if map_plot is not None:
        from .map_picture import draw_map

        draw_map(map_plot, read.name, made.lee)
    status = printed(result)
    written = [str(path) for path in (output, plot, map_plot) if path is not None]
    if made.lee is not None and map_plot is None:
        print("the waves around the unit are in the table and the results; --map-plot map.png draws them")
    if written:
        print(f"written: {', '.join(written)}")
    return status
