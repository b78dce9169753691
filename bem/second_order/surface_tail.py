"""Integrals over the free surface beyond the rings, where each of three waves is a sum of Hankel functions.

Beyond the rings waves have no local part, ∇²φ = −k²φ along the surface, and Green's theorem reduces ∬ ψQ dS
(`surface_forces`), divided by ¼i, to

    C ∬ ψ φᵢ φ̄ⱼ dS + ∮ {ψ (ωⱼ φᵢ ∂φ̄ⱼ/∂r − ωᵢ φ̄ⱼ ∂φᵢ/∂r) + Ω φᵢ φ̄ⱼ ∂ψ/∂r} dl,
    C = Ω (k² + q² − κ² + 2KᵢKⱼ) + ωᵢ (Kⱼ² − q²) − ωⱼ (Kᵢ² − k²),

with the line integral along the inner circle, and k, q and κ the wavenumbers of φᵢ, φⱼ and ψ.  The orders m of φᵢ, n
of φ̄ⱼ and p = n − m
of ψ combine around the circle, with a factor that depends on frequencies alone and is equal for −m, −n, −p:

    2π C ∫ f_m(kr) f̄_n(qr) H_p(κr) r dr + …

Radii are real up to the radius at which all orders oscillate. Beyond the circle the paths are r + ix, where products of
outgoing waves with outgoing or incident waves decay.
For products with the incoming part of the first incident wave the paths are r − ix.  All pairs use common radii on a
path, and common values of the functions at these radii.

At the sum of two frequencies (`kinds`) κ > k + q, and all products decay along r + ix.  Σ (−1)ⁿ c₋ₙ H_n e^{−inθ} then
replaces the sum Σ c̄ₙ H̄_n e^{−inθ} of the second wave.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import as_strided

from .kinds import DIFFERENCE
from .surface_far import bessel_orders, both_signs, hankel_orders, orders_sent, slopes

PER_RADIAN, FEW = 0.6, 6  # radii of a real interval for a radian of the fastest product, and beside
DECAY, POINTS, FIRST = 30.0, 6, 0.25  # at the end of a tail; of its intervals; of the shortest length, the first
NEGLIGIBLE = 1e-11  # size relative to the largest order at the start of a path, below which orders are neglected


@dataclass(frozen=True, eq=False)
class Path:
    """Radii in columns: first the radii along r − ix, then the first radius three times, real radii, and radii along
    r + ix.

    edges : ends of the real intervals, m, (w,); highest : a third of the wavenumber of the fastest product, rad/m
    least_down : smallest rate with which products decay along r − ix, rad/m; infinite if no product does
    least_up : smallest rate with which products decay along r + ix, rad/m
    """

    edges: np.ndarray
    highest: float
    least_down: float
    least_up: float

    @cached_property
    def real(self):
        """Real radii and their weights, m; shape (2, c)"""
        parts = [np.zeros((2, 0))]
        for low, high in zip(self.edges[:-1], self.edges[1:], strict=True):
            x, w = np.polynomial.legendre.leggauss(int(FEW + PER_RADIAN * 3 * self.highest * (high - low) / 2))
            parts.append(np.stack([low + (high - low) * (1 + x) / 2, (high - low) / 2 * w]))
        return np.concatenate(parts, axis=1)

    @cached_property
    def down(self):
        """Places x and weights, m, for products that decay as exp(−(k + q − κ)x), with a rate of 2q or more; shape
        (2, c); empty at sum frequencies"""
        return self._away(self.least_down)

    @cached_property
    def up(self):
        """Places x and weights, m, for products that decay as exp(−(k − q + κ)x), with a rate of 2κ or more (at sums 2q
        or more); shape (2, c)"""
        return self._away(self.least_up)

    def _away(self, least):
        if np.isinf(least):
            return np.zeros((2, 0))
        ends = [0.0, FIRST / (self.highest + 1 / self.edges[-1])]
        while ends[-1] < DECAY / least:
            ends.append(2 * ends[-1])
        x, w = np.polynomial.legendre.leggauss(POINTS)
        low, size = np.array(ends[:-1])[:, None], np.diff(ends)[:, None]
        return np.stack([(low + size * (1 + x) / 2).ravel(), (size * w / 2).ravel()])

    @property
    def first(self):
        """Index of the column of the first radius"""
        return self.down.shape[1]

    def reach(self, slope):
        """Number of columns up to the point where exp(−slope x) along r + ix is negligible"""
        return self.first + 3 + self.real.shape[1] + int(np.searchsorted(self.up[0], DECAY / slope))

    def hankel(self, kind, k, most, place):
        """Hankel functions H_m(kr) of a kind and their derivatives on one of the three paths `place`; shape
        (most + 1, c); along r ± ix without the factor e^{±ikr}"""
        z = self._radii(k)
        values = hankel_orders(kind, most, z)
        real = slice(self.first, self.first + 1 + self.real.shape[1])
        values[:, real] *= np.exp((1j if kind == 1 else -1j) * z[real])
        return self._thrice(values, k, place)

    def bessel(self, k, most, place):
        """Bessel functions J_m(kr) and derivatives, as from `hankel`: along r + ix without the factor e^{−ikr}, along
        r − ix zero"""
        z = self._radii(k)[self.first :]
        values = bessel_orders(most, z)
        values[:, 1 + self.real.shape[1] :] *= np.exp(1j * k * self.edges[-1])
        return self._thrice(np.pad(values, ((0, 0), (self.first, 0))), k, place)

    def _radii(self, k):
        end = self.edges[-1]
        parts = end - 1j * self.down[0], self.edges[:1], self.real[0], end + 1j * self.up[0]
        return k * np.concatenate(parts)

    def _thrice(self, values, k, place):
        value, slope = slopes(values[:, [self.first]], k)
        three = np.repeat(value, 3, axis=1)
        three[:, place] = slope[:, 0]
        return np.concatenate([values[:-1, : self.first], three, values[:-1, self.first + 1 :]], axis=1)

    def weights(self, up, down, C, sides):
        """Weights of the columns; shape (c,)

        up, down : rates at which products decay along r + ix and along r − ix, rad/m
        sides : weights of the three columns at the first radius, divided by this radius"""
        (y, v), (r, u), (x, w) = self.down, self.real, self.up
        below, above = self.edges[-1] - 1j * y, self.edges[-1] + 1j * x
        parts = (
            -1j * C * v * below * np.exp(-1j * down * below),
            self.edges[0] * np.asarray(sides),
            C * u * r,
            1j * C * w * above * np.exp(1j * up * above),
        )
        return np.concatenate(parts)


class Tails:
    """Integrals of waves [`surface_waves.Wave`] beyond the rings.

    edges : radii, m, (w,)
    begin, end : indices of edges, (f,): between them radii are real for pairs in which the wave is the faster one
    third : smallest and largest wavenumber of ψ, rad/m; radius : radius of the circle, m; kind : `kinds.Kind`
    """

    def __init__(self, waves, edges, begin, end, third, radius, gravity, kind=DIFFERENCE):
        self.waves, self.gravity, self.kind, self.tables = waves, gravity, kind, {}
        self.omega, first, self.number = np.unique([w.omega for w in waves], return_index=True, return_inverse=True)
        self.k, self.most = (np.array([getattr(waves[n], name) for n in first]) for name in ("k", "most"))
        self.ends = [(int(begin[n]), int(end[n])) for n in first]
        highest = dict(zip(self.ends, self.k, strict=True))  # the last of each, k rises
        self.of_third, lowest = orders_sent(third[1] * radius), 2 * float(self.k[0])
        least = (np.inf, lowest) if kind.sign > 0 else (lowest, 2 * third[0])
        self.paths = {
            ends: Path(edges[ends[0] : ends[1] + 1], (2 * k + third[1]) / 3 if kind.sign > 0 else k, *least)
            for ends, k in highest.items()
        }

    def add(self, d, out):
        """Add ∬ ψQ dS, divided by ¼i, of the pairs of a `surface_forces.PairsOfOne` to `out` (q, 6)"""
        one, two = self.number[d.one], self.number[d.two]
        psi = {}
        for i, j in sorted(set(zip(one.tolist(), two.tolist(), strict=True))):
            ends, own = self.ends[i], np.flatnonzero((one == i) & (two == j))
            if ends not in psi:
                psi[ends] = _third(d.far, self.paths[ends])
            out[own] += self._pairs(i, j, d.one[own], d.two[own], psi[ends])

    def _pairs(self, i, j, one, two, psi):
        """Forces of pairs (q,) of waves of the frequencies i and j; shape (q, 6)"""
        path, kappa = self.paths[self.ends[i]], psi.k
        first, second = self._first(i), self._second(j, self.ends[i])
        M, N, P = first.most, second.most, psi.most
        factors = self._factors(i, j, kappa)

        def weighted(up, all_of_it=False):
            columns = slice(0 if all_of_it else path.first, path.reach(up))
            weights = path.weights(up, self.k[i] + self.k[j] - kappa, *factors)
            return columns, psi.of_sent[:, columns] * weights[columns]

        sent, other = (np.array([self.waves[n].sent for n in side]) for side in (one, two))
        sent, other = _orders(sent, M), self._second_orders(_orders(other, N))
        coming = np.array([self.waves[n].incident_orders(N + P) for n in one])
        met = self._second_orders(np.array([self.waves[n].incident_orders(M + P) for n in two]))
        for_both, for_first, for_second = self._decay(i, j, kappa)
        columns, H = weighted(for_both)
        both = _products(first.of_sent[:, columns], second.of_sent[:, columns], H, N, 1)
        columns, H = weighted(for_first, True)
        with_first = _products(first.of_incident[:, columns], second.of_sent[:, columns], H, N, 1)
        columns, H = weighted(for_second)
        with_second = _products(second.of_incident[:, columns], first.of_sent[:, columns], H, M, -1)
        sums = _met(both, _orders(sent, N + P), other, 1)
        sums = sums + _met(with_first, coming, other, 1) + _met(with_second, met, sent, -1)
        return 2 * np.pi * sums @ psi.coefficients.T

    def _second_orders(self, coefficients):
        """Those of e^{−inθ} of the second waves from theirs of e^{inθ} (…, 2M + 1), as products have them"""
        if self.kind.sign < 0:
            return coefficients.conj()
        most = coefficients.shape[-1] // 2
        return coefficients[..., ::-1] * np.where(np.arange(-most, most + 1) % 2, -1, 1)

    def _decay(self, i, j, kappa):
        """rad/m along r + ix: of both sent waves, the first incident one with the second, the second with the first

        The incident ones decay as half of them does that goes out, at sums grow as the half that comes in.
        """
        k, q = self.k[i], self.k[j]
        return (k + q + kappa, q - k + kappa, k - q + kappa) if self.kind.sign > 0 else (k - q + kappa,) * 3

    def _factors(self, i, j, kappa):
        one, two, k, q = self.omega[i], self.kind.negative(self.omega[j]), self.k[i], self.k[j]
        K, L = one**2 / self.gravity, two**2 / self.gravity
        C = (one - two) * (k**2 + q**2 - kappa**2 + 2 * K * L) + one * (L**2 - q**2) - two * (K**2 - k**2)
        return C, (two, -one, one - two)

    def _first(self, i):
        """`_Functions` of φᵢ along its own path"""
        if (i, None) not in self.tables:
            path, k, most = self.paths[self.ends[i]], self.k[i], self._kept(i, self.ends[i])
            up, top = path.first + 3 + path.real.shape[1], self.most[i] + max(self.most[i], self.of_third)
            H, J = path.hankel(1, k, top, 1), path.bessel(k, top, 1)
            if self.kind.sign < 0:
                J[:, : path.first] = 0.5 * path.hankel(2, k, top, 1)[:, : path.first]
                J[:, up:] = 0.5 * H[:, up:]
            self.tables[i, None] = _Functions(k, most, both_signs(H), both_signs(J))
        return self.tables[i, None]

    def _second(self, j, ends):
        """`_Functions` of φ̄ⱼ along the path of another"""
        if (j, ends) not in self.tables:
            path, k, most = self.paths[ends], self.k[j], self._kept(j, ends)
            top = max(m for m, own in zip(self.most, self.ends, strict=True) if own == ends)
            top += max(top, self.of_third)
            H, J = path.hankel(2 if self.kind.sign < 0 else 1, k, most, 0), path.bessel(k, top, 0)
            self.tables[j, ends] = _Functions(k, most, both_signs(H), both_signs(J))
        return self.tables[j, ends]

    def _kept(self, i, ends):
        """The last order of waves of a frequency that is not negligible where a path begins"""
        sent = np.array([wave.sent for wave, n in zip(self.waves, self.number, strict=True) if n == i])
        return _last(sent, self.k[i] * self.paths[ends].edges[0])


class _Functions(NamedTuple):
    """Along a path, of one frequency: orders −M … M of sent waves in rows, those of incident ones; most : M that count

    coefficients : (6, 2 most + 1) of ψ
    """

    k: float
    most: int
    of_sent: np.ndarray
    of_incident: np.ndarray | None = None
    coefficients: np.ndarray | None = None


def _third(waves, path):
    """`_Functions` of ψ, its orders from 0 on alone"""
    k, sent = waves[0].k, np.array([wave.sent for wave in waves])
    most = _last(sent, k * path.edges[0])
    return _Functions(k, most, path.hankel(1, k, most, 2), None, _orders(sent, most))


def _last(sent, z):
    """The last of orders (w, 2M + 1) that is not negligible relative to the largest order of its wave at kr = z"""
    size = np.abs(sent * both_signs(hankel_orders(1, sent.shape[1] // 2, np.array([z + 0j]))[:-1])[:, 0])
    large = np.any(size > NEGLIGIBLE * size.max(axis=1, keepdims=True), axis=0)
    return int(np.abs(np.flatnonzero(large) - sent.shape[1] // 2).max(initial=0))


def _orders(coefficients, most):
    """Orders −most … most of an array (…, 2M + 1) of orders, zero beyond; shape (…, 2 most + 1)"""
    M = coefficients.shape[-1] // 2
    if most <= M:
        return coefficients[..., M - most : M + most + 1]
    return np.pad(coefficients, [(0, 0)] * (coefficients.ndim - 1) + [(most - M, most - M)])


def _shifted(values, most, count, sign):
    """View (count, 2 most + 1, …) of values (2M + 1, …) of orders n − sign p, p = 0 … count − 1, n = −most … most"""
    start = values[len(values) // 2 - most :]
    return as_strided(start, (count, 2 * most + 1, *values.shape[1:]), (-sign * values.strides[0], *values.strides))


def _products(shifted, own, H, most, sign):
    """Sums over columns of functions of orders n − sign p, n and p; shape (P + 1, 2 most + 1) over p and n"""
    product = _shifted(shifted, most, len(H), sign) * _orders(own.T, most).T
    return np.matmul(product, H[:, :, None])[..., 0]


def _met(products, shifted, own, sign):
    """Sums over n of products with coefficients (q, …) of orders n − sign p and n; shape (q, 2P + 1) over p = −P … P"""
    count, most = len(products), products.shape[1] // 2
    out = []
    for a, b in ((shifted, own), (shifted[:, ::-1], own[:, ::-1])):  # p, and −p of negative orders
        out.append(np.einsum("pnq,nq,pn->qp", _shifted(np.ascontiguousarray(a.T), most, count, sign), b.T, products))
    return np.concatenate([out[1][:, :0:-1], out[0]], axis=1)
