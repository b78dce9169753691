"""Mean wind speed at a height above the sea.

    U(z) = C_H U₁₀,   U(z) = U₁₀ (z/10)^α                    SR179 report (1982), chapter 4, section 3.3 and table 1
    U(z) = U₀ [1 + C ln(z/10)] [1 − 0.41 I(z) ln(T/T₀)]      NORSOK N-003 and API RP 2A-WSD (Frøya measurements)
    C = 0.0573 √(1 + 0.15 U₀),   I = 0.06 (1 + 0.043 U₀) (z/10)^−0.22,   T₀ = 1 h

U₁₀ is a 10-minute and U₀ a one-hour mean, both 10 m above the sea.  C_H multiplies the speed, not the pressure. C_H
is the square root of the height coefficient of classification rules. C_H is a table of steps: each band includes its
lower bound and excludes its upper bound. In the middle of the bands α varies from 1/17 at 23 m to 1/11 above 130 m
(the report says about 1/12 to 1/14).
"""

import numpy as np

from .allowed import positive, within

BANDS = np.array(
    [
        0.0,
        15.3,
        30.5,
        46.0,
        61.0,
        76.0,
        91.5,
        106.5,
        122.0,
        137.0,
        152.5,
        167.5,
        183.0,
        198.0,
        213.5,
        228.5,
        244.0,
        259.0,
    ]
)  # m, lower bounds
C_H = np.array(
    [
        1.0,
        1.049,
        1.095,
        1.14,
        1.17,
        1.196,
        1.217,
        1.233,
        1.249,
        1.265,
        1.277,
        1.292,
        1.304,
        1.311,
        1.323,
        1.33,
        1.338,
        1.342,
    ]
)
TEN_MINUTES, HOUR = 600.0, 3600.0
AVERAGING = (1.0, HOUR)  # s, of the Frøya formula: from gusts to its one-hour mean


def speed_at(height, speed_10, exponent=None):
    """Wind speed at heights (…), m, above the sea from the mean `speed_10` at 10 m, m/s; shape (…).

    exponent : α of the power law, 1/15 over smooth sea to 1/3 over rough land; None for the table C_H
    raises : ValueError for heights not above 0, speeds below 0, exponents outside 0 to 0.5
    """
    height = _heights(height)
    within("wind speed at 10 m", speed_10, 0.0, 200.0, "m/s")
    if exponent is None:
        return C_H[np.searchsorted(BANDS, height, side="right") - 1] * speed_10
    return speed_10 * (height / 10.0) ** within("exponent of the wind profile", exponent, 0.0, 0.5)


def froya_speed_at(height, hourly_speed, averaging=HOUR):
    """Largest mean speed over `averaging` seconds in an hour, m/s, at heights (…) m, from the one-hour mean at 10 m;
    shape (…).

    raises : ValueError for heights not above 0, speeds below 0, averaging times outside 1 s to one hour
    """
    height = _heights(height)
    within("one-hour wind speed at 10 m", hourly_speed, 0.0, 200.0, "m/s")
    within("averaging time", averaging, *AVERAGING, "s")
    shear = 0.0573 * np.sqrt(1 + 0.15 * hourly_speed)
    mean = hourly_speed * (1 + shear * np.log(height / 10.0))
    gust = 1 - 0.41 * froya_intensity(height, hourly_speed) * np.log(averaging / HOUR)
    return np.maximum(mean, 0.0) * gust


def mean_over(speed, given, wanted, height=10.0):
    """Mean wind over `wanted` s from the mean wind over `given` s, both in m/s at `height` m, by the Frøya formula.

    raises : ValueError for averaging times outside 1 s to one hour, speeds outside 0 to 200 m/s, and speeds beyond
        the range of the formula at this height (near the sea the formula's mean decreases in very strong wind)
    """
    from scipy.optimize import brentq

    within("wind speed", speed, 0.0, 200.0, "m/s")
    within("averaging time", given, *AVERAGING, "s")
    if speed == 0 or given == wanted:
        return float(speed)
    tried = np.arange(1.0, 201.0)
    reached = np.array([froya_speed_at(height, hourly, given) for hourly in tried])
    if reached.max() < speed:
        raise ValueError(
            f"the wind speed is {speed:.4g} m/s as a mean over {given:g} s at a height of {height:g} m; the "
            f"Frøya formula reaches at most {reached.max():.4g} m/s at this height; give the wind at 10 m"
        )
    upper = tried[np.argmax(reached >= speed)]
    hourly = brentq(lambda u: float(froya_speed_at(height, u, given)) - speed, 1e-9, upper)
    return float(froya_speed_at(height, hourly, wanted))


def froya_intensity(height, hourly_speed):
    """Standard deviation of the wind within an hour over the hourly mean, at heights (…) m; shape (…)"""
    positive("one-hour wind speed at 10 m", hourly_speed, "m/s")
    return 0.06 * (1 + 0.043 * hourly_speed) * (_heights(height) / 10.0) ** -0.22


def _heights(height):
    height = np.asarray(height, float)
    if not np.all((height > 0) & (height < np.inf)):
        wrong = height[~((height > 0) & (height < np.inf))].flat[0]
        raise ValueError(f"height above the sea is {wrong:g} m; allowed: above 0, finite")
    return height


def speed_10(speed, averaging, height, exponent=None):
    """Ten-minute mean at 10 m, m/s, from a mean over `averaging` s at `height` m; exponent : as in `speed_at`"""
    return mean_over(speed, averaging, TEN_MINUTES, height) / float(speed_at(height, 1.0, exponent))
