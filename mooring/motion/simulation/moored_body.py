"""A moored body, ready for simulation: everything independent of the weather is prepared once, for all seeds."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.reader import Reader
from hakobune.bem.hinges import driven
from hakobune.bem.viscous import Quadratic

from ...lines.system.equilibrium import rest
from ...response.viscous import in_time, laws_of
from ...studies.conditions import afloat, alone
from ..contacts import (
    at_rest,
    berth_force,
    berth_stiffness,
    no_berth,
    rest_bent,
    rest_together,
    stiffness_together,
    units_of,
    with_shapes,
)
from ..force_tables import TOLERANCE
from ..line_loads import body_lines, but_berth, tables_of
from ..links import links_of
from ..wave_loads import WaveForces, drift_damping, wave_forces
from .bending import check_bending
from .body import in_space, of_each
from .linked import check_held
from .memory import fitted_memory

FLOATS = [2, 3, 4]  # heave, roll, pitch
LOOSE = 1e-5  # fraction of the stiffest motion; smaller restoring counts as none (a period 300 times as long)
CAPSIZED = 1e-6  # fraction of the stiffest motion; smaller negative restoring is rounding


@dataclass(frozen=True, eq=False)
class Moored:
    """One or several bodies on their lines, ready for a run, with n motions: six for each body, then shapes of
    flexible bodies.

    reader : `bem.database.reader.Reader`; system : its `System`, None for bodies without lines
    hull : `ExposedBox` on which wind and current act, for several bodies {name: ExposedBox}, None without wind and
        current
    memory : `bem.time_domain.memory.Memory`
    start : displacements in space from the given positions to the equilibrium at rest, and amplitudes of shapes,
        (n,), m and rad
    spring, damping : linear terms in addition to lines, along body axes, (n, n)
    quadratic : N₂ of drag on each motion, (n,); stiffness : of water, lines and springs at rest, along body axes,
        (n, n)
    slow_added_mass : at the lowest known frequency, (n, n); waves : WaveForces
    tables : tables of lines with segments (`line_loads.tables_of`); findings : one line each
    berth : `contacts.Berth`, fenders and ropes; buoy : `buoy.BuoyOnLines` on hawsers, None for none
    free : numbers of the free motions, by default all
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
    free: tuple[int, ...] = ()

    def __post_init__(self):
        object.__setattr__(self, "free", self.free or tuple(range(len(self.start))))

    @property
    def hulls(self):
        """`studies.conditions.Afloat` of every body, () if there is no hull"""
        if self.hull is None:
            return ()
        if not self.reader.bodies:
            return (alone(self.reader, self.hull),)
        return afloat(self.reader, self.hull)

    @cached_property
    def dynamic_stiffness(self):
        """Complex force per unit motion of the linear body on its lines, at the frequencies of `waves`; shape (q, n,
        n)
        """
        K, omega = self.stiffness - self.reader.stiffness, self.waves.omega
        more = driven(self.reader).damping - self.reader.damping
        body = self.reader.restrained(stiffness=0.5 * (K + K.T), damping=self.damping + more)
        return body.dynamic_stiffness(omega, *body.coefficients(omega))

    @cached_property
    def drift_slopes(self):
        """Wave drift damping of each body in unit waves at the frequencies of `waves`, (q, HEADINGS, 3, 2), if all
        drift is known
        """
        place = self.waves.omega, self.reader.depth, self.reader.gravity
        return [drift_damping(one, *place)[1] for one in self.waves.each[: self.reader.rigid // 6]]

    def __repr__(self):
        lines = 0 if self.system is None else len(self.system.lines)
        return f"<Moored {lines} lines, {self.memory}>"


def moored(
    db, system=None, hull=None, *, memory=None, spring=None, damping=None, quadratic=None, berth=None, waves=None,
    linearised_in=None, motions=None, turned=False,
):  # fmt: skip
    """`Moored` from an open database or `Reader`, a `System` of its bodies with axes at their rotation centres, and
    hulls

    hull : ExposedBox, for several bodies {name: ExposedBox}; the drag of the water is that of box tests where these
        apply
    berth : `contacts.Berth`, fenders and ropes
    waves : WaveForces, memory : a Memory, by default those of the database
    spring, damping : (n, n), SI; quadratic : (n,), N s²/m² …; all in addition to the viscous damping of the
        database's scene. A spring must not couple two bodies
    linearised_in : waves as in `response.viscous.in_time`, for the part of the viscous damping that is not drag, and
        for the drift
    motions : numbers of the free motions, None for all
    turned : as in `wave_loads.wave_forces`
    raises : ValueError with the name of the part that is missing or does not fit
    """
    reader, findings = db if isinstance(db, Reader) else db.bodies_reader, ()
    body, viscous = reader.floating(), in_time(reader, linearised_in, damping, quadratic)
    free = tuple(range(len(body.words))) if motions is None else tuple(motions)
    if body.modes:
        check_bending(body, free)
    if memory is None:
        memory, findings = fitted_memory(body, motions)
    # numbers computed together differ in their last bits from those computed alone; a process that is given the memory
    # has to find those of the one that made it
    body.between.forget()
    spring, damping = np.zeros_like(body.damping) if spring is None else np.asarray(spring, float), viscous.damping
    _check_spring(spring, body)
    findings = (*findings, *_of_viscous(reader, linearised_in))
    start, stiffness, tables, links = np.zeros(len(spring)), body.stiffness + spring, ((), ()), links_of(body)
    if system is not None:
        _check_place(system, body)
        body_lines(system)  # refuses lines that a run does not support
        if links is None:
            start[: body.rigid], held = _rest(system, body, spring)
            stiffness = held if not body.modes else stiffness
        tables = tables_of(system, start)
        findings = (*findings, *_of_tables(system, tables))
    berth = no_berth() if berth is None else berth
    if body.modes:
        berth = with_shapes(berth, body)
    if body.modes and links is None:
        if system is not None or berth.names:
            others = but_berth(system, tables, body, spring)
            start, stiffness = rest_bent(body, berth, others, start, units_of(body), free)
        _check_upright(stiffness, body, free)
    elif links is not None:
        start, stiffness = _rest_together(links, berth, system, tables, body, spring, start)
        check_held(stiffness, body)
        if body.knows_drift_of_each:
            findings = (
                *findings,
                "mean and slow drift of hinged bodies are the stored ones, for motions without hinges",
            )
    else:
        if berth.names:
            start = at_rest(berth, but_berth(system, tables, body, spring), start, units_of(body))
            stiffness = stiffness + berth_stiffness(berth, start)
            findings = (*findings, *_of_loose(stiffness, body, free))
        _check_upright(stiffness, body, free)
    slow = body.held_added_mass(0.0)[0]
    rest_of_it = waves or wave_forces(viscous.body, turned), tables, findings, berth
    return Moored(
        body, system, hull, memory, start, spring, damping, viscous.quadratic, stiffness, slow, *rest_of_it, free=free
    )


def _check_spring(spring, body):
    """Raise ValueError for a spring (n, n) of another number of motions, or between two bodies"""
    if spring.shape != body.inertia.shape:
        raise ValueError(f"spring has the shape {spring.shape}; allowed: {body.inertia.shape}, a row for each motion")
    body_of = np.arange(body.rigid) // 6
    between = np.where(body_of[:, None] != body_of, spring[: body.rigid, : body.rigid], 0.0)
    if between.any():
        i, j = np.unravel_index(np.argmax(np.abs(between)), between.shape)
        raise ValueError(
            f"spring between {body.words[i]} and {body.words[j]} is {between[i, j]:.4g} (SI); allowed: 0; "
            "give a line, a fender, or a hinge with a stiffness there"
        )


def _of_viscous(reader, waves):
    """A finding on the viscous damping of the scene of a Reader"""
    laws = laws_of(reader)
    words = dict(zip(reader.names, reader.words, strict=True))
    drags = [words[dof] for dof, law in laws.items() if isinstance(law, Quadratic)]
    others = [words[dof] for dof in laws if words[dof] not in drags]
    how = [f"of {' and '.join(drags)} as drag"] if drags else []
    law = "not included without waves" if waves is None else "linearised in these waves"
    how += [f"of {' and '.join(others)} {law}"] if others else []
    if how:
        yield (
            f"the viscous damping of the database's scene is included in the run, {', '.join(how)}; damping "
            f"of the study is added to it"
        )


def with_memory(moored):
    """A `Moored` body with the fitted memory of its water.  Raises ValueError if it cannot be fitted."""
    memory, findings = fitted_memory(moored.reader, moored.free)
    return replace(moored, memory=memory, findings=(*moored.findings, *findings))


def _of_tables(system, tables):
    """A finding if a table of a line is coarser than wanted"""
    for i, table in enumerate(tables[0]):
        if table.error > 2 * TOLERANCE:
            name = system.line_names[int(np.flatnonzero(tables[1] == i)[0])]
            off, wanted, where = 100 * table.error, 100 * TOLERANCE, 100 * table.coarse
            yield (
                f"line {name}: the error of its force table is up to {off:.2g} % of the tension, required "
                f"{wanted:g} %, in {where:.2g} % of the chords and heights"
            )


def _rest(system, body, spring):
    """Places at rest from those given, in space, shape (6N,), and stiffness there along the axes of the bodies, shape
    (6N, 6N)

    Bodies that bend are as if they did not.
    """
    own = slice(0, body.rigid), slice(0, body.rigid)
    floating = [
        replace(one, freedom=DOFS, hydrostatic_stiffness=C)
        for one, C in zip(system.bodies, of_each((body.stiffness + spring)[own]), strict=True)
    ]
    state = rest(replace(system, bodies=tuple(floating)))
    start = (state.position - np.array([one.position for one in system.bodies])).ravel()
    start[5::6] -= 2 * np.pi * np.round(start[5::6] / (2 * np.pi))
    stiffness = np.asarray(state.stiffness)[: len(start), : len(start)]
    return start, in_space(stiffness, -body.axes_at_rest[:, 5])


def _rest_together(links, berth, system, tables, body, spring, start):
    """Places at rest of bodies with hinges, shape (n,), and stiffness there, shape (n, n)"""
    headings, others = body.axes_at_rest[:, 5], but_berth(system, tables, body, spring)

    def forces(place):
        return others(place) + (berth_force(berth, place) if berth.names else 0.0)

    try:  # from where hinges hold: lines alone would take the bodies far from each other
        start, held = rest_together(links, forces, start, units_of(body), headings)
    except ValueError:
        if system is None:
            raise
        start[: body.rigid] = _rest(system, body, spring)[0]
        start, held = rest_together(links, forces, start, units_of(body), headings)
    return start, stiffness_together(links, forces, start, held, headings)


def _check_upright(stiffness, body, free):
    """Raise ValueError for a body that capsizes at rest, by its stiffness (n, n) with springs, lines and fenders

    free : numbers of the free motions
    """
    names = [one.name for one in body.bodies if not one.fixed] or ["the body"]
    own = slice(0, body.rigid), slice(0, body.rigid)
    for i, (name, K, M) in enumerate(zip(names, of_each(stiffness[own]), of_each(body.inertia[own]), strict=True)):
        floats = [motion for motion in FLOATS if 6 * i + motion in free]
        if not floats:
            continue
        scale = np.sqrt(np.diag(M)[floats])
        values, ways = np.linalg.eigh((0.5 * (K + K.T))[np.ix_(floats, floats)] / np.outer(scale, scale))
        if values[0] < -CAPSIZED * values[-1]:
            worst = int(np.argmax(np.abs(ways[:, 0])))
            unit = "kN/m" if floats[worst] == 2 else "kN m/rad"
            raise ValueError(
                f"{name} capsizes: its restoring in {DOFS[floats[worst]].lower()}, with springs, lines and fenders, is "
                f"{1e-3 * values[0] * scale[worst] ** 2:.4g} {unit}, limit 0; lower center_of_gravity"
            )


def _of_loose(stiffness, body, free):
    """A finding if ropes and fenders leave a direction without restoring, by a stiffness (n, n) of all at rest"""
    scale = 1 / np.sqrt(np.diag(body.inertia)[list(free)])
    K = (0.5 * (stiffness + stiffness.T))[np.ix_(free, free)] * np.outer(scale, scale)
    values, ways = np.linalg.eigh(K)
    if values[0] < LOOSE * values[-1]:
        worst = body.words[free[int(np.argmax(np.abs(ways[:, 0])))]]
        yield (
            f"{worst} is not held at rest: ropes and fenders leave it free to move there, so the body has several "
            "places of rest; a run begins near the given place; shorten the ropes, or give more of them"
        )


def _check_place(system, body):
    places, wanted = np.array([one.position for one in system.bodies], float), body.axes_at_rest
    if places.shape != wanted.shape or not np.allclose(places, wanted, rtol=0, atol=1e-9):
        raise ValueError(
            f"the axes of the system's bodies lie at {places.tolist()}, m and rad; they have to be at the "
            f"rotation centres of the database, {wanted.tolist()}"
        )
    if np.isfinite(body.depth) and not abs(system.depth - body.depth) <= 1e-6 * system.depth:
        raise ValueError(
            f"the lines are for a depth of {system.depth:g} m, but the database is for {body.depth:g} m; "
            f"allowed: the same depth"
        )
