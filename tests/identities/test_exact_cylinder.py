"""The floating cylinder by matched eigenfunctions: laws, limits and an independent plain expansion."""

import csv
from functools import lru_cache
from math import ceil
from pathlib import Path

import numpy as np
import pytest
from exact import maccamy_fuchs
from exact.gap_modes import beyond, closed_sums, moments
from exact.truncated_cylinder import TruncatedCylinder
from exact.water_waves import cosh_ratio, group_factor
from scipy.special import h1vp, hankel1, ive, kve

G = 9.80665
# radius, draft, depth, omega
CASES = [
    (10, 10, 30, 0.8),
    (10, 10, 10.2, 0.8),
    (10, 10, 100, 1.4),
    (10, 1, 2, 0.3),
    (50, 10, 12, 1.5),
    (1, 10, 20, 1.0),
    (10, 10, 12, 0.045),  # kh = 0.05
    (30, 10, 40, 2.2),  # kh = 20
]


def published_table(name):
    """Rows of a table of tests/published as dictionaries of numbers"""
    text = (Path(__file__).parent.parent / "published" / name).read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return [{key: float(value) for key, value in row.items()} for row in rows]


@lru_cache(maxsize=64)
def cylinder(case, **accuracy):
    radius, draft, depth, omega = case
    return TruncatedCylinder(radius, draft, depth, omega, gravity=G, **accuracy)


def floating(body):
    """Inertia and stiffness of a body with its centre of gravity in the waterplane and gyration 0.6 a"""
    a, d = body.radius, body.draft
    mass = body.density * np.pi * a**2 * d
    inertia = np.diag(mass * np.array([1, 1, 1, 0.36 * a**2, 0.36 * a**2, 0.5 * a**2]))
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = body.density * G * np.pi * a**2
    stiffness[3, 3] = stiffness[4, 4] = body.density * G * np.pi * a**2 * max(a**2 / 4 - d**2 / 2, a**2 / 40)
    return inertia, stiffness


def scale(body):
    """Size of every entry of a 6 × 6 matrix by its dimension"""
    arm = np.array([1, 1, 1, *[max(body.radius, body.draft)] * 3])
    return body.density * np.pi * body.radius**2 * body.draft * np.outer(arm, arm)


@pytest.mark.parametrize("case", CASES)
def test_more_functions_and_modes_change_nothing_that_matters(case):
    usual, fine = cylinder(case), cylinder(case, terms=28, modes=150)
    for name in ("added_mass", "damping"):
        np.testing.assert_allclose(
            getattr(usual, name)(), getattr(fine, name)(), rtol=1e-6, atol=1e-9 * scale(usual).max()
        )
    np.testing.assert_allclose(usual.excitation(0.4), fine.excitation(0.4), rtol=1e-6)
    np.testing.assert_allclose(usual.drift_fixed(0.4), fine.drift_fixed(0.4), rtol=1e-6)
    given = floating(usual)  # in long waves it follows the water and its drift is a small difference
    small = 1e-6 * np.abs(usual.drift_fixed(0.4)).max()
    np.testing.assert_allclose(usual.drift_free(0.4, *given), fine.drift_free(0.4, *given), rtol=1e-6, atol=small)


@pytest.mark.parametrize("case", CASES)
def test_coupling_is_reciprocal(case):
    body = cylinder(case)
    for matrix in (body.added_mass(), body.damping() / body.omega):
        assert np.abs(matrix - matrix.T).max() < 1e-8 * np.abs(matrix).max()


@pytest.mark.parametrize("case", CASES)
def test_exciting_force_is_the_radiated_wave_by_haskind(case):
    """F(β) = −4 ρ g C_g H(β + π) / k, H per unit velocity, of waves sent against the incident one"""
    body, beta = cylinder(case), 0.7
    group = group_factor(body.k, body.depth) * body.omega / body.k
    against = body.kochin_radiation(np.array([beta + np.pi]))[:, 0]
    haskind = -4 * body.density * G * group / body.k * against
    np.testing.assert_allclose(body.excitation(beta), haskind, rtol=1e-8, atol=1e-12 * np.abs(haskind).max())


@pytest.mark.parametrize("case", CASES)
def test_damping_is_the_energy_of_the_radiated_waves(case):
    body = cylinder(case)
    theta = np.arange(8) * 2 * np.pi / 8  # exact for the products of two harmonics
    waves = body.kochin_radiation(theta)
    group = group_factor(body.k, body.depth) * body.omega / body.k
    power = 2 * body.density * G * group / (np.pi * body.k) * (waves @ waves.conj().T).real * 2 * np.pi / 8
    assert np.abs(body.damping() - power).max() < 1e-8 * np.abs(power).max()


@pytest.mark.parametrize("case", CASES)
def test_waves_of_a_fixed_or_floating_body_take_their_energy_from_the_incident_one(case):
    """(1/2π) ∫ |H|² dθ = −Re H(β)"""
    body, beta = cylinder(case), 0.3
    count = 4 * body.orders + 4
    theta = beta + np.arange(count) * 2 * np.pi / count
    fixed = body.kochin_diffraction(beta, theta)
    velocity = -1j * body.omega * body.motions(beta, *floating(body))
    for waves in (fixed, fixed + velocity @ body.kochin_radiation(theta)):
        assert np.mean(np.abs(waves) ** 2) == pytest.approx(-waves[0].real, rel=1e-7)


@pytest.mark.parametrize("case", CASES)
def test_turning_the_wave_turns_the_forces(case):
    body, turn = cylinder(case), 1.1
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.kron(np.eye(2), [[c, -s, 0], [s, c, 0], [0, 0, 1]])
    np.testing.assert_allclose(body.excitation(0.2 + turn), rotation @ body.excitation(0.2), rtol=1e-9, atol=1e-6)
    given = floating(body)
    np.testing.assert_allclose(
        body.drift_free(0.2 + turn, *given), rotation[:2, :2] @ body.drift_free(0.2, *given), rtol=1e-7
    )


@pytest.mark.parametrize("omega", [0.3, 1.0, 2.0])
def test_closing_the_gap_gives_the_cylinder_on_the_bed(omega):
    """Side forces tend to those of MacCamy and Fuchs, steadily with the gap."""
    a, h = 5.0, 10.0
    force, mean = maccamy_fuchs.excitation(a, h, omega), maccamy_fuchs.drift(a, h, omega)
    mass, damping = maccamy_fuchs.surge_radiation(a, h, omega)
    errors = []
    for gap in (0.1, 0.01):
        body = cylinder((a, h - gap, h, omega), modes=8)
        errors.append(
            [
                abs(body.excitation(0.0)[0] / force[0] - 1),
                abs(body.drift_fixed(0.0)[0] / mean[0] - 1),
                abs(body.added_mass()[0, 0] / mass - 1),
                abs(body.damping()[0, 0] / damping - 1),
            ]
        )
    assert np.all(np.array(errors[1]) < 0.01), errors
    assert np.all(np.array(errors[1]) < 0.2 * np.array(errors[0])), errors


def test_a_film_under_the_keel_flows_as_lubrication_says():
    """Film s thin under radius a: φ = (a² − r²)/4s, so s A₃₃ tends to ρ π a⁴/8."""
    gaps, a = (0.02, 0.01), 4.0
    film = [s * cylinder((a, 1.0, 1 + s, 1.0)).added_mass()[2, 2] / 1025.0 for s in gaps]
    limit = np.pi * a**4 / 8
    errors = np.abs(np.array(film) - limit)
    assert errors[1] < errors[0] < 0.2 * limit
    assert errors[1] / errors[0] < 0.6  # of first order in the gap, apart from its logarithm


def test_long_waves_lift_like_water_standing_higher():
    body = cylinder((10, 5, 20, 1e-3))
    assert body.excitation(0.0)[2] == pytest.approx(body.density * G * np.pi * 100, rel=1e-3)


def test_long_waves_push_with_the_displaced_and_the_added_mass():
    """G. I. Taylor: in a wave much longer than the body F₁ = (ρV + A₁₁) × acceleration."""
    body = cylinder((1.0, 0.2, 100.0, 0.2), modes=8)
    acceleration = -1j * G * body.k  # −∂p/∂x / ρ at the origin
    mass = body.density * np.pi * 0.2 + body.added_mass()[0, 0]
    assert body.excitation(0.0)[0] == pytest.approx(mass * acceleration, rel=5e-3)


def test_a_deeper_bed_is_felt_less():
    """Far from the body its image in the bed is a dipole or weaker: the effect falls at least like h⁻³."""
    masses = [cylinder((10, 10, h, 1.2)).added_mass()[2, 2] for h in (50, 100, 200)]
    assert abs(masses[2] - masses[1]) < abs(masses[1] - masses[0]) / 8


@pytest.mark.parametrize("row", published_table("truncated_cylinder_wamit.csv"), ids=lambda row: f"{row['period']:g}")
def test_coefficients_and_forces_are_those_of_a_published_run_of_wamit(row):
    """Its flat panels are 0.05 m wide at the edge of a radius of 0.35 m: added mass comes out up to 3.5 % too large,
    which the fixed hull feels less, and phases are printed as whole degrees of exp(+iωt)."""
    body = TruncatedCylinder(0.35, 0.63, 3.0, 2 * np.pi / row["period"], density=1.0, gravity=9.81)
    Z = body.added_mass() + 1j * body.damping() / body.omega
    for name, i, j in (("11", 0, 0), ("33", 2, 2), ("55", 4, 4), ("15", 0, 4)):
        theirs = row[f"A{name}"] + 1j * row[f"B{name}"]
        assert abs(theirs - Z[i, j]) < 0.035 * np.sqrt(abs(Z[i, i] * Z[j, j])), name
    force = body.excitation(0.0) / 9.81
    for d in (0, 2, 4):
        assert row[f"X{d + 1}"] == pytest.approx(abs(force[d]), rel=0.025 if d == 2 else 0.01), d
        turn = (row[f"phase{d + 1}"] + np.degrees(np.angle(force[d])) + 180) % 360 - 180
        assert abs(turn) < 1.5, d


def plain_heave(body, count):
    """A₃₃ + iB₃₃/ω by cosines alone under the body, forces by integrating the pressure on the bottom."""
    a, h, s, k = body.radius, body.depth, body.gap.height, body.k
    outer = int(count * h / s)
    kn = body.gap.outer_wavenumbers[:outer]
    l = np.arange(count) * np.pi / s
    with np.errstate(divide="ignore", invalid="ignore"):
        x = l * a
        slope = np.where(l > 0, l * ive(1, x) / ive(0, x), 0.0)  # 1 / T_q
        over = np.where(l > 0, a * ive(1, x) / (l * ive(0, x)), a * a / 2)  # ∫ I₀(lr)/I₀(la) r dr
    wave = np.concatenate([[hankel1(0, k * a) / (k * h1vp(0, k * a))], -kve(0, kn * a) / (kn * kve(1, kn * a))])
    norm = np.concatenate([[body.gap.wave_norm], h / 2 * (1 + np.sin(2 * kn * h) / (2 * kn * h))])
    z, weight = np.polynomial.legendre.leggauss(3 * outer + 50)
    z, weight = s * (z + 1) / 2, s / 2 * weight
    Z = np.vstack([cosh_ratio(z, k, h), np.cos(np.multiply.outer(kn, z))])
    cosines = np.cos(np.multiply.outer(l, z))
    mixed, mean = (Z * weight) @ cosines.T, Z @ weight
    size = np.where(l > 0, s / 2, s)
    known = (cosines * weight) @ (z**2 - a * a / 2) / (2 * s)
    outside = mixed.T * (wave / norm)
    matrix = np.diag(size).astype(complex) - (outside @ mixed) * slope
    q = np.linalg.solve(matrix, outside @ (-a / (2 * s) * mean) - known)
    bottom = (s * s * a * a / 2 - a**4 / 8) / (2 * s) + (q * (-1.0) ** np.arange(count)) @ over
    return body.density * 2 * np.pi * bottom


@pytest.mark.parametrize("case", [(10, 10, 30, 0.8), (20, 10, 14, 0.6)])
def test_plain_cosines_converge_to_it_at_order_four_thirds(case):
    """The corner leaves the classical method (Garrett, Yeung) an error like N^(−4/3)."""
    body = cylinder(case)
    exact = body.added_mass()[2, 2] + 1j * body.damping()[2, 2] / body.omega
    errors = [abs(plain_heave(body, n) / exact - 1) for n in (10, 20, 40)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert errors[-1] < 40 ** (-4 / 3)
    assert np.all(orders > 1.2), (errors, orders)


@pytest.mark.parametrize("share", [1.0, 2 / 3, 0.02])
def test_closed_sums_of_products_of_moments_are_what_their_series_tend_to(share):
    """With moments like q^(−2/3) the rest beyond N falls like N^(−4/3), and with 1/q² like N^(−7/3)."""
    rests = np.array([[part[0, 0] for part in beyond(ceil(n / share), share, 8)[1:]] for n in (100, 800)])
    np.testing.assert_allclose(np.log(rests[0] / rests[1]) / np.log(8), [4 / 3, 7 / 3], atol=0.02)
    _, *all_rests = beyond(ceil(800 / share), share, 8)
    for rest, whole in zip(all_rests, closed_sums(share, 8), strict=True):
        assert np.abs(rest).max() < 800 ** (-4 / 3) * np.abs(whole).max()


def test_moments_of_velocities_that_are_constant_or_parabolic_in_the_gap_are_elementary():
    """∫₀¹ cos xζ dζ = sin x / x and that of ζ² cos xζ, by τ and τ (1 − τ³)² of the functions"""
    tau, weight = np.polynomial.legendre.leggauss(20)
    tau, weight = (tau + 1) / 2, weight / 2
    P = np.polynomial.legendre.legvander(2 * tau - 1, 11) * np.sqrt(2 * np.arange(12) + 1)
    x = np.array([0.3, 2.0, 40.0, 250.0, 3000.0])
    one, square = (np.array([tau, tau * (1 - tau**3) ** 2]) * weight) @ P @ moments(x, 12)
    np.testing.assert_allclose(one, np.sin(x) / x, atol=1e-13)
    np.testing.assert_allclose(square, np.sin(x) / x + 2 * np.cos(x) / x**2 - 2 * np.sin(x) / x**3, atol=1e-13)


def test_what_it_cannot_compute_is_refused():
    with pytest.raises(ValueError, match="draft 10"):
        cylinder((5, 10, 10, 1.0))
    with pytest.raises(ValueError, match="depth inf"):
        cylinder((5, 10, np.inf, 1.0))
    with pytest.raises(ValueError, match="radius"):
        cylinder((0, 10, 20, 1.0))
    with pytest.raises(ValueError, match="omega"):
        cylinder((5, 10, 20, 0.0))
