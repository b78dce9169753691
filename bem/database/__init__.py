"""The database of a scene: its schema, its HDF5 file, its rows, and interpolation between its frequencies and headings.

The functions of `rows` in DOOR and those of other modules in ELSEWHERE can be imported from here.  They are loaded when
asked for: h5py takes 0.1 s, which `hakobune --help`, needing no more than the names of `schema`, does not have.
"""

from importlib import import_module

DOOR = ("Database", "DatabaseError", "Header", "Row", "create", "open_database", "pending", "row_values", "writing")
ELSEWHERE = {"append": ".storing", "append_limit": ".storing", "Storing": ".storing", "extend": ".widening"}


def __getattr__(name):
    if name not in DOOR and name not in ELSEWHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(ELSEWHERE.get(name, ".rows"), __name__), name)
