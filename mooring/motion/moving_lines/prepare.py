"""Lines of a System as lines with a motion of their own."""

from __future__ import annotations

import numpy as np

from hakobune.bem.modes import turned

from ...lines.dynamics.line import DynamicLine, DynamicSegment, ElasticBed
from ...lines.system.bodies import rotation
from ...lines.system.parts import Anchor, UniformLine
from .packed import moving_lines

# Pa/m and Pa s/m of the bed: ten times the usual, which lifts a chain in shallow water so far that it pulls 3e-3 less
# than its static shape
FIRM = {"stiffness": 3e6, "damping": 3e5}

# share of the tolerance of a run for a step of a line and for its pull on a wrongly predicted course.  Errors of smooth
# motion add up: steps with a whole tolerance each give three in a regular wave, these one
OF_LINE = 0.25


def moving_of(moored, settings, sea=None, surface=True):
    """(`MovingLines`, States at rest) of the lines in `settings.dynamic_lines`; None for none

    moored : `simulation.moored_body.Moored`; sea : `sea.LineSea`, None for still water
    surface : False for lines that count as submerged everywhere, as their static shapes do
    raises : ValueError with the name of a line that cannot move by itself, and the reason
    """
    system, names = moored.system, () if settings.dynamic_lines == "none" else settings.dynamic_lines
    if system is None or not names:
        if names:
            raise ValueError("dynamic_lines is given, but the body has no lines; leave it out")
        return None
    if moored.reader.modes:
        raise ValueError('dynamic_lines are given with bodies that bend; allowed: "auto", "none"')
    whole = [i for i, line in enumerate(system.lines) if isinstance(line, UniformLine)]
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
        raise ValueError("dynamic_lines: no line of the body is uniform, and only uniform lines can move")
    made, places, stretch, spring = {}, [], [], []
    headings = {one.name: one.position[5] for one in system.bodies}
    poses = {one.name: one.position + moored.start[6 * i : 6 * i + 6] for i, one in enumerate(system.bodies)}
    for i in numbers:
        line = system.lines[i]
        if i not in whole:
            raise ValueError(
                f"dynamic_lines: line {line.name} has segments or is a hawser; only uniform lines can move"
            )
        anchor, fairlead = ends_of(line, system)
        pose = poses[fairlead.body]
        R = rotation(*pose[3:])
        made[i] = dynamic_line(line, anchor.position, system, settings.dynamic_elements, surface)
        arm = R @ np.asarray(fairlead.position, float)
        places.append(pose[:3] + arm)
        along = places[-1] - np.asarray(anchor.position, float)
        along /= np.linalg.norm(along)
        stretch.append(turned(headings[fairlead.body]) @ np.concatenate([along, np.cross(arm, along)]))
        spring.append(line.type.axial_stiffness / line.length)
    as_spring = np.array(stretch), np.array(spring)
    return moving_lines(made, np.array(places), OF_LINE * settings.tolerance, as_spring, sea)


def ends_of(line, system):
    """(Anchor, Fairlead) of a line of a System"""
    ends = [point for name in (line.a, line.b) for point in system.points if point.name == name]
    return tuple(ends if isinstance(ends[0], Anchor) else ends[::-1])


def dynamic_line(line, anchor, system, elements, surface=True):
    """DynamicLine of a UniformLine, with its weight in air above the water.

    raises : ValueError for a property missing in its type
    """
    kind = line.type
    for name, value in (("mass", kind.mass), ("diameter", kind.diameter)):
        if value is None:
            raise ValueError(
                f"dynamic_lines: type {kind.name} of line {line.name} has no {name}; give a type with a "
                "catalogue name, which supplies it"
            )
    if not np.isfinite(kind.axial_stiffness):
        raise ValueError(f"dynamic_lines: type {kind.name} of line {line.name} is inextensible; give its stiffness")
    segment = DynamicSegment(
        line.length, kind.mass, kind.weight, kind.diameter, kind.axial_stiffness, elements, **_felt(kind.dynamics)
    )
    below = max(float(anchor[2]) + system.depth, 0.0)
    bed = ElasticBed(below=below, friction=line.bed_friction, **FIRM)
    return DynamicLine(segment, anchor, (), bed, system.density, system.gravity, surface)


def _felt(dynamics):
    """Keywords of a DynamicSegment with the values of a `LineDynamics`; none for None"""
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
