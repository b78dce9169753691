"""Forces of a passing ship by panels: both hulls under a rigid lid, in water of any depth, with or without a wall.

With the surface as a lid the energy of the water is ½ Σ aᵢⱼ q̇ᵢ q̇ⱼ, where a is the added mass of both hulls at zero
frequency and at their present positions. Lagrange's equations (Lamb, art. 137) give the force on the moored hull,
which is at rest:

    Fⱼ = −d/dt (a_js U) + ½ U² ∂a_ss/∂qⱼ,     s the surge of the passing ship, d/dt = U d/dξ

The first part is the force of the unsteady pressure, the second part that of the squared velocities. The second part
is smaller by an order of the ship's slenderness. It is computed only for surge, sway and yaw, and at fewer places.
"""

from collections.abc import Callable, Iterable

import numpy as np
from scipy.interpolate import make_interp_spline

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import Body
from hakobune.meshing.mirror import folded
from hakobune.meshing.panels import assembled, with_symmetry

from .passage import Passage

EACH = 2  # the squares are computed at one in this number of places
STEP, TURN = 0.01, 1e-3  # displacement for finite differences, over the distance, and rotation, rad
DEGREE = 5  # degree of the splines over ξ
FINE = 5  # places between two that are solved
PASSING_SURGE = 6


def added_mass(hulls, place, heading, depth, wall=None, density=1025.0):
    """Added mass of both hulls at zero frequency, kg, kg m, kg m², about the middle of each hull; shape (12, 12).

    hulls : PanelMesh of the moored ship and of the passing ship, each with its middle at the origin
    place : (2,) m of the passing ship
    heading : rad, rotation of the moored ship; depth : m; wall : y, m, of a wall along x
    """
    placed = hulls[0].rotated(heading), hulls[1].moved(dx=float(place[0]), dy=float(place[1]))
    mesh = assembled([with_symmetry(folded(hull), "") for hull in placed])
    points = (0.0, 0.0, 0.0), (float(place[0]), float(place[1]), 0.0)
    bodies = tuple(Body(str(k), point, 0.0, False, point[:2]) for k, point in enumerate(points))
    problem = PanelProblem(mesh=mesh, bodies=bodies, depth=depth, nodes_per_panel=1, wall=wall, density=density)
    return problem.prepared().added_mass_limit("zero")


def double_body(hulls, track, stagger, depth, *, wall=None, density=1025.0, each: Callable[..., Iterable] = map):
    """`Passage` by panels.

    hulls : as in `added_mass`, with both sides; track : Track; stagger : solved places, (n,) m, n ≥ 7, with splines
        between
    each : function like `map` over the independent places, for a display of progress
    raises : ValueError for too few places; FloatingPointError
    """
    stagger = np.asarray(stagger, float)
    if len(stagger) < DEGREE + 2:
        raise ValueError(f"the track has {len(stagger)} places; allowed: at least {DEGREE + 2}")
    places, step = [], STEP * abs(track.distance)
    few = np.union1d(stagger[::EACH], stagger[-1:])
    places += [(x, track.distance, 0.0) for x in stagger]
    for x in few:
        for side in (1.0, -1.0):
            places += [(x, track.distance + side * step, 0.0), (x, track.distance, side * TURN)]

    def at(one):
        x, y, turn = one
        return added_mass(hulls, (x, y), turn, depth, wall, density)[:, PASSING_SURGE]

    found = np.array(list(each(at, places)))
    course, beside = found[: len(stagger)], found[len(stagger) :, PASSING_SURGE].reshape(len(few), 2, 2)
    fine = np.linspace(stagger[0], stagger[-1], FINE * (len(stagger) - 1) + 1)
    energy = -(track.through_water**2) * make_interp_spline(stagger, course, DEGREE).derivative()(fine)
    across = (beside[:, 0] - beside[:, 1]) / (2 * np.array([step, TURN]))
    steady = np.zeros((len(fine), 6))
    steady[:, 0] = 0.5 * energy[:, PASSING_SURGE]
    squares = make_interp_spline(few, across, min(DEGREE, len(few) - 1))(fine)
    steady[:, [1, 5]] = 0.5 * track.through_water**2 * squares * (-1, 1)
    return Passage(track, fine, energy[:, :6], steady)


def largest_section(hull):
    """Largest cross-section, normal to x, of a hull with both sides, m²"""
    along = hull.normals[:, 0] * hull.areas
    return float(along[along > 0].sum())
