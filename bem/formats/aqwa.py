"""Files of AQWA: numbers in NAME.AH1, a listing in NAME.LIS (Aqwa Reference Manual, "AH1 file", "Listing file").

    .AH1   structures, headings, frequencies; GENERAL depth ρ g; COG, MASS, HYDSTIFFNESS, DISPLACEMENT : of each
           structure; ADDEDMASS, DAMPING : two structures, frequency, A (6, 6);
           FORCERAO  structure, heading, frequency, F, φ
    .LIS   the same in tables of each structure

SI units, the time factor exp(−iωt) and headings that waves travel to are the same as here. Forces, motions and phases
refer to the centre of gravity.
"""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..waves import wavenumber
from .values import FormatError, Values, body_of, lines_of

NUMBER = re.compile(r"[-+]?\d*\.?\d+(?:[EeDd][-+]?\d+)?")
DEEP = 1e4  # m, depth that is written for deep water
SIDES = ("X", "Y", "Z", "RX", "RY", "RZ")
RADIATION = {"added_mass": "ADDEDMASS", "radiation_damping": "DAMPING"}
LIMITS = {"ADDEDMASS_LF": "added_mass_zero", "ADDEDMASS_HF": "added_mass_infinity"}


class Water(NamedTuple):
    depth: float
    density: float
    gravity: float


def read(place, known=None):
    """The Values of one structure of NAME.AH1 or NAME.LIS.  Raises FormatError.

    known : {"body": number of the structure, from 1} if the file has several structures
    """
    place = Path(place)
    kind = _listing if place.suffix.lower() == ".lis" else _numbers
    try:
        return kind(place, known)
    except (IndexError, KeyError, ValueError) as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(
            f"{place} is no file of AQWA's hydrodynamic coefficients, or it ends too soon: {error}"
        ) from None


def _values(place, water, center, omega, headings, quantities, body, limits, others):
    if abs(water.gravity / 9.81 - 1) > 0.05:
        raise FormatError(f"{place} has gravity {water.gravity:g}; allowed: a model in metres, kilograms and newtons")
    order = np.argsort(omega)
    depth = np.inf if water.depth >= DEEP else water.depth
    k = wavenumber(omega[order], depth, water.gravity)
    quantities = {name: data[order] for name, data in quantities.items()}
    if "excitation_force" in quantities:
        crest = center[0] * np.cos(headings) + center[1] * np.sin(headings)
        quantities["excitation_force"] = quantities["excitation_force"] * np.exp(1j * k[:, None] * crest)[..., None]
    body = {"center_of_mass": center} | body
    return Values(omega[order], headings, depth, water.density, water.gravity, quantities | limits, body, center,
                  name=place.stem, others=others)  # fmt: skip


def _numbers(place, known):
    head, sections = _sections(place)
    headings, frequencies = (int(x) for x in head[1:3])
    count = len(sections["COG"]) // 4
    which = body_of(place, count, known)
    beta = np.radians(head[3 : 3 + headings])
    omega = np.array(head[3 + headings : 3 + headings + frequencies])

    def own(name, size):
        """Matrix of one structure, shape (size,), or None"""
        rows = sections.get(name)
        return None if rows is None else np.array(rows).reshape(count, -1)[which, -size:]

    water = own_water(sections["GENERAL"])
    center = own("COG", 3)
    body = {}
    for name, key in (("inertia_matrix", "MASS"), ("hydrostatic_stiffness", "HYDSTIFFNESS")):
        found = own(key, 36)
        if found is not None and np.any(found):
            body[name] = found.reshape(6, 6)
    if "inertia_matrix" in body:
        body["mass"] = float(body["inertia_matrix"][0, 0])
    for name, key, size in (("displaced_volume", "DISPLACEMENT", 1), ("center_of_buoyancy", "COB", 3)):
        found = own(key, size)
        if found is not None:
            body[name] = float(found[0]) if size == 1 else found
    quantities = {name: _blocks(sections, key, count)[:, which, :, which] for name, key in RADIATION.items()}
    if "FORCERAO" in sections:
        rows = np.array(sections["FORCERAO"]).reshape(-1, 15)
        rows = rows[rows[:, 0] == which + 1]
        X = np.zeros((frequencies, headings, 6), complex)
        X[rows[:, 2].astype(int) - 1, rows[:, 1].astype(int) - 1] = rows[:, 3:9] * np.exp(1j * np.radians(rows[:, 9:]))
        quantities["excitation_force"] = X
    limits = {
        name: _blocks(sections, key, count)[0, which, :, which] for key, name in LIMITS.items() if key in sections
    }
    return _values(place, water, center, omega, beta, quantities, body, limits, count - 1)


def coupled(place, known, count):
    """{quantity: array} of added mass, damping and limits of `count` structures together, (…, 6 count, 6 count),
    about the centre of gravity of each structure.
    known : as in `read`; raises FormatError
    """
    place, side = Path(place), 6 * count
    if place.suffix.lower() == ".lis":
        raise FormatError(f"{place} gives one structure at a time; with --bodies give the .AH1 of the same run")
    head, sections = _sections(place)
    headings, frequencies = (int(x) for x in head[1:3])
    order = np.argsort(head[3 + headings : 3 + headings + frequencies])
    found = {name: _blocks(sections, key, count).reshape(-1, side, side)[order] for name, key in RADIATION.items()}
    found |= {
        name: _blocks(sections, key, count).reshape(side, side) for key, name in LIMITS.items() if key in sections
    }
    for name, data in found.items():
        if np.isnan(data).any():
            raise FormatError(
                f"{place} lacks {name.replace('_', ' ')} between structures; with --bodies give a run with "
                "interaction of its structures, or give --body for one structure"
            )
    return found


def _blocks(sections, key, count):
    """(f, count, 6, count, 6) of a section: on each structure by motions of each; NaN where missing"""
    limit = key in LIMITS
    rows = np.array(sections[key]).reshape(-1, 38 if limit else 39)
    on, by, at = (rows[:, column].astype(int) - 1 for column in range(3))
    at = 0 * at if limit else at
    out = np.full((at.max() + 1, count, 6, count, 6), np.nan)
    out[at, on, :, by] = rows[:, -36:].reshape(-1, 6, 6)
    return out


def own_water(numbers):
    """`Water` from depth, density and gravity, which stand after the number of the structure in files since release
    18.2"""
    start = next(i for i in (1, 0) if len(numbers) > i + 2 and 900 < numbers[i + 1] < 1100)
    return Water(*numbers[start : start + 3])


def _sections(place):
    """Numbers of the head, and {section: numbers}"""
    head, sections, now = [], {}, None
    for line in lines_of(place):
        if line.startswith("*") or not line.strip():
            continue
        word = line.strip()
        if re.fullmatch(r"[A-Z][A-Z_]+", word):
            now = sections.setdefault(word, [])
            continue
        found = [float(x) for x in NUMBER.findall(line)]
        (head if now is None else now).extend(found)
    if not sections:
        raise FormatError(f"{place} has no section; allowed: GENERAL, COG, ADDEDMASS, DAMPING, FORCERAO")
    return head, sections


def _listing(place, known):
    lines = lines_of(place)
    blocks = _listed(lines)
    count = max(blocks, default=1)
    which = body_of(place, count, known)
    own = blocks.get(which + 1, [])
    water = _water_listed(place, "\n".join(lines))
    center, C, A, B = _tables(own)
    if center is None:
        raise FormatError(f"{place} does not give the centre of gravity of structure {which + 1}")
    omega = [at for at in A if at in B and not isinstance(at, str)]
    if not omega:
        raise FormatError(f"{place} has no added mass and damping of structure {which + 1}")
    limits = {name: A[at] for at, name in (("low", "added_mass_zero"), ("high", "added_mass_infinity")) if at in A}
    found, headings, X = _forces(own)
    quantities = {"added_mass": np.array([A[w] for w in omega]), "radiation_damping": np.array([B[w] for w in omega])}
    if len(found):
        quantities["excitation_force"] = X[[int(np.argmin(np.abs(found - w))) for w in omega]]
    body = {} if C is None else {"hydrostatic_stiffness": C}
    return _values(place, water, center, np.array(omega), headings, quantities, body, limits, count - 1)


def _water_listed(place, text):
    """`Water` of a listing.  Raises FormatError."""

    def one(pattern):
        found = re.search(pattern + r"[\s.]*=\s*(\S+)", text)
        if found is None:
            raise FormatError(f"{place} does not contain {pattern!r}; allowed: the listing of a run of AQWA-LINE")
        return float(found[1])

    return Water(one(r"WATER\s+DEPTH"), one(r"DENSITY\s+OF\s+WATER"), one(r"ACCELERATION\s+DUE\s+TO\s+GRAVITY"))


def _tables(lines):
    """Centre of gravity (3,) m, stiffness (6, 6), None if they are not there, and {rad/s, "low" or "high": (6, 6)} of
    added mass and of damping"""
    at, C, center = None, None, None
    tables = {"ADDED MASS": {}, "DAMPING": {}}
    for i, line in enumerate(lines):
        words = " ".join(line.split())
        if "WAVE FREQUENCY" in words and "=" in words:
            frequency = _numbers_after("WAVE FREQUENCY", words)[0]
            at = frequency if "ENCOUNTER" not in words else "low" if frequency < 1 else "high"
        elif "THE CENTRE OF GRAVITY AT" in words:
            center = np.array(_numbers_after("AT", words))
        elif "C.O.G GX" in words and center is None:
            center = np.array(_numbers_after("GX", words)[:3])
        elif words == "STIFFNESS MATRIX" and C is None:
            C = _matrix(lines[i + 1 : i + 20])
        elif words in tables and at is not None:
            table = _matrix(lines[i + 1 : i + 20])
            if len(table) == 6:
                tables[words].setdefault(at, table)
    return center, C, *tables.values()


def _numbers_after(word, text):
    return [float(x) for x in NUMBER.findall(text.split(word, 1)[1])]


def _listed(lines):
    """{number of the structure: lines of its hydrodynamic parameters and still water}"""
    out, now = {}, None
    for line in lines:
        packed = line.replace(" ", "").replace("*", "")
        found = re.search(r"FORSTRUCTURE(\d+)", packed)
        if found:
            now = out.setdefault(int(found[1]), [])
        if now is not None:
            now.append(line)
    return out


def _matrix(lines):
    rows = [line.split() for line in lines]
    return np.array([[float(x) for x in row[1:7]] for row in rows if row and row[0] in SIDES and len(row) == 7][:6])


def _forces(lines):
    """ω (n,), headings (m,) rad and F (n, m, 6) of the tables of Froude–Krylov and diffraction forces by period"""
    rows, direction, inside = [], np.nan, False
    for line in lines:
        words = " ".join(line.split())
        if "VARIATION WITH" in words:
            inside = words.startswith("FROUDE KRYLOV + DIFFRACTION FORCES") and "PERIOD" in words
            continue
        if not inside or not words or not (words[0].isdigit() or words[0] in ".-"):
            continue
        try:
            numbers = [float(x) for x in words.split()]
        except ValueError:
            continue
        if len(numbers) == 15:
            direction = numbers[2]
        if len(numbers) in (14, 15):
            rows.append([numbers[1], direction, *numbers[-12:]])
    if not rows:
        return np.zeros(0), np.zeros(0), None
    table = np.array(rows)
    omega, n = np.unique(table[:, 0], return_inverse=True)
    degrees, m = np.unique(table[:, 1], return_inverse=True)
    X = np.zeros((len(omega), len(degrees), 6), complex)
    X[n, m] = table[:, 2::2] * np.exp(1j * np.radians(table[:, 3::2]))
    return omega, np.radians(degrees), X
