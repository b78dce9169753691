"""Input of a study of moored hulls: each as a box in its place, and the wind, current and waves that load it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..environment.sea import Sea
from ..lines.system.bodies import axes_in_space, rotation
from ..loads.box_drag import DragTable
from ..loads.box_wind import AIR_DENSITY, BOX
from ..loads.coefficients import HullCoefficients
from ..on_current.waves import SPECTRA


@dataclass(frozen=True)
class ExposedBox:
    """The box that wind and current act on, its middle at x = y = 0.

    length, beam, draft, freeboard (depth of the hull less draft) : m
    front_area, side_area : m², of superstructures from ahead and from abeam
    superstructure_z : m, their middle above still water, None for half their height on the deck, all along the hull
    """

    length: float
    beam: float
    draft: float
    freeboard: float
    front_area: float = 0.0
    side_area: float = 0.0
    superstructure_z: float | None = None


@dataclass(frozen=True)
class Wind:
    """speed m/s, direction rad blown to, density kg/m³

    table : coefficients of a box, of a hull, or a function (ExposedBox) → those of a hull
    height : m above still water at which it acts, None for the middle of what it meets (`loads.on_hull`)
    """

    speed: float
    direction: float
    density: float = AIR_DENSITY
    table: DragTable | HullCoefficients | Callable = BOX
    height: float | None = None


@dataclass(frozen=True)
class Current:
    """speed m/s, direction rad it flows to

    table : coefficients as of a Wind, None for the SR179 box tests
    height : m above still water at which it acts, None for half the draft below it
    waves : of `mooring.on_current.waves.SPECTRA`, frequencies in which the waves are given that it carries:
    "intrinsic", in the water that moves along, "absolute", at a place at rest; "still": waves that do not know of it
    """

    speed: float
    direction: float
    table: DragTable | HullCoefficients | Callable | None = None
    height: float | None = None
    waves: str = "intrinsic"

    def __post_init__(self):
        if self.waves not in SPECTRA:
            raise ValueError(f"waves of the current are {self.waves!r}; allowed: {', '.join(SPECTRA)}")


@dataclass(frozen=True)
class Waves:
    """height m, significant; period s, mean; direction rad travelled to"""

    height: float
    period: float
    direction: float

    @property
    def omega(self):
        """rad/s.  Raises ValueError for a period that is none."""
        if not 0 < self.period < np.inf:
            raise ValueError(f"wave period is {self.period:g} s; allowed: above 0")
        return 2 * np.pi / self.period


@dataclass(frozen=True)
class Conditions:
    """Wind, current and waves of a study; None leaves the load out.

    method : of `wave_effects.METHODS`, "irregular" or "regular_wave"
    sea : `environment.sea.Sea` of the waves; None for the ISSC spectrum of their height and period with long crests
    duration : s, in which the largest motions in irregular waves are expected
    motion_factor : by which the largest motions are multiplied before lines are tightened by them, as some rules ask
    """

    wind: Wind | None = None
    current: Current | None = None
    waves: Waves | None = None
    method: str = "irregular"
    sea: Sea | None = None
    duration: float = 10800.0
    motion_factor: float = 1.0


class Afloat(NamedTuple):
    """A hull that moves.

    name : of its body in the System; box : ExposedBox about the origin of its coordinates
    rotation_center : (3,) m in these; place : (2,) m, their origin in space; heading : rad, of their x axis
    density : kg/m³ of the water
    """

    name: str
    box: ExposedBox
    rotation_center: np.ndarray
    place: np.ndarray
    heading: float
    density: float

    @property
    def axes(self):
        """(3, 3) whose columns are its axes in space"""
        return rotation(0.0, 0.0, self.heading)

    @property
    def position(self):
        """(6,) m and rad, of its `MooredBody` at rest"""
        return np.array([*(self.axes @ self.rotation_center + (*self.place, 0.0)), 0.0, 0.0, self.heading])

    def own(self, point):
        """(3,) m in its coordinates of a point in space"""
        return (np.asarray(point, float) - (*self.place, 0.0)) @ self.axes


def afloat(db, hull, name="body"):
    """(`Afloat`, …) of the bodies of a database that move, in its order.

    hull : ExposedBox of one body, called `name`; of several {name: ExposedBox}
    """
    if not db.bodies:
        return (alone(db, hull, name),)
    return tuple(
        Afloat(body.name, hull[body.name], body.own_center, np.asarray(body.place), body.heading, db.density)
        for body in db.bodies
        if not body.fixed
    )


def alone(body, hull, name="body"):
    """`Afloat` of one body, which has rotation_center and density"""
    return Afloat(name, hull, np.asarray(body.rotation_center, float), np.zeros(2), 0.0, body.density)


def in_motions(stiffness, hulls):
    """(n, n) about the axes that motions are along, of one (n, n) about those of space, of hulls one after another"""
    if len(hulls) == 1 and not hulls[0].heading:
        return stiffness
    turn = axes_in_space([one.heading for one in hulls])
    return turn.T @ stiffness @ turn
