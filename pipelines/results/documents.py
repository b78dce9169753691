"""A result as CSV and as one JSON document: all its quantities, all digits, in SI.

Long records are in the file and in xarray alone.
"""

import csv
import io
import json

import numpy as np

from hakobune.mooring.criteria.failing import FAILS

from .tables import tables


def as_csv(result):
    """Text: for each table its names with units, then its rows, then a blank line"""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    for shown in tables(result, True):
        if not shown.axis:
            writer.writerow(["quantity", "value", "unit"])
            writer.writerows([c.name, _plain(c.values[0]), c.units[0]] for c in shown.columns)
        else:
            mixed = any(len(c.units) > 1 for c in shown.columns)
            names = [_named(c.name, c.units[0] if len(c.units) == 1 else "") for c in shown.columns]
            writer.writerow([_named(shown.axis, result.labels[shown.axis].unit), *(["unit"] if mixed else ()), *names])
            units = next((c.units for c in shown.columns if len(c.units) > 1), ())
            for row, label in enumerate(shown.labels):
                values = [_plain(c.values[row]) for c in shown.columns]
                writer.writerow([label, *([units[row]] if mixed else ()), *values])
        out.write("\n")
    return out.getvalue()


def as_json(result):
    """A line of text: {"kind", "quantities": {name: {"unit", "axes", "values"}}, "axes", "findings", "provenance"}

    A number that is not finite is null; a complex one is [real, imaginary]
    """
    made = {
        "kind": result.kind,
        "quantities": {name: _described(one) for name, one in result.quantities.items() if not one.record},
        "axes": {axis: _described(one) for axis, one in result.labels.items()},
        "findings": [{"fails": line.startswith(FAILS), "text": line.removeprefix(FAILS)} for line in result.told],
        "notes": list(result.notes),
        "provenance": result.provenance,
    }
    return json.dumps(made, ensure_ascii=False) + "\n"


def _described(one):
    unit = list(one.unit) if isinstance(one.unit, tuple) else one.unit
    return {"unit": unit, "axes": list(one.axes), "description": one.description, "values": _nested(one.values)}


def _nested(values):
    if values.ndim:
        return [_nested(row) for row in values]
    return _finite(values.item())


def _finite(value):
    if isinstance(value, complex):
        return [_finite(value.real), _finite(value.imag)]
    return value if not isinstance(value, float) or np.isfinite(value) else None


def _plain(value):
    value = value.item() if isinstance(value, np.generic) else value
    return "" if _finite(value) is None else value


def _named(name, unit):
    return f"{name} [{unit}]" if unit else name
