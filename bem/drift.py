"""Mean horizontal drift force and yaw moment from the far field (Maruo 1960, Newman 1967) in any depth.

With the body's waves η ~ A √(2/(πkR)) exp(i(kR − π/4)) H(θ) in an incident wave of amplitude A towards β and
n = C_g/C, momentum and angular momentum through a distant cylinder give

    F_x = (ρgA²/πk) n [−2π cosβ Re H(β) − ∫ |H|² cosθ dθ],    F_y with sin in place of cos
    M_z = −(ρgA²/πk²) n [2π Im H′(β) + ∫ Im(H̄ H′) dθ]

The prime is the exact derivative.  A body without absorption has (1/2π) ∫ |H|² dθ = −Re H(β).
"""

import numpy as np

OF_EACH = {"body_drift_force_fixed": False, "body_drift_force": True}  # names for each body, and whether it moves


def mean_drift(H, slope, forward, forward_slope, theta, beta, k, n, density, gravity):
    """Mean surge and sway force (N/m²) and yaw moment (N m/m²) about the origin; shape (headings, 3)

    k, n : numbers, or arrays that broadcast over the headings; other arguments may then have more leading axes
    H, slope : total Kochin function and its derivative at equally spaced `theta`, (headings, t)
    forward, forward_slope : total Kochin function and its derivative at θ = β, (headings,); beta : rad, (headings,)
    """
    step = 2 * np.pi / len(theta)
    power = np.abs(H) ** 2
    scattered = step * power @ np.cos(theta), step * power @ np.sin(theta), step * np.sum((H.conj() * slope).imag, -1)
    return _of_momentum(scattered, forward, forward_slope, beta, k, n, density * gravity)


def drift_of_two(H, slope, ahead, ahead_slope, theta, beta, k, n, density, gravity):
    """Complex matrix D for pairs of waves of one frequency; shape (headings, headings, 3)

    In waves of amplitudes a_i the mean drift is Re Σ Σ a_i conj(a_j) D_ij.

    ahead, ahead_slope : H and H′ of each wave in the direction of every wave, (headings, headings)
    The other arguments are those of `mean_drift`, which gives D_ii.  The far field of a pair contains the
    interference of each incident wave with the scattered wave of the other:

        −2π cosβ Re H(β) becomes −π {cosβⱼ Hᵢ(βⱼ) + cosβᵢ H̄ⱼ(βᵢ)},    Im H′(β) in the same way,    |H|² becomes Hᵢ H̄ⱼ
    """
    step, back, turn = 2 * np.pi / len(theta), H.conj().T, ahead.conj().T
    out = [
        -np.pi * (part(beta) * ahead + part(beta)[:, None] * turn) - step * (H * part(theta)) @ back
        for part in (np.cos, np.sin)
    ]
    out.append(1j * np.pi * (ahead_slope - ahead_slope.conj().T) + 1j * step * slope @ back)
    scale = density * gravity * n / (np.pi * k)
    return scale * np.stack([*out[:2], out[2] / k], axis=-1)


def mean_drift_of_series(order, series, forward, forward_slope, beta, k, n, density, gravity):
    """`mean_drift` of Kochin functions Σ_m c_m exp(imθ): ∫|H|² exp(iθ) dθ = 2π Σ c_m c̄_m₊₁, ∫Im(H̄H′) dθ = 2π Σ
    m|c_m|²

    order : orders m, rising by one, (t,); series : coefficients c_m from `harmonics`, (headings, t)
    """
    momentum = 2 * np.pi * np.einsum("...m,...m->...", series[..., :-1], series[..., 1:].conj())
    turning = 2 * np.pi * (np.abs(series) ** 2 @ order)
    return _of_momentum((momentum.real, momentum.imag, turning), forward, forward_slope, beta, k, n, density * gravity)


def _of_momentum(scattered, forward, forward_slope, beta, k, n, weight):
    """Mean drift by momentum, shape (headings, 3), from ∫|H|² cosθ dθ, ∫|H|² sinθ dθ and ∫Im(H̄H′) dθ; weight : ρg"""
    cos, sin, turning = scattered
    x = -2 * np.pi * np.cos(beta) * forward.real - cos
    y = -2 * np.pi * np.sin(beta) * forward.real - sin
    m = -2 * np.pi * forward_slope.imag - turning
    return weight * np.asarray(n / (np.pi * k))[..., None] * np.stack([x, y, m / k], axis=-1)


def harmonics(H, theta):
    """Orders (t,), rising, and coefficients (…, t) of the Fourier series of H (…, t), equally spaced theta (t,) rad.

    A Kochin function has few harmonics beyond kR: the series equals the function, and its derivative is exact.
    """
    t = len(theta)
    order, below = np.arange(t) - t // 2, t // 2
    turn, found = np.exp(-1j * order * theta[0]) / t, np.fft.fft(H, axis=-1)
    series = np.empty_like(found)
    np.multiply(found[..., t - below :], turn[:below], out=series[..., :below])
    np.multiply(found[..., : t - below], turn[below:], out=series[..., below:])
    return order, series


def slope_and_ahead(H, theta, beta):
    """H′ (…, m, t), and H and H′ (…, m) at beta (m,) rad, one angle for each of the m rows of H (…, m, t)."""
    order, series = harmonics(H, theta)
    turn = 1j * np.where(np.abs(order) == len(theta) / 2, 0.0, order)  # the highest has no phase of its own
    back = np.fft.ifftshift(turn * series * np.exp(1j * order * theta[0]) * len(theta), axes=-1)
    return np.fft.ifft(back, axis=-1), *ahead(order, series, beta)


def ahead(order, series, beta):
    """H and H′ (…, m) of a series (…, m, t) at beta (m,) rad, one angle for each of the m rows"""
    wave = np.exp(1j * np.multiply.outer(beta, order))
    turn = 1j * np.where(np.abs(order) == len(order) / 2, 0.0, order)
    return np.einsum("...mt,mt->...m", series, wave), np.einsum("...mt,mt->...m", series, turn * wave)


def energy_defect(H, forward):
    """Violation of (1/2π)∫|H|²dθ = −Re H(β), relative to the largest |H| or the left-hand side; shape (headings,)

    The error of H is relative to its largest value over θ: in long waves surge and heave cancel, and H(β) vanishes.
    """
    size, scattered = np.abs(H), np.mean(np.abs(H) ** 2, axis=-1)
    scale = np.maximum(np.maximum(scattered, np.abs(forward)), size.max(axis=-1, initial=1e-300))
    return (scattered + forward.real) / scale


def about(force, center):
    """Loads (…, 3) whose moment, now about the origin, is changed to the vertical through `center`."""
    moved = force.copy()
    moved[..., 2] -= center[0] * force[..., 1] - center[1] * force[..., 0]
    return moved


def sum_about_origin(drift, bodies):
    """Surge, sway and yaw about the origin of all bodies together, from the forces on each body (…, bodies, 3); shape
    (…, 3)"""
    out = np.zeros((*drift.shape[:-2], 3))
    for i, body in enumerate(bodies):
        c, s = np.cos(body.heading), np.sin(body.heading)
        x, y, moment = np.moveaxis(drift[..., i, :], -1, 0)
        x, y = c * x - s * y, s * x + c * y
        out += np.stack([x, y, moment + body.rotation_center[0] * y - body.rotation_center[1] * x], axis=-1)
    return out
