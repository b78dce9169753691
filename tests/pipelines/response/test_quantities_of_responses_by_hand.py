"""Quantities of a sea, a climate and a moored body from numbers that are set by hand: units, words, tables, axes."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.climate import Climate
from hakobune.mooring.response.linear import Moments
from hakobune.mooring.response.sea_state import SeaState, SlowForces
from hakobune.pipelines.response import result

NAMES, UNITS = ("surge", "sway", "roll"), ("m", "m", "rad")
M0 = np.array([4.0, 0.0, 0.01])


def sea_state(slow=None):
    """σ of 2 m and 0.1 rad; crossings every 8 s, 2π √(m₀/m₂); sway does not move"""
    omega = np.array([0.5, 0.7])
    m2 = M0 * (2 * np.pi / 8) ** 2
    parts = {"m0": M0, "m2": m2, "m4": m2 * (2 * np.pi / 7.9) ** 2}
    moments = Moments(**{name: parts.get(name, M0) for name in Moments._fields})
    spectrum = np.outer([1.0, 2.0], [1.0, 0.0, 3.0])
    sea = Sea(issc(2.0, mean_period=8.0))
    return SeaState(sea, 10800.0, (), NAMES, UNITS, omega, spectrum, moments, slow, None, ())


def test_responses_in_a_sea_have_their_statistics_without_what_does_not_move():
    made, axes = result.of_sea(sea_state(), 50.0)
    assert axes["response"].values.tolist() == ["surge", "roll"] and axes["omega"].values.tolist() == [0.5, 0.7]
    sigma = np.array([2.0, 0.1])
    assert made["response.sigma"].values == pytest.approx(sigma)
    assert made["response.significant"].values == pytest.approx(2 * sigma, rel=0.02)  # of a narrow spectrum
    assert made["response.zero_crossing_period"].values == pytest.approx([8.0, 8.0])
    assert made["response.period_between_peaks"].values == pytest.approx([7.9, 7.9])
    assert np.all(made["response.expected_maximum"].values > 3.5 * sigma)
    assert np.all(made["response.not_exceeded"].values > made["response.expected_maximum"].values)
    words = {name.partition(".")[2]: (one.unit, one.description, one.table) for name, one in made.items() if one.table}
    both = ("m", "rad")
    assert words == {
        "sigma": (both, "σ", result.MOTIONS), "significant": (both, "highest third", result.MOTIONS),
        "expected_maximum": (both, "largest in 3 h", result.MOTIONS),
        "not_exceeded": (both, f"not exceeded with {100 * result.FRACTILE:.0f} %", result.MOTIONS),
        "zero_crossing_period": ("s", "T zero", result.MOTIONS),
        "period_between_peaks": ("s", "T peaks", result.MOTIONS), "bandwidth": ("", "ε", result.MOTIONS),
    }  # fmt: skip
    assert made["spectrum"].values.tolist() == [[1.0, 3.0], [2.0, 6.0]] and made["spectrum"].record


def slow(**more):
    """Beats of 4 + 2 over 0.5 rad/s: σ² = 1.5; the mean yaw of 1e-12 of the surge is rounding"""
    spectrum = np.array([[4.0, 16.0, 36.0], [2.0, 8.0, 18.0]])
    own = {"damping": None} | more
    return SlowForces(np.array([1e3, 2e3, 1e-9]), np.zeros((2, 3)), np.array([0.0, 0.5]), spectrum, **own)


def test_slow_forces_have_their_mean_and_beats_in_surge_sway_and_yaw():
    made, axes = result.of_sea(sea_state(slow()), 50.0)
    assert made["drift.mean"].values.tolist() == [1e3, 2e3, 0.0]
    assert made["drift.sigma"].values == pytest.approx(np.sqrt([1.5, 6.0, 13.5]))
    for name, words in (("mean", "mean"), ("sigma", "σ of its beats")):
        one = made[f"drift.{name}"]
        assert (one.unit, one.description, one.table) == (("N", "N", "N m"), words, result.DRIFT)
    assert axes["plane"].values.tolist() == ["surge", "sway", "yaw"]
    assert axes["difference"].values.tolist() == [0.0, 0.5]
    assert made["drift.spectrum"].values.shape == (2, 3) and made["drift.spectrum"].record
    assert {name for name in made if name.startswith("drift")} == {"drift.mean", "drift.sigma", "drift.spectrum"}


def test_slow_forces_of_each_body_pairs_current_and_damping_are_there_where_they_are_known():
    each = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    pairs = np.outer([4.0, 2.0], [1.0, 4.0, 0.0, 0.0, 0.0, 9.0])
    more = {"of_each": each, "by_current": np.array([7.0, 8.0, 9.0]), "of_pairs": pairs, "level": "full",
            "damping": np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])}  # fmt: skip
    bodies = [SimpleNamespace(name="a"), SimpleNamespace(name="b")]
    made, axes = result.of_sea(sea_state(slow(**more)), 50.0, bodies)
    for k, (name, unit) in enumerate((("surge", "N"), ("sway", "N"), ("yaw", "N m"))):
        one = made[f"drift.of_each.{name}"]
        assert one.values.tolist() == each[:, k].tolist() and one.unit == unit
        assert (one.description, one.table, one.axes) == (f"mean, {name}", result.EACH, ("body",))
    assert axes["body"].values.tolist() == ["a", "b"] and axes["velocity"].values.tolist() == ["surge", "sway"]
    assert made["drift.by_current"].values.tolist() == [7.0, 8.0, 9.0]
    assert made["drift.mean"].table == "drift of the waves on all bodies together, about the origin of the scene"
    assert made["drift.sigma_of_pairs"].values == pytest.approx(np.sqrt(1.5) * np.array([1.0, 2.0, 3.0]))
    assert made["drift.sigma_of_pairs"].description == 'σ, qtf = "full"'
    damping = made["drift.damping"]
    assert damping.values.tolist() == [[1, 2], [3, 4], [5, 6]] and damping.unit == ("N s/m", "N s/m", "N s")


@pytest.mark.parametrize(("yaw", "kept"), [(1.1, 1.1), (0.9, 0.0)])
def test_a_moment_is_rounding_below_a_share_of_the_largest_force_times_the_radius(yaw, kept):
    """Of 2 kN and a radius of 50 m"""
    size = result.TINY * 2e3 * 50.0
    made = result.without_rounding(np.array([1e3, -2e3, yaw * size]), 50.0)
    assert made == pytest.approx([1e3, -2e3, kept * size])
    among = np.array([[10e3, 0.0, 0.0], [0.0, 0.0, 1e9]])
    five = result.without_rounding(np.array([1e3, 2e3, yaw * size * 5]), 50.0, among)
    assert five[2] == pytest.approx(kept * size * 5)


def climate(drift=None):
    """Two states of a half and a quarter of the time; the first alone moves surge, σ = 2 and T_zero = 10 s"""
    m0 = np.array([[4.0, 0.0], [0.0, 0.0]])
    return Climate(("surge", "sway"), ("m", "m"), np.array([2.0, 1.0]), np.array([8.0, 6.0]), np.array([0.0, 1.0]),
                   np.array([0.5, 0.25]), m0, m0 * (2 * np.pi / 10) ** 2, drift, ())  # fmt: skip


def test_a_climate_has_levels_of_one_year_of_the_return_period_and_of_its_fractile():
    """x = 2 √(2 ln N), N of half a year's cycles of 10 s, of fifty years, and of fifty over −ln of the fractile"""
    made, axes = result.of_climate(climate(), 50.0, 50.0)
    assert axes["response"].values.tolist() == ["surge"] and axes["state"].values.tolist() == [0, 1]
    year = 0.5 * 365.25 * 86400 / 10
    for name, cycles, words in (
        ("once_in_1_year", year, "once in 1 year"), ("once_in_return_period", 50 * year, "once in 50 years"),
        ("not_exceeded", 50 * year / -np.log(result.FRACTILE),
         f"not exceeded in 50 years with {100 * result.FRACTILE:.0f} %"),
    ):  # fmt: skip
        one = made[f"response.{name}"]
        assert one.values == pytest.approx([2 * np.sqrt(2 * np.log(cycles))])
        assert (one.unit, one.description, one.table) == (("m",), words, result.MOTIONS)
    assert made["return_period"].values == 50.0 and made["return_period"].unit == "years"
    for name, values, unit in (
        ("height", [2.0, 1.0], "m"), ("period", [8.0, 6.0], "s"), ("direction", [0.0, 1.0], "rad"),
        ("probability", [0.5, 0.25], ""),
    ):  # fmt: skip
        assert made[f"state.{name}"].values.tolist() == values and made[f"state.{name}"].unit == unit
    assert made["moment.m0"].values.tolist() == [[4.0], [0.0]] and made["moment.m0"].unit == "unit2"
    assert made["moment.m2"].values == pytest.approx(np.array([[4 * (np.pi / 5) ** 2], [0.0]]))
    assert "drift.mean" not in made and "plane" not in axes
    drift = np.array([[8.0, 4.0, 2e3], [4.0, 0.0, 0.0]])
    made, axes = result.of_climate(climate(drift), 50.0, 50.0)
    assert made["state.drift"].values.tolist() == drift.tolist()
    assert axes["plane"].values.tolist() == ["surge", "sway", "yaw"]
    assert made["drift.mean"].values == pytest.approx([5.0, 2.0, 1e3]) and made["drift.mean"].unit == ("N", "N", "N m")


def test_a_moored_body_has_slow_motions_of_the_plane_and_shares_in_per_cent():
    names = ("offset", "period", "ratio", "slow", "drift_share", "fast_sigma", "largest", "rule")
    motion = SimpleNamespace(**{name: np.arange(3.0) + 10 * k for k, name in enumerate(names)},
                             estimates=np.array([[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]]), force=np.zeros((4, 3, 3)),
                             spectrum=np.ones((4, 3)))  # fmt: skip
    made = result.of_moored(motion)
    wanted = {
        "offset": (0.0, "mean"), "natural_period": (10.0, "natural period"), "damping": (20.0, "of critical damping"),
        "slow": (30.0, "σ slow"), "drift_share": (40.0, "of it by drift"), "wave": (50.0, "σ of the waves"),
        "largest": (60.0, "largest"), "largest_by_rule": (70.0, "by rule"),
    }  # fmt: skip
    for name, (first, words) in wanted.items():
        one = made[f"moored.{name}"]
        assert one.values.tolist() == [first, first + 1, first + 2] and one.description == words
        assert one.table == result.MOORED and one.share == (name in ("damping", "drift_share"))
        unit = {"natural_period": "s", "damping": "", "drift_share": ""}.get(name, ("m", "m", "rad"))
        assert one.unit == unit
    assert made["moored.flat_spectrum"].values.tolist() == [1, 2, 3]
    assert made["moored.beating_force"].values.tolist() == [4, 5, 6]
    assert made["moored.force"].axes == ("moored_omega", "plane", "with_plane") and made["moored.force"].record
    assert made["moored.spectrum"].axes == ("moored_omega", "plane")
    for name in names:
        setattr(motion, name, np.arange(6.0))
    motion.estimates = np.ones((6, 2))
    several = result.of_moored(motion, "horizontal")
    assert several["moored.offset"].axes == ("horizontal",) and several["moored.offset"].unit == 2 * ("m", "m", "rad")
    assert several["moored.force"].axes == ("moored_omega", "horizontal", "with_horizontal")


@pytest.mark.parametrize(("years", "words"), [(None, "probability"), (50.0, "once in years")])
def test_gaps_of_points_and_under_the_keel_stand_in_tables_of_their_own(monkeypatch, years, words):
    monkeypatch.setattr(result, "air_gaps", lambda found, asked: {"bow": (8.0, 3.0, 0.1)} if asked == years else {})
    monkeypatch.setattr(result, "keel_gaps", lambda found, asked: {"fore": (6.0, 2.0, 0.2), "aft": (5.0, 1.0, 0.3)})
    made, axes = result._with_gaps({"a": 1}, {"b": 2}, "found", years)
    assert axes["point"].values.tolist() == ["bow"] and axes["keel_point"].values.tolist() == ["fore", "aft"]
    for head, table, columns in (("air_gap", result.AIR, [[8], [3], [0.1]]),
                                 ("keel", result.KEEL, [[6, 5], [2, 1], [0.2, 0.3]])):  # fmt: skip
        for name, unit, said, values in zip(("at_rest", "left", "reached"), ("m", "m", ""), ("at rest", "left", words),
                                            columns, strict=True):  # fmt: skip
            one = made[f"{head}.{name}"]
            assert one.values.tolist() == values and (one.unit, one.description, one.table) == (unit, said, table)
    assert made["a"] == 1 and axes["b"] == 2


@pytest.mark.parametrize(("tide", "extra", "told"), [(0.99, 0.0, False), (1.01, 0.0, True), (0.0, 0.99, False),
                                                     (0.0, 1.01, True), (2.0, 1.5, False)])  # fmt: skip
def test_water_far_from_that_of_the_database_is_told(tide, extra, told):
    """Under a keel of 6 m in 16 m of water are 10 m, of which a share may change: tide less extra draft"""
    size = result.FAR_FROM_DEPTH * 10.0
    whole = SimpleNamespace(points=np.array([[0.0, 0.0, -6.0], [0.0, 0.0, 0.0]]))
    db = SimpleNamespace(water_depth=16.0, mesh=SimpleNamespace(whole=lambda: whole))
    read = SimpleNamespace(keel=SimpleNamespace(tide=tide * size, extra_draft=extra * size))
    said = result._of_depth(read, db)
    assert len(said) == told and all("of 10 m" in line for line in said)
    assert result._of_depth(SimpleNamespace(keel=None), db) == []
