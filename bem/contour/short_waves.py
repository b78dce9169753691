"""Waves too short to be resolved along a body: where they begin, and the error of the asymptotic solution.

`short_wave_frequency` takes waves by `plan.wedge_diffraction`, and the gap flow of the motions smooth along the walls.
Neglected are

    diffracted waves of order 1/kb relative to those of a corner, b the shorter side;
    transmission under the keel of the waves that corners send along a wall, of order E = ∫ Z² dz under the keel over
    that of the whole depth; along a wall of length a, at the angle γ to the wave, it stays in phase with the wave;
    the variation of the gap flow within a wavelength from a corner.

With s and g the root mean square along the contour of ∫ Z ∂φ/∂n dz of a unit motion, on the side and in the gap,

    excitation      (ρg/k) [s (12/kb + 6EG) + g],    G = 1/√(1 − |cos γ| + 1/ka), the larger of both walls'
    Z = A + iB/ω    (8ρ/k² ∫ Z² dz) (sᵢ + gᵢ)(sⱼ + gⱼ)(12/kb + 6E)

bound it (with the difference from a finer body added).  Against resolved waves, 30 to 90 along 60 random boxes with
kd 0.75 … 9, gaps of 0.005 to 10 drafts and five headings each, errors of the excitation were 0.2 of this in the
middle and 0.9 at most in surge, sway and yaw, 0.6 in heave, roll and pitch; Z was within 0.002 of its size
(tests/bench/short_waves.py).  For a circle nothing is neglected: angular orders are uncoupled, and the motions
have the first two.
"""

from __future__ import annotations

import numpy as np

MOST_WAVES = {"box": 200, "buoy": 400}  # along the body, resolved: a box takes 30 s then, a buoy 10 s
MOST_UNRESOLVED = 100_000  # along the body, for the asymptotic solution: its far field is summed over as many angles
SHORTEST_SIDE, LEAST_DRAFT = 55.0, 0.5  # kb and kd of a box down to which the above was measured
CORNERS, KEEL = 12.0, 6.0


def waves_along(sizes, k):
    """Number of wavelengths of k rad/m along a box (length, beam, draft) or across a buoy (radius, draft)"""
    return k * _widths(sizes).max() / (2 * np.pi)


def too_many(sizes, k):
    """Whether there are too many waves along the body to be resolved"""
    return waves_along(sizes, k) > MOST_WAVES[_shape(sizes)]


def unresolved(sizes, k):
    """Whether the asymptotic solution is used: too many waves to be resolved, within its measured range"""
    known = _shape(sizes) == "buoy" or (k * _widths(sizes).min() >= SHORTEST_SIDE and k * sizes[-1] >= LEAST_DRAFT)
    return known and too_many(sizes, k) and waves_along(sizes, k) <= MOST_UNRESOLVED


def share_below(k, draft, depth):
    """E of the module docstring, for a wave of k rad/m"""
    gap = depth - draft
    image = 4 * k * np.exp(-2 * k * depth)
    below = np.exp(-2 * k * draft) * -np.expm1(-4 * k * gap) + gap * image
    return below / (-np.expm1(-4 * k * depth) + depth * image)


def neglected(k, lengths, share, beta):
    """(12/kb + 6E, (m,) 12/kb + 6EG) of a box of `lengths` along x and y for waves towards `beta` (m,)"""
    walls = 1 - np.abs([np.cos(beta), np.sin(beta)]) + 1 / (k * np.array(lengths)[:, None])
    corners = CORNERS / (k * min(lengths))
    return corners + KEEL * share, corners + KEEL * share / np.sqrt(walls.min(axis=0))


def _shape(sizes):
    return "box" if len(sizes) == 3 else "buoy"


def _widths(sizes):
    return np.array(sizes[:2]) if _shape(sizes) == "box" else 2 * np.array(sizes[:1])
