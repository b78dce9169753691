"""`hakobune earthquake` as a user calls it."""

from pathlib import Path

import numpy as np
import pytest

import hakobune
from hakobune import pipelines
from hakobune.pipelines import cli

SCENE = Path(pipelines.__file__).parent / "scenes" / "earthquake_box.toml"
T = np.arange(0.0, 8.0, 0.02)


@pytest.fixture
def study(tmp_path):
    """The shipped study with a record of 8 s beside it"""
    shaken = 100 * np.sin(np.pi * T / 8) * np.sin(3.0 * T)
    rows = np.stack([T, shaken], axis=1)
    np.savetxt(tmp_path / "record.csv", rows, delimiter=",", header="time_s,acceleration_gal", comments="")
    path = tmp_path / "earthquake.toml"
    path.write_text(SCENE.read_text() + '\n[record]\nfile = "record.csv"\nafter = 2.0\n')
    return path


def test_methods_stand_beside_each_other_and_the_course_is_kept(study, tmp_path, capsys):
    place = tmp_path / "c.csv"
    assert cli.main(["earthquake", str(study), "--output", str(place), "--plot", str(tmp_path / "p.png")]) == 1
    found = hakobune.earthquake(study)
    assert found["method[seismic coefficient 0.2].over_weight"] == pytest.approx(0.2, rel=1e-12)
    assert np.isnan(found["method[seismic coefficient 0.2].deflection"])
    assert (
        "FAILS: seismic coefficient 0.2: cell 2 m: 3.351e+04 kN act on it, but its table ends at"
    ) in capsys.readouterr().out
    _, names, *rows = place.read_text().splitlines()
    course = dict(zip(names.split(","), np.array([row.split(",") for row in rows], float).T, strict=True))
    largest = np.abs(course["course.reaction [N]"]).max()
    assert found["method[record in time].reaction"] == largest and len(rows) == len(T) + 100
    assert abs(course["course.ground [m]"][-1]) < 1e-9 and (tmp_path / "p.png").stat().st_size > 5000
    # soft fenders keep short periods away
    assert found["normalised[20.0]"][0] > 1.0 > found["normalised[5.0]"][0]


@pytest.mark.parametrize(
    "old, new, says",
    [
        ('motion = "sway"', 'motion = "heave"', "motion is 'heave'; allowed: surge, sway"),
        ("count = 3", "count = 0", "fender.count is 0; allowed: 1 to 1000 on each side"),
        ("[0.1, 0.2, 0.6", "[0.1, 0.6, 0.2", "spectrum.periods are not increasing; allowed: s, above 0, increasing"),
        ("coefficient = 0.2", "coefficient = 0.9", "rule: coefficient of rule A is 0.9; allowed: 0 to 0.3"),
        ("record.csv", "none.csv", "none.csv does not exist"),
    ],
)
def test_a_wrong_study_is_told_in_one_line(study, capsys, old, new, says):
    study.write_text(study.read_text().replace(old, new))
    assert cli.main(["earthquake", str(study)]) == 2
    told = capsys.readouterr().err
    assert says in told and told.count("\n") == 1


@pytest.mark.parametrize(
    "change, says",
    [
        (
            lambda rows: rows[:50] + rows[53:],
            "line 51: the time goes from 0.96 to 1.04 s, and the step elsewhere is 0.02 s: 3 rows are",
        ),
        (lambda rows: rows[:50] + rows[49:], "line 51: the time stays at 0.96 s"),
        (
            lambda rows: rows[:50] + ["1.0,nan"] + rows[51:],
            "line 51 has 'nan'; allowed: finite numbers; fill in the value",
        ),
        (lambda rows: rows[1:], "no column names in its first row; allowed: time_s"),
        (lambda rows: rows[:1], "no rows of numbers"),
        (lambda rows: rows[:1] + [f"{t:g},0" for t in T], "all accelerations of the record are 0"),
    ],
)
def test_a_record_with_gaps_is_told_with_its_line(study, capsys, change, says):
    record = study.with_name("record.csv")
    record.write_text("\n".join(change(record.read_text().splitlines())) + "\n")
    assert cli.main(["earthquake", str(study)]) == 2
    told = capsys.readouterr().err
    assert says in told and "record.csv" in told and told.count("\n") == 1


def test_a_record_that_fenders_do_not_stand_has_no_course_and_the_plot_is_drawn(study, tmp_path, capsys):
    record = study.with_name("record.csv")
    names, *rows = record.read_text().splitlines()
    strong = [f"{t},{30 * float(value)}" for t, value in (row.split(",") for row in rows)]
    record.write_text("\n".join([names, *strong]) + "\n")
    course, plot = tmp_path / "c.csv", tmp_path / "p.png"
    assert cli.main(["earthquake", str(study), "--output", str(course), "--plot", str(plot)]) == 1
    told = capsys.readouterr().out
    assert "FAILS: record in time: " in told
    assert f"warning: {course} is not written, since the record gave no time series" in told
    assert plot.stat().st_size > 5000 and not course.exists()


def test_a_body_comes_from_the_study_or_a_database(study, capsys):
    assert cli.main(["earthquake", str(study), "--database", "box.h5"]) == 2
    assert "[body] and --database: both are given; give one of them" in capsys.readouterr().err


def test_a_course_is_not_asked_for_without_a_record(tmp_path, capsys):
    assert cli.main(["earthquake", str(SCENE), "--output", str(tmp_path / "c.csv")]) == 2
    assert (
        "--output is a time series, which needs [record] in the study; give [record], or an .h5 file"
    ) in capsys.readouterr().err
