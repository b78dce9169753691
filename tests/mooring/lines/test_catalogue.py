"""Chain and rope by name, against printed tables and against each other."""

import csv
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
