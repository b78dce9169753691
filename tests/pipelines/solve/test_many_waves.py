"""Scenes with more waves along the body than are resolved without panels."""

import math

import pytest

from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.hull import make_hull

BOX = {"shape": "box", "length": 100.0, "beam": 20.0, "draft": 2.0}
BUOY = {"shape": "buoy", "radius": 50.0, "draft": 2.0}


@pytest.mark.parametrize(("body", "method", "most"), [(BOX, "auto", 200), (BOX, "strip", 200), (BUOY, "auto", 400)])
def test_more_waves_than_are_resolved_are_refused_with_the_shortest_that_is(body, method, most):
    """Waves of λ = 100 m / most over a bed that they do not feel: ω² = 2πg/λ"""
    refused, answered = (math.sqrt(9.80665 * 2 * math.pi * f * most / 100.0) for f in (1.05, 0.95))

    def scene(omega):
        return make_scene(
            {"water": {"depth": 3.0}, "bodies": [body], "waves": {"omegas": [5.0, omega]}, "method": method}
        )

    said = rf"the shortest wave is 0\.\d+ m long and the body 100 m across; allowed: waves of at least {100 / most:g} m"
    with pytest.raises(SceneError, match=said):
        make_hull(scene(refused))
    make_hull(scene(answered))
