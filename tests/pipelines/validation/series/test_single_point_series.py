"""The single-point series of the SR179 report: cases as studies, tables, faults."""

import math

import numpy as np
import pytest

from hakobune.pipelines import cli
from hakobune.pipelines.single_point.study import make
from hakobune.pipelines.single_point.tables import make_study
from hakobune.pipelines.validation.series import single_point
from hakobune.pipelines.validation.series.single_point_cases import Case, read_cases, scene_of, study_of

MASS = {"added_surge": 0.1, "added_sway": 1.0, "added_yaw": 0.7}


def test_every_case_is_a_study_of_its_printed_numbers():
    cases = read_cases().values()
    assert len(cases) == 68 and {case.floater for case in cases} == {"A", "B"}
    for case in cases:
        made = make(make_study({**study_of(case), "mass": MASS}))
        tension = made.point.at_rest.tension
        assert np.allclose(tension / 9806.65, case.together * case.values["pretension_tonf"], rtol=1e-9)
        assert np.all(np.abs(made.point.origin) < 1e-9)
    assert {name for _, names, _ in single_point.STATEMENTS for name in names} <= {case.name for case in cases}


def test_two_cases_are_solved_run_and_tabulated_beside_the_print(tmp_path):
    """A16 and A17: 20 m, waves of 10 s; the report's ratios of significant to static tension are 1.17 and 1.20

    Printed and computed significant tensions are decimetres of surge apart.
    """
    folder = tmp_path / "series"
    made = single_point.make(folder, only="A16,A17")
    assert {p.name for p in folder.iterdir()} == {"A_20m.h5", "A16.toml", "A17.toml"}
    for row in made.detail["case"]:
        # by the drift of this depth; that of 14 m would be 5 to 18 % too much
        assert abs(row["static_tonf"] / row["printed_static_tonf"] - 1) < 0.05
        assert 1.1 < row["significant_tonf"] / row["static_tonf"] < 1.35
        assert abs(row["apart_m"]) < 0.5
        assert abs(row["scope"] / row["printed_scope"] - 1) < 0.1
    said = "".join(made.notes)
    ((title, panels, *_),) = single_point.pictures(made).values()
    assert title.startswith("Floater A; crosses: printed") and not panels[0].curves  # one depth alone
    assert "A, H 1.5 m, 10 s, 20 m: significant tension over static tension is" in said and "m of surge" in said
    assert cli.main(["single-point", str(folder / "A16.toml"), "--database", str(folder / "A_20m.h5"), "--output",
                     str(tmp_path / "a.h5")]) == 0  # fmt: skip


def test_a_case_that_is_none_is_refused_and_a_table_of_somebody_else_not_replaced(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["series", "single-point", "--only", "Z9"]) == 2
    shown = capsys.readouterr().err
    assert "--only names 'Z9'; allowed: A1, A2" in shown and shown.count("\n") == 1
    (tmp_path / "single-point.csv").write_text("mine\n1\n")
    assert cli.main(["series", "single-point", "--only", "A16", "--output", "."]) == 2
    assert "is not a result of hakobune series single-point, so it is not replaced" in capsys.readouterr().err


def row(name="A16", static=34.0, significant=40.0, apart=0.1):
    case = read_cases()[name]
    ours = {"case": name, "floater": "A", "system": case.system, "current_deg": 0.0, "static_tonf": static,
            "significant_tonf": significant, "apart_m": apart}  # fmt: skip
    return case.values | ours | {f"printed_{key}": value for key, value in case.printed.items()}


def test_trends_and_statements_are_ratios():
    """A16 and A17: 40/34 and 48/40 computed; 35/30 and 42/35 printed"""
    first, last = single_point.trends([row(), row("A17", 40.0, 48.0, -0.3)])
    assert first == ("A, H 1.5 m, 10 s, 20 m: significant tension over static tension is 1.18 to 1.20, printed "
                     "1.17 to 1.20; "
                     "-0.30 to 0.10 m of surge explain the difference")  # fmt: skip
    assert "tensions is the effect of 0.20 m of surge (median; nine of ten cases: at most 0.28 m)" in last
    three = [row(name, 30.0, value) for name, value in (("A12", 54.0), ("A14", 48.0), ("A16", np.nan))]
    (said,) = single_point.statements(three)
    assert said.endswith("sharply below 15 m, at 20, 14, 12 m; computed: beyond reach, 48 t, 54 t")


def test_charts_have_computed_lines_and_printed_crosses():
    made = single_point.result("series", "", {"case": [row("A16", 30, 35), row("A12", 33, 54), row("A14", 32, 48)]})
    ((_, panels, *_),) = single_point.pictures(made).values()
    static, _, significant, printed = panels[0].curves
    assert static.x == [12, 14, 20] and static.y == [33, 32, 30]
    assert significant.y == printed.y == [54, 48, 35] and panels[0].levels == (0.4 * 785,)


def test_a_study_has_the_numbers_of_its_row():
    """18 lines are six of three times the weight; T₀₁ = 0.9 T̄ of the significant period T̄/0.9"""
    values = {"height_m": 3.0, "mean_period_s": 10.0, "wind_m_s": 45.0, "current_kn": 1.5, "depth_m": 14.0,
              "weight_t_m": 0.2414, "lines": 18.0, "pretension_tonf": 10.0}  # fmt: skip
    case = Case("X", "A", values, 30.0, "buoy", {})
    made = study_of(case, seed=4, drift=5.5)
    assert made["types"]["chain"] == {"weight_kg_per_m": pytest.approx(724.2), "breaking_load_tonf": 2355.0}
    assert made["mooring"]["top_tension_tonf"] == 30.0 and made["mooring"]["length"] == 560.0
    assert made["waves"]["period"] == pytest.approx(9.0) and made["waves"]["drift_tonf_per_m2"] == 5.5
    assert made["hawser"] == {"length": 25.0} and made["attachment"]["x"] == 50.0 and made["buoy"]["z"] == -3.0
    assert made["current"]["speed_knots"] == 1.5 and made["current"]["incidence_deg"] == 30.0
    assert made["slewing"]["seed"] == 4 and case.together == 3
    body = scene_of(case)["bodies"][0]
    sides = (50, 20), (100, 20), (100, 50)
    assert body["gyration"] == pytest.approx([math.sqrt((b**2 + c**2) / 12) for b, c in sides])
