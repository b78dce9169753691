"""The one way to compile a kernel: numba with a cache that notices every change of any kernel.

numba stamps a cached function with its own file only: a callee edited in another file would go on returning
its old values.  The cache folder therefore carries a hash of all sources of this package.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import numba
from numba.core import config


def _source_hash():
    digest = hashlib.sha256()
    for file in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(file.name.encode() + file.read_bytes())
    return digest.hexdigest()[:16]


def cache_folder():
    """Where compiled kernels are kept; HAKOBUNE_CACHE or XDG_CACHE_HOME move it."""
    base = os.environ.get("HAKOBUNE_CACHE")
    if base is None:
        base = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "hakobune"
    return Path(base) / _source_hash()


_FOLDER = cache_folder()


def kernel(parallel=False):
    """Decorator: compile to machine code on the first call and keep the result on disk."""

    def compile_later(function):
        kept = config.CACHE_DIR
        config.CACHE_DIR = str(_FOLDER)
        try:
            # contract and reassoc only: NaN and infinity must stay visible
            return numba.njit(
                cache=True,
                parallel=parallel,
                error_model="numpy",
                fastmath={"contract", "reassoc"},
                nogil=True,
            )(function)
        finally:
            config.CACHE_DIR = kept

    return compile_later
