"""From a scene to panels, with the meshing replaced: which mesh is made for what, how many panels, and refusals."""

import math
from types import SimpleNamespace

import pytest

from hakobune.meshing.shapes import TooFewPanels
from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.solve import hull


class Mesh(SimpleNamespace):
    """A mesh by its name"""

    total, symmetry = 400, "xy"


def box(name="a", length=40.0, beam=10.0, draft=5.0, **more):
    return SimpleNamespace(**{"name": name, "shape": "box", "length": length, "beam": beam, "draft": draft,
                              "fixed": False, "file": ""} | more)  # fmt: skip


def scene(*bodies, **more):
    several = len(bodies) > 1
    known = {"bodies": bodies, "body": bodies[0], "several": several, "panels": None, "accuracy": 0.02,
             "shortest_wave": 47.0, "water": SimpleNamespace(depth=20.0, gravity=9.8)}  # fmt: skip
    return SimpleNamespace(**known | more)


@pytest.fixture
def house(monkeypatch):
    asked = []

    def meshed(body, counts, bottom=True, panels=None):
        asked.append((body.name, counts, bottom, panels))
        if panels is not None and panels < 4 * len(body.name) + 4:
            raise TooFewPanels(panels, 4 * len(body.name) + 4)
        return Mesh(of=body.name)

    monkeypatch.setattr(hull, "meshed", meshed)
    monkeypatch.setattr(hull, "stands_on_bed", lambda scene, body: body.name == "pier")
    monkeypatch.setattr(hull, "arranged", lambda scene, hulls: ("arranged", *hulls))
    monkeypatch.setattr(hull, "damping_lids_of", lambda scene, mesh: ("lids", mesh))
    monkeypatch.setattr(hull, "with_planes_of", lambda mesh, lids: ("planes", mesh, lids))
    monkeypatch.setattr(hull, "own_hulls_of_modes", lambda scene, mesh: ("hulls of", mesh))
    monkeypatch.setattr(hull, "with_planes_of_modes", lambda scene, mesh, hulls: ("modes", mesh, hulls))
    return asked


def in_place(mesh):
    planes = ("planes", mesh, ("lids", mesh))
    return "modes", planes, ("hulls of", planes)


def test_hulls_of_several_are_arranged_and_have_the_planes_of_their_lids_and_shapes(house):
    assert hull._in_place(scene(box()), ["one"]) == in_place("one")
    assert hull._in_place(scene(box(), box("b")), ["one", "two"]) == in_place(("arranged", "one", "two"))


def test_a_hull_that_is_only_drawn_has_five_hundred_panels_and_no_bottom_on_the_bed(house, monkeypatch):
    one = hull._for_show(scene(box()))
    assert (one.mesh.of, one.lid, one.findings) == ("a", None, ()) and house == [("a", None, True, 500)]
    monkeypatch.setattr(hull, "check_apart", lambda scene, mesh, panels_matter: ("apart", len(mesh), panels_matter))
    two = hull._for_show(scene(box(), box("pier")))
    assert two.mesh[0] == "arranged" and [part.of for part in two.mesh[1:]] == ["a", "pier"]
    assert two.findings == ("apart", 3, False) and house[1:] == [("a", None, True, 500), ("pier", None, False, 500)]


def test_each_of_several_bodies_has_its_share_of_the_panels_by_its_wetted_area(house):
    """40 · 10 + 100 · 5 = 900 m², and half of it with half of each; a pier has no bottom: 500 m²"""
    both = scene(box(), box("b", 20.0, 5.0, 7.0), panels=300)
    assert hull._wetted_area(both, both.bodies[0]) == 900.0 and hull._wetted_area(both, both.bodies[1]) == 450.0
    hull._hull(both, both.bodies[0])
    hull._hull(both, both.bodies[1])
    assert [given[3] for given in house] == [200, 100]
    alone = scene(box("pier"), panels=300)
    assert hull._wetted_area(alone, alone.body) == 500.0 and hull._hull(alone, alone.body).of == "pier"
    assert house[2] == ("pier", None, False, 300)
    buoy = SimpleNamespace(name="buoy", shape="buoy", radius=3.0, draft=4.0)
    assert hull._wetted_area(alone, buoy) == pytest.approx(math.pi * (9 + 24))
    buoy.name = "pier"
    assert hull._wetted_area(alone, buoy) == pytest.approx(math.pi * 24)


def test_too_few_panels_are_refused_with_the_least_that_leaves_each_body_enough(house):
    """8 panels of a third are ⌈7.5 · 3⌉ = 23 in all, 12 of two thirds ⌈11.5 · 1.5⌉ = 18"""
    both = scene(box("ab"), box("b", 20.0, 5.0, 7.0), panels=9)
    with pytest.raises(SceneError, match=r"panels is 9; allowed: 23 to 100000"):
        hull._hull(both, both.bodies[0])
    with pytest.raises(SceneError, match=r"panels is 7; allowed: 8 to 100000"):
        hull._hull(scene(box(), panels=7), box())
    assert hull._hull(scene(box(), panels=8), box()).of == "a"


@pytest.fixture
def from_file(monkeypatch):
    def call(total, stands=False, fixed=False):
        monkeypatch.setattr(hull, "read_mesh", lambda file: Mesh(of=file, total=total))
        monkeypatch.setattr(hull, "stands", lambda mesh, depth: stands and depth == 20.0)
        monkeypatch.setattr(hull, "folded", lambda mesh: ("folded", mesh.of))
        body = box(shape="mesh", file="h.gdf", fixed=fixed)
        return hull._hull(scene(body), body)

    return call


def test_a_mesh_of_a_file_is_folded_within_its_limits(from_file):
    assert from_file(100_000) == from_file(1, stands=True, fixed=True) == ("folded", "h.gdf")
    with pytest.raises(SceneError, match=r"h\.gdf has 100001 panels; allowed: up to 100000"):
        from_file(100_001)
    with pytest.raises(
        SceneError, match=r"h.gdf stands on the bed, z = -20 m, without a bottom, and cannot float; give"
    ):
        from_file(1, stands=True)


def test_a_mesh_is_made_again_with_other_counts_unless_it_came_from_a_file_or_cannot_be(house):
    def counts(body, mesh):
        return None if mesh == "coarse" else (body.name, mesh)

    assert hull._remeshed(scene(box()), "fine", counts) == in_place(Mesh(of="a"))
    assert house == [("a", ("a", "fine"), True, None)]
    assert hull._remeshed(scene(box()), "coarse", counts) is None
    assert hull._remeshed(scene(box(shape="mesh")), "fine", counts) is None


def test_every_body_of_several_is_made_again_with_its_own_counts(house, monkeypatch):
    monkeypatch.setattr(hull, "own_hulls", lambda scene, mesh: [f"first {mesh}", f"second {mesh}"])
    made = hull._remeshed(scene(box(), box("pier")), "mesh", lambda body, mesh: (body.name, mesh))
    assert made == in_place(("arranged", Mesh(of="a"), Mesh(of="pier")))
    assert house == [("a", ("a", "first mesh"), True, None), ("pier", ("pier", "second mesh"), False, None)]
    half = {"a": 1, "pier": None}
    assert hull._remeshed(scene(box(), box("pier")), "mesh", lambda body, mesh: half[body.name]) is None
    assert hull._remeshed(scene(box(), box("b", shape="mesh")), "mesh", lambda body, mesh: 1) is None


def test_a_coarse_mesh_has_a_lid_in_proportion_and_as_many_panels_as_are_asked_for_at_least(monkeypatch):
    asked = []

    def remeshed(scene, mesh, counts):
        asked.append((counts.func, counts.keywords))
        return None if mesh == "given" else ("half", mesh)

    monkeypatch.setattr(hull, "_remeshed", remeshed)
    monkeypatch.setattr(hull, "lid_in_proportion", lambda *given: ("lid", *given))
    assert hull.coarse_hull("scene", "mesh", "cover", 3) == (
        ("half", "mesh"),
        ("lid", "cover", "mesh", ("half", "mesh")),
    )
    assert hull.coarse_hull("scene", "given", "cover") is None
    assert asked == [(hull.coarse_counts, {"fewest": 3}), (hull.coarse_counts, {"fewest": hull.FEWEST})]


def test_the_coarse_mesh_of_a_database_is_that_of_its_scene(monkeypatch):
    monkeypatch.setattr(hull, "typed", lambda raw, kind, error: (raw, kind, error))
    monkeypatch.setattr(hull, "coarse_hull", lambda *given: given)
    header = SimpleNamespace(scene="depth = 3.0", mesh="mesh")
    scene_of = ({"depth": 3.0}, hull.Scene, SceneError)
    assert hull.coarse_hull_of(header, 4, "cover") == (scene_of, "mesh", "cover", 4)
    header.scene = ""
    assert hull.coarse_hull_of(header, 4, "cover") is None


@pytest.mark.parametrize("total, kept", [(5000, True), (5001, False)])
def test_a_finer_mesh_of_single_frequencies_has_five_thousand_panels_at_most(monkeypatch, total, kept):
    finer = Mesh(total=total)
    monkeypatch.setattr(hull, "_remeshed", lambda scene, mesh, counts: finer if counts is hull.finer_counts else None)
    monkeypatch.setattr(hull, "lid_in_proportion", lambda *given: given)
    monkeypatch.setattr(hull, "shared_band", lambda *given: given)
    of = SimpleNamespace(omegas=lambda: [0.5], panels=None, bodies=[box(), box("b")])
    made = hull.finer_hull(of)
    assert made("mesh", "cover") == ((finer, ("cover", "mesh", finer)) if kept else None)
    assert made.omegas == [0.5] and made.band("mesh", "lid", [1.0]) == (of, "mesh", "lid", [1.0])
    of.bodies = [box(), box("b", shape="mesh")]
    assert hull.finer_hull(of) is None
    of.bodies, of.panels = [box()], 300
    assert hull.finer_hull(of) is None


@pytest.mark.parametrize("matter, found", [(True, ("usable", "on lid")), (False, ())])
def test_the_hull_of_a_database_is_judged_for_the_waves_of_a_scene(monkeypatch, matter, found):
    checked = []
    monkeypatch.setattr(hull, "panels_matter", lambda scene: matter)
    monkeypatch.setattr(hull, "_check_waves_along", checked.append)
    monkeypatch.setattr(hull, "_usable", lambda scene, mesh: ("usable",) if (scene, mesh) == ("s", "m") else None)
    monkeypatch.setattr(hull, "lid_findings", lambda mesh, lid: ("on lid",) if (mesh, lid) == ("m", "l") else None)
    monkeypatch.setattr(hull, "_without_errors", lambda scene, found: found)
    made = hull.stored_hull("s", SimpleNamespace(mesh="m", lid="l"))
    assert (made.mesh, made.lid, made.findings) == ("m", "l", found) and checked == ([] if matter else ["s"])


def test_a_hull_is_made_of_its_bodies_its_lid_and_what_is_found_of_both(monkeypatch):
    order = []
    both = scene(box(), box("b"))
    monkeypatch.setattr(hull, "panels_matter", lambda scene: True)
    monkeypatch.setattr(hull, "_hull", lambda scene, body: Mesh(total=len(body.name) * 100))
    monkeypatch.setattr(hull, "_check_count", lambda scene, total: order.append(("count", total)))
    monkeypatch.setattr(hull, "_in_place", lambda scene, hulls: order.append(("place", len(hulls))) or "mesh")
    monkeypatch.setattr(hull, "_usable", lambda scene, mesh: order.append(("usable", mesh)) or ("usable",))
    monkeypatch.setattr(hull, "make_lid", lambda scene, mesh: order.append(("lid", mesh)) or "lid")
    monkeypatch.setattr(hull, "lid_findings", lambda mesh, lid: (f"{lid} of {mesh}",))
    monkeypatch.setattr(hull, "_without_errors", lambda scene, found: found)
    made = hull.make_hull(both)
    assert (made.mesh, made.lid, made.findings) == ("mesh", "lid", ("usable", "lid of mesh"))
    assert order == [("count", 200), ("place", 2), ("usable", "mesh"), ("lid", "mesh")]
    monkeypatch.setattr(hull, "panels_matter", lambda scene: False)
    monkeypatch.setattr(hull, "_check_waves_along", lambda scene: order.append("along"))
    monkeypatch.setattr(hull, "_for_show", lambda scene: "shown")
    assert hull.make_hull(both) == "shown" and order[4:] == ["along"]


@pytest.mark.parametrize(
    "body, depth, most", [(box(length=40.0, beam=60.0), math.inf, "box"), (box(), math.inf, "box")]
)
def test_waves_along_a_body_without_panels_are_limited_with_the_shortest_that_is_allowed(
    monkeypatch, body, depth, most
):
    """λ = 2π g/ω² = 6.158 m; as many waves as `waves_along` counts are refused"""
    asked = []
    monkeypatch.setattr(hull, "too_many", lambda sizes, k: asked.append((sizes, k)) or True)
    monkeypatch.setattr(hull, "waves_along", lambda sizes, k: 10.0)
    monkeypatch.setattr(hull, "lengths_of", lambda body: "sizes")
    monkeypatch.setattr(hull, "MOST_WAVES", {"box": 4.0})
    of = scene(body, omegas=lambda: [0.5, math.sqrt(10.0)], water=SimpleNamespace(depth=depth, gravity=9.8))
    wave = 2 * math.pi * 9.8 / 10.0
    with pytest.raises(SceneError) as refused:
        hull._check_waves_along(of)
    assert str(refused.value) == (
        f"the shortest wave is {wave:.3g} m long and the body {10 * wave:g} m across; allowed: waves of at least "
        f"{10 * wave / 4:.3g} m; leave out the highest frequencies"
    )
    assert asked[0][0] == "sizes" and asked[0][1] == pytest.approx(2 * math.pi / wave)
    monkeypatch.setattr(hull, "too_many", lambda sizes, k: False)
    hull._check_waves_along(of)
