"""Content of the input files beside WAMIT's results (user manual, version 7.4, chapters 3 and 4).

    NAME.gdf   header / ULEN GRAV / …                          the length for dimensionless results
    NAME.pot   header / HBOT / IRAD IDIFF / NPER / PER … / NBETA / BETA … / NBODY / gdf / XBODY(1-4) / IMODE
    NAME.cfg   KEY = value, in any order                       IPEROUT: kind of the first column of results
    NAME.out   a listing of these inputs; its periods show the kind of the first column of NAME.1

Results are along the axes of the body, whose origin in the axes of the water is XBODY(1-3). The hull in the .gdf is in
the axes of the body too.  If GRAV is in feet, lengths are in feet; wavenumbers in the first column are multiplied by
ULEN (chapter 4).  Lists are read as in Fortran: text after the wanted numbers of a line is a remark.
"""

import re
from math import inf, isclose
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import numbers_of
from hakobune.meshing.text_formats import length_unit

from .values import FormatError, body_of, lines_of, omega_of

PERIOD = re.compile(r"Wave period(?: \(sec\))?\s*=\s*(\S+)")
NUMBER = r"[-+]?\d*\.?\d+(?:[EeDd][-+]?\d+)?"
SAME_PERIOD = 2e-3  # relative difference within which periods of a listing and of a file are equal
SAME_DEPTH = 1e-3  # the same of depths
PERIOD_KINDS = {1: "period", 2: "frequency", 3: "deep wavenumber", 4: "wavenumber"}  # IPEROUT


def pot_of(values, hulls):
    """Text of NAME.pot of several bodies. Each body has axes parallel to those of the scene, through its reference
    point

    values : `values.Values` with bodies; hulls : names of the bodies' .gdf files, in these axes
    """
    depth = values.water_depth if np.isfinite(values.water_depth) else 0.0  # 0 for deep water
    periods, degrees = 2 * np.pi / values.omega, np.degrees(values.wave_direction)
    lines = [
        "several bodies, from hakobune",
        f"{depth:.9g}  HBOT",
        "1  1  IRAD IDIFF",
        f"{len(periods)}  NPER",
        *(f"{period:.9g}" for period in periods),
        f"{len(degrees)}  NBETA",
        *(f"{angle:.9g}" for angle in degrees),
        f"{len(hulls)}  NBODY",
    ]
    for body, hull in zip(values.bodies, hulls, strict=True):
        point = "  ".join(f"{x:.9g}" for x in body.rotation_center)
        lines += [hull, f"{point}  0.  XBODY", "  ".join("0" if body.fixed else "1" for _ in range(6)) + "  IMODE"]
    return "\n".join(lines) + "\n"


class Table(NamedTuple):
    """path : path of a file, for messages; rows : (k, columns) of its numbers"""

    path: Path
    rows: np.ndarray

    def __getitem__(self, column):
        return self.rows[:, column]

    def __len__(self):
        return len(self.rows)


class Inputs(NamedTuple):
    """length : ULEN, m; about : XBODY, m, (3,); period_kind : kind of the first column of results, as in `omega_of`
    wave_length : length by which wavenumbers in the first column are multiplied, m
    said : description of the values that a file gives
    depth : m, may be inf, None if not given; gravity : m/s²; hull : name of the .gdf
    bodies : number of bodies; told : whether a file gives this number
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
    """`Inputs` from `known`; values not given are read from NAME.gdf, NAME.pot and NAME.cfg if these files exist.

    known : {"length_unit": m, "rotation_center": (3,) m, "period_kind", "water_depth": m, "gravity": m/s², "body"},
        with None or no entry for values not given
    Raises FormatError.
    """
    place, known = Path(place), {name: value for name, value in known.items() if value is not None}
    pot, cfg = (beside(place, suffix) for suffix in (".pot", ".cfg"))
    potential = _potential(pot, "rotation_center" in known) if pot else None
    hull, point = potential.of_body(known.get("body") or 1) if potential else ("", None)
    gdf = beside(place, ".gdf") or (place.with_name(hull) if hull and place.with_name(hull).is_file() else None)
    unit = _unit(gdf) if gdf else 1.0
    found = {"length_unit": (1.0, ""), "rotation_center": ((0.0, 0.0, 0.0), ""), "water_depth": (None, "")}
    of_hull = _of_hull(gdf) if gdf and "length_unit" not in known else {}
    listed = _listed(place, known)
    if listed:
        found |= _of_listing(place, listed)
    if potential:
        found |= _of_potential(pot, potential.depth, point, unit)
    found |= of_hull
    length, about, depth = (known.get(name, value) for name, (value, _) in found.items())
    given = Inputs(
        length,
        tuple(about),
        wave_length=length,
        said=(
            *(words for name, (_, words) in found.items() if words and name not in known),
            *_other_depth(known, *found["water_depth"]),
        ),
        depth=depth,
        gravity=known.get("gravity") or 9.80665,
        bodies=len(potential.bodies) if potential else listed.bodies if listed else 1,
        hull=gdf.name if gdf else "",
        told=bool(potential or listed),
    )
    if "period_kind" in known:
        return given._replace(period_kind=known["period_kind"], wave_length=1.0)
    if cfg:
        return given._replace(period_kind=_period_kind(cfg))
    return given._replace(period_kind=_kind_listed(place, given)) if listed else given


def _other_depth(known, written, words):
    """Words on a given depth that is not the one of the files, `written` m or None"""
    depth = known.get("water_depth")
    if depth is not None and written is not None and not isclose(depth, written, rel_tol=SAME_DEPTH):
        yield f"--depth {depth:g} m, and not the {words},"


def _of_listing(place, listed):
    """{input: (value, words, "" to say nothing)} of NAME.out"""
    depth = listed.depth, f"water depth {listed.depth:g} m of {place.stem}.out"
    return {"length_unit": (listed.length, ""), "rotation_center": (listed.about, ""), "water_depth": depth}


def _of_hull(gdf):
    """The same of NAME.gdf"""
    length = _ulen(gdf)
    return {"length_unit": (length, f"ULEN {length:g} m of {gdf.name}")}


def _of_potential(pot, depth, point, unit):
    """The same of NAME.pot; depth, point : in its unit of length, `unit` m; point : None without bodies"""
    depth = depth * unit if depth > 0 else inf
    found = {"water_depth": (depth, f"water depth {depth:g} m of {pot.name}")}
    if point:
        about = tuple(x * unit for x in point)
        words = f"XBODY {', '.join(f'{x:g}' for x in about)} m of {pot.name}" if any(about) else ""
        found["rotation_center"] = about, words
    return found


def _listed(place, known):
    """`listed_inputs` of the listing beside NAME.1, None without one"""
    path = beside(place, ".out")
    lines, start = before_periods(path) if path else ((), None)
    if start is None:
        return None
    asked = {name: value for name, value in known.items() if name != "water_depth"}
    return listed_inputs(path, lines[:start], asked | {"body": known.get("body") or 1})


def listed_inputs(place, lines, known):
    """`Inputs` from the lines that precede the first period in NAME.out"""
    places = numbers_after(r"XBODY\s*=.*", lines) or [[0.0, 0.0, 0.0, 0.0]]
    which = body_of(place, len(places), known)
    if len(places[which]) > 3 and places[which][3]:
        raise FormatError(f"{place}: PHIBODY turns the body by {places[which][3]:g}°; allowed: 0")
    gravity, *rest = (numbers_after(r"Gravity:.*", lines) or [[known.get("gravity") or 9.80665]])[0]
    scale = known.get("length_unit") or (rest[0] if rest else 1.0)
    text = "\n".join(lines)
    written = re.search(r"Water depth:\s*(\S+)", text)
    depth = inf if written is None or written[1].lower().startswith("inf") else float(written[1])
    said = _other_depth(known, depth, f"water depth {depth:g} m of {Path(place).name}") if written else ()
    about = known.get("rotation_center")
    about = tuple(places[which][:3]) if about is None else tuple(about)
    names = re.findall(r"N=\s*\d+\s+(\S+\.gdf)", text, re.I)
    hull = names[which] if which < len(names) and place.with_name(names[which]).is_file() else ""
    gdf = beside(place, ".gdf")
    return Inputs(scale, about, "period", scale, tuple(said), known.get("water_depth") or depth, gravity, len(places),
                  hull or (gdf.name if gdf else ""), True)  # fmt: skip


def numbers_after(pattern, lines):
    """Lists of the numbers in each match of a pattern"""
    text = "\n".join(lines)
    return [[float(x) for x in re.findall(NUMBER, part)] for part in re.findall(pattern, text)]


def before_periods(path):
    """Lines of a WAMIT listing, and the number of lines before its first period; this number is None for another
    file"""
    lines = lines_of(path)
    if not any("WAMIT" in line for line in lines[:20]):
        return lines, None
    return lines, next((i for i, line in enumerate(lines) if PERIOD.search(line)), None)


def _kind_listed(place, given):
    """The kind with which the first column of NAME.1 gives the periods of the listing, "period" if none does"""
    periods = [m[1] for line in lines_of(beside(place, ".out")) if (m := PERIOD.search(line)) and m[1][0].isdigit()]
    heads = {numbers[0] for line in lines_of(beside(place, ".1")) if len(numbers := numbers_of(line)) == 5}
    listed = np.unique(2 * np.pi / np.array(periods, float))
    for kind in PERIOD_KINDS.values():
        found = np.unique(omega_of(sorted(heads), kind, given.depth, given.gravity, given.wave_length))
        if len(found) == len(listed) and np.allclose(found, listed, rtol=SAME_PERIOD):
            return kind
    return "period"


def beside(place, suffix):
    """The file with the name of `place` and another suffix, in any case of letters; None if there is no such file"""
    found = (place.with_suffix(one) for one in (suffix, suffix.upper()))
    return next((path for path in found if path.is_file()), None)


def _head(path):
    """ULEN and GRAV of a .gdf, if present"""
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
    """The kind given by IPEROUT in a .cfg"""
    kind = _configured(path, "IPEROUT")
    if kind is not None and kind not in PERIOD_KINDS:
        raise FormatError(f"{path}: IPEROUT is {kind:g}; allowed: {', '.join(map(str, PERIOD_KINDS))}")
    return PERIOD_KINDS[int(kind or 1)]


class Potential(NamedTuple):
    """Content of a .pot file

    depth : depth in the unit of the file, ≤ 0 for deep water; bodies : [(name of the .gdf, (x, y, z) of XBODY)]"""

    depth: float
    bodies: list

    def of_body(self, number):
        """Name of the .gdf and XBODY of body `number`, from 1. A larger number gives the last body; a file without
        bodies gives "" and None"""
        return self.bodies[min(number, len(self.bodies)) - 1] if self.bodies else ("", None)


def _potential(path, without=False):
    """`Potential` of a file.  Raises FormatError for rotated axes, or a truncated file.

    without : whether points of moments are given elsewhere, so that an unreadable file does not matter
    """
    lines = iter(lines_of(path)[1:])

    def read(count):
        got = []
        for line in lines:
            got += numbers_of(line)[: count - len(got)]
            if len(got) == count:
                return got
        raise FormatError(f"{path} ends before XBODY; give --about x,y,z and leave the file out, or mend the file")

    try:
        (depth,) = read(1)
        if any(number not in (-1, 0, 1) for number in _same_line(lines)):
            return None  # file of the older form, IALTPOT = 1
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
    """IRAD and IDIFF, which share a line; other values if there are not two"""
    found = numbers_of(next(lines, ""))[:2]
    return found if len(found) == 2 else (9,)


def _configured(path, key):
    for line in lines_of(path):
        found = re.match(rf"\s*{key}(?:\(\d+\))?\s*=\s*([-+\d.]+)", line, re.I)
        if found:
            return float(found[1])
    return None
