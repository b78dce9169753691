"""The flags of `hakobune export` and `hakobune import`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

FORMATS = "wamit, nemoh, hams, bemio (of WEC-Sim), hydrochrono (the same), capytaine or orcaflex"
Size = Annotated[float | None, Parameter(allow_leading_hyphen=True)]


def export(
    database: Annotated[Path, Parameter(help="of hakobune, .h5")],
    /,
    *,
    to: Annotated[str, Parameter(help=FORMATS)],
    output: Annotated[Path | None, Parameter(help="file or folder [beside the database]")] = None,
    fresh: Annotated[bool, Parameter(help="replace what is there", negative="")] = False,
):
    """Write a database in the files of another program.

    hakobune export box.h5 --to wamit
    """
    from .command import export

    return export(database, to, output, fresh)


def import_(
    place: Annotated[Path, Parameter(help="file or folder of another program")],
    /,
    *,
    from_: Annotated[str, Parameter(name="--from", help=FORMATS)],
    mesh: Annotated[Path | None, Parameter(help="of the hull [what lies with the results]")] = None,
    depth: Annotated[float | None, Parameter(help="m or inf, of files that do not say it")] = None,
    density: Annotated[float, Parameter(help="kg/m³, of files that do not say it")] = 1025.0,
    gravity: Annotated[float, Parameter(help="m/s², of files that do not say it")] = 9.80665,
    output: Annotated[Path | None, Parameter(help="the database [beside it, .h5]")] = None,
):
    """Read results of another program into a database; a file, or the folder of Nemoh or HAMS.

    hakobune import barge.1 --from wamit --mesh barge.gdf --depth 20
    """
    from .command import import_

    return import_(place, from_, mesh, {"water_depth": depth, "density": density, "gravity": gravity}, output)
