"""Stiffness of mooring systems: published tables, finite differences, reciprocity, and that nothing is left at rest."""

from dataclasses import replace

import numpy as np
import pytest
from mooring_systems import CHAIN, OC3, OC4, SHIFT, SYSTEMS, TURN, central_differences, eight_lines, fourth_order

from hakobune.bem import DOFS
from hakobune.mooring.lines.system.bodies import cross_matrix
from hakobune.mooring.lines.system.equilibrium import moved, rest
from hakobune.mooring.lines.system.parts import (
    Anchor,
    Fairlead,
)
from hakobune.mooring.studies.system_at_rest import (
    about_body_axes,
    mooring_stiffness,
    offset_curve,
)


def assert_prints(value, printed, digits):
    """The value rounds to the printed figure."""
    unit = 10.0 ** (np.floor(np.log10(abs(printed))) + 1 - digits)
    assert round(value / unit) == round(printed / unit), (value, printed)


# Published: Jonkman, Definition of the Floating System for Phase IV of OC3, NREL/TP-500-47535 (2010), eq. 5-3, without
# its additional yaw spring; Robertson et al., Definition of the Semisubmersible Floating System for Phase II of OC4,
# NREL/TP-5000-60601 (2014), section 5.  Both come out of FAST v7's central differences, 2 deg and 0.349 m, of angles
# taken through its orthonormal small-rotation matrix (tan), about still water on the axis: hence column 5 of row 1 is
# not row 5 of column 1.  digits: as printed.
PUBLISHED = [
    (OC3, 4, {(0, 0): 41180, (1, 1): 41180, (2, 2): 11940, (3, 3): 3.111e8, (4, 4): 3.111e8, (5, 5): 1.156e7}),
    (OC3, 4, {(0, 4): -2.821e6, (1, 3): 2.821e6, (3, 1): 2.816e6, (4, 0): -2.816e6}),
    (OC4, 3, {(0, 0): 7.08e4, (1, 1): 7.08e4, (2, 2): 1.91e4, (3, 3): 8.73e7, (4, 4): 8.73e7, (5, 5): 1.17e8}),
    (OC4, 3, {(0, 4): -1.08e5, (1, 3): 1.08e5}),
]


@pytest.mark.parametrize(("system", "digits", "printed"), PUBLISHED)
def test_published_stiffness_is_reproduced_to_every_printed_digit(system, digits, printed):
    K = central_differences(system, system.pose, SHIFT, TURN, np.arctan)
    for place, value in printed.items():
        assert_prints(K[place], value, digits)


def test_preload_of_oc3_is_the_published_one():
    assert_prints(OC3.load().force[2], -1_607_000, 4)


@pytest.mark.parametrize("system", [OC3, OC4])
def test_stiffness_without_friction_and_at_rest_is_symmetric(system):
    K = system.load().stiffness
    unit = np.sqrt(np.abs(np.diag(K)))
    assert np.abs((K - K.T) / np.outer(unit, unit)).max() < 1e-12


@pytest.mark.parametrize("system", [OC3, OC4])
def test_stiffness_is_the_limit_of_the_published_differences(system):
    K, scale = system.load().stiffness, np.sqrt(np.abs(np.diag(system.load().stiffness)))
    wrong = []
    for part in (1.0, 0.5, 0.25):
        D = central_differences(system, system.pose, part * SHIFT, part * TURN, np.arctan)
        wrong.append(np.abs((D - K) / np.outer(scale, scale)).max())
    orders = np.log2(np.divide(wrong[:-1], wrong[1:]))
    assert np.all(np.abs(orders - 2) < 0.1), orders


@pytest.fixture(scope="module", params=SYSTEMS)
def at_rest(request):
    return rest(SYSTEMS[request.param])


def test_nothing_is_left_at_rest(at_rest):
    assert np.abs(at_rest.residual).max() < 1e-9 * at_rest.tension.sum()
    again = at_rest.system.total_load(at_rest.pose).force
    assert np.abs(again[at_rest.moving]).max() < 1e-9 * at_rest.tension.sum()


def test_all_forces_on_the_system_together_vanish(at_rest):
    """Weight, buoyancy, bed and anchors hold what the loads pull: summed from the ends of the lines alone."""
    system, lines = at_rest.system, at_rest.lines
    ends = system.arrays[4]
    away = (at_rest.points[ends[:, 1]] - at_rest.points[ends[:, 0]])[:, :2]
    away /= np.linalg.norm(away, axis=1)[:, None]
    held = {i for i, p in enumerate(system.points) if isinstance(p, Anchor)}
    at_anchor = sum(
        (h * sign * u for (a, b), u, ha, hb in zip(ends, away, lines.horizontal_a, lines.horizontal_b, strict=True)
         for end, h, sign in ((a, ha, 1), (b, hb, -1)) if end in held),
        np.zeros(2),
    )  # fmt: skip
    loads = sum((np.asarray(body.load[:2]) for body in system.bodies), np.zeros(2))
    assert np.allclose(at_anchor, loads, atol=1e-8 * at_rest.tension.sum())


def test_stiffness_is_that_of_finite_differences_to_1e6(at_rest):
    K = at_rest.stiffness
    D = fourth_order(at_rest.system, at_rest.pose)
    # a point held on the bed cannot be pushed below it, and its own height is no freedom
    free = at_rest.moving | (np.arange(len(K)) < 6 * len(at_rest.system.bodies))
    scale = np.sqrt(np.abs(np.diag(K))) + 1.0
    wrong = np.abs((D - K) / np.outer(scale, scale))[np.ix_(free, free)]
    assert wrong.max() < 1e-6


def test_condensed_stiffness_is_the_force_of_a_small_motion_with_everything_else_at_rest_anew(at_rest):
    system = at_rest.system
    for i, body in enumerate(system.bodies):
        K = mooring_stiffness(at_rest, body.name)
        own = slice(6 * i, 6 * i + 6)

        def force(j, step, i=i, own=own):
            whole = np.zeros(len(at_rest.force))
            whole[6 * i + j] = step
            pose = moved(system, at_rest.pose, whole)
            held = replace(
                system, bodies=[replace(b, freedom=() if n == i else b.freedom) for n, b in enumerate(system.bodies)]
            )
            found = rest(held, pose)
            return held.load(found.pose).force[own]

        scale = np.sqrt(np.abs(np.diag(K))) + 1.0
        for j in range(6):
            h = 2e-2 if j < 3 else 1e-3
            column = -(8 * (force(j, h) - force(j, -h)) - (force(j, 2 * h) - force(j, -2 * h))) / (12 * h)
            assert np.abs((column - K[:, j]) / scale / scale[j]).max() < 1e-6, DOFS[j]


def asymmetry(system, pose):
    """Largest part of K − K' that the moments of the lines do not explain, as a share of the stiffness.

    Forces from an energy have K − K' = S(M) in the rotations of a body about space axes, and no more.
    """
    load = system.load(pose)
    D = load.stiffness - load.stiffness.T
    for i in range(len(system.bodies)):
        turns = slice(6 * i + 3, 6 * i + 6)
        D[turns, turns] -= cross_matrix(load.force[turns])
    scale = np.sqrt(np.abs(np.diag(load.stiffness))) + 1.0
    return np.abs(D / np.outer(scale, scale)).max()


def test_stiffness_without_friction_is_reciprocal_also_with_free_buoys(at_rest):
    assert asymmetry(at_rest.system, at_rest.pose) < 1e-10


def test_friction_on_the_bed_leaves_the_stiffness_of_inextensible_lines_reciprocal_and_of_others_not():
    def with_friction(axial_stiffness):
        kind = replace(CHAIN, axial_stiffness=axial_stiffness)
        lines = tuple(replace(line, bed_friction=0.5, type=kind) for line in eight_lines().lines)
        return replace(eight_lines(), lines=lines)

    assert asymmetry(*(lambda s: (s.system, s.pose))(rest(with_friction(np.inf)))) < 1e-10
    assert asymmetry(*(lambda s: (s.system, s.pose))(rest(with_friction(5e7)))) > 1e-6


def test_offset_curve_has_the_slope_of_the_condensed_stiffness_and_passes_through_zero():
    state = rest(SYSTEMS["bridle"])
    offsets = np.linspace(-1.0, 1.0, 21)
    for direction in (0.0, 1.0):
        curve = offset_curve(state, "barge", direction, offsets)
        load = np.asarray(state.system.bodies[0].load)
        toward = np.array([np.cos(direction), np.sin(direction), 0, 0, 0, 0])
        assert curve.restoring[10] == pytest.approx(load @ toward, abs=1e-6 * state.tension.max())
        slope = np.gradient(curve.restoring, offsets, edge_order=2)[10]
        expected = toward @ mooring_stiffness(state, "barge") @ toward
        assert slope == pytest.approx(expected, rel=1e-3)


def test_stiffness_about_another_point_is_that_of_fairleads_measured_from_it():
    center, state = np.array([3.0, -2.0, 4.0]), rest(SYSTEMS["eight lines"])
    K = about_body_axes(
        state.system.load(state.pose).stiffness, state.system.load(state.pose).force[:3], state.pose.turn[0], center
    )
    points = [
        replace(p, position=tuple(np.asarray(p.position) - center)) if isinstance(p, Fairlead) else p
        for p in state.system.points
    ]
    place, turn = state.pose.place[0] + state.pose.turn[0] @ center, state.pose.turn[0]
    other = (
        replace(state.system, points=tuple(points))
        .load(state.pose._replace(place=place[None], turn=turn[None]))
        .stiffness
    )
    axes = np.kron(np.eye(2), turn)
    assert np.allclose(K, axes.T @ other @ axes, rtol=1e-9, atol=1e-6 * np.abs(K).max())
