"""A project of HAMS: Input/ControlFile.in, HullMesh.pnl, Hydrostatic.in, and Output/Wamit_format/Buoy.1 .3 …

The results are in the files of WAMIT (`wamit`) with its time factor, and the frequency in rad/s where
Output_frequency_type is 3; here it is 4, the period, as WAMIT has it.  HAMS of Y. Liu (2019), J. Mar. Sci. Eng. 7(3).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from meshing.whole_files import write_whole

from . import wamit
from .values import FormatError

RESULTS = Path("Output", "Wamit_format", "Buoy")
WATER = ("density", "gravity")


def write(values, place):
    """Write the folder of a project; its parts that HAMS would make are there already.  Returns the paths."""
    from meshing.files import write_mesh

    place = Path(place)
    (place / "Input").mkdir(parents=True, exist_ok=True)
    (place / RESULTS.parent).mkdir(parents=True, exist_ok=True)
    paths = [place / "Input" / "ControlFile.in", place / "Input" / "Hydrostatic.in"]
    for path, text in zip(paths, (_control(values), _hydrostatic(values)), strict=True):
        write_whole(path, text.encode("ascii"))
    if values.mesh is not None:
        paths.append(place / "Input" / "HullMesh.pnl")
        write_mesh(values.mesh, paths[-1])
    return paths + wamit.write(values, place / RESULTS)


def _control(values):
    depth = values.water_depth if np.isfinite(values.water_depth) else -1.0
    periods, degrees = 2 * np.pi / values.omega, np.degrees(values.wave_direction)
    center = "  ".join(f"{x:.6f}" for x in values.rotation_center)
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

    Reference_body_center   {center}
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
    """The Values of a project; known : {"density", "gravity"}, the depth is in ControlFile.in.  Raises FormatError."""
    place = Path(place)
    control = place / "Input" / "ControlFile.in"
    try:
        words = [line.split() for line in control.read_text(encoding="utf-8", errors="replace").splitlines()]
    except OSError as error:
        raise FormatError(f"{control}: {error.strerror}") from None
    said = {line[0]: line[1] for line in words if len(line) > 1}
    about = next((line[1:4] for line in words if line and line[0] == "Reference_body_center"), ["0"] * 3)
    if said.get("Output_frequency_type") != "4":
        raise FormatError(
            f"{control}: Output_frequency_type is {said.get('Output_frequency_type')}; allowed: 4, the period"
        )
    depth = float(said["Waterdepth"].upper().removesuffix("D0"))
    known = {"water_depth": depth if depth > 0 else np.inf} | {name: known[name] for name in WATER}
    found = wamit.read(place / RESULTS, known)
    body, rows = dict(found.body), (place / "Input" / "Hydrostatic.in").read_text(encoding="utf-8").splitlines()
    body["center_of_mass"] = np.array([float(x) for x in rows[1].split()])
    mass = np.array([[float(x) for x in row.split()] for row in rows[3:9]])
    if mass.any():
        body |= {"inertia_matrix": mass, "mass": mass[0, 0]}
    return replace(found, body=body, rotation_center=np.array(about, float), name=place.name)
