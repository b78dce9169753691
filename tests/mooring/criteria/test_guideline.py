"""Numbers that the guideline of the SR179 report (1982), chapter 4, prints or that follow from its formulas.

What belongs to one module alone is beside that module: spectra and their periods, JONSWAP by fetch, gusts and the band
of the report, cosⁿ spreading (`tests/mooring/environment`), white-noise motion (`tests/mooring/studies`).
"""

import csv
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from hakobune.mooring.criteria.strength import SOCIETIES, equipment_number
from hakobune.mooring.environment.wind_profile import speed_at
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.loads.members import C_D
from hakobune.mooring.loads.on_hull import current_on, turning_drag
from hakobune.mooring.response.return_period import return_period
from hakobune.mooring.studies.conditions import ExposedBox

TONF = 9806.65
TABLES = Path(__file__).parents[2] / "published"


def printed(name):
    lines = (TABLES / name).read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.mark.parametrize(
    ("life", "probability", "years"),
    [
        (20, 0.5, 29.36),
        (50, np.exp(-1), 50.50),  # 1/(1 − e^(−1/50)); 50.8 stands beside the formula in one reading of the report
    ],
)
def test_return_periods_have_the_digits_of_the_formula(life, probability, years):
    """SR179 (1982), chapter 4, 3.2: R = 1/(1 − q^(1/T))"""
    assert float(return_period(life, probability)) == pytest.approx(years, abs=5e-3)


@pytest.mark.parametrize("row", printed("guideline_wind.csv"), ids=lambda row: f"from {row['from_m']} m")
def test_wind_over_height_has_the_printed_factor_at_both_ends_of_its_band(row):
    """Table 1"""
    low, high = float(row["from_m"]), float(row["below_m"] or 400.0)
    for z in (max(low, 0.01), 0.5 * (low + high), high - 1e-9):
        assert float(speed_at(z, 10.0)) == pytest.approx(10.0 * float(row["C_H"]), abs=1e-9)


def test_drag_of_members_in_wind_is_the_printed_one():
    """Table 2"""
    assert C_D == {
        "sphere": 0.4, "cylinder": 0.5, "hull side": 1.0, "deck house": 1.0, "isolated member": 1.5,
        "underside, smooth": 1.0, "underside, exposed beams": 1.3, "derrick, each face": 1.25,
    }  # fmt: skip


@pytest.mark.parametrize("d", [26, 36, 76, 142])
def test_chain_has_weight_proof_and_breaking_load_of_table_4_2_2_1(d):
    size = d * d * (44 - 0.08 * d)
    for name, weight, proof, breaking in (("grade 3", 0.0219, 1.4, 2.0), ("ORQ", 0.02288, 1.428, 2.153)):
        made = line_type(f"{name} {d} mm")
        assert made.mass == pytest.approx(weight * d * d, rel=1e-12)
        assert made.proof_load == pytest.approx(proof * size * TONF / 1e3, rel=1e-12)
        assert made.breaking_load == pytest.approx(breaking * size * TONF / 1e3, rel=1e-12)


def test_chain_of_appendix_2_is_sized_as_printed():
    """26.4 t at a factor of 4: 105.6 tf.  Grade 3 of 36 mm has 106.6 tf, and 36 mm is printed.

    Grade 2 is printed as 42 mm; by the societies' 1.4 d² (44 − 0.08 d) 42 mm has 100.4 tf, a factor of 3.80, and 44 mm
    is the first that has 4.  Its formula is not printed, so the print is not in reach of its own numbers.
    """
    assert line_type("grade 3 36 mm").breaking_load / TONF == pytest.approx(106.6, abs=0.05)
    assert line_type("grade 2 42 mm").breaking_load / TONF == pytest.approx(100.4, abs=0.05)
    for grade, size, below in (("grade 3", 36, 34), ("grade 2", 44, 42)):
        carried = [line_type(f"{grade} {d} mm").breaking_load / (4 * 26.4 * TONF) for d in (size, below)]
        assert carried[0] >= 1 > carried[1]


@pytest.mark.parametrize("row", printed("guideline_equipment.csv"), ids=lambda row: row["society"])
def test_equipment_numbers_are_the_printed_formulas(row):
    """Table 4.3.1, its formula read as it stands: W t, B and h m, A, A_N, A_P, A_F, A_L m²"""
    values = {"W": 51250.0, "B": 50.0, "h": 10.0, "A": 1000.0, "A_N": 500.0, "A_P": 1000.0, "A_F": 500.0, "A_L": 1000.0}
    known = {"height_times_breadth": 500.0, "front": 500.0, "side": 1000.0}
    number = eval(row["formula"].replace("^", "**"), {"__builtins__": {}}, values)
    assert equipment_number(row["society"], values["W"], **known) == pytest.approx(number, rel=1e-12)


def test_every_society_with_a_formula_is_there():
    assert {row["society"] for row in printed("guideline_equipment.csv")} == set(SOCIETIES)


def test_resistance_to_turning_is_the_cross_flow_along_the_hull():
    """Part III, 5: 0.125 ρ C_y d {(L/2 − G)⁴ + (L/2 + G)⁴} at G = 0 is ∫ ½ρ C_y d |x| x² dx of a unit yaw rate"""
    from hakobune.mooring.loads.box_current import box_table

    hull = ExposedBox(100.0, 50.0, 10.0, 10.0)
    C = float(box_table(100.0, 50.0, 10.0, 20.0).curve(np.pi / 2)[1])
    strip = quad(lambda x: 0.5 * 1025 * C * 10.0 * abs(x) * x * x, -50.0, 50.0, points=[0.0])[0]
    assert turning_drag(current_on(None, hull, 1025.0, 20.0), hull.length) == pytest.approx(strip, rel=1e-9)
    assert strip == pytest.approx(0.125 * 1025 * C * 10.0 * 2 * 50.0**4, rel=1e-9)
