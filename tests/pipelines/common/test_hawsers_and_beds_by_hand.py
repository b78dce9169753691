"""Hawsers of springs and tables at a tension, beds under an anchor, and types of lines that are all looked at."""

import math

import pytest

from hakobune.pipelines.common import line_tables
from hakobune.pipelines.common.line_tables import OwnBedTable, TypeTable
from hakobune.pipelines.common.quantities import StudyError


@pytest.mark.parametrize(("points", "level", "says"), [
    ([[0.0, 0.0], [50.0, 10.0]], -10.0, None), ([[0.0, 5.0], [50.0, 15.0]], -10.0, None),
    ([[0.0, 0.0], [50.0, 10.5]], -10.0, r"\[1\] is \[50, 10\.5\], 0\.5 m above still water; allowed: z up to 10"),
    ([[0.0, 5.0], [9.0, 0.0], [90.0, 17.0]], -10.0, r"\[2\] is \[90, 17\], 2 m above still water; allowed: z up to 15"),
])  # fmt: skip
def test_a_bed_stays_below_still_water_from_the_level_of_its_anchor(points, level, says):
    """Its first point lies at the anchor, at z = −10 m: others may be 10 m higher than that"""
    if says is None:
        line_tables.check_bed("bed", points, level)
        assert line_tables._own_bed("lines[0]", OwnBedTable(points=points), 0.5, level) is not None
        return
    with pytest.raises(StudyError, match=says):
        line_tables.check_bed("bed", points, level)
    with pytest.raises(StudyError, match=r"lines\[0\]\.bed\.points"):
        line_tables._own_bed("lines[0]", OwnBedTable(points=points), 0.5, level)


def test_a_line_without_a_bed_has_none_of_its_own():
    assert line_tables._own_bed("x", None, 0.5, -10.0) is None
    assert line_tables._own_bed("x", OwnBedTable(points=[]), 0.5, -10.0) is None


SPRING = TypeTable(spring_kN_per_m=20.0, breaking_load_kN=900.0)
BOTH = TypeTable(spring_kN_per_m=20.0, tension_kN=[1.0])


def test_every_type_is_looked_at_the_last_as_the_first():
    line_tables.check_types({"a": SPRING, "b": SPRING})
    for types in ({"a": BOTH, "b": SPRING}, {"a": SPRING, "b": BOTH}):
        with pytest.raises(StudyError, match="has both a spring and a table"):
            line_tables.check_types(types)


def test_a_spring_is_as_much_shorter_as_its_tension_stretches_it():
    """100 kN over 20 kN/m are 5 m of 40 m"""
    made = line_tables.hawser_at_tension("lines[0]", "h", "s", SPRING, 40.0, 1e5)
    assert made.length == pytest.approx(35.0)
    with pytest.raises(StudyError, match=r"over 4 m the unstretched spring would be -1 m long"):
        line_tables.hawser_at_tension("lines[0]", "h", "s", SPRING, 4.0, 1e5)


def test_a_rope_of_a_table_is_as_long_as_leaves_its_strain():
    """Straight to 200 kN at 10 %: 100 kN is 5 % of 42 m / 1.05 = 40 m"""
    kind = TypeTable(elongation_percent=[0.0, 10.0], tension_kN=[0.0, 200.0], breaking_load_kN=400.0)
    made = line_tables.hawser_at_tension("lines[0]", "h", "s", kind, 42.0, 1e5)
    assert made.length == pytest.approx(40.0, rel=1e-6) and math.isfinite(made.length)
