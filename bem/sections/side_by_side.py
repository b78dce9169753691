"""Fixed sections side by side in beam waves, and the water in their gaps, with or without damping.

Between long bodies the water oscillates vertically as one mass, most strongly in waves of its natural period.  In
potential flow only radiated waves damp this motion, and the computed rise is several times too high.
A damping ε of the gap's water replaces the effect of eddies; tests with sharp bilges give 0.02 to 0.07
(`bem.panels.damping_lid`).
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..waves import group_factor, wavenumber
from .any_section import PER_RADIAN, TOLERANCE, AnyFlow, shape
from .outline import Edge


class SideBySide(NamedTuple):
    """Results of one frequency in a wave towards +y.

    gains : amplitude of the mean rise of the water in each gap over the wave amplitude, (gaps,)
    reflection, transmission : complex, both referred to y = 0; taken : share of the wave energy absorbed by the gaps
    """

    omega: float
    gains: np.ndarray
    reflection: complex
    transmission: complex
    taken: float


def side_by_side(sections, depth, omega, damping=0.0, *, gravity=9.80665, tolerance=TOLERANCE):
    """`SideBySide` of fixed sections.

    sections : [(`Wetted`, y, m)], each moved by y, from left to right; depth : m; omega : rad/s; damping : ε of all
        gaps
    raises : ValueError for sections that touch or overlap, and for a tolerance that cannot be reached
    """
    flow = flow_of(sections, depth, omega, damping, gravity, tolerance)
    reflection, transmission = flow.scattered(+1)
    rise = in_gaps(flow)
    gains = np.abs([mean for mean, _ in rise])
    return SideBySide(omega, gains, reflection, transmission, taken_of(flow, depth, damping, rise))


def flow_of(sections, depth, omega, damping, gravity, tolerance, velocities=None):
    """`AnyFlow` of sections; arguments as in `side_by_side`

    velocities : function of points, normals and the index of the section of each point, (n,), that gives the
        velocities of m motions along the normals, (n, m); or None
    """
    if not (damping >= 0 and np.isfinite(damping)):
        raise ValueError(f"damping is {damping:g}; allowed: 0 or more")
    longest = PER_RADIAN / float(wavenumber(omega, depth, gravity))
    made = shape(_chain(sections), depth, float(2.0 ** np.floor(np.log2(longest))), tolerance)
    if velocities is None:
        return AnyFlow(made, omega, gravity, damping)
    p, n = made.points[made.body], made.normals[made.body]
    ends = [y + wetted.right for wetted, y in sections]
    owner = np.searchsorted([0.5 * (a + y + w.left) for a, (w, y) in zip(ends[:-1], sections[1:], strict=True)], p.real)
    return AnyFlow(made, omega, gravity, damping, velocities(p, n, owner))


def in_gaps(flow, speeds=None):
    """Mean rise of the water, complex, m per m, and ∫ |rise|² dy, m³ per m², in the wave towards +y; a list of pairs,
    one for each gap

    speeds : velocities of the motions, m/s …, (m,), or None
    """
    out, weights = [], flow.shape.weights[~flow.shape.body]
    for phi, gap in zip(flow.in_gaps, flow.shape.gaps, strict=True):
        whole = phi[:, 0] if speeds is None else phi[:, 0] + flow.moved_in_gaps[len(out)] @ speeds
        rise = flow.omega / flow.gravity * whole
        out.append((rise @ weights[gap] / weights[gap].sum(), float(np.abs(rise) ** 2 @ weights[gap])))
    return out


def taken_of(flow, depth, damping, rise):
    """Share of the wave energy absorbed by gaps; rise : result of `in_gaps`"""
    celerity = flow.omega / flow.k * float(group_factor(flow.k, depth))
    return float(damping * flow.omega / celerity * sum(square for _, square in rise))


def _chain(sections):
    """Edges of all sections, with those of the water between them"""
    moved = [[Edge(e.start + y, e.end + y, e.bulge) for e in wetted.edges] for wetted, y in sections]
    edges = list(moved[0])
    for one, after in pairwise(moved):
        start, end = one[-1].end, after[0].start
        if not start.real < end.real:
            raise ValueError(
                f"a section ends at y = {start.real:g} m, and the next begins at {end.real:g} m; "
                f"leave a gap between them"
            )
        edges += [Edge(start, end), *after]
    return tuple(edges)
