"""Velocity and acceleration of the water in one regular wave on a current, up to its surface.

    η = a cos(k·x − ωt),    u = aω cosh ks / sinh kh · k̂ cos(k·x − ωt),    w = aω sinh ks / sinh kh · sin(k·x − ωt)

of linear theory, s = z + h. They are stretched after Wheeler (1970): velocities at s are those of linear theory at s
h/(h + η), so that the water at the crest moves as at z = 0.  The current profile is stretched in the same way; the
current does not change the wave length.
"""

from dataclasses import dataclass

import numpy as np

from hakobune.bem.waves import depth_factor, depth_factor_slope, group_factor, wavenumber

from ..environment.current_profile import CurrentProfile

GRAVITY = 9.80665


@dataclass(frozen=True)
class RegularWave:
    """amplitude : m; omega : rad/s; direction : direction of travel, rad; depth : m; current : CurrentProfile or
    None
    """

    amplitude: float
    omega: float
    direction: float
    depth: float
    current: CurrentProfile | None = None

    @property
    def k(self):
        """rad/m"""
        return float(wavenumber(self.omega, self.depth, GRAVITY))

    @property
    def energy_speed(self):
        """Group velocity in the moving water, m/s"""
        return float(group_factor(self.k, self.depth)) * self.omega / self.k

    @property
    def against(self):
        """Speed of the current at the surface against the wave, m/s; below 0 with the wave"""
        if self.current is None:
            return 0.0
        x, y = self.current.velocity(0.0)[:2]
        return float(-x * np.cos(self.direction) - y * np.sin(self.direction))

    @property
    def met_period(self):
        """Time from crest to crest, s, at a fixed place past which the current at the surface carries the wave

        The value is inf if the current holds the wave in place, and below 0 if the current carries the wave back.
        """
        met = self.omega - self.k * self.against
        return 2 * np.pi / met if met else np.inf

    def elevation(self, places, phase):
        """Elevation η (n,) m at places (n, 2 or 3) m; the crest is at the origin at phase ωt = 0 rad"""
        return self.amplitude * np.cos(self._turn(places, phase))

    def flow(self, places, phase):
        """Velocity m/s and acceleration m/s² (n, 3) of the water at places (n, 3) m below the surface"""
        k, turn = self.k, self._turn(places, phase)
        z = self.unstretched(places, phase)
        scale = self.amplitude * GRAVITY * k / self.omega
        across, up = scale * depth_factor(z, k, self.depth), scale * depth_factor_slope(z, k, self.depth) / k
        way = np.array([np.cos(self.direction), np.sin(self.direction), 0.0])
        rise = np.array([0.0, 0.0, 1.0])
        velocity = np.outer(across * np.cos(turn), way) + np.outer(up * np.sin(turn), rise)
        acceleration = self.omega * (np.outer(across * np.sin(turn), way) - np.outer(up * np.cos(turn), rise))
        return (velocity if self.current is None else velocity + self.current.velocity(z)), acceleration

    def unstretched(self, places, phase):
        """Heights at which linear theory is evaluated for places under the wave surface (stretching), m; shape (n,)"""
        eta, z = self.elevation(places, phase), np.asarray(places)[:, 2]
        return z - eta if np.isinf(self.depth) else (z + self.depth) * self.depth / (self.depth + eta) - self.depth

    def _turn(self, places, phase):
        places = np.asarray(places, float)
        along = places[:, 0] * np.cos(self.direction) + places[:, 1] * np.sin(self.direction)
        return self.k * along - phase
