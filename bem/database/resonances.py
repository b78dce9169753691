"""Resonances of a body in a database: peaks of its motions that may lie between stored frequencies, and their height.

    C q = ω² (M + A(ω)) q,    ζ = q*(B + B′)q / 2ω q*(M + A)q

Eigenvalues λⱼ(ω) of C and M + A, in rising order, are continuous in frequency. Every root of √λⱼ(ω) = ω therefore
lies between two neighbouring frequencies at which √λⱼ − ω has different signs.  A lightly damped motion follows
1 / (2ζ) at the root and has half the energy at ω (1 ± ζ). This width, not the step of stored frequencies, determines
the frequencies at which the motion is needed.
Coefficients are smooth at a peak and come from `between_frequencies`. The height of a peak, and the uncertainty of
this height, depend on damping alone.
"""

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from .between_frequencies import FEWEST, BetweenError

SHARP = 0.25  # damping ratio above which a peak is less than twice the static motion
AROUND = 2.0 ** np.arange(-3, 8)  # places on both sides of a peak, in units of its width
WIDEST = 0.3  # largest relative distance from a frequency, on both sides
CLOSE = 1e-11  # relative accuracy of a natural frequency: interpolated added mass has rounding errors of 1e-12
MOST = 100
LEAST = 1e-9  # smallest inertia considered, relative to the largest
STEPS = 4  # places between two stored frequencies
NEAR = 1e-3  # distance, in the smallest width of all peaks, below which two places tell the same
QUIET = 1e-3  # smallest peak reported, relative to the largest motion of its kind


@dataclass(frozen=True)
class Resonance:
    """A peak of the motion with index `mode` and name `name`, at omega rad/s in waves towards `heading` rad.

    peak : m/m or rad/m; error : its estimated error between stored frequencies; damping : ratio ζ
    viscous : whether this motion has damping in addition to wave radiation
    """

    mode: int
    omega: float
    damping: float
    peak: float
    error: float
    heading: float
    viscous: bool
    name: str

    def __repr__(self):
        return f"<Resonance {self.name} {self.omega:.4g} rad/s, peak {self.peak:.3g}, damping {self.damping:.2g}>"

    @property
    def period(self):
        """s"""
        return 2 * np.pi / self.omega


def resonances(body):
    """[Resonance] of a `reader.Reader` within its stored frequencies, rising; [] if its motions are unknown.
    The list contains only resonances that have a damping ratio below a quarter and that waves of the stored headings
    excite.
    """
    if body not in _FOUND:
        _FOUND[body] = _resonances(body)
    return list(_FOUND[body])


_FOUND = WeakKeyDictionary()  # a study asks for them to choose frequencies, and to tell them


def _resonances(body):
    if len(body.omega) < FEWEST or body.inertia is None or body.stiffness is None:
        return []
    try:
        found = [_resonance(body, *root) for root in _roots(body)]
    except (BetweenError, np.linalg.LinAlgError, FloatingPointError):  # no positive inertia, no viscous equilibrium
        return []
    return sorted((one for one in found if one is not None and one.damping < SHARP), key=lambda one: one.omega)


def about(body, found, beside=()):
    """Frequencies that show the shape of each peak of `found`, within the stored frequencies, rad/s; shape (q,)

    beside : frequencies that are known already, rad/s, (p,)
    Roll and pitch of a round body resonate at one frequency except for rounding. A frequency too near to an earlier
    one, or to a frequency of `beside`, is left out, so that splines can pass through the remaining frequencies.
    """
    low, high = body.between.span
    omega = np.concatenate([[], *(_places(one.omega, one.damping) for one in found)])
    least = NEAR * min((max(one.damping, LEAST) for one in found), default=0.0)
    kept = []
    for place in np.unique(omega[(omega > low) & (omega < high)]):
        near = [*kept[-1:], *beside]
        if not near or np.abs(np.array(near) - place).min() > least * place:
            kept.append(place)
    return np.array(kept)


def natural_modes(inertia, stiffness):
    """λ (…, n) rising and vectors, in columns (…, n, n), of symmetric inertia (…, n, n) and stiffness (n, n)"""
    root = np.linalg.inv(np.linalg.cholesky(inertia))
    values, vectors = np.linalg.eigh(root @ stiffness @ root.swapaxes(-1, -2))
    return values, root.swapaxes(-1, -2) @ vectors


def positive(inertia):
    """Symmetric inertia (…, n, n) in which the smallest positive eigenvalue replaces all eigenvalues that are not
    positive

    At resonance of the water in a gap or a moonpool, negative added mass exceeds the mass of the body. λ then grows
    without limit towards this frequency, and the search continues beyond it.
    """
    values = np.linalg.eigvalsh(inertia)
    if np.all(values[..., 0] > 0):
        return inertia
    values, vectors = np.linalg.eigh(inertia)
    values = np.maximum(values, LEAST * values[..., -1:])
    return (vectors * values[..., None, :]) @ vectors.swapaxes(-1, -2)


def by_motion(energies):
    """Index of the mode of each motion, by the assignment with the largest sum of energy shares; shape (n,); −1 for
    none.

    energies : kinetic energy of each motion in each mode, (m, n); links make m smaller than n
    """
    shares = energies / energies.sum(axis=1, keepdims=True)
    modes, motions = np.arange(len(shares)), np.argmax(shares, axis=1)
    if len(np.unique(motions)) < len(motions):  # otherwise every mode has the motion it has most of: no sum is larger
        from scipy.optimize import linear_sum_assignment

        modes, motions = linear_sum_assignment(shares, maximize=True)
    found = np.full(shares.shape[1], -1)
    found[motions] = modes
    return found


def zeros(functions, low, f, high, g):
    """Zeros ω of m nearly straight functions that have the values f at low (m,) and g at high (m,); shape (m,)

    functions : (m,) → (m,)
    The method is a secant within a bracket: if an end of the bracket stays for a second step, its value is halved
    (Illinois; Dowell and Jarratt, BIT 11, 1971). Three steps square the error.
    """
    last, x = np.zeros(len(low)), high
    for _ in range(MOST):
        x = (low * g - high * f) / np.where(f == g, 1.0, g - f)
        y = functions(x)
        if np.all(np.abs(y) <= CLOSE * np.abs(x)):
            break
        upper = np.sign(y) == np.sign(g)
        low, f, high, g = (
            np.where(upper, low, x),
            np.where(upper, np.where(last > 0, 0.5, 1.0) * f, y),
            np.where(upper, x, high),
            np.where(upper, y, np.where(last < 0, 0.5, 1.0) * g),
        )
        last = np.where(upper, 1.0, -1.0)
    return x


def _roots(body):
    """Return (mode, ω) of every natural frequency within the stored ones"""
    knots = np.arange(len(body.omega))
    omega = np.interp(np.arange((len(knots) - 1) * STEPS + 1) / STEPS, knots, body.omega)
    excess = _excess(body, omega)
    i, j = np.nonzero((excess[:-1] > 0) & (excess[1:] <= 0) | (excess[:-1] < 0) & (excess[1:] >= 0))
    found = zeros(lambda w: _excess(body, w)[range(len(j)), j], omega[i], excess[i, j], omega[i + 1], excess[i + 1, j])
    _, vectors, M = _modes(body, found)
    energies = np.abs(vectors.swapaxes(1, 2) * (M @ vectors).swapaxes(1, 2))
    for w, number, own, shapes in zip(found, j, energies, vectors, strict=True):
        yield int(np.flatnonzero(by_motion(own) == number)[0]), float(w), shapes[:, number]


def _excess(body, omega):
    """Difference √λ − ω of each mode; shape (q, n)"""
    return np.sqrt(np.maximum(_modes(body, omega)[0], 0)) - omega[:, None]


def _modes(body, omega):
    M = body.inertia + body.held_added_mass(omega)
    M = positive(0.5 * (M + M.swapaxes(1, 2)))
    return *free_modes(body.free, M, 0.5 * (body.stiffness + body.stiffness.T)), M


def free_modes(free, inertia, stiffness):
    """`natural_modes` of the motions permitted by links, columns of `free` (n, m); None for all motions

    The vectors (…, n, m) contain all motions.
    """
    if free is None:
        return natural_modes(inertia, stiffness)
    values, vectors = natural_modes(free.T @ inertia @ free, free.T @ stiffness @ free)
    return values, free @ vectors


def _resonance(body, mode, omega, q):
    """The Resonance of a natural mode q (n,), or None if waves do not excite it"""
    low, high = body.between.span
    ratio = _ratio(body, omega, q, 0.0)
    damping = max(ratio, 1e-9)
    if abs(ratio) >= SHARP:  # far below 0 where coefficients beyond the resolution of the panels supply energy
        return None
    places = np.clip(_places(omega, damping), low, high)
    for _ in range(2):
        X = np.abs(body.motions(places))
        i, m = np.unravel_index(X[:, :, mode].argmax(), X.shape[:2])
        at, peak = places[i], float(X[i, m, mode])
        places = np.linspace(places[max(i - 1, 0)], places[min(i + 1, len(places) - 1)], 17)
    kind = np.flatnonzero(body.turning == body.turning[mode])
    if peak <= QUIET * np.abs(body.motions(body.omega))[:, :, kind].max():
        return None
    extra = np.zeros_like(body.damping)
    if body.viscous:
        extra = body.viscous.damping(at, body.viscous.wave_amplitude * X[i, m])
    error = body.at([at], "rao")[1][0, m, mode]
    return Resonance(
        mode, float(at), _ratio(body, omega, q, extra), peak, float(error), float(body.headings[m]),
        bool(extra[mode, mode] + body.damping[mode, mode] > 0), body.words[mode],
    )  # fmt: skip


def _ratio(body, omega, q, extra):
    """ζ of a mode q (n,)"""
    A, B = (part[0] for part in body.coefficients([omega]))
    return float(q @ (B + body.damping + extra) @ q / (2 * omega * (q @ (body.inertia + A) @ q)))


def _places(omega, damping):
    away = np.unique(np.minimum(damping * AROUND, WIDEST))
    return omega * np.concatenate([1 - away[::-1], [1.0], 1 + away])
