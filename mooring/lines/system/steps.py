"""Kernels for one step of the search for rest: (K + m) s = r, with the smallest m ≥ 0 for which s is not too long.

Stiff directions are solved to convergence while soft ones, such as slack lines, wait.  Consecutive points on a line
have their terms near the diagonal, so elimination is limited to the envelope: each row from its first term on. This
costs N b² operations, instead of N³, for N freedoms and rows of b terms.  No pivoting: K has a positive definite
symmetric part, or is refused.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

FOUND, INDEFINITE = 0, 1
LONGER = 1.02  # largest step over the requested length


@kernel()
def envelope(A, first):
    """Array first[i] : smallest j ≤ i with a term at (i, j) or (j, i)."""
    for i in range(A.shape[0]):
        j = 0
        while j < i and A[i, j] == 0.0 and A[j, i] == 0.0:
            j += 1
        first[i] = j


@kernel()
def factored(A, first):
    """A = L U in place, L with a diagonal of ones.  returns : False where a pivot is not positive"""
    for i in range(A.shape[0]):
        for j in range(first[i], i + 1):
            begin = max(first[i], first[j])
            lower, upper = 0.0, 0.0
            for k in range(begin, j):
                lower += A[i, k] * A[k, j]
                upper += A[j, k] * A[k, i]
            if j < i:
                A[i, j] = (A[i, j] - lower) / A[j, j]
                A[j, i] -= upper
            else:
                A[i, i] -= lower
        if not A[i, i] > 0.0:
            return False
    return True


@kernel()
def solve_factored(A, first, b, x):
    """x = (L U)⁻¹ b; x may be b."""
    n = b.size
    for i in range(n):
        total = b[i]
        for k in range(first[i], i):
            total -= A[i, k] * x[k]
        x[i] = total
    for i in range(n - 1, -1, -1):
        x[i] /= A[i, i]
        for k in range(first[i], i):
            x[k] -= A[k, i] * x[i]


@kernel()
def copy_shifted(A, K, shift, mirrored):
    """A = K, or the symmetric part of K, plus `shift` on the diagonal."""
    for i in range(A.shape[0]):
        for j in range(A.shape[0]):
            A[i, j] = 0.5 * (K[i, j] + K[j, i]) if mirrored else K[i, j]
        A[i, i] += shift


@kernel()
def length_of(x):
    total = 0.0
    for value in x:
        total += value * value
    return math.sqrt(total)


@kernel()
def symmetric(K):
    """Whether K is symmetric up to rounding."""
    for i in range(K.shape[0]):
        for j in range(i):
            if abs(K[i, j] - K[j, i]) > 1e-14 * (abs(K[i, i]) + abs(K[j, j])):
                return False
    return True


@kernel()
def shifted(A, K, first, residual, s, radius):
    """Newton's method on 1/|s(m)| = 1/radius from m = 0, where |s| ≥ radius; every step keeps |s| ≥ radius (Moré &
    Sorensen 1983).

    A : factors of the symmetric part of K; s : its solution; both are overwritten.  returns : see `step_within`
    """
    shift, slope = 0.0, np.zeros(s.size)
    for _ in range(60):
        size = length_of(s)
        if size <= LONGER * radius:
            return FOUND
        solve_factored(A, first, s, slope)
        along = 0.0
        for i in range(s.size):
            along += s[i] * slope[i]
        if not along > 0.0:
            return INDEFINITE
        shift += (size / radius - 1.0) * size * size / along
        copy_shifted(A, K, shift, True)
        if not factored(A, first):
            return INDEFINITE
        solve_factored(A, first, residual, s)
    return INDEFINITE


@kernel()
def held_by_bed(force, free, bed, first, i):
    """Whether freedom i is the height of a free point (from `first` on) that lies on the bed and is pressed down."""
    return i >= first and (i - first) % 3 == 2 and free[(i - first) // 3, 2] <= bed and force[i] <= 0.0


@kernel()
def left_over(force, rows, free, bed, may, unit, moving, residual):
    """Largest force, over `unit`, on a moving degree of freedom not held by the bed; and the sum of line forces, N.

    moving, residual : (N,), set to the moving degrees of freedom, and to the forces on them over `unit`
    """
    worst, total, first = 0.0, 0.0, force.size - 3 * free.shape[0]
    for i in range(force.size):
        moving[i] = may[i] and not held_by_bed(force, free, bed, first, i)
        residual[i] = force[i] / unit[i] if moving[i] else 0.0
        if abs(residual[i]) > worst or math.isnan(residual[i]):
            worst = abs(residual[i])
    for row in rows:
        total += abs(row[1]) + abs(row[2]) + abs(row[3]) + abs(row[4])
    return worst, total


@kernel()
def ahead_of(step, residual, force, free, bed, unit):
    """Work along a step of the force after the step, over `unit`; work of the force before the step; length of the
    step.
    """
    forth, here, first = 0.0, 0.0, force.size - 3 * free.shape[0]
    for i in range(force.size):
        here += step[i] * residual[i]
        if not held_by_bed(force, free, bed, first, i):
            forth += step[i] * force[i] / unit[i]
    return forth, here, length_of(step)


@kernel()
def step_within(stiffness, force, unit, moving, radius, step):
    """Newton's step, or a step of about the length `radius` with an evenly increased stiffness.

    force : (N,), over `unit`; stiffness : (N, N), of all degrees of freedom, to be divided twice by `unit` (N,);
        moving : (N,)
    step : (N,), step times `unit`, 0 at fixed degrees of freedom
    returns : FOUND, or INDEFINITE, step unchanged, where the symmetric part of the stiffness is not positive definite
    """
    chosen = np.empty(unit.size, np.int64)
    n = 0
    for i in range(unit.size):
        if moving[i]:
            chosen[n] = i
            n += 1
    K, A, residual, s, first = np.empty((n, n)), np.empty((n, n)), np.empty(n), np.empty(n), np.empty(n, np.int64)
    for i in range(n):
        residual[i] = force[chosen[i]]
        for j in range(n):
            K[i, j] = stiffness[chosen[i], chosen[j]] / (unit[chosen[i]] * unit[chosen[j]])
    envelope(K, first)
    copy_shifted(A, K, 0.0, True)
    if not factored(A, first):
        return INDEFINITE
    solve_factored(A, first, residual, s)
    newton = symmetric(K)
    if not newton:
        B, t = K.copy(), np.empty(n)
        newton = factored(B, first)
        if newton:
            solve_factored(B, first, residual, t)
            newton = length_of(t) <= radius
            if newton:
                s = t
    if not newton or length_of(s) > radius:
        found = shifted(A, K, first, residual, s, radius)
        if found != FOUND:
            return found
    for i in range(unit.size):
        step[i] = 0.0
    for i in range(n):
        step[chosen[i]] = s[i]
    return FOUND
