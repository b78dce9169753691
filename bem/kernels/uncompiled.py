"""Kernels that a short job evaluates as the Python they are written in, in place of waiting for numba.

A static line of parts takes 8 ms so, a minute to compile, and half a second to load with numba where it is compiled on
disk.  Kernels of the packages named by `allow` are evaluated for a number of calls, which is the same in every run, and
beyond it, those that are not on disk, until they have taken a number of seconds; from then on each is compiled or
loaded when it is called, as all others are, and what is compiled is kept for later processes.  The functions are the
same ones; sums may differ in their last digit, since compiled ones may contract.

Python raises where compiled code gives NaN or infinity.  A call that does is made again, compiled, with the arrays it
was given as they were.
"""

from __future__ import annotations

import time
from functools import cached_property

import numpy as np

_packages, _calls, _left, _until = (), 0, 0.0, None


def allow(packages, seconds, calls=0):
    """Let kernels of some packages, made from now on, be evaluated uncompiled: for some calls in all, those of kernels
    by kernels among them, and then for some seconds where they are not on disk."""
    global _packages, _calls, _left
    _packages, _calls, _left = tuple(packages), calls, float(seconds)


def may_wait(function):
    """Whether a function is of a package whose kernels may be evaluated uncompiled"""
    return any(function.__module__.startswith(f"{package}.") for package in _packages)


class Waiting:
    """A kernel that is evaluated while that is allowed, and then passes its calls on to numba's.

    py_func : its function; compile() gives numba's dispatcher of it; kept() tells whether some is compiled on disk
    """

    def __init__(self, py_func, compile, kept):
        self.py_func, self._compile, self._kept = py_func, compile, kept
        self.__name__, self.__doc__, self.__module__ = py_func.__name__, py_func.__doc__, py_func.__module__

    def __call__(self, *given):
        if self._may_run():
            done, result = self._evaluated(given)
            if done:
                return result
        self.__class__ = _Compiled
        return self.compiled(*given)

    @cached_property
    def compiled(self):
        return self._compile()

    @cached_property
    def on_disk(self):
        return self._kept()

    @property
    def _numba_type_(self):
        """By which numba knows it in other kernels: the type of its dispatcher"""
        return self.compiled._numba_type_

    def _may_run(self):
        if "compiled" in vars(self):
            return False
        return _calls > 0 or (not self.on_disk and _left > 0 and (_until is None or time.process_time() < _until))

    def _evaluated(self, given):
        """Whether Python could evaluate a call, and its result; the time of the outermost call counts."""
        global _calls, _left, _until
        _calls -= 1
        if _until is not None:
            return True, self.py_func(*given)
        before, _until = _copied(given), time.process_time() + _left
        try:
            with np.errstate(all="ignore"):
                return True, _plain(self.py_func(*given))
        except (ArithmeticError, ValueError):
            _restore(given, before)
            _calls = 0
            _left = 0.0
            return False, None
        finally:
            _left, _until = min(_left, _until - time.process_time()), None


class _Compiled(Waiting):
    def __call__(self, *given):
        return self.compiled(*given)


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
