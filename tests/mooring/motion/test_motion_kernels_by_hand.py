"""Kernels of a run one by one: polynomials between samples, turned forces, hawsers, a buoy, a hull that slews."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Components
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.ropes import RopePart
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import Leg, moored_body
from hakobune.mooring.lines.system.parts import LineType, UniformLine
from hakobune.mooring.motion.buoy import (
    Buoy,
    BuoyBody,
    BuoyOnLines,
    BuoyWork,
    buoy_arrays,
    floats,
    hawsers,
    keep_pulls,
    pull_of_rope,
    slope_of_rope,
    water_rows,
    yielding,
)
from hakobune.mooring.motion.line_loads import (
    body_lines,
    ends_at_rest,
    fairlead_course,
    generalized,
    give_generalized,
    line_work,
    loads_at,
    rotation_of,
    tensions_along,
)
from hakobune.mooring.motion.tables.hull_water import hull_water, hull_water_force
from hakobune.mooring.motion.tables.interpolation import between_samples, lagrange_weights, on_ring, ring_table
from hakobune.mooring.motion.tables.wave_windows import HEADINGS
from hakobune.mooring.motion.wave_loads import WaveForces, wave_table
from hakobune.mooring.single_point.loads import Loads, WaterLoad

RHO, G = 1000.0, 9.8


def test_weights_are_those_of_the_polynomial_through_the_samples():
    """x³ of four and x⁵ of six samples are exact, and 1 is the sum"""
    weights = np.zeros(6)
    for n, place in ((4, 1.3), (6, 2.7), (6, 0.2), (4, 2.9)):
        lagrange_weights(place, n, weights)
        x = np.arange(n)
        for power in range(n):
            assert weights[:n] @ x**power == pytest.approx(place**power, rel=1e-9)


def test_samples_and_rings_are_read_between_their_places():
    """A quintic at both ends and inside; cos 2θ round the circle to the fourth order of 3°"""
    t = np.arange(12.0)
    samples, out, weights = np.stack([(t - 4) ** 5, 3 * t]), np.zeros(2), np.zeros(6)
    for place in (0.3, 5.5, 8.0, 10.9):
        between_samples(samples, place, weights, out)
        assert out == pytest.approx([(place - 4) ** 5, 3 * place], rel=1e-9, abs=1e-9)
    theta = np.arange(120) * (2 * math.pi / 120)
    table = ring_table(np.stack([np.cos(2 * theta), np.sin(theta)], axis=1))
    for angle in (-4.0, 0.01, 3.13, 6.27, 9.0):
        on_ring(table, angle, weights, out)
        assert out == pytest.approx([math.cos(2 * angle), math.sin(angle)], abs=3e-6)


def test_forces_in_space_are_turned_to_heading_axes_and_moments_to_the_axes_of_the_angles():
    """Power: F·(heading axes turned by yaw) and M·(Rz Ry e_x φ̇ + Rz e_y θ̇ + e_z ψ̇)"""
    position = np.array([1.0, 2.0, 3.0, 0.3, -0.4, 0.7])
    f, arm = np.array([5.0, -6.0, 7.0]), np.array([2.0, 3.0, -4.0])
    M = np.cross(arm, f)
    c, s = math.cos(0.7), math.sin(0.7)
    Rz = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    Ry = np.array([[math.cos(-0.4), 0, math.sin(-0.4)], [0, 1, 0], [-math.sin(-0.4), 0, math.cos(-0.4)]])
    wanted = np.concatenate([Rz.T @ f, [M @ Rz @ Ry @ [1, 0, 0], M @ Rz @ [0, 1, 0], M[2]]])
    out = np.full(6, 10.0)
    generalized(position, *f, *M, out)
    assert out - 10 == pytest.approx(wanted, rel=1e-12)
    out = np.zeros(6)
    give_generalized(position, arm, f, out)
    assert out == pytest.approx(wanted, rel=1e-12)
    R = np.zeros((3, 3))
    rotation_of(position[3:], R)
    Rx = np.array([[1, 0, 0], [0, math.cos(0.3), -math.sin(0.3)], [0, math.sin(0.3), math.cos(0.3)]])
    assert pytest.approx(Rz @ Ry @ Rx, abs=1e-12) == R


KIND = LineType("chain", 800.0, 3e8)
LEGS = [
    Leg(UniformLine("one", KIND, 130.0, "", ""), (130.0, 20.0, -30.0), (10.0, 5.0, -2.0)),
    Leg(UniformLine("two", KIND, 125.0, "", ""), (-120.0, -30.0, -30.0), (-10.0, 4.0, -1.0)),
    Leg(
        Hawser("rope", pull_of_points("rope", [0.0, 4.0], [0.0, 4e5]), 40.0, "", ""), (9.0, 52.0, -1.0), (9.0, 6.0, 1.0)
    ),
]
PLACE = np.array([1.0, -2.0, 0.5])
SYSTEM = moored_body(LEGS, 30.0, PLACE, RHO, G)
STATE = np.array([0.8, -0.6, 0.4, 0.05, -0.08, 0.1, 0.5, -0.7, 0.3, 0.02, -0.03, 0.04])


def fairleads(state):
    R = rotation(*state[3:6])
    return [PLACE + state[:3] + R @ (np.array(leg.fairlead) - PLACE) for leg in LEGS]


def test_lines_pull_a_body_where_their_fairleads_are():
    """Catenaries of each line between its ends, EA e/L of the hawser; moments about the origin of the body's axes"""
    R, out, at = np.zeros((1, 3, 3)), np.zeros((1, 6)), STATE[:6].reshape(1, 6).copy()
    lines = body_lines(SYSTEM)
    work = line_work(lines)
    assert loads_at(lines, work, at, R, out)
    total, tensions = np.zeros(6), []
    for leg, end in zip(LEGS, fairleads(STATE), strict=True):
        away = end - np.array(leg.anchor)
        if isinstance(leg.line, Hawser):
            far = np.linalg.norm(away)
            force = -1e5 * (far - 40.0) * away / far
            tensions.append(1e5 * (far - 40.0))
        else:
            span = np.hypot(*away[:2])
            one = solve_lines(span, away[2], leg.line.length, 800.0, 3e8)
            H, V = float(one.horizontal_fairlead), float(one.vertical_fairlead)
            force = np.array([-H * away[0] / span, -H * away[1] / span, -V])
            tensions.append(math.hypot(H, V))
        give_generalized(STATE[:6], end - PLACE - STATE[:3], force, total)
    assert out[0] == pytest.approx(total, rel=1e-7)
    found = np.zeros((1, 3))
    tensions_along(lines, line_work(lines), np.zeros(1), at[None], found)
    assert found[0] == pytest.approx(tensions, rel=1e-7)
    lost = body_lines(SYSTEM, [("two", -1.0), ("rope", 5.0)])
    tensions_along(lost, line_work(lost), np.zeros(1), at[None], found)
    assert found[0] == pytest.approx([tensions[0], 0.0, tensions[2]], rel=1e-7)


CHAINS = [
    Leg(
        UniformLine(f"chain {i}", KIND, 120.0 + i, "", ""), (125.0 * np.cos(a), 118.0 * np.sin(a), -30.0),
        (10.0 * np.cos(a), 6.0 * np.sin(a), -1.0 - 0.1 * i),
    )
    for i, a in enumerate(np.linspace(0.1, 6.0, 11))
]  # fmt: skip


@pytest.mark.parametrize("lost", [None, 2, 9])
def test_chains_on_the_bed_pull_eight_at_once_as_each_alone(lost):
    """Eleven chains along a path: closed forms of each, none of one that is lost, and none of all below the bed"""
    lines = body_lines(moored_body(CHAINS, 30.0, PLACE, RHO, G), [] if lost is None else [(f"chain {lost}", -1.0)])
    work, R, out = line_work(lines), np.zeros((1, 3, 3)), np.zeros((1, 6))
    assert work.together.tolist() == [0, 0]
    for share in (0.0, 0.5, 0.9, 1.0):
        state = share * STATE
        assert loads_at(lines, work, state[:6].reshape(1, 6), R, out)
        wanted = np.zeros(6)
        for i, leg in enumerate(CHAINS):
            arm = rotation(*state[3:6]) @ (np.array(leg.fairlead) - PLACE)
            away = PLACE + state[:3] + arm - np.array(leg.anchor)
            span = np.hypot(*away[:2])
            if i == lost:
                continue
            one = solve_lines(span, away[2], leg.line.length, 800.0, 3e8)
            H, V = float(one.horizontal_fairlead), float(one.vertical_fairlead)
            give_generalized(state, arm, np.array([-H * away[0] / span, -H * away[1] / span, -V]), wanted)
            assert work.tension[i] == pytest.approx([H, V], rel=1e-7)
        assert out[0] == pytest.approx(wanted, rel=1e-6) and (lost is None or not work.tension[lost].any())
    assert not loads_at(lines, work, np.array([[0.0, 0.0, -40.0, 0.0, 0.0, 0.0]]), R, out) and not out.any()


def test_a_fairlead_moves_as_its_body_does():
    """Velocities along heading axes and rates of the angles; by differences of its place"""
    h = 1e-6

    def moved(t):
        state = STATE.copy()
        c, s = math.cos(STATE[5]), math.sin(STATE[5])
        u, v = STATE[6], STATE[7]
        state[:3] += t * np.array([c * u - s * v, s * u + c * v, STATE[8]])
        state[3:6] += t * STATE[9:12]
        return state

    place, velocity = fairlead_course(body_lines(SYSTEM), 1, STATE[None])
    assert place[0] == pytest.approx(fairleads(STATE)[1], rel=1e-12)
    slope = (fairleads(moved(h))[1] - fairleads(moved(-h))[1]) / (2 * h)
    assert velocity[0] == pytest.approx(slope, rel=1e-6)


# ------------------------------------------------------------------ a buoy


BODY = BuoyBody(90e3, 7.0, 4.0, (0.8, 0.6), (1.1, 0.9), 1.5)
ROPE = RopePart(2e6, 0.25, 1.5)


def test_a_buoy_floats_and_stands_by_its_sizes():
    """Draft m/ρA = 2.339 m; GM = B + I/∇ − G of an upright cylinder with its centre of gravity at half its height"""
    area = math.pi * 12.25
    draft = 90e3 / (RHO * area)
    metacentric = draft / 2 + (math.pi * 7**4 / 64) / (area * draft) - 2.0
    assert BODY.draft(RHO) == pytest.approx(draft) and BODY.metacentric_height(RHO) == pytest.approx(metacentric)
    upright = 90e3 * G * metacentric / 1.5
    assert BODY.upright(SYSTEM) == pytest.approx(upright)
    tilt = math.atan(1e5 / upright)  # ΣT h cos θ = c_θ sin θ
    assert BODY.yields(1e5, SYSTEM) == pytest.approx(1.5 * math.sin(tilt))
    away, slope = yielding(1.5, upright, 1e5)
    near = [yielding(1.5, upright, 1e5 + side)[0] for side in (1.0, -1.0)]
    assert (away, slope) == pytest.approx((1.5 * math.sin(tilt), (near[0] - near[1]) / 2), rel=1e-6)
    assert BuoyBody(90e3, 7.0, 4.0).yields(1e5, SYSTEM) == 0.0


def a_buoy(lengths=(20.0, 18.0), lever=1.5, current=(0.4, -0.3)):
    body = BuoyBody(90e3, 7.0, 4.0, (0.8, 0.6), (1.1, 0.9), lever)
    ends = np.array([[12.0, 3.0, 2.0], [12.0, -3.0, 1.0]])[: len(lengths)]
    return BuoyOnLines(
        body, SYSTEM, ROPE, np.array(lengths), ends, np.array([-30.0, 1.0, -0.5]), np.zeros(3), 1.2, np.array(current)
    )


def test_numbers_of_a_buoy_by_hand():
    """Displaced mass, C_a of it sideways and up; ½ρ C_d D d and A; hawsers at a tenth of the breaking load"""
    made, area = buoy_arrays(a_buoy()), math.pi * 12.25
    assert made.inverse == pytest.approx(1 / np.array([90e3 * 1.8, 90e3 * 1.8, 90e3 * 1.6]))
    assert made.moved == pytest.approx([90e3 * 1.8, 90e3 * 1.8, 90e3 * 0.6])
    draft = 90e3 / (RHO * area)
    assert made.drag == pytest.approx([500 * 1.1 * 7 * draft] * 2 + [500 * 0.9 * area])
    assert (made.weight, made.stiffness, made.draft, made.height) == pytest.approx(
        (G * 90e3, RHO * G * area, draft, 4.0)
    )
    strain = 0.25 * 0.1 ** (1 / 1.5)
    stiffness = 2e5 * 1.5 / (strain * np.array([20.0, 18.0]))
    assert a_buoy().stiffness == pytest.approx(stiffness)
    assert made.ropes[:, :4].tolist() == [[20.0, 2e6, 0.25, 1.5], [18.0, 2e6, 0.25, 1.5]]
    assert made.ropes[:, 4] == pytest.approx(2 * 0.05 * np.sqrt(stiffness * 90e3))
    assert made.ropes[:, 5] == pytest.approx(strain * np.array([20.0, 18.0]))
    with pytest.raises(ValueError, match=r"floats at 4\.16 m; allowed: below its 4 m"):
        buoy_arrays(BuoyOnLines(BuoyBody(160e3, 7.0, 4.0), *[getattr(a_buoy(), n) for n in
                    ("system", "rope", "lengths", "ends", "origin", "start", "level", "current")]))  # fmt: skip
    tall = BuoyOnLines(BuoyBody(20e3, 2.0, 12.0, lever=1.0), *[getattr(a_buoy(), n) for n in
                       ("system", "rope", "lengths", "ends", "origin", "start", "level", "current")])  # fmt: skip
    with pytest.raises(ValueError, match="does not float upright"):
        buoy_arrays(tall)


def test_a_rope_pulls_by_its_law_and_its_loss_grows_to_a_tenth():
    """B (e/Lε_B)ⁿ + c min(1, e/e_c) ė, never below 0"""
    rope = np.array([20.0, 2e6, 0.25, 1.5, 3e4, 1.1])
    assert pull_of_rope(rope, 0.5, 0.2) == pytest.approx(2e6 * 0.1**1.5 + 3e4 * 0.5 / 1.1 * 0.2)
    assert pull_of_rope(rope, 2.0, 0.2) == pytest.approx(2e6 * 0.4**1.5 + 3e4 * 0.2)
    assert pull_of_rope(rope, 0.5, -9.0) == 0.0 == pull_of_rope(rope, 0.0, 5.0)
    slope = (pull_of_rope(rope, 0.5 + 1e-6, 0.0) - pull_of_rope(rope, 0.5 - 1e-6, 0.0)) / 2e-6
    assert slope_of_rope(rope, 0.5) == pytest.approx(slope, rel=1e-6) and slope_of_rope(rope, 0.0) == 0.0


def room(buoy, water=None):
    k = len(buoy.ropes)
    count = k + len(buoy.lines.lost)
    return BuoyWork(
        line_work(buoy.lines),
        np.zeros((7, 1)),
        np.zeros((0, 2, 8)),
        np.zeros((0, 2, 7)),
        np.zeros((2, 7, 2, 8)),
        np.zeros(2),
        np.zeros(7) if water is None else np.array(water, float),
        np.zeros(6),
        np.zeros(6),
        np.zeros((3, 3)),
        np.zeros(6),
        np.zeros(6),
        np.zeros((k, 5)),
        np.zeros(k),
        np.zeros(count),
        np.zeros((4, count)),
    )


@pytest.mark.parametrize("lever", [0.0, 1.5])
def test_hawsers_pull_the_body_and_the_buoy_apart_alike(lever):
    """Along their chords, by elongation less what the buoy yields, S = Σ T(e − x(S)); rates of both ends count"""
    buoy: Buoy = buoy_arrays(a_buoy(lever=lever))
    place = np.array([2.0, 1.5, 0.3, 0.6, -0.4, 0.2])
    work, R = room(buoy), rotation(*STATE[3:6])
    hawsers(buoy, work, STATE, place, R)
    h = 1e-6

    def chords(t):
        state = STATE.copy()
        c, s = math.cos(STATE[5]), math.sin(STATE[5])
        state[:3] += t * np.array([c * STATE[6] - s * STATE[7], s * STATE[6] + c * STATE[7], STATE[8]])
        state[3:6] += t * STATE[9:12]
        ends = np.array([-30.0, 1.0, -0.5]) + state[:3] + (rotation(*state[3:6]) @ buoy.ends.T).T
        at = PLACE + place[:3] + t * place[3:] + [0, 0, 1.2]
        return at - ends

    d = chords(0.0)
    far = np.linalg.norm(d, axis=1)
    e = far - buoy.ropes[:, 0]
    rate = (np.linalg.norm(chords(h), axis=1) - np.linalg.norm(chords(-h), axis=1)) / (2 * h)
    assert np.all(e > 0.5)
    shift, soft = 0.0, 0.0
    if lever:
        low, high = 0.0, 1e7
        for _ in range(200):
            S = 0.5 * (low + high)
            shift = lever * math.sin(math.atan(S / buoy.upright))
            pulls = sum(pull_of_rope(buoy.ropes[i], e[i] - shift, 0.0) for i in range(2))
            low, high = (S, high) if pulls > S else (low, S)
        step = 1e-3 * S
        by_pull = (
            lever * math.sin(math.atan((S + step) / buoy.upright))
            - lever * math.sin(math.atan((S - step) / buoy.upright))
        ) / (2 * step)
        soft = by_pull * sum(slope_of_rope(buoy.ropes[i], e[i] - shift) for i in range(2))
    T = [pull_of_rope(buoy.ropes[i], e[i] - shift, rate[i] / (1 + soft)) for i in range(2)]
    assert work.rope == pytest.approx(T, rel=1e-5) and min(T) > 0
    on_body, on_buoy = np.zeros(6), np.zeros(3)
    for i in range(2):
        force = T[i] * d[i] / far[i]
        on_buoy -= force
        give_generalized(STATE[:6], R @ buoy.ends[i], force, on_body)
    assert work.force[:3] == pytest.approx(on_buoy, rel=1e-5) and work.part == pytest.approx(on_body, rel=1e-5)


def test_water_lifts_moves_and_drags_a_buoy():
    """ρgA of draft and elevation less its height, within its own; (1 + C_a) ρ∇ a; ½ρC_dA |q − w|(q − w)"""
    buoy = buoy_arrays(a_buoy())
    work = room(buoy, [0.5, 1.0, -0.8, 0.3, 0.2, 0.4, -0.6])
    place = np.array([0.0, 0.0, 0.2, 0.7, 0.1, -0.5])
    floats(buoy, work, place, 0.5, 0.25)  # half of the current, a quarter of the waves
    past = 0.25 * np.array([1.0, -0.8, 0.3]) + 0.5 * np.array([0.4, -0.3, 0.0]) - place[3:]
    wanted = buoy.moved * 0.25 * np.array([0.2, 0.4, -0.6]) + buoy.drag * past * np.abs(past)
    wanted[2] += buoy.stiffness * (buoy.draft + 0.125 - 0.2) - G * 90e3
    assert work.force[:3] == pytest.approx(wanted, rel=1e-12)
    for z, immersed in ((9.0, 0.0), (-9.0, 4.0)):
        work.force[:] = 0.0
        floats(buoy, work, np.array([0, 0, z, 0, 0, 0.0]), 0.0, 0.0)
        assert work.force[2] == pytest.approx(buoy.stiffness * immersed - G * 90e3)


def test_water_at_a_buoy_is_that_of_linear_waves_at_half_its_draft():
    """a ω cosh k(z+h)/sinh kh and its rate, real and imaginary parts of exp(i(k·x + ε − ωt)); elevation a"""
    forces = WaveForces(np.linspace(0.4, 1.6, 9), np.zeros((9, HEADINGS, 12)), None)
    waves = Components(np.array([0.7, 1.1]), np.array([1.5, 0.8]), np.array([0.3, 1.0]), np.array([0.4, 2.0]))
    table = wave_table(forces, waves, 30.0, PLACE, G)
    buoy, rows = buoy_arrays(a_buoy()), np.zeros((2, 2, 7))
    place, start, z, h = np.array([7.0, -4.0]), 3.0, -0.5 * buoy_arrays(a_buoy()).draft, 30.0
    water_rows(table, buoy, place, start, rows)
    for i in range(2):
        w, a, beta = waves.omega[i], waves.amplitude[i], waves.direction[i]
        k = float(wavenumber(w, h, G))
        c, s = math.cosh(k * (z + h)) / math.sinh(k * h), math.sinh(k * (z + h)) / math.sinh(k * h)
        for t in (0.0, 0.4, 1.7):
            turn = k * (place[0] * math.cos(beta) + place[1] * math.sin(beta)) + waves.phase[i] - w * (start + t)
            u, up = a * w * c * math.cos(turn), a * w * s * math.sin(turn)
            du, dup = a * w * w * c * math.sin(turn), -a * w * w * s * math.cos(turn)
            wanted = [
                a * math.cos(turn),
                u * math.cos(beta),
                u * math.sin(beta),
                up,
                du * math.cos(beta),
                du * math.sin(beta),
                dup,
            ]
            found = rows[i, 0] * math.cos(w * t) + rows[i, 1] * math.sin(w * t)
            assert found == pytest.approx(wanted, rel=1e-6, abs=1e-9)


def test_the_largest_pulls_since_the_last_sample_are_kept():
    buoy = buoy_arrays(a_buoy())
    work = room(buoy)
    work.rope[:] = [5.0, 1.0]
    work.lines.tension[:] = [[3.0, 4.0], [0.0, 2.0], [6.0, 8.0]]
    keep_pulls(work, 0, 0)
    work.rope[:] = [2.0, 7.0]
    work.lines.tension[:] = [[0.0, 1.0], [0.0, 3.0], [0.0, 9.0]]
    keep_pulls(work, 1, 3)
    assert work.kept[1].tolist() == work.kept[2].tolist() == [5.0, 7.0, 5.0, 3.0, 10.0] and not work.kept[0].any()
    keep_pulls(work, 3, 4)
    assert work.kept[3].tolist() == [2.0, 7.0, 1.0, 3.0, 9.0]


# ------------------------------------------------------------------ water on a hull that slews


@pytest.mark.parametrize("turning", [True, False])
def test_water_on_a_hull_has_its_powers_of_the_turn_and_what_the_current_adds(turning):
    """V² Σ cₖ (rL/V)ᵏ, |rL| ≤ V/2, − D ν′; r (T₁₁ W, −T₂₂ U, −T₆₂ U) with turning tests, else r (a₁₁ − a₂₂)(W, U)"""
    n = 720
    beta = np.arange(n) * (2 * math.pi / n)
    unit = np.stack([2 * np.cos(beta), 3 * np.sin(beta), 4 * np.sin(2 * beta)], axis=1)
    table = np.stack([unit * k for k in (1.0, 0.5, 0.25, 2.0, 3.0)], axis=1)
    mass = np.array([[5.0, 0, 0], [0, 8.0, 0.6], [0, 0.6, 9.0]])
    ring = np.arange(120) * (2 * math.pi / 120)
    drift = np.stack([np.cos(ring), np.sin(ring), np.cos(2 * ring)], axis=1)
    hull = hull_water(table, 20.0, 0.5, (1.0, 0.5), np.diag([0.1, 0.2, 0.3]), mass, turning, drift, 2.5)
    assert hull.lever == 2.5 and hull.length == 20.0
    heading, u, v = 0.4, 1.5, -0.8
    for r, share in ((0.02, 1.0), (-0.5, 0.6)):
        out, found = np.zeros(3), np.zeros(3)
        hull_water_force(hull, share, np.array([heading, u, v, r]), np.zeros(6), np.zeros(15), out, found)
        U = share * (math.cos(heading) * 1.0 + math.sin(heading) * 0.5)
        W = share * (-math.sin(heading) * 1.0 + math.cos(heading) * 0.5)
        a, b = u - U, v - W
        V = math.hypot(a, b)
        at = math.atan2(-b, -a)
        s = max(-0.5, min(0.5, r * 20 / V))
        powers = 1 + 0.5 * s + 0.25 * s**2 + 2 * s**3 + 3 * s**4
        wanted = V * V * powers * np.array([2 * math.cos(at), 3 * math.sin(at), 4 * math.sin(2 * at)])
        wanted -= np.array([0.1 * a, 0.2 * b, 0.3 * r])
        wanted += r * (np.array([5 * W, -8 * U, -0.6 * U]) if turning else np.array([-3 * W, -3 * U, -0.6 * U]))
        assert out == pytest.approx(wanted, rel=1e-6)
        assert found == pytest.approx(share**2 * np.array([math.cos(0.4), math.sin(0.4), math.cos(0.8)]), rel=1e-5)


@pytest.mark.parametrize("current, left", [(0.0, 0.4), (0.25, 0.7), (0.5, 1.0), (2.0, 1.0)])
def test_water_on_a_round_hull_that_outruns_the_current_has_less_drag(current, left):
    """Half way to the current that is 0.4 of the hull's speed x = 0.5: 0.4 + 0.6 (3/4 − 2/8) = 0.7"""
    at = np.arange(720) * (2 * math.pi / 720)
    table = np.zeros((720, 5, 3))
    table[:, 0, :2] = 3 * np.stack([np.cos(at), np.sin(at)], axis=1)
    hull = hull_water(table, 20.0, 0.5, (0.0, current), None, np.eye(3), False, at_rest=0.4)
    out = np.zeros(3)
    hull_water_force(hull, 1.0, np.array([0.0, 1.25, 0.0, 0.0]), np.zeros(6), np.zeros(15), out, np.zeros(3))
    V = math.hypot(1.25, current)
    assert out == pytest.approx(left * 3 * V * np.array([-1.25, current, 0.0]), rel=1e-6, abs=1e-9)
    load = Loads(WaterLoad(table, 20.0, False, current, math.pi / 2, at_rest=0.4))
    assert load.moving(0.0, (1.25, -current, 0.0)) == pytest.approx(out, rel=1e-6, abs=1e-9)


def test_ends_of_lines_at_rest_are_turned_by_the_headings_of_their_bodies():
    """Body 0 at (5, 6, −1), not turned; body 1 at (100, 50, −2), turned by 90°; an anchor stays"""
    lines = SimpleNamespace(
        body=np.array([0, 1, 1]), other=np.array([-1, -1, 0]), place=np.array([[5.0, 6.0, -1.0], [100.0, 50.0, -2.0]]),
        anchor=np.array([[-50.0, 1.0, -20.0], [-60.0, 2.0, -20.0], [3.0, 4.0, 0.5]]),
        fairlead=np.array([[10.0, 1.0, 2.0], [10.0, 1.0, 2.0], [-10.0, 2.0, 1.0]]),
    )  # fmt: skip
    at_rest = np.zeros((2, 6))
    at_rest[1, 5] = np.pi / 2
    far, near = ends_at_rest(lines, at_rest)
    assert far == pytest.approx(np.array([[-50.0, 1.0, -20.0], [-60.0, 2.0, -20.0], [8.0, 10.0, -0.5]]))
    assert near == pytest.approx(np.array([[15.0, 7.0, 1.0], [99.0, 60.0, 0.0], [98.0, 40.0, -1.0]]))
