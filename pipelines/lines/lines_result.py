"""`hakobune.lines`: a system of lines at rest, its stiffness, its forces with a body held at offsets, and its
equilibrium after the loss of each line."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.studies.overloads import overloads

from ..common.bounds import MOST, Pace, check_count, check_seconds, told
from ..common.quantities import StudyError
from ..results.given import File, Tables, database_of
from ..results.heard import heard
from ..results.provenance import provenance
from ..results.result import Result
from .lines_quantities import at_rest, axes_of, curves_at, line_alone, lost, periods_of, stiffness_on
from .system_file import read_given

if TYPE_CHECKING:
    from hakobune.bem.database import Database
    from hakobune.mooring.lines.system.graph import System

FARTHEST = 1e5  # m
MOST_DIRECTIONS = 360
OF_POINTS = 2e-3  # s per square of the number of free points, for systems that converge slowly


def lines(
    system: File | Tables | System,
    *,
    depth: float | None = None,
    body: str | None = None,
    force: Sequence[float] | None = None,
    offset: float | None = None,
    directions: Sequence[float] = (0.0, np.pi / 2),
    characteristic: str | None = None,
    broken: bool = False,
    database: File | Database | None = None,
) -> Result:
    """Equilibrium of a system of lines.

    system : path of a TOML, MoorDyn or MoorPy file, its tables as a dictionary, or a
        `mooring.lines.system.graph.System`; depth : water depth, m, for a MoorDyn or MoorPy file without depth
    body : name of the body that `force` (Fx, Fy in N, Mz in N m) and offsets are for, by default the first
    offset : largest offset to both sides, m; directions : rad
    characteristic : name of a line, for its forces from slack to taut; broken : whether each line is lost in turn
    database : path of the body's database, or an open database, for natural periods
    returns : Result, in SI; its `detail` is the SystemEquilibrium, [OffsetCurve] and {line lost: equilibrium without
        it}
    raises : ValueError, with a message of one line
    """
    asked = {"force": force, "offset": offset, "directions": directions, "characteristic": characteristic}
    asked |= {"broken": broken, "database": database}
    check_asked(offset, directions)
    return lines_of(read_given(system, depth), body=body, **asked)


def check_asked(offset, directions):
    """Raise ValueError for impossible offsets"""
    if offset is not None and not 0 < offset <= FARTHEST:
        raise StudyError(f"--offset is {offset:g} m; allowed: above 0, at most {FARTHEST:g}")
    check_count("--direction", len(directions), most=MOST_DIRECTIONS)


def lines_of(given, *, body, force, offset, directions, characteristic, broken, database):
    """Like `lines`, for a `system_file.Given`"""
    db = None if database is None else database_of(database)
    name = _body(given.system, body, needed=force is not None or offset is not None or db is not None)
    with heard() as first:
        system = given.system if force is None else _loaded(given.system, name, force)
    _check_effort(system, characteristic)
    state, curves, losses, said = _solved(system, name, offset, directions, broken)
    quantities = at_rest(state) | ({} if name is None else stiffness_on(state, name))
    quantities |= curves_at(curves) | (lost(state, losses, name) if broken else {})
    axes = axes_of(state, curves, losses)
    for found, labels in _asked_for(state, name, characteristic, db):
        quantities, axes = quantities | found, axes | labels
    used = {axis for one in quantities.values() for axis in one.axes}
    return Result(
        "lines", quantities, {axis: one for axis, one in axes.items() if axis in used},
        (*said, *_findings(state, curves, losses, name, db), *_unstable(quantities, axes)),
        first=(*given.said, *first), provenance=provenance(given.text, db), detail=(state, curves, losses),
    )  # fmt: skip


def _asked_for(state, name, characteristic, db):
    if characteristic is not None:
        yield line_alone(state, characteristic)
    if db is not None:
        yield periods_of(state, name, db)


def _solved(system, name, offset, directions, broken):
    """SystemEquilibrium, [OffsetCurve], {lost line: equilibrium}, warnings on the state at rest"""
    from hakobune.mooring.lines.system.equilibrium import rest

    with heard() as said:
        state = rest(system)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # reported already for the intact system
        losses = _losses(state) if broken else {}
        return state, [] if offset is None else _curves(state, name, offset, directions), losses, said


def _findings(state, curves, losses, name, db):
    from hakobune.mooring.studies.in_air import lines_in_air
    from hakobune.mooring.studies.places import off_the_mesh

    yield from lines_in_air(state)
    yield from overloads(state, curves, losses)
    if db is not None:
        yield from off_the_mesh(state.system, name, db.mesh)


def _unstable(quantities, axes):
    if "period" in quantities:
        modes = axes["mode"].values[np.isnan(quantities["period"].values)].tolist()
        if modes:
            yield fails(f"the body is unstable on its lines in: {', '.join(modes)}; it needs more restoring")


def _check_effort(system, characteristic):
    """Raise ValueError for too many lines or free points, and report the expected time for many."""
    points, way_out = len(system.free_points), "give fewer lines and points"
    if len(system.lines) > MOST:
        raise StudyError(f"the system has {len(system.lines)} lines; allowed: up to {MOST}")
    if characteristic is not None and characteristic not in system.line_names:
        raise StudyError(f"line {characteristic!r} is unknown; allowed: {', '.join(system.line_names)}")
    what, seconds = f"{points} free points may take", OF_POINTS * points**2
    check_seconds(what, seconds, way_out)
    told(what, seconds)


def _body(system, name, needed):
    """The requested body: by name, or the only or first one."""
    names = [body.name for body in system.bodies]
    if name is not None and name not in names:
        raise StudyError(f"--body is {name!r}; allowed: {', '.join(names) or 'none, the system has no body'}")
    if needed and not names:
        raise StudyError("the system has no body; --force, --offset and --database need a system with one")
    return name if name is not None else names[0] if names else None


def _loaded(system, name, force):
    if len(force) != 3:
        raise StudyError(f"--force has {len(force)} numbers; allowed: 3, Fx and Fy in kN and Mz in kN m")
    from hakobune.mooring.lines.system.parts import MooredBody

    given = next(body for body in system.bodies if body.name == name)
    if not given.freedom:
        warnings.warn(
            f"{name} is held at its position without --force; with --force it moves in surge, sway and yaw",
            stacklevel=2,
        )
        bodies = [replace(body, freedom=MooredBody.freedom) if body is given else body for body in system.bodies]
        system = replace(system, bodies=tuple(bodies))
    load = np.array(given.load, float)
    load[[0, 1, 5]] += np.asarray(force, float)
    return system.with_loads({name: load})


def _curves(state, name, offset, directions):
    from hakobune.mooring.studies.system_at_rest import offset_curve

    offsets = np.linspace(-offset, offset, 21)
    pace = Pace("offset curves take", len(directions) * len(offsets), "give fewer with --direction")
    return [offset_curve(state, name, direction, offsets, pace.step) for direction in directions]


def _losses(state):
    from hakobune.mooring.studies.system_at_rest import one_line_broken

    count = len(state.system.lines)
    return one_line_broken(state, Pace(f"{count} losses of a line take", count, "leave out --broken").step)
