"""Mean drift of each of several bodies, from the pressure on the hull of the body.

The formula is that of `bem.methods.near_field`, applied body by body, because the far field gives only the sum over
all bodies. Forces between bodies cancel in this sum, which must agree with the far field.

For a flexible body, X = u(x), the area vector of a piece of the hull also changes, by n ∇·u − (∇u)ᵀn, which is α × n
for a rotation.  With the dynamic pressure p = −ρφ_t alone, because the hydrostatic part gives only vertical force,

    F = −½ρg ∮ (ζ² − 2ζ u_z) n dl + ½ρ ∬ |∇φ|² n dS − ∬ (u·∇p) n + p {n ∇·u − (∇u)ᵀn} dS,        M likewise, and −u × pn
"""

from copy import copy

import numpy as np

from ...flexible.coupling import gradients
from ...modes import axes_of
from .hull_flow import HullSurfaces, disturbed_flow, hull_surfaces
from .mean_drift import check_panels, pressure_pairs
from .turned_loads import rotated_pairs

MEAN = [0, 1, 5]  # surge, sway and yaw


def drift_of_each(run, moving):
    """Mean surge, sway and yaw drift of each body, about its rotation centre and along its axes, N/m², N m/m²; shape
    (m, bodies, 3).

    run : `bem.panels.one_frequency.PanelRun` of several bodies; moving : whether bodies that are not fixed float freely
    """
    check_panels(run.problem, run.geometry.mesh)
    bodies, waves = run.problem.bodies, len(run.headings)
    own = own_motions(run, moving)
    load, out = first_order_loads(run, own), np.zeros((waves, len(bodies), 3))
    motions = own @ run.problem.transform
    surfaces = surfaces_of_each(hull_surfaces(run.geometry), run.geometry.mesh)
    for i, (body, surface) in enumerate(zip(bodies, surfaces, strict=True)):
        six, T = slice(6 * i, 6 * i + 6), axes_of((body,))
        if run.problem.modes:
            out[:, i] = (_bent_load(run, surface, motions, own[:, six] @ T, i) @ T.T)[:, MEAN]
            continue
        flow = disturbed_flow(run, surface, motions, own[:, six] @ T)
        each = np.arange(waves)
        pressure = pressure_pairs(surface, flow, run.problem)[each, each] @ T.T
        turned = rotated_pairs(load[:, six], own[:, six])[each, each]
        out[:, i] = (pressure + turned)[:, MEAN].real
    return out


def _bent_load(run, surface, motions, own, number):
    """Mean load on a body that may bend, about the origin; shape (m, 6); motions : (m, n) of all; own : (m, 6) of this
    one"""
    rigid, problem, line = 6 * len(run.problem.bodies), run.problem, surface.waterline
    shapes = [(mode, motions[:, d]) for d, mode in enumerate(problem.modes, rigid) if number in mode.moves]

    def bent(points):
        out = np.zeros((len(motions), *points.shape), complex)
        for mode, motion in shapes:
            out += np.multiply.outer(motion, mode.displacement(points))
        return out

    def displaced(points):
        return bent(points) + own[:, None, :3] + np.cross(own[:, None, 3:], points)

    flow, x, n = disturbed_flow(run, surface, motions, own, bent), surface.hull.points, surface.hull.normals
    u, weights, scale = displaced(x), surface.hull.weights, 1j * problem.density * run.omega
    slope = gradients(displaced, x, float(np.ptp(x, axis=0).max()))
    p, up = scale * flow.on_hull, scale * flow.velocity
    square = 0.25 * problem.density * np.sum(np.abs(flow.velocity) ** 2, axis=-1)
    along = square - 0.5 * np.sum(u.conj() * up, axis=-1).real
    turned = np.einsum("fpaa->fp", slope)[..., None] * n - np.einsum("fpba,pb->fpa", slope, n)
    force = along[..., None] * n - 0.5 * (p[..., None] * turned.conj()).real
    moment = np.cross(x, force) - 0.5 * (p[..., None] * np.cross(u, n).conj()).real
    rise, lifted = 1j * run.omega / problem.gravity * flow.potential, displaced(line.points)[..., 2]
    crest = 0.25 * problem.density * problem.gravity * (np.abs(rise) ** 2 - 2 * (rise * lifted.conj()).real)
    at_line = -(crest * line.weights) @ surface.waterline_modes
    return np.concatenate([weights @ force, weights @ moment], axis=-1) + at_line


def own_motions(run, moving):
    """Motions of all bodies in the waves of a run, about the rotation centre and along the axes of each body; shape
    (m, 6N);
    0 for fixed bodies"""
    out = np.zeros((len(run.headings), run.count), complex)
    if moving:
        out[:, run.problem.moving] = run.rao
    return out


def first_order_loads(run, motions):
    """First-order load of water and weight on all bodies, about the rotation centre and along the axes of each body;
    shape (m, 6N)"""
    T, own = run.problem.transform, run.problem.moving
    load = run.excitation @ T.T + motions @ (run.omega**2 * T @ run.radiation @ T.T).T
    if np.any(motions):
        load -= motions[:, own] @ run.problem.hydrostatic_stiffness.T
    return load


def surfaces_of_each(whole, mesh):
    """[`hull_flow.HullSurfaces`] of each body of a mesh: the points of the whole mesh, with weights that are zero
    except on the body"""
    parts = whole.hull, whole.waterline
    return [HullSurfaces(*(_of_body(part, mesh.body, i) for part in parts)) for i in range(mesh.bodies)]


def _of_body(surface, body, number):
    """A surface with zero weights except on the panels of one body"""
    one = copy(surface)
    points = surface.flow.points.shape[1]
    here = np.repeat(body[surface.flow.panels] == number, points)
    one.weights = surface.weights * np.tile(here, surface.copies)
    return one
