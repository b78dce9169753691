"""What the input files beside WAMIT's results say of them (user manual, version 7.4, chapters 3 and 4).

    NAME.gdf   header / ULEN GRAV / …                          the length that results are made dimensionless by
    NAME.pot   header / HBOT / IRAD IDIFF / NPER / PER … / NBETA / BETA … / NBODY / gdf / XBODY(1-4) / IMODE
    NAME.cfg   KEY = value, in any order                       IPEROUT: what the first column of results is

Results are about the body's own axes, whose origin is XBODY(1-3), m, in those of the water; the .gdf is in the body's
axes too.  Lists are read as Fortran reads them: what follows the numbers wanted on a line is a remark.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from .values import FormatError, numbers_of

PERIOD_KINDS = {1: "period", 2: "frequency", 3: "deep wavenumber", 4: "wavenumber"}  # IPEROUT


class Inputs(NamedTuple):
    """length : m, ULEN; about : (3,) m, XBODY; period_kind : of the first column of results

    said : what of these a file says, in words
    """

    length: float = 1.0
    about: tuple = (0.0, 0.0, 0.0)
    period_kind: str = "period"
    said: tuple = ()


def inputs_beside(place):
    """Inputs of NAME.gdf, NAME.pot and NAME.cfg as far as they are there.  Raises FormatError."""
    place, found, said = Path(place), {}, []
    if gdf := beside(place, ".gdf"):
        found["length"] = _ulen(gdf)
        said.append(f"ULEN {found['length']:g} m of {gdf.name}")
    if pot := beside(place, ".pot"):
        found["about"] = _xbody(pot)
        if any(found["about"]):
            said.append(f"XBODY {', '.join(f'{x:g}' for x in found['about'])} m of {pot.name}")
    if cfg := beside(place, ".cfg"):
        kind = _configured(cfg, "IPEROUT")
        if kind is not None and kind not in PERIOD_KINDS:
            raise FormatError(f"{cfg}: IPEROUT is {kind:g}; allowed: {', '.join(map(str, PERIOD_KINDS))}")
        found["period_kind"] = PERIOD_KINDS[int(kind or 1)]
    return Inputs(**found, said=tuple(said))


def beside(place, suffix):
    """The file of the name of `place` with another suffix, in whichever case it is written; None without one"""
    found = (place.with_suffix(one) for one in (suffix, suffix.upper()))
    return next((path for path in found if path.is_file()), None)


def _lines(path):
    try:
        return path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise FormatError(f"{path}: {error.strerror}") from None


def _ulen(path):
    lines = _lines(path)
    numbers = numbers_of(lines[1]) if len(lines) > 1 else []
    if not numbers or not numbers[0] > 0:
        raise FormatError(f"{path}, line 2: ULEN is missing; allowed: a length above 0, or give --length-unit")
    return numbers[0]


def _xbody(path):
    """(x, y, z) m.  Raises FormatError for several bodies, or axes that are turned."""
    lines = iter(_lines(path)[1:])

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
    for line in _lines(path):
        found = re.match(rf"\s*{key}(?:\(\d+\))?\s*=\s*([-+\d.]+)", line, re.I)
        if found:
            return float(found[1])
    return None
