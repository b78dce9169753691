"""Damping lids: lids on the water between hulls or in a moonpool that absorb the energy which eddies absorb in reality.

With the time factor exp(−iωt) a lid of damping ε has

    g ∂φ/∂z = ω² (1 + iε) φ      on F, with φ the whole potential

(Chen 2004, Newman 2004).  G satisfies the free-surface condition without damping, so that of the integrals over F the
term iεK ∬ G φ dS remains.
With n out of the bodies and ψ = φ + φ_I on F the equations of `bem.panels.influence` become

    hull:        2πφ − Dφ − KSφ′ − iεK S_F ψ = −SV
    damping lid: 4πψ − Dφ − KSφ′ − iεK S_F ψ = −SV + 4πφ_I
    inner lid:   4πφ′ + KSφ′ + Dφ + iεK S_F ψ = SV

φ_I is zero for a body that moves in calm water.  The lid absorbs the mean power ½ρωεK ∬ |ψ|² dS, and radiates like
sources of the strength iεKψ. Haskind's relation and the balance of energy include the absorbed power and the waves
from these sources.
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np

from hakobune.meshing.panels import joined
from hakobune.meshing.surface.patches import patches

from ..algebra.systems import solved_systems
from .incident_waves import class_waves
from .influence import Equations, Geometry, assembled
from .irregular_frequencies import extent
from .one_frequency import PanelRun

ACROSS = 2  # panels across a lid at least
MOST_NODES = 8000  # largest number of nodes of a symmetric part; full complex equations take 1 GB


class DampingLid(NamedTuple):
    """corners : corners of a convex polygon, counter-clockwise, m, (k, 2); damping : ε"""

    corners: np.ndarray
    damping: float


def with_damping_lids(problem):
    """Return, for a `PanelProblem`, the `Geometry` of hull, damping lids and inner lid, the nodes of the damping
    lids, and ε of each of these nodes.

    Raises ValueError for more lid nodes than can be solved.
    """
    mesh, lids = problem.mesh, problem.damping_lids
    narrow = min(_width(one.corners) for one in lids)
    size = min(float(np.sqrt(mesh.areas.mean())), narrow / ACROSS)
    surface, counts = patches([one.corners for one in lids], size, mesh.symmetry)
    both = surface if problem.lid is None else joined([surface, problem.lid])
    geometry = Geometry(mesh, both, problem.depth, problem.nodes_per_panel, modes=problem.modes)
    nodes = len(geometry.elements.nodes)
    if nodes > MOST_NODES:
        raise ValueError(
            f"hull and lids have {nodes} nodes; allowed with damping lids: {MOST_NODES} in a symmetric part; give "
            "fewer panels"
        )
    damping = np.repeat([one.damping for one in lids], counts * problem.nodes_per_panel)
    return geometry, damping


class DampedRun(PanelRun):
    """A `PanelRun` with damping lids on the water"""

    def __init__(self, prepared, omega, *arguments, **more):
        super().__init__(prepared, omega, *arguments, **more)
        self.geometry, self.damping = prepared.with_damping_lids
        hull = self.geometry.hull
        self.on_lids = slice(hull, hull + len(self.damping))

    @property
    def K(self):
        """K = ω²/g, 1/m"""
        return self.omega**2 / self.problem.gravity

    @property
    def reach(self):
        return float(np.hypot(*extent(self.geometry.panels)))

    @cached_property
    def incident_on_lids(self):
        """Incident potential φ_I on the damping lids; shape (m, classes, nodes of damping lids)"""
        g = self.geometry
        waves = [class_waves(g, b, self.omega, self.k, self.problem.gravity, self.on_lids)[0] for b in self.headings]
        return np.array(waves)

    def equations(self, classes, table, velocities):
        lids, g = self.on_lids, self.geometry
        A, U, V, sides = assembled(g, classes, 1.0, table, self.depth_values, velocities)  # all lids as inner lids
        for rows in (A, U, sides):
            rows[:, lids] *= -1
        at = np.arange(lids.start, lids.stop)
        A[:, at, at] += 4 * np.pi
        full = A + 1j * (U @ V.swapaxes(1, 2))
        full[:, :, lids] *= 1j * self.damping
        full[:, at, at] += 4 * np.pi
        for i, cls in enumerate(classes):
            moving, waves = self.columns[cls]
            if waves:
                columns = slice(len(moving), len(moving) + len(waves))
                sides[i, lids, columns] += 4 * np.pi * self.incident_on_lids[waves, g.classes.index(cls)].T
        return Equations(full, U[:, :, :0], V[:, :, :0], sides)

    def solved(self, equations, counts):
        matrices, sides = equations.matrices, [b[:, :n] for b, n in zip(equations.sides, counts, strict=True)]
        found = solved_systems(matrices, sides)
        left = [np.abs(A @ x - b).max(0) / np.abs(b).max(0) for A, x, b in zip(matrices, found, sides, strict=True)]
        return found, float(max(part.max(initial=0.0) for part in left))

    def on_damping_lids(self, cls):
        """ψ on the damping lids, m²/s; shape (columns, nodes of damping lids). For unit motions ψ is φ"""
        _ = self.potentials
        return self.solutions[cls][self.on_lids].T

    @property
    def mean_rise(self):
        """Mean elevation of the water over all damping lids, beside fixed bodies, m per m of wave amplitude; shape
        (m,)"""
        weights = self.geometry.elements.weights[self.on_lids]
        _ = self.potentials
        return 1j * self.omega / self.problem.gravity * self._of_waves[1, 1] @ weights / weights.sum()

    @property
    def senders(self):
        e, n = self.geometry.elements, self.on_lids.stop
        return e.nodes[:n], e.weights[:n], e.normals[:n]

    def sent(self, cls):
        phi, velocity = super().sent(cls)
        psi = self.on_damping_lids(cls)
        sources = -1j * self.damping * self.K * psi
        return np.concatenate([phi, np.zeros_like(psi)], axis=1), np.concatenate([velocity, sources], axis=1)

    @property
    def _share(self):
        """εK of each node times its area and the area of its images, m; shape (nodes of damping lids,)"""
        return self.damping * self.K * self.geometry.elements.weights[self.on_lids] * self.geometry.copies

    @cached_property
    def haskind_integrals(self):
        out = {}
        for cls, integrals in super().haskind_integrals.items():
            waves = self.incident_on_lids[:, self.geometry.classes.index(cls)]
            moving = len(self.columns[cls][0])
            out[cls] = integrals + 1j * (waves * self._share) @ self.on_damping_lids(cls)[:moving].T
        return out

    @property
    def radiated(self):
        """Damping over frequency, B/ω, by the radiated waves and by the lids; shape (6, 6)"""
        far = super().radiated
        return None if far is None else far + self.problem.density * self._taken(self._of_motions, self._of_motions)

    @property
    def taken_at_rest(self):
        """Power that the lids absorb beside fixed bodies, times k/(2ρgC_g); shape (m,)"""
        return self._extinction(np.diag(self._taken(self._of_waves, self._of_waves)))

    def damping_lid_power(self):
        """Mean power that the lids absorb, beside free or fixed bodies, over the squared wave amplitude, W/m²; shape
        (m,)"""
        psi = self._of_waves
        if self.free:
            motion = -1j * self.omega * self.rao @ self.of_motion
            psi = {cls: p + motion @ self._of_motions[cls] for cls, p in psi.items()}
        return 0.5 * self.problem.density * self.omega * np.diag(self._taken(psi, psi))

    @cached_property
    def _of_motions(self):
        """{class: φ (6N, nodes of damping lids) of unit velocities about the origin}"""
        out = {}
        for cls in self.geometry.classes:
            out[cls] = np.zeros((self.count, len(self.damping)), complex)
            moving, _ = self.columns.get(cls, ((), ()))
            if moving:
                out[cls][moving] = self.on_damping_lids(cls)[: len(moving)]
        return out

    @cached_property
    def _of_waves(self):
        """{class: ψ (m, nodes of damping lids) of bodies at rest}"""
        out = {}
        for cls in self.geometry.classes:
            out[cls] = np.zeros((len(self.headings), len(self.damping)), complex)
            moving, waves = self.columns.get(cls, ((), ()))
            if waves:
                out[cls][waves] = self.on_damping_lids(cls)[len(moving) :]
        return out

    def _taken(self, one, other):
        """Re ∬ εK ψ ψ̄ dS of two {class: ψ (r, nodes)}, (r, r)"""
        return sum(((one[cls] * self._share) @ other[cls].conj().T).real for cls in one)

    def _extinction(self, taken):
        """Contribution of `taken` (m,) to the balance (1/2π)∫|H|²dθ + taken = −Re H(β)"""
        celerity = self.omega / self.k
        return 0.5 * self.omega * taken * self.k / (2 * self.problem.gravity * celerity * self.group_factor)


def _width(corners):
    """m, smallest extent of a convex polygon across one of its sides"""
    side = np.roll(corners, -1, axis=0) - corners
    length = np.linalg.norm(side, axis=1)
    across = (corners - corners[:, None]) @ (side[:, ::-1] * (-1, 1) / length[:, None])[:, :, None]
    return float(across[..., 0].max(axis=1).min())
