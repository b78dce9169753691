"""Hinges between bodies: rows are derivatives of what is held, and what they hold keeps it held, by differences."""

from types import SimpleNamespace

import numpy as np
import pytest
from bending_body import two_of_which_one_bends
from plain import plain

from hakobune.bem.hinges import Link, rows_of
from hakobune.mooring.lines.system.bodies import rotation

links = plain("mooring.motion.links")
PLACE = np.array([[0.0, 0.0, -1.0], [20.0, 1.0, -1.5]])
POSES = np.array([[0.3, -0.2, 0.1, 0.02, -0.03, 0.2], [0.5, 0.1, -0.1, -0.04, 0.05, 0.15]])
SPEED = np.array([0.3, -0.2, 0.1, 0.02, 0.03, -0.05, -0.1, 0.4, 0.2, -0.03, 0.01, 0.04])
BACK = rotation(0.01, -0.02, 0.03)


def a_link(second):
    """A hinge about an axis near y, between two bodies or from the first to what stands still"""
    ends, points = np.array([[0, second]]), np.array([[[10.0, 0.5, 0.2], [-9.5, -0.5, 0.7]]])
    if second < 0:
        points[0, 1] = (10.3, 0.4, -0.8)
    held = np.array([[[1.0, 0.1, 0.0], [0.0, 0.2, 1.0], [0.0, 0.0, 0.0]]])
    along, first, turns = np.eye(3)[None], np.array([0, 5]), np.array([3])
    none = np.zeros((1, 3)), np.zeros((1, 3)), np.zeros(1, np.int64)
    return links.Links(ends, points, BACK[None], along, held, first, turns, PLACE, rotation(0.0, 0.0, 0.4)[None], *none)


def moved(poses, speed, t):
    """Poses after t s: surge and sway go along the heading as it is at the start, for differences"""
    out = poses.copy()
    for b, (u, v, *rest) in enumerate(speed.reshape(-1, 6)):
        cos, sin = np.cos(poses[b, 5]), np.sin(poses[b, 5])
        out[b] += t * np.array([cos * u - sin * v, sin * u + cos * v, *rest])
    return out


def gap(link, poses):
    """Way between the two points, and the part of the turn from the first to the second along what is held"""
    turns, places = [], []
    for b, point in zip(link.ends[0], link.points[0], strict=True):
        turns.append(np.eye(3) if b < 0 else rotation(*poses[b, 3:]))
        places.append(turns[-1] @ point + (0.0 if b < 0 else PLACE[b] + poses[b, :3]))
    Q = turns[0].T @ turns[1] @ BACK
    turned = 0.5 * np.array([Q[2, 1] - Q[1, 2], Q[0, 2] - Q[2, 0], Q[1, 0] - Q[0, 1]])
    return np.concatenate([places[1] - places[0], link.held[0, :2] @ turned])


@pytest.mark.parametrize("second", [1, -1])
def test_rows_are_the_derivatives_of_what_is_held(second):
    link, h = a_link(second), 1e-6
    G, left = links.rows_at(link, POSES)
    assert left == pytest.approx(gap(link, POSES), abs=1e-12)
    for k in range(12):
        way = np.eye(12)[k]
        slope = (gap(link, moved(POSES, way, h)) - gap(link, moved(POSES, way, -h))) / (2 * h)
        assert G[:, k] == pytest.approx(slope, abs=1e-8)


@pytest.mark.parametrize("second", [1, -1])
def test_what_a_hinge_holds_lets_its_gap_die_as_a_critically_damped_spring(second):
    """g″ + 2αg′ + α²g = 0 with the velocities ν + W F t"""
    link, rng = a_link(second), np.random.default_rng(2)
    square = rng.normal(size=(12, 12))
    inverse, force = square @ square.T / 12 + np.eye(12), rng.normal(size=12)
    work = links.link_work(link)
    work.speed[:] = SPEED
    acting = force.copy()
    links.hold_together(link, work, POSES, inverse, acting)
    h, rate = 1e-3, inverse @ acting

    def at(t):
        """Gap after t s, in fifty steps of the mean velocity"""
        poses, step = POSES, t / 50
        for i in range(50):
            half = moved(poses, SPEED + rate * step * i, step / 2)
            turned = half.copy()
            middle = SPEED + rate * step * (i + 0.5)
            now = poses.copy()
            now[:, 5] = turned[:, 5]
            poses = poses + moved(now, middle, step) - now
        return gap(link, poses)

    first, second_rate = (at(h) - at(-h)) / (2 * h), (at(h) - 2 * at(0.0) + at(-h)) / h**2
    left = second_rate + 2 * links.BACK * first + links.BACK**2 * at(0.0)
    assert left == pytest.approx(np.zeros(5), abs=2e-5)
    # and it does so by forces along the rows alone
    G, _ = links.rows_at(link, POSES)
    mu = np.linalg.lstsq(G.T, acting - force, rcond=None)[0]
    assert G.T @ mu == pytest.approx(acting - force, abs=1e-9)
    assert work.mu == pytest.approx(mu, rel=1e-8)


def test_forces_told_of_a_hinge_do_the_work_of_its_rows():
    """On the second body: f · v of its point and m · ω, told along axes turned by 0.4 rad from those of the first"""
    link, mu, h = a_link(1), np.array([3.0, -2.0, 5.0, 0.7, -1.1]), 1e-6
    told = links.held_by(link, POSES, mu)[0]
    axes = rotation(*POSES[0, 3:]) @ rotation(0.0, 0.0, 0.4).T
    f, m = axes @ told[:3], axes @ told[3:]
    assert f == pytest.approx(mu[:3])
    G, _ = links.rows_at(link, POSES)
    R = rotation(*POSES[1, 3:])
    for k in range(6, 12):
        poses = [moved(POSES, np.eye(12)[k], t)[1] for t in (h, -h)]
        ends = [PLACE[1] + pose[:3] + rotation(*pose[3:]) @ link.points[0, 1] for pose in poses]
        spin = (rotation(*poses[0][3:]) - rotation(*poses[1][3:])) / (2 * h) @ R.T
        turn = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
        assert mu @ G[:, k] == pytest.approx(f @ (ends[0] - ends[1]) / (2 * h) + m @ turn, abs=1e-7)


def test_a_definite_system_is_solved():
    rng = np.random.default_rng(5)
    square, x = rng.normal(size=(4, 4)), rng.normal(size=4)
    A = square @ square.T + np.eye(4)
    wanted = np.linalg.solve(A, x)
    links.solve_positive(A.copy(), x)
    assert x == pytest.approx(wanted)


def test_links_stand_still_where_there_is_no_body():
    assert links.links_of(SimpleNamespace(links=())) is None


@pytest.mark.parametrize("link", [
    Link("a", ("ship", "barge"), (4.0, -30.0, 2.0), (1.0, 0.3, 0.1)),
    Link("a", ("barge", "ship"), (40.0, 8.0, 2.0), (0.3, 0.1, 1.0), "slider"),
    Link("a", ("space", "barge"), (40.0, -25.0, 1.0), (0.0, 1.0, 0.2), "rigid"),
], ids=lambda one: one.kind)  # fmt: skip
def test_rows_of_shapes_are_the_derivatives_of_what_is_held_and_of_the_travel(link):
    """With shapes far beyond what is small, so that axes turn by a tenth of a radian"""
    kinds = ("vertical bending", "horizontal bending", "torsion")
    body = two_of_which_one_bends(2, kinds).linked((link,))
    held, h = links.links_of(body), 1e-6
    poses, bent = POSES + body.axes_at_rest * [0, 0, 0, 0, 0, 1], np.array([1.5, -0.8, 0.7, 1.1, 0.05, 0.08])
    G, _ = links.rows_at(held, poses, bent)
    work = links.link_work(held)

    rest = body.axes_at_rest * [0, 0, 0, 0, 0, 1]
    where = (poses, bent) if link.kind == "slider" else (rest, 0 * bent)  # an angle about an axis needs its hinge held

    def travel(way):
        work.amplitude[:] = where[1] + way
        links.fill_rows(held, work, where[0], True)
        return work.travel[0]

    travel(0.0)
    own = work.pulled_by[0].copy()
    assert len(held.shapes) == 6 and np.abs(G[:, 12:]).max(axis=0).min() > 1e-3
    for k, way in enumerate(h * np.eye(6)):
        slope = (links.rows_at(held, poses, bent + way)[1] - links.rows_at(held, poses, bent - way)[1]) / (2 * h)
        assert G[:, 12 + k] == pytest.approx(slope, abs=1e-7)
        assert own[k] == pytest.approx((travel(way) - travel(-way)) / (2 * h), abs=1e-7)
    small = links.rows_at(held, rest, 0.0)[0]
    span = np.linalg.qr(small.T)[0]  # rows of the frequency domain hold the same motions
    assert np.abs(rows_of(body, link) - rows_of(body, link) @ span @ span.T).max() < 1e-9 * np.abs(small).max()


class TwoLinks:
    """Three bodies and two shapes: a link of three rows from the first to the third, one of two from the second to
    a fixed point.  Rows change with the poses and amplitudes.
    """

    ends, first, shapes = np.array([[0, 2], [1, -1]]), np.array([0, 3, 5]), np.array([18, 19])

    def __init__(self, monkeypatch):
        rng = np.random.default_rng(61)
        self.poses, self.speed = rng.normal(size=(3, 6)), rng.normal(size=20)
        self.base, self.more = rng.normal(size=(2, 5, 14))
        self.by_pose, self.by_amplitude = rng.normal(size=(3, 6)), rng.normal(size=2)
        square = rng.normal(size=(20, 20))
        self.inverse, self.force = square @ square.T + 20 * np.eye(20), rng.normal(size=20)
        self.links = SimpleNamespace(ends=self.ends, first=self.first, shapes=self.shapes)
        self.work = SimpleNamespace(
            rows=np.zeros((5, 12)), by_shapes=np.zeros((5, 2)), shares=np.zeros((20, 5)), matrix=np.zeros((5, 5)),
            mu=np.zeros(5), left=np.zeros(5), gap=rng.normal(size=5), free=np.zeros(20), ahead=np.zeros((3, 6)),
            speed=self.speed.copy(), amplitude=rng.normal(size=2),
        )  # fmt: skip
        self.at_rest = self.work.amplitude.copy()
        monkeypatch.setattr(links, "fill_rows", self.fill)
        monkeypatch.setattr(links, "drive", lambda links, work, force: None)

    def fill(self, links, work, poses, whole):
        rows = self.base + (np.sum(self.by_pose * poses) + self.by_amplitude @ work.amplitude) * self.more
        work.rows[:], work.by_shapes[:] = rows[:, :12], rows[:, 12:]

    def dense(self, rows):
        """(5, 20) of rows (5, 14): both ends, then shapes"""
        G = np.zeros((5, 20))
        for k, ends in enumerate(self.ends):
            own = slice(self.first[k], self.first[k + 1])
            for e, b in enumerate(ends):
                if b >= 0:
                    G[own, 6 * b : 6 * b + 6] += rows[own, 6 * e : 6 * e + 6]
        G[:, 18:] += rows[:, 12:]
        return G


def test_what_links_hold_makes_every_row_a_critically_damped_spring_of_all_bodies_and_shapes(monkeypatch):
    """G a + Ġ v + 2βG v + β² gap = 0, a = W (f + Gᵀμ), of dense matrices; places move by speeds along the headings"""
    one = TwoLinks(monkeypatch)
    force = one.force.copy()
    links.hold_together(one.links, one.work, one.poses, one.inverse, force)
    v, moved = one.speed, np.zeros((3, 6))
    for b in range(3):
        c, s = np.cos(one.poses[b, 5]), np.sin(one.poses[b, 5])
        u, w = v[6 * b : 6 * b + 2]
        moved[b] = [c * u - s * w, s * u + c * w, *v[6 * b + 2 : 6 * b + 6]]
    rate = (np.sum(one.by_pose * moved) + one.by_amplitude @ v[18:]) * one.more
    now = one.base + (np.sum(one.by_pose * one.poses) + one.by_amplitude @ one.at_rest) * one.more
    G, turning, back = one.dense(now), one.dense(rate), links.BACK
    wanted = -turning @ v - 2 * back * G @ v - back**2 * one.work.gap
    assert G @ one.inverse @ force == pytest.approx(wanted, rel=1e-5, abs=1e-5)
    assert force - one.force == pytest.approx(G.T @ one.work.mu) and one.work.amplitude == pytest.approx(one.at_rest)
    assert one.work.shares == pytest.approx(one.inverse @ G.T)
    x = np.random.default_rng(3).normal(size=20)
    for k, i in ((0, 0), (0, 2), (1, 3), (1, 4)):
        assert links.along_rows(one.links, one.work, k, i, x) == pytest.approx(G[i] @ x)


def test_springs_and_dampers_of_links_pull_by_the_travel_and_its_rate():
    """−k (x − x₀) − c ẋ along the row of the travel, of the second link alone"""
    rng = np.random.default_rng(62)
    row, by_shape, speed = rng.normal(size=(2, 12)), rng.normal(size=(2, 2)), rng.normal(size=20)
    one = SimpleNamespace(ends=TwoLinks.ends[::-1], shapes=TwoLinks.shapes, travels=np.array([0, 1]),
                          drive=np.array([[9.0, 9.0, 9.0], [5.0, 3.0, 0.4]]))  # fmt: skip
    work = SimpleNamespace(pulled=row, pulled_by=by_shape, speed=speed, travel=np.array([7.0, 1.5]), pull=np.zeros(2))
    force = np.zeros(20)
    links.drive(one, work, force)
    along = np.zeros(20)
    along[0:6], along[12:18], along[18:] = row[1, :6], row[1, 6:], by_shape[1]
    pull = -5.0 * (1.5 - 0.4) - 3.0 * along @ speed
    assert work.pull == pytest.approx([0.0, pull]) and force == pytest.approx(pull * along)
