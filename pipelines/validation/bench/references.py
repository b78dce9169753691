"""Reference coefficients, and the error of a result against them.

    error of c = max over ω |c − c_ref| / max over ω |c_ref|,        c of A_ij, B_ij, X_i

The worst coefficient counts.  Excluded are coefficients that are small relative to others of their kind: A_ij and B_ij
below a hundredth of √(A_ii A_jj), A_ii and B_ii below a ten-thousandth and X_i below a hundredth of the largest
(rotations by the body's reach), which excludes only the yaw of a cylinder. The table is made, and checked, by
tests/bench/solver_references.py: cylinders exactly, boxes by the contour method.
"""

from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import csv_rows

from .cases import CASES, PAIRS

FILE = Path(__file__).with_name("references.csv")
COLUMNS = tuple(letter + pair for letter in "AB" for pair in PAIRS) + tuple(
    f"X{i}_{part}" for i in range(1, 7) for part in ("re", "im")
)
NEGLIGIBLE = 0.01


class Coefficients(NamedTuple):
    """A, B : (n, 6, 6) kg …, kg/s …; X : (n, 6) N/m …, complex, at n frequencies"""

    A: np.ndarray
    B: np.ndarray
    X: np.ndarray

    def named(self):
        """{A11: (n,), …, X1: (n,), …}"""
        out = {
            letter + pair: values[:, int(pair[0]) - 1, int(pair[1]) - 1]
            for letter, values in (("A", self.A), ("B", self.B))
            for pair in PAIRS
        }
        return out | {f"X{i + 1}": self.X[:, i] for i in range(6)}


class Error(NamedTuple):
    """The worst relative error and the coefficient that has it"""

    value: float
    of: str


@cache
def references():
    """{case: {A11: (n,), …}} at the case's frequencies"""
    rows = list(csv_rows(FILE.read_text(encoding="utf-8")))
    out = {}
    for case in CASES.values():
        mine = [row for row in rows if row["case"] == case.name]
        if tuple(float(row["omega"]) for row in mine) != case.omega:
            raise ValueError(f"{FILE} does not have the frequencies of {case.name}; make it again")
        values = {name: np.array([float(row[name]) for row in mine]) for name in COLUMNS}
        force = {f"X{i}": values.pop(f"X{i}_re") + 1j * values.pop(f"X{i}_im") for i in range(1, 7)}
        out[case.name] = values | force
    return out


def compared(case, reference):
    """{name: largest over the frequencies} of the coefficients that are not negligible"""
    largest = {name: float(np.abs(values).max()) for name, values in reference.items()}
    arms = dict(zip("123456", np.repeat([1.0, case.reach], 3), strict=True))
    out = {}
    for letter in "AB":
        own = {d: largest[letter + d + d] for d in arms}
        most = max(own[d] / arms[d] ** 2 for d in arms)
        moving = [d for d in arms if own[d] > NEGLIGIBLE**2 * most * arms[d] ** 2]
        for i, j in PAIRS:
            value = largest[letter + i + j]
            if i in moving and j in moving and value > NEGLIGIBLE * np.sqrt(own[i] * own[j]):
                out[letter + i + j] = value
    most = max(largest["X" + d] / arms[d] for d in arms)
    return out | {"X" + d: largest["X" + d] for d in arms if largest["X" + d] > NEGLIGIBLE * most * arms[d]}


def error(case, found):
    """`Error` of `Coefficients` at the case's frequencies.  Raises ValueError if one is not finite."""
    reference, ours = references()[case.name], found.named()
    errors = {
        name: float(np.abs(ours[name] - reference[name]).max()) / size
        for name, size in compared(case, reference).items()
    }
    bad = [name for name, value in errors.items() if not np.isfinite(value)]
    if bad:
        raise ValueError(f"{', '.join(bad)} not finite")
    worst = max(errors, key=errors.get)
    return Error(errors[worst], worst)
