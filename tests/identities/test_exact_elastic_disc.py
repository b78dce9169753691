"""An elastic disc without draft in waves: panels in the water surface and the shapes of a free disc, beside
eigenfunctions."""

from dataclasses import dataclass

import numpy as np
import pytest
from exact.elastic_disc import deflection, free_shapes
from scipy.integrate import quad
from scipy.special import iv, jv

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import Mode
from hakobune.meshing.shapes import buoy

RADIUS, RIGIDITY, MASS, DEPTH, RHO, G = 10.0, 1e6, 100.0, 5.0, 1000.0, 9.81


@dataclass(frozen=True)
class Shape:
    """Upward cos nθ {Jₙ(lr) + C Iₙ(lr)}, 1 m at the edge"""

    n: int
    l: float
    C: float

    def radial(self, r):
        whole = jv(self.n, self.l * RADIUS) + self.C * iv(self.n, self.l * RADIUS)
        return (jv(self.n, self.l * r) + self.C * iv(self.n, self.l * r)) / whole

    def at(self, x, y):
        return self.radial(np.hypot(x, y)) * np.cos(self.n * np.arctan2(y, x))

    def displacement(self, points):
        x, y, _ = np.moveaxis(points, -1, 0)
        return np.stack([0 * x, 0 * x, self.at(x, y)], axis=-1)

    @property
    def square(self):
        """∬ w² dA, m²"""
        return quad(lambda r: self.radial(r) ** 2 * r, 0, RADIUS)[0] * np.pi * (2 if self.n == 0 else 1)


@pytest.mark.parametrize("omega", [1.0, 1.6])
def test_a_disc_rises_as_eigenfunctions_have_it(omega):
    shapes = [Shape(n, *one) for n, count in enumerate((2, 2, 2, 1, 1)) for one in free_shapes(RADIUS, n, count)]
    M, C = np.zeros((2, 14, 14))
    area, second = np.pi * RADIUS**2, np.pi * RADIUS**4 / 4
    M[range(6), range(6)] = MASS * np.array([area, area, area, second, second, 2 * second])
    C[[2, 3, 4], [2, 3, 4]] = RHO * G * np.array([area, second, second])
    places = np.array([(-10.0, 0.0), (0.0, 0.0), (10.0, 0.0), (5.0, 0.0), (0.0, 10.0)])
    for i, one in enumerate(shapes, 6):
        M[i, i], C[i, i] = MASS * one.square, (RIGIDITY * one.l**4 + RHO * G) * one.square
    modes = tuple(Mode(f"s{i}", shape=one) for i, one in enumerate(shapes))
    hull = buoy(RADIUS, 0.1, panels=200)
    problem = PanelProblem(hull, None, depth=DEPTH, density=RHO, gravity=G, zero_draft=True, modes=modes,
                           inertia_matrix=M, hydrostatic_stiffness=C)  # fmt: skip
    X = solve_frequency(problem.prepared(), omega, [0.0], {"rao"})["rao"][0]
    rise = X[2] - X[4] * places[:, 0] + sum(X[i] * one.at(*places.T) for i, one in enumerate(shapes, 6))
    known = deflection(RADIUS, RIGIDITY, MASS, DEPTH, omega, places, RHO, G)
    assert np.abs(rise) == pytest.approx(np.abs(known), rel=0.02)
    assert np.abs(rise - known).max() < 0.02 * np.abs(known).max()
