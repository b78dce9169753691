"""What a fallen chain tells of its contacts with the bed: the steps of `RestEquations`, and where to begin.

From the fairlead down nodes hang or lie.  A run of nodes that lie is cut where the chain has no tension: into parts
that lie in one direction, with heaps between them where that is in a hollow and folds where it is on a slope.
"""

from __future__ import annotations

import numpy as np

FEW = 2  # nodes that hang between some that lie and less than NEARLY of L above the bed: they lie too
NEARLY = 1e-3
TOUCHES = 2e-4  # of L: height of a node that lies
PRESSED = 1e-3  # of the mean weight of a node: force of the bed on one that lies
UPRIGHT, NARROW = 1e-5, 3e-3  # of W and of L: H or width of a span that stands plumb over its heap
BESIDE = 40  # nodes on either side of a load that may be at a ridge with it
LEAST = 1e-9  # of W: H with which a line is begun that hangs plumb
SHORT = 8  # links of a span whose length is known from what its buoy lifts


class Contacts:
    """steps, given : see `RestEquations`; `given` begins with H and V at the fairlead"""

    def __init__(self, chain):
        self.chain, self.line = chain, chain.line
        self.s, self.x, self.z = chain.s[::-1], chain.u[::-1, 0], chain.u[::-1, 1]
        self.T, self.N, self.n = chain.T[::-1], chain.N[::-1], len(chain.s)
        self.dx, self.dz, self.slack = np.diff(self.x), np.diff(self.z), chain.T[::-1] <= 1e-9
        self.load = {self.n - 1 - node: i for i, node in enumerate(chain.loads)}
        self.weight = [load.weight for load in chain.line.loads]
        self.slopes, self.vertices = chain.slopes, chain.x
        self.touches, self.nearly, self.narrow = TOUCHES, NEARLY, NARROW
        if chain.fine:
            self.touches, self.nearly, self.narrow = 1e-3 * chain.size, chain.size, min(NARROW, 10 * chain.size)
        self.near = np.concatenate([[0.0], 2.2 * chain.round + 0.5 * chain.size])  # of each vertex
        self.lies = self._lying()
        H, V = self._pull(0)
        self.steps, self.given = [], [[H if abs(H) > LEAST else LEAST, V + chain.weight[-1]]]
        # hollow that the line has just left plumb, and whether it did at a load, and at which node
        self._left, self._held, self._from = None, False, 0
        self._read()

    def states(self):
        """States of the point loads, and lift over W of those that float: {load: lift}"""
        states, floats = [0] * len(self.line.loads), {}
        for i, wet, dry in zip(self.chain.loads, *self._lifts(), strict=True):
            load = self.n - 1 - i
            number, out = self.load[load], self.chain.emerged(i)
            if wet < 0 and np.isfinite(self.line.surface):
                states[number] = 0 if out <= 0 else 2 if out >= 1 else 1
                if states[number] == 1:
                    floats[number] = wet + (dry - wet) * out
        return states, floats

    def _lifts(self):
        W = self.line.weight
        return [load.weight / W for load in self.line.loads], [load.weight_in_air / W for load in self.line.loads]

    def _lying(self):
        mass = self.chain.mass[::-1]
        heaped = np.zeros(self.n, bool)
        heaped[1:-1] = self.slack[1:] & self.slack[:-1]
        pressed = self.N / mass > PRESSED
        gap = self.chain.gap[::-1]
        lies = pressed | (gap < self.touches) | heaped
        for node, i in self.load.items():
            if self.weight[i] < 0 and not heaped[node] and self.z[node] < self.chain.surface:
                lies[node] = False
        for node in self.load:
            at_ridge = self._at_ridge(node)
            lies[at_ridge] |= lies[at_ridge].any()
        lies[0], lies[-2] = False, lies[-2] and pressed[-2]
        lies[-1] = lies[-2]
        for a, b in _runs(lies):
            few = a > 0 and b < self.n - 1 and b - a < FEW and not lies[a] and gap[a : b + 1].max() < self.nearly
            if few and not any(self.weight[self.load[k]] < 0 for k in range(a, b + 1) if k in self.load):
                lies[a : b + 1] = True
        return lies

    def _read(self):
        for a, b in _runs(self.lies):
            if self.lies[a]:
                self._left, before = None, self._left
                self._contact(a, b, before)
            elif b == self.n - 1:
                self._add("to_anchor")

    def _add(self, *step, given=()):
        self.steps.append(step)
        self.given.append(list(given))

    def _pull(self, node):
        """H, V below a node"""
        node = min(node, self.n - 2)
        along = np.array([-self.dx[node], -self.dz[node]])
        return self.T[node] * along / max(np.hypot(*along), 1e-300)

    def _angle(self, node):
        H, V = self._pull(node)
        return float(np.arctan2(V, H))

    def _normal(self, node, facet, load):
        """Force of a facet on a load that balances the pulls of the links above and below it"""
        across, up = np.subtract(self._pull(node), self._pull(node - 1))
        angle = np.arctan(self.slopes[facet])
        return float((up + self.weight[load] / self.line.weight) * np.cos(angle) - across * np.sin(angle))

    def _hollow(self, vertex):
        return self.slopes[vertex] > self.slopes[vertex - 1]

    def _vertex(self, x, hollow=None):
        """The vertex near x, or None; hollow : whether it has to be one"""
        close = [
            (abs(x - self.vertices[v]), v)
            for v in range(1, len(self.slopes))
            if abs(x - self.vertices[v]) < self.near[v] and hollow in (None, self._hollow(v))
        ]
        return min(close)[1] if close else None

    def _facet(self, x):
        return int(np.searchsorted(self.vertices[1:-1], x))

    def _at_ridge(self, node):
        """Nodes beside one that are at the same ridge, where the chain is fine enough to tell"""
        ridge = self._vertex(self.x[node], False) if self.chain.fine else None
        beside = range(max(node - BESIDE, 0), min(node + BESIDE + 1, self.n)) if ridge else ()
        return [k for k in beside if abs(self.x[k] - self.vertices[ridge]) < self.near[ridge]]

    def _held_load(self, node):
        """The sinker at a node, or the load, a buoy too, that is at the ridge with it, or None"""
        i = self.load.get(node)
        if i is not None and self.weight[i] > 0:
            return i
        return next((self.load[k] for k in self._at_ridge(node) if k in self.load), None)

    def _way(self, link):
        return 1 if self.dx[link] < 0 else -1

    def _parts(self, a, b):
        """Of the nodes a … b that lie: (first, last, way) of parts that pull, (first, last, 0) without tension"""
        if a == b:
            return [(a, b, self._way(max(a - 1, 0)))]
        parts = []
        for link in range(a, b):
            way = 0 if self.slack[link] else self._way(link)
            if parts and parts[-1][2] == way:
                parts[-1] = (parts[-1][0], link + 1, way)
                continue
            if parts and parts[-1][2] * way < 0:
                parts.append((link, link, 0))
            parts.append((link, link + 1, way))
        return self._without_rounding(self._one_heap(parts))

    def _hollow_of(self, part):
        return self._vertex(self.x[(part[0] + part[1]) // 2], True)

    def _one_heap(self, parts):
        """Parts with those of one heap, whose links go to and fro, as one"""
        k = 0
        while k + 2 < len(parts):
            first, between, last = parts[k : k + 3]
            hollow = self._hollow_of(first) if first[2] == 0 == last[2] else None
            if hollow and hollow == self._hollow_of(last) and self._within(between, hollow):
                parts[k : k + 3] = [(first[0], last[1], 0)]
            else:
                k += 1
        return parts

    def _within(self, part, hollow):
        """Whether all nodes of a part are in a hollow, as those of a heap are"""
        return np.abs(self.x[part[0] : part[1] + 1] - self.vertices[hollow]).max() < 3 * self.near[hollow]

    def _without_rounding(self, parts):
        """Parts without those on a slope that have no tension between two that lie in the same direction"""
        k = 1
        while k + 1 < len(parts):
            before, part, after = parts[k - 1 : k + 2]
            if part[2] == 0 and before[2] == after[2] != 0 and self._hollow_of(part) is None:
                parts[k - 1 : k + 2] = [(before[0], after[1], before[2])]
            else:
                k += 1
        return parts

    def _contact(self, a, b, left):
        """Steps of the nodes a … b that lie; left : hollow over which the span before stands plumb"""
        parts, ends = self._parts(a, b), b == self.n - 1
        if len(parts) == 1 and not ends and parts[0][2] and self._one_place(*parts[0], left):
            return
        facet = None
        for number, (first, last, way) in enumerate(parts):
            begins, stops = number == 0, number + 1 == len(parts)
            if way:
                facet = self._begin(first, last, way) if begins else facet
                following = None if stops else parts[number + 1]
                facet = self._pulled(first, last, way, facet, following, stops and ends)
                continue
            way_in = self._way(max(a - 1, 0)) if begins else parts[number - 1][2]
            way_out = parts[number + 1][2] if not stops else -way_in if ends else self._way(b)
            hollow = self._hollow_of((first, last))
            if hollow is None:
                facet = self._folded(first, last, way_in, begins)
            else:
                plumb = begins and left == hollow
                lands = begins and not plumb
                at_load = lands and self.chain.fine and self._held_load(first) is not None
                if lands:
                    facet = hollow if way_in > 0 else hollow - 1
                if lands and not at_load:
                    self._land(a, facet, way_in)
                begin = "plumb" if plumb else "at_load" if at_load else "along"
                if self._heap(first, last, way_in, facet, hollow, begin, stops and not ends):
                    continue
                facet = hollow - 1 if way_out > 0 else hollow
            if stops and ends:
                self._add("end", 0, way_out)
            elif stops and hollow is not None and self._stands_plumb(b, hollow):
                self._left, self._held = hollow, False
            elif stops:
                self._add("off_facet", facet, way_out, given=[self._leaves(b)])

    def _stands_plumb(self, b, hollow):
        """Whether the span below node b stands over a heap in a hollow and comes down into it again"""
        end = b + 1
        while end + 1 < self.n and not self.lies[end]:
            end += 1
        H = np.abs(self.T * self.dx / np.maximum(np.hypot(self.dx, self.dz), 1e-300))[b:end]
        return np.ptp(self.x[b : end + 1]) < self.narrow or (H.max() < UPRIGHT and self._within((b, end), hollow))

    def _folded(self, first, last, way, begins):
        """A fold on a slope; returns its facet"""
        facet = self._facet(self.x[(first + last) // 2])
        if begins:
            self._land(first, facet, way)
        sinker = self._held_load(first) if self._held_load(first) is not None else self._held_load(last)
        if sinker is not None:
            self._add("fold_load", facet, way, sinker)
        else:
            self._add("fold", facet, way, given=[0.5 * (self.s[first] + self.s[last])])
        return facet

    def _heap(self, first, last, way, facet, hollow, begin, leaves):
        """A heap in a hollow, or a sinker there.  returns : whether the line leaves it at a sinker, to hang

        begin : "plumb", a span over it, or "at_load", with which a span ends there, or "along" the facet
        """
        top, bottom = self._held_load(first), self._held_load(last)
        if begin == "plumb":
            self._plumb(hollow, top, self.s[first])
        elif begin == "at_load":
            self._add("to_vertex_sinker", hollow, top)
        elif top is not None:
            self._add("along_load", facet, way, hollow, top)
        else:
            self._add("along", facet, way, hollow, given=[self.s[first]])
            self._add("heap_begin", hollow)
        if bottom is not None and bottom != top:
            self._add("heap_end_load", hollow, bottom)
        elif first != last or bottom is None:
            self._add("heap_end", hollow, given=[self.s[last]])
            return False
        if leaves:
            self._leave_load(last, hollow)
            return True
        self._add("anew", given=[self.T[min(last, self.n - 2)]])
        return False

    def _plumb(self, hollow, sinker, s):
        """Step of a plumb span over a hollow that ends in its heap at s, or at a sinker"""
        up = [self._pull(self._from)[1]] if self._held else []
        if sinker is not None:
            self._add("plumb_load", hollow, sinker, self._held, given=up)
        else:
            self._add("plumb", hollow, self._held, given=[*up, s])

    def _leave_load(self, node, vertex):
        """Step from a load at a vertex, below which the line hangs or stands plumb"""
        if self.chain.fine and self._hollow(vertex) and self._stands_plumb(node, vertex):
            self._left, self._held, self._from = vertex, True, node
        else:
            self._add("anew_free", given=self._pull(node))

    def _one_place(self, first, last, _, left):
        """Steps where a few nodes touch at one place.  returns : whether they do"""
        load, ridge = self._held_load(first), self._vertex(self.x[first], False)
        over_ridge = ridge is not None and ridge == self._vertex(self.x[last], False)
        if load is not None and (first == last or (self.chain.fine and over_ridge)):
            self._one_load(first, last, load, left)
            return True
        if not over_ridge or load is not None or self._held_load(last) is not None:
            return False
        self._add("to_vertex", ridge, given=[0.5 * (self.s[first] + self.s[last])])
        self._add("off_vertex", ridge, given=[self._angle(last)])
        return True

    def _one_load(self, first, last, load, left):
        """Steps of a load that alone touches the bed"""
        vertex = self._vertex(self.x[first])
        if vertex is None:
            facet = self._facet(self.x[first])
            self._add("sinker", facet, load, given=[self._normal(first, facet, load)])
            return
        if left == vertex:
            self._plumb(vertex, load, self.s[first])
        else:
            self._add("to_vertex_sinker", vertex, load)
        self._leave_load(last, vertex)

    def _begin(self, first, last, way):
        """Steps to the node at which a span comes down; returns the facet on which the line lies then"""
        sinker, vertex = self._held_load(first), self._vertex(self.x[first])
        beyond = None if vertex is None else vertex - 1 if way > 0 else vertex
        if vertex is not None and sinker is not None:
            self._add("to_vertex_sinker", vertex, sinker)
            self._add("anew", given=[self.T[min(first, self.n - 2)]])
            return beyond
        if vertex is not None and not self._hollow(vertex):
            self._add("to_vertex", vertex, given=[self.s[first]])
            return beyond
        facet = self._facet(self.x[first] if vertex is None else self.x[min(first + 2, last)])
        self._land(first, facet, way)
        return facet

    def _land(self, node, facet, way):
        sinker = self._held_load(node)
        if sinker is not None:
            self._add("to_sinker", facet, way, sinker)
            return
        above = node - 1
        while above > 0 and not self.lies[above]:
            above -= 1
        lifted = self._lifted(above)
        self._add("to_facet", facet, way, given=[self.s[node] if lifted is None else lifted[0] - lifted[1]])

    def _leaves(self, node):
        """s at which the line leaves the bed for the span below a node"""
        lifted = self._lifted(node)
        return self.s[node] if lifted is None else lifted[0] + lifted[1]

    def _lifted(self, node):
        """Of a short span below a node: s of its one buoy and half the length that it lifts, else None"""
        end = node + 1
        while end + 1 < self.n and not self.lies[end]:
            end += 1
        buoys = [k for k in range(node + 1, end) if k in self.load and self.weight[self.load[k]] < 0]
        if end - node > SHORT or len(buoys) != 1:
            return None
        buoy, ends = self.load[buoys[0]], np.cumsum([segment.length for segment in self.line.segments])
        s = self.s[buoys[0]]
        weight = self.line.segments[min(int(np.searchsorted(ends / ends[-1], s)), len(ends) - 1)].weight
        half = 0.5 * abs(self.weight[buoy]) / weight / self.line.length
        return s, min(half, 0.5 * (self.s[node] - self.s[end]))

    def _pulled(self, first, last, way, facet, following, ends):
        """Steps of a part that pulls, from `facet` on; following : the part without tension after it, if there is one

        returns : the facet on which it ends
        """
        if ends:
            self._cross(facet, 0, way, first, last)
            self._add("end", 0, way)
            return 0
        if following is not None:
            middle = self.x[(following[0] + following[1]) // 2]
            hollow = self._vertex(middle, True)
            goal = self._facet(middle) if hollow is None else hollow if way > 0 else hollow - 1
            self._cross(facet, goal, way, first, last)
            return goal
        vertex, sinker = self._vertex(self.x[last]), self._held_load(last)
        at_vertex = vertex is not None and (sinker is not None or not self._hollow(vertex))
        goal = (vertex if way > 0 else vertex - 1) if at_vertex else self._facet(self.x[last])
        self._cross(facet, goal, way, first, last)
        if at_vertex and sinker is not None:
            self._add("along_load", goal, way, vertex, sinker)
            self._add("anew_free", given=self._pull(last))
        elif sinker is not None:
            self._add("off_load", goal, way, sinker, given=[self._normal(last, goal, sinker)])
        elif at_vertex:
            self._add("along", goal, way, vertex, given=[self.s[last]])
            self._add("off_vertex", vertex, given=[self._angle(last)])
        else:
            self._add("off_facet", goal, way, given=[self._leaves(last)])
        return goal

    def _cross(self, facet, goal, way, first, last):
        """Steps from one facet to another: over ridges, and over hollows in a short span or with a sinker there."""
        while (goal - facet) * way < 0:
            vertex = facet if way > 0 else facet + 1
            s, following = self._s_at(first, last, self.vertices[vertex]), facet - way
            close = [k for k in range(first, last + 1) if abs(self.x[k] - self.vertices[vertex]) < self.near[vertex]]
            sinkers = [k for k in close if self._held_load(k) is not None]
            if not self._hollow(vertex) and not (sinkers and self.chain.fine):
                self._add("along", facet, way, vertex, given=[s])
            elif sinkers:
                self._add("along_load", facet, way, vertex, self._held_load(sinkers[0]))
                self._add("anew", given=[self.T[min(sinkers[0], self.n - 2)]])
            else:
                half = min(2e-3, 1e-4 + 0.3 * abs(self.s[first] - s), 1e-4 + 0.3 * abs(s - self.s[last]))
                self._add("off_facet", facet, way, given=[s + half])
                self._add("to_facet", following, way, given=[s - half])
            facet = following

    def _s_at(self, first, last, x):
        """s where the nodes first … last pass x"""
        for k in range(first, last):
            before, after = self.x[k] - x, self.x[k + 1] - x
            if before * after <= 0 and before != after:
                return self.s[k] + (self.s[k + 1] - self.s[k]) * before / (before - after)
        return self.s[first] if abs(self.x[first] - x) < abs(self.x[last] - x) else self.s[last]


def _runs(flags):
    """(first, last) of runs of equal flags"""
    changes = np.flatnonzero(np.diff(flags)) + 1
    return list(zip([0, *changes], [*(changes - 1), len(flags) - 1], strict=True))
