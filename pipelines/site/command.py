"""`hakobune site`: a site's design values as one page and one file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def site(
    site: Annotated[Path, Parameter(help="site (TOML)")],
    /,
    *,
    output: Annotated[
        Path, Parameter(help=".toml with the values for studies, and a page .html of the same name; or the result, .h5")
    ],
):
    """Compute return periods, extremes, levels and seismic coefficient of a site, for a page and for studies."""
    from hakobune.meshing.whole_files import write_whole

    from ..common.outputs import DATABASE, check_output
    from ..results.output import check_result
    from ..results.tables import printed
    from .report import page, values_text, written_by_site
    from .result import site as found

    whole = output.suffix.lower() in DATABASE
    if whole:
        check_result(output, "site", [site])
    else:
        check_output(output, "values of a site", written_by_site, (".toml",), [site])
    result = found(site)
    study, text, values = result.detail
    if whole:
        result.write(output)
    else:
        write_whole(output, values_text(study, values))
        write_whole(output.with_suffix(".html"), page(study, values, text))
    status = printed(result)
    print(f"written: {output}" + ("" if whole else f", {output.with_suffix('.html')}"))
    return status
