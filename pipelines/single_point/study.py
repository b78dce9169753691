"""Conversion of a single-point study to SI: its lines, masses, loads, and its `SinglePoint`."""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.moored_body import leg_at_tension, moored_body
from hakobune.mooring.lines.system.parts import MooredBody, UniformLine
from hakobune.mooring.single_point.body import SinglePoint, SinglePointError, planar_mass, planar_mass_stored
from hakobune.mooring.single_point.scope import horizontal_at_rest

from ..common.line_tables import line_of
from ..common.quantities import StudyError, force, positive, water_depth
from ..common.weather.seas import mean_wave, sea_with_swell
from ..common.weather.water import check_solved_depth
from .loads import loads_of, own_mass

DENSITY, GRAVITY = 1025.0, 9.80665
MOST_LINES = 60
ROUND = 1e-3  # the same of length and beam of a round hull
SAME = 1e-6  # relative difference within which sizes of study and database are equal


class Made(NamedTuple):
    """point : SinglePoint; draft_left : freeboard of a buoy that may sink, m; inf for a buoy at a fixed height

    findings : one line each
    """

    point: SinglePoint
    draft_left: float
    findings: tuple[str, ...]


def make(study, db=None, is_round=None) -> Made:
    """The SinglePoint of a Study; db : an opened database, for masses and drift

    is_round : whether the hull is a vertical cylinder; by default as in the database, without a database False

    raises : StudyError or SinglePointError, one line
    """
    depth = water_depth("water.depth", study.water.depth)
    _check_hull(study, depth)
    if db is not None:
        check_database(study, db)
    density = DENSITY if db is None else db.density
    is_round = (db is not None and db.is_round) if is_round is None else is_round
    if is_round and not math.isclose(study.hull.length, study.hull.beam, rel_tol=ROUND):
        raise StudyError(
            f"hull.length is {study.hull.length:g} m and hull.beam {study.hull.beam:g} m, but the hull of the database "
            "is round; give its diameter as both"
        )
    mass, center = _mass(study, db, density, is_round)
    loads, findings = loads_of(study, db, density, center, mass, is_round)
    ends, lengths = _hawsers(study, center)
    system, left = system_of(study, depth, density)
    try:
        return Made(SinglePoint(loads, mass, ends, lengths, system), left, tuple(findings))
    except SinglePointError as error:
        raise StudyError(f"hawser: {error}") from None


def _check_hull(study, depth):
    h = study.hull
    for key in ("length", "beam", "draft"):
        positive(f"hull.{key}", getattr(h, key))
    if h.freeboard is not None:
        positive("hull.freeboard", h.freeboard)
    if not h.draft < depth:
        raise StudyError(f"hull.draft is {h.draft:g} m; allowed: below the depth of {depth:g} m")
    if not abs(h.center) < 0.5 * h.length:
        raise StudyError(f"hull.center is {h.center:g} m from midship; allowed: within {0.5 * h.length:g} m")


def check_database(study, db):
    """Raises StudyError if the hull or the water of the database differs from that of the study"""
    hull, depth, waves = study.hull, study.water.depth, study.waves
    seen = waves is not None and waves.drift_tonf_per_m2 is None
    period = mean_wave(waves, sea_with_swell("waves", waves, depth).spectrum)[1] if seen else None
    check_solved_depth(depth, db.water_depth, "the database", period)
    sizes = dict.fromkeys(("length", "beam"), 2 * db.dimensions.get("radius", math.nan)) | db.dimensions
    for key in ("length", "beam", "draft"):
        own, stored = getattr(hull, key), sizes.get(key)
        if stored is not None and not (math.isnan(stored) or math.isclose(own, stored, rel_tol=SAME)):
            raise StudyError(
                f"hull.{key} is {own:g} m, but the database is for {stored:g} m; change it, or give another database"
            )


def _mass(study, db, density, is_round):
    """Planar mass with added mass about the centre of mass, shape (3, 3), and that centre from midship, m, shape
    (2,)"""
    h, table = study.hull, study.mass
    if table is None and db is None:
        raise StudyError("mass is missing; give [mass] with added_surge, added_sway and added_yaw, or --database")
    if db is not None and table is None:
        return planar_mass_stored(db.reader), np.asarray(db.rotation_center, float)[:2]
    own = positive("hull.displacement", own_mass(h, density, is_round))
    if table.gyration is not None:
        positive("mass.gyration", table.gyration)
    gyration = h.beam / math.sqrt(8) if table.gyration is None and is_round else table.gyration
    shares = np.array([table.added_surge, table.added_sway, table.added_yaw])
    if not np.all((shares >= 0) & np.isfinite(shares)):
        raise StudyError(f"mass: the added mass is {shares.min():g} times the mass of the body; allowed: at least 0")
    return planar_mass(own, h.length, h.beam, shares, gyration), np.array([h.center, 0.0])


def _hawsers(study, center):
    """Ends (k, 2) m from the centre of mass, and lengths (k,) m"""
    a, hull = study.attachment, study.hull
    for name, place, size in (("x", a.x, hull.length), ("y", a.y, hull.beam)):
        if not abs(place) <= size:
            raise StudyError(f"attachment.{name} is {place:g} m; allowed: -{size:g} to {size:g}, on or near the hull")
    at = np.array([a.x, a.y]) - center
    if study.hawser is None:
        return at[None], np.zeros(1)
    h = study.hawser
    if not 0 < h.length < math.inf:
        raise StudyError(f"hawser.length is {h.length:g} m; allowed: above 0; leave out [hawser] for a contact buoy")
    if h.count not in (1, 2):
        raise StudyError(f"hawser.count is {h.count}; allowed: 1 or 2")
    if h.count == 1:
        if h.spacing:
            raise StudyError(f"hawser.spacing is {h.spacing:g} m; allowed only with count = 2")
        return at[None], np.array([h.length])
    positive("hawser.spacing", h.spacing)
    aside = np.array([0.0, 0.5 * h.spacing])
    return np.stack([at + aside, at - aside]), np.full(2, h.length)


def system_of(study, depth, density):
    """System of the buoy on its lines, and the freeboard of the buoy, m; depth : m; density : kg/m³"""
    b, m = study.buoy, study.mooring
    if not -depth < b.z <= 0:
        raise StudyError(f"buoy.z is {b.z:g} m; allowed: above the bed at {-depth:g} m, at most 0")
    line = line_of("mooring", "line", m, study.types, density=density, gravity=GRAVITY, level=-depth)
    height = b.z + depth
    if line.length < height:
        raise StudyError(
            f"mooring: lines of {line.length:g} m cannot reach the bed {height:g} m below the buoy; lengthen them"
        )
    pretension = _pretension(m, line, height)
    try:
        legs = [
            leg_at_tension(replace(line, name=f"line {i}"), (0.0, 0.0, b.z), heading, depth, pretension)
            for i, heading in enumerate(_headings(m), 1)
        ]
    except ValueError as error:
        raise StudyError(f"mooring: {error}") from None
    made = moored_body(legs, depth, (0.0, 0.0, b.z), density, GRAVITY, "buoy")
    body, left = _buoy(study, density, made)
    return System(depth, made.lines, made.points, (body,), density, GRAVITY), left


def _headings(m):
    """rad, from the buoy to each anchor"""
    if (m.headings_deg is None) == (m.count is None):
        raise StudyError("mooring: give one of headings_deg, count")
    if m.headings_deg is not None:
        if not 1 <= len(m.headings_deg) <= MOST_LINES:
            raise StudyError(f"mooring.headings_deg has {len(m.headings_deg)} values; allowed: 1 to {MOST_LINES}")
        return np.radians(m.headings_deg)
    if not 1 <= m.count <= MOST_LINES:
        raise StudyError(f"mooring.count is {m.count}; allowed: 1 to {MOST_LINES}")
    return math.radians(m.first_deg) + np.arange(m.count) * (2 * math.pi / m.count)


def _pretension(m, line, height):
    """N, horizontal, at rest"""
    horizontal, top = force("mooring", m, "pretension"), force("mooring", m, "top_tension")
    if (horizontal is None) == (top is None):
        raise StudyError("mooring: give either pretension (horizontal) or top_tension, in tonf or kN")
    if top is None:
        return horizontal
    if not isinstance(line, UniformLine):
        raise StudyError("mooring.top_tension applies to a uniform line; give pretension for a line of segments")
    try:
        return horizontal_at_rest(top, line.type.weight, line.type.axial_stiffness, height)
    except ValueError as error:
        raise StudyError(f"mooring.top_tension is {error}") from None


def _buoy(study, density, on_lines):
    """The buoy as a body of the System `on_lines` with a buoy of fixed height, and its freeboard without lines, m"""
    b = study.buoy
    if b.mass is not None and b.draft is not None:
        raise StudyError("buoy: mass and draft are both given, and each defines the other; give one of them")
    at = (0.0, 0.0, b.z, 0.0, 0.0, 0.0)
    given = {"mass": b.mass} if b.draft is None else {"draft": b.draft}
    given |= {"diameter": b.diameter, "height": b.height}
    if list(given.values()) == [None] * 3:
        return MooredBody("buoy", at, ("Surge", "Sway")), math.inf
    if None in given.values():
        raise StudyError("buoy: mass, diameter and height belong together; give all or none, or draft in place of mass")
    first, diameter, height = (positive(f"buoy.{key}", value) for key, value in given.items())
    area = 0.25 * math.pi * diameter**2
    up = 0.0 if b.draft is None else float(rest(on_lines).lines.vertical_b.sum()) / (density * GRAVITY * area)
    mass = first if b.draft is None else 1e-3 * density * area * (b.draft - up)
    draft = 1e3 * mass / (density * area)
    if not mass > 0:
        raise StudyError(
            f"buoy.draft is {b.draft:g} m; allowed: above {up:.4g} m, the draft that the pull of the lines "
            "alone causes; give a larger buoy or lighter lines"
        )
    if b.draft is not None and not b.draft < height:
        raise StudyError(f"buoy.draft is {b.draft:g} m; allowed: below the height of {height:g} m")
    if not draft < height:
        raise StudyError(
            f"buoy.mass is {mass:g} t; allowed: below {1e-3 * density * area * height:.4g} t, its buoyancy when awash"
        )
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = density * GRAVITY * area
    at = (0.0, 0.0, b.z + up, 0.0, 0.0, 0.0)
    return MooredBody("buoy", at, ("Surge", "Sway", "Heave"), stiffness), height - draft


def mass_of(buoy, system):
    """kg, of a BuoyTable that floats; system : its System"""
    if buoy.mass is not None:
        return 1e3 * buoy.mass
    alone = buoy.draft - (system.bodies[0].position[2] - buoy.z)
    return system.density * 0.25 * math.pi * buoy.diameter**2 * alone


def check_buoy(made, equilibrium):
    """Raises StudyError if the lines pull the buoy under water."""
    lines = equilibrium.lines
    sunk = made.point.system.bodies[0].position[2] - lines.position[0, 2]
    if sunk > made.draft_left:
        down = float(lines.lines.vertical_b.sum()) / 1e3
        raise StudyError(
            f"buoy: its lines pull it down with {down:.4g} kN, so it sinks by {sunk:.3g} m; allowed: its freeboard of "
            f"{made.draft_left:.3g} m; give a larger buoy or lighter lines"
        )
