"""A line that lies on a straight bed from its anchor to a lift-off point and hangs free from there.

At lift-off the line has the slope of the bed, β (positive: rising towards the fairlead), so V = H tan β + w S
with S the free length, unstretched.  On the bed dT/ds = w (sin β + μ cos β), T ≥ 0: where friction has used up
the tension the rest of the line is at rest.  SR179 report (1982), section 3.1.1 and appendix 3.1.A, with
elasticity added; only T is propagated along the bed, H = T cos β and V = T sin β follow from it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .roots import ROUNDING, asinh_excess, falling_root


class Bed(NamedTuple):
    """Slope (rad) and friction coefficient under each line, (n,)."""

    slope: np.ndarray
    friction: np.ndarray


class Grounded(NamedTuple):
    """Horizontal tension H (N), free length S (m), and the tension at the anchor (N), each (n,)."""

    horizontal: np.ndarray
    free_length: np.ndarray
    anchor_tension: np.ndarray


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


def hanging_load(height, weight, flexibility):
    """Weight (N) of the piece that hangs plumb from a height (m) to the bed, stretched by itself."""
    load = weight * height
    return 2 * load / (1 + np.sqrt(1 + 2 * flexibility * load))


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


def free_length_over_slope(horizontal, clearance, weight, flexibility, bed):
    """S of a line that ends `clearance` m (along the vertical) above a straight bed.

    The distance from the bed is a convex function of S, so Newton's steps come down on the root from above.
    """
    cos, tan = np.cos(bed.slope), np.tan(bed.slope)
    flat = free_length_on_flat_bed(horizontal / cos**3, clearance, weight, flexibility)
    S = flat + clearance
    for _ in range(100):
        x, z = free_span(horizontal, horizontal * tan, S, weight, flexibility)
        V = horizontal * tan + weight * S
        T = np.hypot(horizontal, V)
        # d(z − x tan β)/dS = (1 + T/EA)(sin φ − cos φ tan β), and sin φ − cos φ tan β = wS/T
        step = (z - x * tan - clearance) / ((1 + flexibility * T) * weight * S / T)
        S = np.where(S - step > 0, S - step, 0.5 * S)
        if np.all(np.abs(step) <= ROUNDING * S):
            break
    return S


def free_length(horizontal, x, z, weight, flexibility, bed):
    """S for a horizontal tension H > 0 (N) and a fairlead at (x, z), (n,) m."""
    flat = free_length_on_flat_bed(horizontal, np.maximum(z, 0.0), weight, flexibility)
    if not np.any(bed.slope):
        return flat
    clearance = np.maximum(z - x * np.tan(bed.slope), 1e-12 * (np.abs(z) + x))
    return np.where(bed.slope == 0, flat, free_length_over_slope(horizontal, clearance, weight, flexibility, bed))


def span_along_bed(horizontal, S, length, weight, flexibility, bed):
    """Distance (m) between anchor and fairlead, measured along the bed."""
    x, z = free_span(horizontal, horizontal * np.tan(bed.slope), S, weight, flexibility)
    lying = lying_span(horizontal, np.maximum(length - S, 0.0), weight, flexibility, bed)
    return lying + x * np.cos(bed.slope) + z * np.sin(bed.slope)


def solve_grounded(x, z, length, weight, flexibility, bed):
    """Grounded lines between the slack and the lifting limit; the caller has sorted these out.

    All (n,).  The span grows with H from that of the plumb line; its logarithm is nearly linear in ln H.
    """
    cos, sin = np.cos(bed.slope), np.sin(bed.slope)
    clearance = z - x * np.tan(bed.slope)
    plumb = hanging_load(clearance, weight, flexibility) / weight
    target = x * cos + z * sin
    slack = lying_span(0.0, np.maximum(length - plumb, 0.0), weight, flexibility, bed) + clearance * sin
    gain = np.maximum(target - slack, 1e-300)
    # S ≤ L bounds H without stretch; with stretch the lying and hanging parts together give at least H L/EA
    rigid = weight * (length + clearance) ** 2 / np.maximum(clearance * cos**3, 1e-300)
    with np.errstate(divide="ignore"):
        elastic = (gain + 2 * length + clearance) / np.where(flexibility > 0, flexibility * length, 1.0)
        high = np.where(flexibility > 0, elastic + weight * length * (1 + bed.friction), rigid)
    # √s asinh(1/s) < 1.1 bounds the gain of a given H; the factor leaves room for the slope
    least = np.minimum((gain / 2.2) ** 2 * weight / (length + clearance), high)
    low = np.clip(1e-6 * least, 1e-290, 0.5 * high)
    start = np.sqrt(np.maximum(low, least)) * np.sqrt(np.minimum(high, rigid))

    def shortfall(q):
        H = np.exp(q)
        S = free_length(H, x, z, weight, flexibility, bed)
        reached = span_along_bed(H, S, length, weight, flexibility, bed) - slack
        J = jacobian(Grounded(H, S, None), length, weight, flexibility, bed)
        across = J[..., 1, :] * cos[..., None] - J[..., 0, :] * sin[..., None]
        along = J[..., 0, :] * cos[..., None] + J[..., 1, :] * sin[..., None]
        with np.errstate(divide="ignore", invalid="ignore"):
            rate = along[..., 0] - np.where(across[..., 1] > 0, along[..., 1] * across[..., 0] / across[..., 1], 0.0)
            ratio = reached / gain
            logarithm = np.log(np.where(ratio > 0, ratio, 1.0))
            slope = H * rate / np.where(ratio > 0, reached, np.nan)
        return np.where(ratio > 0, -logarithm, 1.0), np.where(ratio > 0, -slope, np.nan)

    H = np.exp(falling_root(shortfall, np.log(low), np.log(high), np.log(start)))
    S = np.minimum(free_length(H, x, z, weight, flexibility, bed), length)
    return Grounded(H, S, anchor_tension(H, length - S, weight, bed)[0])


def jacobian(line, length, weight, flexibility, bed):
    """(n, 2, 2): ∂(x, z)/∂(H, S) of the fairlead, written with the turning angle δ = φ − β of the free part."""
    H, S, _ = line
    cos, sin, tan = np.cos(bed.slope), np.sin(bed.slope), np.tan(bed.slope)
    V = H * tan + weight * S
    T = np.hypot(H, V)
    delta = np.arctan2(weight * S, H + V * tan)
    end, pulled = anchor_tension(H, length - S, weight, bed)
    lower = H / cos
    bend = np.log1p(weight * S * (1 + (V + H * tan) / (T + lower)) / (H * (tan + 1 / cos))) - weight * S / T
    bend = np.where(bed.slope == 0, asinh_excess(weight * S / H), bend)
    half = np.sin(0.5 * delta)
    stretch = flexibility * pulled
    x_H = stretch + flexibility * S + bend / weight
    z_H = stretch * tan + flexibility * S * tan - 2 * half**2 / (weight * cos)
    x_S = -2 * np.sin(bed.slope + 0.5 * delta) * half + flexibility * (H - end * cos)
    z_S = 2 * np.cos(bed.slope + 0.5 * delta) * half + flexibility * (V - end * sin)
    return np.stack([x_H, x_S, z_H, z_S], axis=-1).reshape(*np.shape(H), 2, 2)


def stiffness(line, length, weight, flexibility, bed):
    """(n, 2, 2) N/m: ∂(H, V)/∂(x, z) at the fairlead; friction makes it unsymmetric where the bed part stretches."""
    J = jacobian(line, length, weight, flexibility, bed)
    tan = np.tan(bed.slope)
    determinant = J[..., 0, 0] * J[..., 1, 1] - J[..., 0, 1] * J[..., 1, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        H_x, H_z = J[..., 1, 1] / determinant, -J[..., 0, 1] / determinant
        S_x, S_z = -J[..., 1, 0] / determinant, J[..., 0, 0] / determinant
    k = np.stack([H_x, H_z, tan * H_x + weight * S_x, tan * H_z + weight * S_z], axis=-1)
    return k.reshape(*J.shape)
