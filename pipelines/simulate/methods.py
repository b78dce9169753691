"""A moored ship in one record of waves by the four methods of Shiraishi et al., side by side.

1  memory, domain division in three dimensions: here the contour method, which divides the water at the plan and under
   the keel, for a box of the ship's main dimensions, from a database of its own; mass and restoring are the ship's
2  memory, singularities on the hull: the panel method, or the method of the database 3  constant added mass and damping
at the significant period of the waves 4  the same at the natural period of the berth, in surge, or in sway or yaw
without restoring in surge

The paper computes methods 3 and 4 from strips by multipole expansion. Here their coefficients come from the
database, so that the methods differ only in the memory.
"""

import warnings
from dataclasses import replace

import numpy as np

from hakobune.mooring.motion.statistics import PLANE, windows
from hakobune.mooring.studies.natural_periods import periods_at_berth

from ..common.quantities import StudyError
from ..results.given import database_of
from ..results.quantity import Quantity
from ..results.result import labels
from . import work
from .run import input_of

STILL = 1e-6, 1e-6, np.radians(1e-6)  # m, m, rad: no motion
SIGNIFICANT = 0.9  # mean over significant period, of the spectra of the report


def compared(result, study, database, duration=None, division=None):
    """A Result with the methods side by side, on the waves of the first seed.

    study, database : as in `result.simulate`; duration : s of the run, None for the study's
    division : path of a database by the contour method, or None
    raises : StudyError for a study without waves or a database of another body or method
    """
    asked, db = input_of(study), database_of(database)
    task = work.Task(asked.study, str(db.path), duration, None, asked.folder)
    if db.bodies:
        raise StudyError("--methods is given, and the database contains several bodies; --methods is for one body only")
    body, plan, _ = work.prepared(task, db)
    if plan.mean_period is None:
        raise StudyError("--methods compares motions in waves, and the study has no waves; give [waves] or a record")
    periods, states = periods_at_berth(body), {"memory": "states", "constant_period": None}
    known = periods[np.isfinite(periods)]
    wave = plan.mean_period / SIGNIFICANT
    cases = [("2 memory", body, states), (f"3 constant, {wave:.3g} s", body, _constant(wave))]
    if len(known):
        cases.append((f"4 constant, {known[0]:.3g} s", body, _constant(known[0])))
    if division is not None:
        cases.insert(0, ("1 memory, divided box", _divided(asked.study, body, division), states))
    seed, rows, refused = plan.seeds[0], [], []
    for name, one, changed in cases:
        try:
            rows.append(_row(one, plan, changed, seed))
        except ValueError as error:
            rows.append(np.full((2, len(PLANE)), np.nan))
            refused.append(f"{name}: {' '.join(str(error).split())}")
    axes, table = (
        labels("method", [name for name, _, _ in cases]),
        f"seed {seed} by four methods, significant amplitudes",
    )
    found = {}
    for k, (name, unit) in enumerate(zip(PLANE, ("m", "m", "rad"), strict=True)):
        size, period = np.array(rows)[:, :, k].T
        found[f"method.{name}"] = Quantity(size, ("method",), unit, name, table)
        found[f"method.{name}_period"] = Quantity(period, ("method",), "s", f"period of {name}", table)
    return replace(
        result, quantities=result.quantities | found, labels=result.labels | axes,
        findings=(*result.findings, *refused),
    )  # fmt: skip


def _constant(period):
    return {"memory": "constant", "constant_period": float(period)}


def _row(body, plan, changed, seed):
    """Significant amplitudes, m, m, rad, and periods, s; shape (2, 3); nan of too few waves"""
    from hakobune.mooring.motion.simulation import simulate, with_memory

    settings = replace(plan.settings, **changed)
    if settings.memory != "constant" and not body.memory.states:  # database solved in front of a quay
        body = with_memory(body)
    with warnings.catch_warnings():  # energy outside the stored frequencies, which the plan reports
        warnings.simplefilter("ignore")
        run = simulate(body, plan.weather, settings, seed)
    late = run.motion[run.time >= -1e-9]
    found = windows(late, settings.step, settings.step * (len(late) - 1))
    return np.array([np.where(found.amplitude[0] <= STILL, 0.0, found.amplitude[0]), found.period[0]])


def _divided(study, body, path):
    """`Moored` with the water of a database by the contour method.  Raises StudyError."""
    from hakobune.bem.database import open_database
    from hakobune.mooring.motion.simulation import moored

    db = open_database(path)
    method = db.attributes["method"]
    if method != "contour":
        raise StudyError(f"--division is {path}, solved by the {method} method; allowed: contour")
    study.hull_of(db.sizes)  # checks that length, beam and draft agree
    water, here = db.reader, body.reader
    if not np.allclose(water.rotation_center, here.rotation_center, atol=1e-6) or water.depth != here.depth:
        raise StudyError(
            f"--division is {path}, whose depth or rotation centre differs; allowed: the depth and rotation centre "
            "of the database"
        )
    water = replace(water, inertia=here.inertia, stiffness=here.stiffness, viscous=None, own=False)
    return moored(
        water, body.system, body.hull, spring=body.spring, damping=body.damping, quadratic=body.quadratic,
        berth=body.berth,
    )  # fmt: skip
