"""The study that `hakobune new study` writes, on the box of its scene."""

from hakobune.pipelines.cli import main


def test_the_first_study_of_a_newcomer_holds(database, tmp_path, monkeypatch, capsys):
    """No line beyond the allowable tension or off its anchor, roll far from where linear theory ends, nothing fails"""
    monkeypatch.chdir(tmp_path)
    assert main(["new", "study"]) == 0
    assert main(["moor", "study.toml", "--database", str(database.path), "--output", "moor.h5"]) == 0
    said = "".join(capsys.readouterr())
    assert "largest tension" in said and "allowable 40 %" in said
    assert not any(word in said for word in ("FAILS", "lifting the anchor", "no viscous damping", "not realistic"))
