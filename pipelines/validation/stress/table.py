"""The rows of a campaign as a file and in a few lines."""

from __future__ import annotations

import csv
import re
from collections import Counter

import numpy as np

from ...common.outputs import opening
from .campaign import Row

USELESS = 0.3  # an estimated error above which a result is of little use


class Writer:
    """Rows into a CSV file as they come, so that an interrupted campaign leaves what it has."""

    def __init__(self, file, heading):
        file.writelines(f"# {line}\n" for line in heading)
        self.file, self.writer = file, csv.writer(file, lineterminator="\n")
        self.writer.writerow(Row._fields)
        self.file.flush()

    def write(self, row):
        self.writer.writerow([f"{value:.6g}" if isinstance(value, float) else value for value in row])
        self.file.flush()


def is_table(path):
    """Whether a file is the CSV of a campaign"""
    return opening(path)[0].startswith("# seed ")


def summary(rows):
    """Lines: scenes, time, estimate and worst violation of every method, then refusals and failures by kind"""
    for method in sorted({row.method for row in rows if row.method}):
        mine = [row for row in rows if row.method == method]
        estimates, seconds = (np.array([getattr(row, name) for row in mine]) for name in ("estimate", "seconds"))
        known = [(row.worst, row.number) for row in mine if np.isfinite(row.worst[0])]
        (worst, law), at = max(known, default=((np.nan, "nothing"), mine[0].number))
        yield (
            f"{method}: {len(mine)} scenes, {1e3 * np.median(seconds):.0f} ms in the middle, {seconds.max():.1f} s at "
            f"most; estimated error {np.nanmedian(estimates):.1e} in the middle, above {USELESS:g} in "
            f"{np.count_nonzero(estimates > USELESS)}; worst: {law} {worst:.2g} of what is allowed, scene {at}"
        )
    left_out = sum(1 for row in rows if not row.method and not row.verdict)
    if left_out:
        yield f"{left_out} scenes left out (--waves, or --method cannot represent them)"
    kinds = Counter(_kind(row) for row in rows if row.verdict)
    yield f"{len(rows)} scenes, {sum(kinds.values())} failed" + "".join(
        f"\n  {n} {kind}" for kind, n in kinds.most_common()
    )


def _kind(row):
    """The verdict up to its numbers"""
    return re.split(r"\d| is ", row.verdict)[0].strip()
