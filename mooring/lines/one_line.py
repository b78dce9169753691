"""One uniform line between an anchor and a fairlead: its forces, its shape, and its pull from slack to taut.

The line lies on a bed, which is level or a plane. A line lighter than water floats in the sea surface instead.
The kernels run as plain Python, which takes less time for one line than importing numba.
"""

from dataclasses import dataclass

import numpy as np

from hakobune.bem.kernels.jit import as_python

STATES = ("slack", "partly on the bed", "clear of the bed", "beyond reach")
FLOATING_STATES = ("slack, the rest floats", "partly in the sea surface", "under water", "beyond reach")
NEAR_SHORE = 1e-3  # how near curves go to where the bed is as high as the fairlead, over the distance to it


@dataclass(frozen=True)
class OneLine:
    """A line and its place, SI; type : LineType; height, depth : heights of fairlead and sea surface above the
    anchor, m
    slope : slope of the bed, rad
    """

    type: object
    length: float
    height: float
    depth: float
    friction: float
    slope: float

    @property
    def floats(self):
        """Whether the line is lighter than water, so that the sea surface acts as its bed"""
        return self.type.weight < 0

    @property
    def properties(self):
        last = (self.depth,) if self.floats else (self.friction, self.slope)
        return self.length, self.type.weight, self.type.axial_stiffness, *last

    @as_python()
    def solve(self, span):
        """LineSolution at spans, m"""
        from .catenary.buoyant import solve_buoyant_lines
        from .catenary.solve import solve_lines

        return (solve_buoyant_lines if self.floats else solve_lines)(span, self.height, *self.properties)

    @as_python()
    def span_at(self, H):
        """Span, m, at which the line has a given horizontal tension, N"""
        from .catenary.solve import span_at_tension
        from .multi_segment.span import span_of

        if self.floats:
            return span_of(self.solve, H, self.length, self.height)
        return float(span_at_tension(H, self.height, *self.properties)[0])

    @as_python()
    def shape(self, span, points):
        """Shape of the line in its plane, m from the anchor; shape (points, 2)"""
        from .catenary.buoyant import buoyant_profile
        from .catenary.solve import profile

        return (buoyant_profile if self.floats else profile)(span, self.height, *self.properties, points=points)

    def state(self, found):
        """State of the line, in words"""
        return (FLOATING_STATES if self.floats else STATES)[int(found.status)]


def tension_curve(one, points=120, span=0.0):
    """Spans (m,), m, from slack to the breaking load, to a taut line, or to `span`, m; and the LineSolution at these
    spans

    No span is negative or leads to a place where the bed would be above the fairlead.
    """
    weight = abs(one.type.weight)
    top = 0.8 * one.type.breaking_load if np.isfinite(one.type.breaking_load) else 20 * weight * one.length
    least = 1e-3 * weight * max(abs(one.height), 0.01 * one.length)
    shore = np.inf if one.slope == 0 else one.height / np.tan(one.slope)  # where the bed reaches the fairlead's height
    ends = [_span_over_bed(one, H, shore) for H in (least, top)]
    ends[1] = max(ends[1], span)
    reach = np.sqrt(max(one.length**2 - one.height**2, 0.0))
    # tension climbs steeply at the end: half of the points lie in the last tenth
    share = np.concatenate(
        [np.linspace(0, 0.9, points // 2, endpoint=False), np.linspace(0.9, 1, points - points // 2)]
    )
    spans = ends[0] + share * (ends[1] - ends[0])
    if np.isinf(one.type.axial_stiffness):
        spans = spans[spans < reach * (1 - 1e-9)] if one.slope == 0 else spans
    return spans, one.solve(spans)


def _span_over_bed(one, H, shore):
    """m, at least 0, with a horizontal tension, N, or just before `shore`, where the bed is as high as the fairlead"""
    from .catenary.state import LineError

    try:
        span = max(one.span_at(H), 0.0)
    except LineError:
        span = shore
    if one.slope == 0:
        return span
    return min(span, (1 - NEAR_SHORE) * shore) if one.slope > 0 else max(span, (1 + NEAR_SHORE) * shore)
