"""Low-rank basis of the wave matrices of a frequency band, by interpolative decomposition.

The wave part of G (all but 1/r and its image in the bed) is smooth on hull and lid, except within a strip below the
waterline.  Let W = [D_w, K S_w] be the influence matrix of the wave part, acting on the unknowns of the hull nodes
and of the lid nodes. For all frequencies of a band and all symmetry classes, with far fewer rows than nodes,

    W ≈ X W[points, sources] Y,    S_w V ≈ X S_w[points, monopoles] M,    ∂φ_I/∂n ≈ Z ∂φ_I/∂n[flux_nodes]

where V contains the normal velocities of the motions and the columns of Z. `points`, `sources`, `monopoles` and
`flux_nodes` are interpolation nodes among the nodes of the mesh. X, Y, M, Z are interpolation matrices, which do not
depend on frequency.  These four matrices are computed from snapshots: the wave matrices at a few frequencies, with
rows and columns weighted as in the L² norm (`bem.algebra.interpolative_decomposition`).
"""

from typing import NamedTuple

import numpy as np

from ...algebra.interpolative_decomposition import SEED, Sketch, interpolative_decomposition, truncated_least_squares
from ...green.tables import wave_table
from ...kernels.progress import WAVES, report_progress
from ...waves import depth_values, wavenumber
from ..incident_waves import class_waves
from ..wave_influence import wave_blocks
from .error_test import ErrorTest, Samples

TEST_POINTS = 1  # random test points besides one at the surface; an incomplete basis is wrong nearly everywhere
FEW_NODES = 1000  # largest number of nodes for which the requested accuracy holds for every row
LARGEST_BLOCK = 2_000_000  # pairs of nodes at once
BASIS_SAMPLES = 200  # nodes at any depth, as random columns from which the rows are selected
# samples of the error test at a frequency, and at most this number of the strip and of the lid: for 1 000 nodes half as
# many give up to four times the error
TEST_SAMPLES = 100
STRIDE = (
    3  # a sample is evaluated at every third frequency: with all of them the error was the same, the time 1.7 times
)
FLUX_FREQUENCIES = 3  # frequencies for the incident flux per frequency of W
NEGLIGIBLE_FLUX = 1e-6  # flux below this fraction of the total over all classes is neglected
STRIP = 1.0  # panel sizes below the surface down to which every node is a sample, and part of those below
COLUMNS_PER_RANK, FIRST_COLUMNS = 3, 2048  # width of a sketch, and the width first tried
LID = 0.1  # weight of φ' on the lid relative to φ on the hull: φ' is zero except for discretisation errors


class LowRankWaves(NamedTuple):
    """Interpolation nodes and matrices of one band, for c symmetry classes and n nodes, those of the hull before
    those of the lid.

    The letters are r points, q sources, t flux nodes, and v normal velocities of each class. The first h sources, which
    lie on the hull, are also the monopoles.
    """

    points: np.ndarray  # (r,) node numbers
    sources: np.ndarray  # (q,)
    flux_nodes: np.ndarray  # (t,)
    X: np.ndarray  # (n, r)
    Y: np.ndarray  # (q, n)
    velocities: np.ndarray  # (c, hull nodes, v) V of each class: its motions, as many as of any class, then Z
    M: np.ndarray  # (c, h, v)
    error_test: ErrorTest  # error test of every solved frequency


def low_rank_waves(geometry, band, gravity, accuracy):
    """`LowRankWaves` of a `bem.panels.influence.Geometry` for frequencies band = (low, high) rad/s.

    accuracy : largest allowed error, for W relative to 2π, for S_w and ∂φ_I/∂n relative to their norms
    """
    g, snapshots = geometry, Snapshots(geometry, band, gravity)
    # tolerance of one row; errors of different rows add up like the root of their number
    tolerance = 2 * np.pi * accuracy * min(1.0, np.sqrt(FEW_NODES / g.hull))
    root, column_scale = snapshots.root, snapshots.column_scale
    # the smaller tolerance costs few columns, and forces are small differences of the flux
    flux_nodes, Z = _decomposed(snapshots.add_incident_flux, root[: g.hull], 0.2 * tolerance)
    Z *= root[flux_nodes] / root[: g.hull, None]
    velocities = _velocities(g, Z)
    points, X = _decomposed(snapshots.add_sample_columns, root, tolerance)
    weights = root[points] * np.linalg.norm(X, axis=0)  # an error at a point is one at all nodes interpolated from it
    samples = snapshots.samples(SEED + 2, TEST_SAMPLES, TEST_SAMPLES)
    single_layers = [[] for _ in velocities]
    sources, Y = _decomposed(
        lambda sketch: snapshots.add_point_rows(sketch, points, weights, velocities, samples.on_hull, single_layers),
        1 / column_scale,
        tolerance,
    )
    strengths = snapshots.monopole_strengths(points, weights, sources[sources < g.hull], single_layers, accuracy)
    M, N = (part.copy() for part in np.split(strengths, [velocities.shape[2]], axis=2))
    X *= root[points] / root[:, None]
    Y = np.ascontiguousarray((Y * column_scale[:, None] / column_scale[sources]).T)
    error_test = ErrorTest.of(snapshots.test_points(), samples, X, Y, velocities, N, root[: g.hull])
    return LowRankWaves(points, sources, flux_nodes, X, Y, velocities, M, error_test)


def _velocities(geometry, Z):
    """Motions of each class, padded with zeros to the same number, then the columns of Z; shape (c, hull nodes, v)"""
    g, modes = geometry, geometry.modes
    motions = np.zeros((len(g.classes), max(len(g.members(c)) for c in g.classes), g.hull))
    for moving, cls in zip(motions, g.classes, strict=True):
        moving[: len(g.members(cls))] = modes[:, g.members(cls)].T
    return np.concatenate([motions.swapaxes(1, 2), np.broadcast_to(Z, (len(motions), *Z.shape))], axis=2)


def _decomposed(fill, row_scale, tolerance):
    """`interpolative_decomposition` of the matrix built by fill(sketch), with a sketch wide enough for its rank"""
    width, rows = FIRST_COLUMNS, len(row_scale)
    while True:
        sketch = Sketch(row_scale, min(width, COLUMNS_PER_RANK * rows))
        fill(sketch)
        selected, X = interpolative_decomposition(sketch.matrix, tolerance)
        if COLUMNS_PER_RANK * len(selected) <= sketch.matrix.shape[1] or width >= COLUMNS_PER_RANK * rows:
            return selected, X
        width = max(2 * width, 2 * COLUMNS_PER_RANK * len(selected))


class Snapshots:
    """Wave matrices at the frequencies that represent a band."""

    def __init__(self, geometry, band, gravity):
        self.geometry, self.gravity = geometry, gravity
        low, high = (float(wavenumber(omega, geometry.depth, gravity)) for omega in band)
        # spaced so that matrices between them are combinations of neighbours, log K in long waves included
        count = 3 + int(np.ceil(high * geometry.radius / 4)) if high > low else 1
        self.wavenumbers = low + (high - low) * np.linspace(0, 1, count) ** 2
        self.root = np.sqrt(geometry.elements.weights)  # √(m²), weight of a row in the L² norm
        self.column_scale = self.root / np.where(np.arange(len(self.root)) < geometry.hull, 1.0, LID)

    def blocks(self, points, sources, start=0, step=1):
        """K, and S and D (c, points, sources), of every frequency, or of every `step`th frequency"""
        g = self.geometry
        for k in self.wavenumbers[start::step]:
            omega = float(np.sqrt(self.gravity * k * np.tanh(k * g.depth)))
            table = wave_table(omega, g.depth, self.gravity, g.reach, g.draft)
            S, D = wave_blocks(g, points, sources, table, depth_values(k, g.depth))
            report_progress(WAVES, len(points) * len(sources) / len(self.root))
            yield table.K, S, D

    def samples(self, seed=SEED, deep=BASIS_SAMPLES, most=np.inf):
        """Random `Samples` of the nodes; `probabilities` gives the probability of each node"""
        probabilities = self.probabilities(deep, most)
        nodes = np.flatnonzero(np.random.default_rng(seed).random(len(probabilities)) < probabilities)
        return Samples(nodes, 1 / probabilities[nodes], int(np.count_nonzero(nodes < self.geometry.hull)))

    def probabilities(self, deep, most):
        """Probability that each node is a sample; shape (n,)

        Samples are about `deep` nodes of the hull at any depth, the nodes of the lid and of the strip below the
        surface, where waves vary with depth (all of these nodes, or on average `most` if there are more), and the
        test points.
        """
        g, n = self.geometry, self.geometry.hull
        sizes = np.repeat(g.elements.sizes, g.elements.inverse.shape[2])[:n]
        strip = np.minimum((STRIP * sizes / g.elements.nodes[:n, 2]) ** 2, 1.0)
        hull = np.minimum(strip * min(1.0, most / strip.sum()) + deep / n, 1.0)
        hull[self.test_points()] = 1.0
        lid = len(self.root) - n
        return np.concatenate([hull, np.full(lid, min(1.0, most / max(lid, 1)))])

    def test_points(self):
        """Nodes of the hull at which errors are tested, `TEST_POINTS` random nodes and the highest node; shape (w,)"""
        n, generator = self.geometry.hull, np.random.default_rng(SEED + 1)
        areas = self.root[:n] ** 2
        chosen = generator.choice(n, size=min(TEST_POINTS, n), replace=False, p=areas / areas.sum())
        return np.union1d(chosen, np.argmax(self.geometry.elements.nodes[:n, 2]))

    def add_sample_columns(self, sketch):
        """Add the columns of W for random samples at all nodes, and those of S, divided by the hull's length"""
        (samples, sample_weights, _), hull = self.samples(), self.geometry.hull
        length = np.linalg.norm(self.root[:hull]) * np.sqrt(self.geometry.copies)
        for start in range(STRIDE):
            some = np.arange(start, len(samples), STRIDE)
            for block in np.array_split(some, int(np.ceil(len(some) * len(self.root) / LARGEST_BLOCK))):
                part, count = samples[block], np.count_nonzero(samples[block] < hull)
                scale = np.sqrt(STRIDE * sample_weights[block]) / self.column_scale[part]
                for K, S, D in self.blocks(np.arange(len(self.root)), part, start, STRIDE):
                    sketch.add(D[..., :count], scale=scale[:count])
                    sketch.add(S[..., :count], scale=scale[:count] / length)
                    sketch.add(S[..., count:], scale=K * scale[count:])

    def add_point_rows(self, sketch, points, weights, velocities, samples, single_layers):
        """Add the rows of W at `points` (r,) times `weights` (r,), as columns

        For each frequency and class, an array (r, v + e) of S V and S of the `samples` (e,) on the hull is appended
        to the list of the class in `single_layers`.
        """
        scale, hull = weights[:, None], self.geometry.hull
        for layers in single_layers:
            layers.clear()
        for K, S, D in self.blocks(points, np.arange(len(self.root))):
            of_sources = D[..., :hull].swapaxes(1, 2), K * S[..., hull:].swapaxes(1, 2)
            sketch.add(*of_sources, scale=weights)
            for s, v, layers in zip(S, velocities, single_layers, strict=True):
                layers.append(np.concatenate([s[:, :hull] @ v, s[:, samples]], axis=1) * scale)

    def monopole_strengths(self, points, weights, sources, single_layers, accuracy):
        """Factors with which S at `sources` (h,) gives the `single_layers`: M of a class, then N; shape (c, h, v +
        e)"""
        at_sources = [[] for _ in single_layers]
        for _, S, _ in self.blocks(points, sources):
            for s, layers in zip(S, at_sources, strict=True):
                layers.append(s * weights[:, None])
        return np.stack(
            [
                truncated_least_squares(_real_rows(a), _real_rows(b), 0.1 * accuracy)
                for a, b in zip(at_sources, single_layers, strict=True)
            ]
        )

    def add_incident_flux(self, sketch):
        """Add ∂φ_I/∂n at the nodes of the hull, for all headings and classes"""
        g = self.geometry
        # real and imaginary parts count apart, so that opposite headings give the same; mirror planes give the others
        half = np.pi if not g.mesh.symmetry else np.pi / 2
        # one heading gives one column, where W has one for every source: at the frequencies of W alone 3 % of the flux
        # between them was missing
        last = len(self.wavenumbers) - 1
        for k in np.interp(np.linspace(0, last, FLUX_FREQUENCIES * last + 1), np.arange(last + 1), self.wavenumbers):
            headings = np.arange(0, half, np.pi / (8 + 4 * k * g.radius))
            flux = np.concatenate([class_waves(g, beta, 1.0, k)[1] for beta in headings])
            size = np.linalg.norm(flux * self.root[: g.hull], axis=1).reshape(len(headings), -1)
            least = NEGLIGIBLE_FLUX * size.max(axis=1, keepdims=True)
            sketch.add(flux.T, scale=(2 * np.pi / np.maximum(size, least)).ravel())


def _real_rows(blocks):
    """Complex blocks on top of each other, as real rows: all real parts, then all imaginary parts"""
    rows = np.concatenate(blocks)
    return np.concatenate([rows.real, rows.imag])


def wave_operator(S, D, hull, K):
    """W = [D, K S], (…, r, m): D of the first `hull` sources and K S of the other sources, which lie on the lid"""
    return np.concatenate([D[..., :hull], K * S[..., hull:]], axis=-1)
