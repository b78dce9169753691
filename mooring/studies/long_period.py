"""Long-period motion of a moored body in surge, sway and yaw, before any simulation: by a quick rule, by the spectrum.

    m ẍ + N ẋ + K x = F₀ + F(t),    ω₀² = K/m,    ν = N/√(mK),    x_s = F₀/K

Quick (SR179 report (1982), eq. 3.5.4.1):  σ = x_s/(2ν), with F₀ the mean drift. Spectrum:  σ² = ∫ S_F(ω) / {(K − mω²)²
+ (Nω)²} dω,  S_F of slow drift, gusts and the waves themselves below the split (`slow_spectrum`).  Only a simulation
includes subharmonics of stiffening lines and rectified line forces, and shows where the estimates fail.

Each motion is treated separately: K is its diagonal entry of the mooring stiffness in equilibrium under steady
forces, and m includes the added mass at ω₀. N = ∂F/∂ẋ of the water's drag, averaged over Gaussian velocities of
waves and of the slow motion itself (statistical linearisation, Caughey 1963), of wave drift damping, and of
radiation at ω₀.
"""

from dataclasses import replace
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from ..loads.on_hull import current_on, turning_drag
from ..on_current.body import on_current
from ..on_current.waves import carrier_of
from ..response.sea_state import sea_state
from ..response.viscous import in_sea
from .slow_spectrum import PLANE, drift_of_sea, gust_spectrum, wave_spectrum
from .steady_loads import with_coefficients
from .wave_effects import sea_of

LOWEST = 1e-3  # share of the waves' energy below the frequencies that count as slow
TURNS = 60  # iterations on the velocity of the slow motion
SETTLED = 1e-6
STILL = 1e-3  # m/s, or rad/s times the length, below which a motion counts as zero


class LongPeriod(NamedTuple):
    """Values of surge, sway and yaw, each (3,): period, s, nan without restoring; ν; x_s, m and rad

    quick, by_spectrum : standard deviations, m, rad; split : rad/s, upper end of slow motion
    """

    period: np.ndarray
    damping: np.ndarray
    static: np.ndarray
    quick: np.ndarray
    by_spectrum: np.ndarray
    split: float


def long_period(db, hull, result, gusts=None):
    """`LongPeriod` of a MultiPoint result in irregular waves; hull : ExposedBox; gusts : GustSpectrum, or None"""
    conditions = result.conditions
    sea = sea_of(conditions)
    body, _ = in_sea(on_current(db.reader, carrier_of(conditions.current)), sea)
    state = sea_state(body, sea, conditions.duration)
    split = float(sea.spectrum.quantile(LOWEST))
    omega = np.linspace(0.0, split, 2001)[1:]
    both = drift_of_sea(body, sea).slow_spectrum(omega)
    if gusts is not None:
        both += gust_spectrum(gusts, result.loads["wind"][PLANE], omega)
    force = np.einsum("dii->di", both) + wave_spectrum(body, sea, omega)
    waves = np.sqrt(state.moments.m2[PLANE])
    K = np.diag(result.equilibrium.stiffness)[PLANE]
    drag = _drag_of(conditions.current, hull, db)
    drift_damping = np.zeros((3, 2)) if state.slow.damping is None else state.slow.damping
    rows = []
    for j in range(3):
        other = drift_damping[j, j] if j < 2 else 0.0
        rows.append(_one(body, K[j], PLANE[j], omega, force[:, j], waves[j], lambda s, j=j: drag(j, s), other))
    period, damping, spread = np.array(rows).T
    with np.errstate(divide="ignore", invalid="ignore"):
        static = np.where(K > 0, np.abs(result.loads["drift"][PLANE]) / K, np.nan)
        quick = static / (2 * damping)
    return LongPeriod(period, damping, static, quick, spread, split)


def _one(body, K, mode, omega, force, waves, drag, other):
    """Period, ν and σ of one motion; force : (n,) S_F at omega; waves : σ of its velocity in waves; other : N s/m"""
    if not K > 0:
        return np.nan, np.nan, np.nan
    mass = body.inertia[mode, mode] + body.held_added_mass(0.0)[0, mode, mode]
    for _ in range(3):  # the added mass of the natural frequency
        natural = np.sqrt(K / mass)
        mass = body.inertia[mode, mode] + body.held_added_mass(natural)[0, mode, mode]
    natural = np.sqrt(K / mass)
    inside = np.clip(natural, body.omega[0], body.omega[-1])
    radiated = body.coefficients([inside])[1][0, mode, mode] * min(1.0, natural / inside)
    slow = 0.0
    for _ in range(TURNS):
        N = drag(np.hypot(waves, slow)) + other + radiated
        response = force / ((K - mass * omega**2) ** 2 + (N * omega) ** 2)
        before, slow = slow, np.sqrt(np.trapezoid(omega**2 * response, omega))
        if abs(slow - before) <= SETTLED * slow:
            break
        slow = 0.5 * (slow + before)
    return 2 * np.pi / natural, N / np.sqrt(mass * K), np.sqrt(np.trapezoid(response, omega))


def drag_of_each(conditions, hulls, depth):
    """Function that gives E[∂F/∂ẋ] of the water's drag (3N,), N s/m and N m s, for the velocities' σ (3N,).

    Velocities are of surge, sway and yaw of N bodies; hulls : `conditions.Afloat`s; depth : m
    """
    each = []
    for one in hulls:
        current = with_coefficients(conditions, one.box, depth).current
        if current is not None:
            current = replace(current, direction=current.direction - one.heading)
        each.append(_drag_of(current, one.box, SimpleNamespace(density=one.density, water_depth=depth)))
    return lambda speed: np.array([each[i // 3](i % 3, one) for i, one in enumerate(speed)])


def _drag_of(current, hull, db):
    """Function (motion 0 to 2, σ of its velocity) → E[∂F/∂ẋ] of the water's drag, N s/m or N m s"""
    water = current_on(current, hull, db.density, db.water_depth)
    speed, direction = (0.0, 0.0) if current is None else (current.speed, current.direction)
    stream = speed * np.array([np.cos(direction), np.sin(direction)])
    nodes, weights = np.polynomial.hermite_e.hermegauss(24)
    weights = weights / weights.sum()
    turning = turning_drag(water, hull.length)

    def drag(mode, sigma):
        if mode == 2:
            return np.sqrt(8 / np.pi) * turning * sigma
        sigma = max(sigma, STILL)
        past = np.tile(stream, (len(nodes), 1))
        past[:, mode] -= sigma * nodes
        x, y = past.T
        share = water.share(speed, sigma * np.abs(nodes))
        force = share * (x * x + y * y) * water.unit(np.arctan2(y, x))[:, mode]
        return -float(weights @ (force * nodes)) / sigma

    return drag
