"""Waves from a plan at points outside the plan: single and double layers, one matrix for each symmetry class.

Densities are given at the m nodes of the plan's quarter contour, in each class.  On a rectangle the layers are
integrated (`plan.layers`).  On a circle the layers are closed forms for the m orders that the nodes distinguish,

                       S at r ≥ R                      D at r ≥ R                        ½ − D on the circle
    decaying           R Iₘ(κR) Kₘ(κr)                 κR Iₘ'(κR) Kₘ(κr)                 1 − D
    waves              (iπ/2) R Jₘ(kR) Hₘ(kr)          (iπ/2) kR Jₘ'(kR) Hₘ(kr)          1 − D
    κ → 0              (R/2m) (R/r)ᵐ,  −R ln r         ½ (R/r)ᵐ,  0                      1 − D

times cos mθ or sin mθ; at r < R, waves only, J and H change places.
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.special import h1vp, hankel1, ive, jv, jvp, kve

from ..plan.circle import Circle
from ..plan.layers import decaying, laplace, layers, radiating
from ..plan.maps import CLASSES, Contour
from ..plan.panels import quarter_panels

PER_GAP = 2.0  # gaps in a panel of a rectangle at most
INSIDE = 8  # points inside a plan at least, for waves
FALLEN = 100.0  # κ(r − R) beyond which a decaying wave is zero; e^(−100) = 4e-44


class Kernel(NamedTuple):
    """kind : "laplace", "decaying" or "radiating"; k : wavenumber, rad/m"""

    kind: str
    k: float = 0.0

    @property
    def layer(self):
        """Function of R that returns G and R ∂G/∂R"""
        return {"decaying": decaying, "radiating": radiating}[self.kind](self.k) if self.k else laplace


def sender(plan, degree, k, gap, digits, shortest):
    """`OnCircle` or `OnRectangle` for functions up to `degree` and waves of k rad/m

    gap : distance to the nearest other plan, m; digits : digits of accuracy; shortest : 1/κ of the fastest decay, m
    """
    if not isinstance(plan, Circle):
        return OnRectangle(plan, degree, k, gap, shortest)
    orders = max(np.max(degree) + 4, digits * np.log(10) / np.arccosh(1 + gap / (2 * plan.radius)))
    return OnCircle(plan, degree, k, orders, 10**-digits)


class OnRectangle:
    """A `Rectangle` with the nodes of its panels"""

    def __init__(self, plan, degree, k, gap, shortest):
        self.plan, fine = plan, plan.for_degree(degree)
        made = fine.panels(k, degree)
        longest = min(PER_GAP * gap, float(made.length.max()))
        if longest < made.length.max():
            corner = [min(float(made.length[made.normal[:, 0] == side][0]), longest) for side in (1, 0)]
            made = quarter_panels(plan.length / 2, plan.beam / 2, corner, [longest] * 2, fine.nodes)
        self.panels, self.count, self.smallest = made, fine.count, 3 * shortest
        self.contour = made.contour
        self.bases = {cls: plan.basis(cls, degree, self.contour) for cls in CLASSES}
        along, across = _scattered(k * np.hypot(plan.length, plan.beam) / 4)
        self.inside = _points(0.45 * plan.length * along, 0.45 * plan.beam * across)

    @cached_property
    def _own(self):
        return self._layers(self.contour.x, self.contour.y, np.arange(len(self.contour.x)))

    def own(self, kernel):
        """½ − D and S at the nodes, {class: two (m, m)}"""
        S, D = self._own.matrices(kernel.layer, CLASSES)
        half = np.eye(S.shape[-1]) / 2
        return {cls: (half - D[c], S[c]) for c, cls in enumerate(CLASSES)}

    def at(self, x, y):
        """Function of a `Kernel` that gives S and D at points (p,) off the contour, {class: two (p, m)}"""
        known = self._layers(x, y, np.full(len(x), -1))

        def sent(kernel):
            S, D = known.matrices(kernel.layer, CLASSES)
            return {cls: (S[c], D[c]) for c, cls in enumerate(CLASSES)}

        return sent

    def _layers(self, x, y, own):
        return layers(self.panels, x, y, own, self.count, self.smallest)


class OnCircle:
    """A `Circle` with as many nodes on its quarter as there are orders in a symmetry class"""

    def __init__(self, plan, degree, k, orders, tolerance):
        self.plan = plan
        self.contour = plan.contour(k, int(np.ceil(orders)), tolerance)
        self.bases = {cls: plan.basis(cls, degree, self.contour) for cls in CLASSES}
        count = len(self.contour.x)
        self.orders = {cls: plan.orders(cls, 2 * count)[:count] for cls in CLASSES}
        theta = np.arctan2(self.contour.y, self.contour.x)
        self.coefficients = {cls: np.linalg.inv(_turned(cls, self.orders[cls], theta)) for cls in CLASSES}
        along, around = _scattered(k * plan.radius / 2)
        r, turn = plan.radius * (0.3 + 0.6 * along), np.pi / 2 * around
        self.inside = _points(r * np.cos(turn), r * np.sin(turn))

    def own(self, kernel):
        """½ − D and S at the nodes, {class: two (m, m)}"""
        theta = np.arctan2(self.contour.y, self.contour.x)
        S, D = _on_circle(kernel, self.plan.radius, np.array([self.plan.radius]), self._last)
        out = {}
        for cls, m in self.orders.items():
            turn, known = _turned(cls, m, theta), self.coefficients[cls]
            out[cls] = (turn * (1 - D[0, m])) @ known, (turn * S[0, m]) @ known
        return out

    def at(self, x, y):
        """Function of a `Kernel` that gives S and D at points (p,) off the circle, {class: two arrays (p, m)}"""
        r, theta = np.hypot(x, y), np.arctan2(y, x)

        def sent(kernel):
            S, D = _on_circle(kernel, self.plan.radius, r, self._last)
            out = {}
            for cls, m in self.orders.items():
                turn, known = _turned(cls, m, theta), self.coefficients[cls]
                out[cls] = (turn * S[:, m]) @ known, (turn * D[:, m]) @ known
            return out

        return sent

    @property
    def _last(self):
        return max(int(m[-1]) for m in self.orders.values())


def _turned(cls, m, theta):
    turn = np.multiply.outer(theta, m)
    return np.cos(turn) if cls[1] == 1 else np.sin(turn)


def _scattered(further):
    """Points of a unit square in irrational steps, `INSIDE` and so many `further`, two (n,)"""
    n = np.arange(1, int(INSIDE + further) + 1)
    return (n * (np.sqrt(5) - 1) / 2) % 1.0, (n * (np.sqrt(2) - 1)) % 1.0


def _points(x, y):
    none = np.zeros_like(x)
    return Contour(x, y, none, none, none)


def _on_circle(kernel, R, r, last):
    """S and D of orders 0 … `last` at distances r (p,) from the middle, two (p, last + 1)"""
    m, r = np.arange(last + 1), r[:, None]
    with np.errstate(all="ignore"):
        power = (np.minimum(R, r) / np.maximum(R, r)) ** m
        far = R / (2 * np.maximum(m, 1)) * power, np.where(r < R, -0.5, 0.5) * power
        if kernel.kind == "laplace":
            far[0][:, 0], far[1][:, 0] = -R * np.log(r[:, 0]), 0.0
            return far
        x, y = kernel.k * R, kernel.k * r
        if kernel.kind == "decaying":
            fall = kve(m, y) * np.exp(x - y)
            slope = ive(m - 1, x) - m / x * ive(m, x)
            slope[0] = ive(1, x)
            found = R * ive(m, x) * fall, x * slope * fall
            far = tuple(part * (y - x < FALLEN) for part in far)
        else:
            out = r >= R
            one = np.where(out, jv(m, x) * hankel1(m, y), hankel1(m, x) * jv(m, y))
            two = np.where(out, jvp(m, x) * hankel1(m, y), h1vp(m, x) * jv(m, y))
            found = 0.5j * np.pi * R * one, 0.5j * np.pi * x * two
    # powers replace the functions where I and J underflow and K and H overflow
    return tuple(np.where(np.isfinite(part) & (part != 0), part, limit) for part, limit in zip(found, far, strict=True))
