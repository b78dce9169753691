"""`hakobune single-point`: statics and criterion on the terminal, maps, a run in time, results and pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def single_point(
    study: Annotated[Path, Parameter(help="study of a body on a buoy or turret (TOML)")],
    /,
    *,
    database: Annotated[Path | None, Parameter(help="database of the body, for its masses and wave drift")] = None,
    output: Annotated[Path | None, Parameter(help="results, .h5 or .csv")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: plan of all equilibria, .png, .svg or .pdf")] = None,
):
    """Find all headings of rest of a body on a buoy or turret, whether the body slews (fishtails), and its line loads.

    [[maps]] of the study draw the growth of slewing over its numbers; [slewing] runs it in time.
    """
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, write_result
    from ..results.tables import printed
    from .result import single_point

    check_result(output, "single-point", (study, *(() if database is None else (database,))))
    check_picture(plot, PLOTS)
    result = single_point(study, database)
    written = [*_pictures(result.detail, (study, output), plot), *((output,) if output is not None else ())]
    if output is not None:
        write_result(result, output)
    status = printed(result)
    for path in written:
        print(f"written: {path}")
    return status


def _pictures(found, names, picture):
    """Plan if requested, run and maps of a study that has them; their paths"""
    from . import maps
    from .pictures import draw_plan, draw_run

    if picture is not None:
        draw_plan(found.study, found.point, found.rest, picture)
        yield picture
    if found.run is not None:
        path = _beside(*names, "run")
        draw_run(found.study, found.run, path)
        yield path
    for i, one in enumerate(found.maps, 1):
        path = _beside(*names, f"slewing{f'_{i}' if len(found.maps) > 1 else ''}")
        maps.draw(one, path)
        yield path


def _beside(study_path, output, word):
    """Path of a picture: beside the results, or in the current folder, named by the study.  Raises ValueError."""
    from ..common.picture import PLOTS, check_picture

    path = Path(f"{Path(study_path).stem}_{word}.png")
    path = path if output is None else output.with_name(f"{output.stem}_{word}.png")
    check_picture(path, PLOTS)
    return path
