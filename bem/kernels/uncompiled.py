"""Kernels that a short job evaluates as the Python they are written in, where none is compiled on disk yet.

A static line of parts takes 8 ms so, and a minute to compile.  Kernels of the packages named by `allow` are evaluated
until they have taken a number of seconds; from then on each is compiled when it is called, as all others are, and what
is compiled is kept for later processes.  The functions are the same ones; sums may differ in their last digit, since
compiled ones may contract.

Python raises where compiled code gives NaN or infinity.  A call that does is made again, compiled, with the arrays it
was given as they were.
"""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

_packages, _left, _until = (), 0.0, None


def allow(packages, seconds):
    """Let kernels of some packages be evaluated uncompiled for some seconds, in kernels that are made from now on."""
    global _packages, _left
    _packages, _left = tuple(packages), float(seconds)


def may_wait(function, compiled):
    """`compiled`, numba's dispatcher of a function, or the same to be evaluated uncompiled while that is allowed"""
    if any(function.__module__.startswith(f"{package}.") for package in _packages) and hasattr(compiled, "py_func"):
        compiled.__class__ = _kind(type(compiled))
    return compiled


def _kind(base):
    class Waiting(base):
        """A dispatcher that compiles later; it becomes one of numba's own at its first compiled call."""

        missing = False  # on disk, as seen at the first call

        def __call__(self, *given):
            self.missing = self.missing or not _on_disk(self)
            if self.missing and _may_run() and not self.overloads:
                done, result = _evaluated(self, given)
                if done:
                    return result
            self.__class__ = base
            return self(*given)

    return Waiting


def _may_run():
    return _left > 0 and (_until is None or time.process_time() < _until)


def _on_disk(kernel):
    """Whether some kernel of that name and line is in the folder of its module."""
    function = kernel.py_func
    name = f"*.{function.__qualname__}-{function.__code__.co_firstlineno}.py*.nbi"
    return next(Path(kernel.stats.cache_path).glob(name), None) is not None


def _evaluated(kernel, given):
    """Whether Python could evaluate a call, and its result; the time of the outermost call counts."""
    global _left, _until
    if _until is not None:
        return True, kernel.py_func(*given)
    before, _until = _copied(given), time.process_time() + _left
    try:
        with np.errstate(all="ignore"):
            return True, _plain(kernel.py_func(*given))
    except (ArithmeticError, ValueError):
        _restore(given, before)
        _left = 0.0
        return False, None
    finally:
        _left, _until = min(_left, _until - time.process_time()), None


def _copied(value):
    if isinstance(value, tuple):
        return [_copied(part) for part in value]
    return value.copy() if isinstance(value, np.ndarray) else None


def _restore(value, before):
    if isinstance(value, tuple):
        for part, old in zip(value, before, strict=True):
            _restore(part, old)
    elif isinstance(value, np.ndarray) and value.flags.writeable:
        value[...] = before


def _plain(value):
    """Numbers of Python, as compiled code returns them."""
    if isinstance(value, tuple):
        parts = [_plain(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value.item() if isinstance(value, np.generic) else value
