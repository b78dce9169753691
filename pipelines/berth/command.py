"""`hakobune berth`: energies by the kinetic-energy method, the fender that is met first, the course in time."""

from __future__ import annotations

import warnings

import numpy as np

from hakobune.mooring.berthing.memory import berth as in_time
from hakobune.mooring.berthing.memory import ship_of_database, without_memory
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.fenders.fender import FenderError

from ..common.fender_tables import softest_and_stiffest
from ..common.outputs import check_output, opening
from ..common.picture import PLOTS, check_picture
from ..printing.verdict import tell
from .report import MARK, draw, failures, measured_lines, show, show_course, write_course
from .study import approach_of, read_berth

MASS_DIFFERS = 0.02  # share, of the ship's mass from that of the water its database displaces
DEPTH_DIFFERS = 0.02  # of the depth at the berth, less than a tide


def berth(study_path, database, output, plot):
    """Print a study; output : CSV of the course in time; plot : picture of it.  Returns the exit status.

    raises : ValueError, one line
    """
    study = read_berth(study_path)
    if output is not None:
        check_output(output, "the course of a berthing", lambda path: opening(path)[0] == MARK, (".csv",), [study_path])
    if plot is not None:
        check_picture(plot, PLOTS)
    approach = approach_of(study)
    ship, told = _ship(study, approach, database)
    first = approach.meetings[approach.first][0]
    table = study.fender[approach.first]
    bands, _ = softest_and_stiffest(table, _alone(table))
    course, refused = _course(ship, approach)
    written = () if course is None else _write(approach, course, output, plot)
    show(study, approach, first, bands)
    if course is not None:
        show_course(approach, course, database)
    in_vain = () if refused is None else (fails(f"in time: {refused}"),)
    status = tell([*told, *failures(study, approach, course), *in_vain])
    for path in written:
        print(path)
    return status


def show_measured():
    """Print the fifty berthings of Ueda (1981) beside the method; returns 0"""
    print("\n".join(measured_lines()))
    return 0


def _course(ship, approach):
    """The course in time and None, or None and why the fenders do not stand it"""
    try:
        return in_time(ship, approach.meetings, approach.speed), None
    except FenderError as error:
        return None, error


def _write(approach, course, output, plot):
    """[path] of what is asked for; before anything is printed, whose reader may leave"""
    if output is not None:
        write_course(output, course)
    if plot is not None:
        draw(approach, course, plot)
    return [path for path in (output, plot) if path is not None]


def _alone(table):
    from ..common.fender_tables import fender_of

    return fender_of(table)


def _ship(study, approach, database):
    """`BerthingShip` with the memory of a database, or with the virtual mass of the study, and warnings"""
    ship = approach.ship
    if database is None:
        added = (approach.virtual_mass - 1) * ship.mass
        return without_memory(ship.mass, ship.gyration, added * np.diag([1.0, ship.gyration**2])), ()
    from hakobune.bem.database import open_database

    db = open_database(database)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = ship_of_database(db, ship.mass, ship.gyration, center=study.ship.center)
    told = [str(one.message) for one in caught]
    displaced = db.density * float(db["displaced_volume"])
    if abs(displaced / ship.mass - 1) > MASS_DIFFERS:
        told.append(
            f"the body of {database} displaces {displaced / 1e3:.0f} t, the ship has {ship.mass / 1e3:.0f} t, which is "
            "what moves"
        )
    if study.depth is not None and abs(db.water_depth / study.depth - 1) > DEPTH_DIFFERS:
        told.append(f"the memory of {database} is that of {db.water_depth:g} m of water, depth is {study.depth:g} m")
    return made, told
