"""How a curve's slope jumps: the second difference over the step, which falls with the step where the slope is
continuous and stays where it is not."""

import numpy as np


def slope_jump(curve, places, step):
    """max |f(x+s) − 2f(x) + f(x−s)| / s over the places (n,)"""
    below, here, above = (np.array([curve(x) for x in places + shift]) for shift in (-step, 0.0, step))
    return np.max(np.abs(above - 2 * here + below)) / step


def assert_slope_is_continuous(curve, places, step=1e-3):
    jumps = [slope_jump(curve, places, s) for s in (step, step / 10, step / 100)]
    assert jumps[1] < 0.2 * jumps[0] and jumps[2] < 0.2 * jumps[1], jumps
