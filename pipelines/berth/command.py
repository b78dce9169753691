"""`hakobune berth`: the result as tables, the course in time as a file and a picture."""

from ..common.picture import PLOTS, check_picture
from ..results.records import check_records, write_records
from ..results.tables import printed
from .result import berth as found


def berth(study, database, output, plot):
    """Print a study; output : course in time, .csv, or all, .h5; plot : picture of it.  Returns the exit status.

    raises : ValueError, one line
    """
    check_records(output, "berth", [study, *([database] if database else [])])
    check_picture(plot, PLOTS)
    result = found(study, database)
    approach, course = result.detail
    written = [path for path in (output, plot) if path is not None and course is not None]
    if output in written:
        write_records(result, output)
    if plot in written:
        from .picture import draw

        draw(approach, course, plot)
    status = printed(result)
    for path in written:
        print(path)
    return status


def show_measured():
    """Print the fifty berthings of Ueda (1981) with the results of the method; returns 0"""
    from .measured import measured

    return printed(measured())
