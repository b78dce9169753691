"""Few nodes that stand for all where waves are concerned.

What the free surface adds to 1/r and its image is smooth on hull and lid, but for a strip along the waterline.  Put
together as they act on the unknowns, W = [D_w, K S_w] with the columns of the hull and of the lid, the wave parts of
all frequencies of a band and of all symmetry classes lie in one space that is far smaller than the number of nodes,

    W ≈ X W[points, sources] Y,    S_w V ≈ X S_w[points, monopoles] M,    ∂φ_I/∂n ≈ Z ∂φ_I/∂n[crests]

where V are the normal velocities of motions and the columns of Z.  It is found from the integrals themselves at a few
frequencies, rows and columns weighted as in the L² norm.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...green.tables import wave_table
from ...kernels.interpolative_decomposition import SEED, Sketch, interpolative_decomposition, truncated_least_squares
from ...kernels.progress import WAVES, report_progress
from ...waves import depth_values, wavenumber
from ..incident_waves import class_waves
from ..wave_influence import wave_blocks
from .error_test import Samples, Trial

WITNESSES = 1  # and one at the surface: a space that lacks a frequency misses it nearly everywhere
FEW = 1000  # nodes up to which the accuracy asked for is that of every row
LARGEST = 2_000_000  # pairs of nodes at once
SAMPLES = 200  # nodes at any depth that stand for all where a space is made
# where a frequency is tested, and as many of the strip and of the lid at most: of 1 000 nodes half as many find up to
# four times what is lost
TRIED = 100
EVERY = 3  # a node sends every third frequency of a band: with all of them the error was the same, the time 1.7 times
FLUX = 3  # frequencies at which incident waves are taken, for one of the others
LEAST = 1e-6  # of the flux in all classes: less in one is none
STRIP = 1.0  # sizes of a panel below the surface down to which all nodes are, and a share of those below
WIDTH, FIRST_WIDTH = 3, 1024  # columns of a sketch for one of its rank, and to begin with
LID = 0.1  # how much less than a potential of the hull a φ' of the lid counts: it is zero but for discretisation


class WaveSpace(NamedTuple):
    """n nodes, those of the hull, then those of the lid; r points, q sources, t crests are some of these.

    c symmetry classes, v given normal velocities of each.

    The h sources on the hull, which come first, are the monopoles too.
    """

    points: np.ndarray  # (r,)
    sources: np.ndarray  # (q,)
    crests: np.ndarray  # (t,)
    X: np.ndarray  # (n, r)
    Y: np.ndarray  # (q, n)
    velocities: np.ndarray  # (c, hull nodes, v) V of each class: its motions, as many as of any class, then Z
    M: np.ndarray  # (c, h, v)
    trial: Trial  # with which every frequency is tested


def wave_space(geometry, band, gravity, accuracy):
    """`WaveSpace` of a `bem.panels.influence.Geometry` for frequencies band = (low, high) rad/s.

    accuracy : of W relative to 2π, of S_w and of ∂φ_I/∂n relative to their norms
    """
    g, cases = geometry, Cases(geometry, band, gravity)
    # of a row; what all rows lose together goes with the root of their number
    allowed = 2 * np.pi * accuracy * min(1.0, np.sqrt(FEW / g.hull))
    root, of_column = cases.root, cases.of_column
    crests, Z = _skeleton(cases.waves, g.hull, 0.2 * allowed)  # few columns, and forces are differences of them
    Z *= root[crests] / root[: g.hull, None]
    velocities = _velocities(g, Z)
    points, X = _skeleton(cases.at_all_points, len(root), allowed)
    weights = root[points] * np.linalg.norm(X, axis=0)  # what is lost at a point is lost at all that it stands for
    samples, moved = cases.samples(SEED + 2, TRIED, TRIED), [[] for _ in velocities]
    sources, Y = _skeleton(
        lambda sketch: cases.of_all_sources(sketch, points, weights, velocities, samples.on_hull, moved),
        len(root),
        allowed,
    )
    both = cases.monopoles(points, weights, sources[sources < g.hull], moved, accuracy)
    M, of_samples = (part.copy() for part in np.split(both, [velocities.shape[2]], axis=2))
    X *= root[points] / root[:, None]
    Y = np.ascontiguousarray((Y * of_column[:, None] / of_column[sources]).T)
    trial = Trial.of(cases.witnesses(), samples, X, Y, velocities, of_samples, root[: g.hull])
    return WaveSpace(points, sources, crests, X, Y, velocities, M, trial)


def _velocities(geometry, Z):
    """(c, hull nodes, v) motions of each class, zeros where it has fewer than others, and Z"""
    g, modes = geometry, geometry.modes
    motions = np.zeros((len(g.classes), max(len(g.members(c)) for c in g.classes), g.hull))
    for moving, cls in zip(motions, g.classes, strict=True):
        moving[: len(g.members(cls))] = modes[:, g.members(cls)].T
    return np.concatenate([motions.swapaxes(1, 2), np.broadcast_to(Z, (len(motions), *Z.shape))], axis=2)


def _skeleton(fill, rows, allowed):
    """`interpolative_decomposition` of what `fill` puts into a sketch, wide enough for the rank that it has"""
    width = FIRST_WIDTH
    while True:
        sketch = Sketch(rows, min(width, WIDTH * rows))
        fill(sketch)
        chosen, X = interpolative_decomposition(sketch.matrix, allowed)
        if WIDTH * len(chosen) <= sketch.matrix.shape[1] or width >= WIDTH * rows:
            return chosen, X
        width = max(2 * width, 2 * WIDTH * len(chosen))


class Cases:
    """Wave parts at the frequencies that span a band."""

    def __init__(self, geometry, band, gravity):
        self.geometry, self.gravity = geometry, gravity
        low, high = (float(wavenumber(omega, geometry.depth, gravity)) for omega in band)
        # what is in between is spanned by neighbours, and by log K
        count = 3 + int(np.ceil(high * geometry.radius / 4)) if high > low else 1
        self.wavenumbers = low + (high - low) * np.linspace(0, 1, count) ** 2
        self.root = np.sqrt(geometry.elements.weights)
        self.of_column = self.root / np.where(np.arange(len(self.root)) < geometry.hull, 1.0, LID)

    def blocks(self, points, sources, start=0, step=1):
        """K, and S and D (c, points, sources), of each frequency or every `step`th"""
        g = self.geometry
        for k in self.wavenumbers[start::step]:
            omega = float(np.sqrt(self.gravity * k * np.tanh(k * g.depth)))
            table = wave_table(omega, g.depth, self.gravity, g.reach, g.draft)
            S, D = wave_blocks(g, points, sources, table, depth_values(k, g.depth))
            report_progress(WAVES, len(points) * len(sources) / len(self.root))
            yield table.K, S, D

    def samples(self, seed=SEED, deep=SAMPLES, most=np.inf):
        """`Samples` by chance, each node with its own of `chances`"""
        chances = self.chances(deep, most)
        nodes = np.flatnonzero(np.random.default_rng(seed).random(len(chances)) < chances)
        return Samples(nodes, 1 / chances[nodes], int(np.count_nonzero(nodes < self.geometry.hull)))

    def chances(self, deep, most):
        """(h + l,) of being a sample: `deep` of the hull, more near the surface, the lid, and the witnesses

        Waves change over the distance from the surface, where all nodes are taken, if they are not more than `most`;
        so are those of the lid.
        """
        g, n = self.geometry, self.geometry.hull
        sizes = np.repeat(g.elements.sizes, g.elements.inverse.shape[2])[:n]
        strip = np.minimum((STRIP * sizes / g.elements.nodes[:n, 2]) ** 2, 1.0)
        hull = np.minimum(strip * min(1.0, most / strip.sum()) + deep / n, 1.0)
        hull[self.witnesses()] = 1.0
        lid = len(self.root) - n
        return np.concatenate([hull, np.full(lid, min(1.0, most / max(lid, 1)))])

    def witnesses(self):
        """Nodes (w,) of the hull by chance, one in the strip at the surface"""
        n, generator = self.geometry.hull, np.random.default_rng(SEED + 1)
        areas = self.root[:n] ** 2
        chosen = generator.choice(n, size=min(WITNESSES, n), replace=False, p=areas / areas.sum())
        return np.union1d(chosen, np.argmax(self.geometry.elements.nodes[:n, 2]))

    def at_all_points(self, sketch):
        """W of samples at all nodes, and S in the length of the hull"""
        (samples, represented, _), hull = self.samples(), self.geometry.hull
        length = np.linalg.norm(self.root[:hull]) * np.sqrt(self.geometry.copies)
        for start in range(EVERY):
            few = np.arange(start, len(samples), EVERY)
            for some in np.array_split(few, int(np.ceil(len(few) * len(self.root) / LARGEST))):
                part, count = samples[some], np.count_nonzero(samples[some] < hull)
                scale = self.root[:, None] / self.of_column[part] * np.sqrt(EVERY * represented[some])
                for K, S, D in self.blocks(np.arange(len(self.root)), part, start, EVERY):
                    for s, d in zip(S, D, strict=True):
                        sketch.add(acting(s, d, count, K) * scale)
                        sketch.add(s[:, :count] * scale[:, :count] / length)

    def of_all_sources(self, sketch, points, weights, velocities, samples, moved):
        """W at `points` (r,) times `weights` (r,), transposed

        SV of each class, and S of the `samples` (e,) on the hull, are put into its list of `moved`.
        """
        scale, hull = weights[:, None], self.geometry.hull
        for values in moved:
            values.clear()
        for K, S, D in self.blocks(points, np.arange(len(self.root))):
            for s, d, v, values in zip(S, D, velocities, moved, strict=True):
                sketch.add((acting(s, d, hull, K) * scale / self.of_column).T)
                values.append(np.concatenate([s[:, :hull] @ v, s[:, samples]], axis=1) * scale)

    def monopoles(self, points, weights, sources, moved, accuracy):
        """(c, h, …) what S at `sources` has to be multiplied with to give `moved`: M of each class, then of samples"""
        few = [[] for _ in moved]
        for _, S, _ in self.blocks(points, sources):
            for s, values in zip(S, few, strict=True):
                values.append(s * weights[:, None])
        return np.stack(
            [truncated_least_squares(_real(a), _real(b), 0.1 * accuracy) for a, b in zip(few, moved, strict=True)]
        )

    def waves(self, sketch):
        """∂φ_I/∂n at all nodes of the hull, from all sides, of every class"""
        g = self.geometry
        # the sketch is of real and imaginary parts, which are those of waves from behind too; mirror planes do the rest
        half = np.pi if not g.mesh.symmetry else np.pi / 2
        # a wave of one frequency is one column for every heading, where W has one for every source: at the frequencies
        # of W alone 3 % of the flux was lost in between
        last = len(self.wavenumbers) - 1
        for k in np.interp(np.linspace(0, last, FLUX * last + 1), np.arange(last + 1), self.wavenumbers):
            for beta in np.arange(0, half, np.pi / (8 + 4 * k * g.radius)):
                flux = class_waves(g, beta, 1.0, k)[1] * self.root[: g.hull]
                size = np.linalg.norm(flux, axis=1, keepdims=True)
                sketch.add((flux * (2 * np.pi / np.maximum(size, LEAST * size.max()))).T)


def _real(blocks):
    """Rows of complex blocks, real and imaginary parts apart"""
    rows = np.concatenate(blocks)
    return np.concatenate([rows.real, rows.imag])


def acting(S, D, hull, K):
    """W (…, r, m) as it acts on the unknowns: D of the first `hull` sources, K S of the others, which are lid"""
    return np.concatenate([D[..., :hull], K * S[..., hull:]], axis=-1)
