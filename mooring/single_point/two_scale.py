"""The two-scale scheme of the SR179 report (1982), section 3.6: alternating slow motion and wave motion.

    slow      T ν̇ = F(ψ, ν) + F_mooring                          in steps of 10 s, with constant wind in each
    waves     A ẍ + B ẋ + C x = F_w(t) + T_w,   T_w = F_mooring(slow + x) − F_mooring(slow)

The position and the heading of the slow motion are constant during the waves of its step; A and B are taken at one
frequency.  Tensions follow from the sum of both displacements (3.6.4, with the arm of the hawser and the sign of yaw
corrected, and with pitch, which the report omits).  Waves may start later than the slow motion, which shows the decay
of slewing alone.  Wave motion is integrated by Newmark's method of mean acceleration, with the mooring at the
predicted position.  The slow drift is not included: the report adds a fifth to the tension.
"""

from dataclasses import dataclass

import numpy as np

from hakobune.bem.kernels.progress import IN_TIME, report_progress
from hakobune.bem.waves import wavenumber

from ..on_current.waves import met_by_a_place
from .body import SinglePoint
from .history import Record, line_tensions
from .slewing import rates
from .waves import RING, at_heading, headings, mean_frequency, share_of_height


@dataclass(frozen=True)
class Steps:
    """duration, slow, fast : duration, and slow and fast step, s; waves_after : time without waves, s; parts :
    number of integration steps in a slow step
    """

    duration: float = 1200.0
    slow: float = 10.0
    fast: float = 0.5
    waves_after: float = 400.0
    parts: int = 4


@dataclass(frozen=True, eq=False)
class WaveBody:
    """Wave motion of a body about its centre of mass, in a sea of components (n,).

    added, damping, stiffness : (6, 6), at one frequency, where `added` includes the mass; force : (n, RING, 6)
        complex, N per m
    omega, amplitude, phase, direction, number : (n,); lever : m, height of the attachment over the centre of mass
    center : (2,) m, centre of mass in the axes of the forces; mean_omega : rad/s
    """

    added: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    force: np.ndarray
    omega: np.ndarray
    amplitude: np.ndarray
    phase: np.ndarray
    direction: np.ndarray
    number: np.ndarray
    lever: float
    center: np.ndarray
    mean_omega: float

    def forces_at(self, place, heading, times):
        """Forces, N and N m, at times (m,) s, on a body at a constant slow position (2,) m and heading; shape (m,
        6)
        """
        near = at_heading(self.force, self.direction - heading)
        cos, sin = np.cos(heading), np.sin(heading)
        cx, cy = self.center
        r = place - np.array([cos * cx - sin * cy, sin * cx + cos * cy])
        along = self.number * (np.cos(self.direction) * r[0] + np.sin(self.direction) * r[1])
        value = self.amplitude[:, None] * near * np.exp(1j * (along + self.phase))[:, None]
        return np.real(np.exp(-1j * np.outer(times, self.omega)) @ value)


def wave_body(reader, components, lever, carrier=None) -> WaveBody:
    """WaveBody of a `bem.database.reader.Reader` with the coefficients of the mean frequency of its Components

    carrier : `mooring.on_current.waves.Carrier` of the waves, whose frequencies are intrinsic; None in still water
    """
    omega, amplitude, phase, direction = (np.asarray(part, float) for part in components)
    met = met_by_a_place(components, carrier, reader.depth, reader.gravity)
    mean = float(np.clip(mean_frequency(met, amplitude), *reader.between.span))
    body = reader.floating()  # body with its linear damping in addition to radiation
    A, B = body.coefficients(np.array([mean]))
    order = np.argsort(omega)
    force = np.empty((len(omega), RING, 6), complex)
    force[order] = body.forces(omega[order], headings())
    number = wavenumber(omega, reader.depth, reader.gravity)
    center = np.asarray(reader.rotation_center, float)[:2]
    return WaveBody(body.inertia + A[0], B[0] + body.damping, body.stiffness, force, met, amplitude, phase, direction,
                    number, lever, center, mean)  # fmt: skip


def two_scale(point: SinglePoint, start, steps: Steps, body: WaveBody | None = None, wind_speed=None) -> Record:
    """Record from a state (6,), at the ends of the fast steps.  Raises SinglePointError.

    body : None without waves; wind_speed : callable of s → m/s
    """
    count = max(1, round(steps.slow / steps.fast))
    slow_steps = int(np.ceil(steps.duration / steps.slow - 1e-9))
    n = slow_steps * count
    time = (steps.slow / count) * np.arange(1, n + 1)
    slow, wave = np.empty((n, 3)), np.zeros((n, 6))
    wind, buoy, hawser = np.empty(n), np.empty((n, 2)), np.empty((n, len(point.ends)))
    state = np.asarray(start, float)
    newmark = None if body is None else _Newmark(body, steps.slow / count)
    mean_wind = 0.0 if point.loads.wind is None else point.loads.wind.speed
    for k in range(slow_steps):
        report_progress(IN_TIME, k / slow_steps)
        rows = slice(k * count, (k + 1) * count)
        speed = mean_wind if wind_speed is None else float(wind_speed(k * steps.slow))
        slow[rows], wind[rows] = state[:3], speed
        held = point.hold(state[:2], state[2])
        if body is None or k * steps.slow < steps.waves_after - 1e-9:
            buoy[rows], hawser[rows] = held.buoy, held.tension
        else:
            grown = share_of_height(time[rows], steps.waves_after, body.mean_omega)
            forces = grown[:, None] * body.forces_at(state[:2], state[2], time[rows])
            newmark.run(point, state, held, forces, wave[rows], buoy[rows], hawser[rows])
        state = _advanced(point, state, steps.slow, steps.parts, speed, held.buoy)
    keep = time <= steps.duration + 1e-9
    lines = line_tensions(point, buoy[keep])
    return Record(time[keep], slow[keep, :2], slow[keep, 2], wave[keep], buoy[keep], hawser[keep], lines, wind[keep])


def _advanced(point, state, step, parts, speed, near):
    """State after a slow step, by the Runge–Kutta method of fourth order; near : (2,) m, the buoy at its begin"""
    h = step / parts
    for _ in range(parts):
        k1, held = rates(point, state, speed, near)
        k2, held = rates(point, state + 0.5 * h * k1, speed, held.buoy)
        k3, held = rates(point, state + 0.5 * h * k2, speed, held.buoy)
        k4, held = rates(point, state + h * k3, speed, held.buoy)
        state, near = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), held.buoy
    return state


class _Newmark:
    """Steps of the wave motion, state z (18,): place, velocity and acceleration; step : s

    z becomes Φ z + Γ f under forces f of the waves and of the mooring.
    """

    def __init__(self, body, step):
        h, one, none, lever = step, np.eye(6), np.zeros((6, 6)), body.lever
        inverse = np.linalg.inv(body.added + 0.5 * h * body.damping + 0.25 * h * h * body.stiffness)
        half = np.hstack([one, h * one, 0.25 * h * h * one])
        faster = np.hstack([none, one, 0.5 * h * one])
        after = -inverse @ (body.damping @ faster + body.stiffness @ half)
        self.moved = np.vstack([half + 0.25 * h * h * after, faster + 0.5 * h * after, after])
        self.by_force = np.vstack([0.25 * h * h * inverse, 0.5 * h * inverse, inverse])
        arm = np.zeros((3, 6))  # motion of the attachment along and across, and yaw
        arm[[0, 1, 2], [0, 1, 5]], arm[0, 4], arm[1, 3] = 1.0, lever, -lever
        self.foreseen = arm @ np.hstack([one, h * one, 0.5 * h * h * one])
        self.by_pull = self.by_force @ arm.T
        self.z, self.past = np.zeros(18), None

    def run(self, point, state, held, forces, wave, buoy, hawser):
        """Integrate under forces (m, 6) of the waves for a slow step; writes the rows of its record"""
        cos, sin = np.cos(state[2]), np.sin(state[2])
        x, y, heading = state[:3].tolist()
        z, before = self.z, held.force
        a = b = c = d = held.buoy
        if self.past is not None:
            a, b, c, d = self.past
        for i, waves in enumerate(forces @ self.by_force.T):
            surge, sway, yaw = (self.foreseen @ z).tolist()
            place = np.array([x + cos * surge - sin * sway, y + sin * surge + cos * sway])
            now = point.hold(place, heading + yaw, 4 * (d + b) - 6 * c - a)  # a cubic through four places
            a, b, c, d = b, c, d, now.buoy
            z = self.moved @ z + waves + self.by_pull @ (now.force - before)
            wave[i], buoy[i], hawser[i] = z[:6], d, now.tension
            wave[i, 0], wave[i, 1] = cos * z[0] - sin * z[1], sin * z[0] + cos * z[1]
        self.z, self.past = z, (a, b, c, d)
