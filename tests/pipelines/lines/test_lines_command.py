"""`hakobune line` and `hakobune lines` as a user calls them."""

import re
from pathlib import Path

import numpy as np
import pytest

from hakobune import pipelines
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.line_tables import TypeTable, line_type
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.lines.line_result import line
from hakobune.pipelines.lines.lines_result import lines
from hakobune.pipelines.lines.system_file import read_system
from hakobune.pipelines.results.file import read
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels

SPREAD = """\
[water]
depth = 60.0
[types.chain]
catalogue = "R3 studless 76 mm"
bed_friction = 0.5
[types.wire]
weight_N_per_m = 120.0
axial_stiffness_kN = 2.0e5
breaking_load_kN = 2500
bed_friction = 0.5
[[bodies]]
name = "barge"
force_kN = [60.0, 20.0, 0.0]
[[anchors]]
name = "A1"
position = [-320.0, 0.0, -60.0]
[[anchors]]
name = "A2"
position = [280.0, 190.0, -60.0]
[[anchors]]
name = "A3"
position = [280.0, -190.0, -60.0]
[[fairleads]]
name = "stern"
body = "barge"
position = [-40.0, 0.0, -2.0]
[[fairleads]]
name = "port"
body = "barge"
position = [40.0, 12.0, -2.0]
[[fairleads]]
name = "starboard"
body = "barge"
position = [40.0, -12.0, -2.0]
[[points]]
name = "sinker"
position = [-100.0, 0.0, -50.0]
mass = 8000.0
volume = 1.0
[[lines]]
name = "stern chain"
type = "chain"
length = 215.0
from = "A1"
to = "sinker"
[[lines]]
name = "stern wire"
type = "wire"
length = 80.0
from = "sinker"
to = "stern"
[[lines]]
name = "port"
type = "chain"
length = 312.0
from = "A2"
to = "port"
[[lines]]
name = "starboard"
type = "chain"
length = 312.0
from = "A3"
to = "starboard"
"""


FLOATING = ["--type", "HMPE 160 mm", "--length", "300", "--depth", "60", "--tension", "9"]
HANGING = ["--weight", "1000", "--length", "300", "--depth", "60"]


@pytest.fixture
def spread(tmp_path):
    path = tmp_path / "spread.toml"
    path.write_text(SPREAD)
    return path


def test_line_prints_the_forces_of_the_line_and_draws_it(tmp_path, capsys):
    picture = tmp_path / "line.png"
    arguments = ["--weight", "1000", "--stiffness", "5e5", "--length", "300", "--depth", "60", "--span", "285"]
    assert main(["line", *arguments, "--plot", str(picture)]) == 0
    shown = capsys.readouterr().out
    expected = solve_lines(285.0, 60.0, 300.0, 1000.0, 5e8)
    found = line(weight=1000.0, stiffness=5e8, length=300.0, depth=60.0, span=285.0)
    for name in ("horizontal", "vertical"):
        force = getattr(expected, f"{name}_fairlead")
        assert found[f"fairlead.{name}"] == pytest.approx(force, rel=1e-12)
        assert float(re.search(rf"{name} force at the fairlead[\W,down]+([\d.]+)", shown)[1]) * 1e3 == pytest.approx(
            float(force), rel=5e-4
        )
    assert picture.stat().st_size > 10_000


def test_the_characteristic_of_one_line_is_that_of_a_line_of_a_system(spread, capsys):
    assert main(["lines", str(spread), "--characteristic", "port"]) == 0
    assert "port, from slack to taut" in capsys.readouterr().out
    assert main(["lines", str(spread), "--characteristic", "L9"]) == 2
    assert "line 'L9' is unknown" in capsys.readouterr().err
    flags = ["--type", "R3 studless 76 mm", "--length", "300", "--depth", "60", "--tension", "300"]
    assert main(["line", *flags, "--characteristic"]) == 0
    assert "from slack to taut" in capsys.readouterr().out


@pytest.mark.parametrize("place", [("5", "0", "280"), ("15", "0", "200"), ("-15", "-65", "24")])
def test_the_characteristic_over_a_slope_ends_where_the_bed_is_as_high_as_the_fairlead(tmp_path, place, capsys):
    slope, z, span = place
    flags = ["--type", "R3 studless 76 mm", "--length", "300", "--depth", "60", "--slope-deg", slope, "--fairlead-z", z]
    flags += ["--span", span, "--characteristic"]
    assert main(["line", *flags, "--plot", str(tmp_path / "line.png")]) == 0
    assert main(["line", *flags, "--output", str(tmp_path / "line.h5")]) == 0
    spans = read(tmp_path / "line.h5", "line").labels["at_span"].values
    assert spans.min() >= 0 and (60 + float(z) >= spans * np.tan(np.radians(float(slope)))).all()
    assert len(spans) == 24 and np.ptp(spans) > 60
    assert (tmp_path / "line.png").stat().st_size > 10_000


def test_line_finds_the_span_of_a_tension():
    found = line(type="R4 studlink 84 mm", length=400.0, depth=80.0, tension=500e3)
    assert found["fairlead.horizontal"] == pytest.approx(500e3, rel=1e-9)


def test_the_tension_of_a_line_that_lies_on_its_bed_is_its_pull_and_the_weight_of_its_height():
    """But for its stretch (Faltinsen, 1990, eq. 8.18)"""
    found = line(type="R3 studless 76 mm", length=300.0, depth=60.0, tension=300e3)
    assert found["fairlead.tension"] == pytest.approx(found["fairlead.horizontal"] + found["weight"] * 60, rel=1e-3)


def test_line_of_a_rope_that_floats_hangs_upside_down_and_stays_in_the_sea(tmp_path, capsys):
    picture, rope = tmp_path / "rope.png", ["line", "--type", "HMPE 160 mm", "--length", "350", "--depth", "100"]
    assert main([*rope, "--span", "300", "--plot", str(picture)]) == 0
    assert "partly in the sea surface" in capsys.readouterr().out
    found = line(type="HMPE 160 mm", length=350.0, depth=100.0, span=300.0)
    # the anchor holds what lifts the part under water
    assert found["anchor.vertical"] == pytest.approx(-found["weight"] * (350 - found["grounded"]), rel=1e-9)
    assert picture.stat().st_size > 10_000
    assert main([*rope, "--tension", "50", "--characteristic"]) == 0
    shown = capsys.readouterr().out
    assert "floats, m" in shown and "on the bed, m" not in shown


def test_line_warns_in_one_line_of_a_tension_above_the_breaking_load(capsys):
    hung = ["line", "--type", "R3 studless 76 mm", "--length", "300", "--depth", "60", "--span"]
    assert main([*hung, "280"]) == 0
    assert "FAILS" not in capsys.readouterr().out
    assert main([*hung, "400"]) == 1
    (warning,) = (line for line in capsys.readouterr().out.splitlines() if line.startswith("FAILS: "))
    assert "the breaking load 4884 kN: the line parts" in warning


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--length", "300", "--depth", "60", "--span", "1"], "--type and --weight: neither is given"),
        (["--weight", "9", "--length", "300", "--depth", "60"], "--span and --tension: neither is given"),
        (["--type", "rope", "--length", "300", "--depth", "60", "--span", "1"], "'rope' is not in the catalogue"),
        (
            ["--type", "polyester 99999 mm", "--length", "300", "--depth", "60", "--span", "250"],
            "polyester 99999 mm: the size is 99999 mm; allowed: 1 to 500",
        ),
        (["--weight", "9", "--length", "50", "--depth", "60", "--span", "40"], "cannot be reached"),
        (["--weight", "9", "--length", "-5", "--depth", "60", "--span", "40"], "--length is -5 m; allowed"),
        ([*HANGING, "--span", "250", "--slope-deg", "95"], "--slope-deg is 95°; allowed: above −85.94 and below 85.94"),
        ([*HANGING, "--span", "250", "--fairlead-z", "-70"], "--fairlead-z is -70 m; allowed: from -60 m, the bed"),
        ([*HANGING, "--tension", "9", "--fairlead-z", "-70"], "--fairlead-z is -70 m; allowed: from -60 m, the bed"),
        (
            [*HANGING, "--span", "250", "--slope-deg", "20"],
            "--fairlead-z is 0 m; allowed: from 30.9926 m, the bed 250 m from the anchor (--depth, --slope-deg)",
        ),
        ([*HANGING, "--span", "-5"], "--span is -5 m; allowed: at least 0, finite"),
        ([*HANGING, "--tension", "0"], "--tension is 0 kN; allowed: above 0, finite"),
        ([*HANGING, "--tension", "9", "--friction", "-1"], "--friction is -1; allowed: 0 to 5"),
        (
            [*FLOATING, "--fairlead-z", "3"],
            "--fairlead-z is 3 m; allowed with HMPE 160 mm, lighter than water: at most 0",
        ),
        (
            [*FLOATING, "--friction", "1"],
            "--friction is 1; allowed with HMPE 160 mm, lighter than water: 0, since the line does not lie",
        ),
        ([*HANGING, "--tension", "1e12"], "--tension is 1e+12 kN, at which an inextensible line of 300 m is straight"),
        ([*HANGING, "--tension", "1", "--slope-deg", "5"], "--tension is 1 kN; the line would then hang "),
        ([*HANGING, "--tension", "9000", "--slope-deg", "15"], "60 m above the anchor on a line of 300 m with 9e+06 N"),
        ([*HANGING, "--tension", "9", "--stiffness", "-1"], "--stiffness is -1 kN; allowed: above 0"),
    ],
)
def test_line_says_in_one_line_what_it_cannot_do(arguments, message, capsys):
    assert main(["line", *arguments]) == 2
    said = capsys.readouterr().err
    assert message in said and said.count("\n") == 1


def test_lines_runs_a_system_and_writes_results_picture_and_moordyn_file(spread, tmp_path, capsys):
    own = SPREAD[SPREAD.index("weight_N_per_m") : SPREAD.index("bed_friction = 0.5\n[[bodies]]")]
    spread.write_text(SPREAD.replace(own, 'catalogue = "wire 6x36 IWRC 60 mm"\n'))
    out, picture, deck = tmp_path / "rest.h5", tmp_path / "rest.svg", tmp_path / "deck.txt"
    extra = ["--offset", "3", "--direction", "0,90", "--broken", "--output", str(out), "--plot", str(picture)]
    assert main(["lines", str(spread), *extra, "--moordyn", str(deck)]) == 0
    shown = capsys.readouterr().out
    for text in (
        "lines at rest",
        "stiffness of the lines on barge",
        "held at offsets",
        "one line broken",
        "stern wire",
    ):
        assert text in shown
    found = read(out, "lines")
    assert found.quantity("tension.b").unit == "N" and found.labels["line"].values[0] == "stern chain"
    assert picture.stat().st_size > 10_000
    # a file of its own, whose forces at the given pose are the same
    again = read_system(deck)
    assert np.allclose(again.load().force, read_system(spread).load().force, rtol=1e-9, atol=1e-3)
    assert 0 < found["body[barge].x"] < 20


MOORDYN = """--- LINE TYPES ---
Name Diam MassDen EA BA EI Cd Ca CdAx CaAx
(-) (m) (kg/m) (N) (N-s) (N-m^2) (-) (-) (-) (-)
chain 0.1 150 6e8 -0.8 {EI} 1.2 1.0 0.1 0.5
--- POINTS ---
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed -250 0 -60 0 0 0 0
2 Coupled -5 0 0 0 0 0 0
3 Fixed 250 0 -60 0 0 0 0
4 Coupled 5 0 0 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs
(#) (-) (-) (-) (m) (-)
1 chain 1 2 260 20
2 chain 3 4 260 20
--- OPTIONS ---
0.001 dtM
"""


@pytest.fixture
def legs(tmp_path):
    path = tmp_path / "legs.txt"
    path.write_text(MOORDYN.format(EI="2e4"))
    return path


def test_coupled_points_of_a_moordyn_file_are_held_until_a_force_moves_the_vessel(legs, capsys):
    assert main(["lines", str(legs), "--depth", "60"]) == 0
    shown = capsys.readouterr().out
    assert "held" not in shown and lines(legs, depth=60.0)["body[vessel].x"] == 0
    assert "bending stiffness EI of chain is not included" in shown
    assert main(["lines", str(legs), "--depth", "60", "--force", "50,0,0"]) == 0
    shown = capsys.readouterr().out
    assert "vessel is held at its position without --force; with --force it moves in surge, sway and yaw" in shown
    assert lines(legs, depth=60.0, force=[50e3, 0, 0])["body[vessel].x"] > 0.1


def test_a_depth_counts_where_a_moordyn_file_has_none(legs, capsys):
    lying = {depth: lines(legs, depth=float(depth))["grounded[1]"] for depth in (60, 65)}
    assert 0 < lying[65] < lying[60]
    assert main(["lines", str(legs)]) == 0
    assert (
        "WtrDpth is missing; the bed is assumed at the lowest point, 60 m; give the depth if this is wrong"
    ) in capsys.readouterr().out
    for wrong, message in (("-60", "--depth is -60 m; allowed: above 0"), ("nan", "--depth is nan m; allowed")):
        assert main(["lines", str(legs), "--depth", wrong]) == 2
        assert message in capsys.readouterr().err


def test_a_moordyn_file_written_from_a_moordyn_file_keeps_its_coefficients(legs, tmp_path):
    assert main(["lines", str(legs), "--depth", "60", "--moordyn", str(tmp_path / "again.txt")]) == 0
    text = (tmp_path / "again.txt").read_text().splitlines()
    row = next(line.split() for line in text if line.startswith("chain"))
    assert [float(value) for value in row[4:]] == [-0.8, 2e4, 1.2, 1.0, 0.1, 0.5]
    options = {line.split()[1]: line.split()[0] for line in text if len(line.split()) == 2}
    assert options["WtrDnsty"] == "1025.0" and float(options["dtM"]) <= 0.001


def test_lines_moves_the_body_where_a_force_pushes_it(spread):
    places = [lines(spread, force=[force, 0.0, 0.0])["body[barge].x"] for force in (0.0, 100e3)]
    assert places[1] > places[0] + 0.1


FAULTS = [
    (("type = \"wire\"", "type = \"rope\""), [], "lines[1].type is 'rope'; allowed: chain, wire"),
    (("R3 studless", "R3 stuffed"), [],
     "types.chain.catalogue: chain 'R3 stuffed 76 mm': after the grade comes studlink or studless"),
    (("depth = 60.0", "depht = 60.0"), [], "water.depht is unknown, depth may be meant; allowed: depth"),
    (("mass = 8000.0", "mass = -1"), [], "point sinker: mass is -1; allowed: finite, at least 0 kg"),
    (("to = \"stern\"", "to = \"bow\""), [], "its end 'bow' is not a point of the system"),
    (("", ""), ["--body", "tug"], "--body is 'tug'; allowed: barge"),
    (("", ""), ["--force", "1,2"], "--force has 2 numbers; allowed: 3"),
    (("", ""), ["--force", "a"], "--force is 'a'; allowed: finite numbers"),
    (("", ""), ["--offset", "-2"], "--offset is -2 m; allowed: above 0"),
    (("", ""), ["--plot", "x.doc"], "has the suffix '.doc'; allowed"),
    (("", ""), ["--output", "/nowhere/x.h5"], "/nowhere"),
    (("bed_friction = 0.5\n[[bodies]]", "[[bodies]]"), ["--moordyn", "never.txt"], "bed friction is 0 and 0.5"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "arguments", "message"), FAULTS)
def test_lines_says_in_one_line_what_it_cannot_do(tmp_path, change, arguments, message, capsys):
    path = tmp_path / "bad.toml"
    path.write_text(SPREAD.replace(*change, 1) if change[0] else SPREAD)
    assert main(["lines", str(path), *arguments]) == 2
    said = capsys.readouterr().err
    assert message in said and said.count("\n") == 1


@pytest.mark.parametrize("name", ["none.toml", "none.txt", "none.yaml", "none.h5"])
def test_a_missing_file_is_one_line(tmp_path, name, capsys):
    assert main(["lines", str(tmp_path / name)]) == 2
    assert "does not exist" in capsys.readouterr().err


def test_frames_of_a_line_become_a_strip_and_a_film(tmp_path, capsys):
    time, s = np.linspace(0, 2, 12), np.linspace(0, 1, 20)
    nodes = np.zeros((12, 20, 3))
    nodes[..., 0], nodes[..., 2] = 100 * s, -20 * s * (1 - s) * (1 + 0.3 * np.sin(3 * time[:, None]))
    run = tmp_path / "run.h5"
    axes = labels("frame", time, "s") | labels("node", s, "m") | labels("xyz", ["x", "y", "z"])
    place = Quantity(nodes, ("frame", "node", "xyz"), "m", "places", record=True)
    Result("line-dynamics", {"line.place": place}, axes).write(run)
    for name in ("strip.png", "film.gif"):
        assert main(["lines", str(run), "--plot", str(tmp_path / name)]) == 0
        assert (tmp_path / name).stat().st_size > 5_000
    picture = tmp_path / "run.png"  # of `line-dynamics --output run.h5 --plot run.png`
    picture.write_text("tensions")
    assert main(["lines", str(run)]) == 0
    assert picture.read_text() == "tensions" and (tmp_path / "run_frames.png").stat().st_size > 5_000
    assert "run_frames.png" in capsys.readouterr().out
    Result("lines", {}).write(run)
    assert main(["lines", str(run)]) == 2
    assert "has no frames" in capsys.readouterr().err


SINKER = SPREAD[SPREAD.index("[[points]]") : SPREAD.index('[[lines]]\nname = "stern chain"')]
STERN = SPREAD[SPREAD.index('[[lines]]\nname = "stern chain"') : SPREAD.index('[[lines]]\nname = "port"')]
CUT = """\
[[lines]]
name = "stern chain"
from = "A1"
to = "stern"
segments = [{ type = "chain", length = 215.0 }, { type = "wire", length = 80.0 }]
bodies = [{ after_segment = 1, mass = 8000.0, volume = 1.0 }]
"""


def test_segments_with_a_body_between_them_are_lines_joined_at_a_free_point(tmp_path):
    """The free point may rest on the bed, and the bodies are loaded so that it does not."""
    heavy = SPREAD.replace("[60.0, 20.0, 0.0]", "[200.0, 20.0, 0.0]")
    joined, cut = tmp_path / "joined.toml", tmp_path / "cut.toml"
    joined.write_text(heavy)
    cut.write_text(heavy.replace(SINKER, "").replace(STERN, CUT))
    apart, one = rest(read_system(joined)), rest(read_system(cut))
    assert apart.pose.free[0, 2] > -59
    assert np.allclose(one.position, apart.position, atol=1e-6)
    assert one.lines.tension_b[0] == pytest.approx(apart.lines.tension_b[1], rel=1e-7)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('from = "A1"', 'type = "chain"\nfrom = "A1"', "lines[0] (stern chain): give either type and length, or"),
        ("after_segment = 1", "after_segment = 2", "lines[0].bodies[0].after_segment is 2; allowed: 1 to 1"),
        ("mass = 8000.0, volume", "mass = -8000.0, volume", "lines[0].bodies[0].mass is -8000; allowed: at least 0"),
        (
            "bed_friction = 0.5",
            "bed_friction = 0.4",
            "bed_friction of its types is 0.4 to 0.5, but a line has only one friction; give bed.friction",
        ),
        ('{ type = "wire"', '{ type = "rope"', "lines[0].segments[1].type is 'rope'; allowed: chain, wire"),
        (
            "bodies = [{ after",
            "bed = { points = [[0, 0]] }\nbodies = [{ after",
            "lines[0].bed: bed points have the shape",
        ),
        (
            "bodies = [{ after",
            "bed = { points = [[0, 0], [90, 80]] }\nbodies = [{ after",
            "lines[0].bed.points[1] is [90, 80], 20 m above still water; allowed: z up to 60",
        ),
    ],
)
def test_a_line_of_segments_that_cannot_be_is_refused_by_its_key(tmp_path, old, new, message):
    path = tmp_path / "bad.toml"
    path.write_text(SPREAD.replace(SINKER, "").replace(STERN, CUT).replace(old, new, 1))
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        read_system(path)
    assert "\n" not in str(caught.value)


def test_the_example_of_lines_with_segments_comes_to_rest_and_is_drawn(tmp_path, capsys):
    scene, picture = Path(pipelines.__file__).parent / "scenes" / "lines_barge.toml", tmp_path / "barge.png"
    assert main(["lines", str(scene), "--plot", str(picture)]) == 0
    warned = [line for line in capsys.readouterr().out.splitlines() if "warning" in line]
    # a pile above the water holds it
    assert len(warned) == 1 and "above still water with their weight in water: hawser over" in warned[0]
    assert picture.stat().st_size > 20_000
    assert main(["lines", str(scene), "--moordyn", str(tmp_path / "barge.txt")]) == 2
    assert "line stern has several segments" in capsys.readouterr().err


def test_a_type_of_a_study_may_come_from_the_catalogue_and_be_corrected():
    plain = line_type("types.x", TypeTable(catalogue="R3 studless 76 mm"))
    assert plain.breaking_load == pytest.approx(4884e3, rel=1e-3) and plain.weight == pytest.approx(985, rel=1e-3)
    heavier = line_type("types.x", TypeTable(catalogue="R3 studless 76 mm", weight_N_per_m=1200.0))
    assert heavier.weight == 1200.0 and heavier.axial_stiffness == plain.axial_stiffness
    with pytest.raises(StudyError, match="nothing is given"):
        line_type("types.x", TypeTable())


@pytest.mark.parametrize(
    "flags, state",
    [([], "at rest"), (["--offset", "5"], "with the body held at offsets"), (["--broken"], "after the loss of")],
)
def test_lines_loaded_above_their_breaking_load_are_named_with_number_and_limit(tmp_path, capsys, flags, state):
    weak = tmp_path / "weak.toml"
    weak.write_text(SPREAD.replace("breaking_load_kN = 2500", "breaking_load_kN = 40"))
    assert main(["lines", str(weak), *flags]) == 1
    said = [line for line in capsys.readouterr().out.splitlines() if line.startswith(f"FAILS: {state}")]
    assert said and all("stern wire" in line and "limit 100 %" in line for line in said)


def test_a_line_stretched_to_twice_its_length_is_said_to_part(tmp_path, capsys):
    short = tmp_path / "short.toml"
    short.write_text(SPREAD.replace("length = 80.0", "length = 20.0").replace("2.0e5", "200.0"))
    assert main(["lines", str(short)]) == 1
    assert re.search(r"FAILS: at rest, stretched by: stern wire .* limit 50 %", capsys.readouterr().out)


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("bed_friction = 0.5", "bed_friction = 1e9", "bed_friction is 1e+09; allowed: 0 to 5"),
        ("depth = 60.0", "depth = 20000.0", "water.depth is 20000; allowed: above 0, at most 12000"),
        ("length = 80.0", "length = 1e9", "length is 1e+09; allowed: above 0, at most 100000"),
        (
            "[[bodies]]",
            '[types.spare]\ncatalogue = "R9 3 mm"\n[[bodies]]',
            "types.spare.catalogue: 'R9 3 mm' is not in",
        ),
        ("weight_N_per_m = 120.0", "weight_N_per_m = 1e7", "1e+07; allowed: above 0, at most 1e+06"),
    ],
)
def test_systems_that_cannot_be_are_refused_with_their_limit(tmp_path, capsys, old, new, said):
    path = tmp_path / "wrong.toml"
    path.write_text(SPREAD.replace(old, new))
    assert main(["lines", str(path)]) == 2
    shown = capsys.readouterr()
    assert said in shown.err and not shown.out


@pytest.mark.parametrize("offset", ["nan", "inf", "1e9", "0"])
def test_an_offset_that_cannot_be_is_refused_before_anything_is_shown(spread, capsys, offset):
    assert main(["lines", str(spread), "--offset", offset]) == 2
    shown = capsys.readouterr()
    assert "--offset is" in shown.err and not shown.out


def test_an_anchor_high_above_the_water_is_warned_of(tmp_path, capsys):
    path = tmp_path / "high.toml"
    path.write_text(SPREAD.replace("position = [-320.0, 0.0, -60.0]", "position = [-320.0, 0.0, 60.0]"))
    main(["lines", str(path)])
    assert "these anchors are above the water: A1 (z = 60 m), limit 30 m" in capsys.readouterr().out


def test_a_moordyn_file_without_lines_is_refused_by_what_it_has(tmp_path, capsys):
    table = "--- ROD TYPES ---\n-\n-\nlog 0.5 100 0 1 0 0\n--- RODS ---\n"
    table += "ID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs\n-\n"
    (tmp_path / "rods.txt").write_text(table + "1 log free 0 -1 -10 0 1 -10 4\n--- OPTIONS ---\n16 WtrDpth\n")
    assert main(["lines", str(tmp_path / "rods.txt")]) == 2
    assert "has no section LINES, only RODS; give lines" in capsys.readouterr().err
