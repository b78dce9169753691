"""Contour nodes and Neumann-to-Dirichlet maps of the plan of a vertical-sided body, for each depth mode."""

from typing import NamedTuple

import numpy as np

CLASSES = ((1, 1), (-1, 1), (1, -1), (-1, -1))


class Contour(NamedTuple):
    """Nodes (m,) on the quarter x > 0, y > 0 of a contour, with the outward normal and the length of contour of each
    node."""

    x: np.ndarray  # m
    y: np.ndarray  # m
    nx: np.ndarray
    ny: np.ndarray
    weights: np.ndarray  # m


class WaveMap(NamedTuple):
    """Map and plane waves outside one plan, in one symmetry class of n functions ψ."""

    weak: np.ndarray  # (n, n) complex, m: ∮ ψᵢ N ψⱼ ds, N from ∂φ/∂n to φ
    potential: np.ndarray  # (m, n) complex, m: N ψⱼ at the nodes
    wall: np.ndarray  # (m, b) complex: the waves exp(ik(x cosβ + y sinβ)) in front of a rigid wall, at the nodes
    projected: np.ndarray  # (n, b) complex, √m: ∮ ψᵢ wall ds
    basis: np.ndarray  # (m, n) ψⱼ at the nodes

    @classmethod
    def solved(cls, contour, basis, potential, wall):
        """The WaveMap of potentials at the nodes (m,) of a contour; basis : functions ψ at these nodes, (m, n)"""
        weak = 4 * (basis * contour.weights[:, None]).T
        return cls(weak @ potential, potential, wall, weak @ wall, basis)


# phase, rad, from the axis to the farther side: waves longer than 0.4 of the length, most scenes, share one table;
# shorter ones share tables whose wavenumbers differ by the factor RATIO.  Six frequencies of 100 × 50 × 10 m made four
# or five tables in two thirds of their time; one table for all would take as long as the two smallest of them
TURNS, RATIO = 8.0, 1.5


def table_wavenumber(waves, half):
    """Wavenumber that a shared table resolves, rad/m, at least `waves`; half : distance from the axis to the farther
    side, m"""
    steps = np.ceil(np.log(max(waves * half / TURNS, 1.0)) / np.log(RATIO))
    return max(waves, TURNS / half * RATIO**steps)


def area_moment(contour, a, b):
    """∬ xᵃ yᵇ dA over the whole plan for even a and b, m^(2+a+b)"""
    c = contour
    return 4 * np.sum(c.weights * c.nx * c.x ** (a + 1) * c.y**b) / (a + 1)
