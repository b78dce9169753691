"""Deep water replaced by a raised bed, which short waves do not reach: the contour method then serves any depth.

    s = F c,    c = max(b, d),    F = max(10, (1.4 / tolerance)^(1/2)),    h = d + s

with b the radius or half the smaller width, d the draft.  Waves of kh ≥ 14 have the wavenumber and group velocity of
infinite depth to 1e-10.  The non-radiating flow of a body is at the bed that of a dipole and its image in the free
surface, which decays like distance^(−2) for a slender body and faster for a short one; the bed adds

    0.7 (c/s)²    at most, half the tolerance, of √|Zᵢᵢ Zⱼⱼ|, of damping by its own size (`bem.checks.damping_scale`)
                  and of the excitation.

Against beds four times as deep it was 0.6 (c/s)² in heave of a box of L/B = 20 and b = d, 0.3 and less for flatter
and deeper ones, 0.6 (c/s)² in damping and 0.4 (c/s)² in the excitation (tests/bench/raised_bed.py).  The deeper the
bed, the more digits the contour method loses: F² max(b, d) / min(b, d) is at most 1.4e4, and a third of the tolerance
is asked for.
"""

from __future__ import annotations

import numpy as np

from ..checks import damping_scale, enlarged, excitation_scale, radiation_scale

EFFECT = 0.7
LEAST_GAP = 10.0  # F
LEAST_PHASE = 14.0  # kh
HIGHEST = 1.4e4  # F² max(b, d) / min(b, d)
SHARE = 1 / 3  # of the tolerance that is left to the contour method


def raised_bed(shape, sizes, tolerance, k):
    """h in m, or None where waves of `k` rad/m are longer than the body, reach the bed, or accuracy would be lost.

    shape, sizes : as of `bem.methods.shape_problem.ShapeProblem`; tolerance : relative error of the coefficients
    """
    half, draft, across = _lengths(shape, sizes)
    factor = max(LEAST_GAP, (2 * EFFECT / tolerance) ** 0.5)
    bed = draft + factor * max(half, draft)
    short = k * across >= 2 * np.pi and k * bed >= LEAST_PHASE
    reached = factor**2 * max(half, draft) <= HIGHEST * min(half, draft) * (1 + 1e-9)  # where both are round numbers
    return float(bed) if short and reached else None


def effect_of_bed(shape, sizes, bed):
    """Largest relative effect on coefficients and forces of a bed at depth `bed` (m)"""
    half, draft, _ = _lengths(shape, sizes)
    return EFFECT * (max(half, draft) / (bed - draft)) ** 2


def bed_share(problem):
    """`effect_of_bed` of a problem over a raised bed, zero without one"""
    if problem.bed is None or problem.bed >= problem.depth:
        return 0.0
    return effect_of_bed(problem.shape, problem.sizes, problem.bed)


def with_bed(run, radiation, excitation):
    """Errors of radiation (6, 6) and excitation (m, 6), with the effect of a run's raised bed added.

    Entries that are zero by symmetry stay zero.
    """
    share = bed_share(run.problem)
    if not share:
        return radiation, excitation
    radiation, excitation = radiation + 0, excitation + 0
    if run.radiates:
        block = np.ix_(run.dofs, run.dofs)
        own = damping_scale(run.radiation[block], run.prepared.displacing[run.dofs])
        A = enlarged(radiation[block].real, share * _finite(radiation_scale(run)))
        radiation[block] = A + 1j * enlarged(radiation[block].imag, share * _finite(own))
    if run.diffracts:
        excitation[:, run.dofs] = enlarged(excitation[:, run.dofs], share * _finite(excitation_scale(run)))
    return radiation, excitation


def _lengths(shape, sizes):
    """b, d and the largest width, m"""
    *widths, draft = sizes
    return (min(widths) / 2, draft, max(widths)) if shape == "box" else (widths[0], draft, 2 * widths[0])


def _finite(scale):
    return np.where(np.isfinite(scale), scale, 0.0)
