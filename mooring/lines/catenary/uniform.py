"""Kernels of one uniform line between anchor and fairlead, one line at a time.

Suspended: t from (x/LP)² + (z/LQ)² = 1 (see `mooring.lines.catenary.suspended`).  Grounded: ln H from the span
along the bed (see
`mooring.lines.catenary.grounded`).  Both roots are bracketed by proven bounds, Newton's step is taken while it
stays inside.
Scalars in, scalars out; the wrapper `mooring.catenary.solve_lines` checks input and result.
"""

from __future__ import annotations

import math

import numpy as np

from bem.kernels.jit import kernel

ROUNDING = 8 * 2.220446049250313e-16
SLACK, GROUNDED, SUSPENDED, BEYOND_REACH = 0.0, 1.0, 2.0, 3.0  # `mooring.catenary.State`


@kernel()
def asinh_excess(s):
    """asinh s − s/√(1+s²) without cancellation; s³/3 for small s ≥ 0."""
    if s >= 0.1:
        return math.asinh(s) - (1.0 if math.isinf(s) else s / math.sqrt(1 + s * s))
    u = s * s
    # aₙ 2n/(2n+1) with aₙ = (2n)!/(4ⁿ n!²); the term left out is below 1e-15 of the sum at s = 0.1
    series = -35 / 144 + u * (315 / 1408 + u * (-693 / 3328 + u * (3003 / 15360 - u * 6435 / 34816)))
    return s * u * (1 / 3 + u * (-3 / 10 + u * (15 / 56 + u * series)))


@kernel()
def ellipse_parameter(X, Z, kappa):
    """t of a suspended line with span X and height Z over its length; inf where it cannot reach."""
    reach2 = X * X + Z * Z
    if kappa == 0 and reach2 >= 1:
        return math.inf
    if X == 0:
        return math.sqrt(((abs(Z) - 1) / kappa) ** 2 - 1) if abs(Z) > 1 + kappa else 0.0
    # √t asinh(1/t) < 1.1, hence P(low) ≤ X; P, Q ≥ κt and P² ≥ 1 − 1/3t², hence the sum is ≤ 1 at high
    low = (X / 2.2) ** 2
    high = math.inf
    if kappa > 0:
        low = min(low, X / (2 * kappa))
        high = 1.5 * max(X, abs(Z)) / kappa
    if reach2 < 1:
        high = min(high, 1 / math.sqrt(3 * max(1 - reach2, 1e-300)))
    low, high = math.log(low), math.log(high)
    q = high
    for _ in range(200):
        t = math.exp(q)
        bend = math.asinh(1 / t)
        root = math.sqrt(1 + t * t)
        P, Q = t * (bend + kappa), 1 + kappa * root
        across, up = (X / P) ** 2, (Z / Q) ** 2
        total = across + up
        slope = across * (asinh_excess(1 / t) + kappa) / (bend + kappa) + up * kappa * t * t / (root * Q)
        value = math.log(total)
        if value >= 0:
            low = q
        if value <= 0:
            high = q
        following = q + 0.5 * value * total / slope
        if not low <= following <= high:
            following = 0.5 * (low + high)
        settled = abs(following - q) <= ROUNDING * max(1.0, abs(q))
        q = following
        if settled:
            break
    return math.exp(q)


@kernel()
def suspended_shape(x, z, length, weight, flexibility):
    """t, sin ν, cos ν of a line that touches nothing."""
    X, Z, kappa = x / length, z / length, 0.5 * flexibility * weight * length
    t = ellipse_parameter(X, Z, kappa)
    if math.isinf(t):
        return t, 0.0, Z
    cosine = min(max(Z / (1 + kappa * math.sqrt(1 + t * t)), -1.0), 1.0)
    if X == 0:
        sine = 0.0 if t > 0 else math.sqrt(max(1 - cosine * cosine, 0.0))
    else:
        sine = min(X / (t * (math.asinh(1 / t) + kappa)), 1.0)
    return t, sine, cosine


@kernel()
def suspended_stiffness(t, s, c, length, weight, flexibility):
    """∂H/∂x, ∂H/∂z = ∂V/∂x, ∂V/∂z; every term of one sign, so the determinant has no difference."""
    kappa = 0.5 * flexibility * weight * length
    if t == 0:
        return 0.0, 0.0, 0.5 * weight / (kappa + 1)
    root = math.sqrt(1 + t * t)
    norm = t * t + s * s
    a, b, d = t * t * c * c / (root * norm), root * s * s / norm, t * s * c / norm
    h = asinh_excess(1 / t)
    scale = 0.5 * weight / (kappa * kappa + kappa * (h + a + b) + h * b)
    return scale * (kappa + b), scale * d, scale * (kappa + h + a)


@kernel()
def free_piece(H, V_low, S, weight, flexibility):
    """Span and rise of a free piece of length S whose lower end carries (H, V_low)."""
    load = weight * S
    V = V_low + load
    upper, lower = math.hypot(H, V), math.hypot(H, V_low)
    both = upper + lower
    mean = (V + V_low) / both if both > 0 else 0.0
    z = S * (0.5 * flexibility * (V + V_low) + mean)
    if H <= 0:
        return 0.0, z
    # V_low + T_low without cancellation where the lower end points down
    base = V_low + lower if V_low >= 0 else H * (H / (lower - V_low))
    return H * (flexibility * S + math.log1p(load * (1 + mean) / base) / weight), z


@kernel()
def hanging_length(height, weight, flexibility):
    """Length of the piece that hangs plumb over a height, stretched by its own weight."""
    return 2 * height / (1 + math.sqrt(1 + 2 * flexibility * weight * height))


@kernel()
def lying_end(H, lying, weight, slope, friction):
    """Tension left at the anchor and the length of lying line under tension."""
    rate = weight * (math.sin(slope) + friction * math.cos(slope))
    lift_off = H / math.cos(slope)
    if lift_off < rate * lying:
        return 0.0, lift_off / rate
    return lift_off - rate * lying, lying


@kernel()
def lying_reach(H, lying, weight, flexibility, slope, friction):
    """Stretched length of the part on the bed."""
    _, pulled = lying_end(H, lying, weight, slope, friction)
    rate = weight * (math.sin(slope) + friction * math.cos(slope))
    return lying + flexibility * pulled * (H / math.cos(slope) - 0.5 * rate * pulled)


@kernel()
def free_length(H, clearance, weight, flexibility, slope):
    """S of a line that ends `clearance` above the bed, measured along the vertical.

    Explicit on a flat bed.  On a slope the distance from the bed is a convex function of S, so Newton's steps come
    down on the root from above.
    """
    pull = H / math.cos(slope) ** 3
    stretch = 1 + flexibility * pull
    rise = 2 * weight * clearance / (stretch + math.sqrt(stretch**2 + 2 * flexibility * weight * clearance))
    S = math.sqrt(rise * (rise + 2 * pull)) / weight
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
    return x_H, x_S, z_H, z_S


@kernel()
def solve_grounded(x, z, length, weight, flexibility, slope, friction):
    """H and S of a line between the slack and the lifting limit; the span along the bed grows with H."""
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
    low = min(max(1e-6 * least, 1e-290), 0.5 * high)
    q = 0.5 * (math.log(max(low, least)) + math.log(min(high, rigid)))
    low, high = math.log(low), math.log(high)
    q = min(max(q, low), high)
    for _ in range(200):
        H = math.exp(q)
        S = free_length(H, clearance, weight, flexibility, slope)
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
    return H, min(free_length(H, clearance, weight, flexibility, slope), length)


@kernel()
def grounded_stiffness(H, S, length, weight, flexibility, slope, friction):
    """∂(H, V)/∂(x, z), four numbers; friction makes it unsymmetric where the part on the bed stretches."""
    x_H, x_S, z_H, z_S = grounded_jacobian(H, S, length, weight, flexibility, slope, friction)
    determinant = x_H * z_S - x_S * z_H
    tan = math.tan(slope)
    H_x, H_z = z_S / determinant, -x_S / determinant
    return H_x, H_z, tan * H_x - weight * z_H / determinant, tan * H_z + weight * x_H / determinant


@kernel()
def solve_uniform(line, bed):
    """H, V, H_anchor, V_anchor, lying, four stiffnesses, state of a line (x, z, length, weight, 1/EA, friction, slope).

    A line whose free shape would leave its anchor below the bed's slope lies on the bed; if it is long enough to
    reach the point below its fairlead lying and then hang plumb, it is slack.
    """
    x, z, length, weight, flexibility, friction, slope = line
    tan = math.tan(slope)
    if bed:
        clearance = z - x * tan
        plumb = hanging_length(clearance, weight, flexibility)
        if length >= plumb:
            lying = length - plumb
            if lying_reach(0.0, lying, weight, flexibility, slope, friction) >= x / math.cos(slope):
                end, _ = lying_end(0.0, lying, weight, slope, friction)
                rate = weight / (1 + flexibility * weight * plumb)
                H, V = end * math.cos(slope), end * math.sin(slope)
                return 0.0, weight * plumb, H, V, lying, 0.0, 0.0, -tan * rate, rate, SLACK
    t, sine, cosine = suspended_shape(x, z, length, weight, flexibility)
    if math.isinf(t):
        return t, t, t, t, 0.0, math.nan, math.nan, math.nan, math.nan, BEYOND_REACH
    half = 0.5 * weight * length
    H, V = half * t * sine, half * (1 + math.sqrt(1 + t * t) * cosine)
    if not bed or V - weight * length >= H * tan:
        xx, xz, zz = suspended_stiffness(t, sine, cosine, length, weight, flexibility)
        return H, V, H, V - weight * length, 0.0, xx, xz, xz, zz, SUSPENDED
    H, S = solve_grounded(x, z, length, weight, flexibility, slope, friction)
    end, _ = lying_end(H, length - S, weight, slope, friction)
    k = grounded_stiffness(H, S, length, weight, flexibility, slope, friction)
    V = H * tan + weight * S
    H_end, V_end = end * math.cos(slope), end * math.sin(slope)
    return H, V, H_end, V_end, length - S, k[0], k[1], k[2], k[3], GROUNDED


@kernel()
def solve_uniform_lines(lines, bed):
    """lines : (n, 7) rows of `solve_uniform`; returns (n, 10)"""
    found = np.empty((lines.shape[0], 10))
    for i in range(lines.shape[0]):
        row = lines[i]
        line = (row[0], row[1], row[2], row[3], row[4], row[5], row[6])
        found[i] = np.array(solve_uniform(line, bed))
    return found
