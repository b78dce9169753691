"""Fenders, dolphins and ropes of a berth, hinges between bodies, and stations of a beam, as tables of a study file.

[[fender]]                       [[dolphin]]              [[rope]]
name = "F1"                      name = "D1"              name = "head line"
position = [-40.0, 25.0, 3.0]    stiffness = 5000.0       fairlead = [48.0, 20.0, 8.0]
family = "cell"                  yield_force = 3000.0     bollard = [70.0, 40.0, 4.0]
height = 1.7                     stiffness_beyond = 900   pretension_kN = 150.0
on = "D1"                                                 breaking_load_kN = 1200.0
friction = 0.2                                            break_strain = 0.1
shear = 2000.0                                            tail_length = 8.0 …

A fender touches the flat side of the hull in front of it; x, y, z in m with the body at rest, forces in kN. With
several bodies, `body` is the body that touches the fender or has the fairlead. `to` is the body that carries the fender
or the bollard, whose position is in the coordinates of `to`. Without `to` the fender or bollard is fixed, in
coordinates of the scene.
"""

import math
from dataclasses import replace

import msgspec
import numpy as np

from hakobune.bem.hinges import ALONE, DRIVEN, KINDS, SPACE, Link
from hakobune.mooring.response.findings import some

from .fender_tables import FenderTable, fender_of, pair_of
from .quantities import StudyError, Table, force

FARTHEST = 10.0  # m, of a fender from the hull at rest
ROUGHEST_FACE = 1.5  # coefficient of friction of a fender
SLIDES = 0.1  # of the height of a fender, travel along its face at which it slides where its shear is not given


class QuayFenderTable(FenderTable, kw_only=True):
    """A fender of the berth in front of a flat side of the hull

    name : name of the fender in results and messages
    position : m, x, y, z of the fender's face with the body at rest
    on : name of the dolphin that carries it
    friction : coefficient of friction μ of the fender's face
    shear : kN/m, stiffness along the face, up to the friction force; by default the face slides after a tenth of the
        height at the rated reaction
    body : name of the body that presses the fender, where there are several bodies
    to : name of the body that carries the fender; the position is then in this body's coordinates
    """

    name: str
    position: tuple[float, float, float]
    on: str | None = None
    friction: float = 0.0
    shear: float | None = None
    body: str = ""
    to: str = ""


class DolphinTable(Table):
    """A dolphin that carries a fender

    name : name of the dolphin, for the key on of a fender
    stiffness : kN/m, horizontal stiffness of the dolphin
    yield_force : kN, force at which the dolphin yields or the ground softens
    stiffness_beyond : kN/m, stiffness beyond yield_force
    """

    name: str
    stiffness: float
    yield_force: float | None = None
    stiffness_beyond: float | None = None


class RopeTable(Table, kw_only=True):
    """A rope from a bollard to the hull, with or without a tail

    name : name of the rope in results and messages
    fairlead : m, x, y, z of the fairlead with the body at rest
    bollard : m, x, y, z of the bollard in space
    breaking_load : breaking load of the new rope
    break_strain : strain at the breaking load, 0.1 for 10 %
    pretension : tension with the body at its given position, from which fenders and other ropes move it to rest; by
        default 0
    exponent : exponent n of T ∝ εⁿ
    hardening : factor on the stiffness of a used rope
    tail_length : m, length of the tail, 0 without one
    tail_breaking_load : breaking load of the tail; by default the rope's breaking load
    tail_break_strain : strain of the tail at its breaking load
    tail_exponent : exponent n of T ∝ εⁿ of the tail
    body : name of the body in whose coordinates the fairlead is given, where there are several bodies
    to : name of the body in whose coordinates the bollard is given
    """

    name: str
    fairlead: tuple[float, float, float]
    bollard: tuple[float, float, float]
    breaking_load_tonf: float | None = None
    breaking_load_kN: float | None = None
    break_strain: float
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    exponent: float = 1.0
    hardening: float = 1.0
    tail_length: float = 0.0
    tail_breaking_load_tonf: float | None = None
    tail_breaking_load_kN: float | None = None
    tail_break_strain: float | None = None
    tail_exponent: float = 1.0
    body: str = ""
    to: str = ""


def berth_of_tables(fenders, dolphins, ropes, hull, center):
    """`mooring.motion.contacts.Berth` of lists of tables; hull : ExposedBox; center : (3,) m.  Raises ValueError."""
    from hakobune.mooring.motion.contacts import berth_of

    for where, one in (*(("fender", one) for one in fenders), *(("rope", one) for one in ropes)):
        if one.body or one.to:
            raise StudyError(
                f"{where} {one.name}: body {one.body or one.to!r} is given, but the database contains one body; leave "
                "out body and to"
            )
    known = _dolphins(fenders, dolphins)
    made = [_fender(f"fender[{i}] ({one.name})", one, known.get(one.on), hull) for i, one in enumerate(fenders)]
    for one in ropes:
        _check_bollard(one.name, one.bollard, hull)
    return berth_of(made, [_rope(one) for one in ropes], center)


def berth_between(fenders, dolphins, ropes, hulls, bodies):
    """`mooring.motion.contacts.Berth` of several bodies.  Raises ValueError.

    hulls : `mooring.studies.conditions.Afloat` of the moving bodies; bodies : `bem.modes.Body` of all
    """
    from hakobune.mooring.motion.contacts import berth_of

    names, named, known = (
        [one.name for one in hulls],
        {body.name: body for body in bodies},
        _dolphins(fenders, dolphins),
    )
    made, held, ends = [], [], []
    for i, table in enumerate(fenders):
        where = f"fender[{i}] ({table.name})"
        body, to = _ends(where, table, names, named)
        face = to.in_scene(table.position) if to else np.array(table.position)
        own = hulls[names.index(body.name)]
        if table.to in names and _inside(own.own(face), own.box):
            other = hulls[names.index(table.to)]
            if _inside(other.own(face), other.box):
                x, y, z = face
                raise StudyError(
                    f"{where} lies inside both {body.name} and {table.to}, at {x:.4g}, {y:.4g}, {z:.4g} m in the axes "
                    "of the scene; allowed: between their sides"
                )
        placed = msgspec.structs.replace(table, position=tuple(map(float, own.own(face))), body="", to="")
        one = _fender(where, placed, known.get(table.on), own.box)
        if table.to in names and _inside(own.own(face), own.box):
            _check_side(where, one, own, hulls[names.index(table.to)])
        made.append(replace(one, face=face))
        ends.append((names.index(body.name), names.index(table.to) if table.to in names else -1))
    for table in ropes:
        body, to = _ends(f"rope {table.name}", table, names, named)
        bollard = to.in_scene(table.bollard) if to else np.array(table.bollard)
        own = hulls[names.index(body.name)]
        _check_bollard(table.name, own.own(bollard), own.box)
        placed = {"bollard": tuple(map(float, bollard)), "fairlead": tuple(map(float, body.in_scene(table.fairlead)))}
        held.append(_rope(msgspec.structs.replace(table, **placed)))
        ends.append((names.index(body.name), names.index(table.to) if table.to in names else -1))
    return berth_of(made, held, None, hulls, ends)


def _ends(where, table, moving, bodies):
    """`bem.modes.Body` of both ends, None for a fixed end.  Raises StudyError."""
    if table.body not in moving:
        raise StudyError(f"{where}: body is {table.body!r}; allowed: a body that moves, {', '.join(moving)}")
    if table.to and (table.to == table.body or table.to not in bodies):
        others = ", ".join(name for name in bodies if name != table.body)
        raise StudyError(
            f"{where}: to = {table.to!r}; allowed: the name of another body, {others}; or leave the key out"
        )
    return bodies[table.body], bodies.get(table.to)


def _check_side(where, fender, body, carrier):
    """Raise StudyError for a fender that presses on the side of a hull away from the one that carries it; `Afloat`"""
    beyond = fender.normal @ body.own((*carrier.place, 0.0))
    if beyond < -fender.side:
        raise StudyError(
            f"{where} is at the side of {body.name} away from {carrier.name}, behind its hull; allowed: between the "
            f"two; position is in the axes of {carrier.name}"
        )


def _inside(point, box):
    """Whether a point (3,) m in coordinates of a hull lies inside its box"""
    x, y, z = point
    if box.is_round and np.hypot(x, y) >= 0.5 * box.beam:
        return False
    return abs(x) < 0.5 * box.length and abs(y) < 0.5 * box.beam and -box.draft < z < box.freeboard


def _check_bollard(name, place, box):
    """Raises StudyError for a rope whose other end, (3,) m in coordinates of the hull, lies in its own hull"""
    if _inside(place, box):
        x, y, z = place
        raise StudyError(
            f"rope {name}: its bollard ({x:.4g}, {y:.4g}, {z:.4g}) m lies in the hull, {box.length:g} by "
            f"{box.beam:g} m, z {-box.draft:g} to {box.freeboard:g} m; give its place on the quay, measured "
            "from amidships"
        )


def doubtful_holds(fenders, ropes, hull, held):
    """Findings on ropes that cross the hull from side to side, and on fenders without ropes; held : whether lines
    hold the body too
    """
    across = [one.name for one in ropes if _crosses(np.array(one.fairlead, float), np.array(one.bollard, float), hull)]
    if across:
        yield (
            f"these ropes pass through the hull to a bollard on its other side: {some(across, 6)}; allowed: none; "
            "check the sign of y of fairlead and bollard"
        )
    if fenders and not ropes and not held:
        sides = {tuple(_side(one.name, np.array(one.position), hull)[0]) for one in fenders}
        if not any((-x, -y, -z) in sides for x, y, z in sides):
            yield (
                f"nothing pulls the body to its fenders: {len(fenders)} of {len(fenders)} push to one side, and no "
                "rope or line holds it; it drifts off unless wind or current press it on; give [[rope]] or [[lines]]"
            )


def _crosses(start, end, box):
    """Whether the straight way between two points (3,) m crosses the middle plane of a hull inside it"""
    if start[1] * end[1] >= 0:
        return False
    x, _, z = start + start[1] / (start[1] - end[1]) * (end - start)
    return abs(x) < 0.5 * box.length and -box.draft < z < box.freeboard


def _dolphins(fenders, dolphins):
    """{name: DolphinTable}.  Raises StudyError where dolphins and fenders do not match."""
    known = {one.name: one for one in dolphins}
    if len(known) < len(dolphins):
        raise StudyError("two [[dolphin]] have the same name; give each a name of its own")
    stands = [one.on for one in fenders if one.on is not None]
    for name in stands:
        if name not in known:
            raise StudyError(f"fender.on: there is no dolphin {name!r}; allowed: {', '.join(known) or 'none is given'}")
        if stands.count(name) > 1:
            raise StudyError(
                f"dolphin {name!r} carries {stands.count(name)} fenders; allowed: one [[fender]], with count "
                f"for fenders side by side"
            )
    for name in known:
        if name not in stands:
            raise StudyError(f"dolphin {name!r} carries no fender; name the dolphin in the key on of a [[fender]]")
    return known


def _fender(where, table, dolphin, hull):
    from hakobune.mooring.motion.contacts import QuayFender

    if table.causes is not None:
        raise StudyError(
            f"{where}.causes is given; a simulation uses one characteristic per fender: give the factor that "
            f"hakobune fender computes"
        )
    if dolphin is not None:
        if table.dolphin is not None:
            raise StudyError(f"{where}: on and dolphin are both given; give one of them")
        stands = {"dolphin": dolphin.stiffness, "dolphin_yield": dolphin.yield_force}
        table = msgspec.structs.replace(table, **stands, dolphin_beyond=dolphin.stiffness_beyond)
    face = np.array(table.position)
    normal, side = _side(where, face, hull)
    if table.friction > ROUGHEST_FACE:
        raise StudyError(
            f"{where}.friction is {table.friction:g}; allowed: at most {ROUGHEST_FACE:g}; rubber on steel "
            "has up to 1, a face of polyethylene about 0.2"
        )
    own = fender_of(table, where)
    slides = table.friction * own.rated_reaction / (SLIDES * own.height)
    shear = slides if table.shear is None else 1e3 * table.shear
    return QuayFender(table.name, pair_of(table, own, where), face, normal, side, table.friction, shear)


def _side(where, face, hull):
    """Outward normal of the hull's side in front of a face, and its distance from midship, m"""
    half = 0.5 * np.array([hull.length, hull.beam])
    off = np.abs(face[:2]) - half
    across = int(np.argmax(off))
    reached = off[1 - across] <= 0 and -hull.draft <= face[2] <= hull.freeboard and off[across] <= FARTHEST
    if not reached:
        x, y, z = face
        raise StudyError(
            f"{where}: the body cannot reach the point {x:g}, {y:g}, {z:g} m; allowed: points in front of a side of "
            f"the hull of {hull.length:g} × {hull.beam:g} m, at most {FARTHEST:g} m from it, with z from "
            f"{-hull.draft:g} to {hull.freeboard:g} m"
        )
    normal = np.zeros(3)
    normal[across] = np.sign(face[across])
    return normal, float(half[across])


def _rope(table):
    from hakobune.mooring.lines.ropes import RopePart, rope

    where = f"rope {table.name}"
    load = force(where, table, "breaking_load", required=True)
    main, tail = RopePart(load, table.break_strain, table.exponent), None
    if table.tail_length:
        if table.tail_break_strain is None:
            raise StudyError(f"{where}: tail_break_strain is missing; a tail needs it, above 0")
        own = force(where, table, "tail_breaking_load")
        tail = RopePart(load if own is None else own, table.tail_break_strain, table.tail_exponent)
    return rope(
        table.name, table.bollard, table.fairlead, main, _pretension(where, table), tail=tail,
        tail_length=table.tail_length, hardening=table.hardening,
    )  # fmt: skip


def _pretension(where, table):
    """N, 0 where none is given"""
    given = table.pretension_kN, table.pretension_tonf
    return 0.0 if given in ((0.0, None), (None, 0.0)) else force(where, table, "pretension") or 0.0


class HingeTable(Table):
    """A hinge, ball joint, slider or rigid link between two bodies, without play

    name : name of the hinge in results
    bodies : names of the two bodies; one of them may be fixed, or "space"; a single body is called "body"
    position : m, x, y, z in the coordinates of the first body, or of the scene where the first is "space"
    axis : axis of rotation of a hinge or of motion of a slider, in the axes of the first body
    kind : "hinge", rotation about its axis; "ball", rotation about all axes; "rigid", no rotation; or "slider", motion
        along its axis without rotation
    damping : linear damping, kN s/m along a slider's axis, kN m s about a hinge's axis
    stiffness : spring stiffness, kN/m along a slider's axis, kN m/rad about a hinge's axis
    rest : travel from the given positions at which the spring is unloaded, m for a slider, ° for a hinge
    """

    name: str
    bodies: tuple[str, str]
    position: tuple[float, float, float]
    axis: tuple[float, float, float] = (0.0, 1.0, 0.0)
    kind: str = "hinge"
    damping: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0

    def link(self, where, db):
        """`bem.hinges.Link`.  Raises StudyError."""
        known = [*(body.name for body in db.bodies), SPACE] if db.bodies else [ALONE, SPACE]
        moves = [body.name for body in db.bodies if not body.fixed] or [ALONE]
        wrong = [name for name in self.bodies if name not in known]
        if wrong or self.bodies[0] == self.bodies[1] or not set(self.bodies) & set(moves):
            given = wrong[:1] or list(self.bodies)
            raise StudyError(
                f"{where}.bodies has {' and '.join(map(repr, given))}; allowed: two different names of "
                f"{', '.join(known)}, at least one of a body that moves"
            )
        if self.kind not in KINDS:
            raise StudyError(f"{where}.kind is {self.kind!r}; allowed: {', '.join(KINDS)}")
        if not all(map(math.isfinite, (*self.position, *self.axis))) or not any(self.axis):
            raise StudyError(
                f"{where} has position {self.position} and axis {self.axis}; allowed: finite, with an axis other than 0"
            )
        for name in ("damping", "stiffness"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0) or (value and self.kind not in DRIVEN):
                raise StudyError(
                    f"{where}.{name} is {value:g} for a {self.kind}; allowed: 0 or more for a "
                    f"{' or '.join(DRIVEN)}; leave it out for other joints"
                )
        if not math.isfinite(self.rest) or (self.rest and not self.stiffness):
            raise StudyError(
                f"{where}.rest is {self.rest:g} with stiffness {self.stiffness:g}; allowed: a finite rest, and a "
                f"stiffness above 0 with it"
            )
        rest = math.radians(self.rest) if self.kind == "hinge" else self.rest
        drive = 1e3 * self.damping, 1e3 * self.stiffness, rest
        return Link(self.name, self.bodies, self.position, self.axis, self.kind, *drive)


class StationTable(Table):
    """Sections of a flexible beam, for deflection, bending moment, shear and torsion

    x : m, places of the sections along the body
    body : name of the body, where there are several
    """

    x: list[float]
    body: str = ""

    def stations(self, where, db):
        """[`mooring.response.points.Station`].  Raises StudyError."""
        from hakobune.bem.flexible.beams import Beam
        from hakobune.mooring.response.points import Station

        known = [body.name for body in db.bodies]
        if self.body not in (known or [""]):
            raise StudyError(
                f"{where}.body is {self.body!r}; allowed: {', '.join(known) or 'no key body, since there is one body'}"
            )
        owner = known.index(self.body) if known else 0
        beams = [m.shape for m in db.modes if m.body == owner and isinstance(m.shape, Beam)]
        if not beams:
            raise StudyError(
                f"{where} is given, but {self.body or 'the body'} is not a beam; solve its scene with [[modes]], or "
                "leave the stations out"
            )
        outside = [x for x in self.x if not beams[0].start <= x <= beams[0].end]
        if outside:
            raise StudyError(f"{where}.x has {outside[0]:g}; allowed: {beams[0].start:g} to {beams[0].end:g}, the beam")
        return [Station(f"{self.body} x {x:g}".strip(), x, self.body) for x in self.x]


def linked(body, hinges, db):
    """A Reader of a database's bodies with hinges (HingeTables) between them. Raises StudyError."""
    links = [one.link(f"hinges[{i}]", db) for i, one in enumerate(hinges)]
    names = [one.name for one in links]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise StudyError(f"two hinges are called {twice!r}; give each a name of its own")
    try:
        return body.linked(links) if links else body
    except ValueError as error:
        raise StudyError(str(error)) from None
