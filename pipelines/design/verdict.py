"""The verdict on a project: cases, criteria, governing cases, every rule set, and whether the project can be
signed.
"""

import re
from typing import NamedTuple

from hakobune.bem import DOFS
from hakobune.mooring.criteria.failing import failing
from hakobune.mooring.criteria.rules import OWN, Criterion, read_rules
from hakobune.mooring.criteria.verdict import judge
from hakobune.mooring.lines.catalogue import FIBRE
from hakobune.mooring.response.return_period import return_period

from .fatigue import fatigue
from .kinds.needs import ANCHOR
from .running import grouped, judged_case

NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?")
OF_ANCHORS = Criterion(
    "the study's anchors", "", ANCHOR, "at most", 1.0, None, "-", "any", "any", "any", "", "largest", 1.0,
    "capacity and safety of the study's [[anchors]]", "read",
)  # fmt: skip
PASSES, FAILS, OPEN = "passes", "fails", "cannot be signed"


class RuleSet(NamedTuple):
    """name : name with edition; subject : what the rule set applies to; chosen : whether any of its criteria judges the
    project

    judged, known : number of judged criteria, and of all criteria; criterion, use : the governing judged criterion, and
    its Use;
    unread : number of criteria whose source has not been read
    """

    name: str
    subject: str
    chosen: bool
    judged: int
    known: int
    criterion: object
    use: object
    unread: int


class Verdict(NamedTuple):
    """ran : all Ran; broken : failures of a case or a database other than criteria, one line each
    judged : a Judged for each criterion; return_period : years, None where no return period is given

    word : passes, fails, or cannot be signed, if a criterion is not judged or a case could not be run
    rule_sets : from `side_by_side`
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
    anchored = [case for case in cases if ANCHOR in case.parts]
    criteria = (*judge(read.criteria, cases), *judge((OF_ANCHORS,) if anchored else (), anchored))
    judged = (*criteria, *(() if worn_out is None else (worn_out,)))
    unknown = any(one.numbers is None for one in ran) or any(one.met is None for one in judged)
    broken = (*of_databases, *broken_in(ran))
    word = FAILS if broken or any(one.met is False for one in judged) else OPEN if unknown else PASSES
    return Verdict(ran, broken, judged, others.get("return period"), word, side_by_side(read, cases))


def broken_in(ran):
    """Failures that studies of load cases report (lines that break, fenders beyond their capacity).

    There is one line for each kind of failure, from the first case with this failure. Tensions at multiples of
    motions, which some rules require, are not such failures.
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


def side_by_side(read, cases):
    """The RuleSet of each rule set and subject with a criterion that Cases can judge, the largest use first

    As in Table 4.3 of the SR179 report (1982), a rule set has several subjects, such as chain or hawser, or one of
    several kinds of anchor. Each has its own row if the study has such a part.
    Limits on motions apply to a ship with its
    cargo; they appear only if the project has chosen them.
    """
    own, found, motions = set(read.criteria), [], {dof.lower() for dof in DOFS}
    known = dict.fromkeys((*read_rules(), *(one for one in read.criteria if one.rule != OWN)))  # and own files
    bounded = [one for one in known if one.quantity not in motions or one in own]
    things = _things(read.study)
    for rule, subject in dict.fromkeys((one.rule, one.subject) for one in bounded):
        criteria = [one for one in bounded if (one.rule, one.subject) == (rule, subject)]
        if not own & set(criteria) and any(word in subject for word, there in things.items() if not there):
            continue
        judged = [one for one in judge(criteria, cases) if one.governing is not None]
        if not judged:
            continue
        worst = max(judged, key=lambda one: one.governing.utilisation)
        unread = sum(one.criterion.status != "read" for one in judged)
        chosen = any(one in own for one in criteria)
        counts = len(judged), len(criteria), worst.criterion, worst.governing, unread
        found.append(RuleSet(criteria[0].name, subject, chosen, *counts))
    return tuple(sorted(found, key=lambda one: -one.use.utilisation))


def _things(study):
    """{word of a subject: whether the tables of a study have it}; a line outside the catalogue may be of any kind"""
    fibre = tuple(FIBRE)
    made = [table.get("catalogue", "").lower() for table in study.get("types", {}).values()]
    made += ["rope" for _ in study.get("rope", ())]
    steel, free = ("wire", "spiral"), ("", "rope")
    return {
        "hawser": bool(study.get("hawser")),
        "fender": bool(study.get("fender")),
        "dolphin": bool(study.get("fender")),
        "single-point": "attachment" in study,
        "multi-point": "attachment" not in study,
        "chain": any(not name.startswith((*fibre, *steel, "rope")) for name in made),
        "wire": any(name in free or name.startswith(steel) for name in made),
        "synthetic": any(name in free or name.startswith(fibre) for name in made),
    }
