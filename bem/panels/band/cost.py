"""Memory and time of a large panel problem: memory by counting, time from short measurements."""

import time
from typing import NamedTuple

import numpy as np

from ...green.tables import wave_table
from ...kernels.progress import FACTORS, MATRICES, WAVES
from ...kernels.threads import PAIRS_WORTH_THREADS
from ...waves import depth_values
from ..wave_influence import wave_blocks
from .equations import split_by_lid
from .low_rank_waves import STRIDE, Snapshots

TIMED_RUNS, TIMED_ROWS, TIMED_UNKNOWNS = 3, 16, 1500
BYTES_OF_PROGRAM = 400e6  # memory of the interpreter, libraries and tables, bytes
BYTES_PER_PAIR = 54  # bytes per pair of nodes and symmetry class: Rankine and wave matrices, factors and blocks
BYTES_PER_AXISYMMETRIC_PAIR = 100  # row of a sector, node and class: Rankine rows, wave rows and all harmonics
# bytes of compressed equations per node and per doubling of their number, beside the Rankine parts: 1.0 to 2.0 kB on
# 1 600 to 12 000 nodes of one and of four classes
BYTES_PER_DOUBLING = 2.0e3
# evaluations of G and ∇G, or the equivalent time; fitted to 12 000 nodes of one class
EVALUATIONS_PER_DOUBLING = 370
# bytes per node of the Rankine parts that they keep, and most nodes with which they do (`compressed.operator`)
BYTES_KEPT, MOST_KEEPING = 1.44e4, 22_000
RANK = 600  # assumed rank of the wave matrices, on the high side (`bem.panels.band.low_rank_waves`)


class Cost(NamedTuple):
    """memory : peak memory, bytes; stages : {stage of `bem.kernels.progress`: (number of items, seconds for each
    item)}"""

    memory: float
    stages: dict

    @property
    def seconds(self):
        """Time before the first frequency, s"""
        return sum(count * seconds for count, seconds in self.stages.values())


def cost(geometry, band, gravity):
    """`Cost` of `bem.panels.band.equations.band_equations`; same arguments."""
    n, classes = geometry.hull, len(geometry.classes)
    lid = len(geometry.elements.nodes) - n
    columns = RANK + 2 * lid
    matrices = 8.0 * classes * (n * n + 2 * n * columns) + 8.0 * n * columns
    rows = 0.0
    for part in split_by_lid(geometry, band, gravity):
        snapshots = Snapshots(*part, gravity)
        rows += len(snapshots.wavenumbers) * (len(snapshots.samples().nodes) / STRIDE + RANK)
    factor = _seconds_of_factor() * ((n / TIMED_UNKNOWNS) ** 3 + 3 * columns * n**2 / TIMED_UNKNOWNS**3)
    stages = {
        WAVES: (rows, _seconds_of_waves(geometry, band[1], gravity)),
        MATRICES: (n + lid, _seconds_of_rows(geometry)),
        FACTORS: (classes, factor),
    }
    return Cost(matrices + BYTES_OF_PROGRAM, stages)


def memory_alone(prepared):
    """Peak memory, bytes, of frequencies without shared work (`bem.panels.one_frequency`, `bem.panels.compressed`,
    `bem.panels.zero_draft`, `bem.panels.axisymmetric_frequency`)
    """
    if prepared.compressed and not prepared.axisymmetric_geometry.sectors:
        n = len(prepared.geometry.elements.nodes)
        kept = BYTES_KEPT * n * (n < MOST_KEEPING)
        return BYTES_PER_DOUBLING * n * np.log2(n) + kept + BYTES_OF_PROGRAM
    by_classes = prepared.problem.zero_draft  # the plate is solved by symmetry classes, axisymmetric or not
    g = prepared.geometry if by_classes else prepared.axisymmetric_geometry
    nodes = float(len(g.elements.nodes))
    if by_classes or not g.sectors:
        return BYTES_PER_PAIR * len(g.classes) * nodes**2 + BYTES_OF_PROGRAM
    return BYTES_PER_AXISYMMETRIC_PAIR * len(g.classes) * nodes * len(g.sectors.first) + BYTES_OF_PROGRAM


def seconds_alone(prepared, omega):
    """Time, s, of the frequency omega (rad/s) without shared work (`bem.panels.one_frequency`, `bem.panels.compressed`)

    NaN for axisymmetric bodies, whose sectors take far less (`bem.panels.axisymmetric_frequency`), and for plates
    (`bem.panels.zero_draft`)
    """
    geometry, gravity = prepared.geometry, prepared.problem.gravity
    if prepared.problem.zero_draft or prepared.axisymmetric_geometry.sectors:
        return np.nan
    n = len(geometry.elements.nodes)
    waves, rankine = _seconds_of_waves(geometry, omega, gravity), _seconds_of_rows(geometry)
    if prepared.compressed:
        return EVALUATIONS_PER_DOUBLING * np.log2(n) * (waves + rankine) / len(geometry.images)
    # `bem.panels.reciprocal_pairs` evaluates waves for half of the pairs; factors are in single precision
    factor = _seconds_of_factor(np.float32) * (n / TIMED_UNKNOWNS) ** 3
    return n * (waves / 2 + rankine) + len(geometry.classes) * factor


def _seconds_of_waves(geometry, omega, gravity):
    """Seconds for a row of the wave matrices"""
    g, nodes = geometry, np.arange(len(geometry.elements.nodes))
    some = _timed_rows(g)
    table = wave_table(omega, g.depth, gravity, g.reach, g.draft)
    return _seconds(lambda: wave_blocks(g, some, nodes, table, depth_values(table.k, g.depth))) / len(some)


def _seconds_of_rows(geometry):
    """Seconds for a row of the Rankine matrices"""
    some = _timed_rows(geometry)
    return _seconds(lambda: geometry.rankine_rows(geometry.elements.nodes[some])) / len(some)


def _timed_rows(geometry):
    """Nodes whose rows are timed: enough for several threads, as for all rows"""
    n = len(geometry.elements.nodes)
    rows = max(TIMED_ROWS, int(np.ceil(PAIRS_WORTH_THREADS / (n * len(geometry.images)))))
    return np.arange(0, n, max(n // rows, 1))


def _seconds_of_factor(kind=np.float64):
    from scipy.linalg import lu_factor

    A = np.random.default_rng(0).standard_normal((TIMED_UNKNOWNS, TIMED_UNKNOWNS)).astype(kind)
    return _seconds(lambda: lu_factor(A, check_finite=False))


def _seconds(work):
    """Shortest of `TIMED_RUNS` after a first one, which compiles: other work of the machine disturbs single runs"""
    times = []
    for _ in range(TIMED_RUNS + 1):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times[1:])
