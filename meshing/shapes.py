"""Meshes of a box and a buoy from their dimensions: quadrilaterals, smaller towards every edge and the waterline.

The potential of a body with right-angled edges is singular at the edges. With panels whose size decreases with the
square of the distance to the edge,

    half length  x_i = L/2 sin(π i / 2n),      draft  z_i = −d/2 (1 − cos(π i / n)),

the error of a constant-panel solution decreases with the square of the panel size. With equal panels the error
decreases only with the panel size.  The origin is the centre of the waterplane, and the hull ends at z = 0.
"""

import math
from dataclasses import replace

import numpy as np

from .gmsh_session import graded_patches
from .panels import PanelMesh

WELL_RESOLVED = (2, 2, 3)  # lowest counts of a hull with 200 panels or more


def box(length, beam, draft, *, panels=500, symmetry="xy", counts=None, grading=True, bottom=True, longest=math.inf):
    """Wetted surface of a box.

    length, beam, draft : m, along x, y, z
    panels : largest number of panels on the whole hull
    symmetry : mirror planes; "xy" meshes the part x ≥ 0, y ≥ 0; "x" the part x ≥ 0; "y" the part y ≥ 0; "" the whole
        box
    counts : numbers of panels (n_length, n_beam, n_draft) over half the length, half the beam and the draft, instead
        of `panels`; the whole hull then has 4 (n_length n_beam + (n_length + n_beam) n_draft) panels
    grading : False for equal panels; longest : greatest length of an edge, m; to keep it, `panels` may be exceeded
    bottom : whether the box has a bottom; False for a caisson that stands on the sea bed
    returns : PanelMesh; volume and areas are exact
    Raises ValueError for dimensions that are not positive and for too few panels.
    """
    _check_dimensions(length=length, beam=beam, draft=draft)
    n_length, n_beam, n_draft = _counts(counts) if counts else box_counts(length, beam, draft, panels, bottom, longest)
    x = length / 2 * _towards_end(n_length, grading)
    y = beam / 2 * _towards_end(n_beam, grading)
    z = _levels(draft, n_draft, grading, bottom)
    patches = [
        _rectangle(lambda s, t: (t, s, -draft), y, x),  # bottom
        _rectangle(lambda s, t: (length / 2, s, t), y, z[::-1]),  # end
        _rectangle(lambda s, t: (s, beam / 2, t), x[::-1], z[::-1]),  # side
    ][not bottom :]
    quarter = graded_patches(patches, "xy", f"box {length:g} x {beam:g} x {draft:g} m")
    return _unfolded(quarter, symmetry)


def buoy(radius, draft, *, panels=500, symmetry="xy", counts=None, grading=True, bottom=True, longest=math.inf):
    """Wetted surface of a vertical circular cylinder.

    radius, draft : m
    counts : numbers of panels (n_quarter, n_radius, n_draft) over a quarter of the circumference, the radius and the
        draft, instead of `panels`; the whole hull then has 4 n_quarter (n_radius + n_draft) panels
    bottom : whether the cylinder has a bottom; False for a cylinder that stands on the sea bed
    panels, symmetry, grading : as for `box`

    A polygon with N = 4 n_quarter sides, corners at the radius R √((2π/N) / sin(2π/N)) and the area of the circle
    replaces the circle: waterplane and volume are exact, and the wall is too long by the fraction π²/(6 N²).
    """
    _check_dimensions(radius=radius, draft=draft)
    if counts:
        n_quarter, n_radius, n_draft = _counts(counts)
    else:
        n_quarter, n_radius, n_draft = buoy_counts(radius, draft, panels, bottom, longest)
    rim = _quarter_rim(radius, n_quarter)
    z = _levels(draft, n_draft, grading, bottom)
    patches = _facets(rim, z)
    if bottom:
        patches.append(_disc_sector(rim, _towards_end(n_radius, grading), -draft))
    quarter = graded_patches(patches, "xy", f"buoy {radius:g} m radius x {draft:g} m")
    return _unfolded(quarter, symmetry)


class TooFewPanels(ValueError):
    """The requested number of panels is smaller than the shape needs; least : smallest number for this hull"""

    def __init__(self, panels, least):
        super().__init__(f"panels is {panels}; allowed: at least {least} on the whole hull")
        self.least = least


def box_counts(length, beam, draft, panels=500, bottom=True, longest=math.inf):
    """Return (n_length, n_beam, n_draft) for at most `panels` on the whole hull.

    The counts are proportional to the square roots of half the length, half the beam and twice the draft (which has an
    edge at both ends). Cosine grading then makes panels equally thin at every edge of the hull; these edges determine
    the accuracy.
    On a box of 400 × 50 × 10 m with 450 panels the largest error of added mass is 0.3 % with (12, 4, 4) and 2 % with
    (23, 2, 3).
    longest : greatest length of an edge, m, kept even if it needs more panels (short waves)
    """
    a, b = length / 2, beam / 2
    return fitted_counts((a, b, 2 * draft), lambda n: 4 * (n[0] * n[1] * bottom + (n[0] + n[1]) * n[2]), panels,
                   (_most(a, longest), _most(b, longest), _most(draft, longest)))  # fmt: skip


def buoy_counts(radius, draft, panels=500, bottom=True, longest=math.inf):
    """Return (n_quarter, n_radius, n_draft) for at most `panels` on the whole hull, by the rule of `box_counts`."""
    return fitted_counts((radius, radius, 2 * draft), lambda n: 4 * n[0] * (n[1] * bottom + n[2]), panels,
                   (_most(radius, longest), _most(radius, longest), _most(draft, longest)))  # fmt: skip


def _most(extent, longest):
    """Panels over an extent for which the longest edge, π/2 times the mean by cosine grading, is at most `longest`."""
    return math.ceil(math.pi / 2 * extent / longest) if longest < math.inf else 1


def fitted_counts(edges, total, panels, needed):
    """The largest counts, proportional to the square roots of `edges`, for which `total` is at most `panels`.

    Panels that rounding leaves over go to the direction farthest below its target. No count is less than `needed`.
    """
    wishes = np.sqrt(edges)
    lowest = WELL_RESOLVED if panels >= 200 else (1, 1, 2)
    if not panels >= total(lowest):
        raise TooFewPanels(panels, total(lowest))
    lowest = np.maximum(lowest, needed)
    panels = max(panels, total(lowest))
    steps = np.sort(np.arange(int(panels) + 1)[:, None] / wishes, axis=None)  # `total` grows at these factors
    counts = np.maximum(lowest, np.floor(steps[:, None] * wishes * (1 + 1e-9)).astype(int))
    best = counts[np.count_nonzero(total(counts.T) <= panels) - 1].tolist()
    while True:
        more = [[n + (i == k) for i, n in enumerate(best)] for k in range(3)]
        fits = [k for k in range(3) if total(best) < total(more[k]) <= panels]
        if not fits:
            return tuple(best)
        best = more[max(fits, key=lambda k: wishes[k] / best[k])]


def _check_dimensions(**dimensions):
    for name, value in dimensions.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value} m; allowed: a positive length")


def _counts(counts):
    numbers = tuple(counts)
    if len(numbers) != 3 or any(int(n) != n or n < 1 for n in numbers):
        raise ValueError(f"counts is {counts}; allowed: three whole numbers from 1")
    return tuple(int(n) for n in numbers)


def _towards_end(n, grading):
    """Numbers from 0 to 1, closest together at 1; shape (n+1,)"""
    i = np.arange(n + 1) / n
    fractions = np.sin(np.pi / 2 * i) if grading else i
    fractions[-1] = 1.0
    return fractions


def _towards_both(n, grading):
    """Numbers from 0 to 1, closest together at both ends; shape (n+1,)"""
    i = np.arange(n + 1) / n
    return np.sin(np.pi / 2 * i) ** 2 if grading else i


def _levels(draft, n, grading, bottom):
    """Heights from 0 to −draft, m; shape (n+1,); finest at the waterline and at an edge of the keel; at the bed there
    is no edge"""
    if bottom:
        return -draft * _towards_both(n, grading)
    return -draft * (1 - _towards_end(n, grading)[::-1])


def _rectangle(place, s, t):
    """Four sides of the rectangle of points place(s, t), in the order s, t, −s, −t"""
    sides = (s, t[0]), (s[-1], t), (s[::-1], t[-1]), (s[0], t[::-1])
    return [np.stack(np.broadcast_arrays(*place(*side)), axis=1) for side in sides]


def _quarter_rim(radius, n):
    """Corners in the first quadrant of the polygon of 4n sides with the area of the circle; shape (n+1, 2)"""
    angle = np.pi / 2 * np.arange(n + 1) / n
    step = np.pi / 2 / n
    rim = radius * math.sqrt(step / math.sin(step)) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rim[-1, 0] = 0.0  # exactly on the mirror plane
    return rim


def _facets(rim, z):
    """Plane patches of the wall, one per side of the polygon, one panel wide"""
    upward = z[::-1]
    facets = []
    for ends in np.stack([rim[:-1], rim[1:]], axis=1):
        facets.append(_rectangle(lambda s, t, ends=ends: (*ends[s].T, t), np.arange(2), upward))
    return facets


def _disc_sector(rim, fractions, z):
    """Patch of the bottom, polar about the axis, its normal down"""
    along_y = np.array([(*(f * rim[-1]), z) for f in fractions])
    along_x = np.array([(*(f * rim[0]), z) for f in fractions[::-1]])
    return [along_y, np.array([(*p, z) for p in rim[::-1]]), along_x]


def _unfolded(quarter, symmetry):
    """The part that is stored with the planes `symmetry`, from a quarter of the hull"""
    written_out = "".join(axis for axis in "xy" if axis not in symmetry)
    part = PanelMesh(quarter.points, quarter.corners, written_out, quarter.name)
    return replace(part.whole() if written_out else part, symmetry=symmetry)
