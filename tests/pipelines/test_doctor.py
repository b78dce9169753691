"""`hakobune doctor` and `hakobune --version`."""

from importlib import metadata

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
