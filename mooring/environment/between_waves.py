"""What a regular wave does to a body, read from a database: mean drift force and amplitudes of motion.

Between stored headings every quantity is linear.  Between stored frequencies drift is linear, and motions solve

    {−ω²[M + A] − iω[B] + [C]} X = F

with linear A, B and F: near a resonance X turns its phase by half a circle, and a mean of its two sides would
cancel.  Outside the stored frequencies and headings nothing is returned but an error.
"""

from __future__ import annotations

import numpy as np

WIDEST_GAP = np.deg2rad(45.0)  # between neighbouring headings; wider, a linear value would be a guess


class RangeError(ValueError):
    """A wave outside the stored frequencies or headings."""


def at_wave(db, name, period, direction):
    """Row of a stored quantity (omega, wave_direction, …) at a wave period (s) and direction (rad, travelled to)."""
    m, n, t = between_headings(db.wave_direction, direction)
    values = _at_period(db, name, period)
    return _known(_mixed(values[m], values[n], t), name, period)


def mean_drift(db, height, period, direction):
    """(3,) mean drift F_x, F_y in N and M_z in N m of a regular wave of height `height` m.

    SR179 report (1982), section 5.1.1: irregular waves are replaced by a regular wave with the significant
    height as its height and the mean period as its period.  It has twice the energy of the irregular waves.
    """
    return at_wave(db, "drift_force", period, direction) * (0.5 * height) ** 2


def motion_amplitudes(db, height, period, direction):
    """(6,) m and rad, amplitudes of the freely floating body in the same regular wave, about rotation_center."""
    if between_frequencies(db.omega, period)[2] == 0:
        motion = at_wave(db, "rao", period, direction)
    else:
        motion = _response(db, period, direction)
    return np.abs(motion) * 0.5 * height


def between_frequencies(omega, period):
    """Rows below and above a wave period (s), and the share of the second; RangeError outside."""
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


def between_headings(headings, direction):
    """Columns on both sides of a direction (rad) on the circle, and the share of the second; RangeError in a gap."""
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


def _at_period(db, name, period):
    """A stored quantity (omega, …) at a wave period (s)."""
    db.require(name)
    i, j, s = between_frequencies(db.omega, period)
    values = np.asarray(db[name])
    return _mixed(values[i], values[j], s)


def _mixed(first, second, share):
    # a row that does not count may be nan: a frequency that failed
    return first if share == 0 else (1 - share) * first + share * second


def _known(value, name, period):
    if not np.all(np.isfinite(value)):
        raise RangeError(f"{name} is not known at period {period:g} s: its frequency failed; run the same solve again")
    return value


def _response(db, period, direction):
    """(6,) complex motion per unit wave amplitude from coefficients and excitation at a wave period (s)."""
    from bem.motions import response

    if db.has_viscous_motions:
        raise RangeError(
            f"motions at period {period:g} s: the database has viscous damping in them, which is known at stored "
            "periods only; add the period to the scene and solve again"
        )
    coefficients = [_known(_at_period(db, n, period), n, period) for n in ("added_mass", "radiation_damping")]
    force = at_wave(db, "excitation_force", period, direction)
    return response(2 * np.pi / period, *coefficients, force[None, :], db.inertia_matrix, db.hydrostatic_stiffness)[0]
