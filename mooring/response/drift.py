"""Mean drift of a free body in regular and irregular waves.

    D(ω, β) = F / ζ²,    F̄ = 2 ∫ Σ_β w_β D(ω, β) S(ω) dω

D is the drift in surge, sway and yaw, in N per m² of squared wave amplitude (moment N m/m²).  The SR179 report
(1982) has two coefficients for D: R_w = F / (½ρgLζ²) in 3.6.10 and 3.7.1.1; and C_R of the guideline (3.3), without
the depth factor: R_w = C_R (1 + 2kh/sinh 2kh).  The sum of 3.6.9 contains R_w once; the printed square would count
it twice.

D comes from `bem.database.reader.Reader`, which resolves the resonances of the motions between stored waves.
"""

import numpy as np

from hakobune.bem.database.between_frequencies import BetweenError

from .linear import over_headings

FEWEST_STEPS = 72  # fewest directions around the circle for the Fourier series of drift
TURN = np.deg2rad(0.25)  # either side, for the slope over the headings


def drift_slopes(body, omega, heading, fixed=False):
    """Drift and its derivatives ∂D/∂ω and ∂D/∂β per rad; each of shape (q, p, 3); omega rising, close enough to
    differentiate.

    fixed : True for the fixed body, False for the floating body.
    If the headings (p,) cover the circle in steps of at most 5°, ∂D/∂β is the derivative of the Fourier series of D,
    up to its 2kR harmonics. Otherwise ∂D/∂β is a difference quotient.
    """
    heading = np.atleast_1d(heading)
    found = _round_the_circle(body, omega, heading, fixed) or _by_differences(body, omega, heading, fixed)
    return found[0], np.gradient(found[0], omega, axis=0, edge_order=2), found[1]


def _round_the_circle(body, omega, heading, fixed):
    """D and ∂D/∂β, None where headings are no steps of the circle or the database does not cover the circle"""
    count = round(2 * np.pi / np.diff(heading).min()) if len(heading) > 1 and np.all(np.diff(heading) > 0) else 0
    place = heading * count / (2 * np.pi)
    if count < FEWEST_STEPS or np.abs(place - np.round(place)).max() > 1e-6:
        return None
    try:
        D = body.drift(omega, np.arange(count) * (2 * np.pi / count), fixed)
    except BetweenError:
        return None
    orders = np.fft.fftfreq(count, 1 / count)
    turn = 1j * np.where(np.abs(orders) == count / 2, 0.0, orders)[:, None]
    slope, place = np.fft.ifft(turn * np.fft.fft(D, axis=1), axis=1).real, np.round(place).astype(int) % count
    return D[:, place], slope[:, place]


def _by_differences(body, omega, heading, fixed):
    turned = np.add.outer([-TURN, 0.0, TURN], heading)
    before, value, after = np.split(body.drift(omega, turned.ravel(), fixed), 3, axis=1)
    return value, (after - before) / (2 * TURN)


def mean_in_sea(omega, drift, density, weights=(1.0,)):
    """Mean force, N, N, and moment, N m, in irregular waves, twice the integral over the spectrum; shape (3,).

    omega : (q,); drift : (q, p, 3); density : (q,) m² s/rad
    weights : (p,) or (q, p) shares of the energy per heading
    """
    return 2 * np.trapezoid(over_headings(drift, weights) * np.asarray(density)[:, None], omega, axis=0)


def mean_in_sea_beyond(body, spectrum, ends, weights=(1.0,)):
    """Mean force in waves below and above the stored band, with D held at its end values; shape (2, 3), or (2, p, 3).

    In short waves D tends to a constant, the drift under total reflection. In long waves D falls, so the value at
    the end of the band is an upper bound.  weights : (p,) or (2, p)
    """
    low, high = body.omega[0], body.omega[-1]
    energy = np.array([spectrum.moment(0, 0.0, low), spectrum.moment(0, high, np.inf)])
    return 2 * over_headings(ends, weights) * energy[:, None]
