"""A line that lies on a straight bed from its anchor to a lift-off point and hangs free from there.

At lift-off the line has the slope of the bed, β (positive: rising towards the fairlead), so V = H tan β + w S
with S the free length, unstretched.  On the bed dT/ds = w (sin β + μ cos β), T ≥ 0: where friction has used up
the tension the rest of the line is at rest.  SR179 report (1982), section 3.1.1 and appendix 3.1.A, with
elasticity added; only T is propagated along the bed, H = T cos β and V = T sin β follow from it.
The forces for a given span are found in `lines.hanging.uniform`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Bed(NamedTuple):
    """Slope (rad) and friction coefficient under each line, (n,)."""

    slope: np.ndarray
    friction: np.ndarray


def free_span(horizontal, vertical_low, free_length, weight, flexibility):
    """Span and rise of a free piece of line whose lower end carries (H, V_low).

    x = H S/EA + (H/w) ln[(V+T)/(V_low+T_low)],  z = S (V+V_low)/2EA + S (V+V_low)/(T+T_low)
    All arguments broadcast; H = 0 hangs vertically.  returns : x, z in m
    """
    load = weight * free_length
    vertical = vertical_low + load
    upper, lower = np.hypot(horizontal, vertical), np.hypot(horizontal, vertical_low)
    both = np.where(upper + lower > 0, upper + lower, 1.0)
    mean = (vertical + vertical_low) / both
    # V_low + T_low without cancellation where the lower end points down
    base = np.where(
        vertical_low >= 0,
        vertical_low + lower,
        horizontal * (horizontal / np.where(lower - vertical_low > 0, lower - vertical_low, 1.0)),
    )
    rise = load * (1 + mean) / np.where((horizontal > 0) & (base > 0), base, 1.0)
    x = horizontal * (flexibility * free_length + np.log1p(rise) / weight)
    z = free_length * (0.5 * flexibility * (vertical + vertical_low) + mean)
    return np.where(horizontal > 0, x, 0.0), z


def anchor_tension(horizontal, lying, weight, bed):
    """Tension left at the anchor and the length of lying line under tension, (n,) N and m."""
    rate = weight * (np.sin(bed.slope) + bed.friction * np.cos(bed.slope))
    lift_off = horizontal / np.cos(bed.slope)
    with np.errstate(divide="ignore", invalid="ignore"):
        pulled = np.where(lift_off < rate * lying, lift_off / np.where(rate > 0, rate, 1.0), lying)
    return np.maximum(lift_off - rate * pulled, 0.0) * (pulled >= lying), pulled


def lying_span(horizontal, lying, weight, flexibility, bed):
    """Stretched length (m) of the part on the bed."""
    _, pulled = anchor_tension(horizontal, lying, weight, bed)
    rate = weight * (np.sin(bed.slope) + bed.friction * np.cos(bed.slope))
    return lying + flexibility * pulled * (horizontal / np.cos(bed.slope) - 0.5 * rate * pulled)


def free_length_on_flat_bed(horizontal, z, weight, flexibility):
    """S of a line with horizontal tension H that rises z from a flat bed: explicit, (n,) m."""
    stretch = 1 + flexibility * horizontal
    rise = 2 * weight * z / (stretch + np.sqrt(stretch**2 + 2 * flexibility * weight * z))
    return np.sqrt(rise * (rise + 2 * horizontal)) / weight
