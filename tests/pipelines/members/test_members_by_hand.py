"""`hakobune members` in a low wave, by hand: forces, phases, moments, totals, and its picture; limits on both sides."""

import math

import numpy as np
import pytest

import hakobune
from hakobune.pipelines.cli import main

RHO, G, DEPTH, PERIOD, HEIGHT, D, C_M = 1025.0, 9.80665, 12.0, 8.0, 0.02, 1.2, 2.0
W = 2 * math.pi / PERIOD
K = W * W / G
for _ in range(300):
    K = W * W / (G * math.tanh(K * DEPTH))


def pile(name, x, y=0.0, top=3.0, **more):
    words = {"drag": 0.0, "width": D, "shape": '"circular"'} | more
    table = "".join(f"{key} = {value}\n" for key, value in words.items())
    return f'[[members]]\nname = "{name}"\nstart = [{x}, {y}, -{DEPTH}]\nend = [{x}, {y}, {top}]\n{table}'


def written(folder, *tables, height=HEIGHT, direction="direction_deg = 0"):
    path = folder / "study.toml"
    wave = f"[wave]\nheight = {height}\nperiod = {PERIOD}\n{direction}\n" if height else ""
    path.write_text(f"[water]\ndepth = {DEPTH}\n{wave}{''.join(tables)}")
    return path


def inertia(width=D, coefficient=C_M):
    """N, amplitude of ρ g a C_M A tanh kh"""
    return RHO * G * HEIGHT / 2 * coefficient * math.pi / 4 * width**2 * math.tanh(K * DEPTH)


ARM = DEPTH - (1 - 1 / math.cosh(K * DEPTH)) / (K * math.tanh(K * DEPTH))  # of inertia above the foot


def test_inertia_of_piles_that_stand_apart_adds_with_their_phases(tmp_path, asked, pictures):
    """At x the force is sin(kx − ωt): 90° ahead of the crest; two apart by kx = φ make 2 cos φ/2 of one"""
    x = 9.0
    path = written(tmp_path, pile("here", 0.0), pile("there", x))
    asked("members", path, "--plot", tmp_path / "p.png")
    found, F = hakobune.members(path), inertia()
    for name, at in (("here", 0.0), ("there", K * x)):
        assert found[f"{name}.size"] == pytest.approx(F, rel=2e-3)
        assert abs(found[f"{name}.Fx"]) == pytest.approx(F, rel=2e-3) and abs(found[f"{name}.Fy"]) < 1e-3
        off = math.degrees(found[f"{name}.phase"] - at) - 90
        assert min(off % 180, -off % 180) < 1.6
        assert found[f"moment[{name}].size"] == pytest.approx(F * ARM, rel=3e-3)
    both = found["force[all in the water].size"]
    assert both == pytest.approx(2 * F * abs(math.cos(K * x / 2)), rel=2e-3)
    moment = found["moment[all in the water].size"]
    assert moment == pytest.approx(2 * F * ARM * abs(math.cos(K * x / 2)), rel=3e-3)
    length = 2 * math.pi / K
    assert (
        f"the wave is {HEIGHT:g} m high and {length:.4g} m long; the theory is linear, stretched to the "
        f"surface (Wheeler)" in found.notes[0]
    )
    (axis,) = pictures[0].axes
    lines = {line.get_label(): line.get_data() for line in axis.lines}
    degrees, force = lines["here"]
    assert degrees == pytest.approx(np.arange(360)) and force == pytest.approx(
        F / 1e3 * np.abs(np.sin(np.radians(degrees))), abs=3e-6 * F
    )
    assert lines["all in the water"][1].max() == pytest.approx(both / 1e3)
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("phase, °; 0: crest at the origin", "force, kN")


@pytest.mark.parametrize("change, share", [
    ({"growth": 0.15}, (1.5 / 1.2) ** 2),  # grows all around
    ({"inertia": 1.7}, 0.85), ({"shape": '"square"'}, 2.19 * 4 / (2 * math.pi)),  # DNV-RP-C205, appendix D
])  # fmt: skip
def test_growth_coefficients_and_shapes_change_inertia_by_the_section(tmp_path, change, share):
    found = hakobune.members(written(tmp_path, pile("one", 0.0, **change)))
    assert found["force[one].size"] == pytest.approx(share * inertia(), rel=3e-3)


def test_waves_that_come_from_the_side_push_the_other_way(tmp_path):
    """incidence 90° is from +y: towards −y; a pile aside of the origin makes a moment about z"""
    path = written(tmp_path, pile("one", 5.0), direction="incidence_deg = 90")
    found, F = hakobune.members(path), inertia()
    phase, one = found.labels["phase"].values, list(found.labels["member"].values).index("one")
    assert abs(found["one.Fy"]) == pytest.approx(F, rel=2e-3) and abs(found["one.Fx"]) < 1e-3
    # a crest that goes towards −y has water go that way; after it the water is accelerated towards +y
    assert found["course.force"][:, one, 1] == pytest.approx(F * np.sin(phase), abs=3e-3 * F)
    assert found["moment[one].size"] == pytest.approx(F * ARM, rel=3e-3)
    assert found["moment[all in the water].size"] == pytest.approx(F * math.hypot(ARM, 5.0), rel=3e-3)


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_a_member_as_wide_as_a_fifth_of_the_wave_scatters_it(tmp_path, asked, share, status):
    width = 0.2 * 2 * math.pi / K * share
    _, said = asked("members", written(tmp_path, pile("wide", 0.0, width=width)), status=status)
    assert (
        f"FAILS: wide: the width is {width:.3g} m, limit 0.2 of the wave length, {2 * math.pi / K:.3g} m" in said
    ) is bool(status)


@pytest.mark.parametrize("share, refused", [(0.99, False), (1.01, True)])
def test_a_wave_breaks_above_the_limit_of_miche(tmp_path, capsys, share, refused):
    """0.142 λ tanh kh"""
    limit = 0.142 * 2 * math.pi / K * math.tanh(K * DEPTH)
    status = main(["members", str(written(tmp_path, pile("one", 0.0, top=9.0), height=limit * share))])
    assert (status == 2) is refused
    assert not refused or f"a wave of 8 s breaks at {limit:.3g} m in 12 m of water" in capsys.readouterr().err


@pytest.mark.parametrize("share, refused", [(0.98, False), (1.02, True)])
def test_a_wave_whose_energy_a_current_holds_back_is_refused(tmp_path, capsys, share, refused):
    """C_g = ½ (1 + 2kh / sinh 2kh) ω/k"""
    group = 0.5 * (1 + 2 * K * DEPTH / math.sinh(2 * K * DEPTH)) * W / K
    current = f"[current]\nspeed = {share * group}\ndirection_deg = 180\n"
    status = main(["members", str(written(tmp_path, pile("one", 0.0), current))])
    assert (status == 2) is refused
    assert not refused or f"whose energy travels at {group:.3g} m/s: no such wave" in capsys.readouterr().err
    along = current.replace("180", "0")
    assert main(["members", str(written(tmp_path, pile("one", 0.0), along))]) == 0


@pytest.mark.parametrize("growth, says", [(0.0, None), (1.0, None), (1.01, "growth is 1.01 m; allowed: 0 to 1"),
                                          (-0.01, "growth is -0.01 m; allowed: 0 to 1")])  # fmt: skip
def test_growth_is_a_metre_at_most(tmp_path, capsys, growth, says):
    status = main(["members", str(written(tmp_path, pile("one", 0.0, growth=growth)))])
    assert (status == 2) is (says is not None)
    assert says is None or says in capsys.readouterr().err


def test_what_lacks_members_water_or_wind_is_refused(tmp_path, capsys):
    wind = '[[wind_members]]\nname = "a"\ndrag = 1.0\narea = 1.0\nposition = [0, 0, 5]\n'
    for tables, height, says in (
        ((), HEIGHT, "there are no members; give at least one [[members]] or [[wind_members]]"),
        ((pile("one", 0.0),), 0, "there is neither wave nor current; give [wave], [current] or both"),
        ((wind,), HEIGHT, "wind is missing; [[wind_members]] need it"),
        ((pile("one", 0.0).replace("[0.0, 0.0, 3.0]", "[0.0, 0.0, -12.0]"),), HEIGHT, "allowed: two different "
        "finite points"),
        ((pile("one", 0.0), "[wind]\nspeed = 30\ndirection_deg = 0\n", wind.replace("drag = 1.0\n", "")), HEIGHT,
         "wind member 'a': give one of shape, drag"),
    ):  # fmt: skip
        assert main(["members", str(written(tmp_path, *tables, height=height))]) == 2
        assert says in capsys.readouterr().err
