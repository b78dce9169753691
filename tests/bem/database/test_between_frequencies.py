"""What is said between and beyond stored frequencies that no fit decides."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.between_frequencies import Between, BetweenError
from hakobune.bem.database.between_frequencies import between as of_database
from hakobune.bem.modes import Body, Mode

G = 9.80665
OMEGA = np.array([0.4, 0.6, 0.8, 1.0, 1.2])
OUTLINE = np.array([[-30.0, -5.0], [30.0, -5.0], [30.0, 5.0], [-30.0, 5.0]])


def between(quantities, limits=None, **more):
    given = {"depth": 20.0, "gravity": G, "headings": np.array([0.0, 0.7]), "theta": np.arange(8) * np.pi / 4}
    return Between(OMEGA, quantities, outline=OUTLINE, limits=limits or {}, **(given | more))


def mass(*values):
    return np.array([np.diag([v, 2 * v, 3 * v, 100 * v, 400 * v, 200 * v]) for v in values])


A = mass(5.0, 4.0, 3.5, 3.2, 3.0)
ZERO, INFINITY = mass(6.0)[0], mass(2.0)[0]


def test_added_mass_tends_to_its_limits_with_the_second_power_and_an_error_of_its_difference_from_the_first():
    """A(0) + [A(ω₁) − A(0)] (ω/ω₁)², and likewise with ω_n/ω; errors |A(ω₁) − A(0)| s (1 − s)"""
    known = between({"added_mass": A}, {"added_mass_zero": ZERO, "added_mass_infinity": INFINITY})
    for omega, end, limit, share in ((0.1, A[0], ZERO, 0.25), (3.0, A[-1], INFINITY, 0.4)):
        assert known.value([omega], "added_mass")[0] == pytest.approx(limit + (end - limit) * share**2)
        assert known.error([omega], "added_mass")[0] == pytest.approx(np.abs(end - limit) * share * (1 - share))
    assert known.value([0.0], "added_mass")[0] == pytest.approx(ZERO)
    assert known.value(OMEGA[[0, 4]] * [1 - 1e-10, 1 + 1e-10], "added_mass") == pytest.approx(A[[0, 4]])


def test_an_infinite_limit_keeps_the_end_value_with_an_infinite_error():
    heave = ZERO.copy()
    heave[2, 2] = np.inf
    known = between({"added_mass": A}, {"added_mass_zero": heave})
    value, error = known.value([0.2], "added_mass")[0], known.error([0.2], "added_mass")[0]
    assert value[2, 2] == A[0, 2, 2] and np.isinf(error[2, 2]) and value[0, 0] == pytest.approx(6 - 0.25)
    with pytest.raises(
        BetweenError, match=r"omega is 1.3 rad/s \(period 4.833 s\), outside the stored 0.4 to 1.2 rad/s"
    ):
        known.value([1.3], "added_mass")
    assert not between({"added_mass": A}, {"added_mass_zero": np.full((6, 6), np.inf)}).has_limit("added_mass_zero")


def test_errors_are_relative_to_the_largest_of_each_motion_and_to_both_of_a_coupling():
    """|A(ω₁) − A(0)| s (1 − s) over the largest diagonal of the band, √(ii · jj) of couplings; with less than 1e-4 of
    the largest of its kind a motion moves no water"""
    values, zero = A.copy(), ZERO.copy()
    zero[0, 4] = 50.0
    known = between({"added_mass": values}, {"added_mass_zero": zero})
    coupling, own = 50.0 * 0.25 / np.sqrt(5.0 * 2000.0), 1.0 * 0.25 / 5.0
    assert known.largest_error([0.2], ["added_mass"]) == pytest.approx([max(coupling, own)]) and coupling > own
    assert known.largest_error([0.2, 0.6], ["added_mass"])[1] == 0.0
    for share, counts in ((0.8e-4, False), (1.2e-4, True)):  # of √
        values, zero = A.copy(), A[0].copy()
        values[:, 5, 5], zero[5, 5] = share**2 * 2000.0, 3 * share**2 * 2000.0
        found = between({"added_mass": values}, {"added_mass_zero": zero}).largest_error([0.2], ["added_mass"])
        assert found == pytest.approx([0.5 if counts else 0.0])


def test_drift_of_a_floating_body_may_hide_half_the_step_between_two_frequencies():
    """½ |Δ| · 4 t (1 − t) more than the same numbers of a fixed body: a resonance leaves no trace there"""
    force = np.cumsum([1.0, 0.5, -2.0, 3.0, 1.0])[:, None, None] * np.array([[1.0, 2.0, 5.0], [3.0, 0.0, 1.0]])
    known = between({"drift_force": force, "drift_force_fixed": force})
    at = np.array([0.45, 0.95, 1.1])
    extra = known.error(at, "drift_force") - known.error(at, "drift_force_fixed")
    t, step = np.array([0.25, 0.75, 0.5]), np.abs(np.diff(force, axis=0))[[0, 2, 3]]
    assert extra == pytest.approx(0.5 * step * (4 * t * (1 - t))[:, None, None])
    assert not known.error(OMEGA, "drift_force").any()


def test_frequencies_are_stored_ones_within_a_thousand_millionth():
    known = between({"added_mass": A})
    assert known.stored(np.array([0.6 * (1 + 0.9e-9), 0.6 * (1 + 1.1e-9), 1.2])).tolist() == [1, -1, 4]
    known.inside([0.4 * (1 - 0.9e-9), 1.2 * (1 + 0.9e-9)])
    for w in (0.4 * (1 - 1.1e-9), 1.2 * (1 + 1.1e-9)):
        with pytest.raises(BetweenError, match="outside the stored"):
            known.inside([w])


def test_four_frequencies_are_the_fewest_between_which_something_is_known():
    for count in (3, 4):
        few = Between(OMEGA[:count], {"added_mass": A[:count]}, 20.0, G, np.zeros(1), np.zeros(1), OUTLINE)
        if count == 4:
            assert few.inside([0.5]) == [0.5]
            continue
        with pytest.raises(
            BetweenError,
            match=r"omega is 0.5 rad/s, which is not stored; .* at least 4 stored "
            r"frequencies, and 3 are stored",
        ):
            few.inside([0.5])


def test_waves_meet_the_hull_at_its_point_farthest_ahead():
    """Of a hull of 60 x 10 m: 30 m in head waves, 30 cos β + 5 sin β at an angle; Kochin functions along θ, and both"""
    known = between({"excitation_force": np.zeros((5, 2, 6), complex)})
    assert known.length == 60.0
    assert known._lead("excitation_force")[:, 0] == pytest.approx([30.0, 30 * np.cos(0.7) + 5 * np.sin(0.7)])
    theta = np.arange(8) * np.pi / 4
    assert known._lead("kochin_radiation") == pytest.approx(30 * np.abs(np.cos(theta)) + 5 * np.abs(np.sin(theta)))
    both = [30 * np.abs(np.cos(theta) - np.cos(b)) + 5 * np.abs(np.sin(theta) - np.sin(b)) for b in (0.0, 0.7)]
    assert known._lead("kochin_diffraction") == pytest.approx(np.array(both))
    assert known._lead("added_mass") == pytest.approx(0.0)


def test_a_wall_adds_the_image_of_the_hull_to_what_waves_meet():
    image = between({}, wall=40.0).met_by_waves
    assert image[:4] == pytest.approx(OUTLINE)
    assert image[4:] == pytest.approx(np.stack([OUTLINE[:, 0], 80 - OUTLINE[:, 1]], axis=1))
    assert between({}).met_by_waves is not None and len(between({}).met_by_waves) == 4


def test_added_mass_and_damping_are_fitted_as_one_impedance():
    """B − iω [A − A(ω_max)], of which A and B are found again; errors of each are those of it over √2, and over ω"""
    B = mass(1.0, 3.0, 2.5, 1.5, 1.0)
    known = between({"added_mass": A, "radiation_damping": B})
    Z = B - 1j * OMEGA[:, None, None] * (A - A[-1])
    assert known._impedance == pytest.approx(Z)
    at = np.array([0.7])
    made = known._fit("impedance", at)[0]
    assert known.value(at, "radiation_damping")[0] == pytest.approx(made.real)
    assert known.value(at, "added_mass")[0] == pytest.approx(A[-1] - made.imag / 0.7)
    assert known.error(at, "added_mass")[0] == pytest.approx(known.error(at, "radiation_damping")[0] / 0.7)
    fit = known._interpolant("impedance")
    deviation = fit.deviation(known._abscissa(at))[0].reshape(6, 6)
    assert known.error(at, "radiation_damping")[0] == pytest.approx(deviation / np.sqrt(2))


def test_added_mass_is_given_within_and_beyond_the_band_at_once():
    """A(0) + [A(ω₁) − A(0)] (ω/ω₁)² and A(∞) + [A(ω_n) − A(∞)] (ω_n/ω)² beside stored values, in any order"""
    known = between({"added_mass": A}, {"added_mass_zero": ZERO, "added_mass_infinity": INFINITY})
    wanted = [INFINITY + (A[-1] - INFINITY) * 0.16, A[1], ZERO + (A[0] - ZERO) * 0.25, A[4]]
    assert known.value([3.0, 0.6, 0.2, 1.2], "added_mass") == pytest.approx(np.array(wanted))


def test_added_mass_without_damping_is_fitted_about_its_last_value():
    """What does not change between frequencies does not change; a straight line is followed"""
    same = between({"added_mass": mass(*[5.0] * 5)})
    assert same.value([0.5, 1.13], "added_mass") == pytest.approx(mass(5.0, 5.0), rel=1e-9)
    straight = between({"added_mass": mass(*(5.0 - OMEGA))})
    assert straight.value([0.7], "added_mass") == pytest.approx(mass(4.3), rel=1e-3)


def test_water_that_rings_is_sought_in_motions_that_move_water(monkeypatch):
    """B − iω [A − A(ω_n)] of each by itself; a motion whose largest is below 1e-8 of that of its kind is left out,
    also where its mean is a larger share; twelve frequencies at least"""
    from hakobune.bem.database import between_frequencies

    heard = []
    monkeypatch.setattr(between_frequencies, "ringing_of", lambda x, values: heard.append(values) or np.ones(1))
    omega = np.linspace(0.4, 1.5, 12)
    B, A = np.zeros((12, 6, 6)), np.zeros((12, 6, 6))
    A[:, range(6), range(6)] = np.linspace(3, 1, 12)[:, None] * [1, 1, 1, 1, 1, 1e-9]
    B[:, range(6), range(6)] = [0.5, 0.6, 0.7, 0.8, 0.9, 1e-9]
    B[3, 2, 2] = 90.0
    B[:, 1, 1], A[:, 1, 1] = 2e-8 * 90, 0.0
    both = {"added_mass": A, "radiation_damping": B}

    def known(count):
        some = {name: data[:count] for name, data in both.items()}
        return Between(omega[:count], some, 20.0, G, np.zeros(1), np.zeros(1), OUTLINE)

    assert len(known(11).ringing) == 0 and not heard
    assert known(12).ringing.tolist() == [1.0]
    Z = B - 1j * omega[:, None, None] * (A - A[-1])
    assert heard[0] == pytest.approx(np.einsum("nii->ni", Z)[:, [0, 1, 2, 3, 4]])
    B[:, 1, 1] = 0.9e-8 * 90
    known(12).ringing  # noqa: B018
    assert heard[1].shape == (12, 4)


def test_waves_meet_a_hull_ahead_of_the_origin_by_its_farthest_point_against_them():
    """max −x·e over the plan; of a Kochin function max x·(e_θ − e_β); of several bodies that of the body of each
    motion, shapes after the rigid ones; nothing of the rest"""
    ship, barge = OUTLINE, np.array([[90.0, 0.0], [110.0, 0.0], [100.0, 8.0]])
    theta, headings = np.arange(8) * np.pi / 4, np.array([0.0, np.pi / 2, np.pi])
    kochin = np.zeros((5, 6, 8), complex)
    one = between({"excitation_force": kochin}, headings=headings)
    two = Between(OMEGA, {"excitation_force": kochin}, 20.0, G, headings, theta, np.concatenate([ship, barge]),
                  outlines=(ship, barge), shapes=(1, 0))  # fmt: skip
    for name in ("excitation_force", "Froude_Krylov_force", "diffraction_force", "pressure"):
        assert one._lead(name)[:, 0] == pytest.approx([30.0, 5.0, 30.0])
    assert two._lead("excitation_force") == pytest.approx(
        np.array([[30.0] * 6 + [-90] * 6 + [-90, 30], [5.0] * 6 + [0] * 6 + [0, 5], [30.0] * 6 + [110] * 6 + [110, 30]])
    )
    assert two._lead("pressure")[:, 0] == pytest.approx([30.0, 5.0, 110.0])  # of all together
    r = np.sqrt(0.5)
    sent = [30.0, 35 * r, 5, 35 * r, 30, 35 * r, 5, 35 * r]
    assert one._lead("kochin_radiation") == pytest.approx(sent)
    of_barge = [110.0, 110 * r, 8, -90 * r, -90, -90 * r, 0, 110 * r]
    assert two._lead("kochin_radiation") == pytest.approx(np.array([sent] * 6 + [of_barge] * 6 + [of_barge, sent]))
    scattered = one._lead("kochin_diffraction")
    for i, b in enumerate(headings):
        for j, t in enumerate(theta):
            e = np.array([np.cos(t) - np.cos(b), np.sin(t) - np.sin(b)])
            assert scattered[i, j] == pytest.approx(max(point @ e for point in OUTLINE))
    assert one._lead("added_mass").tolist() == [0.0] and one.length == 60.0
    assert two._owners == [0] * 6 + [1] * 6 + [1, 0]


def test_what_is_unseen_of_drift_is_half_a_step_at_its_middle():
    """½ |D_i+1 − D_i| 4s(1 − s)"""
    drift = np.cumsum(np.arange(30.0)).reshape(5, 2, 3)
    one = between({"drift_force": drift})
    found = one._unseen(np.array([0.45, 0.7, 1.2]), "drift_force")
    assert found[0] == pytest.approx(0.5 * (drift[1] - drift[0]) * 4 * 0.25 * 0.75)
    assert found[1] == pytest.approx(0.5 * (drift[2] - drift[1])) and found[2] == pytest.approx(0 * drift[0])
    whole, alone = (
        between({name: drift}).error([0.7], name) for name in ("drift_force", "drift_force_fixed")
    )  # fmt: skip
    assert whole - alone == pytest.approx(found[1:2])


def test_one_frequency_of_several_that_is_not_stored_needs_four_stored_ones():
    for count, refused in ((3, True), (4, False)):
        few = Between(OMEGA[:count], {"added_mass": A[:count]}, 20.0, G, np.zeros(1), np.zeros(1), OUTLINE)
        assert few.inside(OMEGA[:2]).tolist() == OMEGA[:2].tolist()
        if refused:
            with pytest.raises(
                BetweenError, match=r"omega is 0\.5 rad/s, which is not stored; .* at least 4 .*, and 3 are stored"
            ):
                few.inside([0.4, 0.5])
        else:
            assert few.inside([0.4, 0.5]).tolist() == [0.4, 0.5]


class Stored(dict):
    """A database of a ship, a quay that is fixed and a barge that bends, ten points each"""

    omega, water_depth, gravity, wave_direction, wall = OMEGA, 20.0, G, np.array([0.0]), None
    bodies = (Body("ship"), Body("quay", fixed=True), Body("barge"))
    modes = (Mode("bow", body=2), Mode("stern", body=0))

    names = ("added_mass", "excitation_force", "drift_force", "added_mass_infinity", "added_mass_zero")

    def holds(self, name):
        return name != "added_mass_zero"

    class mesh:
        points = np.arange(90.0).reshape(30, 3)

        @staticmethod
        def whole():
            return SimpleNamespace(points=Stored.mesh.points)

        @staticmethod
        def of_body(i):
            own = SimpleNamespace(points=Stored.mesh.points[10 * i : 10 * i + 10])
            return SimpleNamespace(whole=lambda: own)


def test_of_a_database_of_several_bodies_those_that_move_are_read_with_their_plans():
    """Forces on the fixed body are left out, its plan too; shapes belong to the moving bodies by their number"""
    rng = np.random.default_rng(3)
    db = Stored(added_mass=rng.normal(size=(5, 20, 14)), excitation_force=rng.normal(size=(5, 1, 20)),
                drift_force=rng.normal(size=(5, 1, 3)), added_mass_infinity=rng.normal(size=(20, 14)),
                theta=np.arange(4.0))  # fmt: skip
    found = of_database(db)
    own = [*range(6), *range(12, 20)]
    assert np.array_equal(found.quantities["added_mass"], db["added_mass"][:, own])
    assert np.array_equal(found.quantities["excitation_force"], db["excitation_force"][:, :, own])
    assert np.array_equal(found.quantities["drift_force"], db["drift_force"])
    assert np.array_equal(found.limits["added_mass_infinity"], db["added_mass_infinity"][own])
    assert set(found.limits) == {"added_mass_infinity"} and set(found.quantities) == set(db.names[:3])
    assert np.array_equal(found.outline, db.mesh.points[:, :2]) and len(found.outlines) == 2
    assert np.array_equal(found.outlines[1], db.mesh.points[20:, :2]) and found.shapes == (1, 0)
    db.bodies, db.modes = (), (Mode("bow"), Mode("stern"))
    alone = of_database(db)
    assert alone.shapes == (0, 0) and alone.outlines == () and alone.quantities["added_mass"] is db["added_mass"]
    assert (alone.depth, alone.gravity, alone.wall) == (20.0, G, None)


def test_a_motion_of_a_ten_thousandth_of_its_kind_moves_no_water():
    """Forces 1, 1.05e-4 and 0.95e-4 of two bodies, moments of the largest of both; shapes have their own"""
    sizes = np.array([1.0, 1.05e-4, 0.95e-4, 2e3, 1.0, 1.0, 0.5, 1.0, 1.0, 2e4, 2.1, 1.9, 1e-9])
    found = Between._seen(SimpleNamespace(shapes=("one",)), sizes)
    lost = [2, 4, 5, 11]
    assert np.isinf(found[lost]).all() and np.delete(found, lost).tolist() == np.delete(sizes, lost).tolist()
