"""Databases out to the files of other programs and in from them; what is left out is said."""

from __future__ import annotations

import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bem.database import append, append_limit, create, open_database, writing
from bem.database.file import Header, check_place
from bem.database.schema import LIMITS
from bem.database.widening import read_group
from bem.formats.values import CARRIED, FormatError, values_of
from meshing.files import read_mesh
from meshing.hydrostatics import hydrostatics
from meshing.quality import findings

from ..common.outputs import DATABASE, check_ending, check_folder

GEOMETRY = ("displaced_volume", "wetted_area", "center_of_buoyancy", "waterplane_area")


class Format(NamedTuple):
    """module : of `bem.formats`; ending : of the default name; folder : whether it is one

    hull : where its mesh lies, seen from the place that is read; silent : what of the water its files do not say
    """

    module: str
    ending: str
    folder: bool = False
    hull: str = ""
    silent: tuple[str, ...] = ()


FORMATS = {
    "wamit": Format("wamit", ".1", hull="../{stem}.gdf", silent=("water_depth", "density", "gravity")),
    "nemoh": Format("nemoh", "_nemoh", True),
    "hams": Format("hams", "_hams", True, "Input/HullMesh.pnl", ("density", "gravity")),
    "bemio": Format("bemio", "_bemio.h5"),
    "hydrochrono": Format("bemio", "_hydrochrono.h5"),
    "capytaine": Format("capytaine", ".nc"),
    "orcaflex": Format("orcaflex", ".yml", silent=("gravity",)),
}


def export(database, to, output, fresh):
    """Write the files and say which; 1 where frequencies of the database are not solved yet.  Raises ValueError."""
    kind, db = _format("to", to), open_database(database)
    output = database.with_name(database.stem + kind.ending) if output is None else output
    _check_place(output, kind, fresh, database)
    values = values_of(db)
    made = import_module(f"bem.formats.{kind.module}").write(values, output)
    if to == "wamit" and values.mesh is not None:
        from meshing.files import write_mesh

        made.append(Path(output).with_suffix(".gdf"))
        write_mesh(values.mesh, made[-1])
    if to == "wamit":
        made += _pairs_written(db, values, output)
    print("\n".join(map(str, made)))
    for remark in _left_out(db, values, to):
        print(f"warning: {remark}", file=sys.stderr)
    return 0 if db.rows.all() else 1


def _pairs_written(db, values, output):
    """[NAME.12d, NAME.12s] of what forces of pairs the database has"""
    from bem.formats.wamit_pairs import write_pairs
    from bem.second_order.stored import GROUPS, read_forces

    weight = values.density * values.gravity
    there = [kind for kind, name in GROUPS.items() if read_group(db, name) is not None]
    return [write_pairs(read_forces(db, kind).forces, output, weight) for kind in there]


def _format(flag, name):
    if name not in FORMATS:
        raise ValueError(f"--{flag} is {name!r}; allowed: {', '.join(FORMATS)}")
    return FORMATS[name]


def _check_place(output, kind, fresh, database):
    if kind.folder:
        check_folder(output)
        taken = output.is_dir() and any(output.iterdir())
    else:
        check_place(output)
        if kind.module != "wamit":
            check_ending(output, (Path(kind.ending).suffix or kind.ending,))
        taken = (output.with_suffix(".1") if kind.module == "wamit" else output).exists()
    if output.exists() and output.resolve() == Path(database).resolve():
        raise ValueError(f"{output} is the database itself; give another name by --output")
    if taken and not fresh:
        raise ValueError(f"{output} is there already; give --fresh to replace it, or another name by --output")


def _left_out(db, values, to):
    if not db.rows.all():
        yield f"{db.path} has {db.rows.sum()} of {len(db.rows)} frequencies solved, which are written"
    lost = [name for name in db.names if name not in CARRIED]
    endless = [name for name in LIMITS if name in db.names and not np.all(np.isfinite(db[name]))] if db.complete else []
    if endless:
        yield f"{', '.join(endless)} is not finite and left out"
    if to not in ("wamit", "hams"):
        lost += [name for name in ("rao", "drift_force", "drift_force_fixed") if name in db.names]
        if to == "orcaflex":
            kept, gone = ("rao",), ("Froude_Krylov_force", "diffraction_force", "added_mass_zero")
            lost = [name for name in lost if name not in kept] + [name for name in gone if name in db.names]
        lost = [name for name in lost if name != "drift_force" or to not in ("bemio", "hydrochrono")]
    elif "drift_force" in db.names and "drift_force_fixed" in db.names:
        lost.append("drift_force_fixed")
    if lost:
        yield f"{to} has no place for {', '.join(lost)}"
    if to in ("wamit", "bemio", "hydrochrono") and np.any(values.rotation_center):
        about = ", ".join(f"{x:g}" for x in values.rotation_center)
        yield f"moments and rotations are about ({about}) m, which these files do not say"


def import_(place, kind_name, mesh, known, output):
    """Make the database and say what is in it.  Raises ValueError."""
    kind = _format("from", kind_name)
    if not place.exists():
        raise ValueError(f"{place} does not exist")
    if "water_depth" in kind.silent and known["water_depth"] is None:
        raise ValueError("--depth is missing; files of WAMIT do not say it; allowed: above 0 m, or inf")
    for name in kind.silent:
        if not known[name] > 0:
            raise ValueError(f"{name} is {known[name]:g}; allowed: above 0")
    output = place.with_name(place.stem + "_imported.h5") if output is None else output
    check_place(output)
    check_ending(output, DATABASE)
    if output.exists():
        raise ValueError(f"{output} is there already; give another name by --output")
    module = import_module(f"bem.formats.{kind.module}")
    values = module.read(place, {name: known[name] for name in kind.silent})
    hull = mesh or (place / kind.hull.format(stem=place.stem) if kind.hull else None)
    if hull is None and hasattr(module, "hull_of"):
        hull = module.hull_of(place)
    if hull is None or not hull.resolve().is_file():
        raise ValueError(f"the hull is missing; give its mesh by --mesh{f', {hull} is not there' if hull else ''}")
    values, left_out = _finite(values)
    for name, omega in left_out.items():
        print(f"warning: {name} is not finite at {omega} rad/s, left out with all else there", file=sys.stderr)
    pairs = []
    if kind_name == "wamit":
        from bem.formats.wamit_pairs import SUFFIXES, read_pairs

        found = (read_pairs(place, values.density * values.gravity, kind) for kind in SUFFIXES)
        pairs = [forces for forces in found if forces is not None]
    panels = read_mesh(hull.resolve())
    for finding in findings(panels):
        print(f"{hull}: {finding}", file=sys.stderr)
    draft = -float(panels.points[:, 2].min())
    if not draft < values.water_depth:
        raise ValueError(
            f"the water is {values.water_depth:g} m deep and {hull} draws {draft:g} m; allowed: deeper water"
        )
    _store(values, panels, output, f"{kind_name}: {place}")
    groups = []
    if pairs:
        from bem.second_order.stored import GROUPS, Held, StoredForces, write_forces

        groups = [GROUPS[forces.kind] for forces in pairs]
        for forces in pairs:
            write_forces(output, StoredForces(forces, Held("rao" in values.quantities)))
    print(f"{output}: {len(values.omega)} frequencies, {len(values.wave_direction)} headings, ", end="")
    print(", ".join([*values.quantities, *groups]))
    lacking = [name for name in ("inertia_matrix", "mass") if values.get(name) is None]
    if lacking:
        print(f"warning: no {' and '.join(lacking)} in it: no motions follow from this database", file=sys.stderr)
    return 0


def _finite(values):
    """Values at the frequencies at which all of them are finite, and {name: frequencies, as text} of the others

    Raises FormatError where none is left.
    """
    names = [name for name in values.quantities if name not in LIMITS]
    whole = {name: np.isfinite(values.quantities[name].reshape(len(values.omega), -1)).all(axis=1) for name in names}
    kept = np.all([*whole.values()], axis=0)
    if not kept.any():
        raise FormatError(
            f"no frequency has only finite numbers: {', '.join(n for n, ok in whole.items() if not ok.all())}"
        )
    left = {name: ", ".join(f"{w:g}" for w in values.omega[~ok]) for name, ok in whole.items() if not ok.all()}
    if kept.all():
        return values, {}
    some = {name: part if name in LIMITS else part[kept] for name, part in values.quantities.items()}
    return replace(values, omega=values.omega[kept], quantities=some), left


def _store(values, mesh, output, source):
    body = dict(values.body)
    center = body.get("center_of_mass", np.zeros(3))
    water = {"density": values.density, "gravity": values.gravity, "rotation_center": values.rotation_center}
    still = hydrostatics(mesh, center_of_mass=center, mass=body.get("mass"), **water)
    geometry = (still.volume, still.wetted_area, still.center_of_buoyancy, still.waterplane_area)
    body = dict(zip(GEOMETRY, geometry, strict=True)) | body
    if "displaced_volume" in values.body and abs(body["displaced_volume"] / still.volume - 1) > 0.02:
        raise FormatError(
            f"the mesh displaces {still.volume:.4g} m³, the results are of {body['displaced_volume']:.4g} m³; "
            "allowed: within 2 %; give the mesh they were made with"
        )
    angles = np.linspace(0, 2 * np.pi, 4, endpoint=False)
    header = Header(
        mesh, None, values.water_depth, values.density, values.gravity, values.rotation_center, angles, body,
        attributes={"imported": source},
    )  # fmt: skip
    headings = values.wave_direction if len(values.wave_direction) else np.zeros(1)
    create(output, header, values.omega, headings, tuple(values.quantities))
    rows = {name: value for name, value in values.quantities.items() if name not in LIMITS}
    with writing(output) as file:
        for i, omega in enumerate(values.omega):
            append(file, omega, headings, {name: value[i] for name, value in rows.items()})
        for name in LIMITS:
            if name in values.quantities:
                append_limit(file, name, values.quantities[name])
