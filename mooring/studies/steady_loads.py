"""Steady forces of wind, current and wave drift on a hull, at its heading at rest."""

from __future__ import annotations

from dataclasses import replace

from ..loads.box_current import box_table, current_force
from ..loads.box_drag import about
from ..loads.box_wind import wind_force


def steady_loads(db, hull, conditions, depth, drift=None):
    """{"wind", "current", "drift"} of the conditions that are given, each (3,) N, N, N m about the rotation centre.

    Wind and current are taken at the heading of the body at rest; drift : (3,) of the waves, None without
    """
    loads, middle = {}, (0.0, 0.0)
    if conditions.wind:
        w = conditions.wind
        force = wind_force(w.speed, w.direction, hull.length, hull.beam, hull.freeboard, w.density, w.table)
        loads["wind"] = about(force, middle, db.rotation_center)
    if conditions.current:
        c = conditions.current
        force = current_force(c.speed, c.direction, hull.length, hull.beam, hull.draft, db.density, c.table, depth)
        loads["current"] = about(force, middle, db.rotation_center)
    if drift is not None:
        loads["drift"] = drift
    return loads


def with_coefficients(conditions, hull, depth):
    """The same conditions; a current without coefficients gets those of the box tests."""
    if conditions.current is None or conditions.current.table is not None:
        return conditions
    table = box_table(hull.length, hull.beam, hull.draft, depth)
    return replace(conditions, current=replace(conditions.current, table=table))
