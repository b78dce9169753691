"""Kill a design again and again in the middle of its load cases, let it go on, and compare its report with a clean one.

    python tests/pipelines/kill_design.py project.toml [--kills 10] [--seed 0]

The databases are made once, and given to both.  SIGKILL falls at a random instant within a second of a new file of a
load case, or of a third of a run where no new file comes.  A run that ends before its kill has its report compared and
the folder begun again, so that every kill asked for falls; page and tables have to be the same to the byte each time,
and a last run, with nothing to make, is timed.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]


def run(project, folder, delay=None, latest=0.0):
    """Seconds of the command, and whether it was killed `delay` s after it stored a new file of a load case, or
    `latest` + `delay` s after its start"""
    words = [sys.executable, "-c", "import sys; from hakobune.pipelines.start import main; sys.exit(main())"]
    begun, surroundings = time.perf_counter(), {**os.environ, "PYTHONPATH": str(ROOT)}
    arguments, before = ["design", str(project), "--output", str(folder), "--no-advice"], cases(folder)
    process = subprocess.Popen([*words, *arguments], env=surroundings, stdout=subprocess.DEVNULL)
    while process.poll() is None:
        time.sleep(0.02)
        if delay is not None and (cases(folder) > before or time.perf_counter() - begun > latest):
            time.sleep(delay)
            process.kill()
            process.wait()
            return time.perf_counter() - begun, True
    if process.returncode not in (0, 1):  # 1: a criterion is not met
        raise SystemExit(f"the design ended with status {process.returncode}")
    return time.perf_counter() - begun, False


def cases(folder):
    """Number of load cases that are stored"""
    return len(list((folder / "cases").glob("*.h5")))


def tables(folder):
    """Page and tables of a folder, each to the byte"""
    return {one.name: one.read_bytes() for one in folder.glob("*.*")}


def campaign(project, kills, seed):
    """Print where the kills fell and what became of the report"""
    random = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as place:
        clean, killed = Path(place, "clean"), Path(place, "killed")
        whole, _ = run(project, clean)
        begin_again(clean, killed)
        fell, reports = [], []
        while len(fell) < kills:
            _, was = run(project, killed, random.uniform(0.0, 1.0), whole / 3)
            if was:
                fell.append(cases(killed))
            else:
                reports.append(tables(killed))
                begin_again(clean, killed)
        run(project, killed)
        last, _ = run(project, killed)
        reports.append(tables(killed))
        own = tables(clean)
        others = sorted({name for one in reports for name in {*one, *own} if one.get(name) != own.get(name)})
        print(
            f"whole run {whole:.1f} s, {cases(clean)} files of cases; {len(fell)} runs killed with "
            f"{', '.join(map(str, fell))} stored; {len(reports)} reports and tables of theirs: "
            f"{'differ in ' + ', '.join(others) if others else 'the same'}; a run with nothing to make {last:.1f} s"
        )
        return not others


def begin_again(clean, killed):
    """Empty the folder `killed` but for the databases of `clean`"""
    shutil.rmtree(killed, ignore_errors=True)
    if (clean / "databases").is_dir():
        shutil.copytree(clean / "databases", killed / "databases")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("project", type=Path)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    raise SystemExit(not campaign(given.project.resolve(), given.kills, given.seed))
