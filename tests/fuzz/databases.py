"""Random damage to stored files: every one has to be refused, or to change nothing that is read.

    python tests/fuzz/databases.py --flips 10000 --seed 1

Of each copy of a database, or of a result of another command, 1 to 64 bytes in a row are replaced at random, and
everything that a reader may ask for is read.  Counts: refused in one line; harmless, all as before; fewer rows, a lost
mark with which the run solves again; believed, other numbers without a word; crashed, a signal or an exception that
is no line.  Work is done by a second process, since HDF5 may be brought to its end by what it reads.
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import multiprocessing
import os
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2])]

from hakobune import pipelines

SECONDS = 20.0
TIME = """
[simulation]
duration = 20.0
ramp = 5.0
seeds = 2
keep_series = 1
tolerance = 1e-2
memory = "constant"
dynamic_lines = "none"
qtf = "newman"
"""


def everything(path):
    """Whatever a reader may ask of a file, as a list of names and values"""
    from hakobune.bem.database.results import opened_result, schema_of
    from hakobune.meshing.seals import is_sealed, kind_filled_in
    from hakobune.meshing.text_files import read_text
    from hakobune.pipelines.simulate.file import is_run

    path = Path(path)
    if path.suffix == ".csv":
        return [(i, line) for i, line in enumerate(read_text(path).splitlines()) if not line.startswith("#")]
    if is_run(path):
        return simulation(path)
    if is_sealed(path) and not kind_filled_in(path):
        with opened_result(path, schema_of(path)) as file:
            found = [*file.attrs.items()]
            file.visititems(lambda name, item: found.append((name, item[()])) if hasattr(item, "shape") else None)
            return found
    from hakobune.bem.database import open_database

    db = open_database(path)
    found = [(name, db[name]) for name in db.names]
    found += [*db.checks().items(), *db.estimated_errors().items(), *db.header.body.items()]
    found += [(name, db[name]) for name in ("omega", "wave_direction", "theta", "period", "wavenumber")]
    fixed = db.mesh.points, db.mesh.corners, db.rotation_center, db.water_depth, db.density, db.gravity
    return found + [("fixed", np.concatenate([np.ravel(part) for part in fixed])), ("scene", db.header.scene)]


def simulation(path):
    """What the reader of a simulation finds: its seeds that are whole, and the statistics over them if these are"""
    from hakobune.pipelines.simulate.file import opened, row_values, summary_is_whole, whole_rows

    with opened(path) as file:
        whole = whole_rows(file)
        names = ("kept_seed", "time", "dof", "slow_dof", "line", "quantity", "statistic", "anchor", "fairlead")
        found = [("omega", file["seed"][()][whole]), *file.attrs.items(), *((name, file[name][()]) for name in names)]
        found.append(("summary", file["summary"][()] if summary_is_whole(file) else "to be made again"))
        return found + [(f"seed {row} {name}", value) for row in np.flatnonzero(whole) for name, value in
                        row_values(file, int(row)).items()]  # fmt: skip


def same(one, other):
    """Whether two readings are equal to the last bit; None if the second is a part of the first"""
    if "summary" in dict(one):
        return part_of_simulation(dict(one), dict(other))
    if [name for name, _ in one] != [name for name, _ in other]:
        return False
    pairs = zip(one, other, strict=True)
    equal = [np.array_equal(a, b, equal_nan=np.asarray(a).dtype.kind in "fc") for (_, a), (_, b) in pairs]
    if all(equal):
        return True
    shorter = len(dict(other)["omega"]) < len(dict(one)["omega"]) if "omega" in dict(one) else False
    return None if shorter else False


def part_of_simulation(one, other):
    """As `same`, for simulations, whose seeds and statistics may be missing"""
    if not set(other) <= set(one):
        return False
    lost = set(one) - set(other)
    if isinstance(other["summary"], str):
        lost.add("summary")
    compared = set(other) - lost - ({"omega"} if lost - {"summary"} else set())
    equal = all(np.array_equal(one[n], other[n], equal_nan=np.asarray(one[n]).dtype.kind == "f") for n in compared)
    return (None if lost else True) if equal else False


def answer(path, right):
    """What comes of reading a damaged file: a word of the counts, and what was said"""
    try:
        found = same(right, everything(path))
    except (ValueError, OSError) as fault:
        lines = str(fault).strip().splitlines()
        return ("refused" if len(lines) == 1 else "crashed"), str(fault)
    except Exception as fault:
        return "crashed", f"{type(fault).__name__}: {fault}"
    return {True: "harmless", None: "fewer rows", False: "believed"}[found], ""


def damaged(content, random):
    """The bytes with 1 to 64 of them replaced, and where"""
    length = int(random.integers(1, 65))
    start = int(random.integers(0, len(content) - length))
    changed = bytearray(content)
    changed[start : start + length] = random.bytes(length)
    return bytes(changed), (start, length)


def _work(files, link):
    right = {name: everything(name) for name in files}
    while True:
        name, path = link.recv()
        link.send(answer(path, right[name]))


def _worker(files):
    here, there = multiprocessing.get_context("spawn").Pipe()
    process = multiprocessing.get_context("spawn").Process(target=_work, args=(files, there), daemon=True)
    process.start()
    there.close()
    return process, here


def campaign(files, flips, seed, tell=None):
    """Counter of answers to `flips` damages, shared evenly among `files`; tell : called with what is not well"""
    random, counts = np.random.default_rng(seed), collections.Counter()
    contents = {str(name): Path(name).read_bytes() for name in files}
    process, link = _worker([*contents])
    with tempfile.TemporaryDirectory() as folder:
        for i in range(flips):
            name = [*contents][i % len(contents)]
            path = Path(folder) / f"damaged{Path(name).suffix}"
            content, where = damaged(contents[name], random)
            path.write_bytes(content)
            try:
                link.send((name, str(path)))
                if not link.poll(SECONDS + 60 * (i == 0)):
                    raise EOFError
                word, said = link.recv()
            except (EOFError, OSError):
                process.kill()
                process.join()
                word, said = "crashed", f"signal or more than {SECONDS:g} s ({process.exitcode})"
                process, link = _worker([*contents])
            counts[word] += 1
            if tell and word in ("believed", "crashed", "fewer rows"):
                tell(f"{word}: {Path(name).name} bytes {where[0]} to {where[0] + where[1]}: {said}")
    process.kill()
    process.join()
    return counts


def make_files(folder, simulated=False):
    """Databases and the results of studies, to be damaged; simulated : with a simulation, which takes longer"""
    from hakobune.pipelines.cli import main

    scenes = Path(pipelines.__file__).parent / "scenes"
    commands = {
        "box.h5": "box --length 100 --beam 40 --draft 12 --depth 30 --panels 24 --gyration 13,25,26 "
        "--omega 0.3,0.6,0.9 --heading 0,60",
        "wide.h5": "box --length 100 --beam 50 --draft 10 --depth 20 --method contour --gyration 15.6,29.4,32.3 "
        "--omega 0.3:1.0:4 --heading 0:180:5",
        "response.h5": f"response {scenes}/response_box_20m.toml --database {folder}/wide.h5",
        "moor.h5": f"moor {scenes}/moor_chain_12.toml --database {folder}/wide.h5",
        "run.h5": f"line-dynamics {scenes}/line_chain_60m.toml --duration 20",
        "sections.h5": "sections --beam-draft 5 --depth-draft 2 --xi 0.5,1 --tolerance 1e-3",
        "sections.csv": "sections --beam-draft 5 --depth-draft 2 --xi 0.5,1 --tolerance 1e-3",
    }
    if simulated:
        study = (scenes / "moor_chain_12.toml").read_text(encoding="utf-8") + TIME
        (folder / "time.toml").write_text(study, encoding="utf-8")
        commands |= {
            "many.h5": "box --length 100 --beam 50 --draft 10 --depth 20 --method contour --gyration 15.6,29.4,32.3 "
            "--omega 0.2:1.6:12 --heading 0,45,90 --only radiation,diffraction,motions,drift",
            "simulation.h5": f"simulate {folder}/time.toml --database {folder}/many.h5",
        }
    with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
        for name, words in commands.items():
            main([*words.split(), "--output", str(folder / name)])
    return [folder / name for name in commands]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--flips", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        counts = campaign(make_files(Path(folder), True), arguments.flips, arguments.seed, print)
    print(", ".join(f"{word} {count}" for word, count in counts.most_common()))
    return 1 if counts["believed"] + counts["crashed"] else 0


if __name__ == "__main__":
    sys.exit(main())
