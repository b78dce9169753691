"""The run loop: what is pending is submitted, stored and marked.  The executor makes the numbers up."""

import signal
from concurrent.futures import Future
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
import pytest

from hakobune.bem.database import DatabaseError, open_database, pending
from hakobune.bem.database.schema import QUANTITIES
from hakobune.pipelines.executors.choice import executor_of
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve import run
from hakobune.pipelines.solve.run import solve
from hakobune.pipelines.solve.work import solve_one


def scene(**changes):
    raw = {
        "water": {"depth": 20.0},
        "bodies": [{"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0, "gyration": [6, 12, 13]}],
        "waves": {"omegas": [0.4, 0.8, 1.2], "headings_deg": [0, 90]},
        "panels": 40,
        "want": ["radiation", "drift", "added_mass_infinity"],
    }
    return make_scene({**raw, **changes})


class MadeUp:
    """An executor that notes what it is asked for and answers with numbers that tell where they belong.

    failing : frequencies that raise; stopping : the frequency at which Ctrl-C is pressed
    """

    def __init__(self, failing=(), stopping=None):
        self.failing, self.stopping, self.asked, self.angles = failing, stopping, [], []

    def submit(self, function, problem, *arguments):
        future = Future()
        try:
            future.set_result(self._answer(function, *arguments))
        except ArithmeticError as error:
            future.set_exception(error)
        return future

    def shutdown(self, wait=True, cancel_futures=False):
        pass

    def _answer(self, function, first, *rest):
        if function is not solve_one:
            return np.eye(6)
        headings, want, theta = rest
        self.asked.append((round(first, 6), tuple(np.round(np.degrees(headings), 6)), want))
        self.angles.append(theta)
        if first == self.stopping:
            raise KeyboardInterrupt
        if any(abs(first - w) < 1e-9 for w in self.failing):
            raise ZeroDivisionError("nothing\nto divide by")
        angles = 0 if theta is None else len(theta)
        size = {"wave_direction": len(headings), "theta": angles, "drift_dof": 3}
        shapes = {name: [size.get(axis, 6) for axis in QUANTITIES[name][0][1:]] for name in want}
        return {name: np.full(shape, first, QUANTITIES[name][2]) for name, shape in shapes.items()}


def frequencies(executor):
    return [omega for omega, _, _ in executor.asked]


def test_a_finished_database_asks_for_nothing(tmp_path):
    path, first, second = tmp_path / "box.h5", MadeUp(), MadeUp()
    outcome = solve(scene(), path, executor=first)
    assert outcome.exit_status == 0 and outcome.stored == outcome.total == 3
    assert frequencies(first) == [0.4, 0.8, 1.2]
    before = path.read_bytes()
    assert solve(scene(), path, executor=second).exit_status == 0
    assert second.asked == [] and path.read_bytes() == before


def test_only_what_is_wanted_is_asked_for(tmp_path):
    executor = MadeUp()
    solve(scene(want=["added_mass"]), tmp_path / "box.h5", executor=executor)
    assert {want for _, _, want in executor.asked} == {frozenset({"added_mass"})}
    assert {headings for _, headings, _ in executor.asked} == {()}


def test_more_frequencies_headings_and_products_ask_for_no_more_than_these(tmp_path):
    path = tmp_path / "box.h5"
    solve(scene(), path, executor=MadeUp())
    wider = MadeUp()
    solve(scene(waves={"omegas": [0.4, 0.6], "headings_deg": [0, 90]}), path, executor=wider)
    assert frequencies(wider) == [0.6]
    turned = MadeUp()
    solve(scene(waves={"omegas": [0.4], "headings_deg": [0, 45]}), path, executor=turned)
    assert frequencies(turned) == [0.4, 0.6, 0.8, 1.2]
    assert {headings for _, headings, _ in turned.asked} == {(45.0,)}
    assert {want for _, _, want in turned.asked} == {frozenset({"drift_force", "drift_force_fixed"})}
    more = MadeUp()
    solve(scene(want=["rao"]), path, executor=more)
    assert {want for _, _, want in more.asked} == {frozenset({"rao"})}
    assert open_database(path).complete
    np.testing.assert_allclose(open_database(path)["rao"][:, 0, 0], open_database(path).omega)


def test_a_frequency_that_fails_is_named_and_retried_and_the_others_are_stored(tmp_path):
    path = tmp_path / "box.h5"
    outcome = solve(scene(), path, executor=MadeUp(failing=[0.8]))
    assert outcome.exit_status == 1 and outcome.stored == 2
    assert outcome.failures == ((0.8, "ZeroDivisionError: nothing to divide by"),)
    np.testing.assert_allclose(open_database(path).omega, [0.4, 1.2])
    again = MadeUp()
    assert solve(scene(), path, executor=again).exit_status == 0
    assert frequencies(again) == [0.8]


def test_ctrl_c_before_the_first_result_leaves_everything_pending(tmp_path):
    path = tmp_path / "box.h5"
    outcome = solve(scene(), path, executor=MadeUp(stopping=0.8))
    assert outcome.exit_status == 130
    assert [row.omega for row in pending(path).rows] == [0.4, 0.8, 1.2]
    again = MadeUp()
    assert solve(scene(), path, executor=again).exit_status == 0
    assert set(frequencies(again)) <= {0.4, 0.8, 1.2}


def test_ctrl_c_at_the_last_frequency_leaves_all_of_it_and_stops_what_follows(tmp_path, heard):
    class Pressed(Future):
        def result(self, timeout=None):
            signal.raise_signal(signal.SIGINT)
            return super().result(timeout)

    class Late(MadeUp):
        def submit(self, function, problem, *arguments):
            if function is solve_one:
                return super().submit(function, problem, *arguments)
            limit = Pressed()  # which comes last
            limit.set_result(np.eye(6))
            return limit

    outcome = solve(scene(), tmp_path / "box.h5", executor=Late())
    assert outcome.interrupted and outcome.stored == outcome.total and outcome.exit_status == 0


def test_ctrl_c_while_there_is_nothing_to_solve_stops_what_follows(tmp_path, monkeypatch):
    solve(scene(), tmp_path / "box.h5", executor=MadeUp())
    monkeypatch.setattr(run, "ctrl_c", lambda say: nullcontext(SimpleNamespace(asked=True)))
    outcome = solve(scene(), tmp_path / "box.h5", executor=MadeUp())
    assert outcome.interrupted and outcome.jobs == 0 and outcome.exit_status == 0


def test_another_scene_is_refused_by_name_and_replaced_when_fresh(tmp_path):
    path = tmp_path / "box.h5"
    solve(scene(), path, executor=MadeUp())
    before = path.read_bytes()
    deeper = scene(water={"depth": 25.0})
    with pytest.raises(ValueError, match=r"water.depth was 20.0, is 25.0; give --fresh") as caught:
        solve(deeper, path, executor=MadeUp())
    assert "\n" not in str(caught.value) and path.read_bytes() == before
    assert solve(deeper, path, executor=MadeUp(), fresh=True).exit_status == 0
    assert open_database(path).water_depth == 25.0


def test_a_file_of_something_else_is_left_alone(tmp_path):
    path = tmp_path / "box.h5"
    path.write_text("my notes")
    with pytest.raises(ValueError, match="not an HDF5 file"):
        solve(scene(), path, executor=MadeUp())
    with pytest.raises(ValueError, match="is not replaced"):
        solve(scene(), path, executor=MadeUp(), fresh=True)
    assert path.read_text() == "my notes"


def test_a_body_without_inertia_has_no_motions_and_says_so(tmp_path):
    body = {"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0}
    outcome = solve(scene(bodies=[body]), tmp_path / "box.h5", executor=MadeUp())
    assert any("gyration" in remark for remark in outcome.remarks)
    with pytest.raises(ValueError, match=r"no drift_force; .*--gyration"):
        open_database(tmp_path / "box.h5").require("drift_force")


def test_the_database_knows_the_body(tmp_path):
    solve(scene(), tmp_path / "box.h5", executor=MadeUp())
    db = open_database(tmp_path / "box.h5")
    assert db.dimensions == {"length": 40.0, "beam": 20.0, "draft": 5.0}
    np.testing.assert_allclose(db.displaced_volume, 4000.0, rtol=1e-12)
    np.testing.assert_allclose(db.mass, 1025 * 4000.0, rtol=1e-12)
    np.testing.assert_allclose(np.diag(db.inertia_matrix)[:4] / db.mass, [1, 1, 1, 36], rtol=1e-9)
    assert "length = 40.0" in db.attributes["scene"]


def test_kochin_functions_have_the_angles_of_the_file_and_drift_its_own(tmp_path):
    drift, kochin = MadeUp(), MadeUp()
    solve(scene(), tmp_path / "drift.h5", executor=drift)
    assert drift.angles == [None] * 3
    solve(scene(want=["kochin"]), tmp_path / "kochin.h5", executor=kochin)
    theta = open_database(tmp_path / "kochin.h5")["theta"]
    assert all(np.array_equal(angles, theta) for angles in kochin.angles)


def test_shorter_waves_come_into_a_file_with_kochin_functions_at_fewer_angles(tmp_path):
    """They are carried to as many angles as the shortest waves need, and every number is what was stored"""
    long = {"bodies": [{"shape": "box", "length": 1000.0, "beam": 20.0, "draft": 5.0}], "panels": 4000}
    short = {**long, "waves": {"omegas": [1.2, 1.8], "headings_deg": [0, 90]}}
    for want in (["radiation", "drift"], ["kochin"]):
        path = tmp_path / f"{want[0]}.h5"
        solve(scene(**long, want=want), path, executor=MadeUp())
        before = open_database(path)["theta"]
        assert solve(scene(**short, want=want), path, executor=MadeUp()).exit_status == 0
        db = open_database(path)
        assert len(db.omega) == 4 and all(np.isfinite(db[name]).all() for name in db.names)
        assert (len(db["theta"]) > len(before)) is (want == ["kochin"])


def test_executors_are_local_or_a_number_of_processes():
    executor_of("local").shutdown()
    for text in ("processes", "processes:0", "processes:many", "threads:2", ""):
        with pytest.raises(ValueError, match="processes:N"):
            executor_of(text)


def test_a_run_opens_its_file_once_and_again_only_where_it_is_written_anew(tmp_path, monkeypatch):
    opened, path = [], tmp_path / "box.h5"
    init = h5py.File.__init__

    def counted(file, name, *rest, **more):
        opened.extend([name] if isinstance(name, str | Path) else [])  # else a handle of an open one
        init(file, name, *rest, **more)

    monkeypatch.setattr(h5py.File, "__init__", counted)
    wider = scene(waves={"omegas": [0.4, 0.6, 0.8, 1.2], "headings_deg": [0, 90]})
    for asked, times in ((scene(), 2), (scene(), 1), (wider, 3)):
        opened.clear()
        assert solve(asked, path, executor=MadeUp()).exit_status == 0
        assert len(opened) == times


def test_two_runs_that_begin_together_do_not_lose_the_work_of_one_in_silence(tmp_path, monkeypatch):
    """The second finds the file that the first made while it planned; a file that goes away below a run is told too"""
    path, planned = tmp_path / "box.h5", run.planned

    def planned_while_another_begins(given):
        plan = planned(given)
        monkeypatch.setattr(run, "planned", planned)
        solve(scene(), path, executor=MadeUp())
        return plan

    monkeypatch.setattr(run, "planned", planned_while_another_begins)
    late = MadeUp()
    with pytest.raises(DatabaseError, match="was made by another run just now; run the same command again"):
        solve(scene(), path, executor=late)
    assert late.asked == [] and open_database(path).rows.all()

    class Replaced(MadeUp):
        def submit(self, *given):
            copy = tmp_path / "copy.h5"
            copy.write_bytes(path.read_bytes())
            copy.replace(path)
            return super().submit(*given)

    with pytest.raises(DatabaseError, match="was removed or replaced during this run"):
        solve(scene(), path, fresh=True, executor=Replaced())
