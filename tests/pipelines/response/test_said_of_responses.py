"""What `hakobune response` says and judges of numbers that are made up: units, shares and both sides of each limit."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.response.points import KeelPoint, Point, keel_name, relative_name
from hakobune.pipelines.common.resonances import resonance_lines, underdamped
from hakobune.pipelines.response import moored, report

YEAR = 365.25 * 86400


class Term:
    """A response whose level doubles with every decade of time, and is crossed at a rate"""

    def __init__(self, at_a_year, rate=0.0):
        self.at_a_year, self.rate = at_a_year, rate

    def level(self, time):
        return self.at_a_year * (1 + 0.5 * math.log10(time / YEAR))

    def crossing_rate(self, level):
        return self.rate


def state(gaps=None, keel=None):
    return SimpleNamespace(air_gaps=lambda: gaps or {}, under_keel=lambda: keel or {}, points=())


@pytest.mark.parametrize("restoring, told", [(1.0, False), (-1e6, True)])
@pytest.mark.parametrize("mode, name", [(3, "roll"), (4, "pitch")])
def test_a_body_that_is_not_upright_capsizes(mode, name, restoring, told):
    stiffness = np.diag([0.0, 0.0, 1e6, 1e9, 1e9, 0.0])
    stiffness[mode, mode] = restoring
    said = list(report.failures(state(), stiffness))
    assert bool(said) is told
    assert not told or said[0].startswith(
        f"FAILS: the body capsizes: its restoring in {name} is -1000 kN m/rad, limit 0"
    )
    assert list(report.failures(state(), None)) == []


@pytest.mark.parametrize("left, told", [(0.01, False), (-0.01, True)])
def test_water_at_a_deck_or_a_keel_on_the_bed_fails(left, told):
    for one, words in ((state(gaps={"deck": (5.0, left, 0.1)}),
        "air gap at deck: -0.01 of 5 m are left, limit 0; give"),
                       (state(keel={"bow": (5.0, left, 0.1)}),
                        "under keel, at bow: -0.01 of 5 m are left")):  # fmt: skip
        said = list(report.failures(one, None))
        assert bool(said) is told and (not told or words in said[0])


def climate(deck_gap, keel_gap, rate=1 / (40 * YEAR)):
    points = Point("deck", (0.0, 0.0, 5.0), deck_gap), KeelPoint("bow", (50.0, 0.0, -10.0), keel_gap)
    terms = {relative_name(points[0]): Term(4.0, rate), keel_name(points[1]): Term(2.0, rate)}
    return SimpleNamespace(points=points, long_term=terms.__getitem__, missed=None, height=[1, 2, 3], mean_drift=None)


@pytest.mark.parametrize("more, count", [(0.01, 0), (-0.01, 2)])
def test_in_a_climate_the_rise_once_in_all_years_counts(more, count):
    """4 m · (1 + ½ log 100) = 8 m, and 4 m"""
    assert len(list(report.failures(climate(8.0 + more, 4.0 + more), None, 100.0))) == count


def test_gaps_of_a_climate_are_told_with_how_often_they_are_used_up():
    said = report.notes(climate(9.0, 4.5), 50.0, 100.0)
    assert said[0] == "3 sea states"
    # (1 − 1/100)^100 → e^-1
    assert said[1] == "the value once in 100 years stays unexceeded in 100 years with 37 %"
    assert said[2].startswith(
        "air gap at deck: 1 of 9 m left by the rise once in 100 years, water reaches it once in 40 years"
    )
    assert said[3].startswith("under keel: least at bow, 0.5 of 4.5 m left by the drop once in 100 years, the bed is "
                              "touched once in 40 years")  # fmt: skip
    rare = report.notes(climate(9.0, 4.5, 0.9e-6 / YEAR), 50.0, 100.0)
    assert "less than once in a million years" in rare[2]
    assert "once in 9.09e+05 years" in report.notes(climate(9.0, 4.5, 1.1e-6 / YEAR), 50.0, 100.0)[2]


def test_extremes_of_a_climate_are_once_in_a_year_in_all_years_and_with_ninety_per_cent():
    """With 90 % not exceeded in N years is what is exceeded once in N/−ln 0.9 years; rotations in degrees"""
    terms = {"Heave": Term(2.0), "Roll": Term(0.1), "Sway": Term(1.0)}
    one = SimpleNamespace(excited=np.array([True, True, False]), units=("m", "rad", "m"),
                          names=("Heave", "Roll", "Sway"), long_term=terms.__getitem__)  # fmt: skip
    rows = report.climate_rows(one, 50.0)
    assert rows.columns == ("once_in_1_year", "once_in_50_years", "not_exceeded_90_in_50_years")
    assert rows.names == ["Heave", "Roll"] and rows.units == ["m", "°"]
    shares = [1.0, 1 + 0.5 * math.log10(50), 1 + 0.5 * math.log10(50 / -math.log(0.9))]
    assert rows.values[0] == pytest.approx([2.0 * share for share in shares])
    assert rows.values[1] == pytest.approx([math.degrees(0.1) * share for share in shares])


def test_a_system_of_waves_is_told_with_its_way_in_degrees():
    sea = SimpleNamespace(spectrum=SimpleNamespace(name="jonswap", significant_height=3.0, T01=8.0),
                          direction=-0.5 * math.pi, spreading=None)  # fmt: skip
    said = report.system_in_words(sea)
    assert said == "jonswap spectrum, 3 m, T01 8 s, travelling to 270°, long-crested"
    whole = SimpleNamespace(sea=SimpleNamespace(systems=(sea, sea), spectrum=SimpleNamespace(significant_height=4.243)),
                            duration=10800.0)  # fmt: skip
    assert report.sea_in_words(whole) == f"{said} and {said}, together 4.243 m, 3 h"


def test_drift_is_told_in_kilonewtons_with_its_damping():
    slow = SimpleNamespace(
        drift=np.array([-2e4, 5e3, 4e5]), by_current=np.array([-1e3, 0.0, 0.0]), sigma=np.array([3e4, 1e4, 2e6]),
        difference=np.array([0.0, 0.3]), of_pairs=1, sigma_of_pairs=np.array([4e4, 2e4, 0, 0, 0, 3e6]), level="body",
        damping=np.diag([2e3, 5e3, 0.0]),
    )  # fmt: skip
    assert report._drift_lines(slow, 50.0) == [
        "mean drift: Fx -20, Fy 5 kN, Mz 400 kN m",
        'of it by the current: Fx -1, Fy 0 kN, Mz 0 kN m, which current.waves = "still" leaves out',
        "standard deviation of slow drift, beats up to 0.3 rad/s: Fx 30, Fy 10 kN, Mz 2000 kN m",
        'by qtf = "body": Fx 40, Fy 20 kN, Mz 3000 kN m',
        "wave drift damping: surge 2, sway 5 kN s/m",
    ]


def peak(mode=3, damping=0.05, viscous=False, error=0.0, height=0.02):
    return SimpleNamespace(mode=mode, damping=damping, viscous=viscous, period=12.5, omega=2 * math.pi / 12.5,
                           peak=height, heading=math.radians(90.0), error=error)  # fmt: skip


def test_a_resonance_is_told_in_degrees_per_metre_for_rotations():
    (said,) = resonance_lines([peak()])
    assert said == (
        f"resonance of roll at 12.5 s (0.50265 rad/s): peak {math.degrees(0.02):.3g} °/m in waves towards 90°, damping "
        "ratio 0.05 of waves alone, without the viscous damping that lowers it"
    )
    assert "peak 0.02 m/m" in resonance_lines([peak(mode=2)])[0]
    assert resonance_lines([peak(viscous=True)])[0].endswith("damping ratio 0.05")


@pytest.mark.parametrize("damping, mode, told", [(0.099, 3, True), (0.101, 3, False), (0.05, 0, False), (0.05, 2, True),
                                                (0.05, 5, False)])  # fmt: skip
def test_viscous_damping_counts_for_heave_roll_and_pitch_of_little_wave_damping(damping, mode, told):
    assert bool(underdamped(peak(mode, damping))) is told


@pytest.mark.parametrize("error, told", [(0.049, False), (0.051, True)])
def test_a_peak_uncertain_by_more_than_a_twentieth_is_told(error, told):
    (said,) = resonance_lines([peak(error=error * 0.02)])
    assert ("the peak is uncertain by 5.1 %, limit 5 %: solve 0.502655 rad/s too" in said) is told


@pytest.mark.parametrize("share, told", [(0.81, False), (0.79, True)])
def test_stored_frequencies_that_miss_a_peak_are_told(share, told):
    omega = np.array([0.3, 0.51, 0.8])
    rao = np.zeros((3, 2, 6), complex)
    rao[1, 1, 3], rao[2, 0, 3] = share * 0.02j, 1.0  # far away it is another one's
    (said,) = resonance_lines([peak()], omega, rao)
    assert ("; stored frequencies near it show 79 % of the peak" in said) is told


def test_slow_motion_on_lines_has_yaw_in_degrees_and_shares_in_per_cent():
    motion = SimpleNamespace(
        offset=np.array([1.0, 2.0, 0.1]), period=np.array([80.0, 90.0, 60.0]), ratio=np.array([0.05, 0.06, 0.07]),
        slow=np.array([0.5, 0.6, 0.02]), drift_share=np.array([0.8, 0.7, 0.6]), fast_sigma=np.array([0.3, 0.4, 0.01]),
        estimates=np.array([[0.4, 0.45], [0.5, 0.55], [0.03, 0.04]]), largest=np.array([3.0, 4.0, 0.2]),
        rule=np.array([2.5, 3.5, 0.15]),
    )  # fmt: skip
    names, units, values = moored.table(motion)
    assert names == ("surge", "sway", "yaw") and units == ("m", "m", "°")
    assert values[0] == pytest.approx([1.0, 80.0, 5.0, 0.5, 80.0, 0.3, 0.4, 0.45, 3.0, 2.5])
    d = math.degrees
    assert values[2] == pytest.approx([d(0.1), 60.0, 7.0, d(0.02), 60.0, d(0.01), d(0.03), d(0.04), d(0.2), d(0.15)])
    first, surge, *_ = moored.lines_of_csv(motion)
    assert (
        first.startswith("moored: motion,unit,mean_offset,")
        and surge == "moored: surge,m,1,80,5,0.5,80,0.3,0.4,0.45,3,2.5"
    )


@pytest.mark.parametrize("depth, told", [(16.0, True), (18.5, False)])
def test_bound_long_waves_are_told_of_where_kh_is_below_one(depth, told):
    """ω_p² h/g = kh tanh kh: 0.76 at kh = 1, of 10 s · … here ω_p = 0.65 rad/s: h = 0.7616 · 9.81/0.4225 = 17.7 m"""
    spectrum = SimpleNamespace(peak_omega=0.65)
    said = list(moored._of_bound_waves(spectrum, SimpleNamespace(water_depth=depth, gravity=9.80665)))
    assert bool(said) is told and (not told or said[0].startswith("kh is 0.9"))
