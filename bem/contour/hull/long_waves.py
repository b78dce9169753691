"""Force of a bound wave on a vertical-sided body, as an integral over the vertical wall above and below the plan
contour.

A bound wave has a wavenumber κ that differs from the wavenumber of a free wave of its frequency. The force

    D = −ρg ∬ (p ψ_ν − ψ p_ν) dS,        p = cosh κζ / cosh κh exp(iκ·x),  over the whole depth 0 < ζ < h

is `bem.second_order.long_wave_forces` with its integral over the bottom moved to the gap under the keel by Green's
identity: p and ψ are harmonic below and at rest on the bed.  In the gap ψ and ψ_ν are sums of depth modes, and

    ∫ cosh κζ / cosh κh f dζ = (κ tanh κh − K) f(h) / (κ² − k²)        of a mode f with f″ = k²f,  f′(h) = K f(h).
"""

import numpy as np

from ...froude_krylov import side_integrals
from ..plan.maps import CLASSES
from ..plan.potentials import plan_values
from .flow import IMAGES, SIGNS, amplitudes

NEAR = 1e-12  # relative difference of κ² and k² below which they are treated as equal


def long_wave_forces(freq, number):
    """Diffraction forces D about the origin of waves of wavenumbers (w, 2), rad/m, at the frequency of a
    `SharedFrequency`; shape (w, 6)"""
    c, depth, values = freq.contour, freq.body.depth, plan_values(freq)
    size = np.hypot(*number.T)
    over_modes = [_depth_integrals(freq, kappa) for kappa in size]
    out = np.zeros((len(number), 6), complex)
    for cls, signs in zip(CLASSES, SIGNS, strict=True):
        dofs, wave, sides, flow = freq.flows[cls]
        moving = len(dofs)
        g = amplitudes(freq, values[cls], cls)[0][:-2, :, :moving]
        velocity = np.concatenate([flow.velocity[..., :moving], np.moveaxis(sides, 0, -1)])
        speed = np.matmul(wave.basis, velocity)
        phase, slope = 0.0, 0.0
        for sign, image in zip(signs, IMAGES, strict=True):
            kx, ky = (number * image).T
            turn = sign * np.exp(1j * (np.outer(kx, c.x) + np.outer(ky, c.y)))
            phase = phase + turn
            slope = slope + 1j * (np.outer(kx, c.nx) + np.outer(ky, c.ny)) * turn
        for w, (kappa, over) in enumerate(zip(size, over_modes, strict=True)):
            rows = _rows(freq, kappa, depth)
            pushed, flowing = np.tensordot(rows, speed, 1), np.tensordot(over, g, 1)
            out[w, dofs] = (phase[w] * c.weights) @ pushed - (slope[w] * c.weights) @ flowing
    return -freq.density * freq.gravity * out


def _rows(freq, kappa, depth):
    """Integrals of the profiles in the gap, and of 1 and z on the side, times the wave; shape (r,)"""
    gap = freq.body.profiles.gap
    if kappa * depth < 1e-9:
        moments = np.concatenate([gap.mean, [gap.draft, -(gap.draft**2) / 2]])
    else:
        moments = np.concatenate([gap.wave_moments(kappa), side_integrals(gap.draft, depth, kappa)])
    return freq.body.profiles.combinations @ moments


def _depth_integrals(freq, kappa):
    """Integrals over the depth of the wave and the amplitudes of `DepthSums`; shape (a,)"""
    modes, h = freq.modes, freq.body.depth
    jump = kappa * np.tanh(kappa * h) - freq.omega**2 / freq.gravity
    apart = kappa**2 - modes.k**2
    wave = modes.wave_norm if abs(apart) < NEAR * modes.k**2 else jump / apart
    kn = modes.wavenumbers
    local = jump * np.cos(kn * h) / (kappa**2 + kn**2) / (modes.norms * kn)
    table = freq.body.nodes(freq.top).weights(kn)
    rows = (freq.body.profiles.combinations @ modes.rows).T
    return np.append(wave, (table.T @ (local[:, None] * rows)).ravel())
