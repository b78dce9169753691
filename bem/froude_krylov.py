"""Force of the undisturbed wave on a rectangular section and on a box, in closed form.

    ∮ Z₀ exp(iκy) (−n) dl · {1, 1, arm},      n out of the body

per unit of ρg and amplitude, for sway, heave and roll about the origin (y to port, z up, roll from y to z), b = B/2:

    sway  −2i sin κb ∫Z₀dz    heave  Z₀(−d) 2 sin κb / κ    roll  2i sin κb ∫zZ₀dz + Z₀(−d) ∫y exp(iκy)dy

In oblique waves κ = k sinβ < k.
"""

import numpy as np
from scipy.special import gammainc

from .waves import depth_factor


def side_integrals(draft, depth, k):
    """∫ Z₀ dz and ∫ z Z₀ dz over −d < z < 0, m and m²

    Z₀ = (exp kz + exp(−k(z + 2h))) / (1 + exp(−2kh)), is integrated term by term with ∫₀¹ exp(−xt) dt and ∫₀¹ t
    exp(−xt) dt, because the closed form of the sum loses every digit to cancellation at kd = 1e-8.
    """
    x = k * draft
    plain, moment = -np.expm1(-x) / x, gammainc(2, x) / x**2
    image, total = np.exp(x - 2 * k * depth), 1 + np.exp(-2 * k * depth)
    return draft * plain * (1 + image) / total, -(draft**2) * (moment + image * (plain - moment)) / total


def incident_force(half, draft, depth, k, kappa):
    """Force of the incident wave per unit of ρg and amplitude, m and m²; shape (m, 3)

    half : half the beam, b, m; kappa : κ, rad/m, (m,)"""
    plain, moment = side_integrals(draft, depth, k)
    edge, x = float(depth_factor(-draft, k, depth)), kappa * half
    sway = -2j * np.sin(x) * plain
    heave = 2 * half * edge * np.sinc(x / np.pi)
    roll = 2j * np.sin(x) * moment + 2j * half**2 * edge * first_moment(x)
    return np.stack([sway, heave + 0j, roll], axis=-1)


def first_moment(x):
    """∫₀¹ t sin xt dt = (sin x − x cos x) / x², without cancellation near 0"""
    x = np.asarray(x, float)
    small = np.abs(x) < 0.5
    y = np.where(small, 1.0, x)
    series = x / 3 * (1 - x**2 / 10 * (1 - x**2 / 28 * (1 - x**2 / 54 * (1 - x**2 / 88 * (1 - x**2 / 130)))))
    return np.where(small, series, (np.sin(y) - y * np.cos(y)) / y**2)


def box_incident_force(length, beam, draft, depth, k, headings):
    """Froude–Krylov force on a box per unit of ρg and amplitude, m² and m³, about the origin; shape (m, 6)

    The integrals are −∬ Z₀ exp(ik(x cosβ + y sinβ)) n dS, with n and r × n, n out of the box; headings : β, rad, (m,)
    """
    a, b = length / 2, beam / 2
    X, Y = k * a * np.cos(headings), k * b * np.sin(headings)
    plain, moment = side_integrals(draft, depth, k)
    edge = float(depth_factor(-draft, k, depth))
    even_x, even_y = 2 * a * np.sinc(X / np.pi), 2 * b * np.sinc(Y / np.pi)  # ∫ exp(ikx cosβ) dx
    odd_x, odd_y = 2j * a**2 * first_moment(X), 2j * b**2 * first_moment(Y)  # ∫ x exp(ikx cosβ) dx
    jump_x, jump_y = 2j * np.sin(X), 2j * np.sin(Y)
    return np.stack(
        [
            -jump_x * plain * even_y,
            -jump_y * plain * even_x,
            edge * even_x * even_y + 0j,
            (edge * odd_y + moment * jump_y) * even_x,
            -(edge * odd_x + moment * jump_x) * even_y,
            plain * (jump_x * odd_y - jump_y * odd_x),
        ],
        axis=-1,
    )
