"""`hakobune check` of what the studies write: it tells whether a result is still what was written."""

import shutil
from pathlib import Path

import h5py
import pytest

from hakobune import pipelines
from hakobune.pipelines.cli import main

SCENES = Path(pipelines.__file__).parent / "scenes"
BOX = (
    "box --length 100 --beam 40 --draft 12 --depth 30 --method contour --gyration 13,25,26 "
    "--omega 0.3:1.0:5 --heading 0,60,90,120,180 --output box.h5 "
    "--only radiation,limits,diffraction,kochin,motions,drift"
)
RESULTS = {
    "sections.h5": "sections --beam-draft 5 --depth-draft 2 --xi 1 --tolerance 1e-3 --output sections.h5",
    "sections.csv": "sections --beam-draft 5 --depth-draft 2 --xi 1 --tolerance 1e-3 --output sections.csv",
    "record.csv": "sea --height 3 --mean-period 8 --duration 60 --record record.csv",
    "spectrum.csv": "sea --height 3 --mean-period 8 --output spectrum.csv",
    "response.h5": "response response.toml --database box.h5 --output response.h5",
    "response.csv": "response response.toml --database box.h5 --output response.csv",
}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        shutil.copy(SCENES / "response_box_20m.toml", "response.toml")
        assert main(BOX.split()) in (0, 1)
        for command in RESULTS.values():
            assert main(command.split()) == command.startswith("response")  # whose air gap is used up
    return folder


@pytest.fixture
def here(made, tmp_path, monkeypatch):
    shutil.copytree(made, tmp_path / "here")
    monkeypatch.chdir(tmp_path / "here")


@pytest.mark.parametrize("name", RESULTS)
def test_a_whole_result_passes_and_a_damaged_one_fails(name, here, capsys):
    assert main(["check", name]) == 0
    said = capsys.readouterr().out
    assert said.startswith(f"{name}: a ") and said.endswith("unchanged since it was written\n")
    assert said.count("\n") == 1
    content = Path(name).read_bytes()
    Path(name).write_bytes(content[:-20] + bytes([content[-20] ^ 1]) + content[-19:])
    assert main(["check", name]) == 1
    said = capsys.readouterr().out
    assert said.startswith(f"FAILS: {name} is damaged: ") and said.count("\n") == 1


def test_a_result_whose_database_has_changed_says_so(here, capsys):
    with h5py.File("box.h5", "r+") as file:
        file["wall_time"][0] = b"{}"
    assert main(["check", "response.h5"]) == 0
    assert "warning: the database it was made with, box.h5, has changed since" in capsys.readouterr().out
    Path("box.h5").unlink()
    assert main(["check", "response.h5"]) == 0
    assert "the database it was made with, box.h5, does not exist" in capsys.readouterr().out


def test_a_result_without_a_checksum_does_not_pass(here, capsys):
    with h5py.File("old.h5", "w") as file:
        file.attrs["schema"] = "hakobune mooring study 2"
    Path("old.csv").write_text("# a table\nx,y\n1,2\n")
    for name, what in (("old.h5", "file of mooring study"), ("old.csv", "table")):
        assert main(["check", name]) == 1
        assert f"{name}: a {what} without a checksum" in capsys.readouterr().out


def test_damaged_results_are_not_read_nor_replaced(here, capsys):
    for name, command in (("record.csv", "sea record.csv"), ("spectrum.csv", "sea --table spectrum.csv")):
        Path(name).write_text(Path(name).read_text()[:-4] + "\n")
        assert main(command.split()) == 2
        assert f"{name} is damaged: its lines do not match" in capsys.readouterr().err
    content = Path("sections.h5").read_bytes()
    Path("sections.h5").write_bytes(content[:-20] + bytes([content[-20] ^ 1]) + content[-19:])
    assert main(RESULTS["sections.h5"].split()) == 2
    assert "sections.h5 is damaged" in capsys.readouterr().err


def test_results_are_not_repaired_and_what_is_missing_is_asked_wrongly(here, capsys):
    for words in (["sections.h5", "--repair"], ["sections.csv", "--repair"], ["none.csv"], ["none.h5"]):
        assert main(["check", *words]) == 2
        assert capsys.readouterr().err.count("\n") == 1
