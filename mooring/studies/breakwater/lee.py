"""Waves around breakwaters of finite length, from a database of one unit: their height over the incident height.

    K(x, y)² = Σ_ω,β |η(x, y; ω, β)|² S_i Δω Δβ / Σ S_i Δω Δβ, η including the waves that every unit scatters and
    radiates

x is along the row of units, y to leeward. A unit is the study's section over the database's length, moored as in the
study (`mooring.breakwater.unit`); a gap separates it from its neighbours (`bem.wave_field.units`).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import KOCHIN
from hakobune.bem.kochin import angles
from hakobune.bem.wave_field.around import far_field
from hakobune.bem.wave_field.sources import rectangle
from hakobune.bem.wave_field.units import field, row
from hakobune.bem.waves import wavenumber

from ...breakwater import unit
from ...breakwater.transmission import equal_cells
from .breakwater import BreakwaterError
from .in_sea import ways_of

MOVING = ("added_mass", "radiation_damping", "excitation_force")
SAME = 0.02  # largest relative difference of the database's hull and the study's section
CELLS, WAYS = 16, 10  # frequency cells and directions of a sea
LEAST = 0.9  # smallest fraction of the sea's energy within the database
MISSED = 0.02  # share of a far field that its sources may miss without a message
BEHIND = (0.25, 0.5, 1.0, 2.0)  # distances behind the row, over its length, at which the height is reported


class Row(NamedTuple):
    """Units in a row, `gap` m between them, in regular waves of `period`, s, or in the sea

    x, y : (from, to) m, extent of a map along the row and to leeward; points : points of the map in x and in y
    """

    period: float | None = None
    units: int = 1
    gap: float = 0.0
    x: tuple | None = None
    y: tuple | None = None
    points: int = 61


class Lee(NamedTuple):
    """x (a,), y (b,) m; ratio : K, (b, a), nan in the bodies; units : middles of the units, (u, 2) m; half : half
    dimensions of a unit, (2,) m
    behind : [(y m, mean K over the breadth of the row)]; waves : in words; warned : one line each
    lines : x of the pairs of lines of a unit, (p,) m
    tension : δP of the front and back lines of a single unit over the amplitude of the incident waves, (2, p) N/m²;
        in a sea root mean squares; None without lines
    """

    x: np.ndarray
    y: np.ndarray
    ratio: np.ndarray
    units: np.ndarray
    half: np.ndarray
    behind: list
    waves: str
    warned: list
    lines: np.ndarray | None = None
    tension: np.ndarray | None = None


def lee(breakwater, asked, db):
    """`Lee` of a `Breakwater` as a `Row` of units of a database.  Raises ValueError for a database of another body."""
    reader = db.reader
    length = _check_same(breakwater, db)
    fixed = breakwater.design[0] == "fixed"
    db.require(*KOCHIN, *(() if fixed else MOVING))
    moved = None if fixed else held(breakwater, reader, length)
    middles = row(asked.units, length + asked.gap)
    half = np.array([length, breakwater.wetted(0.0).waterline]) / 2
    omega, ways, share, words = waves_of(breakwater, asked, reader)
    x, y = _grid(asked, 2 * (middles[-1, 0] + length / 2), half[1])
    total = middles[-1, 0] + length / 2
    told = [half[1] + part * 2 * total for part in BEHIND]
    across = np.linspace(-total, total, 41)
    places = [np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)]
    places += [np.stack([across, np.full(41, one)], axis=1) for one in told]
    power, missed = np.zeros(sum(map(len, places))), 0.0
    lines, pulled = _pulls(breakwater, length, float(reader.rotation_center[2]))
    tension = 0.0
    for w, betas, part in zip(omega, ways, share, strict=True):
        found = _field(reader, moved, w, betas, half, middles)
        power += part * np.mean(np.abs(found.elevation(np.concatenate(places))) ** 2, axis=0)
        missed = max(missed, found.missed)
        if lines is not None:
            tension = tension + part * np.mean(np.abs(pulled(moved.motions([w], betas)[0])) ** 2, axis=0)
    ratio, rest = np.sqrt(power[: len(places[0])]), np.sqrt(power[len(places[0]) :]).reshape(-1, 41)
    behind = list(zip(told, np.sqrt(np.mean(rest**2, axis=1)), strict=True))
    warned = list(_remarks(breakwater, asked, missed))
    if moved is not None and reader.viscous is not None:
        warned.append("the waves behind the units do not include the viscous damping of the database's scene")
    tension = None if lines is None else np.sqrt(tension)
    return Lee(x, y, ratio.reshape(len(y), len(x)), middles, half, behind, words, warned, lines, tension)


def held(breakwater, reader, length):
    """The `Reader` of a unit with the study's weight and holding"""
    lines, center = breakwater.lines, float(reader.rotation_center[2])
    if np.any(np.abs(reader.rotation_center[:2]) > 0):
        raise BreakwaterError(
            "the rotation_center of the database is not at x = y = 0, the middle of the hull; solve the body again "
            "with rotation_center there"
        )
    holding = breakwater.design[0]
    body = breakwater.afloat(0.0)[0] if holding == "free" else breakwater.taut(0.0)
    stiffness = unit.buoyancy(body, length, center)
    if holding != "free":
        stiffness = stiffness + unit.line_matrix(body, length, center, lines.spacing, _axial_stiffness(breakwater))
    inertia = unit.inertia(body, length, center)
    return replace(reader, inertia=inertia, stiffness=stiffness, damping=np.zeros((6, 6)), own=False, viscous=None)


def _pulls(breakwater, length, center):
    """x (p,) m of a unit's pairs of lines, and δP (b, 2, p) N/m per metre of its motions (b, 6); None without lines"""
    lines = breakwater.lines
    if breakwater.design[0] in ("fixed", "free"):
        return None, None
    body, EA = breakwater.taut(0.0), _axial_stiffness(breakwater)
    where, _ = unit.pairs(length, lines.spacing)
    return where, lambda motion: unit.tensions(body, length, center, lines.spacing, EA, motion)


def _axial_stiffness(breakwater):
    """EA, N per metre of body; None for inextensible lines"""
    return breakwater.lines.stretch if breakwater.design[0] == "elastic" else None


def waves_of(breakwater, asked, reader):
    """Waves of a study: ω (n,) rad/s, directions of travel (n, d) rad, share of the energy (n,), and a text on them

    A wave that travels towards 90° goes straight to leeward.  Raises BreakwaterError for waves outside the database.
    """
    low, high = reader.between.span
    if asked.period is not None:
        omega = np.array([2 * np.pi / asked.period])
        if not low <= omega[0] <= high:
            raise BreakwaterError(
                f"map.period is {asked.period:g} s; the database covers {2 * np.pi / high:.4g} to {2 * np.pi / low:.4g}"
            )
        at = f"regular waves of {asked.period:g} s at {_degrees(breakwater.waves.obliquity)} to the normal"
        return omega, np.array([[np.pi / 2 - breakwater.waves.obliquity]]), np.ones(1), at
    sea = equal_cells(breakwater.sea.spectrum, CELLS)
    inside = (sea.omega >= low) & (sea.omega <= high)
    part = sea.energy[inside].sum() / sea.energy.sum()
    if part < LEAST:
        raise BreakwaterError(
            f"the database covers {2 * np.pi / high:.4g} to {2 * np.pi / low:.4g} s, which is {part:.0%} of the sea's "
            f"energy; allowed: {LEAST:.0%} or more; solve more frequencies"
        )
    omega = sea.omega[inside]
    angle = ways_of(breakwater, omega, WAYS, any_section=True).T
    spread = "long crests" if breakwater.sea.spreading is None else str(breakwater.sea.spreading)
    words = f"the sea, {spread}, at {_degrees(breakwater.sea.direction)} to the normal"
    words += "" if part == 1 else f", of which the database covers {part:.0%}"
    share = sea.energy[inside] / sea.energy[inside].sum()
    return omega, np.pi / 2 - angle, share, words


def _degrees(angle):
    return f"{np.degrees(angle):.6g}°"


def _field(reader, moved, omega, betas, half, middles):
    """`Field` of all units at one frequency"""
    k, theta = float(wavenumber(omega, reader.depth, reader.gravity)), reader.between.theta
    own = _far_field(reader, moved, omega, betas)
    ring = angles(k, float(np.hypot(*half))) if len(middles) > 1 else np.zeros(0)
    return field(rectangle(half), k, theta, own, ring, _far_field(reader, moved, omega, ring), betas, middles)


def _far_field(reader, moved, omega, betas):
    """Kochin functions H of one unit, its motions included; shape (b, t)"""
    if not len(betas):
        return np.zeros((0, len(reader.between.theta)))
    return far_field(reader, None if moved is None else moved.motions([omega], betas)[0], omega, betas)


def _grid(asked, whole, half_width):
    """x, y m of the map; by default 1.5 breadths of the row, as far behind it, half a breadth before it"""
    x = asked.x or (-0.75 * whole, 0.75 * whole)
    y = asked.y or (-0.5 * whole, 1.5 * whole)
    return (np.linspace(*ends, asked.points) for ends in (x, y))


def _check_same(breakwater, db):
    """Length of the unit, m.  Raises BreakwaterError for a database of another body or other water."""
    wet, points = breakwater.wetted(0.0), db.mesh.whole().points
    if db.water_depth is None or np.isinf(db.water_depth):
        raise BreakwaterError("the database is for deep water; allowed: a database for the study's depth")
    length, beam = np.ptp(points[:, 0]), np.ptp(points[:, 1])
    pairs = {
        "depth": (db.water_depth, breakwater.depth(0.0)),
        "density": (db.density, breakwater.water.density),
        "gravity": (db.gravity, breakwater.water.gravity),
        "draft": (-points[:, 2].min(), wet.draft),
        "displaced volume": (float(db.displaced_volume), wet.area * length),
        "breadth": (beam, max(abs(edge.at(u).real) for edge in wet.edges for u in (0.0, 0.5, 1.0)) * 2),
    }
    for name, (there, here) in pairs.items():
        if abs(there / here - 1) > SAME:
            raise BreakwaterError(
                f"{name} is {there:.5g} in the database and {here:.5g} in the study; solve the study's section, with "
                "its length along x, at the study's depth"
            )
    return float(length)


def _remarks(breakwater, asked, missed):
    depth = breakwater.depth(0.0)
    if asked.units > 1 and asked.gap < depth:
        left = np.exp(-np.pi * asked.gap / depth)
        yield (
            f"map.gap is {asked.gap:g} m, less than the depth of {depth:g} m: local waves are not included, and "
            f"{left:.0%} of them reach the next unit"
        )
    if missed > MISSED:
        yield f"the fit of the waves close to the body misses {missed:.1%} of the far field; allowed: {MISSED:.0%}"
