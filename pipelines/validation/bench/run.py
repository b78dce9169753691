"""A whole bench: one job after another, each written when it is finished."""

import os
import platform
import sys
import tempfile
from importlib import metadata
from pathlib import Path

from ...results.output import write_result
from ..picture import draw
from .found import picture, result_of
from .measure import measured

AGAIN, OURS = 2, 0.9  # times; processor time of one thread over time from which on the core was ours
FILES = ("bench.csv", "bench.png")


def bench(jobs, peers, output, say, own_caches=False):
    """Measure every job, write bench.csv and .png into the folder `output`; returns (Result, rows).

    peers : {program: (interpreter, version)} of other programs
    say : takes each line of progress
    own_caches : whether programs keep files on disk in their usual folders; otherwise in a bench folder that starts
        empty.
    After an interrupt it writes the finished rows and raises the interrupt again.
    """
    pythons = {"hakobune": sys.executable} | {name: python for name, (python, _) in peers.items()}
    machine, rows = _machine(peers), []
    try:
        with tempfile.TemporaryDirectory(prefix="hakobune-bench-") as folder:
            caches = None if own_caches else Path(folder)
            for job in _to_fill_caches(jobs):
                say(f"filling the cache: {job.title}")
                measured(job, pythons, caches)
            for i, job in enumerate(jobs):
                rows.append(_undisturbed(job, pythons, caches))
                say(f"{i + 1}/{len(jobs)} {_told(job, rows[-1])}")
                write_result(result_of(rows, machine), output / FILES[0])
    finally:
        if rows:
            write_result(result_of(rows, machine), output / FILES[0])
            draw(output / FILES[1], *picture(rows, machine))
    return result_of(rows, machine), rows


def _undisturbed(job, pythons, caches):
    """The row of a job, measured again, `AGAIN` times at most, where others had the core for a part of the time"""
    row = measured(job, pythons, caches)
    for _ in range(0 if job.empty_cache or job.threads > 1 else AGAIN):
        if not row.cpu_ms < OURS * row.warm_ms:
            break
        again = measured(job, pythons, caches)
        row = again if again.warm_ms < row.warm_ms else row
    return row


def _to_fill_caches(jobs):
    """The coarsest job of every program, method and kind of body: it compiles and tabulates what the others load"""
    first = {}
    for job in jobs:
        if not job.empty_cache and job.program != "pyhams":
            method = job.settings if job.program == "hakobune" else ""
            first.setdefault((job.program, method, job.case.split("-")[0] if method else ""), job)
    return first.values()


def _told(job, row):
    if row.note:
        return f"{job.title}: failed, {row.note}"
    return f"{job.title}: {row.error:.1e} ({row.worst}) in {row.warm_ms:.3g} ms, {row.memory_mb:.0f} MB"


def _machine(peers):
    """Lines on what was measured where"""
    load = f", load {os.getloadavg()[0]:.2f} before" if hasattr(os, "getloadavg") else ""
    versions = [f"{name} {metadata.version(name)}" for name in ("hakobune", "numpy", "numba")]
    versions += [f"Python {platform.python_version()}", *(f"{name} {version}" for name, (_, version) in peers.items())]
    return [f"{_processor()}, {os.cpu_count()} cores{load}", ", ".join(versions)]


def _processor():
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()
