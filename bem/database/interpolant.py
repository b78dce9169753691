"""Functions of frequency from few values of them, with an estimate of the error in between.

Kernel interpolation (Gaussian-process regression without noise): with kernel κ, nodes x and values f

    f(y) ≈ κ(y, x) κ(x, x)⁻¹ f,    variance σ² [κ(y, y) − κ(y, x) κ(x, x)⁻¹ κ(x, y)],    σ² = f* κ(x, x)⁻¹ f / n

(Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, eqs 2.25, 2.26).  What waves and a body of
length L make of each other is smooth in frequency but for echoes: what returns from a distance d turns like exp(ikd),
one-sidedly because it returns later.  So

    κ(x, y) = exp(−(s − t)²/2ℓ²) Σⱼ aⱼ exp(i(k − q) dⱼ),    s = ½ (ω √(L/g) + √(kL)),    Σ aⱼ = 1

with s, k of x and t, q of y.  Waves first met at the distance `lead` ahead of the origin turn by exp(−ik lead), which
is taken out before and put back after.  No one ℓ and no one row of echoes serves all: every member of a family is
fitted and counts by the inverse fourth power of its error at nodes left out (Rippa, Adv. Comput. Math. 11, 1999).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..waves import wavenumber

NUGGET = 1e-9  # of the kernel's diagonal: keeps its factor to about seven digits
ROUNDING = 2 * NUGGET  # variance, relative, that is not distinguished from none: nodes have half of it


class Abscissa(NamedTuple):
    """Frequencies as the kernel sees them: s and kL of `interpolant`, both (n,)"""

    smooth: np.ndarray
    phase: np.ndarray


class Member(NamedTuple):
    """A kernel of the family.

    reach : ℓ, but at most `nodes` mean distances of the nodes; delays : dⱼ in lengths of the body, with their
    weights aⱼ; lead : share of the `lead` that is taken out
    """

    reach: float
    nodes: float
    delays: np.ndarray
    weights: np.ndarray
    lead: float

    def kernel(self, x, y):
        """κ(x, y) (n, m) complex"""
        turn = np.exp(1j * np.multiply.outer(x.phase, self.delays))
        back = np.exp(-1j * np.multiply.outer(y.phase, self.delays))
        return np.exp(-0.5 * ((x.smooth[:, None] - y.smooth) / self.reach) ** 2) * ((turn * self.weights) @ back.T)


def _echoes(step, ratio, last):
    """Delays 0, step … last, each `ratio` times the one before"""
    delays = np.arange(0, last + step / 2, step)
    weights = ratio ** np.arange(len(delays))
    return delays, weights / weights.sum()


# what each of them gains, and on which bodies: tests/bench/fit_interpolation.py
_ROWS = (
    _echoes(1.0, 0.0, 0.0),
    *(_echoes(1.0, ratio, 2.0) for ratio in (0.05, 0.1, 0.2)),
    *(_echoes(0.5, ratio, 2.0) for ratio in (0.2, 0.4)),
    *(_echoes(0.1, np.exp(-0.1 / decay), 2.5) for decay in (0.1, 0.2)),
)
_REACHES = ((1.2, 4.8), (1.8, 7.2), (2.5, 10.0), (3.5, 14.0))  # wider ones cost digits and gain nothing
FAMILY = tuple(Member(*reach, *row, lead) for reach in _REACHES for row in _ROWS for lead in (1.0, 0.7))
SPREAD = Member(
    1.2, np.inf, *_echoes(0.1, np.exp(-0.1 / 0.12), 2.5), 1.0
)  # by which nodes are spread, knowing no value


def abscissa(omega, depth, gravity, length):
    """`Abscissa` of omega (n,) rad/s for a body of `length` m in water of `depth` m (may be inf)"""
    omega = np.atleast_1d(np.asarray(omega, float))
    kL = wavenumber(omega, depth, gravity) * length
    return Abscissa(0.5 * (omega * np.sqrt(length / gravity) + np.sqrt(kL)), kL)


@dataclass(frozen=True, eq=False)
class Interpolant:
    """Columns of values (n, c) at x; lead (c,) in lengths of the body.  Complex values are one-sided, real ones not."""

    x: Abscissa
    values: np.ndarray
    lead: np.ndarray

    def __call__(self, y):
        """Values (m, c) at y and their standard deviations (m, c), those of the modulus if complex."""
        value, square, deviation = 0.0, 0.0, 0.0
        for member, (weight, coefficients, scale, root) in zip(FAMILY, self._members, strict=True):
            row = self._kernel(member, y, self.x)
            guess = (row @ coefficients) * np.conj(self._turn(member, y))
            left = np.maximum(_left_open(row, root) - ROUNDING, 0)
            value = value + weight * guess
            square = square + weight * np.abs(guess) ** 2
            deviation = deviation + weight * np.sqrt(np.outer(left, scale))
        value = value if np.iscomplexobj(self.values) else value.real
        return value, np.sqrt(deviation**2 + np.maximum(square - np.abs(value) ** 2, 0))

    @cached_property
    def _distance(self):
        return np.ptp(self.x.smooth) / (len(self.x.smooth) - 1)

    def _kernel(self, member, x, y):
        kernel = member._replace(reach=min(member.reach, member.nodes * self._distance)).kernel(x, y)
        return kernel if np.iscomplexobj(self.values) else kernel.real

    def _turn(self, member, x):
        return np.exp(1j * member.lead * np.multiply.outer(x.phase, self.lead))

    @cached_property
    def _members(self):
        """Of each member: weight (c,), coefficients (n, c), σ² (c,), `_root` (n, n)"""
        fits, errors = [], []
        for member in FAMILY:
            root = _root(self._kernel(member, self.x, self.x))
            whitened = root @ (self.values * self._turn(member, self.x))
            coefficients = root.conj().T @ whitened
            left_out = np.abs(coefficients) / np.sum(np.abs(root) ** 2, axis=0)[:, None]
            errors.append(np.sum(left_out**2, axis=0))
            fits.append((coefficients, np.mean(np.abs(whitened) ** 2, axis=0), root))
        best = np.maximum(np.min(errors, axis=0), np.finfo(float).tiny)
        weights = (best / np.maximum(errors, best)) ** 2
        weights /= weights.sum(axis=0)
        return [(weight, *fit) for weight, fit in zip(weights, fits, strict=True)]


def _root(kernel):
    """R (n, n) of the inverse R*R of a kernel among nodes and its nugget"""
    return np.linalg.inv(np.linalg.cholesky(kernel + NUGGET * np.eye(len(kernel))))


def _left_open(row, root):
    """(m,) share of the variance that nodes leave open at m places, from the kernel between these and those (m, n)

    By the inverse itself, with entries of 1e9, it would be noise of 1e-7: that stood for an error of half a per cent of
    added mass in long waves, where a hundredth of a per cent was true.
    """
    return 1 - np.sum(np.abs(row @ root.conj().T) ** 2, axis=1)


def unknown(x, y):
    """(m,) share of the variance of `SPREAD` that values at x leave open at y"""
    return _left_open(SPREAD.kernel(y, x), _root(SPREAD.kernel(x, x)))


def chosen(x, y, count):
    """Indices of `count` of the points y (m,) to be known next, one after the other, when x are known.

    It is where `unknown` is largest; when that is the nugget, which it cannot tell from
    nothing, where the next known point is farthest away.
    """
    new = []
    for _ in range(count):
        known = Abscissa(*(np.concatenate([a, b[new]]) for a, b in zip(x, y, strict=True)))
        left_open = unknown(known, y)
        if left_open.max() < 2 * NUGGET:
            left_open = np.abs(y.smooth[:, None] - known.smooth).min(axis=1)
        new.append(int(np.argmax(left_open)))
    return new
