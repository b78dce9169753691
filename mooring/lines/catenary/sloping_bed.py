"""A line that lies on a straight bed from its anchor to a lift-off point and hangs free from there.

At lift-off the line has the slope of the bed, β (positive: rising towards the fairlead), so V = H tan β + w S with S
the free length, unstretched.  On the bed dT/ds = w (sin β + μ cos β), T ≥ 0: the line beyond the place where
friction has reduced the tension to zero is at rest.  SR179 report (1982), section 3.1.1 and appendix 3.1.A, with
elasticity added; only T is propagated along the bed, H = T cos β and V = T sin β follow from it.

Friction holds a line without tension where tan |β| ≤ μ.  On a steeper bed the line slides down. The excess line lies
in a bight below the anchor, with T = 0 at the lowest point of the bight. The leg of the bight pulls the anchor down
the slope with w (sin β − μ cos β) times the length of the leg. For a given span ln H is found from the span along
the bed, between proven bounds.
"""

import math

from hakobune.bem.kernels.jit import kernel

from .flat_bed import free_length as flat_free_length
from .free_piece import ROUNDING, asinh_excess, free_piece


@kernel()
def hanging_length(height, weight, flexibility):
    """Length of a piece that hangs vertically over a height, stretched by its own weight."""
    return 2 * height / (1 + math.sqrt(1 + 2 * flexibility * weight * height))


@kernel()
def slides(slope, friction):
    """Whether a line without tension slides down a bed that rises towards its fairlead."""
    return math.tan(slope) > friction


@kernel()
def lying_end(H, lying, weight, slope, friction):
    """Tension at the anchor and the length on the bed above the place where the tension becomes zero.

    The tension is negative if the line slides: the leg of a bight pulls the anchor down the slope.
    """
    rate = weight * (math.sin(slope) + friction * math.cos(slope))
    lift_off = H / math.cos(slope)
    if lift_off < rate * lying:
        pulled, leg = lift_off / rate, 0.0
        if slides(slope, friction):
            leg = weight * (math.sin(slope) - friction * math.cos(slope)) * (lying - pulled)
        return -leg, pulled
    return lift_off - rate * lying, lying


@kernel()
def lying_reach(H, lying, weight, flexibility, slope, friction):
    """Stretched length of the part on the bed; for a bight, the distance of its lift-off point above the anchor."""
    end, pulled = lying_end(H, lying, weight, slope, friction)
    rate = weight * (math.sin(slope) + friction * math.cos(slope))
    stretch = flexibility * pulled * (H / math.cos(slope) - 0.5 * rate * pulled)
    if pulled < lying and slides(slope, friction):
        return pulled + stretch - (lying - pulled) * (1 - 0.5 * flexibility * end)
    return lying + stretch


@kernel()
def sloping_free_length(H, clearance, weight, flexibility, slope):
    """Free length S of a line whose upper end is `clearance` above the bed, measured vertically.

    Explicit on a flat bed.  On a slope the distance from the bed is a convex function of S, so Newton's steps approach
    the root from above.
    """
    pull = H / math.cos(slope) ** 3
    S = flat_free_length(pull, clearance, weight, flexibility)
    if slope == 0:
        return S
    S += clearance
    tan = math.tan(slope)
    for _ in range(100):
        x, z = free_piece(H, H * tan, S, weight, flexibility)
        T = math.hypot(H, H * tan + weight * S)
        # d(z − x tan β)/dS = (1 + T/EA)(sin φ − cos φ tan β), and sin φ − cos φ tan β = wS/T
        step = (z - x * tan - clearance) / ((1 + flexibility * T) * weight * S / T)
        S = S - step if step < S else 0.5 * S
        if abs(step) <= ROUNDING * S:
            break
    return S


@kernel()
def grounded_jacobian(H, S, length, weight, flexibility, slope, friction):
    """∂x/∂H, ∂x/∂S, ∂z/∂H, ∂z/∂S of the fairlead, written with the turning angle δ = φ − β of the free part."""
    cos, tan = math.cos(slope), math.tan(slope)
    V = H * tan + weight * S
    T = math.hypot(H, V)
    delta = math.atan2(weight * S, H + V * tan)
    end, pulled = lying_end(H, length - S, weight, slope, friction)
    if slope == 0:
        bend = asinh_excess(weight * S / H)
    else:
        bend = math.log1p(weight * S * (1 + (V + H * tan) / (T + H / cos)) / (H * (tan + 1 / cos))) - weight * S / T
    half = math.sin(0.5 * delta)
    stretch = flexibility * pulled
    x_H = stretch + flexibility * S + bend / weight
    z_H = stretch * tan + flexibility * S * tan - 2 * half**2 / (weight * cos)
    x_S = -2 * math.sin(slope + 0.5 * delta) * half + flexibility * (H - end * cos)
    z_S = 2 * math.cos(slope + 0.5 * delta) * half + flexibility * (V - end * cos * tan)
    if pulled < length - S and slides(slope, friction):  # loss in the bight raises the lift-off by the same length
        by_H = (2 - flexibility * end) / (weight * (math.sin(slope) + friction * cos))
        x_H, x_S, z_H, z_S = x_H + by_H, x_S + 2 * cos, z_H + by_H * tan, z_S + 2 * math.sin(slope)
    return x_H, x_S, z_H, z_S


@kernel()
def solve_grounded(x, z, length, weight, flexibility, slope, friction):
    """H and S of a line between the limits of slack and of lift-off; the span along the bed grows with H."""
    cos, sin = math.cos(slope), math.sin(slope)
    clearance = max(z - x * math.tan(slope), 1e-12 * (abs(z) + x))
    plumb = hanging_length(clearance, weight, flexibility)
    target = x * cos + z * sin
    slack = lying_reach(0.0, max(length - plumb, 0.0), weight, flexibility, slope, friction) + clearance * sin
    gain = max(target - slack, 1e-300)
    # S ≤ L bounds H without stretch; with stretch the lying and hanging parts together give at least H L/EA
    rigid = weight * (length + clearance) ** 2 / max(clearance * cos**3, 1e-300)
    high = rigid
    if flexibility > 0:
        high = (gain + 2 * length + clearance) / (flexibility * length) + weight * length * (1 + friction)
    # √s asinh(1/s) < 1.1 bounds the gain of a given H; the factor leaves room for the slope
    least = min((gain / 2.2) ** 2 * weight / (length + clearance), high)
    low = 1e-290 if slides(slope, friction) else min(max(1e-6 * least, 1e-290), 0.5 * high)
    q = 0.5 * (math.log(max(low, least)) + math.log(min(high, rigid)))
    low, high = math.log(low), math.log(high)
    q = min(max(q, low), high)
    for _ in range(200):
        H = math.exp(q)
        S = sloping_free_length(H, clearance, weight, flexibility, slope)
        dx, dz = free_piece(H, H * math.tan(slope), S, weight, flexibility)
        lying = max(length - S, 0.0)
        reached = lying_reach(H, lying, weight, flexibility, slope, friction) + dx * cos + dz * sin - slack
        x_H, x_S, z_H, z_S = grounded_jacobian(H, S, length, weight, flexibility, slope, friction)
        across_H, across_S = z_H * cos - x_H * sin, z_S * cos - x_S * sin
        rate = x_H * cos + z_H * sin
        if across_S > 0:
            rate -= (x_S * cos + z_S * sin) * across_H / across_S
        value = math.log(reached / gain) if reached > 0 else -1.0
        if value <= 0:
            low = q
        if value >= 0:
            high = q
        following = q - value * reached / (H * rate) if reached > 0 else low - 1.0
        if not low <= following <= high:
            following = 0.5 * (low + high)
        settled = abs(following - q) <= ROUNDING * max(1.0, abs(q))
        q = following
        if settled:
            break
    H = math.exp(q)
    return H, min(sloping_free_length(H, clearance, weight, flexibility, slope), length)


@kernel()
def grounded_stiffness(H, S, length, weight, flexibility, slope, friction):
    """∂(H, V)/∂(x, z), four numbers; friction makes the stiffness unsymmetric where the part on the bed stretches."""
    x_H, x_S, z_H, z_S = grounded_jacobian(H, S, length, weight, flexibility, slope, friction)
    determinant = x_H * z_S - x_S * z_H
    tan = math.tan(slope)
    H_x, H_z = z_S / determinant, -x_S / determinant
    return H_x, H_z, tan * H_x - weight * z_H / determinant, tan * H_z + weight * x_H / determinant


@kernel()
def free_length_at_height(H, z, length, weight, flexibility, slope, friction):
    """Free length of a line with known H and height of the fairlead; inf where no part of the line is on the bed.

    Explicit on a flat bed.  On a slope the height falls with the length on the bed, and the root is found by bisection
    to rounding; nan if the bed rises above the fairlead.
    """
    if slope == 0:
        return flat_free_length(H, z, weight, flexibility)
    low, high = 0.0, length
    if height_of(H, low, length, weight, flexibility, slope, friction) > z:
        return math.nan
    if height_of(H, high, length, weight, flexibility, slope, friction) < z:
        return math.inf
    for _ in range(200):
        middle = 0.5 * (low + high)
        if height_of(H, middle, length, weight, flexibility, slope, friction) < z:
            low = middle
        else:
            high = middle
        if high - low <= 0.5 * ROUNDING * length:
            break
    return high


@kernel()
def height_of(H, S, length, weight, flexibility, slope, friction):
    """Height of a fairlead above its anchor, for a line with the free length S above the bed"""
    _, rise = free_piece(H, H * math.tan(slope), S, weight, flexibility)
    return lying_reach(H, max(length - S, 0.0), weight, flexibility, slope, friction) * math.sin(slope) + rise
