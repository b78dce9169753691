"""Frequencies solved once and then again for their times, for scripts that run beside any program.

Only the standard library: the interpreter of this script has the other program and need not have anything else.
"""

import json
import resource
import sys
import time

SETTLE = 0.1  # s; threads of BLAS wait actively for this time, and delay other work where two share a core


def job():
    """The question, from standard input"""
    return json.load(sys.stdin)


def answer(found):
    """Print the answer, as the last line of standard output"""
    print("\n" + json.dumps(found), flush=True)


def repeated(job, make, solve):
    """Results of every frequency, and the least times over several passes.

    job : omega; passes and more_s (after `passes` passes, new passes start until more_s s have gone); seconds (no
        new pass starts after this time); started (s since 1970, before the start of the process)
    make : () → body, everything that no frequency changes; solve : (body, omega) → any result
    returns : (results, {"first_s", "body_ms", "warm_ms", "cpu_ms", "memory_mb", "passes"})

    first_s counts from the start of the process to the end of the first frequency; body_ms is the same once everything
    is loaded.  warm_ms and cpu_ms (of all threads) are means over the other frequencies.
    """
    begun = time.perf_counter()
    results, first_s, body_ms, clocks = [], None, None, []
    while True:
        mark = time.perf_counter()
        body = make()
        row = []
        for i, omega in enumerate(job["omega"]):
            wall, cpu = time.perf_counter(), time.process_time()
            found = solve(body, omega)
            row.append((time.perf_counter() - wall, time.process_time() - cpu))
            if not clocks:
                results.append(found)
            if i == 0:
                first_s = first_s or time.time() - job["started"]
                body_ms = min(body_ms or float("inf"), 1e3 * (time.perf_counter() - mark))
                time.sleep(SETTLE)
        clocks.append(row)
        gone = time.perf_counter() - begun
        if gone > job["seconds"] or (len(clocks) >= job["passes"] and gone > job["more_s"]):
            break
    least = [[min(row[i][k] for row in clocks) for i in range(1, len(job["omega"]))] for k in (0, 1)]
    warm, cpu = (1e3 * sum(values) / len(values) if values else float("nan") for values in least)
    return results, {
        "first_s": first_s,
        "body_ms": body_ms if len(clocks) > 1 else float("nan"),
        "warm_ms": warm,
        "cpu_ms": cpu,
        "memory_mb": peak_memory(),
        "passes": len(clocks),
    }


def peak_memory():
    """Peak memory of this process, MB.

    Linux adds to ru_maxrss the memory that the parent held when it started this process; VmHWM is that of this
    process alone.
    """
    try:
        with open("/proc/self/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024
    except OSError:
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return most / (1024**2 if sys.platform == "darwin" else 1024)
