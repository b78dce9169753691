"""Mean drift by the pressure on the sides of a box or vertical cylinder, from the flow of the contour method.

`near_field` has the formula.  The bottom pushes neither sideways nor round, and on a side ∂φ/∂n is that of the
motions, so that of φ = Σ fₙ(s) Zₙ(z) remain

    ∫ |∇φ|² dz = ∫ |Σ f'ₙ Zₙ|² + |Σ fₙ Z'ₙ|² + |∂φ/∂n|² dz,    ∫ X·∇φ dz,    ζ,        −d < z < 0

|∇φ|² is singular at the keel like distance^(−2/3).  Summed with a smooth cut-off at N modes it lacks a series of
powers N^(−1/3), N^(−2/3) …, of which several cut-offs remove the first.  Sums over modes and depth are taken once for
the table in κ of `contour_sums`; a wave and a motion then cost little.

What this checks: every mode but the wave pushes on the side as it pulls in the gap, and nothing of it is seen far
away, if both sides of the gap agree on the potential there.  The error is of first order in what they do not agree
on, where that of forces and far field is of second: the flow is found anew with one function more in the gap.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .contour_frequency import ContourFrequency
from .drift import about
from .gap import smooth_cutoff
from .plan import CLASSES
from .plan_panels import gauss_rule
from .plan_values import plan_values
from .threads import blas_threads
from .waves import depth_factor, depth_factor_slope

# of the first-order flow; the extrapolation then errs by 1e-4 of the drift of a fixed box and 4e-4 of a floating one;
# more cut-offs enlarge the errors of the table more than they remove
MODES = 4
CUTOFFS, POWERS = 0.7 ** np.arange(4), np.array([1, 2, 3]) / 3


def contour_drift(run, motions):
    """(m, 3) mean surge, sway and yaw of the pressure on the sides, about the rotation centre; N/m², N m/m².

    run : `bem.shape_setup.ShapeRun` of the contour method; motions : (m, 6) about the origin, m/m and rad/m
    """
    with blas_threads(0):
        sides = _Sides(run)
        loads = np.array([sides.load(j, motion) for j, motion in enumerate(motions)])
    return about(loads.reshape(-1, 3), run.setup.rotation_center)


def sharper(body):
    """The same `bem.contour.ContourBody` with one function more in each family of the gap"""
    if "sharper" not in body.kept:
        accuracy = body.accuracy._replace(terms=body.accuracy.terms + 1)
        body.kept["sharper"] = replace(body, accuracy=accuracy, kept={})
    return body.kept["sharper"]


class DepthSums(NamedTuple):
    """Over the depth of a side, for amplitudes g (a,) of the wave and of the table's nodes and rows: φ = Σ g φ_g(z).

    slopes, values : (a, a) of ∫ φ_s² dz and ∫ φ_z² dz; top, keel : (a,) φ at z = 0 and −d
    one, z : (a,) ∫ φ dz and ∫ z φ dz
    """

    slopes: np.ndarray
    values: np.ndarray
    top: np.ndarray
    keel: np.ndarray
    one: np.ndarray
    z: np.ndarray


def depth_sums(freq):
    """`DepthSums` of a solved `ContourFrequency`"""
    body, gap = freq.body, freq.body.profiles.gap
    modes = gap.outer_modes(freq.omega, MODES * len(freq.modes.wavenumbers), freq.gravity)
    z, w = _depths(gap.draft, 1 / modes.wavenumbers[-1], 1 / modes.k)
    (value, slope), (ends, _) = _on_side(modes, gap, z), _on_side(modes, gap, np.array([0.0, -gap.draft]))
    spread, rows = _spread(body, freq.degree, modes), np.column_stack([modes.wave_rows[-2:], modes.rows[-2:]])
    count, weights = len(modes.wavenumbers), extrapolation(CUTOFFS, POWERS)
    cuts = np.ones((len(CUTOFFS), count + 1))
    cuts[:, 1:] = smooth_cutoff(np.arange(1, count + 1) / (CUTOFFS[:, None] * count))
    forms = (_squares(part[None] * cuts[:, None] @ spread, weights, w) for part in (value, slope))
    return DepthSums(*forms, *((weights @ cuts * np.vstack([ends, rows])) @ spread))


def extrapolation(cutoffs, powers):
    """Weights of sums cut off at `cutoffs` times N that leave none of the errors N^(−power)"""
    conditions = np.vstack([np.ones(len(cutoffs)), cutoffs[None] ** -powers[:, None]])
    return np.linalg.solve(conditions, np.eye(len(cutoffs))[0])


def _squares(values, shares, weights):
    """(a, a) ∫ of products of values (cuts, q, a), the cuts with their shares"""
    return sum(share * v.T @ (weights[:, None] * v) for share, v in zip(shares, values, strict=True))


def _depths(draft, keel, surface):
    """Points −draft < z < 0 and their weights, m; panels double away from `keel` and `surface`, the lengths there"""
    ends = [_halved(draft / 2, length) for length in (keel, surface)]
    edges = np.concatenate([ends[0] - draft, -ends[1][-2::-1]])
    t, w = gauss_rule(10)
    length = np.diff(edges)[:, None]
    return (edges[:-1, None] + length * t).ravel(), (length * w).ravel()


def _halved(longest, shortest):
    """0, then longest / 2ⁿ … longest / 2, longest"""
    count = max(0, int(np.ceil(np.log2(longest / shortest))))
    return np.append(0.0, longest / 2.0 ** np.arange(count, -1, -1))


def _on_side(modes, gap, z):
    """Z and Z′ at z (q,), two (q, n + 1), the wave first"""
    k, h = modes.k, gap.depth
    turn = np.multiply.outer(z + h, modes.wavenumbers)
    value = np.column_stack([depth_factor(z, k, h), np.cos(turn)])
    return value, np.column_stack([depth_factor_slope(z, k, h), -modes.wavenumbers * np.sin(turn)])


def _spread(body, degree, modes):
    """(n + 1, a) from amplitudes of the wave and of every node of the table and row to fₙ"""
    table = body.nodes(degree).weights(modes.wavenumbers) / (modes.norms * modes.wavenumbers)[:, None]
    rows = body.profiles.combinations @ modes.rows
    out = np.zeros((len(table) + 1, 1 + table.shape[1] * len(rows)))
    out[0, 0] = 1
    out[1:, 1:] = (table[:, :, None] * rows.T[:, None]).reshape(len(table), -1)
    return out


class _Sides:
    """The flow of one frequency at the nodes of the contour and their images."""

    def __init__(self, run):
        setup = run.setup
        body = sharper(run.prepared.solver)
        freq = ContourFrequency(body, run.omega, run.headings, (), range(6), setup.density, setup.gravity)
        freq.result()
        self.freq = freq
        self.sums = depth_sums(freq)
        self.values = plan_values(freq.body, freq.degree, freq.k, freq.contour)

    def load(self, heading, motion):
        """(3,) mean surge, sway and yaw per amplitude squared, motion (6,) about the origin"""
        c = self.freq.contour
        flows = {cls: self.flow(cls, heading, motion) for cls in CLASSES}
        total = np.zeros(3)
        for x, y in CLASSES:  # the images are named like the classes
            signs = {cls: (cls[0] if x < 0 else 1) * (cls[1] if y < 0 else 1) for cls in CLASSES}
            g, slope = (sum(signs[cls] * flows[cls][i] for cls in CLASSES) for i in range(2))
            px, py, nx, ny, turn = x * c.x, y * c.y, x * c.nx, y * c.ny, x * y
            along = (-turn * ny, turn * nx)  # the slopes of an image run clockwise
            q = c.weights * self.density(g, slope, _displacements(motion, px, py, (nx, ny), along))
            total += q @ nx, q @ ny, q @ (px * ny - py * nx)
        return total

    def flow(self, cls, heading, motion):
        """Amplitudes of `DepthSums` at the nodes and their slopes, two (a, m)"""
        freq, (maps, slope) = self.freq, self.values[cls]
        dofs, wave, motions, flow = freq.flows[cls]
        speed = -1j * freq.omega * motion[dofs]
        gap = flow.velocity[..., : len(dofs)] @ speed + flow.velocity[..., len(dofs) + heading]
        side = sum((v * m.side for v, m in zip(speed, motions, strict=True)), np.zeros((2, gap.shape[1])))
        velocity = np.vstack([gap, side])
        far = wave.potential @ (freq.wave_rows @ velocity) / freq.modes.wave_norm
        near = np.einsum("cmn,rn->crm", maps, velocity).reshape(-1, len(far))
        g = np.vstack([far + freq.amplitude * wave.wall[:, heading], near])
        return g, g @ slope.T

    def density(self, g, slope, displacement):
        """(m,) N/m per amplitude squared along the normal, mean over a period and integrated over the draft"""
        freq, sums = self.freq, self.sums
        rho, gravity, omega = freq.density, freq.gravity, freq.omega
        normal, along, up = displacement
        square = _form(sums.slopes, slope) + _form(sums.values, g)
        carried = along[0].conj() * (sums.one @ slope) + along[1].conj() * (sums.z @ slope)
        carried += up.conj() * (sums.top @ g - sums.keel @ g)
        elevation = 1j * omega / gravity * (sums.top @ g) - up
        # ∂φ/∂n = −iω X·n stands in ½|∇φ|² and, twice and negative, in X·∇φ_t
        moved = 0.25 * rho * omega**2 * _square(*normal, freq.body.draft)
        waterline = 0.25 * rho * gravity * np.abs(elevation) ** 2
        return 0.25 * rho * square + 0.5 * rho * (-1j * omega * carried).real - moved - waterline


def _square(a, b, draft):
    """∫ |a + bz|² dz over the draft"""
    return np.abs(a) ** 2 * draft - (a.conj() * b).real * draft**2 + np.abs(b) ** 2 * draft**3 / 3


def _form(matrix, g):
    return np.einsum("am,am->m", g.conj(), matrix @ g).real


def _displacements(motion, x, y, normal, along):
    """Displacement a + bz of points (x, y, z) along the normal and the contour, two (a, b), and upwards"""
    a = motion[0] - motion[5] * y, motion[1] + motion[5] * x
    b = motion[4], -motion[3]
    lines = ((a[0] * d[0] + a[1] * d[1], b[0] * d[0] + b[1] * d[1]) for d in (normal, along))
    return *lines, motion[2] + motion[3] * y - motion[4] * x
