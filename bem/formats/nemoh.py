"""A folder of Nemoh: Nemoh.cal, Mesh/ (hull, Hydrostatics.dat, KH.dat) and Results/*.tec, in SI and exp(−iωt) as ours.

RadiationCoefficients.tec has a zone for each motion j: ω, then A_ij and B_ij of i = 1 … 6; ExcitationForce.tec,
DiffractionForce.tec and FKForce.tec one for each heading: ω, then amplitude and phase (rad) of i = 1 … 6.
Nemoh.cal knows frequencies and headings by first, last and count: others are refused.  Zones are counted, not named:
Nemoh 2 calls those of the excitation "Diffraction force" too.  Names are taken in any case, as Nemoh 3 writes results/.
G. Delhommeau, C. Lheea, École centrale de Nantes, Nemoh v3 manual.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hakobune.meshing.whole_files import write_whole

from .values import FormatError, Values, evenly, lines_of

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
    counts, hull = (0, 0), f"{values.name}.dat"
    made = {}
    if values.mesh is not None:
        write_mesh(values.mesh, place / "Mesh" / hull)
        counts = len(values.mesh.points), len(values.mesh.corners)
    made["Nemoh.cal"] = _cal(values, hull, counts, omegas, headings)
    made |= {f"Mesh/{name}": text for name, text in _still_water(values).items()}
    zones = [(f"Motion of body  1 in DoF  {j + 1}", _pairs(A[:, :, j], B[:, :, j])) for j in range(6)]
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
    """(n, 12) of two (n, 6), in turn"""
    return np.stack([first, second], axis=-1).reshape(len(first), -1)


def _tec(omega, names, zones):
    lines = [TITLE] + [f'"{names[0]}{i}" "{names[1]}{i}"' for i in range(1, 7)]
    for title, rows in zones:
        lines.append(f'Zone t="{title}",I={len(omega):6d},F=POINT')
        lines += [" ".join(f"{x: .9E}" for x in (w, *row)) for w, row in zip(omega, rows, strict=True)]
    return "\n".join(lines) + "\n"


def _cal(values, hull, counts, omegas, headings):
    depth = values.water_depth if np.isfinite(values.water_depth) else 0.0
    about = " ".join(f"{x:.6f}" for x in values.rotation_center)
    axes = [f"{kind} {axis} {about}" for kind in (1, 2) for axis in ("1. 0. 0.", "0. 1. 0.", "0. 0. 1.")]
    names = ("Surge", "Sway", "Heave", "Roll about a point", "Pitch about a point", "Yaw about a point")
    modes = [f"{axis}\t! {name}" for axis, name in zip(axes, names, strict=True)]
    lines = [
        "--- Environment ---",
        f"{values.density:.9g}\t! RHO ! KG/M**3 ! Fluid specific volume",
        f"{values.gravity:.9g}\t! G ! M/S**2 ! Gravity",
        f"{depth:.9g}\t! DEPTH ! M ! Water depth",
        "0. 0.\t! XEFF YEFF ! M ! Wave measurement point",
        "--- Description of floating bodies ---",
        "1\t! Number of bodies",
        "--- Body 1 ---",
        f"Mesh/{hull}\t! Name of mesh file",
        f"{counts[0]} {counts[1]}\t! Number of points and number of panels",
        *("6\t! Number of degrees of freedom", *modes),
        *("6\t! Number of resulting generalised forces", *modes),
        "0\t! Number of lines of additional information",
        "--- Load cases to be solved ---",
        f"{omegas[2]} {omegas[0]:.9g} {omegas[1]:.9g}\t! Number of wave frequencies, Min, and Max (rad/s)",
        f"{headings[2]} {headings[0]:.9g} {headings[1]:.9g}\t! Number of wave directions, Min and Max (degrees)",
        "--- Post processing ---",
        *("0 0.1 10.\t! IRF", "0\t! Show pressure", "0 0. 180.\t! Kochin function", "0 0 100. 100.\t! Free surface"),
    ]
    return "\n".join(lines) + "\n"


def _still_water(values):
    cb, cg, volume, C = map(
        values.get, ("center_of_buoyancy", "center_of_mass", "displaced_volume", "hydrostatic_stiffness")
    )
    made = {}
    if cb is not None and cg is not None and volume is not None:
        lines = [f" {axis}F = {b:.6f} - {axis}G = {g:.6f}" for axis, b, g in zip("XYZ", cb, cg, strict=True)]
        made["Hydrostatics.dat"] = "\n".join([*lines, f" Displacement = {float(volume):.9E}"]) + "\n"
    if C is not None:
        made["KH.dat"] = "\n".join(" ".join(f"{x: .9E}" for x in row) for row in C) + "\n"
    return made


def read(place, known=None):
    """The Values of a folder.  Raises FormatError."""
    place = Path(place)
    said = _said(_inside(place, "Nemoh.cal"))
    density, gravity, depth = (said(text)[0] for text in ("Fluid specific volume", "Gravity", "Water depth"))
    count, first, last = said("Number of wave directions")[:3]
    headings = np.radians(np.linspace(first, last, int(count)))
    results = _inside(place, "Results")
    omega, rows = _zones(_inside(results, "RadiationCoefficients.tec"), 6)
    quantities = {
        "added_mass": rows[..., 0::2].transpose(1, 2, 0),
        "radiation_damping": rows[..., 1::2].transpose(1, 2, 0),
    }
    for file, (name, _) in FORCES.items():
        path = _inside(results, file)
        if path.exists():
            own, rows = _zones(path, len(headings))
            if len(own) != len(omega) or not np.allclose(own, omega, rtol=1e-6):
                raise FormatError(f"{path} has other frequencies than RadiationCoefficients.tec; allowed: the same")
            quantities[name] = (rows[..., 0::2] * np.exp(1j * rows[..., 1::2])).transpose(1, 0, 2)
    body, about = _body(_inside(place, "Mesh")), _about(place, said)
    return Values(omega, headings, depth or np.inf, density, gravity, quantities, body, about, name=place.name)


def hull_of(place):
    """The file of the hull that Nemoh.cal names; None where it is not there.  Raises FormatError."""
    place = Path(place)
    path = _inside(place, "Nemoh.cal")
    for line in lines_of(path):
        if "Name of mesh file" in line:
            *folders, name = re.split(r"[\\/]", line.split("!")[0].strip())
            found = place
            for part in (*(folders or ["Mesh"]), name):
                found = _inside(found, part)
            there = [found, _inside(place, name)]
            return next((path for path in there if path.is_file()), None)
    return None


def _inside(folder, name):
    """A path of a folder, in whichever case it is written there"""
    if (folder / name).exists() or not folder.is_dir():
        return folder / name
    return next((path for path in folder.iterdir() if path.name.lower() == name.lower()), folder / name)


def _about(place, said):
    """(3,) m, the point that rotations and moments are about.  Raises FormatError where there are several."""
    points = [said(f"{motion} about a point")[-3:] for motion in ("Roll", "Pitch", "Yaw")]
    points += [said(f"Moment force in {axis} direction", points[0])[-3:] for axis in "xyz"]
    if np.ptp(np.array(points), axis=0).any():
        raise FormatError(f"{place / 'Nemoh.cal'} has rotations or moments about several points; allowed: about one")
    return np.array(points[0])


def _said(path):
    """A function that gives the numbers before a text in Nemoh.cal, or others where there is no such text"""
    lines = lines_of(path)

    def said(text, otherwise=None):
        for line in lines:
            if text in line:
                return [float(word) for word in line.split("!")[0].split()]
        if otherwise is None:
            raise FormatError(f"{path} has no line with {text!r}")
        return otherwise

    return said


def _zones(path, count):
    """ω (n,) and numbers (zones, n, 12) of a .tec file"""
    text = "\n".join(lines_of(path))
    parts = re.split(r"^\s*zone\b.*$", text, flags=re.M | re.I)[1:]
    try:
        tables = [np.array([[float(x) for x in line.split()] for line in part.strip().splitlines()]) for part in parts]
        rows = np.stack(tables)
    except ValueError:
        raise FormatError(f"{path}: a zone is not a full table of numbers") from None
    if len(tables) != count or rows.shape[2] != 13:
        raise FormatError(f"{path} has {len(tables)} zones; allowed: {count}, with 13 numbers a line, of one body")
    order = np.argsort(rows[0, :, 0])
    return rows[0, order, 0], rows[:, order, 1:]


def _body(folder):
    body, still, stiffness = {}, _inside(folder, "Hydrostatics.dat"), _inside(folder, "KH.dat")
    if still.exists():
        found = [re.findall(r"=\s*([-+.\deE]+)", line) for line in lines_of(still)[:4]]
        body["center_of_buoyancy"] = np.array([float(pair[0]) for pair in found[:3]])
        body["center_of_mass"] = np.array([float(pair[1]) for pair in found[:3]])
        body["displaced_volume"] = float(found[3][0])
    if stiffness.exists():
        body["hydrostatic_stiffness"] = np.loadtxt(stiffness)[:6, :6]
    return body
