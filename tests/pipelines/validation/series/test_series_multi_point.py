"""`hakobune series multi-point`: its cases, one of them made and made again, tables and charts."""

import csv
import math

import numpy as np
import pytest

from hakobune.mooring.response.extremes import expected_maximum
from hakobune.pipelines.cli import main
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.validation.series import multi_point
from hakobune.pipelines.validation.series.multi_point_cases import BASES, LENGTHS, STRENGTH, WEIGHT, cases, scene, study
from hakobune.pipelines.validation.series.multi_point_statistics import QUANTITIES, printed_rows
from hakobune.pipelines.validation.series.multi_point_statistics import statements as told


def test_there_are_36_cases_each_with_its_own_name_and_a_study_that_reads():
    every = cases()
    assert len({one.name for one in every}) == len(every) == 36
    assert all(make_study(study(one, 3.0, 2)).water.depth == scene(one)["water"]["depth"] for one in every)


def test_chains_are_as_long_as_two_fifths_of_their_strength_holds_up():
    """S = √(H(2T/w − H)), rounded up to tens of metres (Table 3.5.5.4)"""
    for depth, (chain, *_) in LENGTHS.items():
        held = np.sqrt(depth * (2 * 0.4 * STRENGTH * 1e3 / WEIGHT - depth))
        assert held - 0.2 < chain < held + 15


def row(case, regular=400.0, irregular=450.0, simulated=500.0, alone=0.1, note=""):
    slow = {f"{kind}_{mode}": value for kind, value in (("spectrum", 0.2), ("waves_alone", alone))
            for mode in multi_point.MODES}  # fmt: skip
    named = {"case": case.name, "floater": case.floater, "line": case.kind, "depth_m": case.depth, "lines": case.lines,
             "height_m": case.height, "wind_m_s": case.wind, "period_s": case.period}  # fmt: skip
    return named | slow | {
        "regular_tonf": regular, "simulated_tonf": simulated, "simulated_over_regular": simulated / regular,
        "simulated_over_irregular": simulated / irregular, "note": note,
    }  # fmt: skip


def test_charts_go_from_the_base_along_one_change_each():
    made = multi_point.result("series", "", {"case": [row(one) for one in cases() if one.kind == "chain"]})
    charts = multi_point.pictures(made)
    assert set(charts) == {"multi_point_A.png", "multi_point_B.png"}
    height, depth, period, lines = (panel.curves for panel in charts["multi_point_A.png"][1])
    assert [curve.label for curve in depth] == ["chain, simulated", "chain, regular"]
    assert depth[0].x == [14, 20, 50] and depth[0].y == [500] * 3 and depth[1].y == [400] * 3
    assert height[0].x == [1.5, 3.0, 4.5] and period[0].x == [10, 15, 20] and lines[0].x == [12, 24, 36]
    assert charts["multi_point_A.png"][1][0].levels == (1700.0, 680.0)


@pytest.mark.parametrize("depth, method", [(20.0, "simulation"), (21.0, "larger of both"), (39.0, "larger of both"),
                                           (40.0, "simplified")])  # fmt: skip
def test_the_method_of_a_case_follows_its_depth(depth, method):
    """SR179 report (1982), section 5.5.3"""
    assert multi_point.method_of(depth) == method


def test_statements_count_and_name():
    """Of two cases in 20 m one simulation exceeds; waves alone drive more than twice the spectrum's answer in one"""
    first, second = (BASES["A"]._replace(name=name) for name in ("A-chain-Hs1.5", "A-chain-Hs3"))
    said = list(multi_point.statements([row(first, simulated=300.0), row(second, simulated=520.0, alone=0.41)]))
    assert "in up to 20 m of water the simulation exceeds the simplified method in the regular wave" in said[0]
    assert said[0].endswith("in 1 of 2 cases; ratios 0.75 to 1.30")
    assert "in irregular waves in 1 of 2 cases; ratios 0.67 to 1.16" in said[1]
    assert said[2].endswith("slow forces in 1 of 2 cases: A-chain-Hs3")
    three = [row(BASES["A"]._replace(name=name), simulated=s)
             for name, s in (("A-chain-Hs1.5", 210.0), ("A-chain-Hs3", 320.0), ("A-chain-base", 500.0))]  # fmt: skip
    grows = next(multi_point.statements(three))
    assert grows.endswith("computed: 210 (simplified 400) tonf at chain-Hs1.5, 320 (simplified 400) tonf at chain-Hs3, "
                          "500 (simplified 400) tonf at chain-base")  # fmt: skip


@pytest.mark.parametrize("kind", ["chain", "buoy", "sinker"])
def test_the_printed_largest_values_are_those_of_gaussian_records_of_their_sigma(kind):
    """Eq. 3.5.1.5 and 3.5.1.6 of 1000 mean periods of 10 s; table 3.5.5.5 rounds to two digits"""
    rows = printed_rows(kind)
    assert set(rows) == {*QUANTITIES, "force"}
    for row in rows.values():
        assert row["largest"] == pytest.approx(expected_maximum(row["sigma"], 1e4, row["T_zero"]), rel=0.02)


def test_the_force_of_the_report_stands_beside_the_computed():
    """Chain: 135 + 322 tonf printed, σ 83; surge σ 0.37 m"""
    named = {"line": "chain", "calculation": "full"}
    surge = named | {"quantity": "surge", "sigma_over_printed": 1.2}
    force = named | {"quantity": "force", "mean": 140.0, "largest": 300.0, "sigma": 80.0}
    force |= {f"printed_{key}": value for key, value in printed_rows("chain")["force"].items()}
    begin = "table 3.5.5.5, chain, full: force 140 + 300 = 440 tonf (printed 457), σ 80 (83); "
    assert list(told([surge, force])) == [begin + "σ of motions over the print: surge 1.20"]


def test_studies_of_the_multi_point_series_are_those_of_the_report():
    """Table 3.5.5.2 to 3.5.5.4: chain of 142 mm, 406 kg/m in water, 1700 tonf; 24 lines are twelve of twice of it; a
    sinker of 100 t in water of steel; T₀₁ = T̄/1.1"""
    by_name = {one.name: one for one in cases()}
    made = study(by_name["A-chain-24"], 3.0, 5)
    assert made["types"]["chain"] == {
        "weight_kg_per_m": 812.0,
        "axial_stiffness_tonf": 443400.0,
        "breaking_load_tonf": 3400.0,
    }
    assert made["spreads"][0]["pretension_tonf"] == 80.0 and made["spreads"][0]["length"] == 260.0
    assert made["hull"] == {"length": 100.0, "beam": 50.0, "draft": 10.0, "freeboard": 10.0}
    assert made["waves"]["period"] == pytest.approx(15 / 1.1) and made["waves"]["incidence_deg"] == 60.0
    assert made["simulation"]["seeds"] == 5 and made["simulation"]["duration_hours"] == 3.0
    sinker = study(by_name["A-sinker-base"], 3.0, 1)["spreads"][0]
    assert [part["length"] for part in sinker["segments"]] == [260.0, 50.0]
    (body,) = sinker["bodies"]
    assert body["mass"] - 1025 * body["volume"] == pytest.approx(100e3)
    assert body["mass"] / body["volume"] == pytest.approx(7850)
    buoy = study(by_name["B-buoy-base"], 3.0, 1)["spreads"][0]
    assert [part["length"] for part in buoy["segments"]] == [270.0, 60.0]
    assert buoy["bodies"][0]["mass"] == 20e3
    assert buoy["bodies"][0]["volume"] == pytest.approx(math.pi / 4 * 7.0**2 * 4.5)
    made = scene(by_name["B-buoy-base"])
    assert made["bodies"][0]["gyration"] == [30.55, 58.59, 64.55] and made["water"]["depth"] == 40.0


def test_a_case_is_made_once_and_kept_as_a_study(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = ["series", "multi-point", "--only", "A-chain-50m", "--hours", "0.1", "--output", "made"]
    assert main(words) == 0
    assert main(["check", "made/multi-point.csv"]) == 0
    lines = (tmp_path / "made" / "multi-point.csv").read_text().splitlines()
    (one,) = csv.DictReader(line for line in lines if line and line[0] != "#")
    assert 0 < float(one["case.regular [tonf]"]) < float(one["case.irregular [tonf]"])
    assert float(one["case.simulated [tonf]"]) > float(one["case.simulated_mean [tonf]"])
    assert 2 < float(one["case.T_surge [s]"]) / 15 < 10 and float(one["case.slow_surge [m]"]) > 0
    kept = {path: path.read_bytes() for path in (tmp_path / "made").rglob("*") if path.suffix in (".csv", ".h5")}
    assert main(words) == 0
    assert all(path.read_bytes() == content for path, content in kept.items())
