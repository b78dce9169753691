"""The panel method at one frequency of a band, by the equations of `bem.panels.band.equations`."""

from __future__ import annotations

import time
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...green.tables import wave_table
from ...kernels.real_times_complex import complex_times_real, real_times_complex
from ...kernels.threads import blas_threads
from ..one_frequency import PanelRun
from .low_rank_waves import FEW, acting

# times the accuracy of the space, at a node of mean size: what a row may lose in the L² norm of
# `bem.panels.band.low_rank_waves`
ALLOWED = FEW**0.5
MOST_IN_FULL = 5000  # nodes of the hull


class ReducedRun(PanelRun):
    """As `PanelRun`, at a cost that hardly grows with the number of panels.

    Forces follow from what `bem.panels.band.equations` has integrated; potentials are made when somebody asks for them.
    """

    @cached_property
    def reduced(self):
        """`bem.panels.band.equations.Reduced` of this frequency's part of the band"""
        return next(part for part in self.prepared.reduced if part.geometry is self.geometry)

    @cached_property
    def mine(self):
        """Which of the geometry's classes are wanted, in the order of `columns`"""
        wanted = [i for i, cls in enumerate(self.geometry.classes) if cls in self.columns]
        return slice(None) if len(wanted) == len(self.geometry.classes) else wanted

    @cached_property
    def flow(self):
        """`Flow` of the wanted classes; None where few nodes do not stand for all, and all have to be solved for"""
        start = time.perf_counter()
        _ = self.columns
        self._timed("incident", start)
        start = time.perf_counter()
        reduced, g = self.reduced, self.geometry
        self._timed("reduction", start)
        start = time.perf_counter()
        table = wave_table(self.omega, self.setup.depth, self.setup.gravity, g.reach, g.draft)
        self._timed("table", start)
        start = time.perf_counter()
        space, trial = reduced.space, reduced.space.trial
        hull = int(np.count_nonzero(space.sources < g.hull))
        S, D = reduced.pairs.blocks(table, self.depth_values, self.mine)
        to_points = reduced.trial_pairs.blocks(table, self.depth_values, self.mine)
        self._timed("assemble", start)
        start = time.perf_counter()
        with blas_threads(max(len(space.points), reduced.on_lid.shape[1])):
            held = acting(S, D, hull, table.K), S[..., :hull]
            flow = self.finite(lambda: solved(reduced, self.mine, *held, table.K, self.given))
            e = trial.samples.hull
            here = acting(*to_points, e, table.K), to_points[0][..., :e]
            lost_waves = trial.lost_waves(here, held, self.at_samples(flow), self.given, self.mine)
            lost = np.maximum(lost_waves, trial.lost_flux(*self.flux))
        self._timed("solve", start)
        return flow if lost < ALLOWED * reduced.accuracy else self.in_full(lost)  # of NaN too

    def finite(self, solve):
        """What `solve` gives, a `Flow`.  Raises FloatingPointError if it is not finite"""
        try:
            flow = solve()
        except np.linalg.LinAlgError as error:
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: {error}") from error
        if not all(np.all(np.isfinite(part)) for part in flow):
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the solution is not finite")
        return flow

    def in_full(self, lost):
        """Says that all nodes have to be solved for, if they are not too many"""
        if self.geometry.hull > MOST_IN_FULL:
            raise FloatingPointError(
                f"ω = {self.omega:.6g} rad/s: {lost:.1e} of the waves is lost between few nodes; allowed: "
                f"{ALLOWED * self.reduced.accuracy:.1e}; ask for a narrower band or fewer panels"
            )

    @cached_property
    def given(self):
        """(c, v, columns) shares v of the wanted motions and waves; zeros where a class has fewer than others"""
        v, crests = self.reduced.integrals.shape[1], self.reduced.space.crests
        flux, done = self.flux[1], 0
        out = np.zeros((len(self.columns), v, max(len(m) + len(w) for m, w in self.columns.values())), complex)
        for shares, (cls, (moving, waves)) in zip(out, self.columns.items(), strict=True):
            members, count = self.geometry.members(cls), len(moving)
            shares[[members.index(dof) for dof in moving], range(count)] = 1.0
            mine, done = flux[done : done + len(waves)], done + len(waves)
            shares[v - len(crests) :, count : count + len(waves)] = -mine.T
        return out

    @cached_property
    def flux(self):
        """∂φ_I/∂n of all waves of all classes (k, …) at the samples on the hull and at the crests"""
        samples, crests = self.reduced.space.trial.samples.on_hull, self.reduced.space.crests
        nodes = np.concatenate([samples, crests])
        parts = [self.incident[0][cls][1][waves][:, nodes] for cls, (_, waves) in self.columns.items()]
        return np.split(np.concatenate(parts), [len(samples)], axis=1)

    def at_samples(self, flow):
        """(c, s, columns) φ, and φ' of the lid"""
        lid = self.reduced.space.trial.samples.on_lid - self.geometry.hull
        return np.concatenate(
            [real_times_complex(self.reduced.at_samples[self.mine], flow.shares), flow.lid[:, lid]], axis=1
        )

    @cached_property
    def residual(self):
        """Largest residual of the linear equations, relative to the right-hand sides"""
        return super().residual if self.flow is None else self.flow.residual

    @cached_property
    def potentials(self):
        """{class: potentials (columns, n) on the hull}"""
        if self.flow is None:
            return super().potentials
        start, out = time.perf_counter(), {}
        with blas_threads(len(self.reduced.space.points)):
            for i, (cls, columns) in enumerate(self.columns.items()):
                response = self.reduced.response[self.geometry.classes.index(cls)]
                out[cls] = self.on_hull(
                    real_times_complex(response, self.flow.shares[i, :, : sum(map(len, columns))]), None
                )
        self._timed("potentials", start)
        return out

    @cached_property
    def integrals(self):
        """{class: ∬ φ V dS (columns, v) over the whole hull}, V its motions and what spans waves"""
        found = zip(self.columns.items(), self.flow.integrals, strict=True)
        return {cls: values[:, : sum(map(len, columns))].T for (cls, columns), values in found}

    @cached_property
    def pushing(self):
        """{class: ∬ φ nⱼ dS (columns, its degrees of freedom)} over the whole hull"""
        if self.flow is None:
            return super().pushing
        return {cls: both[:, : len(self.geometry.members(cls))] for cls, both in self.integrals.items()}

    @cached_property
    def meeting_waves(self):
        """{class: ∬ φⱼ ∂φ_I/∂n dS (m, its radiating dofs)} over the whole hull

        With the flux as the crests span it, in the diffracted waves too: `lost_flux` has tested it.
        """
        if self.flow is None:
            return super().meeting_waves
        out, crests = {}, self.reduced.space.crests
        for cls, both in self.integrals.items():
            radiated = both[: len(self.columns[cls][0]), both.shape[1] - len(crests) :]
            out[cls] = self.incident[0][cls][1][:, crests] @ radiated.T
        return out


class Flow(NamedTuple):
    """c symmetry classes; u = r + v + l as of `bem.panels.band.equations.Reduced`."""

    shares: np.ndarray  # (c, u, columns) m, −v and Kφ' of the lid, with which `response` is multiplied
    lid: np.ndarray  # (c, l, columns) φ'
    integrals: np.ndarray  # (c, v, columns) ∬ φ V dS over the whole hull
    residual: float  # the largest, of the reduced equations


def solved(reduced, mine, W, S, K, given):
    """`Flow` of some classes.  Raises LinAlgError if their equations are singular.

    reduced : `bem.panels.band.equations.Reduced`, of which `mine` are the classes; W (c, r, q), S (c, r, h) : wave
        parts
    given : (c, v, columns) v
    """
    at_sources, on_lid, M = reduced.at_sources[mine], reduced.on_lid[mine], reduced.space.M[mine]
    r, v, lid = W.shape[1], given.shape[1], on_lid.shape[1]
    T, answer = on_lid[..., r + v :], on_lid[..., : r + v]
    H = at_sources[..., : r + v]  # α = H (m, −v)
    if lid:  # Kφ' = −answer @ (m, −v)
        answer = np.linalg.solve(T + 4 * np.pi / K * np.eye(lid), answer)
        H = H - (at_sources[..., r + v :] + reduced.from_lid / K) @ answer
    # m = W H (m, −v) − S_w M v
    A, b = (
        np.eye(r) - complex_times_real(W, H[..., :r]),
        -(W @ real_times_complex(H[..., r:], given) + S @ real_times_complex(M, given)),
    )
    m = np.linalg.solve(A, b)
    rest = np.abs(A @ m - b).max(axis=1) / np.maximum(np.abs(b).max(axis=1), 1e-300)
    sides = np.concatenate([m, -given], axis=1)
    lid = -real_times_complex(answer, sides)
    shares = np.concatenate([sides, lid], axis=1)
    return Flow(shares, lid / K, real_times_complex(reduced.integrals[mine], shares), float(rest.max()))
