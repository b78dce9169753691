"""Ropes, hawsers and catalogue entries by hand: elongations, pulls, printed coefficients, corners of a spread."""

import math

import numpy as np
import pytest

from hakobune.mooring.lines.catalogue import CHAIN, FIBRE, WIRE, line_type, unread
from hakobune.mooring.lines.catenary.state import State
from hakobune.mooring.lines.multi_segment.segments import Segment
from hakobune.mooring.lines.regimes import Regime, harmonic_tension
from hakobune.mooring.lines.ropes import RopePart, rope
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.findings import beyond_tables, freedom_name, strains
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.hawser import Hawser, elongation_at, fill_hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import corner_legs, moored_body
from hakobune.mooring.lines.system.parts import (
    Anchor,
    CompositeLine,
    Fairlead,
    FreePoint,
    LineSystemError,
    LineType,
    MooredBody,
    UniformLine,
)

MAIN, TAIL = RopePart(8e5, 0.02, 1.0), RopePart(1e6, 0.3, 2.0)
BOLLARD, FAIRLEAD = np.array([0.0, 0.0, 2.0]), np.array([30.0, 40.0, 2.0])


def test_a_rope_and_its_tail_stretch_each_by_their_own_law():
    """ε = ε_B (T/T_B)^(1/n): main 0.02 T/800 kN, tail 0.3 √(T/1000 kN); 50 m at 100 kN with a tail of 10 m"""
    made = rope("r", BOLLARD, FAIRLEAD, MAIN, 1e5, tail=TAIL, tail_length=10.0)
    main, tail = 0.02 / 8, 0.3 * math.sqrt(0.1)
    length = (50.0 - 10 * (1 + tail)) / (1 + main) + 10
    assert made.length == pytest.approx(length, rel=1e-12) and made.breaking_load == 8e5
    assert float(made.pull.loading(50.0 - length)) == pytest.approx(1e5, rel=2e-3)  # between points of its table
    for T in (8e5 / 1600, 2e5, 8e5):  # points of it: (k/40)² of the breaking load
        e = (length - 10) * 0.02 * T / 8e5 + 10 * 0.3 * math.sqrt(T / 1e6)
        assert float(made.pull.loading(e)) == pytest.approx(T, rel=1e-9)
    beyond = made.pull.limit + 0.5
    e = np.array([(length - 10) * 0.02 * s * s + 10 * 0.3 * math.sqrt(0.8) * s for s in (39 / 40, 1.0)])
    slope = 8e5 * (1 - (39 / 40) ** 2) / (e[1] - e[0])
    assert float(made.pull.loading(beyond)) == pytest.approx(8e5 + 0.5 * slope, rel=1e-9)
    assert (made.name, made.bollard.tolist(), made.fairlead.tolist()) == ("r", BOLLARD.tolist(), FAIRLEAD.tolist())


def test_a_rope_alone_and_one_that_is_hardened():
    """At twice the strength for its strain half of the elongation; n = 1: T = T_B e/(ε_B L)"""
    plain = rope("r", BOLLARD, FAIRLEAD, MAIN, 0.0)
    assert plain.length == pytest.approx(50.0)
    assert float(plain.pull.loading(0.5)) == pytest.approx(8e5 * 0.5 / (0.02 * 50), rel=1e-6)
    hard = rope("r", BOLLARD, FAIRLEAD, MAIN, 0.0, hardening=2.0)
    assert float(hard.pull.loading(0.25)) == pytest.approx(8e5 * 0.5 / (0.02 * 50), rel=1e-6)
    assert MAIN.strain_at(4e5) == pytest.approx(0.01) and TAIL.strain_at(2.5e5, 4.0) == pytest.approx(0.3 * 0.25)


@pytest.mark.parametrize(
    "make, good, bad, says",
    [
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, v), 7.99e5, 8e5, "pretension is 800 kN; allowed: below"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, v), 0.0, -1.0, "pretension is -0.001 kN"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, v, tail=TAIL, tail_length=5.0), 7.99e5, 9e5, "load of 800 kN"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, 0, hardening=v), 0.2, 0.19, "hardening is 0.19; allowed: 0.2"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, 0, hardening=v), 20.0, 20.1, "hardening is 20.1"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, 0, tail=TAIL, tail_length=v), 49.9, 50.1, "its tail 50.1 m"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, 0, tail=TAIL, tail_length=v), 0.1, 0.0, "its tail 0 m"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, MAIN, 0, tail=v, tail_length=5.0), TAIL, None, "its tail 5 m"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, RopePart(8e5, v, 1.0), 0), 1.99, 2.0, "strain 2 and"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, RopePart(8e5, v, 1.0), 0), 0.01, 0.0, "strain 0 and"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, RopePart(8e5, 0.1, v), 0), 5.0, 5.1, "exponent 5.1"),
        (lambda v: rope("r", BOLLARD, FAIRLEAD, RopePart(8e5, 0.1, v), 0), 0.2, 0.19, "exponent 0.19"),
        (lambda v: Hawser("h", None, v, "a", "b"), 0.1, 0.0, "line h: length is 0"),
        (lambda v: Hawser("h", None, 9.0, "a", "b", v), 0.1, 0.0, "line h: breaking_load is 0 N"),
        (lambda v: pull_of_points("h", [0.0, 1.0], [0.0, v]), 1.0, 0.0, "its tension number 2 is 0 N"),
        (lambda v: pull_of_points("h", [v, 1.0], [0.0, 1.0]), 0.0, 0.1, "its elongation number 1 is 0.1 m"),
        (lambda v: pull_of_points("h", [0.0, 1.0], [0.0, 1.0, 2.0][:v]), 2, 3, "2 elongations and 3 tensions"),
        (lambda v: line_type(f"grade 3 {v} mm"), 220, 221, "the size is 221 mm; allowed: 10 to 220"),
        (lambda v: line_type(f"grade 3 {v} mm"), 10, 9, "the size is 9"),
        (lambda v: line_type(f"polyester {v} mm"), 500, 501, "the size is 501 mm; allowed: 1 to 500"),
        (lambda v: line_type(f"nylon {v} mm"), 1, 0.9, "the size is 0.9 mm"),
    ],
)  # fmt: skip
def test_ropes_are_made_up_to_their_limits_and_refused_beyond(make, good, bad, says):
    make(good)
    with pytest.raises(LineSystemError) as refused:
        make(bad)
    assert says in str(refused.value) and "\n" not in str(refused.value)


def test_coefficients_of_the_catalogue_are_the_printed_ones():
    """Chain: IACS UR W22 (R3 to R5, kN/mm²), SR179 (1982) table 4.2.2.1 (grades, tf); wire: EN 12385-4 (K, W); moduli

    of studless chain: DNV-OS-E301 (2013); fibre: NREL's mooring property library (MoorPy, 2021 to 2024)"""
    kN = {name: (one.breaking, one.proof_studlink, one.proof_studless) for name, one in CHAIN.items()}
    tf = 9.80665e-3
    assert kN == {
        "1": (tf, 0.7 * tf, None), "2": (1.4 * tf, tf, None), "3": (2.0 * tf, 1.4 * tf, None),
        "orq": (2.153 * tf, 1.428 * tf, None),
        "r3": (0.0223, 0.0156, 0.0156), "r3s": (0.0249, 0.0180, 0.0174), "r4": (0.0274, 0.0216, 0.0192),
        "r4s": (0.0304, 0.0240, 0.0213), "r5": (0.0320, 0.0251, 0.0223),
    }  # fmt: skip
    moduli = {name: one.modulus_studless for name, one in CHAIN.items() if one.modulus_studless}
    assert moduli == {
        "r3": (5.4e10, 4e7),
        "r3s": (5.4e10, 4e7),
        "r4": (5.45e10, 2.5e7),
        "r4s": (5.45e10, 2.5e7),
        "r5": (6e10, 3.3e7),
    }
    assert WIRE == {
        ("6x24", "fc"): (0.280, 0.318),
        ("6x7", "fc"): (0.332, 0.345), ("6x7", "iwrc"): (0.359, 0.384), ("6x19", "fc"): (0.330, 0.359),
        ("6x19", "iwrc"): (0.356, 0.400), ("6x36", "fc"): (0.330, 0.367), ("6x36", "iwrc"): (0.356, 0.409),
    }  # fmt: skip
    assert [tuple(FIBRE[name]) for name in ("polyester", "nylon", "hmpe")] == [
        (679.0, 308e6, 0.0, 14.0, 1380.0),
        (585.0, 207e6, 230e6, 5.0, 1140.0),
        (496.0, 580e6, 651e6, 56.0, 975.0),
    ]


def test_a_rope_of_6x24_breaks_a_little_below_what_a_maker_has_of_it():
    """A sixth of what 6x24 of class A breaks with is 8.21 kN at 10 mm (Nikko Seiko); a letter of JIS is a strength"""
    rope = line_type("wire 6x24 FC A 10 mm")
    assert 0.9 < rope.breaking_load / (6 * 8.21e3) < 1.0 and rope.mass == pytest.approx(0.318)
    assert rope.breaking_load == line_type("wire 6x24 FC 1620 10 mm").breaking_load == pytest.approx(0.28 * 100 * 1620)
    assert "not checked in the standard" in unread("wire 6x24 FC A 10 mm")
    assert not unread("wire 6x36 FC 10 mm") + unread(None)


def test_entries_of_the_catalogue_by_hand():
    """80 mm each: mass, strength, EA, diameter of the displaced volume, weight in water of 1010 kg/m³ at 9.7 m/s²"""
    chain = line_type("R4S studless 80 mm", 1010.0, 9.7)
    assert chain.mass == pytest.approx(0.02 * 6400) and chain.diameter == pytest.approx(
        math.sqrt(4 * 128 / (math.pi * 7850))
    )
    assert chain.weight == pytest.approx(128 * 9.7 * (1 - 1010 / 7850), rel=1e-12)
    assert chain.breaking_load == pytest.approx(30.4 * 6400 * (44 - 6.4)) and chain.proof_load == pytest.approx(
        21.3 * 6400 * 37.6
    )
    assert chain.axial_stiffness == pytest.approx((5.45e10 - 2.5e7 * 80) * math.pi / 2 * 0.0064, rel=1e-12)
    assert (chain.dynamics.added_mass_tangential, line_type("grade 2 80 mm").mass) == (
        0.5,
        pytest.approx(0.0219 * 6400),
    )
    wire = line_type("wire 6x19 FC 2160 80 mm")
    assert (wire.mass, wire.breaking_load) == pytest.approx((0.00359 * 6400, 0.33 * 6400 * 2160))
    assert wire.axial_stiffness == pytest.approx(7e4 * math.pi / 4 * 6400) and wire.proof_load is None
    spiral = line_type("spiral strand 80 mm")
    assert (spiral.mass, spiral.breaking_load) == pytest.approx((5.293e-3 * 6400, 1022.0 * 6400))
    assert spiral.axial_stiffness == pytest.approx(1.13e5 * math.pi / 4 * 6400)
    nylon = line_type("nylon 80 mm")
    strength = 207e6 * 0.0064 + 230e6 * 0.000512
    assert (nylon.mass, nylon.breaking_load, nylon.axial_stiffness) == pytest.approx(
        (585 * 0.0064, strength, 5 * strength)
    )
    assert nylon.diameter == pytest.approx(math.sqrt(4 * 585 * 0.0064 / (math.pi * 1140)))


def row_of(B, pull, length):
    row = np.empty(18)
    fill_hawser(row, Hawser("h", pull, length, "a", "b"), np.zeros(3), np.array(B, float))
    return row


def test_a_hawser_pulls_along_its_chord_and_its_stiffness_is_that_of_its_force():
    """3:4 in space, 10 m apart, 9.5 m long: T(0.5) of T = 1e5 e + 4e5 e², up on the anchor, down on the other end"""
    e = np.linspace(0.0, 2.0, 201)
    pull = pull_of_points("h", e, 1e5 * e + 4e5 * e * e)
    row, T = row_of((3.6, 4.8, 8.0), pull, 9.5), 1e5 * 0.5 + 4e5 * 0.25
    assert row[0] == State.SUSPENDED
    assert row[1:5] == pytest.approx([0.6 * T, 0.6 * T, -0.8 * T, 0.8 * T], rel=1e-6)
    h = 1e-4

    def force(x, z):
        return row_of((x, 0.0, z), pull, 9.5)[[2, 4]]

    xx, zx = (force(6.0 + h, 8.0) - force(6.0 - h, 8.0)) / (2 * h)
    xz, zz = (force(6.0, 8.0 + h) - force(6.0, 8.0 - h)) / (2 * h)
    assert row[6:9] == pytest.approx([xx, -xz, xz], rel=1e-3) and row[9:12] == pytest.approx([xx, -xz, xz], rel=1e-3)
    assert row[12:15] == pytest.approx([-zx, zz, -zz], rel=1e-3) and row[15:18] == pytest.approx(
        [zx, -zz, zz], rel=1e-3
    )
    slack = row_of((3.6, 4.8, 8.0), pull, 10.0)
    assert slack[0] == State.SLACK and not slack[1:].any()


def test_an_elongation_is_found_within_the_table_and_beyond():
    pull = pull_of_points("h", [0.0, 1.0, 2.0], [0.0, 1e5, 2e5])
    assert [elongation_at(pull, T) for T in (0.0, 5e4, 2e5, 9e5)] == pytest.approx([0.0, 0.5, 2.0, 9.0], rel=1e-9)


def test_strains_and_tables_of_lines_are_told():
    """T/EA of the softest segment; a hawser knows its own; beyond its table it is told"""
    kind = LineType("w", 100.0, 2e7)
    two = CompositeLine("c", (Segment(10.0, 50.0, 4e7), Segment(10.0, 50.0, 1e7)), "a", "p")
    pull = pull_of_points("h", [0.0, 2.0], [0.0, 2e5])
    lines = [UniformLine("u", kind, 20.0, "a", "p"), two, Hawser("h", pull, 9.0, "a", "p", most=2e5)]
    made = System(
        50.0, lines, [Anchor("a", (0.0, 0, -20.0)), Fairlead("p", "s", (15.0, 0, 0))], [MooredBody("s", freedom=())]
    )
    assert strains(made, np.array([1e5, 1e5, 1e5])) == pytest.approx([0.005, 0.01, 0.0])
    assert not list(beyond_tables(made, np.array([9e9, 9e9, 2e5])))
    (said,) = beyond_tables(made, np.array([0.0, 0.0, 2.01e5]))
    assert "extrapolated linearly: h 201 kN, table to 200 kN; extend" in said


def test_a_freedom_has_the_name_of_its_body_or_point():
    made = System(
        50.0,
        [
            UniformLine("u", LineType("w", 1.0, 1e7), 30.0, "a", "q"),
            UniformLine("v", LineType("w", 1.0, 1e7), 30.0, "q", "p"),
        ],
        [Anchor("a", (0, 0, -20.0)), FreePoint("q", (9.0, 0, -9.0)), Fairlead("p", "s", (0, 0, 0))],
        [MooredBody("s")],
    )
    assert [freedom_name(made, i) for i in (0, 5, 6, 8)] == ["s surge", "s yaw", "q x", "q z"]


def test_legs_go_out_from_the_corners_at_mirrored_headings():
    """Of a hull of 100 by 40 m: headings 30 and 60° from ahead, outwards on each side and end"""
    line = UniformLine("c", LineType("chain", 1000.0, 1e9), 200.0, "", "")
    legs = corner_legs(line, 100.0, 40.0, np.radians([30, 60]), 30.0, 2e5, 1.0)
    assert [leg.line.name for leg in legs] == [
        f"{end} {side} {n}" for end in ("fore", "aft") for side in ("port", "starboard") for n in (1, 2)]  # fmt: skip
    for leg in legs:
        sx, sy = (1 if "fore" in leg.line.name else -1), (1 if "port" in leg.line.name else -1)
        assert leg.fairlead == (50.0 * sx, 20.0 * sy, 1.0) and leg.anchor[2] == -30.0
        away = np.subtract(leg.anchor, leg.fairlead)[:2] * [sx, sy]
        angle = math.radians(30 if leg.line.name.endswith("1") else 60)
        assert math.atan2(away[1], away[0]) == pytest.approx(angle, rel=1e-9)
    made = moored_body(legs, 30.0, (1.0, 2.0, 3.0), 1010.0, 9.7, "barge")
    assert (made.density, made.gravity, made.bodies[0].name) == (1010.0, 9.7, "barge")
    assert made.bodies[0].position[:3] == (1.0, 2.0, 3.0)
    assert made.points[1].position == pytest.approx((49.0, 18.0, -2.0))
    assert rest(made).lines.horizontal_b == pytest.approx(np.full(8, 2e5), rel=1e-6)


@pytest.mark.parametrize("share, regime", [(0.99, Regime.SLACK_TAUT), (1.01, Regime.FREE_FALL)])
def test_a_line_falls_freely_where_its_centroid_is_thrown_with_gravity(share, regime):
    """ω² Z = g"""
    chain = dict(weight=979.3, mass=114.94, diameter=0.1368)
    slow = harmonic_tension(280.0, 50.0, 300.0, amplitude=(1.5, 0.0), period=10.0, **chain)
    at = harmonic_tension(
        280.0, 50.0, 300.0, amplitude=(1.5, 0.0), period=10 * math.sqrt(slow.acceleration / share), **chain
    )
    assert at.acceleration == pytest.approx(share, rel=1e-9) and at.regime == regime
    none = harmonic_tension(280.0, 50.0, 300.0, amplitude=(0.0, 0.0), period=10.0, **chain)
    assert none.largest == pytest.approx(np.hypot(*none.mean)) and none.acceleration == 0.0
