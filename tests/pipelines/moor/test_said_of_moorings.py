"""What `hakobune moor` says of waves, currents and shares of results that are made up."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.moor import command


def effects(drift, amplitudes, by_current=None):
    return SimpleNamespace(drift=np.array(drift), amplitudes=np.array(amplitudes), by_current=by_current)


def result(waves, method="irregular", factor=1.0, current=None):
    conditions = SimpleNamespace(duration=10800.0, method=method, motion_factor=factor, current=current)
    return SimpleNamespace(waves=waves, conditions=conditions)


IRREGULAR = effects([-2e4, 1e3, 5e5], [1.5, 0.8, 2.25, math.radians(3.0), math.radians(1.2), math.radians(0.5)])
REGULAR = effects([-3e4, 1e3, 5e5], [0.9, 0.4, 1.25, math.radians(2.0), math.radians(1.0), math.radians(0.25)])


def test_motions_are_told_in_metres_and_degrees_and_the_other_method_where_it_differs():
    first, factor, other = command._waves(result({"irregular": IRREGULAR, "regular_wave": REGULAR}, factor=1.5))
    assert first == ("free motions, largest expected in 3 h of irregular waves: surge 1.5 m, sway 0.8 m, heave 2.25 m, "
                     "roll 3°, pitch 1.2°, yaw 0.5°")  # fmt: skip
    assert factor == "lines are tightened by 1.5 times these motions"
    assert other == (
        'not used (method = "regular_wave"), of a regular wave of significant height: drift Fx -30.0, Fy 1.0 kN, '
        "Mz 500.0 kN m; surge 0.9 m, sway 0.4 m, heave 1.25 m, roll 2°, pitch 1°, yaw 0.25°"
    )
    (chosen, *_) = command._waves(result({"irregular": IRREGULAR, "regular_wave": REGULAR}, "regular_wave"))
    assert chosen.startswith("free motions, of a regular wave of significant height: surge 0.9 m")
    assert list(command._waves(result({}))) == []


@pytest.mark.parametrize("share, told", [(1.009, False), (1.011, True)])
@pytest.mark.parametrize("what", ["drift", "amplitudes"])
def test_methods_that_are_within_a_hundredth_are_told_once(share, told, what):
    near = SimpleNamespace(
        **{key: np.array(getattr(IRREGULAR, key)) for key in ("drift", "amplitudes")}, by_current=None
    )
    getattr(near, what)[2] /= share  # the moment, and heave, are the largest here
    said = list(command._waves(result({"irregular": IRREGULAR, "regular_wave": near})))
    assert (len(said) == 2) is told


def test_what_a_current_adds_is_told_beside_still_water():
    """−20 kN of which −5 are by the current: a third more than the −15 of still water"""
    one = effects([-2e4, 1e3, 5e5], [1, 0, 0, 0, 0, 0], np.array([-5e3, 1e3, 1e5]))
    current = SimpleNamespace(speed=1.5, waves="intrinsic")
    said = list(command._waves(result({"irregular": one}, current=current)))[1]
    assert said == (
        "the current of 1.5 m/s changes the drift by Fx -5 kN (+33 %), Fy +1 kN, Mz +100 kN m (+25 %) of that in still "
        'water, which current.waves = "still" has; waves are given in intrinsic frequencies'
    )


def test_what_a_line_uses_is_told_with_what_is_allowed():
    one = SimpleNamespace(system=SimpleNamespace(breaking_load=np.array([2e6, np.inf])),
                          utilisation=np.array([0.456, 1]), allowable=0.4)  # fmt: skip
    assert command._used(one, 0) == "46 % of its breaking load (allowable 40 %)"
    assert command._used(one, 1) == "how much of its breaking load is unknown: none is given"
