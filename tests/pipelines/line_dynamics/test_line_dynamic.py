"""`hakobune line-dynamics` as a user calls it, and what it makes of a run."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

from hakobune import pipelines
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.dynamics.figures import Figures, time_below
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.anchors import warn_of_anchors
from hakobune.pipelines.line_dynamics import command as line_dynamics_command
from hakobune.pipelines.line_dynamics.motion import course_of
from hakobune.pipelines.line_dynamics.parts import current_of, line_of, wave_of
from hakobune.pipelines.line_dynamics.result import line_dynamics
from hakobune.pipelines.line_dynamics.study import make_line_dynamics, read_line_dynamics
from hakobune.pipelines.results.file import read

SCENES = sorted((Path(pipelines.__file__).parent / "scenes").glob("line_*.toml"))
CHAIN = """\
anchor = [0.0, 0.0, -60.0]
duration = 24.0
[water]
depth = 60.0
[types.chain]
catalogue = "R3 studless 76 mm"
[[segments]]
type = "chain"
length = 315.0
elements = 24
[fairlead]
position = [292.0, 0.0, -2.0]
[[fairlead.motions]]
period = 8.0
amplitude = [1.0, 0.0, 0.5]
"""
SEA = "[sea]\nheight = 2.5\nperiod = 6.0\ndirection_deg = 90.0\n"


def changed(tmp_path, *changes, name="line.toml"):
    text = CHAIN
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path = tmp_path / name
    path.write_text(text)
    return path


def result(path):
    return read(path, "line-dynamics")


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_a_scene_prints_writes_and_draws_what_it_found(scene, tmp_path, monkeypatch, capsys):
    monkeypatch.delenv("DISPLAY", raising=False)
    out, picture = tmp_path / "run.h5", tmp_path / "strip.png"
    assert main(["line-dynamics", str(scene), "--output", str(out), "--plot", str(picture)]) == 0
    shown = capsys.readouterr().out
    for text in ("largest, quasi-static", "slack in a cycle", "work per cycle", "friction", "regime"):
        assert text in shown
    assert picture.stat().st_size > 30_000 and sorted(p.name for p in tmp_path.iterdir()) == ["run.h5", "strip.png"]
    found = result(out)
    time = found.labels["time"].values
    inside = (time >= found["window.begin"]) & (time <= found["window.end"])
    assert found["tension[fairlead].largest"] == found["history.fairlead"][inside].max()
    assert found["tension[fairlead].least"] == pytest.approx(found["history.fairlead"][inside].min(), rel=1e-6)
    assert found.provenance["study"] == scene.read_text()
    shown_at, nodes = found.labels["frame"].values, found["line.place"]
    ends = np.stack([np.interp(shown_at, time, place) for place in found["fairlead.place"].T], axis=-1)
    # a chord of the fairlead's path between two steps misses it by aω²Δt²/8, with steps of up to T/12
    assert np.abs(nodes[:, -1] - ends).max() < 3.0 * (2 * np.pi / 12) ** 2 / 8
    rows = found.labels["work"].values.tolist()
    work = dict(zip(rows, found["work.energy"], strict=True))
    # five times the tolerance of a step
    assert sum(work[name] for name in rows[1:-1]) == pytest.approx(work["as force times velocity"], rel=5e-3)


def test_a_slow_fairlead_pulls_as_the_catenary_at_its_outermost_place(tmp_path):
    slow = changed(tmp_path, ("period = 8.0", "period = 600.0"), ("duration = 24.0", "duration = 1200.0"),
                   ("[1.0, 0.0, 0.5]", "[3.0, 0.0, 0.0]"), ("elements = 24", "elements = 60"))  # fmt: skip
    assert main(["line-dynamics", str(slow), "--output", str(tmp_path / "slow.h5")]) == 0
    line, _ = line_of(read_line_dynamics(slow)[0])
    part, found = line.segments[0], result(tmp_path / "slow.h5")
    exact = solve_lines(np.array([292.0, 295.0]), 58.0, part.length, part.weight, part.axial_stiffness).tension_fairlead
    # elements of 5 m put the touch-down wrongly by up to half of one; drag goes with the period to the power −2
    assert found["tension[fairlead].quasi_static"] == pytest.approx(exact[1], rel=5e-3)
    assert found["tension[fairlead].largest"] == pytest.approx(exact[1], rel=1e-2)
    assert found["tension[fairlead].at_rest"] == pytest.approx(exact[0], rel=5e-3)


def test_a_table_of_a_harmonic_motion_pulls_as_the_motion_does(tmp_path):
    t = np.linspace(0.0, 24.0, 481)
    place = [292 + np.cos(np.pi / 4 * t), 0 * t, -2 + 0.5 * np.cos(np.pi / 4 * t)]
    np.savetxt(tmp_path / "motion.csv", np.transpose([t, *place]), delimiter=",", header="t,x,y,z", comments="")
    text = CHAIN[: CHAIN.index("position =")] + 'table = "motion.csv"\nramp = 8.0\n'
    (tmp_path / "table.toml").write_text(text)
    runs = []
    for path in (changed(tmp_path), tmp_path / "table.toml"):
        out = path.with_suffix(".h5")
        assert main(["line-dynamics", str(path), "--output", str(out)]) == 0
        runs.append(result(out))
    # the mean of the table holds one value more than whole cycles, 1/481 of the amplitude off
    assert runs[1]["tension[fairlead].largest"] == pytest.approx(runs[0]["tension[fairlead].largest"], rel=5e-3)
    assert runs[1]["window.cycles"] == 0 and runs[0]["window.cycles"] == 2


def test_a_fairlead_out_of_the_water_is_named_and_its_line_is_heavier_there_where_it_may_be(tmp_path, capsys):
    high = ("position = [292.0, 0.0, -2.0]", "position = [292.0, 0.0, 12.0]")
    pulls = []
    for surface in ("", "surface = true\n"):
        study = changed(tmp_path, high, ("anchor", f"{surface}anchor"))
        assert main(["line-dynamics", str(study), "--output", str(tmp_path / "run.h5")]) == 0
        assert ("has its weight in air" in capsys.readouterr().out) == (surface == "")
        pulls.append(result(tmp_path / "run.h5")["tension[fairlead].at_rest"])
    # the weight of the twelve metres that the buoyancy of their steel no longer carries, and what that pulls taut
    assert 1.0 < pulls[1] / pulls[0] < 1.05


def test_a_rope_that_floats_above_the_water_is_named_and_lies_in_the_surface_where_it_may(tmp_path, capsys):
    rope = ('catalogue = "R3 studless 76 mm"', 'catalogue = "HMPE 80 mm"'), ("length = 315.0", "length = 302.0")
    floating = (*rope, ("[292.0, 0.0, -2.0]", "[292.0, 0.0, 0.0]"))
    still = ("[1.0, 0.0, 0.5]", "[0.0, 0.0, 0.0]")
    above = "m above still water at"
    for change, surface, said in ((still, "", f"{above} rest"), (("", ""), "", above), (still, "surface = true\n", "")):
        path = changed(tmp_path, *floating, change, ("anchor", f"{surface}anchor"))
        assert main(["line-dynamics", str(path), "--output", str(tmp_path / "run.h5")]) == 0
        shown = capsys.readouterr().out
        assert said in shown and (above in shown) == bool(said)
    assert result(tmp_path / "run.h5")["line.place"][..., 2].max() < 0.08


@pytest.mark.parametrize("change", [("length = 315.0", "length = 400.0"), ("[292.0, 0.0, -2.0]", "[50.0, 0.0, -2.0]")])
def test_a_slack_line_has_its_tables_without_a_ratio_to_no_tension(change, tmp_path):
    found = line_dynamics(changed(tmp_path, change))
    assert found.status == 1  # 24 elements are few
    assert 1 < found["tension[fairlead].over_quasi_static"] < 2
    assert np.isnan(found["tension[anchor].over_quasi_static"])


def test_a_line_that_lies_on_the_bed_wholly_is_told_to_pull_nothing(tmp_path):
    lying = changed(tmp_path, ("[292.0, 0.0, -2.0]", "[292.0, 0.0, -60.0]"), ("[1.0, 0.0, 0.5]", "[0.0, 0.0, 0.0]"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        words = ["--output", str(tmp_path / "lying.h5"), "--plot", str(tmp_path / "lying.png")]
        assert main(["line-dynamics", str(lying), *words]) == 0
    assert np.all(np.isnan(result(tmp_path / "lying.h5")["tension.over_quasi_static"]))


def test_work_of_a_still_fairlead_in_waves_has_no_shares(tmp_path):
    wave = "[wave]\nheight = 3\nperiod = 8\ndirection_deg = 0\n[fairlead]"
    path = changed(tmp_path, ("[1.0, 0.0, 0.5]", "[0.0, 0.0, 0.0]"), ("[fairlead]", wave))
    found = line_dynamics(path)
    assert found.status == 1  # 24 elements are few
    assert found["work[drag].energy"] != 0 and np.isnan(found["work.share"]).all()
    moves = Figures(0.0, 1.0, None, None, None, -2.0, {"drag": -3.0, "bed": 0.5}, 0.5, -2.0, 2.0)
    assert moves.share_of_work(-3.0) == 1.5  # waves move it and its fairlead takes the work out


def test_messages_name_the_line_in_kN_and_send_nobody_where_he_is(tmp_path, monkeypatch, capsys):
    slack = changed(tmp_path, ("length = 315.0", "length = 400.0"))
    assert main(["line-dynamics", str(slack)]) == 1
    shown = capsys.readouterr().out
    assert re.search(r"FAILS: line of 400 m in 24 elements: .* is [\d.]+ kN, and [\d.]+ kN", shown), shown
    assert "does not always have a part on the bed" in shown and "hakobune" not in shown and "<" not in shown
    monkeypatch.setattr("hakobune.mooring.lines.dynamics.start._settled", lambda *_: False)
    for count, way_out in ((5000, "fewer"), (24, "more")):
        many = changed(tmp_path, ("elements = 24", f"elements = {count}"))
        assert main(["line-dynamics", str(many)]) == 2
        said = capsys.readouterr().err
        assert f"line of 315 m in {count} elements" in said and f"give {way_out} elements" in said


def test_time_below_a_level_is_that_of_a_cosine():
    t = np.linspace(0.0, 2.0, 4001)
    exact = 2.0 * (1 - np.arccos(-0.3) / np.pi)
    assert time_below(t, np.cos(2 * np.pi * t), -0.3) == pytest.approx(exact, abs=1e-6)
    assert time_below(t, np.ones_like(t), 1.0) == 0.0 and time_below(t, np.zeros_like(t), 1.0) == 2.0


def course(**fairlead):
    raw = {"water": {"depth": 60.0}, "types": {"c": {}}, "segments": [{"type": "c", "length": 1.0}],
           "anchor": [0, 0, -60], "fairlead": {"position": [0, 0, 0], **fairlead}}  # fmt: skip
    return course_of(make_line_dynamics(raw), ".")


def test_figures_are_of_whole_cycles_up_to_the_end():
    two = course(motions=[{"amplitude": (1, 0, 0), "period": T} for T in (12.0, 4.0)], ramp=5.0)
    assert two.cycle == 12.0 and two.duration == 5.0 + 12 * 12.0
    assert two.window() == (5.0, 149.0, 12)
    begin, end, count = two.window(20.0)
    assert (end, count) == (149.0, 10) and begin == 149.0 - 120.0
    uneven = course(motions=[{"amplitude": (1, 0, 0), "period": T} for T in (12.0, 5.0)])
    assert uneven.cycle is None and uneven.window()[2] is None


def test_a_phase_is_a_lag():
    moved = course(motions=[{"amplitude": (2, 0, 0), "period": 8.0, "phase_deg": (90, 0, 0)}], ramp=0.0)
    assert moved.motion.at(2.0)[0] == pytest.approx([2.0, 0.0, 0.0])


def test_a_current_of_one_exponent_is_sheared_over_the_depth():
    raw = {"water": {"depth": 60.0}, "types": {"c": {}}, "segments": [{"type": "c", "length": 1.0}],
           "anchor": [0, 0, -60], "fairlead": {"position": [0, 0, 0]},
           "current": {"speed_knots": 2.0, "incidence_deg": 180.0, "exponent": 1.0}}  # fmt: skip
    made = current_of(make_line_dynamics(raw))
    U = np.stack([np.interp([-60.0, -30.0, 0.0], made.z, column) for column in made.velocity.T], axis=-1)
    assert pytest.approx(2 * 1852 / 3600 * np.array([[0, 0], [0.5, 0], [1, 0]]), abs=1e-9) == U


def test_a_sea_has_the_height_and_direction_that_its_table_says_and_a_seed_that_makes_it_again(tmp_path, capsys):
    """4√m₀ of the elevation at the origin, Σ a²/2 = m₀, where 0.1 % of the energy is left out."""
    study = read_line_dynamics(changed(tmp_path, ("[fairlead]", f"{SEA}[fairlead]")))[0]
    train = wave_of(study, 6.0)
    assert 4 * np.sqrt(0.5 * np.sum(train.amplitude**2)) == pytest.approx(2.5, rel=2e-3)
    assert np.all(train.direction == 0.5 * np.pi) and len(train.period) == 100 and train.ramp == 6.0
    largest = []
    for seed in (1, 1, 2):
        words = f"{SEA}components = 12\nseed = {seed}\n[fairlead]"
        out = tmp_path / f"sea_{seed}.h5"
        assert main(["line-dynamics", str(changed(tmp_path, ("[fairlead]", words))), "--output", str(out)]) == 0
        largest.append(result(out)["tension[fairlead].largest"])
        assert result(out)["window.cycles"] == 0
        out.unlink()
    assert largest[0] == largest[1] != largest[2]
    assert "not judged" in capsys.readouterr().out


def test_an_interrupted_run_leaves_no_file(tmp_path, monkeypatch, capsys):
    def stop(self, reached):
        raise KeyboardInterrupt

    monkeypatch.setattr(line_dynamics_command.Progress, "__call__", stop)
    path = changed(tmp_path)
    arguments = ["--output", str(tmp_path / "run.h5"), "--plot", str(tmp_path / "run.png")]
    assert main(["line-dynamics", str(path), *arguments]) == 130
    assert capsys.readouterr().err == "hakobune line-dynamics: interrupted; nothing was written\n"
    assert list(tmp_path.iterdir()) == [path]


def test_a_line_pulled_beyond_its_length_is_said_with_the_force_it_takes(tmp_path, capsys):
    own = "weight_N_per_m = 985.0\naxial_stiffness_kN = 4.6e5\nmass_kg_per_m = 115.5\ndiameter = 0.137"
    path = changed(tmp_path, ('catalogue = "R3 studless 76 mm"', own), ("[1.0, 0.0, 0.5]", "[18.0, 0.0, 0.0]"),
                   ("period = 8.0", "period = 60.0"), ("duration = 24.0", "duration = 120.0"))  # fmt: skip
    assert main(["line-dynamics", str(path), "--output", str(tmp_path / "taut.h5")]) == 0
    shown = capsys.readouterr().out
    said = float(re.search(r"s, which needs ([\d.]+) kN", shown)[1])
    away = np.hypot(310.0, 58.0) - 315.0
    assert said == pytest.approx(4.6e5 * away / 315.0, rel=1e-3)
    assert result(tmp_path / "taut.h5")["tension[fairlead].largest"] > 1e3 * said


def test_a_line_without_a_breaking_load_does_not_stretch_for_ever(tmp_path, capsys):
    own = "weight_N_per_m = 985.0\naxial_stiffness_kN = 4.6e5\nmass_kg_per_m = 115.5\ndiameter = 0.137"
    path = changed(tmp_path, ('catalogue = "R3 studless 76 mm"', own), ("length = 315.0", "length = 15.0"))
    assert main(["line-dynamics", str(path)]) == 2
    assert (
        "allowed: up to 22.50 m, where the line of 15 m is stretched by 50%, at which any rope parts"
        in capsys.readouterr().err
    )


@pytest.mark.parametrize(
    ("z", "said"),
    [("60.0", "these anchors are above the water: anchor (z = 60 m), limit 30 m"),
     ("-30.0", "these anchors are above the bed: anchor (30 m), limit 3 m; the bed is at z = -60 m"), ("-59.0", "")],
)  # fmt: skip
def test_an_anchor_that_lies_nowhere_is_warned_of(z, said):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        warn_of_anchors({"anchor": float(z)}, 60.0)
    assert [said in str(one.message) for one in caught] == [True] * bool(said)


FAULTS = [
    (("R3 studless", "R3 stuffed"), [], "types.chain.catalogue: chain 'R3 stuffed 76 mm': after the grade comes"),
    (("[fairlead]", "[bed]\npoints = [[5, 2], [60, 62], [90, 92]]\n[fairlead]"), [],
     "bed.points[2] is [90, 92], 30 m above still water; allowed: z up to 62, since points[0] is the bed"),
    (("depth = 60.0", "depht = 60.0"), [], "water.depht is unknown, depth may be meant; allowed: depth"),
    (('type = "chain"', 'type = "rope"'), [], "segments[0].type is 'rope'; allowed: chain"),
    (("length = 315.0", "length = 250.0"), [], "m from the anchor at t ="),
    (("[1.0, 0.0, 0.5]", "[40.0, 0.0, 0.5]"), [], "where the line of 315 m breaks at 4884 kN"),
    (("-60.0]", "-61.0]"), [], "anchor is at z = -61 m, under the bed; allowed: -60 m or higher"),
    (("period = 8.0", "period = 0.0"), [], "fairlead.motions[0].period is 0; allowed: above 0"),
    (("position = [292.0, 0.0, -2.0]", 'table = "none.csv"'), [], "fairlead: motions and a table are both "
    "given; give one of them"),
    (('catalogue = "R3 studless 76 mm"', "weight_N_per_m = 900"), [], "types.chain: the axial stiffness is missing"),
    (("[fairlead]", "[[bodies]]\nafter_segment = 1\nmass = 9.0\n[fairlead]"), [], "none, since the line has one "
    "segment; divide the segment at the body"),
    (("[fairlead]", f"{SEA}[wave]\nheight = 1\nperiod = 6\n[fairlead]"), [], "wave and sea are both given"),
    (("[fairlead]", f"{SEA}components = 5\n[fairlead]"), [], "sea.components is 5; allowed: 10 to 1000"),
    (("[fairlead]", f"{SEA.replace('2.5', '12')}[fairlead]"), [], "sea.height is 12 m; allowed: up to 7"),
    (("duration = 24.0", SEA), [], "duration is missing; a sea does not repeat and needs one, above 0 s"),
    (("[fairlead]", "[wave]\nheight = 12\nperiod = 6\ndirection_deg = 0\n[fairlead]"), [], "wave.height is 12 m"),
    (("duration = 24.0", "duration = 15.0"), [], "one cycle of 8 s before the end; give a longer duration"),
    (("", ""), ["--duration", "-1"], "duration is -1 s; allowed: finite, above 0"),
    (("", ""), ["--tolerance", "0"], "tolerance is 0; allowed: 1e-08"),
    (("", ""), ["--plot", "x.doc"], "has the suffix '.doc'; allowed"),
    (("", ""), ["--output", "/nowhere/x.h5"], "the folder /nowhere does not exist"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "arguments", "message"), FAULTS)
def test_what_cannot_be_run_is_one_line(tmp_path, change, arguments, message, capsys):
    path = changed(tmp_path, change)
    assert main(["line-dynamics", str(path), *arguments]) == 2
    said = capsys.readouterr().err
    assert said.startswith("hakobune line-dynamics: ") and message in said and said.count("\n") == 1


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (None, "none.csv does not exist"),
        ("t,x,y,z\n0,1,2\n", "line 2 is '0,1,2'; allowed: four numbers t,x,y,z"),
        (
            "0,1,2,3\n1,1,2,3\n1,1,2,3\n2,1,2,3\n",
            "line 3: the time does not increase; allowed: later than the line before",
        ),
        ("5,1,2,3\n6,1,2,3\n7,1,2,3\n8,1,2,3\n", "begins at 5 s; allowed: at 0 s or before"),
        ("", "has 0 rows; allowed: 4 or more"),
    ],
)
def test_a_table_that_cannot_be_read_is_one_line(tmp_path, rows, message, capsys):
    (tmp_path / "t.toml").write_text(CHAIN[: CHAIN.index("position =")] + 'table = "none.csv"\n')
    if rows is not None:
        (tmp_path / "none.csv").write_text(rows)
    assert main(["line-dynamics", str(tmp_path / "t.toml")]) == 2
    said = capsys.readouterr().err
    assert message in said and said.count("\n") == 1


def test_a_missing_study_and_a_folder_are_one_line(tmp_path, capsys):
    for place, message in ((tmp_path / "none.toml", "does not exist"), (tmp_path, "Is a directory")):
        assert main(["line-dynamics", str(place)]) == 2
        assert message in capsys.readouterr().err


def test_a_rope_may_have_a_table_of_elongation_and_tension(tmp_path):
    rope = (
        'catalogue = "R3 studless 76 mm"',
        "weight_N_per_m = 40.0\nmass_kg_per_m = 14.0\ndiameter = 0.12\n"
        "elongation_percent = [0, 2, 5]\ntension_kN = [0, 400, 1600]",
    )
    line, _ = line_of(read_line_dynamics(changed(tmp_path, rope))[0])
    assert line.segments[0].axial_stiffness == ((0.0, 0.0), (0.02, 4e5), (0.05, 1.6e6))
    assert line.segments[0].stiffness == pytest.approx(4e7)
    short = (rope[0], rope[1].replace("[0, 400, 1600]", "[0, 400]"))
    with pytest.raises(ValueError, match="elongation_percent has 3 numbers"):
        line_of(read_line_dynamics(changed(tmp_path, short))[0])


def test_hills_lie_under_the_line_from_its_anchor_towards_the_fairlead(tmp_path):
    place = tmp_path / "hills.toml"
    place.write_text(CHAIN + "\n[bed]\nfriction = 0.3\npoints = [[5, 1], [65, 1], [120, 7], [400, 1]]\n")
    line, _ = line_of(read_line_dynamics(place)[0])
    assert line.bed.points == ((0.0, 0.0), (60.0, 0.0), (115.0, 6.0), (395.0, 0.0))
    way = np.array(read_line_dynamics(place)[0].fairlead.position[:2]) - line.anchor[:2]
    assert np.allclose(line.system.bed_course[2:], way / np.linalg.norm(way))
    assert main(["line-dynamics", str(place), "--duration", "16", "--plot", str(tmp_path / "hills.png")]) == 0
    place.write_text(place.read_text().replace("[65, 1]", "[5, 1]"))
    with pytest.raises(ValueError, match="bed: x of the bed points changes by 0 m"):
        line_of(read_line_dynamics(place)[0])
