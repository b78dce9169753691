"""Beams that bend, in time: their shapes as motions, and their deflections and loads at stations."""

import numpy as np

from hakobune.mooring.response.points import middles, of_station

from .file import LEFT_OUT

OF_SHAPES = (
    f"{LEFT_OUT}: mean and slow drift forces on the shapes of bodies that bend; those on surge, sway and yaw "
    "are included"
)


def units_of_shapes(db):
    """Unit of each shape of the bodies of a database, () for none"""
    return tuple("rad" if mode.turns else "m" for mode in db.modes)


def stations_of(study, db):
    """[`mooring.response.points.Station`] of a study, by default the middle of every beam of a database"""
    given = study.simulation.stations if study.simulation else []
    if given:
        return [one for i, table in enumerate(given) for one in table.stations(f"simulation.stations[{i}]", db)]
    return middles(db)


def told_of_stations(reader, stations):
    """Return (name, unit) of the deflections and loads of beams at Stations"""
    still = np.zeros(len(reader.words)) if stations else None
    return [(f"{one.name} {word}", unit) for one in stations for word, unit, _ in of_station(reader, still, one)]


def loads_along(reader, stations, motion):
    """Deflections and loads, as `told_of_stations`, along a motion (n, m) of all bodies and shapes; shape (n, k)"""
    found = [part for one in stations for _, _, part in of_station(reader, motion, one)]
    return np.column_stack(found) if found else np.zeros((len(motion), 0))
