"""Equal bodies side by side in waves, with all reflections between them.

    s_u = F (H(β) e_u + H G Σ_v≠u W_uv s_v),      H_total(θ) = Σ_u H_u(θ) exp(−ik p_u·(cosθ, sinθ))

s_u are the strengths of the `Sources` of unit u, F fits strengths to a far field, and e_u is the incident wave at the
middle of unit u. W_uv gives the waves of the sources of unit v on the contour of unit u, and G fits plane waves to
these waves by least squares. H(β, θ) are the Kochin functions of one unit, moving on its lines, in these plane waves.
Evanescent waves from unit to unit are neglected.
"""

from typing import NamedTuple

import numpy as np

from .sources import FEWEST, PER_WAVE, Sources, contour, directions, incident, perimeter, regular_inverse, waves

ARRIVING = 1e-3  # singular value, over the largest, below which plane waves on the contour fade out


class Field(NamedTuple):
    """sources : `Sources` of one unit about its middle; middles : middles of the units, m, (u, 2)
    strengths : strengths for each incident direction, (b, u, s); beta : incident directions, rad, (b,)
    missed : share of H that the sources do not reproduce"""

    sources: Sources
    middles: np.ndarray
    strengths: np.ndarray
    beta: np.ndarray
    missed: float

    def elevation(self, places):
        """Complex elevation at places (p, 2), m, including the incident wave; shape (b, p); nan inside a body"""
        total = incident(self.sources.k, self.beta, places)
        for middle, strengths in zip(self.middles, self.strengths.swapaxes(0, 1), strict=True):
            total += self.sources.elevation(strengths, places - middle)
            total[:, self.sources.covers(places - middle)] = np.nan
        return total

    def far_field(self):
        """Kochin functions H of all units about the origin, in the directions of the sources; shape (b, t)"""
        away = np.exp(-1j * self.sources.k * (self.middles @ self.directions.T))
        return np.einsum("bus,ts,ut->bt", self.strengths, self.sources.sent, away)

    @property
    def directions(self):
        """Unit vectors of the directions of the sources' far field; shape (t, 2)"""
        step = 2 * np.pi / len(self.sources.sent)
        return directions(np.arange(len(self.sources.sent)) * step)


def row(count, pitch):
    """Middles of units along x, `pitch` m apart, about the origin; shape (u, 2)"""
    return np.stack([(np.arange(count) - (count - 1) / 2) * pitch, np.zeros(count)], axis=1)


def field(plan, k, theta, own, ring, of_ring, beta, middles):
    """`Field` of equal units.

    plan : (n, 2) m, convex, anticlockwise; k : rad/m; theta : (t,) rad, equally spaced from 0
    own : Kochin functions of a unit in the wanted waves towards beta (b,) rad, (b, t)
    ring : directions of plane waves, rad, (n,); of_ring : Kochin functions in these plane waves, (n, t), needed for
        more than one unit; middles : middles of the units, m, (u, 2)
    """
    sources = Sources(plan, k, theta)
    arriving = incident(k, beta, middles)
    single, missed = sources.strengths(own)
    first = arriving.T[:, :, None] * single
    if len(middles) == 1:
        return Field(sources, middles, first.swapaxes(0, 1), beta, missed)
    edge = contour(sources.plan, max(FEWEST, PER_WAVE * perimeter(sources.plan) * k / 2 / np.pi))
    answer = sources.of_far_field @ of_ring.T @ regular_inverse(incident(k, ring, edge).T, ARRIVING)
    units, s = len(middles), len(sources.points)
    matrix = np.eye(units * s, dtype=complex)
    for u in range(units):
        for v in range(units):
            if u != v:
                passed = waves(k, edge + middles[u] - middles[v], sources.points)
                matrix[u * s : (u + 1) * s, v * s : (v + 1) * s] = -answer @ passed
    solved = np.linalg.solve(matrix, first.transpose(0, 2, 1).reshape(units * s, -1))
    return Field(sources, middles, solved.reshape(units, s, -1).transpose(2, 0, 1), beta, missed)
