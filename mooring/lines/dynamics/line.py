"""A mooring line for dynamics as a value: segments, bodies between them, the anchor and the bed."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..multi_segment.segments import Segment
from ..system.parts import LineDynamics
from .bed import ElasticBed
from .bed import check as _check
from .lumped.system import System

DAMPED = 40  # elements of a segment above which damping is that of the line, independent of the mesh
STUCK, LEAST_SLIP = 0.1, 1e-7  # part of an element's stretch by friction that mobilises it; m, lower limit
SOFT = 1e-2  # damping fades in up to this part of the strain under the line's own weight


@dataclass(frozen=True)
class DynamicSegment:
    """A uniform part of a line in `elements` straight elements.

    length : unstretched length, m; mass : kg/m in air; weight : N/m in water; diameter : diameter of the displaced
        volume, m
    axial_stiffness : EA, N, or a table of (strain, tension) pairs, ascending from (0, 0), linear between and beyond
        its points (`multi_segment.segments.Segment`); the table's largest EA is then `stiffness`
    structural_damping : BA, N s, or None for `damping_ratio`, a fraction of the critical damping ℓ√(EA m) of an
        element. ℓ is the length of an element, at least a fortieth of the segment
    drag_normal, drag_tangential : coefficients on D and on πD; the report's tangential coefficient, on D, is π times
        larger
    added_normal, added_tangential : added mass over the displaced mass; bending_stiffness : EI, N m², 0 for chain
    """

    length: float
    mass: float
    weight: float
    diameter: float
    axial_stiffness: float | tuple
    elements: int = 20
    damping_ratio: float = 1.0
    structural_damping: float | None = None
    drag_normal: float = LineDynamics.drag_normal
    drag_tangential: float = LineDynamics.drag_tangential
    added_normal: float = LineDynamics.added_mass_normal
    added_tangential: float = LineDynamics.added_mass_tangential
    bending_stiffness: float = 0.0

    def __post_init__(self):
        for name in ("length", "mass", "diameter"):
            _check(f"segment {name}", getattr(self, name), 0.0, strict=True)
        _check("segment axial_stiffness", self.stiffness, 0.0, strict=True)
        for name in (
            "damping_ratio",
            "drag_normal",
            "drag_tangential",
            "added_normal",
            "added_tangential",
            "bending_stiffness",
        ):
            _check(f"segment {name}", getattr(self, name), 0.0)
        if self.structural_damping is not None:
            _check("segment structural_damping", self.structural_damping, 0.0)
        if not np.isfinite(self.weight):
            raise ValueError(f"segment weight is {self.weight:g} N/m; allowed: finite")
        if int(self.elements) != self.elements or self.elements < 1:
            raise ValueError(f"segment elements is {self.elements}; allowed: whole numbers from 1")

    @cached_property
    def elongation(self):
        """Rows of a tension curve, shape (k, 4): strain at which the row's range starts; tension, slope and integral
        there, all over `stiffness`
        """
        if np.ndim(self.axial_stiffness) == 0:
            return np.array([[0.0, 0.0, 1.0, 0.0]])
        strain, tension = self._points
        slope = np.diff(tension) / np.diff(strain)
        energy = np.concatenate([[0.0], np.cumsum(0.5 * (tension[1:] + tension[:-1]) * np.diff(strain))])
        return np.column_stack([strain[:-1], *(v / slope.max() for v in (tension[:-1], slope, energy[:-1]))])

    @property
    def _points(self):
        """Strains and tensions of the table.  Raises ValueError for what is none."""
        _ = Segment(self.length, 1.0, self.axial_stiffness).strain_table
        strain, tension = np.array(self.axial_stiffness, float).T
        if not np.all(np.diff(strain) > 0):
            raise ValueError("segment axial_stiffness: the table has a strain twice; allowed: strains that rise from 0")
        return strain, tension

    @cached_property
    def stiffness(self):
        """Axial stiffness EA, N; of a table the largest"""
        if np.ndim(self.axial_stiffness) == 0:
            return float(self.axial_stiffness)
        strain, tension = self._points
        return float(np.max(np.diff(tension) / np.diff(strain)))

    def strain_at(self, tension):
        """Strains at the given tensions, N"""
        strain, over, slope, _ = self.elongation.T
        rows = np.searchsorted(over * self.stiffness, tension, side="right") - 1
        return strain[rows] + (np.asarray(tension) / self.stiffness - over[rows]) / slope[rows]

    @property
    def size(self):
        """Unstretched length of an element, m"""
        return self.length / self.elements

    @property
    def damping(self):
        """Structural damping BA, N s"""
        size = max(self.size, self.length / DAMPED)
        critical = size * np.sqrt(self.stiffness * self.mass)
        return self.damping_ratio * critical if self.structural_damping is None else self.structural_damping


def felt(dynamics):
    """Keywords of a DynamicSegment with the values of a `LineDynamics`; empty for None"""
    if dynamics is None:
        return {}
    damping = "structural_damping" if dynamics.damping >= 0 else "damping_ratio"
    return {
        "drag_normal": dynamics.drag_normal,
        "drag_tangential": dynamics.drag_tangential,
        "added_normal": dynamics.added_mass_normal,
        "added_tangential": dynamics.added_mass_tangential,
        "bending_stiffness": dynamics.bending_stiffness,
        damping: abs(dynamics.damping),
    }


@dataclass(frozen=True)
class AttachedBody:
    """A buoy or a clump between two segments, with its own inertia.

    mass : kg; volume : m³, of a sphere where the body meets the surface; drag_area : C_d A, m²
    added_mass : added mass over the displaced mass
    """

    mass: float
    volume: float = 0.0
    drag_area: float = 0.0
    added_mass: float = 0.5

    def __post_init__(self):
        for name in ("mass", "volume", "drag_area", "added_mass"):
            _check(f"body {name}", getattr(self, name), 0.0)


@dataclass(frozen=True)
class DynamicLine:
    """Segments from the anchor to the fairlead; `bodies[i]`, or None, sits between segments i and i + 1.

    anchor : (3,) m; bed : ElasticBed, or None for a line over deep water; density : kg/m³; gravity : m/s²
    surface : whether parts above still water have their weight in air and no water loads; if not, the line counts as
        submerged everywhere. Bodies always interact with the surface
    """

    segments: tuple[DynamicSegment, ...]
    anchor: tuple[float, float, float]
    bodies: tuple[AttachedBody | None, ...] = ()
    bed: ElasticBed | None = field(default_factory=ElasticBed)
    density: float = 1025.0
    gravity: float = 9.80665
    surface: bool = False

    def __post_init__(self):
        segments = (self.segments,) if isinstance(self.segments, DynamicSegment) else tuple(self.segments)
        if not segments:
            raise ValueError("a line has 0 segments; allowed: 1 or more")
        bodies = tuple(self.bodies) or (None,) * (len(segments) - 1)
        if len(bodies) != len(segments) - 1:
            raise ValueError(
                f"a line of {len(segments)} segments has {len(bodies)} bodies; allowed: one body fewer "
                f"than segments, or none"
            )
        anchor = np.asarray(self.anchor, float)
        if anchor.shape != (3,) or not np.all(np.isfinite(anchor)):
            raise ValueError(f"anchor is {self.anchor}; allowed: three finite numbers in m")
        _check("density", self.density, 0.0)
        _check("gravity", self.gravity, 0.0, strict=True)
        if sum(s.elements for s in segments) < 2:
            raise ValueError("a line has 1 element; allowed: 2 or more")
        heavy = [s for s in segments if s.weight > self.gravity * s.mass]
        if self.surface and heavy:
            raise ValueError(
                f"surface: a segment weighs {heavy[0].weight:g} N/m in water and, with {heavy[0].mass:g} kg/m, "
                f"{self.gravity * heavy[0].mass:g} N/m in air; allowed: no more in water than in air"
            )
        object.__setattr__(self, "segments", segments)
        object.__setattr__(self, "bodies", bodies)
        object.__setattr__(self, "anchor", tuple(map(float, anchor)))

    def __repr__(self):
        return f"<DynamicLine {self.length:.6g} m, {self.elements} elements, {len(self.segments)} segments>"

    def __str__(self):
        """The name in messages"""
        return f"line of {self.length:.6g} m in {self.elements} elements"

    @property
    def length(self):
        """m, unstretched"""
        return sum(s.length for s in self.segments)

    @property
    def elements(self):
        """number of elements"""
        return sum(s.elements for s in self.segments)

    @cached_property
    def nodes(self):
        """Unstretched distance of the nodes from the anchor, m; shape (N + 1,)"""
        return np.concatenate([[0.0], np.cumsum(self._each(lambda s: s.size))])

    def with_elements(self, factor):
        """The same line with `factor` times as many elements in every segment, at least 1 in each and 2 in the
        line.
        """
        counts = [max(1, round(s.elements * factor)) for s in self.segments]
        if sum(counts) < 2:
            counts[0] = 2
        return replace(self, segments=tuple(replace(s, elements=n) for s, n in zip(self.segments, counts, strict=True)))

    def without_bending(self):
        """The same line with EI = 0"""
        return replace(self, segments=tuple(replace(s, bending_stiffness=0.0) for s in self.segments))

    @cached_property
    def system(self):
        """Arrays for the kernels."""
        half, area = 0.5 * self._each(lambda s: s.size), self._each(lambda s: np.pi / 4 * s.diameter**2)
        D, displaced = self._each(lambda s: s.diameter), self.density * area * half
        added = displaced * self._each(lambda s: s.added_normal)
        body = self._bodies()
        half_mass = half * self._each(lambda s: s.mass)
        line_weight = _to_nodes(half * self._each(lambda s: s.weight))
        weight = line_weight + self.gravity * body["mass"]
        mass = _to_nodes(half_mass) + body["mass"]
        EA, rows, elongation = self._each(lambda s: s.stiffness), *self._elongation()
        load = np.abs(weight).sum()
        return System(
            length=2 * half,
            stiffness=EA,
            elongation_rows=rows,
            elongation=elongation,
            damping=self._each(lambda s: s.damping),
            soft_strain=SOFT * load / EA / elongation[rows[:, 0], 2],
            half_mass=half_mass,
            half_drag_normal=0.5 * self.density * D * half * self._each(lambda s: s.drag_normal),
            half_drag_tangential=0.5 * self.density * np.pi * D * half * self._each(lambda s: s.drag_tangential),
            half_added_normal=added,
            half_added_tangential=displaced * self._each(lambda s: s.added_tangential),
            half_displaced=displaced,
            buoyancy=self.surface * 2 * half * self._each(lambda s: self.gravity * s.mass - s.weight),
            waterline=np.pi / 4 * D,
            weight=weight,
            flexure=self._flexure(),
            mass=mass,
            inertia=mass + _to_nodes(added) + body["added"],
            body_nodes=np.flatnonzero(body["mass"] + body["displaced"]),
            body_buoyancy=body["displaced"] * self.gravity,
            body_radius=body["radius"],
            body_drag=body["drag"],
            body_added=body["added"],
            body_displaced=body["displaced"],
            **self._bed(_to_nodes(D * half), line_weight, weight - body["displaced"] * self.gravity),
        )

    def _bed(self, area, line_weight, weight):
        """Contact of nodes; under a body it is as much stiffer as the node is heavier."""
        if self.bed is None:
            none = np.zeros_like(area)
            return dict(
                bed_stiffness=none,
                bed_damping=none,
                bed_thickness=none,
                bed_normal=np.array([0.0, 0.0, 1.0]),
                bed_level=0.0,
                bed_friction=0.0,
                bed_slip=1.0,
                bed_course=np.zeros(4),
                bed_profile=np.zeros((0, 4)),
            )
        bed, heavier = self.bed, np.maximum(1.0, weight / np.where(line_weight > 0, line_weight, np.inf))
        k = bed.stiffness * area * heavier
        least = 1e-3 * self._each(lambda s: s.diameter).min()
        return dict(
            bed_stiffness=k,
            bed_damping=bed.damping * area * heavier,
            bed_thickness=np.maximum(2 * weight * bed.normal[2] / k, least),
            bed_normal=bed.normal,
            bed_level=float(bed.normal @ (np.array(self.anchor) - [0.0, 0.0, bed.below])),
            bed_friction=float(bed.friction),
            bed_slip=float(self._slip if bed.slip is None else bed.slip),
            bed_course=np.array([*self.anchor[:2], np.cos(bed.uphill), np.sin(bed.uphill)]),
            bed_profile=bed.profile(self.anchor[2]),
        )

    @property
    def _slip(self):
        """m, STUCK times the least stretch of an element by the friction on its own length"""
        stretch = [self.bed.friction * s.weight * s.size**2 / s.stiffness for s in self.segments if s.weight > 0]
        return max(STUCK * min(stretch, default=0.0), LEAST_SLIP)

    @property
    def bends(self):
        """Whether any part of the line has bending stiffness"""
        return any(s.bending_stiffness > 0 for s in self.segments)

    def _flexure(self):
        """Bending stiffness of the nodes between two elements that have one, N m; shape (N + 1,), or (0,) without
        any"""
        if not self.bends:
            return np.zeros(0)
        EI = self._each(lambda s: s.bending_stiffness)
        soft = 0.5 * np.divide(self._each(lambda s: s.size), EI, out=np.full(len(EI), np.inf), where=EI > 0)
        return np.concatenate([[0.0], 1 / (soft[:-1] + soft[1:]), [0.0]])

    def _elongation(self):
        """First and last row of each element's material among the rows of all elements, and these rows"""
        tables = [s.elongation for s in self.segments]
        ends = np.cumsum([0, *(len(table) for table in tables)])
        rows = [np.full((s.elements, 2), ends[i : i + 2]) for i, s in enumerate(self.segments)]
        return np.concatenate(rows), np.concatenate(tables)

    def _each(self, value):
        """Value of a property for each element, of its segment; shape (N,)"""
        return np.concatenate([np.full(s.elements, value(s), float) for s in self.segments])

    def _bodies(self):
        found = {name: np.zeros(self.elements + 1) for name in ("mass", "displaced", "radius", "drag", "added")}
        at = np.cumsum([s.elements for s in self.segments])[:-1]
        for node, body in zip(at, self.bodies, strict=True):
            if body is not None:
                found["mass"][node] = body.mass
                found["displaced"][node] = self.density * body.volume
                found["radius"][node] = (0.75 * body.volume / np.pi) ** (1 / 3)
                found["drag"][node] = 0.5 * self.density * body.drag_area
                found["added"][node] = body.added_mass * self.density * body.volume
        return found


def _to_nodes(half):
    """Sum of the halves on both sides of each node; shape (N + 1,)"""
    return np.concatenate([half, [0.0]]) + np.concatenate([[0.0], half])
