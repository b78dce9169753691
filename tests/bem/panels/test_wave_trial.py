"""Every frequency of a band is tested: what few nodes do not carry is seen, with samples in place of all nodes."""

from functools import cache

import numpy as np
import pytest

from bem.green.tables import wave_table
from bem.methods.panel_setup import Prepared, Setup, prepare
from bem.panels.band import low_rank_waves as wave_space
from bem.panels.band import one_frequency as reduced_run
from bem.panels.band.equations import reduced
from bem.panels.band.error_test import Samples, Trial
from bem.panels.band.low_rank_waves import Cases, acting
from bem.panels.band.one_frequency import ReducedRun
from bem.panels.one_frequency import PanelRun
from bem.panels.wave_influence import wave_blocks
from meshing.lid import lid
from meshing.shapes import box, buoy

DOFS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
WANT = {"added_mass", "radiation_damping", "excitation_force"}
BAND = (0.2, 1.6)


@cache
def body():
    """A buoy with and without its lid, as many nodes as make samples fewer than all"""
    mesh = buoy(10, 10, panels=700)
    return prepare(Setup(mesh, lid(mesh), depth=30.0, band=BAND))


def run_at(omega, want=WANT):
    return ReducedRun(body(), omega, np.radians([25.0, 110.0]), want, None, DOFS)


@pytest.mark.parametrize("omega", [0.3, 1.5])
def test_forces_are_integrals_of_the_potentials(omega):
    run = run_at(omega)
    assert run.flow is not None
    areas = run.hull[1] * run.geometry.copies
    for cls, (moving, _) in run.columns.items():
        phi, flux = run.potentials[cls], run.incident[0][cls][1]
        pushing = phi @ run.weighted_modes[:, run.geometry.members(cls)]
        np.testing.assert_allclose(run.pushing[cls], pushing, rtol=0, atol=1e-12 * np.abs(pushing).max())
        met = (flux * areas) @ phi[: len(moving)].T
        # the flux at few nodes stands for all, to a fifth of the accuracy of a row each
        # (`bem.panels.band.low_rank_waves`)
        scale = np.sqrt((np.abs(flux) ** 2 @ areas)[:, None] * (np.abs(phi[: len(moving)]) ** 2 @ areas))
        assert np.all(np.abs(run.meeting_waves[cls] - met) < run.reduced.accuracy * scale)


def test_what_one_heading_gives_does_not_depend_on_the_others():
    both = run_at(0.7).result()
    alone = ReducedRun(body(), 0.7, np.radians([110.0]), WANT, None, DOFS).result()
    np.testing.assert_allclose(alone["excitation_force"][0], both["excitation_force"][1], rtol=1e-9)


def trial_of(rng, nodes, samples):
    """A random space for `nodes` nodes of equal size, and a trial of it: X, Y, N, V and the trial"""
    X, Y, N = (rng.normal(size=size) for size in ((nodes, 4), (3, nodes), (1, 2, nodes)))
    V = rng.normal(size=(1, nodes, 5))
    return X, Y, N, V, Trial.of(np.array([0, 5]), samples, X, Y, V, N[..., samples.nodes], np.ones(nodes))


def everywhere(nodes):
    return Samples(np.arange(nodes), np.ones(nodes), nodes)


def noise(rng, *size):
    return rng.normal(size=size) + 1j * rng.normal(size=size)


def test_waves_that_the_space_holds_are_not_lost_and_others_are():
    rng, nodes = np.random.default_rng(0), 40
    X, Y, N, V, trial = trial_of(rng, nodes, everywhere(nodes))
    held, phi, given = (noise(rng, 1, 4, 3), noise(rng, 1, 4, 2)), noise(rng, 1, nodes, 2), noise(rng, 1, 5, 2)
    W, S = X[trial.points] @ held[0] @ Y, X[trial.points] @ held[1] @ N
    assert trial.lost_waves((W, S), held, phi, given) < 1e-12
    dW, dS = noise(rng, *W.shape), noise(rng, *S.shape)
    size = 2 * np.pi * np.abs(phi).max(axis=1, keepdims=True)
    for one, other in ((1.0, 0.0), (0.0, 1.0), (0.3, 0.2)):
        expected = np.abs(one * dW @ phi - other * dS @ (V @ given)) / size
        found = trial.lost_waves((W + one * dW, S + other * dS), held, phi, given)
        assert found == pytest.approx(expected.max())
    assert np.isnan(trial.lost_waves((W * np.nan, S), held, phi, given))
    assert np.isnan(trial.lost_waves((W, S * np.nan), held, phi, given))


def test_samples_stand_for_all_nodes_in_the_mean():
    rng, nodes, part = np.random.default_rng(1), 400, 0.25
    missed, phi = rng.normal(size=(1, 1, nodes)) + 3, np.ones((1, nodes, 1), complex)
    silent, found = (np.zeros((1, 4, 3), complex), np.zeros((1, 4, 2), complex)), []
    for _ in range(400):
        chosen = np.flatnonzero(rng.random(nodes) < part)
        *_, trial = trial_of(rng, nodes, Samples(chosen, np.full(len(chosen), 1 / part), len(chosen)))
        here = missed[..., chosen], np.zeros((1, 1, len(chosen)), complex)
        found.append(trial.lost_waves(here, silent, phi[:, chosen], np.zeros((1, 5, 1), complex)))
    exact = missed.sum() / (2 * np.pi)
    # of 400 trials, each with a deviation of √((1 − part)/part Σ missed²): three of the mean's
    deviation = np.sqrt((1 - part) / part * np.sum(missed**2)) / (2 * np.pi)
    assert abs(np.mean(found) - exact) < 3 * deviation / np.sqrt(len(found))


@cache
def prepared_for(band, most=wave_space.TRIED):
    """The body in another band; `most` samples a part in a trial"""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(wave_space, "TRIED", most)
        prepared = Prepared(body().setup, body().geometry)
        prepared.__dict__["reduced"] = reduced(body().geometry, band, 9.80665, 1e-4)
    return prepared


def tried(band, omega, most, monkeypatch):
    """A run, its trial, what `Trial.missed` was given, and what it found"""
    calls, missed = [], Trial.missed
    with monkeypatch.context() as patch:
        patch.setattr(reduced_run, "ALLOWED", np.inf)
        patch.setattr(Trial, "missed", lambda *given: calls.append((*given, missed(*given))) or calls[-1][-1])
        run = ReducedRun(prepared_for(band, most), omega, np.radians([25.0, 110.0]), WANT, None, DOFS)
        assert run.flow is not None
    (call,) = calls
    return run, call


@pytest.mark.parametrize("band, omega", [(BAND, 0.3), (BAND, 0.7), (BAND, 1.5), ((0.2, 0.3), 0.6), ((0.2, 0.5), 0.9)])
def test_samples_find_what_all_nodes_find(band, omega, monkeypatch):
    """To four deviations: nodes are samples each by its own chance p, so that a sum Σt is found to √(Σ(1/p − 1)|t|²)"""
    _, (few, *_, found) = tried(band, omega, wave_space.TRIED, monkeypatch)
    run, (trial, here, held, phi, given, mine, exact) = tried(band, omega, np.inf, monkeypatch)
    nodes, e = len(trial.samples.nodes), trial.samples.hull
    assert np.all(trial.samples.represented == 1) and len(few.samples.nodes) < nodes / 2
    W, S = (trial.X @ part for part in held)
    terms = (here[0] - W @ trial.Y)[..., None] * phi[:, None]
    terms[:, :, :e] -= (here[1] - S @ trial.N[mine])[..., None] * (trial.V[mine] @ given)[:, None]
    np.testing.assert_allclose(terms.sum(axis=2), exact, rtol=0, atol=1e-9 * np.abs(exact).max())
    p = Cases(run.geometry, band, 9.80665).chances(wave_space.TRIED, wave_space.TRIED)
    deviation = np.sqrt(np.einsum("j,cwjk->cwk", 1 / p - 1, np.abs(terms) ** 2))
    assert np.all(np.abs(found - exact) <= 4 * deviation + 1e-12 * np.abs(phi).max())
    np.testing.assert_allclose(few.samples.represented, 1 / p[few.samples.nodes])
    if omega > band[1]:  # what is lost is not lost among the samples
        assert (np.abs(exact) > 8 * deviation).any()


@pytest.mark.parametrize("omega", [0.3, 0.7, 1.5])
def test_nothing_is_lost_within_the_band(omega, monkeypatch):
    """Of all nodes, as the potentials feel it: (W φ − S_w V v) − X m at the points"""
    run, _ = tried(BAND, omega, np.inf, monkeypatch)
    g, space, flow = run.geometry, run.reduced.space, run.flow
    table = wave_table(omega, g.depth, 9.80665, g.reach, g.draft)
    S, D = wave_blocks(g, space.trial.points, np.arange(len(g.elements.nodes)), table, run.depth_values)
    phi = np.concatenate([run.reduced.response @ flow.shares, flow.lid], axis=1)
    missed = acting(S, D, g.hull, table.K) @ phi - S[..., : g.hull] @ (space.velocities @ run.given)
    missed -= space.trial.X @ flow.shares[:, : len(space.points)]
    size = 2 * np.pi * np.abs(phi).max(axis=1, keepdims=True)
    # columns are zero where a class has fewer motions than others
    lost = np.abs(missed) * space.trial.point_size[:, None] / np.where(size > 0, size, 1.0)
    assert lost.max() < reduced_run.ALLOWED * run.reduced.accuracy


@pytest.mark.parametrize("band, omega", [((0.2, 0.3), 0.6), ((0.2, 0.5), 0.9), ((0.5, 0.6), 0.8)])
def test_a_frequency_far_outside_its_band_is_noticed_or_right(band, omega, monkeypatch):
    """Waves and flux may both keep below the limit; then forces have to be right to as much"""
    prepared, lost = prepared_for(band), []
    monkeypatch.setattr(ReducedRun, "in_full", lambda self, part: lost.append(part))
    question = omega, np.radians([25.0, 110.0]), WANT, None, DOFS
    few = ReducedRun(prepared, *question)
    if few.flow is None:
        assert lost
        return
    force, exact = few.result()["excitation_force"], PanelRun(prepared, *question).result()["excitation_force"]
    for half in (slice(0, 3), slice(3, 6)):
        assert np.abs(force - exact)[:, half].max() < reduced_run.ALLOWED * 1e-4 * np.abs(exact[:, half]).max()


def test_flux_that_the_crests_carry_is_not_lost():
    rng, nodes = np.random.default_rng(2), 40
    *_, V, trial = trial_of(rng, nodes, everywhere(nodes))
    crests = noise(rng, 3, 2)
    flux = crests @ V[0, :, -2:].T  # what spans waves comes last
    assert trial.lost_flux(flux, crests) < 1e-12
    assert trial.lost_flux(flux * 1.02, crests) == pytest.approx(0.02 / 1.02, rel=1e-6)
    assert trial.lost_flux(flux[:0], crests[:0]) == 0.0


@pytest.mark.parametrize(
    "make, depth, band",
    [
        (lambda: box(60, 30, 8, panels=100).whole().rotated(0.4), 200.0, (0.02, 1.2)),
        (lambda: box(100, 20, 5, panels=150), 200.0, (0.02, 1.5)),
        (lambda: buoy(10, 10, panels=150), np.inf, (0.05, 2.5)),
    ],
)
def test_no_frequency_within_a_wide_band_is_lost(make, depth, band, monkeypatch):
    """Nor a heading: incident waves were once spanned at too few frequencies, and 3 % of the flux was lost"""
    prepared, lost = prepare(Setup(make(), None, depth=depth, band=band)), []
    monkeypatch.setattr(ReducedRun, "in_full", lambda self, part: lost.append((self.omega, part)))
    for omega in np.linspace(*band, 13):
        _ = ReducedRun(prepared, omega, np.radians(np.arange(0.3, 180, 14.0)), WANT, None, DOFS).flow
    assert not lost


@pytest.mark.parametrize("panels", [1000, 20000])
def test_no_sample_stands_for_too_many_nodes(panels):
    """One that did would make the sum over samples a matter of chance"""
    mesh = box(100, 30, 5, panels=panels)
    cases = Cases(prepare(Setup(mesh, lid(mesh), depth=20.0)).geometry, (0.2, 1.0), 9.80665)
    hull, total = cases.geometry.hull, len(cases.root)
    samples = cases.samples(3, 100, 100)
    assert samples.represented.max() <= max(hull, total - hull) / 100
    assert set(cases.witnesses()) <= set(samples.on_hull)
    for mine, nodes in ((slice(samples.hull), hull), (slice(samples.hull, None), total - hull)):
        represented = samples.represented[mine]
        # what nodes are represented by is one each in the mean; three deviations
        assert abs(represented.sum() - nodes) <= 3 * np.sqrt(np.sum(represented * (represented - 1)))


def test_what_is_not_finite_is_an_error():
    prepared = Prepared(body().setup, body().geometry)
    for name in ("at_sources", "integrals"):
        broken = getattr(body().reduced[0], name).copy()
        broken[0, 0, 0] = np.nan
        prepared.__dict__["reduced"] = (body().reduced[0]._replace(**{name: broken}), *body().reduced[1:])
        with pytest.raises(FloatingPointError, match=r"ω = 0.3 rad/s: the solution is not finite"):
            _ = ReducedRun(prepared, 0.3, np.radians([25.0]), WANT, None, DOFS).result()


def test_a_band_without_waves_from_the_side_is_noticed(monkeypatch):
    """Waves from two quarters were once forgotten in bodies without mirror planes"""

    def head_waves(geometry, beta, *rest):
        return whole(geometry, 0.0, *rest)

    whole = wave_space.class_waves
    mesh = box(60, 30, 8, panels=100).whole().rotated(0.4)
    prepared = prepare(Setup(mesh, None, depth=25.0, band=(0.3, 0.9)))
    monkeypatch.setattr(wave_space, "class_waves", head_waves)
    prepared.__dict__["reduced"] = reduced(prepared.geometry, (0.3, 0.9), 9.80665, 1e-4)
    lost = []
    monkeypatch.setattr(ReducedRun, "in_full", lambda self, part: lost.append(part))
    for heading, noticed in ((0.0, 0), (70.0, 1)):
        _ = ReducedRun(prepared, 0.6, np.radians([heading]), {"excitation_force"}, None, DOFS).flow
        assert len(lost) == noticed
    assert lost[0] > reduced_run.ALLOWED * 1e-4
