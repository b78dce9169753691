"""One frequency of several vertical-sided bodies: the equations of `matching` for all bodies and symmetry classes.

Unknowns are a constant for each body and the velocities in the gaps, body by body: for each body its e profiles times
its n functions.  Results are in coordinates of the scene, with motions about the origin of the scene, body by body.
"""

from functools import cached_property

import numpy as np

from ...first_order import FirstOrder
from ...waves import group_factor
from ..plan.maps import CLASSES
from ..plan.plane_waves import far_field
from .fixed import Fixed


class SeveralFrequency:
    """Intermediate quantities of one frequency of `bodies.SeveralBodies`."""

    def __init__(self, bodies, omega, headings, theta, density, gravity):
        self.bodies, self.omega, self.density, self.gravity = bodies, float(omega), density, gravity
        self.headings, self.theta = (np.atleast_1d(np.asarray(a, float)) for a in (headings, theta))
        self.kinds = bodies.outer_modes(self.omega, gravity)
        self.k = self.kinds[0].k
        self.degrees, self.tops = bodies.degrees(self.k)
        self.exterior = bodies.exterior(self.k, self.degrees)
        self.fixed = Fixed(bodies, self.degrees, self.tops)

    @property
    def amplitude(self):
        """Potential −ig/ω of a wave of unit amplitude at z = 0, m²/s per m"""
        return -1j * self.gravity / self.omega

    @cached_property
    def wave_rows(self):
        """⟨·, Z₀⟩ of the profiles and of 1 and z on the side, [(r,)] of each body"""
        return [body.profiles.combinations @ self.kinds[kind].wave_rows for body, kind in self.bodies.of_kinds]

    @cached_property
    def plane(self):
        """N ψ of the propagating mode, and waves in front of rigid walls, at the nodes, from
        `exterior.Exterior.waves`"""
        return self.exterior.waves(self.k, self.headings)

    @cached_property
    def outside(self):
        """Projections of all potentials on all functions; shape (gaps + sides, gaps + sides)"""
        weights = self.bodies.weights(self.kinds, self.tops)
        single = self.exterior.weak @ self.plane[0] / self.kinds[0].wave_norm
        return self.fixed.outside(weights, self.bodies.outer_maps(self.degrees, self.tops), self.wave_rows, single)

    @cached_property
    def incident(self):
        """Incident waves on the walls, tested with all functions; shape (gaps + sides, b)"""
        wall = self.amplitude * self.exterior.weak @ self.plane[1]
        out = np.empty((self.fixed.size, wall.shape[1]), complex)
        for rows, own, gap, side in zip(self.wave_rows, self.fixed.functions, *self.fixed.layout, strict=True):
            whole = np.multiply.outer(rows, wall[own])
            out[gap] = whole[:-2].reshape(out[gap].shape)
            out[side] = whole[-2:].reshape(out[side].shape)
        return out

    @cached_property
    def flow(self):
        """Velocities in the gaps, (gaps, d + b), constants, (bodies, d + b), and the residual of the equations"""
        return self.fixed.solved(self.outside, self.incident)

    @cached_property
    def on_contours(self):
        """Velocity ⟨u + v, Z₀⟩ of motions and waves on all plans; shape (n, d + b)"""
        velocity, out = self.flow[0], []
        d = self.fixed.side.shape[0]
        for rows, gap, side in zip(self.wave_rows, *self.fixed.layout, strict=True):
            n, first = (side.stop - side.start) // 2, side.start - self.fixed.gaps
            one = np.tensordot(rows[:-2], velocity[gap].reshape(len(rows) - 2, n, velocity.shape[1]), 1)
            own = self.fixed.side[:, first : first + side.stop - side.start].reshape(d, 2, -1)
            one[:, :d] += np.tensordot(rows[-2:], own, (0, 1)).T
            out.append(one)
        return np.vstack(out)

    def result(self):
        """`FirstOrder`"""
        loads = self.fixed.loads(self.outside, *self.flow[:2], self.incident)
        residual, d, T = self.flow[2], self.fixed.side.shape[0], self.bodies.to_scene
        if not residual < 1e-6:  # NaN too
            raise FloatingPointError(
                f"ω = {self.omega:.6g} rad/s: the equations of the gaps leave a residual of {residual:.1e}"
            )
        radiation = -self.density * T @ loads[:, :d] @ T.T
        excitation = -1j * self.density * self.omega * (T @ loads[:, d:]).T
        wall = self.amplitude * self.exterior.weak @ self.plane[1]
        haskind = -1j * self.density * self.omega * (T @ (self.on_contours[:, :d].T @ wall)).T
        known = self.bodies.froude_krylov(self.omega, self.headings, None, self.density, self.gravity)
        far = self.far_field()
        kochin = -1j * self.omega * np.einsum("ij,pjt->pit", T, far[:, :d])
        return FirstOrder(radiation, known, excitation - known, haskind, kochin, far[:, d:], residual)

    def far_field(self):
        """Kochin functions, shape (2, d + b, t): first per unit velocity of a motion, then per unit amplitude of the
        waves"""
        d, k, exterior = self.fixed.side.shape[0], self.k, self.exterior
        total = np.zeros((2, self.on_contours.shape[1], len(self.theta)), complex)
        if not len(self.theta):
            return total
        velocity = self.on_contours / self.kinds[0].wave_norm
        potential, moving = self.plane[0] @ velocity, exterior.basis @ velocity
        potential[:, d:] += self.amplitude * self.plane[1]
        for one, place, own in zip(exterior.senders, exterior.places, exterior.own, strict=True):
            m = len(one.contour.x)
            parts = [slice(own.start + c * m, own.start + (c + 1) * m) for c in range(4)]
            turned = self.theta - place.heading
            H, slope = sum(far_field(cls, one.contour, k, turned, potential[at], moving[at])
                           for cls, at in zip(CLASSES, parts, strict=True))  # fmt: skip
            c, s = np.cos(self.theta), np.sin(self.theta)
            phase = np.exp(-1j * k * (place.x * c + place.y * s))
            total[0] += H * phase
            total[1] += (slope + 1j * k * (place.x * s - place.y * c) * H) * phase
        n = group_factor(k, self.bodies.depth)
        return -(k**2) / (4 * n * self.omega) * self.kinds[0].wave_norm * total
