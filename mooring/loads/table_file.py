"""Tables printed in reports, kept as CSV beside the modules that use them."""

from __future__ import annotations

import csv
from importlib.resources import files


def read_table(name):
    """Rows of `tables/name`, one dictionary of texts each; lines that begin with # tell the source."""
    text = files(__package__).joinpath("tables", name).read_text(encoding="utf-8")
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
