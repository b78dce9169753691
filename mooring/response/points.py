"""Responses at a point of a body: displacement, velocity, acceleration, and the water below the point.

    d = X₁₋₃ + X₄₋₆ × (p − p₀),    v = −iωd,    a = −ω²d,    r = ζ − d_z
    f_x = a_x − gX₅,    f_y = a_y + gX₄,    u = h + tide + p_z − sinkage + d_z

ζ contains the incident wave and, if the database has Kochin functions, the scattered and radiated waves
(`bem.wave_field.around`), except local waves within a depth or a wave length of the hull. Beside a wall at y = w,
without Kochin functions, ζ contains the incident wave and its reflection, exp(2ikw sinβ) times the wave towards −β.
A point inside the hull, the convex hull of its waterline in plan, has the elevation at the nearest waterline point.

All values are per unit wave amplitude, in axes that do not turn with the body; a contains no gravity. f is the
acceleration felt by cargo or an accelerometer along the deck, including the part of gravity due to roll and pitch. u
is the water under a point of the bottom; over a plan area u is least at a corner of its convex hull, since d_z is
linear in x and y. r is the height of the water above the still waterline on the body. At a wall that reflects short
waves, ζ is doubled.

With several bodies each point belongs to one body and is given in its coordinates. There is no ζ, since the far
field does not describe the water between hulls. A `Pair` is the displacement of its second point relative to its
first point, along the axes of the first point's body.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.flexible.beams import Beam
from hakobune.bem.hinges import of_shapes, told_of, travel_of
from hakobune.bem.waves import wavenumber

from ..on_current.body import carrier_of_body

FLAT = 0.05  # depth differences below this fraction of the draft belong to the bottom
MOST = 12


class Point(NamedTuple):
    """name; position : at rest, (3,) m; clearance : height above still water of the part to be kept dry, m, or None

    body : name of the body in whose coordinates the point is given, where there are several bodies
    """

    name: str
    position: tuple[float, float, float]
    clearance: float | None = None
    body: str = ""


class Pair(NamedTuple):
    """name; points : two Points of two bodies, such as the ends of a gangway or of a hose between manifolds"""

    name: str
    points: tuple[Point, Point]


class KeelPoint(NamedTuple):
    """name; position : point of the body's bottom at rest, (3,) m; gap : water under the point at rest, m; body : as
    in Point
    """

    name: str
    position: tuple[float, float, float]
    gap: float
    body: str = ""


class Station(NamedTuple):
    """name; x : position of a section of a flexible body's beam, m; body : as in Point"""

    name: str
    x: float
    body: str = ""


class Transfer(NamedTuple):
    """Transfer functions per m of wave amplitude.

    names, units : (c,); omega : (q,) rad/s; heading : (p,) rad; value : (q, p, c) complex
    missed : fraction of the far field that is missing in the waves at points; None for incident waves alone
    met : frequencies at which a body on a current meets these waves, (q, p) rad/s, None in still water
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    omega: np.ndarray
    heading: np.ndarray
    value: np.ndarray
    missed: float | None = None
    met: np.ndarray | None = None


def transfer_functions(body, omega, heading, points=(), water=True) -> Transfer:
    """All responses of one or several bodies: first the motions, then those of points, stations, pairs and links.

    For every Point: displacement, velocity and acceleration along x, y, z; acceleration along the deck with gravity;
    for a single body also the relative elevation of the water. For every KeelPoint: its vertical displacement. For
    every Station: deflection and loads of the beam. For every Pair: displacement and velocity. For every link: force
    and moment of its first body on the second, in axes of the first.

    omega : (q,) rad/s; heading : (p,) rad; water : whether to compute the elevation, the most expensive part
    raises : BetweenError outside the database
    """
    heading = np.atleast_1d(heading)
    motion = body.motions(omega, heading)
    met = None if carrier_of_body(body) is None else body.encounter(omega, heading)
    omega, given = omega if met is None else met, np.asarray(omega, float)
    dry = [point.position[:2] for point in points if water and isinstance(point, Point) and not body.bodies]
    raised, missed = elevations(body, given, heading, motion, dry)
    levels = iter(np.moveaxis(raised, -1, 0))
    columns = [(word, ("m", "rad")[int(turns)], motion[..., i])
               for i, (word, turns) in enumerate(zip(body.words, body.turning, strict=True))]  # fmt: skip
    for point in points:
        columns += _OF[type(point)](body, omega, motion, point)
        if dry and isinstance(point, Point):
            columns.append((relative_name(point), "m", next(levels) - of_point(body, motion, point)[0][..., 2]))
    columns += _of_links(body, given, heading, motion)
    names, units, values = zip(*columns, strict=True)
    return Transfer(names, units, given, heading, np.stack(values, axis=-1), missed, met)


def _along(words, unit, value, axes="xyz"):
    """[(name, unit, (q, p))] of a vector (q, p, 3)"""
    return [(f"{words} {axis}", unit, value[..., i]) for i, axis in enumerate(axes)]


def _of_pair(body, omega, motion, pair):
    d = apart(body, motion, *pair.points)
    named = f"{pair.name} relative"
    return _along(f"{named} displacement", "m", d) + _along(f"{named} velocity", "m/s", velocity(omega, d))


def _of_station(body, omega, motion, station):
    return [(f"{station.name} {word}", unit, part) for word, unit, part in of_station(body, motion, station)]


def _of_keel(body, omega, motion, point):
    return [(keel_name(point), "m", of_point(body, motion, point)[0][..., 2])]


def _of_deck(body, omega, motion, point):
    d, own = of_point(body, motion, point)
    felt = felt_acceleration(omega, d, own, body.gravity)
    return [
        *_along(f"{point.name} displacement", "m", d),
        *_along(f"{point.name} velocity", "m/s", velocity(omega, d)),
        *_along(f"{point.name} acceleration", "m/s²", acceleration(omega, d)),
        *_along(f"{point.name} felt acceleration", "m/s²", felt, "xy"),
    ]


_OF = {Point: _of_deck, KeelPoint: _of_keel, Station: _of_station, Pair: _of_pair}


def _of_links(body, omega, heading, motion):
    """Forces and moments that links hold, and their travels"""
    if not body.links:
        return []
    travels = np.stack([motion @ travel_of(body, link) for link in body.links], axis=-1)[..., None]
    held = np.concatenate([body.link_forces(omega, heading, motion), travels], axis=-1)
    held = held.reshape(*motion.shape[:2], -1)
    return [(name, unit, held[..., column]) for name, unit, column in told_of(body.links)]


def relative_name(point):
    """Name of the relative elevation of the water at a Point"""
    return f"{point.name} relative elevation"


def keel_name(point):
    """Name of the vertical displacement of a KeelPoint"""
    return f"{point.name} displacement z"


def of_point(body, motion, point):
    """Displacement (q, p, 3) of a Point or KeelPoint, and the motions (q, p, 6) of its body, along the body's axes

    body : `bem.database.reader.Reader`; motion : all its motions, (q, p, n).
    For a flexible body both results include the shapes, and the rotations are those at the point.
    """
    one = None
    if body.bodies:
        one = body.body_named(point.body)
        own, center = body.motions_of(motion, one), one.own_center
    else:
        own, center = motion[..., :6], body.rotation_center
    moved = displacement(own, point.position, center)
    if body.modes:
        shifts, turns = of_shapes(body, one, np.asarray(point.position, float))
        amplitude = motion[..., body.rigid :]
        moved, own = moved + amplitude @ shifts.T, own + amplitude @ np.vstack([np.zeros_like(turns), turns]).T
    return moved, own


def shapes_of(body, motion, name=""):
    """[(`bem.modes.Mode`, its amplitudes (q, p))] of one body of a `Reader`; motion : (q, p, n) of all bodies"""
    owner = [one.name for one in body.bodies].index(name) if body.bodies else 0
    return [(mode, motion[..., d]) for d, mode in enumerate(body.modes, body.rigid) if owner in mode.moves]


def of_station(body, motion, station):
    """[(word, unit, (q, p))] of a Station: deflection and twist of the beam alone, EI w″, EI w‴ and GJ θ′"""
    made = {}
    for mode, amplitude in shapes_of(body, motion, station.body):
        if not isinstance(mode.shape, Beam):
            continue
        if mode.turns:
            parts = ("twist", "rad"), ("torsional moment", "N m")
        else:
            kind = mode.shape.kind.partition(" ")[0]
            parts = (f"{kind} deflection", "m"), (f"{kind} bending moment", "N m"), (f"{kind} shear force", "N")
        for key, unit in zip(parts, (mode.shape.along(station.x), *mode.shape.loads(station.x)), strict=True):
            made[key] = made.get(key, 0.0) + amplitude * unit
    return [(*key, value) for key, value in made.items()]


def middles(body):
    """`Station` in the middle of every beam of a `Reader`"""
    beams = {mode.body: mode.shape for mode in body.modes if isinstance(mode.shape, Beam)}
    names = {number: body.bodies[number].name if body.bodies else "" for number in beams}
    places = {number: 0.5 * (beam.start + beam.end) for number, beam in beams.items()}
    return [Station(f"{names[number]} x {x:g}".strip(), x, names[number]) for number, x in places.items()]


def apart(body, motion, first, second):
    """Displacement of the point `second` relative to `first`, a point of another body, in axes of first's body;
    shape (q, p, 3)
    """
    here, there = (of_point(body, motion, point)[0] for point in (first, second))
    turn = body.body_named(first.body).axes.T @ body.body_named(second.body).axes
    return there @ turn.T - here


def displacement(motion, position, rotation_center):
    """Displacement of the point at `position` (3,), m, from motions (q, p, 6) about `rotation_center`; shape (q, p,
    3)."""
    arm = np.asarray(position, float) - np.asarray(rotation_center, float)
    return motion[..., :3] + np.cross(motion[..., 3:], arm)


def velocity(omega, displaced):
    """Velocity per metre of wave amplitude, m/s; shape (q, p, …)"""
    return -1j * _column(omega, displaced) * displaced


def acceleration(omega, displaced):
    """Acceleration per metre of wave amplitude, m/s²; shape (q, p, …)"""
    return -(_column(omega, displaced) ** 2) * displaced


def felt_acceleration(omega, displaced, motion, gravity):
    """Acceleration felt along x and y of the deck, with gravity, m/s² per metre of wave amplitude; shape (q, p, 2).

    displaced : (q, p, 3); motion : (q, p, 6)
    """
    turned = gravity * np.stack([-motion[..., 4], motion[..., 3]], axis=-1)
    return acceleration(omega, displaced)[..., :2] + turned


def elevations(body, omega, heading, motion, places):
    """Elevation ζ (q, p, n) of the water at places (n, 2) m, per unit amplitude at the origin, and `Transfer.missed`.

    omega : (q,) rad/s; heading : (p,) rad; motion : (q, p, 6) of the body, a `bem.database.reader.Reader`
    raises : BetweenError outside the database
    """
    from hakobune.bem.wave_field.around import at_waterline, beside_incident

    places = np.asarray(places, float).reshape(-1, 2)
    if body.mesh is not None:
        places = at_waterline(body.mesh, places)
    k = wavenumber(np.asarray(omega, float), body.depth, body.gravity)
    incident = _plane_waves(k, heading, places)
    if body.between.wall is not None:
        ahead = np.exp(2j * body.between.wall * np.outer(k, np.sin(heading)))
        incident += ahead[..., None] * _plane_waves(k, -np.asarray(heading), places)
    if body.mesh is None or not body.rebuilds_drift or not len(places):
        return incident, None
    added, missed = beside_incident(body, omega, heading, motion, places)
    return incident + added, missed


def _plane_waves(k, heading, places):
    """exp(ik(x cosβ + y sinβ)) (q, p, n)"""
    towards = np.stack([np.cos(heading), np.sin(heading)], axis=1)
    return np.exp(1j * k[:, None, None] * (towards @ places.T))


def _column(omega, values):
    return np.reshape(omega, np.shape(omega) + (1,) * (np.ndim(values) - np.ndim(omega)))


def corners_of_bottom(points):
    """Corners, m, shape (n, 3), at most 12, of the convex hull in plan of the deepest part of a body with points (p,
    3).

    The vertical displacement of a rigid body is linear in x and y, so it is largest at one of these corners.
    """
    points = np.asarray(points, float)
    draft = -points[:, 2].min()
    bottom = points[points[:, 2] <= -(1 - FLAT) * draft]
    corners = _turning_left(np.unique(np.round(bottom, 6), axis=0))
    if len(corners) > MOST:  # round in plan
        corners = corners[np.unique(np.linspace(0, len(corners), MOST, endpoint=False).astype(int))]
    return corners


def _turning_left(points):
    """Corners of the convex hull in plan (Andrew's monotone chain), the deepest point at each place"""
    order = np.lexsort((points[:, 2], points[:, 1], points[:, 0]))
    points = points[order]
    points = points[np.concatenate([[True], np.any(np.diff(points[:, :2], axis=0) != 0, axis=1)])]
    if len(points) < 3:
        return points
    chains = [_chain(points), _chain(points[::-1])]
    return np.concatenate([chain[:-1] for chain in chains])


def _chain(points):
    chain = []
    for point in points:
        while len(chain) > 1:
            a, b = chain[-1][:2] - chain[-2][:2], point[:2] - chain[-2][:2]
            if a[0] * b[1] - a[1] * b[0] > 1e-6:
                break
            chain.pop()
        chain.append(point)
    return np.array(chain)
