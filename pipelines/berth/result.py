"""`hakobune.berth`: energies by the kinetic-energy method, the fender that the ship meets first, the course in time."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import asdict

from hakobune.bem.bodies.one_of_several import body_named
from hakobune.mooring.berthing.energy import shallow
from hakobune.mooring.berthing.memory import berth as in_time
from hakobune.mooring.berthing.memory import ship_of_database, without_memory
from hakobune.mooring.berthing.two_springs import TwoSprings
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.fenders.fender import FenderError
from hakobune.mooring.fenders.taken import at_deflections, deflection_of

from ..common.fender_tables import BATCH, beyond_batch, causes_of, fender_of, on_dolphin, softest_and_stiffest
from ..common.quantities import StudyError
from ..common.typed import typed
from ..results.given import File, Tables, database_of, given
from ..results.heard import heard
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels
from .study import BerthFender, BerthStudy, approach_of, read_berth

if TYPE_CHECKING:
    from hakobune.bem.database import Database

MASS_DIFFERS = 0.02  # relative difference of the ship's mass from the displaced mass in its database
DEPTH_DIFFERS = 0.02  # relative difference of water depths that is reported; less than a tide
BUCKLING = ("cell", "v", "h", "cone")  # families with a plateau
LINEAR_TO = 0.15  # strain up to which Ueda (1981) treats a fender as a spring
MORE = 0.05  # energy in time above that of every formula that is told
BANDS = ("catalogue", "softest of a batch", "stiffest of a batch", "softest", "stiffest")
BEHIND = ("x", "gap", "dolphin", "dolphin_yield", "dolphin_beyond")  # keys that the fender of a simulation lacks
DEFAULT = dict(zip(BerthFender.__struct_fields__[::-1], BerthFender.__struct_defaults__[::-1], strict=False))
TAKEN = "the same energy, with a fender that differs from its catalogue"


def berth(study: File | Tables | BerthStudy, database: File | Database | None = None) -> Result:
    """Energy of a berthing ship, compression of the fender that the ship meets first, and the course of the berthing in
    time.

    study : path of a berthing, its tables as a dictionary, or a `study.BerthStudy`
    database : path of the ship's database, or an open one, for the fluid memory (radiation)
    returns : Result, in SI; its `detail` is the `study.Approach` and the `mooring.berthing.memory.Berthing`, None where
        the fenders cannot absorb the energy
    raises : ValueError, with a message of one line
    """
    study, text = given(study, BerthStudy, read_berth, lambda raw: typed(raw, BerthStudy, StudyError))
    approach = approach_of(study)
    db = None if database is None else database_of(database)
    ship, told = _ship(study, approach, db)
    try:
        course, refused = in_time(ship, approach.meetings, approach.speed), ()
    except FenderError as error:
        course, refused = None, (fails(f"the berthing in time is not computed: {error}"),)
    table = study.fender[approach.first]
    axes = labels("virtual_mass", list(approach.energies)) | labels("band", BANDS)
    found = {**_of_approach(approach), **_by_method(approach), **_by_band(approach, table)}
    found |= _two_springs(table, approach)
    if course is not None:
        found |= _in_time(approach, course)
        axes |= labels("fender", [f"{k + 1} at x = {x:.4g} m" for k, (_, x, _) in enumerate(approach.meetings)])
        axes |= labels("time", course.time, "s")
    water = "in time with constant virtual mass" if db is None else f"in time with the memory of {db.path}"
    return Result(
        "berth", found, axes, (
            *told, *shallow(approach.ship, study.depth), *_failures(study, approach, course),
            *_softest_of_all(approach, table), *_above_formulas(approach, course, db), *refused,
        ),
        (
            f"softest and stiffest by {', '.join(causes_of(table))}", *((water,) if course is not None else ()),
            _to_paste(study, approach),
        ),
        provenance=provenance(text, db), detail=(approach, course),
    )  # fmt: skip


def _ship(study, approach, db):
    """`BerthingShip` with the memory of a database, or with the virtual mass of the study, and warnings"""
    ship = approach.ship
    if db is None:
        added = (approach.virtual_mass - 1) * ship.mass
        return without_memory(ship.mass, ship.gyration, added * np.diag([1.0, ship.gyration**2])), ()
    one, more = _vessel(study.ship.body, db)
    with heard() as told:
        made = ship_of_database(db, ship.mass, ship.gyration, center=study.ship.center, **more)
    displaced = db.density * float(one.displaced_volume)
    others = [body.name for body in db.bodies if not body.fixed and body.name != one.name]
    if others:
        told.append(f"the memory is that of {one.name} with {', '.join(others)} held fixed beside it")
    if abs(displaced / ship.mass - 1) > MASS_DIFFERS:
        told.append(
            f"the body of {db.path} displaces {displaced / 1e3:.4g} t, but the ship has {ship.mass / 1e3:.4g} t; the "
            "ship's mass is used"
        )
    if study.depth is not None and abs(db.water_depth / study.depth - 1) > DEPTH_DIFFERS:
        told.append(
            f"the memory of {db.path} is valid for a water depth of {db.water_depth:g} m, but depth is "
            f"{study.depth:g} m"
        )
    return made, told


def _vessel(name, db):
    """The ship in a database, as a database of one body, and the keyword of its motions among those of several

    raises : StudyError for several bodies without a name, and a name that no body that moves has
    """
    if not db.bodies:
        if name:
            raise StudyError(f"ship.body is {name!r}, but {db.path} contains one body; leave ship.body out")
        return db, {}
    moving = [body.name for body in db.bodies if not body.fixed]
    name = moving[0] if not name and len(moving) == 1 else name
    if name not in moving:
        raise StudyError(f"ship.body is {name!r}; allowed: a body of {db.path} that moves: {', '.join(moving)}")
    return body_named(db, name), {"first": 6 * moving.index(name)}


def _to_paste(study, approach):
    """A line with the fenders, and the dolphins behind them, in the form of a simulation study of the ship alongside"""
    fenders, dolphins = [], []
    for k, (table, (_, x, _)) in enumerate(zip(study.fender, approach.meetings, strict=True), 1):
        own = {
            name: value for name, value in asdict(table).items() if name not in BEHIND and value != DEFAULT.get(name)
        }
        own = {"name": f"fender {k}", "position": [x, study.ship.beam / 2 + table.gap, 0], **own}
        if table.dolphin is not None:
            own["on"] = f"dolphin {k}"
            values = (own["on"], table.dolphin, table.dolphin_yield, table.dolphin_beyond)
            known = zip(("name", "stiffness", "yield_force", "stiffness_beyond"), values, strict=True)
            dolphins.append({name: value for name, value in known if value is not None})
        fenders.append(own)
    lists = {"fender": fenders, "dolphin": dolphins} if dolphins else {"fender": fenders}
    words = "; ".join(f"{name} = [{', '.join(map(_inline, rows))}]" for name, rows in lists.items())
    return f"for the top of a simulation study, with z of the fender face in place of 0: {words}"


def _inline(table):
    """A dictionary as an inline table of TOML"""
    return "{ " + ", ".join(f"{name} = {json.dumps(value)}" for name, value in table.items()) + " }"


def _first(approach):
    """The fender that the ship meets first, with its dolphin"""
    return approach.meetings[approach.first][0]


def _of_approach(approach):
    ship, fender = approach.ship, _first(approach)
    return quantities(f"ship, and {fender.name}", {
        "ship.mass": (ship.mass, "kg", "mass of the ship"),
        "ship.block": (ship.block, "", "block coefficient"),
        "approach.speed": (approach.speed, "m/s", "speed across the berth"),
        "approach.offset": (approach.offset, "m", "distance of the contact from the centre of gravity"),
        "approach.eccentricity": (approach.eccentricity, "", "eccentricity C_e"),
        "approach.virtual_mass": (approach.virtual_mass, "", "virtual mass C_M"),
        "approach.energy": (approach.energy, "J", "energy of the berthing"),
        "fender.rated_energy": (fender.rated_energy, "J", "rated energy of the fender"),
        "fender.rated_reaction": (fender.rated_reaction, "N", "rated reaction of the fender"),
    })  # fmt: skip


def _taken(fenders, energies):
    """Rows of fender deflections and reactions for each energy"""
    places = np.array([deflection_of(one, energy) for one, energy in zip(fenders, energies, strict=True)])
    strain, reaction = at_deflections(fenders, places)
    own = strain * fenders[0].height
    behind = {"dolphin": (places - own, "m", "dolphin")} if on_dolphin(fenders[0]) else {}
    return {"strain": (strain, "%", "strain"), **behind, "reaction": (reaction, "N", "reaction")}


def _by_method(approach):
    masses, energies = map(list, zip(*approach.energies.values(), strict=True))
    rows = {"C_M": (masses, "", "C_M"), "energy": (energies, "J", "energy")}
    rows |= _taken([_first(approach)] * len(energies), energies)
    named = {f"method.{name}": row for name, row in rows.items()}
    return quantities("energy, and the response of the fender", named, "virtual_mass")


def _by_band(approach, table):
    """Deflections of the fenders of a batch for the energy, and fenders that differ by all causes"""
    alone, energy = fender_of(table), approach.energy
    fenders, factors = [_first(approach)], [1.0]
    for causes in (BATCH, None):
        both, pair = softest_and_stiffest(table, alone, causes)
        fenders += both
        factors += pair
    rows = {"factor": (factors, "", "factor")}
    rows["used"] = [energy / one.rated_energy for one in fenders], "%", "share of its rated energy"
    rows |= _taken(fenders, [energy] * len(fenders))
    return quantities(TAKEN, {f"taken.{name}": row for name, row in rows.items()}, "band")


def _two_springs(table, approach):
    """Ueda's closed form; for a buckling fender a spring up to LINEAR_TO, then its rated reaction"""
    if table.family not in BUCKLING:
        return {}
    mass, plateau = approach.eccentricity * approach.virtual_mass * approach.ship.mass, _first(approach).rated_reaction
    dolphin = math.inf if table.dolphin is None else 1e3 * table.dolphin
    made = TwoSprings(mass, approach.speed, dolphin, plateau / (LINEAR_TO * table.height), plateau)
    y1, y2 = (float(y) for y in made.deflections(made.rest_time))
    return quantities("Ueda's two springs in series", {
        "two_springs.energy": (made.energy, "J", "energy"),
        "two_springs.reaction": (made.reaction, "N", "reaction"),
        "two_springs.fender": (y2, "m", "deflection of the fender"),
        **({} if table.dolphin is None else {"two_springs.dolphin": (y1, "m", "deflection of the dolphin")}),
        "two_springs.rest_time": (made.rest_time, "s", "time until the ship stops"),
    })  # fmt: skip


def _in_time(approach, course):
    whole, most = course.reaction.sum(axis=1), course.deflection.max(axis=0)
    fenders = [fender for fender, _, _ in approach.meetings]
    strain, _ = at_deflections(fenders, most)
    found = quantities("in time", {
        "course.energy": (course.energy, "J", "energy absorbed by the fenders"),
        "course.virtual_mass": (course.virtual_mass, "", "virtual mass C_M"),
        "course.largest": (whole.max(), "N", "largest total force of the fenders"),
        "course.largest_time": (course.time[whole.argmax()], "s", "time of the largest force, from contact"),
        "course.into_waves": (course.lost[-1], "J", "energy radiated as waves"),
    })  # fmt: skip
    found |= quantities("", {"course.ledger": (course.ledger, "", "error of the energy balance")})
    found |= quantities("largest in time", {
        "met.deflection": (most, "m", "deflection"),
        "met.strain": (strain, "%", "strain"),
        "met.reaction": (course.reaction.max(axis=0), "N", "reaction"),
    }, "fender")  # fmt: skip
    found |= quantities("", {
        "course.sway": (course.position[:, 0], "m", "sway towards the berth"),
        "course.yaw": (course.position[:, 1], "rad", "yaw"),
        "course.sway_velocity": (course.velocity[:, 0], "m/s", "velocity of sway"),
        "course.yaw_velocity": (course.velocity[:, 1], "rad/s", "velocity of yaw"),
        "course.taken": (course.taken, "J", "energy stored and dissipated in fenders"),
        "course.lost": (course.lost, "J", "energy in waves"),
    }, "time", record=True)  # fmt: skip
    return found | quantities("", {
        "course.deflection": (course.deflection, "m", "deflection"),
        "course.reaction": (course.reaction, "N", "reaction"),
    }, "time", "fender", record=True)  # fmt: skip


def _softest_of_all(approach, table):
    """A warning if the softest fender by all its causes needs more than its rated energy, that of a batch not"""
    alone = fender_of(table)
    (batch, _), _ = softest_and_stiffest(table, alone, BATCH)
    (soft, _), (factor, _) = softest_and_stiffest(table, alone)
    if soft.rated_energy * (1 + 1e-9) < approach.energy <= batch.rated_energy * (1 + 1e-9):
        yield (
            f"the softest fender by {', '.join(causes_of(table))} ({factor:.3g} times the catalogue's reaction) "
            f"needs {100 * approach.energy / soft.rated_energy:.4g} % of its rated energy, and the softest of a "
            f"batch needs {100 * approach.energy / batch.rated_energy:.4g} %; choose a larger fender, or name in "
            "fender.causes only the causes that act together at this berth"
        )


def _above_formulas(approach, course, db):
    """A warning if the memory of the water gives the fenders more energy than every formula of C_M"""
    if course is None or db is None:
        return
    name, (mass, energy) = max(approach.energies.items(), key=lambda one: one[1][1])
    if course.energy > (1 + MORE) * energy:
        yield (
            f"the memory of the water gives the fenders {course.energy / 1e3:.4g} kJ, C_M {course.virtual_mass:.3g}, "
            f"{100 * (course.energy / energy - 1):.0f} % more than the largest formula ({name}: {energy / 1e3:.4g} kJ, "
            f"C_M {mass:.3g}), as happens where little water is under the keel; the table of fenders of a batch is for "
            f"the energy of the formula, {approach.energy / 1e3:.4g} kJ: size them for the larger one"
        )


def _failures(study, approach, course):
    """Failures of fenders and dolphins: by the kinetic-energy method (Ueda 1981, section 6), and in time"""
    table = study.fender[approach.first]
    alone = fender_of(table)
    found = list(beyond_batch("energy of the berthing", approach.energy, table, alone))
    yield from found
    (_, stiff), (_, high) = softest_and_stiffest(table, alone, BATCH)
    _, (reaction,) = at_deflections([stiff], [deflection_of(stiff, approach.energy)])
    if table.dolphin_yield is not None and reaction > 1e3 * table.dolphin_yield:
        yield fails(
            f"the stiffest fender of a batch ({high:g} times its reaction) pushes with {reaction / 1e3:.4g} kN, and "
            f"the dolphin yields at {table.dolphin_yield:.4g} kN; give a softer fender or a stronger dolphin"
        )
    if course is None:
        return
    given = study.approach
    factors = given.softness * given.configuration * given.abnormal  # factors that the course in time does not contain
    for k, (fender, x, _) in enumerate(approach.meetings):
        if not (found and k == approach.first):
            taken = factors * float(fender.energy(course.deflection[:, k].max()))
            table = study.fender[k]
            yield from beyond_batch(f"energy in time of the fender at x = {x:g} m", taken, table, fender_of(table))
