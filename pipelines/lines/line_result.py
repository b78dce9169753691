"""`hakobune.line`: one uniform line at a span, or at the span with a given horizontal tension."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.lines.catalogue import unread
from hakobune.mooring.lines.one_line import OneLine, tension_curve
from hakobune.mooring.lines.system.findings import LONGEST_STRAIN

from ..common.quantities import DEEPEST, HEAVIEST, LONGEST, ROUGHEST, StudyError
from ..common.units import KN
from ..printing.number import significant
from ..results.given import words_of
from ..results.provenance import provenance
from ..results.quantity import Quantity, quantities
from ..results.result import Result, labels

STEEPEST = 1.5  # rad, steepest bed in `mooring.catenary`
FLAGS = {  # unit, its size, whether a value is valid, allowed values
    "weight": (" N/m", 1.0, lambda value: 0 < value <= HEAVIEST, f"above 0, at most {HEAVIEST:g}"),
    "stiffness": (" kN", KN, lambda value: value > 0, "above 0"),
    "length": (" m", 1.0, lambda value: 0 < value <= LONGEST, f"above 0, at most {LONGEST:g}"),
    "depth": (" m", 1.0, lambda value: 0 <= value <= DEEPEST, f"at least 0, at most {DEEPEST:g}, the deepest sea"),
    "fairlead_z": (" m", 1.0, np.isfinite, "finite"),
    "span": (" m", 1.0, lambda value: 0 <= value < np.inf, "at least 0, finite"),
    "tension": (" kN", KN, lambda value: 0 < value < np.inf, "above 0, finite"),
    "friction": ("", 1.0, lambda value: 0 <= value <= ROUGHEST, f"0 to {ROUGHEST:g}"),
    "slope": (
        "°", np.pi / 180, lambda value: abs(value) < STEEPEST,
        f"above −{np.degrees(STEEPEST):.2f} and below {np.degrees(STEEPEST):.2f}",
    ),
}  # fmt: skip


def line(
    *,
    length: float,
    depth: float,
    type: str | None = None,
    weight: float | None = None,
    stiffness: float | None = None,
    fairlead_z: float = 0.0,
    span: float | None = None,
    tension: float | None = None,
    friction: float = 0.0,
    slope: float = 0.0,
    characteristic: bool = False,
) -> Result:
    """Forces of one mooring line, from its anchor on the bed to its fairlead.

    length : unstretched length, m; depth : water depth at the anchor, m; fairlead_z : height of the fairlead above
        still water, m
    type : name in the catalogue; or weight : in water, N/m, with stiffness : EA, N, by default infinite
    span : between both ends, m; or tension : horizontal tension at the fairlead, N; slope : of the bed, rad;
        friction : its coefficient
    characteristic : whether to include the curves from slack to taut
    returns : Result, in SI; its `detail` is a `mooring.lines.one_line.OneLine`, its span and its LineSolution
    raises : ValueError, with a message of one line
    """
    words = words_of(**locals())
    _check(weight=weight, stiffness=stiffness, length=length, depth=depth, fairlead_z=fairlead_z)
    _check(span=span, tension=tension, friction=friction, slope=slope)
    one = OneLine(_kind(type, weight, stiffness), length, fairlead_z + depth, depth, friction, slope)
    _check_floating(one, fairlead_z, friction, slope)
    if (span is None) == (tension is None):
        state = "neither is given" if span is None else "both are given"
        raise StudyError(f"--span and --tension: {state}; give one of them")
    if span is None:
        span = _span_at(one, tension, depth)
    _check_above_bed(one, span, depth)
    found = _solved(one, span, tension)
    made, axes = _forces(one, span, found), {}
    if characteristic:
        spans, curve = tension_curve(one, 24)
        made |= _curves(one, curve)
        axes = labels("at_span", spans, "m", "span")
    return Result(
        "line", made, axes, tuple(_overloads(one, found)), provenance=provenance(words), detail=(one, span, found)
    )


def _check(**given):
    """Raise StudyError for the first impossible value; None is not given."""
    for name, value in given.items():
        unit, size, good, allowed = FLAGS[name]
        if value is not None and not good(value):
            raise StudyError(f"{_flag(name)} is {value / size:g}{unit}; allowed: {allowed}")


def _flag(name):
    return {"slope": "--slope-deg"}.get(name, f"--{name.replace('_', '-')}")


def _kind(name, weight, stiffness):
    from hakobune.mooring.lines.catalogue import line_type
    from hakobune.mooring.lines.system.parts import LineType

    if (name is None) == (weight is None):
        state = "neither is given" if name is None else "both are given"
        raise StudyError(f"--type and --weight: {state}; give one of them: a name of the catalogue, or N/m")
    if name is not None and stiffness is not None:
        raise StudyError(f"--stiffness is {stiffness / KN:g}, but --type has its own; give one of them")
    if name is not None:
        return line_type(name)
    return LineType("line", weight, np.inf if stiffness is None else stiffness)


def _check_floating(one, fairlead_z, friction, slope):
    """Raise StudyError for options that a line lighter than water does not support."""
    given = (("fairlead_z", fairlead_z, fairlead_z <= 0), ("friction", friction, friction == 0))
    for name, value, good in (*given, ("slope", slope, slope == 0)):
        unit, size, *_ = FLAGS[name]
        if one.floats and not good:
            allowed = "at most 0, the sea surface" if unit == " m" else "0, since the line does not lie on the bed"
            raise StudyError(
                f"{_flag(name)} is {value / size:g}{unit}; allowed with {one.type.name}, lighter than water: {allowed}"
            )


def _check_above_bed(one, span, depth):
    """Raise StudyError for a fairlead below the bed."""
    bed = span * np.tan(one.slope)
    if one.height < bed:
        where = f"{span:g} m from the anchor (--depth, --slope-deg)" if one.slope else "(--depth)"
        raise StudyError(f"--fairlead-z is {one.height - depth:g} m; allowed: from {bed - depth:g} m, the bed {where}")


def _span_at(one, tension, depth):
    """m, of a horizontal tension, N"""
    if one.slope >= 0:  # the bed is nowhere lower than at the anchor
        _check_above_bed(one, 0.0, depth)
    span = one.span_at(tension)
    if span < 0:
        raise StudyError(
            f"--tension is {tension / KN:g} kN; the line would then hang {-span:.4g} m behind its anchor, where the "
            "bed is lower; give more tension"
        )
    return span


def _solved(one, span, tension):
    try:
        return one.solve(span)
    except ValueError:
        if tension is None or np.isfinite(one.type.axial_stiffness):
            raise
        raise StudyError(
            f"--tension is {tension / KN:g} kN, at which an inextensible line of {one.length:g} m is straight; give "
            "less tension, or the stiffness of the line (--stiffness)"
        ) from None


def _forces(one, span, found):
    kind, lies = one.type, "length that floats" if one.floats else "length on the bed"
    given = {
        "state": (one.state(found), "", "state"),
        "span": (span, "m", "span"),
        "length": (one.length, "m", "length"),
        "grounded": (found.grounded_length, "m", lies),
        "fairlead.horizontal": (found.horizontal_fairlead, "N", "horizontal force at the fairlead"),
        "fairlead.vertical": (found.vertical_fairlead, "N", "vertical force at the fairlead, down"),
        "fairlead.tension": (found.tension_fairlead, "N", "tension at the fairlead"),
        "anchor.horizontal": (found.horizontal_anchor, "N", "horizontal force at the anchor"),
        "anchor.vertical": (found.vertical_anchor, "N", "vertical force at the anchor, up"),
        "anchor.tension": (found.tension_anchor, "N", "tension at the anchor"),
        "stiffness": (found.stiffness[0, 0], "N/m", "horizontal stiffness"),
        "weight": (kind.weight, "N/m", "weight in water"),
        "axial_stiffness": (kind.axial_stiffness, "N", "axial stiffness EA"),
        "breaking_load": (kind.breaking_load, "N", "breaking load"),
        "used": (largest_in(found) / kind.breaking_load, "", "share of the breaking load"),
    }
    unknown = () if np.isfinite(kind.breaking_load) else ("breaking_load", "used")
    if np.isinf(kind.axial_stiffness):
        unknown += ("axial_stiffness",)
    return {
        name: Quantity(np.asarray(value), (), unit, words, "" if name in unknown else kind.name, name == "used")
        for name, (value, unit, words) in given.items()
    }


def largest_in(found):
    """Larger tension of the two ends, N: that at the anchor for a floating line or a higher anchor"""
    return np.maximum(found.tension_fairlead, found.tension_anchor)


def _curves(one, found):
    breaking = one.type.breaking_load if np.isfinite(one.type.breaking_load) else np.nan
    return quantities("from slack to taut", {
        "curve.horizontal": (found.horizontal_fairlead, "N", "horizontal"),
        "curve.tension": (found.tension_fairlead, "N", "tension"),
        "curve.grounded": (found.grounded_length, "m", "floats" if one.floats else "on the bed"),
        "curve.used": (largest_in(found) / breaking, "%", "used"),
    }, "at_span")  # fmt: skip


def _overloads(one, found):
    if said := unread(one.type.name):
        yield said
    largest, breaking = float(largest_in(found)), one.type.breaking_load
    if largest > breaking:
        yield fails(
            f"the tension is {significant(largest / KN)} kN, {100 * largest / breaking:.4g} % of the breaking load "
            f"{significant(breaking / KN)} kN: the line parts; give a stronger type, a longer line or a shorter span"
        )
    strain = largest / one.type.axial_stiffness
    if strain > LONGEST_STRAIN:
        yield fails(
            f"the line is stretched by {100 * strain:.3g} %, limit {100 * LONGEST_STRAIN:g} %, where any rope "
            "parts; give a longer line or a shorter span"
        )
