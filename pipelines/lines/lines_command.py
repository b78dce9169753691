"""`hakobune lines`: a system of lines from a file → its result, a picture, a MoorDyn file."""

from pathlib import Path

from hakobune.bem.database.file import check_place

from ..common.picture import PLOTS, check_picture
from ..common.quantities import StudyError
from ..printing.verdict import tell
from ..results.output import check_result, write_result
from ..results.tables import printed
from .lines_result import check_asked, lines_of
from .system_file import read_given


def lines_command(file, depth, output, picture, moordyn, **asked):
    """Run the system of a file; asked : the words of `lines_result.lines`; returns the exit status.

    raises : ValueError, with a message of one line
    """
    check_picture(picture, PLOTS)
    check_result(output, "lines", [file])
    if moordyn is not None:
        check_place(moordyn)
    check_asked(asked["offset"], asked["directions"])
    given = read_given(file, depth)
    exported = None if moordyn is None else _moordyn_file(given, moordyn)
    try:
        result = lines_of(given, **asked)
    except ValueError:
        tell(given.said)  # the possible cause
        raise
    written = _written(result, output, picture, moordyn, exported)
    status = printed(result)
    for path in written:
        print(f"written: {path}")
    return status


def _moordyn_file(given, path):
    """The MoorDynFile of a system, before the solution; its messages are added to those of reading"""
    from hakobune.mooring.formats.moordyn_writing import moordyn_of_system

    from ..results.heard import heard

    if Path(path).exists():
        raise StudyError(f"{path} exists and is not replaced; give another name")
    with heard() as said:
        made = moordyn_of_system(given.system, given.moordyn)
    given.said.extend(said)
    return made


def _written(result, output, picture, moordyn, exported):
    if output is not None:
        write_result(result, output)
    if picture is not None:
        from .pictures import draw_system

        state, curves, losses = result.detail
        kept = {name: left for name, left in losses.items() if not isinstance(left, Exception)}
        draw_system(state, picture, curves, kept)
    if exported is not None:
        from hakobune.mooring.formats.moordyn import write_moordyn

        write_moordyn(exported, moordyn)
    return [path for path in (output, picture, moordyn) if path is not None]
