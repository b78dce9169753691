"""A free piece of line between two tensions, from the forces at its lower end, by the formulas of the elastic catenary.

    x = H S/EA + (H/w) ln[(V+T)/(V_low+T_low)],    z = S (V+V_low)/2EA + S (V+V_low)/(T+T_low),    V = V_low + w S

SR179 report (1982), section 3.1.1, integrated.  Scalars in, scalars out.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

ROUNDING = 8 * 2.220446049250313e-16


@kernel(inline=True)
def asinh_excess(s):
    """asinh s − s/√(1+s²) without cancellation; s³/3 for small s ≥ 0."""
    if s >= 0.1:
        return math.asinh(s) - (1.0 if math.isinf(s) else s / math.sqrt(1 + s * s))
    u = s * s
    # aₙ 2n/(2n+1) with aₙ = (2n)!/(4ⁿ n!²); the next term is below 1e-15 of the sum at s = 0.1
    series = -35 / 144 + u * (315 / 1408 + u * (-693 / 3328 + u * (3003 / 15360 - u * 6435 / 34816)))
    return s * u * (1 / 3 + u * (-3 / 10 + u * (15 / 56 + u * series)))


@kernel(inline=True)
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


@kernel(inline=True)
def free_pieces(H, V_low, S, weight, flexibility):
    """`free_piece` of (n,) pieces; returns x and z, (n,) each"""
    x, z = np.empty(H.size), np.empty(H.size)
    for i in range(H.size):
        x[i], z[i] = free_piece(H[i], V_low[i], S[i], weight[i], flexibility[i])
    return x, z
