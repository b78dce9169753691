"""Winds that never blew and directions in radians are told; those of designs are not."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.common.quantities import in_radians
from hakobune.pipelines.common.weather.streams import doubtful_weather


def weather(speed=20.0, knots=None, wind=None, current=None, waves=None):
    def at(degrees):
        return {"direction_deg": degrees, "incidence_deg": None}

    return SimpleNamespace(
        wind=SimpleNamespace(speed=speed, speed_knots=knots, **at(wind)),
        current=None if current is None else SimpleNamespace(**at(current)),
        waves=None if waves is None else SimpleNamespace(**at(waves)),
    )


@pytest.mark.parametrize("speed, knots, told", [(84.0, None, 0), (120.0, None, 1), (None, 160.0, 0), (None, 170.0, 1)])
def test_a_wind_above_all_that_blew_is_told(speed, knots, told):
    """170 kn are 87.5 m/s, 160 kn 82.3 m/s"""
    said = doubtful_weather(weather(speed, knots, wind=90.0))
    assert len(said) == told
    assert not told or said[0].startswith(f"the wind has {120 if speed else 87.46:g} m/s, and the strongest known mean")


@pytest.mark.parametrize("degrees, meant", [
    ([0.0, 0.52, 1.05, 1.57], "0, 30, 60, 90"), ([3.14159], "180"), ([-0.785], "-45"), ([6.283], "360"),
    ([0.0], None), ([0.5], None), ([1.5, 3.0], None), ([0.0, 0.52, 5.0], None), ([2.2], None), ([30.0], None),
    ([6.54], None), ([], None),
])  # fmt: skip
def test_degrees_that_are_multiples_of_15_degrees_in_radians_are_told(degrees, meant):
    said = in_radians("waves.headings_deg", degrees)
    assert len(said) == (meant is not None)
    assert not said or said[0].endswith(f"in degrees; if radians are meant, give {meant}")


def test_each_direction_of_a_study_is_looked_at():
    said = doubtful_weather(weather(wind=1.57, current=90.0, waves=3.14))
    assert [line.split(" is ")[0] for line in said] == ["wind.direction_deg", "waves.direction_deg"]
