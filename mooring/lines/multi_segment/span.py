"""Position of the fairlead of a line for a given horizontal tension: Newton's method on the exact stiffness."""

import numpy as np

from ..catenary.state import LineError


def span_of(solve, horizontal_tension, length, z):
    """Span x (m) at which a line carries a horizontal tension (N, above 0).

    solve : x → StaticSolution; length : unstretched length, m; z : height of the fairlead over the anchor, m.
    The tension grows with the span. A step that would leave the bracket is halved.
    raises : LineError for a line too short for its height, or if no span was found; and errors of `solve`
    """
    if not (np.isfinite(horizontal_tension) and horizontal_tension > 0):
        raise ValueError(f"horizontal_tension is {horizontal_tension:g} N; allowed: finite, above 0")
    low, high = 0.0, np.inf
    x = np.sqrt(max(length**2 - z**2, (0.01 * length) ** 2))
    for _ in range(200):
        try:
            found = solve(x)
            wrong, slope = found.horizontal_fairlead - horizontal_tension, found.stiffness[0, 0]
        except LineError:
            wrong, slope = np.inf, np.nan
        if abs(wrong) <= 1e-12 * horizontal_tension:
            return float(x)
        low, high = (x, high) if wrong < 0 else (low, x)
        following = x - wrong / slope if slope > 0 and np.isfinite(wrong) else np.nan
        if not low < following < high:
            following = 0.5 * (low + high) if np.isfinite(high) else 1.02 * x
        if abs(following - x) <= 4e-16 * length:
            return float(following)
        x = following
    raise LineError(
        f"no span was found at which a line of {length:g} m carries {horizontal_tension:.6g} N with its fairlead "
        f"{z:g} m above the anchor"
    )
