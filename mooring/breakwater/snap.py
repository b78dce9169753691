"""A breakwater whose lines go slack, in regular waves, in time: lines pull and do not push.

    (M + A) ẍ + B ẋ + C x = Re F e^(−iωt) + Σ (P − P₀) Jᵀu,      P = max(0, P₀ + δP + c δP'),     δP = −(EA/S) u · J x

x sway, heave, roll about the centre of gravity; A, B, F of the waves' frequency, also for what is quicker, so that
peaks are of the right size and not exact; u, J as in `elastic`; c a share ζ of the critical damping of the body's mass
on its lines.  Without slack this is `elastic` without the turning of the lines.  Peaks grow with EA nearly as its root:
Table 3.2 of Kihara, Kitatani & Todoroki (1975) is met by EA of 1e4 N per metre, less than chains have, as if the gauges
gave way (`tests/bench/breakwater.py snap`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .elastic import line_directions
from .exact import about_gravity, check_section, moved_to_origin

RAMP, CYCLES, MEASURED = 4, 24, 12  # wave periods
PER_SWING = 30  # steps of a period of the stiffest motion


class Snap(NamedTuple):
    """time : (n,) s, of the last cycles; front, back : tensions (n,) N/m; peaks : (front, back) means of the largest of
    every cycle, N/m; largest : (front, back); slack : (front, back) shares of the time"""

    time: np.ndarray
    front: np.ndarray
    back: np.ndarray
    peaks: tuple
    largest: tuple
    slack: tuple


def snap(body, section, axial_stiffness, amplitude, damping=0.05):
    """`Snap` of a `TautBody` or `TautRectangle` in waves of `amplitude`, m; section : of its moored draft

    axial_stiffness : EA, N per metre of body; damping : ζ of its motion on the lines
    """
    check_section(body, section)
    if not 0 < axial_stiffness < np.inf or not 0 <= amplitude < np.inf:
        raise ValueError(f"EA is {axial_stiffness:g} N/m, amplitude {amplitude:g} m; allowed: above 0, finite")
    impedance, force = about_gravity(section, moved_to_origin(body.z0))
    mass = np.diag([body.mass, body.mass, body.inertia]) - impedance.real / section.omega**2
    water = -impedance.imag / section.omega
    stiffness = np.diag([0.0, body.heave_stiffness, body.roll_stiffness])
    pulls = line_directions(body)  # u · J of both lines
    along = axial_stiffness / body.line
    inverse = np.linalg.inv(mass)
    swift = np.sqrt(np.linalg.eigvals(inverse @ (stiffness + along * pulls.T @ pulls)).real.max())
    lag = 2 * damping / swift
    period = 2 * np.pi / section.omega
    count = int(np.ceil(period * swift / (2 * np.pi) * PER_SWING))
    step = period / count

    def tensions(state):
        stretched = -along * (state[:3] + lag * state[3:]) @ pulls.T
        taut = body.pretension - along * state[:3] @ pulls.T > 0
        return np.where(taut, np.maximum(body.pretension + stretched, 0.0), 0.0)

    def slope(t, state):
        waves = (amplitude * min(t / (RAMP * period), 1.0) * force * np.exp(-1j * section.omega * t)).real
        load = waves + (tensions(state) - body.pretension) @ pulls - stiffness @ state[:3] - water @ state[3:]
        return np.concatenate([state[3:], inverse @ load])

    state, kept = np.zeros(6), np.empty((MEASURED * count, 2))
    for i in range(CYCLES * count):
        state = _runge_kutta(slope, i * step, step, state)
        if i >= (CYCLES - MEASURED) * count:
            kept[i - (CYCLES - MEASURED) * count] = tensions(state)
    peaks = kept.reshape(MEASURED, count, 2).max(axis=1)
    time = (np.arange(len(kept)) + 1) * step
    return Snap(time, *kept.T, tuple(peaks.mean(axis=0)), tuple(peaks.max(axis=0)), tuple((kept <= 0).mean(axis=0)))


def _runge_kutta(slope, t, step, state):
    one = slope(t, state)
    two = slope(t + step / 2, state + step / 2 * one)
    three = slope(t + step / 2, state + step / 2 * two)
    return state + step / 6 * (one + 2 * two + 2 * three + slope(t + step, state + step * three))
