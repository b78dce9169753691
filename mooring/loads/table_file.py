"""Tables printed in reports, kept as CSV beside the modules that use them."""

from __future__ import annotations

from importlib.resources import files

from hakobune.meshing.text_files import csv_rows


def read_table(name):
    """Rows of `tables/name`, one dictionary of texts each; lines that begin with # give the source."""
    text = files(__package__).joinpath("tables", name).read_text(encoding="utf-8")
    return list(csv_rows(text))
