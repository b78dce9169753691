"""Root of many falling functions at once: Newton's step while it stays in the bracket, halving otherwise."""

from __future__ import annotations

import numpy as np

ROUNDING = 8 * np.finfo(float).eps


def falling_root(function, low, high, start):
    """q with function(q) = 0, elementwise, for a function that falls from `low` to `high`.

    function : q (n,) → value (n,), slope (n,)
    low, high, start : (n,), value(low) ≥ 0 ≥ value(high); both ends may be the root
    returns : (n,)

    The bracket shrinks in every pass, so the loop ends by itself; 200 passes are more than halving
    needs between any two doubles on a logarithmic scale.
    """
    q = np.clip(start, low, high)
    for _ in range(200):
        value, slope = function(q)
        low = np.where(value >= 0, q, low)
        high = np.where(value <= 0, q, high)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            newton = q - value / slope
        inside = (newton >= low) & (newton <= high)
        following = np.where(inside, newton, 0.5 * (low + high))
        settled = np.abs(following - q) <= ROUNDING * np.maximum(1.0, np.abs(q))
        q = following
        if np.all(settled):
            break
    return q
