"""A mooring study: water, hull, lines and the weather that acts on them, as typed TOML.

`[simulation]`, gusts and the spectrum of the waves are for `simulate` alone (`pipelines.simulate.study`).

A key contains its unit if it is not SI: `speed_knots`, `pretension_tonf`.  Wind, current and waves have either
`direction_deg`, the direction of travel, 0 → +x, or `incidence_deg`, the angle χ of the SR179 report, 0 from ahead:
direction = incidence + 180°.  Every fault is one line with the key, the value and the allowed values.
"""

import math
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np

from hakobune.bem.bodies.one_of_several import body_named, each_body
from hakobune.mooring.lines.catalogue import unread
from hakobune.mooring.lines.system.moored_body import Leg, corner_legs, leg_at_tension, moored_bodies, moored_body
from hakobune.mooring.loads.on_hull import current_on, wind_on
from hakobune.mooring.studies.conditions import Conditions, ExposedBox, Waves, afloat
from hakobune.mooring.studies.wave_effects import METHODS

from ..common.line_tables import TypeTable, check_types, hawser_at_tension, line_of
from ..common.quantities import StudyError, Table, below, force, positive, water_depth
from ..common.quay_tables import (
    DolphinTable,
    HingeTable,
    QuayFenderTable,
    RopeTable,
    berth_between,
    berth_of_tables,
    doubtful_holds,
)
from ..common.typed import typed
from ..common.weather.seas import WavesTable, mean_wave, sea_with_swell
from ..common.weather.streams import (
    CurrentTable,
    WindTable,
    current_of,
    doubtful_weather,
    no_box,
    superstructures,
    wind_of,
    with_files,
)
from ..common.weather.water import DepthTable, check_solved_depth
from ..results.heard import heard
from ..site.link import SiteLink, read_study_at_site
from .anchors import AnchorTable, anchors_of
from .lines_file import with_lines
from .tables import (
    HarbourTable,
    HullTable,
    OneLine,
    QuayTable,
    SimulationTable,
    Spread,
)

MOST_LINES = 500  # largest number of lines of a study; they take three seconds
AT_SURFACE = 1e-6  # depth of a point in the surface, over the draft


class Study(Table):
    """A moored body: water, hull, lines and weather

    hulls : {name of a moving body = a table like [hull]}, where several bodies move
    lines_file : file of lines of MoorDyn, MoorPy, RAFT, OrcaFlex or `hakobune lines`, in place of types and lines
    lines_body : name of the body that the lines of lines_file hold, where there are several bodies
    allowable : fraction of the breaking load that a line or rope may carry (OCIMF MEG4: 0.5 of ropes, 0.55 of wires)
    """

    water: DepthTable
    hull: HullTable | None = None
    hulls: dict[str, HullTable] = msgspec.field(default_factory=dict)
    site: SiteLink | None = None
    types: dict[str, TypeTable] = msgspec.field(default_factory=dict)
    lines_file: str | None = None
    lines_body: str = ""
    spreads: list[Spread] = msgspec.field(default_factory=list)
    lines: list[OneLine] = msgspec.field(default_factory=list)
    anchors: list[AnchorTable] = msgspec.field(default_factory=list)
    wind: WindTable | None = None
    current: CurrentTable | None = None
    waves: WavesTable | None = None
    simulation: SimulationTable | None = None
    fender: list[QuayFenderTable] = msgspec.field(default_factory=list)
    dolphin: list[DolphinTable] = msgspec.field(default_factory=list)
    rope: list[RopeTable] = msgspec.field(default_factory=list)
    hinges: list[HingeTable] = msgspec.field(default_factory=list)
    harbour: HarbourTable | None = None
    quay: QuayTable | None = None
    allowable: float = 0.4

    def conditions(self):
        """The `Conditions` of the study, without the warnings on its seas"""
        return self.conditions_and_warnings()[0]

    def conditions_and_warnings(self):
        """The `Conditions` of the study, and warnings on its seas, one line each.  Raises StudyError."""
        with heard() as said:
            made = self._conditions()
        return made, tuple(said)

    def _conditions(self):
        """Conditions in SI units"""
        wind, current, waves = wind_of(self.wind), current_of(self.current), self.waves
        if waves is None:
            return Conditions(wind, current)
        if waves.method not in METHODS:
            raise StudyError(f"waves.method is {waves.method!r}; allowed: {', '.join(METHODS)}")
        if waves.swell and waves.method != "irregular":
            raise StudyError(f'waves.swell is given with method = "{waves.method}"; swell needs "irregular"')
        sea = sea_with_swell("waves", waves, self.water.depth)
        regular = Waves(*mean_wave(waves, sea.spectrum), sea.direction)
        duration = 3600 * positive("waves.duration_hours", waves.duration_hours)
        factor = below("waves.motion_factor", waves.motion_factor, 10.0)
        return Conditions(wind, current, regular, waves.method, sea, duration, factor)

    def hulls_of(self, db):
        """ExposedBox of a database of one body, by `hull_of`; for several bodies {name: ExposedBox} of the moving
        bodies
        """
        if not db.bodies:
            if self.hulls:
                raise StudyError(f"hulls.{min(self.hulls)} is given, but the database contains one body; give [hull]")
            return self.hull_of(db.sizes)
        moving = [body for body in db.bodies if not body.fixed]
        unknown = set(self.hulls) - {body.name for body in moving}
        if unknown or self.hull is not None:
            wrong = f"hulls.{min(unknown)}" if unknown else "hull"
            names = ", ".join(f"[hulls.{body.name}]" for body in moving)
            raise StudyError(f"{wrong} is given; allowed with this database: {names}")
        found = {}
        for body in moving:
            try:
                found[body.name] = self.hull_of(box_of(db, body), self.hulls.get(body.name, HullTable()))
            except StudyError as error:
                raise StudyError(f"hulls.{body.name}: {error}") from None
        return found

    def hull_of(self, dimensions, table=None):
        """ExposedBox with sizes from the study or from a database (`dimensions`, m); sizes that contradict each
        other are an error.

        A hull with a radius is round.

        table : HullTable, by default the table of the study's one body
        """
        sizes, given = {}, table or (HullTable() if self.hull is None else self.hull)
        if is_round := "radius" in dimensions:
            dimensions = dict.fromkeys(("length", "beam"), 2 * dimensions["radius"]) | dimensions
        for key in ("length", "beam", "draft"):
            own, stored = getattr(given, key), dimensions.get(key)
            if own is None and stored is None:
                raise StudyError(f"hull.{key} is missing, also in the database; give it in m, above 0")
            if own is not None and stored is not None and not math.isclose(own, stored, rel_tol=1e-6):
                raise StudyError(
                    f"hull.{key} is {own:g} m, but the database is for {stored:g} m; change it, or give another "
                    f"database"
                )
            sizes[key] = positive(f"hull.{key}", stored if own is None else own)
        if given.freeboard is None and self.wind is not None:
            raise StudyError("hull.freeboard is missing, and the wind acts on it; give the freeboard in m, above 0")
        freeboard = sizes["draft"] if given.freeboard is None else positive("hull.freeboard", given.freeboard)
        return ExposedBox(**sizes, freeboard=freeboard, **superstructures(given), is_round=is_round)

    def remarks(self, hull, db):
        """Initial findings on an `ExposedBox` and the database of its hull, one line each

        raises : StudyError as `check_streams` and `check_floats`
        """
        from ..solve.report import doubts

        self.check_depth(db.water_depth, db.path)
        check_floats(db)
        said = [line for line in dict.fromkeys(unread(one.catalogue) for one in self.types.values()) if line]
        said += [*doubtful_weather(self), *doubts(db)]
        for one in each_body(db):
            box = hull.get(one.name) if db.bodies else hull
            if box is not None:
                self.check_streams(box, db.density)
                volume = one.displaced_volume
                known = volume is None or box.is_round
                said += [] if known else no_box(volume / (box.length * box.beam * box.draft), box, self)
                if not db.bodies:
                    held = bool(self.lines or self.spreads or self.hinges)
                    said += doubtful_holds(self.fender, self.rope, box, held)
        return said

    def check_depth(self, solved, name):
        """Raises StudyError as `common.weather.water.check_solved_depth` does"""
        waves = self.conditions().waves
        check_solved_depth(self.water.depth, solved, name, None if waves is None else waves.period)

    def check_streams(self, hull, density):
        """Raises StudyError for impossible weather, and for weather without the coefficients of an `ExposedBox`;
        density : kg/m³
        """
        given = self.conditions()
        try:
            if given.wind:
                wind_on(given.wind, hull)
            if given.current:
                current_on(given.current, hull, density, self.water.depth)
        except ValueError as error:
            raise StudyError(str(error)) from None

    @property
    def at_berth(self):
        """Whether fenders or ropes hold the body"""
        return bool(self.fender or self.dolphin or self.rope)

    def berth(self, hull, center):
        """`mooring.motion.contacts.Berth` of fenders and ropes, for a body with its axes at `center` (3,) m"""
        return berth_of_tables(self.fender, self.dolphin, self.rope, hull, center)

    def berth_of(self, db, hulls):
        """Berth of several bodies of a database; hulls : from `hulls_of`. Raises StudyError for unsupported cases."""
        if not db.bodies:
            return self.berth(hulls, db.rotation_center)
        if self.quay is not None or self.harbour is not None:
            key = "quay" if self.quay is not None else "harbour"
            raise StudyError(
                f"[{key}] is given, but the database contains several bodies; this table is for one body only"
            )
        return berth_between(self.fender, self.dolphin, self.rope, afloat(db, hulls), db.bodies)

    def without_berth(self, command):
        """The study itself.  Raises StudyError for fenders, ropes, hinges or a quay, which the command excludes."""
        if self.hinges:
            raise StudyError(f"{command} does not support [[hinges]]; use hakobune simulate")
        if self.at_berth:
            raise StudyError(f"{command} does not support [[fender]], [[dolphin]] and [[rope]]; use hakobune simulate")
        if self.quay is not None:
            raise StudyError(
                f"{command} does not support [quay]; use hakobune simulate, or a database solved with --wall"
            )
        return self

    def anchors_on(self, names):
        """[`mooring.criteria.anchors.Anchor` or None] of each line by its name in results.  Raises StudyError."""
        return anchors_of(self.anchors, names, [line.name for line in self.lines if line.bollard is not None])

    def system(self, hull, center, density=1025.0, gravity=9.80665, in_time=False):
        """System of one hull on all spreads and lines; None if only a berth holds the hull, or if nothing does in a
        simulation

        center : (3,) m, origin of the axes of the body; density : kg/m³; gravity : m/s²
        """
        known = [line.body or line.to for line in (*self.spreads, *self.lines) if getattr(line, "to", "") or line.body]
        if known:
            raise StudyError(f"body {known[0]!r} is given, but the database contains one body; leave out body and to")
        legs = self._legs({"": hull}, density, gravity, in_time)
        return None if legs is None else moored_body(legs, self.water.depth, center, density, gravity)

    def system_of(self, db, hulls, in_time=False):
        """System of the bodies of a database with hulls as `hulls_of` gives them; None where `system` gives None"""
        if not db.bodies:
            return self.system(hulls, db.rotation_center, db.density, db.gravity, in_time)
        legs = self._legs(hulls, db.density, db.gravity, in_time, {body.name: body for body in db.bodies})
        if legs is None:
            return None
        moving = {body.name: (body.rotation_center, body.heading) for body in db.bodies if not body.fixed}
        return moored_bodies(legs, moving, self.water.depth, db.density, db.gravity)

    def _legs(self, hulls, density, gravity, in_time, bodies=None):
        """[Leg] of all spreads and lines on hulls {name: ExposedBox}, None if there are none and none is required

        bodies : {name: `bem.modes.Body`} of several bodies, in whose coordinates their ends are given
        """
        check_types(self.types)
        if not self.spreads and not self.lines:
            if self.at_berth or in_time:
                return None
            raise StudyError(
                "the study has no lines; give at least one [[spreads]] or [[lines]], or use hakobune simulate "
                "without lines"
            )
        if not math.isfinite(self.water.depth):
            raise StudyError("water.depth is inf; lines need a finite depth, m")
        count = len(self.lines) + sum(4 * len(spread.corner_headings_deg) for spread in self.spreads)
        if count > MOST_LINES:
            raise StudyError(
                f"the study has {count} lines; allowed: up to {MOST_LINES}; combine lines in parallel into one "
                "with their summed weight, stiffness and breaking load"
            )
        legs = []
        for i, spread in enumerate(self.spreads):
            prefix = f"spread {i + 1} " if len(self.spreads) > 1 else ""
            if bodies is not None:
                alone = [one.body for one in self.spreads].count(spread.body) == 1
                prefix = f"{spread.body} {'' if alone else prefix}"
            body = _of_several(f"spreads[{i}].body", spread.body, bodies, hulls)
            made = self._spread(f"spreads[{i}]", spread, hulls[spread.body], density, gravity)
            legs += [_placed(leg, body)._replace(line=replace(leg.line, name=prefix + leg.line.name)) for leg in made]
        for i, line in enumerate(self.lines):
            body = _of_several(f"lines[{i}].body", line.body, bodies, hulls)
            legs.append(self._leg(f"lines[{i}]", _in_space(f"lines[{i}]", line, body, bodies), density, gravity))
        return legs

    def _spread(self, where, spread, hull, density, gravity):
        if self._straight(spread):
            raise StudyError(f"{where}.type {spread.type} is a hawser; give it as [[lines]] with a bollard")
        line = line_of(where, "spread", spread, self.types, density=density, gravity=gravity, level=-self.water.depth)
        headings = _corner_headings(where, spread.corner_headings_deg)
        pretension = force(where, spread, "pretension", required=True)
        sizes = hull.length, hull.beam, headings, self.water.depth, pretension
        return corner_legs(line, *sizes, spread.fairlead_z, hull.is_round)

    def _leg(self, where, given, density, gravity):
        pretension, depth, straight = force(where, given, "pretension"), self.water.depth, self._straight(given)
        if straight and given.bollard is not None and given.length is None and pretension is not None:
            away = math.dist(given.bollard, given.fairlead)
            kind = given.type, self.types[given.type]
            line = hawser_at_tension(where, given.name, *kind, away, pretension)
            return Leg(line, given.bollard, given.fairlead, given.body, given.to)
        line = line_of(where, given.name, given, self.types, density=density, gravity=gravity, level=-depth)
        if given.bollard is not None and pretension is None and given.anchor is None and given.heading_deg is None:
            return Leg(line, given.bollard, given.fairlead, given.body, given.to)
        if straight:
            raise StudyError(f"{where} ({given.name}) is a hawser; give a bollard, with a length or a pretension")
        if given.anchor is not None and given.heading_deg is None and pretension is None:
            return Leg(line, (*given.anchor, -depth), given.fairlead, given.body)
        if given.anchor is None and given.heading_deg is not None and pretension is not None:
            leg = leg_at_tension(line, given.fairlead, math.radians(given.heading_deg), depth, pretension)
            return leg._replace(body=given.body)
        raise StudyError(f"{where} ({given.name}): give one of anchor, bollard, or heading_deg with a pretension")

    def _straight(self, table):
        return table.type in self.types and self.types[table.type].straight


def check_floats(db):
    """Raises StudyError for a body whose hull pierces the water surface but has no stiffness in heave"""
    if db.bodies or db.hydrostatic_stiffness is None or db.hydrostatic_stiffness[2, 2] > 0 or db.mesh is None:
        return
    top = float(db.mesh.points[:, 2].max())
    if top < -AT_SURFACE * db.mesh.draft:  # all of it lies below
        return
    raise StudyError(
        f"hydrostatics: the hull of {db.path} has a stiffness in heave of {db.hydrostatic_stiffness[2, 2]:.4g} N/m, "
        f"which cannot hold it up; its mesh ends at z = {top:.4g} m, not open at the water: cut it by `hakobune "
        f"mesh --clip`, and solve or import it again"
    )


def box_of(db, body):
    """{"length", "beam", "draft"}, m, of the box around one of several bodies (`bem.modes.Body`), centred on the
    body's origin.

    A hull of revolution about its own vertical axis also has a "radius".

    db : Database, or a `moor.checked.Body` of hulls that are not solved yet
    """
    if hasattr(db, "boxes"):
        return db.boxes[body.name]
    whole = body_named(db, body.name).mesh.whole()
    points = whole.points - (*body.place, 0.0)
    draft = float(-points[:, 2].min())
    if replace(whole, points=points).is_round:
        radius = float(np.hypot(*points[:, :2].T).max())
        return {"length": 2 * radius, "beam": 2 * radius, "draft": draft, "radius": radius}
    length, beam = 2 * np.abs(points @ body.axes)[:, :2].max(axis=0)
    return {"length": float(length), "beam": float(beam), "draft": draft}


def sides_of(db):
    """`mooring.fenders.gaps.Side` of every body of a database, () for one body"""
    from hakobune.mooring.fenders.gaps import Side

    found, count = [], 0
    for body in db.bodies:
        box, place = box_of(db, body), np.array([*body.rotation_center[:2], body.heading], float)
        half = 0.5 * np.array([box["length"], box["beam"]])
        found.append(Side(body.name, half, body.own_center[:2], -1 if body.fixed else count, place))
        count += not body.fixed
    return tuple(found)


def _of_several(where, name, bodies, hulls):
    """`bem.modes.Body` of a name, None for a single body.  Raises StudyError for a fixed body."""
    if bodies is None:
        return None
    if name not in hulls:
        raise StudyError(f"{where} is {name!r}; allowed: a body that moves, {', '.join(hulls)}")
    return bodies[name]


def _placed(leg, body):
    """A Leg of a body in its own coordinates, converted to space"""
    if body is None:
        return leg
    ends = (tuple(map(float, body.in_scene(end))) for end in (leg.anchor, leg.fairlead))
    return leg._replace(**dict(zip(("anchor", "fairlead"), ends, strict=True)), body=body.name)


def _in_space(where, line, body, bodies):
    """A OneLine with fairlead and bollard in coordinates of bodies, both converted to space"""
    if body is None:
        return line
    changed = {"fairlead": tuple(map(float, body.in_scene(line.fairlead)))}
    if line.to:
        if line.to not in bodies or line.to == line.body:
            others = ", ".join(name for name in bodies if name != line.body)
            raise StudyError(f"{where}.to is {line.to!r}; allowed: the name of another body, {others}")
        if line.bollard is None:
            raise StudyError(f"{where}.bollard is missing; give x, y, z on {line.to}, m, where the line ends")
        changed["bollard"] = tuple(map(float, bodies[line.to].in_scene(line.bollard)))
    return msgspec.structs.replace(line, **changed)


def read_study(path):
    """The Study of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_raw(path)
    return make_study(raw), text


def read_raw(path):
    """Nested dictionaries of a TOML file, with the values taken from a site and other files; and the text of the
    file.  Raises StudyError.
    """
    return with_files(*with_lines(*read_study_at_site(Path(path), "a study"), path), path)


def make_study(raw):
    """The Study of nested dictionaries read from TOML.  Raises StudyError."""
    study = typed(raw, Study, StudyError)
    if study.site is not None:
        raise StudyError(
            "site is given in a study that was not read from a file; put it in a study file and read that by read_study"
        )
    if study.lines_file is not None:
        raise StudyError(
            "lines_file is given in a study that was not read from a file; put it in a study file and read that by "
            "read_study"
        )
    if study.lines_body:
        raise StudyError(f"lines_body is {study.lines_body!r}, but lines_file is missing; give both")
    if not 0 < study.allowable <= 1:
        raise StudyError(f"allowable is {study.allowable:g}; allowed: above 0, at most 1")
    if study.water.depth != math.inf:
        water_depth("water.depth", study.water.depth)
    return study


def _corner_headings(where, degrees):
    wrong = [value for value in degrees if not 0 <= value <= 90]
    if wrong or not degrees:
        shown = f"{wrong[0]:g}" if wrong else "empty"
        raise StudyError(
            f"{where}.corner_headings_deg is {shown}; allowed: one or more headings from 0 to 90, for the "
            "corner +x, +y; the other three corners mirror them; for other headings give [[lines]] with "
            "fairlead and heading_deg"
        )
    return np.radians(degrees)
