"""What the input files beside WAMIT's results say of them (user manual, version 7.4, chapters 3 and 4).

    NAME.gdf   header / ULEN GRAV / …                          the length that results are made dimensionless by
    NAME.pot   header / HBOT / IRAD IDIFF / NPER / PER … / NBETA / BETA … / NBODY / gdf / XBODY(1-4) / IMODE
    NAME.cfg   KEY = value, in any order                       IPEROUT: what the first column of results is

Results are about the body's own axes, whose origin is XBODY(1-3) in those of the water; the .gdf is in the body's
axes too.  Lengths are in feet where GRAV is; wavenumbers in the first column are times ULEN (chapter 4).  Lists are
read as Fortran reads them: what follows the numbers wanted on a line is a remark.
"""

from __future__ import annotations

import re
from math import inf
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import numbers_of
from hakobune.meshing.text_formats import length_unit

from .values import FormatError, lines_of

PERIOD_KINDS = {1: "period", 2: "frequency", 3: "deep wavenumber", 4: "wavenumber"}  # IPEROUT


class Table(NamedTuple):
    """path : of a file, for messages; rows : (k, columns) of its numbers"""

    path: Path
    rows: np.ndarray

    def __getitem__(self, column):
        return self.rows[:, column]

    def __len__(self):
        return len(self.rows)


class Inputs(NamedTuple):
    """length : m, ULEN; about : (3,) m, XBODY; period_kind : of the first column of results, as in `omega_of`

    wave_length : m that wavenumbers of that column are multiplied by; said : what of these a file says, in words
    depth : m, may be inf, None where it is not said; gravity : m/s²; bodies : how many; hull : name of the .gdf
    told : whether a file says how many bodies there are
    """

    length: float = 1.0
    about: tuple = (0.0, 0.0, 0.0)
    period_kind: str = "period"
    wave_length: float = 1.0
    said: tuple = ()
    depth: float | None = None
    gravity: float = 9.80665
    bodies: int = 1
    hull: str = ""
    told: bool = False


def inputs_of(place, known):
    """`Inputs` of NAME.gdf, NAME.pot and NAME.cfg as far as they are there, each read for what is not given.

    known : {"length_unit": m, "rotation_center": (3,) m, "period_kind", "water_depth": m, "gravity": m/s², "body"},
        each None or not there where it is not given
    Raises FormatError.
    """
    place, said = Path(place), []
    length, about, kind, depth = (
        known.get(name) for name in ("length_unit", "rotation_center", "period_kind", "water_depth")
    )
    pot, cfg = (beside(place, suffix) for suffix in (".pot", ".cfg"))
    potential = _potential(pot, about is not None) if pot else None
    body = None
    if potential and potential.bodies:
        body = potential.bodies[min(known.get("body") or 1, len(potential.bodies)) - 1]
    gdf = beside(place, ".gdf")
    if gdf is None and body and place.with_name(body[0]).is_file():
        gdf = place.with_name(body[0])
    unit = _unit(gdf) if gdf else 1.0
    if length is None and gdf:
        length = _ulen(gdf)
        said.append(f"ULEN {length:g} m of {gdf.name}")
    if about is None and body:
        about = tuple(x * unit for x in body[1])
        if any(about):
            said.append(f"XBODY {', '.join(f'{x:g}' for x in about)} m of {pot.name}")
    if depth is None and potential:
        depth = potential.depth * unit if potential.depth > 0 else inf
        said.append(f"water depth {depth:g} m of {pot.name}")
    length, about = 1.0 if length is None else length, (0.0, 0.0, 0.0) if about is None else tuple(about)
    bodies = len(potential.bodies) if potential else 1
    rest = {"said": tuple(said), "depth": depth, "gravity": known.get("gravity") or 9.80665,
            "bodies": bodies, "hull": gdf.name if gdf else "", "told": bool(potential)}  # fmt: skip
    if kind is None:
        return Inputs(length, about, _period_kind(cfg) if cfg else "period", length, **rest)
    return Inputs(length, about, kind, **rest)


def beside(place, suffix):
    """The file of the name of `place` with another suffix, in whichever case it is written; None without one"""
    found = (place.with_suffix(one) for one in (suffix, suffix.upper()))
    return next((path for path in found if path.is_file()), None)


def _head(path):
    """ULEN and GRAV of a .gdf, those of them that are there"""
    lines = lines_of(path)
    return numbers_of(lines[1])[:2] if len(lines) > 1 else []


def _unit(path):
    """m per unit of length of a .gdf"""
    head = _head(path)
    return length_unit(path, head[1]) if len(head) > 1 else 1.0


def _ulen(path):
    head = _head(path)
    if not head or not head[0] > 0:
        raise FormatError(f"{path}, line 2: ULEN is missing; allowed: a length above 0, or give --length-unit")
    return head[0] * _unit(path)


def _period_kind(path):
    """The kind that IPEROUT of a .cfg names"""
    kind = _configured(path, "IPEROUT")
    if kind is not None and kind not in PERIOD_KINDS:
        raise FormatError(f"{path}: IPEROUT is {kind:g}; allowed: {', '.join(map(str, PERIOD_KINDS))}")
    return PERIOD_KINDS[int(kind or 1)]


class Potential(NamedTuple):
    """Of a .pot: depth in its unit, ≤ 0 for deep water; bodies : [(name of the .gdf, (x, y, z) of XBODY)]"""

    depth: float
    bodies: list


def _potential(path, without=False):
    """`Potential` of a file.  Raises FormatError for axes that are turned, or a file that ends too soon.

    without : whether points of moments are given elsewhere, so that a file that is not understood does not matter
    """
    lines = iter(lines_of(path)[1:])

    def read(count):
        got = []
        for line in lines:
            got += numbers_of(line)[: count - len(got)]
            if len(got) == count:
                return got
        raise FormatError(f"{path} ends before XBODY; give --about x,y,z and leave the file out, or mend it")

    try:
        (depth,) = read(1)
        if any(number not in (-1, 0, 1) for number in _same_line(lines)):
            return None  # of the older form, IALTPOT = 1
        for _ in range(2):  # periods and headings: a count below 0 means first and step
            (count,) = read(1)
            if count:
                read(int(count) if count > 0 else 2)
        (count,) = read(1)
        bodies = []
        for number in range(int(count)):
            name = next(lines, "").strip().split()
            *about, turned = read(4)
            if turned:
                raise FormatError(f"{path}: XBODY(4) turns the body by {turned:g}°; allowed: 0")
            bodies.append((name[0] if name else "", tuple(about)))
            if number + 1 < count:
                read(6)  # IMODE
    except FormatError:
        if without:
            return None
        raise
    return Potential(depth, bodies)


def _same_line(lines):
    """IRAD and IDIFF, which stand on a line; what is neither where there are not two"""
    found = numbers_of(next(lines, ""))[:2]
    return found if len(found) == 2 else (9,)


def _configured(path, key):
    for line in lines_of(path):
        found = re.match(rf"\s*{key}(?:\(\d+\))?\s*=\s*([-+\d.]+)", line, re.I)
        if found:
            return float(found[1])
    return None
