"""Kinds of files, the commands that read each kind, and an example of each."""

import importlib
import tomllib
from functools import cache
from pathlib import Path
from typing import NamedTuple

import msgspec

SCENES = Path(__file__).parents[1] / "scenes"
SOLVED = "hakobune solve series_box_20m.toml --output box.h5"


class Kind(NamedTuple):
    """reader : "module:Struct" that reads the file; commands : that read the file; example : file in `pipelines/scenes`

    steps : commands that run the example, FILE for its name; beside : further files of `pipelines/scenes` they need
    """

    meaning: str
    reader: str
    commands: str
    example: str
    steps: tuple[str, ...]
    beside: tuple[str, ...] = ()


KINDS = {
    "scene": Kind(
        "a floating body in water and waves",
        "hakobune.pipelines.scene.scene:Scene",
        "box, buoy, ship, solve, look",
        "series_box.toml",
        ("hakobune solve FILE --output box.h5",),
    ),
    "bodies": Kind(
        "several bodies side by side, floating or fixed",
        "hakobune.pipelines.scene.scene:Scene",
        "solve, look",
        "bodies_barge_at_pier.toml",
        ("hakobune solve FILE --output bodies.h5",),
    ),
    "study": Kind(
        "a moored body: water, hull, lines, weather",
        "hakobune.pipelines.moor.study:Study",
        "moor, simulate",
        "moor_platform.toml",
        (SOLVED, "hakobune moor FILE --database box.h5 --output moor.h5"),
        ("series_box_20m.toml",),
    ),
    "simulation": Kind(
        "a moored body, simulated in time",
        "hakobune.pipelines.moor.study:Study",
        "simulate",
        "simulate_chain_12.toml",
        (SOLVED, "hakobune simulate FILE --database box.h5 --output run.h5"),
        ("series_box_20m.toml",),
    ),
    "ship": Kind(
        "a ship by its block coefficient in water and waves",
        "hakobune.pipelines.scene.scene:Scene",
        "ship, solve, look",
        "ship_tanker.toml",
        ("hakobune solve FILE --output tanker.h5",),
    ),
    "side_by_side": Kind(
        "bodies moored to each other, in time",
        "hakobune.pipelines.moor.study:Study",
        "simulate",
        "simulate_side_by_side.toml",
        (
            "hakobune solve bodies_side_by_side.toml --output side_by_side.h5",
            "hakobune simulate FILE --database side_by_side.h5 --output run.h5",
        ),
        ("bodies_side_by_side.toml",),
    ),
    "bridge": Kind(
        "pontoons hinged to each other, in time",
        "hakobune.pipelines.moor.study:Study",
        "moor, simulate",
        "simulate_bridge.toml",
        (
            "hakobune solve bodies_bridge.toml --output bridge.h5",
            "hakobune simulate FILE --database bridge.h5 --output bridge_run.h5",
        ),
        ("bodies_bridge.toml",),
    ),
    "terminal": Kind(
        "a tanker at a floating terminal while a ship passes, in time",
        "hakobune.pipelines.moor.study:Study",
        "simulate",
        "simulate_terminal.toml",
        (
            "hakobune solve bodies_terminal.toml --output terminal.h5",
            "hakobune passing passing_terminal_tanker.toml --forces passing_tanker.csv",
            "hakobune passing passing_terminal_terminal.toml --forces passing_terminal.csv",
            "hakobune simulate FILE --database terminal.h5 --output terminal_run.h5",
        ),
        ("bodies_terminal.toml", "passing_terminal_tanker.toml", "passing_terminal_terminal.toml"),
    ),
    "response": Kind(
        "a free body in a sea or a climate",
        "hakobune.pipelines.response.study:ResponseStudy",
        "response",
        "response_box_20m.toml",
        (SOLVED, "hakobune response FILE --database box.h5"),
        ("series_box_20m.toml",),
    ),
    "downtime": Kind(
        "downtime of operations at a berth, from years of weather",
        "hakobune.pipelines.downtime.tables:DowntimeStudy",
        "downtime",
        "downtime_box_20m.toml",
        (SOLVED, "hakobune downtime FILE --database box.h5 --page downtime.html"),
        ("series_box_20m.toml", "downtime_hindcast.csv"),
    ),
    "system": Kind(
        "lines between bodies, anchors and free points",
        "hakobune.pipelines.lines.system_file:SystemTable",
        "lines",
        "lines_barge.toml",
        ("hakobune lines FILE",),
    ),
    "line-dynamics": Kind(
        "one line in motion",
        "hakobune.pipelines.line_dynamics.study:LineDynamicsStudy",
        "line-dynamics",
        "line_chain_60m.toml",
        ("hakobune line-dynamics FILE",),
    ),
    "single-point": Kind(
        "a hull on a buoy or turret",
        "hakobune.pipelines.single_point.tables:Study",
        "single-point",
        "single_point_A.toml",
        ("hakobune single-point FILE",),
    ),
    "single-point-tanker": Kind(
        "a tanker on a buoy (CALM), with generic coefficients of wind and current",
        "hakobune.pipelines.single_point.tables:Study",
        "single-point",
        "single_point_tanker.toml",
        ("hakobune single-point FILE",),
    ),
    "berth": Kind(
        "a berthing ship and its fenders",
        "hakobune.pipelines.berth.study:BerthStudy",
        "berth",
        "berth_tanker.toml",
        ("hakobune berth FILE",),
    ),
    "earthquake": Kind(
        "a body between dolphins while the ground moves",
        "hakobune.pipelines.earthquake.study:EarthquakeStudy",
        "earthquake",
        "earthquake_box.toml",
        ("hakobune earthquake FILE",),
    ),
    "members": Kind(
        "slender members in waves, current and wind",
        "hakobune.pipelines.members.study:MembersStudy",
        "members",
        "members_dolphin.toml",
        ("hakobune members FILE",),
    ),
    "passing": Kind(
        "a ship that passes a moored one",
        "hakobune.pipelines.passing.study:PassingStudy",
        "passing",
        "passing_tanker.toml",
        ("hakobune passing FILE --plot passing.png",),
    ),
    "sections": Kind(
        "sections side by side in beam waves, free or hinged",
        "hakobune.pipelines.sections.study:SectionsStudy",
        "sections",
        "sections_hinged.toml",
        ("hakobune sections FILE",),
    ),
    "breakwater": Kind(
        "a taut-moored floating breakwater",
        "hakobune.pipelines.breakwater.tables:BreakwaterStudy",
        "breakwater",
        "breakwater_circle.toml",
        ("hakobune breakwater FILE",),
    ),
    "sweep": Kind(
        "many cases of one study",
        "hakobune.pipelines.sweep.study:SweepTable",
        "sweep",
        "sweep_berth.toml",
        ("hakobune sweep FILE --output sweep.h5",),
    ),
    "site": Kind(
        "design values of a site: yearly maxima, levels, earthquake",
        "hakobune.pipelines.site.study:SiteStudy",
        "site",
        "site_bay.toml",
        ("hakobune site FILE --output bay_values.toml",),
    ),
    "design": Kind(
        "a site, its weather and the rules that judge a mooring",
        "hakobune.pipelines.design.tables:Project",
        "design",
        "design_chain_12.toml",
        ("hakobune design FILE --output design",),
    ),
    "jetty": Kind(
        "a ship at a jetty: ropes, fenders, and limits of its motions for loading",
        "hakobune.pipelines.design.tables:Project",
        "design",
        "design_tanker_berth.toml",
        (
            "hakobune solve ship_tanker.toml --output tanker.h5",
            "hakobune simulate simulate_tanker_berth.toml --database tanker.h5 --output berth.h5",
            "hakobune design FILE --output report",
        ),
    ),
}


def kind_named(name):
    """A Kind by its own name or by the name of a command that reads it.  Raises ValueError."""
    if name in KINDS:
        return KINDS[name]
    found = [kind for kind in KINDS.values() if name in kind.commands.split(", ")]
    if not found:
        raise ValueError(f"there are no files of kind {name!r}; allowed: {', '.join(KINDS)}, or a command")
    return found[0]


def struct_of(name):
    """The msgspec.Struct that reads a kind of file"""
    module, _, struct = kind_named(name).reader.partition(":")
    return getattr(importlib.import_module(module), struct)


def that_read(raw):
    """["hakobune moor", …], commands that can read a file with the given nested dictionaries"""
    found = {}
    for name, kind in KINDS.items():
        try:
            msgspec.convert(raw, struct_of(name))
        except msgspec.ValidationError:
            continue
        found.update(dict.fromkeys(kind.commands.split(", ")))
    return [f"hakobune {command}" for command in found]


@cache
def examples_of(name):
    """{path of a key: value} in the shipped files of a kind, the kind's own example first"""
    struct, values = struct_of(name), {}
    first = SCENES / kind_named(name).example
    for path in (first, *sorted(SCENES.glob("*.toml"))):
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
        try:
            msgspec.convert(raw, struct)
        except msgspec.ValidationError:
            continue
        _collect(raw, struct, "", values)
    return values


def _collect(raw, struct, path, values):
    for key, value in raw.items():
        place = f"{path}.{key}"
        # names chosen by the user are listed under the key that contains them
        for inner in value if isinstance(value, list) else [value]:
            if isinstance(inner, dict):
                _collect(inner, struct, place.lstrip("."), values)
                for named in inner.values():
                    if isinstance(named, dict):
                        _collect(named, struct, f"{place}.NAME".lstrip("."), values)
        values.setdefault(place if path else f".{key}", value)
