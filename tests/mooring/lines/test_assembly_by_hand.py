"""Forces and stiffness of a system of lines, as plain Python: chains by hand, stiffness by differences."""

import math

import numpy as np
import pytest
from by_hand import span_of
from plain import plain

assembly, hydrostatics = plain("mooring.lines.system.assembly"), plain("mooring.lines.system.hydrostatics")
FIXED, FREE = assembly.FIXED, assembly.FREE
W, LENGTH, DEPTH = 800.0, 300.0, 60.0


def turned(x, y, z):
    """Rotation by a small vector, to second order in it"""
    S = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + S + 0.5 * S @ S


def turn_about(psi, heel=0.0):
    c, s = math.cos(psi), math.sin(psi)
    h, t = math.cos(heel), math.sin(heel)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, h, -t], [0, t, h]])


class System:
    """Two bodies, a free point with a buoy, anchors; lines on the bed, hanging, lighter than water, from either end"""

    def __init__(self):
        self.position = np.array([[-260.0, 30.0, -DEPTH], [20.0, -5.0, -8.0], [-20.0, 4.0, -3.0], [0.0, 0, 0],
                                  [10.0, 3.0, -20.0], [200.0, 160.0, -50.0]])  # fmt: skip
        self.owner = np.array([FIXED, 0, 1, FREE, 1, FIXED])
        self.column = np.array([-1, 0, 6, 12, 6, -1])
        self.floats = np.zeros((6, 3))
        self.floats[3] = 5e3, 9e3, 4.0
        self.ends = np.array([[0, 2], [1, 3], [3, 4], [5, 1]])
        self.flipped = np.array([False, False, False, True])
        self.lines = np.array([[LENGTH, W, 1e-8, 0.3], [75.0, 300.0, 2e-7, 0.0], [60.0, -200.0, 1e-7, 0.0],
                               [230.0, 500.0, 1e-7, 0.0]])  # fmt: skip
        self.place = np.array([[40.0, 10.0, 1.0], [-40.0, 5.0, -0.5]])
        self.turn = np.array([turn_about(0.3, 0.1), turn_about(-0.4)])
        self.free = np.array([[5.0, 25.0, -1.0]])

    def __call__(self, step=None):
        place, turn, free = self.place.copy(), self.turn.copy(), self.free.copy()
        if step is not None:
            for b in range(2):
                place[b] += step[6 * b : 6 * b + 3]
                turn[b] = turned(*step[6 * b + 3 : 6 * b + 6]) @ turn[b]
            free[0] += step[12:]
        points = self.position, self.owner, self.column, self.floats
        return assembly.assemble(*points, self.ends, self.flipped, self.lines, -DEPTH, place, turn, free)


def test_points_move_with_their_bodies_and_free_points_are_where_they_are():
    made = System()
    found = assembly.place_points(made.position, made.owner, made.column, made.place, made.turn, made.free)
    for i in (0, 5):
        assert found[i].tolist() == made.position[i].tolist()
    for i, b in ((1, 0), (2, 1), (4, 1)):
        assert found[i] == pytest.approx(made.place[b] + made.turn[b] @ made.position[i])
    assert found[3].tolist() == [5.0, 25.0, -1.0]


@pytest.mark.parametrize("flipped", [False, True])
@pytest.mark.parametrize("way", [0.0, 0.7, 2.5, -2.0])
def test_a_chain_pulls_a_body_towards_its_anchor_and_down_by_its_hanging_weight(way, flipped):
    """H = 1e5 N of an inextensible chain without friction: −H along, −w s down, and the moment of both at the arm"""
    H, height, arm = 1e5, 52.0, np.array([15.0, -6.0, -8.0])
    a = H / W
    hangs = math.sqrt(height * (height + 2 * a))
    span = span_of(H, W, LENGTH, height)
    fairlead = np.array([span * math.cos(way), span * math.sin(way), height - DEPTH])
    R = turn_about(0.3)
    ends = np.array([[1, 0]] if flipped else [[0, 1]])
    force, _, rows, points = assembly.assemble(
        np.array([[0.0, 0, -DEPTH], arm]), np.array([FIXED, 0]), np.array([-1, 0]), np.zeros((2, 3)), ends,
        np.array([flipped]), np.array([[LENGTH, W, 0.0, 0.0]]), -DEPTH, (fairlead - R @ arm)[None], R[None],
        np.zeros((0, 3)),
    )  # fmt: skip
    pull = np.array([-H * math.cos(way), -H * math.sin(way), -W * hangs])
    assert points[1] == pytest.approx(fairlead) and force[:3] == pytest.approx(pull, rel=1e-6)
    assert force[3:] == pytest.approx(np.cross(R @ arm, pull), rel=1e-6)
    first = rows[0, [1, 3]] if flipped else rows[0, [2, 4]]
    assert first == pytest.approx([H, W * hangs], rel=1e-6)
    assert rows[0, 5] == pytest.approx(LENGTH - hangs, rel=1e-6)


def test_stiffness_is_minus_the_derivative_of_the_forces():
    """By central differences of 10 µm and 1 µrad, of bodies about their moving origins and of a free point"""
    made = System()
    force, K, rows, _ = made()
    assert np.isfinite(force).all() and (rows[:, 0] < 4).all() and K.shape == (15, 15)
    found = np.empty((15, 15))
    for j in range(15):
        step = np.zeros(15)
        step[j] = 1e-6 if 3 <= j % 6 < 6 and j < 12 else 1e-5
        found[:, j] = -(made(step)[0] - made(-step)[0]) / (2 * step[j])
    size = np.sqrt(np.outer(np.abs(np.diag(K)), np.abs(np.diag(K))))
    assert np.abs((K - found) / size).max() < 2e-5


def test_forces_of_lines_between_bodies_and_points_are_internal():
    """What acts on the bodies, the point and the anchors is the weight of all lines and what floats"""
    made = System()
    force, _, rows, points = made()
    whole = np.zeros(3)
    for columns in (slice(0, 3), slice(6, 9), slice(12, 15)):
        whole += force[columns]
    anchors = np.zeros(3)
    for n, (here, there, h, v) in enumerate(((0, 2, 1, 3), (5, 1, 1, 3))):
        row, way = rows[3 * n], points[there] - points[here]
        along = way[:2] / np.hypot(*way[:2])
        anchors += [row[h] * along[0], row[h] * along[1], -row[v]]
    lying = rows[:, 5] * made.lines[:, 1]  # of lines on the bed, which carries it
    weight = (made.lines[:, 0] * made.lines[:, 1] - lying).sum()
    share = 9e3 * (0.5 + 1.0 / 4.0)
    rubbed = 0.3 * lying[0]  # friction that the bed gives the first line, along it
    towards = (points[2] - points[0])[:2]
    off = whole + anchors - [0.0, 0.0, share - 5e3 - weight]
    assert off[2] == pytest.approx(0.0, abs=1e-4)
    assert np.hypot(*off[:2]) <= rubbed * (1 + 1e-9) and abs(
        off[0] * towards[1] - off[1] * towards[0]
    ) < 1e-3 * np.hypot(*towards)


@pytest.mark.parametrize("z, share, slope", [(-3.0, 1.0, 0.0), (-2.0, 1.0, 0.0), (0.0, 0.5, 1.0), (1.0, 0.25, 1.0),
                                             (3.0, 0.0, 0.0)])  # fmt: skip
def test_a_float_is_lifted_by_what_is_under_water(z, share, slope):
    """Of a height of 4 m about its point: ½ − z/4"""
    force, K = np.zeros(3), np.zeros((3, 3))
    assembly.add_float(force, K, np.array([[0.0, 0, z]]), np.array([FREE]), np.array([0]), np.array([[5e3, 8e3, 4.0]]))
    assert force.tolist() == [0.0, 0.0, 8e3 * share - 5e3]
    assert K.tolist() == [[0, 0, 0], [0, 0, 0], [0, 0, 2e3 * slope]]


def test_a_line_without_a_solution_leaves_no_force_and_one_without_a_length_is_filled_elsewhere():
    made = System()
    made.lines[0, [0, 2]] = 100.0, 0.0
    assert np.isnan(made()[0]).all()
    made = System()
    made.lines[1, 0] = 0.0
    points = made()[3]
    assert not assembly.uniform_rows(points, made.ends, made.flipped, made.lines, -DEPTH)[1].any()


def test_a_plumb_line_yields_sideways_by_its_row():
    """Without a span pull over span is the row's own derivative: equal in all directions"""
    row, k = np.arange(18.0), np.zeros((2, 2, 3, 3))
    assembly.end_blocks(row, k, 0.0, 1.0, 0.0)
    assert k[0, 0, 0, 0] == k[0, 0, 1, 1] == 6.0 and k[1, 1, 0, 0] == k[1, 1, 1, 1] == 9.0
    assert k[0, 1, 0, 0] == -6.0 and k[1, 0, 1, 1] == -9.0


C = np.zeros((6, 6))
C[2:5, 2:5] = [[4e5, 3e4, -2e4], [3e4, 9e6, 5e5], [-2e4, 5e5, 7e7]]


@pytest.mark.parametrize("psi", [0.0, 0.8, -2.5])
def test_hydrostatics_turn_with_the_heading_and_are_linear_in_the_tilt(psi):
    """Heeled by 1e-6 rad about an axis of the body and sunk by 0.2 m: −C (z, roll, pitch) along the turned axes"""
    c, s = math.cos(psi), math.sin(psi)
    for roll, pitch in ((1e-6, 0.0), (0.0, 1e-6), (2e-6, -1e-6)):
        R = turn_about(psi) @ turned(roll, pitch, 0.0)
        force, _ = hydrostatics.hydrostatic_load(C, 0.2, R)
        up, about_x, about_y = -C[2:5, 2:5] @ [0.2, roll, pitch]
        wanted = [0, 0, up, c * about_x - s * about_y, s * about_x + c * about_y, 0]
        assert force == pytest.approx(wanted, rel=1e-9, abs=1e-6)
        assert hydrostatics.heading(R) == pytest.approx(psi, abs=1e-9)


def test_the_stiffness_of_a_heeled_body_is_minus_the_derivative_of_its_hydrostatics():
    R, off = turn_about(0.8, 0.3), 1e-6

    def force(step):
        return hydrostatics.hydrostatic_load(C, 0.2 + step[2], turned(*step[3:]) @ R)[0]

    K, found = hydrostatics.hydrostatic_load(C, 0.2, R)[1], np.empty((6, 6))
    for j, step in enumerate(off * np.eye(6)):
        found[:, j] = -(force(step) - force(-step)) / (2 * off)
    assert np.abs(K - found).max() < 1e-6 * np.abs(K).max()


def test_steady_loads_come_before_what_floats_of_each_body():
    force, K = np.zeros(12), np.zeros((12, 12))
    place = np.array([[0.0, 0, 1.5], [9.0, 9, -0.5]])
    hydrostatics.add_loads(force, K, np.arange(12.0).reshape(2, 6), np.array([C, 2 * C]), np.array([1.0, -1.0]), place,
                           np.array([np.eye(3), np.eye(3)]))  # fmt: skip
    for b, size in ((0, 1), (1, 2)):
        wanted = np.arange(6.0) + 6 * b
        wanted[2:5] -= size * C[2:5, 2] * 0.5
        assert force[6 * b : 6 * b + 6] == pytest.approx(wanted)
