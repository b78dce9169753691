"""`hakobune line-dynamics`: one line with a moving fairlead → tensions, slack, work, regime, and its statics."""

import sys
import time

import numpy as np

from ..common.picture import PLOTS, check_picture
from ..common.progress import duration as spoken
from ..results.output import check_result, write_result
from ..results.tables import printed
from .result import line_dynamics

EVERY = 2.0  # s between two lines of progress


def line_dynamics_command(file, duration, tolerance, output, picture):
    """Run the line of a study.  Returns the exit status; raises ValueError, one line."""
    from ..printing.console import new_console

    check_picture(picture, PLOTS)
    check_result(output, "line-dynamics", [file])
    console = new_console()
    try:
        result = line_dynamics(
            file, duration=duration, tolerance=tolerance, progress=lambda until: Progress(console, until)
        )
    except KeyboardInterrupt:
        print("hakobune line-dynamics: interrupted; nothing was written", file=sys.stderr)
        return 130
    if output is not None:
        write_result(result, output)
    if picture is not None:
        from .picture import draw_run

        draw_run(picture, *result.detail)
    status = printed(result, console)
    for path in (path for path in (output, picture) if path is not None):
        console.print(f"written: {path}", highlight=False, soft_wrap=True)
    return status


class Progress:
    """Prints the progress of a run, every two seconds; later runs over the same time are its checks."""

    CHECKS = "", "with fewer elements: ", "with longer steps: "

    def __init__(self, console, until):
        self.console, self.until, self.reached, self.run = console, until, np.inf, -1
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
