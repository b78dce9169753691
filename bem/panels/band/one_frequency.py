"""The panel method at one frequency of a band, by the reduced equations of `bem.panels.band.equations`."""

import time
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...algebra.real_times_complex import complex_times_real, real_times_complex
from ...green.tables import wave_table
from ...kernels.threads import blas_threads
from ..compressed.one_frequency import CompressedRun
from ..one_frequency import PanelRun
from .low_rank_waves import FEW_NODES, wave_operator

# allowed error at a node of mean size, over the accuracy of the basis: that of a row in the L² norm of
# `bem.panels.band.low_rank_waves`
ALLOWED = FEW_NODES**0.5
LARGEST_FULL_SYSTEM = 8000  # nodes of the hull: a gigabyte for each symmetry class


class BandRun(CompressedRun):
    """A `PanelRun` whose cost is nearly independent of the number of panels.

    Forces follow from integrals stored in `bem.panels.band.equations`; potentials are computed on demand.  If the error
    test fails, the full equations are solved, as in `PanelRun`.
    """

    @cached_property
    def equations_of_band(self):
        """`bem.panels.band.equations.BandEquations` of this frequency's part of the band"""
        return next(part for part in self.prepared.band_equations if part.geometry is self.geometry)

    @cached_property
    def wanted(self):
        """Indices of the wanted classes among the geometry's classes, in the order of `columns`"""
        wanted = [i for i, cls in enumerate(self.geometry.classes) if cls in self.columns]
        return slice(None) if len(wanted) == len(self.geometry.classes) else wanted

    @cached_property
    def solution(self):
        """`ReducedSolution` of the wanted classes; None if the low-rank basis is not accurate enough

        raises : FloatingPointError if the solution is not finite, or if the full equations would be too large
        """
        start = time.perf_counter()
        _ = self.columns
        self._timed("incident", start)
        start = time.perf_counter()
        equations, g = self.equations_of_band, self.geometry
        self._timed("reduction", start)
        start = time.perf_counter()
        table = wave_table(self.omega, self.problem.depth, self.problem.gravity, g.reach, g.draft)
        self._timed("table", start)
        start = time.perf_counter()
        basis, error_test = equations.low_rank, equations.low_rank.error_test
        hull = int(np.count_nonzero(basis.sources < g.hull))
        S, D = equations.pairs.blocks(table, self.depth_values, self.wanted)
        to_test_points = equations.test_pairs.blocks(table, self.depth_values, self.wanted)
        self._timed("assemble", start)
        start = time.perf_counter()
        with blas_threads(max(len(basis.points), equations.on_lid.shape[1])):
            low_rank = wave_operator(S, D, hull, table.K), S[..., :hull]
            solution = self.checked(lambda: solved(equations, self.wanted, *low_rank, table.K, self.velocity))
            e = error_test.samples.hull
            exact = wave_operator(*to_test_points, e, table.K), to_test_points[0][..., :e]
            potentials = self.potentials_at_samples(solution)
            wave_error = error_test.wave_error(exact, low_rank, potentials, self.velocity, self.wanted)
            error = np.maximum(wave_error, error_test.flux_error(*self.flux))
        self._timed("solve", start)
        return solution if error < ALLOWED * equations.accuracy else self.rejected(error)  # a NaN is rejected too

    def checked(self, solve):
        """The result of `solve`, a `ReducedSolution`.  Raises FloatingPointError if the result is not finite"""
        try:
            solution = solve()
        except np.linalg.LinAlgError as error:
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: {error}") from error
        if not all(np.all(np.isfinite(part)) for part in solution):
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the solution is not finite")
        return solution

    def rejected(self, error):
        """None: the full equations are solved instead, or the compressed equations if the full equations are too large.

        raises : FloatingPointError if neither the full nor the compressed equations can be solved
        """
        if self.geometry.hull > LARGEST_FULL_SYSTEM and self.problem.nodes_per_panel != 4:
            raise FloatingPointError(
                f"ω = {self.omega:.6g} rad/s: the low-rank approximation of the band's waves has an error of "
                f"{error:.1e}; allowed: {ALLOWED * self.equations_of_band.accuracy:.1e}; give a narrower band, "
                "fewer panels or a larger tolerance"
            )

    @property
    def compressed(self):
        """Whether the band is not accurate enough, and the full equations are too large"""
        return self.solution is None and self.geometry.hull > LARGEST_FULL_SYSTEM

    def _solved(self):
        return super()._solved() if self.compressed else PanelRun._solved(self)

    def enlarged(self, radiation, excitation):
        """Errors enlarged by the possible effect of a compression"""
        return super().enlarged(radiation, excitation) if self.compressed else (radiation, excitation)

    @cached_property
    def velocity(self):
        """Coefficients v of the wanted motions and waves; shape (c, v, columns); a class with fewer than v
        coefficients has zeros"""
        v, nodes = self.equations_of_band.integrals.shape[1], self.equations_of_band.low_rank.flux_nodes
        flux, done = self.flux[1], 0
        out = np.zeros((len(self.columns), v, max(len(m) + len(w) for m, w in self.columns.values())), complex)
        for coefficients, (cls, (moving, waves)) in zip(out, self.columns.items(), strict=True):
            members, count = self.geometry.members(cls), len(moving)
            coefficients[[members.index(dof) for dof in moving], range(count)] = 1.0
            own, done = flux[done : done + len(waves)], done + len(waves)
            coefficients[v - len(nodes) :, count : count + len(waves)] = -own.T
        return out

    @cached_property
    def flux(self):
        """∂φ_I/∂n of all waves of all classes at the samples on the hull and at the flux nodes, two arrays (m, …)"""
        basis = self.equations_of_band.low_rank
        samples = basis.error_test.samples.on_hull
        nodes = np.concatenate([samples, basis.flux_nodes])
        parts = [self.incident[0][cls][1][waves][:, nodes] for cls, (_, waves) in self.columns.items()]
        return np.split(np.concatenate(parts), [len(samples)], axis=1)

    def potentials_at_samples(self, solution):
        """Potentials φ at the samples, and φ' of the lid; shape (c, s, columns)"""
        equations = self.equations_of_band
        lid = equations.low_rank.error_test.samples.on_lid - self.geometry.hull
        on_hull = real_times_complex(equations.potentials_at_samples[self.wanted], solution.coefficients)
        return np.concatenate([on_hull, solution.lid[:, lid]], axis=1)

    @cached_property
    def residual(self):
        """Largest residual of the linear equations, relative to the right-hand sides"""
        return super().residual if self.solution is None else self.solution.residual

    @cached_property
    def potentials(self):
        """{class: potentials (columns, n) on the hull}"""
        if self.solution is None:
            return super().potentials
        start, out = time.perf_counter(), {}
        with blas_threads(len(self.equations_of_band.low_rank.points)):
            for i, (cls, columns) in enumerate(self.columns.items()):
                unit_potentials = self.equations_of_band.unit_potentials[self.geometry.classes.index(cls)]
                coefficients = self.solution.coefficients[i, :, : sum(map(len, columns))]
                out[cls] = self.on_hull(real_times_complex(unit_potentials, coefficients), None)
        self._timed("potentials", start)
        return out

    @cached_property
    def integrals(self):
        """{class: ∬ φ V dS (columns, v) over the whole hull}, where V are the motions of the class and the basis of
        incident waves"""
        found = zip(self.columns.items(), self.solution.integrals, strict=True)
        return {cls: values[:, : sum(map(len, columns))].T for (cls, columns), values in found}

    @cached_property
    def pressure_integrals(self):
        """{class: ∬ φ nⱼ dS (columns, its degrees of freedom)} over the whole hull"""
        if self.solution is None:
            return super().pressure_integrals
        return {cls: both[:, : len(self.geometry.members(cls))] for cls, both in self.integrals.items()}

    @cached_property
    def haskind_integrals(self):
        """{class: ∬ φⱼ ∂φ_I/∂n dS (m, its radiating dofs)} over the whole hull

        ∂φ_I/∂n is interpolated between the flux nodes, with the error `ErrorTest.flux_error`.
        """
        if self.solution is None:
            return super().haskind_integrals
        out, nodes = {}, self.equations_of_band.low_rank.flux_nodes
        for cls, both in self.integrals.items():
            radiated = both[: len(self.columns[cls][0]), both.shape[1] - len(nodes) :]
            out[cls] = self.incident[0][cls][1][:, nodes] @ radiated.T
        return out


class ReducedSolution(NamedTuple):
    """Solution of c symmetry classes, with u = r + v + l unit columns as in
    `bem.panels.band.equations.BandEquations`."""

    coefficients: np.ndarray  # (c, u, columns) m, −v and Kφ' of the lid, of the unit columns
    lid: np.ndarray  # (c, l, columns) φ'
    integrals: np.ndarray  # (c, v, columns) ∬ φ V dS over the whole hull
    residual: float  # the largest, of the reduced equations


def solved(equations, classes, W, S, K, velocity):
    """`ReducedSolution` of the symmetry classes `classes`.  Raises LinAlgError if their equations are singular.

    equations : `bem.panels.band.equations.BandEquations`; K : ω²/g, 1/m
    W, S : wave part between the interpolation nodes, (c, r, q) and (c, r, h); velocity : v, (c, v, columns)
    """
    at_sources, on_lid, M = equations.at_sources[classes], equations.on_lid[classes], equations.low_rank.M[classes]
    r, v, lid = W.shape[1], velocity.shape[1], on_lid.shape[1]
    T, lid_solution = on_lid[..., r + v :], on_lid[..., : r + v]
    H = at_sources[..., : r + v]  # α = H (m, −v)
    if lid:  # Kφ' = −lid_solution @ (m, −v)
        lid_solution = np.linalg.solve(T + 4 * np.pi / K * np.eye(lid), lid_solution)
        H = H - (at_sources[..., r + v :] + equations.from_lid / K) @ lid_solution
    # m = W H (m, −v) − S_w M v
    A = np.eye(r) - complex_times_real(W, H[..., :r])
    b = -(W @ real_times_complex(H[..., r:], velocity) + S @ real_times_complex(M, velocity))
    m = np.linalg.solve(A, b)
    residual = np.abs(A @ m - b).max(axis=1) / np.maximum(np.abs(b).max(axis=1), 1e-300)
    known = np.concatenate([m, -velocity], axis=1)
    lid = -real_times_complex(lid_solution, known)
    coefficients = np.concatenate([known, lid], axis=1)
    integrals = real_times_complex(equations.integrals[classes], coefficients)
    return ReducedSolution(coefficients, lid / K, integrals, float(residual.max()))
