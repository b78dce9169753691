"""First-order flow on a vertical-sided body, at integration points on the side, and on the bottom of a cylinder.

Points on the side are the distances of `bem.contour.side_flow` at every node of the contour; points on the bottom are
those of `under_keel`. All points are graded towards the keel's edge, around which the water flows.
All frequencies of a body share these points, and use the contour and the functions of the shortest waves.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...modes import class_of, normal_velocities
from ...panels.pressure_drift.hull_flow import HullFlow, HullSurfaces, Points
from ..one_frequency import ContourFrequency, degrees
from ..plan.circle import Circle
from ..plan.maps import CLASSES
from ..plan.potentials import plan_values
from ..side_flow import depth_flow
from .under_keel import UnderKeel

IMAGES = np.array(CLASSES, float)
SIGNS = np.array([[(x if a < 0 else 1) * (y if b < 0 else 1) for a, b in CLASSES] for x, y in CLASSES], float)


class SharedFrequency(ContourFrequency):
    """A `ContourFrequency` with the functions, tables and contour of the shortest waves"""

    def __init__(self, shared, omega, headings, density, gravity):
        self.shared = shared
        super().__init__(shared.body, omega, headings, (), range(6), density, gravity)
        self.result()

    def resolution(self):
        return self.shared.degree, self.shared.top, self.shared.contour

    @property
    def classes(self):
        return CLASSES


@dataclass(frozen=True, eq=False)
class HullPoints:
    """Points on the hull of a `bem.contour.body.ContourBody` for waves up to k rad/m"""

    body: object
    k: float

    @cached_property
    def degree(self):
        return degrees(self.body, self.k)[0]

    @cached_property
    def top(self):
        return degrees(self.body, self.k)[1]

    @cached_property
    def contour(self):
        return self.body.plan.contour(self.k, self.degree, self.body.tolerance)

    @cached_property
    def under(self):
        """`UnderKeel` of a cylinder; None for a box"""
        return UnderKeel(self.body, self.degree, self.contour) if isinstance(self.body.plan, Circle) else None

    @property
    def whole(self):
        """Whether the points include the bottom"""
        return self.under is not None

    def surfaces(self, freq):
        """`HullSurfaces` of a `SharedFrequency`; they are equal for all frequencies"""
        c, draft = self.contour, self.body.draft
        depth = depth_flow(freq, 1 / self.k)
        flat = np.stack([c.x, c.y, 0 * c.x], axis=1)
        normal = np.stack([c.nx, c.ny, 0 * c.nx], axis=1)
        down = np.multiply.outer(depth.r - draft, [0.0, 0.0, 1.0])
        points = (flat + down[:, None]).reshape(-1, 3)
        normals = np.tile(normal, (len(depth.r), 1))
        weights = np.multiply.outer(depth.weights, c.weights).ravel()
        if self.whole:
            below = self.under.points, self.under.normals, self.under.weights
            points, normals, weights = (
                np.concatenate(both) for both in zip((points, normals, weights), below, strict=True)
            )
        return HullSurfaces(*(_imaged(*part) for part in ((points, normals, weights), (flat, normal, c.weights))))

    def flows(self, freq):
        """{class: φ, (columns, p), ∇φ along the surface, (columns, p, 3), and φ at z = 0, (columns, m)} on the meshed
        part

        Columns are those of `freq.flows`: motions of unit velocity, then headings; freq : `SharedFrequency`
        """
        depth, values = depth_flow(freq, 1 / self.k), plan_values(freq)
        c, out = self.contour, {}
        along = np.stack([-c.ny, c.nx, 0 * c.nx], axis=1)
        for cls in CLASSES:
            g, slope = amplitudes(freq, values[cls], cls)
            value, turned = (np.moveaxis(np.tensordot(depth.value, part, 1), -1, 0) for part in (g, slope))
            gradient = turned[..., None] * along
            gradient[..., 2] += np.moveaxis(np.tensordot(depth.slope, g, 1), -1, 0)
            shape = value.shape[0], -1
            value, gradient = value.reshape(shape), gradient.reshape(*shape, 3)
            if self.whole:
                below = self.under.flow(freq, cls)
                value, gradient = (np.concatenate(both, axis=1) for both in zip((value, gradient), below, strict=True))
            out[cls] = value, gradient, np.tensordot(depth.top, g, 1).T
        return out


def amplitudes(freq, values, cls):
    """Amplitudes of `DepthSums` at the m nodes, and their slopes; shape (a, m, columns); amplitudes:
    wave, table and rows, speed of the edge, turning rate of the edge

    values : `plan_values` of the class; columns : as in `freq.flows`
    """
    dofs, wave, sides, flow = freq.flows[cls]
    moving, c = len(dofs), freq.contour
    velocity = np.concatenate([flow.velocity, np.zeros((2, *flow.velocity.shape[1:]))])
    velocity[-2:, :, :moving] = np.moveaxis(sides, 0, -1)
    far = wave.potential @ np.tensordot(freq.wave_rows, velocity, 1) / freq.modes.wave_norm
    far[:, moving:] += freq.amplitude * wave.wall
    near = np.tensordot(values.maps, velocity, (2, 1)).swapaxes(1, 2)  # (k, r, m, c)
    g = np.concatenate([far[None], near.reshape(-1, *far.shape), np.zeros((2, *far.shape))])
    slope = np.matmul(values.slope, g)
    modes = normal_velocities(np.stack([c.x, c.y, 0 * c.x], axis=1), np.tile([0.0, 0.0, 1.0], (len(c.x), 1)))
    g[-2, :, :moving] = modes[:, dofs]  # upwards
    g[-1, :, :moving] = np.stack([0 * c.nx] * 3 + [-c.ny, c.nx, 0 * c.nx], axis=1)[:, dofs]
    return g, slope


def wave_flow(freq, points, surfaces, motions):
    """`HullFlow` in the waves of a `SharedFrequency`; motions : motions about the origin, m and rad, (m, 6)"""
    return _flow(freq, points, surfaces, in_waves(freq, motions), motions)


def radiated_flow(freq, points, surfaces):
    """`HullFlow` of the six motions of unit velocity of a `SharedFrequency`"""
    return _flow(freq, points, surfaces, of_motions(freq), np.eye(6) / (-1j * freq.omega))


def in_waves(freq, motions):
    """Factors of `freq.flows` for the flow in waves of a body with the motions (m, 6); {class: (m, columns)}"""
    speed, waves = -1j * freq.omega * motions, np.eye(len(motions))
    return {cls: np.concatenate([speed[:, dofs], waves], axis=1) for cls, (dofs, *_) in freq.flows.items()}


def of_motions(freq):
    """Factors of `freq.flows` for the six motions of unit velocity; {class: (6, columns)}"""
    waves = np.zeros((6, len(freq.headings)))
    return {cls: np.concatenate([np.eye(6)[:, dofs], waves], axis=1) for cls, (dofs, *_) in freq.flows.items()}


def _flow(freq, points, surfaces, columns, motions):
    """Sum of the flows of a class by `columns` {class: (f, columns)}"""
    hull, found = surfaces.hull, points.flows(freq)
    f, m = len(motions), len(freq.contour.x)
    on_hull, potential = np.zeros((f, 4, len(hull.weights) // 4), complex), np.zeros((f, 4, m), complex)
    gradient = np.zeros((f, 4, len(hull.weights) // 4, 3), complex)
    for cls, signs in zip(CLASSES, SIGNS, strict=True):
        value, slope, top = (np.tensordot(columns[cls], part, 1) for part in found[cls])
        on_hull += signs[:, None] * value[:, None]
        potential += signs[:, None] * top[:, None]
        gradient += (signs[:, None] * hull.mirrors)[:, None] * slope[:, None]
    gradient = gradient.reshape(f, -1, 3)
    gradient += (-1j * freq.omega * motions @ surfaces.hull_modes.T)[..., None] * hull.normals
    omega = np.full(f, freq.omega)
    return HullFlow(
        omega, np.asarray(motions, complex), gradient, potential.reshape(f, -1), on_hull.reshape(f, -1), hull
    )


def _imaged(points, normals, weights):
    members = [[d for d in range(6) if class_of(d, "xy") == cls] for cls in CLASSES]
    return Points(IMAGES, SIGNS, members, points, normals, weights)
