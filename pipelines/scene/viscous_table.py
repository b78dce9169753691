"""Meaning of a scene's table [viscous] for its body, after a check of the needed data."""

import math

import msgspec

from hakobune.bem.viscous_table import MODES, box_of, viscous_of_several, viscous_of_table


def viscous_of(scene):
    """`bem.viscous.Viscous` of a scene, None if the scene has no viscous damping.  Raises ValueError, with a message
    of one line."""
    table = scene.viscous
    if table is None:
        return None
    if not 0 < table.wave_height < math.inf:
        raise ValueError(f"viscous.wave_height is {table.wave_height:g} m; allowed: above 0, finite")
    if not scene.motions_known:
        raise ValueError("viscous damping needs motions; give gyration (--gyration)")
    if scene.several:
        if any(getattr(table, mode) is not None for mode in MODES):
            raise ValueError(
                "viscous has a damping law, but there are several bodies; give it under [bodies.viscous] of each"
            )
        moving = [body for body in scene.bodies if not body.fixed]
        rows = [(body.name, body.viscous, box_of(msgspec.to_builtins(body))) for body in moving]
        return viscous_of_several(table, rows, scene.water.density, scene.water.gravity)
    box = scene.dimensions if scene.body.shape == "box" else {}
    return viscous_of_table(table, box, scene.water.density, scene.water.gravity)
