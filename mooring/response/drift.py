"""Mean drift of a free body in regular and irregular waves.

    D(ω, β) = F / ζ²,    F̄ = 2 ∫ Σ_β w_β D(ω, β) S(ω) dω

D in N per m² of wave amplitude squared (moment N m/m²), in surge, sway and yaw.  The SR179 report (1982) has two
coefficients for it: R_w = F / (½ρgLζ²) in 3.6.10 and 3.7.1.1, and C_R of the guideline (3.3) with the depth factor
outside, F = ½ρgLζ² C_R (1 + 2kh/sinh 2kh).  So R_w = C_R (1 + 2kh/sinh 2kh), and the sum of 3.6.9 takes R_w once;
the square printed there counts it twice.

Near the natural period of roll D turns within a few hundredths of rad/s, and over the headings it has twice the
harmonics of a force.  Between stored waves it is therefore rebuilt where the database has Kochin functions: the far
field is interpolated, the motions are solved, and D follows from both.  What this errs on the fixed body at stored
headings, whose drift is smooth over the frequencies, is taken off.  The far field is also right for a body with added
damping (`Body.restrained`), which takes energy out of the waves.
"""

from __future__ import annotations

import numpy as np

from bem.drift import about
from bem.drift import mean_drift as far_field_drift
from bem.waves import group_factor, wavenumber

from .headings import at_headings, mirrored, mirrored_far_field
from .linear import motions, over_headings

TURN = np.deg2rad(0.25)  # either side, for the slope over the headings


def drift(body, omega, heading):
    """(q, p, 3) mean drift per squared wave amplitude at omega (q,) rad/s and heading (p,) rad.

    Rebuilt from the far field where `can_rebuild(body)`; else the stored drift of the free body by a monotone cubic
    over frequency, which knows nothing of a resonance between two stored ones, and a spline over the headings.
    Raises RangeError outside the database, ValueError without drift or where damping was added and no far field is.
    """
    omega, heading = body.inside(omega), np.atleast_1d(heading)
    if can_rebuild(body):
        return _rebuilt(body, omega, heading)
    if body.drift is None:
        raise ValueError("the database holds no drift_force; run its command again with --only drift,kochin")
    if np.any(body.damping) or body.is_held:
        raise ValueError(
            "drift of a body with added damping or stiffness is rebuilt from Kochin functions, which the database "
            "lacks; run its command again with --only kochin,drift"
        )
    return _between(body, omega, body.drift, heading, body.moving_symmetry)


def drift_slopes(body, omega, heading):
    """(q, p, 3) drift and its derivatives ∂D/∂ω and ∂D/∂β per rad; omega rising, close enough to differentiate."""
    heading = np.atleast_1d(heading)
    before, value, after = (drift(body, omega, heading + turn) for turn in (-TURN, 0.0, TURN))
    return value, np.gradient(value, omega, axis=0, edge_order=2), (after - before) / (2 * TURN)


def can_rebuild(body):
    """Whether the far field is stored, so that drift between frequencies follows the motions."""
    return body.far_field_radiation is not None and body.drift_fixed is not None


def mean_in_sea(omega, drift, density, weights=(1.0,)):
    """(3,) mean force N, N and moment N m in irregular waves: twice the integral over the spectrum.

    omega : (q,); drift : (q, p, 3); density : (q,) m² s/rad
    weights : (p,) or (q, p) shares of the energy per heading
    """
    return 2 * np.trapezoid(over_headings(drift, weights) * np.asarray(density)[:, None], omega, axis=0)


def mean_in_sea_beyond(body, spectrum, heading, weights=(1.0,)):
    """(2, 3) the part of the mean force in waves below and above the stored band, D held at its ends.

    In short waves D tends to that of total reflection, a constant; in long waves it falls, and the end is an upper
    bound.  weights : (p,) or (2, p)
    """
    low, high = body.omega[0], body.omega[-1]
    energy = np.array([spectrum.moment(0, 0.0, low), spectrum.moment(0, high, np.inf)])
    return 2 * over_headings(drift(body, [low, high], heading), weights) * energy[:, None]


def from_R_w(coefficient, length, density, gravity=9.80665):
    """N/m² from R_w = F / (½ρgLζ²), of SR179 report (1982), eqs 3.6.10 and 3.7.1.1; length m, density kg/m³"""
    return 0.5 * density * gravity * length * np.asarray(coefficient, float)


def from_C_R(coefficient, omega, length, depth, density, gravity=9.80665):
    """N/m² from C_R with F = ½ρgLζ² C_R (1 + 2kh/sinh 2kh), the guideline of the SR179 report (1982), 3.3"""
    shallow = 2 * group_factor(wavenumber(omega, depth, gravity), depth)
    return from_R_w(np.asarray(coefficient, float) * shallow, length, density, gravity)


def _between(body, omega, values, heading, symmetry):
    """Stored drift (n, m, 3) at omega (q,) and heading (p,), from the numbers alone"""
    from scipy.interpolate import PchipInterpolator

    stored, values = mirrored(body.heading, PchipInterpolator(body.omega, values)(omega), symmetry, "drift")
    return at_headings(stored, values, heading)


def _rebuilt(body, omega, heading):
    """(q, p, 3) drift of the moving body, less what interpolation errs on the fixed one at stored headings"""
    from scipy.interpolate import PchipInterpolator

    symmetry = body.hull_symmetry
    radiated, diffracted = (body.at(omega, v) for v in (body.far_field_radiation, body.far_field_diffraction))
    stored, images = mirrored_far_field(body.heading, diffracted, body.theta, symmetry)
    H = at_headings(stored, images, heading) + np.einsum("qpj,qjt->qpt", motions(body, omega, heading), radiated)
    error = _far_field_drift(body, omega, diffracted, body.heading)
    error -= about(PchipInterpolator(body.omega, body.drift_fixed)(omega), -body.rotation_center)
    stored, error = mirrored(body.heading, error, symmetry, "drift")
    return about(_far_field_drift(body, omega, H, heading) - at_headings(stored, error, heading), body.rotation_center)


def _far_field_drift(body, omega, H, heading):
    """(q, p, 3) about the origin, from total Kochin functions (q, p, t)"""
    t = len(body.theta)
    orders = np.fft.fftfreq(t, 1 / t)
    harmonics = np.fft.fft(H, axis=-1) / t
    slopes = 1j * np.where(np.abs(orders) == t / 2, 0.0, orders) * harmonics
    slope = np.fft.ifft(slopes * t, axis=-1)
    towards = np.exp(1j * np.outer(heading, orders))
    forward, forward_slope = (np.einsum("qmt,mt->qm", part, towards) for part in (harmonics, slopes))
    k = wavenumber(omega, body.depth, body.gravity)[:, None, None]
    unit = far_field_drift(
        H, slope, forward, forward_slope, body.theta, heading, 1.0, 1.0, body.density, body.gravity
    )  # fmt: skip
    return group_factor(k, body.depth) / k * unit / np.concatenate([np.ones_like(k), np.ones_like(k), k], axis=-1)
