"""`hakobune line` against the catenary's closed form: every row, the characteristic, the picture, every limit.

Partly on a flat bed, inextensible: s = √(h(h + 2a)) hangs, x = a arcosh(1 + h/a), a = H/w; X = L − s + x;
T = H + w h at the fairlead, V = w s; at the anchor H − μ w (L − s); dH/dX = w / (arcosh(1 + h/a) − 2/√(1 + 2a/h)).
"""

import math

import numpy as np
import pytest

from hakobune.pipelines.cli import main

W, L, DEPTH, Z, MU = 800.0, 300.0, 40.0, 5.0, 0.4  # N/m, m
H_FAIRLEAD = DEPTH + Z
WORDS = ["line", "--weight", W, "--length", L, "--depth", DEPTH, "--fairlead-z", Z]


def hanging(H, w=W, h=H_FAIRLEAD, length=L):
    """Span m, hanging length m, tension kN, stiffness kN/m of a horizontal force, kN"""
    a = 1e3 * H / w
    s, x = math.sqrt(h * (h + 2 * a)), a * math.acosh(1 + h / a)
    stiffness = w / (math.acosh(1 + h / a) - 2 / math.sqrt(1 + 2 * a / h)) / 1e3
    return length - s + x, s, H + w * h / 1e3, stiffness


def rows(table):
    return {row["quantity"]: row for row in table["rows"]}


@pytest.mark.parametrize("strain, status", [(0.495, 0), (0.505, 1)])
def test_a_rope_that_is_half_as_long_again_parts(asked, strain, status):
    """T/EA: of a light line that stands straight up, EA ε all along"""
    words = ["line", "--weight", 1.0, "--stiffness", 100.0, "--length", 40, "--depth", repr(40 * (1 + strain))]
    _, said = asked(*words, "--span", 0, status=status)
    told = f"FAILS: the line is {100 * strain:.3g}" in said and "limit 50 %, where any rope parts" in said
    assert told is bool(status)


def test_the_picture_of_a_line_has_its_profile_and_its_curves(tmp_path, asked, pictures):
    H = 150.0
    span, s, T, _ = hanging(H)
    asked(*WORDS, "--tension", H, "--output", tmp_path / "line.png")
    left, right = pictures[0].axes
    a = 1e3 * H / W
    x, z = left.lines[0].get_data()
    hung = np.where(x > L - s, a * (np.cosh(np.maximum(x - (L - s), 0) / a) - 1), 0.0)
    assert z == pytest.approx(hung, abs=1e-6) and (x[0], x[-1]) == pytest.approx((0.0, span))
    bed = left.lines[1].get_data()
    assert np.all(bed[1] == 0) and bed[0][0] <= 0 and bed[0][1] == pytest.approx(1.02 * span)
    assert left.lines[-1].get_xydata()[0] == pytest.approx([span, H_FAIRLEAD])
    assert left.get_aspect() == ("auto" if 0.1 * span >= H_FAIRLEAD else 1.0)
    assert left.get_title() == "line: partly on the bed"
    assert (left.get_xlabel(), left.get_ylabel()) == ("x from the anchor, m", "height, m")
    assert (right.get_xlabel(), right.get_ylabel()) == ("span, m", "kN")
    pull, tension = (line.get_data() for line in right.lines[:2])
    assert [line.get_label() for line in right.lines[:2]] == ["horizontal at the fairlead", "tension at the fairlead"]
    lying = (pull[1] > 1) & (pull[0] < hanging(790.0)[0])
    assert lying.sum() > 50
    assert tension[1][lying] - pull[1][lying] == pytest.approx(W * H_FAIRLEAD / 1e3, rel=1e-6)
    assert [hanging(h)[0] for h in pull[1][lying]] == pytest.approx(pull[0][lying], abs=1e-6)
    assert right.lines[2].get_xydata()[0] == pytest.approx([span, T])


LIMITS = [
    ("--weight", "1000000", "1000001", "above 0, at most 1e+06"),
    ("--weight", "0.1", "0", "above 0, at most 1e+06"),
    ("--length", "100000", "100001", "above 0, at most 100000"),
    ("--depth", "12000", "12001", "at least 0, at most 12000, the deepest sea"),
    ("--depth", "0", "-1", "at least 0, at most 12000, the deepest sea"),
    ("--friction", "5", "5.01", "0 to 5"),
    ("--friction", "0", "-0.01", "0 to 5"),
    ("--slope-deg", "85.9", "86", "above −85.94 and below 85.94"),
    ("--slope-deg", "-85.9", "-86", "above −85.94 and below 85.94"),
    ("--span", "0", "-1", "at least 0, finite"),
    ("--stiffness", "1", "0", "above 0"),
    ("--tension", "0.001", "0", "above 0, finite"),
    ("--fairlead-z", "0", "nan", "finite"),
]


@pytest.mark.parametrize("flag, good, bad, allowed", LIMITS)
def test_each_flag_is_taken_up_to_its_limit(flag, good, bad, allowed, capsys):
    words = {"--weight": "800", "--length": "300", "--depth": "40", "--span": "280"}
    if flag == "--tension":
        del words["--span"]
    for value, refused in ((good, False), (bad, True)):
        given = words | {flag: value}
        main(["line", *(f"{key}={text}" for key, text in given.items())])
        said = capsys.readouterr().err
        assert (f"{flag} is" in said and f"allowed: {allowed}" in said) is refused, (value, said)


@pytest.mark.parametrize("slope, height, refused", [(5.0, 24.6, False), (5.0, 24.4, True), (0.0, 0.1, False)])
def test_a_fairlead_lies_above_the_bed(slope, height, refused, capsys):
    """The bed of 5° is 280 tan 5° = 24.50 m above the anchor there"""
    words = f"line --weight 800 --stiffness 1e5 --length 300 --depth 40 --span 280 --slope-deg {slope}"
    status = main([*words.split(), "--fairlead-z", f"{height - 40}"])
    assert (status == 2) is refused
    assert not refused or "allowed: from -15.5032 m, the bed 280 m from the anchor (--depth, --slope-deg)" in (
        capsys.readouterr().err
    )
