"""Mean drift of each of several bodies from the partial waves about the body.

Waves of one depth mode n carry the momentum of a plane problem through a circle around one body. With N = ∫Zₙ² dz and
g = ∂f/∂x, ∂f/∂y or ∂f/∂θ for the force along x, along y and the moment about the axis,

    F = −¼ρN Re Q,    Q = ∮ (g ∂f*/∂n − f* ∂g/∂n) ds

because ∫Zₙ′² dz contains the square of the elevation at the waterline, and modes are orthogonal. f and g are sums of Jₘ
and Hₘ, or of Iₘ and Kₘ, with coefficients a, b and α, β. The products leave Wronskians:

    Q = −4i Σ (αₘ bₘ* + βₘ aₘ* + 2 βₘ bₘ*),    of modes that decay  2π Σ (βₘ aₘ* − αₘ bₘ*)

The momentum of the water inside the circle is unchanged after a period, so that Q gives the mean force on a fixed or
a floating body.
"""

import numpy as np
from scipy.special import ive


def mean_force(waves, norms, radius, regular, sent, density):
    """Mean force along x and y of the scene and moment about the axis, in each of c flows, N, N m; shape (c, 3).

    waves, norms : [`partial_waves.PartialWaves`], and ∫Zₙ² dz of each, m; radius : radius of the circle around the
        body, m
    regular, sent : coefficients of regular and outgoing waves, mode by mode, m²/s, (q, c)
    """
    out, start = np.zeros((regular.shape[1], 3)), 0
    for one, norm in zip(waves, norms, strict=True):
        own = slice(start, start + 2 * one.last + 1)
        start = own.stop
        m, travels = one.orders, one.kind == "radiating"
        if travels:  # |m| for m changes the sign of odd orders below zero
            scale = np.where(m < 0, (-1.0) ** m, 1.0) * one.size(radius)[np.abs(m)]
        else:
            scale = np.exp(-one.k * radius) / ive(np.abs(m), one.k * radius)
        a, b = scale[:, None] * regular[own], sent[own] / scale[:, None]
        k, product = one.k, _of_waves if travels else _of_decaying
        # ∂x ± i∂y of J and H, of I, of K
        up, up_sent, down, down_sent = (-k, -k, k, k) if travels else (k, -k, k, -k)
        plus = product(up * _shifted(a, 1), up_sent * _shifted(b, 1), a, b)
        minus = product(down * _shifted(a, -1), down_sent * _shifted(b, -1), a, b)
        turned = product(1j * m[:, None] * a, 1j * m[:, None] * b, a, b)
        along = np.stack([(plus + minus) / 2, (plus - minus) / 2j, turned], axis=-1)
        out -= 0.25 * density * norm * along.real
    return out


def _shifted(a, by):
    """Coefficients of the orders that are one higher or lower"""
    out = np.zeros_like(a)
    if by == 1:
        out[1:] = a[:-1]
    else:
        out[:-1] = a[1:]
    return out


def _of_waves(alpha, beta, a, b):
    return -4j * np.sum(alpha * b.conj() + beta * (a + 2 * b).conj(), axis=0)


def _of_decaying(alpha, beta, a, b):
    return 2 * np.pi * np.sum(beta * a.conj() - alpha * b.conj(), axis=0)
