"""Single and double layers on the contour of a rectangle, one matrix for each symmetry class.

    S = ∫ G ψ ds,   D = ∫ ∂G/∂n ψ ds,    n out of the body, ψ interpolated between the nodes of the panels

with G = −ln R / 2π (Laplace), K₀(κR) / 2π (∇²φ = κ²φ) or (i/4) H₀(kR) (waves, exp(−iωt)).  The potential on the
contour is φ/2 = Dφ − S ∂φ/∂n outside and φ/2 = S ∂φ/∂n − Dφ inside.

The geometry is computed once; each wavenumber then requires only Bessel functions and one weighted sum.
"""

from typing import NamedTuple

import numpy as np

from ...kernels.jit import kernel
from .bessel import decaying_pair, radiating_pair
from .maps import CLASSES
from .panels import IMAGES, Points, interpolation, is_far, near_points


def laplace(R):
    """G and R ∂G/∂R"""
    return -np.log(R) / (2 * np.pi), np.full_like(R, -1 / (2 * np.pi))


def decaying(kappa):
    """Function of R that returns G and R ∂G/∂R of the modified Helmholtz equation"""

    def kernels(R):
        single, radial = decaying_pair(kappa * R)
        return single / (2 * np.pi), radial / (-2 * np.pi)

    return kernels


def radiating(k):
    """Function of R that returns G and R ∂G/∂R of outgoing waves"""

    def kernels(R):
        single, radial = radiating_pair(k * R)
        return 0.25j * single, -0.25j * radial

    return kernels


class Layers(NamedTuple):
    """Targets (i,) against the nodes (m,) of a contour and their images.

    distance, along : values of the far pairs as in `Points`, without weights, (f,); pair : flat index (i, image, m),
        (f,)
    near : `Points`; shapes : interpolation at the near points, (q, g)
    """

    targets: int
    weights: np.ndarray
    distance: np.ndarray
    along: np.ndarray
    pair: np.ndarray
    near: Points
    shapes: np.ndarray

    def matrices(self, kernels, classes):
        """S and D of every class, two arrays (classes, i, m)"""
        signs = np.array([[c[0] if ix < 0 else 1] for c in classes for ix, _ in CLASSES], float)
        signs = signs.reshape(len(classes), -1) * [[c[1] if iy < 0 else 1 for _, iy in CLASSES] for c in classes]
        return _matrices(self, kernels, signs)


def layers(panels, x, y, own, count, smallest):
    """`Layers` of targets (x, y); the other arguments as in `near_points`"""
    c = panels.contour
    far = is_far(panels, x, y)
    size = np.count_nonzero(far) * len(panels.t)
    distance, along, pair = np.empty(size), np.empty(size), np.empty(size, np.int64)
    _far_pairs(x, y, np.stack(c[:4]), IMAGES, far, len(panels.t), distance, along, pair)
    near = near_points(panels, x, y, own, far, count, smallest)
    return Layers(len(x), c.weights, distance, along, pair, near, interpolation(panels.t, near.t))


def _matrices(layers, kernels, signs):
    near, m = layers.near, len(layers.weights)
    single, radial = kernels(layers.distance)
    out = np.zeros((2, len(signs), layers.targets, m), single.dtype)
    _add_far(out, layers.pair, single, radial * layers.along, layers.weights, signs)
    single, radial = kernels(near.distance)
    _add_near(
        out, near.target, near.panel, near.image, layers.shapes, single * near.weights,
        radial * near.along * near.weights, signs,
    )  # fmt: skip
    return out


@kernel()
def _far_pairs(x, y, contour, images, far, per_panel, distance, along, pair):
    """Fill `Layers.distance`, `along` and `pair`; contour : (4, m) x, y and normal of the nodes"""
    m, n = contour.shape[1], 0
    for i in range(len(x)):
        for g in range(len(images)):
            a, b = images[g, 0], images[g, 1]
            for p in range(far.shape[2]):
                if not far[i, g, p]:
                    continue
                for q in range(p * per_panel, (p + 1) * per_panel):
                    dx, dy = a * contour[0, q] - x[i], b * contour[1, q] - y[i]
                    square = dx * dx + dy * dy
                    distance[n] = np.sqrt(square)
                    along[n] = (dx * a * contour[2, q] + dy * b * contour[3, q]) / square
                    pair[n] = (i * len(images) + g) * m + q
                    n += 1


@kernel()
def _add_far(out, pair, single, double, weights, signs):
    m = len(weights)
    for q in range(len(pair)):
        node, rest = pair[q] % m, pair[q] // m
        image, i = rest % signs.shape[1], rest // signs.shape[1]
        for c in range(len(signs)):
            share = signs[c, image] * weights[node]
            out[0, c, i, node] += share * single[q]
            out[1, c, i, node] += share * double[q]


@kernel()
def _add_near(out, target, panel, image, shapes, single, double, signs):
    g = shapes.shape[1]
    for q in range(len(target)):
        first = panel[q] * g
        for c in range(len(signs)):
            s, d = signs[c, image[q]] * single[q], signs[c, image[q]] * double[q]
            for j in range(g):
                out[0, c, target[q], first + j] += s * shapes[q, j]
                out[1, c, target[q], first + j] += d * shapes[q, j]
