"""Boxes and vertical cylinders for the contour method, to a tolerance: afloat (`body`) or on the bed (`standing`)."""

import numpy as np

from ..problem import check_gap
from .accuracy import accuracy
from .body import MARGIN, TOLERANCES, ContourBody
from .plan.circle import Circle
from .plan.rectangle import Rectangle
from .standing import standing

HIGHEST_GAP = 1400  # limit over the smaller of draft and half the plan's width; errors were measured up to it


def prepare_cylinder(radius, draft, depth, tolerance=1e-3):
    """`ContourBody` of a vertical circular cylinder; lengths in m.  If draft and depth are equal, the body stands on
    the bed.

    tolerance : wanted relative error, 1e-7 … 0.1
    raises : ValueError for lengths that are not positive and for a bed above the keel or too deep below it
    """
    _check(tolerance, radius=radius)
    return _prepared(Circle(float(radius)), draft, depth, tolerance)


def prepare_box(length, beam, draft, depth, tolerance=1e-3):
    """`ContourBody` of a box with its length along x and its beam along y; depth and tolerance as in
    `prepare_cylinder`."""
    _check(tolerance, length=length, beam=beam)
    return _prepared(Rectangle.to_digits(length, beam, 3), draft, depth, tolerance)


def _check(tolerance, **lengths):
    for name, value in lengths.items():
        if not 0 < value < np.inf:
            raise ValueError(f"{name} is {value} m; allowed: above 0")
    if not TOLERANCES[0] <= tolerance <= TOLERANCES[1]:
        raise ValueError(f"tolerance is {tolerance}; allowed: {TOLERANCES[0]:g} to {TOLERANCES[1]:g}")


def _prepared(plan, draft, depth, tolerance):
    _check(tolerance, draft=draft)
    if depth == draft:
        return standing(plan, float(depth), tolerance)
    if not depth > draft:
        raise ValueError(f"depth is {depth} m; allowed: above the draft, {draft} m, or equal to it on the bed")
    check_gap(draft, depth)
    highest = HIGHEST_GAP * min(draft, plan.scale)
    if depth - draft > highest:
        raise ValueError(
            f"depth is {depth} m; allowed: up to {draft + highest:.6g} m; in deeper water use the panel method"
        )
    fine = accuracy(MARGIN - np.log10(tolerance), draft, depth - draft, plan.scale)
    return ContourBody(plan.to(fine), float(draft), float(depth), fine)
