"""A design project as typed TOML: a study, its states of weather, and the rules that judge the study.

```toml
[project]
name = "Floater A in 20 m"
study = "moor_chain_12.toml"        # layout, hull and lines, or a berth, a single point, a breakwater (`kinds`); its
                                    # own weather is not used
scene = "series_box_20m.toml"       # its database is made for every water level; or database = "box.h5"
service_life = 20.0                 # years
probability = 0.8                   # probability that the extreme state is not exceeded in them

[levels]                            # m above the water of the study, where they differ from it
high = 1.5

[[states]]
name = "extreme"
state = "abnormal"                  # normal or abnormal
incidence_deg = [0, 30, 60, 90]     # wind, current and waves; wind_off_deg, current_off_deg turn them away from it
levels = ["mean", "high"]
lines = ["intact", "one lost"]
wind = { speed = 50.0 }             # tables of a mooring study, without direction
current = { speed_knots = 3.0 }
waves = { height = 4.5, period = 10.0 }

[simulation]                        # runs every case in time, as in a mooring study; without, by the simplified method
duration_hours = 3.0
seeds = 5

[[rules]]
rule = "JSCE"
subject = "chain of a multi-point mooring"

[[limits]]                          # your own limit
quantity = "surge"
at_most = 2.0
source = "the owner"
```

Paths are relative to the folder of the project.  Every fault is one line that names key, value and allowed values.
"""

from pathlib import Path
from types import ModuleType

import msgspec

from hakobune.mooring.criteria.rules import LINES as KNOWN_LINES
from hakobune.mooring.criteria.rules import OWN, Criterion, of_rule, read_rules, unit_of
from hakobune.mooring.criteria.rules import STATES as KNOWN_STATES
from hakobune.mooring.criteria.strength import kind_and_size

from ..common.quantities import StudyError, positive
from ..common.typed import read_toml, typed
from ..common.weather.streams import with_files
from ..site.link import laid_in, named, site_file
from .cases import check_cases
from .kinds.choose import kind_of
from .project_checks import check_among, check_criteria, check_tables, check_worn
from .tables import MEAN, Project

STATISTICS = ("largest", "amplitude", "peak to peak")


class Read(msgspec.Struct, frozen=True):
    """A project with the files that it names

    raw : tables of the project as read; study : tables of its study as read
    kind : module of `kinds` for studies of this kind; study_text, text : text of the study and of the project
    criteria : chosen from the rules; folder : start of relative paths
    """

    project: Project
    raw: dict
    text: str
    study: dict
    study_text: str
    criteria: tuple
    folder: Path
    kind: ModuleType


def read_project(path):
    """The Read of a TOML file. Raises StudyError, or the one-line error of the project's study, rules or tables."""
    path = Path(path)
    raw, text = read_toml(path, "a project", StudyError)
    raw = _with_files(_at_site(raw, path.parent), path)
    project = typed(raw, Project, StudyError)
    own = project.project
    if (own.probability is None) != (own.service_life is None):
        raise StudyError("project: service_life and probability belong together; give both or neither")
    folder = path.parent
    kind = kind_of(folder / own.study)
    study, study_text = kind.read(folder / own.study)
    check_tables(project, study, kind)
    if project.simulation is not None and project.simulation.force:
        from ..simulate.study import check_forces

        check_forces(project.simulation)
    criteria = _criteria(project, folder)
    check_criteria(project, study, kind, criteria, folder)
    read = Read(project, raw, text, study, study_text, criteria, folder, kind)
    check_worn(worn_diameters(project, study))
    check_cases(read, scenes(read))
    return read


def _at_site(raw, folder):
    """Tables of a project with the weather, levels and service life of its site.  Raises StudyError."""
    own, states = raw.get("project", {}), raw.get("states", [])
    own_site = own.get("site") if isinstance(own, dict) else None
    asked = [state for state in states if isinstance(state, dict) and "weather" in state]
    if not isinstance(own_site, str):
        if asked:
            raise StudyError(
                "states take their weather from a site, but project.site is missing; give the file of the site"
            )
        return raw
    values = site_file(folder / own_site)
    laid = []
    for i, state in enumerate(states):
        if not (isinstance(state, dict) and "weather" in state):
            laid.append(state)
            continue
        found = dict(state)
        for key, table in named(f"states[{i}].weather", state["weather"], values.states).items():
            found[key] = laid_in(f"states[{i}].{key}", state.get(key, {}), table)
        laid.append(found)
    used = {level for state in laid if isinstance(state, dict) for level in state.get("levels", [])}
    levels = {name: value for name, value in values.levels.items() if name in used} | raw.get("levels", {})
    life = {}
    if not {"service_life", "probability"} & set(own):
        life = {key: values.site[key] for key in ("service_life", "probability") if key in values.site}
    return {**raw, "project": {**own, **life}, "states": laid, **({"levels": levels} if levels else {})}


def _with_files(raw, path):
    """Tables of a project with the numbers of the coefficient files that its states name, and the full paths of those
    that its simulation names, whose studies are in another folder.  Raises StudyError.
    """
    states, simulation, made = raw.get("states"), raw.get("simulation"), dict(raw)
    if isinstance(states, list):
        made["states"] = [_of_state(i, one, path) for i, one in enumerate(states)]
    if isinstance(simulation, dict):
        made["simulation"] = _placed(simulation, path.parent.resolve())
    return made


def _of_state(i, state, path):
    if not isinstance(state, dict):
        return state
    try:
        return with_files(state, "", path)[0]
    except StudyError as error:
        raise StudyError(f"states[{i}].{error}") from None


def _placed(table, folder):
    """A raw table in which each "file" is a full path"""
    if isinstance(table, list):
        return [_placed(one, folder) for one in table]
    if not isinstance(table, dict):
        return table
    placed = {key: _placed(value, folder) for key, value in table.items()}
    return placed | ({"file": str(folder / table["file"])} if isinstance(table.get("file"), str) else {})


def worn_diameters(project, study):
    """{type: (diameter in mm, mm lost)} of the types of the study that wear; empty without wear"""
    wear = project.wear
    if wear is None:
        return {}
    years = wear.years if wear.years is not None else project.project.service_life
    found = {}
    for name, table in study.get("types", {}).items():
        if "catalogue" in table:
            found[name] = kind_and_size(table["catalogue"])[1], wear.mm_per_year * years
    return found


def _criteria(project, folder):
    chosen = []
    for i, table in enumerate(project.rules):
        known = read_rules(None if table.file is None else folder / table.file)
        found = of_rule(known, table.rule, table.subject)
        unsure = [criterion for criterion in found if criterion.status == "unverified"]
        if unsure and table.confirmed is None:
            raise StudyError(
                f"rules[{i}] ({table.rule}) contains {len(unsure)} criteria that have not been checked against "
                f"the printed rule, such as {unsure[0].quantity} {unsure[0].sense} {unsure[0].limit:g}; check "
                "them there, then set confirmed = true; with confirmed = false they are not used"
            )
        chosen += [criterion for criterion in found if table.confirmed or criterion.status != "unverified"]
    return (*chosen, *(_limit(f"limits[{i}]", one) for i, one in enumerate(project.limits)))


def _limit(where, table):
    """The Criterion of a LimitTable.  Raises StudyError."""
    if (table.at_most is None) == (table.at_least is None):
        raise StudyError(f"{where}: give one of at_most, at_least")
    check_among(f"{where}.state", table.state, KNOWN_STATES)
    check_among(f"{where}.lines", table.lines, KNOWN_LINES)
    check_among(f"{where}.statistic", table.statistic, STATISTICS)
    sense = "at most" if table.at_least is None else "at least"
    limit = positive(f"{where}.{sense.replace(' ', '_')}", table.at_most if table.at_least is None else table.at_least)
    unit = unit_of(where, table.quantity, table.unit)
    return Criterion(
        OWN, "", table.quantity, sense, limit, None, unit, table.state, table.lines, "any", table.subject,
        table.statistic, 1.0, table.source, "read",
    )  # fmt: skip


def scenes(read):
    """{level: Scene} of the levels of all states, {} without a scene.  Raises StudyError."""
    from ..scene.scene import SceneError, make_scene

    if read.project.project.scene is None:
        return {}
    used = dict.fromkeys(level for state in read.project.states for level in state.levels)
    found, path = {}, read.folder / read.project.project.scene
    for level in (MEAN, *(name for name in used if name != MEAN)):
        depth = read.study["water"]["depth"] + read.project.level(level)
        if not depth > 0:
            raise StudyError(f"levels.{level} is {read.project.level(level):g} m; allowed: above the bed of the study")
        try:
            raw, _ = read_toml(path, "a scene", StudyError)
            raw.setdefault("water", {})["depth"] = depth
            found[level] = make_scene(raw)
        except SceneError as fault:
            raise StudyError(f"scene {path.name}: {fault}") from None
    return found
