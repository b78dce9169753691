"""Points of a hull and their mirror images: fields of symmetry classes, products with motions, against plain sums."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.modes import class_of, normal_velocities
from hakobune.bem.panels.pressure_drift import hull_flow
from hakobune.bem.panels.pressure_drift.hull_flow import HullFlow, HullSurfaces, Points, unit_displacements

RNG = np.random.default_rng(3)
CLASSES = ((1, 1), (-1, 1), (1, -1), (-1, -1))
IMAGES = np.array([(1, 1), (-1, 1), (1, -1), (-1, -1)])
SIGNS = np.array([[(x if a < 0 else 1) * (y if b < 0 else 1) for a, b in IMAGES] for x, y in CLASSES], float)
MEMBERS = [[d for d in range(6) if class_of(d, "xy") == cls] for cls in CLASSES]


@pytest.fixture
def hull():
    points, normals = RNG.uniform(0.5, 2, size=(5, 3)) * [1, 1, -1], RNG.normal(size=(5, 3))
    return Points(IMAGES, SIGNS, MEMBERS, points, normals, RNG.uniform(1, 2, 5))


def of_class(hull, c):
    """A velocity of one class at all points, and at those of the meshed part"""
    own = RNG.normal(size=(5, 3)) + 1j * RNG.normal(size=(5, 3))
    return (SIGNS[c][:, None, None] * own * hull.mirrors[:, None]).reshape(1, -1, 3), own


def test_points_and_normals_of_images_are_mirrored_and_weights_are_the_same(hull):
    assert hull.copies == 4 and hull.points.shape == (20, 3)
    assert hull.points[5:10] == pytest.approx(hull.points[:5] * [-1, 1, 1])
    assert hull.normals[15:] == pytest.approx(hull.normals[:5] * [-1, -1, 1])
    assert np.array_equal(hull.weights, np.tile(hull.weights[:5], 4))


@pytest.mark.parametrize("c", range(4))
def test_a_field_of_a_class_has_its_part_and_no_other(hull, c):
    whole, own = of_class(hull, c)
    parts = hull.by_class(whole)
    assert parts.shape == (4, 1, 15) and parts[c, 0] == pytest.approx(own.ravel())
    assert np.abs(np.delete(parts, c, axis=0)).max() < 1e-12


def test_motions_whose_product_is_of_a_class_are_its_pairs(hull):
    """Surge times pitch is even in x and y; heave times sway odd in y"""
    for c, (one, other) in enumerate(hull.products):
        found = set(zip(one.tolist(), other.tolist(), strict=True))
        true = {
            (i, j) for i in range(6) for j in range(6)
            if tuple(np.multiply(class_of(i, "xy"), class_of(j, "xy"))) == CLASSES[c]
        }  # fmt: skip
        assert found == true


def test_unit_motions_displace_points_as_of_a_rigid_body():
    x = RNG.normal(size=(4, 3))
    motion = RNG.normal(size=6)
    assert np.einsum("m,mpd->pd", motion, unit_displacements(x)) == pytest.approx(motion[:3] + np.cross(motion[3:], x))


def test_sums_over_the_hull_follow_from_the_meshed_part(hull):
    """∬ v·w n_c dS and ∬ e_m·v n_c dS for fields of classes whose product has the parity of the rest"""
    surfaces = HullSurfaces(hull, hull)
    modes = normal_velocities(hull.points, hull.normals)
    assert surfaces.hull_modes == pytest.approx(modes) and surfaces.waterline_modes == pytest.approx(modes)
    displaced = unit_displacements(hull.points)
    for a in range(4):
        v, v0 = of_class(hull, a)
        for b in range(4):
            w, w0 = of_class(hull, b)
            for c in range(6):
                true = np.sum(np.sum(v[0] * w[0], axis=1) * modes[:, c] * hull.weights)
                if np.array_equal(SIGNS[a] * SIGNS[b], SIGNS[CLASSES.index(class_of(c, "xy"))]):
                    assert surfaces.weighted_modes[c] @ (v0 * w0).ravel() == pytest.approx(true)
                else:
                    assert abs(true) < 1e-9
        pairs = zip(*hull.products[a], surfaces.carried[a], strict=True)
        for m, c, row in pairs:
            true = np.sum(np.sum(displaced[m] * v[0], axis=1) * modes[:, c] * hull.weights)
            assert row @ v0.ravel() == pytest.approx(true)


def test_products_of_turns_and_strains_are_those_of_each_point(hull):
    surfaces = HullSurfaces(hull, hull)
    p, r, m = 7, 1, 4
    turned = np.cross(np.eye(3)[r], hull.normals[p]) @ unit_displacements(hull.points)[m, p] * hull.weights[p]
    assert surfaces.turned[p, 6 * r + m] == pytest.approx(turned)
    assert surfaces.strained[p].reshape(3, 3) == pytest.approx(
        np.outer(hull.normals[p], hull.points[p]) * hull.weights[p]
    )


def test_flows_of_several_frequencies_are_one_after_another(hull):
    def flow(omega, count):
        v = RNG.normal(size=(count, 20, 3)) + 1j
        return HullFlow(np.full(count, omega), np.ones((count, 6)), v, v[:, :2, 0], v[..., 0], hull)

    one, two = flow(0.5, 2), flow(0.9, 1)
    both = HullFlow.joined([one, two])
    assert both.omega.tolist() == [0.5, 0.5, 0.9] and both.hull is hull
    assert np.array_equal(both.velocity[2], two.velocity[0]) and np.array_equal(both.potential[:2], one.potential)
    assert both.parts.shape == (4, 2, 3, 15)
    assert both.parts[1, 1] == pytest.approx(hull.by_class(both.velocity)[1].imag)


def test_incident_waves_have_their_amplitude_and_radiated_flows_none():
    from hakobune.bem.waves import incident_wave

    run = SimpleNamespace(problem=SimpleNamespace(depth=9.0, gravity=9.81), omega=0.9, k=0.11)
    at = RNG.normal(size=(2, 3, 3)) - [0, 0, 4]
    value, slope = hull_flow._incident(run, at, np.array([1.0, 2j]), np.array([0.3, 2.0]))
    for i, (amplitude, beta) in enumerate(((1.0, 0.3), (2j, 2.0))):
        true = incident_wave(at, beta, 0.9, 0.11, 9.0, 9.81)
        assert value[i] == pytest.approx(amplitude * true[0]) and slope[i] == pytest.approx(amplitude * true[1])
    value, slope = hull_flow._incident(run, at, np.zeros(6), np.zeros(6))
    assert value.shape == (6, 2, 3) and slope.shape == (6, 2, 3, 3) and not value.any() and not slope.any()


def test_the_disturbance_of_classes_is_put_together_on_all_images():
    run = SimpleNamespace(geometry=SimpleNamespace(signs=lambda cls: SIGNS[CLASSES.index(cls)]))
    parts = {cls: (RNG.normal(size=3), None) for cls in CLASSES}
    found = hull_flow._on_images(run, parts)
    for i in range(4):
        assert found[i] == pytest.approx(sum(SIGNS[c, i] * parts[cls][0] for c, cls in enumerate(CLASSES)))


@pytest.mark.parametrize("moves", [True, False])
def test_motions_of_unit_velocity_of_one_of_two_bodies_have_their_potentials(moves, monkeypatch):
    """i/ω of displacement in each motion, none of a hull that is held; class by class on all images"""
    monkeypatch.setattr(hull_flow, "_flow", lambda *them: them)
    phi = {cls: RNG.normal(size=(2, 3)) for cls in CLASSES[:2]}
    geometry = SimpleNamespace(images=IMAGES, hull=3, signs=lambda cls: SIGNS[CLASSES.index(cls)])
    run = SimpleNamespace(geometry=geometry, omega=0.8, potentials=phi,
                          columns={CLASSES[0]: ([2, 8], []), CLASSES[1]: ([6, 10], [])})  # fmt: skip
    _, surfaces, found, waves, motions, headings = hull_flow.radiated_flow(run, "surfaces", 1, moves)
    assert surfaces == "surfaces" and not waves.any() and not headings.any() and len(waves) == len(headings) == 6
    assert motions == pytest.approx(np.eye(6) * 1j / 0.8 if moves else np.zeros((6, 6)))
    wanted = np.zeros((6, 4, 3))
    wanted[2], wanted[0], wanted[4] = (
        np.outer(SIGNS[c], phi[CLASSES[c]][n]) for c, n in ((0, 1), (1, 0), (1, 1))
    )  # fmt: skip
    assert found == pytest.approx(wanted)
