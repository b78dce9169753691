"""Interpolation on panels: exact for the flow round an edge, and for polynomials across mirror planes."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.methods.near_field import near_field_drift
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.panels.elements import elements
from hakobune.bem.panels.pressure_drift.edge_flow import EdgeFlow, nodal_errors
from hakobune.bem.panels.pressure_drift.edges import sharp_sides, stencils
from hakobune.bem.panels.pressure_drift.hull_flow import hull_surfaces, radiated_flow
from hakobune.bem.panels.pressure_drift.hull_interpolation import hull_quadrature, side_quadrature
from hakobune.meshing.panels import PanelMesh, structured
from hakobune.meshing.shapes import box, buoy
from hakobune.meshing.ship import ship

LENGTH, BEAM, DRAFT = SIZES = (100.0, 50.0, 10.0)


def test_the_edges_of_a_box_are_sharp_and_only_they():
    mesh = box(*SIZES, counts=(4, 3, 2))
    exponents, v = sharp_sides(mesh), mesh.vertices
    middles = (v + np.roll(v, -1, axis=1)) / 2
    faces = [np.isclose(middles[..., 0], 50), np.isclose(middles[..., 1], 25), np.isclose(middles[..., 2], -10)]
    on_edge = sum(face.astype(int) for face in faces) > 1
    np.testing.assert_allclose(exponents, np.where(on_edge, 2 / 3, 1))
    barrel = buoy(10, 10, counts=(8, 3, 3))
    v = barrel.vertices
    reach = np.hypot(v[..., 0], v[..., 1])
    keel = np.isclose(v[..., 2], -10) & (reach > 0.99 * reach.max())
    np.testing.assert_allclose(sharp_sides(barrel), np.where(keel & np.roll(keel, -1, axis=1), 2 / 3, 1), atol=1e-12)


@pytest.mark.parametrize("counts", [(7, 5, 4), (7, 6, 4), (8, 6, 3), (7, 6, 5), (12, 10, 6)])
def test_rounding_of_angles_along_an_edge_separates_no_panels(counts):
    """Each is interpolated with its neighbours in both directions: alone its flow is a tenth off and more"""
    mesh = box(*SIZES, counts=counts)
    exponents = sharp_sides(mesh)
    assert all(stencil.count.min() >= 2 for stencil in stencils(mesh, exponents))
    turned = np.where(exponents < 1, exponents * (1 + 1e-15 * np.arange(len(mesh))[:, None]), exponents)
    assert all(stencil.count.min() >= 2 for stencil in stencils(mesh, turned))


def test_slivers_at_the_ends_of_a_ship_do_not_spoil_its_flow():
    """No panel has a tenth of ∬ |∇φ|² of surge, heave or pitch"""
    problem = PanelProblem(ship(280, 40, 14, 0.62, panels=200), depth=18.0)
    run = problem.prepared().run(0.2, [0.0], {"added_mass"}, None, DOFS)
    surfaces = hull_surfaces(run.geometry)
    flow = radiated_flow(run, surfaces)
    energy = np.sum(np.abs(flow.velocity[[0, 2, 4]]) ** 2, axis=-1) * surfaces.hull.weights
    panels = energy.reshape(3, len(problem.mesh) * surfaces.hull.copies, -1).sum(axis=-1)
    assert np.all(panels.max(axis=1) < 0.1 * panels.sum(axis=1))


@pytest.mark.parametrize("panels", [250, 500])
def test_drift_by_pressure_on_a_ship_with_v_shaped_ends_is_near_that_of_the_far_field(panels):
    """Fixed, 2.6 m of water under it, waves towards 150° and 90°: interpolated over rows of twisted panels as of flat
    ones surge was 19 to 71 times the far field's, sway 3 to 21 times"""
    problem = PanelProblem(ship(145, 23, 8.4, 0.79, waterplane=0.87, panels=panels), depth=11.0)
    run = problem.prepared().run(0.6, np.radians([150.0, 90.0]), {"drift_force_fixed"}, None, DOFS)
    near, far = (drift[:, :2] for drift in (near_field_drift(run, False), run.drift(False)))
    assert np.all(np.abs(near - far).max(axis=1) < 0.15 * np.abs(far).max(axis=1))


def sharp_plate(rows, side):
    """A flat mesh of `rows` (m) behind a sharp edge on `side` of its panels, the exponents there, and that axis"""
    axis, far = {0: (1, False), 1: (0, True), 2: (1, True), 3: (0, False)}[side]
    across = np.append(0.0, np.cumsum(rows))
    across = across if not far else across[-1] - across[::-1]
    lines = [np.array([0.0, 1.0, 2.5])] * 2
    lines[axis] = across
    mesh = structured(np.stack([*np.meshgrid(*lines, indexing="ij"), np.zeros([len(a) for a in lines])], axis=-1))
    middles = (mesh.vertices + np.roll(mesh.vertices, -1, axis=1))[..., axis] / 2
    edge = across[-1] if far else 0.0
    return mesh, np.where(np.isclose(middles, edge), 2 / 3, 1.0), axis, edge


@pytest.mark.parametrize("side", range(4))
@pytest.mark.parametrize("rows", [(2.0,), (0.5, 1.0), (0.5, 1.0, 1.7), (0.5, 1.0, 1.7, 2.0)])
def test_flow_round_an_edge_is_integrated_exactly(side, rows):
    """∬ |∇ r^(2/3)|² = (4/3) breadth · depth^(1/3), from nodal values with their collocation error"""
    mesh, exponents, axis, edge = sharp_plate(rows, side)
    s, r = hull_quadrature(mesh, exponents), np.abs(elements(mesh).nodes[:, axis] - edge)
    order = np.unique(r.round(9), return_inverse=True)[1]
    lengths = np.array([[*rows, *[rows[-1]] * 2][:3]])
    errors = nodal_errors(lengths, lengths, np.array([2 / 3]))[0]
    phi = r ** (2 / 3) * (1 + np.append(errors, [0, 0])[order])
    depth = sum(rows[:2])  # of the rows on which φ is interpolated from the edge
    interpolated = np.abs(mesh.centroids[:, axis] - edge) < depth
    value, gradient = (np.einsum("n...a,na->n...", part, phi[s.nodes])[interpolated] for part in (s.shape, s.gradient))
    np.testing.assert_allclose(value, np.abs(s.points[interpolated, :, axis] - edge) ** (2 / 3), rtol=1e-9)
    np.testing.assert_allclose(np.delete(gradient, axis, axis=2), 0, atol=1e-9)
    np.testing.assert_allclose(s.weights.sum(), 2.5 * sum(rows))
    square = np.sum(s.weights[interpolated] * np.sum(gradient**2, axis=2))
    # exact next to the edge; Gauss with four points of r^(−2/3) on the row behind, 0.5 < r < 1.5, errs by 3e-6
    np.testing.assert_allclose(square, 4 / 3 * 2.5 * depth ** (1 / 3), rtol=1e-9 if len(rows) == 1 else 1e-5)


def test_the_collocation_error_at_an_edge_decays_away_from_it():
    """The solution without sources beside r^μ is r^(−μ): relative errors fall like r^(−2μ)"""
    for mu in (2 / 3, 0.8):
        for other in (1.0, 1.5):
            errors = nodal_errors(np.ones((1, 60)), np.full((1, 60), other), np.array([mu]))[0]
            assert errors[0] > 0.01
            slope = np.log(errors[40] / errors[8]) / np.log(40 / 8)
            assert abs(slope + 2 * mu) < 0.15, (mu, slope)


def test_coarser_panels_on_the_other_face_of_an_edge_have_larger_errors():
    near, mu = np.ones((3, 3)), np.full(3, 2 / 3)
    errors = nodal_errors(near, near * np.array([[0.5], [1.0], [2.0]]), mu)
    assert np.all(np.diff(errors[:, 0]) > 0.01)
    # below the scale of everything a gap is as good as none
    np.testing.assert_allclose(nodal_errors(near, near, mu, np.full(3, 1e6)), nodal_errors(near, near, mu), rtol=1e-3)


def test_flow_out_of_a_gap_is_that_of_the_edge_near_it_and_a_source_far_away():
    """What leaves the gap, height · ∂φ/∂r, goes through a quarter of a circle, (π/2) r ∂φ/∂r"""
    height = np.array([2.0])
    flow = EdgeFlow(np.array([2 / 3]), height)
    for part in (flow.above, flow.below):
        np.testing.assert_allclose(part(np.array([1e-5])), 1e-5 ** (2 / 3), rtol=1e-3)
    into = (flow.below(np.array([60.0])) - flow.below(np.array([50.0]))) / 10 * height
    r = np.array([1e4, 2e4])
    out = np.pi / 2 * np.diff(flow.above(r)) / np.log(2)
    np.testing.assert_allclose(into, out, rtol=1e-3)


def test_panels_in_a_row_from_an_edge_share_a_stencil_and_no_others():
    mesh, exponents, *_ = sharp_plate((0.5, 1.0, 1.7), 3)
    s, t = stencils(mesh, exponents)
    assert not np.any(t.at_edge) and np.all(t.count == 2)
    first, second, third = (np.flatnonzero(np.isclose(mesh.centroids[:, 0], x)) for x in (0.25, 1.0, 2.35))
    assert np.all(s.at_edge[first] & (s.own[first] == 0)) and np.all(s.at_edge[second] & (s.own[second] == 1))
    assert not np.any(s.at_edge[third])
    for a, b, c in zip(first, second, third, strict=True):
        assert s.panels[a].tolist() == s.panels[b].tolist() == [a, b, c]

    corners, sides = mesh.corners.copy(), exponents.copy()
    corners[second] = np.roll(corners[second], 1, axis=1)  # numbered from another corner
    renumbered, _ = stencils(PanelMesh(mesh.points, corners), sides)
    sides[:, 1] = np.where(np.isclose(mesh.centroids[:, 0], 2.35), 2 / 3, 1)  # a second edge opposite
    narrow, _ = stencils(mesh, sides)
    assert (
        np.all(renumbered.at_edge[first])
        and np.all(renumbered.count[first] == 1)
        and not np.any(renumbered.at_edge[second])
    )
    assert np.all(narrow.count == 2)


def polynomial(x):
    return 1 + x[..., 0] - 0.02 * x[..., 1] ** 3 + x[..., 0] ** 2 * x[..., 1] / 50 + x[..., 2] ** 3 * x[..., 1] / 90


@pytest.mark.parametrize("symmetry", ["", "x", "y", "xy"])
def test_polynomials_are_interpolated_exactly_across_mirror_planes(symmetry):
    """Polynomials of third degree, also where a panel has a neighbour on one side only"""
    mesh = box(*SIZES, counts=(6, 5, 5), symmetry=symmetry)
    flat = np.ones((len(mesh), 4))
    mirrors = np.column_stack([np.array(mesh.reflections()), np.ones(mesh.copies)])
    phi = polynomial(elements(mesh).nodes * mirrors[:, None])
    wet = np.isclose(mesh.vertices[:, :, 2], 0) & np.isclose(np.roll(mesh.vertices, -1, axis=1)[:, :, 2], 0)
    line = side_quadrature(mesh, flat, *np.nonzero(wet))
    np.testing.assert_allclose(mesh.copies * line.weights.sum(), 2 * (LENGTH + BEAM))
    for s in (hull_quadrature(mesh, flat), line):
        for image, mirror in enumerate(mirrors):
            interpolated = np.einsum("nqa,na->nq", s.shape, phi[image ^ s.images, s.nodes])
            np.testing.assert_allclose(interpolated, polynomial(s.points * mirror), atol=1e-7)


def test_a_product_stencil_is_there_where_the_rows_of_all_panels_cross():
    """Panels of a 3 × 3 grid in rows and columns; one that has another neighbour across ends it"""
    from types import SimpleNamespace

    from hakobune.bem.panels.pressure_drift.edges import _alike

    grid = np.arange(9).reshape(3, 3)
    rows = np.array([grid[i // 3] for i in range(9)])  # (9, 3) panels of the row of each
    columns = np.array([grid[:, i % 3] for i in range(9)])

    def alike(rows, columns, same=lambda panel: np.ones(9, bool)):
        return _alike(SimpleNamespace(panels=rows), SimpleNamespace(panels=columns, same_layout=same)).tolist()

    assert alike(rows, columns) == [True] * 9
    other = columns.copy()
    other[4] = [1, 4, 8]
    assert alike(rows, other) == [i // 3 != 1 for i in range(9)]  # those of its row look across it
    assert alike(rows, columns, lambda panel: panel != 2) == [i // 3 != 0 for i in range(9)]


def test_a_panel_with_a_sharp_side_knows_a_point_of_an_edge_of_the_box():
    """Its neighbours know the same edge, and no other panels"""
    mesh = box(*SIZES, counts=(7, 5, 4))
    exponents = sharp_sides(mesh)
    made = hull_quadrature(mesh, exponents)
    known, sharp = np.isfinite(made.edge).all(axis=1), (exponents < 1).any(axis=1)
    assert known[sharp].all() and sharp.sum() > 1 and not known.all()
    x, y, z = np.abs(made.edge[known]).T
    assert np.all(sum(np.isclose(a, b).astype(int) for a, b in ((x, 50), (y, 25), (z, 10))) >= 2)


@pytest.mark.parametrize("r, rho, gap", [(0.7, 1.3, 0.9), (2.0, 0.4, 0.5), (0.2, 0.3, 5.0)])
def test_kernels_over_a_gap_are_those_of_the_faces_and_their_images_in_the_bed(r, rho, gap):
    """∂ ln R/∂n of a source on the side above, or on the bottom beside it, and of its image; by differences"""

    def kernel(target, source, normal, h=1e-6):
        def value(at):
            image = np.array([at[0], -2 * gap - at[1]])
            return np.log(np.linalg.norm(target - at)) + np.log(np.linalg.norm(target - image))

        return (value(source + h * normal) - value(source - h * normal)) / (2 * h)

    flow = EdgeFlow(np.array(2 / 3), np.array(gap))
    up, under, source_up, source_under = (np.array(at) for at in ((0.0, r), (-r, 0.0), (0.0, rho), (-rho, 0.0)))
    out, down = np.array([1.0, 0.0]), np.array([0.0, -1.0])
    assert flow.onto_above(r, rho) == pytest.approx(kernel(up, source_under, down), rel=1e-6)
    assert flow.onto_below(r, rho) == pytest.approx(kernel(under, source_up, out), rel=1e-6)
    assert flow.bed(r, rho) == pytest.approx(-kernel(under, source_under, down), rel=1e-6)
    free = EdgeFlow(np.array(2 / 3), np.array(np.inf))
    assert free.onto_above(r, rho) == free.onto_below(r, rho) == pytest.approx(r / (r**2 + rho**2))
    assert free.bed(r, rho) == 0.0
    sharp = EdgeFlow(np.array(0.8), np.array(np.inf))  # faces 2π − π/0.8 = 135° apart
    gamma = 0.75 * np.pi
    apart = r**2 + rho**2 - 2 * r * rho * np.cos(gamma)
    assert sharp.onto_above(r, rho) == pytest.approx(r * np.sin(gamma) / apart)


@pytest.mark.parametrize("r", [1e-3, 0.3, 2.0, 40.0])
def test_flow_over_a_gap_is_that_of_its_conformal_map(r):
    """a ln(1 + q²), q − arctan q = πr/2s; 2a ln cosh u, u − tanh u = πr/2s; a = (2s/3π)^(2/3)"""
    from scipy.optimize import brentq

    s = 0.6
    a, part = (2 * s / (3 * np.pi)) ** (2 / 3), np.pi * r / (2 * s)
    q = brentq(lambda q: q - np.arctan(q) - part, 1e-6, part + 10, xtol=1e-14)
    u = brentq(lambda u: u - np.tanh(u) - part, 1e-6, part + 10, xtol=1e-14)
    flow = EdgeFlow(np.array(2 / 3), np.array(s))
    assert flow.above(np.array(r)) == pytest.approx(a * np.log(1 + q * q), rel=1e-9)
    assert flow.below(np.array(r)) == pytest.approx(
        2 * a * (np.log(np.cosh(u)) if u < 300 else u - np.log(2)), rel=1e-9
    )


def test_an_integral_over_panels_is_met_by_lines_between_their_nodes():
    """(1/π)∫ kernel φ over panels of 1 and 2 m: exact for φ linear on each, and what lines miss of another"""
    from hakobune.bem.panels.pressure_drift.edge_flow import _interpolated_integral, at_nodes

    lengths, at = np.array([[1.0, 2.0]]), np.array([0.4, 1.7]).reshape(1, 2, 1, 1)
    nodes = at_nodes(lengths)
    near, far = (1 - 1 / np.sqrt(3)) / 2, (1 + 1 / np.sqrt(3)) / 2
    assert nodes[0] == pytest.approx([near, far, 1 + 2 * near, 1 + 2 * far])
    kernel = lambda r, rho: r + rho**2  # noqa: E731
    line = lambda rho: 2.0 - 3.0 * rho  # noqa: E731
    matrix, missed = _interpolated_integral(kernel, at, line, nodes[:, :, None, None], lengths)
    for n, r in enumerate((0.4, 1.7)):
        exact = np.polynomial.Polynomial([2 * r, -3 * r, 2.0, -3.0]).integ()(3.0) / np.pi
        assert matrix[0, n] @ line(nodes[0]) == pytest.approx(exact) and missed[0, n] == pytest.approx(0.0, abs=1e-12)
    square = lambda rho: rho**2  # noqa: E731
    matrix, missed = _interpolated_integral(kernel, at, square, nodes[:, :, None, None], lengths)
    for n, r in enumerate((0.4, 1.7)):
        exact = np.polynomial.Polynomial([0, 0, r, 0, 1.0]).integ()(3.0) / np.pi
        assert missed[0, n] == pytest.approx(matrix[0, n] @ nodes[0] ** 2 - exact, rel=1e-9)


def test_a_kernel_that_is_infinite_at_the_edge_is_integrated_on_the_panel_beside_it():
    """∫ρ^(−1/3) dρ over 3 m, with nodes that gather at the edge and at no other side of a panel"""
    from hakobune.bem.panels.pressure_drift.edge_flow import _interpolated_integral, at_nodes

    lengths, at = np.array([[1.0, 2.0]]), np.ones((1, 1, 1, 1))
    one, nodes = (lambda rho: np.ones_like(rho)), at_nodes(lengths)[:, :, None, None]
    matrix, _ = _interpolated_integral(lambda r, rho: rho ** (-1 / 3), at, one, nodes, lengths)
    assert matrix[0, 0].sum() == pytest.approx(1.5 * 3 ** (2 / 3) / np.pi, rel=1e-12)
    matrix, _ = _interpolated_integral(lambda r, rho: rho**12, at, one, nodes, lengths)
    assert matrix[0, 0].sum() == pytest.approx(3.0**13 / 13 / np.pi, rel=1e-12)
    # on the second panel 16 nodes are exact up to degree 31, less 1 of the line; with nodes cubed up to 9
    matrix, _ = _interpolated_integral(lambda r, rho: np.where(rho > 1, (rho - 1) ** 30, 0.0), at, one, nodes, lengths)
    assert matrix[0, 0].sum() == pytest.approx(2.0**31 / 31 / np.pi, rel=1e-12)


@pytest.mark.parametrize("mu, gap", [(2 / 3, np.inf), (0.8, np.inf), (2 / 3, 0.7)])
def test_errors_at_the_nodes_of_both_faces_solve_what_their_lines_miss(mu, gap):
    """e = M e + (M φ − ∫K φ), M of lines between two nodes of each panel; panels of 1 and 2 m, and 0.8 and 1 m below"""
    from scipy.integrate import quad

    faces = np.array([1.0, 2.0]), np.array([0.8, 1.0])
    flow = EdgeFlow(np.array(mu), np.array(gap))
    place = (1 - 1 / np.sqrt(3)) / 2
    starts = [np.cumsum(face) - face for face in faces]
    nodes = [np.ravel([(s + place * L, s + (1 - place) * L) for s, L in zip(start, face, strict=True)])
             for start, face in zip(starts, faces, strict=True)]  # fmt: skip
    phi = flow.above, flow.below
    kernels = {(0, 1): flow.onto_above, (1, 0): flow.onto_below, (1, 1): flow.bed}
    M, exact = np.zeros((8, 8)), np.zeros(8)
    for (to, of), kernel in kernels.items():
        for i, r in enumerate(nodes[to]):
            for panel, (s, L) in enumerate(zip(starts[of], faces[of], strict=True)):
                one, two = nodes[of][2 * panel : 2 * panel + 2]
                given = {"epsabs": 1e-11, "limit": 200}
                K = lambda rho, r=r, kernel=kernel: float(kernel(r, rho)) / np.pi  # noqa: E731
                for n, (own, other) in enumerate(((one, two), (two, one))):
                    line = quad(lambda x, a=own, b=other, K=K: K(x) * (x - b) / (a - b), s, s + L, **given)[0]
                    M[4 * to + i, 4 * of + 2 * panel + n] += line
                exact[4 * to + i] += quad(lambda x, of=of, K=K: K(x) * float(phi[of](np.array(x))), s, s + L, **given)[
                    0
                ]
    missed = M @ np.concatenate([p(x) for p, x in zip(phi, nodes, strict=True)]) - exact
    error = np.linalg.solve(np.eye(8) - M, missed)[:4] / nodes[0] ** mu
    found = nodal_errors(faces[0][None], faces[1][None], np.array([mu]), np.array([gap]))[0]
    assert np.abs(error).max() > 1e-3 and found == pytest.approx(error, rel=1e-4, abs=1e-7)
