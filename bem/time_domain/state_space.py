"""Retardation functions as a linear system with few states, for integration in time.

    ẋ = A x + B u,    y = C x,    C exp(At) B ≈ K(t),    C (−iω − A)⁻¹ B ≈ ∫₀^∞ K exp(iωt) dt

with velocities u and the forces y of the water's memory, to be put on the other side of the equation of motion.  By the
eigensystem realization algorithm (Kung 1978; Juang and Pappa, J. Guidance 8, 1985): the Hankel matrix of samples K(jh)
is split by singular values, of which the largest are kept; the states are balanced, and nothing is random or iterated.
A real system of any number of states is taken only if it is stable.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

BLOCKS = 100  # rows and columns of the Hankel matrix, in matrices K
MOST = 120  # states
BEYOND = 3.0  # times the band: how far passivity is looked at


@dataclass(frozen=True, eq=False)
class StateSpace:
    """A (n, n) 1/s, B (n, 6), C (6, n) of the module's equations.

    error : of the transform in the band, relative to the largest, couplings to √(ii · jj)
    least_damping : smallest eigenvalue of the damping matrix up to three times the band, relative to the largest of
    the diagonal (each mode scaled by its own); a system that is passive has none below zero
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    error: float
    least_damping: float

    @property
    def states(self):
        """Number of states"""
        return len(self.A)

    @property
    def passive(self):
        """Whether the water takes energy out of every motion, to rounding"""
        return self.least_damping >= -1e-12

    def transform(self, omega):
        """∫ K exp(iωt) dt (q, 6, 6) at omega (q,) rad/s: damping and, imaginary, ω [A(∞) − A]"""
        rate, vectors = np.linalg.eig(self.A)
        out, back = self.C @ vectors, np.linalg.solve(vectors, self.B)
        gain = 1 / (-1j * np.atleast_1d(omega)[:, None] - rate)
        return np.einsum("ik,qk,kj->qij", out, gain, back)

    def memory(self, times):
        """K (m, 6, 6) at times (m,) s"""
        rate, vectors = np.linalg.eig(self.A)
        decay = np.exp(np.multiply.outer(np.asarray(times, float), rate))
        return np.einsum("ik,qk,kj->qij", self.C @ vectors, decay, np.linalg.solve(vectors, self.B)).real


def state_space(retardation, omega, tolerance=0.02):
    """The smallest `StateSpace` of a `retardation.Retardation` within `tolerance` at omega (q,) rad/s.

    raises : ValueError if no stable system of at most 120 states is, naming the best one
    """
    omega = np.asarray(omega, float)
    if not 1e-4 <= tolerance <= 0.5:
        raise ValueError(f"tolerance is {tolerance:g}; allowed: 1e-4 to 0.5")
    wanted = retardation.transform(omega)
    size = np.sqrt(np.abs(np.einsum("qii->qi", wanted)).max(axis=0))
    size = np.where(size > 1e-9 * size.max(), size, np.inf)
    scale = np.outer(size, size)
    step, K = _sampled(retardation)
    halves = _hankel_svd(K / scale)
    best = np.inf, 0
    for states in range(2, min(MOST, len(halves[1])) + 1, 2):
        system = _realized(halves, states, step, len(K[0]))
        if system is None:
            continue
        made = StateSpace(*system, np.nan, np.nan)
        error = float(np.abs(made.transform(omega) - np.where(np.isinf(scale), 0, wanted / scale)).max())
        best = min(best, (error, states))
        if error <= tolerance:
            wide = np.linspace(0, BEYOND * omega[-1], 400)
            damping = made.transform(wide).real
            least = np.linalg.eigvalsh(0.5 * (damping + np.swapaxes(damping, 1, 2))).min()
            gain = np.where(np.isinf(size), 0, size)
            return StateSpace(made.A, made.B * gain, made.C * gain[:, None], error, float(least))
    raise ValueError(
        f"no stable system within tolerance {tolerance:g}; the best is {best[0]:.2g} off with {best[1]} states; "
        "ask for less, or give longer times"
    )


def _sampled(retardation):
    """Step (s) and K (2 BLOCKS, 6, 6): to the end of the times, or of a hundred seconds, whichever is earlier"""
    times = retardation.times
    stride = max(1, int(min(times[-1], 100.0) / (2 * BLOCKS * times[1])))
    K = retardation.K[::stride][: 2 * BLOCKS]
    if len(K) < 2 * BLOCKS:
        raise ValueError(f"times are {len(times)}; allowed: at least {2 * BLOCKS}")
    return stride * times[1], 0.5 * (K + np.swapaxes(K, 1, 2))


def _hankel_svd(K):
    from scipy.linalg import svd

    half, n = len(K) // 2, K.shape[1]
    blocks = K[np.add.outer(np.arange(half), np.arange(half))]
    return svd(blocks.transpose(0, 2, 1, 3).reshape(half * n, half * n), full_matrices=False)


def _realized(halves, states, step, width):
    """Continuous A, B, C of the largest singular values; None if it is not stable or turns within a step"""
    U, s, V = halves
    root = np.sqrt(s[:states])
    observed, reached = U[:, :states] * root, root[:, None] * V[:states]
    shift = np.linalg.lstsq(observed[:-width], observed[width:], rcond=None)[0]
    ratio, vectors = np.linalg.eig(shift)
    if np.any(np.abs(ratio) >= 1) or np.any((ratio.real <= 0) & (np.abs(ratio.imag) < 1e-9)):
        return None
    A = (vectors * (np.log(ratio) / step)) @ np.linalg.inv(vectors)
    return A.real, reached[:, :width], observed[:width]
