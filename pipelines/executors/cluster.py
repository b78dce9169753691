"""Work through a scheduler: a dask cluster of this machine, an external dask cluster, or jobs of Slurm.

The loss of a worker costs only time: another worker repeats its work (dask, up to `LOST` times).
Workers elsewhere need
the same hakobune and, for studies, the same folders.
"""

import logging

LOST = 3  # workers lost by one piece of work before it counts as failed
ONE_THREAD = {"OMP_NUM_THREADS": 1, "OPENBLAS_NUM_THREADS": 1, "NUMBA_NUM_THREADS": 1}
MISSING = "executor {text!r} needs {package}; install it with: pip install 'hakobune[cluster]'"


class Dask:
    """An executor on a dask client; cluster : closed with the executor, or None for an external one.

    count : its initial number of workers
    """

    def __init__(self, client, cluster=None):
        self._client, self._cluster = client, cluster
        self.count = max(1, len(client.scheduler_info(n_workers=-1)["workers"]))

    def submit(self, function, *arguments):
        """A future of one call; an equal call is repeated"""
        return self._client.submit(function, *arguments, pure=False)

    def shutdown(self, wait=True, cancel_futures=False):
        """Leave the scheduler, and end a cluster that was started here"""
        logging.getLogger("distributed").setLevel(logging.CRITICAL)  # dask reports closing connections at length
        for one in (self._client, self._cluster):
            if one is not None:
                one.close()


def here(text, count):
    """A cluster of `count` processes on this machine, each with one thread.  Raises ValueError without dask."""
    dask, distributed = _imported(text)
    with dask.config.set({"distributed.nanny.pre-spawn-environ": ONE_THREAD}):
        cluster = distributed.LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None)
    return Dask(distributed.Client(cluster), cluster)


def there(text, address):
    """The cluster of a scheduler at host:port.  Raises ValueError without an answer."""
    _, distributed = _imported(text)
    try:
        client = distributed.Client(f"tcp://{address}", timeout=10)
    except (OSError, ValueError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise ValueError(
            f"executor {text!r}: no scheduler answers ({reason}); start one with: dask scheduler"
        ) from None
    if not client.scheduler_info(n_workers=-1)["workers"]:
        client.close()
        raise ValueError(f"executor {text!r}: the scheduler has no workers; start some with: dask worker {address}")
    return Dask(client)


def slurm(text, count):
    """`count` jobs of Slurm, each a worker with one thread, as configured in ~/.config/dask/jobqueue.yaml.

    Raises ValueError without dask-jobqueue or without Slurm.
    """
    from shutil import which

    _, distributed = _imported(text)
    try:
        from dask_jobqueue import SLURMCluster
    except ImportError:
        raise ValueError(MISSING.format(text=text, package="dask-jobqueue")) from None
    if which("sbatch") is None:
        raise ValueError(f"executor {text!r}: sbatch is not found; run this on a machine that submits Slurm jobs")
    lines = [f"export {name}={value}" for name, value in ONE_THREAD.items()]
    cluster = SLURMCluster(cores=1, processes=1, memory="4GB", job_script_prologue=lines)
    cluster.scale(jobs=count)
    client = distributed.Client(cluster)
    client.wait_for_workers(1)
    return Dask(client, cluster)


def _imported(text):
    try:
        import dask
        import distributed
    except ImportError:
        raise ValueError(MISSING.format(text=text, package="dask")) from None
    dask.config.set(
        {"distributed.scheduler.allowed-failures": LOST, "distributed.admin.large-graph-warning-threshold": "1GB"}
    )
    logging.getLogger("distributed").setLevel(logging.ERROR)
    return dask, distributed
