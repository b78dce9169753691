"""`hakobune.simulate`: simulation of a mooring study in time, and the contents of the file of its runs."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hakobune.bem.database.integrity import DatabaseError
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.motion.extremes import CONFIDENCE
from hakobune.mooring.motion.statistics import windows

from ..executors.choice import executor_of
from ..moor.anchors import quantities_of_anchors
from ..results.given import File, Tables, database_of
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .berth import fender_strains, findings_on_fenders, findings_on_periods, most_pressed
from .file import LEFT_OUT, SUMMARY, bodies_of, fender_names, opened, stored_findings, units_of, whole_rows, words_of
from .file import told as file_told
from .findings import findings
from .over_runs import (
    anchors_in_runs,
    bed_in_runs,
    excursion_in_runs,
    largest_in_runs,
    most_loaded,
    notes,
    on_anchors,
    overloads,
    used_in_runs,
)
from .run import input_of
from .run import simulate as fill

if TYPE_CHECKING:
    from rich.console import Console

    from hakobune.bem.database import Database

    from ..moor.study import Study

KIND = "simulate"
PLANE = ("surge", "sway", "yaw")
MOTIONS, LINES, FENDERS = (
    "motions and waves, places from rest; highest third: from the mean",
    "tension of the lines in all runs",
    "fenders in all runs",
)
BEAMS = "beams that bend, at their stations in all runs"
HINGES = "forces and moments of hinges in all runs, along the axes of their first body"
RUNS, BERTH, GAPS = "runs", "berth", "clear water between hulls in all runs"
ANCHORS = "anchors and bed, of the line at rest with the largest tension of all runs"
WORDS = {  # statistics: (heading, unit or None for that of the record, whether it is printed)
    "mean": ("mean", None, True),
    "sigma": ("σ", None, True),
    "slow": ("σ slow", None, True),
    "wave": ("σ wave", None, True),
    "T_zero": ("T zero", "s", True),
    "T_peak": ("T peaks", "s", False),
    "epsilon": ("spectral width ε", "", False),
    "mean_third": ("highest third", None, True),
    "mean_tenth": ("highest tenth", None, False),
    "smallest": ("smallest", None, True),
    "largest": ("largest", None, True),
}
END = {
    "median": "median extreme",
    "low": f"{100 * CONFIDENCE:.0f} % interval from",
    "high": f"{100 * CONFIDENCE:.0f} % interval to",
}


class NoWholeRun(DatabaseError):
    """Every seed failed; `args[1]` contains the failures, one line each"""

    def __str__(self):
        return self.args[0]


def simulate(
    study: File | Tables | Study,
    database: File | Database,
    output: File | None = None,
    *,
    seeds: int | None = None,
    duration: float | None = None,
    fresh: bool = False,
    executor: str = "local",
    window: float | None = None,
    console: Console | None = None,
) -> Result:
    """Motions in time of a moored body, or of several bodies that are moored together, seed by seed.

    study : path of a mooring study, its tables as a dictionary, or a `pipelines.moor.study.Study`
    database : path of the body's database, or an open one
    output : path of the file of all runs, continued where it stopped; None to keep no file
    seeds : number of seeds, in place of the study's; duration : duration of a run, s, in place of the study's
    fresh : whether to replace an existing file
    executor : executor as in the command; window : length of the windows reported for the first record, s
    console : console for the progress
    returns : Result, in SI; records are in the file
    raises : ValueError, with a message of one line, before anything is written; KeyboardInterrupt, complete seeds
    are kept
    """
    if output is None:
        with tempfile.TemporaryDirectory() as folder:
            return simulate(study, database, Path(folder) / "run.h5", seeds=seeds, duration=duration,
                            executor=executor, window=window, console=console)  # fmt: skip
    workers = executor_of(executor)
    try:
        outcome = fill(input_of(study), database_of(database), output, console, workers, seeds, duration, fresh, window)
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    if outcome.interrupted:
        raise KeyboardInterrupt
    failed = tuple(fails(f"seed {seed}: {reason}") for seed, reason in outcome.failures)
    return read_run(output, window, failed)


def read_run(path, window=None, more=()):
    """Result of the file of a simulation; window : as in `simulate`; more : further findings.  Raises DatabaseError."""
    with opened(path) as file:
        if not whole_rows(file).any():
            if more:
                raise NoWholeRun(f"{path} contains no complete run: {more[0]}", more)
            raise DatabaseError(f"{path} contains no complete run; run the command that made it again to continue")
        return result_of(file, window, more)


def result_of(file, window=None, more=()):
    """Result of the open file of a simulation"""
    names, rows = list(file["quantity"].asstr()[()]), np.asarray(file["summary"][()])
    values = {name: dict(zip(SUMMARY, row, strict=True)) for name, row in zip(names, rows, strict=True)}
    lines, fenders = list(file["line"].asstr()[()]), fender_names(file)
    hinges, stations = (list(file[axis].asstr()[()]) if axis in file else [] for axis in ("hinge", "station"))
    units = dict(zip(names, units_of(file), strict=True))
    records = [*words_of(file), "wave", "wind speed"]  # statistics of a file before lines
    quantities = {
        **_statistics("record", MOTIONS, "record", [values[name] for name in records], units_of(file)[: len(records)]),
        **_of_gaps(names, values),
        **_of_lines(file, [values[f"tension {name}"] for name in lines]),
        **_of_anchors(file),
        **_of_fenders(file, fenders, values),
        **_at_places("hinge", HINGES, hinges, units, values),
        **_at_places("station", BEAMS, stations, units, values),
        **_of_berth(file),
        **_scalars(file),
    }
    axes = {
        **labels("record", records), **labels("line", lines), **labels("fender", fenders), **labels("plane", PLANE),
        **labels("hinge", hinges), **labels("station", stations),
        **labels("gap", [name.removeprefix("gap ") for name in names if name.startswith("gap ")]),
        **labels("seed", file["seed"][()][whole_rows(file)]), **labels("harbour", file.attrs.get("harbour_period", [])),
    }  # fmt: skip
    if window is not None:
        start, quantities_of_windows = _windows(file, window)
        quantities |= quantities_of_windows
        axes |= labels("window", start, "s", "begin")
    used = {axis for one in quantities.values() for axis in one.axes}
    told, first = file_told(file), tuple(line for line in file_told(file) if line.startswith(LEFT_OUT))
    found = (*stored_findings(file), *findings(file), *findings_on_periods(file), *overloads(file),
             *on_anchors(file), *findings_on_fenders(file), *more)  # fmt: skip
    return Result(
        KIND,
        quantities,
        {axis: one for axis, one in axes.items() if axis in used},
        tuple(line for line in dict.fromkeys(found) if line not in told),
        (*most_loaded(file), *most_pressed(file), *notes(file),
         *filter(None, [str(file.attrs.get("design_spectrum", ""))]),
         *(line for line in told if line not in first)),
        first,
        provenance(str(file.attrs["study"]), database_path=str(file.attrs["database"])),
    )  # fmt: skip


def _statistics(head, table, axis, rows, units):
    """{name: Quantity} of statistics over all runs.  rows : {statistic: value} of each label; units : units of each"""
    made = {}
    for key, (words, unit, shown) in WORDS.items():
        own = tuple(units) if unit is None else unit
        own = own[0] if len(set(own)) == 1 and unit is None else own
        made[f"{head}.{key}"] = Quantity([row[key] for row in rows], (axis,), own, words, table if shown else "")
    ends = ["lower" if abs(row["lower_median"]) > abs(row["upper_median"]) else "upper" for row in rows]
    for part, words in END.items():  # words for the end that is further from zero
        further = [row[f"{end}_{part}"] for row, end in zip(rows, ends, strict=True)]
        own = made[f"{head}.largest"].unit
        made[f"{head}.extreme_{part}"] = Quantity(
            further, (axis,), own, words, table if np.any(np.isfinite(further)) else ""
        )
    return made


def _of_lines(file, rows):
    if not rows:
        return {}
    made = _statistics("tension", "", "line", rows, ("N",) * len(rows))
    for key in ("mean", "sigma", "smallest", "largest"):
        one = made[f"tension.{key}"]
        made[f"tension.{key}"] = Quantity(one.values, one.axes, "N", one.description, LINES)
    used, simplified = used_in_runs(file), np.asarray(file.attrs.get("simplified_tension", []), float)
    of = "used of MBL" if "fender_height" in file.attrs else "used"
    made["tension.used"] = Quantity(used.max(axis=0), ("line",), "", of, LINES, share=True)
    if len(simplified):
        pulled = made["tension.largest"].values
        made["tension.simplified"] = Quantity(simplified, ("line",), "N", "simplified", LINES)
        made["tension.over_simplified"] = Quantity(pulled / simplified, ("line",), "", "over simplified", LINES)
        share = np.asarray(file.attrs["simplified_utilisation"], float)
        made["tension.used_simplified"] = Quantity(share, ("line",), "", "used, simplified", LINES, share=True)
    breaking = np.asarray(file.attrs["breaking_load"], float)
    berth, allowable = "fender_height" in file.attrs, float(file.attrs["allowable"])  # whether it has fenders or ropes
    word, table = ("MBL", LINES) if berth else ("breaking load", "")
    made["line.breaking_load"] = Quantity(breaking, ("line",), "N", word, table)
    if berth:
        made["line.working_load"] = Quantity(
            allowable * breaking, ("line",), "N", f"WLL, {100 * allowable:g} % of MBL", LINES
        )
        made["tension.used_of_working"] = Quantity(
            used.max(axis=0) / allowable, ("line",), "", "used of WLL", LINES, share=True
        )
    largest = largest_in_runs(file, "tension")[0]
    made["tension.largest_of_seed"] = Quantity(largest, ("seed", "line"), "N", "largest in each run")
    return made


def _of_anchors(file):
    """Pulls at the anchors and lengths on the bed, as in `moor`; {} without lines"""
    found, bed = anchors_in_runs(file), bed_in_runs(file)
    if not found or not bed:
        return {}
    (anchors, along, up), (at_rest, least) = found, bed
    columns = {
        "anchor.largest_vertical": ("N", "largest lift", up),
        "anchor.largest_horizontal": ("N", "largest horizontal", along),
        "grounded.at_rest": ("m", "on the bed at rest", at_rest),
        "grounded.at_largest": ("m", "on the bed at the largest", least),
    }
    own = {name: Quantity(values, ("line",), unit, words, ANCHORS) for name, (unit, words, values) in columns.items()}
    return own | quantities_of_anchors(anchors, along, up)


def _of_gaps(names, values):
    """Clear water between several hulls, {} for one"""
    found = [values[name] for name in names if name.startswith("gap ")]
    return {
        f"gap.{key}": Quantity([row[key] for row in found], ("gap",), "m", words, GAPS)
        for key, words in (("mean", "mean"), ("smallest", "smallest"), ("largest", "largest"))
        if found
    }


def _at_places(kind, table, names, units, values):
    """{name: Quantity} of what hinges hold, or beams carry at stations, by names; units : {name: unit}"""
    own = tuple(units[name] for name in names)
    return {
        f"{kind}.{key}": Quantity([values[name][key] for name in names], (kind,), own, WORDS[key][0], table)
        for key in ("mean", "sigma", "smallest", "largest")
        if names
    }


def _of_fenders(file, names, values):
    if not names:
        return {}
    made = {}
    for what, unit in (("deflection", "m"), ("reaction", "N")):
        rows = [values[f"{what} {name}"] for name in names]
        for key in ("mean", "largest"):
            words = f"{WORDS[key][0]} {what}"
            made[f"{what}.{key}"] = Quantity([row[key] for row in rows], ("fender",), unit, words, FENDERS)
        further = [row["upper_median"] for row in rows]
        made[f"{what}.extreme_median"] = Quantity(further, ("fender",), unit, f"median extreme of the {what}")
    if "fender_rated_reaction" in file.attrs:
        rated = np.asarray(file.attrs["fender_rated_reaction"], float)
        made["reaction.rated"] = Quantity(rated, ("fender",), "N", "rated reaction", FENDERS)
        share = made["reaction.largest"].values / rated
        made["reaction.used"] = Quantity(share, ("fender",), "", "used of rated", FENDERS, share=True)
    strains = fender_strains(file)
    if strains is not None:
        share, allowable = strains
        made["strain.largest"] = Quantity(share, ("fender",), "", "largest strain", FENDERS, share=True)
        made["strain.allowable"] = Quantity(allowable, ("fender",), "", "allowable strain", FENDERS, share=True)
    return made


def _of_berth(file):
    if "natural_period" not in file.attrs:
        return {}
    period = np.asarray(file.attrs["natural_period"], float)
    return {"natural_period": Quantity(period, ("plane",), "s", "natural period of small motions at the berth", BERTH)}


def _scalars(file):
    seeds = int(whole_rows(file).sum())
    rows = {
        "seeds": (seeds, "", "runs"),
        "duration": (float(file.attrs["duration"]), "s", "duration of a run"),
        "mean_period": (float(file.attrs["mean_period"]), "s", "mean period of the waves"),
        "split_frequency": (float(file.attrs["split_frequency"]), "rad/s", "upper frequency of slow motion"),
        "allowable": (float(file.attrs["allowable"]), "", "allowable share of the breaking load"),
    }
    made = {
        name: Quantity(value, (), unit, words, RUNS if name != "allowable" else "", name == "allowable")
        for name, (value, unit, words) in rows.items()
    }
    if "excursion" in file:
        made["excursion"] = Quantity(excursion_in_runs(file), (), "m", "largest excursion from rest", RUNS)
    if "spectral_slow" in file.attrs and not bodies_of(file):
        spectral = np.asarray(file.attrs["spectral_slow"], float)
        made["slow_by_spectrum"] = Quantity(
            spectral, ("plane",), ("m", "m", "rad"), "σ of slow motion, linear, by spectra"
        )
    return made


def _windows(file, length):
    """Begin of each window, s, and {name: Quantity} of the first stored record"""
    step = float(np.diff(file["time"][:2])[0])
    found, made = windows(file["motion"][0].astype(float), step, length), {}
    title = f"seed {int(file['kept_seed'][0])} in windows of {length:g} s"
    for k, (name, unit) in enumerate(zip(PLANE, ("m", "m", "rad"), strict=True)):
        words = f"{name}, significant amplitude"
        made[f"window.{name}"] = Quantity(found.amplitude[:, k], ("window",), unit, words, title)
        made[f"window.{name}_period"] = Quantity(found.period[:, k], ("window",), "s", "period", title)
    return found.start, made
