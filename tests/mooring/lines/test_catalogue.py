"""Chain and rope by name, against printed tables and against each other."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from hakobune.mooring.lines.catalogue import CHAIN, FORMS, line_type
from hakobune.mooring.lines.system.parts import LineSystemError

PUBLISHED = Path(__file__).parents[2] / "published"
TONF = 9806.65


def printed_chain():
    lines = (PUBLISHED / "chain_loads_w22.csv").read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.mark.parametrize("row", printed_chain(), ids=lambda row: f"{row['diameter']} mm")
def test_chain_loads_are_the_printed_ones_to_the_kilonewton(row):
    for grade in ("R3", "R3S", "R4"):
        for kind in ("studlink", "studless"):
            made = line_type(f"{grade} {kind} {row['diameter']} mm")
            proof = row.get(f"{grade}_proof_{kind}") or row["R3_proof"]
            # coefficients are printed to three figures, the table to 1 kN
            assert made.breaking_load / 1e3 == pytest.approx(float(row[f"{grade}_break"]), abs=1.0)
            assert made.proof_load / 1e3 == pytest.approx(float(proof), abs=1.0)


def test_grade_3_of_36_mm_carries_four_times_the_load_of_the_tank_test_appendix():
    """SR179 report (1982), part IV, appendix 2: 26.4 tf at a factor of 4 asks for 36 mm of grade 3."""
    assert line_type("grade 3 36 mm").breaking_load >= 4 * 26.4 * TONF > line_type("grade 3 34 mm").breaking_load


def test_chain_of_floater_a_weighs_and_holds_what_the_report_says():
    """SR179 report (1982), table 3.5.5.2: 142 mm, 406 kgf/m in water, 1700 tonf; ORQ is the nearest of the grades."""
    made = line_type("ORQ 142 mm")
    assert made.weight / 9.80665 == pytest.approx(406, rel=0.02)
    assert made.breaking_load / TONF == pytest.approx(1700, rel=0.22)


def test_moduli_are_those_of_the_elastic_catenary_models():
    """84 mm R4 studless: (5.45 - 0.0025 d) 1e10 over two bars; 100 mm studlink 5.6e10."""
    assert line_type("R4 studless 84 mm").axial_stiffness == pytest.approx(5.24e10 * np.pi / 2 * 0.084**2)
    assert line_type("R4 studlink 100 mm").axial_stiffness == pytest.approx(8.796e8, rel=1e-3)


@pytest.mark.parametrize("d", [20, 76, 150])
def test_better_grades_hold_more_and_proof_is_below_break(d):
    order = ["1", "2", "3", "orq", "r3", "r3s", "r4", "r4s", "r5"]
    loads = [CHAIN[g].breaking for g in order]
    assert loads == sorted(loads)
    for grade in CHAIN.values():
        assert grade.proof_studlink < grade.breaking
        assert (grade.proof_studless or 0) <= grade.proof_studlink
    assert line_type(f"R5 studless {d} mm").breaking_load > line_type(f"R3 studless {d} mm").breaking_load


def test_wire_is_that_of_its_standard():
    """EN 12385-4 (2002): 6x36 IWRC 1960, 40 mm: 0.356 x 40² x 1960 N and 6.54 kg/m."""
    made = line_type("wire 6x36 IWRC 1960 40 mm")
    assert made.breaking_load == pytest.approx(1116e3, rel=1e-3)
    assert made.mass == pytest.approx(6.54, rel=1e-3)
    assert line_type("wire 6x36 IWRC 40 mm").breaking_load == pytest.approx(0.356 * 1600 * 1770)


def test_wire_is_five_to_seven_times_as_strong_for_its_weight_as_the_chain_of_its_day():
    """SR179 report (1982), part IV, section 2.1."""
    chain, wire = line_type("grade 3 76 mm"), line_type("spiral strand 76 mm")
    assert 4 < (wire.breaking_load / wire.mass) / (chain.breaking_load / chain.mass) < 7


def test_fibre_ropes_weigh_less_in_water_than_wire_and_hmpe_floats():
    assert 0 < line_type("polyester 150 mm").weight < line_type("spiral strand 76 mm").weight
    assert line_type("HMPE 100 mm").weight < 0 < line_type("nylon 100 mm").weight
    soft, middle, stiff = (line_type(f"{name} 100 mm") for name in ("nylon", "polyester", "HMPE"))
    assert soft.axial_stiffness < middle.axial_stiffness < stiff.axial_stiffness


def test_every_printed_form_is_understood():
    for form in FORMS:
        words = [part.split("|")[-1].strip("[]") for part in form.split()]
        assert line_type(" ".join(words)).breaking_load > 0


UNKNOWN = [
    *(
        "",
        "76 mm",
        "R3 76 mm",
        "R9 studless 76 mm",
        "grade 3 studless 60 mm",
        "wire 7x7 FC 20 mm",
        "R3 studless 7.6.1 mm",
    ),
    *("wire 6x19 FC 1500 20 mm", "rubber 3 mm", "R3 studless 76", "R3 studless 500 mm", "nylon 0 mm"),
]


@pytest.mark.parametrize("name", UNKNOWN)
def test_unknown_names_are_refused_in_one_line_with_what_is_known(name):
    with pytest.raises(LineSystemError, match=r"allowed|comes") as fault:
        line_type(name)
    assert "\n" not in str(fault.value)


@pytest.mark.parametrize(
    ("name", "d", "across", "along"),
    [
        ("R3 studlink 142 mm", 0.142, 2.6, 1.4),
        ("grade 3 76 mm", 0.076, 2.6, 1.4),
        ("R4 studless 84 mm", 0.084, 2.4, 1.15),
        ("wire 6x36 IWRC 60 mm", 0.060, 1.8, None),
        ("spiral strand 90 mm", 0.090, 1.6, None),
        ("polyester 160 mm", 0.160, 1.6, None),
    ],
)
def test_drag_is_that_of_its_standard_on_the_nominal_diameter(name, d, across, along):
    """DNV-OS-E301 (2013) ch. 2 sec. 2; here coefficients are on D of the displaced volume, and along the line on πD"""
    kind = line_type(name)
    assert kind.dynamics.drag_normal * kind.diameter == pytest.approx(across * d, rel=1e-12)
    if along is not None:
        assert kind.dynamics.drag_tangential * np.pi * kind.diameter == pytest.approx(along * d, rel=1e-12)


@pytest.mark.parametrize("grade, break_load, studlink, studless, modulus", [
    ("grade 1", 9.80665e-3, 6.864655e-3, None, None), ("grade 2", 13.72931e-3, 9.80665e-3, None, None),
    ("grade 3", 19.6133e-3, 13.72931e-3, None, None), ("ORQ", 21.1137e-3, 14.0039e-3, None, None),
    ("R3", 0.0223, 0.0156, 0.0156, (5.40, 0.0040)), ("R3S", 0.0249, 0.0180, 0.0174, (5.40, 0.0040)),
    ("R4", 0.0274, 0.0216, 0.0192, (5.45, 0.0025)), ("R4S", 0.0304, 0.0240, 0.0213, (5.45, 0.0025)),
    ("R5", 0.0320, 0.0251, 0.0223, (6.00, 0.0033)),
])  # fmt: skip
def test_grades_have_the_loads_and_moduli_of_their_rules(grade, break_load, studlink, studless, modulus):
    """kN over d² (44 − 0.08 d): IACS UR A1 in tonnes-force, API 2F, DNV-OS-E302; E301 for studless moduli, 1e10 N/m²"""
    d = 100.0
    size, bars = 1e3 * d * d * (44 - 8.0), math.pi / 2 * 0.1**2
    stud = line_type(f"{grade} studlink 100 mm" if modulus else f"{grade} 100 mm")
    assert (stud.breaking_load, stud.proof_load) == pytest.approx((break_load * size, studlink * size), rel=1e-5)
    assert stud.axial_stiffness == pytest.approx(5.6e10 * bars)
    assert stud.mass == pytest.approx(228.8 if grade == "ORQ" else 219.0)
    if modulus:
        bare = line_type(f"{grade} studless 100 mm")
        assert (bare.breaking_load, bare.proof_load) == pytest.approx((break_load * size, studless * size), rel=1e-9)
        assert bare.axial_stiffness == pytest.approx(1e10 * (modulus[0] - modulus[1] * d) * bars)
        assert bare.mass == pytest.approx(200.0)
        assert bare.weight == pytest.approx(200.0 * 9.80665 * (1 - 1025 / 7850))
        assert bare.diameter == pytest.approx(math.sqrt(4 * 200.0 / (math.pi * 7850)))
    else:
        with pytest.raises(LineSystemError):
            line_type(f"{grade} studless 100 mm")


@pytest.mark.parametrize("kind, K, W", [
    ("6x7 FC", 0.332, 0.345), ("6x7 IWRC", 0.359, 0.384), ("6x19 FC", 0.330, 0.359), ("6x19 IWRC", 0.356, 0.400),
    ("6x24 FC", 0.280, 0.318), ("6x36 FC", 0.330, 0.367), ("6x36 IWRC", 0.356, 0.409),
])  # fmt: skip
@pytest.mark.parametrize("strength, R", [("", 1770), ("1570 ", 1570), ("E ", 1320), ("G ", 1470), ("A ", 1620),
                                         ("B ", 1770)])  # fmt: skip
def test_wires_have_the_factors_of_their_standard(kind, K, W, strength, R):
    """EN 12385-4 (2002), 6x24 ISO 2408 (2004): K d² R N and W d²/100 kg/m, d in mm; strengths of JIS G 3525"""
    made = line_type(f"wire {kind} {strength}50 mm")
    assert (made.breaking_load, made.mass) == pytest.approx((K * 2500 * R, 25 * W), rel=1e-12)
    assert made.axial_stiffness == pytest.approx(7e10 * math.pi / 4 * 0.05**2) and made.proof_load is None
    assert made.dynamics.drag_normal * made.diameter == pytest.approx(1.8 * 0.05)


@pytest.mark.parametrize("name, mass, load, stiffness, material, drag", [
    ("polyester", 6.79, 3.08e6, 14 * 3.08e6, 1380.0, 1.6), ("nylon", 5.85, 2.3e6, 5 * 2.3e6, 1140.0, 1.6),
    ("HMPE", 4.96, 6.451e6, 56 * 6.451e6, 975.0, 1.6),
    ("spiral strand", 52.93, 10.22e6, 1.13e11 * math.pi / 4 * 0.01, 7850.0, 1.6),
])  # fmt: skip
def test_ropes_of_a_decimetre_are_those_of_nrel_s_library(name, mass, load, stiffness, material, drag):
    """Loads 308 d² MN, 207 d² + 230 d³ and 580 d² + 651 d³ MN of fibres; stiffness 14, 5 and 56 times the load"""
    made = line_type(f"{name} 100 mm", density=1000.0, gravity=10.0)
    assert (made.mass, made.breaking_load, made.axial_stiffness) == pytest.approx((mass, load, stiffness), rel=1e-12)
    assert made.weight == pytest.approx(10 * mass * (1 - 1000 / material), rel=1e-12)
    assert made.diameter == pytest.approx(math.sqrt(4 * mass / (math.pi * material)), rel=1e-12)
    assert made.dynamics.drag_normal * made.diameter == pytest.approx(drag * 0.1, rel=1e-12)


@pytest.mark.parametrize("name, low, high", [("R3 studless {} mm", 10.0, 220.0), ("nylon {} mm", 1.0, 500.0)])
def test_sizes_are_taken_up_to_what_is_made(name, low, high):
    for size in (low, high):
        assert line_type(name.format(size)).mass > 0
    for size in (0.99 * low, 1.01 * high):
        with pytest.raises(LineSystemError, match=rf"the size is .* {low:g} to {high:g}"):
            line_type(name.format(size))
