"""Curves of a held body, direction by direction."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.lines.lines_quantities import curves_at


@pytest.mark.parametrize("count", [1, 2])
def test_curves_stand_side_by_side_under_the_name_of_their_body(count):
    """Three offsets, two lines, one or two directions"""
    tension = np.array([[1.0, 5.0], [4.0, 2.0], [3.0, 7.0]])
    one = [SimpleNamespace(body=name, restoring=k * np.arange(3.0), tension=k * tension, grounded_length=tension - k)
           for k, name in ((1.0, "barge"), (2.0, "other"))][:count]  # fmt: skip
    found = curves_at(one)
    assert found["curve.restoring"].table == "barge held at offsets from rest"
    assert found["curve.restoring"].values[:, -1].tolist() == [0.0, count, 2.0 * count]
    assert found["curve.tension"].values[:, 0].tolist() == [5.0, 4.0, 7.0]
    assert found["curve.line_tension"].values.shape == found["curve.line_grounded"].values.shape == (3, count, 2)
    assert found["curve.line_tension"].values[:, -1] == pytest.approx(count * tension)
    assert found["curve.line_grounded"].values[:, -1] == pytest.approx(tension - count)
    assert curves_at([]) == {}
