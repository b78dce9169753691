"""A project of HAMS: Input/ControlFile.in, HullMesh.pnl, Hydrostatic.in, and Output/Wamit_format/Buoy.1 .3 …

The results are in WAMIT's formats (`wamit`), with WAMIT's time factor, made dimensionless by Reference_body_length.
Output_frequency_type (`PERIOD_KINDS`) gives the kind of the first column; hakobune writes 4, the period.  HAMS is
described by Y. Liu (2019), Journal of Marine Science and Engineering 7(3).
HAMS-MREL, for several bodies, has AmssDamp.1, ExcForce.3 …,
Reference_body_center_1, HullMesh_1.pnl, Hydrostatic_1.in and so on. Each hull of HAMS-MREL has axes of its own, whose
position in the water is given by LCS_1, LCS_2 ….
"""

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import numbers_of
from hakobune.meshing.whole_files import write_whole

from . import wamit
from .values import FormatError, body_of, lines_of, of_each

RESULTS = Path("Output", "Wamit_format", "Buoy")
RESULTS_OF_SEVERAL = RESULTS.with_name("AmssDamp")
WATER = ("density", "gravity")
PERIOD_KINDS = {1: "deep wavenumber", 2: "wavenumber", 3: "frequency", 4: "period", 5: "wavelength"}


def write(values, place):
    """Write the folder of a project, including the results that HAMS would compute. Returns the paths."""
    from hakobune.meshing.files import write_mesh

    place = Path(place)
    (place / "Input").mkdir(parents=True, exist_ok=True)
    (place / RESULTS.parent).mkdir(parents=True, exist_ok=True)
    texts, paths = {"ControlFile.in": _control(values)}, []
    for i, one in enumerate(of_each(values)):
        number = f"_{i + 1}" if values.bodies else ""
        texts[f"Hydrostatic{number}.in"] = _hydrostatic(one)
        if values.mesh is not None:
            paths.append(place / "Input" / f"HullMesh{number}.pnl")
            write_mesh(values.mesh.of_body(i), paths[-1])
    for name, text in texts.items():
        paths.append(place / "Input" / name)
        write_whole(paths[-1], text.encode("ascii"))
    if values.bodies:
        return paths + wamit.write(values, place / RESULTS_OF_SEVERAL, wamit.NAMES_OF_HAMS)
    return paths + wamit.write(values, place / RESULTS)


def _bodies(values):
    """Lines of ControlFile.in about the bodies; hulls and points are in axes of the water"""
    center = "  ".join(f"{x:.6f}" for x in values.rotation_center)
    if not values.bodies:
        return [f"Reference_body_center   {center}"]
    points = ["  ".join(f"{x:.6f}" for x in body.rotation_center) for body in values.bodies]
    return [
        f"Number_of_bodies        {len(points)}",
        *(f"LCS_{i}                   0.000  0.000  0.000  0.000" for i in range(1, len(points) + 1)),
        *(f"Reference_body_center_{i} {point}" for i, point in enumerate(points, 1)),
    ]


def _control(values):
    depth = values.water_depth if np.isfinite(values.water_depth) else -1.0
    periods, degrees = 2 * np.pi / values.omega, np.degrees(values.wave_direction)
    about = "\n    ".join(_bodies(values))
    return f"""   --------------HAMS Control file---------------

   Waterdepth  {depth:.6f}D0

   #Start Definition of Wave Frequencies
    Input_frequency_type    4
    Output_frequency_type   4
    Number_of_frequencies   {len(periods)}
    {" ".join(f"{period:.9f}" for period in periods)}
   #End Definition of Wave Frequencies

   #Start Definition of Wave Headings
    Number_of_headings      {len(degrees)}
    {" ".join(f"{angle:.6f}" for angle in degrees)}
   #End Definition of Wave Headings

    {about}
    Reference_body_length   1.D0
    If_remove_irr_freq      0
    Number of threads       1

   #Start Definition of Pressure and/or Elevation
    Number_of_field_points  0
   #End Definition of Pressure and/or Elevation

   ----------End HAMS Control file---------------
"""


def _hydrostatic(values):
    nothing = np.zeros((6, 6))
    mass, stiffness = (values.get(name) for name in ("inertia_matrix", "hydrostatic_stiffness"))
    center = values.get("center_of_mass")
    tables = {
        "Body Mass Matrix": nothing if mass is None else mass,
        "External Damping Matrix": nothing,
        "Hydrostatic Restoring Matrix": nothing if stiffness is None else stiffness,
        "External Restoring Matrix": nothing,
    }
    lines = [" Center of Gravity:", _numbers(np.zeros(3) if center is None else center)]
    for name, table in tables.items():
        lines += [f" {name}:", *map(_numbers, table)]
    return "\n".join(lines) + "\n"


def _numbers(row):
    return "  " + "  ".join(f"{x: .9E}" for x in row)


def read(place, known):
    """The Values of a project; known : {"density", "gravity"}; ControlFile.in has the depth. Raises FormatError."""
    place = Path(place)
    given = _given(place, known)
    found = wamit.read(given.results, given.known)
    masses = _hydrostatic_of(place / "Input" / f"Hydrostatic{given.number}.in")
    told = ()
    if any(given.drawn_at):
        where = ", ".join(f"{x:g}" for x in given.drawn_at)
        told = (
            f"HullMesh{given.number}.pnl has its origin at ({where}) m and is moved there; a hull of --mesh must lie "
            "at that place in the water",
        )
    return replace(found, body=dict(found.body) | masses, name=place.name, left_out=(*found.left_out, *told))


def coupled(place, known, count):
    """Matrices of several bodies together, as from `wamit.coupled`; known : as in `read`"""
    given = _given(Path(place), known | {"body": 1})
    return wamit.coupled(given.results, given.known, count)


def hull_of(place, known=None):
    """The hull in the folder Input; in a project of several bodies the hull of known["body"]"""
    place = Path(place)
    several = place / "Input" / f"HullMesh_{(known or {}).get('body') or 1}.pnl"
    return several if several.is_file() else place / "Input" / "HullMesh.pnl"


def drawn_at(place, known):
    """Position in the water of the origin of the hull in Input, m; shape (3,)"""
    return _given(Path(place), known).drawn_at


class Given(NamedTuple):
    """results : path of NAME.1; known : as in `wamit.read`; number : ending of the body's file names, "", "_1", "_2" …
    drawn_at : position in the water of the origin of the hull, m"""

    results: Path
    known: dict
    number: str
    drawn_at: list


def _given(place, known):
    """`Given` of the body known["body"] by ControlFile.in.  Raises FormatError."""
    control = place / "Input" / "ControlFile.in"
    said = _control_of(control)
    depth, length = (_one(control, said, key) for key in ("Waterdepth", "Reference_body_length"))
    kind = int(_one(control, said, "Output_frequency_type"))
    if kind not in PERIOD_KINDS:
        raise FormatError(
            f"{control}: Output_frequency_type is {kind}; allowed: "
            + ", ".join(f"{key} ({name})" for key, name in PERIOD_KINDS.items())
        )
    count = int(_one(control, said, "Number_of_bodies")) if "Number_of_bodies" in said else 1
    body = body_of(place, count, known)
    own = f"_{body + 1}" if count > 1 else ""
    axes = numbers_of(said.get(f"LCS{own}", "0 0 0 0"))
    if axes[3:4] not in ([], [0.0]):
        raise FormatError(f"{control}: LCS{own} turns the body about z; allowed: axes parallel to those of the water")
    about = numbers_of(said.get(f"Reference_body_center{own}", "0 0 0"))[:3]
    water = {"water_depth": depth if depth > 0 else np.inf} | {name: known[name] for name in WATER}
    inputs = {"length_unit": length, "rotation_center": about, "period_kind": PERIOD_KINDS[kind], "body": body + 1}
    results = place / RESULTS
    if not results.with_suffix(".1").exists() and (place / RESULTS_OF_SEVERAL).with_suffix(".1").exists():
        results = place / RESULTS_OF_SEVERAL
    return Given(results, water | inputs, own, axes[:3])


def _control_of(path):
    """{key: rest of its line} up to the line at which HAMS stops reading; later text explains the keys"""
    said = {}
    for line in lines_of(path):
        if "End HAMS Control file" in line:
            break
        key, _, rest = line.strip().partition(" ")
        said.setdefault(key, rest)
    return said


def _one(path, said, key):
    numbers = numbers_of(said.get(key, ""))
    if not numbers:
        raise FormatError(f"{path} has no number for {key}; give {key} and its value on one line")
    return numbers[0]


def _hydrostatic_of(path):
    """Centre of mass and inertia of Hydrostatic.in: three numbers and six rows of six, after their titles; {} without
    the file, which results do not need
    """
    if not path.exists():
        return {}
    rows = [numbers for line in lines_of(path) if (numbers := numbers_of(line))]
    if len(rows) < 7 or len(rows[0]) < 3 or any(len(row) < 6 for row in rows[1:7]):
        raise FormatError(
            f"{path} has another content; allowed: the centre of gravity, then the mass matrix as six "
            f"rows of six numbers"
        )
    mass = np.array([row[:6] for row in rows[1:7]])
    body = {"center_of_mass": np.array(rows[0][:3])}
    return body | {"inertia_matrix": mass, "mass": mass[0, 0]} if mass.any() else body
