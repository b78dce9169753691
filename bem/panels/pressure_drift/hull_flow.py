"""First-order flow in each wave at quadrature points of a hull and of its waterline, including mirror images.

The disturbance is interpolated between the nodes. Near an edge, where the interpolation has only powers of r^μ, the
disturbance is interpolated together with the uniform flow of the incident waves relative to the moving edge.
The velocity along the normal is the velocity of the body.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...modes import normal_velocities
from ...waves import incident_wave
from .edges import sharp_sides
from .hull_interpolation import hull_quadrature, side_quadrature


class Points:
    """Quadrature points of a hull or of its waterline, and of their images: p points, ordered image by image.

    images : signs of x and y, ±1, (i, 2); signs : sign of each symmetry class on each image, (c, i)
    members : [degrees of freedom of each class]
    points, normals, weights : m, (p, 3), unit normals, (p, 3), and m², (p,), or m along the waterline; those of the
        meshed part come first
    """

    def __init__(self, images, signs, members, points, normals, weights):
        self.copies, self.signs, self.members = len(images), signs, members
        self.mirrors = np.column_stack([images, np.ones(self.copies)])
        self.points, self.normals = self._images(points), self._images(normals)
        self.weights = np.tile(weights, self.copies)

    def _images(self, vectors):
        return (vectors * self.mirrors[:, None]).reshape(-1, 3)

    def by_class(self, vectors):
        """Part of vectors (f, p, 3) in each symmetry class, at the points of the meshed part; shape (c, f, 3q)"""
        f = len(vectors)
        seen = vectors.reshape(f, self.copies, -1, 3) * (self.mirrors / self.copies)[:, None]
        return np.einsum("ci,fipd->cfpd", self.signs, seen).reshape(len(self.signs), f, -1)

    @cached_property
    def products(self):
        """[(modes, modes)] of each symmetry class: pairs of modes whose product belongs to the class"""
        of_mode = np.empty((6, self.copies))
        for signs, members in zip(self.signs, self.members, strict=True):
            of_mode[members] = signs
        same = np.all(of_mode[:, None] * of_mode == self.signs[:, None, None], axis=-1)
        return [np.nonzero(of_class) for of_class in same]


class Surface(Points):
    """`Points` on the panels of a `bem.panels.influence.Geometry`, between whose nodes φ is interpolated"""

    def __init__(self, geometry, flow, normals):
        q = flow.points.shape[1]
        members = [[d for d in geometry.members(cls) if d < 6] for cls in geometry.classes]  # rigid motions of any body
        parts = flow.points.reshape(-1, 3), np.repeat(normals, q, axis=0), flow.weights.ravel()
        super().__init__(geometry.images, geometry.all_signs, members, *parts)
        self.flow = flow
        self.nodes = geometry.elements.nodes[: geometry.hull] * self.mirrors[:, None]
        self.sharp = np.isfinite(flow.edge[:, 0])

    def value(self, run, phi, waves, motion, headings, bent=None):
        """Potential (f, p) of f flows, and its gradient (f, p, 3) along the surface.

        phi : potential of the disturbance, (f, images, nodes); waves : amplitude of the incident wave, (f,)
        motion : motions about the origin, (f, 6); headings : rad, (f,); run : run of the frequency
        bent : function from points (…, 3) to the additional displacement of a flexible body, m, (f, …, 3), or None
        """
        f, flow, count = len(phi), self.flow, len(self.flow.weights)
        shape = f, self.copies, count
        known = self.points, self.normals
        wave, velocity = _incident(run, known[0], waves, headings)
        uniform = self._at_edge(run, waves, motion, headings, bent)
        remainder = np.empty((self.copies, count, flow.nodes.shape[1], f), complex)
        for image in range(self.copies):
            through = image ^ flow.images, flow.nodes
            far = np.einsum("fnc,nac->naf", uniform[:, image], self.nodes[through])
            remainder[image] = np.moveaxis(phi[:, *through], 0, -1) + far
        parts = remainder.view(float)  # real and imaginary parts next to each other
        q = flow.points.shape[1]
        at = np.matmul(flow.shape, parts).view(complex).reshape(-1, f).T
        slope = np.matmul(flow.gradient.reshape(count, 3 * q, -1), parts).view(complex)
        slope = np.moveaxis(slope.reshape(self.copies, count, q, 3, f), -1, 0) * self.mirrors[:, None, None]
        uniform = np.repeat(uniform.reshape(f, -1, 3), q, axis=1)
        rest = velocity - uniform
        rest -= np.sum(rest * known[1], axis=-1, keepdims=True) * known[1]
        value = at.reshape(*shape[:1], -1) + wave - np.sum(uniform * known[0], axis=-1)
        return value, slope.reshape(f, -1, 3) + rest

    def _at_edge(self, run, waves, motion, headings, bent):
        """Velocity of the incident waves relative to the edge, 0 on panels without edge, m/s; shape (f, images, n,
        3)"""
        edge = self.flow.edge[self.sharp] * self.mirrors[:, None]
        out = np.zeros((len(waves), self.copies, len(self.sharp), 3), complex)
        relative = _incident(run, edge, waves, headings)[1]
        relative += 1j * run.omega * (motion[:, None, None, :3] + np.cross(motion[:, None, None, 3:], edge))
        if bent is not None:
            relative += 1j * run.omega * bent(edge)
        out[:, :, self.sharp] = relative
        return out


@dataclass(frozen=True, eq=False)
class HullSurfaces:
    """`Points` of a hull and of its waterline, with generalised normals (p, 6) about the origin"""

    hull: Points
    waterline: Points

    @cached_property
    def hull_modes(self):
        """Generalised normals at the points of the hull; shape (p, 6)"""
        return normal_velocities(self.hull.points, self.hull.normals)

    @cached_property
    def waterline_modes(self):
        """Generalised normals at the points of the waterline; shape (l, 6)"""
        return normal_velocities(self.waterline.points, self.waterline.normals)

    @cached_property
    def weighted_modes(self):
        """Generalised normals times area on the meshed part and its images, m²; shape (6, 3q), each repeated three
        times, for the three components of velocity
        """
        part = slice(len(self.hull.weights) // self.hull.copies)
        return np.repeat((self.hull_modes[part] * self.hull.weights[part, None]).T * self.hull.copies, 3, axis=1)

    @cached_property
    def carried(self):
        """e_m n_c dS, the displacement of unit motion m times generalised normal c times area, on the meshed part and
        its images, m²; [(pairs, 3q)] for the `products` of modes of each symmetry class"""
        displacement = unit_displacements(self.hull.points).reshape(6, -1)[:, : self.weighted_modes.shape[1]]
        return [displacement[m] * self.weighted_modes[c] for m, c in self.hull.products]

    @cached_property
    def turned(self):
        """Integrals of (α_r × n)·e_v dS for unit rotation r and unit motion v, m²; shape (p, 18)"""
        turned = np.cross(np.eye(3)[:, None], self.hull.normals * self.hull.weights[:, None])
        return np.einsum("rpd,vpd->prv", turned, unit_displacements(self.hull.points)).reshape(-1, 18)

    @cached_property
    def strained(self):
        """Integrals of n_a x_b dS, x from the origin, m³; shape (p, 9)"""
        weighted = self.hull.normals * self.hull.weights[:, None]
        return np.einsum("pa,pb->pab", weighted, self.hull.points).reshape(-1, 9)


def unit_displacements(x):
    """Displacements of points (p, 3) by unit motions about the origin; shape (6, p, 3)"""
    moves = np.eye(3)[:, None] + np.zeros((3, len(x), 3))
    return np.concatenate([moves, np.cross(np.eye(3)[:, None], x)])


def hull_surfaces(geometry):
    """`HullSurfaces` of a `bem.panels.influence.Geometry`"""
    mesh = geometry.mesh
    exponents = sharp_sides(mesh)
    flow = hull_quadrature(mesh, exponents, geometry.depth)
    v, level = mesh.vertices, 1e-6 * mesh.draft
    wet = v[:, :, 2] > -level
    long = np.linalg.norm(np.roll(v, -1, axis=1) - v, axis=2) > 0
    line = side_quadrature(mesh, exponents, *np.nonzero(wet & np.roll(wet, -1, axis=1) & long), geometry.depth)
    upright = mesh.normals[line.panels]
    upright = upright / np.sqrt(1 - upright[:, 2:] ** 2)  # the wetted strip of an inclined side is wider
    return HullSurfaces(Surface(geometry, flow, mesh.normals[flow.panels]), Surface(geometry, line, upright))


@dataclass(frozen=True, eq=False)
class HullFlow:
    """First-order flow in f waves of unit amplitude, or due to f motions of unit velocity.

    omega : rad/s, (f,); motion : motions about the origin, m and rad, (f, 6); velocity : ∇φ on the hull, m/s, (f, p, 3)
    potential : φ along the waterline, m²/s, (f, l); on_hull : φ on the hull, m²/s, (f, p); hull : `Points` of the hull
    """

    omega: np.ndarray
    motion: np.ndarray
    velocity: np.ndarray
    potential: np.ndarray
    on_hull: np.ndarray
    hull: Points

    @cached_property
    def parts(self):
        """Real and imaginary part of the velocity in each symmetry class, by `Points.by_class`; shape (c, 2, f, 3q)"""
        velocity = self.hull.by_class(self.velocity)
        return np.stack([velocity.real, velocity.imag], axis=1)

    @classmethod
    def joined(cls, flows):
        """The `HullFlow` that contains several `flows`, one after another"""
        *names, _ = cls.__dataclass_fields__
        return cls(*(np.concatenate([getattr(flow, name) for flow in flows]) for name in names), flows[0].hull)


def wave_flow(run, surfaces, motions):
    """`HullFlow` in the waves of a `bem.panels.one_frequency.PanelRun`

    motions : motions about the origin, m and rad, (m, 6)"""
    return disturbed_flow(run, surfaces, motions, motions)


def disturbed_flow(run, surfaces, motions, own, bent=None):
    """`HullFlow` in waves, as `wave_flow`, on the hull of one of several bodies

    motions : motions of all bodies, (m, 6N); own : motions of the body itself, (m, 6); bent : as in `Surface.value`
    """
    phi = [_on_images(run, run.disturbance(j, motion)) for j, motion in enumerate(motions)]
    return _flow(run, surfaces, np.array(phi), np.ones(len(phi)), own, run.headings, bent)


def radiated_flow(run, surfaces, body=0, moves=True):
    """`HullFlow` of the six motions of unit velocity, from a `PanelRun` that has solved all motions

    body : index of the moving body among several; moves : whether the surfaces belong to the moving body
    """
    phi, first = np.zeros((6, len(run.geometry.images), run.geometry.hull), complex), 6 * body
    for cls, (moving, _) in run.columns.items():
        signs = run.geometry.signs(cls)
        for i, mode in enumerate(moving):
            if first <= mode < first + 6:
                phi[mode - first] = np.multiply.outer(signs, run.potentials[cls][i])
    motions = np.eye(6) / (-1j * run.omega) * moves
    return _flow(run, surfaces, phi, np.zeros(6), motions, np.zeros(6))


def _flow(run, surfaces, phi, waves, motions, headings, bent=None):
    hull = surfaces.hull
    on_hull, gradient = hull.value(run, phi, waves, motions, headings, bent)
    gradient += (-1j * run.omega * motions @ surfaces.hull_modes.T)[..., None] * hull.normals
    if bent is not None:
        speed = -1j * run.omega * np.sum(bent(hull.points) * hull.normals, axis=-1)
        gradient += speed[..., None] * hull.normals
    potential = surfaces.waterline.value(run, phi, waves, motions, headings, bent)[0]
    return HullFlow(np.full(len(phi), run.omega), np.asarray(motions, complex), gradient, potential, on_hull, hull)


def _incident(run, at, waves, headings):
    """φ_I (f, …) and its gradient (f, …, 3) at points (…, 3)"""
    problem = run.problem
    if not np.any(waves):
        return np.zeros((len(waves), *at.shape[:-1]), complex), np.zeros((len(waves), *at.shape), complex)
    parts = [incident_wave(at, beta, run.omega, run.k, problem.depth, problem.gravity) for beta in headings]
    return tuple(np.array([a * part[i] for a, part in zip(waves, parts, strict=True)]) for i in range(2))


def _on_images(run, parts):
    """Potential φ without the incident waves on each image, from its symmetry classes; shape (images, nodes)"""
    return sum(np.multiply.outer(run.geometry.signs(cls), phi) for cls, (phi, _) in parts.items())
