"""A chain of many links that falls to rest over a bed without friction: where a line lies, to a link's length.

Nodes with the weights w of line and loads, links that pull and do not push, and a bed that pushes and does not pull:

    E = Σ w z + Σ ½ k ⟨r − l⟩² + Σ ½ p ⟨b(x) − z⟩²,    ⟨a⟩ = max(a, 0),

r the lengths of the links, b the bed with its vertices rounded.  From the taut way over the bed the chain goes down
in E by steps of the implicit Euler method without inertia, w/λ a step: each minimises E with the directions of links
and facets that it begins with, where Newton's method finds which links pull and which nodes lie.  A slack line so
finds its hollows, and folds, that equations of pieces in a given order do not.  Lengths over that of the line L,
forces over its weight W.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from .finer import divided

WEIGHTLESS = 0.2  # of the mean weight of a node: least damping of those with little
SETTLED = 1e-7  # of L: largest step of a chain at rest
LONGEST = 0.03  # of L: longest step of a node
STEPS = 250  # of which 20 to 150 are taken; links of a heap may go to and fro for ever
INNER = 8  # iterations on which links pull and which nodes lie
LEAST_DAMPING = (1e-3, 1e-2)  # of a chain as it falls first, and divided anew
FAR_BELOW = np.array([[0.0, -1e3], [1.0, -1e3]])  # a bed where there is none
HARD = 1e5  # p over the weight of a node; over its force N too, if that is more, in a chain divided anew


class FallingChain:
    """Nodes s (n,) of a StaticLine from its anchor up, with its fairlead at (x, z) m

    links : about how many; after `fall`: u (n, 2) places, T (n−1,) of links, N (n,) of the bed, gap (n,) over it
    size : least length of a link; fine : whether it was divided anew, `finer`
    """

    def __init__(self, line, x, z, links):
        L = line.length
        self.line, self.end, self.surface = line, np.array([x, z]) / L, line.surface / L
        self.points = FAR_BELOW if line.bed is None else line.bed.points / L
        self.x, self.slopes = self.points[:, 0], np.diff(self.points[:, 1]) / np.diff(self.points[:, 0])
        self.soft = 2e-3  # over which a buoy emerges
        ends = np.cumsum([segment.length for segment in line.segments]) / L
        self.marks = np.unique(np.concatenate([[0.0], ends[:-1], [load.position / L for load in line.loads], [1.0]]))
        self.fine, self.links = False, links
        self._divide(_nodes(self.marks, links), 1 / links)
        self.u, self.T, self.N = self.start(), np.zeros(len(self.s) - 1), np.zeros(len(self.s))
        self.pulls, self.lies = np.zeros(len(self.s) - 1, bool), np.zeros(len(self.s), bool)

    def _divide(self, s, size):
        """Put nodes at s (n,), the closest of them `size` apart."""
        line, L, W = self.line, self.line.length, self.line.weight
        self.s, self.size = s, size
        ridges = np.maximum(-np.diff(self.slopes), 0.0)
        # half the length over which a vertex is rounded: on the crest of a ridge, several links (`finer`)
        self.round = size * (np.maximum(2.0, 2.5 * ridges) if self.fine else np.full(len(ridges), 0.6))
        self.length = np.diff(self.s)
        ends = np.cumsum([segment.length for segment in line.segments]) / L
        part = np.minimum(np.searchsorted(ends, 0.5 * (self.s[1:] + self.s[:-1])), len(ends) - 1)
        weight = np.array([segment.weight for segment in line.segments])[part] * self.length * L / W
        self.weight = np.zeros(len(self.s))
        self.weight[1:] += 0.5 * weight
        self.weight[:-1] += 0.5 * weight
        self.loads = [int(np.argmin(np.abs(self.s - load.position / L))) for load in line.loads]
        self.floats = []
        for node, load in zip(self.loads, line.loads, strict=True):
            if load.weight < 0 and np.isfinite(self.surface):
                self.floats.append((node, load.weight / W, load.weight_in_air / W))
            else:
                self.weight[node] += load.weight / W
        stiffness = np.array([1 / max(segment.strain_table[0, 2] * W, 1e-300) for segment in line.segments])[part]
        self.k = np.minimum(stiffness, 15.0 / size) / self.length
        share = np.append(self.length, 0.0) + np.append(0.0, self.length)
        self.mass = np.maximum(np.abs(self.weight), WEIGHTLESS * 0.5 * share)

    def bed(self, x):
        """Height, slope and curvature of the bed with vertices rounded by parabolas, (n,) each"""
        slope, curvature = np.full_like(x, self.slopes[0]), np.zeros_like(x)
        height = self.points[0, 1] + self.slopes[0] * x
        for at, bend, d in zip(self.x[1:-1], np.diff(self.slopes), self.round, strict=True):
            t = np.clip((x - at + d) / (2 * d), 0.0, 1.0)
            height += bend * (d * t * t + np.maximum(x - at - d, 0.0))
            slope += bend * t
            curvature += np.where((t > 0) & (t < 1), bend / (2 * d), 0.0)
        return height, slope, curvature

    def start(self):
        """Places on the shortest way over the bed, (n, 2), a little above it between the ends"""
        over = [(0.0, 0.0)]
        for point in [p for p in self.points[1:] if p[0] < self.end[0]] + [self.end]:
            while len(over) > 1 and _left_of(over[-2], over[-1], point):
                over.pop()
            over.append(tuple(point))
        over = np.array(over)
        way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(over, axis=0).T))])
        places = np.column_stack([np.interp(self.s * way[-1], way, over[:, axis]) for axis in (0, 1)])
        places[:, 1] += 1e-3 * np.sin(np.pi * self.s)
        return places

    def fall(self):
        """Let the chain fall to rest; returns itself"""
        u, pulls, lies, damping, settled = self.u, self.pulls, self.lies, 1 / LONGEST, 0
        for _ in range(STEPS):
            try:
                step, pulls, lies = self._step(u, pulls, lies, damping)
            except np.linalg.LinAlgError:  # rounding, of links as stiff as short ones are
                damping *= 100.0
                continue
            size = np.hypot(*step.T)
            u = self._stopped(u, u + step * np.minimum(1.0, LONGEST / np.maximum(size, 1e-300))[:, None], lies)
            largest = size.max()
            damping *= 1.6 if largest > LONGEST else 0.75 if largest < 0.5 * LONGEST else 1.0
            damping = max(damping, LEAST_DAMPING[self.fine])
            settled = settled + 1 if largest < SETTLED else 0
            if settled == 2:
                break
        self.u, self.gap, self.pulls, self.lies = u, u[:, 1] - self.bed(u[:, 0])[0], pulls, lies
        return self

    def _stopped(self, before, after, lies):
        """Places after a step, with nodes stopped in a hollow that would slide on under the facet beyond

        They would go to and fro for ever, one facet being all that a step knows of the bed.
        """
        for at, bend, d in zip(self.x[1:-1], np.diff(self.slopes), self.round, strict=True):
            if bend > 0:
                through = lies & ((before[:, 0] - at) * (after[:, 0] - at) < 0)
                through &= np.abs(before[:, 0] - at) > d
                after[through, 0] = at
                after[through, 1] = self.bed(np.array([at]))[0]
        return after

    def finer(self, size):
        """Divide a chain that has fallen into links of `size` where its contacts change (`finer`)"""
        old, s, per_mass = self.s, divided(self, size), self.N / self.mass
        link = np.searchsorted(old, 0.5 * (s[1:] + s[:-1])) - 1
        self.T, self.pulls, self.lies = self.T[link], self.pulls[link], self.lies[np.searchsorted(old, s)]
        self.u, self.fine = np.column_stack([np.interp(s, old, self.u[:, axis]) for axis in (0, 1)]), True
        self._divide(s, size)
        self.N = np.interp(s, old, per_mass) * self.mass

    def _step(self, u, pulls, lies, damping):
        """(n, 2) step; which links pull and which nodes lie then; sets T and N"""
        n, mass = len(u), self.mass
        hard = HARD * (np.maximum(mass, self.N) if self.fine else mass)
        height, slope, curvature = self.bed(u[:, 0])
        gap, d = u[:, 1] - height, np.diff(u, axis=0)
        r = np.maximum(np.hypot(*d.T), 1e-9)
        e, longer = d / r[:, None], r - self.length
        along = e[:, :, None] * e[:, None, :]
        turning = (self.T / r)[:, None, None] * (np.eye(2) - along)
        lift, stiff_lift = self._lift(u[:, 1])
        for _ in range(INNER):
            k, p = np.where(pulls, self.k, 0.0), np.where(lies, hard, 0.0)
            link = k[:, None, None] * along + turning
            own = np.zeros((n, 2, 2))
            own[:-1] += link
            own[1:] += link
            own[:, 0, 0] += p * slope**2 + np.maximum(self.N * curvature, 0.0) + damping * mass
            own[:, 0, 1] -= p * slope
            own[:, 1, 1] += p + stiff_lift + damping * mass
            force = np.column_stack([p * gap * slope, -self.weight - lift - p * gap])
            tension = (k * longer)[:, None] * e
            force[:-1] += tension
            force[1:] -= tension
            step = np.zeros((n, 2))
            step[1:-1] = _solve_blocks(own[1:-1], -link[1:], force[1:-1])
            stretched = longer + np.sum(e * np.diff(step, axis=0), axis=1)
            above = gap + step[:, 1] - slope * step[:, 0]
            before, pulls, lies = (pulls, lies), stretched > 0, above < 0
            lies[0] = lies[-1] = False
            if np.array_equal(before[0], pulls) and np.array_equal(before[1], lies):
                break
        self.T, self.N = self.k * np.maximum(stretched, 0.0), hard * np.maximum(-above, 0.0)
        return step, pulls, lies

    def emerged(self, node):
        """How far the buoy at a node has come out of the sea: 0 under water to 1 above it"""
        return float(np.clip((self.u[node, 1] - self.surface) / self.soft + 1, 0.0, 1.0))

    def _lift(self, z):
        """Weights of buoys at their heights, and the derivatives where they are about to emerge, (n,) each"""
        weight, stiffness = np.zeros(len(z)), np.zeros(len(z))
        for node, wet, dry in self.floats:
            t = np.clip((z[node] - self.surface) / self.soft + 1, 0.0, 1.0)
            weight[node] += wet + (dry - wet) * t
            stiffness[node] += (dry - wet) / self.soft if z[node] > self.surface - self.soft - LONGEST else 0.0
        return weight, stiffness


def _nodes(marks, links):
    """s of nodes, rising, with one at each mark and at least three links between two of those"""
    parts = [np.linspace(a, b, max(3, round(links * (b - a))) + 1)[:-1] for a, b in pairwise(marks)]
    return np.append(np.concatenate(parts), 1.0)


def _left_of(a, b, c):
    """Whether b is below the straight way from a to c"""
    return (b[1] - a[1]) * (c[0] - a[0]) <= (c[1] - a[1]) * (b[0] - a[0])


def _solve_blocks(own, links, force):
    """(m, 2) solution of a block tridiagonal, symmetric positive system: own (m, 2, 2), links (m, 2, 2) to the next"""
    from scipy.linalg import solveh_banded

    m = len(own)
    band = np.zeros((4, 2 * m))
    band[0, 0::2], band[0, 1::2], band[1, 0::2] = own[:, 0, 0], own[:, 1, 1], own[:, 0, 1]
    band[2, 0::2], band[2, 1::2] = links[:, 0, 0], links[:, 1, 1]
    band[1, 1::2], band[3, 0::2] = links[:, 0, 1], links[:, 1, 0]
    return solveh_banded(band, force.ravel(), lower=True, check_finite=False).reshape(-1, 2)
