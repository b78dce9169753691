"""Partial waves about a vertical axis, and the partial waves of one axis seen from another axis.

A body in a circle of radius a sends Σ Zₙ(z) bₙₘ Sₙₘ(r) exp(imθ); waves from elsewhere are Σ Zₙ(z) aₙₘ Rₙₘ(r) exp(imθ):

    kind        regular R                  outgoing S
    radiating   Jₘ(kr) |Hₘ(ka)|            Hₘ(kr) / |Hₘ(ka)|         propagating mode
    decaying    Iₘ(κr) / Iₘ(κa)            Kₘ(κr) Iₘ(κa)             evanescent modes
    laplace     (r/a)ᵐ                     (a/r)ᵐ, log r             κ → 0

with |m| in place of m. The scales keep R and S from overflow.
Graf's addition theorem (DLMF 10.23.7) converts the outgoing waves of a first axis into regular waves of a second
axis, at points that are nearer to the second axis than the first axis is. With R and α the distance and direction of
the second axis from the first,

    Hₘ e^{imθ} = Σ_q Hₘ₋q(kR) e^{i(m−q)α} J_q e^{iqθ′},    Kₘ e^{imθ} = Σ_q (−1)^q Kₘ₋q(κR) e^{i(m−q)α} I_q e^{iqθ′}
"""

from typing import NamedTuple

import numpy as np
from scipy.special import binom, hankel1, ive, jv, kve

LARGEST = 1e150  # of a wave where it is scaled, so that products of two are finite


class PartialWaves(NamedTuple):
    """The partial waves of one depth mode.

    kind : "radiating", "decaying" or "laplace"; k : wavenumber, rad/m; last : highest order
    """

    kind: str
    k: float
    last: int

    @property
    def orders(self):
        """Orders m of exp(imθ), rising; shape (2 last + 1,)"""
        return np.arange(-self.last, self.last + 1)

    def size(self, a):
        """Size of partial waves: |Hₘ(ka)| for radiating waves, 1 for other kinds; shape (last + 1,)"""
        m = np.arange(self.last + 1)
        return np.abs(hankel1(m, self.k * a)) if self.kind == "radiating" else np.ones(len(m))

    def regular(self, a, r):
        """R and dR/dr of orders 0 … last at r (p,) m; two arrays (p, last + 1)"""
        m, r = np.arange(self.last + 1), np.asarray(r, float)[:, None]
        if self.kind == "laplace":
            value = (r / a) ** m
            return value, m * value / r
        x = self.k * r
        if self.kind == "radiating":
            J = jv(np.arange(self.last + 2), x)
            return self.size(a) * J[:, :-1], self.size(a) * (m / r * J[:, :-1] - self.k * J[:, 1:])
        scale, I = np.exp(x - self.k * a) / ive(m, self.k * a), ive(np.arange(self.last + 2), x)
        return scale * I[:, :-1], scale * (m / r * I[:, :-1] + self.k * I[:, 1:])

    def outgoing(self, a, r):
        """|S| of orders 0 … last at the distance r > a, m; shape (last + 1,)"""
        m = np.arange(self.last + 1)
        if self.kind == "laplace":
            return (a / r) ** m
        if self.kind == "radiating":
            return np.abs(hankel1(m, self.k * r)) / self.size(a)
        return kve(m, self.k * r) * ive(m, self.k * a) * np.exp(self.k * (a - r))

    @property
    def wronskian(self):
        """Wronskian R (S dR/dr − R dS/dr); shape (last + 1,)"""
        m = np.arange(self.last + 1)
        if self.kind == "laplace":
            return np.where(m, 2.0 * m, -1.0)
        return np.full(len(m), -2j / np.pi if self.kind == "radiating" else 1.0)

    def seen_from(self, there, a, there_a):
        """Matrix from the waves that this axis sends to regular waves about a second axis; shape (2 last + 1, 2 last
        + 1)

        there : position of the second axis relative to this axis, complex, m
        a, there_a : radii of the circles about this axis and about the second axis, m
        """
        m, R, turn = self.orders, abs(there), there / abs(there)
        if self.kind == "laplace":
            return self._laplace_seen(there, a, there_a)
        apart, far = m[None, :] - m[:, None], np.arange(2 * self.last + 1)  # m − q, of what is sent in columns
        if self.kind == "radiating":
            # H₋ₘ = (−1)ᵐ Hₘ and J alike: |m| for m changes signs
            sign = np.where(m < 0, (-1.0) ** m, 1.0)
            wave = hankel1(far, self.k * R)[np.abs(apart)] * np.where(apart < 0, (-1.0) ** apart, 1.0)
            send, take = (self.size(radius)[np.abs(m)] for radius in (a, there_a))
            return wave * turn**apart * (sign / take)[:, None] * (sign / send)
        send, take = (ive(np.abs(m), self.k * radius) for radius in (a, there_a))
        fall = kve(far, self.k * R)[np.abs(apart)] * np.exp(self.k * (a + there_a - R))
        return fall * turn**apart * ((-1.0) ** m * take)[:, None] * send

    def _laplace_seen(self, there, a, there_a):
        q, out, middle = np.arange(self.last + 1), np.zeros((2 * self.last + 1,) * 2, complex), self.last
        for p in range(1, self.last + 1):
            found = (-1.0) ** q * binom(p + q - 1, q) * (a / there) ** p * (there_a / there) ** q
            out[middle + q, middle - p], out[middle - q, middle + p] = found, found.conj()
        found = (-1.0) ** (q[1:] + 1) / (2 * q[1:]) * (there_a / there) ** q[1:]
        out[middle, middle] = np.log(abs(there))
        out[middle + q[1:], middle], out[middle - q[1:], middle] = found, found.conj()
        return out


def highest_order(kind, k, a, apart, gap, tolerance, most):
    """Highest order of partial waves that is needed between bodies in circles of radius a, m

    Order m of the waves that a box sends decreases like (a / apart)ᵐ on the way to the next axis. Waves that pass a
    body have no more orders than plane waves on the circle of the body.
    Decaying waves matter only if they cross the gap
    and return.
    apart : distance from axis to axis, m; gap : distance from hull to hull, m
    """
    m = np.arange(1, _finite(kind, k, a, apart, most) + 1)
    left = (a / apart) ** m
    if kind == "radiating":
        passed = np.abs(hankel1(m, k * apart) / hankel1(m, k * a))
        left = np.where(m > k * a, np.maximum(passed, np.abs(jv(m, k * a))), 1.0)
    elif kind == "decaying":
        left = np.minimum(left, (kve(m, k * (a + gap)) / kve(m, k * a) * np.exp(-k * gap)) ** 2)
    enough = np.flatnonzero(left < tolerance)
    return int(m[enough[0] if len(enough) else -1])


def _finite(kind, k, a, apart, most):
    """Highest order up to `most` whose waves, and those of twice the order at the next axis, do not overflow"""
    if kind == "laplace":
        return most
    m = np.arange(1, most + 1)
    with np.errstate(all="ignore"):
        if kind == "radiating":
            sizes = np.abs(hankel1(m, k * a)), np.abs(hankel1(2 * m, k * apart))
        else:
            sizes = 1 / ive(m, k * a), kve(2 * m, k * apart)
    return max(1, int(np.sum(np.maximum(*sizes) < LARGEST)))


def to_real(orders):
    """Matrix from coefficients of exp(imθ) to coefficients of cos 0 … M and sin 1 … M; shape (2M + 1, 2M + 1)"""
    last = orders[-1]
    m = np.arange(last + 1)
    cos = (np.abs(orders) == m[:, None]).astype(complex)
    sin = 1j * np.sign(orders) * (np.abs(orders) == m[1:, None])
    return np.vstack([cos, sin])


def to_complex(orders):
    """Inverse of the matrix `to_real`; shape (2M + 1, 2M + 1)"""
    return np.linalg.inv(to_real(orders))
