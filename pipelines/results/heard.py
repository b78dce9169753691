"""Warnings during the reading or the run of a study, collected as findings of its result."""

import warnings
from contextlib import contextmanager


@contextmanager
def heard():
    """Context with a list that receives at its end the warnings given within, one line each, without repetition"""
    lines = []
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            yield lines
        finally:
            lines += dict.fromkeys(str(warning.message) for warning in said)
