"""Units, tables, ratios and statements of the report's comparisons, of results that are made up."""

import csv
import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.validation.comparisons import models, panels, report_units, series, tables

L, B, RHO, G, VOLUME = 100.0, 50.0, 1025.0, 9.8, 50_000.0
ARM = np.array([1, 1, 1, B / 2, L / 2, L / 2])
OMEGA = np.array([0.4, 0.6, 0.8])
K = np.array([0.03, 0.05, 0.08])


def database():
    n = len(OMEGA)
    db = {
        "added_mass": np.ones((n, 6, 6)) * RHO * VOLUME * np.outer(ARM, ARM) * 0.5,
        "radiation_damping": np.ones((n, 6, 6)) * RHO * VOLUME * np.outer(ARM, ARM) * 0.25 * OMEGA[:, None, None],
        "excitation_force": np.tile((RHO * G * L * B / 2 * ARM * 0.3j), (n, 2, 1)),
        "rao": 0.7 * np.where(np.arange(6) < 3, 1.0, K[:, None, None]) * np.ones((n, 2, 6)),
        "drift_force": np.tile(0.5 * RHO * G * L * np.array([0.4, -0.2, 0.1 * L]), (n, 2, 1)),
        "wavenumber": K,
    }  # fmt: skip

    class Stored(dict):
        pass

    made = Stored(db)
    made.omega, made.wave_direction = OMEGA, np.radians([180.0, 270.0])
    made.dimensions, made.density, made.gravity, made.displaced_volume = {"length": L, "beam": B}, RHO, G, VOLUME
    made.names = tuple(db)
    return made


def results(columns=None, chi=(0, 90)):
    case = SimpleNamespace(
        name="box", chi=chi, scene=SimpleNamespace(omegas=lambda: OMEGA), columns=columns or {"L_over_B": 2.0}
    )
    return report_units.in_report_units(case, database())


def test_coefficients_forces_motions_and_drift_have_the_units_of_the_report():
    """a/(ρ∇ l_i l_j), b/(ρ∇ω l_i l_j), F/(ρg LB/2 l_i), φ/k, D/(½ρgL), ξ_B = ω²B/2g; χ = 0 travels to 180°"""
    made = results()
    assert made.xi == pytest.approx(OMEGA**2 * B / 2 / G)
    assert made.added_mass == pytest.approx(np.full((3, 6, 6), 0.5)) and made.damping == pytest.approx(
        np.full((3, 6, 6), 0.25)
    )
    assert made.forces == pytest.approx(np.full((3, 2, 6), 0.3j)) and made.motions == pytest.approx(
        np.full((3, 2, 6), 0.7)
    )
    assert made.drift[0, 0] == pytest.approx([0.4, -0.2, 0.1])
    assert made.coefficient("A33") == pytest.approx([0.5] * 3) and made.coefficient("B24") == pytest.approx([0.25] * 3)
    assert (report_units.travel(0), report_units.travel(90), report_units.travel(200)) == (180.0, 270.0, 20.0)
    assert (made.heading(90), made.heading(0)) == (1, 0)
    assert report_units.lag(1j) == pytest.approx(90.0) and report_units.lag(-1) == pytest.approx(180.0)


def test_tables_have_a_row_for_each_case_frequency_and_heading():
    made = results()
    rows = tables.coefficient_rows([made])
    assert len(rows) == 3 and rows[1]["A33"] == pytest.approx(0.5)
    assert rows[2]["xi_B"] == pytest.approx(0.64 * 25 / 9.8, rel=1e-5)
    waves = tables.wave_rows([made], "forces")
    assert len(waves) == 6
    assert [waves[1][key] for key in ("chi_deg", "F3", "eps3_deg")] == pytest.approx([90.0, 0.3, 90.0])
    drift = tables.drift_rows([made, results()])
    assert len(drift) == 12 and drift[0]["D_y"] == pytest.approx(-0.2)
    assert [row["chi_deg"] for row in drift[:3]] == [0, 90, 0] and drift[2]["xi_B"] == pytest.approx(made.xi[1])
    made.forces[:, 1, 3] = 0  # beam waves that do not roll it
    assert np.isnan(next(row for row in tables.wave_rows([made], "forces") if row["chi_deg"] == 90.0)["F4"])
    drawn = panels.wave_panels([panels.Line(made, "one", {})], "forces", False, [0, 90])
    assert len(drawn) == 12 and drawn[0].curves[0].y == pytest.approx([0.3] * 3)
    assert [panel.title.endswith("zero by symmetry") for panel in drawn] == [False] * 9 + [True, False, False]
    (curve,) = panels.coefficient_panels([panels.Line(made, "one", {})], "B")[1].curves
    assert curve.y == pytest.approx([0.25] * 3) and curve.x == pytest.approx(made.xi)


@pytest.mark.parametrize("kind", ["forces", "motions"])
@pytest.mark.parametrize("largest", [1e-4, 1.0, 1e4])
def test_waves_drive_a_mode_above_a_share_of_what_it_has_in_other_headings(kind, largest):
    made = results()
    size = np.zeros((3, 2, 6))
    size[1, 0], size[2, 1] = largest, largest * report_units.QUIET * np.array([1.1, 0.9, 1.1, 0.9, 0, 2])
    made = made._replace(**{kind: size * 1j})
    assert made.driven(kind).tolist() == [[True] * 6, [True, False, True, False, False, True]]


def of_box(factor, xi=(0.4, 0.5, 1.0, 1.7)):
    pairs = {f"{letter}{pair}": np.full(4, factor) for letter in "AB" for pair in ("33", "22", "44")}
    forces = np.full((4, 1, 6), factor * 1j)
    return SimpleNamespace(coefficient=pairs.__getitem__, forces=forces, heading=lambda chi: 0, xi=np.array(xi),
                           case=SimpleNamespace(name="box", columns={"L_over_B": factor}))  # fmt: skip


def test_ratios_over_strips_are_told_between_045_and_16(monkeypatch):
    """1.2 and 0.9 of the strips: off by 20 and 10 %"""
    strips, boxes = of_box(2.0), [of_box(2.4), of_box(1.8)]
    found = series.ratios(boxes, strips)
    assert set(found) == {f"{kind}_{mode}" for kind in "MNF" for mode in "HSR"}
    for values in found.values():
        assert values == pytest.approx(np.array([[1.2] * 4, [0.9] * 4]))
    monkeypatch.setattr(series, "LENGTH_BEAM", (1.0, 2.0))
    said = list(series.Sections().summary([*boxes, strips]))
    assert said[0] == "Heave added mass M/m: off 1 by at most 20 %, 10 % at L/B 1, 2, ξ_B 0.5, 1"
    assert len(said) == 9 and any(line.startswith("Roll force F/f: off 1") for line in said)
    rows = series.Sections().tables([*boxes, strips])["frequency"]
    assert len(rows) == 8 and rows[5]["M_H"] == pytest.approx(0.9) and rows[5]["xi_B"] == 0.5


def test_methods_are_apart_by_their_largest_differences():
    """3 % of the largest added mass of a pair, 2 % of the largest force; pairs that are nothing do not count"""
    one, other = results({"method": "contour"}), results({"method": "panel"})
    taken = {name: np.array(getattr(other, name)) for name in ("added_mass", "damping", "forces", "xi")}
    other = SimpleNamespace(**taken, case=other.case)
    other.added_mass[1, 2, 2] += 0.015
    other.forces[2, 1, 3] += 0.006
    assert series._agreement(one, other) == (
        "panel against contour, L/B = 2, H/d = 2: at most 3.0 % of the largest added mass or damping, 2.0 % of the "
        "largest force"
    )


def test_few_values_are_spoken_and_many_are_counted():
    assert series._spoken([0.5, 1.0]) == "0.5, 1"
    assert series._spoken([0.1 * i for i in range(6)]) == "0 to 0.5 (6 values)"
    assert series._spoken([0.1, 0.2, 0.3, 0.4, 0.5]) == "0.1, 0.2, 0.3, 0.4, 0.5"


def of_model(height, size, method="contour", model="M3A_Bd10"):
    motions = np.zeros((3, 1, 6), complex)
    motions[:, 0, 3] = size
    case = SimpleNamespace(name="M", columns={"model": model, "method": method, "wave_height_m": height})
    k, xi = np.array([1.0, 2.0, 3.0]), np.array([0.1, 0.2, 0.3])
    return SimpleNamespace(motions=motions, heading=lambda chi: 0, k=k, xi=xi, case=case)


def test_roll_with_viscous_damping_is_told_where_it_is_largest_without(monkeypatch):
    """φ = X₄ k ζ_a: 4 · 2 · 0.05 rad of waves of 0.1 m"""
    monkeypatch.setattr(models, "WAVE_HEIGHTS", {"M3A_Bd10": (0.1,)})
    free, damped = of_model(0.0, [1.0, 9.0, 2.0]), of_model(0.1, [5.0, 4.0, 3.0])
    first, second = models.roll_rows([free, damped, of_model(0.0, [1, 1, 1], "panel")])
    assert (first["xi_B"], first["X4"], first["X4_largest"]) == (0.2, 9.0, 9.0) and np.isnan(first["roll_deg"])
    assert (second["xi_B"], second["X4"], second["X4_largest"]) == (0.2, 4.0, 5.0)
    assert second["roll_deg"] == pytest.approx(math.degrees(4.0 * 2.0 * 0.05))


def test_a_line_tells_the_roll_of_each_model_by_every_method_and_of_each_height_of_wave(monkeypatch):
    """Measured 2.07, 1.50 and 1.78 s (table 2.4.4.1); of methods whose period is outside the frequencies nothing"""
    nan = float("nan")
    periods = {"M3A_Bd10": {"panel": 2.1, "strip": 2.25}, "M3A_Bd20": {"panel": nan}, "M3B_Bd10": {"contour": 1.8}}
    rows = [{"model": m, "method": k, "T_roll_s": t} for m, found in periods.items() for k, t in found.items()]
    monkeypatch.setattr(models, "period_rows", lambda results: rows)
    monkeypatch.setattr(models, "WAVE_HEIGHTS", {"M3A_Bd10": (0.1,), "M3B_Bd10": (0.1,)})
    results = [of_model(h, [1.0, 9.0, 2.0], model=m) for m in ("M3A_Bd10", "M3B_Bd10") for h in (0.0, 0.1)]
    said = list(models.Models().summary(results))
    assert said[:3] == [
        "M3A, B/d = 10: roll period 2.07 s measured; panel 2.100, strip 2.250",
        "M3A, B/d = 20: roll period 1.50 s measured; none lies within the frequencies computed",
        "M3B, B/d = 10: roll period 1.78 s measured; contour 1.800",
    ]
    degrees = f"{math.degrees(9.0 * 2.0 * 0.05):.3g}°"
    assert said[3:] == [
        f"{name}: roll in beam waves, ξ_B 0.2, {how}"
        for name in ("M3A, B/d = 10", "M3B, B/d = 10")
        for how in ("no viscous damping: 9", f"waves of 10 cm: φ_a/kζ_a = 9, {degrees}")
    ]


def test_a_section_of_the_report_is_told_with_its_table(capsys):
    """Table 2.1.3.1: B/d = 5, H/d = 1.2; deep water and other shapes have none"""
    assert main(["sections", "--beam-draft", "5,6", "--depth-draft", "1.2,inf", "--xi", "0.2,1"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line[0] != "#"]
    rows = list(csv.DictReader(lines))
    assert len(rows) == 8
    named = {(row["B_over_d"], row["H_over_d"]): row["table"] for row in rows}
    assert named["5", "1.2"] == "2.1.3.1" and named["6", "1.2"] == named["5", "inf"] == ""


@pytest.mark.parametrize(
    "values, given, wanted",
    [
        ((1.0, 99.0), {}, {"ylim": (0, None)}),
        ((1.0, 101.0), {}, {"yscale": "log"}),  # a hundred times
        ((-1.0, 99.0), {}, {}),
        ((1.0, 101.0), {"ylim": (0, 2)}, {"ylim": (0, 2)}),  # as asked for
    ],
)
def test_an_axis_begins_at_zero_or_is_logarithmic_where_values_are_positive_and_no_limits_are_given(
    values, given, wanted
):
    line = panels.Line(SimpleNamespace(xi=np.array([1.0, 2.0])), "a", {})
    assert panels.panel("t", [line], lambda _: np.array(values), **given).axes == {"xlabel": panels.XI, **wanted}


ROLL, PITCH, BOTH, NEITHER = (3,), (4,), (3, 4), ()


@pytest.mark.parametrize("alone, coupled, known", [
    (BOTH, BOTH, BOTH), (NEITHER, BOTH, NEITHER), (BOTH, NEITHER, NEITHER), (ROLL, BOTH, ROLL), (BOTH, PITCH, PITCH),
    (ROLL, PITCH, NEITHER),
])  # fmt: skip
def test_a_period_of_a_model_is_known_where_the_motion_alone_and_coupled_both_lie_within(
    alone, coupled, known, monkeypatch
):
    """Periods of 2 and 1.6 s alone, 2.2 and 1.7 s coupled; 2.07 and 1.87 s measured; A = ω in a unit of 2 of roll, 4
    of pitch"""

    def periods(reader, coupled=True):
        within = sides[coupled]
        values = np.array([0, 0, 0, 2.2, 1.7, 0]) if coupled else np.array([0, 0, 0, 2.0, 1.6, 0])
        return SimpleNamespace(inside=np.isin(np.arange(6), within), period=values)

    sides = {False: alone, True: coupled}
    monkeypatch.setattr(models, "natural_periods", periods)
    monkeypatch.setattr(models, "unit_of_added_mass", lambda db: np.diag([1.0, 1, 1, 2, 4, 1]))
    case = SimpleNamespace(name="run", columns={"model": "M3A_Bd10", "method": "contour", "other": 1})
    db = SimpleNamespace(reader=SimpleNamespace(held_added_mass=lambda omega: np.full((1, 6, 6), omega)))
    (row,) = models.period_rows([SimpleNamespace(db=db, case=case)])
    by_hand = {"case": "run", "model": "M3A_Bd10", "method": "contour"}
    roll, pitch = (1.0 if d in known else np.nan for d in (3, 4))
    by_hand |= {
        "A44": roll * math.pi / 2, "T_roll_s": roll * 2.0, "T_roll_coupled_s": roll * 2.2, "T_roll_measured_s": 2.07,
        "T_roll_difference_percent": roll * 100 * (2.0 / 2.07 - 1),
        "A55": pitch * 2 * math.pi / 1.6 / 4, "T_pitch_s": pitch * 1.6, "T_pitch_coupled_s": pitch * 1.7,
        "T_pitch_measured_s": 1.87, "T_pitch_difference_percent": pitch * 100 * (1.6 / 1.87 - 1),
    }  # fmt: skip
    assert row == pytest.approx(by_hand, nan_ok=True)
