"""Number of panels of a box, buoy or ship for a tolerance, the coarser mesh for the error estimate, and finer meshes.

The error of all coefficients falls like the power −1.16 of the number of panels as long as no direction has only a
panel or two; the counts of `meshing.shapes` are over half the length, half the beam and the draft of a box, and over a
quarter of the circumference, the radius and the draft of a buoy; those of `meshing.ship` are over the length, half the
bottom, and bilge with side.
"""

import math

import numpy as np

from hakobune.bem.checks import ERROR_ORDER
from hakobune.meshing.shapes import box, box_counts, buoy, buoy_counts
from hakobune.meshing.ship import counts_of_ship, ship, ship_counts

MAKERS = {"box": (box, box_counts), "buoy": (buoy, buoy_counts), "ship": (ship, ship_counts)}
LEAST = {"box": (3, 3, 3), "buoy": (4, 3, 3), "ship": (12, 4, 8)}  # a buoy of twelve sides has yaw excitation
LONGEST = 7  # breadths, largest length for which panels across were counted
COARSE = 0.71  # factor on the counts of edges: about half as many panels
FEWEST = 2  # panels in a direction of the coarse mesh
FINER = 2**0.5  # factor on the counts: about twice as many panels
SHIP = 800.0  # panels of a ship at one per cent
TOO_CLOSE = 0.8  # share of panels above which a coarse mesh gives no estimate of the error


def panels_for(body, tolerance):
    """Panels on the whole hull of a box or buoy for a relative error of the coefficients.

    At one per cent 250 for a buoy; for a box 290, and more where the draft is about half the breadth: such a section
    moves little water in roll, so its added moment is small relative to the discretisation error; and few panels of
    a long box lie across the section.  Most of 110 such boxes needed 220 for a length of two breadths, 400 for five,
    500 for seven, the longest.  Of the scenes of tests/bench/tolerance.py 97 % are then within the tolerance.
    `fine_counts` gives more in short waves.
    """
    most = 250.0
    if body.shape == "ship":
        most = SHIP
    elif body.shape == "box":
        breadth, length = sorted((body.length, body.beam))
        rolls_easily = 1 / (1 + (5 * math.log10(breadth / (2.3 * body.draft))) ** 2)
        most = 290 + 50 * (np.clip(length / breadth, 2, LONGEST) - 2) * rolls_easily
    return math.ceil(most * (0.01 / tolerance) ** (1 / ERROR_ORDER))


def fine_counts(body, tolerance, longest, bottom=True):
    """Counts for a tolerance with no edge above `longest` (m), and in no direction below `LEAST`

    bottom : False for a box or buoy that stands on the bed
    """
    more = {"panels": panels_for(body, tolerance), "longest": longest}
    counts = MAKERS[body.shape][1](*sizes(body), **more, **_walls_only(bottom))
    return tuple(max(pair) for pair in zip(counts, LEAST[body.shape], strict=True))


def coarse_counts(body, mesh, fewest=FEWEST):
    """Counts of about half as many panels as a mesh of the body has, in the same proportion; None if it has few

    fewest : in a direction
    """
    fine = counts_of(body, mesh)
    coarse = tuple(max(fewest, round(COARSE * n)) for n in fine)
    coarser = all(c <= n for c, n in zip(coarse, fine, strict=True))
    return coarse if coarser and _total(body, coarse) <= TOO_CLOSE * _total(body, fine) else None


def finer_counts(body, mesh):
    """Counts of about twice as many panels as a mesh of the body has, in the same proportion"""
    return tuple(math.ceil(FINER * n - 0.25) for n in counts_of(body, mesh))


def counts_of(body, mesh):
    """The counts used for a quarter of the hull"""
    if body.shape == "ship":
        return counts_of_ship(mesh)
    levels = [len(np.unique(np.round(column / np.ptp(column), 6))) - 1 for column in mesh.points.T]
    if body.shape == "box":
        return tuple(levels)
    rim = int(np.sum(mesh.points[:, 2] > -1e-6 * body.draft)) - 1
    return rim, len(mesh) // rim - levels[2] or LEAST["buoy"][1], levels[2]


def meshed(body, counts, bottom=True, **panels):
    """PanelMesh with the given counts, or for None with `panels` panels; bottom : as in `fine_counts`"""
    keys = ("block", "bow", "stern", "waterplane") if body.shape == "ship" else ()
    form = {key: getattr(body, key) for key in keys}
    return MAKERS[body.shape][0](*sizes(body), **form, counts=counts, **panels, **_walls_only(bottom))


def _walls_only(bottom):
    return {} if bottom else {"bottom": False}


def sizes(body):
    """m, arguments of the meshes of `meshing.shapes`"""
    return (body.radius, body.draft) if body.shape == "buoy" else (body.length, body.beam, body.draft)


def _total(body, counts):
    along, across, down = counts
    if body.shape == "ship":
        return along * (across + down)
    return along * across + (along + across) * down if body.shape == "box" else along * (across + down)
