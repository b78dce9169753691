"""What a regular wave does to a body, read from a database: mean drift force and amplitudes of motion.

Values between stored frequencies and headings are linear; outside them nothing is returned but an error.
"""

from __future__ import annotations

import numpy as np

WIDEST_GAP = np.deg2rad(45.0)  # between neighbouring headings; wider, a linear value would be a guess


class RangeError(ValueError):
    """A wave outside the stored frequencies or headings."""


def at_wave(db, name, period, direction):
    """Row of a stored quantity (omega, wave_direction, …) at a wave period (s) and direction (rad, travelled to)."""
    db.require(name)
    values = np.asarray(db[name])
    (i, j, s), (m, n, t) = _between_frequencies(db.omega, period), _between_headings(db.wave_direction, direction)
    corners = [(1 - s) * (1 - t), (1 - s) * t, s * (1 - t), s * t]
    rows = [values[i, m], values[i, n], values[j, m], values[j, n]]
    # a row that does not count may be nan: a frequency that failed
    result = sum(weight * row for weight, row in zip(corners, rows, strict=True) if weight > 0)
    if not np.all(np.isfinite(result)):
        raise RangeError(
            f"{name} is not known at period {period:g} s, direction {np.rad2deg(direction):g}°: "
            "its frequency failed; run the same solve again"
        )
    return result


def mean_drift(db, height, period, direction):
    """(3,) mean drift F_x, F_y in N and M_z in N m of a regular wave of height `height` m.

    SR179 report (1982), section 5.1.1: irregular waves are replaced by a regular wave with the significant
    height as its height and the mean period as its period.
    """
    return at_wave(db, "drift_force", period, direction) * (0.5 * height) ** 2


def motion_amplitudes(db, height, period, direction):
    """(6,) m and rad, amplitudes of the freely floating body in the same regular wave, about rotation_center."""
    return np.abs(at_wave(db, "rao", period, direction)) * 0.5 * height


def _between_frequencies(omega, period):
    """Two rows and the share of the second."""
    omega = np.asarray(omega, float)
    if not period > 0:
        raise ValueError(f"wave period is {period:g} s; allowed: above 0")
    wanted = 2 * np.pi / period
    near = int(np.argmin(np.abs(omega - wanted)))
    if abs(omega[near] - wanted) <= 1e-9 * wanted:
        return near, near, 0.0
    if not omega[0] < wanted < omega[-1]:
        raise RangeError(
            f"wave period {period:g} s (omega {wanted:.4g} rad/s) is outside the database, "
            f"{2 * np.pi / omega[-1]:.4g} to {2 * np.pi / omega[0]:.4g} s"
        )
    j = int(np.searchsorted(omega, wanted))
    return j - 1, j, (wanted - omega[j - 1]) / (omega[j] - omega[j - 1])


def _between_headings(headings, direction):
    """Two columns and the share of the second, on the circle."""
    offset = np.mod(np.asarray(headings, float) - direction + np.pi, 2 * np.pi) - np.pi
    near = int(np.argmin(np.abs(offset)))
    if abs(offset[near]) <= 1e-9:
        return near, near, 0.0
    below, above = np.where(offset < 0, offset, -np.inf), np.where(offset > 0, offset, np.inf)
    m, n = int(np.argmax(below)), int(np.argmin(above))
    gap = above[n] - below[m]
    if not gap <= WIDEST_GAP * (1 + 1e-9):
        stored = ", ".join(f"{np.rad2deg(b):g}" for b in headings)
        raise RangeError(
            f"wave direction {np.rad2deg(direction):g}° is not between stored headings at most 45° apart "
            f"({stored}°); add it to the scene's headings and solve again"
        )
    return m, n, -below[m] / gap
