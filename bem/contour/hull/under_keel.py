"""Flow under the keel of a vertical cylinder, on its bottom.

With the velocity u in the gap and the particular solution ψ of `bem.contour.rigid_motions`, on ζ = s

    φ = ψ + c + Σ_q (ε_q/s) (−1)^q Iₘ(l_q r)/l_q Iₘ'(l_q R) ⟨u − ∂ψ/∂n, cos l_qζ⟩,        q = 0: r^m / m R^(m−1)

in every order m about the axis.  At a distance ρ = R − r from the keel the modes l_q beyond TERMS/ρ have decayed.
Nearer than START of the smallest of draft, gap and radius the flow is the flow around the edge,

    φ = c₀ − Uρ − (2b/3π) ρ² ln ρ + Σ cₚ ρ^(2p/3),        p = 1, 2, 3,

where U is the outward speed of the keel's edge, and b the rate at which the edge turns (see `bem.contour.side_flow`).
"""

from functools import cached_property

import numpy as np
from scipy.special import ive, xlogy

from ..plan.panels import gauss_rule

TERMS = 36.0  # exp(−36) is 2e-16
START, END = 0.01, 4.0
POWERS = np.array([0, 2, 4, 6]) / 3
POINTS = 10  # quadrature points on a panel of radii


class UnderKeel:
    """Points (p, 3) on the quarter x > 0, y > 0 of the bottom, radius by radius, with weights (p,) m² and normals

    body : `bem.contour.body.ContourBody` of a circle; degree : highest degree of its functions; contour : `Contour`
        with the directions of the radii
    """

    def __init__(self, body, degree, contour):
        self.body, self.degree, self.radius = body, degree, body.plan.radius
        self.theta = np.arctan2(contour.y, contour.x)
        gap = body.profiles.gap
        self.start = START * min(gap.draft, gap.height, self.radius)
        self.near, near_weights = _graded(END * self.start)
        far, far_weights = _doubling(END * self.start, self.radius)
        self.rho = np.concatenate([self.near, far])
        r = self.radius - self.rho
        weights = np.concatenate([near_weights, far_weights]) * r
        self.weights = np.multiply.outer(weights, contour.weights / self.radius).ravel()
        turn = np.stack([np.cos(self.theta), np.sin(self.theta)], axis=1)
        self.points = np.full((len(self.weights), 3), -gap.draft)
        self.points[:, :2] = (r[:, None, None] * turn).reshape(-1, 2)
        self.normals = np.tile([0.0, 0.0, -1.0], (len(self.weights), 1))
        angles = np.pi * (np.arange(len(POWERS)) + 0.5) / len(POWERS)
        a, b = np.array([self.start, END * self.start]) ** (2 / 3)
        self.found = ((a + b) / 2 + (b - a) / 2 * np.cos(angles)) ** 1.5  # Chebyshev's points in ρ^(2/3)

    def flow(self, freq, cls):
        """φ, (columns, p), and ∇φ along the bottom, (columns, p, 3), of a solved frequency that has these functions"""
        value, slope = self._radial(freq, cls)
        plan, r = self.body.plan, self.radius - self.rho
        m = plan.orders(cls, self.degree)
        scale = 1 / np.sqrt(np.pi * self.radius * np.where(m, 1, 2))
        even, turn = cls[1] == 1, np.multiply.outer(self.theta, m)
        around, turned = (np.cos(turn), -np.sin(turn)) if even else (np.sin(turn), np.cos(turn))
        around, turned = around * scale, turned * scale * m
        shape = value.shape[-1], -1
        value, slope = (np.moveaxis(part, -1, 0) for part in (value, slope))  # (c, q, n)
        out, outward = value @ around.T, slope @ around.T
        across = value @ turned.T / r[:, None]
        c, s = np.cos(self.theta), np.sin(self.theta)
        gradient = np.stack([outward * c - across * s, outward * s + across * c, 0 * out], axis=-1)
        return out.reshape(shape), gradient.reshape(*shape, 3)

    def _radial(self, freq, cls):
        """φ and ∂φ/∂r (q, n, columns) of the orders of a class at the radii of the points"""
        dofs, _, sides, flow = freq.flows[cls]
        body, n, moving = self.body, flow.velocity.shape[1], len(dofs)
        own = body.plan.subset(cls, self.degree, freq.top)
        velocity = np.concatenate([flow.velocity, np.zeros((2, *flow.velocity.shape[1:]))])
        for column, dof in enumerate(dofs):
            velocity[-2:, :, column] = -body.motion(dof, freq.top).slope[:, own]
        rho = np.concatenate([self.found, self.rho[len(self.near) :]])
        maps = self._maps(cls)
        gap = velocity.swapaxes(0, 1)  # (n, r, c)
        out = [np.matmul(part.swapaxes(0, 1), gap).swapaxes(0, 1) for part in maps]
        for column, dof in enumerate(dofs):
            for part, own_flow in zip(out, self._particular(dof, self.radius - rho, n), strict=True):
                part[:, :, column] += own_flow
        unit = body.unit(cls, freq.top)
        if unit is not None:
            out[0] += unit[own][:, None] * flow.constant
        edge = np.zeros((2, n, flow.velocity.shape[2]))  # U and b
        edge[0, :, :moving] = (sides[:, 0] - body.draft * sides[:, 1]).T
        edge[1, :, :moving] = sides[:, 1].T
        return self._with_edge(out, edge)

    def _with_edge(self, parts, edge):
        """φ and ∂φ/∂r at all points, from those at `found` and behind the edge"""
        count = len(self.found)
        known = np.tensordot(_edge(self.found)[0], edge, 1)
        c = np.linalg.solve(self.found[:, None] ** POWERS, (parts[0][:count] - known).reshape(count, -1)).reshape(
            count, *edge.shape[1:]
        )
        rho = self.near[:, None]
        powers = rho**POWERS, POWERS * rho ** np.where(POWERS == 0, 0.0, POWERS - 1)
        near = [np.tensordot(p, c, 1) + np.tensordot(e, edge, 1) for p, e in zip(powers, _edge(self.near), strict=True)]
        return [np.concatenate([a, b[count:]]) for a, b in zip((near[0], -near[1]), parts, strict=True)]

    def _maps(self, cls):
        """φ and ∂φ/∂r (q, n, r) of velocities in the gap by their rows, at `found` and behind the edge"""
        rows = self.body.plan.orders(cls, self.degree)
        return [part[:, rows] for part in self._all_maps]

    @cached_property
    def _all_maps(self):
        """Two (q, degree + 1, r) of all orders"""
        body, gap, s = self.body, self.body.profiles.gap, self.body.profiles.height
        rho = np.concatenate([self.found, self.rho[len(self.near) :]])
        m = np.arange(self.degree + 1)
        modes = gap.inner_modes(int(np.ceil(TERMS * s / (np.pi * rho.min()))))
        rows = (body.profiles.combinations @ modes.rows).T * (2 / s * np.cos(modes.wavenumbers * s))[:, None]
        out = np.zeros((2, len(rho), len(m), rows.shape[1]))
        R = self.radius
        for q, distance in enumerate(rho):
            count = max(4, int(np.ceil(TERMS * s / (np.pi * distance))))
            l, r = modes.wavenumbers[:count], R - distance
            at_wall = _bessel(self.degree, l * R)[1]
            value, slope = _bessel(self.degree, l * r, l * distance)
            out[0, q], out[1, q] = (value / (l * at_wall)) @ rows[:count], (slope / at_wall) @ rows[:count]
            mean = body.profiles.mean_rows / s
            share = np.where(m, R / np.maximum(m, 1) * (r / R) ** m, 0.0)
            out[0, q] += np.multiply.outer(share, mean)
            out[1, q] += np.multiply.outer(share * m / r, mean)
        return out

    def _particular(self, dof, r, n):
        """ψ and ∂ψ/∂r on the bottom (q, n), of a motion of unit velocity"""
        out, s = np.zeros((2, len(r), n)), self.body.profiles.height
        if dof == 2:
            out[0, :, 0], out[1, :, 0] = (s * s - r * r / 2) / (2 * s), -r / (2 * s)
            out *= np.sqrt(2 * np.pi * self.radius)
        if dof in (3, 4):
            out[0, :, 0], out[1, :, 0] = (s * s * r - r**3 / 4) / (2 * s), (s * s - 0.75 * r * r) / (2 * s)
            out *= np.sqrt(np.pi * self.radius) * (1 if dof == 3 else -1)
        return out


def _bessel(last, x, decay=0.0):
    """Iₘ and Iₘ' of order 0 … last, both times exp(−x − decay), (last + 1, x) each"""
    m = np.arange(last + 2)[:, None]
    value = ive(m, x) * np.exp(-decay)
    slope = np.concatenate([value[1:2], 0.5 * (value[:-2] + value[2:])])
    return value[:-1], slope[: last + 1]


def _edge(rho):
    """−ρ and −(2/3π) ρ² ln ρ, and their derivatives along ρ, two (q, 2)"""
    value = np.stack([-rho, -2 / (3 * np.pi) * xlogy(rho, rho) * rho], axis=1)
    return value, np.stack([-1 + 0 * rho, -2 / (3 * np.pi) * (2 * xlogy(rho, rho) + rho)], axis=1)


def _graded(end):
    """Distances below `end` and weights, m, in t = (ρ/end)^(1/3)"""
    t, w = gauss_rule(POINTS)
    return end * t**3, 3 * end * t**2 * w


def _doubling(start, last):
    """Distances from `start` to `last` and weights, m, on panels that double away from `start`"""
    edges = np.append(start * 2.0 ** np.arange(max(1, int(np.ceil(np.log2(last / start))))), last)
    t, w = gauss_rule(POINTS)
    length = np.diff(edges)[:, None]
    return (edges[:-1, None] + length * t).ravel(), (length * w).ravel()
