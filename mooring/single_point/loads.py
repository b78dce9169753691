"""Steady loads on a body that lies or slews at one point, as functions of its heading and slow motion.

    F = F_wind(α_w) |U_w|² + F_water + F_drift(ψ)

in axes of the body about its centre of mass; α is the angle from which a stream meets the moving body. F_water comes
either from turning tests, as polynomials in the turn r' = rL/V at each drift angle,

    F_water = Σₖ cₖ(β) V^(2−k) (rL)ᵏ,    k = 0 … 4,   |rL| ≤ V/2                 (SR179 report 1982, eq. 2.3.2, 3.6.8)

or from current coefficients, with −N₂ r|r| for the cross flow of a turning body. Only one of the two is used,
because both contain the force of the current.  Velocities u, v are relative to the water, r is the yaw rate.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..environment.gusts import GustSpectrum
from ..loads.box_drag import about
from ..loads.on_hull import drag_share
from ..loads.turning import LARGEST_TURN, TurningCoefficients
from .rings import Ring, angles

POWERS = 5  # number of powers of r', 0 to 4


@dataclass(frozen=True, eq=False)
class WindLoad:
    """table : (count, 3), N s²/m² and N m s²/m², force at unit speed over the direction of the wind's travel, from
    the bow

    speed : m/s; direction : direction of travel in space, rad; gusts : `GustSpectrum`, None for a steady wind
    height : heights above still water at which forces along and across the body act, (2,) m
    """

    table: np.ndarray
    speed: float
    direction: float
    gusts: GustSpectrum | None = None
    height: tuple[float, float] = (0.0, 0.0)

    @cached_property
    def ring(self):
        """Ring of the table"""
        return Ring(self.table)


@dataclass(frozen=True, eq=False)
class WaterLoad:
    """Force of the water on the hull, and the current that causes this force.

    table : (count, 5, 3), force, N, divided by V^(2−k) (rL)ᵏ, over the direction of flow, from the bow
    length : length L in r', m; turning : whether the table comes from turning tests, which include inertia
    speed : m/s; direction : direction of flow in space, rad
    quadratic : N₂ of yaw, N m s²; linear : (3, 3) damping, N s/m …
    height : height of the point of action above still water, m; at_rest : fraction of the table that applies for a
        round hull moving in water at rest (`loads.on_hull.StreamOnHull.still`)
    """

    table: np.ndarray
    length: float
    turning: bool
    speed: float = 0.0
    direction: float = 0.0
    quadratic: float = 0.0
    linear: np.ndarray | None = None
    height: float = 0.0
    at_rest: float = 1.0

    @cached_property
    def ring(self):
        """Ring of the table"""
        return Ring(self.table)

    @cached_property
    def still(self):
        """Ring of the force on a body without rotation"""
        return self.ring.part(0)

    @property
    def velocity(self):
        """Velocity of the current in space, m/s; shape (2,)"""
        return self.speed * np.array([np.cos(self.direction), np.sin(self.direction)])

    def share(self, heading, u, v):
        """Fraction of the table that applies for a body at a heading with velocities through the water, m/s"""
        if self.at_rest == 1.0:
            return 1.0
        c = self.direction - heading
        own = np.hypot(u + self.speed * np.cos(c), v + self.speed * np.sin(c))
        return float(drag_share(self.at_rest, self.speed, own))

    def force(self, u, v, r, share=1.0):
        """Force, N, N, N m, at a velocity through the water along and across the body, m/s, and a yaw rate, rad/s;
        shape (3,); share : of the table"""
        V = np.hypot(u, v)
        out = np.zeros(3)
        if V > 0:
            turn = min(max(r * self.length, -LARGEST_TURN * V), LARGEST_TURN * V) / V
            c = self.ring(np.arctan2(-v, -u))
            out = share * V * V * (c[0] + turn * (c[1] + turn * (c[2] + turn * (c[3] + turn * c[4]))))
        out[2] -= self.quadratic * r * abs(r)
        return out if self.linear is None else out - self.linear @ np.array([u, v, r])


@dataclass(frozen=True, eq=False)
class DriftLoad:
    """table : (count, 3) N, N, N m of mean wave drift in axes of the body, over its heading in space"""

    table: np.ndarray

    @cached_property
    def ring(self):
        """Ring of the table"""
        return Ring(self.table)


@dataclass(frozen=True, eq=False)
class Loads:
    """All loads on the body except its mooring; None for an absent load"""

    water: WaterLoad
    wind: WindLoad | None = None
    drift: DriftLoad | None = None

    def at_rest(self, heading):
        """Force, N, N, N m, in axes of the body at rest at headings (n,), rad; shape (n, 3)"""
        heading, water = np.asarray(heading, float), self.water
        stream = water.direction - heading
        total = water.speed**2 * water.still.along(stream)
        if water.linear is not None:
            total = total + water.speed * np.stack([np.cos(stream), np.sin(stream)], axis=-1) @ water.linear[:, :2].T
        if self.wind is not None:
            total = total + self.wind.speed**2 * self.wind.ring.along(self.wind.direction - heading)
        return total if self.drift is None else total + self.drift.ring.along(heading)

    def moving(self, heading, velocity, wind_speed=None):
        """Force, N, N, N m, at one heading, with velocities (u, v, r) through the water; shape (3,)

        wind_speed : m/s at this instant, by default the mean
        """
        u, v, r = velocity
        total = self.water.force(u, v, r, self.water.share(heading, u, v))
        if self.wind is not None:
            speed = self.wind.speed if wind_speed is None else wind_speed
            x, y = self._through_air(heading, u, v, speed)
            total = total + (x * x + y * y) * self.wind.ring(np.arctan2(y, x))
        return total if self.drift is None else total + self.drift.ring(heading)

    def _through_air(self, heading, u, v, speed):
        """Wind relative to the moving body, m/s, in its axes"""
        water = self.water
        w, c = self.wind.direction - heading, water.direction - heading
        return (
            speed * np.cos(w) - u - water.speed * np.cos(c),
            speed * np.sin(w) - v - water.speed * np.sin(c),
        )


def turning_table(coefficients: TurningCoefficients, length, draft, density, count=720):
    """Table of a WaterLoad from turning tests of a box; shape (count, 5, 3); length, draft : m; density : kg/m³

    Rows are directions of flow: past a body with the drift angle β water flows towards π − β, so that v = −V sin β.
    """
    return coefficients.powers(np.pi - angles(count)) * (0.5 * density * length * draft * np.array([1, 1, length]))


def still_table(unit):
    """Table of a WaterLoad with a force independent of the yaw rate; shape (count, 5, 3); unit : (count, 3) at 1 m/s"""
    table = np.zeros((len(unit), POWERS, 3))
    table[:, 0] = unit
    return table


def isotropic_drift(force, direction, center=(0.0, 0.0), middle=(0.0, 0.0), count=720):
    """DriftLoad of a constant force, N, in the wave direction at any heading, amidships; direction : rad"""
    along = direction - angles(count)
    load = force * np.stack([np.cos(along), np.sin(along), np.zeros(count)], axis=-1)
    return DriftLoad(about(load, middle, center))
