"""`hakobune sections`: the result as a table with one line per section, .csv or .h5."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from hakobune.meshing.seals import write_sealed

from ..common.bounds import check_count
from ..scene.flags import _flag

SUFFIXES = (".csv", ".h5")


def sections(
    study: Annotated[Path | None, Parameter(help="sections side by side, free or hinged (TOML)")] = None,
    /,
    *,
    beam_draft: Annotated[str | None, _flag("B/d: a,b,c or start:stop:count [5,10,15,20]")] = None,
    depth_draft: Annotated[str | None, _flag("H/d, above 1; inf for deep water [1.2,1.4,2,3,10]")] = None,
    xi: Annotated[str | None, _flag("ξ_B = ω²B/2g [0.1,0.2,0.4,0.6,0.8,1,1.5,2,2.5,3]")] = None,
    tolerance: Annotated[float, _flag("relative error, 1e-8 or more")] = 1e-6,
    output: Annotated[Path | None, _flag(".csv or .h5 [table in the terminal]")] = None,
):
    """Compute added mass, damping and excitation of rectangular sections (SR179 report, Tables 2.1.3.1 to 20).

    Without flags it computes the report's twenty shapes and ten frequencies. With a study it computes sections side by
    side in beam waves, free or held together by hinges.

    hakobune new sections
    """
    from ..common.outputs import check_output
    from ..printing.console import document
    from .result import sections

    if study is not None:
        return _side_by_side(study, output, {"--beam-draft": beam_draft, "--depth-draft": depth_draft, "--xi": xi})
    flags = {"beam_draft": beam_draft, "depth_draft": depth_draft, "xi": xi}
    check_output(output, "a table of sections", is_table, SUFFIXES)
    grid = {name: _listed(f"--{name.replace('_', '-')}", text) for name, text in flags.items() if text is not None}
    result = sections(**grid, tolerance=tolerance)
    if output is None:
        if not document(result):
            print(csv_text(result.detail, tolerance), end="")
        return 0
    if output.suffix == ".csv":
        write_sealed(output, csv_text(result.detail, tolerance))
    else:
        result.write(output)
    sizes = dict(zip(result.labels, result["M_H"].shape, strict=True))
    print(f"{output}: {', '.join(f'{size} {name}' for name, size in sizes.items())}")
    return 0


def _side_by_side(study, output, flags):
    """The result of a study, printed and written; returns the exit status"""
    from ..results.output import check_result, finish, write_result
    from .result import sections

    given = [flag for flag, text in flags.items() if text is not None]
    if given:
        raise ValueError(f"{given[0]} is given together with {study}; give only one of the two")
    if output is not None:
        check_result(output, "sections", [study])
    return finish(sections(study), (output, write_result))


def _listed(flag, text):
    import numpy as np

    from ..scene.scene import numbers

    values = numbers(flag, text)
    if isinstance(values, dict):
        check_count(flag, values["count"], 2)
        if not values["from"] < values["to"] < np.inf:
            raise ValueError(f"{flag} is {text!r}; allowed: start:stop:count with start below stop")
        return np.linspace(values["from"], values["to"], values["count"]).tolist()
    check_count(flag, len(values))
    if len(set(values)) < len(values):
        raise ValueError(f"{flag} is {text!r}; give each number once")
    return values


def is_table(path):
    """Whether a file was written by `hakobune sections`"""
    from hakobune.bem.database.results import has_schema

    from ..common.outputs import opening
    from ..results.writing import schema
    from .result import NOTES

    if path.suffix == ".csv":
        return opening(path)[0] == f"# {NOTES[0]}"
    return has_schema(path, schema("sections"))


def csv_text(rows, tolerance):
    """The table as text: a description in # lines, then one line per section."""
    from hakobune.bem.sections.tables import COLUMNS, table_name

    from .result import NOTES

    text = io.StringIO()
    text.writelines(f"# {note}\n" for note in (*NOTES, f"Relative tolerance {tolerance:g}"))
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("table", *COLUMNS))
    for row in rows:
        writer.writerow((table_name(row), *(f"{row[name]:.7g}" for name in COLUMNS)))
    return text.getvalue()
