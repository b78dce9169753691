"""`hakobune single-point`: what it answers, what it writes, and one line on every fault of a study."""

import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.single_point.equilibria import bow, equilibria, preferred
from hakobune.mooring.single_point.in_time import ropes_of
from hakobune.pipelines import cli
from hakobune.pipelines.common.weather.streams import with_files
from hakobune.pipelines.results.file import read
from hakobune.pipelines.single_point.maps import _named, with_value
from hakobune.pipelines.single_point.result import single_point
from hakobune.pipelines.single_point.study import make
from hakobune.pipelines.single_point.tables import make_study

STUDY = (Path(__file__).parents[3] / "pipelines" / "scenes" / "single_point_A.toml").read_text()


def run(tmp_path, text, *flags, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "study.toml").write_text(text)
    return cli.main(["single-point", "study.toml", *flags])


def test_a_study_gives_headings_criterion_results_plan_and_map(tmp_path, monkeypatch, capsys):
    text = STUDY + "\n[hawser]\nlength = 25.0\n\n[[maps]]\n"
    text += 'x = { key = "hawser.length", from = 10, to = 90, count = 3 }\n'
    text += 'y = { key = "hull.length_over_beam", from = 1.98, to = 2.02, count = 2 }\n'
    assert run(tmp_path, text, "--output", "a.h5", "--plot", "a.png", monkeypatch=monkeypatch) == 0
    said = capsys.readouterr().out
    assert "map over hawser.length" in said and "beam_over_draft = 10" in said
    assert {p.name for p in tmp_path.iterdir()} == {"study.toml", "a.h5", "a.png", "a_slewing.png"}
    found = read(tmp_path / "a.h5", "single-point")
    assert list(found["rest.stable"]) == [True, False] and abs(np.degrees(found["rest.heading"][0]) - 15) < 5
    assert found["slewing"] == "stable" and found["heading"] == found["rest.heading"][0]
    assert found["rest.line"].shape == (2, 6) and found.quantity("rest.line").unit == "N"
    assert found["map_1.growth"].shape == (2, 3)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("turning = { beam_over_draft = 10.0 }", "turning = {}", "B/d = 5 is outside the turning tests (9.75 to 20.5)"),
        ("beam_over_draft = 10.0", "beam_over_draft = 0.0", "turning.beam_over_draft is 0; allowed: above 0"),
        ("depth = 14.0", "depth = 11.0", "H/d = 1.1 is outside the turning tests (1.2 to inf); give "
         "current.turning with the proportion to use instead (depth_over_draft = 8)"),
        ("beam = 50.0", "beam = 20.0", "a ship of L/B = 5 lies at another heading with another pull; give current"),
        ("beam = 50.0", "beam = 30.0", "(length_over_beam = 2, depth_over_draft = 8), or coefficients"),
        ("turning = { beam_over_draft = 10.0 }", 'turning = {}\nfile = "a.csv"', "turning and file are both given"),
        ("[wind]", "[hawser]\nlength = 0.0\n[wind]", "hawser.length is 0 m; allowed: above 0; leave out [hawser]"),
        ("[wind]", "[hawser]\nlength = 4.0\ncount = 2\nspacing = 20.0\n[wind]", "do not meet ahead"),
        ("length = 150.0", "length = 8.0", "lines of 8 m cannot reach the bed 11 m below the buoy"),
        ("z = -3.0", "z = -3.0\nmass = 500.0\ndiameter = 8.0\nheight = 5.0", "mass is 500 t; allowed: below 257.6 t"),
        ("z = -3.0", "z = -3.0\nmass = 240.0\ndiameter = 8.0\nheight = 5.0", "its lines pull it down"),
        ("top_tension_tonf = 15.0", "top_tension_tonf = 1.0", "top_tension is 9.807 kN; allowed: above 26.04"),
        ("drift_tonf_per_m2 = 4.988", "", "the wave drift is unknown"),
        ("[mass]\nadded_surge = 0.1\nadded_sway = 0.6\nadded_yaw = 0.4\n", "", "mass is missing"),
        ("[attachment]\nx = 50.0", "[attachment]\nw = 50.0", "attachment.w is unknown"),
        ("[attachment]\nx = 50.0", "[attachment]\nx = 5e4", "attachment.x is 50000 m; allowed: -100 to 100"),
        ("speed = 25.0", "speed = 9e4", "the lines do not hold"),
    ],
)  # fmt: skip
def test_a_fault_is_one_line(old, new, said, tmp_path, monkeypatch, capsys):
    assert old in STUDY
    assert run(tmp_path, STUDY.replace(old, new), monkeypatch=monkeypatch) == 2
    shown = capsys.readouterr().err
    assert said in shown and shown.count("\n") == 1, shown


@pytest.mark.parametrize(
    "depth, sizes, said",
    [
        (20.0, {}, "water.depth is 14 m, but the database is for 20 m; allowed: the same depth"),
        (
            14.0,
            {"length": 90.0, "beam": 50.0, "draft": 10.0},
            "hull.length is 100 m, but the database is for 90 m; change it, or give another database",
        ),
    ],
)
def test_a_database_of_another_hull_or_of_other_water_is_refused(depth, sizes, said):
    with pytest.raises(ValueError, match=said):
        make(make_study(tomllib.loads(STUDY)), db=SimpleNamespace(water_depth=depth, dimensions=sizes))


def test_a_map_keeps_the_waterplane_and_knows_its_keys():
    raw = tomllib.loads(STUDY)
    changed = with_value(raw, "hull.length_over_beam", 5.0)
    hull = changed["hull"]
    assert hull["length"] * hull["beam"] == pytest.approx(5000) and hull["length"] / hull["beam"] == pytest.approx(5)
    assert changed["attachment"]["x"] == pytest.approx(0.5 * hull["length"]) and raw["hull"]["length"] == 100
    names = "hawser.length", "types.chain.weight_kg_per_m", "current.speed_knots", "hull.length_over_beam"
    assert [_named(name) for name in names] == [f"{names[0]}, m", names[1], f"{names[2]}, knots", names[3]]
    with pytest.raises(ValueError, match="is not the path of a number in this study"):
        with_value(raw, "hull.colour", 1.0)


def test_a_bow_that_rounding_turns_is_at_zero_and_not_at_360_degrees():
    turned = [bow(SimpleNamespace(heading=np.radians(angle))) for angle in (-1e-7, 0.0, 359.9999, -90.0, 17.304)]
    assert turned == [0.0, 0.0, 0.0, 270.0, 17.3]


def test_a_run_in_time_is_told_drawn_and_stored(tmp_path, monkeypatch, capsys):
    text = STUDY.replace("speed = 25.0", 'speed = 25.0\ngusts = "davenport"') + "\n[slewing]\nduration = 120.0\n"
    assert run(tmp_path, text, "--output", "a.h5", monkeypatch=monkeypatch) == 0
    said = capsys.readouterr().out
    assert "120 s in time" in said and "watch circle" in said and (tmp_path / "a_run.png").is_file()
    found = read(tmp_path / "a.h5", "single-point")
    assert found["run.line_tension"].shape == (121, 6) and np.ptp(found["run.wind_speed"]) > 1
    assert np.array_equal(found["run.largest"][1:], found["run.line_tension"].max(axis=0))
    words = ["animate", "a.h5", "--output", "film.gif", "--step", "60"]
    assert cli.main(words) == 0 and "film.gif: 3 frames" in capsys.readouterr().out
    assert (tmp_path / "film.gif").stat().st_size > 10_000
    assert cli.main([*words, "--seed", "1"]) == 2 and "--seed belongs to" in capsys.readouterr().err
    assert run(tmp_path, text + 'scheme = "two_scale"\n', monkeypatch=monkeypatch) == 2
    told = capsys.readouterr()
    assert "which needs [waves] and --database" in told.err and not told.out  # before anything is computed


def test_a_buoy_of_its_own_mass_runs_on_an_elastic_hawser(tmp_path, monkeypatch, capsys):
    text = STUDY.replace("z = -3.0", "z = -3.0\nmass = 120.0\ndiameter = 8.0\nheight = 5.0")
    text += '\n[hawser]\nlength = 25.0\n[slewing]\nduration = 100.0\nscheme = "full"\n'
    assert run(tmp_path, text, monkeypatch=monkeypatch) == 2
    assert "needs axial_stiffness" in capsys.readouterr().err
    stiff = text.replace("length = 25.0", "length = 25.0\naxial_stiffness_kN = 2e4")
    assert run(tmp_path, stiff, monkeypatch=monkeypatch) == 0
    said = capsys.readouterr().out
    assert "hawser 1" in said and "waves act by their mean drift only; give --database for first-order motions" in said
    low, high = "buoy.hawser_z is -4 m; allowed: at least buoy.z, -3 m", "at most buoy.height, 5 m"
    for height, said in ((-4.0, low), (50.0, high), (2.0, "")):
        tilts = stiff.replace("height = 5.0", f"height = 5.0\nhawser_z = {height}")
        assert run(tmp_path, tilts, monkeypatch=monkeypatch) == (2 if said else 0)
        assert said in capsys.readouterr().err


def test_the_tanker_of_the_scenes_stands_at_its_hawser_and_its_criteria_are_told(tmp_path, monkeypatch, capsys):
    assert cli.main(["new", "single-point-tanker", str(tmp_path / "calm.toml")]) == 0
    text = (tmp_path / "calm.toml").read_text()
    parts = [text[: text.index("[wind]")], text[text.index("[current]") : text.index("[waves]")]]  # all from ahead
    text = (
        "".join(parts).replace("incidence_deg = 30.0", "incidence_deg = 0.0").replace("length = 50.0", "length = 10.0")
    )
    assert run(tmp_path, text, monkeypatch=monkeypatch) == 0
    said = " ".join(capsys.readouterr().out.split())
    found = single_point(tmp_path / "study.toml")
    assert found["slewing"] == "stable" and not found["criterion.straight"]
    first = float(said.split("slewing begins or ends at effective line lengths of ")[1].split()[0])
    raw, _ = with_files(tomllib.loads(text), text, tmp_path / "study.toml")
    for share, stable in ((0.95, True), (1.05, False)):
        raw["hawser"]["length"] = share * first
        assert preferred(equilibria(make(make_study(raw)).point)).slewing.stable is stable


def test_slow_motions_are_named_and_a_buoy_near_the_peak_of_the_waves_is_told(tmp_path, monkeypatch, capsys):
    assert cli.main(["new", "single-point-tanker", str(tmp_path / "calm.toml")]) == 0
    text = (tmp_path / "calm.toml").read_text()
    capsys.readouterr()
    assert run(tmp_path, text, monkeypatch=monkeypatch) == 0
    found, said = single_point(tmp_path / "study.toml"), capsys.readouterr().out
    names = [mode.words for mode in found.detail.best.modes[:2]]
    assert "natural periods of" not in said and names == ["surge", "sway and yaw"]
    mass, (period, *_) = 1e3 * 53900 * 1.05, found["natural.period"]
    one = found.detail.best
    along = np.array([np.cos(one.heading), np.sin(one.heading)])
    stiff = along @ one.point.pull(one.buoy).stiffness @ along
    assert period == pytest.approx(2 * np.pi * np.sqrt(mass / stiff), rel=0.03)  # surge on the lines of the buoy
    near = text.replace("pretension_kN = 300.0", "pretension_kN = 150.0")
    assert run(tmp_path, near, monkeypatch=monkeypatch) == 0
    assert "within 20 % of the waves' peak at 9.09 s" in capsys.readouterr().out


TANKER = """# area_x = 6000.0
# area_y = 6000.0
# length = 300.0
angle,CX,CY,CN
"""
SHIP = (  # of the box's study: sizes, water and lines of a ship, and its own coefficients
    ("length = 100.0", "length = 300.0"),
    ("x = 50.0", "x = 150.0"),
    ("draft = 10.0\n", "draft = 20.0\n"),
    ("depth = 14.0", "depth = 60.0"),
    ("length = 150.0", "length = 900.0"),
    ("top_tension_tonf = 15.0", "top_tension_tonf = 40.0"),
    ("turning = { beam_over_draft = 10.0 }", 'file = "tanker.csv"'),
    ("incidence_deg = 30.0", "incidence_deg = 0.0"),
    ("speed_knots = 1.5", "speed_knots = 3.0"),
)


def test_a_slender_ship_with_its_own_coefficients_does_not_lie_still_in_a_current(tmp_path, monkeypatch, capsys):
    """Cross flow sideways, a moment that turns it broadside: head on it is no equilibrium that lasts"""
    a = np.radians(np.arange(0, 181, 10))
    columns = np.round([0.03 * np.cos(a), 0.6 * np.sin(a) ** 2, -0.055 * np.sin(2 * a)], 6).T + 0.0
    rows = [f"{angle:.0f},{','.join(map(str, row))}" for angle, row in zip(np.degrees(a), columns, strict=True)]
    (tmp_path / "tanker.csv").write_text(TANKER + "\n".join(rows) + "\n")
    text = STUDY[: STUDY.index("[wind]")] + STUDY[STUDY.index("[current]") : STUDY.index("[waves]")]
    for old, new in SHIP:
        assert old in text
        text = text.replace(old, new)
    assert run(tmp_path, text + "\n[hawser]\nlength = 100.0\n", monkeypatch=monkeypatch) == 0
    said = capsys.readouterr().out
    assert "no heading is stable: the body slews; [[maps]] shows the growth over hawser length and attachment" in said
    assert "limit cycle" in said


def test_a_tanker_is_held_to_the_published_criteria_of_yaw(tmp_path, monkeypatch, capsys):
    a = np.radians(np.arange(0, 181, 5))
    side, turn = 0.35 * np.sin(a) * np.abs(np.cos(a)) + 0.6 * np.sin(a) ** 3, -0.06 * np.sin(2 * a)
    columns = np.round([0.03 * np.cos(a), side, turn], 6).T + 0.0
    rows = [f"{angle:.0f},{','.join(map(str, row))}" for angle, row in zip(np.degrees(a), columns, strict=True)]
    (tmp_path / "tanker.csv").write_text(TANKER + "\n".join(rows) + "\n")
    text = STUDY[: STUDY.index("[wind]")] + STUDY[STUDY.index("[current]") : STUDY.index("[waves]")]
    for old, new in SHIP:
        text = text.replace(old, new)
    text += "\n[hawser]\nlength = 20.0\n"
    monkeypatch.chdir(tmp_path)
    for given, keeps in (("{}", False), ("{ Y_r = 0.0, N_r = -0.05 }", True)):
        own = text.replace('file = "tanker.csv"', f'file = "tanker.csv"\nyaw_rate = {given}')
        (tmp_path / "study.toml").write_text(own)
        found = single_point("study.toml")
        assert found["criterion.arm"] == pytest.approx(150.0) and found["criterion.static"] == "stable"
        assert found["criterion.straight"] == keeps
        assert found["criterion.lever"] == pytest.approx(0.12 / 0.35 * 300, rel=0.02)
    assert run(tmp_path, own.replace("-0.05", "0.05"), monkeypatch=monkeypatch) == 2
    assert "current.yaw_rate.N_r is 0.05; allowed: finite, N_r at most 0" in capsys.readouterr().err


def test_the_largest_tension_of_a_run_is_that_of_its_record():
    """One sample of 5 MN in a record of 1 MN; the report's significant value is 1 + ⅔ · 4 MN"""
    hawser, lines = np.full((50, 1), 1e6), np.full((50, 2), 2e6)
    hawser[7], lines[30, 1] = 5e6, 3e6
    still = SimpleNamespace(
        hawser=np.array([1e6]),
        lines=SimpleNamespace(tension=np.array([2e6, 2e6])),
        point=SimpleNamespace(system=SimpleNamespace(line_names=["a", "b"])),
    )
    ropes = ropes_of(SimpleNamespace(record=SimpleNamespace(hawser=hawser, lines=lines), steady=still))
    assert ropes["largest"].tolist() == [5e6, 2e6, 3e6]
    assert ropes["significant"][0] == pytest.approx(1e6 + 4e6 * 2 / 3, rel=1e-3)
