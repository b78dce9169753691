"""Databases of the water levels and results of the load cases, in a folder; existing valid files are used again.

databases/LEVEL.h5     as `hakobune solve` writes them
cases/NAME.toml, .h5   the study of a case, and its result as the command of its kind writes it
cases/NAME_runs.h5     its runs in time as `hakobune simulate` writes them, where the project has [simulation]
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.criteria.strength import worn_breaking_load
from hakobune.mooring.criteria.verdict import Case, Tensions

from ..common.quantities import StudyError
from ..common.typed import read_toml
from ..executors.choice import Here
from ..moor.study import make_study
from .cases import LoadCase, file_name, intact_cases, without_line
from .kinds.needs import ANCHOR, EXCURSION, SCOPE
from .kinds.numbers import Numbers
from .project import MEAN, scenes, worn_diameters

ROTATIONS = ("roll", "pitch", "yaw")


@dataclass(frozen=True)
class Ran:
    """A load case that ran or failed. numbers : from its files, or None with the reason in `fault`

    path : path of the file of numbers; runs : from `kinds.in_time.simulated`, None for a project without simulation
    """

    case: LoadCase
    path: Path
    numbers: Numbers | None
    runs: dict | None = None
    fault: str = ""

    @property
    def largest(self):
        """Largest tensions, from the runs in time if there are any, N; shape (n,)"""
        return self.numbers.largest if self.runs is None else self.runs["largest"][1.0]

    @property
    def at_anchors(self):
        """Largest pull along and up at the anchors, from the runs in time if there are any, N; shape (2, n)"""
        found = self.numbers._asdict() if self.runs is None else self.runs
        return np.array([found["horizontal"], found["uplift"]])


def databases(read, folder, executor, console):
    """{level: path} of the databases, solved if they are missing.  Raises StudyError for an incomplete one."""
    from ..solve.run import solve

    own = read.project.project
    if own.database is not None:
        return {MEAN: read.folder / own.database}
    if own.scene is None:
        return {MEAN: None, **dict.fromkeys(read.project.levels)}
    (folder / "databases").mkdir(parents=True, exist_ok=True)
    found = {}
    for level, scene in scenes(read).items():
        found[level] = folder / "databases" / f"{level}.h5"
        outcome = solve(scene, found[level], executor=executor, console=console)
        if outcome.interrupted:
            raise KeyboardInterrupt
        if outcome.exit_status:
            where, reason = outcome.failures[0] if outcome.failures else ("", "not all frequencies are stored")
            raise StudyError(f"the database of level {level!r} is incomplete: {where} {reason}")
    return found


def of_databases(read, paths):
    """Failures of the databases, one line each: laws of physics, and the tolerance of databases that were solved for
    the project"""
    from hakobune.bem.database import open_database

    from ..solve.report import failed_laws, gives_panels, missed_tolerance

    own = {level: gives_panels(scene) for level, scene in scenes(read).items()} if read.project.project.scene else {}
    for level, path in paths.items():
        if path is not None:
            db, panels = open_database(path), own.get(level, True)
            for text in (failed_laws(db, panels), "" if panels else missed_tolerance(db)):
                if text:
                    yield fails(f"database of level {level}: {text}")


def run_cases(read, paths, folder, executor, step):
    """[Ran] of all load cases, first the intact cases, then the cases with a lost line.

    paths : {level: database}; step : function called with the number of finished cases, of known cases, and a name
    """
    base, factors = base_of(read, paths), factors_of(read)
    (folder / "cases").mkdir(parents=True, exist_ok=True)
    intact = list(intact_cases(read, base, repeated(read, factors)))
    ran = _run_all(read, intact, factors, paths, folder, executor, step, 0)
    names = read.kind.lost(base)
    broken = [case for group in grouped(ran).values() for case in _lost(read, group, names)]
    ran += _run_all(read, broken, factors, paths, folder, executor, step, len(ran))
    return ran + list(_shaken(read, paths, folder))


def factors_of(read):
    """Factors on the largest motions for which criteria need tensions, including 1"""
    return sorted({1.0, *(criterion.motion_factor for criterion in read.criteria)})


def base_of(read, paths):
    """Tables of the study with its layout; paths : {level: database}"""
    from hakobune.bem.database import open_database

    return read.kind.base(read.study, None if paths[MEAN] is None else open_database(paths[MEAN]))


def repeated(read, factors):
    """Factors on the motions, each with load cases of its own"""
    return factors if read.kind.MOVED and read.project.simulation is None else [1.0]


def judged_case(read, ran, others):
    """The `Case` for the criteria, from the `Ran` of one load case at all factors on the motions.

    ran : {factor: Ran}; others : {quantity: value} of the whole project
    """
    case, one = ran[1.0].case, ran[1.0]
    motions = _motions(one.numbers.bodies, one.numbers.motions if one.runs is None else one.runs["motions"])
    ranges = None if one.runs is None else _motions(one.numbers.bodies, one.runs["ranges"])
    if one.runs is None:
        tensions = {factor: _tensions(read, each, each.largest) for factor, each in ran.items() if each.numbers}
    else:
        tensions = {factor: _tensions(read, one, largest) for factor, largest in one.runs["largest"].items()}
    parts = given_parts(read, case, one.numbers) | one.numbers.parts | anchors_used(one)
    if read.kind.MOVED and not case.apart:
        parts[EXCURSION] = {"from rest": excursion(one)}
    return Case(case.name, case.kind, case.lines, "quasi-static", tensions, motions, others, parts, case.apart, ranges)


def excursion(one):
    """Largest horizontal distance of a Ran from rest, m: in its runs in time, otherwise by steady offset and motions

    Without a lost line rest is another place, to which the remaining lines pull the body: the distance of that place
    is added.
    """
    r = one.numbers
    if EXCURSION in r.parts:
        return max(r.parts[EXCURSION].values())
    if one.runs is not None and "excursion" in one.runs:
        return float(one.runs["excursion"]) + (one.runs["at_rest"] if one.case.lost else 0.0)
    steady = np.hypot(*np.reshape(r.place, (-1, 3))[:, :2].T)
    moving = np.hypot(*np.reshape(r.motions, (-1, 6))[:, :2].T) if len(r.motions) else 0.0
    return float((steady + moving).max())


def _motions(bodies, amplitudes):
    """{motion: m or degrees} of amplitudes (6N,) m, rad; of several bodies, by name, {motion: {body: m or degrees}}"""
    if not len(amplitudes):
        return {}
    each = np.reshape(amplitudes, (-1, 6)) * [1.0, 1.0, 1.0, *3 * [180 / np.pi]]
    columns = dict(zip(("surge", "sway", "heave", *ROTATIONS), each.T.tolist(), strict=True))
    return {name: dict(zip(bodies, of, strict=True)) if bodies else of[0] for name, of in columns.items()}


def given_parts(read, case, numbers):
    """{quantity: {part: value}}: values given in the project, by their source and scope of lines"""
    found = {}
    for one in read.project.values:
        if one.state in ("any", case.kind) and one.lines in ("any", case.lines) and not case.apart:
            if one.quantity in numbers.parts:
                raise StudyError(
                    f"values: {one.quantity!r} is given, but {case.name} computes it; leave the given value out"
                )
            found.setdefault(one.quantity, {})[one.source] = one.value
    lines = [i for i, name in enumerate(numbers.names) if name not in numbers.hawsers and numbers.types[i] != ("rope",)]
    if "water" in read.study and lines:
        rises = [0.0, *read.project.levels.values()]
        depths = 5 * read.study["water"]["depth"] + max(rises) - min(rises)
        found[SCOPE] = {numbers.names[i]: float(numbers.length[i] / depths) for i in lines}
    return found


def grouped(ran):
    """{(state, level, directions, lost line): {factor: Ran}} in order"""
    found = {}
    for one in ran:
        found.setdefault(key_of(one.case), {})[one.case.factor] = one
    return found


def key_of(case):
    """(state, level, directions, lost line) of a LoadCase, without the factor on its motions"""
    return case.state, case.level, case.incidence, case.wind_off, case.current_off, case.lost


def _run_all(read, cases, factors, paths, folder, executor, step, done):
    places = [folder / "cases" / f"{file_name(case)}.h5" for case in cases]
    jobs = (
        executor.submit(read.kind.run, case.study, paths[case.level], place, factors)
        for case, place in zip(cases, places, strict=True)
    )
    if not isinstance(executor, Here):  # which works in the call, so that each case would be told of after all of them
        jobs = list(jobs)
    ran = []
    for case, place, job in zip(cases, places, jobs, strict=True):
        try:
            ran.append(Ran(case, place, *job.result()))
        except ValueError as fault:
            ran.append(Ran(case, place, None, None, " ".join(str(fault).split())))
        step(done + len(ran), done + len(cases), case.name)
    return ran


def _shaken(read, paths, folder):
    """Ran of each earthquake"""
    if not read.project.earthquakes:
        return
    from .kinds import earthquake

    for table in read.project.earthquakes:
        path, name = read.folder / table.study, f"earthquake, {table.name}"
        raw, _ = read_toml(path, "an earthquake study", StudyError)
        case = LoadCase(name, name, "abnormal", MEAN, 0.0, 0.0, 0.0, "", 1.0, raw, apart=True)
        place = folder / "cases" / f"{file_name(case)}_numbers.json"
        try:
            yield Ran(case, place, earthquake.run(path, paths[MEAN], place))
        except ValueError as fault:
            yield Ran(case, path, None, None, " ".join(str(fault).split()))


def _lost(read, group, names):
    """The LoadCases that follow from an intact one, with each factor on the motions, by the loss of a line"""
    intact = group[1.0]
    (state,) = [state for state in read.project.states if state.name == intact.case.state]
    if "one lost" not in state.lines:
        return
    lost = names
    if state.lost == "worst":
        if intact.numbers is None:  # the worst line is unknown; the intact case is reported as failed
            return
        lost = [worst_of(intact, names)]
    for name in lost:
        for one in group.values():
            yield without_line(read, one.case, name)


def worst_of(ran, among=None):
    """Name of the line with the largest utilisation, or the largest pull if no breaking load is known

    among : names, by default all
    """
    share, names = ran.largest / ran.numbers.breaking, ran.numbers.names
    used = share if np.any(share > 0) else ran.largest
    return max(names if among is None else among, key=lambda name: used[names.index(name)])


def _tensions(read, ran, largest):
    numbers, in_time = ran.numbers, ran.runs is not None
    return Tensions(
        numbers.names,
        numbers.pretension,
        ran.runs["mean"] if in_time else numbers.static,
        largest,
        numbers.breaking,
        _worn_loads(read, numbers),
        ran.at_anchors[0],
        _holding(read, ran),
        numbers.hawsers,
    )


def _holding(read, ran):
    """Anchor capacities, from the project or from the study's own [[anchors]], N; shape (n,); None if one is unknown"""
    anchors, names = read.project.anchors, ran.numbers.names
    if anchors is not None:
        return np.array([1e3 * anchors.lines.get(name, anchors.holding_kN) for name in names])
    own, up = _own_anchors(ran), ran.at_anchors[1]
    if not own:
        return None
    held = np.array([own[name].capacity(up[i]) if own.get(name) else np.inf for i, name in enumerate(names)])
    return None if np.isnan(held).any() else held


def _own_anchors(ran):
    """{line: Anchor, or None without one} of the study's own [[anchors]]; empty without that table"""
    if not isinstance(ran.case.study.get("anchors"), list):
        return {}
    lines = [name for name, types in zip(ran.numbers.names, ran.numbers.types, strict=True) if types != ("rope",)]
    return dict(zip(lines, make_study(ran.case.study).anchors_on(lines), strict=True))


def anchors_used(ran):
    """{ANCHOR: {line: pull times safety over capacity}} of the study's own anchors of known capacity; empty if there
    are none
    """
    pulls = dict(zip(ran.numbers.names, ran.at_anchors.T, strict=True))
    used = {name: float(one.used(*pulls[name])) for name, one in _own_anchors(ran).items() if one}
    used = {name: value for name, value in used.items() if not np.isnan(value)}
    return {ANCHOR: used} if used else {}


def _worn_loads(read, numbers):
    """Breaking loads of the lines minus the loss of the weakest of their chains, N; shape (n,); None without wear"""
    worn = worn_diameters(read.project, read.study)
    if not worn:
        return None
    left = {name: worn_breaking_load(1.0, diameter, loss, 1.0) for name, (diameter, loss) in worn.items()}
    return numbers.breaking * np.array([min(left.get(name, 1.0) for name in types) for types in numbers.types])
