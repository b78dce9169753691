"""Lines that move over hills and valleys, against the same line at rest, planes and the books of energy."""

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics.bed import ROUND
from hakobune.mooring.lines.dynamics.lumped.bed import plane_at
from hakobune.mooring.lines.dynamics.lumped.system import above_bed
from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, ElasticBed, FairleadMotion, simulate
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays
from hakobune.mooring.lines.multi_segment import line as static

WEIGHT, EA, MASS = 979.3, 4.933e8, 114.94
STILL = water_arrays(None, None, 9.80665)
BEDS = {
    "hill": ((0, 0), (60, 0), (110, 6), (160, 0), (400, 0)),
    "valley": ((0, 0), (80, 0), (130, -5), (180, -2), (400, 0)),
    "ridges": ((0, 0), (40, 3), (80, 0), (120, 3), (160, 0), (400, -4)),
}


def chain(elements, points=(), span=290.0, heading=0.0, **bed):
    """300 m in 50 m of water, its fairlead at the origin; the bed's course runs from the anchor to the fairlead."""
    drag = dict(drag_normal=1.333, drag_tangential=0.2034, added_tangential=0.5)
    segment = DynamicSegment(300.0, MASS, WEIGHT, 0.1368, EA, elements, **drag)
    anchor = (-span * np.cos(heading), -span * np.sin(heading), -50.0)
    return DynamicLine(segment, anchor, bed=ElasticBed(uphill=heading, points=points, **bed))


def quiet(line, motion, duration, **options):
    return simulate(line, motion, duration, check_mesh=False, **options)


@pytest.mark.parametrize("heading", [0.0, 2.0])
@pytest.mark.parametrize(("span", "friction"), [(285.0, 0.0), (289.0, 0.0), (289.0, 0.5)])
@pytest.mark.parametrize("name", BEDS)
def test_a_line_at_rest_over_hills_pulls_as_the_static_line_of_the_same_bed_does(name, span, friction, heading):
    points = np.array(BEDS[name], float)
    exact = static.StaticLine([static.Segment(300.0, WEIGHT, EA)], (), static.Bed(points, friction)).solve(span, 50.0)
    still = quiet(chain(150, points, span, heading, friction=friction), FairleadMotion.still((0, 0, 0)), 0.1)
    assert abs(still.tension_fairlead[0] / exact.tension_fairlead - 1) < 0.01
    # friction comes in pieces of an element
    piece = friction * WEIGHT * 2.0
    assert abs(still.tension_anchor[0] - exact.tension_anchor) < 0.01 * exact.tension_fairlead + 2 * piece


def test_points_on_a_slope_are_the_slope():
    runs = [
        quiet(line, FairleadMotion.harmonic((0, 0, 0), (2j, 0.5j, 0), 10.0), 15.0, tolerance=1e-5)
        for line in (
            chain(20, ((0, 0), (100, 5), (200, 10))),
            chain(20, slope=np.arctan(0.05)),
        )
    ]
    # over points the elastic layer is as thick as on a level bed: a millionth of a metre more
    assert np.isclose(runs[0].tension_fairlead.max(), runs[1].tension_fairlead.max(), rtol=1e-4)
    assert np.abs(runs[0].end.position - runs[1].end.position).max() < 1e-2


def test_energy_is_in_the_books_of_a_cycle_over_hills():
    run = quiet(chain(40, BEDS["ridges"], friction=0.4), FairleadMotion.harmonic((0, 0, 0), (2j, 1j, 0), 10.0), 40.0)
    E = run.energies
    work, lost, stored = (v[-1] - np.interp(30.0, run.time, v) for v in (E.work, E.lost, E.stored))
    assert work > 0 and abs(work - lost - stored) < 0.01 * work


def test_the_bed_is_smooth_and_leaves_its_facets_only_beside_their_edges():
    system = chain(10, BEDS["hill"], heading=0.7).system
    d = np.linspace(-50, 450, 20001)
    way = np.array([np.cos(0.7), np.sin(0.7)])
    facets = -static.Bed(BEDS["hill"]).depth_below(d, 0.0)
    q = np.column_stack([-290 * way + d[:, None] * way, facets - 50.0])
    off = above_bed(system, q) * np.hypot(1.0, np.gradient(facets, d))
    edge = np.min([np.abs(d - x) for x, _ in BEDS["hill"][1:-1]], axis=0) < 50 * ROUND + 0.1
    assert np.abs(off[~edge]).max() < 1e-9
    # at an edge that turns by s a parabola over ± r is s r/4 off: 0.24 over 5 m on the hill
    assert np.isclose(np.abs(off[edge]).max(), 0.24 * 5 / 4, rtol=0.02)
    normals = np.array([plane_at(system, x, y)[0] for x, y in q[::10, :2]])
    assert np.abs(np.diff(normals, axis=0)).max() < 1.01 * 0.24 * 0.25 / 10


def test_tangent_is_the_derivative_of_the_reaction_where_the_bed_bends(tangent_fault):
    plain = dict(drag_normal=0.0, drag_tangential=0.0, added_tangential=1.0)
    segment = DynamicSegment(300.0, MASS, WEIGHT, 0.1368, EA, 60, **plain)
    line = DynamicLine(segment, (-289.0, 0.0, -50.0), bed=ElasticBed(points=BEDS["ridges"], friction=0.4))
    rest, rng, n, cq, cv = start(line, (0, 0, 0), STILL), np.random.default_rng(1), line.elements + 1, 1e-3, 0.03
    # stiff elements would hide the bed, whose bend adds a thousandth of theirs
    system = line.system._replace(stiffness=np.full(60, 1e3), damping=np.zeros(60))
    moved = rest.position + 1e-3 * rng.standard_normal((n, 3))
    a, direction = rng.standard_normal((2, n, 3))

    assert tangent_fault(system, moved, np.zeros((n, 3)), a, direction, rest.position, cq, cv) < 1e-3


def test_points_that_are_no_bed_are_named():
    with pytest.raises(ValueError, match="without vertical walls"):
        ElasticBed(points=((0, 0), (0, 1)))
    with pytest.raises(ValueError, match="and bed points are given too; give one of them"):
        ElasticBed(slope=0.1, points=((0, 0), (10, 1)))
