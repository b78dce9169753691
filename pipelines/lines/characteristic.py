"""The table of a line's characteristic, X(H) and T(X), as `hakobune line` and `lines` print it."""

from __future__ import annotations

import math

from ..common.units import KN


def show_characteristic(console, name, span, horizontal, tension, grounded, rest, breaking, lies="on the bed"):
    """Print spans (m,) m with pulls (m,) N and lengths (m,) m that lie as `lies` says

    rest : m; breaking : N, may be inf
    """
    from rich.table import Table

    table = Table(title=f"{name}: from slack to taut; as it hangs the span is {rest:.3f} m", title_justify="left")
    for i, column in enumerate(("span m", "horizontal kN", "tension kN", f"{lies} m", "used %")):
        table.add_column(column, justify="right" if i else "left")
    for x, H, T, length in zip(span, horizontal, tension, grounded, strict=True):
        used = f"{100 * T / breaking:.1f}" if math.isfinite(breaking) else "–"
        table.add_row(f"{x:.3f}", f"{H / KN:.2f}", f"{T / KN:.2f}", f"{length:.2f}", used)
    console.print(table)
