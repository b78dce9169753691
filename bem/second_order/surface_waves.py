"""First-order waves on the free surface around a hull: from panels inside a circle, as sums over angular orders
outside."""

from typing import NamedTuple

import numpy as np

from ..waves import incident_wave, wavenumber
from .surface_far import both_signs, hankel_orders, orders_sent, reach_of_local, rings_about, sent_orders
from .surface_near import SurfaceInfluence, circle_about, strips_about


class Field(NamedTuple):
    """Potential, (…, p), and its two derivatives along the surface, (2, …, p)"""

    value: np.ndarray
    slope: np.ndarray

    def __getitem__(self, which):
        return Field(self.value[which], self.slope[:, which])

    def second(self, kind):
        """The field in the form of a second factor in products of a `kinds.Kind`"""
        return Field(kind.second(self.value), kind.second(self.slope))

    def __add__(self, other):
        return Field(self.value + other.value, self.slope + other.slope)


class Wave(NamedTuple):
    """One wave far from the body.

    omega : rad/s; k : rad/m; direction : rad; amplitude : amplitude of the incident potential, m²/s
    sent : coefficients of the outgoing waves H_m(kr) e^{imθ}, (2M + 1,); local : coefficients of e^{imθ} on rings,
        (w, r, n)
    """

    omega: float
    k: float
    direction: float
    incident: complex
    sent: np.ndarray
    local: np.ndarray

    @property
    def most(self):
        return len(self.sent) // 2

    def incident_orders(self, most):
        """Coefficients of J_m(kr) e^{imθ}; shape (2 most + 1,)"""
        m = np.arange(-most, most + 1)
        return self.incident * 1j ** (m % 4) * np.exp(-1j * m * self.direction)


class SurfaceWaves:
    """First-order waves of one problem on the free surface, collected frequency by frequency.

    prepared : `PreparedPanelProblem`; surfaces : `hull_flow.HullSurfaces`; omega : frequencies, rising, rad/s, (n,)
    of_force : frequencies of the force, rising, above 0, rad/s, (d,); kind : `kinds.Kind`
    raises : ValueError for a waterline that `surface_near` does not support
    """

    def __init__(self, prepared, surfaces, omega, of_force, kind):
        problem, self.kind = prepared.problem, kind
        self.problem, self.geometry = problem, prepared.geometry.without_lid
        g = self.geometry
        self.circle, self.line = circle_about(g.mesh), surfaces.waterline
        longest, shortest = (
            float(wavenumber(w, problem.depth, problem.gravity))
            for w in (min(of_force[0], omega[0]), max(of_force[-1], omega[-1]))
        )
        self.strips = strips_about(g.mesh, surfaces.waterline.flow, self.circle, shortest)
        most = orders_sent(shortest * self.circle.radius)
        self.rings = rings_about(self.circle, problem.depth, [longest, shortest], most, kind)
        inside = np.concatenate([s.points.reshape(-1, 2) for s in self.strips])
        beside = np.concatenate([s.points[:, :, 1:].reshape(-1, 2) for s in self.strips])
        self.inside, self.beside = len(inside), len(beside)
        self.weights = np.tile(np.concatenate([s.weights.ravel() for s in self.strips]), g.copies)
        self.images = np.array(g.images)
        self._around, self._of_image, at_rings = self._quadrant()
        at = np.concatenate([beside, at_rings])
        self.influence = SurfaceInfluence(g, np.column_stack([at, np.zeros(len(at))]))
        self.points = (self.images[:, None] * inside).reshape(-1, 2)
        self.waves, self.near = [], []

    def _quadrant(self):
        """Directions of rings as images of those in the meshed part; points of these, ring by ring"""
        theta, radii = self.rings.directions, self.rings.radii.ravel()
        ray = np.stack([np.cos(theta), np.sin(theta)], axis=1)
        fits = [np.all(np.where(self.images.min(axis=0) < 0, ray * image, 1.0) > 0, axis=1) for image in self.images]
        image = np.argmax(fits, axis=0)
        own = np.flatnonzero(image == 0)
        mirrored = ray * self.images[image]
        place = np.argmin(np.abs(mirrored[:, None] - ray[own]).sum(axis=2), axis=1)
        points = self.rings.centre + radii[:, None, None] * ray[own]
        return place, image, points.reshape(-1, 2)

    def add(self, run, flow, motions):
        """Add the waves of a `PanelRun` with their `HullFlow`; motions : (m, 6) about the origin"""
        flows = [run.disturbance(j, motion) for j, motion in enumerate(motions)]
        flows = {cls: tuple(np.array([f[cls][i] for f in flows]) for i in range(2)) for cls in run.geometry.classes}
        flows = {cls: both for cls, both in flows.items() if np.any(both[0]) or np.any(both[1])}
        k, b = run.k, run.headings
        on_line = flow.potential - np.array([phi for phi, _ in self._incident(run, self.line.points)])
        near, sent = self._of(run, flows, on_line)
        known = self._incident(run, np.column_stack([self.points, np.zeros(len(self.points))]))
        wave = Field(np.array([p for p, _ in known]), np.moveaxis(np.array([v[:, :2] for _, v in known]), -1, 0))
        self.near.append((wave + near, wave))
        start = -1j * self.problem.gravity / run.omega
        phase = np.exp(1j * k * (np.cos(b) * self.circle.centre[0] + np.sin(b) * self.circle.centre[1]))
        self.waves += [
            Wave(run.omega, k, beta, start * p, start * c, local)
            for beta, p, c, local in zip(b, phase, *sent, strict=True)
        ]

    def _incident(self, run, at):
        problem = self.problem
        return [incident_wave(at, beta, run.omega, run.k, problem.depth, problem.gravity) for beta in run.headings]

    def joined(self):
        """The total field, and the field of the incident waves: two `Field`s (f, p) of all waves near the body"""
        parts = zip(*self.near, strict=True)
        return [
            Field(np.concatenate([f.value for f in part]), np.concatenate([f.slope for f in part], axis=1))
            for part in parts
        ]

    def radiated(self, run, flow):
        """`Field` (6, p) near the body and [`Wave`] of the six motions of unit velocity; flow : `HullFlow` of these
        motions"""
        flows = {}
        for cls, (moving, _) in run.columns.items():
            phi = np.zeros((6, run.geometry.hull), complex)
            phi[moving] = run.potentials[cls][: len(moving)]
            V = np.zeros((6, run.geometry.hull))
            V[moving] = run.prepared.modes[:, moving].T
            flows[cls] = phi, V
        near, (c, local) = self._of(run, flows, flow.potential)
        start = -1j * self.problem.gravity / run.omega
        return near, [Wave(run.omega, run.k, 0.0, 0.0, start * c[i], local[i]) for i in range(6)]

    def _of(self, run, flows, on_line):
        """`Field` (c, p) near the body of flows, their sent orders and their local parts on rings (c, w, r, n)

        on_line : (c, l) potential along the waterline
        """
        rings, k, count = self.rings, run.k, len(on_line)
        reach = rings.within(reach_of_local(self.circle, self.problem.depth, k, self.kind))
        per_interval = (len(self.influence.points) - self.beside) // (len(rings.edges) - 1)
        beside = np.zeros((count, len(self.images), self.beside), complex)
        around = np.zeros((count, reach, rings.radii.shape[1], rings.count), complex)
        for cls, found in self.influence.values(run, flows, self.beside + reach * per_interval).items():
            signs = self.geometry.signs(cls)
            beside += signs[:, None] * found[:, None, : self.beside]
            own = found[:, self.beside :].reshape(count, reach, rings.radii.shape[1], -1)
            around += own[..., self._around] * signs[self._of_image]
        most = orders_sent(k * self.circle.radius)
        m = np.arange(-most, most + 1)
        c = sent_orders(run, flows, most, self.circle.centre) * 1j ** (m % 4)
        z = k * rings.radii[:reach]
        H = both_signs(hankel_orders(1, most, z)[:-1] * np.exp(1j * z))
        local = rings.transform(around)
        local[..., m] += 1j * self.problem.gravity / run.omega * np.einsum("cm,mwr->cwrm", c, H)
        return self._near(on_line.reshape(count, len(self.images), -1), beside), (c, local)

    def _near(self, on_line, beside):
        """`Field` (c, p) from values along the waterline and beside it, (c, images, …)"""
        values, slopes, first = [], [], 0
        for strips in self.strips:
            after = first + strips.weights[..., 1:].size
            value = strips.values(on_line, beside[..., first:after])
            slope = strips.gradient(value) * self.images[:, None, None, None]
            values.append(value.reshape(*beside.shape[:2], -1))
            slopes.append(slope.reshape(*beside.shape[:2], -1, 2))
            first = after
        value, slope = np.concatenate(values, axis=2), np.moveaxis(np.concatenate(slopes, axis=2), -1, 0)
        return Field(value.reshape(len(beside), -1), slope.reshape(2, len(beside), -1))
