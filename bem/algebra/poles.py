"""Poles of functions that are known at few places, from rational functions through some of the values.

    f(x) ≈ Σⱼ wⱼ fⱼ / (x − xⱼ)  /  Σⱼ wⱼ / (x − xⱼ)

Places xⱼ are added one by one, each where the error is largest; the weights w minimise the errors at the other places
(AAA; Nakatsukasa, Sète and Trefethen, SIAM Journal on Scientific Computing 40, 2018). Several functions share the
weights w and the poles, which are the zeros of the denominator.
"""

import numpy as np

# fit error, relative to the largest value of each function, at which the poles suffice; below it noise creates poles
ENOUGH = 1e-3
MOST = 40


def poles(x, values):
    """Poles (p,) and residues (p, m) of functions (n, m), complex, known at complex x (n,)"""
    x, values = np.asarray(x, float), np.asarray(values, complex)
    values = values / np.abs(values).max(axis=0)
    made, taken = np.broadcast_to(values.mean(axis=0), values.shape), []
    while True:
        missed = np.abs(values - made).max(axis=1)
        missed[taken] = 0.0
        if missed.max() <= ENOUGH or len(taken) >= min(len(x) // 2, MOST):
            break
        taken.append(int(missed.argmax()))
        made, weights = _through(x, values, taken)
    if len(taken) < 2 or missed.max() > ENOUGH:
        return np.zeros(0, complex), np.zeros((0, values.shape[1]), complex)
    return _zeros(x[taken], weights, values[taken])


def _through(x, values, taken):
    """The function (n, m) through the values `taken`, and its weights w"""
    left = np.setdiff1d(np.arange(len(x)), taken)
    away = 1 / (x[left, None] - x[taken])
    rows = [(values[left, m, None] - values[taken, m]) * away for m in range(values.shape[1])]
    weights = np.linalg.svd(np.concatenate(rows), full_matrices=False)[2][-1].conj()
    made = values.copy()
    made[left] = (away @ (weights[:, None] * values[taken])) / (away @ weights)[:, None]
    return made, weights


def _zeros(x, weights, values):
    """Zeros of Σ w / (x − xⱼ), the finite eigenvalues of an arrow, and the residues there of the function"""
    from scipy.linalg import eigvals

    x, weights, values = (one[weights != 0] for one in (x, weights, values))
    n = len(x) + 1
    arrow = np.diag(np.append(0.0, x).astype(complex))
    arrow[0, 1:], arrow[1:, 0] = weights, 1.0
    found = eigvals(arrow, np.diag([0.0] + [1.0] * (n - 1)))
    found = found[np.isfinite(found)]
    away = 1 / (found[:, None] - x)
    return found, (away @ (weights[:, None] * values)) / -(away**2 @ weights)[:, None]
