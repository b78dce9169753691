"""A ship that passes a moored ship on a parallel track, and the resulting forces as a table over time.

Axes are those of the moored ship: x to the bow, y to port, with the origin amidships in the water surface.  ξ is the
distance by which the middle of the passing ship is ahead of the middle of the moored ship, η the distance to port.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..environment.spectra import GRAVITY
from ..loads.over_wave import moved
from ..motion.given_forces import GivenForce

SQUEEZED = 1.1  # 1/√(1 − Fₕ²), increase of the pressure on a slender ship in subcritical shallow water (Tuck 1966)
FAR = 0.02  # largest accepted force at the ends of a track, over the largest surge or sway
ROUNDING = 1e-6  # force over the larger of surge and sway below which it is zero


@dataclass(frozen=True)
class Track:
    """Track and speed of the passing ship.

    distance : distance of the passing ship's centre line from that of the moored ship, m, positive to port
    speed : m/s over the ground, > 0; opposite : whether the passing ship heads towards the stern of the moored ship
    current : m/s over the ground, positive towards the bow of the moored ship
    """

    distance: float
    speed: float
    opposite: bool = False
    current: float = 0.0

    def __post_init__(self):
        if not (math.isfinite(self.distance) and self.distance != 0):
            raise ValueError(f"distance is {self.distance} m; allowed: a finite distance other than 0")
        if not 0 < self.speed < math.inf:
            raise ValueError(f"speed is {self.speed} m/s; allowed: above 0")
        if not abs(self.current) < self.speed:
            raise ValueError(
                f"current is {self.current} m/s; allowed: below the speed of {self.speed:g} m/s, so that the "
                f"ship passes"
            )

    @property
    def way(self):
        """+1 towards the bow of the moored ship, −1 towards its stern"""
        return -1.0 if self.opposite else 1.0

    @property
    def through_water(self):
        """Speed of the passing ship through the water, m/s"""
        return self.speed - self.way * self.current

    def froude(self, depth):
        """Fₕ = U/√(gh) of the speed through the water; 0 in deep water"""
        return self.through_water / math.sqrt(GRAVITY * depth) if math.isfinite(depth) else 0.0


def along_track(track, moored, passing, lengths, fine=1):
    """Places ξ up to `lengths` mean lengths of the ships before and behind; shape (n,).

    moored, passing : lengths of the ships, m; fine : factor on the number of places.
    The places are at most an eighth of the shorter ship's length and a quarter of `distance` apart.
    """
    reach = lengths * 0.5 * (moored + passing)
    step = min(0.125 * min(moored, passing), 0.25 * abs(track.distance)) / fine
    return np.linspace(-reach, reach, 2 * math.ceil(reach / step) + 1)


@dataclass(frozen=True, eq=False)
class Passage:
    """Forces of a passage.

    track : Track; stagger : (n,) m, ξ, rising
    changing : force of the unsteady pressure, (n, 6), N and N m; steady : force of the squared velocities, (n, 6), 0
        by slender methods.
    Moments are about the middle of the moored ship, or about the point given to `about`.
    """

    track: Track
    stagger: np.ndarray
    changing: np.ndarray
    steady: np.ndarray

    @property
    def force(self):
        """Sum of both parts of the force, N, N m; shape (n, 6)"""
        return self.changing + self.steady

    def about(self, place):
        """The Passage with moments about a point (3,) m in place of the middle of the moored ship"""
        place, middle = np.asarray(place, float), np.zeros(3)
        parts = {name: moved(getattr(self, name), middle, place) for name in ("changing", "steady")}
        return replace(self, **parts)

    @cached_property
    def in_time(self):
        """`GivenForce` over time, from 0 at the beginning of the passage"""
        places, force = self.stagger, self.force
        if self.track.opposite:
            places, force = -places[::-1], force[::-1]
        return GivenForce((places - places[0]) / self.track.speed, force)

    @property
    def left(self):
        """Largest surge or sway force at the ends of the track, over the largest force of the passage"""
        plane = np.abs(self.force[:, :2])
        return float(np.max(plane[[0, -1]] / np.maximum(plane.max(axis=0), ROUNDING * plane.max())))
