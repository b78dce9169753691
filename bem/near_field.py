"""Mean drift from the pressure on the hull: an independent check of the far-field result.

    F = −½ρg ∮ ζ_r² n dl + ½ρ ∬ |∇φ|² n dS + ρ ∬ (X·∇φ_t) n dS + α × (M Ẍ_G),    mean over a period

(Pinkster 1980), n out of the body, ζ_r the wave elevation relative to the hull, X the displacement of a point of it,
α the rotations.  Moments are taken about the centre of gravity.  At sharp edges |∇φ|² is singular: the
sum converges slower than the far field.
"""

from __future__ import annotations

import numpy as np

from .elements import gradients, line_points
from .waves import incident_wave


def near_field_drift(run, moving):
    """(m, 3) as `bem.drift.mean_drift`, about the rotation centre, from the potentials of a solved frequency.

    run : the quantities of one frequency (`bem.panel_run.PanelRun`) of a mesh with four nodes a panel
    moving : freely floating instead of fixed
    """
    setup = run.setup
    center = np.asarray(setup.rotation_center, float)
    arm, inertia = _about_gravity(setup.inertia_matrix, center) if moving else (center, None)
    hull, line = _Hull(run), _Waterline(run)
    force = np.zeros((len(run.headings), 3))
    for j in range(len(run.headings)):
        motion = run.rao[j] if moving else np.zeros(6, complex)
        alpha = motion[3:]
        X = motion[:3] + np.cross(alpha, arm - center)
        parts = run.disturbance(j, moving)
        total = np.zeros(6)
        for sample, density in (hull, _hull_density), (line, _waterline_density):
            for x, n, weight, phi, gradient in sample.images(parts, j):
                load = density(run, phi, gradient, X + np.cross(alpha, x - arm)) * weight
                total += np.concatenate([load @ n, load @ np.cross(x - arm, n)])
        if moving:
            momentum = inertia @ np.concatenate([X, alpha]) * -(run.omega**2)
            total[:3] += 0.5 * np.cross(alpha.conj(), momentum[:3]).real
            total[3:] += 0.5 * np.cross(alpha.conj(), momentum[3:]).real
        total[3:] += np.cross(arm - center, total[:3])
        force[j] = total[[0, 1, 5]]
    return force


def _hull_density(run, phi, gradient, displacement):
    carried = np.sum(displacement.conj() * (-1j * run.omega) * gradient, axis=1).real
    return run.setup.density * (0.25 * np.sum(np.abs(gradient) ** 2, axis=1) + 0.5 * carried)


def _waterline_density(run, phi, gradient, displacement):
    relative = 1j * run.omega / run.setup.gravity * phi - displacement[:, 2]
    return -0.25 * run.setup.density * run.setup.gravity * np.abs(relative) ** 2


def _about_gravity(M, center):
    """Centre of gravity and the 6 × 6 inertia about it, from the inertia M about `center`."""
    mass = M[0, 0]
    a, b, c = offset = np.array([M[1, 5], M[2, 3], M[0, 4]]) / mass
    S = np.array([[0, -c, b], [c, 0, -a], [-b, a, 0]])
    out = np.zeros((6, 6))
    out[:3, :3] = mass * np.eye(3)
    out[3:, 3:] = M[3:, 3:] + mass * S @ S
    return center + offset, out


class _Hull:
    """Total first-order flow at the nodes of the hull and of its images."""

    def __init__(self, run):
        self.run = run
        self.points, self.weights, self.normals = run.hull
        panels = run.geometry.hull // run.geometry.elements.inverse.shape[-1]
        self.gradients = gradients(run.geometry.elements)[:panels]

    def disturbance(self, phi, velocity):
        """φ and ∇φ at the points from node values of φ and ∂φ/∂n"""
        n, p = self.gradients.shape[:2]
        along = np.einsum("nqib,nb->nqi", self.gradients, phi.reshape(n, p)).reshape(-1, 3)
        return phi, along + velocity[:, None] * self.normals

    def images(self, parts, heading):
        """For each mirror image: points, normals, weights, total φ and ∇φ per unit wave amplitude"""
        run = self.run
        flow = {cls: self.disturbance(*values) for cls, values in parts.items()}
        for i, (x, y) in enumerate(run.geometry.images):
            mirror = np.array([x, y, 1.0])
            at = self.points * mirror
            phi, gradient = incident_wave(
                at, run.headings[heading], run.omega, run.k, run.setup.depth, run.setup.gravity
            )
            for cls, (p, g) in flow.items():
                sign = run.geometry.signs(cls)[i]
                phi, gradient = phi + sign * p, gradient + sign * g * mirror
            yield at, self.normals * mirror, self.weights, phi, gradient


class _Waterline(_Hull):
    """The same on the edges in the water surface; the gradient is not needed there."""

    def __init__(self, run):
        self.run = run
        mesh = run.geometry.mesh
        v, level = mesh.vertices, 1e-6 * mesh.draft
        wet = v[:, :, 2] > -level
        panel, first = np.nonzero(wet & np.roll(wet, -1, axis=1))
        a, b = v[panel, first], v[panel, (first + 1) % 4]
        long = np.linalg.norm(b - a, axis=1) > 0
        self.panel, self.points, self.weights, self.shape = line_points(
            run.geometry.elements, panel[long], a[long], b[long]
        )
        n = mesh.normals[self.panel]
        self.normals = n / np.sqrt(1 - n[:, 2:] ** 2)  # the wetted strip of an inclined side is wider

    def disturbance(self, phi, velocity):
        node = phi.reshape(-1, self.shape.shape[1])[self.panel]
        return np.sum(self.shape * node, axis=1), np.zeros((len(self.panel), 3))
