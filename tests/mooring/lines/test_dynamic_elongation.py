"""Moving lines whose stiffness is a table: against a number, statics, their own tangent and their energy."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, FairleadMotion, simulate
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays
from hakobune.mooring.lines.multi_segment.line import Segment, StaticLine

TABLE = ((0.0, 0.0), (0.02, 4e5), (0.05, 1.6e6), (0.1, 6e6))
SURGE = FairleadMotion.harmonic((0.0, 0.0, 0.0), (2j, 0.0, 0.0), 10.0)


def rope(stiffness, elements=24):
    return DynamicLine(DynamicSegment(300.0, 14.0, 40.0, 0.12, stiffness, elements), (-305.0, 0.0, -50.0), bed=None)


def test_a_table_of_one_slope_is_a_number():
    number, table = (
        simulate(rope(EA), SURGE, 20.0, check_mesh=False) for EA in (6e7, ((0.0, 0.0), (0.01, 6e5), (0.05, 3e6)))
    )
    assert np.allclose(number.tension_fairlead, table.tension_fairlead, rtol=1e-9)


def test_a_line_with_a_table_rests_as_its_statics_and_its_energy_is_the_work_under_the_table():
    line = rope(TABLE, 80)
    at_rest = start(line, (0.0, 0.0, 0.0), water_arrays(None, None, line.gravity))
    still = simulate(line, FairleadMotion.still((0.0, 0.0, 0.0)), 1e-3, check_mesh=False)
    exact = StaticLine([Segment(300.0, 40.0, TABLE)], bed=None).solve(305.0, 50.0)
    assert np.isclose(still.tension_fairlead[0], exact.tension_fairlead, rtol=2e-3)
    runs = [simulate(rope(TABLE), SURGE, 20.0, tolerance=t, check_mesh=False).energies for t in (1e-3, 1e-6)]
    gaps = [abs(E.work[-1] - E.supplied[-1]) / np.ptp(E.elastic) for E in runs]
    assert gaps[0] < 1e-3 and gaps[1] < 0.1 * gaps[0], gaps
    strain, tension = np.array(TABLE).T
    size = line.segments[0].size
    each = np.linalg.norm(np.diff(at_rest.position, axis=0), axis=1) / size - 1
    work = [np.trapezoid(np.interp(np.linspace(0, e, 4001), strain, tension), dx=e / 4000) * size for e in each]
    assert np.isclose(still.energies.elastic[0], sum(work), rtol=1e-6)


def test_a_stiffening_rope_pulls_more_the_farther_it_is_pulled_than_its_first_stiffness():
    soft = replace(rope(TABLE).segments[0], axial_stiffness=TABLE[1][1] / TABLE[1][0])
    peaks = [
        simulate(replace(rope(TABLE), segments=(s,)), SURGE, 20.0, check_mesh=False).tension_fairlead.max()
        for s in (rope(TABLE).segments[0], soft)
    ]
    assert peaks[0] > 1.2 * peaks[1]


@pytest.mark.parametrize("table", [((0.0, 0.0), (0.0, 1e5)), ((0.0, 1.0), (0.1, 1e5)), ((0.0, 0.0),)])
def test_what_is_no_table_of_strain_and_tension_is_refused(table):
    with pytest.raises(ValueError, match="axial_stiffness"):
        rope(table)
