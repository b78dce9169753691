"""Whether bodies are far enough from each other for partial waves: the circles around them are apart.

Two squares of 20 m × 5 m in 20 m of water, one wave: errors are 3e-4 with 10 m between them, their circles 1.7 m apart;
with 6 m, circles that overlap by 2.3 m, no number of orders leaves less than 3e-3; with 4 m, 3e-2.  In chains whose
circles nearly touch, the error falls like 2⁻ᵐ.
"""

from __future__ import annotations

import numpy as np


def overlapping(axes, radii):
    """(i, j, m) of the two circles that overlap most and by how much, None where all are apart

    axes : (N,) complex m; radii : (N,) m
    """
    axes, radii = np.asarray(axes, complex), np.asarray(radii, float)
    clear = np.abs(axes[:, None] - axes) - radii[:, None] - radii
    np.fill_diagonal(clear, np.inf)
    i, j = sorted(int(n) for n in np.unravel_index(np.argmin(clear), clear.shape))
    return (i, j, -float(clear[i, j])) if clear[i, j] <= 0 else None
