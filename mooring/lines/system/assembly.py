"""Compiled forces and stiffness of a system of lines: the rows of the lines, and the matrices from these rows.

A line end on a body at arm a with force f and stiffness block k = −∂f/∂r adds J' k J − S(f) S(a) to the stiffness
about the moving origin, with J = [1, −S(a)] and S(a) v = a × v; an end on a free point adds k itself.
Rows and columns surge, sway and yaw are the coefficients a11 … a33 of the SR179 report (1982), eq. 3.5.1.2.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel

from ..catenary.flat_bed import ROW, exchange, mirror, solve_line
from ..catenary.state import BEYOND_REACH

FIXED, FREE = -1, -2  # owners of points; a body is identified by its number


@kernel()
def place_points(position, owner, column, place, turn, free):
    """Places of all points, (p, 3) m in space."""
    bodies = place.shape[0]
    points = position.copy()
    for i in range(owner.size):
        if owner[i] >= 0:
            R, r = turn[owner[i]], place[owner[i]]
            for j in range(3):
                points[i, j] = r[j] + R[j, 0] * position[i, 0] + R[j, 1] * position[i, 1] + R[j, 2] * position[i, 2]
        elif owner[i] == FREE:
            for j in range(3):  # array assignment takes 1.5 s to compile, for its error message
                points[i, j] = free[(column[i] - 6 * bodies) // 3, j]
    return points


@kernel()
def end_blocks(row, k, x, ox, oy):
    """k (2, 2, 3, 3): −∂(force on end i)/∂(place of end j), from the derivatives in a vertical plane."""
    for i in range(2):
        pull = row[1 + i]
        across = pull / x if x > 0.0 else row[6 + 3 * i]
        for j in range(2):
            sign = 1.0 if i == j else -1.0
            along = sign * row[6 + 3 * i]
            side = sign * across
            k[i, j, 0, 0] = along * ox * ox + side * oy * oy
            k[i, j, 1, 1] = along * oy * oy + side * ox * ox
            k[i, j, 0, 1] = k[i, j, 1, 0] = (along - side) * ox * oy
            # the pull on a points to b, that on b to a; the span grows with b and shrinks with a
            to = 1.0 if i == 1 else -1.0
            k[i, j, 0, 2], k[i, j, 1, 2] = to * row[7 + 3 * i + j] * ox, to * row[7 + 3 * i + j] * oy
            span = 1.0 if j == 1 else -1.0
            k[i, j, 2, 0], k[i, j, 2, 1] = span * row[12 + 3 * i] * ox, span * row[12 + 3 * i] * oy
            k[i, j, 2, 2] = row[13 + 3 * i + j]


@kernel()
def add_moment_rows(out, block, arm):
    """Fill out (6, 3) from (3, 3): the force rows, then arm × them."""
    for j in range(3):
        for i in range(3):
            out[i, j] = block[i, j]
        out[3, j] = arm[1] * block[2, j] - arm[2] * block[1, j]
        out[4, j] = arm[2] * block[0, j] - arm[0] * block[2, j]
        out[5, j] = arm[0] * block[1, j] - arm[1] * block[0, j]


@kernel()
def add_block(K, tall, block, row, rows, column, columns, arm_row, arm_column):
    """Add J' block J at (row, column); bodies have 6 rows or columns, free points 3.  tall (6, 3) is overwritten."""
    add_moment_rows(tall, block, arm_row)
    for i in range(rows):
        for j in range(3):
            K[row + i, column + j] += tall[i, j]
        if columns == 6:  # tall times −S(arm)
            a, b, c = tall[i, 0], tall[i, 1], tall[i, 2]
            K[row + i, column + 3] += c * arm_column[1] - b * arm_column[2]
            K[row + i, column + 4] += a * arm_column[2] - c * arm_column[0]
            K[row + i, column + 5] += b * arm_column[0] - a * arm_column[1]


@kernel()
def add_force(force, K, f, arm, column, width):
    """Add the force f of one line end, the moment of f, and −S(f) S(arm)."""
    for i in range(3):
        force[column + i] += f[i]
    if width == 6:
        force[column + 3] += arm[1] * f[2] - arm[2] * f[1]
        force[column + 4] += arm[2] * f[0] - arm[0] * f[2]
        force[column + 5] += arm[0] * f[1] - arm[1] * f[0]
        inner = f[0] * arm[0] + f[1] * arm[1] + f[2] * arm[2]
        for i in range(3):  # S(f) S(a) = a f' − (a·f) 1
            for j in range(3):
                K[column + 3 + i, column + 3 + j] -= arm[i] * f[j]
            K[column + 3 + i, column + 3 + i] += inner


@kernel()
def add_float(force, K, points, owner, column, floats):
    """Weight of free points and the buoyancy of submerged parts; floats : (p, 3) N, N, m."""
    for i in range(owner.size):
        if owner[i] == FREE:
            weight, buoyancy, height = floats[i]
            under = 0.5 - points[i, 2] / height
            force[column[i] + 2] += buoyancy * min(max(under, 0.0), 1.0) - weight
            if 0.0 < under < 1.0:
                K[column[i] + 2, column[i] + 2] += buoyancy / height


@kernel()
def uniform_rows(points, ends, flipped, lines, bed):
    """Forces and derivatives of the uniform lines, each solved from its anchored end; shape (n, ROW).

    Rows of `lines` without a length are filled elsewhere.
    """
    rows = np.zeros((ends.shape[0], ROW))
    for n in range(ends.shape[0]):
        length, weight, flexibility, friction = lines[n]
        if length == 0.0:
            continue
        a, b = (ends[n, 1], ends[n, 0]) if flipped[n] else (ends[n, 0], ends[n, 1])
        dx, dy = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1]
        x, low, high = np.sqrt(dx * dx + dy * dy), points[a, 2], points[b, 2]
        row = rows[n]
        if weight > 0.0:
            solve_line(row, x, low - bed, high - bed, length, weight, flexibility, friction, True)
        else:
            solve_line(row, x, -low, -high, length, -weight, flexibility, 0.0, False)
            mirror(row)
    return rows


@kernel()
def add_rows(rows, points, owner, column, floats, ends, flipped, place, size):
    """Add force (N,) and K (N, N) of the rows of all lines; the rows are left in the order a, b of the ends."""
    force, K = np.zeros(size), np.zeros((size, size))
    k, f, arm = np.zeros((2, 2, 3, 3)), np.zeros((2, 3)), np.zeros((2, 3))
    pair, tall = np.zeros(2, np.int64), np.zeros((6, 3))
    add_float(force, K, points, owner, column, floats)
    for n in range(ends.shape[0]):
        row = rows[n]
        if row[0] >= BEYOND_REACH:
            force[:] = np.nan
            return force, K
        pair[0], pair[1] = (ends[n, 1], ends[n, 0]) if flipped[n] else (ends[n, 0], ends[n, 1])
        dx, dy = points[pair[1], 0] - points[pair[0], 0], points[pair[1], 1] - points[pair[0], 1]
        x = np.sqrt(dx * dx + dy * dy)
        ox, oy = (dx / x, dy / x) if x > 0.0 else (1.0, 0.0)
        end_blocks(row, k, x, ox, oy)
        f[0, 0], f[0, 1], f[0, 2] = row[1] * ox, row[1] * oy, -row[3]
        f[1, 0], f[1, 1], f[1, 2] = -row[2] * ox, -row[2] * oy, -row[4]
        for i in range(2):
            who = owner[pair[i]]
            if who >= 0:
                for j in range(3):
                    arm[i, j] = points[pair[i], j] - place[who, j]
        for i in range(2):
            p = pair[i]
            if owner[p] == FIXED:
                continue
            width = 6 if owner[p] >= 0 else 3
            add_force(force, K, f[i], arm[i], column[p], width)
            for j in range(2):
                r = pair[j]
                if owner[r] != FIXED:
                    columns = 6 if owner[r] >= 0 else 3
                    add_block(K, tall, k[i, j], column[p], width, column[r], columns, arm[i], arm[j])
        if flipped[n]:
            exchange(row)
    return force, K


@kernel()
def rows_of(points, ends, flipped, lines, bed):
    """`uniform_rows` for calls from Python; compiled only once, also for `assemble`"""
    return uniform_rows(points, ends, flipped, lines, bed)


@kernel()
def assemble(position, owner, column, floats, ends, flipped, lines, bed, place, turn, free):
    """force (N,), K (N, N) = −∂force, rows (n, ROW) and points (p, 3) of a system; N = 6 bodies + 3 free points.

    lines : (n, 4) length, weight, 1/EA, friction; bed : height of the bed, m
    flipped : (n,) whether end b is the anchor on the bed, where friction has acted in full
    """
    points = place_points(position, owner, column, place, turn, free)
    rows = uniform_rows(points, ends, flipped, lines, bed)
    size = 6 * place.shape[0] + 3 * free.shape[0]
    force, K = add_rows(rows, points, owner, column, floats, ends, flipped, place, size)
    return force, K, rows, points
