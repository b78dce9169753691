"""Added mass of panels at the limits ω → 0 (rigid lid) and ω → ∞ (φ = 0 on the surface), by their Green functions.

In finite depth a mode with net flux q = ∬ n dS (heave; roll and pitch of an asymmetric waterplane) acts as ω → 0
like a source in plan, φ ~ ln kR. Its added mass A ~ −ρ q²/(2πh) ln kR is therefore infinite at zero frequency.
"""

import numpy as np

from ..algebra.systems import solved_systems
from ..green.tables import limit_table
from ..kernels.threads import blas_threads
from ..modes import with_net_flux
from .axisymmetric import sector_rows, solved_by_harmonics
from .influence import assembled


def added_mass_limit(prepared, which):
    """Added mass about the rotation centre at ω → `which`, "zero" or "infinity": (6, 6), or (6N, moving modes).

    returns : kg, kg m, kg m²; in finite depth, entries between two modes with net flux are +inf or −inf at zero
        frequency
    """
    g, velocities, table, mirror = given_at_limit(prepared, which)
    if g.sectors:
        S, D = sector_rows(g, mirror, table, unit_depth_values)
        of_class = {cls: v.T for cls, v in zip(g.classes, velocities, strict=True)}
        found, _ = solved_by_harmonics(g, S.real, D.real, 0.0, of_class)
        return added_mass_of(prepared, [phi.real for phi in found.values()], which)
    with blas_threads(1):
        found = assembled(g, g.classes, mirror, table, unit_depth_values, [v.T for v in velocities])
    sides = [b.real[:, : v.shape[1]] for b, v in zip(found.sides, velocities, strict=True)]
    potentials = [phi.T for phi in solved_systems(found.matrices, sides)]
    if not np.all(np.isfinite(np.concatenate(potentials))):
        raise FloatingPointError(f"added mass at {which} frequency: the solution is not finite")
    return added_mass_of(prepared, potentials, which)


def given_at_limit(prepared, which):
    """Geometry, velocities (n, columns) of each class, table of G, and factor of 1/r₁, at the limit `which`"""
    if which not in ("zero", "infinity"):
        raise ValueError(f"limit is {which!r}; allowed: 'zero', 'infinity'")
    g = prepared.geometry.without_lid  # without waves there are no irregular frequencies
    table = limit_table(which, prepared.problem.depth, g.reach, g.draft)
    return g, [g.modes[:, g.members(c)] for c in g.classes], table, 1.0 if which == "zero" else -1.0


def unit_depth_values(z):
    """Arbitrary Z and Z′ for a Green function without waves, in which their factor C is zero"""
    return np.ones((*z.shape, 2))


def added_mass_of(prepared, potentials, which):
    """Added mass as from `added_mass_limit`; potentials : potentials (dofs of the class, n) of each symmetry class"""
    g, problem, T = prepared.geometry, prepared.problem, prepared.problem.transform
    modes = g.modes * g.elements.weights[: g.hull, None] * g.copies
    out = np.zeros((len(T), len(T)))
    for cls, phi in zip(g.classes, potentials, strict=True):
        members = g.members(cls)
        out[np.ix_(members, members)] = -problem.density * (phi @ modes[:, members]).T
    out = T @ out @ T.T
    if which == "zero" and np.isfinite(problem.depth):
        even = [
            1.0 if d in g.members((1, 1)) else 0.0 for d in range(len(T))
        ]  # mirror planes leave no net flux in others
        out = with_net_flux(out, T @ modes.sum(axis=0) * even, g.elements.weights[: g.hull].sum() * g.copies)
    return out[:, problem.moving]
