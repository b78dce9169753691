"""The judgement of a whole project: cases, criteria, governing cases, whether it can be signed."""

from __future__ import annotations

import re
from typing import NamedTuple

from hakobune.mooring.criteria.failing import failing
from hakobune.mooring.criteria.verdict import judge
from hakobune.mooring.response.return_period import return_period

from .comparison import side_by_side
from .fatigue import fatigue
from .running import grouped, judged_case

NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?")
PASSES, FAILS, OPEN = "passes", "fails", "cannot be signed"


class Verdict(NamedTuple):
    """ran : all Ran; broken : failures of a case or a database other than criteria, one line each
    judged : a Judged for each criterion; return_period : years, None where it is not given

    word : passes, fails, or cannot be signed, if a criterion is not judged or a case could not be run
    rule_sets : of `comparison.side_by_side`
    """

    ran: list
    broken: tuple
    judged: tuple
    return_period: float | None
    word: str
    rule_sets: tuple


def judged_project(read, ran, of_databases=()):
    """The Verdict on all load cases of a project; of_databases : failures of its databases, one line each"""
    groups = grouped(ran)
    others = project_quantities(read)
    cases = [judged_case(read, group, others) for group in groups.values() if group[1.0].numbers is not None]
    worn_out = fatigue(read, ran)
    judged = (*judge(read.criteria, cases), *(() if worn_out is None else (worn_out,)))
    unknown = any(one.numbers is None for one in ran) or any(one.met is None for one in judged)
    broken = (*of_databases, *broken_in(ran))
    word = FAILS if broken or any(one.met is False for one in judged) else OPEN if unknown else PASSES
    return Verdict(ran, broken, judged, others.get("return period"), word, side_by_side(read, cases))


def broken_in(ran):
    """Failures that the studies of load cases report (lines that part, fenders beyond their capacity): a line for each
    kind, from the first case that has it. Tensions at multiples of motions, which some rules require, are not such
    failures.
    """
    found = {}
    for one in (one for one in ran if one.case.factor == 1):
        for text in failing(one.numbers.warnings) if one.numbers is not None else ():
            found.setdefault(NUMBER.sub("#", text), []).append(f"{text}; in {one.case.name}")
    for texts in found.values():
        more = f", and in {len(texts) - 1} more case{'s' * (len(texts) > 2)}" if len(texts) > 1 else ""
        yield texts[0] + more


def project_quantities(read):
    """{quantity: value} of criteria on the project as a whole"""
    own = read.project.project
    if own.service_life is None:
        return {}
    return {
        "service life": own.service_life,
        "return period": float(return_period(own.service_life, own.probability)),
    }
