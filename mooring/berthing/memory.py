"""A berthing in time: a ship with added mass and fluid memory in sway and yaw meets fenders anywhere along its side.

    (M + A∞) ν̇ + y = −Σ (1, x_k)ᵀ R_k,    ẋ = a x + b ν,    y = c x,    δ_k = η₂ + x_k η₆ − gap_k

η₂ is the sway towards the berth, η₆ the yaw about the rotation centre, and R_k the reaction by `mooring.fenders`
with hysteresis. A fender is in series with its dolphin (`mooring.fenders.dolphin`).  The memory is that of
`bem.time_domain.memory`.  The ship has approached at constant speed for a long time: the states of the memory are
−a⁻¹ b ν, their force is 0, and the added mass of the water is A(0). Energy:

    ½ νᵀ(M + A∞) ν + ½ xᵀP x + Σ ∫R dδ + ∫ ½ |lossᵀx|² dt = energy before contact,

`ledger` is the largest violation of this balance. ∫R dδ is computed from the fender curves along the deflections,
not by integrating the power in time.  C_M = 2 max Σ∫R dδ/(C_e M V²) is the virtual mass for which the kinetic-energy
method gives the same energy (α² of Ueda 1981, eq. 3.2, for a linear fender).
"""

from dataclasses import dataclass
from itertools import repeat
from typing import NamedTuple

import numpy as np

from ..fenders.hysteresis import advanced, reaction_at
from ..fenders.pressed import Pressed
from .energy import BerthingError, eccentricity

PLANE = (1, 5)  # sway, yaw of six


@dataclass(frozen=True, eq=False)
class BerthingShip:
    """inertia : (2, 2) of the ship alone; added_mass_infinity : (2, 2); a : (n, n); b : (n, 2); c : (2, n); storage,
    loss

    in kg, kg m, kg m² of sway and yaw about the rotation centre; a … loss of `bem.time_domain.memory`; center : m, x of
    the centre of gravity
    """

    inertia: np.ndarray
    added_mass_infinity: np.ndarray
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    storage: np.ndarray
    loss: np.ndarray
    center: float = 0.0

    @property
    def added_mass_zero(self):
        """Added mass at frequency 0, A∞ − c a⁻² b; shape (2, 2)"""
        return self.added_mass_infinity - self.c @ np.linalg.solve(self.a, np.linalg.solve(self.a, self.b))


@dataclass(frozen=True, eq=False)
class Berthing:
    """time : (n,) s from first contact; position : (n, 2), m and rad; velocity : (n, 2); deflection, reaction : (n,
    k), m and N

    taken, lost : (n,) J, energy absorbed by fenders, and energy radiated as waves
    ledger : largest violation of the energy balance, over the energy before contact; virtual_mass : C_M of the
        module; energy : largest absorbed energy, J
    """

    time: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    deflection: np.ndarray
    reaction: np.ndarray
    taken: np.ndarray
    lost: np.ndarray
    ledger: float
    virtual_mass: float

    @property
    def energy(self):
        return float(self.taken.max())


def without_memory(mass, gyration, added_mass):
    """`BerthingShip` with constant added mass (2, 2), kg …: Ueda's model with added_mass = (C_M − 1) M diag(1, r²)"""
    inertia, none = mass * np.diag([1.0, gyration**2]), np.zeros((0, 0))
    return BerthingShip(
        inertia, np.asarray(added_mass, float), none, np.zeros((0, 2)), np.zeros((2, 0)), none, np.zeros((0, 0))
    )


def ship_of_database(db, mass, gyration, tolerance=3e-3, center=0.0, first=0):
    """`BerthingShip` of a `bem.database.Database`; mass : kg; gyration : m; center : m.

    first : number of the ship's surge among all motions; motions of all other bodies are held
    raises : ValueError of `memory_of_database`; BerthingError where mass or gyration are impossible
    """
    from hakobune.bem.time_domain.memory import memory_of_database

    for key, value in (("mass", mass), ("radius of gyration", gyration)):
        if not 0 < value < np.inf:
            raise BerthingError(f"the {key} of the ship is {value:g}; allowed: above 0, finite")
    own = [first + motion for motion in PLANE]
    memory = memory_of_database(db, tolerance, own)
    a, b, c = memory.matrices
    inertia = mass * np.array([[1.0, center], [center, gyration**2 + center**2]])
    return BerthingShip(
        inertia,
        memory.added_mass_infinity[np.ix_(own, own)],
        a,
        b[:, own],
        c[own, :],
        memory.storage,
        memory.loss,
        center,
    )


def berth(ship, fenders, speed, duration=None, steps=2000, yaw_rate=0.0):
    """`Berthing` of a `BerthingShip` that arrives with a steady speed, m/s, and yaw rate, rad/s; it starts at the
    first contact.

    fenders : sequence of (`mooring.fenders.fender.Fender`, x m, gap m); the ship meets the nearest fender first
    duration : s, by default 1.5 times the time until the ship stops against the softest fender; steps : number of
        steps
    raises : BerthingError without speed or fender; FenderError beyond a fender's table, or for steps that are too long
    """
    if not 0 < speed < np.inf:
        raise BerthingError(f"the speed of the berthing is {speed:g} m/s; allowed: above 0, finite")
    if not fenders:
        raise BerthingError("a berthing has no fender; give one or more")
    made = tuple(fender for fender, _, _ in fenders)
    lever = np.array([[1.0] * len(fenders), [x for _, x, _ in fenders]])
    gap = np.array([far for _, _, far in fenders], float)
    if duration is None:
        stiffness = min(2 * f.rated_energy / (f.rated * f.height) ** 2 for f in made)
        mass = (ship.inertia + ship.added_mass_zero)[0, 0]
        duration = 1.5 * np.pi * np.sqrt(mass / stiffness)
    run = _Run(ship, made, lever, gap - gap.min(), duration / steps)
    return _judged(run, run.integrated(np.array([speed, yaw_rate]), steps))


class _Course(NamedTuple):
    """Rows of a run: z (n, …) of `_Run`, deflection and states of `hysteresis` (n, k), lost (n,) J"""

    z: np.ndarray
    deflection: np.ndarray
    state: np.ndarray
    lost: np.ndarray


class _Run:
    """The berthing as a `Pressed` system of z = (η, ν, x)"""

    def __init__(self, ship, fenders, lever, gap, h):
        self.ship, self.fenders, self.lever, self.gap, self.h = ship, fenders, lever, gap, h
        k, n = len(fenders), len(ship.a)
        self.whole = ship.inertia + ship.added_mass_infinity
        A, B, place = np.zeros((4 + n, 4 + n)), np.zeros((4 + n, k)), np.zeros((k, 4 + n))
        A[:2, 2:4] = np.eye(2)
        A[2:4, 4:] = -np.linalg.solve(self.whole, ship.c)
        A[4:, 2:4], A[4:, 4:] = ship.b, ship.a
        B[2:4] = -np.linalg.solve(self.whole, lever)
        place[:, :2] = lever.T
        self.pressed = Pressed(A, B, place, fenders, h)

    def integrated(self, velocity, steps):
        ship, gap = self.ship, self.gap
        steady = -np.linalg.solve(ship.a, ship.b @ velocity) if len(ship.a) else np.zeros(0)
        z, lost, rows = np.concatenate([np.zeros(2), velocity, steady]), 0.0, []
        for *row, stages in self.pressed.rows(z, gap, repeat((gap, gap, gap), steps + 1)):
            rows.append((*row, lost))
            lost += 0.25 * self.h * float(np.sum((stages[:, 4:] @ ship.loss) ** 2))
        return _Course(*(np.array(column, float) for column in zip(*rows, strict=True)))


def _taken(fender, deflection, state):
    """Energy ∫R dδ along deflections (n,), m, from one row to the next, with the states (n,) of the rows, J; shape
    (n,)"""
    x, w = np.polynomial.legendre.leggauss(4)
    before, after = deflection[:-1], deflection[1:]
    half = 0.5 * (after - before)
    at = 0.5 * (after + before) + half * x[:, None]
    force = reaction_at(fender, np.maximum(at, 0.0), advanced(state[:-1], before, at, fender.return_length))
    return np.concatenate([[0.0], np.cumsum(half * (w @ np.where(at > 0, force, 0.0)))])


def _judged(run, course):
    """`Berthing` of a course, checked against the tables of its fenders and its energy"""
    ship, z = run.ship, course.z
    for k, fender in enumerate(run.fenders):
        fender.energy(max(course.deflection[:, k].max(), 0.0))  # raises beyond its table
    v, x = z[:, 2:4], z[:, 4:]
    held = 0.5 * np.einsum("ti,ij,tj->t", v, run.whole, v) + 0.5 * np.einsum("ti,ij,tj->t", x, ship.storage, x)
    columns = range(len(run.fenders))
    taken = sum(_taken(f, course.deflection[:, k], course.state[:, k]) for k, f in enumerate(run.fenders))
    reaction = [
        reaction_at(run.fenders[k], np.maximum(course.deflection[:, k], 0), course.state[:, k]) for k in columns
    ]
    total = held + taken + course.lost
    first = int(np.argmin(run.gap))
    mass = ship.inertia[0, 0]
    gyration = np.sqrt(ship.inertia[1, 1] / mass - ship.center**2)
    share = eccentricity(run.lever[1, first] - ship.center, gyration)
    speed = run.lever[:, first] @ v[0]
    return Berthing(
        run.h * np.arange(len(z)),
        z[:, :2],
        v,
        np.maximum(course.deflection, 0.0),
        np.stack(reaction, axis=1),
        taken,
        course.lost,
        float(np.abs(total - total[0]).max() / total[0]),
        float(2 * taken.max() / (share * mass * speed**2)),
    )
