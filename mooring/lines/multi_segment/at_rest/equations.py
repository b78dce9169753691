"""Equations of a line at rest over a bed without friction, whose parts lie and hang in a given order.

From the fairlead down, the line hangs in elastic catenaries (`multi_segment.free_span` has their equations), lies
along facets in either direction, T = T₋ + w sin φ Δs with φ the slope of the facet, larger by π where x grows towards
the anchor, is folded where T = 0, or lies in heaps in hollows.  Each step of that order leaves as many equations as
unknowns.

Derivatives are complex steps: column j of each number has the unknown j moved by 1e-30 i, and its imaginary part over
1e-30 is the derivative without a difference (W. Squire and G. Trapp, SIAM Review 40 (1998) 110).  Lengths over that of
the line, forces over its weight.
"""

from __future__ import annotations

import numpy as np

from ...catenary.state import HEAP

MOVED = 1e-30
PLUMB = 1e-13  # H of a span that stands plumb, which has none: a hundredth of that below which a line is called slack
FLOATING, EMERGED = 1, 2


class Broken(Exception):
    """Steps that a line cannot take."""


class RestEquations:
    """Residuals, pieces and places of a line with the given steps, all of them after `run`

    steps : list of (name, arguments…), see the methods `do_…`; given : as many lists of their unknowns, and before
    them that of H and V at the fairlead; floats : {load: lift over W} of buoys in the surface, unknowns too
    states : of the point loads; end : x, z of the fairlead
    residuals : list of (k+2,) complex, k unknowns, and x and z of the fairlead
    marks, places : s and (x, z) at the end of each step; rows : pieces as `record` has them
    normal, arrival : {step: N over W of the bed on a load}, {step: rad, of a span that ends at a vertex}
    """

    def __init__(self, line, steps, given, floats, states, end):
        self.line, self.steps, self.states = line, steps, states
        L, W = line.length, line.weight
        self.ends = np.concatenate([[0.0], np.cumsum([segment.length for segment in line.segments])]) / L
        self.weights = [segment.weight * L / W for segment in line.segments]
        self.tables = [segment.strain_table * (1 / W, 1.0, W) for segment in line.segments]
        self.loads = [(load.position / L, load.weight / W, load.weight_in_air / W) for load in line.loads]
        self.surface = line.surface / L
        if line.bed is not None:
            self.points, self.angles = line.bed.points / L, np.arctan(line.bed.slopes)
        self.given, self.floats = [list(values) for values in given], dict(floats)
        self.count = sum(map(len, self.given)) + len(self.floats)
        self.zero, self.order, self.residuals, self.rows = np.zeros(self.count + 2, complex), [], [], []
        self.x, self.z = self._moved(end[0], self.count), self._moved(end[1], self.count + 1)
        self.s, self.segment, self.load = self.zero + 1.0, len(self.weights) - 1, len(self.loads) - 1
        self.h = self.v = self.t = self.zero
        self.phi, self.step, self.used = 0.0, 0, 0
        self.marks, self.places, self.normal, self.arrival = [1.0], [(end[0], end[1])], {}, {}

    def run(self):
        """Take the steps; returns itself"""
        self.h, self.v = self._unknown(), self._unknown()
        for number, (name, *arguments) in enumerate(self.steps):
            self.step, self.used = number + 1, 0
            getattr(self, f"do_{name}")(*arguments)
            self.marks.append(self.s[0].real)
            self.places.append((self.x[0].real, self.z[0].real))
        return self

    def _moved(self, value, column):
        out = self.zero + value
        out[column] += 1j * MOVED
        return out

    def _unknown(self):
        """The next unknown of this step"""
        values = self.given[self.step]
        if self.used >= len(values):
            raise Broken
        self.order.append((self.step, self.used))
        self.used += 1
        return self._moved(values[self.used - 1], len(self.order) - 1)

    def _require(self, residual):
        self.residuals.append(residual)

    def height_over(self, facet):
        at = self.points[facet]
        return self.z - at[1] - (self.x - at[0]) * np.tan(self.angles[facet])

    def _weight_of(self, load):
        """N over W of a point load here; a floating buoy is in the surface, with an unknown part of its lift"""
        if self.states[load] == FLOATING:
            if load not in self.floats:
                raise Broken
            self.order.append((None, load))
            self._require(self.z - self.surface)
            return self._moved(self.floats[load], len(self.order) - 1)
        return self.zero + self.loads[load][2 if self.states[load] == EMERGED else 1]

    def _pass(self):
        """Weight of the next load below, which is passed"""
        self.load -= 1
        if self.load < -1:
            raise Broken
        return self._weight_of(self.load + 1)

    def _record(self, on_bed, ds, first, second, factor, flexibility, angle):
        if ds[0].real > 0:
            state = self.s[0].real, ds[0].real, self.x[0].real, self.z[0].real, first[0].real, second[0].real
            self.rows.append((on_bed, *state, self.weights[self.segment], factor, flexibility, angle))

    def _march(self, target, how, last=-1):
        """Go down to s = `target` by pieces of the kind `how`; loads on the way are passed, not the load `last`."""
        for _ in range(1000):
            stop, is_load = self.ends[self.segment] if self.segment > 0 else -np.inf, False
            if 0 <= self.load != last and self.loads[self.load][0] >= stop:
                stop, is_load = self.loads[self.load][0], True
            ends = not target[0].real < stop
            ds = self.s - (target if ends else stop)
            if how(ds):
                continue
            self.s = target if ends else self.zero + stop
            if ends:
                return
            if not is_load:
                self.segment -= 1
            elif how == self._lie:
                self.t = self.t - self._pass() * np.sin(self.phi)
            elif how == self._hang:
                self.v = self.v - self._pass()
            else:
                self._pass()
        raise Broken

    def _hang(self, ds):
        """A free piece.  returns : whether it is shorter than ds, because the table of strains has another row"""
        row, reach = self._row(self.h[0].real, self.v[0].real)
        # where the row changes the strain does not: the derivative of that place does not matter
        ds, cut = (self.zero + reach, True) if reach < ds[0].real else (ds, False)
        weight, (_, factor, flexibility) = self.weights[self.segment], self.tables[self.segment][row]
        self._record(0, ds, self.h, self.v, factor, flexibility, 0.0)
        h, v, low = self.h, self.v, self.v - weight * ds
        upper, lower = _hypot(h, v), _hypot(h, low)
        mean = (v + low) / (upper + lower)
        # V₋ + T₋ of the end that points up, or of the other end with both turned, without cancellation
        way, end, size = (1, low, lower) if mean[0].real >= 0 else (-1, -v, upper)
        base = end + size if end[0].real >= 0 else h * h / (size - end)
        self.x = self.x - h * (flexibility * ds + factor * _log1p(weight * ds * (1 + way * mean) / base) / weight)
        self.z = self.z - ds * (0.5 * flexibility * (v + low) + factor * mean)
        self.v, self.s = low, self.s - ds
        return cut

    def _row(self, h, v):
        """Row of the table of strains that holds below here on a free piece, and the length for which it does"""
        table, weight = self.tables[self.segment], self.weights[self.segment]
        tension = np.hypot(h, v) * (1 - 1e-12 if v > 0 else 1 + 1e-12)
        row = max(int(np.searchsorted(table[:, 0], tension, side="right")) - 1, 0)
        if v > 0 and table[row, 0] > abs(h):
            return row, max(v - np.sqrt(table[row, 0] ** 2 - h * h), 0.0) / weight
        if row + 1 == len(table) or table[row + 1, 0] <= abs(h):
            return row, np.inf
        return row, max(v + np.sqrt(table[row + 1, 0] ** 2 - h * h), 0.0) / weight

    def _lie(self, ds):
        """A piece on the bed; returns as `_hang`"""
        weight, table, t = self.weights[self.segment], self.tables[self.segment], self.t[0].real
        rate = weight * np.sin(self.phi)
        tension = t * (1 - 1e-12 if rate > 0 else 1 + 1e-12)
        row = max(int(np.searchsorted(table[:, 0], tension, side="right")) - 1, 0)
        reach = np.inf
        if rate > 0 and row > 0:
            reach = (t - table[row, 0]) / rate
        elif rate < 0 and row + 1 < len(table):
            reach = (t - table[row + 1, 0]) / rate
        ds, cut = (self.zero + reach, True) if reach < ds[0].real else (ds, False)
        _, factor, flexibility = table[row]
        self._record(1, ds, self.t, self.zero + rate, factor, flexibility, self.phi)
        moved = ds * (factor + flexibility * (self.t - 0.5 * rate * ds))
        self.x, self.z = self.x - moved * np.cos(self.phi), self.z - moved * np.sin(self.phi)
        self.t, self.s = self.t - rate * ds, self.s - ds
        return cut

    def _heap(self, ds):
        """A piece in a heap"""
        self._record(1, ds, self.zero, self.zero, HEAP, 0.0, 0.0)
        self.s = self.s - ds
        return False

    def _lay(self, facet, way):
        self.phi = self.angles[facet] + (0.0 if way > 0 else np.pi)

    def _rise(self, phi):
        self.h, self.v = self.t * np.cos(phi), self.t * np.sin(phi)

    def _pull_along(self, facet, way):
        """T on the facet of a line that comes down on it"""
        angle = self.angles[facet]
        self.t = way * (self.h * np.cos(angle) + self.v * np.sin(angle))

    def _push(self, facet, load):
        """The bed carries a load with an unknown force normal to the facet, and a free span begins below it."""
        force, angle = self._unknown(), self.angles[facet]
        self.normal[self.step - 1] = force[0].real
        self.h = self.h - force * np.sin(angle)
        self.v = self.v + force * np.cos(angle) - self._pass()

    def _at(self, vertex):
        self._require(self.x - self.points[vertex, 0])
        self._require(self.z - self.points[vertex, 1])
        self._put(vertex)

    def _put(self, vertex):
        self.x, self.z = self.zero + self.points[vertex, 0], self.zero + self.points[vertex, 1]

    def _load_at(self, load):
        return self.zero + self.loads[load][0]

    # free spans

    def do_to_facet(self, facet, way):
        """To a facet, which it touches; then it lies in the direction `way`, 1 towards smaller x."""
        self._march(self._unknown(), self._hang)
        angle = self.angles[facet]
        self._require(self.height_over(facet))
        self._require(self.v * np.cos(angle) - self.h * np.sin(angle))
        self._pull_along(facet, way)

    def do_to_sinker(self, facet, way, load):
        """To a sinker on a facet, below which it lies."""
        self._march(self._load_at(load), self._hang, load)
        self._require(self.height_over(facet))
        angle = self.angles[facet]
        self.v = self.v - self._pass()
        self.normal[self.step - 1] = float((self.h * np.sin(angle) - self.v * np.cos(angle))[0].real)
        self._pull_along(facet, way)

    def do_sinker(self, facet, load):
        """To a sinker on a facet, below which it hangs again."""
        self._march(self._load_at(load), self._hang, load)
        self._require(self.height_over(facet))
        self._push(facet, load)

    def do_to_vertex(self, vertex):
        """To a vertex, over which it bends."""
        self._march(self._unknown(), self._hang)
        self._at(vertex)
        self.t = _hypot(self.h, self.v)
        self.arrival[self.step - 1] = float(np.arctan2(self.v[0].real, self.h[0].real))

    def do_to_vertex_sinker(self, vertex, load):
        """To a sinker at a vertex: `anew` or `anew_free` comes next."""
        self._march(self._load_at(load), self._hang, load)
        self._at(vertex)
        self._pass()

    def do_anew(self):
        """Below a load that a vertex carries the tension is another."""
        self.t = self._unknown()

    def do_anew_free(self):
        """The same where the line hangs below it."""
        self.h, self.v = self._unknown(), self._unknown()

    def do_plumb(self, vertex, held):
        """Out of a heap, or up from a load in one (`held`), plumb over it, and back into it."""
        self._stand(held)
        self._march(self._unknown(), self._hang)
        self._require(self.z - self.points[vertex, 1])
        self._require(self.v)
        self._put(vertex)
        self.t = self.zero

    def do_plumb_load(self, vertex, load, held):
        """The same down to a sinker that its buoy does not lift."""
        self._stand(held)
        self._march(self._load_at(load), self._hang, load)
        self._require(self.z - self.points[vertex, 1])
        self._pass()
        self._put(vertex)
        self.t = self.zero

    def _stand(self, held):
        self.h, self.v = self.zero + PLUMB, self._unknown() if held else self.zero

    def do_to_anchor(self):
        self._march(self.zero, self._hang)
        self._require(self.x)
        self._require(self.z)

    # on the bed

    def do_along(self, facet, way, vertex):
        """To the end of a facet."""
        self._lay(facet, way)
        self._march(self._unknown(), self._lie)
        self._require(self.x - self.points[vertex, 0])
        self._put(vertex)

    def do_along_load(self, facet, way, vertex, load):
        """To a sinker at the end of a facet: a heap, `anew` or `anew_free` comes next."""
        self._lay(facet, way)
        self._march(self._load_at(load), self._lie, load)
        self._require(self.x - self.points[vertex, 0])
        self._put(vertex)
        self._pass()

    def do_off_facet(self, facet, way):
        self._lay(facet, way)
        self._march(self._unknown(), self._lie)
        self._rise(self.phi)

    def do_off_load(self, facet, way, load):
        """To a load on a facet, below which the line hangs."""
        self._lay(facet, way)
        self._march(self._load_at(load), self._lie, load)
        self._rise(self.phi)
        self._push(facet, load)

    def do_off_vertex(self, vertex):
        """From a vertex at an angle between those of its facets."""
        self._rise(self._unknown())

    def do_fold(self, facet, way):
        """To where T = 0; the line turns round there."""
        self._lay(facet, way)
        self._march(self._unknown(), self._lie)
        self._require(self.t)
        self.t = self.zero

    def do_fold_load(self, facet, way, load):
        """To a sinker that hangs down the slope from both legs of the line."""
        self._lay(facet, way)
        self._march(self._load_at(load), self._lie, load)
        self.t = self._pass() * abs(np.sin(self.phi)) - self.t

    def do_heap_begin(self, vertex):
        self._require(self.t)
        self.t = self.zero

    def do_heap_end(self, vertex):
        self._march(self._unknown(), self._heap)
        self.t = self.zero

    def do_heap_end_load(self, vertex, load):
        """A heap as far as a sinker: `anew` or `anew_free` comes next."""
        self._march(self._load_at(load), self._heap, load)
        self._pass()

    def do_end(self, facet, way):
        """To the anchor."""
        self._lay(facet, way)
        self._march(self.zero, self._lie)
        self._require(self.x)
        self._rise(self.phi)


def _hypot(h, v):
    size = np.maximum(np.hypot(h.real, v.real), 1e-300)
    return size + 1j * (h.real * h.imag + v.real * v.imag) / size


def _log1p(c):
    """ln(1 + c) with the accuracy of the real one, to first order in the imaginary part"""
    return np.log1p(c.real) + 1j * c.imag / (1 + c.real)


def solved(line, steps, given, floats, states, end):
    """Newton's method on the unknowns.

    returns : RestEquations at the solution and the Jacobian (k, k+2), whose last columns are by x and z of the
        fairlead; raises : Broken where there is none
    """
    e = RestEquations(line, steps, given, floats, states, end).run()
    size = np.inf
    for _ in range(50):
        values = np.array(e.residuals)
        if len(values) != e.count or len(e.order) != e.count:
            raise Broken
        before, size = size, float(np.abs(values[:, 0].real).max())
        J = values.imag / MOVED
        if not (np.isfinite(size) and np.isfinite(J).all()):
            raise Broken
        if size < 1e-15 or (size < 1e-12 and size >= 0.5 * before):
            break
        try:
            step = -np.linalg.solve(J[:, : e.count], values[:, 0].real)
        except np.linalg.LinAlgError:
            raise Broken from None
        e, moved = _damped(e, step, size, end)
        if not moved:
            break
    if not size < 1e-11:
        raise Broken
    return e, J


def _damped(e, step, size, end):
    """RestEquations after a step, halved until the residual falls, and whether it does"""
    share = 1.0
    for _ in range(12):
        given, floats = [list(values) for values in e.given], dict(e.floats)
        for (number, place), change in zip(e.order, share * step, strict=True):
            if number is None:
                floats[place] += change
            else:
                given[number][place] += change
        try:
            trial = RestEquations(e.line, e.steps, given, floats, e.states, end).run()
            new = max(abs(value[0].real) for value in trial.residuals)
            if new < size or new < 1e-14:
                return trial, True
        except Broken:
            pass
        share *= 0.5
    return e, False
