"""All of a project judged: cases, criteria, governing cases, whether it can be signed."""

from __future__ import annotations

from typing import NamedTuple

from mooring.criteria.verdict import judge
from mooring.response.return_period import return_period

from .comparison import side_by_side
from .fatigue import fatigue
from .running import grouped, judged_case

PASSES, FAILS, OPEN = "passes", "fails", "cannot be signed"


class Verdict(NamedTuple):
    """ran : all Ran; judged : a Judged for each criterion; return_period : years, None where it is not given

    word : passes, fails, or cannot be signed where a criterion is not judged or a case could not be run
    rule_sets : of `comparison.side_by_side`
    """

    ran: list
    judged: tuple
    return_period: float | None
    word: str
    rule_sets: tuple


def judged_project(read, ran):
    """The Verdict on all load cases of a project"""
    groups = grouped(ran)
    others = project_quantities(read)
    cases = [judged_case(read, group, others) for group in groups.values() if group[1.0].numbers is not None]
    worn_out = fatigue(read, ran)
    judged = (*judge(read.criteria, cases), *(() if worn_out is None else (worn_out,)))
    unknown = any(one.numbers is None for one in ran) or any(one.met is None for one in judged)
    word = FAILS if any(one.met is False for one in judged) else OPEN if unknown else PASSES
    return Verdict(ran, judged, others.get("return period"), word, side_by_side(read, cases))


def project_quantities(read):
    """{quantity: value} that criteria ask of the project as a whole"""
    own = read.project.project
    if own.service_life is None:
        return {}
    return {
        "service life": own.service_life,
        "return period": float(return_period(own.service_life, own.probability)),
    }
