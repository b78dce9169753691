"""Rows of comparison tables: one row for each case, frequency and heading.

A_ij = a_ij/(ρ∇ ℓᵢℓⱼ), B_ij = b_ij/(ρ∇ω ℓᵢℓⱼ), F_i = F/(ρg ζ_a (LB/2) ℓᵢ); X_1..3 = x_a/ζ_a, X_4..6 = φ_a/kζ_a;
D_x, D_y = F/(½ρgLζ_a²), D_yaw = M/(½ρgL²ζ_a²), floating freely.  chi_deg is 0 in a head sea, waves travel to
χ + 180°; |X| cos(ωt − ε), ε = 0 when the crest passes the origin; NaN where symmetry makes it zero.
"""

import numpy as np

from .report_units import PAIRS, lag


def coefficient_rows(results):
    """[{column: number or text}], one for each case and frequency"""
    names = [letter + pair for letter in "AB" for pair in PAIRS]
    return [
        {"frequency": f"{r.case.name} {xi:g}", **r.case.columns, "xi_B": xi}
        | {name: r.coefficient(name)[i] for name in names}
        for r in results
        for i, xi in enumerate(r.xi)
    ]


def wave_rows(results, kind):
    """[{column: number or text}], one for each case, frequency and heading; kind : forces or motions"""
    letter, out = {"forces": "F", "motions": "X"}[kind], []
    for r in results:
        values = np.where(r.driven(kind), getattr(r, kind), np.nan)
        for i, xi in enumerate(r.xi):
            for chi, row in zip(r.chi, values[i], strict=True):
                sizes = {f"{letter}{d + 1}": abs(row[d]) for d in range(6)}
                phases = {f"eps{d + 1}_deg": lag(row[d]) for d in range(6)}
                out.append(_place(r, xi, chi) | sizes | phases)
    return out


def drift_rows(results):
    """[{column: number or text}], one for each case with drift, frequency and heading"""
    return [
        _place(r, xi, chi) | dict(zip(("D_x", "D_y", "D_yaw"), values, strict=True))
        for r in results if r.drift is not None
        for i, xi in enumerate(r.xi)
        for chi, values in zip(r.chi, r.drift[i], strict=True)
    ]  # fmt: skip


def _place(r, xi, chi):
    return {"wave": f"{r.case.name} {xi:g} {chi:g}", **r.case.columns, "xi_B": xi, "chi_deg": chi}
