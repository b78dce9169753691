"""Force of pairs of waves on a body at the difference of their frequencies, or at their sum (`kinds`), part by part.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        T = squares + bound wave + body + surface

squares : of first-order pressures and motions (`mean_drift`, `rotations`), on the diagonal the mean drift.  In surge,
    sway and yaw the far field knows the diagonal better than the pressure does, and what it has more there, at equal
    frequencies, is added to other pairs as far as the flows on the hull are alike (`_by_far_field`)
bound wave : incident at second order, and diffracted (`bound_waves`, `long_wave_forces`)
body : the potential that the moving hull makes in the first-order flow (`body_forces`); none on a fixed body
surface : the potential that products of first-order waves make on the surface around the body (`surface_forces`);
    the dearest part, left out unless asked for: on a cylinder on the bed 0.4 to 6 % (`tests/bench/bound_waves.py`)

Frequencies are at even steps, so that every difference and every sum is one of few.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .bound_waves import bound_waves
from .first_order_waves import PanelWaves, WavesOfBodies
from .kinds import DIFFERENCE, EVEN, SUM, Kind
from .surface_forces import PairsOfOne, SurfaceForces, line_integral

ORDER = 1.4  # order of the error in the number of panels, fitted by `tests/bench/pair_errors.py`
SIZES = 0.08, 0.33, 1.3  # factors of estimated errors: heave, roll, pitch; surge, sway, yaw; of the motions; fitted too
OF_SUMS = 1.9  # times those of sums of frequencies; `tests/bench/sum_errors.py`
HORIZONTAL = [0, 1, 5]
PLACES = np.array([0.2, 0.5, 0.8])  # places in the band of the pairs that estimate the free-surface forcing
PARTS = ("squares", "bound_wave", "body", "surface")
BLOCK = 8  # frequencies of the force solved together: what waves are on the surface is summed once for them


@dataclass(frozen=True, eq=False)
class QuadraticForces:
    """T of pairs (ω', βᵢ; ω, βⱼ) of a frequency Ω, ω' = ω + Ω, or in sums ω' = Ω − ω ≥ ω; N/m², N m/m² about the
    rotation centre.  The other order has the conjugate, in sums the same.

    omega : (n,) rad/s, even; frequency : (d,) rad/s, of the force, at the same step: differences from 0, or sums from
        that of the lowest frequency with itself; headings : (m,) rad
    squares, bound_wave, body, surface : (d, n, m, m, 6) complex at Ω and ω; NaN where there is no ω', or in sums
        ω' < ω; surface None where it is left out
    added : (n, m, m, 3) in surge, sway and yaw what the far field has more than the pressure at equal frequencies,
        in `squares`, N/m², N m/m²; None where it is not known
    kind : `kinds.DIFFERENCE` or `SUM`
    """

    omega: np.ndarray
    frequency: np.ndarray
    headings: np.ndarray
    squares: np.ndarray
    bound_wave: np.ndarray
    body: np.ndarray
    surface: np.ndarray | None = None
    added: np.ndarray | None = None
    kind: Kind = DIFFERENCE

    @property
    def total(self):
        """(d, n, m, m, 6)"""
        return self.to_body + (0.0 if self.surface is None else self.surface)

    @classmethod
    def joined(cls, several):
        """Those of several ranges of frequencies of the same waves, in their order"""
        parts = {part: [getattr(forces, part) for forces in several] for part in ("frequency", *PARTS)}
        return replace(several[0], **{part: None if v[0] is None else np.concatenate(v) for part, v in parts.items()})

    def first(self, count):
        """Those of the first `count` frequencies"""
        parts = {part: None if (v := getattr(self, part)) is None else v[:count] for part in PARTS}
        return replace(self, frequency=self.frequency[:count], **parts)

    @property
    def to_body(self):
        """(d, n, m, m, 6) without the surface's part"""
        return self.squares + self.bound_wave + self.body


def quadratic_forces(
    problem, omega, headings, highest, moving, report=lambda part, done, of: None, surface=False, kind=DIFFERENCE
):
    """`QuadraticForces` of a `bem.methods.panel_problem.PanelProblem`, or of a `ShapeProblem` by the contour method.

    omega : (n,) rad/s at even steps; headings : (m,) rad; highest : rad/s, largest frequency of the force
    moving : freely floating instead of fixed, or the (6, 6) stiffness of lines that hold it beside the water
    report : called with how many "frequencies" of the first order are done, then with how many "pairs", and of how many
    surface : with its forcing; kind : `kinds.DIFFERENCE` or `SUM`
    raises : ValueError for uneven frequencies, constant panels, zero draft, a moving body without inertia; with
        `surface` for a waterline that is not one curve around the body
    """
    return QuadraticRun(problem, omega, headings, highest, moving, report, surface, kind=kind).all()


class QuadraticRun:
    """Forces of pairs some frequencies of the force at a time, from the lowest on, after the first order of all waves.

    Arguments, errors and what is made as of `quadratic_forces`; swayed : (n, m, 6) motions about the rotation centre,
    those of another resolution, or None.  motions : (n, m, 6) its own; by_motions : (d, n, m, m, 6) what the squares of
    first order are more in the motions `swayed`, N/m², N m/m², or None
    """

    def __init__(
        self,
        problem,
        omega,
        headings,
        highest,
        moving,
        report=lambda part, done, of: None,
        surface=False,
        swayed=None,
        kind=DIFFERENCE,
    ):
        self.omega, self.headings = np.asarray(omega, float), np.atleast_1d(np.asarray(headings, float))
        lines, self.kind = moving if np.ndim(moving) else None, kind
        self.problem, self.moving, self.surface = problem, lines is not None or bool(moving), surface
        if self.moving and problem.inertia_matrix is None:
            raise ValueError(
                "forces of wave pairs on a floating body need its inertia; solve it with --gyration kxx,kyy,kzz"
            )
        self.frequency, self.report = frequencies_of(self.omega, highest, kind), report
        waves = _waves_of(problem)(
            problem, self.omega, self.headings, self.moving, self.frequency, surface, lines, swayed, kind
        )
        for done, w in enumerate(self.omega):
            waves.solve(w)
            report("frequencies", done + 1, len(self.omega))
        self.waves, (self.flow, self.squares) = waves, waves.joined()
        self.motions, self.by_motions = np.array(waves.rao), None
        if swayed is not None:
            more = waves.squares_in_swayed() - self.squares
            self.by_motions = np.array([self._placed(self._of(more, m), m) for m in range(len(self.frequency))])
        known = kind is DIFFERENCE and not problem.bodies  # the far field knows all bodies together alone
        self.added = _by_far_field(self.squares, np.array(waves.far), self.flow) if known else None
        self.of_surface = None if waves.around is None else SurfaceForces(waves.around, kind)

    def blocks(self, done=0):
        """Ranges of up to BLOCK frequencies of the force after the first `done`, a multiple of BLOCK"""
        return [range(m, min(m + BLOCK, len(self.frequency))) for m in range(done, len(self.frequency), BLOCK)]

    def all(self):
        """`QuadraticForces` of all frequencies of the force"""
        return QuadraticForces.joined([self.solve(block) for block in self.blocks()])

    def _of(self, values, m):
        """(q, m, m, 6) of values (n, m, n, m, 6) of all pairs of waves, those of the frequency m of the force"""
        one, two = self.kind.pairs(m, len(self.omega))
        return values[one, :, two]

    def _placed(self, values, m):
        """(n, m, m, 6) of values (q, m, m, 6) of the pairs of the frequency m of the force, NaN elsewhere"""
        out = np.full((len(self.omega), *values.shape[1:]), np.nan, complex)
        out[self.kind.pairs(m, len(self.omega))[1]] = values
        return out

    def solve(self, block):
        """`QuadraticForces` of a range of frequencies of the force"""
        several = [_Pairs(self.omega, self.headings, m, self.kind) for m in block]
        parts, on_surface = {part: [] for part in PARTS}, []
        for m, pairs in zip(block, several, strict=True):
            run, rises = self.waves.radiation(self.frequency[m]), self.frequency[m] > 0
            made = self.waves.radiated(run) if rises and (self.moving or self.surface) else None
            parts["squares"].append(self._of(self.squares, m))
            parts["bound_wave"].append(pairs.shaped(_bound(pairs, run, self.waves)))
            parts["body"].append(self._body(pairs, made if self.moving else None))
            if rises and self.surface:
                on_surface.append(_on_surface(self.waves, self.flow, pairs, run, made, self.frequency[m]))
            if not self.surface:
                self._tell(m)
        if self.surface:
            found = iter(self.of_surface(on_surface) if on_surface else ())
            turned = self.problem.transform.T
            parts["surface"] = [
                pairs.shaped(next(found) @ turned) if self.frequency[m] > 0 else np.zeros_like(parts["body"][0])
                for m, pairs in zip(block, several, strict=True)
            ]
            self._tell(block[-1])
        parts = {
            part: np.array([self._placed(v, m) for v, m in zip(values, block, strict=True)])
            for part, values in parts.items()
            if values
        }
        frequency = self.frequency[list(block)]
        return QuadraticForces(self.omega, frequency, self.headings, **parts, added=self.added, kind=self.kind)

    def _body(self, pairs, made):
        """(q, m, m, 6) of the moving hull, made : `HullFlow` of its radiated waves, None for none"""
        if made is None:
            return pairs.shaped(np.zeros((len(pairs.one), self.squares.shape[-1]), complex))
        return pairs.shaped(self.waves.of_moving_hull(self.flow, pairs.one, pairs.two, made))

    def _tell(self, last):
        """That the pairs of the frequencies up to the number `last` are solved"""
        sizes = [len(self.kind.pairs(m, len(self.omega))[0]) for m in range(len(self.frequency))]
        done, of = sum(sizes[: last + 1]), sum(sizes)
        each = len(self.headings) ** 2
        self.report("pairs", each * done, each * of)


def frequencies_of(omega, highest, kind):
    """(d,) rad/s, frequencies of the force of pairs of even frequencies (n,) that are not above `highest`

    raises : ValueError where the frequencies are not at even steps, or none is so low
    """
    steps = np.diff(omega)
    if len(omega) < 2 or np.ptp(steps) > EVEN * steps.mean() or steps.mean() <= 0:
        raise ValueError(
            "forces of wave pairs at uneven frequencies; allowed: two or more increasing frequencies at equal steps"
        )
    found = kind.rows(omega, highest)
    if not len(found):
        lowest = kind.of(omega[0], omega[0])
        raise ValueError(f"{kind.name}s of frequencies up to {highest:.4g} rad/s; allowed: {lowest:.4g} or above")
    return found


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
    if problem.bodies:
        return WavesOfBodies
    if hasattr(problem, "mesh"):
        return PanelWaves
    from .contour_waves import ContourWaves

    return ContourWaves


def surface_share(problem, omega, headings, highest, moving):
    """What the forcing of the surface is of the force in surge and sway, root mean square of few pairs.

    Arguments as of `quadratic_forces`; of pairs half the largest difference apart at PLACES in the band, in waves of
    the first heading
    """
    omega, parts = np.asarray(omega, float), []
    apart = min(highest, np.ptp(omega)) / 2
    for middle in omega[0] + apart / 2 + PLACES * (np.ptp(omega) - apart):
        pair = middle + apart * np.array([-0.5, 0.5])
        found = quadratic_forces(problem, pair, np.atleast_1d(headings)[:1], 1.5 * apart, moving, surface=True)
        parts.append(_sizes(found))
    return _ratio(np.array(parts))


def share_of(forces):
    """Root mean square of the surface's part in surge and sway over that of the whole, of pairs of equal headings"""
    return _ratio(_sizes(forces))


def panel_errors(forces, coarser, refinement, by_motions=None):
    """(d, n, m, m, 6) estimated errors of the whole from that on a coarser mesh, N/m², N m/m²

    Two meshes tell little by themselves: where an error passes through zero their difference is chance.  The estimate
    is a geometric mean: of that difference, divided as its order says, twice, of the squares and of the whole; in
    surge, sway and yaw of it, of the squares, of what is `added` to them and of the difference on the diagonal, the far
    field's; of root mean squares of a pair and its neighbours in mean and difference.  In heave, roll and pitch the
    squares of that and of what the error of the motions makes, large near resonance, are added.
    `tests/bench/pair_errors.py` has the shares that are met within a factor of three.  Meshes of different proportions,
    or alike in a direction, tell less.
    coarser : (d, n, m, m, 6) the whole on the coarser mesh; refinement : panels for one of it
    by_motions : (d, n, m, m, 6) what the squares on the coarser mesh are more in the motions of the finer one, or None
    """
    less = 1 / (refinement**ORDER - 1)
    square = np.abs(forces.total - coarser) ** 2
    off, size = np.sqrt(_smoothed(square)) * less, np.sqrt(_smoothed(np.abs(forces.squares) ** 2))
    factor = SIZES[0] * (OF_SUMS if forces.kind is SUM else 1.0)
    out = factor * np.sqrt(off) * (size * np.sqrt(_smoothed(np.abs(forces.total) ** 2))) ** 0.25
    if by_motions is not None:
        out = np.hypot(out, SIZES[2] * np.sqrt(_smoothed(np.abs(by_motions) ** 2)) * less)
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
    first = 1 if forces.kind is DIFFERENCE else 0  # the mean drift has no part of the surface
    parts = (part[first:, :, each, each, :2] for part in (forces.surface, forces.total))
    return np.array([np.nansum(np.abs(part) ** 2) for part in parts])


def _ratio(squares):
    surface, whole = np.sqrt(squares.reshape(-1, 2).sum(axis=0))
    return float(surface / max(whole, 1e-300))


def _on_surface(waves, flow, pairs, run, radiated, omega):
    """`surface_forces.PairsOfOne` of pairs"""
    line = line_integral(waves.surfaces, flow, radiated, waves.around, pairs.one, pairs.two, waves.kind)
    return PairsOfOne(omega, pairs.one, pairs.two, *waves.around.radiated(run, radiated), line)


class _Pairs:
    """All pairs of waves of one frequency of the force, by the numbers of their waves, and of two headings each

    waves : of both the frequencies and directions, as `bound_waves` takes them
    """

    def __init__(self, omega, headings, row, kind):
        higher, lower = kind.pairs(row, len(omega))
        self.count, self.headings = len(lower), len(headings)
        place, a, b = (part.ravel() for part in np.indices((self.count, self.headings, self.headings)))
        self.one, self.two = higher[place] * self.headings + a, lower[place] * self.headings + b
        self.waves = (omega[higher[place]], headings[a]), (kind.negative(omega[lower[place]]), headings[b])

    def shaped(self, values):
        return values.reshape(self.count, self.headings, self.headings, -1)


def _bound(pairs, run, waves):
    """(q, 6) of bound waves"""
    problem = waves.problem
    bound = bound_waves(*pairs.waves, problem.depth, problem.gravity)
    return bound.amplitude[:, None] * (waves.long_waves(run, bound.number) @ problem.transform.T)
