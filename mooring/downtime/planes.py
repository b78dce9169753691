"""Hours given as densities over frequency and direction, as wave models write them.

A plane of densities is linear between its rows. Moments of all hours are therefore one matrix product with

    W_ij = ∬ ωⁿ h_i(ω) h_j(θ) |X|² dω dθ,    h_i, h_j the linear hat functions that are 1 at row i and 0 at the others.
"""

from typing import NamedTuple

import numpy as np

from ..environment.tables import TableError
from ..seas.netcdf import planes_of
from .every_hour import ring_of, rule_of

RING = 720  # headings of an integral over directions
SECTOR = 1.5  # factor on the usual step of directions; no waves travel between two further apart


class Planes(NamedTuple):
    """paths : paths of successive netCDF files; counts : number of hours in each; location : index of the place

    omega : (f,) rad/s, ascending; angle : directions of travel in axes of the body, (d,) rad
    """

    paths: tuple
    counts: tuple[int, ...]
    location: int | None
    omega: np.ndarray
    angle: np.ndarray

    def density(self):
        """Densities of successive groups of hours, m² s/rad²; shape (m, f, d); nan for an hour without a plane"""
        for path in self.paths:
            for _, _, _, density in planes_of(path, self.location):
                yield density / np.float32(2 * np.pi)

    def path(self, row):
        """Path of the file of one hour"""
        return self.paths[int(np.searchsorted(np.cumsum(self.counts), row, side="right"))]


def read_planes(paths, location, x_axis):
    """Times, Planes, and the significant height, m, energy period, s, and mean direction, rad, of each hour, (n,)
    each.

    x_axis : compass heading of the x axis, rad. Raises TableError.
    """
    moments, counts, found, first = [], [], [], None
    for path in paths:
        before = sum(map(len, moments))
        for time, frequency, towards, density in planes_of(path, location):
            grid = 2 * np.pi * frequency, np.mod(x_axis - towards, 2 * np.pi)
            first = first or grid
            if any(a.shape != b.shape or not np.allclose(a, b) for a, b in zip(first, grid, strict=True)):
                raise TableError(
                    f"the frequencies or directions of {path} differ from those of {paths[0]}; allowed: "
                    f"the same in all files"
                )
            moments.append(time)
            found.append(_integrals(*grid, density / (2 * np.pi)))
        counts.append(sum(map(len, moments)) - before)
    height, period, direction = np.concatenate(found, axis=1)
    return np.concatenate(moments), Planes(tuple(paths), tuple(counts), location, *first), (height, period, direction)


def _integrals(omega, angle, density):
    """Height 4√m₀, energy period 2π m₋₁/m₀ and the mean direction; shape (3, n)"""
    around = _straight(angle, ring_of(RING)).sum(axis=0) * (2 * np.pi / RING)
    rule = rule_of(omega, (0, -1))
    m0, below = np.einsum("nfd,of,d->on", density, rule, around, optimize=True)
    vector = np.einsum("nfd,f,d->n", density, rule[0], around * np.exp(1j * angle), optimize=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.stack([4 * np.sqrt(m0), 2 * np.pi * below / m0, np.mod(np.angle(vector), 2 * np.pi)])


def moments_of_planes(response, omega, angle, density, orders=(0, 2)):
    """Spectral moments of planes (n, f, d), m² s/rad²; shape (len(orders), n, c).

    Planes are linear between omega (f,), rad/s, and angle (d,), rad

    density : iterable of arrays (m, f, d), n hours in all; nan in an hour without data
    """
    kernel = _kernel(response, np.asarray(omega, float), np.asarray(angle, float), orders)
    parts = [part.reshape(len(part), -1) @ kernel.astype(part.dtype) for part in density]
    found = np.concatenate(parts).astype(float).reshape(-1, len(orders), len(response.names))
    return np.maximum(found.transpose(1, 0, 2), 0.0)


def _kernel(response, omega, angle, orders):
    """Kernel W of the integrals over a plane; shape (f d, o c)"""
    inside = omega[(omega > response.omega[0]) & (omega < response.omega[-1])]
    fine = np.union1d(response.omega, inside)
    rows = np.eye(len(omega))
    lines = np.stack([np.interp(fine, omega, row, left=0.0, right=0.0) for row in rows], axis=1)  # (q, f)
    beta = ring_of(RING)
    around = _straight(angle, beta) * (2 * np.pi / RING)  # (b, d)
    ring = np.fft.rfft(response.power, axis=1)
    scale = RING / response.power.shape[1]
    power = np.stack([np.einsum("bd,bc->dc", around, scale * np.fft.irfft(row, RING, axis=0)) for row in ring])
    at = np.clip(np.searchsorted(response.omega, fine, side="right") - 1, 0, len(response.omega) - 2)
    t = ((fine - response.omega[at]) / (response.omega[at + 1] - response.omega[at]))[:, None, None]
    power = (1 - t) * power[at] + t * power[at + 1]
    return np.einsum("oq,qf,qdc->fdoc", rule_of(fine, orders), lines, power, optimize=True).reshape(
        len(omega) * len(angle), -1
    )


def _straight(angle, beta):
    """Weights at β (b,) of straight lines between directions (d,), none across the gap of a sector; shape (b, d)"""
    order = np.argsort(np.mod(angle, 2 * np.pi))
    rows = np.mod(angle, 2 * np.pi)[order]
    gaps = np.diff(rows, append=rows[0] + 2 * np.pi)
    way = np.mod(beta - rows[0], 2 * np.pi)
    at = np.searchsorted(rows - rows[0], way, side="right") - 1
    t = (way - (rows - rows[0])[at]) / gaps[at]
    inside = gaps[at] <= SECTOR * np.median(gaps)
    out = np.zeros((len(beta), len(angle)))
    out[np.arange(len(beta)), order[at]] = (1 - t) * inside
    out[np.arange(len(beta)), order[(at + 1) % len(angle)]] += t * inside
    return out
