"""Fits of yearly maxima: against scipy, exact invariances, and how often their intervals hold the truth."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

from hakobune.mooring.environment.wind_profile import froya_speed_at, mean_over
from hakobune.mooring.site import extremes
from hakobune.mooring.site.extremes import fit_extremes, plotting_positions
from hakobune.mooring.site.seismic import seismic_coefficient, seismic_force

MAXIMA = stats.gumbel_r.rvs(25.0, 3.0, size=30, random_state=4)


def test_gumbel_and_weibull_fits_are_those_of_maximum_likelihood():
    fit = fit_extremes(MAXIMA)

    def likelihood(b, s):
        y = (MAXIMA - b) / s
        return -len(y) * np.log(s) - np.sum(y + np.exp(-y))

    best = likelihood(fit.location, fit.scale)
    for db, ds in ((1e-4, 0), (-1e-4, 0), (0, 1e-4), (0, -1e-4)):
        assert likelihood(fit.location + db, fit.scale + ds) < best
    k, _, scale = stats.weibull_min.fit(MAXIMA, floc=0)
    fit = fit_extremes(MAXIMA, "weibull")
    assert (fit.shape, fit.scale) == (pytest.approx(k, rel=1e-3), pytest.approx(scale, rel=1e-4))


@pytest.mark.parametrize(
    ("family", "law"),
    [
        ("gumbel", stats.gumbel_r(20, 2)),
        ("weibull", stats.weibull_min(6, scale=20)),
        ("gev", stats.genextreme(0.12, 20, 2)),
    ],
)
def test_a_fit_to_the_quantiles_of_a_law_finds_its_return_values(family, law):
    fit = fit_extremes(law.ppf((np.arange(20000) + 0.5) / 20000), family)
    assert fit.value(100.0) == pytest.approx(law.ppf(0.99), rel=2e-3)


@pytest.mark.parametrize("family", ["gumbel", "weibull", "gev"])
def test_return_values_and_intervals_go_with_the_unit_of_the_maxima(family):
    one, other = fit_extremes(MAXIMA, family), fit_extremes(3.6 * MAXIMA, family)
    assert other.value(50.0) == pytest.approx(3.6 * one.value(50.0), rel=1e-9)
    assert np.allclose(other.interval(50.0), 3.6 * np.array(one.interval(50.0)), rtol=1e-8)


@pytest.mark.parametrize(
    ("family", "law"),
    [("gumbel", stats.gumbel_r(20, 2)), ("weibull", stats.weibull_min(6, scale=20))],
)
def test_nine_of_ten_intervals_hold_the_return_value(family, law):
    samples = law.rvs(size=(400, 8), random_state=11)  # exact even for eight years
    held = 0
    for sample in samples:
        low, high = fit_extremes(sample, family).interval(50.0, samples=500)
        held += low <= law.ppf(0.98) <= high
    assert 341 <= held <= 379  # three deviations of 360


@pytest.mark.parametrize(("years", "shape"), [(20, -0.1), (40, 0.15)])
def test_nine_of_ten_intervals_of_the_general_law_hold_the_return_value(years, shape):
    law = stats.genextreme(shape, 20, 2)
    held = 0
    for sample in law.rvs(size=(400, years), random_state=3):
        low, high = fit_extremes(sample, "gev").interval(50.0, samples=200)
        held += low <= law.ppf(0.98) <= high
    assert 341 <= held <= 379  # three deviations of 360


def test_plotting_positions_are_symmetric():
    p = plotting_positions(9)
    assert np.allclose(p + p[::-1], 1)


@pytest.mark.parametrize(
    ("maxima", "family", "words"),
    [
        ([1, 2, 3, 4], "gumbel", "4 yearly maxima"),
        ([2.0] * 8, "gev", "all yearly maxima are equal"),
        ([-1, 2, 3, 4, 5], "weibull", "above 0"),
        ([1, 2, 3, 4, 5], "normal", "allowed: gumbel"),
    ],
)
def test_maxima_that_fix_no_law_are_one_line(maxima, family, words):
    with pytest.raises(ValueError, match=words):
        fit_extremes(maxima, family)


def test_wind_means_of_other_times_go_there_and_back():
    ten = mean_over(30.0, 3600.0, 600.0)
    assert ten == pytest.approx(float(froya_speed_at(10.0, 30.0, 600.0)), rel=1e-9)
    assert mean_over(ten, 600.0, 3600.0) == pytest.approx(30.0, rel=1e-9)
    assert mean_over(ten, 600.0, 3.0) > ten


def test_seismic_coefficients_are_products_and_rule_a_has_a_largest():
    assert seismic_coefficient("E", ground=1.2, damping=0.8, period=1.5, regional=0.1) == pytest.approx(0.144)
    assert seismic_coefficient("F", regional=0.15, ground=1.2, importance=1.5) == pytest.approx(0.27)
    assert seismic_force(0.2, 100.0, 20.0) == pytest.approx(24.0)
    with pytest.raises(ValueError, match="allowed: 0 to"):
        seismic_coefficient("A", coefficient=0.4)
    with pytest.raises(ValueError, match="B and D give no"):
        seismic_coefficient("B")


@pytest.mark.parametrize("years, value, count, told", [
    (50.0, 9.0, 20, []), (81.0, 9.0, 20, ["extrapolation"]), (80.0, 9.0, 20, []), (50.0, 6.4, 20, ["below 6.5"]),
    (19.9, 6.4, 20, []), (20.0, 6.4, 20, ["below 6.5"]), (20.0, 9.0, 9, ["fewer than 10"]), (20.0, 9.0, 10, []),
    (99.0, 6.0, 9, ["fewer than 10", "extrapolation", "below 6.5"]),
])  # fmt: skip
def test_a_return_value_is_doubted_of_few_years_of_many_times_as_many_and_below_what_was_measured(
    years, value, count, told
):
    """The largest of the maxima is 6.5 m, their mean 4.3 m and less"""
    maxima = np.append(np.full(count - 1, 4.0), 6.5)
    found = extremes.Extreme(value, value - 1, value + 2, SimpleNamespace(maxima=maxima, family="gumbel"))
    said = list(extremes._doubts(found, years, 0.9))
    assert len(said) == len(told) and all(word in one for word, one in zip(told, said, strict=True))
    if count < 10:
        assert f"is {value:.4g}, its 90 % interval {value - 1:.4g} to {value + 2:.4g}" in said[0]
