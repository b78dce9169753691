"""`hakobune moor`: a study on a database → results file, table on the terminal, plan of the lines."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.resonances import resonances
from hakobune.bem.database.results import has_schema
from hakobune.mooring.studies.multi_point import PLANE, line_ends, multi_point

from ..common.outputs import DATABASE, check_output
from ..common.resonances import resonance_lines
from ..common.units import KN
from .study import read_study

SCHEMA = "hakobune mooring study 1"
SAME = 0.01  # of forces and motions, within which two methods are said to agree
LINE_QUANTITIES = {
    "pretension": ("N", lambda r: r.rest.lines.tension_b),
    "horizontal_pretension": ("N", lambda r: r.rest.lines.horizontal_b),
    "static_tension": ("N", lambda r: r.equilibrium.lines.tension_b),
    "maximum_tension": ("N", lambda r: r.tension),
    "utilisation": ("1", lambda r: r.utilisation),
    "maximum_vertical_anchor_force": ("N", lambda r: -r.extreme.vertical_a),
    "maximum_horizontal_anchor_force": ("N", lambda r: r.extreme.horizontal_a),
    "grounded_length_at_rest": ("m", lambda r: r.rest.lines.grounded_length),
    "grounded_length_at_maximum": ("m", lambda r: r.extreme.grounded_length),
    "fairlead_outward": ("m", lambda r: r.outward),
    "fairlead_upward": ("m", lambda r: r.upward),
    "breaking_load": ("N", lambda r: r.system.breaking_load),
    "length": ("m", lambda r: [line.length for line in r.system.lines]),
    "anchor": ("m", lambda r: line_ends(r.rest)[0]),
    "fairlead": ("m", lambda r: line_ends(r.rest)[1]),
}


def moor(study_path, database_path, output_path=None, quiet=False):
    """Run the study of a TOML file on a database; returns the MultiPoint result.

    With `output_path` the results are written there (HDF5), with a plan of the lines beside it (…_plan.png).
    raises : ValueError, one line, before anything is written
    """
    from hakobune.bem.database import open_database

    study, text = read_study(study_path)
    db = open_database(database_path)
    output = None if output_path is None else _checked_output(Path(output_path), study_path, database_path)
    result, hull = studied(study, db)
    first = study.remarks(hull, db)
    if output is not None:
        write_result(output, result, text, Path(database_path))
        from .plan_picture import draw_plan

        draw_plan(result, hull, output.with_name(output.stem + "_plan.png"))
    if not quiet:
        resonant = resonance_lines(resonances(db.reader)) if result.conditions.waves else []
        _show(result, first, resonant, output)
    return result


def studied(study, db):
    """The MultiPoint result of a Study on an open database, and its hull.  Raises ValueError, one line."""
    hull = study.without_berth("moor").hull_of(db.dimensions)
    system = study.system(hull, db.rotation_center, db.density, db.gravity)
    result = multi_point(db, system, hull, study.conditions(), study.allowable)
    return replace(result, warnings=(*study.remarks(hull, db), *result.warnings)), hull


def _checked_output(output, *inputs):
    check_output(output, "the result of a study", lambda path: has_schema(path, SCHEMA), DATABASE, inputs)
    return output


def write_result(output, result, text, database):
    """Write a MultiPoint result, the text of its study and the seal of its database whole into a file (HDF5)."""
    import h5py

    from hakobune.bem.database.file import beside

    with beside(output) as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["study"] = text
        file.attrs["database"] = str(database)
        file.attrs["database_sha256"] = hashlib.sha256(database.read_bytes()).hexdigest()
        file.attrs["allowable"] = result.allowable
        file.attrs["motion_factor"] = result.conditions.motion_factor
        file.attrs["warnings"] = "\n".join(result.warnings)
        _put(file, "equilibrium", result.displacement, "m, m, rad")
        _put(file, "heel", result.heel, "rad, rad")
        _put(file, "residual", result.equilibrium.residual[PLANE], "N, N, N m")
        _put(file, "mooring_stiffness", result.equilibrium.stiffness, "N/m, N/rad, N m/m, N m/rad")
        _put(file, "motion_amplitude", result.amplitudes, "m, m, m, rad, rad, rad")
        for name, load in result.loads.items():
            _put(file, f"loads/{name}", load, "N, N, N, N m, N m, N m")
        for method, effects in result.waves.items():
            _put(file, f"waves/{method}/drift", effects.drift, "N, N, N m")
            _put(file, f"waves/{method}/motion_amplitude", effects.amplitudes, "m, m, m, rad, rad, rad")
            if effects.by_current is not None:
                _put(file, f"waves/{method}/drift_by_current", effects.by_current, "N, N, N m")
        if result.waves:
            file["waves"].attrs["method"] = result.conditions.method
        for state in ("at_rest", "at_equilibrium"):
            periods = getattr(result, state)
            _put(file, f"natural_periods/{state}/period", periods.period, "s")
            _put(file, f"natural_periods/{state}/shape", periods.shapes, "1")
            file[f"natural_periods/{state}"].attrs["rotation_scale"] = periods.scale
        file["natural_periods"].attrs["modes"] = list(result.at_rest.names)
        file.create_dataset("lines/name", data=result.system.line_names, dtype=h5py.string_dtype())
        for name, (unit, value) in LINE_QUANTITIES.items():
            _put(file, f"lines/{name}", value(result), unit)


def _put(file, name, value, unit):
    file.create_dataset(name, data=np.asarray(value, float)).attrs["units"] = unit


def _show(result, first, resonant, output):
    from ..printing.console import new_console
    from ..printing.verdict import tell

    console = new_console()
    for text in first:
        console.print(f"warning: {text}", style="yellow", highlight=False, soft_wrap=True)
    console.print(_loads_table(result))
    console.print(_periods_table(result))
    console.print(_lines_table(result))
    x, y, turn = result.displacement
    roll, pitch = np.degrees(result.heel)
    console.print(
        f"equilibrium: x {x:.3f} m, y {y:.3f} m, yaw {np.degrees(turn):.3f}°; heel: roll {roll:.3f}°, pitch "
        f"{pitch:.3f}°",
        highlight=False,
        soft_wrap=True,
    )
    for line in _waves(result):
        console.print(line, highlight=False, soft_wrap=True)
    worst = int(np.argmax(result.tension))
    console.print(
        f"largest tension: {result.tension[worst] / KN:.0f} kN in {result.system.line_names[worst]}, "
        f"{_used(result, worst)}",
        highlight=False,
        soft_wrap=True,
    )
    tell(result.warnings[len(first) :], console)
    if output is not None:
        console.print(f"written: {output}, {output.stem}_plan.png", highlight=False, soft_wrap=True)


def _used(result, line):
    if np.isinf(result.system.breaking_load[line]):
        return "how much of its breaking load is unknown: none is given"
    return f"{100 * result.utilisation[line]:.0f} % of its breaking load (allowable {100 * result.allowable:.0f} %)"


def _waves(result):
    """Drift and motions by the method of the study, then by the other one where they differ"""
    if not result.waves:
        return
    w, chosen = result.conditions, result.waves[result.conditions.method]
    largest = f"largest expected in {w.duration / 3600:.3g} h of irregular waves"
    words = {"irregular": largest, "regular_wave": "of a regular wave of significant height"}
    yield f"free motions, {words[w.method]}: {_motions(chosen.amplitudes)}"
    if chosen.by_current is not None:
        yield _by_current(w.current, chosen)
    if w.motion_factor != 1:
        yield f"lines are tightened by {w.motion_factor:g} times these motions"
    for method, other in result.waves.items():
        if method != w.method and not _alike(chosen, other):
            x, y, turn = other.drift / KN
            yield (
                f'not used (method = "{method}"), {words[method]}: drift Fx {x:.1f}, Fy {y:.1f} kN, '
                f"Mz {turn:.1f} kN m; {_motions(other.amplitudes)}"
            )


def _by_current(current, effects):
    """What a current that carries the waves changes in their drift"""
    still, names = effects.drift - effects.by_current, ("Fx", "Fy", "Mz")
    size = np.array([*2 * [np.abs(still[:2]).max()], np.abs(still[2])])
    parts = [
        f"{name} {value / KN:+.4g} {unit}" + (f" ({100 * value / of:+.0f} %)" if abs(of) > SAME * most else "")
        for name, value, of, most, unit in zip(
            names, effects.by_current, still, size, ("kN", "kN", "kN m"), strict=True
        )
    ]
    return (
        f"the current of {current.speed:.3g} m/s changes the drift by {', '.join(parts)} of that in still water, which "
        f'current.waves = "still" has; waves are given in {current.waves} frequencies'
    )


def _alike(one, other):
    """Whether two WaveEffects differ by less than a hundredth of their largest force and motion"""
    pairs = [(one.drift, other.drift), (one.amplitudes[:3], other.amplitudes[:3])]
    return all(np.abs(a - b).max() <= SAME * max(np.abs(a).max(), 1e-300) for a, b in pairs)


def _motions(amplitudes):
    shift, turn = amplitudes[:3], np.degrees(amplitudes[3:])
    words = [f"{name} {value:.3g} m" for name, value in zip(DOFS[:3], shift, strict=True)]
    words += [f"{name} {value:.3g}°" for name, value in zip(DOFS[3:], turn, strict=True)]
    return ", ".join(words).lower()


def _table(title, *columns):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, column in enumerate(columns):
        table.add_column(column, justify="right" if i else "left")
    return table


def _loads_table(result):
    table = _table("steady forces", "load", "Fx kN", "Fy kN", "Mx kN m", "My kN m", "Mz kN m")
    total = result.steady_force
    for name, load in [*result.loads.items(), ("sum", total)]:
        table.add_row(name, *(f"{value / KN:.1f}" for value in np.delete(load, 2)))
    return table


def _periods_table(result):
    table = _table("natural periods", "mode", "at rest s", "under steady forces s")
    for name, rest, loaded in zip(
        result.at_rest.names, result.at_rest.period, result.at_equilibrium.period, strict=True
    ):
        table.add_row(name, f"{rest:.2f}", f"{loaded:.2f}")
    return table


def _lines_table(result):
    table = _table("lines, tension at the fairlead", "line", "at rest kN", "steady kN", "largest kN", "used %")
    for row in zip(
        result.system.line_names,
        result.rest.lines.tension_b / KN,
        result.equilibrium.lines.tension_b / KN,
        result.tension / KN,
        100 * result.utilisation,
        strict=True,
    ):
        style = "red" if row[-1] > 100 * result.allowable else None
        *forces, used = row[1:]
        share = "unknown" if np.isnan(used) else f"{used:.1f}"
        table.add_row(row[0], *(f"{value:.1f}" for value in forces), share, style=style)
    return table
