"""Fatigue term by term: Dirlik's density summed, slopes over the mean tension, cycles, moments that are none."""

import math

import numpy as np
import pytest

from hakobune.mooring.criteria.fatigue import Curve, Cycles, curves, miner, rainflow_cycles
from hakobune.mooring.criteria.overuse import OF_STUDY, overused, shares
from hakobune.mooring.criteria.strength import (
    equipment_number,
    equipment_of_box,
    kind_and_size,
    larger_sizes,
    worn_breaking_load,
)

ROPE = Curve("rope", "share", 4.0, 2000.0, -3.0)


def test_each_cycle_counts_with_its_own_mean():
    """Ranges of 0.1 and 0.2 of 1 MN at means of 0.1 and 0.3: n s⁴/(2000 · 10^(−3 mean))"""
    cycles = Cycles(np.array([1e5, 2e5]), np.array([1e5, 3e5]), np.array([7.0, 0.5]))
    wanted = 7e-4 / (2000 * 10**-0.3) + 0.5 * 16e-4 / (2000 * 10**-0.9)
    assert miner(cycles, ROPE, 50.0, 1e6)[0] == pytest.approx(wanted, rel=1e-12)


def test_cycles_have_their_means():
    """Of 0, 6, 2, 4, 0 the small one closes about 3; what is left are two halves of range 6 about 3"""
    cycles = rainflow_cycles([0, 6, 2.5, 4, 0])
    found = sorted(zip(cycles.range, cycles.mean, cycles.count, strict=True))
    assert found == [(1.5, 3.25, 1.0), (6.0, 3.0, 0.5), (6.0, 3.0, 0.5)]


def test_stress_of_a_rope_is_over_its_circle_and_of_a_chain_over_both_legs():
    assert curves()["DNV stranded rope"].reference(80.0, 5e6) == pytest.approx(math.pi / 4 * 6400)
    assert curves()["DNV studless chain"].reference(80.0, 5e6) == pytest.approx(math.pi / 2 * 6400)
    assert curves()["DNV polyester"].reference(80.0, 5e6) == 5e6


def test_wear_leaves_at_least_half_of_a_chain():
    assert worn_breaking_load(1e6, 40.0, 1.0, 20.0) == pytest.approx(1e6 * 0.25 * 42.4 / 40.8, rel=1e-12)
    for allowance, years, says in ((1.0, 20.1, "leaves 19.9 mm of 40 mm"), (-0.1, 5.0, "wear is -0.1 mm a year")):
        with pytest.raises(ValueError, match=says):
            worn_breaking_load(1e6, 40.0, allowance, years)


def test_larger_sizes_are_the_next_of_the_kind():
    """Chain in steps of 2 mm to 98 and of 5 mm beyond, rope in steps of 4 and 8 mm"""
    assert larger_sizes("R3 studless 76 mm", 2) == ["R3 studless 78 mm", "R3 studless 80 mm"]
    assert larger_sizes("grade 3 98 mm", 2) == ["grade 3 100 mm", "grade 3 105 mm"]
    assert larger_sizes("polyester 60 mm", 3) == ["polyester 64 mm", "polyester 72 mm", "polyester 80 mm"]
    assert larger_sizes("wire 6x36 IWRC 1960 256 mm", 9) == []
    assert kind_and_size("R3 studless 76 mm") == ("R3 studless", 76.0)


def test_equipment_number_of_a_box_is_of_its_sides_above_water():
    """8000 t, 100 × 30 m, 4 m of freeboard: front 120 m², side 400 m²; LR 400 + 2.5 · 120 + 40, NV without the side"""
    found = dict(equipment_of_box({"length": 100.0, "beam": 30.0, "draft": 9.0}, 4.0, 8e6))
    assert found["LR"] == pytest.approx(740) and found["AB"] == pytest.approx(680) and found["NV"] == pytest.approx(520)
    assert found["GL"] == pytest.approx(700) and len(found) == 7
    assert equipment_of_box({"length": 100.0, "beam": 30.0}, None, 8e6) == []
    assert equipment_of_box({"radius": 10.0, "beam": 3.0}, 4.0, 8e6) == []
    with pytest.raises(ValueError, match="displacement is 0 t"):
        equipment_number("LR", 0.0)
    assert equipment_number("NV", 1e-9) > 0


def test_lines_that_part_and_lines_above_what_is_allowable_are_told_apart():
    """Just at a limit is neither; the largest first; a load that none stands has no number"""
    names, used = ("a", "b", "c", "d", "e"), [0.4, 0.401, 1.0, 1.001, np.nan]
    parted, above = overused(names, used, 0.4, "in the storm")
    assert parted.startswith(
        "FAILS: 1 of 5 lines in the storm beyond the breaking load, limit 100 %, at which they break: d 100.1 %"
    )
    assert "2 more of 5 lines in the storm above the allowable 40 % of the breaking load: c 100 %, b 40.1 %;" in above
    assert above.endswith(OF_STUDY) and "the study's own key allowable, not that of a rule set" in OF_STUDY
    (alone,) = overused(names[:2], [0.4, 0.401], 0.4, "at rest")
    assert "1 of 2 lines at rest above" in alone
    assert list(overused(names[:1], [0.4], 0.4, "")) == [] and len(list(overused(names[:1], [1.2], 1.0, ""))) == 1
    assert shares(("x", "y"), [np.inf, 0.5]) == "x infinitely, y 50 %"
