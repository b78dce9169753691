from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.mirror import folded
from hakobune.meshing.panels import joined
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.outward import outward
from hakobune.meshing.shapes import box

HULL = box(20, 8, 3, panels=60, symmetry="")


def mixed(mesh, seed):
    """The mesh with about half of its panels reversed"""
    turned = np.random.default_rng(seed).random(len(mesh)) < 0.5
    return replace(mesh, corners=np.where(turned[:, None], mesh.corners[:, ::-1], mesh.corners))


@pytest.mark.parametrize("seed", range(3))
def test_mixed_normals_of_two_hulls_are_turned_out_of_each(seed):
    pair = joined([HULL.moved(dy=20), HULL.moved(dy=-20)])
    broken = mixed(pair, seed)
    (found,) = [one.text for one in findings(broken) if one.severity == "error"]
    assert "normals change side" in found and "`hakobune mesh --flip`" in found
    np.testing.assert_allclose(outward(broken).area_vectors, pair.area_vectors, atol=1e-12)


def test_normals_that_agree_are_reversed():
    np.testing.assert_array_equal(outward(HULL).area_vectors, HULL.flipped().area_vectors)


def test_a_quarter_of_mixed_normals_on_the_negative_sides_is_told_as_one_and_becomes_the_hull():
    quarter = folded(HULL)
    open_quarter = replace(quarter, symmetry="").rotated(np.pi)
    broken = mixed(open_quarter, 1)
    assert any("one quarter of a hull; add its mirror images (`hakobune mesh --mirror xy`)" in one.text
               for one in findings(broken))  # fmt: skip
    whole = outward(broken).mirrored("x").mirrored("y")
    assert findings(whole) == [] and whole.volume == pytest.approx(480, rel=1e-12)
