"""`hakobune berth` as a user calls it."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import hakobune
from hakobune import pipelines
from hakobune.pipelines import cli

SCENE = Path(pipelines.__file__).parent / "scenes" / "berth_tanker.toml"


def test_example_of_ueda_is_told_drawn_and_written(tmp_path, capsys):
    course, picture = tmp_path / "course.csv", tmp_path / "berth.png"
    for _ in range(2):  # the second time over the first
        assert cli.main(["berth", str(SCENE), "--output", str(course), "--plot", str(picture)]) == 0
    told, result = capsys.readouterr().out, hakobune.berth(SCENE)
    assert result["approach.eccentricity"] == pytest.approx(0.7, rel=1e-12)
    assert result["two_springs.energy"] == pytest.approx(result["approach.energy"], rel=1e-12)
    assert result["approach.energy"] == pytest.approx(3957.5e3, rel=1e-4) and "3957 │ kJ" in told
    names = course.read_text().splitlines()[1].split(",")
    rows = dict(zip(names, np.loadtxt(course, delimiter=",", skiprows=2).T, strict=True))
    assert np.array_equal(rows["course.taken [J]"], result["course.taken"]) and picture.stat().st_size > 10_000
    assert rows["course.taken [J]"].max() == pytest.approx(3957.5e3, rel=1e-4)
    whole = tmp_path / "course.h5"
    assert cli.main(["berth", str(SCENE), "--output", str(whole)]) == 0 and hakobune.read(whole) == result


def test_fifty_berthings_are_compared(capsys):
    assert cli.main(["berth", "--measured"]) == 0
    told = capsys.readouterr().out
    assert "50 ships, 100 contacts" in told and "2.492" in told


@pytest.mark.parametrize(
    "change, says",
    [
        (("speed = 0.15", ""), "approach: speed and speeds: neither is given; give one of them"),
        (("speed = 0.15", "speed = -1"), "approach.speed is -1; allowed: above 0, at most 5"),
        (("speed =", "sped ="), "approach.sped is unknown, speed may be meant; allowed: speed, speeds, angle_deg"),
        (("[[fender]]", "[[fender]]\nx = 200.0"), "fender[0]: the ship does not reach x = 200 m"),
        (("eccentricity = 0.7", ""), "fender[0].x is missing"),
        (("depth = 25.0", "depth = 12.0"), "the depth is 12 m with a draft of 19.7 m"),
        (("eccentricity = 0.7", 'eccentricity = 0.7\nvirtual_mass = "grim"'), "allowed: ueda, vasco_costa, older"),
        (("displacement = 291649.0", ""), "displacement and block coefficient of the ship: neither is given"),
    ],
)
def test_a_wrong_question_is_one_line_and_status_2(change, says, tmp_path, capsys):
    study = tmp_path / "study.toml"
    study.write_text(SCENE.read_text().replace(*change))
    assert cli.main(["berth", str(study)]) == 2
    told = capsys.readouterr()
    assert says in told.err and told.err.count("\n") == 1 and not told.out


def test_a_fender_that_is_too_small_is_told_with_status_1(tmp_path, capsys):
    study = tmp_path / "study.toml"
    study.write_text(SCENE.read_text().replace("length = 20.0", "length = 5.0").replace("dolphin = 34000.0", ""))
    assert cli.main(["berth", str(study)]) == 1
    told = capsys.readouterr().out
    assert "the berthing in time is not computed: v 1 m × 5 m" in told and "give an overload stiffness" in told


def test_fenders_for_a_simulation_lie_along_the_side_of_the_ship_whatever_the_angle_of_its_approach(tmp_path):
    study = tmp_path / "study.toml"
    given = "gap = 0.25\nx = 20.0\n"
    study.write_text(
        SCENE.read_text().replace("eccentricity = 0.7", "angle_deg = 6.0").replace("[[fender]]", f"[[fender]]\n{given}")
    )
    (line,) = (text for text in hakobune.berth(study).notes if "for the top of a simulation" in text)
    half = tomllib.loads(SCENE.read_text())["ship"]["beam"] / 2
    (fender,) = tomllib.loads(line.partition("place of 0: ")[2].replace("; ", "\n"))["fender"]
    assert fender["position"] == pytest.approx([20.0, half + 0.25, 0.0], abs=1e-9)
