"""Spectra of gusts, and records of gusts.

Each spectrum consists of a variance, a time scale T and a dimensionless shape s over X = T f, f in Hz, with ∫ s dX =
1:

    S(f) = σ² T s(T f),   S(ω) = S(f)/2π

    Davenport  σ² = 6 K U²          T = 1200/U               s = ⅔ X (1 + X²)^(−4/3)
    Hino       σ² = 2.856 b K U²    T = 1/β                  s = (1 + X²)^(−5/6) / b,    b = ½ B(½, ⅓) = 2.1033
    NPD        σ² = S(0)/(s(0) T)   T = f̃/f                  s = (1 + Xⁿ)^(−5/(3n)) / c,  c = B(1/n, 2/(3n))/n
    Kaimal     σ = I U              T = L/U                  s = 4 (1 + 6X)^(−5/3)

Davenport and Hino: SR179 report (1982), chapter 4, section 5.2. The exponent 4/3 and the 1/f are illegible in the
report's prints. β contains 10⁻³ here; the printed 10⁻² would put the energy at 2 Hz. NPD: NORSOK N-003 and API RP
2A-WSD, S = 320 (U₀/10)² (z/10)^0.45 / (1 + f̃ⁿ)^(5/(3n)), n = 0.468, f̃ = 172 f (z/10)^⅔ (U₀/10)^(−¾), U₀ the
one-hour mean at 10 m. Kaimal: IEC 61400-1, L = 8.1 Λ, Λ = 0.7 z up to 60 m and 42 m above.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from .allowed import positive, within

BETA_HINO = 1.169e-3  # printed with 10⁻²; 10⁻³ agrees with the inertial subrange 0.3 (f z/U)^(−2/3) u*²
N_NPD = 0.468
MISSED = 0.01  # share of the variance that a record may omit without a warning


class MissingVariance(UserWarning):
    """Warning: the frequency band of a record omits more than 1 % of the variance of its spectrum."""


@dataclass(frozen=True)
class GustSpectrum:
    """Spectrum of the speed along the mean wind.

    speed : m/s, mean; variance : m²/s²; time_scale : s; shape : key of SHAPES
    """

    name: str
    speed: float
    variance: float
    time_scale: float
    shape: str

    def __repr__(self):
        return f"<GustSpectrum {self.name}, {self.speed:g} m/s, σ = {self.deviation:.4g} m/s>"

    @property
    def deviation(self):
        """m/s, standard deviation"""
        return float(np.sqrt(self.variance))

    def density(self, omega):
        """Spectral density of gusts, m²/s² per rad/s, one-sided, at ω (…) ≥ 0, rad/s; shape (…)"""
        scale = self.time_scale / (2 * np.pi)
        return self.variance * scale * SHAPES[self.shape][0](scale * _frequencies(omega))

    def share(self, low, high):
        """Fraction of the variance between ω = low and high (…), rad/s; shape (…)"""
        scale, below = self.time_scale / (2 * np.pi), SHAPES[self.shape][1]
        return below(scale * _frequencies(high)) - below(scale * _frequencies(low))


def davenport(speed, surface_drag):
    """Davenport's spectrum; surface_drag : K, 0.003 in the report's guideline and 0.0015 in its simulations.

    speed : m/s, 10-minute mean at 10 m
    """
    positive("wind speed", speed, "m/s")
    within("surface drag K", surface_drag, 1e-4, 0.1)
    return GustSpectrum("Davenport", float(speed), 6 * surface_drag * speed**2, 1200.0 / speed, "davenport")


def hino(speed, surface_drag, height, exponent, stability=2.0):
    """Hino's spectrum at `height` m.

    exponent : α of the power law of the mean wind; stability : m, 2 in storms
    """
    positive("wind speed", speed, "m/s")
    within("surface drag K", surface_drag, 1e-4, 0.1)
    positive("height", height, "m")
    within("exponent of the wind profile", exponent, 1e-3, 0.5)
    positive("stability m", stability, "")
    power = 2 * stability * exponent - 1
    beta = BETA_HINO * speed * exponent / np.sqrt(surface_drag) * (height / 10.0) ** power
    variance = 2.856 * _half_beta() * surface_drag * speed**2
    return GustSpectrum("Hino", float(speed), variance, float(1 / beta), "hino")


def npd(hourly_speed, height=10.0):
    """Spectrum of the Frøya measurements at `height` m; hourly_speed : m/s, one-hour mean at 10 m.

    The measurements cover 1/600 to 0.5 Hz, which contains some 73 % of the variance of the spectrum.
    """
    positive("one-hour wind speed at 10 m", hourly_speed, "m/s")
    positive("height", height, "m")
    scale = 172.0 * (height / 10.0) ** (2 / 3) * (hourly_speed / 10.0) ** -0.75
    variance = 320.0 * (hourly_speed / 10.0) ** 2 * (height / 10.0) ** 0.45 / scale * _npd_integral()
    return GustSpectrum("NPD", float(hourly_speed), float(variance), float(scale), "npd")


def kaimal(speed, height, intensity):
    """Kaimal's spectrum of IEC 61400-1; speed : m/s, mean at `height` m; intensity : standard deviation over the mean
    speed"""
    positive("wind speed", speed, "m/s")
    positive("height", height, "m")
    within("turbulence intensity", intensity, 1e-4, 1.0)
    length = 8.1 * 0.7 * min(height, 60.0)
    return GustSpectrum("Kaimal", float(speed), float((intensity * speed) ** 2), float(length / speed), "kaimal")


def gust_record(spectrum, t, seed, low, high, count):
    """Gusts at the times t (n,), s, of zero mean, m/s; shape (n,); add the mean wind.

        u(t) = Σ √(2 σ² share(ωᵢ, ωᵢ₊₁)) cos(ω t + ε)

    The band from `low` to `high` rad/s is divided into `count` pieces of equal ratio. Each component has the energy of
    its piece, a random frequency within it and a random phase, so the record does not repeat.
    The components are close enough to excite a resonance with damping ζ if the ratio (high/low)^(1/count) is below 1
    + ζ.  The report's band, 0.001 to 1 Hz, contains 92 to 88 % of Davenport's variance at 25 to 50 m/s.
    seed : whole number from 0; the same seed gives the same record
    raises : ValueError; warns MissingVariance with the share of the variance inside the band
    """
    t = np.asarray(t, float)
    omega, amplitude, phase = gust_components(spectrum, seed, low, high, count)
    record = np.empty(t.size)
    for rows in np.array_split(np.arange(t.size), max(1, t.size * len(omega) // 2**20)):
        record[rows] = np.cos(np.multiply.outer(t.ravel()[rows], omega) + phase) @ amplitude
    return record.reshape(t.shape)


def gust_components(spectrum, seed, low, high, count):
    """Frequencies, rad/s, amplitudes, m/s, and phases, rad, of a record, each (count,); see `gust_record`."""
    positive("lowest frequency of the gusts", low, "rad/s")
    positive("highest frequency of the gusts", high, "rad/s")
    if not low < high:
        raise ValueError(f"gust frequencies run from {low:g} to {high:g} rad/s; allowed: increasing")
    if not (count == int(count) and count >= 1):
        raise ValueError(f"number of gust components is {count}; allowed: a whole number from 1")
    if not isinstance(seed, int | np.integer) or seed < 0:
        raise ValueError(f"seed is {seed!r}; allowed: a whole number from 0")
    _tell_missing(spectrum, low, high)
    random = np.random.default_rng(seed)
    edges = np.geomspace(low, high, int(count) + 1)
    omega = edges[:-1] * (edges[1:] / edges[:-1]) ** random.random(int(count))
    amplitude = np.sqrt(2 * spectrum.variance * spectrum.share(edges[:-1], edges[1:]))
    return omega, amplitude, random.uniform(0.0, 2 * np.pi, int(count))


def _tell_missing(spectrum, low, high):
    held = float(spectrum.share(low, high))
    if held < 1 - MISSED:
        warnings.warn(
            f"the gust band {low:.3g} to {high:.3g} rad/s contains {100 * held:.1f} % of the variance of "
            f"{spectrum.name} at {spectrum.speed:g} m/s; at least {100 * (1 - MISSED):g} % is needed; widen the "
            "band, or scale the record",
            MissingVariance,
            stacklevel=4,
        )


def _frequencies(omega):
    omega = np.asarray(omega, float)
    if not np.all(omega >= 0):
        raise ValueError(f"gust frequency is {omega[~(omega >= 0)].flat[0]:g} rad/s; allowed: at least 0")
    return omega


def _half_beta():
    from scipy.special import beta

    return float(0.5 * beta(0.5, 1 / 3))


def _npd_integral():
    """∫ (1 + Xⁿ)^(−5/(3n)) dX = B(1/n, 2/(3n)) / n"""
    from scipy.special import beta

    return float(beta(1 / N_NPD, 2 / (3 * N_NPD)) / N_NPD)


def _hino_below(x):
    from scipy.special import betainc

    return betainc(0.5, 1 / 3, _part(x, 2.0))


def _npd_below(x):
    from scipy.special import betainc

    return betainc(1 / N_NPD, 2 / (3 * N_NPD), _part(x, N_NPD))


def _part(x, n):
    """xⁿ/(1 + xⁿ), 1 at infinity"""
    with np.errstate(divide="ignore"):
        return 1 / (1 + x**-n)


# dimensionless density and the share of the variance below X
SHAPES = {
    "davenport": (lambda x: 2 / 3 * x * (1 + x**2) ** (-4 / 3), lambda x: 1 - (1 + x**2) ** (-1 / 3)),
    "hino": (lambda x: (1 + x**2) ** (-5 / 6) / _half_beta(), _hino_below),
    "npd": (lambda x: (1 + x**N_NPD) ** (-5 / (3 * N_NPD)) / _npd_integral(), _npd_below),
    "kaimal": (lambda x: 4 * (1 + 6 * x) ** (-5 / 3), lambda x: 1 - (1 + 6 * x) ** (-2 / 3)),
}
