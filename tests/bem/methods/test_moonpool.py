"""Water in a moonpool beside an expansion in eigenfunctions of a ring, and the search for its largest rise."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from scipy.special import hankel1, ive, jv, kve

from hakobune.bem.methods import moonpool
from hakobune.bem.methods.moonpool import piston
from hakobune.meshing.drawing import read_drawing
from hakobune.meshing.surface.patches import counter_clockwise, moonpools

G = 9.81
RING = """
size = 1.0
symmetry = "xy"
around = 32
[[parts]]
shape = "cylinder"
from = [0, 0, -2]
to = [0, 0, 2]
radius = 4
[[parts]]
shape = "cylinder"
from = [0, 0, -4]
to = [0, 0, 4]
radius = 2
cut = true
"""
WIDE = """
size = 3.0
symmetry = "xy"
[[parts]]
shape = "box"
center = [0, 0, 0]
size = [60, 60, 10]
[[parts]]
shape = "box"
center = [0, 0, 0]
size = [8, 8, 20]
cut = true
"""


def rise_in_ring(omega, depth, a=2.0, b=4.0, draft=2.0, gap_modes=20, modes=40):
    """Mean rise inside a held ring a < r < b per unit amplitude of the wave, by matching at r = a and r = b

    Only the part without angle counts.  Inside and outside φ = Σ Rₙ(r) cos kₙ(z + h), k₀ = −ik; under the ring Σ
    (I₀ and K₀ of λ_q r) cos λ_q(z + h), λ_q = qπ/(h − d).
    """
    K, h, s = omega**2 / G, depth, depth - draft
    k = brentq(lambda k: k * np.tanh(k * h) - K, 1e-9, 10 * max(K, 1 / h) + 10)
    ends = np.arange(1, modes) * np.pi / h
    decaying = [brentq(lambda k: k * np.sin(k * h) + K * np.cos(k * h), e - np.pi / 2 / h, e) for e in ends]
    n, decaying = np.array([-1j * k, *decaying])[:, None], np.array(decaying)
    norm = np.sqrt(0.5 * (h + np.sin(2 * n * h) / (2 * n)))
    lam = np.arange(gap_modes) * np.pi / s
    size = np.where(lam > 0, np.sqrt(2 / s), np.sqrt(1 / s))
    C = np.cos(lam * s) * n * np.sin(n * s) / (n**2 - lam**2) * size / norm
    outer = np.array(
        [-k * hankel1(1, k * b) / hankel1(0, k * b), *(-decaying * kve(1, decaying * b) / kve(0, decaying * b))]
    )
    inner = np.array([-k * jv(1, k * a) / jv(0, k * a), *(decaying * ive(1, decaying * a) / ive(0, decaying * a))])
    slopes = np.empty((gap_modes, 2, 2))  # of φ at a and b from its values there
    slopes[0] = np.array([[-1 / a, 1 / a], [-1 / b, 1 / b]]) / np.log(b / a)
    for q, m in enumerate(lam[1:], 1):
        x, fall = m * np.array([a, b]), np.exp(-m * (b - a))
        I, II, L, LL = ive(0, x), ive(1, x), kve(0, x), kve(1, x)
        values = np.array([[I[0] * fall, L[0]], [I[1], L[1] * fall]])
        slopes[q] = m * np.array([[II[0] * fall, -LL[0]], [II[1], -LL[1] * fall]]) @ np.linalg.inv(values)
    wave = np.zeros(modes, complex)
    wave[0] = -1j * G / omega * norm[0, 0] / np.cosh(k * h)
    coming = C.T @ (wave * (jv(0, k * b) + k * jv(1, k * b) / outer))
    one, two = C.T @ (C / inner[:, None]), C.T @ (C / outer[:, None])
    E, D = np.eye(gap_modes), slopes.transpose(1, 2, 0)
    matrix = np.block([[E - one * D[0, 0], -one * D[0, 1]], [-two * D[1, 0], E - two * D[1, 1]]])
    at = np.linalg.solve(matrix, np.concatenate([np.zeros(gap_modes), coming]))
    flow = C @ (D[0, 0] * at[:gap_modes] + D[0, 1] * at[gap_modes:])
    return omega / G * abs((2 / a * flow / n[:, 0] ** 2 * (np.cos(n * h) / norm)[:, 0]).sum())


@pytest.fixture(scope="module")
def ring(tmp_path_factory):
    path = tmp_path_factory.mktemp("ring") / "ring.toml"
    path.write_text(RING)
    mesh = read_drawing(path)
    (corners,) = moonpools(mesh)
    return mesh, counter_clockwise(corners)


@pytest.mark.parametrize(("depth", "formula"), [(9.0, 1.68), (2.4, 1.68)])
def test_the_water_of_a_ring_rises_as_by_eigenfunctions(ring, depth, formula):
    """In 9 m 7.9 times the wave at 1.717 rad/s, over a gap of a fifth of the draft 7.3 times at 1.18 rad/s"""
    mesh, corners = ring
    found = piston(mesh, corners, depth, np.array([0.0, 0.7]), formula, G)
    around = (0.97 * found.omega, 1.03 * found.omega)
    exact = minimize_scalar(lambda w: -rise_in_ring(w, depth), bounds=around, method="bounded", options={"xatol": 2e-3})
    assert found.omega == pytest.approx(exact.x, rel=0.03)
    assert found.rise == pytest.approx(-exact.fun, rel=0.06)


def test_a_square_moonpool_in_a_wide_barge_has_the_period_of_molin(tmp_path):
    """Deep water, endless barge, side b: ω² = g / (d + b f), f = (2 asinh 1 + 2/3 − 2√2/3) / π (Molin, J. Fluid Mech.
    430, 2001, piston mode with one mode); here a barge of 7.5 b"""
    (tmp_path / "wide.toml").write_text(WIDE)
    mesh = read_drawing(tmp_path / "wide.toml")
    (corners,) = moonpools(mesh)
    found = piston(mesh, counter_clockwise(corners), np.inf, np.array([0.0]), 1.09, G)
    f = (2 * np.arcsinh(1) + 2 / 3 - 2 * np.sqrt(2) / 3) / np.pi
    assert found.omega == pytest.approx(np.sqrt(G / (5 + 8 * f)), rel=0.01)


def test_the_largest_rise_is_found_in_few_frequencies():
    """A mass on a spring at 1.21 rad/s that rises 40 times the wave, 0.9 rad/s by the formula"""
    asked = []

    def rise(omega):
        asked.append(omega)
        return np.array([0.5, 1.0]) * 1.21**2 / (1.21**2 - omega**2 - 1j * 1.21 * omega / 40)

    omega, size = moonpool._largest(rise, 1.05)
    assert omega == pytest.approx(1.21, rel=2e-3) and size == pytest.approx(40, rel=0.01) and len(asked) <= 6
    assert asked[:3] == pytest.approx([1.05 * 0.8, 1.05 * 0.95, 1.05 * 1.05])
    assert moonpool._largest(rise, 3.0) is None


@pytest.mark.parametrize(
    "own, found", [(0.52, True), (0.7, True), (1.0, True), (1.28, True), (1.6, False), (0.35, False)]
)
def test_a_rise_is_one_within_half_and_thirteen_tenths_of_the_frequency_it_is_sought_near(own, found):
    """1/rise of a mass on a spring, 1 − (ω/ω₀)² − 0.05i; where it is largest at an end there is no peak"""

    def rise(omega):
        return np.array([0.5, 1.0]) / (1 - (omega / (2.0 * own)) ** 2 - 0.05j)

    answer = moonpool._largest(rise, 2.0)
    assert (answer is not None) is found
    if found:
        assert answer[0] == pytest.approx(2.0 * own, rel=5e-3) and answer[1] == pytest.approx(20.0, rel=0.02)


def test_the_next_frequency_is_where_the_parabola_of_one_over_the_rise_is_least():
    """Of the heading that rises most at the largest; s = (ω/near)² from 0.25 to 1.69 in steps of 7.2e-4"""
    omegas = [1.6, 1.9, 2.1]
    values = [np.array([1 / (3 - 2 * (w / 2) ** 2 * 1.7 - 0.1j), 0.01]) for w in omegas]
    found = moonpool._next(omegas, values, 2.0)
    assert (found / 2.0) ** 2 == pytest.approx(3 / 3.4, abs=1e-3)
