"""Errors of frequencies by those of others near them: that they bound what two resolutions show, and which they are."""

from types import SimpleNamespace

import numpy as np
import pytest
from bench.few_estimates import campaign

from hakobune.bem import DOFS, INTERPOLATED
from hakobune.bem.contour.solver import prepare_box
from hakobune.bem.database import open_database
from hakobune.bem.methods.few_estimates import FEWEST, Differences, FewEstimates, _small
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


class Known(FewEstimates):
    """Of nine frequencies of one resolution, whose differences are given: added mass in heave, forces likewise"""

    def __init__(self, values, small=0.0, radius=1.0, k=None):
        self.omegas, self.values, self.small = np.linspace(1.0, 2.0, 9), values, small
        self.prepared, self.k = SimpleNamespace(radius=radius), np.linspace(0.1, 0.2, 9) if k is None else k
        self.ranges = np.array([[0, 8]] * 9)
        self.differences, self.ahead = {}, {}

    def _known(self, i, key, question):
        Z, F = np.zeros((6, 6), complex), np.zeros((1, 6), complex)
        Z[2, 2], F[0, 2] = self.values[i]
        small = np.zeros((6, 6)), np.zeros((6, 6)), np.zeros(6)
        for part in small:
            part[...] = self.small
        self.differences[i, key] = Differences(Z, F, []), small
        return self.differences[i, key]


@pytest.mark.parametrize("part, turn", [(0, 1.0), (0, 1j), (1, 1j)])
def test_half_of_the_largest_difference_may_be_missed_in_the_middle(part, turn):
    """1, 1 − d, 1 of each part: d ≤ ½"""
    for d, straight in ((0.45, True), (0.55, False)):
        values = np.zeros((9, 2), complex)
        values[[0, 8], part], values[4, part] = turn, (1 - d) * turn
        assert Known(values)._straight(0, 4, 8, "", None) == straight
        assert Known(values, small=1.2)._straight(0, 4, 8, "", None)  # small beside a tenth of the tolerance


def test_the_ends_of_a_range_are_less_than_three_radians_of_the_body_apart():
    """k · 2R"""
    flat = np.zeros((9, 2), complex)
    for apart, near in ((2.95, True), (3.05, False)):
        k = np.linspace(1.0, 1.0 + apart / 20.0, 9)
        assert Known(flat, radius=10.0, k=k)._straight(0, 4, 8, "", None) == near


def test_a_range_is_halved_until_it_is_straight_and_its_three_are_solved():
    values = np.zeros((9, 2), complex)
    values[:, 0] = 1.0
    few = Known(values)
    assert (
        few._around(3, "", None) == (0, 4, 8) and few._around(4, "", None) is None and few._around(0, "", None) is None
    )
    values[4, 0] = 0.1  # the middle of all is off, that of the lower half is not
    values[2, 0] = 0.6
    few = Known(values)
    assert few._around(1, "", None) == (0, 2, 4) and few._around(2, "", None) is None
    assert few._around(5, "", None) == (4, 6, 8)  # 0.1, 1, 1: 0.45 off the line, of 1


def test_differences_between_are_on_the_parabola_and_bounds_a_third_more_than_the_largest():
    """Through (1, 1), (1.5, 2), (2, 5) at 1.25: 1.25; 1.3 times 5"""
    values = np.zeros((9, 2), complex)
    values[[0, 4, 8], 0], values[[0, 4, 8], 1] = [1.0 - 1j, 2.0, 5.0 + 2j], [3.0, -4j, 1.0]
    few = Known(values)
    for i in (0, 4, 8):
        few._known(i, "", None)
    between, (radiation, force) = few._between(2, (0, 4, 8), "")
    weights = np.array([0.375, 0.75, -0.125])  # Lagrange
    assert between.radiation[2, 2] == pytest.approx(weights @ values[[0, 4, 8], 0])
    assert between.excitation[0, 2] == pytest.approx(weights @ values[[0, 4, 8], 1])
    assert radiation[2, 2] == pytest.approx(1.3 * (5.0 + 2.0j)) and force[0, 2] == pytest.approx(1.3 * 4.0)


def test_a_tenth_of_the_tolerance_is_small():
    """Of √|Z_ii Z_jj|, of damping by its own size and of forces"""
    Z = np.diag([4.0 + 1j] * 6)
    forces = np.full((1, 6), 50.0)
    run = SimpleNamespace(
        problem=SimpleNamespace(tolerance=0.02, bodies=(), modes=()), radiates=True, diffracts=True, dofs=[2, 4],
        radiation=Z,
        prepared=SimpleNamespace(displacing=np.ones(6, bool), radius=1.0), excitation=forces, diffraction=forces,
    )  # fmt: skip
    A, B, F = _small(run)
    assert A[2, 2] == A[2, 4] == pytest.approx(0.002 * abs(4 + 1j)) and A[0, 0] == 0.0
    assert B[4, 2] == pytest.approx(0.002 * 1.0) and F.tolist() == pytest.approx([0, 0, 0.1, 0, 0.1, 0])
