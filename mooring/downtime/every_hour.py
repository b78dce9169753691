"""Moments of linear responses in every hour of a record, without a call for each.

    m_n(hour) = ∫ ωⁿ S(ω; H, T) P(ω, β) dω,    P(ω, β) = ∫ D(θ − β) |X(ω, θ)|² dθ

P is computed once on a ring of headings and interpolated over β by the six nearest (Lagrange), with an error of 1e-6 of
the largest m_n. Hours are grouped by these six headings, and each group is one product of matrices.
S of a family of one
shape scales with its period: S(ω; H, T) = H² τ S₁(ωτ), τ = T/T₁, so that no table over periods is needed.

The frequencies are those of `response.linear.frequencies` for all waves together, with as many between them as the peak
of a spectrum needs. These frequencies serve every hour. Contributions of wave systems add up.

For shapes that depend on the period, such as TMA or spreading after Mitsuyasu, the harmonics over β are tabulated,

    m_n = H² Re Σ_k M_k(T) e^{ikβ},    M_k(T) = ∫ ωⁿ S(ω; 1, T) r_k(ω; T) p_k(ω) dω,

where p_k and r_k are the harmonics of |X|² and of the spreading; cos²ˢ(θ/2) has r_k = Π_{j≤k} (s − j + 1)/(s + j).
M_k is tabulated at periods 1 % apart and interpolated by the six nearest.
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import wavenumber

from ..environment.spectra import FAMILIES
from ..response.linear import frequencies
from ..response.points import Point, relative_name, transfer_functions
from ..seas.families import families

NODES = np.arange(-2, 4)  # offsets of the six nodes around a direction
AT_ONCE = 2048  # hours of a product of matrices: 9 MB of spectra
RING = 360, 720  # headings, fewest and most: with 72 of long waves the largest σ is off by 1e-5, so by 1e-7
PER_HARMONIC = 13.4  # directions per harmonic; |X|² has 2kR harmonics over β
HEADINGS_AT_ONCE = 72  # headings whose complex transfer functions are in memory together
REFERENCE = 10.0  # s
STEP = 0.01  # step of ln T in the table over periods
LOW = 1e-3  # m, height of a sea that is not too steep at any period
FINE = 0.015  # relative frequency step: a fifth of the narrow side of a JONSWAP peak


class Shape(NamedTuple):
    """A family of spectra of one shape, and its spreading

    family : name in `environment.spectra.FAMILIES`, or "tma"; kind : kind of its period, such as "peak_period"
    gamma : peak enhancement, None for a family without it
    spreading : `environment.spreading.Spreading`, None for long crests; Mitsuyasu's spreading uses the peak of each
        hour
    depth : m, for TMA
    """

    family: str
    kind: str
    gamma: float | None = None
    spreading: object = None
    depth: float | None = None

    @property
    def changes(self):
        """Whether the shape depends on the period"""
        return self.family not in FAMILIES or getattr(self.spreading, "depends_on_frequency", False)

    def spectrum(self, period):
        """The Spectrum of a sea with a significant height of LOW m"""
        more = {} if self.gamma is None else {"gamma": self.gamma}
        return families(self.depth)[self.family](LOW, **{self.kind: period}, **more)

    def density(self, omega, height, period):
        """Spectral density S, m² s/rad, at omega (q,), rad/s, of hours with height (h,), m, and period (h,), s; shape
        (h, q)"""
        one = _unit(self.family, self.kind, self.gamma)
        tau = (period / REFERENCE)[:, None]
        return (height**2)[:, None] * tau * one.density(omega * tau)


@cache
def _unit(family, kind, gamma):
    """The Spectrum of a sea of 1 m and REFERENCE s"""
    return FAMILIES[family](1.0, **{kind: REFERENCE}, **({} if gamma is None else {"gamma": gamma}))


@dataclass(frozen=True, eq=False)
class Response:
    """Responses (c,) of a body to waves of unit amplitude on a ring of headings.

    names, units : (c,); omega : (q,) rad/s; power : |X|² at p equally spaced β from 0, (q, p, c)
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    omega: np.ndarray
    power: np.ndarray

    @property
    def ring(self):
        """Directions of the ring, rad; shape (p,)"""
        return ring_of(self.power.shape[1])

    def spread(self, spreading):
        """Values P for mean directions on the ring; shape (q, p, c)"""
        if spreading is None:
            return self.power
        away = np.mod(self.ring + np.pi, 2 * np.pi) - np.pi
        weight = spreading.density(away)
        weight = np.fft.rfft(weight / weight.sum())[:, None]  # D is even in nothing: Σ_θ D(θ − β) P(θ)
        return np.stack(
            [np.fft.irfft(np.conj(weight) * np.fft.rfft(row, axis=0), len(away), axis=0) for row in self.power]
        )


def response_of(body, points, wanted):
    """The Response of a `bem.database.reader.Reader`, `floating`, for given names of responses.

    points : as in `response.points.transfer_functions`.  Raises ValueError for an unknown name.
    """
    low, high = body.omega[[0, -1]]
    between = np.geomspace(low, high, 2 + int(np.log(high / low) / FINE))
    omega = np.union1d(frequencies(body), between[1:-1])
    water = any(relative_name(point) in wanted for point in points if isinstance(point, Point))
    first = transfer_functions(body, omega[:1], np.zeros(1), points, water)
    strange = [name for name in wanted if name not in first.names]
    if strange:
        raise ValueError(f"there is no response named {strange[0]!r}; allowed: {', '.join(first.names)}")
    chosen = [first.names.index(name) for name in wanted]
    harmonics = 2 * body.radius * wavenumber(omega, body.depth, body.gravity)
    counts = HEADINGS_AT_ONCE * np.ceil(np.clip(PER_HARMONIC * harmonics, *RING) / HEADINGS_AT_ONCE).astype(int)
    power = np.empty((len(omega), counts.max(), len(chosen)))
    for count in np.unique(counts):  # long waves have few harmonics, so that few headings determine all
        rows, parts = counts == count, np.split(ring_of(count), count // HEADINGS_AT_ONCE)
        found = [transfer_functions(body, omega[rows], part, points, water).value[..., chosen] for part in parts]
        found = np.abs(np.concatenate(found, axis=1)) ** 2
        power[rows] = np.fft.irfft(np.fft.rfft(found, axis=1), power.shape[1], axis=1) * (power.shape[1] / count)
    return Response(tuple(wanted), tuple(first.units[i] for i in chosen), omega, power)


def moments_of_hours(response, shape, waves, orders=(0, 2)):
    """Spectral moments m_n in hours of a `hindcast.WaveHours`; shape (len(orders), n, c); nan where the waves are
    unknown"""
    if shape.changes:
        return _by_periods(response, shape, waves, orders)
    omega, count = response.omega, len(response.names)
    out = np.zeros((len(orders), len(waves.height), count))
    out[:, np.isnan(waves.height)] = np.nan
    power, column = response.spread(shape.spreading), rule_of(omega, orders)
    ring = power.shape[1]
    place = waves.direction * (ring / (2 * np.pi))
    cell = np.floor(place).astype(int)
    share = lagrange(place - cell)
    some = np.flatnonzero(waves.height > 0)
    order = some[np.argsort(cell[some] % ring, kind="stable")]
    cells = cell[order] % ring
    for group in np.split(order, np.flatnonzero(np.diff(cells)) + 1) if len(order) else ():
        near = (cell[group[0]] + NODES) % ring
        kernel = np.einsum("oq,qkc->qokc", column, power[:, near]).reshape(len(omega), -1)
        for hours in np.array_split(group, -(-len(group) // AT_ONCE)):
            density = shape.density(omega, waves.height[hours], waves.period[hours])
            at_nodes = (density @ kernel).reshape(len(hours), len(orders), len(NODES), count)
            out[:, hours] = np.einsum("hk,hokc->ohc", share[hours], at_nodes)
    return np.maximum(out, 0.0)


def rule_of(omega, orders):
    """Weights of the trapezium rule times ωⁿ for each order n; shape (o, q)"""
    rule = np.gradient(omega)  # trapezoidal rule, except at its ends
    rule[[0, -1]] *= 0.5
    return np.stack([rule * omega**n for n in orders])


def _by_periods(response, shape, waves, orders):
    """`moments_of_hours` by a table over periods"""
    omega, some = response.omega, np.flatnonzero(waves.height > 0)
    out = np.zeros((len(orders), len(waves.height), len(response.names)))
    out[:, np.isnan(waves.height)] = np.nan
    if not len(some):
        return out
    harmonics = np.fft.rfft(response.power, axis=1)[:, :-1] / response.power.shape[1]  # (q, k, c)
    number = np.arange(harmonics.shape[1])
    place = np.log(waves.period[some]) / STEP
    cell = np.floor(place).astype(int)
    first, column = cell.min() + NODES[0], rule_of(omega, orders)
    table = []
    for node in range(first, cell.max() + NODES[-1] + 1):
        spectrum = shape.spectrum(np.exp(STEP * node))
        density = column * spectrum.density(omega) / LOW**2
        spread = _of_spreading(shape.spreading, spectrum, omega, number)
        weight = (density[:, :, None] * spread).transpose(2, 0, 1)  # (k, o, q)
        table.append(weight @ harmonics.transpose(1, 0, 2))  # (k, o, c)
    table = np.where(number > 0, 2.0, 1.0)[:, None, None] * np.array(table)
    share = lagrange(place - cell)
    order = np.argsort(cell, kind="stable")
    for group in np.split(order, np.flatnonzero(np.diff(cell[order])) + 1):
        near = table[cell[group[0]] + NODES - first].transpose(1, 0, 2, 3)
        for rows in np.array_split(group, -(-len(group) // AT_ONCE)):
            phase = np.exp(1j * number * waves.direction[some[rows], None])
            at_nodes = (phase @ near.reshape(len(number), -1)).real.reshape(len(rows), len(NODES), *out.shape[::2])
            out[:, some[rows]] = np.einsum("h,hj,hjoc->ohc", waves.height[some[rows]] ** 2, share[rows], at_nodes)
    return np.maximum(out, 0.0)


def _of_spreading(spreading, spectrum, omega, number):
    """Harmonics of the spreading, 1 for long crests; shape (q, k), or an array that broadcasts with it"""
    if spreading is None:
        return np.ones((1, len(number)))
    if not spreading.depends_on_frequency:
        around = ring_of(3600)
        weight = spreading.density(np.mod(around + np.pi, 2 * np.pi) - np.pi)
        return np.fft.rfft(weight / weight.sum()).real[None, : len(number)]
    s = replace(spreading, peak_omega=spectrum.peak_omega).exponent(omega)[:, None]
    return np.cumprod(np.where(number > 0, (s - number + 1) / (s + np.maximum(number, 1)), 1.0), axis=1)


def ring_of(count):
    """Angles of equal steps from 0, rad; shape (count,)"""
    return np.arange(count) * (2 * np.pi / count)


def lagrange(t):
    """Weights of values at NODES for places t (n,) between 0 and 1; shape (n, 6)"""
    away = t[:, None] - NODES
    weights = [np.prod(np.delete(away, j, axis=1) / np.delete(NODES[j] - NODES, j), axis=1) for j in range(len(NODES))]
    return np.stack(weights, axis=1)
