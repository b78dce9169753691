"""One plane problem outside several plans: potentials on the contours from velocities on the contours and plane
waves.

    (½ − D_aa) φ_a − Σ D_ab φ_b = −Σ S_ab v_b + φ_I        on contour a, b ≠ a in the first sum
    Σ D_b φ_b − S_b v_b + φ_I = 0                            waves, at points inside (Schenck 1968, `plan.rectangle`)

Each plan has nodes on its quarter contour, in its own axes, and densities of four symmetry classes at these nodes.
All classes of all plans are coupled. Evanescent waves hardly reach the next plan: beyond `REACH` their coupling is
set to zero.
"""

from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..plan.maps import CLASSES
from ..plan.plane_waves import IMAGES, plane_wave_values
from .senders import Kernel

REACH = 36.0  # κ times a gap; e^(−36) = 2e-16
SIGNS = np.array([[(c[0] if x < 0 else 1) * (c[1] if y < 0 else 1) for x, y in IMAGES] for c in CLASSES], float)


class Place(NamedTuple):
    """The middle of a plan, x, y, m; heading : angle of the axes of the plan, rad"""

    x: float
    y: float
    heading: float

    def in_scene(self, points):
        """Points of the contour in the scene, complex, m; shape (p,)"""
        return self.x + 1j * self.y + points * np.exp(1j * self.heading)

    def own(self, points):
        """Points of the contour in the axes of the body, complex, m; shape (p,)"""
        return (points - self.x - 1j * self.y) * np.exp(-1j * self.heading)


class Exterior:
    """senders : an object of `senders` for each plan; places : `Place` of each plan"""

    def __init__(self, senders, places):
        self.senders, self.places = senders, places
        ends = np.cumsum([0] + [4 * len(one.contour.x) for one in senders])
        self.own = [slice(*pair) for pair in pairwise(ends)]
        self.size = int(ends[-1])

    @cached_property
    def _paths(self):
        return self._from_all("contour")

    @cached_property
    def _into(self):
        return self._from_all("inside")

    def _from_all(self, where):
        """{(a, b): S and D at points of plan a of densities on plan b}, b ≠ a but for points inside"""
        out = {}
        for a, (one, place) in enumerate(zip(self.senders, self.places, strict=True)):
            at = getattr(one, where)
            points = place.in_scene((IMAGES[:, :1] * at.x + 1j * IMAGES[:, 1:] * at.y).ravel())
            for b, (other, there) in enumerate(zip(self.senders, self.places, strict=True)):
                if a != b or where == "inside":
                    seen = there.own(points)
                    out[a, b] = other.at(seen.real, seen.imag)
        return out

    def _equations(self, kernel):
        """½ − D and S of all, two (size, size)"""
        kind = complex if kernel.kind == "radiating" else float
        left, single = np.zeros((2, self.size, self.size), kind)
        for a, (one, own) in enumerate(zip(self.senders, self.own, strict=True)):
            parts = list(one.own(kernel).values())
            m = len(parts[0][0])
            for c, (half, S) in enumerate(parts):
                at = slice(own.start + c * m, own.start + (c + 1) * m)
                left[at, at], single[at, at] = half, S
            for b, other in enumerate(self.own):
                if b != a:
                    S, D = _folded(self._paths[a, b](kernel))
                    left[own, other], single[own, other] = -D, S
        return left, single

    def _inside(self, kernel):
        """−D and S at the points inside, two (points, size)"""
        rows = []
        for a in range(len(self.senders)):
            S, D = zip(*(_folded(self._into[a, b](kernel)) for b in range(len(self.senders))), strict=True)
            rows.append((-np.hstack(D), np.hstack(S)))
        return tuple(np.vstack(part) for part in zip(*rows, strict=True))

    @cached_property
    def basis(self):
        """Functions ψ of all plans, plan by plan and class by class; shape (size, n)"""
        from scipy.linalg import block_diag

        return block_diag(*(one.bases[cls] for one in self.senders for cls in CLASSES))

    @cached_property
    def weak(self):
        """Weights of ∮ ψ · ds at the nodes; shape (n, size)"""
        weights = np.concatenate([np.tile(one.contour.weights, 4) for one in self.senders])
        return 4 * (self.basis * weights[:, None]).T

    def map(self, kernel):
        """∮ ψᵢ N ψⱼ ds of evanescent waves; shape (n, n)"""
        left, single = self._equations(kernel)
        return -self.weak @ np.linalg.solve(left, single @ self.basis)

    def waves(self, k, beta):
        """N ψ, (size, n), and the waves towards beta (b,) rad in front of rigid walls, (size, b), at the nodes"""
        kernel = Kernel("radiating", k)
        left, single = self._equations(kernel)
        left_in, single_in = self._inside(kernel)
        right = np.hstack([-np.vstack([single, single_in]) @ self.basis, self.incident(k, beta)])
        matrix = np.vstack([left, left_in])
        found = np.linalg.solve(matrix.conj().T @ matrix, matrix.conj().T @ right)
        return np.split(found, [self.basis.shape[1]], axis=1)

    def incident(self, k, beta):
        """exp(ik·x) at the nodes of all plans, then at the points inside; shape (·, b)"""
        rows = []
        for where in ("contour", "inside"):
            for one, place in zip(self.senders, self.places, strict=True):
                phase = np.exp(1j * k * (place.x * np.cos(beta) + place.y * np.sin(beta)))
                at = getattr(one, where)
                rows += [phase * plane_wave_values(cls, at, k, beta - place.heading) for cls in CLASSES]
        return np.vstack(rows)


def _folded(parts):
    """S and D at the images of m points, {class of the densities: two (4m, ·)}, by class of the potential: (4m, ·)"""
    out = []
    for values in zip(*parts.values(), strict=True):
        whole = np.hstack(values)
        images = whole.reshape(4, -1, whole.shape[1])
        out.append(np.tensordot(SIGNS / 4, images, 1).reshape(whole.shape))
    return out
