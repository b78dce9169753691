"""Difference-frequency force of pairs of waves on a body, part by part.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        T = squares + bound wave + body + surface

squares : of first-order pressures and motions (`mean_drift`, `rotations`), on the diagonal the mean drift.  In surge,
    sway and yaw the far field knows the diagonal better than the pressure does, and what it has more there, at equal
    frequencies, is added to other pairs as far as the flows on the hull are alike (`_by_far_field`)
bound wave : incident at second order, and diffracted (`bound_waves`, `long_wave_forces`)
body : the potential that the moving hull makes in the first-order flow (`body_forces`); none on a fixed body
surface : the potential that products of first-order waves make on the surface around the body (`surface_forces`);
    the dearest part, left out unless asked for: on a cylinder on the bed 0.4 to 6 % (`tests/bench/bound_waves.py`)

Frequencies are at even steps, so that every difference is one of few.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .body_forces import body_forces
from .bound_waves import bound_waves
from .first_order_waves import EVEN, PanelWaves
from .surface_forces import Difference, SurfaceForces, line_integral

ORDER = 1.4  # of the error in the number of panels, fitted to the scenes of `tests/bench/pair_errors.py`
SIZES = 0.11, 0.33  # factors of estimated errors: heave, roll and pitch; surge, sway and yaw; fitted there too
HORIZONTAL = [0, 1, 5]
PLACES = np.array([0.2, 0.5, 0.8])  # in the band, of pairs that tell how large the surface's part is
PARTS = ("squares", "bound_wave", "body", "surface")
BLOCK = 8  # differences solved together: what waves are on the surface is summed once for them


@dataclass(frozen=True, eq=False)
class DifferenceForces:
    """T of pairs (ω + Ω, βᵢ; ω, βⱼ), N/m², N m/m² about the rotation centre; the other order has the conjugate.

    omega : (n,) rad/s, even; difference : (d,) rad/s, from 0 at the same step; headings : (m,) rad
    squares, bound_wave, body, surface : (d, n, m, m, 6) complex; NaN where ω + Ω is beyond the last frequency;
        surface None where it is left out
    added : (n, m, m, 3) in surge, sway and yaw what the far field has more than the pressure at equal frequencies,
        in `squares`, N/m², N m/m²; None where it is not known
    """

    omega: np.ndarray
    difference: np.ndarray
    headings: np.ndarray
    squares: np.ndarray
    bound_wave: np.ndarray
    body: np.ndarray
    surface: np.ndarray | None = None
    added: np.ndarray | None = None

    @property
    def total(self):
        """(d, n, m, m, 6)"""
        return self.to_body + (0.0 if self.surface is None else self.surface)

    @classmethod
    def joined(cls, several):
        """Those of several ranges of differences of the same waves, in their order"""
        parts = {part: [getattr(forces, part) for forces in several] for part in ("difference", *PARTS)}
        return replace(several[0], **{part: None if v[0] is None else np.concatenate(v) for part, v in parts.items()})

    def first(self, count):
        """Those of the first `count` differences"""
        parts = {part: None if (v := getattr(self, part)) is None else v[:count] for part in PARTS}
        return replace(self, difference=self.difference[:count], **parts)

    @property
    def to_body(self):
        """(d, n, m, m, 6) without the surface's part"""
        return self.squares + self.bound_wave + self.body


def difference_forces(problem, omega, headings, highest, moving, report=lambda part, done, of: None, surface=False):
    """`DifferenceForces` of a `bem.methods.panel_problem.PanelProblem`, or of a `ShapeProblem` by the contour method.

    omega : (n,) rad/s at even steps; headings : (m,) rad; highest : rad/s, largest difference
    moving : freely floating instead of fixed, or the (6, 6) stiffness of lines that hold it beside the water
    report : called with how many "frequencies" of the first order are done, then with how many "pairs", and of how many
    surface : with its forcing
    raises : ValueError for uneven frequencies, constant panels, zero draft, a moving body without inertia; with
        `surface` for a waterline that is not one curve around the body
    """
    return DifferenceRun(problem, omega, headings, highest, moving, report, surface).all()


class DifferenceRun:
    """Forces of pairs some differences at a time, from the smallest on, after the first order of all waves.

    Arguments, errors and what is made as of `difference_forces`; swayed : (n, m, 6) motions about the rotation centre,
    those of another resolution, or None.  motions : (n, m, 6) its own; by_motions : (d, n, m, m, 6) what the squares of
    first order are more in the motions `swayed`, N/m², N m/m², or None
    """

    def __init__(
        self, problem, omega, headings, highest, moving, report=lambda part, done, of: None, surface=False, swayed=None
    ):
        self.omega, self.headings = np.asarray(omega, float), np.atleast_1d(np.asarray(headings, float))
        step, lines = _step(self.omega), moving if np.ndim(moving) else None
        self.problem, self.moving, self.surface = problem, lines is not None or bool(moving), surface
        if self.moving and problem.inertia_matrix is None:
            raise ValueError(
                "difference forces on a floating body without inertia; solve it with --gyration kxx,kyy,kzz"
            )
        self.difference, self.report = step * np.arange(steps_to(highest, self.omega) + 1), report
        waves = _waves_of(problem)(
            problem, self.omega, self.headings, self.moving, self.difference, surface, lines, swayed
        )
        for done, w in enumerate(self.omega):
            waves.solve(w)
            report("frequencies", done + 1, len(self.omega))
        self.waves, (self.flow, self.squares) = waves, waves.joined()
        self.motions, self.by_motions = np.array(waves.rao), None
        if swayed is not None:
            more = waves.squares_in_swayed() - self.squares
            self.by_motions = np.array([self._apart(more, m) for m in range(len(self.difference))])
        self.added = _by_far_field(self.squares, np.array(waves.far), self.flow)
        self.of_surface = None if waves.around is None else SurfaceForces(waves.around)

    def blocks(self, done=0):
        """Ranges of up to BLOCK differences after the first `done`, a multiple of BLOCK"""
        return [range(m, min(m + BLOCK, len(self.difference))) for m in range(done, len(self.difference), BLOCK)]

    def all(self):
        """`DifferenceForces` of all differences"""
        return DifferenceForces.joined([self.solve(block) for block in self.blocks()])

    def _apart(self, values, m):
        """(n, m, m, 6) of values (n, m, n, m, 6) of all pairs of waves, those of two frequencies m steps apart"""
        count = len(self.omega) - m
        return _filled(values[np.arange(m, len(self.omega)), :, np.arange(count)], len(self.omega))

    def solve(self, block):
        """`DifferenceForces` of a range of differences"""
        several = [_Pairs(self.omega, self.headings, m) for m in block]
        parts, on_surface = {part: [] for part in PARTS}, []
        for m, pairs in zip(block, several, strict=True):
            run = self.waves.radiation(self.difference[m])
            made = self.waves.radiated(run) if m and (self.moving or self.surface) else None
            parts["squares"].append(self._apart(self.squares, m))
            parts["bound_wave"].append(pairs.shaped(_bound(pairs, run, self.waves)))
            parts["body"].append(self._body(pairs, made if self.moving else None))
            if m and self.surface:
                on_surface.append(_on_surface(self.waves, self.flow, pairs, run, made, self.difference[m]))
            if not self.surface:
                self._tell(m)
        if self.surface:
            found = iter(self.of_surface(on_surface) if on_surface else ())
            turned = self.problem.transform.T
            parts["surface"] = [
                pairs.shaped(next(found) @ turned) if m else np.zeros_like(parts["body"][0])
                for m, pairs in zip(block, several, strict=True)
            ]
            self._tell(block[-1])
        parts = {
            part: np.array([_filled(v, len(self.omega)) for v in values]) for part, values in parts.items() if values
        }
        return DifferenceForces(self.omega, self.difference[list(block)], self.headings, **parts, added=self.added)

    def _body(self, pairs, made):
        """(n − m, m, m, 6) of the moving hull, made : `HullFlow` of its radiated waves, None for none"""
        if made is None:
            return pairs.shaped(np.zeros((len(pairs.one), 6), complex))
        body = body_forces(self.waves.surfaces, self.flow, pairs.one, pairs.two, made, self.problem)
        return pairs.shaped(body @ self.problem.transform.T)

    def _tell(self, last):
        """That the pairs of the differences up to the number `last` are solved"""
        done, of = (sum(len(self.omega) - m for m in range(count)) for count in (last + 1, len(self.difference)))
        each = len(self.headings) ** 2
        self.report("pairs", each * done, each * of)


def _filled(values, count):
    """(count, …) of values, NaN where there are none"""
    return np.concatenate([values, np.full((count - len(values), *values.shape[1:]), np.nan)])


def steps_to(highest, omega):
    """How many steps of even frequencies (n,) the largest difference is that is not above `highest`, rad/s.

    raises : ValueError where the frequencies are not at even steps
    """
    return min(int(highest / _step(omega) + EVEN), len(omega) - 1)


def _by_far_field(squares, far, flow):
    """What the far field (n, m, m, 3) has more than `squares` (n, m, n, m, 6) at equal frequencies, added to these.

    What the pressure lacks is, as the force, of first degree in each of both flows u on the hull.  The one nearest to
    uⱼ that is a multiple of uᵢ is uᵢ⟨uⱼ, uᵢ⟩/⟨uᵢ, uᵢ⟩, and the pair (i, j) lacks as many times what (i, i) lacks: the
    mean of that and of the same from (j, j), which fades as the flows become different, at resonance of one of them
    or far apart in frequency.  flow : `HullFlow` of all waves
    """
    (n, m), each = far.shape[:2], np.arange(len(far))
    more = far - squares[each, :, each][..., HORIZONTAL]
    alike = _likeness(flow, n, m)
    size = alike[each, each].real
    to_first, to_second = alike / size[:, None], alike / size
    added = to_first[:, :, None, :, None] * more[:, None] + to_second[..., None, None] * more
    squares[..., HORIZONTAL] += 0.5 * added.swapaxes(1, 2)
    return more


def _likeness(flow, n, m):
    """(n, n, m) ⟨uᵢ, uⱼ⟩ = ∬ uᵢ·ūⱼ dS over the hull of the waves of each heading, m⁴/s²"""
    u, area = flow.velocity.reshape(n, m, -1), np.repeat(flow.hull.weights, 3)
    return np.stack([(one * area) @ one.conj().T for one in u.swapaxes(0, 1)], axis=-1)


def _waves_of(problem):
    """The class that collects its waves"""
    if hasattr(problem, "mesh"):
        return PanelWaves
    from .contour_waves import ContourWaves

    return ContourWaves


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


def panel_errors(forces, coarser, refinement, by_motions=None):
    """(d, n, m, m, 6) estimated errors of the whole from that on a coarser mesh, N/m², N m/m²

    Two meshes tell little by themselves: where an error passes through zero their difference is chance.  The estimate
    is the geometric mean of that difference, divided as its order says, and of the squares, in surge, sway and yaw also
    of what is `added` to them and of the difference on the diagonal, the far field's; of root mean squares of a pair
    and its neighbours in mean and difference.  In heave, roll and pitch the squares of that and of what the error of
    the motions makes, large near resonance, are added.  `tests/bench/pair_errors.py` has the shares that are met within
    a factor of three.  Meshes of different proportions, or alike in a direction, tell less.
    coarser : (d, n, m, m, 6) the whole on the coarser mesh; refinement : panels for one of it
    by_motions : (d, n, m, m, 6) what the squares on the coarser mesh are more in the motions of the finer one, or None
    """
    less = 1 / (refinement**ORDER - 1)
    square = np.abs(forces.total - coarser) ** 2
    off, size = np.sqrt(_smoothed(square)) * less, np.sqrt(_smoothed(np.abs(forces.squares) ** 2))
    out = SIZES[0] * np.sqrt(off * size)
    if by_motions is not None:
        out = np.hypot(out, np.sqrt(_smoothed(np.abs(by_motions) ** 2)) * less)
    if forces.added is not None:
        more = np.abs(forces.added) ** 2, square[0][..., HORIZONTAL]
        gap, far = (np.sqrt(_smoothed(_of_both(part, off.shape[:4]))) for part in more)
        parts = (off[..., HORIZONTAL], size[..., HORIZONTAL], gap, far * less)
        out[..., HORIZONTAL] = SIZES[1] * np.prod([part**0.25 for part in parts], axis=0)
    return out


def _of_both(values, shape):
    """(*shape, 3) means of values (n, m, m, 3) of both waves of each pair"""
    out = np.full((*shape, values.shape[-1]), np.nan)
    for m in range(len(out)):
        count = len(values) - m
        out[m, :count] = 0.5 * (values[m:] + values[:count])
    return out


def resolution_errors(forces, coarser):
    """(d, n, m, m, 6) estimated errors of forces by the contour method from the whole (d, n, m, m, 6) to a tolerance
    ten times as large

    What both differ by, root mean square of a pair and its neighbours: more than the finer one errs by
    """
    return np.sqrt(_smoothed(np.abs(forces.total - coarser) ** 2))


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


class _Pairs:
    """All pairs of waves `apart` steps apart, by the numbers of their waves, and of two headings each"""

    def __init__(self, omega, headings, apart):
        self.count, self.headings = len(omega) - apart, len(headings)
        place, a, b = (part.ravel() for part in np.indices((self.count, self.headings, self.headings)))
        self.one, self.two = (place + apart) * self.headings + a, place * self.headings + b
        self.waves = (omega[place + apart], headings[a]), (omega[place], headings[b])

    def shaped(self, values):
        return values.reshape(self.count, self.headings, self.headings, 6)


def _bound(pairs, run, waves):
    """(q, 6) of bound waves"""
    problem = waves.problem
    bound = bound_waves(*pairs.waves, problem.depth, problem.gravity)
    return bound.amplitude[:, None] * (waves.long_waves(run, bound.number) @ problem.transform.T)


def _step(omega):
    steps = np.diff(omega)
    if len(omega) < 2 or np.ptp(steps) > EVEN * steps.mean() or steps.mean() <= 0:
        raise ValueError("difference forces at uneven frequencies; allowed: two or more at equal steps, rising")
    return float(steps.mean())
