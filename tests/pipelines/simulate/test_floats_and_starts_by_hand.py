"""Bodies that hinges move out of the water, hulls that overlap where a run begins, and where bodies stand at rest."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.fenders.gaps import Side
from hakobune.mooring.motion.simulation import run as runs
from hakobune.mooring.studies.places import check_floats
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import work
from hakobune.pipelines.simulate.study import _outside

BOX = SimpleNamespace(draft=6.0, freeboard=4.0)
LOW = SimpleNamespace(draft=3.0, freeboard=2.0)


@pytest.mark.parametrize("up, says", [
    (5.99, None), (-3.99, None),
    (6.01, "hinges move barge up by 6.01 m at rest, limit 6 m, its draft; check for lines"),
    (-4.01, "hinges move barge down by 4.01 m at rest, limit 4 m, its freeboard; check for lines that pull"),
])  # fmt: skip
def test_hinges_leave_a_body_in_the_water_and_not_under_it(up, says):
    def check():
        check_floats({"ship": LOW, "barge": BOX}.items(), (0.0, up))

    if says is None:
        check()
        return
    with pytest.raises(ValueError, match=re.escape(says)):
        check()


def sides(gap, turned=0.0):
    """Two boxes of 20 by 10 m beside each other, a gap between their sides; a pier that stands still is turned"""
    half, middle = np.array([10.0, 5.0]), np.zeros(2)
    return (
        Side("ship", half, middle, 0, np.array([0.0, 0.0, 0.0])),
        Side("barge", half, middle, 1, np.array([0.0, 10.0 + gap, turned])),
    )


@pytest.mark.parametrize("moved, good", [(-1.99, True), (-2.01, False)])
def test_hulls_do_not_overlap_where_a_run_begins(moved, good, monkeypatch):
    """2 m apart at rest, the barge moved towards the ship from the start"""
    asked = []

    def begin(body, offset):
        asked.append((body, offset))
        poses = np.zeros((2, 6))
        poses[1, 1] = moved
        return poses

    monkeypatch.setattr(runs, "begin", begin)
    settings = SimpleNamespace(offset="offset")
    if good:
        work._check_start(sides(2.0), "body", settings)
    else:
        with pytest.raises(StudyError) as refused:
            work._check_start(sides(2.0), "body", settings)
        assert str(refused.value) == (
            "ship and barge overlap by 0.01 m at the start of a run; allowed: no overlap; give a smaller offset, or "
            "less tension between them"
        )
    assert asked[0] == ("body", "offset")


def test_bodies_at_rest_have_their_headings_and_those_that_stand_still_have_no_place():
    pier = Side("pier", np.ones(2), np.zeros(2), -1, np.array([0.0, 30.0, 0.7]))
    found = work.at_rest_of((sides(2.0)[0], pier, sides(2.0, turned=0.5)[1]))
    assert found.shape == (1, 2, 6)
    assert found[0].tolist() == [[0.0] * 6, [0.0, 0.0, 0.0, 0.0, 0.0, 0.5]]


class Waves:
    """A spectrum with 2 and 5 % of its energy below and above, and frequencies at its ends"""

    def moment(self, power, low=0.0, high=np.inf):
        return (1.0 if high == np.inf else 0.02) if low == 0 else 0.05

    def quantile(self, shares):
        assert shares == pytest.approx((0.005, 0.995), abs=1e-4)
        return (0.2, 3.0)


@pytest.mark.parametrize("omega, way", [
    ([0.4, 1.5], "solve 0.2 to 3 rad/s as well"), ([0.1, 1.5], "solve 0.1 to 3 rad/s as well"),
    ([0.4, 3.5], "solve 0.2 to 3.5 rad/s as well"),
])  # fmt: skip
def test_the_band_to_solve_holds_the_stored_one_and_99_per_cent_of_the_waves(omega, way):
    (line,) = _outside(Waves(), np.array(omega))
    assert line == (
        "7.0 % of the wave energy lies outside the stored frequencies "
        f"(2.0 % below {omega[0]:g}, 5.0 % above {omega[1]:g} rad/s) and is not included; {way}"
    )
