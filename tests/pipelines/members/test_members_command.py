"""`hakobune members`: piles whose forces are known in closed form, growth, wind, and faults."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import hakobune
from hakobune import pipelines
from hakobune.bem.waves import wavenumber
from hakobune.pipelines.cli import main

SCENE = Path(pipelines.__file__).parent / "scenes" / "members_dolphin.toml"
CURRENT = """
[water]
depth = 12.0
[current]
speed = 1.0
direction_deg = 0
"""


def pile(name="pile", width=1.2):
    end = {"start": [0.0, 0.0, -12.0], "end": [0.0, 0.0, 3.0]}
    return {"name": name, "shape": "circular", "width": width, "drag": 1.0, **end}


def test_two_piles_and_a_wind_across_the_current_are_summed():
    """½ρ D h U² of each; the forces over the phase are those of the table"""
    mast = {"name": "mast", "drag": 1.0, "area": 5.0, "position": [0.0, 0.0, 10.0]}
    study = tomllib.loads(CURRENT) | {"members": [pile("a"), pile("b")], "wind_members": [mast]}
    found = hakobune.members(study | {"wind": {"speed": 20.0, "direction_deg": 90.0}})
    drag, blown = 0.5 * 1025 * 1.2 * 12, found["force[mast, wind].Fy"]
    assert list(found.labels["member"].values) == ["a", "b", "all in the water", "mast, wind", "all"]
    assert found["force.Fx"] == pytest.approx([drag, drag, 2 * drag, 0, 2 * drag], abs=1e-6)
    assert found["force[all].Fy"] == pytest.approx(blown) and blown > 1e3 and "force.phase" not in found
    assert np.array_equal(found["course.force"][0, :, 0], found["force.Fx"])


def test_the_dolphin_of_the_scenes(tmp_path, capsys):
    files = ["--plot", str(tmp_path / "forces.png"), "--output", str(tmp_path / "forces.csv")]
    assert main(["members", str(SCENE), *files, "--csv"]) == 0 and (tmp_path / "forces.csv").stat().st_size > 1000
    assert capsys.readouterr().out.startswith("member,force.size [N],force.phase [rad],force.Fx [N]")
    found, change = hakobune.members(SCENE), SCENE.read_text().replace("growth = 0.05", "growth = 0.0")
    assert (tmp_path / "forces.png").stat().st_size > 10_000
    port, starboard, water, whole = (
        found[f"force[{name}].size"] for name in ("fore port", "fore starboard", "all in the water", "all")
    )
    assert port == pytest.approx(starboard, rel=1e-12)  # one is the other's mirror image
    assert whole > water > 3 * port
    bare = hakobune.members(tomllib.loads(change))["force[all in the water].size"]
    assert 1.3 / 1.2 < water / bare < (1.3 / 1.2) ** 2  # drag grows with the width, inertia with its square


def test_a_member_that_is_never_wet_is_named_and_a_current_alone_has_one_phase(tmp_path, capsys):
    text = SCENE.read_text().replace("[3.0, 3.0, -12.0]", "[3.0, 3.0, 12.0]")
    (tmp_path / "dry.toml").write_text(text.replace("[wave]\nheight = 3.0\nperiod = 8.0\ndirection_deg = 0.0", ""))
    assert main(["members", str(tmp_path / "dry.toml")]) == 0
    said = capsys.readouterr().out
    assert "warning: fore port: no force, since a member there is never in the water" in said and "Wheeler" not in said
    unit = 0.5 * 1025 * 1.0 * 1.3 * 12 / (1 + 2 * 0.143)  # ∫(1 + z/h)^2α dz = h/(1 + 2α), of an upright pile
    size = hakobune.members(tmp_path / "dry.toml")["force[aft port].size"]
    assert size == pytest.approx(unit, rel=0.02)  # which leans by 5°


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("height = 3.0", "height = 12.0"), "wave.height is 12 m; a wave of 8 s breaks at"),
        (('shape = "circular"', 'shape = "round"'), "member 'fore port': shape is 'round'; allowed: circular"),
        (("growth = 0.05", "growth = -0.1"), "member 'fore port': growth is -0.1 m; allowed: 0 to 1"),
        (("-12.0]", "-13.0]"), "member 'fore port' reaches down to z = -13 m; allowed: at least -12 m, the sea bed"),
        (("width = 1.2", "width = nan"), "member 'fore port': width of a member is nan"),
        (("[wind]\\nspeed = 30.0\\ndirection_deg = 0.0", ""), "wind is missing"),
        (
            ("position = [0.0, 0.0, 3.5]", "position = [nan, 0.0, 3.5]"),
            "wind member 'platform': position is [nan, 0.0, 3.5]; allowed: finite",
        ),
        (('shape = "cylinder"', 'shape = "cylinder"\\ndrag = 1.0'), "wind member 'mast': give one of shape, drag"),
    ],
)
def test_what_cannot_be_is_one_line(change, message, tmp_path, capsys):
    path = tmp_path / "study.toml"
    path.write_text(SCENE.read_text().replace(*(text.replace("\\n", "\n") for text in change)))
    assert main(["members", str(path)]) == 2
    said = capsys.readouterr().err
    assert message in said and said.count("\n") == 1


BY_HAND = """
[water]
depth = 16.0
[current]
speed = 1.5
direction_deg = 90
[wind]
speed = 30.0
exponent = 0.125
direction_deg = 180
[[members]]
name = "pile"
shape = "circular"
width = 0.9
start = [2.0, 1.0, -16.0]
end = [2.0, 1.0, 4.0]
drag = 1.1
growth = 0.05
[[wind_members]]
name = "box"
drag = 1.3
area = 12.0
position = [2.0, 1.0, 20.0]
"""


def test_forces_and_moments_of_a_pile_and_a_box_are_those_of_a_hand_calculation():
    """½ρ C_D (D + 2t) h U² half-way down the pile, about its foot; ½ρ C A U₁₀² (z/10)^2α of the wind with
    ρ = 0.125 kgf s²/m⁴; of all about the bed under the origin, Σ r × F with r from there"""
    found = hakobune.members(tomllib.loads(BY_HAND))
    water = np.array([0.0, 0.5 * 1025 * 1.1 * 1.0 * 16 * 1.5**2, 0.0])
    wind = np.array([-0.5 * 0.125 * 9.80665 * 1.3 * 12 * 30.0**2 * 2**0.25, 0.0, 0.0])
    bed = np.array([0.0, 0.0, -16.0])
    moments = np.cross(np.array([2.0, 1.0, -8.0]) - bed, water), np.cross(np.array([2.0, 1.0, 20.0]) - bed, wind)
    for name, force, moment, off in (  # ρ of the air to four digits
        ("pile", water, np.cross([0.0, 0.0, 8.0], water), 1e-9),
        ("all in the water", water, moments[0], 1e-9),
        ("box, wind", wind, moments[1], 2e-4),
        ("all", water + wind, moments[0] + moments[1], 2e-4),
    ):
        parts = [found[f"force[{name}].{key}"] for key in ("Fx", "Fy", "Fz")]
        assert parts == pytest.approx(force, rel=off, abs=1e-6)
        assert found[f"force[{name}].size"] == pytest.approx(np.linalg.norm(force), rel=off)
        assert found[f"moment[{name}].size"] == pytest.approx(np.linalg.norm(moment), rel=off)


@pytest.mark.parametrize("share, told", [(0.19, False), (0.21, True)])
def test_a_member_wider_than_a_fifth_of_the_wave_is_told_to_scatter_it(share, told):
    """Morison's formula is for D/λ below 0.2 (DNV-RP-C205, 6.1)"""
    width = share * 2 * np.pi / float(wavenumber(0.8, 12.0))
    wave = {"height": 2.0, "period": 2 * np.pi / 0.8, "direction_deg": 0.0}
    found = hakobune.members({"water": {"depth": 12.0}, "wave": wave, "members": [pile(width=width)]})
    assert any("scatters" in line for line in found.fails) is told
