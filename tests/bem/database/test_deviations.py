"""Errors carried through an equation: by one number after the other, and by chance."""

import numpy as np
import pytest
from made_up_body import HEADINGS, INERTIA, OMEGA, STIFFNESS, exact_motion, made_up_body, thinned

from hakobune.bem.database.deviations import by_chance, carried, interpolated, one_by_one


def test_errors_of_several_quantities_add_up_as_squares():
    """f = 3a + b², of a ± 0.2 and b = 5 ± 0.1: √((3 · 0.2)² + (2 · 5 · 0.1)²)"""
    found = one_by_one(lambda p: 3 * p["a"] + p["b"] ** 2, {"a": 2.0, "b": 5.0}, {"a": 0.2, "b": 0.1})
    assert found == pytest.approx(np.hypot(0.6, 1.0), rel=1e-3)


@pytest.mark.parametrize("kind", [float, complex])
def test_chance_has_the_deviation_given_of_each_number(kind):
    """Of 20 000 numbers, the mean square of which is known to a hundredth; H moves with them, with weight 2"""
    count = 20000
    parts = {"a": np.zeros((1, count), kind), "H": np.zeros((1, 1, 16), complex)}
    errors = {"a": np.full((1, count), 0.3), "H": np.zeros((1, 1, 16))}
    found = by_chance(lambda p: 2 * p["a"], parts, errors, ("H",), np.array([2.0]))
    assert np.mean(found**2) == pytest.approx(4 * 0.09, rel=0.02)


def test_chance_of_kochin_functions_has_no_more_harmonics_than_waves_on_the_hull_and_one():
    """k R = 2: orders −3 to 3, of which each has 16/7 of the variance"""
    rows = 4000
    parts = {"H": np.zeros((1, rows, 16), complex)}
    errors = {"H": np.full((1, rows, 16), 0.5)}
    order = np.fft.fftfreq(16, 1 / 16)
    found = by_chance(lambda p: np.fft.fft(p["H"], axis=-1) / 16, parts, errors, ("H",), np.array([2.0]))
    square = np.mean(found**2, axis=(0, 1))
    assert square[np.abs(order) > 3] == pytest.approx(0.0, abs=1e-20)
    assert square[np.abs(order) <= 3] == pytest.approx(0.25 / 7, rel=0.1)
    plain = by_chance(lambda p: p["H"], parts, errors, ("H",), np.array([2.0]))
    assert np.mean(plain**2) == pytest.approx(0.25, rel=0.02)


def test_chance_is_the_same_whatever_else_is_asked_for():
    parts = {"H": np.zeros((3, 2, 8), complex), "a": np.zeros((3, 4))}
    errors = {name: np.ones(value.shape) for name, value in parts.items()}
    waves = np.array([1.0, 2.0, 3.0])
    whole = by_chance(lambda p: p["a"], parts, errors, ("H",), waves)
    one = by_chance(lambda p: p["a"], {n: v[1:2] for n, v in parts.items()}, {n: v[1:2] for n, v in errors.items()},
                    ("H",), waves[1:2])  # fmt: skip
    assert one[0] == pytest.approx(whole[1]) and whole[0] == pytest.approx(whole[2])


HALF = np.radians([0.0, 20.0, 65.0, 90.0])


def test_a_deviation_between_headings_has_those_of_both_interpolations():
    """Σ |w|² e² over the stored waves and their images, and what the regression leaves open, with as many independent
    values as are not zero by symmetry, of four images one"""
    body = thinned(made_up_body())
    omega, headings = np.array([0.41, 0.77]), HALF
    over = body.to_headings(omega, headings)
    values = body.ring.of_forces(body.between.value(omega, "excitation_force"))
    error = np.abs(body.ring.of_forces(body.between.error(omega, "excitation_force")))
    found = interpolated(body, omega, headings, "excitation_force")
    assert found.shape == (2, 4, 6) and len(body.ring.headings) == 12
    # of 12 headings every 30°: cosβ and sinβ vanish at two each, their product at four
    independent = np.array([10, 10, 12, 10, 10, 8]) / 4
    for q in range(2):
        for p, place in enumerate(over.source):
            spread = np.sqrt(np.abs(over.weights[q, place]) ** 2 @ error[q] ** 2)
            left = over.deviation(values, independent)[q, place]
            assert found[q, p] == pytest.approx(np.hypot(spread, left))
    stored = interpolated(body, body.omega[:2], np.radians([30.0, -150.0]), "excitation_force")
    assert stored == pytest.approx(np.zeros((2, 2, 6)))
    for name, asked in (("excitation_force", None), ("added_mass", headings)):
        assert np.array_equal(interpolated(body, omega, asked, name), body.between.error(omega, name))


def test_motions_deviate_by_those_of_added_mass_damping_and_force_each_by_itself():
    """δX = D⁻¹ (ω² δA + iω δB) X + D⁻¹ δF to first order, as squares; nothing in a stored wave"""
    body, omega, headings = thinned(made_up_body()), np.array([0.41]), HALF
    names = ("added_mass", "radiation_damping", "excitation_force")
    A, B = (part[0] for part in body.coefficients(omega))
    D = -(omega[0] ** 2) * (INERTIA + A) - 1j * omega[0] * B + STIFFNESS
    X = np.linalg.solve(D, body.forces(omega, headings)[0].T)
    eA, eB, eF = (interpolated(body, omega, headings, name)[0] for name in names)
    parts = [omega[0] ** 2 * eA @ X, 1j * omega[0] * eB @ X, eF.T]
    expected = np.sqrt(sum(np.abs(np.linalg.solve(D, part)) ** 2 for part in parts)).T
    found = carried(body, omega, headings, "rao", names)[0]
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-9 * expected.max()) and expected.max() > 0
    with_motions = made_up_body(rao=np.array([[exact_motion(w, b) for b in HEADINGS] for w in OMEGA]))
    assert not carried(with_motions, OMEGA[:2], HEADINGS, "rao", names).any()
    mixed = carried(with_motions, np.array([OMEGA[0]]), np.radians([0.0, 20.0]), "rao", names)[0]
    assert not mixed[0].any() and mixed[1].any()


def test_drift_without_a_far_field_has_the_deviation_of_its_interpolation():
    """(+ − −) in y = 0, (− + −) in x = 0: two or four waves of 12 have none of a component"""
    along = np.stack([np.cos(HEADINGS), np.sin(HEADINGS), np.sin(2 * HEADINGS)], axis=1)
    body = made_up_body(drift_force=np.multiply.outer(1 + OMEGA, along))
    omega = np.array([0.5 * (OMEGA[3] + OMEGA[4])])
    found = carried(body, omega, HALF, "drift_force", ("kochin_radiation",))
    assert np.array_equal(found, interpolated(body, omega, HALF, "drift_force")) and found.shape == (1, 4, 3)
    over = body.to_headings(omega, HALF, "drift_force")
    ring = body.ring_of("drift_force")
    error, values = (ring.of_drift(part) for part in (body.between.error(omega, "drift_force"),
                                                      body.between.value(omega, "drift_force")))  # fmt: skip
    independent = np.array([10, 10, 8]) / 4
    for p, place in enumerate(over.source):
        spread = np.sqrt(np.abs(over.weights[0, place]) ** 2 @ error[0] ** 2)
        assert found[0, p] == pytest.approx(np.hypot(spread, over.deviation(values, independent)[0, place]))
