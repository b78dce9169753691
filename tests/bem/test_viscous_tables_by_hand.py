"""The table [viscous] of a scene of one body and of several: whose laws, in which waves, and every refusal."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.viscous import LOSS, Quadratic, Tabulated
from hakobune.bem.viscous_table import Law, Laws, laws_of, viscous_of_text

BOX = {"length": 80.0, "beam": 20.0, "draft": 3.0}
SEVERAL = """
[viscous]
wave_height = 3.0
[[bodies]]
name = "ship"
length = 80.0
beam = 20.0
draft = 3.0
viscous = { pitch = { drag = 7.0 }, roll = "Yamashita" }
[[bodies]]
name = "quay"
fixed = true
viscous = { roll = { drag = 1.0 } }
[[bodies]]
name = "buoy"
shape = "buoy"
radius = 4.0
draft = 2.0
viscous = { heave = { drag = 5.0 } }
[[bodies]]
name = "bare"
length = 10.0
beam = 4.0
draft = 1.0
"""


def test_laws_of_several_bodies_are_those_of_each_that_moves_in_waves_of_half_the_height():
    found = viscous_of_text(SEVERAL, {}, 1000.0, 10.0)
    assert found.wave_amplitude == 1.5
    assert found.names == tuple(f"{name}__{dof}" for name in ("ship", "buoy", "bare") for dof in DOFS)
    assert set(found.laws) == {"ship__Pitch", "ship__Roll", "buoy__Heave"}
    assert found.laws["ship__Pitch"] == Quadratic(7.0) and found.laws["buoy__Heave"] == Quadratic(5.0)
    # B/d = 6⅔: b_R √ξ_B of 1° a third of the way from 0.0155 to 0.0276
    yamashita = 1000 * 80 * 20 * 3 * 10**2 * (0.0155 + (0.0276 - 0.0155) / 3) / (LOSS * np.radians(1.0))
    assert found.laws["ship__Roll"].drag == pytest.approx(yamashita)
    N = found.damping(2.0, np.arange(1.0, 19))
    assert np.count_nonzero(N) == 3
    assert N[4, 4] == pytest.approx(LOSS * 2.0 * 5.0 * 7.0) and N[8, 8] == pytest.approx(LOSS * 2.0 * 9.0 * 5.0)


def test_one_body_in_a_list_is_one_body():
    text = '[viscous]\nwave_height = 5.0\nroll = "Yamashita"\n[[bodies]]\nname = "ship"\n'
    found = viscous_of_text(text, BOX, 1000.0, 10.0)
    assert found.wave_amplitude == 2.5 and found.names == DOFS and set(found.laws) == {"Roll"}


def test_a_wave_height_without_any_law_is_refused():
    bare = 'shape = "mesh"\nfile = "hull.msh"\n'
    text = f'[viscous]\nwave_height = 3.0\n[[bodies]]\nname = "a"\n{bare}[[bodies]]\nname = "b"\n{bare}'
    with pytest.raises(ValueError, match="viscous has a wave height, but no body has a damping law; give"):
        viscous_of_text(text, {}, 1000.0, 10.0)


def test_tables_of_b_are_in_metres_of_heave_and_degrees_of_roll_and_pitch():
    """b of the report over ρBdL √(B/2g), in roll times (B/2)², in pitch with length and beam exchanged"""
    table = Laws(heave=Law(amplitudes=[0.5, 1.0], b=[0.02, 0.05]), roll=Law(amplitudes_deg=[2.0, 4.0], b=[0.1, 0.2]),
                 pitch=Law(amplitudes_deg=[1.0], b=[0.3]))  # fmt: skip
    found = laws_of("viscous", table, BOX, 1000.0, 10.0)
    assert found["Heave"] == Tabulated(4.8e6, (0.5, 1.0), (0.02, 0.05))
    assert found["Roll"].scale == 4.8e8 and found["Roll"].amplitudes == pytest.approx(np.radians([2.0, 4.0]))
    assert found["Pitch"].scale == pytest.approx(4.8e6 * 2 * 1600) and found["Pitch"].values == (0.3,)
    half_way = found["Heave"].equivalent(0.5, 0.75)
    assert half_way == pytest.approx(4.8e6 * 0.25 * 0.035)
    assert found["Heave"].equivalent(0.5, 0.25) == pytest.approx(4.8e6 * 0.25 * 0.01)  # 0 at rest
    assert found["Heave"].equivalent(0.5, 9.0) == pytest.approx(4.8e6 * 0.25 * 0.05)  # and constant beyond


@pytest.mark.parametrize("table, box, words", [
    (Laws(), BOX, "viscous has no damping law; give one for heave, roll or pitch"),
    (Laws(roll="Ikeda"), BOX, "viscous.roll is 'Ikeda'; allowed: Yamashita, or a table of drag or b"),
    (Laws(roll="Yamashita"), {}, "viscous.roll: b needs the length, beam and draft of a box; give drag"),
    (Laws(pitch=Law()), BOX, "viscous.pitch: give one of drag, b"),
    (Laws(pitch=Law(drag=1.0, b=[1.0])), BOX, "viscous.pitch: give one of drag, b"),
    (Laws(heave=Law(drag=-1.0)), BOX, "viscous.heave.drag is -1; allowed: at least 0, finite"),
    (Laws(heave=Law(drag=np.inf)), BOX, "viscous.heave.drag is inf; allowed: at least 0, finite"),
    (Laws(heave=Law(b=[1.0])), BOX, "viscous.heave.b must have amplitudes and nothing else"),
    (Laws(heave=Law(b=[1.0], amplitudes_deg=[1.0])), BOX, "viscous.heave.b must have amplitudes and nothing else"),
    (Laws(roll=Law(b=[1.0], amplitudes=[1.0])), BOX, "viscous.roll.b must have amplitudes_deg and nothing else"),
    (Laws(roll=Law(b=[1.0], amplitudes=[1.0], amplitudes_deg=[1.0])), BOX, "must have amplitudes_deg and nothing else"),
    (Laws(heave=Law(b=[1.0], amplitudes=[1.0])), {}, "viscous.heave: b needs the length, beam and"),
    (Laws(heave=Law(b=[1.0, 2.0], amplitudes=[1.0])), BOX, "above 0, and each amplitude needs one b ≥ 0"),
    (Laws(heave=Law(b=[1.0, 2.0], amplitudes=[0.0, 1.0])), BOX, "amplitudes must increase from above 0"),
    (Laws(heave=Law(b=[1.0, 2.0], amplitudes=[2.0, 1.0])), BOX, "amplitudes must increase from above 0"),
    (Laws(heave=Law(b=[1.0, -2.0], amplitudes=[1.0, 2.0])), BOX, "amplitudes must increase from above 0"),
    (Laws(heave=Law(b=[], amplitudes=[])), BOX, "amplitudes must increase from above 0"),
])  # fmt: skip
def test_a_law_that_says_nothing_or_too_much_is_refused(table, box, words):
    with pytest.raises(ValueError) as refused:
        laws_of("viscous", table, box, 1000.0, 10.0)
    assert words in str(refused.value)


def test_no_drag_and_no_b_are_allowed():
    found = laws_of("viscous", Laws(heave=Law(drag=0.0), pitch=Law(b=[0.0], amplitudes_deg=[1.0])), BOX, 1000.0, 10.0)
    assert found["Heave"].equivalent(1.0, 1.0) == 0.0 and found["Pitch"].equivalent(1.0, 1.0) == 0.0
