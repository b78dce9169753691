"""The finite-depth Green function: its tables' build time, its time per pair on one thread, and its error.

Times are the least of several runs, on a body 100 × 50 × 10 m in 20 m of water unless said otherwise; errors are
those of tests/published/green_finite_depth.csv.  A folder with an older package `oldbem` may be given to time it in
turn with this one:  python tests/bench/green.py [folder].  What is compiled second in a process was seen to take up
to a tenth longer: compare with the two exchanged.
"""

import sys
import time
from importlib import import_module
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1]), *sys.argv[1:]]

import numpy as np
from published.green_reference import by_frequency, by_table, errors, reference, wave_errors

from hakobune.bem.green.finite_depth import green
from hakobune.bem.green.tables import wave_table, whole_table

G, DEPTH, LENGTH, BEAM, DRAFT = 9.80665, 20.0, 100.0, 50.0, 10.0
REACH = float(np.hypot(LENGTH, BEAM))
ACCURACIES = (1e-4, 1e-5, 1e-6, 1e-8)
KH = (0.05, 0.5, 2.0, 10.0, 50.0)


def frequency(kh, depth=DEPTH):
    return float(np.sqrt(G * kh / depth * np.tanh(kh)))


PACKAGES = ["oldbem.green", "hakobune.bem.green"] if len(sys.argv) > 1 else ["hakobune.bem.green"]


def least(*actions, times=30):
    """Least seconds of each, taken in turn"""
    best = np.full(len(actions), np.inf)
    for _ in range(times):
        for n, action in enumerate(actions):
            start = time.perf_counter()
            action()
            best[n] = min(best[n], time.perf_counter() - start)
    return best


def maker(package, name):
    return getattr(import_module(f"{package}.tables"), name)


def builds():
    print("build of one table, ms")
    makers = [(p, lambda w, p=p: maker(p, "wave_table")(w, DEPTH, G, REACH, DRAFT)) for p in PACKAGES]
    for accuracy in (1e-6, 1e-8):
        makers.append((f"{accuracy:g}", lambda w, a=accuracy: wave_table(w, DEPTH, G, REACH, DRAFT, a)))
    makers.append(("any pair", lambda w: whole_table.__wrapped__(w, DEPTH, G)))
    print("   kh  " + "".join(f"{name:>10}" for name, _ in makers) + "   pieces at 1e-5, 1e-8")
    for kh in KH:
        w = frequency(kh)
        times = [least(lambda make=make, w=w: make(w))[0] for _, make in makers]
        sizes = [len(wave_table(w, DEPTH, G, REACH, DRAFT, a).pieces) for a in (1e-5, 1e-8)]
        print(f"{kh:6g} " + "".join(f"{1e3 * t:10.2f}" for t in times), "  ", *sizes)


def cloud(n=20_000, seed=2):
    """Random pairs of a body."""
    rng = np.random.default_rng(seed)
    a, b = (rng.random((2, n, 3)) - [0.5, 0.5, 1.0]) * [LENGTH, BEAM, DRAFT]
    return np.hypot(*(a - b)[:, :2].T), a[:, 2].copy(), b[:, 2].copy()


def far(n=20_000, seed=3):
    """Pairs anywhere in depth, R/h of 1e-3 … 1e3 by equal ratios."""
    rng = np.random.default_rng(seed)
    return DEPTH * 10 ** rng.uniform(-3, 3, n), -DEPTH * rng.random(n), -DEPTH * rng.random(n)


def per_pair(name, settings, pairs, whole):
    """ns of each package"""
    actions = []
    for package in PACKAGES:
        pairs_of, table = import_module(f"{package}.finite_depth").table_pairs, maker(package, name)(*settings)
        actions.append(lambda pairs_of=pairs_of, table=table: pairs_of(table, *pairs, whole))
    times = 1e9 * least(*actions, times=100) / len(pairs[0])
    return "".join(f"{t:9.1f}" for t in times)


def pair_times():
    print(f"ns per pair with gradient, all of G, {' and '.join(PACKAGES)}")
    print("   kh | body 1e-5 | body 1e-8 | body any pair | R/h 1e-3 … 1e3 any pair")
    body, wide = cloud(), far()
    for kh in (*KH, 200.0):
        w = frequency(kh)
        times = [per_pair("wave_table", (w, DEPTH, G, REACH, DRAFT, a), body, False) for a in (1e-5, 1e-8)]
        times += [per_pair("whole_table", (w, DEPTH, G), pairs, True) for pairs in (body, wide)]
        print(f"{kh:6g}", *times, sep=" |")
    print("infinite depth |" + per_pair("whole_table", (frequency(2.0), np.inf, G), body, True))


def report_errors():
    rows = reference()
    found = by_frequency(lambda R, z, zeta, omega, depth: green(R, z, zeta, omega, depth, 1.0), rows)
    value, gradient = errors(found, rows, 1e-4)
    print(
        f"{len(rows)} reference points; any pair: error of G {value.max():.1e}, of its gradient {gradient.max():.1e};"
    )
    print(f"    of G without 1/r and its images relative to it or k {wave_errors(found, rows).max():.1e}")
    for accuracy in ACCURACIES:
        value, gradient = errors(by_frequency(by_table(accuracy), rows), rows, 1.0)
        print(
            f"    table of {accuracy:g}, relative to 1/r at least: G {value.max():.1e}, gradient {gradient.max():.1e}"
        )


if __name__ == "__main__":
    builds()
    pair_times()
    report_errors()
