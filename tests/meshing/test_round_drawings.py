"""A hull of revolution is round in a file of few decimals; a hull that only nearly is one is not."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.panels import _turns_to_itself
from hakobune.meshing.shapes import box, buoy

HULL = buoy(1.25, 0.8, panels=300).whole().moved(dz=0.0)


@pytest.mark.parametrize("decimals", [None, 6, 4, 3])
def test_a_round_hull_is_round_in_a_file_of_three_decimals(decimals):
    points = HULL.points if decimals is None else np.round(HULL.points, decimals)
    assert replace(HULL, points=points).is_round


@pytest.mark.parametrize("other", [
    replace(HULL, points=HULL.points * (1.005, 1.0, 1.0)),  # an ellipse half a per cent longer than wide
    replace(HULL, points=HULL.points + (0.004, 0.0, 0.0)),  # beside its axis
    box(2, 2, 1, panels=300).whole(), box(10, 10, 3, panels=2000).whole(),
])  # fmt: skip
def test_a_hull_that_is_longer_than_wide_or_square_is_not_round(other):
    assert not other.is_round


def test_corners_farther_apart_than_their_tolerance_are_counted_each():
    """Twelve corners on a rim of 1.25 m, 0.65 m apart, come to one another by a twelfth of a turn; eleven do not"""
    angles = 2 * np.pi * np.arange(12) / 12
    rim = np.stack([1.25 * np.cos(angles), 1.25 * np.sin(angles), 0 * angles], axis=1)
    assert _turns_to_itself(rim, 1e-3) and not _turns_to_itself(rim[:-1], 1e-3)
