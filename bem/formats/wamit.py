"""Numeric output files of WAMIT (user manual, version 7.4, chapters 3 and 5): NAME.1 .3 .3fk .3sc .4 .8 .hst

    .2            as .3, by Haskind's relation
    .1            PER I J Ā B̄          A = ρ L^a Ā,  B = ρω L^a B̄, a = 3 + p_I + p_J;  at ω = 0 and ∞ without B̄
    .3 .3fk .3sc  PER BETA I Mod Pha Re Im           X = ρg L^(2 + p_I) X̄ for each metre of wave amplitude
    .4            the same                           ξ = ξ̄ L^(−p_I), rad for each metre of rotations
    .8 .9 .7      PER BETA BETA I Mod Pha Re Im      F = ρg L^(1 + p_I) F̄, of the mean drift by momentum, I = 1, 2, 6
    .hst          I J C̄                              C = ρg L^(2 + p_I + p_J) C̄
    .mmx          volume, centres and mass (`wamit_out`)

with p = 0 for translations and 1 for rotations, L = ULEN; PER as given by IPEROUT, by default the period in s, −1 at
ω = 0 and 0 at ω = ∞. BETA is the heading in degrees that the waves travel to, and phases are in degrees with
exp(+iωt), so numbers are the conjugates of ours.
Values that are 0 by symmetry are omitted.  Files are written with L = 1 m.  The .8 file is for the free body if
motions are stored (then a .4 file lies beside it), and otherwise for the fixed body. It is omitted for several bodies,
whose modes are numbered 7 to 12 and so on.  These files contain neither depth, density, gravity nor hull. WAMIT's
input files beside the results contain ULEN and the reference point of moments (`wamit_inputs`).
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.whole_files import write_whole

from ..database.schema import DOFS, DRIFT_DOFS
from ..modes import moving
from .values import FormatError, Values, body_of, gridded, omega_of, table_of
from .wamit_inputs import Table, beside, inputs_of
from .wamit_out import mass_of, read_out

FORCES = {
    ".2": "excitation_force",
    ".3": "excitation_force",
    ".3fk": "Froude_Krylov_force",
    ".3sc": "diffraction_force",
    ".4": "rao",
}
LIMIT_PERIODS = {-1.0: "added_mass_zero", 0.0: "added_mass_infinity"}
LIMITS_AT = {0.0: "added_mass_zero", np.inf: "added_mass_infinity"}
NAMES_OF_HAMS = {".1": "AmssDamp", ".3": "ExcForce", ".4": "Motion", ".hst": "Hydrostat"}
SIX = range(1, 7)
POWER = np.array([0, 0, 0, 1, 1, 1])  # additional power of ULEN for rotations
SAME_PERIOD = 1e-5  # relative difference within which periods are equal; programs print six digits
DRIFTS = (".8", ".9", ".7")  # drift files by momentum, pressure, control surface; the first that exists is read
DRIFT_INDEX = [DOFS.index(name) + 1 for name in DRIFT_DOFS]


def write(values, place, names=None):
    """Write NAME.1 and the other files of a set.  Returns the paths.

    place : path NAME, with or without a suffix

    names : {suffix: file name} of the files to write; None: all files, with the name NAME
    """
    A, B = values.need("added_mass", "radiation_damping")
    place, rho, rho_g = Path(place), values.density, values.density * values.gravity
    files = {".1": _radiation(values, A / rho, B / (rho * values.omega[:, None, None]))}
    for suffix, name in FORCES.items():
        if values.get(name) is not None and suffix != ".2":  # .2, by Haskind's relation, has the same forces as .3
            index = _moved(values) if name == "rao" else range(1, values.get(name).shape[-1] + 1)
            files[suffix] = _forces(values, np.conj(values.get(name)) / (1.0 if name == "rao" else rho_g), index)
    drift = values.get("drift_force")
    drift = values.get("drift_force_fixed") if drift is None else drift
    if drift is not None and not values.bodies:
        files[".8"] = _forces(values, drift / rho_g, DRIFT_INDEX, twice=True)
    if values.get("hydrostatic_stiffness") is not None:
        C = values.get("hydrostatic_stiffness") / rho_g
        files[".hst"] = [
            f"{i + 1:6d}{j:6d} {C[i, k]: .6E}" for i in range(len(C)) for k, j in enumerate(_moved(values))
        ]
    paths = []
    for suffix, lines in files.items():
        if names is not None and suffix not in names:
            continue
        paths.append(place.with_name((names or {}).get(suffix, place.stem) + suffix))
        write_whole(paths[-1], ("\n".join(lines) + "\n").encode("ascii"))
    return paths


def stands_for(values, name):
    """Matrix (6, 6) of an added-mass limit; entries that are missing or not finite are taken from the nearest
    frequency"""
    limit, nearest = values.get(name), values.get("added_mass")[0 if name == "added_mass_zero" else -1]
    return nearest if limit is None else np.where(np.isfinite(limit), limit, nearest)


def _moved(values):
    """Numbers of the modes of the moving bodies, from 1"""
    return [d + 1 for d in moving(values.bodies)]


def _radiation(values, A, B):
    lines, moved = [], _moved(values)
    for period, name in LIMIT_PERIODS.items():
        limit = stands_for(values, name)  # HydroDyn and RAFT do not read a file without both
        for i, j in np.ndindex(limit.shape):
            lines.append(f"{period: .6E}{i + 1:6d}{moved[j]:6d} {limit[i, j] / values.density: .6E}")
    for n in np.argsort(-values.omega)[::-1]:
        for i, j in np.ndindex(A.shape[1:]):
            head = f"{2 * np.pi / values.omega[n]: .6E}{i + 1:6d}{moved[j]:6d}"
            lines.append(f"{head} {A[n, i, j]: .6E} {B[n, i, j]: .6E}")
    return lines


def _forces(values, X, index, twice=False):
    lines, degrees = [], np.degrees(values.wave_direction)
    for n, omega in enumerate(values.omega):
        for m, beta in enumerate(degrees):
            head = f"{2 * np.pi / omega: .6E} {beta: .6E}" + (f" {beta: .6E}" if twice else "")
            for i, x in zip(index, X[n, m], strict=True):
                x = complex(x)
                polar = f"{abs(x): .6E} {np.degrees(np.angle(x)): .6E}"
                lines.append(f"{head}{i:6d} {polar} {x.real: .6E} {x.imag: .6E}")
    return lines


def read(place, known):
    """The Values of NAME.1 and the files beside it (`wamit_inputs`), or of NAME.out, which contains all of them.

    known : {"density", "gravity"}; optional are "water_depth" m, "length_unit" m, "rotation_center" (3,) m and "body",
        the number of the body from 1
    Raises FormatError.
    """
    place = Path(place)
    whole = place.suffix.lower() == ".out"
    if whole:
        tables, given, body = read_out(place, known)
    else:
        place, given = place.with_suffix(".1"), inputs_of(place, known)
        tables, body = tables_beside(place), {}
    if given.depth is None:
        raise FormatError(f"--depth is missing, and {place} does not give the depth; allowed: above 0 m, or inf")
    count = int(max(tables[".1"][1].max() + 5, 6)) // 6 if len(tables[".1"]) else 1
    if given.bodies == 1 and given.told:  # modes beyond six are of bending, or of water in a chamber
        known = {"body": 1} | {name: value for name, value in known.items() if value is not None}
    chosen = body_of(place, max(count, given.bodies), known)
    length = given.length
    rho, rho_g = known["density"], known["density"] * given.gravity
    columns = Columns(given, 6 * chosen + np.array(SIX))
    tables = {suffix: table for suffix, table in tables.items() if suffix in (".1", ".hst") or columns.of_body(table)}
    quantities, omega = _read_radiation(tables[".1"], rho, columns)
    headings = np.zeros(0)
    for suffix, name in FORCES.items():
        if suffix in tables:
            headings, X = _read_forces(tables[suffix], omega, headings, columns, SIX)
            quantities[name] = np.conj(X) * (length**-POWER if name == "rao" else rho_g * length ** (2 + POWER))
    left_out = []
    for suffix in DRIFTS:
        if suffix in tables:
            try:
                headings, F = _read_forces(tables[suffix], omega, headings, columns, DRIFT_INDEX)
            except OtherPlaces as error:  # motions and forces are complete without it
                left_out.append(f"{error}; it is left out")
                continue
            F = F.real * rho_g * length ** (1 + POWER[np.array(DRIFT_INDEX) - 1])
            quantities["drift_force" if "rao" in quantities else "drift_force_fixed"] = F
            break
    if ".hst" in tables:
        path, rows = tables[".hst"].path, _of_body(tables[".hst"].rows, (0, 1), columns.modes)
        C = gridded(path, rows.T[:2], rows[:, 2], modes=(SIX, SIX))[1]
        body["hydrostatic_stiffness"] = rho_g * C * length ** (2 + POWER + POWER[:, None])
    masses = beside(place, ".mmx")
    if masses:
        body = mass_of(masses, chosen, rho, np.array(given.about, float)) | body
    water = {"water_depth": given.depth, "density": rho, "gravity": given.gravity}
    return Values(omega, headings, quantities=quantities, body=body, name=place.stem, **water,
                  rotation_center=np.array(given.about, float), others=max(count, given.bodies) - 1,
                  left_out=tuple(left_out))  # fmt: skip


def coupled(place, known, count):
    """{quantity: array} of added mass, damping and limits of `count` bodies together, (…, 6 count, 6 count)

    known : as in `read`.  Raises FormatError.
    """
    place, first = Path(place), known | {"body": 1}
    if place.suffix.lower() == ".out":
        tables, given, _ = read_out(place, first)
    else:
        place = place.with_suffix(".1")
        tables, given = tables_beside(place), inputs_of(place, first)
    return _read_radiation(tables[".1"], known["density"], Columns(given, np.arange(1, 6 * count + 1)))[0]


def hull_of(place, known=None):
    """The .gdf of a body beside NAME.1 or NAME.out; None if missing"""
    place = Path(place)
    given = inputs_of(place, {name: known.get(name) for name in ("body",)} if known else {})
    if given.hull:
        return place.with_name(given.hull)
    return beside(place, ".gdf")


def _some(numbers):
    """The first of some numbers, as text"""
    return ", ".join(f"{x:.5g}" for x in numbers[:4]) + (", …" if len(numbers) > 4 else "")


class OtherPlaces(FormatError):
    """A file has other periods or headings than the other files of the set."""


class Columns(NamedTuple):
    """given : `wamit_inputs.Inputs`; modes : numbers of the body's modes, (6,), or of the modes of all bodies"""

    given: object
    modes: np.ndarray

    def of_body(self, table):
        """Whether a table of forces contains forces of the body"""
        return bool(np.isin(table.rows[:, -5], self.modes).any())

    def omega(self, column):
        """Frequencies, rad/s, of a first column; shape (k,)"""
        given = self.given
        return omega_of(column, given.period_kind, given.depth, given.gravity, given.wave_length)


def tables_beside(place):
    """{suffix: Table} of the files with the name of `place`; beside AmssDamp.1, of the files with HAMS-MREL's names"""
    widths = {".1": (4, 5), ".hst": (3,)} | dict.fromkeys(FORCES, (7,)) | dict.fromkeys(DRIFTS, (8,))
    names = NAMES_OF_HAMS if place.stem == NAMES_OF_HAMS[".1"] else {}
    there = {suffix: beside(place.with_name(names.get(suffix, place.stem) + suffix), suffix) for suffix in widths}
    there = {
        suffix: path for suffix, path in there.items() if path and (suffix == ".1" or path.read_text("latin-1").strip())
    }
    found = {suffix: Table(path, table_of(path, widths[suffix])) for suffix, path in there.items()}
    if ".1" not in found:
        raise FormatError(f"{place} does not exist; allowed: NAME.1 with added mass and damping, or NAME.out")
    return found


def _of_body(rows, columns, modes):
    """Rows whose modes in `columns` all belong to the body, renumbered from 1"""
    for column in columns:
        rows = rows[np.isin(rows[:, column], modes)]
    rows = rows.copy()
    rows[:, columns] -= modes[0] - 1
    return rows


def _read_radiation(table, rho, columns):
    """{quantity: array} of added mass, damping and limits, and ω (n,) rad/s"""
    path, length = table.path, columns.given.length
    table = _of_body(table.rows, [1, 2], columns.modes)
    at = columns.omega(table[:, 0])
    power, index = np.resize(POWER, len(columns.modes)), range(1, len(columns.modes) + 1)
    size = rho * length ** (3 + power + power[:, None])
    quantities = {}
    for limit, name in LIMITS_AT.items():
        part = table[at == limit]
        if len(part):
            quantities[name] = size * gridded(path, [part[:, 1], part[:, 2]], part[:, 3], modes=(index, index))[1]
    between = (at > 0) & np.isfinite(at)
    rows = table[between]
    if not len(rows):
        raise FormatError(f"{path} has no frequency between 0 and infinity")
    (omega, *_), both = gridded(path, [at[between], rows[:, 1], rows[:, 2]], rows[:, 3:5], modes=(index, index))
    if np.isnan(both[..., 1]).any():
        raise FormatError(f"{path} lacks damping; allowed: five numbers a line for each period between 0 and infinity")
    damping = size * omega[:, None, None] * both[..., 1]
    return quantities | {"added_mass": size * both[..., 0], "radiation_damping": damping}, omega


def _read_forces(table, omega, headings, columns, index):
    """Headings (m,) rad and complex values (n, m, modes) at the frequencies ω of the added mass"""
    path, table = table.path, table.rows
    extra = table.shape[1] - 7
    table = _of_body(table, [2 + extra], columns.modes[np.array(index) - 1])
    table[:, 2 + extra] += index[0] - 1
    if extra:  # mean drift of pairs of headings: keep the pairs of one heading with itself
        table = table[table[:, 1] == table[:, 2]]
    at = columns.omega(table[:, 0])
    if not len(table):
        raise FormatError(
            f"{path} has drift for pairs of different headings only; it also needs the drift for each single heading"
        )
    coordinates = [at, np.radians(table[:, 1]), table[:, 2 + extra]]
    (found, own, _), X = gridded(path, coordinates, table[:, -2] + 1j * table[:, -1], modes=(index,))
    places = np.array([int(np.argmin(np.abs(found - w))) for w in omega])
    missing = ~np.isclose(found[places], omega, rtol=SAME_PERIOD, atol=0.0)
    turned = len(headings) and not (len(own) == len(headings) and np.allclose(own, headings, atol=1e-6))
    if missing.any() or turned:
        what = f"headings {_some(np.degrees(own))}° for {_some(np.degrees(headings))}°"
        if missing.any():
            what = f"no {_some(2 * np.pi / omega[missing])} s ({_some(omega[missing])} rad/s)"
        raise OtherPlaces(
            f"{path} does not have the periods and headings of the other files; allowed: the same; it has {what}"
        )
    return own, X[places]
