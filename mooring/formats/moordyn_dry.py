"""Lines of a MoorDyn file out of the water: parts above the surface have their weight in air.

A line that cannot reach the water gets a type with its weight in air. If its length is L and its ends are at z_a and
z_b, none of its points is lower than (z_a + z_b − L)/2.
A free point at one end is at most L below the other end.  Other lines with an end above the water have their weight in
air for the parts above the water (`mooring.lines.system.surfacing`). Lines that float or have a table of stiffness
keep their weight in water above the water too; a warning reports this.
"""

from dataclasses import replace

import numpy as np

from ..lines.system.bodies import rotation
from ..lines.system.parts import Anchor, Fairlead, UniformLine

STILL = 1e-6  # N/m: weight of a line of zero weight in water, since the solver needs one
OUT = 1e-6  # m: height above the water from which an end counts as out of it
DIPS = 1e-3  # part of the length that may enter the water while a line still counts as dry


def in_air(lines, points, bodies, water):
    """The lines, where lines that cannot reach the water have a type with the weight in air; and the names of these
    dry lines
    """
    lowest = _lowest(lines, points, bodies)
    dry = [_is_dry(line, lowest) for line in lines] if water.density > 0 else [False] * len(lines)
    wet = {line.type.name for line, out in zip(lines, dry, strict=True) if not out and isinstance(line, UniformLine)}
    made = [
        replace(line, type=_aired(line.type, wet, water)) if out else line for line, out in zip(lines, dry, strict=True)
    ]
    return made, [line.name for line, out in zip(lines, dry, strict=True) if out]


def _is_dry(line, lowest):
    ends = lowest[line.a], lowest[line.b]
    return isinstance(line, UniformLine) and min(*ends, 0.5 * (sum(ends) - line.length)) >= -DIPS * line.length


def _aired(kind, wet, water):
    name = f"{kind.name} in air" if kind.name in wet else kind.name
    return replace(kind, name=name, weight=kind.mass * water.gravity or kind.weight)


def heights(points, bodies):
    """{name: m} of all points as given"""
    turned = {body.name: (body.position[2], rotation(*body.position[3:])) for body in bodies}
    found = {}
    for point in points:
        z, turn = turned[point.body] if isinstance(point, Fairlead) else (0.0, np.eye(3))
        found[point.name] = float(z + turn[2] @ point.position)
    return found


def _lowest(lines, points, bodies):
    """{name: m} lowest possible height of each point; −inf where a free body or a chain of free points carries it"""
    given, moves = heights(points, bodies), {body.name for body in bodies if body.freedom}
    held = {
        point.name
        for point in points
        if isinstance(point, Anchor) or (isinstance(point, Fairlead) and point.body not in moves)
    }
    found = {name: z if name in held else -np.inf for name, z in given.items()}
    for line in lines:
        for end, other in ((line.a, line.b), (line.b, line.a)):
            if end not in held and other in held:
                found[end] = max(found[end], given[other] - line.length)
    return found


def weighed_differently(system):
    """Names of lines that, unlike in MoorDyn, have their weight in water also above the surface"""
    above = heights(system.points, system.bodies) if system.density > 0 else {}
    high = {name for name, z in above.items() if z > OUT}
    return [
        line.name
        for line in system.lines
        if {line.a, line.b} & high
        and line.weight_in_air is None
        and line.type.mass is not None
        and not np.isclose(line.type.weight, line.type.mass * system.gravity)
    ]


def out_of_water(lines, points, bodies, dry, water):
    """The lines, and a message. A line with a given end above the water has its weight in air above the water; the
    message names lines for which this is not possible.

    dry : names of the dry lines from `in_air`
    """
    high = {name for name, z in heights(points, bodies).items() if z > OUT} if water.density > 0 else set()
    made, left = [], []
    for line in lines:
        if line.name in dry or not {line.a, line.b} & high:
            made.append(line)
        elif isinstance(line, UniformLine) and line.type.weight > STILL:
            made.append(replace(line, weight_in_air=line.type.mass * water.gravity))
        else:
            made.append(line)
            left.append(line.name)
    what = f"line {', '.join(left)} leaves the water; its part in the air also has its weight in water here"
    return made, [what] if left else []
