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
    from meshing.whole_files import write_whole

    write_whole(output, values_text(study, values))
    write_whole(output.with_suffix(".html"), page(study, values, text))
    show = new_console().print
    show(f"return period {values.years:.4g} years", highlight=False)
    for name, state in values.states.items():
        parts = [f"{key} {', '.join(f'{n} {v:.4g}' for n, v in table.items())}" for key, table in state.items()]
        show(f"{name}: {'; '.join(parts)}", highlight=False, soft_wrap=True)
    for text in values.findings:
        show(text, highlight=False, soft_wrap=True, style="yellow")
    show(f"written: {output}, {output.with_suffix('.html')}", highlight=False, soft_wrap=True)
    return 0
