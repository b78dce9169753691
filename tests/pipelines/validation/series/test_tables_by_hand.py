"""Tables, statements and charts of the report's series from numbers that are made up: ratios, units, counts by hand."""

import csv
import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.validation.series import (
    appendix_1,
    appendix_2,
    dolphin,
    dolphin_simulated,
    multi_point,
    multi_point_cases,
    multi_point_charts,
    multi_point_statistics,
    single_point,
    single_point_charts,
)
from hakobune.pipelines.validation.series.single_point_cases import Case as PointCase
from hakobune.pipelines.validation.series.single_point_cases import read_cases, scene_of
from hakobune.pipelines.validation.series.single_point_cases import study_of as point_study

G = 9.80665


def rows_of(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def of_multi_point(case, regular=400.0, irregular=450.0, simulated=500.0, notes=()):
    numbers = [np.array([first, 2 * first, 3 * first]) for first in (70.0, 0.1, 0.2, 0.3, 0.4, 0.5)]
    return multi_point.Result(case, regular, irregular, simulated, 480.0, (110.0, 120.0), (0.3, 0.35), *numbers, notes)


def test_a_row_of_the_multi_point_series_has_ratios_periods_over_waves_and_yaw_in_degrees():
    """Case A-chain-base: 20 m over a draft of 10 m, waves of 15 s"""
    (case,) = (one for one in multi_point_cases.cases("A-chain") if one.name == "A-chain-base")
    (row,) = rows_of(multi_point.table_text([of_multi_point(case)], 3.0, 2))
    by_hand = {
        "depth_m": 20, "lines": 12, "Hs_m": 4.5, "wind_m_s": 50, "period_s": 15, "depth_over_draft": 2,
        "T_surge": 70, "T_sway": 140, "T_yaw": 210, "T_surge_over_period": 70 / 15, "T_yaw_over_period": 14,
        "regular": 400, "irregular": 450, "simulated": 500, "simulated_mean_and_X1000": 480,
        "simulated_over_regular": 1.25, "simulated_over_irregular": 500 / 450, "simplified_mean": 110,
        "simulated_mean": 120, "regular_used": 0.3, "simulated_used": 0.35,
        "surge_quick_sigma": 0.1, "sway_spectrum_sigma": 0.4, "surge_slow_sigma": 0.3, "sway_total_sigma": 0.8,
        "surge_waves_alone_sigma": 0.5, "yaw_quick_sigma": math.degrees(0.3),
        "yaw_waves_alone_sigma": math.degrees(1.5),
    }  # fmt: skip
    for name, value in by_hand.items():
        assert float(row[name]) == pytest.approx(value, rel=1e-4), name
    assert (row["case"], row["floater"], row["line"], row["method"], row["larger"]) == (
        "A-chain-base", "A", "chain", "simulation", "simulation")  # fmt: skip


@pytest.mark.parametrize("depth, method", [(20.0, "simulation"), (21.0, "larger of both"), (39.0, "larger of both"),
                                           (40.0, "simplified")])  # fmt: skip
def test_the_method_of_a_case_follows_its_depth(depth, method):
    """SR179 report (1982), section 5.5.3"""
    case = multi_point_cases.BASES["A"]._replace(depth=depth)
    assert of_multi_point(case).method == method
    assert of_multi_point(case, simulated=399.0).larger == "simplified"


def test_statements_of_the_multi_point_series_count_and_name():
    """Of two cases in 20 m one simulation exceeds; waves alone drive more than twice the spectrum's answer in one"""
    first, second = (multi_point_cases.BASES["A"]._replace(name=name) for name in ("A-chain-Hs1.5", "A-chain-Hs3"))
    one, other = of_multi_point(first, simulated=300.0), of_multi_point(second, simulated=520.0)
    other = other._replace(alone=np.array([0.39, 0.79, 0.0]), spectrum=np.array([0.2, 0.4, 0.6]))
    said = list(multi_point.statements([one, other]))
    assert "in up to 20 m of water the simulation exceeds the simplified method in the regular wave" in said[0]
    assert said[0].endswith("in 1 of 2 cases; ratios 0.75 to 1.30")
    assert "in irregular waves in 1 of 2 cases; ratios 0.67 to 1.16" in said[1]
    assert said[2].endswith("slow forces in 1 of 2 cases: A-chain-Hs1.5")
    three = [of_multi_point(multi_point_cases.BASES["A"]._replace(name=name), simulated=s)
             for name, s in (("A-chain-Hs1.5", 210.0), ("A-chain-Hs3", 320.0), ("A-chain-base", 500.0))]  # fmt: skip
    grows = next(multi_point.statements(three))
    assert grows.endswith("computed: 210 (simplified 400) tonf at chain-Hs1.5, 320 (simplified 400) tonf at chain-Hs3, "
                          "500 (simplified 400) tonf at chain-base")  # fmt: skip


def test_studies_of_the_multi_point_series_are_those_of_the_report():
    """Table 3.5.5.2 to 3.5.5.4: chain of 142 mm, 406 kg/m in water, 1700 tonf; 24 lines are twelve of twice of it; a
    sinker of 100 t in water of steel; T₀₁ = T̄/1.1"""
    by_name = {one.name: one for one in multi_point_cases.cases()}
    made = multi_point_cases.study(by_name["A-chain-24"], 3.0, 5)
    assert made["types"]["chain"] == {
        "weight_kg_per_m": 812.0,
        "axial_stiffness_tonf": 443400.0,
        "breaking_load_tonf": 3400.0,
    }
    assert made["spreads"][0]["pretension_tonf"] == 80.0 and made["spreads"][0]["length"] == 260.0
    assert made["hull"] == {"length": 100.0, "beam": 50.0, "draft": 10.0, "freeboard": 10.0}
    assert made["waves"]["period"] == pytest.approx(15 / 1.1) and made["waves"]["incidence_deg"] == 60.0
    assert made["simulation"]["seeds"] == 5 and made["simulation"]["duration_hours"] == 3.0
    sinker = multi_point_cases.study(by_name["A-sinker-base"], 3.0, 1)["spreads"][0]
    assert [part["length"] for part in sinker["segments"]] == [260.0, 50.0]
    (body,) = sinker["bodies"]
    assert body["mass"] - 1025 * body["volume"] == pytest.approx(100e3)
    assert body["mass"] / body["volume"] == pytest.approx(7850)
    buoy = multi_point_cases.study(by_name["B-buoy-base"], 3.0, 1)["spreads"][0]
    assert [part["length"] for part in buoy["segments"]] == [270.0, 60.0]
    assert buoy["bodies"][0]["mass"] == 20e3
    assert buoy["bodies"][0]["volume"] == pytest.approx(math.pi / 4 * 7.0**2 * 4.5)
    scene = multi_point_cases.scene(by_name["B-buoy-base"])
    assert scene["bodies"][0]["gyration"] == [30.55, 58.59, 64.55] and scene["water"]["depth"] == 40.0


def test_the_chart_of_slow_motion_has_estimates_over_the_simulation(tmp_path, pictures):
    results = [of_multi_point(one) for one in multi_point_cases.cases("A-chain")]
    multi_point_charts.draw(results, tmp_path)
    tension, slow = pictures
    for axes, mode, name in zip(slow.axes, (0, 1), ("surge", "sway"), strict=True):
        quick, spectrum = (line.get_xydata()[0] for line in axes.lines[:2])
        assert quick == pytest.approx([0.3 * (mode + 1), 0.1 * (mode + 1)])
        assert spectrum == pytest.approx([0.3 * (mode + 1), 0.2 * (mode + 1)])
        assert axes.get_xlabel() == f"σ of slow {name}, simulated, m"
    depths = next(axes for axes in tension.axes if axes.get_xlabel() == "depth, m")
    lines = {line.get_label(): line.get_xydata() for line in depths.lines}
    assert lines["chain, simulated"] == pytest.approx(np.array([[14, 500], [20, 500], [50, 500]]))
    assert lines["chain, simplified"][:, 1] == pytest.approx([400, 400, 400])
    levels = [line.get_ydata()[0] for line in depths.lines if len(line.get_xdata()) == 2]
    assert levels == pytest.approx([1700.0, 680.0])
    heights = next(axes for axes in tension.axes if axes.get_xlabel() == "significant height, m")
    assert heights.lines[0].get_xdata() == pytest.approx([1.5, 3.0, 4.5])


def test_a_table_of_statistics_stands_beside_the_print():
    """Chain, surge: σ 0.37 m, mean 0.99, largest 1.43 printed"""
    made = [multi_point_statistics.Statistics("chain", "surge", "full", 11.0, 9.5, 0.5, 1.1, 0.444, 1.6, 0.2)]
    (row,) = rows_of(multi_point_statistics.table_text(made, 1.0))
    assert float(row["sigma_over_printed"]) == pytest.approx(1.2)
    assert float(row["mean_and_largest"]) == pytest.approx(2.7) and float(row["mean_and_largest_printed"]) == 2.42
    assert (row["T_zero"], row["T_zero_printed"], row["slow"]) == ("11", "11.1", "0.2")
    force = made[0]._replace(quantity="force", mean=140.0, largest=300.0, sigma=80.0)
    (said,) = multi_point_statistics.statements([*made, force])
    begin = "table 3.5.5.5, chain, full: force 140 + 300 = 440 tonf (printed 457), σ 80 (83); "
    assert said == begin + "σ of motions over the print: surge 1.20"


def point(name="A16", static=34.0, significant=40.0, apart=0.1, note=""):
    (case,) = read_cases(None, name)
    return single_point.Result(case, 1.5, static, significant, 3.6, 60.0, apart, 120.0, note)


def test_a_row_of_the_single_point_series_stands_beside_its_print(tmp_path):
    """A16: static 30, significant 35, scope 3.5, hawser 56 t"""
    single_point.write_table(tmp_path / "t.csv", [point()])
    (row,) = rows_of((tmp_path / "t.csv").read_text())
    found = {
        key: float(row[key]) for key in row if row[key] and key not in ("case", "floater", "system", "note", "flag")
    }
    by_hand = {
        "static_ton": 34,
        "printed_static_ton": 30,
        "significant_ton": 40,
        "printed_significant_ton": 35,
        "scope": 3.6,
        "printed_scope": 3.5,
        "hawser_ton": 60,
        "printed_hawser_ton": 56,
        "heading_deg": 1.5,
        "apart_m": 0.1,
        "settled_s": 120,
        "depth_m": 20,
        "wind_m_s": 25,
        "lines": 6,
        "current_kn": 1.5,
    }
    for name, value in by_hand.items():
        assert found[name] == pytest.approx(value), name
    assert row["printed_heading_deg"] == ""


def test_trends_and_statements_of_the_single_point_series_are_ratios():
    """A16 and A17: 40/34 and 48/40 computed; 35/30 and 42/35 printed"""
    two = [point(), point("A17", 40.0, 48.0, -0.3)]
    first, last = single_point_charts.trends(two)
    assert first == ("A, H 1.5 m, 10 s, 20 m: significant over static 1.18 to 1.20, printed 1.17 to 1.20; apart by "
                     "-0.30 to 0.10 m of surge")  # fmt: skip
    assert (
        "of 2 cases head-on and those printed are apart by 0.20 m of surge at the median, 0.28 m in nine of ten" in last
    )
    three = [point(name, 30.0, value) for name, value in (("A12", 54.0), ("A14", 48.0), ("A16", 35.0))]
    (said,) = single_point_charts.statements(three)
    assert said == "report: tension of A rises sharply below 15 m; computed: 35 t at 20 m, 48 t at 14 m, 54 t at 12 m"
    lost = [one._replace(significant_ton=np.nan) for one in three]
    assert "computed: beyond reach at 20 m" in next(single_point_charts.statements(lost))


def test_charts_of_the_single_point_series_have_computed_lines_and_printed_crosses(tmp_path, pictures):
    single_point_charts.draw([point("A12", 33, 54), point("A14", 32, 48), point("A16", 30, 35)], tmp_path)
    over_depth, _, _, beside = pictures[0].axes
    lines = [line for line in over_depth.lines if len(line.get_xdata()) == 3]
    static, crosses, significant, more = (line.get_xydata() for line in lines)
    assert static == pytest.approx(np.array([[12, 33], [14, 32], [20, 30]]))
    assert significant == pytest.approx(np.array([[12, 54], [14, 48], [20, 35]]))
    assert crosses[:, 1] == pytest.approx([33, 32, 30]) and more[:, 1] == pytest.approx([54, 48, 35])
    allowed = next(line for line in over_depth.lines if len(line.get_xdata()) == 2)
    assert allowed.get_ydata()[0] == pytest.approx(0.4 * 785)
    assert beside.lines[0].get_xydata() == pytest.approx(np.array([[33, 33], [32, 32], [30, 30]]))
    assert beside.get_xlabel() == "printed, tonf"


def test_a_study_of_the_single_point_series_has_the_numbers_of_its_row():
    """18 lines are six of three times the weight; T₀₁ = 0.9 T̄ of the significant period T̄/0.9"""
    values = {"height_m": 3.0, "mean_period_s": 10.0, "wind_m_s": 45.0, "current_kn": 1.5, "depth_m": 14.0,
              "weight_ton_m": 0.2414, "lines": 18.0, "pretension_ton": 10.0}  # fmt: skip
    case = PointCase("X", "A", values, 30.0, "buoy", {})
    made = point_study(case, seed=4, drift=5.5)
    assert made["types"]["chain"] == {"weight_kg_per_m": pytest.approx(724.2), "breaking_load_tonf": 2355.0}
    assert made["mooring"]["top_tension_tonf"] == 30.0 and made["mooring"]["length"] == 560.0
    assert made["waves"]["period"] == pytest.approx(9.0) and made["waves"]["drift_tonf_per_m2"] == 5.5
    assert made["hawser"] == {"length": 25.0} and made["attachment"]["x"] == 50.0 and made["buoy"]["z"] == -3.0
    assert made["current"]["speed_knots"] == 1.5 and made["current"]["incidence_deg"] == 30.0
    assert made["slewing"]["seed"] == 4 and case.together == 3
    body = scene_of(case).bodies[0]
    assert list(body.gyration) == pytest.approx(
        [math.sqrt((b**2 + c**2) / 12) for b, c in ((50, 20), (100, 20), (100, 50))]
    )


def test_sigma_beside_the_tests_of_appendix_1(capsys):
    """chain-0-0.9: surge 7.157 cm, pitch 1.105° measured"""
    (row,) = [one for one in appendix_1.read_rows("chain-0-0.9") if one["source"] == "test"]
    printed = {key: float(row[key] or "nan") for key in appendix_1.COLUMNS}
    made = [appendix_1.Outcome(row, variant, 3.0, {k: share * v for k, v in printed.items()}, printed)
            for variant, share in (("full", 0.8), ("report", 1.3))]  # fmt: skip
    rows = {(one["calculation"], one["quantity"]): one for one in rows_of(appendix_1.table_text(made, 2))}
    one = rows["full", "surge_cm"]
    assert (one["printed"], float(one["computed"]), one["computed_over_printed"]) == (
        "7.157",
        pytest.approx(5.7256, rel=1e-3),
        "0.8",
    )
    assert rows["report", "pitch_deg"]["computed_over_printed"] == "1.3" and float(one["slow_part"]) == 7.157
    assert "0°, surge cm: computed over measured full 0.80 to 0.80, report 1.30 to 1.30" in list(
        appendix_1.summary(made)
    )
    assert appendix_1._told(made[0]).startswith("chain-0-0.9            full   surge cm 5.73 (7.157)")


def test_models_at_rest_stand_beside_what_was_measured():
    """M3B on chain: 2.78 kgf measured, 2.55 of a catenary; surge 16.48 s"""
    one = appendix_1.AtRest("M3B", "chain", 2.56, np.array([16.0, 18.0, 1.8, 1.9, 17.0]))
    (row,) = rows_of(appendix_1.rest_text([one]))
    assert (row["tension_kgf"], row["tension_catenary_kgf"], row["tension_measured_kgf"]) == ("2.56", "2.55", "2.78")
    assert (row["surge_s"], row["surge_s_measured"], row["yaw_s"], row["yaw_s_measured"]) == (
        "16",
        "16.48",
        "17",
        "17.04",
    )
    assert appendix_1._of_rest(one) == (
        "M3B chain : line 2.560 kgf (catenary 2.55, measured 2.78); surge 16 (16.48) s, sway 18 (18.52) s, "
        "roll 1.8 (1.78) s, pitch 1.9 (1.87) s, yaw 17 (17.04) s"
    )


def test_models_are_computed_at_the_size_of_their_prototypes():
    """Lengths times 46.5, times √46.5, masses 46.5³ (Froude); ω √(L/g) is the same"""
    scene = appendix_1.scene_of("M3B")
    body, s = scene["bodies"][0], 46.5
    assert [body[key] for key in ("length", "beam", "draft")] == pytest.approx([3.872 * s, 1.936 * s, 0.1936 * s])
    assert body["center_of_gravity"][2] == pytest.approx((0.458 - 0.1936) * s) and scene["water"][
        "depth"
    ] == pytest.approx(1.2 * s)
    assert body["gyration"] == pytest.approx([k * s for k in (0.674, 1.12, 1.408)])
    assert scene["waves"]["omegas"]["from"] == pytest.approx(0.4 / math.sqrt(s))
    study = appendix_1.study_of("M3B", "sinker")
    assert study["types"]["chain"]["weight_kg_per_m"] == pytest.approx(0.871 * s**2)
    line = next(one for one in study["lines"] if one["name"] == "bow port")
    away = np.array(line["anchor"])[:2] - np.array(line["fairlead"])[:2]
    assert away == pytest.approx(np.full(2, 7.1 / math.sqrt(2) * s)) and line["fairlead"][:2] == pytest.approx(
        [1.936 * s, 0.968 * s]
    )
    assert [part["length"] for part in line["segments"]] == pytest.approx([4.042 * s, 3.44 * s])
    (body,) = line["bodies"]
    assert body["mass"] - 1000 * body["volume"] == pytest.approx(2.87 * s**3) and body["mass"] == pytest.approx(
        3.26 * s**3
    )
    (row,) = [one for one in appendix_1.read_rows("chain-0-0.9") if one["source"] == "test"]
    made = appendix_1.simulation_of(row, "report", 3)
    assert made["waves"]["height"] == pytest.approx(4 * 0.03002 * s) and made["waves"]["period"] == pytest.approx(
        2.19 * math.sqrt(s)
    )
    assert made["simulation"]["memory"] == "constant" and made["simulation"]["wave_drift_damping"] is False


def of_point(case="W2", pitch=1.6, hawser=2.0, buoy=3.5, massless=1.0, settled=100.0, slews=False):
    (row,) = appendix_2.read_rows(case)
    return appendix_2.Outcome(row, pitch, hawser, buoy, massless, settled, slews, "28 4")


def test_appendix_2_stands_beside_what_was_measured():
    """W2: 6.45 cm, pitch 1.445°, 2.08 kgf of a hawser, 3.70 on the buoy; σ over σ is twice the ratio of significant"""
    said = list(appendix_2.summary([of_point(), of_point("W1", settled=np.nan, slews=True)]))
    ours, measured = (np.mean([2 * a / 6.45, 2 * b / 4.59]) for a, b in ((1.6, 1.6), (1.445, 1.08)))
    assert said[0] == f"B/d 10, intermediate: σ of pitch over σ of the waves {ours:.3f} °/cm, measured {measured:.3f}"
    assert "waves alone, 2 tests: 2.00 kgf of a hawser at the bow, measured 1.61" in said
    assert "waves alone, 2 tests: 3.50 kgf on the buoy, 1.00 without its mass, measured 2.79" in said or any(
        line.startswith("waves alone, 2 tests: 3.50 kgf on the buoy, 1.00 without its mass, measured 2.8")
        for line in said
    )
    assert said[-1] == "slewing that stays: W1 of 2; the heading comes to rest in 1"
    told = appendix_2._told(of_point())
    assert "pitch 1.60 (1.445) °" in told and "hawser 2.00 (2.08) kgf, on the buoy 3.50 (3.7) kgf" in told
    assert "without mass 1.00, from 0.0° at rest in 100 s, periods 28 4 (4.1, 28) s" in told
    assert "does not settle" in appendix_2._told(of_point(settled=np.nan))


def test_the_chain_of_the_prototype_follows_from_the_scale_and_its_grade():
    """1.5 kgf · 26³ · 4 = 105.5 tonf: d of the first millimetre that bears it"""
    for line in appendix_2.chains():
        assert line.startswith("chain for 105.5 tonf (1.5 kgf × 26³ × 4), grade ")
    # IACS A1: 0.00981 d² (44 − 0.08 d), 0.01373 and 0.0196 kN of grades 1, 2 and 3
    for grade, factor, printed in (("2", 0.01373, 42), ("3", 0.0196, 36)):
        line = next(one for one in appendix_2.chains() if f"grade {grade}:" in one)
        bears = lambda d, f=factor: f * d * d * (44 - 0.08 * d) / G  # noqa: E731
        first = next(d for d in range(10, 200) if bears(d) >= 105.456)
        assert f"grade {grade}: {first} mm; the report {printed} mm" in line
        assert float(line.split("breaks at ")[1].split()[0]) == pytest.approx(bears(printed), rel=5e-3)


def dolphin_row(count=1, depth=20.0, wind=50.0, height=1.0, sigma=0.1, limit=0.35, strain=0.2):
    return dolphin.Row("A", depth, count, 10.0, wind, 3.0, height, 100.0, 10.0, 0.05, sigma, strain, limit, np.nan)


def test_statements_of_the_dolphins_have_limits_and_the_worst_number(tmp_path, pictures, monkeypatch):
    monkeypatch.setattr(dolphin, "DEPTHS", {"A": (20.0,), "B": ()})
    monkeypatch.setattr(dolphin, "PRINTED", {("A", 1): 0.35, ("A", 3): 0.9})
    monkeypatch.setattr(dolphin, "WEATHER", ((50.0, 3.0),))
    rows = [dolphin_row(n, sigma=0.1 * n if n < 3 else 0.1, limit=0.3 * n) for n in (1, 2, 3)]
    said = []
    for line in dolphin.statements(rows):
        said.append(line)
        if len(said) == 3:
            break
    assert said[0].startswith("floater A, 1 on each dolphin, 10 s: printed 0.35 m, here 0.30 (20 m, 50 m/s); 0:")
    assert said[1].startswith("floater A, 3 on each dolphin, 10 s: printed 0.9 m, here 0.90 (20 m, 50 m/s)")
    assert said[2].endswith("with 1 fenders in the report, here with 2 (20 m)")
    dolphin._draw(rows, "A", tmp_path / "d.png", "")
    top, below = pictures[0].axes
    assert top.lines[-2].get_xydata() == pytest.approx(np.array([[1, 20], [2, 20], [3, 20]]))
    assert below.lines[-1].get_ydata() == pytest.approx([0.3, 0.6, 0.9])
    assert top.lines[-1].get_ydata()[0] == 35 and top.get_ylabel() == "largest strain in waves of 1 m, %"


def simulated_row(**more):
    words = dict(no=1, floater="A", depth_m=12.0, height_m=2.0, period_s=6.0, wave_m=1.0, variant="full", mean_m=0.242,
                 sigma_m=0.102, strain=0.30, verdict="stands", heave_m=0.01, sway_m=0.2, roll_deg=0.2, off=0.01,
                 printed_mean_m=0.22, printed_sigma_m=0.085, printed_strain=0.275, printed_verdict="stands",
                 printed_heave_m=0.004, printed_sway_m=0.078, printed_roll_deg=0.0705)  # fmt: skip
    return dolphin_simulated.Row(**(words | more))


@pytest.mark.parametrize("sigma, near", [(0.1019, 1), (0.1021, 0), (0.0681, 1), (0.0679, 0)])
def test_a_row_in_time_is_near_the_print_within_a_fifth(sigma, near):
    (said,) = dolphin_simulated.statements([simulated_row(sigma_m=sigma)])
    assert (
        f"full: σ within a fifth of the print in {near} of 1 rows, mean in 1, verdict of 35 % the same in 1; " in said
    )
    assert said.endswith("roll 2.84 to 2.84 times the print")


def test_the_table_in_time_is_ours_over_printed():
    table = dolphin_simulated.table_of([simulated_row()])
    cells = [next(iter(column.cells)) for column in table.columns]
    assert cells == ["1", "A", "12", "2", "6", "full", "0.242", "0.220", "0.102", "0.085", "1.20", "30.0 %", "27.5 %",
                     "stands", "stands", "2.84"]  # fmt: skip


def test_a_row_in_time_is_made_of_displacements_at_the_fender_less_the_clearance():
    """Two runs: sway of mean 0.7 and σ 0.1/√2 m, roll of σ 1°: the fenders at still water are a height below the
    centre; strain (mean + 3.87 σ)/H, stands up to 35 %"""
    t = np.arange(-10.0, 400.0, 0.5)
    motion = np.zeros((len(t), 6))
    motion[:, 1] = 0.7 + 0.1 * np.sin(2 * np.pi * t / 8)
    motion[:, 3] = math.radians(1.0) * np.sqrt(2) * np.cos(2 * np.pi * t / 8)
    run = SimpleNamespace(time=t, motion=motion)
    body = SimpleNamespace(reader=SimpleNamespace(rotation_center=(0.0, 0.0, 2.0)))
    printed = next(row for row in dolphin_simulated.printed_rows() if row["no"] == "1")
    row = dolphin_simulated._row(printed, "full", [run, run], body)
    lever = 2.0 * math.radians(1.0)  # of σ, a quarter of a period apart from the sway
    sigma = math.hypot(0.1 / math.sqrt(2), lever)
    assert row.mean_m == pytest.approx(0.2, abs=2e-3) and row.sigma_m == pytest.approx(sigma, rel=0.01)
    assert row.strain == pytest.approx((row.mean_m + 3.87 * row.sigma_m) / 2.0, rel=1e-3)
    assert row.roll_deg == pytest.approx(1.0, rel=0.01) and row.sway_m == pytest.approx(0.1 / math.sqrt(2), rel=0.01)
    assert (row.printed_mean_m, row.printed_sway_m, row.printed_roll_deg) == (0.22, 0.078, 0.0705)
    assert row.verdict == ("stands" if row.strain <= 0.35 else "too much") and row.off == pytest.approx(0.0, abs=0.01)
