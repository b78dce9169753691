"""MoorDyn files without lines: where each rod and body comes to rest by itself, in still water.

A rod of length L and diameter d weighs s times the water it displaces.  Free it sinks for s > 1; else it floats, lying
where that is stable, immersed to the angle θ on each side of its lowest line with θ − sin θ cos θ = π s,

    b L²/12S − (2/3) r³ sin³ θ / S > 0,    S = π r² s,    b = 2 r sin θ,

else upright where r²/4sL > L (1 − s)/2.  A rod pinned at its end A hangs or stands on it; thin, d ≪ L, it leans in the
surface with √s L of it under water from the pin on, where the pin is less than that below, or with √(1 − s) L dry,
where it is less than that above.  Of bodies the shape is not known: only whether they sink or float.
Archimedes, On floating bodies; moments of weight and buoyancy about the pin.
"""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np

from .fault import FormatError
from .moordyn_left_out import left_out
from .moordyn_rows import COUPLED, FIXED, FREE

SLENDER = 5.0  # L/d from which a rod that leans in the surface counts as thin
PINNED = ("pinned", "coupledpinned")


class Loose(NamedTuple):
    """name : of the rod or body; state : in words; ends : (2, 3) m of a rod, (1, 3) m of a body, None: not known"""

    name: str
    state: str
    ends: np.ndarray | None


class Still(NamedTuple):
    """density : kg/m³; gravity : m/s²; depth : m"""

    density: float
    gravity: float
    depth: float


def rests_of_moordyn(file, water: Still, path="MoorDyn file"):
    """[Loose] of all rods and bodies of a file without lines.

    A rod without length or on a body is part of that body
    warns : of each kind of thing left out; raises : FormatError for a rod whose rest is not known
    """
    for text in left_out(file):
        warnings.warn(f"{path}: {text}", stacklevel=2)
    idle = [row.id for row in file.points if row.attachment.lower() in FREE]
    if idle:
        warnings.warn(f"{path}: point {', '.join(idle)} is free and no line holds it: left out", stacklevel=2)
    bodies = {row.id: row for row in file.bodies}
    alone = [row for row in file.rods if _body_of(row, bodies) is None]
    return [_rod(row, file, water, path) for row in alone] + [_body(row, file, water, path) for row in file.bodies]


def _body_of(row, bodies):
    kind = row.attachment.lower()
    return bodies.get(kind.removeprefix("body").removeprefix("b")) if kind[0] == "b" else None


def _kind(row, file, path):
    kind = next((kind for kind in file.rod_types if kind.name == row.type), None)
    if kind is None:
        raise FormatError(
            f"{path}, section RODS: rod {row.id}: type {row.type!r} is unknown; allowed: one of ROD TYPES"
        )
    return kind


def _rod(row, file, water, path):
    name, kind = f"rod {row.id}", _kind(row, file, path)
    ends = np.array([[row.xa, row.ya, row.za], [row.xb, row.yb, row.zb]])
    L, d, attached = float(np.linalg.norm(ends[1] - ends[0])), kind.diameter, row.attachment.lower()
    if attached in (*FIXED, *COUPLED):
        return Loose(name, "held", ends)
    if attached not in (*FREE, *PINNED):
        raise FormatError(
            f"{path}, section RODS: attachment of rod {row.id} is {row.attachment!r}; allowed without lines: Fixed, "
            "Coupled, Free, Pinned, CoupledPinned, or Body and the id of one of BODIES"
        )
    displaced = water.density * np.pi / 4 * d**2
    if L == 0 or water.gravity == 0 or kind.mass == displaced:
        return Loose(name, "stays, nothing moves it", ends)
    s = kind.mass / displaced if displaced > 0 else math.inf
    try:
        if attached in FREE:
            return Loose(name, *_free(ends, L, 0.5 * d, s, water.depth))
        return Loose(name, *_pinned(ends, L, d, s, water.depth))
    except ValueError as error:
        raise FormatError(f"{path}, section RODS: rod {row.id} {error}") from None


def _free(ends, L, r, s, depth):
    """State and ends of a free rod"""
    middle, along = ends.mean(axis=0), _level(ends)
    if s > 1:
        return "lies on the bed", _lying(middle, along, L, r - depth)
    theta = immersed_angle(s)
    if 2 * r * math.sin(theta) * L**2 / 12 > 2 / 3 * (r * math.sin(theta)) ** 3:
        state, made = "floats, lying", _lying(middle, along, L, r * math.cos(theta))
        lowest = r * math.cos(theta) - r
    elif r**2 / (4 * s * L) > 0.5 * L * (1 - s):
        up = 1.0 if ends[1, 2] >= ends[0, 2] else -1.0
        made = np.array([[*middle[:2], z] for z in (-s * L, (1 - s) * L)[:: int(up)]])
        state, lowest = "floats upright", -s * L
    else:
        raise ValueError("floats neither lying nor upright; allowed: one that lies or stands")
    if lowest < -depth:
        raise ValueError(f"floats {-lowest:.4g} m deep, in {depth:.4g} m of water; allowed: clear of the bed")
    return state, made


def immersed_angle(s):
    """θ, rad, of a lying cylinder of s times the density of water, 0 < s < 1"""
    from scipy.optimize import brentq

    return float(brentq(lambda a: a - math.sin(a) * math.cos(a) - math.pi * s, 0.0, math.pi, xtol=1e-14))


def _pinned(ends, L, d, s, depth):
    """State and ends of a rod that turns about its end A"""
    pin, h = ends[0], -ends[0, 2]  # h m of water above the pin
    wet, dry = math.sqrt(min(s, 1.0)) * L, math.sqrt(max(1 - s, 0.0)) * L
    if s > 1 or -h >= dry:
        state, up = "hangs from its pin", -1.0
    elif h >= wet:
        state, up = "stands on its pin", 1.0
    else:
        if SLENDER * d > L:
            raise ValueError(f"leans in the surface, L/d {L / d:.3g}; allowed there: {SLENDER:g} or more")
        state, up = "leans in the surface", h / wet if h >= 0 else h / dry
    if pin[2] + up * L < -depth:
        state, up = "leans on the bed", max((-depth - pin[2]) / L, -1.0)
    away = math.sqrt(max(1 - up * up, 0.0)) * _level(ends)
    return state, np.array([pin, pin + L * np.array([*away, up])])


def _level(ends):
    """(2,) unit vector from end A to B in the plan, x where there is none"""
    away = (ends[1] - ends[0])[:2]
    size = np.hypot(*away)
    return away / size if size > 0 else np.array([1.0, 0.0])


def _lying(middle, along, L, z):
    return np.array([[*(middle[:2] + side * 0.5 * L * along), z] for side in (-1, 1)])


def _body(row, file, water, path):
    name, place = f"body {row.id}", np.array([[row.x0, row.y0, row.z0]])
    if row.attachment.lower() in (*FIXED, *COUPLED):
        return Loose(name, "held", place)
    if water.gravity == 0:
        return Loose(name, "stays, nothing moves it", place)
    bodies, mass, volume = {row.id: row}, row.mass, row.volume
    for rod in file.rods:
        if _body_of(rod, bodies):
            kind = _kind(rod, file, path)
            L = float(np.linalg.norm([rod.xb - rod.xa, rod.yb - rod.ya, rod.zb - rod.za]))
            mass, volume = mass + kind.mass * L, volume + np.pi / 4 * kind.diameter**2 * L
    for point in file.points:
        if _body_of(point, bodies):
            mass, volume = mass + point.mass, volume + point.volume
    if mass == water.density * volume:
        return Loose(name, "stays, nothing moves it", place)
    return Loose(name, "sinks" if mass > water.density * volume else "floats, its shape is not known", None)
