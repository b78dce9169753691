"""Lines lighter than water against heavy ones upside down, their own derivatives and the sea surface."""

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.buoyant import buoyant_profile, solve_buoyant_lines
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.state import LineError, State


def lines(count, seed):
    """x, height of the fairlead, length, weight, EA, surface; from floating slack to taut"""
    rng = np.random.default_rng(seed)
    length, lift = 10 ** rng.uniform(1, 3, count), 10 ** rng.uniform(0, 3, count)
    surface = length * rng.uniform(0.05, 0.5, count)
    z = surface * np.where(rng.random(count) < 0.5, 1.0, rng.uniform(0.2, 1.0, count))
    x = np.sqrt(length**2 - z**2) * rng.uniform(0.3, 0.999, count)
    return x, z, length, -lift, lift * length * 10 ** rng.uniform(1, 4, count), surface


def test_with_its_fairlead_in_the_surface_it_is_a_heavy_line_upside_down():
    x, _, length, weight, EA, surface = lines(200, 1)
    found = solve_buoyant_lines(x, surface, length, weight, EA, surface)
    heavy = solve_lines(x, surface, length, -weight, EA)
    scale = heavy.tension_fairlead
    assert {State.SLACK, State.GROUNDED, State.SUSPENDED} <= set(found.status.tolist())
    assert np.all(found.status == heavy.status)
    assert np.max(np.abs(found.horizontal_fairlead - heavy.horizontal_fairlead) / scale) < 1e-9
    assert np.max(np.abs(found.vertical_anchor - heavy.vertical_fairlead) / scale) < 1e-9
    assert np.max(np.abs(found.vertical_fairlead - heavy.vertical_anchor) / scale) < 1e-9


def test_what_it_lifts_is_its_buoyancy_under_water():
    x, z, length, weight, EA, surface = lines(300, 2)
    found = solve_buoyant_lines(x, z, length, weight, EA, surface)
    under = length - found.grounded_length
    lift = found.vertical_anchor - found.vertical_fairlead
    assert np.max(np.abs(lift + weight * under) / found.tension_anchor) < 1e-9


def test_it_joins_its_ends_below_the_surface_and_its_stiffness_is_the_derivative_of_its_forces():
    for x, z, length, weight, EA, surface in zip(*lines(40, 3), strict=True):
        points = buoyant_profile(x, z, length, weight, EA, surface, points=301)
        assert np.abs(points[[0, -1]] - [[0, 0], [x, z]]).max() < 1e-9 * length
        assert points[:, 1].max() < surface + 1e-9 * length
        h = 1e-5 * length
        if z + h > surface:
            continue
        ends = np.array([[x + h, z], [x - h, z], [x, z + h], [x, z - h], [x, z]]).T
        found = solve_buoyant_lines(*ends, length, weight, EA, surface)
        F = np.stack([found.horizontal_fairlead, found.vertical_fairlead])
        differences = np.column_stack([F[:, 0] - F[:, 1], F[:, 2] - F[:, 3]]) / (2 * h)
        if np.ptp(found.status) == 0:
            assert np.abs(differences - found.stiffness[4]).max() < 1e-3 * np.abs(found.stiffness[4]).max()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ((10, 5, 30, 2.0, 1e6, 5), "weight is 2; allowed: finite and below 0"),
        ((10, 6, 30, -2.0, 1e6, 5), "z is 6; allowed: at most the height of the surface"),
        ((40, 5, 30, -2.0, np.inf, 5), "cannot be reached by an inextensible line of 30 m"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(given, message):
    with pytest.raises((ValueError, LineError), match=message):
        solve_buoyant_lines(*given)
