"""Accuracy of the largest tensions of a run: the same run with fewer elements, and with longer steps.

A line that whips becomes taut with snaps, one element after another.  Where such snaps add up, errors of the steps
exceed the tolerance of a single step. At a tolerance of 1e-3, largest tensions have had errors of 16 % at the fairlead
and 8 % inside the line.
The error of a largest tension is proportional to the step, so the change with steps twice as long is about this error.
The error of a single largest value may be small by chance. The largest values of each tenth of the run, at the
fairlead and inside, are therefore compared, and the worst tenth counts. `tests/bench/line_peaks.py` counts how often
the estimate holds.
"""

import warnings

import numpy as np

from ...criteria.failing import fails
from .run import DynamicLineError, run_esdirk
from .start import start

COARSER = 2.0  # factor on the steps of the run, for the comparison run
NONE = 1e-6  # tension that counts as rounding, relative to the larger of both and to the heaviest node
PARTS = 10  # parts of a run whose largest tensions are compared


def mesh_error(case, result, limit):
    """Estimated relative error of the largest tension, at the fairlead or inside, due to the element length; warns
    above limit.

    The error is proportional to the square of the element length.
    """
    counts = [s.elements for s in case.line.segments]
    other = case.line.with_elements(0.5 if min(counts) >= 4 else 2)
    state = start(other, case.motion.at(0.0)[0], case.water)
    found = run_esdirk(_plain(case)._replace(line=other), state)
    ratio = (other.elements / case.line.elements) ** 2
    share = ratio / abs(1 - ratio)
    ours, peaks = _largest(result), _largest(found)
    error = share * _off(peaks - ours, ours, case.line)
    if not np.all(error <= limit):
        at = int(np.argmax(error))
        warnings.warn(
            fails(
                f"{case.line}: the largest tension {_WHERE[at]} is {_kN(ours[at])}, and {_kN(peaks[at])} in "
                f"{other.elements} elements: estimated error {error[at]:.1%}, allowed {limit:.1%}; give more elements"
            ),
            stacklevel=3,
        )
    return float(error.max())


def step_error(case, result, state, limit):
    """Estimated relative error of the largest tension, at the fairlead or inside, due to the steps; warns above limit.

    state : State at the start of the run; nan, with a warning, if longer steps fail
    """
    try:
        found = run_esdirk(_plain(case)._replace(coarser=COARSER), state)
    except DynamicLineError as error:
        warnings.warn(
            f"the error that time steps cause in the largest tensions is not known: the run with longer "
            f"steps failed, {error}",
            stacklevel=3,
        )
        return np.nan
    edges = np.linspace(result.time[0], result.time[-1], PARTS + 1)
    ours, others = _largest_of_parts(result, edges), _largest_of_parts(found, edges)
    error = _off(np.abs(ours - others).max(axis=1), ours.max(axis=1), case.line)
    if not np.all(error <= limit):
        at = int(np.argmax(error))
        part = int(np.argmax(np.abs(ours - others)[at]))
        warnings.warn(
            fails(
                f"{case.line}: the largest tension {_WHERE[at]} from {edges[part]:.4g} to "
                f"{edges[part + 1]:.4g} s is {_kN(ours[at, part])}, and {_kN(others[at, part])} with steps "
                f"{COARSER:g} times as long: time steps leave an error of {error[at]:.1%} in the largest "
                f"tensions, allowed {limit:.1%}; give a tolerance smaller than {case.tolerance:g}"
            ),
            stacklevel=3,
        )
    return float(error.max())


_WHERE = "at the fairlead", "of all elements"


def _kN(tension):
    return f"{1e-3 * tension:.4g} kN"


def _plain(case):
    return case._replace(frames=0, stations=(), stops=())


def _off(difference, of, line):
    """Differences of two forces as shares of `of`, N; shape (2,); 0 for rounding, such as that of a fairlead that lies
    on the bed"""
    none = of <= NONE * max(np.abs(line.system.weight).max(), of.max())
    return np.where(none, 0.0, np.abs(difference) / np.where(none, 1.0, of))


def _largest(result):
    return np.array([result.tension_fairlead.max(), result.largest_tension.max()])


def _largest_of_parts(result, edges):
    """Largest tension of each of the PARTS, at the fairlead and of all elements, N; shape (2, PARTS)"""
    found = np.empty((2, edges.size - 1))
    for row, values in enumerate((result.tension_fairlead, result.largest_tension)):
        ends = np.interp(edges, result.time, values)
        first = np.searchsorted(result.time, edges)
        for k in range(edges.size - 1):
            found[row, k] = max(ends[k], ends[k + 1], values[first[k] : first[k + 1]].max(initial=0.0))
    return found
