"""One frequency of a vertical-sided body by domain decomposition: forces, Haskind, Kochin functions."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from .contour_system import solved
from .contour_waves import far_field, froude_krylov
from .first_order import FirstOrder
from .modes import class_of
from .plan import CLASSES
from .waves import depth_factor, group_factor


def combined(weights, maps, rows, single):
    """Σ_c weightsᵢⱼ_c maps_c + rowsᵢⱼ single, (r, n, r, n): the mode sum and one mode that stands alone."""
    r, n = len(weights), maps.shape[1]
    total = (weights.reshape(r * r, -1) @ maps.reshape(len(maps), -1)).reshape(r, r, n, n)
    return (total + np.multiply.outer(rows, single)).transpose(0, 2, 1, 3)


class ContourFrequency:
    """Intermediate quantities of one frequency of a `bem.contour.ContourBody`."""

    def __init__(self, body, omega, headings, theta, dofs, density, gravity):
        self.body, self.omega, self.density, self.gravity = body, float(omega), density, gravity
        self.headings, self.theta = (np.atleast_1d(np.asarray(a, float)) for a in (headings, theta))
        self.dofs = sorted(dofs)
        gap = body.profiles.gap
        count = gap.mode_count(omega**2 / gravity, body.accuracy.modes, body.plan.scale)
        self.modes = gap.outer_modes(self.omega, count, gravity)
        self.k = self.modes.k
        self.flows = {}  # of the classes that are solved: their dofs, `WaveMap`, motions and `Flow`
        self.degree, self.contour = self.resolution()

    def resolution(self):
        """Degree of the functions on the plan, and a `Contour` that resolves them and the waves"""
        plan, tolerance = self.body.plan, self.body.tolerance
        # waves that die before they reach the keel need no resolution in the gap
        degree = plan.degree(min(self.k, -np.log(tolerance) / self.body.draft), tolerance)
        return degree, plan.contour(self.k, degree, tolerance)

    @property
    def classes(self):
        """Symmetry classes to solve: those of the dofs, and with a far field all that a wave has."""
        mine = {class_of(d, "xy") for d in self.dofs}
        return [c for c in CLASSES if c in mine or (len(self.theta) and len(self.headings))]

    @property
    def amplitude(self):
        """Potential of a wave of unit height of crest, m²/s per m"""
        return -1j * self.gravity / self.omega

    @cached_property
    def wave_rows(self):
        """⟨·, Z₀⟩ of the profiles and of 1 and z on the side, (r,)"""
        return self.body.profiles.combinations @ self.modes.wave_rows

    @cached_property
    def outer_weights(self):
        m = self.modes
        return self.body.collapsed(self.degree, m.rows, m.wavenumbers, m.norms, self.body.profiles.gap.outer_decays)

    def system(self, cls, wave):
        rows = np.multiply.outer(self.wave_rows, self.wave_rows) / self.modes.wave_norm
        outside = combined(self.outer_weights, self.body.maps(self.degree)[cls][0], rows, wave.weak)
        return self.body.system(cls, self.degree, outside)

    def result(self):
        """`FirstOrder`"""
        m = len(self.headings)
        radiation = np.zeros((6, 6), complex)
        excitation, haskind = np.zeros((2, m, 6), complex)
        kochin, residual = np.zeros((2, 6 + m, len(self.theta)), complex), 0.0
        waves = self.waves()
        for cls in self.classes:
            mine = [d for d in self.dofs if class_of(d, "xy") == cls]
            loads, radiated, far, rest = self.solve(cls, mine, waves[cls])
            radiation[np.ix_(mine, mine)] = -self.density * loads[:, : len(mine)]
            excitation[:, mine] = -1j * self.density * self.omega * loads[:, len(mine) :].T
            haskind[:, mine] = -1j * self.density * self.omega * radiated.T
            kochin[:, mine] = -1j * self.omega * far[:, : len(mine)]
            kochin[:, 6:] += far[:, len(mine) :]
            residual = max(residual, rest)
        if not residual < 1e-6:  # NaN too
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the equations of the gap left {residual:.1e}")
        known = self.froude_krylov()
        return FirstOrder(radiation, known, excitation - known, haskind, kochin[:, :6], kochin[:, 6:], residual)

    def waves(self):
        """{class: `WaveMap`}"""
        return self.body.plan.waves(self.classes, self.degree, self.k, self.contour, self.headings)

    def wall(self, cls, wave):
        """(n, m) the waves in front of a rigid wall, tested with the functions of the plan"""
        basis = self.body.plan.basis(cls, self.degree, self.contour)
        return 4 * (basis * self.contour.weights[:, None]).T @ wave.wall

    def solve(self, cls, dofs, wave):
        """One symmetry class.

        returns : ∬ φ n dS of motions and waves (dofs, dofs + m), the same of the waves from the motions' flow
            (dofs, m), far field (2, dofs + m, t), residual of the equations
        """
        body, rows, moving = self.body, self.wave_rows, len(dofs)
        wall = self.amplitude * self.wall(cls, wave)
        drive = np.multiply.outer(rows, wall)
        system = self.system(cls, wave)
        motions = [body.motion(d, self.degree) for d in dofs]
        flow = solved(system, motions, drive[:-2])
        self.flows[cls] = dofs, wave, motions, flow
        loads = body.loads(system, flow, self.degree, dofs, drive[-2:])
        velocity = np.tensordot(rows[:-2], flow.velocity, 1)  # ⟨u + v, Z₀⟩, (n, columns)
        for j, m in enumerate(motions):
            velocity[:, j] += rows[-2:] @ m.side
        far = self.far_field(cls, wave, velocity / self.modes.wave_norm, moving)
        return loads, velocity[:, :moving].T @ wall, far, flow.residual

    def far_field(self, cls, wave, velocity, moving):
        """Kochin functions per unit velocity of a motion, then per unit amplitude of the waves, (2, columns, t)

        velocity : (n, columns) of the propagating mode on the contour
        """
        basis = self.body.plan.basis(cls, self.degree, self.contour)
        potential = wave.potential @ velocity
        potential[:, moving:] += self.amplitude * wave.wall
        n = group_factor(self.k, self.body.depth)
        factor = -(self.k**2) / (4 * n * self.omega) * self.modes.wave_norm
        return factor * far_field(cls, self.contour, self.k, self.theta, potential, basis @ velocity)

    def froude_krylov(self):
        """(m, 6), zero where a degree of freedom is not asked for"""
        keel = float(depth_factor(-self.body.draft, self.k, self.body.depth))
        force = froude_krylov(self.contour, self.k, self.headings, self.modes.wave_rows[-2:], keel)
        return self.density * self.gravity * np.where(np.isin(np.arange(6), self.dofs), force, 0)
