"""Eight hours of two years, by hand: what limits are on, what stops which operation, when, from where, and how long."""

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.downtime.every_hour import Shape
from hakobune.mooring.downtime.hindcast import Hindcast, WaveHours
from hakobune.mooring.response.points import KeelPoint, Point
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import lee as behind
from hakobune.pipelines.downtime import moored, passages, result, simulated
from hakobune.pipelines.downtime.answers import YEAR, Verdicts, _by_year, _causes, _three, answers, judged
from hakobune.pipelines.downtime.limits import Hours, limits_of, used_of, value_of
from hakobune.pipelines.downtime.one_state import _values
from hakobune.pipelines.downtime.study import Record as Study
from hakobune.pipelines.downtime.study import make_downtime
from hakobune.pipelines.simulate.file import STATISTICS

NAN, INF = np.nan, np.inf
SCENES = Path(__file__).parents[3] / "pipelines" / "scenes"
WAVES = {"height": "hs", "peak_period": "tp", "direction_from": "dir"}
POINTS = [Point("bow", (50.0, 0.0, 8.0), 8.0), KeelPoint("fore", (40.0, 0.0, -10.0), 6.0),
          KeelPoint("aft", (-40.0, 0.0, -10.0), 5.0)]  # fmt: skip
RESPONSES = {"heave": "m", "roll": "rad", "bow acceleration z": "m/s²"}


def limits(*given):
    hindcast = {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES], "columns": {"level": "l"}}
    return limits_of(
        make_downtime({"hindcast": hindcast, "operations": [{"name": "work", "limits": list(given)}]}),
        POINTS,
        RESPONSES,
    )


def test_limits_are_on_the_largest_of_the_hour_and_what_it_leaves():
    """n = e² waves in the hour: s = √(2 ln n) = 2 and x̄ = σ (2 + γ/2) = 2.2886 σ, of an amplitude"""
    found = limits(
        {"quantity": "heave", "at_most": 4.0},
        {"quantity": "heave", "at_most": 4.0, "statistic": "significant"},
        {"quantity": "roll", "at_most": 5.0, "statistic": "peak to peak"},
        {"quantity": "air gap bow", "at_least": 2.0},
        {"quantity": "under-keel clearance", "at_least": 1.0},
        {"quantity": "significant height", "at_most": 3.0},
        {"quantity": "level", "at_least": 0.5},
    )
    assert [one.label.removeprefix("work: ") for one in found] == [
        "heave ≤ 4 m", "heave, significant ≤ 4 m", "roll, peak to peak ≤ 5 deg", "air gap bow ≥ 2 m",
        "under-keel clearance ≥ 1 m", "significant height ≤ 3 m", "level ≥ 0.5 m",
    ]  # fmt: skip
    sigma = np.array([[2.0, np.radians(1.5), 1.0, 0.5, 1.0], [0.0] * 5, [NAN] * 5])
    names = ("heave", "roll", "bow relative elevation", "fore displacement z", "aft displacement z")
    hours = Hours(names, ("m", "rad", "m", "m", "m"), sigma**2, sigma**2, 2 * np.pi * np.e**2)
    weather = SimpleNamespace(height=np.array([1.5, 4.5, 3.0]), columns={"level": np.array([0.25, 1.0, NAN])})
    x = 2 + 0.5772157 / 2
    by_hand = [
        [2 * x, 0, NAN], [4, 0, NAN], [3 * x, 0, NAN], [8 - x, 8, NAN], [5.25 - x, 6, NAN], [1.5, 4.5, 3],
        [0.25, 1, NAN],
    ]  # fmt: skip
    for one, wanted in zip(found, by_hand, strict=True):
        assert value_of(one, hours, weather) == pytest.approx(wanted, nan_ok=True), one.label
    used = used_of(found, hours, weather)
    shares = [2 * x / 4, 1, 3 * x / 5, 2 / (8 - x), 1 / (5.25 - x), 0.5, 2]
    assert used[0] == pytest.approx(shares) and used[1] == pytest.approx([0, 0, 0, 0.25, 1 / 6, 1.5, 0.5])
    assert np.isnan(used[2]).tolist() == [True] * 5 + [False, True]
    deep = hours._replace(m0=25 * hours.m0, m2=25 * hours.m2)  # water over the point and none under the keel
    assert np.isposinf(used_of(found, deep, weather)[0, 3:5]).all()


@pytest.mark.parametrize(
    ("limit", "words"),
    [
        ({"quantity": "heave", "at_least": 4.0}, "heave is limited from above; give at_most"),
        ({"quantity": "level", "at_most": 4.0, "statistic": "significant"}, "level has no statistic 'significant'"),
        ({"quantity": "heave"}, "neither is given; give one of at_most"),
        ({"quantity": "heave", "at_most": 1.0, "at_least": 1.0}, "both are given"),
        ({"quantity": "heave", "at_most": 0.0}, "at_most is 0; allowed: above 0"),
        (
            {"quantity": "ice", "at_most": 1.0},
            "'ice', which requires a column in hindcast.columns; allowed: significant",
        ),
    ],
)
def test_limits_that_are_none_are_refused(limit, words):
    with pytest.raises(StudyError, match=words):
        limits(limit)


@pytest.fixture(scope="module")
def found():
    """Cranes have two limits, arms one; the fourth hour of the one and the sixth of the other are not known"""
    used = np.array([
        [0.5, 0.5, 0.2], [1.5, 0.5, 1.2], [1.5, 2.0, 0.2], [0.5, 0.5, NAN],
        [NAN, INF, 0.3], [NAN, 0.5, 0.3], [0.2, 0.2, 3.0], [0.5, 0.5, 0.5],
    ])  # fmt: skip
    asked = [SimpleNamespace(operation=number, label=str(i)) for i, number in enumerate((0, 0, 1))]
    operations = [SimpleNamespace(name="cranes", window_hours=12.0), SimpleNamespace(name="arms", window_hours=6.0)]
    study = SimpleNamespace(
        operations=operations, windows_hours=[6.0, 12.0], hindcast=SimpleNamespace(x_axis_compass_deg=90.0)
    )
    going = np.radians([0.0, 0.0, 0.0, 90.0, 0.0, 90.0, -100.0, 90.0])
    record = SimpleNamespace(
        year=np.repeat([2001, 2002], 4), month=np.tile([1, 1, 2, 2], 2), slot=np.array([0, 1, 2, 3, 10, 11, 12, 13]),
        hours=6.0, main=SimpleNamespace(direction=going, height=np.array([0.0] + [1.0] * 7)),
    )  # fmt: skip
    made, axes = answers(study, record, asked, judged(used, asked, 2))
    return {name: np.asarray(one.values) for name, one in made.items()}, axes


def test_hours_are_down_where_a_limit_is_passed_and_known_where_all_are_or_one_stops_them(found):
    made, _ = found
    assert made["downtime.hours"] == pytest.approx([YEAR * 3 / 7, YEAR * 2 / 7])
    assert made["downtime.share"] == pytest.approx([3 / 7, 2 / 7]) and np.isnan(made["downtime.low"]).all()
    assert made["downtime.known"] == pytest.approx([7 / 8, 7 / 8])
    assert made["year.share"] == pytest.approx(np.array([[2 / 4, 1 / 3], [1 / 3, 1 / 4]]))
    assert made["month.share"][:2] == pytest.approx(np.array([[2 / 3, 1 / 4], [1 / 4, 1 / 3]]))
    assert np.isnan(made["month.share"][2:]).all()


def test_causes_are_counted_alone_where_no_other_limit_of_the_operation_stops_it(found):
    made, _ = found
    assert made["cause.hours"] * 7 / YEAR == pytest.approx([2, 2, 2])
    assert made["cause.alone"] * 7 / YEAR == pytest.approx([1, 1, 2])
    assert made["cause.most"] == pytest.approx([1.5, 2.0, 3.0])


def test_sectors_are_those_of_the_compass_that_waves_come_from(found):
    """The x axis heads east: waves along it come from 270°, along y, to its left, from 180°; a calm has none"""
    time, hours = np.zeros(12), np.zeros((12, 2))
    time[[9, 6, 0]] = np.array([3, 2, 1]) / 7
    hours[9], hours[0] = [YEAR * 3 / 7, YEAR / 7], [0, YEAR / 7]
    assert found[0]["sector.time"] == pytest.approx(time) and found[0]["sector.hours"] == pytest.approx(hours)


def test_windows_end_at_stops_gaps_and_unknown_hours(found):
    made, _ = found
    assert made["window.share"] == pytest.approx(np.array([[4, 5], [2, 2]]) / 7)
    assert made["window.often"] == pytest.approx(np.array([[3, 4], [1, 1]]) * YEAR / 42)
    assert made["wait.mean"][:2, 1] == pytest.approx([6 / 4, 6 / 3]) and made["wait.mean"][1, 0] == 0.0
    assert np.isnan(made["wait.mean"][0, 0]) and np.isnan(made["wait.mean"][2:]).all()
    assert made["wait.late"][:2, 1] == pytest.approx([0.7 * 6, 0.8 * 6])


def test_what_is_not_known_of_hours_widens_the_interval_of_equal_years():
    chance, known = np.full((5, 1), 0.5), np.ones((5, 1), bool)
    record = SimpleNamespace(
        year=np.arange(5), month=np.ones(5, int), slot=2 * np.arange(5), hours=1.0,
        main=SimpleNamespace(direction=np.zeros(5), height=np.ones(5)),
    )  # fmt: skip
    study = SimpleNamespace(operations=[SimpleNamespace(name="a", window_hours=1.0)], windows_hours=[1.0],
                            hindcast=SimpleNamespace(x_axis_compass_deg=0.0))  # fmt: skip
    asked = [SimpleNamespace(operation=0, label="a")]
    verdicts = Verdicts(known, np.zeros((5, 1), bool), chance, 0.5 * chance, chance, np.array([0.1]))
    made = answers(study, record, asked, verdicts)[0]
    assert made["downtime.low"].values == pytest.approx(0.5 - 0.1645)
    assert made["downtime.high"].values == pytest.approx(0.5 + 0.1645)
    assert made["downtime.hours_high"].values == pytest.approx(YEAR * 0.6645)


def test_a_state_has_motions_from_their_mean_shares_of_strength_and_fenders():
    names = ["surge", "sway", "heave", "roll", "pitch", "yaw", "wave", "wind", "line", "rope", "depth", "push"]
    rows = {name: dict.fromkeys(STATISTICS, 0.0) for name in names}
    rows["sway"] |= {"mean": 1.0, "largest": 3.0, "smallest": -2.0, "mean_third": 1.25}
    rows["roll"] |= {"mean": 0.0, "largest": np.radians(2.0), "smallest": np.radians(-1.0)}
    for name, value in {"line": 4e5, "rope": 3e5, "depth": 0.4, "push": 5e5}.items():
        rows[name]["largest"] = value
    rope, fender = (SimpleNamespace(name=name, breaking_load=5e5) for name in ("rope", "fender"))
    system = SimpleNamespace(line_names=["line"], breaking_load=np.array([1e6]))
    body = SimpleNamespace(system=system, berth=SimpleNamespace(ropes=[rope], fenders=[fender]))
    made = _values(body, [[rows[name][one] for one in STATISTICS] for name in names])
    assert made["sway"] == pytest.approx({"largest": 3.0, "significant": 1.25, "peak to peak": 5.0})
    assert made["roll"] == pytest.approx({"largest": 2.0, "significant": 0.0, "peak to peak": 3.0})
    assert made["tension / breaking load"] == pytest.approx(0.6)
    assert made["breaking load / tension"] == pytest.approx(1 / 0.6)
    assert made["fender deflection"] == 0.4 and made["fender reaction"] == 500.0
    system.breaking_load = np.array([INF])
    rope.breaking_load = INF
    assert "tension / breaking load" not in _values(body, [[rows[name][one] for one in STATISTICS] for name in names])


# ------------------------------------------------------------------ of the record as a whole


@dataclass(frozen=True)
class Record:
    """Stand-in of a hindcast: its waves, and what of them a test asks for"""

    waves: tuple
    columns: dict = field(default_factory=dict)


def waves(height, period=8.0, direction=0.0):
    height = np.asarray(height, float)
    return WaveHours(height, np.broadcast_to(period, height.shape), np.broadcast_to(direction, height.shape))


def test_an_operation_that_stops_longer_than_it_may_is_told():
    read = SimpleNamespace(operations=[SimpleNamespace(name=str(i), allowed_hours=one)
                                       for i, one in enumerate((10.0, 12.0, None))])  # fmt: skip
    (line,) = result._too_long(read, {"downtime.hours": SimpleNamespace(values=np.array([10.5, 11.9, 99.0]))})
    assert "0 is down 10.5 h a year, limit 10 h" in str(line)


def test_energy_beyond_the_stored_frequencies_is_told_above_a_hundredth_and_refused_above_half():
    """H = 4 m is 1 m²: a fifth is beyond in one of three rows with waves, of both systems together"""
    record = SimpleNamespace(hindcast=Record((waves([4.0, 0.0, 4.0, 0.0]), waves([0.0, 4.0, 0.0, 0.0]))))
    body = SimpleNamespace(omega=2 * np.pi / np.array([20.0, 10.0, 5.0]))

    def said(*kept):
        return list(result._outside(body, record, SimpleNamespace(m0=np.array([[0.0, one] for one in kept]))))

    assert said(0.991, 0.995, 1.0, 0.0) == []
    (line,) = said(0.8, 0.995, 1.0, 0.0)
    assert line.startswith("in 33.3 % of the rows with waves, more than 1 % of the energy lies outside")
    assert "the stored 5 to 20 s, at most 20 %" in line
    with pytest.raises(
        StudyError,
        match=r"in 100 % of the rows.*allowed: at most 50 % of the energy outside, in at "
        r"least half of the rows;",
    ):
        said(0.49, 0.4, 0.9, 0.0)


def test_the_height_that_reaches_a_limit_is_the_room_over_what_a_metre_moves():
    """Of a metre 2.2886 σ: 4 m of heave over it, 6 m of water less 1 m that is to be left, the least of two points"""
    x = 2 + 0.5772157 / 2
    sigma = np.array([[0.5, 0.2, 0.25], [0.0, 0.0, 0.0]])
    hours = Hours(("heave", "fore displacement z", "aft displacement z"), ("m",) * 3, sigma**2, sigma**2,
                  2 * np.pi * np.e**2)  # fmt: skip
    heave, keel = limits({"quantity": "heave", "at_most": 4.0}, {"quantity": "under-keel clearance", "at_least": 1.0})
    at_one = Record((waves([1.0, 1.0]),))
    assert result._height(heave, hours, at_one) == pytest.approx([4 / (0.5 * x), np.inf])
    assert result._height(keel, hours, at_one) == pytest.approx([4 / (0.25 * x), np.inf])


def test_limiting_seas_come_from_the_directions_of_the_compass(monkeypatch):
    """The x axis heads east: what comes from north goes to 270° from it, from west to 0°, from south to 90°"""
    monkeypatch.setattr(result, "hours_of", lambda response, record: record.hindcast.waves[0])
    monkeypatch.setattr(result, "_height", lambda one, hours, at_one: hours.period + 100 * np.degrees(hours.direction))
    record = SimpleNamespace(hindcast=Record((waves([1.0] * 3 + [0.0], [4.0, 6.0, 8.0, 99.0]),)), shapes=[None])
    read = SimpleNamespace(hindcast=SimpleNamespace(x_axis_compass_deg=90.0), operations=[None])
    made, axes = result._limiting(read, record, None, [SimpleNamespace(kind="keel", operation=0)])
    height, periods = made["limiting.height"].values, axes["period"].values
    assert periods[[0, -1]] == pytest.approx([4.0, 8.0], abs=5e-3) and len(periods) == 24
    for place, towards in ((0, 270.0), (27, 0.0), (18, 90.0)):
        assert axes["comes_from"].values[place] == 10.0 * place
        assert height[:, place, 0] == pytest.approx(periods + 100 * towards)
    assert result._limiting(read, record, None, [SimpleNamespace(kind="weather", operation=0)]) == ({}, {})


def test_a_body_that_is_turned_clockwise_meets_waves_as_far_to_its_left(monkeypatch):
    """Waves beyond half a turn stop the work: of 0, 100, 120 and 150° none, turned by 90° three, by −90° one"""
    monkeypatch.setattr(result, "hours_of", lambda response, record: record.hindcast.waves[0].direction)
    monkeypatch.setattr(result, "used_of", lambda limits, hours, hindcast: hours[:, None] / np.pi)
    record = SimpleNamespace(
        hindcast=Record((waves([1.0] * 4, 8.0, np.radians([0, 100, 120, 150.0])),)), shapes=None, planes=None
    )
    read = SimpleNamespace(turned_deg=[0.0, 90.0, -90.0], operations=[None])
    made, axes = result._turned(read, record, None, [SimpleNamespace(operation=0)])
    assert made["turned.hours"].values[:, 0] == pytest.approx(YEAR * np.array([0, 0.75, 0.25]))
    assert axes["turned"].values.tolist() == [0.0, 90.0, -90.0]


def test_waves_behind_a_breakwater_are_those_that_it_lets_pass(monkeypatch):
    """K_T = ½ at all periods: half the height, 2√m₀ of twice the crests"""
    through = np.array([[0.9, 0.5], [0.9, 0.5]])
    of_study = SimpleNamespace(study=SimpleNamespace(design=SimpleNamespace(holding="taut", theory="potential flow")))
    found = SimpleNamespace(labels={"holding": SimpleNamespace(values=np.array(["free, potential flow", "taut"])),
                                    "period": SimpleNamespace(values=np.array([4.0, 8.0]))},
                            __getitem__=None, detail=of_study)  # fmt: skip

    class Found(SimpleNamespace):
        def __getitem__(self, name):
            return through

    monkeypatch.setattr(behind, "breakwater", lambda path: Found(**vars(found)))
    hindcast = {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES]}
    own = {"quantity": "wave height behind", "at_most": 0.5, "statistic": "significant"}
    read = make_downtime({"hindcast": hindcast, "lee": {"study": "b.toml"},
                          "operations": [{"name": "cranes", "limits": [own]}]})  # fmt: skip
    made, response, _ = behind.lee(read, Path())
    record = Study(Record((waves([2.0], 8.0),)), (Shape("jonswap", "peak_period"),))
    object.__setattr__(record.hindcast, "step", 3600.0)
    hours = result.hours_of(response, record)
    assert value_of(made[0], hours, record.hindcast) == pytest.approx([1.0], rel=2e-3)


def test_passing_ships_press_as_the_square_of_their_speed_in_the_hours_that_they_pass(monkeypatch, tmp_path):
    """1000 kN at 100 m and 5 m/s, as d⁻²: at 200 m 250 kN, at 10 m/s 4000; the largest of two in an hour"""
    (tmp_path / "ships.csv").write_text("time,distance [m],speed [m/s]\n2020-01-01T01:10,100,5\n"
                                        "2020-01-01T03:59,100,10\n2020-01-01T03:20,200,5\n"
                                        "2020-01-02T00:00,200,5\n")  # fmt: skip
    time = np.datetime64("2020-01-01T00", "s") + 3600 * np.arange(4)
    hindcast = Hindcast(time, 3600.0, (waves([1.0] * 4),))
    monkeypatch.setattr(passages, "record_of", lambda *words: Study(hindcast, ()))
    monkeypatch.setattr(passages, "passing", lambda study: {
        "largest.force": 1e10 / study.track.distance**2 * np.array([1.0, -2.0, 3.0])})  # fmt: skip
    (tmp_path / "passing.toml").write_text((SCENES / "passing_tanker.toml").read_text())
    base = {"hindcast": {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES]},
            "passages": {"file": "ships.csv", "study": "passing.toml"},
            "operations": [{"name": "arms", "limits": [{"quantity": "passing sway", "at_most": 900.0}]}]}  # fmt: skip
    read = make_downtime(base)
    found = passages.record_with_passages(read, tmp_path, None).hindcast
    unit = 25 / passages.read_study(tmp_path / "passing.toml")[0].track.speed ** 2
    assert found.columns["passing surge"] == pytest.approx(unit * np.array([0.0, 1000.0, 0.0, 4000.0]))
    assert found.columns["passing yaw"] == pytest.approx(3 * found.columns["passing surge"])
    assert "3 of 4 passages in ships.csv fall within" in found.said[-1]
    assert limits_of(read, [], {})[0].label == "arms: passing sway ≤ 900 kN"


# ------------------------------------------------------------------ chances of simulated hours


class Known:
    """Stand-in of an interpolant that knows the chance of each hour; its sums are known to 2 and 3 hours of all"""

    def predict(self, x, height):
        return np.log(np.array([0.5, 2.0, 1.0, 0.1])), np.full(4, 0.2)

    def spread_of_sum(self, x, height, mean, spread, free):
        return 2.0 * free.sum(), 3.0

    def chance(self, mean, spread):
        return np.array([0.1, 0.9, 0.5, 0.0])


def simulated_limits():
    return [SimpleNamespace(operation=0, kind="simulated"), SimpleNamespace(operation=0, kind="weather"),
            SimpleNamespace(operation=1, kind="weather"), SimpleNamespace(operation=0, kind="simulated")]  # fmt: skip


def test_hours_by_states_are_the_chances_where_the_weather_does_not_stop_the_work_by_itself(monkeypatch):
    """Of four hours one is too windy: 1 + 0.1 + 0.9 + 0 of them; the worst of both simulated limits is fitted"""
    asked = []

    def fitted(x, height, used):
        asked.append((x.tolist(), height.tolist(), used.tolist()))
        return Known()

    monkeypatch.setattr(simulated, "fitted", fitted)
    used = np.array([[[0.2, 0.9, 0.9, 0.4]], [[0.8, 0.9, 0.9, 0.3]]])  # two states, one seed
    exact = np.array([[NAN, 0.5, 9.0, NAN], [NAN, 0.5, 0.1, NAN], [NAN, 1.5, 0.1, NAN], [NAN, 1.0, 0.1, NAN]])
    read = SimpleNamespace(operations=[SimpleNamespace(name="cranes"), SimpleNamespace(name="arms")])
    x, height = np.arange(8.0).reshape(4, 2), np.array([1.0, 2.0, 3.0, 4.0])
    (fit,) = simulated._fits(read, simulated_limits(), x, height, np.array([3, 1]), used, exact)
    assert asked == [([[6, 7], [2, 3]], [4, 2], [[0.4], [0.8]])]
    assert (fit.name, fit.free.tolist()) == ("cranes", [True, True, False, True])
    assert fit.hours == pytest.approx(YEAR / 4 * 2.0) and fit.error == pytest.approx(YEAR / 4 * 6)
    assert fit.sea == pytest.approx(YEAR / 4 * 3)


def test_verdicts_are_sure_by_the_weather_and_chances_by_states():
    """Five hours, of which the third has no waves: what is simulated is not known there, the weather alone is"""
    read = SimpleNamespace(operations=[SimpleNamespace(name="cranes"), SimpleNamespace(name="arms")])
    exact = np.array([[NAN, 0.5, 9.0, NAN], [NAN, 0.5, 0.1, NAN], [NAN, 0.5, 0.1, NAN], [NAN, 1.5, 0.1, NAN],
                      [NAN, 0.5, NAN, NAN]])  # fmt: skip
    rows = np.array([0, 1, 3, 4])
    fit = simulated.Fit("cranes", Known(), *Known().predict(0, 0), None, 0.0, 3.0, 4.0)
    record = SimpleNamespace(time=np.arange(5))
    each = dict.fromkeys((0, 3), (Known(), *Known().predict(0, 0)))
    made = simulated._verdicts(simulated_limits(), record, rows, exact, [fit], each, read)
    assert made.known.T.tolist() == [[True, True, False, True, True], [True, True, True, True, False]]
    assert made.chance[[0, 1, 3, 4], 0].tolist() == [0.1, 0.9, 1.0, 0.0] and made.chance[:4, 1].tolist() == [1, 0, 0, 0]
    assert made.used[rows, 0] == pytest.approx([0.5, 2.0, 1.0, 0.1]) and np.isnan(made.used[2, 0])
    assert made.beyond[rows, 3].tolist() == [0.1, 0.9, 0.5, 0.0] and made.beyond[:4, 2].tolist() == [1, 0, 0, 0]
    assert made.error == pytest.approx([5.0 / YEAR, 0.0])
    assert made.down[3, 0] and not made.down[4, 0] and made.down[0, 1] and not made.down[2, 0]


def test_the_height_at_the_limit_is_between_levels_in_ln():
    """ln of the share goes from −0.1 at 1 m to 0.3 at 4 m: 0 at 4^¼ m; of one that never stops, or is unknown, none"""
    used = np.array([[[-0.1, -2.0, np.nan]], [[0.3, -1.0, 0.5]]])
    np.testing.assert_allclose(moored.crossed(np.array([1.0, 4.0]), used), [[4**0.25, NAN, NAN]])


def test_other_moorings_gain_the_hours_that_they_do_not_stop():
    one, other = (SimpleNamespace(hours=np.array(hours), error=np.array(error))
                  for hours, error in (([100.0, 9.0], [3.0, 0.0]), ([60.0, 9.5], [4.0, 1.0])))  # fmt: skip
    made, axes = moored._compared(one, [("stiffer", other)])
    assert made["alternative.gain"].values.tolist() == [[40.0, -0.5]]
    np.testing.assert_allclose(made["alternative.error"].values, [[1.645 * 5, 1.645]])
    assert axes["alternative"].values.tolist() == ["stiffer"] and moored._compared(one, []) == ({}, {})


def test_the_largest_of_years_is_drawn_of_the_law_of_each_hour(monkeypatch):
    """used = e^{0.1 z}, of 2 deg: the largest of 8766 hours is 2 exp(0.1 z), Φ(z)^8766 = ½ in half of the years"""
    years = 40
    limit = SimpleNamespace(label="cranes: roll ≤ 2 deg",
                            criterion=SimpleNamespace(sense="at most", limit=2.0, unit="deg"))  # fmt: skip
    n = 8766 * years
    hindcast = SimpleNamespace(height=np.ones(n), year=np.repeat(np.arange(years), 8766), step=3600.0, hours=1.0)
    fit = SimpleNamespace(scatter=0.1)
    found = SimpleNamespace(each={0: (fit, np.zeros(n), np.zeros(n))}, hours_at=np.arange(n))
    read = SimpleNamespace(simulation=SimpleNamespace(duration_hours=1.0), return_years=50.0)
    made, axes = moored._returned(read, hindcast, [limit], found)
    assert made["return.value"].unit == ("rad",) and axes["response"].values.tolist() == ["cranes: roll"]
    z = 3.7779  # Φ⁻¹(0.5^(1/8766))
    assert np.median(made["return.maxima"].values) == pytest.approx(np.radians(2 * np.exp(0.1 * z)), rel=0.01)


@pytest.mark.parametrize("count", [1, 12, 13])
def test_shares_of_up_to_twelve_years_are_printed_and_of_more_are_in_files_alone(count):
    """Two operations in four hours a year, of which one is unknown: 1 of 3 and 0, 1 … of 4"""
    year = np.repeat(np.arange(2000, 2000 + count), 4)
    known = np.ones((4 * count, 2), bool)
    known[::4, 0] = False
    down = np.zeros((4 * count, 2))
    down[1::4, 0], down[: 4 * (count // 2), 1] = 1.0, 1.0
    (found,) = _by_year(down, known, SimpleNamespace(year=year), np.unique(year)).values()
    assert found.axes == ("year", "operation") and found.share and bool(found.table) is (count <= 12)
    whole = (np.arange(count) < count // 2).astype(float)
    assert found.values == pytest.approx(np.stack([np.full(count, 1 / 3), whole], axis=1))


def test_limits_of_a_simulation_are_on_what_it_gives_and_on_the_weather():
    """A name that responses have too is that of the simulation, in its unit"""
    given = [{"quantity": name, "at_most": 2.0} for name in ("roll", "surge", "significant height")]
    hindcast = {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES]}
    read = make_downtime({"hindcast": hindcast, "operations": [{"name": "work", "limits": given}]})
    found = limits_of(read, [], {"roll": "rad"}, {"roll": "deg", "surge": "m"})
    assert [(one.kind, one.label) for one in found] == [
        ("simulated", "work: roll ≤ 2 deg"), ("simulated", "work: surge ≤ 2 m"),
        ("weather", "work: significant height ≤ 2 m"),
    ]  # fmt: skip
    with pytest.raises(StudyError, match=r"no simulation of this study gives .surge.; allowed: sig.* height, roll"):
        limits_of(read, [], {"surge": "m"}, {"roll": "deg"})


@pytest.mark.parametrize(("values", "printed"), [([1.0, NAN], True), ([NAN, NAN], False), ([1.0, 2.0], True)])
def test_ends_of_an_interval_are_printed_where_one_of_them_is_known(values, printed):
    three = np.ones(2), np.array(values), np.array(values) + 1
    made = _three("head", "table", ("operation",), three, "mean of", "h", False)
    assert {name: (one.description, bool(one.table), one.unit, one.share) for name, one in made.items()} == {
        "head.mean": ("mean of", True, "h", False), "head.low": ("90 % from", printed, "h", False),
        "head.high": ("90 % to", printed, "h", False),
    }  # fmt: skip
    assert made["head.high"].values == pytest.approx(np.array(values) + 1, nan_ok=True)
    assert "head.share" in _three("head", "table", ("operation",), (np.ones(2),) * 3, "share of")


def test_a_limit_stops_alone_by_the_chance_that_no_other_of_its_operation_does():
    """Chances of 0.5 and 0.2 in the first hour, of 1 and 0 in the second, the third is not known: 0.5 · 0.8 + 1 of
    two hours, and 0.2 · 0.5 + 0; a limit of another operation makes no difference"""
    limits = [SimpleNamespace(operation=i) for i in (0, 0, 1)]
    beyond = np.array([[0.5, 0.2, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]])
    used = np.array([[0.9, 0.8, INF], [1.2, 0.4, 2.0], [NAN, 3.0, NAN]])
    known = np.array([[True, True], [True, True], [False, True]])
    made = _causes(known, SimpleNamespace(beyond=beyond, used=used), limits)
    assert made["cause.hours"].values == pytest.approx(YEAR * np.array([1.5 / 2, 0.2 / 2, 1.0]))
    assert made["cause.alone"].values == pytest.approx(YEAR * np.array([1.4 / 2, 0.1 / 2, 1.0]))
    assert made["cause.most"].values == pytest.approx([1.2, 3.0, 2.0]) and made["cause.most"].share
