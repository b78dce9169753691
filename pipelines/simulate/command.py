"""`hakobune simulate`: runs into the file, tables on the terminal, pictures beside the file."""

import sys
from concurrent.futures import BrokenExecutor
from pathlib import Path

from ..common.quantities import StudyError
from ..executors.beside import processors
from ..executors.choice import Here
from ..results.tables import printed
from .file import is_run, opened, whole_rows
from .pictures import draw_run, prepare
from .result import NoWholeRun
from .result import simulate as found

NOTHING = "interrupted before a seed was finished; nothing is stored yet, and the same command starts again"


def simulate(study, database, output, seeds=None, duration=None, fresh=False, executor="local", window=None,
             methods=False, division=None, pictures=True):  # fmt: skip
    """Exit status: 0, 1 where a seed, a line or a fender fails, 130 interrupted.  Raises ValueError before any output.

    window : s, length of the windows in which the first record is reported
    methods, division : from `methods.compared`; pictures : whether they are drawn
    """
    from ..printing.console import new_console

    console = new_console()
    if division is not None and not methods:
        raise StudyError("--division is given without --methods; give both")
    if seeds is not None and seeds < 1:
        raise StudyError(f"--seeds is {seeds}; allowed: a whole number from 1")
    artist = _artist() if pictures else None
    try:
        result = found(study, database, output, seeds=seeds, duration=duration, fresh=fresh, executor=executor,
                       window=window, console=console)  # fmt: skip
        if methods:
            from .methods import compared

            result = compared(result, study, database, duration, division)
        drawing = artist.submit(draw_run, output) if pictures else None
        status = printed(result, console)
        drawn = _names(drawing, output) if pictures else []
    except NoWholeRun as none:
        for line in none.args[1]:
            console.print(line, highlight=False, soft_wrap=True, markup=False)
        return 1
    except KeyboardInterrupt:
        raise KeyboardInterrupt(*(() if _has_seeds(output) else (NOTHING,))) from None
    finally:
        if pictures:
            artist.shutdown(wait=False)
    console.print(f"written: {', '.join([str(output), *drawn])}", highlight=False, soft_wrap=True, markup=False)
    return status


def _artist():
    """The executor that draws: another process, which loads matplotlib meanwhile, if there is a processor for it"""
    if processors() < 2 or "matplotlib.figure" in sys.modules:
        return Here()
    from ..executors.processes import Processes

    artist = Processes(1)
    artist.submit(prepare)
    return artist


def _names(drawing, output):
    """Names of the pictures, drawn here if the process that should draw them has been killed"""
    try:
        return drawing.result()
    except BrokenExecutor:
        return draw_run(output)


def _has_seeds(output):
    if not is_run(Path(output)):
        return False
    with opened(output) as file:
        return bool(whole_rows(file).any())
