"""A fender of straight lines by hand: what it takes and gives back, larger, doubled, overloaded, on a dolphin."""

import math

import numpy as np
import pytest

from hakobune.mooring.fenders.dolphin import bilinear, in_series
from hakobune.mooring.fenders.families import families, fender_of_family
from hakobune.mooring.fenders.fender import FenderError, fender_of_points
from hakobune.mooring.fenders.hysteresis import advanced, advanced_one, contact_table, followed, reaction_of
from hakobune.mooring.fenders.pneumatic import gas_reaction, pneumatic
from hakobune.mooring.fenders.variability import chosen

K, U = 4e6, 1e6  # N/m of loading and of unloading
LENGTH = 0.1  # m of a return


def spring(**marks):
    """1 m high, loads with K and unloads with U to 0.5 m"""
    x = np.array([0.0, 0.25, 0.5])
    marks = {"rated": 0.4, "allowable": 0.45, "return_length": LENGTH, "corners": True, **marks}
    return fender_of_points("spring", 1.0, x, K * x, U * x, **marks)


def buckling(**marks):
    """2 m high: 1 MN at 0.2 m, 0.6 MN at 0.6 m, 1.2 MN at 1 m"""
    return fender_of_points("buckling", 2.0, [0.0, 0.2, 0.6, 1.0], [0.0, 1e6, 6e5, 1.2e6], corners=True, **marks)


def test_energy_given_back_is_the_area_under_the_return():
    """½ U δ₁², and of the width (K − U) δ a share that falls from 1 to 0 within ℓ: ∫₀^ℓ (1 − v/ℓ)(δ₁ − v) dv

    which is δ₁ ℓ/2 − ℓ²/6; where δ₁ is less than ℓ the way back ends before, at δ = 0
    """
    fender = spring()
    for peak in (0.4, 0.2):
        wanted = 0.5 * U * peak**2 + (K - U) * (peak * LENGTH / 2 - LENGTH**2 / 6)
        assert fender.returned(peak) == pytest.approx(wanted, rel=1e-12)
    peak = 0.05
    wanted = 0.5 * U * peak**2 + (K - U) * (peak**2 / 2 - peak**3 / (6 * LENGTH))
    assert fender.returned(peak) == pytest.approx(wanted, rel=1e-12)
    assert fender.energy(0.4) == pytest.approx(0.5 * K * 0.16, rel=1e-12)


def test_a_path_of_three_turns_by_hand():
    """s falls by Δδ/ℓ on the way back and rises alike; it is 1 once contact is lost"""
    force, states = followed(spring(), [0.3, 0.27, 0.29, 0.15, -0.1, 0.2])
    assert states == pytest.approx([1.0, 0.7, 0.9, 0.0, 1.0, 1.0], abs=1e-12)
    wanted = [U * d + s * (K - U) * d for d, s in zip((0.3, 0.27, 0.29, 0.15), states, strict=False)]
    assert force[:4] == pytest.approx(wanted, rel=1e-12)
    assert force[5] == pytest.approx(K * 0.2, rel=1e-12)


def test_a_state_for_kernels_is_the_state_of_arrays_by_hand():
    """From 0.2 back to 0.15 with ℓ = 0.1 half is lost; met from a gap the state is 1; a gap leaves 1"""
    for state, before, after, wanted in (
        (0.8, 0.2, 0.15, 0.3), (0.8, 0.15, 0.2, 1.0), (0.2, 0.2, 0.1, 0.0), (0.5, -0.3, 0.02, 0.7),
        (0.5, 0.1, -0.01, 1.0), (0.5, 0.1, 0.0, 1.0),
    ):  # fmt: skip
        assert advanced_one(state, before, after, LENGTH) == pytest.approx(wanted, abs=1e-12)
        assert float(advanced(state, before, after, LENGTH)) == pytest.approx(wanted, abs=1e-12)


def test_the_table_of_kernels_marks_where_each_fender_ends_and_whether_it_is_refused_there():
    table = contact_table([spring(), buckling(overload=3e6, return_length=0.3)])
    assert table.marks.tolist() == [[LENGTH, 0.5, 1.0], [0.3, 1.0, 0.0]]
    assert reaction_of(table, 0, 0.3, 0.25) == pytest.approx(0.3 * (U + 0.25 * (K - U)), rel=1e-12)
    assert reaction_of(table, 0, 0.6, 1.0) == pytest.approx(0.6 * K, rel=1e-12)  # led on beyond its end
    assert reaction_of(table, 1, 0.4, 0.0) == pytest.approx(8e5, rel=1e-12)
    assert reaction_of(table, 1, 1.2, 1.0) == pytest.approx(1.2e6 + 0.2 * 3e6, rel=1e-12)
    assert reaction_of(table, 0, -0.1, 1.0) == reaction_of(table, 0, 0.0, 1.0) == 0.0


def test_a_fender_that_buckles_has_passed_its_peak():
    fender = buckling()
    assert fender.largest_reaction(0.1) == pytest.approx(5e5, rel=1e-12)
    assert fender.largest_reaction(0.7) == pytest.approx(1e6, rel=1e-12)
    assert fender.rated_reaction == pytest.approx(1.2e6, rel=1e-12)
    assert fender.rated_energy == pytest.approx(1e5 + 0.4 * 8e5 + 0.4 * 9e5, rel=1e-12)
    assert buckling(rated=0.3).rated_reaction == pytest.approx(1e6, rel=1e-12)
    assert buckling(rated=0.3).rated_energy == pytest.approx(1e5 + 0.4 * 8e5, rel=1e-12)
    assert buckling(rated=0.3).allowable == 0.3 and buckling().rated == 0.5 == buckling().allowable
    assert buckling().return_length == pytest.approx(0.05 * 2.0)


def test_two_fenders_side_by_side_keep_their_laws_in_all_that_they_have():
    twice = spring(overload=2e7).times(2.0)
    assert (twice.height, twice.limit, twice.return_length) == (1.0, 0.5, LENGTH)
    assert twice.overload == pytest.approx(4e7)
    assert float(twice.unloading(0.3)) == pytest.approx(2 * U * 0.3, rel=1e-12)
    assert float(twice.loading(0.6)) == pytest.approx(2 * K * 0.5 + 0.1 * 4e7, rel=1e-12)


def test_energy_beyond_the_table_is_found_where_an_overload_goes_on():
    """½ K d² + K d x + ½ k x² for x beyond d: 0.5 MJ to 0.5 m; with k = 20 MN/m another 1 MJ takes 0.2317 m"""
    made = spring(overload=2e7)
    more = (-2e6 + math.sqrt(4e12 + 2 * 2e7 * 1e6)) / 2e7
    assert made.deflection_at_energy(1.5e6) == pytest.approx(0.5 + more, rel=1e-12)
    assert made.energy(0.5 + more) == pytest.approx(1.5e6, rel=1e-12)
    assert spring().deflection_at_energy(0.4e6) == pytest.approx(math.sqrt(2 * 0.4e6 / K), rel=1e-12)
    assert spring().deflection_at_energy(0.49999e6) < 0.5
    with pytest.raises(FenderError, match=r"500\.1 kJ is requested, but its table ends at 0\.5 m with 500 kJ"):
        spring().deflection_at_energy(0.5001e6)


def test_springs_in_series_by_hand():
    """K and k: the fender has F/K of F/K + F/k; rated, allowable and the end of the table move with the force there"""
    k = 1.2e7
    pair = in_series(spring(), bilinear(k), 11)
    assert float(pair.loading(0.4)) == pytest.approx(0.4 / (1 / K + 1 / k), rel=1e-9)
    assert pair.own(0.4) == pytest.approx(0.4 * k / (K + k), rel=1e-9)
    assert pair.whole(0.3) == pytest.approx(0.3 * (1 + K / k), rel=1e-9)
    assert pair.own(1.0) == pytest.approx(1.0 * k / (K + k), rel=1e-9)  # led on beyond the table
    assert pair.limit == pytest.approx(0.5 * (1 + K / k), rel=1e-9)
    assert pair.rated == pytest.approx(0.4 * (1 + K / k), rel=1e-9) and pair.own_allowable == 0.45
    assert pair.allowable == pytest.approx(max(pair.rated, 0.45))
    assert pair.return_length == pytest.approx(LENGTH * (1 + K / k), rel=1e-9)
    assert pair.rated_reaction == pytest.approx(K * 0.4, rel=1e-9)
    assert pair.rated_energy == pytest.approx(0.5 * K * 0.16 * (1 + K / k), rel=1e-9)
    back = float(pair.unloading(0.3))  # the unloading curve has its own share of the deflection
    assert back == pytest.approx(0.3 / (1 / U + 1 / k), rel=1e-9)
    assert pair.overload is None
    hard = in_series(spring(overload=2e7), bilinear(k), 11)
    assert hard.overload == pytest.approx(1 / (1 / 2e7 + 1 / k), rel=1e-9)


def test_a_dolphin_that_yields_is_softer_beyond():
    deflection = bilinear(2e7, 1e6, 4e6)
    assert deflection(np.array([5e5, 1e6, 1.4e6])) == pytest.approx([0.025, 0.05, 0.05 + 0.1], rel=1e-12)
    assert float(bilinear(2e7)(3e6)) == pytest.approx(0.15)
    for wrong in ((0.0,), (1e7, 0.0), (1e7, 1e6, 0.0)):
        with pytest.raises(FenderError, match="allowed: above 0"):
            bilinear(*wrong)


def test_gas_law_by_hand():
    """D = 2 m, L = 5 m, 50 kPa, half pressed: p = 151.325 · 0.75^−1.4 − 101.325 kPa, flats of b = π/2 m, and
    a = ½ √(4 − 1) = 0.866 m: R = p b (3 + π a/2)"""
    p = 151_325.0 * 0.75**-1.4 - 101_325.0
    wanted = p * math.pi / 2 * (3.0 + math.pi / 2 * math.sqrt(3) / 2)
    assert float(gas_reaction(0.5, 2.0, 5.0, 50e3)) == pytest.approx(wanted, rel=1e-12)
    slow = (151_325.0 / 0.75 - 101_325.0) * math.pi / 2 * (3.0 + math.pi / 2 * math.sqrt(3) / 2)
    assert float(gas_reaction(0.5, 2.0, 5.0, 50e3, 1.0)) == pytest.approx(slow, rel=1e-12)
    made = fender_of_family("pneumatic", 2.0, length=5.0)
    assert float(made.loading(1.0)) == pytest.approx(wanted, rel=1e-9)
    assert (made.rated, made.allowable, made.limit) == pytest.approx((0.55, 0.55, 1.3))
    assert made.returned(1.0) == pytest.approx(float(made.energy(1.0)), rel=1e-12)  # no hysteresis


def test_an_ordinary_fender_has_its_intensity_times_height_and_length_or_height():
    """kN/m² of the table times H L, of a cell H²; strains of the table times H"""
    for family, shape in families().items():
        if shape["intensity"] is None:
            continue
        area = 1.5 * (1.5 if family == "cell" else 4.0)
        made = fender_of_family(family, 1.5, length=None if family == "cell" else 4.0)
        at_rated = np.interp(shape["rated"], shape["strain"], shape["reaction"])
        assert float(made.loading(shape["rated"] * 1.5)) == pytest.approx(
            1e3 * shape["intensity"] * area * at_rated, rel=0.02
        )
        assert made.return_length == pytest.approx(1.5 * shape["return_length"])
        assert made.limit == pytest.approx(1.5 * shape["strain"][-1])
        assert (made.rated, made.allowable) == (shape["rated"], shape["allowable"])
        half = fender_of_family(family, 1.5, rated_reaction=5e5)
        assert float(half.unloading(0.2)) == pytest.approx(
            float(made.unloading(0.2)) * 5e5 / (1e3 * shape["intensity"] * area), rel=1e-9
        )


X = [0.0, 0.2, 0.5]


@pytest.mark.parametrize(
    "make, good, bad, says",
    [
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, 2e6], [0, v, 1e6]), 1e6, 1.01e6, "kN, above the "
        "loading curve of"),
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, 2e6], rated=v), 0.5, 0.505, "its rated strain is 0.505"),
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, 2e6], rated=0.4, allowable=v), 0.5, 0.505, "allowable"),
        (lambda v: fender_of_points("f", 1.0, X, [v, 1e6, 2e6]), 0.0, 1.0, "without deflection its reaction is 1"),
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, 2e6], [v, 0, 0]), 0.0, 1.0, "is 0 N on the loading and 1 N"),
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, v], corners=True), 0.0, -1.0, "reaction at 0.5 m is -1 N"),
        (lambda v: fender_of_points("f", v, X, [0, 1e6, 2e6]), 1.0, 0.0, "height is 0 m"),
        (lambda v: fender_of_points("f", 1.0, [v, 0.2, 0.5], [0, 1e6, 2e6]), 0.0, 0.1, "begin at 0.1"),
        (lambda v: fender_of_points("f", 1.0, [0, v, 0.5], [0, 1e6, 2e6]), 0.4, 0.5, "go from 0.5 to 0.5"),
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, 2e6], overload=v), 1.0, -1.0, "overload stiffness, "
                                                                                        "beyond its table, is -1"),
        (lambda v: fender_of_points("f", 1.0, X, [0, 1e6, 2e6], return_length=v), 1e-3, -1.0, "return length, "
                                                                                              "the deflection "
                                                                                              "between loading "
                                                                                              "and unloading "
                                                                                              "curve, is -1"),
        (lambda v: spring().reaction(v), 0.5, 0.501, "0.501 m (50.1 %) is beyond its table, which ends at 0.5 m (50.0"),
        (lambda v: spring().energy(v), 0.5, 0.501, "beyond its table"),
        (lambda v: spring().returned(v), 0.5, 0.501, "beyond its table"),
        (lambda v: spring().largest_reaction(v), 0.5, 0.501, "beyond its table"),
        (lambda v: spring(overload=1e6).reaction(v), 9.0, math.nan, "deflection is nan m"),
        (lambda v: spring().times(v), 1e-3, 0.0, "factor on its reaction is 0"),
        (lambda v: pneumatic("p", 2.0, v, 5e4), 2.0, 1.99, "length is 1.99 m; allowed: at least its diameter of 2 m"),
        (lambda v: pneumatic("p", v, 9.0, 5e4), 0.1, 0.0, "diameter is 0"),
        (lambda v: pneumatic("p", 2.0, 9.0, v), 1.0, 0.0, "pressure is 0"),
        (lambda v: fender_of_family("cell", 2.0, pressure=v), None, 5e4, "a pressure is given; only pneumatic "
        "fenders have one"),
        (lambda v: fender_of_family("pneumatic", 2.0, length=v), 3.0, None, "the length is missing; a pneumatic "
        "fender needs diameter and length"),
        (lambda v: fender_of_family("pneumatic", 2.0, length=3, rated_reaction=v), None, 1e6, "by diameter, length"),
        (lambda v: fender_of_family("cell", 2.0, rated_reaction=v), 1.0, 0.0, "rated reaction is 0 N"),
        (lambda v: chosen(["ageing"], ageing=(v, 1.0)), 1.0, 1.1, "ageing goes from 1.1 to 1; allowed: above 0"),
        (lambda v: chosen(["ageing"], ageing=(v, 1.0)), 0.01, 0.0, "ageing goes from 0 to 1"),
    ],
)  # fmt: skip
def test_a_fender_is_made_up_to_its_limits_and_refused_beyond(make, good, bad, says):
    make(good)
    with pytest.raises(FenderError) as refused:
        make(bad)
    assert says in str(refused.value) and "\n" not in str(refused.value)


def test_a_fender_that_falls_faster_than_its_dolphin_gives_snaps_through_where_it_begins_to():
    """1 MN at 0.2 m falls to 0.6 MN at 0.6 m, 1 MN/m: a dolphin of 1.01 MN/m gives way slower, one of 0.99 faster"""
    in_series(buckling(), bilinear(1.01e6), 11)
    with pytest.raises(
        FenderError,
        match=r"on its dolphin becomes unstable at 0\.2 m: the fender's reaction "
        r"falls by up to 1000 kN/m",
    ):
        in_series(buckling(), bilinear(0.99e6), 11)
