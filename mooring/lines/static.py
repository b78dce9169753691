"""Static lines of any number of segments and point loads over an uneven bed with friction, below a sea surface.

Free spans are elastic catenaries in closed form, the line on a facet of the bed in closed form too (`hanging.pieces`:
equations, signs, sources).  Which parts touch what follows from one walk down the line for a given tension
(`hanging.walk`), positions and forces from Newton's method on the equations of that walk (`hanging.newton`).
SR179 report (1982), section 3.1, with these differences: no nodes and no finite differences; on a slope only T is
propagated; friction acts at knuckles too, and only as far as it is needed.

Coordinates: the anchor at (0, 0), x towards the fairlead, z up.  A line pulls its fairlead towards the anchor with H
and down with V.  Bending, current on the line and the weight of the line above water are neglected.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mooring.catenary import LineError

from .bed import Bed
from .segments import PointLoad, Segment

__all__ = ["Bed", "LineState", "PointLoad", "Segment", "StaticLine", "StaticSolution"]

FLAT = Bed.sloping()
LEAST = 1e-11  # of the line's weight: the pull below which a line is called slack
RESIDUAL = 1e-10  # of the line length, on every equation
SOFT = 1e-7  # of the line length: height over which a buoy emerges while its state is sought
STATUS = ("on its way", "beyond reach", "slack", "not found")


class LineState(NamedTuple):
    """What a line remembers: (k, 4) rows of s₀, s₁ (m from the anchor), T₀, T₁ (N) on the bed, downwards."""

    pieces: np.ndarray


@dataclass(frozen=True)
class StaticSolution:
    """A solved line, or the same line at many positions, all of one shape (...).

    horizontal_fairlead, vertical_fairlead : N, pull on the fairlead towards the anchor and down
    horizontal_anchor, vertical_anchor : N, pull on the anchor towards the fairlead and up
    stiffness : (..., 2, 2) N/m, ∂(H, V at the fairlead)/∂(x, z)
    slack : whether the line hangs plumb with its rest in a heap
    residual : largest error of an equation over the line length
    loads : states of the point loads, "submerged", "floating" or "emerged"; pieces : see `profile`; one position only
    """

    line: StaticLine
    x: np.ndarray
    z: np.ndarray
    horizontal_fairlead: np.ndarray
    vertical_fairlead: np.ndarray
    horizontal_anchor: np.ndarray
    vertical_anchor: np.ndarray
    stiffness: np.ndarray
    slack: np.ndarray
    residual: np.ndarray
    loads: tuple = ()
    pieces: np.ndarray = field(default=None, repr=False)

    @property
    def tension_fairlead(self):
        """(...,) N"""
        return np.hypot(self.horizontal_fairlead, self.vertical_fairlead)

    @property
    def tension_anchor(self):
        """(...,) N"""
        return np.hypot(self.horizontal_anchor, self.vertical_anchor)

    @property
    def anchor_uplift(self):
        """(...,) rad, angle of the pull on the anchor above the bed there; 0 where the line lies on the bed"""
        up = np.arctan2(self.vertical_anchor, self.horizontal_anchor)
        beta = self.line.anchor_slope
        lifted = (self.tension_anchor > 0) & (up > beta + 1e-9)
        return np.where(lifted, up - beta, 0.0)

    @property
    def anchor_holds(self):
        """(...,) whether the uplift stays within the line's `uplift_limit`"""
        return self.anchor_uplift <= self.line.uplift_limit

    @property
    def stiffness_in_space(self):
        """(..., 3, 3) N/m along the line, across it and up: the plane's own stiffness, and H over the span across"""
        k = np.zeros((*np.shape(self.x), 3, 3))
        k[..., 0::2, 0::2] = self.stiffness
        span = np.where(self.x > 0, self.x, 1.0)
        k[..., 1, 1] = np.where(self.x > 0, self.horizontal_fairlead / span, self.stiffness[..., 0, 0])
        return k

    @cached_property
    def _one(self):
        if self.pieces is None:
            raise ValueError(f"this needs one position; the solution holds {np.shape(self.x)}; solve one at a time")
        return self.pieces

    @cached_property
    def state(self):
        """LineState to give to the next `solve`: the friction the line keeps"""
        p = self._one[(self._one[:, 0] == 1) & (self._one[:, 2] > 0)]
        return LineState(_joined(np.column_stack([p[:, 1] - p[:, 2], p[:, 1], p[:, 5] - p[:, 6] * p[:, 2], p[:, 5]])))

    @property
    def grounded(self):
        """(k, 2) m from the anchor: where the parts on the bed begin and end, from the anchor up"""
        p = self._one[(self._one[:, 0] == 1) & (self._one[:, 2] > 0)]
        spans = []
        for top, length in p[:, 1:3]:
            if spans and spans[-1][0] - top <= 1e-12 * self.line.length:
                spans[-1][0] = top - length
            else:
                spans.append([top - length, top])
        return np.maximum(np.array(spans[::-1]).reshape(-1, 2), 0.0)

    @property
    def grounded_length(self):
        """m, unstretched length on the bed"""
        return float(np.sum(np.diff(self.grounded, axis=1)))

    def profile(self, points=101):
        """The line, drawn: (points, 4) of s from the anchor, x, z (m) and tension (N), joints of pieces not included.

        Where the line is slack the heap on the bed is drawn stretched out towards the anchor.
        """
        s = np.linspace(0.0, self.line.length, points)
        p = self._one
        top = p[:, 1]
        index = np.clip(np.searchsorted(-top, -s, side="right") - 1, 0, len(p) - 1)
        down = np.minimum(top[index] - s, p[index, 2])
        return np.column_stack([s, _along(p[index], down)])


@dataclass(frozen=True)
class StaticLine:
    """A line from its anchor to its fairlead.

    segments : from the anchor up; loads : point loads; bed : Bed, or None for a line that touches nothing
    surface : m above the anchor; buoys do not rise above it but come out of the water; inf without
    uplift_limit : rad, allowed angle of the pull on the anchor above the bed; see `StaticSolution.anchor_uplift`
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

    def __repr__(self):
        return f"<StaticLine {len(self.segments)} segments, {self.length:.6g} m, {len(self.loads)} point loads>"

    @cached_property
    def length(self):
        """m, unstretched"""
        return float(sum(segment.length for segment in self.segments))

    @cached_property
    def weight(self):
        """N, submerged, without point loads"""
        return float(sum(segment.length * segment.weight for segment in self.segments))

    @cached_property
    def anchor_slope(self):
        """rad, of the bed at the anchor; −π/2 without a bed"""
        return -0.5 * np.pi if self.bed is None else float(np.arctan2(*self.bed.points[1, ::-1]))

    def solve(self, x, z, state=None):
        """Forces, stiffness and shape with the fairlead at (x, z).

        x : m ≥ 0, z : m above the anchor; broadcast, each position on its own
        state : LineState of the position before, for friction with history; None: pulled out from slack
        returns : StaticSolution; raises : LineError where there is no equilibrium, ValueError for impossible input
        """
        x, z = np.broadcast_arrays(np.asarray(x, float), np.asarray(z, float))
        self._check(x, z)
        data = self._data if state is None else self._data._replace(left=np.ascontiguousarray(state.pieces, float))
        rows = np.empty((self._room(data), 11))
        found = np.empty((x.size, 12))
        close = np.maximum(x.ravel(), 1e-9 * self.length)
        from .hanging.newton import solve_positions

        states = solve_positions(data, close, np.ascontiguousarray(z.ravel()), self.weight, rows, found)
        self._judge(x, z, found)
        return self._solution(x, z, found, states, rows)

    def path(self, x, z, state=None):
        """Solutions of positions (n,) visited one after another, each keeping the friction of the one before."""
        solutions = []
        for xi, zi in zip(*np.broadcast_arrays(np.atleast_1d(x), z), strict=True):
            solutions.append(self.solve(xi, zi, state))
            state = solutions[-1].state
        return solutions

    def _solution(self, x, z, found, states, rows):
        slack = found[:, 9] == STATUS.index("slack")
        found[slack, 0] = 0.0
        found[slack, 5:7] = 0.0
        H, V, H_anchor, V_anchor = (column.reshape(x.shape)[()] for column in found[:, :4].T)
        words = ("submerged", "floating", "emerged")
        one = x.ndim == 0
        return StaticSolution(
            self,
            x[()],
            z[()],
            H,
            V,
            H_anchor,
            V_anchor,
            found[:, 5:9].reshape(*x.shape, 2, 2),
            slack.reshape(x.shape)[()],
            found[:, 10].reshape(x.shape)[()],
            tuple(words[i] for i in states) if one else (),
            rows[: int(found[0, 11])] if one else None,
        )

    def _check(self, x, z):
        if not np.all(np.isfinite(x) & (x >= 0)):
            raise ValueError(f"line x is {x[~(np.isfinite(x) & (x >= 0))].flat[0]:g} m; allowed: finite, at least 0 m")
        if not np.all(np.isfinite(z)):
            raise ValueError(f"line z is {z[~np.isfinite(z)].flat[0]:g} m; allowed: finite")
        if self.bed is not None:
            under = self.bed.depth_below(x, z)
            if not np.all(under > 0):
                raise ValueError(f"the fairlead is {-under.min():g} m below the bed; allowed: above it")
        if not np.all(z <= self.surface) and self.loads:
            raise ValueError(f"line z is {z.max():g} m, above the sea surface at {self.surface:g} m; allowed: below it")

    def _judge(self, x, z, found):
        wrong = ~((found[:, 10] <= RESIDUAL) & np.isin(found[:, 9], (0, 2)))
        if np.any(wrong):
            i = int(np.argmax(wrong))
            code = int(found[i, 9])
            what = "cannot be reached" if code == 1 else f"was missed by {found[i, 10]:.3g} of the line length"
            raise LineError(
                f"{np.count_nonzero(wrong)} of {x.size} position(s): fairlead at x = {x.flat[i]:.6g} m, "
                f"z = {z.flat[i]:.6g} m {what}: {self!r}"
            )

    def _room(self, data):
        parts = data.joint.size + data.load_s.size + data.left.shape[0] + data.knot_tension.size
        return 4 * parts + 8 * data.bed_x.size + 32

    @cached_property
    def _data(self):
        """The line as the kernels read it."""
        from .hanging.pieces import LineData

        tables = [segment.strain_table for segment in self.segments]
        knots = np.concatenate(tables)
        wet = np.array([load.weight for load in self.loads], float)
        points = np.array([[0.0, 0.0], [1.0, 0.0]]) if self.bed is None else self.bed.points
        slopes = np.diff(points[:, 1]) / np.diff(points[:, 0])
        buoys = np.flatnonzero(wet < 0)
        return LineData(
            np.concatenate([[0.0], np.cumsum([segment.length for segment in self.segments])]),
            np.array([segment.weight for segment in self.segments], float),
            np.concatenate([[0], np.cumsum([len(table) for table in tables])]),
            *(np.ascontiguousarray(column) for column in knots.T),
            np.array([load.position for load in self.loads], float),
            wet,
            np.array([load.weight_in_air for load in self.loads], float),
            int(buoys[0]) if buoys.size else len(wet),
            float(self.surface),
            SOFT * self.length,
            np.ascontiguousarray(points[:-1, 0]),
            np.ascontiguousarray(points[:-1, 1]),
            np.arctan(slopes),
            np.minimum.accumulate(slopes),
            self.bed is None,
            0.0 if self.bed is None else float(self.bed.friction),
            LEAST * self.weight,
            np.empty((0, 4)),
        )


def _joined(pieces):
    """Pieces whose tensions lie on one straight line made one, so that a long history stays short."""
    joined = []
    for s0, s1, t0, t1 in pieces:
        if joined:
            above = joined[-1]
            slope = (above[3] - above[2]) / (above[1] - above[0])
            size = 1e-12 * (abs(above[2]) + abs(above[3]))
            meets = above[0] - s1 <= 1e-12 * above[1] and abs(above[2] - t1) <= size
            if meets and abs(above[2] - slope * (above[0] - s0) - t0) <= size:
                above[0], above[2] = s0, t0
                continue
        joined.append([s0, s1, t0, t1])
    return np.array(joined).reshape(-1, 4)


def _along(p, down):
    """x, z and tension a length `down` below the tops of pieces `p` (n, 11)."""
    from mooring.grounded import free_span

    _, _, _, x, z, first, second, weight, factor, flexibility, angle = p.T
    on_bed = p[:, 0] == 1
    H, V = np.where(on_bed, 1.0, first), np.where(on_bed, 0.0, second)
    dx, dz = free_span(H, V - weight * down, down, weight, flexibility / factor)
    slid = down * (factor + flexibility * (first - 0.5 * second * down))
    dx = np.where(on_bed, slid * np.cos(angle), factor * dx)
    dz = np.where(on_bed, slid * np.sin(angle), factor * dz)
    tension = np.where(on_bed, first - second * down, np.hypot(H, V - weight * down))
    return np.column_stack([x - dx, z - dz, tension])
