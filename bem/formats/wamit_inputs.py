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
from pathlib import Path
from typing import NamedTuple

from hakobune.meshing.text_files import numbers_of
from hakobune.meshing.text_formats import length_unit

from .values import FormatError, lines_of

PERIOD_KINDS = {1: "period", 2: "frequency", 3: "deep wavenumber", 4: "wavenumber"}  # IPEROUT


class Inputs(NamedTuple):
    """length : m, ULEN; about : (3,) m, XBODY; period_kind : of the first column of results, as in `omega_of`

    wave_length : m that wavenumbers of that column are multiplied by; said : what of these a file says, in words
    """

    length: float = 1.0
    about: tuple = (0.0, 0.0, 0.0)
    period_kind: str = "period"
    wave_length: float = 1.0
    said: tuple = ()


def inputs_of(place, known):
    """`Inputs` of NAME.gdf, NAME.pot and NAME.cfg as far as they are there, each read for what is not given.

    known : {"length_unit": m, "rotation_center": (3,) m, "period_kind"}, each None or not there where it is not given
    Raises FormatError.
    """
    place, said = Path(place), []
    length, about, kind = (known.get(name) for name in ("length_unit", "rotation_center", "period_kind"))
    gdf, pot, cfg = (beside(place, suffix) for suffix in (".gdf", ".pot", ".cfg"))
    if length is None and gdf:
        length = _ulen(gdf)
        said.append(f"ULEN {length:g} m of {gdf.name}")
    if about is None and pot:
        about = tuple(x * (_unit(gdf) if gdf else 1.0) for x in _xbody(pot))
        if any(about):
            said.append(f"XBODY {', '.join(f'{x:g}' for x in about)} m of {pot.name}")
    length, about = 1.0 if length is None else length, (0.0, 0.0, 0.0) if about is None else tuple(about)
    if kind is None:
        return Inputs(length, about, _period_kind(cfg) if cfg else "period", length, tuple(said))
    return Inputs(length, about, kind, said=tuple(said))


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


def _xbody(path):
    """(x, y, z) in the unit of the .gdf.  Raises FormatError for several bodies, or axes that are turned."""
    lines = iter(lines_of(path)[1:])

    def read(count):
        got = []
        for line in lines:
            got += numbers_of(line)[: count - len(got)]
            if len(got) == count:
                return got
        raise FormatError(f"{path} ends before XBODY; give --about x,y,z and leave the file out, or mend it")

    read(1)  # HBOT
    read(2)  # IRAD IDIFF
    for _ in range(2):  # periods and headings: a count below 0 means first and step
        (count,) = read(1)
        if count:
            read(int(count) if count > 0 else 2)
    (bodies,) = read(1)
    if bodies != 1:
        raise FormatError(f"{path} has {bodies:g} bodies; allowed: one")
    next(lines, None)  # the name of the .gdf
    *about, turned = read(4)
    if turned:
        raise FormatError(f"{path}: XBODY(4) turns the body by {turned:g}°; allowed: 0")
    return tuple(about)


def _configured(path, key):
    for line in lines_of(path):
        found = re.match(rf"\s*{key}(?:\(\d+\))?\s*=\s*([-+\d.]+)", line, re.I)
        if found:
            return float(found[1])
    return None
