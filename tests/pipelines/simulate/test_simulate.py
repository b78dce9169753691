"""`hakobune simulate` from study to file, its engine and the preparation of the body replaced by an oscillator."""

import io
import json
import shutil
import signal
import sys
import tomllib
from concurrent.futures import BrokenExecutor, Future
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from rich.console import Console

import hakobune
import hakobune.mooring.motion.simulation as engine
from hakobune import pipelines
from hakobune.bem import DOFS, database
from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.environment.wave_records import elevation
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.motion.contacts import no_berth
from hakobune.mooring.motion.simulation import Realisation
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.units import KGF
from hakobune.pipelines.design.kinds import in_time
from hakobune.pipelines.executors import processes
from hakobune.pipelines.executors.choice import Here
from hakobune.pipelines.films.of_run import film_of_run, surface
from hakobune.pipelines.keys.beginning import commented
from hakobune.pipelines.keys.kinds import KINDS
from hakobune.pipelines.moor import study as study_file
from hakobune.pipelines.moor.study import make_study, read_study
from hakobune.pipelines.response.study import ONE_BODY
from hakobune.pipelines.simulate import beside, command, over_runs, work
from hakobune.pipelines.simulate import file as of_runs
from hakobune.pipelines.simulate import run as runs
from hakobune.pipelines.simulate.berth import fender_strains, findings_on_fenders, most_pressed
from hakobune.pipelines.simulate.beside import Beside
from hakobune.pipelines.simulate.file import STATISTICS, SUMMARY, opened, whole_rows
from hakobune.pipelines.simulate.pictures import draw, spectrum
from hakobune.pipelines.simulate.result import read_run
from hakobune.pipelines.simulate.study import plan_of

MOOR = Path(pipelines.__file__).parent / "scenes" / "moor_chain_12.toml"
TABLE = "\n[simulation]\nduration = 600.0\nramp = 50.0\nseeds = 3\nkeep_series = 2\n"
WIDE = np.linspace(0.1, 4.0, 30)
NOTHING_BESIDE = Beside(np.zeros(0), np.zeros(0), np.full(3, np.nan), np.full(3, np.nan))


def oscillator(body, plan, settings, seed=0, progress=None):
    """Realisation of a sine whose amplitude follows the seed"""
    t = np.arange(-settings.ramp, settings.duration + settings.step / 2, settings.step)
    wave = (1 + 0.1 * np.random.default_rng(seed).random()) * np.sin(0.6 * t)
    motion = 0.01 * wave[:, None] * np.arange(1.0, 7.0)
    tension = 1e6 + 1e5 * wave[:, None] * np.linspace(-1, 1, 12)
    zero, none, found = np.zeros(6), np.zeros((len(t), 0)), ("a finding",)
    slow = motion[:, [0, 1, 5]]
    return Realisation(
        t, motion, motion, slow, wave, 0 * t, tension, seed, zero, 9, {}, found, none, none, none, motion[:, None]
    )


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A study and a stand-in for a database, in the folder one is in"""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "study.toml").write_text(MOOR.read_text() + TABLE)
    (tmp_path / "box.h5").write_bytes(b"a database")
    reader = SimpleNamespace(omega=WIDE, depth=20.0, gravity=9.8, words=ONE_BODY)
    db = SimpleNamespace(
        reader=reader, bodies_reader=reader, rotation_center=np.zeros(3), density=1025.0, gravity=9.8,
        require_rigid=lambda: None, water_depth=20.0, sizes={}, displaced_volume=None, path=Path("box.h5"), bodies=(),
        modes=(), hydrostatic_stiffness=None,
    )  # fmt: skip
    study = read_study("study.toml")[0]
    hull = study.hull_of({})
    system = study.system(hull, np.zeros(3))
    memory = SimpleNamespace(states=4)
    body = SimpleNamespace(system=system, hull=hull, memory=memory, start=np.zeros(6), findings=("prepared",))
    body.berth = no_berth()
    body.reader = SimpleNamespace(
        radius=50.0, inertia=5e7 * np.eye(6), gravity=9.8, words=ONE_BODY, names=DOFS, axes_at_rest=np.zeros((1, 6)),
        links=(), rigid=6, modes=(),
    )  # fmt: skip

    def prepared(task, db=None):
        return body, plan_of(study, WIDE, None, task.duration), ()

    real = database.open_database  # modules first imported here keep the stand-in: it serves other files too

    def opened_or(path):
        stands_for_one = Path(path).is_file() and Path(path).read_bytes() == b"a database"  # a pipe would never end
        return db if stands_for_one else real(path)

    monkeypatch.setattr("hakobune.bem.database.open_database", opened_or)
    monkeypatch.setattr(engine, "simulate", oscillator)
    for module in (work, runs):
        monkeypatch.setattr(module, "prepared", prepared)
    monkeypatch.setattr(runs, "simplified", lambda study, db: NOTHING_BESIDE)
    monkeypatch.setattr("hakobune.pipelines.solve.report.doubts", lambda db: ())  # it is no database
    return tmp_path


def simulate(seeds=None, output="run.h5", console=None, executor=None, **more):
    study, box = runs.input_of("study.toml"), database.open_database("box.h5")
    return runs.simulate(study, box, output, console, executor or Here(), seeds, **more)


def test_runs_are_stored_seed_by_seed_and_the_second_call_makes_none(folder):
    first, second = simulate(), simulate()
    assert (first.made, first.there, second.made, second.there) == (3, 3, 0, 3)
    assert {"a finding", "prepared"} <= set(read_run("run.h5").findings)
    with opened("run.h5") as file:
        assert whole_rows(file).all() and file["motion"].shape == (2, 1201, 6) and file["time"][0] == 0.0
        value = dict(zip(file["quantity"].asstr()[()], file["statistics"][0], strict=True))
        assert np.isclose(value["heave"][1] / value["surge"][1], 3.0, rtol=1e-12)


def test_a_run_is_drawn_unless_no_pictures_are_asked_for(folder, capsys):
    asked = ["simulate", "study.toml", "--database", "box.h5", "--output", "run.h5"]
    for more, pictures in ((["--no-pictures"], 0), ([], 4)):
        assert main([*asked, *more]) == 0
        assert capsys.readouterr().out.count(".png") == len(list(folder.glob("*.png"))) == pictures


class Killed(Here):
    """A process that has been killed"""

    def __init__(self, count):
        pass

    def submit(self, function, *arguments):
        future = Future()
        future.set_exception(BrokenExecutor("killed"))
        return future


def test_another_process_draws_the_same_pictures_and_if_it_is_killed_they_are_drawn_here(folder, capsys, monkeypatch):
    asked, drawn = ["simulate", "study.toml", "--database", "box.h5", "--output", "run.h5"], []
    monkeypatch.setattr(command, "processors", lambda: 2)
    for way in (processes.Processes, Killed):
        monkeypatch.setattr(processes, "Processes", way)
        for part in [name for name in sys.modules if name == "matplotlib.figure"]:
            monkeypatch.delitem(sys.modules, part)
        assert main(asked) == 0 and capsys.readouterr().out.count(".png") == 4
        assert ("matplotlib.figure" in sys.modules) == (way is Killed)
        drawn.append({path.name: path.read_bytes() for path in folder.glob("*.png")})
    assert drawn[0] == drawn[1] and len(drawn[0]) == 4


def test_a_study_is_parsed_and_its_database_opened_once(folder, monkeypatch):
    opened_files, parsed = [], []
    first, made = database.open_database, study_file.typed
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: opened_files.append(path) or first(path))
    monkeypatch.setattr(study_file, "typed", lambda *given: parsed.append(given) or made(*given))
    hakobune.simulate("study.toml", "box.h5", "run.h5", seeds=2)
    assert len(opened_files) == len(parsed) == 1


def test_a_stopped_run_is_completed_to_the_same_bits(folder):
    simulate()
    shutil.copy("run.h5", "whole.h5")
    with h5py.File("run.h5", "r+") as file:
        file["stored"][1] = 0
        file["motion"][1] = 7.0
        file["statistics"][1, 0] = np.nan
    assert simulate().made == 1
    assert Path("run.h5").read_bytes() == Path("whole.h5").read_bytes()


def test_a_row_that_was_damaged_is_named_and_made_again(folder, capsys):
    simulate()
    with h5py.File("run.h5", "r+") as file:
        file["tension"][0, 5] += 1.0
    assert main(["check", "run.h5"]) == 1 and "damaged: seeds 1;" in capsys.readouterr().out
    assert simulate().made == 1
    assert main(["check", "run.h5"]) == 0


def test_more_seeds_keep_those_that_are_there(folder):
    simulate(2)
    assert simulate(6).made == 4
    with opened("run.h5") as file:
        assert file["seed"][()].tolist() == [1, 2, 3, 4, 5, 6]
        assert np.all(file["summary"][:8, -1] >= 0) and np.isfinite(file["summary"][0, 12])


def test_a_run_cut_short_leaves_what_was_whole(folder, monkeypatch):
    def broken(body, plan, settings, seed=0, progress=None):
        if seed == 2:
            raise ValueError("a line cannot reach its fairlead")
        return oscillator(body, plan, settings, seed)

    monkeypatch.setattr(engine, "simulate", broken)
    outcome = simulate()
    assert outcome.failures == ((2, "a line cannot reach its fairlead"),) and outcome.there == 2


def test_ctrl_c_leaves_a_seed_where_it_is_and_keeps_those_before(folder, monkeypatch, heard):
    def pressed(body, plan, settings, seed=0, progress=None):
        for share in (0.0, 0.5):
            if seed == 2 and share:
                signal.raise_signal(signal.SIGINT)
            progress(share)
        return oscillator(body, plan, settings, seed)

    with monkeypatch.context() as patched:
        patched.setattr(engine, "simulate", pressed)
        outcome = simulate()
        assert main(["simulate", "study.toml", "--database", "box.h5", "--output", "other.h5"]) == 130
    assert outcome.interrupted and (outcome.made, outcome.there, outcome.failures) == (1, 1, ())
    assert simulate().made == 2


@pytest.mark.parametrize("place", [(engine, "simulate"), (runs, "create")])
def test_ctrl_c_before_a_seed_is_finished_is_said_to_have_stored_nothing(place, folder, monkeypatch, capsys):
    def pressed(*arguments, **named):
        raise KeyboardInterrupt

    monkeypatch.setattr(*place, pressed)
    words = ["simulate", "study.toml", "--database", "box.h5", "--output", "run.h5"]
    assert main(words) == 130
    assert "interrupted before a seed was finished; nothing is stored yet" in capsys.readouterr().err


def test_ctrl_c_waits_for_no_process_and_keeps_what_each_has_done(folder, heard):
    class Two:
        """Two processes: the first is still at seed 1 when the second has done two seeds, and Ctrl-C comes."""

        ended, looks = False, 0

        def submit(self, function, task, seed, *others):
            made = Future() if seed > 1 else Pressed()
            if seed in (2, 3):
                made.set_result(function(task, seed, *others))
            return made

        def shutdown(self, wait=True, cancel_futures=False):
            self.ended = not wait and cancel_futures

    class Pressed(Future):
        def done(self):
            executor.looks += 1
            if executor.looks == 1:
                signal.raise_signal(signal.SIGINT)
            elif executor.looks > 3:
                self.set_exception(TimeoutError("it is waited for"))
            return super().done()

    executor = Two()
    outcome = simulate(4, executor=executor)
    assert outcome.interrupted and executor.ended and outcome.made == 2
    with opened("run.h5") as file:
        assert whole_rows(file).tolist() == [False, True, True, False]


def test_another_study_is_refused_with_the_way_out(folder):
    simulate()
    with pytest.raises(DatabaseError, match="--fresh"):
        simulate(duration=300.0)
    assert simulate(duration=300.0, fresh=True).made == 3


def test_more_hours_make_every_seed_again_as_a_run_made_at_once(folder):
    """Those beyond the seeds asked for too; a kill midway leaves a file that the same command completes"""
    assert simulate(4).made == 4
    said = io.StringIO()
    outcome = simulate(console=Console(file=said, width=300), duration=900.0)
    assert outcome.made == 4 and "s are requested: every seed is run again, since the waves" in said.getvalue()
    simulate(4, "once.h5", duration=900.0)
    assert Path("run.h5").read_bytes() == Path("once.h5").read_bytes()
    with h5py.File("run.h5", "r+") as file:
        file["stored"][1] = 0
    assert simulate(4, duration=900.0).made == 1
    assert Path("run.h5").read_bytes() == Path("once.h5").read_bytes()
    with pytest.raises(DatabaseError, match="longer runs"):
        simulate(4)


def test_a_force_of_a_file_beside_the_study_is_part_of_what_results_depend_on(folder):
    Path("study.toml").write_text(Path("study.toml").read_text() + "\n[[simulation.force]]\nfile = 'tug.csv'\n")
    with pytest.raises(ValueError, match=r"tug\.csv"):
        simulate()
    short = "t,Fx,Fy,Fz,Mx,My,Mz\n0,0,0,0,0,0,0\n1,1e5,0,0,0,0,0\n"
    Path("tug.csv").write_text(short)
    with pytest.raises(ValueError, match=r"tug\.csv: a force is given from 0 to 1 s; .*begins and ends with zeros"):
        simulate()
    Path("tug.csv").write_text(short + "2,0,0,0,0,0,0\n")
    assert simulate().made == 3
    Path("tug.csv").write_text("t,Fx,Fy,Fz,Mx,My,Mz\n0,0,0,0,0,0,0\n700,2e5,0,0,0,0,0\n")
    with pytest.raises(DatabaseError, match="another study"):
        simulate()


def test_a_study_that_says_nothing_has_memory_pairs_of_waves_and_lines_that_move_where_they_have_to():
    """So has what `hakobune new` writes; what the report did is asked for by name"""
    table = make_study(tomllib.loads(MOOR.read_text() + TABLE)).simulation
    assert (table.memory, table.dynamic_lines, table.qtf, table.slow_drift) == ("states", "auto", "auto", "newman")
    for kind in KINDS:
        asked = tomllib.loads(commented(kind)).get("simulation", {})
        rings = {"memory"} if kind == "bridge" else set()  # 24 coupled motions, too many for states
        assert not {"memory", "dynamic_lines", "qtf"} & set(asked) - rings, kind


def test_what_is_left_out_is_the_first_line_of_the_answer_also_of_a_file_that_is_there(folder, monkeypatch, capsys):
    """The findings of seeds too; the trial is told before the run, with what a seed will take"""
    left, trial = "left out: inertia and drag of the lines", "dynamic_lines: in a trial they move"
    body, plan, _ = work.prepared(SimpleNamespace(duration=None))
    plan = replace(plan, told=(left, trial), pace=(0.01, 0.1), settings=replace(plan.settings, dynamic_lines=("a",)))
    monkeypatch.setattr(runs, "prepared", lambda task, db=None: (body, plan, ()))
    monkeypatch.setattr(type(read_study("study.toml")[0]), "remarks", lambda *_: ["the hull is no box"])
    said = io.StringIO()
    simulate(console=Console(file=said, width=300))
    takes = 'one seed takes about 1 min 05 s (dynamic_lines = "none": 6 s), and all 3 seeds 3 min 15 s'
    assert said.getvalue().split("\n")[:4] == [left, trial, takes, "warning: the hull is no box"]
    assert simulate().made == 0
    with opened("run.h5") as file:
        assert file.attrs["moving_lines"] == "a"
    again = read_run("run.h5")
    assert again.first == (left,) and trial in again.notes and left not in again.findings
    again.show()
    assert capsys.readouterr().out.startswith(f"warning: {left}\n")


def test_lines_that_move_are_part_of_what_results_depend_on_and_files_without_them_keep_their_hash(folder):
    """Elements of lines that there are not change nothing: a run made before there were any takes more seeds"""
    text = Path("study.toml").read_text()
    Path("study.toml").write_text(text + "dynamic_lines = []\n")
    assert simulate().made == 3
    still = 'dynamic_lines = "none"\ndynamic_elements = 33\ndynamic_water = "still"\n'
    Path("study.toml").write_text(text + still)
    assert simulate(4).made == 1
    for other in ("", 'dynamic_lines = "all"\n'):
        Path("study.toml").write_text(text + other)
        with pytest.raises(DatabaseError, match="another study"):
            simulate()


def test_the_file_is_labelled_for_xarray(folder):
    xarray = pytest.importorskip("xarray")
    simulate()
    with xarray.open_dataset("run.h5", engine="h5netcdf") as data:
        assert data["tension"].sel(kept_seed=1, line="aft port 1").dims == ("time",)
        assert data["statistics"].sel(seed=3, quantity="heave", statistic="sigma") > 0
        assert data["motion"].attrs["units"].startswith("m")


def plan(text, omega=WIDE, **more):
    return plan_of(make_study(tomllib.loads(MOOR.read_text() + text)), omega, **more)


@pytest.mark.parametrize(
    "text, words",
    [
        ("", "no \\[simulation\\]"),
        ("[simulation]\nramp = 10.0", "one of duration"),
        ("[simulation]\nduration = 10.0\ntolerance = 2.0", "tolerance is 2"),
        ("[simulation]\nduration = 1e9", "samples"),
        ("[simulation]\nduration = 1e-9", "simulation has 1e-09 s; allowed: at least 4 s"),
        ("[simulation]\nduration = 10.0\nseeds = 1000000000000", "there are 1000000000000 seeds; allowed: 1 to 10000"),
        ("[simulation]\nduration = 10.0\ncomponents = 1000000000", "components is 1000000000; allowed: 1 to 100000"),
        ("[simulation]\nduration = 10.0\nseeds = [1, 1]", "each given once"),
        (
            "[simulation]\nduration = 10.0\ndynamic_lines = 'all'\ndynamic_water = 'wet'",
            "^simulation: dynamic_water is 'wet'; allowed: still, sea$",
        ),
        (
            "[simulation]\nduration = 10.0\ndynamic_lines = []\ndynamic_water = 'sea'",
            "no line is in motion; give dynamic_lines",
        ),
        ("[simulation]\nduration = 10.0\nlines_lost = [{ line = 'a', time = -1.0 }]", "from 0 s on"),
    ],
)
def test_what_cannot_be_simulated_is_one_line(text, words):
    with pytest.raises(StudyError, match=words):
        plan(text)


def test_a_sea_outside_the_stored_frequencies_says_how_much_and_how_to_extend():
    some = plan(TABLE, np.linspace(0.1, 1.05, 20)).findings
    assert len(some) == 1 and "% of the wave energy" in some[0] and "solve" in some[0]
    with pytest.raises(StudyError, match="allowed: 25 %"):
        plan(TABLE, np.linspace(0.7, 1.0, 20))


def test_a_further_sea_is_part_of_the_weather_and_slow_motion_lies_below_both():
    swell = "[[simulation.sea]]\nheight = 1.0\nperiod = 16.0\ndirection_deg = 90.0\n"
    alone, both = plan(TABLE), plan(TABLE + swell)
    assert len(both.weather.seas) == 2 and both.weather.seas[1].direction == np.pi / 2
    assert both.split < alone.split and "[waves] only" in both.findings[0]
    with pytest.raises(StudyError, match="give one of direction_deg, incidence_deg"):
        plan(TABLE + swell.replace("direction_deg = 90.0", ""))
    with pytest.raises(StudyError, match="above 0"):
        plan(TABLE + swell.replace("1.0", "-1.0"))


def test_a_whole_sea_within_the_stored_frequencies_has_no_finding():
    assert plan(TABLE, np.linspace(0.05, 4.0, 20)).findings == ()


def test_pictures_lie_beside_the_file(folder):
    simulate()
    with opened("run.h5") as file:
        names = draw(file, Path("run.h5"))
    assert [Path(name).stat().st_size > 20_000 for name in names] == [True] * 4


def test_a_spectrum_of_records_is_no_coarser_than_asked_for():
    t = 0.5 * np.arange(7200)
    omega, density = spectrum(np.sin(0.065 * t)[None], 0.5, widest=0.15 * 0.045)
    assert np.diff(omega).max() <= 0.15 * 0.045 and abs(omega[density.argmax()] - 0.065) < 0.0035


def test_a_spectrum_of_records_holds_their_variance():
    records = np.random.default_rng(1).normal(size=(3, 4096))
    omega, density = spectrum(records, 0.5)
    assert np.isclose(np.trapezoid(density, omega), records.var(axis=1).mean(), rtol=0.02)


def test_the_surface_of_a_film_is_the_wave_of_the_record_at_the_origin():
    parts = Sea(issc(3.0, mean_period=9.0), 0.4, CosinePower(4)).components(50, 3)
    t = np.arange(5) * 1.7
    heights = surface((parts, wavenumber(parts.omega, 20.0, 9.81), 40.0), np.array([0.0, 30.0]), np.array([0.0, -7.0]))
    for i, place in enumerate(((0.0, 0.0), (30.0, -7.0))):
        assert np.allclose([heights(one)[i] for one in t], elevation(parts, t + 40.0, *place, 20.0, 9.81), atol=1e-12)


def test_a_film_follows_the_record_and_is_not_written_over_something_else(folder):
    simulate()
    assert film_of_run("run.h5", Path("film.gif"), seed=2, length=2.0) == 3
    assert Path("film.gif").read_bytes()[:6] == b"GIF89a"
    with pytest.raises(ValueError, match="no record of seed 3"):
        film_of_run("run.h5", Path("film.gif"), seed=3)
    with pytest.raises(ValueError, match="--length is 0 s"):
        film_of_run("run.h5", Path("film.gif"), length=0.0)


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        ({"step": 0.0}, "--step is 0 s; allowed: above 0"),
        ({"length": np.nan}, "--length is nan s"),
        ({"step": 1e-9}, "frames; allowed: 2 to 2000"),
        ({"start": 1e300}, r"--start is 1e\+300 s; allowed: 0 to 600 s"),
    ],
)
def test_a_film_of_times_that_are_not_there_is_refused_before_it_is_made(folder, flags, words):
    simulate(1)
    with pytest.raises(ValueError, match=words):
        film_of_run("run.h5", "film.gif", **flags)


def test_a_simulation_whose_structure_or_summary_is_damaged_says_so(folder, capsys):
    simulate()
    content = Path("run.h5").read_bytes()
    with h5py.File("run.h5", "r+") as file:
        file["summary"][0, 0] += 1.0
    assert main(["check", "run.h5"]) == 1 and "damaged: the statistics over all seeds" in capsys.readouterr().out
    assert simulate().made == 0 and main(["check", "run.h5"]) == 0
    Path("run.h5").write_bytes(content[:5000] + b"damage" + content[5006:])
    assert main(["check", "run.h5"]) == 1 and "simulate again with --fresh" in capsys.readouterr().out
    assert simulate(fresh=True).made == 3


def snapping(body, plan, settings, seed=0, progress=None):
    """The oscillator, whose first line pulls with 20 MN for half a second in seed 4"""
    run = oscillator(body, plan, settings, seed)
    if seed == 4:
        run.tension[600, 0] = 2e7
    return run


def test_what_lines_use_is_never_less_than_in_any_run_and_a_line_that_broke_in_one_is_named(folder, monkeypatch):
    monkeypatch.setattr(engine, "simulate", snapping)
    simulate(6)
    with opened("run.h5") as file:
        names, load = file["line"].asstr()[()], file.attrs["breaking_load"]
        at = list(file["quantity"].asstr()[()]).index(f"tension {names[0]}")
        largest = file["statistics"][:, at:, STATISTICS.index("largest")].max(axis=0)
        (broken,) = over_runs.overloads(file)
        assert f"{names[0]} {100 * 2e7 / load[0]:.4g} % in 1 of 6 runs" in broken and "break" in broken
        assert names[1] not in broken
        (snaps,) = over_runs.rare_findings(file)
        assert f"{names[0]} in 1 of 6" in snaps and names[1] not in snaps
    found = read_run("run.h5")
    assert np.array_equal(found["tension.used"], largest / load) and np.array_equal(found["tension.largest"], largest)
    assert "tension.simplified" not in found


def test_anchors_use_what_the_largest_pull_of_all_runs_asks_for(folder, monkeypatch):
    """Runs pull one after another with 100, 200 and 300 kN, half of it upwards: (300/0.5 + 150)/600 is 125 %"""
    sinker = '[[anchors]]\nkind = "sinker"\nfriction = 0.5\nweight_kN = 600.0\n'
    Path("study.toml").write_text(Path("study.toml").read_text() + sinker)
    pulls = iter([1e5, 3e5, 2e5])
    monkeypatch.setattr(work, "anchor_pulls", lambda *given: next(pulls) * np.tile([1.0, 0.5, 1e-4], (12, 1)))
    simulate()
    found = read_run("run.h5")
    assert found["anchor.used"] == pytest.approx(np.full(12, 1.25)) and found["anchor.holding"][0] == 0.5 * 450e3
    assert any(line.startswith("FAILS: 12 of 12 anchors in the runs") and "125 %" in line for line in found.findings)
    assert simulate().made == 0


def test_a_design_takes_the_largest_of_all_runs_those_that_are_not_kept_too(folder, monkeypatch):
    """Statics at the displacement give 1.5 MN, at 1.5 times it 2 MN; run 4, which is not kept, pulled with 20 MN

    At 1.2 times it they give 1 MN, less than what was simulated, which stands."""
    monkeypatch.setattr(engine, "simulate", snapping)
    simulate(6)
    made = runs.Outcome(0, 6, 6, (), False)
    monkeypatch.setattr(in_time, "_run", lambda *given: made)
    held = {1.0: 1.5e6, 1.2: 1e6, 1.5: 2e6}
    monkeypatch.setattr(in_time, "_moved", lambda *given: np.full((3, 12), held[given[-1]]))
    found = in_time._simulated(Path("study.toml"), "box.h5", Path("run.h5"), (1.0, 1.2, 1.5))
    with opened("run.h5") as file:
        rows = file["statistics"][()]
    largest, smallest = rows[:, :, STATISTICS.index("largest")], rows[:, :, STATISTICS.index("smallest")]
    assert np.array_equal(found["largest"][1.0], largest[:, 8:].max(axis=0)) and found["largest"][1.0][0] == 2e7
    assert found["largest"][1.5][0] == pytest.approx(2e6 * 2e7 / 1.5e6)
    assert np.array_equal(found["largest"][1.2], found["largest"][1.0])
    broken, lifted, snaps = found["findings"][-3:]
    assert "1 of 12 lines leave the bed" in lifted and "most of all fore port 1 with" in lifted
    assert "break: fore port 1 " in broken and "in 1 of 6 runs" in broken and "fore port 1 in 1 of 6" in snaps
    mean = rows[:, :, STATISTICS.index("mean")].mean(axis=0)
    away = np.maximum(largest.max(axis=0) - mean, mean - smallest.min(axis=0))[:6]
    assert found["motions"] == pytest.approx(away, rel=1e-12)


def test_the_simplified_method_stands_beside_the_runs(folder, monkeypatch):
    beside = replace(NOTHING_BESIDE, tension=np.full(12, 5e5), utilisation=np.full(12, 0.06))
    monkeypatch.setattr(runs, "simplified", lambda study, db: beside)
    simulate(1)
    found = read_run("run.h5")
    assert np.allclose(found["tension.over_simplified"], found["tension.largest"] / 5e5)
    assert np.all(found["tension.used_simplified"] == 0.06)


def test_a_fender_is_as_strained_as_in_the_worst_of_all_runs():
    """On a dolphin that yields as much as the fender the fender has half of the deflection"""
    names = np.array(["deflection A", "deflection B", "deflection C"])
    summary = np.full((3, len(SUMMARY)), np.nan)
    summary[:, SUMMARY.index("largest")] = 0.9, 1.1, 1.1
    summary[:, SUMMARY.index("upper_median")] = 0.5, 0.4, 0.4
    text = lambda values: SimpleNamespace(asstr=lambda: {(): values})  # noqa: E731
    file = {"quantity": text(names), "summary": summary, "fender": text(np.array(["A", "B", "C"]))}

    class File(dict):
        attrs = {  # noqa: RUF012
            "fender_height": [2.0] * 3, "fender_allowable": [0.5] * 3,
            "fender_strains": json.dumps([[[0, 1], [0, 1]], [[0, 1], [0, 1]], [[0, 1], [0, 0.5]]]),
        }  # fmt: skip

    assert np.allclose(fender_strains(File(file))[0], [0.45, 0.55, 0.275])
    (beyond,) = findings_on_fenders(File(file))
    assert "B is compressed by 55 % of its height; allowed: 50 %" in beyond
    (said,) = most_pressed(File(file))
    assert said == "largest compression of a fender: 55 % of the height of B (allowable 50 %)"


def test_a_single_run_tells_what_was_simulated_and_asks_for_seeds(folder):
    simulate(1)
    with opened("run.h5") as file:
        (told,) = over_runs.notes(file)
        assert "with 90 % confidence, no more than 90 % of further runs exceed it" in told and "run 5 seeds" in told
    assert np.isnan(read_run("run.h5")["surge.extreme_median"])


def test_runs_of_a_regular_wave_are_told_to_be_all_alike(folder):
    text = Path("study.toml").read_text().replace("[waves]", '[waves]\nmethod = "regular_wave"')
    Path("study.toml").write_text(text)
    simulate(1)
    with opened("run.h5") as file:
        assert not over_runs.differ(file) and (
            "seeds do not differ, since there are no random waves or gusts: "
            "every run has the same largest and smallest values"
        ) in next(iter(over_runs.notes(file)))


def test_a_file_with_the_statistics_of_an_earlier_version_gets_those_of_today_without_a_run(folder, monkeypatch):
    simulate(6)
    shutil.copy("run.h5", "today.h5")
    with monkeypatch.context() as earlier:
        earlier.setattr(of_runs, "SUMMARY", tuple(name.replace("median", "value") for name in of_runs.SUMMARY))
        simulate(6, fresh=True)
    monkeypatch.setattr(engine, "simulate", None)
    assert simulate(6).made == 0
    with opened("run.h5") as file, opened("today.h5") as today:
        assert np.array_equal(file["summary"][()], today["summary"][()], equal_nan=True)
        assert whole_rows(file).all() and np.array_equal(file["motion"][()], today["motion"][()])


@pytest.mark.parametrize("name", ["simulate_chain_12", "simulate_model_M3B"])
def test_every_study_that_is_shipped_can_be_planned(name):
    study = read_study(MOOR.with_name(f"{name}.toml"))[0]
    made = plan_of(study, np.linspace(0.05, 8.0, 20))
    assert made.seeds == (1, 2, 3, 4, 5) and made.weather.seas


def test_chains_of_the_model_have_the_pretension_of_the_report():
    """Appendix 1, Table 1.3: 2.55 kgf at the top, by the catenary"""
    study = read_study(MOOR.with_name("simulate_model_M3B.toml"))[0]
    tension = rest(study.system(study.hull_of({}), np.zeros(3), 1000.0)).lines.tension_b / KGF
    assert np.allclose(tension, 2.55, rtol=0.01)


def test_moor_reads_the_same_study(folder):
    study = read_study("study.toml")[0]
    assert study.conditions().waves.period == 10.0


def test_a_file_of_something_else_is_not_replaced(folder, capsys):
    Path("run.h5").write_bytes(b"something")
    assert main(["simulate", "study.toml", "--database", "box.h5", "--output", "run.h5"]) == 2
    assert "not a simulation" in capsys.readouterr().err


def test_what_is_kept_beside_the_reports_tables_is_the_extreme_of_a_thousand_waves(folder):
    """SR179 report (1982), eq. 3.5.1.5: σ(s + γ/s), s = √(2 ln n), n the zero crossings of 1000 mean periods of the
    waves.  The sine of the oscillator has T = 2π/0.6 s and σ = a/√2, a of heave 0.03 of a wave of about 1 m."""
    simulate(seeds=1)
    with opened("run.h5") as file:
        period = float(file.attrs["mean_period"])
        names = list(file["quantity"].asstr()[()])
        row = dict(zip(SUMMARY, file["summary"][names.index("heave")], strict=True))
        amplitude = file["motion"][0, :, 2].max()
    s = np.sqrt(2 * np.log(1000 * period / (2 * np.pi / 0.6)))
    assert row["extreme"] == pytest.approx(amplitude / np.sqrt(2) * (s + 0.5772 / s), rel=2e-3)


@pytest.mark.parametrize("share, told", [(0.99, False), (1.01, True)])
def test_a_line_beyond_what_it_may_carry_is_told(folder, share, told):
    """The largest simulated against the allowable share of the breaking load, on either side of it"""
    simulate(seeds=1)
    with opened("run.h5") as file:
        names = [f"tension {line}" for line in file["line"].asstr()[()]]
        at = [list(file["quantity"].asstr()[()]).index(name) for name in names]
        used = file["statistics"][0, at, STATISTICS.index("largest")] / file.attrs["breaking_load"]
        allowable = float(used.max() / share)
        said = list(over_runs.overloads(file, allowable))
    assert bool(said) is told
    line = names[int(used.argmax())].removeprefix("tension ")
    assert not told or (
        f"{line} {100 * used.max():.4g} % in 1 of 1 runs" in said[0]
        and f"the allowable {100 * allowable:g} %" in said[0]
    )


def test_the_table_of_statistics_has_degrees_kilonewtons_and_seconds(folder, capsys):
    """One seed of the oscillator: a sine a sin 0.6t with a = 0.01 j w of motion j, tensions 1000 kN ± 100 kN w, w the
    amplitude of its wave; σ = a/√2, all maxima a, T = 2π/0.6 s, no bandwidth; angles times 180/π"""
    simulate(seeds=1)
    found = read_run("run.h5")
    with opened("run.h5") as file:
        w = float(file["motion"][0, :, 0].max()) / 0.01
    lines = found.labels["line"].values
    sines = {"heave": (0.0, 0.03 * w), "roll": (0.0, 0.04 * w), "yaw": (0.0, 0.06 * w)}
    sines |= {lines[0]: (1e6, 1e5 * w), lines[-1]: (1e6, 1e5 * w)}
    for name, (mean, amplitude) in sines.items():
        row = {key: float(found[f"{name}.{key}"]) for key in STATISTICS if f"record.{key}" in found}
        assert row["mean"] == pytest.approx(mean, abs=0.02 * amplitude)
        assert row["sigma"] == pytest.approx(amplitude / np.sqrt(2), rel=0.01)
        assert [row["mean_third"], row["mean_tenth"]] == pytest.approx([amplitude] * 2, rel=0.01)
        assert row["largest"] == pytest.approx(mean + amplitude, rel=0.01)
        assert row["smallest"] == pytest.approx(mean - amplitude, rel=0.01)
        assert [row["T_zero"], row["T_peak"]] == pytest.approx([2 * np.pi / 0.6] * 2, rel=0.01)
    found.show()
    (shown,) = (line for line in capsys.readouterr().out.split("\n") if "roll, °" in line)
    assert float(shown.split("│")[3]) == pytest.approx(np.degrees(0.04 * w) / np.sqrt(2), rel=0.01)


def test_slow_motion_stands_beside_a_run_in_a_sea_alone_and_not_beside_one_of_a_regular_wave(monkeypatch):
    def slow(answer, sea="sea", method="spectrum"):
        monkeypatch.setattr(beside, "long_period", lambda *_: answer())
        found = SimpleNamespace(conditions=SimpleNamespace(sea=sea, method=method))
        return beside._slow(SimpleNamespace(wind=None), None, None, found).tolist()

    def known():
        return SimpleNamespace(by_spectrum=(1.0, 2.0, 3.0))

    def beyond():
        raise ValueError("a spectrum that the database does not reach")

    assert slow(known) == [1.0, 2.0, 3.0]
    for unknown in (slow(known, sea=None), slow(known, method="regular_wave"), slow(beyond)):
        assert np.isnan(unknown).all()


def test_numbers_of_runs_are_told_as_they_are_and_shares_of_a_limit_in_per_cent(folder):
    simulate()
    found = read_run("run.h5")
    shares = {name for name, one in found.quantities.items() if one.share}
    assert (
        shares == {name for name in found.quantities if name.endswith(("used", "allowable"))} and "allowable" in shares
    )
    for name, unit in (("seeds", ""), ("duration", "s"), ("mean_period", "s"), ("split_frequency", "rad/s")):
        one = found.quantity(name)
        assert (one.unit, one.share, one.table) == (unit, False, found.quantity("seeds").table) and one.table
    assert found["seeds"] == 3 and found["allowable"] == 0.4
