"""A breakwater by hand: energies of its lines, anchors of its tensions, limits of what is a body."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from hakobune.mooring.breakwater import anchors, unit
from hakobune.mooring.breakwater.body import FloatingBody, TautBody
from hakobune.mooring.breakwater.elastic import elastic_exact, stiffness_of
from hakobune.mooring.breakwater.snap import snap
from hakobune.mooring.breakwater.taut import TautRectangle, warn_if_unstable
from hakobune.mooring.studies.breakwater.breakwater import (
    Body,
    Breakwater,
    BreakwaterError,
    Lines,
    Section,
    Water,
    Waves,
)

AFLOAT = dict(
    mass=2.4e4, z0=-1.2, inertia=2e5, area=30.0, buoyancy_z=-1.5, waterline=9.0, draft=4.0, depth=12.0, density=1000.0,
    gravity=10.0,
)  # fmt: skip
HELD = dict(angle=0.9, attachment=4.0, attachment_z=-3.0, line=11.0)
BODY = TautBody(**AFLOAT, **HELD)
LENGTH, CENTER, EA = 20.0, -0.7, 3e6


def of_energy(motion, spacing):
    """J of all lines at surge, sway, heave and rotation vector: each S long with the pull P₀ + EA/S of its stretch"""
    count = round(LENGTH / spacing)
    anchored = np.array([np.cos(BODY.angle), -np.sin(BODY.angle)]) * BODY.line
    turn, total = Rotation.from_rotvec(motion[3:]).as_matrix(), 0.0
    for i in range(count):
        for side in (-1.0, 1.0):
            end = np.array([(i + 0.5) * spacing - LENGTH / 2, side * BODY.attachment, BODY.attachment_z - CENTER])
            fixed = end + [0.0, side * anchored[0], anchored[1]]
            stretch = np.linalg.norm(motion[:3] + turn @ end - fixed) - BODY.line
            total += spacing * (BODY.pretension * stretch + EA / BODY.line * stretch**2 / 2)
    return total


def test_stiffness_of_lines_is_the_second_derivative_of_their_energy():
    h, ours = 1e-3, unit.line_matrix(BODY, LENGTH, CENTER, 5.0, EA)
    steps = h * np.eye(6)
    found = np.array(
        [
            [sum(a * b * of_energy(a * p + b * q, 5.0) for a in (-1, 1) for b in (-1, 1)) / (4 * h * h) for q in steps]
            for p in steps
        ]
    )
    scale = np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert ours / scale == pytest.approx(found / scale, abs=1e-5)


def test_tensions_of_a_motion_are_what_the_lines_stretch():
    """EA/S times the change of their lengths, front (−y) and back, in heave, in roll, and along the body in pitch"""
    c, s, spring = math.cos(0.9), math.sin(0.9), EA / 11.0
    heave, roll, pitch = (unit.tensions(BODY, LENGTH, CENTER, 10.0, EA, 0.1 * np.eye(6)[i]) for i in (2, 3, 4))
    assert heave == pytest.approx(np.full((2, 2), 0.1 * spring * s))
    arm = -(-3.0 - CENTER) * c  # of y = −φ z at the ends, which stretches the line on the side that it leaves
    expected = 0.1 * spring * np.array([[arm - 4.0 * s] * 2, [4.0 * s - arm] * 2])
    assert roll == pytest.approx(expected)
    assert pitch == pytest.approx(0.1 * spring * s * np.array([[5.0, -5.0]] * 2))


def test_pairs_stand_in_the_middle_of_their_shares():
    x, share = unit.pairs(20.0, 4.9)
    assert (x, share) == (pytest.approx([-7.5, -2.5, 2.5, 7.5]), 5.0)
    x, share = unit.pairs(20.0, 90.0)
    assert (x, share) == (pytest.approx([0.0]), 20.0)


def test_buoyancy_of_a_unit_is_that_of_its_waterplane_and_of_weights_above_one_another():
    """ρg (∫y² dA + V z_B) − m g z₀ about the centre; heave ρg B L; nothing else"""
    found = unit.buoyancy(BODY, LENGTH, CENTER)
    upright = 1e4 * 30 * 20 * (-1.5 + 0.7) - 2.4e4 * 20 * 10 * (-1.2 + 0.7)
    expected = np.diag([0, 0, 1e4 * 9 * 20, 1e4 * 20 * 9**3 / 12 + upright, 1e4 * 9 * 20**3 / 12 + upright, 0])
    assert found == pytest.approx(expected)


def test_pretension_holds_what_the_body_displaces_beyond_its_weight():
    assert 2 * BODY.pretension * math.sin(0.9) == pytest.approx(10 * (1000 * 30 - 2.4e4))
    assert BODY.radius == pytest.approx(math.sqrt(2e5 / 2.4e4))
    assert BODY.heave_stiffness == pytest.approx(9e4)
    assert BODY.roll_stiffness == pytest.approx(1e4 * (9**3 / 12 + 30 * (-1.5 + 1.2)))


@pytest.mark.parametrize("degrees", [50, 90, 115])
def test_lines_that_hardly_stretch_leave_the_stiffness_of_the_one_motion_they_allow(degrees):
    """q of the constraint of `taut` is the softest motion: its K is qᵀ K q, lines unstretched"""
    body = TautBody(**AFLOAT, **(HELD | {"angle": math.radians(degrees)}))
    stiffness, stretch = stiffness_of(body, EA)
    allowed = np.array([body.mode[0], 0.0, body.mode[1]])
    assert stretch @ allowed == pytest.approx([0.0, 0.0], abs=1e-6 * abs(stretch).max())
    assert allowed @ stiffness @ allowed == pytest.approx(body.stiffness)
    assert np.delete(stiffness @ allowed, 1) == pytest.approx(body.restoring)


def test_difference_of_tensions_gives_the_force_that_does_no_work_on_the_mode():
    """(P_B − P_F){cos α, −X} of both lines; any such force comes back"""
    for scale in (1.0, -3.0):
        force = scale * np.array([math.cos(0.9), -BODY.mode[0]])
        assert force @ BODY.mode == pytest.approx(0.0, abs=1e-12)
        assert BODY.line_difference(force) == pytest.approx(scale)


def test_anchors_of_tensions_by_hand():
    """Chapter 6"""
    assert anchors.pretension_needed(5e4, 8e4) == pytest.approx(13e4)
    assert list(anchors.goes_slack(10.0, 2.0, [7.9, 8.1])) == [False, True]
    assert anchors.sinker(100.0, math.radians(60), 0.5) == pytest.approx(100.0)
    assert anchors.sinker(100.0, math.radians(60), 0.5, lifted=True) == pytest.approx(100 + 50 * math.sqrt(3))
    assert anchors.sinker_height(900.0, 3.0, 12.0) == pytest.approx(25.0)
    assert anchors.pile_capacity(1.5, 20.0, 6.0) == pytest.approx(60.0)
    assert anchors.pile_capacity(1.5, 20.0, 6.0, 2.0) == pytest.approx(90.0)
    assert anchors.pile_spacing(60.0, 10.0, math.radians(30)) == pytest.approx(12.0)


@pytest.mark.parametrize("phase", [0.0, 0.7, 2.0, math.pi])
def test_a_common_sinker_holds_the_greatest_of_a_whole_period(phase):
    t = np.linspace(0, 2 * math.pi, 20001)
    wave = np.exp(1j * t)
    across, up = 3.0, 2.0 * np.exp(1j * phase)
    highest = (np.abs((across * wave).real) / 0.4 + (up * wave).real).max()
    assert anchors.common_sinker(across, up, 0.4) == pytest.approx(highest, rel=1e-6)


@pytest.mark.parametrize(
    ("fine", "wrong", "says"),
    [
        (lambda: anchors.pretension_needed(0.0, 1), lambda: anchors.pretension_needed(-1.0, 1), "amplitude is -1 N/m"),
        (lambda: anchors.sinker(1, 1, 1e-3), lambda: anchors.sinker(1, 1, 9e-4), "friction is 0.0009; allowed: 0.001"),
        (lambda: anchors.common_sinker(1, 1, 1e-3), lambda: anchors.common_sinker(1, 1, 9e-4), "friction is 0.0009"),
        (lambda: anchors.sinker_height(1, 1e-3, 1), lambda: anchors.sinker_height(1, 9e-4, 1), "width is 0.0009 m"),
        (lambda: anchors.sinker_height(1, 1, 1e-3), lambda: anchors.sinker_height(1, 1, 9e-4), "unit weight is 0.0009"),
        (lambda: anchors.pile_capacity(1, 1, 1, 1.0), lambda: anchors.pile_capacity(1, 1, 1, 0.9), "safety is 0.9"),
        (lambda: FloatingBody(**AFLOAT), lambda: FloatingBody(**AFLOAT | {"mass": 0.0}), "mass is 0; allowed: above 0"),
        (lambda: FloatingBody(**AFLOAT | {"depth": 4.01}), lambda: FloatingBody(**AFLOAT | {"depth": 4.0}),
         "depth is 4 m at draft 4 m"),
        (lambda: TautBody(**AFLOAT, **HELD | {"angle": 3.14}), lambda: TautBody(**AFLOAT, **HELD | {"angle": math.pi}),
         "lines are at 180°"),
        (lambda: TautBody(**AFLOAT, **HELD | {"angle": 0.01}), lambda: TautBody(**AFLOAT, **HELD | {"angle": 0.0}),
         "lines are at 0°"),
        (lambda: TautBody(**AFLOAT, **HELD | {"line": 0.1}), lambda: TautBody(**AFLOAT, **HELD | {"line": 0.0}),
         "line is 0 m"),
        (lambda: TautBody(**AFLOAT | {"mass": 30000.0}, **HELD), lambda: TautBody(**AFLOAT | {"mass": 30001.0}, **HELD),
         "the mass is 30001 kg/m and the displaced mass 30000 kg/m: the pretension is"),
    ],
)  # fmt: skip
def test_what_is_allowed_and_what_is_not(fine, wrong, says):
    fine()
    with pytest.raises(ValueError) as caught:
        wrong()
    assert says in str(caught.value) and "\n" not in str(caught.value)


def rectangle(**change):
    sizes = dict(half=5.0, draft=5.0, free_draft=3.4, depth=10.0, z0=-1.6, inertia=6e5, angle=1.0, attachment=5.0)
    return TautRectangle(**sizes | {"line": 5.9} | change)


def test_a_rectangle_may_float_as_deep_as_it_is_held_and_no_deeper():
    assert rectangle(free_draft=5.0).pretension == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(ValueError, match="free draft"):
        rectangle(free_draft=5.01)
    body = rectangle()
    assert (body.mass, body.area) == pytest.approx((1025 * 10 * 3.4, 50.0))
    afloat = body.afloat
    assert (afloat.z0, afloat.draft, afloat.area, afloat.buoyancy_z) == pytest.approx((0.0, 3.4, 34.0, -1.7))
    assert afloat.mass == pytest.approx(1025 * afloat.area) and afloat.inertia == 6e5


def test_of_an_unstable_body_one_is_warned_and_of_a_stable_one_not(recwarn):
    low, high = -4.0, 12.0  # its centre of gravity
    while high - low > 1e-6:
        z0 = (low + high) / 2
        low, high = (z0, high) if rectangle(z0=z0).stiffness > 0 else (low, z0)
    warn_if_unstable(rectangle(z0=low - 1e-3))
    assert not recwarn
    with pytest.warns(UserWarning, match="upright position is unstable"):
        warn_if_unstable(rectangle(z0=high + 1e-3))


def test_lines_that_would_stretch_by_half_and_more_are_refused():
    P = BODY.pretension
    for EA, amplitude, says in (
        (1.99 * P, 0.1, "more than half"),
        (0.0, 0.1, "EA is 0 N per metre"),
        (1e6, -0.1, "amplitude"),
    ):
        with pytest.raises(ValueError, match=says):
            snap(BODY, [], EA, 1.0, amplitude)
    with pytest.raises(ValueError, match="EA is 0 N per metre"):
        elastic_exact(BODY, None, 0.0)


@pytest.mark.parametrize("body, pretension, says", [
    ({"mass": 71.75e3}, None, ""), ({"mass": -8000.0}, None,
     "body.mass is -8 t/m: the body would weigh -8 t/m; allowed: above 0"),
    ({"mass": 72e3}, None, "body.mass is 72 t/m: the body weighs 72 t/m and displaces 71.75 t/m at least"),
    ({"free_draft": 3.5}, None, ""),
    ({"free_draft": 4.5}, None,
     "body.free_draft is 4.5 m: the body weighs 92.25 t/m and displaces 71.75 t/m at least"),
    ({}, 1.1e5, ""), ({}, 1e6, "lines.pretension is 1000 kN/m: the body would weigh -18 t/m; allowed: above 0"),
])  # fmt: skip
def test_a_breakwater_weighs_something_and_no_more_than_it_displaces_at_low_water(body, pretension, says):
    """20 m wide, 4 m of draft and 0.5 m of tide; g of 10 m/s² and lines at 30° take P₀/10 kg"""
    made = (
        Water(12.0, 0.5, 1025.0, 10.0), Section("rectangle", 4.0, beam=20.0, height=6.0),
        Waves(1.0, np.array([6.0])), Body(2.0, 5.0, **body),
        Lines(math.radians(30.0), 10.0, pretension=pretension),
    )  # fmt: skip
    if says:
        with pytest.raises(BreakwaterError) as refused:
            Breakwater(*made)
        assert str(refused.value).startswith(says)
        return
    wanted = 71.75e3 if pretension is None else 82e3 - pretension / 10.0
    assert Breakwater(*made).mass == pytest.approx(wanted)
