"""`hakobune stress`: random scenes over the whole range, tested against laws, failures with their command."""

import math
import sys
from pathlib import Path
from typing import Annotated

from ...common.bounds import check_seconds, whole_number
from ...scene.flags import _flag


def stress(
    *,
    scenes: Annotated[str, _flag("how many")] = "10000",
    seed: Annotated[str, _flag("of the draws; the same seed gives the same scenes")] = "1",
    first: Annotated[str, _flag("number of the first scene")] = "0",
    method: Annotated[str, _flag("auto, panel or contour")] = "auto",
    tolerance: Annotated[float, _flag("relative error that each scene asks for")] = 0.05,
    waves: Annotated[float, _flag("leave out scenes with more wave lengths over the body")] = math.inf,
    output: Annotated[Path, _flag("a row for every scene")] = Path("stress.csv"),
    executor: Annotated[str, _flag("local or processes:N")] = "local",
):
    """Solve random boxes and buoys in any depth and wave, and test each answer by the laws of waves.

    Results must be finite and reciprocal, conserve energy and have no negative damping, within the stored estimated
    error. One scene in twenty is solved again with every parameter changed a little, and one as a rotated and shifted
    mesh.  Status 1 if one fails.
    """
    from ...executors.choice import executor_of
    from ...results.output import check_result
    from ...results.tables import printed
    from .run import SECONDS, run

    count, start, number = whole_number("scenes", scenes, 1), whole_number("seed", seed), whole_number("first", first)
    if method not in ("auto", "panel", "contour"):
        raise ValueError(f"--method is {method!r}; allowed: auto, panel, contour")
    if not 1e-5 <= tolerance <= 0.2:
        raise ValueError(f"--tolerance is {tolerance}; allowed: 1e-5 to 0.2")
    if not waves > 0:
        raise ValueError(f"--waves is {waves}; allowed: above 0")
    workers = executor_of(executor)
    check_seconds(f"{count} scenes take", SECONDS * count / workers.count, "give fewer with --scenes")
    check_result(output, "stress")
    questions = [(start, n, method, tolerance, waves) for n in range(number, number + count)]
    try:
        made, interrupted = run(questions, output, workers)
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    status = printed(made)
    print(output)
    if interrupted:
        done = len(made.detail["scene"])
        print(
            f"interrupted after {done} of {count} scenes; --first {number + done} --output OTHER goes on",
            file=sys.stderr,
        )
        return 130
    return status
