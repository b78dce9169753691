"""Lines partly above the water at rest, where their weight is computed as if submerged."""

import numpy as np

from ..lines.system.hawser import Hawser
from ..lines.system.parts import CompositeLine
from ..lines.system.shapes import line_shapes

IN_AIR = 0.01  # part of a line above the water that is not reported


def dry_shares(state):
    """Fraction of the length of every line of a SystemEquilibrium above still water, from straight pieces; shape
    (n,)
    """
    shares = []
    for shape in line_shapes(state):
        length, z = np.linalg.norm(np.diff(shape, axis=0), axis=1), shape[:, 2]
        low, high = np.minimum(z[1:], z[:-1]), np.maximum(z[1:], z[:-1])
        rise = np.where(high > low, high - low, 1.0)
        above = np.where(high > low, np.clip(high / rise, 0.0, 1.0), high > 0)
        shares.append(float(length @ above / max(length.sum(), 1e-300)))
    return np.array(shares)


def lines_in_air(state):
    """A message on lines of which more than a hundredth is above the water"""
    shares = dry_shares(state)
    told = [
        f"{line.name} over {share:.3g} of it"
        for line, share in zip(state.system.lines, shares, strict=True)
        if share > IN_AIR and _weighs_as_in_water(line, state.system.gravity)
    ]
    if told:
        yield (
            f"these lines are above still water with their weight in water: {', '.join(told)}; limit {IN_AIR:g}; "
            "lower the end that is in the air, or give the weight in air to a line that is dry throughout"
        )


def _weighs_as_in_water(line, gravity):
    if isinstance(line, Hawser) or getattr(line, "weight_in_air", None) is not None:
        return False
    if isinstance(line, CompositeLine):
        return True
    kind = line.type
    return kind.weight > 0 and (kind.mass is None or kind.weight < (1 - 1e-3) * kind.mass * gravity)
