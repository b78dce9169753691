"""Line types of a MoorDyn file whose tension is a table over strain, and Syrope polyester ropes at rest.

A new polyester rope follows its original working curve under slow loading.  A rope whose mean tension has reached
T_max keeps a stretch ε₀. Below T_max it follows a working curve from (ε₀, 0) to (ε_max, T_max), a point on the
original curve, with ξ = (ε − ε₀) / (ε_max − ε₀):

    LINEAR T_max ξ,    QUADRATIC T_max ξ (k₂ ξ + 1 − k₂),    EXP T_max (e^{k₂ ξ} − 1) / (e^{k₂} − 1)

ε₀ = k₁ ε_max; for LINEAR with k₁ of 1 or more, ε₀ = ε_max − T_max / k₁.  Above T_max the original curve applies.  At
rest the tension is therefore one rising curve over strain, independent of the path below T_max. The fast stiffness
EA_Dc + EA_D_Lm T applies only in motion.  A rope with the stretch ε₀ is computed as a rope whose length is (1 + ε₀)
times larger. MoorDyn 2.7
documentation, "Inputs", Nonlinear Stiffness and Syrope Model for Polyester Lines; Wei, Bingham and Shao, "Extended
Moordyn Solver and Validation Report" (2026).
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import read_text

from ..lines.multi_segment.segments import Segment
from .fault import FormatError
from .moordyn_rows import finite_number

SYROPE = "syrope:"
POINTS = 101  # points of a working curve; its chords are within 1e-4 of T_max for |k₂| up to 2.5
FORMS = ("linear", "quadratic", "exp")


class WorkingCurves(NamedTuple):
    """original : (n, 2), strain and tension, N, ascending from (0, 0); form : one of FORMS; k1, k2 : constants of
    the working curves
    """

    original: np.ndarray
    form: str
    k1: float
    k2: float

    def after(self, largest):
        """Strain and tension, N, at rest, of a rope whose mean tension has been `largest`, N; shape (k, 2); the first
        tension is 0"""
        strain, tension = self.original.T
        if not 0 <= largest <= tension[-1]:
            raise ValueError(
                f"the mean tension is {largest:g} N; allowed: 0 to {tension[-1]:g} N, the range of its "
                f"original working curve (OWC)"
            )
        if largest == 0:
            return self.original
        end = float(np.interp(largest, tension, strain))
        begin = end - largest / self.k1 if self.form == "linear" and self.k1 >= 1 else self.k1 * end
        if not begin < end:
            raise ValueError(f"working curves begin at the strain {begin:g} and end at {end:g}; allowed: rising curves")
        xi = np.linspace(0.0, 1.0, 2 if self.form == "linear" else POINTS)
        worked = np.column_stack([begin + (end - begin) * xi, largest * self._share(xi)])
        if not np.all(np.diff(worked[:, 1]) > 0):
            raise ValueError(f"a working curve falls (k2 is {self.k2:g}); allowed: rising curves")
        return np.concatenate([worked, self.original[tension > largest]])

    def _share(self, xi):
        if self.form == "linear":
            return xi
        if self.form == "quadratic":
            return xi * (self.k2 * xi + 1 - self.k2)
        return xi if self.k2 == 0 else np.expm1(self.k2 * xi) / np.expm1(self.k2)


def is_tabulated(row):
    """Whether EA of a LineTypeRow is a table or a Syrope rope"""
    return is_syrope(row) or finite_number(row.EA.split("|")[0]) is None


def is_syrope(row):
    return row.EA.lower().startswith(SYROPE)


def curve_of_line(row, kind, syrope, path):
    """Strain and tension, N, at rest, of a LineRow whose LineTypeRow `kind` is tabulated; shape (k, 2).

    syrope : {id of a line: largest earlier mean tension, N}
    raises : FormatError
    """
    name, folder = kind.EA.split("|")[0], Path(path).parent
    try:
        if not is_syrope(kind):
            return _table(folder / name)
        return _working_curves(folder, name[len(SYROPE) :]).after(syrope.get(row.id, 0.0))
    except FormatError as error:
        what = f"EA of {kind.name} is {kind.EA!r}; allowed: a number, a|b, or a file beside this one; {error}"
        raise FormatError(f"{path}, section LINE TYPES: {what}") from None
    except ValueError as error:
        raise FormatError(f"{path}, section LINES: line {row.id} of type {kind.name} has {error}") from None


def segment_of_curve(kind, length, curve):
    """The Segment of a LineType with an elongation curve (k, 2); length : length of the new rope, m."""
    kept = 1 + float(curve[0, 0])
    table = tuple(zip((curve[:, 0] + 1) / kept - 1, curve[:, 1], strict=True))
    return Segment(length * kept, kind.weight / kept, table, kind.diameter, kind.breaking_load, kind.name)


def largest_tensions(file, path):
    """{id of a line: N} of the section SYROPE IC.  raises : FormatError"""
    found, lines = {}, {row.id for row in file.lines}
    for text in file.syrope[2:]:
        words = text.split("#")[0].split()
        if not words:
            continue
        value = finite_number(words[1]) if len(words) > 2 else None
        unknown = set(words[0].split(",")) - lines
        if value is None or unknown:
            what = (
                f"line {min(unknown)} is unknown"
                if unknown
                else (f"{text.strip()!r} does not give line numbers, Tmax0 and Tmean0")
            )
            raise FormatError(f"{path}, section SYROPE IC: {what}; allowed: line numbers such as 1,2, and two numbers")
        found |= dict.fromkeys(words[0].split(","), value)
    return found


def _working_curves(folder, name):
    """WorkingCurves of a settings file, values before names as in OPTIONS; its own paths are the input file's too"""
    path, given = folder / name, {}
    for line in read_text(path, FormatError).splitlines():
        words = line.split()
        given |= {words[1].lower(): words[0]} if len(words) > 1 else {}
    k1, k2 = (finite_number(given.get(key, "")) for key in ("k1", "k2"))
    form = given.get("wctype", "").lower()
    if "owc" not in given or form not in FORMS or k1 is None or k2 is None:
        raise FormatError(
            f"{path} is not a Syrope rope; allowed: a file OWC, WCType {', '.join(FORMS).upper()}, and numbers k1, k2"
        )
    return WorkingCurves(_table(folder / given["owc"]), form, k1, k2)


def _table(path):
    """Strain and tension, N, from 0, 0; shape (n, 2); lines without numbers are its header"""
    rows = []
    for number, line in enumerate(read_text(path, FormatError).splitlines(), 1):
        values = [finite_number(word) for word in line.split()]
        if len(values) == 2 and None not in values:
            rows.append(values)
        elif rows and values:
            raise FormatError(f"{path}, line {number} is {line.strip()!r}; allowed: a strain and a tension")
    table = np.array(rows).reshape(-1, 2)
    if len(table) < 2 or np.any(table[0] != 0) or np.any(np.diff(table, axis=0) <= 0):
        raise FormatError(
            f"{path} has {len(table)} rows; allowed: at least two rows of strain and tension, rising from 0, 0"
        )
    return table
