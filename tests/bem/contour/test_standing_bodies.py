"""Boxes and cylinders on the bed: MacCamy and Fuchs, Linton and Evans, Evans and Porter, laws beside floating ones."""

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, jvp

from hakobune.bem.contour.several.bodies import prepare_several
from hakobune.bem.contour.several.exterior import Place
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.transfer.far_bodies import prepare_far
from hakobune.bem.waves import wavenumber

G, RHO, DEPTH, OMEGA = 9.80665, 1025.0, 12.0, 1.1
K = float(wavenumber(OMEGA, DEPTH, G))


def held(body, headings=(0.0,)):
    """(m, 6N) exciting forces"""
    found = body.first_order(OMEGA, headings, (), density=RHO, gravity=G)
    return found.froude_krylov + found.diffraction


def on_one(radius, k=K, depth=DEPTH):
    """N/m along the wave, by MacCamy and Fuchs (1954): 4ρg tanh kh / (k² H₁'(ka))"""
    return 4 * RHO * G * np.tanh(k * depth) / (k**2 * h1vp(1, k * radius))


def on_each(places, radii, k, beta, orders=14):
    """(N, 2) complex N/m per m on cylinders from bed to surface, by C. M. Linton and D. V. Evans (1990)

    φ about j: Σ A_n^j (Zₙ Hₙ(kr) − Jₙ(kr)) exp(inθ), Zₙ = Jₙ'(ka)/Hₙ'(ka), of unit length over the depth
    """
    n, N = np.arange(-orders, orders + 1), len(places)
    Z = np.array([jvp(n, k * a) / h1vp(n, k * a) for a in radii])
    size, matrix, right = len(n), np.eye(N * len(n), dtype=complex), []
    for j in range(N):
        right.append(-np.exp(1j * k * (places[j] * np.exp(-1j * beta)).real) * np.exp(1j * n * (np.pi / 2 - beta)))
        for i in range(N):
            if i != j:
                there = places[j] - places[i]
                m = n[None] - n[:, None]
                seen = hankel1(m, k * abs(there)) * np.exp(1j * m * np.angle(there))
                matrix[j * size : (j + 1) * size, i * size : (i + 1) * size] = seen * Z[i]
    A = np.linalg.solve(matrix, np.concatenate(right)).reshape(N, size)
    low, high = A[:, orders - 1], A[:, orders + 1]
    scale = [RHO * G * np.tanh(k * DEPTH) / k * 2j / (k * h1vp(1, k * a)) for a in radii]
    return np.stack([(high - low) * scale, 1j * (high + low) * scale], axis=1)


def test_the_force_on_one_cylinder_is_that_of_maccamy_and_fuchs():
    X = held(prepare_cylinder(5.0, DEPTH, DEPTH))[0]
    arm = -(1 - 1 / np.cosh(K * DEPTH)) / (K * np.tanh(K * DEPTH))  # m, ∫z cosh k(z+h) dz over ∫cosh k(z+h) dz
    assert X[0] == pytest.approx(on_one(5.0), rel=1e-12)
    assert X[4] == pytest.approx(arm * on_one(5.0), rel=1e-12) and X[2] == 0


def test_the_arms_of_a_box_are_those_of_its_walls_in_any_wave():
    """Heave has no face to press on, and pitch has the same pressure over the height as surge"""
    X = held(prepare_box(20.0, 10.0, DEPTH, DEPTH), [0.3])[0]
    fk = prepare_box(20.0, 10.0, DEPTH, DEPTH).froude_krylov(OMEGA, [0.3], range(6), RHO, G)[0]
    assert X[2] == fk[2] == 0
    assert fk[4] / fk[0] == pytest.approx(-fk[3] / fk[1]) and (X[4] / X[0]).real < 0


@pytest.mark.parametrize("prepare", [prepare_several, prepare_far])
def test_cylinders_of_two_sizes_are_those_of_linton_and_evans(prepare):
    places, radii = [0.0, 14.0 + 3.0j, 2.0 - 13.0j], [5.0, 3.0, 5.0]
    shapes = [("buoy", (a, DEPTH)) for a in radii]
    X = held(prepare(shapes, [Place(z.real, z.imag, 0.0) for z in map(complex, places)], DEPTH, 1e-5), [0.4])[0]
    known = on_each(np.array(places, complex), radii, K, 0.4)
    assert np.abs(X.reshape(3, 6)[:, :2] - known).max() < 2e-5 * np.abs(known).max()


@pytest.mark.parametrize(("prepare", "tolerance"), [(prepare_several, 1e-4), (prepare_far, 1e-3)])
def test_a_square_of_four_is_nearly_trapped_where_evans_and_porter_find_it(prepare, tolerance):
    """a/d 0.8: 54 times the force on one at ka 4.0848 (D. V. Evans and R. Porter, J. Eng. Math. 1997)"""
    depth, d = 3.0, 1.25
    bodies = prepare([("buoy", (1.0, depth))] * 4, [Place(x, y, 0.0) for x in (-d, d) for y in (-d, d)], depth, 1e-3)

    def largest(ka):
        found = bodies.first_order(np.sqrt(G * ka * np.tanh(ka * depth)), [np.pi / 4], (), None, RHO, G)
        X = (found.froude_krylov + found.diffraction)[0].reshape(4, 6)
        return np.hypot(*np.abs(X[:, :2].T)).max() / abs(on_one(1.0, ka, depth))

    assert largest(4.08482) == pytest.approx(54.22, rel=tolerance)
    assert max(largest(4.0847), largest(4.0849)) < 0.85 * largest(4.08482)


@pytest.mark.parametrize("prepare", [prepare_several, prepare_far])
def test_laws_of_a_box_afloat_beside_a_caisson_and_a_pile(prepare):
    shapes = [("box", (10.0, 8.0, 4.0)), ("box", (9.0, 9.0, DEPTH)), ("buoy", (2.0, DEPTH))]
    bodies = prepare(shapes, [Place(0, 0, 0.3), Place(1, -16, 0), Place(12, 4, 0)], DEPTH, 1e-2)
    found = bodies.first_order(OMEGA, [0.4], np.linspace(0, 2 * np.pi, 40, endpoint=False), None, RHO, G)
    X, Z = found.froude_krylov + found.diffraction, found.radiation
    assert np.abs(X - found.haskind).max() < 3e-4 * np.abs(X).max()
    assert np.abs(Z - Z.T).max() < 3e-4 * np.abs(Z).max()
    assert np.all(X[:, [8, 14]] == 0) and not Z[[8, 14]].any()  # heave on the bed
    zero = bodies.added_mass_limit("zero")
    assert np.isinf(zero[2, 2]) and np.isfinite(zero[8:]).all()


def test_a_body_over_a_closing_gap_becomes_one_on_the_bed():
    """The forces on a buoy beside it, of a fixed cylinder with 0.3 and with 0.03 m of water under it"""
    places = [Place(0, 0, 0), Place(0, 12, 0)]

    def forces(draft):
        return held(prepare_far([("buoy", (4.0, 3.0)), ("buoy", (5.0, draft))], places, DEPTH, 1e-3), [0.9])[0, :6]

    on_bed = forces(DEPTH)
    off = [np.abs(forces(DEPTH - gap) - on_bed).max() / np.abs(on_bed).max() for gap in (0.3, 0.03)]
    assert off[1] < 0.2 * off[0] < 0.02, off
