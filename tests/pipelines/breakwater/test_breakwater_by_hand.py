"""`hakobune breakwater`: the sea behind, tensions, anchors, limits, files and pictures, from its amplitudes by hand.

Amplitudes per metre of wave, K and P, are read from the file of a run whose periods are the cells of the sea; what is
made of them follows Kihara, Kitatani & Todoroki (1975), chapter 6.
"""

import csv
import math
import re

import h5py
import numpy as np
import pytest

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
PULL = RHO * G * BEAM * (DRAFT - FREE) / (2 * math.sin(ANGLE)) / 1e3  # kN/m, of a line in still water


def written(folder, *changes, more=""):
    text = STUDY
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "study.toml"
    path.write_text(text + more)
    return path


def numbers(text):
    return [float(word) for word in re.findall(r"-?\d+\.?\d*(?:e[+-]?\d+)?", text)]


def line_of(said, words):
    return next(line for line in said.splitlines() if words in line)


@pytest.fixture(scope="module")
def sea(tmp_path_factory):
    """File of a run in a sea, what it says, and amplitudes of a run whose periods are the cells of that sea"""
    folder = tmp_path_factory.mktemp("sea")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hakobune.pipelines.breakwater.results.SEA_CELLS", 24)
        assert main(["breakwater", str(written(folder, more=SEA)), "--output", str(folder / "sea.h5")]) == 1
    with h5py.File(folder / "sea.h5") as file:
        omega = file["sea/omega"][()]
    periods = ", ".join(f"{float(2 * math.pi / w)!r}" for w in omega)
    cells = written(folder, ("periods = [6.0, 8.0, 10.0]", f"periods = [{periods}]"), ("height = 0.5", "height = 0.1"))
    assert main(["breakwater", str(cells), "--output", str(folder / "cells.h5")]) in (0, 1)
    return folder


def test_the_sea_behind_is_the_spectrum_times_the_square_of_what_passes(sea, asked, monkeypatch):
    """4√(Σ K² S Δω), in numbers and as a share; S the modified Bretschneider-Mitsuyasu spectrum,
    0.257 H² T⁻⁴ f⁻⁵ exp(−1.03 (T f)⁻⁴), whose T02 is 0.74 T₁/₃ (Goda 2010, sections 2.3 and 2.4)"""
    monkeypatch.setattr("hakobune.pipelines.breakwater.results.SEA_CELLS", 24)
    with h5py.File(sea / "sea.h5") as file, h5py.File(sea / "cells.h5") as cells:
        omega, S = file["sea/omega"][()], file["sea/spectrum"][()]
        f = omega / (2 * math.pi)
        by_hand = 0.257 * 1.0**2 * 7.0**-4 * f**-5 * np.exp(-1.03 * (7.0 * f) ** -4) / (2 * math.pi)
        inside = slice(2, -3)  # cells at both ends are wide
        assert S[inside] == pytest.approx(by_hand[inside], rel=0.03)
        m0 = 0.9992 / 16  # of which the cells are equal parts
        for name in ("fixed", "taut"):
            K = abs(cells[f"{name}/transmission"][()])[::-1]  # periods rise
            assert file[f"sea/behind/{name}"][()] == pytest.approx(K**2 * S, rel=1e-6)
            height = 4 * math.sqrt(np.mean(K**2) * m0)
            assert file[f"sea/behind/{name}"].attrs["height_m"] == pytest.approx(height, rel=1e-3)
        kept = {name: file[f"sea/behind/{name}"].attrs["height_m"] for name in ("fixed", "taut")}
        P = {end: abs(cells[f"taut/{end}"][()])[::-1] for end in ("front", "back")}
        sigma = [math.sqrt(np.mean(P[end] ** 2) * m0) for end in ("front", "back")]
        assert file["sea/tension_deviation"][()] == pytest.approx(sigma, rel=1e-3)
        sigma, greatest = file["sea/tension_deviation"][()], file["sea/tension_greatest"][()]
        count = 2 * 3600 / (0.74 * 7.0)
        assert greatest == pytest.approx(sigma * math.sqrt(2 * math.log(count)), rel=5e-3)
        assert file["sea/largest_tension"][()] == pytest.approx(1e3 * PULL + greatest, rel=1e-6)
        assert file["sea/least_pretension"][()] == pytest.approx(greatest.max(), rel=1e-6)
        share = np.exp(-0.5 * (1e3 * PULL / sigma) ** 2)
        assert file["sea/slack_share"][()] == pytest.approx(share, rel=1e-4)
    _, said = asked("breakwater", written(sea, more=SEA), status=1)
    assert numbers(line_of(said, "sea of H1/3"))[2] == pytest.approx(1.0, rel=2e-3)
    for name, height in kept.items():
        told = line_of(said, f", {name}")
        assert numbers(told) == pytest.approx([height, height], rel=3e-3)
    told = numbers(line_of(said, "greatest tension amplitude of"))
    assert told == pytest.approx([count, *(greatest / 1e3)], rel=0.01)
    worst = line_of(said, "slack in" if share.max() > 1e-6 else "no line goes slack")
    assert numbers(worst)[-1] == pytest.approx(PULL, rel=1e-3)


def test_pretension_and_tensions_are_told_as_they_are_written(tmp_path, asked):
    """P₀ = ρg B (d − d₀)/2 sin α; at least the greatest amplitude; with P₀ the greatest is P₀ + amplitude"""
    path = written(tmp_path, ("spacing = 4.0", "spacing = 4.0\nallowable_kN = 1000.0"))
    _, said = asked("breakwater", path, "--output", tmp_path / "o.h5")
    with h5py.File(tmp_path / "o.h5") as file:
        P = {end: abs(file[f"taut/{end}"][()]) * 0.25 / 1e3 for end in ("front", "back")}
        assert file["pretension"].attrs["slack"] == ""
    worst = {end: values.max() for end, values in P.items()}
    least = max(worst.values())
    told = numbers(line_of(said, "pretension P₀, kN/m").split("kN/m:")[1])
    assert told == pytest.approx([least, 1000.0 / 4.0 - least], rel=1e-3)
    assert "(taut, potential flow)" in said
    told = numbers(line_of(said, "of the body the greatest tensions are"))
    assert told == pytest.approx([PULL, PULL + worst["front"], PULL + worst["back"]], rel=1e-3)


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_lines_go_slack_where_waves_take_more_than_the_pretension(tmp_path, asked, share, status):
    """The amplitude of the worse line per metre of wave, times half the height, against P₀"""
    asked("breakwater", written(tmp_path), "--output", tmp_path / "o.h5")
    with h5py.File(tmp_path / "o.h5") as file:
        P = max(abs(file[f"taut/{end}"][()]).max() for end in ("front", "back")) / 1e3
    height = float(2 * PULL / P * share)
    _, said = asked("breakwater", written(tmp_path, ("height = 0.5", f"height = {height!r}")), status=status)
    assert (f"the linear tensions do not hold there, taut again they snap: give more pretension than {PULL:.4g}"
            in said) is bool(status)  # fmt: skip


@pytest.mark.parametrize("share, status", [(1.01, 0), (0.99, 1)])
def test_a_pretension_is_allowed_up_to_what_waves_leave_of_the_allowable_tension(tmp_path, asked, share, status):
    """P₀ + amplitude ≤ allowable/spacing"""
    asked("breakwater", written(tmp_path), "--output", tmp_path / "o.h5")
    with h5py.File(tmp_path / "o.h5") as file:
        greatest = max(file["pretension/greatest"][()]) / 1e3
    allowable = float(4.0 * greatest * share)
    path = written(tmp_path, ("spacing = 4.0", f"spacing = 4.0\nallowable_kN = {allowable!r}"))
    _, said = asked("breakwater", path, status=status)
    most = allowable / 4.0 - (greatest - PULL)
    words = f"FAILS: the pretension of {PULL:.4g} kN/m is above the {most:.4g} kN/m within the allowable tension"
    assert (words in said) is bool(status)


def test_no_pretension_is_allowed_where_waves_alone_exceed_the_lines(tmp_path, asked):
    path = written(tmp_path, ("spacing = 4.0", "spacing = 4.0\nallowable_kN = 10.0"))
    _, said = asked("breakwater", path, "--output", tmp_path / "o.h5", status=1)
    with h5py.File(tmp_path / "o.h5") as file:
        least, most = (file[f"pretension/{name}"][()] / 1e3 for name in ("least", "most"))
    assert most == pytest.approx(10.0 / 4.0 - least)
    assert f"which waves and tide alone exceed by {-most:.4g}" in said
    assert f"FAILS: no pretension is both enough, {least:.4g} kN/m, and allowed, {most:.4g} kN/m" in said


def test_piles_blocks_and_anchors_hold_the_greatest_tension(tmp_path, asked):
    """Piles Q_a = πD L c/F, spaced Q_a/(P sin α); a block that slides W = P cos α/μ, W/(width · unit weight) high;
    anchors Q/F every so many metres; a block under both: |P_H|/μ + P_U at their worst, and the buoyancy 2 P₀ sin α"""
    more = "[anchors]\n"
    more += "pile = { diameter = 0.8, length = 12.0, cohesion_kPa = 40.0, safety = 2.5, spacing = 9.0 }\n"
    more += "sinker = { friction = 0.3, width = 40.0, unit_weight_kN_per_m3 = 13.0, weight_kN_per_m = 900.0 }\n"
    more += "holding = { capacity_kN = 4000.0, spacing = 6.0, safety = 1.6 }\n"
    more += "common_sinker = { friction = 0.4, width = 40.0, unit_weight_kN_per_m3 = 13.0, weight_kN_per_m = 500.0 }\n"
    path = written(tmp_path, ("angle_deg = 60.0", "angle_deg = 40.0"), more=more)
    tables, _ = asked("breakwater", path, "--output", tmp_path / "o.h5", status=None)
    rows = {row.pop(""): row for row in next(t for t in tables if t["title"] == "anchors")["rows"]}
    alpha = math.radians(40)
    with h5py.File(tmp_path / "o.h5") as file:
        greatest = dict(zip(("front", "back"), file["pretension/greatest"][()] / 1e3, strict=True))
        used = file["pretension/used"][()] / 1e3
        front, back = file["taut/front"][()] * 0.25 / 1e3, file["taut/back"][()] * 0.25 / 1e3
    assert used == pytest.approx(RHO * G * BEAM * (DRAFT - FREE) / (2 * math.sin(alpha)) / 1e3)
    holds = math.pi * 0.8 * 12 * 40 / 2.5
    for end, P in greatest.items():
        spacing = holds / (P * math.sin(alpha))
        assert numbers(rows[f"piles, {end}"]["needed"]) == pytest.approx([spacing], rel=1e-3)
        assert numbers(rows[f"piles, {end}"]["size"]) == pytest.approx([holds], rel=1e-3)
        assert rows[f"piles, {end}"]["provided"] == "9"
        assert numbers(rows[f"piles, {end}"]["used"]) == pytest.approx([100 * 9 / spacing], abs=0.51)
        weight = P * math.cos(alpha) / 0.3
        row = rows[f"sinker, {end}"]
        assert numbers(row["needed"])[0] == pytest.approx(weight, rel=1e-3)
        assert numbers(row["size"]) == pytest.approx([weight / 40 / 13, 40], rel=5e-3)
        assert numbers(row["used"]) == pytest.approx([100 * weight / 900], abs=0.51)
        row = rows[f"anchor, {end}"]
        assert numbers(row["needed"])[0] == pytest.approx(6 * P, rel=1e-3) and row["size"] == "every 6 m"
        assert float(row["provided"]) == pytest.approx(4000 / 1.6)
        assert numbers(row["used"]) == pytest.approx([100 * 6 * P * 1.6 / 4000], abs=0.51)
    phases = np.exp(1j * np.linspace(0, 2 * np.pi, 721))[:, None]
    across = abs(np.real((front - back) * phases)) * math.cos(alpha) / 0.4
    up = np.real((front + back) * phases) * math.sin(alpha)
    common = (across + up).max() + 2 * used * math.sin(alpha)
    row = rows["sinker of both lines"]
    assert numbers(row["needed"])[0] == pytest.approx(common, rel=2e-3)
    assert row["size"].endswith(", the body's buoyancy held too")


@pytest.mark.parametrize("share, status", [(1.01, 0), (0.99, 1)])
def test_an_anchor_fails_above_what_is_provided(tmp_path, asked, share, status):
    asked("breakwater", written(tmp_path), "--output", tmp_path / "o.h5")
    with h5py.File(tmp_path / "o.h5") as file:
        P = max(file["pretension/greatest"][()]) / 1e3
    capacity = float(2.0 * 6.0 * P * share)  # of the safety 2 that is the default
    more = f"[anchors]\nholding = {{ capacity_kN = {capacity!r}, spacing = 6.0 }}\n"
    _, said = asked("breakwater", written(tmp_path, more=more), status=status)
    assert (f"kN are needed, {capacity / 2:.4g} provided, 101 % used; give a larger one" in said) is bool(status)


@pytest.mark.parametrize("width, told", [(1.02, False), (0.98, True)])
def test_a_block_higher_than_half_of_the_water_under_the_keel_is_warned_of(tmp_path, asked, width, told):
    """2.5 m of 5; the width that is asked for makes it as high"""
    asked("breakwater", written(tmp_path), "--output", tmp_path / "o.h5")
    with h5py.File(tmp_path / "o.h5") as file:
        weight = max(file["pretension/greatest"][()]) / 1e3 * (math.cos(ANGLE) / 0.5 + math.sin(ANGLE))
    enough = float(weight / 13.0 / 2.5)
    block = f"friction = 0.5, width = {width * enough!r}, unit_weight_kN_per_m3 = 13.0, lifted = true"
    _, said = asked("breakwater", written(tmp_path, more=f"[anchors]\nsinker = {{ {block} }}\n"))
    assert (f"5 m are under the keel; allowed: up to 2.5 m; give a width of {enough:.3g} m" in said) is told


def test_a_row_of_periods_is_printed_as_it_is_written_and_drawn(tmp_path, asked, pictures):
    """K_T and tension amplitudes in kN/m per metre; twelve of more periods, the first and the last among them"""
    path = written(tmp_path, ("[6.0, 8.0, 10.0]", "{ from = 6.0, to = 10.0, count = 15 }"), more=SEA)
    out = tmp_path / "o.csv"
    tables, _ = asked("breakwater", path, "--output", out, "--plot", tmp_path / "p.png", status=1)
    lines = [line for line in out.read_text().splitlines() if not line.startswith("#")]
    kept = {key: np.array(values, float) for key, values in
            zip(lines[0].split(","), zip(*csv.reader(lines[1:]), strict=True), strict=True)}  # fmt: skip
    assert kept["period_s"] == pytest.approx(np.linspace(6, 10, 15))
    assert kept["transmission fixed"] ** 2 + kept["reflection fixed"] ** 2 == pytest.approx(np.ones(15), abs=1e-6)
    by_period = {f"{T:.4g}": i for i, T in enumerate(kept["period_s"])}
    for table, column, unit in ((tables[0], "transmission taut", 1.0), (tables[1], "front taut", 1e3)):
        rows = table["rows"]
        assert len(rows) == 12 and rows[0]["period, s"] == "6" and rows[-1]["period, s"] == "10"
        for row in rows:
            value = float(row["taut"].split(",")[0])
            assert value == pytest.approx(kept[column][by_period[row["period, s"]]] / unit, rel=1e-3, abs=6e-4)
            if unit > 1:
                back = kept["back taut"][by_period[row["period, s"]]] / 1e3
                assert float(row["taut"].split(",")[1]) == pytest.approx(back, rel=1e-3)
    passed, pulls, waves, section = pictures[0].axes
    drawn = {line.get_label(): line for line in passed.lines}
    for name in ("fixed", "taut"):
        x, y = drawn[name].get_data()
        assert x == pytest.approx(kept["period_s"]) and y == pytest.approx(kept[f"transmission {name}"], abs=1e-6)
    assert passed.get_title("left") == "transmission"
    front, back = [line.get_ydata() for line in pulls.lines if len(line.get_xdata()) == 15][-2:]
    assert front == pytest.approx(kept["front taut"] / 1e3, rel=1e-6) and back == pytest.approx(
        kept["back taut"] / 1e3, rel=1e-6
    )
    assert pulls.get_ylabel() == "kN/m per m of amplitude"
    before, *behind = (line.get_ydata() for line in waves.lines)
    assert len(behind) == 2 and all(np.all(part <= before + 1e-12) for part in behind)
    # the section: from the keel 5 m under water, 6.7 m high; lines at 60° from the corners to the bed
    corners = section.patches[0].get_xy()
    assert corners[:, 0].min() == -5 and corners[:, 0].max() == 5
    assert corners[:, 1].min() == pytest.approx(-5) and corners[:, 1].max() == pytest.approx(1.7)
    right, left = (line.get_xydata() for line in section.lines[:2])
    foot = 5 + 5 / math.tan(ANGLE)
    assert right == pytest.approx(np.array([[5, -5], [foot, -10]])) and left == pytest.approx(right * [-1, 1])


def test_the_mass_of_a_body_comes_from_its_weight_its_free_draft_or_its_pretension(tmp_path, asked):
    """ρ B d₀ = 34.85 t/m floats at 3.4 m: all three hold with the same pretension"""
    mass = RHO * BEAM * FREE / 1e3
    ways = (("free_draft = 3.4", f"mass_t_per_m = {mass!r}"), None,
            ("spacing = 4.0", f"spacing = 4.0\npretension_kN_per_m = {PULL!r}"))  # fmt: skip
    before = None
    for i, way in enumerate(ways):
        changes = [way] if way else []
        changes += [("free_draft = 3.4\n", "")] if i == 2 else []
        asked("breakwater", written(tmp_path, *changes), "--output", tmp_path / f"{i}.h5")
        with h5py.File(tmp_path / f"{i}.h5") as file:
            assert file["pretension/given"][()] / 1e3 == pytest.approx(PULL)
            heave = abs(file["taut/heave"][()])
        assert not i or heave == pytest.approx(before, rel=1e-9)
        before = heave


def test_a_circle_displaces_its_segment(tmp_path, asked):
    """Of 10 m, 6 m deep on its lines, 5 m free: ρg ΔA/2 sin α, A(d) = r² (θ − sin θ cos θ), cos θ = 1 − d/r"""
    circle = (
        'shape = "rectangle"\nbeam = 10.0\nheight = 6.7\ndraft = 5.0',
        'shape = "circle"\ndiameter = 10.0\ndraft = 6.0',
    )
    path = written(tmp_path, circle, ("free_draft = 3.4", "free_draft = 5.0"), ("attachment = 5.0", "attachment = 0.1"),
                   ('["fixed", "taut"]', '["taut"]'), ("[6.0, 8.0, 10.0]", "[8.0]"),
                   ("depth = 10.0", "depth = 10.0\ntide = 0.4"))  # fmt: skip
    asked("breakwater", path, "--output", tmp_path / "o.h5", status=None)

    def area(d):
        theta = math.acos(1 - d / 5.0)
        return 25.0 * (theta - math.sin(theta) * math.cos(theta))

    with h5py.File(tmp_path / "o.h5") as file:
        unit = RHO * G / (2 * math.sin(ANGLE))
        assert file["pretension/given"][()] == pytest.approx(unit * (area(6) - area(5)), rel=1e-6)
        for name, rise in (("low", -0.4), ("mean", 0.0), ("high", 0.4)):
            assert file[f"tide/{name}/rise"][()] == rise
            change = unit * (area(6 + rise) - area(6))
            assert file[f"tide/{name}/change"][()] == pytest.approx(change, rel=1e-6, abs=1e-6)


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
    assert (f"m break at 1 of 2 periods, up to 3 s, where {limit:.3g} m is the highest (Miche)" in said) is told


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
    (("beam = 10.0\n", ""), "section.beam is missing; shape rectangle needs beam and height"),
    (("beam = 10.0", "beam = 10.0\ndiameter = 3.0"), "section.diameter is given; shape rectangle has beam and height"),
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
    (("[waves]", "[optimisation]\n[waves]"), "optimisation has no range; allowed: draft, width, angle_deg"),
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
