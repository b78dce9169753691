"""A folder of HydroStar's files with one quantity each (.rao, .dat), from HydroStar or HAMS; read only.

    # … Water density, Gravity acceleration, Waterdepth, Ref.pt incident wave, Forward speed, Reference point of body 1
    #RAOTYPE AddedMass | WaveDamping | LOAD, Excitation   #COMPONENT ij, of a force i   #HEADING degrees
    ω rad/s   values for each heading   phases in degrees for each heading

Units are SI. The time factor is exp(+iωt), so numbers are the conjugates of ours; headings are those that waves
travel to.  Matrices may have only the lower triangle.
The format was derived from files of HydroStar 8 and of HAMS; WAMIT's files of the same runs have the same numbers.
"""

import re
from pathlib import Path

import numpy as np

from ..waves import wavenumber
from .values import FormatError, Values, lines_of, omega_of

KINDS = {"addedmass": "added_mass", "wavedamping": "radiation_damping", "damping": "radiation_damping",
         "load": "excitation_force", "excitation": "excitation_force"}  # fmt: skip
HEAD = {"density": r"Water density \(rho\)\s*:\s*(\S+)", "gravity": r"Gravity acceleration\s*:\s*(\S+)",
        "depth": r"Waterdepth\s*:\s*(\S+)", "speed": r"Forward speed\s*:\s*(\S+)"}  # fmt: skip
POINTS = {"crest": r"Ref\.pt incident wave\s*:\s*\(([^)]*)\)", "about": r"Reference point of body 1\s*:\s*\(([^)]*)\)"}


def read(place, known=None):
    """The Values of a folder, given by its path or by the path of a file in the folder.  Raises FormatError."""
    place = Path(place)
    place = place if place.is_dir() else place.parent
    files = [found for path in sorted(place.iterdir()) if (found := _file(path))]
    tables = {(kind, mode): rows for kind, mode, _, rows, _ in files}
    water = next((water for kind, _, water, _, _ in files if kind == "added_mass"), None)
    if water is None or not any(kind == "radiation_damping" for kind, _ in tables):
        raise FormatError(
            f"{place} has no files of added mass and damping; allowed: AddedMass_11.rao, WaveDamping_11.rao …"
        )
    if water["speed"]:
        raise FormatError(f"{place} is for a forward speed of {water['speed']:g} m/s; allowed: 0")
    at = omega_of(
        next(rows for (kind, _), rows in tables.items() if kind == "added_mass")[:, 0], "frequency", 1.0, 9.81
    )
    order = np.argsort(at)
    order = order[(at[order] > 0) & np.isfinite(at[order])]
    omega = at[order]
    A, B = (_matrix(place, tables, at, name) for name in ("added_mass", "radiation_damping"))
    quantities = {"added_mass": A[order], "radiation_damping": B[order]}
    for name, row in (("added_mass_zero", at == 0), ("added_mass_infinity", np.isinf(at))):
        if row.any():
            quantities[name] = A[row][0]
    headings = next((beta for kind, _, _, _, beta in files if kind == "excitation_force"), np.zeros(0))
    if len(headings):
        k = wavenumber(omega, water["depth"], water["gravity"])
        crest = water["crest"][0] * np.cos(headings) + water["crest"][1] * np.sin(headings)
        X = _forces(place, tables, at, len(headings))[order]
        quantities["excitation_force"] = X * np.exp(1j * k[:, None] * crest)[..., None]
    return Values(omega, headings, water["depth"], water["density"], water["gravity"], quantities,
                  rotation_center=water["about"], name=place.name)  # fmt: skip


def _matrix(place, tables, at, name):
    """Matrices (n, 6, 6) of a quantity from its files; if only one of two pairs in opposite order is stored, it is used
    for both"""
    whole = np.zeros((len(at), 6, 6))
    for (kind, mode), rows in tables.items():
        if kind == name:
            i, j = (int(digit) - 1 for digit in mode)
            whole[:, i, j] = _same(place, rows, at, 1)[:, 1]
            if (name, mode[::-1]) not in tables:
                whole[:, j, i] = whole[:, i, j]
    return whole


def _forces(place, tables, at, m):
    """Forces (n, m, 6) whose phases refer to the crest at the point of the incident wave"""
    X = np.zeros((len(at), m, 6), complex)
    for (kind, mode), rows in tables.items():
        if kind == "excitation_force":
            own = _same(place, rows, at, 2 * m)
            X[:, :, int(mode[-1]) - 1] = own[:, 1 : m + 1] * np.exp(-1j * np.radians(own[:, m + 1 :]))
    return X


def _same(place, rows, at, columns):
    """Rows at the frequencies of all.  Raises FormatError."""
    if len(rows) != len(at) or rows.shape[1] < columns + 1:
        raise FormatError(f"{place} has tables with different frequencies or headings; allowed: tables of one run")
    return rows


def _file(path):
    """Return (quantity, mode, {of the head}, rows, headings (m,), rad) of a file of one of KINDS, else None"""
    if path.suffix.lower() not in (".rao", ".dat") or not path.is_file():
        return None
    lines = lines_of(path)
    text = "\n".join(line for line in lines if line.startswith("#"))
    kind = re.search(r"#RAOTYPE\s*:\s*([\w-]+)", text)
    mode = re.search(r"#COMPONENT\s*:\s*(\d+)", text)
    name = KINDS.get(kind[1].replace("-", "").lower()) if kind and mode else None
    if name is None:
        return None
    try:
        water = {key: re.search(pattern, text)[1] for key, pattern in HEAD.items()}
        water = {key: float(word) if re.match(r"[-+.\d]", word) else np.inf for key, word in water.items()}
        water |= {key: np.array(re.search(p, text)[1].split(), float) for key, p in POINTS.items()}
        rows = np.array([line.split() for line in lines if line.strip() and not line.startswith("#")], float)
        beta = np.radians(np.array(re.search(r"#HEADING\s+(.*)", text)[1].split(), float))
    except (TypeError, ValueError):
        raise FormatError(
            f"{path} does not have the header and rows that HydroStar writes; allowed: HydroStar's files of one "
            f"quantity each"
        ) from None
    if rows.ndim != 2:
        raise FormatError(f"{path} has a header but no rows; allowed: a row for each frequency")
    water["depth"] = water["depth"] if water["depth"] > 0 else np.inf
    return name, mode[1], water, rows, beta
