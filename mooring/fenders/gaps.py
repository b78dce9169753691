"""Clear water between hulls seen from above, each hull represented by the box around it."""

from itertools import combinations
from typing import NamedTuple

import numpy as np

CORNERS = np.array([[1, 1], [1, -1], [-1, -1], [-1, 1]])
ROUNDING = 1e-9  # m, and share of a hull


class Side(NamedTuple):
    """name : name of a body; half : (2,) m, half of its length and beam
    own : origin of the body's axes in coordinates of its hull, (2,) m
    moves : number of the body among moving bodies, below 0 for a fixed body; place : (3,), x, y, m, and heading,
        rad, of its axes at rest
    """

    name: str
    half: np.ndarray
    own: np.ndarray
    moves: int
    place: np.ndarray


def pairs_of(sides):
    """Pairs (Side, Side) of hulls between which a gap is reported.

    At least one hull of a pair moves, and no third hull lies between them (as in a row of three).
    Their boxes do not overlap at rest (as those of a float and its spar do).
    """
    rest = np.zeros((1, 1 + max((one.moves for one in sides), default=0), 6))
    for one in sides:
        if one.moves >= 0:
            rest[0, one.moves, 5] = one.place[2]
    moving = (pair for pair in combinations(sides, 2) if max(one.moves for one in pair) >= 0)
    apart = [pair for pair in moving if _gap(*pair, rest)[0] >= 0]
    return [pair for pair in apart if not any(_parted(*pair, one, rest) for one in sides if one not in pair)]


def gaps(sides, poses):
    """Gaps of `pairs_of`, m, with the bodies displaced by poses (n, N, 6) in space from rest; shape (n, pairs).

    A negative gap is the depth of an overlap.
    """
    found = [_gap(*pair, poses) for pair in pairs_of(sides)]
    return np.stack(found, axis=-1) if found else np.zeros((len(poses), 0))


def _gap(one, other, poses):
    """Distance of each hull from the nearest of the other's corners, m; shape (n,); the least way that ends an overlap
    (separating axes)"""
    frames = [_frame(side, poses) for side in (one, other)]
    (p, P), (q, Q) = frames
    away, axes = q - p, np.concatenate([P, Q], axis=2)
    reach = sum(
        np.abs(np.einsum("tij,tik,j->tkj", turn, axes, side.half)).sum(axis=2) for turn, side in ((P, one), (Q, other))
    )
    apart = (np.abs(np.einsum("ti,tik->tk", away, axes)) - reach).max(axis=1)
    found = []
    for (a, b), (mine, their) in (((one, other), frames), ((other, one), frames[::-1])):
        corners = mine[0][:, None] + np.einsum("tij,kj->tki", mine[1], CORNERS * a.half)
        local = np.einsum("tji,tkj->tki", their[1], corners - their[0][:, None])
        found.append(np.hypot(*np.moveaxis(np.maximum(np.abs(local) - b.half, 0.0), -1, 0)).min(axis=1))
    return np.where(apart < 0, apart, np.minimum(*found))


def _parted(one, other, third, poses):
    """Whether every straight way between corners of two hulls leads through a third, with the bodies at poses (1, N,
    6)"""
    origin, axes = (part[0] for part in _frame(third, poses))
    ends = []
    for side in (one, other):
        place, turn = (part[0] for part in _frame(side, poses))
        ends.append((place + CORNERS * side.half @ turn.T - origin) @ axes)
    begin, way = ends[0][:, None], ends[1] - ends[0][:, None]
    way = np.where(np.abs(way) < ROUNDING, ROUNDING, way)
    cross = np.sort([(sign * third.half * (1 + ROUNDING) - begin) / way for sign in (-1, 1)], axis=0)
    enter, leave = cross[0].max(axis=-1), cross[1].min(axis=-1)
    return bool(np.all((enter <= leave) & (leave >= 0) & (enter <= 1)))


def _frame(side, poses):
    """Place of the origin of a hull's coordinates, m, shape (n, 2), and its axes, shape (n, 2, 2)"""
    pose = np.zeros((len(poses), 3)) + side.place
    if side.moves >= 0:
        pose = pose + poses[:, side.moves][:, [0, 1, 5]] - [0, 0, side.place[2]]
    c, s = np.cos(pose[:, 2]), np.sin(pose[:, 2])
    axes = np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=1)
    return pose[:, :2] - np.einsum("tij,j->ti", axes, side.own), axes
