"""First-order waves on the free surface around a vertical cylinder, from its side outwards, by the contour method.

    φ = −(ig/ω) exp(ikr cos(θ − β)) + Σ_m e^{imθ} {c_m H_m(kr) + Σₙ Zₙ(0) Kₘ(kₙr) / kₙKₘ'(kₙR) ⟨∂φ/∂r, Zₙ⟩_m / ⟨Zₙ, Zₙ⟩}

on r > R, with c_m from the potential of the propagating mode on the side.  The local part is given on rings that
begin at the side, in the form used for panels (`surface_waves`).
"""

import numpy as np
from scipy.special import hankel1, jv, kve

from ..contour.hull.flow import IMAGES, SIGNS, amplitudes, in_waves, of_motions
from ..contour.plan.maps import CLASSES
from ..contour.plan.potentials import plan_values
from ..depth_modes.gap import evanescent_wavenumbers, smooth_cutoff
from ..waves import wavenumber
from .surface_far import Rings, orders_sent
from .surface_near import Circle
from .surface_waves import Field, Wave

# width of the first interval of rings, over the smaller of depth and radius, and growth factor of the next ones
FIRST, WIDER = 0.02, 1.5
DIES, NEAREST = 14.0, 2e-3  # exp(−14) is 1e-6, where the local part ends; of the depth, what sums over modes tell apart
BEYOND = 6  # orders more than `orders_sent`


class CylinderSurface:
    """First-order waves in the form of `surface_waves.SurfaceWaves`, with points only on rings

    points : `bem.contour.hull.flow.HullPoints`; surfaces : `HullSurfaces`
    omega, of_force : frequencies of the waves and of the force, rising, rad/s
    """

    def __init__(self, problem, points, surfaces, omega, of_force):
        self.problem, self.points, self.line = problem, points, surfaces.waterline
        self.radius = points.body.plan.radius
        self.circle = Circle(np.zeros(2), self.radius, np.full(2, self.radius))
        h, width, highest = problem.depth, FIRST * min(problem.depth, self.radius), max(omega[-1], of_force[-1])
        slowest = evanescent_wavenumbers(highest, h, 1, problem.gravity)[0]
        edges = [self.radius]
        while edges[-1] < self.radius + DIES / slowest:
            edges.append(edges[-1] + width)
            width *= WIDER
        shortest = float(wavenumber(highest, h, problem.gravity))
        self.most = orders_sent(shortest * self.radius) + BEYOND
        self.rings = Rings(np.array(edges), 4 * (self.most // 2 + 1), np.zeros(2))
        self.weights, self.waves = np.zeros(0), []

    def add(self, freq, motions):
        """Add the waves of a `SharedFrequency` with motions (m, 6) about the origin"""
        start = freq.amplitude
        whole, local = self._of(freq, in_waves(freq, motions), len(motions))
        m = np.arange(-self.most, self.most + 1)
        for beta, own, near in zip(freq.headings, whole, local, strict=True):
            coming = start * 1j ** (m % 4) * np.exp(-1j * m * beta) * jv(m, freq.k * self.radius)
            sent = (own - coming) / hankel1(m, freq.k * self.radius)
            self.waves.append(Wave(freq.omega, freq.k, beta, start, sent, near))

    def joined(self):
        """Fields near the body: none, because all points are on rings"""
        return [Field(np.zeros((len(self.waves), 0)), np.zeros((2, len(self.waves), 0)))] * 2

    def radiated(self, freq, flow):
        """Field near the body, which has no points, and [`Wave`] of the six motions of unit velocity"""
        whole, local = self._of(freq, of_motions(freq), 6)
        m = np.arange(-self.most, self.most + 1)
        H = hankel1(m, freq.k * self.radius)
        waves = [Wave(freq.omega, freq.k, 0.0, 0.0, own / H, near) for own, near in zip(whole, local, strict=True)]
        return Field(np.zeros((6, 0)), np.zeros((2, 6, 0))), waves

    def _of(self, freq, columns, count):
        """Parts e^{imθ} (count, 2 most + 1) of the propagating mode on the side, and local parts (count, w, r, n)

        columns : {class: (count, columns)} of the flows of the class
        """
        values, radii = plan_values(freq), self.rings.radii
        local = np.zeros((count, radii.size, self.rings.count), complex)
        whole = np.zeros((count, 2 * self.most + 1), complex)
        c, tables = freq.contour, self._tables(freq)
        m = np.arange(-self.most, self.most + 1)
        for cls, signs in zip(CLASSES, SIGNS, strict=True):
            dofs, _, sides, flow = freq.flows[cls]
            g = np.einsum("fc,mc->fm", columns[cls], amplitudes(freq, values[cls], cls)[0][0])
            for sign, image in zip(signs, IMAGES, strict=True):
                theta = np.arctan2(image[1] * c.y, image[0] * c.x)
                turn = np.exp(-1j * np.outer(theta, m)) * (c.weights / (2 * np.pi * self.radius))[:, None]
                whole += sign * g @ turn
            velocity = np.concatenate([flow.velocity, np.zeros((2, *flow.velocity.shape[1:]))])
            velocity[-2:, :, : len(dofs)] = np.moveaxis(sides, 0, -1)
            velocity = np.einsum("fc,rnc->frn", columns[cls], velocity)
            self._add_local(local, cls, freq.degree, tables, velocity)
        return whole, local.reshape(count, *radii.shape, -1)

    def _add_local(self, local, cls, degree, tables, velocity):
        plan = self.points.body.plan
        orders = plan.orders(cls, degree)
        scale = 1 / np.sqrt(np.pi * self.radius * np.where(orders, 1, 2))
        for n, (m, size) in enumerate(zip(orders, scale, strict=True)):
            if m > self.most:
                break
            part = np.einsum("pr,fr->fp", tables[m], velocity[:, :, n]) * size
            ahead, back = (0.5, 0.5) if cls[1] == 1 else (-0.5j, 0.5j)  # cos mθ or sin mθ
            local[:, :, m] += ahead * part
            local[:, :, -m] += back * part

    def _tables(self, freq):
        """Tables from velocities by their rows to what decays, on the rings; shape (degree + 1, p, r)"""
        body, radii = self.points.body, self.rings.radii.ravel()
        gap, R = body.profiles.gap, self.radius
        most = int(np.ceil(DIES / (np.pi * NEAREST)))
        modes = gap.outer_modes(freq.omega, most, freq.gravity)
        kn = modes.wavenumbers
        rows = (body.profiles.combinations @ modes.rows).T * (np.cos(kn * gap.depth) / modes.norms / kn)[:, None]
        out = np.zeros((freq.degree + 1, len(radii), rows.shape[1]))
        wall = _decaying(freq.degree + 1, kn * R)
        slope = -0.5 * (np.concatenate([wall[1:2], wall[:-2]]) + wall[1:])
        for p, r in enumerate(radii):
            count = min(most, max(8, int(np.ceil(DIES * gap.depth / (np.pi * (r - R))))))
            k = kn[:count]
            cut = smooth_cutoff(np.arange(1, count + 1) / count) if count == most else 1.0
            value = _decaying(freq.degree, k * r) * np.exp(-k * (r - R)) * cut
            out[:, p] = (value / slope[:, :count]) @ rows[:count]
        return out


def _decaying(last, x):
    """exp(x) Kₘ(x) of order 0 … last, (last + 1, x), by recurrence, which is stable for them"""
    out = np.empty((max(last, 1) + 1, len(x)))
    out[0], out[1] = kve(0, x), kve(1, x)
    for m in range(1, last):
        out[m + 1] = out[m - 1] + 2 * m / x * out[m]
    return out[: last + 1]
