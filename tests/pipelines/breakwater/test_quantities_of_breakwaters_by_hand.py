"""Quantities of a breakwater from parts that are made up: units, words, tables, and what is left out."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.breakwater import quantities


def told(made):
    """{name: (unit, description, table, whether it is a record)}"""
    units = {name: "%" if one.share else one.unit for name, one in made.items()}
    return {name: (units[name], one.description, one.table, one.record) for name, one in made.items()}


def test_pretension_and_tensions_at_the_levels_of_the_tide():
    """At low water 10, at high water 20; the least is not known, the study gives none"""
    keys = "change", "front", "front_at", "back", "back_at"
    levels = [SimpleNamespace(level=name, rise=rise, **{key: 10 * k * (i + 1) for i, key in enumerate(keys)})
              for name, rise, k in (("low", -1.0, 1.0), ("high", 2.0, 2.0))]  # fmt: skip
    held = SimpleNamespace(least=None, used=3e3, most=9e3, given=None, greatest=np.array([5e3, 6e3]))
    asked = SimpleNamespace(waves=SimpleNamespace(height=2.5), design=("taut", "thin"))
    made, axes = quantities.pretension_of(asked, SimpleNamespace(tides=levels, pretension=held))
    assert axes["level"].values.tolist() == ["low", "high"] and axes["end"].values.tolist() == ["front", "back"]
    assert made["tide.rise"].values.tolist() == [-1.0, 2.0]
    title = "greatest amplitudes of tension in waves of 2.5 m"
    for name, k, unit, words in (
        ("change", 10, "N/m", "change of P₀"), ("front", 20, "N/m", "front"), ("front_at", 30, "s", "front, at"),
        ("back", 40, "N/m", "back"), ("back_at", 50, "s", "back, at"),
    ):  # fmt: skip
        one = made[f"tide.{name}"]
        assert one.values.tolist() == [k, 2 * k] and told(made)[f"tide.{name}"] == (unit, words, title, False)
    holding = "pretension P₀ of taut, thin"
    assert told(made)["pretension.used"] == ("N/m", "that is used", holding, False)
    assert made["pretension.used"].values == 3e3
    assert told(made)["pretension.most"] == ("N/m", "most within the allowable tension", holding, False)
    assert made["pretension.most"].values == 9e3 and "pretension.least" not in made
    assert told(made)["pretension.greatest"] == ("N/m", "greatest tension", "lines with this pretension", False)
    assert made["pretension.greatest"].values.tolist() == [5e3, 6e3]
    assert made["pretension.greatest"].axes == ("end",)
    held.given, held.least, held.most = 4e3, 1e3, None
    made, _ = quantities.pretension_of(asked, SimpleNamespace(tides=levels, pretension=held))
    assert made["pretension.used"].description == "of the body" and made["pretension.least"].values == 1e3
    assert "pretension.most" not in made
    made, _ = quantities.pretension_of(asked, SimpleNamespace(tides=levels, pretension=None))
    assert {name.partition(".")[0] for name in made} == {"tide"} and not any(one.table for one in made.values())
    assert quantities.pretension_of(asked, SimpleNamespace(tides=None, pretension=None)) == ({}, {})


def anchor(name, unit, provided=None, used=None):
    return SimpleNamespace(
        name=name, unit=unit, needed=len(name), note=f"of {name}", provided=provided, utilisation=used
    )


def test_anchors_are_needed_and_provided_each_in_its_unit():
    found = SimpleNamespace(anchors=[anchor("pile", "N"), anchor("block", "N/m", 10.0, 0.5)])
    made, axes = quantities.anchors_of(None, found)
    assert made["anchor.needed"].values.tolist() == [4, 5] and made["anchor.needed"].unit == ("N", "N/m")
    assert made["anchor.size"].values.tolist() == ["of pile", "of block"]
    assert axes["anchor"].values.tolist() == ["pile", "block"]
    assert made["anchor.provided"].values == pytest.approx([np.nan, 10.0], nan_ok=True)
    assert made["anchor.used"].values == pytest.approx([np.nan, 0.5], nan_ok=True) and made["anchor.used"].share
    assert {one.table for one in made.values()} == {"anchors"}
    one, _ = quantities.anchors_of(None, SimpleNamespace(anchors=[anchor("pile", "N")]))
    assert one["anchor.needed"].unit == "N" and not one["anchor.provided"].table
    assert quantities.anchors_of(None, SimpleNamespace(anchors=())) == ({}, {})


def sea(**more):
    cells = SimpleNamespace(
        height=4.0, energy=np.array([0.6, 0.4]), width=np.array([0.1, 0.2]), omega=np.array([0.5, 0.7])
    )
    own = {"cells": cells, "waves": 999.6, "heights": {"taut": 1.0, "free": 2.0}, "greatest": None,
           "transmission": {"taut": np.array([0.5, 0.1]), "free": np.array([1.0, 0.2])}}  # fmt: skip
    return SimpleNamespace(sea=SimpleNamespace(**own | more))


def test_the_sea_behind_has_a_share_of_the_height_and_the_square_of_what_passes():
    made, axes = quantities.behind_of(None, sea())
    assert axes["behind"].values.tolist() == ["taut", "free"] and axes["omega"].values.tolist() == [0.5, 0.7]
    assert made["sea.behind"].values.tolist() == [1.0, 2.0] and made["sea.share"].values.tolist() == [0.25, 0.5]
    assert told(made)["sea.share"] == ("%", "of the height", "sea of 4 m", False)
    assert told(made)["sea.behind"] == ("m", "4√m₀ behind", "sea of 4 m", False)
    assert made["sea.height"].values == 4.0 and made["sea.waves"].values == 999.6 and not made["sea.waves"].table
    assert made["sea.spectrum"].values == pytest.approx([6.0, 2.0]) and made["sea.spectrum"].record
    assert made["sea.spectrum_behind"].values == pytest.approx(np.array([[1.5, 6.0], [0.02, 0.08]]))
    assert not any(name.startswith(("sea.amplitude", "sea.least")) for name in made)
    none, _ = quantities.behind_of(None, sea(heights={}, transmission={}))
    assert none["sea.spectrum_behind"].values.shape == (2, 0)
    assert quantities.behind_of(None, SimpleNamespace(sea=None)) == ({}, {})


def test_lines_in_the_sea_have_their_greatest_amplitude_tension_slack_and_deviation():
    pulls = {"greatest": np.array([1.0, 2.0]), "tension": np.array([3.0, 4.0]), "slack": np.array([0.1, 0.2]),
             "deviation": np.array([5.0, 6.0]), "least": 7.0}  # fmt: skip
    made, _ = quantities.behind_of(None, sea(**pulls))
    title = "lines in the greatest of 1000 waves of the sea"
    for name, values, unit, words, table in (
        ("amplitude", [1, 2], "N/m", "greatest amplitude", title),
        ("deviation", [5, 6], "N/m", "standard deviation", ""),
        ("tension", [3, 4], "N/m", "greatest tension at the worst level", title),
        ("slack", [0.1, 0.2], "%", "share of the cycles with slack lines", title),
    ):  # fmt: skip
        assert made[f"sea.{name}"].values.tolist() == values
        assert told(made)[f"sea.{name}"] == (unit, words, table, False)
    assert made["sea.least_pretension"].values == 7.0 and made["sea.least_pretension"].unit == "N/m"


def test_snaps_are_told_with_the_level_and_the_period_they_come_at():
    snap = SimpleNamespace(largest=np.array([9.0, 8.0]), peaks=np.array([7.0, 6.0]), slack=np.array([0.3, 0.4]))
    made, axes = quantities.snapping_of(None, SimpleNamespace(snapping=("high", 6.5, snap)))
    title = "lines that go slack and snap, in time, 6.5 s at high water"
    assert made["snap.level"].values == "high" and made["snap.period"].values == 6.5 and axes == {}
    for name, values, unit, words in (
        ("largest", [9, 8], "N/m", "snaps to"), ("mean", [7, 6], "N/m", "mean of the cycles"),
        ("slack", [0.3, 0.4], "%", "share of the time with slack lines"),
    ):  # fmt: skip
        assert made[f"snap.{name}"].values.tolist() == values
        assert told(made)[f"snap.{name}"] == (unit, words, title, False)
    assert quantities.snapping_of(None, SimpleNamespace(snapping=None)) == ({}, {})


@pytest.mark.parametrize(("sea", "unit", "words"), [("a sea", "m", "4√m₀ behind"), (None, "", "greatest K_T")])
def test_best_designs_have_sizes_in_metres_and_angles_in_radians(sea, unit, words):
    designs = np.array([[3.0, 8.0, 60.0], [4.0, 9.0, 45.0]])
    front = SimpleNamespace(tension=np.array([1.0, 2.0]), behind=np.array([0.3, 0.2]), trials=50,
                            names=("draft", "width", "angle_deg"), designs=designs)  # fmt: skip
    made, axes = quantities.front_of(SimpleNamespace(sea=sea), SimpleNamespace(front=front))
    assert axes["design"].values.tolist() == [1, 2] and told(made) == {
        "design.tension": ("N/m", "greatest tension", "best of 50 designs", False),
        "design.behind": (unit, words, "best of 50 designs", False),
        "design.draft": ("m", "draft", "best of 50 designs", False),
        "design.width": ("m", "width", "best of 50 designs", False),
        "design.angle": ("rad", "lines at", "best of 50 designs", False),
    }  # fmt: skip
    assert made["design.draft"].values.tolist() == [3.0, 4.0] and made["design.width"].values.tolist() == [8.0, 9.0]
    assert made["design.angle"].values == pytest.approx([np.pi / 3, np.pi / 4])
    assert made["design.tension"].values.tolist() == [1.0, 2.0]
    assert made["design.behind"].values.tolist() == [0.3, 0.2]
    assert quantities.front_of(None, SimpleNamespace(front=None)) == ({}, {})


def test_a_row_of_units_has_heights_behind_it_and_the_largest_tension_of_each_line_with_its_place():
    behind, tension = [(10.0, 0.6), (20.0, 0.5)], np.array([[1.0, 5.0, 2.0], [7.0, 4.0, 3.0]])
    lee = SimpleNamespace(units=np.array([[0.0, 0.0], [30.0, 0.0]]), half=(12.5, 4.0), behind=behind,
                          waves="waves of 6 s", ratio=np.arange(6.0).reshape(2, 3), x=np.arange(3.0), y=np.arange(2.0),
                          tension=tension, lines=np.array([-8.0, 0.0, 8.0]))  # fmt: skip
    made, axes = quantities.lee_of(None, SimpleNamespace(lee=lee))
    assert made["lee.behind"].values.tolist() == [0.6, 0.5]
    assert axes["leeward"].values.tolist() == [10.0, 20.0]
    assert made["lee.behind"].table == "behind 2 units of 25 m in waves of 6 s"
    assert made["lee.ratio"].values.tolist() == lee.ratio.tolist() and made["lee.ratio"].record
    assert made["lee.largest"].values.tolist() == [5.0, 7.0] and made["lee.largest"].unit == "N/m2"
    assert made["lee.largest_at"].values.tolist() == [0.0, -8.0] and made["lee.largest_at"].unit == "m"
    assert axes["unit"].values.tolist() == [1, 2] and axes["map_x"].unit == "m"
    assert axes["along"].values.tolist() == [-8, 0, 8]
    lee.tension, lee.units = None, lee.units[:1]
    made, axes = quantities.lee_of(None, SimpleNamespace(lee=lee))
    assert made["lee.behind"].table.startswith("behind 1 unit of 25 m") and "lee.largest" not in made
    assert quantities.lee_of(None, SimpleNamespace(lee=None)) == ({}, {})


def test_tensions_are_those_of_holdings_that_have_them_at_every_period():
    """Afloat without lines; held; held, with no solution at the second of two periods"""
    ends = {"free": [np.nan, np.nan], "held": [3.0, 4.0j], "partly": [5.0, np.nan]}
    curves = [
        SimpleNamespace(name=name, response=SimpleNamespace(front=np.array(front), back=2 * np.array(front),
                        **dict.fromkeys(quantities.PARTS, np.array([k, 1j]))))
        for k, (name, front) in enumerate(ends.items())
    ]  # fmt: skip
    asked = SimpleNamespace(waves=SimpleNamespace(period=np.array([5.0, 6.0])))
    made, axes = quantities.curves_of(asked, SimpleNamespace(curves=curves))
    assert axes["holding"].values.tolist() == list(ends) and axes["held"].values.tolist() == ["held"]
    assert made["front.tension"].values.tolist() == [[3.0], [4.0]] and made["back.tension"].axes == ("period", "held")
    assert made["back.tension"].values.tolist() == [[6.0], [8.0]]
    assert made["sway"].values.tolist() == [[0.0, 1.0, 2.0], [1.0, 1.0, 1.0]]
    made, axes = quantities.curves_of(asked, SimpleNamespace(curves=curves[::2]))
    assert "held" not in axes and not any("tension" in name for name in made)


@pytest.mark.parametrize("words, complex_words", [("", "sway, complex"), ("of sway", "of sway, complex")])
def test_complex_values_stand_beside_their_sizes_under_their_name_or_their_words(words, complex_words):
    made = quantities._moduli("sway", np.array([[3 + 4j]]), ("period", "holding"), "m", words, "motions")
    assert told(made) == {"sway": ("m", words, "motions", False), "sway.complex": ("m", complex_words, "", True)}
    assert made["sway"].values == 5.0 and made["sway.complex"].values == 3 + 4j
