"""The SR179 report's (1982) comparisons: its units and phases, its sectional limit, its models, its command."""

import csv
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.validation.comparisons.cases import LENGTH_BEAM, model_case, series_case
from hakobune.pipelines.validation.comparisons.models import MEASURED, XI, period_rows, roll_rows
from hakobune.pipelines.validation.comparisons.series import ratios
from hakobune.pipelines.validation.comparisons.sets import SETS, solved

CASES = "hakobune.pipelines.validation.comparisons.cases"
PUBLISHED = Path(__file__).parents[3] / "published" / "sections_2d.csv"


def found(cases, tmp_path):
    made, failures = solved(cases, tmp_path)
    assert not failures
    return made


def tables(path):
    """[[row, …], …] of the tables of a result's CSV"""
    text = "\n".join(line for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#")
    return [list(csv.DictReader(part.splitlines())) for part in text.split("\n\n") if part]


def table(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def apart(a, b):
    """Degrees between two phases"""
    return abs((a - b + 180) % 360 - 180)


@pytest.mark.parametrize("depth_draft", [1.2, 1.4])
def test_long_boxes_have_the_numbers_and_phases_of_the_sectional_tables(depth_draft, tmp_path):
    """Tables 2.1.3.1 and .5, B/d = 5; their waves travel to port, those of χ = 90° to starboard; sway and roll turn.

    Their two or three decimals, and series of few terms: 1 %, of small values 0.005; phases 0.5°.
    """
    rows = [
        {key: float(value) for key, value in row.items() if key != "table"}
        for row in table(PUBLISHED)
        if float(row["H_over_d"]) == depth_draft and float(row["B_over_d"]) == 5
    ]
    assert len(rows) == 10
    (box,) = found([series_case(8, depth_draft, "strip", [row["xi_B"] for row in rows])], tmp_path)
    column = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    for name, pair in (("H", "33"), ("S", "22"), ("R", "44"), ("SR", "24"), ("SR", "42")):
        assert np.allclose(box.coefficient("A" + pair), column[f"M_{name}"], rtol=0.01, atol=0.005)
        assert np.allclose(box.coefficient("B" + pair), column[f"N_{name}"], rtol=0.01, atol=0.005)
    for name, mode, turned in (("H", 2, 0), ("S", 1, 180), ("R", 3, 180)):
        force = box.forces[:, box.heading(90), mode]
        assert np.allclose(np.abs(force), column[f"E_{name}"], rtol=0.01, atol=0.005)
        assert np.all(apart(np.degrees(np.angle(force)), column[f"eps_{name}_deg"] + turned) < 0.5)


def test_in_long_waves_from_ahead_the_box_follows_the_water_with_the_phases_of_a_head_sea(tmp_path):
    """ζ = cos(ωt + kx): water moves as −sin ωt / tanh kH, its slope −∂ζ/∂x is sin ωt, bow down is positive pitch."""
    (box,) = found([series_case(1, 2.0, xi=[0.01])], tmp_path)
    k = float(box.k[0])
    surge, heave, pitch = box.motions[0, box.heading(0), [0, 2, 4]]
    assert abs(surge * np.tanh(k * 20.0) - -1j) < 0.01
    assert abs(heave - 1) < 0.01
    assert abs(pitch - 1j) < 0.02
    sway, roll = box.motions[0, box.heading(90), [1, 3]]  # waves to starboard: the same turned by a right angle
    assert abs(sway - surge) < 0.01
    assert abs(roll - -pitch) < 0.01


def test_three_dimensional_coefficients_approach_the_sectional_ones_as_the_box_grows(tmp_path):
    """Figures 2.1.5.91-99: what the ends take away goes with B/L, halved from L/B 2 to 4 to 8.

    That is the worst of three frequencies; at one alone, waves along the box make it rise and fall.
    """
    xi = [0.5, 1.0, 1.5]
    cases = [*(series_case(ratio, 2.0, xi=xi) for ratio in (2, 4, 8)), series_case(8, 2.0, "strip", xi)]
    *boxes, strips = found(cases, tmp_path)
    for name, ratio in ratios(boxes, strips).items():
        off = np.abs(ratio - 1).max(axis=1)
        assert np.all(off[1:] < 0.75 * off[:-1] + 0.01), (name, off)
        assert off[-1] < 0.1, (name, off)


def test_panel_and_contour_method_agree_on_a_box_of_the_series(tmp_path):
    """Within twice the one per cent asked of the panels, of the largest value of each quantity"""
    xi = [0.3, 1.0, 2.5]
    contour, panel = found([series_case(2, 2.0, method, xi) for method in ("contour", "panel")], tmp_path)
    for name in ("A11", "A22", "A33", "A44", "A55", "A66", "A24", "B11", "B22", "B33", "B44", "B15"):
        a, b = contour.coefficient(name), panel.coefficient(name)
        assert np.abs(a - b).max() < 0.02 * np.abs(a).max(), name
    largest = np.abs(contour.forces).max(axis=(0, 1))
    assert np.all(np.abs(contour.forces - panel.forces).max(axis=(0, 1)) < 0.02 * largest)


def test_roll_periods_of_the_models_are_near_the_measured_ones_by_every_method_that_can(tmp_path):
    """Strips across are for pitch, and a plate without draft has none of the sides' inertia: they are left out."""
    cases = [
        model_case(model, method, np.linspace(1.0, 2.6, 9)) for model in MEASURED for method in ("contour", "strip")
    ]
    for row in period_rows(found(cases, tmp_path)):
        assert abs(row["T_roll_difference_percent"]) < 5, row
        assert abs(row["T_roll_coupled_s"] / row["T_roll_s"] - 1) < 0.01, row


def test_roll_at_resonance_falls_with_the_height_of_the_waves_and_so_less_than_in_proportion(tmp_path):
    """A drag in the square of the velocity: roll grows slower than the waves and faster than their root."""
    heights = 0.01, 0.04, 0.16
    cases = [model_case("M3A_Bd10", "contour", [0.9, 1.2, 1.5], height) for height in (None, *heights)]
    rows = list(roll_rows(found(cases, tmp_path)))
    size = np.array([row["X4"] for row in rows])
    assert np.all(np.diff(size) < 0)
    angles = np.array([row["roll_deg"] for row in rows[1:]])
    growth = np.diff(np.log(angles)) / np.diff(np.log(heights))
    assert np.all((growth > 0.5) & (growth < 1)), growth


def test_a_set_is_solved_once_and_shares_its_databases_with_others_of_the_folder(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(f"{CASES}.TOLERANCE", {"contour": 0.01, "panel": 0.05, "strip": 0.01})  # enough for 5 %

    def said(*words):
        assert main(["compare", *words, "--xi", "1", "--output", str(tmp_path)]) == 0
        return "".join(capsys.readouterr())

    first = said("depth-series")
    assert "panel against contour" in first and first.count("1 of 1 frequencies by this run") == 7
    assert len(list(tmp_path.glob("*.png"))) == 4
    rows = tables(tmp_path / "depth-series.csv")[0]
    assert [row["frequency.H_over_d"] for row in rows] == ["1.2", "1.4", "2.0", "5.0", "10.0", "", "2.0"]  # "": inf
    assert [row["frequency.method"] for row in rows] == ["contour"] * 5 + ["panel"] * 2
    heave = np.array([float(row["frequency.A33"]) for row in rows[:6]])
    assert np.all(np.diff(heave[:4]) < 0)
    assert np.all(np.abs(heave[3:5] / heave[5] - 1) < 0.05)  # "above H/d = 5 the depth matters little"

    assert said("sections").count("none of 1") == 1  # L/B = 2, H/d = 2
    written = (tmp_path / "sections.csv").read_text(encoding="utf-8")
    assert said("sections").count("none of 1") == len(LENGTH_BEAM) + 1
    assert (tmp_path / "sections.csv").read_text(encoding="utf-8") == written


def test_motions_that_are_zero_by_symmetry_are_not_known(tmp_path):
    one = SETS["motions"]
    rows = one.tables(found(one.cases({"from": 0.5, "to": 1.5, "count": 3}), tmp_path))["wave"]
    assert len(rows) == 4 * 3 * 5
    assert all(np.isnan(row["X2"]) == (row["chi_deg"] == 0) for row in rows)
    square = [row for row in rows if row["L_over_B"] == 1 and row["chi_deg"] == 45]
    assert square and all(np.isnan(row["X6"]) and abs(row["X1"] / row["X2"] - 1) < 1e-5 for row in square)


def test_the_models_have_their_tables_and_pictures(tmp_path):
    """Drift pushes the models along with the waves, which come from ahead and from port."""
    one = SETS["models"]
    cases = [case for case in one.cases([1.4]) if case.columns["method"] == "contour"]
    results = found(cases, tmp_path)
    assert set(one.pictures(results)) == {*MEASURED, "drift", "roll"}
    assert "none lies within" in "".join(one.summary(results))  # M3A with B/d = 20 has ξ_B 2.2
    for row in one.tables(results)["drift"]:
        assert row["D_y" if row["chi_deg"] == 90 else "D_x"] < 0


def test_every_set_asks_for_scenes_of_different_names():
    for one in SETS.values():
        names = [case.name for case in one.cases()]
        assert len(set(names)) == len(names)
    assert {case.columns["method"] for case in SETS["models"].cases()} == {
        "panel", "contour", "pressure", "strip", "inverse-strip"
    }  # fmt: skip
    assert min(XI) <= 0.3 and max(XI) >= 3.0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nothing"], "depth-series"),
        (["sections", "--xi", "two"], "a,b,c or start:stop:count"),
        (["sections", "--xi", "0.5,-1"], "waves.xi_B"),
        (["sections", "--xi", "0.5:0.1:3"], "the first below the last"),
        (["sections", "--output", __file__], "which is a file"),
    ],
)
def test_a_wrong_word_is_one_line(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["compare", *words]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1


def test_ratios_are_told_with_the_frequencies_they_were_computed_at():
    def stand_in(xi):
        forces = np.ones((len(xi), 1, 6))
        return SimpleNamespace(xi=xi, coefficient=lambda name: np.ones(len(xi)), forces=forces, heading=lambda chi: 0)

    for xi, told in (([0.5, 1.0], "0.5, 1"), ([1.0, 9.0], "1"), ([*np.linspace(0, 2, 21)], "0.5 to 1.5 (11 values)")):
        results = [stand_in(np.array(xi))] * (len(LENGTH_BEAM) + 1)
        assert all(line.endswith(f"ξ_B {told}") for line in SETS["sections"].summary(results))


@pytest.mark.parametrize("made", [False, True])
def test_a_folder_without_permission_is_named(made, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("ro/comp" if made else "ro").mkdir(parents=True)
    closed = "comp" if made else "ro"
    monkeypatch.setattr("os.access", lambda place, mode: Path(place).name != closed)
    assert main(["compare", "sections", "--output", "ro/comp"]) == 2
    said = capsys.readouterr().err
    place = "ro/comp" if made else "ro"
    assert said == f"hakobune compare: ro/comp cannot be written: no permission in {place}\n"


def test_a_file_of_another_kind_is_not_replaced_by_a_set(tmp_path, capsys):
    (tmp_path / "sections.csv").write_text("my,notes\n")
    assert main(["compare", "sections", "--xi", "1", "--output", str(tmp_path)]) == 2
    assert "sections.csv is not a result of hakobune compare sections" in capsys.readouterr().err


def test_a_database_of_another_scene_is_named_and_replaced_only_on_demand(tmp_path, capsys):
    folder = tmp_path / "databases"
    (strange,) = found([series_case(1.5, 2.0, "strip", [1.0])], folder)
    strange.db.path.rename(folder / "LB1_Hd2_contour.h5")
    command = ["compare", "sections", "--xi", "1", "--output", str(tmp_path)]
    assert main(command) == 2
    assert "give --fresh" in capsys.readouterr().err
    assert main([*command, "--fresh"]) == 0


def test_a_frequency_that_fails_is_named_and_no_table_is_made_of_the_rest(tmp_path, monkeypatch, capsys):
    def refused(*arguments):
        raise FloatingPointError("no answer")

    command = ["compare", "sections", "--xi", "1", "--output", str(tmp_path)]
    with monkeypatch.context() as patched:
        patched.setattr("hakobune.pipelines.solve.run.solve_one", refused)
        assert main(command) == 1
    said = capsys.readouterr().out
    assert "FAILS: LB4_Hd2_contour: ω = 0.6263" in said and "FloatingPointError: no answer" in said
    assert not list(tmp_path.glob("*.csv"))
    assert main(command) == 0
