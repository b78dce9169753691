"""`hakobune passing`: the result as tables, a picture of the forces, and a table for `hakobune simulate`."""

import numpy as np

from ..common.outputs import check_ending
from ..common.picture import PLOTS, check_picture, save
from ..common.units import KN
from ..results.tables import printed
from .result import LARGEST
from .result import passing as found


def passing(study, forces, output, plot):
    """Print a passage, write it to files; returns the exit status.  Raises ValueError, one line."""
    check_picture(plot, PLOTS)
    if forces is not None:
        from hakobune.bem.database.file import check_place

        check_ending(forces, (".csv",))
        check_place(forces)
    if output is not None:
        from ..results.output import check_result

        check_result(output, "passing", [study])
    result = found(study)
    if forces is not None:
        _table(result.detail.in_time, forces)
    if output is not None:
        result.write(output)
    if plot is not None:
        _draw(result.detail, plot)
    status = printed(result)
    for path in (path for path in (forces, output, plot) if path is not None):
        print(path)
    return status


def _table(given, path):
    """A CSV file that `[[simulation.force]]` reads"""
    from hakobune.meshing.whole_files import write_whole
    from hakobune.mooring.motion.given_forces import COLUMNS

    rows = np.column_stack([given.times, given.force])
    lines = [",".join(COLUMNS), *(",".join(f"{value:.10g}" for value in row) for row in rows)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _draw(passage, path):
    """Surge and sway over the place of the passing ship, yaw below"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 6.0), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    for name, style in (("surge", "-"), ("sway", "--")):
        above.plot(passage.stagger, passage.force[:, LARGEST[name]] / KN, style, label=name)
    below.plot(passage.stagger, passage.force[:, LARGEST["yaw"]] / KN, "k-", label="yaw")
    above.set(ylabel="force, kN", title="force on a moored ship during a passage")
    below.set(xlabel="passing ship ahead of the moored one by, m", ylabel="moment, kN m")
    for axis in (above, below):
        axis.grid(alpha=0.3)
        axis.legend()
    save(figure, path, 110)
