"""A moored body, ready to be moved: what does not depend on the weather is prepared once, for every seed."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.reader import Reader
from hakobune.bem.viscous import Quadratic

from ...lines.system.equilibrium import rest
from ...response.viscous import in_time, laws_of
from ..contacts import at_rest, berth_stiffness, no_berth
from ..force_tables import TOLERANCE
from ..line_loads import body_lines, line_loads, line_work, tables_of
from ..wave_loads import WaveForces, wave_forces
from .memory import fitted_memory

CAPSIZED = 1e-6  # of the stiffest motion, below which a negative restoring is rounding


@dataclass(frozen=True, eq=False)
class Moored:
    """A body on its lines, ready to be moved.

    reader : `bem.database.reader.Reader`; system : its `System`, None for a body without lines
    hull : `ExposedBox` that wind and current act on, None for none; memory : `bem.time_domain.memory.Memory`
    start : (6,) m, rad of the equilibrium at rest from the place given; spring, damping : (6, 6) linear, beside lines
    quadratic : (6,) N₂ of drag on each motion; stiffness : (6, 6) of water, lines and springs at rest
    slow_added_mass : (6, 6) of the lowest frequency known; waves : WaveForces
    tables : of lines with segments (`line_loads.tables_of`); findings : what a reader has to know, one line each
    berth : `contacts.Berth`, fenders and ropes; buoy : `buoy.BuoyOnLines` on hawsers, None for none
    free : motions that are not held, numbers 0 to 5
    """

    reader: object
    system: object
    hull: object
    memory: object
    start: np.ndarray
    spring: np.ndarray
    damping: np.ndarray
    quadratic: np.ndarray
    stiffness: np.ndarray
    slow_added_mass: np.ndarray
    waves: WaveForces
    tables: tuple
    findings: tuple[str, ...] = ()
    berth: object = field(default_factory=no_berth)
    buoy: object = None
    free: tuple[int, ...] = tuple(range(6))

    @cached_property
    def dynamic_stiffness(self):
        """(q, 6, 6) complex force per motion of the linear body on its lines, at the frequencies of `waves`"""
        K, omega = self.stiffness - self.reader.stiffness, self.waves.omega
        body = self.reader.restrained(stiffness=0.5 * (K + K.T), damping=self.damping)
        return body.dynamic_stiffness(omega, *body.coefficients(omega))

    def __repr__(self):
        lines = 0 if self.system is None else len(self.system.lines)
        return f"<Moored {lines} lines, {self.memory}>"


def moored(
    db, system=None, hull=None, *, memory=None, spring=None, damping=None, quadratic=None, berth=None, waves=None,
    linearised_in=None,
):  # fmt: skip
    """`Moored` of an opened database or `Reader`, a `System` of one body, its axes at the rotation centre, and its hull

    hull : ExposedBox; the drag of the water on it is that of the box tests where they reach
    berth : `contacts.Berth`, fenders and ropes
    waves : WaveForces, memory : a Memory, by default those of the database
    spring, damping : (6, 6) SI; quadratic : (6,) N s²/m² …; both beside the viscous damping of the database's scene
    linearised_in : waves as of `response.viscous.in_time`, for what of that is no drag, and for the drift
    raises : ValueError naming what is missing or does not fit
    """
    reader, findings = db if isinstance(db, Reader) else db.reader, ()
    body, viscous = reader.floating(), in_time(reader, linearised_in, damping, quadratic)
    if memory is None:
        memory, findings = fitted_memory(body)
    spring, damping = np.zeros((6, 6)) if spring is None else np.asarray(spring, float), viscous.damping
    findings = (*findings, *_of_viscous(reader, linearised_in))
    start, stiffness, tables = np.zeros(6), body.stiffness + spring, ((), ())
    if system is not None:
        _check_place(system, body)
        start, stiffness = _rest(system, body.stiffness, spring)
        tables = tables_of(system, start)
        findings = (*findings, *_of_tables(system, tables))
    berth = no_berth() if berth is None else berth
    if berth.names:
        start = _rest_at_berth(berth, system, tables, body, spring, start)
        stiffness = stiffness + berth_stiffness(berth, start)
    _check_upright(stiffness, body.inertia)
    slow = body.held_added_mass(0.0)[0]
    rest_of_it = waves or wave_forces(viscous.body), tables, findings, berth
    return Moored(body, system, hull, memory, start, spring, damping, viscous.quadratic, stiffness, slow, *rest_of_it)


def _of_viscous(reader, waves):
    """A finding on the viscous damping of the scene of a Reader"""
    laws = laws_of(reader)
    drags = [dof.lower() for dof, law in laws.items() if isinstance(law, Quadratic)]
    others = [dof.lower() for dof in laws if dof.lower() not in drags]
    how = [f"of {' and '.join(drags)} as drag"] if drags else []
    how += [f"of {' and '.join(others)} " + ("left out without waves" if waves is None else "linearised in these waves")
            ] if others else []  # fmt: skip
    if how:
        yield f"the viscous damping of the database's scene is in the run, {', '.join(how)}; what the study gives adds"


def with_memory(moored):
    """A `Moored` body with the memory of its water fitted.  Raises ValueError where that is not to be had."""
    memory, findings = fitted_memory(moored.reader)
    return replace(moored, memory=memory, findings=(*moored.findings, *findings))


def _of_tables(system, tables):
    """A finding where a table of a line is coarser than wanted"""
    for i, table in enumerate(tables[0]):
        if table.error > 2 * TOLERANCE:
            name = system.line_names[int(np.flatnonzero(tables[1] == i)[0])]
            off, wanted, where = 100 * table.error, 100 * TOLERANCE, 100 * table.coarse
            yield (
                f"line {name}: its table of forces is up to {off:.2g} % of the tension off, wanted {wanted:g} %, in "
                f"{where:.2g} % of the chords and heights"
            )


def _rest(system, hydrostatic, spring):
    """(6,) place at rest from that given, and (6, 6) stiffness there"""
    body = replace(system.bodies[0], freedom=DOFS, hydrostatic_stiffness=hydrostatic + spring)
    state = rest(replace(system, bodies=(body,)))
    return (state.position - np.array([body.position]))[0], np.asarray(state.stiffness)[:6, :6]


def _rest_at_berth(berth, system, tables, body, spring, start):
    """(6,) place at rest with fenders and ropes beside lines and water"""
    lines, R, out = body_lines(system, (), tables), np.zeros((3, 3)), np.zeros(6)
    work = line_work(lines)

    def others(place):
        line_loads(lines, work, place, R, out)
        return out - (body.stiffness + spring) @ place

    radius = np.sqrt(np.diag(body.inertia)[3:] / body.inertia[0, 0])
    return at_rest(berth, others, start, np.concatenate([np.ones(3), 1 / radius]))


def _check_upright(stiffness, inertia):
    """Raise ValueError for a body that capsizes at rest, by its stiffness (6, 6) with springs, lines and fenders"""
    floats = [2, 3, 4]
    scale = np.sqrt(np.diag(inertia)[floats])
    values, ways = np.linalg.eigh((0.5 * (stiffness + stiffness.T))[np.ix_(floats, floats)] / np.outer(scale, scale))
    if values[0] < -CAPSIZED * values[-1]:
        worst = int(np.argmax(np.abs(ways[:, 0])))
        unit = ("kN/m", "kN m/rad", "kN m/rad")[worst]
        raise ValueError(
            f"the body capsizes: its restoring in {DOFS[floats[worst]].lower()}, with springs, lines and fenders, is "
            f"{1e-3 * values[0] * scale[worst] ** 2:.4g} {unit}, limit 0; lower center_of_gravity"
        )


def _check_place(system, body):
    place, center = np.asarray(system.bodies[0].position[:3]), body.rotation_center
    if not np.allclose(place, center, rtol=0, atol=1e-9):
        raise ValueError(f"the body's axes lie at {place}; allowed: at the rotation centre {center} of the database")
    if np.isfinite(body.depth) and not abs(system.depth - body.depth) <= 1e-6 * system.depth:
        raise ValueError(f"the lines are for {system.depth:g} m of water, the database for {body.depth:g} m")
