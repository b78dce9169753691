"""Verdicts of every rule set in the tables on the same load cases, side by side (as Table 4.3 of SR179, 1982).

A rule set has several subjects, such as chain or hawser, or one of several kinds of anchor.  Each subject has its own
row if the study has such a part.  Limits on motions apply to a ship with its cargo; they appear only if the project has
chosen them.
"""

from typing import NamedTuple

from hakobune.bem import DOFS
from hakobune.mooring.criteria.rules import OWN, read_rules
from hakobune.mooring.criteria.verdict import judge
from hakobune.mooring.lines.catalogue import FIBRE


class RuleSet(NamedTuple):
    """name : with its edition; subject : what it applies to; chosen : whether one of its criteria judges the project

    judged, known : number of its criteria that are judged, and of all; criterion, use : the governing one of those
    judged, with its Use; unread : number of criteria whose source has not been read
    """

    name: str
    subject: str
    chosen: bool
    judged: int
    known: int
    criterion: object
    use: object
    unread: int


def side_by_side(read, cases):
    """(RuleSet of each rule set and subject with a criterion that Cases can judge, the largest use first)"""
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
