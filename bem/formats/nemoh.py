"""A folder of Nemoh: Nemoh.cal, Mesh/ (hull, Hydrostatics.dat, KH.dat) and Results/*.tec, in SI and exp(−iωt) as here.

RadiationCoefficients.tec has a zone for each motion j: ω, then A_ij and B_ij of i = 1 … 6; ExcitationForce.tec,
DiffractionForce.tec and FKForce.tec one for each heading: ω, then amplitude and phase (rad) of i = 1 … 6. Nemoh.cal
gives frequencies and headings by first, last and count; frequencies or headings that are not evenly spaced are
refused.  Zones are counted, not named: Nemoh 2 calls the zones of the excitation "Diffraction force" too.
A set of N bodies has a zone for each motion of each body, 6N columns, and files Hydrostatics_0.dat, KH_0.dat and so
on; a fixed body has no motions. File names are accepted in any case of letters, because Nemoh 3 writes a folder
results/. Source: Nemoh v3 manual, LHEEA, École centrale de Nantes.
"""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import numbers_of
from hakobune.meshing.whole_files import write_whole

from ..modes import moving
from ..waves import wavenumber
from .values import FormatError, Values, body_of, evenly, lines_of, of_each

FORCES = {
    "ExcitationForce.tec": ("excitation_force", "Excitation force"),
    "DiffractionForce.tec": ("diffraction_force", "Diffraction force"),
    "FKForce.tec": ("Froude_Krylov_force", "FKforce"),
}
TITLE = 'VARIABLES="w (rad/s)"'


def write(values, place):
    """Write the folder.  Returns the paths.  Raises FormatError for frequencies that are not evenly spaced."""
    from hakobune.meshing.files import write_mesh

    A, B = values.need("added_mass", "radiation_damping")
    omegas = evenly("frequencies", values.omega, "rad/s", "as solved by --omega start:stop:count")
    degrees = np.degrees(values.wave_direction)
    headings = evenly("headings", degrees, "degrees", "as solved by --heading start:stop:count")
    place = Path(place)
    for folder in ("Mesh", "Results"):
        (place / folder).mkdir(parents=True, exist_ok=True)
    made, described = {}, []
    for i, one in enumerate(of_each(values)):
        counts, hull = (0, 0), f"{one.name}.dat"
        if values.mesh is not None:
            mesh = values.mesh.of_body(i).whole() if values.bodies else values.mesh
            write_mesh(mesh, place / "Mesh" / hull)
            counts = len(mesh.points), len(mesh.corners)
        fixed, number = bool(values.bodies) and values.bodies[i].fixed, f"_{i}" if values.bodies else ""
        described.append(_described(one.rotation_center, hull, counts, i + 1, fixed))
        made |= {f"Mesh/{name}{number}.dat": text for name, text in _still_water(one).items()}
    made["Nemoh.cal"] = _cal(values, described, omegas, headings)
    zones = [
        (f"Motion of body {d // 6 + 1:2d} in DoF {d % 6 + 1:2d}", _pairs(A[:, :, j], B[:, :, j]))
        for j, d in enumerate(moving(values.bodies))
    ]
    made["Results/RadiationCoefficients.tec"] = _tec(values.omega, ("A", "B"), zones)
    for file, (name, title) in FORCES.items():
        X = values.get(name)
        if X is not None:
            zones = [
                (f"{title} - beta = {beta:8.3f} deg", _pairs(np.abs(X[:, m]), np.angle(X[:, m])))
                for m, beta in enumerate(degrees)
            ]
            made[f"Results/{file}"] = _tec(values.omega, ("abs(F", "angle(F"), zones)
    for name, text in made.items():
        write_whole(place / name, text.encode("ascii"))
    return [place / name for name in made]


def _pairs(first, second):
    """Join two arrays (n, 6) column by column in turn, to (n, 12); of N bodies (n, 12N)"""
    return np.stack([first, second], axis=-1).reshape(len(first), -1)


def _tec(omega, names, zones):
    lines = [TITLE] + [f'"{names[0]}{i}" "{names[1]}{i}"' for i in range(1, zones[0][1].shape[1] // 2 + 1)]
    for title, rows in zones:
        lines.append(f'Zone t="{title}",I={len(omega):6d},F=POINT')
        lines += [" ".join(f"{x: .9E}" for x in (w, *row)) for w, row in zip(omega, rows, strict=True)]
    return "\n".join(lines) + "\n"


def _described(center, hull, counts, number, fixed):
    """Lines of one body in Nemoh.cal"""
    about = " ".join(f"{x:.6f}" for x in center)
    axes = [f"{kind} {axis} {about}" for kind in (1, 2) for axis in ("1. 0. 0.", "0. 1. 0.", "0. 0. 1.")]
    names = ("Surge", "Sway", "Heave", "Roll about a point", "Pitch about a point", "Yaw about a point")
    modes = [f"{axis}\t! {name}" for axis, name in zip(axes, names, strict=True)]
    moved = [] if fixed else modes
    return [
        f"--- Body {number} ---",
        f"Mesh/{hull}\t! Name of mesh file",
        f"{counts[0]} {counts[1]}\t! Number of points and number of panels",
        *(f"{len(moved)}\t! Number of degrees of freedom", *moved),
        *("6\t! Number of resulting generalised forces", *modes),
        "0\t! Number of lines of additional information",
    ]


def _cal(values, described, omegas, headings):
    depth = values.water_depth if np.isfinite(values.water_depth) else 0.0
    lines = [
        "--- Environment ---",
        f"{values.density:.9g}\t! RHO ! KG/M**3 ! Fluid specific volume",
        f"{values.gravity:.9g}\t! G ! M/S**2 ! Gravity",
        f"{depth:.9g}\t! DEPTH ! M ! Water depth",
        "0. 0.\t! XEFF YEFF ! M ! Wave measurement point",
        "--- Description of floating bodies ---",
        f"{len(described)}\t! Number of bodies",
        *(line for body in described for line in body),
        "--- Load cases to be solved ---",
        f"{omegas[2]} {omegas[0]:.9g} {omegas[1]:.9g}\t! Number of wave frequencies, Min, and Max (rad/s)",
        f"{headings[2]} {headings[0]:.9g} {headings[1]:.9g}\t! Number of wave directions, Min and Max (degrees)",
        "--- Post processing ---",
        *("0 0.1 10.\t! IRF", "0\t! Show pressure", "0 0. 180.\t! Kochin function", "0 0 100. 100.\t! Free surface"),
    ]
    return "\n".join(lines) + "\n"


def _still_water(values):
    """{name without ending: text} of one body"""
    cb, cg, volume, C = map(
        values.get, ("center_of_buoyancy", "center_of_mass", "displaced_volume", "hydrostatic_stiffness")
    )
    made = {}
    if cb is not None and cg is not None and volume is not None:
        lines = [f" {axis}F = {b:.6f} - {axis}G = {g:.6f}" for axis, b, g in zip("XYZ", cb, cg, strict=True)]
        made["Hydrostatics"] = "\n".join([*lines, f" Displacement = {float(volume):.9E}"]) + "\n"
    if C is not None:
        made["KH"] = "\n".join(" ".join(f"{x: .9E}" for x in row) for row in C) + "\n"
    return made


def read(place, known=None):
    """The Values of a folder; known : {"body": number from 1} if the folder has several bodies.  Raises FormatError."""
    place = Path(place)
    cal = _cal_of(_inside(place, "Nemoh.cal"))
    which = body_of(place, len(cal.bodies), known)
    body = cal.bodies[which]
    first, last = (
        sum(len(one.motions) for one in cal.bodies[:which]),
        sum(len(one.forces) for one in cal.bodies[:which]),
    )
    motions, forces = (
        [None if row is None else start + row for row in _six(place, rows)]
        for start, rows in ((first, body.motions), (last, body.forces))
    )
    results, columns = _inside(place, "Results"), sum(len(one.forces) for one in cal.bodies)
    omega, quantities = _radiation(results, cal, motions, forces)
    k = wavenumber(omega, cal.depth, cal.gravity)
    crest = np.cos(cal.headings) * cal.crest[0] + np.sin(cal.headings) * cal.crest[1]
    for file, (name, _) in FORCES.items():
        path = _inside(results, file)
        if path.exists():
            own, rows = _zones(path, len(cal.headings), columns)
            if len(own) != len(omega) or not np.allclose(own, omega, rtol=1e-6):
                missing = [f"{w:.5g}" for w in omega if not np.isclose(own, w, rtol=1e-6).any()]
                lacks = f"; it has no {', '.join(missing[:4])} rad/s" if missing else ""
                raise FormatError(
                    f"{path} does not have the frequencies of RadiationCoefficients.tec; allowed: the same "
                    f"frequencies{lacks}"
                )
            pairs = _taken(rows, forces, 2)
            X = (pairs[..., 0] * np.exp(1j * pairs[..., 1])).transpose(1, 0, 2)
            quantities[name] = X * np.exp(1j * k[:, None] * crest)[..., None]
    still = _body(_inside(place, "Mesh"), which, len(cal.bodies))
    return Values(omega, cal.headings, cal.depth, cal.density, cal.gravity, quantities, still,
                  _about(place, body), name=place.name, others=len(cal.bodies) - 1)  # fmt: skip


def _radiation(results, cal, motions, forces):
    """ω (n,) rad/s and added mass and damping of the motions and forces at these places, None for missing ones"""
    counts = (
        sum(len(rows) for rows in part) for part in zip(*((b.motions, b.forces) for b in cal.bodies), strict=True)
    )
    omega, rows = _zones(_inside(results, "RadiationCoefficients.tec"), *counts)
    square = _taken(_taken(rows, motions, 0), forces, 2)
    names = "added_mass", "radiation_damping"
    return omega, {name: square[..., i].transpose(1, 2, 0) for i, name in enumerate(names)}


def coupled(place, known, count):
    """{quantity: array} of added mass and damping of `count` bodies together, (n, 6 count, 6 count).

    known : ignored.  Raises FormatError.
    """
    place = Path(place)
    cal, motions, forces = _cal_of(_inside(place, "Nemoh.cal")), [], []
    for body in cal.bodies[:count]:
        for all_rows, own in ((motions, body.motions), (forces, body.forces)):
            start = sum(row is not None for row in all_rows)
            all_rows += [None if row is None else start + row for row in _six(place, own)]
    return _radiation(_inside(place, "Results"), cal, motions, forces)[1]


def hull_of(place, known=None):
    """The file of the hull named in Nemoh.cal, or None if it is missing.  Raises FormatError."""
    place = Path(place)
    cal = _cal_of(_inside(place, "Nemoh.cal"))
    mesh = cal.bodies[body_of(place, len(cal.bodies), known)].mesh
    *folders, name = re.split(r"[\\/]", mesh)
    found = place
    for part in (*(folders or ["Mesh"]), name):
        found = _inside(found, part)
    there = [found, _inside(place, name)]
    return next((path for path in there if path.is_file()), None)


def _inside(folder, name):
    """A path in a folder, with any case of its letters"""
    if (folder / name).exists() or not folder.is_dir():
        return folder / name
    return next((path for path in folder.iterdir() if path.name.lower() == name.lower()), folder / name)


class Body(NamedTuple):
    """mesh : name of the mesh file; motions, forces : rows of kind (1 or 2), direction (3), point (3)"""

    mesh: str
    motions: list
    forces: list


class Cal(NamedTuple):
    """Content of Nemoh.cal in SI. headings : (m,) rad; crest : point (x, y) to which phases refer, m; bodies :
    [Body]"""

    density: float
    gravity: float
    depth: float
    crest: tuple
    bodies: list
    headings: np.ndarray


def _cal_of(path):
    """`Cal` of a file, by the place of its lines, as Nemoh reads it.  Raises FormatError."""
    lines = iter([line for line in lines_of(path) if line.strip() and not line.lstrip().startswith("---")])

    def numbers(least):
        line = next(lines, "")
        found = numbers_of(line.split("!")[0])
        if len(found) < least:
            raise FormatError(f"{path}: expected {least} number(s), found {line.strip()!r}")
        return found

    density, gravity, depth = (numbers(1)[0] for _ in range(3))
    crest = numbers(2)[:2]
    bodies = []
    for _ in range(int(numbers(1)[0])):
        mesh = next(lines, "").split("!")[0].strip()
        numbers(2)
        motions, forces = ([numbers(7)[:7] for _ in range(int(numbers(1)[0]))] for _ in range(2))
        for _ in range(int(numbers(1)[0])):
            next(lines, None)
        bodies.append(Body(mesh, motions, forces))
    numbers(3)  # frequencies, which are also in the results
    count, first, last = numbers(3)[:3]
    headings = np.radians(np.linspace(first, last, int(count)))
    return Cal(density, gravity, depth or np.inf, tuple(crest), bodies, headings)


def _six(place, rows):
    """Number of our motion or force for each of those given, None without one; shape (6,).  Raises FormatError for
    others."""
    out = [None] * 6
    for number, (kind, *direction) in enumerate(rows):
        axis = np.flatnonzero(np.abs(np.array(direction[:3])) > 1e-9)
        if kind not in (1, 2) or len(axis) != 1 or direction[axis[0]] <= 0:
            raise FormatError(
                f"{place / 'Nemoh.cal'} has a motion or force of kind {kind:g} along {direction[:3]}; allowed: "
                "surge to yaw, along and about the axes"
            )
        out[int(3 * (kind - 1) + axis[0])] = number
    return out


def _taken(rows, places, axis):
    """Six rows along an axis by their indices, zero for missing ones"""
    parts = [np.zeros_like(np.take(rows, 0, axis)) if at is None else np.take(rows, at, axis) for at in places]
    return np.stack(parts, axis)


def _about(place, body):
    """Point of rotations and moments, m; shape (3,).  Raises FormatError for several points."""
    points = [row[4:7] for row in (*body.motions, *body.forces) if row[0] == 2]
    if not points:
        return np.zeros(3)
    if np.ptp(np.array(points), axis=0).any():
        raise FormatError(f"{place / 'Nemoh.cal'} has rotations or moments about several points; allowed: about one")
    return np.array(points[0])


def _zones(path, count, columns):
    """ω (n,) and numbers (zones, n, columns, 2) of a .tec file"""
    head, tables = "", [[]]
    for line in lines_of(path):
        try:
            row = [float(word) for word in line.split()]
        except ValueError:  # a title, which ends the previous table
            head += line
            tables += [[]] if tables[-1] else []
            continue
        tables[-1] += [row] if row else []
    tables = [table for table in tables if table]
    try:
        rows = np.array(tables)
    except ValueError:
        raise FormatError(f"{path}: a zone is not a complete table of numbers") from None
    if rows.ndim != 3:
        raise FormatError(f"{path} has no table of numbers")
    if len(tables) != count or rows.shape[2] != 2 * columns + 1:
        raise FormatError(
            f"{path} has {len(tables)} zones of {rows.shape[2]} numbers a line; Nemoh.cal asks for {count} "
            f"zones of {2 * columns + 1} numbers"
        )
    first = rows[0, :, 0]
    first = 2 * np.pi * first if "(Hz)" in head else 2 * np.pi / first if "T (s)" in head else first
    order = np.argsort(first)
    return first[order], rows[:, order, 1:].reshape(len(rows), len(first), columns, 2)


def _body(folder, which, count):
    """Content of Hydrostatics.dat and KH.dat, with _0, _1 … for several bodies"""
    own = f"_{which}" if count > 1 else ""
    whole, first = _inside(folder, "KH.dat"), _inside(folder, "KH_0.dat")
    if count > 1 and whole.exists() and first.exists() and np.array_equal(np.loadtxt(whole), np.loadtxt(first)):
        return {}  # Nemoh 3.0 writes the sum of all bodies for each
    body, still, stiffness = {}, _inside(folder, f"Hydrostatics{own}.dat"), _inside(folder, f"KH{own}.dat")
    if still.exists():
        found = [re.findall(r"=\s*([-+.\deE]+)", line) for line in lines_of(still)[:4]]
        body["center_of_buoyancy"] = np.array([float(pair[0]) for pair in found[:3]])
        body["center_of_mass"] = np.array([float(pair[1]) for pair in found[:3]])
        body["displaced_volume"] = float(found[3][0])
    if stiffness.exists():
        body["hydrostatic_stiffness"] = np.loadtxt(stiffness)[:6, :6]
    return body
