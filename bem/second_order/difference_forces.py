"""Difference-frequency force of pairs of waves on a body on panels, part by part.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        T = squares + bound wave + body + surface

squares : of first-order pressures and motions (`mean_drift`, `rotations`), on the diagonal the mean drift
bound wave : incident at second order, and diffracted (`bound_waves`, `long_wave_forces`)
body : the potential that the moving hull makes in the first-order flow (`body_forces`); none on a fixed body
surface : the potential that products of first-order waves make on the surface around the body (`surface_forces`);
    the dearest part, left out unless asked for: on a cylinder on the bed 0.4 to 6 % (`tests/bench/bound_waves.py`)

Frequencies are at even steps, so that every difference is one of few.
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
from .surface_forces import Difference, line_integral, surface_forces
from .surface_waves import SurfaceWaves

EVEN = 1e-6  # of the step between frequencies
MANY = 12  # differences, from which they share their work: what they share takes as long as some of them
ORDER = 1.4  # of the error in the number of panels, fitted to the scenes of `tests/bench/pair_errors.py`
BESIDE_DRIFT = 0.3  # share of what two meshes differ by, beside what near and far field do, fitted there too
HORIZONTAL = [0, 1, 5]
PLACES = np.array([0.2, 0.5, 0.8])  # in the band, of pairs that tell how large the surface's part is
PARTS = ("squares", "bound_wave", "body", "surface")


@dataclass(frozen=True, eq=False)
class DifferenceForces:
    """T of pairs (ω + Ω, βᵢ; ω, βⱼ), N/m², N m/m² about the rotation centre; the other order has the conjugate.

    omega : (n,) rad/s, even; difference : (d,) rad/s, from 0 at the same step; headings : (m,) rad
    squares, bound_wave, body, surface : (d, n, m, m, 6) complex; NaN where ω + Ω is beyond the last frequency;
        surface None where it is left out
    far_drift : (n, m, 3) mean surge, sway and yaw of single waves by the far field, N/m², N m/m², or None
    """

    omega: np.ndarray
    difference: np.ndarray
    headings: np.ndarray
    squares: np.ndarray
    bound_wave: np.ndarray
    body: np.ndarray
    surface: np.ndarray | None = None
    far_drift: np.ndarray | None = None

    @property
    def total(self):
        """(d, n, m, m, 6)"""
        return self.to_body + (0.0 if self.surface is None else self.surface)

    @property
    def to_body(self):
        """(d, n, m, m, 6) without the surface's part"""
        return self.squares + self.bound_wave + self.body


def difference_forces(
    problem, omega, headings, highest, moving, report=lambda done, of: None, surface=False, far_field=False
):
    """`DifferenceForces` of a `bem.methods.panel_problem.PanelProblem`.

    omega : (n,) rad/s at even steps; headings : (m,) rad; highest : rad/s, largest difference
    moving : freely floating instead of fixed, or the (6, 6) stiffness of lines that hold it beside the water
    report : called with how many of the solutions are done; surface : with its forcing
    far_field : whether the mean drift by the far field is wanted, from which `panel_errors` tells more
    raises : ValueError for uneven frequencies, constant panels, zero draft, a moving body without inertia; with
        `surface` for a waterline that is not one curve around the body
    """
    omega, headings = np.asarray(omega, float), np.atleast_1d(np.asarray(headings, float))
    step, lines = _step(omega), moving if np.ndim(moving) else None
    moving = lines is not None or bool(moving)
    if moving and problem.inertia_matrix is None:
        raise ValueError("difference forces on a floating body without inertia; solve it with --gyration kxx,kyy,kzz")
    steps = min(int(highest / step + EVEN), len(omega) - 1)
    difference = step * np.arange(steps + 1)
    waves = _Waves(problem, omega, headings, moving, difference, surface, lines, far_field)
    for done, w in enumerate(omega):
        waves.solve(w)
        report(done + 1, len(omega) + steps + 1)
    flow, squares = waves.joined()
    out = {name: np.full((steps + 1, len(omega), len(headings), len(headings), 6), np.nan, complex) for name in PARTS}
    on_surface = []
    for m in range(steps + 1):
        pairs = _Pairs(omega, headings, m)
        run = waves.radiation(difference[m])
        out["squares"][m, : pairs.count] = squares[np.arange(m, len(omega)), :, np.arange(pairs.count)]
        out["bound_wave"][m, : pairs.count] = pairs.shaped(_bound(pairs, run, problem))
        body, made = np.zeros((len(pairs.one), 6), complex), None
        if m and (moving or surface):
            made = radiated_flow(run, waves.surfaces)
        if m and moving:
            body = body_forces(waves.surfaces, flow, pairs.one, pairs.two, made, problem)
        if m and surface:
            on_surface.append(_on_surface(waves, flow, pairs, run, made, difference[m]))
        out["body"][m, : pairs.count] = pairs.shaped(body @ problem.transform.T)
        report(len(omega) + m + 1, len(omega) + steps + 1)
    if surface:
        out["surface"][0] = 0.0
        for m, found in enumerate(surface_forces(waves.around, on_surface), 1):
            out["surface"][m, : len(omega) - m] = _Pairs(omega, headings, m).shaped(found @ problem.transform.T)
    else:
        out["surface"] = None
    return DifferenceForces(omega, difference, headings, **out, far_drift=np.array(waves.far) if far_field else None)


class _Waves:
    """First-order flow of all waves: on the hull, and with `surface` on the water around it

    differences : (d,) rad/s, from 0, at which the body radiates; of those among the frequencies one run has both
    """

    def __init__(self, problem, omega, headings, moving, differences, surface=False, lines=None, far_field=False):
        self.problem, self.headings, self.moving, self.far_field = problem, headings, moving, far_field
        stiffness = problem.hydrostatic_stiffness if lines is None else problem.hydrostatic_stiffness + lines
        scale = problem.depth if np.isfinite(problem.depth) else problem.mesh.draft
        self.least = LOWEST * np.sqrt(problem.gravity / scale)
        held = replace(problem, hydrostatic_stiffness=stiffness)
        self.differences, self.near = differences, EVEN * differences[-1] / max(len(differences) - 1, 1)
        low = max(self.least, min([omega[0], *differences[1:2]]))
        self.prepared = _sharing(held, low, max(omega[-1], differences[-1]), len(omega) + len(differences))
        check_panels(problem, self.prepared.geometry.mesh)
        self.surfaces = hull_surfaces(self.prepared.geometry)
        around = surface and len(differences) > 1
        self.around = SurfaceWaves(self.prepared, self.surfaces, omega, differences[1:]) if around else None
        self.parts, self.loads, self.rao, self.far, self.radiating = [], [], [], [], []

    def solve(self, omega):
        again = np.abs(self.differences - omega).min() <= self.near
        want = {"excitation_force"} | ({"rao", "added_mass"} if self.moving else {"added_mass"} if again else set())
        drift = {"drift_force" if self.moving else "drift_force_fixed"} if self.far_field else set()
        run = self.prepared.run(omega, self.headings, want | drift, None, DOFS)
        if self.far_field:
            self.far.append(run.drift(self.moving))
        if again:
            self.radiating.append(run)
        rao = run.rao if self.moving else np.zeros((len(self.headings), 6), complex)
        motions = rao @ self.problem.transform
        self.parts.append(wave_flow(run, self.surfaces, motions))
        self.rao.append(rao)
        self.loads.append(first_order_loads(run, self.problem) if self.moving else 0 * rao)
        if self.around is not None:
            self.around.add(run, self.parts[-1], motions)

    def radiation(self, omega):
        """Run of a difference frequency"""
        known = [run for run in self.radiating if abs(run.omega - omega) <= self.near]
        return known[0] if known else self.prepared.run(max(omega, self.least), [0.0], {"added_mass"}, None, DOFS)

    def joined(self):
        """`HullFlow` of all waves and (n, m, n, m, 6) T of squares of first order"""
        flow, rao = HullFlow.joined(self.parts), np.concatenate(self.rao)
        squares = pressure_pairs(self.surfaces, flow, self.problem) @ self.problem.transform.T
        if self.moving:
            squares += rotated_pairs(np.concatenate(self.loads), rao)
            squares += still_water_pairs(rao, self.problem, self.surfaces.hull)
        n, m = len(self.parts), len(self.headings)
        return flow, squares.reshape(n, m, n, m, 6)


def surface_share(problem, omega, headings, highest, moving):
    """What the forcing of the surface is of the force in surge and sway, root mean square of few pairs.

    Arguments as of `difference_forces`; of pairs half the largest difference apart at PLACES in the band, in waves of
    the first heading
    """
    omega, parts = np.asarray(omega, float), []
    _step(omega)
    apart = min(highest, np.ptp(omega)) / 2
    for middle in omega[0] + apart / 2 + PLACES * (np.ptp(omega) - apart):
        pair = middle + apart * np.array([-0.5, 0.5])
        found = difference_forces(problem, pair, np.atleast_1d(headings)[:1], 1.5 * apart, moving, surface=True)
        parts.append(_sizes(found))
    return _ratio(np.array(parts))


def share_of(forces):
    """Root mean square of the surface's part in surge and sway over that of the whole, of pairs of equal headings"""
    return _ratio(_sizes(forces))


def panel_errors(forces, rough, refinement):
    """(d, n, m, m, 6) estimated errors of the whole from the same on a coarser mesh, N/m², N m/m²

    What both differ by, and in surge, sway and yaw less of that and what near and far field differ by in the drift of
    both waves: the far field errs far less, and how panels meet at edges matters more than their number.  Root mean
    squares of a pair and its neighbours in mean and difference, as errors pass through zero.  In random scenes
    (`tests/bench/pair_errors.py`) root mean squares of surge, sway and yaw over all pairs are met within a factor of
    three in nine of ten, of heave, roll and pitch in two of three, single pairs in seven of ten.
    refinement : panels for one of the coarser mesh
    """
    off = _smoothed(np.abs(forces.total - rough.total) ** 2) / (refinement**ORDER - 1) ** 2
    if forces.far_drift is not None:
        each = np.arange(len(forces.headings))
        near = forces.squares[0][:, each, each][..., HORIZONTAL].real
        gap = np.abs(near - forces.far_drift) ** 2
        both = np.full((*off.shape[:4], 3), np.nan)
        for m in range(len(off)):
            count = len(gap) - m
            both[m, :count] = 0.5 * (gap[m:, :, None] + gap[:count, None])
        off[..., HORIZONTAL] = BESIDE_DRIFT**2 * off[..., HORIZONTAL] + _smoothed(both)
    return np.sqrt(off)


def _smoothed(values):
    """Mean of values (d, n, …) and their known neighbours in both"""
    known = np.isfinite(values)
    total, count = np.where(known, values, 0.0), known.astype(float)
    for axis in (0, 1):
        total, count = (_with_neighbours(part, axis) for part in (total, count))
    return np.where(known, total / np.maximum(count, 1.0), np.nan)


def _with_neighbours(values, axis):
    """Sum of three along an axis, of two at its ends"""
    out, values = values.copy(), np.moveaxis(values, axis, 0)
    moved = np.moveaxis(out, axis, 0)
    moved[1:] += values[:-1]
    moved[:-1] += values[1:]
    return out


def _sizes(forces):
    """Squares of the surface's part and of the whole in surge and sway, summed over pairs of equal headings"""
    each = np.arange(len(forces.headings))
    parts = (part[1:, :, each, each, :2] for part in (forces.surface, forces.total))
    return np.array([np.nansum(np.abs(part) ** 2) for part in parts])


def _ratio(squares):
    surface, whole = np.sqrt(squares.reshape(-1, 2).sum(axis=0))
    return float(surface / max(whole, 1e-300))


def _on_surface(waves, flow, pairs, run, radiated, omega):
    """`surface_forces.Difference` of pairs"""
    line = line_integral(waves.surfaces, flow, radiated, waves.around, pairs.one, pairs.two)
    return Difference(omega, pairs.one, pairs.two, *waves.around.radiated(run, radiated), line)


def _sharing(problem, low, high, count):
    """The problem prepared, its frequencies in a band that shares work where there are many; a round body needs none"""
    problem = replace(problem, coarse=None, finer=None)
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


def _step(omega):
    steps = np.diff(omega)
    if len(omega) < 2 or np.ptp(steps) > EVEN * steps.mean() or steps.mean() <= 0:
        raise ValueError("difference forces at uneven frequencies; allowed: two or more at equal steps, rising")
    return float(steps.mean())
