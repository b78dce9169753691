"""First-order waves on the free surface beyond a circle about the body, as sums over angular orders.

    φ = −(ig/ω) Σ_m e^{imθ} {iᵐ c_m H_m(kr) + iᵐ e^{−imβ} J_m(kr)} + local part

with c_m of the Kochin function H(θ) = Σ c_m e^{imθ} of the far field. The local part of the potential decays within
the depth or, in deep water, within some wavelengths; it is interpolated between rings.
"""

from dataclasses import dataclass

import numpy as np

from ..kochin import far_field_integrals
from ..waves import depth_values
from .kinds import DIFFERENCE, SUM

RING_POINTS, GROWTH = 6, 1.6  # rings of one interval of radii, and growth factor of the interval widths
# distance from the circle to the end of the local part, in depths, 1/k and radii.  For sums k is that of the wave of
# the sum; with the reach of differences the part of the surface, as large as the whole force, is 6 % off
REACH = {DIFFERENCE: (2.0, 8.0, 10.0), SUM: (4.0, 32.0, 10.0)}
LOCAL = 2.0  # directions of rings per radiated order
BEYOND = 12  # orders above the last: to twice that |z| Bessel functions are not halves of Hankel functions
# start value of a recurrence, size at which it is rescaled, and orders between two checks
SMALL, LARGE, CHECKED = 1e-250, 1e150, 8
MORE = 1  # Largest order radiated by a body within a circle of kr = x


def orders_sent(x):
    """Largest order of the waves that a body within a circle of kr = x radiates"""
    return (x + 4 * np.cbrt(x) + MORE).astype(int) if isinstance(x, np.ndarray) else int(x + 4 * np.cbrt(x) + MORE)


@dataclass(frozen=True, eq=False)
class Rings:
    """Points where the local parts of the waves are known: n directions on r rings in each of w radial intervals.

    edges : ends of the radial intervals, m, (w + 1,); count : n, a multiple of four, with no direction on an axis
    centre : m, (2,)
    """

    edges: np.ndarray
    count: int
    centre: np.ndarray

    @property
    def radii(self):
        """Radii of the rings, m; shape (w, r)"""
        x = np.polynomial.legendre.leggauss(RING_POINTS)[0]
        low, high = self.edges[:-1, None], self.edges[1:, None]
        return low + (high - low) * (1 + x) / 2

    @property
    def directions(self):
        """Directions of the points on a ring, rad; shape (n,)"""
        return 2 * np.pi * (np.arange(self.count) + 0.5) / self.count

    @property
    def orders(self):
        """Orders of the harmonics, in the order of `numpy.fft`; shape (n,); the last order of an even count is always
        omitted"""
        return np.fft.fftfreq(self.count, 1 / self.count).astype(int)

    def transform(self, values):
        """Coefficients of e^{imθ} of values (…, n) at the directions; shape (…, n)"""
        return np.fft.fft(values, axis=-1) / self.count * np.exp(-1j * np.pi * self.orders / self.count)

    def interpolation(self, w, x):
        """Two matrices (n, r) from values on the rings of interval w to values, and to slopes, 1/m, at places x (n,)
        in −1 … 1"""
        legendre = np.polynomial.legendre
        inverse = np.linalg.inv(legendre.legvander(legendre.leggauss(RING_POINTS)[0], RING_POINTS - 1))
        slope = legendre.legval(x, legendre.legder(np.eye(RING_POINTS))).T
        width = self.edges[w + 1] - self.edges[w]
        return legendre.legvander(x, RING_POINTS - 1) @ inverse, 2 / width * slope @ inverse

    def within(self, radius):
        """Number of intervals inside a radius"""
        return int(np.searchsorted(self.edges, radius * (1 - 1e-9)))


def rings_about(circle, depth, k, most_orders, kind):
    """`Rings` from a `surface_near.Circle` outwards, to the radius beyond which no wave with a wavenumber in k (…) has
    a local part"""
    end = max(reach_of_local(circle, depth, one, kind) for one in np.atleast_1d(k))
    width = 0.5 * min(depth, circle.radius)
    edges = [circle.radius]
    while edges[-1] < end:
        edges.append(edges[-1] + width)
        width *= GROWTH
    return Rings(np.array(edges), 4 * int(np.ceil((LOCAL * most_orders + 4) / 4)), circle.centre)


def directions(most):
    """Number of directions that resolves a product of three waves with orders up to `most`"""
    return 4 * (most + 1)


def reach_of_local(circle, depth, k, kind):
    """Radius, m, beyond which the local part of waves k is neglected in forces of a `kinds.Kind`"""
    depths, waves, radii = REACH[kind]
    return circle.radius + min(depths * depth, max(waves / k, circle.radius), (radii - 1) * circle.radius)


def sent_orders(run, flows, most, centre):
    """Coefficients of orders −most … most of H about `centre`, for flows {class: (φ (c, n), V (c, n))}; shape (c, 2
    most + 1)"""
    g, count = run.geometry.without_lid, 2 * most + 6
    theta = 2 * np.pi * (np.arange(count) + 0.5) / count
    nodes, weights, normals = run.hull
    total = 0.0
    for cls, (phi, V) in flows.items():
        Z = depth_values(run.k, run.problem.depth)(nodes[:, 2])
        total = (
            total
            + far_field_integrals(
                theta, run.k, nodes, weights, normals, Z, g.images, g.signs(cls), np.asarray(phi), np.asarray(V)
            )[0]
        )
    H = -(run.k**2) / (4 * run.group_factor * run.omega) * total
    H = H * np.exp(1j * run.k * (np.cos(theta) * centre[0] + np.sin(theta) * centre[1]))
    m = np.arange(-most, most + 1)
    return H @ np.exp(-1j * np.outer(theta, m)) / count


def hankel_orders(kind, most, z):
    """Hankel functions H_m of kind 1 or 2 and orders 0 … most, and those of the next orders, without e^{±iz}; shape
    (most + 1, …)

    z : complex or real, (…). The recurrence is stable for these functions.
    """
    from scipy.special import hankel1e, hankel2e

    of = hankel1e if kind == 1 else hankel2e
    out = np.empty((most + 2, *z.shape), complex)
    out[0], out[1] = of(0, z), of(1, z)
    for m in range(1, most + 1):
        out[m + 1] = (2 * m / z) * out[m] - out[m - 1]
    return out


def bessel_orders(most, z):
    """Bessel functions J_m of order 0 … most + 1 without e^{|Im z|}; shape (most + 2, …); z (…) complex, Im z ≥ 0

    J_m is half the sum of the two Hankel functions, except where these grow with the order and would cancel.
    """
    out = np.empty((most + 2, *z.shape), complex)
    size, edge = np.abs(z), most + BEYOND
    for low, high in ((0, edge), (edge, 2 * edge)):
        few = (low <= size) & (size < high)
        out[:, few] = _downwards(most + 2, high + 3 * BEYOND, z[few])
    far = z[size >= 2 * edge]
    one, two = (hankel_orders(kind, most, far) for kind in (1, 2))
    out[:, size >= 2 * edge] = 0.5 * (two * np.exp(-1j * far.real) + one * np.exp(1j * far.real - 2 * far.imag))
    return out


def _downwards(count, start, z):
    """Bessel functions J_m without e^{|Im z|}, by recurrence from an order `start` well above |z|, after Miller; shape
    (count, …)

    Values grow by a factor of 2m/|z| per order: too large values are rescaled, together with the orders above.
    At the origin the higher orders become 0, since a double cannot represent the scale.
    """
    from scipy.special import jve

    above, here = np.zeros_like(z), np.full_like(z, SMALL)
    out = np.empty((count, *z.shape), complex)
    for m in range(start, 0, -1):
        above, here = here, (2 * m / z) * here - above
        if m <= count:
            out[m - 1] = here
        if m % CHECKED == 0 and (large := np.abs(here) > LARGE).any():
            above, here = (np.where(large, SMALL * value, value) for value in (above, here))
            out[m - 1 :, large] *= SMALL
    known = jve(np.array([0, 1])[:, None], z)
    larger = np.argmax(np.abs(known), axis=0), np.arange(len(z))
    return out * (known[larger] / out[:2][larger])


def both_signs(values):
    """Values of orders −M … M from the values of orders 0 … M; shape (2M + 1, …)"""
    sign = np.where(np.arange(len(values) - 1, 0, -1) % 2, -1.0, 1.0)
    return np.concatenate([values[:0:-1] * sign.reshape(-1, *[1] * (values.ndim - 1)), values])


def slopes(values, k):
    """Values and slopes k f_m′ of orders 0 … most + 1 of functions of kr:  f_m′ = (f_{m−1} − f_{m+1})/2; shape (most +
    1, …)"""
    before = np.concatenate([-values[1:2], values[:-2]])
    return values[:-1], 0.5 * k * (before - values[1:])
