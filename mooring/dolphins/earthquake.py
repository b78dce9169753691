"""Earthquake at dolphins: ground motion y_g at the roots of the fenders, body and water otherwise at rest.

    (M + a) η̈ + N η̇ + k (η − y_g) = 0,    R = k (η − y_g)

    R/(ω² y_g M) = (k/ω²M) |−ω²(M + a) + iωN| / |k − ω²(M + a) + iωN|

stiff fenders → (M + a)/M, soft ones → k/(ω²M) → 0; 1 is the method of the seismic coefficient.  SR179 report (1982),
section 3.7.4.  A record of acceleration is integrated twice with velocity and displacement 0 at both ends: a straight
line and a parabola of acceleration are taken off it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Ground(NamedTuple):
    """time (n,) s; acceleration, velocity, displacement (n,) in m; all 0 at both ends but the acceleration"""

    time: np.ndarray
    acceleration: np.ndarray
    velocity: np.ndarray
    displacement: np.ndarray


def normalised_reaction(omega, mass, added_mass, damping, stiffness):
    """R/(ω² y_g M) at omega (q,) rad/s; added_mass, damping : numbers or (q,)"""
    omega = np.asarray(omega, float)
    water = -(omega**2) * (mass + added_mass) + 1j * omega * damping
    return stiffness / (omega**2 * mass) * np.abs(water) / np.abs(stiffness + water)


def seismic_force(coefficient, mass, gravity=9.80665):
    """N of the method of the seismic coefficient"""
    return coefficient * mass * gravity


def ground_of_record(time, acceleration):
    """`Ground` of a record of acceleration, m/s², with its base line corrected.

    raises : ValueError for a record with gaps, or values that are none
    """
    t, a = np.asarray(time, float), np.asarray(acceleration, float)
    if len(t) < 4 or t.shape != a.shape or not (np.all(np.isfinite(t)) and np.all(np.isfinite(a))):
        raise ValueError(
            f"the record has {len(t)} times and {len(a)} finite accelerations; allowed: 4 or more, as many"
        )
    steps = np.diff(t)
    if not np.all(np.abs(steps - steps[0]) <= 1e-3 * abs(steps[0])) or steps[0] <= 0:
        i = int(np.argmax(np.abs(steps - np.median(steps))))
        raise ValueError(
            f"the record steps by {steps[i]:g} s after {t[i]:g} s, else by {np.median(steps):g} s; allowed: no gaps"
        )
    s = (t - t[0]) / (t[-1] - t[0])
    shapes = [np.ones_like(s), s]
    ends = np.array([[x[-1] for x in _integrated(t, shape)] for shape in (*shapes, a)]).T
    share = np.linalg.solve(ends[:, :2], -ends[:, 2])
    corrected = a + share[0] * shapes[0] + share[1] * shapes[1]
    return Ground(t, corrected, *_integrated(t, corrected))


def _integrated(time, acceleration):
    """Velocity and displacement from rest, of accelerations that are straight between their times"""
    h = np.diff(time)
    before, after = acceleration[:-1], acceleration[1:]
    velocity = np.concatenate([[0.0], np.cumsum(0.5 * h * (before + after))])
    moved = velocity[:-1] * h + h * h * (2 * before + after) / 6
    return velocity, np.concatenate([[0.0], np.cumsum(moved)])


def response_spectrum(ground, periods, ratio=0.05):
    """(q,) m/s² pseudo-acceleration of oscillators of the given periods, s, and damping ratio"""
    return np.array([_largest(ground, 2 * np.pi / T, ratio) for T in np.atleast_1d(periods)])


def _largest(ground, omega, ratio):
    """ω² max |u| of ü + 2ζω u̇ + ω² u = −a, exact for accelerations that are straight between their times"""
    from scipy.signal import cont2discrete, dlsim

    h = float(ground.time[1] - ground.time[0])
    system = (
        np.array([[0.0, 1.0], [-(omega**2), -2 * ratio * omega]]),
        np.array([[0.0], [-1.0]]),
        np.eye(2),
        np.zeros((2, 1)),
    )
    discrete = cont2discrete(system, h, method="foh")
    _, out, _ = dlsim((*discrete[:4], h), ground.acceleration[:, None])
    return float(omega**2 * np.abs(out[:, 0]).max())


def _between(ground, i, s):
    """m of the ground at a share s of step i, by the cubic through its displacements and velocities"""
    (y, z), (u, v) = ground.displacement[i : i + 2], (ground.time[1] - ground.time[0]) * ground.velocity[i : i + 2]
    return y + s * (u + s * (3 * (z - y) - 2 * u - v + s * (2 * (y - z) + u + v)))


def fender_forces(ground, fender, count, mass, added_mass, damping, steps=4):
    """(n,) N on the dolphins, and (n,) m of the body, of `count` fenders on each side without clearance, in time.

    The fender's loading curve, the same on both sides; Runge and Kutta's method with `steps` for each of the record
    """
    whole = mass + added_mass

    def force(stretch):
        return count * np.sign(stretch) * fender.loading(np.abs(stretch))

    def rate(state, ground_at):
        return np.array([state[1], -(force(state[0] - ground_at) + damping * state[1]) / whole])

    y, out = np.zeros(2), [np.zeros(2)]
    h = (ground.time[1] - ground.time[0]) / steps
    for i in range(len(ground.time) - 1):
        for j in range(steps):
            at = [_between(ground, i, (j + s) / steps) for s in (0.0, 0.5, 1.0)]
            a = rate(y, at[0])
            b = rate(y + 0.5 * h * a, at[1])
            c = rate(y + 0.5 * h * b, at[1])
            d = rate(y + h * c, at[2])
            y = y + h / 6 * (a + 2 * b + 2 * c + d)
        out.append(y)
    moved = np.array(out)[:, 0]
    fender.reaction(np.abs(moved - ground.displacement).max())  # raises beyond its table
    return force(moved - ground.displacement), moved
