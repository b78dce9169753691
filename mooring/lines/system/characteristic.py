"""Pull of one line of a system at rest over its span: X(H) and T(X), for any kind of line.

The anchor is held fixed; a line without an anchor is held at end a. The other end moves in the line's plane at
constant height, from the position where the line is slack to the position where it has a given tension.
"""

from typing import NamedTuple

import numpy as np

from .parts import EquilibriumError, LineSystemError

OVER = 4.0  # largest tension over that at rest, without a known breaking load
SLACK = 1e-3  # horizontal pull at the start of the curve, over that at its end
ROUNDS, CLOSE = 60, 24  # halvings, down to rounding, and to a ten millionth of the first step


class Characteristic(NamedTuple):
    """Arrays (m,): span, m; horizontal pull and tension at the moving end, N; length on the bed, m

    utilisation : (m,) as in LineForces, nan without a known breaking load; rest : span at rest, m
    """

    span: np.ndarray
    horizontal: np.ndarray
    tension: np.ndarray
    grounded: np.ndarray
    utilisation: np.ndarray
    rest: float


def characteristic(state, name, points=24):
    """Characteristic of the line `name` of a SystemEquilibrium.

    Half of the points lie in the last tenth of the curve, where the line is taut.

    The curve ends where a segment carries its breaking load, or at four times the tension at rest. raises :
    LineSystemError for an unknown name, EquilibriumError for a line without forces
    """
    system = state.system
    if name not in system.line_names:
        raise LineSystemError(f"line {name!r} is unknown; allowed: {', '.join(system.line_names)}")
    number = system.line_names.index(name)
    rest, pulls = _drawn(state, number)

    def beyond(span):
        _, tension, _, used, *_ = pulls(span)
        return used > 1 if np.isfinite(system.breaking_load[number]) else tension > OVER * state.tension[number]

    top = _where(beyond, rest, system.lines[number].length)
    least = SLACK * pulls(top)[0]
    low = _halved(lambda span: pulls(span)[0] > least, 0.0, top)
    share = np.concatenate([np.linspace(0, 0.9, points // 2, endpoint=False), np.linspace(0.9, 1, -(-points // 2))])
    spans = low + share * (top - low)
    return Characteristic(spans, *np.array([pulls(span)[:4] for span in spans]).T, rest)


def at_tension(state, number, tension):
    """Forces along the bed and up at the held end, N, and length on the bed, m, when the moving end has `tension`, N.

    A line that already has at least this tension is taken as it is. Raises EquilibriumError as `characteristic` does.
    """
    rest, pulls = _drawn(state, number)
    found = pulls(rest)
    if found[1] < tension:
        found = pulls(_where(lambda span: pulls(span)[1] > tension, rest, state.system.lines[number].length, CLOSE))
    return found[4], -found[5], found[2]


def _drawn(state, number):
    """m, span at rest, and the function of a span that gives N of horizontal pull and tension at the moving end, m on
    the bed, utilisation, and N of horizontal and downward pull at the held end"""
    system = state.system
    starts, ends = state.points[system.arrays.ends].swapaxes(0, 1).copy()
    moving, held = (starts, ends) if system.anchored_ends[number] == "b" else (ends, starts)
    way = moving[number, :2] - held[number, :2]
    rest = float(np.hypot(*way))
    way = way / rest if rest > 0 else np.array([1.0, 0.0])
    side, other = ("a", "b") if moving is starts else ("b", "a")
    names = (f"horizontal_{side}", f"tension_{side}", "grounded_length", "utilisation", f"horizontal_{other}",
             f"vertical_{other}")  # fmt: skip

    def pulls(span):
        moving[number, :2] = held[number, :2] + span * way
        found = system.forces_between(starts, ends)
        return [float(getattr(found, what)[number]) for what in names]

    return rest, pulls


def _where(beyond, rest, length, rounds=ROUNDS):
    """Largest span at which the pull is not beyond the requested one"""
    low, high = (0.0, rest) if beyond(rest) else (rest, rest + 1e-3 * length)
    for _ in range(ROUNDS):
        if beyond(high):
            return _halved(beyond, low, high, rounds)
        low, high = high, high + 2 * (high - low)
    raise EquilibriumError(f"the line of {length:g} m does not become taut at a span of {high:g} m")


def _halved(beyond, low, high, rounds=ROUNDS):
    for _ in range(rounds):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if beyond(middle) else (middle, high)
    return low
