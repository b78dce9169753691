"""Errors of frequencies by those of others near them: that they bound what two resolutions show, and which they are."""

import numpy as np
import pytest
from bench.few_estimates import campaign

from hakobune.bem import DOFS, INTERPOLATED
from hakobune.bem.contour.solver import prepare_box
from hakobune.bem.database import open_database
from hakobune.bem.methods.few_estimates import FEWEST
from hakobune.bem.methods.panel_problem import prepare
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.plan import planned
from hakobune.pipelines.solve.run import solve

BOX = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.0, 28.0, 30.0]}
WAVES = {"omegas": {"from": 0.3, "to": 0.5, "count": 25}}
RAW = {"water": {"depth": 20.0}, "bodies": [BOX], "waves": WAVES, "method": "contour"}
QUESTION = [0.0], {"added_mass", "radiation_damping", "excitation_force", "rao"}, None, DOFS


@pytest.fixture(scope="module")
def outcomes():
    return campaign(4, 3, 40)


def test_ninety_nine_of_a_hundred_errors_of_coefficients_and_forces_are_bounds(outcomes):
    ratio = np.concatenate([np.concatenate([o.bounds, o.small]) for o in outcomes])
    assert sum(o.interpolated for o in outcomes) > 0.2 * sum(o.frequencies for o in outcomes)
    assert len(ratio) > 1000 and np.mean(ratio >= 1) >= 0.99


def test_nineteen_of_twenty_errors_of_motions_and_drift_are_bounds_and_none_is_half_of_what_it_should_be(outcomes):
    ratio = np.concatenate([o.further for o in outcomes])
    assert len(ratio) > 100 and np.mean(ratio >= 1) >= 0.95 and np.mean(ratio >= 0.5) >= 0.99


def estimates(omegas):
    """{omega: estimated errors and whether they are interpolated} of a scene, solved in that order"""
    prepared = prepare(planned(make_scene(RAW)).problem)
    runs = {omega: prepared.run(omega, *QUESTION) for omega in omegas}
    return {omega: (run.interpolated, run.estimated_errors()) for omega, run in runs.items()}


def test_errors_do_not_depend_on_which_frequency_is_solved_first():
    omegas = planned(make_scene(RAW)).problem.omegas
    up, down = estimates(omegas), estimates(omegas[::-1])
    assert len(omegas) / 2 < sum(up[omega][0] for omega in omegas) < len(omegas) - FEWEST
    for omega in omegas:
        assert up[omega][0] == down[omega][0]
        for name, error in up[omega][1].items():
            np.testing.assert_array_equal(error, down[omega][1][name])


def test_a_range_ends_where_the_resolution_changes_and_other_frequencies_have_errors_of_their_own():
    few = prepare(planned(make_scene(RAW)).problem).few_estimates
    body = prepare_box(100.0, 50.0, 10.0, 20.0, few.prepared.problem.tolerance)
    kinds = [(b.resolution(omega), c.resolution(omega)) for omega in few.omegas for b, c in [(body, body.finer)]]
    assert 1 < len({tuple(pair) for pair in few.ranges.tolist()}) == len(set(kinds))
    assert not few.run(0.4001, *QUESTION).interpolated


def test_a_database_says_which_errors_are_those_of_others(tmp_path):
    path = solve(make_scene(RAW), tmp_path / "box.h5").path
    db = open_database(path)
    told = db.interpolated_estimates()
    assert told.shape == db.omega.shape and 0 < told.sum() < len(told)
    assert [INTERPOLATED in steps for steps in db.wall_times()] == told.tolist()
    assert all(np.all(error[told] >= 0) for error in db.estimated_errors().values())
