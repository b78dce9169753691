"""The panel method at one frequency of a band, by the equations of `bem.reduced`."""

from __future__ import annotations

import time
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .green_tables import wave_table
from .panel_run import PanelRun
from .threads import blas_threads
from .wave_blocks import wave_blocks
from .wave_space import FEW, acting

# times the accuracy of the space, at a node of mean size: what a row may lose in the L² norm of `bem.wave_space`
ALLOWED = FEW**0.5
MOST_IN_FULL = 5000  # nodes of the hull


class ReducedRun(PanelRun):
    """As `PanelRun`, at a cost that hardly grows with the number of panels."""

    @property
    def reduced(self):
        """`bem.reduced.Reduced` of this frequency's part of the band"""
        return next(part for part in self.prepared.reduced if part.geometry is self.geometry)

    @cached_property
    def potentials(self):
        """{class: potentials (columns, n) on the hull}"""
        start = time.perf_counter()
        with blas_threads(len(self.geometry.elements.nodes)):
            space = self.reduced.space
        self._timed("reduction", start)
        with blas_threads(len(space.points)):
            return self._solved()

    def _solved(self):
        start = time.perf_counter()
        reduced = self.reduced
        g, space = self.geometry, reduced.space
        table = wave_table(self.omega, self.setup.depth, self.setup.gravity, g.reach, g.mesh.draft)
        self._timed("table", start)
        start = time.perf_counter()
        hull = int(np.count_nonzero(space.sources < g.hull))
        S, D = self.waves_between(space.points, space.sources, table)
        s_all, d_all = self.waves_between(space.witnesses, np.arange(len(g.elements.nodes)), table)
        self._timed("assemble", start)
        start = time.perf_counter()
        out, self._residual, lost = {}, 0.0, 0.0
        areas = g.elements.weights[: g.hull]
        sizes = np.sqrt(areas[space.witnesses] / areas.mean())
        for cls in self.columns:
            i = g.classes.index(cls)
            part, given = reduced.classes[cls], self.given(cls, space.crests)
            flow = solved(part, acting(S[i], D[i], hull, table.K), S[i, :, :hull], table.K, given)
            whole = acting(s_all[i], d_all[i], g.hull, table.K) @ flow.potentials
            whole -= s_all[i, :, : g.hull] @ self.velocities(cls).T
            missing = (whole - space.X[space.witnesses] @ flow.wave) * sizes[:, None]
            lost = max(lost, shortfall(missing, flow.potentials))
            self._residual = max(self._residual, flow.residual)
            out[cls] = self.on_hull(flow.potentials, None)
        self._timed("solve", start)
        if not lost < ALLOWED * reduced.accuracy:  # NaN too
            return self.in_full(lost)
        return out

    def waves_between(self, points, sources, table):
        """`bem.wave_blocks.wave_blocks` at this frequency"""
        return wave_blocks(self.geometry, points, sources, table, self.depth_values)

    def in_full(self, lost):
        """The equations of all nodes, where few of them did not stand for all"""
        if self.geometry.hull > MOST_IN_FULL:
            raise FloatingPointError(
                f"ω = {self.omega:.6g} rad/s: {lost:.1e} of the waves is lost between few nodes; allowed: "
                f"{ALLOWED * self.reduced.accuracy:.1e}; ask for a narrower band or fewer panels"
            )
        return super()._solved()

    def given(self, cls, crests):
        """(v, columns) shares of a class's motions and of what spans waves in `velocities`"""
        moving, waves = self.columns[cls]
        members = self.geometry.members(cls)
        out = np.zeros((len(members) + len(crests), len(moving) + len(waves)), complex)
        for column, dof in enumerate(moving):
            out[members.index(dof), column] = 1.0
        out[len(members) :, len(moving) :] = -self.incident[0][cls][1][waves][:, crests].T
        return out


class Flow(NamedTuple):
    """One symmetry class; n nodes, those of the hull and then of the lid, r points."""

    potentials: np.ndarray  # (n, columns) φ and φ'
    wave: np.ndarray  # (r, columns) m
    residual: float


def shortfall(missing, potentials):
    """Largest part of the waves that few nodes miss, relative to 2πφ"""
    size = 2 * np.pi * np.abs(potentials).max(axis=0)
    return float((np.abs(missing).max(axis=0) / size).max())


def solved(part, W, S, K, given):
    """`Flow` of one class, and the largest residual of the reduced equations.

    part : `bem.reduced.ReducedClass`; W (r, q), S (r, h) : wave parts; given : (v, columns) v
    """
    from scipy.linalg import lu_factor, lu_solve

    (r, _), v, lid = W.shape, len(given), len(part.on_lid)
    T, answer = part.on_lid[:, r + v :], part.on_lid[:, : r + v]
    H = part.at_sources[:, : r + v]  # α = H (m, −v)
    if lid:  # Kφ' = −answer @ (m, −v)
        answer = np.linalg.solve(T + 4 * np.pi / K * np.eye(lid), answer)
        H = H - (part.at_sources[:, r + v :] + part.from_lid / K) @ answer
    sides = np.concatenate([np.zeros((r, given.shape[1])), -given])
    # m = W H (m, −v) − S_w M v
    A = -times(H[:, :r].T, W.T).T
    A.flat[:: r + 1] += 1.0
    b = W @ times(H, sides) - S @ (part.M @ given)
    m = lu_solve(lu_factor(A, check_finite=False), b, check_finite=False)
    rest = np.abs(A @ m - b).max(axis=0) / np.maximum(np.abs(b).max(axis=0), 1e-300)
    sides[:r] = m
    lid = -times(answer, sides)
    hull = times(part.response, np.concatenate([sides, lid]))
    if not np.all(np.isfinite(hull)):
        raise FloatingPointError("the solution is not finite")
    return Flow(np.concatenate([hull, lid / K]), m, float(rest.max()))


def times(real, values):
    """real (a, b) @ complex (b, c), as one real product: half of what numpy takes, which makes both complex"""
    return (real @ np.ascontiguousarray(values).view(float)).view(complex)
