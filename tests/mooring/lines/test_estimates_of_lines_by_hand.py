"""Accuracy of a run by another with coarser elements or longer steps, and how a line is laid out before it rests."""

import math
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.dynamics import estimates
from hakobune.mooring.lines.dynamics import start as of_starts
from hakobune.mooring.lines.dynamics.bed import ElasticBed
from hakobune.mooring.lines.dynamics.line import DynamicLine, DynamicSegment
from hakobune.mooring.lines.dynamics.run import DynamicLineError


class Case(SimpleNamespace):
    def _replace(self, **given):
        return Case(**vars(self) | given)


class Line(SimpleNamespace):
    def __str__(self):
        return "line a"

    def with_elements(self, given):
        self.asked.append(given)
        return Line(**vars(self) | dict(elements=self.coarser))


def a_result(fairlead, largest, time=None):
    time = np.linspace(0.0, 10.0, len(fairlead)) if time is None else time
    return SimpleNamespace(time=time, tension_fairlead=np.array(fairlead), largest_tension=np.array(largest))


def a_case(elements=10, coarser=5):
    line = Line(elements=elements, coarser=coarser, asked=[], system=SimpleNamespace(weight=np.array([-4.0, 2.0])),
                segments=[SimpleNamespace(elements=n) for n in (elements - 3, 3)])  # fmt: skip
    motion = SimpleNamespace(at=lambda t: (("place", t), None))
    return Case(line=line, motion=motion, water="water", frames=3, stations=(1,), stops=(5,), tolerance=1e-3)


def told(function, *given):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        return function(*given), [str(one.message) for one in said]


@pytest.mark.parametrize("limit", [0.02, 0.05])
def test_the_error_of_elements_is_that_share_of_the_difference_which_goes_by_their_square(monkeypatch, limit):
    """Of 10 and 5 elements a third of it: (108 − 100)/3 at the fairlead, (240 − 200)/3 … inside 0.067"""
    case, asked = a_case(), []
    monkeypatch.setattr(
        estimates, "start", lambda line, place, water: asked.append((line.elements, place, water)) or "state"
    )
    found = a_result([1.0, 108.0, 3.0], [2.0, 207.5, 4.0])
    monkeypatch.setattr(estimates, "run_esdirk", lambda case, state: asked.append((case, state)) or found)
    error, said = told(estimates.mesh_error, case, a_result([50.0, 100.0], [200.0, 60.0]), limit)
    assert error == pytest.approx(max(8 / 3 / 100, 7.5 / 3 / 200))
    assert case.line.asked == [2] and asked[0] == (5, ("place", 0.0), "water") and asked[1][1] == "state"
    assert (asked[1][0].frames, asked[1][0].stations, asked[1][0].stops, asked[1][0].line.elements) == (0, (), (), 5)
    if limit > error:
        assert said == []
    else:
        assert "the largest tension at the fairlead is 0.1 kN, and 0.108 kN in 5 elements" in said[0]
        assert "estimated error 2.7%, allowed 2.0%" in said[0]
    case.line.segments = [SimpleNamespace(elements=4)] * 2
    told(estimates.mesh_error, case, a_result([50.0, 100.0], [200.0, 60.0]), limit)
    assert case.line.asked[-1] == 0.5
    finer = a_case(elements=5, coarser=10)
    error, _ = told(estimates.mesh_error, finer, a_result([50.0, 100.0], [200.0, 200.0]), 1.0)
    assert error == pytest.approx(4 / 3 * 8 / 100)


def test_the_error_of_steps_is_the_worst_of_tenths_of_a_run_over_its_largest_tension(monkeypatch):
    """In the fourth second 90 for 100 inside, in the eighth 38 for 40 at the fairlead; of 120 and 50 in all"""
    time = np.linspace(0.0, 10.0, 101)
    ours, others = np.full((2, 101), 10.0), np.full((2, 101), 10.0)
    for values, (inside, ahead) in ((ours, (100.0, 40.0)), (others, (90.0, 38.0))):
        values[1, 35], values[0, 75], values[0, 15], values[1, 15] = inside, ahead, 50.0, 120.0
    asked = []
    monkeypatch.setattr(estimates, "run_esdirk", lambda case, state: asked.append((case.coarser, case.frames, state)) or
                        a_result(*others, time))  # fmt: skip
    for limit, count in ((0.1, 0), (0.05, 1)):
        error, said = told(estimates.step_error, a_case(), a_result(*ours, time), "state", limit)
        assert error == pytest.approx(10 / 120) and len(said) == count
    assert (
        "the largest tension of all elements from 3 to 4 s is 0.1 kN, and 0.09 kN with steps 2 times as long" in said[0]
    )
    assert "error of 8.3%" in said[0] and asked[0] == (2.0, 0, "state")

    def fails(*_):
        raise DynamicLineError("too short")

    monkeypatch.setattr(estimates, "run_esdirk", fails)
    error, said = told(estimates.step_error, a_case(), a_result(*ours, time), "state", 0.1)
    assert np.isnan(error) and "failed, too short" in said[0]


def test_largest_tensions_of_parts_have_what_is_between_rows_at_their_ends():
    """From 0 to 3 s, straight between 0, 6, 0 and 3 N at 0, 1.5, 2 and 3 s: at 1 s it is 4"""
    result = a_result([0.0, 6.0, 0.0, 3.0], [9.0, 9.0, 1.0, 9.0], np.array([0.0, 1.5, 2.0, 3.0]))
    found = estimates._largest_of_parts(result, np.array([0.0, 1.0, 2.0, 3.0]))
    assert found.tolist() == [[4.0, 6.0, 3.0], [9.0, 9.0, 9.0]]


def test_differences_of_what_is_rounding_are_none():
    """A millionth of the largest and of the heaviest node, 4 N here"""
    line = a_case().line
    found = estimates._off(np.array([-2.0, 1.0]), np.array([3.9e-6, 1.0]), line)
    assert found.tolist() == [0.0, 1.0]
    assert estimates._off(np.array([-2e-6, 1.0]), np.array([4.1e-6, 1.0]), line) == pytest.approx([2 / 4.1, 1.0])


def segment(length=60.0, elements=6, **given):
    return DynamicSegment(**dict(length=length, mass=50.0, weight=400.0, diameter=0.2, axial_stiffness=1e7,
                                 elements=elements) | given)  # fmt: skip


def test_a_line_is_laid_out_on_the_catenary_of_a_uniform_line_of_its_weight(monkeypatch):
    """Two segments, a buoy of 2 kN and a bed: 60 and 40 m of 400 and 200 N/m, EA of both in series; 3 : 4 across"""
    asked = []

    def profile(span, height, length, weight, EA, friction, slope, bed, points):
        asked.append((span, height, length, weight, EA, friction, slope, bed, points))
        return np.column_stack([np.linspace(0.0, span, points), np.linspace(0.0, height, points) ** 1])

    monkeypatch.setattr(of_starts, "profile", profile)
    monkeypatch.setattr(of_starts, "solve_lines", lambda *given: SimpleNamespace(status=2))
    two = DynamicLine((segment(), segment(40.0, 4, weight=200.0, axial_stiffness=5e6)), (10.0, 20.0, -50.0),
                      bed=ElasticBed(friction=0.4))  # fmt: skip
    q = of_starts._guess(two, np.array([58.0, 84.0, -5.0]))
    EA = 100 / (60 / 1e7 + 40 / 5e6)
    assert asked[0] == (pytest.approx(80.0), 45.0, 100.0, pytest.approx(320.0), pytest.approx(EA), 0.4, 0.0, True, 220)
    share = np.array([0.0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100]) / 100
    assert q == pytest.approx(np.array([10.0, 20.0, -50.0]) + share[:, None] * [48.0, 64.0, 45.0])
    light = DynamicLine((segment(weight=-30.0),), (0.0, 0.0, -50.0), bed=ElasticBed(friction=0.4))
    of_starts._guess(light, np.array([50.0, 0.0, -20.0]))
    assert asked[1] == (50.0, -30.0, 60.0, pytest.approx(30.0), pytest.approx(1e7), 0.0, 0.0, False, 7)
    above = of_starts._guess(DynamicLine((segment(),), (0.0, 0.0, -50.0), bed=None), np.array([0.0, 0.0, -20.0]))
    assert asked[2][0] == 0.0 and above[-1] == pytest.approx([0.0, 0.0, -20.0]) and asked[2][7] is False


def test_a_slack_line_goes_past_its_anchor_and_back_where_it_would_be_packed():
    """70 m lie on a bed of slope 0.1 between ends 20 m apart: 25 m out behind the anchor and 45 m back"""
    s = np.arange(0.0, 101.0, 10.0)
    x, z = np.linspace(0, 20, 11), np.linspace(0, 40, 11)
    span = 20 * math.cos(0.1)
    found = of_starts._folded(x, z, s, 70.0, span, 0.1)
    along = np.array([0.0, -10, -20, -20, -10, 0, 10])
    assert found[0][:7] == pytest.approx(along * math.cos(0.1)) and found[1][:7] == pytest.approx(along * math.sin(0.1))
    assert np.array_equal(found[0][7:], x[7:]) and np.array_equal(found[1][7:], z[7:])
    for lying, span in ((0.0, 20.0), (39.9, 20.0)):
        assert of_starts._folded(x, z, s, lying, span, 0.0)[0] is x
    assert of_starts._folded(x, z, s, 40.1, 20.0, 0.0)[0] is not x


@pytest.mark.parametrize("bed, found", [
    (None, (0.0, 0.0, False)), (ElasticBed(below=1.0, friction=0.4), (0.0, 0.0, False)),
    (ElasticBed(slope=0.2, uphill=0.5, friction=0.4), (math.atan(math.tan(0.2) * math.cos(0.5 - 0.1)), 0.4, True)),
])  # fmt: skip
def test_the_slope_under_a_line_is_that_of_the_bed_along_its_way(bed, found):
    line = DynamicLine((segment(),), (0.0, 0.0, -50.0), bed=bed)
    assert of_starts._along(line, np.array([math.cos(0.1), math.sin(0.1)])) == pytest.approx(found)


@pytest.mark.parametrize("factor, refused", [(0.99, False), (1.01, True)])
def test_a_line_behaves_as_one_up_to_a_quarter_of_its_tension_times_its_length_squared(monkeypatch, factor, refused):
    monkeypatch.setattr(of_starts.lumped, "elastic_tension", lambda system, q: np.array([200.0, 800.0]))
    line = SimpleNamespace(segments=[SimpleNamespace(bending_stiffness=one) for one in (1.0, factor * 800 * 50**2 / 4)],
                           system=None, length=50.0)  # fmt: skip
    if refused:
        with pytest.raises(LineError, match=r"at most 0\.8 kN \(at rest, without EI\) does; allowed: up to 500 kN m²"):
            of_starts._check_bending(line, None)
    else:
        of_starts._check_bending(line, None)


def test_a_stiff_line_is_stiffened_in_tens_from_ten_thousand_times_its_weight(monkeypatch):
    """30 N in all: 3e5, 3e6 and 3e7 before 1e8 N and 5e6 N of a softer part"""
    from hakobune.mooring.lines.dynamics.lumped import settle, workspace

    class System(SimpleNamespace):
        def _replace(self, **given):
            return System(**vars(self) | given)

    asked = []
    monkeypatch.setattr(workspace, "workspace", lambda system: system)
    monkeypatch.setattr(settle, "settle", lambda system, work, *more: asked.append(system.stiffness.tolist()) or 2)
    system = System(weight=np.array([10.0, -20.0]), stiffness=np.array([1e8, 5e6]))
    assert of_starts._settled(system, "water", "q", "slip")
    assert asked == [[3e5, 3e5], [3e6, 3e6], [3e7, 5e6], [1e8, 5e6]]
    monkeypatch.setattr(settle, "settle", lambda *_: 0)
    assert not of_starts._settled(system, "water", "q", "slip")


def test_friction_holds_from_the_highest_node_on_the_bed_down_as_far_as_there_is_tension(monkeypatch):
    """Reactions of 10 N each hold 4: of 7 N in the line the first node takes 4, the next 3 and the others nothing"""
    q = np.column_stack([np.arange(6.0) * 2, np.zeros(6), np.zeros(6)])
    monkeypatch.setattr(of_starts.lumped, "elastic_tension", lambda system, q: np.full(5, 7.0))
    monkeypatch.setattr(of_starts.lumped, "above_bed", lambda system, q: np.array([0.0, 0.0, 0.0, 0.0, 9.0, 9.0]))
    thickness = np.full(6, 0.2)
    system = SimpleNamespace(bed_thickness=thickness, bed_stiffness=np.full(6, 100.0), bed_friction=0.4, bed_slip=0.05)
    found = of_starts._mobilised(system, q)  # pressed by its thickness: k h/2 = 10
    assert found[:, 0] == pytest.approx([0.0, 0.0, 0.05 * 3 / 4, 0.05, 0.0, 0.0]) and not found[:, 1:].any()
    monkeypatch.setattr(of_starts.lumped, "above_bed", lambda system, q: np.array([0.1, 0.1, 0.1, 0.1, 9.0, 9.0]))
    half = of_starts._mobilised(system, q)  # ½ k p²/h = 2.5 N, which hold 1 each
    assert half[:, 0] == pytest.approx([0.0, 0.05, 0.05, 0.05, 0.0, 0.0])
