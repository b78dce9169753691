"""`hakobune waves` of a body that hardly disturbs them: the waves that come, A exp(i k·x); and of symmetry."""

import math

import numpy as np
import pytest

from hakobune.pipelines.cli import main

OMEGA, DEPTH, G = 0.8, 10.0, 9.80665
K = OMEGA**2 / G
for _ in range(300):
    K = OMEGA**2 / (G * math.tanh(K * DEPTH))


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A buoy of 0.5 m radius and draft, which scatters some (kr)² = 0.2 % of waves of 70 m"""
    place = tmp_path_factory.mktemp("waves") / "buoy.h5"
    words = f"buoy --radius 0.5 --draft 0.5 --gyration 0.2,0.2,0.3 --depth {DEPTH} --omega {OMEGA},1.0"
    only = [
        "--heading",
        "0:180:7",
        "--only",
        "added_mass,radiation_damping,excitation_force,kochin,rao",
        "--output",
        str(place),
    ]
    assert main([*words.split(), *only]) == 0
    return place


@pytest.mark.parametrize("heading", [0.0, 60.0])
def test_far_from_a_small_body_the_waves_are_those_that_come(small, tmp_path, asked, heading):
    """Height 1 and phase k (x cos β + y sin β), −180 to 180°, at points that are asked for; and in the map"""
    spots = [(30.0, 0.0), (-20.0, 25.0), (0.0, -40.0)]
    words = ["waves", small, "--omega", OMEGA, f"--heading={heading}", "--width", 100, "--output", tmp_path / "w.csv"]
    tables, _ = asked(*words, *(f"--at={x},{y}" for x, y in spots), status=None)
    beta = math.radians(heading)
    way = np.array([math.cos(beta), math.sin(beta)])
    assert f"{2 * math.pi / OMEGA:.4g} s ({OMEGA} rad/s), {2 * math.pi / K:.4g} m long, towards {heading:g}°" in (
        tables[0]["title"])  # fmt: skip
    for row, spot in zip(tables[1]["rows"], spots, strict=True):
        assert (float(row["x m"]), float(row["y m"])) == spot
        assert float(row["height over that of the waves that come"]) == pytest.approx(1.0, abs=0.02)
        apart = float(row["phase °"]) - math.degrees(K * (way @ spot))
        assert abs((apart + 180) % 360 - 180) < 1.0
    x, y, real, imag = np.loadtxt(tmp_path / "w.csv", delimiter=",", skiprows=1).T
    assert (x.min(), x.max(), y.min(), y.max()) == pytest.approx((-50, 50, -50, 50))
    far = np.hypot(x, y) > 10
    wave = np.exp(1j * K * (way[0] * x + way[1] * y))
    assert np.abs(real + 1j * imag - wave)[far].max() < 0.03
    assert len(x) == pytest.approx(161**2, abs=12)  # but what lies in the body
    rows = {row.pop(""): row for row in tables[0]["rows"]}
    for name, sign in (("before it", -1), ("behind it", 1)):
        reach = sign * (0.5 + 0.5) * way  # half a breadth of it away
        assert (float(rows[name]["x m"]), float(rows[name]["y m"])) == pytest.approx(reach, abs=0.06)
    height = np.abs(real + 1j * imag)
    for name, value in (("highest", height.max()), ("lowest", height.min())):
        told = float(rows[name]["height over that of the waves that come"])
        assert told == pytest.approx(value, abs=6e-4)
        there = np.hypot(x - float(rows[name]["x m"]), y - float(rows[name]["y m"])) < 0.3  # where neighbours are alike
        assert np.abs(height[there] - value).min() < 6e-4


def test_the_same_waves_by_period_and_by_frequency_and_a_body_held_or_floating(small, asked):
    by_omega, _ = asked("waves", small, "--omega", OMEGA, status=None)
    by_period, _ = asked("waves", small, "--period", repr(2 * math.pi / OMEGA), status=None)
    assert by_omega == by_period and by_omega[0]["title"].endswith("body floating")
    held, _ = asked("waves", small, "--omega", OMEGA, "--fixed", status=None)
    assert held[0]["title"].endswith("body held") and "towards 180°" in held[0]["title"]


@pytest.mark.parametrize("width, good", [(1.01, True), (0.99, False), (1000.0, True), (1010.0, False)])
def test_a_map_is_wider_than_the_body_and_up_to_a_thousand_times(small, capsys, width, good):
    """Of 1.004 m, as panels make it"""
    status = main(["waves", str(small), "--omega", "0.8", "--width", f"{width}"])
    said = capsys.readouterr().err
    assert ("m to a thousand times that" in said) is not good and (status == 2) is not good


def test_the_map_is_drawn_with_the_way_of_the_waves(small, tmp_path, asked, pictures):
    asked("waves", small, "--omega", OMEGA, "--heading", 0, "--width", 100, "--output", tmp_path / "w.png", status=None)
    left, right = pictures[0].axes[:2]
    assert left.get_title(loc="left") == "height" and "crest" in right.get_title(loc="left")
    arrow = right.texts[0]
    assert arrow.xy[0] - arrow.get_position()[0] == pytest.approx(0.22 * 50, abs=0.1)  # it points to +x
    assert arrow.xy[1] == pytest.approx(0.0, abs=1e-6) and arrow.xy[0] == pytest.approx(-0.72 * 50, abs=0.1)


def test_half_a_map_is_one_and_a_half_lengths_of_the_body_or_of_the_waves(small, tmp_path, asked):
    asked("waves", small, "--omega", OMEGA, "--output", tmp_path / "w.csv", status=None)
    x = np.loadtxt(tmp_path / "w.csv", delimiter=",", skiprows=1)[:, 0]
    assert x.max() == pytest.approx(1.5 * 2 * math.pi / K, rel=1e-5)
