"""Wave pairs in the order in which they are solved and stored, with the physics replaced: fine and coarse panels, runs
that go on, the surface, and when it is written."""

import itertools
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import DatabaseError
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.pipelines.qtf import result, running


@dataclass
class Forces:
    """Forces at frequencies, with the surface or without"""

    frequency: tuple
    surface: object = None

    @staticmethod
    def joined(parts):
        return Forces(tuple(itertools.chain(*(part.frequency for part in parts))), parts[-1].surface)


@dataclass
class Run:
    """Solves blocks of two of the frequencies 1 … 5"""

    problem: str
    of: tuple
    made: list = field(default_factory=list)

    motions = by_motions = None

    def blocks(self, done):
        return [range(k, min(k + 2, 6)) for k in range(1 + done, 6, 2)]

    def solve(self, block):
        self.made.append(tuple(block))
        if self.problem == "rough":
            return SimpleNamespace(total=np.array(block, float))
        return Forces(tuple(block), "surface" if self.of[4] else None)


@pytest.fixture
def house(monkeypatch):
    """`_solve` with a clock that goes on by 3 s each time it is asked; returns what was made and stored"""
    known = SimpleNamespace(runs=[], stored=[], shares=[], errors=[], begun=None, step=3.0)

    def run(problem, *given, **more):
        made = Run(problem, (*given, more.get("kind")))
        if problem == "rough":
            made.by_motions = np.arange(10.0)
        else:
            made.motions = "fine motions"
        known.runs.append(made)
        return made

    def errors(forces, coarser, by_motions):
        known.errors.append((forces.frequency, coarser.tolist(), by_motions.tolist()))
        return "errors"

    clock = itertools.count(0.0)
    monkeypatch.setattr(running, "QuadraticRun", run)
    monkeypatch.setattr(running, "QuadraticForces", Forces)
    monkeypatch.setattr(running, "StoredForces", lambda *given: given)
    monkeypatch.setattr(running, "write_forces", lambda path, stored: known.stored.append((path, stored)))
    monkeypatch.setattr(running, "_of_same_waves", lambda db, question, body: "same waves")
    monkeypatch.setattr(running, "_share", lambda *given: known.shares.append(given) or 0.07)
    monkeypatch.setattr(running, "share_of", lambda forces: 0.2)
    monkeypatch.setattr(running, "_begun", lambda stored, question, full: known.begun if stored else None)
    monkeypatch.setattr(running.time, "monotonic", lambda: known.step * next(clock))

    def call(
        rough="rough", kind=DIFFERENCE, level="auto", bodies=(), full=False, fresh=False, floats=True, method="panel"
    ):
        body = SimpleNamespace(fine=SimpleNamespace(dofs=["Surge", "Sway"]), rough=rough, method=method, errors=errors)
        known.asked = []
        monkeypatch.setattr(running, "bodies", lambda *given: known.asked.append(given) or body)
        question = SimpleNamespace(
            kind=kind, level=level, method="auto", omega=np.array([0.3, 0.9]), highest=0.5, waves=("waves", "headings"),
            held=SimpleNamespace(floats=floats, moving="moving"), adds_surface=lambda share: full,
        )  # fmt: skip
        db = SimpleNamespace(path="b.h5", bodies=bodies)
        running._solve(db, question, fresh)
        return known, question, body, db

    return call, known


def test_pairs_are_solved_on_fine_and_coarse_panels_and_stored_now_and_then_and_at_the_end(house):
    """Three blocks with a clock of 3 s: stored after the second, 6 s later, and complete at the end"""
    call, _ = house
    known, question, body, db = call()
    assert known.asked == [(db, "auto", 0.9, 0.5)] and known.shares == [(body.fine, question, "same waves")]
    fine, rough = known.runs
    assert (
        fine.problem is body.fine
        and fine.of[:3] == ("waves", "headings", "moving")
        and fine.of[4:] == (False, DIFFERENCE)
    )
    assert rough.of[:3] == ("waves", "headings", "moving") and rough.of[4:7] == (False, "fine motions", DIFFERENCE)
    assert fine.made == rough.made == [(1, 2), (3, 4), (5,)]
    (path, first), (_, last) = known.stored
    held = question.held
    assert path == "b.h5" and first[0].frequency == (1, 2, 3, 4) and first[1:5] == (held, "panel", 0.07, "errors")
    assert first[5].tolist() == [1, 2, 3, 4] and first[6:] == (0.5, ("Surge", "Sway"))
    assert last[0].frequency == (1, 2, 3, 4, 5) and last[5].tolist() == [1, 2, 3, 4, 5] and last[6] is None
    assert known.errors[0] == ((1, 2, 3, 4), [1, 2, 3, 4], [0, 1, 2, 3])
    assert known.errors[1] == ((1, 2, 3, 4, 5), [1, 2, 3, 4, 5], [0, 1, 2, 3, 4])


def test_a_quick_run_is_stored_once(house):
    call, known = house
    known.step = 0.1
    call()
    assert len(known.stored) == 1 and known.stored[0][1][0].frequency == (1, 2, 3, 4, 5)


def test_without_coarse_panels_there_is_no_error(house):
    call, _ = house
    known, *_ = call(rough=None)
    assert len(known.runs) == 1 and known.errors == []
    assert [stored[4:6] for _, stored in known.stored] == [(None, None)] * len(known.stored)


@pytest.mark.parametrize(
    "more, motions", [({}, "fine motions"), ({"floats": False}, None), ({"method": "contour"}, None)]
)
def test_a_body_that_floats_moves_on_both_meshes_alike(house, more, motions):
    call, _ = house
    assert call(**more)[0].runs[1].of[5] == motions


def test_a_run_that_was_ended_goes_on_after_what_is_stored(house):
    call, known = house
    known.begun = SimpleNamespace(forces=Forces((1, 2)), coarser=np.array([1.0, 2.0]))
    call()
    assert known.runs[0].made == known.runs[1].made == [(3, 4), (5,)]
    assert known.stored[-1][1][0].frequency == (1, 2, 3, 4, 5) and known.stored[-1][1][5].tolist() == [1, 2, 3, 4, 5]
    known.begun.forces = Forces((1, 2, 3, 4, 5))
    known.begun.coarser = np.arange(1.0, 6.0)
    known.stored.clear()
    call()
    assert known.runs[2].made == [] and [one[1][0].frequency for one in known.stored] == [(1, 2, 3, 4, 5)]
    known.begun = SimpleNamespace(forces=Forces((9,)), coarser=None)
    call(fresh=True)
    assert known.runs[4].made == [(1, 2), (3, 4), (5,)]


@pytest.mark.parametrize("more, estimated", [
    ({}, True), ({"kind": SUM}, False), ({"level": "full"}, False), ({"bodies": ("a", "b")}, False),
])  # fmt: skip
def test_the_surface_is_estimated_for_differences_of_one_body_unless_it_is_asked_for(house, more, estimated):
    call, _ = house
    known, *_ = call(**more)
    assert len(known.shares) == estimated and known.stored[-1][1][3] == (0.07 if estimated else None)


def test_the_share_of_a_surface_that_is_solved_is_its_own(house):
    call, known = house
    call(full=True)
    assert known.stored[-1][1][3] == 0.2 and known.runs[0].of[4] is True


@pytest.mark.parametrize("asked, surface, taken", [(0.5, None, True), (0.4, None, False), (0.5, "surface", False)])
def test_a_share_that_was_estimated_of_the_same_run_is_taken(monkeypatch, asked, surface, taken):
    estimated = []
    monkeypatch.setattr(running, "surface_share", lambda *given: estimated.append(given) or 0.09)
    stored = SimpleNamespace(asked=asked, share=0.03, forces=Forces((), surface))
    question = SimpleNamespace(highest=0.5, waves=("w", "h"), held=SimpleNamespace(moving="m"))
    assert running._share("problem", question, stored) == (0.03 if taken else 0.09)
    assert estimated == [] if taken else estimated == [("problem", "w", "h", "m")]
    assert running._share("problem", question, None) == 0.09


def test_a_surface_that_is_not_supported_is_told_and_other_faults_are_not_hidden(monkeypatch):
    question = SimpleNamespace(highest=0.5, waves=(), held=SimpleNamespace(moving="m"))

    def fault(words):
        def estimate(*_):
            raise ValueError(words)

        monkeypatch.setattr(running, "surface_share", estimate)

    fault("the surface has a hole")
    with pytest.warns(UserWarning, match="the surface has a hole"):
        assert running._share("problem", question, None) is None
    fault("the body has a hole")
    with pytest.raises(ValueError, match="the body has a hole"):
        running._share("problem", question, None)


@pytest.mark.parametrize("there, answered, fresh, moored, solved", [
    (True, True, False, None, False), (True, False, False, None, True), (False, True, False, None, True),
    (True, True, True, None, True), (False, True, False, "m.toml", True), (True, True, False, "m.toml", False),
])  # fmt: skip
def test_a_question_is_solved_unless_what_is_stored_answers_it(
    monkeypatch, capsys, there, answered, fresh, moored, solved
):
    @dataclass(frozen=True)
    class Held:
        lines: object = None

    @dataclass(frozen=True)
    class Question:
        held: Held = Held()
        kind: object = DIFFERENCE
        is_continued: bool = False

        def continued(self, stored):
            return Question(self.held, self.kind, True)

        def answered_by(self, stored):
            return answered and stored == "stored b.h5" and self.is_continued

    ran = []

    def read(db, kind):
        if not there and not ran:
            raise DatabaseError("nothing")
        return f"stored {db if isinstance(db, str) else db.path}"

    monkeypatch.setattr(result, "read_forces", read)
    monkeypatch.setattr(result, "open_database", lambda path: f"anew {path}")
    monkeypatch.setattr(result, "_stiffness", lambda study, db: f"lines of {study}")
    monkeypatch.setattr(running, "solve", lambda db, question, fresh: ran.append((question, fresh)))
    found = result._answer(SimpleNamespace(path="b.h5"), Question(), moored, fresh)
    assert len(ran) == solved
    if not solved:
        assert found == "stored b.h5" and capsys.readouterr().err == ""
        return
    ((question, anew),) = ran
    assert found == "stored anew b.h5" and anew is fresh and question.is_continued == (there and not fresh)
    assert question.held.lines == (f"lines of {moored}" if moored else None)
    assert capsys.readouterr().err == f"b.h5: group {result.GROUPS[DIFFERENCE]}\n"


def test_the_stiffness_of_lines_is_that_of_the_body_in_its_steady_loads(monkeypatch):
    from hakobune.mooring.studies import multi_point
    from hakobune.pipelines.moor import study as studies

    asked = []
    read = SimpleNamespace(
        without_berth=lambda words: asked.append(words) or read, hull_of=lambda sizes: f"hull of {sizes}",
        system=lambda *given: ("system", *given), conditions=lambda: "conditions", allowable=0.5,
    )  # fmt: skip
    made = SimpleNamespace(equilibrium=SimpleNamespace(stiffness="K"))
    monkeypatch.setattr(studies, "read_study", lambda path: (read, "text"))
    monkeypatch.setattr(multi_point, "multi_point", lambda *given: asked.append(given) or made)
    db = SimpleNamespace(sizes="sizes", rotation_center="center", density=1025.0, gravity=9.8)
    assert result._stiffness("m.toml", db) == "K"
    system = ("system", "hull of sizes", "center", 1025.0, 9.8)
    assert asked == ["qtf --moored", (db, system, "hull of sizes", "conditions", 0.5)]
