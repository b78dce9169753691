"""Databases of the water levels and results of the load cases, in a folder; what is there and fits is not made again.

databases/LEVEL.h5     as `hakobune solve` makes them
cases/NAME.toml, .h5   the study of a case, and its result as `hakobune moor` writes it
cases/NAME_runs.h5     its runs in time as `hakobune simulate` writes them, where the project has [simulation]
"""

from __future__ import annotations

import hashlib
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tomli_w

from meshing.whole_files import write_whole
from mooring.criteria.strength import worn_breaking_load
from mooring.criteria.verdict import Case, Tensions

from ..common.quantities import StudyError
from .cases import LoadCase, file_name, intact_cases, laid_lines, without_line
from .project import MEAN, scene_tables, worn_diameters

ROTATIONS = ("roll", "pitch", "yaw")


@dataclass(frozen=True)
class Ran:
    """A load case that ran, or could not: result, the numbers of its file as arrays, None with the reason in `fault`

    runs : of `simulated`, None where the project has no simulation
    """

    case: LoadCase
    path: Path
    result: dict | None
    runs: dict | None = None
    fault: str = ""

    @property
    def largest(self):
        """(n,) N, largest tensions: of the runs in time where there are some"""
        return self.result["maximum_tension"] if self.runs is None else self.runs["largest"][1.0]


def databases(read, folder, executor, console):
    """{level: path} of the databases, solved for where they are missing.  Raises StudyError where one is not whole."""
    from ..scene.scene import make_scene
    from ..solve.run import solve

    own = read.project.project
    if own.database is not None:
        return {MEAN: read.folder / own.database}
    used = dict.fromkeys(level for state in read.project.states for level in state.levels)
    (folder / "databases").mkdir(parents=True, exist_ok=True)
    found = {}
    for level in (MEAN, *(name for name in used if name != MEAN)):
        raw = scene_tables(read)
        raw.setdefault("water", {})["depth"] = read.study["water"]["depth"] + read.project.level(level)
        found[level] = folder / "databases" / f"{level}.h5"
        outcome = solve(make_scene(raw), found[level], executor=executor, console=console)
        if outcome.interrupted:
            raise KeyboardInterrupt
        if outcome.exit_status:
            where, reason = outcome.failures[0] if outcome.failures else ("", "not all frequencies are stored")
            raise StudyError(f"the database of level {level!r} is not whole: {where} {reason}")
    return found


def run_cases(read, paths, folder, executor, step):
    """[Ran] of all load cases, intact ones first, then those that lost a line.

    paths : {level: database}; step : called with the number done, the number known and a name
    """
    from bem.database import open_database

    lines = laid_lines(read.study, open_database(paths[MEAN]))
    factors = factors_of(read)
    (folder / "cases").mkdir(parents=True, exist_ok=True)
    intact = list(intact_cases(read, lines, [1.0] if read.project.simulation else factors))
    ran = _run_all(intact, factors, paths, folder, executor, step, 0)
    names = [line["name"] for line in lines]
    broken = [case for group in grouped(ran).values() for case in _lost(read, group, names)]
    return ran + _run_all(broken, factors, paths, folder, executor, step, len(ran))


def factors_of(read):
    """Multiples of the largest motions at which criteria ask for tensions, 1 among them"""
    return sorted({1.0, *(criterion.motion_factor for criterion in read.criteria)})


def run_case(study, database, path, factors):
    """The numbers of a case's file, solved for where the file is not there or of another study or database, and those
    of its runs in time, or None.

    study : raw tables; database, path : of the database and of the result; factors : of motions in time
    """
    text = tomli_w.dumps(study)
    stored = _stored(path, text, database)
    if stored is None:
        from bem.database import open_database

        from ..moor.command import studied, write_result
        from ..moor.study import make_study

        result, _ = studied(make_study(study), open_database(database))
        write_whole(path.with_suffix(".toml"), text)
        write_result(path, result, text, database)
        stored = _stored(path, text, database)
    if "simulation" not in study:
        return stored, None
    from .simulated import simulated

    return stored, simulated(path.with_suffix(".toml"), database, path.with_name(f"{path.stem}_runs.h5"), factors)


def judged_case(read, ran, others):
    """The Case that criteria judge: of Ran of one load case with all factors of the motions.

    ran : {factor: Ran}; others : {quantity: value} of the whole project
    """
    case, one = ran[1.0].case, ran[1.0]
    amplitudes = one.result["motion_amplitude"] if one.runs is None else one.runs["motions"]
    motions = dict(zip(("surge", "sway", "heave", *ROTATIONS), amplitudes.tolist(), strict=True))
    for name in ROTATIONS:
        motions[name] = float(np.degrees(motions[name]))
    if one.runs is None:
        tensions = {factor: _tensions(read, each, each.largest) for factor, each in ran.items() if each.result}
    else:
        tensions = {factor: _tensions(read, one, largest) for factor, largest in one.runs["largest"].items()}
    return Case(case.name, case.kind, case.lines, "quasi-static", tensions, motions, others)


def grouped(ran):
    """{(state, level, directions, lost line): {factor: Ran}} in order"""
    found = {}
    for one in ran:
        found.setdefault(key_of(one.case), {})[one.case.factor] = one
    return found


def key_of(case):
    """(state, level, directions, lost line), of a LoadCase but for the factor of its motions"""
    return case.state, case.level, case.incidence, case.wind_off, case.current_off, case.lost


def _run_all(cases, factors, paths, folder, executor, step, done):
    places = [folder / "cases" / f"{file_name(case)}.h5" for case in cases]
    jobs = [
        executor.submit(run_case, case.study, paths[case.level], place, factors)
        for case, place in zip(cases, places, strict=True)
    ]
    ran = []
    for case, place, job in zip(cases, places, jobs, strict=True):
        try:
            ran.append(Ran(case, place, *job.result()))
        except ValueError as fault:
            ran.append(Ran(case, place, None, None, " ".join(str(fault).split())))
        step(done + len(ran), done + len(cases), case.name)
    return ran


def _lost(read, group, names):
    """The LoadCases that follow from an intact one, with each factor of the motions, by the loss of a line"""
    intact = group[1.0]
    (state,) = [state for state in read.project.states if state.name == intact.case.state]
    if "one lost" not in state.lines:
        return
    lost = names
    if state.lost == "worst":
        if intact.result is None:  # which is the worst is not known; the intact case is named as one that did not run
            return
        lost = [intact.result["names"][int(np.argmax(intact.largest))]]
    for name in lost:
        for one in group.values():
            yield without_line(one.case, name)


def _stored(path, text, database):
    """Numbers of the result in a file that is of this study and database, else None"""
    from bem.database.results import DatabaseError, opened_result

    from ..moor.command import LINE_QUANTITIES, SCHEMA

    with suppress(DatabaseError, OSError, KeyError), opened_result(path, SCHEMA) as file:
        seal = hashlib.sha256(Path(database).read_bytes()).hexdigest()
        if file.attrs["study"] != text or file.attrs["database_sha256"] != seal:
            return None
        found = {name: file[f"lines/{name}"][()] for name in LINE_QUANTITIES}
        found["names"] = tuple(name.decode() for name in file["lines/name"][()])
        found |= {name: file[name][()] for name in ("motion_amplitude", "equilibrium")}
        found["periods"] = file["natural_periods/at_equilibrium/period"][()]
        found["modes"] = tuple(map(str, file["natural_periods"].attrs["modes"]))
        found["loads"] = {name: file[f"loads/{name}"][()] for name in file.get("loads", ())}
        found["warnings"] = tuple(filter(None, str(file.attrs["warnings"]).split("\n")))
        return found
    return None


def _tensions(read, ran, largest):
    result, names = ran.result, ran.result["names"]
    in_time = ran.runs is not None
    anchors = read.project.anchors
    holding = None if anchors is None else np.array([1e3 * anchors.lines.get(n, anchors.holding_kN) for n in names])
    return Tensions(
        names,
        result["pretension"],
        ran.runs["mean"] if in_time else result["static_tension"],
        largest,
        result["breaking_load"],
        _worn_loads(read, ran),
        ran.runs["horizontal"] if in_time else result["maximum_horizontal_anchor_force"],
        holding,
    )


def _worn_loads(read, ran):
    """(n,) N: breaking loads of the lines less what the weakest of their chain loses; None without wear"""
    worn = worn_diameters(read.project, read.study)
    if not worn:
        return None
    left = {name: worn_breaking_load(1.0, diameter, loss, 1.0) for name, (diameter, loss) in worn.items()}
    shares = []
    for table in ran.case.study["lines"]:
        types = [table["type"]] if "type" in table else [segment["type"] for segment in table["segments"]]
        shares.append(min(left[name] for name in types))
    return ran.result["breaking_load"] * np.array(shares)
