"""`hakobune sea`: a wave spectrum from parameters, a table or a record → moments, periods, heights, picture, record."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .flags import ReadingFlags, RecordFlags, SpectrumFlags


def sea(
    file: Annotated[Path | None, Parameter(help="record of waves (CSV: time_s,elevation_m) to be analysed")] = None,
    /,
    *,
    spectrum: SpectrumFlags = SpectrumFlags(),  # noqa: B008 - a frozen value
    record: RecordFlags = RecordFlags(),  # noqa: B008
    reading: ReadingFlags = ReadingFlags(),  # noqa: B008
    output: Annotated[Path | None, Parameter(help="write the spectrum to this CSV file")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute moments, periods and heights of a wave spectrum or of a record, or make a record.

    Heights in m, periods in s.  hakobune sea --height 3 --mean-period 8 --record waves.csv
    """
    from ..results.tables import printed
    from .report import write_spectrum
    from .result import refuse
    from .result import sea as found

    _check_places(file, spectrum.table, record.record, output, plot)
    if file is not None:
        refuse("a record file is given", spectrum, SpectrumFlags())
        refuse("a record file is given", record, RecordFlags(step=record.step))
        result = found(file, reading={**vars(reading), "step": record.step})
    else:
        if record.record is None:
            refuse("no --record is given", record, RecordFlags(depth=record.depth))
        made = (
            None if record.record is None else {k: v for k, v in vars(record).items() if k not in ("record", "depth")}
        )
        result = found(vars(spectrum), record=made, reading=vars(reading), depth=record.depth)
    if record.record is not None:
        _write(result.detail, record)
    if output is not None:
        write_spectrum(output, result.detail)
    if plot is not None:
        from .plot import draw

        draw(result.detail, plot)
    status = printed(result)
    written = [str(path) for path in (record.record, output, plot) if path]
    if written:
        print(f"written: {', '.join(written)}")
    return status


def _check_places(file, table, record, output, plot):
    from ..common.outputs import check_output
    from ..common.picture import PLOTS, check_picture
    from .report import is_record, is_spectrum

    paths = [Path(os.path.realpath(path)) for path in (file, table, record, output, plot) if path is not None]
    for i, path in enumerate(paths):
        if path in paths[:i]:
            raise ValueError(f"{path.name} is given as the name of two files; give each file its own name")
    check_output(record, "a record made here", is_record, (".csv",))
    check_output(output, "a spectrum written here", is_spectrum, (".csv",))
    check_picture(plot, PLOTS)


def _write(found, flags):
    from hakobune.mooring.environment.wave_records import write_record

    spectrum = found.spectrum
    comment = f"{spectrum.name} spectrum, 4 sqrt(m0) {spectrum.significant_height:.6g} m, Tp {spectrum.Tp:.6g} s"
    given = [f"{name} {value}" for name, value in vars(flags).items() if value is not None and name != "record"]
    write_record(flags.record, found.record, "\n".join([comment, *given]))
