"""`hakobune line-dynamics` of a light rope that stands taut: slow enough, it is a spring, T = EA (r − L)/L.

Of 200 m and EA = 20 MN, stretched by 1 m: 100 kN at rest, and ± 80 kN of a fairlead that goes up and down by 0.8 m in
20 s; its own axial period is 2 L √(m/EA) = 0.2 s, its weight 1 N/m.
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.line_dynamics import command

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


def test_every_tension_of_a_rope_that_is_a_spring(tmp_path, asked, pictures):
    out = tmp_path / "run.h5"
    words = ["line-dynamics", written(tmp_path), "--output", out, "--plot", tmp_path / "p.png"]
    asked(*words)
    found = hakobune.read(out)
    assert [found[f"window.{name}"] for name in ("begin", "end", "cycles")] == [RAMP, RAMP + 3 * PERIOD, 3]
    rest, swing = EA * STRETCH / L, EA * RISE / L
    by_hand = {
        "largest": rest + swing,
        "mean": rest,
        "least": rest - swing,
        "at_rest": rest,
        "quasi_static": rest + swing,
    }
    for name, value in by_hand.items():
        assert found[f"tension.{name}"] / 1e3 == pytest.approx([value] * 2, abs=0.012 * swing), name
    assert found["tension.over_quasi_static"] == pytest.approx([1.0, 1.0], abs=0.011)
    assert found["slack"].tolist() == found["slack.in_cycle"].tolist() == [0.0, 0.0]
    assert found["tension.used"] == pytest.approx([(rest + swing) / 400] * 2, abs=3e-3)
    top = found["tension[fairlead].time"]
    assert min((top - RAMP) % PERIOD, PERIOD - (top - RAMP) % PERIOD) < 0.6  # z goes as cos ωt
    t, T = found.labels["time"].values, found["history.fairlead"]
    z = STRETCH + RISE * np.cos(2 * np.pi * t / PERIOD)
    late = t >= RAMP
    assert T[late] == pytest.approx(1e3 * EA * z[late] / L, abs=1e3 * 0.012 * swing)
    assert found["fairlead.place"][late, 2] == pytest.approx(z[late], abs=1e-9)
    assert np.allclose(found["line.place"][:, 0, 2], -L) and np.all(found["fairlead.place"][:, 0] == 0)
    history = pictures[0].axes[0]
    lines = {line.get_label(): line for line in history.lines}
    assert lines["fairlead"].get_xydata() == pytest.approx(np.stack([t, T / 1e3], 1), rel=1e-9, abs=1e-9)
    assert lines["fairlead, largest quasi-static"].get_ydata()[0] == pytest.approx(rest + swing, rel=0.01)
    assert "breaking load" not in lines  # 400 kN is more than half above what is drawn
    (span,) = history.patches
    assert span.get_x() == RAMP and span.get_width() == 3 * PERIOD
    assert (history.get_xlabel(), history.get_ylabel()) == ("t, s", "tension, kN")
    strips = pictures[0].axes[1:]
    assert len(strips) == 8
    for i, axes in enumerate(strips):
        assert float(axes.get_title().split()[0]) == pytest.approx(RAMP + (2 + i / 8) * PERIOD, abs=PERIOD / 19)


def test_work_into_a_rope_is_what_it_loses_and_stores(tmp_path, asked):
    """100 % in all, of three cycles a third each; with no drag along it, it is lost in the rope itself"""
    path = written(tmp_path, ("drag_tangential = 0.0", "drag_tangential = 0.5"))
    found = hakobune.line_dynamics(path)
    parts = ("drag", "water inertia", "structural", "bed", "friction", "stored")
    work = dict(zip(found.labels["work"].values.tolist(), found["work.per_cycle"], strict=True))
    share = dict(zip(found.labels["work"].values.tolist(), found["work.share"], strict=True))
    assert sum(work[name] for name in parts) == pytest.approx(work["done on the line"], rel=2e-3)
    assert sum(share[name] for name in parts) == pytest.approx(1, abs=5e-4) and share["done on the line"] == 1.0
    # ½ ρ C πD ∫∫ |v|³ ds dt of an element that goes with s/L of the fairlead: ∫₀^L (s/L)³ ds = L/4, ∫ |cos|³ = 8/3ω
    omega = 2 * math.pi / PERIOD
    drag = 0.5 * 1025 * 0.5 * math.pi * 0.08 * (RISE * omega) ** 3 * L / 4 * 8 / (3 * omega) / 1e3
    assert work["drag"] == pytest.approx(1e3 * drag, rel=0.03)
    assert found["work.energy"] == pytest.approx(3 * found["work.per_cycle"], rel=1e-12)


def test_a_rope_is_slack_as_long_as_it_has_less_than_a_tenth_of_its_tension_at_rest(tmp_path, asked):
    """1 + 1.1 cos ωt < 0.1, by the tenth of DNV-RP-H103 (2011), 4.4.3; below nothing it stays at nothing"""
    path = written(tmp_path, (f"amplitude = [0.0, 0.0, {RISE}]", "amplitude = [0.0, 0.0, 0.95]"))
    found, share = hakobune.line_dynamics(path), 1 - math.acos(-0.9 / 0.95) / math.pi
    assert found["slack[fairlead].in_cycle"] == pytest.approx(share * PERIOD, abs=0.25)
    assert found["slack"][0] == pytest.approx(3 * share * PERIOD, abs=0.75)


@pytest.mark.parametrize("load, status", [(184.0, 0), (176.0, 2)])
def test_a_fairlead_goes_no_farther_than_a_rope_reaches_that_bears_its_breaking_load(tmp_path, asked, load, status):
    """L (1 + T/EA); 180 kN are what it bears"""
    path = written(tmp_path, ("breaking_load_kN = 400.0", f"breaking_load_kN = {load}"))
    _, said = asked("line-dynamics", path, status=status)
    told = "the fairlead is 201.80 m from the anchor at t = 20.00 s; allowed: up to 201.76 m, where the line of 200 m"
    assert (f"{told} breaks at 176 kN" in said) is bool(status)


@pytest.mark.parametrize("load, status", [(126.0, 0), (121.5, 1)])
def test_a_rope_in_a_standing_wave_parts_at_its_anchor_above_its_breaking_load(tmp_path, asked, load, status):
    """u = A sin kx/sin kL: the tension swings by (EA A/L) kL/sin kL at the anchor, kL/tan kL at the fairlead;
    c = √(EA/m) = 2000 m/s and kL = 1 in 0.628 s, so that 20 kN become 23.8 and 12.8 kN"""
    period = 2 * math.pi * L / math.sqrt(1e3 * EA / 5.0)
    path = written(tmp_path, ("breaking_load_kN = 400.0", f"breaking_load_kN = {load}\ndamping_ratio = 0.02"),
                   (f"period = {PERIOD}", f"period = {period!r}"), (f"0.0, {RISE}]", "0.0, 0.2]"),
                   ("duration = 80.0", f"duration = {20 * period!r}"), (f"ramp = {RAMP}", f"ramp = {12 * period!r}"),
                   ("elements = 8", "elements = 24"))  # fmt: skip
    found = hakobune.line_dynamics(path)
    assert found["tension[anchor].largest"] / 1e3 == pytest.approx(100 + 20 / math.sin(1), abs=0.8)
    assert found["tension[fairlead].largest"] / 1e3 == pytest.approx(100 + 20 / math.tan(1), abs=0.8)
    assert found.status == status
    told = "% of the breaking load 121.5 kN: the line parts; give a stronger type"
    assert any(told in one for one in found.fails) is bool(status)


def test_a_breaking_load_near_the_tensions_is_drawn(tmp_path, asked, pictures):
    path = written(tmp_path, ("breaking_load_kN = 400.0", "breaking_load_kN = 250.0"))
    asked("line-dynamics", path, "--plot", tmp_path / "p.png")
    lines = {line.get_label(): line.get_ydata()[0] for line in pictures[0].axes[0].lines}
    assert lines["breaking load"] == 250.0


@pytest.mark.parametrize("change, says", [
    (("depth = inf", "depth = inf\n[current]\nspeed = 0.0\ndirection_deg = 0\nz = [-1, 0]"), "one of z and speeds"),
    (("[fairlead]\n", "[current]\nspeed = 1\ndirection_deg = 0\nz = [-1, 0]\nspeeds = [0, 1]\n[fairlead]\n"),
     "current: z and speeds are given with speed or exponent; give one of the two"),
    (("duration", "frames = 1\nduration"), "frames is 1; allowed: 2 to 100000"),
    (("duration", "frames = 100001\nduration"), "frames is 100001; allowed: 2 to 100000"),
    (("duration", "tolerance = 9e-9\nduration"), "tolerance is 9e-09; allowed: 1e-08 to 0.1"),
    (("duration", "tolerance = 0.11\nduration"), "tolerance is 0.11; allowed: 1e-08 to 0.1"),
    (("duration", "measure_from = 61\nduration"), "the evaluation begins at 61 s of 80 s; allowed: 0 to 60 s, "
    "one cycle"),
    (("duration", "measure_from = -1\nduration"), "the evaluation begins at -1 s of 80 s; allowed: 0 to 60 s"),
    (("ramp = 20.0", "ramp = -1.0"), "fairlead.ramp is -1 s; allowed: finite, at least 0"),
    (("depth = inf", "depth = 0"), "water.depth is 0; allowed: above 0"),
    (("[fairlead]\n", "[bed]\n[fairlead]\n"), "bed is given and water.depth is inf"),
    ((f"position = [0.0, 0.0, {STRETCH}]", "position = [0.0, 0.0, 101.0]"), "m from the anchor"),
    (("[fairlead]\n", "[wave]\nheight = 8.0\nperiod = 6.0\ndirection_deg = 0\n[fairlead]\n"),
     "wave.height is 8 m; allowed: up to 7.98 m, at which such a wave breaks"),
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


def test_a_current_in_knots_drags_a_taut_rope_by_half_rho_c_d_u2(tmp_path, asked):
    """q = ½ρ C_D D U² across a string of tension T sags it by q L²/8T, here read off the frames"""
    path = written(tmp_path, (f"amplitude = [0.0, 0.0, {RISE}]", "amplitude = [0.0, 0.0, 0.0]"),
                   ("[fairlead]\n", "[current]\nspeed_knots = 1.0\nincidence_deg = 270\n[fairlead]\n"),
                   ("drag_tangential", "drag_normal = 1.5\ndrag_tangential"))  # fmt: skip
    nodes = hakobune.line_dynamics(path)["line.place"]
    q = 0.5 * 1025 * 1.5 * 0.08 * (1852 / 3600) ** 2
    sag = q * L**2 / (8 * 100e3)
    assert nodes[-1, 4, 1] == pytest.approx(sag, rel=0.05) and abs(nodes[-1, 4, 0]) < 1e-6


def test_progress_is_told_every_two_seconds_with_what_is_left_and_of_which_run(monkeypatch):
    """25 of 99 s took 3 s: 74 · 3/25 = 8.9 s are left; a time that falls back is that of the next run, of a check"""
    clock, said = iter([0.0, 0.0, 1.0, 3.0, 4.0, 8.0]), []
    monkeypatch.setattr(command, "time", SimpleNamespace(perf_counter=lambda: next(clock)))
    progress = command.Progress(SimpleNamespace(print=lambda text, **_: said.append(text)), 100.0)
    for reached in (1.0, 2.0, 26.0, 1.0, 51.0):
        progress(reached)
    assert said == ["26 of 100 s, 9 s left", "with fewer elements: 51 of 100 s, 4 s left"]
