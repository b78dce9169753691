"""Second-order loads from products of first-order quantities, by integration of the pressure on the panels of a hull.

    T_ij = −¼ρg ∮ ζᵢζ̄ⱼ n dl + ¼ρ ∬ {∇φᵢ·∇φ̄ⱼ + Xᵢ·∇∂φ̄ⱼ/∂t + X̄ⱼ·∇∂φᵢ/∂t} n dS,        moments with x × n in place of n

for two waves of unit amplitude: Re Σ Σ aᵢāⱼ T_ij exp{−i(ωᵢ − ωⱼ)t} is the load at difference frequencies, and T_ii is
the mean drift (`bem.methods.near_field`).
T_ji is the conjugate of T_ij. The formula without conjugates gives T⁺ for the load at sum frequencies, Re Σ Σ aᵢaⱼ
T⁺_ij exp{−i(ωᵢ + ωⱼ)t}.

The singularity at edges is integrated by `hull_interpolation`; the remaining error is the discretisation error of the
potentials, mainly through the motions.
"""

import warnings

import numpy as np

from ...drift import about
from .edges import coarsest_at_gap
from .hull_flow import hull_surfaces, unit_displacements, wave_flow

# largest length of panels next to the keel over the gap.  Box, gap 2 m, resonant roll: near and far field differ by 4 %
# of the largest force on the fixed body with panels of 1.2 m, by 9 % with 2.5 m, by 100 % with 7.3 m
LONGEST_PER_GAP = 1.5


def pressure_drift(run, motions):
    """Mean surge, sway and yaw of the pressure on the hull, about the rotation centre; shape (m, 3); N/m², N m/m².

    run : `bem.panels.one_frequency.PanelRun` with four nodes on each panel; motions : motions about the origin, (m, 6)
    raises : ValueError for constant panels and for zero draft
    """
    check_panels(run.problem, run.geometry.mesh)
    surfaces = hull_surfaces(run.geometry)
    loads = pressure_pairs(surfaces, wave_flow(run, surfaces, motions), run.problem)
    each = np.arange(len(motions))
    return about(loads[each, each][:, [0, 1, 5]].real, run.problem.rotation_center)


def pressure_pairs(surfaces, flow, problem, second=np.conj):
    """Complex transfer functions T of all pairs of the f waves of a `hull_flow.HullFlow`, about the origin; shape (f,
    f, 6); N/m², N m/m²

    second : function of the second wave's amplitudes that returns their conjugates, or, for sum frequencies, the
        amplitudes
    """
    hull, line, rho = surfaces.hull, surfaces.waterline, problem.density
    u, n = flow.velocity.reshape(len(flow.omega), -1), surfaces.hull_modes * hull.weights[:, None]
    squares = np.stack([(u * np.repeat(weight, 3)) @ second(u).T for weight in n.T], axis=-1)
    carried = -1j * flow.omega[:, None, None] * carried_flow(surfaces, flow)
    across = np.einsum("im,jmc->ijc", flow.motion, second(carried))
    rise = 1j * flow.omega[:, None] / problem.gravity * flow.potential
    rise = rise - flow.motion @ unit_displacements(line.points)[..., 2]
    crest = np.stack(
        [(rise * weight) @ second(rise).T for weight in (surfaces.waterline_modes * line.weights[:, None]).T], axis=-1
    )
    return 0.25 * rho * (squares + across + second(across).swapaxes(0, 1) - problem.gravity * crest)


def carried_flow(surfaces, flow):
    """Integrals ∬ e_m·∇φ n_c dS with the displacement e_m of unit motion m about the origin; shape (f, 6, 6)"""
    out = np.zeros((len(flow.omega), 6, 6), complex)
    for (m, c), carried, parts in zip(surfaces.hull.products, surfaces.carried, flow.parts, strict=True):
        real, imaginary = parts @ carried.T
        out[:, m, c] = real + 1j * imaginary
    return out


def pressure_error(run):
    """Relative error of the pressures, estimated like the error of coefficients and forces

    raises : ValueError as `pressure_drift`
    """
    check_panels(run.problem, run.geometry.mesh)
    return run.estimated_error()


def check_panels(problem, mesh):
    """Raise ValueError for constant panels and zero draft, and warn of panels that are long relative to the gap under
    the keel"""
    if problem.nodes_per_panel != 4:
        raise ValueError(f"nodes_per_panel is {problem.nodes_per_panel}; near-field drift needs 4")
    if problem.zero_draft:
        raise ValueError("near-field drift needs a hull with sides, and the draft is 0; use the drift by the far field")
    length, gap = coarsest_at_gap(mesh, problem.depth)
    if length > LONGEST_PER_GAP * gap:
        warnings.warn(
            f"near-field drift: panels next to the keel are {length:.3g} m long over a gap of {gap:.3g} m; "
            f"reliable: up to {LONGEST_PER_GAP * gap:.3g} m; give more panels, or finer panels there",
            stacklevel=4,
        )
