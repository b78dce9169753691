"""Free-free shapes of a uniform Euler–Bernoulli beam, and the loads in the beam due to a shape.

    w(s) = ½ {cos μs/cos μ + cosh μs/cosh μ},  tan μ + tanh μ = 0        even about the middle
    w(s) = ½ {sin μs/sin μ + sinh μs/sinh μ},  tan μ − tanh μ = 0        odd
    θ(s) = cos(nπ(1 + s)/2)                                              torsion

s runs from −1 to 1 over the length L, and the forward end moves by 1 m or 1 rad.  With β = 2μ/L

    ∫ m w² dx = mL/4,  ∫ EI w″² dx = EI β⁴ L/4,      ∫ I θ² dx = IL/2,  ∫ GJ θ′² dx = GJ (nπ/L)² L/2

Sections stay plane and upright to the axis: u = (−(z − z₀) w′, 0, w) in vertical bending, (−y w′, w, 0) in horizontal,
θ (0, −(z − z₀), y) in torsion.  With the rotation ω = (θ, −w′, v′) of a section this is u = (0, v, w) + ω × a, a =
(0, y, z − z₀).  The axis does not change its length; therefore products of two shapes move points by

    u_ij = ½ {ω_i (ω_j·a) + ω_j (ω_i·a)} − (ω_i·ω_j) a − (∫ (w_i′w_j′ + v_i′v_j′) dx, 0, 0)
"""

from typing import NamedTuple

import numpy as np

STEPS = 4001  # places along a beam of the integral of two slopes
BENDING = ("vertical bending", "horizontal bending")
KINDS = (*BENDING, "torsion")


class Beam(NamedTuple):
    """One shape of a beam along x.

    kind : one of KINDS; number : number of the shape, from 1; start, end : x of the two ends, m
    height : z₀ of the neutral axis or shear centre, m
    rigidity : EI or GJ, N m²; per_length : mass per length, kg/m, or, in torsion, moment of inertia per length, kg m
    """

    kind: str
    number: int
    start: float
    end: float
    height: float
    rigidity: float
    per_length: float

    @property
    def length(self):
        """m"""
        return self.end - self.start

    @property
    def turns(self):
        """Whether the amplitude of the shape is in rad"""
        return self.kind == "torsion"

    @property
    def mass(self):
        """Modal mass of the shape, kg or kg m²"""
        return self.per_length * self.length / (2 if self.turns else 4)

    @property
    def stiffness(self):
        """Modal stiffness of the shape, N/m or N m/rad"""
        return self.mass * self.rigidity / self.per_length * self._wavenumber ** (2 if self.turns else 4)

    def along(self, x, slope=0):
        """w or θ, or its derivative of order `slope` along x, at x (…,) m; each derivative adds the unit 1/m"""
        s = 2 * (np.asarray(x, float) - self.start) / self.length - 1
        if self.turns:
            turn = 0.5 * np.pi * self.number
            return self._wavenumber**slope * np.cos(turn * (1 + s - 2) + slope * np.pi / 2)
        return self._wavenumber**slope * bent(self.number, s, slope)

    def displacement(self, points):
        """Displacement per m or rad of the amplitude at points (…, 3), m; shape (…, 3)"""
        x, y, z = np.moveaxis(np.asarray(points, float), -1, 0)
        w, arm, none = self.along(x), z - self.height, np.zeros_like(x)
        if self.turns:
            parts = none, -arm * w, y * w
        elif self.kind == "vertical bending":
            parts = -arm * self.along(x, 1), none, w
        else:
            parts = -y * self.along(x, 1), w, none
        return np.stack(parts, axis=-1)

    def turn(self, x):
        """Rotation ω of the sections at x (…,), m; shape (…, 3)"""
        slope, none = self.along(x, 0 if self.turns else 1), np.zeros_like(x)
        return np.stack({"torsion": (slope, none, none), BENDING[0]: (none, -slope, none)}.get(
            self.kind, (none, none, slope)), axis=-1)  # fmt: skip

    def loads(self, x):
        """Loads per unit amplitude at x (…,) m: bending moment EI w″, N m, and shear force EI w‴, N, or in torsion
        only the
            moment GJ θ′"""
        if self.turns:
            return (self.rigidity * self.along(x, 1),)
        return self.rigidity * self.along(x, 2), self.rigidity * self.along(x, 3)

    @property
    def _wavenumber(self):
        return np.pi * self.number / self.length if self.turns else 2 * half_turns(self.number) / self.length


def second(beams, points):
    """Second-order displacements u_ij, m, of n shapes of a beam at points (q, 3), m; shape (n, n, q, 3)"""
    points = np.asarray(points, float)
    first = beams[0]
    arm = points * [0, 1, 1] - [0, 0, first.height]
    turns = np.array([one.turn(points[:, 0]) for one in beams])
    both = np.einsum("iqa,jqa->ijq", turns, turns)
    along = np.einsum("iqa,qa->iq", turns, arm)
    out = 0.5 * (turns[:, None] * along[None, :, :, None] + turns[None] * along[:, None, :, None])
    out -= both[..., None] * arm
    x = np.linspace(first.start, first.end, STEPS)
    slopes = np.array([one.turn(x) * [0, 1, 1] for one in beams])
    rate = np.einsum("ixa,jxa->ijx", slopes, slopes)
    shift = np.concatenate(
        [np.zeros((*rate.shape[:2], 1)), np.cumsum(rate[..., 1:] + rate[..., :-1], axis=-1)], axis=-1
    )
    shift *= 0.5 * (x[1] - x[0])
    for i, j in np.ndindex(shift.shape[:2]):
        out[i, j, :, 0] -= np.interp(points[:, 0], x, shift[i, j] - shift[i, j, STEPS // 2])
    return out


def half_turns(number):
    """μ of a bending shape: roots of tan μ ± tanh μ = 0"""
    from scipy.optimize import brentq  # its import takes 0.6 s, and only scenes with modes need it

    middle = (number / 2 + 0.25) * np.pi  # tanh μ is 1 to rounding except for the first shapes
    sign = 1 if number % 2 else -1
    return brentq(lambda m: np.sin(m) + sign * np.tanh(m) * np.cos(m), middle - 0.3, middle + 0.3, xtol=1e-15)


def bent(number, s, slope=0):
    """w, or its derivative of order `slope` with respect to μs, at s (…,) from −1 to 1"""
    mu, s = half_turns(number), np.asarray(s, float)
    even, shift = number % 2 == 1, slope * np.pi / 2
    wave = np.cos(mu * s + shift) / np.cos(mu) if even else np.sin(mu * s + shift) / np.sin(mu)
    odd = bool(slope % 2) == even  # whether the derivative contains sinh, the odd function, and not cosh
    up, down = np.exp(mu * (s - 1)), np.exp(-mu * (s + 1))
    edge = (up - down if odd else up + down) / (1 + np.exp(-2 * mu) if even else 1 - np.exp(-2 * mu))
    return 0.5 * (wave + edge)
