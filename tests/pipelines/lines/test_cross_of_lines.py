"""`hakobune lines` of a cross of four chains, all of whose numbers follow from one catenary by hand.

A chain of w N/m and length L partly on the bed h below: s = √(h(h + 2a)) hangs, X = L − s + a arcosh(1 + h/a), a = H/w,
T = H + w h.
"""

import math
import re

import pytest

W, L, H_WATER, SPAN = 1000.0, 330.0, 50.0, 310.0
ARMS = {"E": (20.0, 0.0), "W": (-20.0, 0.0), "N": (0.0, 10.0), "S": (0.0, -10.0)}
BREAKING = 2000.0  # kN


def span_of(H):
    """m, of a horizontal force, kN"""
    a = 1e3 * H / W
    return L - math.sqrt(H_WATER * (H_WATER + 2 * a)) + a * math.acosh(1 + H_WATER / a)


def root(value, low, high):
    """Where a rising function is zero"""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if value(middle) < 0 else (low, middle)
    return middle


def pull_at(span):
    """kN, horizontal"""
    return root(lambda H: span_of(H) - span, 1e-3, 1000.0)


def stiffness(H):
    a = 1e3 * H / W
    return W / 1e3 / (math.acosh(1 + H_WATER / a) - 2 / math.sqrt(1 + 2 * a / H_WATER))


def written(folder, extra="", breaking=BREAKING, depth=H_WATER):
    text = f"[water]\ndepth = {depth}\n[types.chain]\nweight_N_per_m = {W}\nbreaking_load_kN = {breaking}\n"
    text += f'[[bodies]]\nname = "barge"\n{extra}'
    for name, (x, y) in ARMS.items():
        out = 1 + SPAN / math.hypot(x, y)
        text += f'[[anchors]]\nname = "a{name}"\nposition = [{out * x}, {out * y}, -{depth}]\n'
        text += f'[[fairleads]]\nname = "f{name}"\nbody = "barge"\nposition = [{x}, {y}, 0.0]\n'
        text += f'[[lines]]\nname = "{name}"\nfrom = "a{name}"\nto = "f{name}"\ntype = "chain"\nlength = {L}\n'
    path = folder / "cross.toml"
    path.write_text(text)
    return path


def table_of(tables, words):
    return next(table["rows"] for table in tables if words in table["title"])


def numbers(text):
    return [float(word) for word in re.findall(r"-?\d+\.?\d*(?:e[+-]?\d+)?", text)]


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_a_chain_that_breaks_at_what_it_bears_is_told(tmp_path, asked, share, status):
    T = pull_at(SPAN) + W * H_WATER / 1e3
    _, said = asked("lines", written(tmp_path, breaking=T / share), status=status)
    assert ("FAILS: at rest, tension in % of the breaking load: E 101 %" in said) is bool(status)


LIMITS = [
    ("--offset", "0.5", "0", "above 0, at most 100000"),
    ("--offset", "0.5", "100001", "above 0, at most 100000"),
    ("--force", "1,0,0", "1,0", "3, Fx and Fy in kN and Mz in kN m"),
    ("--force", "1,0,0", "1,0,inf", "finite numbers a,b,c"),
    ("--body", "barge", "boat", "barge"),
    ("--depth", None, "50", "without it, or [water] depth"),
    ("--direction", ",".join(["0"] * 3), ",".join(["0"] * 361), "1 to 360"),
]


@pytest.mark.parametrize("flag, good, bad, allowed", LIMITS)
def test_a_flag_of_lines_is_taken_up_to_its_limit(tmp_path, capsys, flag, good, bad, allowed):
    from hakobune.pipelines.cli import main

    path = str(written(tmp_path))
    assert good is None or main(["lines", path, f"{flag}={good}"]) == 0
    capsys.readouterr()
    assert main(["lines", path, f"{flag}={bad}"]) == 2
    said = capsys.readouterr().err
    assert flag in said and f"allowed: {allowed}" in said
