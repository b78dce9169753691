"""Laws between the numbers of a set, on a small round body whose numbers obey them by construction.

X₃ = C₃₃ − ω² m₃ − iωB₃₃,  X₁ = −iω² m₁ cosβ coth kh,  B₃₃ = k|X₃|² / 4ρgC_g,  B₁₁ = k|X₁(0)|² / 8ρgC_g
"""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.formats.judging import laws
from hakobune.bem.formats.judging.laws import doubts, haskind_ratios
from hakobune.bem.formats.values import Values
from hakobune.bem.waves import group_factor, wavenumber

RHO, G, DEPTH = 1025.0, 9.80665, 40.0
C33 = RHO * G * 3.0  # of a waterplane of 3 m²
HEADINGS = np.radians([0.0, 30.0, 90.0])


def body(depth=DEPTH, headings=HEADINGS):
    omega = np.linspace(0.2, 1.6, 15)
    k = wavenumber(omega, depth, G)
    rate = k / (4 * RHO * G * group_factor(k, depth) * omega / k)
    heave, surge = 4000.0, 3000.0  # kg, displaced with added mass
    along = -1j * G * k * surge
    B33 = rate * (C33 - omega**2 * heave) ** 2
    X = np.zeros((len(omega), len(headings), 6), complex)
    X[:, :, 0], X[:, :, 1] = along[:, None] * np.cos(headings), along[:, None] * np.sin(headings)
    X[:, :, 2] = (C33 - omega**2 * heave - 1j * omega * B33)[:, None]
    A, B = (np.zeros((len(omega), 6, 6)) for _ in range(2))
    A[:, range(6), range(6)] = (1500.0, 1500.0, 2000.0, 500.0, 500.0, 1.0)
    B[:, 0, 0] = B[:, 1, 1] = 0.5 * rate * np.abs(along) ** 2
    B[:, 2, 2] = B33
    quantities = {"added_mass": A, "radiation_damping": B, "excitation_force": X}
    C = np.diag([0, 0, C33, 0, 0, 0])
    return Values(
        omega, headings, depth, RHO, G, quantities, {"hydrostatic_stiffness": C, "displaced_volume": 2000 / RHO}
    )


def changed(values, **functions):
    new = {name: functions[name](data) if name in functions else data for name, data in values.quantities.items()}
    return replace(values, quantities=new)


def said(values):
    return " ".join(doubts(values)[0])


def test_a_body_that_obeys_the_laws_is_not_doubted():
    found, tested = doubts(body())
    assert found == [] and tested == ["reciprocity", "energy", "damping and excitation", "long waves"]
    ratios = haskind_ratios(body())
    assert set(ratios) == {0, 2}
    for ratio, _ in ratios.values():
        assert ratio == pytest.approx(1.0, abs=0.01)  # but for the imaginary part of X₃


def test_directions_all_round_give_every_mode_its_damping():
    round_ = body(headings=np.radians(np.arange(0, 360, 30.0)))
    ratios = haskind_ratios(round_)
    assert set(ratios) == {0, 1, 2} and ratios[1][0] == pytest.approx(1.0, abs=1e-9)
    quarter = body(headings=np.radians(np.arange(0, 91, 10.0)))
    assert haskind_ratios(quarter)[0][0] == pytest.approx(1.0, abs=0.01)  # the trapezoidal rule


@pytest.mark.parametrize("change, words", [
    ({"excitation_force": np.conj}, "phases are conjugates"),
    ({"excitation_force": lambda X: X * np.array([-1, -1, 1, -1, -1, 1])}, "headings are the directions that waves "
        "come from"),
    ({"excitation_force": np.negative}, "forces have another sign"),
    ({"excitation_force": lambda X: 2 * X}, "forces are for 1 m of wave height"),
    ({"excitation_force": lambda X: X / 1e3}, "forces are in kN"),
    ({"radiation_damping": lambda B: B / 1e3}, "damping is in kN and forces are in N"),
    ({"radiation_damping": np.negative}, "B_33 is below 0: damping has the opposite sign"),
    ({"radiation_damping": lambda B: B / np.linspace(0.2, 1.6, 15)[:, None, None]}, "damping is divided by ω"),
    ({"added_mass": lambda A: A + 300.0 * (np.arange(36).reshape(6, 6) == 4)}, "A_15 and A_51 differ by"),
])  # fmt: skip
def test_a_broken_law_names_its_cause(change, words):
    assert words in said(changed(body(), **change))


def test_the_depth_that_a_set_is_of_is_found():
    shallow = body(depth=12.0)
    assert said(shallow) == ""
    found = said(replace(shallow, water_depth=np.inf))
    depth = float(found.split("they agree in ")[1].split(" m")[0])
    assert depth == pytest.approx(12.0, rel=0.1) and "not in inf m (--depth)" in found
    assert "they agree in deep water, not in 6 m" in said(replace(body(depth=np.inf), water_depth=6.0))


def test_the_walls_of_a_channel_are_told_by_the_damping_of_surge_and_heave():
    """(B³³, B¹¹)·(1, 2)/kw, by the energy of two plane waves between walls w apart"""
    k = wavenumber(body().omega, DEPTH, G)
    walls = np.diag([2.0, 2.0, 1.0, 0, 0, 0]) / (k * 5.0)[:, None, None]
    assert "damping in a channel 5.0" in said(changed(body(), radiation_damping=lambda B: B * walls)).replace(
        "5 m", "5.0 m"
    )


def test_a_deck_in_the_surface_is_told_by_the_water_that_it_lifts():
    """Heave of a deck that covers a share of the waterplane lifts as much water: A₃₃ → A₃₃ − share C₃₃/ω²"""
    omega, nine = body().omega, np.diag([1, 1, 9, 1, 1, 1])

    def lifted(share):
        more = np.zeros((len(omega), 6, 6))
        more[:, 2, 2] = -share * C33 / omega**2
        return changed(body(), added_mass=lambda A: A + more, radiation_damping=lambda B: B * nine)

    assert doubts(lifted(0.95))[0] == [
        "waterplane: A_33 of long waves is -0.91 C_33/ω²: the mesh has a deck or a lid in the surface whose panels "
        "heave with the hull and lift water; solve it without these"
    ]
    assert "a deck or a lid in the surface" in said(replace(lifted(0.5), others=2))
    assert "deck" not in said(lifted(0.3)) and "B_33 is 9 times" in said(lifted(0.3))
    assert "deck" not in said(replace(lifted(0.95), body={}))
    steep = changed(lifted(0.95), radiation_damping=lambda B: B * np.diag([9, 1, 1, 1, 1, 1]))
    assert "B_11 is 9 times" in said(steep) and "deck" in said(steep)
    below = np.where(np.arange(len(omega)) % 5, 1.0, -1.0)[:, None, None]
    assert "energy: B_" in said(changed(lifted(0.3), radiation_damping=lambda B: B * below))
    assert "energy: B_" not in said(changed(lifted(0.95), radiation_damping=lambda B: B * below))


def test_beside_other_bodies_one_mode_tells_no_channel_and_two_do():
    """Waves that another body reflects give surge and heave no common width"""
    k = wavenumber(body().omega, DEPTH, G)
    walls = np.diag([2.0, 2.0, 1.0, 0, 0, 0]) / (k * 5.0)[:, None, None]
    beside = replace(changed(body(), radiation_damping=lambda B: B * walls), others=1)
    assert "damping in a channel 5 m wide" in said(beside)
    surge = np.diag([2.0, 2.0, 0, 0, 0, 0]) / (k * 5.0)[:, None, None] + np.diag([0, 0, 1.0, 0, 0, 0])
    alone = replace(changed(body(), radiation_damping=lambda B: B * surge), others=1)
    assert "is 0" not in said(alone) and "channel" not in said(alone)


def test_beside_other_bodies_long_waves_tell_nothing():
    turned = changed(body(), excitation_force=np.conj)
    assert said(replace(turned, others=1)) == ""


def test_what_does_not_float_has_no_crest_to_follow():
    """X₃ = −ω² m of a submerged body"""
    under = body()
    X = under.get("excitation_force").copy()
    X[:, :, 2] = (-4000.0 * under.omega**2)[:, None]
    under = replace(changed(under, excitation_force=lambda _: X), body={"hydrostatic_stiffness": np.zeros((6, 6))})
    assert "surge" not in said(under) and "heave force" not in said(under)
    X[:, :, 2] = 0.0  # a mode that is not in the files has no force to be weighed
    assert "heave force" not in said(replace(under, body=body().body))


def test_added_mass_falls_by_what_damping_makes_of_it():
    """A(0) − A(∞) = (2/π) ∫ b ω² exp(−ω/c) dω = 4 b c³/π of a damping b ω⁴ exp(−ω/c)"""
    omega, c = np.linspace(0.05, 40.0, 800), 1.0
    one = body()
    A, B = np.zeros((800, 6, 6)), np.zeros((800, 6, 6))
    A[:, range(6), range(6)] = 1000.0
    for i in (0, 1):
        B[:, i, i] = 500.0 * omega**4 * np.exp(-omega / c)
    limits = {
        "added_mass_zero": np.diag([1000 + 2000 / np.pi * c**3] * 6),
        "added_mass_infinity": np.diag([1000.0] * 6),
    }
    right = replace(one, omega=omega, quantities={"added_mass": A, "radiation_damping": B, **limits})
    assert doubts(right) == ([], ["reciprocity", "energy", "causality"])
    assert "A_11 falls by" in said(changed(right, radiation_damping=lambda B: 2 * B))


def test_waves_all_round_tell_at_one_frequency():
    round_ = body(headings=np.radians(np.arange(0, 360, 30.0)))
    some = {name: data[4:5] for name, data in round_.quantities.items()}
    one = replace(round_, omega=round_.omega[4:5], quantities=some)
    assert "damping and excitation" in doubts(one)[1] and said(one) == ""
    assert "damping is in kN and forces are in N" in said(changed(one, radiation_damping=lambda B: B / 1e3))


def test_added_mass_follows_damping_without_its_limits():
    """Of a memory (1 − ct) exp(−ct): B = 2cω²/(c² + ω²)², A = A∞ − (ω² − c²)/(c² + ω²)²"""
    omega, c, one = np.linspace(0.05, 60.0, 1200), 1.0, body()
    A, B = np.zeros((1200, 6, 6)), np.zeros((1200, 6, 6))
    A[:, range(6), range(6)] = 0.5
    for i in (0, 1):
        B[:, i, i] = 2 * c * omega**2 / (c**2 + omega**2) ** 2
        A[:, i, i] = 2.0 - (omega**2 - c**2) / (c**2 + omega**2) ** 2
    right = replace(one, omega=omega, quantities={"added_mass": A, "radiation_damping": B})
    found, tested = doubts(right)
    assert "causality" in tested and not [line for line in found if line.startswith("causality")]
    assert "A_11 falls by" in said(changed(right, radiation_damping=lambda B: 3 * B))
    peak = np.where(np.arange(1200) == 90, 5.0, 0.0)[:, None, None] * np.eye(6)
    assert "causality" not in doubts(changed(right, added_mass=lambda A: A + peak))[1]


def test_modes_that_agree_rule_out_a_wrong_unit():
    round_ = body(headings=np.radians(np.arange(0, 360, 30.0)))
    heave = np.where(np.arange(6) == 2, 2.0, 1.0)[None, :, None] * np.ones((1, 6, 6))
    line = said(replace(changed(round_, radiation_damping=lambda B: B * heave), others=1))
    assert "B_11, B_22 agrees, so the units are right: there are too few panels for mode 3" in line


@pytest.mark.parametrize("factor, words", [
    (1e-3, "forces are in kN"), (1e3, "stiffness is in kN"),
    (2.0, "forces are for 1 m of wave height, not of amplitude"),
    (0.5, "forces are halved"), (1 / 9.80665, "forces lack g"),
])  # fmt: skip
def test_a_factor_of_forces_is_named_within_a_fifth_of_it(factor, words):
    """ln within 0.2 either way, e^0.2 = 1.2214, of the heave force of long waves over what restoring makes of it"""
    for share, named in ((1.215, True), (1 / 1.215, True), (1.235, False), (1 / 1.235, False)):
        line = laws._factor_of_force(factor * share)
        assert line == (words if named else "the two differ in their units, lengths, density or depth")


def test_frequencies_at_which_anything_is_not_finite_are_left_out_of_all_judging():
    """Whichever quantity it is of; the rest is judged as if they had never been there"""
    values = body()
    for name, bad in (("added_mass", 0), ("excitation_force", 7)):

        def spoiled(data, bad=bad):
            data = data.copy()
            data[bad].flat[0] = np.nan
            return data

        kept = np.arange(len(values.omega)) != bad
        found = laws._finite(changed(values, **{name: spoiled}))
        assert np.array_equal(found.omega, values.omega[kept]) and said(changed(values, **{name: spoiled})) == ""
        for quantity, data in found.quantities.items():
            assert np.array_equal(data, values.quantities[quantity][kept])
    assert laws._finite(values) is values
