"""Which file and key a number of the report came from."""

from __future__ import annotations

from hakobune.mooring.criteria import verdict as of

from .fatigue import QUANTITY as FATIGUE
from .kinds.needs import SCOPE

H5 = {of.PRETENSION: "lines/pretension", of.HOLDING: "lines/maximum_horizontal_anchor_force"}
KEPT = {of.PRETENSION: "pretension", of.HOLDING: "horizontal", of.PARTIAL: "mean, values.largest", SCOPE: "length"}
OF_PROJECT = {"service life": "project.service_life", "return period": "project.service_life, project.probability"}


def origin(read, ran, criterion):
    """(path of a file, or None for the project's own; key in it) of what a criterion finds in a load case, a Ran"""
    quantity, path = criterion.quantity, ran.path
    if quantity in OF_PROJECT:
        return None, OF_PROJECT[quantity]
    if any(one.quantity == quantity for one in read.project.values):
        return None, "values"
    if ran.case.apart:
        return path, f"values.parts.{quantity}"
    tension = quantity in of.OF_TENSIONS
    beside = {
        name: path.with_name(f"{path.stem}{name}.json") for name in ("_numbers", "_runs_numbers", "_runs_extremes")
    }
    if not read.kind.MOVED:
        return beside["_numbers"], _kept(quantity, tension)
    if ran.runs is None:
        moved = "lines/length" if quantity == SCOPE else "motion_amplitude"
        return path, H5.get(quantity, "lines/maximum_tension" if tension else moved)
    at_berth = beside["_runs_numbers"].is_file()
    if quantity in (of.PRETENSION, SCOPE) and not at_berth:
        return path, "lines/pretension" if quantity == of.PRETENSION else "lines/length"
    if quantity in (of.PRETENSION, SCOPE) or quantity in ran.numbers.parts:
        return beside["_runs_numbers"], _kept(quantity, tension)
    if quantity == FATIGUE:
        return beside["_runs_extremes"], "values.cycles"
    return beside["_runs_extremes"], _kept(quantity, True) if tension else "values.motions"


def _kept(quantity, tension):
    return f"values.{KEPT.get(quantity, 'largest' if tension else f'parts.{quantity}')}"
