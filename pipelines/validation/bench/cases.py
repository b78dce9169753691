"""Bodies and waves of the bench, and the coefficients it compares.

Six frequencies for each body, from long waves to beyond its first irregular frequency; one heading in which all modes
are excited.
"""

import math
from typing import NamedTuple

DENSITY, GRAVITY, HEADING = 1025.0, 9.80665, 30.0  # kg/m³, m/s², degrees
PAIRS = ("11", "22", "33", "44", "55", "66", "15", "51", "24", "42")


class Case(NamedTuple):
    """A body in water: `sizes` in m, as keys of a scene's body"""

    name: str
    shape: str
    sizes: dict
    depth: float
    omega: tuple

    @property
    def title(self):
        size = " × ".join(f"{value:g}" for value in self.sizes.values())
        kind = "box" if self.shape == "box" else "cylinder, radius × draft"
        return f"{kind} {size} m, depth {self.depth:g} m"

    @property
    def reach(self):
        """m, largest distance of the hull from the vertical axis"""
        return self.sizes.get("radius") or math.hypot(self.sizes["length"], self.sizes["beam"]) / 2


def _cylinder(depth):
    sizes = {"radius": 10.0, "draft": 10.0}
    return Case(f"cylinder-{depth:g}", "buoy", sizes, depth, (0.2, 0.5, 0.8, 1.1, 1.4, 1.7))


def _box(depth):
    sizes = {"length": 100.0, "beam": 50.0, "draft": 10.0}
    return Case(f"box-{depth:g}", "box", sizes, depth, (0.2, 0.4, 0.6, 0.8, 1.0, 1.2))


CASES = {case.name: case for case in (*map(_cylinder, (15.0, 30.0, 100.0)), *map(_box, (12.0, 20.0, 100.0)))}
