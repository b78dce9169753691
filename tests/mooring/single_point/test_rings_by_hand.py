"""Zeros and crests of functions of an angle whose zeros and crests are known."""

import math

import numpy as np
import pytest

from hakobune.mooring.single_point.rings import Ring, angles, zeros


@pytest.mark.parametrize("function, at", [
    (lambda a: np.cos(a) - 2.0, []), (lambda a: np.cos(a) + 2.0, []), (lambda a: 0 * a, []),
    (lambda a: 1e-9 * (np.cos(a) - 0.5), [60, 300]), (lambda a: -1e9 * (np.cos(a) + 0.5), [120, 240]),
    (lambda a: np.sin(a), [0, 180]), (lambda a: np.cos(a) - 3.0 + 2.5, [60, 300]),
    (lambda a: 1.0 - 9.0 * np.cos(a / 2) ** 40, [2 * math.degrees(math.acos(9 ** (-1 / 40))),
                                               360 - 2 * math.degrees(math.acos(9 ** (-1 / 40)))]),
    (lambda a: np.cos(a - math.radians(0.5)) - math.cos(math.radians(0.25)), [0.25, 0.75]),  # below 0 at every place
    (lambda a: np.cos(a - 1e-4) - math.cos(2e-4), [math.degrees(3e-4), 360 - math.degrees(1e-4)]),
    (lambda a: -1 + 1e-8 - np.cos(3 * a), [60 * k + s * math.degrees(math.acos(1 - 1e-8)) / 3
                                         for k in (1, 3, 5) for s in (-1, 1)]),
])  # fmt: skip
def test_zeros_of_a_function_are_where_it_is_0_whatever_its_size_and_sign(function, at):
    """Also on both sides of 0°, of a function that is most negative, and where it hardly reaches across 0"""
    assert np.degrees(zeros(function)) == pytest.approx(at, abs=1e-6)


def test_a_ring_is_a_cubic_between_its_places_and_level_at_its_crests():
    """cos 2a + 0.3 sin a: its slope −2 sin 2a + 0.3 cos a is 0 at 90°, 270° and where sin a = 0.075; turned by 0.1°"""
    turn = math.radians(0.1)

    def wave(a):
        return np.cos(2 * (a - turn)) + 0.3 * np.sin(a - turn)

    ring, small = Ring(wave(angles(720))), math.degrees(math.asin(0.075))
    wanted = [small + 0.1, 90.1, 180.1 - small, 270.1]
    assert np.degrees(ring.crests()) == pytest.approx(wanted, abs=1e-4)
    a = np.array([0.001, 1.0, 6.2831, -0.3, 7.0])
    assert ring.along(a) == pytest.approx(wave(a), abs=1e-7)
