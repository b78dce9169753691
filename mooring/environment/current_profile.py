"""Current over the depth.

    U(z) = U₀ (1 + z/h)^α    for −h ≤ z ≤ 0    SR179 report (1982), chapter 4, section 3.9

α = 1 for a wind-driven current, whose surface speed is 0.01 U₁₀ in the report. α = 1/7 is usual for a tidal current
(the report prints 1/2).  Above z = 0 the surface value applies, below the bed there is no current.  Profiles can be
added: `power_law(…) + wind_drift(…)`.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .allowed import positive, row_of_numbers, within

WIND_DRIFT = 0.01  # surface current over U₁₀
FASTEST = 20.0  # m/s


@dataclass(frozen=True)
class CurrentProfile:
    """Sum of currents; parts : functions of z (…) m that return (…, 2) m/s along x and y"""

    parts: tuple[Callable, ...]

    def velocity(self, z):
        """Velocity of the current at heights z (…), m, 0 at the surface and negative below, m/s; shape (…, 3)"""
        z = np.asarray(z, float)
        total = np.zeros((*z.shape, 3))
        for part in self.parts:
            total[..., :2] += part(np.minimum(z, 0.0))
        return total

    def __add__(self, other):
        return CurrentProfile(self.parts + other.parts)

    def over_draft(self, draft):
        """Speed, m/s, and direction, rad, of the uniform current whose ½ρU² along x and y equals the mean over a
        draft (m).

        Coefficients of boxes and hulls are measured in uniform currents. For a profile that turns over the draft
        they are a guess.
        """
        positive("draft", draft, "m")
        x, weight = np.polynomial.legendre.leggauss(32)
        u = self.velocity(-0.5 * draft * (1 + x))[:, :2]
        pressure = 0.5 * weight @ (u * np.hypot(*u.T)[:, None])
        return float(np.sqrt(np.hypot(*pressure))), float(np.arctan2(pressure[1], pressure[0]))


@dataclass(frozen=True)
class _Power:
    surface: tuple[float, float]
    depth: float
    exponent: float

    def __call__(self, z):
        share = np.clip(1 + z / self.depth, 0.0, 1.0)
        inside = z >= -self.depth * (1 + 1e-9)
        return (np.where(inside, share**self.exponent, 0.0))[..., None] * np.array(self.surface)


@dataclass(frozen=True, eq=False)
class _Table:
    z: np.ndarray
    velocity: np.ndarray

    def __call__(self, z):
        from scipy.interpolate import PchipInterpolator

        inside = (z >= self.z[0] * (1 + 1e-9))[..., None]
        return np.where(inside, PchipInterpolator(self.z, self.velocity)(np.clip(z, self.z[0], self.z[-1])), 0.0)


def uniform(speed, direction, depth=np.inf):
    """A current that is constant from the surface to the bed; speed : m/s; direction : direction of travel, rad;
    depth : m
    """
    return power_law(speed, direction, depth, 0.0)


def power_law(speed, direction, depth, exponent):
    """CurrentProfile with `speed` m/s at the surface towards `direction` rad in `depth` m of water.

    raises : ValueError for speeds outside 0 to 20 m/s, depths not above 0, exponents outside 0 to 3, and for an
        infinite depth with an exponent above 0 (which would be a uniform current)
    """
    within("current speed", speed, 0.0, FASTEST, "m/s")
    if exponent == 0 and depth == np.inf:
        return CurrentProfile((_Power(_components(speed, direction), np.inf, 0.0),))
    positive("depth of the current profile", depth, "m")
    within("exponent of the current profile", exponent, 0.0, 3.0)
    return CurrentProfile((_Power(_components(speed, direction), float(depth), float(exponent)),))


def wind_drift(speed_10, direction, depth):
    """Current driven by a wind of `speed_10` m/s towards `direction`: 1 % of the wind speed at the surface, linear to
    zero at the bed"""
    within("wind speed at 10 m", speed_10, 0.0, 200.0, "m/s")
    return power_law(WIND_DRIFT * speed_10, direction, depth, 1.0)


def table(z, speed, direction):
    """CurrentProfile through points; z : (n,) m, ascending from the bed to the surface; speed : m/s; direction :
    rad, (n,) or one.

    The components along x and y are monotone cubics between the points. The last point applies up to the surface; below
    the first point there is no current. raises : ValueError for points that do not form a profile
    """
    z, speed = row_of_numbers("z of the current profile", z, 2), row_of_numbers("current speed", speed, 2)
    direction = row_of_numbers("current direction", np.broadcast_to(np.asarray(direction, float), z.shape))
    if len(speed) != len(z):
        raise ValueError(f"the current profile has {len(z)} heights and {len(speed)} speeds; allowed: the same number")
    if not (np.all(np.diff(z) > 0) and z[-1] <= 0):
        raise ValueError(f"z of the current profile runs from {z[0]:g} to {z[-1]:g} m; allowed: increasing, at most 0")
    if not np.all((speed >= 0) & (speed <= FASTEST)):
        wrong = speed[~((speed >= 0) & (speed <= FASTEST))][0]
        raise ValueError(
            f"current speed is {wrong:g} m/s; allowed: 0 to {FASTEST:g} m/s; give the direction separately"
        )
    return CurrentProfile((_Table(z, np.stack([speed * np.cos(direction), speed * np.sin(direction)], axis=-1)),))


def _components(speed, direction):
    if not np.isfinite(direction):
        raise ValueError(f"current direction is {direction:g} rad; allowed: a finite number")
    return float(speed * np.cos(direction)), float(speed * np.sin(direction))
