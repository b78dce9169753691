"""Kinds of wave period, and the definition of each for a spectrum with moments m_n = ∫ ωⁿ S dω.

    T01 = 2π m₀/m₁    T02 = 2π √(m₀/m₂)    Te = 2π m₋₁/m₀    Tp = 2π/ω_p    T1/3: mean period of the highest third

The first four follow from the spectrum.  T1/3 is a property of a record. For a spectrum it is known only where the
author relates it to the peak period.
"""

from .allowed import positive

KINDS = {
    "mean_period": "T01",
    "zero_crossing_period": "T02",
    "energy_period": "Te",
    "peak_period": "Tp",
    "significant_period": "T_significant",
}
WORDS = {
    "T01": "T01, mean",
    "T02": "T02, zero crossings",
    "Te": "Te, energy",
    "Tp": "Tp, peak",
    "T_significant": "T1/3, significant",
}


def the_one_period(family, periods):
    """Kind and value (s) of the single period given for a family of spectra.

    periods : {kind: s or None}, with kinds of `KINDS`.
    Raises ValueError for an unknown kind, for no or several periods, and for a period that is not above 0.
    """
    unknown = [kind for kind in periods if kind not in KINDS]
    if unknown:
        raise ValueError(f"{family}: {unknown[0]} is not a kind of period; allowed: {', '.join(KINDS)}")
    given = {kind: value for kind, value in periods.items() if value is not None}
    if len(given) != 1:
        state = " and ".join(given) + " are given" if given else "no period is given"
        raise ValueError(f"{family}: {state}; give one of {', '.join(KINDS)}")
    ((kind, value),) = given.items()
    return kind, positive(kind.replace("_", " "), value, "s")
