"""Steady forces of wind, current and wave drift on a hull, at its heading at rest."""

from __future__ import annotations

from dataclasses import replace

from ..loads.box_current import box_table, current_force
from ..loads.box_drag import about
from ..loads.box_wind import wind_force


def steady_loads(db, hull, conditions, depth):
    """{"wind", "current", "drift"} of the conditions that are given, each (3,) N, N, N m about the rotation centre.

    Wind and current are taken at the heading of the body at rest.
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
    if conditions.waves:
        w = conditions.waves
        loads["drift"] = mean_drift(db.reader, w)
    return loads


def mean_drift(body, waves):
    """(3,) mean drift F_x, F_y in N and M_z in N m of a `bem.database.reader.Reader` in `Waves`.

    SR179 report (1982), section 5.1.1: irregular waves are replaced by a regular wave with the significant
    height as its height and the mean period as its period.  It has twice the energy of the irregular waves.
    """
    return body.drift([waves.omega], [waves.direction])[0, 0] * (0.5 * waves.height) ** 2


def with_coefficients(conditions, hull, depth):
    """The same conditions; a current without coefficients gets those of the box tests."""
    if conditions.current is None or conditions.current.table is not None:
        return conditions
    table = box_table(hull.length, hull.beam, hull.draft, depth)
    return replace(conditions, current=replace(conditions.current, table=table))
