"""Results of a load case for report and criteria, the same for every kind of study."""

from typing import NamedTuple

import numpy as np

from .needs import HINGE_FORCE, HINGE_MOMENT


class Numbers(NamedTuple):
    """n lines, ropes or hawsers, SI.

    types : names of the types that each is made of; fairlead, anchor : (n, 3) m, at rest
    pretension, static, largest, breaking : (n,) N, at rest, under steady loads, largest, inf if unknown
    horizontal, uplift : (n,) N, largest at the anchor
    place : (3,) m, m, rad, under steady loads, of several bodies (N, 3), nan for a method without it
    motions : (6,) m, rad, largest, of several bodies (6N,), () if there are none; bodies : names of several
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
    """Breaking loads (n,), N, reduced where the utilisation exceeds the utilisation of the largest pull on the body
    (n,), N; shape (n,)

    used : (n,) largest utilisation of any segment; below a buoy the tension of a line exceeds its pull on the body
    """
    held = np.divide(largest, used, out=np.full(len(used), np.inf), where=np.isfinite(used) & (used > 0))
    return np.where(held < breaking * (1 - 1e-9), held, breaking)


def held_by_hinges(names, largest):
    """{quantity: {name: kN or kN m}} of forces and moments of hinges, N and N m, along and about their axes

    names : each of a hinge and an axis, as "bow force x"; others, as travel, are left out
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
