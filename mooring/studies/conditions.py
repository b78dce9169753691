"""Input of a study of a moored hull: the hull as a box, and the wind, current and waves that load it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..environment.sea import Sea
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
