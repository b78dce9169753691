"""`hakobune earthquake`: reactions by each method beside each other, the normalised reaction, the course in time."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.dolphins.earthquake import by_spectrum, course, normalised_reaction, response_spectrum
from hakobune.mooring.fenders.fender import FenderError
from hakobune.mooring.site.seismic import seismic_force

from ..common.outputs import check_output, opening
from ..common.picture import PLOTS, check_picture, save
from ..common.quantities import StudyError
from ..printing.verdict import tell
from .study import quake_of, read_study

MARK = "# course of a body in an earthquake"
GRAVITY = 9.80665
KILO = 1e3
PERIODS = (0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0)  # s, of the printed reactions
SHORT = 1e-3  # of a deflection


def earthquake(study_path, database, output, plot):
    """Print a study; output : CSV of the course in time; plot : picture.  Returns the exit status.

    raises : ValueError, one line
    """
    study = read_study(study_path)
    if output is not None:
        if study.record is None:
            raise StudyError("--output is the course in time; allowed: with [record] in the study")
        beside = [study_path, *((database,) if database else ())]
        check_output(output, "the course of an earthquake", lambda path: opening(path)[0] == MARK, (".csv",), beside)
    if plot is not None:
        check_picture(plot, PLOTS)
    quake = quake_of(study, Path(study_path).resolve().parent, database)
    rows, run = methods(quake)
    stiffness = _stiffnesses(quake, rows)
    if output is not None and run is not None:
        _write(output, quake, run)
    if plot is not None:
        _draw(quake, run, stiffness, plot)
    _show(quake, rows, stiffness)
    if run is not None:
        ground, (first, last) = quake.ground, quake.ground.base_line
        largest, way, own = (np.abs(x).max() for x in (ground.acceleration, ground.displacement, run.body))
        print(
            f"record: ground {largest:.3g} m/s², {way:.3g} m at most, the body {own:.3g} m in space; "
            f"{first:.2g} to {last:.2g} m/s² are added to it, so that it ends at rest"
        )
    unwritten = [f"{output} is not written: record in time has no course"] if output and run is None else []
    status = tell([*failures(quake, rows), *unwritten])
    for path in (output if run is not None else None, plot):
        if path is not None:
            print(path)
    return status


def failures(quake, rows):
    """What fails of fenders by each `Method`"""
    fender = quake.fenders.fender
    for row in rows:
        if row.reason:
            yield fails(f"{row.name}: {row.reason}")
        elif (strain := fender.own(row.deflection) / fender.height) > fender.own_allowable * (1 + 1e-9):
            yield fails(
                f"{row.name}: the fenders are pressed to {100 * strain:.4g} % of their height; allowable "
                f"{100 * fender.own_allowable:.4g} %; take more or larger ones"
            )


class Method(NamedTuple):
    """What a method says: period s, damping ratio, acceleration m/s², reaction N, deflection m; None where it has none

    reason : why the fenders do not stand it
    """

    name: str
    period: float | None = None
    ratio: float | None = None
    acceleration: float | None = None
    reaction: float | None = None
    deflection: float | None = None
    reason: str = ""


def methods(quake):
    """`Method` of each that the study has values for, and the `Course` or None"""
    fenders, rows, run = quake.fenders, [], None
    if quake.coefficient is not None:
        force = seismic_force(quake.coefficient, quake.floater.mass * GRAVITY)
        found = Method(f"seismic coefficient {quake.coefficient:g}", None, None, quake.coefficient * GRAVITY, force)
        rows.append(
            _tried(found, lambda: found._replace(deflection=_deflection(fenders.fender, force / fenders.count)))
        )
    if quake.spectrum is not None:
        rows.append(_by_spectrum(quake, "response spectrum", quake.spectrum, quake.ratio))
    if quake.ground is not None:
        of_record = lambda T: float(response_spectrum(quake.ground, [T])[0])  # noqa: E731
        rows.append(_by_spectrum(quake, "spectrum of the record", of_record, 0.05))
        largest = Method("record in time", None, None, float(np.abs(quake.ground.acceleration).max()))
        try:
            run = course(quake.ground, quake.floater, fenders)
            reaction, deflection = float(np.abs(run.reaction).max()), float(run.deflection.max())
            rows.append(largest._replace(reaction=reaction, deflection=deflection))
        except FenderError as error:
            rows.append(largest._replace(reason=str(error)))
    return rows, run


def _by_spectrum(quake, name, spectrum, ratio):
    def found():
        s = by_spectrum(quake.floater, quake.fenders, spectrum, ratio)
        return Method(name, s.period, s.ratio, s.acceleration, s.reaction, s.deflection)

    return _tried(Method(name), found)


def _tried(method, found):
    """What `found` makes, or the method with the reason why it cannot"""
    try:
        return found()
    except ValueError as error:
        return method._replace(reason=str(error))


def _deflection(fender, force):
    """m at which a fender first reacts with a force, N.  Raises FenderError where it never does."""
    grid = np.linspace(0.0, fender.limit, 4001)
    above = np.flatnonzero(fender.loading(grid) >= force)
    if not len(above):
        raise FenderError(
            f"{fender.name}: {force / KILO:.4g} kN press it, its table ends with "
            f"{fender.largest_reaction(fender.limit) / KILO:.4g} kN; take more or larger ones"
        )
    return float(np.interp(force, fender.loading(grid[: above[0] + 1]), grid[: above[0] + 1]))


def _stiffnesses(quake, rows):
    """{name: N/m} of all fenders of a side: of the first slope, and of the largest deflection of any method"""
    fender, count = quake.fenders.fender, quake.fenders.count
    out = {"first slope": count * float(fender.loading.slope(SHORT * fender.limit))}
    found = [row.deflection for row in rows if row.deflection]
    if found and max(found) > SHORT * fender.limit:
        out[f"{max(found):.3g} m"] = count * float(fender.loading(max(found))) / max(found)
    return out


def _normalised(quake, periods, stiffness):
    omega = 2 * np.pi / np.asarray(periods, float)
    added_mass, damping = quake.floater.water(omega)
    return normalised_reaction(omega, quake.floater.mass, added_mass, damping, stiffness)


def _show(quake, rows, stiffness):
    from rich.table import Table

    from ..printing.console import new_console

    console, floater, fenders = new_console(), quake.floater, quake.fenders
    weight, one = floater.mass * GRAVITY, fenders.fender
    periods = []
    for name, k in stiffness.items():
        omega = np.sqrt(k / (floater.mass + floater.added_mass))
        for _ in range(50):
            omega = np.sqrt(k / (floater.mass + floater.water(omega)[0][0]))
        periods.append(f"{2 * np.pi / omega:.3g} s ({name})")
    print(f"{quake.motion}: {floater.mass / KILO:.0f} t, {fenders.count} × {fenders.fender.name} on each side, "
          f"{fenders.clearance:g} m off; period {', '.join(periods)}")  # fmt: skip
    table = Table(title="largest reaction of the dolphins of one side", title_justify="left")
    for i, name in enumerate(("method", "period s", "damping %", "acceleration m/s²", "reaction kN", "over weight",
                              "deflection m", "strain %")):  # fmt: skip
        table.add_column(name, justify="right" if i else "left", no_wrap=True)
    for row in rows:
        strain = None if row.deflection is None else 100 * one.own(row.deflection) / one.height
        weights = None if row.reaction is None else row.reaction / weight
        numbers = (
            (row.period, ".3g"), (None if row.ratio is None else 100 * row.ratio, ".1f"), (row.acceleration, ".3g"),
            (None if row.reaction is None else row.reaction / KILO, ".0f"), (weights, ".3f"), (row.deflection, ".3f"),
            (strain, ".1f"),
        )  # fmt: skip
        table.add_row(row.name, *("–" if value is None else format(value, form) for value, form in numbers))
    console.print(table)
    print("reaction of springs over ω² y M, which is 1 for the seismic coefficient; y, ω of the ground, M in air:")
    table = Table()
    for name in ("period s", *stiffness):
        table.add_column(name, justify="right", no_wrap=True)
    columns = [_normalised(quake, PERIODS, k) for k in stiffness.values()]
    for i, T in enumerate(PERIODS):
        table.add_row(f"{T:g}", *(f"{column[i]:.3f}" for column in columns))
    console.print(table)


def _write(path, quake, run):
    from hakobune.meshing.whole_files import write_whole

    names = "t,ground,ground_acceleration,body,deflection,reaction"
    ground = quake.ground
    rows = np.stack(
        [run.time, ground.displacement, ground.acceleration, run.body, run.deflection, run.reaction], axis=1
    )
    lines = [MARK, "# s, m, m/s², m, m, N; reaction on the dolphins towards +", names]
    lines += [",".join(f"{value:.8g}" for value in row) for row in rows]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _draw(quake, run, stiffness, path):
    """Normalised reaction over the period; with a record, body, ground and reaction over time"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 4.5 if run is None else 9.0), layout="constrained")
    axes = np.atleast_1d(figure.subplots(1 if run is None else 3))
    T = np.geomspace(0.1, 50.0, 400)
    for name, k in stiffness.items():
        axes[0].loglog(T, _normalised(quake, T, k), label=name)
    axes[0].axhline(1.0, color="grey", linewidth=0.8, linestyle=":", label="seismic coefficient")
    axes[0].set(xlabel="period of the ground, s", ylabel="reaction/(ω² y M)")
    axes[0].grid(alpha=0.3, which="both")
    axes[0].legend()
    if run is not None:
        axes[1].plot(run.time, quake.ground.displacement, label="ground")
        axes[1].plot(run.time, run.body, label="body")
        axes[1].set(ylabel="displacement, m")
        axes[1].legend()
        axes[2].plot(run.time, run.reaction / KILO)
        axes[2].set(ylabel="reaction on the dolphins, kN", xlabel="time, s")
    save(figure, path, 110)
