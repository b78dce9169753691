"""A design project as typed TOML: a study, its states of weather, and the rules that judge it.

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

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from types import ModuleType

import msgspec

from hakobune.bem import DOFS
from hakobune.mooring.criteria.rules import LINES as KNOWN_LINES
from hakobune.mooring.criteria.rules import OWN, Criterion, of_rule, read_rules, unit_of
from hakobune.mooring.criteria.rules import STATES as KNOWN_STATES
from hakobune.mooring.criteria.strength import kind_and_size, worn_breaking_load
from hakobune.mooring.criteria.verdict import HAWSER, HOLDING, OF_TENSIONS, WORN

from ..common.quantities import StudyError, positive, speed
from ..common.typed import read_toml, typed
from ..common.weather.seas import spectrum_of
from ..common.weather.streams import coefficients_of, wind_table, with_files
from ..site.link import laid_in, named, site_file
from .cases import check_cases
from .kinds.choose import kind_of
from .kinds.needs import SCOPE
from .tables import MEAN, Project

STATES = ("normal", "abnormal")
LINES = ("intact", "one lost")
KNOWN_OF_PROJECT = "service life", "return period", SCOPE
# quantities computed by load cases or given by the project
FOUND = (*OF_TENSIONS, *(dof.lower() for dof in DOFS), *KNOWN_OF_PROJECT)
STATISTICS = ("largest", "amplitude", "peak to peak")
USED = {"wear": WORN, "anchors": HOLDING}  # tables that only one quantity uses
DIRECTION_KEYS = ("direction_deg", "incidence_deg")


class Read(msgspec.Struct, frozen=True):
    """A project with the files it names: raw, nested dictionaries of the project; study, raw tables of its study

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
    """The Read of a TOML file.  Raises StudyError, or the one-line error of the study, the rules or a table in it."""
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
    _check_bodies(own, kind)
    _check_numbers(project)
    _check_states(project, study["water"]["depth"])
    kind.check(project, study)
    _check_wear(project, study)
    _check_fatigue(project, study)
    criteria = _criteria(project, folder)
    _check_limits(project, kind.finds(study))
    _check_own_rules(project, kind.finds(study), folder)
    _check_needs(kind.needs(study), criteria)
    _check_hawsers(project, kind.needs(study))
    _check_used(project, criteria)
    _check_values(project, criteria)
    _check_earthquakes(project, study, folder)
    read = Read(project, raw, text, study, study_text, criteria, folder, kind)
    _check_worn(worn_diameters(project, study))
    check_cases(read, scenes(read))
    return read


def _check_bodies(own, kind):
    if own.scene is not None and own.database is not None:
        raise StudyError("project: scene and database are both given; give one of them")
    given = own.scene is not None or own.database is not None
    if kind.DATABASE == "needed" and not given:
        raise StudyError("project: neither scene nor database is given; give one of them")
    if kind.DATABASE == "none" and given:
        raise StudyError(
            f"project.{'scene' if own.scene else 'database'} is given, but a {kind.NAME} defines its own section; "
            f"leave it out"
        )


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
        made["simulation"] = _placed(simulation, path.parent)
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


def _check_numbers(project):
    """Raises StudyError for numbers that are invalid for any study."""
    own = project.project
    if own.service_life is not None:
        positive("project.service_life", own.service_life)
    if own.probability is not None and not 0 < own.probability < 1:
        raise StudyError(f"project.probability is {own.probability:g}; allowed: above 0, below 1")
    for name, rise in project.levels.items():
        if not math.isfinite(rise):
            raise StudyError(f"levels.{name} is {rise:g} m; allowed: finite")
    if project.anchors is not None:
        positive("anchors.holding_kN", project.anchors.holding_kN)
        for name, holding in project.anchors.lines.items():
            positive(f"anchors.lines.{name}", holding)


def _check_worn(worn):
    """Raises StudyError for wear that leaves too little of a type; worn : from `worn_diameters`"""
    for name, (diameter, loss) in worn.items():
        try:
            worn_breaking_load(1.0, diameter, loss, 1.0)
        except ValueError as error:
            raise StudyError(f"wear of type {name!r}: {error}") from None


def _check_states(project, depth):
    if not project.states:
        raise StudyError("the project has no states; give at least one [[states]]")
    if not project.rules and not project.limits:
        raise StudyError("the project has no rules; give at least one [[rules]] or [[limits]]")
    known = (MEAN, *project.levels)
    names = [state.name for state in project.states]
    for i, state in enumerate(project.states):
        where = f"states[{i}]"
        if names.count(state.name) > 1:
            raise StudyError(f"{where}.name is {state.name!r}, the name of another state; give each state its own name")
        _one(f"{where}.state", state.state, STATES)
        _one(f"{where}.lost", state.lost, ("worst", "each"))
        for key, allowed in (("lines", LINES), ("levels", known)):
            if not getattr(state, key):
                raise StudyError(f"{where}.{key} is empty; allowed: {', '.join(allowed)}")
            for value in getattr(state, key):
                _one(f"{where}.{key}", value, allowed)
        for key in ("incidence_deg", "wind_off_deg", "current_off_deg"):
            values = getattr(state, key)
            if not values or any(not -360 <= value <= 360 for value in values):
                raise StudyError(f"{where}.{key} is {values}; allowed: at least one, −360 to 360")
        if state.wind is state.current is state.waves is None:
            raise StudyError(f"{where} has neither wind, current nor waves; allowed: at least one")
        for key in ("wind", "current", "waves"):
            table = getattr(state, key)
            given = [name for name in DIRECTION_KEYS if table is not None and getattr(table, name) is not None]
            if given:
                raise StudyError(f"{where}.{key}.{given[0]} is given; give directions in {where}.incidence_deg only")
        _check_streams(where, state)
        if state.waves is not None:
            _check_waves(f"{where}.waves", state.waves, depth)


def _check_waves(where, waves, depth):
    """Raises StudyError for waves that are invalid in every case"""
    if waves.file is None:
        spectrum_of(where, waves, depth)
    for i, one in enumerate(waves.swell):
        one.sea(f"{where}.swell[{i}]", depth)


def _check_streams(where, state):
    """Raises StudyError for wind or current that is invalid in every case"""
    for key, made in (("wind", wind_table), ("current", partial(coefficients_of, "current"))):
        if (table := getattr(state, key)) is not None:
            speed(f"{where}.{key}", table)
            try:
                made(table)
            except StudyError as error:
                raise StudyError(f"{where}.{error}") from None


def _check_wear(project, study):
    wear = project.wear
    if wear is None:
        return
    if wear.mm_per_year < 0:
        raise StudyError(f"wear.mm_per_year is {wear.mm_per_year:g}; allowed: at least 0")
    if wear.years is None and project.project.service_life is None:
        raise StudyError("wear: the number of years is missing; give wear.years or project.service_life")
    if wear.years is not None:
        positive("wear.years", wear.years)
    twice = [name for name, table in study.get("types", {}).items() if "corrosion_mm" in table]
    if twice:
        raise StudyError(f"[wear] and types.{twice[0]}.corrosion_mm are both given; give one of them")
    unnamed = [name for name, table in study.get("types", {}).items() if "catalogue" not in table]
    if unnamed:
        raise StudyError(
            f"wear of type {unnamed[0]!r} needs a diameter; name a size of the catalogue, such as catalogue = "
            '"R3 studless 76 mm"'
        )


def _check_fatigue(project, study):
    from hakobune.mooring.criteria.fatigue import BASES, curves

    shares = [state.share for state in project.states]
    if any(not 0 <= share <= 1 for share in shares) or sum(shares) > 1 + 1e-9:
        raise StudyError(f"states: the shares of the time are {shares}; allowed: 0 to 1 each, at most 1 in total")
    own = project.fatigue
    if own is None:
        return
    numbers = (own.exponent, own.constant)
    if (own.curve is None) == (None in numbers) or (own.curve is not None and any(numbers)):
        raise StudyError("fatigue: give either curve, or exponent and constant of N = constant · s^−exponent")
    if own.curve is not None:
        _one("fatigue.curve", own.curve, tuple(curves()))
    else:
        positive("fatigue.exponent", own.exponent)
        positive("fatigue.constant", own.constant)
        _one("fatigue.basis", own.basis, BASES)
    if not own.factor >= 1:
        raise StudyError(f"fatigue.factor is {own.factor:g}; allowed: at least 1")
    if project.simulation is None or project.project.service_life is None or not any(shares):
        raise StudyError(
            "fatigue needs [simulation], project.service_life and a share of the time for at least one state"
        )
    unnamed = [name for name, table in study.get("types", {"ropes": {}}).items() if "catalogue" not in table]
    if unnamed:
        raise StudyError(f"fatigue of type {unnamed[0]!r} needs a diameter; name a size of the catalogue")


def _check_limits(project, found):
    """Raises StudyError if no load case and no [[values]] gives the quantity of a limit; found : by the load cases"""
    known = (*OF_TENSIONS, *found, *KNOWN_OF_PROJECT)
    for i, one in enumerate(project.limits):
        if one.quantity not in (*known, *(value.quantity for value in project.values)):
            raise StudyError(
                f"limits[{i}].quantity is {one.quantity!r}; allowed: {'; '.join(known)}; or give it by [[values]]"
            )


def _check_own_rules(project, found, folder):
    """Raises StudyError if a user's rule file has a quantity that no load case, table or value gives: a misprint"""
    known = {*OF_TENSIONS, *found, *KNOWN_OF_PROJECT, *(value.quantity for value in project.values)}
    known |= {criterion.quantity for criterion in read_rules()}
    for i, table in enumerate(project.rules):
        for one in () if table.file is None else of_rule(read_rules(folder / table.file), table.rule, table.subject):
            if one.quantity not in known:
                raise StudyError(
                    f"rules[{i}], {table.file}: no load case computes the quantity {one.quantity!r}; allowed: "
                    f"{'; '.join((*OF_TENSIONS, *found, *KNOWN_OF_PROJECT))}; or give it by [[values]]"
                )


def _check_needs(needs, criteria):
    """Raises StudyError if no criterion limits a Need of the study, which would pass unchecked"""
    for need in needs:
        if not need.judged(criteria):
            subject = ' with subject = "hawser"' if need.hawser else ""
            raise StudyError(
                f"the study has {need.what}, but no chosen criterion judges them; give a rule set that does, or "
                f"[[limits]] of {need.quantities[0]!r}{subject}"
            )


def _check_hawsers(project, needs):
    """Raises StudyError for a limit on hawsers if the study has none: it would check nothing"""
    if not any(need.hawser for need in needs):
        for i, one in enumerate(project.limits):
            if one.subject == HAWSER:
                raise StudyError(
                    f"limits[{i}].subject is {HAWSER!r}, but the study has no hawser; leave the subject out"
                )


def _check_used(project, criteria):
    """Raises StudyError for a table that no criterion uses"""
    asked = {one.quantity for one in criteria}
    for table, quantity in USED.items():
        if getattr(project, table) is not None and quantity not in asked:
            raise StudyError(
                f"[{table}] is given, but no chosen criterion limits {quantity!r}; give a rule set or [[limits]] "
                f"that does, or leave out [{table}]"
            )


def _check_values(project, criteria):
    asked = dict.fromkeys(one.quantity for one in criteria if one.quantity not in FOUND)
    for i, one in enumerate(project.values):
        where = f"values[{i}]"
        _one(f"{where}.state", one.state, KNOWN_STATES)
        _one(f"{where}.lines", one.lines, KNOWN_LINES)
        if not 0 <= one.value < math.inf:
            raise StudyError(f"{where}.value is {one.value:g}; allowed: 0 or more, finite")
        if one.quantity not in asked:
            known = "; ".join(asked) or "none is asked for"
            raise StudyError(f"{where}.quantity is {one.quantity!r}; allowed by the chosen criteria: {known}")


def _check_earthquakes(project, study, folder):
    from .kinds.earthquake import check_study

    if project.earthquakes and not study.get("fender"):
        raise StudyError(
            "earthquakes are given, but the study has no fenders; a hull on lines alone has long natural periods, "
            "which an earthquake does not excite; leave them out"
        )
    for i, one in enumerate(project.earthquakes):
        if [other.name for other in project.earthquakes].count(one.name) > 1:
            raise StudyError(
                f"earthquakes[{i}].name is {one.name!r}, the name of another earthquake; give each earthquake its own "
                f"name"
            )
        check_study(folder / one.study)


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
    _one(f"{where}.state", table.state, KNOWN_STATES)
    _one(f"{where}.lines", table.lines, KNOWN_LINES)
    _one(f"{where}.statistic", table.statistic, STATISTICS)
    if table.subject not in ("", HAWSER):
        raise StudyError(f"{where}.subject is {table.subject!r}; allowed: {HAWSER}, or left out for all other lines")
    sense = "at most" if table.at_least is None else "at least"
    limit = positive(f"{where}.{sense.replace(' ', '_')}", table.at_most if table.at_least is None else table.at_least)
    unit = unit_of(where, table.quantity, table.unit)
    return Criterion(
        OWN, "", table.quantity, sense, limit, None, unit, table.state, table.lines, "any", table.subject,
        table.statistic, 1.0, table.source, "read",
    )  # fmt: skip


def _one(key, value, allowed):
    if value not in allowed:
        raise StudyError(f"{key} is {value!r}; allowed: {', '.join(allowed)}")


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
