"""Tables of lines with segments: the forces of their own solver, to the error that the table says."""

from dataclasses import replace

import numpy as np
import pytest

from mooring.lines.multi_segment.segments import PointLoad, Segment
from mooring.lines.system.composite import of_line, solution
from mooring.lines.system.parts import CompositeLine
from mooring.motion.force_tables import packed, packed_pull, tabulate
from mooring.motion.simulation import moored, simulate
from mooring.motion.weather import Settings, Weather
from mooring.studies.conditions import Current

TONF = 9806.65


def with_sinker():
    def chain(length):
        return Segment(length, 0.406 * TONF, 221700 * TONF, 0.142, 1700 * TONF)

    return CompositeLine("sinker", (chain(260.0), chain(50.0)), "a", "b", (PointLoad(260.0, 100 * TONF),))


@pytest.fixture(scope="module")
def table():
    return tabulate(of_line(with_sinker(), 0, "a", -20.0), 1700 * TONF, 305.0, 20.0, (20.0, 4.0))


def test_forces_between_the_nodes_are_those_of_the_solver(table):
    one, rng = of_line(with_sinker(), 0, "a", -20.0), np.random.default_rng(2)
    tables, off = packed([table, table]), []
    for c, z in zip(rng.uniform(286, table.chords[-1], 60), rng.uniform(16.5, 23.5, 60), strict=True):
        x = np.sqrt(c * c - z * z)
        found = solution(one, np.zeros(3), np.array([x, 0.0, z]))
        wanted = np.array([found.horizontal_fairlead, found.vertical_fairlead])
        size = max(np.hypot(*wanted), np.hypot(*table.values[-1, 0, :, 0]) * 0.02)
        off.append(np.abs(packed_pull(tables, 1, x, z) - wanted).max() / size)
    assert np.mean(np.array(off) <= table.error) >= 0.9 and table.error <= 0.01  # kinks lie between nodes, too


def test_beyond_the_table_there_is_no_force_and_below_it_a_slack_one(table):
    tables = packed([table])
    assert np.isnan(packed_pull(tables, 0, table.chords[-1] + 1, 20.0)[0])
    assert np.isnan(packed_pull(tables, 0, 300.0, 30.0)[0])
    assert packed_pull(tables, 0, 100.0, 20.0) == packed_pull(tables, 0, table.chords[0], 20.0)


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
