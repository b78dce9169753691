"""The hydrodynamic data base NAME.hdb of Diodore and AQUA+ (Diodore user manual, "HDB file"), read only.

    [List_calculated_periods] s   [List_calculated_headings] °   [Hydrostatic_matrix]   [Mass_Inertia_matrix]
    [ADDED_MASS_LINE_i], [DAMPING_TERM_i]            period, row i of A and B
    [INCIDENCE_EFM_MOD_h] heading, [INCIDENCE_EFM_PH_h] heading      period, size and phase (rad) of the excitation
    [INCIDENCE_EFM_FFK_MOD_h], [INCIDENCE_EFM_DIFF_MOD_h]            of its parts;    [INCIDENCE_DFM_h]  mean drift

SI, with F = i |F| exp(iφ) in exp(−iωt).  In files of AQUA+ the Froude–Krylov forces stand in sections
[FROUDE-KRYLOV_FORCES_AND_MOMENTS], and no section has the sum.  All quantities are about the centre of gravity.
Depth, density and gravity are not in the file.
"""

import re
from pathlib import Path

import numpy as np

from .values import FormatError, Values, body_of, lines_of

GROUPS = {"EFM": "excitation_force", "EFM_FFK": "Froude_Krylov_force", "EFM_DIFF": "diffraction_force"}
KEY = re.compile(r"^\s*\[([^\]]+)\]\s*(.*)$")


def read(place, known):
    """Read NAME.hdb as `Values`; known : {"water_depth", "density", "gravity"}.  Raises FormatError."""
    place = Path(place)
    sections, said = _sections(place)
    if known.get("water_depth") is None:
        raise FormatError(f"--depth is missing, and {place} does not give the depth; allowed: above 0 m, or inf")
    if float(said.get("FORWARD_SPEED", ["0"])[0].split()[0]):
        raise FormatError(f"{place} is for a body with forward speed; allowed: speed 0")
    count = int((said.get("STRUCTURES_NUMBER") or ["1"])[0].split()[0])
    body_of(place, count, known)
    if count > 1:
        raise FormatError(f"{place} has {count} structures; allowed: one")
    rows = _tables(place, sections)
    omega = 2 * np.pi / rows["ADDED_MASS_LINE_1"][0][1][:, 0]
    order = np.argsort(omega)
    A, B = (
        np.stack([rows[f"{name}_{i}"][0][1][order, 1:7] for i in range(1, 7)], axis=1)
        for name in ("ADDED_MASS_LINE", "DAMPING_TERM")
    )
    quantities, headings = {"added_mass": A, "radiation_damping": B}, np.zeros(0)
    incident = "FROUDE-KRYLOV_FORCES_AND_MOMENTS" in said and "EXCITATION_FORCES_AND_MOMENTS" not in said
    for group, name in GROUPS.items():
        sizes, phases = (_by_heading(rows, f"INCIDENCE_{group}_{part}") for part in ("MOD", "PH"))
        if sizes and len(sizes) == len(phases):
            headings = np.radians([heading for heading, _ in sizes])
            pairs = zip(sizes, phases, strict=True)
            X = np.stack([1j * size[:, 1:7] * np.exp(1j * phase[:, 1:7]) for (_, size), (_, phase) in pairs], axis=1)
            if len(X) == len(omega):
                quantities["Froude_Krylov_force" if incident else name] = X[order]
    center, body = _body(said, rows)
    water = {name: known[name] for name in ("water_depth", "density", "gravity")}
    return Values(omega[order], headings, quantities=quantities, body=body, rotation_center=center, name=place.stem,
                  **water)  # fmt: skip


def _by_heading(rows, start):
    """[(heading in degrees, table)] of the sections of a name, in their order; AQUA+ numbers all of them 1"""
    found = []
    for name, tables in rows.items():
        if re.fullmatch(rf"{start}_\d+", name):
            found += [(float(rest.split()[0]), table) for rest, table in tables if rest.split()]
    return found


def _sections(place):
    """[(name, rest of its line, lines below)], and {name: [rest]}"""
    sections, said = [], {}
    for line in lines_of(place):
        key = KEY.match(line)
        if key:
            sections.append((key[1].strip(), key[2].strip(), []))
            said.setdefault(key[1].strip(), []).append(key[2].strip())
        elif sections:
            sections[-1][2].append(line)
    if "ADDED_MASS_LINE_1" not in said:
        raise FormatError(f"{place} has no [ADDED_MASS_LINE_1]; allowed: a data base with hydrodynamic parameters")
    return sections, said


def _tables(place, sections):
    """{name: [(rest of its line, (k, q) numbers)]} of the non-empty sections"""
    out = {}
    for name, rest, lines in sections:
        try:
            rows = [[float(x) for x in line.replace("D", "E").split()] for line in lines if line.strip()]
            if rows:
                out.setdefault(name, []).append((rest, np.array(rows)))
        except ValueError:
            if "LINE" in name or "TERM" in name or "INCIDENCE" in name:
                raise FormatError(f"{place}: [{name}] is not a full table of numbers") from None
    return out


def _body(said, rows):
    def numbers(name):
        return np.array([float(x) for x in said[name][0].split()]) if said.get(name) else None

    body, center = {}, numbers("CENTER_OF_GRAVITY")
    if center is not None:
        body["center_of_mass"] = center
    for name, key in (("hydrostatic_stiffness", "Hydrostatic_matrix"), ("inertia_matrix", "Mass_Inertia_matrix")):
        if key in rows and rows[key][0][1].shape == (6, 6) and np.any(rows[key][0][1]):
            body[name] = rows[key][0][1]
    if "inertia_matrix" in body:
        body["mass"] = float(body["inertia_matrix"][0, 0])
    volume, buoyancy = numbers("UNDERWATER_VOLUME"), numbers("CENTER_OF_BUOYANCY")
    if volume is not None:
        body["displaced_volume"] = float(volume[0])
    if buoyancy is not None:
        body["center_of_buoyancy"] = buoyancy
    return np.zeros(3) if center is None else center, body
