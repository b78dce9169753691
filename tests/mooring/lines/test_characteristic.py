"""The characteristic of a line of a system, whatever its kind, against closed forms and the system at rest."""

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.solve import span_at_tension
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.characteristic import at_tension, characteristic
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import (
    Anchor,
    CompositeLine,
    Fairlead,
    LineSystemError,
    LineType,
    MooredBody,
    UniformLine,
)

CHAIN = LineType("chain", 1000.0, 5e8, breaking_load=4e6)
PARTS = (Segment(150.0, 1000.0, 5e8, breaking_load=4e6), Segment(120.0, 200.0, 8e7, breaking_load=3e6))


def fairleads_held():
    points = [Anchor(f"A{i}", (260.0 * x, 0.0, -80.0)) for i, x in enumerate((-1.0, 1.0))]
    points += [Fairlead(f"F{i}", "hull", (12.0 * x, 0.0, -2.0)) for i, x in enumerate((-1.0, 1.0))]
    lines = [
        UniformLine("chain", CHAIN, 275.0, "A0", "F0", 0.4),
        CompositeLine("rope", PARTS[::-1], "F1", "A1", (PointLoad(120.0, 2e4),)),
    ]
    return rest(System(80.0, lines, points, (MooredBody("hull", freedom=()),)))


@pytest.mark.parametrize("name", ["chain", "rope"])
def test_a_characteristic_rises_from_slack_through_the_line_at_rest_to_its_breaking_load(name):
    state = fairleads_held()
    found, number = characteristic(state, name, 60), state.system.line_names.index(name)
    assert np.all(np.diff(found.span) > 0) and np.all(np.diff(found.horizontal) > 0)
    assert np.isclose(found.tension[-1], state.system.breaking_load[number], rtol=1e-9)
    assert found.horizontal[0] < 2e-3 * found.horizontal[-1] and np.all(np.diff(found.grounded) <= 1e-9)
    assert found.rest == 248.0 and found.span[0] < found.rest < found.span[-1]
    at_rest = np.exp(np.interp(found.rest, found.span, np.log(found.tension)))
    assert np.isclose(at_rest, state.tension[number], rtol=0.02)


def test_the_characteristic_of_a_uniform_line_is_its_span_at_each_tension():
    found = characteristic(fairleads_held(), "chain")
    exact, lying = span_at_tension(found.horizontal, 78.0, 275.0, 1000.0, 5e8, 0.4)
    lies = lying > 0
    assert lies.sum() > 5
    assert np.abs(exact - found.span)[lies].max() < 1e-6 and np.abs(lying - found.grounded)[lies].max() < 1e-5


def test_a_line_that_is_not_there_is_named():
    with pytest.raises(LineSystemError, match="line 'wire' is unknown; allowed: chain, rope"):
        characteristic(fairleads_held(), "wire")


def test_a_line_drawn_to_a_tension_pulls_its_anchor_upward_by_what_its_own_weight_leaves():
    """A chain of 100 m and 1000 N/m from 8 m above its anchor: it lies until 1000 (100² + 8²)/16 N of horizontal pull,
    with 1000 N/m · 8 m more at the fairlead; beyond that the whole chain hangs"""
    points = [Anchor("A", (90.0, 0.0, -8.0)), Fairlead("F", "hull", (0.0, 0.0, 0.0))]
    chain = UniformLine("chain", LineType("chain", 1000.0, 1e12), 100.0, "A", "F")
    state = rest(System(8.0, [chain], points, (MooredBody("hull", freedom=()),)))
    lifts = 1000.0 * (100.0**2 - 8.0**2) / (2 * 8.0) + 1000.0 * 8.0
    along, up, lying = at_tension(state, 0, 0.98 * lifts)
    assert up == 0 and along == pytest.approx(0.98 * lifts - 8000.0, rel=1e-5)
    assert 0 < lying < 2.0
    along, up, lying = at_tension(state, 0, 1.1 * lifts)
    assert lying == 0 and up > 1000.0
    assert along**2 + (up + 1e5) ** 2 == pytest.approx((1.1 * lifts) ** 2, rel=1e-5)
    assert at_tension(state, 0, 0.5 * state.tension[0]) == at_tension(state, 0, 0.9 * state.tension[0])  # as it hangs
