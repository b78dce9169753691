"""A dynamic line whose end a host moves step by step."""

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics.driven import DrivenLine
from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, FairleadMotion, simulate

CHAIN = DynamicLine(DynamicSegment(300.0, 114.94, 979.3, 0.1368, 4.933e8, 20), (-290.0, 0.0, -50.0))
SURGE = FairleadMotion.harmonic((0, 0, 0), (2j, 0, 0), 10.0)


def moved(driven, state, begin, end, dt):
    """State and Pulls of a host that moves the fairlead in steps of dt."""
    pulls = []
    for k in range(round(begin / dt), round(end / dt)):
        position, velocity, _ = SURGE.at((k + 1) * dt)
        state, pull = driven.advance(state, dt, position, velocity)
        pulls.append(pull)
    return state, pulls


def test_a_line_in_steps_of_its_host_pulls_as_in_one_run():
    driven = DrivenLine(CHAIN)
    whole = simulate(CHAIN, SURGE, 12.0, check_mesh=False, tolerance=1e-4)
    state, pulls = moved(driven, driven.rest((0, 0, 0)), 0.0, 12.0, 0.1)
    expected = np.interp(0.1 * np.arange(1, 121), whole.time, whole.tension_fairlead)
    assert np.isclose(state.time, 12.0)
    assert np.abs([p.tension for p in pulls] - expected).max() < 5e-3 * expected.max()
    assert np.isclose(sum(p.work for p in pulls), whole.energies.work[-1], rtol=0.01)


def test_a_step_taken_again_from_a_saved_state_is_the_same_to_the_bit():
    driven = DrivenLine(CHAIN)
    state, _ = moved(driven, driven.rest((0, 0, 0)), 0.0, 5.0, 0.25)
    saved = driven.state_of(*(np.array(x).tolist() for x in state))
    (one, first), (other, second) = moved(driven, state, 5.0, 6.0, 0.25), moved(driven, saved, 5.0, 6.0, 0.25)
    assert np.array_equal(one.position, other.position) and state.time == 5.0
    assert first[-1].tension == second[-1].tension
    assert np.isclose(driven.pull(one).tension, first[-1].tension, rtol=1e-6)


def test_a_motion_that_cannot_be_is_one_line():
    driven = DrivenLine(CHAIN)
    rest = driven.rest((0, 0, 0))
    wrong = (0.0, (0, 0, 0), "step is 0"), (0.1, (0, np.nan, 0), "three finite"), (0.1, (9e3, 0, 0), "lengths")
    for step, place, said in wrong:
        with pytest.raises(ValueError, match=said):
            driven.advance(rest, step, place, (0, 0, 0))
    with pytest.raises(ValueError, match="of <DynamicLine"):
        driven.state_of(0.0, *4 * [np.zeros((3, 3))], 0.1)
