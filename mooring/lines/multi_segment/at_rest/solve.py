"""Lines that no traversal finds: how they come to rest on their bed without friction, which has an equilibrium for all.

Where a line has parts without tension, or a traversal with a given H jumps from one place of the bed to another, the
search from the fairlead down finds nothing.  A chain of many links that falls to rest (`falling_chain`) finds the
parts that lie, hang, are folded or heaped; the equations of those (`equations`) give positions and forces,
contacts that these show to be other ones are put right, and the pieces are judged like those of every line.
A bed with friction holds what lies at rest without it.
"""

from __future__ import annotations

import numpy as np

from .contacts import Contacts
from .equations import Broken, solved
from .falling_chain import FallingChain

LINKS = (200, 160, 300)  # of the chain that falls first, one after another
# of L: links where the contacts of a fallen chain change, one after another; the same again where the chain slid along
FINER = (3e-3, 2e-3, 1e-3, 1e-3, 5e-4, 3e-4, 2e-4, 1e-4, 1e-4, 5e-5, 2e-5)
MOST = 2000  # nodes of a chain: one with more has folded everywhere, and those of lines that were found have 1500
ENDS = {"to_facet": "to_sinker", "off_facet": "off_load"}  # of spans, and those at a sinker
BESIDE = 2e-3  # of L: how far from a sinker a chain has the end of a span that is there
ROUNDING, LEAST = 1e-14, 3e-7  # of L: lengths of pieces that are nothing, and of the shortest beside a load
REPAIRS = 10  # of contacts, of which one or two are usual


def come_to_rest(line, x, z, bears_out):
    """A row of `newton.store`, pieces (n, 11) and states of the point loads, of a StaticLine; None where none is found

    x, z : m, the fairlead; bears_out : pieces, states → whether the pieces are in equilibrium
    """
    for links in LINKS:
        chain = FallingChain(line, x, z, links)
        for size in (None, *FINER):
            if size is not None:
                chain.finer(size)
            if len(chain.s) > MOST:
                break
            contacts = Contacts(chain.fall())
            states = contacts.states()
            for steps, given in _readings(line, contacts):
                try:
                    found = _equilibrium(line, steps, given, states, np.array([x, z]) / line.length, bears_out)
                except np.linalg.LinAlgError:  # a line without stiffness somewhere
                    continue
                if found is not None:
                    return found
    return None


def _readings(line, contacts):
    """Steps and unknowns of contacts, then those with one span that ends at the sinker beside its end"""
    steps, given = contacts.steps, contacts.given
    yield steps, given
    sinkers = [(i, load.position / line.length) for i, load in enumerate(line.loads) if load.weight > 0]
    for k, step in enumerate(steps if contacts.chain.fine else ()):
        for i, s in sinkers if step[0] in ENDS else ():
            if abs(given[k + 1][0] - s) < BESIDE:
                new, force = (ENDS[step[0]], *step[1:], i), [line.loads[i].weight / line.weight]
                unknowns = force if step[0] == "off_facet" else []
                yield [*steps[:k], new, *steps[k + 1 :]], [*given[: k + 1], unknowns, *given[k + 2 :]]


def _equilibrium(line, steps, given, states, end, bears_out):
    states, floats = states
    for _ in range(REPAIRS):
        try:
            with np.errstate(all="ignore"):  # of trials without numbers, which are refused
                e, J = solved(line, steps, given, floats, states, end)
        except Broken:
            return None
        pieces = _pieces(line, e)
        if _is_whole(line, pieces) and bears_out(pieces, np.array(states)):
            return _row(line, e, J, len(pieces)), pieces, np.array(states)
        repaired = _repaired(e)
        if repaired is None:
            return None
        (steps, given), floats = repaired, e.floats
    return None


def _pieces(line, e):
    """Pieces in m and N as `line_data.record` stores them"""
    L, W = line.length, line.weight
    pieces = np.array(e.rows).reshape(len(e.rows), -1)
    on_bed = pieces[:, 0] == 1
    pieces[:, 1:5] *= L
    pieces[:, 5] *= W
    pieces[:, 6] *= np.where(on_bed, W / L, W)
    pieces[:, 7] *= W / L
    pieces[:, 9] /= W
    for load in line.loads:  # the verdict knows loads by their very s
        pieces[np.abs(pieces[:, 1] - load.position) <= 1e-12 * L, 1] = load.position
    return pieces


def _is_whole(line, pieces):
    """Whether the pieces are all of the line, and none beside a load is so short that the load's contact is another"""
    gaps = np.abs(pieces[1:, 1] - (pieces[:-1, 1] - pieces[:-1, 2])).max(initial=0.0)
    ends = abs(pieces[0, 1] - line.length) + abs(pieces[-1, 1] - pieces[-1, 2])
    if not (np.isfinite(pieces).all() and max(gaps, ends) <= 1e-9 * line.length):
        return False
    short = pieces[(pieces[:, 2] > ROUNDING * line.length) & (pieces[:, 2] < LEAST * line.length), 1]
    loads = np.array([load.position for load in line.loads])
    return not (np.abs(short[:, None] - loads) < LEAST * line.length).any()


def _row(line, e, J, count):
    """Results of `newton.store`"""
    L, W, n = line.length, line.weight, e.count
    residual = max(abs(value[0].real) for value in e.residuals)
    by_end = -np.linalg.solve(J[:, :n], J[:, n:])
    stiffness = (W / L * by_end[:2]).ravel()
    H, V = W * np.array(e.given[0])
    return np.array([H, V, W * e.h[0].real, W * e.v[0].real, 0.0, *stiffness, residual, count])


def _repaired(e):
    """Steps and unknowns with the first contact that the solution does not bear out put right; None where all are"""
    for k, step in enumerate(e.steps):
        new = _put_right(e, k, step)
        if new is not None:
            count, steps, given = new
            return e.steps[:k] + steps + e.steps[k + count :], e.given[: k + 1] + given + e.given[k + 1 + count :]
    return None


def _put_right(e, k, step):
    """(steps replaced, new steps, their unknowns) where a step is wrong, else None"""
    if k + 1 < len(e.steps) and abs(e.marks[k + 1] - e.marks[k + 2]) < LEAST:
        merged = _merged(e, k, step, e.steps[k + 1])
        if merged is not None:
            return merged
    if step[0] in ("off_load", "sinker", "to_sinker") and e.normal.get(k, 0.0) < 0:
        return _let_go(e, k, step)
    if step[0] == "to_facet":
        return _land_elsewhere(e, k, *step[1:])
    if step[0] == "off_facet":
        return _leave_over_ridge(e, k, *step[1:])
    if step[0] == "along":
        return _leave_before(e, k, *step[1:])
    if step[0] == "to_vertex":
        return _land_behind(e, k)
    return None


def _merged(e, k, step, after):
    """A load at a vertex in place of one that the line reaches, or leaves, by a span or on a facet of no length"""
    if step[0] == "anew_free" and after[0] == "to_facet":
        return 2, [("anew",)], [[min(np.hypot(*e.given[k + 1]), 1.0)]]
    if step[0] == "off_facet" and after[0] == "to_vertex_sinker":
        return 2, [("along_load", *step[1:], *after[1:])], [[]]
    if step[0] in ("to_facet", "to_sinker") and after[0] == "along_load":
        return 2, [("to_vertex_sinker", *after[3:])], [[]]
    return None


def _following(e, k):
    """Name of the step after step k, and s at its end"""
    return (e.steps[k + 1][0], e.marks[k + 2]) if k + 1 < len(e.steps) else ("", 0.0)


def _land_elsewhere(e, k, facet, way):
    """A span that would touch a facet beyond its ends, or that leaves it before it touches"""
    s, x = e.marks[k + 1], e.places[k + 1][0]
    up, down = (facet + 1, facet) if way > 0 else (facet, facet + 1)
    name, end = _following(e, k)
    if 0 < up < len(e.angles) and (x - e.points[up, 0]) * way > 0:
        if _ridge(e, up):
            return 1, [("to_vertex", up)], [[s]]
        half = 0.2 * abs(x - e.points[up, 0])
        steps = [("to_facet", facet + way, way), ("off_facet", facet + way, way), ("to_facet", facet, way)]
        return 1, steps, [[s + half], [s - half], [s - 3 * half]]
    if name == "along" and end > s and _ridge(e, down):
        return 2, [("to_vertex", down)], [[s]]
    if name == "off_facet" and end > s:
        return 2, [], []
    if name == "end" and s < 0:
        return 2, [("to_anchor",)], [[]]
    return None


def _land_behind(e, k):
    """A span that ends at a ridge so steeply that it touches only the facet behind it, or nothing"""
    s, after = e.marks[k + 1], e.steps[k + 1]
    if after[0] in ("along", "off_facet", "end", "fold"):
        facet, way = after[1:3]
        if _between(e.arrival[k] - e.angles[facet] - _turned(way)) * way > 0:
            return 1, [("to_facet", facet, way)], [[s - 1e-3]]
    if after[0] == "off_vertex" and _between(e.given[k + 2][0] - e.arrival[k]) * np.cos(e.arrival[k]) < 0:
        return 2, [], []
    return None


def _between(angle):
    """An angle between −π and π"""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _leave_over_ridge(e, k, facet, way):
    """A line that would leave a facet beyond its end, and does so at the ridge there"""
    s, x = e.marks[k + 1], e.places[k + 1][0]
    down = facet if way > 0 else facet + 1
    if _ridge(e, down) and (x - e.points[down, 0]) * way < 0:
        return 1, [("along", facet, way, down), ("off_vertex", down)], [[s], [e.angles[facet] + _turned(way)]]
    return None


def _leave_before(e, k, facet, way, vertex):
    """A line that gets to a ridge but would leave it above the facet behind it, or before it is there, or not there"""
    s, (name, end) = e.marks[k + 1], _following(e, k)
    if not _ridge(e, vertex):
        return None
    if name == "off_facet" and end > s:
        return 2, [("off_facet", facet, way)], [[end]]
    if name == "off_vertex":
        angle, beyond = e.given[k + 2][0] - _turned(way), e.angles[facet - way]
        if (angle - e.angles[facet]) * way < 0:
            return 2, [("off_facet", facet, way)], [[s + 1e-3]]
        if (angle - beyond) * way > 0:
            return 2, [("along", facet, way, vertex), ("off_facet", facet - way, way)], [[s], [s - 1e-3]]
    return None


def _turned(way):
    return 0.0 if way > 0 else np.pi


def _ridge(e, vertex):
    slopes = e.line.bed.slopes
    return 0 < vertex < len(slopes) and slopes[vertex] < slopes[vertex - 1]


def _let_go(e, k, step):
    """A sinker hangs that the bed would have to hold down."""
    s = e.marks[k + 1]
    if step[0] == "off_load":
        return 1, [("off_facet", step[1], step[2])], [[s + 1e-3]]
    if step[0] == "sinker":
        return 1, [], []
    return 1, [("to_facet", step[1], step[2])], [[s - 1e-3]]
