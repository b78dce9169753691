"""The flags of `hakobune line` and `lines`.  Heavy imports happen inside."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def line(
    *,
    type: Annotated[
        str | None, Parameter(help='name in the catalogue: "R3 studless 76 mm", "wire 6x36 IWRC 52 mm" …')
    ] = None,
    weight: Annotated[float | None, Parameter(help="weight in water, N/m, if no type is given")] = None,
    stiffness: Annotated[
        float | None, Parameter(help="axial stiffness EA, kN, with --weight; inextensible if not given")
    ] = None,
    length: Annotated[float, Parameter(help="m, unstretched")],
    depth: Annotated[float, Parameter(help="water depth at the anchor, m")],
    fairlead_z: Annotated[
        float, Parameter(help="height of the fairlead above still water, m", allow_leading_hyphen=True)
    ] = 0.0,
    span: Annotated[float | None, Parameter(help="horizontal distance from anchor to fairlead, m")] = None,
    tension: Annotated[
        float | None, Parameter(help="horizontal tension at the fairlead, kN, instead of a span")
    ] = None,
    friction: Annotated[float, Parameter(help="friction coefficient of the bed")] = 0.0,
    slope_deg: Annotated[
        float,
        Parameter(
            help="slope of the bed, degrees, above 0 if the bed rises towards the fairlead", allow_leading_hyphen=True
        ),
    ] = 0.0,
    characteristic: Annotated[
        bool, Parameter(help="table of span, forces and length on the bed, from slack to taut", negative="")
    ] = False,
    output: Annotated[Path | None, Parameter(help="result, .h5 or .csv")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute forces, profile and tension–offset curve of one mooring line; lengths in m."""
    from .line_command import line_command

    kN = {
        name: None if value is None else 1e3 * value for name, value in (("stiffness", stiffness), ("tension", tension))
    }
    at = {"span": span, "friction": friction, "slope": math.radians(slope_deg), "fairlead_z": fairlead_z}
    return line_command(
        output, plot, type=type, weight=weight, length=length, depth=depth, characteristic=characteristic, **kN, **at
    )


def lines(
    file: Annotated[Path, Parameter(help="system of lines: TOML, MoorDyn (.dat, .txt) or MoorPy (.yaml)")],
    /,
    *,
    body: Annotated[str | None, Parameter(help="body that --force and --offset act on [the first]")] = None,
    force: Annotated[
        str | None, Parameter(help="force on the body: Fx,Fy,Mz in kN and kN m", allow_leading_hyphen=True)
    ] = None,
    offset: Annotated[float | None, Parameter(help="offset to both sides, m: draw and print the offset curve")] = None,
    direction: Annotated[
        str | None, Parameter(help="directions of the offsets, degrees: a,b,c", allow_leading_hyphen=True)
    ] = None,
    characteristic: Annotated[
        str | None, Parameter(help="name of a line: print its span and forces, from slack to taut")
    ] = None,
    broken: Annotated[bool, Parameter(help="compute the equilibrium after the loss of each line", negative="")] = False,
    depth: Annotated[
        float | None,
        Parameter(help="water depth, m, for a MoorDyn or YAML file without one", allow_leading_hyphen=True),
    ] = None,
    database: Annotated[
        Path | None,
        Parameter(help="database of the body: adds natural periods and a check of fairleads"),
    ] = None,
    output: Annotated[Path | None, Parameter(help="results, .h5 or .csv")] = None,
    plot: Annotated[
        Path | None,
        Parameter(help="plan, profile, curves: .png .svg .pdf; for a result its frames, also .gif [NAME_frames.png]"),
    ] = None,
    moordyn: Annotated[Path | None, Parameter(help="write the system as a MoorDyn v2 input file")] = None,
):
    """Compute the equilibrium of a system of lines (TOML, MoorDyn or MoorPy file), or draw a stored line (.h5)."""
    if file.suffix.lower() in (".h5", ".hdf5"):
        from .pictures import draw_result

        asked = {"--body": body, "--force": force, "--offset": offset, "--direction": direction, "--depth": depth}
        asked |= {"--characteristic": characteristic, "--broken": broken or None, "--database": database}
        given = [
            flag for flag, value in (asked | {"--output": output, "--moordyn": moordyn}).items() if value is not None
        ]
        if given:
            raise ValueError(
                f"{given[0]} is for a system of lines and {file} is a result; allowed with a result: --plot"
            )
        print(draw_result(file, plot))
        return 0
    from .lines_command import lines_command

    load = [1e3 * value for value in _numbers("--force", force)] if force else None
    directions = [math.radians(value) for value in (_numbers("--direction", direction) if direction else [0.0, 90.0])]
    asked = {"body": body, "force": load, "offset": offset, "directions": directions, "characteristic": characteristic}
    return lines_command(file, depth, output, plot, moordyn, **asked, broken=broken, database=database)


def _numbers(flag, text):
    """`a,b,c` as finite numbers"""
    try:
        made = [float(part) for part in text.split(",")]
    except ValueError:
        made = [math.nan]
    if not all(map(math.isfinite, made)):
        raise ValueError(f"{flag} is {text!r}; allowed: finite numbers a,b,c")
    return made
