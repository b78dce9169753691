"""Poles, inputs and losses of a passive system, adjusted together to reduce the largest error of the system.

With rows b_k of B and l_k of L in the modes of `passive_fit`,

    H(s) = Σ_kl  b̄_k S_kl (l_k · l̄_l) b_lᵀ / (s − λ_l),    S_kl = −1 / (λ̄_k + λ_l),    Σ_k l̄_k b_kᵀ / λ_k = 0,

is passive for all λ, B and L with Re λ < 0.  The sum of the p-th powers of the errors of H is minimised by Newton's
method without the second derivatives of H (Levenberg's and Marquardt's damping). With p = 4 and 8 the sum
approximates the largest error.  The unknown for a decay is its logarithm, so that it remains positive. b_k changes
only in directions normal to b_k, because l_k contains its size.
With fixed poles, boxes and a buoy need 3 to 25 % more states for an equal largest error.
"""

from typing import NamedTuple

import numpy as np

POWERS = ((4, 15), (8, 25))  # p, and number of rounds with it
ENOUGH = 1e-3  # relative gain of a round, times p, below which the iteration stops
FARTHEST = 0.7  # largest change of the logarithm of a decay in one round
STEADY = 1e6  # weight of the last condition relative to that of its unknowns; it is then met exactly


class Moving(NamedTuple):
    """λ (n,), which ends with the poles of the p pairs and then their conjugates; B (n, m) and L (n, m) in the modes"""

    rate: np.ndarray
    input: np.ndarray
    loss: np.ndarray
    pairs: int


def real_basis(alone, pairs):
    """Unitary matrix from real states to modes; shape (n, n): single modes come first, then the first modes of the
    pairs, then their second modes"""
    basis = np.eye(alone + 2 * pairs, dtype=complex)
    one = np.sqrt(0.5) * np.eye(pairs)
    basis[alone:, alone:] = np.block([[one, -1j * one], [one, 1j * one]])
    return basis


def moved(system, s, wanted, weight):
    """`Moving` whose errors from H (q, m, m) at s (q,), times weight (q, m, m), are reduced where they exceed 1"""
    system, slowest = _steady(system), np.abs(s[s != 0]).min()  # slower ones would act for hours
    off = (transfer(system, s) - wanted) * weight
    damping = 1e-2
    for power, rounds in POWERS:
        for _ in range(rounds):
            if np.abs(off).max() <= 1:
                return system
            step = _step(system, s, off, weight, power)
            size = np.sum(np.abs(off) ** power)
            for _ in range(10):
                there = _steady(_shifted(system, step(damping), slowest))
                new = (transfer(there, s) - wanted) * weight
                if np.sum(np.abs(new) ** power) < size:
                    break
                damping *= 4
            else:
                break
            gain = 1 - np.sum(np.abs(new) ** power) / size
            system, off, damping = there, new, max(damping / 5, 1e-8)
            if gain < ENOUGH * power:
                break
    return system


def storage(system):
    """Storage matrix P (n, n) in the modes"""
    rate, _, loss, _ = system
    return -(loss @ loss.conj().T) / (rate.conj()[:, None] + rate)


def transfer(system, s):
    """H (q, m, m) at s (q,)"""
    n, m = system.input.shape
    right = system.input[:, None, :] / (s[:, None] - system.rate[:, None, None])
    C = system.input.conj().T @ storage(system)
    return (C @ right.reshape(n, -1)).reshape(m, -1, m).swapaxes(0, 1)


def _step(system, s, off, weight, power):
    """Function of the damping that gives the step of all unknowns (u,)"""
    across = _across(system)
    slopes = _slopes(system, s, across) * weight.ravel()
    size = np.abs(off).ravel()
    # an error grows along itself, and turns across: second derivatives of |·|ᵖ are p − 1 to 1
    slopes = slopes * (off.ravel().conj() / np.maximum(size, 1e-300)) * np.maximum(size, 1e-6) ** (power / 2 - 1)
    along, turned = np.ascontiguousarray(slopes.real), np.ascontiguousarray(slopes.imag)
    normal = (power - 1) * (along @ along.T) + turned @ turned.T
    gradient = along @ (size * np.maximum(size, 1e-6) ** (power / 2 - 1))
    own = np.diag(normal) + 1e-12 * np.diag(normal).max()
    held = _steady_slopes(system, across)
    normal = normal + STEADY * own.mean() * (held @ held.T)
    return lambda damping: -np.linalg.solve(normal + damping * np.diag(own), gradient)


def _slopes(system, s, across):
    """Derivatives of H by decays, turns, losses and inputs across; shape (u, q m m)"""
    rate, B, L, pairs = system
    n, m = B.shape
    basis = real_basis(n - 2 * pairs, pairs)
    S, LL = -1 / (rate.conj()[:, None] + rate), L @ L.conj().T
    gain = (1 / (s[:, None] - rate)).T  # (n, q)
    right = B[:, None, :] * gain[:, :, None]
    flat = right.reshape(n, -1)
    C, squared = B.conj().T @ (LL * S), B.conj().T @ (LL * S * S)

    def columns(c, rows):  # (n, q, m, m) of (m, n) and (n, q, m)
        return c.T[:, None, :, None] * rows[:, :, None, :]

    def left(matrix):  # factor b̄_k on the left
        return columns(B.conj().T, (matrix @ flat).reshape(n, -1, m))

    by_rate = columns(C, gain[:, :, None] * right) + columns(squared, right)
    by_conjugate = left(LL * S * S)
    parts = [*_of_rates(system, by_rate, by_conjugate)]
    for column in L.T:
        own = left(S * column.conj())
        other = columns((B.conj() * column[:, None]).T @ S, right)
        parts.append(basis.T @ own.reshape(n, -1) + basis.conj().T @ other.reshape(n, -1))
    rows = ((LL * S) @ flat).reshape(n, -1, m)
    for direction in across:
        own = columns(C, gain[:, :, None] * direction[:, None, :])
        other = columns(direction.conj().T, rows)
        parts.append(basis.T @ own.reshape(n, -1) + basis.conj().T @ other.reshape(n, -1))
    return np.concatenate([part.reshape(len(part), -1) for part in parts])


def _steady_slopes(system, across):
    """Derivatives of Σ l̄_k b_kᵀ / λ_k, likewise; shape (u, m m)"""
    rate, B, L, pairs = system
    n, m = B.shape
    back = real_basis(n - 2 * pairs, pairs)
    by_rate = -L.conj()[:, :, None] * (B / rate[:, None] ** 2)[:, None, :]
    parts = [*_of_rates(system, by_rate, np.zeros_like(by_rate))]
    for column in range(m):
        own = np.zeros((n, m, m), complex)
        own[:, column] = B / rate[:, None]
        parts.append(back.conj().T @ own.reshape(n, -1))
    for direction in across:
        parts.append(back.T @ (L.conj()[:, :, None] * (direction / rate[:, None])[:, None, :]).reshape(n, -1))
    return np.concatenate([part.reshape(len(part), -1).real for part in parts])


def _of_rates(system, by_rate, by_conjugate):
    """Derivatives by the logarithms of decays (r + p, …) and by turns (p, …) over |λ|, from those by λ and λ̄ (n, …)"""
    rate, pairs = system.rate, system.pairs
    alone = len(rate) - 2 * pairs
    first, second = slice(alone, alone + pairs), slice(alone + pairs, None)
    both, apart = by_rate + by_conjugate, 1j * (by_rate - by_conjugate)
    tail = (1,) * (by_rate.ndim - 1)
    decays = np.concatenate([both[:alone], both[first] + both[second]])
    yield decays * rate.real[: alone + pairs].reshape(-1, *tail)
    yield (apart[first] - apart[second]) * np.abs(rate[first]).reshape(-1, *tail)


def _across(system):
    """m − 1 directions (n, m) in which every input may turn, conjugate for conjugate modes"""
    _, B, _, pairs = system
    n, m = B.shape
    alone = n - 2 * pairs
    if m == 1:
        return []
    turned = np.linalg.svd(B[: alone + pairs, None, :].conj())[2][:, 1:].conj()
    turned = np.concatenate([turned, turned[alone:].conj()])
    return list(turned.swapaxes(0, 1))


def _shifted(system, step, slowest=0.0):
    """`Moving` after a step of its unknowns; no decay becomes slower than slowest, 1/s"""
    rate, B, L, pairs = system
    n, m = B.shape
    alone = n - 2 * pairs
    basis = real_basis(alone, pairs)
    decays, turns, rest = np.split(step, [alone + pairs, alone + 2 * pairs])
    old = rate.real[: alone + pairs]
    decay = np.minimum(old * np.exp(np.clip(decays, -FARTHEST, FARTHEST)), np.maximum(old, -slowest))
    turn = rate.imag[alone : alone + pairs] + turns * np.abs(rate[alone : alone + pairs])
    upper = decay[alone:] + 1j * turn
    rate = np.concatenate([decay[:alone], upper, upper.conj()])
    changes = basis @ rest.reshape(-1, n).T
    for direction, change in zip(_across(system), changes[:, m:].T, strict=True):
        B = B + change[:, None] * direction
    size = np.sqrt(-2 * rate.real) / np.linalg.norm(B, axis=1)
    return Moving(rate, B * size[:, None], (L + changes[:, :m]) / size[:, None], pairs)


def _steady(system):
    """`Moving` with the losses closest to the given ones that meet the last condition"""
    rate, B, L, pairs = system
    basis = real_basis(len(rate) - 2 * pairs, pairs)
    held = np.linalg.qr((basis.conj().T @ (B / rate[:, None])).real)[0]
    loss = (basis.conj().T @ L).real
    return Moving(rate, B, basis @ (loss - held @ (held.T @ loss)), pairs)
