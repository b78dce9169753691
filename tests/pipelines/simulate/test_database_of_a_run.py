"""The database of a run's file: where it was, or beside the file; a film without it has a flat surface and says so."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.films.of_run import _waves
from hakobune.pipelines.simulate.file import database_path


def run_in(folder, database):
    return SimpleNamespace(filename=str(folder / "run.h5"), attrs={"database": database})


def test_a_database_is_where_it_was_or_beside_the_run(tmp_path, monkeypatch):
    there, moved = tmp_path / "there", tmp_path / "moved"
    for folder in (there, moved):
        folder.mkdir()
    monkeypatch.chdir(there)
    assert str(database_path(run_in(moved, "box.h5"))) == "box.h5"  # nowhere: the name is that of the message
    (moved / "box.h5").touch()
    assert database_path(run_in(moved, "../other/box.h5")) == moved / "box.h5"
    (there / "box.h5").touch()
    assert str(database_path(run_in(moved, "box.h5"))) == "box.h5"


def test_a_film_without_its_database_says_that_its_surface_is_flat(tmp_path):
    with pytest.warns(UserWarning, match="the surface is drawn flat, since waves need the database of the run: .*box"):
        assert _waves(run_in(tmp_path, str(tmp_path / "box.h5")), 1) is None
