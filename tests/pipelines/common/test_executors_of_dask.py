"""Executors of dask and of Slurm, with both libraries replaced: what they are asked for, and every refusal."""

import logging
import shutil
import sys
from types import ModuleType, SimpleNamespace

import pytest

from hakobune.pipelines.executors import cluster


class Client:
    """Stand-in of a client: notes what is asked of it"""

    made = None

    def __init__(self, place, workers=2, **given):
        self.place, self.given, self.closed, self.waited, self.asked = place, given, 0, None, []
        self.workers = dict.fromkeys(range(workers))
        Client.made = self

    def scheduler_info(self, n_workers=5):
        assert n_workers == -1
        return {"workers": self.workers}

    def submit(self, *given, **more):
        self.asked.append((given, more))
        return "future"

    def wait_for_workers(self, count):
        self.waited = count

    def close(self):
        self.closed += 1


@pytest.fixture
def dask(monkeypatch):
    """Modules dask, distributed and dask_jobqueue; returns what is configured and which clusters are made"""
    known = SimpleNamespace(set=[], local=[], slurm=[], workers=2, refuses=None)

    class Set:
        def __init__(self, options):
            known.set.append(options)

        def __enter__(self):
            known.inside = True

        def __exit__(self, *_):
            known.inside = False

    def local(**given):
        assert known.inside
        known.local.append(given)
        return "local cluster"

    def client(place, **given):
        if known.refuses:
            raise known.refuses
        return Client(place, known.workers, **given)

    class Slurm:
        def __init__(self, **given):
            known.slurm.append(given)

        def scale(self, **given):
            known.slurm.append(given)

    for name, parts in (("dask", {"config": SimpleNamespace(set=Set)}),
                        ("distributed", {"Client": client, "LocalCluster": local}),
                        ("dask_jobqueue", {"SLURMCluster": Slurm})):  # fmt: skip
        module = ModuleType(name)
        module.__dict__.update(parts)
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.setattr(shutil, "which", lambda name: f"/bin/{name}" if name == "sbatch" else None)
    before = logging.getLogger("distributed").level
    yield known
    logging.getLogger("distributed").setLevel(before)


QUIET = {"distributed.scheduler.allowed-failures": cluster.LOST,
         "distributed.admin.large-graph-warning-threshold": "1GB"}  # fmt: skip


def test_processes_of_dask_have_one_thread_each_and_end_with_their_client(dask):
    made = cluster.here("dask:3", 3)
    assert dask.set == [QUIET, {"distributed.nanny.pre-spawn-environ": cluster.ONE_THREAD}]
    assert dask.local == [{"n_workers": 3, "threads_per_worker": 1, "dashboard_address": None}]
    assert Client.made.place == "local cluster" and made.count == 2
    assert logging.getLogger("distributed").level == logging.ERROR
    assert made.submit("function", 1, 2) == "future"
    assert Client.made.asked == [(("function", 1, 2), {"pure": False})]
    ended = []
    made._cluster = SimpleNamespace(close=lambda: ended.append(1))
    made.shutdown()
    assert Client.made.closed == 1 and ended == [1] and logging.getLogger("distributed").level == logging.CRITICAL


def test_a_scheduler_is_asked_for_ten_seconds_and_has_workers(dask):
    made = cluster.there("dask://host:8786", "host:8786")
    assert (Client.made.place, Client.made.given) == ("tcp://host:8786", {"timeout": 10}) and dask.set == [QUIET]
    made.shutdown()
    assert Client.made.closed == 1  # there is no cluster of its own to end
    dask.workers = 0
    with pytest.raises(ValueError) as refused:
        cluster.there("dask://host:8786", "host:8786")
    assert Client.made.closed == 1 and str(refused.value) == (
        "executor 'dask://host:8786': the scheduler has no workers; start some with: dask worker host:8786"
    )


@pytest.mark.parametrize("error, reason", [(OSError("timed out\nmore"), "timed out"), (ValueError(""), "ValueError")])
def test_a_scheduler_that_does_not_answer_is_told_with_its_reason(dask, error, reason):
    dask.refuses = error
    with pytest.raises(ValueError) as refused:
        cluster.there("dask://h:1", "h:1")
    assert str(refused.value) == (
        f"executor 'dask://h:1': no scheduler answers ({reason}); start one with: dask scheduler"
    )


def test_an_executor_has_at_least_one_worker(dask):
    dask.workers = 0
    assert cluster.here("dask:1", 1).count == 1


def test_jobs_of_slurm_have_one_core_and_one_thread_and_the_first_is_waited_for(dask, monkeypatch):
    made = cluster.slurm("slurm:20", 20)
    first, scaled = dask.slurm
    lines = [f"export {name}={value}" for name, value in cluster.ONE_THREAD.items()]
    assert first == {"cores": 1, "processes": 1, "memory": "4GB", "job_script_prologue": lines}
    assert scaled == {"jobs": 20} and Client.made.waited == 1 and made._cluster is Client.made.place
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(ValueError, match="executor 'slurm:20': sbatch is not found; run this on a machine that"):
        cluster.slurm("slurm:20", 20)


@pytest.mark.parametrize("lacks, call, package", [
    ("dask", lambda: cluster.here("dask:2", 2), "dask"), ("distributed", lambda: cluster.here("dask:2", 2), "dask"),
    ("dask_jobqueue", lambda: cluster.slurm("slurm:2", 2), "dask-jobqueue"),
])  # fmt: skip
def test_a_library_that_is_not_there_is_named_with_its_package(dask, monkeypatch, lacks, call, package):
    monkeypatch.setitem(sys.modules, lacks, None)
    text = "slurm:2" if package == "dask-jobqueue" else "dask:2"
    with pytest.raises(ValueError) as refused:
        call()
    assert str(refused.value) == cluster.MISSING.format(text=text, package=package)
