"""A whole bench: one job after the other, written as it goes on."""

from __future__ import annotations

import os
import platform
import sys
import tempfile
from importlib import metadata
from pathlib import Path

from .measure import measured
from .picture import draw
from .tables import per_cent, write_csv, write_page

FILES = ("bench.csv", "bench.md", "bench.png")


def bench(jobs, peers, output, console):
    """Measure every job, write bench.csv, .md and .png into the folder `output`; returns the rows.

    peers : {program: (interpreter, version)} of other programs.  Interrupted, it writes what it has and goes on raising.
    """
    pythons = {"hakobune": sys.executable} | {name: python for name, (python, _) in peers.items()}
    heading, rows = _machine(peers), []
    try:
        with tempfile.TemporaryDirectory(prefix="hakobune-bench-") as caches:
            for job in _to_fill_caches(jobs):
                console.print(f"filling the cache: {job.title}", highlight=False, markup=False)
                measured(job, pythons, caches)
            for i, job in enumerate(jobs):
                rows.append(measured(job, pythons, caches))
                console.print(f"{i + 1}/{len(jobs)} {_told(job, rows[-1])}", highlight=False, markup=False)
                write_csv(output / FILES[0], rows, heading)
    finally:
        if rows:
            _written(output, rows, heading)
    return rows


def _written(output, rows, heading):
    csv, page, picture = (output / name for name in FILES)
    draw(picture, rows, heading[0])
    write_csv(csv, rows, heading)
    write_page(page, rows, heading, picture.name)


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
    return f"{job.title}: {per_cent(row.error)} % ({row.worst}) in {row.warm_ms:.3g} ms, {row.memory_mb:.0f} MB"


def _machine(peers):
    """Lines on what was measured where"""
    versions = ["hakobune " + metadata.version("hakobune"), *(f"{name} {v}" for name, (_, v) in peers.items())]
    load = f", load {os.getloadavg()[0]:.2f} before" if hasattr(os, "getloadavg") else ""
    return [
        f"{_processor()}, {os.cpu_count()} cores{load}",
        ", ".join([*versions, f"Python {platform.python_version()}", *(f"{n} {metadata.version(n)}" for n in ("numpy", "numba"))]),
    ]  # fmt: skip


def _processor():
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()
