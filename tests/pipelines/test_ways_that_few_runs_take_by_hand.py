"""Ways of commands that whole runs seldom take, each by hand: kernels compiled beside, processes, climates, large
problems, bodies of several, holes in a database, lines in loops, fairleads of tables, water without a current."""

import os
import re
import signal
from dataclasses import dataclass
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.mooring.lines.system.parts import Anchor, FreePoint
from hakobune.mooring.response import climate as climates
from hakobune.pipelines import compiling
from hakobune.pipelines.common.gaps import Gaps
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds import numbers
from hakobune.pipelines.executors import choice, processes
from hakobune.pipelines.line_dynamics import moordyn
from hakobune.pipelines.line_dynamics import motion as fairleads
from hakobune.pipelines.lines import lines_quantities
from hakobune.pipelines.response import effort, solved
from hakobune.pipelines.response import study as responses
from hakobune.pipelines.single_point import loads
from hakobune.pipelines.solve import header, large

ROOT = "hakobune.pipelines"

# ------------------------------------------------------------------ compiled beside a command


class Table(msgspec.Struct):
    dynamic_lines: str | list = "auto"
    dynamic_water: str = "still"
    seeds: int = 7


class Moored(msgspec.Struct):
    simulation: Table | None
    lines: list = []
    spreads: list = []


@pytest.fixture
def compiled(monkeypatch):
    """What is run to compile for a study of moored bodies, in order"""
    monkeypatch.setattr(f"{ROOT}.moor.study.SimulationTable", Table)
    monkeypatch.setattr(f"{ROOT}.simulate.study.plan_of", lambda *given: ("plan", *given))
    monkeypatch.setattr(f"{ROOT}.simulate.study.moving_lines", lambda table: table.dynamic_lines != "none")

    def call(study, bodies=(), modes=()):
        reader = SimpleNamespace(omega="omega", words="words")
        db = SimpleNamespace(bodies=bodies, modes=modes, bodies_reader=reader)
        ran = []
        monkeypatch.setattr(f"{ROOT}.simulate.run.input_of", lambda path: (study, "text", "folder", path))
        monkeypatch.setattr(f"{ROOT}.results.given.database_of", lambda path: db if path == "base.h5" else None)
        monkeypatch.setattr(f"{ROOT}.simulate.work.with_pairs", lambda *given: ran.append(("pairs", *given)))
        monkeypatch.setattr(compiling, "_of_moving_line", lambda study: ran.append(("line", study)))
        monkeypatch.setattr(f"{ROOT}.simulate.result.simulate", lambda *a, **k: ran.append(("runs", *a, k)))
        compiling._of_simulate("study.toml", "base.h5")
        plan = ("plan", study, "omega", 1, compiling.SHORT, "folder", "words")
        return ran, db, ("pairs", plan, study, db, reader)

    return call


@pytest.mark.parametrize("tables", [{"lines": ["a"]}, {"spreads": ["a"]}])
def test_a_study_of_lines_that_may_move_compiles_pairs_a_line_and_a_short_run_of_all_moving(compiled, tables):
    ran, db, pairs = compiled(Moored(Table(), **tables))
    short = {"duration": compiling.SHORT}
    line = ("line", compiling.SCENES / "line_chain_60m.toml")
    runs = ("runs", Moored(Table("all"), **tables), db, {"seeds": 1, **short})
    assert ran == [pairs, line, runs] and line[1].is_file()
    assert compiled(Moored(None, **tables))[0][2][1].simulation == Table("all")


@pytest.mark.parametrize("study, of_db, pairs", [
    (Moored(Table("none"), lines=["a"]), {}, True), (Moored(Table()), {}, True),
    (Moored(Table("none"), lines=["a"]), {"bodies": ("ship", "barge")}, False),
    (Moored(Table()), {"modes": ("bending",)}, False),
])  # fmt: skip
def test_lines_that_do_not_move_and_bodies_without_pairs_compile_less(compiled, study, of_db, pairs):
    ran, _, wanted = compiled(study, **of_db)
    assert ran == [wanted] * pairs


# ------------------------------------------------------------------ processes


def test_processes_share_the_cores_and_start_from_nothing(monkeypatch):
    asked = []
    monkeypatch.setattr(processes.ProcessPoolExecutor, "__init__", lambda self, *given: asked.append(given))
    for cores, count, threads in ((8, 3, 2), (4, 4, 1), (2, 5, 1)):
        monkeypatch.setattr(processes, "processors", lambda cores=cores: cores)
        assert processes.Processes(count).count == count
        number, context, start, given = asked.pop()
        assert (number, context.get_start_method(), start, given) == (count, "spawn", processes._start, (threads,))


@pytest.mark.parametrize("wait, there, ended", [(True, {1: "a"}, []), (False, {1: "a", 2: "b"}, ["a", "b"]),
                                                (False, None, [])])  # fmt: skip
def test_processes_nobody_waits_for_are_ended(monkeypatch, wait, there, ended):
    gone, asked = [], []
    monkeypatch.setattr(processes.ProcessPoolExecutor, "__init__", lambda self, *given: None)
    monkeypatch.setattr(processes.ProcessPoolExecutor, "shutdown", lambda self, **given: asked.append(given))
    workers = processes.Processes(2)
    names = {key: SimpleNamespace(terminate=lambda name=name: gone.append(name)) for key, name in (there or {}).items()}
    workers._processes = names if there is not None else None
    workers.shutdown(wait=wait, cancel_futures=True)
    assert gone == ended and asked == [{"wait": True, "cancel_futures": True}]
    workers._processes = None
    workers.shutdown()
    assert asked[1] == {"wait": True, "cancel_futures": False}


def test_a_process_leaves_ctrl_c_to_its_parent_and_has_its_share_of_threads(monkeypatch):
    handled, started, names = [], [], ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")

    class Thread:
        def __init__(self, **given):
            started.append(given)

        def start(self):
            started.append("begun")

    monkeypatch.setattr(processes.signal, "signal", lambda *given: handled.append(given))
    monkeypatch.setattr(processes.threading, "Thread", Thread)
    for name in names:
        monkeypatch.setenv(name, "9")
    processes._start(3)
    assert handled == [(signal.SIGINT, signal.SIG_IGN)]
    assert started == [{"target": processes._end_with_parent, "daemon": True}, "begun"]
    assert [os.environ[name] for name in names] == ["3"] * 3


@pytest.mark.parametrize("text, good", [
    ("processes:1", True), ("processes:256", True), ("processes:257", False), ("processes:0", False),
    ("processes:", False), ("processes:two", False), ("slurm:10000", True), ("slurm:10001", False), ("dask:256", True),
    ("dask:257", False), ("dask://", False), ("dask://host:1", True), ("locals", False), ("threads:2", False),
])  # fmt: skip
def test_an_executor_is_one_of_its_kinds_with_a_number_that_is_allowed(monkeypatch, text, good):
    from hakobune.pipelines.executors import cluster

    monkeypatch.setattr(cluster, "here", lambda *given: ("dask", *given))
    monkeypatch.setattr(cluster, "slurm", lambda *given: ("slurm", *given))
    monkeypatch.setattr(cluster, "there", lambda *given: ("there", *given))
    monkeypatch.setattr(processes, "Processes", lambda count: ("processes", count))
    if not good:
        with pytest.raises(ValueError, match=re.escape(f"executor is {text!r}; allowed: local, processes:N")):
            choice.executor_of(text)
        return
    kind, _, rest = text.partition(":")
    wanted = (kind, int(rest)) if kind == "processes" else (kind, text, rest)
    if kind != "processes":
        wanted = ("there", text, rest[2:]) if rest.startswith("//") else (kind, text, int(rest))
    assert choice.executor_of(text) == wanted


@pytest.mark.parametrize("stopped, found", [(False, ["done", "late"]), (True, ["done"])])
def test_results_are_waited_for_without_taking_the_processor_until_somebody_stops_it(monkeypatch, stopped, found):
    """The second future is done after three pauses; asked to stop, only what is done is given"""
    stop, pauses = SimpleNamespace(asked=False), []

    class Later:
        def done(self):
            assert self.asked < 9, "asked again and again without a pause"
            self.asked += 1
            return len(pauses) == 3

        def result(self):
            return "late"

        asked = 0

    def pause(seconds):
        pauses.append(seconds)
        stop.asked = stopped

    ready = SimpleNamespace(done=lambda: True, result=lambda: "done")
    monkeypatch.setattr(choice.time, "sleep", pause)
    monkeypatch.setattr(choice, "_futures", lambda executor, calls: [ready, Later()])
    given = list(choice.in_order_until(stop, "executor", "calls"))
    assert given == list(enumerate(found)) and pauses == [choice.LOOK] * (1 if stopped else 3)


def test_work_of_this_process_ends_at_once_where_it_is_stopped():
    """Nothing is begun after the call in which the stop was asked for"""
    stop, called = SimpleNamespace(asked=False), []

    def work(number):
        called.append(number)
        stop.asked = number == 1
        if number == 0:
            raise ValueError("no answer")
        return number

    found = list(choice.in_order_until(stop, choice.Here(), ((work, n) for n in range(4))))
    assert called == [0, 1] and [place for place, _ in found] == [0, 1] and found[1][1] == 1
    assert isinstance(found[0][1], ValueError) and str(found[0][1]) == "no answer"


# ------------------------------------------------------------------ moored bodies, keys of files


@pytest.mark.parametrize("bodies, quay, asked", [((), None, True), ((), "quay", True), (("a", "b"), None, False),
                                                 (("a", "b"), "quay", True)])  # fmt: skip
def test_what_one_body_is_moored_by_is_looked_at_and_the_mooring_is_told_with_its_anchors(
    monkeypatch, bodies, quay, asked
):
    from hakobune.pipelines.moor import result

    excluded, given = [], []
    system = SimpleNamespace(line_names=("bow", "stern"))
    study = SimpleNamespace(
        quay=quay, hinges="hinges", allowable=0.5, simulation=None,
        without_berth=excluded.append, hulls_of=lambda db: "hull",
        system_of=lambda db, hull: system, anchors_on=lambda names: [f"anchor of {name}" for name in names],
        berth_of=lambda db, hull: "berth", remarks=lambda hull, db: ("remark",),
        conditions_and_warnings=lambda: ("conditions", ("steep",)),
    )  # fmt: skip

    @dataclass(frozen=True)
    class Made:
        warnings: tuple = ("warned",)
        extreme: object = None

    extreme = SimpleNamespace(horizontal_a="along", vertical_a=np.array([-5.0, 3.0]))
    monkeypatch.setattr(result, "linked", lambda reader, hinges, db: (reader, hinges))
    monkeypatch.setattr(result, "multi_point", lambda *of: given.append(of) or Made(extreme=extreme))
    monkeypatch.setattr(
        result, "anchor_findings", lambda names, anchors, along, up: [(names, anchors, along, up.tolist())]
    )
    db = SimpleNamespace(bodies=bodies, bodies_reader="reader")
    made, hull = result.studied(study, db)
    assert excluded == ["moor of one body"] * asked and hull == "hull"
    berth = "berth" if bodies else None
    assert given == [(db, system, "hull", "conditions", 0.5, berth, ("reader", "hinges"))]
    anchors = ["anchor of bow", "anchor of stern"]
    assert made.warnings == ("remark", "steep", "warned", (("bow", "stern"), anchors, "along", [5.0, -3.0]))
    study.system_of = lambda db, hull: None
    with pytest.raises(
        StudyError, match=re.escape("the study has no lines; give at least one [[spreads]] or [[lines]]")
    ):
        result.studied(study, db)


def test_schemas_are_written_to_the_place_that_is_named(tmp_path, monkeypatch, capsys):
    from hakobune.pipelines.keys import command, schema

    monkeypatch.setattr(schema, "schema", lambda kind: {"of": kind})
    monkeypatch.setattr(schema, "as_text", lambda made: f"text {made['of']}")
    monkeypatch.setattr(schema, "write_schemas", lambda place: [place / "a.json", place / "b.json"])
    one = tmp_path / "study.json"
    assert command._schemas("study", (), one) == 0
    assert one.read_text() == "text study\n" and capsys.readouterr().out == f"{one}\n"
    folder = tmp_path / "all"
    assert command._schemas(None, (), folder) == 0
    assert capsys.readouterr().out == f"{folder / 'a.json'}\n{folder / 'b.json'}\n"
    for kind, words, place, says in (
        (None, (), one, f"{one} is the name of a single file; give a folder for all kinds, or name one kind"),
        (None, (), tmp_path / "x.json", "is the name of a single file"),
        ("study", (), tmp_path / "x.txt", f"{tmp_path / 'x.txt'} has the suffix '.txt'; allowed: .json"),
        ("study", ("waves",), one, "'waves' and --schema are given; a schema has all keys of a kind; leave the words"),
    ):
        with pytest.raises(ValueError) as refused:
            command._schemas(kind, words, place)
        assert says in str(refused.value)


# ------------------------------------------------------------------ responses, large problems, several bodies


@pytest.mark.parametrize("of_database, ratio, told", [
    (False, 0.1, None), (True, 0.1, "each sea has its own equivalent damping: body.damping_ratio takes its place"),
    (True, None, "equivalent damping: motions near resonance are too large; give body.damping_ratio"),
])  # fmt: skip
def test_viscous_damping_of_one_sea_is_left_out_in_a_climate(monkeypatch, of_database, ratio, told, recwarn):
    read = SimpleNamespace(body=SimpleNamespace(viscous=None, damping_ratio=ratio), climate="table")
    checked = []
    monkeypatch.setattr(climates, "climate", lambda body, **given: (body, given))
    monkeypatch.setattr(responses, "climate_of", lambda *given: {"scatter": given})
    monkeypatch.setattr(effort, "check_effort", lambda *given: checked.append(given))
    body = SimpleNamespace(depth=30.0)
    db = SimpleNamespace(has_viscous_motions=of_database)
    found, same = solved.solved_in_climate(read, body, db, "points", "beside")
    given = ("table", "beside", 30.0)
    assert same is body and found == (body, {"scatter": given, "points": "points"}) and checked == [(read, given)]
    said = [str(one.message) for one in recwarn]
    assert len(said) == (told is not None) and all(line.endswith(told) for line in said)
    read.body.viscous = "table"
    with pytest.raises(StudyError, match=r"body.viscous is linearised in one sea; give damping_ratio for a climate"):
        solved.solved_in_climate(read, body, db, "points", "beside")


def problem(monkeypatch, panels, symmetry, band):
    class Mesh(SimpleNamespace):
        def __len__(self):
            return panels

    class Problem:
        gravity = 9.8

        def prepared(self):
            return SimpleNamespace(geometry="geometry")

    made = Problem()
    made.mesh, made.band = Mesh(symmetry=symmetry, total=4 * panels), band
    monkeypatch.setattr(large, "PanelProblem", Problem)
    monkeypatch.setattr(large, "ShapeProblem", type("Shape", (), {}))
    return made


@pytest.mark.parametrize("panels, symmetry, told", [(1499, "", False), (1500, "", True), (749, "xy", False),
                                                    (750, "xy", True)])  # fmt: skip
@pytest.mark.parametrize("band", [None, (0.1, 1.0)])
def test_a_problem_of_six_thousand_nodes_is_announced_with_its_memory_and_time(
    monkeypatch, panels, symmetry, told, band
):
    """Four nodes a panel times the root of the classes; two processes prepare it twice"""
    made, checked, said = problem(monkeypatch, panels, symmetry, band), [], []
    needed = SimpleNamespace(memory=1.5e9)

    def cost(*given):
        assert given == ("geometry", band, 9.8)
        return needed

    monkeypatch.setattr("hakobune.bem.panels.band.cost.cost", cost)
    monkeypatch.setattr("hakobune.bem.panels.band.cost.memory_alone", lambda prepared: 0.7e9)
    monkeypatch.setattr(large, "_check_memory", lambda *given: checked.append(given))
    monkeypatch.setattr(large, "_times", lambda *given: f", times {given == (needed, 2)}")
    monkeypatch.setattr(large, "_time_alone", lambda prepared, omegas: f", alone {len(omegas)}")
    console = SimpleNamespace(print=lambda *words, **more: said.append(*words))
    found = large.announced(made, 2, console, 2, [0.5, 0.7])
    memory = 3.0e9 if band else 1.4e9
    assert found is (needed if told and band else None)
    assert checked == [(4 * panels, memory, 2)] * told
    after = ", times True" if band else ", alone 2"
    assert said == [f"{4 * panels} panels: about {memory / 1e9:.1f} GB{after}"] * told
    assert large.announced(made, 2, None, 1, []) is found  # in silence
    assert large.announced("another problem", 2, console, 1, []) is None


def test_bodies_of_several_have_matrices_of_their_own_and_centres_in_the_scene(monkeypatch):
    """Two bodies, the first of which stands still; the second is turned by a right angle at (10, 20)"""
    bodies = [
        SimpleNamespace(place=(0.0, 0.0, 0.0), fixed=True),
        SimpleNamespace(place=(10.0, 20.0, 90.0), fixed=False),
    ]

    def of_one(scene, hull):
        k = scene + 1
        made = {"mass": 1e3 * k, "center_of_mass": np.array([1.0, 0.0, -k]),
                "center_of_buoyancy": np.array([2.0, 1.0, -2.0 * k])}  # fmt: skip
        made["hydrostatic_stiffness"] = np.full((6, 6), 10.0 * k)
        return made | ({"inertia_matrix": np.full((6, 6), 7.0 * k)} if scene else {})

    scene = SimpleNamespace(bodies=bodies, alone=lambda i: i, motions_known=True)
    monkeypatch.setattr(header, "_of_one", of_one)
    monkeypatch.setattr(header, "own_hulls", lambda scene, mesh: ["first", "second"])
    monkeypatch.setattr(header, "bodies_of", lambda scene: bodies)
    monkeypatch.setattr(header, "moving", lambda given: np.arange(6, 12))
    found = header._of_several(scene, "mesh")
    assert found["mass"].tolist() == [1e3, 2e3]
    assert found["center_of_mass"] == pytest.approx(np.array([[1, 0, -1], [10, 21, -2]]))
    assert found["center_of_buoyancy"] == pytest.approx(np.array([[2, 1, -2], [9, 22, -4]]))
    assert found["hydrostatic_stiffness"].tolist() == [[0.0] * 6] * 6 + [[20.0] * 6] * 6
    assert found["inertia_matrix"].tolist() == [[0.0] * 6] * 6 + [[14.0] * 6] * 6
    scene.motions_known = False
    assert "inertia_matrix" not in header._of_several(scene, "mesh")


def test_frequencies_without_a_quantity_are_named_with_their_ends_and_motions():
    """Asked for 0.1 … 0.5, of which the third is not solved: places count among the solved ones"""
    asked = np.array([0.1, 0.2, 0.3, 0.4, 0.5])
    unknown = {"drift_force": {"": np.array([0])}, "rao": {"Surge": np.array([1, 3]), "Yaw": np.array([2])},
               "added_mass": {"Heave": np.arange(4)}}  # fmt: skip
    said = list(Gaps("d.h5", asked, np.array([True, True, False, True, True]), unknown).words())
    assert said[0].startswith("d.h5: 1 of 5 frequencies are not solved, 0.3 rad/s; 'hakobune solve SCENE")
    end = "; solve it again with --fresh, by a method that computes it"
    assert said[1:] == [
        f"d.h5: drift_force is not a number at 1 of 4 frequencies, 0.1 rad/s{end}",
        f"d.h5: rao of surge, yaw is not a number at 3 of 4 frequencies, 0.2 to 0.5 rad/s{end}",
        f"d.h5: added_mass of heave is not a number at all frequencies{end}",
    ]
    two = Gaps("d.h5", asked, np.array([False, True, True, False, True]), {})
    assert [line.partition(";")[0] for line in two.words()] == [
        "d.h5: 2 of 5 frequencies are not solved, 0.1 to 0.4 rad/s"
    ]


# ------------------------------------------------------------------ lines


def test_hinges_hold_forces_and_moments_in_kilonewtons_either_way():
    """N and N m along and about axes; travel and angles are no loads, a name may have words of its own"""
    names = ("bow force x", "bow moment y", "bow travel z", "force of stern force z", "bow force y")
    found = numbers.held_by_hinges(names, [-2e3, 5e4, 1.0, 7e3, 0.0])
    assert found == {numbers.HINGE_FORCE: {"bow force x": 2.0, "force of stern force z": 7.0, "bow force y": 0.0},
                     numbers.HINGE_MOMENT: {"bow moment y": 50.0}}  # fmt: skip


@pytest.mark.parametrize("name, group, moves", [("barge", "one line broken", "barge moves"), (None, "", "body moves")])
def test_a_system_that_has_lost_a_line_has_its_tensions_its_worst_line_and_its_shift(monkeypatch, name, group, moves):
    """The second loss has no equilibrium; of lines a, b, c the lost one has no tension; 3, 4 and 12 m are 13 m"""
    monkeypatch.setattr("hakobune.mooring.studies.system_at_rest.body_number", lambda system, name: 1)
    system = SimpleNamespace(line_names=("a", "b", "c"))
    state = SimpleNamespace(system=system, position=np.zeros((2, 6)))
    left = SimpleNamespace(
        system=SimpleNamespace(line_names=("a", "c")), tension=np.array([3e5, 5e5]),
        lines=SimpleNamespace(utilisation=np.array([0.3, np.nan])), position=np.array([[9.0] * 6, [3, 4, 12, 1, 1, 1]]),
    )  # fmt: skip
    made = lines_quantities.lost(state, {"b": left, "a": ValueError("none")}, name)
    assert made["loss.line_tension"].values == pytest.approx(np.array([[3e5, np.nan, 5e5], [np.nan] * 3]), nan_ok=True)
    assert made["loss.tension"].values == pytest.approx([5e5, np.nan], nan_ok=True)
    assert list(made["loss.worst"].values) == ["c", ""]
    assert made["loss.used"].values == pytest.approx([0.3, np.nan], nan_ok=True)
    assert made["loss.shift"].values == pytest.approx([13.0 if name else np.nan, np.nan], nan_ok=True)
    assert made["loss.shift"].description == moves and made["loss.shift"].table == group


def line(name, a, b):
    return SimpleNamespace(name=name, a=a, b=b)


def point(kind, name):
    made = object.__new__(kind)
    object.__setattr__(made, "name", name)
    return made


def test_a_way_of_lines_goes_from_its_anchor_to_what_moves_and_never_in_a_circle():
    """Lines 1, 2 and 3 in a row, written either way round; a triangle of free points has no end"""
    free = [point(FreePoint, name) for name in "pq"]
    points = [point(Anchor, "bed"), *free, SimpleNamespace(name="ship")]
    lines = [line("3", "ship", "q"), line("1", "bed", "p"), line("2", "q", "p")]
    for name in "123":
        way, joints, first, last = moordyn._way(SimpleNamespace(lines=lines, points=points), name)
        assert ([one.name for one in way], joints, first, last) == (["1", "2", "3"], free, "bed", "ship")
    corners = [point(FreePoint, name) for name in "pqr"]
    circle = [line("1", "p", "q"), line("2", "q", "r"), line("3", "r", "p")]
    with pytest.raises(StudyError, match="moordyn: line 2 forms a closed loop; allowed: lines that end at an anchor"):
        moordyn._way(SimpleNamespace(lines=circle, points=corners), "2")
    with pytest.raises(StudyError, match=re.escape("moordyn.line is '9'; allowed: 1, 2, 3")):
        moordyn._way(SimpleNamespace(lines=circle, points=corners), "9")


@pytest.mark.parametrize("ramp, duration", [(None, None), (2.0, None), (None, 3.0)])
def test_a_fairlead_of_a_table_lasts_as_long_as_the_table_or_as_is_asked_and_fades_in_over_its_ramp(
    monkeypatch, ramp, duration, tmp_path
):
    asked = []
    time, position = np.array([0.0, 4.0, 8.0]), np.arange(9.0).reshape(3, 3)
    monkeypatch.setattr(fairleads, "read_positions", lambda path: asked.append(path) or (time, position))
    monkeypatch.setattr(fairleads, "faded", lambda *given: given)
    monkeypatch.setattr(
        "hakobune.mooring.lines.dynamics.simulation.FairleadMotion", SimpleNamespace(table=lambda *given: given)
    )
    fairlead = SimpleNamespace(table="t.csv", position=None, ramp=ramp, motions=[])
    found = fairleads.course_of(SimpleNamespace(fairlead=fairlead, duration=duration), tmp_path)
    start = 0.0 if ramp is None else ramp
    assert found.motion == (time, (time, position, start)) and asked == [tmp_path / "t.csv"]
    assert (found.ramp, found.duration, found.cycle) == (start, 8.0 if duration is None else duration, None)


@pytest.mark.parametrize("changes, says", [
    ({"position": (0, 0, 0)}, "fairlead: position and table: both are given; give one of them"),
    ({"table": None}, "fairlead: position and table: neither is given; give one of them"),
    ({"motions": ["m"]}, "fairlead: motions and a table are both given; give one of them"),
    ({"ramp": -1.0}, "fairlead.ramp is -1 s; allowed: finite, at least 0"),
    ({"ramp": np.inf}, "fairlead.ramp is inf s; allowed: finite, at least 0"),
])  # fmt: skip
def test_a_fairlead_has_one_course(changes, says):
    given = {"table": "t.csv", "position": None, "ramp": None, "motions": []} | changes
    with pytest.raises(StudyError) as refused:
        fairleads.course_of(SimpleNamespace(fairlead=SimpleNamespace(**given), duration=None), "")
    assert str(refused.value) == says


def test_water_without_a_current_is_that_of_the_turning_tests_at_half_the_draft(monkeypatch):
    asked = []
    monkeypatch.setattr(loads, "_turning", lambda *given: asked.append(given) or "table")
    study = SimpleNamespace(current=None, hull=SimpleNamespace(length=80.0, draft=5.0))
    found = loads._water(study, SimpleNamespace(is_round=False), 1025.0, "center", "mass", "findings")
    assert asked == [(study, None, 1025.0, "center", "findings")]
    assert (found.table, found.length, found.turning, found.height) == ("table", 80.0, True, -2.5)
