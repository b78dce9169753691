"""Words and rows of a report: verdict, states, lines, criteria, cases."""

import re
from pathlib import Path

import numpy as np

from hakobune.bem import DOFS
from hakobune.mooring.criteria.failing import FAILS as MARKED
from hakobune.mooring.criteria.rules import read_rules

from ..common.weather.seas import period_of
from ..printing.number import fixed
from .fatigue import QUANTITY as FATIGUE
from .kinds.mooring import BESIDE
from .kinds.needs import REACTION
from .kinds.numbers import Numbers
from .report_tables import CASE_HEAD, OF_PROJECT, WORDS, case_row, farthest
from .verdict import FAILS, NUMBER, OPEN

COUNTED = ("stable headings",)  # a count without a utilisation: if the criterion is met its use is 0
THE_PROJECT = "the project"  # origin of values that belong to no load case
# of a finding: "solve 0.3 to 5.9 rad/s as well", "solve from 0.3 rad/s", "solve to 5.9 rad/s"
BAND = re.compile(r"solve (?:([\d.e-]+) to ([\d.e-]+)|from ([\d.e-]+)|to ([\d.e-]+)) rad/s")
ANCHOR_SIZES = {"mass": "kg", "weight_kN": "kN in water", "holding_kN": "kN of holding", "uplift_kN": "kN of uplift"}
WAYS = {"size": "larger sizes", "number": "more lines"}  # words for ways that differ from their names
MOTIONS = tuple(dof.lower() for dof in DOFS)
MARK = {True: "passes", False: "fails", None: "open"}


def summary(verdict):
    """The governing criterion in words, which follow "the mooring passes" in the report"""
    if verdict.broken:
        more = f", and {len(verdict.broken) - 1} more" if len(verdict.broken) > 1 else ""
        return f": {verdict.broken[0].removeprefix(MARKED)}{more}"
    worst = _worst(verdict)
    if verdict.word == OPEN:
        unknown = sum(one.met is None for one in verdict.judged)
        failed = sum(one.numbers is None for one in verdict.ran)
        return f": {unknown} criteria could not be judged, {failed} load cases could not be run"
    if worst is None:
        return ""
    use, criterion = worst.governing, worst.criterion
    return (
        f": {percent(use.utilisation)} of {criterion.name}, {criterion.quantity} {criterion.sense} "
        f"{criterion.limit:.4g}, is used by {_used_by(use, criterion)}"
    )


def method_words(verdict):
    """Words on where the tensions of the load cases come from, "" for studies with one method only"""
    if any(one.runs is not None for one in verdict.ran):
        return ", in time"
    return ", simplified method" if any(len(one.numbers.motions) for one in verdict.ran if one.numbers) else ""


def _used_by(use, criterion):
    return THE_PROJECT if criterion.quantity in OF_PROJECT else f"{use.item} in “{use.case}”"


def percent(used):
    """A utilisation in words; never "100 %" for a value beyond its limit"""
    whole = f"{100 * used:.0f} %"
    return f"{100 * used:.4g} %" if (whole == "100 %" and used > 1) else whole


def advice_words(advice, verdict):
    """The advised changes, a sentence for each way that was tried; () without advice

    advice : from `advice.advise`, None where the user did not request it
    """
    if advice is None or verdict.word != FAILS:
        return ()
    beyond = (advice.beyond,) if advice.beyond else ()
    helpful = {one.way for one in advice.found}
    vain = ", ".join(WAYS.get(way, way) for way in advice.tried if way not in helpful)
    if vain and not advice.found:
        return (
            *beyond,
            f"Tried in the governing cases: {vain}. None lowers the largest utilisation. Change the layout, or "
            "the kind of line or fender.",
        )
    found = map(_tried_words, sorted(advice.found, key=lambda one: (not one.passes, one.utilisation)))
    return (
        *beyond,
        *found,
        *((f"Tried without success, since the largest utilisation does not fall: {vain}.",) if vain else ()),
    )


def _tried_words(one):
    used = f"{percent(one.utilisation)} of {one.criterion.rule}, {one.criterion.quantity}"
    if one.passes:
        return f"Passes in the governing cases: {one.words}, which uses {used}. No smaller change of this kind passes."
    return f"Not enough alone: {one.words}, the best change of its kind, still uses {used}."


def fatigue_words(verdict):
    """The life of the line that governs fatigue, one line of text; nothing where it is not judged"""
    for one in verdict.judged:
        if one.criterion.quantity == FATIGUE and one.governing is not None:
            yield f"fatigue of {one.governing.item}: {one.criterion.source}"


def _worst(verdict):
    found = [one for one in verdict.judged if one.governing is not None]
    found = [one for one in found if not one.met or one.criterion.quantity not in COUNTED] or found
    return max(found, key=lambda one: one.governing.utilisation, default=None)


def return_words(own, verdict):
    if verdict.return_period is None:
        return ""
    return (
        f"A value that is not exceeded in {own.service_life:g} years with probability {own.probability:g} has a "
        f"return period of {verdict.return_period:.0f} years."
    )


def time_words(read):
    """Simulated duration of the cases, "" without simulation"""
    own = read.project.simulation
    if own is None:
        return ""
    hours = (own.duration or 0.0) / 3600.0 if own.duration_hours is None else own.duration_hours
    count = own.seeds if isinstance(own.seeds, int) else len(own.seeds)
    often = f"once, for {hours:.3g} h" if count == 1 else f"{count} times, for {hours:.3g} h each"
    return f"Each case is simulated {often}."


def _system(waves):
    """Words on one system of waves"""
    if waves.file is not None:
        return Path(waves.file).name
    ((kind, value),) = period_of("waves", waves).items()
    return f"{waves.height:g} m, {value:g} s ({kind.replace('_', ' ')})"


def issue(own):
    """Words on the issuer and the issue number of the report"""
    given = {"for": own.client, "by": own.author, "revision": own.revision, "of": own.date}
    return ", ".join(f"{word} {value}" for word, value in given.items() if value)


def state_row(state):
    def stream(table):
        if table is None:
            return "none"
        return f"{table.speed:g} m/s" if table.speed is not None else f"{table.speed_knots:g} knots"

    waves = "none" if state.waves is None else " and ".join(_system(one) for one in (state.waves, *state.waves.swell))
    angles = ", ".join(f"{angle:g}" for angle in state.incidence_deg)
    for name, offs in (("wind", state.wind_off_deg), ("current", state.current_off_deg)):
        if offs != [0.0]:
            angles += f"; {name} off by {', '.join(f'{off:g}' for off in offs)}"
    lines = "intact and one lost" if "one lost" in state.lines else "intact"
    levels = ", ".join(state.levels)
    return state.name, state.state, stream(state.wind), stream(state.current), waves, angles, levels, lines


def line_rows(read, verdict):
    """Cells of a row in the table of lines, ropes and hawsers: properties in the first case that ran, and the largest
    tension of all cases over the breaking load and over the WLL. The WLL is the study's `allowable` times the breaking
    load.
    """
    allowable = read.study.get("allowable")
    pulled, used = {}, {}
    for case in (one for one in verdict.ran if one.numbers is not None and one.case.factor == 1):
        for name, load, breaking in zip(case.numbers.names, case.largest, case.numbers.breaking, strict=True):
            pulled[name], used[name] = max(pulled.get(name, 0.0), load), max(used.get(name, 0.0), load / breaking)
    kinds = {
        name: f"{name}: {table['catalogue']}"
        for name, table in read.study.get("types", {}).items()
        if "catalogue" in table
    }
    one: Numbers | None = next((one.numbers for one in verdict.ran if one.numbers is not None), None)
    for i, name in enumerate(() if one is None else one.names):
        yield (
            name,
            f"{one.length[i]:.4g}",
            ", ".join(kinds.get(name, name) for name in one.types[i]),
            _place(one.fairlead[i]),
            _place(one.anchor[i]),
            f"{one.pretension[i] / 1e3:.4g}",
            f"{one.breaking[i] / 1e3:.5g}" if np.isfinite(one.breaking[i]) else "not given",
            f"{pulled[name] / 1e3:.4g}",
            _used_of(used[name], one.breaking[i], allowable) if np.isfinite(one.breaking[i]) else "",
        )


def mooring_words(read):
    """Sentences on the anchors and the wear that the criteria take"""
    anchors = read.study.get("anchors", ())
    for one in anchors if isinstance(anchors, list) else ():  # a breakwater has a table of its own kind
        given = [f"{value:g} {unit}" for key, unit in ANCHOR_SIZES.items() if (value := one.get(key)) is not None]
        words = ", ".join([one["kind"], *(str(one[key]) for key in ("type", "soil") if key in one), *given])
        on = ", ".join(one.get("lines", ())) or "all lines on the bed"
        yield f"Anchors of {on}: {words}; factor of safety {one.get('safety', 1):g}."
    wear = read.project.wear
    if wear is not None:
        years = wear.years or read.project.project.service_life
        lost = f"{wear.mm_per_year:g} mm of diameter a year, {wear.mm_per_year * years:.3g} mm in {years:g} years"
        yield f"Chains are worn by {lost}."


def _used_of(used, breaking, allowable):
    if allowable is None:
        return percent(used)
    return f"{percent(used)}, {percent(used / allowable)} of WLL {allowable * breaking / 1e3:.4g} kN"


def part_table(read, verdict):
    """Head and rows (cells) of a table of results other than tensions: the worst value of each quantity, and its
    part"""
    ran = [one for one in verdict.ran if one.numbers is not None and one.numbers.parts]
    quantities = list(dict.fromkeys(quantity for one in ran for quantity in one.numbers.parts))
    least = {one.quantity for one in (*read_rules(), *read.criteria) if one.sense == "at least"}
    rows = []
    for one in ran:
        cells = []
        for quantity in quantities:
            values = one.numbers.parts.get(quantity, {})
            pick = min if quantity in least else max
            item = pick(values, key=values.get) if values else ""
            shown = [item] if quantity != REACTION and values else values  # the jetty needs it of each fender
            cells.append(", ".join(f"{values[item]:.3g} {item}" for item in shown))
        rows.append((one.case.name, cells))
    return quantities, rows


def _place(point):
    return ", ".join(f"{float(fixed(float(x), 1)):g}" for x in point)


def criterion(one, found_in):
    """Cells of a Judged; found_in : (name of a load case, criterion) → address of a number's file, and key in that
    file"""
    c, use = one.criterion, one.governing
    factors = f"{c.limit:.4g}" if c.second is None else f"{c.limit:.4g}, {c.second:.4g}"
    for_ = ", ".join(
        word
        for word, skip in ((c.state, "any"), (f"lines {c.lines}", "lines any"), (_statistic(c), ""), (c.subject, ""))
        if word != skip
    )
    unverified = "" if c.status == "read" else f" ({c.status})"
    found = {
        "words": f"{c.name}: {c.quantity} {c.sense} {factors}{'' if c.unit in ('', '-') else ' ' + c.unit}; {for_}",
        "source": f"{c.source}{unverified}",
        "limit": factors,
        "verdict": WORDS[one.met],
        "css": MARK[one.met],
        "missing": one.missing,
        "value": "",
        "used": "",
        "margin": "",
        "link": "",
        "key": "",
        "by": "",
    }
    if use is not None:
        found |= {
            "value": f"{use.value if abs(use.value) > 1e-9 * abs(c.limit) else 0:.4g}",
            "used": percent(use.utilisation),
            "margin": _margin(use.utilisation),
            "by": THE_PROJECT if c.quantity in OF_PROJECT else f"{use.case}, {use.item}",
        }
        found["link"], found["key"] = found_in(use.case, c)
    return found


def _margin(used):
    """1 less a utilisation in words; with its digits where whole percents are zero"""
    left = 100 * (1 - used)
    return f"{left:+.0f} %" if round(left) or not left else f"{left:+.1g} %"


def _statistic(c):
    """Words on the statistic of a criterion; of motions with what it is measured from"""
    if c.quantity not in MOTIONS or not c.statistic:
        return c.statistic
    return c.statistic if c.statistic == "peak to peak" else f"{c.statistic} from the mean"


def rule_set(one):
    c, use = one.criterion, one.use
    limit = f"{c.quantity} {c.sense} {c.limit:.4g}"
    unread = f"{one.unread} of them still to be checked against the printed rule" if one.unread else ""
    return {
        "cells": (one.name, one.subject, "yes" if one.chosen else "no", f"{one.judged} of {one.known}", limit),
        "used": percent(use.utilisation),
        "css": MARK[use.utilisation <= 1],
        "by": THE_PROJECT if c.quantity in OF_PROJECT else f"{use.case}, {use.item}",
        "unread": unread,
    }


def with_factor(name, factor):
    """Name of the load case with `factor` times the motions, if it is a separate case"""
    return name if factor == 1 else f"{name}, motions x {factor:g}"


def case(one, links):
    row = dict(zip(CASE_HEAD, case_row(one), strict=True))
    cells = []
    if one.numbers is not None and not one.numbers.names:
        cells = [*_place_words(row, farthest(one.numbers)[0]), *["–"] * 5]
    elif one.numbers is not None:
        share = row["of_breaking_load"]
        cells = [
            *_place_words(row, farthest(one.numbers)[0]),
            f"{row['largest_tension_N'] / 1e3:.4g}",
            row["line"],
            "not given" if np.isnan(share) else percent(share),
            f"{row['horizontal_at_anchor_N'] / 1e3:.4g}",
            f"{max(row['uplift_at_anchor_N'], 0.0) / 1e3 + 0.0:.4g}",
        ]
    return {"name": one.case.name, "link": links[one.case.name], "fault": one.fault, "cells": cells}


def motion_rows(verdict):
    """Return (name of a case, its six largest motions from the mean, m and degrees) for each case with motions, and for
    each of several bodies"""
    for one in verdict.ran:
        if one.numbers is not None:
            found = one.numbers.motions if one.runs is None else one.runs["motions"]
            bodies = one.numbers.bodies or [""]
            for body, each in zip(bodies, np.reshape(found, (-1, 6)), strict=False):
                name = f"{one.case.name}: {body}" if body else one.case.name
                yield name, [f"{value:.3g}" for value in each * ([1.0] * 3 + [180 / np.pi] * 3)]


def _place_words(row, body=""):
    """Offset, yaw and excursion of a row of cases, dashes for a method without them; body : name of the one of several
    that they are of"""
    words = [fixed(value) for value in (np.hypot(row["x_m"], row["y_m"]), row["yaw_deg"], row["excursion_m"])]
    return [f"{words[0]} {body}".strip(), *words[1:]]


def warnings(verdict):
    """Findings of the cases; of findings that differ only in numbers and names of lines, the one with the largest first
    number; those of the simplified method beside runs in time are marked, without what the runs say too"""
    found = {}
    for one in verdict.ran:
        for text in one.numbers.warnings if one.numbers else ():
            found.setdefault(_alike(text, one.numbers.names), []).append((text, one.case.name))
    for key, group in found.items():
        if key.startswith(BESIDE) and key.removeprefix(BESIDE) in found:
            continue
        text, name = max(group, key=lambda pair: float((NUMBER.search(pair[0]) or "0")[0]))
        own = ", each with its own numbers" if len({pair[0] for pair in group}) > 1 else ""
        more = f"; likewise{own}, in {len(group) - 1} more case{'s' * (len(group) > 2)}" if len(group) > 1 else ""
        yield {"text": text.removeprefix(BESIDE), "cases": f"{name}{more}", "aside": key.startswith(BESIDE)}


def _alike(text, names):
    """A finding without its numbers and names of lines"""
    for name in sorted(names, key=len, reverse=True):
        text = text.replace(name, "@")
    return NUMBER.sub("#", text)


def band(verdict):
    """Words on the band of frequencies that serves every load case, "" where no finding asks for a longer one"""
    asked = []
    for one in verdict.ran:
        for text in (*(one.numbers.warnings if one.numbers else ()), one.fault or ""):
            asked += [(low or low_alone, high or high_alone) for low, high, low_alone, high_alone in BAND.findall(text)]
    lows, highs = (
        ([float(value) for value in each if value] for each in zip(*asked, strict=True)) if asked else ([], [])
    )
    parts = [f"{word} {pick(values):.4g}" for word, pick, values in (("from", min, lows), ("to", max, highs)) if values]
    return f"One band of frequencies serves all load cases: solve {' '.join(parts)} rad/s." if parts else ""
