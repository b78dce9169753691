"""Appendix 2 of the SR179 report: model M3B at a single point, computed beside what was measured."""

import numpy as np
import pytest

from bem.database import open_database
from pipelines import cli
from pipelines.series.appendix_2 import chains, computed, pitch_amplitude, read_rows, study_of
from pipelines.single_point.tables import make_study

TARGET = 0.382  # °/cm, σ of pitch over σ of the waves, B/d = 10


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """WC3 solved, run and tabulated"""
    place = tmp_path_factory.mktemp("appendix")
    assert cli.main(["series", "appendix-2", "--only", "WC3", "--output", str(place)]) == 0
    return place


def test_pitch_on_a_contact_buoy_is_that_measured_and_a_little_larger_on_an_intermediate_one(folder):
    """Within 5 %; of the 15 to 19 % that were measured only the sign"""
    db = open_database(folder / "M3B_Bd10.h5")
    contact = pitch_amplitude(db, 0.06) / 2 / 1.5
    assert abs(contact / TARGET - 1) < 0.05
    row = row_of(folder)
    intermediate = 2 * float(row["pitch"]) / float(row["height_cm"])
    assert 1.0 < intermediate / contact < 1.19


def row_of(folder):
    text = (folder / "appendix_2.csv").read_text().splitlines()
    return dict(zip(text[1].split(","), text[2].split(","), strict=True))


def test_the_hawser_with_the_buoy_s_mass_is_that_measured_and_without_it_a_fraction(folder):
    """Snaps make the significant load of a record of six minutes scatter by a fifth (eight seeds: 2.8 to 5.1 kgf):
    the mean of four is held to the 40 % of what the tank measured"""
    row, db = row_of(folder), open_database(folder / "M3B_Bd10.h5")
    assert row["case"] == "WC3" and row["slews"] == "no"
    assert float(row["settled"]) < 250
    (given,) = read_rows("WC3")
    others = [computed(given, db, seed) for seed in (2, 3, 4)]
    for column, measured in (("hawser", "hawser_kgf"), ("on_buoy", "buoy_kgf")):
        loads = np.array([float(row[column]), *(getattr(one, column) for one in others)]) / float(row[measured])
        assert abs(loads.mean() - 1) < 0.4
    assert float(row["massless"]) < 0.5 * float(row["on_buoy"])
    assert all(one.massless < 0.5 * one.on_buoy for one in others)


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
