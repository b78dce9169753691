"""Flags over the tables of a scene: each in its table, under its key; what no flag names stays as it was."""

import copy

import pytest

from hakobune.pipelines.scene.flags import SceneFlags, overlaid
from hakobune.pipelines.scene.scene import SceneError

RAW = {
    "tolerance": 0.02, "method": "contour", "wall": 30.0, "rotation_center": [1.0, 2.0, 3.0], "want": ["drift"],
    "water": {"depth": 40.0, "density": 1000.0, "gravity": 9.8},
    "waves": {"periods": [5.0, 6.0], "headings_deg": [0.0, 90.0]},
    "bodies": [{"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0, "mass": 4e6, "GM": 2.0,
                "gyration": [6.0, 7.0, 8.0], "trimmed": True}],
}  # fmt: skip
HULL = RAW["bodies"][0]
CHANGES = {
    "depth": (25.0, "water", {"depth": 25.0}), "density": (1025.0, "water", {"density": 1025.0}),
    "gravity": (9.81, "water", {"gravity": 9.81}), "heading": ("30,60", "waves", {"headings_deg": [30.0, 60.0]}),
    "mass": (5e6, "bodies", {"mass": 5e6}), "gm": (3.0, "bodies", {"GM": 3.0}),
    "gyration": ("1,2,3", "bodies", {"gyration": [1.0, 2.0, 3.0]}),
    "center_of_gravity": ("-1,0,2", "bodies", {"center_of_gravity": [-1.0, 0.0, 2.0]}),
    "trimmed": (True, "bodies", {"trimmed": True}), "method": ("panel", "", {"method": "panel"}),
    "wall": (50.0, "", {"wall": 50.0}), "rotation_center": ("4,5,6", "", {"rotation_center": [4.0, 5.0, 6.0]}),
    "tolerance": (0.1, "", {"tolerance": 0.1}), "only": ("rao, drift ,", "", {"want": ["rao", "drift"]}),
}  # fmt: skip


def changed(table, more):
    """RAW with values in one of its tables, "" for itself"""
    made = copy.deepcopy(RAW)
    (made["bodies"][0] if table == "bodies" else made[table] if table else made).update(more)
    return made


def plain(made):
    """Lists for tuples"""
    if isinstance(made, dict):
        return {key: plain(value) for key, value in made.items()}
    return [plain(one) for one in made] if isinstance(made, list | tuple) else made


def test_without_flags_a_scene_stays_as_it_is():
    before = copy.deepcopy(RAW)
    assert plain(overlaid(RAW, SceneFlags(), {})) == before == RAW


@pytest.mark.parametrize("flag", CHANGES)
def test_a_flag_changes_its_own_key_alone(flag):
    value, table, more = CHANGES[flag]
    before = copy.deepcopy(RAW)
    assert plain(overlaid(RAW, SceneFlags(**{flag: value}), {})) == changed(table, more)
    assert before == RAW


@pytest.mark.parametrize("flag, text, key, values", [
    ("omega", "0.5,0.6", "omegas", [0.5, 0.6]), ("period", "7,8", "periods", [7.0, 8.0]),
])  # fmt: skip
def test_frequencies_take_the_place_of_those_of_the_scene_and_leave_its_headings(flag, text, key, values):
    made = plain(overlaid(RAW, SceneFlags(**{flag: text}), {}))
    assert made["waves"] == {key: values, "headings_deg": [0.0, 90.0]} and made["bodies"] == RAW["bodies"]


def test_a_number_of_panels_keeps_the_tolerance_for_the_checks_and_a_tolerance_takes_the_place_of_panels():
    made = overlaid(RAW, SceneFlags(panels="200"), {})
    assert made["panels"] == 200 and made["tolerance"] == RAW["tolerance"]
    assert overlaid({"panels": 100} | RAW, SceneFlags(tolerance=0.1), {}) == RAW | {"tolerance": 0.1}


def test_sizes_are_of_the_one_body_and_refused_for_several():
    assert overlaid(RAW, SceneFlags(), {"draft": 6.0})["bodies"] == [HULL | {"draft": 6.0}]
    two = RAW | {"bodies": [HULL, HULL]}
    assert overlaid(two, SceneFlags(depth=30.0), {})["bodies"] == [HULL, HULL]
    for flags, body, key in (({"mass": 1.0}, {}, "mass"), ({"center_of_gravity": "0,0,1"}, {}, "center-of-gravity"),
                             ({}, {"draft": 6.0}, "draft")):  # fmt: skip
        with pytest.raises(SceneError, match=rf"^--{key} is for one body, but the scene has 2; give it under \[\[bod"):
            overlaid(two, SceneFlags(**flags), body)
    with pytest.raises(SceneError, match=r"^--omega and --period are given; give only one of them$"):
        overlaid(RAW, SceneFlags(omega="1", period="2"), {})
