"""Anchors that stand where there is nothing are told, on either side of each limit."""

import warnings

import pytest

from hakobune.pipelines.common.anchors import warn_of_anchors


def said(heights, depth):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        warn_of_anchors(heights, depth)
    return [str(one.message) for one in caught]


@pytest.mark.parametrize("z, told", [(5.0, False), (29.9, False), (30.1, True)])
def test_a_bollard_is_up_to_thirty_metres_above_the_water(z, told):
    found = said({"A": z, "B": -40.0}, 40.0)
    assert len(found) == told
    assert not told or found[0].startswith(f"these anchors are above the water: A (z = {z:g} m), limit 30 m")


@pytest.mark.parametrize(
    "depth, z, told",
    [(10.0, -9.1, False), (10.0, -8.9, True), (100.0, -95.1, False), (100.0, -94.9, True), (10.0, 1.0, False)],
)
def test_an_anchor_stands_within_a_metre_or_a_twentieth_of_the_depth_of_the_bed(depth, z, told):
    """The larger of 1 m and 5 % of the depth: 1 m in 10 m of water, 5 m in 100 m; above the water it is a bollard"""
    found = said({"A": z}, depth)
    assert len(found) == told
    assert not told or f"A ({z + depth:.4g} m), limit {max(1.0, 0.05 * depth):.3g} m" in found[0]
