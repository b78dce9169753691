"""The work that an executor does: one frequency, or one limit of the frequency, of one body.

Everything here can be sent to another process.  A process keeps the geometry of its last body, which is expensive once
and cheap for every later frequency.
"""

import hashlib
from dataclasses import fields, is_dataclass

import numpy as np

from ..printing.timing import phase

_prepared = {}  # hash of the last problem: the problem and its preparation


def solve_one(problem, omega, headings, want, theta):
    """`bem.frequency.solve_frequency` for a problem.

    omega : rad/s; headings : (m,) rad; want : names; theta : (t,) rad, or None
    """
    from hakobune.bem.frequency import solve_frequency

    prepared = _prepare(problem)
    with phase("solve"):
        return solve_frequency(prepared, omega, headings, want, theta)


def limit_one(problem, name):
    """`added_mass_zero` or `added_mass_infinity` (6, 6) of a problem."""
    prepared = _prepare(problem)
    with phase("solve"):
        return prepared.added_mass_limit(name.removeprefix("added_mass_"))


def _prepare(problem):
    from hakobune.bem.methods.panel_problem import prepare

    for known, prepared in _prepared.values():
        if known is problem:  # the process that made it need not compare
            return prepared
    key = _key(problem)
    if key not in _prepared:
        _prepared.clear()
        with phase("preparation"):
            _prepared[key] = problem, prepare(problem)
    return _prepared[key][1]


def _key(problem):
    """Hash of the values of a problem, to the last bit; derived quantities cached in its meshes do not count."""
    digest, left = hashlib.sha256(), [problem]
    while left:  # kind, number of parts and parts of a value; arrays by shape and bytes: their text omits the middle
        value = left.pop()
        if isinstance(value, np.ndarray):
            digest.update(f"{value.dtype.str} {value.shape} ".encode() + value.tobytes())
            continue
        if is_dataclass(value):
            parts = [getattr(value, field.name) for field in fields(value)]
        elif isinstance(value, dict):
            parts = [*value, *value.values()]
        elif isinstance(value, tuple | list):
            parts = value
        else:
            digest.update(f"{value!r} ".encode())
            continue
        digest.update(f"{type(value).__name__} {len(parts)} ".encode())
        left += parts
    return digest.hexdigest()
