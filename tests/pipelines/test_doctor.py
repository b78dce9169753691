"""`hakobune doctor` and `hakobune --version`."""

import sysconfig
from importlib import metadata
from pathlib import Path
from subprocess import CompletedProcess

import hakobune
from hakobune.pipelines import cli, compiling, doctor


def test_the_doctor_finds_what_is_installed_and_names_what_is_not(capsys, monkeypatch):
    assert cli.main(["doctor"]) == 0
    out = capsys.readouterr().out
    assert f"numpy       {metadata.version('numpy')}" in out and "nothing is amiss" in out
    monkeypatch.setattr(doctor, "NEEDED", ("numpy", "no-such-library"))
    assert cli.main(["doctor"]) == 1
    assert "FAILS: no-such-library is missing: pip install no-such-library" in capsys.readouterr().out


def test_the_version_is_that_of_the_citation_and_of_the_changelog(capsys):
    assert cli.main(["--version"]) == 0
    version, root = capsys.readouterr().out.strip(), Path(__file__).parents[2]
    assert f"version: {version}" in (root / "CITATION.cff").read_text(encoding="utf-8").splitlines()
    sections = [one for one in (root / "CHANGELOG.md").read_text(encoding="utf-8").splitlines() if one[:3] == "## "]
    assert sections[0].split()[1] == version


def test_the_doctor_tells_where_the_package_is_and_names_what_an_old_installation_left(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(sysconfig, "get_path", lambda name: str(tmp_path))
    foreign, ours = tmp_path / "meshing", tmp_path / "bem"
    for folder, module in ((foreign, "triangle.py"), (ours, "stored_laws.py")):
        folder.mkdir()
        (folder / module).touch()
    assert cli.main(["doctor"]) == 1
    out = capsys.readouterr().out
    assert str(Path(hakobune.__file__).parent) in out.replace("\n", "")
    assert "FAILS: bem in" in out and "meshing in" not in out and "meshing," not in out


def test_kernels_are_compiled_by_commands_that_exist_and_one_that_cannot_run_is_named(capsys, monkeypatch):
    ran = []

    def run(command, **given):
        ran.append(command[3:])
        return CompletedProcess(command, 2 * ("moor" in command) + ("lines" in command), "", "hakobune moor: no box\n")

    monkeypatch.setattr(compiling.subprocess, "run", run)
    assert cli.main(["doctor", "--compile"]) == 1
    told = capsys.readouterr().out
    assert (
        "8 of 8" in told and "FAILS: the kernels of a moored body could not be compiled: hakobune moor: no box" in told
    )
    assert "the kernels of a system of lines could" not in told  # a verdict
    assert all(words[0] in cli.app for words in ran), ran
    assert all(Path(word).is_file() for words in ran for word in words if word.endswith(".toml"))


def test_the_doctor_tells_what_is_optional_and_missing_and_nothing_amiss_only_where_it_is_so(capsys, monkeypatch):
    monkeypatch.setattr(doctor, "OPTIONAL", {"no-such-library": "pictures of ships", "numpy": "numbers"})
    monkeypatch.setattr(doctor, "_gmsh", lambda: "")
    assert cli.main(["doctor"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "  no-such-library" in next(line for line in lines if "pictures of ships" in line)
    assert "missing   optional, pictures of ships" in next(line for line in lines if "pictures of ships" in line)
    assert next(line for line in lines if line.endswith("optional, numbers")).split()[1] == metadata.version("numpy")
    monkeypatch.setattr(doctor, "_gmsh", lambda: "gmsh is broken")
    assert cli.main(["doctor"]) == 1
    told = capsys.readouterr().out
    assert "nothing is amiss" not in told and "FAILS: gmsh is broken" in told


def test_kernels_are_compiled_ahead_by_scenes_that_are_there():
    """Every file of a run is a scene that is shipped; databases are made by an earlier run of the same table"""
    for table in (compiling.LINES, compiling.BODIES):
        for _, command, *words in table:
            files = [word for word in words if isinstance(word, Path)]
            assert len(files) == (command != "line") and all(
                file.is_file() and file.suffix == ".toml" for file in files
            )
