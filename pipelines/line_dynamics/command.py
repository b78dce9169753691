"""`hakobune line-dynamics`: one line with a moving fairlead → tensions, slack, work, regime, and its statics."""

from __future__ import annotations

import math
import sys
import time
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..common.progress import duration as spoken

EVERY = 2.0  # s between two lines of progress


def line_dynamics(
    study: Annotated[Path, Parameter(help="a line in motion (TOML)")],
    /,
    *,
    duration: Annotated[float | None, Parameter(help="duration of the run, s, in place of the study's")] = None,
    tolerance: Annotated[
        float | None, Parameter(help="largest error of a time step, as a fraction of the largest tension")
    ] = None,
    output: Annotated[Path | None, Parameter(help="time series and frames, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="tensions and shapes: .png, .svg or .pdf")] = None,
):
    """Compute tension, slack and work of one mooring line whose fairlead moves, beside its quasi-static tension."""
    from ..executors.beside import begin_beside

    begin_beside("line-dynamics", "mooring/lines/dynamics/lumped/esdirk.py", study)
    from ..common.picture import PLOTS, check_picture
    from ..printing.console import new_console
    from ..results.output import check_result, write_result
    from ..results.tables import printed
    from .result import line_dynamics

    check_picture(plot, PLOTS)
    check_result(output, "line-dynamics", [study])
    console = new_console()
    try:
        result = line_dynamics(
            study, duration=duration, tolerance=tolerance, progress=lambda until: Progress(console, until)
        )
    except KeyboardInterrupt:
        print("hakobune line-dynamics: interrupted; nothing was written", file=sys.stderr)
        return 130
    if output is not None:
        write_result(result, output)
    if plot is not None:
        from .picture import draw_run

        draw_run(plot, *result.detail)
    status = printed(result, console)
    for path in (path for path in (output, plot) if path is not None):
        console.print(f"written: {path}", highlight=False, soft_wrap=True)
    return status


class Progress:
    """Prints the progress of a run, every two seconds; later runs over the same time are its checks."""

    CHECKS = "", "with fewer elements: ", "with longer steps: "

    def __init__(self, console, until):
        self.console, self.until, self.reached, self.run = console, until, math.inf, -1
        self.begin, self.started = 0.0, time.perf_counter()
        self.printed = self.started

    def __call__(self, reached):
        now = time.perf_counter()
        if reached < self.reached:  # the clock starts here, after the compilation of kernels
            self.run += 1
            self.begin, self.started = reached, now
        elif now - self.printed >= EVERY and reached < self.until:
            left = spoken((now - self.started) * (self.until - reached) / (reached - self.begin))
            self.console.print(
                f"{self.CHECKS[self.run]}{reached:.4g} of {self.until:g} s, {left} left", highlight=False
            )
            self.printed = now
        self.reached = reached
