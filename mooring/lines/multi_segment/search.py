"""Horizontal tension for which a downward traversal of a line ends at its anchor, and all positions of a line.

The contacts of the previous position are tried first.  If these contacts no longer hold, H is searched for coarsely.
Newton's method solves the equations with the contacts that the search found. A traversal with the solved H must end
at the anchor; otherwise the search is repeated with a smaller tolerance.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

from ..catenary.state import BEYOND_REACH, SLACK
from .line_data import HEAP_AT_ANCHOR, HEAP_AT_TOUCHDOWN, PIECE_COLUMNS, TAUT, varied, workspace_for
from .newton import continuation
from .touchdown import GROUNDED_ANCHOR, between
from .traverse import traverse

# results of a search beside `State`: an equilibrium that is not slack; none found, though in reach; one with a heap
# at the bed vertex to which the line slides
SOLVED, LOST, SLIDES = -1, -2, -3
# errors of a search at the anchor, over the length: of a single position first, in a second attempt, and of many
# positions
QUICK, EXACT, ROUGH, COARSE = np.array([1e-2]), np.array([1e-6]), np.array([1e-3]), np.array([1e-3, 1e-6])
CLOSE = 1e-7  # relative distance of starts of spans in the coarsest searches


@kernel()
def horizontal_tension(line, w, x, z, guess, tolerance):
    """Tension H for which no excess length is left at the anchor, bracketed on ln H.

    Where a line slides down to a bed vertex, H is at least the value for which the line has no tension at the vertex.
    returns : H, state; w holds the traversal, or at least this vertex in w.count
    """
    bottom, start = math.log(line.least), math.log(max(guess, line.least))
    low, high, f_low, f_high = -math.inf, math.inf, math.nan, math.nan
    q, wide, room, foot, passed, step = start, 0.0, 0.0, 0, 0, 0.25
    # the length may jump where a buoy emerges: the contacts on either side are tried before the last bit
    narrow = 1e-5 if tolerance >= COARSE[0] else 1e-11
    for _ in range(200):
        value = traverse(line, w, math.exp(q) if q > bottom else line.least, x, z)
        if q <= bottom:
            if value > 0:
                return line.least, SLACK
            low, f_low = bottom, value
            q = math.log(line.weight) if math.isinf(high) else high - min(2.0, 0.5 * (high - low))
            continue
        slid, narrowed = w.count[0] == 0, high - low <= narrow * max(1.0, abs(q))
        near = abs(value) <= tolerance * line.length
        if value < 0:
            foot = w.count[2]
        if foot > 0 and foot != passed and ((slid and near) or narrowed):
            h = math.exp(q if slid else low)
            if traverse(varied(line, 0.0, foot, line.close), w, h, x, z) > 0:
                w.count[2] = foot
                return h, SLIDES
            passed = foot
            if narrowed:
                return h, LOST
        if narrowed or (near and not slid):
            return math.exp(q), LOST if slid else SOLVED
        if value > 0:
            high, f_high = q, value
        else:
            low, f_low = q, value
        if math.isinf(high):
            q += step
            step = min(2 * step, 2.0)
            if q > max(start, math.log(line.weight)) + 25:
                return math.exp(q), BEYOND_REACH
        elif math.isinf(low):
            # the least tension shows whether a line is slack; it is tried where a little less is not enough
            q = q - step if step < 1.0 and q - step > bottom else bottom
            step *= 2
        elif low == bottom:
            # the excess length depends on ln H only near the root: approach it from above
            q -= 2.0 if q - 2.0 > low else 0.5 * (q - low)
        else:
            wide = wide if wide > 0 else high - low
            room = 0.5 * room if room > 0 else 2 * wide
            q = between(low, high, -f_low, -f_high, wide, room, 2e-16 * max(1.0, abs(q)))
    return math.exp(q), LOST


@kernel()
def solve_positions(line, x, z, guess, capacity, tolerances):
    """Positions (n,) one after another.

    guess : initial H, N; capacity : largest number of pieces of the line; tolerances : `QUICK` to `COARSE`
    returns : results (n, 11), see `newton.store`; states (n,); pieces and states of the point loads at the last
        position
    """
    found, status = np.zeros((x.size, 11)), np.full(x.size, LOST)
    found[:, 9] = math.inf
    pieces, w = np.empty((capacity, PIECE_COLUMNS)), workspace_for(line)
    done = np.int64(0)
    while done < x.size:
        after, state = solve_some(line, w, x, z, done, guess, pieces, found, tolerances)
        if state == SOLVED and found[after - 1, 0] > 0:
            guess = found[after - 1, 0]
        after = max(after, done + 1)
        for i in range(done, after):
            status[i] = state
        done = after
    return found, status, pieces[: int(found[-1, 10])], w.states


@kernel()
def solve_some(line, w, x, z, first, guess, pieces, found, tolerances):
    """Solve one position and the following positions with the same contacts. returns : number of the next position,
    state
    """
    for tolerance in tolerances:
        close = CLOSE if tolerance >= COARSE[0] else 0.0
        line = varied(line, line.heap, line.foot, close)
        guess, state = horizontal_tension(line, w, x[first], z[first], guess, tolerance)
        if state == SLIDES:
            fill_heap(line, w, w.count[2], guess, x[first], z[first], tolerance)
        elif state == BEYOND_REACH or state == LOST or w.count[0] == 0:  # noqa: SIM109
            return first, BEYOND_REACH if state == BEYOND_REACH else LOST
        # a span that gets to the anchor's place with some length left over is not slack in that measure
        slack = state == SLACK and (not line.to_place or w.steps[w.count[0] - 1, 0] == GROUNDED_ANCHOR)
        left, after = HEAP_AT_ANCHOR if slack else TAUT, first
        if w.count[0] > 0:
            after = continuation(line, w, x, z, first, left, 0.0, pieces, found)
        if after == first and slack and close == 0.0:
            left, heap = HEAP_AT_TOUCHDOWN, fill_heap(line, w, np.int64(0), line.least, x[first], z[first], 1e-15)
            if w.count[0] > 0:
                after = continuation(line, w, x, z, first, left, heap, pieces, found)
        if after > first:
            return after, SLACK if slack else SOLVED
        if state == SLACK and close == 0.0:  # whatever the tolerance
            break
    return first, LOST


@kernel()
def fill_heap(line, w, foot, horizontal, x, z, tolerance):
    """Length in a heap, m, where a sliding line first touches the bed, or above the bed vertex `foot`.

    tolerance : tolerance of the line's length; w : left with the traversal; without steps where no traversal was found
    """
    low, high, f_low, f_high = 0.0, line.length, math.nan, math.nan
    room = 2 * line.length
    while high - low > tolerance * line.length:
        heap = between(low, high, f_low, f_high, line.length, room, 2e-16 * line.length)
        room *= 0.5
        value = traverse(varied(line, heap, foot, line.close), w, horizontal, x, z)
        if value > 0:
            low, f_low = heap, value
        else:  # nan: too much, all the line is in the heap
            high, f_high = heap, value
    traverse(varied(line, low, foot, line.close), w, horizontal, x, z)
    return low
