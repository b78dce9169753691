"""What every rule set of the tables says to the same load cases, side by side (as Table 4.3 of SR179, 1982, does)."""

from __future__ import annotations

from typing import NamedTuple

from mooring.criteria.rules import read_rules, rule_names
from mooring.criteria.verdict import judge


class RuleSet(NamedTuple):
    """name : with its edition; chosen : whether it judges the project; judged, known : how many of its criteria

    criterion, use : that governs of those judged, with its Use, None where none is; unread : of those, not of a source
    that was read
    """

    name: str
    chosen: bool
    judged: int
    known: int
    criterion: object
    use: object
    unread: int


def side_by_side(read, cases):
    """(RuleSet of each rule set of which a criterion can be judged by Cases, the largest use first)"""
    every, own = read_rules(), {criterion.rule for criterion in read.criteria}
    found = []
    for name in rule_names(every):
        criteria = [criterion for criterion in every if criterion.rule == name]
        judged = [one for one in judge(criteria, cases) if one.governing is not None]
        if not judged:
            continue
        worst = max(judged, key=lambda one: one.governing.utilisation)
        unread = sum(one.criterion.status != "read" for one in judged)
        counts = len(judged), len(criteria), worst.criterion, worst.governing, unread
        found.append(RuleSet(criteria[0].name, name in own, *counts))
    return tuple(sorted(found, key=lambda one: -one.use.utilisation))
