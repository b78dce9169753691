"""A flat strip that bends across its length in beam waves, such as a mat or a flexible breakwater, in two dimensions.

    {−ω²[M + A] − iωB + [C + K]} ξ = F

with ξ the heave, the roll and the free-free shapes of `bem.flexible.beams` along y, per metre of length. K is the
bending stiffness of the shapes, and C the stiffness of `bem.flexible.coupling`.
"""

from typing import NamedTuple

import numpy as np

from ..flexible.beams import Beam, second
from ..flexible.coupling import gradients, of_water
from ..waves import wavenumber
from .any_section import PER_RADIAN, AnyFlow, shape
from .outline import rectangle

TOLERANCE = 1e-4
THIN = 1e-5  # draft over width in place of a draft of 0: amplitudes differ by 2e-4
FEWEST, PER_WAVE = 8, 4  # number of shapes, and of additional shapes for each wave along the strip


class BendingStrip(NamedTuple):
    """Results of one frequency in a wave of 1 m towards +y.

    y : places across the strip, m, (n,); deflection : upward deflection, complex, m, (n,)
    moment, shear : EI w″ and EI w‴ per metre of length, complex, N m and N, (n,)
    reflection, transmission : complex, both referred to y = 0
    """

    y: np.ndarray
    deflection: np.ndarray
    moment: np.ndarray
    shear: np.ndarray
    reflection: complex
    transmission: complex


def bending_strip(
    width, rigidity, mass, depth, omega, *, shapes=None, draft=0.0, count=101, density=1025.0, gravity=9.80665,
    tolerance=TOLERANCE,
):  # fmt: skip
    """`BendingStrip` of a flat strip.

    width : m; rigidity : D, N m; mass : kg/m²; depth : m; omega : rad/s; count : number of places along y
    shapes : number of bending shapes; if None, as many as the waves need. With eight shapes and three waves along the
        strip the error is 1 %
    draft : m; 0 as in theories of thin plates; if None, the draft by the weight. A draft of 8 mm on a width of 10 m
        reduces the deflection of the edges by 1.5 %
    raises : ValueError for the reasons of `any_section`
    """
    if shapes is None:
        shapes = FEWEST + int(np.ceil(PER_WAVE * float(wavenumber(omega, depth, gravity)) * width / (2 * np.pi)))
    draft = mass / density if draft is None else max(draft, THIN * width)
    wetted = rectangle(width, 2 * draft).wetted(draft)
    longest = PER_RADIAN / float(wavenumber(omega, depth, gravity))
    made = shape(wetted.edges, depth, float(2.0 ** np.floor(np.log2(longest))), tolerance)
    beams = [Beam("vertical bending", n, -width / 2, width / 2, 0.0, rigidity, mass) for n in range(1, shapes + 1)]
    motions = [_heave, _roll, *(one.displacement for one in beams)]
    p, n = made.points[made.body], made.normals[made.body]
    points, normals = (np.stack([v.real, np.zeros(len(v)), v.imag], axis=1) for v in (p, n))
    u = np.array([motion(points) for motion in motions])
    slopes = np.array([gradients(motion, points, width) for motion in motions])
    flow = AnyFlow(made, omega, gravity, velocities=np.einsum("iqa,qa->qi", u, normals))
    areas = made.weights[made.body, None] * normals
    pairs = second(beams, points) if beams else None
    stiffness = of_water(u, slopes, p.imag, areas, density, gravity, 2, pairs)
    stiffness += np.diag([0.0, 0.0, *(one.stiffness for one in beams)])
    inertia = np.diag([mass * width, mass * width**3 / 12, *(one.mass for one in beams)])
    water = -density * flow.forces(flow.potentials[:, :-2])
    force = -1j * density * omega * (flow.forces(flow.potentials[:, -2]) + flow.incident_forces)
    xi = np.linalg.solve(-(omega**2) * (inertia + water) + stiffness, force)
    y = np.linspace(-width / 2, width / 2, count)
    along = np.stack([np.ones(count), y, *(one.along(y) for one in beams)])
    loads = np.array([one.loads(y) for one in beams]).reshape(shapes, 2, count)
    R, T = flow.scattered(+1)
    back, on = -1j * omega * (flow.waves[:, :-2] @ xi) / (-1j * gravity / omega)
    return BendingStrip(y, xi @ along, *np.tensordot(xi[2:], loads, 1), complex(R + back), complex(T + on))


def _heave(points):
    return np.broadcast_to([0.0, 0.0, 1.0], points.shape)


def _roll(points):
    return np.stack([-points[:, 2], np.zeros(len(points)), points[:, 0]], axis=1)
