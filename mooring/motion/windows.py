"""Motions of a ship at a berth in the plane, window by window."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..environment.crossings import zero_crossings

PLANE = {"surge": 0, "sway": 1, "yaw": 5}
FEWEST = 5  # waves of a window


class Windows(NamedTuple):
    """start : (w,) s; amplitude : (w, 3) m, m, rad, significant, of surge, sway and yaw; period : (w, 3) s

    nan of fewer than FEWEST waves
    """

    start: np.ndarray
    amplitude: np.ndarray
    period: np.ndarray


def windows(motion, step, length):
    """`Windows` of `length` s of a record (n, 6) m, rad, at steps of `step` s.

    Amplitudes are halves of H₁/₃ of the waves between zero crossings about the window's mean.  A last window that is
    not whole is left out.
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
    return (0.5 * waves.significant_height, waves.significant_period) if len(waves) >= FEWEST else (np.nan, np.nan)
