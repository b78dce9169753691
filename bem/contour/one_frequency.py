"""One frequency of a vertical-sided body by domain decomposition: forces, Haskind's relation, Kochin functions."""

from functools import cached_property

import numpy as np

from ..first_order import FirstOrder
from ..modes import class_of
from ..waves import group_factor
from .matching import loads, solved
from .plan.maps import CLASSES
from .plan.plane_waves import far_field


def combined(weights, maps, rows, single):
    """Σ_c weightsᵢⱼ_c maps_c + rowsᵢⱼ single, (r, n, r, n): the sum over evanescent modes, and one separate mode"""
    r, n = len(weights), maps.shape[1]
    total = (weights.reshape(r * r, -1) @ maps.reshape(len(maps), -1)).reshape(r, r, n, n)
    return (total + np.multiply.outer(rows, single)).transpose(0, 2, 1, 3)


def degrees(body, k):
    """Degrees of the functions on the plan of a `ContourBody`, and degrees of its tables, for waves of k rad/m"""
    plan, tolerance = body.plan, body.tolerance
    # waves that have decayed at the depth of the keel need no resolution in the gap
    waves = min(k, -np.log(tolerance) / body.draft)
    return tuple(plan.degree(one, tolerance) for one in (waves, plan.table_wavenumber(waves)))


class ContourFrequency:
    """Intermediate quantities of one frequency of a `bem.contour.body.ContourBody`."""

    def __init__(self, body, omega, headings, theta, dofs, density, gravity):
        self.body, self.omega, self.density, self.gravity = body, float(omega), density, gravity
        self.headings, self.theta = (np.atleast_1d(np.asarray(a, float)) for a in (headings, theta))
        self.dofs = sorted(dofs)
        self.modes = body.profiles.gap.outer_modes(self.omega, body.mode_count(omega**2 / gravity), gravity)
        self.k = self.modes.k
        self.flows = {}  # {class solved: (dofs, `WaveMap`, side velocities of the motions, `GapVelocity`)}
        self.degree, self.top, self.contour = self.resolution()

    def resolution(self):
        """Degrees of the functions on the plan and of the tables, and a `Contour` that resolves them and the waves"""
        degree, top = degrees(self.body, self.k)
        return degree, top, self.body.plan.contour(self.k, degree, self.body.tolerance)

    @property
    def classes(self):
        """Symmetry classes to solve: the classes of the dofs, or, if the far field is wanted, all classes of an
        incident wave."""
        own = {class_of(d, "xy") for d in self.dofs}
        return [c for c in CLASSES if c in own or (len(self.theta) and len(self.headings))]

    @property
    def amplitude(self):
        """Potential −ig/ω of a wave of unit amplitude at z = 0, m²/s per m"""
        return -1j * self.gravity / self.omega

    @cached_property
    def wave_rows(self):
        """⟨·, Z₀⟩ of the profiles and of 1 and z on the side, (r,)"""
        return self.body.profiles.combinations @ self.modes.wave_rows

    @cached_property
    def outer_weights(self):
        m = self.modes
        return self.body.contracted(self.top, m.rows, m.wavenumbers, m.norms, self.body.profiles.gap.outer_decays)

    def outside(self, cls, wave):
        """Matrix `outside` of `bem.contour.matching.solved`; shape (r n, r n)"""
        rows = np.multiply.outer(self.wave_rows, self.wave_rows) / self.modes.wave_norm
        maps = self.body.outer_maps(cls, self.degree, self.top)
        return combined(self.outer_weights, maps, rows, wave.weak).reshape(len(rows) * maps.shape[1], -1)

    def result(self):
        """`FirstOrder`"""
        m = len(self.headings)
        radiation = np.zeros((6, 6), complex)
        excitation, haskind = np.zeros((2, m, 6), complex)
        kochin, residual = np.zeros((2, 6 + m, len(self.theta)), complex), 0.0
        waves = self.body.plan.waves(self.classes, self.degree, self.k, self.contour, self.headings)
        for cls in self.classes:
            own = [d for d in self.dofs if class_of(d, "xy") == cls]
            push, radiated, far, rest = self.solve(cls, own, waves[cls])
            radiation[np.ix_(own, own)] = -self.density * push[:, : len(own)]
            excitation[:, own] = -1j * self.density * self.omega * push[:, len(own) :].T
            haskind[:, own] = -1j * self.density * self.omega * radiated.T
            kochin[:, own] = -1j * self.omega * far[:, : len(own)]
            kochin[:, 6:] += far[:, len(own) :]
            residual = max(residual, rest)
        if not residual < 1e-6:  # NaN too
            raise FloatingPointError(
                f"ω = {self.omega:.6g} rad/s: the equations of the gap leave a residual of {residual:.1e}"
            )
        known = self.body.froude_krylov(self.omega, self.headings, self.dofs, self.density, self.gravity)
        return FirstOrder(radiation, known, excitation - known, haskind, kochin[:, :6], kochin[:, 6:], residual)

    def solve(self, cls, dofs, wave):
        """Solve one symmetry class.

        returns : ∬ φ n dS of motions and waves, (dofs, dofs + m); ∬ φ n dS of the waves from the flow of the motions,
            (dofs, m); far field, (2, dofs + m, t); residual of the equations
        """
        rows, moving = self.wave_rows, len(dofs)
        wall = self.amplitude * wave.projected
        incident = np.multiply.outer(rows, wall).reshape(len(rows) * len(wall), wall.shape[1])
        fixed_terms, outside = self.body.fixed_terms(cls, self.degree, self.top, tuple(dofs)), self.outside(cls, wave)
        flow = solved(fixed_terms, outside, incident)
        side = fixed_terms.side.reshape(moving, 2, -1)
        self.flows[cls] = dofs, wave, side, flow
        velocity = np.tensordot(rows[:-2], flow.velocity, 1)  # ⟨u + v, Z₀⟩, (n, columns)
        velocity[:, :moving] += (rows[-2:] @ side).T
        far = self.far_field(cls, wave, velocity / self.modes.wave_norm, moving)
        return loads(fixed_terms, outside, flow, incident), velocity[:, :moving].T @ wall, far, flow.residual

    def far_field(self, cls, wave, velocity, moving):
        """Kochin functions, shape (2, columns, t): first per unit velocity of a motion, then per unit amplitude of the
        waves

        velocity : velocity of the propagating mode on the contour, (n, columns)
        """
        if not len(self.theta):
            return np.zeros((2, velocity.shape[1], 0))
        potential = wave.potential @ velocity
        potential[:, moving:] += self.amplitude * wave.wall
        n = group_factor(self.k, self.body.depth)
        factor = -(self.k**2) / (4 * n * self.omega) * self.modes.wave_norm
        return factor * far_field(cls, self.contour, self.k, self.theta, potential, wave.basis @ velocity)
