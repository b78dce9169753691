"""Number of waves along a body, and its limit for methods without panels."""

import numpy as np

MOST_WAVES = {"box": 200, "buoy": 400}  # along the body: a box then takes 30 s, a buoy 10 s


def waves_along(sizes, k):
    """Number of waves of wavenumber k rad/m along a box (length, beam, draft) or across a buoy (radius, draft)"""
    return k * (max(sizes[:2]) if len(sizes) == 3 else 2 * sizes[0]) / (2 * np.pi)


def too_many(sizes, k):
    """Whether so many waves of wavenumber k lie along the body that they are not resolved"""
    return waves_along(sizes, k) > MOST_WAVES["box" if len(sizes) == 3 else "buoy"]
