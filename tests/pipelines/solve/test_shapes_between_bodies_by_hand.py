"""Shapes of bodies in their places: masses of a file that belong to the nearest body, shapes without masses of their
own, and where the axes of a shape lie."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.modes import Body
from hakobune.pipelines.solve.bending import modes


class Table:
    """Stand-in of a shape from a file"""

    def __init__(self, points=None, masses=None):
        self.points, self.masses, self.turns = points, masses, False


@pytest.fixture
def shapes(monkeypatch):
    monkeypatch.setattr(modes, "Table", Table)


def hull(*points):
    return SimpleNamespace(whole=lambda: SimpleNamespace(centroids=np.array(points, float)))


@pytest.mark.parametrize("number, own", [(1, [0, 2]), (2, [1])])
def test_masses_of_a_file_belong_to_the_body_nearest_to_them_in_its_own_axes(shapes, monkeypatch, number, own):
    """Two of three bodies of a scene, at (0, 0) and, turned by a right angle, at (50, 10): a point of the scene at
    (53, 14, −2) is 4 ahead and 3 to the right of the second"""
    bodies = [Body("other"), Body("ship"), Body("barge", heading=np.pi / 2, place=(50.0, 10.0))]
    monkeypatch.setattr(modes, "_body", lambda scene, i: bodies[i])
    points = np.array([[1.0, 2.0, -3.0], [53.0, 14.0, -2.0], [20.0, 0.0, 0.0]])
    mode = SimpleNamespace(shape=Table(points, np.array([10.0, 20.0, 30.0])), on=(1, 2), moves=(1, 2))
    scene = SimpleNamespace(bodies=bodies)
    hulls = [hull((9e3, 0, 0)), hull((0, 0, 0), (5, 0, 0)), hull((3.0, 0, 0), (4.0, 1.0, 0))]
    found, masses = modes._masses(scene, number, hulls, [mode])
    assert masses.tolist() == [[10.0, 20.0, 30.0][i] for i in own]
    wanted = points[own] if number == 1 else np.array([[4.0, -3.0, -2.0]])
    assert found == pytest.approx(wanted)


def test_masses_of_one_body_are_those_of_its_file(shapes):
    points, masses = np.ones((2, 3)), np.array([1.0, 2.0])
    mode = SimpleNamespace(shape=Table(points, masses), on=(), moves=(0,))
    found = modes._masses(SimpleNamespace(bodies=["ship"]), 0, [hull((0, 0, 0))], [mode])
    assert found[0] is points and found[1] is masses
    bare = SimpleNamespace(shape=Table(points, None), on=(0, 1), moves=(0, 1))
    assert modes._masses(SimpleNamespace(bodies=["ship"]), 0, [hull((0, 0, 0))], [bare]) == (points, None)


def test_every_shape_without_masses_has_the_mass_of_its_own_table(shapes, monkeypatch):
    """Of four shapes the second moves with the first, which has masses; those of the third body have none but in
    their tables"""
    tables = [SimpleNamespace(mass=one) for one in (5.0, 7.0, 11.0, 13.0)]
    monkeypatch.setattr(modes, "_tables", lambda scene: tables)
    found = [SimpleNamespace(name=str(i), shape=Table(masses=masses), moves=moves)
             for i, (masses, moves) in enumerate((([1.0], (0,)), (None, (0, 1)), *[(None, (2,))] * 2))]  # fmt: skip
    M = np.zeros((10, 10))
    modes._with_own_mass(SimpleNamespace(motions_known=True), found, M, 6)
    assert np.diag(M).tolist() == [0.0] * 8 + [11.0, 13.0] and np.count_nonzero(M) == 2


@pytest.mark.parametrize("several, shared, where", [
    (False, False, ()), (True, False, ((10.0, 20.0), np.pi / 6)), (True, True, ((0.0, 0.0), 0.0, (0, 1))),
])  # fmt: skip
def test_a_shape_lies_in_the_axes_of_its_body_or_of_the_scene_where_it_is_of_several(
    monkeypatch, several, shared, where
):
    scene = SimpleNamespace(several=several, modes=["table"], bodies=[None, SimpleNamespace(place=(10.0, 20.0, 30.0))])
    monkeypatch.setattr(modes, "owner", lambda scene, table: 1)
    monkeypatch.setattr(modes, "owners", lambda scene, table: [0, 1])
    monkeypatch.setattr(modes, "between", lambda scene, table: shared)
    monkeypatch.setattr(modes, "names_of", lambda table: ["first", "second"])
    shapes = [SimpleNamespace(turns=False), SimpleNamespace(turns=True)]
    monkeypatch.setattr(modes, "_shapes", lambda key, *of: shapes if (key, of[2]) == ("modes[0]", "b") else 0)
    found = modes.modes_of(scene, ["a", "b"])
    assert found == tuple(modes.Mode(name, one.turns, one, 1, *where)
                          for name, one in zip(("first", "second"), shapes, strict=True))  # fmt: skip
    assert modes.modes_of(SimpleNamespace(modes=None), []) == ()
