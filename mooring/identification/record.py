"""Records of a test: evenly spaced times, and the sine that best fits a motion."""

from typing import NamedTuple

import numpy as np

FEWEST = 16  # values
UNEVEN = 5e-3  # largest relative variation of the time step; records print few digits


class RecordError(ValueError):
    """A record cannot be used; the message names the fault and the limit."""


class Sine(NamedTuple):
    """mean + amplitude sin(omega t + phase), m, rad/s, rad; off : root mean square of the residual, m"""

    mean: float
    amplitude: float
    omega: float
    phase: float
    off: float


def checked(time, *columns):
    """Times from 0 s and columns as arrays.  Raises RecordError for gaps, for values that are not numbers, and for
    too few rows.
    """
    t = np.asarray(time, float)
    columns = [np.asarray(column, float) for column in columns]
    if len(t) < FEWEST or any(column.shape != t.shape for column in columns):
        raise RecordError(f"the record has {len(t)} times; allowed: {FEWEST} or more, with the same number of values")
    bad = [i for i in range(len(t)) if not all(np.isfinite(column[i]) for column in (t, *columns))]
    if bad:
        raise RecordError(f"row {bad[0] + 1} of the record has a value that is not a number")
    step = np.median(np.diff(t))
    wrong = np.flatnonzero(~(np.abs(np.diff(t) - step) <= UNEVEN * abs(step))) if step > 0 else [0]
    if len(wrong):
        i = int(wrong[0])
        raise RecordError(
            f"the time step of the record is {t[i + 1] - t[i]:g} s after {t[i]:g} s and {step:g} s elsewhere; "
            f"allowed: increasing times without gaps"
        )
    return t - t[0], *columns


def sine_of(time, motion):
    """`Sine` fitted to a motion by least squares.  Raises RecordError for less than two cycles."""
    from scipy.optimize import least_squares

    y = motion - motion.mean()
    density = np.abs(np.fft.rfft(y * np.hanning(len(y))))
    first = 2 * np.pi * np.fft.rfftfreq(len(y), time[1] - time[0])[1 + int(density[1:].argmax())]

    def parts(omega):
        basis = np.stack([np.sin(omega * time), np.cos(omega * time), np.ones_like(time)], axis=1)
        share = np.linalg.lstsq(basis, motion, rcond=None)[0]
        return share, motion - basis @ share

    width = 2 * np.pi / time[-1]
    found = least_squares(
        lambda w: parts(w[0])[1], [first], bounds=(max(first - width, 0.2 * first), first + width), x_scale=first,
        xtol=1e-15, ftol=1e-15, gtol=1e-15,
    )  # fmt: skip
    omega = float(found.x[0])
    (s, c, mean), left = parts(omega)
    if omega * time[-1] < 4 * np.pi:
        raise RecordError(f"the record contains {omega * time[-1] / (2 * np.pi):.2g} cycles; allowed: two or more")
    return Sine(float(mean), float(np.hypot(s, c)), omega, float(np.arctan2(c, s)), float(np.sqrt(np.mean(left**2))))
