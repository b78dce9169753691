"""Laws that the results of every solved frequency must satisfy, and error estimates from two meshes.

Each function takes the quantities of one frequency (`bem.frequency.FrequencyRun`) and returns the largest relative
violation.  Radiation is relative to √|Zᵢᵢ Zⱼⱼ| with Z = A + iB/ω, forces to the larger of excitation and diffraction
force over the headings.

Damping governs the motion at resonance. Its error is therefore also measured relative to √(bᵢ bⱼ) (`damping_error`),
about the rotation centre, with

    b = max(B, ωA / πN)       the damping itself, or the damping with which oscillations exp(−Bt / 2(M + A)) of
               any mass M take N periods and more to die out

for any inertia and restoring forces, which moorings change.  A resonance with so little damping does not develop fully
within N periods; its height depends on the duration of the waves.  N = 1000 is three hours of waves of 11 s.  In
waves that start from rest and last N periods, the mean variance of the resonant motion is proportional to (1 − (1 −
e⁻ˣ)/x)/x, with x = 2B/b₀ ≤ 2 for B ≤ b₀ = ωA / πN. An error b₀ε of B then changes the standard deviation by ε/3 at
most (tests/bench/damping_floor.py).
"""

import numpy as np

from .drift import energy_defect
from .modes import turning

# the error falls with this power of the number of panels: by five from 104 to 416 panels on the series box, all
# coefficients, depths 12 m to infinity; estimates made with it are right in the median (tests/bench/tolerance.py)
ERROR_ORDER = 1.16
PERIODS = 1000  # N, in a sea state


def sufficient_accuracy(panels):
    """Relative accuracy that suffices for approximate equations: a twentieth of the discretisation error of `panels`
    panels

    The discretisation error falls with `ERROR_ORDER` from one per cent at 250 panels.
    """
    return float(np.clip(0.05 * 0.01 * (250 / panels) ** ERROR_ORDER, 2e-5, 1e-4))


def check(run):
    """{name: largest relative violation}; NaN for laws that the computed quantities cannot test"""
    out = dict.fromkeys(("reciprocity", "Haskind", "energy", "residual", "estimated_error"), np.nan)
    out["residual"] = run.residual
    energy = []
    if run.radiates:
        out["reciprocity"] = reciprocity(run)
    if run.radiates and run.diffracts and run.haskind is not None:
        out["Haskind"] = haskind(run)
    if run.radiates and run.radiated is not None:
        energy.append(radiated_energy(run))
    if run.diffracts and run.far_field:
        energy.append(scattered_energy(run))
    if energy:
        out["energy"] = max(energy)
    return out


def reciprocity(run):
    """Violation of reciprocity, Z = Zᵀ"""
    Z = _wanted(run)
    return float((np.abs(Z - Z.T) / radiation_scale(run)).max())


def haskind(run):
    """Difference between the excitation force from the diffraction potential and that from the radiation potentials"""
    gap = np.abs(run.haskind - run.excitation)[:, run.dofs]
    return float((gap / excitation_scale(run)).max())


def radiated_energy(run):
    """Violation of energy conservation: difference between the damping from the work of a motion and the damping from
    the power of the radiated waves"""
    far = run.radiated[np.ix_(run.dofs, run.dofs)]
    return float((np.abs(far - _wanted(run).imag) / radiation_scale(run)).max())


def scattered_energy(run):
    """Violation of (1/2π) ∫ |H|² dθ = −Re H(β) of the fixed body, corrected for the absorption by damping lids"""
    H, t, m = run.kochin[1][0], len(run.theta), np.arange(len(run.headings))
    return float(np.abs(energy_defect(H[:, :t], H[m, t + m] + run.taken_at_rest)).max())


def estimate(run, rough, refinement):
    """Errors, computed minus exact, of radiation (6, 6) and excitation (m, 6), from a coarser mesh of the same body.

    refinement : number of panels over the number of panels of the coarse mesh
    """
    share = share_left(refinement)
    return share * (rough.radiation - run.radiation), share * (rough.excitation - run.excitation)


def share_left(refinement):
    """Error of the results of a mesh over their difference from those of a coarser mesh; refinement : as in
    `estimate`"""
    return 1 / (refinement**ERROR_ORDER - 1)


def at_least_haskind(error, excitation, haskind, dofs):
    """Errors of excitation (m, 6), raised in `dofs` to at least the difference between two computations of the force.

    error : errors from another estimate, (m, 6); excitation, haskind : forces by diffraction and by Haskind's
        relation, (m, 6)
    """
    out, gap = np.array(error), excitation - haskind
    out[:, dofs] = np.where(np.abs(gap) > np.abs(error), gap, error)[:, dofs]
    return out


def enlarged(error, by):
    """Complex errors with moduli enlarged by `by`; errors that are zero by symmetry remain zero"""
    size = np.abs(error)
    return np.where(size > 0, error / np.where(size > 0, size, 1.0), 0.0) * (size + by)


def largest_error(run, radiation, excitation):
    """The largest relative error, from errors of radiation (6, 6) and excitation (m, 6)"""
    out = []
    if run.radiates:
        out.append(np.abs(radiation[np.ix_(run.dofs, run.dofs)]) / radiation_scale(run))
    if run.diffracts:
        out.append(np.abs(excitation[:, run.forced]) / excitation_scale(run, run.forced))
    return float(max(o.max() for o in out))


def damping_error(run, radiation):
    """The largest error of damping relative to `damping_scale`, from errors of radiation (6, 6); 0 without errors"""
    if not run.radiates:
        return 0.0
    T = run.problem.transform[run.asked]
    size = damping_scale(T @ run.radiation @ T.T, run.prepared.displacing[run.asked])
    return float((np.abs((T @ radiation @ T.T).imag) / size).max())


def _wanted(run):
    return run.radiation[np.ix_(run.dofs, run.dofs)]


def radiation_scale(run):
    """√|Zᵢᵢ Zⱼⱼ|, infinite for modes that move no water; shape (dofs, dofs)"""
    size = np.sqrt(np.abs(np.diag(run.radiation)))
    size = np.where(run.prepared.displacing, size, np.inf)[run.dofs]
    return np.outer(size, size)


def damping_scale(radiation, displacing, periods=PERIODS):
    """√(bᵢ bⱼ)/ω from radiation A + iB/ω (…, d, d) about the rotation centre; infinite for modes that are not
    `displacing` (d,)"""
    Z = np.einsum("...ii->...i", radiation)
    b = np.maximum(np.abs(Z.imag), np.abs(Z.real) / (np.pi * periods))
    b = np.where(displacing & (b > 0), b, np.inf)
    return np.sqrt(b[..., :, None] * b[..., None, :])


def excitation_scale(run, of=None):
    """Scale of the forces with numbers `of` (None: all); infinite for modes that move no water; shape (of,)

    Sway in a head sea and heave in short waves contain only error. The scale of a force is therefore at least a fifth
    of the largest force, and the scale of a moment at least this smallest force at half the hull's radius.
    """
    size = np.maximum(np.abs(run.excitation), np.abs(run.diffraction)).max(axis=0)
    turns = turning(run.problem.bodies, run.problem.modes)
    force = 0.2 * size[~turns].max()
    floor = np.where(turns, max(0.2 * size[turns].max(), 0.5 * force * run.prepared.radius), force)
    return np.where(run.prepared.displacing, np.maximum(size, floor), np.inf)[run.dofs if of is None else of]
