"""`hakobune waves` of a body that hardly disturbs them: the waves that come, A exp(i k·x); and of symmetry."""

import math

import numpy as np
import pytest

import hakobune
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
    asked(*words, *(f"--at={x},{y}" for x, y in spots), status=None)
    beta = math.radians(heading)
    found, way = (
        hakobune.waves(small, omega=OMEGA, heading=beta, width=100.0, at=spots),
        [math.cos(beta), math.sin(beta)],
    )
    way = np.array(way)
    wave = [found[f"wave.{name}"] for name in ("period", "omega", "length", "heading")]
    assert wave == pytest.approx([2 * math.pi / OMEGA, OMEGA, 2 * math.pi / K, beta], rel=1e-9)
    place = {name: np.array(found[f"place.{name}"]) for name in ("x", "y", "height", "phase")}
    assert np.stack([place["x"], place["y"]], 1)[-3:] == pytest.approx(np.array(spots))
    assert place["height"][-3:] == pytest.approx([1.0] * 3, abs=0.02)
    apart = np.degrees(place["phase"][-3:] - K * (np.array(spots) @ way))
    assert np.abs((apart + 180) % 360 - 180).max() < 1.0
    x, y, real, imag = np.loadtxt(tmp_path / "w.csv", delimiter=",", skiprows=1).T
    assert (x.min(), x.max(), y.min(), y.max()) == pytest.approx((-50, 50, -50, 50))
    far = np.hypot(x, y) > 10
    wave = np.exp(1j * K * (way[0] * x + way[1] * y))
    assert np.abs(real + 1j * imag - wave)[far].max() < 0.03
    assert len(x) == pytest.approx(161**2, abs=12)  # but what lies in the body
    names = found.labels["place"].values.tolist()
    for name, sign in (("before it", -1), ("behind it", 1)):
        reach = sign * (0.5 + 0.5) * way  # half a breadth of it away
        at = names.index(name)
        assert (place["x"][at], place["y"][at]) == pytest.approx(reach, abs=0.06)
    height = np.abs(real + 1j * imag)
    for name, value in (("highest", height.max()), ("lowest", height.min())):
        at = names.index(name)
        assert place["height"][at] == pytest.approx(value, abs=6e-4)
        there = np.hypot(x - place["x"][at], y - place["y"][at]) < 0.3  # where neighbours are alike
        assert np.abs(height[there] - value).min() < 6e-4


def test_the_same_waves_by_period_and_by_frequency_and_a_body_held_or_floating(small):
    by_omega, by_period = hakobune.waves(small, omega=OMEGA), hakobune.waves(small, period=2 * math.pi / OMEGA)
    assert by_omega["place.height"] == pytest.approx(by_period["place.height"], rel=1e-12)
    held = hakobune.waves(small, omega=OMEGA, fixed=True)
    assert (by_omega["body"], held["body"]) == ("floating", "held")
    assert held["wave.heading"] == pytest.approx(math.pi)


@pytest.mark.parametrize("width, good", [(1.01, True), (0.99, False), (1000.0, True), (1010.0, False)])
def test_a_map_is_wider_than_the_body_and_up_to_a_thousand_times(small, capsys, width, good):
    """Of 1.004 m, as panels make it"""
    status = main(["waves", str(small), "--omega", "0.8", "--width", f"{width}"])
    said = capsys.readouterr().err
    assert ("m to a thousand times this width" in said) is not good and (status == 2) is not good


def test_the_map_is_drawn_with_the_way_of_the_waves(small, tmp_path, asked, pictures):
    asked("waves", small, "--omega", OMEGA, "--heading", 0, "--width", 100, "--plot", tmp_path / "w.png", status=None)
    left, right = pictures[0].axes[:2]
    assert left.get_title(loc="left") == "height" and "crest" in right.get_title(loc="left")
    arrow = right.texts[0]
    assert arrow.xy[0] - arrow.get_position()[0] == pytest.approx(0.22 * 50, abs=0.1)  # it points to +x
    assert arrow.xy[1] == pytest.approx(0.0, abs=1e-6) and arrow.xy[0] == pytest.approx(-0.72 * 50, abs=0.1)


def test_half_a_map_is_one_and_a_half_lengths_of_the_body_or_of_the_waves(small, tmp_path, asked):
    asked("waves", small, "--omega", OMEGA, "--output", tmp_path / "w.csv", status=None)
    x = np.loadtxt(tmp_path / "w.csv", delimiter=",", skiprows=1)[:, 0]
    assert x.max() == pytest.approx(1.5 * 2 * math.pi / K, rel=1e-5)
