"""`hakobune damping`: linear and quadratic damping from a record of a forced oscillation or of a free decay."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from hakobune.mooring.criteria.failing import fails

from ..printing.verdict import tell

LEFT = 0.25  # of the record, that a fit may leave
COLUMNS = ("time_s", "motion_m", "force_kN")


def damping(
    record: Annotated[Path, Parameter(help="CSV: time_s, motion_m, and force_kN of the water where the body is moved")],
    /,
    *,
    mass: Annotated[float | None, Parameter(help="t with added mass, of a decay", allow_leading_hyphen=True)] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Linear and quadratic damping of a body from a record of its motion: forced oscillation, or free decay.

    With force_kN, the reaction of the water on the body that moves as a sine: B1, B2 and added mass.  Without, the body
    is let go: a, b of its extinction by half cycles, and B1, B2, of --mass.
    """
    from ..common.picture import PLOTS, check_picture

    if plot is not None:
        check_picture(plot, PLOTS)
    if mass is not None and not 0 < mass < float("inf"):
        raise ValueError(f"--mass is {mass:g}; allowed: above 0, finite")
    columns = read_record(record)
    if "force_kN" in columns and mass is not None:
        raise ValueError("--mass is given with force_kN in the record; allowed: of a decay")
    try:
        drawn, failed = _forced(columns) if "force_kN" in columns else _decay(columns, mass)
    except ValueError as error:
        raise ValueError(f"{record}: {error}") from None
    if plot is not None:
        _draw(plot, *drawn)
    status = tell(failed)
    if plot is not None:
        print(plot)
    return status


def read_record(path):
    """{column: (n,) array} of a CSV.  Raises ValueError."""
    from hakobune.mooring.environment.tables import check_even, read_table
    from hakobune.mooring.identification.record import UNEVEN

    names, values = read_table(path)
    wrong = [name for name in names or () if name not in COLUMNS]
    if wrong or not {"time_s", "motion_m"} <= set(names or ()):
        shown = "no names of columns in its first row" if names is None else f"the columns {', '.join(names)}"
        raise ValueError(
            f"{path} has {shown}; allowed: the columns time_s, motion_m, and force_kN where it is moved: name them so"
        )
    columns = dict(zip(names, values.T, strict=True))
    check_even(path, columns["time_s"], UNEVEN)
    return columns


def _forced(columns):
    import numpy as np

    from hakobune.mooring.identification.forced import forced

    time, motion, force = (np.array(columns[name]) for name in COLUMNS)
    made = forced(time, motion, 1e3 * force)
    sine = made.motion
    first, second = made.error
    rows = [
        ("amplitude", sine.amplitude, "m", ""),
        ("period", 2 * np.pi / sine.omega, "s", ""),
        ("added mass", made.added_mass / 1e3, "t", ""),
        ("B1", made.linear / 1e3, "kN s/m", f"±{first / 1e3:.2g}; {made.by_harmonics[0] / 1e3:.5g} by harmonics"),
        ("B2", made.quadratic / 1e3, "kN s²/m²", f"±{second / 1e3:.2g}; {made.by_harmonics[1] / 1e3:.5g} by harmonics"),
        ("linear damping of the same energy", made.same_energy / 1e3, "kN s/m", ""),
        ("linear damping of the same largest force", made.same_force / 1e3, "kN s/m", ""),
        ("force not explained", 100 * made.off, "%", ""),
    ]
    _show("forced oscillation", rows)
    failed = [*_rest(made.off, "force", "a sine that moves a body with added mass and damping")]
    if made.same_energy < 0:
        failed.append(
            fails(
                f"the damping is negative, {made.same_energy / 1e3:.5g} kN s/m of the same energy, limit 0: the force "
                "gives energy to the body; is force_kN that of what moves it? the water's reaction has the other sign"
            )
        )
    theta = sine.omega * (time - time[0]) + sine.phase
    v, a = sine.omega * sine.amplitude * np.cos(theta), -(sine.omega**2) * sine.amplitude * np.sin(theta)
    fitted = -made.added_mass * a - made.linear * v - made.quadratic * v * np.abs(v)
    return (time, force - force.mean(), fitted / 1e3, "reaction, kN"), failed


def _decay(columns, mass):
    import numpy as np

    from hakobune.mooring.identification.decay import decay

    time, motion = (np.array(columns[name]) for name in COLUMNS[:2])
    made = decay(time, motion)
    period, ratio = 2 * np.pi / made.omega, made.linear / (2 * made.omega)
    rows = [
        ("natural period", period, "s", f"{len(made.extremes)} extremes from {made.extremes[0]:.4g} m"),
        ("a", made.a, "", f"by half cycles; {made.linear_only:.4g} with b = 0"),
        ("b", made.b, "1/m", "by half cycles"),
        ("B1/M", made.linear, "1/s", f"{100 * ratio:.3g} % of critical; M with added mass"),
        ("B2/M", made.quadratic, "1/m", ""),
    ]
    if mass is not None:
        rows += [("B1", made.linear * mass, "kN s/m", ""), ("B2", made.quadratic * mass, "kN s²/m²", "")]
    _show("free decay", [*rows, ("motion not explained", 100 * made.off, "%", "")])
    return (time, motion, made.fitted, "motion, m"), _rest(made.off, "motion", "the free decay of one motion")


def _show(title, rows):
    from ..printing.console import new_console
    from ..printing.number import values_table

    new_console().print(values_table(title, rows))


def _rest(off, what, kind):
    """What fails of a fit that leaves too much"""
    if off > LEFT:
        yield fails(
            f"{100 * off:.2g} % of the {what} is left over, limit {100 * LEFT:g} %; this is no record of {kind}; look "
            "at --plot"
        )


def _draw(path, time, measured, fitted, label):
    from matplotlib.figure import Figure

    from ..common.picture import save

    figure = Figure(figsize=(9.0, 4.5), layout="constrained")
    axis = figure.add_subplot()
    axis.plot(time, measured, ".", markersize=2.5, color="0.5", label="record")
    axis.plot(time, fitted, linewidth=1.0, label="fitted")
    axis.set(xlabel="time, s", ylabel=label)
    axis.grid(alpha=0.3)
    axis.legend()
    save(figure, path, 110)
