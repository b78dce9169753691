"""What one line, one table query and one system cost, in microseconds of processor time.

    python tests/bench/line_times.py

Least of several runs, after one that compiles: a line from Python and from a kernel, cold and with what the call before
left; a composite line (chain, rope, sinker) at one position with nothing known, and at 200 that follow each other; a
query of its table; the equilibrium of eight lines on a body; a rope of ten free points between two anchors.
"""

import sys
import time
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from systems import eight_lines

from hakobune.bem.kernels.jit import kernel
from hakobune.mooring.lines.catenary.moving_end import pull, workspace
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.uniform import solve_uniform
from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine
from hakobune.mooring.lines.system.composite import of_line
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, CompositeLine, FreePoint, LineType, UniformLine
from hakobune.mooring.motion.force_tables import packed, packed_pull, tabulate

LINE = (560.0, 95.0, 595.0, 1000.0, 5e8)


def least(action, count, runs=7):
    """µs of processor time of one of `count` actions, the least of some runs"""
    action()
    times = []
    for _ in range(runs):
        begun = time.process_time()
        for _ in range(count):
            action()
        times.append(time.process_time() - begun)
    return 1e6 * min(times) / count


@kernel()
def alone(row, line, count):
    for _ in range(count):
        solve_uniform(row, line, True)


@kernel()
def moving(kept, xs, height, length, weight, flexibility):
    total = 0.0
    for x in xs:
        total += pull(kept, x, height, length, weight, flexibility, 0.0)[0]
    return total


@kernel()
def queries(tables, xs, z):
    total = 0.0
    for x in xs:
        total += packed_pull(tables, 0, x, z)[0]
    return total


def ten_points():
    """A chain of eleven parts, with sinkers and buoys in turn, between anchors at the ends"""
    chain, names = LineType("chain", 500.0, 2e8), ["A", *(f"P{i}" for i in range(10)), "B"]
    xs = np.linspace(0.0, 440.0, 12)
    points = [Anchor("A", (0.0, 0.0, -60.0)), Anchor("B", (440.0, 0.0, -60.0))]
    for i, x in enumerate(xs[1:-1]):
        mass, volume = ((4e3, 0.5), (1e3, 6.0))[i % 2]
        points.append(FreePoint(f"P{i}", (x, 3.0 * (-1) ** i, -40.0), mass, volume))
    lines = [UniformLine(f"L{i}", chain, 44.0, a, b) for i, (a, b) in enumerate(pairwise(names))]
    return System(100.0, lines, points)


def main():
    rows = [("one line, from Python", 30, least(lambda: solve_lines(*LINE), 300))]
    row, line = np.zeros(11), (*LINE[:4], 1 / LINE[4], 0.0, 0.0)
    alone(row, line, 1)
    rows.append(("one line, in a kernel", 5, least(lambda: alone(row, line, 1000), 3) / 1000))
    kept, xs = workspace(1)[0][:, 0], np.linspace(559.0, 561.0, 1000)
    rows.append(("the same line moved on", 5, least(lambda: moving(kept, xs, 95.0, *LINE[2:4], 1 / LINE[4]), 3) / 1000))
    parts = (Segment(150.0, 1000.0, 5e8), Segment(120.0, 200.0, 8e7))
    one = StaticLine(parts, (PointLoad(170.0, 2e4),), Bed.sloping(0.0, 0.5))
    rows.append(("composite line, cold, from Python", 50, least(lambda: one.solve(245.0, 80.0), 100)))
    path = np.linspace(243.0, 245.0, 200)
    rows.append(("composite line, of 200 positions", 50, least(lambda: one.solve(path, 80.0), 3) / 200))
    table = packed([tabulate(of_line(CompositeLine("L", parts, "a", "b"), 0, "a", -80.0), np.inf, 245.0, 80.0, (5, 2))])
    xs = np.random.default_rng(1).uniform(241.0, 249.0, 1000)
    rows.append(("table query", 0.2, least(lambda: queries(table, xs, 80.5), 10) / 1000))
    eight, ten = eight_lines(), ten_points()
    rows.append(("equilibrium of eight lines", 300, least(lambda: rest(eight), 30)))
    state = rest(ten)
    rows.append((f"ten free points, {state.iterations} steps", 5000, least(lambda: rest(ten), 5)))
    print("| what | asked µs | µs |")
    print("|---|---|---|")
    for name, asked, spent in rows:
        print(f"| {name} | {asked:g} | {spent:.3g} |")


if __name__ == "__main__":
    main()
