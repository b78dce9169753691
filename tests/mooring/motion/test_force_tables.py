"""Tables of lines with segments: the forces of their own solver, to the error that the table says."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.composite import of_line, solution
from hakobune.mooring.lines.system.parts import CompositeLine
from hakobune.mooring.motion.force_tables import TOLERANCE, _with_twist, packed, packed_pull, tabulate
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Current

TONF = 9806.65


def with_sinker(lower=260.0):
    def chain(length):
        return Segment(length, 0.406 * TONF, 221700 * TONF, 0.142, 1700 * TONF)

    return CompositeLine("sinker", (chain(lower), chain(50.0)), "a", "b", (PointLoad(lower, 100 * TONF),))


@pytest.fixture(scope="module")
def table():
    return tabulate(of_line(with_sinker(), 0, "a", -20.0), 1700 * TONF, 305.0, 20.0, (20.0, 4.0))


def test_forces_anywhere_are_those_of_the_solver_to_the_error_that_the_table_says(table):
    one, rng = of_line(with_sinker(), 0, "a", -20.0), np.random.default_rng(2)
    tables, off = packed([table, table]), []
    rest = np.hypot(*packed_pull(tables, 0, 305.0, 20.0))
    for c, z in zip(rng.uniform(*table.ends[0], 150), rng.uniform(*table.ends[1], 150), strict=True):
        x = np.sqrt(c * c - z * z)
        found = solution(one, np.zeros(3), np.array([x, 0.0, z]))
        wanted = np.array([found.horizontal_fairlead, found.vertical_fairlead])
        off.append(np.abs(packed_pull(tables, 1, x, z) - wanted).max() / max(np.hypot(*wanted), rest))
    assert max(off) <= table.error <= 2 * TOLERANCE and table.coarse == 0.0


def test_a_line_as_long_above_its_sinker_as_the_water_is_deep_is_read_where_it_becomes_a_wall():
    """50 m of chain over the sinker in 50 m: the pull rises from 0.2 to 1.2 MN within a metre, along a circle"""
    line = with_sinker(420.0)
    table = tabulate(of_line(line, 0, "a", -50.0), 1700 * TONF, 441.0, 50.0, (8.0, 2.0))
    one, tables, rng = of_line(line, 0, "a", -50.0), packed([table]), np.random.default_rng(4)
    rest, off = np.hypot(*packed_pull(tables, 0, 441.0, 50.0)), []
    for c, z in zip(rng.uniform(437.0, 446.0, 60), rng.uniform(48.0, 52.0, 60), strict=True):
        x = np.sqrt(c * c - z * z)
        found = solution(one, np.zeros(3), np.array([x, 0.0, z]))
        wanted = np.array([found.horizontal_fairlead, found.vertical_fairlead])
        off.append(np.abs(packed_pull(tables, 0, x, z) - wanted).max() / max(np.hypot(*wanted), rest))
    assert max(off) <= table.error <= 3 * TOLERANCE


def test_a_taut_line_pulls_on_with_its_stiffness_beyond_the_table_and_below_it_as_at_its_end(table):
    tables, one = packed([table]), of_line(with_sinker(), 0, "a", -20.0)
    c = table.ends[0, 1] + 1.0
    x = np.sqrt(c * c - 400.0)
    found = solution(one, np.zeros(3), np.array([x, 0.0, 20.0]))
    pull = packed_pull(tables, 0, x, 20.0)
    assert pull[0] == pytest.approx(found.horizontal_fairlead, rel=0.01)
    assert np.isnan(packed_pull(tables, 0, 300.0, 30.0)[0]) and np.all(np.isnan(packed_pull(tables, 0, np.inf, 20.0)))
    least = np.sqrt(table.ends[0, 0] ** 2 - 400.0)
    assert packed_pull(tables, 0, 100.0, 20.0) == pytest.approx(packed_pull(tables, 0, least, 20.0))


def test_a_uniform_line_in_segments_moves_the_body_as_a_uniform_line(database, on_chains):
    system = on_chains.system
    cut = []
    for line in system.lines:
        kind = line.type
        part = Segment(line.length / 2, kind.weight, kind.axial_stiffness, 0.142, kind.breaking_load)
        cut.append(CompositeLine(line.name, (part, part), line.a, line.b))
    pieces = moored(database, replace(system, lines=cut), on_chains.hull, memory=on_chains.memory)
    weather, settings = Weather(current=Current(1.5, 0.5)), Settings(duration=100.0, ramp=50.0)
    whole, made = (simulate(one, weather, settings) for one in (on_chains, pieces))
    size = np.abs(whole.motion).max(axis=0)
    assert np.abs(made.motion - whole.motion).max(axis=0) == pytest.approx(0, abs=5e-3 * size[:3].max())
    assert np.abs(made.tension - whole.tension).max() <= 0.02 * whole.tension.max()


def test_the_mixed_derivatives_of_a_product_are_its_factor_at_every_corner():
    """3cz + c² − 2z over 2 by 0.5: 3 everywhere, beside f, 3z + 2c and 3c − 2"""
    dc, dz, corners = 2.0, 0.5, []
    for z in (0.0, dz):
        for c in (0.0, dc):
            corners.append([[3 * c * z + c * c - 2 * z, 3 * z + 2 * c, 3 * c - 2]] * 2)
    made = _with_twist(np.array(corners), dc, dz)
    assert made.shape == (2, 4, 4) and made[:, :, 3] == pytest.approx(np.full((2, 4), 3.0))
    assert made[1, :, 0] == pytest.approx([0, 4, -1, 6]) and made[0, :, 2] == pytest.approx([-2, 4, -2, 4])
