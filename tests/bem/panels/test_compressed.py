"""Compressed equations against full ones: the same answers, within what is said of the compression."""

from functools import cache

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.methods import panel_problem
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.compressed import equations, far_blocks
from hakobune.bem.panels.compressed.clusters import Clusters
from hakobune.bem.panels.compressed.one_frequency import CompressedRun
from hakobune.bem.panels.compressed.operator import Tree
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"}
HEADINGS = np.radians([0.0, 35.0])
BOX = box(100, 50, 10, panels=400)
SKEW = box(60, 30, 8, panels=300).whole().rotated(0.4).moved(3, 2, 0)
# the smallest gap slows the iteration, the shortest waves are shorter than the panels
BODIES = {
    "box": (BOX, 0.6, {"depth": 20.0, "lid": lid(BOX)}),
    "small gap": (BOX, 0.3, {"depth": 10.3}),
    "deep water": (BOX, 1.2, {"depth": np.inf, "lid": lid(BOX)}),
    "wall": (BOX, 0.5, {"depth": 20.0, "wall": -40.0}),
    "no mirror plane": (SKEW, 0.7, {"depth": 25.0, "lid": lid(SKEW)}),
    "no far blocks": (box(10, 10, 5, panels=20), 1.0, {"depth": 20.0}),
    "short waves": (BOX, 2.2, {"depth": 20.0, "lid": lid(BOX)}),
}


@cache
def both(name):
    """Runs by compressed and by full equations"""
    mesh, omega, options = BODIES[name]
    want = WANT - {"drift_force_fixed"} if "wall" in options else WANT
    prepared = prepare(PanelProblem(mesh, **options))
    return [kind(prepared, omega, HEADINGS, want, None, DOFS) for kind in (CompressedRun, PanelRun)]


@pytest.mark.parametrize("name", BODIES)
def test_compressed_equations_give_what_full_ones_give_within_what_is_said(name):
    found, full = both(name)
    assert found.residual < equations.RESIDUAL
    assert found.compression < 0.1 * equations.ALLOWED
    changes = found.radiation - full.radiation, found.excitation - full.excitation
    for change, bound in zip(changes, found.compression_errors, strict=True):
        assert np.all(np.abs(change) <= bound)
    for run, more in ((found, set()), (full, {"rankine", "table", "assemble"})):
        assert run.wall_time.keys() - {"far field"} == {"incident", "solve", *more}


@pytest.mark.parametrize("name", [name for name in BODIES if name != "wall"])
def test_drift_follows(name):
    found, full = (run.drift(False)[:, :2] for run in both(name))
    wave = 0.5 * 1025 * 9.80665 * 100  # N/m², total reflection over the length of the body
    assert np.abs(found - full).max() < both(name)[0].compression * wave


def test_estimated_errors_are_larger_by_the_compression():
    mesh, omega, options = BODIES["box"]
    coarse = box(100, 50, 10, panels=200)
    prepared = prepare(PanelProblem(mesh, coarse=(coarse, lid(coarse)), **options))
    found, full = (kind(prepared, omega, HEADINGS, WANT, None, DOFS) for kind in (CompressedRun, PanelRun))
    more = np.abs(found.errors[0]) - np.abs(full.errors[0])
    bound = found.compression_errors[0]
    assert np.all(np.abs(np.diag(more - bound)) < np.diag(bound))  # the rest is what compression changes of both meshes


@pytest.mark.parametrize("which", ["zero", "infinity"])
@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_limits_of_the_frequency_are_those_of_full_equations(which, depth, monkeypatch):
    prepared = prepare(PanelProblem(BOX, depth=depth))
    full = prepared.added_mass_limit(which)
    monkeypatch.setattr(panel_problem, "WORTH_COMPRESSING", 100)
    assert prepared.compressed
    found, finite = prepared.added_mass_limit(which), np.isfinite(full)
    assert np.array_equal(finite, np.isfinite(found))
    size = np.sqrt(np.abs(np.diag(np.where(finite, full, 1.0))))
    change = np.where(finite, found, 0.0) - np.where(finite, full, 0.0)
    assert np.abs(change / np.outer(size, size)).max() < 1e-4


def test_many_nodes_are_compressed_few_are_not(monkeypatch):
    prepared = prepare(PanelProblem(BOX, depth=20.0))
    assert type(prepared.run(0.5, [0.0], WANT, None, DOFS)) is PanelRun
    monkeypatch.setattr(panel_problem, "WORTH_COMPRESSING", 300)
    assert type(prepared.run(0.5, [0.0], WANT, None, DOFS)) is CompressedRun


def test_blocks_cover_every_pair_once():
    geometry = prepare(PanelProblem(SKEW, lid(SKEW), depth=25.0)).geometry
    tree, panels = Tree(geometry), len(geometry.panels)
    seen = np.zeros((panels, panels), int)
    for t, s, _ in np.concatenate([tree.far, tree.near]):
        c = tree.clusters
        seen[c.first[t] : c.end[t], c.first[s] : c.end[s]] += 1
    assert np.all(seen == 1) and len(tree.far)
    assert np.array_equal(np.sort(tree.nodes), np.arange(len(geometry.elements.nodes)))


def test_blocks_grow_like_n_log_n():
    """Entries of near blocks, and rows and columns of far ones, of a box four times as long and wide each time"""
    per_panel = []
    for panels in (1250, 5000, 20_000):
        mesh = box(1000, 200, 10, panels=panels)
        c = Clusters.of(mesh.flat_vertices, mesh.normals, mesh.sizes, len(mesh))
        far, near = c.pairs(np.array(mesh.reflections(), float))
        count = c.end - c.first
        entries = 16 * (count[near[:, 0]] * count[near[:, 1]]).sum() + 32 * (count[far[:, 0]] + count[far[:, 1]]).sum()
        per_panel.append(entries / len(mesh))
    # each quadrupling adds about the same to a panel's share, where n² would multiply it by four
    steps = np.diff(per_panel)
    assert np.all(steps < 0.6 * per_panel[0]) and steps[1] < 1.5 * steps[0]


def test_an_iteration_that_does_not_end_is_an_error(monkeypatch):
    monkeypatch.setattr(equations, "ITERATIONS", 2)
    monkeypatch.setattr(equations, "RESIDUAL", 1e-14)
    prepared = prepare(PanelProblem(BOX, depth=20.0))
    with pytest.raises(FloatingPointError, match=r"is left after 2 iterations; allowed: 1e-13"):
        _ = CompressedRun(prepared, 0.5, HEADINGS, WANT, None, DOFS).potentials


def test_a_compression_that_is_too_far_off_is_an_error(monkeypatch):
    monkeypatch.setattr(equations, "ALLOWED", 1e-9)
    prepared = prepare(PanelProblem(BOX, depth=20.0))
    with pytest.raises(
        FloatingPointError,
        match=r"compressed equations have an error of [0-9.]+e-0[0-9]; allowed: "
        r"1e-09",
    ):
        _ = CompressedRun(prepared, 0.5, HEADINGS, WANT, None, DOFS).potentials


def test_blocks_larger_than_the_buffers_are_made_as_in_large_ones(monkeypatch):
    monkeypatch.setattr(far_blocks, "CAPACITY", 1)
    monkeypatch.setattr(far_blocks, "ROOM", 1)
    mesh, omega, options = BODIES["box"]
    found = CompressedRun(prepare(PanelProblem(mesh, **options)), omega, HEADINGS, WANT, None, DOFS)
    assert np.array_equal(found.radiation, both("box")[0].radiation)


def test_columns_of_nodes_that_are_represented_already_do_not_end_a_block():
    """On this wall three rows, two of them chosen at random, had nothing left where others had a third of all"""
    prepared = prepare(PanelProblem(box(1000, 200, 10, panels=2000), depth=20.0))
    assert CompressedRun(prepared, 0.6, HEADINGS[:1], {"added_mass"}, None, DOFS).compression < 1e-4 * 1.01
