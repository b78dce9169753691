"""A line that touches nothing between its ends: the elastic catenary as one monotone equation.

Point (V, H) of the force plane is written in elliptic coordinates about (0, 0) and (wL, 0), c = wL/2:

    V = c (1 + √(1+t²) cos ν),    H = c t sin ν,    κ = wL / 2EA

With these the textbook equations (SR179 report, 1982, section 3.1.1, integrated) become a pair of products

    x = L sin ν · t (asinh(1/t) + κ),    z = L cos ν · (1 + κ √(1+t²)),

so that t solves (x/LP)² + (z/LQ)² = 1 with P = t (asinh 1/t + κ) and Q = 1 + κ√(1+t²) where the span is known, and
(H/ct)² + (z/LQ)² = 1 where the tension is.  There is one root, with a proven bracket, and no difference of large
numbers when the line is taut.  Newton's step is used while it remains inside the bracket.
"""

import math

from hakobune.bem.kernels.jit import kernel

from .free_piece import ROUNDING, asinh_excess


@kernel(inline=True)
def ellipse_parameter(X, Z, kappa, near, close):
    """Parameter t of a suspended line with span X and height Z, both divided by the line's length; inf for ends too
    far apart.

    near : a value near t, 0 if unknown; close : tolerance on the last change of ln t, relative to ln t
    """
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
    q = math.log(near) if near > 0 else high
    if not low <= q <= high:
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
        settled = abs(following - q) <= close * max(1.0, abs(q))
        q = following
        if settled:
            break
    return math.exp(q)


@kernel(inline=True)
def suspended_shape(x, z, length, weight, flexibility):
    """The parameters t, sin ν and cos ν of a line that touches nothing."""
    X, Z, kappa = x / length, z / length, 0.5 * flexibility * weight * length
    t = ellipse_parameter(X, Z, kappa, 0.0, ROUNDING)
    if math.isinf(t):
        return t, 0.0, Z
    cosine = min(max(Z / (1 + kappa * math.sqrt(1 + t * t)), -1.0), 1.0)
    if X == 0:
        sine = 0.0 if t > 0 else math.sqrt(max(1 - cosine * cosine, 0.0))
    else:
        sine = min(X / (t * (math.asinh(1 / t) + kappa)), 1.0)
    return t, sine, cosine


@kernel(inline=True)
def suspended_stiffness(t, s, c, length, weight, flexibility):
    """∂H/∂x, ∂H/∂z = ∂V/∂x, ∂V/∂z; all terms have one sign, so the determinant contains no difference."""
    kappa = 0.5 * flexibility * weight * length
    if t == 0:
        return 0.0, 0.0, 0.5 * weight / (kappa + 1)
    root = math.sqrt(1 + t * t)
    norm = t * t + s * s
    a, b, d = t * t * c * c / (root * norm), root * s * s / norm, t * s * c / norm
    h = asinh_excess(1 / t)
    scale = 0.5 * weight / (kappa * kappa + kappa * (h + a + b) + h * b)
    return scale * (kappa + b), scale * d, scale * (kappa + h + a)


@kernel(inline=True)
def suspended_span(H, z, length, weight, flexibility):
    """Span of a line that carries the horizontal tension H > 0 over the height z; nan where the line is too short to
    hang."""
    Z, kappa, pull = z / length, 0.5 * flexibility * weight * length, 2 * H / (weight * length)
    inside = 1 - Z * Z
    if kappa == 0 and inside <= 0:
        return math.nan
    # total ≤ 1 at high: Q ≥ 1, and with stretch Q ≥ κt
    high = math.inf
    if kappa > 0:
        high = 1.5 * max(pull, abs(Z) / kappa)
    if kappa == 0 or inside > 0:
        high = min(high, pull / math.sqrt(max(inside, 1e-300)))
    low, high = math.log(pull), math.log(high)
    q = high
    for _ in range(200):
        t = math.exp(q)
        root = math.sqrt(1 + t * t)
        Q = 1 + kappa * root
        across, up = (pull / t) ** 2, (Z / Q) ** 2
        total = across + up
        value = math.log(total)
        if value >= 0:
            low = q
        if value <= 0:
            high = q
        following = q + 0.5 * value * total / (across + up * kappa * t * t / (root * Q))
        if not low <= following <= high:
            following = 0.5 * (low + high)
        settled = abs(following - q) <= ROUNDING * max(1.0, abs(q))
        q = following
        if settled:
            break
    t = math.exp(q)
    return length * min(pull / t, 1.0) * t * (math.asinh(1 / t) + kappa)
