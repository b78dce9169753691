"""One uniform line between two ends of any height over a flat bed, compiled: forces, and their exact derivatives.

A free line is the elastic catenary of `suspended`.  A line that touches the bed has a free piece S at each end with
height h over the bed, and the horizontal tension H:

    rise = 2wh/(s + √(s² + 2wh/EA)),  s = 1 + H/EA,    (wS)² = rise (rise + 2H),
    x = Σ (H/w) asinh(wS/H) + H ΣS/EA + (L − ΣS) + stretch of the part on the bed,

one monotone equation in ln H (SR179 report, 1982, section 3.1.1, with elasticity added).  On the bed friction μw
reduces tension from the lift-off point to an end that lies on the bed. If both ends hang above the bed, friction is
neglected.  A line lighter than water is the mirror image of a heavy one and is solved without a bed.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .free_piece import asinh_excess
from .state import BELOW_BED, BEYOND_REACH, GROUNDED, SLACK, SUSPENDED
from .suspended import suspended_shape, suspended_stiffness

# status, horizontal pull at a and b towards the other end, downward pull at a and b, length on the bed,
# then ∂(h_a, h_b, v_a, v_b)/∂(span, height of a, height of b) row by row
ROW = 18


@kernel(inline=True)
def asinh_ratio_less_one(u):
    """asinh(u)/u − 1 without cancellation."""
    if u > 0.1:
        return np.arcsinh(u) / u - 1.0
    v = u * u
    series = 35 / 1152 + v * (-63 / 2816 + v * (231 / 13312 - v * 143 / 10240))
    return v * (-1 / 6 + v * (3 / 40 + v * (-5 / 112 + v * series)))


@kernel(inline=True)
def put_suspended(row, t, sine, cosine, length, weight, flexibility):
    """Forces and derivatives of a free line. Its weight is v_a + v_b; only the difference of heights matters."""
    half, root = 0.5 * weight * length, np.sqrt(1.0 + t * t)
    xx, xz, zz = suspended_stiffness(t, sine, cosine, length, weight, flexibility)
    row[0] = SUSPENDED
    row[1] = row[2] = half * t * sine
    row[3], row[4], row[5] = half * (1.0 - root * cosine), half * (1.0 + root * cosine), 0.0
    row[6] = row[9] = xx
    row[7] = row[10] = -xz
    row[8] = row[11] = xz
    row[12], row[13], row[14] = -xz, zz, -zz
    row[15], row[16], row[17] = xz, -zz, zz


@kernel(inline=True)
def free_length(horizontal, height, weight, flexibility):
    """Free length of line that the tension `horizontal` supports up to a height over a flat bed."""
    stretch = 1.0 + flexibility * horizontal
    load = weight * height
    rise = 2.0 * load / (stretch + np.sqrt(stretch * stretch + 2.0 * flexibility * load))
    return np.sqrt(rise * (rise + 2.0 * horizontal)) / weight


@kernel(inline=True)
def bed_stretch(horizontal, lying, weight, flexibility, friction):
    """Stretch of the part on the bed, the derivatives of the stretch by H and by length, and the tension left at the
    far end.
    """
    rate = weight * friction
    pulled = lying if horizontal >= rate * lying else horizontal / rate
    held = horizontal - rate * lying if pulled >= lying else 0.0
    return flexibility * pulled * (horizontal - 0.5 * rate * pulled), flexibility * pulled, flexibility * held, held


@kernel(inline=True)
def grounded_tension(x, a, b, length, weight, flexibility, friction):
    """H > 0 of a line that lies partly on the bed."""
    at_rest = free_length(0.0, a, weight, flexibility) + free_length(0.0, b, weight, flexibility)
    gain = x - (length - at_rest)
    q = np.log(max(weight * (a + b), 1e-6 * weight * length))
    low, high = -700.0, 700.0
    for _ in range(300):
        H = np.exp(q)
        Sa, Sb = free_length(H, a, weight, flexibility), free_length(H, b, weight, flexibility)
        lying = max(length - Sa - Sb, 0.0)
        stretch, by_tension, by_length, _ = bed_stretch(H, lying, weight, flexibility, friction)
        reached = at_rest + flexibility * H * (Sa + Sb) + stretch
        rate = by_tension
        for S in (Sa, Sb):
            if S > 0.0:
                u = weight * S / H
                T = H * np.sqrt(1.0 + u * u)
                reached += S * asinh_ratio_less_one(u)
                bend = flexibility * H - by_length - (weight * S) ** 2 / (T * (T + H))
                rate += flexibility * S + asinh_excess(u) / weight + bend * S / ((T + H) * (1.0 + flexibility * T))
        if reached <= 0.0:
            low, following = q, 0.5 * (q + high)
        else:
            value = np.log(reached / gain)
            if value <= 0.0:
                low = q
            if value >= 0.0:
                high = q
            following = q - value * reached / (H * rate)
        if not low <= following <= high:
            following = 0.5 * (low + high)
        settled = abs(following - q) <= 2e-15 * max(1.0, abs(q))
        q = following
        if settled:
            break
    return np.exp(q)


@kernel(inline=True)
def put_grounded(row, H, a, b, length, weight, flexibility, friction):
    """Forces and derivatives of a line partly on the bed, from its horizontal tension."""
    Sa, Sb = free_length(H, a, weight, flexibility), free_length(H, b, weight, flexibility)
    lying = max(length - Sa - Sb, 0.0)
    _, by_tension, by_length, held = bed_stretch(H, lying, weight, flexibility, friction)
    X_H, S_H, X_a, X_b, a_h, b_h, a_H, b_H = by_tension, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for end in range(2):
        S = Sa if end == 0 else Sb
        if S == 0.0:
            continue
        u = weight * S / H
        T = H * np.sqrt(1.0 + u * u)
        bend = flexibility * H - by_length - (weight * S) ** 2 / (T * (T + H))
        by_H = S / ((T + H) * (1.0 + flexibility * T))
        by_h = T / (weight * S * (1.0 + flexibility * T))
        X_H += flexibility * S + asinh_excess(u) / weight + bend * by_H
        S_H += by_H
        if end == 0:
            a_H, a_h, X_a = by_H, by_h, bend * by_h
        else:
            b_H, b_h, X_b = by_H, by_h, bend * by_h
    row[0], row[2], row[3], row[4], row[5] = GROUNDED, H, weight * Sa, weight * Sb, lying
    H_x, H_a, H_b = 1.0 / X_H, -X_a / X_H, -X_b / X_H
    row[9], row[10], row[11] = H_x, H_a, H_b
    row[12], row[13], row[14] = weight * a_H * H_x, weight * (a_H * H_a + a_h), weight * a_H * H_b
    row[15], row[16], row[17] = weight * b_H * H_x, weight * b_H * H_a, weight * (b_H * H_b + b_h)
    # end a carries the tension that friction leaves: held = H − μw·lying, or 0
    row[1] = held
    used = weight * friction if held > 0.0 else 0.0
    along = 1.0 + used * S_H if held > 0.0 else 0.0
    row[6], row[7], row[8] = along * H_x, along * H_a + used * a_h, along * H_b + used * b_h


@kernel(inline=True)
def put_slack(row, Va, Vb, length, weight, flexibility):
    """A line that hangs vertically from both ends above a heap on the bed."""
    row[:] = 0.0
    row[0], row[3], row[4], row[5] = SLACK, Va, Vb, length - (Va + Vb) / weight
    row[13] = weight / (1.0 + flexibility * Va) if Va > 0.0 else 0.0
    row[17] = weight / (1.0 + flexibility * Vb) if Vb > 0.0 else 0.0


@kernel(inline=True)
def leaves_bed(x, h, length, weight, flexibility):
    """Whether a line from an anchor on the bed hangs free over its whole length.

    Its span then exceeds the span of a line that just grazes the bed.
    """
    load = weight * length
    c = weight * h - 0.5 * flexibility * load * load
    if c <= 0.0:
        return False
    H = (load - c) * (load + c) / (2.0 * c)
    return H <= 0.0 or x >= H * (flexibility * length + np.arcsinh(load / H) / weight)


@kernel(inline=True)
def exchange(row):
    """Change the results for a line from b to a into the results for the line from a to b."""
    row[1], row[2] = row[2], row[1]
    row[3], row[4] = row[4], row[3]
    for k in (6, 12):
        ax, aa, ab = row[k], row[k + 1], row[k + 2]
        row[k], row[k + 1], row[k + 2] = row[k + 3], row[k + 5], row[k + 4]
        row[k + 3], row[k + 4], row[k + 5] = ax, ab, aa


@kernel(inline=True)
def solve_line(row, x, a, b, length, weight, flexibility, friction, with_bed):
    """Fill one row of results; x is the span, a and b the heights of the ends over the bed (or any level)."""
    hung, grounded, status = not with_bed, False, BEYOND_REACH
    if with_bed:
        if a < 0.0 or b < 0.0:
            status = BELOW_BED
        else:
            Va = 2.0 * weight * a / (1.0 + np.sqrt(1.0 + 2.0 * flexibility * weight * a))
            Vb = 2.0 * weight * b / (1.0 + np.sqrt(1.0 + 2.0 * flexibility * weight * b))
            if length - (Va + Vb) / weight >= x:
                status = SLACK
                put_slack(row, Va, Vb, length, weight, flexibility)
            else:
                grounded = min(a, b) == 0.0 and not leaves_bed(x, max(a, b), length, weight, flexibility)
                hung = not grounded
    if hung:
        t, sine, cosine = suspended_shape(x, b - a, length, weight, flexibility)
        if not np.isinf(t):
            status = SUSPENDED
            put_suspended(row, t, sine, cosine, length, weight, flexibility)
            if with_bed and min(a, b) > 0.0 and row[3] > 0.0 and row[4] > 0.0:
                drop = row[3] * row[3] * (1.0 / (np.hypot(row[1], row[3]) + row[1]) + 0.5 * flexibility) / weight
                grounded = drop > a
    if grounded and not (flexibility == 0.0 and max(a, b) == 0.0):
        status = GROUNDED
        flipped = b == 0.0 and a > 0.0
        if flipped:  # the end on the bed comes first
            a, b = b, a
        H = grounded_tension(x, a, b, length, weight, flexibility, friction if a == 0.0 else 0.0)
        put_grounded(row, H, a, b, length, weight, flexibility, friction if a == 0.0 else 0.0)
        if flipped:
            exchange(row)
    if status >= BEYOND_REACH:
        row[:] = np.nan
    row[0] = status


@kernel(inline=True)
def mirror(row):
    """Convert results of a line upside down (heights measured downwards, upward pull) to the normal orientation."""
    row[3], row[4] = -row[3], -row[4]
    for k in (7, 8, 10, 11, 12, 15):
        row[k] = -row[k]
