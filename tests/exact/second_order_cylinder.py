"""Second-order load of two waves on a cylinder that stands on the sea bed, at the difference or sum of frequencies.

On the cylinder the first-order potential is that of MacCamy and Fuchs (1954).  Coefficients T are those of
Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp(−i(ωᵢ − ωⱼ)t), so that T_ii is the mean drift and of a pair of waves 2T the amplitude; with
`sums` those of Re Σᵢ Σⱼ aᵢ aⱼ T_ij exp(−i(ωᵢ + ωⱼ)t).  Both waves travel along x; time factor exp(−iωt).  Loads are the
surge force, with `moment` the pitch moment about the middle of the waterline.  Nothing of the product is used.
"""

from __future__ import annotations

import numpy as np
from scipy.special import h1vp, hankel1, hankel1e, hankel2, hankel2e, jv, jvp, kve

from .water_waves import cosh_ratio, evanescent_wavenumbers, sinh_ratio, wave_norm, wavenumber

POINTS = 60  # Gauss points over the depth


def long_wave_force(radius, depth, omega, kappa, density=1025.0, gravity=9.80665, modes=4000, moment=False):
    """N/m, N m/m: load of a wave of unit amplitude with any wavenumber κ, and of the free waves it diffracts

    Z_κ is a sum of the eigenfunctions of the frequency, each of which diffracts by itself; the error falls like
    modes⁻³.
    """
    a, h = radius, depth
    k, kn = wavenumber(omega, h, gravity), evanescent_wavenumbers(omega, h, modes, gravity)
    K = omega**2 / gravity
    # ∫ Z_κ f dζ = (f Z_κ′ − f′ Z_κ) / (κ² − k²) at the surface, where f = 1 and f′ = K f
    jump = kappa * np.tanh(kappa * h) - K
    over_wave, over_local = jump / (kappa**2 - k**2), jump / (kappa**2 + kn**2)
    norms = h / 2 * (1 + np.sin(2 * kn * h) / (2 * kn * h)) / np.cos(kn * h) ** 2
    heights = _over_depth(k, h, moment), _over_depth(kn, h, moment, local=True)
    x = kn * a
    ratios = hankel1(1, k * a) / (k * h1vp(1, k * a)), -1 / (kn * (kve(0, x) / kve(1, x) + 1 / x))
    diffracted = over_wave / wave_norm(k, h) * heights[0] * ratios[0]
    diffracted = diffracted + np.sum(over_local / norms * heights[1] * ratios[1])
    incident = jv(1, kappa * a) * _over_depth(kappa, h, moment)
    return -2j * np.pi * a * density * gravity * (incident - kappa * jvp(1, kappa * a) * diffracted)


def _over_depth(k, h, moment, local=False):
    """∫ f dζ, or ∫ f (ζ − h) dζ, of f = cosh kζ / cosh kh, of a local mode cos kζ / cos kh"""
    if local:
        return (1 - 1 / np.cos(k * h)) / k**2 if moment else np.tan(k * h) / k
    return (1 / np.cosh(k * h) - 1) / k**2 if moment else np.tanh(k * h) / k


def quadratic_force(radius, depth, one, two, density=1025.0, gravity=9.80665, sums=False, moment=False):
    """T, N/m², N m/m², of the first-order pressures: waterline and velocities squared"""
    (Z, slope, side), (Y, steep, other) = (_wave(radius, depth, w, gravity) for w in (one, two))
    x, w = np.polynomial.legendre.leggauss(POINTS)
    w = w * depth / 2 * (depth * (x - 1) / 2 if moment else 1.0)
    m = np.arange(max(len(side), len(other)) + 1)
    p, q = (np.concatenate([s, np.zeros(len(m) - len(s))]) for s in (side, other))
    q = q if sums else q.conj()
    # φ = Σ p_m cos mθ: ∫ cosθ cos mθ cos nθ dθ and ∫ cosθ m n sin mθ sin nθ dθ, |m − n| = 1
    share = np.where(m[:-1] == 0, np.pi, np.pi / 2)
    cosines = np.sum(share * (p[:-1] * q[1:] + p[1:] * q[:-1]))
    along = m[:-1] * m[1:] * np.pi / 2
    sines = np.sum(along * (p[:-1] * q[1:] + p[1:] * q[:-1]))
    # elevations are iωφ/g: their product has −ωᵢωⱼ without the conjugate
    crest = (
        0.0 if moment else -density * gravity / 4 * ((-1 if sums else 1) * one * two / gravity**2) * cosines * radius
    )
    speed = sines / radius * (w @ (Z * Y)) + cosines * radius * (w @ (slope * steep))
    return crest + density / 4 * speed


def _wave(radius, depth, omega, gravity):
    """Z and Z′ at Gauss points over the depth; amplitudes of cos mθ of the potential at the waterline"""
    k = wavenumber(omega, depth, gravity)
    x = k * radius
    m = np.arange(int(x + 6 * np.cbrt(x) + 14))
    side = np.where(m, 2, 1) * 1j**m * 2j / (np.pi * x * h1vp(m, x)) * -1j * gravity / omega
    zeta = depth * (np.polynomial.legendre.leggauss(POINTS)[0] + 1) / 2
    return cosh_ratio(zeta, k, depth), k * sinh_ratio(zeta, k, depth), side


def free_surface_force(
    radius, depth, one, two, density=1025.0, gravity=9.80665, modes=200, sums=False, moment=False, further=0.0
):
    """T, N/m², N m/m², of the forcing of the surface by products of the waves, less that of the incident waves alone.

    iΩρ/g ∬ ψ Q dS with the radiation potential ψ of unit surge or pitch velocity at Ω = one − two > 0 or at the sum
    (Molin 1979; Eatock Taylor and Hung 1987), on the real axis to where Hankel functions of all orders oscillate, and
    `further` m, then along r ± it, where the product of three of them decays: at the sum of frequencies all three
    products of sent and incident waves along r + it, since κ > k + q
    """
    a, h, omega = radius, depth, one + two if sums else one - two
    k, q = (wavenumber(w, h, gravity) for w in (one, two))
    K, L, far = one**2 / gravity, two**2 / gravity, wavenumber(omega, h, gravity)
    count = int(k * a + 5 * np.cbrt(k * a) + 8)
    end = (count + 10) / min(k, q) + further
    back = -two if sums else two
    size = -0.5j * omega, 0.5j * omega * K * L + 0.25j * (back * (k**2 - K**2) - one * (q**2 - L**2))
    ψ = _surge_radiation(a, h, omega, gravity, modes, moment)

    def kernel(r, pieces, wave):
        """Integrand at r (p,); pieces : of (kind of i, kind of j, coefficient (m, n))"""
        total = 0.0
        for first, second, weight in pieces:
            f, g = _radial(first, count, k, r), _radial(second, count, q, r)
            total = total + _forcing(f, g, weight, r, (-size[0], size[1]))
        return total * wave(r) * r

    b, c = (_diffracted(count, x * a) for x in (k, q))
    turns, c, sent = (_turns(count), c, "H") if sums else (_turns(count).conj(), c.conj(), "h")
    scale = np.multiply.outer(_turns(count) / one, turns / two) * gravity**2
    cut = np.ones((count, count))
    inside = [
        ("H", sent, scale * np.multiply.outer(b, c)),
        ("J", sent, -scale * cut * c),
        ("H", "J", -scale * cut * b[:, None]),
    ]
    x, w = np.polynomial.legendre.leggauss(16)
    edges = a + (end - a) * np.linspace(0, 1, int(4 + 4 * (k + q + far) * (end - a) / np.pi)) ** 1.5
    r = (edges[:-1, None] + np.diff(edges)[:, None] * (1 + x) / 2).ravel()
    total = np.sum((np.diff(edges)[:, None] * w / 2).ravel() * kernel(r, inside, lambda r: ψ[0](r) + ψ[1](r)))
    t, v = np.polynomial.laguerre.laggauss(50)
    both = scale * (np.multiply.outer(0.5 - b, 0.5 - c) - 0.25)
    one_only, other_only = scale * -0.5 * cut * b[:, None], scale * -0.5 * cut * c
    if sums:
        tails = [
            (k + q + far, [("H e", "H e", both)]),
            (k - q + far, [("H e", "h e", one_only)]),
            (q - k + far, [("h e", "H e", other_only)]),
        ]
    else:
        tails = [
            (k - q + far, [("H e", "h e", both)]),
            (k + q + far, [("H e", "H e", one_only)]),
            (far - k - q, [("h e", "h e", other_only)]),
        ]
    for slope, pieces in tails:
        turn = 1j / slope  # exponents of the three Hankel functions make exp(i slope r) = exp(i slope end − t)
        total += np.exp(1j * slope * end) * turn * (v @ kernel(end + turn * t, pieces, ψ[2]))
    return 1j * omega * density / gravity * total


def _turns(count):
    """ε_m iᵐ of orders 0 … count − 1, times −i"""
    m = np.arange(count)
    return -1j * np.where(m, 2, 1) * 1j**m


def _diffracted(count, x):
    """J′/H′ of orders 0 … count − 1"""
    m = np.arange(count)
    return jvp(m, x) / h1vp(m, x)


def _surge_radiation(a, h, omega, gravity, modes, moment=False):
    """The wave and the local part of ψ at the surface over r, and the wave without exp(ikr)"""
    k, kn = wavenumber(omega, h, gravity), evanescent_wavenumbers(omega, h, modes, gravity)
    norms = h / 2 * (1 + np.sin(2 * kn * h) / (2 * kn * h)) / np.cos(kn * h) ** 2
    wave = _over_depth(k, h, moment) / wave_norm(k, h) / (k * h1vp(1, k * a))
    x = kn * a
    local = _over_depth(kn, h, moment, local=True) / norms / (-kn * (kve(0, x) + kve(1, x) / x))
    return (
        lambda r: wave * hankel1(1, k * r),
        lambda r: sum(c * kve(1, n * r) * np.exp(-n * (r - a)) for c, n in zip(local, kn, strict=True)),
        lambda r: wave * hankel1e(1, k * r),
    )


def _radial(kind, count, k, r):
    """Values and slopes (2, m, p) of J, H⁽¹⁾ (H) or H⁽²⁾ (h), e: of the latter without their exponentials"""
    function = {"J": jv, "H": hankel1, "h": hankel2, "H e": hankel1e, "h e": hankel2e}[kind]
    value = function(np.arange(-1, count + 1)[:, None], k * r)
    return np.stack([value[1:-1], k * (value[:-2] - value[2:]) / 2])


def _forcing(f, g, weight, r, size):
    """(p,) ∫ cosθ Q dθ of orders one apart; size : of ∇φ·∇φ̄ along the surface, of φφ̄"""
    m, total = np.arange(len(f[0]) - 1), 0.0
    share, turned = np.where(m == 0, np.pi, np.pi / 2)[:, None], (m * (m + 1) * np.pi / 2)[:, None] / r**2
    for one, two, c in (
        (f[:, :-1], g[:, 1:], np.diagonal(weight, 1)),
        (f[:, 1:], g[:, :-1], np.diagonal(weight, -1)),
    ):
        value, slope = one[0] * two[0], one[1] * two[1]
        total = total + c @ (size[0] * (share * slope + turned * value) + size[1] * share * value)
    return total
