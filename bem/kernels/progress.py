"""How far a long preparation is, told to whoever listens."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar

WAVES, MATRICES, FACTORS = "waves", "matrices", "factors"  # counted in rows, rows, and symmetry classes
_listener = ContextVar("listener", default=None)


@contextmanager
def listening(listener):
    """Context in which listener(stage, count) is called when `count` more of a stage are done; None for nobody"""
    token = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(token)


def done(stage, count):
    """Tell that `count` more of a stage are done"""
    listener = _listener.get()
    if listener:
        listener(stage, count)
