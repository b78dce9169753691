"""A System of bodies from their mooring legs, each a line from an anchor to a fairlead, and the layout of a spread."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import as_python

from ..catenary.buoyant import solve_buoyant_lines
from ..catenary.solve import span_at_tension
from ..multi_segment.span import span_of
from .bodies import rotation
from .composite import of_line, solution
from .graph import System
from .hawser import Hawser
from .parts import Anchor, CompositeLine, Fairlead, LineSystemError, MooredBody, UniformLine


class Leg(NamedTuple):
    """A line from its anchor (end a) to its fairlead (end b), and the attachments with the body at rest.

    anchor, fairlead : (3,) m in space
    body : name of the body with the fairlead, where there are several; to : name of the body at end a, "" for none
    """

    line: UniformLine | CompositeLine | Hawser
    anchor: tuple[float, float, float]
    fairlead: tuple[float, float, float]
    body: str = ""
    to: str = ""


def moored_body(legs, depth, center=(0.0, 0.0, 0.0), density=1025.0, gravity=9.80665, name="body"):
    """The System of one body on its legs; it moves in the plane, and the origin of its axes is at `center` (3,) m."""
    points, lines = [], []
    for line, anchor, fairlead, *_ in legs:
        ends = f"{line.name} anchor", f"{line.name} fairlead"
        arm = tuple(float(f - c) for f, c in zip(fairlead, center, strict=True))
        points += [Anchor(ends[0], tuple(map(float, anchor))), Fairlead(ends[1], name, arm)]
        lines.append(replace(line, a=ends[0], b=ends[1]))
    body = MooredBody(name, (*map(float, center), 0.0, 0.0, 0.0))
    return System(depth, lines, points, (body,), density, gravity)


def moored_bodies(legs, bodies, depth, density=1025.0, gravity=9.80665):
    """The System of several bodies that move in the plane, on legs to anchors, to fixed bodies and to each other.

    bodies : {name of a moving body: (origin of its axes (3,) m, heading rad)}
    """
    points, lines = [], []
    for line, anchor, fairlead, body, to in legs:
        ends = f"{line.name} anchor", f"{line.name} fairlead"
        for end, place, of in zip(ends, (anchor, fairlead), (to, body), strict=True):
            if of in bodies:
                center, heading = bodies[of]
                arm = (np.asarray(place, float) - center) @ rotation(0.0, 0.0, heading)
                points.append(Fairlead(end, of, tuple(map(float, arm))))
            else:
                points.append(Anchor(end, tuple(map(float, place))))
        lines.append(replace(line, a=ends[0], b=ends[1]))
    made = [MooredBody(name, (*map(float, c), 0.0, 0.0, float(heading))) for name, (c, heading) in bodies.items()]
    return System(depth, lines, points, tuple(made), density, gravity)


def leg_at_tension(line, fairlead, heading, depth, horizontal_tension):
    """A Leg with its anchor on the bed where the line pulls the body at rest with a given horizontal tension.

    fairlead : (3,) m; heading : rad, from the fairlead to the anchor; depth : m; horizontal_tension : N.
    A multi-segment line counts from the anchor. raises : LineSystemError if no span gives this tension
    """
    try:
        span = _span(line, fairlead[2] + depth, depth, horizontal_tension)
    except ValueError as error:
        raise LineSystemError(f"line {line.name}: {error}") from None
    x, y = fairlead[0] + span * np.cos(heading), fairlead[1] + span * np.sin(heading)
    return Leg(line, (float(x), float(y), -float(depth)), tuple(map(float, fairlead)))


def _span(line, height, depth, horizontal_tension):
    """m, where a line pulls a fairlead `height` m above its anchor with a horizontal tension, N; raises ValueError"""
    if isinstance(line, CompositeLine):
        one = of_line(line, 0, "a", -depth)
        return span_of(lambda x: solution(one, (0, 0, 0), (x, 0, height)), horizontal_tension, line.length, height)
    properties = line.length, line.type.weight, line.type.axial_stiffness
    if line.type.weight < 0:
        return span_of(
            lambda x: solve_buoyant_lines(x, height, *properties, depth), horizontal_tension, line.length, height
        )
    with as_python():
        return float(span_at_tension(horizontal_tension, height, *properties, line.bed_friction)[0])


def corner_legs(line, hull_length, beam, headings, depth, horizontal_tension, z=0.0, is_round=False):
    """Legs from the four corners of a box at mirrored headings, named by corner and number: "fore port 1", …

    headings : headings from the x axis for the corner at +x, +y, rad, 0 to π/2; z : height of the fairleads, m
    is_round : whether the body is a cylinder of this beam, whose lines leave the rim along their own radii
    """
    legs = []
    for end, sx in (("fore", 1), ("aft", -1)):
        for side, sy in (("port", 1), ("starboard", -1)):
            for number, angle in enumerate(headings, 1):
                heading = np.arctan2(sy * np.sin(angle), sx * np.cos(angle))
                out = (np.cos(heading), np.sin(heading)) if is_round else (sx, sy)
                fairlead = (float(0.5 * out[0] * hull_length), float(0.5 * out[1] * beam), z)
                named = replace(line, name=f"{end} {side} {number}")
                legs.append(leg_at_tension(named, fairlead, heading, depth, horizontal_tension))
    return legs
