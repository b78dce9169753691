"""Waves at a slewing body: forces of each component and mean drift over the headings; growth of waves at the start."""

import numpy as np

from ..motion.tables.wave_windows import HEADINGS
from ..motion.wave_loads import drift_damping

LOWEST = 1e-3  # share of the waves' energy below the split of slow and wave motion
ORDER, PADDED = 8, 3  # order of the forward–backward filter at the split, and padding at either end in its periods
RING = 72  # headings of the forces or motions of a component
GROWS = 2  # mean periods in which waves grow to their full height


def headings():
    """Directions of the waves from the bow, rad, evenly spaced from 0; shape (RING,)"""
    return np.arange(RING) * (2 * np.pi / RING)


def mean_frequency(omega, amplitude):
    """Mean frequency of components (n,), rad/s, weighted with their energy"""
    return float(omega @ amplitude**2 / (amplitude @ amplitude))


def split_frequency(omega, amplitude):
    """Frequency, rad/s, below which only LOWEST of the energy of components (n,) lies; lower frequencies count as
    slow motion
    """
    order = np.argsort(omega)
    energy = np.cumsum(np.square(amplitude)[order])
    return float(omega[order][np.searchsorted(energy, LOWEST * energy[-1])])


def slow_part(motion, step, split):
    """Part below `split`, rad/s, of a record (n, …) at equal steps, s, without delay: gain 1/(1 + (ω/split)¹⁶)

    A causal filter has a delay, which would appear as motion in waves.
    """
    from scipy.signal import butter, sosfiltfilt

    wide = min(split * step / np.pi, 0.99)
    padded = min(int(PADDED * 2 * np.pi / (split * step)), len(motion) - 1)
    return sosfiltfilt(butter(ORDER, wide, output="sos"), motion, axis=0, padlen=padded)


def share_of_height(time, after, mean_omega):
    """Fraction of the full height of waves that start at `after`, s, and grow over GROWS periods of `mean_omega`;
    shape (n,)
    """
    return np.clip((time - after) * mean_omega / (2 * np.pi * GROWS), 0.0, 1.0)


def at_heading(ring, turn):
    """Values of a table (RING, …), or of a table for each angle (m, RING, …), at angles (m,) rad from the bow; shape
    (m, …); linear
    """
    place = np.mod(turn, 2 * np.pi) * (RING / (2 * np.pi))
    low = np.floor(place).astype(int)
    share = (place - low)[:, None]
    if ring.ndim == 2:
        return (1 - share) * ring[low % RING] + share * ring[(low + 1) % RING]
    one = np.arange(len(low))
    return (1 - share) * ring[one, low % RING] + share * ring[one, (low + 1) % RING]


def mean_drift(forces, sea, carrier=None, depth=np.inf, gravity=9.80665):
    """Mean drift in axes of the body, at headings from 0 all round, in a `Sea`, N, N, N m; shape (HEADINGS, 3).

    forces : `mooring.motion.wave_loads.WaveForces` with drift
    carrier : `mooring.on_current.waves.Carrier` of the waves in `depth` m, which gives D + B V; or None
    """
    headings = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    density = np.asarray(sea.spectrum.density(forces.omega))
    mean = 2 * np.trapezoid(forces.drift * density[:, None, None], forces.omega, axis=0)
    if carrier is None:
        return np.stack([sea.directional(headings + heading) @ mean for heading in headings])
    own = np.clip(
        carrier.own(forces.omega, sea.direction, depth, gravity), forces.omega[0], forces.omega[-1]
    )  # a spread sea is replaced by its mean direction
    drift, B = drift_damping(forces, own, depth, gravity)
    mean, damping = (2 * np.trapezoid((of.T * density).T, forces.omega, axis=0) for of in (drift, B))
    towards, speed, rows = np.arctan2(carrier.velocity[1], carrier.velocity[0]), np.hypot(*carrier.velocity), []
    for heading in headings:
        velocity = speed * np.array([np.cos(towards - heading), np.sin(towards - heading)])
        rows.append(sea.directional(headings + heading) @ (mean + damping @ velocity))
    return np.stack(rows)
