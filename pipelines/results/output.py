"""The place that a result is written to."""

from __future__ import annotations

from hakobune.bem.database.results import has_schema

from ..common.outputs import DATABASE, check_output
from .file import NAMES, schema


def check_result(path, kind, inputs=()):
    """Raise ValueError unless a result of a `kind` can be written to a path.

    inputs : paths of what the study reads, none of which is overwritten
    """
    check_output(
        path,
        f"the result of a {NAMES.get(kind, kind)}",
        lambda place: has_schema(place, schema(kind)),
        DATABASE,
        inputs,
    )
