"""Arrays that a traversal of a line works in, and the steps and unknowns that it records."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from .line_data import DERIVATIVE_ROWS, PIECE_COLUMNS, STATE_ROWS, SUBMERGED, H, S, X, Z


class Workspace(NamedTuple):
    """Workspace and result of a traversal.

    steps : (…, 3) step (see `touchdown`), facet or bed vertex, point load
    unknowns : (…,) H, V at the fairlead, then starts of spans and s at bed vertices
    guesses : (…,) of the unknowns, nan without; count : (2,) steps and unknowns found
    states, load_weights : states and weights (N) of the point loads
    q, at : state of the traversal, see `line_data`; trial_q, trial_at : state of a span that is tried
    g, rows : empty, for kernels that can also propagate derivatives or store pieces
    """

    steps: np.ndarray
    unknowns: np.ndarray
    guesses: np.ndarray
    count: np.ndarray
    states: np.ndarray
    load_weights: np.ndarray
    q: np.ndarray
    at: np.ndarray
    trial_q: np.ndarray
    trial_at: np.ndarray
    g: np.ndarray
    rows: np.ndarray


def workspace_for(line):
    """A Workspace large enough for every contact that a line can have."""
    capacity = 8 * len(line.bed) + 5 * len(line.loads) + 16
    return Workspace(
        np.zeros((capacity, 3), np.int64),
        np.zeros(capacity),
        np.full(capacity, np.nan),
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
def add_step(w, step, index, load):
    row = w.steps[w.count[0]]
    row[0], row[1], row[2] = step, index, load
    w.count[0] += 1


@kernel()
def add_unknown(w, value):
    w.unknowns[w.count[1]] = value
    w.count[1] += 1


@kernel()
def start_traverse(line, w, horizontal, x, z):
    """Set the state to that at the fairlead.  returns : the facet below it; the last one has no end"""
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
