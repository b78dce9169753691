"""Small answers of a database and its reader: sizes, names, what it holds, errors by kind."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import interpolant
from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.natural_periods import NaturalPeriods
from hakobune.bem.database.reader import Reader
from hakobune.bem.database.rows import Database
from hakobune.meshing.shapes import box, buoy


def test_sizes_are_those_of_the_scene_or_of_the_box_that_holds_the_hull():
    """Twice the farthest point from the origin in x and y: a box of 10 × 6 × 2 m, 1 m ahead"""
    hull = box(10, 6, 2, panels=40, symmetry="").moved(dx=1.0)
    for dimensions, sizes in (
        ({}, {"length": 12.0, "beam": 6.0, "draft": 2.0}), ({"length": 9.0}, {"length": 9.0}),
        ({"radius": 3.0, "draft": 1.5}, {"length": 12.0, "beam": 6.0, "draft": 1.5, "radius": 3.0}),
    ):  # fmt: skip
        db = SimpleNamespace(mesh=hull, dimensions=dimensions, is_round=False)
        assert Database.sizes.fget(db) == pytest.approx(sizes)
    bare = SimpleNamespace(mesh=None, dimensions={"draft": 1.0}, is_round=False)
    assert Database.sizes.fget(bare) == {"draft": 1.0}


def test_a_round_hull_has_twice_its_radius_not_the_corners_of_its_panels():
    """Of a mesh without dimensions, the farthest point from the axis"""
    of_mesh = SimpleNamespace(mesh=buoy(3.0, 1.5, panels=100), dimensions={}, is_round=True)
    corners = np.hypot(*of_mesh.mesh.points[:, :2].T).max()
    wanted = {"length": 2 * corners, "beam": 2 * corners, "radius": corners, "draft": 1.5}
    assert Database.sizes.fget(of_mesh) == pytest.approx(wanted)
    for mesh in (None, of_mesh.mesh):
        by_flags = SimpleNamespace(mesh=mesh, dimensions={"radius": 3.0, "draft": 1.5}, is_round=True)
        assert Database.sizes.fget(by_flags) == {"length": 6.0, "beam": 6.0, "radius": 3.0, "draft": 1.5}


def test_a_database_holds_names_that_are_words_alone():
    db = SimpleNamespace(holds=lambda name: name == "rao")
    assert Database.__contains__(db, "rao") is True and Database.__contains__(db, "mass") is False
    assert Database.__contains__(db, 3) is False


def test_natural_periods_are_shown_by_name_to_four_digits():
    shown = NaturalPeriods(("Heave", "Roll"), np.array([5.12345, np.inf]), np.eye(2), np.ones(2, bool), 1.0)
    assert repr(shown) == "<NaturalPeriods Heave 5.123 s, Roll inf s>"


def test_echoes_are_each_a_share_of_the_one_before_and_one_in_all():
    delays, weights = interpolant._echoes(0.5, 0.8, 1.6)
    assert delays == pytest.approx([0.0, 0.5, 1.0, 1.5]) and np.sum(weights) == pytest.approx(1.0)
    assert weights[1:] / weights[:-1] == pytest.approx([0.8] * 3)
    assert interpolant._echoes(0.5, 0.8, 1.76)[0][-1] == pytest.approx(2.0)


def test_every_kind_of_quantity_is_read_by_its_own_way(monkeypatch):
    """Motions and drift carry errors on, forces and far field have those of interpolation; pressure: stored headings"""
    from hakobune.bem.database import reader

    monkeypatch.setattr(reader, "carried", lambda body, omega, headings, name, needed: f"carried {name}")
    monkeypatch.setattr(reader, "interpolated", lambda body, omega, headings, name: f"interpolated {name}")
    body = SimpleNamespace(
        rebuilds_drift=False, motions=lambda *given: "motions", forces=lambda w, b, name: f"forces {name}",
        drift=lambda w, b, fixed=False: f"drift {fixed}", far_field=lambda *given: ("radiated", "diffracted"),
        between=SimpleNamespace(value=lambda w, name: f"value {name}", error=lambda w, name: f"error {name}"),
    )  # fmt: skip
    at = [0.3]
    assert Reader.at(body, 0.5, "rao", at) == ("motions", "carried rao")
    assert Reader.at(body, 0.5, "drift_force", at) == ("drift False", "carried drift_force")
    assert Reader.at(body, 0.5, "drift_force_fixed", at) == ("drift True", "interpolated drift_force_fixed")
    assert Reader.at(body, 0.5, "kochin_diffraction", at) == ("diffracted", "interpolated kochin_diffraction")
    for name in ("excitation_force", "diffraction_force"):
        assert Reader.at(body, 0.5, name, at) == (f"forces {name}", f"interpolated {name}")
        assert Reader.at(body, 0.5, name) == (f"value {name}", f"error {name}")
    assert Reader.at(body, 0.5, "added_mass", at) == ("value added_mass", "error added_mass")
    with pytest.raises(
        BetweenError, match="pressure is available at stored headings only; add the heading to the scene"
    ):
        Reader.at(body, 0.5, "pressure", at)
    body.rebuilds_drift = True
    assert Reader.at(body, 0.5, "drift_force_fixed", at) == ("drift True", "carried drift_force_fixed")


def test_what_the_room_offers_is_there_wherever_it_lives_and_nothing_else():
    import hakobune.bem.database as room
    from hakobune.bem.database import rows, storing, widening

    where = {"append": storing, "append_limit": storing, "Storing": storing, "extend": widening, "create": rows}
    for name, module in where.items():
        assert room.__getattr__(name) is getattr(module, name)
    with pytest.raises(AttributeError, match=r"module 'hakobune\.bem\.database' has no attribute 'same_omega'"):
        room.__getattr__("same_omega")


def test_one_body_is_one_that_is_rigid():
    def require_rigid():
        raise ValueError("bends")

    with pytest.raises(ValueError, match="bends"):
        Database.require_one_body(SimpleNamespace(bodies=(), require_rigid=require_rigid))
    Database.require_one_body(SimpleNamespace(bodies=(), require_rigid=lambda: None))
