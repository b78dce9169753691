"""`hakobune breakwater`: what a floating breakwater lets pass, what its lines carry, how large its anchors are."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

ENDINGS = (".csv", ".h5", ".hdf5")
WIDTH = 160  # in a pipe


def breakwater(
    study: Annotated[Path, Parameter(help="study of a breakwater (TOML)")],
    /,
    *,
    output: Annotated[Path | None, Parameter(help=".csv of the curves, or .h5 of everything")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
    database: Annotated[Path | None, Parameter(help="of a unit of finite length along x, for [map]")] = None,
    map_plot: Annotated[Path | None, Parameter(help="picture of the waves around it: .png, .svg or .pdf")] = None,
):
    """A floating breakwater in two dimensions: transmission, a sea behind it, line tensions, pretension, anchors.

    With a database of a unit of finite length, the waves around a row of them.

    Status 1 where a line goes slack, no pretension is allowed, an anchor is too small, or no design is good enough.
    """
    from rich.console import Console

    from ..common.outputs import check_output
    from ..common.picture import PLOTS, check_picture
    from ..printing.console import new_console
    from .build import Breakwater
    from .files import is_breakwater, write_csv, write_h5
    from .measured import read_measured
    from .report import show
    from .results import results
    from .study import read_breakwater

    if output is not None:
        check_output(output, "the result of a breakwater", is_breakwater, ENDINGS, [study])
    for picture in (plot, map_plot):
        if picture is not None:
            check_picture(picture, PLOTS)
    read, text = read_breakwater(study)
    _check_map(read, database, map_plot)
    measured = None if read.measured is None else read_measured(Path(study).parent / read.measured)
    asked = Breakwater(read)
    found = results(asked)
    if read.optimisation is not None:
        from .pareto import front

        with Console(stderr=True).status("designs are tried"):
            found = found._replace(front=front(read))
    if database is not None:
        from hakobune.bem.database import open_database

        from .lee import lee

        around = lee(asked, open_database(database))
        found = found._replace(lee=around, warned=[*found.warned, *around.warned])
    if output is not None:
        write_csv(output, read, found) if output.suffix == ".csv" else write_h5(output, asked, text, found)
    if plot is not None:
        from .picture import draw

        draw(plot, asked, found, measured)
    if map_plot is not None:
        from .map_picture import draw_map

        draw_map(map_plot, read.name, found.lee)
    return show(_wide(new_console()), read, found, [path for path in (output, plot, map_plot) if path is not None])


def _check_map(study, database, map_plot):
    from ..common.quantities import StudyError

    if study.map is not None and database is None:
        raise StudyError("the study has a [map]; give --database of a unit of finite length, or leave the table out")
    if study.map is None and (database is not None or map_plot is not None):
        raise StudyError("the study has no [map]; add one, or leave --database and --map-plot out")


def _wide(console):
    """A console that cuts no numbers where there is no terminal"""
    from ..printing.console import new_console

    return console if console.is_terminal else new_console(width=WIDTH)
