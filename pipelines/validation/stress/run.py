"""A campaign from its first scene to its last: failures and time left are printed during the campaign, and the result
is stored.
"""

import re
import sys
import time
from collections import Counter

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ...common.bounds import told
from ...common.interrupt import ctrl_c
from ...common.progress import duration
from ...executors.choice import in_order_until
from ...results.output import write_result
from .. import beside
from .campaign import row_of

SECONDS = 0.5  # s, approximate time of a scene
EVERY = 30.0  # s between lines of progress, at which what is there is written
SHOWN = 5  # scenes that are named at the end
USELESS = 0.3  # an estimated error above which a result is of little use


def run(questions, output, executor):
    """Return (Result, whether Ctrl-C ended it) of questions, the arguments of `row_of`; it is written to `output`"""
    told(f"{len(questions)} scenes take", SECONDS * len(questions) / executor.count)
    rows, start = [], time.perf_counter()
    printed = start
    with ctrl_c(_say) as stop:
        for _, row in in_order_until(stop, executor, [(row_of, *question) for question in questions]):
            if isinstance(row, Exception):  # crash of a process; a scene that fails gives a row
                raise row
            rows.append(row)
            if row.verdict:
                _say(f"scene {row.number}: {row.verdict}\n  {row.command}")
            now = time.perf_counter()
            if now - printed > EVERY:
                printed, left = now, (now - start) / len(rows) * (len(questions) - len(rows))
                _say(f"{len(rows)}/{len(questions)}  {duration(left)} left")
                write_result(result_of(rows, questions[0], output), output)
    made = result_of(rows, questions[0], output)
    write_result(made, output)
    return made, len(rows) < len(questions)


def _say(text):
    print(text, file=sys.stderr, flush=True)


def result_of(rows, question, output):
    """The Result of `Row`s, which fails where one has a verdict; question : the first; output : where it is kept"""
    failed = [row for row in rows if row.verdict]
    lines = [f"scene {row.number}: {row.verdict}; {row.command}" for row in failed[:SHOWN]]
    if failed[SHOWN:]:
        lines.append(f"{len(failed) - SHOWN} more of {len(rows)} scenes; {output} has their verdicts")
    source = "laws of waves; seed {0}, method {2}, tolerance {3:g}, at most {4:g} waves".format(*question)
    table = {"scene": [row._asdict() for row in rows]}
    return beside.result("stress", source, table, summary(rows), map(fails, lines), shown=False)


def summary(rows):
    """Lines: scenes, time, estimate and worst violation of every method, then refusals and failures by kind"""
    for method in sorted({row.method for row in rows if row.method}):
        mine = [row for row in rows if row.method == method]
        estimates, seconds = (np.array([getattr(row, name) for row in mine]) for name in ("estimate", "seconds"))
        known = [(row.worst, row.number) for row in mine if np.isfinite(row.worst[0])]
        (worst, law), at = max(known, default=((np.nan, "nothing"), mine[0].number))
        yield (
            f"{method}: {len(mine)} scenes, {1e3 * np.median(seconds):.0f} ms at the median, {seconds.max():.1f} s at "
            f"most; estimated error {np.nanmedian(estimates):.1e} at the median, above {USELESS:g} in "
            f"{np.count_nonzero(estimates > USELESS)}; worst: {law} {worst:.2g} of what is allowed, scene {at}"
        )
    left_out = sum(1 for row in rows if not row.method and not row.verdict)
    if left_out:
        yield f"{left_out} scenes left out (--waves, or --method cannot represent them)"
    kinds = Counter(re.split(r"\d| is ", row.verdict)[0].strip() for row in rows if row.verdict)
    told = [f"{count} {kind}" for kind, count in kinds.most_common()]
    yield "; ".join([f"{len(rows)} scenes, {sum(kinds.values())} failed", *told])
