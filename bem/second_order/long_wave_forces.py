"""Force of a long wave whose wavenumber is not that of a free wave of its frequency: incident and diffracted part.

For a wave of unit amplitude, φ = −(ig/Ω) Z_κ(z) exp(iκ·x), Z_κ = cosh κ(z+h)/cosh κh (`bound_waves`),

    D = −iρΩ ∬ (φ n − ψ ∂φ/∂n) dS,

with ψ the radiation potential of unit velocity at Ω (Haskind 1957), because the diffracted wave is a free wave.  For
κ = k(Ω) the force D is the excitation force; as Ω → 0 at constant κ it is finite.  The lid against irregular
frequencies is omitted, because irregular frequencies belong to waves as short as the body.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .. import DOFS
from ..kernels.progress import LONG, report_progress
from ..panels.one_frequency import PanelRun
from ..time_domain.kept_fits import kept_array
from ..waves import depth_factor, depth_factor_slope

LOWEST = 1e-3  # lowest frequency over √(g/h), in deep water over √(g/draft); below it D is constant


def kept_forces(problem, omega, number):
    """Forces D of waves of frequencies (f,), rad/s, with wavenumbers (f, w, 2), rad/m; shape (f, w, 6), complex

    The potentials ψ depend on the frequencies alone. Seas of all heights, periods and directions need these potentials,
    which are therefore kept from one run to the next.
    problem : `bem.methods.panel_problem.PanelProblem` of a rigid body
    """
    body, mesh = LongWaveBody(problem), problem.mesh
    of = mesh.points, mesh.corners, mesh.symmetry, () if mesh.body is None else mesh.body, problem.transform
    water = problem.depth, problem.density, problem.gravity
    way = problem.nodes_per_panel, np.nan if problem.wall is None else problem.wall, problem.zero_draft

    def computed():
        out = []
        for place, one in enumerate(omega):
            report_progress(LONG, (body.prepared, float(one), place, len(omega)))
            out.append(np.concatenate([psi.ravel() for psi in body.run(one).potentials.values()]))
        return np.array(out)

    kept = kept_array(__file__, computed, *of, water, way, omega)
    return np.array([body.forces(*one) for one in zip(omega, number, kept, strict=True)])


@dataclass(frozen=True, eq=False)
class LongWaveBody:
    """A body with panels, whose runs `long_wave_forces` needs; problem : `bem.methods.panel_problem.PanelProblem`"""

    problem: object

    @cached_property
    def prepared(self):
        """The problem without lid, coarse mesh and band"""
        return replace(self.problem, lid=None, coarse=None, finer=None, band=None).prepared()

    def run(self, omega):
        """`PanelRun` of all motions at a frequency, by compressed equations if they take less memory and time"""
        kind = PanelRun
        if self.prepared.compressed and not self.prepared.axisymmetric_geometry.sectors:
            from ..panels.compressed.one_frequency import CompressedRun as kind
        return kind(self.prepared, max(omega, lowest(self.problem)), [0.0], {"added_mass"}, None, DOFS)

    def forces(self, omega, number, kept=None):
        """Diffraction forces D of waves of one frequency and several wavenumbers, about the rotation centre, N/m, N
        m/m; shape (w, 6), complex.

        omega : rad/s, positive or zero; number : wavenumbers along x and y, rad/m, (w, 2)
        kept : potentials of the run at this frequency, one after the other
        """
        run = self.run(omega)
        if kept is not None:
            counts = [len(moving) for moving, _ in run.columns.values()]
            parts = np.split(kept.reshape(sum(counts), -1), np.cumsum(counts)[:-1])
            run.potentials = dict(zip(run.columns, parts, strict=True))
        number = np.atleast_2d(np.asarray(number, float))
        return long_wave_forces(run, number) @ self.problem.transform.T


def lowest(problem):
    """Lowest frequency at which a body is solved, rad/s; below this frequency the result is constant"""
    scale = problem.depth if np.isfinite(problem.depth) else problem.mesh.draft
    return LOWEST * np.sqrt(problem.gravity / scale)


def long_wave_forces(run, number):
    """Diffraction forces D about the origin, for wavenumbers (w, 2), rad/m, at the frequency of a `PanelRun`; shape
    (w, 6)

    For N bodies the shape is (w, 6N), with forces on the bodies whose motions the run has solved.
    """
    g, problem = run.geometry, run.problem
    nodes, weights, normals = run.hull
    size = np.hypot(*number.T)
    Z, slope = (f(nodes[:, 2], size[:, None], problem.depth) for f in (depth_factor, depth_factor_slope))
    out = np.zeros((len(number), run.count), complex)
    modes = run.prepared.modes
    for image, (sx, sy) in enumerate(g.images):
        phase = np.exp(1j * (number[:, :1] * sx * nodes[:, 0] + number[:, 1:] * sy * nodes[:, 1]))
        along = number[:, :1] * sx * normals[:, 0] + number[:, 1:] * sy * normals[:, 1]
        pressure, velocity = Z * phase, (1j * along * Z + slope * normals[:, 2]) * phase
        for cls, (moving, _) in run.columns.items():
            sign = g.signs(cls)[image]
            out[:, moving] -= sign * (pressure * weights) @ modes[:, moving]
            out[:, moving] += sign * (velocity * weights) @ run.potentials[cls][: len(moving)].T
    return problem.density * problem.gravity * out
