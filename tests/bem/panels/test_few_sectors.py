"""Harmonics of few sectors of one panel, as plain Python, against the dense equations of each symmetry class."""

import numpy as np
import pytest
from plain import plain

from hakobune.bem.green.tables import wave_table
from hakobune.bem.waves import depth_values
from hakobune.meshing.panels import PanelMesh, structured

influence, axisymmetric = (plain(f"bem.panels.{name}") for name in ("influence", "axisymmetric"))
OMEGA, DEPTH = 1.3, 9.0


def revolved(profile, count, half):
    """`count` sides of a profile (k, 2) of R and z about z, from the axis up; half : those at x > 0 alone"""
    sides = np.arange(count // 2 + 1) - count / 4 if half else np.arange(count + 1)
    angle = 2 * np.pi / count * sides
    R, z = np.transpose(np.array(profile, float))
    height = np.broadcast_to(z, (len(angle), len(z)))
    points = np.stack([np.outer(np.cos(angle), R), np.outer(np.sin(angle), R), height], axis=-1)
    if not half:
        points[-1] = points[0]
    made = structured(points[:, ::-1])
    return PanelMesh(made.points, made.corners, "x" if half else "")


@pytest.mark.parametrize("half", [False, True], ids=["whole", "half"])
@pytest.mark.parametrize("covered", [False, True], ids=["open", "lid"])
def test_harmonics_solve_the_equations_of_every_class(half, covered):
    count = 6 if half else 3 if covered else 5  # more sectors than nodes of one, and fewer
    hull = revolved([(0, -3), (2, -0.2)], count, half)
    top = revolved([(2, 0), (0, 0)], count, half) if covered else None
    if covered and top.area_vectors[0, 2] < 0:
        top = PanelMesh(top.points, top.corners[:, ::-1], top.symmetry)
    g = influence.Geometry(hull, top, DEPTH)
    own = axisymmetric.sectors(g)
    assert len(own.node) == count and own.node.shape[1] == (8 if covered else 4)
    assert len(own.rows) == own.node.shape[1] // (2 if half else 1)
    table = wave_table(OMEGA, DEPTH, 9.80665, g.reach, g.draft)
    Z, n = depth_values(table.k, DEPTH), len(g.elements.nodes)
    S, D = axisymmetric.sector_rows(g, 0.7, table, Z)
    whole = influence.layers(g, np.arange(n), g.classes, 0.7, table, Z)
    for part, every in zip((S, D), whole, strict=True):
        assert np.abs(part - every[:, own.first]).max() < 1e-12 * np.abs(every).max()
    rng = np.random.default_rng(3)
    velocities = {cls: rng.normal(size=(2, g.hull)) for cls in g.classes}
    found, residual = axisymmetric.solved_by_harmonics(g, S, D, table.K, velocities)
    assert residual < 1e-12
    on_hull = np.arange(n) < g.hull
    for (cls, V), single, double in zip(velocities.items(), *whole, strict=True):
        A = np.where(on_hull, double, table.K * single)
        A[on_hull] *= -1
        A += np.diag(np.where(on_hull, 2 * np.pi, 4 * np.pi))
        side = np.where(on_hull, -1.0, 1.0)[:, None] * (single[:, on_hull] @ V.T)
        true = np.linalg.solve(A, side)[on_hull].T
        assert np.abs(found[cls] - true).max() < 1e-7 * np.abs(true).max()


def test_harmonics_that_no_motion_has_are_left_out_where_forces_are_asked_for():
    """Of a body of four sides: heave has harmonic 0, surge 1 and 3; a wave of harmonic 2 pushes nothing"""
    g = influence.Geometry(revolved([(0, -3), (2, -0.2)], 4, False), None, DEPTH)
    own = axisymmetric.sectors(g)
    table = wave_table(OMEGA, DEPTH, 9.80665, g.reach, g.draft)
    S, D = axisymmetric.sector_rows(g, 1.0, table, depth_values(table.k, DEPTH))
    turn = np.empty(g.hull)
    turn[own.node] = np.arange(4)[:, None]
    given = {g.classes[0]: np.stack([(-1.0) ** turn, np.ones(g.hull)])}
    every = axisymmetric.solved_by_harmonics(g, S, D, table.K, given)[0][g.classes[0]]
    some = axisymmetric.solved_by_harmonics(g, S, D, table.K, given, False)[0][g.classes[0]]
    assert np.abs(some[0]).max() < 1e-12 < np.abs(every[0]).max() and some[1] == pytest.approx(every[1])


@pytest.mark.parametrize("spoil", ["radius", "height", "angle", "none", "wall"])
def test_points_a_ten_millionth_of_a_panel_off_are_no_sectors(spoil):
    """1e-7 of the smallest panel's size, and never before a wall"""
    for share, axisymmetric_ in ((0.5e-7, True), (20e-7, False)):
        hull = revolved([(0, -3), (2, -3), (2, 0)], 6, False)
        points = hull.points.copy()
        rim = np.flatnonzero((np.abs(points[:, 2]) < 1e-9) & (points[:, 0] > 1.9))[0]
        size = share * hull.sizes.min()
        if spoil in ("radius", "height"):
            points[rim, 0 if spoil == "radius" else 2] -= size
        elif spoil == "angle":
            points[rim, 1] += size
        moved = PanelMesh(points, hull.corners, "")
        g = influence.Geometry(moved, None, DEPTH, wall=5.0 if spoil == "wall" else None)
        expected = spoil != "wall" and (axisymmetric_ or spoil == "none")
        assert (axisymmetric.sectors(g) is not None) is expected


def test_three_sectors_pay_and_two_do_not():
    assert axisymmetric.sectors(influence.Geometry(revolved([(0, -3), (2, -3), (2, 0)], 3, False), None, DEPTH))
    square = PanelMesh(*(lambda m: (m.points * [1, 0.5, 1], m.corners))(revolved([(0, -3), (2, -3), (2, 0)], 4, False)))
    assert axisymmetric.sectors(influence.Geometry(square, None, DEPTH)) is None  # of two
    assert [axisymmetric._next_divisor(n) for n in (12, 9, 7, 6)] == [6, 3, 1, 3]


def test_half_a_round_body_against_a_wall_is_no_round_body():
    """It and its image behind the wall are, but only what lies before the wall is the body's"""
    half = revolved([(0, -3), (2, -3), (2, 0)], 12, True)
    beside = PanelMesh(half.points[:, [1, 0, 2]], half.corners[:, ::-1], "")  # y > 0
    assert axisymmetric.sectors(influence.Geometry(half, None, DEPTH)) is not None
    g = influence.Geometry(beside, None, DEPTH, wall=0.0)
    assert len(g.images) == 2 and g.copies == 1 and axisymmetric.sectors(g) is None
