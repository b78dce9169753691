"""Force of pairs of waves on a body, at the difference or the sum (`kinds`) of the two frequencies, part by part.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        T = squares + bound wave + body + surface

squares : forces of products of first-order pressures and motions (`mean_drift`, `rotations`); at equal waves the mean
    drift. The far field gives mean surge, sway and yaw drift more accurately than the pressure. The difference at
    equal frequencies is added to other pairs in proportion to the similarity of their flows on the hull
    (`_by_far_field`)
bound wave : force of the second-order incident wave and its diffraction (`bound_waves`, `long_wave_forces`)
body : force of the potential that the hull, moving in the first-order flow, makes (`body_forces`); zero for a fixed
    body
surface : force of the potential that products of first-order waves make on the surface around the body
    (`surface_forces`). The surface part takes most of the time and is computed only on request; on a cylinder on the
    bed it is 0.4 to 6 % of the force (`tests/bench/bound_waves.py`)

Frequencies are evenly spaced, so that differences and sums have only a few values.
"""

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
PLACES = np.array([0.2, 0.5, 0.8])  # places in the band of the pairs that estimate the forcing of the free surface
PARTS = ("squares", "bound_wave", "body", "surface")
BLOCK = 8  # frequencies of the force solved together: the waves on the surface are summed once for them


@dataclass(frozen=True, eq=False)
class QuadraticForces:
    """T of pairs (ω', βᵢ; ω, βⱼ) of a frequency Ω, ω' = ω + Ω, or in sums ω' = Ω − ω ≥ ω; N/m², N m/m² about the
    rotation centre.  If the two waves are exchanged, T becomes its conjugate; for sums T does not change.

    omega : evenly spaced frequencies, rad/s, (n,); headings : rad, (m,) frequency : frequencies of the force with the
        spacing of omega, rad/s, (d,): differences from 0, or sums from twice the lowest frequency
    squares, bound_wave, body, surface : parts of T at Ω and ω, complex, (d, n, m, m, 6); NaN where ω' does not exist,
        or, for sums, where ω' < ω; surface is None if not computed
    added : drift by far field minus drift by pressure at equal frequencies in surge, sway and yaw, N/m² and N m/m²,
        (n, m, m, 3), included in `squares`, or None if unknown
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
        """The whole transfer function; shape (d, n, m, m, 6)"""
        return self.to_body + (0.0 if self.surface is None else self.surface)

    @classmethod
    def joined(cls, several):
        """The `QuadraticForces` of the same waves for several ranges of force frequencies, joined in order"""
        parts = {part: [getattr(forces, part) for forces in several] for part in ("frequency", *PARTS)}
        return replace(several[0], **{part: None if v[0] is None else np.concatenate(v) for part, v in parts.items()})

    def first(self, count):
        """The forces at the first `count` force frequencies"""
        parts = {part: None if (v := getattr(self, part)) is None else v[:count] for part in PARTS}
        return replace(self, frequency=self.frequency[:count], **parts)

    @property
    def to_body(self):
        """The transfer function without the free-surface forcing; shape (d, n, m, m, 6)"""
        return self.squares + self.bound_wave + self.body


def quadratic_forces(
    problem, omega, headings, highest, moving, report=lambda part, done, of: None, surface=False, kind=DIFFERENCE
):
    """`QuadraticForces` of a `bem.methods.panel_problem.PanelProblem`, or of a `ShapeProblem` by the contour method.

    omega : evenly spaced frequencies, rad/s, (n,); headings : rad, (m,); highest : largest frequency of the force,
        rad/s
    moving : False for a fixed body, True for a free body, or stiffness of lines in addition to hydrostatics, (6, 6)
    report : function called as report("frequencies", solved, total) for the first-order solutions, then with "pairs"
    surface : whether the forcing of the surface is computed; kind : `kinds.DIFFERENCE` or `SUM`
    raises : ValueError for uneven frequencies, constant panels, zero draft, and a moving body without inertia; with
        `surface` also for a waterline that is not one curve around the body
    """
    return QuadraticRun(problem, omega, headings, highest, moving, report, surface, kind=kind).all()


class QuadraticRun:
    """Forces of wave pairs, computed for a few force frequencies at a time, from the lowest up, after all first-order
    waves.

    Arguments, errors and results are those of `quadratic_forces`, and in addition:
    swayed : motions about the rotation centre from another resolution, (n, m, 6), or None
    motions : motions of this run, (n, m, 6)
    by_motions : T of the products of first-order quantities with `swayed` minus T with `motions`, N/m², N m/m², (d,
        n, m, m, 6), or None
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
        """Ranges of up to BLOCK force frequencies that follow the first `done` frequencies, a multiple of BLOCK"""
        return [range(m, min(m + BLOCK, len(self.frequency))) for m in range(done, len(self.frequency), BLOCK)]

    def all(self):
        """`QuadraticForces` of all frequencies of the force"""
        return QuadraticForces.joined([self.solve(block) for block in self.blocks()])

    def _of(self, values, m):
        """Values for the force frequency m, shape (q, m, m, 6), from values (n, m, n, m, 6) of all pairs of waves"""
        one, two = self.kind.pairs(m, len(self.omega))
        return values[one, :, two]

    def _placed(self, values, m):
        """Values (q, m, m, 6) of the pairs of the force frequency m, placed in an array (n, m, m, 6) with NaN
        elsewhere"""
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
        """Force on the moving hull; shape (q, m, m, 6); made : `HullFlow` of its radiated waves, None for none"""
        if made is None:
            return pairs.shaped(np.zeros((len(pairs.one), self.squares.shape[-1]), complex))
        return pairs.shaped(self.waves.of_moving_hull(self.flow, pairs.one, pairs.two, made))

    def _tell(self, last):
        """Report that the pairs of the frequencies up to the number `last` are solved"""
        sizes = [len(self.kind.pairs(m, len(self.omega))[0]) for m in range(len(self.frequency))]
        done, of = sum(sizes[: last + 1]), sum(sizes)
        each = len(self.headings) ** 2
        self.report("pairs", each * done, each * of)


def frequencies_of(omega, highest, kind):
    """Force frequencies up to `highest`, rad/s, of pairs of evenly spaced frequencies (n,); shape (d,)

    raises : ValueError if the frequencies are not evenly spaced, or if no force frequency is below `highest`
    """
    steps = np.diff(omega)
    if len(omega) < 2 or np.ptp(steps) > EVEN * steps.mean() or steps.mean() <= 0:
        raise ValueError(
            "forces of wave pairs need two or more frequencies that increase at equal steps; the given "
            "frequencies do not"
        )
    found = kind.rows(omega, highest)
    if not len(found):
        lowest = kind.of(omega[0], omega[0])
        raise ValueError(
            f"{kind.name}s of frequencies are requested up to {highest:.4g} rad/s; allowed: {lowest:.4g} or above"
        )
    return found


def _by_far_field(squares, far, flow):
    """Excess of the far field (n, m, m, 3) over `squares` (n, m, n, m, 6) at equal frequencies, added to these.

    The error of the pressure is, like the force, linear in each of the two flows u on the hull.  The projection of uⱼ
    on uᵢ is uᵢ⟨uⱼ, uᵢ⟩/⟨uᵢ, uᵢ⟩, and the pair (i, j) has the same multiple of the error of (i, i): the mean of this and
    of the corresponding value from (j, j), which decreases as the flows become different, at resonance of one of them
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
    """Likeness ⟨uᵢ, uⱼ⟩ = ∬ uᵢ·ūⱼ dS over the hull of the waves of each heading, m⁴/s²; shape (n, n, m)"""
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
    """Share of the surface forcing in the surge and sway force: root mean square over a few pairs.

    Arguments are those of `quadratic_forces`. The pairs lie at PLACES in the band, half the largest difference apart,
    in waves of the first heading.
    """
    omega, parts = np.asarray(omega, float), []
    apart = min(highest, np.ptp(omega)) / 2
    for middle in omega[0] + apart / 2 + PLACES * (np.ptp(omega) - apart):
        pair = middle + apart * np.array([-0.5, 0.5])
        found = quadratic_forces(problem, pair, np.atleast_1d(headings)[:1], 1.5 * apart, moving, surface=True)
        parts.append(_sizes(found))
    return _ratio(np.array(parts))


def share_of(forces):
    """Root mean square of the surface part over that of the whole force, in surge and sway, for pairs of equal
    headings"""
    return _ratio(_sizes(forces))


def panel_errors(forces, coarser, refinement, by_motions=None):
    """Estimated errors of the whole force from its value on a coarser mesh, N/m², N m/m²; shape (d, n, m, m, 6)

    Two meshes alone estimate errors poorly: the difference can be small by chance where an error passes through zero.
    The estimate is therefore a geometric mean of root mean squares, each over a pair and its neighbours in mean and
    difference frequency. In heave, roll and pitch the factors are the difference between the meshes (divided
    according to its order, and counted as two factors), the squares, and the whole force. In surge, sway and yaw the
    factors are this difference, the squares, the `added` part of the squares, and the difference on the diagonal,
    which is that of the far field.
    In heave, roll and pitch the square of this error is added to the square of the effect of motion errors, which is
    large near resonance. `tests/bench/pair_errors.py` prints the share of errors within a factor of three.
    Two meshes of different proportions, or with equal panels in one direction, give a poorer estimate.
    coarser : whole force on the coarser mesh, (d, n, m, m, 6); refinement : number of panels over that of the coarser
        mesh
    by_motions : change of the squares on the coarser mesh by the motions of the finer mesh, (d, n, m, m, 6), or None
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
    """Means of values (n, m, m, 3) of both waves of each pair; shape (*shape, 3)"""
    out = np.full((*shape, values.shape[-1]), np.nan)
    for m in range(len(out)):
        count = len(values) - m
        out[m, :count] = 0.5 * (values[m:] + values[:count])
    return out


def resolution_errors(forces, coarser):
    """Estimated errors of forces by the contour method; shape (d, n, m, m, 6)

    coarser : whole force at ten times the tolerance, (d, n, m, m, 6).
    The estimate is the root mean square, over a pair of waves and its neighbours, of the difference between the two
    forces. This difference exceeds the error of the finer result.
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
    first = 1 if forces.kind is DIFFERENCE else 0  # the mean drift has no surface part
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
    """All pairs of waves of one force frequency, by the indices of their waves, and of two headings each

    waves : frequencies and directions of both waves, as arguments of `bound_waves`
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
    """Transfer function of bound waves; shape (q, 6)"""
    problem = waves.problem
    bound = bound_waves(*pairs.waves, problem.depth, problem.gravity)
    return bound.amplitude[:, None] * (waves.long_waves(run, bound.number) @ problem.transform.T)
