"""What a large panel problem will take, said before it starts: memory by counting, time by two short trials."""

from __future__ import annotations

import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...green.tables import wave_table
from ...kernels.progress import FACTORS, MATRICES, WAVES
from ...kernels.threads import PAIRS_WORTH_THREADS
from ...waves import depth_values
from ..wave_influence import wave_blocks
from .equations import parted
from .low_rank_waves import EVERY, Cases

TRIALS, TRIAL_ROWS, TRIAL_SIZE = 3, 16, 1500
OTHER = 400e6  # bytes of the interpreter, its libraries and tables
ALONE = 54  # bytes for a pair of nodes and class: exact matrices, those of the waves, their factors and blocks
TURNED = 100  # bytes for a row of a wedge, a node and class: exact rows, those of the waves, and all harmonics
SPACE = 600  # nodes that stand for all where waves are concerned, a generous guess (`bem.panels.band.low_rank_waves`)


class Cost(NamedTuple):
    """Bytes at the peak, and for each of `bem.kernels.progress` how much there is to do and the seconds that one
    takes.
    """

    memory: float
    stages: dict

    @property
    def seconds(self):
        """Before the first frequency"""
        return sum(count * seconds for count, seconds in self.stages.values())


def cost(geometry, band, gravity):
    """`Cost` of `bem.panels.band.equations.reduced`; arguments as there."""
    n, classes = geometry.hull, len(geometry.classes)
    lid = len(geometry.elements.nodes) - n
    columns = SPACE + 2 * lid
    matrices = 8.0 * classes * (n * n + 2 * n * columns) + 8.0 * n * columns
    rows = 0.0
    for part in parted(geometry, band, gravity):
        cases = Cases(*part, gravity)
        rows += len(cases.wavenumbers) * (len(cases.samples().nodes) / EVERY + SPACE)
    factor = _seconds_of_factor() * ((n / TRIAL_SIZE) ** 3 + 3 * columns * n**2 / TRIAL_SIZE**3)
    stages = {
        WAVES: (rows, _seconds_of_waves(geometry, band[1], gravity)),
        MATRICES: (n + lid, _seconds_of_rows(geometry)),
        FACTORS: (classes, factor),
    }
    return Cost(matrices + OTHER, stages)


def memory_alone(prepared):
    """Bytes at the peak of frequencies that share no work (`bem.panels.one_frequency`, `bem.panels.zero_draft`,
    `bem.panels.revolution_frequency`)
    """
    by_classes = prepared.setup.zero_draft  # the plate is solved by classes, round or not
    g = prepared.geometry if by_classes else prepared.turned
    nodes = float(len(g.elements.nodes))
    if by_classes or not g.wedges:
        return ALONE * len(g.classes) * nodes**2 + OTHER
    return TURNED * len(g.classes) * nodes * len(g.wedges.first) + OTHER


def _seconds_of_waves(geometry, omega, gravity):
    """Seconds for a row of the wave parts"""
    g, nodes = geometry, np.arange(len(geometry.elements.nodes))
    some = _trial_rows(g)
    table = wave_table(omega, g.depth, gravity, g.reach, g.draft)
    return _seconds(lambda: wave_blocks(g, some, nodes, table, depth_values(table.k, g.depth))) / len(some)


def _seconds_of_rows(geometry):
    """Seconds for a row of the exact matrices"""
    some = _trial_rows(geometry)
    return _seconds(lambda: geometry.rankine_rows(geometry.elements.nodes[some])) / len(some)


def _trial_rows(geometry):
    """Nodes whose rows are tried: as many as are shared out among threads, like all rows are"""
    n = len(geometry.elements.nodes)
    rows = max(TRIAL_ROWS, int(np.ceil(PAIRS_WORTH_THREADS / (n * len(geometry.images)))))
    return np.arange(0, n, max(n // rows, 1))


def _seconds_of_factor():
    from scipy.linalg import lu_factor

    A = np.random.default_rng(0).standard_normal((TRIAL_SIZE, TRIAL_SIZE))
    return _seconds(lambda: lu_factor(A, check_finite=False))


def _seconds(work):
    """The shortest of some trials: the first compiles, and the machine has other things to do"""
    times = []
    for _ in range(TRIALS + 1):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times[1:])


def available_memory():
    """Bytes that can be had without swapping, of the machine or of the container that the process is in"""
    import psutil

    return min(float(psutil.virtual_memory().available), _left_to_container())


def _left_to_container(place=Path("/sys/fs/cgroup")):
    """Bytes below the limit of Linux' control group (version 2), its cache of files counted as free; infinite without

    place : where the group of the process is seen from inside a container
    """
    try:
        limit, used = (float((place / name).read_text()) for name in ("memory.max", "memory.current"))
        stat = dict(line.split() for line in (place / "memory.stat").read_text().splitlines())
    except (OSError, ValueError):  # no such group, or its limit is the word "max"
        return np.inf
    return limit - used + float(stat.get("inactive_file", 0)) + float(stat.get("active_file", 0))
