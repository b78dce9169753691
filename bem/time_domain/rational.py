"""Stable linear systems of few states that approximate a matrix function of frequency.

    H(s) ≈ Σ_k R_k / (s − p_k),    p_k common to all entries, real or in conjugate pairs

by vector fitting (Gustavsen and Semlyen, IEEE Transactions on Power Delivery 14, 1999; relaxed, 2006): the poles a_k
are replaced by the zeros of σ = d + Σ c_k / (s − a_k) for which σ H has the poles a_k, until they no longer change.
The number of states, poles times inputs, is reduced by balancing. States that are weakly reached and weakly seen are
assumed to follow the other states immediately (Liu and Anderson, International Journal of Control 50, 1989), and the
remaining system is stable.
"""

from typing import NamedTuple

import numpy as np

ROUNDS = 12  # rounds of pole relocation; poles then converge to three digits
SLOW = 4  # real poles to start from
REAL = 1e-10  # relative imaginary part below which a pole is real


class System(NamedTuple):
    """ẋ = A x + B u, y = C x: A (n, n) 1/s, B (n, m), C (m, n)"""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray


class Balanced(NamedTuple):
    """A system in the variable 1/s, the square roots of its Gramians, reached (n, n) and seen (n, n), and singular
    vectors"""

    system: System
    reached: np.ndarray
    seen: np.ndarray
    left: np.ndarray
    values: np.ndarray
    right: np.ndarray

    def reduced(self, states):
        """`System` of the states with the largest singular values"""
        root = np.sqrt(self.values[:states])
        into = self.reached @ self.right[:states].T / root
        out = (self.seen @ self.left[:, :states] / root).T
        A, B, C = self.system
        A = np.linalg.inv(out @ A @ into)
        return System(A, A @ (out @ B), (C @ into) @ A)


def fitted(s, H, count, weight):
    """`System` with `count` poles for each input whose transfer function approximates the symmetric H (q, m, m) at s
    (q,) = iω

    weight : weight of the errors, symmetric, (q, m, m)
    returns : the `System` and its largest weighted error
    """
    m = H.shape[1]
    rows, columns = np.triu_indices(m)
    entries, weight = H[:, rows, columns], weight[:, rows, columns]
    poles = _moved(s, entries, weight, _first_poles(s, count))
    parts = fractions(s, poles)
    residues = np.stack(
        [
            np.linalg.lstsq(_real(w[:, None] * parts), _real(w * entry), rcond=None)[0]
            for entry, w in zip(entries.T, weight.T, strict=True)
        ],
        axis=1,
    )
    A, b = _blocks(poles)
    C = np.zeros((m, len(A), m))
    C[rows, :, columns] = C[columns, :, rows] = residues.T
    system = System(np.kron(A, np.eye(m)), np.kron(b[:, None], np.eye(m)), C.reshape(m, -1))
    return system, float((np.abs(parts @ residues - entries) * weight).max())


def balanced(system):
    """`Balanced` of a stable system in the variable 1/s, so that removed states are replaced by their instantaneous
    response

    The constant direct path of removed states from input to output is neglected.
    """
    from scipy.linalg import solve_continuous_lyapunov

    inverse = np.linalg.inv(system.A)
    A, B, C = system = System(inverse, inverse @ system.B, system.C @ inverse)
    reached = _root(solve_continuous_lyapunov(A, -B @ B.T))
    seen = _root(solve_continuous_lyapunov(A.T, -C.T @ C))
    return Balanced(system, reached, seen, *np.linalg.svd(seen.T @ reached))


def fractions(s, poles):
    """Partial fractions with real coefficients at s (q,) for poles with imaginary part ≥ 0, two for each pair; shape
    (q, n)"""
    columns = []
    for p in poles:
        first = 1 / (s - p)
        if p.imag == 0:
            columns.append(first)
        else:
            second = 1 / (s - p.conj())
            columns += [first + second, 1j * (first - second)]
    return np.array(columns).T


def _first_poles(s, count):
    """A few that decay slowly, for logarithms at ω = 0; the others oscillate, evenly over the lower quarter of |s|"""
    size = np.abs(s)
    slow = -np.geomspace(size.min(), size.max() / 40, SLOW) + 0j
    w = np.linspace(0.02, 1.0, (count - SLOW) // 2) * size.max() / 4
    return np.concatenate([slow, -0.1 * w - 0.02 * w[-1] + 1j * w])


def _moved(s, entries, weight, poles):
    for _ in range(ROUNDS):
        phi = fractions(s, poles)
        n = phi.shape[1]
        parts = []
        for entry, w in zip(entries.T[:, :, None], weight.T[:, :, None], strict=True):
            triangle = np.linalg.qr(_real(w * np.hstack([phi, -entry * phi, -entry])), mode="r")
            parts.append(triangle[n:, n:])  # equations for σ alone
        left = np.vstack(parts)
        size = np.linalg.norm(left)  # Σ Re σ = q prevents σ from vanishing
        left = np.vstack([left, np.append(phi.real.sum(axis=0), len(s)) * size / len(s)])
        right = np.append(np.zeros(len(left) - 1), size)
        *c, d = np.linalg.lstsq(left, right, rcond=None)[0]
        A, b = _blocks(poles)
        new = np.linalg.eigvals(A - np.outer(b, c) / (d if abs(d) > 1e-8 else 1e-8))
        new = np.where(np.abs(new.imag) < REAL * np.abs(new), new.real + 0j, new)
        new = -np.abs(new.real) + 1j * new.imag
        poles = np.sort_complex(new[new.imag >= 0])
    return poles


def _blocks(poles):
    """A (n, n), b (n,) with (s − A)⁻¹ b = `fractions`"""
    n = sum(1 if p.imag == 0 else 2 for p in poles)
    A, b, k = np.zeros((n, n)), np.zeros(n), 0
    for p in poles:
        if p.imag == 0:
            A[k, k], b[k] = p.real, 1.0
            k += 1
        else:
            A[k : k + 2, k : k + 2] = [[p.real, p.imag], [-p.imag, p.real]]
            b[k] = 2.0
            k += 2
    return A, b


def _root(matrix):
    values, vectors = np.linalg.eigh(0.5 * (matrix + matrix.T))
    return vectors * np.sqrt(np.maximum(values, 0))


def _real(values):
    return np.concatenate([values.real, values.imag])
