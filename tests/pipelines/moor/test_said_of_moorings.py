"""What `hakobune moor` says of waves, currents and shares of results that are made up."""

from types import SimpleNamespace

import numpy as np

from hakobune.pipelines.moor.notes import notes

STILL, CURRENT = np.array([-1.5e4, 0.0, 4e5]), np.array([-5e3, 1e3, 1e5])


def said(by_current=None, factor=1.0, used=0.456, waves=True, warnings=(), solutions=None):
    effects = SimpleNamespace(drift=STILL if by_current is None else STILL + by_current, by_current=by_current)
    conditions = SimpleNamespace(
        method="irregular", motion_factor=factor, current=SimpleNamespace(speed=1.5, waves="intrinsic")
    )
    return notes(SimpleNamespace(
        waves={"irregular": effects} if waves else {}, conditions=conditions, allowable=0.4, warnings=warnings,
        tension=np.array([9.12e5, 4e5]), utilisation=np.array([used, 0.1]),
        system=SimpleNamespace(line_names=("bow", "stern"), breaking_load=np.array([2e6 if used else np.inf, 1e6])),
        extreme=SimpleNamespace(solutions=solutions or {}),
    ))  # fmt: skip


def test_what_a_current_adds_is_told_beside_still_water():
    """−20 kN of which −5 are by the current: a third more than the −15 of still water; of nothing there is no share"""
    assert said(CURRENT)[0] == (
        "the current of 1.5 m/s changes the mean drift by Fx -5 kN (+33 %), Fy +1 kN, Mz +100 kN m (+25 %) "
        'relative to still water (current.waves = "still"); the waves are given in intrinsic frequencies'
    )
    assert len(said()) == 1 and len(said(CURRENT, waves=False)) == 1


def test_a_factor_of_motions_is_told_unless_it_is_one():
    assert said(factor=1.5)[0] == "the lines follow 1.5 times these motions" and len(said(factor=1.0)) == 1


def test_what_the_line_that_pulls_most_uses_is_told_with_what_is_allowed():
    (line,) = said()
    assert line == "largest tension: 912 kN in bow, 46 % of its breaking load (allowable 40 %)"
    (line,) = said(used=0.0)
    assert line.endswith("in bow, its utilisation is unknown, since no breaking load is given")


def test_the_segment_whose_breaking_load_a_share_is_of_is_named():
    """900 of 2000 kN in the chain is more than 912 of 3000 kN in the rope above it"""
    parts = [SimpleNamespace(name=name, breaking_load=load) for name, load in (("chain", 2e6), ("rope", 3e6))]
    found = SimpleNamespace(segment_tensions=[9e5, 9.12e5], line=SimpleNamespace(segments=parts))
    (line,) = said(solutions={0: found})
    assert line.endswith("(allowable 40 %), in its segment chain, 900 of 2000 kN")


def test_a_tension_by_motions_that_nothing_damps_says_so_in_its_own_line():
    (line,) = said(warnings=("period: its amplitude 0.5 rad has no viscous damping; …",))
    assert (
        line.startswith("largest tension: 912 kN")
        and ("a motion is at a resonance that only waves damp; viscous damping makes it smaller") in line
    )
