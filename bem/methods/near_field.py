"""Mean drift from the pressure on the hull: an independent check of the drift from the far field.

    F = −½ρg ∮ ζ_r² n dl + ½ρ ∬ |∇φ|² n dS + ρ ∬ (X·∇φ_t) n dS + α × F₁,        M alike, and α × M₁ + X_c × F₁

mean over a period (Pinkster 1980), n out of the body, ζ_r the wave elevation relative to the hull, X the displacement
of a hull point, X_c the displacement of the rotation centre, α the rotations;
F₁ and M₁ the first-order load of water and weight
about the rotation centre, equal to inertia times acceleration for a body without other restraint.

The relative error of the pressures, times ρgζ² times the breadth, is the error of the drift, however small the drift
is. In long waves this error exceeds the drift.

The momentum flux through a surface in the water around the hull would be no check: for every flow by Green's theorem
or by eigenfunctions, right or wrong, it equals the flux far away.
"""

import numpy as np

from ..panels.pressure_drift.turned_loads import rotated_pairs
from ..second_order.rotations import first_order_loads


def near_field_drift(run, moving):
    """Mean drift about the rotation centre from the potentials of a solved frequency; shape (m, 3).

    Units and axes are those of `bem.drift.mean_drift`.

    run : the quantities of one frequency of a mesh with four nodes per panel (`bem.panels.one_frequency.PanelRun`)
        or of the contour method (`bem.methods.shape_run.ShapeRun`); a run of the contour method must include the
        drift by the far field
    moving : whether the body floats freely; False: the body is fixed
    raises : ValueError for a method without pressures on the hull, or a run without the needed quantities
    """
    force = _method(run, moving).pressure_drift(run, _motions(run, moving))
    return force + rotated_loads(run) if moving else force


def near_field_error(run, moving):
    """Estimated bound, N/m² and N m/m², of the difference between the drifts from near field and far field; shape (m,
    3)

    For each metre of breadth and squared wave amplitude, the terms at the waterline are up to ρg(1 + v)², because water
    rises to twice the wave height at a wall, and the terms on the sides are up to ρω²d a². Here v is the vertical
    motion at the waterline, and a the motion of any point of the hull.
    A relative error of the pressures causes twice this relative error in these terms.  The relative error of the
    pressures is taken from the estimated errors of coefficients and forces. In the contour method the error of forces
    is of second order and that of pressures of first order; the relative error of pressures is therefore taken as at
    least `bem.contour.pressure_drift.PRESSURES`.
    Errors of the motions are not included, because drift from near and far field is equal for any motions.

    run, moving : as in `near_field_drift`
    raises : ValueError as in `near_field_drift`, and for panels without an estimate of their errors
    """
    method, radius, draft = _method(run, moving), run.prepared.radius, run.prepared.draft
    if run.errors is None:
        raise ValueError(
            "the error of near-field drift by panels is estimated only in a run that also has a coarse mesh; "
            "give such a run"
        )
    rho, g = run.problem.density, run.problem.gravity
    motions, lever = np.abs(_motions(run, moving)), np.hypot(radius, draft)
    vertical = motions @ [0, 0, 1, radius, radius, 0]
    any_point = motions @ [1, 1, 1, lever, lever, radius]
    size = rho * (g * (1 + vertical) ** 2 + run.omega**2 * draft * any_point**2) * 2 * radius
    arm = radius + np.hypot(*run.problem.rotation_center[:2])
    return 2 * method.pressure_error(run) * size[:, None] * [1, 1, arm]


def _motions(run, moving):
    """Motions about the origin, m/m and rad/m; shape (m, 6)"""
    return run.rao @ run.problem.transform if moving else np.zeros((len(run.headings), 6), complex)


def _method(run, moving):
    """The module of the run's method"""
    if not (run.far_field and run.diffracts and (run.free or not moving)):
        name = "drift_force, of a body with its inertia" if moving else "drift_force_fixed"
        raise ValueError(f"want of the run is {', '.join(sorted(run.want))}; near-field drift also needs {name}")
    if hasattr(run, "geometry"):
        from ..panels.pressure_drift import mean_drift as panel_drift

        return panel_drift
    if run.problem.shapes:
        raise ValueError(
            "the contour method computes near-field drift for one body only; use the panel method for several bodies"
        )
    if run.problem.method != "contour":
        raise ValueError(f"the method is {run.problem.method}; near-field drift needs panel or contour")
    from ..contour import pressure_drift as contour_drift

    return contour_drift


def rotated_loads(run):
    """Part of mean surge, sway and yaw drift from first-order loads that turn with the body, about the rotation centre;
    shape (m, 3)"""
    pairs = rotated_pairs(first_order_loads(run, run.problem, run.rao), run.rao)
    each = np.arange(len(run.headings))
    return pairs[each, each][:, [0, 1, 5]].real
