"""One job of a bench: a process with its threads, its caches and its peak memory, and the error of its result."""

import json
import math
import os
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .cases import CASES, DENSITY, GRAVITY, HEADING
from .references import Coefficients, error

PEERS = Path(__file__).parent / "peers"
SCRIPTS = {"capytaine": PEERS / "capytaine_job.py", "pyhams": PEERS / "hams_job.py"}
PASSES, MORE = 3, 2.0  # passes, and more until this time in s has passed
SECONDS, LONGEST = 10.0, 300.0  # no new pass after this time in s; a process is ended after this time
THREADS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")


class Row(NamedTuple):
    """Measurements of one job; error NaN and a note if it failed

    error : relative error of the worst coefficient; estimate : error estimated by the program itself
    warm_ms : per frequency; cpu_ms : the same in processor time of all threads
    body_ms : time of a body and its first frequency, with all code loaded; first_s : this time from the start of the
        process
    load : load of the machine in the minute before
    """

    case: str
    program: str
    settings: str
    fineness: float
    panels: int | None
    threads: int
    cache: str
    error: float = math.nan
    worst: str = ""
    estimate: float = math.nan
    warm_ms: float = math.nan
    cpu_ms: float = math.nan
    body_ms: float = math.nan
    first_s: float = math.nan
    estimating_ms: float = math.nan
    memory_mb: float = math.nan
    passes: int = 0
    load: float = math.nan
    note: str = ""


def measured(job, pythons, caches):
    """`Row` of a `Job`; if the program fails, `note` has the cause.

    pythons : {program: interpreter}; caches : folder for files that programs keep on disk, None for their usual
        folders
    """
    question, panels = _question(job)
    load = _load()
    row = Row(job.case, job.program, job.settings, job.fineness, panels, job.threads,
              "empty" if job.empty_cache else "full", load=load)  # fmt: skip
    try:
        found = _answer(job, question, pythons[job.program], _cache(job, caches))
        worst = error(CASES[job.case], _coefficients(found))
    except (_Failed, ValueError) as fault:
        return row._replace(note=" ".join(str(fault).split())[-200:])
    kept = {name: found[name] for name in Row._fields if name in found and found[name] is not None}
    return row._replace(error=worst.value, worst=worst.of, **kept)


class _Failed(Exception):
    """A program ended without an answer"""


def _question(job):
    """Return (input of the script, panels on the whole hull)"""
    case = CASES[job.case]
    passes, more = (1, 0.0) if job.empty_cache else (PASSES, MORE)
    common = {"omega": case.omega, "passes": passes, "more_s": more, "seconds": SECONDS}
    if job.program == "hakobune":
        key, value = ("tolerance", job.fineness) if job.fineness < 1 else ("panels", int(job.fineness))
        return {**common, "case": case.name, key: value, **job.options}, None
    from .meshes import part

    options = dict(job.options)
    mesh = part(case, job.fineness, options.pop("graded"), options.pop("symmetry"))
    water = {"depth": case.depth, "density": DENSITY, "gravity": GRAVITY, "heading": math.radians(HEADING)}
    panels = mesh.pop("panels")
    return {**common, **water, **mesh, **options}, panels


def _cache(job, caches):
    """Environment variables for the place where a program keeps compiled or tabulated data"""
    if caches is None:
        return {}
    method = job.settings if job.program == "hakobune" else ""
    folder = caches / "-".join(filter(None, (job.program, method, "empty" * job.empty_cache)))
    folder.mkdir(exist_ok=True)
    return dict.fromkeys(("HAKOBUNE_CACHE", "CAPYTAINE_CACHE_DIR"), str(folder))


def _answer(job, question, python, cache):
    command = [python, "-m", "hakobune.pipelines.validation.bench.ours"]
    if job.program != "hakobune":
        command = [python, "-W", "ignore", SCRIPTS[job.program]]
    environment = {**os.environ, **dict.fromkeys(THREADS, str(job.threads)), **cache}
    try:
        done = subprocess.run(
            list(map(str, command)),
            input=json.dumps({**question, "started": time.time()}),
            capture_output=True,
            text=True,
            env=environment,
            timeout=LONGEST,
        )
    except subprocess.TimeoutExpired:
        raise _Failed(f"took longer than {LONGEST:g} s") from None
    if done.returncode:
        raise _Failed((done.stderr.strip() or f"ended with status {done.returncode}").splitlines()[-1])
    try:
        return json.loads(done.stdout.splitlines()[-1])
    except (IndexError, json.JSONDecodeError):
        raise _Failed("gave no answer") from None


def _coefficients(found):
    real, imaginary = map(np.array, found["X"])
    return Coefficients(np.array(found["A"]), np.array(found["B"]), real + 1j * imaginary)


def _load():
    try:
        return os.getloadavg()[0]
    except (OSError, AttributeError):
        return math.nan


def peers_of(python):
    """{program: version} of the peers installed for an interpreter. Raises ValueError if there is none, or no such
    interpreter.
    """
    code = (
        "import importlib.metadata as m\n"
        "for name in ('capytaine', 'pyhams'):\n"
        "    try: print(name, m.version(name))\n"
        "    except m.PackageNotFoundError: pass"
    )
    try:
        done = subprocess.run([str(python), "-c", code], capture_output=True, text=True, check=True, timeout=60)
    except (OSError, subprocess.SubprocessError) as fault:
        raise ValueError(
            f"--peer {python} is not an interpreter of Python that runs ({fault}); `make bench` makes one"
        ) from None
    found = dict(line.split() for line in done.stdout.splitlines())
    if not found:
        raise ValueError(f"--peer {python} has neither capytaine nor pyhams; `make bench` installs them")
    return found
