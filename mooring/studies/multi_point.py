"""Multi-point mooring by the simplified method of the SR179 report (1982), section 5.1.1.

Natural periods come first, since the method is not on the safe side if one of them lies near the wave period.
Then follow the steady forces of wind, current and wave drift, and the position and heel in which lines and water
balance these forces. The body is trimmed at rest, so that the weight of the lines causes no heel at rest. In this
position the largest motions of the freely floating body are computed: in irregular waves, or by the report's regular
wave of significant height (`wave_effects`). All modes are assumed in phase, with those signs for each line that pull
its fairlead outward and up; statics give the tension. Angles of the body are assumed small. Loads and motions are
taken at the body's heading at rest. Motions of slow drift are not included.

Several bodies may be held by lines to anchors and to each other. There are six forces and motions for each moving
body, one body after another, one common equilibrium and one set of natural periods.  A line between two bodies is
tightened by the largest motions of both.  Fenders and ropes at a berth or between bodies, and hinges, are included
in the state of rest, the equilibrium and the periods. In waves only hinges change the motions of the free bodies.
Bodies with hinges are not trimmed for the weight of their lines, since the hinges carry a part of it.

For flexible bodies, amplitudes of shapes follow after these motions. Lines, fenders and ropes bend flexible bodies,
and fairleads move with the shapes. Flexible bodies are not trimmed either. Wind, current and drift exert no force on
shapes.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.natural_periods import GIVE_GYRATION, NaturalPeriods, natural_periods
from hakobune.bem.hinges import driven

from ..lines.system.bodies import rotation
from ..lines.system.equilibrium import SystemEquilibrium, held_at, rest
from ..lines.system.graph import LineForces, System
from ..lines.system.parts import Anchor, Fairlead
from ..motion.contacts import (
    berth_stiffness,
    courses,
    no_berth,
    rest_bent,
    rest_between,
    stiffness_together,
    units_of,
    with_shapes,
)
from ..motion.line_loads import but_berth, generalized, tables_of
from ..motion.links import held_by, links_of
from ..motion.tables.groups import moved_by_shapes, with_bent_fairleads
from .conditions import Conditions, afloat, in_motions
from .multi_point_findings import HORIZONTAL, findings
from .places import check_floats, check_places, place_findings
from .steady_loads import steady_loads, with_coefficients
from .wave_effects import WaveEffects, wave_effects

PLANE = [0, 1, 5]


@dataclass(frozen=True)
class MultiPoint:
    """Result of a study; per-line arrays follow the lines of the system.

    at_rest, at_equilibrium : natural periods without and with the steady forces
    loads : {"wind", "current", "drift": (6b,)} N, N m about the rotation centre, six per body along space axes
    rest, equilibrium : SystemEquilibrium without and with the steady forces; extreme : LineForces at the largest
        tensions
    waves : {method: `WaveEffects`}, of the chosen method and of the other one if possible; empty without waves
    amplitudes : amplitudes of all motions, shapes last, (n,), m and rad
    outward, upward : largest displacement of each fairlead under `motion_factor` times the amplitudes, (l,) m
    hulls : `conditions.Afloat` of every body; berth : `motion.contacts.Berth`, or None
    contact : (2, 2, m), deflection or elongation, m, and force, N, of the berth's fenders and ropes, at rest and in
        equilibrium
    held : (3, k, 6), forces, N and N m, of the first body of each of k `hinges` on the second, in axes of the first:
        at rest, in equilibrium, and largest, with `motion_factor` times the effect of motions in waves
    stiffness : (n, n) N/m … in equilibrium of lines, fenders, ropes, hinges and springs, along axes of the motions
    bent : amplitudes of bending shapes at rest and in equilibrium, (2, f)
    warnings : findings, one line each; failures are marked as in `criteria.failing.fails`
    """

    system: System
    conditions: Conditions
    allowable: float
    at_rest: NaturalPeriods
    at_equilibrium: NaturalPeriods
    loads: dict
    waves: dict
    rest: SystemEquilibrium
    equilibrium: SystemEquilibrium
    amplitudes: np.ndarray
    outward: np.ndarray
    upward: np.ndarray
    extreme: LineForces
    warnings: tuple[str, ...]
    hulls: tuple = ()
    berth: object = None
    contact: np.ndarray | None = None
    held: np.ndarray | None = None
    hinges: tuple[str, ...] = ()
    stiffness: np.ndarray | None = None
    bent: np.ndarray | None = None

    def __repr__(self):
        worst = int(np.argmax(self.tension))
        return (
            f"<MultiPoint {len(self.system.lines)} lines, largest tension {self.tension[worst]:.4g} N "
            f"in {self.system.line_names[worst]}, {self.utilisation.max():.3g} of breaking load>"
        )

    @cached_property
    def steady_force(self):
        """Sum of the steady loads, N, N m; shape (n,)"""
        return sum(self.loads.values(), np.zeros(6 * len(self.hulls)))

    @cached_property
    def displacement(self):
        """Displacement of surge, sway and yaw of each body under the steady forces, m, m, rad; shape (3,)"""
        return self._moved[:, PLANE].ravel()

    @cached_property
    def heel(self):
        """Roll and pitch of each body under the steady forces, rad; shape (2,)"""
        return self._moved[:, 3:5].ravel()

    @cached_property
    def _moved(self):
        """Poses of the bodies, moved by their displacements; shape (b, 6)"""
        moved = self.equilibrium.position - self.rest.position
        moved[:, 5] -= 2 * np.pi * np.round(moved[:, 5] / (2 * np.pi))
        return moved

    @cached_property
    def tension(self):
        """Largest tension at each fairlead, N; shape (n,)"""
        return self.extreme.tension_b

    @property
    def utilisation(self):
        """Largest tension over breaking load; shape (n,); infinite beyond reach, nan without a breaking load"""
        return self.extreme.utilisation


def multi_point(db, system, hull, conditions, allowable=0.4, berth=None, body=None) -> MultiPoint:
    """MultiPoint study of one or several bodies, with their stored wave database `db`, on their lines.

    system : System, as made by `lines.system.moored_body`, of bodies with axes at their rotation centres, and lines
    hull : `conditions.ExposedBox`, of several bodies {name: ExposedBox}; allowable : fraction of the breaking load
    berth : `motion.contacts.Berth` of fenders and ropes; body : `Reader` with hinges, by default that of the database
    raises : ValueError, whose message names an inconsistent input or a case without solution
    """
    hulls, body = afloat(db, hull, system.bodies[0].name), db.bodies_reader if body is None else body
    berth = no_berth() if berth is None else berth
    _check(db, system, hulls, allowable)
    _check_held(system, berth, body)
    if not db.bodies:
        conditions = with_coefficients(conditions, hull, system.depth)
    stays = rest(held_at(system, {one.name: one.position for one in system.bodies}))
    hydrostatic = [body.stiffness[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] for i in range(len(hulls))]
    waves = wave_effects(db, conditions, driven(body)) if conditions.waves else {}
    effects = waves.get(conditions.method, WaveEffects(None, np.zeros(len(body.words))))
    loads = _loads(hulls, conditions, system.depth, effects.drift)
    steady, links = sum(loads.values(), np.zeros(6 * len(hulls))), links_of(body)
    bent = np.zeros((2, len(body.modes)))
    if body.modes:
        berth = with_shapes(berth, body)
        given = system, berth, body
        (at_rest, bent[0], *first), (equilibrium, bent[1], *second) = _bent(*given, 0 * steady), _bent(*given, steady)
    elif berth.names or links is not None:
        given = system, stays, berth, links, body.stiffness
        (at_rest, *first), (equilibrium, *second) = _between(*given, 0 * steady), _between(*given, steady)
    else:
        first = second = 0.0, np.zeros((2, 0)), np.zeros((0, 6))
        at_rest, equilibrium = stays, _heeled(system, stays, hydrostatic, steady)
    beside, contact, held = zip(first, second, strict=True)
    if links is not None:
        rises = at_rest.position[:, 2] - [one.position[2] for one in system.bodies]
        check_floats([(one.name, one.box) for one in hulls], rises)
    held_by_all = beside
    if not body.modes:
        states = zip((at_rest, equilibrium), beside, strict=True)
        held_by_all = [in_motions(state.stiffness, hulls) + more for state, more in states]
    periods = [natural_periods(body.restrained(stiffness=one)) for one in held_by_all]
    added = np.zeros(np.shape(held[1])) if effects.held is None else effects.held
    outward, upward = fairlead_displacements(equilibrium, conditions.motion_factor * effects.amplitudes, body)
    anchors, fairleads = line_ends(equilibrium)
    moved = fairleads + np.column_stack([outward[:, None] * outward_directions(equilibrium), upward])
    result = MultiPoint(
        system,
        conditions,
        allowable,
        *periods,
        loads,
        waves,
        at_rest,
        equilibrium,
        effects.amplitudes,
        outward,
        upward,
        system.forces_between(anchors, moved),
        (),
        hulls,
        berth,
        np.array(contact),
        np.array([*held, held[1] + np.copysign(conditions.motion_factor * added, held[1])]),
        tuple(link.name for link in body.links),
        held_by_all[1],
        bent if body.modes else None,
    )
    return replace(result, warnings=(*place_findings(system, hulls), *findings(result, db)))


def _loads(hulls, conditions, depth, drift):
    """`MultiPoint.loads`; drift : (3,) for each of the hulls along its own axes, or None"""
    rows = []
    for i, one in enumerate(hulls):
        own = None if drift is None else drift[3 * i : 3 * i + 3]
        given = with_coefficients(conditions, one.box, depth)
        rows.append(steady_loads(one, one.box, given, depth, own, one.heading))
    if len(rows) == 1:
        return rows[0]
    in_space = [np.kron(np.eye(2), one.axes) for one in hulls]
    return {name: np.concatenate([T @ row[name] for T, row in zip(in_space, rows, strict=True)]) for name in rows[0]}


def _heeled(system, at_rest, hydrostatic, load):
    """SystemEquilibrium of floating bodies under a load (n,); its stiffness is that of the lines alone.

    hydrostatic : (6, 6) of each.  The weight and heel by lines at rest, which ballast compensates, is subtracted.
    """
    count = len(system.bodies)
    trim = np.tile([0, 0, 1, 1, 1, 0], count)
    balanced = (load - trim * np.asarray(at_rest.force)[: 6 * count]).reshape(count, 6)
    floating = [
        replace(body, freedom=DOFS, hydrostatic_stiffness=np.asarray(C, float), load=tuple(own))
        for body, C, own in zip(system.bodies, hydrostatic, balanced, strict=True)
    ]
    found = rest(replace(system, bodies=tuple(floating)))
    lines = rest(held_at(system, {body.name: found.position[i] for i, body in enumerate(system.bodies)}))
    return replace(found, stiffness=lines.stiffness)


def _between(system, stays, berth, links, water, load):
    """SystemEquilibrium of bodies under a load (n,) as `_heeled`, that fenders, ropes and links hold too, its stiffness
    that of the lines; (n, n) stiffness of the others along the axes of the bodies; `MultiPoint.contact` and held, there

    With links no ballast balances the weight of the lines: as in a simulation, the bodies sink and links carry a part.
    """
    count = len(system.bodies)
    trim = 0.0 if links is not None else np.tile([0, 0, 1, 1, 1, 0], count) * np.asarray(stays.force)[: 6 * count]
    balanced = load - trim
    place, mu = rest_between(system, berth, links, water, balanced)
    given = np.array([one.position for one in system.bodies], float)
    poses = given + place.reshape(-1, 6)
    lines = rest(held_at(system, {one.name: pose for one, pose in zip(system.bodies, poses, strict=True)}))
    others, contact, held = np.zeros((6 * count, 6 * count)), np.zeros((2, 0)), np.zeros((0, 6))
    if berth.names:
        others = berth_stiffness(berth, place)
        contact = np.concatenate(courses(berth, (poses - given * [1, 1, 1, 0, 0, 0])[None]))
    if links is not None:
        others = others + stiffness_together(links, np.zeros_like, place, mu, given[:, 5])
        held = held_by(links, poses - given * [1, 1, 1, 0, 0, 0], mu)
    return lines, others, contact, held


def _bent(system, berth, body, load):
    """SystemEquilibrium of bodies that bend under a load (6b,), amplitudes (f,) of their shapes, (n, n) stiffness of
    lines, fenders and ropes, `MultiPoint.contact` and held, there

    raises : ValueError for hinges, and where there is no balance
    """
    if body.links:
        raise ValueError(
            f"hinges {', '.join(one.name for one in body.links)} are given for a body that bends; allowed: none in a "
            "static study; use hakobune simulate, or solve the scene without [[modes]]"
        )
    count, rigid = len(system.bodies), body.rigid
    given = np.array([one.position for one in system.bodies], float)
    others = but_berth(system, tables_of(system, np.zeros(rigid)), body, np.zeros_like(body.stiffness))

    def forces(place):
        own = np.zeros((count, 6))
        for pose, pull, out in zip(given + place[:rigid].reshape(-1, 6), load.reshape(-1, 6), own, strict=True):
            generalized(pose, *pull, out)
        return others(place) + np.append(own, np.zeros(len(body.modes)))

    place, whole = rest_bent(body, berth, forces, np.zeros(len(body.words)), units_of(body), range(len(body.words)))
    poses, shapes = given + place[:rigid].reshape(-1, 6), place[rigid:]
    at = {one.name: pose for one, pose in zip(system.bodies, poses, strict=True)}
    lines = rest(held_at(with_bent_fairleads(system, body, shapes), at))
    contact = np.zeros((2, 0))
    if berth.names:
        contact = np.concatenate(courses(berth, (poses - given * [1, 1, 1, 0, 0, 0])[None], shapes[None]))
    return lines, shapes, whole - body.stiffness, contact, np.zeros((0, 6))


def line_ends(state):
    """Anchors and fairleads of the lines of a SystemEquilibrium in space, m, each (n, 3)"""
    ends = state.system.arrays.ends
    return state.points[ends[:, 0]], state.points[ends[:, 1]]


def outward_directions(state):
    """Unit vectors from anchor to fairlead; shape (n, 2); a line above its anchor has no direction and uses +x"""
    anchors, fairleads = line_ends(state)
    away = (fairleads - anchors)[:, :2]
    span = np.hypot(*away.T)[:, None]
    return np.where(span > 0, away / np.where(span > 0, span, 1.0), [1.0, 0.0])


def fairlead_displacements(state, amplitudes, reader=None):
    """Largest displacement of each fairlead outward along its line and upward, all modes in phase: two (l,) m.

    amplitudes : (n,), of all bodies; for a line between two bodies the displacements of both ends are added
    reader : `Reader` of flexible bodies.
    The displacement is Σⱼ |Dⱼ| Xⱼ, with Dⱼ the displacement per unit of mode j and signs chosen for each line and
    direction. This sum is an upper bound; its excess depends on the origin of the body's axes, to which the motions
    refer.
    """
    arrays, towards = state.system.arrays, outward_directions(state)
    outward, upward = np.zeros((2, len(towards)))
    for ends in arrays.ends.T:
        for i, body in enumerate(state.system.bodies):
            mine = np.flatnonzero(arrays.owner[ends] == i)
            arm, axes = state.points[ends[mine]] - state.pose.place[i], rotation(0.0, 0.0, body.position[5]).T
            turns = np.stack([np.cross(axis, arm) for axis in axes])
            shifts = np.broadcast_to(axes[:, None, :], (3, *arm.shape))
            modes, X = np.concatenate([shifts, turns]), amplitudes[6 * i : 6 * i + 6]
            along = np.einsum("jni,ni->jn", modes[..., :2], towards[mine])
            outward[mine] += np.abs(along).T @ X
            upward[mine] += np.abs(modes[..., 2]).T @ X
            if reader is not None and reader.modes:
                bent = moved_by_shapes(reader, i, arrays.position[ends[mine]]) @ axes
                size = amplitudes[6 * len(state.system.bodies) :]
                outward[mine] += np.abs(np.einsum("nki,ni->nk", bent[..., :2], towards[mine])) @ size
                upward[mine] += np.abs(bent[..., 2]) @ size
    return outward, upward


def _check(db, system, hulls, allowable):
    for one in hulls:
        for name in ("length", "beam", "draft", "freeboard"):
            if not 0 < getattr(one.box, name) < np.inf:
                raise ValueError(f"hull {name} is {getattr(one.box, name):g} m; allowed: above 0")
    depth = system.depth
    if np.isfinite(db.water_depth) and not abs(depth - db.water_depth) <= 1e-6 * depth:
        raise ValueError(
            f"the study is for {depth:g} m of water, its database for {db.water_depth:g} m; change water.depth, or "
            "solve the body in that depth"
        )
    if not 0 < allowable <= 1:
        raise ValueError(f"allowable fraction is {allowable:g}; allowed: above 0, at most 1")
    if db.inertia_matrix is None or db.hydrostatic_stiffness is None:
        raise ValueError(f"the database has no inertia of the body; {GIVE_GYRATION}")
    _check_bodies(system, hulls)
    check_places(system, hulls)


def _check_held(system, berth, body):
    """Raise ValueError for one of several bodies that no line, fender, rope or hinge holds."""
    held = {*system.arrays.owner[system.arrays.ends].ravel(), *berth.arrays.body, *berth.arrays.other}
    held |= {name for link in body.links for name in link.bodies}
    for i, one in enumerate(system.bodies):
        if not held & {i, one.name}:
            raise ValueError(
                f"{one.name} has 0 lines, fenders, ropes and hinges; allowed: at least 1, since steady forces carry "
                "it away; hold it, or use hakobune simulate"
            )


def _check_bodies(system, hulls):
    names, known = [body.name for body in system.bodies], [one.name for one in hulls]
    if names != known:
        raise ValueError(
            f"the system has bodies {', '.join(names)}; allowed: those of the database, {', '.join(known)}"
        )
    for body, one in zip(system.bodies, hulls, strict=True):
        if not np.allclose(body.position, one.position, rtol=0, atol=1e-9) or body.freedom != HORIZONTAL:
            turned = f"turned by {one.heading:.4g} rad" if one.heading else "unturned"
            raise ValueError(
                f"body {body.name} has its axes at {body.position} and moves in "
                f"{', '.join(body.freedom) or 'nothing'}; allowed: axes at the rotation centre "
                f"{one.position[:3]}, {turned}, and motions in {', '.join(HORIZONTAL)}"
            )
    points = {point.name: point for point in system.points}
    for line in system.lines:
        a, b = points[line.a], points[line.b]
        between = isinstance(a, Fairlead) and isinstance(b, Fairlead)
        if between and a.body == b.body:
            raise ValueError(f"line {line.name} runs from {a.body} to itself; allowed: to an anchor or another body")
        if not (isinstance(b, Fairlead) and (isinstance(a, Anchor) or between)):
            raise ValueError(f"line {line.name} runs from {line.a} to {line.b}; allowed: from an anchor to the body")
