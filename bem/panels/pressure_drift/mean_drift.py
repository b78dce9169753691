"""Mean drift from the pressure on the panels of a hull, by the formula of `near_field`; at edges see `panel_samples`.

What is left is the error of the potentials themselves, first of all that of motions, which the edges spread over the
whole hull.
"""

from __future__ import annotations

import warnings

import numpy as np

from ...drift import about
from ...waves import incident_wave
from .edges import coarsest_at_gap, sharp_sides
from .hull_interpolation import line_samples, samples

# gaps that panels next to the keel may be long: box, gap 2 m, resonant roll, near and far field differ by 4 % of the
# largest force on the fixed body with panels of 1.2 m, 9 % with 2.5 m, all of it with 7.3 m
LONGEST_PER_GAP = 1.5


def pressure_drift(run, motions):
    """(m, 3) mean surge, sway and yaw of the pressure on the hull, about the rotation centre; N/m², N m/m².

    run : `bem.panels.one_frequency.PanelRun` of a mesh with four nodes a panel; motions : (m, 6) about the origin
    raises : ValueError for constant panels and for zero draft
    """
    _check(run)
    parts, loads = ((_hull(run), _hull_density), (_waterline(run), _waterline_density)), np.zeros((len(motions), 6))
    for j, motion in enumerate(motions):
        phi = _on_images(run, run.disturbance(j, bool(motion.any())))
        for sample, density in parts:
            for x, n, weight, value, gradient in sample.images(phi, j, motion):
                load = density(run, value, gradient, n, displacement(motion, x)) * weight
                loads[j] += np.concatenate([load @ n, load @ np.cross(x, n)])
    return about(loads[:, [0, 1, 5]], run.problem.rotation_center)


def pressure_error(run):
    """Relative error of the pressures, taken to be that of coefficients and forces

    raises : ValueError as `pressure_drift`
    """
    _check(run)
    return run.estimated_error()


def displacement(motion, x):
    """(…, 3) of the points x (…, 3), motion (6,) about the origin"""
    return motion[:3] + np.cross(motion[3:], x)


def _on_images(run, parts):
    """(images, nodes) φ without the incident waves, from its symmetry classes"""
    return sum(np.multiply.outer(run.geometry.signs(cls), phi) for cls, (phi, _) in parts.items())


def _check(run):
    problem = run.problem
    if problem.nodes_per_panel != 4:
        raise ValueError(f"near-field drift with {problem.nodes_per_panel} node a panel; allowed: 4")
    if problem.zero_draft:
        raise ValueError("near-field drift at zero draft; allowed: a hull with sides, the far field is right without")
    length, gap = coarsest_at_gap(run.geometry.mesh, problem.depth)
    if length > LONGEST_PER_GAP * gap:
        warnings.warn(
            f"near-field drift: panels next to the keel are {length:.3g} m long over a gap of {gap:.3g} m; "
            f"reliable: up to {LONGEST_PER_GAP * gap:.3g} m, with more panels or finer ones there",
            stacklevel=4,
        )


def _hull_density(run, phi, gradient, normal, moved):
    speed = -1j * run.omega * np.sum(moved * normal, axis=1)
    gradient = gradient + speed[:, None] * normal
    carried = np.sum(moved.conj() * (-1j * run.omega) * gradient, axis=1).real
    return run.problem.density * (0.25 * np.sum(np.abs(gradient) ** 2, axis=1) + 0.5 * carried)


def _waterline_density(run, phi, gradient, normal, moved):
    relative = 1j * run.omega / run.problem.gravity * phi - moved[:, 2]
    return -0.25 * run.problem.density * run.problem.gravity * np.abs(relative) ** 2


class _Surface:
    """Total first-order flow at points of the hull, or of its waterline, and of their images."""

    def __init__(self, run, flow):
        self.run, self.flow, q = run, flow, flow.points.shape[1]
        self.points, self.weights = flow.points.reshape(-1, 3), flow.weights.ravel()
        self.normals = np.repeat(run.geometry.mesh.normals[flow.panels], q, axis=0)
        self.sharp = np.isfinite(flow.edge[:, 0])
        self.mirrors = np.column_stack([run.geometry.images, np.ones(len(run.geometry.images))])
        self.nodes = run.hull[0] * self.mirrors[:, None]

    def images(self, phi, heading, motion):
        """For each mirror image: points, normals, weights, total φ and ∇φ along the panel per unit wave amplitude

        φ without the waves is interpolated between the nodes; near an edge, where powers of r^μ are to be all there
        is, with the uniform flow in which the waves meet the moving edge.
        """
        flow, q = self.flow, self.flow.points.shape[1]
        for image, mirror in enumerate(self.mirrors):
            at, normal = self.points * mirror, self.normals * mirror
            uniform = self.past_edge(flow.edge * mirror, heading, motion)
            through = image ^ flow.images, flow.nodes
            remainder = phi[through] + np.einsum("nc,nac->na", uniform, self.nodes[through])
            uniform = uniform.repeat(q, axis=0)
            wave, velocity = self.incident(at, heading)
            known = velocity - uniform
            known -= np.sum(known * normal, axis=1, keepdims=True) * normal
            value = np.einsum("nqa,na->nq", flow.shape, remainder).ravel() + wave - np.sum(uniform * at, axis=1)
            slope = np.einsum("nqia,na->nqi", flow.gradient, remainder).reshape(-1, 3) * mirror
            yield at, normal, self.weights, value, slope + known

    def past_edge(self, edge, heading, motion):
        """(n, 3) velocity of the waves relative to the edge, 0 on panels without"""
        out = np.zeros((len(edge), 3), complex)
        at = edge[self.sharp]
        out[self.sharp] = self.incident(at, heading)[1] + 1j * self.run.omega * displacement(motion, at)
        return out

    def incident(self, at, heading):
        run = self.run
        return incident_wave(at, run.headings[heading], run.omega, run.k, run.problem.depth, run.problem.gravity)


def _hull(run):
    mesh = run.geometry.mesh
    return _Surface(run, samples(mesh, sharp_sides(mesh), run.problem.depth))


def _waterline(run):
    mesh = run.geometry.mesh
    v, level = mesh.vertices, 1e-6 * mesh.draft
    wet = v[:, :, 2] > -level
    long = np.linalg.norm(np.roll(v, -1, axis=1) - v, axis=2) > 0
    sides = np.nonzero(wet & np.roll(wet, -1, axis=1) & long)
    out = _Surface(run, line_samples(mesh, sharp_sides(mesh), *sides, run.problem.depth))
    out.normals = out.normals / np.sqrt(1 - out.normals[:, 2:] ** 2)  # the wetted strip of an inclined side is wider
    return out
