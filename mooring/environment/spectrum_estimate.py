"""Spectrum of a record, by averaging windowed periodograms of overlapping segments (Welch 1967).

    S(ω_k) = 2δ/(2π Σw²) ⟨|Σ w_n η_n exp(−iω_k nδ)|²⟩,    ω_k = 2πk/(Nδ)
    ν = 2K / {1 + 2 Σ_j (1 − j/K) ρ_j},    ρ_j = {Σ w_n w_{n+jD} / Σ w²}²

with K segments of N values shifted by D.  νŜ/S is distributed as χ² with ν degrees of freedom.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import chdtri

from .allowed import positive, row_of_numbers
from .spectra import tabulated

SEGMENTS, LONGEST = 8, 1024  # number of segments in a record, and largest number of values in one, by default
FEWEST = 16  # values in a segment
WINDOWS = ("hann", "none")


class Estimate(NamedTuple):
    """omega (n,) rad/s; density (n,) m² s/rad. 0 and the highest frequency are left out: estimates there have half
    the degrees of freedom.
    """

    omega: np.ndarray
    density: np.ndarray
    degrees_of_freedom: float

    def confidence(self, level=0.95):
        """Two (n,) arrays, m² s/rad, between which the true density lies with probability `level`"""
        if not 0 < level < 1:
            raise ValueError(f"confidence level is {level:g}; allowed: between 0 and 1")
        nu = self.degrees_of_freedom
        tail = 0.5 * (1 - level)
        return nu * self.density / chdtri(nu, tail), nu * self.density / chdtri(nu, 1 - tail)

    def spectrum(self, name="record"):
        """The estimate as a Spectrum"""
        return tabulated(self.omega, self.density, name)


def estimate(record, step, segment=None, window="hann", overlap=0.5):
    """Estimate of the spectrum of a record.

    record : (n,) m, from which the mean is subtracted; step : s
    segment : length of a segment, s, by default an eighth of the record, at most 1024 values; the frequency step is
        2π over this length
    window : "hann" or "none"; "none" with a segment as long as the record gives the periodogram
    overlap : fraction of a segment that overlaps with the next segment, 0 to below 1.
    Raises ValueError for a record or segment that is too short, and for a record without waves.
    """
    record, step = row_of_numbers("record", record, FEWEST), positive("step", step, "s")
    if window not in WINDOWS:
        raise ValueError(f"window is {window!r}; allowed: {', '.join(WINDOWS)}")
    if not 0 <= overlap < 1:
        raise ValueError(f"overlap is {overlap:g}; allowed: 0 to below 1")
    n = _values_in_segment(len(record), step, segment)
    shift = max(1, round(n * (1 - overlap)))
    w = np.ones(n) if window == "none" else 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n) / n)
    starts = np.arange(0, len(record) - n + 1, shift)
    parts = (record - record.mean())[starts[:, None] + np.arange(n)] * w
    power = np.mean(np.abs(np.fft.rfft(parts, axis=1)) ** 2, axis=0)
    if not power.any():
        raise ValueError(f"record is {record[0]:g} m throughout; give a record with waves")
    inner = slice(1, (n + 1) // 2)
    omega = 2 * np.pi * np.fft.rfftfreq(n, step)
    density = step / (np.pi * np.sum(w**2)) * power
    return Estimate(omega[inner], density[inner], _degrees_of_freedom(w, shift, len(starts)))


def _values_in_segment(n, step, segment):
    if segment is None:
        return min(n, max(FEWEST, min(LONGEST, n // SEGMENTS)))
    length = round(positive("segment", segment, "s") / step)
    if not FEWEST <= length <= n:
        raise ValueError(
            f"segment is {segment:g} s, {length} values; allowed: {FEWEST * step:g} to {n * step:g} s, the "
            f"length of the record"
        )
    return length


def _degrees_of_freedom(w, shift, count):
    spread = 1.0
    for j in range(1, count):
        if j * shift >= len(w):
            break
        spread += 2 * (1 - j / count) * (np.dot(w[j * shift :], w[: -j * shift]) / np.dot(w, w)) ** 2
    return 2 * count / spread
