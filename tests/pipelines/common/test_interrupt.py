"""What is said of a command that Ctrl-C ends at once."""

import pytest

from pipelines.cli import main

BOX = ["box", "--length", "10", "--beam", "5", "--draft", "1", "--depth", "5", "--omega", "1"]
KEPT = "; what was solved is stored, the same command goes on"


@pytest.mark.parametrize(
    ("words", "place", "said"),
    [
        (["plot", "box.h5"], "bem.database.open_database", ""),
        (["look", "box.h5", "--screenshot", "box.png"], "pipelines.view.looking.look", ""),
        (["sections"], "bem.sections.tables.tables", ""),
        ([*BOX, "--mesh-only"], "pipelines.solve.hull.make_hull", ""),
        (BOX, "pipelines.solve.run.solve", KEPT),
        (["compare", "sections"], "pipelines.reports.comparisons.sets.solved", KEPT),
    ],
)
def test_only_of_what_is_stored_is_said_that_it_is(words, place, said, tmp_path, monkeypatch, capsys):
    def interrupted(*arguments, **named):
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(place, interrupted)
    assert main(words) == 130
    assert capsys.readouterr().err == f"hakobune {words[0]}: interrupted{said}\n"
