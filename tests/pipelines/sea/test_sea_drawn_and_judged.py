"""`hakobune sea`: its picture, its records and files, and each of its limits from both sides."""

import math
import re

import numpy as np
import pytest

from hakobune.pipelines.cli import main

SEA = ["sea", "--height", "3", "--mean-period", "8"]


def issc(omega, H=3.0, T=8.0):
    """S = 0.11 H² (T/2π)(Tω/2π)⁻⁵ exp(−0.44 (Tω/2π)⁻⁴), of the mean period (ISSC 1964), within its rounded constants"""
    x = T * omega / (2 * math.pi)
    return 0.11 * H**2 * T / (2 * math.pi) * x**-5 * np.exp(-0.44 * x**-4)


def test_the_picture_of_a_spectrum_has_its_density_and_its_periods(tmp_path, asked, pictures):
    asked(*SEA, "--plot", tmp_path / "sea.png")
    (axis,) = pictures[0].axes
    omega, S = axis.lines[0].get_data()
    assert pytest.approx(issc(omega), rel=0.03, abs=0.02) == S
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("ω  rad/s", "S(ω)  m² s/rad")
    marks = {line.get_label(): line.get_xdata()[0] for line in axis.lines[1:]}
    for label, at in marks.items():
        assert 2 * math.pi / at == pytest.approx(float(label.split()[1]), rel=1e-3)
    assert next(at for label, at in marks.items() if label[:3] == "T01") == pytest.approx(2 * math.pi / 8, rel=3e-3)
    assert axis.get_title(loc="left") == "4√m₀ = 3 m"


def test_a_record_that_is_made_has_its_steps_and_its_picture(tmp_path, asked, pictures):
    words = ["--record", tmp_path / "r.csv", "--duration", 1200, "--step", 0.25, "--plot", tmp_path / "p.png"]
    (made,), _ = asked(*SEA, *words)
    t, eta = np.loadtxt(tmp_path / "r.csv", delimiter=",", comments="#", skiprows=0, usecols=(0, 1),
                        converters=lambda x: float(x) if x[0].isdigit() or x[0] == "-" else math.nan).T  # fmt: skip
    t, eta = t[np.isfinite(t)], eta[np.isfinite(t)]
    assert len(t) == 4800 and np.diff(t) == pytest.approx(np.full(4799, 0.25))
    assert "record of 4800 values at 0.25 s" in made["notes"][0]
    height = made["quantities"]["height.record"]["values"][made["axes"]["of"]["values"].index("4√m₀")]
    assert height == pytest.approx(4 * eta.std(), rel=1e-3) and height == pytest.approx(3.0, rel=0.1)
    _, whole, first = pictures[0].axes
    assert whole.lines[0].get_xydata() == pytest.approx(np.stack([t, eta], 1), abs=1e-5)
    assert first.lines[0].get_xdata()[-1] == pytest.approx(600.0, abs=0.3)
    assert (first.get_xlabel(), first.get_ylabel()) == ("t  s", "η  m")


def test_the_band_of_a_record_loses_the_shortest_waves_of_its_tail(tmp_path, asked):
    """Σ of 0.1 to 99.9 % of the energy: m₂ of a tail ω⁻⁵ up to ω_h misses ∫ ω² A ω⁻⁵, so that T02 is longer"""
    (made,), _ = asked(*SEA, "--record", tmp_path / "r.csv", "--duration", 600)
    line = next(line for line in made["notes"] if "the record has waves of" in line)
    low, high, period, more = (float(x) for x in re.findall(r"\d+\.?\d*", line.replace("T02", ""))[:4])
    omega = np.linspace(low, high, 40000)
    S = issc(omega)
    held = 2 * math.pi * math.sqrt(np.trapezoid(S, omega) / np.trapezoid(omega**2 * S, omega))
    assert period == pytest.approx(held, rel=5e-3)
    whole = np.linspace(0.05, 200.0, 2_000_000)
    S = issc(whole)
    T02 = 2 * math.pi * math.sqrt(np.trapezoid(S, whole) / np.trapezoid(whole**2 * S, whole))
    assert more == pytest.approx(100 * (held / T02 - 1), abs=0.15)


def test_a_table_that_is_written_has_the_density_it_names(tmp_path, asked):
    asked(*SEA, "--output", tmp_path / "s.csv")
    first, names, *rows = (tmp_path / "s.csv").read_text().splitlines()[:900]
    assert names == "omega_rad_s,density_m2_s_rad" and "; 4 sqrt(m0) 3 m, Tp 10.38" in first
    omega, S = np.array([row.split(",") for row in rows], float).T
    assert pytest.approx(issc(omega), rel=0.03, abs=0.02) == S


def test_a_point_sees_the_waves_later_by_the_way_over_their_speed(tmp_path, asked):
    """Of one wave of 10 s in deep water, k = ω²/g: 100 m along their direction is a lag of 100 k/ω"""
    rows = []
    for point in ("0,0", "0,100", "100,0"):
        words = ["--peak-period", 10, "--spectrum", "jonswap", "--gamma", 7, "--direction", 90, "--components", 1]
        words += ["--record", tmp_path / "r.csv", f"--point={point}", "--duration", 200, "--step", 0.1]
        asked("sea", "--height", 2, *words)
        text = [line.split(",") for line in (tmp_path / "r.csv").read_text().splitlines() if line[:1].isdigit()]
        rows.append(np.array(text, float))
        (tmp_path / "r.csv").unlink()
    (t, here), (_, along), (_, across) = (part.T for part in rows)
    assert across == pytest.approx(here, abs=1e-6)

    def left(omega):
        both = np.stack([np.cos(omega * t), np.sin(omega * t)], 1)
        return np.linalg.lstsq(both, here, rcond=None)[1][0]

    omega = min(np.arange(0.2, 4.0, 5e-4), key=left)
    lag = 100 * omega / 9.80665
    late = t > lag
    shifted = np.interp(t[late] - lag, t, here)
    assert along[late] == pytest.approx(shifted, abs=0.03 * np.abs(here).max())


@pytest.mark.parametrize("step, status", [(1.0, 0), (2.4, 1)])
def test_steps_leave_out_one_per_cent_of_the_energy_at_most(tmp_path, asked, step, status):
    """1 − exp(−0.44 (T/2h)⁻⁴) lies above π/h: 0.02 % at 1 s, 5.6 % at 2.4 s"""
    words = ["--record", tmp_path / "r.csv", "--duration", 600, "--step", step]
    _, said = asked(*SEA, *words, status=status)
    beyond = 100 * (1 - math.exp(-0.44 * (8.0 / (2 * step)) ** -4))
    assert ("is longer than half the period of" in said) is bool(status)
    if status:
        assert float(re.search(r"half the period of waves with ([\d.]+) %", said)[1]) == pytest.approx(beyond, abs=0.2)


@pytest.mark.parametrize("duration, says", [(16.0, None), (15.0, "15 steps of 1 s; allowed: 16 to 10000000")])
def test_a_record_has_sixteen_steps(tmp_path, capsys, duration, says):
    words = [*SEA, "--record", str(tmp_path / "r.csv"), "--step", "1", "--duration", f"{duration:g}"]
    status, said = main(words), capsys.readouterr().err
    assert ("steps of 1 s; allowed" in said) is (says is not None)
    assert says is None or (status == 2 and says in said)


@pytest.mark.parametrize("count, told", [(50, False), (49, True)])
def test_fewer_than_fifty_components_are_warned_of(tmp_path, asked, count, told):
    _, said = asked(*SEA, "--record", tmp_path / "r.csv", "--duration", 100, "--components", count)
    assert (
        f"{count} components are too few for a record that resolves" in said and "give --components 50 or more" in said
    ) is told


@pytest.mark.parametrize("more, told", [(1, False), (-1, True)])
def test_a_long_record_needs_a_component_for_each_twenty_five_frequencies(tmp_path, asked, more, told):
    """ω of 99.9 % of the energy times the duration over 2π: exp(−0.44 (Tω/2π)⁻⁴) = 0.999"""
    highest = 2 * math.pi / 8 * (0.44 / -math.log(0.999)) ** 0.25
    least = math.ceil(highest * 3600 / (2 * math.pi) / 25)
    _, said = asked(*SEA, "--record", tmp_path / "r.csv", "--components", least + 2 * more)
    assert ("the record is not Gaussian, and its groups and extremes differ from those of the sea" in said) is told


FLAGS = [
    ("--gamma 2", "--gamma is given for issc; allowed: with --spectrum jonswap or tma"),
    ("--fetch 1e5", "--wind-speed is missing; a sea by fetch needs"),
    ("--record r.csv --step 0", "--step is 0; allowed: above 0, finite"),
    ("--record r.csv --duration 0", "--duration is 0; allowed: above 0, finite"),
    ("--record r.csv --point 1,2,3", "--point is '1,2,3'; allowed: two numbers x,y"),
    ("--column 2", "--column has no effect, no record file is given"),
    ("--seed 3", "--seed has no effect, no --record is given; leave it out"),
]


@pytest.mark.parametrize("words, says", FLAGS)
def test_a_flag_that_cannot_be_or_has_no_effect_is_refused(tmp_path, monkeypatch, capsys, words, says):
    monkeypatch.chdir(tmp_path)
    assert main([*SEA, *words.split()]) == 2
    assert says in capsys.readouterr().err


def test_a_sea_by_fetch_has_the_peak_and_height_of_jonswap(asked):
    """f_p = 3.5 (g/U) (gF/U²)^−0.33, α = 0.076 (U²/Fg)^0.22; H = 4√m₀ of
    α g² ω⁻⁵ exp(−1.25 (ω_p/ω)⁴) γ^exp(−(ω/ω_p−1)²/2σ²), γ = 3.3, σ = 0.07, 0.09 (Hasselmann et al. 1973)"""
    U, F, g = 20.0, 100e3, 9.80665
    (made,), _ = asked("sea", "--wind-speed", U, "--fetch", F)
    peak = 7 * math.pi * g / U * (g * F / U**2) ** -0.33
    alpha = 0.076 * (U**2 / (F * g)) ** 0.22
    w = np.linspace(0.2, 30, 200_000)
    sigma = np.where(w <= peak, 0.07, 0.09)
    S = alpha * g**2 * w**-5 * np.exp(-1.25 * (peak / w) ** 4) * 3.3 ** np.exp(-((w / peak - 1) ** 2) / (2 * sigma**2))
    values = {name: one["values"] for name, one in made["quantities"].items()}
    Tp = values["period.spectrum"][made["axes"]["kind"]["values"].index("Tp, peak")]
    assert Tp == pytest.approx(2 * math.pi / peak, rel=5e-3)
    assert 4 * math.sqrt(values["m0"]) == pytest.approx(4 * math.sqrt(np.trapezoid(S, w)), rel=5e-3)
