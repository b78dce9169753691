"""`hakobune line-dynamics` of a light rope that stands taut: slow enough, it is a spring, T = EA (r − L)/L.

Of 200 m and EA = 20 MN, stretched by 1 m: 100 kN at rest, and ± 80 kN of a fairlead that goes up and down by 0.8 m in
20 s; its own axial period is 2 L √(m/EA) = 0.2 s, its weight 1 N/m.
"""

import math

import pytest

from hakobune.pipelines.cli import main

L, EA, STRETCH, RISE, PERIOD, RAMP = 200.0, 20e3, 1.0, 0.8, 20.0, 20.0  # m, kN, m, m, s
STUDY = f"""
name = "rope"
anchor = [0.0, 0.0, -{L}]
duration = {RAMP + 3 * PERIOD}
[water]
depth = inf
[types.rope]
weight_N_per_m = 1.0
mass_kg_per_m = 5.0
diameter = 0.08
axial_stiffness_kN = {EA}
breaking_load_kN = 400.0
drag_tangential = 0.0
[[segments]]
type = "rope"
length = {L}
elements = 8
[fairlead]
position = [0.0, 0.0, {STRETCH}]
ramp = {RAMP}
[[fairlead.motions]]
period = {PERIOD}
amplitude = [0.0, 0.0, {RISE}]
"""


def written(folder, *changes):
    text = STUDY
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "rope.toml"
    path.write_text(text)
    return path


def tensions(table):
    made = {}
    for row in table["rows"]:
        name = row.pop("")
        made[name] = {end: math.nan if value == "–" else float(value) for end, value in row.items()}
    return made


@pytest.mark.parametrize("load, status", [(184.0, 0), (176.0, 2)])
def test_a_fairlead_goes_no_farther_than_a_rope_reaches_that_bears_its_breaking_load(tmp_path, asked, load, status):
    """L (1 + T/EA); 180 kN are what it bears"""
    path = written(tmp_path, ("breaking_load_kN = 400.0", f"breaking_load_kN = {load}"))
    _, said = asked("line-dynamics", path, status=status)
    told = "the fairlead is 201.80 m from the anchor at t = 20.00 s; allowed: up to 201.76 m, where the line of 200 m"
    assert (f"{told} breaks at 176 kN" in said) is bool(status)


def test_a_breaking_load_near_the_tensions_is_drawn(tmp_path, asked, pictures):
    path = written(tmp_path, ("breaking_load_kN = 400.0", "breaking_load_kN = 250.0"))
    asked("line-dynamics", path, "--picture", tmp_path / "p.png")
    lines = {line.get_label(): line.get_ydata()[0] for line in pictures[0].axes[0].lines}
    assert lines["breaking load"] == 250.0


@pytest.mark.parametrize("change, says", [
    (("depth = inf", "depth = inf\n[current]\nspeed = 0.0\ndirection_deg = 0\nz = [-1, 0]"), "one of z and speeds"),
    (("[fairlead]\n", "[current]\nspeed = 1\ndirection_deg = 0\nz = [-1, 0]\nspeeds = [0, 1]\n[fairlead]\n"),
     "z and speeds are given beside speed or exponent"),
    (("duration", "frames = 1\nduration"), "frames is 1; allowed: 2 to 100000"),
    (("duration", "frames = 100001\nduration"), "frames is 100001; allowed: 2 to 100000"),
    (("duration", "tolerance = 9e-9\nduration"), "tolerance is 9e-09; allowed: 1e-08 to 0.1"),
    (("duration", "tolerance = 0.11\nduration"), "tolerance is 0.11; allowed: 1e-08 to 0.1"),
    (("duration", "measure_from = 61\nduration"), "the figures begin at 61 s of 80 s; allowed: 0 to 60 s, one cycle"),
    (("duration", "measure_from = -1\nduration"), "the figures begin at -1 s of 80 s; allowed: 0 to 60 s"),
    (("ramp = 20.0", "ramp = -1.0"), "fairlead.ramp is -1 s; allowed: finite, at least 0"),
    (("depth = inf", "depth = 0"), "water.depth is 0; allowed: above 0"),
    (("[fairlead]\n", "[bed]\n[fairlead]\n"), "bed is given and water.depth is inf"),
    ((f"position = [0.0, 0.0, {STRETCH}]", "position = [0.0, 0.0, 101.0]"), "m from the anchor"),
    (("[fairlead]\n", "[wave]\nheight = 8.0\nperiod = 6.0\ndirection_deg = 0\n[fairlead]\n"),
     "wave.height is 8 m; allowed: up to 7.98 m, where a wave of it breaks"),
    (("[fairlead]\n", "[sea]\nheight = 2.0\nperiod = 6.0\ndirection_deg = 0\ncomponents = 1001\n[fairlead]\n"),
     "sea.components is 1001; allowed: 10 to 1000"),
    (("[fairlead]\n", "[sea]\nheight = 2.0\nperiod = 6.0\ndirection_deg = 0\nseed = -1\n[fairlead]\n"),
     "sea.seed is -1; allowed: 0 to 4294967296"),
])  # fmt: skip
def test_what_lies_beyond_a_limit_is_refused(tmp_path, capsys, change, says):
    assert main(["line-dynamics", str(written(tmp_path, change))]) == 2
    said = capsys.readouterr().err
    assert says in said and said.count("\n") == 1


@pytest.mark.parametrize("change", [
    ("duration", "frames = 2\nduration"), ("duration", "tolerance = 0.1\nduration"),
    ("duration", "measure_from = 60\nduration"), ("ramp = 20.0", "ramp = 0.0"),
    ("[fairlead]\n", "[wave]\nheight = 7.9\nperiod = 6.0\ndirection_deg = 0\n[fairlead]\n"),
    ("[fairlead]\n", "[sea]\nheight = 2.0\nperiod = 6.0\ndirection_deg = 0\ncomponents = 10\nseed = 0\n[fairlead]\n"),
])  # fmt: skip
def test_what_lies_within_a_limit_is_run(tmp_path, capsys, change):
    path = written(tmp_path, change)
    assert main(["line-dynamics", str(path)]) in (0, 1)
    assert "allowed: 0 to" not in capsys.readouterr().err
