"""A file that is not what a command takes: one line that names it and the way out."""

import importlib
import shlex
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

from hakobune import pipelines
from hakobune.bem.database.integrity import remark
from hakobune.bem.database.results import OURS, READS, named
from hakobune.meshing.seals import SIGNATURE
from hakobune.mooring.criteria.failing import FAILS
from hakobune.pipelines.cli import main
from hakobune.pipelines.results.writing import NAMES, schema

SCENES = Path(pipelines.__file__).parent / "scenes"
BOX = (
    "box --length 100 --beam 50 --draft 10 --depth 20 --method contour --gyration 15.6,29.4,32.3 "
    "--omega 0.3:1.0:5 --heading 0,60,90,120,180 --output box.h5 "
    "--only radiation,limits,diffraction,kochin,motions,drift"
)
RESPONSE = "response response.toml --database {} --output response.h5"
SWEEP = 'command = "berth"\nstudy = "berth.toml"\n[[vary]]\nkey = "approach.speed"\nvalues = [0.05, 0.06]\n'
SHOWS = "look {} --plot shown.png", "plot {} --output shown.png", "export {} --to wamit --output other.1 --fresh"
WAVES = "animate {} --omega 0.5 --heading 60 --output film.gif", "waves {} --omega 0.5 --heading 60"
READERS = *SHOWS, *WAVES, "qtf {}", RESPONSE.replace("response.h5", "new.h5"), "moor moor.toml --database {}"
OF_KINDS = {  # modules that say which version of a kind of results they read
    "simulation": "hakobune.pipelines.simulate.file",
    "sweep": "hakobune.pipelines.sweep.file",
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        shutil.copy(SCENES / "response_box_20m.toml", "response.toml")
        shutil.copy(SCENES / "moor_chain_12.toml", "moor.toml")
        shutil.copy(SCENES / "berth_tanker.toml", "berth.toml")
        Path("sweep.toml").write_text(SWEEP)
        assert main(shlex.split(BOX)) in (0, 1)
        assert main(RESPONSE.format("box.h5").split()) in (0, 1)
        assert main(["sweep", "sweep.toml"]) in (0, 1)
        Path("text.h5").write_text("length,beam\n" * 99)
        Path("empty.h5").write_bytes(b"")
        for name in ("box", "response"):
            whole = Path(f"{name}.h5").read_bytes()
            Path(f"{name}_truncated.h5").write_bytes(whole[: 2 * len(whole) // 3])
    return folder


@pytest.fixture
def here(made, tmp_path, monkeypatch):
    shutil.copytree(made, tmp_path / "here")
    monkeypatch.chdir(tmp_path / "here")


def ended(words, capsys):
    """Status of a command and its lines"""
    capsys.readouterr()
    status = main(words.split())
    shown = capsys.readouterr()
    return status, (shown.out + shown.err).splitlines()


@pytest.mark.parametrize("words", READERS)
@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("text.h5", "is not an HDF5 file; a database made by 'hakobune solve' is needed"),
        ("empty.h5", "is not an HDF5 file; a database made by 'hakobune solve' is needed"),
        ("response.h5", "is a file of response study, not a hakobune database; one made by 'hakobune solve' is needed"),
        ("sweep.h5", "is a file of sweep, not a hakobune database; one made by 'hakobune solve' is needed"),
        ("box_truncated.h5", "is damaged: its end, which is truncated, by its checksum; copy it again, or "),
    ],
)
def test_what_is_no_database_is_told_as_what_it_is(words, name, says, here, capsys):
    status, lines = ended(words.format(name), capsys)
    assert status == 2 and len(lines) == 1 and f"{name} {says}" in lines[0], lines


@pytest.mark.parametrize("name", ["box.h5", "sweep.h5", "text.h5", "empty.h5"])
def test_what_holds_no_frames_of_a_line_is_told_with_the_command_that_makes_some(name, here, capsys):
    status, lines = ended(f"lines {name}", capsys)
    assert status == 2 and len(lines) == 1, lines
    assert (
        lines[0].endswith("'hakobune line-dynamics STUDY --output NAME.h5' writes the right one") and name in lines[0]
    )


def test_a_film_of_no_file_of_ours_asks_for_no_other_flags(here, capsys):
    for name in ("text.h5", "empty.h5", "none.h5"):
        status, lines = ended(f"animate {name} --length 5 --output film.gif", capsys)
        assert status == 2 and len(lines) == 1 and "--length" not in lines[0], lines


def of_next_version(name, sealed):
    """A file of the version after ours: behind a seal that it breaks, or written without one"""
    with h5py.File(name, "r+") as file:
        if "schema" in file.attrs:
            file.attrs["schema"] = f"{OURS}{named(file.attrs['schema'])} 3"
        else:
            file.attrs["schema_version"] = 2
    if not sealed:
        image = Path(name).read_bytes()
        Path(name).write_bytes(image[image.find(SIGNATURE) :])


@pytest.mark.parametrize("sealed", [True, False])
@pytest.mark.parametrize(
    ("name", "again"),
    [
        ("box.h5", "solve SCENE --output box.h5 --fresh"),
        ("response.h5", "response STUDY --database DATABASE --output response.h5"),
        ("sweep.h5", "sweep SWEEP --output sweep.h5 --fresh"),
    ],
)
def test_another_version_is_told_as_that_and_never_as_damage(name, again, sealed, here, capsys):
    of_next_version(name, sealed)
    for words in ("check {}", "animate {} --output film.gif", *(SHOWS if name == "box.h5" else ())):
        status, lines = ended(words.format(name), capsys)
        assert status == 2 and len(lines) == 1, lines
        versions = (2, 1) if name == "box.h5" else (3, 2)
        assert "of schema version {}, and this program reads version {}; make".format(*versions) in lines[0], lines
        assert f"make it again by 'hakobune {again}" in lines[0]
        assert "damaged" not in lines[0] and "checksum" not in lines[0]


def test_the_versions_that_are_told_are_those_that_are_read():
    schemas = {kind: importlib.import_module(module).SCHEMA for kind, module in OF_KINDS.items()}
    schemas |= {named(one): one for one in map(schema, (*NAMES, "sections"))}
    assert {kind: f"{OURS}{kind} {version}" for kind, version in READS.items()} == schemas


def test_a_truncated_result_fails_its_check(here, capsys):
    status, lines = ended("check response_truncated.h5", capsys)
    assert status == 1 and len(lines) == 1 and lines[0].startswith(f"{FAILS}response_truncated.h5 is damaged: "), lines


def test_a_sweep_is_told_by_the_cases_that_are_there(here, capsys):
    assert ended("check sweep.h5", capsys) == (
        0, ["sweep.h5: a file of a sweep; 2 of 2 cases are stored; a sweep has no checksums"]
    )  # fmt: skip
    with h5py.File("sweep.h5", "r+") as file:
        file["status"][1] = -1
    status, lines = ended("check sweep.h5", capsys)
    assert status == 1
    assert lines[-1] == f"{FAILS}1 cases are missing; 'hakobune sweep SWEEP --output sweep.h5' runs them"


def without(names, row=slice(None), solved=True):
    """No numbers in these quantities of the database, at one frequency or all of them"""
    with h5py.File("box.h5", "r+") as file:
        for name in names:
            file[name][row] = np.nan
            remark(file, name)
            if not solved:
                file["stored"][name][...] = 0
        if not solved:
            file["solved"][:] = 0


def test_numbers_that_are_unknown_at_one_frequency_fail_what_shows_them_and_end_what_reads_between(here, capsys):
    without(("added_mass", "excitation_force", "rao", "drift_force"), 2)
    for words in ("check {}", *SHOWS):
        status, lines = ended(words.format("box.h5"), capsys)
        told = [line for line in lines if line.startswith(FAILS)]
        assert status == 1 and told, (words, lines)
        assert f"{FAILS}box.h5: added_mass of surge, sway, heave, roll, pitch, yaw is not a number at 1 of 5" in told[0]
    for words in set(READERS) - set(SHOWS):
        status, lines = ended(words.format("box.h5"), capsys)
        assert status == 2 and len(lines) == 1, lines
        assert (
            "box.h5: added_mass is not a number at 1 of 5 frequencies, the first at ω = 0.65 rad/s; solve it again"
        ) in lines[0]


def test_a_database_in_which_nothing_is_solved_is_told_as_that(here, capsys):
    with h5py.File("box.h5") as file:
        names = list(file["stored"])
    without([name for name in names if "added_mass_" not in name], solved=False)
    for words in ("check {}", "look {} --plot shown.png"):
        status, lines = ended(words.format("box.h5"), capsys)
        assert status == 1 and any(line.startswith(FAILS) and " of 5 frequencies are " in line for line in lines), lines
    for words in set(READERS) - {SHOWS[0]}:
        status, lines = ended(words.format("box.h5"), capsys)
        assert status == 2 and len(lines) == 1 and "box.h5 " in lines[0] and " solved" in lines[0], lines
