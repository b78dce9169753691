"""Findings on a run of a dynamic line."""

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.units import KN
from ..printing.number import significant

STEADY = 0.02  # change of the largest tension between the last two cycles
DYNAMIC = 0.1  # share of the largest quasi-static tension; less inertia and drag is reported as negligible
INSIDE = 0.05  # excess over the largest end tension from which a tension between the ends is reported
BALANCE = 0.01  # error of the energy balance, over the work at the ends, that is accepted


def findings(found, result, strength, line):
    """Findings on the figures, one line each."""
    largest, ends = result.tension_fairlead.max(), max(result.tension_fairlead.max(), result.tension_anchor.max())
    anywhere = max(ends, result.largest_tension.max())
    used = strength.most_used(line, result)
    if used is not None and used.share > 1:
        yield fails(
            f"the tension{_of_segment(used, strength)} is {significant(used.tension / KN)} kN at t = "
            f"{used.time:.2f} s, {100 * used.share:.4g} % of the breaking load {significant(used.breaking / KN)} kN: "
            "the line parts; give a stronger type or a longer line"
        )
    if anywhere > (1 + INSIDE) * ends:
        when = result.time[np.argmax(result.largest_tension)]
        yield (
            f"the largest tension lies between the ends of the line: {significant(anywhere / KN)} kN at t = "
            f"{when:.2f} s, more than at either end"
        )
    if largest > 1.01 * found.fairlead.largest:
        when = result.time[np.argmax(result.tension_fairlead)]
        yield (
            f"the largest fairlead tension, {significant(largest / KN)} kN at t = {when:.2f} s, occurs before the "
            f"evaluated time; give a longer ramp"
        )
    if found.change > STEADY:
        yield (
            f"the largest tension changes by {found.change:.1%} between the last two cycles, allowed {STEADY:.0%}: "
            "give a longer duration; a line that snaps may never repeat"
        )
    if abs(found.imbalance) > BALANCE * found.exchanged > 0:
        share = abs(found.imbalance) / found.exchanged
        yield fails(
            f"{share:.1%} of the work at the ends is neither dissipated nor stored, allowed {BALANCE:.0%}; give a "
            "smaller tolerance"
        )
    dynamic = found.fairlead.over_quasi_static - 1
    if not isinstance(found.regime, str) and found.regime.regime == 1 and abs(dynamic) > DYNAMIC:
        yield (
            f"the simplified method predicts a quasi-static line, but the run differs by {dynamic:+.0%} from statics, "
            f"allowed {DYNAMIC:.0%}: use the values of the run"
        )
    if np.isnan(found.fairlead.quasi_static):
        yield "the line has no static shape at any position of its fairlead, so no quasi-static tension is given"


def _of_segment(used, strength):
    return "" if strength.uniform else f" of segment {used.segment + 1} ({strength.names[used.segment]})"
