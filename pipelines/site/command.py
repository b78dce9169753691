"""`hakobune site`: a site's design values as one page and one file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def site(
    site: Annotated[Path, Parameter(help="site (TOML)")],
    /,
    *,
    output: Annotated[Path, Parameter(help=".toml of the values; the page stands beside it as .html")],
):
    """Return period, extremes, levels and seismic coefficient of a site, as one page and one file for studies."""
    from ..common.outputs import check_output
    from ..printing.console import new_console
    from .report import page, values_text, written_by_site
    from .study import read_site, site_values

    check_output(output, "values of a site", written_by_site, (".toml",), [site])
    study, text = read_site(site)
    values = site_values(study, site.parent)
    from hakobune.meshing.whole_files import write_whole

    write_whole(output, values_text(study, values))
    write_whole(output.with_suffix(".html"), page(study, values, text))
    show = new_console().print
    show(_table(values))
    for text in values.findings:
        show(text, highlight=False, soft_wrap=True, style="yellow")
    show(f"written: {output}, {output.with_suffix('.html')}", highlight=False, soft_wrap=True)
    return 0


def _table(values):
    """Return period and values of each state, in the units of the file that studies read"""
    from ..printing.number import values_table

    rows = [("return period", values.years, "years", "")]
    rows += [(f"{kind} water level", level, "m", "above still water") for kind, level in values.levels.items()]
    for state, tables in values.states.items():
        for table, numbers in tables.items():
            rows += [(f"{table} {name}", value, _unit(name), state) for name, value in numbers.items()]
    return values_table("values of the site", rows)


def _unit(key):
    """Of a key of a state: lengths in m, speeds in m/s, periods in s"""
    if key.endswith("_deg"):
        return "°"
    return "m/s" if "speed" in key else "s" if "period" in key else "m" if key == "height" else ""
