"""Parts of a system of lines: kinds of line, lines, anchors, fairleads, free points and floating bodies.

A line joins two points.  `assembly` needs one row of forces at both ends, in the vertical plane through these ends,
and their derivatives. The row is compiled for a `UniformLine`, comes from a solver for a `CompositeLine`, and from
the curve of a `hawser.Hawser`. Other kinds of line can be added in `assembly`.

All values SI, all frozen.  A `Fairlead` is given in the axes of its body, everything else in space.
"""

from dataclasses import dataclass, field

import numpy as np

from hakobune.bem import DOFS

from ..multi_segment.bed import Bed
from ..multi_segment.segments import PointLoad, Segment


class LineSystemError(ValueError):
    """An impossible system: the message names the part, its value and the limit."""


class EquilibriumError(ValueError):
    """No position was found in which the lines balance the steady forces."""


@dataclass(frozen=True)
class LineDynamics:
    """Properties that only moving or bending lines need; statics ignore them, and files keep them.

    drag_normal, drag_tangential : C_d on d and on π d per metre; added_mass_normal, added_mass_tangential : C_a
    damping : axial damping BA, N s; a negative value is minus the fraction of critical; bending_stiffness : EI, N m²
    """

    drag_normal: float = 1.2
    drag_tangential: float = 0.1
    added_mass_normal: float = 1.0
    added_mass_tangential: float = 0.0
    damping: float = -1.0
    bending_stiffness: float = 0.0


@dataclass(frozen=True)
class LineType:
    """Material properties of a line.

    weight : submerged weight, N/m, below 0 for a floating line; axial_stiffness : EA, N, may be inf
    mass : kg/m in air; diameter : diameter of a cylinder of the same volume, m; breaking_load, proof_load : N
    dynamics : LineDynamics, None if unknown
    """

    name: str
    weight: float
    axial_stiffness: float = np.inf
    mass: float | None = None
    diameter: float | None = None
    breaking_load: float = np.inf
    proof_load: float | None = None
    source: str = ""
    dynamics: LineDynamics | None = None

    def __post_init__(self):
        _check(f"line type {self.name}: weight", self.weight, self.weight != 0, "finite, not 0 N/m")
        for name in ("axial_stiffness", "breaking_load"):
            value = getattr(self, name)
            if not value > 0:
                raise LineSystemError(f"line type {self.name}: {name} is {value:g} N; allowed: above 0")


@dataclass(frozen=True)
class UniformLine:
    """A uniform line between two points, given by name.

    length : unstretched length, m; elements : number of elements in a run in time, None for a default
    weight_in_air : weight of parts above z = 0, N/m; None if they have their weight in water
    """

    name: str
    type: LineType
    length: float
    a: str
    b: str
    bed_friction: float = 0.0
    elements: int | None = None
    weight_in_air: float | None = None

    def __post_init__(self):
        _check(f"line {self.name}: length", self.length, self.length > 0, "finite, above 0 m")
        _check(f"line {self.name}: bed_friction", self.bed_friction, self.bed_friction >= 0, "finite, at least 0")
        if self.weight_in_air is not None:
            least, air = self.type.weight, self.weight_in_air
            _check(
                f"line {self.name}: weight_in_air",
                air,
                air >= least > 0,
                "finite, at least the weight in water, which must be above 0",
            )

    @property
    def breaking_load(self):
        """N, inf if unknown"""
        return self.type.breaking_load


@dataclass(frozen=True)
class CompositeLine:
    """A line of several segments, with sinkers and buoys on the line, between two points given by name.

    segments : from end a on; loads : PointLoads, positioned by the unstretched length from end a, m
    bed_friction : friction coefficient of the system's flat bed, where one end is an anchor on this bed
    bed : Bed of this line, measured from its anchor, with the same section in every direction to which the line
        swings.
    A line without an anchor on a bed must hang clear of the bed, with its buoys under water.
    """

    name: str
    segments: tuple[Segment, ...]
    a: str
    b: str
    loads: tuple[PointLoad, ...] = ()
    bed_friction: float = 0.0
    bed: Bed | None = None

    def __post_init__(self):
        object.__setattr__(self, "segments", tuple(self.segments))
        object.__setattr__(self, "loads", tuple(self.loads))
        if not self.segments:
            raise LineSystemError(f"line {self.name}: it has no segments; allowed: at least one")
        _check(f"line {self.name}: bed_friction", self.bed_friction, self.bed_friction >= 0, "finite, at least 0")
        for load in self.loads:
            inside = 0 < load.position < self.length
            _check(f"line {self.name}: position of a load", load.position, inside, f"above 0, below {self.length:g} m")

    @property
    def length(self):
        """m, unstretched"""
        return float(sum(segment.length for segment in self.segments))

    @property
    def breaking_load(self):
        """Smallest breaking load of the segments, N; inf if none is known"""
        return min(segment.breaking_load for segment in self.segments)


@dataclass(frozen=True)
class Anchor:
    """A point that never moves: an anchor on the bed, a pile, a bollard.  position : (3,) m in space"""

    name: str
    position: tuple[float, float, float]


@dataclass(frozen=True)
class Fairlead:
    """A point of a body.  position : (3,) m in the body's axes"""

    name: str
    body: str
    position: tuple[float, float, float]


@dataclass(frozen=True)
class FreePoint:
    """A joint, sinker or buoy that is free to move to its equilibrium.

    position : (3,) m, start of the search for its place; mass : kg; volume : m³
    height : height over which the point emerges, m, by default that of a sphere. The point may rest on the bed
    drag_area : C_d A, m²; added_mass : added mass over the displaced mass; both only for a run in time
    """

    name: str
    position: tuple[float, float, float]
    mass: float = 0.0
    volume: float = 0.0
    height: float | None = None
    drag_area: float = 0.0
    added_mass: float = 0.0

    def __post_init__(self):
        _check(f"point {self.name}: mass", self.mass, self.mass >= 0, "finite, at least 0 kg")
        _check(f"point {self.name}: volume", self.volume, self.volume >= 0, "finite, at least 0 m³")
        if self.height is not None:
            _check(f"point {self.name}: height", self.height, self.height > 0, "finite, above 0 m")

    @property
    def emersion_height(self):
        """Height from just submerged to just out of the water, m"""
        return self.height or (6 * self.volume / np.pi) ** (1 / 3) or 1.0


@dataclass(frozen=True)
class MooredBody:
    """A floating body.

    position : (6,) m and rad at rest: x, y, z of its axes' origin, then roll, pitch and yaw, R = Rz Ry Rx
    freedom : names of the free motions; all other motions are fixed
    hydrostatic_stiffness : (6, 6) about the origin; only its heave, roll and pitch are used
    load : steady load (6,), N and N m, in space axes about the moving origin
    """

    name: str
    position: tuple[float, ...] = (0.0,) * 6
    freedom: tuple[str, ...] = ("Surge", "Sway", "Yaw")
    hydrostatic_stiffness: np.ndarray | None = field(default=None, compare=False)
    load: tuple[float, ...] = (0.0,) * 6

    def __post_init__(self):
        unknown = set(self.freedom) - set(DOFS)
        if unknown:
            raise LineSystemError(f"body {self.name}: freedom {min(unknown)!r} is unknown; allowed: {', '.join(DOFS)}")
        for name in ("position", "load"):
            value = np.asarray(getattr(self, name), float)
            if value.shape != (6,) or not np.all(np.isfinite(value)):
                raise LineSystemError(f"body {self.name}: {name} is {getattr(self, name)}; allowed: six finite numbers")
        stiffness = self.hydrostatic_stiffness
        if stiffness is not None and np.shape(stiffness) != (6, 6):
            raise LineSystemError(f"body {self.name}: hydrostatic_stiffness is {np.shape(stiffness)}; allowed: (6, 6)")


def _check(what, value, good, allowed):
    if not (np.isfinite(value) and good):
        raise LineSystemError(f"{what} is {value:g}; allowed: {allowed}")
