"""Input of a study of moored hulls: each hull as a box at its place, and wind, current and waves."""

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
    """The box on which wind and current act, its middle at x = y = 0.

    length, beam, draft, freeboard (depth of the hull less draft) : m
    front_area, side_area : areas of superstructures seen from ahead and from abeam, m²
    superstructure_z : height of the middle of the superstructures above still water, m; None for superstructures on
        deck along the whole hull
    is_round : whether the hull is a vertical cylinder of this beam and length, with superstructures on it
    """

    length: float
    beam: float
    draft: float
    freeboard: float
    front_area: float = 0.0
    side_area: float = 0.0
    superstructure_z: float | None = None
    is_round: bool = False


@dataclass(frozen=True)
class Wind:
    """speed : m/s; direction : direction of travel, rad; density : kg/m³

    table : coefficients of a box, of a hull, or a function (ExposedBox) → coefficients of a hull
    height : height of the point of action above still water, m, None for the middle of the exposed area
    (`loads.on_hull`)
    """

    speed: float
    direction: float
    density: float = AIR_DENSITY
    table: DragTable | HullCoefficients | Callable = BOX
    height: float | None = None


@dataclass(frozen=True)
class Current:
    """speed : m/s; direction : direction of flow, rad

    table : coefficients as of a Wind, None for those of `ship`
    height : height of the point of action above still water, m, None for half the draft below still water
    ship : "tanker", or None for the SR179 box tests
    waves : one of `mooring.on_current.waves.SPECTRA`: frequencies of waves on this current are "intrinsic", in the
        moving water, or "absolute", at a fixed place; "still" means waves unaffected by the current
    """

    speed: float
    direction: float
    table: DragTable | HullCoefficients | Callable | None = None
    height: float | None = None
    waves: str = "intrinsic"
    ship: str | None = None

    def __post_init__(self):
        if self.waves not in SPECTRA:
            raise ValueError(f"waves of the current are {self.waves!r}; allowed: {', '.join(SPECTRA)}")


@dataclass(frozen=True)
class Waves:
    """height : significant height, m; period : mean period, s; direction : direction of travel, rad"""

    height: float
    period: float
    direction: float

    @property
    def omega(self):
        """rad/s.  Raises ValueError for an invalid period."""
        if not 0 < self.period < np.inf:
            raise ValueError(f"wave period is {self.period:g} s; allowed: above 0")
        return 2 * np.pi / self.period


@dataclass(frozen=True)
class Conditions:
    """Wind, current and waves of a study; None omits the load.

    method : one of `wave_effects.METHODS`, "irregular" or "regular_wave"
    sea : `environment.sea.Sea` of the waves; None for a long-crested ISSC spectrum of their height and period
    duration : time in which the largest motions in irregular waves are expected, s
    motion_factor : factor on the largest motions before line tensions are computed, as some rules require
    """

    wind: Wind | None = None
    current: Current | None = None
    waves: Waves | None = None
    method: str = "irregular"
    sea: Sea | None = None
    duration: float = 10800.0
    motion_factor: float = 1.0


class Afloat(NamedTuple):
    """A moving hull.

    name : name of the body in the System; box : ExposedBox about the origin of its coordinates
    rotation_center : (3,) m in these coordinates; place : origin of the coordinates in space, (2,) m; heading :
        heading of their x axis, rad
    density : density of the water, kg/m³
    """

    name: str
    box: ExposedBox
    rotation_center: np.ndarray
    place: np.ndarray
    heading: float
    density: float

    @property
    def axes(self):
        """Matrix whose columns are the axes of the body in space; shape (3, 3)"""
        return rotation(0.0, 0.0, self.heading)

    @property
    def position(self):
        """Position, m and rad, of its `MooredBody` at rest; shape (6,)"""
        return np.array([*(self.axes @ self.rotation_center + (*self.place, 0.0)), 0.0, 0.0, self.heading])

    def own(self, point):
        """A point of space in the hull's own coordinates, m; shape (3,)"""
        return (np.asarray(point, float) - (*self.place, 0.0)) @ self.axes


def afloat(db, hull, name="body"):
    """An `Afloat` for each moving body of a database, in the order of the bodies.

    hull : ExposedBox of one body, called `name`; for several bodies {name: ExposedBox}
    """
    if not db.bodies:
        return (alone(db, hull, name),)
    return tuple(
        Afloat(body.name, hull[body.name], body.own_center, np.asarray(body.place), body.heading, db.density)
        for body in db.bodies
        if not body.fixed
    )


def alone(body, hull, name="body"):
    """`Afloat` of one body with rotation_center and density"""
    return Afloat(name, hull, np.asarray(body.rotation_center, float), np.zeros(2), 0.0, body.density)


def in_motions(stiffness, hulls):
    """Matrix about the axes of motions, from a matrix (n, n) about space axes; six rows for each hull; shape (n, n)"""
    if len(hulls) == 1 and not hulls[0].heading:
        return stiffness
    turn = axes_in_space([one.heading for one in hulls])
    return turn.T @ stiffness @ turn
