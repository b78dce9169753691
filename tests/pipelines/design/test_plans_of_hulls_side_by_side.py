"""The plan of hulls made fast to each other, read back: lines, fenders, outlines, names, limits and colours."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib import colormaps

from hakobune.mooring.studies.conditions import Afloat, ExposedBox
from hakobune.pipelines.design.kinds import side_plan
from hakobune.pipelines.design.kinds.needs import OF_ALLOWABLE

SHIP = Afloat("ship", ExposedBox(40.0, 10.0, 4.0, 2.0), np.zeros(3), np.zeros(2), 0.0, 1025.0)
BARGE = Afloat("barge", ExposedBox(20.0, 8.0, 2.0, 2.0), np.zeros(3), np.array([0.0, 10.0]), 0.0, 1025.0)
PLACE = np.array([[1.0, -1.25, 0.0], [0.0, 0.25, 0.0]])


def fender(name, x, y):
    return SimpleNamespace(name=name, face=(x, y, -1.0))


@pytest.fixture
def drawn(monkeypatch, pictures, tmp_path):
    monkeypatch.setattr(side_plan, "afloat", lambda db, boxes: [SHIP, BARGE] if (db, boxes) == ("db", "boxes") else [])

    def call(largest=(20.0, 50.0, 30.0), breaking=(100.0, 100.0, np.inf), strain=None):
        berth = SimpleNamespace(fenders=[fender("F", 5.0, 5.5), fender("G", -5.0, 5.5)])
        made = SimpleNamespace(hulls_of=lambda db: "boxes", berth_of=lambda db, boxes: berth)
        numbers = SimpleNamespace(
            names=("chain", "rope", "hawser"), largest=np.array(largest), breaking=np.array(breaking),
            anchor=np.array([[90.0, -60.0, -12.0], [10.0, 7.0, 1.0], [-10.0, 7.0, 1.0]]),
            fairlead=np.array([[20.0, -5.0, 0.0], [12.0, 5.0, 1.0], [-12.0, 5.0, 1.0]]),
            parts={} if strain is None else {OF_ALLOWABLE: strain}, place=PLACE.ravel(),
        )  # fmt: skip
        side_plan.draw_between(made, "db", numbers, tmp_path / "p.png")
        return pictures[-1]

    return call


def test_both_views_have_every_line_fender_and_hull(drawn):
    figure = drawn(strain={"F": 0.4})
    far, near, bar = figure.axes
    assert figure.get_size_inches().tolist() == [15.0, 7.5] and bar.get_ylabel() == (
        "tension / breaking load,\nstrain / allowable strain"
    )
    turbo = colormaps["turbo"]
    for axes in (far, near):
        lines = axes.lines
        assert lines[0].get_xydata().tolist() == [[90, -60], [20, -5]] and lines[0].get_linewidth() == 2
        assert lines[1].get_xydata().tolist() == [[10, 7], [12, 5]]
        assert [lines[i].get_color() for i in range(3)] == [
            turbo(0.2),
            turbo(0.5),
            turbo(0.0),
        ]  # of infinite strength 0
        assert [lines[i].get_xydata().tolist() for i in (3, 4)] == [[[5.0, 5.5]], [[-5.0, 5.5]]]
        assert [(lines[i].get_marker(), lines[i].get_color()) for i in (3, 4)] == [("s", turbo(0.4)), ("s", turbo(0.0))]
        for i, (hull, place) in enumerate(zip((SHIP, BARGE), PLACE, strict=True)):
            still, moved = (lines[k].get_xydata() for k in (5 + 2 * i, 6 + 2 * i))
            box = 0.5 * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]]) * [hull.box.length, hull.box.beam]
            assert still == pytest.approx(box + hull.place) and moved == pytest.approx(box + hull.place + place[:2])
        assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_aspect()) == ("x, m", "y, m", 1.0)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["as drawn", "mean place"]
    assert far.get_title() == (
        "ship: mean place 1.00 m, -1.25 m, yaw 0.00°\nbarge: mean place 0.00 m, 0.25 m, yaw 0.00°"
    )
    assert near.get_title() == "hawsers and ropes above, fenders below"


def test_names_of_lines_are_at_their_anchors_in_the_far_view_and_of_what_is_near_beside_the_hulls(drawn):
    """12 % of the way from the anchor to the fairlead; the hulls lie within ±20 m and −5 to 14 m, 6 m are free"""
    far, near, _ = drawn(strain={"F": 0.4, "G": 0.25}).axes
    (name,) = far.texts
    assert name.get_text() == "chain 20 %" and name.xyann == pytest.approx((90 - 0.12 * 70, -60 + 0.12 * 55))
    assert far.lines[-1].get_xydata().tolist() == [[90.0, -60.0]] and far.lines[-1].get_marker() == "^"
    told = {one.get_text(): one for one in near.texts}
    assert set(told) == {"rope 50 %", "hawser 0 %", "F 40 %", "G 25 %", "ship", "barge"}
    assert told["rope 50 %"].xy == (10.0, 7.0) and told["F 40 %"].xy == (5.0, 5.5)
    assert told["ship"].xy == pytest.approx((0, 0)) and told["barge"].xy == pytest.approx((0, 10))
    assert near.get_xlim() == pytest.approx((-26.0, 26.0))
    scale = min(6.0 / 52.0, 6.0 / 31.0)  # inches a metre
    row = side_plan.ROW / scale
    assert near.get_ylim() == pytest.approx((-5 - 6 - row, 14 + 6 + row))
    assert told["rope 50 %"].xyann == pytest.approx((10.0, 20 + row - 0.12 / scale))
    assert told["F 40 %"].xyann == pytest.approx((5.0, -11 - row + 0.12 / scale))


@pytest.mark.parametrize("largest, strain, top", [
    ((20.0, 50.0, 30.0), {"F": 0.4}, 1.0), ((150.0, 50.0, 30.0), None, 1.5), ((20.0, 50.0, 30.0), {"F": 1.7}, 1.7),
    ((900.0, 50.0, 30.0), {"F": 1.7}, 2.0), ((20.0, 50.0, 30.0), {"F": np.inf}, 1.0),
])  # fmt: skip
def test_colours_go_to_the_largest_share_from_one_to_two(drawn, largest, strain, top):
    bar = drawn(largest, strain=strain).axes[2]
    assert bar.get_ylim() == pytest.approx((0.0, top))


@pytest.mark.parametrize("point, near", [
    ((25.9, 0.0), True), ((26.1, 0.0), False), ((0.0, 19.9), True), ((0.0, 20.1), False), ((-25.9, -10.9), True),
    ((-25.9, -11.1), False), ((-26.1, 0.0), False),
])  # fmt: skip
def test_what_is_within_15_per_cent_of_the_extent_of_the_hulls_is_near(point, near):
    outline = np.array([[-20.0, -5.0], [20.0, 14.0]])
    assert side_plan._close(outline, np.array([point, (0.0, 0.0)])).tolist() == [near, True]
