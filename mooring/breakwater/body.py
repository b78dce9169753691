"""A floating body of symmetric section, per metre of its length: buoyancy, and the taut lines that hold the body.

    heave ρg B_w,    roll about the centre of gravity ρg {B_w³/12 + A (z_B − z₀)},    2P₀ sin α = g (ρA − M₀)

A displaced area about z_B, B_w width at the waterline, z₀ centre of gravity; α and the mode of `OnTautLines` are
defined in `taut`, with their source.
"""

from dataclasses import dataclass

import numpy as np


class Buoyant:
    """Hydrostatics of a body with `mass`, `inertia`, `z0`, `area`, `buoyancy_z`, `waterline`, `density`, `gravity` like
    a `FloatingBody`"""

    @property
    def radius(self):
        """Radius of gyration, m"""
        return np.sqrt(self.inertia / self.mass)

    @property
    def heave_stiffness(self):
        """N/m²"""
        return self.density * self.gravity * self.waterline

    @property
    def roll_stiffness(self):
        """Roll stiffness of the pressures about the centre of gravity, N"""
        return self.density * self.gravity * (self.waterline**3 / 12 + self.area * (self.buoyancy_z - self.z0))

    def _check(self, positive):
        for name in positive:
            if not 0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name} is {getattr(self, name):g}; allowed: above 0 and finite")
        if not self.draft < self.depth < np.inf:
            raise ValueError(f"depth is {self.depth:g} m at draft {self.draft:g} m; allowed: above the draft, finite")


@dataclass(frozen=True, kw_only=True)
class FloatingBody(Buoyant):
    """A body afloat without lines, per metre.

    mass : kg/m; z0 : height of the centre of gravity, m; inertia : moment of inertia about the centre of gravity, kg m
    area : displaced area, m², centred at buoyancy_z, m; waterline : width of the waterline, m; draft, depth : m
    density : kg/m³; gravity : m/s². Raises ValueError for lengths that do not describe a body.
    """

    mass: float
    z0: float
    inertia: float
    area: float
    buoyancy_z: float
    waterline: float
    draft: float
    depth: float
    density: float = 1025.0
    gravity: float = 9.80665

    def __post_init__(self):
        self._check(("mass", "inertia", "area", "draft", "density", "gravity"))


class OnTautLines(Buoyant):
    """Effect of two pairs of taut lines on a body that, like a `TautBody`, has `angle`, `attachment`,
    `attachment_z`, `line`
    """

    @property
    def pretension(self):
        """P₀ of each line, N/m"""
        return self.gravity * (self.density * self.area - self.mass) / (2 * np.sin(self.angle))

    @property
    def mode(self):
        """(ξ, θ) for a unit q: X, m, and cos α"""
        c = np.cos(self.angle)
        return np.array([self.attachment * np.sin(self.angle) + (self.attachment_z - self.z0) * c, c])

    @property
    def restoring(self):
        """Restoring force, N/m, and moment about the centre of gravity, N, for a unit q"""
        s, c, slope = np.sin(self.angle), np.cos(self.angle), self.attachment / self.line
        arm = self.attachment * c + (self.z0 - self.attachment_z) * s
        both = 2 * self.pretension
        return np.array([both * slope * s, self.roll_stiffness * c + both * arm * (slope + c)])

    @property
    def stiffness(self):
        """C of the module; below 0 the upright position is unstable"""
        return float(self.mode @ self.restoring)

    def line_difference(self, force):
        """Difference P_B − P_F, shape (…), that gives `force` (…, 2): horizontal force and moment; exact where force
        · mode is 0.

        The moment is divided by the radius: vertical lines have only a moment, lines through the centre only a force.
        """
        direction = np.array([np.cos(self.angle), -self.mode[0]]) / [1.0, self.radius]
        return (np.asarray(force) / [1.0, self.radius]) @ direction / (direction @ direction)

    def _check_lines(self):
        if not 0 < self.angle < np.pi:
            raise ValueError(f"the lines are at {np.degrees(self.angle):g}°; allowed: above 0 and below 180")
        for name in ("attachment", "line"):
            if not 0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name} is {getattr(self, name):g} m; allowed: above 0 and finite")


@dataclass(frozen=True, kw_only=True)
class TautBody(FloatingBody, OnTautLines):
    """A `FloatingBody` that two pairs of taut lines hold below its floating draft.

    angle : α, rad; attachment, attachment_z : l₁ and the height of the lines' upper ends, m; line : S, m
    Raises ValueError for impossible lines or bodies.
    """

    angle: float
    attachment: float
    attachment_z: float
    line: float

    def __post_init__(self):
        super().__post_init__()
        self._check_lines()
        if self.mass > self.density * self.area:
            raise ValueError(
                f"the mass is {self.mass:.6g} kg/m and the displaced mass {self.density * self.area:.6g} kg/m: "
                "the pretension is negative; give a lighter body or more draft"
            )
