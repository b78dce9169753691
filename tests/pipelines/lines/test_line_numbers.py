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


@pytest.mark.parametrize("by", ["--span", "--tension"])
def test_every_row_of_a_line_partly_on_the_bed(asked, by):
    H = 150.0
    span, s, T, stiffness = hanging(H)
    (table,), _ = asked(*WORDS, "--friction", MU, by, repr(span) if by == "--span" else H)
    found = rows(table)
    assert table["title"] == "line" and found["span"]["note"] == "partly on the bed"
    for name, value, unit in (
        ("span", span, "m"),
        ("horizontal force at the fairlead", H, "kN"),
        ("vertical force at the fairlead", W * s / 1e3, "kN"),
        ("horizontal force at the anchor", H - MU * W * (L - s) / 1e3, "kN"),
        ("vertical force at the anchor", 0.0, "kN"),
        ("tension at the fairlead", T, "kN"),
        ("length on the bed", L - s, "m"),
        ("horizontal stiffness", stiffness, "kN/m"),
        ("weight in water", W, "N/m"),
    ):
        assert found[name]["value"] == pytest.approx(value, rel=1e-6, abs=1e-6), name
        assert found[name]["unit"] == unit
    assert found["vertical force at the fairlead"]["note"] == "down"
    assert found["vertical force at the anchor"]["note"] == "up"
    assert float(found["tension at the fairlead"]["note"].split()[0]) == pytest.approx(T / 9.80665, rel=1e-3)
    assert found["length on the bed"]["note"] == "of 300 m"
    assert found["axial stiffness EA"]["value"] is None and found["axial stiffness EA"]["note"] == "rigid"
    assert "breaking load" not in found


def test_a_line_clear_of_the_bed_pulls_its_anchor_up(asked):
    """V_B − V_A = w L, X = a [arsinh(V_B/H) − arsinh(V_A/H)] and h = a [√(1 + V_B²/H²) − √(1 + V_A²/H²)]"""
    H, V = 900.0, 50.0  # kN, V at the anchor
    w, top = W / 1e3, V + W * L / 1e3
    span = H / w * (math.asinh(top / H) - math.asinh(V / H))
    h = (math.hypot(H, top) - math.hypot(H, V)) / w
    (table,), _ = asked("line", "--weight", W, "--length", L, "--depth", repr(h), "--span", repr(span))
    found = {name: row["value"] for name, row in rows(table).items()}
    assert rows(table)["span"]["note"] == "clear of the bed"
    assert found["vertical force at the anchor"] == pytest.approx(V, rel=1e-5)
    assert found["horizontal force at the anchor"] == pytest.approx(H, rel=1e-6)
    assert found["vertical force at the fairlead"] == pytest.approx(top, rel=1e-5)
    assert found["length on the bed"] == 0.0


@pytest.mark.parametrize("slope", [5.0, -5.0])
def test_a_bed_that_rises_or_falls_to_the_fairlead_is_left_at_its_own_slope(asked, slope):
    """Lift-off with V = H tan β: from there a catenary whose lowest point would lie a tan β before; the anchor holds
    H/cos β less (sin β + μ cos β) w of what lies, for a bed that rises, T along it"""
    beta, H = math.radians(slope), 150.0
    a, t = 1e3 * H / W, math.tan(beta)
    # u = V/H at the top, unknown: height h = (L − s) sin β + a (√(1 + u²) − √(1 + t²)), s = a (u − t)
    low, high = t, 10.0
    for _ in range(200):
        u = 0.5 * (low + high)
        height = (L - a * (u - t)) * math.sin(beta) + a * (math.hypot(1, u) - math.hypot(1, t))
        low, high = (u, high) if height < H_FAIRLEAD else (low, u)
    lies = L - a * (u - t)
    span = lies * math.cos(beta) + a * (math.asinh(u) - math.asinh(t))
    (table,), _ = asked(*WORDS, "--slope-deg", slope, "--friction", MU, "--tension", H)
    found = {name: row["value"] for name, row in rows(table).items()}
    assert found["span"] == pytest.approx(span, rel=1e-6) and found["length on the bed"] == pytest.approx(
        lies, rel=1e-5
    )
    assert found["tension at the fairlead"] == pytest.approx(H * math.hypot(1, u), rel=1e-6)
    held = H / math.cos(beta) - (math.sin(beta) + MU * math.cos(beta)) * W * lies / 1e3
    assert math.hypot(found["horizontal force at the anchor"], found["vertical force at the anchor"]) == pytest.approx(
        held, rel=1e-5
    )


def test_the_characteristic_goes_from_slack_to_taut_by_the_same_closed_form(asked):
    (_, table), _ = asked(*WORDS, "--span", 280, "--characteristic")
    assert table["title"] == "line: from slack to taut; as it hangs the span is 280.000 m"
    taken = table["rows"]
    spans = [float(row["span m"]) for row in taken]
    assert len(taken) > 12 and spans == sorted(spans)
    assert spans[0] == pytest.approx(hanging(1e-6 * W * H_FAIRLEAD)[0], abs=2e-3)
    assert spans[-1] < math.sqrt(L**2 - H_FAIRLEAD**2)
    lying = [row for row in taken if float(row["on the bed m"]) > 0.1 and float(row["horizontal kN"]) > 1]
    assert len(lying) > 5
    for row in lying:
        span, s, T, stiffness = hanging(float(row["horizontal kN"]))
        assert float(row["span m"]) == pytest.approx(span, abs=0.006 / stiffness + 6e-4)
        assert float(row["tension kN"]) == pytest.approx(T, abs=0.011) and row["used %"] == "–"
        assert float(row["on the bed m"]) == pytest.approx(L - s, abs=0.05)


def test_the_characteristic_of_a_type_ends_at_four_fifths_of_its_breaking_load(asked):
    """R3: 0.0223 d² (44 − 0.08 d) N, 4884 kN of 76 mm (IACS W22); shares are of it"""
    breaking = 0.0223 * 76**2 * (44 - 0.08 * 76)
    words = ["line", "--type", "R3 studless 76 mm", "--length", L, "--depth", DEPTH, "--span", 290, "--characteristic"]
    (table, curve), _ = asked(*words)
    found = rows(table)
    assert found["breaking load"]["value"] == pytest.approx(breaking, rel=1e-3)
    T = found["tension at the fairlead"]["value"]
    assert found["used of the breaking load"]["value"] == pytest.approx(100 * T / breaking, rel=1e-3)
    last = curve["rows"][-1]
    assert float(last["horizontal kN"]) == pytest.approx(0.8 * breaking, rel=1e-3)
    for row in curve["rows"]:
        assert float(row["used %"]) == pytest.approx(100 * float(row["tension kN"]) / breaking, abs=0.07)


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_a_line_parts_above_its_breaking_load(asked, share, status):
    """T = √(H² + V²) of H so that T is 0.99 and 1.01 of 4884 kN: almost straight"""
    breaking = 0.0223 * 76**2 * (44 - 0.08 * 76)
    words = ["line", "--type", "R3 studless 76 mm", "--length", L, "--depth", DEPTH, "--tension"]
    (table,), _ = asked(*words, 4700.0)
    over = rows(table)["tension at the fairlead"]["value"] - 4700.0  # w h, or nearly
    (table,), said = asked(*words, share * breaking - over, status=status)
    assert ("of the breaking load" in said and "the line parts" in said) is bool(status)
    if status:
        T = rows(table)["tension at the fairlead"]["value"]
        assert (
            f"FAILS: the tension is {T:.3f} kN, {100 * T / breaking:.4g} % of the breaking load {breaking:.3f} kN"
            in said
        )


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


def test_a_rope_lighter_than_water_lies_in_the_surface(asked):
    """The same catenary upside down: h of it under the surface, from an anchor that it pulls up"""
    H = 2.0
    (table,), _ = asked("line", "--type", "HMPE 100 mm", "--length", L, "--depth", DEPTH, "--tension", H)
    found = {name: row["value"] for name, row in rows(table).items()}
    w = -found["weight in water"]
    span, s, T, stiffness = hanging(H, w, DEPTH)
    assert w > 0 and found["span"] == pytest.approx(span, abs=0.05)  # it stretches a little
    assert found["length that floats"] == pytest.approx(L - s, abs=0.1)
    assert found["vertical force at the anchor"] == pytest.approx(w * s / 1e3, rel=1e-3)
    assert found["tension at the fairlead"] == pytest.approx(H, rel=1e-6)
    assert found["horizontal stiffness"] == pytest.approx(stiffness, rel=0.02) and T > H


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
