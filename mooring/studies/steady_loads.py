"""Steady forces of wind, current and wave drift on a hull, at its heading at rest."""

from dataclasses import replace

import numpy as np

from ..loads.on_hull import current_on, own_table, wind_on


def steady_loads(db, hull, conditions, depth, drift=None, heading=0.0):
    """{"wind", "current", "drift"} of the given conditions, each (6,) N and N m about the rotation centre.

    Wind and current act at the heading of the body at rest, with the moments due to their heights
    drift : surge, sway and yaw by waves, (3,), or None; heading : heading of the hull's axes, in which all forces
        are given, rad
    """
    loads, center, wind, current = {}, db.rotation_center, conditions.wind, conditions.current
    if wind:
        loads["wind"] = wind.speed**2 * wind_on(wind, hull).about(wind.direction - heading, center)
    if current:
        unit = current_on(current, hull, db.density, depth).about(current.direction - heading, center)
        loads["current"] = current.speed**2 * unit
    if drift is not None:
        loads["drift"] = np.array([*drift[:2], 0.0, 0.0, 0.0, drift[2]])
    return loads


def with_coefficients(conditions, hull, depth):
    """Conditions in which a current without coefficients gets those of the hull: a cylinder's, or the box tests' as
    far as they extend
    """
    current = conditions.current
    if current is None or callable(current.table) or current.table is not None:
        return conditions
    return replace(conditions, current=replace(current, table=own_table(current, hull, depth)))
