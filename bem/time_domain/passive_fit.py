"""Passive linear systems that approximate a matrix function of frequency.

    ẋ = A x + B u,    y = C x,    C = BᵀP,    AᵀP + P A = −L Lᵀ,    Lᵀ A⁻¹ B = 0

dissipates energy in every motion, since d/dt ½ xᵀP x = yᵀu − ½ |Lᵀx|² (Kalman, Yakubovich and Popov): for any L,
energy that is not stored in P ≥ 0 is lost.  At s = iω the Hermitian part of H = C (s − A)⁻¹ B is ½ VᴴV with V = Lᵀ (s −
A)⁻¹ B. The condition Lᵀ A⁻¹ B = 0 makes this part zero at ω = 0: steady motion has no resistance.  A and B are known
by their modes. L (n, m) is found by least squares of H over samples, one of which is H(0) = 0 with a large weight, by
the method of Gauss and Newton with Levenberg's and Marquardt's damping.
In coordinates z of the modes, A = diag λ, P is
Pₖₗ = −(L Lᴴ)ₖₗ / (λ̄ₖ + λₗ), and derivatives of H with respect to L are products of matrices.  If the fit is then
nearly within tolerance, modes and L are adjusted together (`moving_poles`).
"""

from typing import NamedTuple

import numpy as np

from .moving_poles import Moving, moved, real_basis, storage, transfer

ROUNDS = 80
STEADY = 300.0  # weight of H(0) = 0, whose skew part is not zero by itself
# relative gain in squares below which rounds end; ENOUGH_AFAR for a fit that misses its tolerance by a factor NEAR
ENOUGH, ENOUGH_AFAR, NEAR = 1e-3, 1e-2, 1.5
HOPELESS = 1.2  # error over the tolerance; least squares of all entries then cannot reduce the largest enough
# largest error over the tolerance of a fit whose modes are moved, and its largest number of inputs: a round takes 10 ms
# with two, a second with six
MOVABLE, MOVED = 8.0, 3
DAMPINGS = (1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3)  # initial damping values, relative to the largest
REAL = 1e-10  # relative imaginary part below which a mode is real


class Passive(NamedTuple):
    """A passive system in real modes: first the modes that only decay, then pairs of modes that also oscillate.

    decay : 1/s, (n,); turn : frequency of each pair k, rad/s, (p,), whose states are r + k and r + p + k with r = n −
        2p
    input, output : (m, n); storage : P, (n, n); loss : L, (n, m)
    """

    decay: np.ndarray
    turn: np.ndarray
    input: np.ndarray
    output: np.ndarray
    storage: np.ndarray
    loss: np.ndarray


class _Modes(NamedTuple):
    """λ (n,), B (n, m) in modes, and the unitary matrix (n, n) from real states to them"""

    rate: np.ndarray
    input: np.ndarray
    basis: np.ndarray
    pairs: int


def passive_fit(A, B, s, H, tolerance=0.0, weight=None):
    """`Passive` that approximates H (q, m, m) at s (q,) = iω, with the modes of a stable A (n, n), B (n, m), n > m

    tolerance : error of H, times weight (q, m, m), at which the fit ends; the modes may be adjusted to reach it. 0: the
        best fit with unchanged modes; weight : None: 1
    returns : the `Passive` and its largest weighted error. If an output without the condition P ≥ 0 already has an
        error clearly beyond the tolerance, None and this error
    """
    weight = np.ones(H.shape) if weight is None else weight
    modes = _modes(A, B)
    problem = _Problem(modes, s, H, weight)
    output, miss = problem.output()
    if tolerance > 0 and miss > HOPELESS * tolerance:
        return None, miss
    Z = _least_squares(problem, problem.start(output), tolerance)
    system = Moving(modes.rate, modes.input, problem.columns @ Z, modes.pairs)
    if tolerance > 0 and H.shape[1] <= MOVED and 1 < problem.worst(Z) / tolerance <= MOVABLE:
        system = moved(system, problem.s, problem.wanted, problem.weights / tolerance)
    return _passive(system, modes.basis), np.abs((transfer(system, s) - H) * weight).max()


def _passive(system, basis):
    rate, into, loss, pairs = system
    P, back, alone = storage(system), basis.conj().T, len(rate) - 2 * pairs
    return Passive(
        -rate.real,
        rate.imag[alone : alone + pairs],
        (back @ into).real.T,
        (into.conj().T @ P @ basis).real,
        (back @ P @ basis).real,
        (back @ loss).real,
    )


def _modes(A, B):
    rate, vectors = np.linalg.eig(A)
    b = np.linalg.solve(vectors, B.astype(complex))
    alone = np.abs(rate.imag) <= REAL * np.abs(rate)
    upper = ~alone & (rate.imag > 0)
    # a real mode has real inputs except for one factor, which its vector may have
    largest = b[alone][np.arange(alone.sum()), np.abs(b[alone]).argmax(axis=1)]
    single = (b[alone] * np.conj(largest / np.abs(largest))[:, None]).real
    r, p = int(alone.sum()), int(upper.sum())
    rate = np.concatenate([rate[alone].real, rate[upper], rate[upper].conj()])
    b = np.concatenate([single, b[upper], b[upper].conj()])
    b = b * (np.sqrt(-2 * rate.real) / np.linalg.norm(b, axis=1))[:, None]
    return _Modes(rate, b, real_basis(r, p), p)


class _Problem:
    """H of unknown Z (a, m), with L = free Z in real states, and its derivatives"""

    def __init__(self, modes, s, H, weight):
        self.s = s = np.append(0.0, s)
        self.modes, self.weights = modes, np.concatenate([np.full_like(weight[:1], STEADY), weight])
        self.wanted = np.concatenate([np.zeros_like(H[:1]), H])
        n, m = modes.input.shape
        self.sums = -1 / (modes.rate.conj()[:, None] + modes.rate)
        self.response = (modes.input[:, None, :] / (s[:, None] - modes.rate[:, None, None])).reshape(n, -1)
        steady = (modes.basis.conj().T @ (modes.input / modes.rate[:, None])).real  # A⁻¹ B
        self.free = np.linalg.svd(steady)[0][:, m:]
        self.columns = modes.basis @ self.free
        paired = modes.input.conj().T[:, None, :] * self.columns.T
        self.left = paired.reshape(-1, n)

    def transfer(self, Z):
        """H (q, m, m)"""
        loss = self.columns @ Z
        P = (loss @ loss.conj().T) * self.sums
        m = Z.shape[1]
        return (self.modes.input.conj().T @ P @ self.response).reshape(m, -1, m).swapaxes(0, 1)

    def misses(self, Z):
        """Real and imaginary parts of the differences from the wanted values, in one row"""
        off = ((self.transfer(Z) - self.wanted) * self.weights).ravel()
        return np.concatenate([off.real, off.imag])

    def worst(self, Z):
        """Largest weighted difference"""
        return np.hypot(*np.split(self.misses(Z), 2)).max()

    def slopes(self, Z):
        """Derivatives of the differences with respect to the unknowns; shape (unknowns, differences)"""
        a, m = Z.shape
        loss, B = self.columns @ Z, self.modes.input.conj()
        out = []
        for column in loss.T:
            first = self.left @ ((self.sums * column.conj()) @ self.response)
            weight = (B * column[:, None]).T @ self.sums
            second = (weight[:, None, :] * self.columns.conj().T).reshape(m * a, -1) @ self.response
            part = (first + second).reshape(m, a, -1, m).transpose(1, 2, 0, 3) * self.weights
            part = part.reshape(a, -1)
            out.append(np.concatenate([part.real, part.imag], axis=1))
        return np.stack(out, axis=1).reshape(a * m, -1)

    def output(self):
        """Least-squares output C (m, n) with these modes without the condition P ≥ 0, and its largest weighted
        difference"""
        m = self.wanted.shape[1]
        real = (self.modes.basis.conj().T @ self.response).reshape(len(self.modes.rate), -1, m)
        C, miss = [], 0.0
        for row in range(m):
            weight = self.weights[:, row]
            left, right = (real * weight).reshape(len(real), -1).T, (self.wanted[:, row] * weight).ravel()
            found = np.linalg.lstsq(*(np.concatenate([x.real, x.imag]) for x in (left, right)), rcond=None)[0]
            C.append(found)
            miss = max(miss, np.abs(left @ found - right).max())
        return np.array(C), miss

    def start(self, C):
        """Initial Z: L that belongs to an output C (m, n) with some damping, or C itself, with which V has the peaks
        of H"""
        Z = self.free.T @ self._factor(C)
        made = self.transfer(Z)
        return Z * np.sqrt(max(np.vdot(made, self.wanted).real / np.vdot(made, made).real, 1e-3))

    def _factor(self, C):
        """L (n, m) of the system with an output C (m, n) and enough damping δ to dissipate energy in every motion

        AᵀP + PA + (PB − Cᵀ)(BᵀP − C)/2δ = 0,    L = (Cᵀ − PB)/√2δ

        From here Gauss and Newton's method arrives: 4e-4 with 47 states of a box's surge and pitch, from Cᵀ 2e-2.
        """
        from scipy.linalg import solve_continuous_are

        basis, back = self.modes.basis, self.modes.basis.conj().T
        A, B = ((back * self.modes.rate) @ basis).real, (back @ self.modes.input).real
        none = np.zeros_like(A)
        for damping in DAMPINGS:
            try:
                P = solve_continuous_are(A, B, none, -2 * damping * np.eye(len(C)), s=-C.T)
            except (np.linalg.LinAlgError, ValueError):  # it supplies energy at some frequency
                continue
            return (C.T - P @ B) / np.sqrt(2 * damping)
        return C.T


def _least_squares(problem, Z, tolerance):
    off = problem.misses(Z)
    square, damping = off @ off, 1e-3
    for _ in range(ROUNDS):
        if np.hypot(*np.split(off, 2)).max() <= tolerance:
            break
        slopes = problem.slopes(Z)
        normal, gradient = slopes @ slopes.T, slopes @ off
        own = np.diag(normal) + 1e-12 * np.diag(normal).max()
        for _ in range(12):
            step = np.linalg.solve(normal + damping * np.diag(own), gradient).reshape(Z.shape)
            there = problem.misses(Z - step)
            if there @ there < square:
                break
            damping *= 4
        else:
            return Z
        gain = 1 - (there @ there) / square
        Z, off, square, damping = Z - step, there, there @ there, max(damping / 5, 1e-14)
        worst = np.hypot(*np.split(off, 2)).max()
        if gain < (ENOUGH if worst < NEAR * tolerance else ENOUGH_AFAR):
            break
    return Z
