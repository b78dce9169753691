"""Faults of an input in one line: the quantity, its value, the allowed range."""

import numpy as np


def positive(thing, value, unit):
    """The value as a float.  Raises ValueError unless the value is above 0 and finite."""
    if not 0 < value < np.inf:
        raise ValueError(f"{thing} is {value:g} {unit}; allowed: above 0, finite")
    return float(value)


def within(thing, value, low, high, unit=""):
    """The value as a float.  Raises ValueError unless low ≤ value ≤ high."""
    if not low <= value <= high:
        raise ValueError(f"{thing} is {value:g}{unit and ' ' + unit}; allowed: {low:g} to {high:g}")
    return float(value)


def row_of_numbers(thing, values, fewest=1):
    """Finite floats; shape (n,).  Raises ValueError that names the first row without a finite number."""
    values = np.asarray(values, float)
    if values.ndim != 1 or len(values) < fewest:
        raise ValueError(
            f"{thing} has shape {values.shape}; allowed: a one-dimensional array of at least {fewest} numbers"
        )
    if not np.all(np.isfinite(values)):
        i = int(np.argmin(np.isfinite(values)))
        raise ValueError(f"{thing} is {values[i]} at index {i}; allowed: finite numbers")
    return values


def rising(thing, values, fewest=2):
    """Finite floats, strictly rising, the first at least 0; shape (n,).  Raises ValueError."""
    values = row_of_numbers(thing, values, fewest)
    steps = np.diff(values)
    if not np.all(steps > 0):
        i = int(np.argmin(steps > 0))
        raise ValueError(f"{thing} goes from {values[i]:g} to {values[i + 1]:g} at index {i + 1}; allowed: increasing")
    if values[0] < 0:
        raise ValueError(f"{thing} begins with {values[0]:g}; allowed: at least 0")
    return values
