"""Far-field amplitude of the waves radiated and diffracted by a body, after Kochin.

    η ~ H(θ) √(2/(πkR)) exp(i(kR − π/4))    for R → ∞ in direction θ,
    H(θ) = −(k²/4nω) ∬ (φ ∂ψ/∂n − ψ ∂φ/∂n) dS,    ψ = Z(z) exp(−ik(x cosθ + y sinθ))

with n = C_g/C and Z(z) = cosh k(z+h)/cosh kh.  H is per unit wave amplitude (diffraction) or per unit amplitude of
motion, m or rad (radiation).  The function of SR179 report (1982), eq. 2.1.5.15, is −2g/ω times this one, per
unit velocity; it has source strengths where a direct solution has φ and ∂φ/∂n.
"""

from __future__ import annotations

import math

import numpy as np

from .kernels.jit import kernel
from .kernels.threads import parallel_rows


def far_field_integrals(theta, k, points, weights, normals, Z, images, signs, phi, velocity):
    """∬ (φ ∂ψ/∂n − ψ ∂φ/∂n) dS and its θ-derivative for potentials of one symmetry class, over the whole hull.

    theta : (t,) rad; k : rad/m; points (q, 3) m, weights (q,) m² and normals (q, 3) of one of its symmetric parts
    Z : (q, 2) Z(z) and Z'(z), 1/m; images : (i, 2) ±1 for x and y; signs : (i,) ±1 of the potential there
    phi, velocity : (r, q) complex, m²/s and m/s, or the same per unit of anything
    returns : two (r, t) complex arrays, m³/s and m³/s per rad
    """
    value, slope = np.zeros((2, len(phi), len(theta)), complex)
    arguments = theta, k, points, weights, normals, Z, images, signs, phi, velocity

    def work(low, high):
        _integrals(low, high, *arguments, value, slope)

    parallel_rows(work, len(theta), len(theta) * len(points) * len(images))
    return value, slope


@kernel()
def _integrals(low, high, theta, k, points, weights, normals, Z, images, signs, phi, velocity, value, slope):
    """`far_field_integrals` in the directions `low` to `high`, added to value and slope (r, t)"""
    for a in range(low, high):
        c, s = math.cos(theta[a]), math.sin(theta[a])
        for q in range(len(points)):
            even, flux = 0j, 0j
            deven, dflux = 0j, 0j
            for m in range(len(images)):
                x, y = images[m, 0] * points[q, 0], images[m, 1] * points[q, 1]
                nx, ny = images[m, 0] * normals[q, 0], images[m, 1] * normals[q, 1]
                phase, turn = k * (x * c + y * s), k * (y * c - x * s)
                wave = signs[m] * weights[q] * complex(math.cos(phase), -math.sin(phase))
                dwave = -1j * turn * wave
                along, across = -1j * k * (nx * c + ny * s), -1j * k * (ny * c - nx * s)
                even += wave
                deven += dwave
                flux += wave * (along * Z[q, 0] + normals[q, 2] * Z[q, 1])
                dflux += dwave * (along * Z[q, 0] + normals[q, 2] * Z[q, 1]) + wave * across * Z[q, 0]
            for p in range(len(phi)):
                value[p, a] += phi[p, q] * flux - velocity[p, q] * even * Z[q, 0]
                slope[p, a] += phi[p, q] * dflux - velocity[p, q] * deven * Z[q, 0]


def angles(k, radius):
    """θ (t,) equally spaced so that H of a body within `radius` m of the origin is resolved at wavenumber k.

    H is band-limited: its harmonics beyond k·radius fall faster than any power.
    """
    harmonics = int(np.ceil(k * radius + 6 * (k * radius) ** (1 / 3) + 8))
    count = 4 * int(np.ceil((2 * harmonics + 2) / 4))
    return np.arange(count) * (2 * np.pi / count)
