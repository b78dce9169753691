"""Head lost under a rectangle that moves: the power that goes, reciprocity, tensions that fall with it."""

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.bem.sections.keel_loss import keel_flow
from hakobune.mooring.breakwater.exact import moved_to_origin
from hakobune.mooring.breakwater.holdings import exact_response, response_with_loss
from hakobune.mooring.breakwater.taut import TautRectangle

RHO, G, DEPTH = 1025.0, 9.80665, 10.0
BODY = TautRectangle(
    half=5.0, draft=5.0, free_draft=3.4, depth=DEPTH, z0=-1.6, inertia=6e5, angle=np.radians(60), attachment=5.0,
    line=5.0 / np.sin(np.radians(60)),
)  # fmt: skip
OMEGA = np.array([0.6, 0.9, 1.2])
FLOWS = [keel_flow(10.0, 5.0, DEPTH, w, tolerance=1e-8) for w in OMEGA]
HELD = [("fixed", None, None), ("taut", BODY, None), ("elastic", BODY, 3e6), ("free", BODY.afloat, None)]


@pytest.mark.parametrize(("holding", "body", "stiffness"), HELD[:3], ids=[one[0] for one in HELD[:3]])
def test_the_power_that_waves_lose_is_the_head_times_the_flow_however_the_body_is_held(holding, body, stiffness):
    """½ ρg a² n (ω/k) (1 − K_T² − K_R²) = ½ (4/3π) ρ C |U|³ s"""
    C, a = 4.0, 0.8
    made = response_with_loss(holding, FLOWS, body, C, a, np.pi / 4, stiffness)
    free = exact_response(holding, [flow.section for flow in FLOWS], body, np.pi / 4, stiffness)
    for i, flow in enumerate(FLOWS):
        motion = np.array([made.sway[i], made.heave[i], made.roll[i]])
        turned = motion if body is None else moved_to_origin(body.z0) @ motion
        through = flow.through(turned)

        def fast(U, through=through, flow=flow):
            return U - a * abs(through / (1 - 2j * C * U / (3 * np.pi * flow.section.omega) * flow.own))

        U = brentq(fast, 0, 100, xtol=1e-13)
        k, kh2 = flow.section.k, 2 * flow.section.k * DEPTH
        n = 0.5 * (1 + kh2 / np.sinh(kh2))
        lost = 1 - abs(made.transmission[i]) ** 2 - abs(made.reflection[i]) ** 2
        work = 2 / (3 * np.pi) * RHO * C * U**3 * 5.0
        assert lost > 0 and work == pytest.approx(RHO * G * a**2 / 2 * n * OMEGA[i] / k * lost, rel=1e-7)
    none = response_with_loss(holding, FLOWS, body, 0.0, a, np.pi / 4, stiffness)
    assert none.transmission == pytest.approx(free.transmission, abs=1e-12)


def test_what_a_head_pushes_is_what_a_motion_sends_through():
    for flow in FLOWS:
        assert flow.force == pytest.approx(-2 * 5.0 * flow.moved, rel=1e-7, abs=1e-7)
        impedance = flow.resisted(3.0).added_mass
        assert abs(impedance[0, 2] - impedance[2, 0]) < 1e-7 * abs(impedance).max()


def test_much_loss_shuts_the_gap():
    shut = [flow.resisted(1e9) for flow in FLOWS]
    for flow, one in zip(FLOWS, shut, strict=True):
        U = flow.scattered / (1 - 1e9j * flow.own)
        assert abs(U) < 1e-6 and abs(one.transmission) ** 2 + abs(one.reflection) ** 2 == pytest.approx(1, abs=1e-6)
