"""The file of a simulation: one row for each seed, marked by the checksum of the row once the row is whole.

Data first, then the mark, as in a database (`bem.database.integrity`). After a kill at any instant the file opens, and
the same command runs the seeds without a mark.
A checksum of the file covers all other data (`bem.database.results`).  For
more seeds a wider file takes over the rows of the old file.  Statistics of all seeds are stored, records of the first
`keep_series`.
"""

import json
import re
import tomllib
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from hakobune import bem
from hakobune.bem import DOFS
from hakobune.bem.database.file import beside, unlocked
from hakobune.bem.database.integrity import DatabaseError, crc
from hakobune.bem.database.results import check_seal, check_version, named, no_file_of
from hakobune.meshing.seals import kind_filled_in
from hakobune.meshing.whole_files import keep_room
from hakobune.mooring.motion.extremes import Extreme
from hakobune.mooring.motion.statistics import RecordStatistics

SCHEMA = "hakobune simulation 2"
STATISTICS = RecordStatistics._fields
SUMMARY = (*STATISTICS, *(f"{end}_{part}" for end in ("upper", "lower") for part in Extreme._fields))
SLOW = ("Surge", "Sway", "Yaw")
LEFT_OUT = "left out"  # first words of a finding on a neglected effect
DECIMAL = re.compile(r"\d+\.\d+")
LONGEST = 1000  # largest size of the findings of a seed, bytes
SERIES = {  # name: (axes, unit, long name)
    "motion": (("kept_seed", "time", "dof"), "m, m, m, rad, rad, rad", "displacement of the rotation centre from rest"),
    "slow": (
        ("kept_seed", "time", "slow_dof"),
        "m, m, rad",
        "slow pose: surge, sway and yaw by a causal filter, with its delay",
    ),
    "wave": (("kept_seed", "time"), "m", "elevation of the undisturbed wave at the origin"),
    "wind_speed": (("kept_seed", "time"), "m/s", "wind speed with its gusts"),
    "tension": (("kept_seed", "time", "line"), "N", "line tension at the body"),
    "deflection": (("kept_seed", "time", "fender"), "m", "deflection of a fender"),
    "links": (
        ("kept_seed", "time", "hinge"),
        "N, N, N, N m, N m, N m; m or rad of a travel",
        "force and moment of the first body of a hinge on the second, and the travel along or about its axis",
    ),
    "loads": (
        ("kept_seed", "time", "station"),
        "m, rad; N, N m",
        "deflection, twist and loads of beams at their stations",
    ),
}
OF_LINES = {"anchor_pull", "on_bed"}  # rows that are there only where lines are
ONLY_WITH = "fender", "hinge", "station"  # axes that are there only where they have a name
FILLED = ("findings", "stored", "summary", "summary_checksum")
ROWS = {
    "statistics": (("seed", "quantity", "statistic"), "unit of the quantity; T in s", "statistics of one run"),
    "estimated_error": (("seed", "dof"), "m, m, m, rad, rad, rad", "root mean square error of the motions"),
    "steps": (("seed",), "1", "steps of the integrator"),
    "used": (("seed", "line"), "1", "largest share of a breaking load in one run, nan where none is known"),
    "anchor_pull": (
        ("seed", "line", "pull"),
        "N",
        "pull at the anchor, along the bed and up, at the largest tension of one run",
    ),
    "on_bed": (("seed", "line"), "m", "length on the bed at the largest tension of one run"),
    "excursion": (("seed",), "m", "largest horizontal distance of a body from rest in one run"),
}


@dataclass(frozen=True, eq=False)
class Header:
    """Contents of the file that are known before the first run.

    identity : hash of all inputs that results depend on, except the seeds; study : its text; attributes : numbers
    anchor, fairlead : (lines, 3) m in space with the body at rest
    time : (n,) s of the samples that are kept; quantities : names, units : of each
    motions : names, of several bodies barge__Surge and so on
    hinges : names of their quantities, as in `bem.hinges.told_of`; stations : stations of what beams carry at theirs
    """

    identity: str
    study: str
    lines: tuple[str, ...]
    breaking_load: np.ndarray
    anchor: np.ndarray
    fairlead: np.ndarray
    time: np.ndarray
    quantities: tuple[str, ...]
    units: tuple[str, ...]
    attributes: dict = field(default_factory=dict)
    fenders: tuple[str, ...] = ()
    motions: tuple[str, ...] = DOFS
    hinges: tuple[str, ...] = ()
    stations: tuple[str, ...] = ()

    @property
    def some(self):
        """{axis of ONLY_WITH: names}"""
        return dict(zip(ONLY_WITH, (self.fenders, self.hinges, self.stations), strict=True))

    @property
    def datasets(self):
        """Names of SERIES and ROWS of such a file"""
        none = {axis for axis, names in self.some.items() if not names}
        absent = set() if "on_bed_at_rest" in self.attributes else OF_LINES
        return [
            name for name, (axes, _, _) in {**SERIES, **ROWS}.items() if name not in absent and not none & set(axes)
        ]

    @property
    def slow(self):
        """Names of slow motions"""
        return tuple(name for name in self.motions if name.endswith(SLOW))


def create(path, header, seeds, kept, old=None):
    """A new file for seeds, with records of the first `kept`; rows of `old`, an open file, are copied."""
    with beside(path, (*header.datasets, *FILLED)) as file:
        _lay_out(file, header, np.array(seeds), min(kept, len(seeds)))
        for row in () if old is None else np.flatnonzero(whole_rows(old)):
            _take_over(old, file, int(row))


def _take_over(old, new, row):
    """Copy a row, unless the new file keeps a record of it that the old one lacks."""
    seed = int(old["seed"][row])
    place = np.flatnonzero(new["seed"][()] == seed)
    if not len(place):
        return
    values, place = row_values(old, row), int(place[0])
    if place < len(new["kept_seed"]) and "motion" not in values:
        return
    put(new, place, values)


def _lay_out(file, header, seeds, kept):
    file.attrs.update(
        schema=SCHEMA, software_version=bem.__version__, convention=bem.__doc__, identity=header.identity,
        study=header.study, breaking_load=header.breaking_load, **header.attributes
    )  # fmt: skip
    axes = {
        "seed": seeds, "kept_seed": seeds[:kept], "time": header.time, "dof": header.motions, "slow_dof": header.slow,
        "line": header.lines, "quantity": header.quantities, "statistic": STATISTICS, "summary_statistic": SUMMARY,
        "xyz": ("x", "y", "z"), **({"pull": ("along", "up")} if "anchor_pull" in header.datasets else {}),
    }  # fmt: skip
    for name, values in axes.items():
        text = len(values) == 0 or isinstance(values[0], str)
        file.create_dataset(name, data=np.array(values, dtype=h5py.string_dtype() if text else None)).make_scale(name)
    file["time"].attrs["units"] = "s"
    file["quantity"].attrs["quantity_units"] = json.dumps(header.units)
    for axis, names in header.some.items():
        if names:
            file.create_dataset(axis, data=names, dtype=h5py.string_dtype()).make_scale(axis)
    for name in header.datasets:
        dims, unit, words = {**SERIES, **ROWS}[name]
        kind = np.float32 if name in SERIES else float
        data = np.full([len(file[axis]) for axis in dims], np.nan, kind)
        _dataset(file, name, dims, data, unit, words)
    for name, data in (("anchor", header.anchor), ("fairlead", header.fairlead)):
        _dataset(file, name, ("line", "xyz"), np.asarray(data, float), "m", f"{name} with the body at rest")
    _dataset(file, "findings", ("seed",), np.zeros(len(seeds), f"S{LONGEST}"), "", "findings")
    _dataset(file, "stored", ("seed",), np.zeros(len(seeds), np.uint32), "", "CRC-32 of a row, 0 for an empty row")
    _dataset(
        file, "summary", ("quantity", "summary_statistic"), np.full((len(header.quantities), len(SUMMARY)), np.nan),
        "unit of the quantity; T in s", "statistics over all runs",
    )  # fmt: skip
    _dataset(file, "summary_checksum", (), np.uint32(0), "", "CRC-32 of the summary")


def _dataset(file, name, dims, data, unit, words):
    dataset = file.create_dataset(name, data=data)
    for place, axis in enumerate(dims):
        dataset.dims[place].attach_scale(file[axis])
    dataset.attrs["long_name"] = words
    if unit:
        dataset.attrs["units"] = unit


@contextmanager
def opened(path, mode="r"):
    """The open file of a simulation.  Raises DatabaseError for a file of another kind or with a broken seal."""
    path = Path(path)
    if not path.exists():
        raise DatabaseError(f"{path} does not exist")
    if not is_run(path):
        raise DatabaseError(no_file_of(path, SCHEMA))
    check_version(path, SCHEMA, kind_filled_in(path))
    try:
        check_seal(path, "copy it again, or simulate again with --fresh")
    except DatabaseError:
        check_version(path, SCHEMA)
        raise
    if mode != "r":
        keep_room(path)
    with unlocked(path, mode) as file:
        yield file


def is_run(path):
    """Whether a file is the file of a simulation, of any version, damaged or not; devices and pipes are not opened"""
    return Path(path).is_file() and named(kind_filled_in(path)) == named(SCHEMA)


def row_values(file, row):
    """{name: stored value} of a row"""
    return {name: file[name][row] for name in _stored_names(file, row)}


def _stored_names(file, row):
    """Names of the stored quantities of a row; deflections only with fenders, and likewise for hinges and anchors"""
    series = [name for name in SERIES if name in file] if row < len(file["kept_seed"]) else []
    return [*(name for name in ROWS if name in file), "findings", *series]


def put(file, row, values):
    """Store a row: data, flush, mark."""
    file["stored"][row] = 0
    for name in _stored_names(file, row):
        file[name][row] = np.asarray(values[name], file[name].dtype)
    file.flush()
    file["stored"][row] = _row_crc(file, row)
    file.flush()


def _row_crc(file, row):
    return crc(*(np.asarray(value) for value in row_values(file, row).values()))


def database_path(file):
    """Path of the database of a run's file: the path that was given, or beside the file"""
    given = Path(file.attrs["database"])
    near = Path(file.filename).parent / given.name
    return near if near.exists() and not given.exists() else given


def whole_rows(file):
    """Whether each row is stored and unchanged; shape (seeds,)"""
    marks = file["stored"][()]
    return np.array([bool(mark) and mark == _row_crc(file, row) for row, mark in enumerate(marks)], bool)


def told(file):
    """Lines of text on the methods chosen for the runs of an open file, and on neglected effects"""
    return tuple(filter(None, str(file.attrs.get("told", "")).split("\n")))


def stored_findings(file):
    """Lines of text: findings that hold for all runs, and findings of single runs

    Findings that differ only in a number, such as the mean frequency of the waves of each seed, are merged. The finding
    with the largest number remains.
    """
    of_all = str(file.attrs.get("findings_of_all", "")).split("\n")
    rows = file["findings"][whole_rows(file)]
    of_runs = {line for one in rows for line in bytes(one).decode().split("\n")}
    alike = {DECIMAL.sub("#", line): line for line in sorted(of_runs, key=_decimals)}
    return tuple(filter(None, dict.fromkeys((*of_all, *sorted(alike.values())))))


def _decimals(line):
    return [float(number) for number in DECIMAL.findall(line)]


def units_of(file):
    """Unit of each quantity"""
    return tuple(json.loads(file["quantity"].attrs["quantity_units"]))


def ropes_of(file):
    """Names of the ropes of a berth among the lines"""
    return {rope["name"] for rope in tomllib.loads(file.attrs.get("study", "")).get("rope", ())}


def bodies_of(file):
    """Names of several bodies, () for a single body"""
    names = file["dof"].asstr()[()]
    return tuple(name.removesuffix("__Surge") for name in names if name.endswith("__Surge"))


def words_of(file):
    """Names of the motions among the quantities"""
    return tuple(file["quantity"].asstr()[()][: len(file["dof"])])


def fender_names(file):
    """Names of the fenders"""
    return tuple(file["fender"].asstr()[()]) if "fender" in file else ()


def summary_of(file, quantity):
    """{statistic: value in SI} of a quantity over all runs, such as "tension fore port 1" in the file"""
    place = list(file["quantity"].asstr()[()]).index(quantity)
    return dict(zip(SUMMARY, file["summary"][place], strict=True))


def first_what_is_left_out(findings):
    """Findings without repetition; findings on neglected effects come first, since these limit the accuracy of the
    others"""
    return tuple(sorted(dict.fromkeys(findings), key=lambda line: not line.startswith(LEFT_OUT)))


def put_summary(file, summary):
    """Store the statistics over all runs, (quantities, len(SUMMARY))."""
    file["summary"][...] = summary
    file["summary_checksum"][...] = crc(file["summary"][()])
    file.flush()


def summary_is_whole(file):
    """Whether the summary is stored and unchanged"""
    return file["summary_checksum"][()] == crc(file["summary"][()])


def summary_is_of_today(path):
    """Whether a file, if it exists, has the present set of statistics over all runs; older files have another set"""
    if not Path(path).exists():
        return True
    with opened(path) as file:
        return tuple(file["summary_statistic"].asstr()[()]) == SUMMARY
