"""`hakobune response`: a body of a database in a sea or a climate → tables, CSV or HDF5, picture."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

TABLES = (".csv", ".h5")
FAR_FROM_DEPTH = 0.2  # of the gap under the keel, by which it may differ from that of the database


def response(
    study: Annotated[Path, Parameter(help="study of a sea and a body (TOML)")],
    /,
    *,
    database: Annotated[Path, Parameter(help="of the body, .h5")],
    moored: Annotated[
        Path | None, Parameter(help="mooring study (TOML): its lines, wind and current hold the body")
    ] = None,
    output: Annotated[Path | None, Parameter(help=".csv or .h5")] = None,
    plot: Annotated[Path | None, Parameter(help=".png, .svg or .pdf")] = None,
):
    """Motions, accelerations, air gap and drift of a body in a sea state, or their extremes in a climate.

    The study (TOML) says which sea or scatter diagram, and which points of the body.
    """
    from hakobune.bem.database import open_database
    from hakobune.bem.database.resonances import resonances

    from ..common.quantities import StudyError
    from ..common.resonances import resonance_lines, underdamped
    from .effort import check_effort
    from .report import failures as response_failures
    from .study import files_of, read_response_study

    read, text = read_response_study(study)
    if read.current is not None and read.climate:
        raise StudyError("[current] is given with [climate]; allowed: with [sea]")
    if moored is not None and read.climate:
        raise StudyError("--moored is given with [climate]; allowed: with [sea]")
    _check_places(output, plot, study, database, *files_of(read, study.parent), *([moored] if moored else []))
    if read.sea:
        check_effort(read)
    db = open_database(database)
    points = read.places(db)
    body = db.reader.floating() if moored else read.restrained(db.reader.floating())
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            if moored is not None:
                held = _moored(read, db, points, study, moored)
                result = held.motion.fast
            else:
                held = None
                result, body = (_in_sea if read.sea else _in_climate)(read, body, db, points, study)
        except TypeError as error:
            raise StudyError(f"{study}: {error}") from None
    warned = list(
        dict.fromkeys([str(w.message) for w in caught] + list(held.motion.warnings if held else result.warnings))
    )
    if read.keel is not None and abs(read.keel.tide - read.keel.extra_draft) > FAR_FROM_DEPTH * gap_of(db):
        warned.append(
            f"tide and extra draft change the water under the keel by {read.keel.tide - read.keel.extra_draft:.3g} of "
            f"{gap_of(db):.3g} m: motions are those of the database's depth; solve it again at that depth"
        )
    found = resonances(body)
    warned += resonance_lines([one for one in found if underdamped(one)])
    noted = resonance_lines([one for one in found if not underdamped(one)])
    stiffness = body.stiffness if held is None else held.stiffness
    warned += () if held is None else held.failures
    warned += response_failures(result, stiffness, read.climate and read.climate.years)
    return _write(read, result, body.radius, points, (noted, warned), text, database, output, plot, held)


def gap_of(db):
    """m of water under the keel of a database"""
    return db.water_depth + float(db.mesh.whole().points[:, 2].min())


def _in_sea(read, body, db, points, study):
    """SeaState, and the body with its viscous damping in it"""
    from hakobune.mooring.on_current.body import on_current
    from hakobune.mooring.on_current.waves import carrier_of
    from hakobune.mooring.response.pair_levels import beside_newman
    from hakobune.mooring.response.sea_state import sea_state
    from hakobune.mooring.response.viscous import in_sea

    from ..common.quantities import level_of, positive
    from .study import sea_of, viscous_laws, viscous_words

    sea, laws = sea_of(read.sea, study, db.water_depth), viscous_laws(read, db)
    body = on_current(body, carrier_of(read.stream()))
    body, damping = in_sea(db.reader, sea, laws, body)
    for line in viscous_words(body, laws, damping):
        warnings.warn(line, stacklevel=2)
    level_of("sea.qtf", read.sea.qtf)
    bound, said = beside_newman(db, sea, read.sea.qtf, spread=True)
    for line in said:
        warnings.warn(line, stacklevel=2)
    return sea_state(body, sea, 3600 * positive("sea.duration_hours", read.sea.duration_hours), points, bound), body


def _moored(read, db, points, study, path):
    from ..common.quantities import StudyError, positive
    from .moored import moored
    from .study import sea_of

    if read.sea.qtf != "newman":
        raise StudyError(f"sea.qtf is {read.sea.qtf!r}; allowed with --moored: newman")
    sea = sea_of(read.sea, study, db.water_depth)
    return moored(path, read, db, sea, 3600 * positive("sea.duration_hours", read.sea.duration_hours), points)


def _in_climate(read, body, db, points, study):
    from ..common.quantities import StudyError

    if read.body.viscous is not None:
        raise StudyError("body.viscous is linearised in one sea; give damping_ratio for a climate")
    if db.has_viscous_motions:
        warnings.warn(
            "viscous damping of the database's scene is left out in a climate, whose seas would have one each: motions "
            "near resonance are too large; give body.damping_ratio", stacklevel=2
        )  # fmt: skip
    from hakobune.mooring.response.climate import climate

    from .effort import check_effort
    from .study import climate_of

    given = climate_of(read.climate, study, body.depth)
    check_effort(read, given["scatter"])
    return climate(body, **given, points=points), body


def _write(read, result, radius, points, said, text, database, output, plot, held=None):
    from . import output as response_output
    from . import report as response_report

    years = read.climate and read.climate.years
    rows = response_report.sea_rows(result) if read.sea else response_report.climate_rows(result, years)
    noted, warned = said
    warned = [*warned, *response_report.turned(rows)]
    lines = response_report.notes(result, radius, years) + noted + list(held.notes if held else ())
    if output is not None and output.suffix == ".csv":
        response_output.write_csv(output, rows, [*lines, *(held.csv() if held else ()), *warned])
    elif output is not None:
        response_output.write_h5(output, result, rows, text, database, warned, held.datasets() if held else {})
    if plot is not None:
        from .plot import draw

        draw(result, plot)
    return response_report.show(rows, points, lines, warned, [path for path in (output, plot) if path], held)


def _check_places(output, plot, *inputs):
    from ..common.outputs import check_output
    from ..common.picture import PLOTS, check_picture
    from .output import is_response

    if output is not None:
        check_output(output, "the result of a response study", is_response, TABLES, inputs)
    if plot is not None:
        check_picture(plot, PLOTS)
