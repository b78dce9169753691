"""Test whether bodies are far enough from each other for partial waves: the circles around them must not overlap.

An example are two squares of 20 m with 5 m draft in 20 m of water, in one wave. If the squares are 10 m apart, the
circles are 1.7 m apart, and the errors are 3e-4. If the squares are 6 m apart, the circles overlap by 2.3 m, and the
error remains above 3e-3 for any number of orders; if they are 4 m apart, the error remains above 3e-2.  Across a
narrower gap more of the evanescent modes reach the other body.
"""

import numpy as np

SHARE_OF_DEPTH = 0.02  # least water between two circles; of a tolerance of 1e-2 some 50 modes get across


def nearest_circles(axes, radii):
    """Return (i, j, gap): the indices of the two nearest circles, and the width of water between them, m, negative if
    they overlap

    axes : complex, m, (N,); radii : m, (N,)
    """
    axes, radii = np.asarray(axes, complex), np.asarray(radii, float)
    clear = np.abs(axes[:, None] - axes) - radii[:, None] - radii
    np.fill_diagonal(clear, np.inf)
    i, j = sorted(int(n) for n in np.unravel_index(np.argmin(clear), clear.shape))
    return i, j, float(clear[i, j])


def too_near(axes, radii, depth):
    """Return (i, j, description) of two circles whose distance is less than `SHARE_OF_DEPTH` of the depth, m, or None
    if there are no such circles"""
    i, j, clear = nearest_circles(axes, radii)
    if clear >= SHARE_OF_DEPTH * depth:
        return None
    return i, j, f"overlap by {-clear:.3g} m" if clear < 0 else f"are {clear:.3g} m apart"
