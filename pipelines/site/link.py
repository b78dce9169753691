"""Water and weather of a study from the values of a site (`hakobune site`), by its table [site].

    [site]
    file = "bay_values.toml"
    state = "extreme"          # wind, current and waves of the study then need directions alone
    level = "high"             # by default mean water
    leave_out = ["current"]    # of the state

A value has one source: one that study and site both give is a fault.  What a study becomes holds all numbers of the
site, so that a result kept with its study says them, and another site is another study.
"""

from __future__ import annotations

import msgspec

from ..common.quantities import StudyError, Table
from ..common.typed import read_toml, typed

STREAMS, SEA = ("wind", "current"), "waves"
MEAN = "mean"


class SiteLink(Table):
    """Values of a site, by `hakobune site`, that the study stands in

    file : of the values, beside this file
    state : of weather there
    level : of the water there
    leave_out : of wind, current and waves
    """

    file: str
    state: str | None = None
    level: str = MEAN
    leave_out: list[str] = msgspec.field(default_factory=list)


class Linked(Table):
    """A file with [site]"""

    site: SiteLink


class _SiteFile(msgspec.Struct):
    """What of the file is read here"""

    water: dict[str, float]
    states: dict[str, dict[str, dict[str, float]]]
    site: dict = msgspec.field(default_factory=dict)
    levels: dict[str, float] = msgspec.field(default_factory=dict)


def read_study_at_site(path, what, waves="waves", period="period"):
    """Nested dictionaries and text of a study (TOML), water and weather of its [site] laid in.

    waves, period : the study's names of its table of waves and of the mean period there; where the waves are not
    "waves", the water is that of a database and is not laid in.
    raises : StudyError where the site lacks what is asked for, or study and site give the same
    """
    raw, text = read_toml(path, what, StudyError)
    if "site" not in raw:
        return raw, text
    import tomli_w

    link = _link(raw)
    values = site_file(path.parent / link.file)
    laid = {key: value for key, value in raw.items() if key != "site"}
    if waves == SEA:
        laid["water"] = laid_in("water", laid.get("water", {}), {"depth": _depth(link, values)})
    state = {} if link.state is None else named("site.state", link.state, values.states)
    for key, table in state.items():
        if key in link.leave_out:
            continue
        name = waves if key == SEA else key
        if key in STREAMS and waves != SEA:
            continue
        given = {period if inner == "period" else inner: value for inner, value in table.items()}
        if name not in laid:
            raise StudyError(
                f"{name} of the site's state {link.state!r} has no direction; give [{name}] with incidence_deg, "
                f'or site.leave_out = ["{key}"]'
            )
        laid[name] = laid_in(name, laid[name], given)
    return laid, f"# {path.name} with state {link.state!r}, level {link.level!r} of {link.file}\n{tomli_w.dumps(laid)}"


def site_file(path):
    """Values of a site from its file.  Raises StudyError."""
    raw, _ = read_toml(path, "values of a site", StudyError)
    try:
        return msgspec.convert(raw, _SiteFile)
    except msgspec.ValidationError as fault:
        raise StudyError(f"{path} is no file of hakobune site: {fault}") from None


def _link(raw):
    """The SiteLink of a study.  Raises StudyError."""
    link = typed({"site": raw["site"]}, Linked, StudyError).site
    for i, key in enumerate(link.leave_out):
        if key not in (*STREAMS, SEA):
            raise StudyError(f"site.leave_out[{i}] is {key!r}; allowed: {', '.join((*STREAMS, SEA))}")
    return link


def _depth(link, values):
    above = 0.0 if link.level == MEAN else named("site.level", link.level, values.levels)
    return values.water["depth"] + above


def named(key, name, values):
    """values[name].  Raises StudyError that says which there are."""
    if name not in values:
        raise StudyError(f"{key} is {name!r}; allowed: {', '.join(values)}")
    return values[name]


def laid_in(name, own, given):
    """The table `own` with what the site gives.  Raises StudyError where both have a key."""
    twice = [key for key in given if key in own or f"{key}_knots" in own]
    if twice:
        raise StudyError(f"{name}.{twice[0]} is given by the study and by its site; leave one out")
    return {**given, **own}
