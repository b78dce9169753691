"""What WAMIT's NAME.mmx says of a body (user manual, version 7.4, section 4.9): volume, centres and mass.

    WAMIT  Ouputs for body N = …      each with volumes, centres in the body's axes, and one of
    Normalized mass matrix:           I J M/ρ                IALTFRC = 1
    External force matrices:          I J M D K              IALTFRC = 2 and 3; M in the units of ρ and lengths

Modes beyond the six of a body are left out, and damping and stiffness of lines.  A matrix without inertia in rotation,
as of a run that needs no motions, gives the mass alone.
"""

from __future__ import annotations

import re

import numpy as np

from .values import FormatError, lines_of

START = re.compile(r"body N =\s*(\d+)")
CENTERS = {"Center of Buoyancy": "center_of_buoyancy", "Center of Gravity": "center_of_mass"}
NUMBER = re.compile(r"[-+]?\d*\.?\d+(?:[EeDd][-+]?\d+)?")


def mass_of(path, which, density, origin):
    """{name of `schema.BODY`: value} of body `which`, from 0; origin : (3,) m of its axes.  Raises FormatError."""
    lines = lines_of(path)
    starts = [n for n, line in enumerate(lines) if START.search(line)]
    if which >= len(starts):
        raise FormatError(f"{path} has {len(starts)} bodies; allowed: as many as the files beside it")
    block = lines[starts[which] : [*starts, len(lines)][which + 1]]
    body, scale, M = {}, None, np.zeros((6, 6))
    for line in block:
        title, _, rest = line.strip().partition(":")
        found = [float(x.replace("D", "E")) for x in NUMBER.findall(rest)]
        if title.startswith("Volumes"):
            body["displaced_volume"] = float(np.median(found[-3:]))
        elif title.startswith(tuple(CENTERS)):
            body[CENTERS[title.partition(" (")[0]]] = np.array(found[-3:]) + origin
        elif title in ("Normalized mass matrix", "External force matrices"):
            scale = density if title.startswith("Normalized") else 1.0
        elif scale and len(row := line.split()) >= 3 and row[0].isdigit() and row[1].isdigit():
            i, j = (int(x) - 1 for x in row[:2])
            if max(i, j) < 6:
                M[i, j] = scale * float(row[2])
    if M[0, 0] > 0:
        body["mass"] = float(M[0, 0])
        if np.all(M.diagonal() > 0):
            body["inertia_matrix"] = M
    return body
