"""Fenders and ropes of bodies at a berth or side by side, as values. The module also finds the positions at rest of
bodies between fenders and ropes, or with hinges.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..fenders.fender import Fender, FenderError
from ..fenders.hysteresis import contact_table
from ..lines.system.bodies import places_along, rotation
from ..lines.system.graph import Pose
from .contact_loads import ARM, OFFSET, ROPE, Contacts, contact_loads, contact_work, contacts_along
from .line_loads import generalized
from .links import rows_at, springs_at
from .tables.groups import moved_by_shapes

STEP = np.array([1e-4, 1e-4, 1e-4, 1e-6, 1e-6, 1e-6])  # m, rad, of a difference quotient
SMALL = 1e-9  # of the weight, forces that are rounding
RESTS = 1e-6  # residual over the largest force of a fender or rope
TOGETHER = 1e-12  # m, rad: apart by less is rounding


@dataclass(frozen=True, eq=False)
class QuayFender:
    """fender : fender with its dolphin; face : (3,) m in space; normal : outward normal of the flat side that meets
    the fender, (3,)
    side : distance of this side from the origin of the hull's coordinates, m; friction : μ; shear : stiffness along
        the face, N/m

    The face is given with the bodies at rest, the normal in the body's axes
    """

    name: str
    fender: Fender
    face: np.ndarray
    normal: np.ndarray
    side: float
    friction: float = 0.0
    shear: float = 0.0

    def __post_init__(self):
        if not (self.friction >= 0 and self.shear >= 0) or (self.friction > 0 and self.shear == 0):
            raise FenderError(
                f"fender {self.name}: friction is {self.friction:g} and shear (stiffness along the face before "
                f"sliding) is {self.shear / 1e3:g} kN/m; allowed: both at least 0, and shear above 0 if friction is"
            )


@dataclass(frozen=True, eq=False)
class Berth:
    """fenders : tuple of QuayFender; ropes : tuple of `mooring.lines.ropes.Rope`; arrays : Contacts, fenders first

    heading : headings of the bodies' axes at rest, (N,) rad
    """

    fenders: tuple
    ropes: tuple
    arrays: Contacts
    heading: np.ndarray

    @property
    def names(self):
        """Names of fenders and ropes, in the order of the arrays"""
        return tuple(one.name for one in (*self.fenders, *self.ropes))


def berth_of(fenders, ropes, center, hulls=None, ends=None):
    """`Berth` of a body with its axes at `center` (3,) m.  Raises FenderError for names that are not unique.

    hulls : sequence of `studies.conditions.Afloat` of several moving bodies, in place of the center
    ends : (body, other) of each fender and rope, numbers of the hulls; other is below 0 for a fixed point
    """
    fenders, ropes = tuple(fenders), tuple(ropes)
    at_rest = np.array([[*np.asarray(center, float), 0, 0, 0]] if hulls is None else [one.position for one in hulls])
    own = at_rest[:, :3] if hulls is None else np.array([one.rotation_center for one in hulls])
    ends = np.array([(0, -1)] * len(fenders + ropes) if ends is None else ends, np.int64).reshape(-1, 2)
    turns = [rotation(0.0, 0.0, heading) for heading in at_rest[:, 5]]

    def arm(number, point):
        return turns[number].T @ (np.asarray(point, float) - at_rest[number, :3])

    def far(point, body, other):
        return arm(other, point) if other >= 0 else point - at_rest[body, :3]

    names = [one.name for one in (*fenders, *ropes)]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise FenderError(f"{twice[0]!r} is the name of two fenders or ropes; give each a name of its own")
    numbers = [
        (*far(one.face, b, o), *one.normal, one.side - float(np.dot(one.normal, own[b])), one.friction, one.shear, 0.0)
        for one, (b, o) in zip(fenders, ends, strict=False)
    ]
    numbers += [
        (*far(one.bollard, b, o), *arm(b, one.fairlead), one.length, 0.0, 0.0, 1.0)
        for one, (b, o) in zip(ropes, ends[len(fenders) :], strict=True)
    ]
    table = contact_table([*(one.fender for one in fenders), *(one.pull for one in ropes)])
    body, other = np.ascontiguousarray(ends.T)
    places = np.ascontiguousarray(at_rest[:, :3])
    rigid = np.zeros((2, len(numbers), 0, 3))
    arrays = Contacts(table, np.array(numbers, float).reshape(-1, 10), body, other, places, rigid)
    return Berth(fenders, ropes, arrays, at_rest[:, 5])


def with_shapes(berth, reader):
    """`Berth` for flexible bodies, with the bending shapes of a Reader.

    A fender always meets the point of the flat side that faces it at rest.
    """
    arrays = berth.arrays
    at_rest = np.hstack([arrays.place, np.zeros((len(arrays.place), 2)), berth.heading[:, None]])
    bent = np.zeros((2, len(arrays.body), len(reader.modes), 3))
    for i, (row, b, o) in enumerate(zip(arrays.numbers, arrays.body, arrays.other, strict=True)):
        there = row[:3] + at_rest[b, :3]
        if o >= 0:
            bent[0, i] = moved_by_shapes(reader, o, row[:3])[0]
            there = at_rest[o, :3] + rotation(0.0, 0.0, berth.heading[o]) @ row[:3]
        own = row[ARM : ARM + 3]
        if not row[ROPE]:
            before = rotation(0.0, 0.0, berth.heading[b]).T @ (there - at_rest[b, :3])
            own = before + (row[OFFSET] - own @ before) * own
        bent[1, i] = moved_by_shapes(reader, b, own)[0]
    return replace(berth, arrays=arrays._replace(bent=bent))


def no_berth():
    """`Berth` of a body without fenders and ropes"""
    return berth_of((), (), np.zeros(3))


def berth_force(berth, position):
    """Generalized forces, in heading axes, of fenders at first compression and of ropes; shape (n,)

    position : (n,), displacements of the bodies in space, six for each, and amplitudes of the shapes of flexible
        bodies
    """
    work, rigid = contact_work(berth.arrays), 6 * len(berth.heading)
    poses = np.array(position[:rigid], float).reshape(-1, 6)
    poses[:, 5] += berth.heading
    work.bent[:] = position[rigid:]
    contact_loads(berth.arrays, work, poses, np.zeros((len(poses), 3, 3)), np.zeros(3), np.zeros(3))
    return np.append(work.parts.sum(axis=0).ravel(), work.push.sum(axis=0))


def berth_stiffness(berth, position):
    """−∂force/∂position at a position (n,), along the axes of the bodies; shape (n, n)"""
    count, rigid = len(position), 6 * len(berth.heading)
    out, along = np.empty((count, count)), np.eye(count)
    along[:rigid, :rigid] = places_along(berth.heading)
    for j, h in enumerate(np.append(np.tile(STEP, rigid // 6), np.full(count - rigid, STEP[0]))):
        ahead, behind = position + h * along[:, j], position - h * along[:, j]
        out[:, j] = (berth_force(berth, behind) - berth_force(berth, ahead)) / (2 * h)
    return out


def at_rest(berth, others, start, unit):
    """Position at which fenders, ropes and other forces balance; shape (n,)

    others : function of the position: other forces, (n,) N; unit : (n,), m and rad
    raises : ValueError without a balance
    """
    size = max(np.abs(contact_forces(berth, start)).max(), 1.0)

    def residual(x):
        return (berth_force(berth, x * unit) + others(x * unit)) * unit / size

    found = balanced(residual, np.asarray(start) / unit)
    if not np.abs(found.fun).max() <= RESTS:
        raise ValueError(
            f"no equilibrium of the body between its fenders and ropes was found: {np.abs(found.fun).max():.2g} "
            "of the largest force remains; give ropes that hold it from both sides"
        )
    return found.x * unit


def balanced(residual, start):
    """Position of the smallest residual, as by `scipy.optimize.least_squares`, with equal digits in every run

    method="lm" is not used: where a motion hardly changes the residual, the next position in scipy 1.17 depends on
    uninitialised memory.
    """
    from scipy.optimize import least_squares

    return least_squares(residual, start, method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15)


def rest_together(links, forces, start, unit, headings):
    """Position at which forces and links balance, shape (n,), and forces of the links, shape (r,).

    forces : function of the position (n,) in space: forces without springs of links, along body axes, (n,) N and N m
    unit : (n,), m and rad; headings : at rest, (N,) rad
    raises : ValueError where there is no balance
    """
    given = forces(np.asarray(start)), springs_at(links, *bent_poses_at(start, headings))
    size = max(*(np.abs(part * unit).max() for part in given), 1.0)

    def parts(place):
        poses = bent_poses_at(place, headings)
        G, gap = rows_at(links, *poses)
        F = forces(place) + springs_at(links, *poses)
        mu = np.linalg.lstsq((G * unit).T, -F * unit, rcond=None)[0]
        return F + G.T @ mu, gap, mu

    def residual(x):
        left, gap, _ = parts(x * unit)
        return np.concatenate([left * unit / size, gap])

    x = np.asarray(start) / unit
    if np.abs(residual(x)).max() > TOGETHER:
        found = balanced(residual, x)
        if not np.abs(found.fun).max() <= RESTS:
            raise ValueError(
                f"no equilibrium of the bodies with their hinges was found: {np.abs(found.fun).max():.2g} of "
                "the largest force, or m, remains; check for lines and fenders that pull a hinge apart"
            )
        x = found.x
    return x * unit, parts(x * unit)[2]


def stiffness_together(links, forces, place, mu, headings):
    """Stiffness along body axes of the forces (as in `rest_together`), springs and link forces μ (r,); shape (n, n)"""
    out, along, rigid = np.empty((len(place), len(place))), np.eye(len(place)), 6 * len(headings)
    along[:rigid, :rigid] = places_along(headings)

    def total(at):
        poses = bent_poses_at(at, headings)
        return forces(at) + springs_at(links, *poses) + rows_at(links, *poses)[0].T @ mu

    for j, h in enumerate(np.append(np.tile(STEP, len(headings)), np.full(len(place) - rigid, STEP[0]))):
        out[:, j] = (total(place - h * along[:, j]) - total(place + h * along[:, j])) / (2 * h)
    return out


def units_of(reader):
    """Comparable amplitudes of the motions of a Reader, m or rad; shape (n,): 1 m, or 1 m over the radius of gyration.

    Shapes that rotate have the value of roll
    """
    inertia = np.diag(reader.inertia)[: reader.rigid].reshape(-1, 6)
    radius = np.sqrt(inertia[:, 3:] / inertia[:, :1])
    unit = np.concatenate([np.ones_like(radius), 1 / radius], axis=1).ravel()
    return np.append(unit, [1 / radius[0, 0] if mode.turns else 1.0 for mode in reader.modes])


def rest_bent(body, berth, others, start, unit, free):
    """Positions in space and amplitudes of shapes at rest, shape (n,), and stiffness there along body axes, shape
    (n, n)

    berth : `contacts.Berth`; others : function of the position: forces of lines, water and springs, (n,) N; unit :
        (n,), m and rad
    free : numbers of the free motions, which limits the shapes only: bodies come to rest in all six motions
    raises : ValueError where there is no balance
    """
    moves = np.array([*range(body.rigid), *(i for i in free if i >= body.rigid)])

    def forces(place):
        return others(place) + (berth_force(berth, place) if berth.names else 0.0)

    def at(x):
        place = np.array(start)
        place[moves] = x * unit[moves]
        return place

    size = max(np.abs(forces(start) * unit).max(), SMALL * body.inertia[0, 0] * body.gravity)
    found = balanced(lambda x: (forces(at(x)) * unit)[moves] / size, (start / unit)[moves])
    if not np.abs(found.fun).max() <= RESTS:
        raise ValueError(
            f"no equilibrium of the body that bends was found: {np.abs(found.fun).max():.2g} of the largest force "
            "remains; check for lines that are too tight for its stiffness"
        )
    place = at(found.x)
    along = np.eye(len(place))
    along[: body.rigid, : body.rigid] = places_along(body.axes_at_rest[:, 5])
    steps = np.append(np.tile(STEP, body.rigid // 6), np.full(len(body.modes), STEP[0]))
    pairs = ((place - h * way, place + h * way) for h, way in zip(steps, along.T, strict=True))
    columns = [(forces(behind) - forces(ahead)) for behind, ahead in pairs]
    return place, np.array(columns).T / (2 * steps)


def rest_between(system, berth, links, water, load):
    """Position in space (n,) at which all forces are in equilibrium, and the forces μ (r,) of the links.

    The forces are those of the lines of a `System`, fenders, ropes, links, water and a load.
    links : `links.Links`, or None; water : stiffness along body axes, (n, n); load : in space, (n,)
    raises : ValueError without a balance
    """
    given = np.array([one.position for one in system.bodies], float)
    headings = given[:, 5]
    turn = places_along(headings)

    def forces(place):
        poses = given + place.reshape(-1, 6)
        turns = np.array([rotation(*pose[3:]) for pose in poses])
        pulls = system.load(Pose(poses[:, :3], turns, np.zeros((0, 3)))).force + load
        out = np.zeros((len(poses), 6))
        for pose, pull, own in zip(poses, pulls.reshape(-1, 6), out, strict=True):
            generalized(pose, *pull, own)
        return out.ravel() - water @ (turn.T @ place)

    arms = np.array([np.abs(system.arrays.position[system.arrays.owner == i]).max(initial=1.0)
                     for i in range(len(given))])[:, None]  # fmt: skip
    unit = np.concatenate([np.ones((len(arms), 3)), 1 / np.repeat(arms, 3, axis=1)], axis=1).ravel()
    if links is None:
        return at_rest(berth, forces, np.zeros(len(unit)), unit), np.zeros(0)
    both = (lambda place: forces(place) + berth_force(berth, place)) if berth.names else forces
    return rest_together(links, both, np.zeros(len(unit)), unit, headings)


def poses_at(place, headings):
    """Poses of bodies from displacements in space (n,); shape (N, 6)"""
    poses = np.array(place, float).reshape(-1, 6)
    poses[:, 5] += headings
    return poses


def bent_poses_at(place, headings):
    """Poses of flexible bodies from displacements in space (6N + f,), of which the last f are amplitudes of shapes;
    shape (N, 6)
    """
    rigid = 6 * len(headings)
    return (poses_at(place[:rigid], headings), *([place[rigid:]] if len(place) > rigid else []))


def contact_forces(berth, position):
    """Forces of fenders and ropes with the bodies moved by a displacement (n,), N; shape (m,)"""
    rigid = 6 * len(berth.heading)
    poses = np.array(position[:rigid], float).reshape(1, -1, 6)
    poses[:, :, 5] += berth.heading
    return courses(berth, poses, np.asarray(position[rigid:], float)[None])[1][0]


def courses(berth, positions, bent=None):
    """Deflection or elongation (n, m) m and force (n, m) N along positions (n, N, 6) or (n, 6 N) of the bodies

    bent : amplitudes of the bending shapes, (n, f), None for rigid bodies
    """
    positions = np.ascontiguousarray(np.reshape(positions, (len(positions), -1, 6)))
    depth, force = (np.zeros((len(positions), len(berth.names))) for _ in range(2))
    if not berth.names:
        return depth, force
    room = np.zeros((positions.shape[1], 3, 3)), np.zeros(3), np.zeros(3)
    bent = np.zeros((len(positions), 0)) if bent is None else np.ascontiguousarray(bent)
    contacts_along(berth.arrays, contact_work(berth.arrays), positions, *room, depth, force, bent)
    return depth, force
