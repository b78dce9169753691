"""The page of a downtime study: results in words, tables and pictures; without external files."""

import html
from functools import partial
from importlib.resources import files
from pathlib import Path

from hakobune.bem import __version__

from ..common.picture import data_address
from ..results.frames import as_html
from . import pictures

MARK = "<!-- hakobune downtime -->"


def written_by_downtime(path):
    """Whether a file is a page that `hakobune downtime` wrote and may therefore replace"""
    return Path(path).read_text(encoding="utf-8", errors="replace").startswith(MARK)


def page_of(result, text):
    """The page (HTML) of a Result of downtime; text : text of its study"""
    from jinja2 import Environment, StrictUndefined

    template = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    return MARK + "\n" + environment.from_string(template).render(
        verdicts=list(map(partial(_verdict, result), range(len(result.labels["operation"].values)))),
        pictures=list(_pictures(result)), notes=result.notes, findings=result.told, tables=as_html(result),
        text=text, version=__version__, title=html.escape(result.detail.study.hindcast.file),
    )  # fmt: skip


def _verdict(result, number):
    """A line on an operation: hours, share, interval, the most frequent cause"""
    name, at = result.labels["operation"].values[number], result["downtime.hours"][number]
    low, high = result["downtime.hours_low"][number], result["downtime.hours_high"][number]
    between = f", 90 % interval {low:.4g} to {high:.4g} h" if low == low else ""
    hours = f"{at:.4g}" if low == low else f"{float(f'{at:.2g}'):g}"  # of too few years for an interval
    own = [i for i, one in enumerate(result.detail.limits) if one.operation == number]
    worst = max(own, key=lambda i: result["cause.hours"][i])
    label = result.labels["limit"].values[worst].removeprefix(f"{name}: ")
    share = 100 * result["downtime.share"][number]
    cause = f"; the main cause is {label} with {result['cause.hours'][worst]:.4g} h" if at > 0 else ""
    return {"name": name, "text": f"is down {hours} h a year, {share:.3g} % of the time{between}{cause}."}


def _pictures(result):
    for panel, words, polar in (
        (pictures.months, "downtime by month", False), (pictures.years, "downtime by year", False),
        (pictures.rose, "rose of downtime", True), (pictures.persistence, "weather windows", False),
        (pictures.waits, "waiting times", False),
    ):  # fmt: skip
        yield {"words": words, "data": data_address(partial(_drawn, panel, result, polar))}
    for number in pictures.limited(result):
        name = result.labels["operation"].values[number]

        def panel(found, axes, number=number):
            pictures.limiting(found, number, axes)

        yield {"words": f"limiting sea of {name}", "data": data_address(partial(_drawn, panel, result, True))}


def _drawn(panel, result, polar, path):
    pictures.one_panel(panel, result, path, polar)
