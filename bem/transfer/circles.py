"""Whether bodies are far enough from each other for partial waves: the circles around them are apart.

Two squares of 20 m with 5 m draft in 20 m of water, one wave: with 10 m between them (circles 1.7 m apart) errors are
3e-4. With 6 m between them the circles overlap by 2.3 m, and the error stays above 3e-3 for any number of orders; with
4 m it stays above 3e-2.  The narrower the gap, the more of the modes that decay over the depth cross it.
"""

import numpy as np

SHARE_OF_DEPTH = 0.02  # least water between two circles; of a tolerance of 1e-2 some 50 modes get across


def nearest_circles(axes, radii):
    """Return (i, j, m) of the two circles with the least water between them, and the width of this water, m, below 0
    where they overlap

    axes : (N,) complex m; radii : (N,) m
    """
    axes, radii = np.asarray(axes, complex), np.asarray(radii, float)
    clear = np.abs(axes[:, None] - axes) - radii[:, None] - radii
    np.fill_diagonal(clear, np.inf)
    i, j = sorted(int(n) for n in np.unravel_index(np.argmin(clear), clear.shape))
    return i, j, float(clear[i, j])


def too_near(axes, radii, depth):
    """Return (i, j, what they are) of circles that are nearer than `SHARE_OF_DEPTH` of the depth, m, else None"""
    i, j, clear = nearest_circles(axes, radii)
    if clear >= SHARE_OF_DEPTH * depth:
        return None
    return i, j, f"overlap by {-clear:.3g} m" if clear < 0 else f"are {clear:.3g} m apart"
