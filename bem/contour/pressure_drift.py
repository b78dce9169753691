"""Mean drift by the pressure on the sides of a box or vertical cylinder, from the flow of the contour method.

The formula is that of `bem.methods.near_field`. The bottom contributes no surge, sway or yaw. On a side ∂φ/∂n is the
normal velocity of the motions, so that for φ = Σ fₙ(s) Zₙ(z) the remaining terms are

    ∫ |∇φ|² dz = ∫ |Σ f'ₙ Zₙ|² + |Σ fₙ Z'ₙ|² + |∂φ/∂n|² dz,    ∫ X·∇φ dz,    ζ,        −d < z < 0

which `side_flow` integrates in advance for the nodes of a table in κ, so that each wave and motion costs little.

The drift from pressure checks the drift from the far field. An evanescent mode exerts opposite forces on the side and
in the gap; these forces cancel, and the far field contains no evanescent mode, if the potentials on both sides of the
gap are equal. The error of the drift from pressure is of first order in the difference of these potentials, whereas
the errors of forces and far field are of second order. The flow is therefore solved again with a finer body.
In resonant roll the drift is the small difference of pressures tens of times as large.

For a box in 20 and 100 m of water and a tolerance of 1e-3, drift from near and far field differs by 5e-5 of the
largest force on the fixed body; without the finer body the difference is 5e-4 to 8e-4. In 2000 m of water the
difference is 4e-4 with the finer body and 3e-2 without it.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..drift import about
from ..kernels.threads import blas_threads
from .accuracy import DIGIT, KAPPA, accuracy, height
from .one_frequency import ContourFrequency
from .plan.maps import CLASSES
from .plan.potentials import plan_values
from .side_flow import depth_sums

POLYNOMIALS = 4  # more on the sides of a box than forces need: with none near and far field differ four times as much
PRESSURES = 2e-5  # best relative error of pressures: `side_flow.CUT`; larger in proportion to `height` above 1
DISTINCT = 1e-9  # `accuracy.CLEAR` of pressures


def pressure_drift(run, motions):
    """Mean surge, sway and yaw of the pressure on the sides, about the rotation centre; shape (m, 3); N/m², N m/m².

    run : `bem.methods.shape_run.ShapeRun` of the contour method; motions : motions about the origin, m/m and rad/m,
        (m, 6)
    """
    with blas_threads(0):
        sides = _sides(run)
        loads = np.array([sides.load(j, motion) for j, motion in enumerate(motions)])
    return about(loads.reshape(-1, 3), run.problem.rotation_center)


def pressure_error(run):
    """Relative error of the pressures of a `bem.methods.shape_run.ShapeRun`, at least `PRESSURES`"""
    body = run.prepared.solver
    return max(run.estimated_error(), PRESSURES * height(body.depth - body.draft, body.plan.scale))


def refined(body):
    """The `bem.contour.body.ContourBody` with the accuracy that pressures need

    The finer body has gap functions for twice the digits, modes for two more digits, profiles of smaller eigenvalues,
    more polynomials on the sides, panels of one more digit, and a table in κ of three more digits.
    """
    if "sharper" not in body.cache:
        ours, gap, scale = body.accuracy, body.depth - body.draft, body.plan.scale
        twice, further = (accuracy(digits, body.draft, gap, scale) for digits in (2 * ours.digits, ours.digits + 2))
        finer = ours._replace(
            terms=max(ours.terms + 1, twice.terms),
            modes=further.modes,
            smallest=min(ours.smallest, DISTINCT / height(gap, scale)),
            kappa=ours.kappa + 3 * DIGIT / KAPPA,
            plan=ours.plan + DIGIT,
            extra=ours.extra + POLYNOMIALS,
        )
        body.cache["sharper"] = replace(body, plan=body.plan.to(finer), accuracy=finer, cache={})
    return body.cache["sharper"]


@lru_cache(maxsize=1)
def _sides(run):
    """One flow serves the fixed and the floating body"""
    return _Sides(run)


class _Sides:
    """The flow of one frequency at the nodes of the contour and their images."""

    def __init__(self, run):
        problem = run.problem
        body = refined(run.prepared.solver)
        freq = ContourFrequency(body, run.omega, run.headings, (), range(6), problem.density, problem.gravity)
        freq.result()
        self.freq = freq
        self.sums = depth_sums(freq)
        self.values = plan_values(freq)

    def load(self, heading, motion):
        """Mean surge, sway and yaw per amplitude squared, motion (6,) about the origin; shape (3,)"""
        c = self.freq.contour
        flows = {cls: self.flow(cls, heading, motion) for cls in CLASSES}
        total = np.zeros(3)
        for x, y in CLASSES:  # the images are named like the classes
            signs = {cls: (cls[0] if x < 0 else 1) * (cls[1] if y < 0 else 1) for cls in CLASSES}
            g, slope = (sum(signs[cls] * flows[cls][i] for cls in CLASSES) for i in range(2))
            px, py, nx, ny, turn = x * c.x, y * c.y, x * c.nx, y * c.ny, x * y
            along = (-turn * ny, turn * nx)  # the slopes of an image run clockwise
            moved = _displacements(motion, px, py, (nx, ny), along)
            edge = -1j * self.freq.omega * np.array([moved[2], moved[0][1] + 0 * moved[2]])
            # the slopes of w and b along the contour are neglected: φ_s is regular at the keel
            g, slope = np.vstack([g, edge]), np.vstack([slope, 0 * edge])
            q = c.weights * self.density(g, slope, moved)
            total += q @ nx, q @ ny, q @ (px * ny - py * nx)
        return total

    def flow(self, cls, heading, motion):
        """Amplitudes of `DepthSums`, except the two of the edge, at the nodes, and their slopes: two (a − 2, m)"""
        freq, (maps, slope) = self.freq, self.values[cls]
        dofs, wave, sides, flow = freq.flows[cls]
        speed = -1j * freq.omega * motion[dofs]
        gap = flow.velocity[..., : len(dofs)] @ speed + flow.velocity[..., len(dofs) + heading]
        velocity = np.vstack([gap, np.tensordot(speed, sides, 1)])
        far = wave.potential @ (freq.wave_rows @ velocity) / freq.modes.wave_norm
        near = np.einsum("cmn,rn->crm", maps, velocity).reshape(-1, len(far))
        g = np.vstack([far + freq.amplitude * wave.wall[:, heading], near])
        return g, g @ slope.T

    def density(self, g, slope, displacement):
        """Mean load per amplitude squared along the normal, averaged over a period and integrated over the draft, N/m;
        shape (m,)"""
        freq, sums = self.freq, self.sums
        rho, gravity, omega = freq.density, freq.gravity, freq.omega
        normal, along, up = displacement
        square = _form(sums.slopes, slope) + _form(sums.values, g)
        carried = along[0].conj() * (sums.one @ slope) + along[1].conj() * (sums.z @ slope)
        carried += up.conj() * (sums.top @ g - sums.keel @ g)
        elevation = 1j * omega / gravity * (sums.top @ g) - up
        # ∂φ/∂n = −iω X·n is in ½|∇φ|² and, twice and negative, in X·∇φ_t
        moved = 0.25 * rho * omega**2 * _square(*normal, freq.body.draft)
        waterline = 0.25 * rho * gravity * np.abs(elevation) ** 2
        return 0.25 * rho * square + 0.5 * rho * (-1j * omega * carried).real - moved - waterline


def _square(a, b, draft):
    """∫ |a + bz|² dz over the draft"""
    return np.abs(a) ** 2 * draft - (a.conj() * b).real * draft**2 + np.abs(b) ** 2 * draft**3 / 3


def _form(matrix, g):
    """Quadratic form gᴴ M g of a real symmetric M (a, a) and g (a, m); shape (m,)"""
    parts = np.concatenate([g.real, g.imag], axis=1)
    return np.einsum("am,am->m", parts, matrix @ parts).reshape(2, -1).sum(axis=0)


def _displacements(motion, x, y, normal, along):
    """Displacement a + bz of points (x, y, z) along the normal and the contour, two (a, b), and upwards"""
    a = motion[0] - motion[5] * y, motion[1] + motion[5] * x
    b = motion[4], -motion[3]
    lines = ((a[0] * d[0] + a[1] * d[1], b[0] * d[0] + b[1] * d[1]) for d in (normal, along))
    return *lines, motion[2] + motion[3] * y - motion[4] * x
