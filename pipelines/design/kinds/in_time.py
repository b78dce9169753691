"""A load case in time: its runs by `hakobune simulate`, and the largest values of all runs for the criteria.

Some rules require the tension at a multiple of the dynamic displacement. For these rules, in each kept run, the body
is moved from its mean to the multiple of its displacement at the largest tension of a line. The tension is the
static tension in this position, times the ratio of the largest simulated tension to the static tension at the
displacement itself. A multiple above 1 never gives less than the simulated tension.
"""

import tomllib
from pathlib import Path

import numpy as np

from hakobune.mooring.criteria.fatigue import Cycles, rainflow_cycles
from hakobune.mooring.motion.simulation.realisation import poses_of

from .needs import GAP
from .numbers import held_by_hinges, strength
from .stored import kept, key_of


def simulated(study, database, path, factors):
    """Numbers of a load case in time, simulated if the file of its runs lacks them; stored in NAME_extremes.json beside
    that file.

    study : path of its TOML file, with [simulation]; database : path of the database; path : path of the file of runs
    factors : factors of the dynamic displacement
    returns : {"mean", "breaking" (n,) N of the lines and ropes, "largest": {factor: (n,) N}, "horizontal", "uplift":
        (n,) N at the anchor at the same time, "cycles": of `cycles_of`, "motions": (6N,) m, rad, largest from their
        means, "ranges": (6N,) m, rad, largest less smallest of a run, "excursion": m, largest horizontal distance
        from rest, "at_rest": m, distance of rest from the place in the study, "parts": of gaps and hinges, "findings"}
    raises : ValueError, with a message of one line, for a case that cannot be run
    """
    texts = study.read_text(encoding="utf-8"), repr(factors), "excursion, at rest, parts, anchors"
    place = path.with_name(f"{path.stem}_extremes.json")
    found = kept(
        place, lambda: key_of(*texts, Path(database), path), lambda: _plain(_simulated(study, database, path, factors))
    )
    return {key: READ.get(key, np.array)(value) for key, value in found.items()}


def _plain(runs):
    """JSON values of the result of `simulated`"""
    plain = {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in runs.items()}
    plain["largest"] = [[factor, values.tolist()] for factor, values in runs["largest"].items()]
    plain["cycles"] = [[time, [part.tolist() for part in cycles]] for time, cycles in runs["cycles"]]
    return plain | {"findings": list(runs["findings"])}


READ = {  # JSON values that are no arrays
    "largest": lambda pairs: {factor: np.array(values) for factor, values in pairs},
    "cycles": lambda pairs: [(time, Cycles(*map(np.array, parts))) for time, parts in pairs],
    "excursion": float,
    "at_rest": float,
    "parts": dict,
    "findings": tuple,
}


def _simulated(study, database, path, factors):
    from ...simulate.file import opened, stored_findings, summary_of, told
    from ...simulate.over_runs import (
        anchors_in_runs,
        excursion_in_runs,
        on_anchors,
        overloads,
        rare_findings,
        used_in_runs,
    )

    outcome = _run(study, database, path)
    if outcome.interrupted:
        raise KeyboardInterrupt
    if outcome.failures:
        raise ValueError(f"seed {outcome.failures[0][0]}: {outcome.failures[0][1]}")
    with opened(path) as file:
        rows = [summary_of(file, f"tension {name}") for name in file["line"].asstr()[()]]
        motion, tension = file["motion"][()].astype(float), file["tension"][()].astype(float)
        excursion, at_rest, parts = excursion_in_runs(file), _away_at_rest(file), _between(file)
        pulls = anchors_in_runs(file)[1:]
        motions, ranges, step = _largest_motions(file), _largest_ranges(file), float(np.diff(file["time"][:2])[0])
        found = (*told(file), *stored_findings(file), *overloads(file, 1.0), *on_anchors(file),
                 *rare_findings(file))  # fmt: skip
        load, used = np.asarray(file.attrs["breaking_load"], float), used_in_runs(file).max(axis=0)
    largest = {1.0: np.array([row["largest"] for row in rows])}
    held, along, up = _moved(study, database, motion, tension, 1.0)
    more = np.maximum(largest[1.0] / np.maximum(held, 1e-300), 1.0)  # factor for simulated runs and dynamic lines
    along, up = (np.where(np.isnan(own), more * rope, own)
                 for own, rope in zip(pulls or np.full((2, len(rows)), np.nan), (along, up), strict=True))  # fmt: skip
    for factor in factors:
        if factor != 1:
            further = more * _moved(study, database, motion, tension, factor)[0]
            largest[factor] = np.maximum(largest[1.0], further) if factor > 1 else further
    return {
        "mean": np.array([row["mean"] for row in rows]),
        "largest": largest,
        "breaking": strength(load, largest[1.0], used),
        "horizontal": along,
        "uplift": up,
        "cycles": cycles_of(tension, step),
        "motions": motions,
        "ranges": ranges,
        "excursion": excursion,
        "at_rest": at_rest,
        "parts": parts,
        "findings": tuple(dict.fromkeys(found)),
    }


def _away_at_rest(file):
    """Largest horizontal distance of a body at rest from its place in the study, m"""
    from ...simulate.file import bodies_of

    rest = file.attrs["place_at_rest"][: 6 * max(1, len(bodies_of(file)))]
    return float(np.hypot(rest[0::6], rest[1::6]).max())


def cycles_of(tension, step):
    """[(duration s, Cycles)] of each line over all runs, from records (runs, t, n) N at steps of `step` s"""
    runs, count, lines = tension.shape
    found = []
    for line in range(lines):
        each = [rainflow_cycles(record[:, line]) for record in tension]
        found.append((runs * (count - 1) * step, Cycles(*(np.concatenate(part) for part in zip(*each, strict=True)))))
    return found


def _run(study, database, path):
    from hakobune.bem.database.integrity import DatabaseError

    from ...executors.choice import Here
    from ...results.given import database_of
    from ...simulate.run import input_of, simulate

    asked, db = input_of(study), database_of(database)
    try:
        return simulate(asked, db, path, None, Here())
    except DatabaseError:  # file of another study, or a damaged one: simulate again
        return simulate(asked, db, path, None, Here(), fresh=True)


def _largest_motions(file):
    """Largest motions of all runs from their means, of the larger side, m, rad; shape (6N,)"""
    from ...simulate.file import summary_of, words_of

    rows = [summary_of(file, name) for name in words_of(file)]
    return np.array([max(row["largest"] - row["mean"], row["mean"] - row["smallest"]) for row in rows])


def _largest_ranges(file):
    """Largest less smallest motion of a run, the most of all runs, m, rad; shape (6N,)"""
    from ...simulate.file import STATISTICS, whole_rows

    rows = file["statistics"][()][whole_rows(file), : len(file["dof"])]
    ends = [rows[..., STATISTICS.index(name)] for name in ("largest", "smallest")]
    return (ends[0] - ends[1]).max(axis=0)


def _between(file):
    """{quantity: {part: value}} between several bodies: the smallest gap of two hulls, m, and what hinges hold, kN and
    kN m; empty for one body"""
    from ...simulate.file import summary_of

    names = file["quantity"].asstr()[()]
    gaps = {name.removeprefix("gap "): summary_of(file, name)["smallest"] for name in names if name.startswith("gap ")}
    hinges = list(file["hinge"].asstr()[()]) if "hinge" in file else []
    rows = [summary_of(file, name) for name in hinges]
    held = held_by_hinges(hinges, [max(abs(row["largest"]), abs(row["smallest"])) for row in rows])
    return held | ({GAP: gaps} if gaps else {})


def _moved(study, database, motion, tension, factor):
    """Static tension of each line and rope, its horizontal pull on the anchor or bollard and its upward pull there, N;
    shape (3, n), with the body at `factor` times its displacement from the mean at the largest tension of the line, the
    largest over the runs

    motion : (runs, t, 6N); tension : (runs, t, n)
    """
    from hakobune.bem.database import open_database

    db, made = open_database(database), make_study_of(study)
    hull = made.hulls_of(db)
    system, berth = made.system_of(db, hull), made.berth_of(db, hull)
    out = np.zeros((3, tension.shape[-1]))
    count = 0 if system is None else len(system.lines)
    for moved, pulled in zip(motion, tension, strict=True):
        mean = moved.mean(axis=0)
        for line in range(out.shape[1]):
            place = mean + factor * (moved[pulled[:, line].argmax()] - mean)
            held = _held_line(system, line, place) if line < count else _held_rope(berth, line - count, place)
            out[:, line] = np.maximum(out[:, line], held)
    return out


def make_study_of(path):
    """The Study of a case's file"""
    from ...moor.study import make_study

    return make_study(tomllib.loads(path.read_text(encoding="utf-8")))


def _held_line(system, line, place):
    """N: tension, pull along and up at the anchor of a line, with the bodies in motion `place` (6N,)"""
    lines = at_place(system, poses_of(place, np.array([one.position for one in system.bodies]))).lines
    return lines.tension_b[line], lines.horizontal_a[line], -lines.vertical_a[line]


def _held_rope(berth, rope, place):
    """Like `_held_line`, for a rope, which is straight"""
    from hakobune.mooring.motion.contacts import contact_forces

    at_rest = np.zeros((len(berth.heading), 6))
    at_rest[:, :3], at_rest[:, 5] = berth.arrays.place, berth.heading
    poses, number = poses_of(place, at_rest), len(berth.fenders) + rope
    tension, one = contact_forces(berth, (poses - at_rest).ravel())[number], berth.ropes[rope]
    fairlead, bollard = (
        _carried(point, at_rest[body], poses[body]) if body >= 0 else point
        for point, body in ((one.fairlead, berth.arrays.body[number]), (one.bollard, berth.arrays.other[number]))
    )
    way = fairlead - bollard
    along, up = np.hypot(*way[:2]) / np.linalg.norm(way), way[2] / np.linalg.norm(way)
    return tension, tension * along, tension * up


def at_place(system, poses):
    """SystemEquilibrium of lines with the bodies held at poses (N, 6) in space"""
    from hakobune.mooring.lines.system.equilibrium import held_at, rest

    places = {one.name: tuple(map(float, pose)) for one, pose in zip(system.bodies, poses, strict=True)}
    return rest(held_at(system, places))


def _carried(point, at_rest, pose):
    """(3,) m, a point of space on a body at rest, with the body moved to a pose (6,)"""
    from hakobune.mooring.lines.system.bodies import rotation

    return pose[:3] + rotation(*pose[3:]) @ rotation(*at_rest[3:]).T @ (point - at_rest[:3])
