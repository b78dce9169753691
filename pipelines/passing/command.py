"""`hakobune passing`: the result as tables, a picture of the forces, and a table for `hakobune simulate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

FADE = 0.125  # duration of the transition to zero before and after the passage, over that of the passage


def passing(
    study: Annotated[Path, Parameter(help="water, moored and passing ship, track (TOML)")],
    /,
    *,
    forces: Annotated[Path | None, Parameter(help="force over time for [[simulation.force]]: .csv")] = None,
    output: Annotated[Path | None, Parameter(help="result: .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="forces along the track: .png, .svg or .pdf")] = None,
):
    """Compute the forces on a moored ship while another ship passes on a parallel track.

    Both hulls are solved by panels in water of any depth, with or without a wall.  The study may select the faster
    methods of Wang (1975) or Kriebel (2005).
    hakobune passing passing_tanker.toml --plot passing.png --forces passing.csv
    """
    from hakobune.bem.database.file import check_place

    from ..common.outputs import check_ending
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, finish, write_result
    from .result import passing

    check_picture(plot, PLOTS)
    if forces is not None:
        check_ending(forces, (".csv",))
        check_place(forces)
    check_result(output, "passing", [study])
    return finish(passing(study), (forces, _table), (output, write_result), (plot, _draw))


def _table(result, path):
    """A CSV file that `[[simulation.force]]` reads: it begins and ends with zeros, so that the run may last longer"""
    import numpy as np

    from hakobune.meshing.whole_files import write_whole
    from hakobune.mooring.motion.given_forces import COLUMNS, faded

    given = result.detail.in_time
    given = faded(given, FADE * float(np.ptp(given.times)))
    rows = np.column_stack([given.times, given.force]) + 0.0  # no zeros below zero
    lines = [",".join(COLUMNS), *(",".join(f"{value:.10g}" for value in row) for row in rows)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _draw(result, path):
    """Surge and sway over the place of the passing ship, yaw below"""
    from matplotlib.figure import Figure

    from ..common.picture import save
    from ..common.units import KN
    from .result import LARGEST

    passage, figure = result.detail, Figure(figsize=(8.0, 6.0), layout="constrained")
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
