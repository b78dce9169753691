"""Hinges, balls, sliders and rigid links between bodies of a database, as exact constraints instead of stiff springs.

    G X = 0,    D X = F + Gᵀμ,    X = Z q,  G Z = 0,    (Zᵀ D Z) q = Zᵀ F,    μ = (G Gᵀ)⁻¹ G (D X − F)

A row of G requires that the point of the link moves equally on both bodies along an axis of the first body, or that
both bodies rotate equally about such an axis. μ is the force and moment that the first body exerts on the second.
A spring and a damper act along a slider or about a hinge (a power take-off). The travel s is the displacement of the
second body from the first along or about the axis, and the force is k (s − rest) + c ṡ. One of the two bodies may be
SPACE, which means the scene at rest; a single body is called ALONE.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from .flexible.coupling import gradients
from .modes import Body

SPACE, ALONE = "space", "body"
KINDS = ("hinge", "ball", "rigid", "slider")
DRIVEN = ("hinge", "slider")  # kinds of links with a travel, for which a spring and a damper are possible
SHOWN = 7  # numbers of a link: force, moment, travel
SAME = 1e-9  # singular value, relative to the largest, below which a constraint is redundant


class Link(NamedTuple):
    """name : name of the link; bodies : names of the two bodies
    position, axis : a point of the link, m, (3,), and its axis, (3,), in coordinates of the first body

    kind : "hinge" turns about the axis, "ball" about every axis, "rigid" about no axis; "slider" slides along the axis
        without turning
    stiffness, damping : of a slider along its axis, N/m and N s/m; of a hinge about its axis, N m and N m s
    rest : travel at which the spring exerts no force, m or rad
    """

    name: str
    bodies: tuple[str, str]
    position: tuple[float, float, float]
    axis: tuple[float, float, float] = (0.0, 1.0, 0.0)
    kind: str = "hinge"
    damping: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0

    @property
    def along(self):
        """Unit vectors of constrained translation, along the axes of the first body; shape (k, 3)"""
        return _across(self.axis) if self.kind == "slider" else np.eye(3)

    @property
    def held(self):
        """Unit vectors of constrained rotation, along the axes of the first body; shape (k, 3)"""
        return _across(self.axis) if self.kind == "hinge" else np.eye(3)[: 3 * (self.kind != "ball")]


def _across(axis):
    """Two unit vectors at right angles to an axis (3,) and to each other; shape (2, 3)"""
    return np.linalg.svd(np.asarray(axis, float)[None])[2][1:]


def end_of(reader, name):
    """`bem.modes.Body` of a name and the slice of its motions, None for a fixed body.  Raises BetweenError."""
    if name == SPACE:
        return Body(SPACE, fixed=True), None
    if name == ALONE and not reader.bodies:
        return Body(ALONE, tuple(map(float, reader.rotation_center))), slice(0, 6)
    body = reader.body_named(name)
    return body, reader.columns_of(body)


def rows_of(reader, link):
    """Rows of the constraint matrix G for the motions of a `bem.database.reader.Reader`; shape (k, n).  Raises
    BetweenError for unknown bodies."""
    rows = _all_rows(reader, link)
    return np.vstack([link.along @ rows[:3], link.held @ rows[3:]])


def driven(reader):
    """A Reader with the springs and dampers of its links, for small motions about rest"""
    damping, stiffness = np.zeros((2, *reader.damping.shape))
    for link in reader.links:
        if link.damping or link.stiffness:
            row = travel_of(reader, link)
            damping += link.damping * np.outer(row, row)
            stiffness += link.stiffness * np.outer(row, row)
    return reader.restrained(damping=damping, stiffness=stiffness)


def travel_of(reader, link):
    """Row that gives the travel of a slider along its axis, m, or the rotation of a hinge about its axis, rad, from the
    motions of a Reader; shape (n,)"""
    part = _all_rows(reader, link)[:3] if link.kind == "slider" else _all_rows(reader, link)[3:]
    return np.asarray(link.axis, float) @ part / np.linalg.norm(link.axis)


def told_of(links):
    """Return (name, unit, column) of the results of links: each force and moment, and the travel of links in DRIVEN

    column : index of the result among the SHOWN numbers of a link
    """
    found = []
    for i, link in enumerate(links):
        names = [f"{link.name} {word} {axis}" for word in ("force", "moment") for axis in "xyz"]
        rows = list(zip(names, ("N",) * 3 + ("N m",) * 3, range(6), strict=True))
        if link.kind in DRIVEN:
            rows.append((f"{link.name} travel", "m" if link.kind == "slider" else "rad", 6))
        found += [(name, unit, SHOWN * i + column) for name, unit, column in rows]
    return found


def pulls_of(reader, omega, motions):
    """Forces of the springs and dampers of links alone, N and N m per m, with the signs of `forces_of`; shape (q, p,
    links, 6)

    omega : frequencies, rad/s, (q,); motions : motions at these frequencies, (q, p, n)
    """
    out = np.zeros((*motions.shape[:2], len(reader.links), 6), complex)
    for i, link in enumerate(reader.links):
        if link.damping or link.stiffness:
            way = np.asarray(link.axis, float) / np.linalg.norm(link.axis)
            pull = (1j * omega * link.damping - link.stiffness)[:, None] * (motions @ travel_of(reader, link))
            out[:, :, i, slice(0, 3) if link.kind == "slider" else slice(3, 6)] = pull[..., None] * way
    return out


def _all_rows(reader, link):
    """Displacement and rotation of the second body's point relative to the first, along the axes of the first; shape
    (6, n)"""
    (first, own_of_first), (second, own_of_second) = (end_of(reader, name) for name in link.bodies)
    place = first.in_scene(link.position)
    turn = first.axes.T @ second.axes
    rows = np.zeros((6, len(reader.words)))
    for body, sign, axes, own in ((first, -1.0, np.eye(3), own_of_first), (second, 1.0, turn, own_of_second)):
        if own is not None:
            x, y, z = body.axes.T @ (place - (*body.place, 0.0)) - body.own_center
            rows[:3, own] += sign * axes @ np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]])
            rows[3:, own] += sign * axes @ np.eye(3, 6, 3)
            moved, turned = of_shapes(reader, body, body.axes.T @ (place - (*body.place, 0.0)))
            rows[:3, reader.rigid :] += sign * axes @ moved
            rows[3:, reader.rigid :] += sign * axes @ turned
    return rows


def of_shapes(reader, body, point):
    """Displacement, m, (3, f), and rotation (half the curl), rad, (3, f), of a point of a body per unit of each of f
    shapes

    point : the point, m, (3,); point and results are in coordinates of the body
    """
    moved, turned = np.zeros((2, 3, len(reader.modes)))
    number = [one.name for one in reader.bodies].index(body.name) if reader.bodies else 0
    for k, mode in enumerate(reader.modes):
        if number in mode.moves:
            moves = partial(mode.in_body, body)
            (g,) = gradients(moves, point[None], 1.0 + float(np.abs(point).max()))
            moved[:, k] = moves(point[None])[0]
            turned[:, k] = 0.5 * np.array([g[2, 1] - g[1, 2], g[0, 2] - g[2, 0], g[1, 0] - g[0, 1]])
    return moved, turned


def free_of(rows):
    """Z (n, m), orthonormal columns: the motions that the constraints G (r, n) leave free.  Raises ValueError for
    redundant rows."""
    _, size, vectors = np.linalg.svd(rows)
    if len(size) < len(rows) or size[-1] <= SAME * size[0]:
        raise ValueError(
            f"hinges and links fix {np.sum(size > SAME * size[0])} motions with {len(rows)} constraints: some "
            "constraints repeat others; leave out one hinge, or make it a ball"
        )
    return vectors[len(rows) :].T


def forces_of(links, rows, left):
    """Forces of links along the axes of the first body of each link, N and N m per m; shape (…, links, 6)

    left : D X − F, (…, n)"""
    mu = np.linalg.solve(rows @ rows.T, rows @ left[..., None])[..., 0]
    out, at = np.zeros((*mu.shape[:-1], len(links), 6), mu.dtype), 0
    for i, link in enumerate(links):
        turns = at + len(link.along)
        end = turns + len(link.held)
        out[..., i, :3], out[..., i, 3:] = mu[..., at:turns] @ link.along, mu[..., turns:end] @ link.held
        at = end
    return out
