"""Conversion of lines of a System, with segments, sinkers and buoys, to lines with their own equations of motion."""

import numpy as np

from hakobune.bem.modes import turned

from ...lines.dynamics.line import AttachedBody, DynamicLine, DynamicSegment, ElasticBed, felt
from ...lines.system.bodies import rotation
from ...lines.system.hawser import Hawser
from ...lines.system.parts import Anchor, UniformLine
from ..tables.groups import moved_by_shapes, with_bent_fairleads
from .packed import moving_lines

# Pa/m and Pa s/m of the bed: ten times the usual, which lifts a chain in shallow water so far that it pulls 3e-3 less
# than its static shape
FIRM = {"stiffness": 3e6, "damping": 3e5}

# share of the tolerance of a run for a step of a line and for its pull on a wrongly predicted course.  Errors of smooth
# motion add up: steps with a whole tolerance each give three in a regular wave, these one
OF_LINE = 0.25
LEAST = 4  # elements of a segment
ON_JOINT = 1e-6  # m


def moving_of(moored, settings, sea=None, surface=True):
    """Return (`MovingLines`, States at rest) of the lines in `settings.dynamic_lines`; None for none

    moored : `simulation.moored_body.Moored`; sea : `sea.LineSea`, None for still water
    surface : False for lines that count as submerged everywhere, as their static shapes do
    raises : ValueError with the name of a line that cannot move by itself, and the reason
    """
    system, names = moored.system, () if settings.dynamic_lines == "none" else settings.dynamic_lines
    if system is None or not names:
        if names:
            raise ValueError("dynamic_lines is given, but the body has no lines; leave it out")
        return None
    whole = [i for i, line in enumerate(system.lines) if not isinstance(line, Hawser)]
    if isinstance(names, str):
        if names != "all":
            raise ValueError(f'dynamic_lines is {names!r}; allowed: "all", "auto", "none", or a list of names')
        numbers = whole
    else:
        unknown = [name for name in names if name not in system.line_names]
        if unknown:
            raise ValueError(
                f"dynamic_lines: there is no line named {unknown[0]!r}; allowed: {', '.join(system.line_names)}"
            )
        numbers = sorted(system.line_names.index(name) for name in names)
    if not numbers:
        raise ValueError("dynamic_lines: all lines of the body are hawsers, which have no weight and cannot move")
    made, places, stretch, spring = {}, [], [], []
    bent = with_bent_fairleads(system, moored.reader, moored.start[moored.reader.rigid :])
    names, headings = [one.name for one in system.bodies], [one.position[5] for one in system.bodies]
    poses = [one.position + moored.start[6 * i : 6 * i + 6] for i, one in enumerate(system.bodies)]
    for i in numbers:
        line = system.lines[i]
        if i not in whole:
            raise ValueError(f"dynamic_lines: line {line.name} is a hawser, which has no weight and cannot move")
        anchor, fairlead = ends_of(line, bent)
        body = names.index(fairlead.body)
        R = rotation(*poses[body][3:])
        arm = R @ np.asarray(fairlead.position, float)
        places.append(poses[body][:3] + arm)
        along = places[-1] - np.asarray(anchor.position, float)
        elements = settings.dynamic_elements
        made[i] = dynamic_line(line, anchor.position, system, elements, surface, np.arctan2(along[1], along[0]))
        along /= np.linalg.norm(along)
        rigid = turned(headings[body]) @ np.concatenate([along, np.cross(arm, along)])
        (shapes,) = moved_by_shapes(moored.reader, body, ends_of(line, system)[1].position)
        stretch.append(np.append(rigid, shapes @ R.T @ along))
        first, *others = made[i].segments
        soft = sum(one.length / one.stiffness for one in others)
        spring.append(first.stiffness / (first.length + first.stiffness * soft))
    as_spring = np.array(stretch), np.array(spring)
    return moving_lines(made, np.array(places), OF_LINE * settings.tolerance, as_spring, sea)


def ends_of(line, system):
    """Return (Anchor, Fairlead) of a line of a System"""
    ends = [point for name in (line.a, line.b) for point in system.points if point.name == name]
    return tuple(ends if isinstance(ends[0], Anchor) else ends[::-1])


def dynamic_line(line, anchor, system, elements, surface=True, towards=0.0):
    """DynamicLine of a UniformLine or a CompositeLine, with its weight in air above the water.

    anchor : (3,) m; elements : number of elements of the whole line, at least LEAST for each segment
    towards : direction of the fairlead, rad, along which a bed of this line lies
    raises : ValueError for a property missing in its types
    """
    below, rest = max(float(anchor[2]) + system.depth, 0.0), (system.density, system.gravity, surface)
    if isinstance(line, UniformLine):
        bed = ElasticBed(below=below, friction=line.bed_friction, **FIRM)
        return DynamicLine(_segment(line.name, line.type, line.length, elements), anchor, (), bed, *rest)
    way = 1 if line.a == ends_of(line, system)[0].name else -1
    segments, joints = [], np.cumsum([one.length for one in line.segments[::way]])[:-1]
    for one in line.segments[::way]:
        if one.kind is None:
            raise ValueError(f"dynamic_lines: segment {one.name} of line {line.name} has no mass")
        own = one.elements or max(LEAST, round(elements * one.length / line.length))
        segments.append(_segment(line.name, one.kind, one.length, own, one.axial_stiffness))
    bodies = [None] * len(joints)
    for load in line.loads:
        at = load.position if way > 0 else line.length - load.position
        here = np.flatnonzero(np.abs(joints - at) < ON_JOINT)
        if not len(here) or bodies[here[0]] is not None:
            raise ValueError(
                f"dynamic_lines: line {line.name} has sinkers or buoys within a segment or two at one joint; "
                "allowed: one at each joint of two segments"
            )
        bodies[here[0]] = _attached(load, system)
    if line.bed is None:
        bed = ElasticBed(below=below, friction=line.bed_friction, **FIRM)
    else:
        bed = ElasticBed(uphill=float(towards), friction=line.bed.friction, points=line.bed.points, **FIRM)
    return DynamicLine(tuple(segments), anchor, tuple(bodies), bed, *rest)


def _attached(load, system):
    """AttachedBody of a PointLoad; one without a weight in air is a buoy or a sinker without mass"""
    volume = (load.weight_in_air - load.weight) / (system.density * system.gravity)
    return AttachedBody(load.weight_in_air / system.gravity, max(volume, 0.0), load.drag_area, load.added_mass)


def _segment(name, kind, length, elements, stiffness=None):
    """DynamicSegment of a LineType in line `name`; stiffness : EA, N, or a table, by default that of the type"""
    for key, value in (("mass", kind.mass), ("diameter", kind.diameter)):
        if value is None:
            raise ValueError(
                f"dynamic_lines: type {kind.name} of line {name} has no {key}; give a type with a "
                "catalogue name, which supplies it, or mass_kg_per_m and diameter"
            )
    stiffness = kind.axial_stiffness if stiffness is None else stiffness
    if np.ndim(stiffness) == 0 and not np.isfinite(stiffness):
        raise ValueError(f"dynamic_lines: type {kind.name} of line {name} is inextensible; give its stiffness")
    return DynamicSegment(length, kind.mass, kind.weight, kind.diameter, stiffness, elements, **felt(kind.dynamics))
