"""Linear response in irregular waves: transfer functions at any frequency and heading, spectra, moments.

    {−ω²[M + A] − iω[B + B′] + [C + C′]} X = F,    S_X(ω) = Σ_β w_β |X(ω, β)|² S(ω),    m_n = ∫ ωⁿ S_X dω

X comes from `bem.database.reader.Reader`, solved at every requested frequency; w_β are the shares of the wave energy
per heading.  SR179 report (1982), section 2.1.2 and design guideline 7.4.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.database.resonances import about, resonances

from ..on_current.body import carrier_of_body

COARSE = 64  # initial steps over the band, at least one between two stored frequencies and at most four
CONVERGED = 1e-3  # convergence of the integral of |X|², over the largest of its mode
ROUNDING = 1e-16  # |X|² below this fraction of the largest of all modes is rounding
# smallest step between frequencies near resonances, over the highest frequency, for one heading and for many
NEAREST = 1e-4, 2e-3
FINEST = 2**20  # steps between two stored frequencies at a narrow resonance: spars have damping ratios of 1e-5
LEAST = 1e-9  # damping ratio that `resonances` gives for none
UNDAMPED = (
    "the resonance of {} has no damping; give linear_damping, quadratic_damping or damping_ratio in the study, or "
    "[viscous] in the scene"
)


class Moments(NamedTuple):
    """∫ ωⁿ S dω for n = 0, 1, 2, 4 over the given frequencies, each (…,)."""

    m0: np.ndarray
    m1: np.ndarray
    m2: np.ndarray
    m4: np.ndarray


def frequencies(body, density=None, headings=None):
    """Frequencies from the lowest to the highest stored one, close enough together for every resonance in this range,
    rad/s; shape (q,).

    body : `bem.database.reader.Reader`; density : function of omega (q,) that weights the waves; None for equal
        weights
    headings : wave headings (p,) rad, for a body on a current, whose resonances depend on the heading.
    Steps between stored frequencies and around resonances (`bem.database.resonances`) are halved, first everywhere,
    then where the error is large. This ends when ∫ |X|² S dω of every mode and stored heading is accurate to 1e-3 of
    the largest of its mode. Raises ValueError where a million steps are not enough, as for a mode without damping.
    """
    coarse = int(np.clip(np.ceil(COARSE / max(len(body.omega) - 1, 1)), 1, 4))
    carried = carrier_of_body(body) is not None
    headings = (body.headings if headings is None else headings) if carried else None
    steps = subdivided(body.omega, coarse)
    found = [] if carried else resonances(body)
    for one in found:
        if density is None and one.damping <= LEAST:
            raise ValueError(UNDAMPED.format(one.name))
    peaks = _apart(body.resonant(headings), steps, len(headings)) if carried else about(body, found, steps)
    omega = np.union1d(steps, peaks)
    power, steps = _power(body, omega, density, headings), np.full(len(omega) - 1, coarse)
    open_ = np.ones(len(steps), bool)
    while True:
        rough = np.flatnonzero(open_)
        middle = 0.5 * (omega[rough] + omega[rough + 1])
        found = _power(body, middle, density, headings)
        width = (omega[rough + 1] - omega[rough])[:, None, None]
        change = np.abs(0.5 * width * (found - 0.5 * (power[rough] + power[rough + 1])))
        first = steps.max() == coarse
        omega, power = np.insert(omega, rough + 1, middle), np.insert(power, rough + 1, found, axis=0)
        largest = np.trapezoid(power, omega, axis=0).max(axis=0)
        largest = np.maximum(largest, max(ROUNDING * largest.max(), 1e-300))
        share = (change / largest).max(axis=1) / 3  # a quarter of the previous error remains
        if np.all(share.sum(axis=0) <= CONVERGED):
            return omega
        if steps[rough].max() >= FINEST // 2:
            worst = body.words[int(np.argmax(share.sum(axis=0)))]
            raise ValueError(UNDAMPED.format(worst))
        again = np.full(len(rough), True) if first else share.max(axis=1) > CONVERGED / len(steps)
        halved = np.repeat(open_, np.where(open_, 2, 1))
        steps = np.where(halved, 2, 1) * np.repeat(steps, np.where(open_, 2, 1))
        open_ = halved.copy()
        open_[halved] = np.repeat(again, 2)


def _apart(peaks, steps, count):
    """Places of resonances, of many headings, less those too near to one before or to a step to tell slopes between"""
    least, kept = NEAREST[count > 1] * steps[-1], []
    near = np.abs(steps[np.clip(np.searchsorted(steps, peaks), 0, len(steps) - 1)] - peaks)
    near = np.minimum(near, np.abs(steps[np.clip(np.searchsorted(steps, peaks) - 1, 0, None)] - peaks))
    for place in peaks[near > least]:
        if not kept or place - kept[-1] > least:
            kept.append(place)
    return np.array(kept)


def _power(body, omega, density, headings):
    """Power |X|² S at headings, None for the stored ones; shape (q, m, n)"""
    power = np.abs(body.motions(omega, headings)) ** 2
    return power if density is None else power * density(omega)[:, None, None]


def subdivided(values, steps):
    """Rising values (n,) with `steps` equal steps between neighbours: ((n−1)·steps + 1,)."""
    places = np.arange((len(values) - 1) * steps + 1) / steps
    return np.interp(places, np.arange(len(values)), values)


def over_headings(values, weights):
    """Σ_β w_β f: (q, …) from values (q, p, …) and shares of the energy (p,), or (q, p) if they depend on ω."""
    weights = np.broadcast_to(np.asarray(weights, float), np.shape(values)[:2])
    return np.einsum("qp...,qp->q...", values, weights)


def response_spectrum(transfer, density, weights=(1.0,)):
    """Spectral density of responses, unit² s/rad; shape (q, …).

    transfer : (q, p, …) complex per m of wave amplitude; density : (q,) wave spectrum, m² s/rad
    weights : (p,) or (q, p) shares of the energy per heading
    """
    power = over_headings(np.abs(transfer) ** 2, weights)
    return power * np.reshape(density, (-1,) + (1,) * (power.ndim - 1))


def moments_met(omega, met, transfer, density, weights=(1.0,)) -> Moments:
    """Moments of responses (q, p, …) per m to waves that the body meets at `met` (q, p) rad/s; all else as in
    `response_spectrum`
    """
    power = np.abs(transfer) ** 2
    column = np.reshape(met, met.shape + (1,) * (power.ndim - 2))
    rows = (over_headings(power * column**n, weights) for n in (0, 1, 2, 4))
    density = np.reshape(density, (-1,) + (1,) * (power.ndim - 2))
    return Moments(*(np.trapezoid(row * density, omega, axis=0) for row in rows))


def moments(omega, spectrum) -> Moments:
    """Moments of spectra (q, …) at omega (q,) rad/s by the trapezium rule."""
    column = np.reshape(omega, (-1,) + (1,) * (np.ndim(spectrum) - 1))
    return Moments(*(np.trapezoid(column**n * spectrum, omega, axis=0) for n in (0, 1, 2, 4)))
