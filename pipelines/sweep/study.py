"""A sweep as typed TOML: a command, a study, and its varied keys.

command = "berth"                 [[vary]]
study = "berth_tanker.toml"       key = "approach.speed"
sampling = "grid"                 values = [0.1, 0.15, 0.2]
                                  [[vary]]
                                  key = "fender[0].dolphin"
                                  from = 2e4
                                  to = 5e4
                                  count = 4

A grid runs every combination of values. A Latin hypercube runs `samples` cases, evenly spread in each range
(scipy.stats.qmc).
"""

import copy
import itertools
import re

import msgspec
import numpy as np

from ..common.bounds import check_count
from ..common.quantities import StudyError, Table
from ..common.typed import read_toml, typed

SAMPLINGS = ("grid", "latin-hypercube")
MOST = 100_000  # cases
SOLVE = "solve"  # sweep of scenes, with the coefficients (case, frequency, …) of all cases in one file
COMMANDS = (
    SOLVE,
    "moor",
    "response",
    "lines",
    "line-dynamics",
    "single-point",
    "berth",
    "breakwater",
    "simulate",
    "passing",
)


class VaryTable(Table):
    """A key that is varied, over values or a range

    key : path of the key in the study, as "waves.height" or "lines[0].length"; "rope[*].hardening" is the hardening
        of every rope
    values : values of the key; or give from and to
    count : number of values of a grid, both ends included
    """

    key: str
    values: list[float | str | bool] | None = None
    first: float | None = msgspec.field(default=None, name="from")
    last: float | None = msgspec.field(default=None, name="to")
    count: int | None = None


class SweepTable(Table):
    """Many cases of one study

    command : command that is run: solve (its study is a scene), moor, response, lines, line-dynamics, single-point,
        berth, breakwater or simulate
    study : file beside this one whose keys are varied
    arguments : arguments of the command after the study, as ["--database", "box.h5"]; paths are relative to the folder
        where the sweep is run
    sampling : "grid", every combination, or "latin-hypercube", samples spread evenly over ranges
    samples : number of samples of a Latin hypercube
    seed : random seed of a Latin hypercube
    keep : names of the quantities kept for each case, as ["tension[*].largest", "surge.sigma"]; by default all
        numbers and short lists
    """

    command: str
    study: str
    vary: list[VaryTable]
    arguments: list[str] = msgspec.field(default_factory=list)
    sampling: str = "grid"
    samples: int | None = None
    seed: int = 1
    keep: list[str] = msgspec.field(default_factory=list)


def read_sweep(path):
    """The SweepTable of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_toml(path, "a sweep", StudyError)
    sweep = typed(raw, SweepTable, StudyError)
    for key, value, allowed in (("command", sweep.command, COMMANDS), ("sampling", sweep.sampling, SAMPLINGS)):
        if value not in allowed:
            raise StudyError(f"{key} is {value!r}; allowed: {', '.join(allowed)}")
    if not sweep.vary:
        raise StudyError("vary is empty; give at least one [[vary]]")
    keys = [one.key for one in sweep.vary]
    if len(set(keys)) < len(keys):
        raise StudyError(f"two [[vary]] have the key {max(keys, key=keys.count)!r}; give each key once")
    return sweep, text


def cases(sweep):
    """[(value of each varied key), …], one tuple for each case, in the order of the runs.  Raises StudyError."""
    if sweep.sampling == "grid":
        if sweep.samples is not None:
            raise StudyError('samples is given; it needs sampling = "latin-hypercube"')
        axes = [_values(f"vary[{i}]", one) for i, one in enumerate(sweep.vary)]
        check_count("the sweep", int(np.prod([len(axis) for axis in axes])), 1, MOST, StudyError)
        return list(itertools.product(*axes))
    check_count("samples", sweep.samples or 0, 1, MOST, StudyError)
    from scipy.stats import qmc

    for i, one in enumerate(sweep.vary):
        if one.values is not None or one.first is None or one.last is None or not one.first < one.last:
            raise StudyError(
                f"vary[{i}]: a Latin hypercube needs the keys from and to in place of values, where from is the "
                "smaller number"
            )
    unit = qmc.LatinHypercube(len(sweep.vary), rng=sweep.seed).random(sweep.samples)
    low, high = np.array([(one.first, one.last) for one in sweep.vary]).T
    return [tuple(row) for row in (low + unit * (high - low)).tolist()]


def _values(where, one):
    if (one.values is None) == (one.first is None or one.last is None or one.count is None):
        raise StudyError(f"{where} ({one.key}): give values, or from, to and count")
    if one.values is not None:
        check_count(f"{where}.values", len(one.values), 1, MOST, StudyError)
        return one.values
    check_count(f"{where}.count", one.count, 2, MOST, StudyError)
    return np.linspace(one.first, one.last, one.count).tolist()


def varied(raw, keys, values):
    """A copy of nested tables with each value at its key.  Raises StudyError as `put` does."""
    for key, value in zip(keys, values, strict=True):
        raw = put(raw, key, value)
    return raw


def check_keys(command, raw):
    """Raise StudyError for a key that the command does not know, or of a wrong type: every case would fail.

    A study with a [site] is not checked here: its command inserts the values of the site before it reads the tables.
    """
    from ..keys.kinds import struct_of

    if "site" not in raw:
        typed(raw, struct_of(command), StudyError)


def put(raw, key, value):
    """A copy of nested tables with a value at a key; [*] : in every table of a list.

    raises : StudyError if its table does not exist
    """
    made = copy.deepcopy(raw)
    *path, last = re.findall(r"[^.\[\]]+", key)
    try:
        for at in _tables(made, path):
            at[int(last) if isinstance(at, list) else last] = value
    except (KeyError, IndexError, ValueError, TypeError):
        raise StudyError(f"the study has no table for the key {key!r}; add the table to the study") from None
    return made


def _tables(at, path):
    """The tables at a path.  Raises KeyError, IndexError, ValueError or TypeError if there are none."""
    if not path:
        return [at]
    if path[0] == "*":
        if not isinstance(at, list) or not at:
            raise TypeError("no list")
        return [table for one in at for table in _tables(one, path[1:])]
    return _tables(at[int(path[0])] if isinstance(at, list) else at[path[0]], path[1:])
