"""Room for a walk down a line, its beginning, and the notes it takes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from .line_data import DERIVATIVE_ROWS, PIECE_COLUMNS, STATE_ROWS, SUBMERGED, H, S, X, Z


class Walk(NamedTuple):
    """Room for a walk, and what it found.

    steps : (…, 3) step, facet or knuckle, point load
    unknowns : (…,) H, V at the fairlead, then starts of spans and s of knuckles
    near : (…,) guesses of the unknowns, nan without; count : (2,) steps and unknowns found
    states, hung : states and weights of the point loads
    q, at : where the walk stands; trial, tried : where a span that is tried stands
    g, rows : without columns or rows, for kernels that also carry derivatives or record
    """

    steps: np.ndarray
    unknowns: np.ndarray
    near: np.ndarray
    count: np.ndarray
    states: np.ndarray
    hung: np.ndarray
    q: np.ndarray
    at: np.ndarray
    trial: np.ndarray
    tried: np.ndarray
    g: np.ndarray
    rows: np.ndarray


def room_for_walk(line):
    """A Walk with room for every contact that a line can have."""
    room = 8 * len(line.bed) + 5 * len(line.loads) + 16
    return Walk(
        np.zeros((room, 3), np.int64),
        np.zeros(room),
        np.full(room, np.nan),
        np.zeros(2, np.int64),
        np.zeros(len(line.loads), np.int64),
        np.zeros(len(line.loads)),
        np.zeros(STATE_ROWS),
        np.zeros(3, np.int64),
        np.zeros(STATE_ROWS),
        np.zeros(3, np.int64),
        np.empty((DERIVATIVE_ROWS, 0)),
        np.empty((0, PIECE_COLUMNS)),
    )


@kernel()
def note_step(w, step, index, load):
    row = w.steps[w.count[0]]
    row[0], row[1], row[2] = step, index, load
    w.count[0] += 1


@kernel()
def note_unknown(w, value):
    w.unknowns[w.count[1]] = value
    w.count[1] += 1


@kernel()
def start_walk(line, w, horizontal, x, z):
    """Stand at the fairlead.  returns : the facet below it; the last one goes on for ever"""
    for i in range(w.q.size):
        w.q[i] = 0.0
    w.q[H], w.q[X], w.q[Z], w.q[S] = horizontal, x, z, line.length
    w.at[0], w.at[1] = line.segments.shape[0] - 1, line.loads.shape[0] - 1
    for load in range(w.states.size):
        w.states[load] = SUBMERGED
    w.count[0], w.count[1], w.unknowns[0] = 0, 1, horizontal
    facet = line.bed.shape[0] - 1
    while facet > 0 and line.bed[facet, 0] >= x:
        facet -= 1
    return facet
