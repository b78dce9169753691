"""Utilisation of an anchor's holding capacity, and the size that holds a pull; H, V : pull along and up, N; s :
safety factor.

    drag anchor    used = s H/H_u,   H_u = H_R (m/m_R)^b,    m = m_R (s H/H_R)^(1/b)     a pull upwards lifts it
    sinker         used = s (H/μ + V)/W,  W its weight in water
    pile           used = s max(H/H_u, V/V_u),  by friction V_u = ψ L c of its girth, length in the bed and cohesion

Drag anchors by type and soil: UFC 4-159-03 (2005), equation 26, `tables/drag_anchors.csv`. Sinkers and piles: Kihara
et al. (1975), chapter 6. No chart gives a drag anchor's capacity under an upward pull; a finding reports such a pull.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from .failing import fails
from .overuse import shares

KINDS = ("drag", "sinker", "pile")
SMALL = 0.1  # of the reference mass of a chart, below which its law is extrapolated; charts span decades around it
LIFTED = 1e-3  # uplift over horizontal pull below which it counts as rounding


class Chart(NamedTuple):
    """H_u = holding (m/reference)^exponent; reference : kg; holding : N"""

    reference: float
    holding: float
    exponent: float
    source: str
    status: str


class Anchor(NamedTuple):
    """An anchor, with nan for unknown values. An unknown anchor is sized, and its utilisation is nan.

    holding, uplift : capacity of a drag anchor or a pile along the bed and upwards, N
    weight : weight of a sinker in water, N; friction : coefficient of friction of a sinker
    chart : chart of a drag anchor whose mass is wanted, else None; safety : safety factor s
    """

    kind: str
    holding: float = np.nan
    uplift: float = np.nan
    weight: float = np.nan
    friction: float = np.nan
    chart: Chart | None = None
    safety: float = 1.0

    def capacity(self, up):
        """Capacity along the bed, N, without the safety factor, under an upward pull of `up` N"""
        return self.friction * (self.weight - np.maximum(up, 0.0)) if self.kind == "sinker" else self.holding

    def mass(self, along, up):
        """Mass of a drag anchor with a chart, kg: the given mass, or the required mass; nan for other anchors"""
        if self.chart is None or np.isnan(self.holding):
            return self.needed(along, up) if self.kind == "drag" else np.nan
        return self.chart.reference * (self.holding / self.chart.holding) ** (1 / self.chart.exponent)

    def used(self, along, up):
        """Utilisation of the capacity of the anchor, with the safety factor, at pulls `along` and `up`, N"""
        up = np.maximum(up, 0.0)
        if self.kind == "sinker":
            return self.safety * (along / self.friction + up) / self.weight
        lifted = up / self.uplift if self.kind == "pile" and np.any(up > LIFTED * along) else 0.0
        return self.safety * np.maximum(along / self.holding, lifted)

    def needed(self, along, up):
        """Required size: mass of a drag anchor with a chart, kg; weight of a sinker in water, N; nan for other
        anchors
        """
        if self.kind == "sinker":
            return self.safety * (along / self.friction + np.maximum(up, 0.0))
        if self.chart is None:
            return np.nan
        return self.chart.reference * (self.safety * along / self.chart.holding) ** (1 / self.chart.exponent)


@cache
def charts():
    """{(type, soil): Chart} of drag anchors"""
    return {
        (row["type"], row["soil"]): Chart(
            float(row["reference_kg"]),
            1e3 * float(row["holding_kN"]),
            float(row["exponent"]),
            row["source"],
            row["status"],
        )
        for row in packaged_rows(__package__, "drag_anchors")
    }


def holding_of(chart, mass):
    """Capacity of a drag anchor of `mass` kg in air, N"""
    return chart.holding * (mass / chart.reference) ** chart.exponent


def stored_anchor(row):
    """The Anchor from its values in a list, as stored in JSON"""
    return Anchor(*row)._replace(chart=row[5] and Chart(*row[5]))


def anchor_findings(names, anchors, along, up, where="at the largest tension"):
    """Failures and remarks on anchors, one line each; anchors : (n,), Anchor or None; pulls : (n,) N"""
    known = [i for i, one in enumerate(anchors) if one is not None]
    used = np.array([np.nan if one is None else one.used(along[i], up[i]) for i, one in enumerate(anchors)])
    over = used > 1
    if np.any(over):
        named = shares(names, np.where(over, used, np.nan))
        yield fails(
            f"{over.sum()} of {len(known)} anchors {where} carry more than their capacity, limit 100 %: "
            f"{named}; give a larger anchor (the anchor table has the size), or a longer line"
        )
    lifted = [i for i in known if anchors[i].kind == "drag" and up[i] > LIFTED * along[i]]
    if lifted:
        worst = max(lifted, key=lambda i: up[i] / along[i])
        angle = np.degrees(np.arctan2(up[worst], along[worst]))
        yield (
            f"{len(lifted)} of {len(known)} anchors are drag anchors that are pulled upward {where}, most of "
            f"all {names[worst]} with {up[worst] / 1e3:.3g} kN at {angle:.3g}° above the bed: their holding "
            "capacity is for a horizontal pull only; give more chain, or use a sinker or pile"
        )
    mass = {i: anchors[i].mass(along[i], up[i]) for i in known if anchors[i].chart}
    small = [i for i, kg in mass.items() if kg < SMALL * anchors[i].chart.reference]
    if small:
        least = min(small, key=lambda i: mass[i] / anchors[i].chart.reference)
        yield (
            f"{len(small)} of {len(known)} anchors {where} are far lighter than those of their charts, most of all "
            f"{names[least]} with {mass[least]:.3g} kg; the limit is a tenth of the chart's "
            f"{anchors[least].chart.reference:.4g} kg: the curve of the chart is extrapolated; give holding_kN "
            f"of the maker"
        )
    charted = [anchors[i].chart for i in known if anchors[i].chart]
    unsure = dict.fromkeys(chart.source for chart in charted if chart.status == "unverified")
    if unsure:
        yield (
            f"the holding capacity of drag anchors by {'; '.join(unsure)} has not been checked against the "
            "printed source: check it there, or give holding_kN"
        )
