"""A load case in time: its runs by `hakobune simulate`, and what criteria ask of them.

Some rules take the tension at a multiple of the dynamic displacement: there the body is moved from its mean by the
multiple of where it is at the largest tension of a line, in each run that is kept, and statics give the tension.
"""

from __future__ import annotations

import tomllib

import numpy as np

from .fatigue import cycles_of


def simulated(study, database, path, factors):
    """Numbers of a load case in time, run where the file does not have it.

    study : path of its TOML file, with [simulation]; database, path : of the database, and of the file of the runs
    factors : of the dynamic displacement
    returns : {"mean" (n,) N of the lines, "largest": {factor: (n,) N}, "horizontal": (n,) N at the anchor with it,
        "cycles": of `fatigue.cycles_of`, "motions": (6,) m, rad, largest from their means, "findings"}
    raises : ValueError, one line, where it cannot be run
    """
    from ..simulate.file import opened
    from ..simulate.report import largest_tension, line_values

    outcome = _run(study, database, path)
    if outcome.interrupted:
        raise KeyboardInterrupt
    if outcome.failures:
        raise ValueError(f"seed {outcome.failures[0][0]}: {outcome.failures[0][1]}")
    with opened(path) as file:
        rows = [line_values(file, name) for name in file["line"].asstr()[()]]
        motion, tension = file["motion"][()].astype(float), file["tension"][()].astype(float)
        motions, step = _largest_motions(file), float(np.diff(file["time"][:2])[0])
    largest = {1.0: np.array([largest_tension(row) for row in rows])}
    for factor in factors:
        if factor != 1:
            largest[factor] = _moved(study, database, motion, tension, factor)[0]
    held, pulled = _moved(study, database, motion, tension, 1.0)
    return {
        "mean": np.array([row["mean"] for row in rows]),
        "largest": largest,
        "horizontal": pulled * np.maximum(largest[1.0] / held, 1.0),  # the extreme is beyond what the records have
        "cycles": cycles_of(tension, step),
        "motions": motions,
        "findings": outcome.findings,
    }


def _run(study, database, path):
    from bem.database.integrity import DatabaseError

    from ..simulate.run import simulate
    from ..solve.work import Here

    try:
        return simulate(study, database, path, None, Here())
    except DatabaseError:  # of another study, or damaged: made anew
        return simulate(study, database, path, None, Here(), fresh=True)


def _largest_motions(file):
    """(6,) m, rad: extremes of the motions from their means, whichever side is larger"""
    from bem import DOFS

    from ..simulate.file import SUMMARY

    names, out = list(file["quantity"].asstr()[()]), []
    for name in DOFS:
        row = dict(zip(SUMMARY, file["summary"][names.index(name.lower())], strict=True))
        ends = [row[key] for key in ("upper_value", "lower_value", "largest", "smallest")]
        out.append(np.nanmax(np.abs(np.array(ends) - row["mean"])))
    return np.array(out)


def _moved(study, database, motion, tension, factor):
    """(2, n) N: static tension of each line, and its horizontal pull on the anchor, with the body at `factor` times its
    displacement from the mean at the largest tension of the line, the mean over the runs

    motion : (runs, t, 6); tension : (runs, t, n)
    """
    from bem.database import open_database
    from mooring.lines.system.equilibrium import held_at, rest

    from ..moor.study import make_study

    db, made = open_database(database), make_study(tomllib.loads(study.read_text(encoding="utf-8")))
    system = made.system(made.hull_of(db.dimensions), db.rotation_center, db.density, db.gravity)
    (body,), out = system.bodies, np.zeros((2, tension.shape[-1]))
    for moved, pulled in zip(motion, tension, strict=True):
        mean = moved.mean(axis=0)
        for line in range(out.shape[1]):
            place = mean + factor * (moved[pulled[:, line].argmax()] - mean)
            pose = tuple(float(a + b) for a, b in zip(body.position, place, strict=True))
            lines = rest(held_at(system, {body.name: pose})).lines
            out[:, line] += np.array([lines.tension_b[line], lines.horizontal_a[line]]) / len(motion)
    return out
