"""Results of a load case for report and criteria, in one form for every kind of study."""

from typing import NamedTuple

import numpy as np

from .needs import HINGE_FORCE, HINGE_MOMENT


class Numbers(NamedTuple):
    """Numbers of n lines, ropes or hawsers, SI.

    types : names of the types in each line; fairlead, anchor : (n, 3) m, at rest
    pretension, static, largest, breaking : (n,) N, at rest, under steady loads, largest, inf if unknown
    horizontal, uplift : largest pulls at the anchor, (n,) N
    place : position under steady loads, (3,), m, m, rad; for several bodies (N, 3); nan for a method that does not
        compute it
    motions : largest motions, (6,), m and rad; for several bodies (6N,); () if there are none; bodies : names of
        several bodies
    parts : {quantity: {part: value}}, other than tensions and motions; hawsers : names of the hawsers
    warnings : findings, one line each
    """

    names: tuple
    types: tuple
    fairlead: np.ndarray
    anchor: np.ndarray
    length: np.ndarray
    pretension: np.ndarray
    static: np.ndarray
    largest: np.ndarray
    breaking: np.ndarray
    horizontal: np.ndarray
    uplift: np.ndarray
    place: np.ndarray
    motions: np.ndarray
    parts: dict
    hawsers: tuple = ()
    warnings: tuple = ()
    bodies: tuple = ()


def strength(breaking, largest, used):
    """Breaking loads, N, shape (n,), reduced where the utilisation inside a line exceeds that of its largest pull on
    the body.

    used : (n,) largest utilisation of any segment; below a buoy the tension of a line exceeds its pull on the body
    """
    held = np.divide(largest, used, out=np.full(len(used), np.inf), where=np.isfinite(used) & (used > 0))
    return np.where(held < breaking * (1 - 1e-9), held, breaking)


def held_by_hinges(names, largest):
    """{quantity: {name: kN or kN m}} of forces and moments of hinges, N and N m, along and about their axes

    names : names of a hinge and an axis, as "bow force x"; all other names, such as travel, are left out
    """
    found = {}
    for name, value in zip(names, largest, strict=True):
        for word, quantity in (("force", HINGE_FORCE), ("moment", HINGE_MOMENT)):
            if name.split()[-2:-1] == [word]:
                found.setdefault(quantity, {})[name] = abs(float(value)) / 1e3
    return found


def types_of(table):
    """Names of the types in a line's table"""
    return (table["type"],) if "type" in table else tuple(segment["type"] for segment in table["segments"])
