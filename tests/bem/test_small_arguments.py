"""Series that stand for a quotient where it would cancel, against integrals by Gauss's rule, which do not cancel."""

import numpy as np
import pytest
from retardation import fourier_weights

from hakobune.bem.database.between_headings import ENDS, NEAR, _side
from hakobune.bem.froude_krylov import box_incident_force, first_moment

NODES, WEIGHTS = np.polynomial.legendre.leggauss(30)


def integral(f, low, high):
    """∫ f dx of a smooth function of an array, exact to rounding"""
    half = 0.5 * (high - low)
    return half * WEIGHTS @ f(0.5 * (low + high) + half * NODES)


@pytest.mark.parametrize("x", [1e-6, 0.1, 0.3, 0.49, 0.4999, 0.5001, 2.0, -0.4])
def test_the_first_moment_of_a_wave_is_its_integral_on_both_sides_of_the_switch(x):
    """∫₀¹ t sin xt dt: the last coefficient of the series counts 1e-11 of it at 0.5, the first one all of it"""
    assert float(first_moment(x)) == pytest.approx(integral(lambda t: t * np.sin(x * t), 0.0, 1.0), rel=1e-14, abs=0)


@pytest.mark.parametrize("turn", [2e-4, 5e-4, 9.9e-4, 1.1e-3, 0.02, 0.5])
def test_weights_of_a_slow_wave_are_the_integrals_of_hats(turn):
    """∫ f exp(iωx) dx over one interval, f falling from 1 to 0 and rising from 0 to 1; what the series leaves out is
    ω³/30 of 1e-9 ω, below 4e-11"""
    falling, rising = fourier_weights(turn, np.array([0.0, 1.0]))[0]
    assert rising == pytest.approx(integral(lambda x: x * np.exp(1j * turn * x), 0.0, 1.0), abs=1e-10)
    assert falling == pytest.approx(integral(lambda x: (1 - x) * np.exp(1j * turn * x), 0.0, 1.0), abs=1e-10)


@pytest.mark.parametrize("x", [1e-8, 0.5 * NEAR, 0.999 * NEAR, 1.001 * NEAR, 0.3])
def test_the_plan_of_a_body_between_near_headings_has_its_closed_form(x):
    """(1 − e) sin x / x + e cos x, of which x²/6 is 1.7e-9 at the switch"""
    found = _side(np.array([[x]]), np.array([[0.0]]))[0, 0, 0]
    assert found == pytest.approx((1 - ENDS) * np.sinc(x / np.pi) + ENDS * np.cos(x), rel=1e-14, abs=0)


def test_the_undisturbed_wave_on_a_box_is_the_integral_of_its_pressure():
    """−∬ Z₀ exp(ik(x cosβ + y sinβ)) (n, r × n) dS over the five wet faces by Gauss's rule; depth of half a wave"""
    length, beam, draft, depth, k, beta = 40.0, 12.0, 6.0, 14.0, 0.11, 0.7
    a, b = length / 2, beam / 2
    faces = [  # fixed axis, its value, outward normal, ranges of the two others
        (0, a, (1, 0, 0), (-b, b), (-draft, 0)), (0, -a, (-1, 0, 0), (-b, b), (-draft, 0)),
        (1, b, (0, 1, 0), (-a, a), (-draft, 0)), (1, -b, (0, -1, 0), (-a, a), (-draft, 0)),
        (2, -draft, (0, 0, -1), (-a, a), (-b, b)),
    ]  # fmt: skip
    total = np.zeros(6, complex)
    for axis, value, normal, *ranges in faces:
        (u, wu), (v, wv) = (
            (0.5 * (low + high) + 0.5 * (high - low) * NODES, 0.5 * (high - low) * WEIGHTS) for low, high in ranges
        )
        U, V = np.meshgrid(u, v, indexing="ij")
        r = np.insert(np.stack([U, V], axis=-1), axis, value, axis=-1)
        pressure = np.cosh(k * (r[..., 2] + depth)) / np.cosh(k * depth)
        pressure = pressure * np.exp(1j * k * (r[..., 0] * np.cos(beta) + r[..., 1] * np.sin(beta)))
        n = np.broadcast_to(np.array(normal, float), r.shape)
        modes = np.concatenate([n, np.cross(r, n)], axis=-1)
        total -= np.einsum("i,j,ij,ijm->m", wu, wv, pressure, modes)
    found = box_incident_force(length, beam, draft, depth, k, np.array([beta]))[0]
    assert found == pytest.approx(total, rel=1e-10, abs=1e-10 * np.abs(total).max())
