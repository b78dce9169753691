"""`hakobune sections`: sectional coefficients of rectangles over B/d, H/d and ξ_B as a table, .csv or .h5."""

from __future__ import annotations

import csv
import io
import math
import sys
from pathlib import Path
from typing import Annotated

from hakobune.meshing.seals import write_sealed

from ..common.bounds import Pace, check_count, check_memory
from ..scene.flags import _flag

NOTES = (
    "Rectangle of beam B and draft d in water of depth H, two-dimensional, ideal fluid; matched eigenfunctions",
    "Definitions: SR179 report (1982), section 2.1.3; a table's number is given where the report has the shape",
    "Axes: y to the right, z up, roll from y to z about the middle of the waterline; waves towards +y",
    "Force = |E| cos(omega t - eps) per unit amplitude, eps in degrees, 0 when the crest passes y = 0",
    "xi_B = (omega^2/g)(B/2), S = B d; M_H, M_S: M/(rho S); M_R: M/(rho S (B/2)^2); M_SR: M/(rho S (B/2))",
    "N likewise and over omega; E_H, E_S: |E|/(rho g (B/2)); E_R: |E|/(rho g (B/2)^2)",
)
SUFFIXES = (".csv", ".h5")
SCHEMA = "hakobune sections 1"
BYTES = 2000  # of a row


def sections(
    *,
    beam_draft: Annotated[str | None, _flag("B/d: a,b,c or start:stop:count [5,10,15,20]")] = None,
    depth_draft: Annotated[str | None, _flag("H/d, above 1; inf for deep water [1.2,1.4,2,3,10]")] = None,
    xi: Annotated[str | None, _flag("ξ_B = ω²B/2g [0.1,0.2,0.4,0.6,0.8,1,1.5,2,2.5,3]")] = None,
    tolerance: Annotated[float, _flag("relative error, 1e-8 or more")] = 1e-6,
    output: Annotated[Path | None, _flag(".csv or .h5; without it the table goes to the terminal")] = None,
):
    """Added mass, damping and excitation of rectangular sections: the SR179 report's Tables 2.1.3.1 to 20.

    Without flags the report's twenty shapes and ten frequencies.
    """
    from hakobune.bem.sections.tables import BEAM_DRAFT, DEPTH_DRAFT, XI, tables

    from ..common.outputs import check_output

    grid = (
        _listed("--beam-draft", beam_draft, BEAM_DRAFT),
        _listed("--depth-draft", depth_draft, DEPTH_DRAFT),
        _listed("--xi", xi, XI),
    )
    _check_above("--beam-draft", grid[0], 0, "above 0, finite")
    _check_above("--depth-draft", grid[1], 1, "above 1, or inf", largest=math.inf)
    _check_above("--xi", grid[2], 0, "above 0, finite")
    if output is not None:
        check_output(output, "a table of sections", is_table, SUFFIXES)
    count = math.prod(map(len, grid))
    way_out = "give fewer in --beam-draft, --depth-draft or --xi"
    check_memory(f"{count} sections need", BYTES * count, way_out)
    rows = tables(*grid, tolerance, Pace(f"{count} sections take", count, way_out).step)
    if output is None:
        print(csv_text(rows, tolerance), end="")
    else:
        (_write_csv if output.suffix == ".csv" else _write_hdf5)(output, rows, grid, tolerance)
        print(f"{output}: {len(rows)} sections, {len(grid[0])} B/d, {len(grid[1])} H/d, {len(grid[2])} xi_B")
    return 0


def _listed(flag, text, default):
    import numpy as np

    from ..scene.scene import numbers

    if text is None:
        return list(default)
    values = numbers(flag, text)
    if isinstance(values, dict):
        check_count(flag, values["count"], 2)
        if not values["from"] < values["to"] < np.inf:
            raise ValueError(f"{flag} is {text!r}; allowed: start:stop:count with start below stop")
        return np.linspace(values["from"], values["to"], values["count"]).tolist()
    check_count(flag, len(values))
    if len(set(values)) < len(values):
        raise ValueError(f"{flag} is {text!r}; allowed: every number once")
    return values


def _check_above(flag, values, low, allowed, largest=sys.float_info.max):
    wrong = [value for value in values if not low < value <= largest]
    if wrong:
        raise ValueError(f"{flag} is {wrong[0]:g}; allowed: {allowed}")


def is_table(path):
    """Whether a file was written here"""
    from hakobune.bem.database.results import has_schema

    from ..common.outputs import opening

    if path.suffix == ".csv":
        return opening(path)[0] == f"# {NOTES[0]}"
    return has_schema(path, SCHEMA)


def csv_text(rows, tolerance):
    """The table as text: what it is in # lines, then one line per section."""
    from hakobune.bem.sections.tables import COLUMNS, table_name

    text = io.StringIO()
    text.writelines(f"# {note}\n" for note in (*NOTES, f"Relative tolerance {tolerance:g}"))
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("table", *COLUMNS))
    for row in rows:
        writer.writerow((table_name(row), *(f"{row[name]:.7g}" for name in COLUMNS)))
    return text.getvalue()


def _write_csv(output, rows, grid, tolerance):
    write_sealed(output, csv_text(rows, tolerance))


def _write_hdf5(output, rows, grid, tolerance):
    import numpy as np

    from hakobune.bem.database.file import beside
    from hakobune.bem.sections.tables import COLUMNS, SHAPE_COLUMNS

    beam_draft, depth_draft, xi = grid
    axes = {"H_over_d": depth_draft, "B_over_d": beam_draft, "xi_B": xi}
    with beside(output) as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["notes"] = "\n".join(NOTES)
        file.attrs["tolerance"] = tolerance
        for name, values in axes.items():
            file.create_dataset(name, data=np.asarray(values, float)).make_scale(name)
        for name in COLUMNS[len(SHAPE_COLUMNS) :]:
            values = np.reshape([row[name] for row in rows], [len(axis) for axis in axes.values()])
            dataset = file.create_dataset(name, data=values)
            dataset.attrs["units"] = "degree" if name.startswith("eps") else "1"
            for place, axis in enumerate(axes):
                dataset.dims[place].attach_scale(file[axis])
