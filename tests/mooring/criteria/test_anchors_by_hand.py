"""Anchors by hand: the law of charts and its inverse, a sinker on friction, a pile, and what is said of them."""

import numpy as np
import pytest

from hakobune.mooring.criteria.anchors import Anchor, Chart, anchor_findings, charts, holding_of
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.anchors import AnchorTable, anchors_of

NAMES = ["fore", "aft", "side"]


def one(**keys):
    return anchors_of([AnchorTable(**keys)], ["fore"])[0]


def test_a_drag_anchor_of_ten_thousand_pounds_holds_what_the_chart_says_and_a_size_holds_the_pull_it_is_made_for():
    """70 kips of 4448.2 N for a stockless anchor in sand; 2^0.8 times that of twice the mass"""
    anchor = one(kind="drag", type="stockless", soil="sand", mass=4536.0)
    assert anchor.holding == pytest.approx(70 * 4448.2, rel=2e-3)
    assert one(kind="drag", type="stockless", soil="sand", mass=9072.0).holding == pytest.approx(
        2**0.8 * anchor.holding
    )
    assert one(kind="drag", type="Stevpris Mk6", soil="sand", mass=5000.0).holding == pytest.approx(904.21e3 * 5**0.92)
    sized = one(kind="drag", type="Danforth", soil="mud", safety=1.5)
    mass = sized.needed(400e3, 0.0)
    assert holding_of(charts()["Danforth", "mud"], mass) == pytest.approx(1.5 * 400e3) and np.isnan(sized.used(4e5, 0))


def test_a_sinker_slides_by_friction_less_what_lifts_it_and_a_pile_fails_by_the_larger_share():
    sinker = one(kind="sinker", friction=0.5, weight_kN=400.0, safety=1.5)
    assert sinker.used(100e3, 50e3) == pytest.approx(1.5 * 250 / 400) and sinker.needed(100e3, 50e3) == 375e3
    assert sinker.capacity(50e3) == 0.5 * 350e3 and sinker.used(100e3, -10.0) == pytest.approx(0.75)
    pile = one(kind="pile", holding_kN=1000.0, girth=2.0, length=10.0, cohesion_kPa=20.0)
    assert pile.used(500e3, 100e3) == 0.5 and pile.used(100e3, 300e3) == 0.75


def test_what_fails_is_said_with_its_share_and_a_drag_anchor_that_is_lifted_with_its_angle():
    given = Anchor("drag", 100e3), Anchor("sinker", weight=1e6, friction=0.5), None
    over, lifted = anchor_findings(NAMES, given, np.array([120e3, 1e3, 9e9]), np.array([12e3, 1e3, 0.0]))
    assert over.startswith("FAILS: 1 of 2 anchors") and "fore 120 %" in over and "aft" not in over
    assert (
        "fore with 12 kN at 5.71° above the bed: their holding capacity is for a horizontal pull only; give" in lifted
    )
    assert list(anchor_findings(NAMES, given, np.array([99e3, 1e3, 9e9]), np.zeros(3))) == []
    small, _ = anchor_findings(["a"], [one(kind="drag", type="Danforth", soil="sand")], [560e3 * 0.05**0.8], [0.0])
    assert "most of all a with 227 kg; the limit is a tenth of the chart's 4536 kg" in small
    chart = Anchor("drag", 100e3, chart=Chart(4536.0, 1e5, 0.9, "a book", "unverified"))
    assert "by a book has not been checked against the printed source" in next(
        anchor_findings(["a"], [chart], np.ones(1), np.zeros(1))
    )


def test_lines_have_the_anchor_that_names_them_or_the_one_for_all_others():
    tables = [AnchorTable(kind="drag", holding_kN=1.0, lines=["aft"]), AnchorTable(kind="drag", holding_kN=2.0)]
    assert [held and held.holding for held in anchors_of(tables, NAMES, ["side"])] == [2e3, 1e3, None]


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ([{"kind": "plate"}], "kind is 'plate'; allowed: drag, sinker, pile"),
        ([{"kind": "sinker", "weight_kN": 1.0}], "friction is missing"),
        ([{"kind": "sinker", "mass": 1.0}], "mass is given with kind = 'sinker'; allowed keys: friction, weight_kN"),
        ([{"kind": "drag", "type": "stockless", "soil": "rock"}], "allowed: soil mud, sand; or give holding_kN"),
        (
            [{"kind": "drag", "type": "Danforth"}],
            "anchor without soil; allowed: soil mud, sand; or give holding",
        ),
        ([{"kind": "drag"}], "a drag anchor without type and soil; allowed: type stockless"),
        ([{"kind": "drag", "type": "CQR", "soil": "mud"}], "allowed: type stockless, .*Stevpris Mk6; or give holding"),
        ([{"kind": "drag", "holding_kN": 1.0, "mass": 2.0}], "either holding_kN, or type, soil and mass"),
        ([{"kind": "drag", "holding_kN": -1.0}], r"holding_kN is -1; allowed: above 0"),
        ([{"kind": "pile", "uplift_kN": 1.0}], "holding_kN is missing"),
        ([{"kind": "pile", "holding_kN": 1.0, "girth": 1.0}], "either uplift_kN, or girth, length and cohesion_kPa"),
        ([{"kind": "drag", "holding_kN": 1.0, "lines": ["port"]}], "'port' is unknown; allowed lines: fore, aft"),
        ([{"kind": "drag", "holding_kN": 1.0, "lines": ["side"]}], "'side' is on no anchor"),
        (2 * [{"kind": "drag", "holding_kN": 1.0, "lines": ["aft"]}], "'aft' is in two tables; allowed lines: fore"),
        (
            2 * [{"kind": "drag", "holding_kN": 1.0}],
            "have no lines; only one table may leave out lines, and it is for all other lines",
        ),
    ],
)
def test_anchors_that_cannot_be_are_told_with_what_is_allowed(tables, words):
    with pytest.raises(StudyError, match=words):
        anchors_of([AnchorTable(**table) for table in tables], NAMES, ["side"])


def test_drag_anchors_are_sized_by_the_charts_whatever_the_case_of_their_names():
    """H = H_R (m/m_R)^b of UFC 4-159-03, table 5-3, in kips and pounds: 87 kips at 10 000 lb, b = 0.92 of a Danforth in
    mud; 270 kips and 0.94 of a NAVMOOR in sand"""
    kip, pound = 4448.2216, 0.45359237
    for name, soil, kips, exponent in (("DANFORTH", "Mud", 87.0, 0.92), ("navmoor", "sand", 270.0, 0.94)):
        (held, *_) = anchors_of([AnchorTable(kind="drag", type=name, soil=soil, mass=3000 * pound)], NAMES, [])
        assert held.capacity(0.0) == pytest.approx(kips * kip * 0.3**exponent, rel=2e-3)
        assert held.needed(held.capacity(0.0), 0.0) == pytest.approx(3000 * pound, rel=1e-9)
