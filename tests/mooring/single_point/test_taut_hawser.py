"""A buoy at the end of a taut hawser, on lines that are made up: a spring that is stiffer one way, and with stretch."""

from types import SimpleNamespace

import numpy as np

from hakobune.mooring.single_point.body import SinglePoint

RNG = np.random.default_rng(1)


def lines(origin, stiffness, power):
    """F = −|S d|ᵖ S d of a buoy d off its place at rest, and its stiffness −∂F/∂d"""

    def pull(place):
        pulled = stiffness @ (place - origin)
        size = np.linalg.norm(pulled)
        K = size**power * stiffness + power * size ** (power - 2) * np.outer(pulled, stiffness @ pulled)
        return -(size**power) * pulled, K, None

    return SimpleNamespace(origin=origin, pull=pull)


def test_it_lies_where_its_lines_pull_along_the_hawser_away_from_the_body():
    """A hundred springs, from a guess anywhere: F × (buoy − bow) = 0, F · (buoy − bow) > 0, |buoy − bow| the length"""
    for _ in range(100):
        turn = RNG.uniform(0, 2 * np.pi)
        R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        origin, bow, length = RNG.normal(size=2) * 50, RNG.normal(size=2) * 80, RNG.uniform(5, 40)
        if np.hypot(*(bow - origin)) < 1.2 * length:  # it would be slack
            continue
        point = lines(origin, R @ np.diag([1.0, RNG.uniform(0.02, 0.2)]) @ R.T, RNG.choice([0.0, 1.0, 3.0]))
        buoy, F = SinglePoint._on_circle(point, bow, length, origin + RNG.normal(size=2) * 200)
        along = (buoy - bow) / np.hypot(*(buoy - bow))
        assert abs(along[0] * F[1] - along[1] * F[0]) < 1e-6 * np.hypot(*F)
        assert along @ F > 0 and abs(np.hypot(*(buoy - bow)) / length - 1) < 1e-6
