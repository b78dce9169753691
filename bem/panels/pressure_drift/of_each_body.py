"""Mean drift of each of several bodies, from the pressure on its own hull.

As `bem.methods.near_field`, body by body: the far field knows of all bodies together alone.  What each of them pushes
off from another, the sum does not see; that it equals the far field is a check of both.
"""

from __future__ import annotations

from copy import copy

import numpy as np

from ...modes import axes_of
from .hull_flow import HullSurfaces, disturbed_flow, hull_surfaces
from .mean_drift import check_panels, pressure_pairs
from .turned_loads import rotated_pairs

MEAN = [0, 1, 5]  # surge, sway and yaw


def drift_of_each(run, moving):
    """(m, bodies, 3) N/m², N m/m²: mean surge, sway and yaw of each, about its own point in its own axes.

    run : `bem.panels.one_frequency.PanelRun` of several bodies; moving : those that are not fixed float freely
    """
    check_panels(run.problem, run.geometry.mesh)
    surfaces, bodies, waves = hull_surfaces(run.geometry), run.problem.bodies, len(run.headings)
    own = np.zeros((waves, run.count), complex)  # motions, each about its own point in its own axes
    if moving:
        own[:, run.problem.moving] = run.rao
    load, out = _first_order_loads(run, own), np.zeros((waves, len(bodies), 3))
    for i, body in enumerate(bodies):
        six, T = slice(6 * i, 6 * i + 6), axes_of((body,))
        surface = HullSurfaces(*(_of_body(part, run.geometry.mesh.body, i) for part in _parts(surfaces)))
        flow = disturbed_flow(run, surface, own @ run.problem.transform, own[:, six] @ T)
        each = np.arange(waves)
        pressure = pressure_pairs(surface, flow, run.problem)[each, each] @ T.T
        turned = rotated_pairs(load[:, six], own[:, six])[each, each]
        out[:, i] = (pressure + turned)[:, MEAN].real
    return out


def _first_order_loads(run, motions):
    """(m, 6N) first-order load of water and weight, each about its own point in its own axes"""
    T, own = run.problem.transform, run.problem.moving
    load = run.excitation @ T.T + motions @ (run.omega**2 * T @ run.radiation @ T.T).T
    if np.any(motions):
        load -= motions[:, own] @ run.problem.hydrostatic_stiffness.T
    return load


def _parts(surfaces):
    return surfaces.hull, surfaces.waterline


def _of_body(surface, body, number):
    """A surface with weights on the panels of one body alone"""
    one = copy(surface)
    points = surface.flow.points.shape[1]
    here = np.repeat(body[surface.flow.panels] == number, points)
    one.weights = surface.weights * np.tile(here, surface.copies)
    return one
