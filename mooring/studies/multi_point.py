"""Multi-point mooring by the simplified method of the SR179 report (1982), section 5.1.1.

Natural periods come first: the method is not on the safe side where one of them lies near the wave period.
Then steady forces of wind, current and wave drift, the position and heel in which lines and water balance them (of the
body trimmed at rest, so that the weight of the lines there heels nothing), and there the largest motions of the freely
floating body: in irregular waves, or by the report's regular wave of significant height (`wave_effects`).  All modes
are taken in phase, with the signs, per line, that pull the fairlead outward and up; statics give the tension.
The body is small-angled throughout: loads and motions are those of its heading at rest.
Motions of slow drift are not in the method.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.natural_periods import NaturalPeriods, natural_periods

from ..lines.system.equilibrium import SystemEquilibrium, held_at, rest
from ..lines.system.graph import LineForces, System
from ..lines.system.parts import Anchor, Fairlead
from .conditions import Conditions
from .multi_point_findings import HORIZONTAL, findings
from .places import check_places, place_findings
from .steady_loads import steady_loads, with_coefficients
from .wave_effects import WaveEffects, wave_effects

PLANE = [0, 1, 5]


@dataclass(frozen=True)
class MultiPoint:
    """Result of a study; per-line arrays follow the lines of the system.

    at_rest, at_equilibrium : natural periods without and with the steady forces
    loads : {"wind", "current", "drift": (6,)} N, N m about the rotation centre
    rest, equilibrium : SystemEquilibrium without and with the steady forces; extreme : lines at their largest
    waves : {method: `WaveEffects`}, that of the conditions and the other where it is possible; empty without waves
    amplitudes : (6,) m, rad; outward, upward : (n,) m, largest displacement of each fairlead, by `motion_factor` times
        the amplitudes
    warnings : what a reader has to know, a line each; of what fails as `criteria.failing.fails` marks it
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

    def __repr__(self):
        worst = int(np.argmax(self.tension))
        return (
            f"<MultiPoint {len(self.system.lines)} lines, largest tension {self.tension[worst]:.4g} N "
            f"in {self.system.line_names[worst]}, {self.utilisation.max():.3g} of breaking load>"
        )

    @cached_property
    def steady_force(self):
        """(6,) N, N m, sum of the steady loads"""
        return sum(self.loads.values(), np.zeros(6))

    @cached_property
    def displacement(self):
        """(3,) m, m, rad: surge, sway and yaw of the body under the steady forces"""
        return (self.equilibrium.position - self.rest.position)[0, PLANE]

    @cached_property
    def heel(self):
        """(2,) rad: roll and pitch of the body under the steady forces"""
        return (self.equilibrium.position - self.rest.position)[0, 3:5]

    @cached_property
    def tension(self):
        """(n,) N, largest at each fairlead"""
        return self.extreme.tension_b

    @property
    def utilisation(self):
        """(n,) largest tension over breaking load; infinite beyond reach, nan where no breaking load is given"""
        return self.extreme.utilisation


def multi_point(db, system, hull, conditions, allowable=0.4) -> MultiPoint:
    """Study of a body, its stored wave database `db`, and its lines.

    system : of one body whose axes have their origin at the rotation centre of `db`, and of lines from anchors to it,
        as `lines.system.moored_body` makes one; allowable : fraction of the breaking load
    raises : ValueError naming what does not fit or has no solution
    """
    _check(db, system, hull, allowable)
    conditions = with_coefficients(conditions, hull, system.depth)
    body = system.bodies[0].name
    at_rest = rest(held_at(system, {body: system.bodies[0].position}))
    periods_at_rest = natural_periods(db.reader.restrained(stiffness=at_rest.stiffness))
    waves = wave_effects(db, conditions) if conditions.waves else {}
    effects = waves.get(conditions.method, WaveEffects(None, np.zeros(6)))
    loads = steady_loads(db, hull, conditions, system.depth, effects.drift)
    equilibrium = _heeled(system, at_rest, db.hydrostatic_stiffness, sum(loads.values(), np.zeros(6)))
    outward, upward = fairlead_displacements(equilibrium, conditions.motion_factor * effects.amplitudes)
    anchors, fairleads = line_ends(equilibrium)
    moved = fairleads + np.column_stack([outward[:, None] * outward_directions(equilibrium), upward])
    result = MultiPoint(
        system,
        conditions,
        allowable,
        periods_at_rest,
        natural_periods(db.reader.restrained(stiffness=equilibrium.stiffness)),
        loads,
        waves,
        at_rest,
        equilibrium,
        effects.amplitudes,
        outward,
        upward,
        system.forces_between(anchors, moved),
        (),
    )
    return replace(result, warnings=(*place_findings(system, hull), *findings(result, db)))


def _heeled(system, at_rest, hydrostatic, load):
    """SystemEquilibrium of a body that floats, under a load (6,); its stiffness is that of the lines alone.

    What the lines pull down and heel at rest, which its ballast is for, is taken off.
    """
    (body,), trim = system.bodies, np.array([0, 0, 1, 1, 1, 0])
    balanced = load - trim * np.asarray(at_rest.force)[:6]
    afloat = replace(body, freedom=DOFS, hydrostatic_stiffness=np.asarray(hydrostatic, float), load=tuple(balanced))
    found = rest(replace(system, bodies=(afloat,)))
    lines = rest(held_at(system, {body.name: found.position[0]}))
    return replace(found, stiffness=lines.stiffness)


def line_ends(state):
    """Anchors and fairleads of the lines of a SystemEquilibrium, (n, 3) m in space each"""
    ends = state.system.arrays.ends
    return state.points[ends[:, 0]], state.points[ends[:, 1]]


def outward_directions(state):
    """(n, 2) unit vectors from anchor to fairlead; a line above its anchor has no direction and is given +x"""
    anchors, fairleads = line_ends(state)
    away = (fairleads - anchors)[:, :2]
    span = np.hypot(*away.T)[:, None]
    return np.where(span > 0, away / np.where(span > 0, span, 1.0), [1.0, 0.0])


def fairlead_displacements(state, amplitudes):
    """Largest displacement of each fairlead outward along its line and upward, all modes in phase: two (n,) m.

    Σⱼ |Dⱼ| Xⱼ with Dⱼ the displacement per unit of mode j; signs are chosen for each line and direction.
    The sum is an upper bound of the displacement; how far it is above depends on the origin of the body's axes, to
    which the motions refer.
    """
    arm = line_ends(state)[1] - state.pose.place[0]
    turns = np.stack([np.cross(axis, arm) for axis in np.eye(3)])
    shifts = np.broadcast_to(np.eye(3)[:, None, :], (3, *arm.shape))
    modes = np.concatenate([shifts, turns])
    along = np.einsum("jni,ni->jn", modes[..., :2], outward_directions(state))
    return np.abs(along).T @ amplitudes, np.abs(modes[..., 2]).T @ amplitudes


def _check(db, system, hull, allowable):
    for name in ("length", "beam", "draft", "freeboard"):
        if not 0 < getattr(hull, name) < np.inf:
            raise ValueError(f"hull {name} is {getattr(hull, name):g} m; allowed: above 0")
    depth = system.depth
    if np.isfinite(db.water_depth) and not abs(depth - db.water_depth) <= 1e-6 * depth:
        raise ValueError(f"the study is for {depth:g} m of water, its database for {db.water_depth:g} m")
    if not 0 < allowable <= 1:
        raise ValueError(f"allowable fraction is {allowable:g}; allowed: above 0, at most 1")
    if db.inertia_matrix is None or db.hydrostatic_stiffness is None:
        raise ValueError("the database has no inertia of the body; give --gyration kxx,kyy,kzz and solve again")
    _check_body(system, np.asarray(db.rotation_center, float))
    check_places(system, hull)


def _check_body(system, center):
    if len(system.bodies) != 1:
        raise ValueError(f"the system has {len(system.bodies)} bodies; allowed: one")
    body, points = system.bodies[0], {point.name: point for point in system.points}
    if not np.allclose(body.position, [*center, 0, 0, 0], rtol=0, atol=1e-9) or body.freedom != HORIZONTAL:
        raise ValueError(
            f"body {body.name} has its axes at {body.position} and moves in {', '.join(body.freedom) or 'nothing'}; "
            f"allowed: at the rotation centre {center}, unturned, moving in {', '.join(HORIZONTAL)}"
        )
    for line in system.lines:
        if not (isinstance(points[line.a], Anchor) and isinstance(points[line.b], Fairlead)):
            raise ValueError(f"line {line.name} runs from {line.a} to {line.b}; allowed: from an anchor to the body")
