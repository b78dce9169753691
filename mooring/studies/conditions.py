"""What a study of a moored hull is given: the hull as a box, and the weather it has to stand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..loads.box_drag import DragTable
from ..loads.box_wind import AIR_DENSITY, BOX


@dataclass(frozen=True)
class Hull:
    """A box: length, beam, draft and freeboard (depth of the hull less draft), m, its middle at x = y = 0."""

    length: float
    beam: float
    draft: float
    freeboard: float


@dataclass(frozen=True)
class Wind:
    """speed m/s, direction rad blown to, density kg/m³"""

    speed: float
    direction: float
    density: float = AIR_DENSITY
    table: DragTable = BOX


@dataclass(frozen=True)
class Current:
    """speed m/s, direction rad flown to; without a table the box tests of the report are used"""

    speed: float
    direction: float
    table: DragTable | None = None


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
    """What a study applies; a load that is None is left out."""

    wind: Wind | None = None
    current: Current | None = None
    waves: Waves | None = None
