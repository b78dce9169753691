"""Ways that commands seldom go: faults of memory and pipes, Ctrl-C, workers, old files, bodies that bend, odd lines."""

import math
import os
import signal
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Components
from hakobune.mooring.lines.system.parts import Anchor, CompositeLine, Fairlead, FreePoint, LineType, UniformLine
from hakobune.pipelines import cli, doctor, start
from hakobune.pipelines.common import interrupt
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.weather import seas
from hakobune.pipelines.design import project_checks as of_project
from hakobune.pipelines.exchange import flags as of_flags
from hakobune.pipelines.executors import cluster, processes
from hakobune.pipelines.line_dynamics import parts
from hakobune.pipelines.lines import lines_quantities, lines_result, system_file
from hakobune.pipelines.moor import checked, lines_file
from hakobune.pipelines.response import findings as of_response
from hakobune.pipelines.response.study import StationTable
from hakobune.pipelines.simulate import result as of_run
from hakobune.pipelines.simulate import run as of_runs
from hakobune.pipelines.simulate import study as of_study
from hakobune.pipelines.single_point import running
from hakobune.pipelines.site.result import _number
from hakobune.pipelines.solve import large
from hakobune.pipelines.solve.bending import modes
from hakobune.pipelines.sweep.one_case import kept

# ------------------------------------------------------------------ how a command ends


@pytest.mark.parametrize("fault, status, says", [
    (MemoryError(), 2, "hakobune sea: there is not enough memory: the request exceeds the free memory"),
    (MemoryError("3 GB"), 2, "hakobune sea: there is not enough memory: 3 GB"),
    (ValueError("two\n lines"), 2, "hakobune sea: two lines"), (OSError("no disk"), 2, "hakobune sea: no disk"),
    (ImportError("no numba"), 2, "hakobune sea: no numba"), (KeyboardInterrupt("half"), 130, "hakobune sea: half"),
    (KeyboardInterrupt(), 130, "hakobune sea: interrupted"),
    (ValueError("a" * 600), 2, f"hakobune sea: {'a' * 100}…"), (ValueError("a" * 499), 2, f"hakobune sea: {'a' * 499}"),
    (ValueError("word " * 2000), 2, f"hakobune sea: {'word ' * 1000}"),
])  # fmt: skip
def test_a_fault_is_one_line_and_a_status(fault, status, says, monkeypatch, capsys):
    def failing(*_, **__):
        raise fault

    monkeypatch.setattr(cli, "app", failing)
    assert cli.main(["sea"]) == status
    assert capsys.readouterr().err.removesuffix("\n") == says


def test_a_reader_that_has_gone_is_no_fault(monkeypatch, capsys):
    def failing(*_, **__):
        raise BrokenPipeError

    done = []
    monkeypatch.setattr(cli, "app", failing)
    monkeypatch.setattr(cli.os, "dup2", lambda a, b: done.append(b))
    monkeypatch.setattr(cli.sys, "stdout", SimpleNamespace(fileno=lambda: 77, flush=lambda: None))
    assert cli.main(["sea"]) == 128 + signal.SIGPIPE and done == [77] and capsys.readouterr().err == ""


def test_a_database_of_beams_is_drawn_with_their_bending(monkeypatch, tmp_path, capsys):
    drawn = []
    monkeypatch.setattr("hakobune.bem.bodies.one_of_several.each_body", lambda db: db.each)
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: db)
    monkeypatch.setattr("hakobune.pipelines.view.plots.plot", lambda one, path: drawn.append(path.name))
    monkeypatch.setattr("hakobune.pipelines.view.deflection.deflections", lambda one, path: drawn.append(path.name))
    monkeypatch.setattr("hakobune.pipelines.view.deflection.beams_of", lambda db: db.beams)
    monkeypatch.setattr("hakobune.pipelines.common.gaps.gaps_of", lambda db: SimpleNamespace(words=lambda: ["a gap"]))
    one, two = SimpleNamespace(name="p"), SimpleNamespace(name="q")
    db = SimpleNamespace(each=[one, two], bodies=[one, two], beams=[1])
    assert cli.plot(tmp_path / "b.h5") == 1
    wanted = ["b_p.png", "b_q.png", "b_bending.png"]
    assert drawn == wanted and [Path(line).name for line in capsys.readouterr().out.split()][:3] == wanted
    db.bodies, db.each, db.beams = [], [one], []
    cli.plot(tmp_path / "b.h5")
    assert drawn[3:] == ["b.png"]


def test_without_the_library_of_tables_what_is_amiss_is_still_told(monkeypatch, capsys):
    monkeypatch.setattr(doctor, "_version", lambda name: None if name in ("rich", "h5py") else "1")
    for name in ("_gmsh", "_cache", "_left_over"):
        monkeypatch.setattr(doctor, name, lambda: "")
    assert doctor.doctor() == 1
    assert "h5py is missing: pip install h5py" in capsys.readouterr().out


def test_ctrl_c_before_anything_is_loaded_is_one_line(monkeypatch):
    said = []
    monkeypatch.setattr(start.os, "write", lambda where, words: said.append((where, words)))
    monkeypatch.setattr(start.os, "_exit", said.append)
    start._leave(2, None)
    assert said == [(2, b"hakobune: interrupted\n"), 130]


@pytest.mark.parametrize("words, threads, timed", [(["solve", "x"], None, False), (["moor", "solve"], "1", False),
                                                   (["moor", "--timing"], "1", True)])  # fmt: skip
def test_a_command_that_solves_large_systems_keeps_its_threads(words, threads, timed, monkeypatch):
    begun = []
    monkeypatch.setattr(sys, "argv", ["hakobune", *words])
    monkeypatch.setattr(start.signal, "signal", lambda *given: None)
    monkeypatch.setattr(start.timing, "begin", lambda: begun.append(1))
    monkeypatch.setattr(cli, "main", lambda: 5)
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("hakobune.bem.kernels.jit.before_first_kernel", lambda call: None)
    assert start.main() == 5 and bool(begun) == (timed and start.timing.FLAG == "--timing")
    assert os.environ.get("OMP_NUM_THREADS") == os.environ.get("OPENBLAS_NUM_THREADS") == threads
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.pop(name, None)


class Frame:
    def __init__(self, name, back=None):
        self.f_code, self.f_back = SimpleNamespace(co_filename=name), back


OURS, OTHERS = str(interrupt.ROOT / "bem" / "waves.py"), "/usr/lib/python3/other.py"
LOADING = "<frozen importlib._bootstrap>"


@pytest.mark.parametrize("frames, waited, raised", [
    ([OURS], 0.0, True), ([OTHERS], 0.0, False), ([OTHERS, OURS], 0.0, False), ([OTHERS], 1e3, True),
    ([OURS, LOADING], 1e3, False), ([LOADING, OURS], 0.0, False), ([], 0.0, False), ([], 1e3, True),
])  # fmt: skip
def test_ctrl_c_waits_while_others_are_at_work_but_not_for_ever_and_while_modules_are_loaded(
    frames, waited, raised, monkeypatch
):
    """The innermost frame first; it asks again after a while, and patience begins with the first request"""
    asked, frame = [], None
    for name in reversed(frames):
        frame = Frame(name, frame)
    monkeypatch.setattr(interrupt.signal, "signal", lambda number, handler: asked.append(handler))
    monkeypatch.setattr(interrupt.signal, "setitimer", lambda which, seconds: asked.append(seconds))
    clock = [50.0]
    monkeypatch.setattr(interrupt.time, "monotonic", lambda: clock[0])
    handler = interrupt.Interrupt()
    if waited:
        handler(2, Frame(OTHERS))
        assert asked == [handler, interrupt.AGAIN] and handler.asked == 50.0
        asked.clear()
        clock[0] += waited
    if raised:
        with pytest.raises(KeyboardInterrupt):
            handler(2, frame)
        assert handler.asked is None and not asked
    else:
        handler(2, frame)
        assert asked == [handler, interrupt.AGAIN] and handler.asked == clock[0]


# ------------------------------------------------------------------ workers


def test_processes_leave_ctrl_c_to_their_parent_and_have_their_share_of_threads(monkeypatch):
    begun, set_to = [], []
    monkeypatch.setattr(processes.signal, "signal", lambda *given: begun.append(given))
    thread = SimpleNamespace(start=lambda: begun.append("started"))
    monkeypatch.setattr(processes.threading, "Thread", lambda target, daemon: set_to.append((target, daemon)) or thread)
    monkeypatch.setattr(processes.os, "environ", {})
    processes._start(3)
    assert begun == [(signal.SIGINT, signal.SIG_IGN), "started"] and set_to == [(processes._end_with_parent, True)]
    assert processes.os.environ == dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "3")
    ended = []
    monkeypatch.setattr(processes.multiprocessing, "parent_process", lambda: SimpleNamespace(sentinel=7))
    monkeypatch.setattr(processes, "wait", ended.append)
    monkeypatch.setattr(processes.os, "_exit", ended.append)
    processes._end_with_parent()
    assert ended == [[7], 1]


class Client:
    def __init__(self, address="", timeout=None, workers=2, fault=None):
        self.closed, self.workers, self.waited = 0, workers, []
        self.address, self.timeout = address, timeout

    def scheduler_info(self, n_workers):
        assert n_workers == -1
        return {"workers": [1] * self.workers}

    def wait_for_workers(self, count):
        self.waited.append(count)

    def submit(self, function, *arguments, pure):
        assert pure is False
        return function(*arguments)

    def close(self):
        self.closed += 1


def test_a_cluster_of_others_is_left_and_one_of_ones_own_is_ended(monkeypatch):
    made = []
    library = SimpleNamespace(Client=lambda *given, **more: made.append(Client(*given, **more)) or made[-1])
    monkeypatch.setattr(cluster, "_imported", lambda text: (None, library))
    found = cluster.there("dask://h:1", "h:1")
    assert found.count == 2 and (made[0].address, made[0].timeout) == ("tcp://h:1", 10)
    assert found.submit(max, 3, 5) == 5
    found.shutdown()
    assert made[0].closed == 1
    empty = Client(workers=0)
    library.Client = lambda *given, **more: empty
    with pytest.raises(ValueError, match="the scheduler has no workers; start some with: dask worker h:1"):
        cluster.there("dask://h:1", "h:1")
    assert empty.closed == 1
    for fault, reason in ((OSError("timed out\nmore"), r"\(timed out\)"), (OSError(), r"\(OSError\)")):

        def failing(*_, fault=fault, **__):
            raise fault

        library.Client = failing
        with pytest.raises(ValueError, match=f"no scheduler answers {reason}; start one with: dask scheduler"):
            cluster.there("dask://h:1", "h:1")
    own, client = Client(), Client(workers=0)
    one = cluster.Dask(client, own)
    one.shutdown()
    assert one.count == 1 and (own.closed, client.closed) == (1, 1)


def test_jobs_of_slurm_are_workers_with_one_thread(monkeypatch):
    asked, client = {}, Client()
    jobs = SimpleNamespace(scale=lambda jobs: asked.update(scaled=jobs), close=lambda: None)
    library = SimpleNamespace(SLURMCluster=lambda **words: asked.update(words) or jobs)
    monkeypatch.setitem(sys.modules, "dask_jobqueue", library)
    monkeypatch.setattr(cluster, "_imported", lambda text: (None, SimpleNamespace(Client=lambda own: client)))
    monkeypatch.setattr("shutil.which", lambda name: None)
    with pytest.raises(ValueError, match="executor 'slurm:4': sbatch is not found"):
        cluster.slurm("slurm:4", 4)
    monkeypatch.setattr("shutil.which", lambda name: f"/usr/bin/{name}")
    assert cluster.slurm("slurm:4", 4).count == 2
    assert asked["scaled"] == 4 and (asked["cores"], asked["processes"]) == (1, 1) and client.waited == [1]
    assert "export OMP_NUM_THREADS=1" in asked["job_script_prologue"]
    monkeypatch.setitem(sys.modules, "dask_jobqueue", None)
    with pytest.raises(ValueError, match=r"executor 'slurm:4' needs dask-jobqueue; install it with"):
        cluster.slurm("slurm:4", 4)


# ------------------------------------------------------------------ runs in time


def test_a_run_without_a_file_is_kept_in_a_folder_that_goes(monkeypatch):
    asked = []
    monkeypatch.setattr(of_run, "executor_of", lambda name: SimpleNamespace(shutdown=lambda **_: asked.append(name)))
    monkeypatch.setattr(of_run, "input_of", lambda study: f"input of {study}")
    monkeypatch.setattr(of_run, "database_of", lambda path: f"open {path}")
    outcome = SimpleNamespace(interrupted=False, failures=[(3, "no line")])
    monkeypatch.setattr(of_run, "fill", lambda *given: asked.append(given) or outcome)
    monkeypatch.setattr(of_run, "read_run", lambda *given: given)
    path, window, failed = of_run.simulate("s", "db", seeds=2, duration=60.0, executor="two", window=30.0)
    study, db, output, console, _, seeds, duration, fresh, asked_window = asked[0]
    assert (study, db, seeds, duration, fresh, asked_window) == ("input of s", "open db", 2, 60.0, False, 30.0)
    assert output == path and path.name == "run.h5" and not path.parent.exists() and console is None
    assert window == 30.0 and failed == ("FAILS: seed 3: no line",) and asked[1] == "two"
    outcome.interrupted = True
    with pytest.raises(KeyboardInterrupt):
        of_run.simulate("s", "db")
    assert asked[-1] == "local" and str(of_run.NoWholeRun("every seed failed", ["x"])) == "every seed failed"


@pytest.mark.parametrize("known, says", [
    ("{0} abc", None), ("{0} other", "belongs to another study or database"), ("old abc", "by an earlier version"),
    ("{0}abc", "by an earlier version"),
])  # fmt: skip
def test_runs_of_a_file_are_continued_by_its_own_study_alone(known, says, monkeypatch, tmp_path):
    from contextlib import nullcontext

    class File(dict):
        attrs = {"identity": known.format(of_runs.IDENTITY)}  # noqa: RUF012

    path = tmp_path / "run.h5"
    monkeypatch.setattr(of_runs, "opened", lambda path: nullcontext(File(seed=np.array([1, 2, 3]))))
    monkeypatch.setattr(of_runs, "whole_rows", lambda file: np.array([True, False, True]))
    plan, own = SimpleNamespace(seeds=(1, 2, 3, 4)), f"{of_runs.IDENTITY} abc"
    assert of_runs._missing(path, own, plan, False) == [1, 2, 3, 4]
    path.touch()
    assert of_runs._missing(path, own, plan, True) == [1, 2, 3, 4]
    if says is None:
        assert of_runs._missing(path, own, plan, False) == [2, 4]
    else:
        with pytest.raises(of_runs.DatabaseError, match=says):
            of_runs._missing(path, own, plan, False)


def test_progress_within_a_seed_is_told_now_and_then_and_hears_a_request_to_stop(monkeypatch):
    settings = SimpleNamespace(duration=100.0, ramp=20.0)
    stop, clock, said = SimpleNamespace(asked=False), [0.0], []
    monkeypatch.setattr(of_runs.time, "perf_counter", lambda: clock[0])
    one = of_runs._Progress(None, 3, SimpleNamespace(settings=settings), stop)
    one._say = lambda words, done: said.append((words, done))
    one.inside(0.5)
    clock[0] = of_runs.AFTER + 1
    for share in (0.0, 0.25, 1.0):
        one.inside(share)
    one.step(7, None)
    one.inside(0.5)
    one.step(8, ValueError())
    assert one.length == 120.0
    assert said == [(" 25 % of a seed", 0.25), ("seed 7", 1), (" 50 % of a seed", 1.5), ("seed 8 failed", 2)]
    stop.asked = True
    with pytest.raises(KeyboardInterrupt):
        one.inside(0.5)


def record_of(monkeypatch, shortest=None, every=((0.5, 2.0), (1.0, 1.0)), length=1000.0, current=None):
    """Components of a record of waves (ω, a), of which those at least as long as `shortest` are taken"""
    asked = []
    step = 0.5
    record = SimpleNamespace(step=step, elevation=np.zeros(round(length / step) + 1))
    record._replace = lambda elevation: SimpleNamespace(step=step, elevation=elevation)
    monkeypatch.setattr("hakobune.mooring.environment.wave_records.read_record", lambda path: record)

    def components(first, towards, period):
        asked.append((len(first.elevation), period))
        chosen = np.array([one for one in every if 2 * np.pi / one[0] >= period]).reshape(-1, 2)
        return Components(chosen[:, 0], chosen[:, 1], 0 * chosen[:, 0], 0 * chosen[:, 0])

    monkeypatch.setattr("hakobune.mooring.environment.wave_records.components_of", components)
    monkeypatch.setattr(of_study, "direction", lambda where, table: 0.0)
    monkeypatch.setattr(of_study, "carrier_of", lambda given: current)
    study = SimpleNamespace(
        waves=None, water=SimpleNamespace(depth=20.0), conditions=lambda: SimpleNamespace(current=1)
    )
    table = SimpleNamespace(sea=[], qtf="auto", record=SimpleNamespace(file="r.csv", shortest=shortest))
    settings = SimpleNamespace(ramp=100.0, duration=500.0)
    return of_study._record(study, table, settings, np.array([0.3, 1.2]), Path()), asked


def test_a_record_is_taken_to_the_end_of_the_run_with_the_waves_that_are_stored(monkeypatch):
    """600 s of steps of 0.5 s are 1201 values; the shortest wave is that of 1.2 rad/s"""
    (found, told), asked = record_of(monkeypatch)
    assert found.omega.tolist() == [0.5, 1.0] and told == ()
    assert [count for count, _ in asked] == [1201, 1201]
    assert asked[0][1] == 0.0 and asked[1][1] == pytest.approx(2 * np.pi / 1.2, rel=1e-6)
    with pytest.raises(StudyError, match=r"lasts 599.5 s; allowed: ramp and duration, 600 s, or longer"):
        record_of(monkeypatch, length=599.5)
    record_of(monkeypatch, length=600.0)


@pytest.mark.parametrize("shortest, way", [(None, "solve 1.5 rad/s and less"), (5.0, "give a shorter shortest")])
def test_energy_of_a_record_that_is_left_out_is_told_with_the_way_in(shortest, way, monkeypatch):
    """Amplitudes 2, 1 and 0.5 m: 0.25 of 5.25 is 4.76 %"""
    (found, told), _ = record_of(monkeypatch, shortest, ((0.5, 2.0), (1.0, 1.0), (1.5, 0.5)))
    period = 2 * np.pi / 1.2 if shortest is None else shortest
    assert len(found.omega) == 2
    assert told == (f"4.76 % of the record's energy is of waves below {period:.3g} s, left out; {way}",)


def test_long_waves_of_a_record_outside_what_is_stored_are_told(monkeypatch):
    """Of amplitudes 1 and 2 m the first at 0.2 rad/s: 1 of 5 is 20 %"""
    (_, told), _ = record_of(monkeypatch, None, ((0.2, 1.0), (1.0, 2.0)))
    assert told[0].startswith("20 % of the record's energy lies outside the stored frequencies, 0.3 to 1.2 rad/s")
    assert told[0].endswith("solve 0.2 rad/s and above") and len(told) == 1


def test_a_record_on_a_current_has_the_frequencies_that_a_place_meets(monkeypatch):
    seen = []
    carrier = SimpleNamespace(_replace=lambda absolute: f"absolute {absolute}")
    monkeypatch.setattr(of_study, "in_water", lambda found, *given: seen.append(given) or found)
    record_of(monkeypatch, current=carrier)
    assert seen == [("absolute True", 20.0, 9.80665)]


@pytest.mark.parametrize("every, says", [
    (((2.0, 1.0),), "has no waves of 5.236 s or longer; lower shortest"),
    (tuple((0.4 + 1e-5 * k, 1.0) for k in range(of_study.MOST_OF_RECORD + 1)), f"allowed: {of_study.MOST_OF_RECORD};"),
])  # fmt: skip
def test_a_record_has_some_waves_and_not_too_many(every, says, monkeypatch):
    with pytest.raises(StudyError) as refused:
        record_of(monkeypatch, None, every)
    assert says in str(refused.value)


def test_a_body_at_a_single_point_meets_components_of_its_sea(monkeypatch):
    """Its attachment at 3 m lies 5 m above the centre of its database at −2 m"""
    monkeypatch.setattr(running, "sea_with_swell", lambda where, waves, depth: (where, waves, depth))
    monkeypatch.setattr(running, "in_sea", lambda reader, sea: (f"{reader} in {sea[1]}", None))
    monkeypatch.setattr(running, "waves_carrier", lambda study: "carrier")
    monkeypatch.setattr(running, "sea_components", lambda *given: given)
    monkeypatch.setattr(running, "wave_body", lambda *given: given)
    study = SimpleNamespace(waves="waves", attachment=SimpleNamespace(z=3.0),
                            slewing=SimpleNamespace(components=50, seed=4))  # fmt: skip
    db = SimpleNamespace(water_depth=30.0, rotation_center=(1.0, 2.0, -2.0), reader="body")
    body, components, lever, carrier = running._wave_body(study, db)
    assert (body, lever, carrier) == ("body in waves", 5.0, "carrier")
    assert components == (("waves", "waves", 30.0), 50, 4, "body", "carrier")

    def refused(*_):
        raise ValueError("too little")

    monkeypatch.setattr(running, "sea_components", refused)
    with pytest.raises(StudyError, match="too little"):
        running._components(study, db)


# ------------------------------------------------------------------ responses, sites, projects


class Beams:
    """A database of two bodies, of which the second is a beam from −10 to 20 m"""

    def __init__(self, monkeypatch, names=("p", "q")):
        class Beam:
            start, end = -10.0, 20.0

        monkeypatch.setattr("hakobune.bem.flexible.beams.Beam", Beam)
        self.bodies = [SimpleNamespace(name=name) for name in names]
        other = SimpleNamespace(body=0, shape=object())
        self.modes = [other, SimpleNamespace(body=len(names) - 1 if names else 0, shape=Beam())]


def test_stations_lie_on_a_beam_with_both_its_ends(monkeypatch):
    db = Beams(monkeypatch)
    made = StationTable([-10.0, 3.5, 20.0], "q").stations("response.stations", db)
    assert [(one.x, one.body) for one in made] == [(-10.0, "q"), (3.5, "q"), (20.0, "q")]
    assert made[1][0] == "q x 3.5"
    for table, says in (
        (StationTable([20.1], "q"), "s.x has 20.1; allowed: -10 to 20, the beam"),
        (StationTable([-10.1], "q"), "s.x has -10.1"), (StationTable([0.0], "p"), "s is given, but p is not a beam"),
        (StationTable([0.0], "r"), "s.body is 'r'; allowed: p, q"), (StationTable([0.0]), "allowed: p, q"),
    ):  # fmt: skip
        with pytest.raises(StudyError) as refused:
            table.stations("s", db)
        assert says in str(refused.value)
    alone = Beams(monkeypatch, ())
    assert StationTable([1.0]).stations("s", alone)[0][0] == "x 1"
    with pytest.raises(StudyError, match="allowed: no key body, since there is one body"):
        StationTable([1.0], "p").stations("s", alone)
    alone.modes = []
    with pytest.raises(StudyError, match="the body is not a beam"):
        StationTable([1.0]).stations("s", alone)


def test_what_is_left_out_of_slow_drift_is_told():
    slow = SimpleNamespace(difference=[0.1, 0.35], by_current=1, damping=None)
    assert [line[:28] for line in of_response._of_drift(slow)] == [
        "slow drift: difference frequ", 'current.waves = "still" excl', "wave drift damping is left o",
    ]  # fmt: skip
    slow.by_current, slow.damping = None, 2
    assert len(of_response._of_drift(slow)) == 1
    assert of_response._of_drift(None) == ["no drift: the database has no drift_force"]


@pytest.mark.parametrize("key, value, si, unit", [
    ("direction_deg", 90.0, math.pi / 2, "rad"), ("wind_speed", 20.0, 20.0, "m/s"), ("peak_period", 9.0, 9.0, "s"),
    ("height", 3.0, 3.0, "m"), ("gamma", 3.3, 3.3, ""),
])  # fmt: skip
def test_values_of_a_state_are_in_si(key, value, si, unit):
    one = _number("words", key, value, "storm")
    assert (float(one.values), one.unit) == (pytest.approx(si), unit)


def test_the_mean_period_of_a_sea_of_a_file_is_that_of_its_spectrum():
    table = SimpleNamespace(file="s.txt")
    table.sea = lambda where, depth: SimpleNamespace(spectrum=SimpleNamespace(T01=depth / 4))
    assert seas.mean_period("sea", table, 30.0) == 7.5


def test_swell_and_wear_of_a_project_are_tried_before_anything_is_run():
    asked = []
    swell = [SimpleNamespace(sea=lambda where, depth: asked.append((where, depth))) for _ in range(2)]
    of_project._check_waves("w", SimpleNamespace(file="f", swell=swell), 30.0)
    assert asked == [("w.swell[0]", 30.0), ("w.swell[1]", 30.0)]
    wear = SimpleNamespace(mm_per_year=0.3, years=0.0)
    project = SimpleNamespace(wear=wear, project=SimpleNamespace(service_life=None))
    with pytest.raises(StudyError, match=r"wear.years is 0"):
        of_project._check_wear(project, {})
    wear.years = 0.1
    of_project._check_wear(project, {})
    with pytest.raises(StudyError, match=r"types.a.corrosion_mm are both given"):
        of_project._check_wear(project, {"types": {"a": {"corrosion_mm": 1.0}}})


# ------------------------------------------------------------------ lines


@pytest.mark.parametrize("text, found", [
    (None, (0.0, math.inf)), ("0.2:1.5", (0.2, 1.5)), ("0.2:", (0.2, math.inf)), (":1.5", (0.0, 1.5)), ("0:1", (0, 1)),
    ("0.2", None), ("1.5:0.2", None), ("1:1", None), ("-1:2", None), ("a:b", None), ("nan:1", None),
])  # fmt: skip
def test_frequencies_are_taken_from_one_to_another(text, found):
    if found:
        assert of_flags._from_to(text) == found
    else:
        with pytest.raises(ValueError, match=f"--frequencies is '{text}'; allowed: from:to in rad/s"):
            of_flags._from_to(text)


KIND = LineType("chain", 900.0, 1e8, 80.0, 0.1, 5e6)


def test_types_of_a_file_are_kept_once_and_apart_where_they_differ():
    types = {}
    for load, friction, wanted in (
        (5e6, 0.5, "chain"),
        (5e6, 0.5, "chain"),
        (6e6, 0.5, "chain 2"),
        (5e6, 0.6, "chain 3"),
        (6e6, 0.5, "chain 2"),
        (math.inf, 0.5, "chain 4"),
    ):
        line = SimpleNamespace(bed_friction=friction)
        assert lines_file._type(types, replace(KIND, breaking_load=load), 1e8, line) == wanted
    assert types["chain"] == {"weight_N_per_m": 900.0, "bed_friction": 0.5, "axial_stiffness_kN": 1e5,
                              "breaking_load_kN": 5e3, "mass_kg_per_m": 80.0, "diameter": 0.1}  # fmt: skip
    bare = LineType("", 900.0)
    assert lines_file._type(types, bare, math.inf, SimpleNamespace(bed_friction=0.0)) == "line"
    assert types["line"] == {"weight_N_per_m": 900.0, "bed_friction": 0.0}


def test_segments_of_a_line_run_from_its_anchor_and_odd_lines_are_refused():
    from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment

    low, high = Segment(60.0, 900.0, 5e7, name="low"), Segment(25.0, 300.0, 2e7, name="high")
    line = CompositeLine("n", (low, high), "a", "b")
    assert [one["type"] for one in lines_file._parts(line, True, {})] == ["low", "high"]
    assert [one["length"] for one in lines_file._parts(line, False, {})] == [25.0, 60.0]
    uniform = lines_file._parts(UniformLine("n", KIND, 70.0, "a", "b", 0.4), True, types := {})
    assert uniform == [{"type": "chain", "length": 70.0}] and types["chain"]["bed_friction"] == 0.4
    table = Segment(25.0, 300.0, ((0.0, 0.0), (0.1, 1e5), (0.2, 3e5)), name="rope")
    for odd in (CompositeLine("n", (low, table), "a", "b"),
                CompositeLine("n", (low, high), "a", "b", loads=(PointLoad(60.0, 1e4, name="s"),))):  # fmt: skip
        with pytest.raises(StudyError, match="line n has its own bed, bodies between its ends or a rope"):
            lines_file._parts(odd, True, {})


@pytest.mark.parametrize("ends, says", [
    ("anchors", "line one ends at an anchor, far; allowed: a line from an anchor to the body"),
    ("joint", "line one ends at a joint of 3 lines, mid"),
])  # fmt: skip
def test_lines_of_a_file_lead_to_the_body(ends, says):
    points = [Anchor("a", (0, 0, -20.0)), Anchor("far", (50.0, 0, -20.0)), FreePoint("mid", (20.0, 0, -10.0), 1.0, 0.0),
              Fairlead("f", "ship", (0.0, 0.0, 0.0))]  # fmt: skip
    lines = {
        "anchors": [UniformLine("one", KIND, 70.0, "a", "far")],
        "joint": [UniformLine(name, KIND, 70.0, a, "mid") for name, a in (("one", "a"), ("two", "far"), ("x", "f"))],
    }
    with pytest.raises(StudyError) as refused:
        list(lines_file._chains(SimpleNamespace(points=points, lines=lines[ends])))
    assert says in str(refused.value)
    whole = [UniformLine("one", KIND, 70.0, "mid", "a"), UniformLine("two", KIND, 70.0, "mid", "f")]
    ((one, two),) = lines_file._chains(SimpleNamespace(points=points, lines=whole))
    assert (one[0].name, one[1], two[0].name, two[1]) == ("one", False, "two", True)


def test_lines_of_a_file_are_of_the_body_that_the_study_names(monkeypatch, tmp_path):
    asked = []
    monkeypatch.setattr(
        lines_file,
        "tables_of",
        lambda file, depth: asked.append((file, depth)) or {"lines": [{"name": "n"}], "types": {}},
    )
    raw = {lines_file.KEY: "m.dat", "water": {"depth": 30.0}, "name": "s"}
    laid, text = lines_file.with_lines(raw, "text", tmp_path / "s.toml")
    assert laid == {"water": {"depth": 30.0}, "name": "s", "lines": [{"name": "n"}], "types": {}}
    assert text.startswith("# s.toml with the lines of m.dat\n") and asked == [(tmp_path / "m.dat", 30.0)]
    laid, _ = lines_file.with_lines(raw | {lines_file.BODY: "ship", "water": {"depth": math.inf}}, "", tmp_path / "s")
    assert laid["lines"] == [{"name": "n", "body": "ship"}] and lines_file.BODY not in laid and asked[1][1] is None
    assert lines_file.with_lines({"name": "s"}, "text", "p") == ({"name": "s"}, "text")
    with pytest.raises(StudyError, match=f"lines and {lines_file.KEY} are both given"):
        lines_file.with_lines(raw | {"lines": []}, "", "p")


@pytest.mark.parametrize("freedom, lift, names", [
    (["Surge", "Heave"], 0.0, "Heave"), (["Surge", "Heave"], 5.0, None), (["Heave", "Roll"], 5.0, "Roll"),
    (["Heave", "Roll", "Pitch"], 0.0, "Heave, Roll, Pitch"), (["Surge", "Sway", "Yaw"], 0.0, None),
])  # fmt: skip
def test_bodies_without_water_may_not_heave_roll_or_pitch_unheld(freedom, lift, names, recwarn):
    system_file._warn_of_no_water([SimpleNamespace(name="b", freedom=freedom, force_kN=(0.0, 0.0, lift))])
    said = [str(one.message) for one in recwarn]
    assert [line.split(", but this command knows no weight and no buoyancy, so that only the lines hold it; ")[0]
            for line in said] == ([f"b is free in {names}"] if names else [])  # fmt: skip


def test_periods_of_a_body_on_lines_have_the_names_of_its_modes(monkeypatch):
    found = SimpleNamespace(period=np.array([60.0, math.nan]), names=("Surge", "Yaw"))
    monkeypatch.setattr("hakobune.mooring.studies.natural_periods.moored_periods", lambda *given: found)
    made, axes = lines_quantities.periods_of("state", "ship", "db")
    assert made["period"].values[0] == 60.0 and axes["mode"].values.tolist() == ["surge", "yaw"]
    monkeypatch.setattr(lines_result, "periods_of", lambda *given: ("periods", given))
    monkeypatch.setattr(lines_result, "line_alone", lambda *given: ("line", given))
    assert list(lines_result._asked_for("s", "ship", "stern", "db")) == [
        ("line", ("s", "stern")), ("periods", ("s", "ship", "db")),
    ]  # fmt: skip
    assert not list(lines_result._asked_for("s", "ship", None, None))


def test_regular_waves_are_held_against_stored_periods_and_headings(monkeypatch):
    asked = []
    monkeypatch.setattr(checked, "check_period", lambda waves, omega: asked.append(("period", waves, omega)))
    monkeypatch.setattr(
        checked, "check_headings", lambda body, given: asked.append(("headings", body.name, list(given)))
    )
    monkeypatch.setattr(checked, "check_coverage", lambda body, spectrum: asked.append(("coverage", spectrum)))
    body = SimpleNamespace(name="b", omega="ω")
    sea = SimpleNamespace(spectrum="S")
    for waves, method, wanted in (
        (None, "regular_wave", []), ("w", "regular_wave", [("period", "w", "ω"), ("headings", "b", ["w"])]),
        ("w", "irregular", [("coverage", "S"), ("headings", "b", [sea])]),
    ):  # fmt: skip
        asked.clear()
        checked.check_waves(body, SimpleNamespace(waves=waves, method=method, sea=sea))
        assert asked == wanted
    sea.systems = ("one", "two")
    checked.check_waves(body, SimpleNamespace(waves="w", method="irregular", sea=sea))
    assert asked[-1] == ("headings", "b", ["one", "two"])


def test_a_current_of_a_table_has_its_own_places_and_levels_between_them():
    """Straight between 0 m/s at −20 m and 2 m/s at the surface, towards 90°"""
    given = SimpleNamespace(z=[-20.0, -5.0, 0.0], speeds=[0.0, 1.5, 2.0], speed=None, speed_knots=None, exponent=0,
                            direction_deg=90.0, incidence_deg=None)  # fmt: skip
    study = SimpleNamespace(current=given, water=SimpleNamespace(depth=20.0))
    found = parts.current_of(study)
    assert found.z[0] == -20.0 and found.z[-1] == 0.0 and -5.0 in found.z
    assert len(found.z) in (parts.LEVELS, parts.LEVELS + 1) and np.all(np.diff(found.z) > 0)
    assert found.velocity[:, 1] == pytest.approx(2.0 + found.z / 10.0) and not np.abs(found.velocity[:, 0]).max() > 1e-9
    study.current = None
    assert parts.current_of(study) is None


# ------------------------------------------------------------------ bodies that bend, large problems, sweeps


@pytest.mark.parametrize("known, mass, own, wanted", [
    (True, 2e3, None, 2e3), (False, None, None, 0.0), (False, 3e3, None, 3e3), (True, None, [1.0], 0.0),
    (True, None, None, "refused"),
])  # fmt: skip
def test_shapes_without_masses_have_that_of_their_table(known, mass, own, wanted, monkeypatch):
    class Table:
        masses = own

    monkeypatch.setattr(modes, "Table", Table)
    monkeypatch.setattr(modes, "_tables", lambda scene: [SimpleNamespace(mass=mass)])
    mode = SimpleNamespace(name="m", shape=Table(), moves=(0,))
    M = np.zeros((7, 7))
    if wanted == "refused":
        with pytest.raises(modes.SceneError, match="m has no mass; give a seventh column of masses in its file"):
            modes._with_own_mass(SimpleNamespace(motions_known=known), [mode], M, 6)
    else:
        modes._with_own_mass(SimpleNamespace(motions_known=known), [mode], M, 6)
        assert M[6, 6] == wanted and np.count_nonzero(M) == (wanted != 0)


@pytest.mark.parametrize("dimensions, masses, known, told", [
    (3, [1.0], True, []), (2, [1.0], True, ["its points lie in a plane"]),
    (1, [1.0], True, ["its points lie on a line"]),
    (3, None, True, ["has no masses"]), (3, None, False, []),
])  # fmt: skip
def test_how_well_a_shape_is_known_is_told_in_per_cent(dimensions, masses, known, told, monkeypatch):
    class Table:
        def error(self, points):
            assert points.shape == (4, 3)
            return 0.0123

    shape = Table()
    shape.dimensions, shape.masses = dimensions, masses
    monkeypatch.setattr(modes, "Table", Table)
    monkeypatch.setattr(modes, "_tables", lambda scene: [SimpleNamespace(file="m.csv")])
    mode = SimpleNamespace(name="m", shape=shape, moves=(0, 1), on=False)
    monkeypatch.setattr(modes, "modes_of", lambda scene, hulls: [mode])
    hull = SimpleNamespace(whole=lambda: SimpleNamespace(centroids=np.zeros((2, 3))))
    first, *said = modes.mode_remarks(SimpleNamespace(motions_known=known), [hull, hull])
    assert first == (
        "m: its shape on the hull is uncertain by 1.2 % of its largest displacement, the difference of two splines"
    )
    assert len(said) == len(told) and all(words in line for words, line in zip(told, said, strict=True))


@pytest.mark.parametrize("seconds, told", [(0.5, ""), (120.0, ", about 2 min 00 s for each frequency")])
def test_a_long_time_for_each_frequency_is_told(seconds, told, monkeypatch):
    asked = []
    monkeypatch.setattr("hakobune.bem.panels.band.cost.seconds_alone",
                        lambda prepared, omega: asked.append(omega) or seconds)  # fmt: skip
    assert large._time_alone("prepared", [0.4, 0.9]) == told and asked == [0.9]
    one = large.Telling("console", lambda *given: given)
    assert one("another stage", "what") == ("another stage", "what")
    assert large.Telling("console")("another stage", "what") is None


def test_a_sweep_keeps_what_it_is_asked_for():
    found = {"a": 1, "b": 2}
    assert kept(found, ("b",)) == {"b": 2}
    with pytest.raises(StudyError, match="keep: 'c' is not a quantity of the result; allowed: a, b"):
        kept(found, ("c",))
