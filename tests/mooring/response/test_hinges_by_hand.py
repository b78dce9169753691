"""Hinges between two bodies: one body where the link is rigid, springs that grow stiff, forces that are equal."""

import numpy as np
import pytest
from made_up_body import HEADINGS, INERTIA, OMEGA, STIFFNESS, coefficients
from two_bodies import ASTERN, BODIES, forces, twice, two_bodies

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.bem.database.resonances import resonances
from hakobune.bem.hinges import Link
from hakobune.mooring.response.points import Pair, Point, transfer_functions

AT = (4.0, -30.0, 2.0)  # of the ship, whose origin is at y = 30: the point (4, 0, 2) of the scene
SHIP, BARGE = Point("s", AT, None, "ship"), Point("b", (6.0, -30.0, 2.0), None, "barge")  # the same point, from both
OMEGAS = OMEGA[[3, 12, 20]]


def dynamic(w):
    A, B = coefficients(w)
    return -(w**2) * twice(INERTIA + A) - 1j * w * twice(B) + twice(STIFFNESS)


def linked(kind="hinge", axis=(1.0, 0.0, 0.0)):
    return two_bodies().linked([Link("joint", ("ship", "barge"), AT, axis, kind)])


def test_two_bodies_that_are_one_move_as_one():
    """By hand: barge turned by 180° with its centre 12 m ahead and 60 m to starboard of the ship's"""
    x, y, z = 12.0, -60.0, 0.0
    shift = np.block([[np.eye(3), np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])], [np.zeros((3, 3)), np.eye(3)]])
    both = np.vstack([np.eye(6), ASTERN @ shift])
    X = linked("rigid").motions(OMEGAS)
    for w, found in zip(OMEGAS, X, strict=True):
        one = np.linalg.solve(both.T @ dynamic(w) @ both, both.T @ forces(w, HEADINGS).T)
        assert pytest.approx(both @ one, rel=1e-9, abs=1e-12) == found.T


def test_a_hinge_is_where_springs_grow_stiff_to_first_order():
    """Springs of k between the same points, and k ℓ² against turning about y and z"""
    from hakobune.bem.hinges import rows_of

    bodies = two_bodies()
    G = rows_of(bodies, Link("joint", ("ship", "barge"), AT, (1.0, 0.0, 0.0)))
    exact, errors = linked().motions(OMEGAS), []
    assert bodies.linked([]).own and not linked().own and not bodies.restrained(stiffness=G.T @ G).linked([]).own
    for k in (1e12, 1e13, 1e14):
        errors.append(np.abs(bodies.restrained(stiffness=k * G.T @ G).motions(OMEGAS) - exact).max())
    assert np.divide(errors[:-1], errors[1:]) == pytest.approx([10, 10], rel=0.05) and len(G) == 5


def test_what_a_hinge_holds_stays_together_and_its_force_is_what_each_body_lacks():
    bodies = linked()
    found = transfer_functions(bodies, OMEGAS, HEADINGS, [Pair("gap", (SHIP, BARGE))])
    X, size = found.value[..., :12], np.abs(found.value[..., :12]).max()
    gap = found.value[..., [found.names.index(f"gap relative displacement {axis}") for axis in "xyz"]]
    assert np.abs(gap).max() < 1e-12 * size
    assert X[..., 10:12] == pytest.approx(-X[..., 4:6] * [1, -1], abs=1e-12)  # pitch against pitch, yaw with yaw
    assert np.abs(X[..., 3] + X[..., 9]).max() > 1e-3 * np.abs(X[..., 3]).max()  # roll is free
    held = found.value[
        ..., [found.names.index(f"joint {word} {axis}") for word in ("force", "moment") for axis in "xyz"]
    ]
    assert np.abs(held[..., 3]).max() < 1e-9 * np.abs(held).max()  # no moment about the hinge
    arm = np.array(AT) - BODIES[0].own_center
    for w, x, h, f in zip(OMEGAS, X, held, (forces(w, HEADINGS) for w in OMEGAS), strict=True):
        left = x @ dynamic(w).T - f  # what holds ship and barge, by hand
        assert left[:, :3] == pytest.approx(-h[:, :3], rel=1e-6)
        assert left[:, 6:9] == pytest.approx(h[:, :3] * [-1, -1, 1], rel=1e-6)
        moment = -h[:, 3:] - np.cross(arm, h[:, :3])
        assert left[:, 3:6] == pytest.approx(moment, rel=1e-6, abs=1e-6 * np.abs(moment).max())


def test_periods_and_peaks_are_of_what_is_left_free():
    assert len(natural_periods(linked("ball")).period) == 9 and len(natural_periods(linked("rigid")).period) == 6
    rigid = {one.name for one in resonances(linked("rigid"))}
    assert 0 < len(rigid) <= 4


def test_a_quay_holds_and_too_many_links_are_told():
    held = two_bodies().linked([Link("quay", ("pier", "barge"), (0.0, 0.0, 0.0), kind="rigid")])
    assert np.abs(held.motions(OMEGAS)[..., 6:]).max() < 1e-12
    two = [Link(name, ("ship", "barge"), AT, kind="rigid") for name in ("one", "two")]
    with pytest.raises(ValueError, match="fix 6 motions with 12 constraints: some constraints repeat others"):
        two_bodies().linked(two)
    with pytest.raises(BetweenError, match="no body 'tug'"):
        two_bodies().linked([Link("x", ("ship", "tug"), AT)])
