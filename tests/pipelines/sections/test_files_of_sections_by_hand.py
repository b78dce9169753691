"""What `hakobune sections` writes, prints and refuses, with the computation replaced."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.printing import console
from hakobune.pipelines.sections import command
from hakobune.pipelines.sections import result as of_sections


class Made(dict):
    def __init__(self):
        super().__init__(M_H=np.zeros((2, 3)))
        self.files, self.detail, self.labels = [], ["a row"], {"shape": None, "frequency": None}

    def write(self, path):
        self.files.append(path)


@pytest.fixture
def made(monkeypatch):
    made, asked = Made(), []
    monkeypatch.setattr(of_sections, "sections", lambda *given, **grid: asked.append((given, grid)) or made)
    monkeypatch.setattr(command, "csv_text", lambda rows, tolerance: f"# a table\n{len(rows)} {tolerance:g}\n")
    monkeypatch.setattr(console, "document", lambda result: False)
    made.asked = asked
    return made


def test_a_grid_is_taken_from_its_flags_and_told_where_it_is_written(made, tmp_path, capsys):
    assert command.sections(beam_draft="5,10", xi="0.5:1:3", tolerance=1e-4) == 0
    assert made.asked == [((), {"beam_draft": [5.0, 10.0], "xi": [0.5, 0.75, 1.0], "tolerance": 1e-4})]
    assert capsys.readouterr().out == "# a table\n1 0.0001\n"
    table = tmp_path / "t.csv"
    assert command.sections(output=table) == 0
    assert capsys.readouterr().out == f"{table}: 2 shape, 3 frequency\n" and "1 1e-06" in table.read_text()
    whole = tmp_path / "t.h5"
    assert command.sections(output=whole) == 0 and made.files == [whole]
    assert capsys.readouterr().out == f"{whole}: 2 shape, 3 frequency\n"


def test_a_document_is_printed_once(made, monkeypatch, capsys):
    monkeypatch.setattr(console, "document", lambda result: result is made)
    assert command.sections() == 0 and capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("1,2,1", "--xi is '1,2,1'; give each number once"),
        ("2:1:3", "--xi is '2:1:3'; allowed: start:stop:count with start below"),
        ("1:1:3", "--xi is '1:1:3'; allowed"),
        ("1:inf:3", "--xi is '1:inf:3'; allowed"),
        ("1:2:1", "--xi"),
    ],
)
def test_a_grid_rises_and_has_each_number_once(made, text, says):
    with pytest.raises(ValueError) as error:
        command.sections(xi=text)
    assert str(error.value).startswith(says) and made.asked == []


def test_a_study_of_sections_is_printed_and_written(made, monkeypatch, tmp_path, capsys):
    from hakobune.pipelines.results import output, tables

    said = []
    monkeypatch.setattr(tables, "printed", lambda result: said.append("printed") or 5)
    monkeypatch.setattr(output, "check_result", lambda *given: said.append(given))
    monkeypatch.setattr(output, "write_result", lambda *given: said.append(given))
    study, path = Path("s.toml"), tmp_path / "r.h5"
    assert command.sections(study) == 5 and said == ["printed"] and made.asked == [((study,), {})]
    said.clear()
    assert command.sections(study, output=path) == 5
    assert said == [(path, "sections", [study]), (made, path), "printed"] and capsys.readouterr().out == f"{path}\n"
    for flag in ("beam_draft", "depth_draft", "xi"):
        name = f"--{flag.replace('_', '-')}"
        with pytest.raises(ValueError, match=rf"{name} is given together with s\.toml; give only one"):
            command.sections(study, **{flag: "1"})


def test_a_file_is_a_table_of_sections_by_its_first_line(tmp_path):
    path = tmp_path / "t.csv"
    for line, is_one in ((f"# {of_sections.NOTES[0]}", True), ("# else", False), (of_sections.NOTES[0], False)):
        path.write_text(f"{line}\na,b\n")
        assert command.is_table(path) is is_one


def test_results_are_written_drawn_and_named(monkeypatch, tmp_path, capsys):
    from hakobune.pipelines.results import output, tables

    said = []
    monkeypatch.setattr(tables, "printed", lambda result: said.append("printed") or 4)
    made = SimpleNamespace(write=lambda path: said.append(("write", path)))
    whole, plot = tmp_path / "r.h5", tmp_path / "p.png"

    def drawn_whole(result, path):
        result.write(path)

    def drawn(result, path):
        said.append(("draw", result, path))

    assert output.finish(made, (whole, drawn_whole), (None, None), (plot, drawn)) == 4
    assert said == [("write", whole), ("draw", made, plot), "printed"]
    assert capsys.readouterr().out == f"{whole}\n{plot}\n"
    said.clear()
    assert output.finish(made) == 4 and said == ["printed"] and capsys.readouterr().out == ""
    table = SimpleNamespace(kind="moor", told=("FAILS: it",), notes=("a note",), to_csv=lambda: "a,b\n1,2\n")
    output.write_result(table, tmp_path / "r.CSV")
    lines = (tmp_path / "r.CSV").read_text().splitlines()
    assert (
        lines[0] == "# result of hakobune moor"
        and "# FAILS: it" in lines
        and any(line.startswith("# a note") for line in lines)
        and lines[-2:] == ["a,b", "1,2"]
    )
    assert output._is_one(tmp_path / "r.CSV", "moor") and not output._is_one(tmp_path / "r.CSV", "sea")
