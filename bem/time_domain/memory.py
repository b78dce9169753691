"""The memory of the water as a linear system for integration in time, which dissipates energy in every motion.

    (M + A(∞)) ν̇ + y + … = F,    ẋ = a x + b ν,    y = c x,    c (−iω − a)⁻¹ b ≈ B + iω [A(∞) − A]

with velocities ν (6,) about the rotation centre, in axes of the body. For N bodies ν contains (6N,) velocities, body
by body, about the rotation centre and in the axes of each body, followed by the velocities of shapes of flexible
bodies; the whole system is passive.  The n states x are r states that decay and p pairs of states that oscillate and
decay, r + 2p = n. The r states come first, then the first states of the pairs, then their second states:

    ẋ_k = −decay_k x_k + Σ_j input_jk ν_j                                            k < r
    ẋ_k = −decay_k x_k + turn_i x_{k+p} + Σ_j input_jk ν_j,                          k = r + i, i < p
    ẋ_{k+p} = −decay_k x_{k+p} − turn_i x_k + Σ_j input_j,k+p ν_j
    y_j = Σ_k output_jk x_k

Motions that symmetry uncouples have separate states.  Damping at every frequency and A(∞) come from `whole_axis`, and
the poles from `rational`. The output follows from a matrix P ≥ 0 such that (`passive_fit`)

    d/dt ½ xᵀP x = yᵀν − ½ |lossᵀ x|²,    y = 0 in steady motion.

`fewest_states` finds the fewest states within tolerance.
"""

from dataclasses import dataclass
from typing import NamedTuple
from warnings import warn

import numpy as np

from ..database.reader import Reader, reader, without_rows
from ..kernels.threads import blas_threads
from ..modes import words_of
from .fewest_states import fewest_states
from .memory_kernels import MemoryArrays
from .sensitivity import sensitivity
from .whole_axis import Causal, WholeAxis, ends_of, whole_axis, without_negative

FEWEST = 8  # frequencies
POINTS = 800  # points of the band, linear in between
STILL = 1e-4  # √ of the impedance of a motion that moves no water, relative to the largest of its kind
FACETS = 1e-3, 1e-4  # change of A and B/ω over the band, relative to M + A, that are none: yaw of a mesh of revolution
SHORTER = (0.9, 0.8, 0.7, 0.6, 0.5)  # fractions of the band tried if its upper end contradicts the rest
SPREAD = (30.0, 8.0)  # range of the fit below and above the band, as a factor
FELT = 0.05  # error scale over ω (M + A), for motions that radiate little, such as heave of a semi-submersible
CLOSE = (0.03, 0.1)  # deviation of the fitted transform from the database: above these it is reported, refused
WORTH = 1 / 30  # of a deviation: a nearer fit follows the database no better, and may take a minute to be given up
SAME = 1e-7  # relative difference of the transforms of two groups that are one


@dataclass(frozen=True, eq=False)
class Memory(Causal):
    """The linear system of this module, its stored and lost energy, and its errors relative to the database.

    arrays : `MemoryArrays`
    storage : P, J for each squared unit of the states, (n, n); loss : matrix of the lost power ½ |lossᵀx|², W, (n, q)
    added_mass_infinity : stored added mass or that by causality, kg …, (6, 6)
    error : largest difference of the system from the fitted transform, from ω = 0 to beyond the band, divided by √(ii
        · jj) of the largest transform, (6, 6); 0 for couplings that are neglected as noise
    deviation : largest difference of the fitted transform from the database in its band, in the unit of error, (6, 6);
        the sum error + deviation bounds the difference of the system from the database
    band : first and last stored frequency, rad/s; groups : indices of coupled motions; words : names of the motions
    """

    arrays: MemoryArrays
    storage: np.ndarray
    loss: np.ndarray
    added_mass_infinity: np.ndarray
    error: np.ndarray
    deviation: np.ndarray
    band: tuple
    groups: tuple
    words: tuple = words_of(())

    def __repr__(self):
        names = "; ".join(", ".join(self.words[i] for i in group) for group in self.groups)
        return f"<Memory {self.states} states ({names}), error {self.error.max():.1e}>"

    @property
    def states(self):
        """Number of states n"""
        return len(self.arrays.decay)

    @property
    def matrices(self):
        """Matrices of the system: a, 1/s, (n, n), b, (n, 6), and c, (6, n)"""
        decay, turn, into, out = self.arrays
        n, p = self.states, len(turn)
        a, first = -np.diag(decay), n - 2 * p + np.arange(p)
        a[first, first + p], a[first + p, first] = turn, -turn
        return a, into.T, out

    def rate(self, states, velocity):
        """ẋ (n,) from states (n,) and velocities (6,), m/s and rad/s, as the kernel `memory_rate` computes it"""
        a, b, _ = self.matrices
        return a @ states + b @ velocity

    def force(self, states):
        """Force y (6,), N and N m, against the motion, as the kernel `memory_force` computes it"""
        return self.arrays.output @ states

    def stored_energy(self, states):
        """Energy, J, stored in the water's motion by states (…, n), which the water returns"""
        return 0.5 * np.einsum("...i,ij,...j->...", states, self.storage, states)

    def lost_power(self, states):
        """Radiated power, W, of states (…, n)"""
        return 0.5 * np.sum((states @ self.loss) ** 2, axis=-1)

    def transform(self, omega):
        """Transform B + iω [A(∞) − A], kg/s …, (q, 6, 6), at omega (q,) rad/s"""
        return _transfer(self.arrays, np.atleast_1d(omega)).conj()

    def retardation(self, times):
        """Retardation function K, kg/s² …, (m, 6, 6), at times (m,) s"""
        left, right, rate = _complex_modes(self.arrays)
        decay = np.exp(np.multiply.outer(np.asarray(times, float), rate))
        return np.einsum("ik,qk,jk->qij", left, decay, right).real


class _Goal(NamedTuple):
    """What is fitted: axis (`WholeAxis`) of a band, transform (q, 6, 6) at (q,) rad/s, size (6,) of each motion, 0 of
    one without memory, scale its squares, deviation from the database, damping (n, 6, 6) of the band"""

    band: tuple
    axis: WholeAxis
    at: np.ndarray
    transform: np.ndarray
    size: np.ndarray
    scale: np.ndarray
    deviation: np.ndarray
    damping: np.ndarray


def memory_of_database(db, tolerance=1e-3, motions=None, goal=None):
    """`Memory` of a `bem.database.Database` or `Reader`, with the fewest states found within tolerance.

    tolerance : allowed error of the transform relative to its largest value for each motion, 1e-5 to 0.1; or WORTH
        times the deviation of coupled motions if this is larger
    motions : indices of the motions of a study, None for all; coefficients of other motions are neither read nor fitted
    goal : `goal_of_database` for these arguments, to save time for several tolerances; if None, computed here
    raises : ValueError if damping or added mass of these motions are unknown, or known at too few frequencies, or
    contradict each other because the band is too short; `fewest_states.FitError` if the tolerance is not reached
    """
    if not 1e-5 <= tolerance <= 0.1:
        raise ValueError(
            f"tolerance of the memory of the water (retardation functions) is {tolerance:g}; allowed: 1e-5 to 0.1"
        )
    body = db if isinstance(db, Reader) else reader(db)
    goal = goal_of_database(body, motions) if goal is None else goal
    with blas_threads(1):  # many small matrices; and the same bits for any number of threads
        return _memory(body, tolerance, goal)


def goal_of_database(body, motions=None):
    """The transform to which the memory of the `motions` of a `Reader` is fitted, at any tolerance

    raises : ValueError for too few frequencies
    """
    motions = range(len(body.words)) if motions is None else motions
    if len(body.omega) < FEWEST:
        raise ValueError(
            f"the memory of the water needs radiation at {FEWEST} or more frequencies, and {len(body.omega)} are "
            "stored; solve a band, such as --omega auto:0.1:2"
        )
    with blas_threads(1):
        goal = _goal(body, body.between.span, motions)
        if goal.deviation.max() > CLOSE[0]:
            goal = _shorter(body, goal, motions)
        return _by_causality(body, goal, motions) if goal.deviation.max() > CLOSE[1] else goal


def _memory(body, tolerance, goal):
    band, axis, at, wanted, size, scale, deviation, damping = goal
    _check_deviation(deviation, band, damping, size, body.words, _ringing(body))
    coupled = _relative(np.abs(wanted).max(axis=0), scale)
    groups = _groups(coupled > max(0.1 * tolerance, deviation.max() * (deviation.max() > CLOSE[0])))
    noise = ~_within(groups, len(size)) & (coupled > 0.1 * tolerance)
    _tell_neglected(coupled * noise, deviation.max(), body.words)
    answered = sensitivity(body, at, wanted, axis.added_mass_infinity, size, body.rigid)
    answered[(at < band[0]) | (at > band[1])] = 0.0  # damping outside the band is an assumed power law
    near = [max(tolerance, WORTH * deviation[np.ix_(group, group)].max()) for group in groups]
    parts = _parts(at, wanted, size, groups, near, answered, body.words)
    arrays, storage, loss = _joined(parts, groups, size)
    made = _transfer(arrays, at).conj()
    error = np.where(noise, 0.0, _relative(np.abs(made - wanted).max(axis=0), scale))
    return Memory(arrays, storage, loss, axis.added_mass_infinity, error, deviation, band, groups, body.words)


def no_memory(body):
    """`Memory` of a `Reader` without states, for runs that use coefficients at one frequency

    Few states cannot represent resonances of water in front of a wall; in such a run the added mass at the highest
    frequency replaces the added mass at infinite frequency.
    """
    band = body.between.span
    count = len(body.words)
    none, square = np.zeros((count, 0)), np.zeros((count, count))
    arrays = MemoryArrays(np.zeros(0), np.zeros(0), none, none)
    A = body.coefficients(np.array([band[1]]))[0][0]
    return Memory(arrays, np.zeros((0, 0)), np.zeros((0, 0)), A, square, square, band, (), body.words)


def _goal(body, band, motions, stored=True):
    """`_Goal` of a body in a band (low, high) rad/s; stored : whether the stored A(∞) is used"""
    omega = np.linspace(*band, POINTS)
    added_mass, damping = (0.5 * (x + x.swapaxes(1, 2)) for x in body.coefficients(omega, motions))
    still = _still(body, omega, added_mass, damping)
    moving = [i for i in motions if not still[i]]
    damping = without_rows(damping, np.flatnonzero(still))
    damping = without_negative(damping, damping)  # negative damping would add energy
    limit, monopole = ends_of(body, moving)
    limit = limit if stored else None
    if limit is not None:
        limit = np.where(np.diag(still), added_mass.mean(axis=0), limit)
    axis = whole_axis(omega, added_mass, damping, limit, monopole)
    at = _frequencies(axis, band)
    wanted = axis.transform(at)
    size = np.sqrt(np.abs(np.einsum("qii->qi", wanted)).max(axis=0))
    turns = body.turning
    size[still | (size <= STILL * np.where(turns, size[turns].max(), size[~turns].max()))] = 0.0
    scale = np.outer(size, size)
    inertia = np.zeros_like(scale) if body.inertia is None else body.inertia
    return _Goal(
        band, axis, at, wanted, size, scale, _deviation(axis, omega, added_mass, damping, scale, inertia), damping
    )


def _shorter(body, goal, motions, stored=True):
    """`_Goal` of the largest lower part of the band that is consistent, or the most consistent one"""
    (low, high), best = goal.band, goal
    for share in SHORTER:
        found = _goal(body, (low, low + share * (high - low)), motions, stored)
        best = min(best, found, key=lambda one: one.deviation.max())
        if best.deviation.max() <= CLOSE[0]:
            break
    if best.deviation.max() <= CLOSE[1] and best is not goal:
        warn(
            f"added mass and damping above {best.band[1]:.3g} rad/s contradict those at lower frequencies by "
            f"{goal.deviation.max():.2g} of the largest, recommended: {CLOSE[0]:g}; the memory of the "
            f"water uses the lower frequencies only; leave out the higher frequencies, or solve them to a smaller "
            f"tolerance" + _ringing(body),
            stacklevel=4,
        )
    return best


def _by_causality(body, goal, motions):
    """`_Goal` with A(∞) from damping by causality instead of the stored A(∞), if the band agrees with it; else `goal`

    Panels too coarse for short waves give a wrong A(∞): in the set of RM3 by WAMIT it is off by 3 % for the roll of
    a thin plate.
    """
    found = _goal(body, body.between.span, motions, stored=False)
    if found.deviation.max() > CLOSE[0]:
        found = _shorter(body, found, motions, stored=False)
    if found.deviation.max() > CLOSE[1]:
        return goal
    warn(
        f"the stored added mass at infinite frequency differs by {goal.deviation.max():.2g} of the largest from the "
        f"value that the stored frequencies imply; allowed: {CLOSE[1]:g}; the memory of the water uses the value that "
        f"follows from damping, from which the stored frequencies deviate by {found.deviation.max():.2g}",
        stacklevel=4,
    )
    return found


def _frequencies(axis, band):
    """Frequencies, rad/s, at which the memory is fitted, from far below the band to far above; shape (q,)"""
    low, high = band
    return axis.between(
        np.concatenate(
            [
                np.geomspace(low / SPREAD[0], low, 20)[:-1],
                np.linspace(low, high, 150),
                np.geomspace(high, high * SPREAD[1], 25)[1:],
            ]
        )
    )


def _still(body, omega, added_mass, damping):
    """Whether added mass and damping (n, 6, 6) of motions are negligible relative to the body's own inertia; shape
    (6N,)"""
    if body.inertia is None:
        return np.zeros(added_mass.shape[-1], bool)
    A, B = (np.einsum("nii->in", x) for x in (added_mass, damping))
    own = np.diag(body.inertia) + A.mean(axis=1)  # NaN of an unknown mass compares as false
    return (np.ptp(A, axis=1) <= FACETS[0] * own) & (B / omega <= FACETS[1] * own[:, None]).all(axis=1)


def _relative(values, scale):
    return np.divide(values, scale, out=np.zeros_like(values), where=scale > 0)


def _deviation(axis, omega, added_mass, damping, scale, inertia):
    """Deviation of the transform from the database, relative to scale (6, 6), or to FELT of ω (M + A) if that is more;
    shape (6, 6)"""
    at = slice(2, -2, 8)  # interior points: at the ends damping has a corner and added mass a logarithm
    middle = 0.5 * (omega[1:] + omega[:-1])[at]
    A, B = (0.5 * (x[1:] + x[:-1])[at] for x in (added_mass, damping))
    made = axis.transform(middle)
    given = B + 1j * middle[:, None, None] * (axis.added_mass_infinity - A)
    own = np.sqrt(np.maximum(np.diag(inertia) + np.einsum("qii->qi", A), 0.0)) * (np.diag(scale) > 0)
    felt = FELT * middle[:, None, None] * own[:, :, None] * own[:, None, :]
    return _relative(np.abs(made - given), np.maximum(scale, np.nan_to_num(felt))).max(axis=0)


def _ringing(body):
    return "; give [[damping_lids]] to the moonpool or gap with resonant water" if len(body.between.ringing) else ""


def _check_deviation(deviation, band, damping, size, words, ringing=""):
    worst = deviation.max()
    if worst <= CLOSE[0]:
        return
    i, j = np.unravel_index(deviation.argmax(), deviation.shape)
    ends = [x[i, i] / size[i] ** 2 if size[i] > 0 else 0.0 for x in (damping[0], damping[-1])]
    line = (
        f"added mass and damping from {band[0]:.3g} to {band[1]:.3g} rad/s contradict each other by {worst:.2g} of the "
        f"largest ({words[i]}–{words[j]}); allowed: {CLOSE[1]:g}, good: {CLOSE[0]:g}; damping of "
        f"{words[i]} is {ends[0]:.2g} of the largest at the lower end and {ends[1]:.2g} at the upper: extend "
        "the band there, or solve to a smaller tolerance" + ringing
    )
    if worst > CLOSE[1]:
        raise ValueError(line)
    warn(line, stacklevel=4)


def _groups(coupled):
    """Sets of motions that are coupled (6, 6), directly or through others, as tuples"""
    found, left = [], [i for i in range(len(coupled)) if coupled[i, i]]
    while left:
        group = {left[0]}
        while True:
            wider = group | {j for i in group for j in left if coupled[i, j]}
            if wider == group:
                break
            group = wider
        found.append(tuple(sorted(group)))
        left = [i for i in left if i not in group]
    return tuple(found)


def _within(groups, count):
    """Whether two motions belong to one group; shape (count, count)"""
    found = np.zeros((count, count), bool)
    for group in groups:
        found[np.ix_(group, group)] = True
    return found


def _tell_neglected(coupled, deviation, words):
    """Warn of couplings (6, 6) that are neglected, 0 of others, since the numbers contradict each other by more"""
    if coupled.any():
        i, j = np.unravel_index(coupled.argmax(), coupled.shape)
        warn(
            f"the memory of the water neglects couplings of up to {coupled.max():.2g} of the largest ({words[i]}–"
            f"{words[j]}): added mass and damping contradict each other by {deviation:.2g}, so that weaker "
            "couplings are noise",
            stacklevel=4,
        )


def _parts(omega, wanted, size, groups, near, answered, words):
    """`Passive` of each group of coupled motions, within its tolerance in `near`

    Surge with pitch and sway with roll of a round or square body are one system but for signs: two fits of it would
    differ by the tolerance, and such a body would not move along the waves.
    """
    parts = []
    for n, group in enumerate(groups):
        own = wanted[np.ix_(range(len(omega)), group, group)]
        for before, part in zip(groups[:n], parts, strict=True):
            signs = _signs(wanted[np.ix_(range(len(omega)), before, before)], own)
            if signs is not None and np.allclose(answered[:, before], answered[:, group], rtol=SAME):
                parts.append(part._replace(input=part.input * signs, output=part.output * signs))
                break
        else:
            parts.append(fewest_states(omega, own, size[list(group)], group, near[n], answered[:, group], words))
    return parts


def _signs(one, other):
    """(m, 1) signs of motions with which a transform (q, m, m) is another one, None if it is not"""
    if one.shape != other.shape:
        return None
    signs = np.where(np.sum((one[:, 0].conj() * other[:, 0]).real, axis=0) < 0, -1.0, 1.0)
    size = np.sqrt(np.abs(np.einsum("qii->qi", one)).max(axis=0))
    same = np.abs(other - np.outer(signs, signs) * one).max(axis=0) <= SAME * np.outer(size, size)
    return signs[:, None] if same.all() else None


def _joined(parts, groups, size):
    """`MemoryArrays`, storage, loss of all groups, in the order of the module"""
    alone = [len(part.decay) - 2 * len(part.turn) for part in parts]
    n, pairs = sum(len(part.decay) for part in parts), sum(len(part.turn) for part in parts)
    decay, turn = np.zeros(n), np.concatenate([part.turn for part in parts] or [np.zeros(0)])
    into, out = np.zeros((2, len(size), n))
    storage, loss = np.zeros((n, n)), np.zeros((n, sum(len(group) for group in groups)))
    r, p, q = 0, 0, 0
    for part, group, real in zip(parts, groups, alone, strict=True):
        group, count = list(group), len(part.turn)
        first = sum(alone) + p + np.arange(count)
        place = np.concatenate([r + np.arange(real), first, first + pairs])
        decay[place] = part.decay
        into[np.ix_(group, place)] = part.input * size[group][:, None]
        out[np.ix_(group, place)] = part.output * size[group][:, None]
        storage[np.ix_(place, place)] = part.storage
        loss[np.ix_(place, q + np.arange(len(group)))] = part.loss
        r, p, q = r + real, p + count, q + len(group)
    return MemoryArrays(decay, turn, into, out), storage, loss


def _complex_modes(arrays):
    """Outputs (m, r + p), inputs (m, r + p), rates (r + p,): twice the real part of pairs is in the outputs"""
    decay, turn, into, out = arrays
    n, p = len(decay), len(turn)
    r = n - 2 * p
    rate = np.concatenate([-decay[:r] + 0j, -decay[r : r + p] + 1j * turn])
    left = np.concatenate([out[:, :r], out[:, r : r + p] + 1j * out[:, r + p :]], axis=1)
    right = np.concatenate([into[:, :r], into[:, r : r + p] - 1j * into[:, r + p :]], axis=1)
    return left, right, rate


def _transfer(arrays, omega):
    """c (iω − a)⁻¹ b (q, m, m)"""
    left, right, rate = _complex_modes(arrays)
    r = len(rate) - len(arrays.turn)
    gain = 1 / (1j * omega[:, None] - rate)
    back = 1 / (1j * omega[:, None] - rate[r:].conj())
    first = np.matmul(left * gain[:, None], right.T)
    # a pair is ½ of its mode and ½ of the conjugate one
    half = np.matmul(left[:, r:] * gain[:, None, r:], right[:, r:].T)
    other = np.matmul(left[:, r:].conj() * back[:, None], right[:, r:].conj().T)
    return first + 0.5 * (other - half)
