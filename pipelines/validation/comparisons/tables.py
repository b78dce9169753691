"""Tables of comparisons as CSV: what they are in # lines, then one line per case, frequency and heading."""

from __future__ import annotations

import csv
import io

from hakobune.meshing.seals import write_sealed

from ...common.outputs import opening
from .report_units import PAIRS, lag

SOURCE = "Definitions: SR179 report (1982), chapter 2; boxes of length L, beam B, draft d in water of depth H"
ANGLES = (
    "chi_deg: 0 in a head sea, the waves travel to chi + 180 degrees; x forward, y to port, z up",
    "|X| cos(omega t - eps), eps in degrees, 0 when the crest passes the origin; empty where zero",
)
NOTES = {
    "coefficients": (
        "A_ij = a_ij/(rho V l_i l_j), B_ij = b_ij/(rho V omega l_i l_j), l = 1, 1, 1, B/2, L/2, L/2 (eq. 2.1.5.34)",
        "xi_B = (omega^2/g)(B/2); about the origin in the waterplane, which is the centre of gravity too (KG = d)",
    ),
    "excitation": ("F_i = F/(rho g zeta_a (L B/2) l_i), l = 1, 1, 1, B/2, L/2, L/2 (eq. 2.1.5.35)", *ANGLES),
    "motions": ("X_1..3 = x_a/zeta_a, X_4..6 = phi_a/(k zeta_a), k = 2 pi/lambda (Table 2.4.2.1)", *ANGLES),
    "drift": ("D_x, D_y = F/(rho g L zeta_a^2/2), D_yaw = M/(rho g L^2 zeta_a^2/2), floating freely", ANGLES[0]),
    "ratios": (
        "3-D over 2-D: M added mass, N damping, F force in beam waves; H heave, S sway, R roll",
        "Figures 2.1.5.91-99; two-dimensional values by the strip method",
    ),
    "periods": (
        "Natural periods in s: uncoupled, and coupled (roll with sway, pitch with surge); no damping",
        "Empty where the period lies outside the frequencies computed",
        "A44, A55: added inertia about the centre of gravity at the uncoupled period, dimensionless (eq. 2.1.5.34)",
        "Measured: Table 2.4.4.1; difference: of the uncoupled period",
    ),
    "roll": (
        "Roll in beam waves where it is largest without viscous damping (wave height empty), and with b_R",
        "b_R of Yamashita for deep water, in proportion to the roll angle",
        "X4 = phi_a/(k zeta_a); X4_largest: over the frequencies computed",
    ),
}


def write_table(path, kind, rows):
    """Write dictionaries with the same keys to `path`; returns it.

    kind : of `NOTES`; an interrupted run leaves the old file
    """
    text = io.StringIO()
    text.writelines(f"# {note}\n" for note in (SOURCE, *NOTES[kind]))
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: _shown(value) for key, value in row.items()} for row in rows)
    write_sealed(path, text.getvalue())
    return path


def is_table(path):
    """Whether a file was written by `write_table`"""
    return opening(path)[0] == f"# {SOURCE}"


def coefficient_rows(results):
    """One row per case and frequency"""
    for r in results:
        for i, xi in enumerate(r.xi):
            names = [letter + pair for letter in "AB" for pair in PAIRS]
            yield {**r.case.columns, "xi_B": xi, **{name: r.coefficient(name)[i] for name in names}}


def wave_rows(results, kind):
    """One row per case, frequency and heading; kind : forces or motions"""
    letter = {"forces": "F", "motions": "X"}[kind]
    for r in results:
        driven = r.driven(kind)
        for i, xi in enumerate(r.xi):
            for j, chi in enumerate(r.chi):
                values = _amplitudes(letter, getattr(r, kind)[i, j], driven[j])
                yield {**r.case.columns, "xi_B": xi, "chi_deg": chi, **values}


def drift_rows(results):
    """One row per case, frequency and heading, of the cases that have drift"""
    for r in (r for r in results if r.drift is not None):
        for i, xi in enumerate(r.xi):
            for chi, values in zip(r.chi, r.drift[i], strict=True):
                named = dict(zip(("D_x", "D_y", "D_yaw"), values, strict=True))
                yield {**r.case.columns, "xi_B": xi, "chi_deg": chi, **named}


def _amplitudes(letter, values, driven):
    sizes = {f"{letter}{d + 1}": abs(values[d]) if driven[d] else "" for d in range(6)}
    return sizes | {f"eps{d + 1}_deg": lag(values[d]) if driven[d] else "" for d in range(6)}


def _shown(value):
    if isinstance(value, str):
        return value
    return f"{value:.6g}" if value == value else ""  # NaN: there is none
