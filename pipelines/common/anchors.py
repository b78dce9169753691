"""Anchors at implausible heights: high above the water, or between water and bed."""

import warnings

HIGHEST = 30.0  # m above the water, of a bollard on a quay or of a tower
OFF_BED = 1.0, 0.05  # m, and share of the depth, above the bed: a pile or a frame that stands on it


def warn_of_anchors(heights, depth):
    """Warn of anchors {name: z in m} far above the water, or under water and off the bed at `depth` m (may be inf)."""
    high = [f"{name} (z = {z:g} m)" for name, z in heights.items() if z > HIGHEST]
    if high:
        warnings.warn(
            f"these anchors are above the water: {', '.join(high)}, limit {HIGHEST:g} m, the height of a high "
            "quay; z is 0 at still water and negative below it",
            stacklevel=2,
        )
    limit = max(OFF_BED[0], OFF_BED[1] * depth)
    floating = [f"{name} ({z + depth:.4g} m)" for name, z in heights.items() if limit < z + depth and z < 0]
    if floating:
        warnings.warn(
            f"these anchors are above the bed: {', '.join(floating)}, limit {limit:.3g} m; the bed is at z = "
            f"{-depth:g} m; check their z, or ignore this if they are on piles",
            stacklevel=2,
        )
