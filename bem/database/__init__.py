"""Database of a scene: schema, HDF5 file, rows, and interpolation between stored frequencies and headings.

DOOR names the functions of `rows` that can be imported from here, and ELSEWHERE those of other modules. They are
loaded on first use: h5py takes 0.1 s, too long for `hakobune --help`, which needs only the names of `schema`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .rows import Database as Database
    from .rows import DatabaseError as DatabaseError
    from .rows import Header as Header
    from .rows import Row as Row
    from .rows import create as create
    from .rows import open_database as open_database
    from .rows import pending as pending
    from .rows import row_values as row_values
    from .rows import writing as writing
    from .storing import Storing as Storing
    from .storing import append as append
    from .storing import append_limit as append_limit
    from .widening import extend as extend

DOOR = ("Database", "DatabaseError", "Header", "Row", "create", "open_database", "pending", "row_values", "writing")
ELSEWHERE = {"append": ".storing", "append_limit": ".storing", "Storing": ".storing", "extend": ".widening"}


def __getattr__(name):
    if name not in DOOR and name not in ELSEWHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(ELSEWHERE.get(name, ".rows"), __name__), name)
