"""`hakobune.fender`: the characteristics of a fender, of its softest variant and of its stiffest variant, and one
compression of each.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.fenders.fender import Fender
from hakobune.mooring.fenders.taken import at_deflections, deflection_of

from ..common.fender_tables import (
    FenderTable,
    beyond_batch,
    causes_of,
    fender_of,
    on_dolphin,
    pair_of,
    softest_and_stiffest,
    upright,
)
from ..common.quantities import StudyError
from ..common.typed import typed
from ..results.given import Tables, given
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels

ROWS = 11
BANDS = ("catalogue", "softest", "stiffest")


class Pressed(NamedTuple):
    """pair : the fender and its support; bands : softest and stiffest variant; at : requested deflection, m, or None

    straight : the pair under a face without inclination; None if the face is not inclined
    """

    pair: Fender
    bands: tuple[Fender, ...]
    at: float | None
    straight: Fender | None


def fender(
    table: Tables | FenderTable,
    *,
    strain: float | None = None,
    deflection: float | None = None,
    energy: float | None = None,
) -> Result:
    """Reaction and energy of a fender over its compression, its returned energy, its softest and stiffest variants.

    table : keys of the table [fender] of studies as a dictionary, or a `common.fender_tables.FenderTable`
    strain, deflection (m), energy (J) : at most one of the three, to request one compression
    returns : Result, in SI; its `detail` is a `Pressed`
    raises : ValueError, with a message of one line
    """
    table, text = given(table, FenderTable, None, lambda raw: typed(raw, FenderTable, StudyError))
    asked = {"strain": strain, "deflection": deflection, "energy": energy}
    asked = {key: value for key, value in asked.items() if value is not None}
    if len(asked) > 1:
        raise StudyError(f"{' and '.join(asked)} are given; give one of strain, deflection, energy")
    alone = fender_of(table)
    pair = pair_of(table, alone)
    bands, factors = softest_and_stiffest(table, alone)
    straight = pair_of(table, fender_of(upright(table))) if table.angle_deg else None
    made = Pressed(pair, bands, _compression(pair, asked), straight)
    return Result(
        "fender",
        {**_curve(made), **_rated(made, factors), **_whole(made)},
        labels("deflection", np.linspace(0.0, pair.limit, ROWS), "m") | labels("band", BANDS),
        () if made.at is None else tuple(_failures(table, alone, made, energy)),
        tuple(_notes(table, made)),
        provenance=provenance(text),
        detail=made,
    )


def _compression(pair, asked):
    """m, or None if none is requested"""
    for key, value in asked.items():
        if not 0 < value < np.inf:
            raise StudyError(f"{key} is {value:g}; allowed: above 0, finite")
    if "energy" in asked:
        return pair.deflection_at_energy(asked["energy"])
    at = pair.whole(asked["strain"] * pair.height) if "strain" in asked else asked.get("deflection")
    if at is not None:
        pair.reaction(at)  # raises beyond the table
    return at


def _curve(made):
    """The characteristic; under an inclined face also its ratio to that of the upright fender"""
    pair, x, axes = made.pair, np.linspace(0.0, made.pair.limit, ROWS), ("deflection",)
    own, energy = np.array([pair.own(one) for one in x]), pair.energy(x)
    found = quantities("characteristic", {
        "curve.strain": (own / pair.height, "%", "strain"),
        **({"curve.dolphin": (x - own, "m", "dolphin")} if on_dolphin(pair) else {}),
        "curve.reaction": (pair.loading(x), "N", "reaction"),
        "curve.energy": (energy, "J", "energy"),
        "curve.returned": ([pair.returned(one) for one in x], "J", "returned"),
    }, *axes)  # fmt: skip
    words = ("softest", "stiffest")
    found |= quantities("", {
        f"curve.{word}": (one.loading(x), "N", f"reaction of the {word}")
        for word, one in zip(words, made.bands, strict=True)
    }, *axes)  # fmt: skip
    if made.straight is not None:
        loading = made.straight.loading
        with np.errstate(invalid="ignore"):
            shares = {"reaction": pair.loading(x) / loading(x), "energy": energy / loading.integral(x)}
        rows = {f"curve.{name}_share": (share, "", name) for name, share in shares.items()}
        found |= quantities("relative to the same fender under an upright face", rows, *axes)
    return found


def _rated(made, factors):
    """Rated values of the fender, the softest and the stiffest, and their compression by the requested energy"""
    three = (made.pair, *made.bands)
    rows = {
        "factor": ([1.0, *factors], "", "factor"),
        "rated.reaction": ([one.rated_reaction for one in three], "N", "rated reaction"),
        "rated.energy": ([one.rated_energy for one in three], "J", "rated energy"),
    }
    if made.at is not None:
        energy = float(made.pair.energy(made.at))
        places = np.array([made.at, *(deflection_of(one, energy) for one in made.bands)])
        strain, reaction = at_deflections(three, places)
        rows |= {
            "taken.deflection": (places, "m", "deflection"),
            "taken.strain": (strain, "%", "strain"),
            "taken.reaction": (reaction, "N", "largest reaction"),
        }
    return quantities("softest and stiffest", rows, "band")


def _whole(made):
    pair, at, straight = made.pair, made.at, made.straight
    rows = {
        "rated.strain": (pair.own(pair.rated * pair.height) / pair.height, "%", "rated strain"),
        "allowable.strain": (pair.own_allowable, "%", "allowable strain"),
        "limit.strain": (pair.own(pair.limit) / pair.height, "%", "strain at the end of the table"),
    }
    for name in ("reaction", "energy") if straight is not None else ():
        share = getattr(pair, f"rated_{name}") / getattr(straight, f"rated_{name}")
        rows[f"inclined.{name}"] = share, "", f"rated {name} relative to the upright fender"
    if at is not None:
        rows["asked.energy"] = float(pair.energy(at)), "J", "energy taken up"
        rows["asked.reaction"] = float(pair.reaction(at)), "N", "reaction there"
    return quantities(pair.name, rows)


def _notes(table, made):
    yield f"the reaction factors of the softest and the stiffest fender cover {', '.join(causes_of(table))}"
    if made.straight is not None:
        width = table.length if table.width is None else table.width
        yield (
            f"the face is inclined by {table.angle_deg:g}° over {width:g} m and computed in strips; deflections "
            "are given for the most compressed edge"
        )


def _failures(table, alone, made, energy):
    """Failures at the requested deflection; energy : J, if requested"""
    pair = made.pair
    strain = pair.own(made.at) / pair.height
    if strain > pair.own_allowable * (1 + 1e-9):
        yield fails(
            f"the fender is compressed by {100 * strain:.4g} % of its height, allowable "
            f"{100 * pair.own_allowable:.4g} %; choose a larger fender or more fenders"
        )
    if energy is not None:
        yield from beyond_batch("energy asked for", energy, table, alone)
