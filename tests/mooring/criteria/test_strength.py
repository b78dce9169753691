"""Sizes by a safety factor, wear, equipment numbers"""

import pytest

from hakobune.mooring.criteria.strength import equipment_number, worn_breaking_load


def test_wear_takes_what_the_formula_of_breaking_loads_says():
    from hakobune.mooring.lines.catalogue import line_type

    new, left = (line_type(f"grade 3 {d} mm").breaking_load for d in (60, 54))
    assert worn_breaking_load(new, 60.0, 0.4, 15.0) == pytest.approx(left, rel=1e-12)
    with pytest.raises(ValueError, match="at least half"):
        worn_breaking_load(new, 60.0, 3.0, 15.0)


def test_equipment_numbers_differ_by_what_each_society_counts():
    """Table 4.3.1 of SR179 (1982), by hand: Δ = 8000 t gives Δ^(2/3) = 400"""
    areas = {"height_times_breadth": 100.0, "front": 120.0, "side": 300.0}
    numbers = {"LR": 730, "AB": 630, "NV": 520, "BV": 670, "GL": 700, "NK": 630, "NK semisubmersible": 670}
    for society, number in numbers.items():
        assert equipment_number(society, 8000.0, **areas) == pytest.approx(number, abs=1e-9)
    with pytest.raises(ValueError, match="allowed: LR"):
        equipment_number("RI", 8000.0)
