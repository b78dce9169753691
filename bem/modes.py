"""Modes of motion: their normal velocities, parity under reflection, and change of reference point.

With several bodies the rigid modes are six per body, one body after another; mode d is motion d mod 6 of body d div 6.
Shapes of flexible bodies (`Mode`) come after the rigid modes of all bodies.
"""

from typing import NamedTuple

import numpy as np

from . import DOFS

# sign of a mode's potential under x → −x and under y → −y, about the origin
MIRRORED = 1e-4  # largest asymmetry over the largest displacement of a shape from a file that counts as symmetric
PARITY = ((-1, 1), (1, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


class Body(NamedTuple):
    """One of several bodies.

    name : name of the body, which precedes the names of its motions; rotation_center : rotation centre, m, (3,)
    heading : angle about z of the axes for motions, forces and moments of the body, rad
    fixed : True for a body that scatters waves and does not move; place : origin of the body's coordinates, m, (2,)
    """

    name: str
    rotation_center: tuple = (0.0, 0.0, 0.0)
    heading: float = 0.0
    fixed: bool = False
    place: tuple = (0.0, 0.0)

    @property
    def axes(self):
        """Matrix whose columns are the axes of the body in coordinates of the scene; shape (3, 3)"""
        return turned(self.heading)[:3, :3].T

    @property
    def own_center(self):
        """Rotation centre of the body in coordinates of the body, m; shape (3,)"""
        return self.axes.T @ (np.asarray(self.rotation_center, float) - (*self.place, 0.0))

    def in_scene(self, point):
        """Points in coordinates of the scene, m, from points (…, 3) in coordinates of the body; shape (…, 3)"""
        return np.asarray(point, float) @ self.axes.T + (*self.place, 0.0)


class Mode(NamedTuple):
    """A mode shape of one or several bodies in addition to their six rigid motions.

    name : name of the shape, without the name of the body; turns : whether its amplitude is in rad; body : index of
        the body
    shape : object with displacement((…, 3) m) → (…, 3); points and displacement are in coordinates of the body
    place, heading : origin of the body's coordinates, m, (2,), and angle of its axes, rad
    on : indices of all bodies that a shape moves, `body` first; such a shape is in coordinates of the scene. Empty
        for one body
    """

    name: str
    turns: bool = False
    shape: object = None
    body: int = 0
    place: tuple = (0.0, 0.0)
    heading: float = 0.0
    on: tuple = ()

    @property
    def moves(self):
        """Indices of the bodies that move in the shape"""
        return self.on or (self.body,)

    def in_body(self, body, points):
        """Displacement, per m or rad of amplitude, at points (…, 3), m; shape (…, 3). Points and displacement are in
        coordinates of the `Body`, or of the single body (None)"""
        if not self.on:
            return self.shape.displacement(points)
        return self.shape.displacement(body.in_scene(points)) @ body.axes

    def displacement(self, points):
        """Displacement, per m or rad of amplitude, at points (…, 3), m, in coordinates of the scene; shape (…, 3)"""
        if not (self.heading or any(self.place)):
            return self.shape.displacement(points)
        own = turned(self.heading)[:3, :3]
        return self.shape.displacement((np.asarray(points, float) - (*self.place, 0.0)) @ own.T) @ own

    def parity(self, points):
        """Signs of the shape under x → −x and under y → −y, 0 for no symmetry; shape (2,)

        points : points of the body, m, (n, 3)"""
        here = self.displacement(points)
        out = []
        for mirror in ((-1, 1, 1), (1, -1, 1)):
            there = self.displacement(points * mirror) * mirror
            gaps = [np.abs(there - sign * here).max() for sign in (1, -1)]
            sign = (1, -1)[int(np.argmin(gaps))]
            out.append(sign if min(gaps) <= MIRRORED * np.abs(here).max() else 0)
        return tuple(out)


def words_of(bodies, modes=()):
    """Names of the motions in results: "surge", or "barge surge" with several bodies, by body and motion"""
    before = [f"{body.name} " for body in bodies if not body.fixed] or [""]
    rigid = [name + dof.lower() for name in before for dof in DOFS]
    return (*rigid, *(_of_body(bodies, mode, " ").replace("_", " ") for mode in modes))


def names_of(bodies, modes=()):
    """Names of the modes of several bodies, as in Capytaine; an empty list gives the names for one body"""
    rigid = [f"{body.name}__{dof}" for body in bodies for dof in DOFS] or DOFS
    return (*rigid, *(_of_body(bodies, mode, "__") for mode in modes))


def _of_body(bodies, mode, between):
    return f"{bodies[mode.body].name}{between}{mode.name}" if bodies and not mode.on else mode.name


def moving(bodies, modes=()):
    """Indices of the modes of all bodies that are not fixed"""
    rigid = 6 * max(1, len(bodies))
    own = [d for d in range(rigid) if not (bodies and bodies[d // 6].fixed)]
    return own + list(range(rigid, rigid + len(modes)))


def turning(bodies, modes=()):
    """Whether each mode is a rotation; shape (n,)"""
    return np.array([False, False, False, True, True, True] * max(1, len(bodies)) + [mode.turns for mode in modes])


def transform_of(bodies, rotation_center, modes=()):
    """Matrix from generalized normals about the origin to generalized normals about `rotation_center`; shape (n, n).
    For several bodies it is about the rotation centre of each body"""
    rigid = axes_of(bodies) if bodies else reference_change(rotation_center)
    out = np.eye(len(rigid) + len(modes))
    out[: len(rigid), : len(rigid)] = rigid
    return out


def axes_of(bodies):
    """Matrix from generalized normals about the origin to generalized normals about the rotation centre of each body,
    along the axes of the body; shape (6N, 6N)"""
    out = np.zeros((6 * len(bodies), 6 * len(bodies)))
    for i, body in enumerate(bodies):
        own = slice(6 * i, 6 * i + 6)
        out[own, own] = turned(body.heading) @ reference_change(body.rotation_center)
    return out


def turned(heading):
    """Matrix from generalized normals to generalized normals in axes turned by `heading`, rad, about z; shape (6, 6)"""
    c, s = np.cos(heading), np.sin(heading)
    return np.kron(np.eye(2), [[c, s, 0], [-s, c, 0], [0, 0, 1]])


def modes_of(bodies, body_of_point, points, normals, modes=()):
    """Normal velocities of all modes, rotations about the origin; shape (n, 6N + m). A body moves only its own points

    body_of_point : index of the body of each point, (n,); modes : m `Mode`s
    """
    each = normal_velocities(points, normals)
    out = [each * (body_of_point == i)[:, None] for i in range(bodies)]
    for mode in modes:
        own, velocity = np.isin(body_of_point, mode.moves), np.zeros((len(points), 1))
        velocity[own, 0] = np.einsum("na,na->n", mode.displacement(points[own]), normals[own])
        out.append(velocity)
    return np.concatenate(out, axis=1)


def normal_velocities(centroids, normals):
    """Normal velocity of unit surge … yaw about the origin; shape (n, 6): n and r × n"""
    return np.concatenate([normals, np.cross(centroids, normals)], axis=1)


def displacing(mesh, modes=()):
    """Whether each mode of a hull, a `meshing.panels.PanelMesh`, displaces water; shape (6,)

    Yaw of a round buoy moves no water, apart from the corners of its polygon, nor does heave of a pile on the bed.
    Relative errors of such modes have no meaning.
    A rotation counts if the mean square of its normal velocity is at least two per cent of the mean square of its arms.
    Velocity and arms are about the vertical axis through the middle of the hull's surface, so the place of the mesh
    does not matter.
    The result for N bodies has shape (6N,), followed by True for each of `modes`.
    """
    if modes:
        return np.append(displacing(mesh), [True] * len(modes))
    if mesh.body is not None:
        return np.concatenate([displacing(mesh.of_body(i)) for i in range(mesh.bodies)])
    whole = mesh.whole()
    weights, centroids = whole.areas, whole.centroids
    middle = np.append(weights @ centroids[:, :2] / weights.sum(), 0.0)
    velocities, (x, y, z) = normal_velocities(centroids - middle, whole.normals), (centroids - middle).T
    arms = np.stack([np.ones(len(x))] * 3 + [y * y + z * z, z * z + x * x, x * x + y * y], axis=1)
    return (weights @ velocities**2) / (weights @ arms) > np.array([1e-6] * 3 + [0.02] * 3)


def reference_change(center):
    """Matrix T (6, 6): generalized normal about `center` = T · generalized normal about the origin."""
    x, y, z = center
    T = np.eye(6)
    T[3:, :3] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    return T


def class_of(dof, symmetry):
    """Symmetry class (sign in x, sign in y) of the mode with index `dof`."""
    x, y = PARITY[dof % 6]
    return (x if "x" in symmetry else 1, y if "y" in symmetry else 1)


def with_net_flux(added_mass, flux, area):
    """`added_mass` in which entries between modes with a net flux are infinite

    flux : net flux of each mode, m², (6,); a flux below the rounding error of `area` m² counts as zero"""
    product = np.outer(flux, flux)
    significant = np.abs(product) > 1e-9 * area * area
    return np.where(significant, np.copysign(np.inf, product), added_mass)
