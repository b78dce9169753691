"""The error of the low-rank waves is estimated at every frequency of a band, from random samples of the nodes."""

from functools import cache

import numpy as np
import pytest
from other_equations import with_equations

from hakobune.bem.green.tables import wave_table
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.band import low_rank_waves, one_frequency
from hakobune.bem.panels.band.equations import band_equations
from hakobune.bem.panels.band.error_test import ErrorTest, Samples
from hakobune.bem.panels.band.low_rank_waves import Snapshots, wave_operator
from hakobune.bem.panels.band.one_frequency import BandRun
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.bem.panels.wave_influence import wave_blocks
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

DOFS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
WANT = {"added_mass", "radiation_damping", "excitation_force"}
BAND = (0.2, 1.6)


@cache
def body():
    """A buoy with and without its lid, with enough nodes that samples are fewer than all"""
    mesh = buoy(10, 10, panels=700)
    return prepare(PanelProblem(mesh, lid(mesh), depth=30.0, band=BAND))


def run_at(omega, want=WANT):
    return BandRun(body(), omega, np.radians([25.0, 110.0]), want, None, DOFS)


@pytest.mark.parametrize("omega", [0.3, 1.5])
def test_forces_are_integrals_of_the_potentials(omega):
    run = run_at(omega)
    assert run.solution is not None
    areas = run.hull[1] * run.geometry.copies
    for cls, (moving, _) in run.columns.items():
        phi, flux = run.potentials[cls], run.incident[0][cls][1]
        pressure_integrals = phi @ run.weighted_modes[:, run.geometry.members(cls)]
        np.testing.assert_allclose(
            run.pressure_integrals[cls], pressure_integrals, rtol=0, atol=1e-12 * np.abs(pressure_integrals).max()
        )
        haskind = (flux * areas) @ phi[: len(moving)].T
        # the flux is interpolated between few nodes, to a fifth of the accuracy of a row each
        # (`bem.panels.band.low_rank_waves`)
        scale = np.sqrt((np.abs(flux) ** 2 @ areas)[:, None] * (np.abs(phi[: len(moving)]) ** 2 @ areas))
        assert np.all(np.abs(run.haskind_integrals[cls] - haskind) < run.equations_of_band.accuracy * scale)


def test_what_one_heading_gives_does_not_depend_on_the_others():
    both = run_at(0.7).result()
    alone = BandRun(body(), 0.7, np.radians([110.0]), WANT, None, DOFS).result()
    np.testing.assert_allclose(alone["excitation_force"][0], both["excitation_force"][1], rtol=1e-9)


def random_error_test(rng, nodes, samples):
    """A random basis for `nodes` nodes of equal size and its error test: X, Y, N, V and `ErrorTest`"""
    X, Y, N = (rng.normal(size=size) for size in ((nodes, 4), (3, nodes), (1, 2, nodes)))
    V = rng.normal(size=(1, nodes, 5))
    return X, Y, N, V, ErrorTest.of(np.array([0, 5]), samples, X, Y, V, N[..., samples.nodes], np.ones(nodes))


def everywhere(nodes):
    return Samples(np.arange(nodes), np.ones(nodes), nodes)


def noise(rng, *size):
    return rng.normal(size=size) + 1j * rng.normal(size=size)


def test_waves_in_the_basis_have_no_error_and_others_have_theirs():
    rng, nodes = np.random.default_rng(0), 40
    X, Y, N, V, error_test = random_error_test(rng, nodes, everywhere(nodes))
    low_rank, phi, velocity = (noise(rng, 1, 4, 3), noise(rng, 1, 4, 2)), noise(rng, 1, nodes, 2), noise(rng, 1, 5, 2)
    W, S = X[error_test.points] @ low_rank[0] @ Y, X[error_test.points] @ low_rank[1] @ N
    assert error_test.wave_error((W, S), low_rank, phi, velocity) < 1e-12
    dW, dS = noise(rng, *W.shape), noise(rng, *S.shape)
    size = 2 * np.pi * np.abs(phi).max(axis=1, keepdims=True)
    for one, other in ((1.0, 0.0), (0.0, 1.0), (0.3, 0.2)):
        expected = np.abs(one * dW @ phi - other * dS @ (V @ velocity)) / size
        found = error_test.wave_error((W + one * dW, S + other * dS), low_rank, phi, velocity)
        assert found == pytest.approx(expected.max())
    assert np.isnan(error_test.wave_error((W * np.nan, S), low_rank, phi, velocity))
    assert np.isnan(error_test.wave_error((W, S * np.nan), low_rank, phi, velocity))


def test_the_weighted_sum_over_samples_is_unbiased():
    rng, nodes, part = np.random.default_rng(1), 400, 0.25
    errors, phi = rng.normal(size=(1, 1, nodes)) + 3, np.ones((1, nodes, 1), complex)
    silent, found = (np.zeros((1, 4, 3), complex), np.zeros((1, 4, 2), complex)), []
    for _ in range(400):
        chosen = np.flatnonzero(rng.random(nodes) < part)
        *_, error_test = random_error_test(rng, nodes, Samples(chosen, np.full(len(chosen), 1 / part), len(chosen)))
        exact_blocks = errors[..., chosen], np.zeros((1, 1, len(chosen)), complex)
        found.append(error_test.wave_error(exact_blocks, silent, phi[:, chosen], np.zeros((1, 5, 1), complex)))
    exact = errors.sum() / (2 * np.pi)
    # of 400 tests, each with a deviation of √((1 − part)/part Σ errors²): three of the mean's
    deviation = np.sqrt((1 - part) / part * np.sum(errors**2)) / (2 * np.pi)
    assert abs(np.mean(found) - exact) < 3 * deviation / np.sqrt(len(found))


@cache
def prepared_for(band, most=low_rank_waves.TEST_SAMPLES):
    """The body in another band; `most` samples of the strip and of the lid at most in its error test"""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(low_rank_waves, "TEST_SAMPLES", most)
        return with_equations(body(), band_equations(body().geometry, band, 9.80665, 1e-4))


def observed(band, omega, most, monkeypatch):
    """A run, and the arguments and the result of its call of `ErrorTest.errors`"""
    calls, errors = [], ErrorTest.errors
    with monkeypatch.context() as patch:
        patch.setattr(one_frequency, "ALLOWED", np.inf)
        patch.setattr(ErrorTest, "errors", lambda *given: calls.append((*given, errors(*given))) or calls[-1][-1])
        run = BandRun(prepared_for(band, most), omega, np.radians([25.0, 110.0]), WANT, None, DOFS)
        assert run.solution is not None
    (call,) = calls
    return run, call


@pytest.mark.parametrize("band, omega", [(BAND, 0.3), (BAND, 0.7), (BAND, 1.5), ((0.2, 0.3), 0.6), ((0.2, 0.5), 0.9)])
def test_samples_give_the_error_of_all_nodes(band, omega, monkeypatch):
    """To four deviations: a node is a sample with its probability p, so that Σt has the deviation √(Σ(1/p − 1)|t|²)"""
    _, (few, *_, found) = observed(band, omega, low_rank_waves.TEST_SAMPLES, monkeypatch)
    run, (test, blocks, low_rank, phi, velocity, classes, exact) = observed(band, omega, np.inf, monkeypatch)
    nodes, e = len(test.samples.nodes), test.samples.hull
    assert np.all(test.samples.weights == 1) and len(few.samples.nodes) < nodes / 2
    W, S = (test.X @ part for part in low_rank)
    terms = (blocks[0] - W @ test.Y)[..., None] * phi[:, None]
    terms[:, :, :e] -= (blocks[1] - S @ test.N[classes])[..., None] * (test.V[classes] @ velocity)[:, None]
    np.testing.assert_allclose(terms.sum(axis=2), exact, rtol=0, atol=1e-9 * np.abs(exact).max())
    p = Snapshots(run.geometry, band, 9.80665).probabilities(low_rank_waves.TEST_SAMPLES, low_rank_waves.TEST_SAMPLES)
    deviation = np.sqrt(np.einsum("j,cwjk->cwk", 1 / p - 1, np.abs(terms) ** 2))
    assert np.all(np.abs(found - exact) <= 4 * deviation + 1e-12 * np.abs(phi).max())
    np.testing.assert_allclose(few.samples.weights, 1 / p[few.samples.nodes])
    if omega > band[1]:  # the error is more than the deviation of its estimate
        assert (np.abs(exact) > 8 * deviation).any()


@pytest.mark.parametrize("omega", [0.3, 0.7, 1.5])
def test_within_the_band_the_error_of_all_nodes_is_below_the_limit(omega, monkeypatch):
    """(W φ − S_w V v) − X m at the test points, with all nodes"""
    run, _ = observed(BAND, omega, np.inf, monkeypatch)
    g, basis, solution = run.geometry, run.equations_of_band.low_rank, run.solution
    table = wave_table(omega, g.depth, 9.80665, g.reach, g.draft)
    S, D = wave_blocks(g, basis.error_test.points, np.arange(len(g.elements.nodes)), table, run.depth_values)
    phi = np.concatenate([run.equations_of_band.unit_potentials @ solution.coefficients, solution.lid], axis=1)
    errors = wave_operator(S, D, g.hull, table.K) @ phi - S[..., : g.hull] @ (basis.velocities @ run.velocity)
    errors -= basis.error_test.X @ solution.coefficients[:, : len(basis.points)]
    size = 2 * np.pi * np.abs(phi).max(axis=1, keepdims=True)
    # columns are zero where a class has fewer motions than others
    relative = np.abs(errors) * basis.error_test.point_size[:, None] / np.where(size > 0, size, 1.0)
    assert relative.max() < one_frequency.ALLOWED * run.equations_of_band.accuracy


@pytest.mark.parametrize("band, omega", [((0.2, 0.3), 0.6), ((0.2, 0.5), 0.9), ((0.5, 0.6), 0.8)])
def test_a_frequency_far_outside_its_band_is_rejected_or_right(band, omega, monkeypatch):
    """The errors of waves and flux may both be below the limit; then forces have to be as accurate"""
    prepared, rejected = prepared_for(band), []
    monkeypatch.setattr(BandRun, "rejected", lambda self, error: rejected.append(error))
    arguments = omega, np.radians([25.0, 110.0]), WANT, None, DOFS
    few = BandRun(prepared, *arguments)
    if few.solution is None:
        assert rejected
        return
    force, exact = few.result()["excitation_force"], PanelRun(prepared, *arguments).result()["excitation_force"]
    for half in (slice(0, 3), slice(3, 6)):
        assert np.abs(force - exact)[:, half].max() < one_frequency.ALLOWED * 1e-4 * np.abs(exact[:, half]).max()


def test_flux_in_the_basis_has_no_error():
    rng, nodes = np.random.default_rng(2), 40
    *_, V, error_test = random_error_test(rng, nodes, everywhere(nodes))
    flux_nodes = noise(rng, 3, 2)
    flux = flux_nodes @ V[0, :, -2:].T  # the basis of incident waves comes last
    assert error_test.flux_error(flux, flux_nodes) < 1e-12
    assert error_test.flux_error(flux * 1.02, flux_nodes) == pytest.approx(0.02 / 1.02, rel=1e-6)
    assert error_test.flux_error(flux[:0], flux_nodes[:0]) == 0.0


@pytest.mark.parametrize(
    "make, depth, band",
    [
        (lambda: box(60, 30, 8, panels=100).whole().rotated(0.4), 200.0, (0.02, 1.2)),
        (lambda: box(100, 20, 5, panels=150), 200.0, (0.02, 1.5)),
        (lambda: buoy(10, 10, panels=150), np.inf, (0.05, 2.5)),
    ],
)
def test_no_frequency_within_a_wide_band_is_rejected(make, depth, band, monkeypatch):
    """Nor a heading: with snapshots of incident waves at too few frequencies 3 % of the flux was missing"""
    prepared, rejected = prepare(PanelProblem(make(), None, depth=depth, band=band)), []
    monkeypatch.setattr(BandRun, "rejected", lambda self, error: rejected.append((self.omega, error)))
    for omega in np.linspace(*band, 13):
        _ = BandRun(prepared, omega, np.radians(np.arange(0.3, 180, 14.0)), WANT, None, DOFS).solution
    assert not rejected


@pytest.mark.parametrize("panels", [1000, 20000])
def test_no_sample_has_too_large_a_weight(panels):
    """One that had would give the sum over samples a large variance"""
    mesh = box(100, 30, 5, panels=panels)
    snapshots = Snapshots(prepare(PanelProblem(mesh, lid(mesh), depth=20.0)).geometry, (0.2, 1.0), 9.80665)
    hull, total = snapshots.geometry.hull, len(snapshots.root)
    samples = snapshots.samples(3, 100, 100)
    assert samples.weights.max() <= max(hull, total - hull) / 100
    assert set(snapshots.test_points()) <= set(samples.on_hull)
    for part, nodes in ((slice(samples.hull), hull), (slice(samples.hull, None), total - hull)):
        weights = samples.weights[part]
        # the weights of the samples add up to the number of nodes in the mean; three deviations
        assert abs(weights.sum() - nodes) <= 3 * np.sqrt(np.sum(weights * (weights - 1)))


def test_what_is_not_finite_is_an_error():
    first, *others = body().band_equations
    for name in ("at_sources", "integrals"):
        broken = getattr(first, name).copy()
        broken[0, 0, 0] = np.nan
        prepared = with_equations(body(), (first._replace(**{name: broken}), *others))
        with pytest.raises(FloatingPointError, match=r"ω = 0.3 rad/s: the solution is not finite"):
            _ = BandRun(prepared, 0.3, np.radians([25.0]), WANT, None, DOFS).result()


def test_a_band_without_waves_from_the_side_is_rejected(monkeypatch):
    """Bodies without mirror planes need snapshots of incident waves from all quadrants"""

    def head_waves(geometry, beta, *rest):
        return whole(geometry, 0.0, *rest)

    whole = low_rank_waves.class_waves
    mesh = box(60, 30, 8, panels=100).whole().rotated(0.4)
    prepared = prepare(PanelProblem(mesh, None, depth=25.0, band=(0.3, 0.9)))
    monkeypatch.setattr(low_rank_waves, "class_waves", head_waves)
    prepared = with_equations(prepared, band_equations(prepared.geometry, (0.3, 0.9), 9.80665, 1e-4))
    rejected = []
    monkeypatch.setattr(BandRun, "rejected", lambda self, error: rejected.append(error))
    for heading, count in ((0.0, 0), (70.0, 1)):
        _ = BandRun(prepared, 0.6, np.radians([heading]), {"excitation_force"}, None, DOFS).solution
        assert len(rejected) == count
    assert rejected[0] > one_frequency.ALLOWED * 1e-4
