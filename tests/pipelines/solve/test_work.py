"""What a process keeps of the body it last worked on: taken again for the same body, and for no other."""

import pickle
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.viscous import Quadratic, Viscous
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box
from hakobune.pipelines.solve import run
from hakobune.pipelines.solve.work import _key, solve_one


def moved(mesh):
    """The mesh with one of its middle points a millimetre along the hull; as many panels, area and volume alike"""
    points = mesh.points.copy()
    points[len(points) // 2, 0] += 1e-3
    return replace(mesh, points=points)


@pytest.fixture
def kept(monkeypatch):
    """A problem → the problem whose preparation its frequencies are solved with"""
    monkeypatch.setattr("hakobune.pipelines.solve.work._prepared", {})
    monkeypatch.setattr("hakobune.bem.methods.panel_problem.prepare", lambda problem: problem)
    monkeypatch.setattr("hakobune.bem.frequency.solve_frequency", lambda prepared, *question: prepared)
    return lambda problem: solve_one(problem, 0.5, [0.0], {"added_mass"}, None)


FINE, COARSE = box(100, 50, 10, panels=400), box(100, 50, 10, panels=200)
PANELS = PanelProblem(FINE, lid(FINE), coarse=(COARSE, lid(COARSE)), inertia_matrix=np.eye(6))
SHAPE = ShapeProblem(method="contour", shape="box", sizes=(100.0, 50.0, 10.0), depth=20.0, panels=PANELS)


@pytest.mark.parametrize(
    "one, other",
    [
        (PANELS, replace(PANELS, mesh=moved(FINE))),
        (PANELS, replace(PANELS, coarse=(moved(COARSE), PANELS.coarse[1]))),
        (PANELS, replace(PANELS, coarse=(COARSE, moved(PANELS.coarse[1])))),
        (PANELS, replace(PANELS, inertia_matrix=np.eye(6) * (1 + 1e-12))),
        (SHAPE, replace(SHAPE, panels=replace(PANELS, mesh=moved(FINE)))),
        (
            replace(PANELS, viscous=Viscous({"Roll": Quadratic(1e9)}, 1.0)),
            replace(PANELS, viscous=Viscous({"Pitch": Quadratic(1e9)}, 1.0)),
        ),
    ],
    ids=["mesh", "coarse mesh", "coarse lid", "inertia", "panels of a shape", "viscous"],
)
def test_a_body_that_differs_anywhere_is_prepared_anew(kept, one, other):
    assert kept(one) is one and kept(other) is other


@pytest.mark.parametrize("problem", [PANELS, SHAPE], ids=["panels", "shape"])
def test_a_copy_that_came_to_another_process_finds_the_prepared_body(kept, problem):
    assert kept(problem) is problem
    FINE.areas.sum()  # what a mesh remembers does not count
    assert kept(pickle.loads(pickle.dumps(problem))) is problem


def test_what_arrives_within_half_a_second_is_stored_together_and_later_at_once(monkeypatch):
    """The first at once; then what came since, once the last storing is half a second ago, and the rest at the end"""
    now, stored = [100.0], []
    monkeypatch.setattr(run, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    monkeypatch.setattr(run.Storing, "__init__", lambda self, file: setattr(self, "waiting", []))
    monkeypatch.setattr(run.Storing, "add", lambda self, *row: self.waiting.append(row))
    monkeypatch.setattr(run.Storing, "store", lambda self: stored.append(self.waiting.copy()) or self.waiting.clear())
    with run._stored_together("file") as storing:
        for later, number in ((0.0, 1), (0.4, 2), (0.09, 3), (0.02, 4), (0.6, 5), (0.1, 6)):
            now[0] += later
            storing.add(number)
        assert stored == [[(1,)], [(2,), (3,), (4,)], [(5,)]]
    assert stored[3:] == [[(6,)]]
    with pytest.raises(KeyboardInterrupt), run._stored_together("file") as storing:
        storing.add(7)
        storing.add(8)
        raise KeyboardInterrupt
    assert stored[4:] == [[(7,)], [(8,)]]


def test_what_is_kept_of_a_body_knows_kinds_and_nesting_of_what_the_body_is_made_of():
    """Equal numbers in other brackets, of other kinds, or in another order are other bodies; equal ones are the same"""
    numbers = np.arange(6.0)
    values = [
        (1, 2, 3), (1, (2, 3)), ((1, 2), 3), ((1, 2, 3),), ((1,), 2, 3), (1, 2, 3, ()), [1, 2, 3], (1.0, 2, 3),
        (3, 2, 1), ("1", 2, 3), {1: 2}, {2: 1}, (1, 2), {1: 2, 3: 4}, {1: 3, 2: 4}, None, (), [], (numbers,),
        numbers, numbers.reshape(2, 3), numbers.tolist(), numbers.astype(np.float32), Quadratic(1.0), Quadratic(2.0),
    ]  # fmt: skip
    keys = [_key(value) for value in values]
    assert len(set(keys)) == len(keys)
    assert _key((1, {"a": numbers})) == _key((1, {"a": numbers.copy()}))
