"""The table of a line's characteristic, X(H) and T(X), as `hakobune line` and `lines` print it."""

from __future__ import annotations

import math

from ..common.units import KN


def percent(share):
    """Of a breaking load, "–" where none is known"""
    return f"{100 * share:.1f}" if math.isfinite(share) else "–"


def show_characteristic(console, name, span, horizontal, tension, grounded, used, rest, lies="on the bed"):
    """Print spans (m,) m with pulls (m,) N and lengths (m,) m that lie as `lies` says

    used : (m,) share of the breaking load, nan where none is known; rest : m
    """
    from rich.table import Table

    table = Table(title=f"{name}: from slack to taut; as it hangs the span is {rest:.3f} m", title_justify="left")
    for i, column in enumerate(("span m", "horizontal kN", "tension kN", f"{lies} m", "used %")):
        table.add_column(column, justify="right" if i else "left")
    for x, H, T, length, share in zip(span, horizontal, tension, grounded, used, strict=True):
        table.add_row(f"{x:.3f}", f"{H / KN:.2f}", f"{T / KN:.2f}", f"{length:.2f}", percent(share))
    console.print(table)
