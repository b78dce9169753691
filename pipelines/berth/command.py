"""`hakobune berth`: the result as tables, the course in time as a file and a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def berth(
    study: Annotated[Path | None, Parameter(help="ship, approach and fenders (TOML)")] = None,
    /,
    *,
    database: Annotated[Path | None, Parameter(help="database of the ship, for the memory of the water")] = None,
    output: Annotated[Path | None, Parameter(help="time series, .csv, or all results, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
    measured: Annotated[
        bool,
        Parameter(negative=(), help="compare with the fifty measured berthings of Ueda (1981); no study is needed"),
    ] = False,
):
    """Compute the energy of a berthing ship, the reaction of its fenders, and its course in time.

    hakobune berth berth_tanker.toml --plot berth.png
    """
    from ..common.picture import PLOTS, check_picture
    from ..results.output import finish
    from ..results.records import check_records, write_records
    from .result import berth

    if measured == (study is not None):
        raise ValueError(f"a study and --measured: {'both are' if measured else 'neither is'} given; give one of them")
    if measured:
        from .measured import measured as fifty

        given = [name for name, value in (("database", database), ("output", output), ("plot", plot)) if value]
        if given:
            raise ValueError(f"--{given[0]} is given with --measured; it needs a study")
        return finish(fifty())
    check_records(output, "berth", [study, *([database] if database else [])])
    check_picture(plot, PLOTS)
    result = berth(study, database)
    in_time = result.detail[1] is not None
    return finish(result, *([(output, write_records), (plot, _draw)] if in_time else []))


def _draw(result, path):
    """Forces and deflections of the fenders, and energies, in time"""
    from matplotlib.figure import Figure

    from ..common.picture import save
    from ..common.units import KN

    approach, course = result.detail  # `study.Approach`, `mooring.berthing.memory.Berthing`
    figure = Figure(figsize=(8.0, 8.0), layout="constrained")
    force, deep, energy = figure.subplots(3, sharex=True)
    for k, (fender, x, _) in enumerate(approach.meetings):
        label = f"{fender.name}, x = {x:g} m"
        force.plot(course.time, course.reaction[:, k] / KN, label=label)
        deep.plot(course.time, course.deflection[:, k], label=label)
    energy.plot(course.time, course.taken / KN, label="stored and dissipated in fenders")
    energy.plot(course.time, course.lost / KN, label="in waves")
    energy.axhline(approach.energy / KN, linewidth=0.8, linestyle=":", color="grey", label="kinetic-energy method")
    force.set(ylabel="reaction, kN", title=f"C_M {course.virtual_mass:.3f}")
    deep.set(ylabel="deflection, m")
    energy.set(ylabel="energy, kJ", xlabel="time from contact, s")
    force.legend(fontsize=8)
    energy.legend(fontsize=8, loc="center right")
    save(figure, path, 110)
