"""The panel method on a rotated and shifted mesh without mirror planes, compared with the same mesh with two mirror
planes.

With R the rotation by α about the vertical, a body moved to p has, about p,

    A' = R A Rᵀ,    X'(β + α) = exp(ik p·(cos(β+α), sin(β+α))) R X(β)

which results obey within the accuracy of the Green function's tables, whatever the discretisation error.  With mirror
planes a panel is integrated more finely near its image. The difference is within the discretisation error.
"""

import math

import numpy as np

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

from .laws import allowed
from .scenes import GRAVITY
from .solved import QUANTITIES, scaled

COUNTS = (2, 9), (2, 5), (2, 5)  # panels along half the length, half the beam and the draft
LONGEST_ASPECT = 200.0
TABLES = 1e-5  # relative error of the wave part
MOST_PANELS = 220  # largest number of panels of the whole hull


def rotated(scene, seed):
    """Largest difference over the allowed one; NaN where panels of these counts would be longer than the wave"""
    rng = np.random.default_rng([seed, scene.number, 1])
    counts = np.array([rng.integers(*limits) for limits in COUNTS])
    angle, place = rng.uniform(-math.pi, math.pi), rng.uniform(-1, 1, 2) * scene.reach
    mesh = _mesh(scene, counts)
    if not _usable(scene, mesh):
        return math.nan
    hull, headings = (mesh, lid(mesh)), np.radians(scene.headings)
    rough = _mesh(scene, np.maximum(counts // 2, (1, 1, 2)))
    quarter = _solved(scene, hull, headings, coarse=(rough, lid(rough)))
    whole = _solved(scene, [part.whole() for part in hull], headings)
    moved = [part.rotated(angle).moved(*place) for part in hull]
    other = _solved(scene, moved, headings + angle, rotation_center=(*place, 0.0))
    invariant = difference(whole, other, angle, scene.k * place, headings + angle) / TABLES
    mirrored = difference(quarter, whole, 0.0, (0.0, 0.0), headings)
    return max(invariant, mirrored / allowed(quarter.estimate))


def difference(one, other, angle, phase, towards):
    """Largest difference of Z and X, relative to their size, between a body and the same body moved

    one, other : `Solved`; phase : k times the place; towards : (m,) rad, headings of the second
    """
    R = np.kron(np.eye(2), _rotation(angle))
    shift = np.exp(-1j * (phase[0] * np.cos(towards) + phase[1] * np.sin(towards)))
    pair = one.relative(R.T @ other.Z @ R - one.Z, shift[:, None] * other.X @ R - one.X)
    return float(max(np.abs(part).max() for part in pair))


def _solved(scene, hull, headings, **more):
    prepared = prepare(PanelProblem(*hull, depth=scene.depth, gravity=GRAVITY, **more))
    result = solve_frequency(prepared, scene.omega, headings, {*QUANTITIES, "diffraction_force"})
    return scaled("panel", hull[0].total, prepared, scene.omega, result)


def _rotation(angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _mesh(scene, counts):
    return (box if scene.shape == "box" else buoy)(*scene.sizes.values(), scene.draft, counts=counts.tolist())


def _usable(scene, mesh):
    """Whether no panel is longer than the wave or too slender, and there are few of them"""
    aspect = float((mesh.sizes**2 / mesh.areas).max())
    resolved = mesh.sizes.max() <= 2 * math.pi / scene.k
    return resolved and aspect <= LONGEST_ASPECT and mesh.total <= MOST_PANELS
