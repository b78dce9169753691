"""Areas that a stream meets, which kernels are compiled ahead by which files, what a long command says meanwhile."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines import compiling
from hakobune.pipelines.common.weather import streams
from hakobune.pipelines.downtime import result as of_downtime
from hakobune.pipelines.keys.kinds import SCENES

HULL = SimpleNamespace(length=100.0, beam=20.0, draft=5.0)


def test_a_current_meets_the_hull_below_the_water_and_wind_what_is_above(monkeypatch):
    """B d and L d; of wind the areas of the silhouette from ahead and from abeam"""
    monkeypatch.setattr("hakobune.mooring.loads.on_hull.silhouettes", lambda hull: ((160.0, 3.0), (800.0, 4.0)))
    assert streams._areas("current", HULL) == (100.0, 500.0)
    assert streams._areas("wind", HULL) == (160.0, 800.0)


@pytest.mark.parametrize("given, wanted", [
    ({}, (100.0, 500.0, 100.0)), ({"area_x": 7.0}, (7.0, 500.0, 100.0)), ({"area_y": 9.0}, (100.0, 9.0, 100.0)),
    ({"length": 90.0}, (100.0, 500.0, 90.0)), ({"area_x": 7.0, "area_y": 9.0, "length": 90.0}, (7.0, 9.0, 90.0)),
])  # fmt: skip
def test_areas_and_length_that_a_study_gives_stand_for_those_of_its_hull(given, wanted, monkeypatch):
    asked = {}
    monkeypatch.setattr("hakobune.mooring.loads.coefficients.hull_coefficients",
                        lambda angles, x, y, n, **sizes: asked.update(sizes, n=n))  # fmt: skip
    keys = dict.fromkeys((*streams.AREAS, "height", "n"))
    c = SimpleNamespace(x=[1.0, 1.0], y=[0.0, 0.0], **keys | given)
    streams._of_hull("current", c, np.zeros(2), HULL)
    assert (asked["area_x"], asked["area_y"], asked["length"]) == wanted and asked["n"] == [0.0, 0.0]
    streams._of_hull("current", c, np.zeros(2), None)
    assert (asked["area_x"], asked["area_y"], asked["length"]) == tuple(given.get(key, 1.0) for key in
                                                                          ("area_x", "area_y", "length"))  # fmt: skip


def test_kernels_are_compiled_ahead_by_studies_that_are_there_and_in_the_order_of_what_they_need():
    """Each row names a file that comes with the package; a database is there before the commands that take it"""
    rows = [*compiling.LINES, *compiling.BODIES]
    files = [word for _, *words in rows for word in words if str(word).endswith(".toml")]
    assert len(files) == len(rows) - 1 and all(file.is_file() and file.parent == SCENES for file in files)
    written = set()
    for _, *words in compiling.BODIES:
        if "--database" in words:
            assert words[words.index("--database") + 1] in written
        if "--output" in words:
            written.add(words[words.index("--output") + 1])
    assert written == {"contour.h5", "box.h5", "run.h5"}


@pytest.mark.parametrize("status, stderr, told", [
    (0, "", []), (1, "FAILS: a line parts", []),
    (2, "Traceback\nno memory\n", ["the kernels of b could not be compiled: no memory"]),
    (3, "", ["the kernels of b could not be compiled: no message"]),
])  # fmt: skip
def test_a_study_that_cannot_be_compiled_is_told_by_its_last_line(status, stderr, told, monkeypatch, capsys):
    asked = []

    def run(command, **more):
        asked.append(command[3:])
        return SimpleNamespace(returncode=status if command[3] == "two" else 0, stderr=stderr)

    monkeypatch.setattr(compiling.subprocess, "run", run)
    assert compiling.compile_all(((("a", "one", 1), ("b", "two")), (("c", "three"),))) == told
    assert sorted(asked) == [["one", "1"], ["three"], ["two"]] and asked.index(["one", "1"]) < asked.index(["two"])
    said = capsys.readouterr().out.splitlines()
    assert said[0] == "compiling kernels, by studies" and [line.split()[0] for line in said[1:]] == ["1", "2", "3"]
    assert all(" of 3 " in line for line in said[1:])


@pytest.mark.parametrize("given", [True, False])
def test_simulated_states_are_told_as_they_come_or_not_at_all(given, monkeypatch):
    said, found = [], SimpleNamespace()

    def moored(read, folder, db, states, executor, say):
        say("state 1")
        raise InterruptedError

    study = SimpleNamespace(lee=None, simulation="simulation")
    monkeypatch.setattr(of_downtime, "given", lambda *_: (study, ""))
    monkeypatch.setattr(of_downtime, "database_of", lambda path: found)
    monkeypatch.setattr(of_downtime, "moored", moored)
    with pytest.raises(InterruptedError):
        of_downtime.downtime("study", "db", say=said.append if given else None)
    assert said == ["state 1"] * given
