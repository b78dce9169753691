"""`hakobune line` against the catenary's closed form: every row, the characteristic, the picture, every limit.

Partly on a flat bed, inextensible: s = √(h(h + 2a)) hangs, x = a arcosh(1 + h/a), a = H/w; X = L − s + x;
T = H + w h at the fairlead, V = w s; at the anchor H − μ w (L − s); dH/dX = w / (arcosh(1 + h/a) − 2/√(1 + 2a/h)).
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.lines import lines_quantities

W, L, DEPTH, Z, MU = 800.0, 300.0, 40.0, 5.0, 0.4  # N/m, m
H_FAIRLEAD = DEPTH + Z
WORDS = ["line", "--weight", W, "--length", L, "--depth", DEPTH, "--fairlead-z", Z]


def hanging(H, w=W, h=H_FAIRLEAD, length=L):
    """Span m, hanging length m, tension kN, stiffness kN/m of a horizontal force, kN"""
    a = 1e3 * H / w
    s, x = math.sqrt(h * (h + 2 * a)), a * math.acosh(1 + h / a)
    stiffness = w / (math.acosh(1 + h / a) - 2 / math.sqrt(1 + 2 * a / h)) / 1e3
    return length - s + x, s, H + w * h / 1e3, stiffness


def values(document):
    """{quantity: value in SI} of a JSON document; axes, as of the characteristic, are among them"""
    parts = (document["quantities"], document["axes"])
    return {name: np.array(one["values"], dtype=object)[()] for part in parts for name, one in part.items()}


@pytest.mark.parametrize("by", ["--span", "--tension"])
def test_every_row_of_a_line_partly_on_the_bed(asked, by):
    H = 150.0
    span, s, T, stiffness = hanging(H)
    (document,), _ = asked(*WORDS, "--friction", MU, by, repr(span) if by == "--span" else H)
    found, units = values(document), {name: one["unit"] for name, one in document["quantities"].items()}
    assert found["state"] == "partly on the bed" and found["axial_stiffness"] is None and found["length"] == L
    for name, value, unit in (
        ("span", span, "m"),
        ("fairlead.horizontal", 1e3 * H, "N"),
        ("fairlead.vertical", W * s, "N"),
        ("fairlead.tension", 1e3 * T, "N"),
        ("anchor.horizontal", 1e3 * H - MU * W * (L - s), "N"),
        ("anchor.vertical", 0.0, "N"),
        ("grounded", L - s, "m"),
        ("stiffness", 1e3 * stiffness, "N/m"),
        ("weight", W, "N/m"),
    ):
        assert found[name] == pytest.approx(value, rel=1e-6, abs=1e-3) and units[name] == unit, name


def test_a_line_clear_of_the_bed_pulls_its_anchor_up(asked):
    """V_B − V_A = w L, X = a [arsinh(V_B/H) − arsinh(V_A/H)] and h = a [√(1 + V_B²/H²) − √(1 + V_A²/H²)]"""
    H, V = 900.0, 50.0  # kN, V at the anchor
    w, top = W / 1e3, V + W * L / 1e3
    span = H / w * (math.asinh(top / H) - math.asinh(V / H))
    h = (math.hypot(H, top) - math.hypot(H, V)) / w
    (document,), _ = asked("line", "--weight", W, "--length", L, "--depth", repr(h), "--span", repr(span))
    found = values(document)
    assert found["state"] == "clear of the bed" and found["grounded"] == 0.0
    assert found["anchor.vertical"] == pytest.approx(1e3 * V, rel=1e-5)
    assert found["anchor.horizontal"] == pytest.approx(1e3 * H, rel=1e-6)
    assert found["fairlead.vertical"] == pytest.approx(1e3 * top, rel=1e-5)


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
    (document,), _ = asked(*WORDS, "--slope-deg", slope, "--friction", MU, "--tension", H)
    found = values(document)
    assert found["span"] == pytest.approx(span, rel=1e-6) and found["grounded"] == pytest.approx(lies, rel=1e-5)
    assert found["fairlead.tension"] == pytest.approx(1e3 * H * math.hypot(1, u), rel=1e-6)
    held = 1e3 * H / math.cos(beta) - (math.sin(beta) + MU * math.cos(beta)) * W * lies
    assert math.hypot(found["anchor.horizontal"], found["anchor.vertical"]) == pytest.approx(held, rel=1e-5)


def test_the_characteristic_goes_from_slack_to_taut_by_the_same_closed_form(asked):
    (document,), _ = asked(*WORDS, "--span", 280, "--characteristic")
    found = values(document)
    spans, pulls, on_bed = (found[name].astype(float) for name in ("at_span", "curve.horizontal", "curve.grounded"))
    assert len(spans) > 12 and np.all(np.diff(spans) > 0)
    assert spans[0] == pytest.approx(hanging(1e-6 * W * H_FAIRLEAD)[0], abs=2e-3)
    assert spans[-1] < math.sqrt(L**2 - H_FAIRLEAD**2)
    lying = np.flatnonzero((on_bed > 0.1) & (pulls > 1e3))
    assert len(lying) > 5 and set(found["curve.used"]) == {None}
    for i in lying:
        span, s, T, _ = hanging(pulls[i] / 1e3)
        assert spans[i] == pytest.approx(span, rel=1e-6) and on_bed[i] == pytest.approx(L - s, abs=1e-3)
        assert found["curve.tension"][i] == pytest.approx(1e3 * T, rel=1e-6)


def test_the_characteristic_of_a_type_ends_at_four_fifths_of_its_breaking_load(asked):
    """R3: 0.0223 d² (44 − 0.08 d) N, 4884 kN of 76 mm (IACS W22); shares are of it"""
    breaking = 0.0223 * 76**2 * (44 - 0.08 * 76)
    words = ["line", "--type", "R3 studless 76 mm", "--length", L, "--depth", DEPTH, "--span", 290, "--characteristic"]
    (document,), _ = asked(*words)
    found = values(document)
    assert found["breaking_load"] == pytest.approx(1e3 * breaking, rel=1e-3)
    assert found["used"] == pytest.approx(found["fairlead.tension"] / found["breaking_load"], rel=1e-9)
    assert found["curve.horizontal"][-1] == pytest.approx(800 * breaking, rel=1e-3)
    shares = found["curve.tension"].astype(float) / found["breaking_load"]
    assert found["curve.used"].astype(float) == pytest.approx(shares, rel=1e-9)


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_a_line_parts_above_its_breaking_load(asked, share, status):
    """T = √(H² + V²) of H so that T is 0.99 and 1.01 of 4884 kN: almost straight"""
    breaking = 0.0223 * 76**2 * (44 - 0.08 * 76)
    words = ["line", "--type", "R3 studless 76 mm", "--length", L, "--depth", DEPTH, "--tension"]
    (document,), _ = asked(*words, 4700.0)
    over = values(document)["fairlead.tension"] / 1e3 - 4700.0  # w h, or nearly
    (document,), _ = asked(*words, share * breaking - over, status=status)
    failed = [one["text"] for one in document["findings"] if one["fails"]]
    assert bool(failed) is bool(status) and all(
        "of the breaking load" in one and "the line parts" in one for one in failed
    )


@pytest.mark.parametrize("strain, status", [(0.495, 0), (0.505, 1)])
def test_a_rope_that_is_half_as_long_again_parts(asked, strain, status):
    """T/EA: of a light line that stands straight up, EA ε all along"""
    words = ["line", "--weight", 1.0, "--stiffness", 100.0, "--length", 40, "--depth", repr(40 * (1 + strain))]
    _, said = asked(*words, "--span", 0, status=status)
    told = f"FAILS: the line is stretched by {100 * strain:.3g}" in said and "limit 50 %, where any rope parts" in said
    assert told is bool(status)


def test_the_picture_of_a_line_has_its_profile_and_its_curves(tmp_path, asked, pictures):
    H = 150.0
    span, s, T, _ = hanging(H)
    asked(*WORDS, "--tension", H, "--plot", tmp_path / "line.png")
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
    (document,), _ = asked("line", "--type", "HMPE 100 mm", "--length", L, "--depth", DEPTH, "--tension", H)
    found = values(document)
    w = -found["weight"]
    span, s, T, stiffness = hanging(H, w, DEPTH)
    assert w > 0 and found["span"] == pytest.approx(span, abs=0.05)  # it stretches a little
    assert found["grounded" if "grounded" in found else "floating"] == pytest.approx(L - s, abs=0.1)
    assert found["anchor.vertical"] == pytest.approx(w * s, rel=1e-3)
    assert found["fairlead.tension"] == pytest.approx(1e3 * H, rel=1e-6)
    assert found["stiffness"] == pytest.approx(1e3 * stiffness, rel=0.02) and T > H


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


def test_the_loss_of_each_line_has_the_tensions_of_those_that_are_left(monkeypatch):
    """Of three lines the second cannot be lost; the body moves from (1, 2, 0) to (4, 6, 0)"""
    monkeypatch.setattr("hakobune.mooring.studies.system_at_rest.body_number", lambda system, name: 1)

    def state(names, tension, used, place):
        lines = SimpleNamespace(utilisation=np.array(used))
        return SimpleNamespace(system=SimpleNamespace(line_names=names), tension=np.array(tension), lines=lines,
                               position=np.array([[9.0] * 6, place]))  # fmt: skip

    rest = state(["a", "b", "c"], [1.0, 2.0, 3.0], [0.1] * 3, [1.0, 2.0, 0, 0, 0, 0])
    losses = {"a": state(["b", "c"], [5.0, 4.0], [0.5, np.nan], [4.0, 6.0, 0, 9, 9, 9]), "b": ValueError("none"),
              "c": state(["a", "b"], [7.0, 8.0], [0.7, 0.8], [1.0, 2.0, 0, 0, 0, 0])}  # fmt: skip
    made = {name: one.values for name, one in lines_quantities.lost(rest, losses, "ship").items()}
    nan = np.nan
    assert made["loss.line_tension"] == pytest.approx(np.array([[nan, 5, 4], [nan] * 3, [7, 8, nan]]), nan_ok=True)
    assert made["loss.tension"] == pytest.approx([5, nan, 8], nan_ok=True)
    assert made["loss.worst"].tolist() == ["b", "", "b"]
    assert made["loss.used"] == pytest.approx([0.5, nan, 0.8], nan_ok=True)
    assert made["loss.shift"] == pytest.approx([5.0, nan, 0.0], nan_ok=True)
    assert np.isnan(lines_quantities.lost(rest, losses, None)["loss.shift"].values).all()
