"""The judgement of a solved line by its pieces, as plain Python: catenaries by hand, and what is wrong with them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

verdict = plain("mooring.lines.multi_segment.verdict")
H, V, X, Z, S, T = 0, 1, 2, 3, 4, 5
W, A = 1000.0, 100.0  # N/m, and H/w, m
PULL = W * A
LENGTH = 300.0
FAR, STRAY = 1e-8 * LENGTH, 1e-7 * 2e5


def line(bed=((0.0, 0.0, 0.0, 0.0),), **changes):
    given = {"bed": np.array(bed), "no_bed": False, "friction": 0.0, "length": LENGTH, "least": 1e-9,
             "surface": math.inf, "loads": np.zeros((0, 3)), "kept": np.zeros((0, 4)), "held": 0}  # fmt: skip
    return SimpleNamespace(**given | changes)


def free(s, ds, x, z, h, v, weight=W):
    return np.array([0.0, s, ds, x, z, h, v, weight, 1.0, 0.0, 0.0])


def lying(s, ds, x, z, tension, rate=0.0, slope=0.0, weight=W):
    return np.array([1.0, s, ds, x, z, tension, rate, weight, 1.0, 0.0, slope])


def room():
    return np.zeros(7), np.zeros(7), np.zeros((11, 0))


def catenary(height=50.0, mu=0.0):
    """Pieces of a chain that touches a flat bed: s = √(h(h + 2a)) hangs over a arcosh(1 + h/a)"""
    hangs = math.sqrt(height * (height + 2 * A))
    rest, x = LENGTH - hangs, A * math.acosh(1 + height / A)
    return np.array(
        [free(LENGTH, hangs, x + rest, height, PULL, W * hangs), lying(rest, rest, rest, 0.0, PULL, mu * W)]
    )


def stands(rows, made=None, states=(), slack=False):
    return verdict.stands(made or line(), rows, len(rows), np.array(states, int), slack, *room())


# ------------------------------------------------------------------ pieces


def test_tops_and_lower_ends_of_pieces_are_their_catenary_or_their_slope():
    q, _, g = room()
    rows = catenary()
    verdict.go_down(rows[0], q, g)
    assert q[[H, V, X, Z, S]] == pytest.approx([PULL, 0.0, rows[1, 3], 0.0, rows[1, 1]], abs=1e-6)
    verdict.put_top(lying(80.0, 10.0, 8.0, 6.0, 500.0, slope=0.3), q)
    assert q[[H, V, X, Z, S]] == pytest.approx([500 * math.cos(0.3), 500 * math.sin(0.3), 8.0, 6.0, 80.0])
    verdict.go_down(lying(80.0, 10.0, 8.0, 6.0, 500.0, rate=20.0, slope=0.3), q, g)
    c, s = math.cos(0.3), math.sin(0.3)
    assert q[[H, V, X, Z, S]] == pytest.approx([300 * c, 300 * s, 8.0 - 10 * c, 6.0 - 10 * s, 70.0])
    verdict.put_top(free(80.0, 10.0, 8.0, 6.0, 500.0, -20.0), q)
    assert q[[H, V, X, Z, S]].tolist() == [500.0, -20.0, 8.0, 6.0, 80.0]


HILLS = ((0.0, 0.0, 0.1, 0.0), (10.0, 1.0, -0.2, 0.0), (30.0, -3.0, 0.4, 0.0))


@pytest.mark.parametrize("x, ground", [
    (-5.0, -5 * math.tan(0.1)), (0.0, 0.0), (10.0, 1.0), (20.0, 1 - 10 * math.tan(0.2)), (30.0, -3.0),
    (40.0, -3 + 10 * math.tan(0.4)),
])  # fmt: skip
def test_heights_are_over_the_facet_below_and_over_the_first_and_last_beyond_them(x, ground):
    assert verdict.height_over_bed(line(HILLS), x, 7.0) == pytest.approx(7.0 - ground)


@pytest.mark.parametrize("bed, clear", [
    (((0.0, 0.0, 0.0, 0.0),), True), (((0.0, 1e-3, 0.0, 0.0),), False),
    (((0.0, -9.0, 0.0, 0.0), (60.0, 18.5, 0.2, 0.0), (90.0, 25.0, -0.2, 0.0)), True),
    (((0.0, -9.0, 0.0, 0.0), (60.0, 18.6, 0.2, 0.0), (90.0, 25.0, -0.2, 0.0)), False),
    (((0.0, -9.0, 0.0, 0.0), (0.5, -9.0, 0.6, 0.0), (30.0, 4.0, 0.05, 0.0)), True),
    (((0.0, -9.0, 0.0, 0.0), (0.5, -9.0, 0.6, 0.0), (30.0, 5.0, 0.05, 0.0)), False),
])  # fmt: skip
def test_a_piece_clears_a_bed_that_it_passes_above_everywhere(bed, clear):
    """z = a (cosh(x/a) − 1) from 0 to 96.24 m: 4.53 m at 30 m, 18.55 m at 60 m"""
    span = A * math.acosh(1.5)
    piece = free(200.0, math.sqrt(50 * 250), span, 50.0, PULL, W * math.sqrt(50 * 250))
    assert verdict.clears_bed(line(bed), piece, *room()[::2], FAR) == clear


def test_a_piece_that_dips_between_its_ends_is_looked_at_where_it_is_parallel_to_the_bed():
    """Between ends 5 m up, 60 m apart: the dip is a (cosh 0.3 − 1) = 4.53 m"""
    half = A * math.sinh(0.3)
    piece = free(200.0, 2 * half, 60.0, 5.0, PULL, W * half)
    for ground, clear in ((0.45, True), (0.48, False)):
        assert verdict.clears_bed(line(((0.0, ground, 0.0, 0.0),)), piece, *room()[::2], FAR) == clear


def test_a_piece_that_leads_away_from_its_anchor_is_looked_at_over_vertices_too():
    """H < 0: from (0, 50) out to (96.24, 0), the same catenary mirrored; at 66.24 m it is 4.53 m up"""
    hangs, span = math.sqrt(50 * 250), A * math.acosh(1.5)
    piece = free(200.0, hangs, 0.0, 50.0, -PULL, W * hangs)
    for top, clear in ((4.5, True), (4.6, False)):
        bed = ((-50.0, -60.0, 0.0, 0.0), (span - 30.0, top, -0.3, 0.0))
        assert verdict.clears_bed(line(bed), piece, *room()[::2], FAR) == clear


@pytest.mark.parametrize("piece, mu, well", [
    (lying(100.0, 50.0, 60.0, 0.0, 5e4, 0.0), 0.0, True), (lying(100.0, 50.0, 60.0, 0.0, -1.0, 0.0), 0.0, False),
    (lying(100.0, 50.0, 60.0, 0.0, 1e3, 21.0), 0.5, False), (lying(100.0, 50.0, 60.0, 0.0, 1e3, 19.9), 0.5, True),
    (lying(100.0, 50.0, 60.0, 1e-5, 5e4, 0.0), 0.0, False), (lying(100.0, 50.0, 60.0, -1e-5, 5e4, 0.0), 0.0, False),
    (lying(100.0, 50.0, 60.0, 0.0, 5e4, 499.9), 0.5, True), (lying(100.0, 50.0, 60.0, 0.0, 5e4, 501.0), 0.5, False),
    (lying(100.0, 50.0, 60.0, 0.0, 5e4, -499.9), 0.5, True), (lying(100.0, 50.0, 60.0, 0.0, 5e4, -501.0), 0.5, False),
    (lying(100.0, 50.0, -60.0, 0.0, 5e4, 501.0), 0.5, True),  # beyond the anchor's place: a heap laid out
    (lying(100.0, 50.0, 60.0, 0.0, 0.0, 0.0), 0.0, True),
])  # fmt: skip
def test_what_lies_has_tension_and_a_friction_that_the_bed_can_give(piece, mu, well):
    """μ w = 500 N/m, either way"""
    assert verdict.lies_well(line(friction=mu), piece, FAR, STRAY) == well
    assert not verdict.lies_well(line(friction=mu, no_bed=True), piece, FAR, STRAY)


@pytest.mark.parametrize("slope, rate, well", [
    (0.3, 0.0, True), (0.6, 0.0, False), (0.6, math.sin(0.6) - 0.49 * math.cos(0.6), True),
    (0.6, math.sin(0.6) - 0.51 * math.cos(0.6), False), (0.6, math.sin(0.6) + 0.49 * math.cos(0.6), True),
    (0.6, math.sin(0.6) + 0.51 * math.cos(0.6), False),
])  # fmt: skip
def test_on_a_slope_the_tension_carries_what_friction_does_not(slope, rate, well):
    """|dT/ds − w sin β| ≤ μ w cos β, μ = 0.5: at 0.3 rad nothing need be carried"""
    piece = lying(100.0, 10.0, 60.0, 60.0 * math.tan(slope), 5e4, rate * W, slope)
    assert verdict.lies_well(line(((0.0, 0.0, slope, 0.0),), friction=0.5), piece, FAR, STRAY) == well


@pytest.mark.parametrize("piece, idle", [
    (lying(100.0, 50.0, 60.0, 0.0, 0.0), True), (lying(100.0, 50.0, 60.0, 0.0, 1.0), False),
    (lying(100.0, 50.0, 60.0, 0.0, 0.0, -0.1), False), (free(100.0, 50.0, 60.0, 0.0, 0.0, 0.0), False),
])  # fmt: skip
def test_a_piece_is_idle_that_lies_without_tension(piece, idle):
    assert verdict.is_idle(piece, STRAY) == idle


# ------------------------------------------------------------------ where pieces meet


def state(h, v, x=50.0, z=0.0):
    q = np.zeros(7)
    q[[H, V, X, Z]] = h, v, x, z
    return q


def balanced(made, q, below, load=-1, states=(0,), slack=False, idle=False):
    return verdict.balanced(made, q, below, load, np.array(states), slack, idle, FAR, STRAY)


@pytest.mark.parametrize("up, mu, holds", [
    (0.0, 0.0, True), (30.0, 0.0, False), (-30.0, 0.0, False), (-30.0, 0.5, False),
])  # fmt: skip
def test_off_the_bed_forces_balance_where_pieces_meet(up, mu, holds):
    """30 N left over of 1e5 N"""
    made = line(friction=mu)
    assert balanced(made, state(1e5, 2e4, z=9.0), state(1e5, 2e4 + up, z=9.0)) == holds
    assert balanced(made, state(1e5, 2e4, z=9.0), state(1e5 + up, 2e4, z=9.0)) == (up == 0.0)


@pytest.mark.parametrize("weight, holds", [(500.0, True), (499.9, False), (-500.0, False)])
def test_a_load_hangs_on_the_piece_above_it(weight, holds):
    """V falls by its weight"""
    made = line(loads=np.array([[100.0, weight, 0.0]]))
    assert balanced(made, state(1e5, 2e4, z=9.0), state(1e5, 2e4 - 500.0, z=9.0), 0) == holds


@pytest.mark.parametrize("kind, level, lift, holds", [
    (0, -5.0, 500.0, True), (0, 5.0, 500.0, False), (2, 5.0, -80.0, True), (2, -5.0, -80.0, False),
    (2, 5.0, 500.0, False),
    (1, 0.0, 500.0, True), (1, 0.0, -80.0, True), (1, 0.0, 200.0, True), (1, 0.0, 501.0, False), (1, 0.0, -81.0, False),
    (1, 0.01, 200.0, False), (1, -0.01, 200.0, False),
])  # fmt: skip
def test_a_buoy_lifts_by_its_state_under_in_or_out_of_the_water(kind, level, lift, holds):
    """500 N under water, −80 N in air, any lift between in the surface, where it has to be"""
    made = line(loads=np.array([[100.0, -500.0, 80.0]]), surface=40.0)
    q = state(1e5, 2e4, z=40.0 + level)
    assert balanced(made, q, state(1e5, 2e4 + lift, z=40.0 + level), 0, (kind,)) == holds


@pytest.mark.parametrize("across, up, mu, holds", [
    (0.0, -100.0, 0.0, True), (0.0, 100.0, 0.0, False), (1.0, -100.0, 0.0, False), (49.0, -100.0, 0.5, True),
    (51.0, -100.0, 0.5, False), (-49.0, -100.0, 0.5, True), (-51.0, -100.0, 0.5, False),
])  # fmt: skip
def test_a_bed_pushes_up_within_its_cone_of_friction(across, up, mu, holds):
    """What the line lacks at a sinker of 300 N on a flat bed: across up to μ of what presses"""
    made = line(friction=mu, loads=np.array([[100.0, 300.0, 0.0]]))
    q, below = state(1e4, 500.0), state(1e4 - across, 500.0 - 300.0 - up)
    assert balanced(made, q, below, 0) == holds


@pytest.mark.parametrize("ratio, holds", [(0.999, True), (1.001, False)])
def test_over_a_vertex_tension_changes_as_over_a_bollard(ratio, holds):
    """From 0.3 rad below to −0.1 rad above: by exp(μ 0.4) at most, either way, pressed onto the bed"""
    made = line(((0.0, 0.0, 0.3, 0.0), (50.0, 50 * math.tan(0.3), -0.1, 0.0)), friction=0.5)
    z = 50 * math.tan(0.3)
    upper, most = 1e5, 1e5 * math.exp(0.5 * 0.4 * ratio)
    for above, under in ((upper, most), (most, upper)):
        q = state(above * math.cos(-0.1), above * math.sin(-0.1), 50.0, z)
        assert balanced(made, q, state(under * math.cos(0.3), under * math.sin(0.3), 50.0, z)) == holds


def test_idle_parts_need_no_balance_on_the_bed_and_without_a_bed_nothing_pushes():
    q, below = state(10.0, 0.0), state(0.0, 0.0)
    assert balanced(line(), q, below, idle=True) and not balanced(line(), q, below)
    assert not balanced(line(no_bed=True), q, below, idle=True)
    assert not balanced(line(), state(10.0, 0.0, z=1.0), state(0.0, 0.0, z=1.0), idle=True)


@pytest.mark.parametrize("x, angle, pushes", [
    (20.0, 0.0, False), (20.0, -0.2, True), (20.0, -0.21, False), (10.0, 0.0, True), (10.0, 0.1, True),
    (10.0, 0.11, False), (10.0, -0.2, True), (10.0, -0.21, False), (-9.0, 0.1, True), (-9.0, 0.0, False),
    (99.0, 0.4, True), (99.0, 0.39, False),
])  # fmt: skip
def test_a_bed_pushes_along_the_normals_of_the_facets_at_a_place(x, angle, pushes):
    """(−sin β, cos β), at a vertex those of both facets and between"""
    made = line(HILLS)
    size = 1e3
    assert verdict.pushed(made, x, -size * math.sin(angle), size * math.cos(angle), 1e-6, 0.5) == pushes
    wide = line(HILLS, friction=math.tan(0.05))
    near = pushes or abs(angle) > 0
    assert verdict.pushed(wide, x, -size * math.sin(angle), size * math.cos(angle), 1e-6, 0.5) == near


# ------------------------------------------------------------------ whole lines


@pytest.mark.parametrize("mu", [0.0, 0.4])
def test_a_chain_that_touches_a_flat_bed_stands(mu):
    """With friction the tension falls by μ w a metre"""
    assert stands(catenary(mu=mu), line(friction=mu))


@pytest.mark.parametrize("row, column, change", [
    (0, 2, 1e-3), (0, 3, 1e-3), (0, 4, 1e-3), (0, 5, 1.0), (0, 6, 1.0), (0, 7, 0.1), (1, 2, 1e-3), (1, 2, -1e-3),
    (1, 3, 1e-3), (1, 4, 1e-3), (1, 4, -1e-3), (1, 5, 1.0), (1, 5, -1.0), (1, 6, 1.0), (1, 6, -1.0),
])  # fmt: skip
def test_a_chain_off_by_a_millimetre_or_a_newton_does_not_stand(row, column, change):
    rows = catenary()
    rows[row, column] += change
    assert not stands(rows)


def test_a_length_is_never_negative():
    rows = catenary()
    back = lying(rows[1, 1], -1.0, rows[1, 3], 0.0, PULL)
    forth = lying(rows[1, 1] + 1.0, rows[1, 1] + 1.0, rows[1, 3] + 1.0, 0.0, PULL)
    assert not stands(np.array([rows[0], back, forth]))
    assert stands(np.array([rows[0], lying(rows[1, 1], 0.0, rows[1, 3], 0.0, PULL), rows[1]]))


@pytest.mark.parametrize("weight, holds", [(5e3, True), (5e3 + 1.0, False)])
def test_a_sinker_between_two_catenaries_stands_where_its_weight_is_their_difference(weight, holds):
    """Below a catenary from its lowest point, above the same one shifted by 5 m of chain"""
    low = math.sqrt(20 * 220)  # m of chain up to 20 m
    x = A * math.acosh(1.2)
    upper, v = 30.0, W * low + 5e3
    rise = (math.hypot(PULL, v + W * upper) - math.hypot(PULL, v)) / W
    run = A * (math.asinh((v + W * upper) / PULL) - math.asinh(v / PULL))
    rows = np.array([free(low + upper, upper, x + run, 20.0 + rise, PULL, v + W * upper),
                     free(low, low, x, 20.0, PULL, W * low)])  # fmt: skip
    assert stands(rows, line(loads=np.array([[low, weight, 0.0]])), (0,)) == holds
    assert not stands(rows)


SLACK = np.array([free(LENGTH, 50.0, 80.0, 50.0, 1e-9, 50 * W), lying(250.0, 250.0, 80.0, 0.0, 0.0)])


@pytest.mark.parametrize("slack", [True, False])
def test_a_slack_line_hangs_down_and_its_rest_lies_beyond_the_anchor(slack):
    """50 m plumb, 80 m to the anchor, 170 m laid out beyond its place as a heap"""
    assert stands(SLACK, line(), slack=slack) == slack


@pytest.mark.parametrize("changes, is_heap", [
    ({}, True), ({(1, 3): 300.0}, True), ({(1, 0): 0.0, (1, 3): 1e-9}, True), ({(1, 0): 0.0, (1, 3): 5.0}, False),
])  # fmt: skip
def test_what_is_left_over_is_beyond_the_anchor_or_lies(changes, is_heap):
    rows = SLACK.copy()
    for place, value in changes.items():
        rows[place] = value
    rows[1, 5] = 0.0
    assert verdict.heaps(line(), rows, 2, FAR, STRAY) == is_heap


@pytest.mark.parametrize("x, tension, is_heap", [(-1.0, 0.0, True), (-1.0, 5.0, False), (1.0, 5.0, True)])
def test_nothing_pulls_at_a_heap(x, tension, is_heap):
    rows = np.array([lying(300.0, 50.0, 80.0, 0.0, 0.0), lying(250.0, 100.0, x, 0.0, tension)])
    assert verdict.heaps(line(), rows, 2, FAR, STRAY) == is_heap


@pytest.mark.parametrize("tension, is_heap", [(0.0, True), (5e3, False)])
def test_an_end_that_slides_and_pulls_is_no_heap(tension, is_heap):
    """A slope of 0.3 rad without friction: the end pulls by what its weight is along it"""
    rows = np.array([SLACK[0], lying(250.0, 10.0, 80.0, 0.0, tension)])
    assert verdict.heaps(line(((0.0, 0.0, 0.3, 0.0),)), rows, 2, FAR, STRAY) == is_heap
    assert verdict.heaps(line(((0.0, 0.0, 0.3, 0.0),), friction=0.5), rows, 2, FAR, STRAY)
