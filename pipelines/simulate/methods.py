"""A moored ship in one record of waves by the four methods of Shiraishi et al. beside each other.

1  memory, domain division in three dimensions: here the contour method, which divides the water at the plan and under
   the keel, for a box of the ship's main dimensions, from a database of its own; mass and restoring are the ship's
2  memory, singularities on the hull: the panel method, or whatever the database was solved by
3  constant added mass and damping at the significant period of the waves
4  the same at the natural period of the berth, of surge or where nothing restores it of sway or yaw

The paper takes 3 and 4 from strips by multipole expansion; here they are of the database, so that the methods differ in
the memory alone.
"""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np

from ..common.quantities import StudyError
from . import work
from .berth import PLANE, natural_periods, windows

STILL = 1e-6  # m, degrees: no motion
SIGNIFICANT = 0.9  # mean over significant period, of the spectra of the report


def methods_table(task, seed, division=None):
    """A table of the methods on the waves of a seed; division : path of a database by the contour method, or None

    raises : StudyError for a study without waves or a database of another body or method
    """
    from rich.table import Table

    body, plan, study, _ = work.prepared(task)
    if plan.mean_period is None:
        raise StudyError("--methods compares motions in waves, and there are none; allowed: with [waves] or a record")
    periods, states = natural_periods(body), {"memory": "states", "constant_period": None}
    known = periods[np.isfinite(periods)]
    wave = plan.mean_period / SIGNIFICANT
    cases = [("2 memory", body, states), (f"3 constant, {wave:.3g} s", body, _constant(wave))]
    if len(known):
        cases.append((f"4 constant, {known[0]:.3g} s", body, _constant(known[0])))
    if division is not None:
        cases.insert(0, ("1 memory, divided box", _divided(study, body, division), states))
    table = Table(title=f"seed {seed}: significant amplitudes and periods by four methods", title_justify="left")
    for name in ("method", "surge m", "T s", "sway m", "T s", "yaw °", "T s"):
        table.add_column(name, justify="left" if name == "method" else "right", no_wrap=True)
    for name, one, changed in cases:
        try:
            cells = _row(one, plan, changed, seed)
        except ValueError as error:
            cells, table.caption = ["–"] * (2 * len(PLANE)), f"{name}: {' '.join(str(error).split())}"
        table.add_row(name, *cells)
    return table


def _constant(period):
    return {"memory": "constant", "constant_period": float(period)}


def _row(body, plan, changed, seed):
    """Cells of significant amplitudes and periods; nan of too few waves is a dash"""
    from hakobune.mooring.motion.simulation import simulate, with_memory

    settings = replace(plan.settings, **changed)
    if settings.memory != "constant" and not body.memory.states:  # of a study before a quay
        body = with_memory(body)
    with warnings.catch_warnings():  # energy outside the stored frequencies, which the plan tells
        warnings.simplefilter("ignore")
        run = simulate(body, plan.weather, settings, seed)
    late = run.motion[run.time >= -1e-9]
    values = windows(late, settings.step, settings.step * (len(late) - 1))[0][1]
    return ["–" if np.isnan(v) else f"{v:.3g}" if v > STILL else "0" for v in values]


def _divided(study, body, path):
    """`Moored` with the water of a database by the contour method.  Raises StudyError."""
    from hakobune.bem.database import open_database
    from hakobune.mooring.motion.simulation import moored

    db = open_database(path)
    method = db.attributes["method"]
    if method != "contour":
        raise StudyError(f"--division is {path}, solved by the {method} method; allowed: contour")
    study.hull_of(db.dimensions)  # of the same length, beam and draft
    water, here = db.reader, body.reader
    if not np.allclose(water.rotation_center, here.rotation_center, atol=1e-6) or water.depth != here.depth:
        raise StudyError(f"--division is {path}, of another depth or rotation centre; allowed: those of the database")
    water = replace(water, inertia=here.inertia, stiffness=here.stiffness, viscous=None, own=False)
    return moored(
        water, body.system, body.hull, spring=body.spring, damping=body.damping, quadratic=body.quadratic,
        berth=body.berth,
    )  # fmt: skip
