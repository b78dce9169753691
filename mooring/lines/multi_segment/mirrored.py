"""A line that slides past the foot of its fairlead, down a bed that falls from its anchor: mirrored, that bed rises.

On a facet that falls from the anchor more steeply than friction holds, what is more than the line needs slides down
and hangs in a bight farther down than the fairlead; both of its legs pull the line's ends there, so that H < 0 at the
fairlead.  With x turned round this is the bight below the anchor of a bed that rises (`on_bed`), and solved as that.
"""

from __future__ import annotations

import numpy as np

FORCES = [0, 2]  # columns of `newton.store` that turn with x: H at both ends
STIFFNESS = [6, 7]  # and ∂H/∂z, ∂V/∂x


def slides_beyond(bed):
    """Whether a line without tension slides down the first facet of a `Bed`, or of None, away from its anchor"""
    return bed is not None and float(bed.slopes[0]) < -(bed.friction + 1e-12)


def farthest(bed):
    """m, up to which the first facet goes"""
    return np.inf if len(bed.points) == 2 else float(bed.points[1, 0])


def turned(row, pieces):
    """A row of `newton.store`, and pieces (n, 11), of the mirrored line as those of the line itself"""
    row, out = row.copy(), pieces.copy()
    row[FORCES + STIFFNESS] *= -1.0
    out[:, 3] *= -1.0
    free = out[:, 0] == 0
    out[free, 5] *= -1.0
    out[~free, 10] = np.pi - out[~free, 10]
    return row, out
