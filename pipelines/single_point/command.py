"""`hakobune single-point`: statics and criterion on the terminal, maps, a run in time, results and pictures."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hakobune.bem.database.results import has_schema
from hakobune.mooring.single_point.equilibria import equilibria

from ..common.outputs import DATABASE, check_output
from ..common.picture import PLOTS, check_picture
from ..printing.verdict import tell
from . import running
from .report import cycle_of, findings, overloads, preferred, show
from .study import check_buoy, make
from .tables import read_study

SCHEMA = "hakobune single point 1"
CYCLE = {  # of the datasets of a limit cycle
    "period": "s", "amplitude": "rad", "middle": "rad", "time": "s", "states": "m, m, rad, m/s, m/s, rad/s",
    "hawser": "N", "lines": "N",
}  # fmt: skip


def single_point(study_path, database, output, picture):
    """Exit status.  Raises ValueError, one line, before anything is written."""
    from hakobune.bem.database import open_database

    from ..printing.console import new_console

    study, raw, text = read_study(study_path)
    inputs = (study_path, *(() if database is None else (database,)))
    if output is not None:
        check_output(output, "the result of a single-point study", lambda p: has_schema(p, SCHEMA), DATABASE, inputs)
    if picture is not None:
        check_picture(picture, PLOTS)
    db = None if database is None else open_database(database)
    if study.slewing is not None:
        running.check(study, db)
    made = make(study, db)
    found = equilibria(made.point)
    for one in found:
        check_buoy(made, one)
    console = new_console()
    show(console, study, made, found)
    cycle, said = cycle_of(preferred(found))
    if said is not None:
        console.print(said, highlight=False, soft_wrap=True, markup=False)
    written = []
    if picture is not None:
        from .pictures import draw_plan

        draw_plan(study, made.point, found, picture)
        written.append(picture)
    made_run = None
    if study.slewing is not None:
        made_run = running.run(study, made.point, preferred(found), db)
        running.show(console, made_run)
        written.append(_beside(study_path, output, "run"))
        running.draw(study, made_run, written[-1])
    if output is not None:
        write_result(output, text, found, made_run, cycle, sizes_of(study, made.point))
        written.append(output)
    maps, lost = _maps(study, raw, db, (study_path, output), console)
    written += maps
    status = tell([*findings(study, made, found), *overloads(study, preferred(found), cycle, made_run), *lost], console)
    for path in written:
        console.print(f"written: {path}", highlight=False, soft_wrap=True, markup=False)
    return status


def _maps(study, raw, db, names, console):
    """Draw the maps of a study beside it; their paths, and a line on the places of each that have no answer"""
    from .maps import computed, draw

    paths, lost = [], []
    for i, _ in enumerate(study.maps):
        found = computed(raw, i, db)
        number = f"_{i + 1}" if len(study.maps) > 1 else ""
        paths.append(_beside(*names, f"slewing{number}"))
        draw(found, paths[-1])
        slews = np.mean(found.growth[~np.isnan(found.growth)] > 0)
        console.print(f"map over {' and '.join(found.keys)}: {100 * slews:.0f} % of it slews", highlight=False)
        if found.failed:
            lost.append(
                f"map over {' and '.join(found.keys)}: {found.failed} of {found.growth.size} places have no answer: "
                f"{found.reason}"
            )
    return paths, lost


def _beside(study_path, output, word):
    """Path of a picture: beside the results, or where the command is called, named by the study.  Raises ValueError."""
    path = Path(f"{Path(study_path).stem}_{word}.png")
    path = path if output is None else output.with_name(f"{output.stem}_{word}.png")
    check_picture(path, PLOTS)
    return path


def sizes_of(study, point):
    """What a film of a run needs: m, of the hull, its middle and the ends of hawsers from the centre of mass"""
    h, ends = study.hull, point.ends
    freeboard = 0.5 * h.draft if h.freeboard is None else h.freeboard
    middle = ends.mean(axis=0) - [study.attachment.x, study.attachment.y]
    return {
        "hull": [h.length, h.beam, h.draft, freeboard], "hull_middle": middle, "hawser_ends": ends,
        "water_depth": study.water.depth, "density": point.system.density,
    }  # fmt: skip


def write_result(path, text, found, run=None, cycle=None, sizes=None):
    """Write the equilibria whole into a file (HDF5), one row each, a Run and a LimitCycle; units as attributes."""
    import h5py

    from hakobune.bem.database.file import beside

    columns = {
        "heading": ("rad", [one.heading for one in found]),
        "place": ("m", [one.place for one in found]),
        "buoy": ("m", [one.lines.position[0, :3] for one in found]),
        "force": ("N, N, N m", [one.force for one in found]),
        "hawser_tension": ("N", [one.hawser for one in found]),
        "line_tension": ("N", [one.lines.tension for one in found]),
        "roots_real": ("1/s", [one.roots.real for one in found]),
        "roots_imaginary": ("rad/s", [one.roots.imag for one in found]),
        "quartic": ("1", [np.full(5, np.nan) if one.quartic is None else one.quartic for one in found]),
    }
    with beside(path) as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["study"] = text
        for name, (unit, values) in columns.items():
            file.create_dataset(name, data=np.asarray(values, float)).attrs["units"] = unit
        for name, (unit, values) in ({} if run is None else running.datasets(run)).items():
            file.create_dataset(f"run/{name}", data=np.asarray(values, float)).attrs["units"] = unit
        if run is not None:
            file["run"].attrs.update(sizes or {})
        for name, unit in ({} if cycle is None else CYCLE).items():
            file.create_dataset(f"limit_cycle/{name}", data=getattr(cycle, name)).attrs["units"] = unit
        file.create_dataset("stable", data=np.array([one.slewing.stable for one in found]))
        file.create_dataset("lines", data=found[0].point.system.line_names, dtype=h5py.string_dtype())
