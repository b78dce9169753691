"""NAME.out of WAMIT, a printed listing with the numbers of NAME.1, .3, .8 and the hydrostatics in one file.

    Gravity, Length scale, Water depth; for each body XBODY, volumes, centres, C(3,3) … C(5,6) and radii of gyration
    for each period ADDED-MASS AND DAMPING COEFFICIENTS, EXCITING FORCES AND MOMENTS, … DRIFT FORCES (Momentum …)

Phases in this file are whole degrees, so the rounding of phases changes forces by at most 1 %.  NAME.mmx has volume,
centres and mass:

    WAMIT  Ouputs for body N = …      each with volumes, centres in the body's axes, and one of
    Normalized mass matrix:           I J M/ρ                IALTFRC = 1
    External force matrices:          I J M D K              IALTFRC = 2 and 3; M in the units of ρ and lengths

Modes beyond the six of a body are ignored, as are damping and stiffness of lines.  A matrix without rotational
inertia, such as that of a run without motions, gives only the mass.
User manual, version 7.4, section 4.9 and chapter 5.
"""

import re
from pathlib import Path

import numpy as np

from .values import FormatError, body_of, lines_of
from .wamit_inputs import NUMBER, PERIOD, Table, before_periods, listed_inputs, numbers_after

HEADING = re.compile(r"Wave Heading\s*\(deg\)\s*:\s*(.*)")
TITLES = (
    ("DIFFRACTION EXCITING", ".3"), ("HASKIND EXCITING", ".2"), ("RESPONSE AMPLITUDE", ".4"),
    ("DRIFT FORCES (Momentum", ".8"), ("DRIFT FORCES (Pressure", ".9"), ("DRIFT FORCES (Control", ".7"),
    ("ADDED-MASS", ".1"), ("VELOCITY", ""), ("PRESSURE", ""), ("FIELD POINT", ""),
)  # fmt: skip

BODY = re.compile(r"body N =\s*(\d+)")
CENTERS = {"Center of Buoyancy": "center_of_buoyancy", "Center of Gravity": "center_of_mass"}


def read_out(place, known):
    """The tables {suffix: Table}, the `Inputs`, and the known data of the body in SI.  Raises FormatError."""
    place = Path(place)
    lines, start = before_periods(place)
    if start is None:
        raise FormatError(f"{place} is not an output of WAMIT, or it ends before the first period")
    tables = {name: Table(place, np.array(rows)) for name, rows in _rows(lines[start:]).items() if rows}
    if ".1" not in tables:
        raise FormatError(f"{place} has no added mass and damping; allowed: a run with IOPTN(1) = 1")
    return tables, *_still(place, lines[:start], known)


def _rows(lines):
    """{suffix: rows as in its own file} of the part after the first period"""
    rows, period, kind, heading = {name: [] for _, name in TITLES}, 0.0, "", (0.0,)
    for line in lines:
        found = PERIOD.search(line)
        if found:
            period, kind = _period(found[1]), ""
            continue
        title = next((name for text, name in TITLES if text in line.upper() or text in line), None)
        if title is not None:
            kind = title
            continue
        found = HEADING.search(line)
        if found:
            heading = tuple(float(x) for x in re.findall(NUMBER, found[1]))
            continue
        words = line.split()
        if not kind or len(words) < 3 or not words[0].lstrip("-").isdigit():
            continue
        _add(rows[kind], kind, period, heading, [float(word) for word in words])
    return rows


def _add(rows, kind, period, heading, numbers):
    if kind == ".1":
        rows.append([period, *numbers[:2], numbers[2], numbers[3] if len(numbers) > 3 else np.nan])
        return
    mode, size, phase = numbers[:3]
    turn = np.exp(1j * np.radians(phase))
    twice = heading * 2 if kind in (".7", ".8", ".9") and len(heading) == 1 else heading
    rows.append([period, *twice[:2], abs(mode), size, phase, size * turn.real, size * turn.imag])


def _period(text):
    return {"infinite": -1.0, "zero": 0.0}.get(text.lower()) if text[0].isalpha() else float(text)


def _still(place, lines, known):
    """`Inputs` and the body's values in SI, of the lines before the first period"""
    given = listed_inputs(place, lines, known)
    places = numbers_after(r"XBODY\s*=.*", lines) or [[0.0, 0.0, 0.0]]
    which = body_of(place, len(places), known)
    return given, _body(lambda pattern: numbers_after(pattern, lines), which, given, np.array(places[which][:3]),
                        known["density"])  # fmt: skip


def _body(numbers, which, given, origin, density):
    body = {}
    volumes = numbers(r"Volumes \(VOLX.*")
    if volumes and which < len(volumes):
        body["displaced_volume"] = float(np.median(volumes[which][-3:]))
    for name, pattern in (("center_of_buoyancy", r"Center of Buoyancy.*"), ("center_of_mass", r"Center of Gravity.*")):
        rows = numbers(pattern)
        if rows and which < len(rows):
            body[name] = np.array(rows[which][-3:]) + origin
    upper = [numbers(rf"{re.escape(start)}.*") for start in ("C(3,3),", "C(4,4),", "        C(5,5),")]
    if all(rows and which < len(rows) for rows in upper):
        C, L, weight = np.zeros((6, 6)), given.length, density * given.gravity
        (a, b, c), (d, e, f), (g, h) = (rows[which][-n:] for rows, n in zip(upper, (3, 3, 2), strict=True))
        for i, j, x in ((2, 2, a), (2, 3, b), (2, 4, c), (3, 3, d), (3, 4, e), (3, 5, f), (4, 4, g), (4, 5, h)):
            C[i, j] = weight * x * L ** (2 + (i > 2) + (j > 2))
            C[j, i] = C[i, j] if j < 5 else 0.0
        body["hydrostatic_stiffness"] = C
    return body


def mass_of(path, which, density, origin):
    """{name of `schema.BODY`: value} of the body with index `which`, from 0.  Raises FormatError.

    origin : origin of the axes of the body, m, (3,)"""
    lines = lines_of(path)
    starts = [n for n, line in enumerate(lines) if BODY.search(line)]
    if which >= len(starts):
        raise FormatError(f"{path} has {len(starts)} bodies; allowed: as many as the other files have")
    block = lines[starts[which] : [*starts, len(lines)][which + 1]]
    body, scale, M = {}, None, np.zeros((6, 6))
    for line in block:
        title, _, rest = line.strip().partition(":")
        found = [float(x.replace("D", "E")) for x in re.findall(NUMBER, rest)]
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
