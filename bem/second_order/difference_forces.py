"""Difference-frequency force of pairs of waves on a body on panels, part by part, short of the free surface's.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        T = squares + bound wave + body

squares : of first-order pressures and motions (`mean_drift`, `rotations`), on the diagonal the mean drift
bound wave : incident at second order, and diffracted (`bound_waves`, `long_wave_forces`)
body : the potential that the moving hull makes in the first-order flow (`body_forces`); none on a fixed body

Frequencies are at even steps, so that every difference is one of few.  The forcing of the surface around the body by
products of its waves is left out: on a cylinder on the bed it is 0.2 to 6 % (`tests/bench/bound_waves.py`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .. import DOFS
from ..panels.pressure_drift.hull_flow import HullFlow, hull_surfaces, radiated_flow, wave_flow
from ..panels.pressure_drift.mean_drift import check_panels, pressure_pairs
from .body_forces import body_forces
from .bound_waves import bound_waves
from .long_wave_forces import LOWEST, long_wave_forces
from .rotations import first_order_loads, rotated_pairs, still_water_pairs

EVEN = 1e-6  # of the step between frequencies
MANY = 12  # differences, from which they share their work: what they share takes as long as some of them
PARTS = ("squares", "bound_wave", "body")


@dataclass(frozen=True, eq=False)
class DifferenceForces:
    """T of pairs (ω + Ω, βᵢ; ω, βⱼ), N/m², N m/m² about the rotation centre; the other order has the conjugate.

    omega : (n,) rad/s, even; difference : (d,) rad/s, from 0 at the same step; headings : (m,) rad
    squares, bound_wave, body : (d, n, m, m, 6) complex; NaN where ω + Ω is beyond the last frequency
    """

    omega: np.ndarray
    difference: np.ndarray
    headings: np.ndarray
    squares: np.ndarray
    bound_wave: np.ndarray
    body: np.ndarray

    @property
    def total(self):
        """(d, n, m, m, 6)"""
        return self.squares + self.bound_wave + self.body


def difference_forces(problem, omega, headings, highest, moving, report=lambda done, of: None):
    """`DifferenceForces` of a `bem.methods.panel_problem.PanelProblem`.

    omega : (n,) rad/s at even steps; headings : (m,) rad; highest : rad/s, largest difference; moving : freely
    floating instead of fixed; report : called with how many of the solutions are done
    raises : ValueError for uneven frequencies, constant panels, zero draft, a moving body without inertia
    """
    omega, headings = np.asarray(omega, float), np.atleast_1d(np.asarray(headings, float))
    step = _step(omega)
    if moving and problem.inertia_matrix is None:
        raise ValueError("difference forces on a floating body without inertia; solve it with --gyration kxx,kyy,kzz")
    steps = min(int(highest / step + EVEN), len(omega) - 1)
    prepared = _sharing(problem, omega[0], omega[-1], len(omega))
    check_panels(problem, prepared.geometry.mesh)
    surfaces = hull_surfaces(prepared.geometry)
    parts, loads, rao = [], [], []
    want = {"rao", "excitation_force", "added_mass"} if moving else {"excitation_force"}
    for done, w in enumerate(omega):
        run = prepared.run(w, headings, want, None, DOFS)
        motions = run.rao if moving else np.zeros((len(headings), 6), complex)
        parts.append(wave_flow(run, surfaces, motions @ problem.transform))
        rao.append(motions)
        loads.append(first_order_loads(run) if moving else 0 * motions)
        report(done + 1, len(omega) + steps + 1)
    flow, rao = HullFlow.joined(parts), np.concatenate(rao)
    squares = pressure_pairs(surfaces, flow, problem) @ problem.transform.T
    if moving:
        squares += rotated_pairs(np.concatenate(loads), rao) + still_water_pairs(rao, problem, surfaces.hull)
    shape = steps + 1, len(omega), len(headings), len(headings), 6
    out = {name: np.full(shape, np.nan, complex) for name in PARTS}
    long = _sharing(replace(problem, lid=None, coarse=None, finer=None), step, step * steps, steps)
    squares = squares.reshape(2 * (len(omega), len(headings)) + (6,))
    for m in range(steps + 1):
        pairs = _Pairs(omega, headings, m)
        run = _long_run(long, m * step)
        out["squares"][m, : pairs.count] = squares[np.arange(m, len(omega)), :, np.arange(pairs.count)]
        out["bound_wave"][m, : pairs.count] = pairs.shaped(_bound(pairs, run, problem))
        made = np.zeros((len(pairs.one), 6), complex)
        if moving and m:
            made = body_forces(surfaces, flow, pairs.one, pairs.two, radiated_flow(run, surfaces), problem)
        out["body"][m, : pairs.count] = pairs.shaped(made @ problem.transform.T)
        report(len(omega) + m + 1, len(omega) + steps + 1)
    return DifferenceForces(omega, step * np.arange(steps + 1), headings, **out)


def _sharing(problem, low, high, count):
    """The problem prepared, its frequencies in a band that shares work where there are many; a round body needs none"""
    alone = replace(problem, band=None).prepared()
    if count < MANY or alone.axisymmetric_geometry.sectors:
        return alone
    return replace(problem, band=(low, high)).prepared()


class _Pairs:
    """All pairs of waves `apart` steps apart, by the numbers of their waves, and of two headings each"""

    def __init__(self, omega, headings, apart):
        self.count, self.headings = len(omega) - apart, len(headings)
        place, a, b = (part.ravel() for part in np.indices((self.count, self.headings, self.headings)))
        self.one, self.two = (place + apart) * self.headings + a, place * self.headings + b
        self.waves = (omega[place + apart], headings[a]), (omega[place], headings[b])

    def shaped(self, values):
        return values.reshape(self.count, self.headings, self.headings, 6)


def _bound(pairs, run, problem):
    """(q, 6) of bound waves, zero in deep water where none reaches the body"""
    if not np.isfinite(problem.depth):
        return np.zeros((len(pairs.one), 6), complex)
    bound = bound_waves(*pairs.waves, problem.depth, problem.gravity)
    return bound.amplitude[:, None] * (long_wave_forces(run, bound.number) @ problem.transform.T)


def _long_run(prepared, omega):
    """Radiation at a difference frequency, without lid: these waves are as long as the body or longer"""
    problem = prepared.problem
    scale = problem.depth if np.isfinite(problem.depth) else prepared.draft
    return prepared.run(max(omega, LOWEST * np.sqrt(problem.gravity / scale)), [0.0], {"added_mass"}, None, DOFS)


def _step(omega):
    steps = np.diff(omega)
    if len(omega) < 2 or np.ptp(steps) > EVEN * steps.mean() or steps.mean() <= 0:
        raise ValueError("difference forces at uneven frequencies; allowed: two or more at equal steps, rising")
    return float(steps.mean())
