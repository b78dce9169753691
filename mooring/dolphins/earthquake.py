"""Earthquake at dolphins: the ground motion y_g acts at the roots of the fenders; body and water are at rest before.

    (M + a) η̈ + N η̇ + R(η − y_g) = 0,    with the water's memory in place of a and N where a database gives it

For springs, R = k (η − y_g), in steady motion of the ground

    R/(ω² y_g M) = (k/ω²M) |−ω²(M + a) + iωN| / |k − ω²(M + a) + iωN|

The ratio tends to (M + a)/M for stiff fenders, and to k/(ω²M) → 0 for soft fenders; 1 is the method of the seismic
coefficient.  SR179 report (1982), section 3.7.4.  A record of acceleration is integrated twice. A straight line is
subtracted from the acceleration, so that velocity and displacement are 0 at both ends.

For the motion of the body relative to the ground, u = η − y_g, the driving force is −(M + a) ÿ_g if N is small. A
response spectrum S_a therefore gives R = (M + a) S_a(T, ζ), with the period and damping of the equivalent spring at
the amplitude u.  A spectrum is converted from one damping ratio to another by √(0.10/(0.05 + ζ)), at least 0.55 (EN
1998-1, 3.2.2.2).
"""

from itertools import islice
from typing import NamedTuple

import numpy as np

from ..fenders.hysteresis import advanced_one, contact_table, reaction_at, reaction_of
from ..fenders.pressed import NODES, Pressed
from .linearised import equivalent

FINE = 90  # time steps in the shortest period of the body on its fenders; error 1e-6 of the reaction
ROUNDS, SETTLED = 200, 1e-6  # iterations for the equivalent spring: largest number, relative change at the end
UNEVEN = 1e-3  # largest relative variation of the time step of a record
LEAST = 0.55  # smallest reduction factor of a spectrum by damping
SIDES = np.array([1.0, -1.0])


class EarthquakeError(ValueError):
    """An earthquake response cannot be computed; the message names the fault and the limit."""


class Ground(NamedTuple):
    """time (n,) s, equally spaced; acceleration, velocity, displacement (n,) in m; velocity and displacement are 0 at
    both ends

    base_line : corrections at the first and the last acceleration, m/s², added to a record and linear in between
    """

    time: np.ndarray
    acceleration: np.ndarray
    velocity: np.ndarray
    displacement: np.ndarray
    base_line: tuple[float, float] = (0.0, 0.0)


class Floater(NamedTuple):
    """A body in one motion: mass, added_mass (at infinite frequency with a memory), kg; damping N s/m without memory

    a (m, m), b (m,), c (m,) : memory, force c·x against the motion, ẋ = a x + b η̇; empty without memory
    """

    mass: float
    added_mass: float
    damping: float
    a: np.ndarray = np.zeros((0, 0))
    b: np.ndarray = np.zeros(0)
    c: np.ndarray = np.zeros(0)

    def water(self, omega):
        """Added mass (q,) kg and damping (q,) N s/m at omega (q,) rad/s"""
        s = 1j * np.atleast_1d(omega)
        eye = np.eye(len(self.b))
        memory = np.array([self.c @ np.linalg.solve(at * eye - self.a, self.b) if len(self.b) else 0.0 for at in s])
        return self.added_mass + memory.imag / s.imag, self.damping + memory.real


class Fenders(NamedTuple):
    """fender : one fender with its dolphin; count : number on each side; clearance : gap to the body at rest on each
    side, m
    """

    fender: object
    count: int = 1
    clearance: float = 0.0


class Course(NamedTuple):
    """time (n,) s; body (n,) m in space; deflection (n,) m of the compressed fenders; reaction (n,) N on all
    dolphins
    """

    time: np.ndarray
    body: np.ndarray
    deflection: np.ndarray
    reaction: np.ndarray


class Spectral(NamedTuple):
    """period, s, and damping ratio of the equivalent spring; deflection, m; reaction, N; acceleration, m/s², damped"""

    period: float
    ratio: float
    deflection: float
    reaction: float
    acceleration: float


def normalised_reaction(omega, mass, added_mass, damping, stiffness):
    """R/(ω² y_g M) at omega (q,) rad/s; added_mass, damping : numbers or (q,)"""
    omega = np.asarray(omega, float)
    water = -(omega**2) * (mass + added_mass) + 1j * omega * damping
    return stiffness / (omega**2 * mass) * np.abs(water) / np.abs(stiffness + water)


def ground_of_record(time, acceleration, after=0.0):
    """`Ground` of an acceleration record, m/s², with corrected base line, followed by `after` s of rest.

    raises : EarthquakeError for a record with gaps, or with values that are not numbers
    """
    t, a = np.asarray(time, float), np.asarray(acceleration, float)
    if len(t) < 4 or t.shape != a.shape or not (np.all(np.isfinite(t)) and np.all(np.isfinite(a))):
        raise EarthquakeError(
            f"the record has {len(t)} times and {len(a)} finite accelerations; allowed: the same number, 4 or more"
        )
    steps = np.diff(t)
    if not np.all(np.abs(steps - steps[0]) <= UNEVEN * abs(steps[0])) or steps[0] <= 0:
        i = int(np.argmax(np.abs(steps - np.median(steps))))
        raise EarthquakeError(
            f"the time step of the record is {steps[i]:g} s after {t[i]:g} s and {np.median(steps):g} s elsewhere; "
            f"allowed: equal steps without gaps"
        )
    if not np.any(a):
        raise EarthquakeError("all accelerations of the record are 0; give a record with motion of the ground")
    s = (t - t[0]) / (t[-1] - t[0])
    shapes = [np.ones_like(s), s]
    ends = np.array([[x[-1] for x in _integrated(t, shape)] for shape in (*shapes, a)]).T
    share = np.linalg.solve(ends[:, :2], -ends[:, 2])
    corrected = a + share[0] * shapes[0] + share[1] * shapes[1]
    still = np.zeros(round(after / steps[0]))
    t = np.concatenate([t, t[-1] + steps[0] * np.arange(1, len(still) + 1)])
    moved = (np.concatenate([x, still]) for x in (corrected, *_integrated(t[: len(a)], corrected)))
    return Ground(t, *moved, (float(share[0]), float(share.sum())))


def _integrated(time, acceleration):
    """Velocity and displacement from rest, for accelerations linear between their times"""
    h = np.diff(time)
    before, after = acceleration[:-1], acceleration[1:]
    velocity = np.concatenate([[0.0], np.cumsum(0.5 * h * (before + after))])
    moved = velocity[:-1] * h + h * h * (2 * before + after) / 6
    return velocity, np.concatenate([[0.0], np.cumsum(moved)])


def response_spectrum(ground, periods, ratio=0.05):
    """Pseudo-acceleration of oscillators of the given periods, s, and damping ratio, m/s²; shape (q,)"""
    return np.array([_largest(ground, 2 * np.pi / T, ratio) for T in np.atleast_1d(periods)])


def _largest(ground, omega, ratio):
    """ω² max |u| of ü + 2ζω u̇ + ω² u = −a, exact for accelerations linear between their times"""
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


def both_sides(fenders):
    """Function that gives the force (n,) N of the fenders on both sides along a path u (n,) m of the body relative
    to the ground
    """
    fender, count, clearance = fenders

    def one_side(depth):
        s, before, out = 1.0, 0.0, np.empty(len(depth))
        table = contact_table([fender])
        for i, now in enumerate(depth):
            s = advanced_one(s, before, now, fender.return_length)
            out[i], before = reaction_of(table, 0, now, s), now
        return out

    def force(path):
        twice = np.concatenate([path, path])  # two rounds, so that the loop is the steady one
        return count * (one_side(twice - clearance) - one_side(-twice - clearance))[len(path) :]

    return force


def by_spectrum(floater, fenders, spectrum, spectrum_ratio=0.05):
    """`Spectral` reaction to a response spectrum, with the stiffness of the equivalent spring at the deflection of this
    reaction.

    spectrum : function of the period, s → m/s² at the damping ratio spectrum_ratio.
    A body that does not cross its clearance has no reaction; its period, ratio and acceleration are nan.
    raises : EarthquakeError where fenders are compressed beyond their table, or no deflection satisfies the equation
    """
    fender = fenders.fender
    law, limit = both_sides(fenders), fender.limit + fenders.clearance

    def answer(u):
        found = equivalent(law, 0.0, u, points=128)
        omega = natural(floater, found.stiffness)
        A, B = (float(x[0]) for x in floater.water(omega))
        mass = floater.mass + A
        ratio = (B * omega + found.loss) / (2 * found.stiffness)
        factor = max(LEAST, np.sqrt((0.05 + spectrum_ratio) / (0.05 + ratio)))
        acceleration = factor * float(spectrum(2 * np.pi / omega))
        return 2 * np.pi / omega, ratio, acceleration * mass / found.stiffness, acceleration

    low, high = fenders.clearance + 1e-6 * fender.limit, limit * (1 - 1e-9)
    if answer(high)[2] > high:
        raise EarthquakeError(
            f"the spectrum compresses {fender.name} beyond its table, which ends at {fender.limit:.3g} m; use more or "
            "larger fenders"
        )
    least = low
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if answer(middle)[2] > middle else (low, middle)
        if high - low <= SETTLED * high:
            break
    if fenders.clearance > 0 and low == least:
        return Spectral(np.nan, np.nan, 0.0, 0.0, np.nan)
    period, ratio, _, acceleration = answer(high)
    deflection = max(high - fenders.clearance, 0.0)
    return Spectral(period, ratio, deflection, fenders.count * float(fender.reaction(deflection)), acceleration)


def natural(floater, stiffness):
    """Natural frequency, rad/s, of a body on a spring, with the added mass at this frequency"""
    omega = np.sqrt(stiffness / (floater.mass + floater.added_mass))
    for _ in range(ROUNDS):
        before, omega = omega, np.sqrt(stiffness / (floater.mass + float(floater.water(omega)[0][0])))
        if abs(omega - before) <= SETTLED * omega:
            break
    return float(omega)


def course(ground, floater, fenders):
    """`Course` of a body between fenders on moving ground (`mooring.fenders.pressed`).

    Fenders on each side return less energy than they absorb (`mooring.fenders.hysteresis`).  The ground motion is the
    cubic through its displacements and velocities.
    raises : FenderError where a fender without overload stiffness is compressed beyond its table
    """
    fender, count, clearance = fenders
    whole, n = floater.mass + floater.added_mass, len(floater.b)
    h = float(ground.time[1] - ground.time[0])
    stiffest = count * float(fender.loading.slope(np.linspace(0, fender.limit, 200)).max())
    steps = max(1, int(np.ceil(h * FINE / (2 * np.pi) * np.sqrt(stiffest / whole))))
    A, B, place = np.zeros((2 + n, 2 + n)), np.zeros((2 + n, 2)), np.zeros((2, 2 + n))  # states: η, η̇, the memory
    A[0, 1], A[1, 1], A[1, 2:] = 1.0, -floater.damping / whole, -floater.c / whole
    A[2:, 1], A[2:, 2:] = floater.b, floater.a
    B[1], place[:, 0] = -count / whole * SIDES, SIDES
    at = (np.arange(steps)[:, None] + [*NODES, 1.0]) / steps
    moved = np.concatenate([_between(ground, i, at) for i in range(len(ground.time) - 1)])
    gaps = clearance + SIDES * np.concatenate([moved, moved[-1:]])[..., None]
    rows = Pressed(A, B, place, [fender, fender], h / steps).rows(np.zeros(2 + n), np.full(2, clearance), gaps)
    columns = zip(*((z[0], depth, state) for z, depth, state, _ in islice(rows, 0, None, steps)), strict=True)
    body, depth, state = (np.array(column, float) for column in columns)
    reaction = reaction_at(fender, np.maximum(depth, 0.0), state)
    deflection = np.maximum(depth.max(axis=1), 0.0)
    fender.reaction(deflection.max())  # raises beyond its table
    return Course(ground.time, body, deflection, count * (reaction @ SIDES))


def _between(ground, i, s):
    """m, ground displacement at a share s of step i, by the cubic through its displacements and velocities"""
    (y, z), (u, v) = ground.displacement[i : i + 2], (ground.time[1] - ground.time[0]) * ground.velocity[i : i + 2]
    return y + s * (u + s * (3 * (z - y) - 2 * u - v + s * (2 * (y - z) + u + v)))
