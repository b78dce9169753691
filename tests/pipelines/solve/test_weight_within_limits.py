"""Whether a weight is possible for a hull, and where its water resonates: limits from both sides, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.solve import run, weight
from hakobune.pipelines.solve.gaps import resonant_water as water

CORNERS = np.array([[-20.0, -5, -4], [20, -5, -4], [20, 5, -4], [-20, 5, 0]])
MESH = SimpleNamespace(whole=lambda: SimpleNamespace(vertices=CORNERS[None]))


@pytest.mark.parametrize("gyration, refused, told", [
    ((3.0, 4.0, 5.0), False, 0), ((3.0, 4.0, 5.04), False, 0), ((3.0, 4.0, 5.06), False, 1),
    ((4.0, 6.24, 3.0), False, 1),    ((4.0, 6.26, 3.0), True, 1), (None, False, 0),
])  # fmt: skip
def test_a_radius_of_gyration_is_at_most_the_root_of_the_squares_of_the_others(gyration, refused, told):
    """√(3² + 4²) = 5 m; a hundredth more is rounding, a quarter more impossible"""
    said = [line for line in weight._gyration_remarks(gyration, MESH) if "other two" in line]
    assert len(said) == told and all("is larger than the 5 m that the other two radii allow" in line for line in said)
    if refused:
        with pytest.raises(
            SceneError, match=rf"gyration has {max(gyration):g} m, but the other two radii allow at most 5 m"
        ):
            weight._check_gyration(gyration)
    else:
        weight._check_gyration(gyration)


@pytest.mark.parametrize("longest, told", [(39.9, 0), (40.1, 1)])
def test_no_body_has_mass_farther_from_its_middle_than_its_length(longest, told):
    said = [line for line in weight._gyration_remarks((30.0, 35.0, longest), MESH) if "largest dimension" in line]
    assert len(said) == told
    assert all(f"radius of gyration {longest:g} m is larger than the largest dimension of the wetted body, 40 m" in one
               for one in said)  # fmt: skip


@pytest.mark.parametrize("place, says", [
    ((59.9, 0, 0), None), ((60.1, 0, 0), "x = 60.1 m, 40.1 m outside the wetted hull (-20 to 20 m); allowed"),
    ((0, -45.1, 0), "y = -45.1 m, 40.1 m outside the wetted hull (-5 to 5 m)"), ((0, 0, 39.9), None),
    ((0, 0, 40.1), "z = 40.1 m, 40.1 m outside the wetted hull (-4 to 0 m)"),
])  # fmt: skip
def test_a_centre_of_gravity_is_within_a_length_of_the_hull(place, says):
    def check():
        weight._check_place(MESH, {"center_of_mass": place})

    if says is None:
        check()
    else:
        with pytest.raises(SceneError) as refused:
            check()
        assert says in str(refused.value) and "largest dimension, 40 m" in str(refused.value)


def body(x=0.0, y=0.0, roll=1e8, pitch=2e8):
    K = np.diag([0, 0, 1e6, roll, pitch, 0.0])
    return {"center_of_mass": (x, y, 0.0), "center_of_buoyancy": np.zeros(3), "mass": 1e6, "hydrostatic_stiffness": K}


def test_a_body_trims_and_heels_by_its_moment_over_its_restoring():
    """1e6 kg · 10 m/s² at 0.2 m ahead and −0.1 m to starboard: 2e6 and 1e6 N m over 2e8 and 1e8 N m/rad"""
    scene = SimpleNamespace(water=SimpleNamespace(gravity=10.0))
    trim, heel = weight._tilts(scene, body(0.2, -0.1))
    angle = math.degrees(math.atan(0.01))
    assert trim == ("trim", "x", 0.2, pytest.approx(2e6), pytest.approx(angle))
    assert heel == ("heel", "y", -0.1, pytest.approx(1e6), pytest.approx(angle))
    assert [one[0] for one in weight._tilts(scene, body(roll=-1.0))] == ["trim"]


@pytest.mark.parametrize("degrees, trimmed, refused", [(1.99, False, False), (2.01, False, True), (2.01, True, False)])
def test_two_degrees_of_tilt_at_rest_are_the_most_unless_the_body_is_held_trimmed(degrees, trimmed, refused):
    arm = math.tan(math.radians(degrees)) * 1e8 / 1e7
    one = SimpleNamespace(gyration=None, center_of_gravity=(0, arm, 0), GM=None, trimmed=trimmed)
    scene = SimpleNamespace(body=one, motions_known=False, water=SimpleNamespace(gravity=10.0))
    if refused:
        with pytest.raises(
            SceneError, match=rf"off the centre of buoyancy in y: this is a heel moment of .* and {degrees}° of static"
        ):
            weight.check_weight(scene, MESH, body(y=arm))
    else:
        weight.check_weight(scene, MESH, body(y=arm))
    one.center_of_gravity = (0, 0, 0)
    weight.check_weight(scene, MESH, body(y=arm))  # nobody asked for a weight


# ------------------------------------------------------------------ water that resonates


def scene_of(low, high, lids=()):
    """Of one or two bodies before a wall, where the formulas of a moonpool are not followed by a solution"""
    return SimpleNamespace(
        damping_lids=lids, omegas=lambda: np.array([low, high]), water=SimpleNamespace(gravity=9.8, depth=50.0),
        wall="wall", bodies=(SimpleNamespace(name="ship"), SimpleNamespace(name="barge")),
    )  # fmt: skip


@pytest.fixture
def peaks(monkeypatch):
    """Sizes of the rectangles that were asked for their peak, which have none"""
    asked = []
    monkeypatch.setattr(water, "_moonpools", lambda mesh: mesh.pools)
    monkeypatch.setattr(water, "peak", lambda *of: asked.append(of[:3]))
    monkeypatch.setattr(water, "_text", lambda words, own, rise: (words, own, rise))
    return asked


def hulls(*pools):
    """A mesh of as many bodies, each with its moonpools"""
    each = [SimpleNamespace(bodies=1, draft=8.0, pools=own) for own in pools]
    return each[0] if len(each) == 1 else SimpleNamespace(bodies=len(each), draft=8.0, of_body=each.__getitem__)


@pytest.mark.parametrize("gap, told", [(8.0, True), (8.1, False)])
def test_a_gap_as_wide_as_its_hulls_are_deep_traps_no_water(peaks, gap, told):
    """Molin: ω² = g / (d + b/π (3/2 + ln(B/2b)))"""
    found = water.resonant_water(scene_of(0.1, 9.0), hulls((), ()), [("a and b", gap, 8.0, 60.0, False)])
    own = math.sqrt(9.8 / (8.0 + gap / math.pi * (1.5 + math.log(60.0 / (2 * gap)))))
    words = f"the water between a and b, {gap:.3g} m wide,"
    assert found == (((words, pytest.approx(own), ""),) if told else ())
    assert peaks == ([(gap, 8.0, pytest.approx((60.0 - gap) / 2))] if told else [])
    assert water.resonant_water(scene_of(0.1, 9.0, ("lid",)), hulls(()), [("a and b", gap, 8.0, 60.0, False)]) == ()


def test_a_gap_before_a_wall_counts_with_the_image_of_the_hull(peaks):
    """3 m are 6 m between 2 · 20 + 6 m"""
    ((_, own, _),) = water.resonant_water(scene_of(0.1, 9.0), hulls((), ()), [("a and pier", 3.0, 8.0, 20.0, True)])
    assert own == pytest.approx(math.sqrt(9.8 / (8.0 + 6 / math.pi * (1.5 + math.log(46.0 / 12.0)))))
    assert peaks == [(6.0, 8.0, 20.0)]


def test_moonpools_of_each_body_resonate_by_their_area(peaks):
    """Fukuda: ω² = g / (d + 0.41 √S) of a pool of 6 by 4 m, wherever it lies and whichever way it runs round"""
    pool = np.array([[10.0, 2, 0], [16, 2, 0], [16, 6, 0], [10, 6, 0]])
    for corners in (pool, pool[::-1]):
        for bodies, where in (([corners],), ""), (([], [corners]), " in barge"), (([corners], []), " in ship"):
            ((words, own, rise),) = water.resonant_water(scene_of(0.1, 9.0), hulls(*bodies))
            assert words == f"the water of the moonpool of 24 m²{where}" and rise == ""
            assert own == pytest.approx(math.sqrt(9.8 / (8.0 + 0.41 * math.sqrt(24.0))))


@pytest.mark.parametrize(
    "low, high, told", [(1.14, 9, True), (1.16, 9, False), (0.1, 1 / 1.14, True), (0.1, 1 / 1.16, False)]
)
def test_a_resonance_within_15_per_cent_of_the_band_is_told(peaks, low, high, told):
    side = ((9.8 / 1.0 - 8.0) / 0.41) ** 2  # m², of a pool that resonates at 1 rad/s
    pool = np.array([[0, 0, 0], [side, 0, 0], [side, 1, 0], [0, 1, 0]], float)
    assert bool(water.resonant_water(scene_of(low, high), hulls([pool]))) is told


def test_every_row_of_a_plan_is_a_job_with_waves_carried_away_where_they_are_wanted():
    """Two rows, of which the first wants the waves that a body makes"""
    rows = [
        SimpleNamespace(omega=w, headings=f"headings {w}", want=want) for w, want in ((0.5, {"kochin"}), (0.7, {"rao"}))
    ]
    rows[0].want = type(run.KOCHIN)(run.KOCHIN)
    plan = SimpleNamespace(header=SimpleNamespace(theta="theta"), problem="problem")
    first, second = run._rows("storing", plan, rows)
    assert (first.where, second.where) == (0.5, 0.7)
    assert first.call == (run.solve_one, "problem", 0.5, "headings 0.5", rows[0].want, "theta")
    assert second.call == (run.solve_one, "problem", 0.7, "headings 0.7", {"rao"}, None)
    assert first.store.func is run._store_row and [one.store.args for one in (first, second)] == [
        ("storing", row) for row in rows
    ]
    jobs = list(run._limits("file", plan, ("zero", "infinite")))
    assert [(one.where, one.call) for one in jobs] == [
        (name, (run.limit_one, "problem", name)) for name in ("zero", "infinite")
    ]
    assert [one.store.args for one in jobs] == [("file", "zero"), ("file", "infinite")]
