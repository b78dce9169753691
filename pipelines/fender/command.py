"""`hakobune fender`: the characteristic of a fender as a table, one compression of it, and a picture."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.fender_tables import (
    beyond_batch,
    causes_of,
    fender_of,
    on_dolphin,
    own_strain,
    pair_of,
    softest_and_stiffest,
    upright,
)
from ..common.picture import PLOTS, check_picture, save
from ..common.quantities import StudyError
from ..printing.verdict import tell

KILO = 1e3
ROWS = 11


def fender(table, strain, deflection, energy, output):
    """Print the fender of a FenderTable; one of strain, deflection (m), energy (kJ) asks for one compression of it.

    raises : ValueError, one line
    """
    if output is not None:
        check_picture(output, PLOTS)
    asked = [key for key, value in zip(("strain", "deflection", "energy"), (strain, deflection, energy), strict=True)
             if value is not None]  # fmt: skip
    if len(asked) > 1:
        raise StudyError(f"--{' and --'.join(asked)} are given; allowed: one of --strain, --deflection, --energy")
    alone = fender_of(table)
    pair = pair_of(table, alone)
    at = _compression(pair, strain, deflection, energy)
    bands, factors = softest_and_stiffest(table, alone)
    straight = pair_of(table, fender_of(upright(table))) if table.angle_deg else None
    if output is not None:
        _draw(pair, bands, at, straight, output)
    _show(pair, bands, factors, causes_of(table), straight)
    if straight is not None:
        _tell_inclined(table, pair, straight)
    if at is not None:
        _tell(pair, bands, at)
    status = tell(() if at is None else _failures(table, alone, pair, at, energy))
    if output is not None:
        print(output)
    return status


def _compression(pair, strain, deflection, energy):
    """m, or None where none is asked for"""
    for key, value in (("strain", strain), ("deflection", deflection), ("energy", energy)):
        if value is not None and not 0 < value < np.inf:
            raise StudyError(f"--{key} is {value:g}; allowed: above 0, finite")
    if energy is not None:
        return pair.deflection_at_energy(KILO * energy)
    at = deflection if strain is None else pair.whole(strain * pair.height)
    if at is not None:
        pair.reaction(at)  # raises beyond the table
    return at


def _shares(pair, straight, x):
    """Reaction and energy over those of the fender under a face that is not inclined, at a deflection, m"""
    return float(pair.loading(x) / straight.loading(x)), float(pair.energy(x) / straight.loading.integral(x))


def _show(pair, bands, factors, causes, straight):
    from rich.table import Table

    from ..printing.console import new_console

    console = new_console()
    table = Table(title=repr(pair)[1:-1])
    beside = ("reaction ×", "energy ×") if straight else ()
    behind = ("dolphin m",) if on_dolphin(pair) else ()
    for name in ("strain %", "deflection m", *behind, "reaction kN", "energy kJ", "returned kJ", *beside):
        table.add_column(name, justify="right", no_wrap=True)
    for x in np.linspace(0.0, pair.limit, ROWS):
        places = 100 * pair.own(x) / pair.height, x, *([x - pair.own(x)] if behind else [])
        forces = pair.loading(x) / KILO, pair.energy(x) / KILO, pair.returned(x) / KILO
        row = [f"{v:.{n}f}" for v, n in zip(places, (1, 3, 3), strict=False)] + [f"{v:.1f}" for v in forces]
        shares = [f"{share:.3f}" for share in _shares(pair, straight, x)] if straight and x > 0 else ["–"] * len(beside)
        table.add_row(*row, *shares)
    console.print(table)
    lines = [
        f"rated: {own_strain(pair, pair.rated * pair.height)}, {pair.rated_reaction / KILO:.1f} kN, "
        f"{pair.rated_energy / KILO:.1f} kJ; "
        f"allowable: {100 * pair.own_allowable:.1f} %; table to {own_strain(pair, pair.limit)}"
        + (", then overload" if pair.overload else ""),
        f"by {', '.join(causes)}: reaction × {factors[0]:.3f} (softest) to × {factors[1]:.3f} (stiffest), "
        f"{bands[0].rated_reaction / KILO:.1f} to {bands[1].rated_reaction / KILO:.1f} kN",
    ]
    for line in lines:
        console.print(line, highlight=False, soft_wrap=True)


def _tell_inclined(table, pair, straight):
    """Rated values over those of the upright fender, where the edge that is pressed most has the rated strain"""
    width = table.length if table.width is None else table.width
    reaction, energy = pair.rated_reaction / straight.rated_reaction, pair.rated_energy / straight.rated_energy
    print(
        f"inclined by {table.angle_deg:g}° over {width:g} m, by strips: × {reaction:.3f} on the rated reaction, × "
        f"{energy:.3f} on the rated energy; deflections are those of the edge that is pressed most"
    )


def _tell(pair, bands, at):
    energy = float(pair.energy(at))
    print(
        f"at {at:.4g} m ({own_strain(pair, at)}): {float(pair.reaction(at)) / KILO:.1f} kN, largest on the way "
        f"{pair.largest_reaction(at) / KILO:.1f} kN, {energy / KILO:.1f} kJ"
    )
    words = []
    for name, one in zip(("softest", "stiffest"), bands, strict=True):
        if one.overload is None and energy > one.energy(one.limit):
            words.append(f"the {name} does not take it up")
        else:
            x = one.deflection_at_energy(energy)
            words.append(f"the {name} at {own_strain(one, x)} with {one.largest_reaction(x) / KILO:.1f} kN")
    print(f"the same energy: {'; '.join(words)}")


def _failures(table, alone, pair, at, energy):
    """What fails at a deflection, m; energy : kJ, where it was asked for"""
    strain = pair.own(at) / pair.height
    if strain > pair.own_allowable * (1 + 1e-9):
        yield fails(
            f"the fender is pressed to {100 * strain:.4g} % of its height; allowable {100 * pair.own_allowable:.4g} %; "
            "take a larger one or more of them"
        )
    if energy is not None:
        yield from beyond_batch("energy asked for", KILO * energy, table, alone)


def _draw(pair, bands, at, straight, output):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axis = figure.add_subplot()
    x = np.linspace(0.0, pair.limit, 400)
    low, high = (one.loading(x) / KILO for one in bands)
    axis.fill_between(x, low, high, alpha=0.15, label="softest to stiffest")
    axis.plot(x, pair.loading(x) / KILO, label="loading")
    if np.any(pair.unloading(x) < pair.loading(x) * (1 - 1e-9)):
        axis.plot(x, pair.unloading(x) / KILO, "--", label="unloading")
    axis.axvline(pair.rated * pair.height, color="grey", linewidth=0.8)
    axis.annotate("rated", (pair.rated * pair.height, 0), rotation=90, va="bottom", ha="right", color="grey")
    right = axis.twinx()
    right.plot(x, pair.energy(x) / KILO, color="tab:green", label="energy")
    if straight is not None:
        axis.plot(x, straight.loading(x) / KILO, ":", color="tab:blue", label="loading, not inclined")
        right.plot(x, straight.loading.integral(x) / KILO, ":", color="tab:green", label="energy, not inclined")
    if at is not None:
        axis.plot([at], [float(pair.loading(at)) / KILO], "o", color="black")
        right.plot([at], [float(pair.energy(at)) / KILO], "o", color="tab:green")
    axis.set(xlabel="deflection, m", ylabel="reaction, kN", title=pair.name, xlim=(0, None), ylim=(0, None))
    right.set(ylabel="energy, kJ", ylim=(0, None))
    handles = [*axis.get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
    axis.legend(handles=handles, loc="upper left")
    save(figure, output, 110)
