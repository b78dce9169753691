"""Pull of one line of a system at rest over its span: X(H) and T(X), for any kind of line.

The end at the anchor is fixed, or end a of a line without an anchor. The other end moves in the line's plane at its own
height, from the position where the line is slack to the position where it carries a given tension.
"""

from typing import NamedTuple

import numpy as np

from .parts import EquilibriumError, LineSystemError

OVER = 4.0  # largest tension over that at rest, without a known breaking load
SLACK = 1e-3  # horizontal pull at the start of the curve, over that at its end
ROUNDS = 60  # halvings, down to rounding


class Characteristic(NamedTuple):
    """All (m,): span m, horizontal pull and tension N at the moving end, length on the bed m

    utilisation : (m,) as in LineForces, nan without a known breaking load; rest : m, span
    """

    span: np.ndarray
    horizontal: np.ndarray
    tension: np.ndarray
    grounded: np.ndarray
    utilisation: np.ndarray
    rest: float


def characteristic(state, name, points=24):
    """Characteristic of the line `name` of a SystemEquilibrium, half of the points in the last tenth of the curve,
    where the line is taut.

    The curve ends where a segment carries its breaking load, or at four times the tension at rest. raises :
    LineSystemError for an unknown name, EquilibriumError for a line without forces
    """
    system = state.system
    if name not in system.line_names:
        raise LineSystemError(f"line {name!r} is unknown; allowed: {', '.join(system.line_names)}")
    number = system.line_names.index(name)
    starts, ends = state.points[system.arrays.ends].swapaxes(0, 1).copy()
    moving, held = (starts, ends) if system.anchored_ends[number] == "b" else (ends, starts)
    way = moving[number, :2] - held[number, :2]
    rest = float(np.hypot(*way))
    way = way / rest if rest > 0 else np.array([1.0, 0.0])

    def pulls(span):
        moving[number, :2] = held[number, :2] + span * way
        found = system.forces_between(starts, ends)
        side = "a" if moving is starts else "b"
        names = f"horizontal_{side}", f"tension_{side}", "grounded_length", "utilisation"
        return [float(getattr(found, what)[number]) for what in names]

    def beyond(span):
        _, tension, _, used = pulls(span)
        return used > 1 if np.isfinite(system.breaking_load[number]) else tension > OVER * state.tension[number]

    top = _where(beyond, rest, system.lines[number].length)
    least = SLACK * pulls(top)[0]
    low = _halved(lambda span: pulls(span)[0] > least, 0.0, top)
    share = np.concatenate([np.linspace(0, 0.9, points // 2, endpoint=False), np.linspace(0.9, 1, -(-points // 2))])
    spans = low + share * (top - low)
    return Characteristic(spans, *np.array([pulls(span) for span in spans]).T, rest)


def _where(beyond, rest, length):
    """Largest span at which the pull is not beyond the requested one"""
    low, high = (0.0, rest) if beyond(rest) else (rest, rest + 1e-3 * length)
    for _ in range(ROUNDS):
        if beyond(high):
            return _halved(beyond, low, high)
        low, high = high, high + 2 * (high - low)
    raise EquilibriumError(f"the line of {length:g} m does not become taut at a span of {high:g} m")


def _halved(beyond, low, high):
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if beyond(middle) else (middle, high)
    return low
