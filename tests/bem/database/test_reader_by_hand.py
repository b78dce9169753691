"""A reader of made-up numbers, whose answers in stored waves and between are known, and what it refuses."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from exact.water_waves import group_factor, wavenumber
from scipy.linalg import eigh

from hakobune.bem.database import far_field_drift
from hakobune.bem.database.between_frequencies import Between, BetweenError
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.bem.database.reader import Reader, _check_rows
from hakobune.bem.viscous import Quadratic, Viscous

OMEGA, HEADINGS = np.linspace(0.4, 1.2, 5), np.array([0.0, 0.5])
THETA = np.arange(16) * np.pi / 8
RHO, G, DEPTH = 1000.0, 9.81, 20.0
M = np.diag([4.0, 4, 4, 100, 200, 300.0]) * 1e5
C = np.diag([0, 0, 6.0, 60, 90, 0]) * 1e5


def coefficients():
    A = np.array([np.diag([1, 1, 2.0 - w, 10, 20, 30]) for w in OMEGA]) * 1e5
    B = np.array([np.diag([1, 1, w, 10, 20, 30]) for w in OMEGA]) * 1e4
    return A, B


def made(**more):
    A, B = coefficients()
    F = (1e4 + 2e4j) * np.arange(1, 61.0).reshape(5, 2, 6)
    quantities = {"added_mass": A, "radiation_damping": B, "excitation_force": F} | more.pop("quantities", {})
    outline = np.array([[-10.0, -4], [10, -4], [10, 4], [-10, 4]])
    between = Between(OMEGA, quantities, DEPTH, G, HEADINGS, THETA, outline, more.pop("limits", {}))
    return Reader(between, RHO, np.zeros(3), more.pop("inertia", M), more.pop("stiffness", C), np.zeros((6, 6)), **more)


def test_motions_obey_their_equation_with_the_damping_and_stiffness_that_are_added():
    extra_B, extra_C = np.diag([5, 0, 7.0, 0, 0, 9]) * 1e4, np.diag([3.0, 2, 0, 0, 0, 40]) * 1e5
    held = made().restrained(extra_B, extra_C).restrained(damping=extra_B)
    A, B = coefficients()
    F = made().between.quantities["excitation_force"]
    for i, w in enumerate(OMEGA):
        Z = -(w**2) * (M + A[i]) - 1j * w * (B[i] + 2 * extra_B) + C + extra_C
        assert held.motions(OMEGA[i : i + 1])[0] == pytest.approx(np.linalg.solve(Z, F[i].T).T)
    assert not held.own and made().restrained().own and made().restrained(stiffness=np.zeros((6, 6))).own
    assert held.dynamic_stiffness(OMEGA[:1], A[:1], B[:1])[0] == pytest.approx(
        -(0.16) * (M + A[0]) - 0.4j * (B[0] + 2 * extra_B) + C + extra_C
    )


def test_stored_motions_are_those_of_the_body_alone():
    X = np.ones((5, 2, 6), complex)
    body = made(quantities={"rao": X})
    assert np.array_equal(body.motions(OMEGA), X)
    assert np.abs(body.restrained(stiffness=np.eye(6)).motions(OMEGA) - 1).min() > 1e-3
    mixed = body.motions(np.array([0.4, 0.5]))
    assert np.array_equal(mixed[0], X[0]) and np.abs(mixed[1] - 1).min() > 1e-3
    towards = body.motions(OMEGA[:2], np.array([0.5, 0.0]))
    assert np.array_equal(towards, X[:2])


def test_critical_damping_is_that_of_the_motion_at_its_own_frequency():
    """2 √(C (M + A)) with ω² (M + A) = C: heave of A = 2 − ω, (6 − ω) ω² = 6 in 1e5 kg"""
    roots = np.roots([-1.0, 6.0, 0.0, -6.0])
    w = float(min(r.real for r in roots if r.real > 0 and abs(r.imag) < 1e-12))
    assert made().critical_damping(2) == pytest.approx(2 * 6e5 / w, rel=2e-4)  # of a fit to five frequencies
    with pytest.raises(
        ValueError,
        match="surge has no restoring force, so its critical damping is not defined; give its damping in N s/m",
    ):
        made().critical_damping(0)


def test_added_mass_is_held_at_the_ends_of_what_is_known():
    A, _ = coefficients()
    assert made().held_added_mass([0.1, 3.0]) == pytest.approx(A[[0, -1]])
    assert made().knows_added_mass([0.1, 0.4, 1.2, 1.3]).tolist() == [False, True, True, False]
    both = made(limits={"added_mass_zero": 2 * A[0], "added_mass_infinity": 0.5 * A[-1]})
    assert both.knows_added_mass([0.0, 0.1, 50.0]).all()
    assert both.held_added_mass([0.2])[0] == pytest.approx(A[0] * (2 - 0.25))
    assert both.held_added_mass([2.4])[0] == pytest.approx(A[-1] * (0.5 + 0.125))


def test_haskinds_relation_gives_the_force_from_the_waves_sent_back():
    """−4i ρg n/k² H(β + π)"""
    order = np.array([1, -2, 0, 2, 1, -1])
    H = np.exp(1j * order[:, None] * THETA) * np.arange(1, 7)[:, None] * (1 + 0.5j)
    body = made(quantities={"kochin_radiation": np.tile(H, (5, 1, 1))})
    found = body.of_haskind(OMEGA[[1]], np.array([0.3, 2.0]))[0]
    k = wavenumber(0.6, DEPTH, G)
    for p, beta in enumerate((0.3, 2.0)):
        ahead = np.exp(1j * order * (beta + np.pi)) * np.arange(1, 7) * (1 + 0.5j)
        assert found[p] == pytest.approx(-4j * RHO * G * group_factor(k, DEPTH) / k**2 * ahead)


def test_the_body_without_its_drift_keeps_its_motions():
    zero = np.zeros((5, 2, 3))
    body = made(quantities={"drift_force": zero, "drift_force_fixed": zero, "kochin_diffraction": np.zeros((5, 2, 16))})
    assert body.knows_drift and not body.without_drift().knows_drift
    assert set(body.without_drift().between.quantities) == {"added_mass", "radiation_damping", "excitation_force"}
    assert made().radius == pytest.approx(np.hypot(10, 4))


def test_drift_that_does_not_change_with_frequency_is_the_same_between_in_the_order_that_is_asked():
    """Without Kochin functions, from which it would be rebuilt"""
    D = np.tile(np.arange(1, 7.0).reshape(2, 3) * 1e3, (5, 1, 1))
    for name, fixed in (("drift_force", False), ("drift_force_fixed", True)):
        body = made(quantities={name: D})
        assert body.drift([0.5], fixed=fixed)[0] == pytest.approx(D[0], rel=1e-3)
        assert body.drift([0.5], HEADINGS[::-1], fixed=fixed)[0] == pytest.approx(D[0, ::-1], rel=1e-3)


@pytest.mark.parametrize(
    "ask, words",
    [
        (lambda: made(inertia=None).motions([0.5]), "if its files were imported, give it by `hakobune body`"),
        (lambda: made(stiffness=None).floating(), "the database has no inertia of the body"),
        (lambda: natural_periods(made(inertia=None)), "natural periods need the inertia of the body; give --gyration"),
        (lambda: natural_periods(made(stiffness=None)), "natural periods need the inertia of the body; give --gyr"),
        (lambda: made().restrained(damping=np.inf * np.ones((6, 6))), r"damping matrix .* allowed: \(6, 6\), finite"),
        (lambda: made().at(0.5, "pressure", [0.0]), "pressure is available at stored headings only"),
        (lambda: made().drift([0.5]), "kochin_radiation, kochin_diffraction must be stored for drift_force"),
        (lambda: made(quantities={"drift_force": np.zeros((5, 2, 3))}).restrained(stiffness=np.eye(6)).drift([0.5]),
         "drift of a body with added damping or stiffness is computed from Kochin functions, which the database"),
        (lambda: made().at(0.5, "drift_force_fixed"), "drift_force_fixed is not stored and cannot be computed"),
    ],
)  # fmt: skip
def test_what_is_not_known_is_named_with_the_way_out(ask, words):
    with pytest.raises(ValueError, match=words):
        ask()


def test_what_was_solved_for_some_motions_alone_is_no_basis_for_all():
    A, _ = coefficients()
    A[:, 5, 5] = np.nan
    body = made(quantities={"added_mass": A})
    for ask in (body.floating, lambda: body.motions([0.4])):
        with pytest.raises(BetweenError, match="added_mass is not stored for all motions; solve again for all motions"):
            ask()
    less = {name: value for name, value in made().between.quantities.items() if name != "excitation_force"}
    body = made()
    with pytest.raises(BetweenError, match="excitation_force must be stored for motions"):
        replace(body, between=replace(body.between, quantities=less)).floating()


def test_what_the_far_field_misses_is_straight_between_stored_frequencies():
    """And held at the ends; 0 where the drift of the fixed body is not stored"""
    missed = np.cumsum(np.arange(30.0)).reshape(5, 2, 3)
    body = SimpleNamespace(
        omega=OMEGA, missed_drift=missed, between=SimpleNamespace(quantities={"drift_force_fixed": missed})
    )
    at = np.array([0.4, 0.45, 0.75, 1.2])
    expected = [[[np.interp(w, OMEGA, missed[:, j, c]) for c in range(3)] for j in (0, 1)] for w in at]
    assert far_field_drift._amiss(body, at, None) == pytest.approx(np.array(expected))
    one = SimpleNamespace(omega=OMEGA[:1], missed_drift=missed[:1], between=body.between)
    assert far_field_drift._amiss(one, OMEGA[:1], None) == pytest.approx(missed[:1])
    body.between.quantities = {}
    assert far_field_drift._amiss(body, at, None) == 0.0


def series_of(theta, several):
    return np.array([[sum(c * np.exp(1j * m * theta) for m, c in one.items()) for one in row] for row in several])


@pytest.mark.parametrize("damped", [False, True])
def test_drift_of_a_damped_body_counts_the_power_that_it_takes(damped):
    """Re H(β) from energy, −(1/2π)∫|H|² − kP/(2ρgC_g), P = ½ω² X* B′ X; the slope ahead from the series"""
    w, beta = 0.7, 0.5
    k = wavenumber(w, DEPTH, G)
    n = group_factor(k, DEPTH)
    scattered = {-1: 0.2 - 0.1j, 0: -0.3, 2: 0.1j}
    radiated = [{1: 0.02 * (i + 1), -2: 0.01j} for i in range(6)]
    X = np.array([0.5, 0.2j, -0.4, 0.1, 0.0, 0.3])
    H, R = series_of(THETA, [[scattered]]), series_of(THETA, [radiated])
    damping = 3e4 * np.diag([1.0, 2, 3, 0, 0, 5]) * damped
    body = replace(made(), damping=damping, rotation_center=np.array([3.0, -2.0, 0]))
    found = far_field_drift.of_far_field(body, np.array([w]), np.array([beta]), R, H, X[None, None])[0, 0]
    total = dict(scattered)
    for x, one in zip(X, radiated, strict=True):
        for m, c in one.items():
            total[m] = total.get(m, 0) + x * c
    power = 0.5 * w**2 * (X.conj() @ damping @ X).real
    forward = -sum(abs(c) ** 2 for c in total.values()) - k * power / (2 * RHO * G * n * w / k)
    both = 2 * np.pi * sum(c * np.conj(total.get(m + 1, 0)) for m, c in total.items())
    steep = sum(1j * m * c * np.exp(1j * m * beta) for m, c in total.items())
    x = -2 * np.pi * np.cos(beta) * forward - both.real
    y = -2 * np.pi * np.sin(beta) * forward - both.imag
    m = -2 * np.pi * steep.imag - 2 * np.pi * sum(m * abs(c) ** 2 for m, c in total.items())
    x, y, m = RHO * G * n / (np.pi * k) * np.array([x, y, m / k])
    assert found == pytest.approx([x, y, m - (3.0 * y + 2.0 * x)])


def test_damping_that_grows_with_the_motion_takes_power_by_its_amplitude_in_the_wave():
    """N = (8/3π) ω a N₂ of a = 1.5 m times |X|, for waves of 1.5 m"""
    law = Viscous({"Heave": Quadratic(2e4)}, 1.5)
    body = replace(made(), viscous=law, damping=np.diag([1e3] * 6))
    X = np.array([[[0, 0, 0.4 + 0.3j, 0, 0, 0.1]]])
    expected = 0.5 * 0.49 * (1e3 * (0.25 + 0.01) + 8 / (3 * np.pi) * 0.7 * 1.5 * 0.5 * 2e4 * 0.25)
    assert far_field_drift._absorbed(body, np.array([0.7]), X)[0, 0] == pytest.approx(expected)


def test_drift_is_known_where_it_is_stored_or_follows_from_the_far_field():
    zero, radiated = np.zeros((5, 2, 3)), np.zeros((5, 6, 16))
    both = {"kochin_radiation": radiated, "kochin_diffraction": np.zeros((5, 2, 16))}
    for quantities, known, rebuilt in (
        ({}, False, False), ({"drift_force": zero}, True, False), (both, True, True),
        ({"kochin_radiation": radiated}, False, False), (both | {"drift_force": zero}, True, True),
        ({"drift_force_fixed": zero}, False, False),
    ):  # fmt: skip
        body = made(quantities=quantities)
        assert (body.knows_drift, body.rebuilds_drift) == (known, rebuilt)


def test_periods_are_infinite_without_restoring_and_none_where_the_body_turns_over():
    """Roll of −C grows; a frequency below a millionth of the largest, also of a growth, is none"""
    same = {"added_mass": np.tile(np.diag([1, 1, 1, 10, 20, 30]) * 1e5, (5, 1, 1))}
    for roll, surge, infinite in ((-60.0, 2.0e-11, False), (-60.0e6, 6.0e-7, True), (-60.0e6, 9.0e-6, False)):
        found = natural_periods(made(quantities=same, stiffness=np.diag([surge, 0, 6.0, roll, 90, 0]) * 1e5))
        period = dict(zip(found.names, found.period, strict=True))
        assert np.isnan(period["Roll"]) and np.isinf(period["Sway"]) and np.isinf(period["Yaw"])
        assert period["Heave"] == pytest.approx(2 * np.pi / np.sqrt(6 / 5), rel=1e-4)
        assert period["Pitch"] == pytest.approx(2 * np.pi / np.sqrt(90 / 220), rel=1e-4)
        own = 2 * np.pi / np.sqrt(surge / 5)
        assert np.isinf(period["Surge"]) if infinite else period["Surge"] == pytest.approx(own, rel=1e-3)
        assert found.scale == pytest.approx(np.sqrt(300 / 4))


@pytest.mark.parametrize("is_round, kochin, others", [
    (True, True, True), (False, True, False), (True, False, False), (False, False, False),
])  # fmt: skip
def test_drift_of_a_round_hull_follows_from_waves_of_other_headings_where_the_far_field_is_stored(
    is_round, kochin, others
):
    both = {"kochin_radiation": np.zeros((5, 6, 16)), "kochin_diffraction": np.zeros((5, 2, 16))} if kochin else {}
    body = made(quantities=both, is_round=is_round)
    assert body._moving_ring.from_others is others and body.ring.from_others is others
    assert body.ring.is_round is is_round
    assert not body._moving_ring.is_round  # its inertia is not that of a body of revolution
    turned = np.diag([4.0, 4, 4, 100, 100, 300]) * 1e5
    same = replace(body, inertia=turned, stiffness=np.diag([0, 0, 6.0, 60, 60, 0]) * 1e5)
    assert same._moving_ring.is_round is is_round
    assert not replace(same, damping=np.diag([1.0, 0, 0, 0, 0, 0]))._moving_ring.is_round
    assert not replace(same, rotation_center=np.array([0.1, 0, 0]))._moving_ring.is_round


def test_the_drift_of_each_body_is_interpolated_at_its_headings_or_those_that_are_stored():
    """Shape (q, p, bodies, 3); what is the same at every heading stays the same at others"""
    D = np.tile(np.arange(1.0, 7).reshape(2, 3) * 1e3, (5, 4, 1, 1))
    body = made(quantities={"body_drift_force": D, "body_drift_force_fixed": 2 * D})
    body = replace(body, between=replace(body.between, headings=np.array([0.0, 0.5, 0.9, 1.4])))
    for fixed, times in ((False, 1), (True, 2)):
        assert body.drift_of_each([0.4, 0.5], fixed=fixed) == pytest.approx(times * D[:2], rel=1e-3)
        asked = body.drift_of_each([0.4], np.array([0.5, 1.4, 0.0]), fixed=fixed)
        assert asked == pytest.approx(times * D[:1, :3]) and asked.shape == (1, 3, 2, 3)
    with pytest.raises(BetweenError, match="body_drift_force is not stored; repeat the command that made the database"):
        made().drift_of_each([0.4])


@pytest.mark.parametrize("name", ["added_mass", "radiation_damping", "excitation_force"])
def test_numbers_that_some_frequencies_lack_are_told_and_those_that_all_lack_are_not(name):
    """Whichever quantity it is of: interpolation would know nothing anywhere"""
    db = SimpleNamespace(path="a.h5", omega=OMEGA)
    whole = dict(zip(("added_mass", "radiation_damping"), coefficients(), strict=True))
    whole["excitation_force"] = np.ones((5, 2, 6), complex)
    _check_rows(db, whole)
    for rows, refused in (
        ([1], r"1 of 5 frequencies, the first at ω = 0\.6"),
        ([2, 4], r"2 of 5 frequencies, the first at ω = 0\.8"),
        (range(5), None),
    ):
        spoiled = whole | {name: whole[name].copy()}
        spoiled[name][list(rows), 0, 0] = np.nan
        if refused:
            with pytest.raises(BetweenError, match=rf"a\.h5: {name} is not a number at {refused} rad/s;"):
                _check_rows(db, spoiled)
        else:
            _check_rows(db, spoiled)
    _check_rows(db, {})


def test_what_the_far_field_misses_is_its_drift_of_the_fixed_body_less_the_stored_one(monkeypatch):
    """At the stored waves; the waves of the body as they are, without its motions"""
    stored, heard = np.arange(30.0).reshape(5, 2, 3), []
    both = {"kochin_radiation": np.ones((5, 6, 16)), "kochin_diffraction": 2 * np.ones((5, 2, 16))}
    body = made(quantities=both | {"drift_force_fixed": stored})

    def of_far_field(reader, omega, headings, radiated, H, X):
        heard.append((reader, omega, headings, X))
        assert radiated == pytest.approx(both["kochin_radiation"]) and pytest.approx(both["kochin_diffraction"]) == H
        return 3 * stored

    monkeypatch.setattr(far_field_drift, "of_far_field", of_far_field)
    assert far_field_drift.missed(body) == pytest.approx(2 * stored)
    ((reader, omega, headings, X),) = heard
    assert reader is body and headings is None and X is None and np.array_equal(omega, OMEGA)


def test_added_mass_that_had_to_be_held_marks_the_period():
    """Heave at 1.1 rad/s in a band up to 1.2 rad/s is known; pitch at 0.64 rad/s too, roll at 0.1 rad/s is not"""
    same = {"added_mass": np.tile(np.diag([1, 1, 1, 10, 20, 30]) * 1e5, (5, 1, 1))}
    found = natural_periods(made(quantities=same, stiffness=np.diag([0, 0, 6.0, 1.1, 90, 0]) * 1e5))
    inside = dict(zip(found.names, found.inside, strict=True))
    assert inside["Heave"] and inside["Pitch"] and not inside["Roll"] and not inside["Surge"]
    limits = {"added_mass_zero": same["added_mass"][0]}
    found = natural_periods(made(quantities=same, stiffness=np.diag([0, 0, 6.0, 1.1, 90, 0]) * 1e5, limits=limits))
    inside = dict(zip(found.names, found.inside, strict=True))
    assert inside["Roll"] and inside["Surge"]
    period = dict(zip(found.names, found.period, strict=True))
    assert period["Roll"] == pytest.approx(2 * np.pi / 0.1, rel=1e-4)


def test_modes_alone_are_those_of_each_motion_and_coupled_ones_share_their_energy():
    """Surge and pitch coupled by 0.3 of both masses: ω² of [[4, c], [c, 2]] and [[1, 0], [0, 1]]; shapes with a largest
    component of 1 after rotations times √(I₆₆/M₁₁)"""
    same = {"added_mass": np.zeros((5, 6, 6)), "radiation_damping": np.zeros((5, 6, 6))}
    coupled = M.copy()
    coupled[0, 4] = coupled[4, 0] = 0.3 * np.sqrt(4 * 200) * 1e5
    C = np.diag([2.0, 0, 6.0, 60, 200, 0]) * 1e5
    body = made(quantities=same, inertia=coupled, stiffness=C)
    alone, both = natural_periods(body, coupled=False), natural_periods(body)
    assert dict(zip(alone.names, alone.period, strict=True))["Surge"] == pytest.approx(2 * np.pi / np.sqrt(0.5))
    assert dict(zip(alone.names, alone.period, strict=True))["Pitch"] == pytest.approx(2 * np.pi)
    assert np.array_equal(alone.shapes[[0, 4]], np.eye(6)[[0, 4]])
    pair = np.ix_([0, 4], [0, 4])
    squares, vectors = eigh(C[pair], coupled[pair])
    scale = np.sqrt(300 / 4)
    assert both.scale == pytest.approx(scale)
    found = dict(zip(both.names, zip(both.period, both.shapes, strict=True), strict=True))
    for name, number in (("Surge", 0), ("Pitch", 1)):
        period, shape = found[name]
        expected = vectors[:, number] * [1.0, scale]
        assert period == pytest.approx(2 * np.pi / np.sqrt(squares[number]))
        assert shape[[0, 4]] == pytest.approx(expected / expected[np.abs(expected).argmax()])
        assert np.abs(shape[[1, 2, 3, 5]]).max() < 1e-9


def test_forces_between_headings_follow_from_stored_ones_where_the_far_field_of_a_motion_is_unknown():
    radiated = np.ones((5, 6, 16), complex)
    radiated[:, 5] = np.nan
    unknown, without = made(quantities={"kochin_radiation": radiated}), made()
    asked = OMEGA[:2], np.array([0.2, 0.5])
    assert unknown.forces(*asked) == pytest.approx(without.forces(*asked))
    assert np.isfinite(unknown.forces(*asked)).all()
