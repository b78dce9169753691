"""The pull at the fairlead with which a walk ends at the anchor, and all positions of a line by search and Newton.

The steps of the position before are tried first.  Where they do not hold the pull is searched for coarsely, the
equations of that walk are solved exactly, and a walk with the H found must end at the anchor too; else the search is
made finer.
"""

from __future__ import annotations

import math

import numpy as np

from bem.kernels.jit import kernel

from ..catenary.state import BEYOND_REACH, SLACK
from .line_data import PIECE_COLUMNS
from .newton import follow
from .touch import REST
from .walk import walk
from .walk_storage import room_for_walk

SOLVED, LOST = -1, -2  # what a search says beside `State`: an equilibrium that is not slack, none found in reach
TOLERANCES = (1e-3, 1e-6, 1e-9, 1e-12, 1e-15)  # of the length, left over by the walk of a search


@kernel()
def horizontal_pull(line, w, x, z, guess, tolerance):
    """H at which nothing is left over, bracketed on ln H.  returns : H, state; the walk stands in w"""
    for i in range(w.near.size):
        w.near[i] = math.nan
    bottom, start = math.log(line.least), math.log(guess)
    low, high, f_low, f_high, side = bottom, math.inf, math.nan, math.nan, 0
    q = bottom
    for trial in range(200):
        value = walk(line, w, math.exp(q), x, z)
        if trial == 0:
            if value > 0:
                return line.least, SLACK
            f_low, q = value, start
            continue
        if abs(value) <= tolerance * line.length or high - low <= 1e-15 * max(1.0, abs(q)):
            return math.exp(q), SOLVED
        if value > 0:
            high, f_high = q, value
            f_low = 0.5 * f_low if side == 1 else f_low
            side = 1
        else:
            low, f_low = q, value
            f_high = 0.5 * f_high if side == -1 else f_high
            side = -1
        if math.isinf(high):
            q += 2.0
            if q > start + 25:
                return math.exp(q), BEYOND_REACH
        elif low == bottom:
            # the left-over length moves with ln H only near the root: come down from above
            q -= 2.0 if q - 2.0 > low else 0.5 * (q - low)
        elif trial % 3 == 2 or math.isnan(f_low + f_high):
            q = 0.5 * (low + high)
        else:
            q = low + (high - low) * f_low / (f_low - f_high)
    return math.exp(q), LOST


def solve_positions(line, x, z, guess, room):
    """Positions (n,) one after another.

    guess : H to begin with, N; room : pieces that the line can have
    returns : results (n, 11), see `newton.store`; states (n,); pieces, states of the point loads at the last position
    """
    found, status = np.zeros((len(x), 11)), np.full(len(x), LOST)
    found[:, 9] = math.inf
    pieces, w = np.empty((room, PIECE_COLUMNS)), room_for_walk(line)
    done = 0
    while done < len(x):
        after, state = _solve_some(line, w, x, z, done, guess, pieces, found)
        status[done:after] = SOLVED
        if state != SOLVED:
            status[done] = state
            after = done + 1
        elif found[after - 1, 0] > 0:
            guess = found[after - 1, 0]
        done = after
    return found, status, pieces[: int(found[-1, 10])], w.states


def _solve_some(line, w, x, z, first, guess, pieces, found):
    """Solve one position and those after it that touch in the same way.  returns : the position after, state"""
    for tolerance in TOLERANCES:
        guess, state = horizontal_pull(line, w, x[first], z[first], guess, tolerance)
        if state in (BEYOND_REACH, LOST) or w.count[0] == 0:
            return first, BEYOND_REACH if state == BEYOND_REACH else LOST
        slack = state == SLACK and w.steps[w.count[0] - 1, 0] == REST
        after = follow(line, w, x, z, first, slack, pieces, found)
        if after > first:
            return after, SLACK if slack else SOLVED
    return first, LOST
