"""Ueda's closed form of a berthing: a ship of constant virtual mass meets a dolphin K₁ and a fender K₂ with a plateau
R.

    β = √(K_d/(C_e M₂)),   K_d = K₁ K₂/(K₁ + K₂)
    y₁ = (V/β)(K_d/K₁) sin βt,   y₂ = (V/β)(K_d/K₂) sin βt                       until y₂ = y₂₁ = R/K₂, at t₁
    y₂ = y₂₁ + V₁ (t − t₁) − ½ (R/(C_e M₂)) (t − t₁)²,   V₁ = V cos βt₁           until rest, at t₂ = t₁ + C_e M₂ V₁/R
    E_a = ½ K_d (y₁₁ + y₂₁)² + R (y₂₂ − y₂₁) = ½ C_e M₂ V² = E_e

Ueda (1981), eq. 2.7 to 2.21; misprints of 2.12, 2.13, 2.16 and 2.20 are corrected here.
"""

import math
from dataclasses import dataclass

import numpy as np

from .energy import BerthingError


@dataclass(frozen=True)
class TwoSprings:
    """mass : C_e M₂, kg; speed : m/s; dolphin, fender : K₁ (inf if rigid) and K₂, N/m; plateau : R (inf if none), N"""

    mass: float
    speed: float
    dolphin: float
    fender: float
    plateau: float = math.inf

    def __post_init__(self):
        for key in ("mass", "speed", "dolphin", "fender", "plateau"):
            if not getattr(self, key) > 0:
                raise BerthingError(f"{key} of the two springs is {getattr(self, key):g}; allowed: above 0")

    @property
    def stiffness(self):
        """K_d, N/m"""
        return 1 / (1 / self.dolphin + 1 / self.fender)

    @property
    def beta(self):
        """rad/s"""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def plateau_time(self):
        """t₁, s; inf where the plateau is not reached"""
        share = self.plateau * self.beta / (self.speed * self.stiffness)
        return math.asin(share) / self.beta if share < 1 else math.inf

    @property
    def rest_time(self):
        """Time t₂ of the largest deflection, s"""
        t1 = self.plateau_time
        if math.isinf(t1):
            return 0.5 * math.pi / self.beta
        return t1 + self.mass * self.speed * math.cos(self.beta * t1) / self.plateau

    def deflections(self, time):
        """y₁ of the dolphin and y₂ of the fender, m, at times (n,) s from contact to rest"""
        t, t1 = np.asarray(time, float), self.plateau_time
        before = np.minimum(t, t1)
        force = self.speed / self.beta * self.stiffness * np.sin(self.beta * before)
        y1, y2 = force / self.dolphin, force / self.fender
        if math.isinf(t1):
            return y1, y2
        on, v1 = np.maximum(t - t1, 0.0), self.speed * math.cos(self.beta * t1)
        return y1, y2 + v1 * on - 0.5 * self.plateau / self.mass * on**2

    @property
    def reaction(self):
        """Largest reaction, N"""
        return min(self.plateau, self.speed * math.sqrt(self.stiffness * self.mass))

    @property
    def energy(self):
        """E_a, J, absorbed by dolphin and fender at rest (eq. 2.20)"""
        y1, y2 = (float(y) for y in self.deflections(self.rest_time))
        y21 = min(y2, self.plateau / self.fender)
        spring = 0.5 * self.stiffness * (y1 + y21) ** 2
        return spring + (self.plateau * (y2 - y21) if y2 > y21 else 0.0)

    @property
    def kinetic(self):
        """E_e, J"""
        return 0.5 * self.mass * self.speed**2
