"""How fine the tables of the Green function are and how far they reach, by hand from made-up remainders."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import k0

from hakobune.bem.green import tables
from hakobune.bem.green.piecewise_polynomials import fit_line, fit_pieces, nodes, pieces_per_distance, sample_points
from hakobune.bem.green.tables import NOTHING, TABLE_ONLY, WITH_IMAGES


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5, 1e-8])
def test_pieces_are_as_small_as_the_seventh_root_of_the_accuracy_asks(accuracy):
    """½ (a/d)⁷; modes are summed down to e^(−5) of the accuracy"""
    d = pieces_per_distance(accuracy)
    assert 0.5 / d**7 == pytest.approx(accuracy) and tables._digits(accuracy) == pytest.approx(5 - math.log(accuracy))


@pytest.mark.parametrize("k, depth, draft", [(0.1, 10.0, 4.0), (0.5, 10.0, 4.0), (0.02, 10.0, 9.0)])
def test_waves_of_the_remainder_are_resolved_where_they_have_not_decayed(k, depth, draft):
    """(ε / 8e-5 s)^(1/7)/k with s = 4 e^(−k(2h − d)), 1 at most; no waves, no limit"""
    s = min(1.0, 4 * math.exp(-k * (2 * depth - draft)))
    assert tables._wave_piece(k, depth, draft, 1e-6) == pytest.approx((1e-6 / (8e-5 * s)) ** (1 / 7) / k)
    assert tables._wave_piece(0, depth, draft, 1e-6) == np.inf


def test_a_zone_has_pieces_of_equal_size_in_each_variable():
    """Distances from 3 to 7 m by pieces of 1 m; Y to 2.0002 and V to 1.0001 drafts, 2 and 1 of them, rows of columns"""
    surface = lambda R, Y, V: (np.multiply.outer(R**2, Y + 1), np.multiply.outer(R, V**3))  # noqa: E731
    row, g1, g2 = tables._zone(3.0, 7.0, 0.5, 0.8, surface)
    assert row == [3.0, pytest.approx(1.0), pytest.approx(2 / 1.60016), pytest.approx(1 / 0.80008), 0, 0, 3, 1, 0]
    assert g1.shape == (8, 8, 8) and g2.shape == (4, 8, 8)
    value = lambda piece, x, y: sum(c * x**a * y**b for b, own in enumerate(piece) for a, c in enumerate(own))  # noqa: E731
    # R 4.75 is x = 0.5 in the second column, Y 1.0002 is y = −0.5 in the second row
    assert value(g1[4 + 1], 0.5, -0.5) == pytest.approx(4.75**2 * (0.80008 * 1.25 + 1))
    assert value(g2[3], -1.0, 0.0) == pytest.approx(6.0 * 0.40004**3)
    shallow, _, _ = tables._zone(1000.0, 2000.0, 900.0, 0.1, surface)
    assert shallow[1:4] == pytest.approx([1e-3, 0.5, 0.5])  # a thousandth of the end at least


def test_values_at_the_nodes_of_pieces_are_met_by_their_polynomials():
    x = sample_points([0.0, 1.0, 3.0])
    assert x[:8] == pytest.approx(0.5 + 0.5 * nodes()) and x[8:] == pytest.approx(2.0 + nodes())
    assert nodes() == pytest.approx([-math.cos(math.pi * (n + 0.5) / 8) for n in range(8)])
    line = fit_line(np.stack([x**p for p in range(4)], axis=1))
    powers = 0.25 ** np.arange(8).reshape(4, 2)  # two powers a row, of each of the four functions
    whole = np.einsum("ap,afp->f", powers, line[1].reshape(4, 2, 4).swapaxes(1, 2))
    assert whole == pytest.approx([2.25**p for p in range(4)])
    assert fit_pieces(np.ones((16, 24))).shape == (6, 8, 8)


class Form:
    """Remainder of a slowest mode of 0.9/m"""

    net, mirror, near = 0.3, -1.0, "near"

    def __init__(self):
        self.counts = []

    def modes(self, count):
        self.counts.append(count)
        return np.array([0.9, 2.0]), np.array([1.0, 1.0])


@pytest.mark.parametrize("reach, wanted", [(4.0, 0), (5.1, 1), (39.0, 3), (41.0, 4), (1e4, 4)])
@pytest.mark.parametrize("whole", [False, True])
def test_zones_double_up_to_the_reach_or_where_the_remainder_has_decayed(reach, wanted, whole, monkeypatch):
    """From h/2 on; beyond the last octave that counts G less its wave is without images, or known by the table alone"""
    asked, form, depth, draft, accuracy, k = [], Form(), 10.0, 4.0, 1e-5, 0.2

    def zone(start, end, half, draft, values):
        asked.append((start, end, half, draft, values))
        return [start, *[0.0] * 8], np.full((2, 8, 8), len(asked)), np.full((1, 8, 8), -len(asked))

    monkeypatch.setattr(tables, "_zone", zone)
    made = tables._table(form, 0.3, k, 0.7, depth, reach, draft, accuracy, whole)
    digits = 5 - math.log(1e-4 * accuracy if whole else accuracy)
    octaves = max(math.ceil(math.log2(digits / (0.9 * 5.0))), 1)
    assert octaves == (3 if whole else 2)
    wanted = min(wanted, octaves)
    assert form.counts == [math.ceil(2 * digits / math.pi) + 1]
    ends = [(0.0, 5.0), *((5.0 * 2**n, 10.0 * 2**n) for n in range(wanted))]
    assert [(start, end) for start, end, *_ in asked] == ends and {d for *_, d, _ in asked} == {4.0}
    sharp = 0.05 * accuracy if whole else accuracy
    near = min(tables._wave_piece(k, depth, draft, sharp), (2 * depth - draft) / pieces_per_distance(sharp))
    halves = [near]
    for start, _ in ends[1:]:
        half = start / (pieces_per_distance(accuracy) - 1)
        if whole:
            half = min(half, (accuracy / 1e-5) ** (1 / 7) / 0.9 * max(1.0, math.exp((0.9 * start - 9) / 8)))
        halves.append(half)
    assert [half for _, _, half, *_ in asked] == pytest.approx(halves)
    assert asked[0][-1] == "near"
    assert all((far.digits, far.whole, far.depth) == (pytest.approx(digits), whole, depth) for *_, far in asked[1:])
    rows = [0, *(n for n in range(1, wanted + 1) for _ in range(2 ** (n - 1)))]  # one for each h/2 of R
    assert made.entries == len(rows) and made.zones[:, 0] == pytest.approx([ends[n][0] for n in rows])
    assert made.zones[:, 4].tolist() == [3 * n for n in rows] and made.zones[:, 5].tolist() == [3 * n + 2 for n in rows]
    assert made.pieces[:, 0, 0].tolist() == [part for n in range(1, wanted + 2) for part in (n, n, -n)]
    assert (made.per_metre, made.double_depth, made.net, made.mirror) == (0.2, 20.0, 0.3, -1.0)
    assert made.beyond == (TABLE_ONLY if whole else WITH_IMAGES if wanted == octaves else NOTHING)
    assert (made.K, made.k, made.C) == (0.3, k, 0.7)


@pytest.mark.parametrize("net, mirror, whole", [(0.0, 1.0, False), (0.3, -1.0, False), (0.3, 1.0, True)])
def test_far_away_the_remainder_is_johns_series_less_its_images(net, mirror, whole):
    """Σ 2f K₀(κR) cos κ(2h − Y) and cos κV, as many as matter, and net ln 2h/R; less 1/r of both images and source"""
    h, kappa = 6.0, (np.arange(1, 80) - 0.5) * np.pi / 6.0
    factor = 1.0 / np.arange(1.0, 80.0)
    form = SimpleNamespace(net=net, mirror=mirror)
    far = tables._Far(form, (kappa, factor), h, 18.0, whole)
    R, Y, V = np.array([4.0, 5.0]), np.array([0.5, 3.0, 7.0]), np.array([0.0, 2.0])
    surface, bed = far(R, Y, V)
    log = net * np.log(12.0 / R)[:, None]
    true = [np.einsum("rm,ym->ry", k0(np.outer(R, kappa)) * factor, np.cos(np.outer(at, kappa))) + log
            for at in (12.0 - Y, V)]  # fmt: skip
    if not whole:
        true[0] = true[0] - 1 / np.hypot(R[:, None], 12.0 - Y) - mirror / np.hypot(R[:, None], Y)
        true[1] = true[1] - 1 / np.hypot(R[:, None], V)
    assert surface == pytest.approx(true[0], abs=1e-8) and bed == pytest.approx(true[1], abs=1e-8)


def test_the_limits_and_deep_water_have_no_waves_or_no_pieces():
    """Deep water has no pieces; zero frequency a net flux; of infinite frequency the image has the other sign"""
    deep = tables.wave_table(0.8, np.inf, 9.81, 100.0, 10.0)
    assert (deep.entries, deep.double_depth, deep.beyond, deep.net, deep.mirror) == (0, 0.0, TABLE_ONLY, 0.0, 1.0)
    assert [deep.K, deep.k] == pytest.approx([0.64 / 9.81] * 2)
    zero, high = (tables.limit_table(which, 20.0, 30.0, 5.0) for which in ("zero", "infinity"))
    assert (zero.K, zero.k, zero.C, zero.mirror) == (0, 0, 0, 1.0) and zero.net > 0
    assert (high.net, high.mirror) == (0.0, -1.0)
    for accuracy in (0.99e-8, 1.01e-3):
        with pytest.raises(ValueError, match=r"allowed: 1e-08 to 0\.001"):
            tables.wave_table(0.8, 20.0, 9.81, 100.0, 10.0, accuracy)


def test_a_point_on_the_bed_may_be_below_it_by_rounding():
    """A millionth of a millionth of the depth"""
    from hakobune.bem.green.finite_depth import green

    on_bed = green(5.0, -2.0, -20.0, 0.8, 20.0)[0]
    assert green(5.0, -2.0, -20.0 * (1 + 0.5e-12), 0.8, 20.0)[0] == pytest.approx(on_bed, rel=1e-9)
    with pytest.raises(ValueError, match="allowed: -20 to 0"):
        green(5.0, -2.0, -20.0 * (1 + 4e-12), 0.8, 20.0)


@pytest.mark.parametrize("x", [0.0, 1e-30, 2e-14, 3e-13, 8e-13])
def test_bessel_functions_of_next_to_nothing_are_those_of_two_to_minus_forty(x):
    """Where the table begins: Y₀ and Y₁ grow no more"""
    from plain import plain
    from scipy.special import y0, y1

    deep = plain("bem.green.deep_water")
    j0, found, j1, slope = deep.bessel(x, deep.universal().bessel.reshape(-1))
    least = 2.0**-40
    assert (j0, found) == pytest.approx((1.0, y0(least)), rel=1e-9)
    assert abs(j1) < 1e-11 and slope == pytest.approx(-y1(least), rel=1e-6)


@pytest.mark.parametrize("x, error", [(32.0, 1e-11), (33.75, 1e-11), (900.0, 1e-11),
                                      *((n * math.pi / 2 + 0.1, 2e-14) for n in (21, 22, 23, 24))])  # fmt: skip
def test_far_from_the_origin_bessel_functions_are_hankels_series_up_to_its_ninth_term(x, error):
    """√(2/πx) (P cos χ − Q sin χ), χ = x − νπ/2 − π/4; (4ν² − 1)(4ν² − 9) … (4ν² − (2k − 1)²)/(k! 8ᵏ), DLMF 10.17;
    sine and cosine by twelve powers of what is beyond quarter turns"""
    from plain import plain

    deep = plain("bem.green.deep_water")
    found, scale = deep.bessel(x, deep.universal().bessel.reshape(-1)), math.sqrt(2 / (math.pi * x))
    for order, j, y in ((0, found[0], found[1]), (1, -found[2], -found[3])):
        terms = [1.0]
        for k in range(1, 9):
            terms.append(terms[-1] * (4 * order**2 - (2 * k - 1) ** 2) / (8 * k * x))
        P, Q = (sum((-1) ** (k // 2) * terms[k] for k in range(first, 9, 2)) for first in (0, 1))
        c, s = (part(x - order * math.pi / 2 - math.pi / 4) for part in (math.cos, math.sin))
        assert j == pytest.approx(scale * (P * c - Q * s), abs=error * scale)
        assert y == pytest.approx(scale * (P * s + Q * c), abs=error * scale)


def test_integrals_are_cut_for_the_accuracy_of_the_table_and_of_a_whole_one_four_digits_below(monkeypatch):
    """5 − ln of the accuracy; a whole table's remainder is wanted to 1e-4 of 1/r"""
    kinds = ("PositiveFrequency", "ZeroFrequency", "InfiniteFrequency")
    for kind in kinds:
        monkeypatch.setattr(tables, kind, lambda *them, kind=kind: (kind, *them))
    monkeypatch.setattr(tables, "_table", lambda form, *them, **more: (form, more))
    K, k, _ = tables._wave_numbers(0.8, 20.0, 9.81)
    assert pytest.approx(0.64 / 9.81) == K and k * math.tanh(20 * k) == pytest.approx(K)
    whole = tables.whole_table.__wrapped__(0.8, 20.0, 9.81)
    assert whole == (
        ("PositiveFrequency", K, k, 20.0, pytest.approx(5 - math.log(1e-4 * tables.WHOLE))),
        {"whole": True},
    )
    some = getattr(tables.wave_table, "__wrapped__", tables.wave_table)(0.8, 20.0, 9.81, 30.0, 5.0, 1e-6)
    assert some == (("PositiveFrequency", K, k, 20.0, pytest.approx(5 - math.log(1e-6))), {})
    for which, kind in (("zero", kinds[1]), ("infinity", kinds[2])):
        assert tables.limit_table(which, 20.0, 30.0, 5.0, 1e-4)[0] == (kind, 20.0, pytest.approx(5 - math.log(1e-4)))
    assert tables.whole_table.__wrapped__(0.8, np.inf, 9.81)[0] is None
