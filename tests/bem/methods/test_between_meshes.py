"""Frequencies of one mesh between those of another: that their errors are bounds, and which frequencies are solved."""

import numpy as np
import pytest
from bench.few_estimates import campaign

from bem import DOFS
from bem.methods.between_meshes import FEWEST, BetweenRun
from bem.methods.panel_problem import prepare
from pipelines.scene.scene import make_scene
from pipelines.solve.plan import planned

BOX = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.0, 28.0, 30.0]}
RAW = {"water": {"depth": 20.0}, "bodies": [BOX], "method": "panel"}
WANT = {"added_mass", "radiation_damping", "excitation_force", "rao", "drift_force"}
QUESTION = [0.0], WANT, np.linspace(0, 2 * np.pi, 48, endpoint=False), DOFS


@pytest.fixture(scope="module")
def outcomes():
    return campaign(2, 1, 40, "panel")


def test_errors_of_frequencies_between_others_are_bounds_of_those_of_their_own(outcomes):
    bounds, small, further = (
        np.concatenate([getattr(o, name) for o in outcomes]) for name in ("bounds", "small", "further")
    )
    assert sum(o.interpolated for o in outcomes) > 0.5 * sum(o.frequencies for o in outcomes)
    assert len(bounds) > 300 and np.mean(np.concatenate([bounds, small]) >= 1) >= 0.99
    assert len(further) > 200 and np.mean(further >= 1) >= 0.95 and np.mean(further >= 0.5) >= 0.99


def test_values_are_those_of_equations_of_their_own_to_a_tenth_of_the_tolerance(outcomes):
    off = np.concatenate([o.off for o in outcomes])
    assert 0 < off.max() < 0.1


def problem(count, **more):
    return planned(make_scene({**RAW, "waves": {"omegas": {"from": 0.6, "to": 1.2, "count": count}}, **more})).problem


def answers(omegas):
    """{omega: (whether between others, values and estimated errors)} of the same problem, asked in that order"""
    prepared = prepare(problem(20))
    runs = {omega: prepared.run(omega, *QUESTION).within_tolerance() for omega in omegas}
    return {omega: (isinstance(run, BetweenRun), run.result(), run.estimated_errors()) for omega, run in runs.items()}


def test_values_and_errors_do_not_depend_on_which_frequency_is_solved_first():
    omegas = problem(20).omegas
    up, down = answers(omegas), answers(omegas[::-1])
    assert 0 < sum(between for between, _, _ in up.values()) < len(omegas)
    for omega, (between, values, errors) in up.items():
        assert down[omega][0] == between
        for one, other in ((values, down[omega][1]), (errors, down[omega][2])):
            for name in WANT:
                np.testing.assert_array_equal(one[name], other[name])


def test_few_frequencies_and_those_that_were_not_announced_are_solved_by_all_meshes():
    few, many = prepare(problem(FEWEST - 1)), prepare(problem(20))
    runs = [few.run(omega, *QUESTION) for omega in few.problem.omegas] + [many.run(0.777, *QUESTION)]
    assert not any(run.interpolated for run in runs)


def test_drift_at_angles_of_each_frequency_is_solved_by_all_meshes():
    headings, want, _, dofs = QUESTION
    prepared = prepare(problem(20))
    assert not any(prepared.run(w, headings, want, None, dofs).interpolated for w in prepared.problem.omegas[4:7])
