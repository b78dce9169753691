"""Wind over height: the report's table, the power law, the Frøya formula."""

import numpy as np
import pytest

from hakobune.mooring.environment.wind_profile import BANDS, C_H, froya_intensity, froya_speed_at, speed_at


def test_the_table_is_the_root_of_the_pressure_coefficients_of_classification_rules():
    pressure = [1.0, 1.1, 1.2, 1.3, 1.37, 1.43, 1.48, 1.52, 1.56, 1.6, 1.63, 1.67, 1.7, 1.72, 1.75, 1.77, 1.79, 1.8]
    assert np.allclose(C_H, np.sqrt(pressure), rtol=0, atol=5.1e-4)


def test_a_band_begins_at_its_lower_bound_and_ends_below_its_upper():
    for low, high, value in zip(BANDS, [*BANDS[1:], 500.0], C_H, strict=True):
        for z in (max(low, 0.1), (low + high) / 2, np.nextafter(high, 0)):
            assert speed_at(z, 20.0) == 20.0 * value


def test_profiles_give_the_speed_at_10_m_there():
    assert speed_at(10.0, 27.0) == 27.0
    assert speed_at(10.0, 27.0, 1 / 7) == 27.0
    assert froya_speed_at(10.0, 27.0) == 27.0


def test_froya_is_a_logarithm_over_height_and_over_averaging_time():
    """Between 10, 30 and 90 m the hourly mean rises by equal steps of U₀ C ln 3; gusts by 0.41 I U ln of the time."""
    low, middle, high = froya_speed_at([10.0, 30.0, 90.0], 20.0)
    assert np.isclose(high - middle, middle - low)
    assert np.isclose(middle - low, 20.0 * 0.0573 * np.sqrt(1 + 0.15 * 20) * np.log(3))
    hour, minute, second = (froya_speed_at(10.0, 20.0, t) for t in (3600.0, 60.0, 1.0))
    assert np.isclose((second - hour) / (minute - hour), 2.0)
    assert np.isclose(minute - hour, 0.41 * froya_intensity(10.0, 20.0) * 20.0 * np.log(60))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: speed_at(0.0, 20.0), "height above the sea is 0 m; allowed: above 0"),
        (lambda: speed_at([10.0, np.nan], 20.0), "height above the sea is nan m"),
        (lambda: speed_at(10.0, -5.0), "wind speed at 10 m is -5 m/s; allowed: 0 to 200"),
        (lambda: speed_at(10.0, 20.0, 7.0), "exponent of the wind profile is 7; allowed: 0 to 0.5"),
        (lambda: froya_speed_at(10.0, 20.0, 0.1), "averaging time is 0.1 s; allowed: 1 to 3600"),
        (lambda: froya_intensity(10.0, 0.0), "one-hour wind speed at 10 m is 0 m/s"),
    ],
)
def test_winds_that_cannot_be_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
