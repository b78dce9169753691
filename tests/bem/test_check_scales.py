"""By what the errors of coefficients are divided, and how two meshes tell them, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.checks import (
    ERROR_ORDER,
    at_least_haskind,
    damping_scale,
    enlarged,
    estimate,
    excitation_scale,
    haskind,
    largest_error,
    radiation_scale,
    reciprocity,
    sufficient_accuracy,
)

ALL = np.ones(6, bool)


def run(**more):
    given = {"dofs": np.arange(6), "forced": np.arange(6), "radiates": True, "diffracts": True}
    prepared = SimpleNamespace(displacing=more.pop("displacing", ALL), radius=more.pop("radius", 8.0))
    rigid = SimpleNamespace(bodies=(), modes=())
    return SimpleNamespace(**given, **more, prepared=prepared, problem=rigid)


def test_two_meshes_tell_the_error_of_the_finer_where_errors_fall_like_their_power():
    """Richardson (1911): c + e N^−p on N and 4N panels differ by (4^p − 1) times the error of the finer"""
    true, error = 3.0 + 1.0j, 0.02 - 0.01j
    fine = SimpleNamespace(radiation=true + error, excitation=true - error)
    rough = SimpleNamespace(radiation=true + error * 4**ERROR_ORDER, excitation=true - error * 4**ERROR_ORDER)
    assert estimate(fine, rough, 4.0) == pytest.approx((error, -error))


def test_radiation_is_measured_by_the_root_of_both_diagonals():
    """|Z| 4, 9 and 25 of three modes that move water: 2·3, 2·5 and 3·5 between them"""
    Z = np.diag([4.0, 9.0j, 3.0 + 4.0j, 0.0, 0.0, 0.0]).astype(complex)
    Z[2, 2] *= 5
    Z[0, 1] = 0.6
    moving = np.array([True, True, True, False, False, False])
    one = run(radiation=Z, displacing=moving)
    assert radiation_scale(one)[:3, :3] == pytest.approx(np.outer([2, 3, 5], [2, 3, 5]))
    assert np.isinf(radiation_scale(one)[3:]).all()
    assert reciprocity(one) == pytest.approx(0.6 / 6)


def test_no_force_counts_as_less_than_a_fifth_of_the_largest_and_no_moment_as_less_than_on_half_the_radius():
    """Forces 10, 1, 3: none below 2.  Moments 5, 50, 0: none below a fifth of 50, or 2 · 8/2 on a radius of 8 m, 2 · 15
    on one of 30 m.  The larger of excitation and diffraction counts, over all headings."""
    excitation = np.array([[10.0, 1.0, 3.0j, 5.0, 20.0, 0.0], [4.0, 0.5, 1.0, 1.0, 1.0, 0.0]])
    diffraction = np.array([[3.0, 0.2, 1.0, 1.0, -50.0j, 0.0], [0, 0, 0, 0, 0, 0]])
    forces = {"excitation": excitation, "diffraction": diffraction}
    assert excitation_scale(run(**forces)) == pytest.approx([10, 2, 3, 10, 50, 10])
    assert excitation_scale(run(**forces, radius=30.0)) == pytest.approx([10, 2, 3, 30, 50, 30])
    still = excitation_scale(run(**forces, displacing=np.array([True] * 5 + [False])))
    assert np.isinf(still[5]) and still[4] == 50
    # the error of each in its own scale: 0.4 of 2 beats 1 of 10
    radiation, wrong = np.zeros((6, 6), complex), np.zeros((2, 6), complex)
    wrong[1, 0], wrong[0, 1] = 1.0, 0.4j
    assert largest_error(run(**forces, radiation=np.eye(6) + 0j), radiation, wrong) == pytest.approx(0.2)
    radiation[2, 1] = 0.3
    assert largest_error(run(**forces, radiation=np.eye(6) + 0j), radiation, wrong) == pytest.approx(0.3)
    other = excitation + np.array([0, 0, 0, 0, 5.0, 0])
    assert haskind(run(**forces, haskind=other)) == pytest.approx(0.1)


def test_damping_that_dies_out_in_a_thousand_periods_is_the_least_that_counts():
    """exp(−Bt/2A) takes N periods 2π/ω to fall by e for B = ωA/πN: of A = 2π there B/ω is 2/N"""
    Z = np.diag([2 * np.pi, 2 * np.pi + 0.5j])
    found = damping_scale(Z, np.array([True, True]), periods=100)
    assert found == pytest.approx(np.sqrt(np.outer([0.02, 0.5], [0.02, 0.5])))


def test_errors_are_at_least_what_two_ways_to_a_force_differ_by_and_grow_without_turning():
    error = np.array([[0.1, 0.5, 0.0]])
    found = at_least_haskind(error, np.array([[1.0, 1.0, 1.0]]), np.array([[0.7, 0.8, 0.5]]), [0, 1])
    assert found == pytest.approx(np.array([[0.3, 0.5, 0.0]]))  # the third degree of freedom is not asked for
    assert enlarged(np.array([3 + 4j, 0.0]), 2.5) == pytest.approx([(3 + 4j) * 1.5, 0.0])


@pytest.mark.parametrize("panels, accuracy", [
    (250, 1e-4), (990, 1e-4), (1050, 5e-4 * (1 / 4.2) ** 1.16), (2000, 5e-4 * 0.125**1.16),
    (3900, 5e-4 * (1 / 15.6) ** 1.16), (4100, 2e-5), (50000, 2e-5),
])  # fmt: skip
def test_equations_are_solved_to_a_twentieth_of_the_error_of_so_many_panels(panels, accuracy):
    """1 % with 250 panels, less by the power 1.16 of their number; between 2e-5 and 1e-4"""
    assert sufficient_accuracy(panels) == pytest.approx(accuracy, rel=1e-9)
