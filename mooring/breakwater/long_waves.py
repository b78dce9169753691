"""Waves past a rectangle with uniform flow underneath, after Ito and Chiba (1972).

    f_B = sinh k(h−d) / (k(h−d) cosh kh),    f_H = (sinh kh − sinh k(h−d)) / (kd cosh kh),
    y_B = g k(h−d) f_B² / (ω² l n),          a − a_T = a / (1 + i y_B) for the fixed body,
    f_M = (−k z₀ sinh kh + k(d+z₀) sinh k(h−d) − cosh kh + cosh k(h−d)) / (kd kl cosh kh) + l f_B / 3d

l half width, d draft, z₀ < 0 the centre of gravity, n = C_g/C.  The pressure difference between both sides drives the
water under the body. Outside the body only the propagating wave mode is included, so energy is conserved.
Kihara, Kitatani & Todoroki (1975), eq. 3.1 to 3.13 and 4.7.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import depth_factor, depth_factor_slope, group_factor, wavenumber

EQUAL_AREA = np.sqrt(np.pi) / 4  # half the side of a square over the diameter of a circle of equal area


class LongWave(NamedTuple):
    """Quantities of wave pressure on a rectangle, each (...,) over frequency: k, rad/m, and n, f_H, f_B, y_B of the
    module
    """

    k: np.ndarray
    n: np.ndarray
    f_H: np.ndarray
    f_B: np.ndarray
    y_B: np.ndarray


class FixedBody(NamedTuple):
    """Complex amplitudes per unit wave amplitude at a fixed body, (...,) over frequency.

    transmission, reflection : m/m; horizontal, vertical : N/m² towards +y and up
    """

    transmission: np.ndarray
    reflection: np.ndarray
    horizontal: np.ndarray
    vertical: np.ndarray


def equal_area(diameter, draft):
    """Half width and draft, m, of the square with a circle's area about the same centre; draft : draft of the circle"""
    half = EQUAL_AREA * diameter
    return half, half + draft - diameter / 2


def long_wave(half, draft, depth, omega, gravity):
    """`LongWave`; half, draft, depth : m; omega : (...,) rad/s.  Raises ValueError for lengths that form no section."""
    if not (half > 0 and 0 < draft < depth < np.inf):
        raise ValueError(
            f"half width is {half:g} m, draft {draft:g} m and depth {depth:g} m; allowed: 0 < draft < depth"
        )
    k = wavenumber(omega, depth, gravity)
    n = group_factor(k, depth)
    under, tanh = depth_factor_slope(-draft, k, depth) / k, np.tanh(k * depth)
    gap = k * (depth - draft)
    f_B = under / gap
    return LongWave(k, n, (tanh - under) / (k * draft), f_B, gap * f_B**2 / (k * tanh * half * n))


def fixed_body(half, draft, depth, omega, *, density, gravity):
    """`FixedBody` of a rectangle after the module's theory"""
    wave = long_wave(half, draft, depth, omega, gravity)
    difference = 1 / (1 + 1j * wave.y_B)
    weight = 2 * density * gravity
    return FixedBody(1 - difference, difference, weight * draft * wave.f_H * difference, weight * half * wave.f_B)


def line_tensions(horizontal, vertical, angle):
    """P_F and P_B (…) of lines at `angle` (rad, below π/2) that hold a body against the forces of waves"""
    if not 0 < angle < np.pi / 2:
        raise ValueError(
            f"the lines of a fixed body are at {np.degrees(angle):g}°; allowed: above 0 and below 90, since vertical "
            "or crossed lines let the body move"
        )
    up, along = vertical / np.sin(angle) / 2, horizontal / np.cos(angle) / 2
    return up + along, up - along


def moment_factor(wave, half, draft, depth, z0):
    """f_M of the pressures about the centre of gravity at z0, m"""
    kd, kz, kh = wave.k * draft, wave.k * z0, wave.k * depth
    deep = depth_factor(-draft, wave.k, depth)
    under = depth_factor_slope(-draft, wave.k, depth) / wave.k
    sides = -kz * np.tanh(kh) + (kd + kz) * under - 1 + deep
    return sides / (kd * wave.k * half) + half / (3 * draft) * wave.f_B
