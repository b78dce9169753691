from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix, stands, waterplane_area
from hakobune.meshing.panels import SYMMETRIES, joined, structured
from hakobune.meshing.shapes import box, buoy

RHO, G = 1025.0, 9.80665


def hemisphere(n, radius=1.0):
    """Lower half of a sphere, corners on the sphere."""
    u, v = np.linspace(0, np.pi / 2, n + 1), np.linspace(0, 2 * np.pi, 4 * n + 1)
    u, v = u[:, None], v[None, :]
    points = np.stack(np.broadcast_arrays(np.cos(u) * np.cos(v), np.cos(u) * np.sin(v), -np.sin(u)), axis=-1)
    mesh = structured(radius * points)
    return mesh if mesh.volume > 0 else mesh.flipped()


def pontoon():
    """A box off the origin."""
    return box(10, 6, 4, panels=100, symmetry="").moved(dx=3, dy=-1)


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_metacentric_heights_of_the_reports_float_a(symmetry):
    # Research on the design of box-type shallow-water floating structures (SR179 report, 1982), table 2.1.5.1:
    # L 100, B 50, d 10, KG 10 m; GM_T 15.83, GM_L 78.33 m
    still = hydrostatics(box(100, 50, 10, symmetry=symmetry), center_of_mass=(0, 0, 0))
    assert still.transverse_metacentric_height == pytest.approx(15.83, abs=0.005)
    assert still.longitudinal_metacentric_height == pytest.approx(78.33, abs=0.005)


def test_a_box_is_exact():
    L, B, d, zg = 100, 50, 10, -3.0
    still = hydrostatics(box(L, B, d), center_of_mass=(0, 0, zg))
    np.testing.assert_allclose(still.volumes, L * B * d, rtol=1e-12)
    assert still.volume_difference < 1e-12
    np.testing.assert_allclose(still.center_of_buoyancy, (0, 0, -d / 2), rtol=1e-12)
    assert still.wetted_area == pytest.approx(L * B + 2 * (L + B) * d, rel=1e-12)
    assert still.waterplane_area == pytest.approx(L * B, rel=1e-12)
    np.testing.assert_allclose(still.waterplane_moments, (L * B**3 / 12, B * L**3 / 12, 0), rtol=1e-12)
    assert still.transverse_metacentric_radius == pytest.approx(B**2 / 12 / d, rel=1e-12)
    assert still.longitudinal_metacentric_radius == pytest.approx(L**2 / 12 / d, rel=1e-12)
    W = RHO * G * L * B * d
    expected = np.diag([0, 0, RHO * G * L * B, W * (B**2 / 12 / d - d / 2 - zg), W * (L**2 / 12 / d - d / 2 - zg), 0])
    np.testing.assert_allclose(still.stiffness, expected, rtol=1e-12, atol=1e-12)


def test_a_buoy_has_the_exact_area_and_center_of_a_cylinder():
    still = hydrostatics(buoy(10, 6))
    assert still.volume == pytest.approx(np.pi * 600, rel=1e-12)
    assert still.waterplane_area == pytest.approx(np.pi * 100, rel=1e-12)
    assert still.center_of_buoyancy[2] == pytest.approx(-3, rel=1e-12)


def test_a_hemisphere_converges_at_second_order():
    exact = np.array([2 * np.pi / 3, -3 / 8, np.pi, np.pi / 4])

    def errors(n):
        still = hydrostatics(hemisphere(n))
        found = [still.volume, still.center_of_buoyancy[2], still.waterplane_area, still.waterplane_moments[0]]
        return np.abs(found - exact)

    e = np.array([errors(n) for n in (6, 12, 24)])
    np.testing.assert_allclose(np.log2(e[:-1] / e[1:]), 2, atol=0.05)


def test_the_metacentre_of_a_sphere_is_its_centre():
    still = hydrostatics(hemisphere(24))
    height = still.center_of_buoyancy[2] + still.transverse_metacentric_radius
    assert abs(height) < (np.pi / 2 / 24) ** 2  # corners on the sphere: second order in the panel size


def test_triangles_keep_a_hull_of_skew_panels_closed():
    mesh = hemisphere(5)
    twisted = replace(mesh, points=mesh.points * (1, 1.3, 1) + 0.1 * mesh.points[:, [1, 0, 2]] * (1, 1, 0))
    assert hydrostatics(twisted).volume_difference < 1e-12


def test_a_shifted_hull_shifts_its_centres_and_keeps_its_moments():
    at_origin, shifted = (hydrostatics(m) for m in (box(10, 6, 4, symmetry=""), pontoon()))
    np.testing.assert_allclose(shifted.center_of_buoyancy, at_origin.center_of_buoyancy + [3, -1, 0], atol=1e-12)
    np.testing.assert_allclose(shifted.waterplane_center, (3, -1), atol=1e-12)
    np.testing.assert_allclose(shifted.waterplane_moments, at_origin.waterplane_moments, rtol=1e-11, atol=1e-9)


def test_stiffness_follows_a_change_of_the_rotation_centre():
    # motions about the new centre are T times those about the origin, so the stiffness is congruent; weight and
    # buoyancy balance here, or a part of first order in their difference would be left
    about = np.array([1.0, 2.0, -3.0])
    first = hydrostatics(pontoon(), (3.0, -1.0, -1.0)).stiffness
    second = hydrostatics(pontoon(), (3.0, -1.0, -1.0), rotation_center=about).stiffness
    T = np.eye(6)
    T[:3, 3:] = np.cross(np.eye(3), -about).T  # column k: e_k × (origin − new centre)
    np.testing.assert_allclose(second, T.T @ first @ T, rtol=1e-9, atol=1e-9 * np.abs(first).max())


def heeling_moment(L, B, d, zg, angle):
    """N m that turns a box upright, heeled by `angle` about its waterplane axis, from its wetted cross section."""
    c, s = np.cos(angle), np.sin(angle)
    top = B / 2 * np.tan(angle)
    section = np.array([[-B / 2, -d], [B / 2, -d], [B / 2, -top], [-B / 2, top]])  # in the axes of the body
    y, z = (section @ np.array([[c, s], [-s, c]])).T
    cross = y * np.roll(z, -1) - z * np.roll(y, -1)
    first_moment = np.sum((y + np.roll(y, -1)) * cross) / 6
    return RHO * G * L * (first_moment - B * d * (-s * zg))


def test_stiffness_is_the_derivative_of_the_moment_of_a_heeled_box():
    L, B, d, zg = 10.0, 6.0, 4.0, 1.0
    stiffness = hydrostatics(box(L, B, d), (0, 0, zg)).stiffness[3, 3]
    moments = [-heeling_moment(L, B, d, zg, a) / a for a in (1e-2, 5e-3)]
    errors = np.abs(np.abs(moments) - abs(stiffness))
    assert errors[1] < 1e-4 * abs(stiffness)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.01)


def test_weight_beyond_buoyancy_enters_where_its_moment_does():
    hull = box(10, 6, 4)
    light = hydrostatics(hull, (1.0, 2.0, -1.0), mass=1e5)
    heavy = hydrostatics(hull, (1.0, 2.0, -1.0), mass=2e5)
    extra = heavy.stiffness - light.stiffness
    weight = 1e5 * G
    expected = np.zeros((6, 6))
    expected[3, 3] = expected[4, 4] = -weight * -1.0
    expected[3, 5], expected[4, 5] = weight * 1.0, weight * 2.0
    np.testing.assert_allclose(extra, expected, atol=1e-9 * weight)


def test_a_body_turned_by_a_right_angle_exchanges_roll_and_pitch():
    first = hydrostatics(box(10, 6, 4)).stiffness
    second = hydrostatics(box(10, 6, 4).rotated(np.pi / 2)).stiffness
    assert second[3, 3] == pytest.approx(first[4, 4], rel=1e-12)
    assert second[4, 4] == pytest.approx(first[3, 3], rel=1e-12)


def test_a_submerged_body_has_no_waterplane():
    top = structured(np.array([[[-5, -3, 0], [-5, 3, 0]], [[5, -3, 0], [5, 3, 0.0]]]))
    assert top.normals[0, 2] > 0
    under = hydrostatics(joined([box(10, 6, 4, symmetry=""), top]).moved(dz=-2))
    assert under.volume == pytest.approx(240)
    assert under.waterplane_area == 0
    assert np.isnan(under.waterplane_center).all()
    assert under.center_of_buoyancy[2] == pytest.approx(-4)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: hydrostatics(box(10, 6, 4).flipped()), "normals point inward"),
        (lambda: hydrostatics(buoy(10, 6, bottom=False)), "not closed"),
        (lambda: hydrostatics(box(10, 6, 4), density=0), "density is 0"),
        (lambda: hydrostatics(box(10, 6, 4), mass=-1), "mass is -1"),
        (lambda: hydrostatics(box(10, 6, 4), center_of_mass=(0, 0)), "center_of_mass is"),
        (lambda: hydrostatics(box(10, 6, 4), center_of_mass=(0, 0, np.nan)), "center_of_mass is"),
        (lambda: hydrostatics(box(10, 6, 4), rotation_center=(np.inf, 0, 0)), "rotation_center is"),
        (lambda: inertia_matrix(1, (0, 0, 0), (1, -1, 1)), "gyration is"),
    ],
)
def test_what_has_no_hydrostatics_is_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_inertia_is_that_of_masses_on_sticks():
    # six equal masses at ± the distances that give the radii of gyration, each m/6
    rng = np.random.default_rng(0)
    com, about = rng.normal(size=3), rng.normal(size=3)
    a, b, c = 1.0, 2.0, 3.0
    points = com + np.concatenate([np.diag([a, b, c]), -np.diag([a, b, c])])
    mass = 12.0
    expected = np.zeros((6, 6))
    for point in points:
        x, y, z = point - about
        move = np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]])  # velocity of the point
        expected += mass / 6 * move.T @ move
    gyration = np.sqrt(np.array([b * b + c * c, a * a + c * c, a * a + b * b]) / 3)
    np.testing.assert_allclose(inertia_matrix(mass, com, gyration, about), expected, atol=1e-12)


@pytest.mark.parametrize("symmetry", ["xy", "x", ""])
def test_walls_on_the_bed_are_closed_by_it(symmetry):
    """A caisson, moved and turned: volume, centres, waterplane and stiffness as with its bottom, and its own area"""
    walls = box(12, 8, 5, counts=(3, 2, 3), bottom=False, symmetry=symmetry)
    with_bottom = box(12, 8, 5, counts=(3, 2, 3), symmetry=symmetry)
    if symmetry == "":
        walls, with_bottom = (one.rotated(0.4).moved(30.0, -7.0) for one in (walls, with_bottom))
    found, known = hydrostatics(walls, depth=5.0), hydrostatics(with_bottom)
    for name in ("volume", "center_of_buoyancy", "waterplane_area", "waterplane_moments", "stiffness"):
        assert getattr(found, name) == pytest.approx(getattr(known, name), rel=1e-9, abs=1e-3), name
    assert found.wetted_area == pytest.approx(2 * (12 + 8) * 5) and walls.volume == pytest.approx(480)
    assert with_bottom.foot is None and waterplane_area(walls) == pytest.approx(96)
    assert not stands(walls, 5.1) and not stands(walls, np.inf) and stands(walls, 5.0)
    with pytest.raises(ValueError, match="not closed"):
        hydrostatics(walls, depth=6.0)


def test_walls_around_a_shaft_are_closed_without_it():
    ring = joined([buoy(10, 6, bottom=False).whole(), buoy(4, 6, bottom=False).whole().flipped()])
    assert hydrostatics(ring, depth=6.0).volume == pytest.approx(np.pi * (100 - 16) * 6)
