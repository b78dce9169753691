"""The table [viscous] of a scene and of a response study."""

import numpy as np
import pytest

from hakobune.bem.viscous import Tabulated, yamashita_roll
from hakobune.pipelines.common.typed import to_toml
from hakobune.pipelines.scene.identity import fixed_part
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.scene.viscous_table import viscous_of

BODY = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.0, 29.0, 32.0]}


def scene(viscous, **body):
    raw = {"water": {"depth": 20.0}, "bodies": [BODY | body], "waves": {"omegas": [0.5]}}
    return make_scene(raw | ({"viscous": viscous} if viscous else {}))


def test_yamashita_is_taken_by_name_at_half_the_wave_height():
    viscous = viscous_of(scene({"wave_height": 3.0, "roll": "Yamashita"}))
    assert viscous.wave_amplitude == 1.5
    assert viscous.laws["Roll"] == yamashita_roll(100.0, 50.0, 10.0, 1025.0)


def test_degrees_of_a_table_become_radians():
    viscous = viscous_of(scene({"wave_height": 3.0, "roll": {"amplitudes_deg": [1.0, 2.0], "b": [0.03, 0.06]}}))
    law = viscous.laws["Roll"]
    assert isinstance(law, Tabulated)
    assert np.allclose(law.amplitudes, np.radians([1.0, 2.0]))


def test_the_table_belongs_to_the_scene_and_survives_as_text():
    with_it, without = scene({"wave_height": 3.0, "heave": {"drag": 1e5}}), scene(None)
    assert fixed_part(with_it) != fixed_part(without)
    import tomllib

    assert make_scene(tomllib.loads(to_toml(with_it))) == with_it


@pytest.mark.parametrize(
    ("viscous", "body", "words"),
    [
        ({"wave_height": -1.0, "roll": "Yamashita"}, {}, "wave_height is -1"),
        ({"wave_height": 1.0}, {}, "has no damping law"),
        ({"wave_height": 1.0, "roll": "Ikeda"}, {}, "'Ikeda'; allowed: Yamashita"),
        ({"wave_height": 1.0, "roll": "Yamashita"}, {"beam": 80.0, "draft": 4.0}, "B/d = 20"),
        ({"wave_height": 1.0, "roll": {"drag": 1.0, "b": [1.0]}}, {}, "one of drag, b"),
        (
            {"wave_height": 1.0, "roll": {"b": [1.0], "amplitudes": [1.0]}},
            {},
            "must have amplitudes_deg and nothing else",
        ),
        (
            {"wave_height": 1.0, "heave": {"b": [1.0, 2.0], "amplitudes": [1.0]}},
            {},
            "viscous damping: amplitudes must increase from above 0, and each amplitude needs one b ≥ 0",
        ),
        ({"wave_height": 1.0, "heave": {"drag": -1.0}}, {}, "drag is -1"),
        ({"wave_height": 1.0, "yaw": {"drag": 1.0}}, {}, "viscous.yaw is unknown"),
        ({"wave_height": 1.0, "roll": "Yamashita"}, {"gyration": None}, "give gyration"),
    ],
)
def test_what_cannot_be_is_one_line(viscous, body, words):
    with pytest.raises(SceneError, match=words) as fault:
        scene(viscous, **body)
    assert "\n" not in str(fault.value)
