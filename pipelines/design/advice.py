"""The smallest sufficient change for each way of changing a mooring, found by running the governing cases.

Each change is a new layout, since a heavier line has another shape and another pull.
The changes of one kind are tried first in doubling steps, then between the last change that failed and the first that
passed.  The change just below the advised one
was therefore run, and failed.
"""

import itertools
from functools import cache, partial
from typing import NamedTuple

import msgspec

from hakobune.mooring.criteria.verdict import judge

from ..simulate.over_runs import OF_LINES
from .cases import intact_cases, without_line
from .fatigue import fatigue
from .kinds.changes import ways
from .running import Ran, base_of, factors_of, grouped, judged_case, key_of, repeated, worst_of

NOTHING = (
    "No change was tried: the study has no catalogue size, rope, pretension or number of lines that could change. "
    "Change the layout, or use another kind of line or fender."
)


class Tried(NamedTuple):
    """way : from `changes.ways`; words : the change; utilisation : the largest with the change; passes : whether the
    change makes all criteria met

    criterion : that governs then
    """

    way: str
    words: str
    utilisation: float
    passes: bool
    criterion: object


class Advice(NamedTuple):
    """tried : names of the ways that were run; found : Tried of each helpful way; beyond : failures that no way changes

    The Tried of a way is its smallest sufficient change, or else the best.
    """

    tried: tuple
    found: tuple
    beyond: str


def advise(read, judged, cases, others, paths, folder, step):
    """The Advice on criteria that are not met; empty if all are met.

    judged : every criterion judged; cases : {name: LoadCase} of all that ran; others : quantities of the project
    paths : {level: database}; step : called with the number of changes tried, their largest number and the change
    """
    fixed = {*others, *(one.quantity for one in read.project.values)}
    beyond = _beyond(judged, cases.values(), fixed)
    changed = [one for one in judged if one.criterion.quantity not in fixed]
    if _shaken(judged, cases.values()) or all(one.met is not False for one in changed):
        return Advice((), (), beyond)
    changes = ways(read.study)
    if not changes:
        return Advice((), (), NOTHING)
    governing = [one for one in changed if one.governing is not None and one.governing.case in cases]
    keys = {key_of(cases[one.governing.case]) for one in governing} | _keys_of_fatigue(read, cases)
    criteria, now = [one.criterion for one in governing], max(one.governing.utilisation for one in governing)
    number, most = itertools.count(1), most_tried(changes)

    @cache
    def tried(way, i):
        step(next(number), most, changes[way][i].words)
        place = folder / f"{way.replace(' ', '_')}_{i + 1}"
        return _tried(read, way, changes[way][i], criteria, keys, others, paths, place)

    best = [_smallest(partial(tried, way), len(changes[way]), now) for way in changes]
    return Advice(tuple(changes), tuple(one for one in best if one is not None), beyond)


def most_tried(changes):
    """Largest number of the changes of `ways` that the search runs: in doubling steps, then between two of them"""
    return sum(min(len(one), 2 * len(one).bit_length()) for one in changes.values())


def _keys_of_fatigue(read, cases):
    """Keys of the cases over which damage is summed: all with a share of the time"""
    if read.project.fatigue is None:
        return set()
    tired = {state.name for state in read.project.states if state.share}
    return {key_of(case) for case in cases.values() if case.state in tired and not case.lost}


def after_lines_move(advice, ran):
    """An Advice that begins with static lines, if Ran of a design have them, since larger sizes and more pretension do
    not prevent their snaps
    """
    left = [
        line for one in ran if one.numbers is not None for line in one.numbers.warnings if line.startswith(OF_LINES)
    ]
    if not (left and advice.tried):
        return advice
    first = f"This advice was computed with static lines ({left[0]}). Run the lines in motion first."
    return advice._replace(beyond=" ".join(filter(None, (first, advice.beyond))))


def _beyond(judged, cases, fixed):
    """Failed criteria that do not depend on lines, in a sentence, "" without any

    fixed : quantities that the project gives
    """
    earthquake = _shaken(judged, cases)
    if earthquake:
        return (
            f"No change of lines was tried: a limit is exceeded in “{earthquake}”, and lines do not change the "
            "effect of an earthquake on fenders and dolphins. Change the fenders or dolphins, then run the "
            "design again."
        )
    missed = [one.criterion for one in judged if one.met is False and one.criterion.quantity in fixed]
    words = ", ".join(f"{one.name}, {one.quantity} {one.sense} {one.limit:.4g}" for one in missed)
    return f"No change of lines affects {words}, since the project gives these values." if missed else ""


def _shaken(judged, cases):
    """Name of an earthquake load case that fails a criterion, "" without one"""
    apart = {case.name for case in cases if case.apart}
    return next((use.case for one in judged for use in one.uses if use.case in apart and use.utilisation > 1), "")


def _smallest(run, count, now):
    """The Tried of the smallest sufficient change, else the best, None if none is better than `now`

    run : number of the change → Tried, None for an impossible layout
    """
    failed, i, tried = -1, 0, []
    while i < count:
        one = run(i)
        tried.append(one)
        if one is not None and one.passes:
            break
        if i == 0 and one is not None and one.utilisation >= now:  # the way leads nowhere
            return None
        failed, i = i, i + 1 if i == count - 1 else min(2 * i + 1, count - 1)
    else:
        better = [one for one in tried if one is not None and one.utilisation < now]
        return min(better, key=lambda one: one.utilisation, default=None)
    low, high = failed, i
    while high - low > 1:
        middle = (low + high) // 2
        one = run(middle)
        low, high = (low, middle) if one is not None and one.passes else (middle, high)
    return run(high)


def _tried(read, way, change, criteria, keys, others, paths, folder):
    changed = msgspec.structs.replace(read, study=change.study)
    try:
        worst = _governing(changed, criteria, keys, others, paths, folder)
    except ValueError:  # beyond the line's reach, or without equilibrium: no remedy
        return None
    used = worst.governing.utilisation
    return Tried(way, change.words, used, used <= 1, worst.criterion)


def _governing(read, criteria, keys, others, paths, folder):
    """The Judged with the largest utilisation, over the cases of `keys`; the lost line is the worst of each case"""
    folder.mkdir(parents=True, exist_ok=True)
    base, factors = base_of(read, paths), factors_of(read)
    asked, names, ran = {key[:-1] for key in keys}, read.kind.lost(base), []

    def run(case):
        path = folder / f"{len(ran)}.h5"
        ran.append(Ran(case, path, *read.kind.run(case.study, paths[case.level], path, factors)))

    for case in intact_cases(read, base, repeated(read, factors)):
        if key_of(case)[:-1] in asked:
            run(case)
    for group in list(grouped(ran).values()):
        key = key_of(group[1.0].case)
        if any(other[:-1] == key[:-1] and other[-1] for other in keys):
            lost = worst_of(group[1.0], names)
            for one in group.values():
                run(without_line(read, one.case, lost))
    worn_out = fatigue(read, ran)
    found = (
        *judge(criteria, [judged_case(read, group, others) for group in grouped(ran).values()]),
        *(() if worn_out is None else (worn_out,)),
    )
    return max((one for one in found if one.governing is not None), key=lambda one: one.governing.utilisation)
