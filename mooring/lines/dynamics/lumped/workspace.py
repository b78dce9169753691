"""Memory of a line's steps, coordinate by coordinate, so that eight nodes or elements fill a SIMD vector.

Node j is column j.  Element e, between nodes e and e + 1, is column e + 1. The elements on both sides of node j are
then columns j and j + 1. The column before the first and all columns after the last contain elements of zero force
and weight. Rows are longer than the number of nodes, by at least eight: vectors may begin at any node.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH

from .band import OF_BAND
from .bending import joints

# rows of Work.element: 1/m, N, N s, 1/soft strain; strain, tension/EA and slope/EA of the material's row; halves, see
# `System`
SHORT, STIFFNESS, DAMPING, HARD, BEGIN, OVER, SLOPE = range(7)
DRAG_NORMAL, DRAG_TANGENTIAL, ADDED_NORMAL, ADDED_TANGENTIAL, DISPLACED = range(7, 12)
OF_WATER, WHOLE = 5, 12  # these five, and where they stand as of an element that is wholly wet, where it may not be
BUOYANCY, ROUND = 17, 18  # N; m, least height over which an element leaves the water
OF_ELEMENT = 19
# rows of Work.node: kg, N, kg; N/m, N s/m and 1/m of the bed; normal (3), level and turn of the plane under the node
MASS, WEIGHT, INERTIA, BED_STIFFNESS, BED_DAMPING, BED_THIN, NORMAL, LEVEL, TURN = (0, 1, 2, 3, 4, 5, 6, 9, 10)
OF_NODE = 11
OF_PIVOT = 27  # see `block_tridiagonal.factor`
STAGES = 3  # of a step, see `esdirk`


@in_memory
class Work(NamedTuple):
    """Arrays used over and over; n nodes in rows of w columns."""

    q: np.ndarray  # (3, w) place, velocity, residual and correction; velocity and acceleration of the water
    v: np.ndarray
    r: np.ndarray
    x: np.ndarray
    u: np.ndarray
    du: np.ndarray
    D: np.ndarray  # (9, w) tangent: blocks of the nodes, row by row, and of the elements
    B: np.ndarray  # (9, w)
    T: np.ndarray  # (w,) tensions of the elements
    tangent: np.ndarray  # (3, w)
    change: np.ndarray  # (w,) N, of the tensions by a correction
    element: np.ndarray  # (OF_ELEMENT, w)
    node: np.ndarray  # (OF_NODE, w)
    power: np.ndarray  # (6,)
    pivots: np.ndarray  # (n, OF_PIVOT) of the last tangent that was factored, or (n, OF_BAND) of a line that bends
    bending: np.ndarray  # (OF_BENDING, w), (OF_BENDING, 0) of one that does not
    tabled: bool  # whether an element has more than one row of `System.elongation`
    rises: bool  # whether the line may leave the water
    kept: np.ndarray  # (6 + 2 STAGES, 3, w) what steps keep: place, velocity and others, and those of the stages
    powers: np.ndarray  # (STAGES, 6)
    energy: np.ndarray  # (6,) J
    fairlead: np.ndarray  # (3, 3) its place, velocity, acceleration


def width(n):
    """Columns for n nodes"""
    return -(-n // WIDTH) * WIDTH + WIDTH


def to_rows(points):
    """Points (n, 3) as rows of length w; shape (3, w)"""
    rows = np.zeros((3, width(len(points))))
    rows[:, : len(points)] = points.T
    return rows


@kernel(counted=False)
def read(rows, points):
    """rows (3, w) = points (n, 3)"""
    for j in range(points.shape[0]):
        for i in range(3):
            rows[i, j] = points[j, i]


@kernel(counted=False)
def write(points, rows):
    """points (n, 3) = rows (3, w)"""
    for j in range(points.shape[0]):
        for i in range(3):
            points[j, i] = rows[i, j]


def workspace(s):
    """Work for the line of a System."""
    n, w = s.mass.size, width(s.mass.size)
    points, blocks, along = np.zeros((6, 3, w)), np.zeros((2, 9, w)), np.zeros((5, w))
    element, node = np.zeros((OF_ELEMENT, w)), np.zeros((OF_NODE, w))
    element[[SHORT, HARD, ROUND]] = node[BED_THIN] = 1.0
    node[NORMAL + 2], node[LEVEL] = 1.0, -1.0  # the bed lies level and below columns without a node
    first, last = s.elongation_rows.T
    begin, over, slope, _ = s.elongation[first].T
    water = s.half_drag_normal, s.half_drag_tangential, s.half_added_normal, s.half_added_tangential, s.half_displaced
    element[:, 1:n] = [
        1.0 / s.length, s.stiffness, s.damping, 1.0 / s.soft_strain, begin, over, slope, *water, *water, s.buoyancy,
        s.waterline,
    ]  # fmt: skip
    node[:BED_THIN, :n] = s.mass, s.weight, s.inertia, s.bed_stiffness, s.bed_damping
    thick = s.bed_thickness > 0.0
    node[BED_THIN, :n][thick] = 1.0 / s.bed_thickness[thick]
    node[NORMAL : NORMAL + 3, :n], node[LEVEL, :n] = s.bed_normal[:, None], s.bed_level
    bending = joints(s.flexure, s.length, w)
    pivots = np.zeros((n, OF_BAND if bending.size else OF_PIVOT))
    return Work(
        *points, *blocks, along[0], along[1:4], along[4], element, node, np.zeros(6), pivots, bending,
        bool(np.any(last > first + 1)), bool(np.any(s.buoyancy > 0.0)), np.zeros((6 + 2 * STAGES, 3, w)),
        np.zeros((STAGES, 6)), np.zeros(6), np.zeros((3, 3)),
    )  # fmt: skip


@kernel(counted=False)
def copy(y, x):
    """y = x for (3, w) arrays. Here and in `add` a loop compiles in a fraction of the time of the array expression."""
    for i in range(3):
        for j in range(y.shape[1]):
            y[i, j] = x[i, j]


@kernel(counted=False)
def add(y, f, x):
    """y += f x for (3, w) arrays."""
    for i in range(3):
        for j in range(y.shape[1]):
            y[i, j] += f * x[i, j]


@kernel(counted=False)
def largest_of(numbers):
    """Largest of numbers (n,): `max` of an array takes a quarter of a second to compile"""
    most = numbers[0]
    for i in range(1, numbers.size):
        most = max(most, numbers[i])
    return most
