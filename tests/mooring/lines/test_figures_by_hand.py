"""Figures of a run of a line, of numbers that can be added up by hand, and parts of a line out of the water."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.dynamics import figures as module
from hakobune.mooring.lines.dynamics import regime, simulation
from hakobune.mooring.lines.dynamics.bed import ElasticBed
from hakobune.mooring.lines.dynamics.figures import Figures, figures, judged_by_regime, quasi_static, time_below
from hakobune.mooring.lines.dynamics.line import DynamicLine, DynamicSegment
from hakobune.mooring.lines.dynamics.run import Energies
from hakobune.mooring.lines.dynamics.strength import Strength, Used
from hakobune.mooring.studies.in_air import IN_AIR
from hakobune.mooring.studies.moving_in_air import warn_of_air

TIME = np.linspace(0.0, 8.0, 9)
TENSION = np.array([10.0, 4.0, 0.0, 4.0, 8.0, 12.0, 20.0, 14.0, 10.0])
LINE = SimpleNamespace(system=SimpleNamespace(weight=np.array([3.0, -5.0, 2.0])))
NAMES = ("drag", "water_inertia", "structural", "bed", "friction", "kinetic", "elastic", "potential", "bed_elastic")


def a_result(anchor=TENSION / 2, shares=(1.0, 2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0)):
    """Energies that grow as multiples of the time; the forces' work goes up and down"""
    grown = {name: share * TIME for name, share in zip(NAMES, shares, strict=True)}
    swings = np.array([0.0, 5.0, 3.0, 8.0, 20.0, 16.0, 30.0, 28.0, 50.0])
    return SimpleNamespace(
        time=TIME, tension_fairlead=TENSION, tension_anchor=anchor, energies=Energies(swings, **grown)
    )


def the_figures(monkeypatch, statics, window=(2.0, 6.0, 2), cycle=2.0, regime="none", result=None):
    """Figures in which the line at rest at three places has the tensions `statics` (3, 2)"""
    places = np.array([[1.0, 0.0, 0.0], [2.0, 0.0, 0.5], [3.0, 1.0, 0.0]])
    monkeypatch.setattr(module, "quasi_static", lambda *_: (np.array(statics), places))
    course = SimpleNamespace(cycle=cycle, motion=SimpleNamespace(mean=np.array([1.0, 0.0, 0.25])))
    return figures(LINE, course, window, result or a_result(), None, regime)


def test_figures_of_ends_are_those_of_the_window(monkeypatch):
    """The fairlead from 2 to 6 s: 0, 4, 8, 12, 20; a tenth of the 10 N at rest is passed in a quarter second."""
    found = the_figures(monkeypatch, [(8.0, 2.0), (np.nan, np.nan), (16.0, 4.0)])
    one = found.fairlead
    assert (found.begin, found.end, found.cycles) == (2.0, 6.0, 2)
    assert (one.largest, one.time, one.least, one.rest) == (20.0, 6.0, 0.0, 10.0)
    assert one.mean == pytest.approx((2 + 6 + 10 + 16) / 4) and one.slack == pytest.approx(0.25)
    assert (one.quasi_static, one.over_quasi_static) == (16.0, pytest.approx(1.25))
    other = found.anchor
    assert (other.largest, other.rest, other.quasi_static) == (10.0, 5.0, 4.0) and other.mean == pytest.approx(4.25)
    assert other.over_quasi_static == pytest.approx(2.5)


def test_ends_of_a_window_between_rows_are_between_them(monkeypatch):
    found = the_figures(monkeypatch, [(8.0, 2.0)] * 3, window=(4.5, 5.75, None), cycle=None).fairlead
    assert (found.least, found.largest, found.time) == (10.0, 18.0, 5.75)
    assert found.mean == pytest.approx((0.5 * 11 + 0.75 * 15) / 1.25) and found.slack == 0.0


def test_energies_of_a_window_are_the_changes_in_it(monkeypatch):
    """Four seconds: losses 1, 2, 3, 5, 7 W, storage of 60 W; what the forces do goes 3, 8, 20, 16, 30."""
    found = the_figures(monkeypatch, [(8.0, 2.0)] * 3)
    losses = {"drag": 4.0, "water_inertia": 8.0, "structural": 12.0, "bed": 20.0, "friction": 28.0}
    assert found.losses == pytest.approx(losses) and found.stored == pytest.approx(240.0)
    assert found.work == pytest.approx(312.0) and found.of_forces == pytest.approx(27.0)
    assert found.exchanged == pytest.approx(5 + 12 + 4 + 14) and found.imbalance == pytest.approx(27.0 - 312.0)


def test_the_change_is_that_of_the_largest_from_the_last_cycle_but_one(monkeypatch):
    """8 in the seconds 2 to 4 and 20 from 4 to 6; a single cycle, and a motion without, have none."""
    statics = [(8.0, 2.0)] * 3
    assert the_figures(monkeypatch, statics).change == pytest.approx(20 / 8 - 1)
    falls = a_result()
    falls.tension_fairlead = TENSION[::-1]
    assert the_figures(monkeypatch, statics, result=falls).change == pytest.approx(1 - 8 / 20)
    assert np.isnan(the_figures(monkeypatch, statics, window=(2.0, 4.0, 1)).change)
    assert np.isnan(the_figures(monkeypatch, statics, window=(2.0, 6.0, None)).change)


def test_the_regime_is_asked_for_at_the_place_of_the_largest_tension_at_rest(monkeypatch):
    asked = []
    found = the_figures(monkeypatch, [(8.0, 9.0), (np.nan, np.nan), (16.0, 4.0)], regime=lambda x: asked.append(x) or 7)
    assert found.regime == 7 and np.array_equal(asked, [[2.0, 1.0, -0.25]])
    assert the_figures(monkeypatch, [(8.0, 2.0)] * 3, regime="not harmonic").regime == "not harmonic"


def test_tensions_that_are_rounding_divide_nothing(monkeypatch):
    """A millionth of the largest tension and of the heaviest node, 5 N here, is none: 2e-5 of 20 N."""
    for rest, known in ((1.9e-5, False), (2.1e-5, True)):
        found = the_figures(monkeypatch, [(8.0, rest)] * 3, result=a_result(np.where(TIME > 0, 6.0, rest))).anchor
        assert np.isfinite(found.slack) == known and np.isfinite(found.over_quasi_static) == known
        assert found.quasi_static == rest


@pytest.mark.parametrize("low,high,level,seconds", [(0, 4, 1, 1.0), (4, 0, 1, 1.0), (0, 4, 5, 4.0), (0, 4, -1, 0.0),
                                                   (2, 2, 3, 4.0), (2, 2, 1, 0.0)])  # fmt: skip
def test_time_below_a_level_is_a_share_of_each_straight_piece(low, high, level, seconds):
    assert time_below(np.array([1.0, 5.0]), np.array([low, high], float), level) == pytest.approx(seconds)
    both = time_below(np.array([1.0, 5.0, 7.0]), np.array([low, high, level + 9.0]), level)
    more = 2 * max(0.0, level - high) / (level + 9 - high)
    assert both == pytest.approx(seconds + more)


def test_a_share_of_work_is_told_where_there_is_work_at_the_ends():
    """A hundredth of what is lost, gained and stored, and a hundredth of the work that goes in and out"""
    one = dict(begin=0.0, end=1.0, cycles=None, fairlead=None, anchor=None)
    lost = {"drag": 60.0, "bed": -30.0}
    made = Figures(**one, work=-1.01, losses=lost, stored=-10.0, exchanged=0.011)
    assert made.share_of_work(2.02) == pytest.approx(-2.0)
    for change in (dict(work=-0.99), dict(exchanged=0.0100)):
        other = dict(work=-1.01, losses=lost, stored=-10.0, exchanged=0.011) | change
        assert np.isnan(Figures(**one, **other).share_of_work(2.0))


def test_the_line_at_rest_is_taken_along_one_cycle_or_the_whole_window(monkeypatch):
    """Tensions of a stand-in: 10 x and 100 x of the place; a place beyond 0.9 m has no shape."""
    asked = []

    def simulate(line, motion, duration, current, check_mesh):
        place = motion.at(0.0)[0]
        asked.append((line, duration, current, check_mesh))
        if place[0] > 0.9:
            raise LineError("too far")
        return SimpleNamespace(tension_fairlead=[10 * place[0], -1.0], tension_anchor=[100 * place[0], -2.0])

    monkeypatch.setattr(simulation, "simulate", simulate)
    motion = SimpleNamespace(at=lambda t: (np.array([t / 10, 0.0, -3.0]), None))
    for cycle, first in ((4.0, 6.0), (None, 2.0)):
        tensions, places = quasi_static("line", SimpleNamespace(cycle=cycle, motion=motion), (2.0, 10.0, 2), "current")
        assert places[:, 0] == pytest.approx(np.linspace(first, 10.0, 49) / 10) and np.all(places[:, 2] == -3.0)
        here = places[:, 0] <= 0.9
        assert 0 < np.sum(~here) < 20 and np.all(np.isnan(tensions[~here]))
        assert tensions[here] == pytest.approx(places[here, :1] * [10.0, 100.0])
    assert set(asked) == {("line", 1e-3, "current", False)}


def segment(elements=4, **given):
    return DynamicSegment(**dict(length=80.0, mass=50.0, weight=400.0, diameter=0.2, axial_stiffness=1e6,
                                 elements=elements) | given)  # fmt: skip


def test_the_simplified_method_gets_the_line_its_span_and_how_far_out_the_fairlead_goes(monkeypatch):
    """Of an anchor at (10, 20, −30) and a fairlead 3 : 4 off it, the way out is (0.6, 0.8)."""
    given = {}
    names = ("span", "height", "length", "weight", "mass", "diameter", "amplitude", "period")
    monkeypatch.setattr(regime, "harmonic_tension", lambda *a, **k: given.update(zip(names, a, strict=True)) or k)
    line = DynamicLine((segment(drag_normal=1.7, added_normal=0.9),), (10.0, 20.0, -30.0), bed=ElasticBed(),
                       density=1000.0, gravity=9.7)  # fmt: skip
    course = SimpleNamespace(motion=SimpleNamespace(mean=(40.0, 60.0, -4.0), omega=np.array([0.5])))
    rest = judged_by_regime(line, course, 1)(np.array([1.0, 2.0, 0.3]))
    assert given == dict(span=pytest.approx(50.0), height=26.0, length=80.0, weight=400.0, mass=50.0, diameter=0.2,
                         amplitude=(pytest.approx(2.2), 0.3), period=pytest.approx(4 * np.pi))  # fmt: skip
    assert rest == dict(axial_stiffness=1e6, drag=1.7, added_mass=0.9, density=1000.0, gravity=9.7)
    assert judged_by_regime(line, course, 2) == "the simplified method is for one harmonic motion"
    above = SimpleNamespace(motion=SimpleNamespace(mean=(10.0, 20.0, -4.0), omega=np.array([0.5])))
    judged_by_regime(line, above, 1)(np.array([1.0, 2.0, 0.3]))
    assert given["amplitude"] == (1.0, 0.3) and given["span"] == 0.0


@pytest.mark.parametrize(
    "parts,bed,says",
    [
        ((segment(), segment()), ElasticBed(), "uniform line"),
        ((segment(),), None, "flat bed"),
        ((segment(),), ElasticBed(slope=0.1), "flat bed"),
    ],
)
def test_the_simplified_method_is_for_one_segment_on_a_flat_bed(parts, bed, says, monkeypatch):
    monkeypatch.setattr(regime, "harmonic_tension", lambda *a, **k: 1)
    line = DynamicLine(parts, (0.0, 0.0, -30.0), bed=bed)
    assert says in regime.regime_of(line, (50.0, 0.0, -4.0), np.ones(3), 10.0)


def test_what_the_simplified_method_refuses_is_told_in_its_words(monkeypatch):
    def refuses(*_, **__):
        raise ValueError("slack at rest")

    monkeypatch.setattr(regime, "harmonic_tension", refuses)
    line = DynamicLine((segment(),), (0.0, 0.0, -30.0), bed=ElasticBed())
    assert regime.regime_of(line, (50.0, 0.0, -4.0), np.ones(3), 10.0) == "slack at rest"


def test_the_place_that_is_nearest_to_parting_has_the_largest_share_of_its_own_load():
    """Two elements of each part: nodes hold 10, (10 + 14)/2, (14 + 30)/2, (30 + 20)/2, 20."""
    elements = np.array([[10.0, 14.0, 30.0, 20.0], [9.0, 15.0, 12.0, 28.0]])
    nodes = np.column_stack([elements[:, 0], (elements[:, :-1] + elements[:, 1:]) / 2, elements[:, -1]])
    line = SimpleNamespace(elements=4, segments=(SimpleNamespace(elements=2), SimpleNamespace(elements=2)))
    result = SimpleNamespace(time=np.array([3.0, 4.0]), tension_anchor=np.array([1.0, 2.0]), station_tension=nodes,
                             tension_fairlead=np.array([5.0, 4.0]), largest_tension=np.array([30.0, 28.0]))  # fmt: skip
    both = Strength((50.0, 120.0), ("a", "b"))
    assert both.nodes(line) == (0, 1, 2, 3, 4) and not both.uniform and both.weakest == 50.0
    assert both.most_used(line, result) == Used(15.0, 50.0, 4.0, 0)
    assert both.most_used(line, result).share == pytest.approx(0.3)
    assert Strength((50.0, 90.0), ("a", "b")).most_used(line, result) == Used(30.0, 90.0, 3.0, 1)
    one = Strength((60.0, 60.0), ("a", "b"))
    assert one.nodes(line) == () and one.most_used(line, result) == Used(30.0, 60.0, 3.0, 0)
    pulled = SimpleNamespace(**vars(result) | dict(tension_fairlead=np.array([5.0, 100.0])))
    assert both.most_used(line, pulled) == Used(100.0, 120.0, 4.0, 1)
    held = SimpleNamespace(**vars(result) | dict(tension_anchor=np.array([49.0, 2.0])))
    assert both.most_used(line, held) == Used(49.0, 50.0, 3.0, 0)


def heights(*rows):
    """A result with frames at 0, 10, … s whose nodes have these heights"""
    z = np.array(rows, float)
    frames = np.zeros((*z.shape, 3))
    frames[:, :, 2] = z
    return SimpleNamespace(frames=frames, frame_time=10.0 * np.arange(len(z)))


def air(result, **given):
    line = SimpleNamespace(surface=False, length=100.0, nodes=np.array([0.0, 25.0, 50.0, 100.0]),
                           segments=(SimpleNamespace(diameter=0.1), SimpleNamespace(diameter=0.3)))  # fmt: skip
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        warn_of_air(SimpleNamespace(**vars(line) | given), result)
    return [str(one.message) for one in said]


def test_a_fairlead_above_the_water_is_told_where_it_is_highest():
    above = 100 * IN_AIR
    rise = heights([-9, -9, -9, 0], [-9, -9, -9, above + 2], [-9, -9, -9, above + 1])
    (says,) = air(rise)
    assert f"the fairlead is {above + 2:.3g} m above still water at t = 10.00 s" in says
    assert f"the line, {above:.3g} m" in says
    assert "at rest" in air(heights([-9, -9, -9, above + 1], [-9, -9, -9, 0]))[0]
    assert not air(heights([-9, -9, -9, above - 0.01])) and not air(rise, surface=True)


def test_a_line_that_floats_above_both_ends_and_the_water_is_told_with_its_place():
    """Allowed is the largest diameter, 0.3 m, above the highest of both ends and still water."""
    (says,) = air(heights([-9, -9, -9, -9], [-9, 0.2, 0.5, -9], [-9, 0.4, 0.2, -9]))
    assert "the line is 0.5 m above still water at t = 10.00 s, 50 m from the anchor" in says and "0.3 m" in says
    assert "at rest, 25 m from" in air(heights([-9, 0.4, 0.2, -9], [-9, 0.9, 0.5, -9]))[0]
    assert not air(heights([-9, 0.29, 0.2, -9])) and not air(heights([-9, 0.9, 0.2, 0.7]))
    assert not air(heights([0.7, 0.9, 0.2, -9]))
