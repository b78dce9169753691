"""Hull of a ship from a few numbers: flat bottom, bilge, upright stem and stern, parallel middle body.

    y(x, s) = f(x) Y(s),  z = Z(s):    a rectangle B/2 × d with its corner rounded by r₀, made narrower towards the
    ends by f = 1 − tᵖ, t the share of entrance or run from its inner to its outer end, p = φ/(1 − φ)

φ is the fullness of the waterplane at the bow or the stern.  With the coefficient of the middle section C_M = 1 − (1 −
π/4)
2r₀²/(B d) the block coefficient is

    C_B = C_M {1 − l [(1 − φ_b) + (1 − φ_s)]},

where l is the length of the entrance, and of the run, over the length of the ship.  If φ_b and φ_s are given, l follows
from them; otherwise l is LONG, and φ = φ_b = φ_s follows from l.
If the waterplane coefficient C_WP = 1 − 2l (1 − φ) is given, the fullness φ changes linearly from the keel to the
waterline, so that the volume is C_B L B d: the ends are V-shaped where C_WP is above C_B/C_M. In this case l is 0.4, or
0.5 where 0.4 is not enough.  Panels are graded towards both ends, the bilge and the waterline. A factor on the
half-breadths makes the volume of the panels L B d C_B; it differs from 1 by the square of the panel size.
x points to the bow.
"""

import math
import warnings
from dataclasses import replace

import numpy as np

from .hydrostatics import waterplane_area
from .panels import structured

LONG, LONGEST = 0.4, 0.5  # usual and largest length of the entrance, over the length
FULLNESS, BLOCKS = (0.3, 0.97), (0.4, 0.95)
BILGE = 0.25  # radius over draft, and at most over half the beam
CORNER = 1 - math.pi / 4
FEWEST = 8, 2, 4
# weights of length, half beam and draft in the numbers of panels.  Half of those of the side are on the bilge: with two
# there roll has 4 % less added mass and 9 % less damping than with ten, with five 0.3 % and 1 %; 800 panels over the
# length, bottom and side as 28, 4, 10 leave a third of the errors of 40, 5, 6 (`python tests/bench/ship_panels.py`)
SHARES = 4.0, 1.0, 8.0
ROUNDS = 12  # of what is asked of the ends, until their panels have the waterplane asked for
OFF = 0.005  # relative difference of the waterplane above which it is told


def ship(
    length, beam, draft, block, *, bow=None, stern=None, waterplane=None, panels=500, counts=None, longest=math.inf
):
    """`PanelMesh` of half a ship, y ≥ 0.

    length, beam, draft : m; block : C_B; bow, stern : fullness φ of entrance and run, both or neither
    waterplane : C_WP, in place of bow and stern; panels : largest number of panels on the whole hull
    counts : numbers of panels (n_length, n_bottom, n_side) over the length, half the bottom, and bilge with side (at
        least 2), instead of `panels`; the whole hull then has 2 n_length (n_bottom + n_side) panels
    longest : as for `shapes.box`
    raises : ValueError, with a message of one line
    """
    for name, value in (("length", length), ("beam", beam), ("draft", draft)):
        if not 0 < value < math.inf:
            raise ValueError(f"{name} is {value} m; allowed: a positive length")
    counts = counts or ship_counts(length, beam, draft, panels, longest)
    name = f"ship {length:g} x {beam:g} x {draft:g} m, block coefficient {block:g}"
    radius = BILGE * min(draft, 0.5 * beam)
    sizes = (length, beam, draft), radius, counts
    if waterplane is None:
        made = _drawn(*sizes, *_form(block, 1 - CORNER * 2 * radius**2 / (beam * draft), bow, stern))
    elif bow is not None or stern is not None:
        raise ValueError("waterplane is given together with fullness of bow or stern; give only one of the two")
    else:
        made = _with_waterplane(sizes, np.array([block, waterplane]))
    wide = np.array([1.0, block * length * beam * draft / made.volume, 1.0])
    return replace(made, points=made.points * wide, name=name)


def _with_waterplane(sizes, asked):
    """PanelMesh of a ship whose panels have the C_B and C_WP asked for, (2,): flat panels cut the rounds of the hull

    Where the ends would have to be fuller or finer than is drawn, the nearest that is.  Raises ValueError as
    `_fullness`.
    """
    (length, beam, draft), radius, _ = sizes
    box, given, nearest = length * beam * np.array([draft, 1.0]), asked, np.inf
    for _ in range(ROUNDS):
        try:
            along, (keel, top) = _fullness(*given, radius / (0.5 * beam), radius / draft)
        except ValueError:
            if given is asked:
                raise
            break
        drawn = _drawn(*sizes, along, np.array([keel, top]), np.array([keel, top]))
        off = asked - np.array([drawn.volume, waterplane_area(drawn)]) / box
        if np.abs(off).max() < nearest:
            made, nearest = drawn, np.abs(off).max()
        given = given + off
    found = waterplane_area(made) / made.volume * draft * asked[0]
    if abs(found - asked[1]) > OFF * asked[1]:
        warnings.warn(
            f"the panels of the ship reach a waterplane coefficient of {found:.4g}, but {asked[1]:g} is asked "
            f"for; allowed: a difference of up to {100 * OFF:g} %; the ends of the ship cannot be drawn finer "
            "or fuller; give more panels or another coefficient",
            stacklevel=4,
        )
    return made


def _drawn(sizes, radius, counts, along, bow, stern):
    """PanelMesh of half a ship by the share of the length of its ends and their fullness, one or at keel and top"""
    length, beam, draft = sizes
    n_length, n_bottom, n_side = counts
    u = np.arange(n_length + 1) / n_length
    x = 0.5 * (u - 0.5) - 0.25 * np.cos(np.pi * u)  # a pointed end is no edge: panels half as long as with even spacing
    t = np.maximum((np.abs(x) - (0.5 - along)) / along, 0.0)
    girth = _girth(n_bottom, n_side, 0.5 * beam, draft, radius)[::-1]
    at_depth = [np.interp(girth[:, 1], [-draft, 0.0], np.broadcast_to(end, 2)) for end in (bow, stern)]
    fullness = np.where(x[:, None] > 0, *at_depth)
    f = 1 - t[:, None] ** (fullness / (1 - fullness))
    f[[0, -1]] = 0.0
    points = np.stack(np.broadcast_arrays(length * x[:, None], f * girth[:, 0], girth[:, 1]), axis=-1)
    return replace(structured(points), symmetry="y")


def _form(block, middle, bow, stern):
    """Share of the length of entrance and of run, and the fullness of both"""
    if not BLOCKS[0] <= block <= BLOCKS[1]:
        raise ValueError(f"block coefficient is {block:g}; allowed: {BLOCKS[0]:g} to {BLOCKS[1]:g}")
    if (bow is None) != (stern is None):
        raise ValueError("fullness is given for only one of bow and stern; give both or neither")
    missing = 1 - block / middle
    if bow is None:
        bow = stern = 1 - missing / (2 * LONG)
        along = LONG
    else:
        for name, value in (("bow", bow), ("stern", stern)):
            if not FULLNESS[0] <= value <= FULLNESS[1]:
                raise ValueError(f"fullness of the {name} is {value:g}; allowed: {FULLNESS[0]:g} to {FULLNESS[1]:g}")
        along = missing / (2 - bow - stern)
    if missing <= 0 or not 0 < along <= LONGEST or not FULLNESS[0] <= bow <= FULLNESS[1]:
        raise ValueError(
            f"block coefficient {block:g} with fullness {bow:g} and {stern:g} needs an entrance of "
            f"{100 * along:.3g} % of the length; allowed: up to {100 * LONGEST:g} %"
        )
    return along, bow, stern


def _fullness(block, waterplane, wide, high):
    """Share of the length of entrance and run, LONG or else LONGEST, and φ at keel and at waterline

    block, waterplane : coefficients; wide, high : radius of the bilge over half the beam, and over the draft
    """
    if not BLOCKS[0] <= block <= BLOCKS[1]:
        raise ValueError(f"block coefficient is {block:g}; allowed: {BLOCKS[0]:g} to {BLOCKS[1]:g}")
    # ∫ Y dz and ∫ Y (1 + z/d) dz of the middle section, over B/2 d
    m0, m1 = 1 - CORNER * wide * high, 0.5 - (5 / 6 - math.pi / 4) * wide * high**2
    allowed = []
    for along in (LONG, LONGEST):
        share = (block - m0 * (1 - 2 * along)) / (2 * along)  # φ_keel (m0 − m1) + φ_top m1
        top = 1 - (1 - waterplane) / (2 * along)
        keel = (share - top * m1) / (m0 - m1)
        if all(FULLNESS[0] <= value <= FULLNESS[1] for value in (top, keel)):
            return along, (keel, top)
        ends = np.clip([(share - end * (m0 - m1)) / m1 for end in FULLNESS], *FULLNESS)
        allowed += [1 - 2 * along * (1 - end) for end in ends]
    raise ValueError(
        f"waterplane coefficient is {waterplane:g}; allowed with block coefficient {block:g}: "
        f"{math.ceil(1e3 * min(allowed)) / 1e3:g} to {math.floor(1e3 * max(allowed)) / 1e3:g}"
    )


def ship_counts(length, beam, draft, panels=500, longest=math.inf):
    """Return (n_length, n_bottom, n_side) for at most `panels` on the whole hull, by the rule of `shapes.box_counts`"""
    from .shapes import fitted_counts

    most = [1 if math.isinf(longest) else math.ceil(math.pi / 2 * edge / longest) for edge in (length, beam / 2, draft)]
    needed = tuple(max(pair) for pair in zip(FEWEST, most, strict=True))
    edges = np.multiply(SHARES, (length, beam / 2, draft))
    return fitted_counts(edges, lambda n: 2 * n[0] * (n[1] + n[2]), panels, needed)


def counts_of_ship(mesh):
    """The counts used by `ship` for a mesh"""
    x, _, z = mesh.points.T
    stations = np.unique(np.round(x / np.ptp(x), 7))
    middle = np.abs(x / np.ptp(x) - stations[len(stations) // 2]) < 1e-6
    bottom = int(np.sum(middle & (z < -(1 - 1e-6) * mesh.draft))) - 1
    n = len(stations) - 1
    return n, bottom, len(mesh) // n - bottom


def _girth(n_bottom, n_side, half, draft, radius):
    """Points (y, z) from the keel to the waterline along bottom, bilge and side; shape (n_bottom + n_side + 1, 2)"""
    flat = (half - radius) * np.sin(0.5 * np.pi * np.arange(n_bottom + 1) / n_bottom)
    n_bilge = (n_side + 1) // 2
    turn = 0.5 * np.pi * np.arange(1, n_bilge + 1) / n_bilge
    bilge = np.column_stack([half - radius + radius * np.sin(turn), -draft + radius * (1 - np.cos(turn))])
    n_wall = n_side - n_bilge
    z = (radius - draft) * np.cos(0.5 * np.pi * np.arange(1, n_wall + 1) / n_wall)
    z[-1] = 0.0
    return np.concatenate([np.column_stack([flat, np.full_like(flat, -draft)]), bilge,
                           np.column_stack([np.full(n_wall, half), z])])  # fmt: skip
