"""Strain of dolphin fenders by the design spectrum method, and the allowable wave height.

    static:   n R(δ₀) = F_wind + F_current + F_drift
    dynamic:  σ² = ∫ S |y|² dω,  y the displacement at the mooring point of the body on n springs
    Y_MAX = δ₀ + 3.87 σ,  compared with δ₀/H ≤ 10 % and Y_MAX/H ≤ 35 %

3.87 = √(2 ln 1000) + γ/√(2 ln 1000) is the expected largest of 1000 waves over σ.  The spring is given for each
fender, or is the equivalent spring of its curve and hysteresis about δ₀ with the amplitude √2 σ, found by iteration
(`linearised`). SR179 report (1982), sections 3.7.1.1 and 3.7.5.
"""

import math
from typing import NamedTuple

import numpy as np

from .linearised import equivalent

LARGEST = math.sqrt(2 * math.log(1000)) + 0.5772156649 / math.sqrt(2 * math.log(1000))  # 3.872 σ
STATIC, TOTAL = 0.10, 0.35  # strains that are allowed
ROUNDS, SETTLED = 200, 1e-5  # iterations for the equivalent spring: largest number, relative change at the end
FREQUENCIES = 400


class DolphinError(ValueError):
    """A dolphin study cannot be made; the message names the fault and the limit."""


class Dolphins(NamedTuple):
    """Fenders on the side towards which the loads push

    fender : one fender with its dolphin; positions : x, y, z of each fender, (n, 3) m; stiffness : stiffness of one
        fender, N/m, None for the equivalent stiffness of its curve
    """

    fender: object
    positions: np.ndarray
    stiffness: float | None = None


class Strains(NamedTuple):
    """static : δ₀, m; sigma : at the mooring point, m; largest : Y_MAX, m; stiffness, loss : of one fender, N/m

    drift : N; static_strain, strain : deflections over the fender's height; stands : whether both strains are within
        limits
    """

    static: float
    sigma: float
    largest: float
    stiffness: float
    loss: float
    drift: float
    static_strain: float
    strain: float
    stands: bool


class Beam(NamedTuple):
    """A body in waves of one direction, read once from a database. omega : (q,) rad/s; inertia : (q, 6, 6) with
    added mass; damping : (q, 6, 6); stiffness : (6, 6); force : (q, 6) N/m …; drift : (q,) N/m² across the freely
    floating body; center : (3,) m
    """

    omega: np.ndarray
    inertia: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    force: np.ndarray
    drift: np.ndarray
    center: np.ndarray


def beam_of(body, direction=0.5 * math.pi):
    """`Beam` of a `bem.database.reader.Reader`, floating, in waves that travel to `direction`, rad"""
    omega = np.linspace(body.omega[0], body.omega[-1], FREQUENCIES)
    A, B = body.coefficients(omega)
    force = body.forces(omega, [direction])[:, 0]
    drift = body.drift(omega, [direction])[:, 0, 1] if body.knows_drift else np.zeros(FREQUENCIES)
    return Beam(
        omega, body.inertia + A, B + body.damping, body.stiffness, force, drift, np.asarray(body.rotation_center, float)
    )


def springs(dolphins, center, stiffness):
    """Stiffness of n springs across the body, each of `stiffness`; shape (6, 6)"""
    out = np.zeros((6, 6))
    for x, _, z in np.asarray(dolphins.positions, float) - center:
        row = np.array([0.0, 1.0, 0.0, -z, 0.0, x])
        out += stiffness * np.outer(row, row)
    return out


def at_fenders(beam, dolphins, stiffness, loss):
    """Sway |y| per metre of wave amplitude, m/m, at the middle of the fenders; shape (q,). Each spring has the complex
    stiffness k − ih."""
    w = beam.omega[:, None, None]
    held = beam.stiffness + springs(dolphins, beam.center, stiffness) - 1j * springs(dolphins, beam.center, loss)
    motion = np.linalg.solve(-(w**2) * beam.inertia - 1j * w * beam.damping + held, beam.force[..., None])[..., 0]
    x, _, z = np.mean(np.asarray(dolphins.positions, float), axis=0) - beam.center
    return np.abs(motion @ np.array([0.0, 1.0, 0.0, -z, 0.0, x]))


def deflection_at(fender, force):
    """Smallest deflection, m, at which a fender's reaction is `force`, N. Raises DolphinError if the reaction never
    reaches it.
    """
    grid = np.linspace(0.0, fender.limit, 2001)
    above = np.flatnonzero(fender.loading(grid) >= force)
    if not len(above):
        raise DolphinError(
            f"{fender.name}: {force / 1e3:.4g} kN act on it, but its table ends at "
            f"{fender.largest_reaction(fender.limit) / 1e3:.4g} kN; use more or larger fenders"
        )
    low, high = (grid[above[0] - 1], grid[above[0]]) if above[0] else (0.0, 0.0)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fender.loading(middle) < force else (low, middle)
    return 0.5 * (low + high)


def strains(beam, dolphins, steady, spectrum, times=1.0):
    """`Strains` of a `Beam` in a sea; steady : force of wind and current across the body, N

    spectrum : Spectrum of `mooring.environment`; times : factor on its height

    raises : DolphinError where the fenders cannot carry the steady load
    """
    fender, density = dolphins.fender, times**2 * spectrum.density(beam.omega)
    drift = 2 * float(np.trapezoid(beam.drift * density, beam.omega))
    force = abs(steady + drift) / len(dolphins.positions)
    k, loss, sigma = dolphins.stiffness, 0.0, 0.0
    static = force / k if k else deflection_at(fender, force)
    if k is None:
        k = float(fender.loading.slope(static))
    for _ in range(ROUNDS if dolphins.stiffness is None else 1):
        before, y = sigma, at_fenders(beam, dolphins, k, loss)
        sigma = math.sqrt(float(np.trapezoid(y**2 * density, beam.omega)))
        if dolphins.stiffness is not None or abs(sigma - before) <= SETTLED * sigma:
            break
        amplitude = min(math.sqrt(2) * sigma, 0.999 * (fender.limit - static))
        found = equivalent(fender, static, amplitude, points=128)
        k, loss = 0.5 * (k + found.stiffness), 0.5 * (loss + found.loss)
    largest = static + LARGEST * sigma
    shares = static / fender.height, largest / fender.height
    return Strains(static, sigma, largest, k, loss, drift, *shares, shares[0] <= STATIC and shares[1] <= TOTAL)


def limit_height(beam, dolphins, steady, family, period, highest=10.0):
    """Largest significant height, m, with allowable strains; 0 where the steady load alone exceeds the allowable
    strains.

    family : function of height, mean_period= → spectrum; highest : upper end of the search, m
    """

    unit = family(1.0, mean_period=period)

    def stands(height):
        try:
            return strains(beam, dolphins, steady, unit, height).stands
        except DolphinError:
            return False

    low, high = 0.0, highest
    if stands(highest):
        return highest
    while high - low > 1e-3:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stands(middle) else (low, middle)
    return low if low > 1e-3 else 0.0
