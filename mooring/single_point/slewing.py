"""Slow motion of a body at a single point in the plane, and its small motions about an equilibrium.

    T ν̇ = F(ψ, ν) + F_mooring − C(ν) ν,   ẋ = R(ψ) ν + U,   ν = (u, v, r) through the water, U the current

T is the mass with added mass. C is the inertia of turning axes, without Munk's moment of the added mass, which
turning tests and current coefficients contain.  With turning tests C cancels in surge and sway: the tests include
the inertia of the turning model.  SR179 report (1982), eq. 3.6.1 and 3.6.8, with u̇, v̇ for the ü, v̈ printed there.
Velocities on both sides are through the water, so a mooring that drifts with the current has no load.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.progress import IN_TIME, report_progress

from .body import Hold, NotFollowedError, SinglePoint, SinglePointError

LONGEST = 40.0, 2.0  # s, of a step in steady and in gusty wind
UNITS = np.array([1.0, 1.0, 0.02, 0.1, 0.1, 2e-3])  # units of the tolerance of each state
FIRST = 0.5  # s, first step: `scipy` fails if a first step of its own choice is rejected
MOST = 20_000  # evaluations until the heading turns back
STEP = 1e-4  # finite-difference step, over the scales of `linearised` in m, rad, m/s, rad/s


class SlowMotion(NamedTuple):
    """time : (n,) s; place : (n, 2) m of the centre of mass; heading : (n,) rad, unwrapped

    velocity : (n, 3) m/s, rad/s through the water, in axes of the body; buoy : (n, 2) m; hawser : (n, k) N
    wind_speed : (n,) m/s
    """

    time: np.ndarray
    place: np.ndarray
    heading: np.ndarray
    velocity: np.ndarray
    buoy: np.ndarray
    hawser: np.ndarray
    wind_speed: np.ndarray


def rates(point: SinglePoint, state, wind_speed=None, near=None):
    """Rates of the state x, y, ψ, u, v, r, and the Hold of the mooring; shape (6,)"""
    x, y, heading, u, v, r = state
    held = point.hold(np.array([x, y]), heading, near)
    cos, sin = np.cos(heading), np.sin(heading)
    current = point.loads.water.velocity
    out = np.empty(6)
    out[:3] = cos * u - sin * v + current[0], sin * u + cos * v + current[1], r
    out[3:] = accelerations(point, heading, (u, v, r), held.force, wind_speed)
    return out, held


def accelerations(point: SinglePoint, heading, velocity, pull, wind_speed=None):
    """Rates of u, v, r under a force (3,), N, N, N m, of the mooring; shape (3,)"""
    u, v, r = velocity
    force = point.loads.moving(heading, velocity, wind_speed) + pull
    if not point.loads.water.turning:
        along, across = point.mass[:2] @ np.array([u, v, r])
        force[:2] += across * r, -along * r
    return point.inverse @ force


def at_rest_state(point: SinglePoint, place, heading):
    """State of a body at rest relative to the ground, its centre of mass at (2,), m; shape (6,)"""
    x, y = point.loads.water.velocity
    cos, sin = np.cos(heading), np.sin(heading)
    return np.array([*place, heading, -cos * x - sin * y, sin * x - cos * y, 0.0])


def linearised(point: SinglePoint, state, held: Hold | None = None):
    """Derivatives of the `rates` at an equilibrium, by displacements, m, m, rad, and by the rates of displacements;
    shape (6, 6).

    Unknowns are the place, the heading and the velocity over the ground. The axes do not turn, so all rates are zero at
    rest.  The mooring contributes its stiffness, loads contribute differences of fourth order.
    held : Hold of the mooring at the equilibrium, computed if not given
    """
    state, current = np.asarray(state, float), point.loads.water.velocity
    held = point.hold(state[:2], state[2]) if held is None else held
    scale = np.array([0.02, 0.1, 0.1, 2e-3])

    def motion(z):
        """Acceleration in space at a given heading and velocity over the ground, with a constant pull of the
        mooring
        """
        heading, r = z[0], z[3]
        cos, sin = np.cos(heading), np.sin(heading)
        over = z[1:3] - current
        u, v = cos * over[0] + sin * over[1], -sin * over[0] + cos * over[1]
        found = accelerations(point, heading, (u, v, r), held.force)
        # Galilean: acceleration in space of the velocity through the water, in turning axes
        du, dv = found[0] - r * v, found[1] + r * u
        return np.array([cos * du - sin * dv, sin * du + cos * dv, found[2]])

    centre = np.array([state[2], 0.0, 0.0, 0.0])
    J = np.zeros((6, 6))
    J[:3, 3:] = np.eye(3)
    for j in range(4):
        h = 10 * STEP * scale[j]
        step = np.eye(4)[j] * h
        near, far = (motion(centre + k * step) - motion(centre - k * step) for k in (1, 2))
        J[3:, 2 + j] = (8 * near - far) / (12 * h)
    yields = point.inverse @ point.stiffness(state[2], held)
    cos, sin = np.cos(state[2]), np.sin(state[2])
    J[3:, :3] -= np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]) @ yields
    return J


def slew(point: SinglePoint, start, duration, step, *, tolerance=1e-4, wind_speed=None) -> SlowMotion:
    """Slow motion from a state (6,), by the method of Dormand and Prince of order 8 (`scipy`).

    duration, step : of the record, s; tolerance : relative tolerance, and absolute tolerance in metres and radians
    wind_speed : callable of s → m/s, None for the mean wind.  raises : SinglePointError
    """
    from scipy.integrate import solve_ivp

    rate, refused = _followed(point, wind_speed)
    time = step * np.arange(int(np.floor(duration / step + 1e-9)) + 1)

    def telling(t, y):
        report_progress(IN_TIME, t / duration)
        return rate(t, y)

    with np.errstate(invalid="ignore"):
        found = solve_ivp(telling, (0.0, duration), start, "DOP853", time, rtol=tolerance, atol=tolerance * UNITS,
                          max_step=LONGEST[wind_speed is not None], first_step=min(FIRST, duration))  # fmt: skip
    if not found.success:
        raise SinglePointError(f"at {found.t[-1]:.4g} s the motion cannot be followed{refused[0]}")
    return _record(point, time, found.y.T, wind_speed)


def until_turn(point: SinglePoint, start, direction, longest, tolerance):
    """Solution (`scipy`, dense) from a state (6,) until the yaw rate passes 0, upwards for a direction above 0

    raises : SinglePointError if its yaw rate does not change its sign within `longest` s
    """
    from scipy.integrate import solve_ivp

    counted = [0]

    def turns(_, y):
        return y[5]

    def counting(t, y):
        counted[0] += 1
        if counted[0] > MOST:
            raise NotFollowedError(f"after {t:.4g} s each step is too short to follow the motion{refused[0]}")
        return rate(t, y)

    turns.terminal, turns.direction = True, direction
    rate, refused = _followed(point)
    with np.errstate(invalid="ignore"):
        found = solve_ivp(counting, (0.0, longest), start, "DOP853", rtol=tolerance, atol=tolerance * UNITS,
                          events=turns, dense_output=True, first_step=min(FIRST, longest))  # fmt: skip
    if not found.success:
        raise NotFollowedError(f"the motion cannot be followed{refused[0]}")
    if found.status != 1:
        raise SinglePointError(
            f"the heading does not turn back within {longest:.3g} s and is then at "
            f"{np.degrees(found.y[2, -1]) % 360:.1f}°"
        )
    return found


def _followed(point, wind_speed=None):
    """Function of (s, state) → rates, nan where the mooring fails, and a list of its last message"""
    kept, refused = [None], [""]

    def rate(t, y):
        if not np.all(np.isfinite(y)):
            return np.full(6, np.nan)
        try:
            out, held = rates(point, y, None if wind_speed is None else wind_speed(t), kept[0])
        except SinglePointError as error:  # failure of a trial step: a shorter one may succeed
            refused[0] = f": {error}"
            return np.full(6, np.nan)
        kept[0] = held.buoy
        return out

    return rate, refused


def turned_state(point: SinglePoint, state, turn):
    """State with the body turned by `turn`, rad, about its attachment, at rest relative to the ground; shape (6,)"""
    x, y, heading = state[:3]
    arms = [np.array([np.cos(a) * p[0] - np.sin(a) * p[1], np.sin(a) * p[0] + np.cos(a) * p[1]])
            for p in (point.apex,) for a in (heading, heading + turn)]  # fmt: skip
    return at_rest_state(point, np.array([x, y]) + arms[0] - arms[1], heading + turn)


def _record(point, time, states, wind_speed):
    buoy, hawser, near = np.empty((len(time), 2)), np.empty((len(time), len(point.ends))), None
    for i, state in enumerate(states):
        held = point.hold(state[:2], state[2], near)
        buoy[i], hawser[i], near = held.buoy, held.tension, held.buoy
    wind = point.loads.wind
    mean = 0.0 if wind is None else wind.speed
    speed = np.array([mean if wind_speed is None else wind_speed(t) for t in time])
    return SlowMotion(time, states[:, :2], states[:, 2], states[:, 3:], buoy, hawser, speed)
