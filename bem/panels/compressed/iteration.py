"""GMRES for several right-hand sides at once, each with its own Krylov space (Saad & Schultz 1986)."""

import numpy as np

RESTART = 40
OF_CYCLE = 1e-4  # least residual at the end of a cycle over that at its start; products are in single precision


def gmres(equations, precondition, columns, tolerance, most):
    """Solve A x = b by iteration; return (x, the largest residual relative to the largest entry of its right-hand
    side).

    equations : `bem.panels.compressed.operator.CompressedEquations`; columns : right-hand sides b as `Columns`
    precondition : function of an array (n, p) and of the signs of the `Columns` that returns about A⁻¹ times the array
    tolerance : tolerance of the residual; most : largest number of iterations
    """
    sides, done = equations.sides, 0
    x, scale = np.zeros_like(sides), np.maximum(np.abs(sides).max(axis=0), 1e-300)
    residual, before = sides, np.inf
    while True:
        largest = np.abs(residual).max(axis=0)
        left = float((largest / scale).max())
        if left <= tolerance or done >= most or not left < before:
            return x, left
        # the largest entry falls about as the norm does; it is several times the root mean square of all
        fall = np.clip(0.5 * tolerance * scale / np.maximum(largest, 1e-300), OF_CYCLE, 0.1)
        step, count = _cycle(equations, precondition, columns, residual, fall)
        done, before = done + count, left
        x = x + step
        residual = sides - equations.apply(columns._replace(values=x), exactly=True)


def _cycle(equations, precondition, columns, sides, fall):
    """Return (y, iterations) with A y near `sides`; fall (p,) : norm of the residual over that of `sides`"""
    n, p = sides.shape
    basis, H = np.zeros((p, RESTART + 1, n), np.complex64), np.zeros((p, RESTART + 1, RESTART), complex)
    start = np.linalg.norm(sides, axis=0)
    basis[:, 0] = (sides / np.maximum(start, 1e-300)).T
    y = [np.zeros(0)] * p
    for k in range(RESTART):
        image = equations.apply(columns._replace(values=precondition(basis[:, k].T, columns.signs)))
        left = np.empty(p)
        for c in range(p):
            w, own = image[:, c].astype(np.complex64), basis[c, : k + 1]
            for _ in range(2):  # once leaves rounding
                part = own.conj() @ w
                w -= part @ own
                H[c, : k + 1, k] += part
            H[c, k + 1, k] = np.linalg.norm(w)
            basis[c, k + 1] = w / max(H[c, k + 1, k].real, 1e-30)  # in single precision 1e-300 is 0
            right = np.zeros(k + 2, complex)
            right[0] = start[c]
            y[c] = np.linalg.lstsq(H[c, : k + 2, : k + 1], right)[0]
            left[c] = np.linalg.norm(H[c, : k + 2, : k + 1] @ y[c] - right)
        if np.all(left <= fall * start):
            break
    step = np.stack([y[c] @ basis[c, : k + 1] for c in range(p)], axis=1)
    return precondition(step.astype(np.complex64), columns.signs), k + 1
