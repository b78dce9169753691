"""Rest of lines cut into straight segments between nodes, as MoorDyn cuts them, by Newton's method on their energy.

A segment l long pulls with EA (|Δr|/l − 1) where that is above 0, gives half its weight in air, and half the buoyancy
of what of it is under water, to each of its nodes; a node deeper than the bed by δ is pushed up with k_bot d l δ.
Shares nothing with the catenaries of `mooring.lines` but the place its search begins at: as segments grow shorter its
tensions go to theirs or do not, and at MoorDyn's own number of segments they are what MoorDyn should come to.
"""

import numpy as np
from scipy.sparse import coo_matrix, identity
from scipy.sparse.linalg import splu

from hakobune.mooring.lines.system.parts import FreePoint
from hakobune.mooring.lines.system.shapes import line_shapes

STEPS, SMALL = 400, 1e-8  # of Newton; of the whole weight


class Nodes:
    """The lines of a SystemEquilibrium with free points alone to move, `elements` segments each"""

    def __init__(self, state, bed_stiffness):
        system = state.system
        self.system, self.bed = system, bed_stiffness
        free = [isinstance(point, FreePoint) for point in system.points]
        count, places, ends, parts = len(system.points), [state.points], [], []
        for number, (line, shape) in enumerate(zip(system.lines, line_shapes(state, 400), strict=True)):
            n = line.elements
            way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(shape, axis=0), axis=1))])
            at = np.linspace(0, way[-1], n + 1)[1:-1]
            places.append(np.column_stack([np.interp(at, way, axis) for axis in shape.T]))
            a, b = system.arrays.ends[number]
            inner = count + np.arange(n - 1)
            nodes = np.array([a, *inner, b])
            ends.append(np.column_stack([nodes[:-1], nodes[1:]]))
            parts += [number] * n
            free += [True] * (n - 1)
            count += n - 1
        self.r, self.ends, self.parts = np.concatenate(places), np.concatenate(ends), np.array(parts)
        self.free = np.flatnonzero(np.repeat(free, 3))
        each = lambda f: np.array([f(line) for line in system.lines], float)[self.parts]  # noqa: E731
        self.l, self.EA = each(lambda line: line.length / line.elements), each(lambda line: line.type.axial_stiffness)
        g, area = system.gravity, each(lambda line: np.pi / 4 * line.type.diameter**2)
        self.weight = each(lambda line: line.type.mass) * g * self.l
        self.lift = system.density * g * area * self.l
        contact = bed_stiffness * each(lambda line: line.type.diameter) * self.l
        self.contact = np.bincount(self.ends.ravel(), np.repeat(0.5 * contact, 2), count)
        self.points = [
            (i, g * point.mass, system.density * g * point.volume, point.emersion_height)
            for i, point in enumerate(system.points)
            if isinstance(point, FreePoint)
        ]

    def force(self, r):
        """(n, 3) N on the nodes, tensions (m,) N of the segments, their directions and lengths"""
        a, b = self.ends.T
        d = r[b] - r[a]
        long = np.linalg.norm(d, axis=1)
        T = np.maximum(self.EA * (long / self.l - 1), 0.0)
        u = d / np.maximum(long, 1e-12)[:, None]
        f = np.zeros_like(r)
        np.add.at(f, a, T[:, None] * u)
        np.add.at(f, b, -T[:, None] * u)
        up = 0.5 * (self.lift * wet(r[a, 2], r[b, 2]) - self.weight)
        np.add.at(f[:, 2], a, up)
        np.add.at(f[:, 2], b, up)
        f[:, 2] += self.contact * np.maximum(-self.system.depth - r[:, 2], 0.0)
        for i, weight, lift, height in self.points:
            f[i, 2] += lift * np.clip(0.5 - r[i, 2] / height, 0, 1) - weight
        return f, T, u, long

    def stiffness(self, r, T, u, long):
        """Sparse (3n, 3n), −∂f/∂r, with tension where the segment is slack taken as none"""
        uu = u[:, :, None] * u[:, None, :]
        k = np.where(T > 0, self.EA / self.l, 0.0)[:, None, None] * uu
        k += (T / np.maximum(long, 1e-12))[:, None, None] * (np.eye(3) - uu)
        a, b = self.ends.T
        rows, columns, values = [], [], []
        for p, q, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
            rows.append((3 * p[:, None, None] + np.arange(3)[None, :, None] + 0 * k).ravel())
            columns.append((3 * q[:, None, None] + np.arange(3)[None, None, :] + 0 * k).ravel())
            values.append((sign * k).ravel())
        vertical = 3 * np.arange(len(r)) + 2
        rows.append(vertical), columns.append(vertical)
        values.append(self.contact * (r[:, 2] < -self.system.depth))
        size = 3 * len(r)
        entries = (np.concatenate(rows).astype(int), np.concatenate(columns).astype(int))
        K = coo_matrix((np.concatenate(values), entries), (size, size))
        return K.tocsc()[self.free][:, self.free]

    def rest(self):
        """(m,) N, tensions of the segments.  raises : ValueError where Newton does not come to rest"""
        r, shift = self.r.copy(), 1e-3 * float(self.weight.sum() / self.l.sum())
        f, T, u, long = self.force(r)
        left = np.abs(f.ravel()[self.free]).max(initial=0.0)
        target = SMALL * self.weight.sum()
        for _ in range(STEPS):
            if left <= target:
                return T
            K = self.stiffness(r, T, u, long)
            step = splu(K + shift * identity(K.shape[0], format="csc")).solve(f.ravel()[self.free])
            step *= min(1.0, 0.5 * self.l.max() / np.abs(step).max())
            ahead = r.copy()
            ahead.reshape(-1)[self.free] += step
            g = self.force(ahead)
            if step @ g[0].ravel()[self.free] >= -0.5 * abs(step @ f.ravel()[self.free]):
                r, (f, T, u, long), shift = ahead, g, 0.3 * shift
                left = np.abs(f.ravel()[self.free]).max()
            else:
                shift = max(4 * shift, 1e-6)
        raise ValueError(f"the cut lines have {left:.3g} N left after {STEPS} steps")


def wet(low, high):
    """Share of segments between two heights that is under water"""
    low, high = np.minimum(low, high), np.maximum(low, high)
    return np.clip(-low / np.maximum(high - low, 1e-12), 0.0, 1.0)


def end_tensions(state, bed_stiffness):
    """(n, 2) N, of the first and the last segment of each line"""
    nodes = Nodes(state, bed_stiffness)
    T = nodes.rest()
    first = np.concatenate([[0], np.cumsum([line.elements for line in state.system.lines])])
    return np.column_stack([T[first[:-1]], T[first[1:] - 1]])
