"""Interpolation of functions of frequency between few values, with an estimate of its error.

Kernel interpolation (Gaussian-process regression without noise): with kernel κ, nodes x and values f

    f(y) ≈ κ(y, x) κ(x, x)⁻¹ f,    variance σ² [κ(y, y) − κ(y, x) κ(x, x)⁻¹ κ(x, y)],    σ² = f* κ(x, x)⁻¹ f / n

(Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, eqs 2.25, 2.26).  Hydrodynamic
quantities of a body of length L are smooth in frequency but for echoes: a wave that returns from a distance d has the
phase exp(ikd), d > 0 because it returns later.  So

    κ(x, y) = exp(−(s − t)²/2ℓ²) Σⱼ aⱼ exp(i(k − q) dⱼ),    s = ½ (ω √(L/g) + √(kL)),    Σ aⱼ = 1

with s, k of x and t, q of y.  Water that rings, in a moonpool or a gap, is a pole s_p that all quantities of the body
share (`bem.kernels.poles`), and adds h_p(s) h_p(t)* to the kernel, h_p = c / (s − s_p).  Waves that meet the hull at
the distance `lead` ahead of the origin have the phase exp(−ik lead), which is removed before the fit.  No single ℓ and
set of echoes fits all quantities: every member of a family is fitted and weighted by the inverse fourth power of its
error at nodes left out (Rippa, Adv. Comput. Math. 11, 1999).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..kernels.poles import poles
from ..waves import wavenumber

RINGING = 100.0  # variance of water that rings, at the node where it is largest
NUGGET = 1e-9  # regularisation relative to the kernel's diagonal; its factorisation keeps about seven digits
ROUNDING = 2 * NUGGET  # variance, relative, that is not distinguished from none: nodes have half of it
LEADS = (1.0, 0.7)  # shares of the `lead` that are subtracted
BLOCK = 256  # places handled at once
KEPT = 1 << 27  # bytes of rows kept for the next function at the same frequencies
WINDOW = 64  # nodes that are fitted together
SHARP = 0.3  # largest imaginary part of a pole, in units of s, that counts as sharp
SEEN = 0.01  # fraction of the largest value
MOST_RINGING, FEW_KERNELS = 8, 9  # poles that are tried, with one kernel of so many
# largest ratio of squared errors at left-out nodes, with and without a pole, at which the pole is accepted
BELIEVED = 0.1
SAMPLE = 15  # functions of a group that stand for all of them


class Abscissa(NamedTuple):
    """Arguments of the kernel: s and kL of `interpolant`, both (n,)"""

    smooth: np.ndarray
    phase: np.ndarray


class Member(NamedTuple):
    """A kernel of the family.

    reach : ℓ, but at most `nodes` mean distances of the nodes; delays : dⱼ in lengths of the body, with their
    weights aⱼ; lead : share of the `lead` that is removed
    """

    reach: float
    nodes: float
    delays: np.ndarray
    weights: np.ndarray
    lead: float

    def kernel(self, x, y):
        """κ(x, y) (n, m) complex"""
        return _decay(x, y, self.reach) * _returned(x, y, self.delays, self.weights)


def _decay(x, y, reach):
    """exp(−(s − t)²/2ℓ²) (n, m)"""
    return np.exp(-0.5 * ((x.smooth[:, None] - y.smooth) / reach) ** 2)


def _returned(x, y, delays, weights):
    """Σⱼ aⱼ exp(i(k − q) dⱼ) (n, m)"""
    phase = np.exp(1j * np.multiply.outer(x.phase, delays))
    back = np.exp(-1j * np.multiply.outer(y.phase, delays))
    return (phase * weights) @ back.T


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
FAMILY = tuple(Member(*reach, *row, lead) for reach in _REACHES for row in _ROWS for lead in LEADS)
SPREAD = Member(
    1.2, np.inf, *_echoes(0.1, np.exp(-0.1 / 0.12), 2.5), 1.0
)  # kernel that spreads the nodes before any value is known


def abscissa(omega, depth, gravity, length):
    """`Abscissa` of omega (n,) rad/s for a body of `length` m in water of `depth` m (may be inf)"""
    omega = np.atleast_1d(np.asarray(omega, float))
    kL = wavenumber(omega, depth, gravity) * length
    return Abscissa(0.5 * (omega * np.sqrt(length / gravity) + np.sqrt(kL)), kL)


class Rows(NamedTuple):
    """Every kernel of the family between nodes x (n,) and places y (q,), whatever is fitted.

    cardinal : (kernels, q, n) value at y of what is 1 at one node and 0 at the others; left : (kernels, q) share of
    the variance that remains
    """

    cardinal: np.ndarray
    left: np.ndarray


@dataclass(frozen=True, eq=False)
class Nodes:
    """Frequencies at which functions are known, and the weights of a fit; real functions take the real part of κ.

    x : Abscissa (n,)
    """

    x: Abscissa
    real: bool = False
    ringing: np.ndarray = field(default_factory=lambda: np.zeros(0, complex))
    _kept: dict = field(default_factory=dict, repr=False)

    @cached_property
    def roots(self):
        """(kernels, n, n) `_root` of each kernel"""
        return _root(self._kernels(self.x, self.x))

    def rows(self, y):
        """`Rows` at the places y; those asked for last are kept"""
        key = y.smooth.tobytes()
        if key not in self._kept:
            made = self._rows(y)
            while self._kept and sum([rows.cardinal.nbytes for rows in (made, *self._kept.values())]) > KEPT:
                del self._kept[next(iter(self._kept))]
            self._kept[key] = made
        return self._kept[key]

    def _rows(self, y):
        whitened = self._kernels(y, self.x) @ self.roots.conj().swapaxes(1, 2)
        own = 1 + np.sum(np.abs(self._ringing(y)) ** 2, axis=1)
        left = np.maximum(own - np.sum(whitened.real**2 + whitened.imag**2, axis=2) - ROUNDING, 0)
        return Rows(whitened @ self.roots, left)

    def _kernels(self, x, y):
        """κ(x, y) of each kernel of the family, (kernels, n, m)"""
        distance = np.ptp(self.x.smooth) / max(len(self.x.smooth) - 1, 1)
        decays, echoes, kernels = {}, {}, []
        for member in _kernels()[0]:
            reach, row = min(member.reach, member.nodes * distance), member.delays.tobytes() + member.weights.tobytes()
            if reach not in decays:
                decays[reach] = _decay(x, y, reach)
            if row not in echoes:
                made = _returned(x, y, member.delays, member.weights)
                echoes[row] = made.real if self.real else made
            kernels.append(decays[reach] * echoes[row])
        rung = self._ringing(x) @ self._ringing(y).conj().T
        return np.array(kernels) + (rung.real if self.real else rung)

    def _ringing(self, y):
        """h (q, p) of the module at y"""
        nearest = np.abs(self.x.smooth[:, None] - self.ringing).min(axis=0)
        return np.sqrt(RINGING) * nearest / (y.smooth[:, None] - self.ringing)


@dataclass(frozen=True, eq=False)
class Interpolant:
    """Functions known at `nodes`: values (n, g, c), lead (g, c) or (1, c), of all groups, in lengths of the body.

    The c functions of a group share the weights of the members and their estimated error: a Kochin function at its
    angles is one group, a coefficient a group by itself.  Complex values are one-sided, real ones not.
    """

    nodes: Nodes
    values: np.ndarray
    lead: np.ndarray

    def value(self, y):
        """(q, g, c) at y; at the nodes what is known there but for the nugget"""
        return np.concatenate([self._value(part) for part in _blocks(y)])

    def deviation(self, y):
        """(q, g) standard deviations of the modulus, in the mean over the functions of a group"""
        return np.concatenate([self._deviation(part) for part in _blocks(y)])

    def _value(self, y):
        value, rows = 0.0, self.nodes.rows(y)
        for lead, chosen in _by_lead():
            mixed = np.tensordot(self._weights[chosen].T, rows.cardinal[_kernels()[1][chosen]], axes=1)
            part = np.matmul(mixed, self._shifted[lead]).swapaxes(0, 1)
            value = value + part * self._phase(-lead, y, self.lead)
        return value if np.iscomplexobj(self.values) else value.real

    def _deviation(self, y):
        rows, mean, square, left = self.nodes.rows(y), 0.0, 0.0, 0.0
        values, leads = self._sample
        for lead, chosen in _by_lead():
            shifted = (values * self._phase(lead, self.nodes.x, leads)).reshape(len(values), -1)
            kernels = _kernels()[1][chosen]
            guess = (rows.cardinal[kernels] @ shifted).reshape(len(chosen), -1, *values.shape[1:])
            guess = guess * self._phase(-lead, y, leads)
            weight = self._weights[chosen][:, None, :, None]
            mean = mean + np.sum(weight * guess, axis=0)
            square = square + np.sum(weight * np.abs(guess) ** 2, axis=0)
            open_ = np.sqrt(rows.left[kernels][:, :, None] * self._scale[chosen][:, None])
            left = left + np.sum(self._weights[chosen][:, None] * open_, axis=0)
        spread = np.maximum(square - np.abs(mean) ** 2, 0).mean(axis=-1)
        return np.sqrt(left**2 + spread)

    @cached_property
    def _shifted(self):
        """{lead: values (g, n, c) with that taken out}"""
        return {
            lead: np.ascontiguousarray((self.values * self._phase(lead, self.nodes.x, self.lead)).swapaxes(0, 1))
            for lead in LEADS
        }

    @cached_property
    def _sample(self):
        """Values (n, g, s) and leads (g, s) of some functions of each group, that stand for all in its weights"""
        some = slice(None, None, max(1, self.lead.shape[1] // SAMPLE))
        return self.values[:, :, some], self.lead[:, some]

    def _phase(self, lead, x, leads):
        """(n, g, c); a symmetric hull has most leads four times, and exponentials take longer than all the rest"""
        distinct, place = np.unique(leads, return_inverse=True)
        phase = np.exp(1j * lead * np.multiply.outer(x.phase, distinct))
        return phase[:, place.reshape(leads.shape)]

    @cached_property
    def _fits(self):
        """Weights (members, g) and σ² (members, g)"""
        errors, scales = [], []
        values, leads = self._sample
        shifted = {lead: (values * self._phase(lead, self.nodes.x, leads)).reshape(len(values), -1) for lead in LEADS}
        for member, root in zip(FAMILY, self.nodes.roots[_kernels()[1]], strict=True):
            whitened = root @ shifted[member.lead]
            left_out = np.abs(root.conj().T @ whitened) / np.sum(np.abs(root) ** 2, axis=0)[:, None]
            errors.append(np.sum(left_out**2, axis=0).reshape(values.shape[1:]).sum(axis=-1))
            scales.append(np.mean(np.abs(whitened) ** 2, axis=0).reshape(values.shape[1:]).mean(axis=-1))
        best = np.maximum(np.min(errors, axis=0), np.finfo(float).tiny)
        weights = (best / np.maximum(errors, best)) ** 2
        return weights / weights.sum(axis=0), np.array(scales)

    @property
    def _weights(self):
        return self._fits[0]

    @property
    def _scale(self):
        return self._fits[1]


class Window(NamedTuple):
    """Nodes `first` to `last` of all, and the gaps `low` to `high` between nodes for which they serve"""

    nodes: Nodes
    first: int
    last: int
    low: int
    high: int


def windows(x, real=False, ringing=()):
    """`Window`s of nodes x (n,) rising: all in one, or where there are many, some with neighbours on both sides

    ringing : (p,) poles of the water, in the variable s of x
    """
    ringing = np.array(ringing, complex)
    n, out = len(x.smooth), []
    count = 1 if n <= WINDOW else int(np.ceil(2 * n / WINDOW))
    ends = np.linspace(0, max(n - 1, 1), count + 1).astype(int)
    for low, high in pairwise(ends):
        first, last = max(low - WINDOW // 4, 0), min(high + WINDOW // 4 + 1, n)
        out.append(Window(Nodes(Abscissa(*(part[first:last] for part in x)), real, ringing), first, last, low, high))
    return out


@dataclass(frozen=True, eq=False)
class Joined:
    """An `Interpolant` in each of `windows` of nodes x, arguments as there, from node to node.

    What a fit lacks at its nodes, the share of the nugget, is put back by straight lines: nodes have their values, and
    where one window takes over from another nothing jumps.  So has the deviation, none at the nodes: damping of a
    thousandth of its largest, which decides a resonance, is known beside a node as well as at it.  Groups that are zero
    at every node, as most couplings of a symmetric body, are zero between, and nothing is fitted to them.
    """

    x: Abscissa
    windows: list
    values: np.ndarray
    lead: np.ndarray

    def value(self, y):
        """(q, g, c) at y"""
        gap, share = self._place(y)
        out = np.zeros((len(gap), *self.values.shape[1:]), self.values.dtype)
        for part in self._parts:
            here = (gap >= part.window.low) & (gap < part.window.high)
            if here.any():
                i, t = gap[here] - part.window.first, share[here][:, None, None]
                fitted = part.fit.value(Abscissa(*(axis[here] for axis in y)))
                out[np.ix_(here, self._moving)] = fitted + (1 - t) * part.lack[i] + t * part.lack[i + 1]
        return out

    def deviation(self, y):
        """(q, g) standard deviations of the modulus, in the mean over the functions of a group"""
        gap, share = self._place(y)
        out = np.zeros((len(gap), self.values.shape[1]))
        for part in self._parts:
            here = (gap >= part.window.low) & (gap < part.window.high)
            if here.any():
                i, t, at_nodes = gap[here] - part.window.first, share[here][:, None], part.at_nodes
                known = ((1 - t) * at_nodes[i] ** 2 + t * at_nodes[i + 1] ** 2) * (1 - 2 * t) ** 2
                open_ = part.fit.deviation(Abscissa(*(axis[here] for axis in y))) ** 2 - known
                out[np.ix_(here, self._moving)] = np.sqrt(np.maximum(open_, 0))
        return out

    def _place(self, y):
        """Number of the gap between nodes and the share of it that lies below, each (q,)"""
        s = self.x.smooth
        gap = np.clip(np.searchsorted(s, y.smooth, side="right") - 1, 0, len(s) - 2)
        return gap, (y.smooth - s[gap]) / (s[gap + 1] - s[gap])

    @cached_property
    def _moving(self):
        """Groups that are not zero at every node"""
        return np.any(self.values != 0, axis=(0, 2))

    @cached_property
    def _parts(self):
        """A `Part` for each window, none where nothing moves"""
        moving, lead = self.values[:, self._moving], self.lead if len(self.lead) == 1 else self.lead[self._moving]
        windows = self.windows if moving.size else ()
        return [Part(w, Interpolant(w.nodes, moving[w.first : w.last], lead)) for w in windows]


@dataclass(frozen=True, eq=False)
class Part:
    """An `Interpolant` in a `Window`; nothing is fitted before it is asked for"""

    window: Window
    fit: Interpolant

    @cached_property
    def lack(self):
        """(n, g, c) what the fit lacks at its nodes"""
        return self.fit.values - self.fit.value(self.window.nodes.x)

    @cached_property
    def at_nodes(self):
        """(n, g) deviation at the nodes"""
        return self.fit.deviation(self.window.nodes.x)


def _blocks(y):
    return [Abscissa(*(part[i : i + BLOCK] for part in y)) for i in range(0, max(len(y.smooth), 1), BLOCK)]


@cache
def _kernels():
    """Members of the family that differ in more than their lead, and (members,) which of them is each member's"""
    number, first = {}, []
    place = [
        number.setdefault((m.reach, m.nodes, m.delays.tobytes(), m.weights.tobytes()), len(number)) for m in FAMILY
    ]
    for i, kernel in enumerate(place):
        if kernel == len(first):
            first.append(FAMILY[i])
    return first, np.array(place)


@cache
def _by_lead():
    """(lead, its members) of the family"""
    leads = np.array([member.lead for member in FAMILY])
    return [(lead, np.flatnonzero(leads == lead)) for lead in LEADS]


def _root(kernel):
    """R (…, n, n) of the inverse R*R of a kernel among nodes and its nugget"""
    return np.linalg.inv(np.linalg.cholesky(kernel + NUGGET * np.eye(kernel.shape[-1])))


def ringing_of(x, values):
    """(p,) sharp poles, in the variable s of x (n,), of functions (n, m) that ring between their nodes

    A pole is believed that is seen at a node and, as those of noise do not, tells nodes that are left out; one as broad
    as SHARP is smooth without it.
    """
    found, residues = poles(x.smooth, values)
    inside = (found.real > x.smooth[0]) & (found.real < x.smooth[-1]) & (np.abs(found.imag) < SHARP)
    found, residues = found[inside], residues[inside]
    nearest = np.abs(x.smooth[:, None] - found).min(axis=0)
    seen = np.abs(residues).max(axis=1, initial=0.0) / nearest
    order = [k for k in np.argsort(-seen)[:MOST_RINGING] if seen[k] > SEEN]
    kept = np.zeros(0, complex)
    error = _left_out(x, values, kept) if order else 0.0
    for pole in found.real[order] - 1j * np.abs(found.imag[order]):  # its width is a rounding error
        more = np.append(kept, pole)
        with_it = _left_out(x, values, more)
        if np.any(with_it < BELIEVED * error):
            kept, error = more, with_it
    return kept


def _left_out(x, values, ringing):
    """(m,) square of what the best of some kernels misses at nodes x (n,) that are left out, of functions (n, m)"""
    roots = _root(Nodes(x, False, ringing)._kernels(x, x)[::FEW_KERNELS])
    inverse = np.sum(np.abs(roots) ** 2, axis=1)[..., None]
    return np.sum(np.abs(roots.conj().swapaxes(1, 2) @ (roots @ values) / inverse) ** 2, axis=1).min(axis=0)


def _left_open(row, root):
    """(m,) share of the variance that remains at m places, from the kernel between these and those (m, n)

    By the inverse itself, with entries of 1e9, it would be noise of 1e-7: that stood for an error of half a per cent of
    added mass in long waves, where a hundredth of a per cent was true.
    """
    return 1 - np.sum(np.abs(row @ root.conj().T) ** 2, axis=1)


def unknown(x, y):
    """(m,) share of the variance of `SPREAD` that remains at y with values at x"""
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
