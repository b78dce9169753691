"""Faults of a measured record before its waves are counted: spikes, a varying level, wrong units.

A Gaussian record of a day has crests of 5 σ, in steep waves perhaps of 6 σ. A value beyond 8 robust deviations
(1.4826 times the median distance from the median) cannot be a wave.  The variance of means over 20 waves is a few
thousandths of the variance of the waves. A larger variance is due to tide, trend or instrument drift, and falsifies
heights and the longest periods. No wave is steeper than H/L = 1/7, L = gT²/2π (Michell, 1893); steeper waves show
that heights or times are in other units.
"""

import numpy as np

LARGEST = 8.0  # robust deviations
LEVEL = 0.02  # share of the variance in means of stretches
STEEPEST = 1 / 7  # height over length
WAVES = 20  # waves in a stretch of the record


def faults(record, step, mean_period, gravity=9.80665):
    """Faults, one line each, of a record (n,) m with steps of `step` s and waves of mean_period s"""
    height, length = 4 * float(np.std(record)), gravity * mean_period**2 / (2 * np.pi)
    if height > STEEPEST * length:
        yield (
            f"significant height {height:.4g} m at {mean_period:.3g} s: waves of {length:.3g} m are at most "
            f"{STEEPEST * length:.3g} m high; check that elevations are in m and times in s, or name the units "
            f"in the header, such as "
            '"eta (mm)"'
        )
    middle = np.median(record)
    deviation = 1.4826 * np.median(np.abs(record - middle))
    wild = np.flatnonzero(np.abs(record - middle) > LARGEST * deviation) if deviation > 0 else []
    if len(wild):
        i = int(wild[np.argmax(np.abs(record[wild] - middle))])
        yield (
            f"{len(wild)} values exceed {LARGEST:g} standard deviations of the record, {LARGEST * deviation:.3g} m; "
            f"the largest is {record[i]:.4g} m at {i * step:.4g} s: these are spikes; remove them"
        )
    length = max(2, int(np.ceil(WAVES * mean_period / step)))
    whole = len(record) // length
    if whole >= 3:
        means = record[: whole * length].reshape(whole, length).mean(axis=1)
        share = means.var() / record.var()
        if share > LEVEL:
            yield (
                f"the mean level moves by {np.ptp(means):.3g} m over the record, {100 * share:.3g} % of its variance, "
                f"limit {100 * LEVEL:g} %: the heights contain a tide or trend; remove it"
            )
