"""Tables of a response: rotations in degrees, forces in kN; one row per response that is not zero."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem import DOFS
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.response.findings import large_rotations
from hakobune.mooring.response.long_term import YEAR
from hakobune.mooring.response.points import KeelPoint, Point, keel_name, relative_name
from hakobune.mooring.response.return_period import probability_not_exceeded
from hakobune.mooring.response.sea_state import TINY

from ..common.units import KN
from ..printing.verdict import tell

RAD = {"rad": ("°", 180 / np.pi)}
FRACTILE = 0.9
WORTH_NAMING = 1e-3  # estimated error of a result
MOTIONS = {name.upper() for name in DOFS}
FELT = {f"{word} {axis}" for word in ("displacement", "velocity", "acceleration") for axis in "xyz"}
FELT |= {"relative elevation", "felt acceleration x", "felt acceleration y"}
SHORT = {
    "standard_deviation": "σ",
    "significant_amplitude": "1/3",
    "expected_maximum": "max",
    "maximum_not_exceeded_90": "max 90 %",
    "zero_crossing_period_s": "T zero",
    "peak_to_peak_period_s": "T peak",
    "bandwidth": "ε",
}


class Rows(NamedTuple):
    """Columns with units, and a row of values per response: (names, units, (c, columns))"""

    columns: tuple[str, ...]
    names: list[str]
    units: list[str]
    values: np.ndarray


def sea_rows(result) -> Rows:
    """Standard deviation, significant and extreme values in a SeaState"""
    columns = ("standard_deviation", "significant_amplitude", "expected_maximum", "maximum_not_exceeded_90")
    columns += ("zero_crossing_period_s", "peak_to_peak_period_s", "bandwidth")
    with_unit = (result.sigma, result.significant, result.expected_maximum, result.not_exceeded(FRACTILE))
    excited = np.flatnonzero(~(result.sigma <= 0))  # what is not known is no zero
    units, factors = _units([result.units[i] for i in excited])
    values = np.array([v[excited] * factors for v in with_unit] + [v[excited] for v in _periods(result)])
    return Rows(columns, [result.names[i] for i in excited], units, values.T)


def climate_rows(result, years) -> Rows:
    """Extremes of responses in a Climate: once in a year, in `years`, and not exceeded in them with 90 %"""
    columns = ("once_in_1_year", f"once_in_{years:g}_years", f"not_exceeded_90_in_{years:g}_years")
    excited = np.flatnonzero(result.excited)
    units, factors = _units([result.units[i] for i in excited])
    values = []
    for i, factor in zip(excited, factors, strict=True):
        term = result.long_term(result.names[i])
        times = (YEAR, years * YEAR, years * YEAR / -np.log(FRACTILE))
        values.append([factor * term.level(time) for time in times])
    return Rows(columns, [result.names[i] for i in excited], units, np.array(values))


def turned(rows):
    """Lines on rotations that are too large for linear theory, by the largest expected or once in all years"""
    column = 2 if "expected_maximum" in rows.columns else 1
    angles = zip(rows.names, rows.units, rows.values[:, column], strict=True)
    return large_rotations({name: value for name, unit, value in angles if name.upper() in MOTIONS and unit == "°"})


def failures(result, stiffness, years=None):
    """What fails of a SeaState, or of a Climate in `years`: a body that capsizes, water at a deck, a keel on the bed

    stiffness : (6, 6) restoring of the body, N m/rad, with its mooring, or None
    """
    for mode in (3, 4):
        if stiffness is not None and stiffness[mode, mode] < 0:
            yield fails(
                f"the body capsizes: its restoring in {DOFS[mode].lower()} is {stiffness[mode, mode] / KN:.4g} kN m/rad"
                ", limit 0; lower its centre of gravity or make it wider"
            )
    for word, gaps, way_out in (
        ("air gap at", _air_gaps(result, years), "give more freeboard"),
        ("under keel, at", _keel_gaps(result, years), "give more water or less draft"),
    ):
        for name, (gap, left) in gaps.items():
            if left < 0:
                yield fails(f"{word} {name}: {left:.3g} of {gap:.3g} m are left, limit 0; {way_out}")


def _air_gaps(result, years):
    """{point: (clearance, m left)} by the largest rise expected, or once in `years`"""
    if years is None:
        return {name: found[:2] for name, found in result.air_gaps().items()}
    points = [p for p in result.points if isinstance(p, Point) and p.clearance is not None]
    return {p.name: _left_in_years(result, relative_name(p), p.clearance, years) for p in points}


def _keel_gaps(result, years):
    if years is None:
        return {name: found[:2] for name, found in result.under_keel().items()}
    points = [p for p in result.points if isinstance(p, KeelPoint)]
    return {p.name: _left_in_years(result, keel_name(p), p.gap, years) for p in points}


def _left_in_years(result, name, gap, years):
    return gap, gap - result.long_term(name).level(years * YEAR)


def notes(result, radius, years=None):
    """Lines on drift, air gap and duration, without markup; radius : m, of the hull, the lever of its forces"""
    if years is None:
        lines = [_sea_line(result), *_drift_lines(result.slow, radius), *_gap_lines(result), *_keel_lines(result)]
        named = result.errors.named(WORTH_NAMING)
        return lines + ([f"estimated errors between stored waves: {', '.join(named)}"] if named else [])
    lines = [f"{len(result.height)} sea states"]
    if years > 1:
        q = 100 * probability_not_exceeded(years, years)
        lines.append(f"the value once in {years:g} years stays unexceeded in {years:g} years with {q:.0f} %")
    if result.mean_drift is not None:
        lines.append(f"mean drift over all time: {_forces(result.mean_drift, radius, result.drift)}")
    return [*lines, *_gaps_in_years(result, years), *_keel_in_years(result, years)]


def show(rows, points, lines, warned, written, held=None):
    """Print the table, that of a `moored.Moored`, lines of `notes`, warnings, what fails and the names of the files
    written; returns the exit status."""
    from rich.box import SIMPLE
    from rich.table import Table

    from ..printing.console import new_console

    console = new_console()
    for title, members in _groups(rows.names, points).items():
        table = Table(title=title, title_justify="left", box=SIMPLE, pad_edge=False)
        table.add_column("", no_wrap=True)
        for column in rows.columns:
            table.add_column(SHORT.get(column, column.replace("_", " ")), justify="right")
        for i, label in members.items():
            table.add_row(f"{label}, {rows.units[i]}", *(_known(value, ".3g") for value in rows.values[i]))
        console.print(table)
    if held is not None:
        held.show(console)
    for line in lines:
        console.print(line, highlight=False, soft_wrap=True)
    status = tell(warned, console)
    if written:
        console.print(f"written: {', '.join(map(str, written))}", highlight=False, soft_wrap=True)
    return status


def _groups(names, points):
    """{title: {row: label}}: the motions, then every point"""
    groups = {"motions, amplitudes": {i: name for i, name in enumerate(names) if name.upper() in MOTIONS}}
    keel = {names.index(keel_name(p)): p.name for p in points if isinstance(p, KeelPoint) and keel_name(p) in names}
    if keel:
        groups["points of the bottom, vertical amplitudes"] = keel
    for point in (point for point in points if isinstance(point, Point)):
        prefix = f"{point.name} "
        own = {i: name.removeprefix(prefix) for i, name in enumerate(names) if name.removeprefix(prefix) in FELT}
        groups[f"{point.name}, amplitudes"] = {i: label for i, label in own.items() if names[i] == prefix + label}
    return groups


def _periods(result):
    return result.zero_period, result.peak_period, result.bandwidth


def _units(units):
    return [RAD.get(u, (u, 1.0))[0] for u in units], np.array([RAD.get(u, (u, 1.0))[1] for u in units])


def sea_in_words(result):
    """Spectrum, direction and duration of a SeaState"""
    systems = getattr(result.sea, "systems", (result.sea,))
    whole = f"together {result.sea.spectrum.significant_height:.4g} m, " if len(systems) > 1 else ""
    return f"{' and '.join(map(system_in_words, systems))}, {whole}{result.duration / 3600:.3g} h"


def system_in_words(sea):
    """Spectrum, height, period, direction and spreading of one system of waves"""
    s = sea.spectrum
    crests = "long-crested" if sea.spreading is None else str(sea.spreading)
    return (
        f"{s.name} spectrum, {s.significant_height:.4g} m, T01 {s.T01:.4g} s, travelling to "
        f"{np.degrees(sea.direction) % 360:.4g}°, {crests}"
    )


def _sea_line(result):
    return (
        f"{sea_in_words(result)}; amplitudes: "
        "standard deviation, mean of the highest third, largest expected and not exceeded with 90 %; periods in s"
    )


def _drift_lines(slow, radius):
    if slow is None:
        return ["no drift: the database holds no drift_force"]
    lines = [
        f"mean drift: {_forces(slow.drift, radius)}",
        *_by_current(slow, radius),
        f"standard deviation of slow drift, beats up to {slow.difference[-1]:g} rad/s: {_forces(slow.sigma, radius)}",
    ]
    if slow.of_pairs is not None:
        lines.append(f'by qtf = "{slow.level}": {_forces(slow.sigma_of_pairs[[0, 1, 5]], radius)}')
    if slow.damping is None:
        return [*lines, "no wave drift damping: the direction has no stored neighbours to differentiate drift over"]
    along, across = slow.damping[0, 0] / KN, slow.damping[1, 1] / KN
    return [*lines, f"wave drift damping: surge {along:.4g}, sway {across:.4g} kN s/m"]


def _by_current(slow, radius):
    if slow.by_current is not None:
        yield f'of it by the current: {_forces(slow.by_current, radius)}, which current.waves = "still" leaves out'


def _forces(force, radius, among=None):
    """Fx, Fy and Mz in words; zero where they are rounding beside the largest known force of `among` (n, 3), or their
    own

    A moment is small beside a force times the radius in m.
    """
    largest = np.fmax.reduce(np.abs(force if among is None else among)[..., :2], axis=None, initial=0.0)
    rounding = np.abs(force) <= TINY * largest * np.array([1.0, 1.0, radius])
    x, y, m = (_known(value, ".4g") for value in np.where(rounding, 0.0, force) / KN)
    return f"Fx {x}, Fy {y} kN, Mz {m} kN m"


def _known(value, form):
    """A number in words; one that is nan is not known, and no zero"""
    return "unknown" if np.isnan(value) else format(value, form)


def _gaps_in_years(result, years):
    """Air gap of points with a clearance in a Climate"""
    for point in (p for p in result.points if isinstance(p, Point) and p.clearance is not None):
        term = result.long_term(relative_name(point))
        left = point.clearance - term.level(years * YEAR)
        yield (
            f"air gap at {point.name}: {left:.3g} of {point.clearance:.3g} m left by the rise once in {years:g} years, "
            f"water reaches it {_often(term, point.clearance)}; {_whose_waves(result)}"
        )


def _keel_lines(result):
    """The point of the bottom with the least water left in a SeaState"""
    found = result.under_keel()
    if found:
        name = min(found, key=lambda name: found[name][1])
        gap, left, touched = found[name]
        hours = result.duration / 3600
        yield (
            f"under keel: least at {name}, {left:.3g} of {gap:.3g} m left by the largest drop, the bed is touched with "
            f"probability {touched:.3g} in {hours:.3g} h; waves' part alone, without squat"
        )


def _keel_in_years(result, years):
    points = [point for point in result.points if isinstance(point, KeelPoint)]
    if points:
        terms = {point: result.long_term(keel_name(point)) for point in points}
        worst = min(points, key=lambda point: point.gap - terms[point].level(years * YEAR))
        left = worst.gap - terms[worst].level(years * YEAR)
        yield (
            f"under keel: least at {worst.name}, {left:.3g} of {worst.gap:.3g} m left by the drop once in {years:g} "
            f"years, the bed is touched {_often(terms[worst], worst.gap)}; waves' part alone, without squat"
        )


def _often(term, level):
    rate = float(term.crossing_rate(level)) * YEAR
    return f"once in {1 / rate:.3g} years" if rate * 1e6 > 1 else "less than once in a million years"


def _whose_waves(result):
    """Which waves are in the elevation at points of a SeaState or Climate"""
    if result.missed is None:
        return "waves scattered and made by the body not included, for want of Kochin functions in the database"
    return "with the waves that the body scatters and makes, but those that decay within a depth or wave length of it"


def _gap_lines(result):
    for name, (clearance, left, reached) in result.air_gaps().items():
        yield (
            f"air gap at {name}: {left:.3g} of {clearance:.3g} m left by the largest rise, water reaches it with "
            f"probability {reached:.3g}; {_whose_waves(result)}"
        )
