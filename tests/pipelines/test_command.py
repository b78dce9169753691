"""The commands as a person runs them, with the real mesher and solver on small meshes."""

import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from kill_campaign import campaign

from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.bem.database.integrity import row_crcs
from hakobune.pipelines.cli import app, main

STUDIES = (
    "site",
    "sweep",
    "moor",
    "response",
    "line",
    "simulate",
    "design",
    "berth",
    "breakwater",
    "single_point",
    "downtime",
)
STUDIES += ("earthquake", "members", "passing", "sections")
SCENES = sorted(
    path for path in (Path(pipelines.__file__).parent / "scenes").glob("*.toml") if not path.stem.startswith(STUDIES)
)
WORDS = shlex.split(
    "box --length 100 --beam 50 --draft 10 --depth 20 --panels 60 --gyration 15.55,29.44,32.28 "
    "--omega 0.2:1.0:12 --heading 0,30 --only radiation,diffraction,motions,drift"
)


MANY = 100  # frequencies, more than are solved before a signal arrives


def command(*arguments):
    return [sys.executable, "-m", "hakobune.pipelines.cli", *map(str, arguments)]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The database of an undisturbed run."""
    path = tmp_path_factory.mktemp("whole") / "box.h5"
    assert main([*WORDS, "--output", str(path)]) == 0
    return path


def assert_same_numbers(path, other):
    one, two = open_database(path), open_database(other)
    assert one.complete and two.complete
    np.testing.assert_allclose(one.omega, two.omega, rtol=1e-12)
    for name in one.names:
        size = np.abs(two[name]).max()
        np.testing.assert_allclose(one[name], two[name], rtol=1e-9, atol=1e-9 * size, err_msg=name)


def interrupted(path, number, delay, *more):
    """Start a long run, send a signal `delay` s after its first frequency; returns (status, output)."""
    words = [f"0.2:1.0:{MANY}" if word == "0.2:1.0:12" else word for word in WORDS]
    run = subprocess.Popen(
        command(*words, "--output", path, *more), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    said = ""
    for line in run.stdout:
        said += line
        if line.lstrip().startswith("1/"):
            break
    time.sleep(delay)
    run.send_signal(number)
    said += run.communicate(timeout=60)[0]  # a process left behind would keep the pipe open
    return run.returncode, said


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_a_killed_run_is_finished_by_the_same_command_with_the_same_numbers(tmp_path):
    outcome = campaign(tmp_path, kills=2)
    assert outcome.before_the_file + outcome.while_solving == 2
    assert outcome.compared > 50 and not outcome.different


def test_ctrl_c_says_how_to_go_on(tmp_path):
    path = tmp_path / "box.h5"
    status, said = interrupted(path, signal.SIGINT, 0.0)
    assert status == 130, said
    assert "Traceback" not in said and "run the same command to continue" in said
    assert 1 <= len(open_database(path).omega) < MANY


def test_ctrl_c_ends_the_processes_too(tmp_path):
    path = tmp_path / "box.h5"
    status, said = interrupted(path, signal.SIGINT, 0.0, "--executor", "processes:2")
    assert status == 130 and "Traceback" not in said, said
    assert 1 <= len(open_database(path).omega) < MANY


def test_processes_end_when_their_parent_is_killed(tmp_path):
    status, _ = interrupted(tmp_path / "box.h5", signal.SIGKILL, 0.0, "--executor", "processes:2")
    assert status == -signal.SIGKILL


def test_a_second_run_says_that_nothing_was_left_to_do(whole, capsys):
    before = whole.read_bytes()
    assert main([*WORDS, "--output", str(whole)]) == 0
    said = capsys.readouterr().out
    assert "12 of 12 frequencies stored" in said and "nothing was left to compute" in said
    assert "\x1b" not in said and whole.read_bytes() == before


def test_pressures_are_added_to_a_database_and_shown(whole, tmp_path):
    path, picture = tmp_path / "box.h5", tmp_path / "pressure.png"
    shutil.copy(whole, path)
    assert main([*WORDS[:-1], "pressure", "--output", str(path)]) == 0
    words = ["--field", "pressure", "--omega", "0.61", "--heading", "30", "--plot", str(picture)]
    assert main(["look", str(path), *words]) == 0
    assert picture.stat().st_size > 5_000


def test_two_processes_give_the_numbers_of_one(whole, tmp_path):
    path = tmp_path / "box.h5"
    done = subprocess.run(
        command(*WORDS, "--output", path, "--executor", "processes:2"), capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert_same_numbers(path, whole)


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_plot_draws_to_the_file_asked_for(whole, tmp_path, suffix):
    assert main(["plot", str(whole), "--output", str(tmp_path / f"box.{suffix}")]) == 0
    assert (tmp_path / f"box.{suffix}").stat().st_size > 10_000


def test_check_fails_when_a_law_is_broken_beyond_the_tolerance(tmp_path, capsys):
    import h5py

    path = tmp_path / "broken.h5"
    body = "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.3,0.5,0.7,0.9 --heading 0,30 --method contour"
    assert main([*body.split(), "--output", str(path)]) == 0
    assert main(["check", str(path)]) == 0
    with h5py.File(path, "r+") as file:
        file["checks/energy"][3] = 0.5
        file["row_checksum"][3] = row_crcs(file)[3]
    assert main(["check", str(path)]) == 1
    assert "1 above" in capsys.readouterr().out


def test_check_of_a_file_of_another_program_names_it(tmp_path, monkeypatch, capsys):
    import h5py

    monkeypatch.chdir(tmp_path)
    with h5py.File("other.h5", "w") as file:
        file.attrs["schema"] = "of others"
    assert main(["check", "other.h5"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("hakobune check: other.h5 is an HDF5 file of another program") and said.count("\n") == 1


def test_a_mesh_alone_needs_no_water_and_no_waves(tmp_path, capsys):
    from hakobune.meshing.files import read_mesh

    path = tmp_path / "box.gdf"
    flags = ["--length", "100", "--beam", "50", "--draft", "10", "--panels", "100", "--mesh-only", "--output"]
    assert main(["box", *flags, str(path)]) == 0
    np.testing.assert_allclose(read_mesh(path).volume, 50_000, rtol=1e-6)
    picture = tmp_path / "box.png"
    assert main(["look", str(path), "--plot", str(picture), "--field", "area"]) == 0
    assert picture.stat().st_size > 5_000


def test_a_body_from_a_mesh_file_gives_the_numbers_of_the_same_box(whole, tmp_path):
    from hakobune.meshing.files import write_mesh

    hull, path = tmp_path / "hull.gdf", tmp_path / "hull.h5"
    write_mesh(open_database(whole).mesh, hull)
    words = [
        "--depth",
        "20",
        "--gyration",
        "15.55,29.44,32.28",
        "--omega",
        "0.2,0.6",
        "--heading",
        "0",
        "--only",
        "radiation",
    ]
    assert main(["solve", "--mesh", str(hull), *words, "--output", str(path)]) == 0
    box = open_database(whole)
    mine, size = open_database(path)["added_mass"][0], np.abs(box["added_mass"][0]).max()
    # GDF files keep about seven digits of each coordinate
    np.testing.assert_allclose(mine, box["added_mass"][0], rtol=1e-4, atol=1e-5 * size)


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_every_scene_that_is_shipped_runs(scene, tmp_path):
    path = tmp_path / "out.h5"
    panels = "200" if scene.stem == "bodies_bridge" else "60"  # 20 or more on each of eight hulls
    words = ["--panels", panels, "--omega", "0.7", "--output", str(path)]
    too_few = scene.stem == "bodies_bridge"  # the drift of each hull is off by more than a tenth there, which is told
    assert main(["solve", str(scene), *words]) == too_few
    assert open_database(path).complete


@pytest.mark.parametrize("asked", [["keys"], ["fender", "--family", "cell", "--height", "2"]])  # words, a table
def test_a_reader_of_the_output_that_goes_away_ends_the_command_without_a_word(asked):
    words = [sys.executable, "-c", "import sys; from hakobune.pipelines.start import main; sys.exit(main())", *asked]
    run = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    run.stdout.close()
    assert (run.stderr.read(), run.wait()) == (b"", 128 + signal.SIGPIPE)
    run.stderr.close()


def test_every_flag_of_every_command_is_explained():
    bare = [
        f"{name} {flag.name}"
        for name in app
        if not name.startswith("-")
        for flag in app[name].assemble_argument_collection()
        if flag.show and not flag.parameter.help
    ]
    assert not bare
