"""`hakobune single-point`: statics and criterion on the terminal, maps, a run in time, results and pictures."""

from pathlib import Path

from ..common.picture import PLOTS, check_picture
from ..results.output import check_result, write_result
from ..results.tables import printed
from .result import single_point


def single_point_command(study, database, output, picture):
    """Exit status.  Raises ValueError, one line, before anything is written."""
    check_result(output, "single-point", (study, *(() if database is None else (database,))))
    check_picture(picture, PLOTS)
    result = single_point(study, database)
    written = [*_pictures(result.detail, (study, output), picture), *((output,) if output is not None else ())]
    if output is not None:
        write_result(result, output)
    status = printed(result)
    for path in written:
        print(f"written: {path}")
    return status


def _pictures(found, names, picture):
    """Plan if requested, run and maps of a study that has them; their paths"""
    from . import maps, running

    if picture is not None:
        from .pictures import draw_plan

        draw_plan(found.study, found.point, found.rest, picture)
        yield picture
    if found.run is not None:
        path = _beside(*names, "run")
        running.draw(found.study, found.run, path)
        yield path
    for i, one in enumerate(found.maps, 1):
        path = _beside(*names, f"slewing{f'_{i}' if len(found.maps) > 1 else ''}")
        maps.draw(one, path)
        yield path


def _beside(study_path, output, word):
    """Path of a picture: beside the results, or in the current folder, named by the study.  Raises ValueError."""
    path = Path(f"{Path(study_path).stem}_{word}.png")
    path = path if output is None else output.with_name(f"{output.stem}_{word}.png")
    check_picture(path, PLOTS)
    return path
