"""`hakobune site` by hand: return period, Gumbel's law of the wind, levels, streams, contour's page, and its limits."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.site import report
from hakobune.pipelines.site.study import read_site, site_values

G = 9.80665
SITE = """
[site]
name = "bay"
depth = 16.0
service_life = 25.0
probability = 0.7
[wind]
speed = 30.0
height = 10.0
heights = [10.0, 40.0, 150.0]
[current]
speed = 0.8
wind_driven = true
exponent = 0.2
draft = 6.0
depths = [0.0, 8.0]
[waves]
height = 2.5
period = 6.5
[levels]
spring_high = 1.2
spring_low = -0.8
surge = 0.9
tsunami = 1.5
tsunami_period = 1200.0
[earthquake]
rule = "C"
factors = { regional = 0.15, ground = 1.2, importance = 1.5 }
[operating]
wind = 12.0
current = 0.4
wave_height = 0.7
wave_period = 4.5
"""
R = 1 / (1 - 0.7 ** (1 / 25))


def written(folder, *changes):
    text = SITE
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "site.toml"
    path.write_text(text)
    return path


def made(folder, *changes):
    study, _ = read_site(written(folder, *changes))
    return study, site_values(study, folder)


def test_profiles_of_the_page_are_those_of_the_wind_and_the_current(tmp_path):
    """Without an exponent the table of the report: 1.095 from 30.5 m on, 1.265 from 137; with 1/7 the power law"""
    study, values = made(tmp_path)
    assert report._profile(study, values) == [
        ("10", "30.00"),
        ("40", f"{30 * 1.095:.2f}"),
        ("150", f"{30 * 1.265:.2f}"),
    ]
    assert report._current(study, values) == [("0", "1.10"), ("8", f"{0.8 * 0.5**0.2 + 0.15:.3g}")]
    study, values = made(tmp_path, ("height = 10.0\n", "height = 10.0\nexponent = 0.14\n"))
    assert report._profile(study, values)[1] == ("40", f"{30 * 4**0.14:.2f}")


def test_wind_measured_higher_is_brought_down_by_the_exponent_and_to_ten_minutes(tmp_path):
    """U₁₀ = U(h)(10/h)^α; by the Frøya formula over T U [1 − 0.41 I ln(T/3600)], I = 0.06 (1 + 0.043 U)(z/10)^−0.22"""
    _, values = made(tmp_path, ("height = 10.0\n", "height = 20.0\nexponent = 0.12\n"))
    assert values.wind_10 == pytest.approx(30 * 0.5**0.12)
    _, values = made(tmp_path, ("height = 10.0\n", "height = 10.0\naveraging_s = 3600.0\n"))
    gust = 1 - 0.41 * 0.06 * (1 + 0.043 * 30) * math.log(600 / 3600)
    assert values.wind_10 == pytest.approx(30 * gust, rel=1e-6)


MAXIMA = [21.5, 24.8, 19.9, 27.3, 22.6, 25.1, 20.4, 23.7, 29.2, 22.0, 24.1, 26.0]


def gumbel(x):
    """b, s by maximum likelihood: x̄ − Σ x e^(−x/s)/Σ e^(−x/s) = s, b = −s ln(mean e^(−x/s))"""
    x = np.array(x)
    s = brentq(lambda s: x.mean() - np.sum(x * np.exp(-x / s)) / np.sum(np.exp(-x / s)) - s, 0.1, 50)
    return -s * math.log(np.mean(np.exp(-x / s))), s


def test_the_wind_of_yearly_maxima_is_that_of_gumbels_law(tmp_path, pictures):
    """b − s ln(−ln(1 − 1/R)); drawn on the paper of that law, at plotting positions (i − 0.44)/(n + 0.12)"""
    _, values = made(tmp_path, ("speed = 30.0\n", f"maxima = {MAXIMA}\n"))
    b, s = gumbel(MAXIMA)
    value = b - s * math.log(-math.log(1 - 1 / R))
    assert values.wind.value == pytest.approx(value, rel=1e-4) and values.wind.low < value < values.wind.high
    found = hakobune.site(tmp_path / "site.toml")
    of_wind = [float(found[f"wind.{part}"]) for part in ("low", "value", "high")]
    assert of_wind == pytest.approx([values.wind.low, value, values.wind.high], rel=1e-4)
    assert [float(found[f"height.{part}"]) for part in ("low", "value", "high")] == pytest.approx([2.5] * 3)
    report.draw_paper(tmp_path / "p.png", "wind, m/s", values.wind, R)
    (axes,) = pictures[0].axes
    points, law = axes.lines[:2]
    p = (np.arange(1, 13) - 0.44) / 12.12
    assert points.get_xydata() == pytest.approx(np.stack([-np.log(-np.log(p)), np.sort(MAXIMA)], 1))
    x, y = law.get_data()
    assert y == pytest.approx(b + s * x, rel=1e-4)
    assert axes.get_xlabel() == "return period, years" and axes.get_ylabel() == "wind, m/s"
    ticks = {label.get_text(): at for label, at in zip(axes.get_xticklabels(), axes.get_xticks(), strict=True)}
    assert ticks["50"] == pytest.approx(-math.log(-math.log(0.98)))
    fit = report._fit("wind", values.wind, R)
    assert fit["numbers"].startswith(f"location {b:.4g}, scale {s:.4g}") and fit["count"] == 12


@pytest.mark.parametrize("count, told", [(10, False), (9, True)])
def test_fewer_than_ten_maxima_are_told_with_their_interval(tmp_path, count, told):
    change = ("speed = 30.0\n", f"maxima = {MAXIMA[:count]}\n"), ("probability = 0.7", "return_period = 30.0")
    _, values = made(tmp_path, *change)
    said = [line for line in values.findings if "fewer than 10" in line]
    assert bool(said) is told
    assert not told or said[0].startswith("wind: 9 yearly maxima, fewer than 10: the value of 30 years is ")
    assert not told or "its 90 % interval" in said[0]


@pytest.mark.parametrize("years, told", [(48.0, False), (48.1, True)])
def test_more_than_four_times_the_years_measured_is_an_extrapolation(tmp_path, years, told):
    change = ("speed = 30.0\n", f"maxima = {MAXIMA}\n"), ("probability = 0.7", f"return_period = {years}")
    _, values = made(tmp_path, *change)
    assert any("more than four times the 12 measured" in line for line in values.findings) is told


LIMITS = [
    ("spring_low = -0.8", "spring_low = 0.0", "spring_low = 0.8",
     "levels.spring_low is 0.8; allowed: at most 0, since levels are heights above mean water"),
    ("spring_high = 1.2", "spring_high = 0.0", "spring_high = -0.1",
     "levels.spring_high is -0.1; allowed: at least 0, since levels are heights above mean water"),
    ("surge = 0.9", "surge = 0.0", "surge = -0.1", "levels.surge is -0.1; allowed: 0 to the depth, 16 m"),
    ("surge = 0.9", "surge = 15.9", "surge = 16.0", "levels.surge is 16; allowed: 0 to the depth, 16 m"),
    ("tsunami = 1.5", "tsunami = 15.1", "tsunami = 15.3", "levels: the lowest is -16.1 m in 16 m of water"),
    # 20 depths over √(gh): 20 √(h/g) = 25.55 s
    ("tsunami_period = 1200.0", "tsunami_period = 25.6", "tsunami_period = 25.5",
     "tsunami_period is 25.5 s; allowed: above 25.5"),
    ("tsunami = 1.5\n", "tsunami = 1.5\n", "", "levels.tsunami_period is given without levels.tsunami"),
    ("draft = 6.0", "draft = 16.0", "draft = 16.1", "16.1"),
    ("wave_period = 4.5\n", "wave_period = 4.5\n", "", "operating has only one of wave_height and wave_period; give "
        "both"),
    ("period = 6.5\n[levels]", "period = 6.5\n[levels]", "[levels]", "waves.period is missing; give"),
    ("probability = 0.7", "return_period = 50.0", "probability = 0.7\nreturn_period = 50.0",
     "give one of probability and"),
    ("speed = 30.0\n", f"maxima = {MAXIMA}\n", f"speed = 30.0\nmaxima = {MAXIMA}\n",
     "speed and maxima are given; allowed: one"),
    ("speed = 30.0\n", f"maxima = {MAXIMA}\n", "maxima = [20.0, 0.0, 21.0, 22.0, 23.0]\n",
     "a yearly maximum is 0; allowed"),
    ("importance = 1.5", "importance = 1.0", "importance = 0.0", "earthquake: importance of rule C is 0"),
]  # fmt: skip


@pytest.mark.parametrize("old, good, bad, says", LIMITS, ids=lambda text: text[-20:])
def test_a_site_is_taken_up_to_its_limits(tmp_path, capsys, old, good, bad, says):
    made(tmp_path, (old, good))
    assert main(["site", str(written(tmp_path, (old, bad))), "--output", str(tmp_path / "v.toml")]) == 2
    said = capsys.readouterr().err
    assert says in said and said.count("\n") == 1


@pytest.mark.parametrize("height, told", [(10.86, None), (10.87, "10.87 m in 18.1 m of water"),
                                          (30.0, "30 m in 18.1 m of water")])  # fmt: skip
def test_waves_of_a_site_higher_than_its_water_carries_are_told(tmp_path, height, told):
    """0.6 (16 + 1.2 + 0.9) = 10.86 m, the highest sea at high water of spring tides with the surge"""
    _, values = made(tmp_path, ("height = 2.5\n", f"height = {height}\n"))
    said = [line for line in values.findings if "breaking limits seas" in line]
    assert len(said) == (told is not None)
    assert not told or (told in said[0] and said[0].startswith("extreme: ") and "at most 10.9 m" in said[0])


def test_a_wind_that_drives_the_current_has_to_be_there(tmp_path, capsys):
    text = SITE[: SITE.index("[wind]")] + SITE[SITE.index("[current]") :]
    (tmp_path / "site.toml").write_text(text)
    assert main(["site", str(tmp_path / "site.toml"), "--output", str(tmp_path / "v.toml")]) == 2
    assert "current.wind_driven is true and there is no [wind]" in capsys.readouterr().err


def test_every_value_of_a_site_by_hand(tmp_path):
    """R = 1/(1 − q^(1/T)) = 70.6 years; high water of spring tide and surge; a√(g/h) of the tsunami; a hundredth of the
    wind drives the surface, and falls to nothing at the bed: over the draft the current of the same pressure,
    √((1/d) ∫ U² dz) of 0.8 (1 + z/h)^0.2 + 0.3 (1 + z/h)"""
    found = hakobune.site(written(tmp_path))
    z = np.linspace(-6.0, 0.0, 6001)
    U = 0.8 * (1 + z / 16) ** 0.2 + 0.3 * (1 + z / 16)
    by_hand = {
        "return_period": R, "probability": 0.7, "seismic": 0.27, "extreme.wind.speed": 30.0,
        "extreme.current.speed": math.sqrt(np.trapezoid(U**2, z) / 6.0), "extreme.waves.height": 2.5,
        "extreme.waves.period": 6.5, "operating.wind.speed": 12.0, "operating.current.speed": 0.4,
        "operating.waves.height": 0.7, "operating.waves.period": 4.5,
        "tsunami.current.speed": 1.5 * math.sqrt(G / 16),
    }  # fmt: skip
    for name, value in by_hand.items():
        assert found[name] == pytest.approx(value, rel=2e-4), name
    levels = dict(zip(found.labels["level"].values.tolist(), found["level.height"], strict=True))
    assert [levels[name] for name in ("high", "low", "tsunami high", "tsunami low")] == pytest.approx(
        [2.1, -0.8, 2.7, -2.3]
    )


@pytest.mark.parametrize("last, told", [(60.0, True), (26.0, False)])
def test_a_value_below_what_was_measured_in_fewer_years_is_told(tmp_path, last, told):
    """Eleven years about 25 m/s and one of 60: Gumbel's value of twelve years is b + 2.44 s, below it"""
    maxima = [24.0 + 0.2 * i for i in range(11)] + [last]
    change = ("speed = 30.0\n", f"maxima = {maxima}\n"), ("probability = 0.7", "return_period = 12.0")
    _, values = made(tmp_path, *change)
    said = [line for line in values.findings if "largest of the 12 measured years;" in line]
    assert bool(said) is told and (values.wind.value < last) is told
    assert not told or f"gumbel, {values.wind.value:.4g}, is below 60, the" in said[0]
