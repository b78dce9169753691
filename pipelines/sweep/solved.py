"""One case of a sweep of scenes: solved in a separate file, whose arrays are copied to the file of all cases."""

import tempfile
from pathlib import Path

import numpy as np

from hakobune.bem.database.schema import labels
from hakobune.mooring.criteria.failing import FAILS, failing

from ..printing.verdict import status_of
from ..results.quantity import Quantity

LARGE = ("kochin_radiation", "kochin_diffraction", "pressure")  # quantities too large for a sweep
OF_A_CASE = {"omega": "frequency", "wave_direction": "heading"}  # axes on which a case may have its own values


def solved(raw, scene_file):
    """Return (exit status, message, {name: Quantity}, {axis: labels}) of a scene; mesh files are seen beside
    `scene_file`.

    Axes and units are those of a database. Frequencies and headings are counted by index; their values are arrays too.
    """
    from hakobune.bem.database import open_database

    from ..scene.scene import make_scene
    from ..solve.report import failures, gives_panels
    from ..solve.run import solve

    try:
        for body in raw.get("bodies", ()):
            if "file" in body:
                body["file"] = str(scene_file.parent / body["file"])
        scene = make_scene(raw)
        with tempfile.TemporaryDirectory() as folder:
            outcome = solve(scene, Path(folder) / "case.h5")
            made = open_database(outcome.path)
            failed = failing([*outcome.remarks, *failures(outcome, made, gives_panels(scene))])
            arrays = _arrays(outcome.path, made.bodies)
    except ValueError as error:
        return 2, str(error), {}, {}
    said = "; ".join(line.removeprefix(FAILS) for line in failed)
    axes = {axis: Quantity(np.array(names), (axis,)) for axis, names in labels(made.bodies).items()}
    return outcome.exit_status or status_of(failed), said, arrays, axes


def _arrays(path, bodies):
    """Content of a file that this process has just written and closed, so that no checksum is checked

    bodies : names of the bodies of the database, if there are several
    """
    import h5py

    from hakobune.bem.database.schema import BODY, COORDINATES, QUANTITIES

    found = {}
    with h5py.File(path) as file:
        there = set(file)
        for name, (axes, unit, _) in (*COORDINATES.items(), *QUANTITIES.items(), *BODY.items()):
            if name in there and name not in LARGE and (name in OF_A_CASE or name not in COORDINATES):
                each = ("body",) if bodies and name in BODY and "influenced_dof" not in axes else ()
                of = (*each, *(OF_A_CASE.get(axis, axis) for axis in axes))
                found[name] = Quantity(_values(file[name]), of, unit, name.replace("_", " "))
    return found


def _values(data):
    import h5py

    return data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()]
