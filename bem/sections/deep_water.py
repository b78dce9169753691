"""Waves radiated by a rectangle in deep water, in two dimensions: Green's integral equation on its contour.

    ½ φ(P) + ∮ φ ∂G/∂n dl = ∮ G ∂φ/∂n dl,      n out of the body, 0 in place of ½φ at points inside
    2πG = ln r − ln r′ − 2I,   I = Re C(x) + iπ e^{KZ} cos KY,   C = eˣ (E₁(x) + iπ),   x = K(Z + iY)

Y = |y − η|, Z = z + ζ, r′ from the image above the surface, K = ω²/g; C′ = C − 1/x.  Wehausen and Laitone (1960),
eq. 13.31, with exp(−iωt).  The half contour y > 0 has Gauss points on panels. Towards the edge, where φ is like
distance^(2/3), and towards the waterline each panel is four times smaller than the panel before.
Even and odd flows are solved separately.

- The logarithms of ∮ G ∂φ/∂n are integrated in closed form.  In ∮ φ ∂G/∂n the sum of every row is corrected to the
  angle that the contour subtends. On the unresolved last panels at the edge φ is then constant instead of zero.
- Errors are relative to |A + iB/ω|: smaller damping than the tolerance times this coefficient is not resolved.
- Points inside, on the waterline, remove the irregular frequencies (Schenck, Journal of the Acoustical Society of
America 44, 1968).
"""

from functools import cached_property, lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.special import exp1

from ..froude_krylov import incident_force

SWAY, HEAVE, ROLL = range(3)
NODES = 10  # nodes on a panel
MOST_POINTS = 1500  # largest number of points on half the contour (5000 would take 80 s)
GOLDEN = (np.sqrt(5) - 1) / 2


class Contour(NamedTuple):
    """Half of the contour: points y, z, m, (n,), weights, m, (n,), whether each point lies on the side, and panels
    per length"""

    y: np.ndarray
    z: np.ndarray
    weights: np.ndarray
    side: np.ndarray

    def normal_velocities(self):
        """Normal velocities by unit sway, heave and roll; shape (3, n)"""
        side = self.side
        return np.array([side, ~side * -1.0, np.where(side, -self.z, -self.y)])


@lru_cache(maxsize=32)
def contour(beam, draft, longest, tolerance):
    """`Contour` with panels up to `longest` m, fine enough at the edge for `tolerance`."""
    b, d = beam / 2, draft
    levels = int(np.ceil(-0.4 * np.log(tolerance) / np.log(4))) + 1  # error < 1e-2 (length of the last)^(5/3)
    bottom, w_bottom = _gauss(_split(b - b * _graded(levels)[::-1], min(longest, 2 * d)))
    from_edge = np.concatenate([d / 2 * _graded(levels), d - d / 2 * _graded(levels // 2)[-2::-1]])
    up, w_side = _gauss(_split(from_edge, min(longest, 2 * b)))
    y, z = np.append(bottom, np.full(len(up), b)), np.append(np.full(len(bottom), -d), up - d)
    return Contour(y, z, np.append(w_bottom, w_side), np.arange(len(y)) >= len(bottom))


def _graded(levels):
    """0, 4^−levels … ¼, 1"""
    return np.append(0.0, 4.0 ** -np.arange(levels, -1, -1))


def _split(ends, longest):
    parts = [np.linspace(a, b, 1 + int(np.ceil((b - a) / longest)))[:-1] for a, b in pairwise(ends)]
    return np.append(np.concatenate(parts), ends[-1])


def _gauss(ends):
    x, w = np.polynomial.legendre.leggauss(NODES)
    half = np.diff(ends)[:, None] / 2
    return (ends[:-1, None] + half * (1 + x)).ravel(), (half * w).ravel()


class DeepFlow:
    """The three radiated flows at one frequency, with the interface of `finite_depth.FiniteDepthFlow`.

    beam, draft : m; omega : rad/s; gravity : m/s²; tolerance : relative error
    """

    depth = np.inf

    def __init__(self, beam, draft, omega, gravity, tolerance):
        self.beam, self.draft, self.omega, self.gravity = beam, draft, omega, gravity
        self.k = omega**2 / gravity
        # waves and their decay need a few points per radian
        longest = float(2.0 ** np.floor(np.log2(4 / self.k)))
        points = NODES * (beam / 2 / min(longest, 2 * draft) + draft / min(longest, beam))
        if points > MOST_POINTS:
            raise ValueError(
                f"omega {omega:g} rad/s, beam {beam:g} m, draft {draft:g} m need {points:.0f} points in deep water; "
                f"allowed: {MOST_POINTS}; use a finite depth or a lower omega"
            )
        self.contour = contour(beam, draft, longest, tolerance)
        self.radiated = self._radiated()

    def _radiated(self):
        """φ of sway, heave, roll at the points of the half contour, (3, n)"""
        c = self.contour
        count = 4 + int(np.ceil(self.k * self.beam))
        inside = self.beam / 2 * ((GOLDEN * np.arange(1, count + 1)) % 1)
        y, z = np.append(c.y, inside), np.append(c.z, np.zeros(count))
        own, mirror = (self._kernels(y, z, sign) for sign in (1, -1))
        self._correct_row_sums(own[0])
        jump = np.vstack([np.eye(len(c.y)) / 2, np.zeros((count, len(c.y)))])
        out = np.empty((3, len(c.y)), complex)
        for symmetric, modes in ((False, [SWAY, ROLL]), (True, [HEAVE])):
            sign = 1 if symmetric else -1
            matrix, sources = jump + own[0] + sign * mirror[0], own[1] + sign * mirror[1]
            Q, R = np.linalg.qr(matrix)  # a quarter of the time of a singular value decomposition
            out[modes] = np.linalg.solve(R, Q.conj().T @ sources[:, modes]).T
        return out

    def _correct_row_sums(self, kernel):
        """Correct the diagonal so that ∫ ∂ ln r/∂n dl is the angle that the half contour subtends."""
        c, b, d = self.contour, self.beam / 2, self.draft
        n = len(c.y)
        angle = np.where(c.side, np.arctan2(b, d + c.z), np.arctan2(d, b - c.y))
        dy, dz = c.y - c.y[:, None], c.z - c.z[:, None]
        np.fill_diagonal(dz, 1.0)
        summed = (np.where(c.side, dy, -dz) / (dy**2 + dz**2) * c.weights * (c.side != c.side[:, None])).sum(1)
        kernel[np.arange(n), np.arange(n)] += (angle - summed) / (2 * np.pi)

    def _kernels(self, y, z, sign):
        """∂G/∂n times weight (p, n), and ∫ G ∂φ/∂n dl of the three motions (p, 3), for points (p,) and for the half
        contour (sign 1) or its mirror image; mirrored motions keep the velocities of the half contour"""
        c, k = self.contour, self.k
        dy, dz = sign * c.y - y[:, None], c.z - z[:, None]
        Y, Z = np.abs(dy), c.z + z[:, None]
        x = k * (Z + 1j * Y)
        C = np.exp(x) * (exp1(x) + 1j * np.pi)
        slope, wave = C - 1 / x, np.exp(k * Z)
        same = (dy == 0) & (dz == 0)
        r2, mirrored = np.where(same, 1.0, dy**2 + dz**2), Y**2 + Z**2
        along_y = np.sign(dy) * (2 * k * slope.imag + 2j * np.pi * k * wave * np.sin(k * Y)) + dy / r2 - dy / mirrored
        along_z = -2 * k * slope.real - 2j * np.pi * k * wave * np.cos(k * Y) + dz / r2 - Z / mirrored
        normal = np.where(c.side, sign * along_y, -along_z) * c.weights / (2 * np.pi)
        regular = -2 * C.real - np.log(mirrored) - 2j * np.pi * wave * np.cos(k * Y)
        sources = regular @ (c.weights * c.normal_velocities()).T
        for up in (1, -1):  # ln r and ln r′
            sources += self._logarithms(sign * y, up * z)
        return normal, sources / (2 * np.pi)

    def _logarithms(self, y, z):
        """∫ ln r ∂φ/∂n dl over the half contour in closed form, (p, 3)"""
        b, d = self.beam / 2, self.draft
        side, side_moment = _segment(-d - z, -z, b - y)
        bottom, bottom_moment = _segment(-y, b - y, -d - z)
        roll = -(side_moment + z * side) - (bottom_moment + y * bottom)
        return np.stack([side, -bottom, roll], axis=-1)

    @cached_property
    def wave_exciting(self):
        """∮ (φ_I + φ_D) n dl of sway, heave, roll on the fixed body in a unit wave towards +y, by Haskind; shape
        (3,)"""
        force = incident_force(self.beam / 2, self.draft, np.inf, self.k, np.array([self.k]))[0]
        return 1j * self.gravity / self.omega * force - self.haskind_integral([1.0])[0]

    def force(self, flow, mode):
        """∮ φ n dl along `mode` over the whole contour, n out of the body, for a flow with the parity of the mode"""
        c = self.contour
        return 2 * np.sum(flow * c.weights * c.normal_velocities()[mode])

    def radiated_wave(self, mode):
        """Potential at z = 0 of the wave that `mode` radiates towards y → ∞, referred to y = 0"""
        c, k = self.contour, self.k
        even, odd = np.cos(k * c.y), -1j * np.sin(k * c.y)
        wave, opposite = (even, odd) if mode == HEAVE else (odd, even)
        normal = np.where(c.side, -1j * k * opposite, -k * wave)
        flux = self.radiated[mode] * normal - c.normal_velocities()[mode] * wave
        return 2j * np.sum(flux * np.exp(k * c.z) * c.weights)

    def reflection_transmission(self):
        """Complex R and T of the fixed body for a wave towards +y, both referred to y = 0, from the phases of the
        forces"""
        sway, heave, _ = -1j * self.wave_exciting
        even, odd = (heave / abs(heave)) ** 2, (sway / abs(sway)) ** 2
        return (even + odd) / 2, (even - odd) / 2

    def haskind_integral(self, sines):
        """∮ φⱼ ∂φ_I/∂n dl of the three radiated flows for φ_I = −(ig/ω) exp(Kz + iKy sinβ); shape (m, 3)

        sines : sinβ of the waves, (m,)"""
        c, kappa = self.contour, self.k * np.asarray(sines, float)[:, None]
        even, odd = np.cos(kappa * c.y), 1j * np.sin(kappa * c.y)
        weights = 2 * np.exp(self.k * c.z) * c.weights
        out = np.empty((len(kappa), 3), complex)
        for mode, (wave, opposite) in enumerate(((odd, even), (even, odd), (odd, even))):
            normal = np.where(c.side, 1j * kappa * opposite, -self.k * wave)
            out[:, mode] = (normal * weights) @ self.radiated[mode]
        return -1j * self.gravity / self.omega * out


def _segment(start, end, off):
    """∫ ln r du and ∫ u ln r du from `start` to `end` of u, r² = u² + off²"""
    values = []
    for u in (end, start):
        r2 = u * u + off * off
        log = np.log(np.where(r2 > 0, r2, 1.0))
        plain = u * log / 2 - u + off * np.arctan2(u, np.abs(off)) * np.sign(off)
        values.append((plain, (r2 * log - u * u) / 4))
    return values[0][0] - values[1][0], values[0][1] - values[1][1]
