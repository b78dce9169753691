"""What downtime makes of simulated states, by hand: largest of years, seas that stop an operation, other moorings."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.downtime import moored, one_state
from hakobune.pipelines.simulate.file import STATISTICS

TIME = np.datetime64("2001-01-01T00", "s") + np.timedelta64(6, "h") * np.arange(4 * 1461)  # four years of 6 h
YEARS = TIME.astype("datetime64[Y]").astype(int) + 1970
HEIGHT = 1.5 + np.cos(np.arange(len(TIME)))


def hindcast(columns=()):
    wave = SimpleNamespace(height=HEIGHT, period=5 + HEIGHT, direction=np.full(len(TIME), 0.5))
    return SimpleNamespace(time=TIME, year=YEARS, hours=6.0, step=21600.0, height=HEIGHT, waves=[wave],
                           columns=dict(columns))  # fmt: skip


class Sure:
    """An interpolant that knows ln of the share used: that of the height over `limit`"""

    scatter = 0.0

    def __init__(self, limit, error=0.0):
        self.limit, self.error = limit, error

    def predict(self, x, height):
        return np.log(height / self.limit), np.full(len(height), self.error)


def limit(label, unit, value, sense="at most"):
    return SimpleNamespace(label=label, criterion=SimpleNamespace(limit=value, unit=unit, sense=sense))


def test_largest_of_years_are_what_is_used_of_each_limit_in_si():
    """Without scatter each hour's largest is the limit times the share used: 900 kN · H/2 and 3° · H/2"""
    mean = np.log(HEIGHT / 2)
    each = {i: (Sure(2.0), mean, np.zeros(len(TIME))) for i in range(3)}
    found = SimpleNamespace(each=each, hours_at=np.arange(len(TIME)))
    limits = [limit("crane: fender reaction ≤ 900 kN", "kN", 900.0), limit("crane: roll ≤ 3°", "deg", 3.0),
              limit("crane: air ≥ 1 m", "m", 1.0, "at least")]  # fmt: skip
    read = SimpleNamespace(simulation=SimpleNamespace(duration_hours=1.0), return_years=10.0)
    made, axes = moored._returned(read, hindcast(), limits, found)
    assert axes["response"].values.tolist() == ["crane: fender reaction", "crane: roll"]
    years = axes["whole_year"].values
    largest = np.array([HEIGHT[year == YEARS].max() for year in years]) / 2
    assert made["return.maxima"].values == pytest.approx(np.outer([900e3, math.radians(3.0)], largest), rel=1e-9)
    assert made["return.value"].unit == ("N", "rad") and len(years) == 4


def test_scatter_goes_by_as_many_realisations_as_a_row_has_runs(monkeypatch):
    """Rows of 6 h have six runs of 1 h: the mean of the largest of six normals is 1.2672 of their deviation, σ 0.645"""
    fit, count = SimpleNamespace(scatter=0.03), len(TIME)
    found = SimpleNamespace(each={0: (fit, np.zeros(count), np.full(count, 0.04))}, hours_at=np.arange(count))
    read = SimpleNamespace(simulation=SimpleNamespace(duration_hours=1.0), return_years=10.0)
    record = hindcast()
    record.year = np.arange(count)  # each row as a year of its own
    monkeypatch.setattr(moored, "whole_years", lambda *_: record.year)
    made, _ = moored._returned(read, record, [limit("a ≤ 1", "", 1.0)], found)
    drawn = np.log(made["return.maxima"].values[0]) / math.hypot(0.03, 0.04)
    assert drawn.mean() == pytest.approx(1.2672, abs=4 * 0.645 / math.sqrt(count))


@pytest.mark.parametrize("error, known", [(0.29, True), (0.31, False)])
def test_an_operation_stops_at_the_height_that_uses_its_limit_where_the_interpolant_is_sure(error, known):
    """ln(H/2) passes 0 at 2 m at every period and direction; an error of 0.3 of it is too much"""
    fits = [SimpleNamespace(name="crane", fit=Sure(2.0, error))]
    found = SimpleNamespace(hours_at=np.arange(len(TIME)), fits=fits)
    read = SimpleNamespace(hindcast=SimpleNamespace(x_axis_compass_deg=30.0),
                           operations=[SimpleNamespace(name="crane"), SimpleNamespace(name="gangway")])  # fmt: skip
    wind = {"wind speed": 4 + 5 * HEIGHT, "wind from": np.full(len(TIME), 1.0)}
    made, axes = moored._limiting(read, hindcast(wind), found)
    height = made["limiting.height"].values
    assert height.shape == (24, 36, 2) and np.all(np.isnan(height[..., 1]))
    assert np.isfinite(height[..., 0]).all() == known
    if known:
        assert height[..., 0] == pytest.approx(2.0, rel=1e-9)
    low, high = np.quantile(5 + HEIGHT, (0.001, 0.999))
    assert axes["period"].values[[0, -1]] == pytest.approx([low, high])
    assert moored._limiting(read, SimpleNamespace(waves=[hindcast().waves[0]] * 2), found) == ({}, {})


def test_limiting_seas_have_the_wind_of_their_height_from_the_waves_and_the_mean_current(monkeypatch):
    """Wind of 5 H − 1 m/s, none below 0.2 m and no more than was measured; the x axis heads to 30° of the compass"""
    count = len(TIME)
    height = np.linspace(0.02, 3.0, count)
    wind, current = np.maximum(5 * height - 1, 0.0), np.full(count, 0.5)
    columns = {"wind speed": 5 * height - 1, "wind from": np.full(count, 1.0), "current speed": current,
               "current to": np.where(np.arange(count) % 2 == 0, 0.2, 0.6)[:count]}  # fmt: skip
    record = hindcast(columns)
    wave = record.waves[0]
    record.waves = [SimpleNamespace(height=height, period=wave.period, direction=wave.direction)]
    seen = []

    def features(numbers, angles):
        seen.append((numbers, angles))
        return np.stack(numbers, axis=1)

    monkeypatch.setattr(moored, "features", features)
    fits = [SimpleNamespace(name="crane", fit=Sure(2.0, 0.1))]
    found = SimpleNamespace(hours_at=np.arange(count), fits=fits)
    read = SimpleNamespace(
        hindcast=SimpleNamespace(x_axis_compass_deg=30.0), operations=[SimpleNamespace(name="crane")]
    )
    moored._limiting(read, record, found)
    ((numbers, angles),) = seen
    H, T, blown, flow = (one[count:] for one in numbers)
    beta, blows, flows = (one[count:] for one in angles)
    assert len(H) == 32 * 24 * 36 and H.min() == pytest.approx(0.1) and H.max() == pytest.approx(3.0)
    assert blown == pytest.approx(np.maximum(5 * H - 1, 0.0)) and blown.max() <= wind.max() * (1 + 1e-12)
    assert flow == pytest.approx(0.5) and flows == pytest.approx(
        np.full(len(H), np.angle(np.exp(1j * columns["current to"]).mean()))
    )
    towards = np.degrees(beta)
    assert np.mod(30.0 - np.degrees(blows) - 180.0, 360.0) == pytest.approx(towards)
    assert sorted(set(np.round(np.degrees(blows)))) == [10.0 * i for i in range(36)]
    assert T.min() >= wave.period.min() and T.max() <= wave.period.max()


def test_what_another_mooring_gains_is_told_with_both_interpolants():
    """± 1.645 √(3² + 4²) h"""
    own = SimpleNamespace(hours=np.array([100.0]), error=np.array([3.0]))
    other = SimpleNamespace(hours=np.array([80.0]), error=np.array([4.0]))
    made, axes = moored._compared(own, [("stiffer", other)])
    assert axes["alternative"].values.tolist() == ["stiffer"]
    parts = {name.split(".")[1]: one.values.tolist() for name, one in made.items()}
    assert parts == {"hours": [[80.0]], "gain": [[20.0]], "error": [[pytest.approx(1.645 * 5)]]}
    assert moored._compared(own, []) == ({}, {})


def body(breaking, ropes=(), fenders=()):
    system = SimpleNamespace(line_names=("bow", "stern"), breaking_load=breaking)
    rope = [SimpleNamespace(name=name, breaking_load=load) for name, load in ropes]
    return SimpleNamespace(
        system=system, berth=SimpleNamespace(ropes=rope, fenders=[SimpleNamespace(name=one) for one in fenders])
    )


def test_quantities_are_those_a_moored_body_has():
    names = ["surge", "sway", "heave", "roll", "pitch", "yaw"]
    assert one_state.names_of(body([np.inf, np.inf])) == names
    assert one_state.names_of(body([np.inf, 1e6]))[6:] == ["tension / breaking load", "breaking load / tension"]
    assert one_state.names_of(body([np.inf, np.inf], fenders=["F"]))[6:] == ["fender deflection", "fender reaction"]


def test_values_of_a_run_are_its_largest_from_the_mean_its_third_and_its_range():
    """Of motions from −1 to 3 about 0.5: 2.5, 4; angles in degrees; tensions of 4e5 in 1e6 and 9e5 in 1.5e6 N: 60 %"""
    made = body([1e6, np.inf], [("rope", 1.5e6)], ["F1", "F2"])
    row = {"mean": 0.5, "largest": 3.0, "smallest": -1.0, "mean_third": 1.8}
    motion = [row.get(name, 0.0) for name in STATISTICS]
    pulls = [[value if name == "largest" else 0.0 for name in STATISTICS] for value in (4e5, 8e5, 9e5)]
    contacts = [[value if name == "largest" else 0.0 for name in STATISTICS] for value in (0.2, 5e5, 0.3, 4e5)]
    still = [[0.0] * len(STATISTICS)] * 2  # wave, wind
    found = one_state._values(made, [*[motion] * 6, *still, *pulls, *contacts])
    assert found["surge"] == {"largest": 2.5, "significant": 1.8, "peak to peak": 4.0}
    assert found["yaw"]["largest"] == pytest.approx(math.degrees(2.5))
    assert found["tension / breaking load"] == pytest.approx(0.6)
    assert found["breaking load / tension"] == pytest.approx(1 / 0.6)
    assert found["fender deflection"] == 0.3 and found["fender reaction"] == pytest.approx(500.0)
    mirrored = [
        {"mean": -0.5, "largest": 1.0, "smallest": -3.0, "mean_third": 1.8}.get(name, 0.0) for name in STATISTICS
    ]
    assert one_state._values(made, [*[mirrored] * 6, *still, *pulls, *contacts])["sway"]["largest"] == 2.5
