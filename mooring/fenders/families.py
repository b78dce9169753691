"""Generic fenders by family, and fenders by tables of makers.

A family is a shape (reaction over rated reaction, by strain) scaled by size and grade. The shapes are in
`tables/shapes.csv` and the rated values in `tables/families.csv`; each file names its sources. A maker's table is a
CSV with the columns

    strain (of the height) or deflection_m,  reaction_kN,  and, if measured, unloading_kN.
"""

from functools import cache
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import csv_rows, packaged_rows, read_text

from .fender import FenderError, fender_of_points
from .pneumatic import pneumatic

WITHOUT = ("pi", "cylinder", "circle", "arch", "unit element")  # manufactured, but without a public curve
MARKS = ("rated", "allowable", "limit", "return_length")


@cache
def families():
    """{family: {"strain", "reaction", "unloading": arrays, MARKS: numbers, "intensity": kN/m² or None}}"""
    marks, shapes = (packaged_rows(__package__, name) for name in ("families", "shapes"))
    out = {}
    for row in marks:
        points = [shape for shape in shapes if shape["family"] == row["family"]]
        out[row["family"]] = {
            key: np.array([float(p[key]) for p in points]) for key in ("strain", "reaction", "unloading")
        } | {key: float(row[key]) for key in MARKS}
        out[row["family"]]["intensity"] = float(row["intensity"]) if row["intensity"] else None
    return out


def names():
    """Names of all families"""
    return (*families(), "pneumatic")


def _with_reaction():
    """Names of the families whose ordinary grade a public source gives"""
    return (*(name for name, one in families().items() if one["intensity"] is not None), "pneumatic")


def fender_of_family(family, height, *, length=None, rated_reaction=None, pressure=None, overload=None):
    """A generic `fender.Fender`.

    height : m, for a pneumatic fender its diameter; length : m, for v, h and pneumatic fenders
    rated_reaction : N, by default that of the ordinary grade; pressure : gauge pressure of a pneumatic fender, Pa
    raises : FenderError
    """
    if family not in names():
        way = "table, the manufacturer's CSV of strain and reaction_kN"
        if family in WITHOUT:
            raise FenderError(f"family {family!r} has no public curve; give {way}, with height and rated_strain")
        raise FenderError(f"family {family!r} is unknown; allowed: {', '.join(names())}; or {way}")
    label = f"{family} {height:g} m" + (f" × {length:g} m" if length else "")
    if family == "pneumatic":
        if length is None:
            raise FenderError(f"{label}: the length is missing; a pneumatic fender needs diameter and length")
        if rated_reaction is not None:
            raise FenderError(f"{label}: a pneumatic fender is defined by diameter, length and pressure only")
        return pneumatic(label, height, length, 50e3 if pressure is None else pressure, overload)
    if pressure is not None:
        raise FenderError(f"{label}: a pressure is given; only pneumatic fenders have one")
    shape = families()[family]
    if rated_reaction is None:
        rated_reaction = _ordinary(label, family, shape["intensity"], height, length)
    if not 0 < rated_reaction < np.inf:
        raise FenderError(f"{label}: its rated reaction is {rated_reaction:g} N; allowed: above 0, finite")
    return fender_of_points(
        label,
        height,
        shape["strain"] * height,
        shape["reaction"] * rated_reaction,
        shape["unloading"] * rated_reaction,
        rated=shape["rated"],
        allowable=shape["allowable"],
        return_length=shape["return_length"] * height,
        overload=overload,
    )


def _ordinary(label, family, intensity, height, length):
    if intensity is None:
        raise FenderError(
            f"{label}: no public source gives its reaction; give rated_reaction, the rated reaction of the "
            f"manufacturer; families that do not need it: {', '.join(_with_reaction())}"
        )
    if family != "cell" and length is None:
        raise FenderError(f"{label}: its length is missing; give the length, or the rated reaction of the manufacturer")
    return 1e3 * intensity * height * (height if family == "cell" else length)


def fender_of_file(path, height, **marks):
    """`fender.Fender` of a maker's CSV table; height : m; marks : as in `fender_of_points`.  Raises FenderError."""
    rows = list(csv_rows(read_text(path, FenderError, largest=1)))
    columns = set(rows[0]) if rows else set()
    along = next((key for key in ("strain", "deflection_m") if key in columns), None)
    if along is None or "reaction_kN" not in columns:
        raise FenderError(
            f"{path} has the columns {', '.join(sorted(map(str, columns))) or 'of an empty file'}; allowed: strain or "
            "deflection_m, reaction_kN, unloading_kN"
        )
    x = _column(path, rows, along) * (height if along == "strain" else 1.0)
    down = 1e3 * _column(path, rows, "unloading_kN") if "unloading_kN" in columns else None
    return fender_of_points(Path(path).name, height, x, 1e3 * _column(path, rows, "reaction_kN"), down, **marks)


def _column(path, rows, key):
    try:
        return np.array([float(row[key]) for row in rows])
    except (TypeError, ValueError):
        wrong = next(i for i, row in enumerate(rows, 1) if not _number(row[key]))
        raise FenderError(f"{path}, row {wrong}: {key} is {rows[wrong - 1][key]!r}; allowed: a number") from None


def _number(text):
    try:
        return text is not None and np.isfinite(float(text))
    except ValueError:
        return False
