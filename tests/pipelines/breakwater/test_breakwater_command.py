"""`hakobune breakwater` as a person runs it."""

import re
from pathlib import Path

import numpy as np
import pytest

from hakobune import pipelines
from hakobune.pipelines.breakwater.result import breakwater
from hakobune.pipelines.cli import main
from hakobune.pipelines.results.file import read

SCENES = Path(pipelines.__file__).parent / "scenes"
TONNE = 9800.0  # N, of the paper
RECTANGLE = """
holdings = ["fixed", "free", "taut", "elastic"]
[water]
depth = 10.0
[section]
shape = "rectangle"
beam = 10.0
height = 6.7
draft = 5.0
[body]
free_draft = 3.4
center_of_gravity = 3.4
gyration = 4.4
[lines]
angle_deg = 44.0
attachment = 5.0
axial_stiffness_kN = 1e5
[waves]
height = 1.5
periods = [6.0, 8.0, 10.0]
"""
SINKER = "[anchors]\nsinker = { friction = 0.3, width = 9.0, unit_weight_kN_per_m3 = 67.0 }\n[lines]"


def run(folder, text, *words):
    (folder / "study.toml").write_text(text)
    return main(["breakwater", str(folder / "study.toml"), *words])


def test_the_paper_is_followed_from_waves_to_anchors(tmp_path, capsys):
    """Kihara, Kitatani & Todoroki (1975), chapter 6, whose tensions are read from a chart, within 5 %"""
    words = ["--output", str(tmp_path / "out.h5"), "--plot", str(tmp_path / "out.png")]
    assert main(["breakwater", str(SCENES / "breakwater_circle.toml"), *words]) == 0
    found = read(tmp_path / "out.h5", "breakwater")
    assert found["sea[fixed, long waves].behind"] == pytest.approx(1.160, rel=2e-3)
    assert found["anchor[sinker of both lines].needed"] / TONNE == pytest.approx(39.5, rel=2e-3)
    assert found["pretension.greatest"] / TONNE == pytest.approx([30.4, 25.3], rel=0.05)
    assert found["pretension.least"] / TONNE == pytest.approx(14.6, rel=0.05)
    fixed = found.labels["holding"].values == "fixed"
    assert abs(found["check.energy"][:, fixed]).max() < 1e-6 and found["check.haskind"].max() < 1e-5
    sea, least = found["sea.tension"], found["sea.least_pretension"]
    worst = np.maximum(found["tide.front"], found["tide.back"])
    margins = found["pretension.used"] + found["tide.change"] - worst
    assert min(margins) == pytest.approx(0, abs=1e-6 * TONNE)  # the least pretension is just enough at one level
    said = capsys.readouterr().out
    # pretension, high water and the greatest of 2069 waves of the sea: 139.4 + 34.59 + 138.2 kN/m
    assert sea[0] == pytest.approx(312.1e3, rel=1e-3) and 34.59e3 < least < 34.59e3 + 138.1e3
    needed = f"lines that stay taut in this wave need a pretension of {least / 1e3:.4g} kN/m"
    assert f"front 312.2 kN/m for 290.2; {needed}" in said
    assert "waves of 3 m break at 3 of 86 periods" in said and (tmp_path / "out.png").stat().st_size > 10_000


def test_holdings_stand_side_by_side_and_a_second_run_replaces_the_first(tmp_path, capsys):
    out = tmp_path / "out.csv"
    for _ in range(2):
        assert run(tmp_path, RECTANGLE, "--output", str(out)) == 0
    found = breakwater(tmp_path / "study.toml")
    assert found.to_csv() in out.read_text()
    assert list(found.labels["holding"].values) == ["fixed", "free", "taut", "elastic"]
    assert np.hypot(found["transmission"], found["reflection"]) == pytest.approx(np.ones((3, 4)), abs=1e-6)
    assert "free" not in found.labels["held"].values
    out.write_text("not ours\n")
    assert run(tmp_path, RECTANGLE, "--output", str(out)) == 2
    assert "is not replaced" in capsys.readouterr().err


def test_lines_without_enough_pretension_are_said_to_go_slack(tmp_path, capsys):
    text = RECTANGLE.replace("free_draft = 3.4", "free_draft = 4.9").replace("1e5", "1e3")
    assert run(tmp_path, text) == 1
    said = capsys.readouterr().out
    assert "FAILS: lines go slack: front at mean water" in said and "lines that go slack and snap, in time" in said
    assert all(word in said for word in ("mean of the", "cycles"))


def test_lines_that_the_sea_takes_slack_and_a_sinker_up_to_the_keel_are_told(tmp_path, capsys):
    sea = "[sea]\nspectrum = 'bretschneider'\nheight = 1.5\nsignificant_period = 7.0\n"
    narrow = SINKER.replace("width = 9.0", "width = 1.0")
    assert run(tmp_path, RECTANGLE.replace("[lines]", narrow) + sea) == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "FAILS: lines go slack" not in said and "FAILS: the pretension of" in said
    assert "taut in this wave need a pretension of" in said
    assert re.search(r"sinker, front is [\d.]+ m high, .*5 m under the keel; allowed: up to 2.5 m; give a width", said)


def test_loss_under_the_keel_takes_from_what_is_transmitted(tmp_path, capsys):
    behind = []
    for coefficient in (0, 2):
        text = RECTANGLE + f"[loss]\ncoefficient = {coefficient}\n"
        assert run(tmp_path, text, "--output", str(tmp_path / "out.h5")) == 0
        found = read(tmp_path / "out.h5", "breakwater")
        behind.append(found["transmission"][:, found.labels["holding"].values == "taut"])
    assert np.all(behind[1] < behind[0])
    assert run(tmp_path, RECTANGLE + "[loss]\ncoefficient = -1\n") == 2
    assert "loss.coefficient is -1" in capsys.readouterr().err


def test_the_best_designs_trade_tension_for_what_is_left_behind(tmp_path, capsys):
    ranges = "[optimisation]\ndraft = [4.5, 6.5]\nwidth = [8.0, 12.0]\nsamples = 8\nlimits = 2\nbehind = 0.1\n"
    assert run(tmp_path, RECTANGLE + ranges, "--output", str(tmp_path / "out.h5")) == 1
    found = read(tmp_path / "out.h5", "breakwater")
    best = {name: found[f"design.{name}"] for name in ("tension", "behind", "draft", "width")}
    assert len(best["tension"]) > 1
    assert np.all(np.diff(best["tension"]) > 0) and np.all(np.diff(best["behind"]) < 0)
    assert np.all((best["draft"] >= 4.5) & (best["draft"] <= 6.5) & (best["width"] >= 8) & (best["width"] <= 12))
    assert "FAILS: no design transmits 0.1 or less" in capsys.readouterr().out
    # a design of the front is a study of its own: as it is printed, it transmits and pulls as is said
    d, b = best["draft"][0], best["width"][0]
    text = RECTANGLE.replace('"fixed", "free", "taut", "elastic"', '"taut"')
    text = text.replace("beam = 10.0\nheight = 6.7\ndraft = 5.0", f"beam = {b}\nheight = {6.7 * d / 5}\ndraft = {d}")
    text = text.replace(
        "3.4\ncenter_of_gravity = 3.4\ngyration = 4.4",
        f"{3.4 * d / 5}\ncenter_of_gravity = {3.4 * d / 5}\ngyration = {0.44 * b}",
    )
    text = text.replace("attachment = 5.0", f"attachment = {b / 2}")
    assert run(tmp_path, text, "--output", str(tmp_path / "one.h5")) == 0
    found = read(tmp_path / "one.h5", "breakwater")
    assert max(found["pretension.greatest"]) == pytest.approx(best["tension"][0], rel=1e-9)
    assert found["transmission"].max() == pytest.approx(best["behind"][0], rel=1e-9)


FAULTS = {
    ("angle_deg = 44.0", "angle_deg = 158.0\nattachment_height = 3.0"): "passes through the body",
    ("angle_deg = 44.0", "angle_deg = 44.0\nlength = 8.0"): "but a line at 44° reaches the bed after 7.198 m",
    ("free_draft = 3.4", "free_draft = 5.1"): "the pretension is negative",
    ("free_draft = 3.4", ""): "the body's weight: nothing is given",
    ("height = 6.7", "height = 4.9"): "draft is 5 m, but the section is 4.9 m high",
    ("draft = 5.0", "draft = 5.0\nradius = 3"): "section.radius is unknown",
    ("depth = 10.0", "depth = 4.0"): "draft is 5 m in 4 m of water",
    ("depth = 10.0", "depth = 10.0\ntide = 2.0"): "with the water at +2 m: draft is 7 m, but the section is 6.7 m high",
    ("height = 1.5", "height = 90.0"): "waves break at every period;",
    ("periods = [6.0, 8.0, 10.0]", "periods = [0]"): "waves.periods has 0 s",
    ("[waves]", "[optimisation]\ndraft = [5.0, 4.0]\n[waves]"): "optimisation.draft is from 5 to 4",
    ("center_of_gravity = 3.4", "center_of_gravity = nan"): "body.center_of_gravity is nan",
    ("[lines]\nangle_deg = 44.0", f"{SINKER}\nangle_deg = 90.0"): "give lifted = true",
    ("axial_stiffness_kN = 1e5", ""): "lines.axial_stiffness_kN is missing",
    ("axial_stiffness_kN = 1e5", "axial_stiffness_kN = 100"): "more than half of its length;",
    ("axial_stiffness_kN = 1e5", "axial_stiffness_kN = -1e5"): "lines.axial_stiffness_kN is -100000; allowed: above 0",
    ("free_draft = 3.4", "mass_t_per_m = 60"): "the pretension is negative",
}
OUTLINE = 'shape = "outline"\npoints = {}\ndraft = 2.0'
OUTLINES = {
    "[[-3, 0], [3, 0], [3, 4], [-3, 4]]": "the outline is not closed: the last point is 4 m from the first",
    "[[-3, 0], [3, 4], [3, 0], [-3, 4], [-3, 0]]": "crosses itself: edges 1 and 3",
    "[[-3, 0], [3, 0, 1, 1], [-3, 0]]": "section.points[1] has 4 numbers",
}


@pytest.mark.parametrize("change", FAULTS, ids=lambda change: change[1].splitlines()[-1] if change[1] else change[0])
def test_what_cannot_be_is_one_line(change, tmp_path, capsys):
    assert run(tmp_path, RECTANGLE.replace(*change)) == 2
    said = capsys.readouterr().err
    assert said.startswith("hakobune breakwater: ") and said.count("\n") == 1
    assert FAULTS[change] in said


def test_lines_beside_the_body_and_waves_that_break_are_warned_of(tmp_path, capsys):
    text = RECTANGLE.replace('"fixed", "free", "taut", "elastic"', '"taut"').replace(
        "attachment = 5.0", "attachment = 7.0"
    )
    assert run(tmp_path, text.replace("[6.0,", "[2.0, 6.0,").replace("height = 1.5", "height = 1.0")) == 0
    said = capsys.readouterr().out
    assert "2 m off the body: the lines are computed as if rigid arms held them there" in said
    assert "waves of 1 m break at 1 of 4 periods, up to 2 s, where the highest possible wave is 0.887 m (Miche)" in said


@pytest.mark.parametrize("points", OUTLINES)
def test_an_outline_that_is_none_is_one_line(points, tmp_path, capsys):
    text = RECTANGLE.replace('shape = "rectangle"\nbeam = 10.0\nheight = 6.7\ndraft = 5.0', OUTLINE.format(points))
    assert run(tmp_path, text) == 2
    assert OUTLINES[points] in capsys.readouterr().err


def test_short_crests_and_waves_at_an_angle_pass_a_rectangle(tmp_path, capsys):
    """Under a keel of half the depth more passes at an angle; energy is kept there too"""
    sea, behind = '[sea]\nspectrum = "bretschneider"\nheight = 1.0\nsignificant_period = 6.0\n', []
    text = RECTANGLE.replace('"fixed", "free", "taut", "elastic"', '"fixed"')
    for spread in ("", 'spreading = "cosine:4"\n'):
        assert run(tmp_path, text + sea + spread, "--output", str(tmp_path / "out.h5")) == 0
        behind.append(read(tmp_path / "out.h5", "breakwater")["sea[fixed].behind"])
    assert 1.005 * behind[0] < behind[1] < 1.1 * behind[0]
    oblique = text.replace("height = 1.5\n", "height = 1.5\nobliquity_deg = 50\n")
    assert run(tmp_path, oblique, "--output", str(tmp_path / "out.h5")) == 0
    found = read(tmp_path / "out.h5", "breakwater")
    assert abs(found["check.energy"]).max() < 1e-6 and found["check.haskind"].max() < 1e-5
    capsys.readouterr()
    assert run(tmp_path, oblique + "[loss]\ncoefficient = 1\n") == 2
    assert "loss is given with waves at an angle" in capsys.readouterr().err


def test_a_row_of_units_of_a_database_shelters_what_lies_behind(tmp_path, capsys):
    box = ["--length", "60", "--beam", "10", "--draft", "5", "--depth", "10", "--tolerance", "1e-3"]
    box += ["--omega", "0.7,0.9,1.1,1.3", "--heading", "0:180:13"]
    only = ["--only", "added_mass,radiation_damping,excitation_force,kochin_radiation,kochin_diffraction"]
    assert main(["box", *box, *only, "--output", str(tmp_path / "box.h5")]) == 0
    words = ["--database", str(tmp_path / "box.h5"), "--output", str(tmp_path / "out.h5")]
    text, behind = RECTANGLE.replace('"fixed", "free", "taut", "elastic"', '"taut"'), []
    for table in ("period = 7\n", "period = 7\nunits = 3\ngap = 60\n", "period = 7\nunits = 3\ngap = 12\n"):
        picture = ["--map-plot", str(tmp_path / "map.png")] if behind else []  # the first says how to have it
        assert run(tmp_path, text + "[map]\npoints = 31\n" + table, *words, *picture) == 0
        found = read(tmp_path / "out.h5", "breakwater")
        behind.append(found["lee.behind"][0])
        assert found["lee.ratio"].shape == (31, 31)
        section, pulls = found["transmission"][0, 0], found["lee.tension"]
    assert section < behind[2] < behind[1] < 1  # the narrower the gaps the quieter behind
    assert (tmp_path / "map.png").stat().st_size > 10_000
    said = " ".join(capsys.readouterr().out.split())
    assert said.count("--map-plot map.png draws them") == 1
    assert (
        "behind 3 units of 60 m in regular waves of 7 s" in said
        and ("lines of a single unit, per metre of wave amplitude") in said
    )
    assert pulls.shape[0] == 2 and np.all(np.ptp(pulls, axis=1) < 1e-6 * pulls.max(axis=1))  # alike in beam seas
    for change, said in {
        "period = 3\n": "map.period is 3 s; the database covers",
        "period = 7\ngap = 3\n": "map.gap is 3 m; allowed: 0 with one unit",
        "units = 2\ngap = 3\n": "map needs waves",
    }.items():
        assert run(tmp_path, text + "[map]\n" + change, *words) == 2
        assert said in capsys.readouterr().err
    assert run(tmp_path, text.replace("draft = 5.0", "draft = 4.5") + "[map]\nperiod = 7\n", *words) == 2
    assert "draft is 5 in the database and 4.5 in the study" in capsys.readouterr().err
    assert run(tmp_path, text + "[map]\nperiod = 7\n") == 2
    assert "give --database" in capsys.readouterr().err
