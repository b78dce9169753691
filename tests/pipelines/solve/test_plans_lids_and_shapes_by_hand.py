"""Plans that go on, numbers of panels, places of lids, masses of beams: of bodies that are set by hand."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.flexible.beams import Beam
from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.solve import panel_counts, plan
from hakobune.pipelines.solve.bending import modes
from hakobune.pipelines.solve.gaps import damping_lids


def body(shape="box", **sizes):
    given = {"length": 100.0, "beam": 40.0, "draft": 10.0, "radius": 20.0}
    return SimpleNamespace(shape=shape, **given | sizes)


@pytest.mark.parametrize(("shape", "counts", "total"), [
    ("box", (5, 3, 2), 15 + 16), ("buoy", (6, 3, 2), 30), ("ship", (12, 3, 4), 84)])  # fmt: skip
def test_panels_of_a_quarter_are_those_of_sides_and_bottom(shape, counts, total):
    """5 × 3 of the bottom and (5 + 3) × 2 of the sides; around a buoy and along a ship bottom and side go together"""
    assert panel_counts._total(body(shape), counts) == total


@pytest.mark.parametrize(("shape", "sizes", "tolerance", "panels"), [
    ("buoy", {}, 0.01, 250), ("ship", {}, 0.01, 800), ("box", {"beam": 50.0, "draft": 1e-9}, 0.01, 290),
    ("box", {"length": 100.0, "beam": 50.0, "draft": 50 / 2.3}, 0.01, 290),
    ("box", {"length": 250.0, "beam": 50.0, "draft": 50 / 2.3}, 0.01, 440),
    ("box", {"length": 50.0, "beam": 250.0, "draft": 50 / 2.3}, 0.01, 440),
    ("box", {"length": 500.0, "beam": 50.0, "draft": 50 / 2.3}, 0.01, 540),
    ("box", {"length": 50.0, "beam": 50.0, "draft": 50 / 2.3}, 0.01, 290),
    ("box", {"length": 350.0, "beam": 50.0, "draft": 50 / 2.3 / 10**0.2}, 0.01, 290 + 125),
    ("buoy", {}, 0.005, math.ceil(250 * 2 ** (1 / 1.16))), ("buoy", {}, 0.02, math.ceil(250 * 2 ** (-1 / 1.16))),
])  # fmt: skip
def test_panels_grow_with_the_tolerance_and_where_a_long_section_rolls_easily(shape, sizes, tolerance, panels):
    """50 more for each breadth of length beyond two, up to seven, at a breadth of 2.3 drafts; half of it where the
    draft is 10^0.2 times less (5 · 0.2 = 1)"""
    assert panel_counts.panels_for(body(shape, **sizes), tolerance) == panels


def test_coarse_meshes_have_about_half_the_panels_and_finer_ones_twice(monkeypatch):
    fine = {"box": (10, 6, 4), "few": (2, 2, 2), "small": (3, 2, 2)}
    monkeypatch.setattr(panel_counts, "counts_of", lambda one, mesh: fine[mesh])
    assert panel_counts.coarse_counts(body(), "box") == (7, 4, 3)
    assert panel_counts.coarse_counts(body(), "box", fewest=5) is None  # finer down than the mesh
    assert panel_counts.coarse_counts(body(), "few") is None
    assert panel_counts.coarse_counts(body(), "small") == (2, 2, 2)  # 12 of 16 panels
    monkeypatch.setattr(panel_counts, "TOO_CLOSE", 0.74)
    assert panel_counts.coarse_counts(body(), "small") is None
    assert panel_counts.finer_counts(body(), "box") == (14, 9, 6)


def test_counts_of_a_mesh_are_found_again():
    for one in (body(), body("buoy", draft=10.0)):
        counts = (6, 3, 2)
        mesh = panel_counts.meshed(one, counts)
        assert panel_counts.counts_of(one, mesh) == counts
        whole = panel_counts._total(one, counts)
        assert len(mesh) == whole
    standing = panel_counts.meshed(body("buoy"), (6, 3, 2), bottom=False)
    assert len(standing) == 12 and panel_counts.counts_of(body("buoy"), standing)[::2] == (6, 2)
    assert panel_counts.sizes(body()) == (100.0, 40.0, 10.0) and panel_counts.sizes(body("buoy")) == (20.0, 10.0)
    assert panel_counts.sizes(body("ship")) == (100.0, 40.0, 10.0)


def test_counts_for_a_tolerance_are_at_least_a_few_in_each_direction(monkeypatch):
    asked = []
    monkeypatch.setattr(panel_counts, "panels_for", lambda one, tolerance: (one.shape, tolerance))
    for shape, least in (("box", (3, 3, 3)), ("buoy", (4, 3, 3)), ("ship", (12, 4, 8))):
        monkeypatch.setitem(
            panel_counts.MAKERS, shape, (None, lambda *all, **more: asked.append((all, more)) or (1, 9, 2))
        )
        assert panel_counts.fine_counts(body(shape), 0.02, 5.0) == (least[0], 9, least[2])
    assert asked[0] == ((100.0, 40.0, 10.0), {"panels": ("box", 0.02), "longest": 5.0})
    panel_counts.fine_counts(body(), 0.02, 5.0, bottom=False)
    assert asked[-1][1]["bottom"] is False


SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


@pytest.mark.parametrize(
    ("dry", "place"),
    [
        ((0.1, 0.1), "0.1, y = 0.1"),
        ((9.9, 0.1), "9.9, y = 0.1"),
        ((9.9, 9.9), "9.9, y = 9.9"),
        ((5.0, 0.1), "5, y = 0.1"),
        ((9.9, 5.0), "9.9, y = 5"),
        ((5.0, 9.9), "5, y = 9.9"),
        ((0.1, 5.0), "0.1, y = 5"),
        ((5.0, 5.0), "5, y = 5"),
        ((0.0, 0.0), None),
        ((10.0, 5.0), None),
        (None, None),
    ],
)
def test_a_lid_lies_on_open_water_at_its_corners_sides_and_middle(monkeypatch, dry, place):
    """A fiftieth inside of them: a lid may touch a hull"""
    monkeypatch.setattr(damping_lids, "covered", lambda points, mesh: np.array(
        [dry is not None and np.allclose(one, dry, atol=1e-9) for one in points]))  # fmt: skip
    if place is None:
        damping_lids._check_on_water("damping_lids[0]", SQUARE, "mesh")
    else:
        with pytest.raises(
            SceneError, match=rf"damping_lids\[0\] covers a hull at x = {place} m; allowed: open water only"
        ):
            damping_lids._check_on_water("damping_lids[0]", SQUARE, "mesh")


def test_lids_are_those_of_corners_or_of_every_moonpool(monkeypatch):
    looked = []
    monkeypatch.setattr(damping_lids, "moonpools", lambda mesh: [SQUARE, SQUARE + 50])
    monkeypatch.setattr(damping_lids, "_check_on_water", lambda *given: looked.append(given[0]))
    tables = [
        SimpleNamespace(corners=None, damping=0.1),
        SimpleNamespace(corners=(SQUARE + 20)[::-1].tolist(), damping=0.2),
    ]
    made = damping_lids.damping_lids_of(SimpleNamespace(damping_lids=tables), "mesh")
    assert [one.damping for one in made] == [0.1, 0.1, 0.2] and looked == ["damping_lids[1]"]
    assert [one.corners.mean(axis=0).tolist() for one in made] == [[5, 5], [55, 55], [25, 25]]
    assert damping_lids.damping_lids_of(SimpleNamespace(damping_lids=None), "mesh") == ()
    monkeypatch.setattr(damping_lids, "moonpools", lambda mesh: [])
    with pytest.raises(SceneError, match=r"damping_lids\[0\] has no corners, and no body has a moonpool; give corners"):
        damping_lids.damping_lids_of(SimpleNamespace(damping_lids=tables), "mesh")


@dataclass(frozen=True)
class Header:
    scene: str = "old"
    body: str = "old"
    modes: str = "old"
    scene_hash: str = "old"
    theta: tuple = (1, 2)


@dataclass(frozen=True)
class Plan:
    header: object
    hull: object
    anew: tuple = ()
    remarks: tuple = ("one",)


@pytest.mark.parametrize(("moved", "names", "anew"), [
    ("", ("rao", "pressure"), ()), ("the weight has changed", ("added_mass",), ()),
    ("the weight has changed", ("pressure", "rao", "added_mass"), ("rao", "pressure")),
])  # fmt: skip
def test_another_weight_is_taken_up_and_what_depends_on_it_is_computed_again(monkeypatch, moved, names, anew):
    db = SimpleNamespace(header=Header(), path="b.h5", mesh="mesh", names=names)
    for name, value in {
        "open_database": db,
        "check_same": moved,
        "to_toml": "text",
        "scene_hash": "hash",
        "fixed_part": "fixed",
        "body_properties": "body",
        "modes_of": "modes",
        "own_hulls_of_modes": (),
        "pending": "pending",
    }.items():
        monkeypatch.setattr(plan, name, lambda *given, value=value: value)
    monkeypatch.setattr(plan, "_by_the_same_method", lambda scene, header, path: f"{scene} {path}")
    monkeypatch.setattr(plan, "_with_angles", lambda scene, db, lacking, header: header)
    monkeypatch.setattr(plan, "stored_hull", lambda scene, header: (scene, header))
    monkeypatch.setattr(plan, "_plan", lambda scene, hull, header: Plan(header, hull))
    monkeypatch.setattr(plan, "NEEDS_MOTION", ("rao", "drift_force"))
    made = plan.resumed("scene", "file")
    changed = ("body", "modes", "hash") if moved else ("old", "old", "old")
    assert made.header == Header("text", *changed) and made.hull == ("scene b.h5", made.header) and made.anew == anew
    told = (f"the weight has changed: {', '.join(anew)} are computed again, from the stored coefficients and Kochin "
            "functions if there are any",)  # fmt: skip
    assert made.remarks == ("one", *(told if anew else ()))


@pytest.mark.parametrize(("stored", "wanted", "needed", "theta"), [
    ((), (), (1, 2, 3), (1, 2)), (("k",), (), (1, 2, 3), (1, 2, 3)), ((), ("k",), (1, 2, 3), (1, 2, 3)),
    (("k",), ("k",), (7, 8), (1, 2)), (("k",), (), (7,), (1, 2)),
])  # fmt: skip
def test_angles_of_kochin_functions_grow_with_the_highest_frequency(monkeypatch, stored, wanted, needed, theta):
    asked = []
    monkeypatch.setattr(plan, "KOCHIN", {"k"})
    monkeypatch.setattr(plan, "kochin_angles", lambda scene, mesh, wave: asked.append(wave) or needed)
    monkeypatch.setattr(plan, "wavenumber", lambda omega, depth, gravity: omega * 2.0)
    water = SimpleNamespace(depth=20.0, gravity=9.8)
    scene = SimpleNamespace(names=lambda: wanted, omegas=lambda: [0.5, 0.7], water=water)
    lacking = SimpleNamespace(rows=[SimpleNamespace(omega=0.9)])
    db = SimpleNamespace(names=stored, omega=[0.4, 0.6], mesh="mesh")
    assert plan._with_angles(scene, db, lacking, Header()).theta == theta
    assert asked == ([2 * math.pi / 1.8] if stored or wanted else [])


def of_scene(mass=None, gyration=(3.0, 20.0, 20.0), **more):
    hull = SimpleNamespace(mass=mass, gyration=gyration, center_of_gravity=(1.0, 2.0, 3.0))
    return SimpleNamespace(
        bodies=[hull], water=SimpleNamespace(density=1000.0, gravity=9.8), several=False, modes=(), **more
    )


def of_hull(volume=5000.0):
    points = np.array([[-40.0, -5, 0], [60.0, 5, -5]])
    return SimpleNamespace(volume=volume, whole=lambda: SimpleNamespace(points=points))


def table(kind="vertical", count=2, **more):
    given = {
        "length": None,
        "mass_per_length": None,
        "inertia_per_length": None,
        "EI": 1e9,
        "GJ": 2e9,
        "axis_height": -1.0,
    }
    return SimpleNamespace(kind=kind, count=count, **given | more)


@pytest.mark.parametrize(("mass", "more", "ends", "per_length"), [
    (None, {}, (-40, 60), 5e6 / 100), (2e6, {}, (-40, 60), 2e4), (2e6, {"length": 80.0}, (-30, 50), 2.5e4),
    (2e6, {"mass_per_length": 7.0}, (-40, 60), 7.0),
])  # fmt: skip
def test_a_beam_is_as_long_as_the_hull_with_its_mass_spread_along_it(monkeypatch, mass, more, ends, per_length):
    monkeypatch.setattr(modes, "owner", lambda scene, table: 0)
    one, two = modes._shapes("modes[0]", of_scene(mass), table(**more), of_hull())
    assert (one.start, one.end) == ends and two.start == one.start and one.per_length == pytest.approx(per_length)
    assert one == Beam("vertical", 1, *ends, -1.0, 1e9, pytest.approx(per_length))


def test_a_beam_that_twists_has_the_inertia_of_its_radius_of_gyration(monkeypatch):
    """m r²/L = 2e6 · 9/100"""
    monkeypatch.setattr(modes, "owner", lambda scene, table: 0)
    (one,) = modes._shapes("modes[0]", of_scene(2e6), table("torsion", 1), of_hull())
    assert one == Beam("torsion", 1, -40.0, 60.0, -1.0, 2e9, pytest.approx(1.8e5))
    (one,) = modes._shapes("modes[0]", of_scene(2e6), table("torsion", 1, inertia_per_length=5.0), of_hull())
    assert one.per_length == 5.0
    with pytest.raises(SceneError, match=r"modes\[0\]\.inertia_per_length is missing, and no gyration is given"):
        modes._shapes("modes[0]", of_scene(2e6, None), table("torsion", 1), of_hull())


@pytest.mark.parametrize(
    ("kinds", "mass", "per_length"),
    [
        ((("vertical", 7.0),), None, 7.0),
        ((("torsion", 9.0), ("vertical", 7.0)), None, 7.0),
        ((("torsion", 9.0),), 2e6, 2e4),
        ((("torsion", 9.0),), None, 5e4),
    ],
)
def test_masses_lie_along_the_beam_at_the_height_of_the_centre_of_gravity(kinds, mass, per_length):
    of = [
        SimpleNamespace(shape=Beam(kind, 1, -40.0, 60.0, 0.0, 1e9, own), turns=kind == "torsion") for kind, own in kinds
    ]
    points, masses = modes._masses(of_scene(mass), 0, [of_hull()], of)
    assert masses.sum() == pytest.approx(100 * per_length)
    assert (points[:, 1:] == [2.0, 3.0]).all() and points[:, 0] @ masses == pytest.approx(10.0 * masses.sum())
    assert (points[:, 0] - 10) ** 2 @ masses == pytest.approx(masses.sum() * 100**2 / 12)
    assert points[:, 0].min() > -40 and points[:, 0].max() < 60


@pytest.mark.parametrize(("depth", "wanted"), [(50.0, 50.0), (500.0, 2 * math.pi * 9.8 / 0.81), (4.0, None)])
def test_the_rise_between_two_hulls_is_looked_for_around_the_formula_and_ever_closer(monkeypatch, depth, wanted):
    """A peak of 7 m/m at 0.93 rad/s, by a formula at 0.9; water deeper than a wave is as deep as a wave"""
    from hakobune.pipelines.solve.gaps import resonant_water

    asked = []

    def side_by_side(pair, depth, omega, gravity, tolerance):
        asked.append((pair, depth, gravity, tolerance))
        return SimpleNamespace(gains=[7.0 - 100 * (omega - 0.93) ** 2])

    monkeypatch.setattr("hakobune.bem.sections.side_by_side.side_by_side", side_by_side)
    found = resonant_water.peak(2.0, 5.0, 10.0, depth, 0.9, 9.8)
    if wanted is None:
        assert found is None and not asked
        return
    assert found == (pytest.approx(0.93, abs=3e-3), pytest.approx(7.0, abs=2e-3))
    pair, of, gravity, tolerance = asked[0]
    assert [place for _, place in pair] == [-6.0, 6.0] and pair[0][0] is pair[1][0]
    assert (of, gravity, tolerance) == (pytest.approx(wanted), 9.8, 1e-2)

    def refuse(*given, **more):
        raise ValueError

    monkeypatch.setattr("hakobune.bem.sections.side_by_side.side_by_side", refuse)
    assert resonant_water.peak(2.0, 5.0, 10.0, depth, 0.9, 9.8) is None
