"""`hakobune doctor` and `hakobune --version`."""

import sysconfig
from importlib import metadata
from pathlib import Path

import hakobune
from hakobune.pipelines import cli, doctor


def test_the_doctor_finds_what_is_installed_and_names_what_is_not(capsys, monkeypatch):
    assert cli.main(["doctor"]) == 0
    out = capsys.readouterr().out
    assert f"numpy       {metadata.version('numpy')}" in out and "nothing is amiss" in out
    monkeypatch.setattr(doctor, "NEEDED", ("numpy", "no-such-library"))
    assert cli.main(["doctor"]) == 1
    assert "FAILS: no-such-library is missing: pip install no-such-library" in capsys.readouterr().out


def test_the_version_is_that_of_the_distribution(capsys):
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out.strip() == metadata.version("hakobune")


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
