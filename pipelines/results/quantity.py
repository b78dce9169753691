"""A named array of a result: its axes, its unit, and its print unit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

KILO, TURN = 1e3, np.pi / 180
READ_IN = {  # SI unit: (print unit, its size); units a thousand times larger only for numbers that reach them
    "N": ("kN", KILO), "N m": ("kN m", KILO), "N/m": ("kN/m", KILO), "N m/rad": ("kN m/rad", KILO), "J": ("kJ", KILO),
    "N/rad": ("kN/rad", KILO), "N m/m": ("kN m/m", KILO), "N/m2": ("kN/m²", KILO),
    "Pa": ("kPa", KILO), "kg": ("t", KILO), "N s/m": ("kN s/m", KILO), "N s2/m2": ("kN s²/m²", KILO),
    "N m s": ("kN m s", KILO), "N m s2": ("kN m s²", KILO), "kg m2": ("t m²", KILO), "kg m": ("t m", KILO),
    "rad": ("°", TURN), "rad/m": ("°/m", TURN), "%": ("%", 0.01),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Quantity:
    """values : array of numbers, texts or truths, of any rank; numbers in SI
    axes : name of each of its axes
    unit : "" for none; if units differ, as for surge and roll, a tuple with one unit for each label of the first axis
    description : a noun with its attributes
    table : title of the table in which the quantity is printed; "" for a quantity that only CSV, JSON and files
        contain
    share : whether it is printed in per cent; record : whether it is a long record, such as a time series, only
        written to files
    """

    values: np.ndarray
    axes: tuple[str, ...] = ()
    unit: str | tuple[str, ...] = ""
    description: str = ""
    table: str = ""
    share: bool = False
    record: bool = False

    if TYPE_CHECKING:  # values may be given as lists or numbers

        def __init__(
            self,
            values: ArrayLike,
            axes: tuple[str, ...] = (),
            unit: str | tuple[str, ...] = "",
            description: str = "",
            table: str = "",
            share: bool = False,
            record: bool = False,
        ) -> None: ...

    def __post_init__(self):
        values = np.asarray(self.values)
        if values.ndim != len(self.axes):
            raise ValueError(
                f"{self.description}: values have {values.ndim} axes, and {len(self.axes)} axes are named: {self.axes}"
            )
        object.__setattr__(self, "values", values.astype(object).astype(str) if values.dtype.kind == "O" else values)

    @property
    def numeric(self) -> bool:
        return self.values.dtype.kind in "fiuc"

    def units(self) -> tuple[str, ...]:
        """One unit for each label of the first axis, or one for all"""
        return self.unit if isinstance(self.unit, tuple) else (self.unit,)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Quantity):
            return False
        same = all(
            getattr(self, part) == getattr(other, part)
            for part in ("axes", "unit", "description", "table", "share", "record")
        )
        return same and np.array_equal(self.values, other.values, equal_nan=self.values.dtype.kind in "fc")


def quantities(table, given, *axes, record=False) -> dict[str, Quantity]:
    """{name: Quantity} from {name: (values, unit, description)} with the same axes, to be printed in one table

    the unit "%" marks shares, which are stored unchanged and printed in per cent
    """
    return {
        name: Quantity(values, axes, "" if unit == "%" else unit, words, table, unit == "%", record)
        for name, (values, unit, words) in given.items()
    }


def read_in(unit: str, values, share=False) -> tuple[str, float]:
    """Return (print unit, its size) for values in an SI unit: kN from 1 kN on, N below"""
    name, size = READ_IN.get("%" if share else unit, (unit, 1.0))
    if size == KILO:
        finite = np.abs(values)[np.isfinite(values)]
        if finite.size and 0 < finite.max() < KILO:
            name, size = unit, 1.0
    return name.replace("2", "²").replace("3", "³"), size
