"""Integrals over the depth of a wave that is not free, and what pressures ask of a body, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.contour.accuracy import KAPPA, accuracy, height
from hakobune.bem.contour.hull import long_waves
from hakobune.bem.contour.hull.long_waves import long_wave_forces
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.pressure_drift import pressure_error, refined
from hakobune.bem.contour.side_flow import _DepthModes
from hakobune.bem.contour.solver import prepare_box
from hakobune.bem.depth_modes.gap import Gap
from hakobune.bem.froude_krylov import side_integrals

OMEGA, DEPTH, DRAFT, G = 1.1, 12.0, 5.0, 9.81
GAP = Gap(DRAFT, DEPTH, 3)
MODES = GAP.outer_modes(OMEGA, 6, G)
RNG = np.random.default_rng(7)
COMBINATIONS = RNG.normal(size=(2, len(MODES.rows)))


def frequency(weights):
    profiles = SimpleNamespace(combinations=COMBINATIONS, gap=GAP)
    body = SimpleNamespace(depth=DEPTH, profiles=profiles, nodes=lambda top: SimpleNamespace(weights=weights))
    return SimpleNamespace(modes=MODES, body=body, omega=OMEGA, gravity=G, top="top")


@pytest.mark.parametrize("kappa", [1e-4, 0.05, 0.3, 2.0])
def test_a_wave_times_a_mode_is_integrated_over_the_whole_depth(kappa):
    """∫ cosh κζ/cosh κh f dζ by Gauss points: f of the free wave, and cos kₙζ over its norm and kₙ"""
    found = long_waves._depth_integrals(frequency(lambda k: np.eye(len(k))), kappa)
    x, w = np.polynomial.legendre.leggauss(60)
    zeta, w = DEPTH * (1 + x) / 2, DEPTH * w / 2
    p, k = np.cosh(kappa * zeta) / np.cosh(kappa * DEPTH), MODES.k
    assert found[0] == pytest.approx(np.sum(w * p * np.cosh(k * zeta) / np.cosh(k * DEPTH)))
    rows = (COMBINATIONS @ MODES.rows).T
    for n, (kn, norm) in enumerate(zip(MODES.wavenumbers, MODES.norms, strict=True)):
        part = np.sum(w * p * np.cos(kn * zeta)) / (norm * kn)
        assert found[1:].reshape(6, 2)[n] == pytest.approx(part * rows[n], rel=1e-9, abs=1e-12)


def test_the_free_wave_itself_has_its_norm():
    """Of equal wavenumbers the quotient has no value; it tends to the norm"""
    freq = frequency(lambda k: np.eye(len(k)))
    assert long_waves._depth_integrals(freq, MODES.k)[0] == MODES.wave_norm
    assert long_waves._depth_integrals(freq, MODES.k * (1 + 1e-5))[0] == pytest.approx(MODES.wave_norm, rel=1e-4)
    assert MODES.wave_norm == pytest.approx(
        (1 + 2 * MODES.k * DEPTH / np.sinh(2 * MODES.k * DEPTH)) * np.tanh(MODES.k * DEPTH) / (2 * MODES.k)
    )


@pytest.mark.parametrize("kappa", [1e-3, 0.4])
def test_rows_of_a_wave_are_those_of_the_gap_and_of_the_side(kappa):
    freq = frequency(None)
    sides = side_integrals(DRAFT, DEPTH, kappa)
    wanted = COMBINATIONS @ np.concatenate([GAP.wave_moments(kappa), sides])
    assert long_waves._rows(freq, kappa, DEPTH) == pytest.approx(wanted)
    z, w = np.polynomial.legendre.leggauss(40)
    z, w = DRAFT * (z - 1) / 2, DRAFT * w / 2
    p = np.cosh(kappa * (z + DEPTH)) / np.cosh(kappa * DEPTH)
    assert sides == pytest.approx((np.sum(w * p), np.sum(w * z * p)))


def test_a_wave_without_length_has_the_means():
    """1 over the draft, −d²/2 of z, at κh below a thousand-millionth; next to it nearly the same"""
    freq = frequency(None)
    still = long_waves._rows(freq, 0.9e-9 / DEPTH, DEPTH)
    assert still == pytest.approx(COMBINATIONS @ np.concatenate([GAP.mean, [DRAFT, -(DRAFT**2) / 2]]), rel=1e-14)
    assert long_waves._rows(freq, 1e-4, DEPTH) == pytest.approx(still, rel=1e-5)


def test_forces_of_long_waves_are_sums_over_the_wall_and_its_images(monkeypatch):
    """−ρg ∮ (p ψ_ν − ψ p_ν) ds, rows and depth integrals made up; flows even or odd about both axes"""
    c = SimpleNamespace(x=np.array([3.0, 1.0]), y=np.array([0.5, 2.0]), nx=np.array([1.0, 0.0]),
                        ny=np.array([0.0, 1.0]), weights=np.array([0.7, 1.3]))  # fmt: skip
    dofs = {(1, 1): [2], (-1, 1): [0, 4], (1, -1): [1, 3], (-1, -1): [5]}
    flows, amplitudes = {}, {}
    for cls, own in dofs.items():
        d = len(own)
        velocity, sides = RNG.normal(size=(2, 2, d + 1)), RNG.normal(size=(d, 2, 2))
        flows[cls] = own, SimpleNamespace(basis=RNG.normal(size=(2, 2))), sides, SimpleNamespace(velocity=velocity)
        amplitudes[cls] = RNG.normal(size=(5, 2, d + 1))
    monkeypatch.setattr(long_waves, "plan_values", lambda freq: dict.fromkeys(CLASSES, "values"))
    monkeypatch.setattr(long_waves, "amplitudes", lambda freq, values, cls: [amplitudes[cls]])
    monkeypatch.setattr(long_waves, "_rows", lambda freq, kappa, depth: kappa * np.arange(1.0, 5.0))
    monkeypatch.setattr(long_waves, "_depth_integrals", lambda freq, kappa: kappa + np.arange(3.0))
    freq = SimpleNamespace(contour=c, body=SimpleNamespace(depth=DEPTH), flows=flows, density=1000.0, gravity=G)
    number = np.array([[0.3, 0.4], [-0.1, 0.2]])
    found = long_wave_forces(freq, number)
    for w, (kx, ky) in enumerate(number):
        kappa = np.hypot(kx, ky)
        for cls, own in dofs.items():
            _, wave, sides, flow = flows[cls]
            for n, dof in enumerate(own):
                total = 0.0
                for x, y in CLASSES:
                    sign = (cls[0] if x < 0 else 1) * (cls[1] if y < 0 else 1)
                    for q in range(2):
                        phase = np.exp(1j * (kx * x * c.x[q] + ky * y * c.y[q]))
                        slope = 1j * (kx * x * c.nx[q] + ky * y * c.ny[q]) * phase
                        rows = np.concatenate([flow.velocity[:, :, n], sides[n]])  # (profiles and side, functions)
                        speed = (rows @ wave.basis[q]) @ (kappa * np.arange(1.0, 5.0))
                        psi = (kappa + np.arange(3.0)) @ amplitudes[cls][:3, q, n]
                        total += sign * c.weights[q] * (phase * speed - slope * psi)
                assert found[w, dof] == pytest.approx(-1000.0 * G * total)


def test_pressures_ask_more_of_every_part_of_a_body():
    """Twice the digits of the functions and one more at least, modes of two digits more, four polynomials"""
    body = prepare_box(20.0, 10.0, 3.0, 8.0, 1e-3)
    ours, found = body.accuracy, refined(body)
    twice, further = (accuracy(digits, 3.0, 5.0, 5.0) for digits in (2 * ours.digits, ours.digits + 2))
    assert found.accuracy == ours._replace(
        terms=max(ours.terms + 1, twice.terms), modes=further.modes, smallest=min(ours.smallest, 1e-9 / height(5, 5)),
        kappa=ours.kappa + 3 / KAPPA, plan=ours.plan + 1, extra=ours.extra + 4,
    )  # fmt: skip
    assert found.plan == body.plan.to(found.accuracy) and (found.draft, found.depth) == (3.0, 8.0) and not found.cache
    for depth, told, wanted in ((8.0, 1e-6, 2e-5), (103.0, 1e-6, 2e-5 * 5.0), (8.0, 3e-5, 3e-5)):
        deep = SimpleNamespace(depth=depth, draft=3.0, plan=body.plan)
        run = SimpleNamespace(prepared=SimpleNamespace(solver=deep), estimated_error=lambda told=told: told)
        assert pressure_error(run) == pytest.approx(wanted)


@pytest.mark.parametrize("draft, depth, count", [(5.0, 12.0, 4584), (0.5, 12.0, 20000), (0.05, 12.0, 152789)])
def test_modes_beside_the_keel_are_for_a_hundredth_of_draft_or_gap(draft, depth, count):
    """60 h/π over 0.01 of it; not more than 20 000 where a thirtieth suffices with them"""
    asked, gap = [], SimpleNamespace(draft=draft, height=depth - draft, depth=depth)
    modes = SimpleNamespace(wavenumbers=np.array([0.5]), norms=np.array([2.0]), rows=np.array([[1.0], [3.0]]))
    gap.outer_modes = lambda omega, count, gravity: asked.append(count) or modes
    profiles = SimpleNamespace(gap=gap, combinations=np.array([[1.0, 2.0]]))
    nodes = SimpleNamespace(weights=lambda k: np.array([[4.0, 6.0]]))
    body = SimpleNamespace(profiles=profiles, nodes=lambda top: nodes)
    made = _DepthModes.of(SimpleNamespace(body=body, omega=1.0, gravity=9.81, top=None))
    most, least = (int(np.ceil(60 * depth / (np.pi * part * min(draft, depth - draft)))) for part in (0.01, 0.03))
    assert asked == [min(most, max(least, 20000))] == [count]
    assert made.table.tolist() == [[4.0, 6.0]] and made.rows.tolist() == [[7.0]]


def test_the_flow_on_a_side_is_that_of_the_edge_up_to_four_lengths_of_its_last_mode(monkeypatch):
    """60 h/π over the number of modes; farther up point by point to the surface, where the draft is the distance"""
    from hakobune.bem.contour import side_flow

    asked, modes = {}, SimpleNamespace(gap=SimpleNamespace(draft=5.0, depth=12.0),
                                       outer=SimpleNamespace(wavenumbers=np.ones(3000)))  # fmt: skip
    near = [np.array([0.1]), np.array([0.2]), np.array([[1.0, 2.0]]), np.array([[3.0, 4.0]])]

    def at_keel(modes, start, end):
        asked["keel"] = start, end
        return near, "keel"

    def distances(start, draft, surface):
        asked["distances"] = start, draft, surface
        return np.array([1.0, 4.0]), np.array([0.5, 0.6])

    modes.flow = lambda r: (np.outer(r, [1.0, 10.0]), np.outer(r, [5.0, 7.0]))
    monkeypatch.setattr(side_flow._DepthModes, "of", classmethod(lambda cls, freq: modes))
    monkeypatch.setattr(side_flow, "_at_keel", at_keel)
    monkeypatch.setattr(side_flow, "_distances", distances)
    found = side_flow.depth_flow("freq", 2.5)
    start = 60 * 12.0 / (np.pi * 3000)
    assert asked == {"keel": pytest.approx((start, 4 * start)), "distances": (pytest.approx(4 * start), 5.0, 2.5)}
    assert found.r.tolist() == [0.1, 1.0, 4.0] and found.weights.tolist() == [0.2, 0.5, 0.6]
    assert found.value.tolist() == [[1, 2], [1, 10], [4, 40]] and found.slope.tolist() == [[3, 4], [5, 7], [20, 28]]
    assert found.top.tolist() == [5.0, 50.0] and found.keel == "keel"


def test_modes_are_summed_to_where_they_have_decayed_beside_keel_and_surface():
    """At r from the keel, or z from the surface, a fiftieth of the draft at least; cut smoothly"""
    from hakobune.bem.contour.side_flow import _DepthModes
    from hakobune.bem.depth_modes.gap import smooth_cutoff
    from hakobune.bem.waves import depth_factor, depth_factor_slope

    count = 2000
    rng = np.random.default_rng(2)
    n = np.arange(1, count + 1)
    kn, table, rows = n * np.pi / 12.0, rng.normal(size=(count, 2)) / n[:, None] ** 3, rng.normal(size=(count, 3))
    gap = SimpleNamespace(draft=5.0, depth=12.0)
    made = _DepthModes(gap, SimpleNamespace(k=0.3, wavenumbers=kn), table, rows)
    r = np.array([0.5, 2.5, 4.0, 4.99])
    value, slope = made.flow(r)
    assert value.shape == slope.shape == (4, 3 + 6)
    for q, distance in enumerate(r):
        z = distance - 5.0
        beside = min(distance, max(-z, 0.02 * 5.0))
        few = min(count, int(np.ceil(60 * 12.0 / (np.pi * beside))))
        cut = smooth_cutoff(np.arange(1, few + 1) / few)
        for found, mode, wave in ((value, np.cos(kn * (z + 12)), depth_factor(z, 0.3, 12.0)),
                                  (slope, -kn * np.sin(kn * (z + 12)), depth_factor_slope(z, 0.3, 12.0))):  # fmt: skip
            assert found[q, 0] == pytest.approx(wave) and not found[q, -2:].any()
            whole = np.einsum("n,nc,nr->cr", cut * mode[:few], table[:few], rows[:few])
            assert found[q, 1:-2].reshape(2, 3) == pytest.approx(whole, rel=1e-9, abs=1e-12)
