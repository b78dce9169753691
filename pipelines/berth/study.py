"""A berthing as typed TOML: a ship, its approach, and the fenders that the ship meets.

[ship]                    [approach]                 [[fender]]            # keys of `hakobune fender` and
length = 337.5  # over    speed = 0.15               family = "v"
beam = 53.6     # all     offset = 53.0              height = 1.0
draft = 19.7              virtual_mass = "ueda"      length = 10.0
block = 0.795             abnormal = 1.5             dolphin = 34000.0     # kN/m
                                                     x = 53.0              # m ahead of the centre of gravity
                                                     gap = 0.0             # m behind the foremost
"""

import math
from pathlib import Path

import msgspec
import numpy as np

from hakobune.mooring.berthing import energy
from hakobune.mooring.berthing.speeds import speeds_of_moments

from ..common.fender_tables import FenderTable, fender_of, pair_of
from ..common.quantities import StudyError, Table, below, positive, water_density, water_depth
from ..common.typed import typed
from ..site.link import BERTHING, SiteLink, read_study_at_site

METHODS = {
    "ueda": "Ueda 1981",
    "vasco_costa": "Vasco Costa",
    "older": "older, (π/4) ρ d² L",
    "pianc": "PIANC 2002",
}
FASTEST, FARTHEST = 5.0, 45.0  # m/s; degrees between ship and berth
MOST_FENDERS = 200


class ShipTable(Table):
    """Dimensions and mass of the berthing ship

    length : m, length over all
    beam : m, beam of the ship
    draft : m, draft of the ship
    displacement : t, displaced mass; or give block
    block : block coefficient; or give displacement
    gyration : m, radius of gyration in yaw; by default a quarter of the length
    center : m, distance of the centre of gravity ahead of midship, for a database
    body : name of the ship among several bodies of a database, of which the others are held still
    """

    length: float
    beam: float
    draft: float
    displacement: float | None = None
    block: float | None = None
    gyration: float | None = None
    center: float = 0.0
    density: float = 1025.0
    body: str = ""


class SpeedsTable(Table):
    """Weibull distribution of the berthing speeds

    mean : m/s, mean berthing speed
    deviation : m/s, standard deviation of the berthing speed
    contacts : number of berthings, of which on average one reaches the design speed
    """

    mean: float
    deviation: float
    contacts: float


class ApproachTable(Table):
    """Speed, angle and energy factors of the approach

    speed : m/s, speed normal to the berth; or give speeds
    angle_deg : angle between ship and berth; above 0 the bow is nearer
    offset : m, distance of the contact from the centre of gravity along the ship; by default from the x of the first
        fender
    eccentricity : eccentricity coefficient C_E, in place of the offset
    virtual_mass : method of the virtual mass coefficient C_M: ueda, vasco_costa, older or pianc; or the value of C_M
    softness : softness coefficient C_s
    configuration : berth configuration coefficient C_c
    abnormal : factor on the energy for abnormal berthing
    """

    speed: float | None = None
    speeds: SpeedsTable | None = None
    angle_deg: float = 0.0
    offset: float | None = None
    eccentricity: float | None = None
    virtual_mass: str | float = "ueda"
    softness: float = 1.0
    configuration: float = 1.0
    abnormal: float = 1.0


class BerthFender(FenderTable, kw_only=True):
    """A fender of the berth

    x : m, distance ahead of midship where the ship meets it
    gap : m, distance of the fender's face behind the face of the foremost fender
    """

    x: float | None = None
    gap: float = 0.0


class BerthStudy(Table):
    """A berthing ship, its approach and the fenders that it meets

    depth : m, water depth at the berth
    """

    ship: ShipTable
    approach: ApproachTable
    fender: list[BerthFender] = msgspec.field(default_factory=list)
    depth: float | None = None
    site: SiteLink | None = None


class Approach(msgspec.Struct, frozen=True):
    """Values of a study in SI: ship : `energy.Ship`; speed : m/s; offset : distance of the first contact from the
    centre of gravity, m; eccentricity, virtual_mass, energy (J, with all factors) of the chosen method

    energies : {method: (C_M, energy in J)}; meetings : (fender with its dolphin, x in m, gap in m) for each fender;
        first : number of
    the fender met first
    """

    ship: energy.Ship
    speed: float
    offset: float
    eccentricity: float
    virtual_mass: float
    energy: float
    energies: dict
    meetings: tuple
    first: int


def read_berth(path):
    """The BerthStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_study_at_site(Path(path), "a berthing", BERTHING)
    return typed(raw, BerthStudy, StudyError), text


def approach_of(study):
    """The `Approach` of a study.  Raises ValueError, with a message of one line."""
    given, approach = study.ship, study.approach
    water_density("ship.density", given.density)
    mass = None if given.displacement is None else 1e3 * given.displacement
    sizes = {"mass": mass, "block": given.block, "gyration": given.gyration, "density": given.density}
    ship = energy.ship(given.length, given.beam, given.draft, **sizes)
    if not abs(given.center) < 0.5 * ship.length:
        raise StudyError(f"ship.center is {given.center:g}; allowed: within half the length, {0.5 * ship.length:g} m")
    if study.depth is not None:
        water_depth("depth", study.depth)
    speed = _speed(approach)
    meetings = _meetings(study, ship)
    first = int(np.argmin([gap for _, _, gap in meetings]))
    offset = _offset(approach, ship, meetings[first][1] - given.center)
    share = energy.eccentricity(offset, ship.gyration)
    factors = (share, approach.softness, approach.configuration)
    if not 1 <= approach.abnormal <= 10:
        raise StudyError(f"approach.abnormal is {approach.abnormal:g}; allowed: 1 to 10")
    masses = energy.virtual_masses(ship, study.depth)
    chosen = _virtual_mass(approach.virtual_mass, masses)
    if isinstance(approach.virtual_mass, float | int):
        masses = {"given": chosen} | masses
    energies = {
        key: (value, approach.abnormal * energy.berthing_energy(ship, speed, value, *factors))
        for key, value in masses.items()
    }
    design = approach.abnormal * energy.berthing_energy(ship, speed, chosen, *factors)
    return Approach(ship, speed, offset, share, chosen, design, energies, meetings, first)


def _speed(approach):
    if (approach.speed is None) == (approach.speeds is None):
        state = "neither is given" if approach.speed is None else "both are given"
        raise StudyError(f"approach: speed and speeds: {state}; give one of them")
    if approach.speed is not None:
        return below("approach.speed", approach.speed, FASTEST)
    table = approach.speeds
    return speeds_of_moments(table.mean, table.deviation).speed_of(table.contacts)


def _meetings(study, ship):
    if not 1 <= len(study.fender) <= MOST_FENDERS:
        raise StudyError(f"the study has {len(study.fender)} [[fender]]; allowed: 1 to {MOST_FENDERS}")
    angle = study.approach.angle_deg
    if not abs(angle) <= FARTHEST:
        raise StudyError(f"approach.angle_deg is {angle:g}; allowed: −{FARTHEST:g} to {FARTHEST:g}")
    made = []
    for i, table in enumerate(study.fender):
        where = f"fender[{i}]"
        x = _place(table, where, study, ship)
        if not 0 <= table.gap < math.inf:
            raise StudyError(f"{where}.gap is {table.gap:g}; allowed: 0 or more, finite")
        pair = pair_of(table, fender_of(table, where), where)
        made.append((pair, x, table.gap - x * math.tan(math.radians(angle))))
    return tuple(made)


def _place(table, where, study, ship):
    x, approach = table.x, study.approach
    if x is None:
        if len(study.fender) > 1 or (approach.offset is None and approach.eccentricity is None):
            raise StudyError(f"{where}.x is missing; give the place of contact, m ahead of midship")
        x = study.ship.center + _offset(approach, ship, None)
    if not abs(x) <= 0.5 * ship.length:
        raise StudyError(
            f"{where}: the ship does not reach x = {x:g} m; allowed: within half the length of the ship, "
            f"{0.5 * ship.length:g} m"
        )
    return x


def _offset(approach, ship, of_fender):
    if approach.offset is not None and approach.eccentricity is not None:
        raise StudyError("approach: offset and eccentricity are both given; give at most one")
    if approach.eccentricity is not None:
        return energy.offset_of(approach.eccentricity, ship.gyration)
    if approach.offset is not None:
        if not abs(approach.offset) <= ship.length:
            raise StudyError(f"approach.offset is {approach.offset:g}; allowed: at most the length of the ship")
        return approach.offset
    return of_fender


def _virtual_mass(given, masses):
    if not isinstance(given, str):
        return positive("approach.virtual_mass", given)
    name = METHODS.get(given)
    if name in masses:
        return masses[name]
    if given == "pianc":
        raise StudyError("approach.virtual_mass is 'pianc', which needs the water depth at the berth; give depth, m")
    raise StudyError(f"approach.virtual_mass is {given!r}; allowed: {', '.join(METHODS)}, or a number")
