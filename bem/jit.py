"""The one way to compile a kernel: numba with a cache that notices every change of any kernel.

numba stamps a cached function with its own file only: a callee edited in another file would go on returning
its old values.  The cache folder therefore carries a hash of all sources beside the kernel and of those of
`bem`.  A kernel calls kernels of these two folders only.
"""

from __future__ import annotations

import hashlib
import os
from functools import cache
from pathlib import Path

import numba
from numba.core import config

HERE = Path(__file__).parent


@cache
def cache_folder(beside=HERE):
    """Where the kernels of the folder `beside` are kept compiled; HAKOBUNE_CACHE or XDG_CACHE_HOME move it."""
    base = os.environ.get("HAKOBUNE_CACHE")
    if base is None:
        base = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "hakobune"
    return Path(base) / _source_hash({HERE, beside})


def _source_hash(folders):
    digest = hashlib.sha256()
    for file in sorted(file for folder in folders for file in folder.glob("*.py")):
        digest.update(file.name.encode() + file.read_bytes())
    return digest.hexdigest()[:16]


def kernel(inline=False):
    """Decorator: compile to machine code on the first call and keep the result on disk.

    Those of `bem` write to arrays that they are given: to make one takes a second to compile, for the message that it
    is too large.  Threads are those of `bem.threads`.
    inline : put into each kernel that calls it, however large; else as the compiler sees fit
    """

    def compile_later(function):
        kept = config.CACHE_DIR
        config.CACHE_DIR = str(cache_folder(Path(function.__code__.co_filename).parent))
        try:
            # contract and reassoc only: NaN and infinity must stay visible
            return numba.njit(
                cache=True,
                forceinline=inline,
                error_model="numpy",
                fastmath={"contract", "reassoc"},
                nogil=True,
            )(function)
        finally:
            config.CACHE_DIR = kept

    return compile_later
