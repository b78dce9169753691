"""The result of sections side by side, with the water replaced: from left to right, in units of a metre of length."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.sections import side_by_side as sections
from hakobune.pipelines.sections.study import make_study

SECTION = {"beam": 20.0, "draft": 5.0}
STUDY = {
    "water": {"depth": 30.0, "density": 1000.0, "gravity": 9.8}, "omegas": [0.4, 0.6], "damping": 0.03,
    "sections": [SECTION | {"name": "right", "y": 25.0, "fixed": True}, SECTION | {"name": "left", "y": -25.0},
                 SECTION | {"name": "middle", "y": 0.0, "gyration": 7.0, "mass": 9e4, "center_of_gravity": -1.0}],
}  # fmt: skip


@pytest.fixture
def made(monkeypatch):
    def call(hinges=(), fails=False):
        asked = []

        def linked(*given, **water):
            if fails:
                raise ValueError("the gap is too narrow")
            asked.append((*given, water))
            k = len(asked)
            size = len(hinges)
            return SimpleNamespace(
                transmission=0.3j * k, reflection=-0.1 * k, taken=0.05 * k, gains=np.array([2.0, 3.0]) * k,
                motions=np.arange(9.0).reshape(3, 3) * -1j * k, held=np.arange(3.0 * size).reshape(size, 3) * -10.0 * k,
            )  # fmt: skip

        monkeypatch.setattr(sections, "linked_sections", linked)
        return sections.side_by_side(make_study(STUDY | {"hinges": list(hinges)})), asked

    return call


def test_sections_go_from_left_to_right_and_each_that_moves_has_its_motions(made):
    result, asked = made()
    assert [(one[1], one[2], one[3], one[4]) for one in asked] == [(30.0, 0.4, [], 0.03), (30.0, 0.6, [], 0.03)]
    assert asked[0][5] == {"density": 1000.0, "gravity": 9.8}
    left, middle, right = asked[0][0]
    assert [one.y for one in (left, middle, right)] == [-25.0, 0.0, 25.0] and right.fixed and not left.fixed
    assert left.gyration == pytest.approx(np.hypot(20, 5) / np.sqrt(12)) and middle.gyration == 7.0
    assert (middle.mass, middle.center) == (9e4, -1.0)
    assert result["waves.transmission"] == pytest.approx([0.3, 0.6])
    assert result["waves.reflection"] == pytest.approx([0.1, 0.2])
    assert result["waves.taken"] == pytest.approx([0.05, 0.1])
    assert result["gap.gain"] == pytest.approx(np.array([[2, 4], [3, 6]]))
    assert list(result.labels["gap"].values) == ["left and middle", "middle and right"]
    assert result["left.motion"] == pytest.approx(np.array([[0, 0], [1, 2], [2, 4]]))
    assert result["middle.motion"] == pytest.approx(np.array([[3, 6], [4, 8], [5, 10]]))
    assert "right.motion" not in result and not [name for name in result if name.startswith("hinge")]
    assert result.quantities["left.motion"].unit == ("m/m", "m/m", "rad/m")
    assert list(result.labels["motion"].values) == ["sway", "heave", "roll"]
    assert result.labels["omega"].values.tolist() == [0.4, 0.6] and result.labels["omega"].unit == "rad/s"
    assert list(result.labels["section"].values) == ["left", "middle", "right"] and len(result.detail) == 2


PIN = {"sections": ["right", "left"], "position": [1.0, -2.0]}
FIXED = {"sections": ["left", "middle"], "position": [3.0, 0.0], "kind": "rigid"}


@pytest.mark.parametrize("hinges, parts", [([PIN], ("sway", "heave")), ([PIN, FIXED], ("sway", "heave", "roll"))])
def test_hinges_carry_forces_and_rigid_ones_moments(made, hinges, parts):
    """Of two frequencies; numbers of sections are those from left to right"""
    result, asked = made(hinges)
    given = asked[0][3]
    assert [(one.sections, one.y, one.z) for one in given] == [((2, 0), 1.0, -2.0), ((0, 1), 3.0, 0.0)][: len(hinges)]
    assert [name for name in result if name.startswith("hinge.")] == [f"hinge.{part}" for part in parts]
    for i, part in enumerate(parts):
        one = result.quantities[f"hinge.{part}"]
        assert one.values == pytest.approx(
            np.array([[10.0 * (3 * h + i), 20.0 * (3 * h + i)] for h in range(len(hinges))])
        )
        assert one.unit == ("N m/m" if part == "roll" else "N/m")
    assert list(result.labels["hinge"].values) == ["right and left", "left and middle"][: len(hinges)]


def test_what_the_water_refuses_is_told_as_of_the_study(made):
    with pytest.raises(StudyError, match="the gap is too narrow"):
        made(fails=True)
