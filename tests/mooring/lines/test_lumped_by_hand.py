"""Forces on the nodes of a lumped line, written out once more in vectors, and what a line is made of, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from node_loads import loads
from plain import plain

from hakobune.mooring.lines.dynamics.bed import ElasticBed
from hakobune.mooring.lines.dynamics.line import AttachedBody, DynamicLine, DynamicSegment
from hakobune.mooring.lines.dynamics.lumped.bed import bed_energy, keep_slip
from hakobune.mooring.lines.dynamics.lumped.books import BED, DRAG, FRICTION, INERTIA, STRUCTURE, WORK
from hakobune.mooring.lines.dynamics.lumped.forces import immersion
from hakobune.mooring.lines.dynamics.lumped.surface import energy_dry
from hakobune.mooring.lines.dynamics.lumped.workspace import to_rows

RNG = np.random.default_rng(4)
N = 6  # elements


def numbers(low, high, n=N):
    """n numbers of their own between two"""
    return np.linspace(low, high, n) + 0.05 * (high - low) * np.sin(np.arange(n) * 2.3)


def a_system(rises):
    """Six elements, seven nodes, each with numbers of its own; a buoy in the surface and a clump on the bed"""
    one = DynamicSegment(30.0, 50.0, 300.0, 0.2, 1e6, 3, structural_damping=10.0)
    bed = ElasticBed(friction=0.5, slope=0.1)
    line = DynamicLine((one, one), (0.0, 0.0, -20.0), (AttachedBody(100.0, 0.2, 0.5),), bed=bed, surface=rises)
    body = np.zeros(N + 1)
    added, displaced, drag, lift, radius = (body.copy() for _ in range(5))
    for j, k in ((3, 1.0), (5, 1.7)):
        added[j], displaced[j], drag[j], lift[j], radius[j] = 40 * k, 150 * k, 90 * k, 1500 * k, 0.9 * k
    n = np.array([-0.0995, 0.0, 0.995])
    return line.system._replace(
        length=numbers(8.0, 12.0),
        stiffness=numbers(8e5, 1.2e6),
        damping=numbers(3e3, 5e3),
        soft_strain=numbers(0.02, 0.04),
        half_drag_normal=numbers(900.0, 1500.0),
        half_drag_tangential=numbers(100.0, 300.0),
        half_added_normal=numbers(90.0, 140.0),
        half_added_tangential=numbers(20.0, 50.0),
        half_displaced=numbers(100.0, 160.0),
        buoyancy=rises * numbers(800.0, 1500.0),
        waterline=numbers(0.7, 0.9),
        weight=numbers(2000.0, 3000.0, N + 1),
        mass=numbers(300.0, 500.0, N + 1),
        body_nodes=np.array([3, 5]),
        body_buoyancy=lift,
        body_radius=radius,
        body_drag=drag,
        body_added=added,
        body_displaced=displaced,
        bed_stiffness=numbers(4e4, 7e4, N + 1),
        bed_damping=numbers(900.0, 1500.0, N + 1),
        bed_thickness=numbers(0.1, 0.2, N + 1),
        bed_normal=n / np.linalg.norm(n),
        bed_level=-19.9,
        bed_friction=0.6,
        bed_slip=0.15,
    )


def places(s):
    """Nodes from the bed to above the surface: taut, slack and hardly stretched elements, one in the fade of damping"""
    stretch = np.array([0.05, -0.02, 0.01, 0.06, 0.015, 0.03])
    slope = np.radians([2.0, 5.0, 75.0, 60.0, 20.0, 30.0])
    q = [np.array([0.0, 0.5, -20.1])]
    for length, e, up in zip(s.length, stretch, slope, strict=True):
        q.append(q[-1] + length * (1 + e) * np.array([math.cos(up) * 0.96, math.cos(up) * 0.28, math.sin(up)]))
    q = np.array(q)
    q[:2, 2] = s.bed_level / s.bed_normal[2] - q[:2, 0] * s.bed_normal[0] / s.bed_normal[2] + [-0.05, 0.08]
    q[2, 2] = q[1, 2] + 0.2
    return q


def by_hand(s, q, v, a, u, du, slip, since):
    """Residual (7, 3) N, and powers lost, each term as the module has it"""
    r, lost = -s.mass[:, None] * a, dict.fromkeys((DRAG, INERTIA, STRUCTURE, BED, FRICTION), 0.0)
    r[:, 2] -= s.weight
    wet = np.ones(N)
    for e in range(N):
        low, high = q[e, 2], q[e + 1, 2]
        b = math.hypot(high - low, s.waterline[e])
        x = 0.5 * (low + high) / b
        if s.buoyancy[e] > 0:
            y = max(0.0, 1 - abs(x))
            dry = 1 - 0.5 * y * y if x > 0 else 0.5 * y * y
            Q = max(x, 0.0) + y**3 / 6
            by_b = Q - x * dry  # dE/db over B
            wet[e] = 1 - dry
            for end, sign in ((e, -1.0), (e + 1, 1.0)):
                r[end, 2] -= s.buoyancy[e] * (0.5 * dry + by_b * sign * (high - low) / b)
        d = q[e + 1] - q[e]
        size = np.linalg.norm(d)
        t, strain = d / size, size / s.length[e] - 1
        rate = t @ (v[e + 1] - v[e]) / s.length[e]
        if strain > 0:
            fade = min(1.0, strain / s.soft_strain[e])
            T = max(0.0, s.stiffness[e] * strain + s.damping[e] * fade * rate)
            lost[STRUCTURE] += (T - s.stiffness[e] * strain) * rate * s.length[e]
            r[e] += T * t
            r[e + 1] -= T * t
        for j in (e, e + 1):
            past = u[j] - v[j]
            along, across = (past @ t) * t, past - (past @ t) * t
            drag = wet[e] * (s.half_drag_normal[e] * np.linalg.norm(across) * across
                             + s.half_drag_tangential[e] * np.linalg.norm(along) * along)  # fmt: skip
            an, at, moved = (
                wet[e] * s.half_added_normal[e],
                wet[e] * s.half_added_tangential[e],
                wet[e] * s.half_displaced[e],
            )
            wn, wt, bn, bt = du[j] - (du[j] @ t) * t, (du[j] @ t) * t, a[j] - (a[j] @ t) * t, (a[j] @ t) * t
            inertia = (moved + an) * wn - an * bn + at * (wt - bt)
            r[j] += drag + inertia
            lost[DRAG] -= drag @ v[j]
            lost[INERTIA] -= inertia @ v[j]
    for j in s.body_nodes:
        x = np.clip(q[j, 2] / s.body_radius[j], -1, 1)
        share = 0.25 * (1 - x) ** 2 * (2 + x)
        r[j, 2] += s.body_buoyancy[j] * share
        past = u[j] - v[j]
        drag = s.body_drag[j] * share * np.linalg.norm(past) * past
        inertia = (s.body_added[j] + s.body_displaced[j] * share) * du[j] - s.body_added[j] * a[j]
        r[j] += drag + inertia
        lost[DRAG] -= drag @ v[j]
        lost[INERTIA] -= inertia @ v[j]
    n = s.bed_normal
    for j in range(N + 1):
        h, k = s.bed_thickness[j], s.bed_stiffness[j]
        p = s.bed_level + h - n @ q[j]
        if p <= 0:
            continue
        spring = 0.5 * k * p * p / h if p < h else k * (p - 0.5 * h)
        rise = n @ v[j]
        R = max(0.0, spring - s.bed_damping[j] * min(1.0, p / h) * rise)
        lost[BED] += (spring - R) * rise
        r[j] += R * n
        x = q[j] - since[j] + slip[j]
        x = x - (x @ n) * n
        size = np.linalg.norm(x)
        F = s.bed_friction * R / s.bed_slip * x * min(1.0, s.bed_slip / size)
        r[j] -= F
        lost[FRICTION] += F @ v[j]
    return r, lost


def rows(points):
    return to_rows(np.asarray(points, float))


@pytest.mark.parametrize("rises", [False, True])
def test_forces_on_nodes_are_those_of_the_equations_written_out_in_vectors(rises):
    """SR179 report (1982), section 2.2, in three dimensions: tension, weight, Morison, bed, friction, spheres"""
    s = a_system(rises)
    q = places(s)
    v, a, u, du = (scale * RNG.standard_normal((N + 1, 3)) for scale in (0.8, 1.1, 1.3, 0.7))
    since, slip = q + 0.1 * RNG.standard_normal((N + 1, 3)), 0.03 * RNG.standard_normal((N + 1, 3))
    work = loads(s, q, v, a, slip, since, u, du, 1e-3, 0.03)
    wanted, lost = by_hand(s, q, v, a, u, du, slip, since)
    found = work.r[:, : N + 1].T
    assert found == pytest.approx(wanted, rel=1e-9, abs=1e-6 * np.abs(wanted).max())
    for book, value in lost.items():
        assert work.power[book] == pytest.approx(value, rel=1e-9), book
    ends = -(wanted[0] @ v[0] + wanted[-1] @ v[-1])
    assert work.power[WORK] == pytest.approx(ends, rel=1e-9)
    assert q[0] @ s.bed_normal < s.bed_level < q[1] @ s.bed_normal and q[-1, 2] > 0.5 and q[3, 2] < 0.9


@pytest.mark.parametrize("rises", [False, True])
def test_forces_at_rest_are_less_the_slope_of_the_energy_stored(rises):
    """∂E/∂q by differences; kinetic energy ½ m v², and without friction nothing else"""
    s = a_system(rises)._replace(bed_friction=0.0)
    q = places(s)
    work = loads(s, q, cq=1e-3, cv=0.03)
    slope = np.empty((N + 1, 3))
    for j in range(N + 1):
        for i in range(3):
            far = []
            for side in (1e-5, -1e-5):
                moved = q.copy()
                moved[j, i] += side
                far.append(loads(s, moved).energy.sum())
            slope[j, i] = (far[0] - far[1]) / 2e-5
    assert pytest.approx(-slope, abs=2e-6 * np.abs(slope).max()) == work.r[:, : N + 1].T
    v = RNG.standard_normal((N + 1, 3))
    kinetic = loads(s, q, v).energy[0]
    assert kinetic == pytest.approx(0.5 * np.sum(s.mass[:, None] * v**2), rel=1e-12)


def test_energies_by_hand():
    """Stretch ½ EA L ε² of what is taut, weight w z, bed ∫R, an element out of the water B b Q"""
    s = a_system(True)
    q = places(s)
    kinetic, elastic, potential, bed = loads(s, q).energy
    strain = np.linalg.norm(np.diff(q, axis=0), axis=1) / s.length - 1
    assert kinetic == 0.0 and elastic == pytest.approx(
        np.sum(0.5 * s.stiffness * s.length * np.maximum(strain, 0) ** 2)
    )
    dry = 0.0
    for e in range(N):
        b = math.hypot(q[e + 1, 2] - q[e, 2], s.waterline[e])
        x = 0.5 * (q[e, 2] + q[e + 1, 2]) / b
        one = s.buoyancy[e] * b * (max(x, 0.0) + max(0.0, 1 - abs(x)) ** 3 / 6)
        assert energy_dry(s, e, rows(q)) == pytest.approx(one, rel=1e-12)
        dry += one
    lift = 0.0
    for j in s.body_nodes:  # −∫ share dz from deep water to z, the sphere's middle: −z wholly under water
        z = np.linspace(-30.0, q[j, 2], 200_001)
        x = np.clip(z / s.body_radius[j], -1, 1)
        lift -= s.body_buoyancy[j] * (np.trapezoid(0.25 * (1 - x) ** 2 * (2 + x), z) - 30.0)
    assert potential == pytest.approx(s.weight @ q[:, 2] + dry + lift, rel=1e-6)
    total = 0.0
    for j in range(N + 1):
        h, k = s.bed_thickness[j], s.bed_stiffness[j]
        p = s.bed_level + h - s.bed_normal @ q[j]
        one = 0.0 if p <= 0 else k * p**3 / (6 * h) if p < h else k * (h * h / 6 + (p - h) * h / 2 + (p - h) ** 2 / 2)
        assert bed_energy(s, j, rows(q)) == pytest.approx(one, rel=1e-9)
        total += one
    assert bed == pytest.approx(total, rel=1e-9) and total > 0


def test_a_sphere_in_the_surface_has_the_volume_of_its_cap():
    """π h² (3r − h)/3 over 4πr³/3, h = r − z; wholly in and wholly out beyond r"""
    for z in (-0.6, 0.0, 0.45):
        h = 0.9 - z
        share, slope, _ = immersion(z, 0.9)
        assert share == pytest.approx(h * h * (2.7 - h) / (4 * 0.729), rel=1e-12)
        near = [immersion(z + side, 0.9) for side in (1e-6, -1e-6)]
        assert slope == pytest.approx((near[0][0] - near[1][0]) / 2e-6, rel=1e-6)
        assert -share == pytest.approx((near[0][2] - near[1][2]) / 2e-6, rel=1e-6)
    assert immersion(-0.9, 0.9) == (1.0, 0.0, 0.9) and immersion(0.9, 0.9) == (0.0, 0.0, 0.0)
    assert immersion(-0.8999999, 0.9)[2] == pytest.approx(0.9, rel=1e-6)


def test_friction_is_kept_along_the_bed_and_takes_the_work_of_its_path():
    """μ R̄/δ of ½(s₁² − s₀²) and δ² (1/f − 1) where it slides, R̄ the mean of both ends; off the bed it is lost"""
    s = a_system(False)
    n, q = s.bed_normal, np.zeros((N + 1, 3))
    q[:, 0] = numbers(0.0, 9.0, N + 1)
    depth = np.array([0.05, 0.1, -0.3, 0.02, 0.0, -1.0, 0.04])  # under the level where a node lies
    q[:, 2] = (s.bed_level - depth - n[0] * q[:, 0]) / n[2]
    along, side = np.array([n[2], 0.0, -n[0]]), np.array([0.0, 1.0, 0.0])
    slip, since = (
        np.outer(np.full(N + 1, 0.05), along),
        q - np.outer(numbers(0.02, 0.6, N + 1), 0.6 * along + 0.8 * side),
    )
    kept = rows(slip)
    work = keep_slip(s, rows(q), rows(0 * q), kept, rows(since), rows(0 * q))
    wanted = 0.0
    for j in range(N + 1):
        h, k = s.bed_thickness[j], s.bed_stiffness[j]
        if depth[j] + h <= 0:
            assert not kept[:, j].any()
            continue
        x = slip[j] + q[j] - since[j]
        size = np.linalg.norm(x)
        f = min(1.0, s.bed_slip / size)
        assert kept[:, j] == pytest.approx(f * x, abs=1e-12)
        R = [k * (p - 0.5 * h) if p >= h else 0.5 * k * max(p, 0) ** 2 / h for p in
             (s.bed_level + h - n @ since[j], s.bed_level + h - n @ q[j])]  # fmt: skip
        path = 0.5 * (f * f * size * size - 0.0025) + s.bed_slip**2 * (1 / f - 1)
        wanted += s.bed_friction / s.bed_slip * np.mean(R) * path
    assert work == pytest.approx(wanted, rel=1e-9) and wanted > 0


def test_a_line_is_cut_into_halves_at_its_nodes():
    """Two segments of 30 m in 3 and 20 m in 4 elements, a body between: each array by hand"""
    one = DynamicSegment(30.0, 50.0, 300.0, 0.2, 1e6, 3, structural_damping=10.0, drag_normal=1.1, drag_tangential=0.3,
                         added_normal=1.2, added_tangential=0.4)  # fmt: skip
    two = DynamicSegment(20.0, 20.0, 100.0, 0.1, 4e5, 4, drag_normal=1.6, added_normal=1.0, damping_ratio=0.3)
    body = AttachedBody(500.0, 0.3, 0.7, 0.6)
    line = DynamicLine((one, two), (0.0, 0.0, -20.0), (body,), bed=ElasticBed(), density=1010.0, gravity=9.7)
    s = line.system
    assert line.length == 50.0 and line.elements == 7 and line.nodes == pytest.approx([0, 10, 20, 30, 35, 40, 45, 50])
    assert s.length == pytest.approx([10] * 3 + [5] * 4) and s.stiffness == pytest.approx([1e6] * 3 + [4e5] * 4)
    assert s.damping == pytest.approx([10.0] * 3 + [0.3 * 5 * math.sqrt(4e5 * 20)] * 4)
    assert s.half_mass == pytest.approx([250.0] * 3 + [50.0] * 4)
    assert s.mass == pytest.approx([250, 500, 500, 250 + 50 + 500, 100, 100, 100, 50])
    assert s.weight == pytest.approx([1500, 3000, 3000, 1500 + 250 + 500 * 9.7, 500, 500, 500, 250])
    assert s.half_drag_normal == pytest.approx([0.5 * 1010 * 0.2 * 5 * 1.1] * 3 + [0.5 * 1010 * 0.1 * 2.5 * 1.6] * 4)
    assert s.half_drag_tangential[0] == pytest.approx(0.5 * 1010 * math.pi * 0.2 * 5 * 0.3)
    water = [1010 * math.pi / 4 * 0.04 * 5] * 3 + [1010 * math.pi / 4 * 0.01 * 2.5] * 4
    assert s.half_displaced == pytest.approx(water)
    assert s.half_added_normal == pytest.approx(np.array(water) * ([1.2] * 3 + [1.0] * 4))
    assert s.half_added_tangential[0] == pytest.approx(0.4 * water[0])
    assert s.inertia[3] == pytest.approx(800 + 1.2 * water[0] + water[3] + 0.6 * 1010 * 0.3)
    assert s.body_nodes.tolist() == [3] and s.body_buoyancy[3] == pytest.approx(1010 * 0.3 * 9.7)
    assert s.body_radius[3] == pytest.approx((0.9 / (4 * math.pi)) ** (1 / 3))
    assert (s.body_drag[3], s.body_added[3], s.body_displaced[3]) == pytest.approx((0.5 * 1010 * 0.7, 0.6 * 303, 303.0))
    assert not s.buoyancy.any() and s.waterline == pytest.approx(math.pi / 4 * np.array([0.2] * 3 + [0.1] * 4))
    load = np.sum(np.abs(s.weight))
    assert s.soft_strain == pytest.approx(1e-2 * load / s.stiffness)
    area = np.array([1.0, 2, 2, 1 + 0.25, 0.5, 0.5, 0.5, 0.25])
    under = np.array([1500, 3000, 3000, 1750.0, 500, 500, 500, 250])
    heavier = np.ones(8)
    heavier[3] = (s.weight[3] - s.body_buoyancy[3]) / under[3]
    k = line.bed.stiffness * area * heavier
    assert s.bed_stiffness == pytest.approx(k) and s.bed_damping == pytest.approx(line.bed.damping * area * heavier)
    net = s.weight - s.body_buoyancy
    assert s.bed_thickness == pytest.approx(np.maximum(2 * net / k, 1e-4)) and s.bed_level == pytest.approx(
        -20 - line.bed.below
    )
    up = DynamicLine((one, two), (0.0, 0.0, -20.0), (body,), bed=None, density=1010.0, gravity=9.7, surface=True).system
    assert up.buoyancy == pytest.approx([10 * (9.7 * 50 - 300)] * 3 + [5 * (9.7 * 20 - 100)] * 4)
    finer = line.with_elements(2)
    assert [part.elements for part in finer.segments] == [6, 8] and [
        p.elements for p in line.with_elements(0.1).segments
    ] == [1, 1]
    slip = 0.1 * min(0.3 * 300 * 100 / 1e6, 0.3 * 100 * 25 / 4e5)
    rough = DynamicLine((one, two), (0.0, 0.0, -20.0), (body,), bed=ElasticBed(friction=0.3)).system
    assert rough.bed_slip == pytest.approx(slip) and rough.bed_friction == 0.3


def test_bending_stiffness_of_a_node_is_that_of_both_halves_in_series():
    """1/k = ½ (ℓ₋/EI₋ + ℓ₊/EI₊); hinged where one side has none, and at the ends"""
    one = DynamicSegment(30.0, 50.0, 300.0, 0.2, 1e6, 3, bending_stiffness=600.0)
    two = DynamicSegment(20.0, 20.0, 100.0, 0.1, 4e5, 4, bending_stiffness=50.0)
    free = DynamicSegment(20.0, 20.0, 100.0, 0.1, 4e5, 4)
    made = DynamicLine((one, two, free), (0.0, 0.0, -20.0), bed=None)
    wanted = [0, 60, 60, 1 / (0.5 * (10 / 600 + 5 / 50)), 10, 10, 10, 0, 0, 0, 0, 0]
    assert made.bends and made.system.flexure == pytest.approx(wanted)
    assert made.without_bending().system.flexure.size == 0 and not made.without_bending().bends


def test_a_table_of_strains_is_read_over_its_largest_stiffness():
    """0 to 0.1: 2e5 N, to 0.3: 1e6 N: slopes 2e6 and 4e6; ½ 0.1 · 2e5 J per metre at the second row"""
    part = DynamicSegment(20.0, 20.0, 100.0, 0.1, [[0.0, 0.0], [0.1, 2e5], [0.3, 1e6]], 4)
    assert part.stiffness == pytest.approx(4e6)
    assert part.elongation == pytest.approx(np.array([[0, 0, 0.5, 0], [0.1, 0.05, 1.0, 0.0025]]))
    assert part.strain_at(np.array([1e5, 6e5, 2e6])) == pytest.approx([0.05, 0.2, 0.55])


def test_a_stage_without_drag_is_solved_at_once_and_what_is_no_number_or_beyond_reach_is_told():
    """Slack elements that carry nothing fall: m a = −w, the water's inertia with it; linear, so one step is enough"""
    stage, work = (plain(f"mooring.lines.dynamics.lumped.{name}") for name in ("stage", "workspace"))
    s = a_system(rises=False)
    none = np.zeros(N)
    s = s._replace(half_drag_normal=none, half_drag_tangential=none, bed_stiffness=np.zeros(N + 1), bed_level=-1e3,
                   body_nodes=np.array([], int))  # fmt: skip
    room = work.workspace(s)
    q = np.column_stack([0.5 * np.concatenate([[0.0], np.cumsum(s.length)]), np.zeros(N + 1), np.full(N + 1, -5.0)])
    still, cq, cv = to_rows(np.zeros((N + 1, 3))), 1e-6, 1e-3
    a = still.copy()
    stage.begin_stage(room, to_rows(q), still, a, N, cq, cv)
    assert stage.solve_stage(s, room, a, still, to_rows(q), cq, cv, 1.0, 1e-3) == (stage.CONVERGED, 1)
    mass = s.mass + np.append(s.half_added_normal, 0.0) + np.append(0.0, s.half_added_normal)
    assert a[2, 1:N] == pytest.approx(-(s.weight / mass)[1:N])  # the elements lie across their fall
    assert room.q[2, 1:N] == pytest.approx(-5.0 + cq * a[2, 1:N])
    room.q[0, 2] = np.nan
    assert stage.solve_stage(s, room, a, still, to_rows(q), cq, cv, 1.0, 1e-3) == (stage.NOT_FINITE, 1)
    taut = to_rows(q * [2.2, 1.0, 1.0])
    stage.begin_stage(room, taut, still, a, N, 1.0, 1.0)
    status, count = stage.solve_stage(s, room, a, still, taut, 1.0, 1.0, 1e-12, 1e-15)
    assert status == stage.STALLED
    assert 4 < count <= stage.ITERATIONS


def test_forces_of_bending_are_the_slope_of_its_energy_with_its_tangent():
    """V = Σ ½ k |c|², c = d₊/ℓ₊ − d₋/ℓ₋ over inner nodes; elements of unequal lengths, one joint without stiffness"""
    bending = plain("mooring.lines.dynamics.lumped.bending")
    rng, length, n = np.random.default_rng(6), np.array([3.0, 2.0, 4.0, 5.0, 1.0]), 5
    flexure, q, w = np.array([9.0, 40.0, 0.0, 70.0, 30.0]), rng.normal(size=(3, 8)), 8

    def energy(q):
        d = np.diff(q[:, : n + 1]) / length
        return 0.5 * np.sum(flexure[1:n] * np.sum(np.diff(d) ** 2, axis=0))

    assert bending.bending_energy(flexure, length, q) == pytest.approx(energy(q), rel=1e-12)
    assert bending.bending_energy(np.zeros(0), length, q) == 0.0
    rows, r, D = bending.joints(flexure, length, w), np.zeros((3, w)), np.zeros((9, w))
    bending.bend(rows, q, r, D, n, 2.0)
    for i in range(3):
        for j in range(n + 1):
            step = np.zeros_like(q)
            step[i, j] = 1e-3
            slope = (energy(q + step) - energy(q - step)) / 2e-3
            assert r[i, j] == pytest.approx(-slope, rel=1e-8, abs=1e-9)
            curve = (energy(q + step) - 2 * energy(q) + energy(q - step)) / 1e-6
            assert D[4 * i, j] == pytest.approx(2.0 * curve, rel=1e-4, abs=1e-3)
            for apart, row in ((1, bending.NEXT), (2, bending.OVERNEXT)):
                if j + apart <= n:
                    other = np.zeros_like(q)
                    other[i, j + apart] = 1e-3
                    mixed = (
                        energy(q + step + other) - energy(q + step - other) - energy(q - step + other)
                        + energy(q - step - other)
                    ) / 4e-6  # fmt: skip
                    assert rows[row, j] == pytest.approx(2.0 * mixed, rel=1e-4, abs=1e-3)
    assert not bending.joints(np.zeros(0), length, w).size and not bending.bends(bending.joints(np.zeros(0), length, w))


@pytest.mark.parametrize("weight, thickness", [(0.5, 1e-3 * 0.2), (2e3, 2 * 2e3 * math.cos(0.1) / (3e5 * 0.2))])
def test_a_bed_is_as_thick_as_twice_the_weight_sinks_in_and_a_thousandth_of_the_thinnest_part_at_least(
    weight, thickness
):
    """2 w cos s/(k D) of a node of a uniform line, whose length does not matter; parts of 0.2 and 0.3 m"""
    one = DynamicSegment(30.0, 50.0, weight, 0.2, 1e6, 3)
    thick = DynamicSegment(30.0, 50.0, weight, 0.3, 1e6, 3)
    s = DynamicLine((one, thick), (0.0, 0.0, -20.0), bed=ElasticBed(slope=0.1)).system
    assert s.bed_thickness[:3] == pytest.approx(np.full(3, thickness))


def test_a_bed_mobilises_its_friction_over_a_tenth_of_the_least_stretch_by_it_or_over_what_is_given():
    """μ w ℓ²/EA of elements of 10 and 5 m, of which the lighter has no weight on the bed"""
    parts = DynamicSegment(30.0, 50.0, 300.0, 0.2, 1e6, 3), DynamicSegment(20.0, 9.0, -40.0, 0.3, 1e6, 4)
    line = lambda **bed: DynamicLine(parts, (1.0, 2.0, -20.0), bed=ElasticBed(**bed)).system  # noqa: E731
    assert line(friction=0.5).bed_slip == pytest.approx(0.1 * 0.5 * 300.0 * 100.0 / 1e6)
    assert line(friction=0.5, slip=0.07).bed_slip == 0.07 and line().bed_slip == 1e-7
    s = line(slope=0.2, uphill=0.3, below=1.5, friction=0.5)
    assert s.bed_course == pytest.approx([1.0, 2.0, math.cos(0.3), math.sin(0.3)]) and s.bed_friction == 0.5
    normal = [-math.sin(0.2) * math.cos(0.3), -math.sin(0.2) * math.sin(0.3), math.cos(0.2)]
    assert s.bed_normal == pytest.approx(normal) and s.bed_level == pytest.approx(np.dot(normal, [1.0, 2.0, -21.5]))
    none = DynamicLine(parts, (1.0, 2.0, -20.0), bed=None).system
    assert not none.bed_stiffness.any() and none.bed_normal.tolist() == [0.0, 0.0, 1.0] and none.bed_slip == 1.0


def test_bodies_on_a_line_are_spheres_of_their_own_radius_in_water_that_passes():
    """Of 2 and 0.5 m at nodes 1 and 3, centres 1 m below and 0.25 m above the surface: 27/32 and 5/32 under water;
    the cap's slope −(3/4)(1 − x²)/R; forces and their derivatives by acceleration as the docstrings of them say"""
    forces = plain("mooring.lines.dynamics.lumped.forces")
    body = lambda one, other: np.array([0.0, one, 0.0, other])  # noqa: E731
    s = SimpleNamespace(body_nodes=np.array([1, 3]), body_radius=body(2.0, 0.5), body_buoyancy=body(800.0, 64.0),
                        body_drag=body(10.0, 4.0), body_added=body(30.0, 2.0),
                        body_displaced=body(80.0, 6.4))  # fmt: skip
    zeros = np.zeros((3, 4))
    work = SimpleNamespace(q=zeros.copy(), v=zeros.copy(), u=zeros.copy(), du=zeros.copy(), r=zeros.copy(),
                           D=np.zeros((9, 4)), power=np.zeros(6))  # fmt: skip
    a = zeros.copy()
    work.q[2] = 9.0, -1.0, 9.0, 0.25
    work.u[:, 1], work.v[:, 1], work.v[:, 3] = (3.0, 0.0, 1.0), (0.0, 0.0, -3.0), (0.0, 2.0, 0.0)
    work.du[:, 1], a[:, 3] = (0.0, 0.5, 0.0), (0.0, 0.0, 1.5)
    forces.body_forces(s, work, a, 0.1, 0.2)
    wet = np.array([27, 5]) / 32
    first = wet[0] * 10.0 * 5.0 * np.array([3.0, 0.0, 4.0]) + [0.0, (30.0 + 80.0 * wet[0]) * 0.5, 800.0 * wet[0]]
    second = wet[1] * 4.0 * 2.0 * np.array([0.0, -2.0, 0.0]) + [0.0, 0.0, 64.0 * wet[1] - 2.0 * 1.5]
    assert pytest.approx(np.array([first, second])) == work.r[:, [1, 3]].T and not work.r[:, [0, 2]].any()
    assert work.power[DRAG] == pytest.approx(wet[0] * 600.0 + wet[1] * 32.0)
    assert work.power[INERTIA] == pytest.approx(0.0)
    past = np.array([[3.0, 0.0, 4.0], [0.0, -2.0, 0.0]])
    for node, speed, c, x, added, lift in (
        (1, 5.0, 10 * wet[0], past[0], 30.0, 0.1 * 800.0 * 0.75 * 0.75 / 2.0),
        (3, 2.0, 4 * wet[1], past[1], 2.0, 0.1 * 64.0 * 0.75 * 0.75 / 0.5),
    ):
        wanted = added * np.eye(3) + 0.2 * c * (speed * np.eye(3) + np.outer(x, x) / speed)
        wanted[2, 2] += lift
        assert work.D[:, node].reshape(3, 3) == pytest.approx(wanted)
