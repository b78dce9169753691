"""Results and warnings of `hakobune lines` against figures by hand, and what it says where something is amiss."""

import math

import numpy as np
import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.lines.lines_result import lines

HELD = """\
[water]
depth = 100.0
[types.chain]
catalogue = "R3 studless 76 mm"
[types.wire]
catalogue = "wire 6x36 IWRC 1960 30 mm"
[types.nylon]
elongation_percent = [0, 5, 10, 20]
tension_kN = [0, 50, 150, 600]
[[anchors]]
name = "A"
position = [0.0, 0.0, -100.0]
[[anchors]]
name = "F"
position = [280.0, 0.0, 0.0]
[[anchors]]
name = "G"
position = [280.0, 40.0, 0.0]
"""
BUOYED = """\
[[lines]]
name = "buoyed"
from = "A"
to = "F"
segments = [{ type = "chain", length = 200.0 }, { type = "chain", length = 140.0 }]
bodies = [{ after_segment = 1, mass = 1000.0, volume = 500.0 }]
"""
CHAIN_OVER_WIRE = """\
[[lines]]
name = "chain over wire"
from = "A"
to = "F"
segments = [{ type = "wire", length = 200.0 }, { type = "chain", length = 112.0 }]
"""
HAWSER = """\
[[lines]]
name = "hawser"
from = "F"
to = "G"
type = "nylon"
length = 30.0
"""


@pytest.fixture
def shown(tmp_path, capsys):
    """What `hakobune lines` prints, and its status, of a system of the held points with some lines and flags"""

    def show(*lines, flags=(), system=HELD):
        path = tmp_path / "system.toml"
        path.write_text(system + "".join(lines))
        status = main(["lines", str(path), *flags])
        printed = capsys.readouterr()
        return printed.out + printed.err, status

    return show


@pytest.fixture
def found(tmp_path):
    """Result of a system of the held points with some lines"""

    def find(*parts, system=HELD, **asked):
        path = tmp_path / "system.toml"
        path.write_text(system + "".join(parts))
        return lines(path, **asked)

    return find


def test_what_a_line_uses_is_that_of_the_segment_nearest_to_its_breaking_load(found):
    # the upper end of the wire, of 629 kN, pulls down by what the top does less 112 m of chain at 985 N/m
    result = found(CHAIN_OVER_WIRE)
    top, pull, used = (result[f"{name}"][0] for name in ("tension.b", "horizontal.b", "used"))
    wire = math.hypot(pull, math.sqrt(top**2 - pull**2) - 985 * 112)
    assert used == pytest.approx(wire / 629e3, rel=2e-3) and used < top / 629e3
    # under the buoy the line carries more than at either end
    result = found(BUOYED)
    used = result["used[buoyed]"]
    assert used == pytest.approx(0.036, abs=1e-3)
    assert used > max(result["tension.a"][0], result["tension.b"][0]) / 4884e3


def test_a_characteristic_ends_where_the_first_segment_carries_its_breaking_load(found):
    result = found(CHAIN_OVER_WIRE, characteristic="chain over wire")
    assert result["characteristic.used"][-1] == pytest.approx(1, rel=1e-9)
    assert result["characteristic.tension"][-1] > 629e3


def test_a_hawser_beyond_its_table_is_told_with_the_end_of_the_table(shown):
    said, _ = shown(HAWSER)
    assert "exceed their table of load over elongation" in said and "table to 600 kN" in said


STIFF = '[types.stiff]\nweight_kg_per_m = 100.0\n[[lines]]\nname = "short"\ntype = "stiff"\n'


def test_a_line_too_short_for_two_anchors_is_named_with_length_span_and_way_out(shown):
    said, status = shown(STIFF + 'length = 200.0\nfrom = "A"\nto = "F"\n')
    assert status != 0 and "line short, inextensible and 200 m long, cannot span 297.321 m" in said
    assert "give the line its axial stiffness or more length" in said


MOORED = """\
[[bodies]]
name = "barge"
[[fairleads]]
name = "bow"
body = "barge"
position = [0.0, 0.0, 0.0]
[types.stiff]
weight_kg_per_m = 100.0
[[anchors]]
name = "B"
position = [-280.0, 0.0, -100.0]
[[anchors]]
name = "C"
position = [280.0, 0.0, -100.0]
"""
LEGS = "".join(
    f"""\
[[lines]]
name = "leg {anchor}"
from = "{anchor}"
to = "bow"
segments = [{{ type = "stiff", length = 305.0 }}]
bed = {{ friction = 0.5 }}
"""
    for anchor in "BC"
)


def test_offsets_out_of_reach_are_told_and_the_others_shown(shown, found):
    # 305 m reach 288.1 m at 100 m depth, 8.1 m off the middle
    said, status = shown(MOORED, LEGS, flags=("--offset", "10", "--direction", "0"))
    assert status == 1
    result = found(MOORED, LEGS, offset=10.0, directions=[0.0])
    missed = np.abs(result.labels["offset"].values) > 8.5
    assert np.array_equal(np.isnan(result["curve.restoring"][:, 0]), missed) and missed.sum() == 4
    assert "barge cannot be held at 4 of 21 offsets along 0°; the reason at the nearest, -9 m: line leg C" in said
    assert "give the line its axial stiffness" in said and "a smaller --offset" in said and "<StaticLine" not in said


def test_a_body_free_where_no_water_holds_it_is_warned_of(shown):
    loose = MOORED.replace('name = "barge"\n', 'name = "barge"\nfreedom = ["Surge", "Heave", "Roll"]\n', 1)
    assert "barge is free in Heave, Roll, but this command knows no weight " in shown(loose, LEGS)[0]
    assert "knows no weight " not in shown(MOORED, LEGS)[0]


def test_a_stiffness_that_is_rounding_is_nothing(found):
    """Two legs in the plane y = 0 pull a body neither across it nor in turns of it"""
    result = found(MOORED.replace("[0.0, 0.0, 0.0]", "[0.0, 0.0, -1.0]"), LEGS)
    shift, turn = result["stiffness.shift"], result["stiffness.turn"]
    assert shift[1, 0] == shift[2, 1] == 0 and shift[0, 0] > 0 and shift[1, 1] > 0
    assert shift[4, 0] == pytest.approx(-shift[0, 0], rel=1e-9) and turn[1, 1] == 0  # the arm is 1 m


def test_a_moordyn_file_says_what_it_does_not_keep(shown, tmp_path):
    line = CHAIN_OVER_WIRE.split("segments")[0] + 'type = "wire"\nlength = 312.0\n'
    said, _ = shown(line, flags=("--moordyn", str(tmp_path / "lines.dat")))
    assert "1 is chain over wire; breaking loads are not in the file" in said


def test_flags_of_a_system_are_refused_with_a_result(tmp_path, capsys):
    assert main(["lines", str(tmp_path / "run.h5"), "--offset", "3"]) != 0
    assert "--offset is for a system of lines" in capsys.readouterr().err


def test_a_line_out_of_the_water_is_told_with_the_share_that_is(shown):
    # almost straight from 100 m below to 30 m above the water: 30 of 130 m of height
    held = HELD.replace("position = [280.0, 0.0, 0.0]", "position = [280.0, 0.0, 30.0]")
    line = CHAIN_OVER_WIRE.split("segments")[0] + 'type = "wire"\nlength = 305.0\n'
    said, _ = shown(line, system=held)
    share = float(said.split("chain over wire over ")[1].split(" ")[0])
    assert share == pytest.approx(30 / 130, rel=0.1) and "limit 0.01" in said
    assert "with their weight in water" not in shown(line)[0]
