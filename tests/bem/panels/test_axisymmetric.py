"""Axisymmetric bodies: recognised, and solved by harmonics as by symmetry classes."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.axisymmetric_frequency import AxisymmetricRun
from hakobune.bem.panels.influence import Geometry
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.meshing.lid import lid, polar_lid
from hakobune.meshing.panels import PanelMesh, structured
from hakobune.meshing.shapes import box, buoy

HEADINGS = np.radians([0.0, 25.0, 250.0])
WANT = {
    *("added_mass", "radiation_damping", "excitation_force", "diffraction_force", "Froude_Krylov_force"),
    *("drift_force_fixed", "kochin_radiation", "kochin_diffraction", "pressure"),
}
CLOSE = 1e-8  # of the largest: ∂G/∂n is tabulated, and at R = 0 its direction depends on rounding of R


def revolved(profile, count, symmetry=""):
    """The hull that a profile (k, 2) of R and z, from the axis up, makes with `count` sides"""
    angle = 2 * np.pi / count * np.arange(count + 1)
    R, z = np.transpose(profile)
    points = np.stack(
        [np.outer(np.cos(angle), R), np.outer(np.sin(angle), R), np.broadcast_to(z, (count + 1, len(z)))], axis=-1
    )
    points[-1] = points[0]
    return structured(points[:, ::-1])


SPAR = revolved([(0, -12), (3, -12), (6, -12), (6, -11), (3, -11), (3, -8), (3, -4), (3, -1), (3, 0)], 14)


def both(problem, omega, want=WANT, dofs=DOFS):
    """Results of the harmonics and of the symmetry classes"""
    body = prepare(problem)
    runs = [kind(body, omega, HEADINGS, want, None, dofs) for kind in (AxisymmetricRun, PanelRun)]
    assert type(body.run(omega, HEADINGS, want, None, dofs)) is AxisymmetricRun
    return [run.result() for run in runs]


def assert_equal(found, other):
    assert set(found) == set(other)
    for name in set(found) - {"checks", "wall_time"}:
        scale = np.nanmax(np.abs(other[name]))
        assert np.array_equal(np.isnan(found[name]), np.isnan(other[name]))
        assert np.nanmax(np.abs(found[name] - other[name])) < CLOSE * scale, name
    assert found["checks"]["residual"] < 1e-12
    stages = {"incident", "rankine", "table", "assemble", "solve", "far field"}
    assert found["wall_time"].keys() >= stages and min(found["wall_time"].values()) > 0


@pytest.mark.parametrize("symmetry", ["xy", "x", "y", ""])
@pytest.mark.parametrize("covered", [False, True], ids=["open", "lid"])
def test_harmonics_give_what_symmetry_classes_give(symmetry, covered):
    mesh = buoy(10, 8, panels=112, symmetry=symmetry)
    problem = PanelProblem(
        mesh, polar_lid(mesh, 2.5) if covered else None, depth=20.0, rotation_center=(1.0, -2.0, -3.0)
    )
    omega = 2.2 if covered else 0.9  # the lid is used from its irregular frequencies on
    assert (
        problem.prepared().geometry.at(omega**2 / 9.80665).hull < len(problem.prepared().geometry.elements.nodes)
    ) == (covered)
    assert_equal(*both(problem, omega))


@pytest.mark.parametrize("depth", [13.0, np.inf])
def test_a_spar_off_the_origin_with_fourteen_sides(depth):
    assert_equal(*both(PanelProblem(SPAR.moved(7.0, -4.0), depth=depth), 0.8))


@pytest.mark.parametrize("dofs", [["Heave"], ["Surge", "Pitch"], DOFS])
def test_forces_need_the_harmonics_of_the_modes_alone(dofs, monkeypatch):
    from hakobune.bem.panels import axisymmetric

    seen, solve = [], axisymmetric._harmonic_matrices
    monkeypatch.setattr(
        axisymmetric, "_harmonic_matrices", lambda g, rows, m: seen.append(m.tolist()) or solve(g, rows, m)
    )
    mesh = buoy(10, 8, panels=240)
    want = {"added_mass", "radiation_damping", "excitation_force", "diffraction_force"}
    found, other = both(PanelProblem(mesh, depth=20.0), 1.2, want, dofs)
    assert_equal(found, other)
    assert all(set(m) <= {0, 1} for m in seen) and ({0} if dofs == ["Heave"] else set()) <= set(seen[0])


def test_potentials_are_whole_even_where_forces_were_asked_for():
    body = prepare(PanelProblem(buoy(10, 8, panels=240), depth=20.0))
    forces = AxisymmetricRun(body, 1.2, HEADINGS, {"excitation_force"}, None, DOFS)
    whole = PanelRun(body, 1.2, HEADINGS, {"excitation_force"}, None, DOFS)
    _ = forces.excitation
    for cls, phi in whole.potentials.items():
        assert np.abs(forces.potentials[cls] - phi).max() < CLOSE * np.abs(phi).max()


@pytest.mark.parametrize("symmetry", ["xy", ""])
@pytest.mark.parametrize("depth", [20.0, np.inf])
@pytest.mark.parametrize("which", ["zero", "infinity"])
def test_limits_of_the_frequency(symmetry, depth, which, monkeypatch):
    problem = PanelProblem(buoy(10, 8, panels=112, symmetry=symmetry), depth=depth)
    found = problem.prepared().added_mass_limit(which)
    monkeypatch.setattr(Geometry, "sectors", None)
    other = problem.prepared().added_mass_limit(which)
    finite = np.isfinite(other)
    assert np.array_equal(found[~finite], other[~finite])
    assert np.abs(found[finite] - other[finite]).max() < CLOSE * np.abs(other[finite]).max()


@pytest.mark.parametrize("panels, sides", [(112, 12), (240, 20), (476, 28), (1000, 40)])
@pytest.mark.parametrize("symmetry", ["xy", "x", "y", ""])
def test_every_side_of_a_buoy_is_a_sector(panels, sides, symmetry):
    mesh = buoy(10, 10, panels=panels, symmetry=symmetry)
    g = Geometry(mesh, polar_lid(mesh, 3.0), 30.0)
    assert len(g.sectors.node) == sides
    whole = np.concatenate([np.append(s, 1) * g.elements.nodes for s in g.images]).reshape(len(g.images), -1, 3)
    rotated = whole[g.sectors.image, g.sectors.node] @ [1, 1j, 0]
    assert rotated == pytest.approx(rotated[0] * np.exp(2j * np.pi * np.arange(sides) / sides)[:, None], abs=1e-6)
    assert sorted((g.sectors.image * len(g.elements.nodes) + g.sectors.node).ravel()) == list(range(whole[..., 0].size))
    # with a mirror plane half of a sector is enough
    assert len(g.sectors.first) * (2 if symmetry else 1) == g.sectors.node.shape[1]


def moved_corner():
    points = buoy(10, 10, panels=112, symmetry="").points.copy()
    points[np.argmax(points[:, 0])] *= 1.001
    return points


@pytest.mark.parametrize(
    "mesh, wall",
    [
        (box(100, 50, 10, panels=240), None),
        (box(50, 50, 10, panels=240), None),
        (box(100, 50, 10, panels=104, symmetry=""), None),
        (PanelMesh(moved_corner(), buoy(10, 10, panels=112, symmetry="").corners), None),
        (buoy(10, 10, panels=112).moved(dy=15.0), -5.0),
    ],
    ids=["box", "square", "whole box", "a corner moved by a centimetre", "beside a wall"],
)
def test_other_bodies_have_no_sectors(mesh, wall):
    assert Geometry(mesh, None, 30.0, wall=wall).sectors is None


def test_a_lid_that_is_not_axisymmetric_is_replaced_by_one_that_is():
    mesh = buoy(10, 10, panels=476)
    body = prepare(PanelProblem(mesh, lid(mesh), depth=30.0))
    assert body.geometry.sectors is None and len(body.axisymmetric_geometry.sectors.node) == 28
    omega, want = 2.2, {"added_mass", "radiation_damping", "excitation_force"}
    run = body.run(omega, HEADINGS, want, None, DOFS)
    assert type(run) is AxisymmetricRun and len(run.geometry.elements.nodes) > run.geometry.hull
    found, other = run.result(), PanelRun(body, omega, HEADINGS, want, None, DOFS).result()
    # lids of panels a ninth of a wave wide; of a quarter they let through 0.4 % (`pipelines.solve.hull.make_lid`)
    for name in want:
        assert np.abs(found[name] - other[name]).max() < 2e-3 * np.abs(other[name]).max()


def test_harmonics_are_the_same_bits_with_any_number_of_threads(monkeypatch):
    from hakobune.bem.kernels import threads

    body, found = prepare(PanelProblem(buoy(10, 8, panels=476), depth=20.0)), []
    for count in (1, 3):
        monkeypatch.setattr(threads, "thread_count", lambda count=count: count)
        run = AxisymmetricRun(body, 1.2, HEADINGS, {"drift_force_fixed"}, None, DOFS)
        found.append([phi.tobytes() for phi in run.potentials.values()])
    assert found[0] == found[1]
