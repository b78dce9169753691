"""Versions of the libraries that results and pictures depend on, and of the code that reads results and draws
pictures."""

import hashlib
from functools import cache
from pathlib import Path

LIBRARIES = ("hakobune", "numpy", "scipy", "numba", "h5py", "matplotlib")
CODE = ("bem", "meshing", "mooring", "pipelines")  # folders with the code behind numbers and pictures of stored results


@cache
def versions():
    """{library: version}"""
    from importlib import metadata

    return {name: metadata.version(name) for name in LIBRARIES}


@cache
def code():
    """Digest of the source files of the packages in `CODE`; changed code draws a page again"""
    from importlib import import_module

    key = hashlib.sha256()
    for name in CODE:
        base = Path(import_module(f"hakobune.{name}").__path__[0])
        for path in sorted(base.rglob("*.py")):
            key.update(f"{name}/{path.relative_to(base).as_posix()}\n".encode() + path.read_bytes())
    return key.hexdigest()
