"""Added mass at the limits ω → 0 (rigid lid) and ω → ∞ (φ = 0 on the surface), by kernels of their own.

In finite depth a mode with net flux q = ∬ n dS (heave; roll and pitch of a lopsided waterplane) pushes water
through ever wider circles as ω → 0: A ~ −ρ q²/(2πh) ln kR, so that its zero-frequency added mass is infinite.
"""

from __future__ import annotations

import numpy as np

from .green_tables import limit_table
from .influence import assembled
from .modes import class_of
from .threads import blas_threads


def added_mass_limit(prepared, which):
    """A (6, 6) about the rotation centre for `which` "zero" or "infinity" of the frequency.

    returns : kg, kg m, kg m²; entries between two modes with net flux are +inf or −inf at zero in finite depth
    """
    if which not in ("zero", "infinity"):
        raise ValueError(f"limit is {which!r}; allowed: 'zero', 'infinity'")
    with blas_threads(len(prepared.geometry.elements.nodes)):
        return _limit(prepared, which)


def _limit(prepared, which):
    from scipy.linalg import solve

    g, setup, T = prepared.geometry, prepared.setup, prepared.transform
    table = limit_table(which, setup.depth, g.reach, g.mesh.draft)
    members = {c: [d for d in range(6) if class_of(d, setup.mesh.symmetry) == c] for c in g.classes}
    velocities = [prepared.modes[:, members[c]].T.astype(complex) for c in g.classes]
    # without waves the lid is not needed, and its density decouples because K = 0
    A, b = assembled(
        g, g.classes, 1.0 if which == "zero" else -1.0, table, lambda z: np.ones((*z.shape, 2)), velocities
    )
    weights = g.elements.weights[: g.hull, None] * len(g.images)
    out = np.zeros((6, 6))
    for i, c in enumerate(g.classes):
        n = len(members[c])
        phi = solve(A[i, : g.hull, : g.hull].real, b[i, : g.hull, :n].real)
        out[np.ix_(members[c], members[c])] = -setup.density * (phi.T @ (prepared.modes[:, members[c]] * weights)).T
    out = T @ out @ T.T
    if which == "zero" and np.isfinite(setup.depth):
        out = _with_net_flux(out, T @ (prepared.modes * weights).sum(axis=0) * _even(members), weights.sum())
    return out


def _even(members):
    """1 for the modes whose net flux the mirror planes leave, 0 for the others."""
    return np.array([1.0 if d in members[(1, 1)] else 0.0 for d in range(6)])


def _with_net_flux(added_mass, flux, area):
    product = np.outer(flux, flux)
    significant = np.abs(product) > 1e-9 * area * area
    return np.where(significant, np.copysign(np.inf, product), added_mass)
