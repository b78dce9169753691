"""Import of another program's results for several bodies, all of which move, into one database.

Each body is read from the files as a body that moves beside the others, and is checked by the laws for such a body.
Then added mass and damping of all bodies together are read.  If bodies of revolution about one vertical have one
heading, all other headings
follow by rotation.
"""

from dataclasses import replace
from importlib import import_module

import numpy as np

from hakobune.bem.database.schema import BODY
from hakobune.bem.formats.afloat import on_hull
from hakobune.bem.formats.judging.believed import believed
from hakobune.bem.formats.values import FormatError, with_headings_once
from hakobune.bem.modes import Body, turned
from hakobune.meshing.mirror import folded
from hakobune.meshing.panels import assembled, with_symmetry
from hakobune.meshing.whole_files import made_beside
from hakobune.mooring.criteria.failing import fails

from ..printing.console import new_console
from ..printing.verdict import tell
from .command import FORMATS, format_of
from .importing import asked_of, below_water, between, check_import, hull_of, pairs_of, read_set, store, store_pairs

FORCES = ("excitation_force", "Froude_Krylov_force", "diffraction_force")
AROUND = np.arange(12) * (np.pi / 6)
AXIS = 1e-3  # largest distance of the axis of a hull of revolution from the origin, over its length


def import_several(place, kind_name, names, meshes, known, weights, output, fresh=False, uncoupled=False):
    """Make the database of the bodies called `names` and print its content; returns the exit status.  Raises
    ValueError.

    known : as in `importing.import_`, without a body; weights : `bem.formats.afloat.Weight` of each
    uncoupled : whether to omit added mass and damping between different bodies, as WEC-Sim does (b2b = 0)
    """
    kind = format_of("from", kind_name)
    module = import_module(f"hakobune.bem.formats.{kind.module}")
    if not hasattr(module, "coupled"):
        able = ", ".join(
            name for name, one in FORMATS.items() if one.module not in ("orcaflex", "diodore", "hydrostar")
        )
        raise ValueError(
            f"--bodies is given with --from {kind_name}; allowed with {able}; for one body of several give --body"
        )
    if len(set(names)) < len(names) or not all(names):
        raise ValueError(f"--bodies is {','.join(names)!r}; give each body a different name")
    output = place.with_name(place.stem + "_imported.h5") if output is None else output
    check_import(kind, known, output, fresh, place)
    parts, hulls, remarks, lost = [], [], [], []
    for number, (name, weight, mesh) in enumerate(zip(names, weights, meshes, strict=True), 1):
        of_module = asked_of(module, kind, place, known | {"body": number})[0]
        values = with_headings_once(read_set(module, place, of_module))
        if values.others + 1 != len(names):
            raise FormatError(
                f"{place} has {values.others + 1} bodies, and --bodies names {len(names)}; name all of them"
            )
        hull = below_water(hull_of(place, kind, module, mesh, of_module))
        values, said = on_hull(values, hull, weight)
        _, agreed, doubts = believed(values, hull)
        remarks += [f"{name}: {one}" for one in (*said, *agreed)]
        lost += [fails(f"{name}: {one}") for one in doubts]
        parts.append(values)
        hulls.append(hull)
    radiation = module.coupled(place, of_module, len(names))
    if uncoupled:
        own = np.kron(np.eye(len(names)), np.ones((6, 6)))
        radiation = {name: part * own for name, part in radiation.items()}
        remarks.append("left out: added mass and damping on each body due to motions of the others")
    values = _together(parts, radiation)
    if len(values.wave_direction) == 1 and _round(hulls):
        values = _all_around(values)
        remarks.append(
            "forces at other headings follow from those at the stored headings, since the bodies are of "
            "revolution about one axis"
        )
    values = between(values, *known["frequencies"])
    points = [tuple(map(float, one.rotation_center)) for one in parts]
    bodies = tuple(Body(name, point) for name, point in zip(names, points, strict=True))
    mesh = assembled([with_symmetry(folded(hull), "") for hull in hulls])
    values = replace(values, bodies=bodies, rotation_center=np.zeros(3))
    pairs = pairs_of(place, kind_name, values, of_module)
    with made_beside(output) as partial:
        store(values, mesh, partial, f"{kind_name}: {place}")
        groups = ", ".join(("", *store_pairs(partial, pairs, values)))
    what = f"{len(values.omega)} frequencies, {len(values.wave_direction)} headings{groups}"
    print(f"{output}: {', '.join(names)}, {what}")
    return tell([*remarks, *lost], new_console(stderr=True))


def _together(parts, radiation):
    """Values of all bodies from those of each, with the radiation of all"""
    forces = {
        name: np.concatenate([one.quantities[name] for one in parts], axis=-1)
        for name in FORCES
        if all(name in one.quantities for one in parts)
    }
    body = {}
    for name in BODY:
        rows = [one.body.get(name) for one in parts]
        if all(row is not None for row in rows):
            square = BODY[name][0][-1:] == ("radiating_dof",)
            body[name] = _blocks(rows) if square else np.array(rows, float)
    return replace(parts[0], quantities=radiation | forces, body=body)


def _blocks(matrices):
    """Matrix (6N, 6N) with matrices (6, 6) on its diagonal"""
    total = np.zeros((6 * len(matrices),) * 2)
    for i, matrix in enumerate(matrices):
        total[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] = matrix
    return total


def _round(hulls):
    """Whether all hulls are of revolution about the vertical through the origin"""
    return all(
        hull.is_round and np.abs(hull.points[:, :2].mean(axis=0)).max() <= AXIS * np.ptp(hull.points[:, 0])
        for hull in hulls
    )


def _all_around(values):
    """Values of bodies of revolution with their forces at AROUND, from those at one heading"""
    (first,) = values.wave_direction
    turns = np.array(
        [np.kron(np.eye(values.quantities["added_mass"].shape[-1] // 6), turned(b - first)) for b in AROUND]
    )
    quantities = {
        name: np.einsum("mji,qj->qmi", turns, part[:, 0]) if name in FORCES else part
        for name, part in values.quantities.items()
    }
    return replace(values, wave_direction=AROUND, quantities=quantities)
