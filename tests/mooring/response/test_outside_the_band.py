"""Waves beyond the stored frequencies: their share in closed form, what they would add, and from where it is told.

Of S = A ω⁻⁵ exp(−Bω⁻⁴) the part below ω is exp(−B/ω⁴), with B = (5/4)(2π/Tp)⁴."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.findings import missed_response, responses_outside, waves_outside
from hakobune.mooring.response.seas import check_coverage, energy_outside
from hakobune.mooring.response.slow_drift import outside_band

SPECTRUM = issc(3.0, mean_period=8.0)
B = 1.25 * (2 * np.pi / SPECTRUM.Tp) ** 4


def frequency(below):
    """ω below which that share of the energy lies"""
    return (-B / np.log(below)) ** 0.25


def body(below, above):
    """Stored from and to frequencies beyond which those shares lie"""
    return SimpleNamespace(omega=np.linspace(frequency(below), frequency(1 - above), 9))


def test_shares_below_and_above_are_those_of_the_closed_form():
    found = energy_outside(body(0.03, 0.2).omega, SPECTRUM)
    assert found == pytest.approx((0.03, 0.2), rel=1e-4)


def test_what_waves_beyond_the_band_would_add_takes_transfer_functions_at_its_ends():
    """|X|² of each end times the energy beyond it: of two headings with a third and two thirds of it"""
    ends, share = np.array([[[2.0], [1.0]], [[3.0j], [5.0]]]), np.array([1 / 3, 2 / 3])
    transfer = SimpleNamespace(value=np.concatenate([ends[:1], np.full((7, 2, 1), 100.0), ends[1:]]), names=("heave",))
    below, above = (4 / 3 + 2 / 3) * 0.03, (9 / 3 + 2 * 25 / 3) * 0.2
    by_hand = (below + above) * 9.0 / 16
    there = body(0.03, 0.2)
    assert missed_response(there, SPECTRUM, transfer, share) == pytest.approx([by_hand], rel=1e-3)
    for m0, told in ((by_hand * 98.5, True), (by_hand * 99.5, False)):  # 1.005 and 0.995 % of all
        said = list(responses_outside(there, SPECTRUM, transfer, share, np.array([m0])))
        assert bool(said) is told and (not said or "heave 1.0 %" in said[0])


@pytest.mark.parametrize(("below", "above", "words"), [(0.011, 0.0, "longer"), (0.0, 0.011, "shorter")])
def test_a_hundredth_of_the_waves_beyond_the_band_is_told(below, above, words):
    (said,) = waves_outside(body(max(below, 1e-9), max(above, 1e-9)), SPECTRUM)
    assert said.startswith("1.1 % of the wave energy is in waves " + words)
    to = float(said.split(" rad/s (")[0].split()[-1])  # beyond it is half of the limit of a hundredth
    limits = (0.0, to) if words == "longer" else (to, np.inf)
    assert SPECTRUM.moment(0, *limits) / SPECTRUM.moment(0) == pytest.approx(0.005, rel=0.05)
    assert not list(waves_outside(body(0.0095, 0.0095), SPECTRUM))


def test_a_sea_half_beyond_the_band_is_refused():
    check_coverage(body(0.25, 0.245), SPECTRUM)
    with pytest.raises(BetweenError, match=r"50.5 % of the wave energy .* allowed: 50 %"):
        check_coverage(body(0.25, 0.255), SPECTRUM)


def test_components_beyond_the_band_count_by_their_energy():
    """½a² each: 4, 1, 9 and 16 of which the first and last are outside"""
    waves = SimpleNamespace(omega=np.array([0.1, 0.5, 1.0, 3.0]), amplitude=np.array([2.0, 1.0, 3.0, 4.0]))
    assert outside_band(SimpleNamespace(omega=np.array([0.3, 2.0])), waves) == pytest.approx(20 / 30)
