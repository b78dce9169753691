"""Force on a body by products of first-order waves on the free surface around it.

On z = 0 the second-order potential of a pair (i, j) has Ω² φ₂ − g ∂φ₂/∂z = −Q, in products as in `quadratic_forces`

    Q = ½iΩ (∇φᵢ·∇φ̄ⱼ + KᵢKⱼ φᵢφ̄ⱼ) − ¼iωᵢ φᵢ (φ̄ⱼ,zz − Kⱼ² φ̄ⱼ) + ¼iωⱼ φ̄ⱼ (φᵢ,zz − Kᵢ² φᵢ),        T = (iΩρ/g) ∬ ψ Q
    dS

minus the integral for the incident waves alone, whose forcing the bound wave satisfies (ψ as in `body_forces`; Molin
1979).  With φ,zz = −∇²φ along the surface and Green's theorem no second derivative remains:

    ∬ ψQ dS = ∬ ψ {¼iΩ ∇φᵢ·∇φ̄ⱼ + ¼i (2Ω KᵢKⱼ + ωᵢKⱼ² − ωⱼKᵢ²) φᵢφ̄ⱼ} − ¼i ∇ψ·(ωᵢ φᵢ∇φ̄ⱼ − ωⱼ φ̄ⱼ∇φᵢ) dS
              − ¼i ∮ ψ (ωᵢ φᵢ ∂φ̄ⱼ/∂n − ωⱼ φ̄ⱼ ∂φᵢ/∂n) dl

∇ is along the surface, and n points out of the body; `kinds` gives the formulas for sum frequencies.  Inside a circle
about the body the waves are computed from the panels (`surface_near`).
Outside the circle the waves are sums of Hankel functions: first with a local part on rings (`surface_far`), then
without it (`surface_tail`).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..kernels.threads import blas_threads
from ..waves import incident_wave, wavenumber
from .kinds import DIFFERENCE
from .surface_far import bessel_orders, both_signs, directions, hankel_orders, orders_sent, slopes
from .surface_tail import FEW, PER_RADIAN, Tails
from .surface_waves import Field

GROWTH = 1.6  # growth factor of the intervals beyond the rings
AT_ONCE = 1_000_000  # products of pairs at points


class Products(NamedTuple):
    """Factors of the products ψ∇φᵢ·∇φ̄ⱼ, ψφᵢφ̄ⱼ, −∇ψ·φᵢ∇φ̄ⱼ and ∇ψ·φ̄ⱼ∇φᵢ of pairs, divided by ¼i, each (q,)

    At sum frequencies the second frequency is negative.
    """

    steep: np.ndarray
    level: np.ndarray
    one: np.ndarray
    two: np.ndarray

    @classmethod
    def of(cls, one, two, gravity):
        K, L = one**2 / gravity, two**2 / gravity
        return cls(one - two, 2 * (one - two) * K * L + one * L**2 - two * K**2, one, two)


def integrated(products, terms, psi, weights):
    """Integrals of ψQ over the surface, divided by ¼i, without the line integral; shape (q, 6)

    terms : [(φᵢ, φ̄ⱼ)] of `Field` (q, p); psi : `Field` (q or 1, 6, p) of ψ"""
    c = Products(*(part[:, None] for part in products))
    scalar, x, y = 0.0, 0.0, 0.0
    for f, g in terms:
        scalar = scalar + c.steep * (f.slope[0] * g.slope[0] + f.slope[1] * g.slope[1]) + c.level * (f.value * g.value)
        first, second = c.one * f.value, c.two * g.value
        x = x + second * f.slope[0] - first * g.slope[0]
        y = y + second * f.slope[1] - first * g.slope[1]
    out = 0.0
    for part, wave in zip((scalar, x, y), (psi.value, *psi.slope), strict=True):
        weighted = part * weights
        shared = len(wave) == 1
        out = out + (weighted @ wave[0].T if shared else np.matmul(wave, weighted[..., None])[..., 0])
    return out


@dataclass(frozen=True, eq=False)
class PairsOfOne:
    """All pairs with a force of one frequency.

    omega : frequency of the force, rad/s; one, two : indices of waves, (q,)
    near : `Field` (6, p) of ψ near the body; far : six `Wave`s of ψ far away; line : integral along the waterline,
        (q, 6)
    """

    omega: float
    one: np.ndarray
    two: np.ndarray
    near: Field
    far: list
    line: np.ndarray


class SurfaceForces:
    """T from a `SurfaceWaves` that has all waves, at the frequencies of a `kinds.Kind`"""

    def __init__(self, waves, kind=DIFFERENCE):
        self.waves, self.kind, problem = waves, kind, waves.problem
        self.omega = np.array([wave.omega for wave in waves.waves])
        self.whole, self.incident = waves.joined()
        edges, end = _intervals(waves)
        self.begin = np.minimum(end, len(waves.rings.edges) - 1)
        different, highest = np.unique(self.omega), self.omega.max()
        of_force = kind.of(different[0], different[0]) or np.diff(different).min(), kind.of(highest, highest)
        third = tuple(float(wavenumber(w, problem.depth, problem.gravity)) for w in of_force)
        self.tails = Tails(waves.waves, edges, self.begin, end, third, waves.circle.radius, problem.gravity, kind)

    def __call__(self, several):
        """[(q, 6)] about the origin, N/m², N m/m², of several `PairsOfOne`"""
        with blas_threads(1):  # many small products
            return self._forces(several)

    def _forces(self, several):
        waves, problem, kind = self.waves, self.waves.problem, self.kind
        products = [Products.of(self.omega[d.one], kind.negative(self.omega[d.two]), problem.gravity) for d in several]
        total = [d.line.astype(complex) for d in several]
        for d, factors, out in zip(several, products, total, strict=True):
            for chunk in _chunks(len(d.one), len(waves.weights)):
                i, j = d.one[chunk], d.two[chunk]
                own, psi = Products(*(f[chunk] for f in factors)), d.near[None]
                out[chunk] += integrated(own, [(self.whole[i], self.whole[j].second(kind))], psi, waves.weights)
                alone = self.incident[i], self.incident[j].second(kind)
                out[chunk] -= integrated(own, [alone], psi, waves.weights)
        for w in range(len(waves.rings.edges) - 1):
            _add_interval(waves, several, products, w, self.begin, total, kind)
        for d, out in zip(several, total, strict=True):
            self.tails.add(d, out)
        scale = 0.25j * 1j * problem.density / problem.gravity
        return [scale * d.omega * out for d, out in zip(several, total, strict=True)]


def line_integral(surfaces, flow, radiated, waves, one, two, kind=DIFFERENCE):
    """Line integral −∮ ψ (ωᵢ φᵢ ∂φ̄ⱼ/∂n − ωⱼ φ̄ⱼ ∂φᵢ/∂n) dl of all waves, minus this integral of the incident waves;
    shape (q, 6)

    flow : `HullFlow` of all waves; waves : the incident waves; n points out of the body

    ∂φ/∂n is the derivative along the surface: on an inclined side n·V = n·∇φ also contains a part of ∂φ/∂z = Kφ.
    """
    line, g = surfaces.waterline, waves.problem.gravity
    V = -1j * flow.omega[:, None] * (flow.motion @ surfaces.waterline_modes.T)
    across = V - flow.omega[:, None] ** 2 / g * flow.potential * line.normals[:, 2]
    incident = [
        incident_wave(line.points, wave.direction, wave.omega, wave.k, waves.problem.depth, g) for wave in waves.waves
    ]
    alone = np.array([phi for phi, _ in incident])
    alone_across = np.array(
        [velocity[:, 0] * line.normals[:, 0] + velocity[:, 1] * line.normals[:, 1] for _, velocity in incident]
    )
    weighted, out = radiated.potential * line.weights, 0.0
    for phi, normal, sign in ((flow.potential, across, -1.0), (alone, alone_across, 1.0)):
        first = (flow.omega[one, None] * phi[one]) * kind.second(normal[two])
        second = (kind.negative(flow.omega[two, None]) * kind.second(phi[two])) * normal[one]
        out = out + sign * (first - second) @ weighted.T
    return out


def _chunks(count, points):
    step = max(1, AT_ONCE // max(points, 1))
    return [slice(start, min(start + step, count)) for start in range(0, count, step)]


def _intervals(waves):
    """Edges of radii (w + 1,) m; of each wave the number of the edge where its pairs' tails begin, as the faster one"""
    edges, k = list(waves.rings.edges), np.array([wave.k for wave in waves.waves])
    radius = waves.circle.radius
    needed = (1.2 * orders_sent(k * radius) + 4) / k
    width = edges[-1] - edges[-2]
    while edges[-1] < needed.max():
        width *= GROWTH
        edges.append(edges[-1] + width)
    edges, local = np.array(edges), np.array([len(wave.local) for wave in waves.waves])
    return edges, np.maximum(np.searchsorted(edges, needed), np.maximum(local, 1))


def _add_interval(waves, several, products, w, ends, total, kind):
    """∬ over interval w of the rings, for all pairs without a tail there"""
    active = [np.flatnonzero(ends[d.one] > w) for d in several]
    both = zip(several, active, strict=True)
    used = np.unique(np.concatenate([np.concatenate([d.one[a], d.two[a]]) for d, a in both]))
    if not len(used):
        return
    fastest = max(waves.waves[i].k for i in used)
    third = max(d.far[0].k for d, a in zip(several, active, strict=True) if len(a))
    low, high = waves.rings.edges[w : w + 2]
    x, v = np.polynomial.legendre.leggauss(int(FEW + PER_RADIAN * (2 * fastest + third) * (high - low) / 2))
    r = low + (high - low) * (1 + x) / 2
    most = max(wave.most for wave in (*(waves.waves[i] for i in used), *(d.far[0] for d in several)))
    count = max(directions(orders_sent(max(fastest, third) * waves.circle.radius)), directions(most // 2))
    grid = _Grid(r, count, waves.rings, w, x)
    weights = np.repeat((high - low) / 2 * v * r * 2 * np.pi / count, count)
    place = {wave: n for n, wave in enumerate(used)}
    sent, incident = grid.fields([waves.waves[i] for i in used])
    whole = sent + incident
    for d, factors, a, out in zip(several, products, active, total, strict=True):
        if not len(a):
            continue
        psi = grid.fields(d.far)[0][None]
        for chunk in _chunks(len(a), len(weights)):
            own = a[chunk]
            i, j = (np.array([place[n] for n in side[own]]) for side in (d.one, d.two))
            terms = [(whole[i], sent[j].second(kind)), (sent[i], incident[j].second(kind))]
            out[own] += integrated(Products(*(f[own] for f in factors)), terms, psi, weights)


class _Grid:
    """Radii r (n,) m times `count` directions; rings : `surface_far.Rings` of whose interval w they are the places x
    (n,)"""

    def __init__(self, r, count, rings, w, x):
        self.r, self.count, self.rings, self.w = r, count, rings, w
        self.m = np.fft.fftfreq(count, 1 / count).astype(int)
        self.turn = np.exp(1j * np.outer(self.m, 2 * np.pi * (np.arange(count) + 0.5) / count))
        self.interpolation = rings.interpolation(w, x)

    def fields(self, waves):
        """Return the waves as (outgoing and local, incident), each a `Field` (f, n count), from [`Wave`]"""
        out = []
        most = self.count // 2 - 1
        for wave in waves:
            z = wave.k * self.r
            H = hankel_orders(1, wave.most, z) * np.exp(1j * z)
            sent = self._orders(wave.sent, *slopes(H, wave.k))
            if self.w < len(wave.local):
                for part, matrix in zip(sent, self.interpolation, strict=True):
                    part[:, self.rings.orders] += matrix @ wave.local[self.w]
            coming = None
            if wave.incident:
                J = bessel_orders(most, z + 0j)
                coming = self._orders(wave.incident_orders(most), *slopes(J, wave.k))
            out.append((sent, coming))
        zero = np.zeros((len(self.r), self.count)), np.zeros((len(self.r), self.count))
        return [self._field([parts[n] or zero for parts in out]) for n in range(2)]

    def _orders(self, coefficients, value, slope):
        """Two (n, count) of value and slope"""
        most = len(coefficients) // 2
        m, out = np.arange(-most, most + 1), []
        for part in (value, slope):
            whole = np.zeros((len(self.r), self.count), complex)
            whole[:, m] = (coefficients[:, None] * both_signs(part)).T
            out.append(whole)
        return out

    def _field(self, parts):
        value, slope = (np.array([part[n] for part in parts]) for n in range(2))
        across = 1j * self.m * value / self.r[:, None]
        size = len(parts), -1
        value, slope, across = ((part @ self.turn).reshape(size) for part in (value, slope, across))
        return Field(value, np.stack([slope, across]))
