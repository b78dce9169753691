"""Kernels that solve the equations of equilibrium of a line by Newton's method, at one position after another.

The derivatives with respect to the fairlead's position give the stiffness.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .equations import empty_equations, equations
from .line_data import FLOATING, HEAP_AT_ANCHOR, HEAP_AT_TOUCHDOWN, TAUT, H, S, V
from .verdict import stands


@kernel()
def solve_small(A, n):
    """Solve in place by elimination with pivoting: A (n, n+m) holds the matrix and m right-hand sides, then solutions.

    returns : False where the matrix is singular
    """
    m = A.shape[1]
    for i in range(n):
        best = i
        for j in range(i + 1, n):
            if abs(A[j, i]) > abs(A[best, i]):
                best = j
        if A[best, i] == 0 or not math.isfinite(A[best, i]):
            return False
        for k in range(m):
            A[i, k], A[best, k] = A[best, k], A[i, k]
        for j in range(i + 1, n):
            share = A[j, i] / A[i, i]
            for k in range(i, m):
                A[j, k] -= share * A[i, k]
    for i in range(n - 1, -1, -1):
        for k in range(n, m):
            for j in range(i + 1, n):
                A[i, k] -= A[i, j] * A[j, k]
            A[i, k] /= A[i, i]
    return True


@kernel()
def largest(r):
    """Largest size of r (n,), nan if one is"""
    worst = 0.0
    for value in r:
        if not abs(value) <= worst:
            worst = abs(value)
        if math.isnan(value):
            break
    return worst


@kernel()
def newton_step(e, A):
    """Write the Newton step and the derivatives of u by x and z into columns n, n+1, n+2 of A.  returns : see
    `solve_small`
    """
    n = e.u.size
    for i in range(n):
        for k in range(n + 2):
            A[i, k if k < n else k + 1] = e.J[i, k]
        A[i, n] = e.r[i]
    return solve_small(A, n)


@kernel()
def damped_step(line, e, old, A, size, x, z, steps, left, rows):
    """Take a Newton step, halved until the residual falls.  returns : residual; −1, with u unchanged, if the residual
    never falls"""
    n = e.u.size
    share = min(1.0, 0.7 * old[0] / A[0, n]) if A[0, n] > 0 else 1.0
    for trial in range(13):
        for i in range(n):
            e.u[i] = old[i] - share * A[i, n]
        equations(line, e, x, z, steps, left, rows)
        new = largest(e.r)
        if trial == 12 or new < size or (new <= 1e-14 * line.length and share == 1.0):
            break
        share *= 0.5 if trial < 11 else 0.0
    return new if share > 0 else -1.0


@kernel()
def newton(line, e, A, x, z, steps, left, rows):
    """Newton's method from e.u, which is overwritten; A : see `newton_step`.  returns : residual over the length"""
    old = np.empty(e.u.size)
    equations(line, e, x, z, steps, left, rows)
    size, settled = largest(e.r), False
    for _ in range(40):
        if not newton_step(e, A):
            return math.inf
        if settled:
            break
        for i in range(old.size):
            old[i] = e.u[i]
        new = damped_step(line, e, old, A, size, x, z, steps, left, rows)
        if new < 0:
            break
        settled = new <= 1e-14 * line.length or (size <= 1e-13 * line.length and new >= 0.5 * size)
        size = new
    return size / line.length


@kernel()
def equations_for(w):
    """Equations whose initial unknowns are the unknowns of a traversal and its weights of floating buoys."""
    floating = 0
    for load in range(w.states.size):
        floating += 1 if w.states[load] == FLOATING else 0
    e = empty_equations(w.count[1] + floating, w.states.copy())
    known = 0
    for i in range(w.count[1]):
        e.u[i] = w.unknowns[i]
        known += 1
    for load in range(w.states.size - 1, -1, -1):
        if w.states[load] == FLOATING:
            e.u[known] = w.load_weights[load]
            known += 1
    return e


@kernel()
def store(e, A, residual, result):
    """Store in result (11,): H, V at the fairlead; H, V and excess s at the anchor; stiffness; residual; number of
    recorded rows.
    """
    n = e.u.size
    result[0], result[1] = e.u[0], e.u[1]
    result[2], result[3], result[4] = e.q[H], e.q[V], e.q[S]
    result[5], result[6] = -A[0, n + 1], -A[0, n + 2]
    result[7], result[8] = -A[1, n + 1], -A[1, n + 2]
    result[9], result[10] = residual, e.at[2]


@kernel()
def continuation(line, w, x, z, first, left, heap, rows, result):
    """Solve positions from number `first` on, while the contacts with the bed remain those recorded in w.

    Each solution starts from the previous one, extrapolated by derivatives, and is judged by its pieces (`verdict`).
    heap : length of the heap where the line first touches the bed, m
    rows : pieces of the last position solved; result : (n, 11) see `store`; w.states : left as they were
    returns : number of the first position that was not solved
    """
    e = equations_for(w)
    n = e.u.size
    if left == HEAP_AT_TOUCHDOWN:
        e.u[0] = heap
    A, steps = np.empty((n, n + 3)), w.steps[: w.count[0]].copy()
    i = first
    while i < x.size:
        residual = newton(line, e, A, x[i], z[i], steps, left, rows)
        good = residual <= 1e-10 and e.u[0] > 0 and e.at[2] < rows.shape[0]
        if not (good and stands(line, rows, e.at[2], e.states, left == HEAP_AT_ANCHOR, w.trial_q, w.q, w.g)):
            break
        store(e, A, residual, result[i])
        i += 1
        if left != TAUT:
            break
        if i < x.size:
            for k in range(n):
                e.u[k] -= A[k, n + 1] * (x[i] - x[i - 1]) + A[k, n + 2] * (z[i] - z[i - 1])
    for load in range(e.states.size):
        w.states[load] = e.states[load]
    return i
