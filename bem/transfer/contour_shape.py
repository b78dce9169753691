"""Response of a box or a vertical cylinder to partial waves, by the contour method.

In front of a rigid wall down to the bed, the wave f of one depth mode n becomes f − N(kₙ) ∂f/∂n on the plan contour.
The flow under the keel is solved as for plane waves (`bem.contour.matching`).
By Green's theorem a flow with the outward velocity w at the contour in mode n sends the waves

    b = −∮ w (f − N ∂f/∂n) ds / {π (1 + δₘ₀) W},    W the Wronskian of `partial_waves`
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..contour.matching import loads, solved
from ..contour.one_frequency import combined
from ..contour.plan.maps import CLASSES
from ..contour.several.exterior import Exterior, Place
from ..contour.several.senders import Kernel, sender
from ..modes import class_of


class Answers(NamedTuple):
    """Response of one body alone to partial waves, about the vertical axis of the body and in its own axes.

    Partial waves are ordered mode by mode, cos 0 … M and then sin 1 … M.

    radiation : ∬ φⱼ nᵢ dS of unit velocities, (6, 6); sent : outgoing waves of unit velocities, (q, 6)
    scattered : outgoing waves of each regular wave, in columns, (q, q)
    pressed : ∬ φ nᵢ dS of each regular wave with its scattered waves, (6, q); residual : residual of the equations
    members : partial waves of each of `CLASSES`, [(n,)]; classes do not interact
    """

    radiation: np.ndarray
    sent: np.ndarray
    scattered: np.ndarray
    pressed: np.ndarray
    members: list
    residual: float


def answers(body, modes, waves):
    """`Answers` of a `bem.contour.body.ContourBody`.

    modes : `bem.depth_modes.gap.OuterModes`
    waves : [`partial_waves.PartialWaves`], beginning with the propagating mode or, without it, with the first
        evanescent mode
    """
    return _OneShape(body, modes, waves).answers()


class _OneShape:
    def __init__(self, body, modes, waves):
        self.body, self.modes, self.waves, self.a = body, modes, waves, body.plan.reach
        plan, tolerance = body.plan, body.tolerance
        least = max(one.last for one in waves) + 1
        at = (modes.k, plan.table_wavenumber(modes.k))
        self.degree, self.top = (_at_least(plan.degree(k, tolerance), least) for k in at)
        self.contour = plan.contour(modes.k, self.degree, tolerance)
        self.decaying = len(waves) - (waves[0].kind != "decaying")

    def answers(self):
        counts = [2 * one.last + 1 for one in self.waves]
        first, total = np.cumsum([0, *counts]), sum(counts)
        radiation, sent = np.zeros((6, 6), complex), np.zeros((total, 6), complex)
        scattered, pressed = np.zeros((total, total), complex), np.zeros((6, total), complex)
        members, residual = [], 0.0
        for cls in CLASSES:
            own = [d for d in range(6) if class_of(d, "xy") == cls]
            at = [start + self._members(cls, one) for start, one in zip(first, self.waves, strict=False)]
            push, flows, rest = self._solve(cls, own)
            here = np.concatenate(at)
            members.append(here)
            radiation[np.ix_(own, own)] = push[:, : len(own)]
            pressed[np.ix_(own, here)] = push[:, len(own) :]
            sent[np.ix_(here, own)], scattered[np.ix_(here, here)] = np.split(flows, [len(own)], axis=1)
            residual = max(residual, rest)
        return Answers(radiation, sent, scattered, pressed, members, residual)

    def _solve(self, cls, dofs):
        """∬ φ nᵢ dS and what is sent, of motions and then of partial waves of a class, and the residual"""
        d, basis = len(dofs), self.body.plan.basis(cls, self.degree, self.contour)
        weak = 4 * (basis * self.contour.weights[:, None]).T
        maps, rows, norms = self._maps(cls), self.rows, self.norms
        walls, slopes = [], []
        for one, N in zip(self.waves, maps, strict=True):
            value, slope = self._partial(cls, one)
            slopes.append(weak @ slope)
            walls.append(weak @ value - N @ slopes[-1])
        incident = np.hstack([_spread(r, wall) for r, wall in zip(rows, walls, strict=True)])
        fixed, outside = self.body.fixed_terms(cls, self.degree, self.top, tuple(dofs)), self._outside(cls)
        flow = solved(fixed, outside, incident)
        side = fixed.side.reshape(d, 2, -1)
        parts, start = [], d
        for one, wall, slope, r, norm in zip(self.waves, walls, slopes, rows, norms, strict=True):
            velocity = np.tensordot(r[:-2], flow.velocity, 1).astype(complex)
            velocity[:, :d] += np.tensordot(r[-2:], side, (0, 1)).T
            velocity /= norm
            velocity[:, start : start + slope.shape[1]] -= slope
            start += slope.shape[1]
            m = self._orders(cls, one)
            parts.append(-(wall.T @ velocity) / (np.pi * (1 + (m == 0)) * one.wronskian[m])[:, None])
        return loads(fixed, outside, flow, incident), np.vstack(parts), flow.residual

    @cached_property
    def rows(self):
        """Projections of the velocity profiles, and of 1 and z over the side, on each depth mode Zₙ; [(r,)]"""
        known = self.modes.rows[:, : self.decaying].T
        first = [self.modes.wave_rows] if self.decaying < len(self.waves) else []
        return [self.body.profiles.combinations @ one for one in (*first, *known)]

    @property
    def norms(self):
        first = [self.modes.wave_norm] if self.decaying < len(self.waves) else []
        return [*first, *self.modes.norms[: self.decaying]]

    def _maps(self, cls):
        """[N] of each mode between the functions of the plan"""
        k = self.modes.wavenumbers[: self.decaying]
        table = self.body.outer_maps(cls, self.degree, self.top)
        decaying = np.tensordot(self.body.nodes(self.top).weights(k), table, 1) / k[:, None, None]
        return [*([self._first[cls]] if self.decaying < len(self.waves) else []), *decaying]

    @cached_property
    def _first(self):
        """{class: N} of the propagating mode"""
        if self.waves[0].kind == "radiating":
            found = self.body.plan.waves(CLASSES, self.degree, self.modes.k, self.contour, np.empty(0))
            return {cls: one.weak for cls, one in found.items()}
        plan, out, start = self.body.plan, {}, 0
        if self.waves[0].kind == "laplace":
            one = sender(plan, self.degree, 0.0, plan.scale, self.body.accuracy.digits + 1, np.inf)
            whole = Exterior([one], [Place(0.0, 0.0, 0.0)]).map(Kernel("laplace"))
        for cls in CLASSES:
            n = len(plan.subset(cls, self.degree, self.degree))
            out[cls] = (
                whole[start : start + n, start : start + n] if self.waves[0].kind == "laplace" else np.zeros((n, n))
            )
            start += n
        return out

    def _outside(self, cls):
        """Matrix `outside` of `bem.contour.matching.solved`; shape (r n, r n)"""
        m, body = self.modes, self.body
        weights = body.contracted(self.top, m.rows, m.wavenumbers, m.norms, body.profiles.gap.outer_decays)
        one = body.profiles.combinations @ m.wave_rows
        single = np.multiply.outer(one, one) / m.wave_norm
        whole = combined(weights, body.outer_maps(cls, self.degree, self.top), single, self._first[cls])
        return whole.reshape(whole.shape[0] * whole.shape[1], -1)

    def _partial(self, cls, one):
        """R cos mθ or R sin mθ of a class and its normal velocity at the nodes of the contour, two (p, n)"""
        c, m = self.contour, self._orders(cls, one)
        r, theta = np.hypot(c.x, c.y), np.arctan2(c.y, c.x)
        R, slope = (part[:, m] for part in one.regular(self.a, r))
        turn = np.multiply.outer(theta, m)
        even, odd = np.cos(turn), np.sin(turn)
        wave, along = (even, -m * odd) if cls[1] == 1 else (odd, m * even)
        out = ((c.nx * c.x + c.ny * c.y) / r)[:, None]
        around = ((c.ny * c.x - c.nx * c.y) / r**2)[:, None]
        return R * wave, out * slope * wave + around * R * along

    @staticmethod
    def _orders(cls, one):
        """Orders m of the class: those of cos mθ where it is even in y, and even m where it is even in both or in
        neither"""
        first = 0 if cls[0] * cls[1] == 1 else 1
        m = np.arange(first, one.last + 1, 2)
        return m[1:] if cls == (-1, -1) else m

    def _members(self, cls, one):
        m = self._orders(cls, one)
        return m if cls[1] == 1 else one.last + m


def _spread(rows, wall):
    return np.multiply.outer(rows, wall).reshape(-1, wall.shape[1])


def _at_least(degree, least):
    return tuple(max(d, least) for d in degree) if np.ndim(degree) else max(degree, least)
