"""Input of the kernels of a static line, and the state that these kernels integrate along the line.

The line is traversed from the fairlead downwards.  The state q holds H, V, x, z, s, T and φ. H and V are the
components, towards the fairlead and up, of the tension by which the line above pulls the line below. s is the
unstretched length from the anchor; T and the angle φ are for parts on the bed. Row i of g holds the derivatives of
q[i], with a column for each unknown. Four further rows hold the derivatives of a length (LENGTH), of its end (END),
and of two limits of the tension (LOW, HIGH).  `at` holds the segment, the next point load below and the number of
recorded pieces.  A traversal works in the arrays of a Workspace, and records its steps and unknowns there.
"""

import math
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import kernel

# numpy integers: numba compiles a kernel again for every Python integer that is a constant argument
H, V, X, Z, S, T, PHI, LENGTH, END, LOW, HIGH = np.arange(11)
NOTHING = np.int64(-1)
STATE_ROWS, DERIVATIVE_ROWS, PIECE_COLUMNS = 7, 11, 11
SUBMERGED, FLOATING, EMERGED = 0, 1, 2
# excess length of a line: none; in a heap at the anchor; where the line first touches the bed
TAUT, HEAP_AT_ANCHOR, HEAP_AT_TOUCHDOWN = np.arange(3)
STEEP = 1e-12  # excess of a slope over the limit by friction


class LineData(NamedTuple):
    """A line, from the anchor up; lengths m, forces N.

    segments : (n, 2), s of the lower end, m, and weight, N/m; length : m
    first_row : (n+1,), first row of each segment in strain_table : (…, 3), tension from which a row holds, λ, 1/EA
    loads : (m, 3) s, weight under water, weight out of it
    lowest_buoy : index of the first load with negative weight, m if there is none
    surface : z of the sea surface, m; soft : height over which a buoy emerges while states are sought, m
    bed : (k, 4), x and z of the left ends of the facets, starting at the anchor; angle, rad; smallest tangent up to
        this facet
    no_bed : whether the line touches only the anchor
    friction : μ; least : lower limit of the tension of a free span, N
    to_place : whether a traversal ends at the anchor's place, with some length left over; if not, it ends with the
        line
    held : parts that stay on a slope however steep: 0 for none; 1 for a line without tension above a lower buoy; 2
        also for the excess of a slack line at its anchor, including sinkers
    heap : length in a heap, m; the heap lies where the line first touches the bed or, from 1 on, at the bed vertex
        `foot`
    weight : weight of the whole line, N
    close : tolerance of the starts of spans, relative to their size
    kept : (j, 4), rows s₀, s₁, T₀, T₁ from the top down: the tension on the bed kept by friction from the previous
        position
    """

    segments: np.ndarray
    length: float
    first_row: np.ndarray
    strain_table: np.ndarray
    loads: np.ndarray
    lowest_buoy: int
    surface: float
    soft: float
    bed: np.ndarray
    no_bed: bool
    friction: float
    least: float
    to_place: bool
    held: int
    heap: float
    foot: int
    weight: float
    close: float
    kept: np.ndarray


@kernel()
def mix(g, row, a, i, b, j):
    """g[row] = a g[i] + b g[j]; loops, because array expressions cost seconds to compile."""
    for k in range(g.shape[1]):
        g[row, k] = a * g[i, k] + b * g[j, k]


@kernel(inline=True)
def copy_state(q, at, q0, at0):
    for i in range(q0.size):
        q[i] = q0[i]
    for i in range(at0.size):
        at[i] = at0[i]


@kernel(inline=True)
def slides_on(line, facet):
    """Whether a line without tension slides down a facet, away from the fairlead; a line with a history stays."""
    return math.tan(line.bed[facet, 2]) > line.friction + STEEP and line.kept.shape[0] == 0


@kernel(inline=True)
def next_stop(line, at):
    """Length s of the next load or joint below, and whether it is a load; the lowest segment continues below the
    anchor.
    """
    stop, is_load = -np.inf, False
    if at[0] > 0:
        stop = line.segments[at[0], 0]
    if at[1] >= 0 and line.loads[at[1], 0] >= stop:
        stop, is_load = line.loads[at[1], 0], True
    return stop, is_load


@kernel(inline=True)
def strain_row(line, segment, tension, falling):
    """Row of the tension table that holds just below (falling) or just above `tension`."""
    row = line.first_row[segment]
    tension *= 1 - 1e-12 if falling else 1 + 1e-12
    while row + 1 < line.first_row[segment + 1] and line.strain_table[row + 1, 0] <= tension:
        row += 1
    return row


@kernel(inline=True)
def record(rows, at, q, ds, rate, weight, row, angle, on_bed, strain_table):
    """Store a piece: kind (0 free, 1 on the bed), s, ds, x, z, H or T, V or rate, w, λ, 1/EA, β."""
    if at[2] < rows.shape[0]:
        piece = rows[at[2]]
        piece[0], piece[1], piece[2], piece[3], piece[4] = on_bed, q[S], ds, q[X], q[Z]
        piece[5], piece[6] = (q[T], rate) if on_bed else (q[H], q[V])
        piece[7], piece[8], piece[9], piece[10] = weight, strain_table[row, 1], strain_table[row, 2], angle
        at[2] += 1


class Workspace(NamedTuple):
    """Workspace and result of a traversal.

    steps : (…, 3) step (see `touchdown`), facet or bed vertex, point load
    unknowns : (…,), H and V at the fairlead, then the starts of spans, and s at bed vertices
    count : (3,), number of steps, number of unknowns, and bed vertex above which a line without tension slides, 0
        for none
    states, load_weights : states and weights (N) of the point loads
    q, at : state of the traversal, see `line_data`; trial_q, trial_at : state of a span that is tried
    g, rows : empty, for kernels that can also propagate derivatives or store pieces
    """

    steps: np.ndarray
    unknowns: np.ndarray
    count: np.ndarray
    states: np.ndarray
    load_weights: np.ndarray
    q: np.ndarray
    at: np.ndarray
    trial_q: np.ndarray
    trial_at: np.ndarray
    g: np.ndarray
    rows: np.ndarray


@kernel()
def workspace_for(line):
    """A Workspace large enough for every contact that a line can have."""
    capacity = 8 * line.bed.shape[0] + 5 * line.loads.shape[0] + 16
    return Workspace(
        np.zeros((capacity, 3), np.int64),
        np.zeros(capacity),
        np.zeros(3, np.int64),
        np.zeros(line.loads.shape[0], np.int64),
        np.zeros(line.loads.shape[0]),
        np.zeros(STATE_ROWS),
        np.zeros(3, np.int64),
        np.zeros(STATE_ROWS),
        np.zeros(3, np.int64),
        np.empty((DERIVATIVE_ROWS, 0)),
        np.empty((0, PIECE_COLUMNS)),
    )


@kernel()
def varied(line, heap, foot, close):
    """LineData of the same line with a different heap, vertex (`foot`) and accuracy of the starts."""
    return LineData(
        line.segments,
        line.length,
        line.first_row,
        line.strain_table,
        line.loads,
        line.lowest_buoy,
        line.surface,
        line.soft,
        line.bed,
        line.no_bed,
        line.friction,
        line.least,
        line.to_place,
        line.held,
        heap,
        foot,
        line.weight,
        close,
        line.kept,
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
    """Set the state to the state at the fairlead. returns : the facet below the fairlead; the last facet has no end"""
    for i in range(w.q.size):
        w.q[i] = 0.0
    w.q[H], w.q[X], w.q[Z], w.q[S] = horizontal, x, z, line.length
    w.at[0], w.at[1] = line.segments.shape[0] - 1, line.loads.shape[0] - 1
    for load in range(w.states.size):
        w.states[load] = SUBMERGED
    w.count[0], w.count[1], w.count[2], w.unknowns[0] = 0, 1, 0, horizontal
    facet = line.bed.shape[0] - 1
    while facet > 0 and line.bed[facet, 0] >= x:
        facet -= 1
    return facet
