"""No command replaces what another made, or a person wrote; each replaces what it made itself."""

from pathlib import Path

import h5py
import pytest

from hakobune import pipelines
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.outputs import check_output, opening

STUDY = str(Path(pipelines.__file__).parent / "scenes" / "response_box_20m.toml")
SEA = ["sea", "--height", "3", "--mean-period", "8"]
RECORD = [*SEA, "--duration", "60", "--record"]
SECTIONS = ["sections", "--beam-draft", "5", "--depth-draft", "2", "--xi", "1", "--tolerance", "1e-3", "--output"]
STRESS = ["stress", "--scenes", "1", "--waves", "1e-9", "--output"]  # that one is left out
RESPONSE = ["response", STUDY, "--database", "box.h5", "--output"]
TEXTS = {
    "scene.toml": "[water]\ndepth = 20.0\n",
    "stress.csv": "# seed 1, method auto\nnumber,shape\n",
    "measured.csv": "time_s,elevation_m\n0,1\n1,2\n",
    "spectrum.csv": "omega_rad_s,density_m2_s_rad\n0.5,1\n1,2\n",
}
WRONG = {
    "stress": (STRESS, ("box.h5", "scene.toml", "measured.csv")),
    "record": (RECORD, ("box.h5", "scene.toml", "measured.csv", "spectrum.csv", "stress.csv")),
    "spectrum": ([*SEA, "--output"], ("box.h5", "scene.toml", "measured.csv", "spectrum.csv", "stress.csv")),
    "sections": (SECTIONS, ("box.h5", "measured.csv", "stress.csv")),
    "response": (RESPONSE, ("stress.csv", "measured.csv", "other.h5")),
}


@pytest.fixture
def things(tmp_path, monkeypatch):
    """A folder with a database, another HDF5 file, a scene and tables, in which the test runs."""
    monkeypatch.chdir(tmp_path)
    for name, text in TEXTS.items():
        Path(name).write_text(text)
    for name, attribute in (("box.h5", "format"), ("other.h5", "schema")):
        with h5py.File(name, "w") as file:
            file.attrs[attribute] = "hakobune database"
    return tmp_path


@pytest.mark.parametrize(("command", "name"), [(command, name) for command, names in WRONG.values() for name in names])
def test_a_file_of_another_kind_is_not_replaced(command, name, things, capsys):
    before = {path.name: path.read_bytes() for path in things.iterdir()}
    assert main([*command, name]) == 2
    said = capsys.readouterr()
    assert f"{name} is not a" in said.err, said
    assert said.err.endswith("is not replaced; give another name\n") and said.err.count("\n") == 1
    assert {path.name: path.read_bytes() for path in things.iterdir()} == before


@pytest.mark.parametrize(
    ("command", "name"),
    [(STRESS, "a.csv"), (RECORD, "a.csv"), ([*SEA, "--output"], "a.csv"), (SECTIONS, "a.csv"), (SECTIONS, "a.h5")],
)
def test_a_command_replaces_what_it_made(command, name, things):
    for _ in range(2):
        assert main([*command, name]) == 0
    assert Path(name).stat().st_size > 100


def test_a_place_where_no_file_can_be_is_told_before_any_work(tmp_path):
    with pytest.raises(ValueError, match=r"cannot be written: the folder .*nowhere does not exist"):
        check_output(tmp_path / "nowhere" / "a.csv", "a table", lambda path: True, (".csv",))
    with pytest.raises(ValueError, match="is a folder"):
        check_output(tmp_path, "a table", lambda path: True, (".csv",))


def test_the_opening_of_a_table_is_its_first_line_and_its_columns(tmp_path):
    path = tmp_path / "a"
    for data, found in (
        (b"# a\n# b\nx,y\n1,2\n", ("# a", "x,y")),
        (b"x,y\n1,2\n", ("x,y", "x,y")),
        (b"# a\n", ("# a", "")),
        (b"\x89HDF\r\n\x1a\n", ("", "")),
        (b"", ("", "")),
    ):
        path.write_bytes(data)
        assert opening(path) == found
    assert opening(tmp_path / "none") == ("", "")


NAMED = ("line-dynamics", "passing", "lines", "moor --database body.h5", "single-point", "breakwater", "site",
         "sections", "earthquake")  # fmt: skip


@pytest.mark.parametrize("command", NAMED)
def test_where_a_result_goes_is_looked_at_before_the_study(command, tmp_path, monkeypatch, capsys):
    """Neither read nor replaced: the study cannot be one of these commands, which would be told afterwards"""
    monkeypatch.chdir(tmp_path)
    before = {"study.toml": b"nothing = 1\n", "body.h5": b"", "made.csv": b"a,b\n1,2\n"}
    for name, content in before.items():
        Path(name).write_bytes(content)
    words = command.split()
    for name, said in (
        ("found.txt", "found.txt has the suffix '.txt'; allowed suffixes: "),
        ("study.toml", "study.toml is an input of the st"),
        ("made.csv", "made.csv "), ("none/found.h5", "cannot be written: the folder none does not exist"),
    ):  # fmt: skip
        assert main([words[0], "study.toml", *words[1:], "--output", name]) == 2
        told = capsys.readouterr().err
        assert said in told and "unknown" not in told and "missing" not in told
        assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
