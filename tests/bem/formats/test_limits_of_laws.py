"""Each number by which the laws of a set of another program judge, from both sides, on few numbers made by hand."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.formats.judging import laws
from hakobune.bem.formats.values import Values

RHO, G = 1000.0, 10.0


def a_set(omega=(1.0,), headings=(0.0,), depth=np.inf, body=None, others=0, **quantities):
    quantities = {name: np.array(data) for name, data in quantities.items()}
    return Values(np.array(omega), np.radians(headings), depth, RHO, G, quantities, body or {}, others=others)


def spread(*diagonal, n=1):
    return np.stack([np.diag(np.array(diagonal, float))] * n)


def stiffness(heave):
    return {"hydrostatic_stiffness": np.diag([0, 0, heave, 0, 0, 0])}


@pytest.mark.parametrize("heave, diagonal, size", [
    (RHO * G * 9.0, (1.0, 1.0, 1.0, 1.0, 1.0, 1e-6), 3.0),  # √ of the waterplane of 9 m²
    (RHO * G * 9.0, (1.0, 4.0, 1.0, 1.0, 1.0, 100.0), 10.0),  # twice the arm of yaw, 2√(100/4)
    (0.0, (8e3, 4.0, 1.0, 1.0, 1.0, 0.0), 2.0),  # ∛ of the larger added volume of the sides
    (0.0, (4.0, 27e3, 1.0, 1.0, 1.0, 0.0), 3.0),
    (0.0, (0.0, 0.0, 64e3, 1.0, 1.0, 1.0), 4.0),  # of heave alone
    (0.0, (0.0,) * 6, 1.0), (-9e4, (8e3, 4.0, 1.0, 1.0, 1.0, 0.0), 2.0),
])  # fmt: skip
def test_the_size_of_a_body_follows_from_its_waterplane_or_added_mass(heave, diagonal, size):
    assert laws.size_of(a_set(body=stiffness(heave), added_mass=spread(*diagonal))) == pytest.approx(size)


def test_without_a_waterplane_a_median_over_frequencies_tells_the_size():
    """One irregular frequency does not; yaw has the largest of all"""
    A = spread(8e3, 1e3, 0, 0, 0, 0, n=5)
    A[2, 0, 0] = 1e9
    assert laws.size_of(a_set(omega=range(1, 6), added_mass=A)) == pytest.approx(2.0)
    A[3, 5, 5] = 1e3 * 16
    assert laws.size_of(a_set(omega=range(1, 6), added_mass=A)) == pytest.approx(8.0)


@pytest.mark.parametrize("i, j, said", [(0, 4, "A_15 and A_51 differ by 1"), (3, 1, "A_42 and A_24 differ by 1")])
@pytest.mark.parametrize("share, told", [(0.098, False), (0.116, True), (-0.116, True)])
def test_pairs_of_added_mass_differ_by_up_to_a_tenth_of_their_size(i, j, said, share, told):
    """√(AᵢᵢAⱼⱼ): 2 · 30"""
    A = spread(4, 4, 4, 900, 900, 900)
    A[0, i, j] += share * 60
    lines = laws._reciprocity(a_set(added_mass=A))
    assert bool(lines) is told and (
        not told or lines[0].startswith((said, said.replace("A_42 and A_24", "A_24 and A_42")))
    )


def test_a_mode_without_added_mass_is_of_a_hundredth_of_the_largest():
    """√(4 · 0.04) = 0.4 of sway beside surge; √(900 · 9) = 90 of rotations"""
    for i, j, size in ((0, 1, 0.4), (3, 4, 90.0)):
        for share, told in ((0.098, False), (0.102, True)):
            A = spread(4, 0, 4, 900, 0, 900)
            A[0, i, j] = share * size
            assert bool(laws._reciprocity(a_set(added_mass=A))) is told


@pytest.mark.parametrize("size, share, told", [
    (-0.0197, 1.0, False), (-0.0203, 1.0, True), (-0.021, 0.1, False), (-0.021, 0.2, True),
])  # fmt: skip
def test_damping_below_zero_is_noise_up_to_a_fiftieth_of_added_mass_or_at_a_tenth_of_frequencies(size, share, told):
    omega = np.linspace(1.0, 2.0, 10)
    B = np.zeros((10, 6, 6))
    B[: round(10 * share), 1, 1] = size * omega[: round(10 * share)] * 50.0
    line = laws._energy(a_set(omega=omega, added_mass=spread(50, 50, 50, 50, 50, 50, n=10), radiation_damping=B))
    assert (line == ["B_22 is below 0: damping has the opposite sign"]) if told else line == []


def test_two_of_nineteen_frequencies_are_more_than_a_tenth():
    omega = np.linspace(1.0, 2.0, 19)
    for count, told in ((1, False), (2, True)):
        B = np.zeros((19, 6, 6))
        B[:count, 0, 0] = -9.0
        values = a_set(omega=omega, added_mass=spread(*[50] * 6, n=19), radiation_damping=B)
        assert bool(laws._energy(values)) is told


@pytest.mark.parametrize("positive, mode, sign", [(1, 2, True), (2, 2, False), (1, 4, True), (2, 4, False)])
def test_damping_of_the_opposite_sign_is_above_zero_in_no_mode_at_more_than_a_tenth(positive, mode, sign):
    """Else the body gives energy: a sign is that of all frequencies and motions"""
    omega, B = np.linspace(1.0, 2.0, 10), np.zeros((10, 6, 6))
    B[:8, 2, 2], B[10 - positive :, mode, mode] = -5.0, 5.0
    (line,) = laws._energy(a_set(omega=omega, added_mass=spread(*[50] * 6, n=10), radiation_damping=B))
    if sign:
        assert line == "B_33 is below 0: damping has the opposite sign"
    else:
        assert line.startswith("B_33 is below 0 by more than 2 % of ωA at 80 % of the frequencies: the body gives")


def test_causality_needs_a_peak_of_damping_that_its_frequencies_resolve():
    """Of B = 2ω²/(1 + ω²)² up to 60 rad/s twenty frequencies have one or two on the peak, and 1 200 have dozens"""
    for n, tested in ((20, False), (1200, True)):
        omega = np.linspace(0.05, 60.0, n)
        A, B = np.zeros((n, 6, 6)), np.zeros((n, 6, 6))
        A[:, range(6), range(6)] = 0.5
        for i in (0, 1):
            B[:, i, i] = 4 * omega**2 / (1 + omega**2) ** 2
            A[:, i, i] = 2.0 - (omega**2 - 1) / (1 + omega**2) ** 2
        values = a_set(omega=omega, added_mass=A, radiation_damping=B)
        assert (laws._causality(values) is not None) is tested


SYMMETRIC = spread(4, 4, 4, 4, 4, 4)


def circle(headings, A=SYMMETRIC):
    return laws._circle(a_set(headings=headings, added_mass=A))


def test_headings_all_round_have_half_of_the_gaps_beside_them():
    """In whichever order: 0°, 40°, …, 320° with one more at 20°"""
    order = [-40, 0, 20, 40, 80, 120, 160, 200, -120, 280]
    weights, step = circle(order)
    assert np.degrees(weights) == pytest.approx([40, 30, 20, 30, 40, 40, 40, 40, 40, 40]) and np.degrees(
        step
    ) == pytest.approx(40)


@pytest.mark.parametrize("turn, copies", [(180, 2), (90, 4)])
def test_headings_of_a_part_of_the_circle_stand_for_their_mirror_images(turn, copies):
    """The trapezoidal rule on a half or a quarter, twice or four times; what lies beyond it counts nothing"""
    part = np.linspace(0, turn, 5)
    weights, step = circle([*part[::-1], turn + 70])
    assert np.degrees(weights) == pytest.approx(copies * turn / 8 * np.array([1, 2, 2, 2, 1, 0])) and np.degrees(
        step
    ) == pytest.approx(turn / 4)


@pytest.mark.parametrize("headings, covered", [
    (np.arange(0, 360, 51.0), True), (np.arange(0, 360, 60.0), False),  # steps up to 0.9 rad, 51.6°
    ([0, 30, 60, 90], True), ([0, 45, 90], False), ([0.0565, 30, 60, 90], True), ([0.0585, 30, 60, 90], False),
    ([0, 30, 60, 89.9435], True), ([0, 30, 60, 89.9415], False), ([0, 15, 35, 90], False),
])  # fmt: skip
def test_headings_cover_a_circle_in_steps_or_a_quarter_with_both_ends(headings, covered):
    assert (circle(headings) is not None) is covered


@pytest.mark.parametrize("i, j, quarter, half", [
    (0, 2, False, True), (2, 4, False, True), (1, 5, False, True),  # not alike fore and aft
    (0, 1, False, False), (0, 3, False, False), (2, 1, False, False), (4, 3, False, False),  # nor port and starboard
    (0, 4, True, True), (1, 3, True, True), (3, 5, True, True),
])  # fmt: skip
def test_pairs_of_added_mass_tell_how_symmetric_a_body_is(i, j, quarter, half):
    """A pair that symmetry makes vanish is below 3 % of the size of both"""
    for share in (0.029, 0.031):
        A = SYMMETRIC.copy()
        A[0, i, j] = share * 4
        large = share > 0.03
        assert (circle([0, 30, 60, 90], A) is not None) is (quarter or not large)
        assert (circle([0, 45, 90, 135, 180], A) is not None) is (half or not large)


@pytest.mark.parametrize("i, j", [(0, 1), (0, 2), (2, 4)])
def test_a_mode_that_is_not_there_tells_nothing_of_symmetry(i, j):
    for missing in (i, j):
        A = SYMMETRIC.copy()
        A[0, missing, missing], A[0, i, j] = 0.0, 1.0
        assert circle([0, 30, 60, 90], A) is not None


def test_pairs_are_held_against_the_largest_of_all_frequencies_whatever_their_sign():
    A = np.stack([0.1 * SYMMETRIC[0], SYMMETRIC[0]])
    for share, symmetric in ((-0.029, True), (-0.031, False)):
        A[0, 0, 2] = share * 4
        assert (laws._circle(a_set((1.0, 2.0), [0, 30, 60, 90], added_mass=A)) is not None) is symmetric


def test_a_heading_within_a_millionth_of_the_end_of_a_quarter_is_at_it():
    weights, _ = circle([0, 30, 60, 90 + np.degrees(5e-7)])
    assert np.degrees(weights) == pytest.approx([60, 120, 120, 60], rel=1e-5)


@pytest.mark.parametrize("ratios, agrees", [
    ([1.24] * 8, True), ([1.26] * 8, False), ([1 / 1.24] * 8, True), ([1 / 1.26] * 8, False),
    ([1.0] * 6 + [1.49] * 4, True), ([1.0] * 6 + [1.51] * 4, False), ([1.0] * 9 + [9.0], True),
])  # fmt: skip
def test_a_law_holds_within_a_quarter_and_within_half_for_four_of_five(ratios, agrees):
    assert bool(laws._agrees(np.array(ratios), np.linspace(1, 2, len(ratios)))) is agrees


def test_a_ratio_near_one_that_goes_with_the_frequency_does_not_agree():
    """ω^0.84 and ω^0.86 within 0.9 to 1.1"""
    omega = np.linspace(0.9, 1.1, 9)
    for power, agrees in ((0.84, True), (0.86, False), (-0.84, True), (-0.86, False)):
        assert bool(laws._agrees(omega**power, omega)) is agrees


def test_a_power_of_the_frequency_is_told_by_five_ratios_without_scatter():
    omega = np.geomspace(0.5, 2.0, 9)
    noise = np.resize([1.0, -1.0], 9)
    assert laws._slope(omega, 7 * omega**1.5) == pytest.approx(1.5)
    assert laws._slope(omega[:5], omega[:5] ** 2) == pytest.approx(2.0) and laws._slope(omega[:4], omega[:4] ** 2) == 0
    assert laws._slope(omega, -omega) == 0
    assert laws._slope(omega, omega * np.exp(0.045 * noise)) == pytest.approx(1.0, abs=0.02)
    assert laws._slope(omega, omega * np.exp(0.055 * noise)) == 0


WHYS = {0.25: "for 1 m of wave height", 1e-6: "damping is in MN and forces are in N", 1e-3: "damping is in kN and "
    "forces are in N",
        1e3: "damping is in N and forces are in kN", 1e6: "forces are in kN", 9.80665: "the factor g",
        1 / 9.80665: "the factor g", 1 / 1025: "the factor ρ", 1025.0: "the factor ρ"}  # fmt: skip


@pytest.mark.parametrize("factor", [f for f in WHYS if not 900 < f < 1100 and not 900 < 1 / f < 1100])
def test_a_factor_of_damping_is_named_within_a_quarter_of_its_logarithm(factor):
    """e^0.25 = 1.284"""
    for share, named in ((1.28, True), (1 / 1.28, True), (1.29, False), (1 / 1.29, False)):
        line = laws._why(factor * share, 0.0, np.full(9, factor * share))
        assert (WHYS[factor] in line) is named


@pytest.mark.parametrize("factor", [1e3, 1e-3])
def test_a_thousand_is_kilo_before_it_is_the_density(factor):
    for share in (1.2, 1 / 1.28):
        assert WHYS[factor] in laws._why(factor * share, 0.0, np.full(9, factor))
    beyond = 1025.0 * 1.29 if factor > 1 else 1 / 1025.0 / 1.29
    assert "damping and forces differ in their units" in laws._why(beyond, 0.0, np.full(9, beyond))
    other = 1025.0 if factor > 1 else 1 / 1025.0
    share = 1.283 if factor > 1 else 1 / 1.283  # beyond 1000 e^0.25, within 1025 e^0.25
    assert "the factor ρ" in laws._why(other * share, 0.0, np.full(9, other))


@pytest.mark.parametrize("slope, words", [
    (0.71, "the ratio is proportional to ω: damping is multiplied by ω"), (1.29, "the ratio is proportional to "
        "ω"), (-0.71, "the ratio is proportional to 1/ω"),
    (-1.29, "the ratio is proportional to 1/ω: damping is divided by ω"), (0.69, "damping and forces "
        "differ"), (1.31, "damping and forces differ"),
    (-0.69, "damping and forces differ"), (-1.31, "damping and forces differ"),
])  # fmt: skip
def test_damping_over_or_times_the_frequency_is_told_by_the_power(slope, words):
    assert laws._why(5.0, slope, np.full(9, 5.0)).startswith(words)


def test_a_ratio_that_scatters_by_half_of_it_is_of_no_unit():
    """Between its 10 % and 90 % quantiles, here 9 numbers evenly from end to end: 0.8 of their range"""
    for width, told in ((0.63, True), (0.62, False)):
        ratios = 5.0 * (1 + width * np.linspace(-0.5, 0.5, 9))
        assert ("scatters" in laws._why(5.0, 0.0, ratios)) is told


LONG_WAVES = np.sqrt(G * np.array([0.005, 0.019, 0.021, 0.1, 0.2, 0.34, 0.36, 0.7]))  # k of deep water, a body of 1 m


def few_headings(headings=(0.0,), heave=1e4, surge=1e4, omega=LONG_WAVES, size=1.0, damping=1.0, C=None):
    """Damping of heave and surge as B = k/(8πρgC_g) ∫|X|² of these forces, C_g = ω/2k in deep water"""
    n, m = len(omega), len(headings)
    X = np.zeros((n, m, 6), complex)
    X[:, :, 2], X[:, :, 0] = heave, 1j * surge * np.cos(np.radians(headings))
    k = omega**2 / G
    B = np.zeros((n, 6, 6))
    rate = damping * k / (8 * np.pi * RHO * G * omega / (2 * k))
    B[:, 2, 2], B[:, 0, 0] = rate * 2 * np.pi * abs(heave) ** 2, rate * np.pi * abs(surge) ** 2
    body = stiffness(RHO * G * size**2) if C is None else stiffness(C)
    return a_set(omega=omega, headings=headings, body=body, added_mass=spread(1, 1, 1, 1, 1, 0, n=n),
                 radiation_damping=B, excitation_force=X)  # fmt: skip


def test_a_few_headings_tell_of_heave_and_surge_in_long_waves():
    """Of k L from 0.02 to 0.35, damping above 0.3 % of the largest: |X₃|² 2π and |X₁|² π"""
    found = laws.haskind_ratios(few_headings())
    assert set(found) == {0, 2}
    for ratio, omega in found.values():
        assert ratio == pytest.approx(np.ones(len(ratio))) and omega == pytest.approx(LONG_WAVES[2:6])
    twice = laws.haskind_ratios(few_headings(size=2.0, heave=2e4))
    assert twice[2][1] == pytest.approx(LONG_WAVES[1:4])  # 0.038, 0.042 and 0.2, of a body of twice the size


def test_surge_is_of_the_heading_most_ahead_or_astern():
    for headings in ((30.0, 60.0), (100.0, 150.0), (90.0, 44.0)):
        assert laws.haskind_ratios(few_headings(headings))[0][0] == pytest.approx(np.ones(4))
    assert set(laws.haskind_ratios(few_headings((46.0, 90.0)))) == {2}  # |cos| below 0.7


def test_damping_below_three_thousandths_of_the_largest_is_rounding():
    for share, count in ((2.9e-3, 3), (3.1e-3, 4)):
        values = few_headings()
        B = values.quantities["radiation_damping"]
        B[:, 2, 2] = np.where(np.arange(8) == 2, share, 1.0)
        assert len(laws.haskind_ratios(values)[2][1]) == count


def test_a_force_below_three_hundredths_of_the_largest_tells_nothing():
    for share, told in ((0.029, False), (0.031, True)):
        assert (0 in laws.haskind_ratios(few_headings(surge=share * 1e4, C=0.0))) is told


def test_heave_forces_that_nearly_cancel_tell_nothing():
    for share, told in ((0.29, False), (0.31, True)):
        assert (2 in laws.haskind_ratios(few_headings(heave=share * 1e4, surge=1e3))) is told


def test_a_law_of_few_headings_takes_two_frequencies():
    assert laws.haskind_ratios(few_headings(omega=LONG_WAVES[2:4])) is not None
    assert laws.haskind_ratios(few_headings(omega=LONG_WAVES[2:3])) is None
    empty = few_headings()
    empty.quantities["excitation_force"] = empty.quantities["excitation_force"][:, :0]
    assert laws.haskind_ratios(empty) is None
    none = few_headings()
    assert laws.depth_of(few_headings(omega=LONG_WAVES[2:3])) is None
    del none.quantities["excitation_force"]
    assert laws.haskind_ratios(none) is None


def test_moments_that_are_small_differences_tell_nothing():
    """Below a tenth of force times length, and below 3 % of the largest moment"""
    headings = np.arange(0, 360, 30.0)
    omega = np.sqrt(G * np.array([0.1, 0.2, 0.3]))
    for arm, yaw, told in ((0.09, 0.0, set()), (0.11, 0.0, {4}), (4.0, 0.119, {4}), (4.0, 0.121, {4, 5})):
        X = np.zeros((3, 12, 6), complex)
        X[..., 2], X[..., 4], X[..., 5] = 1.0, arm, yaw
        B = spread(*[1] * 6, n=3)
        values = a_set(omega=omega, headings=headings, body={}, added_mass=spread(1e3, 1, 1, 1, 1, 0, n=3),
                       radiation_damping=B, excitation_force=X)  # fmt: skip
        assert {i for i in laws.haskind_ratios(values) if i > 2} == told


def test_headings_all_round_resolve_waves_up_to_their_steps():
    """kL < 0.4 π/Δβ; here 30°: 2.4"""
    omega = np.sqrt(G * np.array([0.019, 0.021, 1.0, 2.39, 2.41]))
    X = np.ones((5, 12, 6), complex)
    values = a_set(omega=omega, headings=np.arange(0, 360, 30.0), added_mass=spread(1e3, 1, 1, 1, 1, 0, n=5),
                   radiation_damping=spread(*[1] * 6, n=5), excitation_force=X)  # fmt: skip
    assert laws.haskind_ratios(values)[1][1] == pytest.approx(omega[1:4])


@pytest.mark.parametrize("heave, surge, width", [(1.0, 2.0, 5.0), (1.0, 2.6, None), (1.0, 2.2, 4.8)])
def test_a_channel_is_told_by_widths_within_a_quarter(heave, surge, width):
    """w = 1/(k ratio) of heave, 2/(k ratio) of surge: 5 m, and 5, 3.85 or 4.55 m"""
    omega = np.sqrt(G * np.linspace(0.1, 0.3, 5))
    k = omega**2 / G
    found = {2: (1 / (5 * k) * heave, omega), 0: (surge / (5 * k), omega)}
    found[0] = (2 * 2 / surge / (5 * k), omega)
    said = laws._of_channel(a_set(omega=omega), found)
    assert bool(said) is (width is not None)
    if said:
        middle = np.median([5.0] * 5 + [5.0 * surge / 2] * 5)
        assert f"damping in a channel {middle:.3g} m wide, not in open water" in said


def test_five_ratios_tell_a_channel():
    omega = np.sqrt(G * np.linspace(0.1, 0.3, 5))
    ratio = 1 / (5 * omega**2 / G)
    assert laws._of_channel(a_set(), {2: (ratio, omega)}) != "" and laws._of_channel(a_set(), {1: (ratio, omega)}) == ""
    assert laws._of_channel(a_set(), {2: (ratio[:4], omega[:4])}) == ""
    assert laws._of_channel(a_set(), {2: (ratio, omega), 0: (9 * ratio[:4], omega[:4])}) != ""
    assert laws._of_channel(a_set(), {2: (np.where(omega > 1.5, 1.5, 1.0) * ratio, omega)}) == ""


def long_wave(ratio=1.0, surge=-1j, k=0.1, headings=(0.0,), C=RHO * G, volume=1.0, A33=500.0, B33=0.0, **more):
    """X₃ in units of C₃₃ − ω²(A₃₃ + ρV); a body of 1 m and a wave of k m⁻¹"""
    omega = np.sqrt(G * k)
    X = np.zeros((1, len(headings), 6), complex)
    X[0, :, 2] = ratio * (C - G * k * (A33 + RHO * volume))
    X[0, :, 0] = surge * np.cos(np.radians(headings)) * 100.0
    body = stiffness(C) | ({"displaced_volume": volume} if volume else {})
    return a_set(omega=[omega], headings=headings, body=body | more.pop("body", {}),
                 added_mass=spread(1, 1, A33, 1, 1, 0), radiation_damping=spread(0, 0, B33, 0, 0, 0),
                 excitation_force=X, **more)  # fmt: skip


@pytest.mark.parametrize("ratio, words", [
    (1.0, ""), (1.24, ""), (1.26, "is 1.26 times the value from C₃₃"), (1 / 1.24, ""), (1 / 1.26, "is 0.794 times"),
    (np.exp(0.59j), ""), (np.exp(0.61j), "has a phase of 35°; it must have 0°, in phase with the crest"),
    (np.exp(-0.61j),
        "has a phase of -35°"),
    (-1.0, "has a phase of 180°"), (2.0, "forces are for 1 m of wave height"),
])  # fmt: skip
def test_heave_of_the_longest_wave_follows_the_crest_and_its_stiffness(ratio, words):
    lines = laws._long_waves(long_wave(ratio))
    assert (words in lines[0]) if words else lines == []


def test_what_is_not_there_of_a_volume_widens_the_band_of_heave():
    """Mass over density stands for it; without both 1.5 for 1.25"""
    assert laws._long_waves(long_wave(1.3, body={"displaced_volume": None, "mass": RHO})) != []
    heavy = long_wave(1.0, volume=0.0, A33=500.0, body={"mass": 1.0 * RHO})
    expected = RHO * G - G * 0.1 * (500 + RHO)
    heavy.quantities["excitation_force"][0, :, 2] = 1.2 * expected
    assert laws._long_waves(heavy) == []
    for ratio, told in ((1.49, False), (1.51, True)):
        assert bool(laws._long_waves(long_wave(ratio, volume=0.0))) is told


def test_the_added_mass_of_the_longest_wave_counts_whichever_row_it_is():
    """C₃₃ − ω²(A₃₃ + ρV) of that wave: heave forces of the others say nothing"""
    for rows in ([0, 1, 2], [2, 0, 1], [1, 2, 0]):
        one = long_wave(1.0, A33=500.0)
        omega, A = np.sqrt(G * np.array([0.1, 0.5, 0.9])), spread(1, 1, 500, 1, 1, 0, n=3)
        A[1:, 2, 2] = 9e6
        X = np.repeat(one.quantities["excitation_force"], 3, axis=0)
        X[1:] *= 7
        quantities = {"added_mass": A[rows], "radiation_damping": np.zeros((3, 6, 6)), "excitation_force": X[rows]}
        assert laws._long_waves(replace(one, omega=omega[rows], quantities=quantities)) == []
        quantities["excitation_force"] = 1.3 * quantities["excitation_force"]
        (line,) = laws._long_waves(replace(one, omega=omega[rows], quantities=quantities))
        assert "heave force of the longest wave is 1.3 times the value from C₃₃" in line


def test_waves_that_are_not_long_tell_nothing():
    assert laws._long_waves(long_wave(3.0, k=0.34)) != [] and laws._long_waves(long_wave(3.0, k=0.36)) is None
    assert laws._long_waves(long_wave(3.0, others=1)) is None


def test_a_stiffness_that_inertia_all_but_takes_away_tells_nothing():
    """Below 0.3 C₃₃: ω² (A + ρV) of 0.69 and 0.71"""
    for share, told in ((0.69, True), (0.71, False)):
        A33 = share * RHO * G / (G * 0.1) - RHO
        assert bool(laws._long_waves(long_wave(3.0, A33=A33))) is told


@pytest.mark.parametrize("angle, words", [
    (0.0, ""), (0.99, ""), (-0.99, ""), (1.01, "phases are not relative to the origin"), (-1.01, "phases are not "
        "relative to the origin"),
    (np.pi - 1.01, "phases are not relative to the origin"), (np.pi - 0.99, "has the opposite sign"), (np.pi, "has "
        "the opposite"),
])  # fmt: skip
def test_surge_of_long_waves_is_a_quarter_period_behind_the_crest(angle, words):
    """−i cosβ, within a radian either way"""
    for heading in (0.0, 180.0, 120.5):
        lines = laws._long_waves(long_wave(surge=-1j * np.exp(1j * angle), headings=(heading,)))
        assert (words in lines[0]) if words else lines == []
        if "origin" in words:
            at = np.degrees(np.angle(-1j * np.exp(1j * angle) * np.cos(np.radians(heading))))
            assert f"towards {heading:g}° has a phase of {at:.0f}°" in lines[0]


def test_surge_across_the_waves_or_too_small_has_no_sign():
    turned = {"surge": 1j}
    assert laws._long_waves(long_wave(headings=(59.0,), **turned)) != []
    assert laws._long_waves(long_wave(headings=(61.0,), **turned)) == []
    heave = RHO * G - 1.0 * 1500.0
    for share, told in ((1.1e-6, True), (0.9e-6, False)):
        assert bool(laws._long_waves(long_wave(surge=1j * share * heave / 100))) is told


def test_conjugates_turn_the_small_part_of_heave_too():
    """−iωB₃₃ in exp(−iωt): of the opposite sign with surge it is of exp(+iωt)"""
    for sign, words in (
        (1, "phases are conjugates, for exp(+iωt)"),
        (-1, "headings are the directions that waves come from"),
    ):
        values = long_wave(1 + sign * 0.05j, surge=1j, B33=1.0)
        assert words in laws._long_waves(values)[0]


def test_of_a_body_that_hangs_under_water_surge_alone_tells():
    """C₃₃ at or below 1 % of ρ g L² is none; X₃ = −ω² m is at 180°"""
    for C, floats in ((0.0102 * RHO * G, True), (0.0098 * RHO * G, False)):
        values = long_wave(1.0, C=C, body={"hydrostatic_stiffness": np.diag([0, 0, C, 0, 0, 0])})
        values.quantities["added_mass"][0, 5, 5] = 0.25  # a body of 1 m by its yaw
        assert bool(laws._long_waves(values)) is floats


def falling(b, n=40, w=(0.1, 8.0), fall=None, end=0.0, infinity=1.0):
    """Damping b(ω) of surge with limits of added mass `fall` apart; a body of 1 m"""
    omega = np.linspace(*w, n)
    A, B = spread(*[1.0] * 5, 0.25, n=n), np.zeros((n, 6, 6))
    A[:, 1, 1] = 1.0
    B[:, 0, 0] = b(omega)
    fall = laws._integral(omega, B[:, 0, 0]) if fall is None else fall
    limits = {"added_mass_zero": np.diag([infinity + fall] * 6), "added_mass_infinity": np.diag([infinity] * 6)}
    return a_set(omega=omega, added_mass=A, radiation_damping=B, **limits)


def bell(omega):
    return omega**3 * np.exp(-2 * omega)


def test_the_fall_of_added_mass_is_the_integral_of_damping_over_the_square_of_the_frequency():
    """(2/π) ∫ c s ds of b = c s³ is c/π w², below the first frequency too; trapezoids are exact for straight lines"""
    w = np.array([0.5, 1.0, 3.0])
    assert laws._integral(w, 7 * w**3) == pytest.approx(7 / np.pi * 9)
    assert laws._integral(w, np.array([1.0, 0.0, 0.0])) == pytest.approx(2 / np.pi * (0.5 * 0.5 * 4 + 1.0))


@pytest.mark.parametrize(
    "share, told", [(1.0, False), (1 / 1.39, False), (1 / 1.41, True), (1 / 0.61, False), (1 / 0.59, True)]
)
def test_damping_makes_the_fall_of_added_mass_within_four_tenths(share, told):
    fall = laws._integral(*(lambda w: (w, bell(w)))(np.linspace(0.1, 8.0, 40)))
    lines = laws._causality(falling(bell, fall=share * fall, infinity=0.01))
    assert bool(lines) is told and lines is not None
    if told:
        assert (
            f"A_11 falls by {share * fall:.4g} from long to short waves; the fall that follows from damping is "
            f"{1 / share:.3g} times" in lines[0]
        )


def test_causality_takes_twenty_frequencies_up_to_short_waves_and_damping_that_vanishes():
    """kL of 6: ω = √60 in deep water; a tenth of the largest damping at the end"""
    assert laws._causality(falling(bell, n=20)) == [] and laws._causality(falling(bell, n=19)) is None
    assert laws._causality(falling(bell, w=(0.1, 7.8))) == [] and laws._causality(falling(bell, w=(0.1, 7.7))) is None
    for end, tested in ((0.09, True), (0.11, False)):
        with_end = falling(lambda w, e=end: np.where(w == w[-1], e * bell(w).max(), bell(w)))
        assert (laws._causality(with_end) is not None) is tested
    assert laws._causality(falling(lambda w: 0 * w, fall=1.0)) is None


def test_sway_is_tested_beside_surge():
    values = falling(bell, infinity=0.01)
    for i in (0, 1):
        values.quantities["radiation_damping"][:, 1, 1] = (1 + i) * values.quantities["radiation_damping"][:, 0, 0]
        lines = laws._causality(values)
        assert (lines[0][:13] == "A_22 falls by") if i else lines == []


def followed(size=1.0, level=0.0, **more):
    """Damping and added mass of surge of a memory (1 − ct) exp(−ct), without limits; damping `size` times"""
    w, c = np.linspace(0.05, 60.0, 1200), 1.0
    A, B = spread(*[1.0] * 5, 0.25, n=1200), np.zeros((1200, 6, 6))
    B[:, 0, 0] = size * 2 * c * w**2 / (c**2 + w**2) ** 2
    A[:, 0, 0] = level - (w**2 - c**2) / (c**2 + w**2) ** 2
    return a_set(omega=w, added_mass=A, radiation_damping=B, **more)


def test_added_mass_follows_damping_within_a_factor_of_two():
    for size, told in ((0.52, False), (0.48, True), (1.9, False), (2.1, True)):
        assert bool(laws._causality(followed(size))) is told
        beside = laws._causality(followed(size, others=1))
        assert beside == [] if not told else beside is None  # peaks between bodies say nothing


def test_added_mass_that_changes_by_less_than_three_tenths_tells_nothing():
    """Of its largest; it falls by 1.12 from c to the end"""
    fall = np.ptp(followed().quantities["added_mass"][:, 0, 0])
    lowest = followed().quantities["added_mass"][:, 0, 0].max()
    for share, tested in ((0.31, True), (0.29, False)):
        assert (laws._causality(followed(level=fall / share - lowest)) is not None) is tested


def test_limits_closer_than_a_tenth_tell_nothing():
    for share, tested in ((0.09, False), (0.11, True)):
        values = falling(bell, fall=share)
        assert (laws._causality(values) is not None) is tested


def test_added_mass_with_a_peak_of_a_tenth_of_its_range_is_not_resolved():
    a = np.where(np.arange(30) < 20, 0.0, 1.0)
    for size, even in ((0.099, True), (0.101, False)):
        assert bool(laws._even(a + size * (np.arange(30) == 10))) is even
        assert bool(laws._even(a - size * (np.arange(30) == 27))) is even
    assert laws._even(a + 0.5 * (np.arange(30) == 1))  # the two at each end have no five neighbours


def test_added_mass_follows_its_damping_by_the_principal_value():
    """B = 2cω²/(c² + ω²)², A = −(ω² − c²)/(c² + ω²)²; halved and doubled it is half and twice"""
    w, c = np.linspace(0.02, 80.0, 4000), 1.0
    b, a = 2 * c * w**2 / (c**2 + w**2) ** 2, -(w**2 - c**2) / (c**2 + w**2) ** 2
    assert laws._follows(w, a, b) == pytest.approx(1.0, abs=0.02)
    assert laws._follows(w, 2 * a, b) == pytest.approx(0.5, abs=0.01)
    short = np.linspace(0.2, 4.0, 30)
    b, a = 2 * c * short**2 / (c**2 + short**2) ** 2, -(short**2 - c**2) / (c**2 + short**2) ** 2
    inner = slice(4, -4)
    parts = []
    for at, slope in zip(short[inner], np.gradient(b, short)[inner], strict=True):  # the same, term by term
        rows = [
            (bs - np.interp(at, short, b)) / (s * s - at * at) if s != at else slope / (2 * s)
            for s, bs in zip(short, b, strict=True)
        ]
        rest = np.log((4.0 - at) * (at + 0.2) / ((4.0 + at) * (at - 0.2))) / (2 * at)
        parts.append(2 / np.pi * (np.trapezoid(rows, short) + np.interp(at, short, b) * rest))
    slope = np.polyfit(a[inner], parts, 1)[0]
    assert laws._follows(short, a, b) == pytest.approx(slope)


def test_pairs_that_differ_are_told_with_the_share_of_their_size():
    A = spread(4, 4, 4, 900, 900, 900)
    A[0, 0, 4], A[0, 4, 0] = 20.0, -4.0  # 24 of √(4 · 900)
    (line,) = laws._reciprocity(a_set(added_mass=A))
    assert line == (
        "A_15 and A_51 differ by 40 % of their size; either rotations and translations have different units or points, "
        "or there are too few panels"
    )


def test_a_set_without_a_frequency_at_which_all_is_finite_cannot_be_judged():
    A, B = spread(*[1.0] * 6, n=2), spread(*[1.0] * 6, n=2)
    A[0, 0, 0] = B[1, 3, 3] = np.nan
    assert laws.doubts(a_set(omega=(1.0, 2.0), added_mass=A, radiation_damping=B)) == ([], [])


def test_beside_other_bodies_surge_and_heave_both_have_to_tell_the_channel():
    """With five ratios each; sway beside them changes nothing"""
    omega = np.sqrt(G * np.linspace(0.1, 0.3, 5))
    heave, surge = (1 / (5 * omega**2 / G), omega), (2 / (5 * omega**2 / G), omega)
    for found, told in (({2: heave}, False), ({0: surge}, False), ({0: surge, 2: heave}, True),
                        ({0: surge, 1: surge, 2: heave}, True), ({0: surge, 1: surge}, False),
                        ({0: surge, 2: (heave[0][:4], omega[:4])}, False)):  # fmt: skip
        said = laws._of_channel(a_set(omega=omega, others=1), found)
        assert said == ("this is the damping in a channel 5 m wide, not in open water" if told else "")


def round_set(omega=1.0, headings=range(0, 360, 30), wrong=1.0):
    """A body of revolution of 1 m² in deep water: X₁ = 50 cos β, X₃ = 80 N/m.  k = ω²/g, C_g = g/2ω, so that
    B = ω³/(4πρg³) ∮|X|²dβ, of which ∮cos² = π and ∮1 = 2π"""
    beta = np.radians(headings)
    X = np.zeros((1, len(beta), 6), complex)
    X[0, :, 0], X[0, :, 2] = 50j * np.cos(beta), 80.0
    B = omega**3 / (4 * np.pi * RHO * G**3) * np.array([np.pi * 50**2, 0, wrong * 2 * np.pi * 80**2, 0, 0, 0])
    A = spread(1e-3, 1e-3, 1e-6, 1.0, 1.0, 1e-9)
    return a_set(
        (omega,),
        headings,
        np.inf,
        stiffness(RHO * G),
        added_mass=A,
        radiation_damping=np.diag(B)[None],
        excitation_force=X,
    )


def test_damping_is_that_of_the_waves_that_the_forces_tell():
    """Heave has no added mass to speak of, so that its defect is that of damping alone; 1.1 B is off by 0.1/1.1"""
    assert laws.energy_defects(round_set()) == pytest.approx([0.0], abs=1e-9)
    assert laws.energy_defects(round_set(wrong=1.1)) == pytest.approx([0.1 / 1.1], rel=1e-6)


@pytest.mark.parametrize("headings", [[0.0, 90.0], [10.0, 100.0, 200.0, 300.0]])
def test_headings_that_do_not_go_round_tell_no_energy(headings):
    assert np.isnan(laws.energy_defects(round_set(headings=headings))).all()


def test_waves_too_short_for_their_headings_tell_no_energy():
    """A body 1 m long: kL = ω²/g below 0.4 π / step = 2.4, so up to ω = 4.9 rad/s"""
    assert (
        np.isfinite(laws.energy_defects(round_set(4.8))).all() and np.isnan(laws.energy_defects(round_set(5.0))).all()
    )
