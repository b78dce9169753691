"""Every step that a static line can take over its bed: in equilibrium at each of its points, and its derivatives.

Equilibrium by differences along the profile, with nothing of what found it: a free element holds its weight in water,
d(T t)/ds = (0, w), and is as long as 1 + T/EA (or a table) makes it; on the bed T falls by w (sin β + μ cos β) where
the line slides up towards the fairlead, down to nothing.  Derivatives of the equations by differences of them.
"""

import math
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest
from plain import plain

line, search = plain("mooring.lines.multi_segment.line"), plain("mooring.lines.multi_segment.search")
newton = plain("mooring.lines.multi_segment.newton")
Bed, Line, Load, Segment = line.Bed, line.StaticLine, line.PointLoad, line.Segment
line._search = lambda: search


def made(segments, loads, bed, friction, x, z, surface=np.inf):
    """Line of segments (length, weight, EA), loads (position, weight, in air) over points of a bed or at one slope"""
    bed = Bed.sloping(bed, friction) if np.ndim(bed) == 0 else Bed(np.array(bed, float), friction)
    return Line([Segment(*one) for one in segments], [Load(*one) for one in loads], bed, surface), x, z


ROPE = ((0.0, 0.0), (0.01, 500.0), (0.02, 2500.0))  # stiffer as it stretches
HILLS = [(0, 0), (40, -6), (80, 4), (150, 0)]
LINES = {
    "touches the bed": made([(100, 10, 1e5)], [], 0.05, 0.4, 90, 30),
    "a rope that stiffens": made([(60, 10, ROPE), (60, 12, ROPE)], [], 0.0, 0.8, 104, 30),
    "a bight of rope": made([(110, 10, ROPE)], [], [(0, 0), (5, -60), (100, -60)], 0.3, 70, 10),
    "taut": made([(60, 10, ROPE), (50, 60, 1e5)], [(70, 300.0)], 0.0, 0.0, 107, 30),
    "sinker on the bed": made([(60, 10, 1e5), (60, 30, 1e6)], [(40, 500)], 0.1, 0.5, 104, 36),
    "sinker and buoy": made([(50, 20, 1e6)], [(12, -1500), (19, 1500)], [(0, 0), (30, 6), (50, 6)], 0.3, 28, 26),
    "lifted off the bed": made([(50, 60, 1e5)], [(5, -1500)], -0.3, 0.6, 21, 23, 30),
    "floating": made([(120, 10, 1e6)], [(85, -2000)], 0.05, 0.4, 104, 29, 30),
    "two that float": made([(120, 10, 1e6)], [(65, -1500), (95, -1500)], 0.05, 0.4, 105, 25, 30),
    "out of the sea": made([(120, 10, 1e6)], [(85, -200, 100)], 0.05, 0.4, 98, 50, 30),
    "over hills": made([(150, 10, 1e5)], [(60, 300)], HILLS, 0.3, 135, 30),
    "over an edge": made([(70, 8, 1e5)], [(16, 1500), (61, 1500)], [(0, 0), (20, 6), (40, 0), (70, 6)], 0.3, 63, 20),
    "off an edge": made(
        [(50, 8, 1e5), (70, 8, 1e5)], [], [(0, 0), (20, -10), (60, -4), (80, 14), (110, 0)], 0.1, 114, 30
    ),
    "down to an edge": made([(150, 10, 1e5)], [], [(0, 0), (40, -2), (80, 30), (150, 60)], 0.1, 100, 70),
    "sinker down to an edge": made(
        [(30, 20, 1e5), (70, 60, 1e6)], [(46, 1500)], [(0, 0), (30, -10), (50, -4), (70, 0)], 0.1, 50, 26
    ),
    "slack": made([(70, 8, 1e4), (50, 8, 1e5), (70, 60, 1e4)], [], 0.1, 0.6, 99, 21),
    "a heap at a sinker": made([(30, 8, 1e6), (30, 60, 1e4)], [(6, -1500), (24, 1500)], -0.3, 0.2, 21, 21),
}
STEPS = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12}  # of `touchdown`, all but those that tell that nothing was found


@pytest.fixture(scope="module")
def solved():
    """{name: solution, what Newton's method was last called with}"""
    found = {}
    for name, (one, x, z) in LINES.items():
        with mock.patch.object(newton, "newton", wraps=newton.newton) as called:
            found[name] = one.solve(x, z), called.call_args.args
    return found


def test_each_step_is_taken_by_a_line(solved):
    assert {int(step) for _, args in solved.values() for step in args[5][:, 0]} == STEPS
    assert {int(args[6]) for _, args in solved.values()} == {0, 1, 2}


@pytest.mark.parametrize("name", [name for name in LINES if name != "slack"])  # H of that is set
def test_derivatives_of_the_equations_are_their_differences(solved, name):
    _, (data, e, _, x, z, steps, left, rows) = solved[name]
    u, rows = e.u.copy(), rows.copy()
    start = np.array([*u, x, z])

    def residuals(values):
        e.u[:] = values[:-2]
        newton.equations(data, e, values[-2], values[-1], steps, left, rows)
        return e.r.copy()

    residuals(start)
    exact, size = e.J.copy(), 1e-5 * np.maximum(np.abs(start), 1.0)
    for k, step in enumerate(size):
        way = np.eye(len(start))[k] * step
        difference = (residuals(start + way) - residuals(start - way)) / (2 * step)
        assert exact[:, k] == pytest.approx(difference, rel=2e-4, abs=2e-5 * np.abs(exact[:, k]).max())
    e.u[:] = u


@pytest.mark.parametrize("name", LINES)
def test_a_line_is_in_equilibrium_at_each_of_its_points(solved, name):
    solution = solved[name][0]
    one = solution.line
    s, x, z, T = solution.profile(4001).T
    step, dx, dz = s[1], np.diff(x), np.diff(z)
    middle, long, pull = 0.5 * (s[1:] + s[:-1]), np.hypot(dx, dz), 0.5 * (T[1:] + T[:-1])
    t = np.column_stack([dx, dz]) / np.maximum(long, 1e-9)[:, None]
    joints = np.cumsum([0.0, *(segment.length for segment in one.segments)])
    number = np.searchsorted(joints, middle) - 1
    weight = np.array([segment.weight for segment in one.segments])[number]
    stops = [*joints, *(load.position for load in one.loads), *solution.grounded.ravel()]
    stops += list(np.interp(one.bed.points[1:-1, 0], x, s))
    away = np.abs(middle[:, None] - stops).min(axis=1) > 2 * step
    lies = np.any((solution.grounded[:, 0] < middle[:, None]) & (middle[:, None] < solution.grounded[:, 1]), axis=1)
    pulled = pull > 1e-3 * T.max()

    stretch = np.choose(number, [np.interp(pull, *table(segment)) for segment in one.segments])
    assert (long / step)[pulled & away] == pytest.approx(1 + stretch[pulled & away], abs=1e-5)
    change = np.diff(pull[:, None] * t, axis=0) / step
    hangs = away & ~lies & (middle > solution.grounded[0, 0] if solution.slack else True)  # what is below is a heap
    free = hangs[1:] & hangs[:-1]
    assert np.abs(change - np.outer(weight[1:], [0.0, 1.0]))[free].max() < 1e-3 * weight.max()
    drags = (away & lies & pulled)[1:] & (away & lies & pulled)[:-1]
    expected = weight * (t[:, 1] + one.bed.friction * t[:, 0])
    assert np.diff(pull)[drags] / step == pytest.approx(expected[1:][drags], abs=1e-3 * weight.max())

    assert (x[-1], z[-1]) == pytest.approx(LINES[name][1:], abs=1e-7 * one.length)
    assert solution.slack or (x[0], z[0]) == pytest.approx((0, 0), abs=1e-6 * one.length)
    end = pull[-1] * t[-1] + [0.0, 0.5 * step * weight[-1]]
    assert end == pytest.approx((solution.horizontal_fairlead, solution.vertical_fairlead), abs=1e-5 * T.max())


def table(segment):
    """Tensions and strains of a segment"""
    if np.ndim(segment.axial_stiffness) == 0:
        return (0.0, 1e9), (0.0, 1e9 / segment.axial_stiffness)
    strain, tension = np.transpose(segment.axial_stiffness)
    return (*tension, 1e9), (
        *strain,
        strain[-1] + (1e9 - tension[-1]) * (strain[-1] - strain[-2]) / (tension[-1] - tension[-2]),
    )


def test_the_first_span_is_sought_between_one_that_clears_the_bed_and_one_that_does_not(monkeypatch):
    """From H times the least slope to a vertex, less all buoys; up by H and the heaviest segment over the height"""
    traverse = plain("mooring.lines.multi_segment.traverse")
    monkeypatch.setattr(traverse, "touching_span", lambda *given: given)
    q = np.zeros(7)
    q[[traverse.H, traverse.X, traverse.Z]] = 2e4, 100.0, 50.0
    made = SimpleNamespace(
        bed=np.array([[0.0, 0.0, 0.0], [40.0, 38.0, 0.0], [70.0, 44.0, 0.0], [90.0, 49.9, 0.0]]), length=200.0,
        loads=np.array([[10.0, 500.0, 0.0], [20.0, -300.0, 0.0], [30.0, -200.0, 0.0]]),
        segments=np.array([[0.0, 400.0], [50.0, 900.0], [80.0, 600.0]]),
    )  # fmt: skip
    for facet in range(4):
        slope = min((50.0 - z) / (100.0 - x) for x, z, _ in made.bed[: facet + 1])
        low = 2e4 * slope - 500.0
        high = low + 500.0 + 2e4 + 900.0 * (50.0 + 0.2)
        line, w, origin, at, *found = traverse.first_span(made, SimpleNamespace(q=q), facet)
        assert line is made and w.q is q and (origin, at) == (traverse.FROM_FAIRLEAD, facet)
        assert found == pytest.approx([low - 1e-9 * abs(low), high])


def test_a_buoy_in_the_surface_loses_its_lift_along_its_height():
    """Lift 300 N, 80 N of weight out of the water, over 2 m below z = 5; a sinker keeps its weight"""
    span = plain("mooring.lines.multi_segment.free_span")
    made = SimpleNamespace(loads=np.array([[0.0, -300.0, 80.0], [0.0, 50.0, 60.0]]), surface=5.0, soft=2.0)
    wet, afloat, dry = span.SUBMERGED, span.FLOATING, span.EMERGED
    for z, weight, state in ((2.0, -300.0, wet), (3.0, -300.0, wet), (3.5, -205.0, afloat), (4.5, -15.0, afloat),
                             (5.0, 80.0, dry), (9.0, 80.0, dry)):  # fmt: skip
        assert span.smoothed_weight(made, 0, z) == (pytest.approx(weight), state)
        assert span.smoothed_weight(made, 1, z) == (50.0, wet)


@pytest.mark.parametrize("flexibility", [0.0, 1e-6])
@pytest.mark.parametrize("V, down", [(8e3, 20.0), (8e3, 70.0), (-3e3, 30.0)])
def test_the_length_to_an_abscissa_is_that_of_its_catenary(flexibility, V, down):
    """x = (H/w)(asinh(V/H) − asinh((V − ws)/H)) + Hs/EA of the length s that is found; w = 200 N/m, H = 5 kN"""
    span, H, w = plain("mooring.lines.multi_segment.free_span"), 5e3, 200.0
    q = np.zeros(7)
    q[[span.H, span.V, span.X]] = H, V, 90.0
    s = span.length_to(q, 90.0 - down, w, 1.0, flexibility)
    found = H / w * (math.asinh(V / H) - math.asinh((V - w * s) / H)) + flexibility * H * s
    assert found == pytest.approx(down, rel=1e-10)
