"""The flags of `hakobune animate`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def animate(
    file: Annotated[Path, Parameter(help="file of a simulation or of a single point, or a database")],
    /,
    *,
    output: Annotated[Path, Parameter(help="film, .gif")],
    seed: Annotated[int | None, Parameter(help="number of a seed with a stored record [the first]")] = None,
    start: Annotated[
        float | None, Parameter(help="time when the film begins, s after the ramp [around the largest tension]")
    ] = None,
    length: Annotated[
        float | None, Parameter(help="length of the film, s [60; at a single point the whole run]")
    ] = None,
    step: Annotated[
        float | None,
        Parameter(help=("time between frames, s; the film shows ten frames a second [1, or 150 frames in total]")),
    ] = None,
    period: Annotated[float | None, Parameter(help="period of the waves around the body of a database, s")] = None,
    omega: Annotated[float | None, Parameter(help="frequency of these waves, rad/s, in place of the period")] = None,
    heading: Annotated[
        float | None, Parameter(help="direction that these waves travel to, degrees [180]", allow_leading_hyphen=True)
    ] = None,
    height: Annotated[float | None, Parameter(help="height of these waves, m [1/30 of their length]")] = None,
    fixed: Annotated[bool, Parameter(help="hold the body fixed", negative="")] = False,
    field: Annotated[str | None, Parameter(help="pressure: colour the panels by it")] = None,
):
    """Make a film of body, lines and waves from the file of a simulation or of a single point, or of a
    database's body in regular waves.

    hakobune animate run.h5 --output film.gif
    hakobune animate box.h5 --period 9 --heading 180 --output film.gif
    """
    from hakobune.bem.database.results import check_any_version, has_schema, schema_of

    from ..printing.verdict import tell
    from ..results.heard import heard
    from ..results.writing import schema
    from ..simulate.file import is_run

    findings = []
    of_run = {"seed": seed, "start": start, "length": length, "step": step}
    regular = {
        "period": period,
        "omega": omega,
        "heading": heading,
        "height": height,
        "fixed": fixed or None,
        "field": field,
    }
    check_any_version(file, schema_of(file))
    if has_schema(file, schema("single-point")):
        from .of_single_point import film_of_single_point

        _check_none({**regular, "seed": seed}, "another film", file, "a single point")
        frames = film_of_single_point(file, output, **_given({"start": start, "length": length, "step": step}))
    elif is_run(file):
        from .of_run import film_of_run

        _check_none(regular, "a database", file, "a simulation")
        with heard() as findings:
            frames = film_of_run(file, output, **_given(of_run))
    else:
        from hakobune.bem.database import open_database

        from .of_database import film_of_database

        open_database(file)  # another kind of file is refused here
        _check_none(of_run, "a simulation", file, "a database")
        frames, findings = film_of_database(file, output, **_given(regular))
    print(f"{output}: {frames} frames")
    return tell(findings, remark="note: ")


def _given(flags):
    return {name: value for name, value in flags.items() if value is not None}


def _check_none(flags, theirs, file, its):
    """Raise ValueError for flags of the other kind of film."""
    given = _given(flags)
    if given:
        raise ValueError(f"--{next(iter(given))} belongs to {theirs}; {file} is the file of {its}")
