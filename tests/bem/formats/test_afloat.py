"""What files say held against the hull: every limit from both sides, of a box of 20 x 10 x 4 m."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.formats.afloat import Weight, on_hull
from hakobune.bem.formats.values import FormatError, Values, evenly, gridded, with_headings_once
from hakobune.meshing.shapes import box

RHO, G = 1000.0, 10.0
HULL = box(20, 10, 4, panels=60)
VOLUME, PLANE = 800.0, 200.0
C33 = RHO * G * PLANE


def values(body=(), quantities=(), omega=(0.5, 1.0)):
    return Values(np.array(omega), np.array([0.0, 1.0]), 20.0, RHO, G, dict(quantities), dict(body))


def stiffness(heave=1.0, roll=0.0):
    """Of the hull with its weight at the origin: I = 20 · 10³/12 and 10 · 20³/12 m⁴, buoyancy 2 m deep"""
    C = np.diag([0, 0, heave * C33, 0, 0, 0])
    C[3, 3] = RHO * G * (20 * 10**3 / 12 - 2 * VOLUME) + roll
    C[4, 4] = RHO * G * (10 * 20**3 / 12 - 2 * VOLUME) + roll
    return C


@pytest.mark.parametrize("sign", [1, -1])
def test_a_volume_two_per_cent_off_is_of_another_hull(sign):
    on_hull(values({"displaced_volume": VOLUME * (1 + 0.019 * sign)}), HULL)
    with pytest.raises(
        FormatError,
        match=r"the mesh displaces 800 m³, but the results are for a body of .*; allowed: "
        r"within 2 %",
    ):
        on_hull(values({"displaced_volume": VOLUME * (1 + 0.021 * sign)}), HULL)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_heave_stiffness_five_per_cent_off_is_of_another_length(sign):
    """A length that is √ of it as large"""
    on_hull(values({"hydrostatic_stiffness": stiffness(1 + 0.049 * sign)}), HULL)
    with pytest.raises(FormatError, match=r"heave stiffness .* the waterplane of the hull, 2e\+06 N/m; .*within 5 %"):
        on_hull(values({"hydrostatic_stiffness": stiffness(1 + 0.051 * sign)}), HULL)
    with pytest.raises(FormatError, match=r"0.01 times ρ g .* dimensionless is 10 times as large"):
        on_hull(values({"hydrostatic_stiffness": stiffness(0.01)}), HULL)


def test_a_mass_three_times_or_a_third_of_the_displaced_is_in_another_unit():
    for ratio, refused in ((2.95, False), (3.05, True), (0.34, False), (0.33, True)):
        one = values({"mass": ratio * RHO * VOLUME})
        if refused:
            with pytest.raises(FormatError, match=r"the hull displaces 800000 kg; allowed: 0.33 to 3 times the"):
                on_hull(one, HULL)
        else:
            remarks = on_hull(one, HULL)[1]
            assert f"mass {ratio * 8e5:.6g} kg is not the displaced mass of 800000 kg" in remarks[0]
    for ratio, told in ((1.0095, False), (1.0105, True), (0.9905, False), (0.9895, True)):
        remarks = on_hull(values({"mass": ratio * RHO * VOLUME}), HULL)[1]
        assert any("is not the displaced" in line for line in remarks) == told


def test_a_body_without_geometry_gets_that_of_the_hull():
    found, remarks = on_hull(values(), HULL)
    body = found.body
    assert body["displaced_volume"] == pytest.approx(VOLUME) and body["waterplane_area"] == pytest.approx(PLANE)
    assert body["wetted_area"] == pytest.approx(200 + 2 * 30 * 4) and "mass" not in body
    assert body["center_of_buoyancy"] == pytest.approx([0, 0, -2])
    assert body["hydrostatic_stiffness"] == pytest.approx(stiffness())
    assert remarks == ["hydrostatic stiffness is that of the hull, with the weight at its centre of mass"]
    kept = on_hull(values({"displaced_volume": 801.0, "hydrostatic_stiffness": stiffness()}), HULL)
    assert kept[0].body["displaced_volume"] == 801.0 and kept[1] == []


def test_a_given_weight_takes_the_place_of_that_of_the_file():
    """I_G + m r² about the rotation centre, and −m g z_G in roll and pitch"""
    given = Weight(mass=7.8e5, center=(1.0, 0.0, -1.5), gyration=(3.0, 6.0, 6.0))
    assert given.given and not Weight().given
    found, remarks = on_hull(values({"center_of_mass": np.array([9.0, 9, 9])}), HULL, given)
    M, C = found.body["inertia_matrix"], found.body["hydrostatic_stiffness"]
    assert M[4, 4] == pytest.approx(7.8e5 * (36 + 1 + 2.25)) and M[0, 4] == pytest.approx(-1.5 * 7.8e5)
    assert C[3, 3] == pytest.approx(stiffness()[3, 3] + 7.8e5 * G * 1.5)
    assert found.body["mass"] == 7.8e5 and found.body["center_of_mass"].tolist() == [1.0, 0.0, -1.5]
    assert "780000 kg is not the displaced" in remarks[0] and len(remarks) == 1
    moved = replace(values(), rotation_center=np.array([1.0, 0, -1.5]))
    assert on_hull(moved, HULL, given)[0].body["inertia_matrix"] == pytest.approx(
        7.8e5 * np.diag([1, 1, 1, 9, 36, 36.0])
    )


@pytest.mark.parametrize(
    "roll, words",
    [
        (0.0, "includes the weight"),
        (0.018, "includes the weight"),
        (0.022, "fits neither with this weight nor without weight"),
        ("bare", "does not include the weight"),
    ],
)
def test_a_stiffness_within_two_per_cent_of_pitch_is_known(roll, words):
    """m g z_G of a weight 1.5 m deep is 1.2e7 N m, pitch 6.3e7 N m with it"""
    arm = RHO * VOLUME * G * 1.5
    size = stiffness()[4, 4] + arm
    C = stiffness(roll=0.0 if roll == "bare" else arm + roll * size)
    remarks = on_hull(values({"hydrostatic_stiffness": C}), HULL, Weight(center=(0, 0, -1.5)))[1]
    assert words in remarks[0] and "the value of the hull with its weight at the centre of mass is stored" in remarks[0]


def test_motions_of_the_free_body_follow_where_all_is_there():
    A, B = np.diag([2e5] * 3 + [1e7] * 3) * np.ones((2, 1, 1)), np.diag([1e5] * 3 + [1e6] * 3) * np.ones((2, 1, 1))
    F = (1.0 + 2j) * 1e4 * np.arange(1, 13.0).reshape(2, 6) * np.ones((2, 1, 1))
    known = values(quantities={"added_mass": A, "radiation_damping": B, "excitation_force": F})
    assert "rao" not in on_hull(known, HULL)[0].quantities  # no inertia
    found = on_hull(known, HULL, Weight(gyration=(3, 6, 6)))[0]
    M, C = RHO * VOLUME * np.diag([1, 1, 1, 9, 36, 36.0]), stiffness()
    for i, w in enumerate((0.5, 1.0)):
        Z = -(w**2) * (M + A[i]) - 1j * w * B[i] + C
        rao = found.quantities["rao"][i]
        assert rao == pytest.approx(np.linalg.solve(Z, F[i].T).T)
    own = values(quantities={"added_mass": A, "radiation_damping": B, "excitation_force": F, "rao": 0 * F})
    assert not on_hull(own, HULL, Weight(gyration=(3, 6, 6)))[0].quantities["rao"].any()
    for factor, told in ((1.049, ()), (1.051, ("5.1",)), (1.06, ("6",)), (0.94, ("6",))):  # of pitch alone
        scaled = found.quantities["rao"] * np.array([1, 1, 1, 1, factor, 1])
        said = on_hull(replace(own, quantities=own.quantities | {"rao": scaled}), HULL, Weight(gyration=(3, 6, 6)))[1]
        of_motions = [one for one in said if one.startswith("the motions in the files are stored; they differ by")]
        assert len(of_motions) == len(told)
        assert all(f"by up to {per_cent} % of the largest pitch" in of_motions[0] for per_cent in told)


def test_steps_even_to_a_millionth_are_even():
    assert evenly("periods", np.array([1.0, 2.0, 3.0 + 1.5e-6]), "s", "or") == (1.0, 3.0 + 1.5e-6, 3)
    assert evenly("periods", np.array([4.0]), "s", "or") == (4.0, 4.0, 1)
    with pytest.raises(FormatError, match=r"periods are 1 to 1 s apart; allowed in this format: evenly spaced, or"):
        evenly("periods", np.array([1.0, 2.0, 3.0 + 2.5e-6]), "s", "or")


def test_one_heading_listed_twice_may_differ_by_a_thousandth_of_the_largest():
    F = np.full((1, 3, 6), 2.0 + 0j)
    for off, refused in ((0.9e-3, False), (1.1e-3, True)):
        X = F.copy()
        X[0, 2, 1] += 2.0 * off
        twice = replace(values(quantities={"excitation_force": X}), wave_direction=np.radians([0, 90, 360]))
        if refused:
            with pytest.raises(FormatError, match=r"excitation_force differs by 0.0022 between headings 0° and 360°"):
                with_headings_once(twice)
        else:
            once = with_headings_once(twice)
            assert once.wave_direction == pytest.approx(np.radians([0, 90]))
            assert once.quantities["excitation_force"] == pytest.approx(F[:, :2])


def test_a_table_is_put_on_its_grid_in_any_order_and_a_place_twice_is_damage():
    w, i = np.array([2.0, 1.0, 2.0, 1.0]), np.array([1.0, 3.0, 3.0, 1.0])
    (omega, modes), grid = gridded("a", [w, i], np.array([21.0, 13.0, 23.0, 11.0]), modes=((1, 2, 3),))
    assert omega.tolist() == [1, 2] and modes.tolist() == [1, 2, 3]
    assert grid.tolist() == [[11, 0, 13], [21, 0, 23]]
    twice = gridded("a", [np.append(w, 1.0), np.append(i, 3.0)], np.array([21.0, 13.0, 23.0, 11.0, 13.0]))[1]
    assert twice.tolist() == [[11, 13], [21, 23]]  # of one value both times
    with pytest.raises(FormatError, match="a: 2 values for 1, 3; allowed: exactly one value for each combination"):
        gridded("a", [np.append(w, 1.0), np.append(i, 3.0)], np.arange(5.0))
    with pytest.raises(FormatError, match="a: 0 values for 2, 3"):
        gridded("a", [w[[0, 1, 3]], i[[0, 1, 3]]], np.arange(3.0), modes=((1, 2, 3),))


@pytest.mark.parametrize("heave", [0.0, -1.0])
def test_files_without_a_stiffness_in_heave_have_that_of_the_hull(heave):
    """A set of zeros, as programs write where they have none, would let the body fall through the water"""
    found, remarks = on_hull(values({"hydrostatic_stiffness": stiffness(heave)}), HULL)
    assert found.body["hydrostatic_stiffness"] == pytest.approx(stiffness())
    assert remarks[0].startswith(
        f"heave stiffness in the files is {heave * C33:.5g} N/m, but that of the hull is 2e+06"
    )
    kept = on_hull(values({"hydrostatic_stiffness": stiffness()}), HULL)
    assert not any("is not used" in line for line in kept[1])
