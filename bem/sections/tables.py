"""Tables of sectional coefficients over B/d, H/d and ξ_B, and interpolation between shapes with a bound of its error.

The SR179 report (1982) gives twenty tables, 2.1.3.1-20: H/d in the outer, B/d in the inner order, ten ξ_B each; its
design guideline interpolates them in B/d and H/d.  Between so few shapes an interpolant is as good as its luck.  Here
the shapes are Chebyshev points, in log B/d and log (H/d − 1), of as many as the tolerance needs:

    f(x, y) = Σ cᵢⱼ Tᵢ(x) Tⱼ(y),     |error| ≲ Σ |cᵢⱼ| over the last two orders of i and of j

which holds while the coefficients fall at least as fast beyond the last two orders as a series of halves.  Of heave
and roll M + iN is interpolated after division by (B/d)² / (H/d − 1), the size it has in a thin film under the keel.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .coefficients import FINEST, HEAVE, ROLL, SWAY, TOLERANCE, frequency_of, report_row, section

BEAM_DRAFT = (5.0, 10.0, 15.0, 20.0)
DEPTH_DRAFT = (1.2, 1.4, 2.0, 3.0, 10.0)
XI = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 2.5, 3.0)
SHAPE_COLUMNS = ("H_over_d", "B_over_d", "xi_B")
IMPEDANCES = ("H", "S", "R", "SR")
FORCES = ("H", "S", "R")
COLUMNS = (
    *SHAPE_COLUMNS,
    *(f"{part}_{name}" for name in IMPEDANCES for part in "MN"),
    *(name for mode in FORCES for name in (f"E_{mode}", f"eps_{mode}_deg")),
)
MOST_POINTS = 40


def tables(beam_draft=BEAM_DRAFT, depth_draft=DEPTH_DRAFT, xi=XI, tolerance=TOLERANCE):
    """Rows of all tables in the report's order: H/d, then B/d, then ξ_B; a list of dictionaries with `COLUMNS`.

    depth_draft may hold inf.  Raises ValueError for a shape that cannot be solved to the tolerance.
    """
    return [row_of(B, H, x, tolerance) for H in depth_draft for B in beam_draft for x in xi]


def row_of(beam_draft, depth_draft, xi, tolerance=TOLERANCE):
    """One row: {column: number}"""
    if not 0 < xi < np.inf:
        raise ValueError(f"xi_B is {xi:g}; allowed: above 0 and finite")
    values = report_row(section(beam_draft, 1.0, depth_draft, frequency_of(xi, beam_draft), tolerance=tolerance))
    return values | {"H_over_d": depth_draft, "B_over_d": beam_draft, "xi_B": xi}


def table_name(row):
    """ "2.1.3.1" … "2.1.3.20" for the shapes of the report, "" for others"""
    try:
        order = DEPTH_DRAFT.index(row["H_over_d"]) * len(BEAM_DRAFT) + BEAM_DRAFT.index(row["B_over_d"])
    except ValueError:
        return ""
    return f"2.1.3.{order + 1}"


@dataclass(frozen=True)
class ShapeInterpolant:
    """Chebyshev series in shape of every coefficient at given ξ_B; made by `interpolant`.

    xi : (x,); beam_draft, depth_draft : (lowest, highest)
    series : (i, j, x, 7) complex, of M + iN for heave, sway, roll, sway–roll and of E exp(iε) for heave, sway, roll
    bound : (x, 7) bound of the error of a series
    """

    xi: np.ndarray
    beam_draft: tuple
    depth_draft: tuple
    series: np.ndarray = field(repr=False)
    bound: np.ndarray = field(repr=False)

    def rows(self, beam_draft, depth_draft):
        """One row per ξ_B, as `tables` gives them.  Raises ValueError outside the ranges: nothing is extrapolated."""
        values = self._series_at(beam_draft, depth_draft) * _film(beam_draft, depth_draft)
        return [_row(beam_draft, depth_draft, x, line) for x, line in zip(self.xi, values, strict=True)]

    def error(self, beam_draft, depth_draft):
        """(x, 7) bound of the error of M + iN and of E exp(iε) there, in the units of the tables"""
        self._check(beam_draft, depth_draft)
        return self.bound * _film(beam_draft, depth_draft)

    def _series_at(self, beam_draft, depth_draft):
        self._check(beam_draft, depth_draft)
        x = _scaled(beam_draft, self.beam_draft, 0.0)
        y = _scaled(depth_draft, self.depth_draft, 1.0)
        in_depth = np.tensordot(_polynomials(x, len(self.series)), self.series, 1)
        return np.tensordot(_polynomials(y, len(in_depth)), in_depth, 1)

    def _check(self, beam_draft, depth_draft):
        for name, value, (low, high) in (
            ("B/d", beam_draft, self.beam_draft),
            ("H/d", depth_draft, self.depth_draft),
        ):
            if not low <= value <= high:
                raise ValueError(f"{name} is {value:g}; this table holds {low:g} to {high:g}")


def interpolant(xi=XI, beam_draft=(5.0, 20.0), depth_draft=(1.2, 10.0), tolerance=1e-5):
    """`ShapeInterpolant` whose bound is below `tolerance` times the largest value of each coefficient at each ξ_B.

    xi : (x,); beam_draft, depth_draft : (lowest, highest), finite
    Raises ValueError for an empty range, or one that needs more than 40 points in a direction.
    """
    for name, (low, high), least in (("B/d", beam_draft, 0), ("H/d", depth_draft, 1)):
        if not least < low < high < np.inf:
            raise ValueError(f"{name} from {low:g} to {high:g}; allowed: above {least}, finite, from below to")
    xi, counts = np.asarray(xi, float), [8, 8]
    while True:
        values = _sampled(xi, beam_draft, depth_draft, counts, max(tolerance / 10, FINEST))
        series = _transformed(_transformed(values, 0), 1)
        largest = np.abs(values).max((0, 1))
        tails = [_tail(series, axis, 0) for axis in (0, 1)]
        missed = [float(np.max(tail / largest)) for tail in tails]
        if sum(missed) < tolerance:
            return ShapeInterpolant(xi, tuple(beam_draft), tuple(depth_draft), series, sum(tails))
        for axis in (0, 1):
            before = float(np.max(_tail(series, axis, 2) / largest))
            counts[axis] += _orders_missing(before, missed[axis], tolerance / 2)
            if counts[axis] > MOST_POINTS:
                raise ValueError(
                    f"tolerance {tolerance:g} needs {counts[axis]} shapes along {('B/d', 'H/d')[axis]}; allowed: "
                    f"up to {MOST_POINTS}; narrow the range or ask for less"
                )


def _tail(series, axis, earlier):
    """(x, 7) sum of the sizes of two neighbouring orders, the last two or `earlier` ones"""
    length = series.shape[axis]
    return np.abs(series.take([length - 2 - earlier, length - 1 - earlier], axis)).sum((0, 1))


def _orders_missing(before, now, tolerance):
    """How many more orders bring the tail below the tolerance, if it goes on falling as from two orders before"""
    if now < tolerance:
        return 0
    fall = np.clip(np.log(before / now), np.log(1.5), None)
    return 2 * int(np.ceil(np.log(now / tolerance) / fall))


def _sampled(xi, beam_draft, depth_draft, counts, tolerance):
    """Values over film size at the Chebyshev points, (i, j, x, 7)"""
    out = np.empty((*counts, len(xi), 7), complex)
    for i, x in enumerate(_points(counts[0])):
        for j, y in enumerate(_points(counts[1])):
            B, H = _shape(x, beam_draft, 0.0), _shape(y, depth_draft, 1.0)
            out[i, j] = np.array([_values(B, H, one, tolerance) for one in xi]) / _film(B, H)
    return out


def _values(beam_draft, depth_draft, xi, tolerance):
    s = section(beam_draft, 1.0, depth_draft, frequency_of(xi, beam_draft), tolerance=tolerance)
    b = beam_draft / 2
    mass = (s.added_mass + 1j * s.damping / s.omega) / (s.density * s.beam)
    force = s.excitation / (s.density * s.gravity * b)
    impedances = (mass[HEAVE, HEAVE], mass[SWAY, SWAY], mass[ROLL, ROLL] / b**2, mass[SWAY, ROLL] / b)
    return [*impedances, force[HEAVE], force[SWAY], force[ROLL] / b]


def _row(beam_draft, depth_draft, xi, values):
    row = {"H_over_d": depth_draft, "B_over_d": beam_draft, "xi_B": float(xi)}
    for name, value in zip(IMPEDANCES, values[:4], strict=True):
        row[f"M_{name}"], row[f"N_{name}"] = float(value.real), float(value.imag)
    for name, value in zip(FORCES, values[4:], strict=True):
        row[f"E_{name}"], row[f"eps_{name}_deg"] = float(abs(value)), float(np.degrees(np.angle(value)))
    return row


def _film(beam_draft, depth_draft):
    """(7,) what heave and roll are divided by"""
    film = beam_draft**2 / (depth_draft - 1)
    return np.array([film, 1.0, film, 1.0, 1.0, 1.0, 1.0])


def _points(count):
    return np.cos(np.pi * (np.arange(count) + 0.5) / count)


def _polynomials(x, count):
    return np.cos(np.arange(count) * np.arccos(np.clip(x, -1.0, 1.0)))


def _transformed(values, axis):
    """Chebyshev coefficients along an axis from values at `_points`"""
    count = values.shape[axis]
    matrix = np.cos(np.outer(np.arange(count), np.arccos(_points(count)))) * 2 / count
    matrix[0] /= 2
    return np.moveaxis(np.tensordot(matrix, values, (1, axis)), 0, axis)


def _scaled(value, ends, origin):
    low, high = np.log(np.subtract(ends, origin))
    return (2 * np.log(value - origin) - low - high) / (high - low)


def _shape(x, ends, origin):
    low, high = np.log(np.subtract(ends, origin))
    return float(origin + np.exp((low + high + x * (high - low)) / 2))
