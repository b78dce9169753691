"""Linear response in irregular waves: transfer functions at any frequency and heading, spectra, moments.

    {−ω²[M + A] − iω[B + B′] + [C + C′]} X = F,    S_X(ω) = Σ_β w_β |X(ω, β)|² S(ω),    m_n = ∫ ωⁿ S_X dω

X is solved at every frequency asked for, from interpolated A, B and F: a mean of two solutions on both sides of a
resonance would cancel.  w_β are the shares of the wave energy per heading.  SR179 report (1982), section 2.1.2 and
design guideline 7.4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem import DOFS

from .headings import at_headings

CONVERGED = 1e-3  # of the largest integral of |X|² of its mode, when the number of frequencies is doubled
FINEST = 256  # steps between two stored frequencies


class Moments(NamedTuple):
    """∫ ωⁿ S dω for n = 0, 1, 2, 4 over the frequencies given, each (…,)."""

    m0: np.ndarray
    m1: np.ndarray
    m2: np.ndarray
    m4: np.ndarray


def motions(body, omega, heading):
    """(q, p, 6) complex motion about rotation_center per unit wave amplitude, m/m and rad/m.

    omega : (q,) rad/s; heading : (p,) rad, travelled to.  Raises RangeError outside the database.
    """
    omega = body.inside(omega)
    stored, force = body.forces(omega)
    return _solved(body, omega, at_headings(stored, force, np.atleast_1d(heading)))


def motions_in_stored_waves(body, omega):
    """(q, m, 6) the same at the stored headings, for what is built from stored far fields."""
    omega = body.inside(omega)
    return _solved(body, omega, body.at(omega, body.excitation))


def frequencies(body, density=None):
    """(q,) rad/s from the lowest to the highest stored frequency, close enough for every resonance between them.

    density : function of omega (q,), the waves that matter; None for all alike
    Steps between stored frequencies are halved until ∫ |X|² S dω of every mode and stored heading moves by less than
    1e-3 of the largest of its mode.  Raises ValueError where 256 steps are not enough: a mode without damping.
    """
    steps, last = 2, None
    while steps < FINEST:
        steps *= 2
        omega = subdivided(body.omega, steps)
        power = np.abs(motions_in_stored_waves(body, omega)) ** 2
        power = power if density is None else power * density(omega)[:, None, None]
        power = np.trapezoid(power, omega, axis=0)
        if last is not None:
            change = (np.abs(power - last) / np.maximum(power.max(axis=0), 1e-300)).max(axis=0)
            if change.max() <= CONVERGED:
                return omega
        last = power
    worst = DOFS[int(np.argmax(change))].lower()
    raise ValueError(
        f"the resonance of {worst} is narrower than 1/{FINEST} of the step between stored frequencies; "
        "store more frequencies around it or give the body damping"
    )


def subdivided(values, steps):
    """Rising values (n,) with `steps` equal steps between neighbours: ((n−1)·steps + 1,)."""
    places = np.arange((len(values) - 1) * steps + 1) / steps
    return np.interp(places, np.arange(len(values)), values)


def over_headings(values, weights):
    """Σ_β w_β f: (q, …) from values (q, p, …) and shares of the energy (p,), or (q, p) where they change with ω."""
    weights = np.broadcast_to(np.asarray(weights, float), np.shape(values)[:2])
    return np.einsum("qp...,qp->q...", values, weights)


def response_spectrum(transfer, density, weights=(1.0,)):
    """(q, …) spectral density of responses, unit² s/rad.

    transfer : (q, p, …) complex per m of wave amplitude; density : (q,) wave spectrum, m² s/rad
    weights : (p,) or (q, p) shares of the energy per heading
    """
    power = over_headings(np.abs(transfer) ** 2, weights)
    return power * np.reshape(density, (-1,) + (1,) * (power.ndim - 1))


def moments(omega, spectrum) -> Moments:
    """Moments of spectra (q, …) at omega (q,) rad/s by the trapezium rule."""
    column = np.reshape(omega, (-1,) + (1,) * (np.ndim(spectrum) - 1))
    return Moments(*(np.trapezoid(column**n * spectrum, omega, axis=0) for n in (0, 1, 2, 4)))


def _solved(body, omega, force):
    """(q, p, 6) from the equation of motion at every omega (q,) for forces (q, p, 6)"""
    added, damping = body.coefficients(omega)
    w = omega[:, None, None]
    dynamic = -(w**2) * (body.inertia + added) - 1j * w * (damping + body.damping) + body.stiffness
    return np.linalg.solve(dynamic, force.swapaxes(1, 2)).swapaxes(1, 2)
