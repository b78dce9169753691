"""Headings from others: mirror images, turns, and regression with the waves over the plan, each by its formula."""

import numpy as np
import pytest

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.between_headings import NUGGET, AtHeadings, is_turned, ring, whole_mirrors

DEG = np.pi / 180
THETA = np.arange(16) * np.pi / 8
HALF, MIDDLE, NONE = np.array([50.0, 20.0]), np.array([10.0, -4.0]), np.zeros(2)


def of_plane_wave(beta):
    """Six forces of a symmetric body that are smooth in the heading: each with the parity of its mode"""
    c, s = np.cos(beta), np.sin(beta)
    return np.stack([c, s, 1 + c * c, s * (1 + c * c), -c * (2 - s * s), c * s], axis=-1) * (1 + 0.5j)


def drift_of(beta):
    c, s = np.cos(beta), np.sin(beta)
    return np.stack([c * (1 + s * s), s * (2 + c * c), c * s], axis=-1)


@pytest.mark.parametrize("symmetry, others", [("y", [-30]), ("x", [150]), ("xy", [-30, 150, 210])])
def test_images_of_a_stored_wave_have_the_images_of_its_forces_drift_and_kochin_functions(symmetry, others):
    """(+ − + − + −) in y = 0, (− + + + − −) in x = 0; a Kochin function of angles, mirrored like the wave"""
    stored = np.array([30.0]) * DEG
    made = ring(stored, THETA, symmetry)
    assert sorted(np.round(made.headings / DEG, 9)) == sorted(np.mod([30, *others], 360).tolist())
    assert made.of_forces(of_plane_wave(stored)) == pytest.approx(of_plane_wave(made.headings), abs=1e-12)
    assert made.of_drift(drift_of(stored)) == pytest.approx(drift_of(made.headings), abs=1e-12)

    def H(beta):  # H(θ′; β′) = H(θ; β) of a body with both planes
        x, y = np.cos(THETA) * np.cos(beta)[:, None], np.sin(THETA) * np.sin(beta)[:, None]
        return x + 1j * y + 2 * x * y + np.cos(2 * THETA)

    assert made.of_kochin(H(stored)) == pytest.approx(H(made.headings), abs=1e-12)


def test_headings_along_a_plane_are_their_own_image_and_stored_once():
    made = ring(np.array([0.0, 90.0, 180.0]) * DEG, THETA, "xy")
    assert np.round(made.headings / DEG).tolist() == [0, 90, 180, 270]
    assert made.source.tolist() == [0, 1, 2, 1]  # a stored heading goes before an image


def test_gaps_of_forty_five_degrees_are_the_widest():
    for apart in (44.9, 45.1):
        made = ring(np.array([0.0, apart, 90.0, 135, 180, 225, 270, 315]) * DEG, THETA, "")
        wide = apart == 45.1
        if not wide:
            assert made.inside([20 * DEG]) == pytest.approx([20 * DEG])
            with pytest.raises(
                BetweenError, match=r"wave direction 60° does not lie between stored headings at most 45° apart"
            ):
                made.inside([60 * DEG])
            continue
        with pytest.raises(
            BetweenError,
            match=r"wave direction 20° does not lie between stored headings at most 45° .* \(0, 45.1, 90, 135, 180",
        ):
            made.inside([20 * DEG])
        assert made.inside([60 * DEG, 0.0]) == pytest.approx([60 * DEG, 0.0])
    assert ring(np.array([0.0]), THETA, "", is_round=True).gap(1.0) == 0.0
    assert ring(np.array([0.0]), THETA, "", from_others=True).gap(1.0) == 0.0
    assert ring(np.array([0.0, 60.0]) * DEG, THETA, "").gap(20 * DEG) == pytest.approx(60 * DEG)


def test_stored_headings_are_found_within_a_thousand_millionth_whatever_turn_they_are_given_with():
    made = ring(np.array([10.0, 350.0]) * DEG, THETA, "")
    wanted = np.array([10 * DEG + 0.9e-9, 10 * DEG + 1.1e-9, -10 * DEG, 370 * DEG])
    assert made.stored(wanted).tolist() == [0, -1, 1, 0]


def kernel(k, a, b, half, middle):
    """exp(ik c·Δ) f(ka Δ_x) f(kb Δ_y), f(x) = 0.8 sin x / x + 0.2 cos x"""

    def f(x):
        return 0.8 * np.sinc(x / np.pi) + 0.2 * np.cos(x)

    dx = np.cos(a)[:, None] - np.cos(b)
    dy = np.sin(a)[:, None] - np.sin(b)
    return np.exp(1j * k * (middle[0] * dx + middle[1] * dy)) * f(k * half[0] * dx) * f(k * half[1] * dy)


@pytest.mark.parametrize("middle", [NONE, MIDDLE])
@pytest.mark.parametrize("quadratic", [False, True])
@pytest.mark.parametrize("k", [0.1, 0.005])
def test_values_between_and_their_deviations_are_those_of_regression_with_the_plan(middle, quadratic, k):
    """κ (κ + ν)⁻¹ f and σ² {1 − κ (κ + ν)⁻¹ κ* − 2ν}, σ² = f* (κ + ν)⁻¹ f over the independent values; κ² of drift;
    waves longer than ka = 2 as that one"""
    headings = np.arange(0, 360, 30.0) * DEG
    made = ring(headings, THETA, "")
    wanted = np.array([40.0, 95.0, 120.0]) * DEG
    values = drift_of(headings)[None] if quadratic else of_plane_wave(headings)[None]
    at = AtHeadings(made, wanted, np.array([k]), HALF, middle, quadratic)
    longest = max(k, 2.0 / 50.0)
    own, row = (kernel(longest, one, headings, HALF, middle) for one in (headings, wanted))
    if quadratic:
        own, row = (np.abs(kernel(longest, one, headings, HALF, NONE)) ** 2 for one in (headings, wanted))
    inverse = np.linalg.inv(own + NUGGET * np.eye(12))
    expected = row @ inverse @ values[0]
    expected[2] = values[0, 4]
    found = at.value(values, "drift" if quadratic else "force")
    assert found[0] == pytest.approx(expected, rel=1e-5, abs=1e-6 * np.abs(expected).max())
    left = 1 - np.einsum("ui,ij,uj->u", row, inverse, row.conj()).real - 2 * NUGGET
    left[2] = 0.0
    scale = np.einsum("im,ij,jm->m", values[0].conj(), inverse, values[0]).real / 5
    deviation = at.deviation(values, 5)[0]
    assert deviation == pytest.approx(
        np.sqrt(np.maximum(left, 0)[:, None] * scale), rel=2e-2, abs=1e-4 * np.sqrt(scale.max())
    )


def test_a_turned_wave_on_a_round_body_turns_its_forces_drift_and_kochin_function():
    made = ring(np.array([20.0]) * DEG, THETA, "xy", is_round=True)
    wanted, alpha = np.array([20.0, 65.0]) * DEG, 45 * DEG
    at = AtHeadings(made, wanted, np.array([0.1]), HALF, NONE)
    force = np.array([[[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]]]) * (1 + 1j)
    c, s = np.cos(alpha), np.sin(alpha)
    turned = np.array([c - 2 * s, s + 2 * c, 3, 4 * c - 5 * s, 4 * s + 5 * c, 6]) * (1 + 1j)
    assert at.value(force, "force")[0] == pytest.approx(np.array([force[0, 0], turned]))
    assert at.value(force.real[..., :3], "drift")[0, 1] == pytest.approx([c - 2 * s, s + 2 * c, 3])
    H = (np.cos(THETA - 0.3) + 1j * np.sin(2 * THETA))[None, None]
    moved = np.cos(THETA - alpha - 0.3) + 1j * np.sin(2 * (THETA - alpha))
    assert at.value(H.copy(), "kochin")[0, 1] == pytest.approx(moved, abs=1e-12)
    spread = np.array([[[3.0, 4.0, 1.0, 1.0, 2.0, 1.0]]])
    found = at.unfolded_deviation(spread, "force")[0, 1]
    assert found == pytest.approx(np.sqrt([12.5, 12.5, 1.0, 2.5, 2.5, 1.0]))  # c² = s² = ½ of both


def test_a_wave_out_of_reach_has_the_force_of_the_nearest_stored_one_along_its_own_direction():
    """60° is nearer to 90° than to 0°; 350° is 10° from 0°; 0° itself is the stored force"""
    made = ring(np.array([0.0, 90.0]) * DEG, THETA, "")
    stored = {0.0: np.array([2.0, 0.0, 3.0, 0.0, 4.0, 0.0]), 90.0: np.array([0.0, 2.5, 3.0, -4.0, 0.0, 1.0])}
    c, s = np.cos(10 * DEG), np.sin(10 * DEG)

    def value(headings):
        return np.array([[stored[round(np.rad2deg(one) % 360, 6) % 360] for one in headings]])

    found = made.turned(value, np.array([0.0, 60.0, 350.0]) * DEG, "force")[0]
    assert found[0].tolist() == stored[0.0].tolist()
    assert found[1] == pytest.approx([2.5 * np.sin(30 * DEG), 2.5 * np.cos(30 * DEG), 3,
                                      -4 * np.cos(30 * DEG), 4 * np.sin(30 * DEG), 1.0])  # fmt: skip
    assert found[2] == pytest.approx([2 * c, -2 * s, 3, 4 * s, 4 * c, 0])
    assert made.reached(np.array([0.0, 60.0, 90.0]) * DEG).tolist() == [True, False, True]


def test_beside_a_wall_waves_towards_minus_beta_are_those_towards_beta_later():
    """exp(−2ikw sin β) of F(β), seen from β < 0: exp(2ikw sin(−|β|))"""
    w, k = 40.0, np.array([0.1])
    made = ring(np.arange(0, 181, 30.0) * DEG, THETA, "x", wall=w)
    assert made.reflected(np.array([20.0, -20.0, -30.0, 200.0]) * DEG).tolist() == [False, True, True, True]
    at = AtHeadings(made, np.array([60.0, -60.0]) * DEG, k, HALF, NONE)
    values = of_plane_wave(made.headings)[None]
    found = at.value(values, "force")[0]
    assert found[0] == pytest.approx(of_plane_wave(np.array([60 * DEG]))[0])
    assert found[1] == pytest.approx(found[0] * np.exp(-2j * 0.1 * w * np.sin(60 * DEG)))
    drift = at.value(drift_of(made.headings)[None], "drift")[0]
    assert drift[1] == pytest.approx(drift[0])
    assert made.gap(-50 * DEG) == pytest.approx(30 * DEG)  # of 50°, between 30 and 60°
    other = ring(-np.arange(0, 181, 30.0) * DEG, THETA, "x", wall=w)  # stored on the other side
    assert other.reflected(np.array([20.0, -20.0]) * DEG).tolist() == [True, False]


def test_a_plane_is_one_of_symmetry_where_all_matrices_and_the_centre_are_their_own_image():
    even = np.diag([1.0, 2, 3, 4, 5, 6])
    even[0, 4] = even[4, 0] = 0.5  # surge and pitch change side in x alike, neither in y
    assert whole_mirrors("xy", (even,), np.zeros(3)) == "xy"
    assert whole_mirrors("y", (even,), np.zeros(3)) == "y"
    for place, planes in (
        ((0, 2), "y"),
        ((1, 3), "xy"),
        ((1, 5), "y"),
        ((2, 4), "y"),
        ((0, 1), ""),
        ((0, 5), "x"),
        ((3, 5), "y"),
    ):
        odd = even.copy()
        odd[place] = odd[place[::-1]] = 0.3
        assert whole_mirrors("xy", (even, odd), np.zeros(3)) == planes, place
    for center, planes in (((1.0, 0, 0), "y"), ((0, 1.0, 0), "x"), ((0, 0, 9.0), "xy"), ((0.9e-9, 1.1e-9, 0), "x")):
        assert whole_mirrors("xy", (even,), np.array(center)) == planes
    scale = np.sqrt(np.outer(np.diag(even), np.diag(even))).max() + even.max()
    for share, planes in ((0.4e-9, "xy"), (0.6e-9, "y")):  # twice what an odd entry differs by from its image
        odd = even.copy()
        odd[0, 2] = share * scale
        assert whole_mirrors("xy", (odd,), np.zeros(3)) == planes


def test_a_body_is_turned_into_itself_where_both_horizontal_motions_are_alike():
    alike = np.diag([2.0, 2, 3, 5, 5, 6])
    alike[0, 4], alike[1, 3] = 0.7, -0.7
    assert is_turned((alike,), np.array([0, 0, -3.0])) and not is_turned((alike,), np.array([1.0, 0, 0]))
    assert not is_turned((np.diag([2.0, 2, 3, 5, 5.1, 6]),), np.zeros(3))
    assert not is_turned((np.diag([2.0, 2.1, 3, 5, 5, 6]),), np.zeros(3))
    wrong = alike.copy()
    wrong[1, 3] = 0.7
    assert not is_turned((wrong,), np.zeros(3))


def test_beside_a_stored_heading_no_variance_is_left():
    """Of a value known up to the nugget ν, κ − κ (κ + ν)⁻¹ κ = ν κ / (κ + ν) < 2ν: what is known has no error"""
    made = ring(np.arange(0, 360, 30.0) * DEG, THETA, "")
    at = AtHeadings(made, np.array([60 * DEG + 2e-9, 75 * DEG]), np.array([0.1]), HALF, NONE)
    assert at.place.tolist() == [-1, -1]
    beside, between = at.deviation(of_plane_wave(made.headings)[None], 5)[0]
    assert not beside.any() and np.all(between > 0)


def test_one_heading_of_several_that_is_unknown_is_named():
    made = ring(np.array([0.0, 40.0, 90.0, 135, 180, 225, 270, 315]) * DEG, THETA, "")
    with pytest.raises(BetweenError, match="wave direction 60° does not lie between stored"):
        made.inside(np.array([20.0, 60.0]) * DEG)
    with pytest.raises(BetweenError, match="wave direction is nan; allowed: finite, rad"):
        made.inside(np.array([20.0 * DEG, np.nan]))
