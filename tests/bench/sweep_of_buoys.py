"""What a sweep of scenes costs beside the same scenes solved one by one.

    python tests/bench/sweep_of_buoys.py --cases 1000

One by one: each scene solved in this process into a database of its own.  Both in wall and processor time, one thread;
then the sweep by two processes.
"""

from __future__ import annotations

import argparse
import os
import resource
import tempfile
import time
from pathlib import Path

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[name] = "1"

SCENE = """want = ["radiation", "diffraction", "motions"]
water = {{ depth = 30.0 }}
waves = {{ omegas = {{ from = 0.4, to = 1.3, count = 10 }}, headings_deg = [0.0] }}
[[bodies]]
shape = "buoy"
radius = {radius!r}
draft = 5.0
gyration = [2.0, 2.0, 3.0]
"""
SWEEP = """command = "solve"
study = "buoy.toml"
vary = [{{ key = "bodies[0].radius", from = 3.0, to = 8.0, count = {cases} }}]
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=100)
    cases = parser.parse_args().cases
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "buoy.toml").write_text(SCENE.format(radius=5.0))
        (folder / "sweep.toml").write_text(SWEEP.format(cases=cases))
        each = _timed("one by one", lambda: _one_by_one(folder, cases))
        here = _timed("sweep", lambda: _sweep(folder, "local"))
        _timed("sweep, two processes", lambda: _sweep(folder, "processes:2"))
        print(f"overhead of the sweep: {100 * (here / each - 1):.1f} % of processor time")
        print(f"one file of {(folder / 'local.h5').stat().st_size / cases / 1e3:.1f} kB a case")


def _one_by_one(folder, cases):
    import numpy as np

    from hakobune.pipelines.scene.scene import make_scene, read_scene
    from hakobune.pipelines.solve.run import solve

    raw = read_scene(folder / "buoy.toml")
    (folder / "each").mkdir()
    for number, radius in enumerate(np.linspace(3.0, 8.0, cases).tolist()):
        raw["bodies"][0]["radius"] = radius
        solve(make_scene(raw), folder / "each" / f"{number}.h5")


def _sweep(folder, executor):
    from hakobune.pipelines import cli

    output = folder / f"{executor.partition(':')[0]}.h5"
    assert cli.main(["sweep", str(folder / "sweep.toml"), "--output", str(output), "--executor", executor]) == 0


def _timed(what, work):
    start, before = time.perf_counter(), _processor()
    work()
    used = _processor() - before
    print(f"{what}: {time.perf_counter() - start:.1f} s, {used:.1f} s of processors", flush=True)
    return used


def _processor():
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


if __name__ == "__main__":
    main()
