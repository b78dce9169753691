"""Seismic coefficients of the rules that the SR179 report (1982) compares, chapter 4, section 3.

    A      K_h given, at most 0.3, K_v = 0
    C, F   K_h = regional · ground · importance
    E      K_h = A · B · C · K_b    ground class, damping factor, factor of the natural period, regional coefficient

The user gives the factors; the report prints no tables.  Rules B and D have no formula.  A force is weight times
coefficient.  By rules C and F the coefficient applies to the weight with or without surcharge, at the centroid of
this weight; the worse case counts.
"""

import math

from ..environment.allowed import positive, within

FACTORS = {
    "A": ("coefficient",),
    "C": ("regional", "ground", "importance"),
    "E": ("ground", "damping", "period", "regional"),
    "F": ("regional", "ground", "importance"),
}
LARGEST = 0.3  # largest coefficient of rule A


def seismic_coefficient(rule, **factors):
    """Coefficient K_h of a rule from its FACTORS. Raises ValueError for an unknown rule, unknown factors, and
    factors not above 0.
    """
    if rule not in FACTORS:
        raise ValueError(
            f"rule is {rule!r}; allowed: {', '.join(FACTORS)}; the rules B and D give no seismic coefficient"
        )
    if set(factors) != set(FACTORS[rule]):
        given = ", ".join(factors) or "nothing"
        raise ValueError(f"factors of rule {rule} are {given}; allowed: {', '.join(FACTORS[rule])}")
    for name, value in factors.items():
        positive(f"{name} of rule {rule}", value, "")
    if rule == "A":
        return within("coefficient of rule A", factors["coefficient"], 0.0, LARGEST)
    return math.prod(factors.values())


def seismic_force(coefficient, weight, surcharge=0.0):
    """Horizontal force in the unit of the weights; surcharge : weight that lies on the structure  Raises ValueError."""
    within("seismic coefficient", coefficient, 0.0, 2.0)
    within("surcharge", surcharge, 0.0, math.inf)
    return coefficient * (positive("weight", weight, "") + surcharge)
