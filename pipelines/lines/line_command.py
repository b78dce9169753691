"""`hakobune line`: one uniform line, its forces on the terminal, its profile and tension–offset curve as a picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.picture import PLOTS, check_picture, save
from ..common.quantities import DEEPEST, HEAVIEST, LONGEST, ROUGHEST, StudyError
from ..common.units import KN, TONF
from ..printing.verdict import tell
from .overloads import LONGEST_STRAIN

STATES = ("slack", "partly on the bed", "clear of the bed", "beyond reach")
FLOATING_STATES = ("slack, the rest floats", "partly in the sea surface", "under water", "beyond reach")
STEEPEST = np.degrees(1.5)  # of a bed that `mooring.catenary` knows
NEAR_SHORE = 1e-3  # of the distance to where the bed is as high as the fairlead: how near curves go to it
FLAGS = {  # unit, whether a value is good, what is allowed
    "weight": (" N/m", lambda value: 0 < value <= HEAVIEST, f"above 0, at most {HEAVIEST:g}"),
    "stiffness": (" kN", lambda value: value > 0, "above 0"),
    "length": (" m", lambda value: 0 < value <= LONGEST, f"above 0, at most {LONGEST:g}"),
    "depth": (" m", lambda value: 0 <= value <= DEEPEST, f"at least 0, at most {DEEPEST:g}, the deepest sea"),
    "fairlead_z": (" m", np.isfinite, "finite"),
    "span": (" m", lambda value: 0 <= value < np.inf, "at least 0, finite"),
    "tension": (" kN", lambda value: 0 < value < np.inf, "above 0, finite"),
    "friction": ("", lambda value: 0 <= value <= ROUGHEST, f"0 to {ROUGHEST:g}"),
    "slope_deg": ("°", lambda value: abs(value) < STEEPEST, f"above −{STEEPEST:.2f} and below {STEEPEST:.2f}"),
}


@dataclass(frozen=True)
class OneLine:
    """A line and where it hangs, SI; type : LineType; height, depth : m, fairlead and sea surface above anchor"""

    type: object
    length: float
    height: float
    depth: float
    friction: float
    slope: float

    @property
    def floats(self):
        """Whether it is lighter than water: its bed is the sea surface"""
        return self.type.weight < 0

    @property
    def properties(self):
        last = (self.depth,) if self.floats else (self.friction, self.slope)
        return self.length, self.type.weight, self.type.axial_stiffness, *last

    def solve(self, span):
        """LineSolution at spans, m"""
        from hakobune.mooring.lines.catenary.buoyant import solve_buoyant_lines
        from hakobune.mooring.lines.catenary.solve import solve_lines

        return (solve_buoyant_lines if self.floats else solve_lines)(span, self.height, *self.properties)

    def span_at(self, H):
        """m, where the line carries a horizontal tension, N"""
        from hakobune.mooring.lines.catenary.solve import span_at_tension
        from hakobune.mooring.lines.multi_segment.span import span_of

        if self.floats:
            return span_of(self.solve, H, self.length, self.height)
        return float(span_at_tension(H, self.height, *self.properties)[0])

    def shape(self, span, points):
        """(points, 2) m from the anchor"""
        from hakobune.mooring.lines.catenary.buoyant import buoyant_profile
        from hakobune.mooring.lines.catenary.solve import profile

        return (buoyant_profile if self.floats else profile)(span, self.height, *self.properties, points=points)

    def state(self, found):
        """What the line does, in words"""
        return (FLOATING_STATES if self.floats else STATES)[int(found.status)]


def line(
    type, weight, stiffness, length, depth, fairlead_z, *, span, tension, friction, slope_deg, characteristic, output
):
    """Solve one line for a span, or for the span at a horizontal tension.

    weight : N/m; stiffness : kN; length, depth, fairlead_z, span : m; tension : kN
    characteristic : whether spans and forces from slack to taut are printed; raises : ValueError, one line
    """
    if output is not None:
        check_picture(output, PLOTS)
    _check_flags(weight=weight, stiffness=stiffness, length=length, depth=depth, fairlead_z=fairlead_z)
    _check_flags(span=span, tension=tension, friction=friction, slope_deg=slope_deg)
    one = OneLine(_kind(type, weight, stiffness), length, fairlead_z + depth, depth, friction, np.radians(slope_deg))
    _check_floating(one, fairlead_z, friction, slope_deg)
    if (span is None) == (tension is None):
        state = "neither is given" if span is None else "both are given"
        raise StudyError(f"--span and --tension: {state}; allowed: one of them")
    if span is None:
        if one.slope >= 0:  # the bed is nowhere lower than at the anchor
            _check_above_bed(one, 0.0, depth)
        span = one.span_at(KN * tension)
        if span < 0:
            raise StudyError(
                f"--tension is {tension:g} kN, which the line has {-span:.4g} m behind its anchor, where the bed is "
                "lower; allowed: more"
            )
    _check_above_bed(one, span, depth)
    try:
        found = one.solve(span)
    except ValueError:
        if tension is None or np.isfinite(one.type.axial_stiffness):
            raise
        raise StudyError(
            f"--tension is {tension:g} kN, at which an inextensible line of {length:g} m is straight; allowed: less, "
            "or the stiffness of the line (--stiffness)"
        ) from None
    if output is not None:
        _draw(one, span, found, output)
    _show(one, span, found)
    if characteristic:
        _show_characteristic(one, span)
    status = tell(_overloads(one, found))
    if output is not None:
        print(output)
    return status


def _check_flags(**given):
    """Raise StudyError for the first impossible value; None is not given."""
    for name, value in given.items():
        unit, good, allowed = FLAGS[name]
        if value is not None and not good(value):
            raise StudyError(f"--{name.replace('_', '-')} is {value:g}{unit}; allowed: {allowed}")


def _check_floating(one, fairlead_z, friction, slope_deg):
    """Raise StudyError for what a line lighter than water cannot have."""
    given = (("--fairlead-z", fairlead_z, " m", fairlead_z <= 0), ("--friction", friction, "", friction == 0))
    for flag, value, unit, good in (*given, ("--slope-deg", slope_deg, "°", slope_deg == 0)):
        if one.floats and not good:
            allowed = "at most 0, the sea surface" if unit == " m" else "0, it does not lie on the bed"
            raise StudyError(f"{flag} is {value:g}{unit}; allowed with {one.type.name}, lighter than water: {allowed}")


def _check_above_bed(one, span, depth):
    """Raise StudyError for a fairlead below the bed."""
    bed = span * np.tan(one.slope)
    if one.height < bed:
        where = f"{span:g} m from the anchor (--depth, --slope-deg)" if one.slope else "(--depth)"
        raise StudyError(f"--fairlead-z is {one.height - depth:g} m; allowed: from {bed - depth:g} m, the bed {where}")


def _kind(name, weight, stiffness):
    from hakobune.mooring.lines.catalogue import line_type
    from hakobune.mooring.lines.system.parts import LineType

    if (name is None) == (weight is None):
        state = "neither is given" if name is None else "both are given"
        raise StudyError(f"--type and --weight: {state}; allowed: a name of the catalogue, or N/m")
    if name is not None and stiffness is not None:
        raise StudyError(f"--stiffness is {stiffness:g} and --type has its own; allowed: one of them")
    if name is not None:
        return line_type(name)
    return LineType("line", weight, np.inf if stiffness is None else KN * stiffness)


def _show(one, span, found):
    from ..printing.console import new_console
    from ..printing.number import values_table

    kind, floats = one.type, one.floats
    rows = [
        ("span", span, "m", one.state(found)),
        ("horizontal force at the fairlead", found.horizontal_fairlead / KN, "kN", ""),
        ("vertical force at the fairlead", found.vertical_fairlead / KN, "kN", "down"),
        ("horizontal force at the anchor", found.horizontal_anchor / KN, "kN", ""),
        ("vertical force at the anchor", found.vertical_anchor / KN, "kN", "up"),
        ("tension at the fairlead", found.tension_fairlead / KN, "kN", f"{found.tension_fairlead / TONF:.4g} tonf"),
        ("length that floats" if floats else "length on the bed", found.grounded_length, "m", f"of {one.length:g} m"),
        ("horizontal stiffness", found.stiffness[0, 0] / KN, "kN/m", ""),
        ("weight in water", kind.weight, "N/m", kind.name),
        ("axial stiffness EA", kind.axial_stiffness / KN, "kN", "" if np.isfinite(kind.axial_stiffness) else "rigid"),
    ]
    if np.isfinite(kind.breaking_load):
        used = 100 * float(found.tension_fairlead) / kind.breaking_load
        rows += [("breaking load", kind.breaking_load / KN, "kN", ""), ("used of the breaking load", used, "%", "")]
    new_console().print(values_table(kind.name, rows))


def _overloads(one, found):
    largest = float(max(found.tension_fairlead, found.tension_anchor))
    if largest > one.type.breaking_load:
        yield fails(
            f"the tension is {_kN(largest)}, {100 * largest / one.type.breaking_load:.4g} % of the breaking load "
            f"{_kN(one.type.breaking_load)}: the line parts; give a stronger type, a longer line or a shorter span"
        )
    strain = largest / one.type.axial_stiffness
    if strain > LONGEST_STRAIN:
        yield fails(
            f"the line is {100 * strain:.3g} % longer than unstretched, limit {100 * LONGEST_STRAIN:g} %, "
            "where any rope parts; give a longer line or a shorter span"
        )


def _show_characteristic(one, span):
    from ..printing.console import new_console
    from .characteristic import show_characteristic

    spans, curve = tension_curve(one, 24)
    breaking = one.type.breaking_load
    used = curve.tension_fairlead / (breaking if np.isfinite(breaking) else np.nan)
    columns = spans, curve.horizontal_fairlead, curve.tension_fairlead, curve.grounded_length, used
    lies = "floats" if one.floats else "on the bed"
    show_characteristic(new_console(), one.type.name, *columns, span, lies)


def _kN(value):
    return f"{float(value) / KN:.3f} kN"


def tension_curve(one, points=120, span=0.0):
    """Spans from slack to the breaking load (or a taut line), or to `span`, m, and the forces: (m,) m, LineSolution

    None is behind the anchor, or where the bed would be above the fairlead.
    """
    weight = abs(one.type.weight)
    top = 0.8 * one.type.breaking_load if np.isfinite(one.type.breaking_load) else 20 * weight * one.length
    least = 1e-3 * weight * max(abs(one.height), 0.01 * one.length)
    shore = np.inf if one.slope == 0 else one.height / np.tan(one.slope)  # where the bed is as high as the fairlead
    ends = [_span_over_bed(one, H, shore) for H in (least, top)]
    ends[1] = max(ends[1], span)
    reach = np.sqrt(max(one.length**2 - one.height**2, 0.0))
    # tension climbs steeply at the end: half of the points lie in the last tenth
    share = np.concatenate(
        [np.linspace(0, 0.9, points // 2, endpoint=False), np.linspace(0.9, 1, points - points // 2)]
    )
    spans = ends[0] + share * (ends[1] - ends[0])
    if np.isinf(one.type.axial_stiffness):
        spans = spans[spans < reach * (1 - 1e-9)] if one.slope == 0 else spans
    return spans, one.solve(spans)


def _span_over_bed(one, H, shore):
    """m, at least 0, with a horizontal tension, N, or just before `shore`, where the bed is as high as the fairlead"""
    from hakobune.mooring.lines.catenary.state import LineError

    try:
        span = max(one.span_at(H), 0.0)
    except LineError:
        span = shore
    if one.slope == 0:
        return span
    return min(span, (1 - NEAR_SHORE) * shore) if one.slope > 0 else max(span, (1 + NEAR_SHORE) * shore)


def _draw(one, span, found, output):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    shape = one.shape(span, 400)
    left.plot(*shape.T, color="C0", lw=2)
    reach = np.array([min(0.0, shape[:, 0].min()), max(1.02 * span, shape[:, 0].max())])
    left.plot(reach, reach * np.tan(one.slope), color="0.5", lw=4, zorder=0)
    if one.floats:
        left.plot(reach, [one.depth, one.depth], color="C0", lw=0.8)
    left.plot([0], [0], "k^")
    left.plot([span], [one.height], "ko")
    left.set(xlabel="x from the anchor, m", ylabel="height, m", aspect="equal" if one.height > 0.1 * span else "auto")
    left.set_title(f"{one.type.name}: {one.state(found)}")
    spans, curve = tension_curve(one, span=span)
    right.plot(spans, curve.horizontal_fairlead / KN, label="horizontal at the fairlead")
    right.plot(spans, curve.tension_fairlead / KN, label="tension at the fairlead")
    right.plot([span], [found.tension_fairlead / KN], "ko", ms=5)
    right.set(xlabel="span, m", ylabel="kN", ylim=(0, None), title="tension and offset")
    right.legend(frameon=False)
    right.grid(alpha=0.3)
    save(figure, output, 130)
