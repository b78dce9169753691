"""A buoy as a body of its own between its lines and the hawsers of a floater."""

from dataclasses import replace

import numpy as np
import pytest
from boxes import RHO, floater_A

from mooring.lines.ropes import RopePart
from mooring.lines.system.parts import MooredBody
from mooring.single_point.body import SinglePointError
from mooring.single_point.buoy_equation import pull_of_rope
from mooring.single_point.buoy_run import BuoyBody, run_with_buoy
from mooring.single_point.equilibria import equilibria
from mooring.single_point.slewing import slew, turned_state

BUOY, ROPE = BuoyBody(150e3, 8.0, 5.0), RopePart(2e7, 1.0)


def floating_point(hawser=25.0, current=30.0):
    point = floater_A(current, hawser)
    body = point.system.bodies[0]
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = RHO * point.system.gravity * 0.25 * np.pi * BUOY.diameter**2
    freed = MooredBody("buoy", body.position, ("Surge", "Sway", "Heave"), stiffness)
    return replace(point, system=replace(point.system, bodies=(freed,)))


@pytest.fixture(scope="module")
def steady():
    return next(one for one in equilibria(floating_point()) if one.slewing.stable)


def pulled_out(steady, rope, turn=0.0):
    """State beside an Equilibrium from which the hawser is as long as its pull makes it"""
    start = turned_state(steady.point, steady.state, turn)
    bow = steady.place + 50.0 * np.array([np.cos(steady.heading), np.sin(steady.heading)])
    away = (bow - steady.buoy) / np.hypot(*(bow - steady.buoy))
    start[:2] += 25.0 * steady.hawser[0] / rope.breaking_load * away
    return start


def test_at_rest_the_body_stays_and_pulls_as_in_statics(steady):
    found = run_with_buoy(steady.point, BUOY, ROPE, pulled_out(steady, ROPE), steady.buoy, 60.0, 0.5)
    assert np.allclose(found.hawser, steady.hawser, rtol=1e-3)
    assert np.allclose(found.lines, steady.lines.lines.tension_b, rtol=1e-3)
    assert np.abs(np.degrees(found.heading - steady.heading)).max() < 0.01


def test_a_light_buoy_on_a_stiff_hawser_moves_as_one_without_mass(steady):
    light, rope = replace(BUOY, mass=3e3, drag=(0.0, 0.0), added=(0.0, 0.0)), RopePart(2e8, 1.0)
    slow = slew(steady.point, turned_state(steady.point, steady.state, np.radians(4)), 200.0, 1.0, tolerance=1e-7)
    start = pulled_out(steady, rope, np.radians(4))
    found = run_with_buoy(steady.point, light, rope, start, slow.buoy[0], 200.0, 1.0)
    assert np.abs(np.degrees(found.heading - slow.heading)).max() < 0.05
    assert np.abs(found.buoy[:, :2] - slow.buoy).max() < 0.03


def test_the_steps_converge_at_fourth_order_while_the_hawser_is_taut(steady):
    """The buoy let go half a metre aside"""
    rope, ends, aside = RopePart(2e6, 1.0), [], steady.buoy + np.array([0.0, 0.5])
    for sample in (0.2, 0.1, 0.05):
        found = run_with_buoy(steady.point, BUOY, rope, pulled_out(steady, rope), aside, 10.0, sample)
        assert found.step == pytest.approx(sample) and found.hawser[1:].min() > 1e4
        ends.append(np.array([*found.place[-1], *found.buoy[-1]]))
    first, second = (np.abs(ends[i + 1] - ends[i]).max() for i in range(2))
    assert np.log2(first / second) > 3.0, (first, second)


def test_a_rope_hardens_slackens_and_never_pushes():
    rope = np.array([10.0, 1e6, 0.2, 2.0, 1e4])
    assert pull_of_rope(rope, -0.1, 5.0) == 0.0 and pull_of_rope(rope, 0.1, -100.0) == 0.0
    assert pull_of_rope(rope, 2.0, 0.0) == pytest.approx(1e6)
    assert pull_of_rope(rope, 1.0, 0.0) == pytest.approx(0.25e6)


def test_a_buoy_that_would_sink_and_a_contact_buoy_are_refused(steady):
    with pytest.raises(SinglePointError, match="floats at"):
        run_with_buoy(steady.point, replace(BUOY, mass=900e3), ROPE, steady.state, steady.buoy, 10.0, 1.0)
    with pytest.raises(SinglePointError, match="needs a hawser"):
        run_with_buoy(floater_A(), BUOY, ROPE, steady.state, steady.buoy, 10.0, 1.0)
