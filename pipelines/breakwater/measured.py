"""Measured transmission and tensions for a study: CSV with columns `period_s,transmission`.

`front_kN_per_m2` and `back_kN_per_m2`, if known, are amplitudes of tension per metre of breakwater and per metre of
wave amplitude.
"""

from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import csv_rows, read_text

from ..common.quantities import StudyError

NEEDED, MORE = ("period_s", "transmission"), ("front_kN_per_m2", "back_kN_per_m2")


def read_measured(path):
    """{column: (n,) numbers, nan for empty cells} of a CSV file, without # lines.  Raises StudyError."""
    text = read_text(Path(path), StudyError, largest=1)
    rows = list(csv_rows(text))
    names = list(rows[0]) if rows else []
    if not set(NEEDED) <= set(names) or not set(names) <= {*NEEDED, *MORE}:
        raise StudyError(
            f"{path} has columns {', '.join(map(str, names)) or 'none'}; allowed: {', '.join((*NEEDED, *MORE))}"
        )
    try:
        return {name: np.array([float("nan" if row[name] == "" else row[name]) for row in rows]) for name in names}
    except (TypeError, ValueError):
        raise StudyError(
            f"{path} has rows that are too short or are not numbers; allowed: numbers, or empty cells"
        ) from None
