"""Fixed sections side by side in beam waves: the water in their gaps, with and without damping.

Between long bodies the water moves up and down as one, most where 2π/ω is its own period.  Potential flow alone has
nothing but waves that leave against it, and rises several times too high; a damping ε of the gap's water, 0.02 to 0.07
by tests with sharp bilges, takes the place of the eddies (`bem.panels.damping_lid`).
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..waves import group_factor, wavenumber
from .any_section import PER_RADIAN, TOLERANCE, AnyFlow, shape
from .outline import Edge


class SideBySide(NamedTuple):
    """Of one frequency in a wave towards +y.

    gains : (gaps,) amplitude of the mean rise of the water in each gap over that of the wave
    reflection, transmission : complex, both referred to y = 0; taken : of the wave's energy, by the gaps
    """

    omega: float
    gains: np.ndarray
    reflection: complex
    transmission: complex
    taken: float


def side_by_side(sections, depth, omega, damping=0.0, *, gravity=9.80665, tolerance=TOLERANCE):
    """`SideBySide` of fixed sections.

    sections : [(`Wetted`, y m)], each moved by y, from left to right; depth : m; omega : rad/s; damping : ε of all gaps
    raises : ValueError for sections that touch or pass each other, and what cannot be solved to the tolerance
    """
    if not (damping >= 0 and np.isfinite(damping)):
        raise ValueError(f"damping is {damping:g}; allowed: 0 or more")
    longest = PER_RADIAN / float(wavenumber(omega, depth, gravity))
    made = shape(_chain(sections), depth, float(2.0 ** np.floor(np.log2(longest))), tolerance)
    flow = AnyFlow(made, omega, gravity, damping)
    reflection, transmission = flow.scattered(+1)
    weights = made.weights[~made.body]
    rise = [omega / gravity * phi[:, 0] @ weights[gap] / weights[gap].sum()
            for phi, gap in zip(flow.in_gaps, made.gaps, strict=True)]  # fmt: skip
    lost = sum(np.abs(phi[:, 0]) ** 2 @ weights[gap] for phi, gap in zip(flow.in_gaps, made.gaps, strict=True))
    celerity = omega / flow.k * float(group_factor(flow.k, depth))
    taken = damping * omega**3 / gravity**2 / celerity * lost
    return SideBySide(omega, np.abs(rise), reflection, transmission, float(taken))


def _chain(sections):
    """Edges of all, with those of the water between"""
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
