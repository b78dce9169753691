"""Quadratic part of slow forces of pairs by momentum: through an upright cylinder around the body, instead of the
pressure on its hull.

    F_c = ½ρ ∬_C |∇φ|² N_c dS − ½ρg ∮_C η² N_c dl − ρ ∬_C v_c ∂φ/∂r dS − d/dt G_c
    G_c = ρ {∮_C φη N_c dl − ∬_F φ (∂η/∂x, ∂η/∂y, ∂η/∂θ)_c dS − ∮_W φ (η − X_z) n_c dl
             − ∬_B {(X·∇φ) n_c + φ (α × n, X_0 × n + α × (x × n))_c} dS}

c : surge, sway, yaw about the middle of the circle; N, n outwards of cylinder and body; C the cylinder to the bed, F
the surface between it and the body, W the waterline, B the mean hull.  The momentum of the water inside C is ρ ∬ φN
over all that bounds it; G is what of it is of second order by first-order waves.  At equal frequencies G does nothing
and F is the mean drift; at others it is several times F, and cancels.  Of the pressure on the hull nothing is used; the
potentials of its panels are.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.panels.pressure_drift.hull_flow import unit_displacements, wave_flow
from hakobune.bem.second_order.first_order_waves import PanelWaves
from hakobune.bem.second_order.surface_near import SurfaceInfluence
from hakobune.bem.waves import incident_wave

MODES = [0, 1, 5]
THICKNESS = 0.35  # of the clearance of body and circle, over which potentials are known on both sides of it
RADII, DEPTHS = 5, 8  # points across it, and over an interval of depths
DIRECTIONS = 160  # a multiple of four
INTERVALS = {"finite": (0.0, 0.5, 1.0), "deep": (0.0, 0.15, 0.4, 1.0)}  # of the depth, of the deeper than a radius
legendre = np.polynomial.legendre


class ControlSurface:
    """Waves of a `PanelWaves` with its surface on the upright cylinder over the circle about the body"""

    def __init__(self, waves):
        self.waves, self.geometry, circle = waves, waves.around.geometry, waves.around.circle
        self.radius, depth = circle.radius, waves.problem.depth
        corners = np.hypot(*(self.geometry.mesh.whole().points[:, :2] - circle.centre).T)
        x = legendre.leggauss(RADII)[0]
        width = THICKNESS * (self.radius - corners.max())
        self.inwards, slope = (part[0] for part in _through(x, np.zeros(1)))
        self.outwards = slope / width
        theta = 2 * np.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
        self.ray = np.stack([np.cos(theta), np.sin(theta)], axis=1)
        images = np.array(self.geometry.images)
        meshed = [np.all(np.where(images.min(axis=0) < 0, self.ray * image, 1.0) > 0, axis=1) for image in images]
        self.image = np.argmax(meshed, axis=0)
        own = self.ray[self.image == 0]
        self.place = np.argmin(np.abs((self.ray * images[self.image])[:, None] - own).sum(axis=2), axis=1)
        self.z, self.heights, self.steeper = _depths(depth, INTERVALS["deep" if depth > self.radius else "finite"])
        at = np.empty((len(self.z), RADII, len(own), 3))
        at[..., :2] = circle.centre + (self.radius + width * x)[:, None, None] * own
        at[..., 2] = self.z[:, None, None]
        self.shape, self.influence = at.shape[:-1], SurfaceInfluence(self.geometry, at.reshape(-1, 3))
        self.points = np.empty((len(self.z), DIRECTIONS, 3))
        self.points[..., :2], self.points[..., 2] = circle.centre + self.radius * self.ray, self.z[:, None]
        self.potential, self.velocity = [], []

    def add(self, run, motions):
        """Take in the waves of a `PanelRun` with motions (m, 6) about the origin"""
        flows = [run.disturbance(j, motion) for j, motion in enumerate(motions)]
        flows = {cls: tuple(np.array([f[cls][i] for f in flows]) for i in range(2)) for cls in run.geometry.classes}
        flows = {cls: both for cls, both in flows.items() if np.any(both[0]) or np.any(both[1])}
        total = sum(
            found.reshape(len(motions), *self.shape)[..., self.place] * self.geometry.signs(cls)[self.image]
            for cls, found in self.influence.values(run, flows).items()
        )
        phi, out = (np.einsum("r,fzrn->fzn", part, total) for part in (self.inwards, self.outwards))
        order = np.fft.fftfreq(DIRECTIONS, 1 / DIRECTIONS)
        along = np.fft.ifft(1j * order * np.fft.fft(phi)) / self.radius
        up = np.einsum("yz,fzn->fyn", self.steeper, phi)
        up[:, 0] = run.omega**2 / run.problem.gravity * phi[:, 0]
        x, y = self.ray.T
        velocity = np.stack([out * x - along * y, out * y + along * x, up], axis=-1)
        of, g = run.problem.depth, run.problem.gravity
        for own, other, beta in zip(phi, velocity, run.headings, strict=True):
            coming = incident_wave(self.points, beta, run.omega, run.k, of, g)
            self.potential.append(own + coming[0])
            self.velocity.append(other + coming[1])

    def pairs(self, flow):
        """(f, f, 3) T of all pairs of the f waves, whose `HullFlow` on the hull is given, N/m², N m/m²"""
        rho, g, omega = self.waves.problem.density, self.waves.problem.gravity, flow.omega
        phi, v = np.array(self.potential), np.array(self.velocity)
        arc, (x, y) = 2 * np.pi * self.radius / DIRECTIONS, self.ray.T
        area, rise = self.heights[:, None] * arc + 0 * x, 1j * omega[:, None] / g * phi[:, 0]
        normal = np.stack([x, y, 0 * x])
        through, turning = v[..., 0] * x + v[..., 1] * y, self.radius * (v[..., 1] * x - v[..., 0] * y)
        carried = v[..., 0], v[..., 1], turning
        still = np.stack([_product(phi[:, 0], rise, arc * n) for n in normal], axis=-1) + self._inside(flow)
        out = np.stack(
            [
                0.5 * sum(_product(v[..., d], v[..., d], area * n) for d in range(3))
                - 0.5 * g * _product(rise, rise, arc * n)
                - _product(own, through, area)
                for n, own in zip(normal, carried, strict=True)
            ],
            axis=-1,
        )
        return rho * (out + 1j * (omega[:, None] - omega)[..., None] * still)

    def _inside(self, flow):
        """(f, f, 3) of G/ρ at body and surface"""
        around, surfaces, g = self.waves.around, self.waves.surfaces, self.waves.problem.gravity
        hull, line, X = surfaces.hull, surfaces.waterline, flow.motion
        n, arms = hull.normals, np.cross(hull.points, hull.normals)
        turned = np.cross(X[:, None, 3:], n)
        moment = np.cross(X[:, None, :3], n) + np.cross(X[:, None, 3:], arms)
        changed = turned[..., 0], turned[..., 1], moment[..., 2]
        displaced = np.einsum("fm,mpd->fpd", X, unit_displacements(hull.points))
        rise = 1j * flow.omega[:, None] / g * flow.potential - X @ unit_displacements(line.points)[..., 2]
        water = around.joined()[0]
        sx, sy = 1j * flow.omega[:, None] / g * water.slope
        slopes, out = (sx, sy, around.points[:, 0] * sy - around.points[:, 1] * sx), []
        for c, mode in enumerate(MODES):
            weight = hull.weights * surfaces.hull_modes[:, mode]
            part = sum(_product(displaced[..., d], flow.velocity[..., d], weight) for d in range(3))
            part = part + _product(flow.on_hull, changed[c], hull.weights)
            part = part + _product(flow.potential, rise, line.weights * surfaces.waterline_modes[:, mode])
            out.append(-part - _product(water.value, slopes[c], around.weights))
        return np.stack(out, axis=-1)


def by_momentum(problem, omega, heading, moving):
    """(3, n, n, 3) T of surge, sway and yaw about the origin of pairs of waves of one heading: by the control surface;
    by the pressure on the hull; as `quadratic_forces` has it, with what the far field adds

    problem : `PanelProblem` of a body whose middle is the origin, about which moments are; heading : rad
    omega : (n,) rad/s, rising
    """
    from hakobune.bem.second_order.quadratic_forces import _by_far_field

    omega = np.asarray(omega, float)
    waves = PanelWaves(problem, omega, [heading], moving, np.array([0.0, omega[1] - omega[0]]), True)
    control = ControlSurface(waves)
    for w in omega:
        run = waves.prepared.run(w, waves.headings, waves.wanted, None, DOFS)
        motions = waves.take(run, lambda motions, run=run: wave_flow(run, waves.surfaces, motions))
        waves.around.add(run, waves.parts[-1], motions)
        control.add(run, motions)
    flow, squares = waves.joined()
    pressure = squares[:, 0, :, 0, MODES].copy()
    _by_far_field(squares, np.array(waves.far), flow)
    far = squares[:, 0, :, 0, MODES]
    return np.array([control.pairs(flow), *(np.moveaxis(part, 0, -1) for part in (pressure, far))])


def _product(one, two, weights):
    """(f, f) T of the integral of the product of two quantities (f, …) with weights (…)"""
    one, two, weights = one.reshape(len(one), -1), two.reshape(len(two), -1), weights.ravel()
    return 0.25 * ((one * weights) @ two.conj().T + (two * weights) @ one.conj().T)


def _through(x, at):
    """Values and slopes (n, x) at `at` of the polynomial through values at x"""
    inverse = np.linalg.inv(legendre.legvander(x, len(x) - 1))
    slopes = legendre.legval(at, legendre.legder(np.eye(len(x)))).T
    return legendre.legvander(at, len(x) - 1) @ inverse, slopes @ inverse


def _depths(depth, shares):
    """(z,) m, the surface first; weights (z,) m, none there; (z, z) slopes in 1/m, none there"""
    x, w = legendre.leggauss(DEPTHS)
    own, count = _through(x, x)[1], DEPTHS * (len(shares) - 1)
    z, weights, slopes = np.zeros(count + 1), np.zeros(count + 1), np.zeros((count + 1, count + 1))
    for i, (low, high) in enumerate(pairwise(shares)):
        part, half = slice(1 + i * DEPTHS, 1 + (i + 1) * DEPTHS), depth * (high - low) / 2
        z[part], weights[part], slopes[part, part] = -depth * low - half * (1 - x), half * w, own / half
    return z, weights, slopes
