"""Export of databases to files of other programs, and import; messages report omitted data."""

from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database import open_database
from hakobune.bem.database.file import check_place
from hakobune.bem.database.schema import LIMITS
from hakobune.bem.database.widening import read_group
from hakobune.bem.drift import OF_EACH
from hakobune.bem.formats.values import CARRIED, values_of
from hakobune.bem.formats.wamit_inputs import pot_of
from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.criteria.failing import fails

from ..common.gaps import gaps_of
from ..common.outputs import check_ending, check_folder
from ..printing.console import new_console
from ..printing.verdict import tell


class Format(NamedTuple):
    """module : from `bem.formats`; ending : ending of the default name; folder : whether the format is a folder of
    files;
    several : whether it can have several bodies

    silent : quantities that its files may not contain
    """

    module: str
    ending: str
    folder: bool = False
    silent: tuple[str, ...] = ()
    read_only: bool = False
    several: bool = False


WATER = ("water_depth", "density", "gravity")
FORMATS = {
    "wamit": Format("wamit", ".1", silent=(*WATER, "length_unit", "rotation_center"), several=True),
    "nemoh": Format("nemoh", "_nemoh", True, several=True),
    "hams": Format("hams", "_hams", True, ("density", "gravity"), several=True),
    "bemio": Format("bemio", "_bemio.h5", several=True),
    "hydrochrono": Format("bemio", "_hydrochrono.h5", several=True),
    "capytaine": Format("capytaine", ".nc", several=True),
    "orcaflex": Format("orcaflex", ".yml", silent=("gravity",)),
    "aqwa": Format("aqwa", "", read_only=True),
    "diodore": Format("diodore", "", silent=WATER, read_only=True),
    "hydrostar": Format("hydrostar", "", read_only=True),
}
BY_WAMIT = ("wamit", "hams")  # formats with WAMIT's files of results
OF_WAMIT = (".1", ".3", ".3fk", ".3sc", ".4", ".8", ".hst", ".gdf", ".pot", ".12d", ".12s")  # that export writes
MEAN_DRIFT = ("drift_force", "drift_force_fixed", *OF_EACH)
PARTS = ("Froude_Krylov_force", "diffraction_force")  # of the excitation
# quantities of a database that each format cannot hold; those of WAMIT's hold more of one body
NOT_HELD = {
    "wamit": MEAN_DRIFT,
    "hams": PARTS + MEAN_DRIFT,
    "nemoh": ("rao", *MEAN_DRIFT),
    **dict.fromkeys(("bemio", "hydrochrono", "capytaine"), ("rao", "drift_force_fixed", *OF_EACH)),
    "orcaflex": ("drift_force", "drift_force_fixed", *PARTS, "added_mass_zero", *OF_EACH),
}


def export(database, to, output, fresh):
    """Write the files and print their names; 1 if frequencies of the database are unsolved.  Raises ValueError."""
    kind, db = format_of("to", to), open_database(database)
    output = _default(database, to, kind) if output is None else output
    _check_place(output, kind, fresh, database)
    if db.bodies and not kind.several:
        raise ValueError(
            f"{database} contains {len(db.bodies)} bodies, which --to {to} cannot write; allowed: --to "
            f"{', '.join(name for name, one in FORMATS.items() if one.several)}"
        )
    values = values_of(db, kind.several)
    made = import_module(f"hakobune.bem.formats.{kind.module}").write(values, output)
    if to == "wamit" and values.mesh is not None:
        from hakobune.meshing.files import write_mesh

        hulls = list(_hulls(values))
        for name, mesh in hulls:
            made.append(Path(output).with_name(f"{Path(output).stem}{name}.gdf"))
            write_mesh(mesh, made[-1])
        if values.bodies:
            names = [path.name for path in made[-len(hulls) :]]
            made.append(Path(output).with_suffix(".pot"))
            write_whole(made[-1], pot_of(values, names).encode("ascii"))
    if to == "wamit":
        made += _pairs_written(db, values, output)
    print("\n".join(map(str, made)))
    return tell(_left_out(db, values, to), new_console(stderr=True))


def _hulls(values):
    """Return ("", PanelMesh) of a body, or ("_barge", PanelMesh along the axes of the scene about its own point) of
    each of several"""
    for i, body in enumerate(values.bodies):
        yield f"_{body.name}", values.mesh.of_body(i).whole().moved(*np.negative(body.rotation_center))
    if not values.bodies:
        yield "", values.mesh


def _pairs_written(db, values, output):
    """[NAME.12d, NAME.12s] files written from the stored forces of wave pairs"""
    from hakobune.bem.formats.wamit_pairs import write_pairs
    from hakobune.bem.second_order.stored import GROUPS, read_forces

    weight = values.density * values.gravity
    there = [kind for kind, name in GROUPS.items() if read_group(db, name) is not None]
    return [write_pairs(read_forces(db, kind).forces, output, weight, db.bodies) for kind in there]


def format_of(flag, name):
    allowed = [one for one, kind in FORMATS.items() if flag == "from" or not kind.read_only]
    if name not in allowed:
        raise ValueError(f"--{flag} is {name!r}; allowed: {', '.join(allowed)}")
    return FORMATS[name]


def _default(database, to, kind):
    """NAME.1 beside NAME.h5, or NAME_wamit.1 where NAME.gdf is a mesh of the user's own"""
    place = database.with_name(database.stem + kind.ending)
    if to == "wamit" and place.with_suffix(".gdf").exists() and not place.exists():
        return database.with_name(f"{database.stem}_wamit{kind.ending}")
    return place


def _check_place(output, kind, fresh, database):
    if kind.folder:
        check_folder(output)
        taken = output.is_dir() and any(output.iterdir())
    else:
        check_place(output)
        if kind.module != "wamit":
            check_ending(output, (Path(kind.ending).suffix or kind.ending,))
        taken = output.exists()
        if kind.module == "wamit":  # and all files of that name, a hull among them
            beside = (output.with_suffix(suffix) for suffix in OF_WAMIT)
            taken = next((path for path in beside if path.exists()), None)
            output = taken or output
    if output.exists() and output.resolve() == Path(database).resolve():
        raise ValueError(f"{output} is the database itself; give another name by --output")
    if taken and not fresh:
        raise ValueError(f"{output} exists already; give --fresh to replace it, or another name by --output")


def _limits_stood_for(values, endless):
    """What stands in the rows of the limits of the frequency, which HydroDyn and RAFT need, where no number is known

    endless : {name: (6, 6)} limits with entries that are not finite
    """
    for name, at in zip(LIMITS, (0, -1), strict=True):
        near = f"that at {values.omega[at]:g} rad/s is in its place, as HydroDyn needs a number there"
        if name in endless:
            i, j = (~np.isfinite(endless[name])).nonzero()
            pairs = ", ".join(f"{_motion(a)}–{_motion(b)}" for a, b in zip(i, j, strict=True))
            why = " (over a flat bed that of a motion that moves volume grows without limit)" if at == 0 else ""
            yield f"{name} is not finite for {pairs}{why}, {near}; responses to waves do not use it"
        elif values.get(name) is None:
            yield f"{name} is not stored, {near}; solve the scene with 'limits' in want to have it"


def _motion(index):
    """Name of a motion, with the number of its body from the second on"""
    body, motion = divmod(int(index), 6)
    return DOFS[motion].lower() + (f" {body + 1}" if body else "")


def _left_out(db, values, to):
    if not db.rows.all():
        yield fails(
            f"only {db.rows.sum()} of {len(db.rows)} frequencies of {db.path} are solved, and only these are written; "
            "to write all, run the command that made the database again, then this one with --fresh"
        )
    gaps = gaps_of(db)
    yield from map(fails, gaps._replace(unknown={n: m for n, m in gaps.unknown.items() if n in CARRIED}).not_known())
    known = {name: db[name] for name in LIMITS if name in db.names} if db.complete else {}
    endless = {name: matrix for name, matrix in known.items() if not np.all(np.isfinite(matrix))}
    if to in BY_WAMIT:
        yield from _limits_stood_for(values, endless)
    elif endless:
        yield f"{', '.join(endless)} is not finite and is not written"
    if "rao" not in NOT_HELD[to] and values.get("rao") is not None and (viscous := _viscous(db)):
        yield (f"the written motions include the viscous damping of the scene, {viscous}, which the format cannot hold")
    lost = _not_held(db, to)
    if lost:
        yield f"the format of {to} cannot hold {', '.join(lost)}"
    if to in (*BY_WAMIT, "nemoh") and values.bodies:
        points = "; ".join(f"{b.name} ({', '.join(f'{x:g}' for x in b.rotation_center)}) m" for b in values.bodies)
        yield f"all bodies are in the axes of the scene; moments and rotations are about these points: {points}"
    if to == "wamit" and np.any(values.rotation_center):
        about = ", ".join(f"{x:g}" for x in values.rotation_center)
        yield (
            f"moments and rotations are about ({about}) m, which these files do not contain; give --about when they "
            f"are imported"
        )


def _viscous(db):
    """Motions that have viscous damping in a database, as text"""
    found = db.bodies_reader.viscous if db.has_viscous_motions else None
    return ", ".join(name.lower() for name in found.laws) if found else ""


def _not_held(db, to):
    """Names of quantities of a database that a format cannot hold"""
    beyond = NOT_HELD[to]
    if to in BY_WAMIT and not db.bodies:  # one drift, of the floating body if there is one
        beyond = ("drift_force_fixed",) if "drift_force" in db.names else ()
    return [name for name in db.names if name not in CARRIED] + [name for name in beyond if name in db.names]
