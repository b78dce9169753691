"""A rectangle on taut lines that do not stretch: it can only turn about the point Q where the lines meet.

With q the coordinate along which the lines allow motion, for lines at angle α fixed at ±l₁ on the bottom,

    ξ = X q,  θ = q cos α,    X = l₁ sin α − (d + z₀) cos α = GQ cos α
    (C − ω²J) q = force along q,    J = M₀X² + I cos²α,    M₀ = 2ρl d₀,   2P₀ sin α = V = 2ρgl(d − d₀)
    C = 2ρgdl GM cos²α + V/sin α {(l₁ cos α + (d+z₀) sin α)(l₁/S + cos α) cos α + l₁ sin α X/S},
    GM = l²/3d − d/2 − z₀

which hold from α = 0 through 90°, where Q is at infinity, to 180°, for they are eq. 4.1 to 4.5 times cos α.
C < 0: the upright position is unstable, of which both theories warn.
Ito and Chiba's water adds I₁ to I and (F = f_H X − l f_M cos α)

    y = y_B + y_Q,   y_Q = 2ρg kd² F² / (n (ω²J − C)),   a_T = iy a/(1 + iy),   (C − ω²J) q = 2ρgd F (a − a_T)

Kihara, Kitatani & Todoroki (1975), eq. 4.1 to 4.10; 4.9 prints a_T without its i.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .long_waves import long_wave, moment_factor


@dataclass(frozen=True)
class TautRectangle:
    """A rectangle on two pairs of taut lines, per metre of its length.

    half : l, m; draft : d, moored, m; free_draft : d₀, without lines, m; depth : m
    z0 : centre of gravity, m; inertia : I about it, kg m; angle : α, rad; attachment : l₁, m; line : S, m
    density : kg/m³; gravity : m/s².  Raises ValueError where lines or body cannot be so.
    """

    half: float
    draft: float
    free_draft: float
    depth: float
    z0: float
    inertia: float
    angle: float
    attachment: float
    line: float
    density: float = 1025.0
    gravity: float = 9.80665

    def __post_init__(self):
        for name in ("half", "draft", "free_draft", "inertia", "line", "density", "gravity"):
            if not 0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name} is {getattr(self, name):g}; allowed: above 0 and finite")
        if not self.draft < self.depth < np.inf:
            raise ValueError(f"depth is {self.depth:g} m at draft {self.draft:g} m; allowed: above the draft, finite")
        if self.free_draft > self.draft:
            raise ValueError(
                f"free draft {self.free_draft:g} m is above the moored draft {self.draft:g} m: the pretension is "
                "negative; give a lighter body or more draft"
            )
        if not 0 < self.angle < np.pi:
            raise ValueError(f"lines at {np.degrees(self.angle):g}°; allowed: above 0 and below 180")
        if not 0 < self.attachment < np.inf:
            raise ValueError(f"attachment is {self.attachment:g} m; allowed: above 0 and finite")

    @property
    def mass(self):
        """M₀, kg/m"""
        return 2 * self.density * self.half * self.free_draft

    @property
    def pretension(self):
        """P₀ of each line, N/m"""
        excess = self.density * self.gravity * self.half * (self.draft - self.free_draft)
        return excess / np.sin(self.angle)

    @property
    def mode(self):
        """(ξ, θ) of unit q: X in m and cos α"""
        c = np.cos(self.angle)
        return np.array([self.attachment * np.sin(self.angle) - (self.draft + self.z0) * c, c])

    @property
    def restoring(self):
        """Horizontal force and moment about the centre of gravity against unit q, N/m and N"""
        s, c, slope = np.sin(self.angle), np.cos(self.angle), self.attachment / self.line
        metacentric = self.half**2 / (3 * self.draft) - self.draft / 2 - self.z0
        weight = 2 * self.density * self.gravity * self.draft * self.half
        arm = self.attachment * c + (self.draft + self.z0) * s
        both = 2 * self.pretension
        return np.array([both * slope * s, weight * metacentric * c + both * arm * (slope + c)])

    @property
    def stiffness(self):
        """C of the module; below 0 the upright position is unstable"""
        return float(self.mode @ self.restoring)

    def line_difference(self, force):
        """P_B − P_F (…) that gives `force` (…, 2), horizontal and moment; exact where force · mode is 0.

        The moment counts per half width: vertical lines have only a moment, lines through the centre only a force.
        """
        direction = np.array([np.cos(self.angle), -self.mode[0]]) / [1.0, self.half]
        return (np.asarray(force) / [1.0, self.half]) @ direction / (direction @ direction)


class TautMotion(NamedTuple):
    """Per unit wave amplitude, (...,) complex by frequency.

    transmission, reflection : m/m, referred to the origin; sway : of the centre of gravity, m/m; roll : rad/m
    front, back : amplitudes of tension P_F and P_B, N/m²
    """

    transmission: np.ndarray
    reflection: np.ndarray
    sway: np.ndarray
    roll: np.ndarray
    front: np.ndarray
    back: np.ndarray


def taut_long_wave(body, omega):
    """`TautMotion` of a `TautRectangle` in the uniform flow of Ito and Chiba; omega : (...,) rad/s"""
    warn_if_unstable(body)
    omega = np.asarray(omega, float)
    wave = long_wave(body.half, body.draft, body.depth, omega, body.gravity)
    d, l, c = body.draft, body.half, body.mode[1]
    pressure = np.stack([wave.f_H, -l * moment_factor(wave, l, d, body.depth, body.z0)], axis=-1)
    flow = pressure @ body.mode
    inertia = np.array([body.mass, body.inertia + added_inertia(body)]) * body.mode
    weight = 2 * body.density * body.gravity * d
    inside = omega**2 * (inertia @ body.mode) - body.stiffness
    whole = inside * (1 + 1j * wave.y_B) + 1j * wave.k * d / wave.n * weight * flow**2  # finite where y is not
    difference, q = inside / whole, -weight * flow / whole
    of_lines = body.restoring - omega[..., None] ** 2 * inertia
    lines = body.line_difference(of_lines * q[..., None] - weight * pressure * difference[..., None])
    both = 2 * body.density * body.gravity * l * wave.f_B / np.sin(body.angle)
    return TautMotion(1 - difference, difference, body.mode[0] * q, c * q, (both - lines) / 2, (both + lines) / 2)


def warn_if_unstable(body):
    """Warn that waves are asked about an upright position in which the body does not stay"""
    if body.stiffness <= 0:
        warnings.warn(
            f"lines at {np.degrees(body.angle):.4g}°: the upright position is unstable, its stiffness is "
            f"{body.stiffness:.3g} N/m, allowed: above 0; lower the centre of gravity or change the angle",
            stacklevel=3,
        )


def added_inertia(body):
    """I₁ of the water between body and bed, kg m (eq. 4.7)"""
    gap = body.depth - body.draft
    return 2 * body.density * body.half**3 / gap * (body.half**2 / 45 + gap**2 / 9)
