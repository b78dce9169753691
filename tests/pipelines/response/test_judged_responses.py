"""What `hakobune response` judges and keeps of numbers that are made up: shares, years and both sides of each limit."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.mooring.response.points import KeelPoint, Point, keel_name, relative_name
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.resonances import resonance_lines, underdamped
from hakobune.pipelines.response.findings import _gaps_in_years, failures, notes, sea_in_words, system_in_words, turned
from hakobune.pipelines.response.result import of_climate, of_moored, response, without_rounding
from hakobune.pipelines.results.quantity import Quantity

YEAR = 365.25 * 86400


class Term:
    """A response whose level grows by half its value of a year with every decade of time, and is crossed at a rate"""

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
    said = list(failures(state(), stiffness))
    assert bool(said) is told
    assert not told or f"the body capsizes: its restoring in {name} is -1000 kN m/rad, limit 0" in said[0]
    assert list(failures(state(), None)) == []


@pytest.mark.parametrize("left, told", [(0.01, False), (-0.01, True)])
def test_water_at_a_deck_or_a_keel_on_the_bed_fails(left, told):
    deck, bow = state(gaps={"deck": (5.0, left, 0.1)}), state(keel={"bow": (5.0, left, 0.1)})
    for one, words in (
        (deck, "air gap at deck: -0.01 m of 5 m are left, limit 0; give more freeboard"),
        (bow, "under keel, at bow: -0.01 m of 5 m are left, limit 0; give more water or less draft"),
    ):
        said = list(failures(one, None))
        assert len(said) == told and (not told or words in said[0])


def climate(deck_gap, keel_gap, rate=1 / (40 * YEAR)):
    points = Point("deck", (0.0, 0.0, 5.0), deck_gap), KeelPoint("bow", (50.0, 0.0, -10.0), keel_gap)
    terms = {relative_name(points[0]): Term(4.0, rate), keel_name(points[1]): Term(2.0, rate), "Heave": Term(2.0)}
    terms |= {"Roll": Term(0.1), "Sway": Term(1.0)}
    zero, two = np.zeros(3), np.zeros((3, 3))
    return SimpleNamespace(
        points=points, long_term=terms.__getitem__, missed=None, height=[1, 2, 3], mean_drift=None, period=zero,
        direction=zero, probability=zero, m0=two, m2=two, excited=np.array([True, True, False]),
        units=("m", "rad", "m"), names=("Heave", "Roll", "Sway"),
    )  # fmt: skip


@pytest.mark.parametrize("more, count", [(0.01, 0), (-0.01, 2)])
def test_in_a_climate_the_rise_once_in_all_years_counts(more, count):
    """4 m · (1 + ½ log 100) = 8 m, and 4 m"""
    assert len(list(failures(climate(8.0 + more, 4.0 + more), None, 100.0))) == count


def test_gaps_of_a_climate_are_kept_with_the_years_between_their_being_used_up():
    made, _ = of_climate(climate(9.0, 4.5), 100.0, 50.0)
    for head, at_rest, left in (("air_gap", 9.0, 1.0), ("keel", 4.5, 0.5)):
        assert [made[f"{head}.{key}"].values[0] for key in ("at_rest", "left", "reached")] == pytest.approx(
            [at_rest, left, 40.0]
        )


def test_gaps_of_a_climate_are_told_with_how_often_they_are_used_up():
    said = notes(climate(9.0, 4.5), 100.0)
    assert said[0] == "3 sea states"
    # (1 − 1/100)^100 → e^-1
    assert said[1] == "the value reached once in 100 years is not exceeded in 100 years with a probability of 37 %"
    assert said[2].startswith(
        "air gap at deck: the rise reached once in 100 years leaves 1 of 9 m; water reaches the point once in 40 years"
    )
    assert said[3].startswith(
        "under keel: the drop reached once in 100 years leaves 0.5 of 4.5 m at bow, the least of all points; "
        "the hull touches the bed once in 40 years"
    )
    assert "less than once in a million years" in notes(climate(9.0, 4.5, 0.9e-6 / YEAR), 100.0)[2]
    assert "once in 9.09e+05 years" in notes(climate(9.0, 4.5, 1.1e-6 / YEAR), 100.0)[2]


def test_extremes_of_a_climate_are_once_in_a_year_in_all_years_and_with_ninety_per_cent():
    """With 90 % not exceeded in N years is what is exceeded once in N/−ln 0.9 years; what is not excited has no row"""
    made, axes = of_climate(climate(9.0, 4.5), 50.0, 50.0)
    assert axes["response"].values.tolist() == ["Heave", "Roll"]
    for key, years in (("once_in_1_year", 1), ("once_in_return_period", 50), ("not_exceeded", 50 / -math.log(0.9))):
        share = 1 + 0.5 * math.log10(years)
        assert made[f"response.{key}"].values == pytest.approx([2.0 * share, 0.1 * share])


def test_a_system_of_waves_is_told_with_its_way_in_degrees():
    spectrum = SimpleNamespace(name="jonswap", significant_height=3.0, T01=8.0)
    sea = SimpleNamespace(spectrum=spectrum, direction=-0.5 * math.pi, spreading=None)
    said = system_in_words(sea)
    assert said == "jonswap spectrum, 3 m, T01 8 s, travelling to 270°, long-crested"
    both = SimpleNamespace(systems=(sea, sea), spectrum=SimpleNamespace(significant_height=4.243))
    whole = SimpleNamespace(sea=both, duration=10800.0)
    assert sea_in_words(whole) == f"{said} and {said}, together 4.243 m, 3 h"


@pytest.mark.parametrize("largest, told", [(0.261, False), (0.263, True)])
def test_rotations_beyond_fifteen_degrees_are_no_small_ones(largest, told):
    """0.2618 rad; metres beside them are none"""
    axes = {"response": Quantity(["Heave", "Roll"], ("response",))}
    made = {"response.expected_maximum": Quantity([3.0, largest], ("response",), ("m", "rad"))}
    assert bool(list(turned(made, axes))) is told


def peak(mode=3, damping=0.05, viscous=False, error=0.0, height=0.02):
    return SimpleNamespace(mode=mode, name=DOFS[mode].lower(), damping=damping, viscous=viscous, period=12.5,
                           omega=2 * math.pi / 12.5, peak=height, heading=math.radians(90.0), error=error)  # fmt: skip


def test_a_resonance_is_told_in_degrees_per_metre_for_rotations():
    (said,) = resonance_lines([peak()])
    assert said == (
        f"resonance of roll at 12.5 s (0.50265 rad/s): peak {math.degrees(0.02):.3g} °/m in waves towards 90°, damping "
        "ratio 0.05 of waves alone, without viscous damping, which lowers it"
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
    assert ("the peak is uncertain by 5.1 %, limit 5 %; add 0.502655 rad/s to the frequencies" in said) is told


@pytest.mark.parametrize("share, told", [(0.81, False), (0.79, True)])
def test_stored_frequencies_that_miss_a_peak_are_told(share, told):
    omega = np.array([0.3, 0.51, 0.8])
    rao = np.zeros((3, 2, 6), complex)
    rao[1, 1, 3], rao[2, 0, 3] = share * 0.02j, 1.0  # far away it is another one's
    (said,) = resonance_lines([peak()], omega, rao)
    assert ("; stored frequencies near it show 79 % of the peak" in said) is told


def test_each_number_of_a_slow_motion_on_lines_is_kept_in_its_unit():
    def three(surge):
        return np.array([1.0, 2.0, 3.0]) * surge

    motion = SimpleNamespace(
        offset=three(1.0), period=three(10.0), ratio=three(0.03), slow=three(0.5), drift_share=three(0.2),
        fast_sigma=three(0.7), estimates=np.stack([three(1.1), three(1.3)], axis=1), largest=three(1.7),
        rule=three(1.9), force=np.ones((2, 3, 3)), spectrum=np.full((2, 3), 2.0),
    )  # fmt: skip
    by_hand = {"offset": 1, "natural_period": 10, "damping": 0.03, "slow": 0.5, "drift_share": 0.2, "wave": 0.7,
               "flat_spectrum": 1.1, "beating_force": 1.3, "largest": 1.7, "largest_by_rule": 1.9}  # fmt: skip
    made = of_moored(motion)
    for name, surge in by_hand.items():
        assert made[f"moored.{name}"].values == pytest.approx(three(surge)), name
    units = {name: made[f"moored.{name}"].units() for name in by_hand}
    assert all(u[-1] == "rad" and u[0] == "m" for n, u in units.items() if n not in ("natural_period", "damping",
               "drift_share"))  # fmt: skip
    assert made["moored.damping"].share and made["moored.drift_share"].share and not made["moored.slow"].share


def test_drift_that_symmetry_makes_zero_is_zero_and_a_moment_is_held_against_force_times_radius():
    kept = without_rounding(np.array([1e4, 1e-9, 1e-7]), 50.0)
    assert kept.tolist() == [1e4, 0.0, 0.0]
    assert without_rounding(np.array([1e4, 1.0, 1.0]), 50.0).tolist() == [1e4, 1.0, 1.0]
    among = np.array([[1e4, 0.0, 0.0], [np.nan] * 3])
    assert without_rounding(np.array([0.0, 1e-9, 0.0]), 50.0, among).tolist() == [0.0, 0.0, 0.0]


CLIMATE = {"scatter": "table.csv", "directions": [{"direction_deg": 0.0, "share": 1.0}]}


@pytest.mark.parametrize("study, moored, told", [
    ({"climate": CLIMATE, "current": {"speed": 1.0, "direction_deg": 0.0}}, None, "[current] is given with [climate]"),
    ({"climate": CLIMATE}, "moor.toml", "--moored is given with [climate]"),
])  # fmt: skip
def test_a_climate_is_without_a_current_and_without_lines_before_any_file_is_opened(study, moored, told):
    """Each sea of a climate would have a drift and a pose of its own"""
    with pytest.raises(StudyError) as error:
        response(study, "not_there.h5", moored)
    assert str(error.value) == f"{told}, but it is for [sea] only; leave it out"


def test_every_point_with_a_clearance_has_its_air_gap_in_years():
    """Level of 100 years: twice that of a year, of 2, 1 and 0.5 m; the second has no clearance, a keel is no deck"""
    deck = [Point("bow", (0, 0, 5), 6.0), Point("mast", (0, 0, 50)), Point("stern", (0, 0, 4), 1.5)]
    level = {"bow relative elevation": 2.0, "mast relative elevation": 1.0, "stern relative elevation": 0.5}
    result = SimpleNamespace(points=[*deck, KeelPoint("keel", (0, 0, -5), 1.0)], missed=None,
                             long_term=lambda name: Term(level[name]))  # fmt: skip
    bow, stern = _gaps_in_years(result, 100.0)
    assert bow.startswith("air gap at bow: the rise reached once in 100 years leaves 2 of 6 m; water reaches the")
    assert stern.startswith("air gap at stern: the rise reached once in 100 years leaves 0.5 of 1.5 m")
