"""`hakobune earthquake`: the result as tables, the course in time as a file, a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def earthquake(
    study: Annotated[Path, Parameter(help="body, fenders and the earthquake (TOML)")],
    /,
    *,
    database: Annotated[
        Path | None, Parameter(help="database of the body, for its mass and the memory of the water")
    ] = None,
    output: Annotated[Path | None, Parameter(help="time series, .csv, or all results, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute the reaction of the fenders of a floating body when the ground under its dolphins moves.

    It compares the seismic coefficient of a rule, a response spectrum and a record in time, and shows the normalised
    reaction over frequency.  hakobune earthquake earthquake_box.toml --plot earthquake.png
    """
    from ..common.picture import PLOTS, check_picture
    from ..common.quantities import StudyError
    from ..results.output import finish
    from ..results.records import check_records, is_hdf5, write_records
    from .result import earthquake

    check_records(output, "earthquake", [study, *([database] if database else [])])
    check_picture(plot, PLOTS)
    result = earthquake(study, database)
    if output is not None and not is_hdf5(output) and result.detail.ground is None:
        raise StudyError(
            "--output is a time series, which needs [record] in the study; give [record], or an .h5 file as --output"
        )
    kept = output is None or "course.body" in result or is_hdf5(output)
    status = finish(result, (output if kept else None, write_records), (plot, _draw))
    if not kept:
        print(f"warning: {output} is not written, since the record gave no time series")
    return status


def _draw(result, path):
    """Normalised reaction over the period; with a record, body, ground and reaction over time"""
    import numpy as np
    from matplotlib.figure import Figure

    from ..common.picture import save
    from ..common.units import KN

    run, quake, T = "course.body" in result, result.detail, np.geomspace(0.1, 50.0, 400)
    figure = Figure(figsize=(8.0, 9.0 if run else 4.5), layout="constrained")
    axes = np.atleast_1d(figure.subplots(3 if run else 1))
    for name, k in zip(result.labels["stiffness"].values, result["stiffness.value"], strict=True):
        axes[0].loglog(T, quake.normalised(T, k), label=name)
    axes[0].axhline(1.0, color="grey", linewidth=0.8, linestyle=":", label="seismic coefficient")
    axes[0].set(xlabel="period of the ground, s", ylabel="reaction/(ω² y M)")
    axes[0].grid(alpha=0.3, which="both")
    axes[0].legend(title="stiffness of the dolphins at")
    if run:
        time = result.labels["time"].values
        axes[1].plot(time, result["course.ground"], label="ground")
        axes[1].plot(time, result["course.body"], label="body")
        axes[1].set(ylabel="displacement, m")
        axes[1].legend()
        axes[2].plot(time, result["course.reaction"] / KN)
        axes[2].set(ylabel="reaction on the dolphins, kN", xlabel="time, s")
    save(figure, path, 110)
