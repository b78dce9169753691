"""Names of load cases and of their files, angles within a turn, and what of a study has to be judged."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.design import cases
from hakobune.pipelines.design.kinds import mooring, needs


@pytest.mark.parametrize("of, name", [
    (("storm", cases.MEAN, 30.0, 0.0, 0.0, None, 1.0), "storm, 30 deg"),
    (("storm", "high", -22.5, 0.0, 0.0, None, 1.0), "storm, high, -22.5 deg"),
    (("storm", cases.MEAN, 30.0, 20.0, 0.0, None, 1.0), "storm, 30 deg, wind +20"),
    (("storm", cases.MEAN, 30.0, 0.0, -45.0, None, 1.0), "storm, 30 deg, current -45"),
    (("storm", cases.MEAN, 30.0, 0.0, 0.0, "bow", 1.0), "storm, 30 deg, without bow"),
    (("storm", cases.MEAN, 30.0, 0.0, 0.0, None, 1.5), "storm, 30 deg, motions x 1.5"),
    (("storm", "low", 0.0, -20.0, 45.0, "bow", 1.25),
     "storm, low, 0 deg, wind -20, current +45, without bow, motions x 1.25"),
])  # fmt: skip
def test_a_case_is_named_by_what_differs_from_the_mean_level_in_line_weather_of_all_lines(of, name):
    assert cases._name(*of) == name


def test_a_case_without_a_line_has_its_weather_and_the_study_without_it():
    case = cases.LoadCase(**dict.fromkeys(cases.LoadCase._fields, None))
    case = case._replace(state="storm", level="low", incidence=30.0, wind_off=5.0, current_off=-6.0, factor=1.5,
                         study="all", name="old")  # fmt: skip
    read = SimpleNamespace(kind=SimpleNamespace(without=lambda study, line: f"{study} but {line}"))
    found = cases.without_line(read, case, "bow")
    assert found == case._replace(
        name="storm, low, 30 deg, wind +5, current -6, without bow, motions x 1.5", lost="bow", study="all but bow"
    )
    assert cases.file_name(found) == "storm_low_30_deg_wind_+5_current_-6_without_bow_motions_x_1.5"
    assert cases.file_name(SimpleNamespace(name="_æ a/b: c_")) == "a_b_c"


@pytest.mark.parametrize("degrees, within", [
    (0.0, 0.0), (360.0, 360.0), (361.0, 1.0), (720.0, 360.0), (721.0, 1.0), (-180.0, -180.0), (359.5, 359.5),
])  # fmt: skip
def test_directions_of_wind_and_current_are_within_a_turn(degrees, within):
    assert cases._turned(degrees) == within


LINES, ROPES = needs.of_lines("lines (types)"), needs.of_lines("ropes (rope)")
FENDERS = needs.Need("fenders (fender)", needs.OF_FENDERS)
HINGES = needs.Need("hinges (hinges)", (needs.HINGE_FORCE, needs.HINGE_MOMENT))
YIELD = needs.Need("dolphins that yield (dolphin)", (needs.DOLPHIN,))


@pytest.mark.parametrize("raw, found", [
    ({}, []), ({"types": {"c": 1}}, [LINES]), ({"rope": [1]}, [ROPES]), ({"rope": []}, []),
    ({"fender": [{"name": "F"}]}, [FENDERS]), ({"hinges": [1]}, [HINGES]), ({"hinges": []}, []),
    ({"fender": [{"name": "F"}], "dolphin": [{"yield_force": 1.0}]}, [FENDERS, YIELD]),
    ({"fender": [{"name": "F", "dolphin_yield": 1.0}]}, [FENDERS, YIELD]),
    ({"fender": [{"name": "F"}], "dolphin": [{"stiffness": 1.0}]}, [FENDERS]),
    ({"dolphin": [{"yield_force": 1.0}]}, []),
    ({"types": {"c": 1}, "rope": [1], "fender": [{"yield_force": 2.0}], "hinges": [1]},
     [LINES, ROPES, FENDERS, HINGES, YIELD]),
])  # fmt: skip
def test_what_a_study_has_that_can_break_needs_a_criterion(raw, found):
    """Hawsers and lines by their tension, fenders by strain or energy, hinges by force or moment"""
    assert mooring.needs(raw) == found


def test_a_part_is_judged_by_a_criterion_of_one_of_its_quantities_and_of_its_subject():
    def criterion(quantity, subject=""):
        return [SimpleNamespace(quantity=quantity, subject=subject)]

    hawsers, others = needs.of_lines("hawsers", hawser=True), needs.of_lines("lines", hawser=False)
    for quantity in (needs.SHARE, *needs.LOADS):
        assert LINES.judged(criterion(quantity)) and LINES.judged(criterion(quantity, needs.HAWSER))
        assert hawsers.judged(criterion(quantity, needs.HAWSER)) and not hawsers.judged(criterion(quantity))
        assert others.judged(criterion(quantity)) and not others.judged(criterion(quantity, needs.HAWSER))
    for quantity in (needs.PRETENSION, needs.HOLDING, "sway"):
        assert not LINES.judged(criterion(quantity))
    assert not LINES.judged([]) and HINGES.judged(criterion("sway") + criterion(needs.HINGE_MOMENT))
