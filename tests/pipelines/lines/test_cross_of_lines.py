"""`hakobune lines` of a cross of four chains, all of whose numbers follow from one catenary by hand.

A chain of w N/m and length L partly on the bed h below: s = √(h(h + 2a)) hangs, X = L − s + a arcosh(1 + h/a), a = H/w,
T = H + w h.
"""

import math

import by_hand
import numpy as np
import pytest
from by_hand import root

import hakobune

W, L, H_WATER, SPAN = 1000.0, 330.0, 50.0, 310.0
ARMS = {"E": (20.0, 0.0), "W": (-20.0, 0.0), "N": (0.0, 10.0), "S": (0.0, -10.0)}
BREAKING = 2000.0  # kN


POSE = ("x", "y", "z", "roll", "pitch", "yaw")


def span_of(H):
    """m, of a horizontal force, kN"""
    return by_hand.span_of(1e3 * H, W, L, H_WATER)


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


def test_tensions_at_rest_and_the_stiffness_of_a_cross(tmp_path, asked):
    """Two chains along and two across: 2 (k + H/X); yaw Σ H r (X + r)/X; of heave four times dV/dz, which with the
    couplings Σ r × K of fairleads 20 m ahead and 10 m abeam makes roll and pitch"""
    found = hakobune.lines(written(tmp_path))
    H = pull_at(SPAN)
    lying = SPAN - 1e3 * H / W * math.acosh(1 + H_WATER / (1e3 * H / W))
    T = H + W * H_WATER / 1e3
    assert found["tension.a"] == pytest.approx([1e3 * H] * 4, rel=1e-5)
    assert found["horizontal.b"] == pytest.approx([1e3 * H] * 4, rel=1e-5)
    assert found["tension.b"] == pytest.approx([1e3 * T] * 4, rel=1e-5)
    assert found["grounded"] == pytest.approx([lying] * 4, rel=1e-5)
    assert found["used"] == pytest.approx([T / BREAKING] * 4, rel=1e-5)
    whole = np.hstack([found["stiffness.shift"], found["stiffness.turn"]]) / 1e3
    modes = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
    K = {one: dict(zip(modes, row, strict=True)) for one, row in zip(modes, whole, strict=True)}
    k, across = stiffness(H), H / SPAN
    assert [K["Surge"]["Surge"], K["Sway"]["Sway"]] == pytest.approx([2 * (k + across)] * 2, rel=1e-3)
    yaw = 2 * H * (20 * 330 + 10 * 320) / SPAN
    assert K["Yaw"]["Yaw"] == pytest.approx(yaw, rel=1e-3)

    # by differences of the closed form in depth: V = w s of the same length and span
    def vertical(h, span=SPAN):
        def of(H):
            a = 1e3 * H / W
            return L - math.sqrt(h * (h + 2 * a)) + a * math.acosh(1 + h / a)

        a = 1e3 * root(lambda H: of(H) - span, 1e-3, 1000.0) / W
        return W * math.sqrt(h * (h + 2 * a)) / 1e3

    kzz = (vertical(H_WATER + 0.01) - vertical(H_WATER - 0.01)) / 0.02
    kzx = (vertical(H_WATER, SPAN + 0.01) - vertical(H_WATER, SPAN - 0.01)) / 0.02
    V = vertical(H_WATER)
    assert K["Heave"]["Heave"] == pytest.approx(4 * kzz, rel=1e-3)
    assert [K["Surge"]["Pitch"], K["Pitch"]["Surge"]] == pytest.approx([2 * 20 * kzx] * 2, rel=1e-3)
    assert [K["Sway"]["Roll"], K["Roll"]["Sway"]] == pytest.approx([-2 * 10 * kzx] * 2, rel=1e-3)
    # pitch: 2 r² kzz of the fairleads ahead; turned up or down, their pull H has the arm r θ: 2 r H
    assert K["Pitch"]["Pitch"] == pytest.approx(2 * (20**2 * kzz + 20 * H), rel=1e-3)
    assert K["Roll"]["Roll"] == pytest.approx(2 * (10**2 * kzz + 10 * H), rel=1e-3)
    assert [K["Surge"]["Yaw"], K["Heave"]["Surge"]] == pytest.approx([0, 0], abs=1e-6) and V > 0
    assert [found[f"barge.{name}"] for name in POSE] == pytest.approx([0.0] * 6, abs=1e-6)


def test_offsets_from_rest_pull_back_by_the_difference_of_both_chains(tmp_path, asked, pictures):
    """Moved d along: H(X + d) − H(X − d) + 2 H(√(X² + d²)) d/√(X² + d²); the largest T = H + w h of them"""
    found = hakobune.lines(written(tmp_path), offset=5.0, directions=[0.0, np.pi / 2, np.pi / 3])
    asked("lines", written(tmp_path), "--offset", 5, "--direction", "0,90,60", "--plot", tmp_path / "p.png")
    offsets, by_hand = found.labels["offset"].values, []
    assert offsets == pytest.approx(np.linspace(-5, 5, 21))
    for d in offsets:
        back, ahead, aside = pull_at(SPAN + d), pull_at(SPAN - d), pull_at(math.hypot(SPAN, d))
        force = back - ahead + 2 * aside * d / math.hypot(SPAN, d)
        by_hand.append((force, max(back, ahead, aside) + W * H_WATER / 1e3))
    for k in (0, 1):
        assert found["curve.restoring"][:, k] / 1e3 == pytest.approx(
            [force for force, _ in by_hand], rel=1e-5, abs=1e-3
        )
        assert found["curve.tension"][:, k] / 1e3 == pytest.approx([tension for _, tension in by_hand], rel=1e-5)
    # along 60°: the force against each chain, resolved along the way
    dx, dy = 5 * math.cos(math.pi / 3), 5 * math.sin(math.pi / 3)
    pull = 0.0
    for x, y in ((SPAN, 0), (-SPAN, 0), (0, SPAN), (0, -SPAN)):
        away = math.hypot(x - dx, y - dy)
        pull -= pull_at(away) * ((x - dx) * math.cos(math.pi / 3) + (y - dy) * math.sin(math.pi / 3)) / away
    assert found["curve.restoring"][-1, 2] / 1e3 == pytest.approx(pull, rel=1e-5)
    curves = pictures[0].axes[2]
    assert (curves.get_xlabel(), curves.get_ylabel(), curves.get_title()) == (
        "offset, m", "kN", "barge held at an offset")  # fmt: skip
    lines = {line.get_label(): line.get_ydata() for line in curves.lines}
    assert lines["restoring 90°"] == pytest.approx([force for force, _ in by_hand], abs=0.01)
    assert lines["largest tension 0°"] == pytest.approx([tension for _, tension in by_hand], abs=0.01)


def test_with_one_chain_lost_the_others_come_to_rest_where_they_balance(tmp_path, asked, pictures):
    """2 H(√(X² + d²)) d/√(X² + d²) = H(X − d)"""

    def left(d):
        return 2 * pull_at(math.hypot(SPAN, d)) * d / math.hypot(SPAN, d) - pull_at(SPAN - d)

    d = root(left, 1.0, 25.0)
    T = pull_at(math.hypot(SPAN, d)) + W * H_WATER / 1e3
    found = hakobune.lines(written(tmp_path), broken=True)
    asked("lines", written(tmp_path), "--broken", "--plot", tmp_path / "p.png")
    assert found.labels["lost"].values.tolist() == list(ARMS)
    assert found["loss.tension"] / 1e3 == pytest.approx([T] * 4, rel=1e-5)
    assert found["loss.used"] == pytest.approx([T / BREAKING] * 4, rel=1e-5)
    assert found["loss.shift"] == pytest.approx([d] * 4, rel=1e-5)
    assert all((worst in "NS") is (gone in "EW") for worst, gone in zip(found["loss.worst"], ARMS, strict=True))
    plan, profile, _, bars = pictures[0].axes[:4]
    assert bars.get_xlabel() == "largest tension, kN"
    whole = pull_at(SPAN) + W * H_WATER / 1e3
    assert [bar.get_width() for bar in bars.patches] == pytest.approx([whole, T, T, T, T], abs=0.01)
    # plan: from each anchor to its fairlead; profile: on the bed, then up to the surface
    ends = [line.get_xydata()[[0, -1]] for line in plan.lines[:4]]
    for (x, y), drawn in zip(ARMS.values(), ends, strict=True):
        out = 1 + SPAN / math.hypot(x, y)
        assert drawn == pytest.approx(np.array([[out * x, out * y], [x, y]]), abs=1e-6)
    z = profile.lines[0].get_ydata()
    assert z[0] == pytest.approx(-50.0) and z[-1] == pytest.approx(0.0) and z.min() >= -50.0 - 1e-9
    assert pictures[0].axes[-1].get_ylabel() == "tension, kN"


def test_a_force_on_the_body_moves_it_to_where_the_chains_balance_it(tmp_path, asked):
    """28.9 kN along x: the offset of the curve at which the chains pull back with it; a moment of k_yaw θ turns it"""
    d = 2.0
    force = pull_at(SPAN + d) - pull_at(SPAN - d) + 2 * pull_at(math.hypot(SPAN, d)) * d / math.hypot(SPAN, d)
    moved = hakobune.lines(written(tmp_path), force=(1e3 * force, 0.0, 0.0))
    assert [moved["barge.x"], moved["barge.y"]] == pytest.approx([d, 0.0], abs=1e-5)
    moved = hakobune.lines(written(tmp_path), force=(0.0, -1e3 * force, 0.0))
    assert [moved["barge.x"], moved["barge.y"]] == pytest.approx([0.0, -d], abs=1e-5)
    turned = math.radians(0.5)
    yaw = 2 * pull_at(SPAN) * (20 * 330 + 10 * 320) / SPAN * turned
    assert hakobune.lines(written(tmp_path), force=(0.0, 0.0, 1e3 * yaw))["barge.yaw"] == pytest.approx(
        turned, rel=0.01
    )


def test_steady_forces_of_the_file_do_the_same(tmp_path):
    d = 2.0
    force = pull_at(SPAN + d) - pull_at(SPAN - d) + 2 * pull_at(math.hypot(SPAN, d)) * d / math.hypot(SPAN, d)
    found = hakobune.lines(written(tmp_path, f"force_kN = [{force!r}, 0.0, 0.0]\n"))
    assert [found[f"barge.{name}"] for name in POSE] == pytest.approx([d, 0, 0, 0, 0, 0], abs=1e-3)
    yaw = 2 * pull_at(SPAN) * (20 * 330 + 10 * 320) / SPAN * math.radians(0.5)
    found = hakobune.lines(written(tmp_path, f"moment_kNm = [0.0, 0.0, {yaw!r}]\n"))
    assert [found[f"barge.{name}"] for name in POSE] == pytest.approx([0, 0, 0, 0, 0, math.radians(0.5)], abs=1e-4)


def test_a_body_that_is_held_lies_where_it_is_given_and_turned_as_given(tmp_path):
    found = hakobune.lines(written(tmp_path, "position = [3.0, 4.0, 0.0]\nheading_deg = 2.0\nfreedom = []\n"))
    assert [found[f"barge.{name}"] for name in POSE] == pytest.approx([3, 4, 0, 0, 0, math.radians(2)], abs=1e-12)


def test_what_is_written_is_in_newtons(tmp_path, asked):
    asked("lines", written(tmp_path), "--output", tmp_path / "rest.h5")
    H, kept = pull_at(SPAN), hakobune.read(tmp_path / "rest.h5")
    assert kept["tension.b"] == pytest.approx([1e3 * H + W * H_WATER] * 4, rel=1e-6)
    assert kept["tension.a"] == pytest.approx([1e3 * H] * 4, rel=1e-6)


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
    ("--depth", None, "50", "leave --depth out, or change [water] depth"),
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
    assert flag in said and (f"allowed: {allowed}" in said or f"; {allowed}" in said)
