"""Water and weather of a study from the values of a site (`hakobune site`), by its table [site].

    [site]
    file = "bay_values.toml"
    state = "extreme"          # wind, current and waves of the study then need directions alone
    level = "high"             # name of the level; by default mean water
    leave_out = ["current"]    # part of the state

A value may be given only once: a value in both study and site is refused.  The resulting study contains all numbers of
the site, so that a stored result shows them, and a change of site changes the study.
"""

from typing import NamedTuple

import msgspec

from ..common.fender_tables import with_tables_in
from ..common.quantities import StudyError, Table
from ..common.typed import read_toml, typed

STREAMS, SEA = ("wind", "current"), "waves"
MEAN = "mean"


class SiteLink(Table):
    """Link to site values written by `hakobune site`

    file : file of the values, beside this file
    state : name of the state of weather that is used; by default none
    level : name of the water level that is used
    leave_out : parts of the state that are not used: "wind", "current", "waves"
    """

    file: str
    state: str | None = None
    level: str = MEAN
    leave_out: list[str] = msgspec.field(default_factory=list)


class Taken(NamedTuple):
    """Values that a kind of study takes from a site, and their places in its tables.

    depth : path of the study's water depth, () if the database gives the water; states : {key of a state: its table}
    period : the study's key for the mean wave period; ways : whether the study must contain the table of a state,
        which then gives its direction
    coefficient : path of the seismic coefficient, () if the study has none
    """

    depth: tuple = ("water", "depth")
    states: dict = {"wind": "wind", "current": "current", "waves": "waves"}  # noqa: RUF012
    period: str = "period"
    ways: bool = True
    coefficient: tuple = ()


MOORED = Taken()
RESPONSE = Taken((), {"waves": "sea"}, "mean_period")
BREAKWATER = Taken(states={"waves": "sea"}, period="mean_period", ways=False)
BERTHING = Taken(("depth",), {})
EARTHQUAKE = Taken((), {}, coefficient=("coefficient",))


class Linked(Table):
    """A file with [site]"""

    site: SiteLink


class _SiteFile(msgspec.Struct):
    """The part of the file that is read here"""

    water: dict[str, float]
    states: dict[str, dict[str, dict[str, float]]]
    site: dict = msgspec.field(default_factory=dict)
    levels: dict[str, float] = msgspec.field(default_factory=dict)
    earthquake: dict = msgspec.field(default_factory=dict)


def read_study_at_site(path, what, taken=MOORED):
    """Nested dictionaries and text of a study (TOML), with the values of its [site].

    Fender tables next to the study have full paths in the dictionaries, not in the text.
    raises : StudyError if the site lacks a value, or if study and site give the same value
    """
    raw, text = _laid(path, what, taken)
    return with_tables_in(raw, path.parent), text


def _laid(path, what, taken):
    raw, text = read_toml(path, what, StudyError)
    if "site" not in raw:
        return raw, text
    import tomli_w

    link = _link(raw)
    values = site_file(path.parent / link.file)
    laid = {key: value for key, value in raw.items() if key != "site"}
    if taken.depth:
        _lay(laid, taken.depth, _depth(link, values))
    elif link.level != MEAN:
        raise StudyError(
            f"site.level is {link.level!r}, but {what} does not use the water level of a site; leave it out"
        )
    if taken.coefficient:
        if "coefficient" not in values.earthquake:
            raise StudyError(
                "the file of the site has no seismic coefficient; give [earthquake] in the study of hakobune site"
            )
        _lay(laid, taken.coefficient, values.earthquake["coefficient"])
    for key, table in _state(link, values, taken, what).items():
        name = taken.states[key]
        given = {taken.period if inner == "period" else inner: value for inner, value in table.items()}
        if name not in laid and taken.ways:
            raise StudyError(
                f"{name} of the site's state {link.state!r} has no direction; give [{name}] with incidence_deg, "
                f'or site.leave_out = ["{key}"]'
            )
        laid[name] = laid_in(name, laid.get(name, {}), given)
    return laid, f"# {path.name} with state {link.state!r}, level {link.level!r} of {link.file}\n{tomli_w.dumps(laid)}"


def _state(link, values, taken, what):
    """Tables of the state that a study uses.  Raises StudyError."""
    if link.state is None:
        return {}
    if not taken.states:
        raise StudyError(f"site.state is {link.state!r}, but {what} does not use the weather of a site; leave it out")
    found = named("site.state", link.state, values.states)
    return {key: table for key, table in found.items() if key in taken.states and key not in link.leave_out}


def _lay(laid, path, value):
    """Put a value of a site into a study at (table, …, key).  Raises StudyError if the key exists."""
    if len(path) == 1:
        if path[0] in laid:
            raise StudyError(f"{path[0]} is given by the study and by its site; leave out one of the two")
        laid[path[0]] = value
        return
    laid[path[0]] = laid_in(path[0], laid.get(path[0], {}), {path[1]: value})


def site_file(path):
    """Values of a site from its file.  Raises StudyError."""
    raw, _ = read_toml(path, "values of a site", StudyError)
    try:
        return msgspec.convert(raw, _SiteFile)
    except msgspec.ValidationError as fault:
        raise StudyError(f"{path} is not a file of hakobune site: {fault}") from None


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
    """values[name].  Raises StudyError with the known names."""
    if name not in values:
        raise StudyError(f"{key} is {name!r}; allowed: {', '.join(values)}")
    return values[name]


def laid_in(name, own, given):
    """The table `own` with the values of the site.  Raises StudyError for a key in both."""
    twice = [key for key in given if key in own or f"{key}_knots" in own]
    if twice:
        raise StudyError(f"{name}.{twice[0]} is given by the study and by its site; leave out one of the two")
    return {**given, **own}
