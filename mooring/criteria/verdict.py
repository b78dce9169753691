"""Utilisation of each criterion by the results of load cases, and the governing case.

    at most    u = value / limit          at least   u = limit / value
    partial factors    u = (γ_mean T_mean + γ_dyn (T − T_mean)) / (0.95 T_break)        DNV-OS-E301, ch. 2 sec. 2

A criterion is met where u ≤ 1. If no case has the quantity of a criterion, it is reported as not judged, never as met.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .rules import Criterion

SAFETY = "breaking load / tension"
SHARE = "tension / breaking load"
WORN = "tension / breaking load, worn"
PRETENSION = "pretension / breaking load"
PARTIAL = "partial factors on mean and dynamic tension"
FACTOR = "partial factor on tension"
HOLDING = "holding capacity / horizontal force"
HAWSER = "hawser"
CHARACTERISTIC = 0.95  # strength over minimum breaking load without statistics of the strength


class Tensions(NamedTuple):
    """Tensions and strengths of the lines of one load case, (n,) N each.

    pretension, static, largest : tension at rest, under steady loads, and largest; breaking : breaking load, inf
        where unknown
    worn : breaking load after wear, None without wear
    horizontal, holding : horizontal pull at the anchor, and its holding capacity (None if not given), (n,) N
    hawsers : names of the hawsers; if there are any, criteria on hawsers apply only to hawsers, all other criteria
        only to other lines
    """

    names: tuple[str, ...]
    pretension: np.ndarray
    static: np.ndarray
    largest: np.ndarray
    breaking: np.ndarray
    worn: np.ndarray | None = None
    horizontal: np.ndarray | None = None
    holding: np.ndarray | None = None
    hawsers: tuple[str, ...] = ()


class Case(NamedTuple):
    """Values of a load case for the criteria.

    state : normal or abnormal; lines : intact, one lost or transient; analysis : quasi-static or dynamic
    tensions : {motion factor: Tensions}; the factor is 1 for computed motions; some rules require others
    motions : {motion: largest amplitude, m or degrees}; with several bodies {motion: {body: amplitude}}
    others : {quantity: value} of the load case, for all other quantities
    parts : {quantity: {part: value}}, such as strains of fenders, or None
    partial : whether the case is judged only by its available quantities; an earthquake, for example, has no ropes
    ranges : like motions, but largest less smallest value of a record; None where this is twice the amplitude
    """

    name: str
    state: str
    lines: str
    analysis: str
    tensions: dict
    motions: dict
    others: dict
    parts: dict | None = None
    partial: bool = False
    ranges: dict | None = None


class Use(NamedTuple):
    """Utilisation of a criterion by a load case: value in the criterion's unit, utilisation, and the line or motion
    concerned
    """

    case: str
    item: str
    value: float
    utilisation: float


@dataclass(frozen=True)
class Judged:
    """A criterion, and its Use in each case to which it applies, with the largest first; empty if no case can be
    judged
    """

    criterion: Criterion
    uses: tuple[Use, ...]
    missing: str = ""

    @property
    def governing(self):
        """The Use of the governing case, or None"""
        return self.uses[0] if self.uses else None

    @property
    def met(self):
        """True, False, or None if the criterion cannot be judged"""
        return None if not self.uses else bool(self.uses[0].utilisation <= 1.0)


def judge(criteria, cases):
    """A Judged for each criterion, in order; cases : any number of Case"""
    return tuple(_judged(criterion, cases) for criterion in criteria)


def _judged(criterion, cases):
    held = [case for case in cases if criterion.holds(case.state, case.lines, case.analysis)]
    if not held:
        which = f"no load case is {_which(criterion)}; add such a state, or take another rule set or limits of your own"
        return Judged(criterion, (), which if cases else "no load case could be run")
    uses, missing = [], []
    for case in held:
        try:
            uses.append(_use(criterion, case))
        except LookupError as lacking:
            if not case.partial:
                missing.append(f"{case.name} has no {lacking.args[0]}")
    if not uses and not missing:
        missing.append(f"no load case has {criterion.quantity}")
    uses.sort(key=lambda use: -use.utilisation)
    return Judged(criterion, () if missing else tuple(uses), "; ".join(missing[:1]))


def _which(criterion):
    own = (criterion.state, f"lines {criterion.lines}", criterion.analysis)
    return ", ".join(word for word in own if not word.endswith("any"))


def _use(criterion, case):
    """The Use of a case.  Raises LookupError, which names the missing quantity."""
    if criterion.quantity in OF_TENSIONS:
        if criterion.motion_factor not in case.tensions:
            raise LookupError(f"tension at {criterion.motion_factor:g} times the motion")
        t = case.tensions[criterion.motion_factor]
        if not t.names:
            raise LookupError("line")
        values = np.asarray(OF_TENSIONS[criterion.quantity](criterion, t), float)
        names, values = _spoken_of(criterion, t, values)
        if np.isnan(values).any():
            raise LookupError(f"breaking load of {names[int(np.argmax(np.isnan(values)))]}")
        used = values
        if criterion.quantity not in (PARTIAL, FACTOR):
            used = np.array([criterion.utilisation(value) for value in values])
        worst = int(np.argmax(used))
        return Use(case.name, names[worst], float(values[worst]), float(used[worst]))
    if case.parts and criterion.quantity in case.parts:
        uses = [
            Use(case.name, *pair, criterion.utilisation(pair[1])) for pair in case.parts[criterion.quantity].items()
        ]
        return max(uses, key=lambda use: use.utilisation)
    if isinstance(case.motions.get(criterion.quantity), dict):
        return _of_bodies(criterion, case)
    if criterion.quantity in case.motions:
        value = _moved(criterion, case)
    elif criterion.quantity in case.others:
        value = case.others[criterion.quantity]
    else:
        raise LookupError(criterion.quantity)
    return Use(case.name, criterion.quantity, float(value), criterion.utilisation(float(value)))


def _of_bodies(criterion, case):
    """The largest Use of all bodies; of one body alone where that is the subject of the criterion"""
    bodies = case.motions[criterion.quantity]
    about = [criterion.subject] if criterion.subject in bodies else bodies
    values = {name: float(_moved(criterion, case, name)) for name in about}
    uses = [Use(case.name, f"{name} {criterion.quantity}", x, criterion.utilisation(x)) for name, x in values.items()]
    return max(uses, key=lambda use: use.utilisation)


def _moved(criterion, case, body=None):
    """The statistic of a criterion on a motion, of one of several bodies, m or degrees"""
    whole = criterion.statistic == "peak to peak"
    found = (case.ranges if whole and case.ranges is not None else case.motions)[criterion.quantity]
    return (found if body is None else found[body]) * (2.0 if whole and case.ranges is None else 1.0)


def _spoken_of(criterion, t, values):
    """Names and values of the lines, or hawsers, that a criterion applies to"""
    if not t.hawsers:
        return t.names, values
    about = [(name in t.hawsers) == (criterion.subject == HAWSER) for name in t.names]
    if not any(about):
        raise LookupError(HAWSER if criterion.subject == HAWSER else "line")
    return [name for name, one in zip(t.names, about, strict=True) if one], values[np.array(about)]


def _over(strength, load):
    """Utilisation of each line; shape (n,): inf for a slack line without load, or an anchor whose chain lies on the
    bed"""
    return np.divide(strength, load, out=np.where(np.isnan(strength), np.nan, np.inf), where=np.asarray(load) > 0)


def _known(loads):
    """Breaking loads, NaN where unknown"""
    return np.where(np.isfinite(loads), loads, np.nan)


def _worn(_, t):
    return t.largest / _known(_given(t.worn, "breaking load after wear; give wear in mm a year"))


def _holding(_, t):
    held = _given(t.holding, "holding capacity of the anchors")
    return _over(held, t.horizontal)


def _partial(criterion, t):
    mean, dynamic = criterion.limit * t.static, criterion.second * (t.largest - t.static)
    return (mean + dynamic) / (CHARACTERISTIC * _known(t.breaking))


def _factor(criterion, t):
    return criterion.limit * t.largest / (CHARACTERISTIC * _known(t.breaking))


def _given(value, what):
    if value is None:
        raise LookupError(what)
    return value


OF_TENSIONS = {
    SAFETY: lambda _, t: _over(_known(t.breaking), t.largest),
    SHARE: lambda _, t: t.largest / _known(t.breaking),
    PRETENSION: lambda _, t: t.pretension / _known(t.breaking),
    WORN: _worn,
    HOLDING: _holding,
    PARTIAL: _partial,
    FACTOR: _factor,
}
