"""The place that a result is written to."""

from __future__ import annotations

from hakobune.bem.database.results import has_schema

from ..common.outputs import DATABASE, check_output
from ..common.picture import PLOTS, check_picture
from .file import schema


def check_result(path, kind, inputs=()):
    """Raise ValueError unless a result of a `kind` can be written to a path.

    inputs : paths of what the study reads, none of which is overwritten
    """
    check_output(path, "the result of a study", lambda place: has_schema(place, schema(kind)), DATABASE, inputs)


def check_picture_or_result(path, kind, inputs=()):
    """Raise ValueError unless a picture, or a result of a `kind` as its ending says, can be written to a path"""
    if path.suffix.lower() in DATABASE:
        check_result(path, kind, inputs)
    else:
        check_picture(path, (*PLOTS, *DATABASE))


def picture_or_result(result, path, draw):
    """Write a result to a path that ends so, else draw it"""
    if path.suffix.lower() in DATABASE:
        result.write(path)
    else:
        draw()
