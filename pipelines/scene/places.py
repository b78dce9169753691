"""Places of the bodies of a scene: coordinates of the scene and of each body."""

import math

import numpy as np

from hakobune.bem.modes import Body


def bodies_of(scene):
    """`bem.modes.Body` of each of several bodies, empty for a single body"""
    if not scene.several:
        return ()
    return tuple(
        Body(body.name, _center(body), math.radians(body.place[2]), body.fixed, tuple(map(float, body.place[:2])))
        for body in scene.bodies
    )


def in_scene(body, point):
    """Point in coordinates of the scene, m, given in coordinates of a body; shape (3,)"""
    x, y, angle = body.place[0], body.place[1], math.radians(body.place[2])
    turn = np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
    return turn @ np.asarray(point, float) + (x, y, 0.0)


def _center(body):
    return tuple(float(x) for x in in_scene(body, body.rotation_center or (0.0, 0.0, 0.0)))
