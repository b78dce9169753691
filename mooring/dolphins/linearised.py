"""Equivalent linearisation of a restoring law, with hysteresis, and the periods of free motion that it approaches.

In a steady motion y = y₀ + A cos θ, θ = ωt, the law G has the mean and the first harmonics

    F₀ = (1/2π) ∮ G dθ,    k = (1/πA) ∮ G cos θ dθ,    h = −(1/πA) ∮ G sin θ dθ = ωc,    ∮ G dy = π h A²

(Krylov and Bogoliubov).  An oscillator with them has m ω² = k(A) in free motion, which the exact period

    T = 4 ∫₀^{A} dy / √(2 [V(A) − V(y)]/m),    V = ∫ G dy        (a law odd about y₀)

is what the linearised one approximates: Duffing's is 1.6e-3 off at εA²/k = 0.5, 7.7e-3 at 2, 2.2e-2 with ε alone.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..fenders.hysteresis import followed

POINTS = 4096  # of a cycle: a corner of the law costs 1e-7
ROOTS = 2000  # amplitudes between which a response is looked for


class Equivalent(NamedTuple):
    """mean : F₀ N; stiffness : k N/m; loss : h = ωc N/m"""

    mean: float
    stiffness: float
    loss: float


def equivalent(law, mean, amplitude, points=POINTS):
    """`Equivalent` of a law about y₀ = mean with an amplitude, m.

    law : function of a path (n,) m that begins and ends alike → (n,) N, or a `mooring.fenders.fender.Fender`
    """
    theta = 2 * np.pi * np.arange(points) / points
    path = mean + amplitude * np.cos(theta)
    force = _steady(law, path) if hasattr(law, "return_length") else np.asarray(law(path), float)
    return Equivalent(
        float(force.mean()),
        float(2 * np.mean(force * np.cos(theta)) / amplitude),
        float(-2 * np.mean(force * np.sin(theta)) / amplitude),
    )


def _steady(fender, path):
    """Reaction along a cycle once it has come to its loop; a fender without return has none to come to"""
    fender.reaction(max(path.max(), 0.0))  # raises beyond the table
    if np.array_equal(fender.loading.coefficients, fender.unloading.coefficients):
        return fender.loading(path)
    return followed(fender, np.concatenate([path, path]))[0][len(path) :]


def free_frequency(law, mass, amplitude, mean=0.0):
    """rad/s of free motion by equivalent linearisation"""
    return float(np.sqrt(equivalent(law, mean, amplitude).stiffness / mass))


def exact_frequency(potential, mass, amplitude, corners=(), order=64):
    """rad/s of free motion in a potential V (function of y ≥ 0 → J, even), exact; corners : m, of the law"""
    x, w = np.polynomial.legendre.leggauss(order)
    ends = np.arcsin([0.0, *sorted(c / amplitude for c in corners if 0 < c < amplitude), 1.0])
    quarter = 0.0
    for a, b in pairwise(ends):
        # φ = b − (b − a)(1 − t)²: the speed has a square root where a corner is met, and V(A) − V(y) cancels at the end
        t = 0.5 * (x + 1)
        phi, jacobian = b - (b - a) * (1 - t) ** 2, 2 * (b - a) * (1 - t)
        y = amplitude * np.sin(phi)
        left = potential(np.full_like(y, amplitude)) - potential(y)
        quarter += np.sum(0.5 * w * jacobian * amplitude * np.cos(phi) / np.sqrt(2 * left / mass))
    return float(0.5 * np.pi / quarter)


def amplitudes(law, mass, damping, omega, force, largest, mean=0.0):
    """Amplitudes (r,) m up to `largest` of the oscillator m ÿ + c ẏ + G = F cos ωt, rising; jumps have three.

    damping : c N s/m beside the law's own; force : F N
    """
    A = largest * (np.arange(1, ROOTS + 1) / ROOTS)

    def excess(a):
        e = equivalent(law, mean, a, points=256)
        return (e.stiffness - omega**2 * mass) ** 2 * a * a + (omega * damping + e.loss) ** 2 * a * a - force**2

    values = np.array([excess(a) for a in A])
    found = []
    for i in np.flatnonzero(np.diff(np.sign(values)) != 0):
        low, high = A[i], A[i + 1]
        for _ in range(50):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if (excess(middle) > 0) == (values[i] > 0) else (low, middle)
        found.append(0.5 * (low + high))
    if values[0] > 0:  # the root below the first amplitude
        found.insert(0, float(A[0] * abs(force) / np.sqrt(values[0] + force**2)))
    return np.array(found)
