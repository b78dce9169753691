"""Memory by direct convolution, the reference of `memory`.

    y(t) = ∫₀^T K(τ) ν(t − τ) dτ ≈ Σ_j W_j ν(t − j h),    W_j = h K(j h), half of it at j = 0 and at the end T

over velocities that are zero before t = 0 and stored at every step h of the retardation function, by the trapezium
rule, of second order in h.  K is cut at T, where a push of long ago is felt once more: `forgotten` says how much.  A
step costs 36 products for each of T/h matrices, where `memory` takes 12 a state.
"""

from __future__ import annotations

import numpy as np


def history_weights(retardation):
    """W (m, 6, 6) of a `retardation.Retardation` with m times: forces a unit of velocity now, a step ago, …"""
    weights = retardation.K * (retardation.times[1] - retardation.times[0])
    weights[[0, -1]] *= 0.5
    return weights


def convolution(retardation, velocity):
    """y (n, 6) N, N m against the motion of velocity (n, 6) m/s, rad/s at the steps of the retardation function"""
    weights = history_weights(retardation)
    length = len(weights) + len(velocity) - 1
    spectrum = np.einsum("qij,qj->qi", np.fft.rfft(weights, length, axis=0), np.fft.rfft(velocity, length, axis=0))
    return np.fft.irfft(spectrum, length, axis=0)[: len(velocity)]


def forgotten(retardation):
    """Largest share of K that is left at the end of its times, of a tenth of them, by √(ii · jj)"""
    K = np.abs(retardation.K)
    size = np.sqrt(np.einsum("mii->mi", K).max(axis=0))
    scale = np.outer(size, size)
    last = K[-max(1, len(K) // 10) :].max(axis=0)
    return float(np.divide(last, scale, out=np.zeros_like(last), where=scale > 0).max())
