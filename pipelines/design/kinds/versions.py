"""Versions of the libraries that results and pictures depend on."""

from __future__ import annotations

from functools import cache

LIBRARIES = ("hakobune", "numpy", "scipy", "numba", "h5py", "matplotlib")


@cache
def versions():
    """{library: version}"""
    from importlib import metadata

    return {name: metadata.version(name) for name in LIBRARIES}
