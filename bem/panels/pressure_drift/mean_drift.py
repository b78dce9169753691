"""Mean drift from the pressure on the panels of a hull, by the formula of `bem.methods.near_field`.

The singularity at edges is integrated by `hull_interpolation`; what remains is the discretisation error of the
potentials, mainly of the motions.
"""

from __future__ import annotations

import warnings

import numpy as np

from ...drift import about
from ...waves import incident_wave
from .edges import coarsest_at_gap, sharp_sides
from .hull_interpolation import hull_quadrature, side_quadrature

# largest length of panels next to the keel over the gap: box, gap 2 m, resonant roll, near and far field differ by 4 %
# of the largest force on the fixed body with panels of 1.2 m, 9 % with 2.5 m, all of it with 7.3 m
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
        for surface, density in parts:
            for x, n, weight, value, gradient in surface.images(phi, j, motion):
                load = density(run, value, gradient, n, displacement(motion, x)) * weight
                loads[j] += np.concatenate([load @ n, load @ np.cross(x, n)])
    return about(loads[:, [0, 1, 5]], run.problem.rotation_center)


def pressure_error(run):
    """Relative error of the pressures, a number, estimated as that of coefficients and forces

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
    """Total first-order flow at quadrature points of the hull, or of its waterline, and of their images."""

    def __init__(self, run, flow):
        self.run, self.flow, q = run, flow, flow.points.shape[1]
        self.points, self.weights = flow.points.reshape(-1, 3), flow.weights.ravel()
        self.normals = np.repeat(run.geometry.mesh.normals[flow.panels], q, axis=0)
        self.sharp = np.isfinite(flow.edge[:, 0])
        self.mirrors = np.column_stack([run.geometry.images, np.ones(len(run.geometry.images))])
        self.nodes = run.hull[0] * self.mirrors[:, None]

    def images(self, phi, heading, motion):
        """For each mirror image: points, normals, weights, total φ and tangential ∇φ per unit wave amplitude

        The disturbance is interpolated between the nodes; near an edge, where the interpolation has only powers of r^μ,
        together with the uniform flow of the incident waves relative to the moving edge.
        """
        flow, q = self.flow, self.flow.points.shape[1]
        for image, mirror in enumerate(self.mirrors):
            at, normal = self.points * mirror, self.normals * mirror
            uniform = self.velocity_at_edge(flow.edge * mirror, heading, motion)
            through = image ^ flow.images, flow.nodes
            remainder = phi[through] + np.einsum("nc,nac->na", uniform, self.nodes[through])
            uniform = uniform.repeat(q, axis=0)
            wave, velocity = self.incident(at, heading)
            known = velocity - uniform
            known -= np.sum(known * normal, axis=1, keepdims=True) * normal
            value = np.einsum("nqa,na->nq", flow.shape, remainder).ravel() + wave - np.sum(uniform * at, axis=1)
            slope = np.einsum("nqia,na->nqi", flow.gradient, remainder).reshape(-1, 3) * mirror
            yield at, normal, self.weights, value, slope + known

    def velocity_at_edge(self, edge, heading, motion):
        """(n, 3) m/s, velocity of the incident waves relative to the edge, 0 on panels without edge"""
        out = np.zeros((len(edge), 3), complex)
        at = edge[self.sharp]
        out[self.sharp] = self.incident(at, heading)[1] + 1j * self.run.omega * displacement(motion, at)
        return out

    def incident(self, at, heading):
        run = self.run
        return incident_wave(at, run.headings[heading], run.omega, run.k, run.problem.depth, run.problem.gravity)


def _hull(run):
    mesh = run.geometry.mesh
    return _Surface(run, hull_quadrature(mesh, sharp_sides(mesh), run.problem.depth))


def _waterline(run):
    mesh = run.geometry.mesh
    v, level = mesh.vertices, 1e-6 * mesh.draft
    wet = v[:, :, 2] > -level
    long = np.linalg.norm(np.roll(v, -1, axis=1) - v, axis=2) > 0
    sides = np.nonzero(wet & np.roll(wet, -1, axis=1) & long)
    out = _Surface(run, side_quadrature(mesh, sharp_sides(mesh), *sides, run.problem.depth))
    out.normals = out.normals / np.sqrt(1 - out.normals[:, 2:] ** 2)  # the wetted strip of an inclined side is wider
    return out
