"""Where a body at a single point lies, and the small motions about it."""

import csv
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest
from bench.single_point import difference_in_time, missed
from boxes import TONF, buoy, floater_A

from hakobune.mooring.single_point import equilibria as room
from hakobune.mooring.single_point.body import SinglePoint, SinglePointError
from hakobune.mooring.single_point.criterion import roots
from hakobune.mooring.single_point.equilibria import Equilibrium, equilibria
from hakobune.mooring.single_point.loads import Loads
from hakobune.mooring.single_point.rings import zeros
from hakobune.mooring.single_point.slewing import at_rest_state, rates

SERIES = Path(__file__).parents[3] / "pipelines" / "validation" / "series" / "single_point.csv"


def series():
    lines = [line for line in SERIES.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def test_no_heading_of_rest_is_missed():
    """Sixty of the ten thousand loads of tests/bench/single_point.py"""
    assert sum(missed(seed)[1] for seed in range(60)) == 0


@pytest.mark.parametrize("linear", [None, np.array([[2e4, 0, 0], [0, 9e4, 3e5], [0, -4e5, 8e7]])])
def test_a_body_at_rest_in_a_current_feels_the_loads_of_one_that_moves_through_still_water(linear):
    point = floater_A(current_deg=40.0)
    loads = replace(point.loads, water=replace(point.loads.water, linear=linear))
    for heading in (-2.0, 0.3, 1.1):
        moving = loads.moving(heading, at_rest_state(point, (0.0, 0.0), heading)[3:])
        assert loads.at_rest(np.array([heading]))[0] == pytest.approx(moving, rel=1e-12)


def test_zeros_that_nearly_touch_are_both_found():
    for depth in (1e-3, 1e-6, 1e-9):
        found = zeros(lambda a, depth=depth: 1 - depth + np.cos(3 * a))
        assert len(found) == 6
        assert np.allclose(1 - depth + np.cos(3 * found), 0, atol=1e-12)
    assert len(zeros(lambda a: 1.0 + 1e-9 + np.cos(a))) == 0


def test_growth_and_period_in_time_are_those_of_the_quartic():
    """Six of the two hundred systems of tests/bench/single_point.py"""
    assert max(difference_in_time(seed) for seed in range(6)) < 1e-4


@pytest.mark.parametrize("hawser", [0.0, 25.0])
@pytest.mark.parametrize("current", [0.0, 60.0, 120.0])
def test_a_body_at_an_equilibrium_does_not_move(current, hawser):
    found = equilibria(floater_A(current, hawser))
    assert any(one.slewing.stable for one in found) and len(found) >= 2
    for one in found:
        rate, held = rates(one.point, one.state)
        assert np.abs(rate[:3]).max() < 1e-12
        assert np.abs(rate[3:5]).max() < 1e-9 * one.pull / one.point.mass[0, 0]
        assert np.hypot(*(held.buoy - one.buoy)) < 1e-7


@pytest.mark.parametrize("hawser", [0.0, 25.0, 100.0])
def test_the_quartic_has_the_eigenvalues_of_the_linearised_motion(hawser):
    for one in equilibria(floater_A(0.0, hawser)):
        if one.quartic is not None:
            for root in roots(one.quartic):
                assert np.abs(one.roots - root).min() < 1e-8 * abs(root)


@pytest.mark.filterwarnings("error")
def test_a_body_held_at_its_centre_of_mass_has_no_quartic():
    point = replace(floater_A(), ends=np.zeros((1, 2)), lengths=np.zeros(1))
    assert all(one.lateral is None and one.quartic is None for one in equilibria(point))


def test_two_hawsers_that_meet_at_a_point_hold_as_one_there():
    """A bridle under a load from ahead is rigid: heading and pull are those of a contact buoy at its apex"""
    point = floater_A(30.0)
    bridle = replace(point, ends=[(50.0, 5.0), (50.0, -5.0)], lengths=[25.0, 25.0])
    stiff = replace(point, ends=[bridle.apex], lengths=[0.0])
    one, other = (next(e for e in equilibria(p) if e.slewing.stable) for p in (bridle, stiff))
    assert one.heading == pytest.approx(other.heading, abs=1e-12) and np.all(one.hawser > 0)
    assert np.allclose(one.place, other.place, atol=1e-9)
    assert np.allclose(np.sort(one.roots.real), np.sort(other.roots.real), atol=1e-9)


@pytest.mark.parametrize("ends, lengths", [
    ([(50.0, 0.0)], [0.0]), ([(50.0, 0.0)], [25.0]), ([(50.0, 5.0), (50.0, -5.0)], [25.0, 25.0]),
    ([(50.0, 20.0), (50.0, -20.0)], [150.0, 150.0]),
])  # fmt: skip
def test_the_stiffness_of_a_mooring_is_the_derivative_of_its_force(ends, lengths):
    """A contact buoy, a hawser, a bridle of which both legs are taut, and one of which the lee leg is slack"""
    for one in equilibria(replace(floater_A(90.0), ends=ends, lengths=lengths)):
        differences = np.empty((3, 3))
        for j, step in enumerate(np.diag([1e-3, 1e-3, 1e-5])):
            ahead, behind = (one.point.hold(one.place + k * step[:2], one.heading + k * step[2], one.buoy).force
                             for k in (1, -1))  # fmt: skip
            differences[:, j] = (behind - ahead) / (2 * step[j])
        held = one.point.hold(one.place, one.heading, one.buoy)
        error = np.abs(one.point.stiffness(one.heading, held) - differences).max()
        assert error < 1e-5 * np.abs(differences).max()


def test_of_two_hawsers_the_lee_one_falls_slack_under_a_load_from_the_side():
    point = floater_A(90.0)
    bridle = replace(point, ends=[(50.0, 20.0), (50.0, -20.0)], lengths=[150.0, 150.0])
    found = [one for one in equilibria(bridle) if one.slewing.stable]
    assert len(found) == 1 and np.sum(found[0].hawser > 0) in (1, 2)
    held = bridle.hold(found[0].place, found[0].heading)
    assert np.allclose(held.tension, found[0].hawser, rtol=1e-7, atol=1.0)


def test_the_same_load_needs_no_more_force_with_other_lines():
    """Pairs of the series with equal loads and other pretension or number of lines: the pull does not know of them"""
    few, many = floater_A(), replace(floater_A(), system=buoy(tension=5 * TONF))
    assert equilibria(few)[0].pull == pytest.approx(equilibria(many)[0].pull, rel=1e-12)


def test_a_body_that_nothing_pulls_has_no_heading():
    point = floater_A(wind=0.0, height=0.0, knots=0.0)
    with pytest.raises(SinglePointError, match="no force"):
        equilibria(replace(point, loads=Loads(point.loads.water)))


def test_hawsers_that_do_not_meet_are_refused():
    point = floater_A()
    with pytest.raises(SinglePointError, match="do not meet"):
        SinglePoint(point.loads, point.mass, [(50, 20), (50, -20)], [10, 10], point.system)


def test_the_line_yields_across_the_body_as_far_as_its_buoy_gives_way_there():
    """F over the stiffness of the buoy along (−sin ψ, cos ψ), beside the hawser: 25 + 1e5/k with k of a buoy that is
    stiff along x + y and soft across, 1/k = n·C⁻¹n"""
    along, across = 4e5, 1e5
    turn = np.array([[1.0, -1.0], [1.0, 1.0]]) / np.sqrt(2)
    stiffness = turn @ np.diag([along, across]) @ turn.T
    for heading, yields in ((np.pi / 4, 1 / across), (-np.pi / 4, 1 / along), (0.0, 0.5 / along + 0.5 / across)):
        point = SimpleNamespace(mass=np.diag([1e7, 1.5e7, 1e10]), apex=np.array([40.0, 0.0]), lengths=[25.0], ends=[0],
                                pull=lambda _: SimpleNamespace(stiffness=stiffness))  # fmt: skip
        one = SimpleNamespace(point=point, force=(-1e5, 0.0, 0.0), pull=1e5, heading=heading, buoy=None)
        with mock.patch.object(room, "_derivatives", lambda *_: [0.0] * 6):
            made = Equilibrium.lateral.func(one)
        assert made.length == pytest.approx(25.0 + 1e5 * yields)
        assert (made.mass, made.inertia, made.pull, made.arm) == (1.5e7, 1e10, 1e5, 40.0)
        for force in ((1e5, 0.0, 0.0), (-1e5, 2e3, 0.0), (-1e5, 0.0, 2e5)):  # from behind, or not straight ahead
            assert Equilibrium.lateral.func(SimpleNamespace(**{**vars(one), "force": force})) is None
