"""Laws that every solved frequency has to satisfy, and what two meshes say about each other.

Each function takes the quantities of one frequency (`bem.frequency.FrequencyRun`) and returns the largest
relative violation.  Radiation is measured by √|Zᵢᵢ Zⱼⱼ| with Z = A + iB/ω, forces by the larger of excitation and
diffraction force over the headings.
"""

from __future__ import annotations

import numpy as np

from .drift import energy_defect

# the error falls like this power of the number of panels: to a fifth from 104 to 416 of them on the series box,
# all coefficients, depths 12 m to infinity
ERROR_ORDER = 1.16
# a little less than that, so that the estimate is not below the error: against the contour method the error is 0.5 to
# 0.95 of it on boxes of L/B 1 to 8 in 1.2 to 10 drafts of water (tests/bench/contour_and_panels.py)
ESTIMATE_ORDER = 0.9


def check(run):
    """{name: largest relative violation}; NaN where what was computed allows no test"""
    out = dict.fromkeys(("reciprocity", "Haskind", "energy", "residual", "estimated_error"), np.nan)
    out["residual"] = run.residual
    energy = []
    if run.radiates:
        out["reciprocity"] = reciprocity(run)
    if run.radiates and run.diffracts and run.haskind is not None:
        out["Haskind"] = haskind(run)
    if run.radiates and run.far_field:
        energy.append(radiated_energy(run))
    if run.diffracts and run.far_field:
        energy.append(scattered_energy(run))
    if energy:
        out["energy"] = max(energy)
    return out


def reciprocity(run):
    """Z = Zᵀ"""
    Z = _wanted(run)
    return float((np.abs(Z - Z.T) / radiation_scale(run)).max())


def haskind(run):
    """The same excitation from the diffraction and from the radiation potentials"""
    gap = np.abs(run.haskind - run.excitation)[:, run.dofs]
    return float((gap / excitation_scale(run)).max())


def radiated_energy(run):
    """B = 2ρgC_g/(πkω²) ∫ Hᵢ H̄ⱼ dθ, the work done by a motion and the power of its waves"""
    H = run.kochin[0][0][run.dofs, : len(run.theta)]
    C_g = run.group_factor * run.omega / run.k
    factor = 2 * run.setup.density * run.setup.gravity * C_g / (np.pi * run.k * run.omega**2)
    B = factor * 2 * np.pi * (H @ H.conj().T).real / len(run.theta)
    return float((np.abs(B / run.omega - _wanted(run).imag) / radiation_scale(run)).max())


def scattered_energy(run):
    """(1/2π) ∫ |H|² dθ = −Re H(β) of the fixed body"""
    H, t, m = run.kochin[1][0], len(run.theta), np.arange(len(run.headings))
    return float(np.abs(energy_defect(H[:, :t], H[m, t + m])).max())


def estimated_error(run, rough, refinement):
    """Largest relative error of added mass, damping and excitation, from a coarser mesh of the same body.

    refinement : how many panels there are for one of the coarse mesh
    """
    out = []
    if run.radiates:
        out.append(np.abs(_wanted(run) - _wanted(rough)) / radiation_scale(run))
    if run.diffracts:
        out.append(np.abs(run.excitation - rough.excitation)[:, run.dofs] / excitation_scale(run))
    return float(max(o.max() for o in out)) / (refinement**ESTIMATE_ORDER - 1)


def _wanted(run):
    return run.radiation[np.ix_(run.dofs, run.dofs)]


def radiation_scale(run):
    """(dofs, dofs) √|Zᵢᵢ Zⱼⱼ|, infinite for modes that move no water"""
    size = np.sqrt(np.abs(np.diag(run.radiation)))
    size = np.where(run.prepared.displacing, size, np.inf)[run.dofs]
    return np.outer(size, size)


def excitation_scale(run):
    """(dofs,) size of the forces, infinite for modes that move no water

    Sway in head sea and heave in short waves are nothing but error: no force counts as less than a fifth of the
    largest, no moment as less than that of such a force at half the hull's radius.
    """
    size = np.maximum(np.abs(run.excitation), np.abs(run.diffraction)).max(axis=0)
    force = 0.2 * size[:3].max()
    floor = np.repeat([force, max(0.2 * size[3:].max(), 0.5 * force * run.prepared.radius)], 3)
    return np.where(run.prepared.displacing, np.maximum(size, floor), np.inf)[run.dofs]
