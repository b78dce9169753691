"""Checks of a design project: every fault is one line that names key, value and allowed values."""

import math
from functools import partial

from hakobune.bem import DOFS
from hakobune.mooring.criteria.rules import LINES as KNOWN_LINES
from hakobune.mooring.criteria.rules import STATES as KNOWN_STATES
from hakobune.mooring.criteria.rules import of_rule, read_rules
from hakobune.mooring.criteria.strength import worn_breaking_load
from hakobune.mooring.criteria.verdict import HAWSER, HOLDING, OF_TENSIONS, WORN

from ..common.quantities import StudyError, positive, speed
from ..common.weather.seas import spectrum_of
from ..common.weather.streams import coefficients_of, wind_table
from .kinds.needs import SCOPE
from .tables import MEAN

STATES = ("normal", "abnormal")
LINES = ("intact", "one lost")
KNOWN_OF_PROJECT = "service life", "return period", SCOPE
# quantities computed by load cases or given by the project
FOUND = (*OF_TENSIONS, *(dof.lower() for dof in DOFS), *KNOWN_OF_PROJECT)
USED = {"wear": WORN, "anchors": HOLDING}  # tables that only one quantity uses
DIRECTION_KEYS = ("direction_deg", "incidence_deg")


def check_tables(project, study, kind):
    """Raises StudyError for tables of a project that its study, of a module of `kinds`, cannot have."""
    _check_bodies(project.project, kind)
    _check_numbers(project)
    _check_states(project, study["water"]["depth"])
    kind.check(project, study)
    _check_wear(project, study)
    _check_fatigue(project, study)


def check_criteria(project, study, kind, criteria, folder):
    """Raises StudyError for limits that apply to nothing, parts that no criterion judges, and tables without use."""
    finds, needs = kind.finds(study), kind.needs(study)
    _check_limits(project, finds)
    _check_own_rules(project, finds, folder)
    _check_needs(needs, criteria)
    _check_hawsers(project, needs)
    _check_used(project, criteria)
    _check_values(project, criteria)
    _check_earthquakes(project, study, folder)


def _check_bodies(own, kind):
    """Raises StudyError unless a scene or a database is given as the kind of study needs it."""
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


def check_worn(worn):
    """Raises StudyError for wear that leaves too little of a type; worn : from `worn_diameters`"""
    for name, (diameter, loss) in worn.items():
        try:
            worn_breaking_load(1.0, diameter, loss, 1.0)
        except ValueError as error:
            raise StudyError(f"wear of type {name!r}: {error}") from None


def _check_states(project, depth):
    """Raises StudyError for states that are invalid in any study; depth : m"""
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
        check_among(f"{where}.state", state.state, STATES)
        check_among(f"{where}.lost", state.lost, ("worst", "each"))
        for key, allowed in (("lines", LINES), ("levels", known)):
            if not getattr(state, key):
                raise StudyError(f"{where}.{key} is empty; allowed: {', '.join(allowed)}")
            for value in getattr(state, key):
                check_among(f"{where}.{key}", value, allowed)
        for key in ("incidence_deg", "wind_off_deg", "current_off_deg"):
            values = getattr(state, key)
            if not values or any(not -360 <= value <= 360 for value in values):
                raise StudyError(f"{where}.{key} is {values}; allowed: a list of one or more angles, each −360 to 360")
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
    """Raises StudyError for wear of types whose diameter is unknown."""
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
    """Raises StudyError for a curve or shares of the time that give no damage."""
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
        check_among("fatigue.curve", own.curve, tuple(curves()))
    else:
        positive("fatigue.exponent", own.exponent)
        positive("fatigue.constant", own.constant)
        check_among("fatigue.basis", own.basis, BASES)
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
                f"limits[{i}].quantity is {one.quantity!r}; allowed: {'; '.join(known)}; or add this "
                "quantity by [[values]]"
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
                    f"{'; '.join((*OF_TENSIONS, *found, *KNOWN_OF_PROJECT))}; or add this quantity by [[values]]"
                )


def _check_needs(needs, criteria):
    """Raises StudyError if no criterion limits a Need of the study, which would pass unchecked"""
    missing = [need for need in needs if not need.judged(criteria)]
    if missing:
        limits = [repr(need.quantities[0]) + (' with subject = "hawser"' if need.hawser else "") for need in missing]
        raise StudyError(
            f"the study has {_all_of([need.what for need in missing])}, but no chosen criterion judges them; give a "
            f"rule set that does, or [[limits]] of {_all_of(limits)}"
        )


def _all_of(texts):
    *before, last = dict.fromkeys(texts)
    return f"{', '.join(before)} and {last}" if before else last


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
            rules = dict.fromkeys(one.rule for one in read_rules(None) if one.quantity == quantity)
            raise StudyError(
                f"[{table}] is given, but no chosen criterion limits {quantity!r}; give a rule set that does "
                f"({', '.join(rules)}) or [[limits]], or leave out [{table}]"
            )


def _check_values(project, criteria):
    """Raises StudyError for a value that no criterion asks for."""
    asked = dict.fromkeys(one.quantity for one in criteria if one.quantity not in FOUND)
    for i, one in enumerate(project.values):
        where = f"values[{i}]"
        check_among(f"{where}.state", one.state, KNOWN_STATES)
        check_among(f"{where}.lines", one.lines, KNOWN_LINES)
        if not 0 <= one.value < math.inf:
            raise StudyError(f"{where}.value is {one.value:g}; allowed: 0 or more, finite")
        if one.quantity not in asked:
            known = "; ".join(asked) or "none is asked for"
            raise StudyError(f"{where}.quantity is {one.quantity!r}; allowed by the chosen criteria: {known}")


def _check_earthquakes(project, study, folder):
    """Raises StudyError for earthquakes of a study without fenders, and faults of their own studies."""
    from .kinds.earthquake import check_study

    if project.earthquakes and not study.get("fender"):
        raise StudyError(
            "earthquakes are given, but the study has no fenders; a hull on lines alone has long natural periods, "
            "which an earthquake does not excite; leave the earthquakes out"
        )
    for i, one in enumerate(project.earthquakes):
        if [other.name for other in project.earthquakes].count(one.name) > 1:
            raise StudyError(
                f"earthquakes[{i}].name is {one.name!r}, the name of another earthquake; give each earthquake its own "
                f"name"
            )
        check_study(folder / one.study)


def check_among(key, value, allowed):
    """Raises StudyError for a value that is not among the allowed values."""
    if value not in allowed:
        raise StudyError(f"{key} is {value!r}; allowed: {', '.join(allowed)}")
