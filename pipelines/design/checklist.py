"""Requirements on a simulation of a mooring, according to the rules compared in the SR179 report (1982), chapter 4.

The list follows the report's comparison of rules. It has a hull in three dimensions, lines and fenders with their
complete characteristics, directional spectra, gusts, a steady current, slow drift in finite depth, and earthquakes.
"""

import re
import tomllib
from typing import NamedTuple

CHOSEN = re.compile(r'qtf = "auto" uses ([a-z-]+)')  # in a finding of a simulation


class Requirement(NamedTuple):
    """text : the requirement; met : True, False, or None where the requirement does not apply; how : how the
    requirement is met"""

    text: str
    met: bool | None
    how: str


def checklist(read, ran=()):
    """[Requirement] for a Read project and its Ran cases; [] for a kind of study that the project does not simulate"""
    if not read.kind.MOVED:
        return []
    in_time = read.project.simulation is not None
    weather, pairs = read.project.states, read.project.simulation.qtf if in_time else ""
    beyond, said = _pairs(pairs, ran)
    return [
        Requirement("the hull in three dimensions", True, "potential theory in three dimensions and finite depth"),
        Requirement("lines with their full tension–distance curve", True, IN_MOTION if in_time else STATIC),
        _fenders(read),
        _directions(weather, in_time),
        _gusts(weather, in_time),
        Requirement("the current is steady", True, "uniform and steady, with the drag of the depth"),
        Requirement(
            "slowly varying drift for the water depth", in_time,
            "Newman's approximation with the drift for this water depth"
            f"{', with forces of wave pairs beside it in the next row' * beyond}"
            if in_time else "the simplified method includes the mean drift only",
        ),
        Requirement(
            "long bound waves in shallow water", in_time and beyond, said if in_time else "not in the simplified method"
        ),
        _earthquakes(read),
    ]  # fmt: skip


STATIC = "static shape of every line at every position"
IN_MOTION = f"{STATIC}, or a motion of its own where dynamic_lines or its trial requires it"


def _pairs(pairs, ran):
    """Whether forces of wave pairs beyond Newman's approximation are in all cases, and words on them

    With "auto" the findings of the runs have what was used.
    """
    if pairs != "auto":
        more = '; give "bound-wave" or "body" where second-order forces matter' if pairs == "newman" else ""
        return pairs != "newman", f'simulation.qtf is "{pairs}"{more}'
    texts = ["\n".join(one.numbers.warnings) for one in ran if one.numbers is not None and not one.case.apart]
    used = [set(CHOSEN.findall(text)) or {"newman"} for text in texts]
    newman = sum("newman" in one for one in used)
    named = ", ".join(sorted(set().union(*used))) or "newman"
    more = f" in {newman} of {len(used)} cases" if 0 < newman < len(used) else ""
    return bool(used) and not newman, f'simulation.qtf is "auto", which used {named}' + (
        f" (newman{more}); section 7 has the reason" if more else "; section 7 has the reason" * bool(newman)
    )


def _earthquakes(read):
    text = "earthquakes as random motion"
    if "fender" not in read.study:
        return Requirement(text, None, "lines leave the hull with long natural periods")
    given = [table.name for table in read.project.earthquakes]
    if not given:
        return Requirement(text, None, "no earthquake is a load case; give [[earthquakes]] where the site has them")
    timed = [table.name for table in read.project.earthquakes if "record" in _raw(read.folder / table.study)]
    if not timed:
        return Requirement(text, False, f"earthquake {', '.join(given)} has no time record; give [record] in its study")
    return Requirement(text, True, f"records of {', '.join(timed)}")


def _raw(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def _fenders(read):
    if read.study.get("fender"):
        return Requirement("fenders with their full force–deflection curve and clearance", True, "curves of [[fender]]")
    return Requirement("fenders with their full force–deflection curve and clearance", None, "there are none")


def _directions(states, in_time):
    text = "waves of random phase from a directional spectrum"
    waves = [state.waves for state in states if state.waves is not None]
    if not waves:
        return Requirement(text, None, "there are no waves")
    if not in_time:
        return Requirement(text, False, "a single regular wave of the significant height is used; give [simulation]")
    long = [state.name for state in states if state.waves is not None and state.waves.spreading is None]
    if long:
        return Requirement(text, False, f"long-crested waves in {', '.join(long)}; give waves.spreading")
    return Requirement(text, True, "waves.spreading of every state")


def _gusts(states, in_time):
    text = "the wind varies as a random process"
    windy = [state for state in states if state.wind is not None]
    if not windy:
        return Requirement(text, None, "there is no wind")
    steady = [state.name for state in windy if state.wind.gusts is None]
    if steady or not in_time:
        how = f"steady in {', '.join(steady)}; give wind.gusts" if steady else "steady in the simplified method"
        return Requirement(text, False, how)
    return Requirement(text, True, "wind.gusts of every state")
