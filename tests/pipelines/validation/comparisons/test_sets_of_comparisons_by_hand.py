"""Which boxes and models the sets ask for, how a set is made, and what its pictures hold: nothing is solved."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.validation import beside
from hakobune.pipelines.validation.comparisons import cases, models, panels, report_units, series, sets, tables
from hakobune.pipelines.validation.series import flags


def test_a_box_of_the_series_is_solid_with_its_centre_in_the_waterplane():
    """Radii of gyration of a solid 100 × 50 × 20 m: √((b² + h²)/12) and so on"""
    case = cases.series_case(2.0, 1.4, xi=(0.5, 1.0))
    body, scene = case.scene.bodies[0], case.scene
    assert (body.length, body.beam, body.draft, scene.water.depth) == (100.0, 50.0, 10.0, 14.0)
    assert tuple(body.gyration) == pytest.approx(
        (math.sqrt((2500 + 400) / 12), math.sqrt((10000 + 400) / 12), math.sqrt((10000 + 2500) / 12)))  # fmt: skip
    assert case.name == "LB2_Hd1.4_contour" and case.chi == (0, 30, 45, 60, 90)
    assert case.columns == {"method": "contour", "L_over_B": 2.0, "H_over_d": 1.4, "B_over_d": 5.0}
    assert scene.method == "contour" and scene.tolerance == 1e-3
    assert set(scene.want) == {"added_mass", "radiation_damping", "excitation_force", "rao"}
    assert scene.omegas() == pytest.approx(np.sqrt(2 * 9.80665 * np.array([0.5, 1.0]) / 50))
    deep = cases.series_case(1.5, math.inf)
    assert (deep.scene.method, deep.scene.tolerance, deep.name) == ("panel", 0.01, "LB1.5_Hdinf_panel")
    assert cases.series_case(8.0, 2.0, "strip").columns["method"] == "strip"
    assert cases.waves((0.5, 1), (0, 45, 90)) == {"xi_B": [0.5, 1.0], "headings_deg": [180.0, 225.0, 270.0]}
    assert cases.waves({"from": 1}, (270,)) == {"xi_B": {"from": 1}, "headings_deg": [90.0]}
    assert cases.CLOSE_XI[0] == 0.1 and len(cases.CLOSE_XI) == 54 and cases.CLOSE_XI[-1] == 2.75


@pytest.mark.parametrize(
    ("method", "height", "tolerance", "drifts"),
    [
        ("contour", None, 1e-3, True),
        ("contour", 0.065, 1e-3, True),
        ("strip", None, 1e-3, False),
        ("panel", None, None, True),
    ],
)
def test_a_model_turns_about_its_centre_of_gravity_and_drifts_where_its_method_knows(method, height, tolerance, drifts):
    """M3A of L/B = 1.2, 2.4 × 2 m, in water of 1.2 m"""
    case = cases.model_case("M3A_Bd10", method, (0.5, 1.0), height)
    scene = case.scene
    assert scene.rotation_center == scene.bodies[0].center_of_gravity and scene.method == method
    assert tolerance is None or scene.tolerance == tolerance
    assert ("drift_force" in scene.want) is drifts and case.chi == (0, 45, 90)
    if height:
        assert case.name == "M3A_Bd10_contour_6.5cm" and case.columns["wave_height_m"] == 0.065
        assert (scene.viscous.wave_height, scene.viscous.roll) == (0.065, "Yamashita")
    else:
        assert case.name == f"M3A_Bd10_{method}" and not scene.viscous
        assert case.columns == {"model": "M3A_Bd10", "method": method, "wave_height_m": 0.0}


def test_sets_ask_for_their_boxes_with_one_check_of_another_method(monkeypatch):
    monkeypatch.setattr(series, "series_case", lambda *given, xi=None: (*given, xi) if xi else given)
    close, few = cases.CLOSE_XI, cases.XI
    depths = [(2.0, depth, close) for depth in (1.2, 1.4, 2.0, 5.0, 10.0, math.inf)]
    assert series.DepthSeries().cases() == [*depths, (2.0, 2.0, "panel", few)]
    lengths = [(ratio, 2.0, close) for ratio in (1.0, 1.5, 2.0, 4.0, 8.0)]
    assert series.LengthSeries().cases() == [*lengths, (2.0, 2.0, "panel", few), (8.0, 2.0, "strip", close)]
    assert series.Sections().cases() == [*((r, 2.0, few) for r in (1.0, 1.5, 2.0, 4.0, 8.0)), (8.0, 2.0, "strip", few)]
    assert series.Motions().cases([0.7]) == [(r, 2.0, [0.7]) for r in (1.0, 1.5, 2.0, 4.0)]
    assert series.DepthSeries().cases([0.7])[-1] == (2.0, 2.0, "panel", [0.7])
    monkeypatch.setattr(models, "model_case", lambda *given: given)
    found = models.Models().cases()
    assert len(found) == 3 * 5 + 2 * 3 and found[0] == ("M3A_Bd10", "panel", models.XI)
    assert found[15:] == [
        (m, "contour", models.XI, h)
        for m, hs in (("M3A_Bd10", (0.0325, 0.065, 0.13)), ("M3B_Bd10", (0.025, 0.05, 0.1)))
        for h in hs
    ]
    assert models.XI[0] == 0.3 and models.XI[-1] == 3.0 and {0.9, 0.95, 1.8} <= set(models.XI) and len(models.XI) == 37


def result(name="box", method="contour", factor=1.0, height=0.0, depth=2.0, ratio=2.0, model="M3A_Bd10", drift=True):
    n, m = 3, 3
    columns = {"method": method, "L_over_B": ratio, "H_over_d": depth, "model": model, "wave_height_m": height}
    matrix = factor * (1 + np.arange(36.0).reshape(6, 6)) * np.ones((n, 1, 1))
    forces = factor * np.exp(0.5j) * (1 + np.arange(6)) * np.ones((n, m, 1))
    return report_units.Results(
        SimpleNamespace(name=name, columns=columns), None, np.array([0.3, 0.5, 1.7]), np.array([0.01, 0.02, 0.03]),
        np.array([0.0, 45.0, 90.0]), matrix, 2 * matrix, forces, 3 * forces,
        factor * np.arange(27.0).reshape(n, m, 3) if drift else None,
    )  # fmt: skip


def test_pictures_of_series_have_coefficients_and_forces_of_every_box():
    shown = [result(depth=depth, factor=i + 1.0) for i, depth in enumerate((1.2, math.inf))]
    lines = series.DepthSeries().lines([*shown, result(method="panel")])
    assert [line.label for line in lines] == ["H/d 1.2", "H/d ∞, panel method", "H/d 2, panel method"]
    assert [line.style.get("marker") for line in lines] == [None, None, "x"]
    lines = series.LengthSeries().lines([result(ratio=1.5), result(), result(method="strip")])
    assert [line.label for line in lines] == ["L/B 1.5", "L/B 2, panel method", "L/B 8, strips"]
    assert lines[2].style == {"color": "0.2", "linestyle": (0, (4, 2))} and lines[1].style["linestyle"] == ""
    made = series.DepthSeries().pictures([*shown, result(method="panel")])
    assert {name: (title, columns) for name, (title, _, columns) in made.items()} == {
        "added_mass": ("Added mass, L/B = 2, B/d = 5  (figs. 2.1.5.3-46)", 5),
        "damping": ("Damping, L/B = 2, B/d = 5  (figs. 2.1.5.3-46)", 5),
        "force_amplitude": ("Exciting force, L/B = 2, B/d = 5  (figs. 2.1.5.3-46)", 6),
        "force_phase": ("Exciting force, phase, L/B = 2, B/d = 5  (figs. 2.1.5.3-46)", 6),
    }  # fmt: skip
    a33, b33 = made["added_mass"][1][2], made["damping"][1][2]
    assert (a33.title, b33.title) == ("A33", "B33") and len(made["damping"][1]) == 10
    assert a33.curves[1].y == pytest.approx([30] * 3) and b33.curves[1].y == pytest.approx([60] * 3)
    heave = made["force_amplitude"][1][2]
    assert heave.title == "Heave, F3, χ = 0°" and heave.curves[0].y == pytest.approx([3] * 3)
    phase = made["force_phase"][1][6]
    assert phase.title == "Surge, ε, °, χ = 30°" and phase.curves[0].y == pytest.approx([math.degrees(0.5)] * 3)
    assert phase.axes["ylim"] == (-190, 190) and phase.axes["yticks"] == (-180, -90, 0, 90, 180)
    motions = series.Motions().pictures([result(ratio=4.0)])
    words = "H/d = 2, B/d = 5, no viscous damping  (figs. 2.4.3.1-24)"
    assert motions["amplitude"][0] == f"Motions, {words}" and motions["phase"][0] == f"Motions, phase, {words}"
    roll = motions["amplitude"][1][3]
    assert roll.title == "Roll, φ_a/kζ_a, χ = 0°" and roll.curves[0].y == pytest.approx([12] * 3)
    assert roll.curves[0].label == "L/B 4" and motions["phase"][1][3].curves[0].y == pytest.approx(
        [math.degrees(0.5)] * 3
    )


def test_the_picture_of_sections_is_over_length_and_its_line_of_one():
    boxes = [result(ratio=ratio, factor=1 / ratio) for ratio in series.LENGTH_BEAM]
    title, drawn, columns = series.Sections().pictures([*boxes, result(method="strip")])["ratios"]
    assert title == "Three-dimensional over two-dimensional, H/d = 2, B/d = 5, beam waves" and columns == 3
    assert [panel.title for panel in drawn][:4] == [
        "Fig. 2.1.5.91  Heave added mass M/m",
        "Fig. 2.1.5.92  Sway added mass M/m",
        "Fig. 2.1.5.93  Roll added mass M/m",
        "Fig. 2.1.5.94  Heave damping N/n",
    ]
    assert len(drawn) == 9 and drawn[8].title == "Fig. 2.1.5.99  Roll force F/f" and drawn[0].levels == (1.0,)
    assert drawn[0].axes == {"xlabel": "L/B", "xscale": "log", "xticks": series.LENGTH_BEAM}
    curve = drawn[5].curves[1]
    assert curve.label == "ξ_B 0.5" and curve.x == series.LENGTH_BEAM and curve.style["marker"] == "."
    assert curve.y == pytest.approx([1, 1 / 1.5, 1 / 2, 1 / 4, 1 / 8])
    assert len({tuple(np.ravel(curve.style["color"])) for curve in drawn[0].curves}) == 3


def test_lines_of_series_tell_differences_of_methods_and_largest_rolls(monkeypatch):
    monkeypatch.setattr(series, "_agreement", lambda one, other: (one, other))
    assert list(series.DepthSeries().summary([*range(7)])) == [(2, 6)]
    assert list(series.LengthSeries().summary([*range(7)])) == [(2, 5)]
    one = result(ratio=1.5)
    one.motions[1, 2, 3] = 20j
    one.motions[0, 0, 3] = 99
    assert list(series.Motions().summary([one])) == [
        "L/B 1.5: largest roll in beam waves φ_a/kζ_a = 20 at ξ_B 0.5"]  # fmt: skip


def test_pictures_of_models_have_each_method_in_its_style_and_roll_by_height():
    inviscid = [
        result(method=m, model=model, drift=m == "contour") for model in cases.MODELS for m in ("contour", "strip")
    ]
    damped = [result(height=h, model=model, factor=1 + 10 * h) for model, hs in models.WAVE_HEIGHTS.items() for h in hs]
    made = models.Models().pictures([*inviscid, *damped])
    title, drawn, columns = made["M3A_Bd20"]
    assert (
        title == "M3A, B/d = 20, motions  (figs. 2.4.4.4; the pressure method has no surge, sway, yaw)" and columns == 6
    )
    assert [curve.label for curve in drawn[0].curves] == ["contour", "strip"] and len(drawn) == 18
    assert drawn[0].curves[1].style == models.STYLES["strip"]
    title, drawn, columns = made["drift"]
    assert title == "Mean drift force over ½ρgLζ_a², positive forward and to port  (figs. 2.4.4.8-11)" and columns == 4
    assert [panel.title for panel in drawn[:4]] == [f"M3A, B/d = 10, {words}°" for words in (
        "D_x, χ = 0", "D_x, χ = 45", "D_y, χ = 45", "D_y, χ = 90")]  # fmt: skip
    assert len(drawn) == 12 and [curve.label for curve in drawn[0].curves] == ["contour"]
    assert drawn[1].curves[0].y == pytest.approx([3, 12, 21]) and drawn[3].curves[0].y == pytest.approx([7, 16, 25])
    assert drawn[3].axes["ylim"] == (None, None)
    title, drawn, *shape = made["roll"]
    assert title == "Roll in beam waves with the viscous damping b_R of Yamashita, for deep water" and shape == [
        2,
        (5, 4),
        False,
    ]
    assert [panel.title for panel in drawn] == ["M3A, B/d = 10", "M3B, B/d = 10"] and drawn[0].axes[
        "ylabel"
    ] == "φ_a/kζ_a"
    labels = ["no viscous damping", "waves of 3.25 cm", "waves of 6.5 cm", "waves of 13 cm"]
    assert [curve.label for curve in drawn[0].curves] == labels
    assert [curve.style["color"] for curve in drawn[0].curves] == ["0.1", "C0", "C1", "C3"]
    assert drawn[0].curves[3].y == pytest.approx([12 * 2.3] * 3)


def test_tables_of_models_are_of_all_and_periods_without_viscous_damping(monkeypatch):
    for name in ("wave_rows", "drift_rows", "period_rows", "roll_rows"):
        monkeypatch.setattr(models, name, lambda results, *kind, name=name: (name, len(results), *kind))
    found = models.Models().tables([result(), result(height=0.1), result(height=0.2)])
    assert found == {"wave": ("wave_rows", 3, "motions"), "drift": ("drift_rows", 3), "model": ("period_rows", 1),
                     "roll": ("roll_rows", 3)}  # fmt: skip
    monkeypatch.setattr(series, "coefficient_rows", lambda results: "coefficients")
    monkeypatch.setattr(series, "wave_rows", lambda results, kind: kind)
    assert series.LengthSeries().tables([]) == {"frequency": "coefficients", "wave": "forces"}
    assert series.Motions().tables([]) == {"wave": "motions"}


@pytest.mark.parametrize("inside", [True, False])
def test_natural_periods_are_told_beside_the_measured_ones(monkeypatch, inside):
    """M3A, B/d = 10: 2.07 s of roll and 1.87 s of pitch; added mass over ρ∇ (B/2)² and (L/2)² at the period"""
    alone = SimpleNamespace(period=[0, 0, 0, 2.3, 1.7], inside=[False, False, False, True, True])
    coupled = SimpleNamespace(period=[0, 0, 0, 2.4, 1.6], inside=[False, False, False, inside, True])
    monkeypatch.setattr(
        models, "natural_periods", lambda reader, coupled=True, alone=alone, both=coupled: both if coupled else alone
    )
    asked = []
    matrix = np.zeros((6, 6))
    matrix[3, 3], matrix[4, 4] = 300.0, 800.0
    reader = SimpleNamespace(held_added_mass=lambda omega: asked.append(omega) or matrix[None])
    db = SimpleNamespace(reader=reader, dimensions={"length": 4.0, "beam": 2.0}, density=10.0, displaced_volume=5.0)
    one = result()._replace(db=db)
    (row,) = models.period_rows([one])
    nan = np.nan
    assert row["case"] == "box" and row["model"] == "M3A_Bd10" and row["method"] == "contour"
    found = [
        row[f"{key}"]
        for key in ("A44", "T_roll_s", "T_roll_coupled_s", "T_roll_measured_s", "T_roll_difference_percent")
    ]
    wanted = [300 / 50, 2.3, 2.4, 2.07, 100 * (2.3 / 2.07 - 1)] if inside else [nan, nan, nan, 2.07, nan]
    assert found == pytest.approx(wanted, nan_ok=True)
    found = [
        row[key]
        for key in ("A55", "T_pitch_s", "T_pitch_coupled_s", "T_pitch_measured_s", "T_pitch_difference_percent")
    ]
    assert found == pytest.approx([800 / 200, 1.7, 1.6, 1.87, 100 * (1.7 / 1.87 - 1)])
    assert asked == pytest.approx([2 * np.pi / t for t in ((2.3, 1.7) if inside else (1.7,))])


def test_rows_have_every_coefficient_amplitude_and_lag():
    one = result()
    row = tables.coefficient_rows([one])[1]
    assert row["frequency"] == "box 0.5" and row["xi_B"] == 0.5 and row["method"] == "contour"
    assert row["A15"] == 5 and row["B51"] == 50 and row["A42"] == 20 and sum(key[1:].isdigit() for key in row) == 20
    row = tables.wave_rows([one], "motions")[4]
    assert (row["wave"], row["chi_deg"]) == ("box 0.5 45", 45.0)
    assert [row[f"X{d}"] for d in range(1, 7)] == pytest.approx([3, 6, 9, 12, 15, 18])
    assert [row[f"eps{d}_deg"] for d in range(1, 7)] == pytest.approx([math.degrees(0.5)] * 6)
    row = tables.drift_rows([result(drift=False), one])[5]
    assert (row["wave"], row["D_x"], row["D_y"], row["D_yaw"]) == ("box 0.5 90", 15, 16, 17)


def test_directions_and_frequencies_are_found_among_those_of_a_database():
    db = SimpleNamespace(omega=np.array([0.4, 0.5, 0.6, 0.7]), wave_direction=np.radians([90.0, 179.0, 270.0, 359.0]))
    case = SimpleNamespace(scene=SimpleNamespace(omegas=lambda: [0.6, 0.4, 0.9]), chi=(0, 90, 180))
    rows, columns = report_units._places(case, db)
    assert rows.tolist() == [2, 0] and columns.tolist() == [1, 2, 3]


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ([170.0, -170.0, -160.0], [170, np.nan, -160]),
        ([0.0, 179.0, -1.1], [0, 179, np.nan]),
        ([10.0, -169.0], [10, -169]),
    ],
)
def test_curves_of_phases_are_broken_where_they_cross_180(values, wanted):
    assert panels._unbroken(np.array(values)) == pytest.approx(wanted, nan_ok=True)


class Set:
    def __init__(self, names=("a", "b")):
        self.names, self.asked = names, None

    def cases(self, xi):
        self.asked = xi
        return [SimpleNamespace(name=n, scene=SimpleNamespace(method=m, omegas=lambda: [1, 2]))
                for n, m in zip(self.names, ("panel", "other"), strict=True)]  # fmt: skip

    def tables(self, results):
        return {"rows": results}

    def summary(self, results):
        return "summary"

    def pictures(self, results):
        return {"one": ("title", 1), "two": ("more", 2)}


def test_a_set_is_announced_solved_and_written(monkeypatch, tmp_path, capsys):
    """A second for each frequency by panels, a tenth by a method that is not known"""
    said, written, one = [], [], Set()
    monkeypatch.setattr(sets, "told", lambda *given: said.append(given))
    monkeypatch.setattr(sets, "solved", lambda cases, folder, fresh: ([len(cases), folder, fresh], []))
    monkeypatch.setattr(sets.beside, "result", lambda *given: given)
    monkeypatch.setattr(sets, "write_result", lambda made, table: written.append((made, table)))
    monkeypatch.setattr(sets, "draw", lambda path, *words: written.append((path, words)) or path)
    monkeypatch.setattr(sets, "printed", lambda made: 3)
    folder = tmp_path / "new"
    assert sets.make("depth-series", one, folder, "0.5,1", True) == 3
    assert said == [("2 databases of 4 frequencies take", pytest.approx(2.2))] and list(one.asked) == [0.5, 1.0]
    rows = [2, folder / "databases", True]
    made = ("compare depth-series", sets.SOURCE, {"rows": rows}, "summary")
    table, pictures = folder / "depth-series.csv", [folder / f"depth-series_{end}.png" for end in ("one", "two")]
    assert written == [(made, table), (pictures[0], ("title", 1)), (pictures[1], ("more", 2))]
    assert capsys.readouterr().out.split() == [str(table), *map(str, pictures)]
    sets.make("depth-series", one, folder)
    assert one.asked is None
    monkeypatch.setattr(sets, "solved", lambda cases, folder, fresh: ([], ["a: ω = 1 rad/s: it diverges"]))
    written.clear()
    assert sets.make("depth-series", one, folder) == 1 and not written
    told = "".join(capsys.readouterr())
    assert (
        "a: ω = 1 rad/s: it diverges" in told and "no table and pictures are made; the same command tries again" in told
    )
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(SceneError, match=r"file, which is a file; allowed: a folder, or a new name"):
        sets.make("depth-series", one, file)


def test_cases_that_fail_are_told_and_left_out(monkeypatch, tmp_path, capsys):
    outcomes = {"a.h5": ((), 2, False), "b.h5": (((0.5, "no"),), 0, False)}

    def solve(scene, path, fresh):
        failures, solved, interrupted = outcomes[path.name]
        return SimpleNamespace(failures=failures, solved=solved, interrupted=interrupted, total=2)

    monkeypatch.setattr(sets, "run", SimpleNamespace(solve=solve))
    checks = {"estimated_error": np.array([0.002, np.nan, 0.004])}
    monkeypatch.setattr(sets, "open_database", lambda path: SimpleNamespace(checks=lambda: checks))
    monkeypatch.setattr(sets, "in_report_units", lambda case, db: case.name)
    found = sets.solved(Set().cases(None), tmp_path / "more" / "databases")
    assert found == (["a"], ["b: ω = 0.5 rad/s: no"])
    said = capsys.readouterr().err.splitlines()
    assert said == ["1/2  a", "  2 of 2 frequencies by this run, estimated error 4e-03", "2/2  b",
                    "  none of 2 frequencies by this run, estimated error 4e-03"]  # fmt: skip
    outcomes["b.h5"] = ((), 0, True)
    with pytest.raises(KeyboardInterrupt):
        sets.solved(Set().cases(None), tmp_path)


@pytest.mark.parametrize(
    ("which", "given", "says"),
    [
        (
            "lines",
            {"only": "a"},
            "--only is given with lines; allowed: with single-point, multi-point, appendix-1, appendix-2",
        ),
        ("appendix-1", {"hours": 1.0}, "--hours is given with appendix-1; allowed: with multi-point"),
        ("appendix-1", {"seeds": 0}, "--seeds is 0; allowed: 1 to 100"),
        ("appendix-1", {"seeds": 101}, "--seeds is 101; allowed"),
        ("appendix-1", {"seeds": 100, "only": "x"}, None),
        ("multi-point", {"hours": 0.1}, None),
        ("multi-point", {"hours": 0.09}, "--hours is 0.09; allowed: 0.1 to 24"),
        ("dolphin", {"quay": 25.0}, None),
    ],
)
def test_flags_of_a_series_are_its_own_and_within_bounds(which, given, says):
    if says is None:
        flags._check(which, given)
    else:
        with pytest.raises(ValueError, match=says.replace("(", r"\(")):
            flags._check(which, given)


@pytest.mark.parametrize("pictures", [True, False])
def test_a_series_is_made_in_its_folder_with_its_pictures(monkeypatch, tmp_path, capsys, pictures):
    from hakobune.pipelines.results import output as results
    from hakobune.pipelines.results import tables as printing
    from hakobune.pipelines.validation import picture

    made, written = [], []
    module = SimpleNamespace(make=lambda folder, **given: made.append((folder, given)) or "result")
    if pictures:
        module.pictures = lambda result: {"a.png": (f"of {result}", 1)}
    monkeypatch.setattr(flags, "import_module", lambda name: made.append(name.rsplit(".", 1)[1]) or module)
    monkeypatch.setattr(results, "write_result", lambda result, path: written.append((result, path)))
    monkeypatch.setattr(results, "check_result", lambda path, kind: written.append((kind, path)))
    monkeypatch.setattr(printing, "printed", lambda result: 1)
    monkeypatch.setattr(picture, "draw", lambda path, *words: written.append((path, words)) or path)
    folder = tmp_path / "s"
    assert flags.series("multi-point", output=folder, seeds=2, fresh=True) == 1
    assert made == ["multi_point", (folder, {"seeds": 2, "fresh": True})] and folder.is_dir()
    table = folder / "multi-point.csv"
    assert written == [("result", table), *[(folder / "a.png", ("of result", 1))] * pictures]
    told = capsys.readouterr().out.splitlines()
    assert told == [f"written: {table}", *[f"written: {folder / 'a.png'}"] * pictures]
    written.clear()
    flags.series("multi-point", output=folder)
    assert written[0] == ("series multi-point", table)


def test_tables_beside_a_publication_have_units_by_the_ends_of_their_columns():
    rows = [{"case": "a", "height_m": 1.0, "mass_t_m": 2.0, "n": 3, "speed_m_s": 4.0}] * 100
    made = beside.result("compare x", "a report", {"wave": rows, "none": []}, ["note"], ["finding"])
    of = {name: (q.unit, q.description, q.values.tolist()[:1]) for name, q in made.quantities.items()}
    assert of == {"wave.height": ("m", "height", [1.0]), "wave.mass": ("t/m", "mass", [2.0]), "wave.n": ("", "n", [3]),
                  "wave.speed": ("m/s", "speed", [4.0])}  # fmt: skip
    assert made.labels["wave"].values.tolist() == ["a"] * 100 and made.labels["wave"].description == "wave"
    assert made.quantities["wave.n"].table == "compare x, each wave, beside a report"
    assert beside.result("k", "s", {"wave": rows * 2}).quantities["wave.n"].table == ""
    assert beside.result("k", "s", {"wave": rows}, shown=False).quantities["wave.n"].table == ""
    assert (made.notes, made.findings) == (("note",), ("finding",))
    assert beside.number("") != beside.number("") and beside.number("2.5") == 2.5
    named = {"A-sinker": 1, "A-buoy": 2, "AB": 3, "B": 4}
    assert [beside.chosen(named, only) for only in (None, "A", "A-sinker, B", "AB")] == [
        [1, 2, 3, 4],
        [1, 2],
        [1, 4],
        [3],
    ]
    with pytest.raises(Exception, match=r"--only names 'C'; allowed: A-sinker, A-buoy, AB, B, or beginnings of names"):
        beside.chosen(named, "A,C")


def test_cases_are_announced_one_after_another(capsys):
    assert list(beside.one_by_one([3, 4], lambda one: f"case {one}")) == [3, 4]
    assert capsys.readouterr().err == "1/2  case 3\n2/2  case 4\n"


@pytest.mark.parametrize(("status", "interrupted"), [(0, False), (1, False), (130, True)])
def test_a_database_of_a_series_is_whole(monkeypatch, tmp_path, status, interrupted):
    from hakobune.pipelines.solve import run

    monkeypatch.setattr(
        run, "solve", lambda scene, path, fresh: SimpleNamespace(interrupted=interrupted, exit_status=status)
    )
    monkeypatch.setattr(beside, "open_database", lambda path: path.name)
    path = tmp_path / "new" / "a.h5"
    if interrupted:
        with pytest.raises(KeyboardInterrupt):
            beside.database("scene", path, False)
    elif status:
        with pytest.raises(ValueError, match=r"a\.h5 is incomplete: not all frequencies .* see hakobune check"):
            beside.database("scene", path, False)
    else:
        assert beside.database("scene", path, False) == "a.h5" and path.parent.is_dir()
