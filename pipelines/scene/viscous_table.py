"""What a scene's table [viscous] means for its body, once the scene is seen to have what it needs."""

from __future__ import annotations

import math

from hakobune.bem.viscous_table import viscous_of_table


def viscous_of(scene):
    """`bem.viscous.Viscous` of a scene, None if it has none.  Raises ValueError, one line."""
    table = scene.viscous
    if table is None:
        return None
    if not 0 < table.wave_height < math.inf:
        raise ValueError(f"viscous.wave_height is {table.wave_height:g} m; allowed: above 0, finite")
    if scene.several:
        raise ValueError("viscous damping is of a scene of one body; leave [viscous] out")
    if not scene.motions_known:
        raise ValueError("viscous damping needs motions; give gyration (--gyration)")
    box = scene.dimensions if scene.body.shape == "box" else {}
    return viscous_of_table(table, box, scene.water.density, scene.water.gravity)
