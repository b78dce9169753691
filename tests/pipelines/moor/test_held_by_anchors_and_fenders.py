"""What moor tells of anchors, fenders and hinges, number by number."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.moor.anchors import quantities_of_anchors
from hakobune.pipelines.moor.result import _held


def an_anchor(kind, holds):
    return SimpleNamespace(kind=kind, capacity=lambda up: holds - up, used=lambda along, up: along / (holds - up),
                           needed=lambda along, up: 2 * along + up)  # fmt: skip


def test_each_line_tells_what_its_anchor_holds_uses_and_needs():
    anchors = [an_anchor("drag", 100.0), None, an_anchor("pile", 50.0), an_anchor("sinker", 80.0)]
    along, up = np.array([30.0, 1.0, 20.0, 35.0]), np.array([0.0, 0.0, 10.0, 10.0])
    found = quantities_of_anchors(anchors, along, up)
    nan = np.nan
    wanted = {
        "anchor.holding": ([100.0, nan, 40.0, 70.0], "N", False), "anchor.used": ([0.3, nan, 0.5, 0.5], "", True),
        "anchor.needed_mass": ([60.0, nan, nan, nan], "kg", False),
        "anchor.needed_weight": ([nan, nan, nan, 80.0], "N", False),
    }  # fmt: skip
    assert {name: (q.unit, q.share) for name, q in found.items()} == {n: row[1:] for n, row in wanted.items()}
    for name, (values, *_) in wanted.items():
        assert found[name].values == pytest.approx(values, nan_ok=True)
    assert quantities_of_anchors([None, None], along[:2], up[:2]) == {}
    assert set(quantities_of_anchors(anchors[2:3], along[2:3], up[2:3])) == {"anchor.holding", "anchor.used"}


def test_fenders_and_hinges_are_told_at_rest_and_under_the_steady_forces():
    """A fender that is not met has no deflection below nothing"""
    contact = [np.array([[-0.2, 0.1], [0.0, 5.0]]), np.array([[0.3, 0.2], [7.0, 9.0]])]
    held = [first + np.arange(6.0)[None] for first in (0.0, 10.0, 20.0)]
    made = SimpleNamespace(berth=SimpleNamespace(names=("a", "b")), contact=contact, held=held)
    found = {name: (q.values.tolist(), q.unit) for name, q in _held(made).items()}
    units = ("N", "N", "N", "N m", "N m", "N m")
    assert found == {
        "contact.at_rest": ([0.0, 0.1], "m"), "contact.force_at_rest": ([0.0, 5.0], "N"),
        "contact.steady": ([0.3, 0.2], "m"), "contact.force_steady": ([7.0, 9.0], "N"),
        "hinge.at_rest": ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0], units),
        "hinge.steady": ([10.0, 11.0, 12.0, 13.0, 14.0, 15.0], units),
        "hinge.largest": ([20.0, 21.0, 22.0, 23.0, 24.0, 25.0], units),
    }  # fmt: skip
    none = SimpleNamespace(berth=SimpleNamespace(names=()), contact=contact, held=[held[0][:0]] * 3)
    assert _held(none) == {}
