"""Every check of sections side by side on either side of its limit."""

import math
from types import SimpleNamespace

import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.sections import study


def section(**more):
    given = {"beam": 10.0, "draft": 4.0, "mass": None, "gyration": None, "y": 0.0, "center_of_gravity": 1.0}
    return SimpleNamespace(**given | more)


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ({}, None),
        ({"beam": 0.0}, "sections[1].beam is 0"),
        ({"draft": -1.0}, "sections[1].draft is -1"),
        ({"mass": 0.0}, "sections[1].mass is 0"),
        ({"gyration": -2.0}, "sections[1].gyration is -2"),
        ({"mass": 5.0, "gyration": 2.0}, None),
        ({"draft": 20.0}, "sections[1].draft is 20 m in water 20 m deep; allowed: below"),
        ({"draft": 19.0}, None),
        ({"draft": 19.9999999}, "sections[1]: "),
        ({"y": math.inf}, "sections[1].y is inf; allowed: finite, m"),
        ({"center_of_gravity": math.nan}, "sections[1].center_of_gravity is nan; allowed: finite, m"),
    ],
)
def test_a_section_has_sizes_and_water_under_its_keel(more, says):
    if says is None:
        study._check_section("sections[1]", section(**more), 20.0)
    else:
        with pytest.raises(StudyError) as error:
            study._check_section("sections[1]", section(**more), 20.0)
        assert str(error.value).startswith(says)


@pytest.mark.parametrize("position", [(0.0, 0.0), (math.nan, 0.0), (0.0, math.inf)])
@pytest.mark.parametrize(("sections", "kind", "says"), [
    (("a", "b"), study.KINDS[0], None), (("a", "c"), study.KINDS[0], "hinges[0].sections has 'c'; allowed: a, b"),
    (("c", "a"), study.KINDS[0], "hinges[0].sections has 'c'"),
    (("b", "b"), study.KINDS[0], "hinges[0] joins b to itself; allowed: two different sections"),
    (("a", "b"), "glue", "hinges[0].kind is 'glue'; allowed: "),
])  # fmt: skip
def test_a_hinge_joins_two_sections_that_are_there_at_a_finite_place(sections, kind, says, position):
    hinge = SimpleNamespace(sections=sections, kind=kind, position=position)
    if says is None and all(map(math.isfinite, position)):
        study._check_hinge("hinges[0]", hinge, ["a", "b"])
    else:
        with pytest.raises(StudyError) as error:
            study._check_hinge("hinges[0]", hinge, ["a", "b"])
        assert str(error.value).startswith(says or "hinges[0].position")
