"""Appendix 2 of the SR179 report: model M3B at a single point, computed beside what was measured."""

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.pipelines.single_point.study import make as point_of
from hakobune.pipelines.single_point.tables import make_study
from hakobune.pipelines.validation.series.appendix_2 import (
    DURATION,
    ceilings,
    chains,
    make,
    pitch_amplitude,
    read_tests,
    study_of,
    summary,
)

TARGET = 0.382  # °/cm, σ of pitch over σ of the waves, B/d = 10


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Database of the model, and rows of W2 and WC3, solved and run"""
    place = tmp_path_factory.mktemp("appendix")
    rows = make(place, only="W2,WC3").detail["test"]
    return open_database(place / "M3B_Bd10.h5"), rows


def test_pitch_on_a_contact_buoy_is_that_measured_and_a_little_larger_on_an_intermediate_one(made):
    """Within 5 %; of the 15 to 19 % that were measured only the sign"""
    contact = pitch_amplitude(made[0], 0.06) / 2 / 1.5
    assert abs(contact / TARGET - 1) < 0.05
    for row in made[1]:
        intermediate = 2 * row["pitch_deg"] / row["height_cm"]
        assert 1.0 < intermediate / contact < 1.19


def test_no_sea_of_any_period_pitches_the_free_model_as_far_as_was_measured_on_an_intermediate_buoy(made):
    """0.400 °/cm at most, where the tests on the intermediate buoy have 0.45 and those on a contact buoy 0.382"""
    db, rows = made
    (line,) = ceilings({"10": db})
    most = float(line.split(" °/cm")[0].split()[-1])
    assert TARGET < most < 0.41
    measured = [2 * row["measured_pitch_deg"] / row["height_cm"] for row in rows]
    assert min(measured) > 1.1 * most


def test_drift_that_stored_waves_do_not_tell_well_is_told_of(made):
    (given,) = read_tests("WC3")
    point = point_of(make_study(study_of(given)), made[0])
    assert [line for line in point.findings if line.startswith("mean drift of the waves is uncertain by ")]


def test_hawsers_of_a_buoy_with_mass_are_those_measured_and_without_it_a_fraction(made):
    """Mean of the highest third of the crests: 3.3 kgf of 3.70 measured, and 2.8 of 2.95; seeds scatter by 11 and 4 %,
    and the loads of one hawser by as much, so that one record is held to the 40 %; the heading comes to rest within
    the run, after 190 to 299 s by eight seeds: which of them a processor's last digit makes of this one is chance"""
    for row in made[1]:
        for column in ("hawser_kgf", "buoy_kgf"):
            assert abs(row[column] / row[f"measured_{column}"] - 1) < 0.4, (row["case"], column)
        assert row["massless_buoy_kgf"] < 0.5 * row["buoy_kgf"]
        assert not row["slews"]
        assert row["settled_s"] < DURATION


def test_every_test_is_a_study():
    rows = read_tests()
    assert len(rows) == 44
    for row in rows:
        study = make_study(study_of(row))
        assert (study.hawser is None) == (row["buoy"] == "contact")


def test_the_chain_of_the_prototype_follows_from_the_scale_and_its_grade():
    """1.5 kgf · 26³ · 4 = 105.5 tonf: d of the first millimetre that bears it; the 42 mm of grade 2 break 5 % below"""
    for line in chains():
        assert line.startswith("chain for 105.5 tonf (1.5 kgf × 26³ × 4), grade ")
    # IACS A1: 0.00981 d² (44 − 0.08 d), 0.01373 and 0.0196 kN of grades 1, 2 and 3
    for grade, factor, printed in (("2", 0.01373, 42), ("3", 0.0196, 36)):
        line = next(one for one in chains() if f"grade {grade}:" in one)
        bears = lambda d, f=factor: f * d * d * (44 - 0.08 * d) / 9.80665  # noqa: E731
        first = next(d for d in range(10, 200) if bears(d) >= 105.456)
        assert f"grade {grade}: {first} mm computed; the report has {printed} mm" in line
        assert float(line.split("breaks at ")[1].split()[0]) == pytest.approx(bears(printed), rel=5e-3)


def of_point(case, measured, **more):
    height, pitch, hawser, buoy = measured
    row = {"case": case, "buoy": "intermediate", "B_over_d": "10", "height_cm": height, "current_cm_s": 0.0,
           "pitch_deg": 1.6, "hawser_kgf": 2.0, "buoy_kgf": 3.5, "massless_buoy_kgf": 1.0, "settled_s": 100.0,
           "slews": False, "measured_pitch_deg": pitch, "measured_hawser_kgf": hawser,
           "measured_buoy_kgf": buoy}  # fmt: skip
    return row | more


def test_means_of_all_tests_stand_beside_those_measured():
    """W2 and W1: 6.45 and 4.59 cm, 1.445 and 1.08°, 2.08 and 1.14 kgf of a hawser; σ over σ is twice the ratio"""
    said = list(summary([of_point("W2", (6.45, 1.445, 2.08, 3.7)),
                         of_point("W1", (4.59, 1.08, 1.14, 1.89), settled_s=np.nan, slews=True)]))  # fmt: skip
    ours, measured = (np.mean([2 * a / 6.45, 2 * b / 4.59]) for a, b in ((1.6, 1.6), (1.445, 1.08)))
    assert said[0] == f"B/d 10, intermediate: σ of pitch over σ of the waves {ours:.3f} °/cm, measured {measured:.3f}"
    assert "waves alone, 2 tests: 2.00 kgf of a hawser at the bow, measured 1.61" in said
    assert said[2].startswith("waves alone, 2 tests: 3.50 kgf on the buoy, 1.00 without its mass, measured 2.")
    assert said[-1] == "slewing continues in W1 of 2; the heading comes to rest in 1"
