"""Motions and mean drift of the free body from known results at one frequency; no flow problem is solved.

    {−ω²[M + A] − iω[B + B'] + C} X = F,      H = H_D + Σ Xⱼ Hⱼ

with added mass A, damping B, excitation F and Kochin functions H, which do not depend on mass, gyration, centre of
gravity and viscous damping B' (`bem.motions`, `bem.viscous`, `bem.drift`).
"""

import numpy as np

from .drift import about, mean_drift, slope_and_ahead
from .motions import response
from .viscous import linearised_response
from .waves import group_factor, wavenumber

COEFFICIENTS = ("added_mass", "radiation_damping", "excitation_force")
KOCHIN = ("kochin_radiation", "kochin_diffraction")


def needed(want):
    """Names of the quantities from which "rao" and "drift_force" are computed"""
    return COEFFICIENTS + (KOCHIN if "drift_force" in want else ())


def motions(problem, omega, added_mass, damping, excitation):
    """Motions X (m, 6), m/m and rad/m, of a `bem.problem.Problem`, about its rotation centre like all arguments.

    added_mass, damping : (6, 6); excitation : (m, 6)
    For N bodies the shapes are (6N, moving), (m, 6N), and (m, moving) for X.
    """
    if problem.structural_damping is not None:
        damping = damping + problem.structural_damping
    terms = omega, added_mass, damping, excitation, problem.inertia_matrix, problem.hydrostatic_stiffness
    if problem.bodies:
        own, (_, A, B, F, M, C) = problem.moving, terms
        terms = omega, A[own], B[own], F[:, own], M[own], C[own]
    return response(*terms) if problem.viscous is None else linearised_response(*terms, problem.viscous)[0]


def free_body(problem, omega, headings, theta, flow):
    """{"rao": (m, 6)} of a `bem.problem.Problem`, and {"drift_force": (m, 3)} where Kochin functions are known.

    omega : rad/s; headings : (m,) rad; theta : (t,) rad, equally spaced
    flow : {name: values} of the `needed` quantities as in the database, at this frequency and these headings
    raises : FloatingPointError if viscous damping is not found
    """
    made = {"rao": motions(problem, omega, *(flow[name] for name in COEFFICIENTS))}
    if set(KOCHIN) <= set(flow):
        H = flow["kochin_diffraction"] + made["rao"] @ flow["kochin_radiation"]
        k = float(wavenumber(omega, problem.depth, problem.gravity))
        far = slope_and_ahead(H, theta, np.asarray(headings, float))
        water = k, float(group_factor(k, problem.depth)), problem.density, problem.gravity
        made["drift_force"] = about(mean_drift(H, *far, theta, headings, *water), problem.rotation_center)
    return made
