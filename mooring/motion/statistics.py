"""Statistics of records of a moored body, in the definitions of the SR179 report (1982), section 3.5.1.2.

    m₀ = σ²,  m₂ = mean ẋ²,  m₄ = mean ẍ²;  T_zero = 2π√(m₀/m₂),  T_peak = 2π√(m₂/m₄),  ε = √(1 − m₂²/(m₀m₄))

σ² is the sum of a slow part, from frequencies below a split, and a wave part, from frequencies above it. Means of
the highest third and tenth are taken over all maxima of the record, measured from its mean: they are amplitudes, not
heights. The expected extreme in a duration D is the mean plus

    X = σ {s + γ/s},   s = √(2 ln(n√(1−ε²))),   n = D/T_peak,   γ = 0.5772                      (3.5.1.5, 3.5.1.6)

where D is 1000 mean wave periods in the report. The formula holds for Gaussian records and serves only for
comparison with the report's tables. `extremes` treats the largest values of runs.
"""

from typing import NamedTuple

import numpy as np

from ..environment.crossings import local_maxima, zero_crossings
from ..response.extremes import expected_maximum

FEWEST_WAVES = 3  # zero crossings below which a record has no extreme
STEADY = 1e-9  # σ over the largest value of a record that does not vary
# σ over the largest of all motions or all forces, below which it is rounding of a value that is zero by symmetry.
# NOTHING is over the hull's length and weight, if nothing moves
ROUNDING, NOTHING = 1e-6, 1e-9
PLANE = {"surge": 0, "sway": 1, "yaw": 5}  # motions reported by windows of a record
FEWEST_IN_WINDOW = 5  # waves
WIDER = 0.1  # of a range, by which a body that has come to rest may leave it
LEFT = 8  # samples of half a record
FEW = 8.0  # frequencies in a record, below which it has lines and no spectrum, and its maxima no distribution


class RecordStatistics(NamedTuple):
    """Statistics of one record, in the unit of the record; periods in s.

    slow, wave : standard deviations of the slow part and of the wave part
    mean_third, mean_tenth : means of the highest maxima, from the mean
    largest, smallest : largest and smallest value; extreme : expected largest amplitude by the formula, or nan
    """

    mean: float
    sigma: float
    slow: float
    wave: float
    T_zero: float
    T_peak: float
    epsilon: float
    mean_third: float
    mean_tenth: float
    largest: float
    smallest: float
    extreme: float


def stillness(sigma, units, length, weight):
    """Standard deviation up to which a quantity counts as constant, by comparison with other motions and forces;
    shape (q,).

    sigma, units : (q,); units are "m", "rad", "N" or any other; length : length of the hull, m; weight : N.  An
        angle moves an end of the hull by
    half the length times the angle.
    """
    sigma, units = np.asarray(sigma, float), np.asarray(units)
    lever = np.where(units == "rad", 0.5 * length, 1.0)
    moves, out = np.isin(units, ("m", "rad")), np.zeros(len(sigma))
    for which, least in ((moves, NOTHING * length), (units == "N", NOTHING * weight)):
        size = ROUNDING * np.max((sigma * lever)[which], initial=0.0)
        out[which] = max(size, least) / lever[which]
    return out


def frequencies_in(record):
    """Number of frequencies in a record (n,): (ΣE)²/ΣE², with E the energies of its Fourier terms.

    It is about 2 for one wave, 4 for two waves, nearly the number of frequencies in the band for a sea, and 0 for a
    constant record
    """
    energy = np.abs(np.fft.rfft(np.asarray(record, float) - np.mean(record))[1:]) ** 2
    total = energy.sum()
    return float(total**2 / np.sum(energy**2)) if total > 0 else 0.0


def without_rounding(found, still):
    """`RecordStatistics` of a record whose σ is at most `still`: it counts as constant, and extremes up to `still`
    count as zero
    """
    if not found.sigma <= still:
        return found
    mean, *ends = (0.0 if abs(value) <= 3 * still else value for value in (found.mean, found.largest, found.smallest))
    return RecordStatistics(mean, *[0.0] * 3, *[np.nan] * 5, *ends, np.nan)


def record_statistics(record, step, split, duration=None):
    """RecordStatistics of equally spaced values.

    record : (n,); step : s; split : frequency between slow and wave part, rad/s
    duration : duration of the extreme, s, by default that of the record.
    A constant record has nan for all values that need maxima.  Raises ValueError for a record that is not finite.
    """
    return statistics_of_records([record], step, split, duration)[0]


def statistics_of_records(records, step, split, duration=None):
    """`record_statistics` of records (q, n), shape (q,); their spectra are computed together, in half the time.

    raises : ValueError as `record_statistics` does
    """
    x = np.ascontiguousarray(records, float)
    if x.ndim != 2 or x.shape[1] < 8 or not np.all(np.isfinite(x)):
        raise ValueError("a record has to be a one-dimensional array of at least 8 finite numbers")
    mean = x.mean(axis=1)
    y = x - mean[:, None]
    both = parts(y, step, split)
    duration = x.shape[1] * step if duration is None else duration
    return [_statistics(*one, step, duration) for one in zip(x, y, mean.tolist(), *both.tolist(), strict=True)]


def _statistics(x, y, mean, slow, wave, step, duration):
    """RecordStatistics of a record x (n,), y without its mean"""
    sigma = float(np.sqrt(np.mean(y**2)))
    ends = float(x.max()), float(x.min())
    if sigma <= STEADY * max(abs(mean), np.abs(ends).max(), 1e-300):
        return RecordStatistics(mean, sigma, *[0.0] * 2, *[np.nan] * 5, *ends, np.nan)
    zero, peak, epsilon = periods(y, step)
    tops, places = local_maxima(y)
    tops = np.sort(tops[places])[::-1]
    extreme = float(expected_maximum(sigma, duration, zero)) if duration > FEWEST_WAVES * zero else np.nan
    highest = (highest_mean(tops, 1 / 3), highest_mean(tops, 1 / 10))
    return RecordStatistics(mean, sigma, slow, wave, zero, peak, epsilon, *highest, *ends, extreme)


def parts(records, step, split):
    """Standard deviations below and above `split`, rad/s, of records (…, n) without mean; shape (2, …). The sum of
    squares is σ².
    """
    n = records.shape[-1]
    power = _power(records.reshape(-1, n))
    power[:, 1 : (n + 1) // 2] *= 2
    power[:, 0] = 0.0
    slow = 2 * np.pi * np.fft.rfftfreq(n, step) < split
    return np.array([(np.sqrt(power[:, part].sum(axis=1)) / n).reshape(records.shape[:-1]) for part in (slow, ~slow)])


def _power(records):
    """|Σ xₙ exp(−2πikn/N)|² of records (q, n); shape (q, n // 2 + 1)

    Two records are the parts of one complex one: where n is a large prime, as of 3 h in steps of 0.5 s, that takes half
    the time.  Both are of size one there, so that a small one does not take the rounding of a large one.
    """
    count, n = records.shape
    size = np.sqrt(np.mean(records**2, axis=1))
    unit = np.zeros((count + count % 2, n))
    np.divide(records, size[:, None], out=unit[:count], where=size[:, None] > 0)
    both = np.fft.fft(unit[::2] + 1j * unit[1::2])
    first, back = both[:, : n // 2 + 1], np.conj(both[:, -np.arange(n // 2 + 1)])
    power = np.stack([np.abs(first + back) ** 2, np.abs(first - back) ** 2], axis=1).reshape(len(unit), -1)
    return power[:count] * (0.5 * size[:, None]) ** 2


def slow_part(record, step, split):
    """Part of a record (n,) below `split` rad/s, including its mean, without delay"""
    part = np.fft.rfft(record)
    part[2 * np.pi * np.fft.rfftfreq(len(record), step) >= split] = 0.0
    return np.fft.irfft(part, len(record))


def in_plane(motion):
    """Surge, sway and yaw of all bodies of motions (t, n)"""
    return motion[:, [i for i in range(motion.shape[1] // 6 * 6) if i % 6 in PLANE.values()]]


def settled_from(time, motion, lost):
    """First sample from which motions (t, n) stay, after a line is lost at `lost` s, within their range in the second
    half of what is left of the record: at their new place.  0 without a loss, or with too little left for statistics"""
    first = int(np.searchsorted(time, lost))
    after = motion[first:]
    half = len(after) // 2
    if half < LEFT:
        return 0
    low, high = after[half:].min(axis=0), after[half:].max(axis=0)
    low, high = low - WIDER * (high - low), high + WIDER * (high - low)
    outside = np.flatnonzero(np.any((after < low) | (after > high), axis=1))
    return first + (int(outside[-1]) + 1 if len(outside) else 0)


def periods(record, step):
    """T_zero and T_peak (s) and ε of a record (n,) without mean, by differences exact to fourth order in the step."""
    x = record
    slope = (27 * (x[2:-1] - x[1:-2]) - (x[3:] - x[:-3])) / (24 * step)
    bend = (16 * (x[3:-1] + x[1:-3]) - 30 * x[2:-2] - x[4:] - x[:-4]) / (12 * step**2)
    m0, m2, m4 = (float(np.mean(part**2)) for part in (x, slope, bend))
    return 2 * np.pi * np.sqrt(m0 / m2), 2 * np.pi * np.sqrt(m2 / m4), float(np.sqrt(max(0.0, 1 - m2**2 / (m0 * m4))))


def highest_mean(falling, share):
    """Mean of the highest fraction `share` of values (n,) in descending order, at least one value; nan without
    values
    """
    return float(falling[: max(1, round(share * len(falling)))].mean()) if len(falling) else np.nan


def over_runs(values):
    """Root mean square, over the runs, of standard deviations (runs, …): the standard deviation of one joined record"""
    return np.sqrt(np.mean(np.square(values), axis=0))


class Windows(NamedTuple):
    """start : (w,) s; amplitude : significant amplitudes of surge, sway and yaw, (w, 3), m, m, rad; period : (w, 3) s

    nan where a window has fewer than FEWEST_IN_WINDOW waves
    """

    start: np.ndarray
    amplitude: np.ndarray
    period: np.ndarray


def windows(motion, step, length):
    """`Windows` of `length` s of a record (n, 6) m, rad, at steps of `step` s.

    Amplitudes are H₁/₃/2 of the waves between zero crossings about the window's mean. An incomplete last window is
    not included.
    """
    count = round(length / step)
    begin = count * np.arange((len(motion) - 1) // count)
    found = np.array([[_significant(motion[i : i + count + 1, k], step) for k in PLANE.values()] for i in begin])
    return Windows(begin * step, *np.moveaxis(found.reshape(len(begin), len(PLANE), 2), -1, 0))


def _significant(part, step):
    """Amplitude and period of a record (n,); nan of too few waves"""
    try:
        waves = zero_crossings(part - part.mean(), step)
    except ValueError:
        return np.nan, np.nan
    return (
        (0.5 * waves.significant_height, waves.significant_period)
        if len(waves) >= FEWEST_IN_WINDOW
        else (np.nan, np.nan)
    )
