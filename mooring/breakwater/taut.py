"""A rectangle on inextensible taut lines: the rectangle can only rotate about the point Q where the lines meet.

With q the coordinate along which the lines allow motion, for lines at angle α fixed at ±l₁ on the bottom,

    ξ = X q,  θ = q cos α,    X = l₁ sin α − (d + z₀) cos α = GQ cos α
    (C − ω²J) q = force along q,    J = M₀X² + I cos²α,    M₀ = 2ρl d₀,   2P₀ sin α = V = 2ρgl(d − d₀)
    C = 2ρgdl GM cos²α + V/sin α {(l₁ cos α + (d+z₀) sin α)(l₁/S + cos α) cos α + l₁ sin α X/S},
    GM = l²/3d − d/2 − z₀

These equations hold from α = 0 through 90°, where Q is at infinity, to 180°, since they are eq. 4.1 to 4.5 times cos
α. If C < 0 the upright position is unstable; both theories warn of this. Ito and Chiba's water adds I₁ to I and (F =
f_H X − l f_M cos α)

    y = y_B + y_Q,   y_Q = 2ρg kd² F² / (n (ω²J − C)),   a_T = iy a/(1 + iy),   (C − ω²J) q = 2ρgd F (a − a_T)

Kihara, Kitatani & Todoroki (1975), eq. 4.1 to 4.10; 4.9 prints a_T without its i.
"""

import warnings
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .body import FloatingBody, OnTautLines
from .long_waves import long_wave, moment_factor


@dataclass(frozen=True)
class TautRectangle(OnTautLines):
    """A rectangle on two pairs of taut lines, per metre of its length.

    half : half width l, m; draft : moored draft d, m; free_draft : draft d₀ without lines, m; depth : m
    z0 : height of the centre of gravity, m; inertia : I about the centre of gravity, kg m; angle : α, rad;
        attachment : l₁, m; line : S, m
    density : kg/m³; gravity : m/s².  Raises ValueError for impossible lines or bodies.
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
        self._check(("half", "draft", "free_draft", "inertia", "density", "gravity"))
        self._check_lines()
        if self.free_draft > self.draft:
            raise ValueError(
                f"free draft {self.free_draft:g} m is above the moored draft {self.draft:g} m: the pretension is "
                "negative; give a lighter body or more draft"
            )

    @property
    def waterline(self):
        """m"""
        return 2 * self.half

    @property
    def area(self):
        """Displaced area on the lines, m²"""
        return 2 * self.half * self.draft

    @property
    def buoyancy_z(self):
        """m"""
        return -self.draft / 2

    @property
    def attachment_z(self):
        """Height of the lines' upper ends, m; the lines end on the bottom of the body"""
        return -self.draft

    @property
    def mass(self):
        """M₀, kg/m"""
        return 2 * self.density * self.half * self.free_draft

    @property
    def afloat(self):
        """`FloatingBody` without lines"""
        rise = self.draft - self.free_draft
        return FloatingBody(
            mass=self.mass, z0=self.z0 + rise, inertia=self.inertia, area=2 * self.half * self.free_draft,
            buoyancy_z=-self.free_draft / 2, waterline=2 * self.half, draft=self.free_draft, depth=self.depth,
            density=self.density, gravity=self.gravity,
        )  # fmt: skip


class TautMotion(NamedTuple):
    """Complex amplitudes per unit wave amplitude, (...,) over frequency.

    transmission, reflection : m/m, referred to the origin; sway : sway of the centre of gravity, m/m; roll : rad/m
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
    """Warn that the upright position, for which waves are computed, is unstable."""
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
