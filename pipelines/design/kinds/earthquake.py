"""An earthquake as a load case of a berth: `hakobune earthquake`, with the body of the project's database.

Every method for which its study has values (seismic coefficient, response spectrum, record in time) gives the reaction
and the deflection of the fenders of one side. Criteria are judged by all these methods.
The case gives neither rope tensions nor motions, so it does not judge criteria on these.
"""

from pathlib import Path

import numpy as np

from ...common.fender_tables import fender_of
from ...earthquake.study import BodyTable, quake_of, read_study
from .berth import dolphin_of
from .needs import COEFFICIENT, DOLPHIN, OF_ALLOWABLE, TOTAL
from .numbers import Numbers
from .stored import kept, key_of, plain, read_numbers


def run(path, database, place):
    """`Numbers` of the earthquake study `path`, kept in the file `place`.  Raises ValueError where fenders yield."""
    study, text = read_study(path)
    record = None if study.record is None else path.parent / study.record.file
    base = None if database is None else Path(database)
    made = lambda: plain(_found(study, path.parent, None if study.body else database))  # noqa: E731
    return read_numbers(kept(place, lambda: key_of(text, base, record), made))


def check_study(path):
    """Raises StudyError for an invalid earthquake study, without a check of its database."""
    import msgspec

    study, _ = read_study(path)
    quake_of(study if study.body else msgspec.structs.replace(study, body=BodyTable(mass=1.0)), path.parent)


def _found(study, folder, database):
    from hakobune.mooring.dolphins.methods import failures, methods

    quake, table = quake_of(study, folder, database), study.fender
    fender, yields = fender_of(_alone(table)), dolphin_of(table, {})
    parts = {TOTAL: {}, OF_ALLOWABLE: {}, DOLPHIN: {}, COEFFICIENT: {}}
    rows = methods(quake)[0]
    for row in rows:
        if row.reason:
            raise ValueError(f"{row.name}: {row.reason}")
        pressed = quake.fenders.fender.own(row.deflection)
        parts[TOTAL][row.name] = float(pressed / fender.height)
        parts[OF_ALLOWABLE][row.name] = float(pressed / (fender.height * fender.allowable))
        if yields and np.isfinite(yields[1]) and row.reaction > 0:
            parts[DOLPHIN][row.name] = float(yields[1] * quake.fenders.count / row.reaction)
    if quake.coefficient is not None:
        parts[COEFFICIENT]["of the rule"] = float(quake.coefficient)
    none, place = np.zeros(0), np.zeros((0, 3))
    return Numbers(
        names=(), types=(), fairlead=place, anchor=place, length=none, pretension=none, static=none, largest=none,
        breaking=none, horizontal=none, uplift=none, place=np.zeros(3), motions=none,
        parts={quantity: values for quantity, values in parts.items() if values},
        warnings=tuple(failures(quake, rows)),
    )  # fmt: skip


def _alone(table):
    import msgspec

    return msgspec.structs.replace(table, count=1)
