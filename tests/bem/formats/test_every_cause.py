"""Every change of sign, heading, axes and factor that an import names, made by its meaning and taken back.

Signs of axes follow from R = diag(±1, ±1, ±1): translations turn with R, rotations with R det R.
"""

from dataclasses import replace

import numpy as np
import pytest
from test_causes import BETA, OMEGA, Hull, by, right

from hakobune.bem.formats.judging import causes
from hakobune.bem.formats.judging.causes import FORCES, MATRICES, changed, corrected, finding

PHASES = {
    "": lambda X: X, "phases are the conjugates of ours": np.conj, "forces have the opposite sign": lambda X: -X,
    "phases are 90° behind ours": lambda X: X / 1j, "phases are 90° ahead of ours": lambda X: X * 1j,
    "phases are conjugates with the opposite sign": lambda X: -np.conj(X),
}  # fmt: skip
HEADINGS = {"": lambda b: b, "headings are the directions that waves come from": lambda b: b + np.pi,
            "headings are counted clockwise": lambda b: -b,
            "headings are compass directions (clockwise) that waves come from": lambda b: np.pi - b}  # fmt: skip
AXES = {
    "axes have z down and y to starboard": ((1, -1, -1), lambda b: -b),
    "axes have x aft and y to starboard": ((-1, -1, 1), lambda b: b + np.pi),
    "axes have y to starboard with z up": ((1, -1, 1), lambda b: -b),
    "axes have x aft with y to port": ((-1, 1, 1), lambda b: np.pi - b),
    "z is down": ((1, 1, -1), lambda b: b),
}
ALONE = {"rotations have the opposite sign": (3, 4, 5), "pitch has the opposite sign": (4,),
         "roll has the opposite sign": (3,), "heave has the opposite sign": (2,),
         "surge has the opposite sign": (0,)}  # fmt: skip


def taken_back(wrong, words):
    found = finding(wrong, Hull())
    assert found.cause is not None and found.cause.text.startswith(words), found
    again = corrected(wrong, found.cause)
    for name, data in right().quantities.items():
        assert again.quantities[name] == pytest.approx(data, rel=1e-6, abs=1e-6 * np.abs(data).max())
    assert np.exp(1j * again.wave_direction) == pytest.approx(np.exp(1j * BETA)) and again.omega == pytest.approx(OMEGA)
    return found


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("heading", HEADINGS)
def test_each_phase_with_each_sense_of_headings(phase, heading):
    if (not phase and not heading) or (phase, heading) == ("forces have the opposite sign", ""):
        return  # as it is, and told as a factor of −1
    wrong = changed(right(), FORCES, PHASES[phase])
    wrong = replace(wrong, wave_direction=HEADINGS[heading](wrong.wave_direction))
    found = taken_back(wrong, phase or heading)
    assert heading in found.cause.text and found.quantity == "excitation_force" and found.cause.way_out == ""


@pytest.mark.parametrize("words", AXES)
def test_axes_that_point_elsewhere(words):
    R, headings = np.array(AXES[words][0]), AXES[words][1]
    signs = np.concatenate([R, R * np.prod(R)]).astype(float)
    if words == "z is down":
        signs = np.array([1.0, 1, -1, -1, -1, 1])  # of one who turns z alone
    wrong = changed(
        right(), FORCES + MATRICES, lambda d: d * signs if np.iscomplexobj(d) else d * np.outer(signs, signs)
    )
    taken_back(replace(wrong, wave_direction=headings(wrong.wave_direction)), words)


@pytest.mark.parametrize("words", ALONE)
@pytest.mark.parametrize("names, end", [(FORCES + MATRICES, ""), (FORCES, ", in forces alone")])
def test_motions_of_the_opposite_sign(words, names, end):
    signs = np.where(np.isin(np.arange(6), ALONE[words]), -1.0, 1.0)
    wrong = changed(right(), names, lambda d: d * signs if np.iscomplexobj(d) else d * np.outer(signs, signs))
    assert taken_back(wrong, words).cause.text == words + end


NAMED = {1e3: "kilo instead of the unit", 1e-3: "the unit instead of kilo", 2.0: "per metre of wave height",
         0.5: "halved", 9.80665: "the factor g", 1 / 9.80665: "without the factor g", 9806.65: "tonnes-force",
         1025.0: "the factor ρ", 1 / 1025.0: "without the factor ρ", 1e6: "mega", 1e-6: "mega as the unit",
         4.4482: "pounds-force", 1 / 4.4482: "pounds-force as N",
         4448.22: "kilopounds-force",
         1 / 4448.22: "kips as N", 1 / 9806.65: "tonnes-force as N", 14.5939: "slugs",
         0.453592: "pounds", 1 / 0.453592: "pounds", 1 / 14.5939: "slugs", 0.3048: "feet", 1 / 0.3048: "feet",
         1025 * 9.80665: "the factor ρ g", 1 / (1025 * 9.80665): "without the factor ρ g", np.pi / 180: "per degree",
         180 / np.pi: "radians as degrees"}  # fmt: skip


@pytest.mark.parametrize("factor", NAMED)
def test_every_known_factor_has_its_word(factor):
    """1025 and 1000, and 1025 g and 9806.65, are within 3 % of each other: the nearer one is told"""
    found = taken_back(by(FORCES, factor)(right()), f"forces are {factor:.4g} times as large: {NAMED[factor]}")
    assert found.gap == pytest.approx(abs(factor - 1), rel=0.7)


@pytest.mark.parametrize("names, words", [
    (("added_mass",), "added mass are"), (("radiation_damping",), "damping are"),
    (MATRICES, "added mass and damping are"), (FORCES + MATRICES, "added mass, damping and forces are"),
    (FORCES, "forces are"),
])  # fmt: skip
@pytest.mark.parametrize("factor", [7.0, -1.0])
def test_a_factor_is_of_forces_added_mass_or_damping_or_of_several(names, words, factor):
    end = ": the opposite sign" if factor < 0 else ""
    assert taken_back(by(names, factor)(right()), f"{words} {factor:.4g} times as large").cause.text.endswith(
        f"{factor:.4g} times as large{end}"
    )


@pytest.mark.parametrize("size", [3.0, 0.2])
def test_a_size_with_other_phases_needs_both_named(size):
    found = taken_back(changed(right(), FORCES, lambda X: size * np.conj(X)), "two causes: ")
    assert f"forces are {size:.4g} times as large" in found.cause.text and "conjugates" in found.cause.text


@pytest.mark.parametrize("length", [10.0, 0.3048, 3.0])
def test_a_length_is_told_with_its_way_out(length):
    """Of A L³⁺ᵖ⁺ᑫ, X L²⁺ᵖ"""
    rotation = np.array([0, 0, 0, 1, 1, 1.0])
    wrong = changed(right(), MATRICES, lambda M: M * length ** (3 + rotation + rotation[:, None]))
    wrong = changed(wrong, FORCES, lambda X: X * length ** (2 + rotation))
    found = taken_back(wrong, f"made dimensionless by a length of {1 / length:.4g} m, not by the assumed length")
    assert found.cause.way_out == f"--length-unit {1 / length:.4g}"


def test_damping_over_and_times_the_frequency():
    for power, words in ((-1.0, "damping is that over ω"), (1.0, "damping is that times ω")):
        taken_back(changed(right(), MATRICES[1:2], lambda B, p=power: B * OMEGA[:, None, None] ** p), words)


def test_frequencies_in_other_words():
    taken_back(replace(right(), omega=OMEGA * 2 * np.pi), "frequencies are in rad/s and were read as Hz")
    order = [1, 0]
    turned = {name: data[order] for name, data in right().quantities.items()}
    taken_back(replace(right(), omega=2 * np.pi / OMEGA[order], quantities=turned), "frequencies are periods")


def test_agreement_is_within_a_tenth():
    for size, agrees in ((1.097, True), (1.103, False), (0.903, True), (0.897, False)):
        assert (finding(changed(right(), FORCES, lambda X, s=size: s * X), Hull()) is None) is agrees


@pytest.mark.parametrize("number, kept", [
    (1.029, []), (1.031, [1.031]), (2.05, [2.0]), (2.07, [2.07]), (0.0, []), (-0.98, [-1.0]), (0.51, [0.5]),
])  # fmt: skip
def test_factors_within_three_per_cent_of_a_known_one_are_that_and_of_one_are_none(number, kept):
    assert causes._apart([number]) == pytest.approx(kept)
    assert causes._apart([number, number * 1.0005, 5.0]) == pytest.approx([*kept, 5.0])
    for length in (1e-3, 1e-2, 0.1, 0.3048, 1 / 0.3048, 10.0, 100.0, 1e3):
        assert causes._apart([1.02 * length, 1.04 * length], causes.LENGTHS) == [length, 1.04 * length]


def test_a_factor_is_the_least_squares_one_over_sizes_of_rows():
    """Σ Re(f ō)/s² over Σ |o|²/s², and √ of the ratio of squares where signs or phases differ by more than 3 %"""
    own, size = np.array([[1.0, 2.0], [4.0, 3.0]]), np.array([[1.0, 1.0], [2.0, 10.0]])
    file = own * np.array([[3.0, 7.0], [4.0, 6.0]])
    weights = (own / size) ** 2
    expected = np.sum(weights * [[3, 7], [4, 6]]) / np.sum(weights)
    assert causes._factor([(file, own, size)]) == pytest.approx(expected)
    spread = np.sqrt(np.sum(weights * np.array([[9, 49], [16, 36]])) / np.sum(weights))
    assert causes._factors([(file, own, size)]) == pytest.approx((expected, spread))
    assert causes._factors([(7 * own, own, size)]) == pytest.approx((7.0,))
    assert causes._factors([(-7 * own, own, size)]) == pytest.approx((-7.0,))
    two = causes._factor([(file, own, size), (7 * own, own, size)])
    assert two == pytest.approx((expected + 7) / 2)


def test_points_within_a_fiftieth_of_half_the_hull_are_one():
    """0.4 m of 20 m, and the origin where the shift is that of the centre"""
    for x, told in ((0.39, False), (0.41, True)):
        at = [one.text for one in causes._about_points(shifted(x), Hull())]
        assert any("moments and rotations are about" in text for text in at) is told

    class Elsewhere(Hull):
        center = (3.0, 0.0, -2.0)

    texts = {one.text: one.way_out for one in causes._about_points(shifted(-3.2, -2.0, +2.1), Elsewhere())}
    assert "--about -0.2,-2,0.1" in texts.values()
    near = {one.text: one.way_out for one in causes._about_points(shifted(-3.2, 0.1, 2.1), Elsewhere())}
    assert "--about 0,0,0" in near.values() and any("about (0, 0, 0) m" in text for text in near)


def shifted(x, y=0.0, z=0.0):
    """Moments about a point that lies (x, y, z) from ours"""
    from hakobune.bem.modes import reference_change

    T = reference_change((x, y, z))
    return changed(right(), FORCES + MATRICES, lambda d: d @ T.T if np.iscomplexobj(d) else T @ d @ T.T)


def test_crests_within_a_fiftieth_of_half_the_hull_are_at_the_origin():
    from hakobune.bem.waves import wavenumber

    k = wavenumber(OMEGA, right().water_depth, right().gravity)[:, None]
    for x, told in ((0.39, False), (0.41, True)):
        wrong = changed(right(), FORCES, lambda X, x=x: X * np.exp(-1j * k * x * np.cos(BETA))[..., None])
        texts = [one.text for one in causes._about_points(wrong, Hull())]
        crests = [text.partition(" m,")[0] for text in texts if "phase 0" in text]
        assert crests == ["phase 0 is a crest at (0.41, 0)"] * told


@pytest.mark.parametrize("factor", [3.0, -3.0, np.pi / 180])
def test_rows_of_rotations_may_have_a_factor_of_their_own(factor):
    """Of forces alone moments; of the matrices too, rows and columns of rotations"""
    size = np.array([1, 1, 1, factor, factor, factor])
    wrong = changed(right(), FORCES, lambda X: X * size)
    taken_back(wrong, f"moments are {factor:.4g} times as large")
    assert [one.text.split(" are ")[0] for one in causes._about_moments(parts_of(wrong))][:2] == [
        "moments", "rows of rotations",
    ]  # fmt: skip
    wrong = changed(wrong, MATRICES, lambda M: M * np.outer(size, size))
    taken_back(wrong, f"rows of rotations are {factor:.4g} times as large")


def parts_of(wrong):
    return [part[..., 3:] for part in causes._compared(wrong, Hull())["excitation_force"]]


def test_what_is_compared_counts_by_the_root_of_both_diagonals_and_by_the_largest_force():
    """√(ii · jj) of our added mass and damping; each force by `sizes_of_forces`"""
    from hakobune.bem.formats.judging.own_solution import sizes_of_forces

    found = causes._compared(right(), Hull())
    assert list(found) == ["added_mass", "radiation_damping", "excitation_force"]
    for name in ("added_mass", "radiation_damping"):
        file, own, size = found[name]
        assert file == pytest.approx(own)
        for n in range(2):
            d = np.sqrt(np.diag(own[n]))
            assert size[n] == pytest.approx(np.outer(d, d))
    file, own, size = found["excitation_force"]
    for n in range(2):
        assert size[n] == pytest.approx(np.tile(sizes_of_forces(own[n], Hull()), (len(BETA), 1)))

    class Still(Hull):
        moves = np.array([True] * 5 + [False])

    assert np.isinf(causes._compared(right(), Still())["added_mass"][2][:, 5]).all()
    less = replace(right(), quantities={"added_mass": right().quantities["added_mass"]})
    assert list(causes._compared(less, Hull())) == ["added_mass"]
