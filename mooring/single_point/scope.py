"""Smallest length of a uniform line that does not lift its anchor.

    S₀ = √(V(2T/w − V))        SR179 report (1982), eq. 3.6.15: S₀² = V² + 2aV with T = w(a + V)

V is the height of the upper end above the bed, T the tension there and w the weight in water, for an inextensible
catenary with its vertex at the anchor.
The report's smallest scope is S₀ over the water depth at the peak tension. Its tables use the peak T_static +
(T_significant − T_static)/(2/3), not the 1.3 times significant of its text.
"""

import numpy as np

SIGNIFICANT = 2 / 3  # fraction of the amplitude that is added to the steady value


def length_without_uplift(tension, weight, height):
    """Length without uplift of the anchor, m; shape (…); tension : N at the top, weight : N/m in water, height : m.
    Raises ValueError for a line too heavy."""
    tension = np.asarray(tension, float)
    square = height * (2 * tension / weight - height)
    if np.any(square < height**2 * (1 - 1e-12)):
        raise ValueError(
            f"a tension of {tension.min():.4g} N cannot carry the weight of {height:g} m of line, {weight:g} N/m; "
            f"allowed: at least {weight * height:.4g} N"
        )
    return np.sqrt(square)


def horizontal_at_rest(top, weight, stiffness, height):
    """Horizontal tension, N, of a line partly on the bed with the upper-end tension `top`, N; to first order in the
    strain.

    weight : N/m in water; stiffness : N, EA; height : m of the upper end.  Raises ValueError for a line too heavy.
    """
    carried = weight * height
    if not top > carried:
        raise ValueError(
            f"{top / 1e3:.4g} kN; allowed: above {carried / 1e3:.4g} kN, the line's weight from the bed to the buoy"
        )
    stretch = carried**2 / (2 * stiffness)  # T = H + wV/(1 + …)
    return top - carried + stretch * (top - 0.5 * carried) / max(top, 1.0)


def significant(values, steady):
    """Significant value of a record in the report's sense: steady + ⅔ of the largest amplitude above it.

    values : (n, …); steady : (…)
    """
    return steady + SIGNIFICANT * (np.max(values, axis=0) - steady)


def highest_third(record):
    """Mean of the highest third of the peaks of a record (n,) between upcrossings of its mean, as for waves in a tank

    For a snapping load this mean scatters less from record to record than `significant`, which uses only the largest
    peak.
    """
    above = record >= record.mean()
    begin = np.flatnonzero(above[1:] & ~above[:-1]) + 1
    if len(begin) < 2:
        return float(record.max())
    tops = np.sort(np.maximum.reduceat(record[: begin[-1]], begin[:-1]))
    return float(tops[-max(1, round(len(tops) / 3)) :].mean())


def peak(static, significant_value):
    """Largest value of a record from its significant value, the inverse of `significant`"""
    return static + (significant_value - static) / SIGNIFICANT
