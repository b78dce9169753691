"""`hakobune lines`: a system of lines from a file → equilibrium, stiffness, tensions, offsets, loss of each line."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.file import check_place
from hakobune.mooring.criteria.failing import fails

from ..common.bounds import MOST, Pace, check_seconds, told
from ..common.outputs import DATABASE, check_output
from ..common.picture import PLOTS, check_picture
from ..common.quantities import StudyError
from ..common.units import KN
from ..printing.verdict import tell
from .characteristic import percent, show_characteristic
from .loose import check_alone, rests, show_loose, without_lines
from .overloads import overloads
from .system_file import TOML, YAML, read_system

FARTHEST = 1e5  # m
OF_POINTS = 2e-3  # s for the square of the number of free points, where they are hard to bring to rest
SHOWN = 1e-9  # of the largest term, below which a stiffness is rounding
LEAST_ARM = 1e-3  # m, that turns a stiffness of shifts into one of rotations where all of these are rounding


def lines(file, body, force, depth, offset, directions, characteristic, broken, database, output, picture, moordyn):
    """Run the system of a file.

    force : (3,) kN, kN and kN m on the body; offset : m; directions : degrees; characteristic : name of a line
    returns : the exit status
    raises : ValueError, one line
    """
    from hakobune.bem.database import open_database
    from hakobune.mooring.formats.results import is_channels
    from hakobune.mooring.lines.system.equilibrium import rest
    from hakobune.mooring.studies.in_air import lines_in_air

    if picture is not None:
        check_picture(picture, PLOTS)
    if output is not None:
        check_output(output, "a file of channels", is_channels, DATABASE)
    if moordyn is not None:
        check_place(moordyn)
    if offset is not None and not 0 < offset <= FARTHEST:
        raise StudyError(f"--offset is {offset:g} m; allowed: above 0, at most {FARTHEST:g}")
    console = _console()
    alone = without_lines(file)
    if alone is not None:
        asked = {"--body": body, "--force": force, "--offset": offset, "--characteristic": characteristic}
        asked |= {"--broken": broken, "--database": database, "--output": output, "--picture": picture}
        check_alone(file, asked | {"--moordyn": moordyn})
        with _warnings_shown(console):
            found = rests(alone, file, depth)
        show_loose(console, _table("no lines: each by itself, in still water", "part", "state", "A m", "B m"), found)
        return 0
    db = None if database is None else open_database(database)
    with _warnings_shown(console):
        system = read_system(file, depth)
        name = _body(system, body, needed=bool(force) or offset is not None or database is not None)
        exported = None if moordyn is None else _moordyn_file(system, moordyn, file)
        if force:
            system = _loaded(system, name, force)
    _check_effort(system)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        state = rest(system)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # said already of the intact system
        losses = _losses(state) if broken else {}
        curves = [] if offset is None else _curves(state, name, offset, directions)
    written = _write(state, output, picture, curves, losses)
    if exported is not None:
        from hakobune.mooring.formats.moordyn import write_moordyn

        write_moordyn(exported, moordyn)
        written.append(moordyn)
    _show_rest(console, state)
    found = [*(str(warning.message) for warning in said), *lines_in_air(state), *overloads(state, curves, losses)]
    if name is not None:
        _show_stiffness(console, state, name)
    if curves:
        _show_curves(console, name, curves, directions)
    if characteristic is not None:
        _show_line(console, state, characteristic)
    if broken:
        _show_losses(console, state, losses, name)
    if database is not None:
        from hakobune.mooring.studies.places import off_the_mesh

        found += [*off_the_mesh(system, name, db.mesh), *_show_periods(console, state, name, db)]
    status = tell(found, console)
    for path in written:
        console.print(f"written: {path}", highlight=False, soft_wrap=True)
    return status


@contextmanager
def _warnings_shown(console):
    """Prints what is warned of within, each once, also where an error ends it."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            yield
        finally:
            for text in dict.fromkeys(str(warning.message) for warning in said):
                console.print(f"warning: {text}", style="yellow", highlight=False, soft_wrap=True)


def _console():
    from ..printing.console import new_console

    return new_console()


def _check_effort(system):
    """Raise TooMuchError for more lines or free points than can be brought to rest, and say what many may take."""
    points, way_out = len(system.free_points), "give fewer lines and points"
    if len(system.lines) > MOST:
        raise StudyError(f"the system has {len(system.lines)} lines; allowed: up to {MOST}")
    what, seconds = f"{points} free points may take", OF_POINTS * points**2
    check_seconds(what, seconds, way_out)
    told(what, seconds)


def _body(system, name, needed):
    """The body meant: the one named, or the only or first one."""
    names = [body.name for body in system.bodies]
    if name is not None and name not in names:
        raise StudyError(f"--body is {name!r}; allowed: {', '.join(names) or 'none, the system has no body'}")
    if needed and not names:
        raise StudyError("the system has no body; allowed with --force, --offset and --database: one with a body")
    return name if name is not None else names[0] if names else None


def _loaded(system, name, force):
    if len(force) != 3:
        raise StudyError(f"--force has {len(force)} numbers; allowed: 3, Fx and Fy in kN and Mz in kN m")
    from hakobune.mooring.lines.system.parts import MooredBody

    given = next(body for body in system.bodies if body.name == name)
    if not given.freedom:
        warnings.warn(f"{name} is held where it is given; under --force it moves in surge, sway and yaw", stacklevel=2)
        bodies = [replace(body, freedom=MooredBody.freedom) if body is given else body for body in system.bodies]
        system = replace(system, bodies=tuple(bodies))
    load = np.array(given.load, float)
    load[[0, 1, 5]] += KN * np.asarray(force, float)
    return system.with_loads({name: load})


def _table(title, *columns):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, column in enumerate(columns):
        table.add_column(column, justify="right" if i else "left")
    return table


def _show_rest(console, state):
    system = state.system
    table = _table("lines at rest, kN", "line", "tension a", "tension b", "horizontal", "on the bed m", "used %")
    for i, line in enumerate(system.lines):
        forces = state.lines
        cells = (
            forces.tension_a[i] / KN,
            forces.tension_b[i] / KN,
            forces.horizontal_b[i] / KN,
            forces.grounded_length[i],
        )
        table.add_row(line.name, *(f"{value:.1f}" for value in cells), percent(forces.utilisation[i]))
    console.print(table)
    for body, position in zip(system.bodies, state.position, strict=True):
        x, y, z = position[:3]
        roll, pitch, yaw = np.round(np.degrees(position[3:]), 3) + 0.0  # no −0
        console.print(
            f"{body.name}: x {x:.3f} m, y {y:.3f} m, z {z:.3f} m, roll {roll:.3f}°, pitch {pitch:.3f}°, yaw {yaw:.3f}°",
            highlight=False,
            soft_wrap=True,
        )
    for point, place, lies, reaction in zip(
        system.free_points, state.pose.free, state.on_bed, state.bed_reaction, strict=True
    ):
        where = f", on the bed with {reaction / KN:.1f} kN" if lies else ""
        console.print(
            f"{point.name}: x {place[0]:.3f} m, y {place[1]:.3f} m, z {place[2]:.3f} m{where}",
            highlight=False,
            soft_wrap=True,
        )
    left = np.abs(state.residual).max(initial=0.0)
    console.print(f"left unbalanced: {left:.2g} N after {state.iterations} steps", highlight=False)


def _show_stiffness(console, state, name):
    from hakobune.mooring.studies.system_at_rest import mooring_stiffness

    K = mooring_stiffness(state, name)
    shift, turn = np.sqrt(np.abs(np.diag(K)).reshape(2, 3).max(axis=1))
    unit = np.repeat([shift, max(turn, LEAST_ARM * shift)], 3)
    table = _table(f"stiffness of the lines on {name}, kN/m, kN/rad, kN m/rad", "", *DOFS)
    for i, dof in enumerate(DOFS):
        shown = [f"{K[i, j] / KN:.4g}" if abs(K[i, j]) > SHOWN * unit[i] * unit[j] else "0" for j in range(6)]
        table.add_row(dof, *shown)
    console.print(table)


def _curves(state, name, offset, directions):
    from hakobune.mooring.studies.system_at_rest import offset_curve

    offsets = np.linspace(-offset, offset, 21)
    pace = Pace("offset curves take", len(directions) * len(offsets), "give fewer with --direction")
    return [offset_curve(state, name, np.radians(direction), offsets, pace.step) for direction in directions]


def _losses(state):
    from hakobune.mooring.studies.system_at_rest import one_line_broken

    count = len(state.system.lines)
    return one_line_broken(state, Pace(f"{count} losses of a line take", count, "leave out --broken").step)


def _show_curves(console, name, curves, directions):
    table = _table(
        f"{name} held at offsets from rest: restoring force and largest tension",
        "offset m",
        *(f"{d:g}° kN" for d in directions),
        *(f"{d:g}° tension kN" for d in directions),
    )
    for j, value in enumerate(curves[0].offset):
        forces = [_kN(curve.restoring[j]) for curve in curves]
        tension = [_kN(curve.tension[j].max()) for curve in curves]
        table.add_row(f"{value:.2f}", *forces, *tension)
    console.print(table)


def _kN(value):
    """A force, "–" where there is no equilibrium"""
    return f"{value / KN:.1f}" if np.isfinite(value) else "–"


def _show_line(console, state, name):
    from hakobune.mooring.lines.system.characteristic import characteristic

    show_characteristic(console, name, *characteristic(state, name))


def _show_losses(console, state, losses, name):
    from hakobune.mooring.studies.system_at_rest import body_number

    table = _table("one line broken", "lost line", "largest tension kN", "in", "used %", f"{name or 'system'} moves m")
    i = None if name is None else body_number(state.system, name)
    for lost, left in losses.items():
        if isinstance(left, Exception):
            table.add_row(lost, "no equilibrium", str(left), "", "")
            continue
        worst = int(np.argmax(left.tension))
        shift = "–" if i is None else f"{np.linalg.norm(left.position[i, :3] - state.position[i, :3]):.2f}"
        table.add_row(
            lost,
            f"{left.tension[worst] / KN:.1f}",
            left.system.lines[worst].name,
            percent(np.fmax.reduce(left.lines.utilisation)),
            shift,
        )
    console.print(table)


def _show_periods(console, state, name, db):
    """Print them; a line where the body is unstable"""
    from hakobune.mooring.studies.natural_periods import moored_periods

    periods = moored_periods(state, name, db)
    table = _table(f"natural periods of {name}", "mode", "s")
    for mode, period in zip(periods.names, periods.period, strict=True):
        table.add_row(mode, f"{period:.2f}")
    console.print(table)
    unstable = [mode for mode, period in zip(periods.names, periods.period, strict=True) if np.isnan(period)]
    return [fails(f"unstable on its lines: {', '.join(unstable)}; the body needs more restoring")] if unstable else []


def _moordyn_file(system, path, source):
    """The MoorDynFile of a system, before anything is solved for it; source : the file the system was read from"""
    from hakobune.mooring.formats.moordyn import read_moordyn
    from hakobune.mooring.formats.moordyn_writing import moordyn_of_system

    if Path(path).exists():
        raise StudyError(f"{path} exists and is not replaced; give another name")
    other = source.suffix.lower() in (*YAML, *TOML)
    return moordyn_of_system(system, None if other else read_moordyn(source))


def _write(state, output, picture, curves, losses):
    written, system = [], state.system
    if output is not None:
        from hakobune.mooring.formats.results import channels_of_rest, write_channels

        names = {kind: [part.name for part in getattr(system, kind)] for kind in ("lines", "points", "bodies")}
        write_channels(output, 0.0, channels_of_rest(state), names)
        written.append(output)
    if picture is not None:
        from .pictures import draw_system

        kept = {name: left for name, left in losses.items() if not isinstance(left, Exception)}
        draw_system(state, picture, curves, kept)
        written.append(picture)
    return written
