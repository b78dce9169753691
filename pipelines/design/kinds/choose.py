"""The kind of study in a file."""

from pathlib import Path

from ...common.quantities import StudyError
from ...common.typed import read_toml
from . import breakwater, mooring, single_point

KINDS = {"section": breakwater, "attachment": single_point}  # a table that only this kind has


def kind_of(path):
    """Module of the kind of a study file.  Raises StudyError."""
    raw, _ = read_toml(Path(path), "a study", StudyError)
    return next((kind for table, kind in KINDS.items() if table in raw), mooring)
