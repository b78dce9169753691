"""Errors carried through an equation: by one number after the other, and by chance."""

import numpy as np
import pytest

from hakobune.bem.database.deviations import by_chance, one_by_one


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
