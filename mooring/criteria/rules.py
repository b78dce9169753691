"""Criteria of rule sets as data: a quantity, its limit, the state to which the limit applies, and the limit's source.

A table has a row for each criterion:

    rule, edition      whose it is
    quantity           what is bounded: "breaking load / tension", "fender strain, total", "surge", …
    sense, limit, unit "at least" or "at most"; a number, or a fraction such as 1/3; that of the quantity (`unit_of`)
    second             the other factor where a criterion has two (on dynamic tension, `verdict.PARTIAL`)
    state              normal (operating), abnormal (extreme), any
    lines              intact, one lost (at rest after it), transient (just after it), any
    analysis           quasi-static, dynamic, any
    subject            what it is about: chain, hawser, ship and cargo
    statistic          largest and amplitude, of motions from the mean; peak to peak, largest less smallest of a record:
                       a limit without it is none
    motion_factor      by which the largest motion is multiplied before the tension is taken
    source, status     read: quoted in a source that was read; secondary; unverified: to be confirmed in the book

The tables beside this module contain the rules quoted by SR179 (1982), chapter 4, and later rules as publicly quoted.
"""

import math
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from hakobune.meshing.text_files import csv_rows

SENSES = ("at least", "at most")
STATES = ("normal", "abnormal", "any")
LINES = ("intact", "one lost", "transient", "any")
ANALYSES = ("quasi-static", "dynamic", "any")
STATUSES = ("read", "secondary", "unverified")
OWN = "own limit"  # rule of a criterion that belongs to no rule set
TABLES = ("strength.csv", "motions.csv")
UNITS = {
    **dict.fromkeys(("surge", "sway", "heave", "excursion", "transmitted wave height", "gap between hulls"), "m"),
    **{"hinge force": "kN", "hinge moment": "kN m"},
    **dict.fromkeys(("roll", "pitch", "yaw", "slewing amplitude"), "deg"),
    **dict.fromkeys(("service life", "return period"), "years"),
}
NUMBERS = (  # beginnings of names
    "partial factor", "fender strain", "gust factor", "horizontal seismic coefficient", "stable headings",
    "transmission of the sea", "slack share of the cycles", "factor x fatigue damage",
)  # fmt: skip


class RuleError(ValueError):
    """A rule set cannot be used; the message names the fault and the allowed values."""


class Criterion(NamedTuple):
    """One row of a table, as described in the module; limit and second are numbers in `unit`; motion_factor is 1 by
    default
    """

    rule: str
    edition: str
    quantity: str
    sense: str
    limit: float
    second: float | None
    unit: str
    state: str
    lines: str
    analysis: str
    subject: str
    statistic: str
    motion_factor: float
    source: str
    status: str

    @property
    def name(self):
        """The rule with its edition, if any"""
        return f"{self.rule} ({self.edition})" if self.edition else self.rule

    def holds(self, state, lines, analysis):
        """Whether the criterion applies to a load case of the given state, lines and kind of analysis"""
        pairs = (self.state, state), (self.lines, lines), (self.analysis, analysis)
        return all(own in ("any", asked) for own, asked in pairs)

    def utilisation(self, value):
        """Utilisation of the limit by `value` ≥ 0 of its quantity: 1 at the limit, above 1 beyond it"""
        if self.sense == "at most":
            return value / self.limit
        return self.limit / value if value > 0 else math.inf


def read_rules(path=None):
    """All criteria of the tables, or all criteria of a user's file.  Raises RuleError."""
    if path is None:
        tables = {name: files(__package__).joinpath("tables", name).read_text(encoding="utf-8") for name in TABLES}
    else:
        from hakobune.meshing.text_files import read_text

        tables = {str(path): read_text(path, RuleError, largest=8)}
    return tuple(criterion for name, text in tables.items() for criterion in _rows(name, text))


def unit_of(where, quantity, unit):
    """The unit of a known quantity if `unit` agrees with it or is missing; for an unknown quantity `unit`

    Units are not converted: a different unit raises RuleError, whose text begins with `where`. A ratio, "… / …", has
    the unit -.
    """
    own = UNITS.get(quantity, "-" if " / " in quantity or quantity.startswith(NUMBERS) else None)
    if own is not None and unit not in ("", own):
        raise RuleError(f"{where}: unit of {quantity} is {unit!r}; allowed: {own}")
    return unit if own is None else own


def rule_names(criteria):
    """Names of rule sets in the order of their tables"""
    return tuple(dict.fromkeys(criterion.rule for criterion in criteria))


def of_rule(criteria, rule, subject=None):
    """Criteria of one rule set, or only of its `subject` if given.  Raises RuleError if there are none."""
    found = [criterion for criterion in criteria if criterion.rule.lower() == rule.lower()]
    if not found:
        raise RuleError(f"rule set {rule!r} is unknown; allowed: {', '.join(rule_names(criteria))}")
    if subject is None:
        return tuple(found)
    chosen = tuple(criterion for criterion in found if criterion.subject == subject)
    if not chosen:
        known = list(dict.fromkeys(criterion.subject for criterion in found))
        near = [one for one in known if subject.lower() in one.lower()] or known
        named = ", ".join(f'"{one}"' for one in near)
        raise RuleError(f"{rule} contains no criterion for {subject!r}; allowed: {named}")
    return chosen


def _rows(name, text):
    rows = csv_rows(text)
    missing = [key for key in Criterion._fields if key not in (rows.fieldnames or ())]
    if missing:
        raise RuleError(f"{name} has no column {missing[0]}; allowed: {', '.join(Criterion._fields)}")
    for number, row in enumerate(rows, 1):
        yield _criterion(f"{Path(name).name}, criterion {number}", row)


def _criterion(where, row):
    for key, allowed in (
        ("sense", SENSES),
        ("state", STATES),
        ("lines", LINES),
        ("analysis", ANALYSES),
        ("status", STATUSES),
    ):
        if row[key] not in allowed:
            raise RuleError(f"{where}: {key} is {row[key]!r}; allowed: {', '.join(allowed)}")
    for key in ("rule", "quantity", "source"):
        if not (row[key] or "").strip():
            raise RuleError(f"{where}: {key} is empty; give a text")
    numbers = {
        "limit": _number(where, "limit", row["limit"]),
        "second": _number(where, "second", row["second"]) if row["second"] else None,
        "motion_factor": _number(where, "motion_factor", row["motion_factor"]) if row["motion_factor"] else 1.0,
    }
    unit = unit_of(where, row["quantity"], (row["unit"] or "").strip())
    return Criterion(**{key: row[key] for key in Criterion._fields} | numbers | {"unit": unit})


def _number(where, key, text):
    """A number above 0, or a fraction of two"""
    try:
        above, _, below = (text or "").partition("/")
        value = float(above) / (float(below) if below else 1.0)
    except (ValueError, ZeroDivisionError):
        value = math.nan
    if not 0 < value < math.inf:
        raise RuleError(f"{where}: {key} is {text!r}; allowed: a number above 0, or a fraction such as 1/3")
    return value
