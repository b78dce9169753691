"""Parts of a line out of the water whose weight counts as submerged, at rest or during a run."""

import warnings

import numpy as np

from .in_air import IN_AIR


def warn_of_air(line, result):
    """Warn of a DynamicLine without a surface whose fairlead or floating part is out of the water in a Result."""
    if line.surface:
        return
    z = result.frames[:, :, 2]
    _warn_of_fairlead(line, result.frame_time, z)
    _warn_of_floating(line, result.frame_time, z)


def _warn_of_fairlead(line, time, z):
    top = int(np.argmax(z[:, -1]))
    if z[top, -1] > IN_AIR * line.length:
        warnings.warn(
            f"the fairlead is {z[top, -1]:.3g} m above still water {_when(time, top)}; allowed: {IN_AIR:.0%} of "
            f"the line, {IN_AIR * line.length:.3g} m; the line is computed as if it were under water; with surface "
            "= true its part above the surface has its weight in air and no water loads",
            stacklevel=3,
        )


def _warn_of_floating(line, time, z):
    """Warn of nodes that rise above still water and both ends: only their buoyancy, or a whip, can hold them there."""
    above = z[:, 1:-1] - np.maximum(0.0, np.maximum(z[:, 0], z[:, -1]))[:, None]
    limit = max(segment.diameter for segment in line.segments)
    top = 0 if above[0].max() > limit else int(np.argmax(above.max(axis=1)))  # the state at rest has priority
    node = 1 + int(np.argmax(above[top]))
    if above[top, node - 1] > limit:
        warnings.warn(
            f"the line is {z[top, node]:.3g} m above still water {_when(time, top)}, {line.nodes[node]:.4g} m "
            "from the anchor, but it is computed as if it were under water; allowed: up to its diameter, "
            f"{limit:.3g} m; with surface = true its part above the surface has its weight in air and no water loads",
            stacklevel=3,
        )


def _when(time, frame):
    return "at rest" if frame == 0 else f"at t = {time[frame]:.2f} s"
