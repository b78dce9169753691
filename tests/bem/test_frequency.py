"""Quantities of one frequency from what a method gives, by hand: transforms, errors, drift, what is asked for."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import DOFS, ESTIMATE, INTERPOLATED
from hakobune.bem.checks import check, damping_error, radiated_energy, scattered_energy, share_left
from hakobune.bem.free_body import free_body, motions, needed
from hakobune.bem.frequency import FrequencyRun, solve_frequency
from hakobune.bem.kochin import angles, folded
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.problem import Problem
from hakobune.bem.viscous import Quadratic, Viscous
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

OMEGA, DEPTH, RHO, G = 0.8, 15.0, 1025.0, 9.80665
CENTER = (2.0, -1.0, 0.5)
ALL = {"added_mass", "radiation_damping", "Froude_Krylov_force", "diffraction_force", "excitation_force", "rao",
       "kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force"}  # fmt: skip
T = np.eye(6)
T[3:, :3] = np.cross(np.eye(3), np.array(CENTER)).T  # M′ = M − c × F


class Made(FrequencyRun):
    """Random numbers in place of a method"""

    solves, residual = True, 1e-9

    def __init__(self, want=ALL, dofs=DOFS, errors=0.01, **more):
        rng = np.random.default_rng(5)
        M, C = 1e5 * np.diag([1, 1, 1, 30, 40, 50.0]), 1e5 * np.diag([0, 0, 2, 30, 50, 0.0])
        problem = Problem(depth=DEPTH, rotation_center=CENTER, inertia_matrix=M, hydrostatic_stiffness=C)
        prepared = SimpleNamespace(problem=problem, radius=6.0, displacing=np.ones(6, bool))
        super().__init__(prepared, OMEGA, [0.3, 1.2], want, np.arange(16) * np.pi / 8, dofs)
        Z = rng.normal(size=(6, 6, 2)) @ [1e4, 3e3j]
        self.radiation = Z + Z.T + 5e5 * np.eye(6) * (1 + 0.3j)
        self.froude_krylov, self.diffraction = (rng.normal(size=(2, 6, 2)) @ [1e4, 1e4j] for _ in range(2))
        t = 16 + 2
        self.kochin = [rng.normal(size=(2, n, t, 2)) @ [0.1, 0.1j] for n in (6, 2)]
        self.haskind = self.excitation + 50.0
        self.differences = errors * self.radiation, errors * (1 + 1j) * self.diffraction
        self.kochin_errors = [0.02 * H for H in self.kochin]
        vars(self).update(more)


def moved(Z):
    return T @ Z @ T.T


def test_quantities_are_those_about_the_origin_taken_to_the_rotation_centre():
    """A′ = T A Tᵀ, F′ = T F, moments less r × F; B = ω Im"""
    run, out = Made(), Made().result()
    arm = np.cross(np.array(CENTER), run.excitation[:, :3])
    assert out["excitation_force"][:, 3:] == pytest.approx(run.excitation[:, 3:] - arm)
    assert out["excitation_force"] == pytest.approx(out["Froude_Krylov_force"] + out["diffraction_force"])
    assert out["added_mass"] == pytest.approx(moved(run.radiation).real)
    assert out["radiation_damping"] == pytest.approx(OMEGA * moved(run.radiation).imag)
    H = run.kochin[0][0][:, :16]
    assert out["kochin_radiation"][3:] == pytest.approx(H[3:] - np.cross(np.array(CENTER), H[:3].T).T)
    assert out["kochin_diffraction"] == pytest.approx(run.kochin[1][0][:, :16])
    M, C = run.problem.inertia_matrix, run.problem.hydrostatic_stiffness
    Z = -(OMEGA**2) * (M + moved(run.radiation)) + C
    assert out["rao"] == pytest.approx(np.linalg.solve(Z, (run.excitation @ T.T).T).T)
    assert set(out) == ALL | {"checks", "wall_time"}


def by_momentum(H, slope, beta, k, n):
    """The far field's drift about CENTER of one wave, H at 16 angles and then ahead"""
    theta, step = np.arange(16) * np.pi / 8, np.pi / 8
    x = -2 * np.pi * np.cos(beta) * H[-1].real - step * np.sum(np.abs(H[:-1]) ** 2 * np.cos(theta))
    y = -2 * np.pi * np.sin(beta) * H[-1].real - step * np.sum(np.abs(H[:-1]) ** 2 * np.sin(theta))
    m = -2 * np.pi * slope[-1].imag - step * np.sum((H[:-1].conj() * slope[:-1]).imag)
    x, y, m = RHO * G * n / (np.pi * k) * np.array([x, y, m / k])
    return [x, y, m - (CENTER[0] * y - CENTER[1] * x)]


@pytest.mark.parametrize("moving", [False, True])
def test_drift_is_that_of_the_waves_scattered_and_sent_by_the_motions(moving):
    run = Made()
    X = run.rao if moving else np.zeros((2, 6))
    about_origin = X @ T  # motions of modes about the origin
    expected = []
    for j, beta in enumerate(run.headings):
        at = [*range(16), 16 + j]
        H, slope = (run.kochin[1][i][j, at] + about_origin[j] @ run.kochin[0][i][:, at] for i in (0, 1))
        expected.append(by_momentum(H, slope, beta, run.k, run.group_factor))
    assert run.drift(moving) == pytest.approx(np.array(expected), rel=1e-9)
    pairs = run.drift_of_two(moving)
    assert pairs[[0, 1], [0, 1]].real == pytest.approx(np.array(expected), rel=1e-9)


def test_estimated_errors_are_taken_to_the_rotation_centre_and_through_the_equations():
    run = Made()
    radiation, excitation = run.differences
    gap = np.abs(run.excitation - run.haskind)
    excitation = np.where(gap > np.abs(excitation), run.excitation - run.haskind, excitation)
    found = run.estimated_errors()
    assert found["added_mass"] == pytest.approx(np.abs(moved(radiation).real))
    assert found["radiation_damping"] == pytest.approx(OMEGA * np.abs(moved(radiation).imag))
    assert found["excitation_force"] == pytest.approx(np.abs(excitation @ T.T))
    corrected = Made()
    corrected.radiation = run.radiation - run.differences[0]
    corrected.diffraction = run.diffraction - run.differences[1]
    del corrected.excitation  # which was known
    assert found["rao"] == pytest.approx(np.abs(run.rao - corrected.rao))
    corrected.kochin = [0.98 * H for H in run.kochin]
    assert found["drift_force_fixed"] == pytest.approx(np.abs(run.drift(False) - corrected.drift(False)))
    assert found["drift_force"] == pytest.approx(np.abs(run.drift(True) - corrected.drift(True)))
    assert set(found) == {
        "added_mass",
        "radiation_damping",
        "excitation_force",
        "rao",
        "drift_force_fixed",
        "drift_force",
    }
    larger = Made(margin=1.3).estimated_errors()
    assert larger["rao"] == pytest.approx(1.3 * found["rao"])
    assert larger["drift_force_fixed"] == pytest.approx(1.3 * found["drift_force_fixed"])
    assert larger["added_mass"] == pytest.approx(found["added_mass"])
    assert Made(differences=None).estimated_errors() == {} and np.isnan(Made(differences=None).estimated_error())


def test_an_error_is_within_the_tolerance_where_that_of_damping_is_within_six_tenths_of_it():
    """Of √|Z_ii Z_jj|, or of a damping by its own size"""
    run = Made(want={"added_mass"}, haskind=None)
    wrong = np.zeros((6, 6), complex)
    wrong[2, 2] = 0.02 * abs(run.radiation[2, 2])
    first = Made(want={"added_mass"}, differences=(wrong, np.zeros((2, 6))))
    assert first.tolerances == pytest.approx(0.02 / 0.01)
    second = Made(want={"added_mass"}, differences=(1j * wrong / 10, np.zeros((2, 6))))
    own = damping_error(second, 1j * wrong / 10)
    b = moved(run.radiation)[2, 2].imag
    assert own == pytest.approx(0.002 * abs(run.radiation[2, 2]) / b, rel=1e-6)
    assert second.tolerances == pytest.approx(own / 0.6 / 0.01)


def test_a_run_beyond_its_tolerance_is_answered_by_a_sharper_one_as_long_as_that_helps():
    made = []

    class Sharper(Made):
        most_sharper = 3

        @property
        def tolerances(self):
            return self.off

        @property
        def sharper(self):
            if len(made) == len(self.next):
                return None
            made.append(Sharper(off=self.next[len(made)], next=self.next))
            return lambda: made[-1]

    for off, following, kept in ((0.9, [0.1], None), (1.1, [0.5, 0.1], 0), (5.0, [3.0, 2.0, 1.5, 0.5], 2),
                                 (5.0, [3.0, 3.1, 0.1], 1), (5.0, [], None)):  # fmt: skip
        made.clear()
        run = Sharper(off=off, next=following)
        found = run.within_tolerance()
        assert found is (run if kept is None else made[kept])
    made.clear()
    assert Sharper(off=5.0, next=[1.0], solves=False).within_tolerance().off == 5.0


def test_only_what_is_asked_for_is_computed_and_the_rest_is_nan():
    """Moments about another point need forces; motions need all"""
    out = Made(want={"added_mass", "excitation_force"}, dofs=("Heave", "Pitch")).result()
    known = np.isfinite(out["added_mass"])
    assert known.sum() == 4 and known[2, 4] and known[4, 4] and np.isfinite(out["excitation_force"]).sum() == 4
    assert Made(want={"added_mass"}, dofs=("Heave",)).dofs == [2]
    assert Made(want={"added_mass"}, dofs=("Pitch",)).dofs == [0, 2, 4]  # about (x, z)
    assert Made(want={"rao"}, dofs=("Heave",)).dofs == [0, 1, 2, 3, 4, 5]
    cases = (
        ({"added_mass"}, True, False, False), ({"kochin_radiation"}, True, False, True),
        ({"excitation_force"}, False, True, False), ({"drift_force_fixed"}, False, True, True),
        ({"rao"}, True, True, False), ({"drift_force"}, True, True, True), ({"pressure"}, True, True, False),
        ({"Froude_Krylov_force"}, False, False, False),
    )  # fmt: skip
    for want, radiates, diffracts, far in cases:
        run = Made(want=want)
        assert (run.radiates, run.diffracts, run.far_field) == (radiates, diffracts, far), want
    with pytest.raises(ValueError, match="omega is 0 rad/s; allowed: positive and finite"):
        FrequencyRun(run.prepared, 0, [0.0], {"rao"}, None, DOFS)
    with pytest.raises(ValueError, match="omega is inf"):
        FrequencyRun(run.prepared, np.inf, [0.0], {"rao"}, None, DOFS)


def test_laws_of_a_frequency_are_measured_as_they_are_defined():
    """B/ω from 4ρg n/(kω)² of the mean of H H̄; the worst of all pairs and headings"""
    run = Made()
    H = run.kochin[0][0][:, :16]
    far = 4 * RHO * G * run.group_factor / (run.k * OMEGA) ** 2 * (H @ H.conj().T).real / 16
    assert run.radiated == pytest.approx(far)
    size = np.sqrt(np.abs(np.diag(run.radiation)))
    assert radiated_energy(run) == pytest.approx((np.abs(far - run.radiation.imag) / np.outer(size, size)).max())
    D, worst = run.kochin[1][0], []
    for j in (0, 1):
        power, ahead = np.mean(np.abs(D[j, :16]) ** 2), D[j, 16 + j]
        worst.append(abs(power + ahead.real) / max(power, abs(ahead), np.abs(D[j, :16]).max()))
    assert scattered_energy(run) == pytest.approx(max(worst))
    found = check(run)
    assert found["energy"] == pytest.approx(max(radiated_energy(run), max(worst))) and found["residual"] == 1e-9
    Z = run.radiation
    assert found["reciprocity"] == pytest.approx((np.abs(Z - Z.T) / np.outer(size, size)).max())
    less = check(Made(want={"added_mass"}))
    assert np.isnan([less["Haskind"], less["energy"]]).all() and np.isfinite(less["reciprocity"])
    assert np.isnan(check(Made(haskind=None))["Haskind"])
    assert share_left(2.0) == pytest.approx(1 / (2**1.16 - 1))
    assert damping_error(Made(want={"excitation_force"}), Z) == 0.0


def test_a_free_body_follows_from_stored_flow():
    run, out = Made(), Made().result()
    flow = {name: out[name] for name in needed({"rao", "drift_force"})}
    made = free_body(run.problem, OMEGA, run.headings, run.theta, flow)
    assert made["rao"] == pytest.approx(out["rao"])
    total = out["kochin_diffraction"] + out["rao"] @ out["kochin_radiation"]
    order = np.fft.fftfreq(16, 1 / 16)
    series = np.fft.fft(total, axis=-1) / 16
    order[8] = 0.0  # the highest has no slope, and is cos 8θ
    expected = []
    for j, beta in enumerate(run.headings):
        at = np.append(run.theta, beta)
        wave = np.exp(1j * np.outer(np.fft.fftfreq(16, 1 / 16), at))
        expected.append(by_momentum(series[j] @ wave, (1j * order * series[j]) @ wave, beta, run.k, run.group_factor))
    assert made["drift_force"] == pytest.approx(np.array(expected), rel=1e-9)
    assert set(free_body(run.problem, OMEGA, run.headings, run.theta, {n: flow[n] for n in needed({"rao"})})) == {"rao"}


def test_far_fields_have_angles_for_all_their_harmonics():
    """4 ⌈(2 ⌈kR + 6 (kR)^⅓ + 8⌉ + 2)/4⌉, equally spaced from 0"""
    for k, radius, count in ((0.1, 10.0, 4 * 8), (0.8, 10.0, 4 * 15), (1e-9, 1.0, 4 * 5)):
        x = k * radius
        assert len(angles(k, radius)) == 4 * int(np.ceil((2 * np.ceil(x + 6 * np.cbrt(x) + 8) + 2) / 4)) == count
    assert angles(0.8, 10.0)[:2] == pytest.approx([0, 2 * np.pi / 60])


@pytest.mark.parametrize(
    "images", [[(1, 1)], [(1, 1), (-1, 1)], [(1, 1), (1, -1)], [(1, 1), (-1, 1), (1, -1), (-1, -1)]]
)
def test_directions_are_found_among_the_mirror_images_of_a_few(images):
    """Of an odd function in x and y the sign of both, its slope with that of the turn"""
    theta = np.arange(12) * np.pi / 6 + 0.1 * (len(images) == 1)
    few = folded(theta, images)
    assert len(few.angles) == {1: 12, 2: 7, 4: 4}[len(images)]
    signs = np.prod(images, axis=1)
    both = np.sin(2 * few.angles)[None], 2 * np.cos(2 * few.angles)[None]
    if len(images) == 1:
        signs = np.ones(1)
    elif len(images) == 2:
        signs = np.array([1, -1])
    value, slope = few.unfolded(*both, signs)
    assert value[0] == pytest.approx(np.sin(2 * theta)) and slope[0] == pytest.approx(2 * np.cos(2 * theta))


@pytest.mark.parametrize("hull", [box(20, 10, 4, panels=60), buoy(8, 5, panels=60)], ids=("box", "buoy"))
def test_every_step_of_a_frequency_on_panels_has_its_time(hull):
    prepared = prepare(PanelProblem(hull, lid(hull), depth=12.0))
    found = solve_frequency(prepared, 0.9, [0.0], {"added_mass", "drift_force_fixed"})["wall_time"]
    steps = {"incident", "rankine", "table", "assemble", "solve", "far field"}
    assert steps <= set(found) and all(found[step] >= 0 for step in steps)


def test_a_run_asks_another_one_the_question_that_it_was_asked():
    want, dofs = {"added_mass", "drift_force_fixed"}, ("Sway", "Roll", "Yaw")
    omega, headings, asked, theta, names = Made(want=want, dofs=dofs).question
    assert omega == OMEGA and headings.tolist() == [0.3, 1.2] and asked == want and tuple(names) == dofs
    assert theta == pytest.approx(np.arange(16) * np.pi / 8)


def test_wall_times_of_one_step_add_up():
    run = Made()
    run._timed("solve", 0.0)
    first = run.wall_time["solve"]
    run._timed("solve", 0.0)
    assert run.wall_time["solve"] > 1.9 * first > 0


def test_the_drift_of_each_body_is_given_as_it_floats_and_held_and_held_alone_if_nothing_floats():
    class Parted(Made):
        def drift_of_each(self, moving):
            return f"of each, {moving}"

    both = {"body_drift_force", "body_drift_force_fixed"}
    found = Parted(want=both).result()
    assert [found[name] for name in sorted(both)] == ["of each, True", "of each, False"]
    held = Parted(want=both, free=False).result()
    assert held["body_drift_force_fixed"] == "of each, False" and "body_drift_force" not in held
    for name in both:
        assert both & set(Parted(want={name}).result()) == {name}


def test_without_errors_of_the_far_field_drift_has_no_estimate():
    found = Made(kochin_errors=None).estimated_errors()
    assert set(found) == {"added_mass", "radiation_damping", "excitation_force", "rao"}
    assert not {"drift_force", "drift_force_fixed"} & set(Made(want={"rao"}).estimated_errors())


def test_motions_that_damp_themselves_have_the_damping_of_their_amplitude():
    """(−ω²(M + A) − iω(B + N) + C) X = F with N = (8/3π) ω a |X| N₂ of waves of a metres; the motions, not N"""
    M, C, F = 3e6, 2e6, 5e5 + 2e5j
    law = Viscous({"Heave": Quadratic(4e5)}, 1.5)
    inertia, stiffness = np.diag([1.0] * 6) * M, np.diag([1.0] * 6) * C
    both = {"inertia_matrix": inertia, "hydrostatic_stiffness": stiffness}
    problem = SimpleNamespace(structural_damping=None, bodies=(), viscous=law, **both)
    A, B, force = np.eye(6) * 1e6, np.eye(6) * 2e5, np.zeros((1, 6), complex)
    force[0, 2] = F
    X = motions(problem, 0.7, A, B, force)[0]
    N = 8 / (3 * np.pi) * 0.7 * 1.5 * abs(X[2]) * 4e5
    assert (-(0.49) * 4e6 - 0.7j * (2e5 + N) + C) * X[2] == pytest.approx(F)
    assert X[[0, 1, 3, 4, 5]] == pytest.approx(np.zeros(5))
    problem.viscous, problem.structural_damping = None, 3e5 * np.eye(6)
    assert (-(0.49) * 4e6 - 0.7j * 5e5 + C) * motions(problem, 0.7, A, B, force)[0, 2] == pytest.approx(F)


def test_the_time_of_estimates_is_what_is_beside_the_steps_of_the_run(monkeypatch):
    """From 100 s on a clock that ticks by 1 s: 7 s before the result, of which steps took 3, and 1 s after it"""
    run = Made()
    run.wall_time = {"solve": 2.0, "table": 1.0}
    ticks = iter([100.0, 107.0, 120.0, 121.0])
    monkeypatch.setattr("hakobune.bem.frequency.time.perf_counter", lambda: next(ticks))
    monkeypatch.setattr(Made, "within_tolerance", lambda self: self)
    monkeypatch.setattr(Made, "result", lambda self: {"checks": {}, "wall_time": dict(self.wall_time)})
    for interpolated, step in ((False, ESTIMATE), (True, INTERPOLATED)):
        run.interpolated = interpolated
        found = solve_frequency(SimpleNamespace(run=lambda *given: run), OMEGA, [0.3], ALL)
        assert found["wall_time"] == {"solve": 2.0, "table": 1.0, step: 5.0}
        ticks = iter([100.0, 107.0, 120.0, 121.0])


def test_a_body_without_inertia_has_no_motions_and_no_drift_that_follows_from_them():
    want = {"rao", "drift_force", "drift_force_fixed", "added_mass"}
    assert set(Made(want=want, free=False).result()) - {"checks", "wall_time"} == {"drift_force_fixed", "added_mass"}


@pytest.mark.parametrize("radiated, scattered, want, energy", [
    (0.3, 0.1, {"added_mass", "drift_force_fixed"}, 0.3), (0.1, 0.3, {"added_mass", "drift_force_fixed"}, 0.3),
    (0.3, 0.1, {"drift_force_fixed"}, 0.1), (0.3, 0.1, {"kochin_radiation"}, 0.3), (0.3, 0.1, {"added_mass"}, None),
])  # fmt: skip
def test_the_larger_violation_of_energy_is_told_of_what_is_computed(monkeypatch, radiated, scattered, want, energy):
    monkeypatch.setattr("hakobune.bem.checks.radiated_energy", lambda run: radiated)
    monkeypatch.setattr("hakobune.bem.checks.scattered_energy", lambda run: scattered)
    found = check(Made(want=want))
    assert np.isnan(found["energy"]) if energy is None else found["energy"] == energy
    assert found["residual"] == 1e-9 and np.isnan(found["estimated_error"])
    assert np.isnan(found["reciprocity"]) == (not want & {"added_mass", "kochin_radiation"})
