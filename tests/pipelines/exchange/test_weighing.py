"""`hakobune body`: an imported database without mass becomes one that studies read."""

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.pipelines import cli

BOX = "--length 20 --beam 10 --draft 4 --depth 20 --omega 0.6:1.0:2 --heading 0,90 --gyration 3,6,6"


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """(solved, imported from its numbers without mass)"""
    place = tmp_path_factory.mktemp("bare")
    solved, imported = place / "box.h5", place / "bare.h5"
    assert cli.main(["box", *BOX.split(), "--output", str(solved)]) == 0
    assert cli.main(["export", str(solved), "--to", "wamit"]) == 0
    for suffix in (".4", ".8"):
        (place / f"box{suffix}").unlink(missing_ok=True)
    words = ["import", str(place / "box.1"), "--from", "wamit", "--depth", "20", "--output", str(imported)]
    assert cli.main(words) == 0
    return solved, imported


def test_with_radii_of_gyration_the_motions_are_those_of_the_solved_body(bare, tmp_path, capsys):
    solved, imported = bare
    output = tmp_path / "weighed.h5"
    assert cli.main(["body", str(imported), "--gyration", "3,6,6", "--output", str(output)]) == 0
    assert "mass 820000 kg" in capsys.readouterr().out  # 1025 · 20 · 10 · 4
    true, found = open_database(solved), open_database(output)
    assert np.abs(found["rao"] - true["rao"]).max() < 1e-4 * np.abs(true["rao"]).max()
    assert found.attributes["imported"] == open_database(imported).attributes["imported"]
    assert cli.main(["check", str(output)]) == 0
    capsys.readouterr()
    assert cli.main(["body", str(output), "--mass", "800000", "--frequencies", "0.5:0.7"]) == 0
    said = capsys.readouterr()
    assert "1 frequencies, mass 800000 kg" in said.out and "is not the displaced mass of 820000 kg" in said.err
    assert open_database(output).omega == pytest.approx([0.6])


def test_what_cannot_be_weighed_is_told(bare, tmp_path, capsys):
    solved, imported = bare
    for words, says in (
        (
            [solved, "--mass", "8e5"],
            "was solved by hakobune; give --gyration, --center-of-gravity and --mass to the command that made it",
        ),
        ([imported, "--mass", "8e5", "--output", solved], "exists already; give another name by --output"),
        ([imported, "--mass", "820"], "the hull displaces 820000 kg; allowed"),
        ([imported, "--frequencies", "2:3"], "selects no frequency; the files have 0.6 to 1 rad/s"),
        ([imported, "--frequencies", "3"], "allowed: from:to in rad/s, such as 0.2:1.5"),
    ):
        assert cli.main(["body", *map(str, words)]) == 2
        assert says in capsys.readouterr().err
    assert cli.main(["body", str(imported)]) == 0
    assert "no motions: give --gyration kxx,kyy,kzz" in capsys.readouterr().out
