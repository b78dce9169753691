"""A second process that compiles kernels of a command (`pipelines.compiling`) while the command begins.

Each process finds on disk what the other has compiled, and waits for what the other is compiling (`bem.kernels.kept`).
"""

import atexit
import os
import subprocess
import sys
from pathlib import Path

from hakobune.bem.kernels.jit import ROOT, cache_folder

_begun = []  # the process that this process has begun; one is enough


def begin_beside(command, source, *words):
    """Start the second process if kernels are missing and there are two processors; it ends with this process.

    source : file, below the root, of the kernels that the command compiles last; words : its files
    """
    try:
        folder = cache_folder(ROOT / source, ROOT)
        there = folder.exists()
        folder.parent.mkdir(parents=True, exist_ok=True)
        if _begun or there or processors() < 2 or not os.access(folder.parent, os.W_OK):
            return
        process = subprocess.Popen(
            [sys.executable, "-m", "hakobune.pipelines.compiling", command, *map(str, words)],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment(),
        )  # fmt: skip
    except OSError:  # then the command compiles alone
        return
    _begun.append(process)
    atexit.register(process.kill)


def processors():
    """Number of processors that this process may use"""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


def environment():
    """Environment in which further processes find this package"""
    root = Path(__file__).parents[2]
    return os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, (str(root), os.environ.get("PYTHONPATH"))))}
