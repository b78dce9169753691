"""Joint law of height and period: of a table made from a known law, and contours by their theorem."""

import numpy as np
import pytest
from scipy.stats import norm

from hakobune.mooring.environment.scatter import Scatter
from hakobune.mooring.site.contours import HOURS, JointLaw, joint_law

LAW = JointLaw((0.7, 1.8, 1.4), (1.0, 0.8, 0.35), (0.06, 0.12, 0.4), "peak_period", 12.0)
HEIGHTS, PERIODS = np.arange(0.25, 14.0, 0.5), np.arange(2.25, 26.0, 0.5)


def table(law):
    """Shares of the classes by the law, ln T integrated over fine heights"""
    fine = np.linspace(-0.25, 0.25, 41)
    rows = []
    for middle in HEIGHTS:
        h = middle + fine
        inside = np.maximum(h[:-1] - law.weibull[0], 0), np.maximum(h[1:] - law.weibull[0], 0)
        low, high = (np.exp(-((part / law.weibull[1]) ** law.weibull[2])) for part in inside)
        mean, spread = law.log_period(0.5 * (h[:-1] + h[1:]))
        ends = norm.cdf((np.log(np.append(PERIODS - 0.25, PERIODS[-1] + 0.25))[:, None] - mean) / spread)
        rows.append(np.diff(ends, axis=0) @ (low - high))
    return Scatter(HEIGHTS, PERIODS, np.array(rows), law.period_kind)


def test_the_law_of_a_table_made_by_a_law_is_that_law():
    """Classes of 0.5 m and 0.5 s: heights to 2e-3, periods to 2 % of the contour"""
    found = joint_law(table(LAW))
    assert np.allclose(found.weibull, LAW.weibull, rtol=2e-3)
    h = np.array([1.5, 3.0, 5.0])
    for mine, true, within in zip(found.log_period(h), LAW.log_period(h), (0.01, 0.01), strict=True):
        assert np.allclose(mine, true, atol=within)
    mine, true = found.contour(50.0), LAW.contour(50.0)
    assert np.allclose(mine, true, rtol=0.02)


def test_the_top_of_a_contour_is_the_return_value_of_the_height_with_its_median_period():
    height, period = LAW.contour(100.0, 3.0)
    beyond = np.exp(-(((LAW.height(1 - 3.0 / (HOURS * 100)) - LAW.weibull[0]) / LAW.weibull[1]) ** LAW.weibull[2]))
    assert beyond == pytest.approx(3.0 / (HOURS * 100), rel=1e-9)
    assert LAW.top(100.0) == pytest.approx((height.max(), period[np.argmax(height)]), rel=1e-12)
    assert height.max() == pytest.approx(float(LAW.height(1 - 3.0 / (HOURS * 100))), rel=1e-9)


def test_a_plane_that_touches_the_contour_has_the_seas_of_its_return_period_beyond_it():
    """4e6 seas at random: of the linear limit in normal space, one of 300 at a return period of 300 seas"""
    rng, seas = np.random.default_rng(2), 300.0
    years = seas * 3.0 / HOURS
    for angle in (0.3, 1.2):
        u = rng.standard_normal((2, 4_000_000))
        beyond = np.mean(np.cos(angle) * u[0] + np.sin(angle) * u[1] > LAW.reach(years, 3.0))
        assert beyond * seas == pytest.approx(1.0, abs=4 * np.sqrt(seas / 4e6))


def test_contours_of_rarer_seas_hold_those_of_commoner_ones():
    tops = [LAW.top(years) for years in (1, 10, 100)]
    assert np.all(np.diff(tops, axis=0) > 0)
    with pytest.raises(ValueError, match=r"have 0\.0292 seas of 3 hours; allowed: above 2"):
        LAW.contour(1e-5)
    few = Scatter([0.5, 1.0, 1.5], [5.0, 6.0], np.ones((3, 2)), "peak_period")
    with pytest.raises(ValueError, match="3 classes of height with waves; allowed: at least 4"):
        joint_law(few)
