"""What `hakobune moor` prints of a box between two chains in a head wind, by the closed form of such a chain."""

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.bem.database import open_database
from hakobune.pipelines.cli import main
from hakobune.pipelines.results.file import read

DEPTH, LENGTH, WEIGHT, PRETENSION, BREAKING = 20.0, 300.0, 3000.0, 400e3, 2000e3  # m, N/m, N
FRICTION = 0.2
STUDY = f"""
allowable = 0.5
[water]
depth = {DEPTH}
[hull]
freeboard = 8.0
[wind]
speed = 40.0
direction_deg = 180.0
[types.chain]
weight_N_per_m = {WEIGHT}
axial_stiffness_kN = 1e9
breaking_load_kN = {BREAKING / 1e3}
bed_friction = {FRICTION}
[[lines]]
name = "bow"
type = "chain"
length = {LENGTH}
fairlead = [50.0, 0.0, 0.0]
heading_deg = 0
pretension_kN = {PRETENSION / 1e3}
[[lines]]
name = "stern"
type = "chain"
length = {LENGTH}
fairlead = [-50.0, 0.0, 0.0]
heading_deg = 180
pretension_kN = {PRETENSION / 1e3}
[[anchors]]
kind = "sinker"
friction = 0.5
weight_kN = 2000.0
lines = ["bow"]
[[anchors]]
kind = "drag"
type = "Stevpris Mk6"
soil = "sand"
safety = 1.5
"""


def span(H, h):
    """Horizontal distance of the ends of a chain of LENGTH that lies partly on the bed, h m under its upper end"""
    hung = np.sqrt(h * (h + 2 * H / WEIGHT))
    return LENGTH - hung + H / WEIGHT * np.arcsinh(WEIGHT * hung / H)


def pull(X, h):
    """Horizontal tension at a distance"""
    return brentq(lambda H: span(H, h) - X, 1e3, 5e7)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Result of the command's file, its print, and the database"""
    import contextlib
    import io

    folder = tmp_path_factory.mktemp("moor")
    box = f"box --length 100 --beam 50 --draft 10 --depth {DEPTH:g} --panels 60 --gyration 15,29,32 --heading 0,180"
    database = folder / "box.h5"
    assert main([*box.split(), "--omega", "0.06,0.3,0.6,0.9", "--output", str(database)]) == 0
    (folder / "study.toml").write_text(STUDY)
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        words = ["--database", str(database), "--output", str(folder / "moor.h5")]
        assert main(["moor", str(folder / "study.toml"), *words]) == 0
    return read(folder / "moor.h5", "moor"), out.getvalue(), open_database(database)


def test_tensions_are_those_of_chains_at_the_place_of_the_body_and_balance_the_wind(found):
    """T = H + w h at the upper end; at rest H is the pretension; the difference of both H is the wind"""
    result, said, _ = found
    x, y, yaw, roll, pitch = (result[f"pose.{name}"] for name in ("x", "y", "yaw", "roll", "pitch"))
    assert (y, yaw, roll) == pytest.approx((0, 0, 0), abs=1e-9) and x < -0.05
    X0, H = span(PRETENSION, DEPTH), {}
    for name, side in (("bow", 1), ("stern", -1)):
        h = DEPTH - side * 50.0 * np.sin(pitch)  # a positive pitch takes the bow down
        H[name] = pull(X0 - side * x, h)
        assert result[f"tension[{name}].at_rest"] == pytest.approx(PRETENSION + WEIGHT * DEPTH, rel=1e-6)
        assert result[f"tension[{name}].steady"] == pytest.approx(H[name] + WEIGHT * h, rel=5e-4)
        assert result[f"tension[{name}].largest"] == result[f"tension[{name}].steady"]  # no waves
        assert result[f"tension[{name}].used"] == pytest.approx(result[f"tension[{name}].largest"] / BREAKING)
    assert result["load[sum].Fx"] == result["load[wind].Fx"] < 0
    assert H["bow"] - H["stern"] == pytest.approx(-result["load[wind].Fx"], rel=1e-3)
    assert f"largest tension: {result['tension[bow].largest'] / 1e3:.4g} kN in bow" in said
    assert f"{100 * result['tension[bow].used']:.0f} % of its breaking load (allowable 50 %)" in said


def test_the_wind_is_that_of_the_front_of_the_box(found):
    """½ρ C U² B f with C of a box ahead, 1.0 to 1.2 in every table of them; its moment about the water at half of f"""
    result = found[0]
    q = 0.5 * 1.225 * 40.0**2 * 50.0 * 8.0
    assert 0.9 < -result["load[wind].Fx"] / q < 1.35
    assert [result[f"load[wind].{name}"] for name in ("Fy", "Mx", "Mz")] == pytest.approx([0, 0, 0], abs=1e-6)


def test_the_period_of_surge_is_that_of_the_mass_on_both_chains(found):
    """2π √((M + A₁₁)/2H′), H′ of a chain by a difference quotient, A₁₁ of the longest stored wave"""
    result, _, db = found
    X0, step = span(PRETENSION, DEPTH), 1e-3
    stiffness = (pull(X0 + step, DEPTH) - pull(X0 - step, DEPTH)) / step  # of both
    mass = 1025.0 * 100 * 50 * 10 + float(db["added_mass"][0][0, 0])
    assert result["period[surge].at_rest"] == pytest.approx(2 * np.pi * np.sqrt(mass / stiffness), rel=0.02)


def test_the_bed_and_the_anchors_have_what_the_chains_leave_them(found):
    """A chain that lies on the bed pulls its anchor with H less friction and does not lift it; what lies is
    L − √(h(h + 2H/w))"""
    result = found[0]
    for name, side in (("bow", 1), ("stern", -1)):
        h = DEPTH - side * 50.0 * np.sin(result["pose.pitch"])
        H = pull(span(PRETENSION, DEPTH) - side * result["pose.x"], h)
        lying = LENGTH - np.sqrt(h * (h + 2 * H / WEIGHT))
        by_hand = {
            f"tension[{name}].horizontal_at_rest": PRETENSION,
            f"anchor[{name}].largest_horizontal": H - FRICTION * WEIGHT * lying,
            f"anchor[{name}].largest_vertical": 0.0,
            f"line[{name}].breaking_load": BREAKING,
            f"line[{name}].length": LENGTH,
            f"grounded[{name}].at_rest": LENGTH - np.sqrt(DEPTH * (DEPTH + 2 * PRETENSION / WEIGHT)),
            f"grounded[{name}].at_largest": lying,
            f"fairlead[{name}].outward": 0.0,
            f"fairlead[{name}].upward": 0.0,
        }
        for key, value in by_hand.items():
            assert result[key] == pytest.approx(value, rel=3e-3, abs=1e-6), key
        assert result[f"fairlead[{name}].place"] == pytest.approx([side * 50.0, 0.0, 0.0], abs=1e-6)
        place = [side * (50.0 + span(PRETENSION, DEPTH)), 0.0, -DEPTH]
        assert result[f"anchor[{name}].place"] == pytest.approx(place, rel=1e-6, abs=1e-6)
    pulled = [result[f"anchor[{name}].largest_horizontal"] for name in ("bow", "stern")]
    assert result["anchor[bow].used"] == pytest.approx(pulled[0] / 0.5 / 2e6)
    assert result["anchor[bow].needed_weight"] == pytest.approx(pulled[0] / 0.5)
    assert result["anchor[stern].needed_mass"] == pytest.approx(1e3 * (1.5 * pulled[1] / 904.21e3) ** (1 / 0.92))
    assert "anchors at the largest pull" in found[1]
