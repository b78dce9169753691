"""The buoy of a single point and its lines: weights, stiffness and pretension in SI units, and each limit."""

import math

import numpy as np
import pytest
from test_head_on_by_hand import DEPTH, Z
from test_loads_by_hand import raw

from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.parts import Anchor
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.single_point.study import mass_of, system_of
from hakobune.pipelines.single_point.tables import make_study

RHO, G = 1025.0, 9.80665
KG = 200.0  # kg/m in water
HEIGHT = DEPTH + Z  # m, of the buoy above the bed
TYPE = {"weight_kg_per_m": KG, "breaking_load_kN": 5e3}
BUOY = {"buoy__mass": 100.0, "buoy__diameter": 8.0, "buoy__height": 5.0}


def system(**changes):
    return system_of(make_study(raw(types__chain=TYPE, **changes)), DEPTH, RHO)


def anchors_of(made):
    """(n, 3) m"""
    return np.array([point.position for point in made.points if isinstance(point, Anchor)])


def test_lines_weigh_what_their_mass_does_and_pull_with_their_pretension():
    """w = 200 g N/m; V = w s, s = √(h (h + 2 H/w)) of a chain that lies on the bed"""
    made, left = system(mooring__pretension_kN=300.0)
    assert [line.type.weight for line in made.lines] == pytest.approx([KG * G] * 4) and left == math.inf
    assert (made.depth, made.density, made.gravity) == (DEPTH, RHO, G)
    anchors = anchors_of(made)
    s = math.sqrt(HEIGHT * (HEIGHT + 2 * 300e3 / (KG * G)))
    L = made.lines[0].length
    reach = L - s + 300e3 / (KG * G) * math.asinh(KG * G * s / 300e3)
    assert np.hypot(*anchors[:, :2].T) == pytest.approx(np.full(len(anchors), reach), rel=1e-4)


def test_a_buoy_of_its_own_weight_floats_on_its_waterplane():
    """C = ρg π D²/4; it may sink by its height less the draft of its mass"""
    made, left = system(**BUOY)
    (body,) = made.bodies
    area = math.pi * 16
    assert (
        body.hydrostatic_stiffness[2, 2] == pytest.approx(RHO * G * area)
        and np.count_nonzero(body.hydrostatic_stiffness) == 1
    )
    assert left == pytest.approx(5.0 - 100e3 / (RHO * area)) and body.freedom == ("Surge", "Sway", "Heave")
    assert system()[0].bodies[0].freedom == ("Surge", "Sway")


@pytest.mark.parametrize("share, good", [(0.999, True), (1.001, False)])
def test_a_buoy_weighs_less_than_it_displaces_when_awash(share, good):
    whole = RHO * math.pi * 16 * 5.0 / 1e3
    if good:
        assert system(**BUOY | {"buoy__mass": share * whole})[1] == pytest.approx(0.005, rel=1e-6)
        return
    with pytest.raises(StudyError, match=f"allowed: below {whole:.4g} t, its buoyancy when awash"):
        system(**BUOY | {"buoy__mass": share * whole})


def test_a_buoy_is_given_whole_or_not_at_all():
    for name in BUOY:
        with pytest.raises(StudyError, match="buoy: mass, diameter and height belong together; give all or none"):
            system(**{key: value for key, value in BUOY.items() if key != name})


def test_the_tension_at_the_top_is_the_horizontal_one_and_the_weight_below():
    """T = H + w h of a chain that does not stretch: H of 300 kN"""
    top = 300.0 + KG * G * HEIGHT / 1e3
    anchors = [
        anchors_of(made)
        for made, _ in (
            system(mooring__pretension_kN=None, mooring__top_tension_kN=top), system(mooring__pretension_kN=300.0),
        )
    ]  # fmt: skip
    assert anchors[0] == pytest.approx(anchors[1], rel=1e-3)
    least = KG * G * HEIGHT / 1e3
    system(mooring__pretension_kN=None, mooring__top_tension_kN=1.02 * least)
    with pytest.raises(StudyError, match=f"allowed: above {least:.4g} kN, the line's weight from the bed to the buoy"):
        system(mooring__pretension_kN=None, mooring__top_tension_kN=0.999 * least)
    for given in ({"mooring__top_tension_kN": top}, {"mooring__pretension_kN": None}):
        with pytest.raises(StudyError, match="mooring: give either pretension"):
            system(**given)


@pytest.mark.parametrize("factor, good", [(1.001, True), (0.999, False)])
def test_lines_reach_from_the_buoy_to_the_bed(factor, good):
    if good:
        system(mooring__length=factor * HEIGHT)
        return
    with pytest.raises(StudyError, match=f"cannot reach the bed {HEIGHT:g} m below the buoy; lengthen them"):
        system(mooring__length=factor * HEIGHT)


def test_lines_spread_evenly_from_the_first():
    """Five from 10°: 10, 82, 154, 226, 298"""
    made, _ = system(mooring__headings_deg=None, mooring__count=5, mooring__first_deg=10.0)
    anchors = anchors_of(made)
    at = np.degrees(np.arctan2(anchors[:, 1], anchors[:, 0])) % 360
    assert np.sort(at) == pytest.approx([10, 82, 154, 226, 298])


@pytest.mark.parametrize("rise, good", [(0.0, True), (DEPTH - 0.1, True), (DEPTH + 0.1, False)])
def test_a_bed_of_the_lines_begins_at_the_depth_and_stays_below_still_water(rise, good):
    bed = {"points": [[0.0, -3.0], [900.0, -3.0], [1000.0, rise - 3.0]]}
    if good:
        made = system(mooring__bed=bed)[0]
        assert anchors_of(made)[:, 2] == pytest.approx(np.full(len(made.lines), -DEPTH))
        assert made.lines[0].bed.points[-1].tolist() == [1000.0, rise]
        return
    with pytest.raises(StudyError, match=rf"mooring.bed.points\[2\] .*0.1 m above still .* anchor, {DEPTH:g} m below"):
        system(mooring__bed=bed)


def test_a_buoy_with_its_draft_with_lines_lies_at_its_place_with_the_mass_that_balances():
    """ρ π D²/4 · 2 m carry the mass and the four lines, which pull with V = w s down at the place of the buoy"""
    made, left = system(mooring__pretension_kN=300.0, **BUOY | {"buoy__mass": None, "buoy__draft": 2.0})
    s = math.sqrt(HEIGHT * (HEIGHT + 2 * 300e3 / (KG * G)))
    up = 4 * KG * G * s / (RHO * G * math.pi * 16)
    assert made.bodies[0].position[2] == pytest.approx(Z + up, rel=1e-3) and left == pytest.approx(
        5.0 - 2.0 + up, rel=1e-3
    )
    assert rest(made).position[0, 2] == pytest.approx(Z, abs=1e-9)
    buoy = make_study(raw(types__chain=TYPE, **BUOY | {"buoy__mass": None, "buoy__draft": 2.0})).buoy
    assert mass_of(buoy, made) == pytest.approx(RHO * math.pi * 16 * (2.0 - up), rel=1e-3)


@pytest.mark.parametrize("more, said", [
    ({"buoy__draft": 2.0}, "mass and draft are both given"),
    ({"buoy__mass": None, "buoy__draft": 0.1}, r"buoy.draft is 0.1 m; allowed: above [\d.]+ m, the draft that the"),
    ({"buoy__mass": None, "buoy__draft": 5.0}, "buoy.draft is 5 m; allowed: below the height of 5 m"),
])  # fmt: skip
def test_a_draft_that_cannot_be_is_refused(more, said):
    with pytest.raises(StudyError, match=said):
        system(mooring__pretension_kN=300.0, **BUOY | more)
