"""The numbers of scenes and studies by two versions of the program, beside each other.

    python tests/bench/before_and_after.py BASE FOLDER [--only WORD ...]

BASE : a commit; it is cloned into FOLDER, where both versions run each job below in a folder of their own, one after
the other, and keep what they compile.  A job that has run is not run again.  Printed for each job: how many quantities
both have, the largest difference over the largest value of its quantity, where that is, and what one side alone has.
Status 1 if a difference is above 1e-12 or a quantity is gone.

Runs of a body between fenders with gaps are chaotic: one part in 10¹³ of the wind changes the largest deflection of one
run of `simulate_dolphins_B.toml` by half.  There a difference says that the last digits changed, not by how much.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).parents[2]
SCENES = "pipelines/scenes"
EQUAL = 1e-12
BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --gyration 15.55,29.44,32.28"
SOLVED = {  # name of the database: words of the command that makes it
    "series": "solve series_box.toml",
    "box": "solve series_box_20m.toml",
    "barge": "solve box_barge.toml",
    "floater_B": "solve box_floater_B.toml",
    "buoy": "solve buoy.toml",
    "model": "solve model_M3B_d194.toml",
    "pier": "solve bodies_barge_at_pier.toml",
    "panels": f"{BOX} --panels 300 --omega 0.2:1.0:6 --heading 0,30,90",
    "ship": "ship --length 200 --beam 32 --draft 11 --block 0.8 --depth 20 --panels 300 --omega 0.3:1:5 --heading 180",
}
STUDIES = (
    "berth berth_tanker.toml",
    "members members_dolphin.toml",
    "earthquake earthquake_box.toml",
    "breakwater breakwater_circle.toml",
    "breakwater breakwater_rectangle.toml",
    "lines lines_barge.toml --broken",
    "line-dynamics line_chain_60m.toml --duration 40",
    "line-dynamics line_chain_and_wire.toml --duration 40",
    "line --weight 111.3 --length 330 --depth 60 --tension 300 --stiffness 5e5 --characteristic",
    "fender --family cell --height 2 --angle 8 --width 2.4 --energy 900",
    "sea --height 3 --mean-period 8",
    "site site_bay.toml --output site_values.toml",
    "sections --beam-draft 5 --depth-draft 2,3 --xi 0.5,1",
    "sections sections_hinged.toml",
    "passing passing_tanker.toml",
    "single-point single_point_A.toml",
    "single-point single_point_tanker.toml",
    "single-point single_point_barge.toml --database box.h5",
    "moor moor_chain_12.toml --database box.h5",
    "moor moor_chain_and_wire.toml --database box.h5",
    "moor moor_catalogue_chain_12.toml --database box.h5",
    "response response_box_20m.toml --database box.h5",
    "response response_climate.toml --database box.h5",
    "waves box.h5 --period 10 --heading 90 --at 5,-60",
    "qtf barge.h5",
    "downtime downtime_box_20m.toml --database box.h5",
    "sweep sweep_berth.toml --output sweep.h5",
    "simulate simulate_chain_12.toml --database barge.h5 --output chain.h5 --seeds 1 --duration 600",
    "simulate simulate_quay.toml --database barge.h5 --output quay.h5 --seeds 1 --duration 600",
    "simulate simulate_dolphins.toml --database barge.h5 --output dolphins.h5 --seeds 1 --duration 600",
    "simulate simulate_dolphins_B.toml --database floater_B.h5 --output dolphins_B.h5 --seeds 1 --duration 600",
)
JOBS = {name: f"{words} --output {name}.h5" for name, words in SOLVED.items()}
JOBS |= {f"{number + 1:02d} {words}": words for number, words in enumerate(STUDIES)}


def cloned(commit, folder):
    """The program at a commit, below `folder`"""
    place = folder / "base"
    if not place.exists():
        subprocess.run(["git", "clone", "--quiet", "--no-checkout", str(ROOT), str(place)], check=True)
        subprocess.run(["git", "checkout", "--quiet", commit], cwd=place, check=True)
    return place


def run(job, source, folder):
    """Runs a job by the program of `source` once; its quantities, name: values, are kept as a file of numpy"""
    kept = folder / "found" / f"{job.split(' --')[0].replace(' ', '_')}.npz"
    if not kept.exists():
        kept.parent.mkdir(parents=True, exist_ok=True)
        for path in (source / SCENES).iterdir():
            if not (folder / path.name).exists() and path.is_file():
                shutil.copy(path, folder)
        words = JOBS[job].split()
        environment = os.environ | {"PYTHONPATH": str(source), "HAKOBUNE_CACHE": str(folder / "cache")}
        form = [] if job in SOLVED else ["--json"]
        command = [sys.executable, "-m", "hakobune", *words, *form]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
        if done.returncode not in (0, 1):
            raise SystemExit(f"{job}: status {done.returncode} by {source}: {done.stderr.strip()[-300:]}")
        np.savez(kept, **(of_database(folder / f"{job}.h5") if job in SOLVED else of_print(done.stdout)))
    with np.load(kept) as found:
        return dict(found)


def of_database(path):
    """Its datasets of numbers, without residuals, which are rounding"""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fc" and "checks" not in name:
            found[name] = item[()]

    with h5py.File(path) as file:
        file.visititems(take)
    return found


def of_print(text):
    """Quantities of a result in JSON, those that are numbers; what is null counts as NaN"""
    found = {}
    for name, one in json.loads(text.splitlines()[0])["quantities"].items():
        try:
            found[name] = np.array(one["values"], dtype=float)
        except (TypeError, ValueError):
            continue
    return found


def difference(one, other):
    """The largest difference over the largest value; infinity where shapes or what is NaN differ"""
    if one.shape != other.shape or (np.isnan(one) != np.isnan(other)).any():
        return np.inf
    one, other = one[np.isfinite(one)], other[np.isfinite(other)]
    if not one.size or one.size != other.size:
        return 0.0 if one.size == other.size else np.inf
    return np.abs(one - other).max() / (np.abs(one).max() or 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("base")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", nargs="*", default=[""])
    asked = parser.parse_args()
    base, failed = cloned(asked.base, asked.folder.resolve()), 0
    jobs = [job for job in JOBS if job in SOLVED or any(word in job for word in asked.only)]
    for job in jobs:
        sides = []
        for name, source in (("before", base), ("after", ROOT)):
            (folder := asked.folder.resolve() / name).mkdir(exist_ok=True)
            sides.append(run(job, source, folder))
        before, after = sides
        both = [name for name in before if name in after]
        worst = max(both, key=lambda name: difference(before[name], after[name]))
        size = difference(before[worst], after[worst])
        gone, new = sorted(set(before) - set(after)), sorted(set(after) - set(before))
        failed += size > EQUAL or bool(gone)
        print(f"{job[:60]:60} {len(both):4} {size:8.1e} {worst if size else ''} {f'gone: {gone}' if gone else ''} "
              f"{f'new: {new}' if new else ''}".rstrip(), flush=True)  # fmt: skip
    print(f"{len(jobs)} jobs, {failed} differ by more than {EQUAL:.0e}")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
