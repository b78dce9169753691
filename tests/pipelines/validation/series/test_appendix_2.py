"""Appendix 2 of the SR179 report: model M3B at a single point, computed beside what was measured."""

import csv

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.pipelines import cli
from hakobune.pipelines.single_point.study import make
from hakobune.pipelines.single_point.tables import make_study
from hakobune.pipelines.validation.series.appendix_2 import (
    DURATION,
    ceilings,
    chains,
    pitch_amplitude,
    read_rows,
    study_of,
)

TARGET = 0.382  # °/cm, σ of pitch over σ of the waves, B/d = 10


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """W2 and WC3 solved, run and tabulated"""
    place = tmp_path_factory.mktemp("appendix")
    assert cli.main(["series", "appendix-2", "--only", "W2,WC3", "--output", str(place)]) == 0
    return place


def test_pitch_on_a_contact_buoy_is_that_measured_and_a_little_larger_on_an_intermediate_one(folder):
    """Within 5 %; of the 15 to 19 % that were measured only the sign"""
    db = open_database(folder / "M3B_Bd10.h5")
    contact = pitch_amplitude(db, 0.06) / 2 / 1.5
    assert abs(contact / TARGET - 1) < 0.05
    for row in rows_of(folder):
        intermediate = 2 * float(row["pitch"]) / float(row["height_cm"])
        assert 1.0 < intermediate / contact < 1.19


def test_no_sea_of_any_period_pitches_the_free_model_as_far_as_was_measured_on_an_intermediate_buoy(folder):
    """0.400 °/cm at most, where the tests on the intermediate buoy have 0.45 and those on a contact buoy 0.382"""
    db = open_database(folder / "M3B_Bd10.h5")
    (line,) = ceilings({"10": db})
    most = float(line.split(" °/cm")[0].split()[-1])
    assert TARGET < most < 0.41
    measured = [2 * float(row["pitch_deg"]) / float(row["height_cm"]) for row in rows_of(folder)]
    assert min(measured) > 1.1 * most


def test_drift_that_stored_waves_do_not_tell_well_is_told_of(folder):
    (given,) = read_rows("WC3")
    made = make(make_study(study_of(given)), open_database(folder / "M3B_Bd10.h5"))
    assert [line for line in made.findings if line.startswith("mean drift of the waves is uncertain by ")]


def rows_of(folder):
    """W2 and WC3"""
    return list(csv.DictReader((folder / "appendix_2.csv").read_text().splitlines()[1:]))


def test_hawsers_of_a_buoy_with_mass_are_those_measured_and_without_it_a_fraction(folder):
    """Mean of the highest third of the crests: 3.3 kgf of 3.70 measured, and 2.8 of 2.95; seeds scatter by 11 and 4 %,
    and the loads of one hawser by as much, so that one record is held to the 40 %; the heading comes to rest within
    the run, after 190 to 299 s by eight seeds: which of them a processor's last digit makes of this one is chance"""
    for row in rows_of(folder):
        for column, measured in (("hawser", "hawser_kgf"), ("on_buoy", "buoy_kgf")):
            assert abs(float(row[column]) / float(row[measured]) - 1) < 0.4, (row["case"], column)
        assert float(row["massless"]) < 0.5 * float(row["on_buoy"])
        assert row["slews"] == "no"
        assert float(row["settled"]) < DURATION


def test_every_test_is_a_study():
    rows = read_rows()
    assert len(rows) == 44
    for row in rows:
        study = make_study(study_of(row))
        assert (study.hawser is None) == (row["buoy"] == "contact")


def test_chains_for_the_prototype_are_those_of_the_report():
    """Grade 3: 36 mm; the report's 42 mm of grade 2 would break 5 % below the load by today's rules"""
    found = list(chains())
    assert "grade 3: 36 mm" in found[1] and "grade R3S: 32 mm" in found[2] and "grade 2: 44 mm" in found[0]
    assert np.all(["105.5 tonf" in line for line in found])
