"""One state of the weather, simulated with its seeds, by an executor."""

from copy import deepcopy
from dataclasses import replace

import msgspec
import numpy as np

from hakobune.bem import DOFS

from ..moor.study import make_study
from ..results.given import database_of
from ..simulate.file import STATISTICS
from ..simulate.work import prepared, quantities_of, simulate_seed

MOTIONS = tuple(name.lower() for name in DOFS)
UNITS = {
    **dict.fromkeys(MOTIONS[:3], "m"), **dict.fromkeys(MOTIONS[3:], "deg"), "tension / breaking load": "",
    "breaking load / tension": "", "fender deflection": "m", "fender reaction": "kN",
}  # fmt: skip
_kept = {}  # cache of this process: the open database of a study and its wave forces
OF_MOTION = "largest", "significant", "peak to peak"


def names_of(body):
    """Quantities of a `Moored` body: its motions, tensions with known breaking loads, fenders"""
    found = list(MOTIONS)
    if np.isfinite(_breaking(body)).any():
        found += ["tension / breaking load", "breaking load / tension"]
    return [*found, *(["fender deflection", "fender reaction"] if body.berth.fenders else [])]


def state(task, raw, weather, seeds):
    """For each seed a dictionary {quantity: value, or {statistic: value}}.

    task : `simulate.work.Task` of the study without the weather of the state; raw : its tables
    weather : {"waves": table, "wind": table, "current": table} of the state; raises ValueError
    """
    tables = deepcopy(raw)
    for name, table in weather.items():
        tables[name] = table if name == "waves" else {**tables.get(name, {}), **table}
        if name != "waves":
            tables[name].pop("incidence_deg", None)
    task = replace(task, study=make_study(tables))
    body = _prepared(task, weather)
    return [_values(body, simulate_seed(task, seed, False)["statistics"]) for seed in seeds]


def _prepared(task, weather):
    """The `Moored` body of a Task; its wave forces are those of the previous state, which has the same body

    Exceptions: viscous damping of the database's scene is linearised in each sea, and waves may be on a current.
    """
    key = task.database, task.folder, task.duration, msgspec.json.encode(_without(task.study, weather))
    db, waves = _kept.get(key) or (database_of(task.database), None)
    body = prepared(task, db, waves)[0]
    _kept.clear()
    if not db.has_viscous_motions and "current" not in weather:
        _kept[key] = db, body.waves
    return body


def _without(study, weather):
    """A Study without the weather of a state"""
    return msgspec.structs.replace(study, **dict.fromkeys(weather))


def _values(body, statistics):
    lines = [*(() if body.system is None else body.system.line_names), *(one.name for one in body.berth.ropes)]
    fenders = [one.name for one in body.berth.fenders]
    names, _ = quantities_of(lines, fenders)
    rows = {
        name: dict(zip(STATISTICS, map(float, row), strict=True)) for name, row in zip(names, statistics, strict=True)
    }
    found = {}
    for k, name in enumerate(MOTIONS):
        one, size = rows[name], 1.0 if k < 3 else np.pi / 180
        largest = max(one["largest"] - one["mean"], one["mean"] - one["smallest"])
        three = largest, one["mean_third"], one["largest"] - one["smallest"]
        found[name] = dict(zip(OF_MOTION, (value / size for value in three), strict=True))
    pulled = [rows[f"tension {name}"]["largest"] for name in lines]
    used = np.divide(pulled, _breaking(body)) if lines else np.zeros(0)
    if np.isfinite(used).any():
        found["tension / breaking load"] = float(np.nanmax(used))
        found["breaking load / tension"] = 1 / max(float(np.nanmax(used)), 1e-9)
    if fenders:
        found["fender deflection"] = max(rows[f"deflection {name}"]["largest"] for name in fenders)
        found["fender reaction"] = max(rows[f"reaction {name}"]["largest"] for name in fenders) / 1e3
    return found


def _breaking(body):
    """Breaking loads, N; shape (lines,); nan where unknown"""
    load = [
        *(() if body.system is None else body.system.breaking_load),
        *(one.breaking_load for one in body.berth.ropes),
    ]
    load = np.array(load, float)
    return np.where(np.isfinite(load), load, np.nan)
