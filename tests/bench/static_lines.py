"""Static lines: none unsolved of many, time per solve, and beside MoorPy and a 40-digit solution.

    python tests/bench/static_lines.py [--lines 100000] [--peer /path/to/python]

`--peer` is a Python with MoorPy 1.3.0 and mpmath, in an environment of its own; without it that part is left out.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.state import State
from hakobune.mooring.lines.multi_segment.line import Bed, LineError, PointLoad, Segment, StaticLine

PEER = r"""
import sys, time, warnings, io, contextlib
import numpy as np, mpmath as mp
from moorpy.Catenary import catenary
warnings.filterwarnings("ignore")
mp.mp.dps = 40
data = np.load(sys.argv[1])
lines, ours, count = data["lines"], data["ours"], int(data["exact"])

def exact(row, status, H, S):
    x, z, L, w, EA, mu, slope = map(mp.mpf, row)
    t, c = mp.tan(slope), mp.cos(slope)
    rate = w * (mp.sin(slope) + mu * c)
    def gap(H, S):
        low = H * t if status == 1 else None
        if status == 1:
            V0, free, lying = H * t, S, L - S
        else:
            V0, free, lying = S, L, mp.mpf(0)
        V = V0 + w * free
        X = H * free / EA + H / w * (mp.asinh(V / H) - mp.asinh(V0 / H))
        Z = (V * V - V0 * V0) / (2 * w * EA) + (mp.sqrt(H * H + V * V) - mp.sqrt(H * H + V0 * V0)) / w
        T = H / c
        pulled = min(lying, T / rate) if rate > 0 else lying
        along = lying + pulled * (T - rate * pulled / 2) / EA
        return X + along * c - x, Z + along * mp.sin(slope) - z
    try:
        return mp.findroot(gap, (mp.mpf(H), mp.mpf(S)), tol=mp.mpf(10) ** -50, maxsteps=30, verify=False), gap
    except ZeroDivisionError:
        return None, gap

worst = mp.mpf(0)
for row, o in list(zip(lines, ours))[:count]:
    if o[2] == 0:
        continue
    root, gap = exact(row, int(o[2]), o[0], o[3])
    H = root[0]
    V = H * mp.tan(row[6]) + mp.mpf(row[3]) * root[1] if o[2] == 1 else root[1] + mp.mpf(row[3]) * mp.mpf(row[2])
    assert max(abs(v) for v in gap(*root)) < mp.mpf(10) ** -25 * mp.mpf(row[2]), row
    T = mp.sqrt(H * H + V * V)
    worst = max(worst, abs(H - o[0]) / T, abs(V - o[1]) / T)
print("worst error of (H, V) over T against 40 digits:", mp.nstr(worst, 3))

wrong = failed = 0
spent = 0.0
for row, o in zip(lines, ours):
    x, z, L, w, EA, mu, slope = row
    sink = io.StringIO()
    start = time.perf_counter()
    try:
        with contextlib.redirect_stdout(sink):
            options = dict(CB=mu, alpha=np.degrees(slope), Tol=1e-9 * max(x, z), MaxIter=100)
            hA, vA, HF, VF, info = catenary(x, z, L, EA, w, **options)
        HF, VF = abs(HF), abs(VF)
    except Exception:
        failed += 1
        HF = VF = np.nan
    spent += time.perf_counter() - start
    if np.isfinite(HF) and np.hypot(HF - o[0], VF - o[1]) > 1e-3 * np.hypot(o[0], o[1]):
        wrong += 1
print(f"MoorPy: {1e6 * spent / len(lines):.0f} us a line; {failed} failed, {wrong} silently off by over 0.1 %")
"""


def random_lines(n, seed, tilt=0.0):
    """x, z, length, weight, EA, friction, slope; length, weight and stiffness over six decades each."""
    rng = np.random.default_rng(seed)
    length, weight = 10 ** rng.uniform(-1, 5, n), 10 ** rng.uniform(-1, 5, n)
    stiffness = weight * length * 10 ** rng.uniform(-1, 5, n)
    reach, angle = length * rng.uniform(0, 1.2, n), rng.uniform(0, np.pi / 2, n)
    slope = rng.uniform(-tilt, tilt, n)
    x = reach * np.cos(angle)
    z = np.maximum(reach * np.sin(angle), x * np.tan(slope) + 1e-3 * length)
    return np.column_stack([x, z, length, weight, stiffness, rng.choice([0.0, 0.3, 1.0], n), slope])


def least_time(work, runs=5):
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def many(count):
    for tilt in (0.0, 0.3):
        lines = random_lines(count, 1, tilt)
        found = solve_lines(*lines.T)  # raises where a fairlead is missed
        states = {State(int(k)).name: int(np.sum(found.status == k)) for k in np.unique(found.status)}
        spent = 1e6 * least_time(lambda lines=lines: solve_lines(*lines.T)) / count
        print(f"{count} random lines, slopes up to {tilt:g}: {states}")
        print(f"  {spent:.2f} us a line in a batch, least of 5 runs")


def composite():
    """Five lines of several segments with a clump and a buoy: residual, time, and the same line cut finer."""
    chain, rope = Segment(150.0, 1000.0, 5e8), Segment(120.0, 200.0, 8e7)
    cases = {
        "two segments": ([chain, rope], [], 245.0),
        "clump": ([chain, rope], [PointLoad(170.0, 2e4)], 245.0),
        "buoy": ([chain, rope], [PointLoad(200.0, -2e4)], 245.0),
        "clump and buoy": ([chain, rope, chain], [PointLoad(160.0, 3e4), PointLoad(300.0, -3e4)], 385.0),
        "lifted": ([chain, rope], [PointLoad(150.0, 1e4)], 259.0),
    }
    for name, (segments, loads, x) in cases.items():
        line = StaticLine(segments, loads, Bed.sloping(0.0, 0.5))
        found = line.solve(x, 80.0)
        halves = [Segment(s.length / 2, s.weight, s.axial_stiffness) for s in segments for _ in (0, 1)]
        finer = StaticLine(halves, loads, Bed.sloping(0.0, 0.5)).solve(x, 80.0)
        change = abs(found.tension_fairlead / finer.tension_fairlead - 1)
        xs = np.linspace(x - 2, x, 200)
        spent = 1e6 * least_time(lambda line=line, xs=xs: line.solve(xs, 80.0)) / 200
        print(
            f"{name}: T {found.tension_fairlead:.10g} N, residual {found.residual:.1g}, cut in halves {change:.1g}, "
            f"{spent:.0f} us a position"
        )


def uneven(count):
    """Random lines with a sinker, a buoy and sometimes a third load over random beds: which are not found."""
    rng = np.random.default_rng(7)
    lost = []
    for number in range(count):
        facets = rng.integers(1, 5)
        bx = np.cumsum(np.append(0.0, rng.uniform(10, 40, facets)))
        bz = np.append(0.0, rng.uniform(-8, 8, facets))
        bed = Bed(np.column_stack([bx, bz]), rng.choice([0.0, 0.3, 0.5, 1.0]))
        x = rng.uniform(0.6, 1.0) * bx[-1]
        z = -float(bed.depth_below(x, 0.0)) + rng.uniform(10, 30)
        length = np.hypot(x, z) * rng.uniform(1.02, 1.3)
        loads = [
            PointLoad(length * rng.uniform(0.2, 0.9), weight) for weight in (rng.uniform(0, 300), -rng.uniform(0, 300))
        ]
        if rng.uniform() < 0.4:
            loads.append(PointLoad(length * rng.uniform(0.1, 0.95), rng.uniform(-300, 300)))
        try:
            StaticLine([Segment(length, 10.0, 1e6)], loads, bed, surface=z + 2).solve(x, z)
        except LineError:
            lost.append(number)
    print(f"{count} lines with sinker and buoy over beds of up to five points: not found, with an error: {lost}")


def beside(python, count):
    for tilt in (0.0, np.radians(15)):
        lines = random_lines(count, 2, tilt)
        found = solve_lines(*lines.T)
        H, V, status = found.horizontal_fairlead, found.vertical_fairlead, found.status
        free = np.where(status == State.GROUNDED, lines[:, 2] - found.grounded_length, found.vertical_anchor)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "lines.npz"
            np.savez(path, lines=lines, ours=np.column_stack([H, V, status, free]), exact=count)
            print(f"{count} lines, slopes up to {np.degrees(tilt):g} degrees:")
            subprocess.run([python, "-c", PEER, str(path)], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lines", type=int, default=100_000)
    parser.add_argument("--peer")
    parser.add_argument("--compare", type=int, default=3000, help="lines given to the peer")
    options = parser.parse_args()
    many(options.lines)
    composite()
    uneven(2000)
    if options.peer:
        beside(options.peer, options.compare)


if __name__ == "__main__":
    main()
