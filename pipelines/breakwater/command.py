"""`hakobune breakwater`: what a floating breakwater lets pass, what its lines carry, how large its anchors are."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

ENDINGS = (".csv", ".h5", ".hdf5")
WIDTH = 160  # in a pipe


def breakwater(
    study: Path,
    /,
    *,
    output: Annotated[Path | None, Parameter(help=".csv of the curves, or .h5 of everything")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """A floating breakwater in two dimensions: transmission, a sea behind it, line tensions, pretension, anchors.

    Status 1 where a line goes slack, no pretension is allowed, or an anchor is too small.
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
    if plot is not None:
        check_picture(plot, PLOTS)
    read, text = read_breakwater(study)
    measured = None if read.measured is None else read_measured(Path(study).parent / read.measured)
    asked = Breakwater(read)
    found = results(asked)
    if read.optimisation is not None:
        from .pareto import front

        with Console(stderr=True).status("designs are tried"):
            found = found._replace(front=front(read))
    if output is not None:
        write_csv(output, read, found) if output.suffix == ".csv" else write_h5(output, asked, text, found)
    if plot is not None:
        from .picture import draw

        draw(plot, asked, found, measured)
    show(_wide(new_console()), read, found, [path for path in (output, plot) if path is not None])
    return int(_fails(found))


def _wide(console):
    """A console that cuts no numbers where there is no terminal"""
    from rich.console import Console

    return console if console.is_terminal else Console(width=WIDTH)


def _fails(found):
    held = found.pretension
    if held is not None and (held.slack or (held.most is not None and held.most < max(held.least, held.used))):
        return True
    return any(one.utilisation is not None and one.utilisation > 1 for one in found.anchors)
