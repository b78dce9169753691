"""Hinges, ball joints and rigid links between bodies of a database, exact: constraints, not stiff springs.

    G X = 0,    D X = F + Gᵀμ,    X = Z q,  G Z = 0,    (Zᵀ D Z) q = Zᵀ F,    μ = (G Gᵀ)⁻¹ G (D X − F)

A row of G says that the point of the link on the second body moves as that on the first along an axis of the first, or
that both turn alike about one.  μ is the force and moment with which the first body holds the second.  One of them may
be SPACE, in coordinates of the scene, and a body that is alone is called ALONE.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .modes import Body

SPACE, ALONE = "space", "body"
KINDS = ("hinge", "ball", "rigid")
SAME = 1e-9  # of the largest singular value: a constraint that the others already are


class Link(NamedTuple):
    """name; bodies : names of two; position (3,) m and axis (3,), free to turn about, in coordinates of the first

    kind : "hinge" turns about its axis, "ball" about all, "rigid" about none
    """

    name: str
    bodies: tuple[str, str]
    position: tuple[float, float, float]
    axis: tuple[float, float, float] = (0.0, 1.0, 0.0)
    kind: str = "hinge"

    @property
    def held(self):
        """(k, 3) unit vectors about which both bodies turn alike, along the axes of the first"""
        if self.kind != "hinge":
            return np.eye(3)[: 3 * (self.kind == "rigid")]
        return np.linalg.svd(np.array([self.axis], float))[2][1:]


def end_of(reader, name):
    """`bem.modes.Body` of a name and the slice of its motions, None where it is still.  Raises BetweenError."""
    if name == SPACE:
        return Body(SPACE, fixed=True), None
    if name == ALONE and not reader.bodies:
        return Body(ALONE, tuple(map(float, reader.rotation_center))), slice(0, 6)
    body = reader.body_named(name)
    return body, reader.columns_of(body)


def rows_of(reader, link):
    """(3 + k, n) of G for the motions of a `bem.database.reader.Reader`.  Raises BetweenError for unknown bodies."""
    (first, own_of_first), (second, own_of_second) = (end_of(reader, name) for name in link.bodies)
    place = first.in_scene(link.position)
    turn = first.axes.T @ second.axes
    rows = np.zeros((6, len(reader.words)))
    for body, sign, axes, own in ((first, -1.0, np.eye(3), own_of_first), (second, 1.0, turn, own_of_second)):
        if own is not None:
            x, y, z = body.axes.T @ (place - (*body.place, 0.0)) - body.own_center
            rows[:3, own] += sign * axes @ np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]])
            rows[3:, own] += sign * axes @ np.eye(3, 6, 3)
    return np.vstack([rows[:3], link.held @ rows[3:]])


def free_of(rows):
    """Z (n, m), orthonormal: what rows G (r, n) leave free.  Raises ValueError where some say what others do."""
    _, size, vectors = np.linalg.svd(rows)
    if len(size) < len(rows) or size[-1] <= SAME * size[0]:
        raise ValueError(
            f"hinges and links hold {np.sum(size > SAME * size[0])} motions with {len(rows)} constraints: some hold "
            "what others already do; leave one out, or make it a ball"
        )
    return vectors[len(rows) :].T


def forces_of(links, rows, left):
    """(…, links, 6) N and N m per m along the axes of the first body of each, from D X − F (…, n)"""
    mu = np.linalg.solve(rows @ rows.T, rows @ left[..., None])[..., 0]
    out, at = np.zeros((*mu.shape[:-1], len(links), 6), mu.dtype), 0
    for i, link in enumerate(links):
        count = len(link.held)
        out[..., i, :3] = mu[..., at : at + 3]
        out[..., i, 3:] = mu[..., at + 3 : at + 3 + count] @ link.held
        at += 3 + count
    return out
