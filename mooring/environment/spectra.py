"""Families of wave spectra, one-sided in ω.

ISSC (SR179 report, 1982, guideline 2.5; its T_v²/2π is a misprint for T_v/2π), T_v mean period:

    S = 0.11 H² (T_v/2π) (ω/ω_v)⁻⁵ exp{−0.44 (ω/ω_v)⁻⁴},    ω_v = 2π/T_v

Mitsuyasu-Bretschneider (same report, eq. 3.6.11) and Bretschneider (Kihara, Kitatani & Todoroki 1975,
Reports of the PHRI 14(2), eq. 6.1 to 6.3, with H1/3 = 1.60 H̄ and T̄ = 0.9 T1/3), S(ω) = S(f)/2π:

    S(f) = 0.257 H² T⁻⁴ f⁻⁵ exp{−1.03 (T f)⁻⁴},    T = T1/3
    S(f) = (3.45/8) H̄² T̄⁻⁴ f⁻⁵ exp{−0.675 (T̄ f)⁻⁴}

JONSWAP (Hasselmann et al. 1973; the report's guideline 2.5):

    S(f) = α g² (2π)⁻⁴ f⁻⁵ exp{−5/4 (f/f_p)⁻⁴} γ^exp{−(f−f_p)²/(2σ²f_p²)},    σ = 0.07 to f_p, 0.09 above
    by fetch x:  f_p U/g = 3.5 x̃^−0.33,  α = 0.076 x̃^−0.22,  x̃ = g x/U²

A family accepts one period of any kind, by name. A kind other than that of the formula is converted by the moments
of the family's shape. T̄ of the 1975 paper is the mean period of a record, not T01 of the spectrum, which is 0.81
T1/3.
"""

import warnings
from pathlib import Path

import numpy as np

from .allowed import positive, within
from .logger_files import read_table
from .periods import KINDS, the_one_period
from .spectrum import Peaked, Spectrum, Tabulated
from .tables import TableError

__all__ = [
    "FAMILIES",
    "Spectrum",
    "bretschneider",
    "issc",
    "jonswap",
    "jonswap_fetch",
    "mitsuyasu_bretschneider",
    "read_spectrum",
    "tabulated",
]

GRAVITY = 9.80665
STEEPEST = 0.1  # 2πH/gT02², DNV-RP-C205 (2010), 3.5.4: 1/10 for short, 1/15 for long sea states
LARGEST_GAMMA = 10.0
FULLY_DEVELOPED = (3.5 / 0.13) ** (1 / 0.33)  # x̃ at which f_p U/g is 0.13, Hasselmann et al. (1973)
HEIGHTS, PERIODS = (1e-6, 1e3), (1e-3, 1e6)  # m, s, from a laboratory to seiches
WINDS, FETCHES = (0.1, 200.0), (0.1, 1e8)  # m/s, m
COLUMNS = {("omega_rad_s", "density_m2_s_rad"): 1.0, ("frequency_hz", "density_m2_hz"): 2 * np.pi}  # names: rad/s
MITSUYASU_PEAK = (4 * 1.03 / 5) ** 0.25  # T1/3 / Tp = 0.9527


def issc(height, **period):
    """ISSC spectrum; 4√m₀ = height exactly.

    height : m, significant; one period (s) of `periods.KINDS`.  mean_period is the T_v of the formula, and T01 is
        1.0020 T_v. significant_period is converted as for the Mitsuyasu form, because the two shapes are equal.
    """
    printed = ("mean_period", (0.8 * 0.44) ** -0.25)
    return _by_height("issc", height, 0.11 / (4 * 0.44), period, printed, MITSUYASU_PEAK)


def mitsuyasu_bretschneider(height, **period):
    """Mitsuyasu-Bretschneider spectrum; m₀ = 0.06238 height².

    height : m, H1/3; one period (s) of `periods.KINDS`, significant_period is the T1/3 of the formula
    """
    printed = ("significant_period", 1 / MITSUYASU_PEAK)
    return _by_height("mitsuyasu_bretschneider", height, 0.257 / (4 * 1.03), period, printed, MITSUYASU_PEAK)


def bretschneider(height, **period):
    """Bretschneider's spectrum as used in 1975; m₀ = 0.06239 height².

    height : m, H1/3 = 1.60 H̄; one period (s) of `periods.KINDS`, significant_period is T̄/0.9
    """
    peak = 0.9**-1 * (0.8 * 0.675) ** 0.25  # T1/3 / Tp = 0.9525
    return _by_height(
        "bretschneider", height, 3.45 / 8 / (4 * 0.675) / 1.60**2, period, ("significant_period", 1 / peak), peak
    )


def jonswap(height, *, gamma=3.3, **period):
    """JONSWAP spectrum scaled to 4√m₀ = height.

    height : significant height, m; one period of `periods.KINDS`, s; gamma : 1 to 10.
    significant_period is T1/3 = Tp (1 − 0.132 (γ + 0.2)^−0.559), Goda (1988), found from simulated records.
    """
    within("gamma", gamma, 1, LARGEST_GAMMA)
    significant = 1 - 0.132 * (gamma + 0.2) ** -0.559
    return _by_height("jonswap", height, 1 / 16, period, ("peak_period", 1.0), significant, gamma)


def jonswap_fetch(wind_speed, fetch, *, gamma=3.3, gravity=GRAVITY):
    """JONSWAP spectrum of a wind of `wind_speed` (m/s, at 10 m) over a fetch of `fetch` (m)."""
    within("gamma", gamma, 1, LARGEST_GAMMA)
    speed = within("wind speed", positive("wind speed", wind_speed, "m/s"), *WINDS, "m/s")
    fetch, g = within("fetch", positive("fetch", fetch, "m"), *FETCHES, "m"), positive("gravity", gravity, "m/s²")
    longest = FULLY_DEVELOPED * speed**2 / g
    if fetch > longest * (1 + 1e-9):
        raise ValueError(
            f"fetch is {fetch:g} m; beyond {longest:.4g} m the sea of a wind of {speed:g} m/s is fully "
            "developed (f_p U/g = 0.13); give a fetch up to this limit"
        )
    x = g * fetch / speed**2
    peak_omega = 2 * np.pi * 3.5 * x**-0.33 * g / speed
    alpha = 0.076 * x**-0.22
    significant = 1 - 0.132 * (gamma + 0.2) ** -0.559
    return Peaked("jonswap", alpha * g**2, peak_omega, gamma, significant)


def tabulated(omega, density, name="table"):
    """Spectrum of a table: linear between the rows of the table, zero outside.

    omega : (n,) rad/s, rising; density : (n,) m² s/rad, at least 0
    """
    return Tabulated(name, omega, density)


def read_spectrum(path):
    """Spectrum of a text file with two named columns: frequency and density, as in `COLUMNS`.

    Raises TableError.
    """
    path = Path(path)
    names, values, _ = read_table(path)
    for (frequency, density), factor in COLUMNS.items():
        if names and {frequency, density} <= set(names):
            omega, values = values[:, names.index(frequency)] * factor, values[:, names.index(density)] / factor
            return _of_file(path, omega, values)
    allowed = " or ".join(",".join(pair) for pair in COLUMNS)
    raise TableError(f"{path} has the columns {','.join(names or ['without names'])}; allowed columns: {allowed}")


def _of_file(path, omega, values):
    try:
        return tabulated(omega, values, path.stem)
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None


FAMILIES = {
    "issc": issc,
    "mitsuyasu_bretschneider": mitsuyasu_bretschneider,
    "bretschneider": bretschneider,
    "jonswap": jonswap,
}


def _by_height(name, height, energy, periods, printed, significant, gamma=1.0):
    """energy : m₀/H²; printed : kind of period of the formula and Tp over it; significant : T1/3 / Tp"""
    height = within("wave height", positive("wave height", height, "m"), *HEIGHTS, "m")
    kind, value = the_one_period(name, periods)
    within(kind.replace("_", " "), value, *PERIODS, "s")
    unit = Peaked(name, 1.0, 1.0, gamma, significant)
    peak_period = value * (printed[1] if kind == printed[0] else unit.Tp / getattr(unit, KINDS[kind]))
    peak_omega = 2 * np.pi / peak_period
    spectrum = Peaked(name, energy * height**2 * peak_omega**4 / unit.moment(0), peak_omega, gamma, significant)
    warn_if_steep(spectrum)
    return spectrum


def warn_if_steep(spectrum):
    """Warn of waves that are steeper than possible"""
    steepness = 2 * np.pi * spectrum.significant_height / (GRAVITY * spectrum.T02**2)
    if steepness > STEEPEST:
        warnings.warn(
            f"{spectrum.name} spectrum: steepness 2πH/gT02² is {steepness:.3g}; seas break above {STEEPEST:g}; "
            "give a longer period or a lower height",
            stacklevel=4,
        )
