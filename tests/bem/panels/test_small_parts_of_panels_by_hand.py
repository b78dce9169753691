"""Lids, plates and directions by hand: from where a lid is needed, what counts as flat, how many standing waves."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels import irregular_frequencies as irregular
from hakobune.bem.panels import zero_draft
from hakobune.bem.panels.elements import elements
from hakobune.bem.panels.irregular_frequencies import extent, lid_needed_from, lowest_irregular, rectangle_around
from hakobune.bem.panels.standing_waves import directions
from hakobune.bem.panels.zero_draft import ZeroDraftRun, bottom, flattened
from hakobune.meshing.panels import PanelMesh, assembled
from hakobune.meshing.shapes import box

RNG = np.random.default_rng(12)


def test_directions_are_those_within_which_bessel_functions_die():
    """(x + 10 ∛x + 12)/4, rounded up"""
    for phase in (0.0, 1.0, 8.0, 64.0, 300.0):
        assert directions(phase) == int(np.ceil((phase + 10 * np.cbrt(phase) + 12) / 4))
    assert (directions(0.0), directions(1.0), directions(8.0)) == (3, 6, 10)


def test_a_lid_is_needed_from_six_tenths_of_the_lowest_irregular_frequency():
    """κ / tanh κd, κ = π √(1/L² + 1/B²); of walls that end on the bed κ tanh κd; of several bodies the lowest"""
    kappa = np.pi * np.hypot(1 / 30.0, 1 / 10.0)
    assert lowest_irregular(30.0, 10.0, 4.0) == pytest.approx(kappa / np.tanh(4 * kappa))
    assert lowest_irregular(30.0, 10.0, 4.0, False) == pytest.approx(kappa * np.tanh(4 * kappa))
    mesh = box(30.0, 10.0, 4.0, panels=60)
    assert lid_needed_from(mesh) == pytest.approx(0.6 * kappa / np.tanh(4 * kappa))
    open_below = SimpleNamespace(points=mesh.points, reflections=mesh.reflections, draft=4.0, foot="there", body=None)
    assert lid_needed_from(open_below) == pytest.approx(0.6 * kappa * np.tanh(4 * kappa))
    whole = [box(30.0, 10.0, 4.0, panels=60).whole(), box(12.0, 8.0, 3.0, panels=60).whole().moved(0, 40, 0)]
    both = assembled(whole)
    assert lid_needed_from(both) == pytest.approx(min(map(lid_needed_from, whole)))
    assert irregular.SHARE == 0.6


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.4])
def test_the_rectangle_around_a_plan_turns_with_it(angle):
    mesh = box(30.0, 10.0, 4.0, panels=60).whole().rotated(angle)
    assert sorted(rectangle_around(mesh)) == pytest.approx([10.0, 30.0])
    c, s = abs(np.cos(angle)), abs(np.sin(angle))
    assert extent(mesh) == pytest.approx([30 * c + 10 * s, 30 * s + 10 * c])


def test_of_all_rectangles_around_a_plan_it_is_that_of_the_shortest_waves():
    """A triangle of 3, 4 and 5 m: 3 × 4 against 5 × 2.4 m, whose hypot(1/L, 1/B) is larger"""
    points = np.array([[0, 0, 0], [4, 0, 0], [0, 3, 0], [0, 0, -1], [4, 0, -1], [0, 3, -1]], float)
    mesh = SimpleNamespace(points=points, reflections=lambda: [(1, 1)], symmetry="")
    assert sorted(rectangle_around(mesh)) == pytest.approx([2.4, 5.0])
    assert np.hypot(1 / 2.4, 1 / 5) > np.hypot(1 / 3, 1 / 4)
    moved = SimpleNamespace(points=points - [1, 1, 0], symmetry="y", reflections=None)
    assert extent(moved) == pytest.approx([4.0, 4.0])  # to 2 m on one side of the plane, and so on the other


@pytest.mark.parametrize("rise, flat", [(0.9e-6, True), (1.1e-6, False)])
def test_a_bottom_is_flat_where_all_its_corners_are_a_millionth_of_the_draft_from_the_deepest(rise, flat):
    mesh = box(8.0, 4.0, 2.0, counts=(2, 2, 1), symmetry="")
    points = mesh.points.copy()
    corner = np.flatnonzero(np.all(np.isclose(points, [4.0, 2.0, -2.0]), axis=1))
    points[corner, 2] += 2.0 * rise
    other = PanelMesh(points, mesh.corners, "")
    chosen = bottom(other)
    assert chosen.sum() == 16 - (not flat) and np.all(other.normals[chosen, 2] < 0)


@pytest.mark.parametrize("share, vertical", [(0.8e-6, True), (1.3e-6, False), (-1.3e-6, False)])
def test_sides_are_vertical_where_bottom_and_waterplane_are_equal_to_a_millionth(share, vertical):
    mesh = box(8.0, 4.0, 2.0, counts=(2, 2, 1), symmetry="")
    points = mesh.points.copy()
    points[points[:, 2] < -1, 0] *= 1 + share
    tapered = PanelMesh(points, mesh.corners, "")
    if vertical:
        plate = flattened(tapered)
        assert len(plate) == 16 and not plate.points[:, 2].any() and plate.areas.sum() == pytest.approx(32.0)
        assert np.all(plate.normals[:, 2] == pytest.approx(-1.0))
    else:
        with pytest.raises(ValueError, match=r"the bottom has 32 m², and the waterplane 32 m²"):
            flattened(tapered)


def test_on_a_plate_the_potential_is_what_its_velocity_leaves_of_the_density():
    """Kφ = −V − x, K = ω²/g; pressures are those of the plate, and none on sides without height"""
    run = object.__new__(ZeroDraftRun)
    run.omega, run.problem = 0.9, SimpleNamespace(gravity=9.81)
    x, V = RNG.normal(size=(4, 2)), RNG.normal(size=(2, 4))
    assert run.on_hull(x, V) == pytest.approx((-V - x.T) * 9.81 / 0.81)


def test_pressures_of_a_plate_are_on_the_bottom_of_the_hull(monkeypatch):
    mesh = box(8.0, 4.0, 2.0, counts=(1, 1, 1))
    plate = bottom(mesh)
    found = RNG.normal(size=(2, 4 * plate.sum()))
    monkeypatch.setattr(zero_draft.PanelRun, "pressure", lambda self: found.copy())
    run = object.__new__(ZeroDraftRun)
    run.headings, run.geometry, run.problem = [0.1, 0.2], SimpleNamespace(copies=4), SimpleNamespace(mesh=mesh)
    pressure = run.pressure().reshape(2, 4, len(mesh))
    assert pressure[..., plate] == pytest.approx(found.reshape(2, 4, -1)) and not pressure[..., ~plate].any()


def test_equations_of_a_plate_are_those_of_a_lid_with_its_own_sides(monkeypatch):
    """No panel counts as hull; −4πV of each class, zeros where another has more columns"""
    asked = []

    class Found(SimpleNamespace):
        def _replace(self, sides):
            return Found(**(vars(self) | {"sides": sides}))

    monkeypatch.setattr(zero_draft, "assembled", lambda *them, hull: asked.append((*them, hull)) or Found(sides=None))
    run = object.__new__(ZeroDraftRun)
    run.geometry, run.k, run.problem = SimpleNamespace(hull=3), 0.1, SimpleNamespace(depth=9.0)
    velocities = [RNG.normal(size=(2, 3)) + 1j, RNG.normal(size=(1, 3))]
    sides = run.equations(["even", "odd"], "table", velocities).sides
    g, classes, mirror, table, _, nothing, hull = asked[0]
    assert (g, classes, mirror, table, hull) == (run.geometry, ["even", "odd"], 1.0, "table", 0)
    assert [part.shape for part in nothing] == [(1, 0)] * 2
    assert sides[0] == pytest.approx(-4 * np.pi * velocities[0].T)
    assert sides[1][:, :1] == pytest.approx(-4 * np.pi * velocities[1].T) and not sides[1][:, 1].any()


def test_a_rigid_surface_doubles_the_sources_of_a_plate(monkeypatch):
    """4πφ = ∬ w G dS: the sides of the equations over 4π, class by class"""
    sides = np.array([RNG.normal(size=(3, 2)), RNG.normal(size=(3, 2))]) + 1j
    given, found = [], []
    monkeypatch.setattr(zero_draft, "limit_table", lambda *them: them)
    monkeypatch.setattr(zero_draft, "assembled", lambda *them: given.append(them) or SimpleNamespace(sides=sides))
    monkeypatch.setattr(zero_draft, "added_mass_of", lambda *them: found.append(them) or "limit")
    members = {"even": [2, 4], "odd": [3]}
    modes = RNG.normal(size=(3, 6))
    g = SimpleNamespace(reach=9.0, draft=0.0, classes=("even", "odd"), members=members.get, modes=modes,
                        elements=SimpleNamespace(nodes=range(3)))  # fmt: skip
    prepared = SimpleNamespace(geometry=g, problem=SimpleNamespace(depth=7.0))
    assert zero_draft.rigid_surface_limit(prepared, "zero") == "limit"
    _, classes, mirror, table, _, velocities = given[0]
    assert (classes, mirror, table) == (("even", "odd"), 1.0, ("zero", 7.0, 9.0, 0.0))
    for own, cls in zip(velocities, members, strict=True):
        assert own == pytest.approx(modes[:, members[cls]].T)
    (same, potentials, which) = found[0]
    assert same is prepared and which == "zero"
    assert potentials[0] == pytest.approx(sides[0].real.T / (4 * np.pi))
    assert potentials[1] == pytest.approx(sides[1].real[:, :1].T / (4 * np.pi))
    with pytest.raises(ValueError, match="no added mass at infinite frequency"):
        zero_draft.rigid_surface_limit(prepared, "infinity")


def test_elements_of_one_node_stand_for_their_panel():
    mesh = box(8.0, 4.0, 2.0, counts=(1, 1, 1))
    one, four = elements(mesh, 1), elements(mesh, 4)
    assert len(one.nodes) == len(mesh) and len(four.nodes) == 4 * len(mesh)
    assert one.nodes == pytest.approx(mesh.centroids) and one.weights == pytest.approx(mesh.areas)
    assert four.weights.reshape(-1, 4).sum(axis=1) == pytest.approx(mesh.areas)
    middle = np.einsum("pn,pnd->pd", four.weights.reshape(-1, 4), four.nodes.reshape(-1, 4, 3))
    assert middle == pytest.approx(mesh.centroids * mesh.areas[:, None])
    assert np.repeat(mesh.normals, 4, axis=0) == pytest.approx(four.normals) and one.sizes == pytest.approx(mesh.sizes)
