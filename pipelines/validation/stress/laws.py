"""Laws that every result obeys; each violation is divided by the violation that the estimated error e allows.

If Z and X each have errors of at most e of their size, theory allows these violations:

    reciprocity  |Zᵢⱼ − Zⱼᵢ| ≤ 2e            Haskind  two values of X ≤ 2e apart
    dissipation  eigenvalues of B ≥ −2e      for surge with pitch and sway with roll are pairs, heave and yaw alone
    energy       |B − ∫ H H̄| ≤ 3e            once in B, twice in H, which is X of the opposite heading (Haskind)

and e is at least `FLOOR`, the digits that rounding leaves.  A violation above one is a failure.

Smoothness: the second difference of three values at equal steps δ of a parameter's logarithm is the curvature times
δ², plus four errors.  Powers of a parameter and waves whose phase moves by δ have a curvature of a few times their
size.
"""

import numpy as np

FLOOR = 1e-8
CURVATURE = 30.0  # largest relative curvature of Z and X; up to 3 with the contour method at 1e-4
ALLOWED = {"reciprocity": 2, "Haskind": 2, "energy": 3, "dissipation": 2}


def violations(solved):
    """{law: violation over the allowed violation}; raises ArithmeticError for a value or a check that is not finite"""
    check_finite(solved.result)
    found = {**solved.result["checks"], "dissipation": negative_damping(solved.Z / solved.sizes[0])}
    for name in ("estimated_error", *ALLOWED):
        if not found[name] >= 0:
            raise ArithmeticError(f"{name} is {found[name]}; allowed: 0 or more")
    return {law: found[law] / (times * allowed(solved.estimate)) for law, times in ALLOWED.items()}


def allowed(estimate):
    """The error that a result may have"""
    return max(estimate, FLOOR)


def check_finite(result):
    """Raises ArithmeticError naming the quantity that holds a value that is not finite"""
    for name, value in result.items():
        if isinstance(value, np.ndarray) and not np.all(np.isfinite(value)):
            count = np.count_nonzero(~np.isfinite(value))
            raise ArithmeticError(f"{name} has {count} of {value.size} values that are not finite; allowed: none")


def negative_damping(radiation):
    """How far the smallest eigenvalue of B, in units of |Z|, is below zero"""
    B = (radiation.imag + radiation.imag.T) / 2
    return float(max(-np.linalg.eigvalsh(B).min(), 0.0))


def kink(before, here, after):
    """Largest second difference of Z and X, relative to their size, of `Solved` at equal steps of a parameter"""
    parts = (here.relative(solved.Z, solved.X) for solved in (before, here, after))
    return max(float(np.abs(left - 2 * middle + right).max()) for left, middle, right in zip(*parts, strict=True))
