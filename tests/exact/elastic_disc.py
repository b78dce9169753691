"""A thin elastic disc without draft in waves, by eigenfunctions: Peter, Meylan & Chung, Int. J. Offshore Polar Eng. 14
(2004).

With φ ∝ cos κ(z+h) on either side of r = a, K = ω²/g, β = D/ρg, γ = m/ρ

    open water  κ tan κh = −K            below the plate  (βκ⁴ + 1 − Kγ) κ tan κh = −K

φ and ∂φ/∂r are equal over the depth at r = a, bending moment and shear force of the plate vanish there.
"""

import numpy as np
from scipy.optimize import brentq, newton
from scipy.special import iv, ivp, jv, jvp, kv, kvp

POISSON = 0.3


def deflection(a, rigidity, mass, depth, omega, points, rho, g, orders=8, count=40):
    """(p,) complex rise of a disc of radius a at points (p, 2) m per metre of a wave towards +x; mass : kg/m²"""
    K, h = omega**2 / g, depth
    k, kappa = _open(K, h, count), _below(K, rigidity / (rho * g), mass / rho, h, count)
    own, across = _products(k, k, h), _products(k[:, None], kappa, h)
    rises, (x, y) = -kappa * np.tan(kappa * h), np.asarray(points, float).T
    r, turn, out, wave = np.hypot(x, y), np.arctan2(y, x), np.zeros(len(points), complex), float((1j * k[0]).real)
    for n in range(orders + 1):
        slope = kappa * ivp(n, kappa * a) / iv(n, kappa * a)
        away = k * kvp(n, k * a) / kv(n, k * a)
        moment = kappa**2 - (1 - POISSON) / a * (slope - n * n / a)
        shear = kappa**2 * slope - n * n * (1 - POISSON) / a**2 * (slope - 1 / a)
        zero = np.zeros(len(k))
        matrix = np.vstack([
            np.hstack([across, -np.diag(own)]), np.hstack([across * slope, -np.diag(own * away)]),
            np.append(rises * moment, zero)[None], np.append(rises * shear, zero)[None],
        ])  # fmt: skip
        amplitude = (1 if n == 0 else 2) * 1j**n * own[0]
        right = np.zeros(len(matrix), complex)
        right[0], right[len(k)] = amplitude * jv(n, wave * a), amplitude * wave * jvp(n, wave * a)
        scale = np.abs(matrix).max(axis=1)
        found = np.linalg.solve(matrix / scale[:, None], right / scale)[: len(kappa)]
        out += (iv(n, np.multiply.outer(r, kappa)) / iv(n, kappa * a)) @ (found * rises) * np.cos(n * turn)
    return out / K


def free_shapes(a, order, count):
    """[(λ/a, C)] of the lowest shapes Jₙ(λr/a) + C Iₙ(λr/a) cos nθ of a free disc"""

    def edge(x):
        l, both = x / a, ((jv(order, x), x / a * jvp(order, x), -1), (iv(order, x), x / a * ivp(order, x), 1))
        return np.array([
            [s * l * l * w - (1 - POISSON) / a * (dw - order**2 / a * w) for w, dw, s in both],
            [s * l * l * dw - order**2 * (1 - POISSON) / a**2 * (dw - w / a) for w, dw, s in both],
        ]) / [1, np.exp(x)]  # fmt: skip

    places = np.linspace(1.0, 4.0 * (count + order) + 4, 2000)
    signs = np.array([np.linalg.det(edge(x)) for x in places])
    found = []
    for i in np.flatnonzero(signs[1:] * signs[:-1] < 0)[:count]:
        x = brentq(lambda x: np.linalg.det(edge(x)), places[i], places[i + 1])
        (one, other), _ = edge(x)
        found.append((x / a, -one / other * np.exp(-x)))
    return found


def _open(K, h, count):
    wave = brentq(lambda k: k * np.tanh(k * h) - K, 1e-9, 50 * max(K, 1 / np.sqrt(h)))
    rest = [brentq(lambda k: k * np.sin(k * h) + K * np.cos(k * h), (m - 0.5) * np.pi / h, m * np.pi / h)
            for m in range(1, count + 1)]  # fmt: skip
    return np.array([-1j * wave, *rest])


def _below(K, beta, gamma, h, count):
    def of_waves(x):
        return (beta * x**4 + 1 - K * gamma) * x * np.sinh(x * h) - K * np.cosh(x * h)

    def of_rest(x):
        return (beta * x**4 + 1 - K * gamma) * x * np.sin(x * h) + K * np.cos(x * h)

    wave = brentq(of_waves, 1e-6, 5 * (1 + K))
    start = (1 / beta) ** 0.25 * np.exp(0.25j * np.pi)
    pair = newton(of_waves, start, tol=1e-13, maxiter=200)
    assert pair.imag > 0.1 * abs(start) and pair.real > 0.1 * abs(start)
    rest = [brentq(of_rest, (m - 0.5) * np.pi / h, m * np.pi / h) for m in range(1, count + 1)]
    return np.array([-1j * pair, 1j * np.conj(pair), -1j * wave, *rest])


def _products(p, q, h):
    """∫ cos p(z+h) cos q(z+h) dz over cos ph cos qh"""
    near = np.abs(p - q) < 1e-12
    difference = np.where(near, 1.0, p - q)
    apart = (np.sin(difference * h) / difference + np.sin((p + q) * h) / (p + q)) / 2
    return np.where(near, h / 2 + np.sin(2 * p * h) / (4 * p), apart) / (np.cos(p * h) * np.cos(q * h))
