"""What the solver must satisfy whatever the body: theorems, limits, invariances, orders of convergence."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.green.finite_depth import green_function
from hakobune.bem.green.tables import wave_table
from hakobune.bem.methods.near_field import near_field_drift
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.elements import elements
from hakobune.bem.panels.frequency_limits import added_mass_limit
from hakobune.bem.panels.incident_waves import class_waves
from hakobune.bem.panels.influence import Geometry, assembled
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.bem.waves import depth_factor, depth_factor_slope, group_factor, incident_wave, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import PanelMesh, structured
from hakobune.meshing.shapes import box, buoy

WANT = frozenset(
    {
        "added_mass",
        "radiation_damping",
        "excitation_force",
        "kochin_radiation",
        "kochin_diffraction",
        "drift_force_fixed",
    }
)
HEADINGS = np.radians([0, 45, 90])


def body(counts=(5, 4, 3), depth=20.0, with_lid=True, **options):
    mesh = box(100, 50, 10, counts=counts)
    return prepare(PanelProblem(mesh, lid(mesh) if with_lid else None, depth=depth, **options))


def free_body(counts, depth):
    rho, g, volume = 1025.0, 9.80665, 50000.0
    inertia = rho * volume * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
    stiffness = rho * g * np.diag([0, 0, 5000, 15.83 * volume, 78.33 * volume, 0])
    return body(counts, depth, inertia_matrix=inertia, hydrostatic_stiffness=stiffness)


@pytest.mark.parametrize("depth", [12.0, 20.0, 100.0, np.inf])
def test_reciprocity_haskind_and_energy_fall_with_refinement(depth):
    coarse, fine = (
        [solve_frequency(body(c, depth), w, HEADINGS, WANT)["checks"] for w in (0.2, 0.6, 1.0)]
        for c in ((4, 3, 2), (8, 6, 4))
    )
    for name in ("reciprocity", "Haskind", "energy"):
        worst = [max(c[name] for c in run) for run in (coarse, fine)]
        assert worst[1] < 0.01, (name, worst)  # the default tolerance
        assert worst[1] < worst[0] / 2.5, (name, worst)
    assert max(c["residual"] for c in fine) < 1e-12


def test_mirror_planes_change_nothing():
    mesh, options = box(100, 50, 10, counts=(5, 4, 3)), {"depth": 15.0}
    results = []
    for m in (mesh, PanelMesh(*_half(mesh), "x"), mesh.whole()):
        results.append(solve_frequency(prepare(PanelProblem(m, **options)), 0.5, np.radians([30.0]), WANT))
    # which panels count as close, and so their number of integration points, depends on the images seen together
    for other in results[1:]:
        for name in ("added_mass", "radiation_damping"):
            size = np.sqrt(np.diag(results[0][name]))
            assert np.abs((results[0][name] - other[name]) / np.outer(size, size)).max() < 2e-4, name
        for name in ("excitation_force", "drift_force_fixed"):
            assert np.all(np.abs(results[0][name] - other[name]) < 2e-4 * np.abs(results[0][name])), name


def _half(mesh):
    whole = PanelMesh(mesh.points, mesh.corners, "y").whole()
    return whole.points, whole.corners


def test_turning_the_body_turns_the_answer():
    mesh = box(60, 30, 8, counts=(3, 2, 2)).whole()
    angle = 0.7
    a = solve_frequency(prepare(PanelProblem(mesh, depth=25.0)), 0.8, [0.3], WANT)
    b = solve_frequency(prepare(PanelProblem(mesh.rotated(angle), depth=25.0)), 0.8, [0.3 + angle], WANT)
    c, s = np.cos(angle), np.sin(angle)
    turn = np.kron(np.eye(2), np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))
    expected = turn @ a["added_mass"] @ turn.T
    assert np.abs(b["added_mass"] - expected).max() < 1e-4 * np.abs(expected).max()
    force = a["excitation_force"] @ turn.T
    assert np.abs(b["excitation_force"] - force).max() < 1e-4 * np.abs(force).max()


def test_shifting_the_body_shifts_the_phase_and_the_reference():
    mesh = box(60, 30, 8, counts=(3, 2, 2)).whole()
    omega, beta, shift = 0.8, 0.4, np.array([13.0, -7.0])
    a = solve_frequency(prepare(PanelProblem(mesh, depth=25.0)), omega, [beta], WANT)
    center = (*shift, 0.0)
    b = solve_frequency(
        prepare(PanelProblem(mesh.moved(*shift), depth=25.0, rotation_center=center)), omega, [beta], WANT
    )
    k = float(wavenumber(omega, 25.0))
    phase = np.exp(1j * k * (shift @ [np.cos(beta), np.sin(beta)]))
    scale = np.abs(a["added_mass"]).max()
    assert np.abs(a["added_mass"] - b["added_mass"]).max() < 1e-4 * scale
    assert (
        np.abs(a["excitation_force"] * phase - b["excitation_force"]).max() < 1e-4 * np.abs(a["excitation_force"]).max()
    )
    assert np.abs(a["drift_force_fixed"] - b["drift_force_fixed"]).max() < 1e-3 * np.abs(a["drift_force_fixed"]).max()


def test_irregular_frequencies_leave_no_trace():
    # first interior resonance of the box: K = κ coth κd with κ² = π²(1/L² + 1/B²), near 1.07 rad/s
    kappa = np.pi * np.hypot(1 / 100, 1 / 50)
    resonance = np.sqrt(9.80665 * kappa / np.tanh(kappa * 10))
    omegas = resonance * np.linspace(0.94, 1.06, 13)

    def heave(prepared):
        return np.array([solve_frequency(prepared, w, [], {"added_mass"})["added_mass"][2, 2] for w in omegas])

    def roughness(values):
        smooth = np.polynomial.Polynomial.fit(omegas, values, 4)
        return np.abs(values - smooth(omegas)).max() / np.ptp(values)

    assert roughness(heave(body(depth=12.0, with_lid=False))) > 0.1
    assert roughness(heave(body(depth=12.0))) < 0.01


@pytest.mark.parametrize("depth", [12.0, 50.0, np.inf])
def test_added_mass_tends_to_its_limits(depth):
    prepared = body(depth=depth)
    zero, infinite = (np.diag(added_mass_limit(prepared, w)) for w in ("zero", "infinity"))
    low, lower = (np.diag(solve_frequency(prepared, w, [], {"added_mass"})["added_mass"]) for w in (0.02, 0.005))
    assert np.isinf(zero[2]) == np.isfinite(depth)
    finite = np.isfinite(zero)
    gap, smaller = np.abs(low - zero)[finite], np.abs(lower - zero)[finite]
    assert np.all(smaller < 3e-3 * zero[finite])
    assert np.all(smaller < 0.5 * gap)
    high = np.diag(solve_frequency(prepared, 6.0, [], {"added_mass"})["added_mass"])
    # A(∞) is approached from below like 1/ω²
    assert np.all(np.abs(high / infinite - 1) < 0.12)
    assert abs(high[2] / infinite[2] - 1) < 5e-3


def test_heave_added_mass_in_finite_depth_grows_logarithmically():
    prepared = body(depth=12.0)
    omegas = np.array([0.002, 0.02])
    A = [solve_frequency(prepared, w, [], {"added_mass"})["added_mass"][2, 2] for w in omegas]
    k = wavenumber(omegas, 12.0)
    expected = 1025 * 5000.0**2 / (2 * np.pi * 12.0) * np.log(k[1] / k[0])
    assert A[0] - A[1] == pytest.approx(expected, rel=0.01)


def test_long_waves_lift_the_body_with_the_surface():
    result = solve_frequency(body(depth=12.0), 0.005, [0.3], {"excitation_force"})
    assert result["excitation_force"][0, 2] == pytest.approx(1025 * 9.80665 * 5000, rel=5e-3)


def test_damping_is_what_the_waves_carry_away():
    prepared, omega = body((6, 5, 4), 20.0), 0.7
    theta = 2 * np.pi * np.arange(200) / 200
    r = solve_frequency(prepared, omega, [], {"radiation_damping", "kochin_radiation"}, theta)
    k = float(wavenumber(omega, 20.0))
    H, n = r["kochin_radiation"], float(group_factor(k, 20.0))
    power = 2 * 1025 * 9.80665 * n * (omega / k) / (np.pi * k * omega**2) * (2 * np.pi / 200) * (H @ H.conj().T).real
    B = r["radiation_damping"]
    size = np.sqrt(np.diag(B))
    assert np.abs((power - B) / np.outer(size, size)).max() < 5e-3


def test_slope_of_the_far_field_matches_its_own_fourier_derivative():
    run = PanelRun(body(), 0.8, HEADINGS, WANT, None, DOFS)
    t = len(run.theta)
    (_, _), (H, slope) = run.kochin
    order = np.fft.fftfreq(t, 1 / t)
    spectral = np.fft.ifft(1j * order * np.fft.fft(H[:, :t]))
    assert np.abs(spectral - slope[:, :t]).max() < 1e-6 * np.abs(slope[:, :t]).max()


def half_sphere(n):
    """Quarter of a floating hemisphere of radius 1 graded towards nothing: the body is smooth."""
    polar = np.linspace(0, np.pi / 2, n + 1)
    t, p = np.meshgrid(polar, np.linspace(0, np.pi / 2, n + 1), indexing="ij")
    # outward normal: ∂ along the downward angle × ∂ along the azimuth, seen from the water
    grid = np.stack([np.cos(t) * np.cos(p), np.cos(t) * np.sin(p), -np.sin(t)], axis=-1)
    mesh = structured(grid)
    mesh = mesh if mesh.volume > 0 else mesh.flipped()
    return PanelMesh(mesh.points, mesh.corners, "xy")


def test_near_and_far_field_drift_of_a_fixed_pile_converge_to_each_other():
    gaps = []
    for n in (4, 8):
        mesh = buoy(10, 15, counts=(n, 1, n), bottom=False)
        run = PanelRun(prepare(PanelProblem(mesh, lid(mesh), depth=15.0)), 0.8, [0.0], WANT, None, DOFS)
        gaps.append(abs(near_field_drift(run, False)[0, 0] / run.drift(False)[0, 0] - 1))
    # the velocity at the corners of the polygon leaves a first-order gap
    assert gaps[1] < 0.02, gaps
    assert gaps[1] < 0.6 * gaps[0], gaps


def test_near_and_far_field_drift_of_a_floating_hemisphere_agree_but_for_its_flat_panels():
    rho, g, gaps = 1025.0, 9.80665, []
    volume = 2 * np.pi / 3
    inertia = rho * volume * np.diag([1, 1, 1, 0.25, 0.25, 0.25])
    stiffness = rho * g * np.diag([0, 0, np.pi, volume * 0.05, volume * 0.05, 0])
    for n in (5, 10):
        mesh = half_sphere(n)
        p = prepare(PanelProblem(mesh, lid(mesh), depth=3.0, inertia_matrix=inertia, hydrostatic_stiffness=stiffness))
        run = PanelRun(p, np.sqrt(g * 1.0), [0.0], WANT | {"rao", "drift_force"}, None, DOFS)
        gaps.append(abs(near_field_drift(run, True)[0, 0] / run.drift(True)[0, 0] - 1))
    # radius and slopes of the facets are 1/n² = 4 % and 1 % off; the drift itself changes by 7 % between the two
    assert max(gaps) < 0.03, gaps


@pytest.mark.parametrize("moving", [False, True])
def test_near_field_drift_of_the_box_approaches_the_far_field(moving):
    gaps = []
    for counts in ((4, 3, 2), (8, 6, 4)):
        run = PanelRun(free_body(counts, 20.0), 0.5, np.radians([0, 90]), WANT | {"rao", "drift_force"}, None, DOFS)
        near, far = near_field_drift(run, moving), run.drift(moving)
        gaps.append(max(abs(near[0, 0] / far[0, 0] - 1), abs(near[1, 1] / far[1, 1] - 1)))
    assert gaps[1] < 0.6 * gaps[0], gaps
    assert moving or gaps[1] < 0.005, gaps


@pytest.mark.parametrize("depth", [10.5, 30.0, np.inf])
@pytest.mark.parametrize("omega", [0.1, 0.8])
def test_flow_of_a_source_inside_the_body_is_recovered(depth, omega):
    source, errors = np.array([0.0, 0.0, -5.0]), []
    for counts in ((4, 3, 3), (8, 6, 6)):
        mesh = buoy(10, 10, counts=counts)
        g = Geometry(mesh, lid(mesh), depth)
        e = elements(mesh)
        exact, gradient = green_function(e.nodes, source, omega, depth)
        table = wave_table(omega, depth, 9.80665, g.reach, 10.0)

        def Z(z, k=table.k):
            return np.stack([depth_factor(z, k, depth), depth_factor_slope(z, k, depth)], axis=-1)

        V = np.sum(gradient * e.normals, axis=1)
        A, U, W, b = (part[0] for part in assembled(g, [(1, 1)], 1.0, table, Z, [V[None]]))
        phi = np.linalg.solve(A + 1j * (U @ W.T), b)[: g.hull, 0]
        errors.append(np.sqrt(np.sum(e.weights * np.abs(phi - exact) ** 2) / np.sum(e.weights * np.abs(exact) ** 2)))
    assert errors[1] < 3e-3, errors
    assert np.log2(errors[0] / errors[1]) > 1.8, errors


@pytest.mark.parametrize(
    "want, classes", [({"added_mass"}, 4), ({"Froude_Krylov_force"}, 0), ({"excitation_force"}, 2)]
)
def test_only_what_is_wanted_is_solved(want, classes):
    run = PanelRun(body((2, 2, 2)), 0.5, [0.0], want, None, DOFS)
    result = run.result()
    assert len(run.columns) == classes
    assert set(result) - {"checks", "wall_time"} == want


def test_degrees_of_freedom_left_out_are_not_solved():
    run = PanelRun(body((2, 2, 2)), 0.5, [0.0], {"added_mass", "excitation_force"}, None, ("Surge", "Heave"))
    result = run.result()
    assert set(run.columns) == {(1, 1), (-1, 1)}
    assert np.isnan(result["added_mass"][1, 1]) and np.isfinite(result["added_mass"][0, 0])


@pytest.mark.parametrize("depth", [8.0, 300.0, np.inf])
@pytest.mark.parametrize("omega", [1e-3, 0.5, 8.0])
def test_incident_wave_satisfies_laplace_surface_and_bed(depth, omega):
    k = float(wavenumber(omega, depth))
    points = np.array([[1.0, 2.0, 0.0], [3.0, -1.0, -2.0]])
    phi, gradient = incident_wave(points, 0.6, omega, k, depth)
    assert gradient[0, 2] == pytest.approx(omega**2 / 9.80665 * phi[0], rel=1e-12)
    assert 1j * omega / 9.80665 * phi[0] == pytest.approx(np.exp(1j * k * (np.cos(0.6) + 2 * np.sin(0.6))), rel=1e-12)
    if np.isfinite(depth):
        _, bed = incident_wave(np.array([[0.0, 0.0, -depth]]), 0.6, omega, k, depth)
        assert abs(bed[0, 2]) < 1e-12


@pytest.mark.parametrize(
    "symmetry, wall", [("xy", None), ("x", None), ("y", None), ("", None), ("xy", 40.0), ("", 40.0)]
)
@pytest.mark.parametrize("beta", [0.0, 0.6, 2.5])
def test_parts_of_incident_waves_add_up_to_the_wave_on_every_image(symmetry, wall, beta):
    """Before a wall, to the wave and the one that is sent back"""
    omega, depth = 0.7, 20.0
    k = float(wavenumber(omega, depth))
    g = Geometry(box(60, 20, 10, counts=(4, 3, 2), symmetry=symmetry), None, depth, wall=wall)
    parts = class_waves(g, beta, omega, k)
    for m, (x, y) in enumerate(g.images[: g.copies]):
        mirror = np.array([x, y, 1.0])
        at, normals = (a[: g.hull] * mirror for a in (g.elements.nodes, g.elements.normals))
        phi, gradient = incident_wave(at - g.origin, beta, omega, k, depth)
        flux = np.einsum("qi,qi->q", gradient, normals)
        if wall is not None:
            back = np.array([1.0, -1.0, 1.0])
            sent, gradient = incident_wave(at * back - g.origin, beta, omega, k, depth)
            phi, flux = phi + sent, flux + np.einsum("qi,qi->q", gradient * back, normals)
        for part, whole in zip(parts, (phi, flux), strict=True):
            np.testing.assert_allclose(g.all_signs[:, m] @ part, whole, atol=1e-12 * np.abs(whole).max())


@pytest.mark.parametrize("symmetry", ["xy", ""])
def test_pressures_on_the_panels_add_up_to_the_excitation(symmetry):
    mesh = box(100, 50, 10, counts=(4, 3, 2), symmetry=symmetry)
    r = solve_frequency(prepare(PanelProblem(mesh, depth=20.0)), 0.6, [0.4], {"pressure", "excitation_force"})
    whole = mesh.whole()
    force = -(r["pressure"][0] * whole.areas) @ whole.normals
    np.testing.assert_allclose(force, r["excitation_force"][0, :3], rtol=1e-10)


def test_pressure_on_a_free_body_moves_its_mass():
    prepared, omega = free_body((4, 3, 2), 20.0), 0.6
    r = solve_frequency(prepared, omega, [0.4], {"pressure", "rao"})
    whole = prepared.problem.mesh.whole()
    force = -(r["pressure"][0] * whole.areas) @ whole.normals
    force[2] -= 1025 * 9.80665 * 5000 * r["rao"][0, 2]  # the hydrostatic part of the pressure
    np.testing.assert_allclose(force, -(omega**2) * 1025 * 50000 * r["rao"][0, :3], rtol=1e-8)
