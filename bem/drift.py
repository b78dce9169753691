"""Mean horizontal drift force and yaw moment from the far field (Maruo 1960, Newman 1967) in any depth.

With the body's waves η ~ A √(2/(πkR)) exp(i(kR − π/4)) H(θ) in an incident wave of amplitude A towards β and
n = C_g/C, momentum and angular momentum through a distant cylinder give

    F_x = (ρgA²/πk) n [−2π cosβ Re H(β) − ∫ |H|² cosθ dθ],    F_y alike with sin
    M_z = −(ρgA²/πk²) n [2π Im H′(β) + ∫ Im(H̄ H′) dθ]

The prime is the exact derivative.  A body without absorption has (1/2π) ∫ |H|² dθ = −Re H(β).
"""

from __future__ import annotations

import numpy as np


def mean_drift(H, slope, forward, forward_slope, theta, beta, k, n, density, gravity):
    """(headings, 3) mean surge and sway force (N/m²) and yaw moment (N m/m²) about the origin.

    k, n : numbers, or arrays that broadcast over the headings; all else may then have further axes before these
    H, slope : (headings, t) total Kochin function and derivative at equally spaced `theta`
    forward, forward_slope : (headings,) the same at θ = β; beta : (headings,) rad
    """
    step = 2 * np.pi / len(theta)
    power = np.abs(H) ** 2
    x = -2 * np.pi * np.cos(beta) * forward.real - step * power @ np.cos(theta)
    y = -2 * np.pi * np.sin(beta) * forward.real - step * power @ np.sin(theta)
    m = -2 * np.pi * forward_slope.imag - step * np.sum((H.conj() * slope).imag, axis=-1)
    return density * gravity * np.asarray(n / (np.pi * k))[..., None] * np.stack([x, y, m / k], axis=-1)


def harmonics(H, theta):
    """Orders (t,) and coefficients (…, t) of the Fourier series of H (…, t) over equally spaced theta (t,) rad.

    A Kochin function has no more harmonics than kR and a few: the series is the function, and its derivative exact.
    """
    order = np.fft.fftfreq(len(theta), 1 / len(theta))
    return order, np.fft.fft(H, axis=-1) * np.exp(-1j * order * theta[0]) / len(theta)


def slope_and_ahead(H, theta, beta):
    """H′ (…, m, t), and H and H′ (…, m) of each of the m rows of H (…, m, t) at its own beta (m,) rad."""
    order, series = harmonics(H, theta)
    turn = 1j * np.where(np.abs(order) == len(theta) / 2, 0.0, order)  # the highest has no phase of its own
    slope = np.fft.ifft(turn * series * np.exp(1j * order * theta[0]) * len(theta), axis=-1)
    wave = series * np.exp(1j * np.multiply.outer(beta, order))
    return slope, wave.sum(axis=-1), (turn * wave).sum(axis=-1)


def energy_defect(H, forward):
    """(headings,) violation of (1/2π)∫|H|²dθ = −Re H(β), relative to the largest |H| or the left-hand side

    The error of H is relative to its largest value over θ: in long waves surge and heave cancel, and H(β) vanishes.
    """
    size, scattered = np.abs(H), np.mean(np.abs(H) ** 2, axis=-1)
    scale = np.maximum(np.maximum(scattered, np.abs(forward)), size.max(axis=-1, initial=1e-300))
    return (scattered + forward.real) / scale


def about(force, center):
    """The same loads (…, 3) with the moment about the vertical through `center`."""
    moved = force.copy()
    moved[..., 2] -= center[0] * force[..., 1] - center[1] * force[..., 0]
    return moved
