"""Warnings that are heard while a study is read or run, as findings of its result."""

from __future__ import annotations

import warnings
from contextlib import contextmanager


@contextmanager
def heard():
    """Context of a list, which gets at its end what was warned of within, a line each, each once"""
    lines = []
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            yield lines
        finally:
            lines += dict.fromkeys(str(warning.message) for warning in said)
