"""Import of another program's results into a database; data that contradict the hull are refused."""

import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np

from hakobune.bem.database import append, append_limit, create, open_database, writing
from hakobune.bem.database.file import Header, check_place
from hakobune.bem.database.schema import BESIDE, DOFS, LIMITS
from hakobune.bem.formats.afloat import on_hull
from hakobune.bem.formats.judging.believed import believed
from hakobune.bem.formats.judging.laws import depth_of
from hakobune.bem.formats.values import FormatError, body_of, with_headings_once
from hakobune.bem.kernels.progress import CAUSE, OWN, progress_callback
from hakobune.bem.modes import names_of
from hakobune.meshing.files import read_mesh, wetted
from hakobune.meshing.mirror import folded
from hakobune.meshing.quality import findings
from hakobune.meshing.whole_files import made_beside
from hakobune.mooring.criteria.failing import fails

from ..common.bounds import told
from ..common.outputs import DATABASE, check_ending
from ..printing.console import new_console
from ..printing.verdict import tell
from .command import format_of

LID = 1e-6  # height over the draft from which panels are above the water
NODES_WORTH_ASKING = 600  # of an own solution; with fewer it takes less than a second


def import_(place, kind_name, mesh, known, weight, output, fresh=False, correct=False):
    """Make the database and print its content; 1 if a frequency could not be stored.  Raises ValueError.

    known : water_depth, density, gravity, length_unit, rotation_center, body, each None if not given, and frequencies
        (from, to) in rad/s
    weight : `bem.formats.afloat.Weight`; correct : whether to correct the cause of a contradiction to our own solution
    """
    kind = format_of("from", kind_name)
    if not place.exists():
        raise ValueError(f"{place} does not exist")
    output = place.with_name(place.stem + "_imported.h5") if output is None else output
    check_import(kind, known, output, fresh, place)
    module = import_module(f"hakobune.bem.formats.{kind.module}")
    of_module, said = asked_of(module, kind, place, known)
    values = with_headings_once(read_set(module, place, of_module))
    if known["rotation_center"] is not None:
        values = replace(values, rotation_center=np.array(known["rotation_center"], float))
    panels = below_water(hull_of(place, kind, module, mesh, of_module))
    values, left_out = _finite(between(values, *known["frequencies"]))
    lost = [
        fails(f"{name} is not finite at {omega} rad/s; these frequencies are not stored: compute them again")
        for name, omega in left_out.items()
    ]
    pairs = pairs_of(place, kind_name, values, of_module)
    draft = -float(panels.points[:, 2].min())
    if not draft < values.water_depth:
        raise ValueError(
            f"the water is {values.water_depth:g} m deep, but {panels.name} has a draft of {draft:g} m; allowed: a "
            f"depth above the draft"
        )
    on_hull(values, panels, weight)  # volume, stiffness, mass first
    with progress_callback(_told_of_own):
        values, agreed, doubts = believed(values, panels, correct)
    values, remarks = on_hull(with_headings_once(values), panels, weight)
    remarks = (*remarks, *agreed, *_remarks(place, said, values))
    with made_beside(output) as partial:  # an existing file remains until the new one is complete
        store(values, panels, partial, f"{kind_name}: {place}")
        groups = store_pairs(partial, pairs, values)
    print(f"{output}: {len(values.omega)} frequencies, {len(values.wave_direction)} headings, ", end="")
    print(", ".join([*values.quantities, *groups]))
    stored = open_database(output).rows
    if not stored.all():
        lost.append(fails(f"{stored.sum()} of {len(stored)} frequencies could be stored in {output}"))
    lost += map(fails, doubts)
    of_hull = (fails(f"{panels.name}: {one.text}") for one in findings(panels) if one.severity == "error")
    return tell([*remarks, *of_hull, *lost], new_console(stderr=True))


def _told_of_own(stage, what):
    """Callback of `bem.kernels.progress`: says how long each solution takes that the set is compared with, if long, and
    what is sought"""
    if stage == CAUSE:
        print(what, file=sys.stderr, flush=True)
    if stage != OWN:
        return
    from hakobune.bem.panels.band.cost import seconds_alone

    prepared, omega = what
    if len(prepared.geometry.elements.nodes) >= NODES_WORTH_ASKING:
        total, nodes = prepared.problem.mesh.total, prepared.problem.nodes_per_panel
        finer = "" if nodes == 1 else f", {nodes} nodes on each"
        seconds = seconds_alone(prepared, omega)
        told(f"own solution of {total} panels{finer} at {omega:.4g} rad/s, to compare with:", seconds)


def read_set(module, place, known):
    """The Values; raises FormatError, which names the depth that fits damping and excitation if none is given"""
    try:
        return module.read(place, known)
    except FormatError as error:
        if "--depth is missing" not in str(error):
            raise
        depth = depth_of(module.read(place, known | {"water_depth": np.inf}))
        if depth is None:
            raise
        raise FormatError(f"{error}; with --depth {depth:.3g} damping and excitation would agree") from None


def check_import(kind, known, output, fresh, place):
    """Raise ValueError for missing or impossible flags, and for an existing file"""
    for name in kind.silent:
        if name in ("water_depth", "density", "gravity") and known[name] is not None and not known[name] > 0:
            raise ValueError(f"{name} is {known[name]:g}; allowed: above 0")
    length = known["length_unit"]
    if length is not None and not 0 < length < np.inf:
        raise ValueError(f"--length-unit is {length:g} m; allowed: above 0")
    if length is not None and "length_unit" not in kind.silent:
        raise ValueError("--length-unit is given, but these files define their units; it is for --from wamit only")
    check_place(output)
    check_ending(output, DATABASE)
    if output.exists() and (not fresh or output.resolve() == place.resolve()):
        raise ValueError(f"{output} exists already; give --fresh to replace it, or another name by --output")


def asked_of(module, kind, place, known):
    """Properties that the user must give for a format because its files lack them, and those found in input files
    beside them
    """
    asked = {name: known[name] for name in (*kind.silent, "body")}
    if not hasattr(module, "inputs_of"):
        return asked, ()
    inputs = module.inputs_of(place, asked)
    return asked | {"length_unit": inputs.length, "rotation_center": inputs.about}, inputs.said


def hull_of(place, kind, module, mesh, known):
    """The hull in its water, from --mesh or from the file of the results.  Raises ValueError.

    known["rotation_center"] : origin of the axes of that file, (3,) m; None or missing for axes at the water surface
    """
    origin = known.get("rotation_center")
    path = mesh
    if path is None and hasattr(module, "hull_of"):
        path = module.hull_of(place, known)
    if path is None or not path.resolve().is_file():
        near = Path(place).with_name(f"{Path(place).stem}_pan.dat")
        near = f" ({near}, beside the files)" if near.is_file() else ""
        near = f" ({path} does not exist)" if path else near
        raise ValueError(
            f"the hull is missing; give --mesh FILE{near}, where FILE is a file of panels, or a .toml that builds "
            "the hull of parts"
        )
    try:
        panels = read_mesh(path.resolve())
    except ValueError as error:
        if mesh is not None:
            raise
        raise ValueError(f"{error}; or give another mesh of this hull by --mesh") from None
    if mesh is None and hasattr(module, "drawn_at"):
        panels = panels.moved(*module.drawn_at(place, known))
    if mesh is None and origin is not None and np.any(origin):
        panels = wetted(panels.moved(*origin))  # a lid at the height of the axes
    for finding in findings(panels):
        if finding.severity != "error":
            print(f"{path}: {finding}", file=sys.stderr)
    return panels


def below_water(panels):
    """The PanelMesh below the water, of a hull with a freeboard or a lid, as AQWA's hulls may have; a message reports
    this.  Raises ValueError where nothing lies below."""
    low, top = (float(end(panels.points[:, 2])) for end in (np.min, np.max))
    if not top > LID * abs(low):
        return panels
    dry = int(np.count_nonzero(panels.vertices[..., 2].max(axis=1) > LID * abs(low)))
    wet = panels.clipped()
    print(
        f"{panels.name}: {dry} panels up to {top:.3g} m above the water are left out, or cut at z = 0; volume and "
        f"hydrostatic stiffness are of the hull below",
        file=sys.stderr,
    )
    return wet


def _remarks(place, said, values):
    yield from values.left_out
    for one in said:
        if one != "ULEN 1 m of " + place.with_suffix(".gdf").name:
            yield f"{one} is taken"
    if values.others:
        yield (
            "the files contain other bodies, or modes beyond the six of this body: these are held fixed and not stored"
        )
    idle = [name for name, size in zip(DOFS, _sizes(values), strict=True) if size == 0]
    if idle:
        yield f"the files do not contain {', '.join(idle)}: its added mass is stored as 0"
    if values.get("inertia_matrix") is None:
        yield (
            "the database has no inertia_matrix, so that no motions can be computed; give it by `hakobune body` "
            "with --gyration kxx,kyy,kzz, --center-of-gravity x,y,z and --mass"
        )


def _sizes(values):
    """Largest added mass of each motion; shape (6,)"""
    return np.abs(np.diagonal(values.get("added_mass"), axis1=1, axis2=2)).max(axis=0)


def pairs_of(place, kind_name, values, known):
    """[`QuadraticForces`] beside a set, on the bodies of `Values`"""
    if kind_name != "wamit":
        return []
    from hakobune.bem.formats.wamit_pairs import SUFFIXES, read_pairs

    found = (read_pairs(place, values.density * values.gravity, kind, known["length_unit"]) for kind in SUFFIXES)
    return [_of_bodies(forces, place, values, known) for forces in found if forces is not None]


def _of_bodies(forces, place, values, known):
    """Those on the bodies of `Values`, all that the file has or one of them"""
    count = forces.total.shape[-1] // 6
    if count == max(1, len(values.bodies)):
        return forces
    own = slice(6 * (body := body_of(place, count, known)), 6 * body + 6)
    return replace(forces, **{part: getattr(forces, part)[..., own] for part in ("squares", "bound_wave", "body")})


def store_pairs(output, pairs, values):
    """Names of the groups that forces of pairs are stored in"""
    if not pairs:
        return []
    from hakobune.bem.second_order.stored import GROUPS, Held, StoredForces, write_forces

    for forces in pairs:
        held = Held("rao" in values.quantities)
        write_forces(output, StoredForces(forces, held, names=names_of(values.bodies)))
    return [GROUPS[forces.kind] for forces in pairs]


def between(values, low, high):
    """Values at the frequencies from low to high, rad/s.  Raises ValueError if there are none."""
    kept = (values.omega >= low) & (values.omega <= high)
    if not kept.any():
        raise ValueError(
            f"--frequencies {low:g}:{high:g} selects no frequency; the files have {values.omega.min():.4g} to "
            f"{values.omega.max():.4g} rad/s"
        )
    if kept.all():
        return values
    some = {name: part if name in LIMITS else part[kept] for name, part in values.quantities.items()}
    return replace(values, omega=values.omega[kept], quantities=some)


def _finite(values):
    """Values at the frequencies at which all of them are finite, and {name: frequencies, as text} of the others

    Raises FormatError if none remains.
    """
    names = [name for name in values.quantities if name not in LIMITS]
    whole = {name: np.isfinite(values.quantities[name].reshape(len(values.omega), -1)).all(axis=1) for name in names}
    kept = np.all([*whole.values()], axis=0)
    if not kept.any():
        raise FormatError(
            "every frequency has numbers that are not finite, in "
            f"{', '.join(n for n, ok in whole.items() if not ok.all())}"
        )
    left = {name: ", ".join(f"{w:g}" for w in values.omega[~ok]) for name, ok in whole.items() if not ok.all()}
    if kept.all():
        return values, {}
    some = {name: part if name in LIMITS else part[kept] for name, part in values.quantities.items()}
    return replace(values, omega=values.omega[kept], quantities=some), left


def store(values, mesh, output, source):
    """Make a database of Values on their hull; half or a quarter of the hull is stored if it has mirror planes

    source : origin of the import
    """
    angles = np.linspace(0, 2 * np.pi, 4, endpoint=False)
    beside = {BESIDE: values.others} if values.others and not values.bodies else {}
    mesh = mesh if values.bodies or beside else folded(mesh)
    header = Header(
        mesh, None, values.water_depth, values.density, values.gravity, values.rotation_center, angles, values.body,
        attributes={"imported": source} | beside, bodies=values.bodies,
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
