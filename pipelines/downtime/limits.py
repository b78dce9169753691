"""Limits of operations, and the utilisation of each limit in each hour.

motion, point           mean largest amplitude of an hour, the significant one, or peak to peak air gap
clearance minus the largest rise of the water at a point under-keel clearance    water at rest, with the level of the
hour, minus the largest drop of the bottom; the least simulated               motions, tensions, fenders of the moored
body, with [simulation], in place of all these the hindcast            significant height, and each of its columns
"""

from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.rules import OWN, Criterion, RuleError, of_rule, read_rules, unit_of
from hakobune.mooring.downtime.largest import largest_of_hours
from hakobune.mooring.response.points import KeelPoint, keel_name, relative_name

from ..common.quantities import StudyError
from .study import known_columns
from .tables import PASSING

SIMULATED = "simulated"
STATISTICS = "largest", "significant", "peak to peak"
KEEL, AIR = "under-keel clearance", "air gap "
WEATHER = {"significant height": "m", "wind speed": "m/s", "current speed": "m/s", "level": "m", "ice": ""}
READ_IN = {"rad": ("deg", np.pi / 180), "m/s²": ("m/s²", 1.0)}


class Limit(NamedTuple):
    """operation : number of the operation; criterion : from `mooring.criteria.rules`; label : label for tables

    kind : "response", "air gap", "keel", "weather" or SIMULATED; names : names of the responses that it needs
    rest : value at rest, (p,) m: an air gap, or the depth of water under points of the keel
    """

    operation: int
    criterion: Criterion
    label: str
    kind: str
    names: tuple[str, ...] = ()
    rest: tuple[float, ...] = ()


class Hours(NamedTuple):
    """names, units : of responses, (c,); m0, m2 : moments in every hour, (n, c); duration : duration of a largest
    value, s
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    m0: np.ndarray
    m2: np.ndarray
    duration: float


def limits_of(study, points, responses, moored=None):
    """[Limit] of a DowntimeStudy.

    points : points of its body; responses : {name: unit} of all responses of the body
    moored : {name: unit} of simulation results of the moored body, in place of responses; or None
    raises : StudyError
    """
    found = []
    for number, operation in enumerate(study.operations):
        where = f"operations[{number}]"
        criteria = [_own(f"{where}.limits[{i}]", table) for i, table in enumerate(operation.limits)]
        criteria += _of_rule(where, operation)
        if not criteria:
            raise StudyError(f"{where}, {operation.name!r}, has neither limits nor a rule; give one of them")
        for one in criteria:
            source = _source(where, one.quantity, study, points, responses, moored)
            found.append(_limit(where, number, operation.name, one, source))
    return found


def _own(where, table):
    if (table.at_most is None) == (table.at_least is None):
        state = "neither is given" if table.at_most is None else "both are given"
        raise StudyError(f"{where}: {state}; give one of at_most, at_least")
    if table.statistic not in STATISTICS:
        raise StudyError(f"{where}.statistic is {table.statistic!r}; allowed: {', '.join(STATISTICS)}")
    value, sense = (table.at_most, "at most") if table.at_least is None else (table.at_least, "at least")
    if not 0 < value < np.inf:
        raise StudyError(f"{where}: {sense.replace(' ', '_')} is {value:g}; allowed: above 0, finite")
    return Criterion(OWN, "", table.quantity, sense, value, None, "", "any", "any", "any", "", table.statistic, 1.0,
                     "the study", "read")  # fmt: skip


def _of_rule(where, operation):
    if operation.rule is None:
        return []
    try:
        found = of_rule(read_rules(), operation.rule, operation.subject)
    except RuleError as error:
        raise StudyError(f"{where}: {error}") from None
    if operation.subject is None and len({one.subject for one in found}) > 1:
        known = "; ".join(dict.fromkeys(one.subject for one in found))
        raise StudyError(f"{where}.subject is missing; allowed for {operation.rule}: {known}")
    return found


def _limit(where, number, name, criterion, source):
    quantity, (kind, names, rest, unit) = criterion.quantity, source
    if kind not in ("response", SIMULATED) and criterion.statistic not in ("largest", ""):
        raise StudyError(
            f"{where}: {quantity} has no statistic {criterion.statistic!r}; allowed: largest (other statistics exist "
            "for motions and points)"
        )
    if kind == "response" and criterion.sense != "at most":
        raise StudyError(f"{where}: {quantity} is limited from above; give at_most")
    try:
        unit = unit_of(where, quantity, criterion.unit or unit) or unit
    except RuleError as error:
        raise StudyError(str(error)) from None
    criterion = criterion._replace(unit=unit)
    sign = "≤" if criterion.sense == "at most" else "≥"
    statistic = "" if criterion.statistic in ("largest", "amplitude", "") else f", {criterion.statistic}"
    label = f"{name}: {quantity}{statistic} {sign} {criterion.limit:g} {unit}".rstrip()
    return Limit(number, criterion, label, kind, names, rest)


def _source(where, quantity, study, points, responses, moored):
    """Kind, names of responses, clearance at rest, and unit of a quantity.  Raises StudyError."""
    columns = [*known_columns(study.hindcast.columns), *(PASSING if study.passages else ())]
    if quantity == "significant height" or quantity in columns:
        return "weather", (), (), (WEATHER | PASSING).get(quantity, "")
    if moored is not None:
        if quantity in moored:
            return SIMULATED, (), (), moored[quantity]
        known = ", ".join(["significant height", *columns, *moored])
        raise StudyError(f"{where}: no simulation of this study gives {quantity!r}; allowed: {known}")
    if quantity in responses:
        unit = responses[quantity]
        return "response", (quantity,), (), READ_IN.get(unit, (unit, 1.0))[0]
    keel = [point for point in points if isinstance(point, KeelPoint)]
    if quantity == KEEL and keel:
        return "keel", tuple(map(keel_name, keel)), tuple(point.gap for point in keel), "m"
    dry = {AIR + p.name: p for p in points if not isinstance(p, KeelPoint) and p.clearance is not None}
    if quantity in dry:
        return "air gap", (relative_name(dry[quantity]),), (dry[quantity].clearance,), "m"
    known = ["significant height", *columns, *responses, *dry, *([KEEL] if keel else [])]
    missing = ", which requires a column in hindcast.columns" if quantity in WEATHER else ""
    missing = ", which requires [keel] and a finite depth" if quantity == KEEL else missing
    raise StudyError(f"{where}: no result gives {quantity!r}{missing}; allowed: {', '.join(known)}")


def used_of(limits, hours, hindcast):
    """Utilisation of each limit in each hour, above 1 beyond the limit; shape (n, l); nan where unknown"""
    return np.stack([_used(one.criterion, value_of(one, hours, hindcast)) for one in limits], axis=1)


def _used(criterion, value):
    if criterion.sense == "at most":
        return value / criterion.limit
    with np.errstate(divide="ignore"):
        return np.where(value > 0, criterion.limit / np.maximum(value, 0.0), np.where(np.isnan(value), np.nan, np.inf))


def value_of(limit, hours, hindcast):
    """Values of the limited quantity, in its unit; shape (n,)"""
    quantity, statistic = limit.criterion.quantity, limit.criterion.statistic
    if limit.kind == "weather":
        return hindcast.height if quantity == "significant height" else hindcast.columns[quantity]
    columns = [hours.names.index(name) for name in limit.names]
    m0, m2 = hours.m0[:, columns], hours.m2[:, columns]
    if limit.kind == "response":
        value = 2 * np.sqrt(m0) if statistic == "significant" else largest_of_hours(m0, m2, hours.duration)
        size = READ_IN.get(hours.units[columns[0]], ("", 1.0))[1]
        return value[:, 0] * (2.0 if statistic == "peak to peak" else 1.0) / size
    left = np.array(limit.rest) - largest_of_hours(m0, m2, hours.duration)
    if limit.kind == "keel" and "level" in hindcast.columns:
        left = left + hindcast.columns["level"][:, None]
    return left.min(axis=1)
