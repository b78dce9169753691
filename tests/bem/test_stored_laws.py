"""Laws between stored numbers: a made-up database that keeps them all, and each law broken by a known amount.

Waves that the body scatters are those of a cylinder on the bed, H = Σ c_m exp(im(θ − β)) with |c_m|² = −Re c_m; waves
that its motions send are cosines, whose energy is its damping.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from exact import maccamy_fuchs
from exact.water_waves import group_factor, wavenumber

from hakobune.bem.modes import Body
from hakobune.bem.stored_laws import broken_laws, damping_errors, worst_damping
from hakobune.meshing.shapes import box

RHO, G, DEPTH, RADIUS = 1025.0, 9.80665, 15.0, 6.0
OMEGA, BETA, THETA = np.array([0.5, 0.9]), np.array([0.0, 0.7]), np.arange(48) * np.pi / 24
CENTER = np.array([2.0, -1.0, 0.5])
SIZES = np.array([1.0, 0.9, 0.8, 6.0, 7.0, 5.0])  # of waves that motions send
TOLERANCE = 0.01


def waves_of_motions():
    """(6, t), per metre of wave number and motion"""
    order = np.array([1, 1, 0, 1, 1, 2])
    turn = np.array([0, -np.pi / 2, 0, -np.pi / 2, 0, -np.pi / 2])
    return SIZES[:, None] * np.cos(order[:, None] * THETA + turn[:, None])


def drift(order, series, beta, k, n):
    """Maruo and Newman, of Σ c_m exp(imθ); about CENTER"""
    forward, steep = (np.sum(c * np.exp(1j * order * beta)) for c in (series, 1j * order * series))
    both = 2 * np.pi * np.sum(series[:-1] * series[1:].conj())
    x, y = -2 * np.pi * np.cos(beta) * forward.real - both.real, -2 * np.pi * np.sin(beta) * forward.real - both.imag
    m = -2 * np.pi * steep.imag - 2 * np.pi * np.sum(order * np.abs(series) ** 2)
    x, y, m = RHO * G * n / (np.pi * k) * np.array([x, y, m / k])
    return [x, y, m - (CENTER[0] * y - CENTER[1] * x)]


class Made(SimpleNamespace):
    density, gravity, water_depth, rotation_center = RHO, G, DEPTH, CENTER
    omega, wave_direction, has_viscous_motions, mesh = OMEGA, BETA, False, box(20, 10, 4, panels=40)
    bodies, modes, structural_damping, has_damping_lids = (), (), None, False

    @property
    def names(self):
        return [name for name in self.values if name not in ("wavenumber", "theta")]

    @property
    def stiffness(self):
        return self.hydrostatic_stiffness

    def __getitem__(self, name):
        return self.values[name]

    def checks(self):
        return {"energy": self.stored, "residual": np.full(2, np.nan)}

    def estimated_errors(self):
        return self.errors


@pytest.fixture
def db():
    k = np.array([wavenumber(w, DEPTH) for w in OMEGA])
    n = np.array([group_factor(one, DEPTH) for one in k])
    H = 0.01 * waves_of_motions() * (1 + np.arange(2))[:, None, None] + 0j
    # B = 4ρg n/(k²ω) (1/2π) ∫ Hᵢ H̄ⱼ dθ; cosines have ½ in the mean, and 1 of order 0
    mean = np.einsum("nit,njt->nij", H, H.conj()).real / len(THETA)
    B = (4 * RHO * G * n / (k**2 * OMEGA))[:, None, None] * mean
    A = 2 * B + np.diag([1e5, 1e5, 1e5, 1e7, 1e7, 1e7])
    scattered = []
    for one in k:
        c = maccamy_fuchs.harmonics(one * RADIUS)
        m = np.arange(1, len(c))
        angle = THETA - BETA[:, None]
        scattered.append(c[0] + 2 * np.cos(angle[..., None] * m) @ c[1:])
    D = np.array(scattered)
    rng = np.random.default_rng(4)
    incident, diffracted = (1e4 * (rng.normal(size=(2, 2, 6)) + 1j * rng.normal(size=(2, 2, 6))) for _ in range(2))
    M, C = np.diag([1e6, 1e6, 1e6, 1e8, 1e8, 1e8]), np.diag([0, 0, 2e6, 1e8, 3e8, 0.0])
    F = incident + diffracted
    X = np.array([[np.linalg.solve(-(w**2) * (M + a) - 1j * w * b + C, f) for f in fs]
                  for w, a, b, fs in zip(OMEGA, A, B, F, strict=True)])  # fmt: skip
    order = np.arange(48) - 24
    forces = {}
    for name, total in (("drift_force_fixed", D), ("drift_force", D + np.einsum("nmj,njt->nmt", X, H))):
        series = np.stack([np.mean(total * np.exp(-1j * p * THETA), axis=-1) for p in order], axis=-1)
        series[..., 0] = 0.0
        forces[name] = np.array([[drift(order, series[i, m], BETA[m], k[i], n[i]) for m in (0, 1)] for i in (0, 1)])
    values = {
        "added_mass": A, "radiation_damping": B, "Froude_Krylov_force": incident, "diffraction_force": diffracted,
        "excitation_force": F, "rao": X, "kochin_radiation": H, "kochin_diffraction": D, "wavenumber": k,
        "theta": THETA, **forces,
    }  # fmt: skip
    return Made(values=values, stored=np.array([0.001, 0.002]), errors={}, attributes={}, inertia_matrix=M,
                hydrostatic_stiffness=C)  # fmt: skip


def laws(db, tolerance=TOLERANCE):
    return {one.law: one for one in broken_laws(db, tolerance)}


def test_numbers_that_keep_all_laws_break_none_of_them(db):
    assert broken_laws(db, 1e-9) == []


def changed(db, name, place, by):
    db.values[name] = np.array(db.values[name])
    db.values[name][place] += by
    return db


def test_added_mass_that_is_not_symmetric_breaks_reciprocity_by_its_share_of_both_motions(db):
    """|Z₁₅ − Z₅₁| over √|Z₁₁ Z₅₅|"""
    A, B = db["added_mass"][1], db["radiation_damping"][1]
    Z = A + 1j * B / OMEGA[1]
    size = np.sqrt(np.abs(Z[0, 0] * Z[4, 4]))
    found = laws(changed(db, "added_mass", (1, 0, 4), 0.02 * size))
    assert set(found) == {"reciprocity", "motions obey their equation"}
    assert found["reciprocity"].worst == pytest.approx(0.02) and found["reciprocity"].omega == 0.9
    assert found["reciprocity"].limit == pytest.approx(1.01 * TOLERANCE)
    assert "reciprocity" in laws(db, 0.0196) and "reciprocity" not in laws(db, 0.0200)


def test_what_was_stored_as_the_worst_check_is_allowed_at_its_frequency(db):
    db.stored[:] = 0.001, 0.03
    A, B = db["added_mass"], db["radiation_damping"]
    for i, breaks in ((0, True), (1, False)):
        size = np.sqrt(np.abs((A[i] + 1j * B[i] / OMEGA[i])[[0, 4], [0, 4]]).prod())
        one = Made(**(vars(db) | {"values": dict(db.values)}))
        assert ("reciprocity" in laws(changed(one, "added_mass", (i, 0, 4), 0.02 * size))) == breaks


def test_a_motion_that_is_a_hundred_thousandth_of_its_kind_is_not_held_to_reciprocity(db):
    """√|Z| of sway below 1e-4 of the largest of surge, sway and heave"""
    largest = np.sqrt(
        np.abs(db["added_mass"] + 1j * db["radiation_damping"] / OMEGA[:, None, None])[0].diagonal()[:3].max()
    )
    for share, breaks in ((0.8e-4, False), (1.2e-4, True)):
        one = Made(**(vars(db) | {"values": {n: np.array(db[n]) for n in ("added_mass", "radiation_damping")}}))
        for name in ("added_mass", "radiation_damping"):
            one.values[name][:, 1], one.values[name][:, :, 1] = 0.0, 0.0
        one.values["added_mass"][0, 1, 1] = (share * largest) ** 2
        one.values["added_mass"][0, 0, 1] = 0.5 * share * largest**2 * 0.1
        assert ("reciprocity" in laws(one)) == breaks


def test_negative_damping_gives_energy(db):
    """−B/ω over |Z| of its own motion"""
    B, A = db["radiation_damping"][0, 2, 2], db["added_mass"][0, 2, 2]
    size = abs(A - 1j * B / OMEGA[0])
    found = laws(changed(db, "radiation_damping", (0, 2, 2), -2 * B), 1e-6)
    assert found["damping takes energy out"].worst == pytest.approx(B / OMEGA[0] / size, rel=1e-6)
    assert found["radiated energy"].worst == pytest.approx(2 * B / OMEGA[0] / size, rel=1e-6)


def test_damping_that_is_not_the_energy_of_radiated_waves_breaks_that_law(db):
    A, B = db["added_mass"][1, 3, 3], db["radiation_damping"][1, 3, 3]
    db.stored[:] = 0.0
    found = laws(changed(db, "radiation_damping", (1, 3, 3), 0.1 * B), 1e-6)["radiated energy"]
    assert found.worst == pytest.approx(0.1 * B / 0.9 / abs(A + 1.1j * B / 0.9), rel=1e-6) and found.omega == 0.9


@pytest.mark.parametrize("mode, scale", [(1, slice(0, 3)), (4, slice(3, 6))])
def test_forces_add_up_relative_to_the_largest_force_or_moment_of_the_frequency(db, mode, scale):
    largest = max(np.abs(db[name][0, :, scale]).max() for name in ("excitation_force", "Froude_Krylov_force"))
    for share, breaks in ((0.9e-6, False), (1.2e-6, True)):
        one = Made(**(vars(db) | {"values": {n: db[n] for n in db.names if n.endswith("force") and "drift" not in n}}))
        found = laws(changed(one, "diffraction_force", (0, 1, mode), 1j * share * largest))
        assert ("excitation is incident and scattered" in found) == breaks
    assert found["excitation is incident and scattered"].worst == pytest.approx(1.2e-6, rel=1e-5)
    one.attributes["imported"] = "WAMIT"
    assert not laws(one) and laws(changed(one, "diffraction_force", (0, 1, mode), 1.2e-4 * largest))


@pytest.mark.parametrize("mode, scale", [(1, slice(0, 3)), (4, slice(3, 6))])
def test_motions_that_do_not_obey_their_equation_are_relative_to_the_largest_of_their_kind(db, mode, scale):
    """Of each heading's frequency"""
    largest = np.abs(db["rao"][1][:, scale]).max()
    for share, breaks in ((0.8e-6, False), (1.2e-6, True)):
        one = Made(**(vars(db) | {"values": dict(db.values)}))
        found = laws(changed(one, "rao", (1, 0, mode), share * largest))
        assert ("motions obey their equation" in found) == breaks
    one.has_viscous_motions = True  # these obey another one
    assert "motions obey their equation" not in laws(one)
    one.has_viscous_motions, one.inertia_matrix = False, None  # as of a program that writes motions and no mass
    assert "motions obey their equation" not in laws(one)


def test_beside_damping_lids_waves_may_carry_less_than_all_and_never_more(db):
    """Half of B in roll taken by a lid breaks nothing; B a tenth below that of the waves does, by that tenth"""
    db.has_damping_lids, B, db.stored[:] = True, db["radiation_damping"][1, 3, 3], 0.0
    size = abs(db["added_mass"][1, 3, 3] + 0.9j * B / 0.9)
    less, more = (laws(changed(db, "radiation_damping", (1, 3, 3), change), 1e-6) for change in (-0.1 * B, B))
    law = "radiated energy, less than all"
    assert law not in more
    assert less[law].worst == pytest.approx(0.1 * B / 0.9 / size, rel=1e-6)
    H = np.array(db["kochin_diffraction"])
    for factor, breaks in ((0.9, False), (1.1, True)):
        db.values["kochin_diffraction"] = factor * H
        assert ("scattered energy, less than all" in laws(db)) == breaks


def test_scattered_waves_that_are_too_strong_break_energy(db):
    """H (1 + ε): ((1 + ε)² − (1 + ε)) (1/2π)∫|H|² over the largest |H|"""
    H = db["kochin_diffraction"][1]
    power = np.mean(np.abs(H[0]) ** 2)
    assert power == pytest.approx(np.mean(np.abs(H[1]) ** 2))
    db.values["kochin_diffraction"] = np.array(db["kochin_diffraction"])
    db.values["kochin_diffraction"][1] *= 1.1
    sizes = [max(1.1 * np.abs(H[m]).max(), 1.21 * power, 1.1 * np.abs(H[0, 0])) for m in (0, 1)]
    assert laws(db)["scattered energy"].worst == pytest.approx(1.1 * 0.1 * power / min(sizes), rel=1e-6)


@pytest.mark.parametrize("name, law", [("drift_force_fixed", "drift of the fixed body"),
                                       ("drift_force", "drift of the free body")])  # fmt: skip
def test_drift_is_relative_to_the_largest_force_and_a_moment_to_that_at_a_wavenumber(db, name, law):
    stored, k = db[name][0], db["wavenumber"][0]
    n = group_factor(k, DEPTH)
    H = db["kochin_diffraction"][0]
    if name == "drift_force":
        H = H + db["rao"][0] @ db["kochin_radiation"][0]
    level = RHO * G * n * np.max(np.mean(np.abs(H) ** 2, axis=-1)) / k
    push = max(np.abs(stored[:, :2]).max(), level)
    moment = max(np.abs(stored[:, 2]).max(), push / k)
    for component, size in ((0, push), (1, push), (2, moment)):
        one = Made(**(vars(db) | {"values": dict(db.values)}))
        found = laws(changed(one, name, (0, 1, component), 0.03 * size))
        assert set(found) == {law}
        if size > np.abs(stored[:, component]).max() * 1.1:  # else the size has grown with it
            assert found[law].worst == pytest.approx(0.03, rel=1e-6)
        assert law not in laws(changed(one, name, (0, 1, component), -0.021 * size))


def test_a_doubled_number_anywhere_breaks_a_law(db):
    for name in db.names:
        one = Made(**(vars(db) | {"values": dict(db.values)}))
        one.values[name] = 2 * np.array(db[name])
        assert laws(one), name


def test_errors_of_damping_are_told_by_its_own_size(db):
    """√(bᵢ bⱼ) of b the damping, or that which dies out in 1000 periods, ωA/1000π"""
    assert np.isnan(damping_errors(db)).all()
    error = np.zeros((2, 6, 6))
    error[0, 2, 3], error[1, 4, 4] = 3.0, 5.0
    db.errors["radiation_damping"] = error
    b = np.maximum(db["radiation_damping"], OMEGA[:, None, None] * db["added_mass"] / (1000 * np.pi))
    expected = [3.0 / np.sqrt(b[0, 2, 2] * b[0, 3, 3]), 5.0 / b[1, 4, 4]]
    assert damping_errors(db) == pytest.approx(expected)
    assert worst_damping(db) == (("Heave", "Roll"), ("Pitch", "Pitch"))[int(np.argmax(expected))]
    error[0] = np.nan
    assert worst_damping(db) == ("Pitch", "Pitch")
    assert np.isnan(damping_errors(db)[0]) and damping_errors(db)[1] == pytest.approx(expected[1])


@pytest.mark.parametrize("fixed", ["_fixed", ""])
def test_drifts_of_bodies_add_up_to_a_tenth_of_the_largest_force_and_beside_damping_lids_need_not(db, fixed):
    """The first along the axes, the second turned by 90°: its (x, y) is (−y, x); the largest is 40 kN"""
    first, second = np.array([[3e4, 1e4, 5e6], [1e4, 0.0, 0.0]]), np.array([[-1e4, 2e4, 7e6], [4e4, 2e4, 1e6]])
    each = np.stack([first, second], axis=1)
    whole = np.stack([first[:, 0] - second[:, 1], first[:, 1] + second[:, 0], [9e9, 9e9]], axis=-1)
    for off, breaks in ((0.098, False), (0.102, True), (-0.102, True)):
        missed = whole.copy()
        missed[0, 1] += 4e4 * off
        values = {f"body_drift_force{fixed}": np.stack([each, 0.5 * each]),
                  f"drift_force{fixed}": np.stack([missed, 0.5 * whole])}  # fmt: skip
        pair = (Body("one"), Body("two", heading=np.pi / 2))
        one = Made(**(vars(db) | {"values": values, "bodies": pair}))
        law = f"drift_force{fixed} is the sum over the bodies"
        found = laws(one)
        assert set(found) == ({law} if breaks else set())
        if breaks:
            assert (found[law].worst, found[law].omega, found[law].limit) == (
                pytest.approx(0.102), OMEGA[0], pytest.approx(0.1))  # fmt: skip
            one.has_damping_lids = True
            assert not laws(one)


@pytest.mark.parametrize("share, counts", [(1.05e-4, True), (0.95e-4, False)])
def test_motions_that_move_no_water_break_no_law(share, counts):
    """√|Z_ii| up to 1e-4 of the largest of their kind; sway beside surge, yaw beside pitch"""
    from hakobune.bem.stored_laws import _radiation_laws

    for i, j, own in ((1, 0, share), (5, 4, share)):
        A = np.tile(np.diag([4.0, own**2 * 4, 1, 900, 2500, 900]), (2, 1, 1))
        if i == 5:
            A[:, [1, 5], [1, 5]] = [4.0, own**2 * 2500]
        A[1, i, j] = 0.3 * np.sqrt(A[1, i, i] * A[1, j, j])
        one = Made(values={"added_mass": A, "radiation_damping": 0 * A})
        (name, defect, _), (energy, taken, _) = _radiation_laws(one, {"added_mass", "radiation_damping"})
        assert (name, energy) == ("reciprocity", "damping takes energy out")
        assert defect == pytest.approx([0.0, 0.3 * counts]) and taken == pytest.approx([0.0, 0.0])


def test_damping_that_gives_energy_is_told_by_its_lowest_eigenvalue():
    """Of B/ω over √|Z_ii Z_jj|, its even part: [[1, 2], [2, 1]] of two motions gives −1"""
    from hakobune.bem.stored_laws import _radiation_laws

    B = np.tile(np.eye(6), (2, 1, 1)) * OMEGA[:, None, None]
    B[1, 0, 1], B[1, 1, 0] = 3 * OMEGA[1], 1 * OMEGA[1]
    one = Made(values={"added_mass": 0 * B, "radiation_damping": B})
    (_, defect, _), (_, given, _) = _radiation_laws(one, {"added_mass", "radiation_damping"})
    assert given == pytest.approx([-1.0, 1.0]) and defect == pytest.approx([0.0, 2.0])


def test_motions_of_which_a_part_is_not_known_are_not_judged(db):
    """NaN at that frequency; the other is judged"""
    from hakobune.bem.stored_laws import _motion_defect

    changed(db, "rao", (1, 0, 2), 0.2)
    off = _motion_defect(db)
    assert off[0] < 1e-9 < off[1]
    for name in ("added_mass", "radiation_damping", "excitation_force", "rao"):
        spoiled = Made(**vars(db) | {"values": dict(db.values)})
        changed(spoiled, name, (0, 0, 0), np.nan)
        found = _motion_defect(spoiled)
        assert np.isnan(found[0]) and found[1] == pytest.approx(off[1])


@pytest.mark.parametrize("name, law", [("drift_force_fixed", "drift of the fixed body"),
                                       ("drift_force", "drift of the free body")])  # fmt: skip
def test_a_moment_that_is_not_stored_at_all_is_relative_to_a_force_at_one_wavenumber(db, name, law):
    stored, k = np.array(db[name]), db["wavenumber"]
    db.values[name] = stored * [1, 1, 0]
    lost = np.zeros(2)
    for i in (0, 1):
        H = db["kochin_diffraction"][i]
        if name == "drift_force":
            H = H + db["rao"][i] @ db["kochin_radiation"][i]
        level = RHO * G * group_factor(k[i], DEPTH) * np.max(np.mean(np.abs(H) ** 2, axis=-1)) / k[i]
        push = max(np.abs(stored[i, :, :2]).max(), level)
        lost[i] = np.abs(stored[i, :, 2]).max() * k[i] / push
    assert laws(db, 1e-6)[law].worst == pytest.approx(lost.max(), rel=1e-6)


@pytest.mark.parametrize("imported, share, breaks", [
    (True, 1.05e-4, True), (True, 0.95e-4, False), (False, 1.05e-6, True), (False, 0.95e-6, False),
])  # fmt: skip
def test_numbers_of_other_programs_are_held_to_the_digits_that_are_printed(db, imported, share, breaks):
    """Excitation is incident and scattered to a millionth, of files to a ten thousandth"""
    if imported:
        db.attributes["imported"] = "WAMIT"
    largest = max(np.abs(db[name][0, :, :3]).max() for name in ("excitation_force", "Froude_Krylov_force"))
    spoiled = {name: np.array(one) for name, one in db.values.items()}
    spoiled["diffraction_force"][0, 0, 0] += share * largest
    one = Made(**(vars(db) | {"values": spoiled}))
    assert ("excitation is incident and scattered" in laws(one)) is breaks
