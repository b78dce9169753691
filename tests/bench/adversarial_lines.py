"""Static lines that nobody would hang, judged by a residual of their own: right, or refused at once.

    python tests/bench/adversarial_lines.py [--lines 10000] [--seed 1] [--first 0] [--processes 1] [--boundscheck]
    python tests/bench/adversarial_lines.py --usual …

Segments, sinkers, buoys, flat, sloping and broken beds or none, slack and taut, plumb, below a sea surface or not.
The process that solves is watched: no answer within `--patience` seconds is a line that runs for ever.  Answers are
judged by `exact.static_line`.  Counted apart are lines too short for their ends, and those of which a part without
tension lies on a slope steeper than friction holds, where it would slide; these are told of (`StaticSolution.slides`).
None may be wrong, two in a thousand may be refused, none may take longer than 0.1 s.  With `--usual` the lines are
those of `usual_lines`, of which none may be refused.
With `--boundscheck` numba checks every index; the kernels are then compiled anew, into build/bounds.
"""

import argparse
import collections
import itertools
import multiprocessing
import os
import queue
import sys
import threading
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from hakobune.mooring.lines.catenary.state import BeyondReachError, LineError
from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine

LONGEST, REFUSED = 0.1, 2e-3  # s that a line may take, and share of the lines that may be refused


def random_segments(rng):
    count = rng.integers(1, 5)
    length, weight = 10 ** rng.uniform(0.5, 3.0), 10 ** rng.uniform(0, 3.5)
    segments = []
    for part in np.maximum(rng.dirichlet(np.full(count, 2.0)), 1e-3) * length:
        own = weight * 10 ** rng.uniform(-1, 1) if count > 1 else weight
        stiffness = np.inf if rng.random() < 0.2 else weight * length * 10 ** rng.uniform(0, 4)
        segments.append(Segment(float(part), float(own), float(stiffness)))
    return segments


def random_loads(rng, length, weight):
    loads = []
    for _ in range(rng.choice([0, 0, 1, 1, 2, 3])):
        force = weight * 10 ** rng.uniform(-2, 0.3)
        loads.append(PointLoad(float(length * rng.uniform(0.02, 0.98)), float(rng.choice([-1, 1]) * force)))
    return loads


def random_bed(rng, length):
    kind = rng.integers(0, 4)
    if kind == 0:
        return Bed.sloping(0.0, float(rng.choice([0.0, 0.5, 1.0])))
    if kind == 1:
        return Bed.sloping(float(rng.uniform(-0.4, 0.4)), float(rng.choice([0.0, 0.3, 1.0])))
    if kind == 2:
        count = rng.integers(2, 7)
        x = np.concatenate([[0], np.cumsum(rng.uniform(0.05, 0.5, count))]) / (0.35 * count)
        z = np.concatenate([[0], np.cumsum(rng.normal(0, 0.08, count))])
        return Bed(np.column_stack([x, z]) * length, float(rng.choice([0.0, 0.4, 1.0])))
    return None if rng.random() < 0.3 else Bed.sloping()


def random_end(rng, bed, length):
    """Fairlead (x, z), m, above the bed."""
    ranges = ((0.0, 0.5), (0.5, 1.0), (0.9, 1.02), (0.0, 0.0))
    reach = length * rng.uniform(*ranges[rng.choice(4, p=[0.35, 0.4, 0.2, 0.05])])
    angle = rng.uniform(0.02, 0.9) if rng.random() < 0.7 else rng.uniform(0.9, 1.57)
    x, z = reach * np.cos(angle), max(reach * np.sin(angle), 1e-3 * length)
    if bed is None:
        return float(x), float(z)
    floor = -float(bed.depth_below(x, 0.0))
    z = z + floor if floor > 0 or rng.random() < 0.5 else max(z, floor + 1e-3 * length)
    return float(x), float(z if z > floor else floor + 1e-3 * length)


def random_line(rng):
    """A StaticLine and its fairlead (x, z), m."""
    segments = random_segments(rng)
    length = sum(segment.length for segment in segments)
    loads = random_loads(rng, length, sum(segment.length * segment.weight for segment in segments))
    bed = random_bed(rng, length)
    x, z = random_end(rng, bed, length)
    surface = np.inf if rng.random() < 0.5 else z + length * rng.choice([0, 0.02, 0.2])
    return StaticLine(segments, loads, bed, float(surface) if surface > 0 else np.inf), x, z


def verdict(seed, number, made=random_line):
    """(word, faults, seconds) of one line that `made` makes: answered, short, refused, wrong, or slides"""
    from exact.static_line import faults

    line, x, z = made(np.random.default_rng([seed, number]))
    start = time.process_time()
    try:
        found = line.solve(x, z)
    except BeyondReachError:
        return "short", {}, time.process_time() - start
    except LineError as error:
        return "refused", {str(error): 1.0}, time.process_time() - start
    except IndexError as error:  # only with bounds check
        return "beyond its arrays", {str(error): 1.0}, time.process_time() - start
    spent = time.process_time() - start
    wrong = faults(found, sliding=False)
    if wrong:
        return "wrong", wrong, spent
    return "slides" if found.slides else "answered", {}, spent


def work(pipe, seed, first, last, usual):
    from bench.usual_lines import usual_line

    for number in range(20):  # compiles
        verdict(0, number)
    for number in range(first, last):
        pipe.send(number)
        pipe.send(verdict(seed, number, usual_line if usual else random_line))
    pipe.send(None)


def watched(seed, first, last, patience, usual):
    """Yield (number, verdict) of each line; a process that does not answer is ended and another goes on after it."""
    context = multiprocessing.get_context("spawn")
    while first < last:
        here, there = context.Pipe(duplex=False)
        process = context.Process(target=work, args=(there, seed, first, last, usual), daemon=True)
        process.start()
        there.close()
        limit = 600.0  # the first answer waits for the compiler
        try:
            while (number := (here.recv() if here.poll(limit) else -1)) is not None:
                if number < 0 or not here.poll(patience):
                    break
                yield number, here.recv()
                first, limit = number + 1, patience
            else:
                return
        except EOFError:
            pass
        process.kill()
        process.join()
        yield first, ("hung or crashed", {}, patience)
        first += 1


def watched_in_parts(seed, first, last, patience, processes, usual):
    """What `watched` yields, of as many processes at once, in any order."""
    found, ends = queue.SimpleQueue(), np.linspace(first, last, processes + 1).astype(int)

    def follow(part):
        for answer in watched(seed, *part, patience, usual):
            found.put(answer)
        found.put(None)

    for part in itertools.pairwise(ends.tolist()):
        threading.Thread(target=follow, args=(part,), daemon=True).start()
    while processes:
        if (answer := found.get()) is None:
            processes -= 1
        else:
            yield answer


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lines", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--patience", type=float, default=20.0, help="s")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--boundscheck", action="store_true")
    parser.add_argument("--usual", action="store_true", help="lines that one does hang")
    options = parser.parse_args()
    if options.boundscheck:
        os.environ["NUMBA_BOUNDSCHECK"] = "1"
        os.environ["HAKOBUNE_CACHE"] = str(ROOT / "build" / "bounds")
    counts, spent = collections.Counter(), []
    last = options.first + options.lines
    for number, (word, what, seconds) in watched_in_parts(
        options.seed, options.first, last, options.patience, options.processes, options.usual
    ):
        counts[word] += 1
        spent.append(seconds)
        if word not in ("answered", "short", "slides"):
            print(f"line {number}: {word} {what}", flush=True)
    print(", ".join(f"{count} {word}" for word, count in counts.most_common()))
    slow = int(np.sum(np.array(spent) > LONGEST))
    print(
        "ms of processor time a line, 50th, 99th, 99.9th percentile and longest:",
        np.round(1e3 * np.percentile(spent, (50, 99, 99.9, 100)), 2),
        f"{slow} beyond {LONGEST:g} s",
    )
    faulty = counts["wrong"] + counts["beyond its arrays"] + counts["hung or crashed"] + slow
    return 1 if faulty or counts["refused"] > (0 if options.usual else REFUSED * options.lines) else 0


if __name__ == "__main__":
    sys.exit(main())
