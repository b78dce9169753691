"""Which rectangles `hakobune sections` takes: both sides of each limit, of flags and of the function."""

import math

import pytest
from scipy.optimize import brentq

import hakobune
from hakobune.pipelines.cli import main

ONE = {"beam_draft": [5.0], "depth_draft": [2.0], "xi": [0.5], "tolerance": 1e-3}


@pytest.mark.parametrize("words, says", [
    ("--beam-draft 0", "beam-draft is 0; allowed: above 0, finite"),
    ("--depth-draft 1", "depth-draft is 1; allowed: above 1, or inf"),
    ("--xi inf", "xi is inf; allowed: above 0, finite"), ("--xi 0.5,0.5", "give each number once"),
    ("--xi 2:1:3", "allowed: start:stop:count with start below stop"), ("--xi 1:2:1", "--xi has 1 numbers; allowed: 2"),
])  # fmt: skip
def test_sections_refuse_what_cannot_be(words, says, capsys):
    assert main(["sections", *words.split()]) == 2
    said = capsys.readouterr().err
    assert says in said and said.count("\n") == 1


@pytest.mark.parametrize("depth", [math.inf, 2.0])
def test_damping_is_what_a_wave_force_radiates(depth):
    """Haskind and Newman: N = |E|²/(2ρg c_g), of waves to both sides.  In the report's units, N/(ρBdω) and E/(ρgB/2) or
    E/(ρg(B/2)²), N' = E'² (B/4d) g/(2ω c_g), where deep water has 2ω c_g = g; else ω² = gk tanh kh and
    c_g = (ω/2k)(1 + 2kh/sinh 2kh)"""
    made = hakobune.sections(**{**ONE, "depth_draft": [depth]})
    ratio = 1.0
    if depth < math.inf:
        kh = brentq(lambda x: x * math.tanh(x) - 0.5 / 2.5 * depth, 1e-3, 9.0)  # ω²h/g = ξ_B h/(B/2)
        ratio = math.tanh(kh) * (1 + 2 * kh / math.sinh(2 * kh))
    for mode in "HSR":
        by_hand = made[f"E_{mode}"].item() ** 2 * 5 / 4 / ratio
        assert made[f"N_{mode}"].item() == pytest.approx(by_hand, rel=2e-3), mode
