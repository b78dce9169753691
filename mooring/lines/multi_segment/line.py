"""Static lines of any number of segments and point loads over an uneven bed with friction, below a sea surface.

Free spans are elastic catenaries in closed form (`free_span`), as is the line on a facet of the bed (`friction`).  For
a given horizontal tension one integration from the fairlead down to the anchor (`traverse`) finds the contacts with the
bed; Newton's method on the equations of equilibrium with these contacts (`equations`, `newton`) gives positions and
forces. A result is returned only if its own pieces confirm it (`verdict`). SR179 report (1982), section 3.1, with these
differences: there are no nodes and no finite differences; on a slope only T is propagated; friction acts at bed
vertices too, and only as far as equilibrium needs it.

Coordinates: the anchor at (0, 0), x towards the fairlead, z up.  A line pulls its fairlead towards the anchor with H
and down with V. A slack line hangs plumb, with the rest in a heap at its anchor; in the heap buoys stand plumb and
sinkers do not pull. A buoy floats in the sea surface with a part of its lift, unless a fairlead above the surface
lifts the buoy out of the water.  On a slope too steep for friction, a line without tension slides down. It slides
into a heap above the next vertex that stops it, or into a bight below the anchor that holds it. Where the first
facet falls from the anchor, the bight lies beyond the point below the fairlead.  Friction holds against the pull of
the fairlead with all its capacity. With full friction a line may have no equilibrium, because a span that lands
behind a ridge would jump to the front of the ridge; friction then holds with a part of its capacity. Lines without
any such equilibrium are refused: slack lines with sinkers or buoys in several heaps, folds and bights on beds too
steep for friction. Bending, current on the line and the weight of the line above water are neglected.
"""

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from ..catenary.state import BEYOND_REACH, SLACK, BeyondReachError, LineError
from .bed import Bed
from .segments import PointLoad, Segment
from .solution import LineState, StaticSolution, heaped, turned

__all__ = ["Bed", "LineState", "PointLoad", "Segment", "StaticLine", "StaticSolution"]

FLAT = Bed.sloping()
LEAST = 1e-11  # horizontal tension below which a line is slack, over its weight
RESIDUAL = 1e-10  # residual of every equation, over the line length
SOFT = 1e-7  # height over which a buoy emerges during the search for its state, over the line length
SOFTER = 1e-3  # the same for a second search: of buoys in the surface one moves many times as far as the next
WORDS = ("submerged", "floating", "emerged")  # states of point loads
MOBILISED = (0.5, 0.2, 0.0)  # shares of the friction that are tried if the whole has no equilibrium


@cache
def _search():
    """The module of the kernels, whose import is slow"""
    from . import search

    return search


@cache
def _uniform():
    """The module of the kernels of a uniform line"""
    from ..catenary import uniform

    return uniform


@dataclass(frozen=True)
class StaticLine:
    """A line from its anchor to its fairlead.

    segments : from the anchor up; loads : point loads; bed : Bed, or None for a line without a bed
    surface : height of the sea surface above the anchor, m, above which no buoy rises by itself; inf for none
    uplift_limit : allowed angle of the pull on the anchor above the bed, rad; see `StaticSolution.anchor_uplift`
    """

    segments: tuple[Segment, ...]
    loads: tuple[PointLoad, ...] = ()
    bed: Bed | None = FLAT
    surface: float = np.inf
    uplift_limit: float = np.inf

    def __post_init__(self):
        object.__setattr__(self, "segments", tuple(self.segments))
        object.__setattr__(self, "loads", tuple(sorted(self.loads, key=lambda load: load.position)))
        if not self.segments:
            raise ValueError("a line needs at least one segment")
        for load in self.loads:
            if not 0 < load.position < self.length:
                raise ValueError(
                    f"point load {load.name}: position is {load.position:g} m; allowed: inside the line, "
                    f"above 0 and below {self.length:g} m"
                )
        if np.isnan(self.surface):
            raise ValueError("surface is nan; allowed: a height above the anchor, or inf")
        if self.surface <= 0 and any(load.weight < 0 for load in self.loads):
            raise ValueError(f"surface is {self.surface:g} m; allowed with buoys: above the anchor, above 0 m")

    def __repr__(self):
        return f"<StaticLine {len(self.segments)} segments, {self.length:.6g} m, {len(self.loads)} point loads>"

    @cached_property
    def length(self):
        """m, unstretched"""
        return float(sum(segment.length for segment in self.segments))

    @cached_property
    def weight(self):
        """Submerged weight without point loads, N"""
        return float(sum(segment.length * segment.weight for segment in self.segments))

    @cached_property
    def anchor_slope(self):
        """Slope of the bed at the anchor, rad; −π/2 without a bed"""
        return -0.5 * np.pi if self.bed is None else float(np.arctan2(*self.bed.points[1, ::-1]))

    @cached_property
    def _steep(self):
        """Whether some facet is too steep for a line without tension to lie on."""
        return self.bed is not None and float(np.abs(self.bed.slopes).max()) > self.bed.friction

    def solve(self, x, z, state=None):
        """Forces, stiffness and shape with the fairlead at (x, z).

        x : m, ≥ 0; z : m above the anchor; x and z broadcast, and each position is solved independently
        state : LineState of the previous position, for friction with history; None for a line pulled out from slack
        returns : StaticSolution; raises : LineError where there is no equilibrium, ValueError for impossible input
        """
        x, z = np.asarray(x, float), np.asarray(z, float)
        if x.shape != z.shape:
            x, z = np.broadcast_arrays(x, z)
        self._check(x, z)
        data = self._data if state is None else self._data._replace(kept=np.ascontiguousarray(state.pieces, float))
        least = 1e-9 * self.length
        if x.ndim == 0:
            xs, zs = np.array([max(float(x), least)]), z.reshape(1)
        else:
            xs, zs = np.maximum(x, least).ravel(), np.ascontiguousarray(z.ravel())
        found, status, pieces, loads = self._solve(data, xs, zs)
        self._judge(x, z, found, status)
        return self._solution(x, z, found, status, loads, pieces)

    def _solve(self, data, x, z):
        """What `search.solve_positions` finds; what one way of traversal does not find is sought in another."""
        search = _search()
        guess = self._like_a_uniform_line(float(x[0]), float(z[0]))
        if guess == 0 and data.lowest_buoy < len(data.loads):  # slack: see `traverse`
            data = data._replace(to_place=False)
        begin = search.QUICK if len(x) == 1 else search.COARSE
        found, status, pieces, loads = search.solve_positions(data, x, z, guess, self._capacity(data), begin)
        if self._mirrored is not None and len(data.kept) == 0:
            pieces, loads = self._slide_beyond(x, z, found, status, pieces, loads)
        for way, tolerances in self._further_tries(data) if search.LOST in status.tolist() else ():
            for i in np.flatnonzero(status == search.LOST):
                row, state, its, words = self._once(way, x[i : i + 1], z[i : i + 1], tolerances)
                if state != search.LOST:
                    found[i], status[i] = row, state
                    pieces, loads = (its, words) if i + 1 == len(x) else (pieces, loads)
        return found, status, pieces, loads

    def _once(self, way, x, z, tolerances):
        """Row of `newton.store`, state, pieces and states of the point loads at one position"""
        search = _search()
        guess = self._like_a_uniform_line(float(x[0]), float(z[0]))
        found, status, pieces, loads = search.solve_positions(way, x, z, guess, self._capacity(way), tolerances)
        return found[0], status[0], pieces, loads

    def _further_tries(self, data):
        """Pairs of LineData and tolerances by which a line is sought that is not found at once, the quickest first"""
        search, other = _search(), data._replace(to_place=not data.to_place)
        tries = [(data, search.EXACT), (other, search.QUICK), (other, search.EXACT)]
        if data.lowest_buoy < len(data.loads) and np.isfinite(self.surface):
            tries.append((data._replace(soft=SOFTER * self.length), search.EXACT))
        if data.friction > 0:
            tries += [(data._replace(friction=share * data.friction), search.EXACT) for share in MOBILISED]
        if self.loads and self._steep:
            tries += [(data._replace(held=held, to_place=False), search.EXACT) for held in (1, 2)]
            tries.append((data._replace(held=1, to_place=True), search.ROUGH))
        return tries

    @cached_property
    def _mirrored(self):
        """The line with x turned round, where it may slide past the foot of its fairlead; else None

        On a facet that falls from the anchor more steeply than friction holds, what is more than the line needs slides
        down and hangs in a bight farther down than the fairlead; both of its legs pull the line's ends there, so that
        H < 0 at the fairlead.  With x turned round the bed rises and the bight is below the anchor, as in `on_bed`.
        """
        if self.bed is None or not self.bed.slides_beyond:
            return None
        bed = Bed.sloping(-float(np.arctan(self.bed.slopes[0])), self.bed.friction)
        return StaticLine(self.segments, self.loads, bed, self.surface)

    def _slide_beyond(self, x, z, found, status, pieces, loads):
        """Solve slack or unsolved positions as a line that slides down its first facet, into found and status.

        returns : pieces and states of the point loads at the last position, unchanged if it is none of these
        """
        search, far, data = _search(), self.bed.first_facet, self._mirrored._data
        for i in np.flatnonzero(((status == SLACK) | (status == search.LOST)) & (x <= far)):
            given = data, -x[i : i + 1], z[i : i + 1], self.weight, self._capacity(data), search.QUICK
            once, state, its, words = search.solve_positions(*given)
            if state[0] == search.SOLVED and its[:, 3].min() >= -far:
                status[i], (found[i], its) = search.SOLVED, turned(once[0], its)
                pieces, loads = (its, words) if i + 1 == len(x) else (pieces, loads)
        return pieces, loads

    def _like_a_uniform_line(self, x, z):
        """H, N, of a uniform line of the same length, weight and stretch on a flat bed; 0 where it is slack"""
        uniform = _uniform()
        row = np.empty(uniform.COLUMNS)
        uniform.solve_uniform(row, (abs(x), z, self.length, *self._mean, 0.0, 0.0), z > 0 and self.bed is not None)
        H = float(row[0])
        return H if 0 <= H < np.inf else self.weight

    @cached_property
    def _mean(self):
        """N/m and 1/N: weight with point loads, or a fifth of the line's weight if buoys lift more, and stretch"""
        weight = max(self.weight + sum(load.weight for load in self.loads), 0.2 * self.weight)
        stretch = sum(segment.length * segment.strain_table[0, 2] for segment in self.segments)
        return weight / self.length, stretch / self.length

    def path(self, x, z, state=None):
        """Solutions of positions (n,) visited in order, each with the friction history of the previous one."""
        solutions = []
        for xi, zi in zip(*np.broadcast_arrays(np.atleast_1d(x), z), strict=True):
            solutions.append(self.solve(xi, zi, state))
            state = solutions[-1].state
        return solutions

    def _solution(self, x, z, found, status, loads, pieces):
        slack = status == SLACK
        if SLACK in status.tolist():
            found[slack, 0] = 0.0
            found[slack, 5:7] = 0.0
        if x.ndim > 0:
            H, V, H_anchor, V_anchor = found[:, :4].T.reshape(4, *x.shape)
            stiffness, residual = found[:, 5:9].reshape(*x.shape, 2, 2), found[:, 9].reshape(x.shape)
            return StaticSolution(self, x, z, H, V, H_anchor, V_anchor, stiffness, slack.reshape(x.shape), residual)
        if slack[0] and not np.any(pieces[:, 10] > 0.5 * np.pi):  # the bight of a line that slides
            tangent = 0.0 if self.bed is None else self.bed.points[1, 1] / self.bed.points[1, 0]
            pieces = heaped(pieces, tangent)
        row, states = found[0], tuple([WORDS[i] for i in loads.tolist()])
        stiffness = row[5:9].reshape(2, 2)
        return StaticSolution(self, x[()], z[()], *row[:4], stiffness, slack[0], row[9], states, pieces)

    def _check(self, x, z):
        if x.ndim == 0:  # scalar: without arrays
            one, height = float(x), float(z)
            good = 0 <= one < np.inf and -np.inf < height < np.inf
            if good and (self.bed is None or self.bed.depth_below(one, height) > 0):
                return
        if not (np.isfinite(x) & (x >= 0)).all():
            raise ValueError(f"line x is {x[~(np.isfinite(x) & (x >= 0))].flat[0]:g} m; allowed: finite, at least 0 m")
        if not np.isfinite(z).all():
            raise ValueError(f"line z is {z[~np.isfinite(z)].flat[0]:g} m; allowed: finite")
        if self.bed is not None:
            under = self.bed.depth_below(x, z)
            if not (under > 0).all():
                raise ValueError(f"the fairlead is {-under.min():g} m below the bed; allowed: above it")

    def _judge(self, x, z, found, status):
        if x.size == 1 and found[0, 9] <= RESIDUAL and status[0] != BEYOND_REACH:  # scalar: without arrays
            return
        good = (found[:, 9] <= RESIDUAL) & (status != BEYOND_REACH)
        if not good.all():
            wrong = ~good
            i = int(np.argmax(wrong))
            beyond = status[i] == BEYOND_REACH
            what = "cannot be reached by" if beyond else "is within reach, but no equilibrium was found for"
            what += f" a line of {self.length:g} m{'' if beyond else self._way_out}"
            count = f"{np.count_nonzero(wrong)} of {x.size} positions: " if x.size > 1 else ""
            raise (BeyondReachError if beyond else LineError)(
                f"{count}fairlead at x = {x.flat[i]:.6g} m, z = {z.flat[i]:.6g} m {what}"
            )

    @property
    def _way_out(self):
        """End of the message for a line without solution"""
        if not self._steep:
            return "; give another length, or move the fairlead or a load a little"
        steepest = np.abs(self.bed.slopes).max()
        return (
            f": the line may slide on its bed, which has slopes up to {steepest:.3g} and friction "
            f"{self.bed.friction:g}; give a friction of at least {steepest:.3g}, a shorter line, or no loads where it "
            f"lies"
        )

    def _capacity(self, data):
        parts = len(data.segments) + len(data.loads) + len(data.kept) + len(data.strain_table)
        return 4 * parts + 8 * len(data.bed) + 32

    @cached_property
    def _data(self):
        """LineData of the kernels."""
        from .line_data import LineData

        tables = [segment.strain_table for segment in self.segments]
        ends = np.concatenate([[0.0], np.cumsum([segment.length for segment in self.segments])])
        loads = np.array([(load.position, load.weight, load.weight_in_air) for load in self.loads], float)
        loads = loads.reshape(-1, 3)
        points = np.array([[0.0, 0.0], [1.0, 0.0]]) if self.bed is None else self.bed.points
        slopes = np.diff(points[:, 1]) / np.diff(points[:, 0])
        buoys = np.flatnonzero(loads[:, 1] < 0)
        return LineData(
            np.column_stack([ends[:-1], [segment.weight for segment in self.segments]]),
            float(ends[-1]),
            np.concatenate([[0], np.cumsum([len(table) for table in tables])]),
            np.concatenate(tables),
            loads,
            int(buoys[0]) if buoys.size else len(loads),
            float(self.surface),
            SOFT * self.length,
            np.column_stack([points[:-1], np.arctan(slopes), np.minimum.accumulate(slopes)]),
            self.bed is None,
            0.0 if self.bed is None else float(self.bed.friction),
            LEAST * self.weight,
            len(points) > 2,
            0,
            0.0,
            0,
            self.weight,
            0.0,
            np.empty((0, 4)),
        )
