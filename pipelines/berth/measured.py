"""The fifty berthings of Ueda (1981), compared with the kinetic-energy method."""

from hakobune.mooring.berthing.field import compared, contacts

from ..results.quantity import quantities
from ..results.result import Result, labels

METHODS = ("older", "Ueda 1981")


def measured():
    """Ratios of absorbed to effective energy of the fifty berthings, with two virtual masses"""
    table = contacts()
    found = [compared(method, table) for method in METHODS]
    rows = {"median": "median", "low": "lower quartile", "high": "upper quartile"}
    columns = {f"ratio.{name}": ([getattr(c, name) for c in found], "", words) for name, words in rows.items()}
    columns["contacts"] = [c.contacts for c in found], "", "contacts"
    columns["bounded"] = [c.bounded for c in found], "%", "within the rounding of speeds to whole cm/s"
    return Result(
        "berth measured",
        quantities("absorbed energy over effective energy", columns, "virtual_mass"),
        labels("virtual_mass", METHODS),
        notes=(f"{len({c.ship for c in table})} ships, {len(table)} contacts (Ueda 1981, tables 2.1 to 2.5)",),
    )
