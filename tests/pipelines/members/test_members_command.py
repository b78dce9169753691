"""`hakobune members`: piles whose forces are known in closed form, growth, wind, and faults."""

import json
from pathlib import Path

import numpy as np
import pytest

from hakobune import pipelines
from hakobune.bem.waves import wavenumber
from hakobune.mooring.loads.morison import circular
from hakobune.mooring.loads.regular_wave import RegularWave
from hakobune.pipelines.cli import main
from hakobune.pipelines.members.command import course, remarks, totals, wet_part
from hakobune.pipelines.members.study import Placed

SCENE = Path(pipelines.__file__).parent / "scenes" / "members_dolphin.toml"
PHASES = np.linspace(0, 2 * np.pi, 180, endpoint=False)


def pile(C_D, C_M=2.0, width=1.2, top=3.0):
    return Placed("pile", circular(width, C_D, C_M), np.array([0.0, 0.0, -12.0]), np.array([0.0, 0.0, top]))


def test_inertia_of_a_pile_in_a_low_wave_is_the_closed_form():
    """F = ρ g a C_M π/4 D² tanh kh, ahead of the crest by a quarter; M about the foot from ∫ (z + h) cosh k(z + h)"""
    wave, h = RegularWave(1e-4, 0.8, 0.0, 12.0), 12.0
    force, k = course(pile(0.0), wave, PHASES, 1025.0).force, float(wavenumber(0.8, 12.0))
    unit = 1025 * 9.80665 * 1e-4 * 2 * np.pi / 4 * 1.2**2
    assert force[:, 0].max() == pytest.approx(unit * np.tanh(k * h), rel=1e-4)
    assert np.degrees(PHASES[force[:, 0].argmax()]) == 270
    arm = h * np.sinh(k * h) / k - (np.cosh(k * h) - 1) / k**2
    assert force[:, 4].max() == pytest.approx(unit * k * arm / np.cosh(k * h), rel=1e-4)


def test_drag_of_a_pile_in_a_current_is_the_hand_calculation():
    from hakobune.mooring.environment.current_profile import uniform

    wave = RegularWave(0.0, 1.0, 0.0, 12.0, uniform(1.5, np.pi / 2))
    force = course(pile(0.9), wave, PHASES[:2], 1025.0).force
    assert np.allclose(force[:, :3], [0, 0.5 * 1025 * 0.9 * 1.2 * 12 * 1.5**2, 0], atol=1e-6)


def test_the_lines_of_the_picture_are_those_of_the_table():
    """Two piles in a current, and a wind across it"""
    from hakobune.mooring.environment.current_profile import uniform

    current = RegularWave(0.0, 1.0, 0.0, 12.0, uniform(1.0, 0.0))
    two = [course(pile(1.0), current, PHASES[:1], 1025.0)] * 2
    wind = [("mast", np.array([0.0, 5e3, 0.0, 0.0, 0.0, 0.0]))]
    drag = 0.5 * 1025 * 1.2 * 12
    found = dict(totals(two, wind))
    assert np.allclose(found["all in the water"], [[2 * drag, 0, 0]]) and np.allclose(
        found["all"], [[2 * drag, 5e3, 0]]
    )
    assert [name for name, _ in totals(two, [])] == ["all in the water"] and not totals(two[:1], [])


def test_a_pile_is_wet_up_to_the_surface():
    wave = RegularWave(1.5, 0.8, 0.0, 12.0)
    for phase in (0.0, 1.0, np.pi):
        start, end = wet_part(*pile(1.0)[2:], wave, phase)
        assert start[2] == -12.0 and end[2] == pytest.approx(1.5 * np.cos(phase), abs=1e-9)
    assert wet_part(np.array([0, 0, 2.0]), np.array([0, 0, 5.0]), wave, 0.0) is None


def test_the_dolphin_of_the_scenes(tmp_path, capsys):
    assert main(["members", str(SCENE), "--plot", str(tmp_path / "forces.png"), "--csv"]) == 0
    said = capsys.readouterr().out
    rows = {line.split(",")[0]: line.split(",")[1:] for line in said.splitlines() if "," in line}
    assert (tmp_path / "forces.png").stat().st_size > 10_000
    assert rows["fore port"][0] == rows["fore starboard"][0]  # one is the other's mirror image
    assert float(rows["all"][0]) > float(rows["all in the water"][0]) > 3 * float(rows["fore port"][0])
    clean = tmp_path / "clean.toml"
    clean.write_text(SCENE.read_text().replace("growth = 0.05", "growth = 0.0"))
    assert main(["members", str(clean), "--csv"]) == 0
    bare = {line.split(",")[0]: line.split(",")[1:] for line in capsys.readouterr().out.splitlines() if "," in line}
    share = float(rows["all in the water"][0]) / float(bare["all in the water"][0])
    assert 1.3 / 1.2 < share < (1.3 / 1.2) ** 2  # drag grows with the width, inertia with its square


def test_a_member_that_is_never_wet_is_named_and_a_current_alone_has_one_phase(tmp_path, capsys):
    text = SCENE.read_text().replace("[3.0, 3.0, -12.0]", "[3.0, 3.0, 12.0]")
    (tmp_path / "dry.toml").write_text(text.replace("[wave]\nheight = 3.0\nperiod = 8.0\ndirection_deg = 0.0", ""))
    assert main(["members", str(tmp_path / "dry.toml"), "--csv"]) == 0
    said, remarks = capsys.readouterr()
    assert "warning: fore port: no force, or never in the water" in remarks and "Wheeler" not in remarks
    rows = {line.split(",")[0]: line.split(",")[1:] for line in said.splitlines() if line.count(",") > 5}
    unit = 0.5 * 1025 * 1.0 * 1.3 * 12 / (1 + 2 * 0.143) / 1e3  # ∫(1 + z/h)^2α dz = h/(1 + 2α), of an upright pile
    assert float(rows["aft port"][0]) == pytest.approx(unit, rel=0.02)  # which leans by 5°


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("height = 3.0", "height = 12.0"), "wave.height is 12 m; a wave of 8 s breaks at"),
        (('shape = "circular"', 'shape = "round"'), "member 'fore port': shape is 'round'; allowed: circular"),
        (("growth = 0.05", "growth = -0.1"), "member 'fore port': growth is -0.1 m; allowed: 0 to 1"),
        (("-12.0]", "-13.0]"), "member 'fore port' reaches down to z = -13 m; allowed: at least -12, the bed"),
        (("width = 1.2", "width = nan"), "member 'fore port': width of a member is nan"),
        (("[wind]\\nspeed = 30.0\\ndirection_deg = 0.0", ""), "wind is missing; needed by"),
        (
            ("position = [0.0, 0.0, 3.5]", "position = [nan, 0.0, 3.5]"),
            "wind member 'platform': position is [nan, 0.0, 3.5]; allowed: finite",
        ),
        (('shape = "cylinder"', 'shape = "cylinder"\\ndrag = 1.0'), "wind member 'mast': allowed: one of shape, drag"),
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


def test_forces_and_moments_of_a_pile_and_a_box_are_those_of_a_hand_calculation(tmp_path, capsys):
    """½ρ C_D (D + 2t) h U² half-way down the pile, about its foot; ½ρ C A U₁₀² (z/10)^2α of the wind with
    ρ = 0.125 kgf s²/m⁴; of all about the bed under the origin, Σ r × F with r from there"""
    path = tmp_path / "study.toml"
    path.write_text(BY_HAND)
    assert main(["members", str(path), "--json"]) == 0
    rows = {row.pop(""): row for row in json.loads(capsys.readouterr().out)["rows"]}
    water = np.array([0.0, 0.5 * 1025 * 1.1 * 1.0 * 16 * 1.5**2, 0.0]) / 1e3
    wind = np.array([-0.5 * 0.125 * 9.80665 * 1.3 * 12 * 30.0**2 * 2**0.25, 0.0, 0.0]) / 1e3
    bed = np.array([0.0, 0.0, -16.0])
    moments = np.cross(np.array([2.0, 1.0, -8.0]) - bed, water), np.cross(np.array([2.0, 1.0, 20.0]) - bed, wind)
    for name, force, moment in (
        ("pile", water, np.cross([0.0, 0.0, 8.0], water)),
        ("all in the water", water, moments[0]),
        ("box, wind", wind, moments[1]),
        ("all", water + wind, moments[0] + moments[1]),
    ):
        found = [float(rows[name][key]) for key in ("Fx kN", "Fy kN", "Fz kN")]
        assert found == pytest.approx(force, rel=1e-3, abs=1e-3)
        assert float(rows[name]["force kN"]) == pytest.approx(np.linalg.norm(force), rel=1e-3)
        assert float(rows[name]["moment kN m"]) == pytest.approx(np.linalg.norm(moment), rel=1e-3)


@pytest.mark.parametrize("share, told", [(0.19, False), (0.21, True)])
def test_a_member_wider_than_a_fifth_of_the_wave_is_told_to_scatter_it(share, told):
    """Morison's formula is for D/λ below 0.2 (DNV-RP-C205, 6.1)"""
    wave = RegularWave(1.0, 0.8, 0.0, 12.0)
    wide = pile(1.0, width=share * 2 * np.pi / float(wavenumber(0.8, 12.0)))
    said = [line for line in remarks([wide], [course(wide, wave, PHASES[:2], 1025.0)], wave) if "scatters" in line]
    assert bool(said) is told
