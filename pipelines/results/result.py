"""The result of a study: quantities, labels of their axes, findings, provenance.

The views of a result are print and CSV (`tables`), JSON (`documents`), HDF5 (`writing`, `file`), xarray and pandas
(`frames`).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from hakobune.mooring.criteria.failing import FAILS, failing

from .quantity import Quantity

if TYPE_CHECKING:
    import pandas
    import xarray

    from .given import File

PLACE = re.compile(r"(?P<head>[^\[\]]+)\[(?P<label>[^\]]+)\](?:\.(?P<tail>.+))?")


@dataclass(frozen=True, eq=False)
class Result(Mapping[str, Any]):
    """kind : kind of study, as "moor"
    quantities : {name: Quantity}; dots separate the parts of a name, and the first part names the object
    labels : {axis: Quantity of its labels, or of its values}
    findings : lines; failures begin with FAILS (`mooring.criteria.failing`)
    notes : lines, printed, with information that the tables lack; first : findings printed before the tables
    provenance : {name: text} of the input, the database and the version of the program
    detail : the return value of the study's own function, for a result that was not read from a file
    """

    kind: str
    quantities: dict[str, Quantity]
    labels: dict[str, Quantity] = field(default_factory=dict)
    findings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    first: tuple[str, ...] = ()
    provenance: dict[str, str] = field(default_factory=dict)
    detail: Any = None

    def __post_init__(self):
        both = self.quantities.keys() & self.labels.keys()
        if both:
            raise ValueError(f"{min(both)!r} names both a quantity and an axis; rename one of them")
        for name, one in self.quantities.items():
            for axis, size in zip(one.axes, one.values.shape, strict=True):
                found = self.labels.get(axis)
                if found is None or len(found.values) != size:
                    raise ValueError(
                        f"{name} has {size} values on the axis {axis!r}, which has a different number of labels"
                    )

    def __getitem__(self, name: str) -> Any:
        """Values by name: "tension.largest", for one line "tension[bow].largest" or "bow.largest".  Raises KeyError."""
        return self.quantity(name).values[()]

    def __iter__(self) -> Iterator[str]:
        return iter(self.quantities)

    def __len__(self) -> int:
        return len(self.quantities)

    def __eq__(self, other: object) -> bool:
        parts = ("kind", "quantities", "labels", "findings", "notes", "first", "provenance")
        return isinstance(other, Result) and all(getattr(self, part) == getattr(other, part) for part in parts)

    __hash__ = None

    @property
    def told(self) -> tuple[str, ...]:
        """All findings; those printed before the tables come first"""
        return (*self.first, *self.findings)

    @property
    def fails(self) -> tuple[str, ...]:
        """Findings that report a failure"""
        return tuple(line.removeprefix(FAILS) for line in failing(self.told))

    @property
    def status(self) -> int:
        """Exit status of the command: 1 if something fails, else 0"""
        return int(bool(failing(self.told)))

    def quantity(self, name: str) -> Quantity:
        """The Quantity of a name; if the name contains a label of the first axis, the Quantity at that label.
        Raises KeyError.
        """
        if name in self.quantities:
            return self.quantities[name]
        found = PLACE.fullmatch(name)
        whole = "" if found is None else ".".join(filter(None, (found["head"], found["tail"])))
        if found and whole in self.quantities:
            all_of_it = found["label"] == "*" or not self.quantities[whole].axes
            return self.quantities[whole] if all_of_it else self._at(whole, found["label"])
        for whole, one in self.quantities.items():  # "surge.sigma" of record.sigma
            label = name.removesuffix("." + whole.partition(".")[2])
            if one.axes and label != name and label in self._shown(one.axes[0]):
                return self._at(whole, label)
        raise KeyError(f"{name!r} is not a quantity of this result; allowed: {', '.join(self.quantities)}")

    def _at(self, name, label):
        one = self.quantities[name]
        shown = self._shown(one.axes[0])
        if label not in shown:
            raise KeyError(
                f"{label!r} is not among the {one.axes[0]} labels of this result; allowed: {', '.join(shown)}"
            )
        place = shown.index(label)
        unit = one.unit[place] if isinstance(one.unit, tuple) else one.unit
        return replace(one, values=one.values[place], axes=one.axes[1:], unit=unit)

    def _shown(self, axis):
        return [str(label) for label in self.labels[axis].values]

    def __repr__(self) -> str:
        failed = f", {len(self.fails)} fail" if self.fails else ""
        return f"<{self.kind}: {len(self.quantities)} quantities, {len(self.told)} findings{failed}>"

    def _repr_html_(self) -> str:
        from .frames import as_html

        return as_html(self)

    def to_xarray(self) -> xarray.Dataset:
        """An xarray.Dataset with all quantities, their axes, units and descriptions"""
        from .frames import as_xarray

        return as_xarray(self)

    def to_dataframe(self, *names: str) -> pandas.DataFrame:
        """A pandas.DataFrame of quantities with the same axes. Raises ValueError where the axes differ."""
        from .frames import as_dataframe

        return as_dataframe(self, *names)

    def to_json(self) -> str:
        """One JSON document, complete and at full precision"""
        from .documents import as_json

        return as_json(self)

    def to_csv(self) -> str:
        """Tables of all quantities at full precision, in SI, a blank line between them"""
        from .documents import as_csv

        return as_csv(self)

    def write(self, path: File) -> None:
        """Write the result to an HDF5 file, which `read` reads"""
        from .writing import write

        write(self, path)

    def show(self) -> None:
        """Print tables, notes and findings"""
        from .tables import printed

        printed(self)


def labels(axis: str, values: Any, unit: str | tuple[str, ...] = "", description: str = "") -> dict[str, Quantity]:
    """{axis: its labels}, for `Result`"""
    return {axis: Quantity(np.asarray(values), (axis,), unit, description or axis)}


def records(given):
    """{name: Quantity} of {name: (values, axes, unit, description)}, for long records that are only written to
    files
    """
    return {
        name: Quantity(values, axes, unit, words, record=True) for name, (values, axes, unit, words) in given.items()
    }
