"""Far-field amplitude of the waves radiated and diffracted by a body, after Kochin.

    η ~ H(θ) √(2/(πkR)) exp(i(kR − π/4))    for R → ∞ in direction θ,
    H(θ) = −(k²/4nω) ∬ (φ ∂ψ/∂n − ψ ∂φ/∂n) dS,    ψ = Z(z) exp(−ik(x cosθ + y sinθ))

with n = C_g/C and Z(z) = cosh k(z+h)/cosh kh.  In diffraction H is per unit wave amplitude, in radiation per unit
amplitude of the motion, m or rad.  The function of the SR179 report (1982), eq. 2.1.5.15, is −2g/ω times this one, per
unit velocity. That equation uses source strengths where a direct solution uses φ and ∂φ/∂n.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .kernels.jit import kernel
from .kernels.threads import parallel_rows

BLOCK = 32  # directions at a time: four complex numbers each for every point


class Folded(NamedTuple):
    """Directions of one part of the circle; mirror images give the values at all other directions.

    angles : directions of the part, rad, (u,); images : signs of x and y of each mirror image, ±1, (i, 2)
    place, image : indices in `angles` and `images` for each direction, (t,)
    """

    angles: np.ndarray
    place: np.ndarray
    image: np.ndarray
    images: np.ndarray

    def unfolded(self, value, slope, signs):
        """H and H′ (…, t) of a symmetry class at all angles, from values (…, u) at `angles`

        signs : sign of the class in each image, ±1, (i,)

        An image has the sign of its class. Its derivative also has the sign of the change of angle.
        """
        turned = signs * self.images.prod(axis=1)
        return value[..., self.place] * signs[self.image], slope[..., self.place] * turned[self.image]


def folded(theta, images):
    """`Folded` of directions theta (t,) rad for the mirror images (i, 2) of a body; for four images `angles` is a
    quarter of the circle

    The result is kept, since every symmetry class at every frequency needs it.
    """
    return _folded(tuple(np.asarray(theta, float).tolist()), tuple(map(tuple, np.asarray(images).tolist())))


@lru_cache(maxsize=16)
def _folded(theta, images):
    theta, images = np.array(theta), np.array(images)
    x, y = images[:, :1] * np.cos(theta), images[:, 1:] * np.sin(theta)
    image = np.argmax((x > -1e-9) + 1 * (y > -1e-9), axis=0)
    chosen = image, np.arange(len(theta))
    angle = np.arctan2(y[chosen], x[chosen])
    _, first, place = np.unique(np.round(angle, 12), return_index=True, return_inverse=True)
    return Folded(angle[first], place, image, images)


def far_field_integrals(theta, k, points, weights, normals, Z, images, signs, phi, velocity):
    """∬ (φ ∂ψ/∂n − ψ ∂φ/∂n) dS and its θ-derivative for potentials of one symmetry class, over the whole hull.

    theta : angles, rad, (t,); k : wavenumber, rad/m
    points, weights, normals : m, (q, 3), m², (q,), and (q, 3), of one of the symmetric parts of the hull
    Z : Z(z) and Z'(z), 1/m, (q, 2); images : signs of x and y, ±1, (i, 2); signs : sign of the potential in each image,
        ±1, (i,)
    phi, velocity : potential and normal velocity, m²/s and m/s, or these per unit of an amplitude, complex, (r, q)
    returns : two (r, t) complex arrays, m³/s and m³/s per rad
    """
    directions = folded(theta, images)
    theta = directions.angles
    value, slope = np.zeros((2, len(phi), len(theta)), complex)
    arguments = k, points, weights, normals, Z, images, signs.astype(float)
    flow = np.ascontiguousarray(velocity * Z[:, 0])

    def work(low, high):
        for start in range(low, high, BLOCK):
            block = slice(start, min(start + BLOCK, high))
            even, flux, deven, dflux = _waves(theta[block], *arguments)
            value[:, block] = (flux @ phi.T - even @ flow.T).T
            slope[:, block] = (dflux @ phi.T - deven @ flow.T).T

    parallel_rows(work, len(theta), len(theta) * len(points) * len(images))
    return directions.unfolded(value, slope, signs)


@kernel()
def _waves(theta, k, points, weights, normals, Z, images, signs):
    """Sums over the images of ψ/Z(z) and ∂ψ/∂n, times areas, and of their θ-derivatives, (4, t, q)"""
    out = np.zeros((4, len(theta), len(points)), np.complex128)
    for a in range(len(theta)):
        c, s = math.cos(theta[a]), math.sin(theta[a])
        for q in range(len(points)):
            along_x, along_y = k * points[q, 0] * c, k * points[q, 1] * s
            cos_x, sin_x = math.cos(along_x), math.sin(along_x)
            cos_y, sin_y = math.cos(along_y), math.sin(along_y)
            for m in range(len(images)):
                sx, sy = images[m, 0], images[m, 1]
                x, y = sx * points[q, 0], sy * points[q, 1]
                nx, ny = sx * normals[q, 0], sy * normals[q, 1]
                area, turn = signs[m] * weights[q], k * (y * c - x * s)
                wave = area * complex(
                    cos_x * cos_y - sx * sy * sin_x * sin_y, -(sx * sin_x * cos_y + sy * cos_x * sin_y)
                )
                dwave = complex(turn * wave.imag, -turn * wave.real)
                along, across = -k * (nx * c + ny * s) * Z[q, 0], -k * (ny * c - nx * s) * Z[q, 0]
                normal = complex(normals[q, 2] * Z[q, 1], along)
                out[0, a, q] += wave
                out[1, a, q] += wave * normal
                out[2, a, q] += dwave
                out[3, a, q] += dwave * normal + complex(-across * wave.imag, across * wave.real)
    return out


def angles(k, radius):
    """θ (t,) equally spaced so that H of a body within `radius` m of the origin is resolved at wavenumber k.

    H is band-limited: its harmonics beyond k·radius fall faster than any power.
    """
    harmonics = int(np.ceil(k * radius + 6 * (k * radius) ** (1 / 3) + 8))
    count = 4 * int(np.ceil((2 * harmonics + 2) / 4))
    return np.arange(count) * (2 * np.pi / count)
