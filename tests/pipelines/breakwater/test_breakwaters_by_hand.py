"""`hakobune breakwater`: the sea behind, tensions, anchors, limits and pictures, from its amplitudes by hand.

Amplitudes per metre of wave, K and P, are read from the result of a run whose periods are the cells of the sea; what is
made of them follows Kihara, Kitatani & Todoroki (1975), chapter 6.
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import hakobune
from hakobune.mooring.studies.breakwater import pareto
from hakobune.pipelines.cli import main

RHO, G, BEAM, DRAFT, DEPTH, ANGLE = 1025.0, 9.80665, 10.0, 5.0, 10.0, math.radians(60)
FREE = 3.4  # m, draft without lines
STUDY = f"""
name = "wall"
holdings = ["fixed", "taut"]
[water]
depth = {DEPTH}
[section]
shape = "rectangle"
beam = {BEAM}
height = 6.7
draft = {DRAFT}
[body]
free_draft = {FREE}
center_of_gravity = 3.4
gyration = 4.4
[lines]
angle_deg = 60.0
attachment = 5.0
spacing = 4.0
[waves]
height = 0.5
periods = [6.0, 8.0, 10.0]
"""
SEA = '[sea]\nspectrum = "mitsuyasu_bretschneider"\nheight = 1.0\nsignificant_period = 7.0\nduration_hours = 2.0\n'
PULL = RHO * G * BEAM * (DRAFT - FREE) / (2 * math.sin(ANGLE))  # N/m, of a line in still water


def written(folder, *changes, more=""):
    text = STUDY
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "study.toml"
    path.write_text(text + more)
    return path


def found_of(folder, *changes, more=""):
    return hakobune.breakwater(written(folder, *changes, more=more))


def pulls(found):
    """N/m² (periods, 2), amplitudes of tension of the taut body over that of the waves, front and back"""
    taut = list(found.labels["held"].values).index("taut")
    return np.stack([found[f"{end}.tension"][:, taut] for end in ("front", "back")], axis=1)


@pytest.fixture(scope="module")
def sea(tmp_path_factory):
    """A run in a sea, and amplitudes of a run whose periods are the cells of that sea"""
    folder = tmp_path_factory.mktemp("sea")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hakobune.mooring.studies.breakwater.in_sea.SEA_CELLS", 24)
        found = found_of(folder, more=SEA)
    periods = ", ".join(f"{float(2 * math.pi / w)!r}" for w in found.labels["omega"].values)
    cells = ("periods = [6.0, 8.0, 10.0]", f"periods = [{periods}]"), ("height = 0.5", "height = 0.1")
    return found, found_of(folder, *cells)


def test_the_sea_behind_is_the_spectrum_times_the_square_of_what_passes(sea):
    """4√(Σ K² S Δω), in numbers and as a share; S the modified Bretschneider-Mitsuyasu spectrum,
    0.257 H² T⁻⁴ f⁻⁵ exp(−1.03 (T f)⁻⁴), whose T02 is 0.74 T₁/₃ (Goda 2010, sections 2.3 and 2.4)"""
    found, cells = sea
    omega, S = found.labels["omega"].values, found["sea.spectrum"]
    f = omega / (2 * math.pi)
    by_hand = 0.257 * 1.0**2 * 7.0**-4 * f**-5 * np.exp(-1.03 * (7.0 * f) ** -4) / (2 * math.pi)
    inside = slice(2, -3)  # cells at both ends are wide
    assert S[inside] == pytest.approx(by_hand[inside], rel=0.03)
    assert found["sea.height"] == pytest.approx(1.0, rel=2e-3)
    m0 = 0.9992 / 16  # of which the cells are equal parts
    assert list(found.labels["behind"].values) == list(cells.labels["holding"].values) == ["fixed", "taut"]
    rises = np.argsort(2 * math.pi / cells.labels["period"].values)
    K = cells["transmission"][rises]
    assert found["sea.spectrum_behind"] == pytest.approx(K**2 * S[:, None], rel=1e-6)
    heights = 4 * np.sqrt(np.mean(K**2, axis=0) * m0)
    assert found["sea.behind"] == pytest.approx(heights, rel=1e-3)
    assert found["sea.share"] == pytest.approx(found["sea.behind"] / found["sea.height"], rel=1e-9)
    sigma = np.sqrt(np.mean(pulls(cells)[rises] ** 2, axis=0) * m0)
    assert found["sea.deviation"] == pytest.approx(sigma, rel=1e-3)
    sigma, greatest = found["sea.deviation"], found["sea.amplitude"]
    count = 2 * 3600 / (0.74 * 7.0)
    assert found["sea.waves"] == pytest.approx(count, rel=0.01)
    assert greatest == pytest.approx(sigma * math.sqrt(2 * math.log(count)), rel=5e-3)
    assert found["sea.tension"] == pytest.approx(PULL + greatest, rel=1e-6)
    assert found["sea.least_pretension"] == pytest.approx(greatest.max(), rel=1e-6)
    assert found["sea.slack"] == pytest.approx(np.exp(-0.5 * (PULL / sigma) ** 2), rel=1e-4)
    assert found.status == 1
    assert any(
        line.startswith(f"the pretension of {PULL / 1e3:.4g} kN/m is less than the {greatest.max() / 1e3:.4g} kN/m")
        for line in found.fails
    )


def test_the_greatest_tension_is_the_pretension_and_what_waves_add(tmp_path):
    """P₀ = ρg B (d − d₀)/2 sin α; at least the greatest amplitude; with P₀ the greatest is P₀ + amplitude; at most
    what the amplitude leaves of the allowable tension per metre"""
    found = found_of(tmp_path, ("spacing = 4.0", "spacing = 4.0\nallowable_kN = 1000.0"))
    worst = 0.25 * pulls(found).max(axis=0)
    assert found["pretension.used"] == pytest.approx(PULL)
    assert found["pretension.least"] == pytest.approx(worst.max())
    assert found["pretension.most"] == pytest.approx(1e6 / 4.0 - worst.max())
    assert found["pretension.greatest"] == pytest.approx(PULL + worst)
    assert found.status == 0
    title = "pretension P₀ of taut, potential flow"
    assert all(found.quantity(f"pretension.{name}").table == title for name in ("least", "used", "most"))


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_lines_go_slack_where_waves_take_more_than_the_pretension(tmp_path, share, status):
    """The amplitude of the worse line per metre of wave, times half the height, against P₀"""
    height = float(2 * PULL / pulls(found_of(tmp_path)).max() * share)
    found = found_of(tmp_path, ("height = 0.5", f"height = {height!r}"))
    assert found.status == status == len(found.fails)
    told = f"lines snap when they become taut again; give a pretension above {PULL / 1e3:.4g}"
    assert not status or told in found.fails[0]


@pytest.mark.parametrize("share, status", [(1.01, 0), (0.99, 1)])
def test_a_pretension_is_allowed_up_to_what_waves_leave_of_the_allowable_tension(tmp_path, share, status):
    """P₀ + amplitude ≤ allowable/spacing"""
    greatest = max(found_of(tmp_path)["pretension.greatest"])
    allowable = float(4.0 * greatest * share / 1e3)
    found = found_of(tmp_path, ("spacing = 4.0", f"spacing = 4.0\nallowable_kN = {allowable!r}"))
    most = 1e3 * allowable / 4.0 - (greatest - PULL)
    assert found["pretension.most"] == pytest.approx(most)
    assert found.status == status == len(found.fails)
    told = (
        f"the pretension of {PULL / 1e3:.4g} kN/m exceeds {most / 1e3:.4g} kN/m, the most that the allowable tension "
        f"permits;"
    )
    assert not status or told in found.fails[0]


def test_no_pretension_is_allowed_where_waves_alone_exceed_the_lines(tmp_path):
    found = found_of(tmp_path, ("spacing = 4.0", "spacing = 4.0\nallowable_kN = 10.0"))
    least, most = (found[f"pretension.{name}"] for name in ("least", "most"))
    assert most == pytest.approx(10e3 / 4.0 - least) and most < 0
    told = f"keeps lines taut, {least / 1e3:.4g} kN/m, exceeds the largest allowed, {most / 1e3:.4g} kN/m"
    assert found.status == 1 and any(told in line for line in found.fails)


def test_piles_blocks_and_anchors_hold_the_greatest_tension(tmp_path):
    """Piles Q_a = πD L c/F, spaced Q_a/(P sin α); a block that slides W = P cos α/μ, W/(width · unit weight) high;
    anchors Q/F every so many metres; a block under both: |P_H|/μ + P_U at their worst, and the buoyancy 2 P₀ sin α"""
    more = "[anchors]\n"
    more += "pile = { diameter = 0.8, length = 12.0, cohesion_kPa = 40.0, safety = 2.5, spacing = 9.0 }\n"
    more += "sinker = { friction = 0.3, width = 40.0, unit_weight_kN_per_m3 = 13.0, weight_kN_per_m = 900.0 }\n"
    more += "holding = { capacity_kN = 4000.0, spacing = 6.0, safety = 1.6 }\n"
    more += "common_sinker = { friction = 0.4, width = 40.0, unit_weight_kN_per_m3 = 13.0, weight_kN_per_m = 500.0 }\n"
    found = found_of(tmp_path, ("angle_deg = 60.0", "angle_deg = 40.0"), more=more)
    alpha = math.radians(40)
    used = found["pretension.used"]
    assert used == pytest.approx(RHO * G * BEAM * (DRAFT - FREE) / (2 * math.sin(alpha)))
    holds = math.pi * 0.8 * 12 * 40e3 / 2.5

    def row(name):
        return [found[f"anchor[{name}].{column}"] for column in ("needed", "provided", "used")]

    for end, P in zip(("front", "back"), found["pretension.greatest"], strict=True):
        spacing = holds / (P * math.sin(alpha))
        assert row(f"piles, {end}") == pytest.approx([spacing, 9.0, 9 / spacing])
        assert found[f"anchor[piles, {end}].size"] == f"each holds {holds / 1e3:.4g} kN"
        weight = P * math.cos(alpha) / 0.3
        assert row(f"sinker, {end}") == pytest.approx([weight, 900e3, weight / 900e3])
        assert found[f"anchor[sinker, {end}].size"] == f"{weight / 40 / 13e3:.3g} m high, 40 m wide"
        assert row(f"anchor, {end}") == pytest.approx([6 * P, 4e6 / 1.6, 6 * P * 1.6 / 4e6])
        assert found[f"anchor[anchor, {end}].size"] == "every 6 m"
    taut = list(found.labels["held"].values).index("taut")
    front, back = (0.25 * found[f"{end}.tension.complex"][:, taut] for end in ("front", "back"))
    phases = np.exp(1j * np.linspace(0, 2 * np.pi, 721))[:, None]
    across = abs(np.real((front - back) * phases)) * math.cos(alpha) / 0.4
    up = np.real((front + back) * phases) * math.sin(alpha)
    common = (across + up).max() + 2 * used * math.sin(alpha)
    assert row("sinker of both lines") == pytest.approx([common, 500e3, common / 500e3], rel=1e-4)
    assert found["anchor[sinker of both lines].size"].endswith(", which also hold the body's buoyancy")


@pytest.mark.parametrize("share, status", [(1.01, 0), (0.99, 1)])
def test_an_anchor_fails_above_what_is_provided(tmp_path, share, status):
    P = max(found_of(tmp_path)["pretension.greatest"])
    capacity = float(2.0 * 6.0 * P * share / 1e3)  # of the safety 2 that is the default
    found = found_of(tmp_path, more=f"[anchors]\nholding = {{ capacity_kN = {capacity!r}, spacing = 6.0 }}\n")
    assert max(found["anchor.used"]) == pytest.approx(1 / share)
    assert found.status == status
    told = f"kN are needed and {capacity / 2:.4g} are provided, 101 % used; give a larger one"
    assert any(told in line for line in found.fails) is bool(status)


@pytest.mark.parametrize("width, told", [(1.02, False), (0.98, True)])
def test_a_block_higher_than_half_of_the_water_under_the_keel_is_warned_of(tmp_path, width, told):
    """2.5 m of 5; the width that is asked for makes it as high"""
    weight = max(found_of(tmp_path)["pretension.greatest"]) * (math.cos(ANGLE) / 0.5 + math.sin(ANGLE))
    enough = float(weight / 13e3 / 2.5)
    block = f"friction = 0.5, width = {width * enough!r}, unit_weight_kN_per_m3 = 13.0, lifted = true"
    found = found_of(tmp_path, more=f"[anchors]\nsinker = {{ {block} }}\n")
    assert found.status == 0
    words = f"5 m under the keel; allowed: up to 2.5 m; give a width of {enough:.3g} m"
    assert any(words in line for line in found.findings) is told


def test_a_picture_has_transmission_tensions_sea_and_section_of_its_result(tmp_path, asked, pictures):
    """K_T, tension amplitudes in kN/m per metre, spectra, and the section between its lines"""
    path = written(tmp_path, ("[6.0, 8.0, 10.0]", "{ from = 6.0, to = 10.0, count = 15 }"), more=SEA)
    asked("breakwater", path, "--output", tmp_path / "o.h5", "--plot", tmp_path / "p.png", status=1)
    found = hakobune.read(tmp_path / "o.h5")
    period, (front_kept, back_kept) = found.labels["period"].values, pulls(found).T / 1e3
    assert period == pytest.approx(np.linspace(6, 10, 15))
    assert found["transmission.complex"].shape == (15, 2)
    fixed = [found[name][:, 0] for name in ("transmission", "reflection")]
    assert np.hypot(*fixed) == pytest.approx(np.ones(15), abs=1e-6)
    passed, tensions, waves, section = pictures[0].axes
    drawn = {line.get_label(): line for line in passed.lines}
    for i, name in enumerate(("fixed", "taut")):
        x, y = drawn[name].get_data()
        assert x == pytest.approx(period) and y == pytest.approx(found["transmission"][:, i], abs=1e-9)
    assert passed.get_title("left") == "transmission"
    front, back = [line.get_ydata() for line in tensions.lines if len(line.get_xdata()) == 15][-2:]
    assert front == pytest.approx(front_kept) and back == pytest.approx(back_kept)
    assert tensions.get_ylabel() == "kN/m per m of amplitude"
    before, *behind = (line.get_ydata() for line in waves.lines)
    assert len(behind) == 2 and all(np.all(part <= before + 1e-12) for part in behind)
    # the section: from the keel 5 m under water, 6.7 m high; lines at 60° from the corners to the bed
    corners = section.patches[0].get_xy()
    assert corners[:, 0].min() == -5 and corners[:, 0].max() == 5
    assert corners[:, 1].min() == pytest.approx(-5) and corners[:, 1].max() == pytest.approx(1.7)
    right, left = (line.get_xydata() for line in section.lines[:2])
    foot = 5 + 5 / math.tan(ANGLE)
    assert right == pytest.approx(np.array([[5, -5], [foot, -10]])) and left == pytest.approx(right * [-1, 1])


def test_the_mass_of_a_body_comes_from_its_weight_its_free_draft_or_its_pretension(tmp_path):
    """ρ B d₀ = 34.85 t/m floats at 3.4 m: all three hold with the same pretension"""
    mass = RHO * BEAM * FREE / 1e3
    ways = (("free_draft = 3.4", f"mass_t_per_m = {mass!r}"), None,
            ("spacing = 4.0", f"spacing = 4.0\npretension_kN_per_m = {PULL / 1e3!r}"))  # fmt: skip
    before = None
    for i, way in enumerate(ways):
        changes = [way] if way else []
        changes += [("free_draft = 3.4\n", "")] if i == 2 else []
        found = found_of(tmp_path, *changes)
        assert found["pretension.used"] == pytest.approx(PULL)
        parts = np.stack([found[name] for name in ("transmission", "sway", "heave", "roll")])
        assert not i or parts == pytest.approx(before, rel=1e-9, nan_ok=True)
        before = parts


def test_a_circle_displaces_its_segment(tmp_path):
    """Of 10 m, 6 m deep on its lines, 5 m free: ρg ΔA/2 sin α, A(d) = r² (θ − sin θ cos θ), cos θ = 1 − d/r"""
    circle = (
        'shape = "rectangle"\nbeam = 10.0\nheight = 6.7\ndraft = 5.0',
        'shape = "circle"\ndiameter = 10.0\ndraft = 6.0',
    )
    changes = [("free_draft = 3.4", "free_draft = 5.0"), ("attachment = 5.0", "attachment = 0.1"),
               ('["fixed", "taut"]', '["taut"]'), ("[6.0, 8.0, 10.0]", "[8.0]"),
               ("depth = 10.0", "depth = 10.0\ntide = 0.4")]  # fmt: skip
    found = found_of(tmp_path, circle, *changes)

    def area(d):
        theta = math.acos(1 - d / 5.0)
        return 25.0 * (theta - math.sin(theta) * math.cos(theta))

    unit = RHO * G / (2 * math.sin(ANGLE))
    assert found["pretension.used"] == pytest.approx(unit * (area(6) - area(5)), rel=1e-6)
    for name, rise in (("low", -0.4), ("mean", 0.0), ("high", 0.4)):
        assert found[f"tide[{name}].rise"] == rise
        change = unit * (area(6 + rise) - area(6))
        assert found[f"tide[{name}].change"] == pytest.approx(change, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("height, told", [(0.99, False), (1.01, True)])
def test_waves_break_above_the_limit_of_miche(tmp_path, asked, height, told):
    """0.142 λ tanh kh, here of 3 s: ω² = gk tanh kh"""
    w = 2 * math.pi / 3.0
    k = w * w / G
    for _ in range(200):
        k = w * w / (G * math.tanh(k * DEPTH))
    limit = 0.142 * 2 * math.pi / k * math.tanh(k * DEPTH)
    path = written(tmp_path, ("[6.0, 8.0, 10.0]", "[3.0, 8.0]"), ("height = 0.5", f"height = {limit * height!r}"))
    _, said = asked("breakwater", path, status=None)
    assert (
        f"m break at 1 of 2 periods, up to 3 s, where the highest possible wave is {limit:.3g} m (Miche)" in said
    ) is told


LIMITS = [
    (("height = 0.5", "height = 0.0"), "waves.height is 0; allowed: above 0"),
    (("[6.0, 8.0, 10.0]", "[0.04]"), "waves.periods has 0.04 s; allowed: 0.05 to 1000"),
    (("[6.0, 8.0, 10.0]", "[1001.0]"), "waves.periods has 1001 s; allowed: 0.05 to 1000"),
    (("[6.0, 8.0, 10.0]", "{ from = 4, to = 5, count = 1001 }"), "waves.periods has 1001 numbers; allowed: 2 to 1000"),
    (("[6.0, 8.0, 10.0]", "{ from = 4, to = 5, count = 1 }"), "waves.periods has 1 numbers; allowed: 2 to 1000"),
    (("depth = 10.0", "depth = 10.0\ntide = 10.0"), "water.tide is 10 m; allowed: 0 to below the depth of 10 m"),
    (("depth = 10.0", "depth = 10.0\ntide = -0.1"), "water.tide is -0.1 m"),
    (("depth = 10.0", "depth = 10.0\ndensity = 0"), "water.density is 0"),
    (("angle_deg = 60.0", "angle_deg = 0.0"), "lines.angle_deg is 0; allowed: above 0 and below 180"),
    (("angle_deg = 60.0", "angle_deg = 180.0"), "lines.angle_deg is 180; allowed: above 0 and below 180"),
    (("spacing = 4.0", "spacing = 0.0"), "lines.spacing is 0"),
    (("spacing = 4.0", "attachment_height = -1.0"), "lines.attachment_height is -1; allowed: 0 or more"),
    (("beam = 10.0\n", ""), "section.beam is missing; the shape rectangle needs beam and height"),
    (
        ("beam = 10.0", "beam = 10.0\ndiameter = 3.0"),
        "section.diameter is given; the shape rectangle has beam and height",
    ),
    (('["fixed", "taut"]', '["fixed", "fixed"]'), "holdings has 'fixed'; allowed: each of fixed"),
    (('["fixed", "taut"]', '["moored"]'), "holdings has 'moored'; allowed: each of fixed"),
    (("[waves]", '[design]\nholding = "free"\n[waves]'), "design.holding is 'free'; allowed: fixed, taut"),
    (("[waves]", "[loss]\ncoefficient = 10001\n[waves]"), "loss.coefficient is 10001; allowed: 0 to 10000"),
    (("gyration = 4.4", "gyration = 0"), "body.gyration is 0"),
    (("free_draft = 3.4", "free_draft = 3.4\nmass_t_per_m = 30.0"), "body.mass_t_per_m and body.free_draft are given"),
    (
        ("[waves]", "[optimisation]\nsamples = 5\ndraft = [4, 5]\n[waves]"),
        "samples is 5; allowed: a power of two from 4",
    ),
    (
        ("[waves]", "[optimisation]\nsamples = 8192\ndraft = [4, 5]\n[waves]"),
        "samples is 8192; allowed: a power of two",
    ),
    (("[waves]", "[optimisation]\nlimits = 101\ndraft = [4, 5]\n[waves]"), "limits is 101; allowed: 1 to 100"),
    (("[waves]", "[optimisation]\nlimits = 0\ndraft = [4, 5]\n[waves]"), "limits is 0; allowed: 1 to 100"),
    (("[waves]", "[optimisation]\n[waves]"), "optimisation has no range; give draft, width or angle_deg as"),
    (("[waves]", "[optimisation]\ndraft = [5, 5]\n[waves]"), "optimisation.draft is from 5 to 5"),
    (("[waves]", "[map]\nperiod = 7\nunits = 31\ngap = 5\n[waves]"), "map.units has 31 numbers; allowed: 1 to 30"),
    (("[waves]", "[map]\nperiod = 7\npoints = 402\n[waves]"), "map.points has 402 numbers; allowed: 2 to 401"),
    (("[waves]", "[map]\nperiod = 7\npoints = 1\n[waves]"), "map.points has 1 numbers; allowed: 2 to 401"),
    (("[waves]", "[map]\nperiod = 7\nunits = 2\n[waves]"), "map.gap is 0 m; allowed: above 0 between units"),
    (("[waves]", "[map]\nperiod = 7\nx = [5, 4]\n[waves]"), "map.x is from 5 to 4 m; allowed: rising"),
    (("[waves]", "[map]\nperiod = 0\n[waves]"), "map.period is 0"),
]


@pytest.mark.parametrize("change, says", LIMITS, ids=lambda value: value[1][-30:] if isinstance(value, tuple) else "")
def test_what_lies_beyond_a_limit_is_refused(tmp_path, capsys, change, says):
    assert main(["breakwater", str(written(tmp_path, change))]) == 2
    said = capsys.readouterr().err
    assert says in said and said.count("\n") == 1


@pytest.mark.parametrize("change", [
    ("[6.0, 8.0, 10.0]", "[8.0, 1000.0]"), ("depth = 10.0", "depth = 10.0\ntide = 0.0"),
    ("[waves]", "[loss]\ncoefficient = 0\n[waves]"), ("angle_deg = 60.0", "angle_deg = 1.0"),
    ("[6.0, 8.0, 10.0]", "{ from = 8, to = 9, count = 2 }"),
])  # fmt: skip
def test_what_lies_within_a_limit_is_run(tmp_path, change):
    assert main(["breakwater", str(written(tmp_path, change))]) in (0, 1)


def test_best_designs_beside_a_resonance_are_told_with_what_passes_at_the_periods_beside_it(monkeypatch):
    """K_T = 1/√(1 + ((T − T₀)/0.3)²): 1 at 6 s and 1/√2 at 5.7 and 6.3 s where T₀ is 6 s; flat where it is 60 s"""

    def changed(draft):
        return SimpleNamespace(
            draft=draft, design=("taut", "exact"), waves=SimpleNamespace(period=np.array([4.0, 6.0]))
        )

    def passed(made, holding, theory, rise, omega):
        T = 2 * np.pi / omega
        return SimpleNamespace(transmission=1 / np.sqrt(1 + ((T - made.draft) / 0.3) ** 2))

    monkeypatch.setattr(pareto, "response", passed)
    front = pareto.Front(("draft",), np.array([[60.0], [6.0]]), np.ones(2), np.ones(2), 2)
    (told,) = pareto.beside_resonances(changed, front)
    assert told.startswith("1 of the 2 best designs are near a resonance, most of all design 2: its")
    assert "K_T is 0.71 at 5.7 s, 1.00 at 6 s, 0.71 at 6.3 s" in told
    assert list(pareto.beside_resonances(changed, front._replace(designs=front.designs[:1]))) == []


def test_each_amplitude_has_its_unit_its_words_and_the_table_it_stands_in(tmp_path):
    """K_T in a table of its own; as a modulus in tables, as a complex number in files alone"""
    found = found_of(tmp_path)
    told = {
        "transmission": ("", "K_T", "transmission"), "reflection": ("", "reflection", ""), "sway": ("m/m", "sway", ""),
        "heave": ("m/m", "heave", ""), "roll": ("rad/m", "roll", ""),
        "front.tension": ("N/m2", "front", "tension amplitudes per metre of wave amplitude"),
        "back.tension": ("N/m2", "back", "tension amplitudes per metre of wave amplitude"),
    }  # fmt: skip
    for name, (unit, words, table) in told.items():
        one, whole = found.quantity(name), found.quantity(f"{name}.complex")
        assert (one.unit, one.description, one.table, one.record) == (unit, words, table, False), name
        assert (whole.unit, whole.description, whole.record) == (unit, f"{words}, complex", True), name
        assert one.axes == whole.axes == ("period", "held" if "." in name else "holding")
        assert one.values == pytest.approx(abs(whole.values)) and whole.values.dtype == complex


def test_a_transmission_that_jumps_between_periods_is_told_with_both():
    """0.1, 0.2, 0.9: 0.7 between 5 and 6 s; a quarter and less is not told"""
    from types import SimpleNamespace

    from hakobune.pipelines.breakwater.findings import JUMP, jumps

    def told(*K):
        curve = SimpleNamespace(name="free", response=SimpleNamespace(transmission=np.array(K, complex) * 1j))
        waves = SimpleNamespace(period=np.array([4.0, 5.0, 6.0])[: len(K)])
        return list(jumps(SimpleNamespace(waves=waves), SimpleNamespace(curves=[curve])))

    (line,) = told(0.1, 0.2, 0.9)
    assert line.startswith("free: K_T goes from 0.2 at 5 s to 0.9 at 6 s") and "between 5 and 6 s" in line
    assert told(0.1, 0.1 + JUMP, 0.1 + JUMP) == told(0.5) == []
