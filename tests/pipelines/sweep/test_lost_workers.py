"""A sweep of scenes whose workers are killed: what is there afterwards is, to the bit, what one process makes."""

import os
import signal

import h5py
import numpy as np
import pytest

from hakobune.pipelines import cli
from hakobune.pipelines.executors import choice
from hakobune.pipelines.executors.processes import Processes
from hakobune.pipelines.sweep import file, run

SCENE = """panels = 60
want = ["radiation", "diffraction", "motions"]
water = { depth = 30.0 }
waves = { omegas = [0.6, 0.9], headings_deg = [0.0, 45.0] }
[[bodies]]
shape = "buoy"
radius = 5.0
draft = 5.0
gyration = [2.0, 2.0, 3.0]
"""
SWEEP = """command = "solve"
study = "buoy.toml"
vary = [{ key = "bodies[0].radius", from = 3.0, to = 8.0, count = 8 }]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("scenes")
    (place / "buoy.toml").write_text(SCENE)
    (place / "sweep.toml").write_text(SWEEP)
    assert cli.main(["sweep", str(place / "sweep.toml"), "--output", str(place / "one.h5")]) == 0
    return place


def contents(path):
    found = {}
    with h5py.File(path) as opened:
        opened.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def same(first, second):
    one, two = contents(first), contents(second)
    assert one.keys() == two.keys()
    return all(np.array_equal(one[name], two[name], equal_nan=one[name].dtype.kind in "fc") for name in one)


def kill_at_first_result(monkeypatch, processes):
    """Kill the first of processes() once a result is stored; returns what was killed"""
    store, killed = file.store, []

    def killing(*arguments):
        store(*arguments)
        if not killed:
            killed.append(processes()[0])
            os.kill(killed[0], signal.SIGKILL)

    monkeypatch.setattr(run.file, "store", killing)
    return killed


def test_the_file_of_all_cases_has_the_numbers_of_each(folder, tmp_path):
    from hakobune.bem.database import open_database

    radius = float(contents(folder / "one.h5")["keys/bodies[0].radius"][3])
    (tmp_path / "buoy.toml").write_text(SCENE.replace("radius = 5.0", f"radius = {radius!r}"))
    assert cli.main(["solve", str(tmp_path / "buoy.toml"), "--output", str(tmp_path / "buoy.h5")]) == 0
    db, found = open_database(tmp_path / "buoy.h5"), contents(folder / "one.h5")
    for name in ("added_mass", "excitation_force", "rao"):
        assert np.array_equal(found[f"results/{name}"][3], db[name])


def test_a_killed_process_is_told_of_and_its_cases_are_done_by_the_next_run(folder, monkeypatch, capsys):
    workers = Processes(2)
    monkeypatch.setattr("hakobune.pipelines.sweep.result.executor_of", lambda text: workers)
    killed = kill_at_first_result(monkeypatch, lambda: list(workers._processes))
    command = ["sweep", str(folder / "sweep.toml"), "--output", str(folder / "two.h5")]
    assert cli.main(command) == 1 and killed
    told = capsys.readouterr()
    assert "cases were not run" in told.out + told.err
    monkeypatch.undo()
    assert cli.main(command) == 0
    assert same(folder / "one.h5", folder / "two.h5")


def test_dask_does_the_work_of_a_killed_worker_again(folder, monkeypatch):
    pytest.importorskip("distributed")
    made = choice.executor_of("dask:2")
    monkeypatch.setattr("hakobune.pipelines.sweep.result.executor_of", lambda text: made)
    killed = kill_at_first_result(monkeypatch, lambda: list(made._client.run(os.getpid).values()))
    assert cli.main(["sweep", str(folder / "sweep.toml"), "--output", str(folder / "dask.h5")]) == 0 and killed
    assert same(folder / "one.h5", folder / "dask.h5")


@pytest.mark.parametrize(
    "text", ["dask", "dask:", "dask:0", "dask://", "processes:257", "cluster:2", "slurm:0", "dask:x"]
)
def test_other_executors_are_refused(text):
    with pytest.raises(ValueError, match="allowed: local, processes:N, dask:N"):
        choice.executor_of(text)


def test_a_scheduler_that_is_not_there_is_named(monkeypatch):
    pytest.importorskip("distributed")
    pytest.importorskip("dask_jobqueue")
    monkeypatch.setenv("PATH", "")
    with pytest.raises(ValueError, match="sbatch is not found; run this on a machine that submits Slurm jobs"):
        choice.executor_of("slurm:4")
