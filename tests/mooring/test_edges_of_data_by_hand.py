"""Data at the edges of what is taken: properties of lines in motion, moments of narrow seas, numbers of files."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.lines.dynamics.bed import ElasticBed
from hakobune.mooring.lines.dynamics.line import AttachedBody, DynamicLine, DynamicSegment
from hakobune.mooring.lines.dynamics.regime import regime_of
from hakobune.mooring.lines.dynamics.run import stopped
from hakobune.mooring.motion.simulation import loads as of_loads
from hakobune.mooring.passing import double_body
from hakobune.mooring.passing.passage import Track
from hakobune.mooring.seas import directions, wavewatch
from hakobune.mooring.studies.breakwater import tides
from hakobune.mooring.studies.breakwater.breakwater import Breakwater, BreakwaterError

CHAIN = DynamicSegment(100.0, 90.0, 780.0, 0.1, 5e8, 20)

# ------------------------------------------------------------------ lines in motion


@pytest.mark.parametrize("name", ["length", "mass", "diameter", "axial_stiffness"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
def test_a_segment_has_a_length_a_mass_a_diameter_and_a_stiffness(name, value):
    assert getattr(replace(CHAIN, **{name: 1e-3}), name) == 1e-3
    with pytest.raises(ValueError, match=f"segment {name} is .*; allowed: finite, above 0"):
        replace(CHAIN, **{name: value})


@pytest.mark.parametrize("name", ["damping_ratio", "drag_normal", "drag_tangential", "added_normal", "added_tangential",
                                  "bending_stiffness", "structural_damping"])  # fmt: skip
@pytest.mark.parametrize("value", [-1e-9, math.inf, math.nan])
def test_drag_added_mass_and_damping_of_a_segment_are_nothing_or_more(name, value):
    assert getattr(replace(CHAIN, **{name: 0.0}), name) == 0.0
    with pytest.raises(ValueError, match=f"segment {name} is .*; allowed: finite, at least 0"):
        replace(CHAIN, **{name: value})


@pytest.mark.parametrize("changes, says", [
    ({"weight": math.inf}, "segment weight is inf N/m; allowed: finite"), ({"weight": -50.0}, None),
    ({"elements": 0}, "segment elements is 0; allowed: whole"), ({"elements": 1}, None),
    ({"elements": 2.5}, "segment elements is 2.5; allowed: whole numbers from 1"),
])  # fmt: skip
def test_a_segment_may_float_and_has_whole_elements(changes, says):
    if says is None:
        replace(CHAIN, **changes)
    else:
        with pytest.raises(ValueError, match=says):
            replace(CHAIN, **changes)


@pytest.mark.parametrize("name, strict", [("stiffness", True), ("slip", True), ("below", False), ("damping", False),
                                          ("friction", False)])  # fmt: skip
def test_a_bed_is_stiff_and_not_above_its_anchor(name, strict):
    with pytest.raises(ValueError, match=f"bed {name} is -1; allowed: finite, {'above' if strict else 'at least'} 0"):
        ElasticBed(**{name: -1.0})
    if strict:
        with pytest.raises(ValueError, match=f"bed {name} is 0"):
            ElasticBed(**{name: 0.0})
    else:
        assert getattr(ElasticBed(**{name: 0.0}), name) == 0.0


@pytest.mark.parametrize("slope, taken", [(0.999, True), (-0.999, True), (1.0, False), (math.nan, False)])
def test_a_bed_slopes_by_less_than_a_radian_or_has_points(slope, taken):
    if taken:
        s, c = math.sin(slope), math.cos(slope)
        assert ElasticBed(slope, 0.3).normal == pytest.approx([-s * math.cos(0.3), -s * math.sin(0.3), c])
        with pytest.raises(ValueError, match="bed points are given too"):
            ElasticBed(slope, points=((0.0, 0.0), (10.0, 1.0)))
    else:
        with pytest.raises(ValueError, match=r"bed slope is .* rad; allowed: between"):
            ElasticBed(slope)


def line(*segments, **more):
    return DynamicLine(segments or (CHAIN,), (0.0, 0.0, -50.0), **more)


@pytest.mark.parametrize("make, says", [
    (lambda: DynamicLine((), (0, 0, 0)), "a line has 0 segments"),
    (lambda: line(CHAIN, CHAIN, bodies=(None, None)), "a line of 2 segments has 2 bodies; allowed: one body fewer"),
    (lambda: DynamicLine((CHAIN,), (0, 0)), "allowed: three finite numbers"),
    (lambda: DynamicLine((CHAIN,), (0, 0, math.nan)), "allowed: three finite numbers"),
    (lambda: line(density=-1.0), "density is -1; allowed: finite, at least 0"),
    (lambda: line(gravity=0.0), "gravity is 0; allowed: finite, above 0"),
    (lambda: line(replace(CHAIN, elements=1)), "a line has 1 element; allowed: 2 or more"),
    (lambda: line(replace(CHAIN, weight=883.0), surface=True), "weighs 883 N/m in water and, with 90 kg/m, 882.598 N"),
    (lambda: AttachedBody(-1.0), "body mass is -1"), (lambda: AttachedBody(1.0, -1.0), "body volume is -1"),
    (lambda: AttachedBody(1.0, 1.0, -1.0), "body drag_area is -1"),
    (lambda: AttachedBody(1.0, 1.0, 1.0, -1.0), "body added_mass is -1"),
])  # fmt: skip
def test_a_line_that_cannot_be_is_refused(make, says):
    with pytest.raises(ValueError, match=says):
        make()


def test_a_line_knows_its_length_elements_nodes_and_name():
    made = line(CHAIN, replace(CHAIN, length=50.0, elements=2), surface=True)
    assert (made.length, made.elements, made.bodies) == (150.0, 22, (None,))
    assert made.nodes == pytest.approx([*np.linspace(0, 100, 21), 125.0, 150.0])
    assert repr(made) == "<DynamicLine 150 m, 22 elements, 2 segments>" and str(made) == "line of 150 m in 22 elements"
    line(replace(CHAIN, elements=2))
    assert line(replace(CHAIN, weight=882.0), surface=True).surface


@pytest.mark.parametrize("factor, wanted", [(2.0, (40, 4)), (0.5, (10, 1)), (0.02, (1, 1)), (1.24, (25, 2))])
def test_other_elements_are_a_multiple_of_each_segment_s_and_one_at_least(factor, wanted):
    made = line(CHAIN, replace(CHAIN, length=50.0, elements=2)).with_elements(factor)
    assert tuple(one.elements for one in made.segments) == wanted
    assert line().with_elements(0.01).elements == 2  # of one segment two


def test_a_line_without_bending_is_otherwise_the_same():
    made = line(replace(CHAIN, bending_stiffness=3e4)).without_bending()
    assert made.segments[0] == replace(CHAIN, bending_stiffness=0.0)


def test_a_table_of_tension_is_straight_between_its_points_and_beyond_the_last():
    """EA 1e6 N to 0.01, then 4e6 N: at 30 kN the strain is 0.01 + 20e3/4e6; damping by the larger stiffness"""
    rope = replace(CHAIN, axial_stiffness=((0.0, 0.0), (0.01, 1e4), (0.02, 5e4)))
    assert rope.stiffness == pytest.approx(4e6)
    assert rope.strain_at(np.array([0.0, 5e3, 1e4, 3e4, 9e4])) == pytest.approx([0.0, 0.005, 0.01, 0.015, 0.03])
    assert rope.elongation == pytest.approx(np.array([[0.0, 0.0, 0.25, 0.0], [0.01, 0.0025, 1.0, 50 / 4e6]]))
    assert rope.damping == pytest.approx(5.0 * math.sqrt(4e6 * 90.0))
    assert CHAIN.strain_at(5e5) == pytest.approx(1e-3)
    assert replace(CHAIN, structural_damping=7.0).damping == 7.0
    fine = replace(CHAIN, elements=100, damping_ratio=0.5)  # a fortieth of the segment where elements are shorter
    assert fine.damping == pytest.approx(0.5 * 2.5 * math.sqrt(5e8 * 90.0)) and fine.size == 1.0
    with pytest.raises(ValueError, match="a strain twice"):
        _ = replace(rope, axial_stiffness=((0.0, 0.0), (0.01, 1e4), (0.01, 5e4))).stiffness


@pytest.mark.parametrize("made, says", [
    (line(CHAIN, CHAIN), "uniform line without bodies"),
    (line(replace(CHAIN, axial_stiffness=((0.0, 0.0), (0.01, 1e4), (0.02, 5e4)))), "of one axial stiffness"),
    (line(bed=None), "lies on a flat bed"), (line(bed=ElasticBed(0.1)), "lies on a flat bed"),
    (line(bed=ElasticBed(below=1.0)), "lies on a flat bed"),
    (line(bed=ElasticBed(points=((0.0, 0.0), (10.0, 1.0)))), "lies on a flat bed"),
])  # fmt: skip
def test_the_simplified_method_is_for_a_uniform_line_on_a_flat_bed(made, says):
    assert says in regime_of(made, (80.0, 0.0, 0.0), np.array([1.0, 0.0, 0.0]), 10.0)


def test_a_run_that_stops_names_its_line_time_step_and_node():
    said = str(stopped(line(), 12.5, 1e-7, 1e-6, 3))
    assert said.startswith("line of 100 m in 20 elements: at t = 12.5 s the time step fell to 1e-07 s, limit 1e-06 s, "
                           "near node 3 of 20")  # fmt: skip


# ------------------------------------------------------------------ seas


@pytest.mark.parametrize("r1, r2", [(0.8, 0.5), (0.3, 0.1), (0.99, 0.97)])
def test_a_sea_of_moments_has_these_moments(r1, r2):
    """∫ D e^{iα} dα = r₁ e^{iα₁} and of e^{2iα} r₂ e^{2iα₂}, nowhere negative"""
    (D,) = directions.of_moments(np.array([r1]), np.array([r2]), np.array([1.0]), np.array([1.05]))
    step = 2 * np.pi / directions.ROWS
    assert D.min() >= 0 and D.sum() * step == pytest.approx(1.0)
    if r1 < 0.9:  # sharper ones are not resolved by rows of 2°
        assert (D @ np.exp(1j * directions.ALPHA)) * step == pytest.approx(r1 * np.exp(1j), rel=1e-6)
        assert (D @ np.exp(2j * directions.ALPHA)) * step == pytest.approx(r2 * np.exp(2.1j), rel=1e-6)


@pytest.mark.parametrize("r1, r2", [(1.0, 1.0), (1.02, 1.05)])
def test_moments_of_one_direction_alone_are_a_narrow_sea_about_it(r1, r2):
    """r ≥ 1 by rounding of a buoy: as of r = 0.99, within a few degrees of the mean"""
    (D,) = directions.of_moments(np.array([r1]), np.array([r2]), np.array([1.0]), np.array([1.0]))
    step = 2 * np.pi / directions.ROWS
    mean = (D @ np.exp(1j * directions.ALPHA)) * step
    assert abs(mean) > 0.95 and np.angle(mean) == pytest.approx(1.0, abs=0.02)


def test_moments_that_are_not_known_are_of_no_direction():
    D = directions.of_moments(
        np.array([0.5, 0.5]), np.array([0.2, 0.2]), np.array([np.nan, 1.0]), np.array([1.0, np.nan])
    )
    assert np.full_like(D, 1 / (2 * np.pi)) == pytest.approx(D)


@pytest.mark.parametrize("spread", [0.2, 0.5, 1.0])
def test_a_spread_is_that_of_a_power_of_the_cosine(spread):
    """σ² = 2(1 − r₁) with r₁ = s/(s + 1) of cos²ˢ(α/2), Kuik et al. (1988)"""
    (D,) = directions.of_spread(np.array([2.0]), np.array([spread]))
    mean = (D @ np.exp(1j * directions.ALPHA)) * 2 * np.pi / directions.ROWS
    assert 2 * (1 - abs(mean)) == pytest.approx(spread**2, rel=1e-6) and np.angle(mean) == pytest.approx(2.0)


def test_waves_from_the_north_travel_to_the_south_of_any_axes():
    """x to the east, 90°: waves from north go to −y; from east to −x"""
    way = directions.towards(90.0)
    assert np.mod(way[0], 2 * np.pi) == pytest.approx(1.5 * np.pi)
    assert np.mod(way[directions.ROWS // 4], 2 * np.pi) == pytest.approx(np.pi)


@pytest.mark.parametrize("words, says", [
    (["1", "2"], "has 2 frequencies; expected: 3, all finite"),
    (["1", "nan", "3"], "has 3 frequencies; expected: 3, all"), (["1", "inf", "nan"], "has 3 frequencies"),
    (["1", "x2", "3"], "has 'x2'; expected: numbers, the frequencies"),
])  # fmt: skip
def test_numbers_of_a_file_are_as_many_as_it_says_and_finite(words, says):
    assert wavewatch._numbers("f", ["1", "-2.5e1", ".3"], 3, "frequencies").tolist() == [1.0, -25.0, 0.3]
    with pytest.raises(TableError, match=says):
        wavewatch._numbers("f", words, 3, "frequencies")


# ------------------------------------------------------------------ ships that pass, lines that snap


def test_forces_of_a_passing_ship_are_the_slopes_of_the_fluid_s_energy(monkeypatch):
    """Column a = c (x²/2 + 3y + 5θ) of the added mass: −U² c x of the unsteady pressure, and of the squares ½U² of the
    passing ship's own: −x c₆ along, −3 c₆ across, 5 c₆ about the middle; U through the water"""
    c = np.arange(1.0, 13.0)

    def added(hulls, place, heading, depth, wall, density):
        assert (hulls, depth, wall, density) == ("hulls", 12.0, None, 1025.0)
        made = np.zeros((12, 12))
        made[:, 6] = c * (0.5 * place[0] ** 2 + 3 * place[1] + 5 * heading)
        return made

    monkeypatch.setattr(double_body, "added_mass", added)
    stagger = np.linspace(-30.0, 30.0, 7)
    found = double_body.double_body("hulls", Track(40.0, 3.0, current=1.0), stagger, 12.0)
    xi, U = np.linspace(-30.0, 30.0, 31), 2.0
    assert found.stagger == pytest.approx(xi)
    assert found.changing == pytest.approx(-(U**2) * np.multiply.outer(xi, c[:6]), abs=1e-6)
    assert found.steady[:, 0] == pytest.approx(-0.5 * U**2 * xi * 7, abs=1e-6)
    assert found.steady[:, 1] == pytest.approx(np.full(31, -0.5 * U**2 * 21), rel=1e-6)
    assert found.steady[:, 5] == pytest.approx(np.full(31, 0.5 * U**2 * 35), rel=1e-6)
    assert not found.steady[:, 2:5].any()
    with pytest.raises(ValueError, match="the track has 6 places; allowed: at least 7"):
        double_body.double_body("hulls", Track(40.0, 3.0), stagger[:6], 12.0)


def test_a_line_snaps_in_waves_of_half_the_height_at_the_period_of_its_largest_tension(monkeypatch):
    import hakobune.mooring.breakwater.snap as of_snap

    told = {}
    monkeypatch.setattr(of_snap, "frequencies", lambda body, omega: ("frequencies", body, omega))
    monkeypatch.setattr(of_snap, "snap", lambda *given: told.update(snap=given) or "peaks")
    monkeypatch.setattr(tides, "sections", lambda *given: told.update(sections=given) or "waters")
    rows = [SimpleNamespace(level="low", rise=-1.0, front_at=5.0, back_at=6.0),
            SimpleNamespace(level="high", rise=2.0, front_at=7.0, back_at=8.0)]  # fmt: skip
    made = SimpleNamespace(lines=SimpleNamespace(stretch=1e6), waves=SimpleNamespace(height=3.0),
                           taut=lambda rise: f"taut at {rise:g}", wetted=lambda rise: f"wet at {rise:g}")  # fmt: skip
    found = tides.snapping(made, rows, SimpleNamespace(slack=(("high", "back"), ("low", "front"))))
    assert found == ("high", 8.0, "peaks")
    omega = pytest.approx(2 * math.pi / 8)
    assert told["snap"] == ("taut at 2", "waters", 1e6, omega, 1.5)
    assert told["sections"] == (made, "wet at 2", 2.0, ("frequencies", "taut at 2", omega))
    for held in (None, SimpleNamespace(slack=())):
        assert tides.snapping(made, rows, held) is None
    made.lines.stretch = None
    assert tides.snapping(made, rows, SimpleNamespace(slack=(("low", "front"),))) is None


@pytest.mark.parametrize("pull, taken", [(9.99, True), (10.01, False)])
def test_a_pretension_stretches_a_line_by_half_of_its_length_at_most(pull, taken):
    """2 P₀ s ≤ EA: 10 kN/m at the highest level of lines 5 m apart with EA = 100 kN"""
    rises = {0.0: 1e3, -1.0: 2e3, 1.0: 1e3 * pull}
    lines = SimpleNamespace(axial_stiffness=1e5, spacing=5.0)
    made = SimpleNamespace(lines=lines, levels=[("mean", 0.0), ("low", -1.0), ("high", 1.0)], pretension=rises.get)
    if taken:
        Breakwater._check_stretch(made)
    else:
        with pytest.raises(
            BreakwaterError, match=r"lines.axial_stiffness is 100 kN and the pretension of a line is up to 50.05 kN"
        ):
            Breakwater._check_stretch(made)
        for none in (None, SimpleNamespace(axial_stiffness=None, spacing=5.0)):
            Breakwater._check_stretch(SimpleNamespace(lines=none, levels=made.levels, pretension=rises.get))


def test_a_pretension_is_half_of_what_floats_up_over_the_sine_of_the_lines():
    """g (ρ A − m)/2 sin α at the level of the tide"""
    water = SimpleNamespace(density=1000.0, gravity=10.0)
    made = SimpleNamespace(body="body", water=water, mass=2e4, angle=math.pi / 6,
                           wetted=lambda rise: SimpleNamespace(area=30.0 + rise))  # fmt: skip
    assert Breakwater.pretension(made, 2.0) == pytest.approx(10.0 * (32e3 - 2e4))
    made.body = None
    assert Breakwater.pretension(made, 2.0) is None


@pytest.mark.parametrize("carrier", [None, "current"])
def test_wave_pairs_push_each_body_at_its_own_heading_by_the_waves_of_their_sea(carrier, monkeypatch):
    """Three components of the first sea, whose pairs are not asked for, and two of the second; two bodies, headed to
    0.1 + 0.2 and 0.3 + 0.4 rad, of which the second drifts"""
    told = []
    monkeypatch.setattr(of_loads, "_band", lambda moored, sea, settings: ("low", "high", sea))
    monkeypatch.setattr(of_loads, "met_by_a_place", lambda own, carrier, depth, gravity: (carrier, depth, gravity))
    monkeypatch.setattr(of_loads, "drift_of", lambda waves, own, heading: (waves.drift, heading))
    monkeypatch.setattr(of_loads, "pair_record", lambda *given: (
        told.append(given) or (np.array([0.0, 1.0]), np.ones((2, 6)))))  # fmt: skip
    at_rest = np.array([[0, 0, 0, 0, 0, 0.1], [0, 0, 0, 0, 0, 0.3]])
    reader = SimpleNamespace(axes_at_rest=at_rest, depth=20.0, gravity=9.8)
    each = [SimpleNamespace(drift=None), SimpleNamespace(drift="D")]
    moored = SimpleNamespace(reader=reader, start=np.array([0, 0, 0, 0, 0, 0.2] * 2) * np.repeat([1.0, 2.0], 6),
                             waves=SimpleNamespace(each=each))  # fmt: skip
    weather = SimpleNamespace(seas=(3, 2), beside_newman=(None, ("Ta", "Tb")), carrier=carrier)
    parts = tuple(np.arange(5.0) + 10 * i for i in range(4))
    found = list(of_loads.pairs(moored, weather, SimpleNamespace(ramp=5.0, duration=60.0), parts))
    assert [one.body for one in found] == [0, 1] and all(one.times.tolist() == [-5.0, -4.0] for one in found)
    (first, own, length, none, met), (second, _, _, drift, _) = told
    assert (first, second, length) == ("Ta", "Tb", 65.0) and met == (carrier, 20.0, 9.8)
    assert [part.tolist() for part in own] == [[3, 4], [13, 14], [23, 24], [33, 34]]
    assert none is None and drift == ("D", pytest.approx(0.7))
    assert all(one.smooth for one in found)
