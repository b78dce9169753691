"""Mean drift of a database body in any wave: from its Kochin functions, corrected for the error of the far field.

Drift follows from motions X and Kochin functions (`bem.drift`).  Energy,

    −Re H(β) = (1/2π) ∫ |H|² dθ + kP/(2ρgC_g),    P = ½ω² X* B′ X the power absorbed,

gives the forward value of H in the forces, which would otherwise be a small difference of inexact numbers. For the
moment energy gives no value.  At stored waves the far field of the fixed body deviates from the stored drift by the
discretisation error of the panels. This deviation, interpolated linearly between frequencies, is subtracted. Without
Kochin functions the drift itself is interpolated.

Every function takes a `reader.Reader`, omega (q,) rad/s, and headings (p,) rad or None for the stored ones.
"""

import numpy as np

from ..drift import about, ahead, harmonics, mean_drift_of_series
from ..waves import group_factor, wavenumber
from .between_frequencies import DRIFT, KOCHIN, BetweenError


def drift(reader, omega, headings, fixed):
    """Drift, N/m² and N m/m², in waves without a stored value; shape (q, p, 3).  Raises BetweenError for unknown
    drift."""
    name = DRIFT[0] if fixed else DRIFT[1]
    if reader.rebuilds_drift:
        over = None if headings is None else reader.to_headings(omega, headings, name)
        folded = None if headings is None else over.folded
        radiated, H = reader.far_field(omega, folded)
        X = None if fixed else reader.motions(omega, folded)
        value = of_far_field(reader, omega, folded, radiated, H, X) - _amiss(reader, omega, folded)
        return value if headings is None else over.unfolded(value, "drift")
    if name not in reader.between.quantities:
        raise BetweenError(
            f"{', '.join(KOCHIN)} must be stored for {name}; repeat the command that made the database, with --only "
            f"kochin,drift"
        )
    if not fixed and not reader.own:
        raise BetweenError(
            "drift of a body with added damping or stiffness is computed from Kochin functions, which the database "
            "lacks; repeat the command that made it, with --only kochin,drift"
        )
    values = reader.between.value(omega, name)
    if headings is None:
        return values
    ring = reader.ring_of(name)
    return reader.to_headings(omega, headings, name).value(ring.of_drift(values), "drift")


def of_far_field(reader, omega, headings, radiated, H, X):
    """Drift from the far field about rotation_center; shape (q, p, 3); motions X (q, p, 6), or None for the fixed body

    radiated : (q, 6, t) and H (q, p, t) Kochin functions of the radiation and the diffraction
    """
    k = wavenumber(omega, reader.depth, reader.gravity)[:, None]
    n, beta = group_factor(k, reader.depth), reader.headings if headings is None else np.atleast_1d(headings)
    absorbed = 0.0
    if X is not None:
        H = H + X @ radiated
        speed = n * omega[:, None] / k
        absorbed = k * _absorbed(reader, omega, X) / (2 * reader.density * reader.gravity * speed)
    order, series = harmonics(H, reader.between.theta)
    forward = -np.sum(np.abs(series) ** 2, axis=-1) - absorbed
    water = reader.density, reader.gravity
    force = mean_drift_of_series(order, series, forward, ahead(order, series, beta)[1], beta, k, n, *water)
    return about(force, reader.rotation_center)


def _absorbed(reader, omega, X):
    """Power ½ω² X* B′ X absorbed by the damping B′ beside radiation, W/m²; shape (q, p)"""
    loss = np.einsum("qpi,ij,qpj->qp", X.conj(), reader.damping, X).real
    if reader.viscous:
        laws = reader.viscous
        damped = [
            [laws.damping(w, laws.wave_amplitude * np.abs(x)) for x in row] for w, row in zip(omega, X, strict=True)
        ]
        loss = loss + np.einsum("qpi,qpij,qpj->qp", X.conj(), np.array(damped), X).real
    return 0.5 * omega[:, None] ** 2 * loss


def _amiss(reader, omega, headings):
    """Deviation of the far field from stored drift of the fixed body, linear between frequencies; shape (q, p, 3)"""
    if DRIFT[0] not in reader.between.quantities:
        return 0.0
    known, at_stored = reader.omega, reader.missed_drift
    low = np.clip(np.searchsorted(known, omega) - 1, 0, max(len(known) - 2, 0))
    high = np.minimum(low + 1, len(known) - 1)
    step = known[high] - known[low]
    share = np.where(step > 0, (omega - known[low]) / np.where(step > 0, step, 1.0), 0.0)[:, None, None]
    missed = (1 - share) * at_stored[low] + share * at_stored[high]
    if headings is None:
        return missed
    ring = reader.ring_of(DRIFT[0])
    return reader.to_headings(omega, headings, DRIFT[0]).value(ring.of_drift(missed), "drift")


def missed(reader):
    """Deviation of the far field from stored drift of the fixed body at stored waves; shape (n, m, 3)"""
    radiated, H = reader.far_field(reader.omega)
    return of_far_field(reader, reader.omega, None, radiated, H, None) - reader.between.quantities[DRIFT[0]]
