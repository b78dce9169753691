"""Forces of pairs on each of two bodies: their sum is that on both hulls as one body, which is solved as one.

Two hulls that move as one rigid body, or are both held, have the same first-order flow as one body of both hulls.  So
the forces of second order on each, taken to one point, add up to those on the one: part by part, at differences and at
sums of frequencies.  The one body is solved by the code for one body, checked against exact solutions elsewhere.
"""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import Body, axes_of, reference_change
from hakobune.bem.panels.pressure_drift import of_each_body
from hakobune.bem.second_order import quadratic_forces
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.quadratic_forces import QuadraticRun
from hakobune.meshing.panels import PanelMesh, joined
from hakobune.meshing.shapes import box

DEPTH, RHO, G = 12.0, 1025.0, 9.80665
OMEGA, HEADINGS = np.array([0.7, 0.8, 0.9]), np.radians([20.0, 110.0])
CENTER = (1.0, -0.5, 0.4)  # of the body of both hulls
BODIES = (Body("left", (-9.0, 1.0, 0.3), 0.0, False, (-9.0, 0.0)),
          Body("right", (9.0, -2.0, -0.2), np.radians(30.0), False, (9.0, -3.0)))  # fmt: skip
SIZES = (10.0, 7.0), (8.0, 9.0)  # m, length and beam


def hull(body, length, beam):
    """Panels of a box at the place and heading of a body"""
    own = box(length, beam, 2.0, panels=24).whole()
    points = own.points @ body.axes.T + (*body.place, 0.0)
    return PanelMesh(points, own.corners)


@pytest.fixture(scope="module")
def meshes():
    """Both hulls as several bodies and as one"""
    parts = [hull(body, *size) for body, size in zip(BODIES, SIZES, strict=True)]
    numbered = [replace(part, body=np.full(len(part), i)) for i, part in enumerate(parts)]
    return joined(numbered), joined(parts)


# a finite rotation moves points other than its centre at second order: bodies that move as one turn about one point
AS_ONE = tuple(body._replace(rotation_center=CENTER) for body in BODIES)


def to_center(body):
    """(6, 6) that takes loads about a body's own point in its own axes to the centre of both"""
    own = axes_of((body,))
    return reference_change(CENTER) @ np.linalg.inv(own)


def stiffness_of(body, length, beam, weight):
    """(6, 6) of a box about its rotation centre, by the areas of its waterplane; weight : m⁴, of weight and buoyancy"""
    (x, y, _), area = -body.own_center, length * beam
    out = np.zeros((6, 6))
    out[2, 2:5] = area, area * y, -area * x
    out[3, 3:5] = area * (beam**2 / 12 + y * y) + weight, -area * x * y
    out[4, 4] = area * (length**2 / 12 + x * x) + weight
    return RHO * G * (np.triu(out) + np.triu(out, 1).T)


def sum_of(values, bodies=BODIES):
    """(…, 6) about the centre of both of loads (…, 12) on each"""
    return sum(values[..., 6 * i : 6 * i + 6] @ to_center(body).T for i, body in enumerate(bodies))


def water():
    return {"depth": DEPTH, "density": RHO, "gravity": G}


def one(mesh, **more):
    return PanelProblem(mesh, rotation_center=CENTER, **water(), **more)


def several(mesh, bodies=BODIES, **more):
    return PanelProblem(mesh, bodies=bodies, **water(), **more)


def solved(problem, moving, kind):
    run = QuadraticRun(problem, OMEGA, HEADINGS, 0.2 if kind is DIFFERENCE else 1.7, moving, kind=kind)
    return run, run.all()


def block(parts):
    out = np.zeros((12, 12))
    out[:6, :6], out[6:, 6:] = parts
    return out


@pytest.fixture(autouse=True)
def _pressure_alone(monkeypatch):
    """The one body without the correction by its far field, which bodies of several have not"""
    monkeypatch.setattr(quadratic_forces, "_by_far_field", lambda squares, far, flow: None)


def close(found, wanted, within=1e-9):
    assert np.nanmax(np.abs(found - wanted)) < within * np.nanmax(np.abs(wanted))
    assert np.array_equal(np.isnan(found), np.isnan(wanted))


@pytest.mark.parametrize("kind", [DIFFERENCE, SUM], ids=lambda kind: kind.name)
def test_forces_on_two_bodies_held_add_up_to_those_on_both_hulls_as_one(meshes, kind):
    _, each = solved(several(meshes[0]), False, kind)
    _, both = solved(one(meshes[1]), False, kind)
    close(sum_of(each.squares), both.squares)
    close(sum_of(each.bound_wave), both.bound_wave)
    assert each.total.shape == (*both.total.shape[:-1], 12) and not np.nanmax(np.abs(each.body))


@pytest.mark.parametrize("kind", [DIFFERENCE, SUM], ids=lambda kind: kind.name)
def test_forces_on_two_bodies_that_move_as_one_add_up_to_those_on_the_one(meshes, kind, monkeypatch):
    shares = [np.diag([1, 1, 1, 4, 9, 9]) * 1e5, np.diag([1, 1, 1, 5, 6, 8]) * 9e4]
    bring = [to_center(body).T for body in AS_ONE]  # motions of each by those of both
    water = [stiffness_of(body, *size, w) for body, size, w in zip(AS_ONE, SIZES, (-90.0, 40.0), strict=True)]
    inertia, stiffness = (
        sum(J.T @ part @ J for J, part in zip(bring, parts, strict=True)) for parts in (shares, water)
    )
    whole, both = solved(one(meshes[1], inertia_matrix=inertia, hydrostatic_stiffness=stiffness), True, kind)
    rigid = np.concatenate([whole.motions @ J.T for J in bring], axis=-1)
    given = iter(rigid)
    monkeypatch.setattr(of_each_body, "own_motions", lambda run, moving: next(given))
    problem = several(meshes[0], AS_ONE, inertia_matrix=block(shares), hydrostatic_stiffness=block(water))
    _, each = solved(problem, True, kind)
    for part in ("squares", "bound_wave", "body"):
        close(sum_of(getattr(each, part), AS_ONE), getattr(both, part), 1e-6)  # areas by quadrature beside exact ones


def test_a_fixed_body_is_pushed_as_one_that_stiff_springs_hold(meshes):
    """What the hull that moves makes pushes a fixed one too: with ψ of motions that it has not"""
    kind = DIFFERENCE
    left = AS_ONE[0]
    stiffness, inertia = stiffness_of(left, *SIZES[0], -90.0), np.diag([1, 1, 1, 4, 9, 9]) * 1e5
    fixed = (left, AS_ONE[1]._replace(fixed=True))
    tall = {name: np.concatenate([part, np.zeros((6, 6))]) for name, part in
            (("inertia_matrix", inertia), ("hydrostatic_stiffness", stiffness))}  # fmt: skip
    run, found = solved(several(meshes[0], fixed, **tall), True, kind)
    assert run.motions.shape[-1] == 12 and not np.abs(run.motions[..., 6:]).max()
    stiff = np.kron(np.diag([0.0, 1.0]), np.eye(6)) * 1e14  # springs hold it in place of the word "fixed"
    water = block([stiffness, stiffness_of(AS_ONE[1], *SIZES[1], 40.0)])
    springs = several(meshes[0], AS_ONE, inertia_matrix=block([inertia] * 2), hydrostatic_stiffness=water + stiff)
    _, held = solved(springs, True, kind)
    for part in ("squares", "bound_wave", "body"):
        close(getattr(found, part), getattr(held, part), 1e-6)
    assert np.nanmax(np.abs(found.body[..., 6:])) > 0.01 * np.nanmax(np.abs(found.body[..., :6]))
